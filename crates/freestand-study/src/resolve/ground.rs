//! `[ground]` as meant.

use super::recorded::reading_keys;
use super::{MAX_MOTIONS, Overrides, Resolver, or};
use crate::options::GroundOptions;
use crate::study::{Ground, SyntheticGround};
use crate::target::{Target, TargetProblem, TargetWords};

impl Resolver<'_> {
    pub(super) fn ground(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        if let Some(files) = &overrides.motions {
            return self.read(files, None).map(Ground::Recorded);
        }
        let Some(motions) = &written.motions else {
            for (key, line) in reading_keys(written) {
                if line.is_some() {
                    self.note(line, format!("{key} goes with motions"), "name the files: motions = [\"record.AT2\"]");
                }
            }
            return self.synthetic(written, overrides);
        };
        for (key, line) in synthetic_keys(written) {
            if let Some(line) = line {
                let message = format!("{key} and motions exclude each other");
                self.note(Some(line.max(motions.line)), message, "keep one of them");
            }
        }
        self.motions(written, motions, &written.across).map(Ground::Recorded)
    }

    fn synthetic(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        self.require(
            &written.count,
            |count| (1..=MAX_MOTIONS).contains(&count),
            "count",
            "a whole number from 1 to 1000",
        );
        let target = self.target(written)?;
        self.warnings.extend(target.warnings.iter().cloned());
        // Beyond, the count was refused above; its names are still listed.
        let count = usize::try_from(or(&written.count, 10).min(MAX_MOTIONS)).unwrap_or_default();
        Some(Ground::Synthetic(SyntheticGround { target, count, seed: overrides.seed.unwrap_or(or(&written.seed, 1)) }))
    }

    fn target(&mut self, written: &GroundOptions) -> Option<Target> {
        let mut words = TargetWords::default();
        for (key, text) in &written.target {
            words.set(key, text.value.clone());
        }
        let resolved = Target::resolve(&words, self.base_dir).and_then(|target| {
            let hold = words.example("beyond", "hold");
            let short = |problem| vec![TargetProblem { keys: vec!["spectrum"], problem, is_missing: false }];
            target.check_matched_band(&hold).map_err(short).map(|()| target)
        });
        match resolved {
            Ok(target) => Some(target),
            Err(problems) => {
                // A key that was refused when it was read is missing here, and was noted there.
                let mut problems = problems;
                problems.retain(|problem| !(written.is_incomplete && problem.is_missing));
                problems.into_iter().for_each(|problem| self.target_problem(written, problem));
                None
            }
        }
    }

    /// A fault in the file of a table has its own line there; all else is the fault of a line of the study.
    fn target_problem(&mut self, written: &GroundOptions, TargetProblem { keys, problem, .. }: TargetProblem) {
        if problem.line.is_some() {
            self.problems.push(problem);
            return;
        }
        let lines = written.target.iter().filter(|(key, _)| keys.contains(key)).map(|(_, text)| text.line);
        let message = match &problem.path {
            Some(_) => format!("spectrum: {problem}"),
            None => problem.message.clone(),
        };
        let line = lines.max().or(written.line);
        self.note(line, message, problem.hint.unwrap_or_default());
    }
}

/// The keys of `[ground]` that describe synthetic motions, with their lines.
pub(super) fn synthetic_keys(written: &GroundOptions) -> Vec<(&'static str, Option<usize>)> {
    let target = written.target.iter().map(|(key, text)| (*key, Some(text.line)));
    let others = [("count", written.count.as_ref().map(|w| w.line)), ("seed", written.seed.as_ref().map(|w| w.line))];
    target.chain(others).collect()
}
