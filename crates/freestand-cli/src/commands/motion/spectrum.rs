//! `freestand motion spectrum`: the response spectrum of a record.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::oscillator::response_spectrum;
use freestand_study::quantity::Dimension;
use freestand_study::tables::columns_csv;
use freestand_study::{Problem, ProblemKind};
use serde::Serialize;

use crate::args::{GlobalArgs, at_least_one};
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::{ReadArgs, path_text};
use crate::values::Values;

/// Response spectrum of a record (exact for a motion that is linear between samples)
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion spectrum record.AT2
  freestand motion spectrum record.AT2 --damping 2% --periods \"0.1 s, 0.5 s, 1 s\" --json")]
pub(crate) struct SpectrumArgs {
    /// Record file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Damping ratio
    #[arg(long, value_name = "RATIO", default_value = "5 %", allow_hyphen_values = true)]
    damping: String,
    /// Periods, from:to:count or a list [default: 0 and 121 from 0.05 to 5 s]
    #[arg(long, value_name = "GRID", allow_hyphen_values = true)]
    periods: Option<String>,
    /// Look for the peaks at N points in each sample interval
    #[arg(long, value_name = "N", default_value = "1", allow_negative_numbers = true, value_parser = at_least_one)]
    upsample: NonZeroUsize,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct SpectrumReport {
    path: String,
    name: String,
    damping_ratio: f64,
    upsample: usize,
    periods_s: Vec<f64>,
    sd_m: Vec<f64>,
    psv_m_s: Vec<f64>,
    psa_g: Vec<f64>,
    sa_g: Vec<f64>,
}

pub(crate) fn run(args: &SpectrumArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let damping = values.non_negative("--damping", Some(&args.damping), Dimension::Ratio);
    let periods_s = super::periods(args.periods.as_deref(), &mut values);
    values.finish()?;
    let damping_ratio = damping.unwrap_or(0.05);
    let read = args.read.read_one(&args.file)?;
    let factor = upsampling(args.upsample, read.motion.motion.accel_m_s2().len())?;
    let motion = read.motion.motion.upsampled(factor);
    let spectrum = response_spectrum(&motion, damping_ratio, &periods_s).map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string()).hint("damping from 0 to below 1, periods of 0 or more")
    })?;
    let in_g = |values: &[f64]| values.iter().map(|a| a / G0_M_S2).collect::<Vec<f64>>();
    let report = SpectrumReport {
        path: path_text(&args.file),
        name: read.motion.name,
        damping_ratio,
        upsample: factor,
        psa_g: in_g(&spectrum.psa_m_s2),
        sa_g: in_g(&spectrum.sa_m_s2),
        periods_s: spectrum.periods_s,
        sd_m: spectrum.sd_m,
        psv_m_s: spectrum.psv_m_s,
    };
    let files = Files::begin(global, std::slice::from_ref(&args.file))?;
    let columns = columns_csv(&[
        ("period_s", &report.periods_s),
        ("sd_m", &report.sd_m),
        ("psv_m_s", &report.psv_m_s),
        ("psa_g", &report.psa_g),
        ("sa_g", &report.sa_g),
    ])?;
    files.write("spectrum.csv", || columns)?;
    files.print(printer, "freestand.motion-spectrum/1", &report, &read.notes, || text(&report))?;
    Ok(Done::OK)
}

/// The factor, if the motion stays of a size that a computer holds.
pub(crate) fn upsampling(factor: NonZeroUsize, samples: usize) -> Result<usize, Failure> {
    const MOST: usize = 10_000_000;
    if samples.saturating_mul(factor.get()) > MOST {
        return Err(Failure::usage(
            format!("--upsample {factor} makes more than {MOST} samples of {samples}"),
            "10 points in the shortest period are enough for 5 %",
        ));
    }
    Ok(factor.get())
}

fn text(report: &SpectrumReport) -> String {
    let rows: Vec<Vec<String>> = (0..report.periods_s.len())
        .map(|i| {
            vec![
                significant(report.periods_s[i], 4),
                significant(report.sd_m[i], 5),
                significant(report.psv_m_s[i], 5),
                significant(report.psa_g[i], 5),
                significant(report.sa_g[i], 5),
            ]
        })
        .collect();
    table(&["T [s]", "SD [m]", "PSV [m/s]", "PSA [g]", "SA [g]"], &rows)
}
