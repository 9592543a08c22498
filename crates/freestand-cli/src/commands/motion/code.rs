//! `freestand motion code-spectrum`: the spectrum of a code, and its accelerations of parts on
//! floors.

use clap::Args;
use freestand_app::code_spectrum::{CodeSpectrum, Meant, SCHEMA};
use freestand_report::doubts::target_doubt;
use freestand_report::figures::code_spectrum_figure;
use freestand_report::motion::code_spectrum_text;
use freestand_report::target::CodeSpectrumAnswer;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Show the elastic response spectrum of a design code, for 5 % damping
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_code_spectrum.txt").trim_end())]
pub(crate) struct CodeSpectrumArgs {
    #[command(flatten)]
    pub(super) request: CodeSpectrum,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for CodeSpectrum {
    type Output = TableArgs;

    fn tell(
        meant: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let report = meant.report()?;
        let files = Files::with_tables(global, &meant.inputs, tables, SCHEMA, None)?;
        files.table("spectrum", || report.table())?;
        files.figure("spectrum", || code_spectrum_figure(&report))?;
        let doubts = meant.target.doubts.iter();
        let warnings: Vec<String> = doubts.map(target_doubt).collect();
        files.print(
            printer,
            SCHEMA,
            &CodeSpectrumAnswer(&report),
            &warnings,
            || code_spectrum_text(&report),
        )?;
        Ok(Done::OK)
    }
}
