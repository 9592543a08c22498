//! What a header cell says about its column.

use super::units::record_unit;
use crate::quantity::{Dimension, Unit, lookup};

/// Name and unit of a column.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Heading {
    pub(super) name: String,
    pub(super) unit: Option<&'static Unit>,
}

/// `time [ms]`, `Accel[g]`, `accel (m/s2)`, `Time, s`, `a / g`, and the unit suffixes of our own files, `time_s` and `accel_m_s2`.
pub(super) fn heading(cell: &str) -> Heading {
    let cell = cell.trim().trim_matches('"').trim();
    if let (Some(open), Some(close)) = (cell.rfind(['[', '(']), cell.rfind([']', ')']))
        && open < close
    {
        // Brackets that hold no unit belong to the name: "a (NS)", "a (EW)".
        let unit = record_unit(&cell[open + 1..close]);
        let name = if unit.is_some() { cell[..open].trim() } else { cell };
        return Heading { name: name.to_owned(), unit };
    }
    for separator in [", ", " / "] {
        if let Some((name, unit)) = cell.rsplit_once(separator)
            && let Some(unit) = record_unit(unit)
        {
            return Heading { name: name.trim().to_owned(), unit: Some(unit) };
        }
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

pub(super) fn is_time_name(name: &str) -> bool {
    matches!(name.to_ascii_lowercase().as_str(), "time" | "t" | "time_s" | "t_s" | "zeit" | "temps" | "tiempo")
}

fn is_other_name(name: &str) -> bool {
    let lower = name.to_ascii_lowercase();
    lower.starts_with("vel") || lower.starts_with("disp")
}

/// What a column is, if it is no acceleration.
pub(super) fn other_quantity(heading: &Heading) -> Option<&'static str> {
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
