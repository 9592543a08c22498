//! From the histories of one object to its assessment.

use freestand::G0_M_S2;
use freestand::impact::{ImpactModel, Landing, impact_friction_needed_ratio};
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome as RockingOutcome, RockingImpact, rock};
use freestand::spectra::landings;

use crate::floors::Floor;
use crate::result::{
    Assessment, AxisResponse, CapacityCheck, Chain, Criterion, Decision, Probability, Ranked, Response, Shock, Sliding,
    SlidingVerdict,
};
use freestand_study::statistics::{QUANTILES, ranked_quantile};

use super::Context;
use super::capacity::Capacity;
use super::comparisons::friction_needed_ratio;
use super::decision::{Case, decide};
use super::group::{Member, Variant};
use super::object::{Body, Hit, hit};
use super::response::{AxisMotion, MotionResponse, demand_capacity, governing, lifts, options, overturned, ranked};
use super::second_opinion::{beyond_pads, second_opinion, softer};
use super::tornado::tornado;
use super::uncertainty::{Draws, probability, shares};

/// The histories of one object, before they are evaluated.
pub(super) struct Found<'a> {
    pub(super) member: &'a Member<'a>,
    pub(super) floor: &'a Floor,
    pub(super) as_is: Vec<MotionResponse>,
    pub(super) changed: Vec<(Variant, &'a [MotionResponse])>,
    /// `None`: uplift is impossible, so that nothing was drawn.
    pub(super) draws: Option<Draws>,
    /// Whether the spectra of the floor replace histories of its own.
    pub(super) is_screened: bool,
}

impl Found<'_> {
    pub(super) fn body(&self) -> Option<&Body> {
        self.member.subject.body.as_ref()
    }

    pub(super) fn capacity(&self) -> Option<&Capacity> {
        self.member.subject.capacity.as_ref()
    }

    /// The motions whose histories are complete, with their places.
    pub(super) fn followed(&self) -> impl Iterator<Item = (usize, &[AxisMotion])> {
        self.as_is.iter().enumerate().filter_map(|(i, one)| Some((i, one.as_ref().ok()?.as_slice())))
    }

    /// What a motion is ranked by: demand/capacity where it is known, else the shock, else the
    /// rise.
    fn severity(&self, axes: &[AxisMotion]) -> f64 {
        match (self.capacity().and_then(|_| demand_capacity(axes)), self.body()) {
            (Some(ratio), _) => ratio,
            (None, Some(_)) => ranked(axes, larger_g),
            (None, None) => ranked(axes, |one| one.rocking.cg_rise_m),
        }
    }

    /// The motions from the mildest to the hardest.
    pub(super) fn by_severity(&self) -> Vec<usize> {
        let mut order: Vec<(f64, usize)> = self.followed().map(|(i, axes)| (self.severity(axes), i)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        order.into_iter().map(|(_, i)| i).collect()
    }

    /// The place of the motion that decides: the hardest after the accepted share of them is left
    /// out.
    pub(super) fn deciding_place(&self, motions: usize) -> Option<usize> {
        let beyond = (self.member.accepted_ratio * motions as f64).floor() as usize;
        motions.checked_sub(1 + beyond.min(motions.saturating_sub(1)))
    }
}

pub(super) fn larger_g(one: &AxisMotion) -> f64 {
    one.hit.as_ref().map_or(0.0, Hit::larger_g)
}

/// Quantiles of values over the motions.
pub(super) fn quantiles(values: impl Iterator<Item = f64>) -> [Ranked; 3] {
    let mut values: Vec<f64> = values.collect();
    QUANTILES.map(|q| ranked_quantile(&mut values, q))
}

fn share(values: impl Iterator<Item = bool>) -> f64 {
    let (holds, count) = values.fold((0usize, 0usize), |(holds, count), one| (holds + usize::from(one), count + 1));
    holds as f64 / count.max(1) as f64
}

