//! Probabilities per year, from worlds at several intensities.

use freestand::decision::{Level, annual_rate, hazard_per_year, level_below};

use crate::result::PerYear;
use freestand_input::problem::Problems;

use super::Context;
use super::draw::Change;
use super::trial::{Model, Question, Trial, answer, lived_in};

/// Worlds at each intensity.
const WORLDS: u32 = 160;

/// The intensities, relative to that of the study.
const INTENSITIES: [f64; 5] = [0.5, std::f64::consts::FRAC_1_SQRT_2, 1.0, std::f64::consts::SQRT_2, 2.0];

/// k of the hazard s^−k: EN 1998-1, 2.1(4).
const HAZARD_EXPONENT: f64 = 3.0;

/// The return period where the spectrum has none: that of design spectra \[years\].
const RETURN_PERIOD_YEARS: f64 = 475.0;

/// For each trial; `None` where it is not asked.
pub(super) fn per_year(context: &Context, trials: &[Trial]) -> Result<Vec<Option<PerYear>>, Problems> {
    if !context.study.assessment.is_annual {
        return Ok(trials.iter().map(|_| None).collect());
    }
    trials.iter().map(|trial| of_trial(context, trial)).collect()
}

fn of_trial(context: &Context, trial: &Trial) -> Result<Option<PerYear>, Problems> {
    let mut falls: Vec<Level> = Vec::new();
    let mut exceeds: Vec<Level> = Vec::new();
    let mut next: Vec<f64> = INTENSITIES.into_iter().rev().collect();
    while let Some(intensity_ratio) = next.pop() {
        context.go_on()?;
        let shaken = context.at_intensity(intensity_ratio);
        let lived = lived_in(&shaken, 0..WORLDS, &[trial], Change::None)?;
        context.count(usize::try_from(shaken.histories()).unwrap_or(0));
        let share = |question| {
            let by_model = trial.models(context).map(|model: Model| {
                let yes =
                    |one: &&super::response::Lived| answer(&trial.subject, one, question, model) == Some(Some(true));
                lived.iter().flatten().filter(yes).count() as f64 / f64::from(WORLDS)
            });
            by_model.fold(0.0, f64::max)
        };
        falls.push(Level { intensity_ratio, probability: share(Question::Falls) });
        exceeds.push(Level { intensity_ratio, probability: share(Question::Shock) });
        if next.is_empty() {
            next.extend(level_below(&exceeds));
        }
    }
    let target = context.study.ground.code_spectrum();
    let years = target.and_then(|target| target.spectrum.return_period_years()).map_or(RETURN_PERIOD_YEARS, f64::from);
    let rate = |mut levels: Vec<Level>| {
        levels.sort_by(|a, b| a.intensity_ratio.total_cmp(&b.intensity_ratio));
        annual_rate(&levels, |s| hazard_per_year(s, HAZARD_EXPONENT, years)).ok()
    };
    let (Some(falls), Some(exceeds)) = (rate(falls), rate(exceeds)) else { return Ok(None) };
    Ok(Some(PerYear {
        overturn: falls.probability_per_year,
        exceed: trial.is_open(Question::Shock).then_some(exceeds.probability_per_year),
        is_at_least: falls.is_at_least || exceeds.is_at_least,
    }))
}

impl<'a> Context<'a> {
    /// The same worlds at another intensity.
    fn at_intensity(&self, ratio: f64) -> Context<'a> {
        Context {
            study: self.study,
            worlds: self.worlds.at_intensity(ratio),
            wants_shares: false,
            wants_to_stop: self.wants_to_stop,
            histories: Default::default(),
        }
    }
}
