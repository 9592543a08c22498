//! `freestand fragility`: how likely objects rock, are damaged and overturn at an intensity.

use clap::Args;
use freestand_app::fragility::{Fitted, Fragility, Meant, SCHEMA};
use freestand_output::json::document;
use freestand_report::figures::curves_figure;
use freestand_report::fragility::{FragilityAnswer, curves_text, warnings};
use freestand_risk::export::ExportRequest;
use freestand_risk::fragility::{FragilityRequest, fragility};

use super::assess::watched;
use super::exports::{Exported, write};
use super::{Done, Tell, fragility_runs};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Calculate fragilities: how likely it is that an object rocks, is damaged or overturns
///
/// The command runs objects under motions at many scales and fits curves to the outcomes. Give one
/// object by its size with --motion, or the objects of an inventory on the floors of a study. With
/// --outcomes, a table has the outcomes, and the command only fits the curves.
///
/// A table of outcomes has one row per run, with the headings object, motion, pfv [m/s], outcome
/// (no-uplift, rocked, exceeded or overturned), or one row of counts per level, with object, pfv
/// [m/s], no_uplift, rocked, exceeded, overturned. The measure is one of pga [g], pgv [m/s], pfa
/// [g], pfv [m/s], sa(0.5) [g], sa_avg(0.2:2) [g], velocity_ratio and acceleration_ratio.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/fragility.txt").trim_end())]
pub(crate) struct FragilityArgs {
    #[command(flatten)]
    pub(super) request: Fragility,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for Fragility {
    type Output = TableArgs;

    fn tell(
        meant: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        if !meant.exports.is_empty() && global.out.is_none() {
            return Err(Failure::usage(
                "--format writes a folder, and --out is not given",
                "give --out DIR",
            ));
        }
        let seed = Some(global.seed());
        let files = Files::with_tables(global, &meant.inputs, tables, SCHEMA, seed)?;
        match meant.fitted {
            Fitted::Outcomes(request) => fit(request, &meant.exports, files, printer),
            Fitted::Runs(runs) => {
                fragility_runs::run(*runs, &meant.exports, files, global, printer)
            }
        }
    }
}

/// The fit of a table of outcomes.
fn fit(
    request: FragilityRequest,
    exports: &[ExportRequest],
    files: Files,
    printer: &Printer,
) -> Result<Done, Failure> {
    // Made before the fits, so that no signal is missed between them and the files.
    let stop = printer.stop();
    let found = watched(printer, |progress| fragility(request, progress));
    let report = found?;
    // Before anything is written, so that what cannot be exported leaves no folder.
    let exported = Exported::of(&report, exports)?;
    let warnings = [warnings(&report), exported.warnings].concat();
    if files.wanted() {
        files.table("fragility", || report.table())?;
        stop.go_on()?;
        files.table("empirical", || report.empirical_table())?;
        stop.go_on()?;
        let json = document(SCHEMA, &FragilityAnswer(&report), &warnings)?;
        files.write("fragility.json", || json)?;
        stop.go_on()?;
        files.figure("fragility", || curves_figure(&report))?;
        stop.go_on()?;
        write(exported.files, &files)?;
    }
    files.finish_result(SCHEMA, &warnings)?;
    let answer = FragilityAnswer(&report);
    printer.result(SCHEMA, &answer, &warnings, || curves_text(&report))?;
    Ok(Done::OK)
}
