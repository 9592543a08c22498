//! `freestand risk`: how often objects fail, what that costs, and which options pay.

use std::path::PathBuf;

use clap::Args;
use freestand::fragility::FitKind;
use freestand_app::CellKeys;
use freestand_assess::fragility::{
    At, FITS, FragilityRequest, HAZARD_CODES, HazardCode, HazardGiven,
};
use freestand_assess::risk::{
    RISK_SCHEMA, RiskCurves, RiskRequest, amount, risk, yearly_rate, years,
};
use freestand_input::quantity::Dimension;
use freestand_output::json::document;

use super::Done;
use super::assess::watched;
use super::fragility::{PLACES, stopped};
use super::list::{cells, of_cells};
use crate::args::{GlobalArgs, refuse_idle};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::hazard::CurveArgs;
use crate::printer::Printer;
use crate::values::{Given, Reads, Values, choice};

/// Calculate how often objects fail, what that costs a year, and which options are worth their cost
///
/// The hazard curve says how often a year motions reach an intensity, and the fragility how likely
/// the object fails at it. Costs come from the inventory; the program assumes none, and lists those
/// that are missing. Exit status 1: an object fails more often than accepted.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  How often objects fail, with the hazard curve of a seismologist:
    freestand risk --fragility fragility.csv --hazard hazard.csv
  With a power law as hazard curve:
    freestand risk --fragility fragility.csv --hazard-im pgv \\
      --hazard-power \"k0=1e-4 /yr, k=2.5, reference=1 m/s\"
  With the return periods of a code, for the peak ground acceleration:
    freestand risk --fragility fragility.csv --hazard-code as1170.4 --hazard-im pga \\
      --site De --hazard-factor 0.12 --accepted \"1e-3 /yr\"
  What failures cost, and what to restrain first:
    freestand risk --outcomes outcomes.csv --hazard hazard.csv --inventory costs.csv \\
      --options options.csv --budget \"20000 AUD\" --horizon \"40 yr\" --discount \"3 %\"")]
pub(crate) struct RiskArgs {
    /// Fragilities, as freestand fragility writes them (CSV)
    #[arg(
        long,
        value_name = "FILE",
        required_unless_present = "outcomes",
        conflicts_with = "outcomes",
        help_heading = "Fragility"
    )]
    fragility: Option<PathBuf>,
    /// Table of outcomes (CSV), which is fitted first; stripes also give the losses of all objects
    /// under the same motions
    #[arg(long, value_name = "FILE", help_heading = "Fragility")]
    outcomes: Option<PathBuf>,
    /// How the limit states of an object are fitted, with --outcomes [default: ordered]
    #[arg(long, value_parser = choice(FITS), help_heading = "Fragility")]
    fit: Option<FitKind>,
    /// Samples of motions for the 95 % intervals, with --outcomes; 0: none [default: 1000]
    #[arg(long, value_name = "N", help_heading = "Fragility")]
    bootstrap: Option<u32>,
    /// Motion of which a spectral acceleration is taken [default: ground]
    #[arg(long, value_parser = choice(PLACES), help_heading = "Fragility")]
    at: Option<At>,

    #[command(
        flatten,
        next_help_heading = "Hazard (one of --hazard, --hazard-power, --hazard-code)"
    )]
    curve: CurveArgs,
    /// Return periods of a code, for pga or sa(T)
    #[arg(long, value_parser = choice(HAZARD_CODES), help_heading = "Hazard (one of --hazard, --hazard-power, --hazard-code)")]
    hazard_code: Option<HazardCode>,
    /// Site class of the code
    #[arg(
        long,
        value_name = "CLASS",
        help_heading = "Hazard (one of --hazard, --hazard-power, --hazard-code)"
    )]
    site: Option<String>,
    /// Hazard factor Z of the code
    #[arg(long, positive = Dimension::Ratio, help_heading = "Hazard (one of --hazard, --hazard-power, --hazard-code)")]
    hazard_factor: Option<Given>,
    /// Distance to the nearest major fault, of NZS 1170.5
    #[arg(long, non_negative = Dimension::Length, help_heading = "Hazard (one of --hazard, --hazard-power, --hazard-code)")]
    fault_distance: Option<Given>,

    /// Costs and accepted rates of objects: the inventory (CSV or XLSX)
    #[arg(long, value_name = "FILE", help_heading = "Money")]
    inventory: Option<PathBuf>,
    #[command(flatten, next_help_heading = "Money")]
    list: CellKeys,
    /// Options, such as straps or pads: id, option, cost [AUD], median_factor or curves (CSV)
    #[arg(long, value_name = "FILE", help_heading = "Money")]
    options: Option<PathBuf>,
    /// The most that options may cost, such as "20000 AUD"
    #[arg(long, value_name = "AMOUNT", read = amount, help_heading = "Money")]
    budget: Option<Given<(f64, String)>>,
    /// Years over which the savings of options count, such as "40 yr"
    #[arg(long, value_name = "YEARS", read = years, help_heading = "Money")]
    horizon: Option<Given>,
    /// Discount rate per year, compounded continuously, such as "3 %"
    #[arg(long, non_negative = Dimension::Ratio, help_heading = "Money")]
    discount: Option<Given>,

    /// Rate of overturning that is accepted where the inventory has none, such as "1e-4 /yr"
    #[arg(long, value_name = "RATE", read = yearly_rate)]
    accepted: Option<Given>,
    /// Years for which the chance of a failure is stated [default: 50]
    #[arg(long, value_name = "YEARS", read = years)]
    years: Option<Given>,
    #[command(flatten)]
    tables: TableArgs,
}

