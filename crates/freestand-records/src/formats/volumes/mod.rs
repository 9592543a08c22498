//! The layout of Caltech's published accelerograms, which others adopted: channels one after
//! another, each with lines of text, 100 whole numbers, 50 or 100 reals, and the series.
//!
//! Volume I has the record as it was digitised, as pairs of time and value or, later, as values at
//! equal steps below a title line. Volume II has acceleration, velocity and displacement, each
//! below a title line. Source: Hudson et al. (1969-1975), Strong Motion Earthquake Accelerograms,
//! EERL, and the files of CSMIP, USC, RENADIC.

mod header;

pub(super) use header::{first_integer, is_full_integer_row, step_in};

use crate::motion_file::{
    Component, Found, ReadOptions, Reading, channels_note, end_note, length_note, peak_note,
};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::{Block, Format};
use crate::text::fortran::is_missing_value;
use crate::text::lines::{Line, Lines, lines};
use crate::text::pairs::{self, Even};
use crate::text::units::decide;
use freestand::G0_M_S2;
use freestand::motion::MAX_SAMPLES;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Unit, shorten};
use header::{Header, number_after, read_header, unit_of};

/// What differs between networks.
pub(super) struct Network {
    pub(super) volume_one: &'static str,
    pub(super) volume_two: &'static str,
    /// Columns of text. Numbers after them count something else.
    pub(super) columns: usize,
    /// The text of the line that ends a channel, if every file has one.
    pub(super) end_mark: Option<&'static str>,
}

/// The line above equally spaced values.
struct Title {
    line: usize,
    text: String,
    count: usize,
}

/// The most lines of reals: 7 in volume I, 13 in volume II.
const MAX_REALS: usize = 20;

/// The first lines that are not blank, in capitals.
pub(super) fn head(bytes: &[u8], count: usize) -> Vec<String> {
    lines(bytes)
        .filter(|line| !line.is_blank())
        .take(count)
        .map(|line| line.text().to_ascii_uppercase())
        .collect()
}

/// Refuses volume III, which holds response and Fourier spectra.
pub(super) fn refuse_spectra(head: &[String]) -> Result<(), Problem> {
    if head.first().is_some_and(|line| line.contains("RESPONSE")) {
        return Err(Problem::format(
            "holds response spectra (volume III); an acceleration record is expected",
            "use the file of volume II of the same record",
        )
        .at_line(1));
    }
    Ok(())
}

/// Reads the channels of a file.
pub(super) fn read(
    bytes: &[u8],
    options: &ReadOptions,
    network: &Network,
) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let (mut components, mut notes, mut left_out) = (Vec::new(), Vec::new(), Vec::new());
    let mut format = network.volume_one;
    let (mut channel, mut last_text) = (0, Vec::new());
    while let Some(header) = read_header(&mut rest, network.columns, channel > 0, &mut notes)? {
        channel += 1;
        if channel == 1 && is_volume_two(&header.text) {
            format = network.volume_two;
        }
        let title = find_title(&mut rest)?;
        if let Some((what, line)) = other_quantity(&header) {
            skip_values(title.as_ref(), &mut rest)?;
            left_out.push((what, line));
        } else {
            let (component, said) = match title {
                Some(title) => read_series(&header, &title, channel, &mut rest, options),
                None => read_pairs(&header, channel, &mut rest, options, room(&components)),
            }?;
            notes.extend(said);
            notes.extend(peak_of(&header, format == network.volume_two, &component));
            notes.extend(
                header
                    .length_s()
                    .and_then(|stated_s| length_note(&component, stated_s)),
            );
            components.push(component);
        }
        last_text = header.text;
        skip_to_next_channel(&mut rest)?;
    }
    if let Some((what, line)) = left_out.first().filter(|_| components.is_empty()) {
        return Err(not_acceleration(what, *line));
    }
    let left_out = left_out
        .iter()
        .map(|(what, line)| (line, format!("a channel that holds {what} was left out")));
    notes.extend(left_out.map(|(line, words)| Note::at(*line, NoteKind::ChannelLeftOut, words)));
    notes.extend(channels_note(&last_text, channel));
    notes.extend(network.end_mark.and_then(|mark| end_note(bytes, mark)));
    crate::motion_file::tell_apart(&mut components);
    Ok(Reading {
        format,
        components,
        notes,
    })
}

