//! `freestand motion spectrum`: the response spectrum of a record.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use freestand::synthesis::DAMPING_RATIO;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_study::inspect::{SpectrumReport, SpectrumRequest, spectrum};
use serde::Serialize;

use super::plot::{PlotArgs, place};
use crate::args::{GlobalArgs, at_least_one};
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::values::{Given, Reads, Values};

/// Calculate the response spectrum of a record, exact for a motion that is linear between samples
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion spectrum record.AT2
  freestand motion spectrum record.AT2 --damping \"2 %, 5 %\" --plot spectrum.svg
  freestand motion spectrum record.AT2 --upsample 10 --periods \"0.02 s, 0.05 s, 0.1 s\" --json")]
pub(crate) struct SpectrumArgs {
    /// Record
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Damping ratio, or a list of ratios [default: 5 %]
    #[arg(long, value_name = "RATIO", read = dampings)]
    damping: Option<Given<Vec<f64>>>,
    /// Periods: from:to:count or a list [default: 0 s and 121 from 0.05 s to 5 s]
    #[arg(long, grid = Dimension::Time)]
    periods: Option<Given<Vec<f64>>>,
    /// Replace each sample by N on the band-limited curve through the samples, for periods shorter
    /// than ten time steps
    #[arg(long, value_name = "N", default_value = "1", value_parser = at_least_one)]
    upsample: NonZeroUsize,
    #[command(flatten)]
    plot: PlotArgs,
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a SpectrumReport,
    /// The figures that were written.
    plots: Vec<String>,
}

const SCHEMA: &str = "freestand.motion-spectrum/1";

pub(crate) fn run(
    args: &SpectrumArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let damping_ratios = values
        .read(&args.damping)
        .unwrap_or_else(|| vec![DAMPING_RATIO]);
    let periods_s = super::periods(&args.periods, &mut values);
    values.finish()?;
    let target = args.plot.target(global)?;
    let read = args.read.read_one(&args.file, ReadArgs::read_any)?;
    let report = spectrum(
        &read,
        &SpectrumRequest {
            damping_ratios,
            periods_s,
            upsample: args.upsample.get(),
        },
    )?;
    let inputs = args.read.inputs([&args.file]);
    let files = Files::with_tables(global, &inputs, &args.tables, SCHEMA, None)?;
    files.table("spectrum", || report.table())?;
    let mut plots = Vec::new();
    if let Some(target) = target {
        let figure = report.figure()?;
        plots = place(
            &target,
            vec![(figure.name.clone(), figure)],
            &files,
            &inputs,
        )?;
    }
    let document = Document {
        report: &report,
        plots,
    };
    files.print(printer, SCHEMA, &document, &report.warnings, || {
        text(&report)
    })?;
    Ok(Done::OK)
}

fn dampings(text: &str) -> Result<Vec<f64>, Problem> {
    let ratios = parse_grid(text, Dimension::Ratio)?;
    match ratios.iter().find(|ratio| **ratio < 0.0) {
        Some(negative) => Err(Problem::value(
            format!("{negative} is below zero"),
            "damping from 0 to below 1",
        )),
        None => Ok(ratios),
    }
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
