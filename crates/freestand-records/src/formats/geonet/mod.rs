//! GeoNet's V1A (uncorrected) and V2A (corrected), New Zealand: up to three components per
//! file, in mm/s².
//!
//! For each component 16 lines of text, 40 integers (10I8), 60 reals (10F8) and the accelerations
//! (10F8); in a V2A file the velocities and displacements follow. Source: GeoNet, "Strong motion
//! file formats".

use crate::motion_file::{
    Component, Found, ReadOptions, Reading, length_note, peak_note, three_note,
};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::{Block, Format};
use crate::text::fortran::is_missing_value;
use crate::text::head::next_title;
use crate::text::lines::{Line, Lines, lines};
use freestand_input::problem::Problem;
use freestand_input::quantity::Unit;
use freestand_input::words::counted;
use std::path::Path;

const INTEGERS: Format = Format::new(10, 8);
const REALS: Format = Format::new(10, 8);
const VALUES: Format = Format::new(10, 8);
const UNIT: Unit = Unit::acceleration("mm/s2", -3, 1.0);
const TEXT_LINES: usize = 16;

#[derive(Clone, Copy, PartialEq)]
enum Volume {
    Uncorrected,
    Corrected,
}

/// The kind of a component, from its first line.
fn volume(line: &Line<'_>) -> Option<Volume> {
    let title = line.text().trim_start().to_ascii_lowercase();
    if title.starts_with("uncorrected accelerogram") {
        return Some(Volume::Uncorrected);
    }
    title
        .starts_with("corrected accelerogram")
        .then_some(Volume::Corrected)
}

/// Whether the text is a GeoNet file. The files of other agencies also have the words "corrected
/// accelerogram", so the file must name GNS Science or begin its second line with the site, and a
/// line must name the component.
pub(super) fn is_geonet(bytes: &[u8]) -> bool {
    let mut head = lines(bytes).take(20).filter(|line| !line.is_blank());
    let Some(title) = head.next().filter(|line| volume(line).is_some()) else {
        return false;
    };
    let title = title.text().to_ascii_lowercase();
    let site = head.next().is_some_and(|line| {
        line.text()
            .trim_start()
            .to_ascii_lowercase()
            .starts_with("site ")
    });
    (site || title.contains("gns science") || title.contains("geonet"))
        && head.any(|line| {
            line.text()
                .trim_start()
                .to_ascii_lowercase()
                .starts_with("component")
        })
}

/// Reads a GeoNet file.
pub(super) fn read(bytes: &[u8], _path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut rest = lines(bytes);
    let (mut components, mut notes) = (Vec::new(), Vec::new());
    let mut format = "GeoNet V2A";
    loop {
        let (title, ignored) = next_title(&mut rest, |line| volume(line).is_some())?;
        if ignored > 0 {
            let words = format!(
                "{} of text between or after the components ignored",
                counted(ignored, "line")
            );
            notes.push(Note::new(NoteKind::TextIgnored, words));
        }
        let Some(volume) = title.and_then(|line| volume(&line)) else {
            break;
        };
        if components.is_empty() && volume == Volume::Uncorrected {
            format = "GeoNet V1A";
        }
        let number = components.len() + 1;
        components.push(component(&mut rest, volume, number, options, &mut notes)?);
    }
    notes.extend(three_note(components.len()));
    Ok(Reading {
        format,
        components,
        notes,
    })
}

