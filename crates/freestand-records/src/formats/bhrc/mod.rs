//! Iran's strong-motion network (BHRC), volume 1: uncorrected, components L, V and T in each file,
//! in tenths of g.
//!
//! For each component 13 lines of text, 7 of integers, 7 of reals, the values (10E13) and a line
//! that ends the record.

use crate::motion_file::{Component, Direction, Found, ReadOptions, Reading, end_note, three_note};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Format;
use crate::text::fortran::{Number, is_missing_value, scan};
use crate::text::head::next_title;
use crate::text::lines::{Line, Lines, lines};
use crate::text::units::TENTHS_OF_G;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use std::path::Path;

const VALUES: Format = Format::new(10, 13);
const TEXT_LINES: usize = 13;
/// Lines of integers and of reals. They repeat what the text states.
const NUMBER_LINES: usize = 14;

/// The volume that the first line of a component names: `* VOL1DS FILE`.
fn volume(line: &Line<'_>) -> Option<String> {
    let text = line.text().to_ascii_uppercase();
    let name = text
        .trim_start()
        .strip_prefix('*')?
        .split_whitespace()
        .next()?
        .to_owned();
    (name.starts_with("VOL") && name.ends_with("DS")).then_some(name)
}

/// Whether the text is a BHRC file.
pub(super) fn is_bhrc(bytes: &[u8]) -> bool {
    lines(bytes)
        .take(20)
        .find(|line| !line.is_blank())
        .is_some_and(|line| is_title(&line))
}

/// Reads a BHRC file.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let (mut components, mut notes) = (Vec::new(), Vec::new());
    while let (Some(title), _) = next_title(&mut rest, is_title)? {
        let number = components.len() + 1;
        components.push(component(&mut rest, &title, number, options, &mut notes)?);
    }
    notes.extend(end_note(bytes, "end of record"));
    notes.extend(three_note(components.len()));
    Ok(Reading {
        format: "BHRC volume 1",
        components,
        notes,
    })
}

fn is_title(line: &Line<'_>) -> bool {
    volume(line).is_some()
}

fn component(
    rest: &mut Lines<'_>,
    title: &Line<'_>,
    number: usize,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Component, Problem> {
    if let Some(volume) = volume(title).filter(|volume| volume != "VOL1DS") {
        return Err(Problem::format(
            format!("is a {} file; only VOL1DS files are read", shorten(&volume)),
            "use the uncorrected file (volume 1) of the same record",
        )
        .at_line(title.number));
    }
    let text: Vec<String> = rest
        .by_ref()
        .take(TEXT_LINES - 1)
        .map(|line| line.text())
        .collect();
    let Sampling { count, dt_s, line } = sampling(&text, title.number)?;
    rest.by_ref().take(NUMBER_LINES).for_each(drop);
    let block = VALUES.read(rest, count, "acceleration")?;
    notes.extend(block.refuse_missing(VALUES, is_missing_value)?);
    // The letter is alone on its line.
    let name = text
        .iter()
        .map(|line| line.trim())
        .find(|line| matches!(*line, "L" | "V" | "T" | "l" | "v" | "t"));
    let name = name.map_or_else(|| format!("component {number}"), str::to_ascii_uppercase);
    let words = format!("the time step {dt_s} s is the duration divided by the number of values");
    notes.push(Note::of(&name, NoteKind::StepFromDuration, words));
    Found {
        direction: direction(&text, &name),
        station: station(title, &text),
        ..Found::new(name, TENTHS_OF_G, (dt_s, line), block)
    }
    .component(options)
}

/// How a record is sampled.
struct Sampling {
    count: usize,
    dt_s: f64,
    /// The line that says so.
    line: usize,
}

/// `NO OF POINTS = 6013  DURATION = 30.065 SEC`: the line that names the duration, else the
/// eleventh of the header.
fn sampling(text: &[String], line_of_title: usize) -> Result<Sampling, Problem> {
    let at = text
        .iter()
        .position(|line| line.to_ascii_uppercase().contains("DURATION"))
        .unwrap_or(9);
    let line = line_of_title + at + 1;
    let numbers = text
        .get(at)
        .map(|line| numbers_in(line))
        .unwrap_or_default();
    // The step needs both.
    if let [count, duration] = numbers.as_slice()
        && count.value >= 2.0
        && count.value < 1e9
        && count.value.fract() == 0.0
        && duration.value > 0.0
    {
        return Ok(Sampling {
            count: count.value as usize,
            dt_s: step(count.value, *duration),
            line,
        });
    }
    Err(Problem::format(
        "the header does not state the number of values and the duration",
        "the line should read like \"NO OF POINTS = 6013  DURATION = 30.065 SEC\"",
    )
    .at_line(line))
}

/// The step \[s\] of `count` values in a duration with a few decimals. Files may or may not count
/// the last interval. If one of the two ways gives a multiple of half a millisecond, as the
/// network's recorders have, that is the step; else the duration divided by the number of values.
fn step(count: f64, duration: Number) -> f64 {
    let half_digit = 0.5 * 10f64.powi(duration.last_digit_exponent.clamp(-300, 300));
    for intervals in [count, count - 1.0] {
        let plain = (duration.value / intervals * 2000.0).round() / 2000.0;
        if plain > 0.0 && (plain * intervals - duration.value).abs() <= half_digit * (1.0 + 1e-9) {
            return plain;
        }
    }
    duration.value / count
}

/// The numbers in a line of prose.
fn numbers_in(text: &str) -> Vec<Number> {
    let bytes = text.as_bytes();
    let mut numbers = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        // "VOL1" and "SSA-2" hold digits but are not numbers.
        let is_inside_word =
            at > 0 && (bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'-');
        match scan(&bytes[at..]).filter(|_| !is_inside_word) {
            Some(number) => {
                at += number.length;
                numbers.push(number);
            }
            None => at += 1,
        }
    }
    numbers
}

/// The azimuths of L and T are the last two of the five numbers after the word Station; the first
/// are latitude, longitude and height.
fn direction(text: &[String], name: &str) -> Option<Direction> {
    let at = match name {
        "V" => return Some(Direction::Up),
        "L" => 3,
        "T" => 4,
        _ => return None,
    };
    let place = text
        .iter()
        .find_map(|line| Some(&line[line.to_ascii_lowercase().find("station")?..]))?;
    let azimuth = numbers_in(place).get(at)?.value;
    (0.0..=360.0)
        .contains(&azimuth)
        .then_some(Direction::Azimuth(azimuth % 360.0))
}

/// The name before the word Station, else the code after the colon of the title.
fn station(title: &Line<'_>, text: &[String]) -> Option<String> {
    let name = text
        .iter()
        .find_map(|line| line.get(..line.to_ascii_lowercase().find("station")?));
    let title = title.text();
    let code = title
        .split_once(':')
        .and_then(|(_, rest)| rest.split('/').next())
        .unwrap_or("");
    let found = [name.unwrap_or(""), code]
        .into_iter()
        .map(str::trim)
        .find(|text| !text.is_empty());
    found.map(str::to_owned)
}

#[cfg(test)]
pub(super) mod tests;
