//! One object: whether it falls over, and how strongly it must be held.

use std::sync::atomic::Ordering;

use freestand_app::object::{Object, SCHEMA};
use freestand_app::request::Question as _;
use freestand_app::restrain::{Asked, Restrain, SCHEMA as RESTRAIN};
use freestand_assess::one_object::one_object;
use freestand_assess::restrain::{restrain as restrained, restrain_list as restrained_list};
use freestand_input::problem::Problems;
use freestand_output::answer::Answer as _;
use freestand_report::object::object_report;
use freestand_report::restraint::{
    restrain_list_report, restrain_report, restraint_sheet, restraint_sheets,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::told;
use freestand_report::signature::Signing;

use crate::asked::{Named, asked};
use crate::errors::{of_study, raised_all};
use crate::motion::Record;
use crate::work::watched;

/// The sentence about one object, and the numbers behind it.
#[pyfunction]
pub(crate) fn check_object(
    py: Python<'_>,
    motions: Vec<PyRef<'_, Record>>,
    request: &Bound<'_, PyDict>,
    files: Named,
    threads: Option<usize>,
) -> PyResult<String> {
    // What is under an edge is one key, and two arguments.
    let under = match request.contains("stiffness_n_m")? {
        true => "stiffness",
        false => "on",
    };
    let raised = |problems: Problems| {
        let problems = problems.into_iter();
        raised_all(
            problems
                .map(|one| one.renamed("on", under))
                .collect::<Problems>(),
        )
    };
    let motions = motions.iter().map(|record| ("motion", record.read.clone()));
    let (request, files) = asked::<Object>(request, motions, files)?;
    let meant = request.resolve(&files).map_err(raised)?;
    let report = watched(py, threads, |stop| {
        one_object(&meant.object, &|| stop.load(Ordering::Relaxed))
    })?;
    let report = object_report(report.map_err(raised)?);
    told(SCHEMA, &report, &report.warnings)
}

/// What a request asks of restraints. A study that cannot be used raises a `StudyError`.
fn restraints(request: &Bound<'_, PyDict>, files: Named) -> PyResult<(Asked, Signing)> {
    let (request, files) = asked::<Restrain>(request, std::iter::empty(), files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let signing = meant.signing;
    Ok((meant.asked().map_err(of_study)?, signing))
}

/// The force that a restraint has to carry: the document, and a sheet to print (HTML), of a list one for each object.
#[pyfunction]
pub(crate) fn restrain(
    py: Python<'_>,
    request: &Bound<'_, PyDict>,
    files: Named,
) -> PyResult<(String, String)> {
    let (asked, signing) = restraints(request, files)?;
    let work = match asked {
        Asked::One(one) => watched(py, None, |_| {
            let report = restrain_report(restrained(one)?);
            let sheet = restraint_sheet(&report, signing);
            Ok((report.facts(), report.warnings, sheet))
        })?,
        Asked::List(list) => watched(py, None, |_| {
            let report = restrain_list_report(restrained_list(&list)?);
            let sheets = restraint_sheets(&report, signing);
            Ok((report.facts(), report.warnings, sheets))
        })?,
    };
    let (document, warnings, sheet) = work.map_err(|problems: Problems| raised_all(problems))?;
    Ok((told(RESTRAIN, &document, &warnings)?, sheet))
}
