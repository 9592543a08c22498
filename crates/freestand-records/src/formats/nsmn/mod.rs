//! The older text files of Turkey's network (AFAD, NSMN): lines `KEY : value`, then columns N-S,
//! E-W and U-D in gal.

use crate::motion_file::{Direction, Found, ReadOptions, Reading, peak_note};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use crate::text::fortran::leading_value;
use crate::text::keyed::{Entry, Header, entry, read_rows};
use crate::text::lines::{joined, lines};
use crate::text::units::{Stated, decide, unit_in_prose};
use freestand_input::problem::Problem;
use freestand_input::quantity::lookup;
use std::path::Path;

const COLUMNS: [&str; 3] = ["N-S", "E-W", "U-D"];
const STEP: &str = "SAMPLING INTERVAL";
const COUNT: &str = "NUMBER OF DATA";
const KEYS: [&str; 4] = [STEP, COUNT, "STATION ID", "RECORD TIME"];

/// Whether the text is such a file: its title, and a key that prose does not have. The country is
/// spelt in several ways and encodings, so it is ignored.
pub(super) fn is_nsmn(bytes: &[u8]) -> bool {
    let mut head = lines(bytes).take(60).filter(|line| !line.is_blank());
    let title = head
        .next()
        .map_or_else(String::new, |line| line.text().trim().to_ascii_uppercase());
    let is_key = |entry: &Entry| KEYS.iter().any(|key| entry.is(key));
    title.starts_with("STRONG GROUND MOTION RECORD") && head.any(|line| is_key(&entry(&line)))
}

/// Reads such a file.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header::read(&mut rest);
    let step = header.step_s(STEP, options.dt_s)?;
    let mut notes = Vec::new();
    let names = column_names(&header, &mut notes);
    let declared = header.count(COUNT)?;
    let rows = read_rows(&mut rest, names.len(), declared, &mut notes)?;
    // The line of the peaks states the unit. Without it the unit is gal, as in all files of this
    // form.
    let peaks = header
        .entries
        .iter()
        .find(|entry| entry.key.to_ascii_uppercase().contains("PGA"));
    let stated = peaks.and_then(|entry| {
        Some(Stated {
            unit: unit_in_prose(&entry.key)?,
            line: entry.line,
        })
    });
    let requested = options.unit()?;
    let unit = match (stated, requested, lookup("gal")) {
        (None, None, Some(gal)) => {
            let words =
                "no line states the unit: the values are read in gal, as in all files of this form";
            notes.push(Note::new(NoteKind::UnitAssumed, words));
            gal
        }
        _ => decide(stated, requested, "the record")?,
    };
    // The station's number and the place, as far as the header has them.
    let station = joined(&[header.text("STATION ID"), header.text("PLACE")], " ");
    let mut components = Vec::new();
    for (name, values) in names.into_iter().zip(rows.columns) {
        let block = Block {
            values,
            first_line: rows.first_line,
        };
        let component = Found {
            station: station.clone(),
            ..Found::new(name, *unit, step, block)
        }
        .component(options)?;
        let stated = peaks.and_then(|entry| peak_of(&entry.value, &component.name));
        notes.extend(stated.and_then(|peak| peak_note(&component, unit.to_si(peak))));
        components.push(component);
    }
    Ok(Reading {
        format: "AFAD/NSMN text",
        components,
        notes,
    })
}

/// The words of the line above the numbers if all are directions; else the order that all files
/// have.
fn column_names(header: &Header, notes: &mut Vec<Note>) -> Vec<String> {
    let last = header.entries.last().filter(|entry| entry.value.is_empty());
    let names: Vec<String> = last
        .map(|entry| entry.key.split_whitespace().map(str::to_owned).collect())
        .unwrap_or_default();
    if !names.is_empty() && names.iter().all(|name| Direction::parse(name).is_some()) {
        return names;
    }
    let columns = COLUMNS.join(", ");
    let words = format!(
        "no line names the columns: they are read as {columns}, as in all files of this form"
    );
    notes.push(Note::new(NoteKind::ColumnsAssumed, words));
    COLUMNS.map(str::to_owned).to_vec()
}

/// `(N-S) 0.316125 (E-W) 0.331524 (U-D) 0.363887`.
fn peak_of(value: &str, name: &str) -> Option<f64> {
    let (_, rest) = value.split_once(&format!("({name})"))?;
    leading_value(rest.trim_start())
}

#[cfg(test)]
pub(super) mod tests;