fn not_acceleration(what: &str, line: usize) -> Problem {
    Problem::format(
        format!("holds {what}; an acceleration record is expected"),
        "use the acceleration file of the same record",
    )
    .at_line(line)
}

/// Volume II names the uncorrected record too, from which it was made.
fn is_volume_two(text: &[String]) -> bool {
    let first = text
        .first()
        .map_or_else(String::new, |line| line.to_ascii_uppercase());
    first
        .replace("UNCORRECTED", "")
        .contains("CORRECTED ACCELEROGRAM")
}

/// Skips the reals, to the title of a series or to the first pairs.
fn find_title(rest: &mut Lines<'_>) -> Result<Option<Title>, Problem> {
    let mut ahead = rest.clone();
    let mut after_reals = None;
    for _ in 0..MAX_REALS {
        let Some(line) = ahead.find(|line| !line.is_blank()) else {
            break;
        };
        if line.is_text() {
            let text = line.text();
            let Some(count) = first_integer(&text).filter(|_| is_title(&text)) else {
                break;
            };
            *rest = ahead;
            return Ok(Some(Title {
                line: line.number,
                text,
                count,
            }));
        }
        // 50 and 100 are not multiples of 8, so the last row of reals is short.
        if after_reals.is_none() && line.bytes.trim_ascii_end().len() <= 60 {
            after_reals = Some(ahead.clone());
        }
    }
    let Some(after) = after_reals else {
        return Err(Problem::format(
            "the real header does not end",
            "50 or 100 reals in rows of 8 are expected: the file may be damaged",
        )
        .at_line(rest.line_number()));
    };
    *rest = after;
    Ok(None)
}

fn is_title(text: &str) -> bool {
    let upper = text.to_ascii_uppercase();
    ["POINT", "PTS", "FORMAT", "UNIT", "DATA"]
        .iter()
        .any(|word| upper.contains(word))
}

type Read = Result<(Component, Vec<Note>), Problem>;

fn read_series(
    header: &Header,
    title: &Title,
    channel: usize,
    rest: &mut Lines<'_>,
    options: &ReadOptions,
) -> Read {
    let upper = title.text.to_ascii_uppercase();
    if !upper.contains("ACC") && ["VEL", "DIS"].iter().any(|word| upper.contains(word)) {
        return Err(not_acceleration(
            &format!("\"{}\"", shorten(title.text.trim())),
            title.line,
        ));
    }
    let format = format_of(title, rest);
    let block = format.read(rest, title.count, "acceleration")?;
    let mut notes = Vec::from_iter(block.refuse_missing(format, is_missing_value)?);
    if let Some(line) = rest.ahead().filter(|line| !line.is_text()) {
        return Err(Problem::format(
            format!(
                "more values follow than the {} that are declared",
                title.count
            ),
            format!(
                "the number of values on line {} does not match the file: fetch it again",
                title.line
            ),
        )
        .at_line(line.number));
    }
    let of_header = || header.step().map(|dt_s| (dt_s, header.first_line));
    let at_title = |dt_s| (dt_s, title.line);
    let Some(step) = step_in(&upper)
        .map(at_title)
        .or_else(of_header)
        .or(options.dt_s.map(at_title))
    else {
        return Err(Problem::format(
            "the time step is not stated above the values",
            "give the time step, such as `dt = \"0.02 s\"`",
        )
        .at_line(title.line));
    };
    let unit = match unit_of(&title.text, title.line)? {
        None if !is_volume_two(&header.text) => header.unit()?,
        stated => stated,
    };
    let name = header.name(channel);
    if let Some(other) = header.other_count(title.count, is_volume_two(&header.text)) {
        let (line, count) = (title.line, title.count);
        let words = format!("line {line} declares {count} values, but the header declares {other}");
        notes.push(Note::of(&name, NoteKind::CountDiffers, words));
    }
    // One part in a thousand: rates and steps are printed with three digits or more.
    let (dt_s, _) = step;
    if let Some(other_s) = header
        .step()
        .filter(|other_s| (other_s - dt_s).abs() > 1e-3 * dt_s)
    {
        let words =
            format!("the time step is {dt_s} s above the values, but {other_s} s in the header");
        notes.push(Note::of(&name, NoteKind::StepDiffers, words));
    }
    found(header, channel, unit, step, block, options).map(|component| (component, notes))
}

