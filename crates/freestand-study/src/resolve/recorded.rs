//! Reads motions of the ground and of floors from files, as the keys of `[ground]` say.

use crate::options::{BuildingOptions, ComponentsOption, GroundOptions, VerticalOption};
use crate::recorded::{MotionFiles, Second, Upward, read_recorded, refuse_copies};
use crate::study::{Level, RecordedMotion};
use freestand_input::toml_reader::Written;
use freestand_input::word_reader::WordReader;
use freestand_input::words::counted;
use freestand_records::processing::azimuth_deg;

use super::ground_keys::{suite_keys, synthetic_keys};
use super::{Overrides, Resolver, line, stated};

/// Step between the directions in which every object is tried, unless the study states one
/// \[degrees\].
const DEFAULT_ROTATION_STEP_DEG: f64 = 15.0;
/// Smallest step: each direction costs as much as a study with one component.
const FINEST_STEP_DEG: f64 = 1.0;

/// A list of files.
type Files = Written<Vec<Written<String>>>;

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
        self.one_component(written);
        self.exclusive(("across", across), ("components", &written.components));
        let mut one_each = |key: &str, line: usize, files: &[Written<String>]| {
            let (first, second) = (motions.value.len(), files.len());
            if first != second {
                self.note(
                    Some(line),
                    format!(
                        "{key} names {}, but motions names {}",
                        counted(second, "file"),
                        counted(first, "file")
                    ),
                    format!("name one file in {key} for each motion, in the same order"),
                );
            }
        };
        if let Some(across) = across {
            one_each("across", across.line, &across.value);
        }
        let vertical = match written
            .vertical
            .as_ref()
            .map(|written| (&written.value, written.line))
        {
            None => Upward::None,
            Some((VerticalOption::Record, _)) => Upward::SameFile,
            Some((VerticalOption::Files(files), line)) => {
                one_each("vertical", line, files);
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
        let second = match across {
            Some(files) => Second::Files(files.value.iter().map(path).collect()),
            None => same_file(written),
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
        let mut fault = |index: usize, problem| match lines {
            Some(lines) => self.fault(lines.get(index).copied(), "motions", problem),
            None => self.problems.push(problem),
        };
        failures
            .into_iter()
            .for_each(|(index, problem)| fault(index, problem));
        let copies = refuse_copies(motions.iter().map(|read| read.motion.samples()));
        let is_refused = copies.map_err(|problem| fault(0, problem)).is_err();
        self.take_notes(&motions);
        if is_refused {
            return None;
        }
        all_read.then(|| motions.into_iter().map(|read| read.motion).collect())
    }

    /// Refuses one component of a file where two are asked for.
    pub(super) fn one_component(&mut self, written: &GroundOptions) {
        let line = written.reading.line_of(&["component"]);
        let component = line.map(|line| Written { value: (), line });
        self.exclusive(
            ("component", &component),
            ("components", &written.components),
        );
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
            ("motions", line(&ground.motions)),
            ("across", line(&ground.across)),
            ("match", line(&ground.match_by)),
            ("suite", line(&ground.suite)),
            ("vertical", line(&ground.vertical)),
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
        let line = line(&building.levels);
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
        let line = line(&written.rotation_step_rad);
        let given = stated(&written.rotation_step_rad).map(azimuth_deg);
        let one = vec![0.0];
        let Some(step_deg) = overrides.rotation_step_deg.or(given) else {
            return if two {
                half_turn(DEFAULT_ROTATION_STEP_DEG)
            } else {
                one
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
            return one;
        }
        if !two {
            let message = "`rotation_step` needs motions with two horizontal components";
            self.note(
                line,
                message,
                "give `components = \"both\"`, or name the files with the second components in `across`",
            );
            return one;
        }
        half_turn(step_deg)
    }
}

/// The second components in the files of the first, as `components` asks for them.
pub(super) fn same_file(written: &GroundOptions) -> Second {
    match written.components.as_ref().map(|written| &written.value) {
        Some(ComponentsOption::Both) => Second::SameFile(None),
        Some(ComponentsOption::Named(first, second)) => {
            Second::SameFile(Some((first.clone(), second.clone())))
        }
        None => Second::None,
    }
}

/// 0 to below 180 degrees: opposite directions are the same, because objects rock both ways.
fn half_turn(step_deg: f64) -> Vec<f64> {
    (0u32..)
        .map(|i| f64::from(i) * step_deg)
        .take_while(|direction_deg| *direction_deg < 180.0 - 1e-9)
        .collect()
}
