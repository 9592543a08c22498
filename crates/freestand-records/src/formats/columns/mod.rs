//! Motions in columns, with or without a time column, a header and units.

use crate::motion_file::{Component, Direction, ReadOptions, Reading, Start, file_stem, motion};
use crate::notes::{Note, NoteKind};
use crate::text::dialect::Separator;
use crate::text::even_grid::{Uneven, on_even_grid};
use crate::text::fortran::is_gap_mark;
use crate::text::gaps::{gap, ordinary_note};
use crate::text::headings::{
    Heading, headings_of, is_counter_name, is_time_name, other_quantity, says_unit,
};
use crate::text::sampling::{even_step, time_step};
use crate::text::sensitivity::{no_sensitivity, not_in_volts, volts_of_heading};
use crate::text::stated_step::{count_in_words, dt_in_comment, step_in_prose};
use crate::text::table::{self, Table};
use crate::text::units::{Stated, decide, missing, not_known, unit_in_prose};
use freestand::motion::MAX_SAMPLES;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, lookup, shorten};
use freestand_input::words::number;
use std::path::Path;

/// What the lines above the numbers state.
#[derive(Default)]
struct Stating {
    /// Empty where no line names the columns.
    headings: Vec<Heading>,
    /// Line of the headings.
    line: usize,
    unit: Option<Stated>,
    dt_s: Option<(f64, usize)>,
}

impl Stating {
    /// The heading of a column.
    fn heading(&self, at: usize) -> Option<&Heading> {
        self.headings.get(at)
    }
}

/// The step of the samples, and the times \[s\] of the rows if they must be interpolated to it.
struct Spacing {
    dt_s: f64,
    /// Time of the first row \[s\], if there is a time column.
    start_s: Option<f64>,
    uneven_s: Option<Vec<f64>>,
}

