//! `freestand assess --sites`: several lists, each in its place and building.

use std::path::Path;

use freestand_app::assess::Meant;
use freestand_app::assess::sites::{self, Sites};
use freestand_app::job::{Job, SITES_SCHEMA, SiteRun, assess_sites};
use freestand_output::folder::removed_note;
use freestand_output::streamed::{rows_head, rows_tail};
use freestand_report::assessment::{SitesReport, object_rows, sites_text};
use serde_json::{Map, Value};

use super::super::Done;
use super::{FOLDER, watched};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// Assesses all sites.
pub(super) fn tell(
    meant: &Meant,
    sites: &Sites,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let run = sites::read(sites)?;
    let out = global.folder(FOLDER);
    let job = Job {
        force: global.force,
        ..meant.job
    };
    let report = watched(printer, |progress| assess_sites(&run, &out, &job, progress))?;
    if let Some(note) = removed_note(&report.removed) {
        printer.note(&note);
    }
    if printer.json() {
        print_json(&report, &out, &run.sites, printer)?;
    } else {
        printer.print(&sites_text(&report))?;
    }
    printer.warn(&report.all_warnings());
    let count = |decision| {
        report
            .sites
            .iter()
            .map(|one| one.report.count(decision))
            .sum::<u64>()
    };
    let is_named = meant.fail_on.iter().any(|decision| count(*decision) > 0);
    let failed = report.sites.iter().any(|one| one.report.failed > 0);
    let has_errors = run.sites.iter().any(|site| site.inventory.has_errors());
    Ok(Done {
        criterion_met: !(failed || has_errors || is_named),
    })
}

/// The document: the rows of all sites, each with its site first, and the summary.
fn print_json(
    report: &SitesReport,
    out: &Path,
    runs: &[SiteRun],
    printer: &Printer,
) -> Result<(), Failure> {
    printer.print(&rows_head(SITES_SCHEMA)?)?;
    let mut separator = "\n    ";
    for run in runs {
        object_rows(&out.join(&run.name), &run.inventory, |row| {
            let mut all = Map::new();
            all.insert("site".to_owned(), Value::from(run.name.as_str()));
            all.extend(
                row.iter()
                    .map(|(name, value)| (name.clone(), value.clone())),
            );
            let row = serde_json::to_string(&all)
                .map_err(|error| Failure::computation(format!("a row is not JSON: {error}")))?;
            printer.print(&format!("{separator}{row}"))?;
            separator = ",\n    ";
            Ok::<(), Failure>(())
        })?;
    }
    printer.print(&rows_tail(SITES_SCHEMA, report, &report.all_warnings())?)
}
