//! What `freestand restrain` prints, and its document.

use freestand::code_spectrum::part_forces::Governing;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::number;
use freestand_output::facts::Facts;

use super::{Case, sheet};
use crate::restraint::Demand;
use crate::restraint::factor::{Factor, FactorSource};

/// The force, moments and anchors of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainReport {
    /// The result; the path of the sheet is added by who writes it.
    pub facts: Facts<'static>,
    /// The answer in one sentence.
    pub answer: String,
    /// The factors: symbol, value with its unit, who says so.
    pub factors: Vec<[String; 3]>,
    /// Other codes: clause, force, force over weight, tension of an edge, the same in concrete.
    pub others: Vec<[String; 5]>,
    /// What was not stated, a sentence each.
    pub assumptions: Vec<String>,
    /// What an engineer must confirm.
    pub to_confirm: Vec<ToConfirm>,
    /// `restraint.html`.
    pub sheet: String,
    /// Warnings.
    pub warnings: Vec<String>,
}

pub(super) fn report(case: &Case) -> RestrainReport {
    RestrainReport {
        facts: facts(case),
        answer: answer(case),
        factors: case.own.source.factors.iter().map(factor_words).collect(),
        others: case
            .others
            .iter()
            .map(|demand| other_words(case.request.units, demand))
            .collect(),
        assumptions: case.assumptions.clone(),
        to_confirm: to_confirm(&case.own),
        sheet: sheet::sheet(case),
        warnings: case.warnings.clone(),
    }
}

pub(super) fn tension_words(units: UnitSystem, tension_n: f64) -> String {
    if tension_n > 0.0 {
        units.force_in_both(tension_n)
    } else {
        "none: its weight holds it down".to_owned()
    }
}