/// Reads text with columns.
pub(super) fn read(bytes: &[u8], path: &Path, options: &ReadOptions) -> Result<Reading, Problem> {
    let mut table = table::read(bytes)?;
    let mut notes = Vec::new();
    let stating = what_is_stated(&table, &mut notes)?;
    let format = match table.dialect.separator {
        Separator::Byte(b',' | b';') => "CSV",
        _ => "columns",
    };
    let first = usize::from(counts_rows(&table, &stating, options));
    if first > 0 {
        let words = "column 1 counts the rows or samples and was ignored";
        notes.push(Note::new(NoteKind::ColumnIgnored, words));
    }
    let (spacing, skip) = match step_of_components(&table, first, &stating, options)? {
        Some(dt_s) => {
            if table.columns.len() > first + 1 && is_time(&table, first, Some(dt_s)) {
                let column = first + 1;
                let words = format!(
                    "column {column} rises by {dt_s} from row to row: if it is the time, leave out `dt`"
                );
                notes.push(Note::new(NoteKind::MayBeTime, words));
            }
            (
                Spacing {
                    dt_s,
                    start_s: None,
                    uneven_s: None,
                },
                first,
            )
        }
        None => (
            spacing_of_column(&table, bytes, first, &stating, options, &mut notes)?,
            first + 1,
        ),
    };
    refuse_spectrum(&stating, first)?;
    let requested = options.unit()?;
    let mut components = Vec::new();
    let mut refused = None;
    let count = table.columns.len() - skip;
    for (i, column) in std::mem::take(&mut table.columns)
        .into_iter()
        .enumerate()
        .skip(skip)
    {
        let heading = stating.heading(i).cloned().unwrap_or_default();
        let what = if count == 1 {
            "the acceleration".to_owned()
        } else {
            format!("column {}", i + 1)
        };
        if let Some(other) = other_quantity(&heading) {
            let words = format!(
                "column {} ({}) is {other} and was ignored",
                i + 1,
                shorten(&heading.name)
            );
            notes.push(Note::new(NoteKind::ColumnIgnored, words));
            refused.get_or_insert(other);
            continue;
        }
        // In other records, V is the vertical component.
        let volts = volts_of_heading(&heading).filter(|_| options.is_shock && requested.is_none());
        let stated = heading
            .unit
            .map(|unit| Stated {
                unit,
                line: stating.line,
            })
            .or(stating.unit);
        let sensor = match (volts, options.sensitivity) {
            (Some(volts), Some(sensor)) => Some((volts, sensor)),
            (Some(_), None) => return Err(no_sensitivity(&heading, stating.line, "10 mV/g")),
            (None, Some(_)) => return Err(not_in_volts(&what).at_line(stating.line)),
            (None, None) => None,
        };
        let of_sensor = sensor.and_then(|_| lookup("m/s2"));
        let unit = of_sensor
            .map_or_else(|| decide(stated, requested, &what), Ok)
            .map_err(|problem| {
                let own = [(stating.line, heading.name.as_str())];
                let others = table
                    .comments
                    .iter()
                    .chain(&table.header)
                    .filter(|(_, text)| text.to_ascii_lowercase().contains("unit"));
                let lines = own
                    .into_iter()
                    .chain(others.map(|(line, text)| (*line, text.as_str())));
                not_known(lines)
                    .filter(|_| stated.is_none())
                    .unwrap_or(problem)
            })?;
        notes.extend(column.digit_style.note());
        let mut values = column.values;
        if let Some(row) = gap(&values, is_gap_mark) {
            return Err(missing(
                &values[row].to_string(),
                table.line_of_row(bytes, row),
            ));
        }
        if let Some(row) = values.iter().position(|&value| is_gap_mark(value)) {
            notes.push(ordinary_note(values[row], table.line_of_row(bytes, row)));
        }
        for value in &mut values {
            *value = sensor.map_or_else(
                || unit.to_si(*value),
                |(volts, sensor)| sensor.si_of(*value * volts),
            );
        }
        if let Some(times_s) = &spacing.uneven_s {
            // All columns together may have as many samples as one motion: two rows of many columns
            // are a short file.
            values = resampled(
                times_s,
                &values,
                spacing.dt_s,
                MAX_SAMPLES / count.max(1),
                &mut notes,
            )
            .map_err(|uneven| uneven_problem(uneven, &table, bytes))?;
        }
        let motion = motion(spacing.dt_s, values, table.line_of_first_value)?;
        let name = match heading.name.as_str() {
            "" if count == 1 => file_stem(path),
            // Numbered as components, which is not the number of the column.
            "" => format!("component {}", components.len() + 1),
            name => name.to_owned(),
        };
        let line_of_first_value = table.line_of_first_value;
        // `1` and `2` number the columns; an azimuth has three digits or a unit.
        let is_number = heading.name.len() < 3 && heading.name.bytes().all(|b| b.is_ascii_digit());
        let direction = Direction::parse(&heading.name).filter(|_| !is_number);
        let unit = unit.symbol;
        components.push(Component {
            name,
            station: None,
            direction,
            unit,
            is_raw: false,
            start: spacing.start_s.map(Start::Column),
            station_xml: None,
            motion,
            line_of_first_value,
        });
    }
    if components.is_empty() {
        let what = refused.unwrap_or("a time");
        return Err(Problem::format(
            format!("no column holds an acceleration, only {what}"),
            "use a file with accelerations, or state their unit in the heading, such as \
                 \"accel [m/s2]\"",
        )
        .at_line(table.line_of_first_value));
    }
    Ok(Reading {
        format,
        components,
        notes,
    })
}

