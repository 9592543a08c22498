//! `freestand motion spectrum`: the response spectrum of a record.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Dimension;
use freestand_study::inspect::{SpectrumReport, SpectrumRequest, spectrum};
use serde::Serialize;

use super::plot::{PlotArgs, failed, place};
use crate::args::{GlobalArgs, at_least_one};
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::values::Values;

/// Response spectrum of a record (exact for a motion that is linear between samples)
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion spectrum record.AT2
  freestand motion spectrum record.AT2 --damping \"2 %, 5 %\" --plot spectrum.svg
  freestand motion spectrum record.AT2 --upsample 10 --periods \"0.02 s, 0.05 s, 0.1 s\" --json")]
pub(crate) struct SpectrumArgs {
    /// Record file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Damping ratio, or a list of them
    #[arg(long, value_name = "RATIO", default_value = "5 %", allow_hyphen_values = true)]
    damping: String,
    /// Periods, from:to:count or a list [default: 0 and 121 from 0.05 to 5 s]
    #[arg(long, value_name = "GRID", allow_hyphen_values = true)]
    periods: Option<String>,
    /// N samples in place of each, on the band-limited curve through them (for periods below ten steps)
    #[arg(long, value_name = "N", default_value = "1", allow_negative_numbers = true, value_parser = at_least_one)]
    upsample: NonZeroUsize,
    #[command(flatten)]
    plot: PlotArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a SpectrumReport,
    /// The pictures that were written.
    plots: Vec<String>,
}

pub(crate) fn run(args: &SpectrumArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let damping_ratios = values.grid("--damping", &args.damping, Dimension::Ratio).unwrap_or_default();
    if let Some(negative) = damping_ratios.iter().find(|ratio| **ratio < 0.0) {
        let problem = Problem::new(ProblemKind::Value, format!("--damping: {negative} is below zero"));
        values.push(problem.hint("damping from 0 to below 1"));
    }
    let periods_s = super::periods(args.periods.as_deref(), &mut values);
    values.finish()?;
    let target = args.plot.target(global)?;
    let read = args.read.read_one(&args.file)?;
    let report = spectrum(&read, &SpectrumRequest { damping_ratios, periods_s, upsample: args.upsample.get() })?;
    let inputs = args.read.inputs([&args.file]);
    let files = Files::begin(global, &inputs)?;
    let columns = report.csv()?;
    files.write("spectrum.csv", || columns)?;
    let mut plots = Vec::new();
    if let Some(target) = target {
        let figure = report.figure().map_err(failed)?;
        plots = place(&target, vec![(figure.name.clone(), figure)], &files, &inputs)?;
    }
    let document = Document { report: &report, plots };
    files.print(printer, "freestand.motion-spectrum/1", &document, &report.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn text(report: &SpectrumReport) -> String {
    let several = !report.more.is_empty();
    let mut headings = vec!["T [s]", "SD [m]", "PSV [m/s]", "PSA [g]", "SA [g]"];
    headings.extend(several.then_some("damping"));
    let mut rows = Vec::new();
    for one in report.all() {
        for (i, &period_s) in report.periods_s.iter().enumerate() {
            let mut row: Vec<String> = [one.sd_m[i], one.psv_m_s[i], one.psa_g[i], one.sa_g[i]]
                .iter()
                .map(|&value| significant(value, 5))
                .collect();
            row.insert(0, significant(period_s, 4));
            row.extend(several.then(|| one.damping_ratio.to_string()));
            rows.push(row);
        }
    }
    table(&headings, &rows)
}
