//! PEER AT2: prose, a unit, a line with NPTS and DT, then the values, any number per line.

use crate::motion_file::{Direction, Found, ReadOptions, Reading, file_stem};
use crate::notes::Note;
use crate::text::digit_style::DigitStyle;
use crate::text::fixed_width::Block;
use crate::text::fortran::{bad_field, fields, scan};
use crate::text::gaps::Markers;
use crate::text::lines::{Line, lines};
use crate::text::units::{Stated, decide, not_known, unit_in_prose};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use std::path::Path;

/// The last line on which NPTS and DT may be. It is the fourth in every file of PEER, a few lines
/// further down in copies.
const HEADER_LINES: usize = 20;

const NO_COUNTS: &str = "the number of values or the time step is missing";

/// Whether the text is an AT2 file, or a VT2 or DT2 file, which has the same layout.
pub(super) fn is_at2(bytes: &[u8]) -> bool {
    header_end(bytes).is_some()
}

/// The number of the line that names NPTS and DT. If several do (a title may), it is the fourth.
fn header_end(bytes: &[u8]) -> Option<usize> {
    // Any other line than the fourth must be readable: the prose above a table may mention both
    // words.
    let named = |line: &Line<'_>| {
        let text = line.text();
        !line.is_comment()
            && names_counts(&text)
            && (line.number == 4 || read_counts(&text).is_ok())
    };
    let found: Vec<usize> = lines(bytes)
        .take(HEADER_LINES)
        .filter(named)
        .map(|line| line.number)
        .collect();
    if found.contains(&4) {
        Some(4)
    } else {
        found.first().copied()
    }
}

fn names_counts(text: &str) -> bool {
    let upper = text.to_ascii_uppercase();
    find_word(&upper, "NPTS").is_some()
        && find_word(&upper, "DT").is_some()
        && upper.contains(|c: char| c.is_ascii_digit())
}

/// The position of `word` in `text` where it is a whole word.
fn find_word(text: &str, word: &str) -> Option<usize> {
    let letter_at = |at: Option<usize>| {
        at.and_then(|at| text.as_bytes().get(at))
            .is_some_and(u8::is_ascii_alphanumeric)
    };
    text.match_indices(word)
        .map(|(at, _)| at)
        .find(|&at| !letter_at(at.checked_sub(1)) && !letter_at(Some(at + word.len())))
}

/// Reads an AT2 file.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let Some(header_line) = header_end(bytes) else {
        return Err(Problem::format(
            "no line names NPTS and DT",
            "an AT2 header has four lines; the fourth names NPTS and DT",
        ));
    };
    let header: Vec<String> = lines(bytes)
        .take(header_line)
        .map(|line| line.text())
        .collect();
    refuse_sisters(&header)?;
    let (npts, dt_s) =
        read_counts(header.last().map_or("", String::as_str)).map_err(|message| {
            Problem::format(
                message,
                "the header line should read like \"NPTS=  4000, DT= .01000 SEC\"",
            )
            .at_line(header_line)
        })?;

    // The last line that states a unit is the one nearest to the values; line 3 in every file of
    // PEER.
    let stated = header
        .iter()
        .enumerate()
        .rev()
        .find_map(|(i, text)| unit_in_prose(text).map(|unit| Stated { unit, line: i + 1 }));
    let unit = decide(stated, options.unit()?, "the record").map_err(|problem| {
        let lines = header
            .iter()
            .enumerate()
            .map(|(i, text)| (i + 1, text.as_str()));
        let units = lines.filter(|(_, text)| text.to_ascii_lowercase().contains("unit"));
        not_known(units)
            .filter(|_| stated.is_none())
            .unwrap_or(problem)
    })?;

    let mut notes = Vec::new();
    let block = read_values(bytes, npts, header_line, &mut notes)?;
    let (name, station) = name_and_station(header.get(1).map_or("", String::as_str), path);
    let direction = station.as_ref().and_then(|_| Direction::parse(&name));
    let component = Found {
        station,
        direction,
        ..Found::new(name, *unit, (dt_s, header_line), block)
    }
    .component(options)?;
    Ok(Reading {
        format: "PEER AT2",
        components: vec![component],
        notes,
    })
}

/// Refuses VT2 and DT2, which look the same but hold velocity and displacement.
fn refuse_sisters(header: &[String]) -> Result<(), Problem> {
    for (i, text) in header.iter().enumerate() {
        let upper = text.to_ascii_uppercase();
        for (word, name) in [
            ("VELOCITY", "velocity record (VT2)"),
            ("DISPLACEMENT", "displacement record (DT2)"),
        ] {
            let series = ["TIME SERIES", "TIME HISTORY", "UNITS OF"]
                .iter()
                .any(|rest| upper.contains(rest));
            let stated =
                unit_in_prose(text).filter(|unit| unit.dimension != Dimension::Acceleration);
            // "PEAK VELOCITY" or "SHEAR WAVE VELOCITY" may be mentioned in the header of an
            // acceleration record.
            if upper.contains(word)
                && !upper.contains("ACCEL")
                && (series && upper.trim_start().starts_with(word) || stated.is_some())
            {
                return Err(Problem::format(
                    format!("is a {name}; an acceleration record is expected"),
                    "use the AT2 file of the same record",
                )
                .at_line(i + 1));
            }
        }
    }
    Ok(())
}

