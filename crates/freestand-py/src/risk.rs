//! Fragilities, and how often objects fail.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use freestand::fragility::{CurveKind, FitKind};
use freestand_assess::fragility::{
    At, FITS, FRAGILITY_SCHEMA, FragilityRequest, HAZARD_CODES, HazardGiven, Measure, ShockLimits,
    fragility_watched as fitted,
};
use freestand_assess::risk::{RISK_SCHEMA, RiskCurves, RiskRequest, amount, risk as calculated};
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::Choices;
use freestand_study::run::Step;
use freestand_study::study::DEFAULT_SEED;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{Given, bytes, doubles, told};
use crate::errors::{raised, raised_all, raised_by};
use crate::work::watched;

const PLACES: Choices<At> = &[
    (At::Ground, "ground", "of the ground motion"),
    (At::Floor, "floor", "of the floor motion"),
];

/// Arguments that are named otherwise in other functions, or in the command.
const ARGUMENTS: &[(&str, &str)] = &[
    ("at", "at"),
    ("fit", "fit"),
    ("tolerance", "tolerance_g"),
    ("ceiling", "ceiling_g"),
    ("outcomes", "outcomes"),
    ("fragility", "fragility"),
    ("hazard", "hazard"),
    ("hazard_im", "hazard_im"),
    ("site_coordinates", "site_deg"),
    ("options", "options"),
    ("horizon", "horizon_years"),
    ("discount", "discount_ratio"),
    ("edit", "edits"),
];

/// Progress of work that goes on until the flag is set.
fn until(stop: &AtomicBool) -> impl Fn(Step) -> ControlFlow<()> + Sync {
    |_| {
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// The fit of outcomes, as far as it is given.
struct Fitting {
    at: Option<At>,
    fit: FitKind,
    shock: Option<ShockLimits>,
    replicates: Option<u32>,
    seed: u64,
}

impl Fitting {
    fn of(given: &mut Given<'_, '_>) -> Self {
        let (tolerance_g, ceiling_g) = (given.positive("tolerance_g"), given.positive("ceiling_g"));
        if tolerance_g.is_some() != ceiling_g.is_some() {
            given.push(Problem::value(
                "tolerance_g and ceiling_g belong together",
                "give both, or neither",
            ));
        }
        Self {
            at: given.choice("at", PLACES),
            fit: given.choice("fit", FITS).unwrap_or(FitKind::Ordered),
            shock: tolerance_g
                .zip(ceiling_g)
                .map(|(tolerance_g, ceiling_g)| ShockLimits {
                    tolerance_g,
                    ceiling_g,
                }),
            replicates: given
                .whole("bootstrap", 0)
                .map(|count| u32::try_from(count).unwrap_or(u32::MAX)),
            seed: given.whole("seed", 0).unwrap_or(DEFAULT_SEED),
        }
    }

    fn request(self, outcomes: PathBuf) -> FragilityRequest {
        let Self {
            at,
            fit,
            shock,
            replicates,
            seed,
        } = self;
        FragilityRequest {
            outcomes,
            at,
            fit,
            shock,
            replicates,
            seed,
        }
    }
}

/// The probabilities of a lognormal fragility at these intensities.
#[pyfunction]
pub(crate) fn lognormal<'py>(
    py: Python<'py>,
    median: f64,
    beta: f64,
    intensities: &[u8],
) -> Bound<'py, PyBytes> {
    let curve = CurveKind::Lognormal { median, beta };
    let probability = |intensity| curve.probability(intensity).unwrap_or(f64::NAN);
    PyBytes::new(
        py,
        &bytes(doubles(intensities).into_iter().map(probability)),
    )
}

/// Fragilities of the objects of a table of outcomes: the document, and what was seen, as CSV.
#[pyfunction]
pub(crate) fn fragility(
    py: Python<'_>,
    values: &Bound<'_, PyDict>,
    threads: Option<usize>,
) -> PyResult<(String, String)> {
    let mut given = Given::new(values);
    let fitting = Fitting::of(&mut given);
    let outcomes = given.path("outcomes");
    given.finish()?;
    let Some(outcomes) = outcomes else {
        return Err(raised(Problem::value(
            "there are no outcomes",
            "give a path or a table",
        )));
    };
    let request = fitting.request(outcomes);
    let report = watched(py, threads, |stop| fitted(request, &until(stop)))?
        .map_err(|problems| raised_by(ARGUMENTS, problems))?;
    let seen = report.empirical_table().map_err(raised)?.to_string();
    Ok((
        told(FRAGILITY_SCHEMA, &report.facts(), &report.warnings)?,
        seen,
    ))
}

/// How often objects fail, and what that costs.
#[pyfunction]
pub(crate) fn risk(
    py: Python<'_>,
    values: &Bound<'_, PyDict>,
    threads: Option<usize>,
) -> PyResult<String> {
    let mut given = Given::new(values);
    let fitting = Fitting::of(&mut given);
    let hazard_at = fitting.at;
    let measure = given.text("hazard_im");
    let measure = measure.and_then(|text| {
        let hint =
            "give pga, pgv, pfa, pfv, sa(0.5), sa_avg(0.2:2), velocity_ratio or acceleration_ratio";
        let unknown = || {
            Problem::value(
                format!("hazard_im \"{text}\" is not an intensity measure"),
                hint,
            )
        };
        given.keep(Measure::parse(&text).ok_or_else(unknown))
    });
    let hazard = HazardGiven {
        file: given.path("hazard"),
        power_law: given.text("hazard_power"),
        code: given.choice("hazard_code", HAZARD_CODES),
        measure,
        site: given.text("site"),
        hazard_factor: given.positive("hazard_factor"),
        fault_distance_m: given.non_negative("fault_distance_m"),
    };
    let hazard = given.keep(hazard.source());
    let (file, outcomes) = (given.path("fragility"), given.path("outcomes"));
    if file.is_some() && outcomes.is_some() {
        let message = "only one of fragility and outcomes can be given";
        given.push(Problem::value(
            message,
            "keep one of them: outcomes are fitted, curves are used as they are",
        ));
    }
    let curves = given.keep(RiskCurves::given(file, outcomes, |outcomes| {
        fitting.request(outcomes)
    }));
    let budget = given.text("budget");
    let budget = budget.and_then(|text| given.keep(amount(&text)));
    let (site_deg, inventory, options) = (
        given.point("site_deg"),
        given.path("inventory"),
        given.path("options"),
    );
    let list = given.cells();
    if list.is_given() && inventory.is_none() {
        let message =
            "sheet, columns and edits say how the list is read, and there is no inventory";
        given.push(Problem::value(
            message,
            "give an inventory, or leave them out",
        ));
    }
    let (horizon_years, discount_ratio) = (
        given.positive("horizon_years"),
        given.non_negative("discount_ratio"),
    );
    let (accepted_rate, years) = (given.positive("accepted_rate"), given.positive("years"));
    given.finish()?;
    let (Some(hazard), Some(curves)) = (hazard, curves) else {
        return Err(raised_all(Problems::default()));
    };
    let request = RiskRequest {
        curves,
        hazard,
        hazard_at,
        site_deg,
        list,
        inventory,
        options,
        budget,
        horizon_years,
        discount_ratio,
        accepted_rate,
        years,
    };
    let report = watched(py, threads, |stop| calculated(&request, &until(stop)))?
        .map_err(|problems| raised_by(ARGUMENTS, problems))?;
    told(RISK_SCHEMA, &report.facts(), &report.warnings)
}
