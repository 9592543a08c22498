//! `freestand fragility`: how likely objects rock, are damaged and overturn at an intensity.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::fragility::FitKind;
use freestand_assess::export::{ExportFormat, ExportRequest, FORMATS, export};
use freestand_assess::fragility::{
    At, FITS, FRAGILITY_SCHEMA, FragilityReport, FragilityRequest, ShockLimits, fragility,
};
use freestand_assess::risk::{HazardSource, coordinates};
use freestand_input::quantity::Dimension;
use freestand_input::words::Choices;
use freestand_output::json::document;

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table};
use crate::values::{Given, Reads, Values, choice, name_of};

/// Fit fragilities to the outcomes of runs: how likely an object fails at an intensity
///
/// A table of outcomes has one row per run, with the headings object, motion, pfv [m/s], outcome
/// (no-uplift, rocked, exceeded or overturned), or one row of counts per level, with object, pfv
/// [m/s], no_uplift, rocked, exceeded, overturned. The measure is one of pga [g], pgv [m/s], pfa
/// [g], pfv [m/s], sa(0.5) [g], sa_avg(0.2:2) [g], velocity_ratio and acceleration_ratio.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand fragility --outcomes outcomes.csv --out fragility
  freestand fragility --outcomes outcomes.csv --fit separate --json
  freestand fragility --outcomes outcomes.csv --tolerance 5g --ceiling 22g
  freestand fragility --outcomes outcomes.csv --format pelicun --demand \"0.4 m/s\" --out export
  freestand fragility --outcomes pgv.csv --format openquake --demand \"0.4 m/s\" \\
    --site-coordinates \"151.2,-33.9\" --hazard hazard.csv --inventory costs.csv --out export")]
pub(crate) struct FragilityArgs {
    /// Table of outcomes (CSV)
    #[arg(long, value_name = "FILE")]
    outcomes: PathBuf,
    /// Where a spectral acceleration is taken [default: ground]
    #[arg(long, value_parser = choice(PLACES))]
    at: Option<At>,
    /// How the limit states of an object are fitted
    #[arg(long, value_parser = choice(FITS), default_value = name_of(FITS, FitKind::Ordered))]
    fit: FitKind,
    /// Tolerance: exceeding it is fitted to the column edge_acceleration [g] instead of the classes
    #[arg(long, positive = Dimension::Acceleration, requires = "ceiling", help_heading = "From the shocks")]
    tolerance: Option<Given>,
    /// Largest shock without overturning, the ceiling_g of freestand shock
    #[arg(long, positive = Dimension::Acceleration, requires = "tolerance", help_heading = "From the shocks")]
    ceiling: Option<Given>,
    /// Samples of motions for the 95 % intervals; 0: none [default: 1000]
    #[arg(long, value_name = "N")]
    bootstrap: Option<u32>,
    #[command(flatten)]
    tables: TableArgs,

    /// Write a folder for another program into --out; may be given several times
    #[arg(long, value_parser = choice(FORMATS), help_heading = "Other programs")]
    format: Vec<ExportFormat>,
    /// Intensity of the scenario, such as "0.4 m/s" [default: those of the outcomes]
    #[arg(long, value_name = "INTENSITY", help_heading = "Other programs")]
    demand: Option<String>,
    /// Realizations of pelicun with --demand [default: 10000]
    #[arg(long, value_name = "N", help_heading = "Other programs", value_parser = clap::value_parser!(u32).range(1..))]
    realizations: Option<u32>,
    /// β for limit states that have none, such as a step
    #[arg(long, positive = Dimension::Ratio, help_heading = "Other programs")]
    beta: Option<Given>,
    /// Export the shares of runs as points, or the fit of shocks, instead of lognormal curves
    #[arg(long, requires = "format", help_heading = "Other programs")]
    discrete: bool,
    /// Longitude and latitude in degrees, of objects for which the inventory has none
    #[arg(long, value_name = "LON,LAT", read = coordinates, help_heading = "Other programs")]
    site_coordinates: Option<Given<(f64, f64)>>,
    /// Quantities, costs, floors, longitudes and latitudes of the objects, as for freestand risk (CSV)
    #[arg(long, value_name = "FILE", requires = "format", help_heading = "Other programs")]
    inventory: Option<PathBuf>,
    /// Hazard curve for a second job of OpenQuake, as for freestand risk (CSV)
    #[arg(long, value_name = "FILE", conflicts_with = "hazard_power", help_heading = "Other programs")]
    hazard: Option<PathBuf>,
    /// Power law in place of --hazard, "k0=1e-4 /yr, k=2.5, reference=1 m/s"
    #[arg(long, value_name = "LAW", help_heading = "Other programs")]
    hazard_power: Option<String>,
}

