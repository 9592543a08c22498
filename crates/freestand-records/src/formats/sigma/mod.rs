//! SIGMA and RESORCE records (`.cor.acc`): ten lines of header, then five values per line, which
//! may touch.

use crate::motion_file::{Found, ReadOptions, Reading, file_stem, peak_note};
use crate::text::fixed_width::Format;
use crate::text::fortran::is_missing_value;
use crate::text::keyed::{Header, entry, refuse_more_values};
use crate::text::lines::{joined, lines};
use crate::text::units::{Stated, decide, unit_in_prose};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use std::path::Path;

const VALUES: Format = Format::new(5, 14);

/// Whether the text is such a file: its first key, and another that prose does not have.
pub(super) fn is_sigma(bytes: &[u8]) -> bool {
    let mut head = lines(bytes)
        .take(40)
        .filter(|line| !line.is_blank())
        .map(|line| entry(&line));
    let others = [
        "Time Increment",
        "Number of Data",
        "Orientation",
        "PGA",
        "Station Code / Name",
    ];
    head.next()
        .is_some_and(|first| first.is("Event Date & Time"))
        && head.any(|entry| others.iter().any(|key| entry.is(key)))
}

/// Reads such a file.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header::read(&mut rest);
    refuse_other_series(&header)?;
    // The title of the series states the unit; the peak has it too.
    let stated = header.entries.iter().rev().find_map(|entry| {
        let unit =
            unit_in_prose(&entry.key).filter(|_| entry.value.is_empty() || entry.is("PGA"))?;
        Some(Stated {
            unit,
            line: entry.line,
        })
    });
    let unit = decide(stated, options.unit()?, "the record")?;
    let step = header.step_s("Time Increment", options.dt_s)?;
    let (npts, _) = header.count("Number of Data")?.ok_or_else(|| {
        Problem::format(
            "the header has no number of values (Number of Data)",
            "the file may be damaged: fetch it again",
        )
        .at_line(1)
    })?;
    let mut notes = Vec::new();
    let block = VALUES.read(&mut rest, npts, "acceleration")?;
    notes.extend(block.refuse_missing(VALUES, is_missing_value)?);
    refuse_more_values(&mut rest, &mut notes)?;
    let name = match header.text("Orientation") {
        "" => file_stem(path),
        name => name.to_owned(),
    };
    let component = Found {
        station: joined(&[header.text("Station Code / Name")], ""),
        ..Found::new(name, *unit, step, block)
    }
    .component(options)?;
    // The peak is only a check, not a reason to refuse a record.
    if let Ok(Some((peak, _))) = header.number("PGA") {
        notes.extend(peak_note(&component, unit.to_si(peak)));
    }
    Ok(Reading {
        format: "SIGMA/RESORCE",
        components: vec![component],
        notes,
    })
}

/// Refuses other series than accelerations; the line above the values names the series.
fn refuse_other_series(header: &Header) -> Result<(), Problem> {
    let Some(title) = header.entries.last().filter(|entry| entry.value.is_empty()) else {
        return Ok(());
    };
    let lower = title.key.to_ascii_lowercase();
    if ["veloc", "displ", "spectr"]
        .iter()
        .any(|word| lower.contains(word))
    {
        let message = format!(
            "holds \"{}\"; an acceleration record is expected",
            shorten(&title.key)
        );
        return Err(Problem::format(
            message,
            "use the acceleration file (.acc) of the same record",
        )
        .at_line(title.line));
    }
    Ok(())
}

#[cfg(test)]
pub(super) mod tests;
