//! K-NET and KiK-net ASCII, of the National Research Institute for Earth Science and Disaster
//! Resilience (NIED), Japan: one component per file, in counts that include the instrument's
//! offset.

use crate::motion_file::{Direction, Found, ReadOptions, Reading, file_stem, peak_note_of};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use crate::text::fortran::{fields, scan};
use crate::text::head::{Head, leading_number};
use crate::text::lines::{Lines, joined, lines};
use crate::text::sampling::step_of_rate;
use crate::text::units::{missing, record_unit};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, shorten};
use std::path::Path;

/// The last line that may belong to the header. It is line 17 in every file of NIED, unless the
/// memo is long.
const HEADER_LINES: usize = 60;

/// Whether the text is a K-NET file: the origin time first, then at least one of the lines about
/// the instrument.
pub(super) fn is_knet(bytes: &[u8]) -> bool {
    let mut head = lines(bytes)
        .take(HEADER_LINES)
        .filter(|line| !line.is_blank());
    head.next()
        .is_some_and(|line| value_of(&line.text(), "origin time").is_some())
        && head.any(|line| {
            let text = line.text();
            ["station code", "sampling freq", "scale factor"]
                .iter()
                .any(|key| value_of(&text, key).is_some())
        })
}

/// Reads a K-NET file: header lines of a name and a value, the last of them the memo, then counts.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let header = Header::read(&mut rest);
    let rate_hz = header.number("sampling freq")?;
    let (line_of_step, _) = header.value("sampling freq")?;
    let dt_s = step_of_rate(rate_hz, line_of_step)?;
    let scale = header.scale()?;
    let Channel {
        name,
        direction,
        is_in_borehole,
    } = component(&header, path);
    let mut block = read_counts(&mut rest)?;
    let mut notes = Vec::new();
    notes.extend(check_duration(&header, rate_hz, block.values.len())?);
    if is_in_borehole {
        let words = "recorded at the bottom of a borehole, not at the surface";
        notes.push(Note::of(&name, NoteKind::Borehole, words));
    }
    for count in &mut block.values {
        *count *= scale.per_count;
    }
    let station = header.value("station code").map_or("", |(_, code)| code);
    let component = Found {
        station: joined(&[station], ""),
        direction,
        is_raw: true,
        ..Found::new(name, *scale.unit, (dt_s, line_of_step), block)
    }
    .component(options)?;
    // The header's peak is the one about the mean, in gal, as NIED's description of the format
    // says.
    if let Ok(peak) = header.number("max acc") {
        let (accel_m_s2, mean_m_s2) = (component.motion.accel_m_s2(), component.motion.mean_m_s2());
        let found = accel_m_s2
            .iter()
            .fold(0.0f64, |largest, a| largest.max((a - mean_m_s2).abs()));
        notes.extend(peak_note_of(&component.name, found, 0.01 * peak));
    }
    Ok(Reading {
        format: "K-NET",
        components: vec![component],
        notes,
    })
}

/// The text after `key` at the start of a header line. Points, brackets and capitals in the name
/// are ignored: `Max. Acc. (gal)    4.954` has `4.954` after `max acc`.
fn value_of<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let mut rest = line.trim_start();
    for letter in key.chars().filter(|c| *c != ' ') {
        rest = rest.trim_start_matches([' ', '.']);
        let first = rest.chars().next()?;
        if !first.eq_ignore_ascii_case(&letter) {
            return None;
        }
        rest = &rest[first.len_utf8()..];
    }
    // "Direction" is not "Dir".
    if rest.starts_with(char::is_alphabetic) {
        return None;
    }
    // Only the point that ends the name: the value may begin with a point, as .000634 does.
    let rest = rest.strip_prefix('.').unwrap_or(rest).trim_start();
    let rest = rest
        .strip_prefix('(')
        .and_then(|unit| unit.split_once(')'))
        .map_or(rest, |(_, value)| value);
    Some(rest.trim_start_matches(':').trim())
}

/// The lines above the counts.
struct Header(Head);

/// The value of one count.
struct Scale {
    per_count: f64,
    unit: &'static Unit,
}

impl Header {
    /// Takes the lines down to the memo or, without a memo, down to the first line of numbers.
    fn read(rest: &mut Lines<'_>) -> Self {
        let mut is_below_memo = false;
        Self(Head::take(rest, HEADER_LINES, |line| {
            let ends = is_below_memo || !line.is_blank() && fields(line.bytes, |_| ()).is_ok();
            is_below_memo = value_of(&line.text(), "memo").is_some();
            ends
        }))
    }

    /// The line that begins with `key`: its number and the text after the key.
    fn value(&self, key: &str) -> Result<(usize, &str), Problem> {
        let hint = "a K-NET header has 17 lines, from Origin Time to Memo.: fetch the file again";
        self.0.find(key, hint, |text| value_of(text, key))
    }