/// The whole assessment of one object.
pub(super) fn assessment(context: &Context, found: &Found) -> Assessment {
    let member = found.member;
    let mut assessed = member.blank(found.floor.facts.clone());
    let Some(response) = response(found) else {
        let reason = found.as_is.iter().find_map(|one| one.as_ref().err()).cloned().unwrap_or_default();
        assessed.why = format!("Nothing was assessed, because every history failed: {reason}.");
        return assessed;
    };
    let shock = shock(found);
    let lift = found.followed().any(|(_, axes)| lifts(axes));
    let (p_overturn, p_exceed) = probabilities(found);
    let order = found.by_severity();
    let deciding = found.deciding_place(order.len()).map(|place| order[place]);
    let governs = deciding.and_then(|motion| governing_criterion(found, motion));
    let second = if found.is_screened { None } else { second_opinion(context, found, &order, p_exceed.as_ref()) };
    let is_above = |p: Option<&Probability>| p.is_some_and(|p| p.value > member.accepted_ratio);
    let compliant_above = second.as_ref().is_some_and(|(_, p)| *p > member.accepted_ratio);
    let wants_softer = p_overturn.value <= member.accepted_ratio && (is_above(p_exceed.as_ref()) || compliant_above);
    let harder = second.as_ref().filter(|_| !is_above(p_exceed.as_ref())).and_then(|(check, _)| check.shock_ratio);
    let softening = if wants_softer { softer(context, found, &order, harder.unwrap_or(1.0)) } else { None };
    let missing = missing(found);
    let unknown_ratio = unknown_ratio(context, found, response.failed);
    let (decision, why) = decide(&Case {
        accepted_ratio: member.accepted_ratio,
        lifts: lift,
        p_overturn,
        p_exceed,
        decides: found.capacity().is_some_and(|capacity| capacity.decides),
        governing: governs,
        missing: &missing,
        pfa_g: found.floor.facts.pfa_g_median,
        hardest: hardest(found),
        unknown_ratio,
        bottoms: bottoms(found),
        softer: softening.as_ref().map(|one| (one.admissible, one.note.as_str())),
        beyond_pads: if wants_softer && softening.is_none() { beyond_pads(found) } else { "" },
        p_compliant: second.as_ref().map(|(_, p)| *p),
        tolerance_source: member.item.tolerance.as_ref().map_or("", |tolerance| &tolerance.source),
    });
    if found.is_screened {
        assessed.notes.push(
            "Decided by the uplift spectra of its floor: its numbers are those of the nearest block of their grid."
                .to_owned(),
        );
    }
    if response.failed > 0 {
        assessed.notes.push(format!(
            "The histories under {} of {} motions failed ({}) and are left out of every number.",
            response.failed,
            found.as_is.len(),
            response.failure.as_deref().unwrap_or("")
        ));
    }
    let looked_at = deciding.filter(|_| !found.is_screened);
    let chain = looked_at.and_then(|motion| chain(context, found, motion));
    let survived = order
        .iter()
        .rev()
        .copied()
        .find(|&motion| found.as_is[motion].as_ref().is_ok_and(|axes| !overturned(axes) && lifts(axes)));
    let impacts = survived.filter(|_| !found.is_screened).and_then(|motion| impacts_above(found, motion));
    assessed.decision = decision;
    assessed.why = why;
    if lift && p_exceed.is_some() && member.item.cushion_source.is_some() {
        assessed.why.push_str(" Its stiffness is a range from the cushion library, not a measurement.");
    }
    assessed.tier = match (&found.draws, found.is_screened) {
        (None, _) => 0,
        (Some(_), true) => 1,
        (Some(_), false) => 2 + u8::from(second.is_some()),
    };
    assessed.capacity = capacity_check(found, governs);
    assessed.draws = if found.is_screened { 0 } else { max_draws(found) };
    assessed.p_overturn = Some(p_overturn);
    assessed.p_exceed = p_exceed;
    assessed.sliding = sliding(context, found, &order);
    assessed.softening = softening;
    assessed.compliant = second.map(|(check, _)| check);
    assessed.tornado = tornado(context, found);
    if decision == Decision::Restrain {
        assessed.restraint = context.restraint(found);
    }
    assessed.clearance_m = clearance(found);
    assessed.context = context.comparisons(found);
    assessed.shock = shock.map(|shock| Shock { impacts_above_tolerance: impacts, ..shock });
    assessed.response = Some(response);
    assessed.chain = chain;
    assessed
}

