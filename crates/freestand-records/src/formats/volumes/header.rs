//! The header of a channel: text, whole numbers, and what they state.

use super::{MAX_REALS, is_numbers, not_acceleration, unannounced};
use crate::notes::{Note, NoteKind};
use crate::text::fortran::{leading_value, number};
use crate::text::lines::{Line, Lines};
use crate::text::units::{TENTHS_OF_G, record_unit, unit_in_prose};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit};

/// The most lines of text above a channel: 13 in volume I, 25 in volume II, and some wrapped lines.
const MAX_TEXT: usize = 60;

/// Text, integers and reals of a channel.
pub(super) struct Header {
    pub(super) text: Vec<String>,
    pub(super) first_line: usize,
    /// Whole numbers by their columns; `None` for an empty field.
    pub(super) integers: Vec<Option<f64>>,
}

/// Digits, blanks and signs only.
fn is_integer_row(line: &Line<'_>) -> bool {
    !line.is_blank()
        && line
            .bytes
            .iter()
            .all(|b| b.is_ascii_digit() || matches!(b, b' ' | b'-' | b'\t' | 0x0C))
}

/// The first row of integers is full; a line of text with a lone number is shorter.
pub(in crate::formats) fn is_full_integer_row(line: &Line<'_>) -> bool {
    is_integer_row(line) && line.bytes.trim_ascii_end().len() >= 60
}

/// Reads the header of the next channel and leaves `rest` after its integers. `None` at the end of
/// the file.
///
/// # Errors
/// Text without the integers of a header, or numbers without its text.
pub(super) fn read_header(
    rest: &mut Lines<'_>,
    columns: usize,
    may_end: bool,
    notes: &mut Vec<Note>,
) -> Result<Option<Header>, Problem> {
    let mut header = Header {
        text: Vec::new(),
        first_line: 0,
        integers: Vec::new(),
    };
    let start = rest.clone();
    loop {
        let before = rest.clone();
        let line = rest.next();
        if line
            .as_ref()
            .is_some_and(|line| is_full_integer_row(line) && (header.first_line > 0 || !may_end))
        {
            *rest = before;
            break;
        }
        match line {
            Some(line) if header.text.len() < MAX_TEXT => {
                if header.first_line == 0 && !line.is_blank() {
                    if may_end && is_numbers(&line) {
                        return Err(unannounced(&line));
                    }
                    header.first_line = line.number;
                }
                // Blank lines above a channel do not belong to it.
                if header.first_line > 0 {
                    header.text.push(
                        line.text()
                            .chars()
                            .filter(|c| *c != '\x0C')
                            .take(columns)
                            .collect(),
                    );
                }
            }
            _ if may_end
                && !header
                    .text
                    .iter()
                    .any(|text| text.to_ascii_uppercase().contains("ACCELEROGRAM")) =>
            {
                return end(start, rest, notes).map(|()| None);
            }
            _ => {
                return Err(Problem::format(
                    "no integer header follows the lines of text",
                    "the file may be cut off or damaged: fetch it again",
                )
                .at_line(header.first_line.max(1)));
            }
        }
    }
    let mut rows = Vec::new();
    while let Some(line) =
        rest.next_if(|line| line.is_blank() || is_integer_row(line) && rows.len() < MAX_REALS)
    {
        if !line.is_blank() {
            rows.push(line.bytes.trim_ascii_end());
        }
    }
    // 16I5 on seven lines; some of the oldest files have 20I4 on five.
    let width = if rows.len() == 5 { 4 } else { 5 };
    header.integers = rows
        .iter()
        .flat_map(|row| row.chunks(width))
        .map(|field| number(field.trim_ascii()).map(|number| number.value))
        .collect();
    Ok(Some(header))
}

/// Checks that only text without a further channel follows the last one, from `tail` on.
///
/// # Errors
/// Numbers, which may be a channel with a damaged header.
fn end<'a>(
    mut tail: Lines<'a>,
    rest: &mut Lines<'a>,
    notes: &mut Vec<Note>,
) -> Result<(), Problem> {
    if let Some(first) = tail.ahead() {
        if let Some(line) = tail.find(is_numbers) {
            return Err(unannounced(&line));
        }
        notes.push(Note::at(
            first.number,
            NoteKind::TextIgnored,
            "the text after the last channel was ignored",
        ));
    }
    *rest = tail;
    Ok(())
}

/// The whole number that a line begins with.
pub(in crate::formats) fn first_integer(text: &str) -> Option<usize> {
    text.split_whitespace().next()?.parse().ok()
}

/// The step that a line in capitals states: `SPACED AT  .020 SEC`, `INTERVALS OF .020`,
/// `AT 100 PTS/SEC`.
pub(in crate::formats) fn step_in(upper: &str) -> Option<f64> {
    let step = ["SPACED AT", "INTERVALS OF", "INTERVAL OF"]
        .iter()
        .find_map(|words| number_after(upper, words));
    step.or_else(|| {
        let rates = ["PTS/SEC", "POINTS/SEC", "SAMPLES/SEC", "SAMP/SEC", "SPS"];
        let rate = rates.iter().find_map(|words| {
            let (before, _) = upper.split_once(words)?;
            number(before.split_whitespace().next_back()?.as_bytes()).map(|number| number.value)
        });
        rate.filter(|rate| *rate > 0.0).map(|rate| 1.0 / rate)
    })
}

