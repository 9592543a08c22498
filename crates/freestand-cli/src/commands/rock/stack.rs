//! `freestand rock --base compliant --upper-height …`: a stack of two objects.

use clap::Args;
use freestand::spatial::{Stack, StackBody, Support};
use freestand_input::quantity::Dimension;
use freestand_study::spatial::{StackRequest, interface, rock_stacked, stack_figure, stack_table};

use super::spatial::Common;
use super::{Reading, RockArgs, SCHEMA};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::commands::motion::plot::place;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::values::{Given, Reads, Values};

/// Flags of the upper object of a stack.
#[derive(Debug, Args)]
#[command(next_help_heading = "A second object on top, on a compliant base")]
pub(crate) struct StackArgs {
    /// Height of an object that stands on top, in the plane of the thickness; --height, --thickness
    /// and --mass describe the lower one
    #[arg(long, positive = Dimension::Length)]
    upper_height: Option<Given>,
    /// Thickness of the upper object
    #[arg(long, positive = Dimension::Length)]
    upper_thickness: Option<Given>,
    /// Mass of the upper object
    #[arg(long, positive = Dimension::Mass)]
    upper_mass: Option<Given>,
    /// Stiffness of the cushion under one edge of the upper object [default: that under the lower
    /// one]
    #[arg(long, positive = Dimension::Stiffness)]
    interface_stiffness: Option<Given>,
    /// Coefficient of friction between the objects [default: no slip]
    #[arg(long, non_negative = Dimension::Ratio)]
    interface_friction: Option<Given>,
}

/// Calculates and prints a stack.
pub(super) fn run(
    args: &RockArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let target = args.plot.target(global)?;
    if args.initial_rotation.is_some() || args.initial_velocity.is_some() {
        let hint = "leave it out: a stack starts from rest";
        return Err(Failure::usage(
            "--initial-rotation and --initial-velocity do not apply to a stack",
            hint,
        ));
    }
    let (flags, mut values) = (&args.stack, Values::default());
    let height = values.read(&flags.upper_height);
    let thickness = values.read(&flags.upper_thickness);
    let mass = values.read(&flags.upper_mass);
    let stiffness = values.read(&flags.interface_stiffness);
    let friction_ratio = values.read(&flags.interface_friction);
    let common = Common::read(args, "a stack", values)?;
    let (Some((height_m, thickness_m)), Some(mass_kg)) = (height.zip(thickness), mass) else {
        let hint = "give --upper-height, --upper-thickness and --upper-mass, all three";
        return Err(Failure::usage(
            "the upper object of the stack is incomplete",
            hint,
        ));
    };
    let mut values = Values::default();
    let cushion = values.take(interface(
        &common.edge.cushion,
        stiffness,
        common.mass_kg,
        mass_kg,
    ));
    let cushion = values.finish_with(cushion)?;
    let stack = Stack {
        lower: StackBody {
            height_m: common.height_m,
            thickness_m: common.thickness_m,
            mass_kg: common.mass_kg,
        },
        upper: StackBody {
            height_m,
            thickness_m,
            mass_kg,
        },
        interface: Support {
            cushion,
            friction_ratio,
            ..common.support.clone()
        },
        support: common.support,
    };
    let mut reading = Reading::of(args)?;
    let (name, horizontal) = reading
        .horizontal
        .pop()
        .map_or(("no motion".to_owned(), None), |(name, motion)| {
            (name, Some(motion))
        });
    let vertical = reading.vertical.take();
    let mut request = StackRequest {
        stack,
        edge: common.edge,
        horizontal,
        vertical,
        how: common.how,
    };
    let files = Files::with_tables(global, &reading.inputs, &args.tables, SCHEMA, None)?;
    request.how.is_sampled = args.history.is_some() || files.wanted() || target.is_some();
    let report = rock_stacked(&request)?;
    let mut facts = report.facts.clone();
    if let Some(target) = &target {
        let figures = stack_figure(&name, &report)?
            .into_iter()
            .map(|figure| ("stack".to_owned(), figure))
            .collect();
        facts = facts.key("plots", place(target, figures, &files, &reading.inputs)?);
    }
    let history = || stack_table(&report.history.samples);
    reading.finish(
        args.history.as_deref(),
        history,
        (facts, report.warnings.clone()),
        files,
        printer,
    )
}