/// Share of the motions, or of the draws, whose histories failed.
fn unknown_ratio(context: &Context, found: &Found, failed: usize) -> f64 {
    let motions = failed as f64 / found.as_is.len().max(1) as f64;
    let Some(draws) = found.draws.as_ref().filter(|_| !found.is_screened) else { return motions };
    let wanted = context.names.len() * max_draws(found) as usize;
    let done: usize = draws.iter().map(Vec::len).sum();
    motions.max(1.0 - done as f64 / wanted.max(1) as f64)
}

/// Whether a motion that does not overturn it compresses its pads by more than their stated
/// thickness.
fn bottoms(found: &Found) -> bool {
    let Some(thickness_m) = found.body().and_then(|body| body.pad_thickness_m) else { return false };
    let pressed = |one: &AxisMotion| one.hit.as_ref().is_some_and(|hit| hit.compression_m > thickness_m);
    found.followed().any(|(_, axes)| axes.iter().any(pressed))
}

/// Demand/capacity of the hardest motion; without a tolerance, rotation over the slenderness angle.
fn hardest(found: &Found) -> f64 {
    let of = |axes: &[AxisMotion]| demand_capacity(axes).unwrap_or_else(|| rotation_ratio(found, axes));
    found.followed().map(|(_, axes)| of(axes)).fold(0.0, f64::max)
}

/// Peak rotation over the slenderness angle, about the axis where it is larger.
fn rotation_ratio(found: &Found, axes: &[AxisMotion]) -> f64 {
    if overturned(axes) {
        return f64::INFINITY;
    }
    let alpha = |axis: usize| found.member.subject.axes[axis].block.pivot().slenderness_angle_rad;
    axes.iter().enumerate().map(|(i, one)| one.rocking.peak_rotation_rad / alpha(i)).fold(0.0, f64::max)
}

fn max_draws(found: &Found) -> u32 {
    found.draws.iter().flatten().map(Vec::len).max().unwrap_or(0) as u32
}

fn response(found: &Found) -> Option<Response> {
    let motions = found.followed().count();
    if motions == 0 {
        return None;
    }
    let over = |number: &dyn Fn(&AxisMotion) -> f64| quantiles(found.followed().map(|(_, axes)| ranked(axes, number)));
    Some(Response {
        motions,
        failed: found.as_is.len() - motions,
        failure: found.as_is.iter().find_map(|one| one.as_ref().err()).cloned(),
        uplift_share: share(found.followed().map(|(_, axes)| lifts(axes))),
        overturn_share: share(found.followed().map(|(_, axes)| overturned(axes))),
        uplift_m: over(&|one| one.rocking.uplift_m),
        rotation_ratio: quantiles(found.followed().map(|(_, axes)| rotation_ratio(found, axes))),
        impacts_max: found.followed().flat_map(|(_, axes)| axes.iter().map(|one| one.rocking.impact_count)).max()?,
        axes: (0..found.member.subject.axes.len()).map(|axis| axis_response(found, axis)).collect(),
    })
}

fn axis_response(found: &Found, axis: usize) -> AxisResponse {
    let geometry = &found.member.subject.axes[axis];
    let pivot = geometry.block.pivot();
    let motions = || found.followed().filter_map(|(_, axes)| axes.get(axis));
    let shock = |one: &AxisMotion| ranked(std::slice::from_ref(one), larger_g);
    AxisResponse {
        axis: geometry.axis,
        slenderness_angle_rad: pivot.slenderness_angle_rad,
        half_diagonal_m: pivot.half_diagonal_m,
        uplift_threshold_g: pivot.slenderness_angle_rad.tan(),
        uplift_share: share(motions().map(|one| one.rocking.outcome != RockingOutcome::NoUplift)),
        overturn_share: share(motions().map(|one| one.rocking.outcome == RockingOutcome::Overturned)),
        edge_acceleration_g: found.body().map(|_| quantiles(motions().map(shock))),
        ceiling_g: found.body().map(|body| ceiling_g(found, axis, body)),
    }
}

