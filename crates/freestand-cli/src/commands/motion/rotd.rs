//! `freestand motion rotd`: response spectra over all horizontal directions.

use std::collections::BTreeMap;

use clap::Args;
use freestand::G0_M_S2;
use freestand::signal::rotate::{Pair, directional_spectrum};
use freestand_study::processing::{not_perpendicular, process_pair};
use freestand_study::quantity::Dimension;
use freestand_study::tables::columns_csv;
use freestand_study::{Problem, ProblemKind};
use serde::Serialize;

use super::pair::PairArgs;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::path_text;
use crate::values::Values;

/// Response spectra over all horizontal directions (RotDnn), larger and geometric mean of two components
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion rotd record.v2 --periods \"0.05 s:3 s:60\"
  freestand motion rotd north.AT2 east.AT2 --percentiles \"0, 50, 100\" --damping 2% --json")]
pub(crate) struct RotdArgs {
    #[command(flatten)]
    pair: PairArgs,
    /// Percentiles over the directions: 50 is the median, 100 the largest
    #[arg(long, value_name = "LIST", default_value = "50, 100", allow_hyphen_values = true)]
    percentiles: String,
    /// Damping ratio
    #[arg(long, value_name = "RATIO", default_value = "5 %", allow_hyphen_values = true)]
    damping: String,
    /// Periods, from:to:count or a list [default: 0 and 121 from 0.05 to 5 s]
    #[arg(long, value_name = "GRID", allow_hyphen_values = true)]
    periods: Option<String>,
}

#[derive(Debug, Serialize)]
struct RotdReport {
    paths: Vec<String>,
    components: [String; 2],
    damping_ratio: f64,
    periods_s: Vec<f64>,
    /// `rotd50_g` and so on.
    #[serde(flatten)]
    rotd_g: BTreeMap<String, Vec<f64>>,
    first_g: Vec<f64>,
    second_g: Vec<f64>,
    larger_g: Vec<f64>,
    geometric_mean_g: Vec<f64>,
    /// What was done to each component, one step each.
    processing: [Vec<String>; 2],
}

pub(crate) fn run(args: &RotdArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let damping = values.non_negative("--damping", Some(&args.damping), Dimension::Ratio);
    let periods_s = super::periods(args.periods.as_deref(), &mut values);
    let percentiles = values.grid("--percentiles", &args.percentiles, Dimension::Ratio).unwrap_or_default();
    values.finish()?;
    let read = args.pair.read()?;
    let (first, second) = read.components()?;
    let (one, two) = process_pair(first, second, &read.processing)?;
    let mut warnings = read.notes.clone();
    warnings.extend(not_perpendicular(first, second));
    let damping_ratio = damping.unwrap_or(0.05);
    let spectrum = Pair::new(&one.motion, &two.motion)
        .and_then(|pair| directional_spectrum(&pair, damping_ratio, &periods_s, &percentiles))
        .map_err(|error| {
            Problem::new(ProblemKind::Value, error.to_string())
                .hint("damping from 0 to below 1, periods of 0 or more, percentiles from 0 to 100, one time step")
        })?;
    let in_g = |values: &[f64]| values.iter().map(|a| a / G0_M_S2).collect::<Vec<f64>>();
    let report = RotdReport {
        paths: args.pair.files.iter().map(|path| path_text(path)).collect(),
        components: [first.name.clone(), second.name.clone()],
        damping_ratio,
        rotd_g: percentiles.iter().map(|nn| key(*nn)).zip(spectrum.rotd_m_s2.iter().map(|row| in_g(row))).collect(),
        first_g: in_g(&spectrum.first_m_s2),
        second_g: in_g(&spectrum.second_m_s2),
        larger_g: in_g(&spectrum.larger_m_s2),
        geometric_mean_g: in_g(&spectrum.geometric_mean_m_s2),
        processing: [one.steps, two.steps],
        periods_s,
    };
    let files = Files::begin(global, &args.pair.files)?;
    let columns = columns(&report);
    let csv = columns_csv(&columns)?;
    files.write("rotd.csv", || csv)?;
    files.print(printer, "freestand.motion-rotd/1", &report, &warnings, || text(&columns))?;
    Ok(Done::OK)
}

/// `rotd50_g`.
fn key(percentile: f64) -> String {
    format!("rotd{percentile}_g")
}

fn columns(report: &RotdReport) -> Vec<(&str, &[f64])> {
    let mut columns: Vec<(&str, &[f64])> = vec![("period_s", &report.periods_s)];
    columns.extend(report.rotd_g.iter().map(|(name, values)| (name.as_str(), values.as_slice())));
    columns.extend([
        ("larger_g", report.larger_g.as_slice()),
        ("geometric_mean_g", &report.geometric_mean_g),
        ("first_g", &report.first_g),
        ("second_g", &report.second_g),
    ]);
    columns
}

fn text(columns: &[(&str, &[f64])]) -> String {
    let headings: Vec<String> = columns.iter().map(|(name, _)| heading(name)).collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let length = columns.first().map_or(0, |(_, values)| values.len());
    let rows: Vec<Vec<String>> = (0..length)
        .map(|row| columns.iter().filter_map(|(_, values)| values.get(row)).map(|v| significant(*v, 4)).collect())
        .collect();
    table(&headings, &rows)
}

/// `rotd50_g` as `rotd50 [g]`.
fn heading(name: &str) -> String {
    name.rsplit_once('_').map_or_else(|| name.to_owned(), |(name, unit)| format!("{} [{unit}]", name.replace('_', " ")))
}
