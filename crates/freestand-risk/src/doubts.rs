//! What does not fit together, what was used because nobody stated it, and what the hazard leaves open, as data:
//! `freestand-report` has the words.

use std::collections::HashSet;
use std::path::Path;

use freestand::fragility::FitKind;
use freestand::risk::{Gap, Hazard};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::shortest;
use strum::EnumCount;

use crate::costs::{CostDoubt, Costs, OptionRow};
use crate::fragility::{
    At, CurveDoubt, DEFAULT_REPLICATES, HazardDoubt, Measure, MeasuredHazard, ObjectCurves,
};
use crate::objects::{ObjectRisk, StateRisk, Unjudged};
use crate::rates::{Levels, Open};
use crate::request::{DEFAULT_YEARS, RiskCurves, RiskRequest};

/// No motion is more frequent than this: a larger rate is a mistake, and the loss that follows from it
/// may be infinite \[1/year\].
const MAX_ANNUAL_RATE: f64 = 1e12;

/// If a larger share of a rate is above the last point of the hazard, that is said.
const BEYOND: f64 = 0.1;

/// What to know beside rates and losses. Objects are named by their ids, intensities are those of the
/// measure of the hazard.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum RiskDoubt {
    /// Of the fragilities.
    Curves(Vec<CurveDoubt>),
    /// Of the hazard.
    Hazard(HazardDoubt),
    /// Of costs and options.
    Cost(CostDoubt),
    /// The hazard curve begins above intensities at which objects reach limit states.
    BeginsTooHigh {
        /// Its first intensity.
        first: f64,
        /// The objects.
        ids: Vec<String>,
    },
    /// Much of a rate is above the last point of the hazard curve, where its last segment goes on.
    EndsTooLow {
        /// Its last intensity.
        last: f64,
        /// The share of a rate of the first object.
        share: f64,
        /// The objects.
        ids: Vec<String>,
    },
    /// More than a tenth of a rate is where there are no runs.
    NotResolved {
        /// Where, of the first object.
        gap: Gap,
        /// The objects.
        ids: Vec<String>,
    },
    /// These intensities would tell such rates if nothing unexpected happens between those of the runs.
    WouldTell {
        /// The lowest.
        from: f64,
        /// The highest.
        to: f64,
        /// How many.
        count: usize,
    },
    /// Objects without a row in the inventory.
    WithoutCosts(Vec<String>),
    /// Objects of the inventory without a fragility.
    WithoutFragility(Vec<String>),
    /// An accepted rate was not compared with anything.
    Unjudged {
        /// Why, of the first object.
        why: Unjudged,
        /// The objects.
        ids: Vec<String>,
    },
    /// The worth of options is not known.
    UnknownWorth(OpenOptions),
    /// How many falls options avoid is not known.
    UnknownFalls(OpenOptions),
    /// The losses of all objects together were not calculated.
    NoPortfolio(NoPortfolio),
    /// Worlds with a run that could not be calculated do not count for the losses of all objects.
    WorldsLeftOut {
        /// How many.
        left_out: usize,
        /// Of how many.
        worlds: usize,
    },
    /// Something fails at the lowest intensity that counts.
    FailsAtLowest {
        /// That intensity.
        lowest: f64,
        /// Motions under which something fails.
        failing: usize,
        /// All motions at that intensity.
        motions: usize,
    },
    /// Objects without a curve count with the least that their outcomes allow if all fail independently.
    LeastAlone(Vec<String>),
}

/// Options of which something is not known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OpenOptions {
    /// The name of the first.
    pub option: String,
    /// Its object.
    pub id: String,
    /// How many others there are.
    pub more: usize,
}

/// Why the losses of all objects together were not calculated.
#[derive(Debug, Clone, Copy, PartialEq, EnumCount)]
pub enum NoPortfolio {
    /// The hazard is that of a floor.
    OfFloor,
    /// The outcomes are counts.
    Counts,
    /// The outcomes have a single intensity.
    OneIntensity,
    /// The motions were not scaled to the same intensities.
    NoStripes,
    /// At this intensity every motion has a run that could not be calculated.
    NotCalculated(f64),
}

/// What was used because nobody stated it.
#[derive(Debug, Clone, Copy, PartialEq, EnumCount)]
pub enum RiskAssumption {
    /// The years of stated chances.
    Years(f64),
    /// The limit states of an object are fitted with one dispersion.
    OneDispersion,
    /// How many samples of motions there are.
    Replicates(u32),
    /// Where the measure of the hazard is taken.
    Place,
    /// Above its last point the hazard goes on.
    HazardGoesOn,
    /// No rate is accepted.
    NothingAccepted,
    /// So many objects have no quantity.
    OneOfEach(usize),
    /// So many options have no life.
    PaidOnce(usize),
}

