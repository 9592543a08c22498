//! `freestand motion code-spectrum`: the spectrum of a code, and what it gives parts on floors.

use clap::Args;
use freestand::code_spectrum::CodeSpectrum;
use freestand::code_spectrum::parts::{PartsQuestion, clause, floor_acceleration_g};
use freestand_input::quantity::Dimension;
use freestand_output::figure::Figure;
use freestand_output::rows::columns_csv;
use freestand_study::target::Target;
use freestand_study::target::{CodePicture, code_spectrum_figure};
use serde::Serialize;

use super::plot::failed;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::{Failure, problem};
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::target::{TargetArgs, TargetReport};
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
}

#[derive(Debug, Serialize)]
struct CodeSpectrumReport {
    #[serde(flatten)]
    code: TargetReport,
    corner_periods_s: Vec<f64>,
    periods_s: Vec<f64>,
    sa_g: Vec<f64>,
    /// Of Eurocode 8 alone.
    vertical_sa_g: Option<Vec<f64>>,
    parts: Option<PartsReport>,
}

#[derive(Debug, Serialize)]
struct PartsReport {
    clause: &'static str,
    building_height_m: Option<f64>,
    building_period_s: Option<f64>,
    levels: Vec<PartsLevel>,
}

#[derive(Debug, Serialize)]
struct PartsLevel {
    level_ratio: f64,
    height_m: Option<f64>,
    floor_acceleration_g: f64,
}

pub(crate) fn run(args: &CodeSpectrumArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let target = args.target.target()?;
    let mut values = Values::default();
    let periods_s = periods(args, &target, &mut values);
    let parts = if args.parts { parts(args, &target.spectrum, &mut values) } else { None };
    values.finish()?;
    let spectrum = &target.spectrum;
    let vertical_sa_g = match spectrum {
        CodeSpectrum::Eurocode8(code) => Some(periods_s.iter().map(|&period| code.vertical_sa_g(period)).collect()),
        _ => None,
    };
    let report = CodeSpectrumReport {
        code: TargetReport::from(&target),
        corner_periods_s: match spectrum {
            CodeSpectrum::Table(_) => Vec::new(),
            _ => spectrum.corner_periods_s(),
        },
        sa_g: periods_s.iter().map(|&period| spectrum.sa_g(period)).collect(),
        periods_s,
        vertical_sa_g,
        parts,
    };
    let inputs = args.target.inputs();
    let files = Files::begin(global, &inputs)?;
    let mut columns: Vec<(&str, &[f64])> = vec![("period_s", &report.periods_s), ("sa_g", &report.sa_g)];
    columns.extend(report.vertical_sa_g.as_deref().map(|vertical| ("vertical_sa_g", vertical)));
    let csv = columns_csv(&columns)?;
    files.write("spectrum.csv", || csv)?;
    if files.wanted() {
        let figure = picture(&target, &report)?;
        files.write("spectrum.svg", || figure.svg)?;
        files.write("spectrum.png", || figure.png)?;
    }
    files.print(printer, "freestand.code-spectrum/1", &report, &target.warnings, || text(&target, &report))?;
    Ok(Done::OK)
}

/// The periods that are asked for; without any the usual ones with the corners, as far as the
/// spectrum goes.
fn periods(args: &CodeSpectrumArgs, target: &Target, values: &mut Values) -> Vec<f64> {
    let spectrum = &target.spectrum;
    let (from_s, to_s) = (spectrum.shortest_period_s(), spectrum.longest_period_s().unwrap_or(f64::INFINITY));
    let mut periods_s = super::periods(&args.periods, values);
    if args.periods.is_none() {
        let last = periods_s.last().copied().unwrap_or(0.0);
        periods_s.extend(spectrum.corner_periods_s().into_iter().filter(|&corner| corner <= last));
        periods_s.sort_by(f64::total_cmp);
        periods_s.dedup();
        periods_s.retain(|period| (from_s..=to_s).contains(period));
        return periods_s;
    }
    if let Some(negative) = periods_s.iter().find(|&&period| period < 0.0) {
        let message = format!("--periods: a period of {negative} s is negative");
        values.push(problem(message, "give periods of 0 s or more"));
    } else if let Some(outside) = periods_s.iter().find(|period| !(from_s..=to_s).contains(*period)) {
        let message = format!("--periods: {outside} s lies outside of the table, which is from {from_s} s to {to_s} s");
        let hint = "--beyond hold lets it go on: constant Sa below, constant displacement beyond";
        values.push(problem(message, hint));
    }
    periods_s
}

