//! Reads motions of the ground and of floors from files, as the keys of `[ground]` say.

use crate::options::{BuildingOptions, ComponentsOption, GroundOptions, VerticalOption};
use crate::recorded::{MotionFiles, Second, Upward, read_recorded, refuse_copies};
use crate::study::{Level, RecordedMotion};
use freestand_input::toml_reader::Written;
use freestand_input::word_reader::WordReader;
use freestand_input::words::counted;
use freestand_records::processing::azimuth_deg;

use super::ground::synthetic_keys;
use super::suite::suite_keys;
use super::{Overrides, Resolver};

/// Step between the directions in which every object is tried, unless the study states one
/// \[degrees\].
const DEFAULT_ROTATION_STEP_DEG: f64 = 15.0;
/// Smallest step: each direction costs as much as a study with one component.
const FINEST_STEP_DEG: f64 = 1.0;

/// A list of files.
type Files = Written<Vec<Written<String>>>;

/// The keys that say how files are read, with their lines.
pub(super) fn reading_keys(
    written: &GroundOptions,
) -> impl Iterator<Item = (&'static str, Option<usize>)> {
    let others = [
        ("across", written.across.as_ref().map(|w| w.line)),
        ("components", written.components.as_ref().map(|w| w.line)),
        (
            "rotation_step",
            written.rotation_step_rad.as_ref().map(|w| w.line),
        ),
        ("processing", written.processing),
    ];
    let files = ["unit", "dt", "component", "station_xml", "scale"]
        .map(|key| (key, written.reading.line_of(&[key])));
    files.into_iter().chain(others)
}

/// Whether the motions of floors are given.
pub(super) fn has_measured_floors(building: &BuildingOptions) -> bool {
    building
        .levels
        .iter()
        .flat_map(|levels| &levels.value)
        .any(|level| level.motions.is_some())
}

