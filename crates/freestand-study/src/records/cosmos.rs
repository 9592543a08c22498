//! COSMOS, the exchange format of the strong-motion networks, stages V0 (counts) to V2: every block says itself how many
//! values it has and in which Fortran format.
//!
//! Source: COSMOS Strong Motion Data Format, version 1.20, 2001. Headers are counted from 1, as there.

use super::format::{Block, Format};
use super::fortran::{is_missing_value, scan};
use super::lines::{Line, Lines, lines};
use super::units::record_unit;
use super::volumes::{first_integer, is_text, step_in};
use super::{Component, Direction, Found, ReadOptions, Reading, peak_note};
use crate::error::{Problem, ProblemKind};
use crate::quantity::{Dimension, shorten};
use freestand::G0_M_S2;
use std::path::Path;

/// Lines within which the next block must begin: comments are a few lines.
const MOST_COMMENTS: usize = 10_000;

/// Whether the text is a COSMOS file: the first line names the format.
pub(super) fn is_cosmos(bytes: &[u8]) -> bool {
    lines(bytes).find(|line| !line.is_blank()).is_some_and(|line| is_title(&line))
}

fn is_title(line: &Line<'_>) -> bool {
    let text = line.text().to_ascii_lowercase();
    text.contains("(format v") && text.contains("text lines")
}

/// What stands above the values of a channel.
struct Header {
    text: Vec<String>,
    integers: Vec<f64>,
    reals: Vec<f64>,
    line_of_reals: usize,
    /// What stands for a value that is not known, in either header and in the data.
    missing: [f64; 2],
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
    // Where a header stands whose values have not come yet.
    let mut open = None;
    let mut format = "COSMOS";
    while let Some(line) = rest.find(|line| !line.is_blank()) {
        if is_title(&line) {
            refuse_open(open)?;
            let found = read_header(line.text(), &mut rest)?;
            if components.is_empty() {
                format = stage(&found.text[0]);
            }
            rest = skip_comments(rest);
            (header, open) = (Some(found), Some(line.number));
        } else if let (Some(series), Some(header)) = (series(&line)?, &header) {
            open = None;
            let block = read_values(&series, &mut rest, &mut notes)?;
            match not_acceleration(header, &series) {
                Some(what) => refused.push((what, series.line)),
                None => {
                    let channel = components.len() + refused.len() + 1;
                    components.push(component(header, &series, block, channel, options, &mut notes)?);
                }
            }
        } else if !is_text(&line) {
            return Err(Problem::new(ProblemKind::Format, "these numbers belong to no series")
                .at_line(line.number)
                .hint("the line above that counts them may be damaged: fetch the file again"));
        }
    }
    refuse_open(open)?;
    finish(format, components, notes, &refused)
}

/// A header at the end of the file is a channel that was cut off.
fn refuse_open(open: Option<usize>) -> Result<(), Problem> {
    open.map_or(Ok(()), |line| {
        Err(Problem::new(ProblemKind::Format, "no values follow the header of a channel")
            .at_line(line)
            .hint("the file may be cut off: fetch it again"))
    })
}

