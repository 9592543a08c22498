//! COSMOS, the exchange format of the strong-motion networks, stages V0 (counts) to V2: every block
//! states how many values it has, and their Fortran format.
//!
//! Source: COSMOS Strong Motion Data Format, version 1.20, 2001. Headers are counted from 1, as
//! there.

mod header;

use super::volumes::{first_integer, unannounced};
use crate::motion_file::{
    Component, Found, ReadOptions, Reading, channels_note, end_note, peak_note,
};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::{Block, Format};
use crate::text::fortran::is_missing_value;
use crate::text::lines::{Line, Lines, lines};
use crate::text::units::record_unit;
use freestand::G0_M_S2;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, Unit, shorten};
use freestand_input::words::counted;
use header::{Header, channel_name, read_header, station};
use std::path::Path;

/// The next block must begin within this many lines; comments take a few lines.
const MAX_COMMENTS: usize = 10_000;

/// Whether the text is a COSMOS file: the first line names the format.
pub(super) fn is_cosmos(bytes: &[u8]) -> bool {
    lines(bytes)
        .find(|line| !line.is_blank())
        .is_some_and(|line| is_title(&line))
}

fn is_title(line: &Line<'_>) -> bool {
    let text = line.text().to_ascii_lowercase();
    text.contains("(format v") && text.contains("text lines")
}

/// The line above a series: how many values, what they are, how they are written.
struct Series {
    line: usize,
    title: String,
    count: usize,
    format: Format,
}

/// Reads a COSMOS file: channels one after another, each with its header.
pub(super) fn read(bytes: &[u8], _: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let (mut components, mut notes, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    let mut header: Option<Header> = None;
    // The line of a header whose values have not been read yet.
    let mut open = None;
    let (mut format, mut headers) = ("COSMOS", 0);
    while let Some(line) = rest.find(|line| !line.is_blank()) {
        if is_title(&line) {
            refuse_open(open)?;
            let found = read_header(line.text(), &mut rest)?;
            if components.is_empty() {
                format = stage(&found.text[0]);
            }
            skip_comments(&mut rest);
            headers += 1;
            (header, open) = (Some(found), Some(line.number));
        } else if let (Some(series), Some(header)) = (series(&line)?, &header) {
            open = None;
            let block = read_values(&series, &mut rest, &mut notes)?;
            match not_acceleration(header, &series) {
                Some(what) => refused.push((what, series.line)),
                None => {
                    let channel = components.len() + refused.len() + 1;
                    components.push(component(
                        header, &series, block, channel, options, &mut notes,
                    )?);
                }
            }
        } else if !line.is_text() {
            return Err(unannounced(&line));
        }
    }
    refuse_open(open)?;
    notes.extend(header.and_then(|header| channels_note(&header.text, headers)));
    notes.extend(end_note(bytes, "end-of-data"));
    finish(format, components, notes, &refused)
}

/// A header at the end of the file is a channel that was cut off.
fn refuse_open(open: Option<usize>) -> Result<(), Problem> {
    open.map_or(Ok(()), |line| {
        Err(Problem::format(
            "no values follow the header of a channel",
            "the file may be cut off: fetch it again",
        )
        .at_line(line))
    })
}

fn finish(
    format: &'static str,
    mut components: Vec<Component>,
    mut notes: Vec<Note>,
    refused: &[(&str, usize)],
) -> Result<Reading, Problem> {
    if components.is_empty() {
        let problem = match refused.first() {
            Some((what, line)) => Problem::new(
                ProblemKind::Format,
                format!("holds {what}; an acceleration record is expected"),
            )
            .at_line(*line),
            None => Problem::new(ProblemKind::Format, "holds no series of values"),
        };
        return Err(problem.hint("use the acceleration file of the same record"));
    }
    if !refused.is_empty() {
        let words = format!(
            "{} series of quantities other than acceleration left out",
            refused.len()
        );
        notes.push(Note::new(NoteKind::ChannelLeftOut, words));
    }
    crate::motion_file::tell_apart(&mut components);
    Ok(Reading {
        format,
        components,
        notes,
    })
}

/// V0 is raw, V1 uncorrected, V2 corrected; later files say "Acceleration data" for V2.
fn stage(title: &str) -> &'static str {
    let title = title.trim_start().to_ascii_lowercase();
    if title.starts_with("raw") || title.contains("counts") {
        "COSMOS V0"
    } else if title.contains("uncorrected") {
        "COSMOS V1"
    } else {
        "COSMOS V2"
    }
}