/// How many samples interpolation may still make. All channels together may have as many as one
/// motion, because a short file can have many channels with damaged times.
fn room(components: &[Component]) -> usize {
    let taken: usize = components
        .iter()
        .map(|one| one.motion.accel_m_s2().len())
        .sum();
    MAX_SAMPLES.saturating_sub(taken)
}

fn read_pairs(
    header: &Header,
    channel: usize,
    rest: &mut Lines<'_>,
    options: &ReadOptions,
    room: usize,
) -> Read {
    let mut pairs = pairs::read(rest)?;
    let notes = std::mem::take(&mut pairs.notes);
    let count = pairs.times_s.len();
    let of_integers = [27, 32].map(|at| header.integers.get(at).copied().flatten());
    let of_text = header.points();
    // Programs write the count in integer 28, in integer 33 or in the text.
    if count == 0 || ![of_text, of_integers[0], of_integers[1]].contains(&Some(count as f64)) {
        let declared = of_text
            .or(of_integers[0])
            .map_or_else(|| "no".to_owned(), |count| count.to_string());
        // A header of blank lines alone has no first line.
        let line = pairs.first_line.max(header.first_line).max(1);
        return Err(Problem::format(
            format!("the header declares {declared} points, but the channel has {count}"),
            "the file may be cut off: fetch it again",
        )
        .at_line(line));
    }
    let first_line = pairs.first_line;
    let name = header.name(channel);
    let Even { dt_s, values, note } = pairs.evenly(&name, options.uneven_dt_s, room)?;
    let block = Block { values, first_line };
    // A step from the user is for files that do not state one; here the times do.
    found(
        header,
        channel,
        header.unit()?,
        (dt_s, first_line),
        block,
        options,
    )
    .map(|component| (component, notes.into_iter().chain(note).collect()))
}

fn found(
    header: &Header,
    channel: usize,
    unit: Option<Unit>,
    step: (f64, usize),
    block: Block,
    options: &ReadOptions,
) -> Result<Component, Problem> {
    let unit = match unit {
        Some(unit) => unit,
        None => *decide(None, options.unit()?, "the record")
            .map_err(|problem| problem.at_line(block.first_line))?,
    };
    Found {
        station: header.station(),
        ..Found::new(header.name(channel), unit, step, block)
    }
    .component(options)
}

/// The format in the title; without one, eight equal fields per line.
fn format_of(title: &Title, rest: &Lines<'_>) -> Format {
    Format::named_in(&title.text).unwrap_or_else(|| {
        let length = rest
            .ahead()
            .map_or(0, |line| line.bytes.trim_ascii_end().len());
        Format::new(
            8,
            if title.count >= 8 && length.is_multiple_of(8) {
                (length / 8).clamp(1, 20)
            } else {
                10
            },
        )
    })
}

/// What a channel holds, if its text says that it is not an acceleration: `Data: Velocity`,
/// response spectra.
fn other_quantity(header: &Header) -> Option<(&'static str, usize)> {
    header.lines_with("DATA:").find_map(|line| {
        let (_, tail) = line.split_once("DATA:")?;
        let word = tail.trim_start();
        let others = [("VEL", "a velocity"), ("DIS", "a displacement")];
        let other = others.iter().find(|(start, _)| word.starts_with(start))?;
        Some((other.1, header.first_line))
    })
}

