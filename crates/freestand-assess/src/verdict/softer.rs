//! A softer pad: accepted where the object would be left as it is on it, by both models and in all
//! its worlds.

use freestand::cushion::{ContactLaw, Cushion};
use freestand::decision::Side;

use crate::reason::NoPad;
use crate::result::{PadOutcome, Softening};
use freestand_input::problem::Problems;
use freestand_study::result::Ranked;

use super::Context;
use super::object::{Subject, Way};
use super::on_pads::on_pads;
use super::over_worlds::quantile;
use super::trial::{Question, Trial, live};

/// Pads that are tried, each [`NEXT_PAD`] times as stiff as the one before.
const TRIED_PADS: i32 = 8;

/// About the step between the hardnesses in which pads are sold.
const NEXT_PAD: f64 = 0.7;

/// Digits of the stiffness of a tried pad, so that what is printed is what was tried.
const DIGITS: i32 = 3;

/// What says more than that a softer pad clearly fails.
const CLOSE: PadOutcome = PadOutcome::Exceeded { is_close: true };

/// Assumed thickness of a pad \[m\], the same as in the check for N/m typed in place of N/mm.
const ASSUMED_PAD_M: f64 = 0.02;

/// For each trial the first pad that passed, else the first that was too close to call, else the
/// softest that was tried; `None` where no pad was looked for.
pub(super) fn softer(
    context: &Context,
    trials: &[Trial],
) -> Result<Vec<Option<Softening>>, Problems> {
    let mut found: Vec<Option<Softening>> = trials.iter().map(|_| None).collect();
    let mut open: Vec<usize> = (0..trials.len())
        .filter(|&place| is_wanted(context, &trials[place]))
        .collect();
    for step in 1..=TRIED_PADS {
        let mut tried: Vec<(usize, f64, Trial)> = Vec::new();
        for &place in &open {
            let trial = &trials[place];
            let Some(subject) = on_softer(&trial.subject, NEXT_PAD.powi(step)) else {
                continue;
            };
            let Some(stiffness_n_m) = subject
                .body
                .as_ref()
                .and_then(|body| body.cushion.linear_stiffness_n_m())
            else {
                continue;
            };
            tried.push((
                place,
                stiffness_n_m,
                Trial::new(context, trial.member, subject),
            ));
        }
        let (places, mut softened): (Vec<(usize, f64)>, Vec<Trial>) = tried
            .into_iter()
            .map(|(place, stiffness_n_m, trial)| ((place, stiffness_n_m), trial))
            .unzip();
        live(context, &mut softened)?;
        for ((place, stiffness_n_m), trial) in places.into_iter().zip(&softened) {
            let verdict = verdict(context, trial, stiffness_n_m);
            if verdict.is_final {
                open.retain(|one| *one != place);
            }
            // A pad that was too close to call says more than a softer one that clearly fails.
            if verdict.softening.admissible()
                || !found[place]
                    .as_ref()
                    .is_some_and(|earlier| earlier.outcome == CLOSE)
            {
                found[place] = Some(verdict.softening);
            }
        }
    }
    Ok(found)
}

/// A softer pad is looked for where the shock alone is too hard or too close to call, and depends
/// on a pad that is a spring.
pub(super) fn is_wanted(context: &Context, trial: &Trial) -> bool {
    let Some(capacity) = &trial.subject.capacity else {
        return false;
    };
    trial.member.asks_shock
        && trial.subject.way.rocks()
        && capacity.decides
        && capacity.needs_shock()
        && trial
            .subject
            .body
            .as_ref()
            .is_some_and(|body| body.cushion.linear_stiffness_n_m().is_some())
        && trial.side(context, Question::Falls) == Side::Below
        && trial.side(context, Question::Shock) != Side::Below
}