pub(super) fn number_after(text: &str, words: &str) -> Option<f64> {
    let (_, tail) = text.split_once(words)?;
    let tail = tail.trim_start_matches(|c: char| c.is_whitespace() || "=:".contains(c));
    leading_value(tail)
}

/// The unit that a line states: `IN UNITS CM/SEC/SEC`, `units of g.`, `SEC AND G/10`.
///
/// # Errors
/// A unit of another quantity.
pub(super) fn unit_of(text: &str, line: usize) -> Result<Option<Unit>, Problem> {
    let upper = text.to_ascii_uppercase();
    if upper.contains("G/10") {
        return Ok(Some(TENTHS_OF_G));
    }
    let stated = upper
        .split_once("SEC AND ")
        .and_then(|(_, tail)| record_unit(tail.split_whitespace().next()?));
    match stated.or_else(|| unit_in_prose(text)) {
        Some(unit) if unit.dimension == Dimension::Acceleration => Ok(Some(*unit)),
        Some(unit) if unit.dimension != Dimension::Time => Err(not_acceleration(
            &format!("values in {}", unit.symbol),
            line,
        )),
        _ => Ok(None),
    }
}

/// What stands before three blanks.
fn first_part(text: &str) -> &str {
    text.split("   ").next().unwrap_or("").trim()
}

impl Header {
    pub(super) fn lines_with<'a>(&'a self, word: &'a str) -> impl Iterator<Item = String> + 'a {
        self.text
            .iter()
            .map(|line| line.to_ascii_uppercase())
            .filter(move |line| line.contains(word))
    }

    /// The step that the text states.
    pub(super) fn step(&self) -> Option<f64> {
        self.text
            .iter()
            .find_map(|line| step_in(&line.to_ascii_uppercase()))
    }

    /// The unit of volume I: from the line with the word, else from one that names tenths of g.
    pub(super) fn unit(&self) -> Result<Option<Unit>, Problem> {
        for word in ["UNIT", "UNIDAD", "G/10"] {
            for line in self.lines_with(word) {
                let stated = unit_of(&line, self.first_line)?;
                if stated.is_some() {
                    return Ok(stated);
                }
            }
        }
        Ok(None)
    }

    /// `NO. OF POINTS =   8820`.
    pub(super) fn points(&self) -> Option<f64> {
        let counted = ["POINTS", "PUNTOS"].iter().find_map(|word| {
            let line = self.lines_with(word).next()?;
            number_after(&line, word)
        });
        counted.filter(|count| count.fract() == 0.0)
    }

    /// The number of values that the header states, if it is not `count`: volume I in its text,
    /// volume II in text line 16, `3251 POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL`, and
    /// integer 53; there `NO. OF POINTS` is the number of digitised points.
    pub(super) fn other_count(&self, count: usize, is_volume_two: bool) -> Option<f64> {
        let of_text = || {
            let line = self
                .lines_with("CORRECTED")
                .find(|line| line.contains("DATA") && first_integer(line).is_some())?;
            first_integer(&line).map(|count| count as f64)
        };
        let stated = if is_volume_two {
            [of_text(), self.integers.get(52).copied().flatten()]
        } else {
            [self.points(), None]
        };
        stated
            .into_iter()
            .flatten()
            .find(|other| *other > 0.0 && *other != count as f64)
    }

    /// `RECORD LENGTH = 65.000 SEC`, `DURATION =  37.714 SEC`.
    pub(super) fn length_s(&self) -> Option<f64> {
        ["RECORD LENGTH", "DURATION"]
            .iter()
            .find_map(|words| number_after(&self.lines_with(words).next()?, words))
    }

    /// `CHAN  1:  90 DEG` or `COMP N08W`.
    pub(super) fn name(&self, channel: usize) -> String {
        let of_channel = self.text.iter().find_map(|line| {
            let upper = line.trim_start().to_ascii_uppercase();
            let starts = upper.starts_with("CHAN")
                || upper.starts_with("STA CHAN")
                || upper.starts_with("CANAL");
            let (_, name) = line.split_once(':').filter(|_| starts)?;
            Some(first_part(name.split('(').next()?.trim()))
        });
        let of_component = || {
            let line = self
                .text
                .iter()
                .find(|line| line.trim_start().starts_with("COMP"))?;
            let name = line
                .trim_start()
                .trim_start_matches("COMPONENT")
                .trim_start_matches("COMP");
            Some(first_part(name.trim_matches(['=', ':', ' '])))
        };
        let is_named = |name: &&str| !name.is_empty();
        let name = of_channel.filter(is_named).or_else(of_component);
        name.filter(is_named)
            .map_or_else(|| format!("channel {channel}"), str::to_owned)
    }

    /// The line below the one with the station's number and place.
    pub(super) fn station(&self) -> Option<String> {
        let at = self.text.iter().skip(1).position(|line| {
            let upper = line.trim_start().to_ascii_uppercase();
            upper.starts_with("STATION") || upper.starts_with("ESTACION")
        })?;
        let line = self.text.get(at + 2)?.trim();
        let name = line.split("   ").next()?.split(" S/N").next()?.trim();
        (!name.is_empty()).then(|| name.to_owned())
    }
}
