//! `freestand rock --base compliant`: one object on its cushions.

use clap::{Args, ValueEnum};
use freestand::compliant::CompliantBase;
use freestand::respond::{Along, HistoryOptions, Pads, Plane, Planes};
use freestand_input::quantity::Dimension;
use freestand_study::compliant::{
    CompliantRequest, Turned, history_table, rock_on_cushions, start, trace_figure,
    with_tangential_stiffness,
};
use freestand_study::drawn::drawn_on_pads;

use super::{Beside, Reading, RockArgs, SCHEMA, spatial, stack};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::values::{Given, Reads, Values, point};

/// Flags that describe the base of the object.
#[derive(Debug, Args)]
#[command(next_help_heading = "The base")]
pub(crate) struct CompliantArgs {
    /// Floor contact: rigid edges, or a cushion under each edge, which needs --mass and --stiffness
    #[arg(long, value_enum, default_value_t)]
    base: BaseName,
    /// Tangential stiffness of the cushion under one edge [default: equal to the normal stiffness,
    /// an assumption]
    #[arg(long, positive = Dimension::Stiffness, conflicts_with = "tangential_ratio")]
    pub(super) tangential_stiffness: Option<Given>,
    /// Tangential stiffness divided by the normal stiffness under half of the weight
    #[arg(long, positive = Dimension::Ratio)]
    pub(super) tangential_ratio: Option<Given>,
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

pub(super) fn run(
    args: &RockArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match (args.spatial.given.first(), args.stack.given.first()) {
        (Some(space), Some(upper)) => {
            let hint = "leave one of them out: a stack moves in the plane of the thickness";
            return Err(Failure::usage(
                format!("--{space} does not apply to a stack (--{upper})"),
                hint,
            ));
        }
        (None, Some(upper)) => {
            if let Some(wall) = args.walls.given.first() {
                let hint = "leave one of them out: a stack stands freely";
                return Err(Failure::usage(
                    format!("--{wall} does not apply to a stack (--{upper})"),
                    hint,
                ));
            }
            return stack::run(args, global, printer);
        }
        (Some(_), None) => return spatial::run(args, global, printer),
        // At a wall, the object is followed by the solver that has walls, without a width in the
        // plane.
        (None, None) if !args.walls.given.is_empty() => return spatial::run(args, global, printer),
        (None, None) => {}
    }
    if args.motion.len() > 1 || args.plot.is_given() {
        let hint = "name one motion; with --out, the figure of the landings is drawn";
        return Err(Failure::usage(
            "several motions and --plot apply only to a rigid base",
            hint,
        ));
    }
    let (mut request, reading) = request(args)?;
    let files = Files::with_tables(global, &reading.inputs, &args.tables, SCHEMA, None)?;
    let session = printer.session().filter(|session| session.wants_history());
    request.how.is_sampled = args.history.is_some() || files.wanted() || session.is_some();
    let report = rock_on_cushions(&request)?;
    if let Some(session) = session {
        let block = &request.object.planes.one.block;
        let history = drawn_on_pads(block, &report.history, request.horizontal.as_ref());
        session.beside(&Beside { history });
    }
    if !report.history.rocking.touches.is_empty() {
        files.figure("trace", || trace_figure(&report))?;
    }
    let history = || history_table(&report.history.samples);
    reading.finish(
        args.history.as_deref(),
        history,
        (report.facts, report.warnings),
        files,
        printer,
    )
}

/// Refuses a flag of the rigid base.
pub(super) fn of_rigid_base(flag: &str) -> Failure {
    let hint =
        "leave it out: on cushions, the equations of motion determine the energy lost in a landing";
    Failure::usage(format!("{flag} applies only to a rigid base"), hint)
}

/// Refuses a compliant base without its numbers.
pub(super) fn without_cushion() -> Failure {
    let hint =
        "give --mass and the --stiffness of the whole cushion under one edge, or --base rigid";
    Failure::usage("a compliant base needs a mass and a stiffness", hint)
}

fn request(args: &RockArgs) -> Result<(CompliantRequest, Reading), Failure> {
    if let Some(flag) = args.rocking.of_rigid_base() {
        return Err(of_rigid_base(flag));
    }
    let (flags, mut values) = (&args.compliant, Values::default());
    let height = values.read(&args.height);
    let thickness = values.read(&args.thickness);
    let mass = values.read(&args.mass);
    let edge = args.cushion.edge(mass, &mut values)?;
    let block = height
        .zip(thickness)
        .and_then(|size| args.shape.block(size, mass, &mut values));
    let tangential = values.read(&flags.tangential_stiffness);
    let ratio = values.read(&flags.tangential_ratio);
    let friction_ratio = values.read(&args.friction);
    let rise = values.read(&flags.cg_rise);
    let rotation = values.read(&args.initial_rotation);
    let omega = values.read(&args.initial_velocity);
    let gravity = values.read(&args.gravity);
    let duration_s = values.read(&args.duration);
    let at = values.read(&flags.at);
    let turned = rise.map(Turned::CgRise).or(rotation.map(Turned::Rotation));
    let start = block.and_then(|block| values.take(start(&block, turned, omega.unwrap_or(0.0))));
    values.finish()?;
    let (Some((block, start)), Some((mass_kg, edge))) = (block.zip(start), mass.zip(edge)) else {
        return Err(without_cushion());
    };
    if args.motion.is_empty() && args.vertical.is_none() {
        args.read
            .refuse_without_record(|_| "name the record with --motion".to_owned())?;
        if start.is_at_rest() {
            let hint = "give --motion FILE, or --cg-rise, --initial-rotation or --initial-velocity";
            return Err(Failure::usage("nothing moves the object", hint));
        }
    }
    let settings = args.settings(gravity, duration_s);
    let mut base = CompliantBase {
        friction_ratio,
        ..CompliantBase::new(mass_kg, edge.cushion)
    };
    base.contacts = flags.contacts.unwrap_or(base.contacts);
    base.tangential_stiffness_ratio = ratio.unwrap_or(base.tangential_stiffness_ratio);
    if let Some(stiffness_n_m) = tangential {
        base = with_tangential_stiffness(base, stiffness_n_m, settings.gravity_m_s2);
    }
    let mut reading = Reading::of(args)?;
    let (horizontal, vertical) = (
        reading.horizontal.pop().map(|named| named.1),
        reading.vertical.take(),
    );
    let how = HistoryOptions {
        settings,
        start,
        points_m: at.into_iter().collect(),
        is_sampled: false,
    };
    let along = Along::X;
    let planes = Planes::single(Plane { along, block });
    Ok((
        CompliantRequest {
            object: Pads { planes, base },
            pad_thickness_m: edge.pad_thickness_m,
            notes: edge.notes,
            horizontal,
            vertical,
            how,
        },
        reading,
    ))
}
