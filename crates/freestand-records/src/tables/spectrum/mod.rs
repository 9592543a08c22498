//! A spectrum in columns: periods and accelerations, with units in their headings.

use crate::text::headings::{Heading, headings_of, in_si, is_time_name};
use crate::text::lines::check_text;
use crate::text::table;
use freestand_input::file::load_up_to;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, lookup, shorten};
use std::path::Path;

/// Longest file of a spectrum \[bytes\]: some hundred thousand periods. Each costs the calculation
/// of an oscillator.
const MAX_BYTES: u64 = 16 << 20;

/// How to write a spectrum: the hint for every problem of its table.
const HINT: &str = "a spectrum is a text with one row per period, below headings with units such as \"period [s]; PSA \
                    [g]\"; decimal commas need a ; between the columns, and comments begin with #";

/// One period of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumRow {
    /// Its line, counted from 1.
    pub line: usize,
    /// Period \[s\].
    pub period_s: f64,
    /// Pseudo-acceleration \[m/s²\].
    pub psa_m_s2: f64,
    /// Damping ratio, where there is a column of it.
    pub damping_ratio: Option<f64>,
}

/// Reads the bytes of a file with a spectrum.
///
/// # Errors
/// A file that cannot be read or is longer than 16 MiB.
pub fn load_spectrum(path: &Path) -> Result<Vec<u8>, Problem> {
    load_up_to(
        path,
        MAX_BYTES,
        "is longer than 16 MiB; a spectrum is expected",
        "name a table of periods and accelerations",
    )
}

/// The rows of a spectrum, as the file has them. Of several accelerations the one called PSA is
/// used, else Sa: `freestand motion spectrum` writes both.
///
/// # Errors
/// No table, a missing unit, no column or several columns that qualify. Values are not checked.
pub fn parse_spectrum(mut bytes: Vec<u8>) -> Result<Vec<SpectrumRow>, Problem> {
    check_text(&mut bytes)?;
    let table = table::read(&bytes).map_err(|problem| problem.hint(HINT))?;
    let wrong = |message: &str| Problem::format(message, HINT).at_line(table.line_of_first_value);
    if table.has_row_of_counts || table.columns.len() < 2 {
        return Err(wrong("is not a table of periods and accelerations"));
    }
    let Some((mut headings, line)) = headings_of(&table) else {
        return Err(wrong(
            "the units of period and acceleration are not stated: there are no headings",
        ));
    };
    headings.iter_mut().for_each(complete);
    let (period, damping) = (period_column(&headings), damping_column(&headings));
    let at_headings = |problem: Problem| problem.at_line(line);
    let period = period.map_err(at_headings)?;
    let psa = acceleration_column(&headings).map_err(at_headings)?;
    // In SI; a ratio may be a bare number.
    let column = |index: usize| in_si(&table, &headings, index);
    let dampings = damping.map(column);
    let values = column(period).into_iter().zip(column(psa));
    let rows = table.lines_of_rows(&bytes).zip(values).enumerate();
    Ok(rows
        .map(|(row, (line, (period_s, psa_m_s2)))| SpectrumRow {
            line,
            period_s,
            psa_m_s2,
            damping_ratio: dampings
                .as_ref()
                .and_then(|dampings| dampings.get(row))
                .copied(),
        })
        .collect())
}

/// Adds the unit at the end of a heading: `period_s`, `psa_g`, `rotd50_g`.
fn complete(heading: &mut Heading) {
    let name = heading.name.to_ascii_lowercase();
    if heading.unit.is_none() {
        heading.unit = match name.rsplit_once('_') {
            Some((_, "g")) => lookup("g"),
            Some(("period" | "t", "s")) => lookup("s"),
            Some((_, "m")) => lookup("m"),
            _ => None,
        };
    }
}

/// The places of the headings for which `holds` is true.
fn places(headings: &[Heading], holds: impl Fn(&Heading) -> bool) -> Vec<usize> {
    headings
        .iter()
        .enumerate()
        .filter(|(_, heading)| holds(heading))
        .map(|(i, _)| i)
        .collect()
}

