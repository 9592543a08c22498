//! What does not fit together, what was used because nobody stated it, and what the hazard leaves open.

use std::collections::HashSet;
use std::path::Path;

use freestand::fragility::FitKind;
use freestand::risk::{Gap, Hazard};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, percent_significant, shortest};

use crate::costs::{Costs, OptionRow};
use crate::fragility::{At, DEFAULT_REPLICATES, Measure, MeasuredHazard, ObjectCurves};
use crate::objects::{ObjectRisk, StateRisk};
use crate::rates::{Levels, Open};
use crate::request::{DEFAULT_YEARS, RiskCurves, RiskRequest};
use crate::words::{is_or_are, rounded_value};

/// No motion is more frequent than this: a larger rate is a mistake, and the loss that follows from it
/// may be infinite \[1/year\].
const MAX_ANNUAL_RATE: f64 = 1e12;

/// If a larger share of a rate is above the last point of the hazard, that is said.
const BEYOND: f64 = 0.1;

/// What was used because nobody stated it, as one sentence; empty where all was stated.
pub(crate) fn assumed(
    request: &RiskRequest,
    hazard: &MeasuredHazard,
    objects: &[ObjectRisk],
    options: Option<&[OptionRow]>,
) -> Vec<String> {
    let mut all = Vec::new();
    if request.years.is_none() {
        all.push(format!(
            "chances are those in {} years",
            number(DEFAULT_YEARS, 4)
        ));
    }
    if let RiskCurves::Outcomes(fits) = &request.curves {
        if fits.fit == FitKind::Ordered {
            all.push("the limit states of an object are fitted with one dispersion".to_owned());
        }
        if fits.replicates.is_none() {
            all.push(format!(
                "intervals come from {DEFAULT_REPLICATES} samples of motions"
            ));
        }
    }
    if hazard.measure.place().is_none() && request.hazard_at.is_none() {
        all.push(format!(
            "{} is that of the {}",
            hazard.measure.name(),
            hazard.at.name()
        ));
    }
    if matches!(hazard.hazard, Hazard::Points(_)) {
        all.push("above its last point the hazard goes on as between the last two".to_owned());
    }
    if objects
        .iter()
        .all(|one| one.accepted_rate.is_none() && one.accepted_exceed_rate.is_none())
    {
        all.push("no rate is accepted, so that there is no verdict".to_owned());
    }
    let without_quantity = objects
        .iter()
        .filter(|one| one.cost.as_ref().is_some_and(|cost| !cost.has_quantity))
        .count();
    if without_quantity > 0 {
        all.push(format!(
            "{} without a quantity {} counted once",
            counted(without_quantity, "object"),
            is_or_are(without_quantity)
        ));
    }
    let without_life = options.map_or(0, |all| {
        all.iter().filter(|row| row.life_years.is_none()).count()
    });
    if without_life > 0 {
        all.push(format!(
            "{} without a life {} paid for once",
            counted(without_life, "option"),
            is_or_are(without_life)
        ));
    }
    if all.is_empty() {
        all
    } else {
        vec![format!(
            "Assumed, because nobody stated it: {}.",
            all.join("; ")
        )]
    }
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

/// A warning if the hazard curve begins above intensities at which objects reach limit states.
pub(crate) fn begins_too_high(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Option<String> {
    let Hazard::Points(points) = &hazard.hazard else {
        return None;
    };
    let is_cut = |object: &&ObjectRisk| object.states.iter().any(|one| one.rates.begins_too_high());
    let cut: Vec<&ObjectRisk> = objects.iter().filter(is_cut).collect();
    let (first, one) = (points.first()?, cut.first()?);
    let rest = if cut.len() > 1 {
        format!(" and {} more", cut.len() - 1)
    } else {
        String::new()
    };
    Some(format!(
        "the hazard curve begins at {}, but weaker motions also reach limit states of {}{rest}: their rates are at \
         least those stated; give a hazard curve that begins at a lower intensity",
        hazard.measure.value_words(first.intensity),
        shorten(&one.id)
    ))
}

/// A warning if much of a rate is above the last point of the hazard curve, where its last segment goes
/// on.
pub(crate) fn ends_too_low(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Option<String> {
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
    let cut: Vec<&ObjectRisk> = objects
        .iter()
        .filter(|object| largest(object) > BEYOND)
        .collect();
    let (last, one) = (points.last()?, cut.first()?);
    let rest = if cut.len() > 1 {
        format!(" and {} more", cut.len() - 1)
    } else {
        String::new()
    };
    Some(format!(
        "the hazard curve ends at {}, and stronger motions cause up to {} of a rate of {}{rest}: the slope of the last \
         two points was continued, and the upper bound of the rate is that of motions which are all as strong as any; \
         give a hazard curve up to stronger motions",
        hazard.measure.value_words(rounded_value(last.intensity)),
        percent_significant(largest(one), 2),
        shorten(&one.id)
    ))
}

/// Warnings about rates of which more than a tenth is between two intensities of the runs, or below or
/// above all of them; the last one says which intensities would tell them if
/// nothing unexpected happens between those of the runs.
pub(crate) fn not_resolved(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Vec<String> {
    let words = |x: f64| hazard.measure.value_words(rounded_value(x));
    let kinds: [fn(Gap) -> bool; 3] = [
        |gap| matches!(gap, Gap::Below { .. }),
        |gap| matches!(gap, Gap::Between(..)),
        |gap| matches!(gap, Gap::Above(_)),
    ];
    let open = |object: &'_ ObjectRisk| {
        object
            .states
            .iter()
            .filter_map(|one| one.open)
            .collect::<Vec<Open>>()
    };
    let said = kinds.into_iter().filter_map(|is_kind| {
        let gap = |object: &ObjectRisk| open(object).into_iter().filter_map(|one| one.gap).find(|gap| is_kind(*gap));
        let open: Vec<(&str, Gap)> =
            objects.iter().filter_map(|object| Some((object.id.as_str(), gap(object)?))).collect();
        let (id, gap) = *open.first()?;
        let rest = if open.len() > 1 { format!(" and {} more", open.len() - 1) } else { String::new() };
        let (place, remedy) = match gap {
            Gap::Below { lowest, .. } => {
                (format!("below {}, the lowest intensity of the runs", words(lowest)), "run lower intensities")
            }
            Gap::Between(a, b) => {
                (format!("between {} and {}, with no run between them", words(a), words(b)), "run intensities there")
            }
            Gap::Above(x) => {
                (format!("above {}, the highest intensity of the runs", words(x)), "run higher intensities")
            }
        };
        Some(format!(
            "more than a tenth of a rate of {}{rest} may be {place}: such rates are only known between bounds, and so \
             is what they cost; {remedy}",
            shorten(id)
        ))
    });
    let mut said: Vec<String> = said.collect();
    // Also those that tell the other rates, so that none is lost.
    let levels = objects
        .iter()
        .flat_map(open)
        .filter_map(|one| one.levels)
        .reduce(Levels::with);
    if let Some(levels) = levels.filter(|_| !said.is_empty()) {
        // A little outwards, so that rounding leaves out none.
        let (from, to) = (words(0.999 * levels.from), words(1.001 * levels.to));
        said.push(format!(
            "runs at these intensities would probably tell these rates: `scales = \"{from}:{to}:{}\"`",
            levels.count()
        ));
    }
    said
}

/// Objects of one list that the other does not have.
pub(crate) fn unmatched(costs: Option<&Costs>, curves: &[ObjectCurves]) -> Vec<String> {
    let Some(costs) = costs else {
        return Vec::new();
    };
    let listed = |ids: Vec<&str>, what: &str| {
        let first = ids.first()?;
        let rest = if ids.len() > 1 {
            format!(" and {} more", ids.len() - 1)
        } else {
            String::new()
        };
        Some(format!(
            "{} {what}: {first}{rest}",
            counted(ids.len(), "object")
        ))
    };
    let priced: HashSet<&str> = costs.rows.iter().map(|row| row.id.as_str()).collect();
    let curved: HashSet<&str> = curves.iter().map(|one| one.id.as_str()).collect();
    let without_costs = curves
        .iter()
        .filter(|one| !priced.contains(one.id.as_str()));
    let without_curves = costs
        .rows
        .iter()
        .filter(|row| !curved.contains(row.id.as_str()));
    [
        listed(
            without_costs.map(|one| one.id.as_str()).collect(),
            "without a row in the inventory",
        ),
        listed(
            without_curves.map(|row| row.id.as_str()).collect(),
            "of the inventory without a fragility",
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Objects whose accepted rates could not all be compared, with the first reason.
pub(crate) fn unjudged(objects: &[ObjectRisk]) -> Option<String> {
    let open: Vec<(&str, &str)> = objects
        .iter()
        .filter_map(|one| Some((one.id.as_str(), one.why?)))
        .collect();
    let (id, why) = open.first()?;
    let rest = if open.len() > 1 {
        format!(" and {} more", open.len() - 1)
    } else {
        String::new()
    };
    Some(format!(
        "{}{rest}: an accepted rate was not compared with anything: {why}",
        shorten(id)
    ))
}
