//! Resolves `suite` of `[ground]`: records selected from a folder.

use std::sync::Arc;

use freestand::building::Building;
use freestand::motion::{Motion, MotionError};
use freestand::suite::SuiteScale;
use freestand_input::file::file_name;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::Written;
use freestand_input::words::{counted, number, some};
use freestand_records::processing::short_period_warning;
use rayon::prelude::*;

use super::ground_keys::{SCALES_TO, other, source_line};
use super::recorded::same_file;
use super::{MAX_MOTIONS, Resolver, line};
use crate::options::GroundOptions;
use crate::recorded::{Folder, MotionFiles, ReadMotion, read_folder};
use crate::study::{BuildingInput, Level, RecordedMotion, StudyDoubt};
use crate::suite::{
    DEFAULT_MOST, DEFAULT_SCALE, LeftOut, NAMED, PeriodRange, Record, Request, Spectra, Suite,
    select, some_left_out,
};
use crate::target::Target;

impl Resolver<'_> {
    /// The records of a folder that together fit the target, scaled.
    pub(super) fn suite(
        &mut self,
        written: &GroundOptions,
        folder: &Written<String>,
        building: Option<&BuildingInput>,
        levels: &[Level],
    ) -> Option<Vec<RecordedMotion>> {
        let before = self.problems.len();
        self.suite_conflicts(written, folder);
        let is_count = |count| (2..=MAX_MOTIONS).contains(&count);
        self.require(
            &written.suite_count,
            is_count,
            "suite_count",
            "a whole number from 2 to 1000",
        );
        let scale = self.suite_scale(written);
        if !written.is_incomplete && written.target.entries().next().is_none() {
            let hint = "say which spectrum the records are to fit, such as code = \"eurocode8\" with its keys";
            self.note(Some(folder.line), "suite needs a code spectrum", hint);
        }
        // A building that was refused was noted; its period is not known.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let range = period_range(building?, levels);
        let target = self.target_with(written, |target| covers(target, &range))?;
        self.doubt_target(&target);
        let files = self.suite_files(written)?;
        let path = self.base_dir.join(&folder.value);
        let found = match read_folder(&path, &files) {
            Ok(found) => found,
            Err(problem) => {
                self.fault(Some(folder.line), "suite", problem);
                return None;
            }
        };
        let count = written
            .suite_count
            .as_ref()
            .and_then(|count| usize::try_from(count.value).ok());
        let selected = Request::new(path, target, scale, range)
            .map_err(|error| {
                Problem::value(error.to_string(), "check the spectrum and the building")
            })
            .and_then(|request| chosen(request, count, found, &folder.value))
            .and_then(|(suite, members)| {
                let of_suite = suite.doubts().into_iter();
                self.doubts.extend(of_suite.map(StudyDoubt::Suite));
                self.doubt_members(&suite, &members);
                scaled(suite, members)
            });
        selected
            .map_err(|problem| {
                // Only a number that is too large is the fault of its own line.
                let line = line(&written.suite_count).filter(|_| problem.is_about("suite_count"));
                self.fault(line.or(Some(folder.line)), "suite", problem);
            })
            .ok()
    }

    /// Notes keys that contradict a suite.
    fn suite_conflicts(&mut self, written: &GroundOptions, folder: &Written<String>) {
        let sets = other("the target sets the amplitudes");
        let keys = [
            (
                "motions",
                line(&written.motions),
                other("the records come from the folder"),
            ),
            (
                "match",
                line(&written.match_by),
                other("the records are scaled and not matched"),
            ),
            (
                "point_source",
                source_line(written),
                other("the records replace it"),
            ),
            (
                "count",
                line(&written.count),
                (
                    "a suite has its own number",
                    "give the number of records as suite_count",
                ),
            ),
            (
                "seed",
                line(&written.seed),
                other("a record has no random numbers"),
            ),
            (
                "across",
                line(&written.across),
                (
                    "two components of one record are found by their names",
                    "leave across out",
                ),
            ),
            ("scale", written.reading.line_of(&["scale"]), sets),
            ("scale_to", written.reading.line_of(&SCALES_TO), sets),
        ];
        self.refuse_beside("suite", folder.line, keys);
        self.one_component(written);
    }

    fn suite_scale(&mut self, written: &GroundOptions) -> SuiteScale {
        let Some(Written { value, line }) = &written.suite_scale else {
            return DEFAULT_SCALE;
        };
        let named = value.trim().parse().ok();
        if named.is_none() {
            let message = format!("suite_scale \"{}\" is not known", shorten(value));
            self.note(
                Some(*line),
                message,
                "use each (a factor for each record) or one (the same for all)",
            );
        }
        named.unwrap_or(DEFAULT_SCALE)
    }

    /// How the files of the folder are read.
    fn suite_files(&self, written: &GroundOptions) -> Option<MotionFiles> {
        Some(MotionFiles {
            second: same_file(written),
            ..self.reading.clone()?
        })
    }

    /// What the readers of the chosen records noted, and periods for which a record is too coarse.
    fn doubt_members(&mut self, suite: &Suite, members: &[(ReadMotion, f64)]) {
        self.take_notes(members.iter().map(|(read, _)| read));
        let coarsest_s = members
            .iter()
            .map(|(read, _)| read.motion.motion.dt_s())
            .fold(0.0, f64::max);
        let few = short_period_warning("the suite", &suite.periods_s, coarsest_s);
        let few = few.map(|few| KeyStyle::File.shown(&few));
        self.doubts.extend(few.map(StudyDoubt::OfRecords));
    }
}

