//! Suites of recorded motions that have the mean and the dispersion of a hazard.

use thiserror::Error;

use crate::G0_M_S2;
use crate::motion::Motion;
use crate::oscillator::{DAMPING_RATIO, OscillatorError, response_spectrum};

/// Number of periods at which suites are compared with their target.
pub const SUITE_PERIODS: usize = 30;
/// The smallest and the largest factor of a record.
pub const FACTOR_LIMITS: (f64, f64) = (0.25, 4.0);
/// A swap helps if it lowers the misfit by this share: rounding must not decide.
const BETTER_BY_RATIO: f64 = 1e-9;

/// How the records of a suite are scaled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::EnumString, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case", ascii_case_insensitive)]
pub enum SuiteScale {
    /// Each by a factor of its own.
    Each,
    /// All by one factor.
    One,
}

impl SuiteScale {
    /// The name in studies and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Standard deviation of ln Sa that the suite is to have.
    ///
    /// The 44 far-field components of FEMA P-695 have (root mean square over 0.2 to 3 s) 0.36 with
    /// each component scaled and 0.38 with each record scaled; 0.45 normalised by their peak
    /// velocities and then scaled by one factor, and 0.52 as recorded.
    pub fn dispersion(self) -> f64 {
        match self {
            Self::Each => 0.35,
            Self::One => 0.44,
        }
    }
}

/// Why no suite can be selected.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SuiteError {
    /// The size of the suite is out of range.
    #[error("a suite has 2 records or more and at most the {usable} that are usable, not {count}")]
    Count {
        /// The size that was asked for.
        count: usize,
        /// Number of candidates.
        usable: usize,
    },
    /// The periods do not rise from above 0.
    #[error("the periods of a suite must rise from above 0 s, not from {from_s} to {to_s} s")]
    Periods {
        /// The shortest \[s\].
        from_s: f64,
        /// The longest \[s\].
        to_s: f64,
    },
    /// A record or the target has no logarithm at some period, or not one value for each.
    #[error("the spectrum must be positive and finite at {SUITE_PERIODS} periods")]
    Spectrum,
    /// A candidate without components.
    #[error("a record must have one component or more")]
    NoComponents,
    /// The oscillators of a spectrum are invalid.
    #[error(transparent)]
    Oscillator(#[from] OscillatorError),
}

/// The periods at which suites are compared, equally spaced in ln T \[s\].
///
/// # Errors
/// Periods that do not rise from above 0.
pub fn suite_periods_s(from_s: f64, to_s: f64) -> Result<Vec<f64>, SuiteError> {
    if !(from_s > 0.0 && from_s < to_s && to_s.is_finite()) {
        return Err(SuiteError::Periods { from_s, to_s });
    }
    let last = (SUITE_PERIODS - 1) as f64;
    Ok((0..SUITE_PERIODS)
        .map(|i| from_s * (to_s / from_s).powf(i as f64 / last))
        .collect())
}

/// A record that a suite may use: the spectra of its components.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// ln Sa \[g\] of each component at the periods.
    ln_sa: Vec<Vec<f64>>,
}

impl Candidate {
    /// From ln Sa \[g\] of each component at [`SUITE_PERIODS`] periods.
    ///
    /// # Errors
    /// No components, or a spectrum that is not finite at every period.
    pub fn new(ln_sa: Vec<Vec<f64>>) -> Result<Self, SuiteError> {
        if ln_sa.is_empty() {
            return Err(SuiteError::NoComponents);
        }
        ln_sa.iter().try_for_each(|one| check(one))?;
        Ok(Self { ln_sa })
    }

    /// From the components of a record, by their 5 %-damped PSA at `periods_s`.
    ///
    /// # Errors
    /// No components, or a motion without content.
    pub fn of_motions(components: &[&Motion], periods_s: &[f64]) -> Result<Self, SuiteError> {
        let ln_sa = |motion: &&Motion| -> Result<Vec<f64>, SuiteError> {
            let spectrum = response_spectrum(motion, DAMPING_RATIO, periods_s)?;
            Ok(spectrum
                .psa_m_s2
                .iter()
                .map(|psa| (psa / G0_M_S2).ln())
                .collect())
        };
        Self::new(components.iter().map(ln_sa).collect::<Result<_, _>>()?)
    }
}

