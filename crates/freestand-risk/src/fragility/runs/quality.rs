//! How well a measure tells what an object does.

use freestand::fragility::{
    LimitState, OutcomeClass, capacity_spread, mean_and_sd, trend_p_value, weighted_line,
};

use super::super::quality::Quality;
use super::super::{LEAST_ROTATION_RATIO, ObjectFragility};
use super::follow::Followed;
use super::shaking::{Asked, FloorShaking, Strength};
use super::table::weights;
use super::{Method, ObjectRuns};

/// The qualities of a measure, for each limit state of an object.
pub(super) fn qualities(
    method: Method,
    object: &ObjectFragility,
    runs: &ObjectRuns,
    shakings: &[FloorShaking],
    asked: Asked,
) -> Vec<Quality> {
    let states = object.fit.curves.iter().map(|curve| curve.limit_state);
    states
        .map(|limit_state| {
            let demands = demands(limit_state, runs, shakings, asked);
            let line = weighted_line(&demands.iter().map(|(_, point)| *point).collect::<Vec<_>>());
            let (efficiency, left) = match method {
                Method::Cloud => {
                    let left = demands
                        .iter()
                        .zip(line.iter().flat_map(|line| &line.residuals));
                    let left: Vec<(usize, f64)> =
                        left.map(|((motion, ..), e)| (*motion, *e)).collect();
                    (line.as_ref().map(|line| line.residual_sd), left)
                }
                Method::Incremental | Method::Stripes => (
                    capacity_spread(&object.outcomes, limit_state),
                    capacities(limit_state, runs, shakings, asked),
                ),
            };
            let about = |motion: usize| {
                shakings
                    .get(motion)
                    .and_then(|shaking| shaking.at(asked.at))
            };
            let residuals: Vec<[f64; 3]> = left
                .iter()
                .filter_map(|(motion, e)| {
                    let strength: &Strength = about(*motion)?;
                    Some([
                        strength.mean_period_s?.ln(),
                        strength.velocity_over_acceleration_s().ln(),
                        *e,
                    ])
                })
                .collect();
            let trend = |i: usize| {
                trend_p_value(
                    &residuals
                        .iter()
                        .map(|one| (one[i], one[2]))
                        .collect::<Vec<(f64, f64)>>(),
                )
            };
            Quality {
                limit_state,
                efficiency,
                practicality: line.map(|line| line.slope),
                p_mean_period: trend(0),
                p_velocity_over_acceleration: trend(1),
                residuals,
            }
        })
        .collect()
}

/// (motion, (ln intensity, ln demand, weight)) of every run that rocked and stayed upright. The demand
/// of a limit state is the shock for a tolerance of shocks, otherwise the rotation. Runs of an
/// adaptive analysis are weighted as in the fit: bisection puts many of them next to the capacities.
fn demands(
    state: LimitState,
    runs: &ObjectRuns,
    shakings: &[FloorShaking],
    asked: Asked,
) -> Vec<(usize, (f64, f64, f64))> {
    let units: Vec<Option<f64>> = shakings
        .iter()
        .map(|shaking| shaking.intensity(asked, runs.factors))
        .collect();
    let weights = weights(runs, asked.place, &units);
    let by_shock = state == LimitState::Exceeds && runs.nominal.compares_shock();
    let mut demands = Vec::new();
    for (motion, ((of_motion, unit), weights)) in
        runs.motions.iter().zip(&units).zip(&weights).enumerate()
    {
        let Some(unit) = unit else { continue };
        for (followed, weight) in of_motion.iter().zip(weights) {
            let upright = followed
                .run()
                .filter(|run| matches!(run.class, OutcomeClass::Rocked | OutcomeClass::Exceeded));
            let Some((run, turned)) = upright.and_then(|run| Some((run, run.rotation_ratio?)))
            else {
                continue;
            };
            if turned < LEAST_ROTATION_RATIO {
                continue;
            }
            let demand = if by_shock {
                run.edge_acceleration_g
            } else {
                Some(turned)
            };
            if let Some(demand) = demand.filter(|demand| *demand > 0.0) {
                demands.push((
                    motion,
                    ((unit * followed.scale_ratio).ln(), demand.ln(), *weight),
                ));
            }
        }
    }
    demands
}

/// ln of the capacity of each motion less their mean, with the number of the motion; empty unless all
/// motions reached the limit state: those that did are not a sample of all.
fn capacities(
    state: LimitState,
    runs: &ObjectRuns,
    shakings: &[FloorShaking],
    asked: Asked,
) -> Vec<(usize, f64)> {
    let known = runs
        .motions
        .iter()
        .zip(shakings)
        .map(|(runs_of_motion, shaking)| {
            let reached =
                |run: &&Followed| run.run().is_some_and(|run| state.is_reached(run.class));
            let scale_ratio = runs_of_motion.iter().find(reached)?.scale_ratio;
            Some((shaking.intensity(asked, runs.factors)? * scale_ratio).ln())
        });
    let known: Option<Vec<f64>> = known.collect();
    let Some((known, (mean, _))) =
        known.and_then(|known| mean_and_sd(&known).map(|found| (known, found)))
    else {
        return Vec::new();
    };
    known.into_iter().map(|ln| ln - mean).enumerate().collect()
}
