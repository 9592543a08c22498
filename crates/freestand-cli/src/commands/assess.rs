//! `freestand assess`: which objects of an inventory must be restrained.

use std::ops::ControlFlow;
use std::path::Path;

use clap::Args;
use freestand_app::assess::{Assess, Meant, SCHEMA};
use freestand_assess::job::{Finished, Job, JobReport, assess_telling};
use freestand_assess::output::object_rows;
use freestand_assess::output::words::advice;
use freestand_assess::result::Decision;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::Problems;
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::one_line;
use freestand_input::words::counted;
use freestand_inventory::{Inventory, problem_reports};
use freestand_output::folder::removed_note;
use freestand_output::json::document;
use freestand_output::streamed::{rows_head, rows_tail};
use freestand_study::run::{Progress, Step};
use serde_json::{Map, Value};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::{Printer, significant, table};

/// Decide which objects of an inventory to restrain, to put on softer pads or to leave
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  An inventory to fill in, then its assessment in a building of 7 storeys in Christchurch:
    freestand inventory template --csv > objects.csv
    freestand assess --place Christchurch --storeys 7 --inventory objects.csv --out assessment
  With your own building and hazard; the study may also name the inventory:
    freestand assess hospital.toml --inventory hospital.xlsx --out assessment
  With the hazard of a place, in the building of the study:
    freestand assess hospital.toml --inventory hospital.xlsx --place \"Salt Lake City\" \\
      --out assessment
  Continue after Ctrl-C or a crash, in the same folder:
    freestand assess hospital.toml --inventory hospital.xlsx --out assessment --resume
  With one cell corrected; the file itself is not changed:
    freestand assess --inventory objects.csv --edit \"D7=900 mm\"
  Also a Parquet table, for pandas:
    freestand assess --inventory objects.csv --format csv,parquet
  In a script that stops where something has to be restrained or its data are missing:
    freestand assess hospital.toml --fail-on restrain --fail-on no-verdict

Without --out the files are in freestand-assessment/. Exit status: 0 finished, whatever the
verdicts; 1 a cell of the list could not be read, a history failed, or --fail-on applies; 2 could
not run.
Accepted probabilities and uncertainties are keys of [assessment] in a study; see
docs/assessment.md.")]
pub(crate) struct AssessArgs {
    #[command(flatten)]
    pub(super) request: Assess,
}

/// Objects of a part while a user watches the page: one by one in a list that is read as it comes,
/// more where each part would cost more than what it tells.
fn watched_rows(rows: usize) -> usize {
    const PARTS: usize = 128;
    const MOST_ROWS: usize = 32;
    (rows / PARTS).clamp(1, MOST_ROWS)
}

/// The folder where no `--out` is given.
const FOLDER: &str = "freestand-assessment";

impl Tell for Assess {
    type Output = ();

    const WRITES_A_FOLDER: bool = true;

    fn tell(
        meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let study = meant.study()?;
        let inventory = meant.list.inventory(&study)?;
        let out = global.folder(FOLDER);
        let part_rows = printer
            .session()
            .map(|_| watched_rows(inventory.items.len()));
        let job = Job {
            force: global.force,
            part_rows,
            ..meant.job
        };
        if let Some(session) = printer.session() {
            problem_reports(&inventory.findings, KeyStyle::Flag)
                .iter()
                .for_each(|problem| session.problem(problem));
        }
        let told = |row: &Map<String, Value>| {
            printer
                .session()
                .into_iter()
                .for_each(|session| session.object(row))
        };
        let finished: Option<Finished> = printer.session().is_some().then_some(&told);
        let report = watched(printer, |progress| {
            assess_telling(&study, &inventory, &out, &job, (progress, finished))
        })?;
        print(&report, &out, &inventory, printer)?;
        if report.interrupted {
            return Err(Failure::StoppedAfterWriting);
        }
        let mut fail_on = meant.fail_on.iter();
        let is_named = fail_on.any(|verdict| report.count(*verdict) > 0);
        Ok(Done {
            criterion_met: report.failed == 0 && !inventory.has_errors() && !is_named,
        })
    }
}

