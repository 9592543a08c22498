//! `freestand fragility` of objects that are run before the fit.

use freestand_app::fragility::{Runs, SCHEMA};
use freestand_input::problem::Problem;
use freestand_output::json::document;
use freestand_report::figures::{curves_figure, ida_figure, measures_figure, residuals_figure};
use freestand_report::fragility::{RunsAnswer, left_out_table};
use freestand_risk::LEFT_OUT;
use freestand_risk::export::ExportRequest;
use freestand_risk::fragility::{KeepRuns, RunsReport, RunsRequest, file_name, fragility_of_runs};

use super::Done;
use super::assess::watched;
use super::exports::{Exported, write};
use crate::args::GlobalArgs;
use crate::failure::{Failure, Left};
use crate::files::Files;
use crate::printer::Printer;

/// The runs and their fit.
pub(super) fn run(
    runs: Runs,
    exports: &[ExportRequest],
    files: Files,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    if runs.resume && global.out.is_none() {
        let message = "`resume` continues runs in their folder, and `out` is not given";
        let problem = Problem::value(message, "give `out`, as in the earlier command");
        return Err(problem.of(&["resume"]).into());
    }
    let has_errors = runs.has_errors();
    let folder = global.out.clone().filter(|_| runs.is_listed());
    let keep = folder.map(|folder| KeepRuns {
        folder,
        resume: runs.resume,
        force: global.force,
    });
    let is_kept = keep.is_some();
    let request = RunsRequest {
        keep,
        ..runs.request
    };
    // Made before the runs, so that no signal is missed between them and the files.
    let stop = printer.stop();
    let found = watched(printer, |progress| fragility_of_runs(&request, progress));
    let left = if is_kept { Left::Runs } else { Left::Nothing };
    let report = found.map_err(|problems| Failure::from(problems).leaving(left))?;
    // Before anything is written, so that what cannot be exported leaves no folder.
    let exported = report.first().map(|first| Exported::of(first, exports));
    let exported = exported.transpose()?.unwrap_or_default();
    let answer = RunsAnswer::of(&report);
    let mut warnings = [runs.notes, answer.warnings()].concat();
    // Both read the hazard.
    let of_exports = exported.warnings.into_iter();
    let others: Vec<String> = of_exports.filter(|one| !warnings.contains(one)).collect();
    warnings.extend(others);
    if files.wanted() {
        let go_on = || {
            stop.go_on()
                .map_err(|stopped| Failure::from(stopped).leaving(left))
        };
        write_runs(&report, &answer, &warnings, &files, go_on)?;
        write(exported.files, &files)?;
    }
    files.finish_result(SCHEMA, &warnings)?;
    // The text begins with that sentence.
    let is_said = |warning: &String| !printer.json() && answer.no_study() == Some(warning);
    let told: Vec<String> = warnings
        .into_iter()
        .filter(|warning| !is_said(warning))
        .collect();
    printer.result(SCHEMA, &answer, &told, || answer.text())?;
    Ok(Done {
        criterion_met: !has_errors,
    })
}

/// Writes the files. Before each of them it asks whether to continue, because tables and figures of
/// many runs take some seconds.
fn write_runs(
    report: &RunsReport,
    answer: &RunsAnswer<'_>,
    warnings: &[String],
    files: &Files,
    go_on: impl Fn() -> Result<(), Failure>,
) -> Result<(), Failure> {
    for (place, (fit, outcomes)) in report.reports.iter().zip(&report.outcomes).enumerate() {
        let name = |what: &str| {
            file_name(what, place, fit.table.measure)
                .trim_end_matches(".csv")
                .to_owned()
        };
        go_on()?;
        files.table(&name("outcomes"), || Ok(outcomes.clone()))?;
        go_on()?;
        files.table(&name("fragility"), || fit.table())?;
        files.table(&name("empirical"), || fit.empirical_table())?;
    }
    if let Some(table) = left_out_table(report)? {
        files.table(LEFT_OUT.trim_end_matches(".csv"), || Ok(table))?;
    }
    go_on()?;
    let json = document(SCHEMA, answer, warnings)?;
    files.write("fragility.json", || json)?;
    if let Some(first) = report.first() {
        go_on()?;
        files.figure("fragility", || curves_figure(first))?;
    }
    go_on()?;
    files.figure("ida", || ida_figure(report))?;
    go_on()?;
    files.figure("measures", || measures_figure(report))?;
    files.figure("residuals", || residuals_figure(report))?;
    go_on()
}
