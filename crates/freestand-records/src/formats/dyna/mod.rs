//! DYNA 1.2 and its predecessors: the ESM and ITACA archives, and AFAD's (TADAS). Lines
//! `KEY: value`, then one value per line.

use crate::motion_file::{
    Direction, Found, ReadOptions, Reading, file_stem, length_note, peak_note,
};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use crate::text::keyed::{Header, entry, read_rows};
use crate::text::lines::{joined, lines};
use crate::text::units::{Stated, decide, record_unit};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Unit, shorten};
use std::path::Path;

/// The number of lines in which the keys that identify the format are searched for.
const HEAD_LINES: usize = 100;

/// Whether the text is a DYNA file: its first key and others that prose does not have, or the two
/// that every file has.
pub(super) fn is_dyna(bytes: &[u8]) -> bool {
    let head: Vec<_> = lines(bytes)
        .take(HEAD_LINES)
        .filter(|line| !line.is_blank())
        .map(|line| entry(&line))
        .collect();
    let has = |key: &str| head.iter().any(|entry| entry.is(key));
    let is_first = head.first().is_some_and(|entry| entry.is("EVENT_NAME"));
    is_first
        && [
            "EVENT_ID",
            "STATION_CODE",
            "SAMPLING_INTERVAL_S",
            "NDATA",
            "UNITS",
        ]
        .into_iter()
        .any(has)
        || has("NDATA") && has("SAMPLING_INTERVAL_S")
}

/// Reads a DYNA file.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header::read(&mut rest);
    refuse_other_series(&header)?;
    let unit = unit(&header, options)?;
    let step = header.step_s("SAMPLING_INTERVAL_S", options.dt_s)?;
    let mut notes = Vec::new();
    let declared = header.count("NDATA")?;
    let rows = read_rows(&mut rest, 1, declared, &mut notes)?;
    let block = Block {
        values: rows.columns.into_iter().next().unwrap_or_default(),
        first_line: rows.first_line,
    };
    if declared.is_none() {
        let words = format!(
            "the header does not say how many values there are; {} were found",
            block.values.len()
        );
        notes.push(Note::new(NoteKind::CountUnstated, words));
    }
    if header
        .text("BASELINE_CORRECTION")
        .to_ascii_uppercase()
        .contains("NOT REMOVED")
    {
        let words =
            "the header says that the baseline was not removed: the values may have an offset";
        notes.push(Note::new(NoteKind::NotCorrected, words));
    }
    let (name, direction) = name_and_direction(&header, path);
    let component = Found {
        station: station(&header),
        direction,
        ..Found::new(name, *unit, step, block)
    }
    .component(options)?;
    // The peak is only a check, not a reason to refuse a record.
    if let Ok(Some((peak, _))) = header.number("PGA_CM/S^2") {
        notes.extend(peak_note(&component, 0.01 * peak));
    }
    if let Ok(Some((duration_s, _))) = header.number("DURATION_S") {
        notes.extend(length_note(&component, duration_s));
    }
    Ok(Reading {
        format: "DYNA",
        components: vec![component],
        notes,
    })
}

/// Refuses velocities, displacements and spectra, which the archives publish in the same form.
fn refuse_other_series(header: &Header) -> Result<(), Problem> {
    let Some(stated) = header.get("DATA_TYPE") else {
        return Ok(());
    };
    let upper = stated.value.to_ascii_uppercase();
    let is_other = ["SPECTR", "VELOCITY", "DISPLACEMENT"]
        .iter()
        .any(|word| upper.contains(word));
    if is_other || !upper.contains("ACCEL") {
        let message = format!(
            "holds \"{}\"; an acceleration record is expected",
            shorten(&stated.value)
        );
        return Err(Problem::format(
            message,
            "use the acceleration file (ACC) of the same record",
        )
        .at_line(stated.line));
    }
    Ok(())
}

fn unit(header: &Header, options: &ReadOptions) -> Result<&'static Unit, Problem> {
    let requested = options.unit()?;
    let Some(stated) = header.get("UNITS") else {
        return decide(None, requested, "the record");
    };
    let unit = record_unit(&stated.value).ok_or_else(|| {
        Problem::format(
            format!("the unit \"{}\" is not known", shorten(&stated.value)),
            "correct UNITS in the header; the archives write cm/s^2",
        )
        .at_line(stated.line)
    })?;
    decide(
        Some(Stated {
            unit,
            line: stated.line,
        }),
        requested,
        "the record",
    )
}

/// `HNE` of the SEED channel, or the `NS`, `WE`, `UP` of the oldest files, whose WE is positive to
/// the east.
fn name_and_direction(header: &Header, path: &Path) -> (String, Option<Direction>) {
    if let Some(stream) = header.get("STREAM") {
        return (stream.value.clone(), Direction::parse(&stream.value));
    }
    match header.text("COMPONENT") {
        "" => (file_stem(path), None),
        name if name.eq_ignore_ascii_case("WE") => {
            (name.to_owned(), Some(Direction::Azimuth(90.0)))
        }
        name => (name.to_owned(), Direction::parse(name)),
    }
}

/// `HI.ARS1 Town Hall, Argos`, as far as the header has it.
fn station(header: &Header) -> Option<String> {
    let code = joined(&[header.text("NETWORK"), header.text("STATION_CODE")], ".");
    joined(
        &[&code.unwrap_or_default(), header.text("STATION_NAME")],
        " ",
    )
}

#[cfg(test)]
pub(super) mod tests;