/// What was used because nobody stated it.
pub(crate) fn assumed(
    request: &RiskRequest,
    hazard: &MeasuredHazard,
    objects: &[ObjectRisk],
    options: Option<&[OptionRow]>,
) -> Vec<RiskAssumption> {
    let fits = match &request.curves {
        RiskCurves::Outcomes(fits) => Some(fits),
        RiskCurves::File(_) => None,
    };
    let is_ordered = fits.is_some_and(|fits| fits.fit == FitKind::Ordered);
    let has_samples = fits.is_some_and(|fits| fits.replicates.is_none());
    let is_placed = hazard.measure.place().is_some() || request.hazard_at.is_some();
    let has_end = matches!(hazard.hazard, Hazard::Points(_));
    let accepts = |one: &ObjectRisk| one.accepted_rate.or(one.accepted_exceed_rate).is_some();
    let costs = objects.iter().filter_map(|one| one.cost.as_ref());
    let without_quantity = costs.filter(|cost| !cost.has_quantity).count();
    let options = options.into_iter().flatten();
    let without_life = options.filter(|row| row.life_years.is_none()).count();
    let all = [
        (
            request.years.is_none(),
            RiskAssumption::Years(DEFAULT_YEARS),
        ),
        (is_ordered, RiskAssumption::OneDispersion),
        (has_samples, RiskAssumption::Replicates(DEFAULT_REPLICATES)),
        (!is_placed, RiskAssumption::Place),
        (has_end, RiskAssumption::HazardGoesOn),
        (
            !objects.iter().any(accepts),
            RiskAssumption::NothingAccepted,
        ),
        (
            without_quantity > 0,
            RiskAssumption::OneOfEach(without_quantity),
        ),
        (without_life > 0, RiskAssumption::PaidOnce(without_life)),
    ];
    let all = all.into_iter().filter(|(is_so, _)| *is_so);
    all.map(|(_, assumed)| assumed).collect()
}

/// A hazard says how often motions of its own measure happen, and nothing about another one. `line` is
/// that of the curves in their file.
pub(crate) fn check_measure(
    hazard: &MeasuredHazard,
    curves: &ObjectCurves,
    path: &Path,
    line: Option<usize>,
) -> Result<(), Problem> {
    if curves.measure == hazard.measure && curves.at == hazard.at {
        return Ok(());
    }
    let named = |measure: Measure, at: At| format!("{} of the {}", measure.name(), at.name());
    let message = format!(
        "the hazard is that of {}, and the fragility of {} is against {}",
        named(hazard.measure, hazard.at),
        shorten(&curves.id),
        named(curves.measure, curves.at)
    );
    let hint = "give the hazard of that measure at that place, or fit the outcomes against the measure of the hazard";
    let problem = Problem::value(message, hint).in_file(path);
    Err(line.map_or(problem.clone(), |line| problem.at_line(line)))
}

/// Refuses rates and losses that are implausibly large.
pub(crate) fn check_finite(
    request: &RiskRequest,
    hazard: &MeasuredHazard,
    objects: &[ObjectRisk],
) -> Result<(), Problem> {
    let is_fine = |rate: Option<f64>| rate.is_none_or(|rate| rate < MAX_ANNUAL_RATE);
    for object in objects {
        let id = shorten(&object.id);
        if !object
            .states
            .iter()
            .all(|one| is_fine(one.rates.annual_rate) && is_fine(one.rates.annual_rate_upper))
        {
            let limit = shortest(MAX_ANNUAL_RATE);
            return Err(match &hazard.hazard {
                Hazard::PowerLaw { rate, exponent, .. } => {
                    let (k0, k) = (shortest(*rate), shortest(*exponent));
                    let message = format!(
                        "the annual rate of {id} is above {limit} a year, with k0 = {k0} /yr and k = {k}"
                    );
                    let hint = "correct k0, k or the reference: k0 is how often a year motions reach the reference";
                    Problem::value(message, hint).of(&["hazard_power"])
                }
                Hazard::Points(_) => {
                    let message = format!("the annual rate of {id} is above {limit} a year");
                    let problem = Problem::value(message, "correct the rates of the hazard curve");
                    hazard
                        .file
                        .iter()
                        .fold(problem, |problem, file| problem.in_file(&file.path))
                }
            });
        }
        if !object.expected_annual_loss.is_none_or(f64::is_finite) {
            let message = format!("the loss a year of {id} is too large for a number");
            let problem = Problem::value(message, "correct its costs or its quantity");
            let problem = object
                .cost
                .iter()
                .fold(problem, |problem, cost| problem.at_line(cost.line));
            return Err(request
                .inventory
                .iter()
                .fold(problem, |problem, path| problem.in_file(path)));
        }
    }
    Ok(())
}

