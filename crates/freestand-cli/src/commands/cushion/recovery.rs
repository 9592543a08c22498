//! `freestand cushion recovery`: how well the evaluation of drop tests recovers known values.

use clap::Args;
use freestand_app::recovery::{Recovery, SCHEMA};
use freestand_output::answer::Answer;
use freestand_report::cushion::RECOVERED;
use freestand_report::table::facts_table;
use freestand_study::laboratory::virtual_laboratory::{RecoveryRequest, recovery};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Test how well drop tests recover stiffness, exponent and damping, by sampling rate, noise, bias,
/// zero shift and law
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_recovery.txt").trim_end())]
pub(crate) struct RecoveryArgs {
    #[command(flatten)]
    pub(super) request: Recovery,
}

impl Tell for Recovery {
    type Output = ();

    fn tell(
        request: RecoveryRequest,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &[])?;
        let bar = printer.progress_bar(false);
        let cells =
            request.cushions.len() * request.samples_per_contact.len() * request.noise_ratios.len();
        bar.set_length((cells * request.biases_g.len() * request.zero_shift_ratios.len()) as u64);
        bar.set_message("cells");
        let report = recovery(&request, &|done| bar.set_position(done as u64));
        bar.finish_and_clear();
        files.print(printer, SCHEMA, &report, &[], || {
            facts_table(report.rows.iter().map(Answer::facts), &RECOVERED)
        })?;
        Ok(Done::OK)
    }
}
