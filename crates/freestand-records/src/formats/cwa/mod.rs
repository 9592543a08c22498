//! The free format of Taiwan's weather service (CWB, since 2023 CWA): time and three components in
//! columns, in gal.

use crate::motion_file::{Direction, Found, ReadOptions, Reading, peak_note};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::{Block, Format};
use crate::text::fortran::scan;
use crate::text::head::{Head, leading_number};
use crate::text::lines::{joined, lines};
use crate::text::rows::{self, Rows};
use crate::text::sampling::step_of_rate;
use crate::text::units::{Stated, decide, record_unit};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use std::path::Path;

/// The last line that may belong to the header. It is line 22 in files with data of the earthquake,
/// line 11 in others.
const HEADER_LINES: usize = 60;

/// Whether the text is such a file: `#Earthquake Information` or, in files without it,
/// `#StationCode:` comes first, and one of the lines about the data follows.
pub(super) fn is_cwa(bytes: &[u8]) -> bool {
    let mut head = lines(bytes)
        .take(HEADER_LINES)
        .filter(|line| !line.is_blank());
    head.next().is_some_and(|line| {
        let first = line.text();
        key_is(&first, "#Earthquake Information") || key_is(&first, "#StationCode")
    }) && head.any(|line| {
        let text = line.text();
        ["#AmplitudeUnit", "#DataSequence"]
            .iter()
            .any(|key| key_is(&text, key))
    })
}

fn key_is(line: &str, key: &str) -> bool {
    line.trim_start()
        .as_bytes()
        .get(..key.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(key.as_bytes()))
}

/// Reads such a file: lines that begin with `#`, then rows of time, and the components that the
/// header names.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header(Head::take(&mut rest, HEADER_LINES, |line| {
        !line.is_comment() && !line.is_blank()
    }));
    let (rate_line, rate_hz) = header.number("#SampleRate")?;
    let dt_s = step_of_rate(rate_hz, rate_line)?;
    let sequence = header.sequence()?;
    let (unit_line, text) = header.value("#AmplitudeUnit").unwrap_or((rate_line, ""));
    let stated = text
        .split_whitespace()
        .next()
        .and_then(record_unit)
        .map(|unit| Stated {
            unit,
            line: unit_line,
        });
    let unit = decide(stated, options.unit()?, "the record")?;
    // "gal. DCoffset(corr)": the agency removed the offset. Without this text, the offset may still
    // be there.
    let is_raw = !text.to_ascii_lowercase().contains("(corr)");

    let format = header.format(sequence.len() + 1)?;
    let mut notes = Vec::new();
    let rows = rows::read(&mut rest, format, &mut notes)?;
    check_times(&rows, rate_hz)?;
    notes.extend(check_length(&header, &rows, rate_hz)?);

    let station = header.value("#StationCode").map_or("", |(_, code)| code);
    let mut components = Vec::new();
    for (channel, values) in sequence.into_iter().zip(rows.columns.into_iter().skip(1)) {
        let peak = header.peak(&channel.name);
        let block = Block {
            values,
            first_line: rows.first_line,
        };
        let component = Found {
            direction: channel.direction(),
            station: joined(&[station], ""),
            is_raw,
            ..Found::new(channel.name, *unit, (dt_s, rate_line), block)
        }
        .component(options)?;
        // If the offset is left in, it is unknown whether the header's peak is counted from the
        // mean.
        if let Some(peak) = peak.filter(|_| !is_raw) {
            notes.extend(peak_note(&component, unit.to_si(peak)));
        }
        components.push(component);
    }
    Ok(Reading {
        format: "CWA",
        components,
        notes,
    })
}

/// `U(+)`: a component and its sign.
struct Channel {
    name: String,
    sign: char,
}

impl Channel {
    fn direction(&self) -> Option<Direction> {
        match (Direction::parse(&self.name), self.sign) {
            (direction, '+') => direction,
            (Some(Direction::Azimuth(degrees)), '-') => {
                Some(Direction::Azimuth((degrees + 180.0) % 360.0))
            }
            _ => None,
        }
    }
}

/// The lines above the numbers.
struct Header(Head);

impl Header {
    /// The text after the colon of the line that begins with `key`.
    fn value(&self, key: &str) -> Result<(usize, &str), Problem> {
        self.0.find(
            key,
            "the header is incomplete: fetch the file again",
            |text| Some(text.split_once(':').filter(|_| key_is(text, key))?.1.trim()),
        )
    }

    fn number(&self, key: &str) -> Result<(usize, f64), Problem> {
        let found = self.value(key)?;
        Ok((found.0, leading_number(key, found)?))
    }

