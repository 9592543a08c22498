//! How often objects fail, what that costs, and which options are worth their money.

mod costs;
mod figure;
mod objects;
mod page;
mod plan;
mod portfolio;
mod rates;
#[cfg(test)]
mod tests;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use freestand::fragility::{FitKind, LimitState};
use freestand::risk::{Gap, Hazard};
use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, percent_significant, shortest};
use freestand_output::answer::Input;
use freestand_output::answer_of;
use freestand_output::facts::table;
use freestand_output::figure::{Figure, FigureError};
use freestand_output::table::Table;
use freestand_study::run::Progress;

use crate::fragility::table::{self as fragility_table, RowProblems};
use crate::fragility::{
    At, DEFAULT_REPLICATES, FragilityReport, FragilityRequest, HazardPlace, HazardSource,
    MeasuredHazard, ObjectCurves, ObjectFragility, cautions, contradictions, fragility_watched,
    go_on, hazard_of, load_curves, number_and_unit,
};
use freestand_inventory::CellsRequest;
use freestand_inventory::too_mild::TooMild;

use costs::{OptionRow, Options, curve_id, load_options};
use objects::{LossBounds, ObjectRisk};
use plan::{Chosen, Measures, Worth};
use portfolio::{InCurrency, Portfolio};
use rates::{Levels, Open};

pub use costs::load_changed;
pub(crate) use costs::{CostRow, Costs, load_costs};

/// The schema of the document.
pub const RISK_SCHEMA: &str = "freestand.risk/1";

/// Years of the stated probabilities where none are given.
pub const DEFAULT_YEARS: f64 = 50.0;

/// Longitude and latitude, `151.2,-33.9` \[degrees\].
///
/// # Errors
/// Anything but two numbers, or a place that is not on the globe.
pub fn coordinates(text: &str) -> Result<(f64, f64), Problem> {
    let parsed = text.split_once(',').and_then(|(lon, lat)| {
        Some((
            lon.trim().parse::<f64>().ok()?,
            lat.trim().parse::<f64>().ok()?,
        ))
    });
    parsed
        .filter(|(lon, lat)| lon.abs() <= 360.0 && lat.abs() <= 90.0)
        .ok_or_else(|| {
            let message = format!("\"{}\" is not a longitude and a latitude", shorten(text));
            Problem::value(
                message,
                "write degrees, longitude first, such as \"151.2,-33.9\"",
            )
        })
}

/// An amount of money with its currency, `20000 AUD`.
///
/// # Errors
/// No number of 0 or more, or no currency.
pub fn amount(text: &str) -> Result<(f64, String), Problem> {
    let parsed = number_and_unit(text).and_then(|(number, currency)| {
        let is_currency =
            currency.starts_with(|c: char| !c.is_ascii_digit() && !"+-.,".contains(c));
        Some((number, currency.to_owned())).filter(|(number, _)| *number >= 0.0 && is_currency)
    });
    parsed.ok_or_else(|| {
        let message = format!("\"{}\" is not an amount of money", shorten(text));
        Problem::value(
            message,
            "write a number and a currency, such as \"20000 AUD\"",
        )
    })
}

/// A number of years, `40 yr` or `40`.
///
/// # Errors
/// No number above 0, or another unit.
pub fn years(text: &str) -> Result<f64, Problem> {
    number_with(
        text,
        &["", "yr", "years", "year"],
        "a number of years",
        "40 yr",
    )
}

/// A rate per year, `1e-4 /yr`.
///
/// # Errors
/// No number above 0, or another unit.
pub fn yearly_rate(text: &str) -> Result<f64, Problem> {
    number_with(
        text,
        &["/yr", "1/yr", "/year", "1/year"],
        "a rate per year",
        "1e-4 /yr",
    )
}

fn number_with(text: &str, units: &[&str], what: &str, example: &str) -> Result<f64, Problem> {
    let found =
        number_and_unit(text).filter(|(number, unit)| *number > 0.0 && units.contains(unit));
    found.map(|(number, _)| number).ok_or_else(|| {
        Problem::value(
            format!("\"{}\" is not {what}", shorten(text)),
            format!("write \"{example}\""),
        )
    })
}

