//! What would change the verdict: one value at a time, moved to either end of its range.

use crate::result::{Parameter, Ranked, Swing};
use freestand_input::words::number;
use freestand_study::statistics::ranked_quantile;

use super::Context;
use super::assessment::{Found, larger_g};
use super::capacity::Factors;
use super::group::Variant;
use super::response::{AxisMotion, MotionResponse, demand_capacity, lifts, overturned};
use super::second_opinion::softened;

/// What changes in a shock.
#[derive(Debug, Clone, Copy)]
enum Change {
    Nothing,
    /// k/m by a factor.
    Stiffness(f64),
    /// The shock by a factor.
    Model(f64),
}

/// From the factor on a value to the change of the shock.
type Changed = fn(f64) -> Change;

/// What is compared: demand/capacity with a tolerance, the shock in g without one.
fn demand(found: &Found, axes: &[AxisMotion], change: Change) -> f64 {
    if overturned(axes) {
        return f64::INFINITY;
    }
    let one = |one: &AxisMotion| match (one.terms, found.capacity(), change) {
        (Some(terms), _, Change::Nothing) => terms.ratio(),
        (Some(terms), _, Change::Model(factor)) => terms.ratio_by(Factors::of(factor)),
        (Some(terms), Some(capacity), Change::Stiffness(factor)) => terms.ratio_by(softened(capacity, &terms, factor)),
        (_, _, Change::Nothing) => larger_g(one),
        (_, _, Change::Model(factor)) => larger_g(one) * factor,
        (_, _, Change::Stiffness(factor)) => larger_g(one) * factor.sqrt(),
    };
    axes.iter().map(one).fold(0.0, f64::max)
}

fn demands(found: &Found, motions: &[MotionResponse], change: Change) -> Vec<f64> {
    motions.iter().filter_map(|one| Some(demand(found, one.as_ref().ok()?, change))).collect()
}

/// The bars, the widest first; none for an object that does not uplift or whose shock is not known.
pub(super) fn tornado(context: &Context, found: &Found) -> Vec<Swing> {
    let is_comparable = match found.capacity() {
        Some(_) => found.followed().all(|(_, axes)| demand_capacity(axes).is_some()),
        None => found.body().is_some(),
    };
    if !is_comparable || !found.followed().any(|(_, axes)| lifts(axes)) {
        return Vec::new();
    }
    let spread = &context.study.assessment.spread;
    let stiffness = found.body().and_then(|body| body.stiffness_spread).unwrap_or(spread.stiffness);
    let as_is = demands(found, &found.as_is, Change::Nothing);
    let mut bars = Vec::new();
    let mut bar = |parameter: Parameter, ends: [String; 2], low: Vec<f64>, high: Vec<f64>| {
        bars.push(swing(found, parameter, ends, &as_is, low, high));
    };
    if found.body().is_some() {
        let factors: [(Parameter, &str, f64, Changed); 3] = [
            (Parameter::Stiffness, "k", stiffness, Change::Stiffness),
            (Parameter::Mass, "m", spread.mass, |factor| Change::Stiffness(1.0 / factor)),
            (Parameter::Model, "Eq. (5)", spread.model, Change::Model),
        ];
        for (parameter, symbol, sd, change) in factors {
            let [low, high] = [-1.0, 1.0].map(|sign: f64| (sign * sd).exp());
            let ends = [low, high].map(|factor| format!("{} {symbol}", number(factor, 3)));
            let at = |factor: f64| demands(found, &found.as_is, change(factor));
            bar(parameter, ends, at(low), at(high));
        }
    }
    let of = |variant: Variant| found.changed.iter().find(|(one, _)| *one == variant).map(|(_, motions)| *motions);
    let pairs = [
        (Parameter::Restitution, "r", spread.restitution, Variant::RestitutionLow, Variant::RestitutionHigh),
        (Parameter::Geometry, "sides", spread.geometry, Variant::Slender, Variant::Squat),
    ];
    for (parameter, symbol, sd, low, high) in pairs {
        if let (Some(low), Some(high)) = (of(low), of(high)) {
            let ends = [-sd, sd].map(|ln| format!("{} {symbol}", number(ln.exp(), 3)));
            bar(parameter, ends, demands(found, low, Change::Nothing), demands(found, high, Change::Nothing));
        }
    }
    bars.push(motion_bar(&as_is));
    bars.sort_by(|a, b| width(b).total_cmp(&width(a)));
    bars
}

fn swing(
    found: &Found,
    parameter: Parameter,
    [low, high]: [String; 2],
    as_is: &[f64],
    mut at_low: Vec<f64>,
    mut at_high: Vec<f64>,
) -> Swing {
    // Whether the share of motions that exceed the tolerance, or without one that overturn, is
    // above the accepted one.
    let decides = found.capacity().is_some_and(|capacity| capacity.decides);
    let limit = if decides { 1.0 } else { f64::MAX };
    let is_above = |values: &[f64]| {
        let above = values.iter().filter(|value| **value > limit).count();
        above as f64 / values.len().max(1) as f64 > found.member.accepted_ratio
    };
    let flips = is_above(&at_low) != is_above(as_is) || is_above(&at_high) != is_above(as_is);
    Swing {
        parameter,
        low,
        high,
        at_low: ranked_quantile(&mut at_low, 0.5),
        at_high: ranked_quantile(&mut at_high, 0.5),
        as_is: ranked_quantile(&mut as_is.to_vec(), 0.5),
        flips,
    }
}

/// The motions themselves, from the one at 16 % to the one at 84 %.
fn motion_bar(as_is: &[f64]) -> Swing {
    let at = |quantile: f64| ranked_quantile(&mut as_is.to_vec(), quantile);
    Swing {
        parameter: Parameter::Motion,
        low: "16 % of the motions".to_owned(),
        high: "84 % of the motions".to_owned(),
        at_low: at(0.16),
        at_high: at(0.84),
        as_is: at(0.5),
        flips: false,
    }
}

/// How far apart the ends are; overturning at one end alone is the widest.
fn width(swing: &Swing) -> f64 {
    let value = |end: Ranked| match end {
        Ranked::Value(value) => value,
        Ranked::Overturned => f64::MAX,
        Ranked::NoData => 0.0,
    };
    (value(swing.at_high) - value(swing.at_low)).abs()
}
