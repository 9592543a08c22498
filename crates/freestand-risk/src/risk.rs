//! From a request to its answer.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use freestand_input::file::{InputFile, load};
use freestand_input::problem::Problems;
use freestand_inventory::too_mild::TooMild;
use freestand_study::run::Progress;

use crate::costs::{CostRow, Costs, Options, curve_id, load_costs, load_options};
use crate::doubts::{
    RiskDoubt, assumed, begins_too_high, check_finite, check_measure, ends_too_low, not_resolved,
    unjudged, unmatched,
};
use crate::fragility::table::{self as fragility_table, RowProblems};
use crate::fragility::{
    CurveDoubt, FragilityReport, HazardPlace, ObjectCurves, ObjectFragility, cautions,
    contradictions, fragility, go_on, hazard_of, load_curves,
};
use crate::objects::ObjectRisk;
use crate::plan::Measures;
use crate::report::{NotRun, RiskReport, WhyNotRun};
use crate::request::{DEFAULT_YEARS, RiskCurves, RiskRequest};
use crate::{plan, portfolio};

/// Calculates how often the objects fail, and with costs what that costs.
///
/// A plan that is not proven to be the best after ten seconds is reported with its bound. `progress` can
/// stop the work at every bootstrap sample, between objects, and while a plan is searched.
///
/// # Errors
/// Files that cannot be read, a hazard of another measure than that of the fragilities, two
/// currencies, options without a horizon and a discount rate; or that it was stopped.
pub fn risk(request: &RiskRequest, progress: Progress) -> Result<RiskReport, Problems> {
    let (mut doubts, mut inputs) = (Vec::new(), Vec::new());
    let mut fitted: Option<FragilityReport> = None;
    let mut curves: Vec<ObjectCurves> = match &request.curves {
        RiskCurves::File(path) => {
            let (file, curves) = load_curves(path)?;
            let of_curves = cautions(cautious(&curves)).chain(contradictions(&curves));
            doubts.push(RiskDoubt::Curves(of_curves.collect()));
            inputs.push(file);
            curves
        }
        RiskCurves::Outcomes(outcomes) => {
            let report = fragility(outcomes.clone(), progress)?;
            doubts.push(RiskDoubt::Curves(report.doubts()));
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
    doubts.extend(hazard.doubts_at(request.site_deg).map(RiskDoubt::Hazard));
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
    let of_costs = costs.iter().flat_map(|costs| costs.doubts.clone());
    doubts.extend(of_costs.map(RiskDoubt::Cost));
    // Curves of another origin do not say it of themselves, but the list may.
    let unsaid: HashSet<&str> = cautious(&curves)
        .filter(|one| one.1.is_none())
        .map(|one| one.0)
        .collect();
    let mild = costs
        .iter()
        .flat_map(|costs| &costs.too_mild)
        .map(|(id, why)| (id.as_str(), Some(*why)));
    let unsaid = cautions(mild.filter(|(id, _)| unsaid.contains(id)));
    doubts.push(RiskDoubt::Curves(unsaid.collect()));
    let currency = costs.as_ref().and_then(|costs| costs.currency.clone());
    let options = match &request.options {
        Some(path) => {
            let Options {
                file,
                rows: options,
                curves: named,
                doubts: of_options,
            } = load_options(path, currency.as_deref(), &curves)?;
            inputs.push(file);
            doubts.extend(of_options.into_iter().map(RiskDoubt::Cost));
            for (file, one) in named {
                check_measure(&hazard, &one, &file.path, Some(one.line))?;
                doubts.extend(one.contradiction().map(|first| {
                    let also = Vec::new();
                    RiskDoubt::Curves(vec![CurveDoubt::Contradiction { first, also }])
                }));
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
            (&hazard.hazard, &hazard.tilted),
            years,
            request.accepted_rate,
        ));
    }
    check_finite(request, &hazard, &objects)?;
    doubts.extend(begins_too_high(&hazard, &objects));
    doubts.extend(ends_too_low(&hazard, &objects));
    doubts.extend(not_resolved(&objects));
    let not_run = not_run(costs.as_ref(), &curves, path, &mut inputs)?;
    doubts.extend(unmatched(costs.as_ref(), &curves));
    doubts.extend(unjudged(&objects));
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
    doubts.extend(measures.iter().flat_map(Measures::doubts));
    let portfolio = match (&fitted, &costs) {
        (Some(report), Some(costs)) => {
            portfolio::portfolio(report, costs, &objects, &hazard, &mut doubts)?
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
        doubts,
    })
}

fn cautious(curves: &[ObjectCurves]) -> impl Iterator<Item = (&str, Option<TooMild>)> + Clone {
    curves.iter().map(|one| (one.id.as_str(), one.caution))
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
        why: match reasons.get(&row.id) {
            Some(why) => Some(WhyNotRun::LeftOut(why.clone())),
            None if row.anchored.is_empty() => None,
            None => Some(WhyNotRun::Anchored(row.anchored.clone())),
        },
    };
    Ok(without.map(of).collect())
}
