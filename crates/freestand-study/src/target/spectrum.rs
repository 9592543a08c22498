//! The spectrum of a code at given periods, and its accelerations of parts on floors: request → report.

use std::iter::once;

use freestand::code_spectrum::CodeSpectrum;
use freestand::code_spectrum::parts::{PartsQuestion, clause, floor_acceleration_g};
use freestand::synthesis::matched_periods_s;
use freestand_input::problem::{Problem, Problems};
use freestand_output::answer;
use freestand_output::rows::table_of_columns;
use freestand_output::table::Table;

use super::Target;

/// Accelerations of a rigid part on each level by a code.
#[derive(Debug, Clone, PartialEq)]
pub struct CodeParts {
    /// The clause and its formula.
    pub clause: &'static str,
    /// Accelerations, one for each level \[g\].
    pub accel_g: Vec<f64>,
}

/// Accelerations of rigid parts by a code; of a building with two axes, `building_period_s` is the
/// shorter period. `None` for a spectrum that is not from a code, or without a height that it needs.
pub fn code_parts(
    code: &CodeSpectrum,
    building_height_m: Option<f64>,
    building_period_s: Option<f64>,
    levels_ratio: &[f64],
) -> Option<CodeParts> {
    let part = |&level_ratio: &f64| {
        floor_acceleration_g(
            code,
            &PartsQuestion {
                level_ratio,
                building_height_m,
                building_period_s,
            },
        )
    };
    let accel_g = levels_ratio
        .iter()
        .map(part)
        .collect::<Option<Vec<f64>>>()?;
    Some(CodeParts {
        clause: clause(code)?,
        accel_g,
    })
}

/// A spectrum at its periods.
#[derive(Debug, Clone, PartialEq)]
#[expect(
    missing_docs,
    reason = "the names are those of the JSON document and state the units"
)]
pub struct CodeSpectrumReport {
    /// The code with its parameters.
    pub target: Target,
    pub corner_periods_s: Vec<f64>,
    pub periods_s: Vec<f64>,
    pub sa_g: Vec<f64>,
    /// Given by Eurocode 8 only.
    pub vertical_sa_g: Option<Vec<f64>>,
    pub parts: Option<PartsReport>,
    /// The values at the corners \[g\].
    pub corners_g: Vec<f64>,
}

answer! {
    /// Accelerations of rigid parts over the height of a building.
    pub struct PartsReport named {
        clause: &'static str,
        building_height_m: Option<f64>,
        building_period_s: Option<f64>,
        levels: Vec<PartsLevel>,
    }
}

answer! {
    /// The acceleration of a rigid part on one level.
    pub struct PartsLevel named {
        level_ratio: f64,
        height_m: Option<f64>,
        floor_acceleration_g: f64,
    }
}

/// The periods of a spectrum if none are given: 0 and those at which motions are matched.
pub fn usual_periods_s() -> Vec<f64> {
    once(0.0).chain(matched_periods_s()).collect()
}

/// A spectrum at the given periods, or at the usual ones and its corners. With `parts`, the height
/// and the period of a building as far as they are known, also the accelerations of parts at eleven
/// levels.
///
/// # Errors
/// Periods outside the spectrum; parts of a spectrum that has no clause, or without the height of
/// the building that it needs.
pub fn code_spectrum(
    target: &Target,
    periods_s: Option<Vec<f64>>,
    parts: Option<(Option<f64>, Option<f64>)>,
) -> Result<CodeSpectrumReport, Problems> {
    let mut problems = Problems::default();
    let spectrum = &target.spectrum;
    let (from_s, to_s) = (
        spectrum.shortest_period_s(),
        spectrum.longest_period_s().unwrap_or(f64::INFINITY),
    );
    let is_covered = |period_s: &f64| (from_s..=to_s).contains(period_s);
    if let Some(negative) = periods_s.iter().flatten().find(|&&period_s| period_s < 0.0) {
        let message = format!("`periods`: a period of {negative} s is negative");
        problems.push(Problem::value(message, "give periods of 0 s or more"));
    } else if let Some(outside) = periods_s
        .iter()
        .flatten()
        .find(|period_s| !is_covered(period_s))
    {
        let message = format!(
            "`periods`: {outside} s is outside the table, which covers {from_s} s to {to_s} s"
        );
        let hint = "`beyond = \"hold\"` extends the table: constant Sa below it, constant displacement above it";
        problems.push(Problem::value(message, hint));
    }
    let parts = parts
        .and_then(|(height_m, period_s)| problems.keep(parts_of(spectrum, height_m, period_s)));
    let periods_s = periods_s.unwrap_or_else(|| {
        let usual_s = usual_periods_s();
        let last_s = usual_s.last().copied().unwrap_or(0.0);
        let corners_s = spectrum
            .corner_periods_s()
            .into_iter()
            .filter(|&corner_s| corner_s <= last_s);
        let mut all_s: Vec<f64> = usual_s
            .iter()
            .copied()
            .chain(corners_s)
            .filter(is_covered)
            .collect();
        all_s.sort_by(f64::total_cmp);
        all_s.dedup();
        all_s
    });
    let corner_periods_s = match spectrum {
        CodeSpectrum::Table(_) => Vec::new(),
        _ => spectrum.corner_periods_s(),
    };
    let at = |periods_s: &[f64]| {
        periods_s
            .iter()
            .map(|&period_s| spectrum.sa_g(period_s))
            .collect()
    };
    problems.finish(Some(CodeSpectrumReport {
        target: target.clone(),
        corners_g: at(&corner_periods_s),
        corner_periods_s,
        sa_g: at(&periods_s),
        vertical_sa_g: match spectrum {
            CodeSpectrum::Eurocode8(code) => Some(
                periods_s
                    .iter()
                    .map(|&period_s| code.vertical_sa_g(period_s))
                    .collect(),
            ),
            _ => None,
        },
        periods_s,
        parts,
    }))
}

fn parts_of(
    spectrum: &CodeSpectrum,
    building_height_m: Option<f64>,
    building_period_s: Option<f64>,
) -> Result<PartsReport, Problem> {
    let Some(clause) = clause(spectrum) else {
        return Err(Problem::value(
            "`parts`: a table has no clause for parts",
            "name a code with `code`",
        ));
    };
    let levels_ratio: [f64; 11] = std::array::from_fn(|tenth| tenth as f64 / 10.0);
    let Some(parts) = code_parts(
        spectrum,
        building_height_m,
        building_period_s,
        &levels_ratio,
    ) else {
        let message = format!("`parts` needs `building_height` ({clause})");
        return Err(Problem::value(
            message,
            "write `building_height = \"30 m\"`",
        ));
    };
    let level = |(level_ratio, floor_acceleration_g)| PartsLevel {
        level_ratio,
        height_m: building_height_m.map(|height_m| level_ratio * height_m),
        floor_acceleration_g,
    };
    let levels = levels_ratio
        .into_iter()
        .zip(parts.accel_g)
        .map(level)
        .collect();
    Ok(PartsReport {
        clause,
        building_height_m,
        building_period_s,
        levels,
    })
}

impl CodeSpectrumReport {
    /// `spectrum.csv`.
    ///
    /// # Errors
    /// The error of the CSV library.
    pub fn table(&self) -> Result<Table, Problem> {
        let mut columns: Vec<(&str, &[f64])> =
            vec![("period_s", &self.periods_s), ("sa_g", &self.sa_g)];
        columns.extend(
            self.vertical_sa_g
                .as_deref()
                .map(|vertical| ("vertical_sa_g", vertical)),
        );
        table_of_columns(&columns)
    }
}