/// Reads what follows the first line of a component.
fn component(
    rest: &mut Lines<'_>,
    volume: Volume,
    number: usize,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Component, Problem> {
    let text: Vec<String> = rest
        .by_ref()
        .take(TEXT_LINES - 1)
        .map(|line| line.text())
        .collect();
    let integers = INTEGERS.read(rest, 40, "the integer header")?;
    let reals = REALS.read(rest, 60, "the real header")?;
    let count = |at: usize, what: &str| integers.count(at, INTEGERS, what);
    // Integers 31 and 34 to 36: samples digitised, and in the blocks of acceleration, velocity and
    // displacement. An uncorrected record has all samples that were digitised. If its two numbers
    // differ, the one with which the block ends correctly is right.
    let accelerations = count(33, "accelerations")?;
    let counts = match volume {
        Volume::Corrected => vec![accelerations],
        Volume::Uncorrected => vec![count(30, "samples")?, accelerations],
    };
    let others = [count(34, "velocities")?, count(35, "displacements")?];
    let mut block = data(rest, &counts, others)?;
    let found = block.values.len();
    notes.extend(block.refuse_missing(VALUES, is_missing_value)?);

    let name = name(&text).unwrap_or_else(|| format!("component {number}"));
    // Real 8 converts the readings of an uncorrected record to mm/s²; it is 1 if they are in mm/s².
    let factor = reals.values[7];
    let is_scaled = volume == Volume::Uncorrected && factor > 0.0 && (factor - 1.0).abs() > 1e-9;
    if is_scaled {
        for value in &mut block.values {
            *value *= factor;
        }
        let words = format!("the readings are in units of {factor} mm/s2, according to the header");
        notes.push(Note::of(&name, NoteKind::Readings, words));
    }
    // Real 26 is the interval of the samples in the file, real 25 that of the instrument, which
    // may be shorter.
    let step = (reals.values[25], reals.first_line + 2);
    let component = Found {
        station: station(&text),
        ..Found::new(name, UNIT, step, block)
    }
    .component(options)?;
    // Reals 31 and 36: the peaks of the unfiltered and of the filtered record.
    let peak = if volume == Volume::Uncorrected {
        reals.values[30]
    } else {
        reals.values[35]
    };
    notes.extend(peak_note(&component, UNIT.to_si(peak)));
    // Real 24: the duration. In a complete file, integers 34 to 36 are equal.
    notes.extend(length_note(&component, reals.values[23]));
    if let Some(other) = others
        .into_iter()
        .find(|&other| other != 0 && other != found)
    {
        let words = format!(
            "{found} accelerations were read, but the header declares {other} velocities or displacements"
        );
        notes.push(Note::of(&component.name, NoteKind::CountDiffers, words));
    }
    Ok(component)
}

/// The accelerations. Their number is the first of `counts` after which a component or the end of
/// the file follows.
///
/// # Errors
/// No count fits, or the file ends within the velocities or displacements: it was cut off.
fn data(rest: &mut Lines<'_>, counts: &[usize], others: [usize; 2]) -> Result<Block, Problem> {
    let mut refused = None;
    for &count in counts {
        let mut tail = rest.clone();
        let read = VALUES
            .read(&mut tail, count, "acceleration")
            .and_then(|block| {
                skip_others(&mut tail, others)?;
                next_title(&mut tail.clone(), |line| volume(line).is_some()).map(|_| block)
            });
        match read {
            Ok(block) => {
                *rest = tail;
                return Ok(block);
            }
            Err(problem) => {
                refused.get_or_insert(problem);
            }
        }
    }
    Err(refused.unwrap_or_else(|| {
        Problem::format(
            "the header declares no values",
            "the file may be damaged: fetch it again",
        )
    }))
}

/// Skips velocities and displacements. Only their number is checked, so a value too large for its
/// field does no harm.
fn skip_others(rest: &mut Lines<'_>, others: [usize; 2]) -> Result<(), Problem> {
    for (count, what) in others.into_iter().zip(["velocity", "displacement"]) {
        let wanted = count.div_ceil(VALUES.per_line);
        let (mut found, mut width) = (0, 0);
        for line in rest.by_ref().filter(|line| !line.is_blank()).take(wanted) {
            (found, width) = (found + 1, line.bytes.trim_ascii_end().len());
        }
        // At the end of the file, the last line must be complete too.
        let fields_in_last = count - VALUES.per_line * wanted.saturating_sub(1);
        if found < wanted || rest.bytes_left() == 0 && width < fields_in_last * VALUES.width {
            return Err(Problem::format(
                format!("the file ends after {found} of {wanted} lines of {what}"),
                "the file is cut off: fetch it again",
            )
            .at_line(rest.line_number()));
        }
    }
    Ok(())
}

/// `Component S16W  Longitudinal Accelerometer Axis`.
fn name(text: &[String]) -> Option<String> {
    let mut words = text.iter().map(|line| line.split_whitespace());
    words.find_map(|mut words| {
        words
            .next()
            .filter(|word| word.eq_ignore_ascii_case("component"))?;
        words.next().map(str::to_owned)
    })
}

/// The code of the site on the second line, and its name on the third.
fn station(text: &[String]) -> Option<String> {
    let mut site = text.first()?.split_whitespace();
    site.next()
        .filter(|word| word.eq_ignore_ascii_case("site"))?;
    let name = text.get(1).map_or("", |line| line.trim());
    Some(format!("{} {name}", site.next()?).trim_end().to_owned())
}

#[cfg(test)]
pub(super) mod tests;
