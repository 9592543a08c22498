//! `freestand cushion recovery`: how well the evaluation of drop tests recovers known values.

use clap::Args;
use freestand::G0_M_S2;
use freestand_input::quantity::Dimension;
use freestand_output::answer::Answer;
use freestand_study::laboratory::virtual_laboratory::{RecoveryRequest, recovery};

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::printer::{Column, Printer, facts_table};
use crate::values::{Given, Reads, Values};

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
    /// Number of drops for each combination [default: 100]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    drops: Option<u32>,
    /// Samples per contact [default: 25, 50, 200]
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST")]
    samples_per_contact: Option<Given<Vec<f64>>>,
    /// Noise as a share of the peak [default: 0.5 %, 2 %]
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST")]
    noise: Option<Given<Vec<f64>>>,
    /// Bias of the whole record [default: 5 g]
    #[arg(long, grid = Dimension::Acceleration, value_name = "LIST")]
    bias: Option<Given<Vec<f64>>>,
    /// Shift of the zero line at the peak, as a share of the peak [default: 0]
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST")]
    zero_shift: Option<Given<Vec<f64>>>,
}

pub(crate) fn run(
    args: &RecoveryArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let usual = RecoveryRequest::worked_example()?;
    let biases_g = values
        .read(&args.bias)
        .map(|biases| biases.iter().map(|bias| bias / G0_M_S2).collect());
    let request = RecoveryRequest {
        samples_per_contact: values
            .read(&args.samples_per_contact)
            .unwrap_or(usual.samples_per_contact),
        noise_ratios: values.read(&args.noise).unwrap_or(usual.noise_ratios),
        biases_g: biases_g.unwrap_or(usual.biases_g),
        zero_shift_ratios: values
            .read(&args.zero_shift)
            .unwrap_or(usual.zero_shift_ratios),
        drops: args.drops.map_or(usual.drops, |drops| drops as usize),
        seed: global.seed(),
        ..usual
    };
    values.finish()?;
    let in_range = request
        .samples_per_contact
        .iter()
        .all(|n| (2.0..=10_000.0).contains(n));
    if !in_range
        || request
            .noise_ratios
            .iter()
            .any(|n| !(0.0..=1.0).contains(n))
    {
        return Err(Failure::usage(
            "2 to 10000 samples per contact and a noise of 0 to 100 % are expected",
            "write \"25, 50, 200\" and \"0.5 %, 2 %\"",
        ));
    }
    let cells =
        request.cushions.len() * request.samples_per_contact.len() * request.noise_ratios.len();
    let bar = printer.progress_bar(false);
    bar.set_length((cells * request.biases_g.len() * request.zero_shift_ratios.len()) as u64);
    bar.set_message("cells");
    let report = recovery(&request, &|done| bar.set_position(done as u64));
    bar.finish_and_clear();
    printer.result("freestand.cushion-recovery/1", &report, &[], || {
        facts_table(report.rows.iter().map(Answer::facts), &COLUMNS)
    })?;
    Ok(Done::OK)
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
