//! The force, its factors and its limits as the report and the sheet say them.

use freestand::code_spectrum::part_forces::Governing;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::number;

use crate::restraint::Demand;
use crate::restraint::factor::{Factor, FactorSource};

/// The tension along one edge.
pub fn tension_words(units: UnitSystem, tension_n: f64) -> String {
    if tension_n > 0.0 {
        units.force_in_both(tension_n)
    } else {
        "none: its weight holds it down".to_owned()
    }
}

/// The symbol of a factor, its value with its unit, and who says so.
pub fn factor_words(factor: &Factor) -> [String; 3] {
    let unit = if factor.unit == "1" {
        String::new()
    } else {
        format!(" {}", factor.unit)
    };
    [
        factor.symbol.to_owned(),
        format!("{}{unit}", factor.number()),
        factor.source.words(),
    ]
}

/// `F = 0.48 W; from 0.3 W to 1.6 W; the formula governs`.
pub fn limits_words(demand: &Demand) -> Option<String> {
    let force = &demand.source.force;
    let share = |ratio: f64| format!("{} W", number(ratio, 4));
    let range = match (force.minimum_ratio > 0.0, force.maximum_ratio.is_finite()) {
        (true, true) => format!(
            "from {} to {}",
            share(force.minimum_ratio),
            share(force.maximum_ratio)
        ),
        (true, false) => format!("at least {}", share(force.minimum_ratio)),
        (false, true) => format!("at most {}", share(force.maximum_ratio)),
        (false, false) => return None,
    };
    let governs = match force.governing {
        Governing::Minimum => "the lower limit governs",
        Governing::Formula => "the formula governs",
        Governing::Maximum => "the upper limit governs",
    };
    Some(format!("{range}; {governs}"))
}

/// `ASCE 7-16, 13.3.1`, or `F = m a`.
pub fn clause_words(demand: &Demand) -> String {
    let source = &demand.source;
    source.code.map_or_else(
        || source.clause.to_owned(),
        |code| format!("{code}, {}", source.clause),
    )
}

/// What an engineer must confirm of a force.
pub fn to_confirm(demand: &Demand) -> Vec<ToConfirm> {
    let factor = |factor: &Factor| match factor.source {
        FactorSource::Recalled("") => Some(ToConfirm {
            what: factor.symbol.to_owned(),
            value: factor.number(),
        }),
        FactorSource::Recalled(reason) => Some(ToConfirm {
            what: format!("{}: {reason}", factor.symbol),
            value: factor.number(),
        }),
        FactorSource::Given
        | FactorSource::Assumed(_)
        | FactorSource::Found(_)
        | FactorSource::Read(_) => None,
    };
    let clause = |what: &&str| ToConfirm {
        what: (*what).to_owned(),
        value: String::new(),
    };
    let source = &demand.source;
    source
        .factors
        .iter()
        .filter_map(factor)
        .chain(source.to_confirm.iter().map(clause))
        .collect()
}

/// What nobody has read in the code, and an engineer must confirm before the sheet is signed.
#[derive(Debug, Clone, PartialEq)]
pub struct ToConfirm {
    /// What it is: a factor with what it stands for, or a clause.
    pub what: String,
    /// The value that was used; empty for a clause.
    pub value: String,
}
