//! `freestand shock`: one landing.

use std::path::PathBuf;

use clap::Args;
use freestand::impact::ImpactModel;
use freestand_input::quantity::Dimension;
use freestand_study::shock::{
    Energy, MODELS, SCENARIOS, Scenario, ShockRequest, Verdict, boundary_tests, shock,
};

use super::Done;
use super::block::ShapeArgs;
use crate::args::GlobalArgs;
use crate::cushion::CushionArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, lines};
use crate::values::{Given, Reads, Values, choice, name_of, point};

/// Calculate the shock of one landing: acceleration of the edge, pulse, ceiling and verdict
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  Test 1 of Table I in the paper, a cabinet released at a rise of its centre of gravity of 16 mm:
    freestand shock --height \"2.3 m\" --thickness \"600 mm\" --mass \"140 kg\" \\
      --stiffness \"4380 N/mm\" --cg-rise \"16 mm\"
  Two pads under each edge, and an object that withstands 5 g:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg --pad-stiffness \"2190 N/mm\" \\
      --pads-per-edge 2 --uplift \"30 mm\" --tolerance 5g
  The same on pads that a laboratory tested, under legs of 9000 N/mm:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg --cushion cushion.toml \\
      --pads-per-edge 2 --series-stiffness \"9000 N/mm\" --uplift \"30 mm\"
  A verdict from shock tests of the object (ASTM D3332), in a file with the columns
  velocity change [m/s],peak acceleration [g],damaged,method:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg --stiffness \"4380 N/mm\" \\
      --uplift \"30 mm\" --damage-boundary tests.csv --out shock
  The object falls over onto the floor:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg \\
      --scenario overturn-floor --contact-stiffness \"2000 N/mm\"")]
pub(crate) struct ShockArgs {
    /// Height of the object
    #[arg(long, positive = Dimension::Length)]
    height: Given,
    /// Horizontal size of the object in the plane of rocking
    #[arg(long, positive = Dimension::Length)]
    thickness: Given,
    /// Mass of the object
    #[arg(long, positive = Dimension::Mass)]
    mass: Given,
    #[command(flatten)]
    shape: ShapeArgs,

    #[command(flatten)]
    cushion: CushionArgs,
    /// Stiffness between the side of the object and what it falls onto
    #[arg(long, positive = Dimension::Stiffness, help_heading = "The cushion")]
    contact_stiffness: Option<Given>,
    /// Measured peak acceleration of the same mass dropped by the same rise, instead of a stiffness
    #[arg(long, positive = Dimension::Acceleration, help_heading = "The cushion")]
    drop_acceleration: Option<Given>,

    /// Rise of the centre of gravity
    #[arg(long, non_negative = Dimension::Length, group = "energy", help_heading = "The fall (one of)")]
    cg_rise: Option<Given>,
    /// Uplift of the free edge
    #[arg(long, non_negative = Dimension::Length, group = "energy", help_heading = "The fall (one of)")]
    uplift: Option<Given>,
    /// Rotation of the object
    #[arg(long, any = Dimension::Angle, group = "energy", help_heading = "The fall (one of)")]
    rotation: Option<Given>,
    /// Angular velocity just before the landing
    #[arg(long, any = Dimension::AngularVelocity, group = "energy", help_heading = "The fall (one of)")]
    angular_velocity: Option<Given>,

    /// What ends the fall
    #[arg(
        long,
        value_parser = choice(SCENARIOS),
        default_value = name_of(SCENARIOS, Scenario::default()),
        help_heading = "The landing"
    )]
    scenario: Scenario,
    /// Impact model [default: that of the scenario; halted for a squat object]
    #[arg(long, value_parser = choice(MODELS), help_heading = "The landing")]
    model: Option<ImpactModel>,
    /// Distance to the obstacle
    #[arg(long, positive = Dimension::Length, help_heading = "The landing")]
    gap: Option<Given>,
    /// Height of the obstacle [default: taller than the object]
    #[arg(long, positive = Dimension::Length, help_heading = "The landing")]
    obstacle_height: Option<Given>,
    /// Point whose shock is wanted: "x, z", from the pivot and above the base
    #[arg(long, value_name = "X, Z", read = point, help_heading = "The landing")]
    at: Option<Given<(f64, f64)>>,
    /// Coefficient of friction, used for the warning about sliding [default: 0.5]
    #[arg(long, positive = Dimension::Ratio, help_heading = "The landing")]
    friction: Option<Given>,
    /// Gravity [default: 1 g]
    #[arg(long, positive = Dimension::Acceleration, help_heading = "The landing")]
    gravity: Option<Given>,

    /// Peak acceleration that the object withstands
    #[arg(long, positive = Dimension::Acceleration, help_heading = "The verdict")]
    tolerance: Option<Given>,
    /// Duration of the half-sine pulse for which that peak was shown
    #[arg(long, positive = Dimension::Time, help_heading = "The verdict")]
    tolerance_duration: Option<Given>,
    /// Velocity change below which no peak damages the object
    #[arg(long, positive = Dimension::Velocity, help_heading = "The verdict")]
    tolerance_velocity_change: Option<Given>,
    /// Shock tests of the object (ASTM D3332): a table with velocity change, peak acceleration and
    /// damaged (yes, no), and optionally method (A, B) or duration
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["tolerance", "tolerance_duration", "tolerance_velocity_change"],
        help_heading = "The verdict"
    )]
    damage_boundary: Option<PathBuf>,
    /// Uplift of one edge from which the object may fall back (bench handling)
    #[arg(long, positive = Dimension::Length, help_heading = "The verdict")]
    tolerance_edge_lift: Option<Given>,
    /// Natural frequency of the most delicate component; needs --component-capacity
    #[arg(long, positive = Dimension::Frequency, help_heading = "The verdict")]
    component_frequency: Option<Given>,
    /// Acceleration that this component withstands
    #[arg(long, positive = Dimension::Acceleration, help_heading = "The verdict")]
    component_capacity: Option<Given>,
}

