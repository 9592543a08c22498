//! SMC, the format of the U.S. Geological Survey's strong-motion archive: one component per file,
//! in cm/s².

use crate::motion_file::{Found, ReadOptions, Reading, file_stem, peak_note};
use crate::text::fixed_width::Format;
use crate::text::fortran::is_missing_value;
use crate::text::keyed::refuse_more_values;
use crate::text::lines::{Line, joined, lines};
use crate::text::sampling::step_of_rate;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Unit, shorten};
use std::path::Path;

const INTEGERS: Format = Format::new(8, 10);
const REALS: Format = Format::new(5, 15);
const VALUES: Format = Format::new(8, 10);
const UNIT: Unit = Unit::acceleration("cm/s2", -2, 1.0);
const TEXT_LINES: usize = 11;

/// What a file holds.
enum Kind {
    Acceleration(&'static str),
    Other,
}

/// What the file holds, from its first line.
fn kind(line: &Line<'_>) -> Option<Kind> {
    let text = line.text();
    let (number, words) = text.trim_start().split_at_checked(1)?;
    let words = words.trim_start().to_ascii_uppercase();
    match number {
        "1" if words.starts_with("UNCORRECTED") => Some(Kind::Acceleration("SMC, uncorrected")),
        "2" if words.starts_with("CORRECTED") => Some(Kind::Acceleration("SMC, corrected")),
        "3" | "4" | "5" | "6"
            if ["VELOCITY", "DISPLACEMENT", "RESPONSE"]
                .iter()
                .any(|w| words.starts_with(w)) =>
        {
            Some(Kind::Other)
        }
        _ => None,
    }
}

/// Whether the text is an SMC file: its kind on line 1, and an asterisk on line 2 if that is empty.
pub(super) fn is_smc(bytes: &[u8]) -> bool {
    let mut head = lines(bytes);
    let kind = head.next().and_then(|line| kind(&line));
    kind.is_some()
        && head
            .next()
            .is_some_and(|line| line.bytes.trim_ascii_start().starts_with(b"*"))
}

/// Reads an SMC file: 11 lines of text, 48 integers, 50 reals, comments, the values.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let text: Vec<String> = rest
        .by_ref()
        .take(TEXT_LINES)
        .map(|line| line.text())
        .collect();
    let format = match lines(bytes).next().and_then(|line| kind(&line)) {
        Some(Kind::Acceleration(format)) => format,
        _ => {
            let message = format!(
                "holds \"{}\"; an acceleration record is expected",
                shorten(text[0].trim())
            );
            return Err(
                Problem::format(message, "use the acceleration file of the same record").at_line(1),
            );
        }
    };
    let integers = INTEGERS.read(&mut rest, 48, "the integer header")?;
    let reals = REALS.read(&mut rest, 50, "the real header")?;
    let comments = integers.count(15, INTEGERS, "comment lines")?;
    let npts = integers.count(16, INTEGERS, "values")?;
    let dt_s = step_of_rate(reals.values[1], reals.first_line)?;
    let found = rest.by_ref().take(comments).count();
    if found < comments {
        return Err(Problem::format(
            format!("the header declares {comments} comment lines, but {found} lines follow"),
            "the file is damaged or cut off: fetch it again",
        )
        .at_line(integers.first_line + 15 / INTEGERS.per_line));
    }
    let block = VALUES.read(&mut rest, npts, "acceleration")?;
    let mut notes = Vec::from_iter(block.refuse_missing(VALUES, is_missing_value)?);
    refuse_more_values(&mut rest, &mut notes)?;
    let (station, name) = station_and_component(&text, path);
    let component = Found {
        station,
        ..Found::new(name, UNIT, (dt_s, reals.first_line), block)
    }
    .component(options)?;
    // Real headers 30 and 32 are the largest and the smallest value, 29 and 31 their times.
    let peak = reals.values[29..=31]
        .iter()
        .step_by(2)
        .filter(|value| value.abs() < 1e30);
    notes.extend(peak_note(
        &component,
        UNIT.to_si(peak.fold(0.0, |a: f64, b| a.max(b.abs()))),
    ));
    Ok(Reading {
        format,
        components: vec![component],
        notes,
    })
}

/// `station = San Francisco, 1295 Shafter, F component=    360`.
fn station_and_component(text: &[String], path: &Path) -> (Option<String>, String) {
    let line = text.iter().find(|line| line.contains("component"));
    let Some((station, component)) = line.and_then(|line| line.split_once("component")) else {
        return (None, file_stem(path));
    };
    let value = |text: &str| text.trim().trim_start_matches(['=', ' ']).trim().to_owned();
    let station = value(
        station
            .trim_start()
            .strip_prefix("station")
            .unwrap_or(station),
    );
    let name = joined(&[&value(component)], "");
    (
        joined(&[&station], ""),
        name.unwrap_or_else(|| file_stem(path)),
    )
}

#[cfg(test)]
mod tests;