    fn number(&self, key: &str) -> Result<f64, Problem> {
        leading_number(key, self.value(key)?)
    }

    /// `3920(gal)/6182761`: gal divided by counts.
    fn scale(&self) -> Result<Scale, Problem> {
        let (line, text) = self.value("scale factor")?;
        parse_scale(text).ok_or_else(|| {
            Problem::format(
                format!("the scale factor is \"{}\"", shorten(text)),
                "it should read like 3920(gal)/6182761: acceleration/counts",
            )
            .at_line(line)
        })
    }
}

fn parse_scale(text: &str) -> Option<Scale> {
    let (range, counts) = match text.split_once('/') {
        // A slash may also belong to the unit: 3920(cm/s/s)/6182761.
        Some(_) if text.contains(')') => {
            let (range, rest) = text.split_at(text.rfind(')')? + 1);
            (range, rest.trim().strip_prefix('/'))
        }
        Some((range, counts)) => (range, Some(counts)),
        None => (text, None),
    };
    let number = scan(range.trim().as_bytes())?;
    let unit = record_unit(&range.trim()[number.length..])?;
    let counts = match counts {
        Some(text) => {
            let text = text.trim();
            scan(text.as_bytes())
                .filter(|number| number.length == text.len())?
                .value
        }
        None => 1.0,
    };
    let per_count = number.value / counts;
    let sensible =
        unit.dimension == Dimension::Acceleration && per_count.is_normal() && per_count > 0.0;
    sensible.then_some(Scale { per_count, unit })
}

/// What a channel measures.
struct Channel {
    name: String,
    direction: Option<Direction>,
    is_in_borehole: bool,
}

impl Channel {
    /// One of which no more is known than its name.
    fn named(name: String) -> Self {
        Self {
            name,
            direction: None,
            is_in_borehole: false,
        }
    }
}

/// What the header says of the channel.
///
/// KiK-net numbers its channels 1 to 3 in the borehole and 4 to 6 at the surface, in the order
/// north, east, up. The names of its files end with `NS1` to `UD2`, which become the names of the
/// components.
fn component(header: &Header, path: &Path) -> Channel {
    let text = header.value("dir").map_or("", |(_, text)| text);
    let name = match text {
        "" => return Channel::named(file_stem(path)),
        "1" => "NS1",
        "2" => "EW1",
        "3" => "UD1",
        "4" => "NS2",
        "5" => "EW2",
        "6" => "UD2",
        other => other,
    };
    // A number here is a channel, not an azimuth.
    if name.bytes().all(|b| b.is_ascii_digit()) {
        return Channel::named(name.to_owned());
    }
    let numbered = name.strip_suffix(['1', '2']).and_then(Direction::parse);
    Channel {
        name: name.to_owned(),
        direction: numbered.or_else(|| Direction::parse(name)),
        is_in_borehole: numbered.is_some() && name.ends_with('1'),
    }
}

/// The counts and the line of the first. -999 and -32768 are ordinary counts; only a word can mark
/// a missing value.
fn read_counts(rest: &mut Lines<'_>) -> Result<Block, Problem> {
    let (mut values, mut first_line) = (Vec::new(), rest.line_number() + 1);
    for line in rest {
        let before = values.len();
        fields(line.bytes, |number| values.push(number.value))
            .map_err(|bad| crate::text::fortran::bad_field(&bad, line.number))?;
        if let Some(odd) = values[before..].iter().find(|value| value.abs() >= 1e30) {
            return Err(missing(&odd.to_string(), line.number));
        }
        if before == 0 && !values.is_empty() {
            first_line = line.number;
        }
    }
    Ok(Block { values, first_line })
}

/// Checks the duration, which the header states instead of the number of values. One value more or
/// less depends on where the last second ends.
fn check_duration(header: &Header, rate_hz: f64, found: usize) -> Result<Option<Note>, Problem> {
    let (line, _) = header.value("duration time")?;
    let duration_s = header.number("duration time")?;
    let expected = (duration_s * rate_hz).round();
    let difference = (found as f64 - expected).abs();
    if difference > 1.0 {
        let message = format!(
            "the header declares {duration_s} s at {rate_hz} Hz, which are {expected} values, but the file has {found}"
        );
        return Err(Problem::format(
            message,
            "the file may be cut off: fetch it again, or correct the duration if no \
                 value is missing",
        )
        .at_line(line));
    }
    let words = || {
        format!("{found} values were read, but {duration_s} s at {rate_hz} Hz would be {expected}")
    };
    Ok((difference == 1.0).then(|| Note::new(NoteKind::CountDiffers, words())))
}

#[cfg(test)]
mod tests;
