//! Response spectra of floors.

use freestand::G0_M_S2;
use freestand::oscillator::response_spectrum;
use freestand::signal::rotate::{Pair, RotateError, directional_spectrum};
use rayon::prelude::*;

use crate::statistics::{QUANTILES, ranked_quantile};
use freestand_input::problem::Problem;
use freestand_output::answer;
use freestand_output::facts::{Facts, table};
use freestand_output::table::Table;
use freestand_records::horizontal::HorizontalMotion;

/// Response spectra to compute for every level.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectraRequest {
    /// Damping ratios.
    pub damping_ratios: Vec<f64>,
    /// Periods; 0 is the rigid oscillator \[s\].
    pub periods_s: Vec<f64>,
}

answer! {
    /// Floor response spectra: medians over the motions; of two components, of the largest over all
    /// directions (RotD100).
    pub struct SpectraReport named {
        periods_s: Vec<f64>,
        damping_ratios: Vec<f64>,
        levels: Vec<LevelSpectra>,
    }

    /// The spectra of one level.
    pub struct LevelSpectra named {
        level_ratio: f64,
        /// `[damping][period]`.
        psa_g: Vec<Vec<f64>>,
        /// 16 and 84 % over the motions; empty for one motion.
        psa_g_p16: Vec<Vec<f64>>,
        psa_g_p84: Vec<Vec<f64>>,
    }
}

/// Pseudo-accelerations of a motion \[m/s²\]; of two components, the largest over all directions
/// (RotD100).
///
/// # Errors
/// Damping outside 0 ≤ ζ < 1, a negative period, components that are not a pair.
pub fn largest_psa_m_s2(
    motion: &HorizontalMotion,
    damping_ratio: f64,
    periods_s: &[f64],
) -> Result<Vec<f64>, RotateError> {
    match &motion.across {
        None => Ok(response_spectrum(&motion.along, damping_ratio, periods_s)?.psa_m_s2),
        Some(across) => {
            let pair = Pair::new(&motion.along, across)?;
            Ok(
                directional_spectrum(&pair, damping_ratio, periods_s, &[100.0])?
                    .rotd_m_s2
                    .swap_remove(0),
            )
        }
    }
}

/// Pseudo-accelerations of one floor, `[damping][period]` \[g\].
pub(super) fn of_floor(
    floor: &HorizontalMotion,
    request: &SpectraRequest,
) -> Result<Vec<Vec<f64>>, Problem> {
    let refused =
        |error: String| Problem::value(error, "damping from 0 to below 1, periods of 0 or more");
    let one = |&damping_ratio: &f64| -> Result<Vec<f64>, Problem> {
        let psa_m_s2 = largest_psa_m_s2(floor, damping_ratio, &request.periods_s)
            .map_err(|error| refused(error.to_string()))?;
        Ok(psa_m_s2.iter().map(|a| a / G0_M_S2).collect())
    };
    // The first error in the order of the dampings, not in that of the threads.
    let all: Vec<Result<Vec<f64>, Problem>> = request.damping_ratios.par_iter().map(one).collect();
    all.into_iter().collect()
}

impl SpectraReport {
    /// Medians over the motions, whose spectra are `[motion][level][damping][period]`.
    pub fn new(
        levels_ratio: &[f64],
        request: &SpectraRequest,
        motions_g: &[Vec<Vec<Vec<f64>>>],
    ) -> Self {
        let at = |motion: &[Vec<Vec<f64>>], level: usize, damping: usize, period: usize| {
            motion
                .get(level)
                .and_then(|level| level.get(damping)?.get(period).copied())
        };
        let level = |(level, &level_ratio): (usize, &f64)| {
            let of = |quantile: f64| -> Vec<Vec<f64>> {
                let row = |damping: usize| {
                    let value = |period: usize| {
                        let mut values: Vec<f64> = motions_g
                            .iter()
                            .filter_map(|motion| at(motion, level, damping, period))
                            .collect();
                        ranked_quantile(&mut values, quantile)
                            .value()
                            .unwrap_or_default()
                    };
                    (0..request.periods_s.len()).map(value).collect()
                };
                (0..request.damping_ratios.len()).map(row).collect()
            };
            let several = motions_g.len() > 1;
            let [low, median, high] = QUANTILES;
            LevelSpectra {
                level_ratio,
                psa_g: of(median),
                psa_g_p16: if several { of(low) } else { Vec::new() },
                psa_g_p84: if several { of(high) } else { Vec::new() },
            }
        };
        Self {
            periods_s: request.periods_s.clone(),
            damping_ratios: request.damping_ratios.clone(),
            levels: levels_ratio.iter().enumerate().map(level).collect(),
        }
    }
}

/// The spectra as CSV, level by level and damping by damping.
///
/// # Errors
/// None in practice: see [`table`].
pub fn spectra_table(report: &SpectraReport) -> Result<Table, Problem> {
    let mut rows = Vec::new();
    for level in &report.levels {
        for (damping, &damping_ratio) in report.damping_ratios.iter().enumerate() {
            for (period, &period_s) in report.periods_s.iter().enumerate() {
                let at = |of: &[Vec<f64>]| of.get(damping).and_then(|row| row.get(period)).copied();
                let row = Facts::default()
                    .key("level_ratio", level.level_ratio)
                    .key("damping_ratio", damping_ratio)
                    .key("period_s", period_s);
                let row = row.key("psa_g", at(&level.psa_g).unwrap_or_default());
                rows.push(
                    row.key("psa_g_p16", at(&level.psa_g_p16))
                        .key("psa_g_p84", at(&level.psa_g_p84)),
                );
            }
        }
    }
    table(rows)
}