fn picture(target: &Target, report: &CodeSpectrumReport) -> Result<Figure, Failure> {
    let corners: Vec<(f64, f64)> =
        report.corner_periods_s.iter().map(|&period| (period, target.spectrum.sa_g(period))).collect();
    let levels: Option<Vec<(f64, f64)>> = report
        .parts
        .as_ref()
        .map(|parts| parts.levels.iter().map(|level| (level.level_ratio, level.floor_acceleration_g)).collect());
    let picture = CodePicture {
        title: &target.one_line(),
        periods_s: &report.periods_s,
        sa_g: &report.sa_g,
        vertical_sa_g: report.vertical_sa_g.as_deref(),
        corners: &corners,
        parts: report.parts.as_ref().map(|parts| parts.clause).zip(levels.as_deref()),
    };
    code_spectrum_figure(&picture).map_err(failed)
}

/// The floors from the ground to the roof by tenths.
fn parts(args: &CodeSpectrumArgs, spectrum: &CodeSpectrum, values: &mut Values) -> Option<PartsReport> {
    let height_m = values.read(&args.building_height);
    let period_s = values.read(&args.building_period);
    let Some(clause) = clause(spectrum) else {
        values.push(problem("--parts: a table has no clause for parts", "name a code with --code"));
        return None;
    };
    let needs_height = matches!(spectrum, CodeSpectrum::As1170_4(_) | CodeSpectrum::Nzs1170_5(_));
    if needs_height && args.building_height.is_none() {
        let message = format!("--parts needs --building-height ({clause})");
        values.push(problem(message, "write --building-height \"30 m\""));
        return None;
    }
    let level = |tenth: u32| {
        let level_ratio = f64::from(tenth) / 10.0;
        // A code that does not ask for the height takes any.
        let building_height_m = height_m.unwrap_or(1.0);
        let question = PartsQuestion { level_ratio, building_height_m, building_period_s: period_s };
        let floor_acceleration_g = floor_acceleration_g(spectrum, &question)?;
        Some(PartsLevel { level_ratio, height_m: height_m.map(|height| level_ratio * height), floor_acceleration_g })
    };
    let levels = (0..=10).filter_map(level).collect();
    Some(PartsReport { clause, building_height_m: height_m, building_period_s: period_s, levels })
}

fn text(target: &Target, report: &CodeSpectrumReport) -> String {
    let mut headings = vec!["T [s]", "Sa [g]"];
    headings.extend(report.vertical_sa_g.as_ref().map(|_| "vertical [g]"));
    let row = |i: usize| {
        let vertical = report.vertical_sa_g.as_ref().and_then(|values| values.get(i));
        let values = report.sa_g.get(i).into_iter().chain(vertical);
        let period = report.periods_s.get(i).map(|&period| significant(period, 4));
        period.into_iter().chain(values.map(|&sa| significant(sa, 5))).collect()
    };
    let rows: Vec<Vec<String>> = (0..report.periods_s.len()).map(row).collect();
    let mut text = format!("{}\n{}", target.one_line(), table(&headings, &rows));
    if let Some(parts) = &report.parts {
        let rows: Vec<Vec<String>> = parts
            .levels
            .iter()
            .map(|level| {
                let height = level.height_m.map_or_else(|| "–".to_owned(), |height| significant(height, 4));
                vec![significant(level.level_ratio, 2), height, significant(level.floor_acceleration_g, 4)]
            })
            .collect();
        text.push_str(&format!("\n{}\n{}", parts.clause, table(&["z/h", "z [m]", "floor [g]"], &rows)));
    }
    text
}