fn check(ln_sa: &[f64]) -> Result<(), SuiteError> {
    if ln_sa.len() == SUITE_PERIODS && ln_sa.iter().all(|ln| ln.is_finite()) {
        Ok(())
    } else {
        Err(SuiteError::Spectrum)
    }
}

/// A record of a suite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chosen {
    /// Its place among the candidates, from 0.
    pub candidate: usize,
    /// The factor of all its components.
    pub factor: f64,
}

/// A suite, and what it reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Suite {
    /// The records in the order of the candidates.
    pub chosen: Vec<Chosen>,
    /// Mean of ln Sa over all components, less ln of the target, at each period.
    pub mean_ln_ratio: Vec<f64>,
    /// Standard deviation of ln Sa over all components at each period.
    pub sd_ln: Vec<f64>,
    /// The sum of squares that was minimised.
    pub misfit: f64,
    /// Number of swaps.
    pub swaps: usize,
}

/// The `count` of the candidates whose components together have a spectrum with the mean and the
/// dispersion of the target: the smallest
///
/// Σ_T (mean ln Sa − ln S)² + (sd ln Sa − s)²
///
/// over [`SUITE_PERIODS`] periods, with s by [`SuiteScale::dispersion`], that swaps of single
/// records find. The search starts from the records that fit best by themselves and replaces one
/// after the other by the best of those left, until no swap helps.
///
/// The factor of a record (`Each`) makes the mean of ln Sa over its components and the periods that
/// of the target, that of all (`One`) the mean over the suite; both only within [`FACTOR_LIMITS`].
/// Components of one record have one factor.
///
/// # Reference
/// Jayaram, Lin and Baker (2011), "A computationally efficient ground-motion selection algorithm for
/// matching a target response spectrum mean and variance", Earthquake Spectra 27, 797–815: the
/// greedy search, here with the standard deviation in place of an error weight and from the best
/// single fits instead of simulated spectra.
///
/// # Accuracy
/// A local minimum. It depends on the candidates, not on chance.
///
/// # Errors
/// Fewer than two records or more than there are candidates; a target with other than
/// [`SUITE_PERIODS`] finite values.
///
/// # Example
/// Two records that lie 0.35/√2 above and below the target at alternate periods have just the
/// dispersion that is asked for:
/// ```
/// use freestand::suite::{Candidate, SUITE_PERIODS, SuiteScale, select_suite};
/// let record = |size: f64| {
///     let ln_sa = (0..SUITE_PERIODS).map(|i| if i % 2 == 0 { size } else { -size }).collect();
///     Candidate::new(vec![ln_sa])
/// };
/// let size = 0.35 / 2.0_f64.sqrt();
/// let candidates = [record(0.01)?, record(size)?, record(2.0)?, record(-size)?];
/// let suite = select_suite(&candidates, &[0.0; SUITE_PERIODS], 2, SuiteScale::Each)?;
/// assert!(suite.misfit < 1e-12);
/// assert_eq!(suite.chosen.iter().map(|one| one.candidate).collect::<Vec<_>>(), [1, 3]);
/// # Ok::<(), freestand::suite::SuiteError>(())
/// ```
pub fn select_suite(
    candidates: &[Candidate],
    ln_target_sa: &[f64],
    count: usize,
    scale: SuiteScale,
) -> Result<Suite, SuiteError> {
    check(ln_target_sa)?;
    if count < 2 || count > candidates.len() {
        return Err(SuiteError::Count {
            count,
            usable: candidates.len(),
        });
    }
    let pool = Pool::new(candidates, ln_target_sa, scale);
    let mut chosen = pool.best_single_fits(count);
    let (mut misfit, mut swaps) = (pool.sums(&chosen).misfit(scale), 0);
    loop {
        let before = swaps;
        for place in 0..count {
            if let Some((candidate, lower)) = pool.best_at(place, &chosen, misfit) {
                chosen[place] = candidate;
                misfit = lower;
                swaps += 1;
            }
        }
        if swaps == before {
            break;
        }
    }
    chosen.sort_unstable();
    let sums = pool.sums(&chosen);
    let ln_common = sums.ln_common(scale);
    let of = |&candidate: &usize| Chosen {
        candidate,
        factor: (pool.ln_factors[candidate] + ln_common).exp(),
    };
    Ok(Suite {
        chosen: chosen.iter().map(of).collect(),
        mean_ln_ratio: sums.moments().map(|(mean, _)| mean + ln_common).collect(),
        sd_ln: sums.moments().map(|(_, sd)| sd).collect(),
        misfit: sums.misfit(scale),
        swaps,
    })
}

