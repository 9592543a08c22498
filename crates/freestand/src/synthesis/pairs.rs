//! Magnitudes and distances that meet a target spectrum on rock: which earthquake a code's level stands for.

use super::point_source::PointSource;
use super::simulation::{SimulationOptions, Simulator};
use super::{DAMPING_RATIO, SynthesisError};
use crate::G0_M_S2;
use crate::oscillator::response_spectrum;
use rayon::prelude::*;

/// Magnitudes for which a pair is looked for.
pub const PAIR_MAGNITUDES: [f64; 4] = [5.5, 6.0, 6.5, 7.0];
/// Periods at which the spectra are compared: 0.5 to 1 s, equally spaced in ln T.
const PERIODS: usize = 9;
const FROM_PERIOD_S: f64 = 0.5;
/// Where a distance is looked for \[m\].
const NEAREST_M: f64 = 2e3;
const FARTHEST_M: f64 = 300e3;
/// The search ends when the mean meets the target to this share.
const RATIO_TOLERANCE: f64 = 1e-3;
/// Steps of the search; four or five are usual.
const MOST_STEPS: usize = 60;

/// An earthquake whose mean spectrum meets the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Moment magnitude.
    pub magnitude: f64,
    /// Distance \[m\].
    pub distance_m: f64,
    /// Geometric mean over motions and periods of PSA/target at that distance: 1 but for the search's tolerance.
    pub mean_ratio: f64,
}

/// The distance at which the geometric mean of the 5 %-damped PSA of `count` motions of `seed` meets `target_sa_g` (period
/// \[s\] to g, on rock) over T = 0.5 to 1 s; the source of each distance is `at_distance` (m). `None` where the mean lies on one side
/// of the target from 2 to 300 km.
///
/// The same streams of random numbers are used at each distance. The mean falls with distance but for the little that the
/// longer window changes; the search ends where the mean meets the target to a thousandth.
///
/// # Accuracy
/// The mean of `count` motions: its standard error in ln PSA is about 0.3/√count at one period and moves the distance
/// by as much.
///
/// # Errors
/// Parameters of the source out of range, a target that is not positive and finite.
///
/// # Example
/// Rock in Melbourne, 500 years, has Sa(T) = 0.08·0.88/T g: magnitude 6 at some 30 km.
/// ```
/// use freestand::synthesis::{Preset, distance_for_target};
/// let pair = distance_for_target(|r_m| Preset::Victoria.source(6.0, r_m), |t| 0.08 * 0.88 / t, 1, 10)?;
/// assert!(pair.is_some_and(|pair| (25e3..38e3).contains(&pair.distance_m)));
/// # Ok::<(), freestand::synthesis::SynthesisError>(())
/// ```
pub fn distance_for_target(
    at_distance: impl Fn(f64) -> PointSource,
    target_sa_g: impl Fn(f64) -> f64,
    seed: u64,
    count: u64,
) -> Result<Option<Pair>, SynthesisError> {
    let periods_s: Vec<f64> =
        (0..PERIODS).map(|i| FROM_PERIOD_S * 2.0_f64.powf(i as f64 / (PERIODS - 1) as f64)).collect();
    let mut ln_target = 0.0;
    for &period_s in &periods_s {
        let sa_g = target_sa_g(period_s);
        if !(sa_g > 0.0 && sa_g.is_finite()) {
            return Err(SynthesisError::Target { period_s, sa_g });
        }
        ln_target += sa_g.ln() / PERIODS as f64;
    }
    // Twice the default step is a fiftieth of the shortest of these periods.
    let options = SimulationOptions { dt_s: 0.01, ..SimulationOptions::default() };
    let ln_ratio = |distance_m: f64| -> Result<f64, SynthesisError> {
        let simulator = Simulator::new(&at_distance(distance_m), |_| 1.0, &options)?;
        let means: Vec<f64> = (0..count)
            .into_par_iter()
            .map(|index| {
                let motion = simulator.motion(seed, index)?;
                let spectrum = response_spectrum(&motion, DAMPING_RATIO, &periods_s)?;
                Ok(spectrum.psa_m_s2.iter().map(|psa| (psa / G0_M_S2).ln()).sum::<f64>() / PERIODS as f64)
            })
            .collect::<Result<_, SynthesisError>>()?;
        Ok(means.iter().sum::<f64>() / count as f64 - ln_target)
    };
    // The false-position rule in ln R with halved values at an end that stays (Illinois): ln PSA is nearly straight in it.
    let (mut near, mut far) = (NEAREST_M.ln(), FARTHEST_M.ln());
    let (mut above, mut below) = (ln_ratio(NEAREST_M)?, ln_ratio(FARTHEST_M)?);
    if !(above > 0.0 && below < 0.0) {
        return Ok(None);
    }
    let mut last_was_near = None;
    for _ in 0..MOST_STEPS {
        let ln_distance = near + (far - near) * above / (above - below);
        let distance_m = ln_distance.exp();
        let value = ln_ratio(distance_m)?;
        if value.abs() < RATIO_TOLERANCE {
            let magnitude = at_distance(distance_m).magnitude;
            return Ok(Some(Pair { magnitude, distance_m, mean_ratio: value.exp() }));
        }
        if value > 0.0 {
            (near, above) = (ln_distance, value);
            below *= if last_was_near == Some(true) { 0.5 } else { 1.0 };
        } else {
            (far, below) = (ln_distance, value);
            above *= if last_was_near == Some(false) { 0.5 } else { 1.0 };
        }
        last_was_near = Some(value > 0.0);
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::Preset;

    #[test]
    fn the_pairs_of_melbourne_are_those_of_another_computation() {
        // An independent implementation, 20 motions each with other random numbers, gives "around" 15, 30, 45, 80 km.
        // 20 motions have a standard error of 0.3/√20 = 7 % in distance, two such 10 %, and those are rounded to 5 km.
        let rock = |t: f64| 0.08 * 0.88 / t;
        for (magnitude, expected_km) in [(5.5, 15.0), (6.0, 30.0), (6.5, 45.0), (7.0, 80.0)] {
            let at = |distance_m| Preset::Victoria.source(magnitude, distance_m);
            let pair = distance_for_target(at, rock, 1, 20).unwrap().unwrap();
            assert!((pair.distance_m / 1000.0 - expected_km).abs() < 0.2 * expected_km + 2.5, "{pair:?}");
            // The search's tolerance in ln.
            assert!((pair.mean_ratio - 1.0).abs() < 1.001e-3, "{pair:?}");
        }
    }

    #[test]
    fn what_no_distance_meets_has_no_pair() {
        let at = |distance_m| Preset::Victoria.source(5.5, distance_m);
        assert_eq!(distance_for_target(at, |_| 20.0, 1, 2).unwrap(), None);
        assert!(matches!(distance_for_target(at, |_| 0.0, 1, 2), Err(SynthesisError::Target { .. })));
    }
}