/// Comments begin with a bar; the line that counts them is there even without comments.
fn skip_comments(rest: &mut Lines<'_>) {
    let is_comment = |line: &Line<'_>| {
        let text = line.text();
        line.is_blank()
            || text.trim_start().starts_with('|')
            || text.to_ascii_lowercase().contains("comment")
    };
    rest.leading(is_comment).take(MAX_COMMENTS).for_each(drop);
}

/// `13400 acceleration pts, approx  67 secs, units=g.     (02)Format=(8f9.6)`; `None` for another
/// line.
fn series(line: &Line<'_>) -> Result<Option<Series>, Problem> {
    let title = line.text();
    let lower = title.to_ascii_lowercase();
    if !(lower.contains("format") && (lower.contains("unit") || lower.contains("pts"))) {
        return Ok(None);
    }
    let parsed = first_integer(&title).zip(Format::named_in(&title));
    let Some((count, format)) = parsed else {
        return Err(Problem::format(
            "the number of values or their format is missing",
            "the line above the values should read like \"13400 acceleration pts, \
                 units=g (02),Format=(8f9.6)\"",
        )
        .at_line(line.number));
    };
    Ok(Some(Series {
        line: line.number,
        title: lower,
        count,
        format,
    }))
}

/// The values, up to the line that ends them. Some networks count one more or one less; the end
/// line decides.
fn read_values(
    series: &Series,
    rest: &mut Lines<'_>,
    notes: &mut Vec<Note>,
) -> Result<Block, Problem> {
    let try_count = |count: usize| {
        let mut at = rest.clone();
        let block = series.format.read(&mut at, count, "the record")?;
        Ok((block, at))
    };
    let problem = match try_count(series.count) {
        Ok((block, at)) if at.ahead().is_none_or(|line| line.is_text()) => {
            *rest = at;
            return Ok(block);
        }
        Ok(_) => Problem::format(
            format!(
                "more values follow than the {} that are declared",
                series.count
            ),
            "the file is damaged, or the number of values is wrong: fetch it again",
        )
        .at_line(series.line),
        Err(problem) => problem,
    };
    for count in [
        series.count.saturating_sub(1),
        series.count.saturating_add(1),
    ] {
        // Only the end line proves that a value was miscounted and not lost.
        if let Ok((block, at)) = try_count(count)
            && at
                .ahead()
                .is_some_and(|line| line.text().to_ascii_lowercase().contains("end-of-data"))
        {
            let words = format!(
                "line {} declares {} values, but the record has {count}",
                series.line, series.count
            );
            notes.push(Note::new(NoteKind::CountDiffers, words));
            *rest = at;
            return Ok(block);
        }
    }
    Err(problem)
}

/// What the series is, if it is not an acceleration.
fn not_acceleration(header: &Header, series: &Series) -> Option<&'static str> {
    // Integer header 2, table 1 of the format; 1 is acceleration.
    let of_code = match header.integers[1] as i64 {
        2 => Some("a velocity"),
        3 | 4 => Some("a displacement"),
        10..=99 => Some("a quantity other than acceleration"),
        _ => None,
    };
    // In a file with all three series of a channel, the line above the values names each.
    if series.title.contains("acc") {
        return None;
    }
    let of_title = [("vel", "a velocity"), ("disp", "a displacement")];
    let of_file = [
        ("velocity", "a velocity"),
        ("displacement", "a displacement"),
        ("spectr", "a spectrum"),
    ];
    let title = header.text[0].to_ascii_lowercase();
    named_in(&series.title, &of_title)
        .or(of_code)
        .or_else(|| named_in(&title, &of_file).filter(|_| !title.contains("accel")))
}

