//! Volumes I and II of the University of Southern California and, before it, of Caltech.

use super::volumes::{self, Network, head, refuse_spectra};
use crate::motion_file::{ReadOptions, Reading};
use crate::text::lines::lines;
use freestand_input::problem::Problem;
use std::path::Path;

/// From column 73 on, a line states the number of its characters.
const USC: Network = Network {
    volume_one: "USC V1",
    volume_two: "USC V2",
    columns: 72,
    end_mark: None,
};

/// Whether the text is a file of USC or Caltech: one of the first lines refers to the uncorrected
/// data of volume I.
pub(super) fn is_usc(bytes: &[u8]) -> bool {
    let head = head(bytes, 3);
    let is_record = head
        .first()
        .is_some_and(|line| line.contains("ACCELEROGRAM") || line.contains("RESPONSE"));
    is_record
        && head
            .iter()
            .any(|line| line.contains("OF UNCORRECTED ACCELEROGRAM DATA OF"))
        && lines(bytes)
            .take(60)
            .any(|line| volumes::is_full_integer_row(&line))
}

/// Reads a file of USC or Caltech.
pub(super) fn read(bytes: &[u8], _: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    refuse_spectra(&head(bytes, 3))?;
    volumes::read(bytes, options, &USC)
}