/// Long work with a bar of its progress, which Ctrl-C stops.
pub(crate) fn watched<T>(
    printer: &Printer,
    work: impl FnOnce(Progress) -> Result<T, Problems>,
) -> Result<T, Problems> {
    let stop = printer.stop();
    let bar = printer.progress_bar(false);
    let progress = |step: Step| {
        if let Some(stage) = step.stage {
            bar.set_length(step.total as u64);
            bar.set_position(step.done as u64);
            bar.set_message(stage.name());
            if let Some(session) = printer.session() {
                session.progress(stage.name(), step.done, step.total);
            }
        }
        if stop.wanted() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let done = work(&progress);
    bar.finish_and_clear();
    done
}

/// Prints the result of an assessment whose files are in `out`.
pub(crate) fn print(
    report: &JobReport,
    out: &Path,
    inventory: &Inventory,
    printer: &Printer,
) -> Result<(), Failure> {
    if let Some(session) = printer.session() {
        session.files(&report.files, report.interrupted);
    }
    if let Some(note) = removed_note(&report.removed) {
        printer.note(&note);
    }
    if printer.json() {
        print_json(report, out, inventory, printer)?;
        printer.warn(&report.all_warnings());
    } else {
        printer.print(&text(report))?;
        printer.warn(&report.warnings);
    }
    Ok(())
}

/// Bytes of a document that are printed at once.
const PIECE_BYTES: usize = 1 << 16;

/// The document: a row for each object, as they are in objects.csv, and the summary. Rows are
/// printed one by one, because a million of them do not fit into memory. A program that was sent
/// each row when it was finished can ask for the document without them.
fn print_json(
    report: &JobReport,
    out: &Path,
    inventory: &Inventory,
    printer: &Printer,
) -> Result<(), Failure> {
    if printer
        .session()
        .is_some_and(|session| !session.wants_told_rows())
    {
        return printer.print(&document(SCHEMA, report, &report.all_warnings())?);
    }
    let mut pending = rows_head(SCHEMA)?;
    let mut separator = "\n    ";
    object_rows(out, inventory, |row| {
        let row = serde_json::to_string(row)
            .map_err(|error| Failure::computation(format!("a row is not JSON: {error}")))?;
        pending.push_str(separator);
        pending.push_str(&row);
        separator = ",\n    ";
        if pending.len() > PIECE_BYTES {
            printer.print(&std::mem::take(&mut pending))?;
        }
        Ok::<(), Failure>(())
    })?;
    pending.push_str(&rows_tail(SCHEMA, report, &report.all_warnings())?);
    printer.print(&pending)
}

fn text(report: &JobReport) -> String {
    let mut text = report
        .no_study
        .as_ref()
        .map_or_else(String::new, |no_study| format!("{no_study}\n\n"));
    text.push_str(&format!("{}\n\n", report.place));
    let row = |one: &Decision| {
        vec![
            one.name().to_owned(),
            report.count(*one).to_string(),
            advice(*one).to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = Decision::ALL.iter().map(row).collect();
    text.push_str(&table(&["action", "objects", ""], &rows));
    let done = report.resumed + report.computed;
    text.push_str(&format!(
        "\n{done} of {}",
        counted(report.objects, "object")
    ));
    if report.resumed > 0 {
        text.push_str(&format!(", {} of them from an earlier run", report.resumed));
    }
    text.push_str(&format!(
        "; {}\n",
        counted(report.histories as usize, "rocking history")
    ));
    if report.only_falling > 0 {
        let objects = counted(report.only_falling, "object");
        text.push_str(&format!("{objects} to leave: only falling was assessed\n"));
    }
    if !report.first.is_empty() {
        text.push_str(&format!("\n{}", first(report)));
    }
    if report.failed > 0 || !report.problems.is_empty() {
        text.push_str("\nProblems\n");
    }
    if report.failed > 0 {
        text.push_str(&format!(
            "{} with histories that failed\n",
            counted(report.failed, "object")
        ));
    }
    for problem in &report.problems {
        text.push_str(&format!("{}\n", one_line(&KeyStyle::Flag.shown(problem))));
    }
    if report.interrupted {
        text.push_str("stopped before the end: continue with --resume\n");
    }
    let tables = report.files.iter().filter(|name| *name != "manifest.json");
    let named = tables.map(String::as_str).collect::<Vec<_>>().join(", ");
    text.push_str(&format!("\nFiles in {}: {named}\n", report.out));
    text
}

/// The most urgent objects.
fn first(report: &JobReport) -> String {
    let rows: Vec<Vec<String>> = report
        .first
        .iter()
        .map(|one| {
            vec![
                one.rank.to_string(),
                shorten(&one.id),
                shorten(&one.item),
                shorten(&one.floor),
                one.action.name().to_owned(),
                one.chance.clone(),
                one.force_n
                    .map_or_else(|| "-".to_owned(), |force_n| significant(force_n, 3)),
            ]
        })
        .collect();
    let mut text = table(
        &[
            "rank",
            "id",
            "item",
            "floor",
            "action",
            "probability",
            "force [N]",
        ],
        &rows,
    );
    let done = report.resumed + report.computed;
    if done > report.first.len() {
        text.push_str(&format!(
            "… and {} more: worklist.csv, objects.csv\n",
            done - report.first.len()
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::watched_rows;

    #[test]
    fn who_watches_sees_objects_one_by_one() {
        // The lists of a museum and of a hospital; one of ten thousand rows has 313 parts.
        assert_eq!([1, 21, 200].map(watched_rows), [1, 1, 1]);
        assert_eq!(watched_rows(10_000), 32);
    }
}