/// What the first of these words that a title contains stands for.
fn named_in(title: &str, words: &[(&str, &'static str)]) -> Option<&'static str> {
    let named = words.iter().find(|(word, _)| title.contains(word));
    named.map(|(_, what)| *what)
}

/// Counts, as long as the value of one is not known.
const COUNTS: Unit = Unit::acceleration("counts", 0, 0.0);

/// Unit of the values, by table 2 of the format.
fn unit_of_code(code: usize) -> Option<Unit> {
    Some(match code {
        2 => Unit::acceleration("g", 0, G0_M_S2),
        4 => Unit::acceleration("cm/s2", -2, 1.0),
        7 => Unit::acceleration("in/s2", 0, 0.0254),
        10 => Unit::acceleration("gal", -2, 1.0),
        11 => Unit::acceleration("mg", -3, G0_M_S2),
        12 => Unit::acceleration("micro-g", -6, G0_M_S2),
        50 => COUNTS,
        _ => return None,
    })
}

/// `units=g.     (02)`: the code, else the name.
fn unit(series: &Series) -> Result<Unit, Problem> {
    let stated = series.title.split_once("unit").map_or("", |(_, tail)| tail);
    let stated = stated
        .split("format")
        .next()
        .unwrap_or("")
        .trim_start_matches('s')
        .trim_start_matches([' ', '=', ':']);
    let (name, tail) = stated.split_once('(').unwrap_or((stated, ""));
    let code = tail
        .split(')')
        .next()
        .and_then(|code| code.trim().parse().ok());
    let name = name.trim_end_matches([',', '.', ' ']);
    let named = record_unit(name).filter(|unit| unit.dimension == Dimension::Acceleration);
    let of_code = code.and_then(unit_of_code);
    let wrong = |message: String, hint: &'static str| {
        Err(Problem::format(message, hint).at_line(series.line))
    };
    match (of_code, named) {
        (Some(unit), Some(named))
            if (named.to_si(1.0) - unit.to_si(1.0)).abs() > 1e-9 * unit.to_si(1.0) =>
        {
            let message = format!(
                "the unit is {} by its name, but {} by its code",
                named.symbol, unit.symbol
            );
            wrong(
                message,
                "one of the two is wrong: ask the source of the file, and correct it",
            )
        }
        (Some(unit), _) => Ok(unit),
        (None, Some(named)) if code.is_none() => Ok(*named),
        (None, None) if code.is_none() && name.contains("count") => Ok(COUNTS),
        _ => wrong(
            format!(
                "the unit \"{}\" is not a known unit of acceleration",
                shorten(stated.trim())
            ),
            "known units: g (02), cm/s2 (04), in/s2 (07), gal (10), mg (11), micro-g (12), counts (50)",
        ),
    }
}

fn component(
    header: &Header,
    series: &Series,
    block: Block,
    channel: usize,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Component, Problem> {
    let unit = unit(series)?;
    let is_raw = unit == COUNTS;
    let is_unknown = |value: f64| value == header.missing[1] || is_missing_value(value);
    let name = channel_name(&header.text).unwrap_or_else(|| format!("channel {channel}"));
    if is_raw {
        // These are ordinary counts, which occur in every second record.
        let is_ordinary = |value: f64| value == -999.0 || value == -9999.0;
        notes.extend(block.refuse_missing(series.format, |value| {
            is_unknown(value) && !is_ordinary(value)
        })?);
        let count = block
            .values
            .iter()
            .filter(|value| is_ordinary(**value))
            .count();
        if count > 0 {
            let words = format!(
                "{} of -999 or -9999 read as counts, not as missing",
                counted(count, "value")
            );
            notes.push(Note::of(&name, NoteKind::GapMark, words));
        }
    } else {
        notes.extend(block.refuse_missing(series.format, is_unknown)?);
    }
    let step = header.step(series, is_raw, options)?;
    let scaled = if is_raw {
        Unit::acceleration("counts", 0, header.count_m_s2(notes)?)
    } else {
        unit
    };
    let found = Found {
        station: station(&header.text),
        is_raw,
        ..Found::new(name, scaled, step, block)
    }
    .component(options)?;
    // For counts, the header gives the peak in g or in volts, with or without the mean.
    if !is_raw && let Some(peak) = header.real(64) {
        notes.extend(peak_note(&found, unit.to_si(peak)));
    }
    Ok(found)
}

#[cfg(test)]
mod tests;
