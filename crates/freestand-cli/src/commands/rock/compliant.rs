//! `freestand rock --base compliant`: the object on cushions.

use clap::{Args, ValueEnum};
use freestand::G0_M_S2;
use freestand::compliant::{ASSUMED_TANGENTIAL_RATIO, CompliantBase, CompliantOptions, Start};
use freestand_input::quantity::{Dimension, format_si};
use freestand_output::folder::write_file;
use freestand_study::compliant::{CompliantReport, CompliantRequest, accuracy, history_csv, rock_on_cushions};
use freestand_study::compliant::{Trace, trace_figure};
use serde::Serialize;

use super::{Reading, RockArgs, read};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::{Failure, problem};
use crate::files::Files;
use crate::printer::{Printer, optional, pairs, significant};
use crate::values::{Given, Reads, Values, point};

/// Before and behind the first landing in the figure, over the duration of its contact.
const SHOWN_BEFORE: f64 = 2.0;
const SHOWN_BEHIND: f64 = 14.0;

/// What the object stands on.
#[derive(Debug, Args)]
#[command(next_help_heading = "The base")]
pub(crate) struct CompliantArgs {
    /// Floor contact: rigid edges, or a cushion under each edge, which needs --mass and --stiffness
    #[arg(long, value_enum, default_value_t)]
    base: BaseName,
    /// Tangential stiffness of the cushion under one edge [default: equal to the normal stiffness,
    /// an assumption]
    #[arg(long, positive = Dimension::Stiffness, conflicts_with = "tangential_ratio")]
    tangential_stiffness: Option<Given>,
    /// Tangential stiffness over the normal stiffness under half the weight
    #[arg(long, positive = Dimension::Ratio)]
    tangential_ratio: Option<Given>,
    /// The edges never slip while loaded (the default without --friction)
    #[arg(long, conflicts_with = "friction")]
    no_slip: bool,
    /// Number of contact elements, evenly spaced from edge to edge; more than 2 share the cushions
    /// of both edges [default: 2]
    #[arg(long, value_name = "N")]
    contacts: Option<usize>,
    /// Start at rest at this rise of the centre of gravity, rotated to the right
    #[arg(long, positive = Dimension::Length, conflicts_with = "initial_rotation")]
    cg_rise: Option<Given>,
    /// Point whose acceleration is wanted: "x, z", from the left edge and above the base
    #[arg(long, value_name = "X, Z", read = point)]
    at: Option<Given<(f64, f64)>>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum BaseName {
    /// Housner's model: the object rotates about fixed edges
    #[default]
    Rigid,
    /// A rigid body on cushions, integrated in time
    Compliant,
}

impl CompliantArgs {
    pub(super) fn is_compliant(&self) -> bool {
        self.base == BaseName::Compliant
    }
}

#[derive(Debug, Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a CompliantReport,
    processing: Vec<String>,
}

