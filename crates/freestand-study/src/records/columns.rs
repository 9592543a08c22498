//! Motions in columns: with or without a time column, a header, units.

use super::fortran::is_missing_value;
use super::sampling::time_step;
use super::table::{self, Separator, Table};
use super::units::{Stated, decide, missing, record_unit, requested, unit_in_prose};
use super::{Component, Direction, ReadOptions, Reading, motion};
use crate::error::{Problem, ProblemKind};
use crate::quantity::{self, Dimension, Unit, lookup, shorten};
use std::path::Path;

/// What a header cell says about its column.
#[derive(Debug, Clone, Default, PartialEq)]
struct Heading {
    name: String,
    unit: Option<&'static Unit>,
}

/// What is stated above the numbers.
struct Stating {
    headings: Option<Vec<Heading>>,
    /// Line of the headings.
    line: usize,
    unit: Option<Stated>,
    dt_s: Option<(f64, usize)>,
}

/// Where the time comes from.
enum Time {
    /// The first column.
    Column,
    /// A step from outside the columns: every column is a component.
    Step(f64),
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
    let time = time_source(&table, &stating, options)?;
    let (dt_s, skip) = match time {
        Time::Step(dt_s) => (dt_s, 0),
        Time::Column => (dt_of_column(&table, bytes, &stating, options, &mut notes)?, 1),
    };
    let requested = requested(options.unit.as_deref())?;
    let mut components = Vec::new();
    let mut refused = None;
    let count = table.columns.len() - skip;
    for (i, column) in std::mem::take(&mut table.columns).into_iter().enumerate().skip(skip) {
        let heading = stating.headings.as_ref().and_then(|all| all.get(i)).cloned().unwrap_or_default();
        let what = if count == 1 { "the acceleration".to_owned() } else { format!("column {}", i + 1) };
        if let Some(other) = other_quantity(&heading) {
            notes.push(format!("column {} ({}) is {other} and was not read", i + 1, shorten(&heading.name)));
            refused.get_or_insert(other);
            continue;
        }
        let stated = heading.unit.map(|unit| Stated { unit, line: stating.line }).or(stating.unit);
        let unit = decide(stated, requested, &what)?;
        let mut values = column.values;
        if let Some(row) = values.iter().position(|&value| is_missing_value(value)) {
            return Err(missing(&values[row].to_string(), table.line_of_row(bytes, row)));
        }
        for value in &mut values {
            *value = unit.to_si(*value);
        }
        let motion = motion(dt_s, values, table.line_of_first_value)?;
        let name = match heading.name.as_str() {
            "" if count == 1 => super::file_stem(path),
            // Numbered as --component counts them, which is not how the columns are counted.
            "" => format!("component {}", components.len() + 1),
            name => name.to_owned(),
        };
        let line_of_first_value = table.line_of_first_value;
        let (direction, unit) = (Direction::parse(&heading.name), unit.symbol);
        components.push(Component { name, station: None, direction, unit, is_raw: false, motion, line_of_first_value });
    }
    if components.is_empty() {
        let what = refused.unwrap_or("a time");
        return Err(Problem::new(ProblemKind::Format, format!("no column holds an acceleration, only {what}"))
            .at_line(table.line_of_first_value)
            .hint("a column of acceleration beside the time is needed"));
    }
    Ok(Reading { format, components, notes })
}

fn what_is_stated(table: &Table, notes: &mut Vec<String>) -> Result<Stating, Problem> {
    let mut stating = Stating { headings: None, line: table.line_of_first_value, unit: None, dt_s: None };
    if let Some(dt_s) = table.series_dt_s {
        stating.dt_s = Some((dt_s, table.line_of_first_value));
        notes.push(format!("the first row is read as the number of values and the time step, {dt_s} s"));
    }
    for (line, text) in &table.comments {
        if let Some(unit) = unit_in_prose(text) {
            stating.unit = Some(Stated { unit, line: *line });
            notes.push(format!("the unit {} is taken from the comment on line {line}", unit.symbol));
        }
        if let Some(value) = assigned(text, "dt") {
            let dt_s = parse_dt(value).map_err(|problem| problem.at_line(*line))?;
            stating.dt_s = Some((dt_s, *line));
            notes.push(format!("the time step {dt_s} s is taken from the comment on line {line}"));
        }
    }
    take_headings(table, &mut stating);
    if stating.unit.is_none() && !table.header.is_empty() {
        // Prose above the numbers may state the unit in so many words; brackets in it would be no such statement.
        let prose = table
            .header
            .iter()
            .filter(|(line, text)| says_unit(text) && (stating.headings.is_none() || *line != stating.line));
        stating.unit =
            prose.filter_map(|(line, text)| unit_in_prose(text).map(|unit| Stated { unit, line: *line })).next_back();
        if let Some(stated) = stating.unit {
            notes.push(format!("the unit {} is taken from line {}", stated.unit.symbol, stated.line));
        }
    }
    Ok(stating)
}