    /// `#DataSequence: Time U(+); N(+); E(+)`: the columns after the time.
    fn sequence(&self) -> Result<Vec<Channel>, Problem> {
        let (line, text) = self.value("#DataSequence")?;
        let mut words = text
            .split(|c: char| c.is_whitespace() || ";,".contains(c))
            .filter(|word| !word.is_empty());
        let channels: Vec<Channel> = words
            .by_ref()
            .skip_while(|word| word.to_ascii_lowercase().starts_with("time"))
            .map(|word| {
                let (name, sign) = word.split_once('(').unwrap_or((word, "+"));
                Channel {
                    name: name.to_owned(),
                    sign: sign.chars().next().unwrap_or('+'),
                }
            })
            .collect();
        let times = text.to_ascii_lowercase().starts_with("time");
        if times
            && !channels.is_empty()
            && channels.len() <= 12
            && channels.iter().all(|one| !one.name.is_empty())
        {
            return Ok(channels);
        }
        Err(Problem::format(
            format!("the columns are given as \"{}\"", shorten(text)),
            "the header line should read like \"#DataSequence: Time U(+); N(+); E(+)\"",
        )
        .at_line(line))
    }

    /// `#Data: 4F10.3`, which the files of all years have.
    fn format(&self, columns: usize) -> Result<Format, Problem> {
        let Ok((line, text)) = self.value("#Data:") else {
            return Ok(Format::new(columns, 10));
        };
        match Format::parse(text) {
            Some(format) if format.per_line == columns => Ok(format),
            _ => Err(Problem::format(
                format!(
                    "the format is \"{}\", but there are {columns} columns",
                    shorten(text)
                ),
                "the header is damaged: fetch the file again",
            )
            .at_line(line)),
        }
    }

    /// `#AmplitudeMAX. U:    4.094~   -4.353`: the larger of the two magnitudes.
    fn peak(&self, name: &str) -> Option<f64> {
        let (_, text) = self.value(&format!("#AmplitudeMAX. {name}:")).ok()?;
        let mut sides = text
            .split('~')
            .map(|side| scan(side.trim().as_bytes()).map(|number| number.value.abs()));
        Some(sides.next()??.max(sides.next()??))
    }
}

/// Checks the times, which only count the rows. A time that is half a step off means that rows were
/// lost or doubled.
fn check_times(rows: &Rows, rate_hz: f64) -> Result<(), Problem> {
    let Some((times, &first)) = rows
        .columns
        .first()
        .and_then(|times| Some((times, times.first()?)))
    else {
        return Ok(());
    };
    let expected = |row: usize| first + row as f64 / rate_hz;
    match times
        .iter()
        .enumerate()
        .find(|(row, time)| (**time - expected(*row)).abs() > 0.5 / rate_hz)
    {
        None => Ok(()),
        Some((row, time)) => {
            let message = format!(
                "the time is {time}, but should be {:.6} at {rate_hz} values per second",
                expected(row)
            );
            Err(Problem::format(
                message,
                "rows are missing or the sampling rate is wrong: fetch the file again",
            )
            // Blank lines between the rows are not counted: no such file has them.
            .at_line(rows.first_line + row))
        }
    }
}

/// Checks the length of the record, which is rounded to few digits and may or may not count the
/// last step.
fn check_length(header: &Header, rows: &Rows, rate_hz: f64) -> Result<Option<Note>, Problem> {
    let Ok((line, text)) = header.value("#RecordLength") else {
        return Ok(None);
    };
    let Some(length) = scan(text.as_bytes()) else {
        return Ok(None);
    };
    let rounding_s = 10f64.powi(length.last_digit_exponent.clamp(-9, 9));
    let found = rows.columns.first().map_or(0, Vec::len);
    let expected = length.value * rate_hz;
    if (found as f64 - expected).abs() <= 1.0 + rounding_s * rate_hz {
        // Neither way of counting gives fewer rows than the length.
        let is_short = expected - found as f64 > 0.5 + 0.5 * rounding_s * rate_hz;
        let words = || {
            format!(
                "{found} rows were read, but {} s at {rate_hz} Hz would be {expected:.0}",
                length.value
            )
        };
        return Ok(is_short.then(|| Note::new(NoteKind::CountDiffers, words())));
    }
    let message = format!(
        "the header declares {} s at {rate_hz} Hz, which are {:.0} rows, but the file has {found}",
        length.value, expected
    );
    Err(Problem::format(
        message,
        "the file may be cut off: fetch it again, or correct the length if no row is missing",
    )
    .at_line(line))
}

#[cfg(test)]
mod tests;
