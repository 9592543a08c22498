//! `freestand motion spectrum`: the response spectrum of a record.

use clap::Args;
use freestand_app::motion::{Meant, MotionSpectrum, SPECTRUM, SpectrumAnswer};
use freestand_study::inspect::{SpectrumReport, spectrum};

use super::info::Output;
use super::plot::place;
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};

/// Calculate the response spectrum of a record, exact for a motion that is linear between samples
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion spectrum record.AT2
  freestand motion spectrum record.AT2 --damping \"2 %, 5 %\" --plot spectrum.svg
  freestand motion spectrum record.AT2 --upsample 10 --periods \"0.02 s, 0.05 s, 0.1 s\" --json")]
pub(crate) struct SpectrumArgs {
    #[command(flatten)]
    pub(super) request: MotionSpectrum,
    #[command(flatten)]
    pub(super) output: Output,
}

impl Tell for MotionSpectrum {
    type Output = Output;

    fn tell(
        Meant {
            asked: (read, request),
            inputs,
        }: Self::Meant,
        output: &Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let target = output.plot.target(global)?;
        let report = spectrum(&read, &request)?;
        let files = Files::with_tables(global, &inputs, &output.tables, SPECTRUM, None)?;
        files.table("spectrum", || report.table())?;
        let mut plots = Vec::new();
        if let Some(target) = target {
            let figure = report.figure()?;
            let figures = vec![(figure.name.clone(), figure)];
            plots = place(&target, figures, &files, &inputs)?;
        }
        let document = SpectrumAnswer {
            report: &report,
            plots,
        };
        files.print(printer, SPECTRUM, &document, &report.warnings, || {
            text(&report)
        })?;
        Ok(Done::OK)
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