/// The headings are the last header line, or the one above a line of units; in their absence a comment will do, if it
/// names units, because a comment that happens to have as many words as there are columns is no header.
fn take_headings(table: &Table, stating: &mut Stating) {
    let from = |text: &str| -> Option<Vec<Heading>> {
        let headings: Vec<Heading> = table.names(text)?.iter().map(|cell| heading(cell)).collect();
        // "Units: cm/s2" above two columns has two words and is no header.
        let statement = says_unit(text) && headings.iter().all(|heading| heading.unit.is_none());
        (!statement).then_some(headings)
    };
    let mut lines = table.header.iter().rev();
    if let Some((line, text)) = lines.next() {
        let units: Option<Vec<_>> =
            table.names(text).and_then(|cells| cells.iter().map(|cell| record_unit(cell)).collect());
        match (units, lines.next().and_then(|(line, text)| Some((line, from(text)?)))) {
            (Some(units), Some((_, mut headings))) => {
                for (heading, unit) in headings.iter_mut().zip(units) {
                    heading.unit = Some(unit);
                }
                (stating.headings, stating.line) = (Some(headings), *line);
            }
            (Some(units), None) => {
                let headings = units.iter().map(|unit| Heading { name: String::new(), unit: Some(unit) }).collect();
                (stating.headings, stating.line) = (Some(headings), *line);
            }
            _ => {
                if let Some(headings) = from(text) {
                    (stating.headings, stating.line) = (Some(headings), *line);
                }
            }
        }
    }
    if stating.headings.is_none()
        && let Some((line, text)) = table.comments.last()
        && let Some(headings) = from(text)
        && headings.iter().all(|heading| heading.unit.is_some() && !heading.name.is_empty())
    {
        (stating.headings, stating.line) = (Some(headings), *line);
    }
}

/// Whether a line of prose states a unit in so many words.
fn says_unit(text: &str) -> bool {
    text.to_ascii_lowercase().contains("unit") && unit_in_prose(text).is_some()
}

/// `time [ms]`, `Accel[g]`, `accel (m/s2)`, and the unit suffixes of our own files, `time_s` and `accel_m_s2`.
fn heading(cell: &str) -> Heading {
    let cell = cell.trim().trim_matches('"').trim();
    if let (Some(open), Some(close)) = (cell.rfind(['[', '(']), cell.rfind([']', ')']))
        && open < close
    {
        // Brackets that hold no unit belong to the name: "a (NS)", "a (EW)".
        let unit = record_unit(&cell[open + 1..close]);
        let name = if unit.is_some() { cell[..open].trim() } else { cell };
        return Heading { name: name.to_owned(), unit };
    }
    let suffixes = [("_m_s2", "m/s2"), ("_m_s", "m/s"), ("_rad_s", "rad/s"), ("_m", "m"), ("_g", "g")];
    let suffix = suffixes.iter().find(|(suffix, _)| cell.ends_with(suffix));
    let unit = match suffix {
        // `_g` and `_m` end ordinary names too; only on names of what they measure are they units.
        Some(("_g", _)) if !cell.to_ascii_lowercase().starts_with("accel") => None,
        Some(("_m", _)) if !is_other_name(cell) => None,
        Some((_, symbol)) => lookup(symbol),
        None if matches!(cell, "time_s" | "t_s") => lookup("s"),
        None => None,
    };
    Heading { name: cell.to_owned(), unit }
}

fn is_time_name(name: &str) -> bool {
    matches!(name.to_ascii_lowercase().as_str(), "time" | "t" | "time_s" | "t_s" | "zeit" | "temps" | "tiempo")
}

fn is_other_name(name: &str) -> bool {
    let lower = name.to_ascii_lowercase();
    lower.starts_with("vel") || lower.starts_with("disp")
}

/// What a column is, if it is no acceleration.
fn other_quantity(heading: &Heading) -> Option<&'static str> {
    match heading.unit {
        Some(unit) if unit.dimension != Dimension::Acceleration => Some(unit.dimension.with_article()),
        Some(_) => None,
        None => {
            let name = heading.name.to_ascii_lowercase();
            let others = [("vel", "a velocity"), ("disp", "a displacement"), ("force", "a force"), ("load", "a force")];
            others.iter().find(|(start, _)| name.starts_with(start)).map(|(_, what)| *what)
        }
    }
}

