//! Losses of all objects together under common motions.

use std::collections::BTreeMap;

use freestand::decision::strip_rates;
use freestand::fragility::{LimitState, OutcomeClass};
use freestand::risk::{
    LossPoint, LossShares, World, expected_loss_per_year, independent_loss_exceedance, loss_at_return_period,
    loss_exceedance,
};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::{counted, number};
use freestand_output::facts::Facts;

use crate::fragility::{At, FragilityReport};

use super::costs::{CostRow, Costs};
use super::hazard::MeasuredHazard;
use super::least;
use super::objects::ObjectRisk;

/// The return periods whose losses are stated \[years\].
const RETURN_PERIODS: [f64; 5] = [100.0, 250.0, 500.0, 1000.0, 2500.0];
/// If a larger share of the worlds of the lowest intensity has a loss, lower intensities are
/// missing.
const SMALL: f64 = 0.02;
/// If a larger share of the outcomes under pairs of motion and intensity is missing, the runs are
/// not stripes.
const NO_STRIPES: f64 = 0.5;

/// The losses of all objects.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Portfolio {
    worlds: usize,
    expected_annual_loss: f64,
    pub(super) curve: Vec<LossPoint>,
    pub(super) independent: Vec<LossPoint>,
    pub(super) is_at_least: bool,
}

/// The number of a motion and the number of an intensity.
type Pair = (usize, usize);

pub(crate) fn portfolio(
    report: &FragilityReport,
    costs: &Costs,
    objects: &[ObjectRisk],
    hazard: &MeasuredHazard,
    warnings: &mut Vec<String>,
) -> Result<Option<Portfolio>, Problem> {
    let table = &report.table;
    let priced: Vec<(usize, &CostRow)> = table
        .objects
        .iter()
        .enumerate()
        .filter_map(|(i, id)| Some((i, costs.rows.iter().find(|row| &row.id == id && row.has_costs())?)))
        .collect();
    let is_needed = |object: usize| priced.iter().any(|(needed, _)| *needed == object);
    let mut levels: Vec<f64> =
        table.runs.iter().filter(|run| is_needed(run.object)).map(|run| run.run.intensity).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let motions = table.motions.len();
    if priced.is_empty() || motions == 0 || levels.len() < 2 {
        return Ok(None);
    }
    if hazard.at != At::Ground {
        warnings.push(
            "the losses of all objects together were not calculated: they need a measure of the ground, which all \
             objects share"
                .to_owned(),
        );
        return Ok(None);
    }
    let mut worlds: BTreeMap<Pair, Vec<Option<OutcomeClass>>> = BTreeMap::new();
    for run in &table.runs {
        let Some(place) = priced.iter().position(|(object, _)| *object == run.object) else { continue };
        let level = levels.partition_point(|level| *level < run.run.intensity);
        let world = worlds.entry((run.run.motion.unwrap_or(0), level)).or_insert_with(|| vec![None; priced.len()]);
        world[place] = Some(run.run.class);
    }
    let wanted = motions * levels.len();
    let known: usize = worlds.values().map(|classes| classes.iter().flatten().count()).sum();
    if (known as f64) < (1.0 - NO_STRIPES) * (wanted * priced.len()) as f64 {
        warnings.push(
            "the motions were not all scaled to the same intensities, so there are no worlds that all objects share: the \
             losses of all objects together were not calculated"
                .to_owned(),
        );
        return Ok(None);
    }
    for motion in 0..motions {
        for (level, intensity) in levels.iter().enumerate() {
            let classes = worlds.get(&(motion, level));
            for (place, (object, _)) in priced.iter().enumerate() {
                if classes.and_then(|classes| classes.get(place).copied().flatten()).is_none() {
                    let name = |names: &[String], i: usize| names.get(i).cloned().unwrap_or_default();
                    let message = format!(
                        "object {} has no outcome under motion {} at {}",
                        name(&table.objects, *object),
                        name(&table.motions, motion),
                        table.measure.value_words(*intensity)
                    );
                    let hint =
                        "add this run: the losses of all objects need each object under each motion at each intensity";
                    return Err(Problem::value(message, hint).in_file(&table.file.path));
                }
            }
        }
    }
    let strips = strip_rates(&levels, |x| hazard.hazard.annual_rate(x)).map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string()).hint("give intensities that the hazard curve covers")
    })?;
    let loss = |classes: &[Option<OutcomeClass>]| -> f64 {
        let one = |(class, (_, cost)): (&Option<OutcomeClass>, &(usize, &CostRow))| match class {
            Some(OutcomeClass::Overturned) => cost.quantity * cost.overturned(),
            Some(OutcomeClass::Exceeded) => cost.quantity * cost.repair.unwrap_or(0.0),
            _ => 0.0,
        };
        classes.iter().zip(&priced).map(one).sum()
    };
    let all: Vec<World> = worlds
        .iter()
        .map(|((_, level), classes)| World { annual_rate: strips[*level] / motions as f64, loss: loss(classes) })
        .collect();
    // Intensities below the first point of the hazard curve are not counted.
    let lowest = strips.iter().position(|strip| *strip > 0.0).unwrap_or(0);
    let failing = worlds
        .iter()
        .filter(|((_, level), classes)| {
            *level == lowest && classes.iter().flatten().any(|class| *class > OutcomeClass::Rocked)
        })
        .count();
    let is_at_least = failing as f64 > SMALL * motions as f64;
    if is_at_least {
        warnings.push(format!(
            "at the lowest intensity that is counted, {}, an object fails in {} of {}: weaker motions cause losses too, \
             so the losses of all objects are at least those stated; add lower intensities to the outcomes, and to \
             the hazard curve if it begins there",
            levels.get(lowest).map_or(String::new(), |level| table.measure.value_words(*level)),
            failing,
            counted(motions, "motion")
        ));
    }
    let curve = loss_exceedance(&all);
    let losses: Vec<f64> = curve.iter().map(|point| point.loss).collect();
    let independent: Vec<(f64, Vec<LossShares>)> = levels
        .iter()
        .zip(&strips)
        .map(|(level, strip)| {
            let of = |(_, cost): &(usize, &CostRow)| {
                let object = objects.iter().find(|one| one.id == cost.id)?;
                Some(shares(object, cost, *level))
            };
            (*strip, priced.iter().filter_map(of).collect())
        })
        .collect();
    Ok(Some(Portfolio {
        worlds: all.len(),
        expected_annual_loss: expected_loss_per_year(&all),
        independent: independent_loss_exceedance(&independent, &losses),
        curve,
        is_at_least,
    }))
}