fn on_softer(subject: &Subject, factor: f64) -> Option<Subject> {
    let mut subject = subject.clone();
    let body = subject.body.as_mut()?;
    let now_n_m = body.cushion.linear_stiffness_n_m()?;
    let wanted_n_m = factor * now_n_m;
    let unit = 10f64.powi(wanted_n_m.log10().floor() as i32 + 1 - DIGITS);
    let stiffness_n_m = (wanted_n_m / unit).floor() * unit;
    body.cushion = match *body.cushion.law() {
        // The damping ratio stays.
        ContactLaw::KelvinVoigt { damping_n_s_m, .. } => {
            let damping_n_s_m = damping_n_s_m * (stiffness_n_m / now_n_m).sqrt();
            Cushion::new(ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            })
            .ok()?
        }
        _ => Cushion::linear(stiffness_n_m).ok()?,
    };
    Some(subject)
}

struct Verdict {
    softening: Softening,
    /// Whether no further pad is to be tried.
    is_final: bool,
}

fn verdict(context: &Context, trial: &Trial, stiffness_n_m: f64) -> Verdict {
    let high = |question| {
        let ends = trial
            .models(context)
            .map(|model| trial.probability(context, question, model).high);
        ends.fold(0.0, f64::max)
    };
    let (p_exceed_high, p_overturn_high) = (high(Question::Shock), high(Question::Falls));
    let compliant = on_pads(context, trial);
    let rigid_m = trial.lived.iter().filter_map(|lived| {
        let axes = &lived.on_rigid()?.axes;
        Some(
            axes.iter()
                .filter_map(|one| Some(one.hit()?.compression_m))
                .fold(0.0, f64::max),
        )
    });
    let stroke_m = compliant.map_or_else(|| quantile(rigid_m, 0.95), |pads| pads.compression_m_p95);
    let stated_m = trial
        .subject
        .body
        .as_ref()
        .and_then(|body| body.pad_thickness_m);
    let pad_thickness_m = stated_m.unwrap_or(ASSUMED_PAD_M);
    let strain_ratio = context.study.assessment.pad_strain_ratio;
    let is_pressed = stroke_m >= strain_ratio * pad_thickness_m;
    let (falls, shock) = (
        trial.side(context, Question::Falls),
        trial.side(context, Question::Shock),
    );
    let is_below = falls == Side::Below && shock == Side::Below;
    let outcome = if is_below && !is_pressed {
        PadOutcome::Enough
    } else if is_pressed {
        PadOutcome::Pressed(strain_ratio)
    } else if falls != Side::Below {
        PadOutcome::Falls
    } else {
        PadOutcome::Exceeded {
            is_close: shock == Side::Open,
        }
    };
    let edge_acceleration_g = compliant.and_then(|pads| match pads.edge_acceleration_g_median {
        Ranked::Value(shock_g) => Some(shock_g),
        Ranked::Overturned | Ranked::NoData => None,
    });
    let admissible = outcome == PadOutcome::Enough;
    let softening = Softening {
        max_stiffness_n_m: Some(stiffness_n_m),
        stroke_m: Some(stroke_m),
        pad_thickness_m,
        edge_acceleration_g,
        p_exceed_high: Some(p_exceed_high),
        p_overturn_high: Some(p_overturn_high),
        is_assumed: stated_m.is_none(),
        outcome,
    };
    // Softer pads are compressed further, and objects fall from them sooner.
    Verdict {
        is_final: admissible || is_pressed || falls == Side::Above,
        softening,
    }
}

/// Why no softer pad helps.
pub(super) fn beyond_pads(trial: &Trial) -> NoPad {
    match trial.subject.way {
        Way::Rolls(_) => return NoPad::Rolls,
        Way::Slides(_) => return NoPad::Slides,
        Way::Planar | Way::Walled(_) | Way::Spatial(_) | Way::Stack(_) | Way::Hull(..) => {}
    }
    let Some(body) = &trial.subject.body else {
        return NoPad::NoPads;
    };
    let capacity = trial.subject.capacity.as_ref();
    if capacity.is_some_and(|capacity| !capacity.needs_shock()) {
        return NoPad::Uplift;
    }
    if body.cushion.linear_stiffness_n_m().is_none() {
        return NoPad::NoSpring;
    }
    NoPad::Other
}
