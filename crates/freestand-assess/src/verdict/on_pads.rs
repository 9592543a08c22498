//! What happens to an object on its pads, over its worlds.

use freestand::G0_M_S2;
use freestand::compliant::{pad_uplift_threshold_m_s2, rocking_frequency_hz};

use crate::result::{OnPads, Ranked};
use freestand_study::statistics::QUANTILES;

use super::Context;
use super::object::{Model, Way};
use super::over_worlds::{quantile, quantiles, share};
use super::response::{PadMotion, pads_demand_capacity};
use super::trial::Trial;

/// What happens on its pads; `None` where that was not asked.
pub(super) fn on_pads(context: &Context, trial: &Trial) -> Option<OnPads> {
    if !trial.asks(context, Model::Pads) {
        return None;
    }
    let body = trial.subject.body.as_ref()?;
    let worlds = || trial.followed_on_pads();
    let most = |axes: &[PadMotion], number: fn(&PadMotion) -> f64| {
        axes.iter().map(number).fold(0.0, f64::max)
    };
    let rank = |number: fn(&PadMotion) -> f64| {
        quantiles(worlds().map(|(_, axes)| {
            if axes.iter().any(|one| one.found.has_fallen()) {
                f64::INFINITY
            } else {
                most(axes, number)
            }
        }))[1]
    };
    // A stack has other frequencies than the object alone.
    let is_alone = !matches!(trial.subject.way, Way::Stack(_));
    let stiffness = body.cushion.linear_stiffness_n_m().filter(|_| is_alone);
    let blocks = || trial.subject.axes.iter().map(|axis| &axis.block);
    let frequency = stiffness.and_then(|k| {
        blocks()
            .filter_map(|block| rocking_frequency_hz(block, body.mass_kg, k, G0_M_S2))
            .reduce(f64::min)
    });
    let threshold = stiffness.and_then(|k| {
        blocks()
            .map(|block| pad_uplift_threshold_m_s2(block, body.mass_kg, k, G0_M_S2) / G0_M_S2)
            .reduce(f64::min)
    });
    let ratios: Vec<f64> = worlds()
        .filter_map(|(_, axes)| {
            axes.iter()
                .map(|one| one.found.pad_uplift_ratio)
                .try_fold(0.0f64, |a, b| Some(a.max(b?)))
        })
        .collect();
    Some(OnPads {
        rocking_frequency_hz: frequency,
        pad_uplift_threshold_g: threshold,
        pad_uplift_ratio_p84: (!ratios.is_empty())
            .then(|| quantile(ratios.iter().copied(), QUANTILES[2])),
        let_go_share: share(
            worlds().map(|(_, axes)| axes.iter().any(|one| one.found.has_let_go())),
        ),
        rebound_restitution: quantile(
            trial.lived.iter().map(|one| one.draw.rebound_restitution()),
            0.5,
        ),
        edge_acceleration_g_median: rank(|one| one.edge_m_s2 / G0_M_S2),
        demand_capacity_median: ratios_on_pads(trial),
        lift_m_median: rank(|one| one.found.lift_m),
        failed: trial
            .lived
            .iter()
            .filter(|one| matches!(one.pads, Some(Err(_))))
            .count(),
        compression_m_p95: quantile(
            worlds().map(|(_, axes)| most(axes, |one| one.found.compression_m)),
            0.95,
        ),
    })
}

/// Demand/capacity on pads of the median world; no data where that of a world is not known.
fn ratios_on_pads(trial: &Trial) -> Ranked {
    let ratios: Option<Vec<f64>> = trial
        .followed_on_pads()
        .map(|(_, axes)| pads_demand_capacity(axes))
        .collect();
    ratios.map_or(Ranked::NoData, |ratios| quantiles(ratios.into_iter())[1])
}
