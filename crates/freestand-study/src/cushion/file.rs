//! Cushion files: one pad as a laboratory found it, in TOML.

use freestand_input::keys::KeyStyle;
use std::fs;
use std::path::Path;

use super::{CushionWords, KeyProblem};
use crate::options::{CushionOptions, parse_cushion};
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind, Problems};

/// A cushion file is a few lines; a table of forces some thousand.
const LARGEST: u64 = 1 << 20;

/// Reads a cushion file: the keys of [`CUSHION_KEYS`](super::CUSHION_KEYS), with `stiffness` (and all else) of one pad.
///
/// # Errors
/// A file that cannot be read, is no TOML, or has unknown keys.
pub fn read_cushion_file(path: &Path) -> Result<(CushionWords, InputFile), Problems> {
    let unreadable = |message: String| {
        let problem = Problem::new(ProblemKind::Io, message).in_file(path);
        Problems::from(problem.hint("name a cushion file, such as the cushion.toml that freestand cushion drop writes"))
    };
    match fs::metadata(path) {
        Err(error) => return Err(unreadable(format!("cannot read the cushion: {error}"))),
        Ok(facts) if facts.is_dir() => return Err(unreadable("is a folder, not a cushion file".to_owned())),
        Ok(facts) if facts.len() > LARGEST => return Err(unreadable("is too large for a cushion file".to_owned())),
        Ok(_) => {}
    }
    let bytes = fs::read(path).map_err(|error| unreadable(format!("cannot read the cushion: {error}")))?;
    let input = InputFile::new(path, &bytes);
    let text = String::from_utf8(bytes).map_err(|_| unreadable("is not text (UTF-8)".to_owned()))?;
    let (options, mut problems) = parse_cushion(&text, path);
    if let Some((key, written)) = options.iter().find(|(key, _)| matches!(*key, "cushion" | "pad_stiffness")) {
        let problem = Problem::new(ProblemKind::Value, format!("{key} has no place in a cushion file"));
        let hint = "a cushion file describes one pad: its stiffness is that of the pad";
        problems.push(problem.hint(hint).at_line(written.line).in_file(path));
    }
    if problems.is_empty() { Ok((of_one_pad(&options), input)) } else { Err(Problems { problems }) }
}

fn of_one_pad(options: &CushionOptions) -> CushionWords {
    let mut words = CushionWords::new(KeyStyle::File);
    for (key, written) in options {
        words.set(if *key == "stiffness" { "pad_stiffness" } else { key }, written.value.clone());
    }
    words
}

impl CushionWords {
    /// The words of the cushion file that these words name, with what they add to it: pads per edge, layers in series,
    /// the thickness of the pad. Words that name no file stay as they are.
    ///
    /// # Errors
    /// Words that describe the pad once more.
    pub fn with_file(&self, file: CushionWords) -> Result<Self, KeyProblem> {
        let mut words = file;
        words.style = self.style;
        for (key, text) in &self.entries {
            match *key {
                "cushion" => {}
                "pads_per_edge" | "series_stiffness" | "pad_thickness" => words.set(key, text.clone()),
                key => {
                    let message = format!("{} and {} exclude each other", self.name("cushion"), self.name(key));
                    let hint = "the file describes the pad: change it there";
                    return Err((key, Problem::new(ProblemKind::Value, message).hint(hint)));
                }
            }
        }
        if words.get("pads_per_edge").is_none() {
            let message = format!("{} needs {}", self.name("cushion"), self.name("pads_per_edge"));
            let hint =
                "the file describes one pad: how many share the landing of one edge? A cabinet on four feet has 2";
            return Err(("cushion", Problem::new(ProblemKind::Value, message).hint(hint)));
        }
        Ok(words)
    }
}