/// Where the fragilities come from.
#[derive(Debug, Clone, PartialEq)]
pub enum RiskCurves {
    /// `fragility.csv`.
    File(PathBuf),
    /// A table of outcomes, which is fitted first.
    Outcomes(FragilityRequest),
}

/// A question about risk.
#[derive(Debug, Clone, PartialEq)]
pub struct RiskRequest {
    /// The fragilities.
    pub curves: RiskCurves,
    /// The hazard.
    pub hazard: HazardSource,
    /// Where a spectral acceleration of the hazard is taken.
    pub hazard_at: Option<At>,
    /// Longitude and latitude of the site, for a hazard file with several \[degrees\].
    pub site_deg: Option<(f64, f64)>,
    /// Costs and accepted rates.
    pub inventory: Option<PathBuf>,
    /// How the cells of that list are read.
    pub list: CellsRequest,
    /// Options.
    pub options: Option<PathBuf>,
    /// The most that options may cost, with its currency.
    pub budget: Option<(f64, String)>,
    /// Over which options pay \[years\].
    pub horizon_years: Option<f64>,
    /// Discount rate per year.
    pub discount_ratio: Option<f64>,
    /// Rate of overturning that is accepted where the inventory has none \[1/year\].
    pub accepted_rate: Option<f64>,
    /// Years of the stated probabilities; `None`: [`DEFAULT_YEARS`].
    pub years: Option<f64>,
}

/// An object of the inventory that has no fragility, so that nothing about it is counted.
#[derive(Debug, Clone, PartialEq)]
struct NotRun {
    id: String,
    item: String,
    quantity: f64,
    /// Why it was not run, as far as that is known.
    why: Option<String>,
}

/// The answer.
#[derive(Debug, Clone, PartialEq)]
pub struct RiskReport {
    years: f64,
    currency: Option<String>,
    hazard: MeasuredHazard,
    objects: Vec<ObjectRisk>,
    portfolio: Option<Portfolio>,
    measures: Option<Measures>,
    /// Objects of the inventory that have no fragility.
    not_run: Vec<NotRun>,
    /// What was used because nobody stated it.
    assumptions: Vec<String>,
    inputs: Vec<InputFile>,
    /// What to know beside the result.
    pub warnings: Vec<String>,
}

