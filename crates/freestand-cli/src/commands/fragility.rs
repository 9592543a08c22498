//! `freestand fragility`: how likely objects rock, are damaged and overturn at an intensity.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::fragility::FitKind;
use freestand_assess::export::{ExportFormat, ExportRequest, FORMATS, check_export, export};
use freestand_assess::fragility::{
    At, FIT_METHODS, FRAGILITY_SCHEMA, FitMethod, FragilityReport, FragilityRequest, HazardGiven,
    HazardSource, ShockLimits, fragility_watched,
};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::Dimension;
use freestand_input::words::Choices;
use freestand_output::json::document;

use super::Done;
use super::assess::watched;
use super::fragility_runs::{self, RunArgs};
use super::list::cells;
use crate::args::{GlobalArgs, Named, refuse_idle};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::hazard::CurveArgs;
use crate::printer::{Column, Printer, facts_table};
use crate::values::{Given, Reads, Values, choice, name_of};

/// Calculate fragilities: how likely it is that an object rocks, is damaged or overturns
///
/// The command runs objects under motions at many scales and fits curves to the outcomes. Give one
/// object by its size with --motion, or the objects of an inventory on the floors of a study. With
/// --outcomes, a table has the outcomes, and the command only fits the curves.
///
/// A table of outcomes has one row per run, with the headings object, motion, pfv [m/s], outcome
/// (no-uplift, rocked, exceeded or overturned), or one row of counts per level, with object, pfv
/// [m/s], no_uplift, rocked, exceeded, overturned. The measure is one of pga [g], pgv [m/s], pfa
/// [g], pfv [m/s], sa(0.5) [g], sa_avg(0.2:2) [g], velocity_ratio and acceleration_ratio.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  One object under motions of its floor, which are scaled up until they overturn it:
    freestand fragility --height 1.8m --thickness 0.5m --motion floor/*.csv --out fragility
  With its shock and its tolerance, by several measures:
    freestand fragility --height 1.8m --thickness 0.5m --mass 150kg --stiffness \"4380 N/mm\" \\
      --tolerance 5g --motion floor/*.csv --im \"pfv, pfa, sa(0.5), velocity_ratio\" --out fragility
  The objects of an inventory in the building and the earthquakes of a study:
    freestand fragility hospital.toml --inventory hospital.xlsx --im pgv --out fragility
  Every object under every motion at the same intensities, for the losses of freestand risk:
    freestand fragility hospital.toml --inventory hospital.xlsx --im pgv --method stripes \\
      --scales \"0.1 m/s:1.5 m/s:10\" --out stripes
  The same, with intensities added until they tell how often objects fail under a hazard:
    freestand fragility hospital.toml --inventory hospital.xlsx --im pgv --method stripes \\
      --hazard hazard.csv --out stripes
  Continue the runs of an inventory after Ctrl-C or a crash, in the same folder:
    freestand fragility hospital.toml --inventory hospital.xlsx --im pgv --out fragility --resume
  The probability of exceeding the tolerance from the shocks below the ceiling:
    freestand fragility --height 1.8m --thickness 0.5m --mass 150kg --stiffness \"4380 N/mm\" \\
      --tolerance 5g --motion floor/*.csv --fit two-stage --out fragility
  The fit alone:
    freestand fragility --outcomes outcomes.csv --out fragility
    freestand fragility --outcomes outcomes.csv --fit separate --json
    freestand fragility --outcomes outcomes.csv --tolerance 5g --ceiling 22g
  Folders for other programs; --inventory then has quantities, costs, floors and coordinates:
    freestand fragility --outcomes outcomes.csv --format pelicun --demand \"0.4 m/s\" --out export
    freestand fragility --outcomes pgv.csv --format openquake --demand \"0.4 m/s\" \\
      --site-coordinates \"151.2,-33.9\" --hazard hazard.csv --inventory costs.csv --out export")]
pub(crate) struct FragilityArgs {
    /// Table of outcomes (CSV) of earlier runs; nothing is run
    #[arg(long, value_name = "FILE")]
    outcomes: Option<PathBuf>,
    #[command(flatten)]
    pub(super) runs: Named<RunArgs>,
    /// Motion of which a spectral acceleration is taken. With --motion, `ground` says that the object
    /// is on the ground [default: ground; with --motion, floor]
    #[arg(long, value_parser = choice(PLACES))]
    pub(super) at: Option<At>,
    /// How the limit states of an object are fitted
    #[arg(long, value_parser = choice(FIT_METHODS), default_value = name_of(FIT_METHODS, FitMethod::Curves(FitKind::Ordered)))]
    pub(super) fit: FitMethod,
    /// Peak acceleration of a landing that the object withstands. With --outcomes and --ceiling, the
    /// fit of `exceeds` uses the shocks of the column edge_acceleration [g], not the outcomes
    #[arg(long, positive = Dimension::Acceleration, help_heading = "One object")]
    pub(super) tolerance: Option<Given>,
    /// Largest shock without overturning, the ceiling_g of freestand shock; with --outcomes
    #[arg(long, positive = Dimension::Acceleration, requires = "tolerance", help_heading = "From the shocks")]
    pub(super) ceiling: Option<Given>,
    /// Samples of motions for the 95 % intervals; 0: none [default: 1000]
    #[arg(long, value_name = "N")]
    pub(super) bootstrap: Option<u32>,
    #[command(flatten)]
    pub(super) tables: TableArgs,

    /// Write a folder for another program into --out; may be given several times
    #[arg(long, value_parser = choice(FORMATS), help_heading = "Other programs")]
    format: Vec<ExportFormat>,
    /// Intensity of the scenario, such as "0.4 m/s" [default: those of the outcomes]
    #[arg(
        long,
        value_name = "INTENSITY",
        requires = "format",
        help_heading = "Other programs"
    )]
    demand: Option<String>,
    /// Realizations of pelicun with --demand [default: 10000]
    #[arg(long, value_name = "N", requires = "format", help_heading = "Other programs", value_parser = clap::value_parser!(u32).range(1..))]
    realizations: Option<u32>,
    /// β for limit states that have none, such as a step
    #[arg(long, positive = Dimension::Ratio, requires = "format", help_heading = "Other programs")]
    beta: Option<Given>,
    /// Export curves as points (shares of runs, or the fit of the shocks) instead of lognormal curves
    #[arg(long, requires = "format", help_heading = "Other programs")]
    discrete: bool,
    #[command(
        flatten,
        next_help_heading = "Hazard (for --method stripes and --format openquake)"
    )]
    pub(super) curve: CurveArgs,
}

pub(crate) const PLACES: Choices<At> = &[
    (At::Ground, "ground", "of the ground motion"),
    (At::Floor, "floor", "of the floor motion"),
];

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

pub(crate) fn run(
    args: &FragilityArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    if !args.format.is_empty() && global.out.is_none() {
        return Err(Failure::usage(
            "--format writes a folder, and --out is not given",
            "give --out DIR",
        ));
    }
    match &args.outcomes {
        Some(_) if args.runs.is_given_beside_outcomes() => Err(Failure::usage(
            "--outcomes contains the runs, so there is nothing else to run",
            "leave out --outcomes, or leave out the size, the motions and the study",
        )),
        Some(outcomes) => run_table(outcomes, args, global, printer),
        None if args.runs.is_given() => fragility_runs::run(args, global, printer),
        None => Err(Failure::usage(
            "there is nothing to run and nothing to fit",
            "give --height, --thickness and --motion, or --inventory with a study, or --outcomes FILE",
        )),
    }
}

/// The fit of a table of outcomes.
fn run_table(
    outcomes: &PathBuf,
    args: &FragilityArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    // The inventory has quantities and costs for --format; everything else describes runs.
    let idle = args
        .runs
        .given
        .iter()
        .map(String::as_str)
        .filter(|flag| *flag != "inventory");
    refuse_idle(idle, "--outcomes contains the runs, so nothing is run")?;
    let mut values = Values::default();
    let (tolerance, ceiling) = (values.read(&args.tolerance), values.read(&args.ceiling));
    if args.tolerance.is_some() && args.ceiling.is_none() {
        let message = "--tolerance with --outcomes needs the ceiling of the shocks";
        values.push(Problem::value(
            message,
            "give --ceiling, the ceiling_g that freestand shock states",
        ));
    } else if args.tolerance.is_none() && args.fit == FitMethod::TwoStage {
        let message =
            "--fit two-stage with --outcomes needs the tolerance and the ceiling of the shocks";
        values.push(Problem::value(
            message,
            "give --tolerance and --ceiling, the ceiling_g that freestand shock states",
        ));
    }
    values.finish()?;
    let shock = tolerance
        .zip(ceiling)
        .map(|(tolerance, ceiling)| ShockLimits {
            tolerance_g: tolerance / G0_M_S2,
            ceiling_g: ceiling / G0_M_S2,
        });
    let costs = args.runs.inventory();
    if costs.is_some() && args.format.is_empty() {
        let message =
            "--inventory with --outcomes has quantities and costs for --format, which is not given";
        return Err(Failure::usage(
            message,
            "give --format, or leave out --inventory",
        ));
    }
    let mut exports = Exports::new(args, costs.as_ref())?;
    if exports.hazard.is_some() && !exports.takes_hazard() {
        return Err(Failure::usage(
            "only OpenQuake takes a hazard curve",
            "add --format openquake",
        ));
    }
    let inputs: Vec<PathBuf> = [Some(outcomes), costs.as_ref(), args.curve.hazard.as_ref()]
        .into_iter()
        .flatten()
        .cloned()
        .collect();
    let files = Files::with_tables(
        global,
        &inputs,
        &args.tables,
        FRAGILITY_SCHEMA,
        Some(global.seed()),
    )?;
    let request = FragilityRequest {
        outcomes: outcomes.clone(),
        at: args.at,
        fit: args.fit.kind(),
        shock,
        replicates: args.bootstrap,
        seed: global.seed(),
    };
    // Made before the fits, so that no signal is missed between them and the files.
    let stop = printer.stop();
    let go_on = || {
        if stop.wanted() {
            Err(Failure::Stopped { printed: false })
        } else {
            Ok(())
        }
    };
    let found = watched(printer, |progress| fragility_watched(request, progress));
    let mut report = found.map_err(stopped)?;
    // Before anything is written, so that what cannot be exported leaves no folder.
    exports.make(&report)?;
    report.warnings.append(&mut exports.warnings);
    let facts = report.facts();
    if files.wanted() {
        files.table("fragility", || report.table())?;
        go_on()?;
        files.table("empirical", || report.empirical_table())?;
        go_on()?;
        let json = document(FRAGILITY_SCHEMA, &facts, &report.warnings)?;
        files.write("fragility.json", || json)?;
        go_on()?;
        files.figure("fragility", || report.figure())?;
        go_on()?;
        exports.write(&files)?;
    }
    files.finish_result(FRAGILITY_SCHEMA, &report.warnings)?;
    printer.result(FRAGILITY_SCHEMA, &facts, &report.warnings, || {
        curves_text(&report)
    })?;
    Ok(Done::OK)
}

/// The failure of a calculation, which a signal may have stopped.
pub(super) fn stopped(problems: Problems) -> Failure {
    if problems.is_stopped() {
        Failure::Stopped { printed: false }
    } else {
        problems.into()
    }
}

/// The folders for other programs.
pub(super) struct Exports {
    requests: Vec<ExportRequest>,
    /// The hazard that was given.
    pub(super) hazard: Option<HazardSource>,
    made: Vec<(String, Vec<u8>)>,
    /// Warnings about them.
    pub(super) warnings: Vec<String>,
}

impl Exports {
    /// What is asked for, checked as far as it can be without fits.
    pub(super) fn new(args: &FragilityArgs, inventory: Option<&PathBuf>) -> Result<Self, Failure> {
        let mut values = Values::default();
        let beta = values.read(&args.beta);
        let site_deg = values.read(&args.curve.site_coordinates);
        let hazard = args.curve.given(&mut values);
        values.finish()?;
        let hazard = if hazard == HazardGiven::default() {
            None
        } else {
            Some(hazard.source()?)
        };
        let has = |format| args.format.contains(&format);
        let idle = [
            (
                args.realizations.is_some()
                    && !(has(ExportFormat::Pelicun) && args.demand.is_some()),
                "realizations",
            ),
            (
                args.curve.site_coordinates.is_some()
                    && args.curve.hazard.is_none()
                    && !has(ExportFormat::OpenQuake),
                "site-coordinates",
            ),
            (
                args.demand.is_some()
                    && args
                        .format
                        .iter()
                        .all(|format| *format == ExportFormat::Csv),
                "demand",
            ),
            (
                args.beta.is_some()
                    && args
                        .format
                        .iter()
                        .all(|format| *format == ExportFormat::Csv),
                "beta",
            ),
            (
                args.discrete
                    && args
                        .format
                        .iter()
                        .all(|format| *format == ExportFormat::Csv),
                "discrete",
            ),
        ];
        let idle = idle
            .into_iter()
            .filter_map(|(is_idle, flag)| is_idle.then_some(flag));
        refuse_idle(
            idle,
            "no program of --format uses it (--realizations is for pelicun with --demand)",
        )?;
        let list = cells(args.runs.cells())?;
        let request = |&format| ExportRequest {
            format,
            list: list.clone(),
            demand: args.demand.clone(),
            realizations: args.realizations,
            beta,
            is_discrete: args.discrete,
            site_deg,
            inventory: inventory.cloned(),
            hazard: None,
        };
        let requests: Vec<ExportRequest> = args.format.iter().map(request).collect();
        requests.iter().try_for_each(check_export)?;
        Ok(Self {
            requests,
            hazard,
            made: Vec::new(),
            warnings: Vec::new(),
        })
    }

    /// Whether a program reads the hazard.
    pub(super) fn takes_hazard(&self) -> bool {
        self.requests
            .iter()
            .any(|request| request.format == ExportFormat::OpenQuake)
    }

    /// Makes the files.
    pub(super) fn make(&mut self, report: &FragilityReport) -> Result<(), Failure> {
        for request in &self.requests {
            let hazard = self
                .hazard
                .clone()
                .filter(|_| request.format == ExportFormat::OpenQuake);
            let folder = export(
                report,
                &ExportRequest {
                    hazard,
                    ..request.clone()
                },
            )?;
            for warning in folder.warnings {
                // Two programs may say the same of an object.
                if !report.warnings.contains(&warning) && !self.warnings.contains(&warning) {
                    self.warnings.push(warning);
                }
            }
            self.made.extend(folder.files);
        }
        Ok(())
    }

    /// Writes them.
    pub(super) fn write(self, files: &Files) -> Result<(), Failure> {
        self.made
            .into_iter()
            .try_for_each(|(name, bytes)| files.write(&name, || bytes).map(drop))
    }
}

/// The curves by one measure, for people.
pub(super) fn curves_text(report: &FragilityReport) -> String {
    let measure = report.table.measure.with_unit();
    let rows = report.rows();
    format!(
        "Intensities: {measure} of the {}\n\n{}",
        report.at.name(),
        facts_table(&rows, &COLUMNS)
    )
}