pub(crate) const PLACES: Choices<At> =
    &[(At::Ground, "ground", "of the ground motion"), (At::Floor, "floor", "of the floor motion")];

const COLUMNS: [Column; 9] = [
    ("id", "object", 0),
    ("limit_state", "limit state", 0),
    ("kind", "curve", 0),
    ("median", "median", 4),
    ("median_ci95", "95 %", 0),
    ("beta", "beta", 3),
    ("beta_ci95", "95 %", 0),
    ("lower", "none below", 4),
    ("upper", "all above", 4),
];

pub(crate) fn run(args: &FragilityArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let beta = values.read(&args.beta);
    let site_deg = values.read(&args.site_coordinates);
    let (tolerance, ceiling) = (values.read(&args.tolerance), values.read(&args.ceiling));
    values.finish()?;
    let shock = tolerance
        .zip(ceiling)
        .map(|(tolerance, ceiling)| ShockLimits { tolerance_g: tolerance / G0_M_S2, ceiling_g: ceiling / G0_M_S2 });
    if !args.format.is_empty() && global.out.is_none() {
        return Err(Failure::usage("--format writes a folder, and --out is not given", "give --out DIR"));
    }
    let inputs: Vec<PathBuf> =
        [Some(&args.outcomes), args.inventory.as_ref(), args.hazard.as_ref()].into_iter().flatten().cloned().collect();
    let files = Files::with_tables(global, &inputs, &args.tables, FRAGILITY_SCHEMA, Some(global.seed()))?;
    let mut report = fragility(FragilityRequest {
        outcomes: args.outcomes.clone(),
        at: args.at,
        fit: args.fit,
        shock,
        replicates: args.bootstrap,
        seed: global.seed(),
    })?;
    // Before anything is written, so that what cannot be exported leaves no folder.
    let measure = report.table.measure;
    let hazard = match (&args.hazard, &args.hazard_power) {
        (Some(path), _) => Some(HazardSource::File(path.clone())),
        (None, Some(text)) => Some(HazardSource::PowerLaw { text: text.clone(), measure }),
        (None, None) => None,
    };
    if hazard.is_some() && !args.format.contains(&ExportFormat::OpenQuake) {
        return Err(Failure::usage("only OpenQuake takes a hazard curve", "add --format openquake"));
    }
    let mut exported = Vec::new();
    for &format in &args.format {
        let request = ExportRequest {
            format,
            demand: args.demand.clone(),
            realizations: args.realizations,
            beta,
            is_discrete: args.discrete,
            site_deg,
            inventory: args.inventory.clone(),
            hazard: hazard.clone().filter(|_| format == ExportFormat::OpenQuake),
        };
        let folder = export(&report, &request)?;
        for warning in folder.warnings {
            // Two programs may say the same of an object.
            if !report.warnings.contains(&warning) {
                report.warnings.push(warning);
            }
        }
        exported.extend(folder.files);
    }
    let facts = report.facts();
    if files.wanted() {
        files.table("fragility", || report.table())?;
        files.table("empirical", || report.empirical_table())?;
        let json = document(FRAGILITY_SCHEMA, &facts, &report.warnings)?;
        files.write("fragility.json", || json)?;
        files.figure("fragility", || report.figure())?;
        for (name, bytes) in exported {
            files.write(&name, || bytes)?;
        }
    }
    files.finish_result(FRAGILITY_SCHEMA, &report.warnings)?;
    printer.result(FRAGILITY_SCHEMA, &facts, &report.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn text(report: &FragilityReport) -> String {
    let measure = report.table.measure.with_unit();
    let rows = report.rows();
    format!("Intensities: {measure} of the {}\n\n{}", report.at.name(), facts_table(&rows, &COLUMNS))
}
