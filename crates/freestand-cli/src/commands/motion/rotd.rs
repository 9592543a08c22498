//! `freestand motion rotd`: response spectra over all horizontal directions.

use clap::Args;
use freestand_app::motion::Meant;
use freestand_app::pair::{ROTD, Rotd};
use freestand_study::inspect::{RotdReport, rotd};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};

/// Calculate response spectra over all horizontal directions (RotDnn)
///
/// Also gives the larger and the geometric mean of the two components.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion rotd record.v2 --periods \"0.05 s:3 s:60\"
  freestand motion rotd north.AT2 east.AT2 --percentiles \"0, 50, 100\" --damping 2% --json")]
pub(crate) struct RotdArgs {
    #[command(flatten)]
    pub(super) request: Rotd,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for Rotd {
    type Output = TableArgs;

    fn tell(
        Meant {
            asked: (read, request),
            inputs,
        }: Self::Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let report = rotd(&read, &request)?;
        let files = Files::with_tables(global, &inputs, tables, ROTD, None)?;
        files.table("rotd", || report.table())?;
        files.print(printer, ROTD, &report, &report.warnings, || text(&report))?;
        Ok(Done::OK)
    }
}

fn text(report: &RotdReport) -> String {
    let columns = report.columns();
    let headings: Vec<String> = columns.iter().map(|(name, _)| heading(name)).collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let rows: Vec<Vec<String>> = (0..report.periods_s.len())
        .map(|row| {
            columns
                .iter()
                .filter_map(|(_, values)| values.get(row))
                .map(|v| significant(*v, 4))
                .collect()
        })
        .collect();
    table(&headings, &rows)
}

/// The heading of a column: `rotd50 [g]` for `rotd50_g`.
fn heading(name: &str) -> String {
    name.rsplit_once('_').map_or_else(
        || name.to_owned(),
        |(name, unit)| format!("{} [{unit}]", name.replace('_', " ")),
    )
}
