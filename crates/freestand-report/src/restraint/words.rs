//! The force, its factors and its limits as the report and the sheet say them.

use freestand::code_spectrum::part_forces::Governing;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{counted, listed, number};

use freestand_assess::restrain::{
    Anchor, Case, NotHeld, Pivot, RestraintAssumption, RestraintDoubt, StandsOn,
};
use freestand_assess::restraint::factor::Factor;
use freestand_assess::restraint::source::Source;
use freestand_study::building::DEFAULT_STOREY_HEIGHT_M;
use freestand_study::target::Target;

use super::force::{factor_source, names, symbol};
use crate::doubts::{target_doubt, unlikely_size};

/// Where an object stands: its floor, its height over that of the building; empty where the given
/// acceleration is that of its floor.
pub(super) fn floor_words(floor: &StandsOn) -> String {
    let level = |ratio: f64| format!("z/h = {}", number(ratio, 3));
    match floor {
        StandsOn::Floor {
            name,
            storeys,
            level_ratio,
        } => {
            let of = storeys.map_or_else(String::new, |storeys| {
                format!(" ({})", counted(storeys, "storey"))
            });
            format!("{name}{of}, {}", level(*level_ratio))
        }
        StandsOn::Level(ratio) => level(*ratio),
        StandsOn::Ground => "the ground".to_owned(),
        StandsOn::Accelerated => String::new(),
    }
}

/// What was assumed about one object, a sentence each.
pub(super) fn assumptions(case: &Case) -> Vec<String> {
    let cg_height_m = case.question.object.cg_height_m;
    let words = |one| assumption(one, case.request.units, cg_height_m);
    case.assumptions.iter().map(words).collect()
}

/// What was assumed, as a sentence.
pub(super) fn assumption(
    assumed: &RestraintAssumption,
    units: UnitSystem,
    cg_height_m: f64,
) -> String {
    match assumed {
        RestraintAssumption::Ground => {
            "No floor was given: the object is on the ground.".to_owned()
        }
        RestraintAssumption::StoreyHeight => {
            format!(
                "A storey is {} high.",
                units.storey(DEFAULT_STOREY_HEIGHT_M)
            )
        }
        RestraintAssumption::Site(site) => format!("The site was not given: class {site}."),
        RestraintAssumption::ReturnPeriod(years) => {
            format!("The return period was not given: {years} years.")
        }
        RestraintAssumption::CgHeight => format!(
            "The centre of gravity is at half of the height, {}.",
            units.length(cg_height_m)
        ),
        RestraintAssumption::NoWidth => {
            "No width was given: only tipping across the thickness is checked.".to_owned()
        }
        RestraintAssumption::Insets(inset_m) => format!(
            "The anchors of each object stand {} inside the edge that they hold down, or a quarter of the side where that is \
             less: measure them, and give `anchor_inset`.",
            units.length(*inset_m)
        ),
        RestraintAssumption::Inset(inset_m) => format!(
            "The anchors stand {} inside the edge that they hold down: measure it, and give `anchor_inset`.",
            units.length(*inset_m)
        ),
    }
}

/// What is said where the force of a code lifts nothing.
pub(super) const NO_TENSION: &str = "No tension does not mean that the object stands without anchors: the force of a \
                          code may be reduced for ductility, and an earthquake may lift the object all the same. \
                          freestand assess simulates that";

/// What there is to know beside a force.
pub(super) fn doubt_words(doubt: &RestraintDoubt) -> String {
    match doubt {
        RestraintDoubt::Hazard(doubt) => target_doubt(doubt),
        RestraintDoubt::Size(size) => unlikely_size(size),
        RestraintDoubt::NoEffect(key) => format!(
            "`{key}` has no effect: the clauses for parts use no long periods of the spectrum"
        ),
        RestraintDoubt::ComponentUnused(by) => {
            format!("`component` is not used by {by}: its factors are the same for every object")
        }
        RestraintDoubt::NoTension => NO_TENSION.to_owned(),
    }
}