/// `NPTS=  4000, DT= .01000 SEC`, `DT=0.01 NPTS=4000`, `NPTS, DT: 4000 .01`, or with the numbers
/// first: `4000  .01  NPTS, DT`.
fn read_counts(text: &str) -> Result<(usize, f64), String> {
    let upper = text.to_ascii_uppercase();
    let (npts_at, dt_at) = (
        find_word(&upper, "NPTS").ok_or(NO_COUNTS)?,
        find_word(&upper, "DT").ok_or(NO_COUNTS)?,
    );
    let (npts, dt, tail) = match (
        value_after(&upper, npts_at + 4),
        value_after(&upper, dt_at + 2),
    ) {
        (Some((npts, _)), Some((dt, end))) => (npts, dt, end),
        (None, Some((npts, end))) if npts_at < dt_at => {
            let (dt, end) = value_after(&upper, end).ok_or(NO_COUNTS)?;
            (npts, dt, end)
        }
        (None, None) => {
            let (npts, end) = value_after(&upper, 0).ok_or(NO_COUNTS)?;
            let (dt, end) = value_after(&upper, end).ok_or(NO_COUNTS)?;
            (npts, dt, end)
        }
        _ => return Err(NO_COUNTS.to_owned()),
    };
    if !(npts >= 0.0 && npts.fract() == 0.0 && npts < 1e15) {
        return Err(format!(
            "the number of values, {npts}, is not a whole number"
        ));
    }
    let unit: String = upper[tail..]
        .trim_start()
        .chars()
        .take_while(char::is_ascii_alphabetic)
        .collect();
    let dt_s = if matches!(unit.as_str(), "MS" | "MSEC" | "MSECS" | "MILLISECONDS") {
        dt / 1000.0
    } else {
        dt
    };
    // "0,01" in some countries.
    if dt.fract() == 0.0
        && upper[tail..].starts_with(',')
        && upper[tail + 1..].starts_with(|c: char| c.is_ascii_digit())
    {
        return Err("the time step has a decimal comma: write a point".to_owned());
    }
    if !(dt_s > 0.0 && dt_s.is_finite()) {
        return Err(format!("the time step, {dt_s} s, is not positive"));
    }
    Ok((npts as usize, dt_s))
}

/// The number that follows `at`, after blanks, `=`, `:` and commas; with the position after it.
fn value_after(text: &str, at: usize) -> Option<(f64, usize)> {
    let rest = text.get(at..)?;
    let trimmed = rest.trim_start_matches(|c: char| c.is_whitespace() || "=:,".contains(c));
    let number = scan(trimmed.as_bytes())?;
    Some((
        number.value,
        at + rest.len() - trimmed.len() + number.length,
    ))
}

fn read_values(
    bytes: &[u8],
    npts: usize,
    header_line: usize,
    notes: &mut Vec<Note>,
) -> Result<Block, Problem> {
    // A wrong NPTS must not reserve memory that the file cannot fill: a value takes at least two
    // bytes.
    let mut values = Vec::with_capacity(npts.min(bytes.len() / 2 + 1));
    // Without values, the line that says so.
    let (mut first_line, mut digit_style, mut markers) =
        (header_line, DigitStyle::default(), Markers::default());
    for line in lines(bytes).skip(header_line) {
        let before = values.len();
        fields(line.bytes, |number| {
            digit_style.see(&number, line.number);
            values.push(number.value);
        })
        .map_err(|bad| bad_field(&bad, line.number))?;
        for value in &values[before..] {
            markers.see(*value, line.number)?;
        }
        if before == 0 && !values.is_empty() {
            first_line = line.number;
        }
    }
    notes.extend(markers.judge(&values)?);
    if values.len() == npts {
        notes.extend(digit_style.note());
        return Ok(Block { values, first_line });
    }
    let hint = if values.len() == 2 * npts {
        "if these are columns of time and acceleration, begin the line that names NPTS with #"
    } else {
        "the file may be cut off: fetch it again, or correct NPTS if no value is missing"
    };
    let message = format!(
        "the header declares {npts} values, but the file has {}",
        values.len()
    );
    Err(Problem::format(message, hint).at_line(header_line))
}

/// PEER's second line is `event, date, station, component`. If it is anything else, the file's name
/// is used.
fn name_and_station(title: &str, path: &Path) -> (String, Option<String>) {
    let parts: Vec<&str> = title.split(',').map(str::trim).collect();
    let is_date = |part: &&str| {
        part.split(' ').any(|word| {
            let numbers: Vec<&str> = word.split('/').collect();
            numbers.len() == 3
                && numbers
                    .iter()
                    .all(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
        })
    };
    if let [.., station, component] = parts.as_slice()
        && parts.len() >= 3
        && parts[..parts.len() - 2].iter().any(is_date)
    {
        // "140 (USGS STATION 931)" is component 140.
        let component = component.split('(').next().unwrap_or(component).trim();
        if !component.is_empty() {
            return (component.to_owned(), Some((*station).to_owned()));
        }
    }
    (file_stem(path), None)
}

#[cfg(test)]
mod tests;
