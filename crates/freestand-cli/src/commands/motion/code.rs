//! `freestand motion code-spectrum`: the spectrum of a code, and its accelerations of parts on
//! floors.

use clap::Args;
use freestand_input::quantity::Dimension;
use freestand_study::target::{CodeSpectrumReport, code_spectrum, code_spectrum_figure};

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};
use crate::target::TargetArgs;
use crate::values::{Given, Reads, Values};

/// Show the elastic response spectrum of a design code, for 5 % damping
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion code-spectrum --site De --city Melbourne
  freestand motion code-spectrum --site Ce --hazard-factor 0.11 --return-period 2500 \\
    --periods \"0 s, 0.5 s, 1 s\" --json
  freestand motion code-spectrum --code eurocode8 --spectrum-type 2 --site B \\
    --ground-acceleration 0.1g --parts
  freestand motion code-spectrum --code nzs1170.5 --site C --hazard-factor 0.4 --parts \\
    --building-height \"30 m\" --out wellington")]
pub(crate) struct CodeSpectrumArgs {
    #[command(flatten)]
    target: TargetArgs,
    /// Periods: from:to:count or a list [default: 0 s, 121 from 0.05 s to 5 s, corners of the code]
    #[arg(long, grid = Dimension::Time)]
    periods: Option<Given<Vec<f64>>>,
    /// Add the acceleration that the code prescribes for a rigid part on each floor
    #[arg(long, help_heading = "Parts and components")]
    parts: bool,
    /// Height of the building; needed by AS 1170.4 and NZS 1170.5
    #[arg(long, positive = Dimension::Length, requires = "parts", help_heading = "Parts and components")]
    building_height: Option<Given>,
    /// Fundamental period of the building, used by ASCE 7-22 [default: unknown]
    #[arg(long, positive = Dimension::Time, requires = "parts", help_heading = "Parts and components")]
    building_period: Option<Given>,
    #[command(flatten)]
    tables: TableArgs,
}

const SCHEMA: &str = "freestand.code-spectrum/1";

pub(crate) fn run(
    args: &CodeSpectrumArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let target = args.target.target()?;
    let mut values = Values::default();
    let periods_s = values.read(&args.periods);
    let building = (
        values.read(&args.building_height),
        values.read(&args.building_period),
    );
    values.finish()?;
    let report = code_spectrum(&target, periods_s, args.parts.then_some(building))?;
    let files = Files::with_tables(global, &args.target.inputs(), &args.tables, SCHEMA, None)?;
    files.table("spectrum", || report.table())?;
    files.figure("spectrum", || code_spectrum_figure(&report))?;
    files.print(printer, SCHEMA, &report, &target.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn text(report: &CodeSpectrumReport) -> String {
    let mut headings = vec!["T [s]", "Sa [g]"];
    headings.extend(report.vertical_sa_g.as_ref().map(|_| "vertical [g]"));
    let row = |i: usize| {
        let vertical = report
            .vertical_sa_g
            .as_ref()
            .and_then(|values| values.get(i));
        let values = report.sa_g.get(i).into_iter().chain(vertical);
        let period = report
            .periods_s
            .get(i)
            .map(|&period| significant(period, 4));
        period
            .into_iter()
            .chain(values.map(|&sa| significant(sa, 5)))
            .collect()
    };
    let rows: Vec<Vec<String>> = (0..report.periods_s.len()).map(row).collect();
    let mut text = format!("{}\n{}", report.title, table(&headings, &rows));
    if let Some(parts) = &report.parts {
        let rows: Vec<Vec<String>> = parts
            .levels
            .iter()
            .map(|level| {
                let height = level
                    .height_m
                    .map_or_else(|| "–".to_owned(), |height| significant(height, 4));
                vec![
                    significant(level.level_ratio, 2),
                    height,
                    significant(level.floor_acceleration_g, 4),
                ]
            })
            .collect();
        text.push_str(&format!(
            "\n{}\n{}",
            parts.clause,
            table(&["z/h", "z [m]", "floor [g]"], &rows)
        ));
    }
    text
}
