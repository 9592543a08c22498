//! Probabilities per year, from worlds at several intensities.

use freestand::decision::{Level, annual_rate, hazard_per_year, level_below};

use crate::result::PerYear;
use freestand_input::problem::Problems;

use super::Context;
use super::draw::Change;
use super::object::Model;
use super::response::Lived;
use super::trial::{Life, Question, Trial, answer, live_again};

/// Worlds at each intensity.
pub(super) const WORLDS: u32 = 160;

/// The intensities, relative to that of the study.
pub(super) const INTENSITIES: [f64; 5] = [
    0.5,
    std::f64::consts::FRAC_1_SQRT_2,
    1.0,
    std::f64::consts::SQRT_2,
    2.0,
];

/// k of the hazard s^−k: EN 1998-1, 2.1(4).
const HAZARD_EXPONENT: f64 = 3.0;

/// The return period where the spectrum has none: that of design spectra \[years\].
const RETURN_PERIOD_YEARS: f64 = 475.0;

/// What was found at each intensity, on falling and on shock.
#[derive(Default)]
struct Levels {
    falls: Vec<Level>,
    exceeds: Vec<Level>,
}

/// For each trial; `None` where it is not asked. At each intensity all trials live together, so that
/// the floors of a world are calculated once.
pub(super) fn per_year(
    context: &Context,
    trials: &[Trial],
) -> Result<Vec<Option<PerYear>>, Problems> {
    if !context.study.assessment.is_annual {
        return Ok(trials.iter().map(|_| None).collect());
    }
    let mut levels: Vec<Levels> = trials.iter().map(|_| Levels::default()).collect();
    let all: Vec<usize> = (0..trials.len()).collect();
    for intensity_ratio in INTENSITIES {
        shake(context, trials, &all, intensity_ratio, &mut levels)?;
    }
    // The intensity below is the same for all that need one: it follows from the lowest so far.
    loop {
        let hazard = |s| hazard_per_year(s, HAZARD_EXPONENT, return_period_years(context));
        let below = |place: &usize| {
            let Levels { falls, exceeds } = &levels[*place];
            level_below(exceeds, hazard).or_else(|| level_below(falls, hazard))
        };
        let open: Vec<usize> = all
            .iter()
            .copied()
            .filter(|place| below(place).is_some())
            .collect();
        let Some(intensity_ratio) = open.iter().find_map(below) else {
            break;
        };
        let lowest: Vec<usize> = open
            .into_iter()
            .filter(|place| below(place) == Some(intensity_ratio))
            .collect();
        shake(context, trials, &lowest, intensity_ratio, &mut levels)?;
    }
    Ok(trials
        .iter()
        .zip(levels)
        .map(|(trial, levels)| rates(context, trial, levels))
        .collect())
}

fn shake(
    context: &Context,
    trials: &[Trial],
    places: &[usize],
    intensity_ratio: f64,
    levels: &mut [Levels],
) -> Result<(), Problems> {
    context.go_on()?;
    let shaken = context.at_intensity(intensity_ratio);
    let chosen: Vec<&Trial> = places.iter().map(|&place| &trials[place]).collect();
    let lives = chosen.iter().map(|&trial| Life {
        trial,
        worlds: WORLDS,
        change: Change::None,
    });
    let lives: Vec<Life> = lives.collect();
    let mut lived: Vec<Vec<Lived>> = lives.iter().map(|_| Vec::new()).collect();
    live_again(&shaken, &lives, |place, more| lived[place].extend(more))?;
    context.count(usize::try_from(shaken.histories()).unwrap_or(0));
    for ((&place, trial), lived) in places.iter().zip(chosen).zip(&lived) {
        let level = |question| {
            let by_model = trial.models(context).map(|model: Model| {
                let yes =
                    |one: &&Lived| answer(&trial.subject, one, question, model) == Some(Some(true));
                lived.iter().filter(yes).count() as f64 / f64::from(WORLDS)
            });
            Level {
                intensity_ratio,
                probability: by_model.fold(0.0, f64::max),
            }
        };
        levels[place].falls.push(level(Question::Falls));
        levels[place].exceeds.push(level(Question::Shock));
    }
    Ok(())
}

fn return_period_years(context: &Context) -> f64 {
    let target = context.study.ground.code_spectrum();
    target
        .and_then(|target| target.return_period_years())
        .map_or(RETURN_PERIOD_YEARS, f64::from)
}

fn rates(context: &Context, trial: &Trial, levels: Levels) -> Option<PerYear> {
    let years = return_period_years(context);
    let rate = |mut levels: Vec<Level>| {
        levels.sort_by(|a, b| a.intensity_ratio.total_cmp(&b.intensity_ratio));
        annual_rate(&levels, |s| hazard_per_year(s, HAZARD_EXPONENT, years)).ok()
    };
    let (falls, exceeds) = (rate(levels.falls)?, rate(levels.exceeds)?);
    Some(PerYear {
        overturn: falls.probability_per_year,
        exceed: trial
            .is_open(Question::Shock)
            .then_some(exceeds.probability_per_year),
        is_at_least: falls.is_at_least || exceeds.is_at_least,
    })
}

impl<'a> Context<'a> {
    /// The same worlds at another intensity.
    pub(super) fn at_intensity(&self, ratio: f64) -> Context<'a> {
        Context {
            wants_shares: false,
            ..self.in_worlds(self.worlds.at_intensity(ratio))
        }
    }
}