pub(crate) fn run(
    args: &RiskArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    refuse_unread(args)?;
    let request = request(args, global)?;
    let inputs: Vec<PathBuf> = [
        &args.fragility,
        &args.outcomes,
        &args.curve.hazard,
        &args.inventory,
        &args.options,
    ]
    .into_iter()
    .flatten()
    .cloned()
    .collect();
    let files = Files::with_tables(
        global,
        &inputs,
        &args.tables,
        RISK_SCHEMA,
        Some(global.seed()),
    )?;
    // Before the fits, so that no signal is missed between them and the files.
    let stop = printer.stop();
    let go_on = || {
        if stop.wanted() {
            Err(Failure::Stopped { printed: false })
        } else {
            Ok(())
        }
    };
    let report = watched(printer, |progress| risk(&request, progress)).map_err(stopped)?;
    let facts = report.facts();
    if files.wanted() {
        files.table("risk", || report.table())?;
        go_on()?;
        let json = document(RISK_SCHEMA, &facts, &report.warnings)?;
        files.write("risk.json", || json)?;
        let figure = report.figure()?;
        if let Some(figure) = &figure {
            files.drawn("risk", figure)?;
        }
        go_on()?;
        files.write("report.html", || report.html(figure.as_ref()))?;
    }
    files.finish_result(RISK_SCHEMA, &report.warnings)?;
    printer.result(RISK_SCHEMA, &facts, &report.warnings, || report.text())?;
    Ok(Done {
        criterion_met: report.is_accepted(),
    })
}

/// Refuses flags that nothing reads beside the others.
fn refuse_unread(args: &RiskArgs) -> Result<(), Failure> {
    let of_fit = [
        ("fit", args.fit.is_some()),
        ("bootstrap", args.bootstrap.is_some()),
    ];
    let of_options = [
        ("horizon", args.horizon.is_some()),
        ("discount", args.discount.is_some()),
    ];
    let of_file = [("site-coordinates", args.curve.site_coordinates.is_some())];
    let given = |flags: &[(&'static str, bool)]| -> Vec<&'static str> {
        flags
            .iter()
            .filter(|(_, is_given)| *is_given)
            .map(|(flag, _)| *flag)
            .collect()
    };
    if args.fragility.is_some() {
        refuse_idle(
            given(&of_fit),
            "the curves of --fragility are fitted already",
        )?;
    }
    if args.options.is_none() {
        refuse_idle(
            given(&of_options),
            "there are no --options whose savings would count over years",
        )?;
    }
    if args.curve.hazard.is_none() {
        refuse_idle(
            given(&of_file),
            "it chooses a site of a file of --hazard, and none is given",
        )?;
    }
    Ok(())
}

fn request(args: &RiskArgs, global: &GlobalArgs) -> Result<RiskRequest, Failure> {
    let list = cells(&args.list)?;
    if let (None, Some(flag)) = (&args.inventory, of_cells(&args.list)) {
        let message = format!("{flag} says how an inventory is read, and none is given");
        return Err(Failure::usage(message, "give --inventory, or leave it out"));
    }
    let mut values = Values::default();
    let given = args.curve.given(&mut values);
    let hazard_factor = values.read(&args.hazard_factor);
    let fault_distance_m = values.read(&args.fault_distance);
    let site_deg = values.read(&args.curve.site_coordinates);
    let (budget, horizon_years) = (values.read(&args.budget), values.read(&args.horizon));
    let (discount_ratio, accepted_rate) =
        (values.read(&args.discount), values.read(&args.accepted));
    let years = values.read(&args.years);
    values.finish()?;
    let hazard = HazardGiven {
        code: args.hazard_code,
        site: args.site.clone(),
        hazard_factor,
        fault_distance_m,
        ..given
    };
    let hazard = hazard.source()?;
    let curves = RiskCurves::given(args.fragility.clone(), args.outcomes.clone(), |outcomes| {
        FragilityRequest {
            outcomes,
            at: args.at,
            fit: args.fit.unwrap_or(FitKind::Ordered),
            shock: None,
            replicates: args.bootstrap,
            seed: global.seed(),
        }
    })?;
    Ok(RiskRequest {
        curves,
        hazard,
        hazard_at: args.at,
        site_deg,
        inventory: args.inventory.clone(),
        list,
        options: args.options.clone(),
        budget,
        horizon_years,
        discount_ratio,
        accepted_rate,
        years,
    })
}