/// The candidates relative to the target.
struct Pool {
    scale: SuiteScale,
    /// ln of the factors of `Each`; 0 for `One`.
    ln_factors: Vec<f64>,
    /// ln(factor·Sa/target) of each component of each candidate.
    ln_ratios: Vec<Vec<Vec<f64>>>,
}

fn limited(ln_factor: f64) -> f64 {
    ln_factor.clamp(FACTOR_LIMITS.0.ln(), FACTOR_LIMITS.1.ln())
}

fn mean_of(components: &[Vec<f64>]) -> f64 {
    components.iter().flatten().sum::<f64>() / (components.len() * SUITE_PERIODS) as f64
}

impl Pool {
    fn new(candidates: &[Candidate], ln_target_sa: &[f64], scale: SuiteScale) -> Self {
        let relative = |one: &Vec<f64>| {
            one.iter()
                .zip(ln_target_sa)
                .map(|(ln, target)| ln - target)
                .collect()
        };
        let mut ln_ratios: Vec<Vec<Vec<f64>>> = candidates
            .iter()
            .map(|candidate| candidate.ln_sa.iter().map(relative).collect())
            .collect();
        let own = |components: &Vec<Vec<f64>>| match scale {
            SuiteScale::Each => limited(-mean_of(components)),
            SuiteScale::One => 0.0,
        };
        let ln_factors: Vec<f64> = ln_ratios.iter().map(own).collect();
        for (components, ln_factor) in ln_ratios.iter_mut().zip(&ln_factors) {
            components
                .iter_mut()
                .flatten()
                .for_each(|ln| *ln += ln_factor);
        }
        Self {
            scale,
            ln_factors,
            ln_ratios,
        }
    }

    /// The records with the smallest mean squares by themselves; with one factor for all, that of
    /// all candidates together.
    fn best_single_fits(&self, count: usize) -> Vec<usize> {
        let all: Vec<usize> = (0..self.ln_ratios.len()).collect();
        let ln_common = self.sums(&all).ln_common(self.scale);
        let misfit = |components: &Vec<Vec<f64>>| {
            components
                .iter()
                .flatten()
                .map(|ln| (ln + ln_common).powi(2))
                .sum::<f64>()
                / components.len() as f64
        };
        let misfits: Vec<f64> = self.ln_ratios.iter().map(misfit).collect();
        let mut order = all;
        order.sort_by(|&a, &b| misfits[a].total_cmp(&misfits[b]));
        order.truncate(count);
        order
    }

    fn sums(&self, chosen: &[usize]) -> Sums {
        let mut sums = Sums::default();
        chosen
            .iter()
            .for_each(|&candidate| sums.add(&self.ln_ratios[candidate]));
        sums
    }

    /// The candidate that, in this place, lowers the misfit most, and the misfit with it.
    fn best_at(&self, place: usize, chosen: &[usize], misfit: f64) -> Option<(usize, f64)> {
        let rest: Vec<usize> = chosen
            .iter()
            .enumerate()
            .filter(|(i, _)| *i != place)
            .map(|(_, &one)| one)
            .collect();
        let without = self.sums(&rest);
        let mut best = None;
        let mut least = misfit * (1.0 - BETTER_BY_RATIO);
        for (candidate, components) in self
            .ln_ratios
            .iter()
            .enumerate()
            .filter(|(i, _)| !chosen.contains(i))
        {
            let mut with = without.clone();
            with.add(components);
            let lower = with.misfit(self.scale);
            if lower < least {
                (best, least) = (Some((candidate, lower)), lower);
            }
        }
        best
    }
}

/// Sums over components, at each period.
#[derive(Clone)]
struct Sums {
    components: f64,
    sum: [f64; SUITE_PERIODS],
    squares: [f64; SUITE_PERIODS],
}

impl Default for Sums {
    fn default() -> Self {
        Self {
            components: 0.0,
            sum: [0.0; SUITE_PERIODS],
            squares: [0.0; SUITE_PERIODS],
        }
    }
}

impl Sums {
    fn add(&mut self, components: &[Vec<f64>]) {
        for one in components {
            self.components += 1.0;
            for ((sum, square), ln) in self.sum.iter_mut().zip(&mut self.squares).zip(one) {
                *sum += ln;
                *square += ln * ln;
            }
        }
    }