impl Resolver<'_> {
    /// How records are read and processed; `None` if that was refused.
    pub(super) fn reading(&mut self, written: &GroundOptions) -> Option<MotionFiles> {
        let before = self.problems.len();
        let mut reader = WordReader::new(&written.reading);
        let files = MotionFiles::read(&mut reader, |name| Ok(self.base_dir.join(name)));
        for problem in reader.problems {
            let key = problem.key().unwrap_or_default().to_owned();
            self.fault(written.reading.line_of(&problem.keys), &key, problem);
        }
        (self.problems.len() == before).then_some(files)
    }

    /// Reads `motions`, and their second components from `across`, as the keys of `[ground]` say.
    pub(super) fn motions(
        &mut self,
        written: &GroundOptions,
        motions: &Files,
        across: &Option<Files>,
    ) -> Option<Vec<RecordedMotion>> {
        let before = self.problems.len();
        if motions.value.is_empty() {
            self.note(
                Some(motions.line),
                "motions is empty",
                "name at least one file, or leave motions out",
            );
            return None;
        }
        let component = written
            .reading
            .line_of(&["component"])
            .map(|line| Written { value: (), line });
        self.exclusive(
            ("component", &component),
            ("components", &written.components),
        );
        self.exclusive(("across", across), ("components", &written.components));
        if let Some(across) = across
            .as_ref()
            .filter(|across| across.value.len() != motions.value.len())
        {
            let (first, second) = (motions.value.len(), across.value.len());
            self.note(
                Some(across.line),
                format!(
                    "across names {}, but motions names {}",
                    counted(second, "file"),
                    counted(first, "file")
                ),
                "name one file in across for each motion, in the same order",
            );
        }
        let vertical = match written
            .vertical
            .as_ref()
            .map(|written| (&written.value, written.line))
        {
            None => Upward::None,
            Some((VerticalOption::Record, _)) => Upward::SameFile,
            Some((VerticalOption::Files(files), line)) => {
                if files.len() != motions.value.len() {
                    let (first, second) = (motions.value.len(), files.len());
                    self.note(
                        Some(line),
                        format!(
                            "vertical names {}, but motions names {}",
                            counted(second, "file"),
                            counted(first, "file")
                        ),
                        "name one file in vertical for each motion, in the same order",
                    );
                }
                Upward::Files(
                    files
                        .iter()
                        .map(|file| self.base_dir.join(&file.value))
                        .collect(),
                )
            }
            Some((VerticalOption::Ratio(_) | VerticalOption::Code, line)) => {
                let hint = "write vertical = \"record\" for the vertical components of the files, or name the files";
                self.note(
                    Some(line),
                    "records are not matched to a vertical spectrum",
                    hint,
                );
                Upward::None
            }
        };
        // Without the keys that were refused, the files would be refused as well.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let reading = self.reading.clone()?;
        let path = |file: &Written<String>| self.base_dir.join(&file.value);
        let second = match (across, &written.components) {
            (Some(files), _) => Second::Files(files.value.iter().map(path).collect()),
            (
                None,
                Some(Written {
                    value: ComponentsOption::Both,
                    ..
                }),
            ) => Second::SameFile(None),
            (
                None,
                Some(Written {
                    value: ComponentsOption::Named(first, second),
                    ..
                }),
            ) => Second::SameFile(Some((first.clone(), second.clone()))),
            (None, None) => Second::None,
        };
        let files = MotionFiles {
            paths: motions.value.iter().map(path).collect(),
            second,
            vertical,
            ..reading
        };
        let lines: Vec<usize> = motions.value.iter().map(|file| file.line).collect();
        self.read(&files, Some(&lines))
    }

    /// Reads files. `lines`: where the study names them; `None` for files that replace those of the
    /// study.
    pub(super) fn read(
        &mut self,
        files: &MotionFiles,
        lines: Option<&[usize]>,
    ) -> Option<Vec<RecordedMotion>> {
        let (motions, failures) = read_recorded(files);
        let all_read = failures.is_empty();
        for (index, problem) in failures {
            match lines {
                Some(lines) => self.fault(lines.get(index).copied(), "motions", problem),
                None => self.problems.push(problem),
            }
        }
        self.take_notes(&motions);
        if let Err(problem) = refuse_copies(motions.iter().map(|read| read.motion.samples())) {
            match lines {
                Some(lines) => self.fault(lines.first().copied(), "motions", problem),
                None => self.problems.push(problem),
            }
            return None;
        }
        all_read.then(|| motions.into_iter().map(|read| read.motion).collect())
    }

    /// Checks a study that gives the motions of its floors. Ground and building are then not used,
    /// so all their keys are noted. Every level must have as many motions as the others, and second
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
            ("suite", ground.suite.as_ref().map(|w| w.line)),
            ("vertical", ground.vertical.as_ref().map(|w| w.line)),
        ];
        // Those of the second axis are in `across`.
        let model_keys = building
            .words
            .lines()
            .filter(|(key, _)| !key.starts_with("across_"));
        let of_ground = synthetic_keys(ground)
            .into_iter()
            .chain(motions)
            .chain(suite_keys(ground));
        for (key, line) in of_ground.chain(model_keys) {
            if line.is_some() {
                let message =
                    format!("{key} has no effect: the study gives the motions of its floors");
                self.note(
                    line,
                    message,
                    format!("leave {key} or the motions of the levels out"),
                );
            }
        }
        if overrides.motions.is_some() {
            let message = "the motions of the ground cannot be replaced: the study gives the motions of its floors";
            self.note(None, message, "name the files in the levels of the study");
        }
        let written = building.levels.iter().flat_map(|levels| &levels.value);
        for entry in written.filter(|entry| entry.motions.is_none()) {
            let hint = "give every level its motions, or no level";
            self.note(
                Some(entry.line),
                "this level has no motions, but others do",
                hint,
            );
        }
        let line = building.levels.as_ref().map(|levels| levels.line);
        // A level without motions was told above, or its files could not be read.
        let mut with_motions = levels.iter().filter(|level| !level.motions.is_empty());
        let Some(first) = with_motions.next() else {
            return;
        };
        for level in with_motions.filter(|level| level.motions.len() != first.motions.len()) {
            let (one, two) = (level.motions.len(), first.motions.len());
            self.note(
                line,
                format!(
                    "level \"{}\" has {}, but level \"{}\" has {}",
                    level.name,
                    counted(one, "motion"),
                    first.name,
                    counted(two, "motion")
                ),
                "give every level the same number of motions, with those of one earthquake at the same place in the \
                 lists",
            );
        }
        let all = || levels.iter().flat_map(|level| &level.motions);
        if all().any(|motion| motion.across.is_some())
            && all().any(|motion| motion.across.is_none())
        {
            let hint = "give across to every level, or to none";
            self.note(
                line,
                "some motions have a second component and others do not",
                hint,
            );
        }
    }

    /// Directions in which every object is tried: one, or those of half a turn if motions have two
    /// components.
    pub(super) fn directions(
        &mut self,
        written: &GroundOptions,
        overrides: &Overrides,
        two: bool,
    ) -> Vec<f64> {
        let line = written.rotation_step_rad.as_ref().map(|w| w.line);
        let given = written
            .rotation_step_rad
            .as_ref()
            .map(|step| azimuth_deg(step.value));
        let Some(step_deg) = overrides.rotation_step_deg.or(given) else {
            return if two {
                half_turn(DEFAULT_ROTATION_STEP_DEG)
            } else {
                vec![0.0]
            };
        };
        if !(FINEST_STEP_DEG..=90.0).contains(&step_deg) {
            let message = format!(
                "`rotation_step` must be from {FINEST_STEP_DEG} to 90 degrees, not {step_deg}"
            );
            self.note(
                line,
                message,
                "give a step such as \"15 deg\", which makes twelve directions",
            );
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
    (0u32..)
        .map(|i| f64::from(i) * step_deg)
        .take_while(|direction_deg| *direction_deg < 180.0 - 1e-9)
        .collect()
}
