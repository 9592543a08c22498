//! The compliant base: a second opinion on Eq. (5) near the accepted probability, and the check of
//! a softer pad before it is recommended.

use freestand::G0_M_S2;
use freestand::compliant::{CompliantAccuracy, CompliantBase, CompliantOptions, CompliantRocking, rock_compliant};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::rocking::{Base, Outcome};

use crate::result::{CompliantCheck, Probability, Softening};
use freestand_input::words::{counted, number, percent_significant};

use super::Context;
use super::assessment::Found;
use super::capacity::{Capacity, Factors, Terms};
use super::object::Hit;
use super::response::{AxisMotion, governing, overturned};
use super::uncertainty::{Outcome as Draw, shares};

/// A second opinion is asked for where the probability is within this factor of the accepted one.
const NEAR_FACTOR: f64 = 4.0;

/// Demand/capacity from which the ratio of the two models is computed and applied. Below it,
/// rocking on a soft pad is a different motion, but far from any limit.
const FROM_DEMAND: f64 = 0.5;

/// Motions around the deciding one that are repeated on the compliant base.
const TRIED_MOTIONS: usize = 3;

/// Assumed thickness of a pad \[m\], the same as in the check for N/m typed in place of N/mm.
const ASSUMED_PAD_M: f64 = 0.02;

/// Pads that are tried on the compliant base, each [`NEXT_PAD`] times as stiff as the one before.
const TRIED_PADS: i32 = 8;

/// About the step between the hardnesses in which pads are sold.
const NEXT_PAD: f64 = 0.7;

/// Factor on a stiffness that no pad reaches.
const SOFTEST: f64 = 1e-6;

/// Factor on the largest stiffness of a softer pad, so that rounding does not take it past its
/// limit.
const SOFTER_SHARE: f64 = 0.999;

/// The comparison with Eq. (5), and the probability of exceedance with every shock multiplied by
/// the ratio; `None` where the probability is far from the accepted one, or nothing can be
/// compared.
pub(super) fn second_opinion(
    context: &Context,
    found: &Found,
    order: &[usize],
    p_exceed: Option<&Probability>,
) -> Option<(CompliantCheck, f64)> {
    let (body, draws, p_exceed) = (found.body()?, found.draws.as_ref()?, p_exceed?);
    let accepted = found.member.accepted_ratio;
    let near = p_exceed.value > accepted / NEAR_FACTOR && p_exceed.value < NEAR_FACTOR * accepted;
    if !context.study.assessment.compliant || !near || !found.capacity()?.needs_shock() {
        return None;
    }
    let mut ratios = Vec::new();
    let (mut motions, mut fallen) = (0, Vec::new());
    let is_near = |one: &AxisMotion| one.terms.is_some_and(|terms| terms.ratio() >= FROM_DEMAND);
    for (motion, axis, one) in tried(found, order).into_iter().filter(|(.., one)| is_near(one)) {
        let Some(compliant) = follow(context, found, &body.cushion, (motion, axis)) else { continue };
        motions += 1;
        if compliant.outcome == Outcome::Overturned {
            fallen.push(motion);
        } else if let Some(paper_g) = one.hit.as_ref().map(Hit::larger_g).filter(|g| *g > 0.0) {
            ratios.push(compliant.peak_edge_acceleration_m_s2() / G0_M_S2 / paper_g);
        }
    }
    if motions == 0 {
        return None;
    }
    ratios.sort_unstable_by(f64::total_cmp);
    let shock_ratio = ratios.get(ratios.len() / 2).copied();
    let harder = |terms: &Terms| {
        let is_near = terms.ratio() >= FROM_DEMAND;
        if is_near { Factors::of(shock_ratio.unwrap_or(1.0)) } else { Factors::ONE }
    };
    // Where it overturns, every draw counts as exceeded.
    let share = |(motion, own): (usize, &Vec<Draw>)| {
        let exceeded = own.iter().filter(|one| one.exceeds_by(harder)).count();
        if fallen.contains(&motion) { 1.0 } else { exceeded as f64 / own.len() as f64 }
    };
    let by_motion: Vec<f64> = draws.iter().enumerate().filter(|(_, own)| !own.is_empty()).map(share).collect();
    let p = by_motion.iter().sum::<f64>() / by_motion.len().max(1) as f64;
    let agrees = (p > accepted) == (p_exceed.value > accepted);
    Some((CompliantCheck { motions, overturned: fallen.len(), shock_ratio, agrees }, p))
}

/// The motions nearest to the one that decides which do not overturn the object, each with the
/// governing axis.
fn tried<'a>(found: &'a Found, order: &[usize]) -> Vec<(usize, usize, &'a AxisMotion)> {
    let survived: Vec<usize> = order
        .iter()
        .copied()
        .filter(|&motion| found.as_is[motion].as_ref().is_ok_and(|axes| !overturned(axes)))
        .collect();
    let Some(place) = found.deciding_place(order.len()) else { return Vec::new() };
    let last = survived.len().min(place + 2);
    let chosen = &survived[last.saturating_sub(TRIED_MOTIONS)..last];
    let governing = |&motion: &usize| {
        let (axis, one) = governing(found.as_is[motion].as_ref().ok()?)?;
        (one.rocking.outcome == Outcome::Rocked).then_some((motion, axis, one))
    };
    chosen.iter().filter_map(governing).collect()
}

