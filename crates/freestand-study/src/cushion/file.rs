//! Cushion files: one pad as a laboratory measured it, in TOML.

use std::path::Path;

use freestand_input::file::{InputFile, load_up_to};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, ProblemKind, Problems};

use crate::options::{NOT_IN_CUSHION_FILES, parse_cushion};

/// Largest size of a cushion file: it has a few lines, or some thousand with a table of forces.
const MAX_BYTES: u64 = 1 << 20;

/// Reads a cushion file: the keys of a cushion, with `stiffness` (and all else) of one pad, which
/// the words call `pad_stiffness`.
///
/// # Errors
/// A file that cannot be read, is not TOML, or has unknown keys.
pub fn read_cushion_file(path: &Path) -> Result<(Words, InputFile), Problems> {
    const HINT: &str =
        "name a cushion file, such as the cushion.toml that the command cushion drop writes";
    let unreadable = |message: &str| {
        Problem::new(ProblemKind::Io, message)
            .in_file(path)
            .hint(HINT)
    };
    let bytes = load_up_to(path, MAX_BYTES, "is too large for a cushion file", HINT)
        .map_err(|problem| problem.hint(HINT))?;
    let input = InputFile::new(path, &bytes);
    let text = String::from_utf8(bytes).map_err(|_| unreadable("is not text (UTF-8)"))?;
    Ok((pad_words(&text, path)?, input))
}

/// The words of one pad from the text of a cushion file, which messages call `path`.
///
/// # Errors
/// A text that is not TOML, or has unknown keys.
pub fn pad_words(text: &str, path: &Path) -> Result<Words, Problems> {
    let (options, mut problems) = parse_cushion(text, path);
    let stranger = options
        .lines()
        .find(|(key, _)| NOT_IN_CUSHION_FILES.contains(key));
    if let Some((key, Some(line))) = stranger {
        let hint = "a cushion file describes one pad itself: give its stiffness as stiffness";
        problems.push(
            Problem::value(format!("{key} does not belong in a cushion file"), hint)
                .at_line(line)
                .in_file(path),
        );
    }
    let of_one_pad = |key| {
        if key == "stiffness" {
            "pad_stiffness"
        } else {
            key
        }
    };
    problems.finish(Some(
        options
            .entries()
            .map(|(key, text)| (of_one_pad(key), text))
            .collect(),
    ))
}

/// The words of a cushion file, completed by those of the words that name it: pads per edge, layers
/// in series, the thickness of the pad.
///
/// # Errors
/// Words that describe the pad again, or do not say how many pads are under an edge.
pub fn with_file(words: &Words, file: Words) -> Result<Words, Problem> {
    let mut joined = file;
    for (key, text) in words.entries() {
        match key {
            "cushion" => {}
            "pads_per_edge" | "pad_thickness" => joined.set(key, text),
            "series_stiffness" => joined.add(key, text, None),
            key => {
                let message = format!("`cushion` and `{key}` exclude each other");
                return Err(
                    Problem::value(message, "the file describes the pad: change it there")
                        .of(&[key]),
                );
            }
        }
    }
    if joined.get("pads_per_edge").is_none() {
        let hint = "the file describes one pad: give the number of pads that share the landing of one edge, 2 for a \
                    cabinet on four feet";
        return Err(Problem::value("`cushion` needs `pads_per_edge`", hint).of(&["cushion"]));
    }
    Ok(joined)
}
