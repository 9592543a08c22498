//! CSMIP, formerly CDMG, the programme of the State of California: volumes I and II; and RENADIC of
//! Chile, which uses volume I.

use super::volumes::{self, Network, head, refuse_spectra};
use crate::motion_file::{ReadOptions, Reading};
use crate::text::lines::lines;
use freestand_input::problem::Problem;
use std::path::Path;

const CSMIP: Network = Network {
    volume_one: "CSMIP V1",
    volume_two: "CSMIP V2",
    columns: 200,
    end_mark: Some("/&"),
};
const RENADIC: Network = Network {
    volume_one: "RENADIC",
    volume_two: "RENADIC",
    columns: 200,
    end_mark: None,
};

/// Whether the text is a CSMIP or RENADIC file: volume I says so on its first line, volume II and
/// the spectra of volume III on the second or third too. A title alone does not make one: rows of
/// whole numbers follow in every volume.
pub(super) fn is_csmip(bytes: &[u8]) -> bool {
    let head = head(bytes, 13);
    let has = |line: usize, words: &str| head.get(line).is_some_and(|text| text.contains(words));
    let is_below = |words: &str| has(1, words) || has(2, words);
    let is_titled = has(0, "UNCORRECTED ACCELEROGRAM DATA")
        || has(0, "CORRECTED ACCELEROGRAM") && is_below("UNCORRECTED ACCELEROGRAM")
        || has(0, "RESPONSE") && is_below("CORRECTED ACCELEROGRAM")
        || is_renadic(&head);
    is_titled
        && lines(bytes)
            .take(60)
            .any(|line| volumes::is_full_integer_row(&line))
}

fn is_renadic(head: &[String]) -> bool {
    head.iter().any(|line| line.contains("RENADIC"))
}

/// Reads a CSMIP or RENADIC file.
pub(super) fn read(bytes: &[u8], _: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let head = head(bytes, 13);
    refuse_spectra(&head)?;
    volumes::read(
        bytes,
        options,
        if is_renadic(&head) { &RENADIC } else { &CSMIP },
    )
}