/// The history on a cushion, in the worst direction; `None` where it fails. A spring is given
/// damping, since without any it would return all energy.
fn follow(
    context: &Context,
    found: &Found,
    cushion: &Cushion,
    (motion, axis): (usize, usize),
) -> Option<CompliantRocking> {
    let block = &found.member.subject.axes[axis].block;
    let mass_kg = found.body()?.mass_kg;
    let cushion = match cushion.linear_stiffness_n_m() {
        Some(stiffness_n_m) => {
            let critical_n_s_m = 2.0 * (stiffness_n_m * mass_kg).sqrt();
            let damping_n_s_m = context.study.assessment.pad_damping_ratio * critical_n_s_m;
            Cushion::new(ContactLaw::KelvinVoigt { stiffness_n_m, damping_n_s_m }).ok()?
        }
        None => cushion.clone(),
    };
    let base = CompliantBase::new(mass_kg, cushion);
    let options = CompliantOptions { accuracy: CompliantAccuracy::Fast, ..CompliantOptions::default() };
    let histories = found.floor.motions[motion].iter().filter_map(|direction| {
        rock_compliant(block, &base, Base { horizontal: Some(direction), vertical: None }, &options).ok()
    });
    histories.reduce(|most, next| {
        let fallen = |one: &CompliantRocking| one.outcome == Outcome::Overturned;
        let rank = |one: &CompliantRocking| (fallen(one), one.peak_edge_acceleration_m_s2());
        if rank(&next) > rank(&most) { next } else { most }
    })
}

/// The largest stiffness that keeps the probability at or below the accepted one, checked by
/// repeating the motions; `None` where the shock of the edge does not govern, so that no pad can
/// help. Every shock is multiplied by `harder`.
///
/// By Eq. (5) a shock is proportional to √k; its spectrum also depends on the longer pulse. The
/// probability falls with the stiffness, so the limit is found by bisection with the draws that
/// exist.
pub(super) fn softer(context: &Context, found: &Found, order: &[usize], harder: f64) -> Option<Softening> {
    let (body, capacity, draws) = (found.body()?, found.capacity()?, found.draws.as_ref()?);
    let stiffness_n_m = body.cushion.linear_stiffness_n_m()?;
    capacity.peak_m_s2?;
    let accepted = found.member.accepted_ratio;
    let probability = |log_factor: f64| {
        let by_motion =
            shares(draws, |one| one.exceeds_by(|terms| softened(capacity, terms, log_factor.exp()).times(harder)));
        by_motion.iter().sum::<f64>() / by_motion.len().max(1) as f64
    };
    // With a millionth of the stiffness, whatever still exceeds its limit does not depend on the
    // stiffness.
    let (mut low, mut high) = (SOFTEST.ln(), 0.0);
    if probability(low) > accepted {
        return None;
    }
    while high - low > 1e-6 {
        let middle = 0.5 * (low + high);
        if probability(middle) > accepted { high = middle } else { low = middle }
    }
    let most_n_m = SOFTER_SHARE * stiffness_n_m * low.exp();
    let tries = (0..TRIED_PADS).map(|i| most_n_m * NEXT_PAD.powi(i));
    let mut softest = None;
    for max_stiffness_n_m in tries {
        let tried = tried_softer(context, found, order, capacity, (stiffness_n_m, max_stiffness_n_m));
        if tried.admissible {
            return Some(tried);
        }
        let presses = tried.stroke_m.is_none_or(|stroke_m| stroke_m > limit_m(context, tried.pad_thickness_m));
        softest = Some(tried);
        // Softer pads are compressed even further.
        if presses {
            break;
        }
    }
    softest
}

/// Why no pad suffices where the probability stays above the accepted one on the softest of all:
/// what most of the exceeding draws then exceed.
pub(super) fn beyond_pads(found: &Found) -> &'static str {
    let (Some(body), Some(capacity), Some(draws)) = (found.body(), found.capacity(), found.draws.as_ref()) else {
        return "its pads are not known";
    };
    if body.cushion.linear_stiffness_n_m().is_none() {
        return "its cushion is not a spring, so that no softer one was looked for";
    }
    let soft = |terms: &Terms| softened(capacity, terms, SOFTEST);
    let left: Vec<&Draw> = draws.iter().flatten().filter(|one| !one.overturned && one.exceeds_by(soft)).collect();
    let count = |holds: fn(&Terms) -> bool| left.iter().filter(|one| one.terms.iter().flatten().any(holds)).count();
    let fallen = draws.iter().flatten().filter(|one| one.overturned).count();
    let (lifted, shaken) = (count(|terms| terms.lift > 1.0), count(|terms| terms.floor > 1.0));
    let parts = [
        (fallen, "overturning does not depend on the stiffness"),
        (lifted, "its uplift does not depend on the stiffness"),
        (shaken, "the acceleration of the floor itself exceeds its tolerance"),
        (
            left.len().saturating_sub(lifted + shaken),
            "its velocity change, which does not depend on the stiffness, is too large by itself",
        ),
    ];
    parts.into_iter().reduce(|most, next| if next.0 > most.0 { next } else { most }).map_or("", |(_, why)| why)
}