/// Calculates how often the objects fail, and with costs what that costs.
///
/// A plan that is not proven to be the best after ten seconds is reported with its bound. `progress` can
/// stop the work at every bootstrap sample, between objects, and while a plan is searched.
///
/// # Errors
/// Files that cannot be read, a hazard of another measure than that of the fragilities, two
/// currencies, options without a horizon and a discount rate; or that it was stopped.
pub fn risk(request: &RiskRequest, progress: Progress) -> Result<RiskReport, Problems> {
    if let Some(discount) = request.discount_ratio.filter(|discount| *discount > 1.0) {
        let (percent, written) = (number(100.0 * discount, 4), number(discount, 4));
        let message = format!("a discount rate of {written} is {percent} % a year");
        let hint = format!("write {written} % as `discount = \"{written} %\"`; at most 100 %");
        return Err(Problem::value(message, hint).of(&["discount"]).into());
    }
    let (mut warnings, mut inputs) = (Vec::new(), Vec::new());
    let mut fitted: Option<FragilityReport> = None;
    let mut curves: Vec<ObjectCurves> = match &request.curves {
        RiskCurves::File(path) => {
            let (file, curves) = load_curves(path)?;
            warnings.extend(cautions(cautious(&curves)));
            warnings.extend(contradictions(&curves));
            inputs.push(file);
            curves
        }
        RiskCurves::Outcomes(outcomes) => {
            let report = fragility_watched(outcomes.clone(), progress)?;
            warnings.extend(report.warnings.iter().cloned());
            inputs.push(report.table.file.clone());
            let curves = report
                .objects
                .iter()
                .map(|object| object.curves(report.table.measure, report.at))
                .collect();
            fitted = Some(report);
            curves
        }
    };
    let measures = || curves.iter().map(|one| (one.measure, one.at));
    let only = measures()
        .next()
        .filter(|first| measures().all(|other| other == *first));
    let hazard = hazard_of(
        &request.hazard,
        HazardPlace::Stated(request.hazard_at),
        request.site_deg,
        only,
    )?;
    warnings.extend(hazard.warnings.iter().cloned());
    inputs.extend(hazard.file.iter().cloned());
    let path = match &request.curves {
        RiskCurves::File(path) => path,
        RiskCurves::Outcomes(outcomes) => &outcomes.outcomes,
    };
    for one in &curves {
        let of_file = matches!(request.curves, RiskCurves::File(_));
        check_measure(&hazard, one, path, of_file.then_some(one.line))?;
    }
    let costs = request
        .inventory
        .as_deref()
        .map(|path| load_costs(path, &request.list))
        .transpose()?;
    inputs.extend(costs.iter().map(|costs| costs.file.clone()));
    warnings.extend(costs.iter().flat_map(|costs| costs.warnings.clone()));
    // Curves of another origin do not say it of themselves, but the list may.
    let unsaid: HashSet<&str> = cautious(&curves)
        .filter(|one| one.1.is_none())
        .map(|one| one.0)
        .collect();
    let mild = costs
        .iter()
        .flat_map(|costs| &costs.too_mild)
        .map(|(id, why)| (id.as_str(), Some(*why)));
    warnings.extend(cautions(mild.filter(|(id, _)| unsaid.contains(id))));
    let currency = costs.as_ref().and_then(|costs| costs.currency.clone());
    let options = match &request.options {
        Some(path) => {
            let Options {
                file,
                rows: options,
                curves: named,
                warnings: said,
            } = load_options(path, currency.as_deref(), &curves)?;
            inputs.push(file);
            warnings.extend(said);
            for (file, one) in named {
                check_measure(&hazard, &one, &file.path, Some(one.line))?;
                warnings.extend(one.contradiction());
                if inputs.iter().all(|known| known.path != file.path) {
                    inputs.push(file);
                }
            }
            // Changed objects are not there beside those that they replace.
            let changed: HashSet<String> = options
                .iter()
                .map(|option| curve_id(&option.id, &option.option))
                .collect();
            curves.retain(|one| !changed.contains(&one.id));
            Some(options)
        }
        None => None,
    };
    let years = request.years.unwrap_or(DEFAULT_YEARS);
    let rows = costs.iter().flat_map(|costs| &costs.rows);
    let rows: HashMap<&str, &CostRow> = rows.map(|row| (row.id.as_str(), row)).collect();
    let fits = fitted.iter().flat_map(|report| &report.objects);
    let fits: HashMap<&str, &ObjectFragility> =
        fits.map(|object| (object.id.as_str(), object)).collect();
    let mut objects = Vec::new();
    for one in &curves {
        go_on(progress)?;
        let (cost, fit) = (
            rows.get(one.id.as_str()).copied(),
            fits.get(one.id.as_str()).copied(),
        );
        objects.push(ObjectRisk::new(
            one,
            fit,
            cost,
            &hazard.hazard,
            years,
            request.accepted_rate,
        ));
    }
    check_finite(request, &hazard, &objects)?;
    warnings.extend(begins_too_high(&hazard, &objects));
    warnings.extend(ends_too_low(&hazard, &objects));
    warnings.extend(not_resolved(&hazard, &objects));
    let not_run = not_run(costs.as_ref(), &curves, path, &mut inputs)?;
    warnings.extend(unmatched(costs.as_ref(), &curves));
    warnings.extend(unjudged(&objects));
    let measures = match &options {
        Some(options) => Some(plan::measures(
            request,
            options,
            &objects,
            &hazard,
            currency.as_deref(),
            progress,
        )?),
        None => None,
    };
    warnings.extend(measures.iter().flat_map(Measures::warnings));
    let portfolio = match (&fitted, &costs) {
        (Some(report), Some(costs)) => {
            portfolio::portfolio(report, costs, &objects, &hazard, &mut warnings)?
        }
        _ => None,
    };
    let assumptions = assumed(request, &hazard, &objects, options.as_deref());
    Ok(RiskReport {
        years,
        currency,
        hazard,
        objects,
        portfolio,
        measures,
        not_run,
        assumptions,
        inputs,
        warnings,
    })
}

