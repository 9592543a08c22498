//! Resolves the cushion of `[objects]`, with the cushion file that it names.

use super::Resolver;
use crate::cushion::{self, EdgeCushion, read_cushion_file, with_file};
use freestand_input::file::InputFile;
use freestand_input::keys::Words;
use freestand_input::problem::Problem;

/// The stiffness of the pads of Al Abadi et al., two under an edge.
const DEFAULT_STIFFNESS: &str = "4380 N/mm";

impl Resolver<'_> {
    pub(super) fn cushion(
        &mut self,
        written: &Words,
        mass_kg: f64,
    ) -> Option<(EdgeCushion, Option<(InputFile, Words)>)> {
        let mut words = written.clone();
        let mut file = None;
        if let Some(name) = written.get("cushion") {
            let read = read_cushion_file(&self.base_dir.join(name)).and_then(|(pad, input)| {
                let joined = with_file(written, pad)?;
                Ok((input, joined))
            });
            match read {
                Ok((input, joined)) => {
                    words = joined.clone();
                    file = Some((input, joined));
                }
                Err(problems) => {
                    problems
                        .into_iter()
                        .for_each(|problem| self.cushion_fault(written, problem));
                    return None;
                }
            }
        } else if !["stiffness", "pad_stiffness", "law"]
            .iter()
            .any(|key| words.get(key).is_some())
        {
            words.set("stiffness", DEFAULT_STIFFNESS);
        }
        match cushion::resolve(&words, Some(mass_kg)) {
            Ok(cushion) => Some((cushion, file)),
            Err(problems) => {
                problems
                    .into_iter()
                    .for_each(|problem| self.cushion_fault(written, problem));
                None
            }
        }
    }

    /// Notes a problem on the line of its key, or, if the key is in the cushion file, on the first
    /// line of the study about the cushion.
    fn cushion_fault(&mut self, written: &Words, problem: Problem) {
        let first = written.lines().next().and_then(|(_, line)| line);
        let line = written.line_of(&problem.keys).or(first);
        self.fault(line, "cushion", problem);
    }
}