/// The losses of one object at a level, by its curves.
fn shares(object: &ObjectRisk, cost: &CostRow, level: f64) -> LossShares {
    let p = |state: LimitState| object.curves.curve(state).and_then(|kind| kind.probability(level));
    let overturns = p(LimitState::Overturns).unwrap_or(0.0);
    let exceeds = p(LimitState::Exceeds).unwrap_or(overturns).max(overturns);
    vec![
        (0.0, 1.0 - exceeds),
        (cost.quantity * cost.repair.unwrap_or(0.0), exceeds - overturns),
        (cost.quantity * cost.overturned(), overturns),
    ]
}

impl Portfolio {
    pub(crate) fn facts(&self, currency: Option<&str>) -> Facts<'static> {
        let points = |curve: &[LossPoint]| -> Vec<Facts<'static>> {
            let point =
                |point: &LossPoint| Facts::default().key("loss", point.loss).key("annual_rate", point.annual_rate);
            curve.iter().map(point).collect()
        };
        let periods: Vec<Facts> = RETURN_PERIODS
            .iter()
            .map(|&years| Facts::default().key("years", years).key("loss", loss_at_return_period(&self.curve, years)))
            .collect();
        Facts::default()
            .key("currency", currency.map(str::to_owned))
            .key("worlds", self.worlds)
            .key("expected_annual_loss", self.expected_annual_loss)
            .key("is_at_least", self.is_at_least)
            .key("loss_at_return_period", periods)
            .key("loss_exceedance", points(&self.curve))
            .key("independent_loss_exceedance", points(&self.independent))
    }

    pub(crate) fn text(&self, currency: &str) -> String {
        let least = least(self.is_at_least);
        let mut text = format!(
            "All objects under common motions ({}): {least}{} {currency} a year\n",
            counted(self.worlds, "world"),
            number(self.expected_annual_loss, 4)
        );
        for years in RETURN_PERIODS {
            let loss = loss_at_return_period(&self.curve, years);
            text += &format!("  once in {years} years: {least}{} {currency}\n", number(loss, 4));
        }
        text
    }
}