pub(super) fn run(args: &RockArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let (request, reading) = request(args)?;
    let inputs = args.read.inputs(args.motion.iter().chain(&args.vertical).chain(&args.cushion.inputs()));
    let files = Files::begin(global, &inputs)?;
    let mut report = rock_on_cushions(&request, args.history.is_some() || files.wanted())?;
    report.warnings.splice(0..0, reading.warnings);
    files.write("history.csv", || history_csv(&report.history))?;
    if files.wanted() {
        trace(&files, &report)?;
    }
    if let Some(path) = &args.history {
        write_file(path, history_csv(&report.history).as_bytes(), &inputs)?;
    }
    let document = Document { report: &report, processing: reading.processing };
    files.print(printer, "freestand.rock/1", &document, &report.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn request(args: &RockArgs) -> Result<(CompliantRequest, Reading), Failure> {
    if let Some(flag) = args.rocking.of_rigid_base() {
        let hint = "leave it out: on cushions the energy of a landing goes where the equations say";
        return Err(Failure::usage(format!("{flag} is of a rigid base"), hint));
    }
    let (flags, mut values) = (&args.compliant, Values::default());
    let height = values.read(&args.height);
    let thickness = values.read(&args.thickness);
    let mass = values.read(&args.mass);
    let edge = args.cushion.edge(mass, &mut values)?;
    let block = height.zip(thickness).and_then(|size| args.shape.block(size, mass, &mut values));
    let tangential = values.read(&flags.tangential_stiffness);
    let ratio = values.read(&flags.tangential_ratio);
    let friction_ratio = values.read(&args.friction);
    let rise = values.read(&flags.cg_rise);
    let rotation = values.read(&args.initial_rotation);
    let omega = values.read(&args.initial_velocity);
    let gravity = values.read(&args.gravity);
    let duration_s = values.read(&args.duration);
    let at = values.read(&flags.at);
    let raised = rise.zip(block).and_then(|(rise, block)| {
        let rotation = block.right_pivot().rotation_at_rise_rad(rise);
        if rotation.is_none() {
            let balance = format_si(block.right_pivot().balance_rise_m(), Dimension::Length);
            let message = format!("--cg-rise: beyond the balance point, which is at {balance}");
            values.push(problem(message, "give a smaller rise, or --initial-rotation"));
        }
        rotation
    });
    values.finish()?;
    let (Some(block), Some((mass_kg, edge))) = (block, mass.zip(edge)) else {
        let hint = "give --mass and --stiffness of all the cushion under one edge, or --base rigid";
        return Err(Failure::usage("a compliant base needs a mass and a stiffness", hint));
    };
    let rotation_rad = raised.or(rotation).unwrap_or(0.0);
    let omega_rad_s = omega.unwrap_or(0.0);
    let start = if rotation_rad == 0.0 && omega_rad_s == 0.0 {
        Start::Rest
    } else {
        Start::Tilted { rotation_rad, omega_rad_s }
    };
    if args.motion.is_none() && args.vertical.is_none() {
        args.read.refuse_without_record(|_| "name the record with --motion".to_owned())?;
        if start == Start::Rest {
            let hint = "give --motion FILE, or --cg-rise, --initial-rotation or --initial-velocity";
            return Err(Failure::usage("nothing moves the object", hint));
        }
    }
    let gravity_m_s2 = gravity.unwrap_or(G0_M_S2);
    let base = CompliantBase { friction_ratio, ..CompliantBase::new(mass_kg, edge.cushion) };
    let base = CompliantBase { contacts: flags.contacts.unwrap_or(base.contacts), ..base };
    let normal_n_m = base.normal_stiffness_n_m(gravity_m_s2);
    let tangential_stiffness_ratio = tangential.map(|k| k / normal_n_m).or(ratio).unwrap_or(ASSUMED_TANGENTIAL_RATIO);
    let base = CompliantBase { tangential_stiffness_ratio, ..base };
    let mut reading = Reading::default();
    let horizontal = args.motion.as_ref().map(|path| read(&args.read, path, &mut reading)).transpose()?;
    let vertically = args.vertically.reading(&args.read);
    let vertical = args.vertical.as_ref().map(|path| read(&vertically, path, &mut reading)).transpose()?;
    let options = CompliantOptions {
        gravity_m_s2,
        accuracy: accuracy(args.rocking.accuracy),
        start,
        duration_s,
        points_m: at.into_iter().collect(),
    };
    let (pad_thickness_m, notes) = (edge.pad_thickness_m, edge.notes);
    Ok((CompliantRequest { block, base, pad_thickness_m, notes, horizontal, vertical, options }, reading))
}

/// The figure of the first landing, where there is one.
fn trace(files: &Files, report: &CompliantReport) -> Result<(), Failure> {
    let Some(first) = report.impacts.first() else { return Ok(()) };
    let contact_s = first.end_time_s.unwrap_or(report.end_time_s) - first.time_s;
    let window_s = (
        (first.time_s - SHOWN_BEFORE * contact_s).max(0.0),
        (first.time_s + SHOWN_BEHIND * contact_s).min(report.end_time_s),
    );
    let about = format!(
        "{} kg on cushions ({}, tangential stiffness {} times the normal one, {})",
        significant(report.mass_kg, 4),
        report.law,
        significant(report.tangential_stiffness_ratio, 3),
        report.friction_ratio.map_or_else(|| "no slip".to_owned(), |mu| format!("friction {}", significant(mu, 3))),
    );
    let paper_g = report.edge_acceleration_paper_g;
    let figure = trace_figure(&Trace { points: &report.history, window_s, paper_g, about: &about })
        .map_err(|error| Failure::computation(error.to_string()))?;
    files.write("trace.svg", || figure.svg.clone())?;
    files.write("trace.png", || figure.png.clone())?;
    Ok(())
}

fn text(report: &CompliantReport) -> String {
    let seconds = |time: Option<f64>| time.map_or_else(|| "-".to_owned(), |t| format!("{t:.4} s"));
    let length = |m: f64| format_si(m, Dimension::Length);
    let mut rows = vec![
        ("outcome", format!("{} (to {:.4} s)", report.outcome, report.end_time_s)),
        (
            "largest rotation",
            format!(
                "{} rad ({} of the balance angle) at {:.4} s",
                significant(report.peak_rotation_rad, 6),
                significant(report.peak_rotation_ratio, 4),
                report.peak_rotation_time_s
            ),
        ),
        ("uplift of the edge", length(report.uplift_m)),
        ("rise of the centre of gravity", length(report.cg_rise_m)),
        ("first uplift", seconds(report.first_uplift_time_s)),
        ("touches of an edge", format!("{} ({} bounces)", report.impact_count, report.bounce_count)),
        ("passes the balance angle", seconds(report.passed_alpha_time_s)),
        ("overturns", seconds(report.overturn_time_s)),
        ("compression at rest", report.static_compression_m.map_or_else(|| "-".to_owned(), length)),
        ("shock at the edge, simulated", format!("{} g", significant(report.edge_acceleration_g, 4))),
    ];
    if report.first_impact_edge_acceleration_g.is_some() {
        rows.push(("  in the first landing", optional(report.first_impact_edge_acceleration_g, 4, "g")));
    }
    rows.push(("shock at the edge by Eq. (5) at this rise", optional(report.edge_acceleration_paper_g, 4, "g")));
    rows.push(match report.first_impact_over_paper_ratio {
        Some(ratio) => ("first landing over Eq. (5)", significant(ratio, 4)),
        None => ("simulated over Eq. (5)", optional(report.edge_acceleration_over_paper_ratio, 4, "")),
    });
    if let Some(at) = report.at {
        let words =
            format!("{} g across, {} g upright", significant(at.horizontal_g, 4), significant(at.vertical_g, 4));
        rows.push(("acceleration at the point", words));
    }
    rows.extend([
        ("off all cushions", format!("{} times, {:.4} s", report.flight_count, report.flight_time_s)),
        ("friction used", significant(report.friction_used_ratio, 4)),
        ("way that feet slid", length(report.slid_m)),
        ("error of the energy balance", format!("{:.1e}", report.energy.residual_ratio)),
    ]);
    rows.extend(report.notes.iter().map(|note| ("note", note.clone())));
    pairs(&rows)
}
