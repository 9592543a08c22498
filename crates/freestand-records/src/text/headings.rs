//! Name and unit of a column, from its cell in the header.

use super::table::Table;
use super::units::{record_unit, unit_in_prose};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, lookup, shorten};

/// Name and unit of a column.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Heading {
    pub(crate) name: String,
    pub(crate) unit: Option<&'static Unit>,
}

impl Heading {
    pub(crate) fn measures(&self, dimension: Dimension) -> bool {
        self.unit.is_some_and(|unit| unit.dimension == dimension)
    }

    /// Whether its name is that of a force.
    pub(crate) fn is_force(&self) -> bool {
        is_force(&self.name)
    }
}

/// The place of the only heading for which `is_it` holds; `what` names the column in messages.
///
/// # Errors
/// Two such headings.
pub(crate) fn only(
    headings: &[Heading],
    line: usize,
    is_it: impl Fn(&Heading) -> bool,
    what: &str,
) -> Result<Option<usize>, Problem> {
    let mut found = headings
        .iter()
        .enumerate()
        .filter(|(_, heading)| is_it(heading));
    let first = found.next();
    if let (Some((_, one)), Some((_, other))) = (first, found.next()) {
        let names = format!(
            "\"{}\" and \"{}\"",
            shorten(&one.name),
            shorten(&other.name)
        );
        return Err(Problem::format(
            format!("{names} are both {what}"),
            "keep only one of them in the file",
        )
        .at_line(line));
    }
    Ok(first.map(|(index, _)| index))
}

/// `time [ms]`, `Accel[g]`, `accel (m/s2)`, `Time, s`, `a / g`, `acc in g`, and the unit suffixes
/// of freestand's own files: `time_s`, `accel_m_s2`, `acc_g`.
pub(crate) fn heading(cell: &str) -> Heading {
    let cell = cell.trim().trim_matches('"').trim();
    if let (Some(open), Some(close)) = (cell.rfind(['[', '(']), cell.rfind([']', ')']))
        && open < close
    {
        // Brackets without a unit belong to the name: "a (NS)", "a (EW)".
        let unit = column_unit(&cell[..open], &cell[open + 1..close]);
        let name = if unit.is_some() {
            cell[..open].trim()
        } else {
            cell
        };
        return Heading {
            name: name.to_owned(),
            unit,
        };
    }
    for separator in [", ", " / ", " in "] {
        if let Some((name, unit)) = cell.rsplit_once(separator)
            && let Some(unit) = column_unit(name, unit)
        {
            return Heading {
                name: name.trim().to_owned(),
                unit: Some(unit),
            };
        }
    }
    let suffixes = [
        ("_cm_s2", "cm/s2"),
        ("_mm_s2", "mm/s2"),
        ("_gal", "gal"),
        ("_m_s2", "m/s2"),
        ("_m_s", "m/s"),
        ("_rad_s", "rad/s"),
        ("_m", "m"),
        ("_g", "g"),
    ];
    let suffix = suffixes.iter().find(|(suffix, _)| cell.ends_with(suffix));
    let unit = match suffix {
        // `_g` and `_m` end ordinary names too; they are units only after names of what they
        // measure.
        Some(("_g", _)) if !cell.to_ascii_lowercase().starts_with("acc") => None,
        Some(("_m", _)) if !is_other_name(cell) => None,
        Some((_, symbol)) => lookup(symbol),
        None => time_suffix(cell),
    };
    Heading {
        name: cell.to_owned(),
        unit,
    }
}

/// `time_ms`, `t_s`, `Time ms`: a word for time, then its unit.
fn time_suffix(cell: &str) -> Option<&'static Unit> {
    let (name, unit) = cell.rsplit_once(['_', ' '])?;
    let of_time = record_unit(unit).filter(|unit| unit.dimension == Dimension::Time)?;
    is_time_name(name.trim()).then_some(of_time)
}

/// The unit of a column: N means newton for a force and north for anything else.
fn column_unit(name: &str, unit: &str) -> Option<&'static Unit> {
    if is_force(name) && unit.trim() == "N" {
        lookup("N")
    } else {
        record_unit(unit)
    }
}

fn is_force(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["force", "load", "kraft"]
        .iter()
        .any(|word| name.contains(word))
        || name.trim() == "f"
}

/// Names of a time column, without its unit.
pub(crate) fn is_time_name(name: &str) -> bool {
    matches!(
        name.to_ascii_lowercase().as_str(),
        "time" | "t" | "time_s" | "t_s" | "zeit" | "temps" | "tiempo"
    )
}

