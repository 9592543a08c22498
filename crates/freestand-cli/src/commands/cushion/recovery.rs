//! `freestand cushion recovery`: how well drop tests recover what virtual ones were made of.

use clap::Args;
use freestand::G0_M_S2;
use freestand::cushion::{ContactLaw, Cushion};
use freestand_input::quantity::Dimension;
use freestand_study::laboratory::virtual_test::{RecoveryRequest, RecoveryRow, recovery};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::printer::{Printer, optional, table};
use crate::values::{Given, Reads, Values};

/// How well drop tests recover stiffness, exponent and damping: bias and coverage over rate, noise, bias, zero shift and law
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion recovery
  freestand cushion recovery --drops 200 --samples-per-contact \"25, 50, 100, 200\" --noise \"0, 0.5 %, 2 %\"

The pads are those of the worked example (0.365 kg from 100 mm): 2190 N/mm; 2e7 N/m^1.5; 2190 N/mm with a damping of 10 %;
2e7 N/m^1.5 with 0.3 s/m. Every drop is one test with an interval of its own, told an impact velocity that is off by 1 %, at
random. A bias of the whole record is taken out with the zero line and must change nothing; a shift at the peak does.")]
pub(crate) struct RecoveryArgs {
    /// Drops in each cell
    #[arg(long, value_name = "N", default_value = "100", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    drops: u32,
    /// Samples per contact
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST", default_value = "25, 50, 200")]
    samples_per_contact: Given<Vec<f64>>,
    /// Noise as a share of the peak
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST", default_value = "0.5 %, 2 %")]
    noise: Given<Vec<f64>>,
    /// Bias of the whole record
    #[arg(long, grid = Dimension::Acceleration, value_name = "LIST", default_value = "0 g, 5 g")]
    bias: Given<Vec<f64>>,
    /// Shift of the zero line at the peak, as a share of it
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST", default_value = "0")]
    zero_shift: Given<Vec<f64>>,
}

#[derive(Debug, Serialize)]
struct Report {
    seed: u64,
    rows: Vec<RecoveryRow>,
}

pub(crate) fn run(args: &RecoveryArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let samples_per_contact = values.read(&args.samples_per_contact).unwrap_or_default();
    let noise_ratios = values.read(&args.noise).unwrap_or_default();
    let biases = values.read(&args.bias).unwrap_or_default();
    let zero_shift_ratios = values.read(&args.zero_shift).unwrap_or_default();
    values.finish()?;
    let in_range = samples_per_contact.iter().all(|n| (2.0..=10_000.0).contains(n));
    if !in_range || noise_ratios.iter().any(|n| !(0.0..=1.0).contains(n)) {
        return Err(Failure::usage(
            "2 to 10000 samples per contact and a noise of 0 to 100 % are expected",
            "write \"25, 50, 200\" and \"0.5 %, 2 %\"",
        ));
    }
    let request = RecoveryRequest {
        cushions: cushions()?,
        samples_per_contact,
        noise_ratios,
        biases_g: biases.iter().map(|bias| bias / G0_M_S2).collect(),
        zero_shift_ratios,
        drops: args.drops as usize,
        mass_kg: MASS_KG,
        speed_m_s: (0.2 * G0_M_S2).sqrt(),
        seed: global.seed.unwrap_or(1),
    };
    let cells = request.cushions.len() * request.samples_per_contact.len() * request.noise_ratios.len();
    let bar = printer.progress_bar(false);
    bar.set_length((cells * request.biases_g.len() * request.zero_shift_ratios.len()) as u64);
    bar.set_message("cells");
    let rows = recovery(&request, &|done| bar.set_position(done as u64));
    bar.finish_and_clear();
    let report = Report { seed: request.seed, rows };
    printer.result("freestand.cushion-recovery/1", &report, &[], || text(&report))?;
    Ok(Done::OK)
}

const MASS_KG: f64 = 0.365;

fn cushions() -> Result<Vec<Cushion>, Failure> {
    let (k, hertz) = (2.19e6_f64, 2e7);
    let laws = [
        ContactLaw::Linear { stiffness_n_m: k },
        ContactLaw::Power { coefficient_n_mn: hertz, exponent: 1.5 },
        ContactLaw::KelvinVoigt { stiffness_n_m: k, damping_n_s_m: 0.2 * (k * MASS_KG).sqrt() },
        ContactLaw::HuntCrossley { coefficient_n_mn: hertz, exponent: 1.5, dissipation_s_m: 0.3 },
    ];
    laws.into_iter().map(|law| Cushion::new(law).map_err(|error| Failure::computation(error.to_string()))).collect()
}

fn text(report: &Report) -> String {
    let headings = [
        "law",
        "samples",
        "noise [%]",
        "bias [g]",
        "shift [%]",
        "given",
        "flagged",
        "k bias [%]",
        "k rms [%]",
        "coverage [%]",
        "n bias",
        "zeta bias",
    ];
    let percent = |value: Option<f64>| optional(value.map(|v| 100.0 * v), 2, "");
    let rows: Vec<Vec<String>> = report
        .rows
        .iter()
        .map(|row| {
            vec![
                row.law.to_owned(),
                row.samples_per_contact.to_string(),
                (100.0 * row.noise_ratio).to_string(),
                row.bias_g.to_string(),
                (100.0 * row.zero_shift_ratio).to_string(),
                row.given.to_string(),
                row.flagged.to_string(),
                percent(row.stiffness_bias_ratio),
                percent(row.stiffness_rms_ratio),
                optional(row.coverage_ratio.map(|v| 100.0 * v), 3, ""),
                optional(row.exponent_bias, 2, ""),
                optional(row.damping_bias, 2, ""),
            ]
        })
        .collect();
    table(&headings, &rows)
}
