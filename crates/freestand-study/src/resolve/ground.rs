//! Resolves `[ground]`.

use freestand::synthesis::{MatchedMotion, Resemblance};
use rayon::prelude::*;

use super::ground_keys::{SCALES_TO, other, reading_keys, source_line, suite_keys, synthetic_keys};
use super::{MAX_MOTIONS, Overrides, Resolver, Values, line, or};
use crate::matched::{MatchMethod, Matched, match_record};
use crate::near_fault::{near_fault, spectrum_words};
use crate::options::{GroundOptions, VerticalOption};
use crate::study::{
    BuildingInput, DEFAULT_MOTIONS, DEFAULT_SEED, Ground, Level, RecordedMotion, StudyDoubt,
    SyntheticGround, VerticalTarget,
};
use crate::target::Target;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::Written;

/// Largest ratio of the vertical spectrum to the horizontal one: near a fault it reaches 1 to 2 at short
/// periods; more is a mistake.
const MAX_VERTICAL_RATIO: f64 = 3.0;

impl Resolver<'_> {
    /// `building` and `levels` are those that the motions pass through: a suite has their periods.
    pub(super) fn ground(
        &mut self,
        written: &GroundOptions,
        overrides: &Overrides,
        building: Option<&BuildingInput>,
        levels: &[Level],
    ) -> Option<Ground> {
        if let Some(files) = &overrides.motions {
            if written.vertical.is_some() {
                self.doubts.push(StudyDoubt::VerticalUnused);
            }
            return self.read(files, None).map(Ground::Recorded);
        }
        if let Some(folder) = &written.suite {
            self.without_vertical(
                written,
                "the records of a suite are selected by their horizontal components",
            );
            return self
                .suite(written, folder, building, levels)
                .map(Ground::Recorded);
        }
        self.needing(
            "suite",
            suite_keys(written),
            "name the folder of the records: suite = \"records\"",
        );
        let Some(motions) = &written.motions else {
            self.needing(
                "motions",
                reading_keys(written),
                "name the files, such as motions = [\"record.AT2\"]",
            );
            let hint = "name the records, such as motions = [\"record.AT2\"]; synthetic motions need no match";
            self.needing("motions", [("match", line(&written.match_by))], hint);
            return match &written.point_source {
                Some(source) => {
                    self.without_vertical(written, "simulated motions are horizontal");
                    self.simulated(written, source, overrides)
                        .map(Ground::Simulated)
                }
                None => self.synthetic(written, overrides),
            };
        };
        if let Some(by) = &written.match_by {
            self.without_vertical(written, "matching changes the horizontal component only");
            return self.matched(written, motions, by).map(Ground::Recorded);
        }
        for (key, line) in synthetic_keys(written) {
            if let Some(line) = line {
                let message = format!("{key} and motions exclude each other");
                let hint = match key {
                    "count" | "seed" | "point_source" => "keep one of them",
                    _ => {
                        "keep one of them, or match the records to the spectrum with match = \"wavelet\""
                    }
                };
                self.note(Some(line.max(motions.line)), message, hint);
            }
        }
        self.motions(written, motions, &written.across)
            .map(Ground::Recorded)
    }

    /// The ground by the other spectrum of a national annex: its records are selected or matched again. Of what is
    /// said about it, only what was not said of the first is new.
    pub(super) fn ground_of_type(
        &mut self,
        spectrum_type: u8,
        written: &GroundOptions,
        overrides: &Overrides,
        building: Option<&BuildingInput>,
        levels: &[Level],
    ) -> Option<Ground> {
        let (doubts, notes, problems) = (self.doubts.len(), self.notes.len(), self.problems.len());
        let mut written = written.clone();
        written
            .target
            .set("spectrum_type", spectrum_type.to_string());
        let ground = self.ground(&written, overrides, building, levels);
        let mut new = self.doubts.split_off(doubts);
        new.retain(|one| !self.doubts.contains(one));
        let of_type = |doubt| StudyDoubt::OfType {
            number: spectrum_type,
            doubt: Box::new(doubt),
        };
        self.doubts.extend(new.into_iter().map(of_type));
        for note in self.notes.split_off(notes) {
            if !self.notes.contains(&note) {
                self.notes.push(note);
            }
        }
        for problem in self.problems.problems.iter_mut().skip(problems) {
            let message = &problem.message;
            problem.message = format!("with the spectrum of type {spectrum_type}: {message}");
        }
        ground
    }

    /// Records, each matched to the target.
    fn matched(
        &mut self,
        written: &GroundOptions,
        motions: &Written<Vec<Written<String>>>,
        by: &Written<String>,
    ) -> Option<Vec<RecordedMotion>> {
        let before = self.problems.len();
        let method = by.value.trim().parse::<MatchMethod>().ok();
        if method.is_none() {
            let message = format!("match \"{}\" is not known", shorten(&by.value));
            self.note(Some(by.line), message, "use wavelet or fft");
        }
        self.match_problems(written, by);
        let target = self.target(written);
        if self.problems.len() > before {
            return None;
        }
        let (method, target) = (method?, target?);
        self.doubt_target(&target);
        let mut records = self.motions(written, motions, &None)?;
        let matched: Vec<_> = records
            .par_iter()
            .map(|record| match_record(&record.motion, &target, method))
            .collect();
        for (record, matched) in records.iter_mut().zip(matched) {
            match matched {
                Ok(MatchedMotion { motion, misfit, .. }) => {
                    let resemblance = Resemblance::between(&record.motion, &motion);
                    let matched = Matched {
                        method,
                        target: target.clone(),
                        misfit,
                        resemblance,
                    };
                    record.processing.push(matched.words());
                    record.motion = motion;
                    record.matched = Some(matched);
                }
                Err(problem) => self
                    .problems
                    .push(problem.in_file(&record.path).shown(KeyStyle::File)),
            }
        }
        (self.problems.len() == before).then_some(records)
    }

    /// Keeps what the reader must know of a spectrum.
    pub(super) fn doubt_target(&mut self, target: &Target) {
        let doubts = target.doubts.iter().cloned();
        self.doubts.extend(doubts.map(StudyDoubt::Target));
    }

    /// Notes keys that have no meaning, or contradict the target, where records are matched.
    fn match_problems(&mut self, written: &GroundOptions, by: &Written<String>) {
        let one = (
            "only one component of a record is matched",
            "choose one with component; or match each component with the command motion match, and name the files \
             that it writes in motions and across",
        );
        let sets = other("the target sets the amplitudes");
        let keys = [
            (
                "count",
                line(&written.count),
                other("each record gives one motion"),
            ),
            (
                "seed",
                line(&written.seed),
                other("a record has no random numbers"),
            ),
            (
                "point_source",
                source_line(written),
                other("the records replace it"),
            ),
            ("scale", written.reading.line_of(&["scale"]), sets),
            ("scale_to", written.reading.line_of(&SCALES_TO), sets),
            ("across", line(&written.across), one),
            ("components", line(&written.components), one),
        ];
        self.refuse_beside("match", by.line, keys);
    }

    /// Notes keys that another one excludes, each with why and what to do.
    pub(super) fn refuse_beside(
        &mut self,
        of: &str,
        at: usize,
        keys: impl IntoIterator<Item = (&'static str, Option<usize>, (&'static str, &'static str))>,
    ) {
        for (key, line, (why, hint)) in keys {
            if let Some(line) = line {
                let message = format!("{key} and {of} exclude each other: {why}");
                self.note(Some(line.max(at)), message, hint);
            }
        }
    }

    /// Notes keys without the one that they need.
    fn needing(
        &mut self,
        needed: &str,
        keys: impl IntoIterator<Item = (&'static str, Option<usize>)>,
        hint: &str,
    ) {
        for (key, line) in keys {
            if line.is_some() {
                self.note(line, format!("{key} needs {needed}"), hint);
            }
        }
    }

    fn synthetic(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        let given = self.values.and_then(|values| values.count).map(u64::from);
        let count = given.unwrap_or(or(&written.count, DEFAULT_MOTIONS));
        if !(1..=MAX_MOTIONS).contains(&count) {
            let expected = "a whole number from 1 to 1000";
            self.note(
                line(&written.count),
                format!("count must be {expected}, not {count}"),
                format!("give count as {expected}"),
            );
        }
        let of_spectrum = GroundOptions {
            target: spectrum_words(&written.target),
            ..written.clone()
        };
        let target = self.target(&of_spectrum)?;
        let fault = near_fault(&written.target, Some(&target));
        let fault = fault.map_err(|problems| self.spectrum_faults(written, problems));
        let near_fault = fault.ok()?;
        let vertical = self.vertical_target(written, &target);
        self.doubt_target(&target);
        // A larger count was refused above; the names of its motions are still listed.
        let count = usize::try_from(count.min(MAX_MOTIONS)).unwrap_or_default();
        Some(Ground::Synthetic(SyntheticGround {
            target,
            count,
            seed: overrides.seed.unwrap_or(or(&written.seed, DEFAULT_SEED)),
            vertical,
            near_fault,
        }))
    }

    /// Notes `vertical` where there is no vertical motion.
    fn without_vertical(&mut self, written: &GroundOptions, why: &str) {
        if let Some(vertical) = &written.vertical {
            self.note(
                Some(vertical.line),
                format!("vertical has no effect here: {why}"),
                "leave vertical out",
            );
        }
    }

    /// The vertical target of synthetic motions: none unless the study has one.
    fn vertical_target(&mut self, written: &GroundOptions, target: &Target) -> VerticalTarget {
        let Some(Written { value, line }) = &written.vertical else {
            return VerticalTarget::None;
        };
        let (message, hint) = match value {
            VerticalOption::Ratio(0.0) => return VerticalTarget::None,
            VerticalOption::Ratio(ratio) if *ratio > 0.0 && *ratio <= MAX_VERTICAL_RATIO => {
                return VerticalTarget::Ratio(*ratio);
            }
            VerticalOption::Code if target.spectrum.vertical_sa_g(0.0).is_some() => {
                return VerticalTarget::Code;
            }
            VerticalOption::Ratio(ratio) => (
                format!("vertical must be from 0 to {MAX_VERTICAL_RATIO}, not {ratio}"),
                "give the vertical spectrum as a share of the horizontal one, such as vertical = 0.67",
            ),
            VerticalOption::Code => (
                format!(
                    "the vertical spectrum of {} is not known to this program",
                    target.spectrum.name()
                ),
                "give a share of the horizontal spectrum, such as vertical = 0.67",
            ),
            VerticalOption::Record | VerticalOption::Files(_) => (
                "vertical names records, but the motions are synthetic".to_owned(),
                "name the horizontal records in motions, or give a share of the spectrum, such as vertical = 0.67",
            ),
        };
        self.note(Some(*line), message, hint);
        VerticalTarget::None
    }

    pub(super) fn target(&mut self, written: &GroundOptions) -> Option<Target> {
        self.target_with(written, Target::check_matched_band)
    }

    /// The target, if `check` accepts it; what it refuses is the fault of `spectrum`.
    pub(super) fn target_with(
        &mut self,
        written: &GroundOptions,
        check: impl Fn(&Target) -> Result<(), Problem>,
    ) -> Option<Target> {
        let target = match self.values.and_then(Values::spectrum) {
            Some(target) => Ok(target.clone()),
            None if self.has_place_alone => Target::resolve_place(&written.target),
            None => Target::resolve(&written.target, self.base_dir),
        };
        let resolved = target.and_then(|target| {
            check(&target).map_err(|problem| problem.of(&["spectrum"]))?;
            Ok(target)
        });
        match resolved {
            Ok(target) => Some(target),
            Err(problems) => {
                self.spectrum_faults(written, problems);
                None
            }
        }
    }

    /// Notes what is wrong with the keys of the spectrum and of its fault, each on its line.
    fn spectrum_faults(&mut self, written: &GroundOptions, problems: Problems) {
        for problem in problems {
            // A key that was refused when it was read is missing here, and was noted there.
            if written.is_incomplete && problem.kind == ProblemKind::Missing {
                continue;
            }
            // What a flag put in place of the study's is on no line of it.
            let is_flag = |(key, line): (&'static str, Option<usize>)| {
                line.is_none() && problem.is_about(key)
            };
            if written.target.lines().any(is_flag) {
                let hint = problem
                    .hint
                    .as_deref()
                    .map(|hint| KeyStyle::File.shown(hint));
                self.problems.push(Problem { hint, ..problem });
                continue;
            }
            let line = written.target.line_of(&problem.keys).or(written.line);
            self.fault(line, "spectrum", problem);
        }
    }
}
