//! `freestand assess`: which objects of an inventory must be restrained.

mod sites;

use std::path::Path;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use clap::Args;
use freestand_app::assess::{Assess, Meant, SCHEMA};
use freestand_app::job::{Beside, Job, Spending, TellRow, Told, assess_telling};
use freestand_assess::portfolio::{Estimate, usual_effort};
use freestand_input::keys::KeyStyle;
use freestand_input::problem::Problems;
use freestand_inventory::{Inventory, problem_reports};
use freestand_output::folder::removed_note;
use freestand_output::json::document;
use freestand_output::streamed::{rows_head, rows_tail};
use freestand_report::assessment::{
    EstimateRow, JobReport, assessment_text, first_estimates, object_rows, time_left, usual_time,
};
use freestand_study::run::{Progress, Step};
use indicatif::ProgressBar;
use serde_json::{Map, Value};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::{Failure, Left};
use crate::printer::Printer;

/// Decide which objects of an inventory to restrain, to put on softer pads or to leave
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/assess.txt").trim_end())]
pub(crate) struct AssessArgs {
    #[command(flatten)]
    pub(in crate::commands) request: Assess,
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
        if let Some(sites) = &meant.sites {
            return sites::tell(&meant, sites, global, printer);
        }
        let study = meant.study()?;
        let inventory = meant.list.inventory(&study)?;
        let budget = meant.budget(&inventory)?;
        let earlier = meant.earlier()?;
        let out = global.folder(FOLDER);
        let job = Job {
            force: global.force,
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
        let finished: Option<TellRow> = printer.session().is_some().then_some(&told);
        let bar = printer.effort_bar();
        if !bar.is_hidden() {
            let effort = usual_effort(&study.assessment, &inventory.items);
            bar.println(usual_time(effort, rayon::current_num_threads()));
        }
        // Printed once: what follows is the bar's.
        let is_first = AtomicBool::new(true);
        let estimates = |estimates: &[Estimate]| {
            if let Some(session) = printer.session() {
                for one in estimates {
                    session.estimate(&EstimateRow::new(one));
                }
            } else if is_first.swap(false, Ordering::Relaxed) && !bar.is_hidden() {
                bar.println(first_estimates(estimates));
            }
        };
        let tell = Told {
            rows: finished,
            estimates: Some(&estimates),
        };
        let report = watched_on(&bar, printer, |progress| {
            let spending = budget.as_ref().map(Spending::Planned);
            let beside = Beside { spending, earlier };
            assess_telling(&study, &inventory, &out, &job, beside, tell, progress)
        })?;
        print(&report, &out, &inventory, printer)?;
        if report.interrupted {
            return Err(Failure::Stopped(Left::Written));
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
    watched_on(&printer.effort_bar(), printer, work)
}

/// The length of a bar that shows the share of the effort.
const BAR: u64 = 1000;

fn watched_on<T>(
    bar: &ProgressBar,
    printer: &Printer,
    work: impl FnOnce(Progress) -> Result<T, Problems>,
) -> Result<T, Problems> {
    let stop = printer.stop();
    bar.set_length(BAR);
    // The stage, and the share that was done when it began or resumed.
    let now = Mutex::new(None);
    let progress = |step: Step| {
        if let Some(stage) = step.stage {
            let share = step.share();
            let mut now = now.lock().unwrap_or_else(PoisonError::into_inner);
            let from = match *now {
                Some((before, from)) if before == stage => from,
                // Each stage has its own speed.
                _ => {
                    bar.reset_elapsed();
                    *now = Some((stage, share));
                    share
                }
            };
            drop(now);
            bar.set_position((BAR as f64 * share) as u64);
            let since = (share - from) / (1.0 - from);
            let left = time_left(since, bar.elapsed().as_secs_f64());
            let left = left.map_or_else(String::new, |left| format!(", {left}"));
            bar.set_message(match step.total {
                0 => stage.name().to_owned(),
                total => format!("{}: {} of {total}{left}", stage.name(), step.done),
            });
            if let Some(session) = printer.session() {
                session.progress(stage.name(), step);
            }
        }
        stop.flow()
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
        printer.print(&assessment_text(report))?;
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
