//! Reads motions of the ground and of floors from files, as the keys of `[ground]` say.

use crate::options::{BuildingOptions, ComponentsOption, GroundOptions};
use crate::recorded::{MotionFiles, Second, read_recorded};
use crate::study::{Level, RecordedMotion};
use freestand_input::toml_reader::Written;
use freestand_records::formats::ReadOptions;
use freestand_records::processing::azimuth_deg;

use super::building::model_keys;
use super::ground::synthetic_keys;
use super::{Overrides, Resolver};

/// Step between the directions in which every object is tried, unless the study states one
/// \[degrees\].
const ROTATION_STEP_DEG: f64 = 15.0;
/// Smallest step: each direction costs as much as a study with one component.
const FINEST_STEP_DEG: f64 = 1.0;

/// A list of files.
type Files = Written<Vec<Written<String>>>;

/// The keys that say how files are read, with their lines.
pub(super) fn reading_keys(written: &GroundOptions) -> [(&'static str, Option<usize>); 9] {
    [
        ("unit", written.unit.as_ref().map(|w| w.line)),
        ("dt", written.dt_s.as_ref().map(|w| w.line)),
        ("component", written.component.as_ref().map(|w| w.line)),
        ("across", written.across.as_ref().map(|w| w.line)),
        ("components", written.components.as_ref().map(|w| w.line)),
        ("rotation_step", written.rotation_step_rad.as_ref().map(|w| w.line)),
        ("station_xml", written.station_xml.as_ref().map(|w| w.line)),
        ("scale", written.scale.as_ref().map(|w| w.line)),
        ("processing", written.processing.as_ref().map(|w| w.line)),
    ]
}

/// Whether the motions of floors are given.
pub(super) fn has_measured_floors(building: &BuildingOptions) -> bool {
    building.levels.iter().flat_map(|levels| &levels.value).any(|level| level.motions.is_some())
}

impl Resolver<'_> {
    /// Reads `motions`, and their second components from `across`, as the keys of `[ground]` say.
    pub(super) fn motions(
        &mut self,
        written: &GroundOptions,
        motions: &Files,
        across: &Option<Files>,
    ) -> Option<Vec<RecordedMotion>> {
        let before = self.problems.len();
        let unit_only = ReadOptions { unit: written.unit.clone().map(|unit| unit.value), ..ReadOptions::default() };
        let dt_only = ReadOptions { dt_s: written.dt_s.as_ref().map(|dt| dt.value), ..ReadOptions::default() };
        let lines = [written.unit.as_ref().map(|w| w.line), written.dt_s.as_ref().map(|w| w.line)];
        for ((key, line), options) in ["unit", "dt"].into_iter().zip(lines).zip([&unit_only, &dt_only]) {
            if let Err(problem) = options.check() {
                self.fault(line, key, problem.named(key));
            }
        }
        let processing = self.processing(written);
        if motions.value.is_empty() {
            self.note(Some(motions.line), "motions is empty", "name at least one file, or leave motions out");
            return None;
        }
        self.exclusive(("component", &written.component), ("components", &written.components));
        self.exclusive(("across", across), ("components", &written.components));
        if let Some(across) = across.as_ref().filter(|across| across.value.len() != motions.value.len()) {
            let (first, second) = (motions.value.len(), across.value.len());
            self.note(
                Some(across.line),
                format!("across has {second} files, and motions {first}"),
                "name one file in across for each motion, in the same order",
            );
        }
        // Without the keys that were refused, the files would be refused as well.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let path = |file: &Written<String>| self.base_dir.join(&file.value);
        let second = match (across, &written.components) {
            (Some(files), _) => Second::Files(files.value.iter().map(path).collect()),
            (None, Some(Written { value: ComponentsOption::Both, .. })) => Second::SameFile(None),
            (None, Some(Written { value: ComponentsOption::Named(first, second), .. })) => {
                Second::SameFile(Some((first.clone(), second.clone())))
            }
            (None, None) => Second::None,
        };
        let files = MotionFiles {
            paths: motions.value.iter().map(path).collect(),
            read: ReadOptions {
                unit: unit_only.unit,
                uneven_dt_s: processing.resample_dt_s,
                station_xml: written.station_xml.as_ref().map(|file| self.base_dir.join(&file.value)),
                ..dt_only
            },
            component: written.component.as_ref().map(|w| w.value.clone()),
            second,
            processing,
        };
        let lines: Vec<usize> = motions.value.iter().map(|file| file.line).collect();
        self.read(&files, Some(&lines))
    }

    /// Reads files. `lines`: where the study names them; `None` for files that replace those of the
    /// study.
    pub(super) fn read(&mut self, files: &MotionFiles, lines: Option<&[usize]>) -> Option<Vec<RecordedMotion>> {
        let (motions, failures) = read_recorded(files);
        let all_read = failures.is_empty();
        for (index, problem) in failures {
            match lines {
                Some(lines) => self.fault(lines.get(index).copied(), "motions", problem),
                None => self.problems.push(problem),
            }
        }
        for motion in &motions {
            self.warnings.extend(motion.notes.iter().map(|note| format!("{}: {note}", motion.motion.name)));
        }
        all_read.then(|| motions.into_iter().map(|read| read.motion).collect())
    }

    /// Notes all keys of the ground and the building where the motions of floors are given, since
    /// there is then neither. Every level must have as many motions as the others, and second
    /// components if the others have them.
    pub(super) fn check_measured(
        &mut self,
        ground: &GroundOptions,
        building: &BuildingOptions,
        levels: &[Level],
        overrides: &Overrides,
    ) {
        let motions = [
            ("motions", ground.motions.as_ref().map(|w| w.line)),
            ("across", ground.across.as_ref().map(|w| w.line)),
            ("match", ground.match_by.as_ref().map(|w| w.line)),
        ];
        for (key, line) in synthetic_keys(ground).into_iter().chain(motions).chain(model_keys(building)) {
            if line.is_some() {
                let message = format!("{key} has no effect: the study gives the motions of its floors");
                self.note(line, message, format!("leave {key} or the motions of the levels out"));
            }
        }
        if overrides.motions.is_some() {
            let message = "the motions of the ground cannot be replaced: the study gives the motions of its floors";
            self.note(None, message, "name the files in the levels of the study");
        }
        let written = building.levels.iter().flat_map(|levels| &levels.value);
        for entry in written.filter(|entry| entry.motions.is_none()) {
            let hint = "give every level its motions, or no level";
            self.note(Some(entry.line), "this level has no motions, but others do", hint);
        }
        let line = building.levels.as_ref().map(|levels| levels.line);
        let Some((first, others)) = levels.split_first() else { return };
        for level in others.iter().filter(|level| level.motions.len() != first.motions.len()) {
            let (one, two) = (level.motions.len(), first.motions.len());
            self.note(
                line,
                format!("level \"{}\" has {one} motions, and \"{}\" {two}", level.name, first.name),
                "give every level the same number of motions, with those of one earthquake at the same place in the \
                 lists",
            );
        }
        let all = || levels.iter().flat_map(|level| &level.motions);
        if all().any(|motion| motion.across.is_some()) && all().any(|motion| motion.across.is_none()) {
            let hint = "give across to every level, or to none";
            self.note(line, "some motions have a second component and others do not", hint);
        }
    }

    /// Directions in which every object is tried: one, or those of half a turn if motions have two
    /// components.
    pub(super) fn directions(&mut self, written: &GroundOptions, overrides: &Overrides, two: bool) -> Vec<f64> {
        let line = written.rotation_step_rad.as_ref().map(|w| w.line);
        let given = written.rotation_step_rad.as_ref().map(|step| azimuth_deg(step.value));
        let Some(step_deg) = overrides.rotation_step_deg.or(given) else {
            return if two { half_turn(ROTATION_STEP_DEG) } else { vec![0.0] };
        };
        if !(FINEST_STEP_DEG..=90.0).contains(&step_deg) {
            let message = format!("`rotation_step` must be from {FINEST_STEP_DEG} to 90 degrees, not {step_deg}");
            self.note(line, message, "a step of 15 deg gives twelve directions");
            return vec![0.0];
        }
        if !two {
            let message = "`rotation_step` needs motions with two horizontal components";
            self.note(
                line,
                message,
                "give `components = \"both\"`, or name the files with the second components in `across`",
            );
            return vec![0.0];
        }
        half_turn(step_deg)
    }
}

/// 0 to below 180 degrees: opposite directions are the same, because objects rock both ways.
fn half_turn(step_deg: f64) -> Vec<f64> {
    (0u32..).map(|i| f64::from(i) * step_deg).take_while(|direction_deg| *direction_deg < 180.0 - 1e-9).collect()
}