/// Names of a column that counts samples, which is no time: its steps are not seconds.
pub(crate) fn is_counter_name(name: &str) -> bool {
    let name = name.to_lowercase();
    let name = name.trim_end_matches(['.', ':', '°', 'º']).trim();
    const NAMES: [&str; 25] = [
        "sample",
        "samples",
        "sample no",
        "sample number",
        "sample #",
        "index",
        "idx",
        "no",
        "n",
        "nr",
        "num",
        "number",
        "i",
        "k",
        "count",
        "counter",
        "row",
        "point",
        "pt",
        "id",
        "scan",
        "data point",
        "messpunkt",
        "echantillon",
        "muestra",
    ];
    NAMES.contains(&name)
}

fn is_other_name(name: &str) -> bool {
    let lower = name.to_ascii_lowercase();
    lower.starts_with("vel") || lower.starts_with("disp")
}

/// What a column holds, if not an acceleration.
pub(crate) fn other_quantity(heading: &Heading) -> Option<&'static str> {
    match heading.unit {
        Some(unit) if unit.dimension != Dimension::Acceleration => {
            Some(unit.dimension.with_article())
        }
        Some(_) => None,
        None => {
            let name = heading.name.to_ascii_lowercase();
            let others = [
                ("vel", "a velocity"),
                ("disp", "a displacement"),
                ("force", "a force"),
                ("load", "a force"),
            ];
            others
                .iter()
                .find(|(start, _)| name.starts_with(start))
                .map(|(_, what)| *what)
        }
    }
}

/// The headings of a table and their line: the last header line, or the one above a line of units.
/// Without a header line, a comment with units counts; a comment that merely has as many words as
/// there are columns does not.
pub(crate) fn headings_of(table: &Table) -> Option<(Vec<Heading>, usize)> {
    // The comment marks of other programs do not belong to the first heading.
    let unmarked = |text: &str| {
        text.trim_start_matches(['%', '!', '*', '/'])
            .trim()
            .to_owned()
    };
    let from = |text: &str| -> Option<Vec<Heading>> {
        let text = &unmarked(text);
        let headings: Vec<Heading> = table
            .names(text)?
            .iter()
            .map(|cell| heading(cell))
            .collect();
        // "Units: cm/s2" above two columns has two words but is not a header.
        let statement = says_unit(text) && headings.iter().all(|heading| heading.unit.is_none());
        (!statement).then_some(headings)
    };
    // A line of dashes underlines the headings.
    let lines: Vec<_> = table
        .header
        .iter()
        .rev()
        .filter(|(_, text)| text.contains(char::is_alphanumeric))
        .take(4)
        .collect();
    let units_of = |text: &str| -> Option<Vec<_>> {
        table
            .names(&unmarked(text))?
            .iter()
            .map(|cell| record_unit(cell))
            .collect()
    };
    // Plotting programs write a line of remarks below names and units.
    let units = lines
        .iter()
        .enumerate()
        .find_map(|(i, (line, text))| Some((i, *line, units_of(text)?)));
    if let Some((i, line, units)) = units {
        let above = lines
            .get(i + 1)
            .and_then(|(above, text)| Some((*above, from(text)?)));
        let (line, mut headings) =
            above.unwrap_or_else(|| (line, vec![Heading::default(); units.len()]));
        for (heading, unit) in headings.iter_mut().zip(units) {
            heading.unit = Some(unit);
        }
        return Some((headings, line));
    }
    if let Some((line, text)) = lines.first()
        && let Some(headings) = from(text)
    {
        return Some((headings, *line));
    }
    let (line, text) = table.comments.last()?;
    let headings = from(text)?;
    let all_named = headings
        .iter()
        .all(|heading| heading.unit.is_some() && !heading.name.is_empty());
    all_named.then_some((headings, *line))
}

/// As [`headings_of`], for a table that must have them.
///
/// # Errors
/// No headings.
pub(crate) fn names_of(table: &Table, hint: &str) -> Result<(Vec<Heading>, usize), Problem> {
    headings_of(table).ok_or_else(|| Problem::format("the columns have no names", hint))
}

/// The problem of a table without a column that it needs.
pub(crate) fn no_column(what: &str, hint: &str) -> Problem {
    Problem::format(format!("no column holds a {what} with its unit"), hint)
}

/// The values of a column, in SI if its heading has a unit.
pub(crate) fn in_si(table: &Table, headings: &[Heading], index: usize) -> Vec<f64> {
    let unit = headings.get(index).and_then(|heading| heading.unit);
    let values = table
        .columns
        .get(index)
        .map_or(&[][..], |column| &column.values);
    values
        .iter()
        .map(|&value| unit.map_or(value, |unit| unit.to_si(value)))
        .collect()
}

/// Whether a line of prose states a unit explicitly.
pub(crate) fn says_unit(text: &str) -> bool {
    text.to_ascii_lowercase().contains("unit") && unit_in_prose(text).is_some()
}