pub(crate) fn run(
    args: &ShockArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let request = request(args)?;
    let inputs: Vec<PathBuf> = args
        .cushion
        .inputs()
        .into_iter()
        .chain(args.damage_boundary.clone())
        .collect();
    let files = Files::begin(global, &inputs)?;
    let report = shock(&request)?;
    if let Some(boundary) = report.damage_boundary {
        files.figure("damage-boundary", || {
            boundary.figure(request.boundary_tests.as_ref())
        })?;
    }
    let facts = &report.facts;
    files.print(
        printer,
        "freestand.shock/1",
        facts,
        &report.warnings,
        || lines(facts),
    )?;
    Ok(Done {
        criterion_met: report.verdict != Verdict::Exceeded,
    })
}

fn request(args: &ShockArgs) -> Result<ShockRequest, Failure> {
    let mut values = Values::default();
    let height = values.read(&args.height);
    let thickness = values.read(&args.thickness);
    let mass = values.read(&args.mass);
    let contact_stiffness_n_m = values.read(&args.contact_stiffness);
    let drop_acceleration_m_s2 = values.read(&args.drop_acceleration);
    let gap_m = values.read(&args.gap);
    let obstacle_height_m = values.read(&args.obstacle_height);
    let friction_ratio = values.read(&args.friction);
    let gravity_m_s2 = values.read(&args.gravity);
    let tolerance_m_s2 = values.read(&args.tolerance);
    let tolerance_duration_s = values.read(&args.tolerance_duration);
    let tolerance_velocity_change_m_s = values.read(&args.tolerance_velocity_change);
    let tolerance_edge_lift_m = values.read(&args.tolerance_edge_lift);
    let component_frequency_hz = values.read(&args.component_frequency);
    let component_capacity_m_s2 = values.read(&args.component_capacity);
    let cushion = args.cushion.words(&mut values)?;
    // Wrong values are reported with the other flags; missing and contradictory ones, by `shock`.
    if ["law", "stiffness", "pad_stiffness"]
        .iter()
        .any(|key| cushion.get(key).is_some())
    {
        values.take(freestand_study::cushion::resolve(&cushion, mass));
    }
    let block = height
        .zip(thickness)
        .and_then(|size| args.shape.block(size, mass, &mut values));
    let at_m = values.read(&args.at);
    let energy = energy(args, &mut values);
    values.finish()?;
    let boundary_tests = args
        .damage_boundary
        .as_deref()
        .map(boundary_tests)
        .transpose()?;
    let (Some(block), Some(mass_kg)) = (block, mass) else {
        return Err(Failure::usage(
            "the size or the mass of the object is missing",
            "give --height, --thickness and --mass",
        ));
    };
    let bare = ShockRequest::new(block, mass_kg);
    Ok(ShockRequest {
        cushion,
        contact_stiffness_n_m,
        drop_acceleration_m_s2,
        energy,
        scenario: args.scenario,
        model: args.model,
        gap_m,
        obstacle_height_m,
        at_m,
        gravity_m_s2: gravity_m_s2.unwrap_or(bare.gravity_m_s2),
        friction_ratio,
        tolerance_m_s2,
        tolerance_duration_s,
        tolerance_velocity_change_m_s,
        boundary_tests,
        tolerance_edge_lift_m,
        component_frequency_hz,
        component_capacity_m_s2,
        ..bare
    })
}

/// The energy of the fall, from the one of these flags that was given.
fn energy(args: &ShockArgs, values: &mut Values) -> Option<Energy> {
    let rise = values.read(&args.cg_rise);
    let uplift = values.read(&args.uplift);
    let rotation = values.read(&args.rotation);
    let speed = values.read(&args.angular_velocity);
    rise.map(Energy::CgRise)
        .or(uplift.map(Energy::Uplift))
        .or(rotation.map(Energy::Rotation))
        .or(speed.map(Energy::AngularVelocity))
}