fn what_is_stated(table: &Table, notes: &mut Vec<Note>) -> Result<Stating, Problem> {
    let mut stating = Stating {
        line: table.line_of_first_value,
        ..Stating::default()
    };
    if let Some(dt_s) = table.series_dt_s {
        stating.dt_s = Some((dt_s, table.line_of_first_value));
        let words =
            format!("the first row is read as the number of values and the time step, {dt_s} s");
        notes.push(Note::new(NoteKind::FirstRow, words));
    } else if table.has_row_of_counts {
        notes.push(Note::new(
            NoteKind::FirstRow,
            "the first row is read as the number of values",
        ));
    } else if let Some(count) = table.possible_count() {
        let words = format!(
            "the first row, {count}, is read as a value, but {count} rows follow: remove it if it is their number"
        );
        notes.push(Note::new(NoteKind::FirstRow, words));
    }
    for (line, text) in &table.comments {
        if let Some(unit) = unit_in_prose(text) {
            stating.unit = Some(Stated { unit, line: *line });
            let words = format!(
                "the unit {} is taken from the comment on line {line}",
                unit.symbol
            );
            notes.push(Note::new(NoteKind::UnitFromText, words));
        }
        if let Some(dt_s) = dt_in_comment(text) {
            let dt_s = dt_s.map_err(|problem| problem.at_line(*line))?;
            stating.dt_s = Some((dt_s, *line));
            let words = format!("the time step {dt_s} s is taken from the comment on line {line}");
            notes.push(Note::new(NoteKind::StepFromText, words));
        }
    }
    let rows = table
        .columns
        .first()
        .map_or(0, |column| column.values.len());
    for (line, text) in table.header.iter().chain(&table.comments) {
        if let Some(count) = count_in_words(text).filter(|count| *count != rows as f64) {
            let words = format!(
                "line {line} states {count} values, but the table has {rows} rows: it may be cut off"
            );
            notes.push(Note::new(NoteKind::CountDiffers, words));
        }
    }
    if let Some((headings, line)) = headings_of(table) {
        (stating.headings, stating.line) = (headings, line);
    }
    if stating.unit.is_none() && !table.header.is_empty() {
        // Prose above the numbers may state the unit in words; brackets in prose do not count.
        let prose = table.header.iter().filter(|(line, text)| {
            says_unit(text) && (stating.headings.is_empty() || *line != stating.line)
        });
        stating.unit = prose
            .filter_map(|(line, text)| unit_in_prose(text).map(|unit| Stated { unit, line: *line }))
            .next_back();
        if let Some(stated) = stating.unit {
            let words = format!(
                "the unit {} is taken from line {}",
                stated.unit.symbol, stated.line
            );
            notes.push(Note::new(NoteKind::UnitFromText, words));
        }
    }
    if stating.dt_s.is_none() && has_no_time(table, &stating) {
        stating.dt_s = table
            .header
            .iter()
            .find_map(|(line, text)| Some((step_in_prose(text)?, *line)));
        if let Some((dt_s, line)) = stating.dt_s {
            let words = format!("the time step {dt_s} s is taken from line {line}");
            notes.push(Note::new(NoteKind::StepFromText, words));
        }
    }
    Ok(stating)
}

/// Whether the columns cannot include a time. A step in prose counts only in this case, because it
/// may belong to something else.
fn has_no_time(table: &Table, stating: &Stating) -> bool {
    // Names of directions, "NS,EW,UD", or accelerations.
    let is_acceleration = stating.heading(0).is_some_and(|heading| {
        Direction::parse(&heading.name).is_some() || heading.measures(Dimension::Acceleration)
    });
    table.columns.len() == 1 || is_acceleration
}

/// The time step, if every column is a component: with a step from the user or the file, unless the
/// header says that the first column is the time. `None` if it is the time.
fn step_of_components(
    table: &Table,
    at: usize,
    stating: &Stating,
    options: &ReadOptions,
) -> Result<Option<f64>, Problem> {
    let named = names_time(stating, at);
    if let (Some(dt_s), Some((stated_s, line))) = (options.dt_s, stating.dt_s) {
        agree(dt_s, stated_s, line)?;
    }
    // A step in a comment does not turn a time column with that step into a component.
    let counts_time = |dt_s: f64| {
        options.dt_s.is_none() && table.columns.len() > at + 1 && is_time(table, at, Some(dt_s))
    };
    let step = options.dt_s.or(stating.dt_s.map(|(dt_s, _)| dt_s));
    match step {
        Some(dt_s) if counts_time(dt_s) => Ok(None),
        Some(_) if !named => Ok(step),
        _ if table.columns.len() == at + 1 => {
            let what = if at == 0 {
                "there is one column"
            } else {
                "there is one column besides the number of the sample"
            };
            Err(Problem::value(
                format!("{what} and no time step"),
                "give the time step, such as `dt = \"0.01 s\"`",
            )
            .at_line(table.line_of_first_value))
        }
        _ if stating
            .heading(at)
            .and_then(|heading| heading.unit)
            .is_some_and(|unit| unit.dimension != Dimension::Time) =>
        {
            Err(Problem::format(
                "the first column is not the time",
                "put the time first; without a time column, give `dt`",
            )
            .at_line(stating.line))
        }
        _ => Ok(None),
    }
}

