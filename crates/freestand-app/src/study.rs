//! The study that a request names.

use freestand_input::problem::Problem;
use freestand_input::word_reader::WordReader;
use freestand_study::resolve::StudySource;

use crate::files::{Content, Files, not_sent};

/// Where the study is, if one is named.
pub(crate) fn source(read: &mut WordReader<'_>, files: &Files) -> Option<StudySource> {
    let found = found(read.one("study")?, files);
    read.keep("study", found)
}

/// As [`source`], where the key has no flag in the command line that a message could name.
pub(crate) fn source_without_flag(read: &mut WordReader<'_>, files: &Files) -> Option<StudySource> {
    let found = found(read.one("study")?, files);
    let found = found.map_err(|problem| problem.of(&["study"]));
    read.problems.keep(found)
}

fn found(name: &str, files: &Files) -> Result<StudySource, Problem> {
    match files.find(name)? {
        Content::At(path) => Ok(StudySource::File(path)),
        Content::Text(text) => Ok(StudySource::Text(text)),
        Content::Motion(_) | Content::Mesh(_) => Err(not_sent(name)),
    }
}