fn ids<'o>(objects: impl Iterator<Item = &'o ObjectRisk>) -> Vec<String> {
    objects.map(|one| one.id.clone()).collect()
}

/// Objects that reach limit states below the first point of the hazard curve.
pub(crate) fn begins_too_high(
    hazard: &MeasuredHazard,
    objects: &[ObjectRisk],
) -> Option<RiskDoubt> {
    let Hazard::Points(points) = &hazard.hazard else {
        return None;
    };
    let is_cut = |object: &&ObjectRisk| object.states.iter().any(|one| one.rates.begins_too_high());
    let ids = ids(objects.iter().filter(is_cut));
    let first = points.first().filter(|_| !ids.is_empty())?.intensity;
    Some(RiskDoubt::BeginsTooHigh { first, ids })
}

/// Objects with much of a rate above the last point of the hazard curve.
pub(crate) fn ends_too_low(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Option<RiskDoubt> {
    let Hazard::Points(points) = &hazard.hazard else {
        return None;
    };
    let share = |one: &StateRisk| {
        let rates = one.rates;
        rates
            .annual_rate
            .zip(rates.annual_rate_in_table)
            .filter(|all| all.0 > 0.0)
            .map_or(0.0, |all| 1.0 - all.1 / all.0)
    };
    let largest = |object: &ObjectRisk| object.states.iter().map(share).fold(0.0, f64::max);
    let mut cut = objects.iter().filter(|object| largest(object) > BEYOND);
    let (last, ids) = (points.last()?.intensity, ids(cut.clone()));
    let share = largest(cut.next()?);
    Some(RiskDoubt::EndsTooLow { last, share, ids })
}

/// Rates of which more than a tenth is between two intensities of the runs, or below or above all of them; at
/// last, which intensities would tell them.
pub(crate) fn not_resolved(objects: &[ObjectRisk]) -> Vec<RiskDoubt> {
    let kinds: [fn(Gap) -> bool; 3] = [
        |gap| matches!(gap, Gap::Below { .. }),
        |gap| matches!(gap, Gap::Between(..)),
        |gap| matches!(gap, Gap::Above(_)),
    ];
    let open = |object: &ObjectRisk| -> Vec<Open> {
        object.states.iter().filter_map(|one| one.open).collect()
    };
    let found = kinds.into_iter().filter_map(|is_kind| {
        let gap = |object: &&ObjectRisk| {
            let mut gaps = open(object).into_iter().filter_map(|one| one.gap);
            gaps.find(|gap| is_kind(*gap))
        };
        let ids = ids(objects.iter().filter(|object| gap(object).is_some()));
        let gap = objects.iter().find_map(|object| gap(&object))?;
        Some(RiskDoubt::NotResolved { gap, ids })
    });
    let mut found: Vec<RiskDoubt> = found.collect();
    // Also those that tell the other rates, so that none is lost.
    let levels = objects
        .iter()
        .flat_map(open)
        .filter_map(|one| one.levels)
        .reduce(Levels::with);
    let levels = levels.filter(|_| !found.is_empty());
    found.extend(levels.map(|levels| RiskDoubt::WouldTell {
        from: levels.from,
        to: levels.to,
        count: levels.count(),
    }));
    found
}

/// Objects of one list that the other does not have.
pub(crate) fn unmatched(costs: Option<&Costs>, curves: &[ObjectCurves]) -> Vec<RiskDoubt> {
    let Some(costs) = costs else {
        return Vec::new();
    };
    let priced: HashSet<&String> = costs.rows.iter().map(|row| &row.id).collect();
    let curved: HashSet<&String> = curves.iter().map(|one| &one.id).collect();
    let curves = curves.iter().map(|one| &one.id);
    let rows = costs.rows.iter().map(|row| &row.id);
    let without_costs: Vec<String> = curves.filter(|id| !priced.contains(id)).cloned().collect();
    let without_curves: Vec<String> = rows.filter(|id| !curved.contains(id)).cloned().collect();
    let some = |ids: Vec<String>| Some(ids).filter(|ids| !ids.is_empty());
    let without_costs = some(without_costs).map(RiskDoubt::WithoutCosts).into_iter();
    without_costs
        .chain(some(without_curves).map(RiskDoubt::WithoutFragility))
        .collect()
}

/// Objects whose accepted rates could not all be compared.
pub(crate) fn unjudged(objects: &[ObjectRisk]) -> Option<RiskDoubt> {
    let why = objects.iter().find_map(|one| one.why)?;
    let ids = ids(objects.iter().filter(|one| one.why.is_some()));
    Some(RiskDoubt::Unjudged { why, ids })
}