/// Refuses a column of periods instead of the time.
fn refuse_spectrum(stating: &Stating, at: usize) -> Result<(), Problem> {
    let is_period = |heading: &&Heading| heading.name.to_ascii_lowercase().starts_with("period");
    match stating.heading(at).filter(is_period) {
        None => Ok(()),
        Some(heading) => {
            let name = shorten(&heading.name);
            Err(Problem::format(
                format!("\"{name}\" is not a time: this seems to be a spectrum, not a record"),
                "name a record; records are scaled to a spectrum with `scale_to_spectrum`",
            )
            .at_line(stating.line))
        }
    }
}

fn names_time(stating: &Stating, at: usize) -> bool {
    stating
        .heading(at)
        .is_some_and(|heading| match heading.unit {
            Some(unit) => unit.dimension == Dimension::Time,
            None => is_time_name(&heading.name),
        })
}

/// Whether a column rises in equal steps, from 0 or from one step, as motions do not; if `dt_s` is
/// given, in steps of `dt_s`.
fn is_time(table: &Table, at: usize, dt_s: Option<f64>) -> bool {
    let Some(column) = table.columns.get(at) else {
        return false;
    };
    let [first, _, _, ..] = column.values[..] else {
        return false;
    };
    time_step(&column.values, column.last_digit_exponent).is_ok_and(|step| {
        // One part in a thousand, as for a stated step next to printed times.
        let is_step = |value: f64| (value - step).abs() <= 1e-3 * step;
        (first == 0.0 || is_step(first)) && dt_s.is_none_or(is_step)
    })
}

/// Whether the first column is 1, 2, 3 … and named as a number of samples, or the second is the time: read as a time, the first would
/// give a step of one second.
fn counts_rows(table: &Table, stating: &Stating, options: &ReadOptions) -> bool {
    let [numbers, _, ..] = table.columns.as_slice() else {
        return false;
    };
    let counts = numbers.last_digit_exponent == 0
        && numbers
            .values
            .windows(2)
            .all(|pair| pair[1] - pair[0] == 1.0);
    let is_counter = |heading: &Heading| heading.unit.is_none() && is_counter_name(&heading.name);
    let precedes_time = || {
        table.columns.len() > 2
            && !names_time(stating, 0)
            && (names_time(stating, 1) || options.dt_s.is_none() && is_time(table, 1, None))
    };
    counts && (stating.heading(0).is_some_and(is_counter) || precedes_time())
}

fn agree(given_s: f64, stated_s: f64, line: usize) -> Result<(), Problem> {
    // One part in a thousand: a step from printed times includes their rounding.
    if (given_s - stated_s).abs() <= 1e-3 * stated_s {
        return Ok(());
    }
    Err(Problem::value(
        format!("the time step is {stated_s} s according to the file, not {given_s} s"),
        "leave out `dt`, or correct the file if it is wrong",
    )
    .at_line(line))
}

