//! `freestand cushion recovery`: how well the evaluation of drop tests recovers known values.

use clap::Args;
use freestand_app::recovery::{Recovery, SCHEMA};
use freestand_output::answer::Answer;
use freestand_study::laboratory::virtual_laboratory::{RecoveryRequest, recovery};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, facts_table};

/// Test how well drop tests recover stiffness, exponent and damping, by sampling rate, noise, bias,
/// zero shift and law
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion recovery
  freestand cushion recovery --drops 200 --samples-per-contact \"25, 50, 100, 200\" \\
    --noise \"0, 0.5 %, 2 %\"

The pads, under 0.365 kg from 100 mm: 2190 N/mm; 2e7 N/m^1.5; 2190 N/mm with a damping of 10 %;
2e7 N/m^1.5 with 0.3 s/m; and two that follow no law of the fit: a tangent of 1000 N/mm that bottoms
at 1.5 mm, and straight lines through 0.36 kN at 0.3 mm, 1.2 kN at 0.6 mm and 3 kN at 1 mm. Every drop is evaluated alone, with its own interval; the impact velocity
given to the evaluation has a random error of 1 %. A bias of the whole record is removed with the
zero line and must not change the result; a shift at the peak changes it.")]
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
            facts_table(report.rows.iter().map(Answer::facts), &COLUMNS)
        })?;
        Ok(Done::OK)
    }
}

const COLUMNS: [Column; 12] = [
    ("law", "law", 0),
    ("samples_per_contact", "samples", 0),
    ("noise_ratio", "noise [%]", 0),
    ("bias_g", "bias [g]", 0),
    ("zero_shift_ratio", "zero shift [%]", 0),
    ("given", "given", 0),
    ("flagged", "flagged", 0),
    ("stiffness_bias_ratio", "stiffness bias [%]", 2),
    ("stiffness_rms_ratio", "stiffness rms [%]", 2),
    ("coverage_ratio", "coverage [%]", 3),
    ("exponent_bias", "exponent bias", 2),
    ("damping_bias", "damping bias", 2),
];