    /// Mean and standard deviation at each period.
    fn moments(&self) -> impl Iterator<Item = (f64, f64)> {
        self.sum.iter().zip(&self.squares).map(|(sum, squares)| {
            let mean = sum / self.components;
            (
                mean,
                ((squares - sum * mean).max(0.0) / (self.components - 1.0)).sqrt(),
            )
        })
    }

    /// ln of the factor of all.
    fn ln_common(&self, scale: SuiteScale) -> f64 {
        match scale {
            SuiteScale::Each => 0.0,
            SuiteScale::One => {
                limited(-self.sum.iter().sum::<f64>() / (self.components * SUITE_PERIODS as f64))
            }
        }
    }

    fn misfit(&self, scale: SuiteScale) -> f64 {
        let (ln_common, dispersion) = (self.ln_common(scale), scale.dispersion());
        self.moments()
            .map(|(mean, sd)| (mean + ln_common).powi(2) + (sd - dispersion).powi(2))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worlds::{GroundSpread, SpreadOptions};

    /// Pairs with the deviations of worlds, at 30 of the matched periods.
    fn pool(pairs: u32) -> Vec<Candidate> {
        let spread = GroundSpread::new(SpreadOptions {
            intensity_spread: 0.3,
            ..SpreadOptions::default()
        })
        .unwrap();
        let of = |world| {
            let spectra = spread.spectra(11, world, 0);
            let ln = |ratios: &[f64]| {
                ratios
                    .iter()
                    .skip(37)
                    .step_by(2)
                    .take(SUITE_PERIODS)
                    .copied()
                    .collect()
            };
            Candidate::new(vec![ln(spectra.x.ln_ratios()), ln(spectra.y.ln_ratios())]).unwrap()
        };
        (0..pairs).map(of).collect()
    }

    fn target() -> Vec<f64> {
        (0..SUITE_PERIODS).map(|i| 0.2 - 0.03 * i as f64).collect()
    }

    /// The misfit from the definitions, without sums.
    fn misfit_of(
        candidates: &[Candidate],
        target: &[f64],
        chosen: &[usize],
        scale: SuiteScale,
    ) -> f64 {
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let relative = |ln_sa: &Vec<f64>| {
            ln_sa
                .iter()
                .zip(target)
                .map(|(a, b)| a - b)
                .collect::<Vec<f64>>()
        };
        let mut all: Vec<Vec<f64>> = Vec::new();
        for &candidate in chosen {
            let components: Vec<Vec<f64>> =
                candidates[candidate].ln_sa.iter().map(relative).collect();
            let factor = mean(&components.concat()).clamp(-(4.0_f64.ln()), 4.0_f64.ln());
            let shift = if scale == SuiteScale::Each {
                factor
            } else {
                0.0
            };
            all.extend(
                components
                    .iter()
                    .map(|one| one.iter().map(|ln| ln - shift).collect()),
            );
        }
        let common = if scale == SuiteScale::One {
            mean(&all.concat())
        } else {
            0.0
        };
        let at = |i: usize| {
            let values: Vec<f64> = all.iter().map(|one| one[i] - common).collect();
            let variance = values
                .iter()
                .map(|ln| (ln - mean(&values)).powi(2))
                .sum::<f64>()
                / (values.len() - 1) as f64;
            mean(&values).powi(2) + (variance.sqrt() - scale.dispersion()).powi(2)
        };
        (0..SUITE_PERIODS).map(at).sum()
    }

    #[test]
    fn no_swap_helps_a_suite() {
        let (candidates, target) = (pool(40), target());
        for scale in [SuiteScale::Each, SuiteScale::One] {
            let suite = select_suite(&candidates, &target, 11, scale).unwrap();
            let chosen: Vec<usize> = suite.chosen.iter().map(|one| one.candidate).collect();
            let misfit = |chosen: &[usize]| misfit_of(&candidates, &target, chosen, scale);
            // Sums of 22 squares round by 1e-14 of the misfit.
            assert!(
                (misfit(&chosen) / suite.misfit - 1.0).abs() < 1e-11,
                "{} {suite:?}",
                misfit(&chosen)
            );
            for place in 0..11 {
                for other in (0..40).filter(|other| !chosen.contains(other)) {
                    let mut swapped = chosen.clone();
                    swapped[place] = other;
                    assert!(
                        misfit(&swapped) > suite.misfit * (1.0 - 2.0 * BETTER_BY_RATIO),
                        "{place} {other}"
                    );
                }
            }
            let by_periods: f64 = suite
                .mean_ln_ratio
                .iter()
                .map(|mean| mean * mean)
                .sum::<f64>()
                + suite
                    .sd_ln
                    .iter()
                    .map(|sd| (sd - scale.dispersion()).powi(2))
                    .sum::<f64>();
            assert!((by_periods / suite.misfit - 1.0).abs() < 1e-11 && suite.swaps > 0);
            // Better than every one of thirty suites that were not selected.
            let any = (0..30)
                .map(|first| misfit(&(first..first + 11).collect::<Vec<_>>()))
                .fold(f64::INFINITY, f64::min);
            println!(
                "{}: misfit {:.3}, {} swaps; not selected {any:.3}",
                scale.name(),
                suite.misfit,
                suite.swaps
            );
            assert!(suite.misfit < 0.5 * any);
        }
    }

    /// All 1140 suites of three of twenty: the search finds one of the best.
    #[test]
    fn a_small_pool_can_be_searched_completely() {
        let (candidates, target) = (pool(20), target());
        for scale in [SuiteScale::Each, SuiteScale::One] {
            let found = select_suite(&candidates, &target, 3, scale).unwrap();
            let mut all = Vec::new();
            for a in 0..20 {
                for b in 0..a {
                    all.extend((0..b).map(|c| misfit_of(&candidates, &target, &[a, b, c], scale)));
                }
            }
            let better = all
                .iter()
                .filter(|misfit| **misfit < found.misfit * (1.0 - 1e-9))
                .count();
            // A local minimum over 51 swaps is among the best fiftieth.
            assert!(better <= all.len() / 50, "{better}");
        }
    }

    #[test]
    fn factors_follow_the_level_of_the_records_within_their_limits() {
        let (candidates, target) = (pool(20), target());
        let weaker = |by: f64| -> Vec<f64> { target.iter().map(|ln| ln + by.ln()).collect() };
        for scale in [SuiteScale::Each, SuiteScale::One] {
            let here = select_suite(&candidates, &target, 5, scale).unwrap();
            let there = select_suite(&candidates, &weaker(1.5), 5, scale).unwrap();
            for (one, other) in here.chosen.iter().zip(&there.chosen) {
                assert_eq!(one.candidate, other.candidate);
                assert!((other.factor / one.factor / 1.5 - 1.0).abs() < 1e-12);
            }
            if scale == SuiteScale::One {
                assert!(
                    here.chosen
                        .iter()
                        .all(|one| one.factor == here.chosen[0].factor)
                );
            }
            let far = select_suite(&candidates, &weaker(100.0), 5, scale).unwrap();
            assert!(
                far.chosen
                    .iter()
                    .all(|one| (one.factor - 4.0).abs() < 1e-12),
                "{far:?}"
            );
            assert!(far.mean_ln_ratio.iter().all(|mean| *mean < -1.0));
        }
    }

    #[test]
    fn what_is_not_a_suite_is_refused() {
        let (candidates, target) = (pool(4), target());
        let select = |count| select_suite(&candidates, &target, count, SuiteScale::Each);
        assert_eq!(
            select(5),
            Err(SuiteError::Count {
                count: 5,
                usable: 4
            })
        );
        assert_eq!(
            select(1),
            Err(SuiteError::Count {
                count: 1,
                usable: 4
            })
        );
        assert_eq!(select(4).unwrap().swaps, 0);
        assert_eq!(
            select_suite(&candidates, &[0.0; 3], 2, SuiteScale::Each),
            Err(SuiteError::Spectrum)
        );
        assert_eq!(Candidate::new(vec![]), Err(SuiteError::NoComponents));
        assert_eq!(
            Candidate::new(vec![vec![f64::NEG_INFINITY; SUITE_PERIODS]]),
            Err(SuiteError::Spectrum)
        );
        let still = Motion::new(0.01, vec![0.0; 100]).unwrap();
        let periods_s = suite_periods_s(0.2, 3.0).unwrap();
        assert_eq!(
            Candidate::of_motions(&[&still], &periods_s),
            Err(SuiteError::Spectrum)
        );
        assert!((periods_s[29] - 3.0).abs() < 1e-12 && periods_s[0] == 0.2);
        assert!(suite_periods_s(0.0, 3.0).is_err() && suite_periods_s(3.0, 3.0).is_err());
    }
}