/// The step of the time column, in seconds.
fn spacing_of_column(
    table: &Table,
    bytes: &[u8],
    at: usize,
    stating: &Stating,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Spacing, Problem> {
    let Some(column) = table.columns.get(at) else {
        return Err(Problem::format(
            "there are no columns",
            "name a file with columns of time and acceleration",
        ));
    };
    let heading = stating.heading(at);
    if let Some(heading) =
        heading.filter(|heading| heading.unit.is_none() && heading.name.contains(['[', '(']))
    {
        return Err(Problem::format(
            format!(
                "\"{}\" does not state a unit of time",
                shorten(&heading.name)
            ),
            "the first column is the time: write it in s or ms; without a time column, give `dt`",
        )
        .at_line(stating.line));
    }
    let stated = heading.and_then(|heading| heading.unit);
    if stated.is_none() {
        let column = if at == 0 {
            "the first column".to_owned()
        } else {
            format!("column {}", at + 1)
        };
        notes.push(Note::new(
            NoteKind::TimeAssumed,
            format!("{column} is read as time in seconds"),
        ));
    }
    let to_si = |time: f64| stated.map_or(time, |unit| unit.to_si(time));
    let step = match (
        time_step(&column.values, column.last_digit_exponent),
        options.uneven_dt_s,
    ) {
        (Ok(step), _) => step,
        (Err(_), Some(dt_s)) => {
            let times_s: Vec<f64> = column.values.iter().copied().map(to_si).collect();
            return Ok(Spacing {
                dt_s,
                start_s: times_s.first().copied(),
                uneven_s: Some(times_s),
            });
        }
        (Err(uneven), None) => {
            let is_mended_by_lines = uneven.is_mended_by_lines;
            let problem = uneven_problem(uneven, table, bytes);
            return Err(
                match even_step(&column.values, column.last_digit_exponent) {
                    Some(step) if is_mended_by_lines => problem.hint(format!(
                        "interpolate on straight lines with `resample = \"{} s\"`",
                        to_si(step)
                    )),
                    _ => problem,
                },
            );
        }
    };
    let dt_s = to_si(step);
    let given = options.dt_s.map(|dt_s| (dt_s, stating.line));
    for (other_s, line) in given.into_iter().chain(stating.dt_s) {
        agree(other_s, dt_s, line)?;
    }
    Ok(Spacing {
        dt_s,
        start_s: column.values.first().copied().map(to_si),
        uneven_s: None,
    })
}

fn uneven_problem(uneven: Uneven, table: &Table, bytes: &[u8]) -> Problem {
    Problem::format(uneven.message, uneven.hint).at_line(table.line_of_row(bytes, uneven.row))
}

/// Interpolates a component to equal steps, with notes about the effect.
fn resampled(
    times_s: &[f64],
    values: &[f64],
    dt_s: f64,
    most: usize,
    notes: &mut Vec<Note>,
) -> Result<Vec<f64>, Uneven> {
    let samples = on_even_grid(times_s, values, dt_s, most)?;
    let peak = |values: &[f64]| {
        values
            .iter()
            .fold(0.0, |peak: f64, value| peak.max(value.abs()))
    };
    let (before, after) = (peak(values), peak(&samples));
    let furthest = times_s.windows(2).fold(0.0, |most: f64, pair| {
        most.max((pair[1] - pair[0] - dt_s).abs())
    });
    let words = format!(
        "uneven times were interpolated on straight lines to steps of {dt_s} s: {} points became {} samples; steps \
         were off by up to {} s",
        values.len(),
        samples.len(),
        number(furthest, 3)
    );
    let note = Note::new(NoteKind::Interpolated, words).amount(furthest, "s");
    // Components share their times, so the note is written once.
    if !notes.contains(&note) {
        notes.push(note);
    }
    // A peak between two samples is reduced, unless the step has every time on its grid.
    if after < before * (1.0 - 1e-9) {
        let words = format!(
            "interpolation reduced a peak from {before:.5} to {after:.5} m/s2: a shorter step keeps it"
        );
        notes.push(
            Note::new(NoteKind::PeakReduced, words).amount(100.0 * (before - after) / before, "%"),
        );
    }
    Ok(samples)
}

#[cfg(test)]
mod dialects;
#[cfg(test)]
mod tests;