/// Largest admissible compression.
fn limit_m(context: &Context, pad_thickness_m: f64) -> f64 {
    context.study.assessment.pad_strain_ratio * pad_thickness_m
}

/// The factors on a shock when k/m is multiplied by a factor: the peak by its root, and the
/// duration is divided by it.
pub(super) fn softened(capacity: &Capacity, terms: &Terms, stiffness_factor: f64) -> Factors {
    let peak = stiffness_factor.sqrt();
    let longer_s = terms.duration_s / peak;
    Factors { peak, spectrum: peak * capacity.severity_ratio(longer_s) / capacity.severity_ratio(terms.duration_s) }
}

/// Repeats the motions on the softer pad: the object must not overturn, nor exceed its tolerance,
/// nor compress the pad too far.
fn tried_softer(
    context: &Context,
    found: &Found,
    order: &[usize],
    capacity: &Capacity,
    (now_n_m, max_stiffness_n_m): (f64, f64),
) -> Softening {
    let stated_m = found.body().and_then(|body| body.pad_thickness_m);
    let pad_thickness_m = stated_m.unwrap_or(ASSUMED_PAD_M);
    let mut softening = Softening {
        max_stiffness_n_m: Some(max_stiffness_n_m),
        stroke_m: None,
        pad_thickness_m,
        edge_acceleration_g: None,
        admissible: false,
        note: "no spring has such a stiffness.".to_owned(),
    };
    let Ok(cushion) = Cushion::linear(max_stiffness_n_m) else { return softening };
    let factor = max_stiffness_n_m / now_n_m;
    let stiffness = format!("{} N/mm", number(max_stiffness_n_m / 1e3, 3));
    let assumed = if stated_m.is_none() { " (assumed thickness)" } else { "" };
    let mut fallen = 0;
    let (mut stroke_m, mut shock_m_s2, mut ratio) = (0.0f64, 0.0f64, 0.0f64);
    let tried = tried(found, order);
    for (motion, axis, one) in &tried {
        let Some(compliant) = follow(context, found, &cushion, (*motion, *axis)) else {
            softening.note = format!("with {stiffness} it does not stay upright, or its history fails.");
            return softening;
        };
        fallen += usize::from(compliant.outcome == Outcome::Overturned);
        stroke_m = stroke_m.max(compliant.peak_compression_m);
        let edge_m_s2 = compliant.peak_edge_acceleration_m_s2();
        shock_m_s2 = shock_m_s2.max(edge_m_s2);
        if let (Some(terms), Some(hit)) = (one.terms, one.hit) {
            // The criterion of Eq. (5) at this stiffness, with the shock of the compliant base.
            let by_paper_m_s2 = hit.larger_g() * G0_M_S2 * factor.sqrt();
            ratio = ratio.max(terms.ratio_by(softened(capacity, &terms, factor).times(edge_m_s2 / by_paper_m_s2)));
        }
    }
    softening.stroke_m = (!tried.is_empty()).then_some(stroke_m);
    softening.edge_acceleration_g = (!tried.is_empty()).then_some(shock_m_s2 / G0_M_S2);
    let pressed = format!(
        "the pad is compressed by {} mm of {} mm{assumed}",
        number(1e3 * stroke_m, 3),
        number(1e3 * pad_thickness_m, 3)
    );
    let motions = counted(tried.len(), "motion");
    (softening.admissible, softening.note) = if tried.is_empty() {
        (false, "no motion that leaves it upright remains to check a softer pad with.".to_owned())
    } else if fallen > 0 {
        (false, format!("with {stiffness} it overturns in {fallen} of {motions} on a compliant base."))
    } else if stroke_m > limit_m(context, pad_thickness_m) {
        let share = percent_significant(context.study.assessment.pad_strain_ratio, 3);
        (false, format!("at most {stiffness} is needed, but then {pressed}, more than {share}: it bottoms."))
    } else if ratio > 1.0 {
        let ratio = number(ratio, 3);
        let note = format!(
            "at most {stiffness} is needed by Eq. (5), but on a compliant base ({motions}) demand/capacity is {ratio}."
        );
        (false, note)
    } else {
        let shock_g = number(shock_m_s2 / G0_M_S2, 3);
        let note = format!(
            "at most {stiffness} under one edge. On a compliant base ({motions}) {pressed}, and the shock is \
             {shock_g} g."
        );
        (true, note)
    };
    softening
}
