//! Studies and inventories.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use freestand_app::assess::{Assess, SCHEMA};
use freestand_app::check_list::{CheckList, SCHEMA as CHECK};
use freestand_app::job::{self, Beside, Job, Spending, assess_telling};
use freestand_app::request::Question as _;
use freestand_app::run::Run;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, Problems};
use freestand_inventory::check_report;
use freestand_output::folder::{OutputFolder, write_file};
use freestand_output::streamed::{rows_head, rows_tail};
use freestand_report::assessment::object_rows;
use freestand_report::doubts::study_doubts;
use freestand_report::study::outputs::{expected_names, write_outputs};
use freestand_report::study::summary::{RunAnswer, Summary};
use freestand_study::resolve::{builtin_toml, motion_paths};
use freestand_study::run::{Stage, Step, run as run_study};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::told;
use crate::asked::{Named, asked};
use crate::errors::{of_study, raised_all};
use crate::work::watched_with;

/// The built-in study as TOML.
#[pyfunction]
pub(crate) fn study_toml() -> &'static str {
    builtin_toml()
}

/// The last step of work, which a function of Python is told.
#[derive(Default)]
struct Told(Mutex<Option<(&'static str, usize, usize)>>);

impl Told {
    /// Keeps the step, and stops the work where this is asked.
    fn step(&self, step: Step, stop: &AtomicBool) -> ControlFlow<()> {
        if let Ok(mut last) = self.0.lock() {
            *last = Some((step.stage.map_or("", Stage::name), step.done, step.total));
        }
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Calls the function with the last step, unless it knows it already.
    fn tell(&self, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let last = self.0.lock().ok().and_then(|mut last| last.take());
        match (progress, last) {
            (Some(progress), Some(step)) => progress.call1(step).map(|_| ()),
            _ => Ok(()),
        }
    }
}

/// The verdicts about an inventory, written into a folder: the document of the command.
#[pyfunction]
pub(crate) fn assess(
    py: Python<'_>,
    request: &Bound<'_, PyDict>,
    files: Named,
    into: (PathBuf, bool),
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let (request, files) = asked::<Assess>(request, std::iter::empty(), files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let study = meant.study().map_err(of_study)?;
    let (out, force) = into;
    let job = Job { force, ..meant.job };
    let told = Told::default();
    let work = |stop: &AtomicBool| {
        let inventory = meant.list.inventory(&study)?;
        let budget = meant.budget(&inventory)?;
        let progress = |step: Step| told.step(step, stop);
        let beside = Beside {
            spending: budget.as_ref().map(Spending::Planned),
            earlier: meant.earlier()?,
        };
        let report = assess_telling(
            &study,
            &inventory,
            &out,
            &job,
            beside,
            job::Told::default(),
            &progress,
        )?;
        let mut text = rows_head(SCHEMA)?;
        let mut separator = "";
        object_rows(&out, &inventory, |row| {
            let row = serde_json::to_string(row).map_err(|error| {
                Problem::new(
                    freestand_input::ProblemKind::Computation,
                    format!("a row is not JSON: {error}"),
                )
            })?;
            text.push_str(separator);
            text.push_str(&row);
            separator = ",\n";
            Ok::<(), Problem>(())
        })?;
        text.push_str(&rows_tail(SCHEMA, &report, &report.all_warnings())?);
        Ok::<String, Problems>(text)
    };
    watched_with(py, threads, work, |_| told.tell(progress))?.map_err(of_study)
}

/// How a list is understood: the document of `inventory check`. A copy with notes is written where it is wanted.
#[pyfunction]
pub(crate) fn check_inventory(
    py: Python<'_>,
    request: &Bound<'_, PyDict>,
    files: Named,
    marked: Option<PathBuf>,
) -> PyResult<String> {
    let (request, files) = asked::<CheckList>(request, std::iter::empty(), files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let floors = meant.floors().map_err(of_study)?;
    let work = || -> Result<_, Problems> {
        let (reading, copy) = meant.reading(floors, marked.is_some(), |problems| problems)?;
        if let Some((place, copy)) = marked.as_ref().zip(copy) {
            write_file(place, &copy, &meant.inputs)?;
        }
        Ok(reading)
    };
    let reading = py.detach(work).map_err(raised_all)?;
    let marked = marked.map(|place| place.to_string_lossy().into_owned());
    let report = check_report(&reading, marked, KeyStyle::Argument);
    told(CHECK, &report, &reading.inventory.warnings)
}

/// A whole study, written into a folder: the document of the command.
#[pyfunction]
pub(crate) fn run(
    py: Python<'_>,
    request: &Bound<'_, PyDict>,
    files: Named,
    into: (PathBuf, bool),
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let (request, files) = asked::<Run>(request, std::iter::empty(), files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let study = meant.study().map_err(of_study)?;
    let (out, force) = into;
    let schema = freestand_report::study::summary::SCHEMA;
    let told_step = Told::default();
    let work = |stop: &AtomicBool| {
        let mut inputs = meant.study.inputs.clone();
        inputs.extend(motion_paths(&study));
        let folder = OutputFolder::stage(&out, force, &inputs)?.of_command(schema)?;
        folder.check(&expected_names(&study, false))?;
        let result = run_study(&study, &|step| told_step.step(step, stop))?;
        if stop.load(Ordering::Relaxed) {
            return Err(Problem::stopped().into());
        }
        let written = write_outputs(folder, &study, &result)?;
        Ok::<_, Problems>((written, result))
    };
    let (written, result) =
        watched_with(py, threads, work, |_| told_step.tell(progress))?.map_err(of_study)?;
    let summary = Summary {
        study: &study,
        result: &result,
        levels: &written.levels,
        files: &written.files,
    };
    let out = out.display().to_string();
    let doubts = study_doubts(&result.doubts);
    told(schema, &RunAnswer { summary, out }, &doubts)
}
