//! `freestand motion code-spectrum`, and the arguments that call for a code's spectrum.

use clap::{Args, ValueEnum};
use freestand::code_spectrum::{As1170_4, Edition, SiteClass, hazard_factor};
use freestand_study::quantity::Dimension;
use freestand_study::resolve::minimum_governs_warning;
use freestand_study::tables::columns_csv;
use freestand_study::{Problem, ProblemKind};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::values::Values;

/// A spectrum of a code.
#[derive(Debug, Args)]
#[command(next_help_heading = "The code")]
pub(crate) struct CodeArgs {
    /// The code
    #[arg(long, value_enum, default_value_t)]
    code: CodeName,
    /// Edition of the code (with its amendments to 2018)
    #[arg(long, value_name = "YEAR", default_value = "2007", value_parser = ["2007"])]
    edition: String,
    /// Site class: Ae, Be, Ce, De, Ee
    #[arg(long, value_name = "CLASS", default_value = "De")]
    site: String,
    /// Hazard factor Z
    #[arg(long, value_name = "RATIO", conflicts_with = "city", allow_hyphen_values = true)]
    hazard_factor: Option<String>,
    /// Place of the code's table of hazard factors [default: Melbourne]
    #[arg(long, value_name = "NAME")]
    city: Option<String>,
    /// Return period in years
    #[arg(long, value_name = "YEARS", default_value = "500", allow_negative_numbers = true)]
    return_period: u32,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum CodeName {
    /// AS 1170.4
    #[default]
    #[value(name = "as1170.4")]
    As1170_4,
}

impl CodeArgs {
    /// The spectrum, and what must be said about it.
    pub(crate) fn spectrum(&self) -> Result<(As1170_4, Vec<String>), Failure> {
        let CodeName::As1170_4 = self.code;
        let mut values = Values::default();
        let given = values.positive("--hazard-factor", self.hazard_factor.as_deref(), Dimension::Ratio);
        values.finish()?;
        let city = self.city.as_deref().unwrap_or("Melbourne");
        let z = given.or_else(|| hazard_factor(city)).ok_or_else(|| {
            Problem::new(ProblemKind::Value, format!("--city: AS 1170.4 has no hazard factor for \"{city}\""))
                .hint("give --hazard-factor, such as 0.08")
        })?;
        let wrong = |flag: &str, error: freestand::code_spectrum::CodeSpectrumError| {
            Problem::new(ProblemKind::Value, format!("{flag}: {error}")).hint("see the tables of AS 1170.4")
        };
        let site = SiteClass::parse(&self.site).map_err(|error| wrong("--site", error))?;
        let spectrum = As1170_4::new(Edition::default(), site, z, self.return_period)
            .map_err(|error| wrong("--return-period", error))?;
        Ok((spectrum, minimum_governs_warning(&spectrum).into_iter().collect()))
    }
}

/// What a report says of a code spectrum.
#[derive(Debug, Serialize)]
pub(crate) struct CodeReport {
    code: &'static str,
    site: &'static str,
    hazard_factor: f64,
    return_period_years: u32,
    kpz_g: f64,
    minimum_kpz_governs: bool,
}

impl From<&As1170_4> for CodeReport {
    fn from(spectrum: &As1170_4) -> Self {
        Self {
            code: spectrum.edition().name(),
            site: spectrum.site().name(),
            hazard_factor: spectrum.hazard_factor(),
            return_period_years: spectrum.return_period_years(),
            kpz_g: spectrum.kpz_g(),
            minimum_kpz_governs: spectrum.minimum_governs(),
        }
    }
}

/// Elastic spectrum of a code, 5 % damping
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion code-spectrum --site De --city Melbourne
  freestand motion code-spectrum --site Ce --hazard-factor 0.11 --return-period 2500 --periods \"0 s, 0.5 s, 1 s\" --json")]
pub(crate) struct CodeSpectrumArgs {
    #[command(flatten)]
    code: CodeArgs,
    /// Periods, from:to:count or a list [default: 0 and 121 from 0.05 to 5 s]
    #[arg(long, value_name = "GRID", allow_hyphen_values = true)]
    periods: Option<String>,
}

#[derive(Debug, Serialize)]
struct CodeSpectrumReport {
    #[serde(flatten)]
    code: CodeReport,
    periods_s: Vec<f64>,
    sa_g: Vec<f64>,
}

pub(crate) fn run(args: &CodeSpectrumArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let (spectrum, warnings) = args.code.spectrum()?;
    let mut values = Values::default();
    let periods_s = super::periods(args.periods.as_deref(), &mut values);
    if let Some(negative) = periods_s.iter().find(|&&period| period < 0.0) {
        let problem = Problem::new(ProblemKind::Value, format!("--periods: a period of {negative} s is negative"));
        values.push(problem.hint("give periods of 0 s or more"));
    }
    values.finish()?;
    let sa_g = periods_s.iter().map(|&period| spectrum.sa_g(period)).collect();
    let report = CodeSpectrumReport { code: CodeReport::from(&spectrum), periods_s, sa_g };
    let files = Files::begin(global, &[])?;
    let columns = columns_csv(&[("period_s", &report.periods_s), ("sa_g", &report.sa_g)])?;
    files.write("spectrum.csv", || columns)?;
    files.print(printer, "freestand.code-spectrum/1", &report, &warnings, || {
        let rows: Vec<Vec<String>> = report
            .periods_s
            .iter()
            .zip(&report.sa_g)
            .map(|(&period, &sa)| vec![significant(period, 4), significant(sa, 5)])
            .collect();
        let code = &report.code;
        let head = format!("{}, site {}, kpZ = {} g\n", code.code, code.site, significant(code.kpz_g, 4));
        head + &table(&["T [s]", "Sa [g]"], &rows)
    })?;
    Ok(Done::OK)
}