fn finish(
    format: &'static str,
    mut components: Vec<Component>,
    mut notes: Vec<String>,
    refused: &[(String, usize)],
) -> Result<Reading, Problem> {
    if components.is_empty() {
        let problem = match refused.first() {
            Some((what, line)) => {
                Problem::new(ProblemKind::Format, format!("holds {what}, an acceleration record is expected"))
                    .at_line(*line)
            }
            None => Problem::new(ProblemKind::Format, "holds no series of values"),
        };
        return Err(problem.hint("use the acceleration file of the same record"));
    }
    if !refused.is_empty() {
        notes.push(format!("{} series of other quantities than acceleration are left out", refused.len()));
    }
    super::tell_apart(&mut components);
    Ok(Reading { format, components, notes })
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

fn read_header(first: String, rest: &mut Lines<'_>) -> Result<Header, Problem> {
    let lower = first.to_ascii_lowercase();
    let declared = lower.split("with").nth(1).and_then(first_integer).unwrap_or(13);
    // The format has 13; room for the "exceptional cases" that it allows, not for a damaged number.
    if !(5..=200).contains(&declared) {
        return Err(Problem::new(ProblemKind::Format, format!("the header declares {declared} lines of text"))
            .at_line(rest.line_number())
            .hint("a COSMOS header has 13"));
    }
    let mut text = vec![first];
    text.extend(rest.by_ref().take(declared - 1).map(|line| line.text()));
    let (integers, _) = read_block(rest, "integer header", 54)?;
    let (reals, line_of_reals) = read_block(rest, "real header", 64)?;
    Ok(Header { missing: missing_values(&text), text, integers, reals, line_of_reals })
}

/// `100 Real-header values follow on 17 lines, Format= (6F13.6)`, and the values.
fn read_block(rest: &mut Lines<'_>, what: &str, least: usize) -> Result<(Vec<f64>, usize), Problem> {
    let line = rest.find(|line| !line.is_blank());
    let declared = line.and_then(|line| {
        let text = line.text();
        let names_it = text.to_ascii_lowercase().replace('-', " ").contains(what);
        names_it.then(|| Some((first_integer(&text)?, Format::named_in(&text)?))).flatten()
    });
    let Some((count, format)) = declared else {
        return Err(Problem::new(ProblemKind::Format, format!("the line that describes the {what} is missing"))
            .at_line(line.map_or(rest.line_number(), |line| line.number))
            .hint("it reads like \"100 Real-header values follow on  17 lines, Format= (6F13.6)\""));
    };
    let block = format.read(rest, count, &format!("the {what}"))?;
    if block.values.len() < least {
        return Err(Problem::new(ProblemKind::Format, format!("the {what} has {count} values, 100 are expected"))
            .at_line(block.first_line)
            .hint("the file may be damaged: fetch it again"));
    }
    Ok((block.values, block.first_line))
}

/// Comments begin with a bar; the line that counts them may be there without any.
fn skip_comments(rest: Lines<'_>) -> Lines<'_> {
    let mut at = rest;
    for _ in 0..MOST_COMMENTS {
        let before = at.clone();
        let Some(line) = at.next() else { return before };
        let text = line.text();
        let is_comment = text.trim_start().starts_with('|') || text.to_ascii_lowercase().contains("comment");
        if !(is_comment || line.is_blank()) {
            return before;
        }
    }
    at
}

/// `13400 acceleration pts, approx  67 secs, units=g.     (02)Format=(8f9.6)`; `None` for another line.
fn series(line: &Line<'_>) -> Result<Option<Series>, Problem> {
    let title = line.text();
    let lower = title.to_ascii_lowercase();
    if !(lower.contains("format") && (lower.contains("unit") || lower.contains("pts"))) {
        return Ok(None);
    }
    let parsed = first_integer(&title).zip(Format::named_in(&title));
    let Some((count, format)) = parsed else {
        return Err(Problem::new(ProblemKind::Format, "the number of values or their format is missing")
            .at_line(line.number)
            .hint("the line above the values reads like \"13400 acceleration pts, units=g (02),Format=(8f9.6)\""));
    };
    Ok(Some(Series { line: line.number, title: lower, count, format }))
}

/// Text line 13 ends with what is written for an unknown whole number and real number.
fn missing_values(text: &[String]) -> [f64; 2] {
    let line = text.iter().rev().find(|line| line.to_ascii_lowercase().contains("unknown"));
    let listed = line.and_then(|line| line.rsplit_once(':')).map_or("", |(_, list)| list);
    let mut found = listed.split([',', ' ']).filter_map(|word| scan(word.as_bytes())).map(|number| number.value);
    [found.next().unwrap_or(-999.0), found.next().unwrap_or(-999.0)]
}

/// The values, up to the line that ends them. Some networks count one more or less: the end line tells.
fn read_values(series: &Series, rest: &mut Lines<'_>, notes: &mut Vec<String>) -> Result<Block, Problem> {
    let try_count = |count: usize| {
        let mut at = rest.clone();
        let block = series.format.read(&mut at, count, "the record")?;
        Ok((block, at))
    };
    let problem = match try_count(series.count) {
        Ok((block, at)) if at.ahead().is_none_or(|line| is_text(&line)) => {
            *rest = at;
            return Ok(block);
        }
        Ok(_) => Problem::new(ProblemKind::Format, format!("more than the {} values declared follow", series.count))
            .at_line(series.line)
            .hint("the file is damaged, or the number of values is wrong: fetch it again"),
        Err(problem) => problem,
    };
    for count in [series.count.saturating_sub(1), series.count.saturating_add(1)] {
        // Only the end line proves that a value was miscounted and not lost.
        if let Ok((block, at)) = try_count(count)
            && at.ahead().is_some_and(|line| line.text().to_ascii_lowercase().contains("end-of-data"))
        {
            notes.push(format!("line {} declares {} values, the record has {count}", series.line, series.count));
            *rest = at;
            return Ok(block);
        }
    }
    Err(problem)
}

/// What the series is, where it is not an acceleration.
fn not_acceleration(header: &Header, series: &Series) -> Option<String> {
    // Integer header 2, table 1 of the format; 1 is acceleration.
    let of_code = match header.integers[1] as i64 {
        2 => Some("a velocity"),
        3 | 4 => Some("a displacement"),
        10..=99 => Some("another quantity than acceleration"),
        _ => None,
    };
    // A file with all three series of a channel names each above its values.
    let of_title = if series.title.contains("acc") {
        return None;
    } else if series.title.contains("vel") {
        Some("a velocity")
    } else if series.title.contains("disp") {
        Some("a displacement")
    } else {
        None
    };
    of_title
        .or(of_code)
        .or_else(|| {
            let title = header.text[0].to_ascii_lowercase();
            let names = |word: &str| title.contains(word) && !title.contains("accel");
            if names("velocity") {
                Some("a velocity")
            } else if names("displacement") {
                Some("a displacement")
            } else if names("spectr") {
                Some("a spectrum")
            } else {
                None
            }
        })
        .map(str::to_owned)
}

/// Unit of the values, by table 2 of the format: name and worth in m/s²; 0 for counts.
fn unit_of_code(code: usize) -> Option<(&'static str, f64)> {
    Some(match code {
        2 => ("g", G0_M_S2),
        4 => ("cm/s2", 0.01),
        7 => ("in/s2", 0.0254),
        10 => ("gal", 0.01),
        11 => ("mg", 0.001 * G0_M_S2),
        12 => ("micro-g", 1e-6 * G0_M_S2),
        50 => ("counts", 0.0),
        _ => return None,
    })
}

/// `units=g.     (02)`: the code, else the name.
fn unit(series: &Series) -> Result<(&'static str, f64), Problem> {
    let stated = series.title.split_once("unit").map_or("", |(_, tail)| tail);
    let stated =
        stated.split("format").next().unwrap_or("").trim_start_matches('s').trim_start_matches([' ', '=', ':']);
    let (name, tail) = stated.split_once('(').unwrap_or((stated, ""));
    let code = tail.split(')').next().and_then(|code| code.trim().parse().ok());
    let name = name.trim_end_matches([',', '.', ' ']);
    let named = record_unit(name).filter(|unit| unit.dimension == Dimension::Acceleration);
    let of_code = code.and_then(unit_of_code);
    let wrong = |message: String, hint: &'static str| {
        Err(Problem::new(ProblemKind::Format, message).at_line(series.line).hint(hint))
    };
    match (of_code, named) {
        (Some(unit), Some(named)) if (named.to_si(1.0) - unit.1).abs() > 1e-9 * unit.1 => {
            let message = format!("the unit is {} by its name and {} by its code", named.symbol, unit.0);
            wrong(message, "one of the two is wrong: ask where the file comes from, and correct it")
        }
        (Some(unit), _) => Ok(unit),
        (None, Some(named)) if code.is_none() => Ok((named.symbol, named.to_si(1.0))),
        (None, None) if code.is_none() && name.contains("count") => Ok(("counts", 0.0)),
        _ => wrong(
            format!("the unit \"{}\" is not one of acceleration that is known", shorten(stated.trim())),
            "units read: g (02), cm/s2 (04), in/s2 (07), gal (10), mg (11), micro-g (12), counts (50)",
        ),
    }
}

impl Header {
    /// Real header `number`, counted from 1, if it is known.
    fn real(&self, number: usize) -> Option<f64> {
        let value = *self.reals.get(number - 1)?;
        (value != self.missing[1] && !is_missing_value(value)).then_some(value)
    }

    /// What one count is worth \[m/s²\]: volts a count over volts a g.
    fn count_m_s2(&self, notes: &mut Vec<String>) -> Result<f64, Problem> {
        let positive = |number: usize, what: &str| {
            self.real(number).filter(|value| *value > 0.0).ok_or_else(|| {
                let message = format!("the values are counts, and the header does not give the {what}");
                Problem::new(ProblemKind::Format, message)
                    .at_line(self.line_of_reals)
                    .hint(format!("use the uncorrected file (V1) of the same record, or fill in real header {number}"))
            })
        };
        let volts = positive(22, "recorder's microvolts a count (real header 22)")? / 1e6;
        let volts_a_g = positive(42, "sensor's volts a g (real header 42)")?;
        if let Some(gain) = self.real(47).filter(|gain| *gain != 1.0 && *gain != 0.0) {
            notes.push(format!("the header states a gain of {gain} (real header 47), which is not applied"));
        }
        Ok(volts / volts_a_g * G0_M_S2)
    }

    /// The time step \[s\]: real header 62 in ms, else the rate above the values, which the first version of the format
    /// has. Real header 34 is the recorder's, which holds for its own values only.
    fn dt_s(&self, series: &Series, is_raw: bool, options: &ReadOptions) -> Result<f64, Problem> {
        let of_title = step_in(&series.title.to_ascii_uppercase());
        let of_header = self.real(62).filter(|dt_ms| *dt_ms > 0.0).map(|dt_ms| dt_ms / 1000.0);
        if let (Some(of_title), Some(of_header)) = (of_title, of_header)
            // Rates are printed with three digits or more.
            && (of_title - of_header).abs() > 1e-3 * of_header
        {
            let message = format!("the time step is {of_header} s in the header and {of_title} s above the values");
            return Err(Problem::new(ProblemKind::Format, message)
                .at_line(series.line)
                .hint("one of the two is wrong: ask where the file comes from, and correct it"));
        }
        let recorder = self.real(34).filter(|dt_s| is_raw && *dt_s > 0.0);
        of_header.or(of_title).or(recorder).or(options.dt_s).ok_or_else(|| {
            Problem::new(ProblemKind::Format, "the header does not give the time step (real header 62)")
                .at_line(self.line_of_reals)
                .hint("give the step, such as \"0.005 s\" (--dt, or dt in the study)")
        })
    }
}

fn component(
    header: &Header,
    series: &Series,
    block: Block,
    channel: usize,
    options: &ReadOptions,
    notes: &mut Vec<String>,
) -> Result<Component, Problem> {
    let (unit, unit_m_s2) = unit(series)?;
    let is_raw = unit == "counts";
    let is_unknown = |value: f64| value == header.missing[1] || is_missing_value(value);
    let name = channel_name(&header.text).unwrap_or_else(|| format!("channel {channel}"));
    if is_raw {
        // These are ordinary counts, which every second record passes.
        let is_ordinary = |value: f64| value == -999.0 || value == -9999.0;
        block.refuse_missing(series.format, |value| is_unknown(value) && !is_ordinary(value))?;
        let count = block.values.iter().filter(|value| is_ordinary(**value)).count();
        if count > 0 {
            notes.push(format!("{}: {count} values are -999 or -9999 counts, read as counts", shorten(&name)));
        }
    } else {
        block.refuse_missing(series.format, is_unknown)?;
    }
    let found = Found {
        direction: Direction::parse(&name),
        name,
        station: station(&header.text),
        unit,
        unit_m_s2: if is_raw { header.count_m_s2(notes)? } else { unit_m_s2 },
        dt_s: header.dt_s(series, is_raw, options)?,
        values: block.values,
        line: block.first_line,
        is_raw,
    }
    .component(options)?;
    // Of counts the header has the peak in g or in volts, with the mean removed or not.
    if !is_raw && let Some(peak) = header.real(64) {
        notes.extend(peak_note(&found, peak * unit_m_s2));
    }
    Ok(found)
}

/// `Sta Chan  1: 360 deg (Rcrdr Chan  1)`, `Sta Cha: 1     0 deg (Rcrdr Chan  1)`, `Sta Chan   1  90    HNE   Location:`.
fn channel_name(text: &[String]) -> Option<String> {
    let line =
        text.iter().map(|line| line.trim_start()).find(|line| line.to_ascii_lowercase().starts_with("sta cha"))?;
    let line = line.split('(').next()?.split("Loc").next()?.get(7..)?.trim_start_matches(['n', 'N']);
    let is_between = |c: char| c == ':' || c.is_whitespace();
    let behind_number = line.trim_start_matches(is_between).trim_start_matches(|c: char| c.is_ascii_digit());
    let name = behind_number.trim_matches(is_between).split("   ").next()?.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

/// `Statn No: 05- 23837 Code:CE-23837  CGS  Pomona - Orange Grove & Fairplex`: the name stands from column 41 on.
fn station(text: &[String]) -> Option<String> {
    let line = text.iter().find(|line| line.trim_start().to_ascii_lowercase().starts_with("stat"))?;
    let name: String = line.chars().skip(40).collect();
    let after = line.split_once(':').map_or("", |(_, after)| after);
    let name = if line.contains("Code:") { name.trim() } else { after.trim() };
    (!name.is_empty()).then(|| name.to_owned())
}

#[cfg(test)]
mod tests;
