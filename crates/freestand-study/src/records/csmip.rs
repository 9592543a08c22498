//! CSMIP, formerly CDMG, the programme of the State of California: volumes I and II; and RENADIC of Chile, which uses
//! volume I.

use super::lines::lines;
use super::volumes::{self, Network};
use super::{ReadOptions, Reading};
use crate::error::{Problem, ProblemKind};
use std::path::Path;

const CSMIP: Network = Network { volume_one: "CSMIP V1", volume_two: "CSMIP V2", columns: 200 };
const RENADIC: Network = Network { volume_one: "RENADIC", volume_two: "RENADIC", columns: 200 };

/// The first lines that are not blank, in capitals.
pub(super) fn head(bytes: &[u8], count: usize) -> Vec<String> {
    lines(bytes).filter(|line| !line.is_blank()).take(count).map(|line| line.text().to_ascii_uppercase()).collect()
}

/// Whether the text is a CSMIP or RENADIC file: volume I says so on its first line, volume II and the spectra of volume
/// III on the second or third too. A title alone does not make one: rows of whole numbers follow in every volume.
pub(super) fn is_csmip(bytes: &[u8]) -> bool {
    let head = head(bytes, 13);
    let has = |line: usize, words: &str| head.get(line).is_some_and(|text| text.contains(words));
    let is_below = |words: &str| has(1, words) || has(2, words);
    let is_titled = has(0, "UNCORRECTED ACCELEROGRAM DATA")
        || has(0, "CORRECTED ACCELEROGRAM") && is_below("UNCORRECTED ACCELEROGRAM")
        || has(0, "RESPONSE") && is_below("CORRECTED ACCELEROGRAM")
        || is_renadic(&head);
    is_titled && lines(bytes).take(60).any(|line| volumes::is_full_integer_row(&line))
}

fn is_renadic(head: &[String]) -> bool {
    head.iter().any(|line| line.contains("RENADIC"))
}

/// Reads a CSMIP or RENADIC file.
pub(super) fn read(bytes: &[u8], _: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let head = head(bytes, 13);
    refuse_spectra(&head)?;
    volumes::read(bytes, options, if is_renadic(&head) { &RENADIC } else { &CSMIP })
}

/// Volume III has response and Fourier spectra.
pub(super) fn refuse_spectra(head: &[String]) -> Result<(), Problem> {
    if head.first().is_some_and(|line| line.contains("RESPONSE")) {
        return Err(Problem::new(
            ProblemKind::Format,
            "holds response spectra (volume III), an acceleration record is expected",
        )
        .at_line(1)
        .hint("use the file of volume II of the same record"));
    }
    Ok(())
}
