//! The older text files of Turkey's network (AFAD, NSMN): lines `KEY : value`, then columns N-S, E-W and U-D in gal.

use super::fortran::scan;
use super::keyed::{Header, no_step, read_rows};
use super::lines::lines;
use super::units::unit_in_prose;
use super::{Direction, Found, ReadOptions, Reading, peak_note};
use crate::error::{Problem, ProblemKind};
use crate::quantity::{Dimension, lookup};
use std::path::Path;

const COLUMNS: [&str; 3] = ["N-S", "E-W", "U-D"];

/// Whether the text is such a file. The country is spelt in several ways and encodings, so it is not looked at.
pub(super) fn is_nsmn(bytes: &[u8]) -> bool {
    let title = lines(bytes).take(20).find(|line| !line.is_blank());
    title.is_some_and(|line| line.text().trim().to_ascii_uppercase().starts_with("STRONG GROUND MOTION RECORD"))
}

/// Reads such a file.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header::read(&mut rest);
    let (dt_s, line_of_step) = match header.step_s("SAMPLING INTERVAL")? {
        Some((dt_s, line)) => (dt_s, line),
        None => (options.dt_s.ok_or_else(|| no_step("SAMPLING INTERVAL"))?, 1),
    };
    super::check_step(dt_s, ProblemKind::Format).map_err(|problem| problem.at_line(line_of_step))?;
    let mut notes = Vec::new();
    let names = column_names(&header);
    let declared = header.count("NUMBER OF DATA")?;
    let rows = read_rows(&mut rest, names.len(), declared, &mut notes)?;
    // The line of the peaks states the unit; the files that lack it are in gal as all others are.
    let peaks = header.entries.iter().find(|entry| entry.key.to_ascii_uppercase().contains("PGA"));
    let unit = peaks
        .and_then(|entry| unit_in_prose(&entry.key))
        .filter(|unit| unit.dimension == Dimension::Acceleration)
        .or_else(|| lookup("gal"))
        .ok_or_else(|| Problem::new(ProblemKind::Format, "the unit of the record is not known"))?;
    let station = station(&header);
    let mut components = Vec::new();
    for (name, values) in names.into_iter().zip(rows.columns) {
        let component = Found {
            direction: Direction::parse(&name),
            name,
            station: station.clone(),
            unit: unit.symbol,
            unit_m_s2: unit.to_si(1.0),
            dt_s,
            values,
            line: rows.first_line,
            is_raw: false,
        }
        .component(options)?;
        let stated = peaks.and_then(|entry| peak_of(&entry.value, &component.name));
        notes.extend(stated.and_then(|peak| peak_note(&component, unit.to_si(peak))));
        components.push(component);
    }
    Ok(Reading { format: "AFAD/NSMN text", components, notes })
}

/// The words of the line above the numbers, if every one is a direction; else the order that all files have.
fn column_names(header: &Header) -> Vec<String> {
    let last = header.entries.last().filter(|entry| entry.value.is_empty());
    let names: Vec<String> =
        last.map(|entry| entry.key.split_whitespace().map(str::to_owned).collect()).unwrap_or_default();
    if !names.is_empty() && names.iter().all(|name| Direction::parse(name).is_some()) {
        return names;
    }
    COLUMNS.map(str::to_owned).to_vec()
}

/// `(N-S) 0.316125 (E-W) 0.331524 (U-D) 0.363887`.
fn peak_of(value: &str, name: &str) -> Option<f64> {
    let (_, rest) = value.split_once(&format!("({name})"))?;
    scan(rest.trim_start().as_bytes()).map(|number| number.value)
}

/// The station's number and the place, as far as the header has them.
fn station(header: &Header) -> Option<String> {
    let parts = [header.text("STATION ID"), header.text("PLACE")];
    let name = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ");
    (!name.is_empty()).then_some(name)
}

#[cfg(test)]
pub(super) mod tests;