pub(super) fn factor_words(factor: &Factor) -> [String; 3] {
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
pub(super) fn limits_words(demand: &Demand) -> Option<String> {
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
pub(super) fn clause_words(demand: &Demand) -> String {
    let source = &demand.source;
    source.code.map_or_else(
        || source.clause.to_owned(),
        |code| format!("{code}, {}", source.clause),
    )
}

/// `Design its restraint for 659 N (48 % of its weight), 1.15 m above its floor (ASCE 7-16,
/// 13.3.1); along each edge the anchors carry 783 N of tension.`
fn answer(case: &Case) -> String {
    let force = &case.own.force;
    let units = case.request.units;
    let anchors = match (
        force.anchor_tension_n > 0.0,
        force.anchor_tension_concrete_n > 0.0,
    ) {
        (true, _) => format!(
            "the anchors along one edge carry {} of tension",
            units.force(force.anchor_tension_n)
        ),
        (false, true) => {
            "its weight holds it down, but anchors in concrete need tension".to_owned()
        }
        (false, false) => {
            "its weight holds it down, so that its anchors carry shear alone".to_owned()
        }
    };
    format!(
        "Design its restraint for {} ({} % of its weight), {} above its floor, by {}: {anchors}.",
        units.force(force.force_n),
        number(100.0 * force.force_ratio, 3),
        units.length(case.question.object.cg_height_m),
        clause_words(&case.own),
    )
}

fn other_words(units: UnitSystem, demand: &Demand) -> [String; 5] {
    let force = &demand.force;
    [
        clause_words(demand),
        units.force(force.force_n),
        number(force.force_ratio, 3),
        units.force(force.anchor_tension_n),
        units.force(force.anchor_tension_concrete_n),
    ]
}

fn facts(case: &Case) -> Facts<'static> {
    let (own, object) = (&case.own, &case.question.object);
    let force = &own.force;
    let units = case.request.units;
    let moment = |moment_n_m: f64| Some(units.moment(moment_n_m));
    let formula = format!(
        "{} = {} W",
        own.source.numbers,
        number(own.source.force.formula_ratio, 4)
    );
    let hazard = case.target.as_ref().map(|target| target.parts_words());
    let axis = own.axis.as_ref().map(|axis| axis.axis.name());
    let per_anchor = Facts::default()
        .key("tension_n", case.anchor_n(force.anchor_tension_n))
        .key(
            "tension_concrete_n",
            case.anchor_n(force.anchor_tension_concrete_n),
        )
        .key("shear_n", case.anchor_shear_n());
    let [tension, in_concrete] = [force.anchor_tension_n, force.anchor_tension_concrete_n]
        .map(|tension_n| tension_words(units, tension_n));
    let shear = units.force(case.anchor_shear_n());
    let anchors = case.request.anchors_per_edge;
    let of_each = [force.anchor_tension_n, force.anchor_tension_concrete_n]
        .map(|edge_n| case.anchor_n(edge_n));
    let pull = match of_each {
        [tension_n, concrete_n] if tension_n > 0.0 || concrete_n > 0.0 => {
            format!(
                "{} of tension, in concrete {}; ",
                units.force(tension_n),
                units.force(concrete_n)
            )
        }
        _ => String::new(),
    };
    let each = format!("{pull}{shear} of shear ({anchors} along each of two edges)");
    let bracket_height = units.length(force.bracket_height_m);
    let bracket = format!(
        "{} at {bracket_height}, with {} at the feet",
        units.force(force.bracket_force_n),
        units.force(force.bracket_base_shear_n)
    );
    Facts::default()
        .key("code", own.source.code)
        .key("clause", own.source.clause)
        .line("clause", Some(clause_words(own)))
        .line("hazard", hazard)
        .line(
            "floor",
            Some(case.floor.clone()).filter(|floor| !floor.is_empty()),
        )
        .line("formula", Some(own.source.equation.clone()))
        .line(" ", Some(format!("= {formula}")))
        .line("limits", limits_words(own))
        .key("force_n", force.force_n)
        .key("force_ratio", force.force_ratio)
        .line(
            "force",
            Some(format!(
                "{}, {} of its weight",
                units.force_in_both(force.force_n),
                number(force.force_ratio, 4)
            )),
        )
        .key("acts_at_height_m", object.cg_height_m)
        .line(
            "acts at a height of",
            Some(units.length(object.cg_height_m)),
        )
        .key("overturning_moment_n_m", own.overturning_moment_n_m)
        .line("overturning moment", moment(own.overturning_moment_n_m))
        .key("resisting_moment_n_m", own.resisting_moment_n_m)
        .line("resisting moment", moment(own.resisting_moment_n_m))
        .key("axis", axis)
        .line("tips across", axis.map(|axis| format!("the {axis}")))
        .key("anchor_inset_m", own.inset_m)
        .key("anchor_tension_n", force.anchor_tension_n)
        .line("anchors along one edge", Some(tension))
        .key("anchor_tension_concrete_n", force.anchor_tension_concrete_n)
        .line("the same in concrete", Some(in_concrete))
        .key("per_anchor", per_anchor)
        .line("each anchor", Some(each))
        .key("anchors_per_edge", anchors)
        .key("bracket_height_m", force.bracket_height_m)
        .key("bracket_force_n", force.bracket_force_n)
        .key("bracket_base_shear_n", force.bracket_base_shear_n)
        .line("or a bracket", Some(bracket))
        .key("held_weight_ratio", force.held_weight_ratio)
        .key("overstrength_ratio", force.overstrength_ratio)
        .key("formula", formula)
        .key("level_ratio", object.level_ratio)
        .key(
            "place",
            case.target.as_ref().and_then(|target| target.place),
        )
        .key("factors", factor_facts(&own.source.factors))
        .key("assumptions", case.assumptions.clone())
        .key(
            "component",
            case.question.object.component.map(|row| row.name),
        )
        .key(
            "to_confirm",
            to_confirm(own)
                .into_iter()
                .map(ToConfirm::facts)
                .collect::<Vec<_>>(),
        )
        .key(
            "others",
            case.others.iter().map(other_facts).collect::<Vec<_>>(),
        )
}

/// What nobody has read in the code, and an engineer must confirm before the sheet is signed.
#[derive(Debug, Clone, PartialEq)]
pub struct ToConfirm {
    /// What it is: a factor with what it stands for, or a clause.
    pub what: String,
    /// The value that was used; empty for a clause.
    pub value: String,
}

impl ToConfirm {
    pub(super) fn facts(self) -> Facts<'static> {
        Facts::default()
            .key("what", self.what)
            .key("value", Some(self.value).filter(|value| !value.is_empty()))
    }
}

pub(super) fn to_confirm(demand: &Demand) -> Vec<ToConfirm> {
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

fn factor_facts(factors: &[Factor]) -> Facts<'static> {
    factors.iter().fold(Facts::default(), |facts, factor| {
        let one = Facts::default()
            .key("symbol", factor.symbol)
            .key("value", factor.value)
            .key("unit", factor.unit)
            .key("source", factor.source.words());
        facts.key(factor.key, one)
    })
}

fn other_facts(demand: &Demand) -> Facts<'static> {
    let force = &demand.force;
    Facts::default()
        .key("code", demand.source.code)
        .key("clause", demand.source.clause)
        .key("force_n", force.force_n)
        .key("force_ratio", force.force_ratio)
        .key("overturning_moment_n_m", demand.overturning_moment_n_m)
        .key("resisting_moment_n_m", demand.resisting_moment_n_m)
        .key("anchor_tension_n", force.anchor_tension_n)
        .key("anchor_tension_concrete_n", force.anchor_tension_concrete_n)
        .key("bracket_force_n", force.bracket_force_n)
        .key("factors", factor_facts(&demand.source.factors))
}