fn ceiling_g(found: &Found, axis: usize, body: &Body) -> f64 {
    let landings = landings(&found.member.subject.axes[axis].block, ImpactModel::Paper);
    let of = |landing: &Landing| {
        let rise_m = landing.pivot.balance_rise_m();
        landing.edge_acceleration_m_s2(body.mass_kg, &body.cushion, rise_m, G0_M_S2) / G0_M_S2
    };
    landings.iter().map(of).fold(0.0, f64::max)
}

fn shock(found: &Found) -> Option<Shock> {
    let body = found.body()?;
    let larger = quantiles(found.followed().map(|(_, axes)| ranked(axes, larger_g)));
    let from_uplift = |one: &AxisMotion| one.hit.as_ref().map_or(0.0, |hit| hit.uplift_g);
    let change = |one: &AxisMotion| one.hit.as_ref().map_or(0.0, |hit| hit.velocity_change_m_s);
    let survived = found.followed().filter(|(_, axes)| !overturned(axes) && lifts(axes));
    let survived: Vec<(usize, f64)> =
        survived.filter_map(|(_, axes)| governing(axes).map(|(axis, one)| (axis, larger_g(one)))).collect();
    let hardest = survived.iter().copied().reduce(|most, next| if next.1 > most.1 { next } else { most });
    let axes = 0..found.member.subject.axes.len();
    Some(Shock {
        edge_acceleration_g: larger,
        edge_acceleration_uplift_g: quantiles(found.followed().map(|(_, axes)| ranked(axes, from_uplift))),
        edge_acceleration_max_g: hardest.map(|(_, shock_g)| shock_g),
        pulse_duration_s: pulse_duration_s(found, hardest.map_or(0, |(axis, _)| axis), body),
        velocity_change_m_s: quantiles(found.followed().map(|(_, axes)| ranked(axes, change)))[1],
        ceiling_g: axes.map(|axis| ceiling_g(found, axis, body)).fold(0.0, f64::max),
        stiffness_n_m: body.cushion.linear_stiffness_n_m(),
        impacts_above_tolerance: None,
    })
}

/// The duration of the pulse on the cushion; for a curved contact law, of a landing from a
/// hundredth of the rise at the balance point.
fn pulse_duration_s(found: &Found, axis: usize, body: &Body) -> f64 {
    let landing = Landing::rocking(&found.member.subject.axes[axis].block, ImpactModel::Paper);
    let rise_m = 0.01 * landing.pivot.balance_rise_m();
    landing.impact(body.mass_kg, &body.cushion, rise_m, G0_M_S2).pulse_duration_s
}

fn probabilities(found: &Found) -> (Probability, Option<Probability>) {
    let never = Probability { value: 0.0, low: 0.0, high: 1.0 };
    let comparable = found.capacity().is_some_and(|capacity| found.body().is_some() || !capacity.needs_shock());
    match &found.draws {
        Some(draws) => (
            probability(&shares(draws, |one| one.overturned)).unwrap_or(never),
            if comparable { probability(&shares(draws, |one| one.exceeds())) } else { floor_alone(found) },
        ),
        // It does not uplift, so that only the acceleration of the floor remains, and only a peak
        // can be exceeded by it.
        None => {
            let zeros: Vec<f64> = found.followed().map(|_| 0.0).collect();
            let floor = found.capacity().map(|capacity| {
                let above = |motion: usize| capacity.peak_m_s2.is_some_and(|peak| found.floor.pfa_m_s2[motion] > peak);
                found.followed().map(|(motion, _)| f64::from(u8::from(above(motion)))).collect::<Vec<f64>>()
            });
            (probability(&zeros).unwrap_or(never), floor.and_then(|by_motion| probability(&by_motion)))
        }
    }
}

