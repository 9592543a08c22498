//! `freestand motion rotd`: response spectra over all horizontal directions.

use clap::Args;
use freestand::synthesis::DAMPING_RATIO;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_study::inspect::{RotdReport, RotdRequest, rotd};
use freestand_study::pair::read_pair;

use super::pair::PairArgs;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};
use crate::values::{Given, Reads, Values};

/// Calculate response spectra over all horizontal directions (RotDnn)
///
/// Also gives the larger and the geometric mean of the two components.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion rotd record.v2 --periods \"0.05 s:3 s:60\"
  freestand motion rotd north.AT2 east.AT2 --percentiles \"0, 50, 100\" --damping 2% --json")]
// Two components have no common factor to a target: these flags are known only to be refused with
// a hint.
#[command(
    mut_arg("scale_to", |arg| arg.hide(true)),
    mut_arg("scale_to_sa", |arg| arg.hide(true)),
    mut_arg("scale_to_spectrum", |arg| arg.hide(true))
)]
pub(crate) struct RotdArgs {
    #[command(flatten)]
    pair: PairArgs,
    /// Percentiles over the directions: 50 is the median, 100 the largest
    #[arg(long, value_name = "LIST", read = percentiles, default_value = "50, 100")]
    percentiles: Given<Vec<f64>>,
    /// Damping ratio [default: 5 %]
    #[arg(long, non_negative = Dimension::Ratio)]
    damping: Option<Given>,
    /// Periods: from:to:count or a list [default: 0 s and 121 from 0.05 s to 5 s]
    #[arg(long, grid = Dimension::Time)]
    periods: Option<Given<Vec<f64>>>,
    #[command(flatten)]
    tables: TableArgs,
}

const SCHEMA: &str = "freestand.motion-rotd/1";

pub(crate) fn run(
    args: &RotdArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let damping = values.read(&args.damping);
    let periods_s = super::periods(&args.periods, &mut values);
    let percentiles = values.read(&args.percentiles).unwrap_or_default();
    let pair = args.pair.request(&mut values);
    values.finish()?;
    let read = read_pair(&pair)?;
    let report = rotd(
        &read,
        &RotdRequest {
            damping_ratio: damping.unwrap_or(DAMPING_RATIO),
            periods_s,
            percentiles,
        },
    )?;
    let files = Files::with_tables(global, &args.pair.inputs(), &args.tables, SCHEMA, None)?;
    files.table("rotd", || report.table())?;
    files.print(printer, SCHEMA, &report, &report.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn percentiles(text: &str) -> Result<Vec<f64>, Problem> {
    parse_grid(&text.replace('%', ""), Dimension::Ratio)
}

fn text(report: &RotdReport) -> String {
    let columns = report.columns();
    let headings: Vec<String> = columns.iter().map(|(name, _)| heading(name)).collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let rows: Vec<Vec<String>> = (0..report.periods_s.len())
        .map(|row| {
            columns
                .iter()
                .filter_map(|(_, values)| values.get(row))
                .map(|v| significant(*v, 4))
                .collect()
        })
        .collect();
    table(&headings, &rows)
}

/// The heading of a column: `rotd50 [g]` for `rotd50_g`.
fn heading(name: &str) -> String {
    name.rsplit_once('_').map_or_else(
        || name.to_owned(),
        |(name, unit)| format!("{} [{unit}]", name.replace('_', " ")),
    )
}