/// `dt=0.005` in a comment: the text after the equals sign, as far as the next blank that no unit follows.
fn assigned<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    text.match_indices('=').find_map(|(at, _)| {
        let name = text[..at].trim_end().rsplit(|c: char| c.is_whitespace() || ",;(".contains(c)).next()?;
        let value = text[at + 1..].trim_start();
        name.eq_ignore_ascii_case(key).then(|| value.split([' ', '\t', ',', ';', ')']).next().unwrap_or(value))
    })
}

/// A step that its key states to be in seconds, or one with a unit.
fn parse_dt(text: &str) -> Result<f64, Problem> {
    let seconds = quantity::find_unit("s", Dimension::Time)?;
    let bare = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    let dt_s = if bare { quantity::parse_in_unit(text, seconds)? } else { quantity::parse(text, Dimension::Time)? };
    if dt_s > 0.0 {
        Ok(dt_s)
    } else {
        Err(Problem::new(ProblemKind::Value, format!("dt must be positive, not {dt_s} s"))
            .hint("write it as \"dt=0.005\", in seconds"))
    }
}

/// With a step from the flag or the file every column is a component, unless the header says that the first is the time.
fn time_source(table: &Table, stating: &Stating, options: &ReadOptions) -> Result<Time, Problem> {
    let first = stating.headings.as_ref().and_then(|headings| headings.first());
    let named = first.is_some_and(|heading| match heading.unit {
        Some(unit) => unit.dimension == Dimension::Time,
        None => is_time_name(&heading.name),
    });
    if let (Some(dt_s), Some((stated_s, line))) = (options.dt_s, stating.dt_s) {
        agree(dt_s, stated_s, line)?;
    }
    let step = options.dt_s.or(stating.dt_s.map(|(dt_s, _)| dt_s));
    match step {
        Some(dt_s) if !named => Ok(Time::Step(dt_s)),
        _ if table.columns.len() == 1 => Err(Problem::new(ProblemKind::Value, "there is one column and no time step")
            .at_line(table.line_of_first_value)
            .hint("give the step, such as \"0.01 s\" (--dt, or dt in the study)")),
        _ if first.and_then(|heading| heading.unit).is_some_and(|unit| unit.dimension != Dimension::Time) => {
            Err(Problem::new(ProblemKind::Format, "the first column is not the time")
                .at_line(stating.line)
                .hint("put the time first; where there is none, give the step (--dt, or dt in the study)"))
        }
        _ => Ok(Time::Column),
    }
}

fn agree(given_s: f64, stated_s: f64, line: usize) -> Result<(), Problem> {
    // One part in a thousand: a step read from printed times may carry their rounding.
    if (given_s - stated_s).abs() <= 1e-3 * stated_s {
        return Ok(());
    }
    Err(Problem::new(ProblemKind::Value, format!("the time step is {stated_s} s as the file says, not {given_s} s"))
        .at_line(line)
        .hint("leave out the step (--dt, or dt in the study), or correct the file if it is wrong"))
}

/// The step that the time column means, in seconds.
fn dt_of_column(
    table: &Table,
    bytes: &[u8],
    stating: &Stating,
    options: &ReadOptions,
    notes: &mut Vec<String>,
) -> Result<f64, Problem> {
    let Some(column) = table.columns.first() else {
        return Err(Problem::new(ProblemKind::Format, "there are no columns"));
    };
    let heading = stating.headings.as_ref().and_then(|headings| headings.first());
    if let Some(heading) = heading.filter(|heading| heading.unit.is_none() && heading.name.contains(['[', '('])) {
        return Err(Problem::new(
            ProblemKind::Format,
            format!("\"{}\" states no unit of time", shorten(&heading.name)),
        )
        .at_line(stating.line)
        .hint("the first column is the time; write it in s or ms; where there is none, give the step (--dt, or dt in the study)"));
    }
    let stated = heading.and_then(|heading| heading.unit);
    if stated.is_none() {
        notes.push("the first column is read as time in seconds".to_owned());
    }
    let step = time_step(&column.values, column.last_digit_exponent).map_err(|uneven| {
        Problem::new(ProblemKind::Format, uneven.message)
            .at_line(table.line_of_row(bytes, uneven.row))
            .hint(uneven.hint)
    })?;
    let dt_s = stated.map_or(step, |unit| unit.to_si(step));
    for (other_s, line) in options.dt_s.map(|dt_s| (dt_s, stating.line)).into_iter().chain(stating.dt_s) {
        agree(other_s, dt_s, line)?;
    }
    Ok(dt_s)
}

#[cfg(test)]
mod tests;