/// For an object without a known shock, the probability that the acceleration of its floor alone
/// exceeds its tolerance, where that is above the accepted one: a shock could only add to it.
fn floor_alone(found: &Found) -> Option<Probability> {
    let peak_m_s2 = found.capacity()?.peak_m_s2?;
    let above = |(motion, _): (usize, _)| f64::from(u8::from(found.floor.pfa_m_s2[motion] > peak_m_s2));
    let by_motion: Vec<f64> = found.followed().map(above).collect();
    probability(&by_motion).filter(|p| p.value > found.member.accepted_ratio)
}

fn missing(found: &Found) -> Vec<&'static str> {
    let item = found.member.item;
    let known = [
        (item.tolerance.is_some() && found.capacity().is_some(), "tolerance"),
        (item.mass_kg.is_some(), "mass"),
        (item.cushion.is_some(), "cushion"),
    ];
    known.into_iter().filter(|(is_known, _)| !is_known).map(|(_, name)| name).collect()
}

fn governing_criterion(found: &Found, motion: usize) -> Option<Criterion> {
    let capacity = found.capacity()?;
    let axes = found.as_is.get(motion)?.as_ref().ok()?;
    if overturned(axes) {
        return Some(Criterion::Overturning);
    }
    let terms = axes.iter().filter_map(|one| one.terms);
    let worst = terms.reduce(|most, next| if next.ratio() > most.ratio() { next } else { most });
    match worst {
        Some(worst) => Some(worst.governing(capacity)),
        None => floor_alone(found).map(|_| Criterion::FloorAcceleration),
    }
}

fn capacity_check(found: &Found, governing: Option<Criterion>) -> Option<CapacityCheck> {
    let (capacity, tolerance) = (found.capacity()?, found.member.item.tolerance.as_ref()?);
    let ratios: Option<Vec<f64>> = found.followed().map(|(_, axes)| demand_capacity(axes)).collect();
    let [_, median, p84] = ratios.map_or([Ranked::NoData; 3], |ratios| quantiles(ratios.into_iter()));
    Some(CapacityCheck {
        demand_capacity: median,
        demand_capacity_p84: p84,
        governing: governing.unwrap_or(capacity.edge_criterion()),
        tolerance: capacity.words(),
        source: tolerance.source.clone(),
        decides: capacity.decides,
        floor_ratio: capacity.peak_m_s2.map(|peak| found.floor.facts.pfa_g_median * G0_M_S2 / peak),
    })
}

/// Impacts above the peak of its tolerance, about the governing axis; `None` where no peak is
/// known.
fn impacts_above(found: &Found, motion: usize) -> Option<usize> {
    let (body, peak) = (found.body()?, found.capacity()?.peak_m_s2?);
    let axes = found.as_is.get(motion)?.as_ref().ok()?;
    let block = &found.member.subject.axes[governing(axes)?.0].block;
    let landing = Landing::rocking(block, ImpactModel::Paper);
    let above = |impact: &RockingImpact| {
        let omega_rad_s = impact.omega_before_rad_s;
        let shock = landing.impact_at_omega(body.mass_kg, &body.cushion, omega_rad_s, G0_M_S2);
        shock.edge_acceleration_m_s2 > peak
    };
    let in_direction = |direction: &Motion| {
        let base = Base { horizontal: Some(direction), vertical: None };
        let history = rock(block, base, &options(found.member.subject.restitution)).ok()?;
        Some(history.impacts.iter().filter(|impact| above(impact)).count())
    };
    found.floor.motions[motion].iter().filter_map(in_direction).max()
}