/// Leaves `rest` at the first line of the next channel, after the velocity and the displacement and
/// the `/&` that ends a channel. Not every channel has that mark, or a title with the word
/// accelerogram: a full row of integers shows that the text above it is a header.
///
/// # Errors
/// A file that ends within the velocity or the displacement: it was cut off. Numbers that no line
/// announces.
fn skip_to_next_channel(rest: &mut Lines<'_>) -> Result<(), Problem> {
    let mut text_from: Option<Lines<'_>> = None;
    loop {
        let before = rest.clone();
        let Some(line) = rest.next() else { break };
        if is_numbers(&line) {
            if is_full_integer_row(&line) && text_from.is_some() {
                break;
            }
            return Err(unannounced(&line));
        }
        if !line.is_text() {
            continue;
        }
        let upper = line.text().to_ascii_uppercase();
        let text = upper.trim_start();
        if text.starts_with("/&") || text.contains("END OF ") {
            return Ok(());
        }
        match first_integer(text) {
            None if text.contains("ACCELEROGRAM") => {
                *rest = before;
                return Ok(());
            }
            Some(count) if is_title(text) => {
                let title = Title {
                    line: line.number,
                    text: upper,
                    count,
                };
                skip_series(&title, rest)?;
            }
            _ => {
                text_from.get_or_insert(before);
            }
        }
    }
    if let Some(text) = text_from {
        *rest = text;
    }
    Ok(())
}

/// Whether a line has only numbers, even if they touch.
fn is_numbers(line: &Line<'_>) -> bool {
    let is_of_number = |b: &u8| {
        b.is_ascii_digit()
            || b.is_ascii_whitespace()
            || matches!(b, b'.' | b'+' | b'-' | b'e' | b'E' | b'd' | b'D')
    };
    line.bytes.iter().all(is_of_number) && line.bytes.iter().any(u8::is_ascii_digit)
}

/// The problem of numbers that may be a channel whose first lines are damaged.
pub(super) fn unannounced(line: &Line<'_>) -> Problem {
    Problem::format(
        "no line states what these numbers are",
        "the line above them may be damaged: fetch the file again",
    )
    .at_line(line.number)
}

/// Skips the contents of a channel that is left out.
fn skip_values(title: Option<&Title>, rest: &mut Lines<'_>) -> Result<(), Problem> {
    if let Some(title) = title {
        return skip_series(title, rest);
    }
    rest.leading(|line| !line.is_text()).for_each(drop);
    Ok(())
}

/// Skips the lines of a series. Only their number is checked, so a value too large for its field
/// does no harm.
fn skip_series(title: &Title, rest: &mut Lines<'_>) -> Result<(), Problem> {
    let wanted = title.count.div_ceil(format_of(title, rest).per_line);
    for found in 0..wanted {
        let before = rest.clone();
        match rest.find(|line| !line.is_blank()) {
            Some(line) if line.is_text() => {
                *rest = before;
                return Ok(());
            }
            Some(_) => {}
            None => {
                let name = shorten(title.text.trim());
                return Err(Problem::format(
                    format!("the file ends after {found} of {wanted} lines of \"{name}\""),
                    "the file is cut off: fetch it again",
                )
                .at_line(rest.line_number()));
            }
        }
    }
    Ok(())
}

/// A note if the values do not have the peak that the text states.
fn peak_of(header: &Header, is_volume_two: bool, component: &Component) -> Option<Note> {
    if is_volume_two {
        let line = header.lines_with("PEAK ACC").next()?;
        return peak_note(component, 0.01 * number_after(&line, "=")?);
    }
    let line = header.lines_with("MAX").next()?;
    let (_, tail) = line.split_once("MAX")?;
    let stated =
        number_after(tail, "=").filter(|_| tail.contains(" G,") || tail.contains(" G."))? * G0_M_S2;
    // Printed to 0.001 g: rounding is half of that.
    let rounding = 6e-4 * G0_M_S2;
    let is_near = (component.motion.peak_m_s2() - stated.abs()).abs() <= rounding;
    peak_note(component, stated).filter(|_| !is_near)
}

#[cfg(test)]
mod tests;