/// Why an object of a list has no force.
pub(super) fn not_held(why: &NotHeld) -> String {
    match why {
        NotHeld::Anchored => "it is anchored already".to_owned(),
        NotHeld::Unconfirmed(columns) => {
            format!("its size or mass must be confirmed: {}", columns.join(", "))
        }
        NotHeld::Stacked => "another body stands on it, which is not counted".to_owned(),
        NotHeld::Unknown(missing) => {
            let names: Vec<&str> = missing.iter().map(|one| one.name()).collect();
            let verb = if names.len() == 1 { "is" } else { "are" };
            format!("its {} {verb} not known", listed(&names))
        }
        NotHeld::Refused(problems) => {
            let messages: Vec<&str> = problems
                .problems
                .iter()
                .map(|problem| problem.message.as_str())
                .collect();
            messages.join("; ")
        }
    }
}

/// The formula of the tension in symbols.
pub(super) fn tension_formula(pivot: Pivot) -> &'static str {
    match pivot {
        Pivot::Edge => "T = (F c − H e)/(B − a)",
        Pivot::Feet => "T = (F c − H (e − a))/(B − 2a)",
    }
}

/// What a ratio of demand to capacity means, and what it does not.
pub(super) const DESIGN_CAPACITY: &str = "The capacity that was entered is taken as the design capacity of one anchor. It is not \
                               the median strength, which is far higher: do not use one in place of the other.";

/// `M10 bolt: 6.2 kN in tension, 5 kN in shear`.
pub(super) fn capacity_words(anchor: &Anchor, units: UnitSystem) -> String {
    let name = anchor
        .name
        .as_ref()
        .map_or_else(String::new, |name| format!("{name}: "));
    let shear = anchor.shear_n.map_or_else(String::new, |shear_n| {
        format!(", {} in shear", units.force(shear_n))
    });
    format!("{name}{} in tension{shear}", units.force(anchor.tension_n))
}

/// `0.62 (tension and shear in concrete): enough by this sum`; where no shear capacity is known, of the tension alone.
pub(super) fn utilisation_words(case: &Case) -> Option<String> {
    let anchor = case.request.anchors.chosen.as_ref()?;
    let ratio = case.demand_capacity_ratio()?;
    let verdict = if ratio > 1.0 {
        "not enough"
    } else {
        "enough by this sum"
    };
    let of = if anchor.shear_n.is_some() {
        "tension and shear in concrete"
    } else {
        "tension in concrete alone; the shear was not compared"
    };
    Some(format!("{} ({of}): {verdict}", number(ratio, 3)))
}

/// Where the hazard of a place was read, how far away and how far it can be trusted.
pub(super) fn provenance(target: Option<&Target>) -> Option<String> {
    Some(target?.place.as_ref()?.provenance())
}

/// The tension along one edge.
pub(super) fn tension_words(units: UnitSystem, tension_n: f64) -> String {
    if tension_n > 0.0 {
        units.force_in_both(tension_n)
    } else {
        "none: its weight holds it down".to_owned()
    }
}

/// The symbol of a factor, its value with its unit, and who says so.
pub(super) fn factor_words(source: &Source, factor: &Factor) -> [String; 3] {
    let unit = if factor.key.is_acceleration() {
        " g"
    } else {
        ""
    };
    [
        symbol(source.clause, factor.key).to_owned(),
        format!("{}{unit}", number(factor.value, 4)),
        factor_source(source, factor),
    ]
}

/// `F = 0.48 W; from 0.3 W to 1.6 W; the formula governs`.
pub(super) fn limits_words(source: &Source) -> Option<String> {
    let force = &source.part;
    let share = |ratio: f64| format!("{} W", number(ratio, 4));
    let range = match (force.minimum_ratio > 0.0, force.maximum_ratio) {
        (true, Some(most)) => format!("from {} to {}", share(force.minimum_ratio), share(most)),
        (true, None) => format!("at least {}", share(force.minimum_ratio)),
        (false, Some(most)) => format!("at most {}", share(most)),
        (false, None) => return None,
    };
    let governs = match force.governing {
        Governing::Minimum => "the lower limit governs",
        Governing::Formula => "the formula governs",
        Governing::Maximum => "the upper limit governs",
    };
    Some(format!("{range}; {governs}"))
}

/// `ASCE 7-16, 13.3.1`, or `F = m a`.
pub(super) fn clause_words(source: &Source) -> String {
    let names = names(source.clause);
    names.code.map_or_else(
        || names.clause.to_owned(),
        |code| format!("{code}, {}", names.clause),
    )
}