/// Whether it slides, by the friction that rocking and its impacts need under the hardest motion,
/// or that an object at rest needs on its floor; `None` where that is not known.
fn sliding(context: &Context, found: &Found, order: &[usize]) -> Option<Sliding> {
    let rocks = |motion: usize| found.as_is[motion].as_ref().is_ok_and(|axes| lifts(axes));
    let Some(motion) = order.iter().rev().copied().find(|&motion| rocks(motion)) else {
        return Some(slides(context, found, found.floor.facts.pfa_g_max));
    };
    if found.is_screened {
        return None;
    }
    let subject = &found.member.subject;
    let (axis, _) = governing(found.as_is[motion].as_ref().ok()?)?;
    let block = &subject.axes[axis].block;
    let restitution = subject.restitution.ratios(block).ok()?[0];
    let directions = found.floor.motions[motion].iter();
    let rocking = directions.map(|direction| friction_needed_ratio(block, direction, subject.restitution));
    let most = rocking.collect::<Option<Vec<f64>>>()?.into_iter().fold(0.0, f64::max);
    Some(slides(context, found, most.max(impact_friction_needed_ratio(block, restitution))))
}

fn slides(context: &Context, found: &Found, needed_ratio: f64) -> Sliding {
    let stated = found.member.item.friction_ratio;
    let (low, high) = stated.unwrap_or(context.study.assessment.friction_ratio);
    let verdict = if low >= needed_ratio {
        SlidingVerdict::No
    } else if high < needed_ratio {
        SlidingVerdict::Yes
    } else {
        SlidingVerdict::Possible
    };
    Sliding { verdict, friction_ratio: (low, high), is_stated: stated.is_some() }
}

/// Eqs. (5)–(7) about the governing axis; `None` where it overturns or does not uplift.
fn chain(context: &Context, found: &Found, motion: usize) -> Option<Chain> {
    let (axis, one) = governing(found.as_is.get(motion)?.as_ref().ok()?)?;
    let (body, geometry) = (found.body()?, &found.member.subject.axes[axis]);
    if one.rocking.outcome != RockingOutcome::Rocked {
        return None;
    }
    let landing = Landing::rocking(&geometry.block, ImpactModel::Paper);
    let shock = landing.impact(body.mass_kg, &body.cushion, one.rocking.cg_rise_m, G0_M_S2);
    let both = hit(&geometry.block, &one.rocking, body.mass_kg, &body.cushion)?;
    Some(Chain {
        motion: context.names.get(motion)?.clone(),
        axis: geometry.axis,
        height_m: geometry.height_m,
        thickness_m: geometry.side_m,
        is_uniform: geometry.is_uniform() && body.cushion.linear_stiffness_n_m().is_some(),
        base_m: geometry.block.base_width_m(),
        half_diagonal_m: geometry.block.pivot().half_diagonal_m,
        mass_kg: body.mass_kg,
        stiffness_n_m: body.cushion.linear_stiffness_n_m(),
        cg_rise_m: one.rocking.cg_rise_m,
        landing_ratio: geometry.block.landing_ratio(),
        is_halted: geometry.block.landing_ratio() <= 0.0,
        drop_acceleration_g: shock.drop_acceleration_m_s2 / G0_M_S2,
        effective_mass_kg: landing.effective_mass_ratio * body.mass_kg,
        edge_acceleration_g: both.uplift_g,
        edge_acceleration_impact_velocity_g: both.impact_velocity_g,
        velocity_change_m_s: shock.velocity_change_m_s,
        pulse_duration_s: shock.pulse_duration_s,
        uplift_m: one.rocking.uplift_m,
        demand_capacity_ratio: one.terms.map(|terms| terms.ratio()),
    })
}

/// The clearance that the object needs while it rocks: the largest over the motions and axes.
fn clearance(found: &Found) -> Option<f64> {
    let clear = |(i, one): (usize, &AxisMotion)| {
        let geometry = &found.member.subject.axes[i];
        match one.rocking.outcome {
            RockingOutcome::Overturned => geometry.height_m,
            _ => crate::restraint::clearance_m(geometry.height_m, geometry.side_m, one.rocking.peak_rotation_rad),
        }
    };
    found.followed().flat_map(|(_, axes)| axes.iter().enumerate().map(clear).collect::<Vec<_>>()).reduce(f64::max)
}
