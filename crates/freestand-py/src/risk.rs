//! Fragilities, and how often objects fail.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use freestand::fragility::CurveKind;
use freestand_app::fragility::{Fitted, Fragility, SCHEMA as FRAGILITY};
use freestand_app::request::Question as _;
use freestand_app::risk::{Risk, SCHEMA as RISK};
use freestand_input::problem::Problem;
use freestand_report::fragility::{self as of_fragility, FragilityAnswer};
use freestand_report::risk::{self as of_risk, RiskAnswer};
use freestand_risk::fragility::fragility as fitted;
use freestand_risk::risk as calculated;
use freestand_study::run::Step;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{bytes, doubles, told};
use crate::asked::{Named, asked};
use crate::errors::{raised, raised_all};
use crate::work::watched;

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
    request: &Bound<'_, PyDict>,
    files: Named,
    threads: Option<usize>,
) -> PyResult<(String, String)> {
    let (request, files) = asked::<Fragility>(request, [], files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let Fitted::Outcomes(request) = meant.fitted else {
        let hint = "give a path or a table";
        return Err(raised(Problem::value("there are no outcomes", hint)));
    };
    let report = watched(py, threads, |stop| fitted(request, &until(stop)))?.map_err(raised_all)?;
    let seen = report.empirical_table().map_err(raised)?.to_string();
    let warnings = of_fragility::warnings(&report);
    let document = told(FRAGILITY, &FragilityAnswer(&report), &warnings)?;
    Ok((document, seen))
}

/// How often objects fail, and what that costs.
#[pyfunction]
pub(crate) fn risk(
    py: Python<'_>,
    request: &Bound<'_, PyDict>,
    files: Named,
    threads: Option<usize>,
) -> PyResult<String> {
    let (request, files) = asked::<Risk>(request, [], files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let report =
        watched(py, threads, |stop| calculated(&meant.risk, &until(stop)))?.map_err(raised_all)?;
    told(RISK, &RiskAnswer(&report), &of_risk::warnings(&report))
}
