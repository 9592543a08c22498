//! What `freestand restrain` prints, and its document.

use freestand::code_spectrum::part_forces::Governing;
use freestand_input::quantity::lookup;
use freestand_input::words::number;
use freestand_output::facts::Facts;
use freestand_study::places::Place;

use super::{Case, sheet};
use crate::restraint::Demand;
use crate::restraint::factor::Factor;

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
        others: case.others.iter().map(other_words).collect(),
        assumptions: case.assumptions.clone(),
        sheet: sheet::sheet(case),
        warnings: case.warnings.clone(),
    }
}

/// A length as engineers read it, to a tenth of a millimetre or a millimetre: `914.4 mm`, `1.646 m`.
pub(super) fn length_words(length_m: f64) -> String {
    if length_m < 1.0 { format!("{} mm", number(1e3 * length_m, 4)) } else { format!("{} m", number(length_m, 4)) }
}

/// A force as engineers read it: `659 N`, `1.29 kN`.
pub(super) fn force_words(force_n: f64) -> String {
    if force_n.abs() < 1000.0 {
        format!("{} N", number(force_n, 3))
    } else {
        format!("{} kN", number(1e-3 * force_n, 3))
    }
}

/// The same in pounds-force beside it: `659 N (148 lbf)`.
pub(super) fn force_in_both(force_n: f64) -> String {
    match lookup("lbf") {
        Some(unit) if force_n != 0.0 => format!("{} ({} lbf)", force_words(force_n), number(unit.from_si(force_n), 3)),
        _ => force_words(force_n),
    }
}

pub(super) fn tension_words(tension_n: f64) -> String {
    if tension_n > 0.0 { force_in_both(tension_n) } else { "none: its weight holds it down".to_owned() }
}

pub(super) fn factor_words(factor: &Factor) -> [String; 3] {
    let unit = if factor.unit == "1" { String::new() } else { format!(" {}", factor.unit) };
    [factor.symbol.to_owned(), format!("{}{unit}", factor.number()), factor.source.words()]
}

/// `F = 0.48 W; from 0.3 W to 1.6 W; the formula governs`.
pub(super) fn limits_words(demand: &Demand) -> Option<String> {
    let force = &demand.source.force;
    let share = |ratio: f64| format!("{} W", number(ratio, 4));
    let range = match (force.minimum_ratio > 0.0, force.maximum_ratio.is_finite()) {
        (true, true) => format!("from {} to {}", share(force.minimum_ratio), share(force.maximum_ratio)),
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
    source.code.map_or_else(|| source.clause.to_owned(), |code| format!("{code}, {}", source.clause))
}

/// `Design its restraint for 659 N (48 % of its weight), 1.15 m above its floor (ASCE 7-16,
/// 13.3.1); along each edge the anchors carry 783 N of tension.`
fn answer(case: &Case) -> String {
    let force = &case.own.force;
    let anchors = match (force.anchor_tension_n > 0.0, force.anchor_tension_concrete_n > 0.0) {
        (true, _) => format!("the anchors along one edge carry {} of tension", force_words(force.anchor_tension_n)),
        (false, true) => "its weight holds it down, but anchors in concrete need tension".to_owned(),
        (false, false) => "its weight holds it down, so that its anchors carry shear alone".to_owned(),
    };
    format!(
        "Design its restraint for {} ({} % of its weight), {} above its floor, by {}: {anchors}.",
        force_words(force.force_n),
        number(100.0 * force.force_ratio, 3),
        length_words(case.question.object.cg_height_m),
        clause_words(&case.own),
    )
}

fn other_words(demand: &Demand) -> [String; 5] {
    let force = &demand.force;
    [
        clause_words(demand),
        force_words(force.force_n),
        number(force.force_ratio, 3),
        force_words(force.anchor_tension_n),
        force_words(force.anchor_tension_concrete_n),
    ]
}

fn facts(case: &Case) -> Facts<'static> {
    let (own, object) = (&case.own, &case.question.object);
    let force = &own.force;
    let moment = |moment_n_m: f64| Some(format!("{} N·m", number(moment_n_m, 4)));
    let formula = format!("{} = {} W", own.source.numbers, number(own.source.force.formula_ratio, 4));
    let hazard = case.target.as_ref().map(|target| target.parts_words());
    let axis = own.axis.as_ref().map(|axis| axis.axis.name());
    let per_anchor = Facts::default()
        .key("tension_n", case.anchor_n(force.anchor_tension_n))
        .key("tension_concrete_n", case.anchor_n(force.anchor_tension_concrete_n))
        .key("shear_n", case.anchor_shear_n());
    let [tension, in_concrete] = [force.anchor_tension_n, force.anchor_tension_concrete_n].map(tension_words);
    let shear = force_words(case.anchor_shear_n());
    let anchors = case.request.anchors_per_edge;
    let of_each = [force.anchor_tension_n, force.anchor_tension_concrete_n].map(|edge_n| case.anchor_n(edge_n));
    let pull = match of_each {
        [tension_n, concrete_n] if tension_n > 0.0 || concrete_n > 0.0 => {
            format!("{} of tension, in concrete {}; ", force_words(tension_n), force_words(concrete_n))
        }
        _ => String::new(),
    };
    let each = format!("{pull}{shear} of shear ({anchors} along each of two edges)");
    let bracket_height = length_words(force.bracket_height_m);
    let bracket = format!(
        "{} at {bracket_height}, with {} at the feet",
        force_words(force.bracket_force_n),
        force_words(force.bracket_base_shear_n)
    );
    Facts::default()
        .key("code", own.source.code)
        .key("clause", own.source.clause)
        .line("clause", Some(clause_words(own)))
        .line("hazard", hazard)
        .line("floor", Some(case.floor.clone()).filter(|floor| !floor.is_empty()))
        .line("formula", Some(own.source.equation.clone()))
        .line(" ", Some(format!("= {formula}")))
        .line("limits", limits_words(own))
        .key("force_n", force.force_n)
        .key("force_ratio", force.force_ratio)
        .line(
            "force",
            Some(format!("{}, {} of its weight", force_in_both(force.force_n), number(force.force_ratio, 4))),
        )
        .key("acts_at_height_m", object.cg_height_m)
        .line("acts at a height of", Some(length_words(object.cg_height_m)))
        .key("overturning_moment_n_m", own.overturning_moment_n_m)
        .line("overturning moment", moment(own.overturning_moment_n_m))
        .key("resisting_moment_n_m", own.resisting_moment_n_m)
        .line("resisting moment", moment(own.resisting_moment_n_m))
        .key("axis", axis)
        .line("tips across", axis.map(|axis| format!("the {axis}")))
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
        .key("place", case.target.as_ref().and_then(|target| target.place).map(Place::facts))
        .key("factors", factor_facts(&own.source.factors))
        .key("assumptions", case.assumptions.clone())
        .key("others", case.others.iter().map(other_facts).collect::<Vec<_>>())
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