fn cautious(curves: &[ObjectCurves]) -> impl Iterator<Item = (&str, Option<TooMild>)> + Clone {
    curves.iter().map(|one| (one.id.as_str(), one.caution))
}

/// What was used because nobody stated it, as one sentence; empty where all was stated.
fn assumed(
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

fn is_or_are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

/// A hazard says how often motions of its own measure happen, and nothing about another one. `line` is
/// that of the curves in their file.
fn check_measure(
    hazard: &MeasuredHazard,
    curves: &ObjectCurves,
    path: &Path,
    line: Option<usize>,
) -> Result<(), Problem> {
    if curves.measure == hazard.measure && curves.at == hazard.at {
        return Ok(());
    }
    let named = |measure: crate::fragility::Measure, at: At| {
        format!("{} of the {}", measure.name(), at.name())
    };
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

/// No motion is more frequent than this: a larger rate is a mistake, and the loss that follows from it
/// may be infinite \[1/year\].
const MAX_ANNUAL_RATE: f64 = 1e12;

/// Refuses rates and losses that are implausibly large.
fn check_finite(
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
fn begins_too_high(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Option<String> {
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

/// If a larger share of a rate is above the last point of the hazard, that is said.
const BEYOND: f64 = 0.1;

/// A warning if much of a rate is above the last point of the hazard curve, where its last segment goes
/// on.
fn ends_too_low(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Option<String> {
    let Hazard::Points(points) = &hazard.hazard else {
        return None;
    };
    let share = |one: &objects::StateRisk| {
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
fn not_resolved(hazard: &MeasuredHazard, objects: &[ObjectRisk]) -> Vec<String> {
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

/// The file beside outcomes and curves in which `freestand fragility` says what it did not run, and why.
pub const LEFT_OUT: &str = "left_out.csv";

/// The objects of the inventory without a fragility, with the reasons of the runs, or what the inventory
/// says of their anchors.
fn not_run(
    costs: Option<&Costs>,
    curves: &[ObjectCurves],
    path: &Path,
    inputs: &mut Vec<InputFile>,
) -> Result<Vec<NotRun>, Problems> {
    let Some(costs) = costs else {
        return Ok(Vec::new());
    };
    let beside = path.with_file_name(LEFT_OUT);
    let mut reasons: HashMap<String, String> = HashMap::new();
    if beside.is_file() {
        let bytes = load(&beside)?;
        let mut problems = RowProblems::default();
        let table = fragility_table::Table::read(
            &bytes,
            &beside,
            "the columns are id, why",
            &mut problems,
        )?;
        let (id, why) = (table.needed("id")?, table.needed("why")?);
        let read = |row| {
            Some((
                table.text(row, id).to_owned(),
                table.text(row, why).to_owned(),
            ))
        };
        reasons = table
            .each_row(problems, |row, _| read(row))?
            .into_iter()
            .collect();
        inputs.push(InputFile::new(&beside, &bytes));
    }
    let curved: HashSet<&str> = curves.iter().map(|one| one.id.as_str()).collect();
    let without = costs
        .rows
        .iter()
        .filter(|row| !curved.contains(row.id.as_str()));
    let of = |row: &CostRow| NotRun {
        id: row.id.clone(),
        item: row.item.clone(),
        quantity: row.quantity,
        why: reasons.get(&row.id).cloned().or_else(|| {
            let said = || format!("anchored, the inventory says: {}", shorten(&row.anchored));
            (!row.anchored.is_empty()).then(said)
        }),
    };
    Ok(without.map(of).collect())
}

/// Objects of one list that the other does not have.
fn unmatched(costs: Option<&Costs>, curves: &[ObjectCurves]) -> Vec<String> {
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
fn unjudged(objects: &[ObjectRisk]) -> Option<String> {
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

answer_of!(NotRun as object {
    id: String = object.id.clone();
    item: String = object.item.clone();
    quantity: f64 = object.quantity;
    /// Why it was not run, as far as that is known.
    why: Option<String> = object.why.clone();
});

answer_of!(RiskReport as report {
    version: &'static str = env!("CARGO_PKG_VERSION");
    /// The files that were read.
    inputs: Vec<Input> = report.inputs.iter().map(Input::from).collect();
    /// Years of the stated probabilities.
    years: f64 = report.years;
    currency: Option<String> = report.currency.clone();
    hazard: &MeasuredHazard = &report.hazard;
    assumptions: Vec<String> = report.assumptions.clone();
    objects: Vec<&ObjectRisk> = report.objects.iter().collect();
    expected_annual_loss: Option<f64> = report.expected_annual_loss();
    expected_annual_loss_lower: Option<f64> = report.loss_bounds().map(|loss| loss.0);
    expected_annual_loss_upper: Option<f64> = report.loss_bounds().and_then(|loss| loss.1);
    is_bound: bool = report.is_bound();
    is_at_least: bool = report.is_at_least();
    /// Objects of the inventory without a fragility.
    not_run: Vec<&NotRun> = report.not_run.iter().collect();
    portfolio: Option<InCurrency<'_>> = report.in_currency();
    /// Options, the one that pays most first.
    ranking: Option<Vec<&Worth>> = report.measures.as_ref().map(Measures::ranking);
    plan: Option<&Chosen> = report.measures.as_ref().and_then(|measures| measures.plan.as_ref());
});

impl RiskReport {
    /// Whether every accepted rate is kept, as far as it is known.
    pub fn is_accepted(&self) -> bool {
        self.objects
            .iter()
            .all(|object| object.verdict != Some(objects::RiskVerdict::Exceeds))
    }

    /// Expected annual loss of all objects with costs.
    fn expected_annual_loss(&self) -> Option<f64> {
        let losses: Vec<f64> = self
            .objects
            .iter()
            .filter_map(|object| object.expected_annual_loss)
            .collect();
        (!losses.is_empty()).then(|| losses.iter().sum())
    }

    /// The least and the most that the losses of all objects with costs can be together.
    fn loss_bounds(&self) -> Option<(f64, Option<f64>)> {
        let losses = self.objects.iter().filter_map(|object| object.loss);
        losses
            .map(|loss| (loss.least, loss.most))
            .reduce(|a, b| (a.0 + b.0, a.1.zip(b.1).map(|(a, b)| a + b)))
    }

    /// The loss of all objects that is stated: *at least* the least, where one of them has no most.
    fn stated_loss(&self) -> Option<f64> {
        let losses = self.objects.iter().filter_map(|object| object.loss);
        losses
            .map(|loss| loss.stated(self.is_at_least()))
            .reduce(|a, b| a + b)
    }

    /// Whether only bounds of the losses of all objects together are known.
    fn is_bound(&self) -> bool {
        self.loss_bounds().is_some_and(|(least, most)| {
            LossBounds {
                least,
                best: least,
                most,
            }
            .is_bound()
        })
    }

    /// Whether the losses may be larger than stated, because a rate of an object with costs may be.
    fn is_at_least(&self) -> bool {
        self.objects
            .iter()
            .any(|object| object.expected_annual_loss.is_some() && object.is_at_least)
    }

    fn in_currency(&self) -> Option<InCurrency<'_>> {
        let (portfolio, currency) = (self.portfolio.as_ref()?, self.currency.as_deref());
        Some(InCurrency {
            portfolio,
            currency,
        })
    }

    /// `risk.csv`: one row for each object and limit state.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn table(&self) -> Result<Table, Problem> {
        table(
            self.objects
                .iter()
                .flat_map(|object| object.rows(self.years)),
        )
    }

    /// Losses of all objects against their return periods, and what a budget is worth; `None` without
    /// either.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn figure(&self) -> Result<Option<Figure>, FigureError> {
        figure::risk_figure(self)
    }

    /// `report.html`: one page for the owner, with the figure.
    pub fn html(&self, figure: Option<&Figure>) -> String {
        page::owners_page(self, figure)
    }

    /// The answer for people.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let currency = self.currency.as_deref().unwrap_or("");
        let plan = self
            .measures
            .as_ref()
            .and_then(|measures| measures.plan.as_ref());
        text.extend(
            plan.and_then(|plan| plan.unfunded_words(currency))
                .map(|words| format!("{words}\n")),
        );
        let years = number(self.years, 4);
        for object in &self.objects {
            text += &format!("{}\n", object.id);
            for one in &object.states {
                text += &format!("  {:10}  {}\n", one.limit_state.name(), one.words(&years));
            }
            if let Some(verdict) = object.verdict {
                let limits = object.named_limits();
                let limits = limits.iter().map(|limit| {
                    let of = if limit.limit_state == LimitState::Overturns {
                        "overturning"
                    } else {
                        "exceeding"
                    };
                    format!("accepted for {of}: {} a year", number(limit.accepted, 3))
                });
                let accepted = format!(" ({})", limits.collect::<Vec<_>>().join("; "));
                let sure = object.uncertainty_words();
                text += &format!("  verdict     {}{sure}{accepted}\n", verdict.words());
            } else if let Some(why) = object.why {
                text += &format!("  verdict     not known: {why}\n");
            }
            if let (Some(loss), Some(currency)) = (object.loss, &self.currency) {
                let bounds = loss.words(&format!("{currency} a year"));
                let (least, stated) = (
                    least(object.is_at_least),
                    number(loss.stated(object.is_at_least), 4),
                );
                text += &format!("  loss        {least}{stated} {currency} a year{bounds}\n");
            }
            if let Some(why) = object.curves.caution {
                text += &format!(
                    "  caution     {}; it may fail more often than its curves say\n",
                    why.words()
                );
            }
            if !object.not_counted.is_empty() && object.expected_annual_loss.is_some() {
                text += &format!("  not counted {}\n", object.not_counted.join(", "));
            }
        }
        if let Some(loss) = self.stated_loss().filter(|_| self.objects.len() > 1) {
            let bounds = match self.loss_bounds() {
                Some((from, Some(to))) if self.is_bound() => {
                    format!(
                        "; between {} and {} {currency} a year",
                        number(from, 4),
                        number(to, 4)
                    )
                }
                _ => String::new(),
            };
            let least = least(self.is_at_least());
            text += &format!(
                "All objects: {least}{} {currency} a year{bounds}\n",
                number(loss, 4)
            );
        }
        if let Some(portfolio) = &self.portfolio {
            text += &portfolio.text(currency);
        }
        if let Some(measures) = &self.measures {
            text += &measures.text(currency);
        }
        text.extend(
            self.assumptions
                .iter()
                .map(|assumed| format!("{assumed}\n")),
        );
        text
    }
}

/// An intensity with four digits, for a message.
fn rounded_value(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// The words before a number that is a lower bound.
pub(crate) fn least(is_at_least: bool) -> &'static str {
    if is_at_least { "at least " } else { "" }
}

/// A rate in words: how often, its 95 % interval if it has one, and the chance in a number of
/// years.
pub(crate) fn rate_words(
    rate: f64,
    ci95: Option<(f64, f64)>,
    probability: f64,
    years: &str,
) -> String {
    let interval = |(low, high)| {
        format!(
            "; 95 % interval {} to {} a year",
            number(low, 3),
            number(high, 3)
        )
    };
    format!(
        "{} a year ({}{}), {} in {years} years",
        number(rate, 3),
        once_in(rate).unwrap_or_else(|| "never".to_owned()),
        ci95.map_or(String::new(), interval),
        percent_significant(probability, 3)
    )
}

/// `once in 475 years`; `None` for a rate of 0.
pub(crate) fn once_in(rate: f64) -> Option<String> {
    (rate > 0.0).then(|| format!("once in {} years", rounded(1.0 / rate, 3)))
}

/// A number with a few significant digits, also before the decimal point: 10900, not 10932.
pub(crate) fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    number(text.parse().unwrap_or(value), digits)
}

/// The states whose curves enter a loss.
pub(crate) const LOSS_STATES: [LimitState; 2] = [LimitState::Exceeds, LimitState::Overturns];
