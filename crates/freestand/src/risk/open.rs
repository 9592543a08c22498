//! Where runs leave much of a rate open.

use crate::fragility::CurveKind;

use super::capacity::{AboveLast, Capacity, rate_bounds};
use super::deaggregation::annual_rate_below;
use super::hazard::Hazard;
use super::rate::AnnualRates;

/// If a larger share of a rate is between two intensities of the runs, or below or above all of them,
/// the runs do not tell the rate.
pub const RESOLVED: f64 = 0.1;

/// A range of intensities without runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gap {
    /// Below the lowest intensity.
    Below {
        /// The weakest motion that lifts the object; `None`: not known.
        uplift: Option<f64>,
        /// The lowest intensity.
        lowest: f64,
    },
    /// Between two intensities.
    Between(f64, f64),
    /// Above the highest intensity.
    Above(f64),
}

/// A part of a rate of which the runs say only in which range its capacities are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenPart {
    /// The range.
    pub gap: Gap,
    /// How much of the rate is in it \[1/year\]; infinite where that is not known.
    pub annual_rate: f64,
    /// The same as a share of the rate; infinite where the rate is not known.
    pub share: f64,
}

/// The least and the most that a rate can be by the runs of a curve (see [`rate_bounds`]). Where the uplift
/// of the motions is not known, the curve says how much is below the lowest intensity, if that is little.
pub fn bounds_by_runs(
    hazard: &Hazard,
    kind: CurveKind,
    by_curve: AnnualRates,
    found: &[Capacity],
    above: AboveLast,
) -> (f64, Option<f64>) {
    let (least, most) = rate_bounds(hazard, found, above);
    let (open, closed): (Vec<Capacity>, Vec<Capacity>) =
        found.iter().partition(|one| one.from.is_none());
    let below_lowest = || {
        let lowest = open.first()?.to?;
        let below = annual_rate_below(hazard, kind, lowest)?;
        let at_lowest = open.iter().map(|one| one.share).sum::<f64>()
            * hazard.annual_rate_with(lowest, above.most());
        let is_small = below <= RESOLVED * by_curve.annual_rate?;
        Some(rate_bounds(hazard, &closed, above).1? + at_lowest + below).filter(|_| is_small)
    };
    (least, most.or_else(below_lowest))
}

/// The rate of which parts are open: that of the curve, but no more than `most`, which the runs allow; `None`:
/// neither is known.
pub fn open_rate(by_curve: AnnualRates, most: Option<f64>) -> Option<f64> {
    [by_curve.annual_rate, most]
        .into_iter()
        .flatten()
        .reduce(f64::min)
}

/// The ranges with more than [`RESOLVED`] of a rate ([`open_rate`]), rising.
///
/// # Example
/// Half of the capacities are between 0.1 and 0.2 and the others between 0.2 and 0.21; λ = x⁻¹:
/// ```
/// use freestand::fragility::CurveKind;
/// use freestand::risk::{Capacity, Gap, Hazard, annual_rate, open_parts};
/// let hazard = Hazard::power_law(1.0, 1.0, 1.0)?;
/// let by_curve = annual_rate(&hazard, CurveKind::Lognormal { median: 0.17, beta: 0.2 });
/// let capacity = |from, to| Capacity { from: Some(from), to: Some(to), share: 0.5, is_lowest: false };
/// let open = open_parts(&hazard, by_curve, None, &[capacity(0.1, 0.2), capacity(0.2, 0.21)]);
/// assert_eq!((open.len(), open[0].gap), (1, Gap::Between(0.1, 0.2)));
/// assert!((open[0].annual_rate - 0.5 * (10.0 - 5.0)).abs() < 1e-12);
/// # Ok::<(), freestand::risk::HazardError>(())
/// ```
pub fn open_parts(
    hazard: &Hazard,
    by_curve: AnnualRates,
    most: Option<f64>,
    found: &[Capacity],
) -> Vec<OpenPart> {
    let rate = |x: Option<f64>| x.map_or(0.0, |x| hazard.annual_rate(x));
    let all = open_rate(by_curve, most);
    // Those below the lowest intensity belong together.
    let (lowest, others): (Vec<Capacity>, Vec<Capacity>) =
        found.iter().partition(|one| one.is_lowest);
    let open = |one: &Capacity| one.share * (rate(one.from) - rate(one.to));
    let below = lowest.first().and_then(|one| one.to).map(|to| {
        let is_known = lowest.iter().all(|one| one.from.is_some()) || most.is_some();
        let part = if is_known {
            lowest
                .iter()
                .filter(|one| one.from.is_some())
                .map(open)
                .sum()
        } else {
            f64::INFINITY
        };
        let uplift = lowest
            .iter()
            .map(|one| one.from)
            .reduce(|a, b| Some(a?.min(b?)))
            .flatten();
        (Gap::Below { uplift, lowest: to }, part)
    });
    let others = others.iter().filter_map(|one| {
        let from = one.from?;
        Some((
            one.to.map_or(Gap::Above(from), |to| Gap::Between(from, to)),
            open(one),
        ))
    });
    let parts = below.into_iter().chain(others).map(|(gap, annual_rate)| {
        let share = all.map_or(f64::INFINITY, |all| annual_rate / all);
        OpenPart {
            gap,
            annual_rate,
            share,
        }
    });
    parts.filter(|part| part.share > RESOLVED).collect()
}
