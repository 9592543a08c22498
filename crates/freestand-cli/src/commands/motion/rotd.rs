//! `freestand motion rotd`: response spectra over all horizontal directions.

use clap::Args;
use freestand_app::motion::Meant;
use freestand_app::pair::{ROTD, Rotd};
use freestand_report::doubts::motion_doubts;
use freestand_report::motion::rotd_text;
use freestand_study::inspect::rotd;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Calculate response spectra over all horizontal directions (RotDnn)
///
/// Also gives the larger and the geometric mean of the two components.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_rotd.txt").trim_end())]
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
        files.print(
            printer,
            ROTD,
            &report,
            &motion_doubts(&report.doubts),
            || rotd_text(&report),
        )?;
        Ok(Done::OK)
    }
}
