//! The cushion of `[objects]`: its words, or those of the cushion file that they name.

use super::Resolver;
use crate::cushion::{CushionWords, EdgeCushion, KeyProblem, read_cushion_file};
use crate::options::CushionOptions;
use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

/// The pads of Al Abadi et al., two under an edge.
const BUILTIN: &str = "4380 N/mm";

impl Resolver<'_> {
    pub(super) fn cushion(
        &mut self,
        written: &CushionOptions,
        mass_kg: f64,
    ) -> Option<(EdgeCushion, Option<(InputFile, CushionWords)>)> {
        let mut words = CushionWords::default();
        for (key, text) in written {
            words.set(key, text.value.clone());
        }
        let mut file = None;
        if let Some(name) = words.get("cushion") {
            let (pad, input) = match read_cushion_file(&self.base_dir.join(name)) {
                Ok(read) => read,
                Err(error) => {
                    for problem in error.problems {
                        self.file_problem(written, name, problem);
                    }
                    return None;
                }
            };
            words = match words.with_file(pad) {
                Ok(words) => words,
                Err(problem) => {
                    self.key_problem(written, problem);
                    return None;
                }
            };
            file = Some((input, words.clone()));
        } else if !["stiffness", "pad_stiffness", "law"].iter().any(|key| words.get(key).is_some()) {
            words.set("stiffness", BUILTIN);
        }
        match words.resolve(Some(mass_kg)) {
            Ok(cushion) => Some((cushion, file)),
            Err(problems) => {
                problems.into_iter().for_each(|problem| self.key_problem(written, problem));
                None
            }
        }
    }

    /// A fault in the cushion file has its own line there; a file that cannot be read is the fault of the study's line.
    fn file_problem(&mut self, written: &CushionOptions, name: &str, problem: Problem) {
        if problem.line.is_some() {
            self.problems.push(problem);
            return;
        }
        let message = format!("cushion \"{}\": {}", shorten(name), problem.message);
        let of_study = Problem::new(problem.kind, message);
        let of_study = problem.hint.map_or(of_study.clone(), |hint| of_study.hint(hint));
        self.key_problem(written, ("cushion", of_study));
    }

    /// A problem with the line of its key, or of any key of the cushion.
    fn key_problem(&mut self, written: &CushionOptions, (key, problem): KeyProblem) {
        let line = written.iter().find(|(name, _)| *name == key).or(written.first()).map(|(_, text)| text.line);
        let problem = line.map_or(problem.clone(), |line| problem.at_line(line));
        self.problems.push(self.source.map_or(problem.clone(), |path| problem.in_file(path)));
    }
}
