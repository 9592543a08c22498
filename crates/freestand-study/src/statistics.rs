//! Quantiles over motions in which an overturned object ranks above every number.

use freestand::rocking::Outcome;
use freestand::spectra::UpliftCell;

use crate::result::{ObjectResponse, ObjectStatistics, Ranked};
use freestand_output::answer::Described;
use freestand_output::facts::Value;
use serde_json::json;

/// The quantiles that are reported: 16, 50 and 84 %.
pub const QUANTILES: [f64; 3] = [0.16, 0.50, 0.84];

/// Quantile of `values`, sorted here; an infinite value is an overturned object.
///
/// Linear interpolation between the ranks (n−1)q (Hyndman and Fan 1996, type 7, the default of
/// NumPy and pandas). A quantile whose interpolation needs an infinite value is
/// [`Ranked::Overturned`]: the median is, if half or more of the motions overturn the object.
pub fn ranked_quantile(values: &mut [f64], quantile: f64) -> Ranked {
    values.sort_unstable_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else {
        return Ranked::NoData;
    };
    let position = quantile * last as f64;
    let (below, share) = (position.floor() as usize, position.fract());
    let lower = values[below];
    let value = if share == 0.0 {
        lower
    } else {
        lower + share * (values[(below + 1).min(last)] - lower)
    };
    if value.is_finite() {
        Ranked::Value(value)
    } else {
        Ranked::Overturned
    }
}

fn quantiles(mut values: Vec<f64>) -> [Ranked; 3] {
    QUANTILES.map(|q| ranked_quantile(&mut values, q))
}

/// Statistics of one object over the motions whose histories did not fail; `None` if all failed.
pub fn object_statistics<'a>(
    responses: impl Iterator<Item = &'a ObjectResponse>,
) -> Option<ObjectStatistics> {
    let done: Vec<_> = responses.filter_map(ObjectResponse::done).collect();
    let (first, shock) = done.first()?;
    let share = |holds: &dyn Fn(&UpliftCell) -> bool| {
        done.iter().filter(|(uplift, _)| holds(uplift)).count() as f64 / done.len() as f64
    };
    let survivors: Vec<f64> = done
        .iter()
        .filter_map(|(_, shock)| shock.edge_acceleration_g)
        .collect();
    let uplifts = done.iter().map(|(uplift, _)| {
        if uplift.rocking.outcome.has_fallen() {
            f64::INFINITY
        } else {
            uplift.rocking.uplift_m
        }
    });
    let shocks = done
        .iter()
        .map(|(_, shock)| shock.edge_acceleration_g.unwrap_or(f64::INFINITY));
    let impacts = done.iter().map(|(_, shock)| {
        shock
            .edge_acceleration_impact_velocity_g
            .unwrap_or(f64::INFINITY)
    });
    Some(ObjectStatistics {
        height_m: first.block.height_m(),
        thickness_m: first.block.thickness_m(),
        motions: done.len(),
        uplift_share: share(&|uplift| uplift.rocking.outcome != Outcome::NoUplift),
        overturned_share: share(&|uplift| uplift.rocking.outcome.has_fallen()),
        uplift_m: quantiles(uplifts.collect()),
        edge_acceleration_g: quantiles(shocks.collect()),
        edge_acceleration_impact_velocity_g: quantiles(impacts.collect()),
        edge_acceleration_survivors_g: ranked_quantile(&mut survivors.clone(), 0.5).value(),
        edge_acceleration_max_g: survivors.iter().copied().reduce(f64::max),
        ceiling_g: shock.ceiling_g,
    })
}

impl ObjectStatistics {
    /// Whether the median shock, by the larger of the two sources, is above a tolerance. It is if
    /// half or more of the motions overturn the object.
    pub fn exceeds(&self, tolerance_g: f64) -> bool {
        [
            self.edge_acceleration_g[1],
            self.edge_acceleration_impact_velocity_g[1],
        ]
        .into_iter()
        .any(|median| match median {
            Ranked::Value(shock_g) => shock_g > tolerance_g,
            Ranked::Overturned => true,
            Ranked::NoData => false,
        })
    }
}

impl Ranked {
    /// The quantile, if it is a number.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Value(value) => Some(value),
            Self::Overturned | Self::NoData => None,
        }
    }
}

impl Described for Ranked {
    fn schema() -> serde_json::Value {
        json!({"type": ["number", "string", "null"]})
    }
}

impl From<Ranked> for Value<'_> {
    /// The number, `overturned`, or nothing.
    fn from(ranked: Ranked) -> Self {
        match ranked {
            Ranked::Value(value) => Self::NumberOr(Some(value), Outcome::Overturned.name()),
            Ranked::Overturned => Self::NumberOr(None, Outcome::Overturned.name()),
            Ranked::NoData => Self::Missing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FALLEN: f64 = f64::INFINITY;

    #[test]
    fn the_median_is_overturned_where_half_overturn() {
        let mut five_of_ten = [
            0.0, 1.0, 2.0, 3.0, 4.0, FALLEN, FALLEN, FALLEN, FALLEN, FALLEN,
        ];
        assert_eq!(ranked_quantile(&mut five_of_ten, 0.5), Ranked::Overturned);
        assert_eq!(ranked_quantile(&mut five_of_ten, 0.16), Ranked::Value(1.44));
        let mut four_of_nine = [0.0, 1.0, 2.0, 3.0, 4.0, FALLEN, FALLEN, FALLEN, FALLEN];
        assert_eq!(ranked_quantile(&mut four_of_nine, 0.5), Ranked::Value(4.0));
        assert_eq!(ranked_quantile(&mut four_of_nine, 0.84), Ranked::Overturned);
    }

    /// An object that ends leaning on a wall ranks with those that overturn.
    #[test]
    fn leaning_counts_as_overturning() {
        let text = "[ground]\ncount = 2\n[building]\nlevels = [0.0, 1.0]\n[objects]\nheights = \"1 m, 2 m, 3 m\"\n\
                    thicknesses = \"400 mm\"\n";
        let study = crate::resolve::resolve(text, None, "".as_ref()).unwrap();
        let result = crate::run::run(&study, &crate::run::no_progress).unwrap();
        let responses = result
            .levels
            .iter()
            .flat_map(|level| level.responses.iter().flatten());
        let leaned = responses.filter_map(|response| match response {
            ObjectResponse::Done { uplift, shock, .. }
                if uplift.rocking.outcome == Outcome::Rocked =>
            {
                let (mut uplift, mut shock) = (*uplift, *shock);
                uplift.rocking.outcome = Outcome::Leaned;
                // As the shock of every object that has fallen.
                shock.edge_acceleration_g = None;
                Some(ObjectResponse::Done {
                    uplift,
                    shock,
                    direction_deg: None,
                })
            }
            _ => None,
        });
        let leaned: Vec<ObjectResponse> = leaned.take(1).collect();
        let statistics = object_statistics(leaned.iter()).unwrap();
        assert_eq!(
            (statistics.overturned_share, statistics.uplift_m[1]),
            (1.0, Ranked::Overturned)
        );
        assert!(statistics.exceeds(1e9));
    }

    #[test]
    fn one_motion_is_its_own_quantile_and_none_has_none() {
        assert_eq!(ranked_quantile(&mut [2.5], 0.84), Ranked::Value(2.5));
        assert_eq!(ranked_quantile(&mut [FALLEN], 0.16), Ranked::Overturned);
        assert_eq!(ranked_quantile(&mut [], 0.5), Ranked::NoData);
    }
}
