//! `freestand rock --base compliant`: the object on cushions.

use clap::{Args, ValueEnum};
use freestand::G0_M_S2;
use freestand::compliant::{ASSUMED_TANGENTIAL_RATIO, CompliantBase, CompliantOptions, Start};
use freestand_input::quantity::{Dimension, format_si};
use freestand_study::compliant::{CompliantRequest, accuracy, history_csv, rock_on_cushions, trace_figure};

use super::{Reading, RockArgs};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::{Failure, problem};
use crate::files::Files;
use crate::printer::Printer;
use crate::values::{Given, Reads, Values, point};

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

pub(super) fn run(args: &RockArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let (request, reading) = request(args)?;
    let files = Files::begin(global, &reading.inputs)?;
    let report = rock_on_cushions(&request, args.history.is_some() || files.wanted())?;
    if !report.rocking.touches.is_empty() {
        files.figure("trace", || trace_figure(&report))?;
    }
    let history = || history_csv(&report.history);
    reading.finish(args.history.as_deref(), history, (report.facts, report.warnings), files, printer)
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
    let mut reading = Reading::of(args)?;
    let (horizontal, vertical) = (reading.horizontal.take(), reading.vertical.take());
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
