//! What `freestand restrain` answers for one object: its document, and the answer in one sentence.

use freestand_assess::restrain::{Anchor, Case, Pivot};
use freestand_assess::restraint::factor::Factor;
use freestand_assess::restraint::force::RestraintForce;
use freestand_assess::restraint::source::Source;
use freestand_input::words::number;
use freestand_output::answer::ByName;
use freestand_output::answer_of;
use freestand_study::places::Place;
use freestand_study::target::Target;

use super::force::{ToConfirm, equation, factor_source, names, numbers, symbol, to_confirm};
use super::words::{
    assumptions, capacity_words, clause_words, doubt_words, floor_words, limits_words, provenance,
    tension_words, utilisation_words,
};

/// The force, moments and anchors of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainReport {
    /// Where the sheet was written; whoever writes it says so.
    pub sheet_path: Option<String>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// What it follows from.
    pub case: Case,
}

/// What there is to tell of a force.
pub fn restrain_report(case: Case) -> RestrainReport {
    RestrainReport {
        sheet_path: None,
        warnings: case.doubts.iter().map(doubt_words).collect(),
        case,
    }
}

/// `Design its restraint for 659 N (48 % of its weight), 1.15 m above its floor (ASCE 7-16,
/// 13.3.1); along each edge the anchors carry 783 N of tension.`
pub(super) fn answer(case: &Case) -> String {
    let force = &case.own;
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
        number(100.0 * force.force_ratio(), 3),
        units.length(case.question.object.cg_height_m),
        clause_words(&case.own.source),
    )
}

/// The words about each anchor.
fn anchor_words(case: &Case) -> String {
    let (force, units) = (&case.own, case.request.units);
    let each = case.each_anchor();
    let pull = if force.anchor_tension_n > 0.0 || force.anchor_tension_concrete_n > 0.0 {
        format!(
            "{} of tension, in concrete {}; ",
            units.force(each.tension_n),
            units.force(each.tension_concrete_n)
        )
    } else {
        String::new()
    };
    let shear = units.force(each.shear_n);
    let anchors = case.request.anchors.per_edge;
    format!("{pull}{shear} of shear ({anchors} along each of two edges)")
}

fn bracket_words(case: &Case) -> String {
    let (force, units) = (&case.own, case.request.units);
    format!(
        "{} at {}, with {} at the feet",
        units.force(force.bracket_force_n),
        units.length(force.bracket_height_m),
        units.force(force.bracket_base_shear_n)
    )
}

fn force_words(case: &Case) -> String {
    let force = &case.own;
    let share = number(force.force_ratio(), 4);
    let both = case.request.units.force_in_both(force.force_n);
    format!("{both}, {share} of its weight")
}

/// The formula with its numbers.
fn formula_words(case: &Case) -> String {
    let source = &case.own.source;
    let ratio = number(source.part.formula_ratio, 4);
    format!("{} = {ratio} W", numbers(source))
}

fn chosen(case: &Case) -> Option<&Anchor> {
    case.request.anchors.chosen.as_ref()
}

fn pivot(case: &Case) -> &'static str {
    match case.question.pivot {
        Pivot::Edge => "edge",
        Pivot::Feet => "feet",
    }
}

fn axis(case: &Case) -> Option<&'static str> {
    case.own.axis.as_ref().map(|axis| axis.axis.name())
}

