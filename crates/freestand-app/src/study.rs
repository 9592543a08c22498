//! The study that a request names.

use freestand_input::word_reader::WordReader;
use freestand_study::resolve::StudySource;

use crate::files::{Content, Files, not_sent};

/// The most storeys of a building.
pub(crate) const MAX_STOREYS: u16 = 500;

/// Where the study is, if one is named.
pub(crate) fn source(read: &mut WordReader<'_>, files: &Files) -> Option<StudySource> {
    let name = read.one("study")?;
    let source = files.find(name).and_then(|content| match content {
        Content::At(path) => Ok(StudySource::File(path)),
        Content::Text(text) => Ok(StudySource::Text(text)),
        Content::Motion(_) => Err(not_sent(name)),
    });
    read.keep("study", source)
}