fn period_column(headings: &[Heading]) -> Result<usize, Problem> {
    let named = |heading: &Heading| {
        let name = heading.name.to_ascii_lowercase();
        matches!(name.as_str(), "t" | "t_s") || name.starts_with("period")
    };
    match places(headings, |heading| heading.measures(Dimension::Time))[..] {
        [one] => match headings.get(one) {
            // T is a time in a record and a period in a spectrum; other words for time are not used
            // for periods.
            Some(heading) if is_time_name(&heading.name) && !named(heading) => {
                let message = format!(
                    "\"{}\" is not a period: this seems to be a record, not a spectrum",
                    shorten(&heading.name)
                );
                let hint = "name a file of periods and pseudo-accelerations; freestand motion spectrum writes one \
                            from a record";
                Err(Problem::format(message, hint))
            }
            _ => Ok(one),
        },
        [] => {
            if let Some(heading) = headings
                .iter()
                .find(|heading| heading.unit.is_none() && named(heading))
            {
                return Err(unit_is_open(heading, "T [s]"));
            }
            Err(Problem::format(
                "no column holds periods",
                "write the periods under a heading such as \"T [s]\"; convert frequencies to periods",
            ))
        }
        _ => Err(Problem::format(
            "several columns hold a time; one column of periods is expected",
            "keep only one column of periods",
        )),
    }
}

/// The column called PSA, else Sa, else the one that is an acceleration.
fn acceleration_column(headings: &[Heading]) -> Result<usize, Problem> {
    let lower = |heading: &Heading| heading.name.to_ascii_lowercase();
    let is_sa = |name: &str| {
        name.strip_prefix("sa")
            .is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
    };
    let found = [
        places(headings, |heading| lower(heading).starts_with("psa")),
        places(headings, |heading| is_sa(&lower(heading))),
        places(headings, |heading| {
            heading.measures(Dimension::Acceleration)
        }),
    ];
    let found = found
        .into_iter()
        .find(|found| !found.is_empty())
        .unwrap_or_default();
    let chosen: Vec<&Heading> = found.iter().filter_map(|&i| headings.get(i)).collect();
    match chosen[..] {
        [heading] => match heading.unit {
            Some(unit) if unit.dimension == Dimension::Acceleration => {
                Ok(found.first().copied().unwrap_or_default())
            }
            Some(unit) => {
                let (name, other) = (shorten(&heading.name), unit.dimension.with_article());
                Err(Problem::format(
                    format!(
                        "\"{name}\" is {other} ({}); an acceleration is expected",
                        unit.symbol
                    ),
                    "write the pseudo-acceleration under a heading such as \"PSA [g]\"",
                ))
            }
            None => Err(unit_is_open(heading, "PSA [g]")),
        },
        [] => match headings
            .iter()
            .find(|heading| heading.unit.is_none() && !is_damping(heading))
        {
            Some(heading) => Err(unit_is_open(heading, "PSA [g]")),
            None => Err(Problem::format(
                "no column holds an acceleration",
                "write the pseudo-acceleration under a heading such as \"PSA [g]\"",
            )),
        },
        _ => {
            let names: Vec<String> = chosen
                .iter()
                .map(|heading| shorten(&heading.name))
                .collect();
            Err(Problem::format(
                format!(
                    "several columns hold a spectral acceleration: {}",
                    names.join(", ")
                ),
                "keep the right one, or call it PSA",
            ))
        }
    }
}

fn is_damping(heading: &Heading) -> bool {
    heading.name.to_ascii_lowercase().starts_with("damping")
}

fn damping_column(headings: &[Heading]) -> Option<usize> {
    places(headings, |heading| {
        is_damping(heading) && (heading.unit.is_none() || heading.measures(Dimension::Ratio))
    })
    .first()
    .copied()
}

fn unit_is_open(heading: &Heading, example: &str) -> Problem {
    let name = shorten(&heading.name);
    Problem::value(
        format!("the unit of \"{name}\" is not stated"),
        format!("write it in the heading, such as \"{example}\""),
    )
}

#[cfg(test)]
mod tests;