answer_of!(RestrainReport as report {
    code: Option<&'static str> = names(report.case.own.source.clause).code;
    clause: &'static str = names(report.case.own.source.clause).clause;
    __: String = clause_words(&report.case.own.source) => "clause";
    __: Option<String> = report.case.target.as_ref().map(Target::parts_words) => "hazard";
    __: Option<String> = provenance(report.case.target.as_ref()) => "from";
    __: Option<String> = Some(floor_words(&report.case.floor)).filter(|floor| !floor.is_empty()) => "floor";
    __: String = equation(&report.case.own.source) => "formula";
    __: String = format!("= {}", formula_words(&report.case)) => " ";
    __: Option<String> = limits_words(&report.case.own.source) => "limits";
    force_n: f64 = report.case.own.force_n;
    /// Of its weight.
    force_ratio: f64 = report.case.own.force_ratio();
    __: String = force_words(&report.case) => "force";
    acts_at_height_m: f64 = report.case.question.object.cg_height_m;
    __: String = report.case.request.units.length(report.case.question.object.cg_height_m) => "acts at a height of";
    overturning_moment_n_m: f64 = report.case.own.overturning_moment_n_m();
    __: String = report.case.request.units.moment(report.case.own.overturning_moment_n_m()) => "overturning moment";
    resisting_moment_n_m: f64 = report.case.own.resisting_moment_n_m();
    __: String = report.case.request.units.moment(report.case.own.resisting_moment_n_m()) => "resisting moment";
    /// The axis across which it tips.
    axis: Option<&'static str> = axis(&report.case);
    __: Option<String> = axis(&report.case).map(|axis| format!("the {axis}")) => "tips across";
    anchor_inset_m: f64 = report.case.own.inset_m();
    /// Along one edge.
    anchor_tension_n: f64 = report.case.own.anchor_tension_n;
    __: String = tension_words(report.case.request.units, report.case.own.anchor_tension_n) => "anchors along one edge";
    anchor_tension_concrete_n: f64 = report.case.own.anchor_tension_concrete_n;
    __: String = tension_words(report.case.request.units, report.case.own.anchor_tension_concrete_n) => "the same in concrete";
    per_anchor: OfAnchor<'_> = OfAnchor(&report.case);
    __: String = anchor_words(&report.case) => "each anchor";
    anchors_per_edge: usize = report.case.request.anchors.per_edge;
    /// The line about which it tips: `edge`, `feet`.
    pivot: &'static str = pivot(&report.case);
    /// Lever of the weight about that line.
    weight_lever_m: f64 = report.case.own.weight_lever_m();
    /// Lever of the anchors along one edge about that line.
    anchor_lever_m: f64 = report.case.own.anchor_lever_m();
    /// The name of the anchor that was chosen.
    anchor: Option<String> = chosen(&report.case).and_then(|anchor| anchor.name.clone());
    /// Its design capacity in tension.
    anchor_capacity_n: Option<f64> = chosen(&report.case).map(|anchor| anchor.tension_n);
    /// Its design capacity in shear.
    anchor_shear_capacity_n: Option<f64> = chosen(&report.case).and_then(|anchor| anchor.shear_n);
    __: Option<String> = chosen(&report.case).map(|anchor| capacity_words(anchor, report.case.request.units)) => "design capacity of one";
    /// Of one anchor in concrete: tension over capacity, and that of the shear added.
    demand_capacity_ratio: Option<f64> = report.case.demand_capacity_ratio();
    __: Option<String> = utilisation_words(&report.case) => "demand over capacity";
    bracket_height_m: f64 = report.case.own.bracket_height_m;
    bracket_force_n: f64 = report.case.own.bracket_force_n;
    /// At the feet, beside the bracket.
    bracket_base_shear_n: f64 = report.case.own.bracket_base_shear_n;
    __: String = bracket_words(&report.case) => "or a bracket";
    held_weight_ratio: f64 = report.case.own.held_weight_ratio;
    overstrength_ratio: f64 = report.case.own.source.overstrength_ratio();
    /// The formula with its numbers.
    formula: String = formula_words(&report.case);
    level_ratio: f64 = report.case.question.object.level_ratio;
    place: Option<&Place> = report.case.target.as_ref().and_then(|target| target.place.as_ref());
    factors: ByName<OfFactor<'_>> = factors(&report.case.own.source);
    /// What was not stated.
    assumptions: Vec<String> = assumptions(&report.case);
    /// The row of the table of components of the code.
    component: Option<&'static str> = report.case.question.object.component.map(|row| row.name);
    /// What an engineer must confirm.
    to_confirm: Vec<ToConfirm> = to_confirm(&report.case.own.source);
    /// The same by other codes.
    others: Vec<ByCode<'_>> = report.case.others.iter().map(ByCode).collect();
    /// Where the sheet was written.
    sheet: Option<String> = report.sheet_path.clone();
});

/// What each anchor carries.
#[derive(Clone, Copy)]
struct OfAnchor<'r>(&'r Case);

answer_of!(OfAnchor<'_> as one {
    tension_n: f64 = one.0.each_anchor().tension_n;
    tension_concrete_n: f64 = one.0.each_anchor().tension_concrete_n;
    shear_n: f64 = one.0.each_anchor().shear_n;
    shear_concrete_n: f64 = one.0.each_anchor().shear_concrete_n;
});

/// The same by another code.
#[derive(Clone, Copy)]
struct ByCode<'r>(&'r RestraintForce);

answer_of!(ByCode<'_> as by {
    code: Option<&'static str> = names(by.0.source.clause).code;
    clause: &'static str = names(by.0.source.clause).clause;
    force_n: f64 = by.0.force_n;
    force_ratio: f64 = by.0.force_ratio();
    overturning_moment_n_m: f64 = by.0.overturning_moment_n_m();
    resisting_moment_n_m: f64 = by.0.resisting_moment_n_m();
    anchor_tension_n: f64 = by.0.anchor_tension_n;
    anchor_tension_concrete_n: f64 = by.0.anchor_tension_concrete_n;
    bracket_force_n: f64 = by.0.bracket_force_n;
    factors: ByName<OfFactor<'_>> = factors(&by.0.source);
});

/// A factor of a formula.
#[derive(Clone, Copy)]
struct OfFactor<'r>(&'r Source, &'r Factor);

answer_of!(OfFactor<'_> as of {
    symbol: &'static str = symbol(of.0.clause, of.1.key);
    value: f64 = of.1.value;
    unit: &'static str = if of.1.key.is_acceleration() { "g" } else { "1" };
    /// Who says so.
    source: String = factor_source(of.0, of.1);
});

/// Factors by their keys.
fn factors(source: &Source) -> ByName<OfFactor<'_>> {
    let all = source.factors.iter();
    ByName(
        all.map(|factor| (factor.key.name(), OfFactor(source, factor)))
            .collect(),
    )
}

answer_of!(ToConfirm as one {
    what: String = one.what.clone();
    /// The value that was used; of a clause none.
    value: Option<String> = Some(one.value.clone()).filter(|value| !value.is_empty());
});