/// The periods of the study's building, where a floor above the ground is of interest.
fn period_range(building: &BuildingInput, levels: &[Level]) -> PeriodRange {
    let is_above = |level: &Level| level.level_ratio.is_none_or(|ratio| ratio > 0.0);
    let along_s = building.along.period_s();
    let across_s = building.across.as_ref().map_or(along_s, Building::period_s);
    PeriodRange::new(
        levels
            .iter()
            .any(is_above)
            .then(|| (along_s.min(across_s), along_s.max(across_s))),
    )
}

/// Refuses a target that does not cover the periods of a suite.
fn covers(target: &Target, range: &PeriodRange) -> Result<(), Problem> {
    let first_s = target.spectrum.shortest_period_s();
    let last_s = target.spectrum.longest_period_s().unwrap_or(f64::INFINITY);
    if first_s <= range.from_s && last_s >= range.to_s {
        return Ok(());
    }
    let [first, last, from, to] =
        [first_s, last_s, range.from_s, range.to_s].map(|period_s| number(period_s, 4));
    let message = format!(
        "the spectrum covers {first} s to {last} s, but records are selected from {from} s to {to} s ({})",
        range.from
    );
    let hint = "add the missing periods, or give `beyond = \"hold\"` for constant Sa below the first period and \
                constant displacement beyond the last";
    Err(Problem::value(message, hint))
}

/// The suite and its records, not yet scaled, with their factors.
fn chosen(
    request: Request,
    count: Option<usize>,
    found: Folder,
    folder: &str,
) -> Result<(Suite, Vec<(ReadMotion, f64)>), Problem> {
    let Folder {
        motions,
        mut left_out,
        skipped,
    } = found;
    let spectra: Vec<Result<Spectra, String>> = motions
        .par_iter()
        .map(|read| request.spectra(&read.motion.as_used()))
        .collect();
    let (mut kept, mut records) = (Vec::new(), Vec::new());
    for (read, spectra) in motions.into_iter().zip(spectra) {
        match spectra {
            Ok(spectra) => {
                records.push(Record {
                    name: read.motion.name.clone(),
                    spectra,
                });
                kept.push(Some(read));
            }
            Err(reason) => {
                let file = file_name(&read.motion.path).unwrap_or_default();
                left_out.push(LeftOut { file, reason });
            }
        }
    }
    left_out.sort_by(|a, b| a.file.cmp(&b.file));
    let usable = records.len();
    let because = because(usable, &left_out, &skipped);
    if let Some(count) = count.filter(|&count| count > usable && usable > 1) {
        let can = counted(usable, "record");
        let message = format!(
            "`suite_count` asks for {count} records, but {can} of {folder} can be used{because}"
        );
        let hint = format!("give at most {usable}, or leave `suite_count` out");
        return Err(Problem::value(message, hint).of(&["suite_count"]));
    }
    let hint = "give a folder with record files that can be read as `unit`, `dt` and the other keys say, and that need \
                no factor outside 0.25 to 4";
    let refused = |message: String| Problem::value(message + &because, hint);
    match usable {
        0 => {
            return Err(refused(format!(
                "no record of the folder {folder} can be used"
            )));
        }
        1 => {
            return Err(refused(format!(
                "a suite needs two records, but only one of {folder} can be used"
            )));
        }
        _ => {}
    }
    let (mut suite, members) = select(request, &records, count.unwrap_or(usable.min(DEFAULT_MOST)))
        .map_err(|error| refused(format!("no suite can be selected from {folder}: {error}")))?;
    (suite.left_out, suite.skipped) = (left_out, skipped);
    let taken = members
        .iter()
        .filter_map(|&(index, factor)| Some((kept.get_mut(index)?.take()?, factor)));
    Ok((suite, taken.collect()))
}

/// Why files cannot be used, at the end of a sentence.
fn because(usable: usize, left_out: &[LeftOut], skipped: &[String]) -> String {
    let left_out = (!left_out.is_empty()).then(|| some_left_out(left_out));
    let skipped = (!skipped.is_empty())
        .then(|| format!("not records of horizontal motion: {}", some(skipped, NAMED)));
    let reasons: Vec<String> = left_out.into_iter().chain(skipped).collect();
    match (reasons.as_slice(), usable) {
        ([], 0) => " (it has no files)".to_owned(),
        ([], _) => String::new(),
        _ => format!(" ({})", reasons.join("; ")),
    }
}

/// The motions, multiplied by their factors.
fn scaled(suite: Suite, members: Vec<(ReadMotion, f64)>) -> Result<Vec<RecordedMotion>, Problem> {
    let suite = Arc::new(suite);
    let one = |(read, factor): (ReadMotion, f64)| {
        let mut record = read.motion;
        let times = |motion: &Motion| {
            let refused = |error: MotionError| {
                Problem::value(error.to_string(), "leave the record out of the folder")
            };
            motion
                .scaled(factor)
                .map_err(|error| refused(error).in_file(&record.path))
        };
        let motion = times(&record.motion)?;
        let across = record
            .across
            .as_ref()
            .map(|second| times(&second.motion))
            .transpose()?;
        record.motion = motion;
        if let (Some(second), Some(motion)) = (&mut record.across, across) {
            second.motion = motion;
        }
        record.scale_ratio *= factor;
        record
            .processing
            .push(format!("multiplied by {} for the suite", number(factor, 6)));
        record.suite = Some(Arc::clone(&suite));
        Ok(record)
    };
    members.into_iter().map(one).collect()
}
