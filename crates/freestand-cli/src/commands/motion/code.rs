//! `freestand motion code-spectrum`: the spectrum of a code, and its accelerations of parts on
//! floors.

use clap::Args;
use freestand_app::code_spectrum::{CodeSpectrum, Meant, SCHEMA};
use freestand_study::target::{CodeSpectrumReport, code_spectrum_figure};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};

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
    pub(super) request: CodeSpectrum,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for CodeSpectrum {
    type Output = TableArgs;

    fn tell(
        meant: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let report = meant.report()?;
        let files = Files::with_tables(global, &meant.inputs, tables, SCHEMA, None)?;
        files.table("spectrum", || report.table())?;
        files.figure("spectrum", || code_spectrum_figure(&report))?;
        let warnings = &meant.target.warnings;
        files.print(printer, SCHEMA, &report, warnings, || text(&report))?;
        Ok(Done::OK)
    }
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
    let mut text = format!("{}\n{}", report.target.one_line(), table(&headings, &rows));
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
