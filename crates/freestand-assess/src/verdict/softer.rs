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
use super::trial::{Question, Trial, live_on};

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
///
/// An object whose pad failed is at its first worlds again. Those go on together that need the same worlds next, from
/// the first worlds to the last ones and then again from the first: so the floors of a world are calculated for as many
/// as possible at once, and those of the first worlds, in which most pads fail, are kept while
/// there is room.
pub(super) fn softer(
    context: &Context,
    trials: &[Trial],
) -> Result<Vec<Option<Softening>>, Problems> {
    let mut found: Vec<Option<Softening>> = trials.iter().map(|_| None).collect();
    let with_first_floors = context.in_worlds(context.worlds.keeping_floors());
    let (mut pads, mut softened): (Vec<Pad>, Vec<Trial>) = trials
        .iter()
        .enumerate()
        .filter(|(_, trial)| is_wanted(context, trial))
        .filter_map(|(place, trial)| tried(context, trial, place, 1))
        .unzip();
    let mut reached = (0, 0);
    loop {
        // Verdicts on pads that need no further world.
        for at in (0..pads.len()).rev() {
            if softened[at].is_settled() {
                let (pad, trial) = (pads.swap_remove(at), softened.swap_remove(at));
                let Verdict {
                    softening,
                    is_final,
                } = verdict(context, &trial, pad.stiffness_n_m);
                // A pad that was too close to call says more than a softer one that clearly fails.
                let earlier = found[pad.place].as_ref();
                let is_kept = earlier.is_some_and(|earlier| earlier.outcome == CLOSE);
                if softening.admissible() || !is_kept {
                    found[pad.place] = Some(softening);
                }
                let next = || tried(context, &trials[pad.place], pad.place, pad.step + 1);
                if let Some((pad, trial)) = (!is_final).then(next).flatten() {
                    pads.push(pad);
                    softened.push(trial);
                }
            }
        }
        let ends = |trial: &Trial| trial.next().map(|worlds| (worlds.start, worlds.end));
        let next = || softened.iter().filter_map(ends);
        let ahead = next().filter(|ends| *ends >= reached).min();
        let Some(worlds) = ahead.or_else(|| next().min()) else {
            context.count(usize::try_from(with_first_floors.histories()).unwrap_or(0));
            return Ok(found);
        };
        reached = worlds;
        let together = softened.iter().enumerate();
        let together = together.filter(|(_, trial)| ends(trial) == Some(worlds));
        let together: Vec<usize> = together.map(|(at, _)| at).collect();
        let context = if worlds.0 == 0 {
            &with_first_floors
        } else {
            context
        };
        live_on(context, &mut softened, worlds.0..worlds.1, &together)?;
    }
}

/// A pad that is tried for the object at a place.
struct Pad {
    place: usize,
    /// How many times as soft as its own it is, in steps of [`NEXT_PAD`].
    step: i32,
    stiffness_n_m: f64,
}

/// The object on the next softer pad from this step on; `None`: there is none.
fn tried<'a>(
    context: &Context,
    trial: &Trial<'a>,
    place: usize,
    from: i32,
) -> Option<(Pad, Trial<'a>)> {
    (from..=TRIED_PADS).find_map(|step| {
        let subject = on_softer(&trial.subject, NEXT_PAD.powi(step))?;
        let body = subject.body.as_ref()?;
        let pad = Pad {
            place,
            step,
            stiffness_n_m: body.cushion.linear_stiffness_n_m()?,
        };
        Some((pad, Trial::new(context, trial.member, subject)))
    })
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
