//! `freestand rock --base compliant --width`: an object in three dimensions.

use std::path::PathBuf;

use clap::Args;
use freestand::compliant::CompliantBase;
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, Release};
use freestand::rocking::RockingModel;
use freestand::spatial::{Shape, SpatialObject, Support, Wall};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_study::compliant::with_tangential_stiffness;
use freestand_study::cushion::EdgeCushion;
use freestand_study::recorded::{Second, read_all};
use freestand_study::spatial::{
    SHAPES, ShapeName, SpatialRequest, rock_in_space, shape, spatial_figure, spatial_table,
    walls_on_cushions,
};

use super::{Reading, RockArgs, SCHEMA};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::commands::motion::plot::place;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::reading::components;
use crate::values::{Given, Reads, Values, choice};

/// Flags of an object in three dimensions.
#[derive(Debug, Args)]
#[command(next_help_heading = "Three dimensions, on a compliant base")]
pub(crate) struct SpatialArgs {
    /// Horizontal size of the object across the thickness; with it the object moves in three
    /// dimensions, and --motion acts along the thickness
    #[arg(long, positive = Dimension::Length)]
    width: Option<Given>,
    /// Shape of the object [default: prism]
    #[arg(long, value_parser = choice(SHAPES))]
    shape: Option<ShapeName>,
    /// Record of the horizontal acceleration along the width, with the step and length of --motion
    #[arg(long, value_name = "FILE")]
    motion_y: Option<PathBuf>,
    /// Two horizontal components of the file of --motion, along the thickness and along the width:
    /// "both", or two by name or number, such as "1, 2"
    #[arg(long, value_name = "both|NAME, NAME", conflicts_with_all = ["component", "motion_y"], read = components)]
    components: Option<Given<Second>>,
    /// How far the object is turned from the direction of --motion, anticlockwise from above
    /// [default: 0 deg]
    #[arg(long, any = Dimension::Angle)]
    orientation: Option<Given>,
}

/// What objects in space and stacks have in common.
pub(super) struct Common {
    pub(super) height_m: f64,
    pub(super) thickness_m: f64,
    pub(super) mass_kg: f64,
    pub(super) edge: EdgeCushion,
    pub(super) support: Support,
    pub(super) how: HistoryOptions,
}

impl Common {
    /// The object and its support; problems are added to `values`. `kind` names what is calculated.
    pub(super) fn read(args: &RockArgs, kind: &str, mut values: Values) -> Result<Self, Failure> {
        let flags = &args.compliant;
        let planar = flags
            .given
            .iter()
            .map(String::as_str)
            .find(|flag| ["cg-rise", "contacts", "at"].contains(flag));
        let planar = planar.map(|flag| format!("--{flag}"));
        if let Some(flag) = planar.or(args.shape.given().map(str::to_owned)) {
            let hint = "leave it out: the object is uniform, on the edges of its base";
            return Err(Failure::usage(
                format!("{flag} does not apply to {kind}"),
                hint,
            ));
        }
        if let Some(flag) = args.rocking.of_rigid_base() {
            return Err(super::compliant::of_rigid_base(flag));
        }
        if args.motion.len() > 1 {
            let hint = "name one; several make shares and fractiles, one history each";
            return Err(Failure::usage(
                format!("several motions do not apply to {kind}"),
                hint,
            ));
        }
        let height = values.read(&args.height);
        let thickness = values.read(&args.thickness);
        let mass = values.read(&args.mass);
        let edge = args.cushion.edge(mass, &mut values)?;
        let friction_ratio = values.read(&args.friction);
        let tangential = values.read(&flags.tangential_stiffness);
        let ratio = values.read(&flags.tangential_ratio);
        let rotation = values.read(&args.initial_rotation);
        let omega = values.read(&args.initial_velocity);
        let gravity = values.read(&args.gravity);
        let duration_s = values.read(&args.duration);
        let settings = args.settings(gravity, duration_s);
        values.finish()?;
        let (Some((height_m, thickness_m)), Some((mass_kg, edge))) =
            (height.zip(thickness), mass.zip(edge))
        else {
            return Err(super::compliant::without_cushion());
        };
        let start = Release {
            rotation_rad: rotation.unwrap_or(0.0),
            omega_rad_s: omega.unwrap_or(0.0),
        };
        if args.motion.is_empty() && args.vertical.is_none() && duration_s.is_none() {
            let hint = "give --motion FILE, or --initial-rotation with --duration";
            return Err(Failure::usage("nothing moves the object", hint));
        }
        let mut base = CompliantBase {
            friction_ratio,
            ..CompliantBase::new(mass_kg, edge.cushion.clone())
        };
        base.tangential_stiffness_ratio = ratio.unwrap_or(base.tangential_stiffness_ratio);
        if let Some(stiffness_n_m) = tangential {
            base = with_tangential_stiffness(base, stiffness_n_m, settings.gravity_m_s2);
        }
        let CompliantBase {
            cushion,
            tangential_stiffness_ratio,
            friction_ratio,
            ..
        } = base;
        Ok(Self {
            height_m,
            thickness_m,
            mass_kg,
            edge,
            support: Support {
                cushion,
                tangential_stiffness_ratio,
                friction_ratio,
            },
            how: HistoryOptions {
                settings,
                start,
                ..HistoryOptions::default()
            },
        })
    }
}

/// Calculates and prints an object in space.
pub(super) fn run(
    args: &RockArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let target = args.plot.target(global)?;
    let mut values = Values::default();
    let width = values.read(&args.spatial.width);
    let orientation = values.read(&args.spatial.orientation);
    let second = values.read(&args.spatial.components);
    // Flags of three dimensions, or a wall in the plane of the thickness.
    let is_planar = args.spatial.given.is_empty();
    let kind = if is_planar {
        "an object on cushions at a wall"
    } else {
        "an object in three dimensions"
    };
    let common = Common::read(args, kind, values)?;
    let named = args.spatial.shape.unwrap_or_default();
    let mut values = Values::default();
    let shape = if is_planar {
        Some(Shape::Plane {
            thickness_m: common.thickness_m,
            height_m: common.height_m,
        })
    } else {
        values.take(shape(named, common.height_m, common.thickness_m, width))
    };
    let walls = walls(args, &common, &mut values);
    let (shape, walls) = values.finish_with(shape.zip(walls))?;
    let (name, motions, mut reading) = motions(args, second)?;
    let mut request = SpatialRequest {
        object: SpatialObject {
            shape,
            mass_kg: common.mass_kg,
            support: common.support,
            walls,
        },
        edge: common.edge,
        motions,
        vertical: reading.vertical.take(),
        orientation_rad: orientation.unwrap_or(0.0),
        how: common.how,
    };
    let files = Files::with_tables(global, &reading.inputs, &args.tables, SCHEMA, None)?;
    request.how.is_sampled = args.history.is_some() || files.wanted() || target.is_some();
    let report = rock_in_space(&request)?;
    let figure = || spatial_figure(&name, &report);
    let mut facts = report.facts.clone();
    if let Some(target) = &target {
        let figures = figure()?
            .into_iter()
            .map(|figure| ("spatial".to_owned(), figure))
            .collect();
        facts = facts.key("plots", place(target, figures, &files, &reading.inputs)?);
    }
    let history = || spatial_table(&report.history.samples);
    reading.finish(
        args.history.as_deref(),
        history,
        (facts, report.warnings.clone()),
        files,
        printer,
    )
}

/// The walls beside the object; problems are added to `values`.
fn walls(args: &RockArgs, common: &Common, values: &mut Values) -> Option<Vec<Wall>> {
    if args
        .walls
        .given
        .iter()
        .any(|flag| flag == "wall-restitution")
    {
        let message = "--wall-restitution applies only to a rigid base";
        let hint = "leave it out: on cushions, what an impact at a wall returns follows from its cushion, which \
                    --wall-stiffness describes";
        values.push(Problem::value(message, hint));
        return None;
    }
    let block = args.shape.block(
        (common.height_m, common.thickness_m),
        Some(common.mass_kg),
        values,
    )?;
    let model = RockingModel::Rigid;
    let (walls, stiffness) = args
        .walls
        .read(Some(&block), Some(common.mass_kg), model, values);
    let cushion = &common.support.cushion;
    values.take(walls_on_cushions(
        &walls,
        stiffness.stiffness_n_m,
        cushion,
        common.mass_kg,
    ))
}

/// The name of the motion, both horizontal components, and the rest of what was read.
fn motions(
    args: &RockArgs,
    second: Option<Second>,
) -> Result<(String, [Option<Motion>; 2], Reading), Failure> {
    if args.motion.is_empty() && (second.is_some() || args.spatial.motion_y.is_some()) {
        let hint = "name the motion along the thickness with --motion";
        return Err(Failure::usage(
            "the motion along the width has no motion along the thickness",
            hint,
        ));
    }
    if args.motion.is_empty() && args.vertical.is_none() {
        args.read
            .refuse_without_record(|_| "name the record with --motion".to_owned())?;
    }
    let name = |reading: &Reading| {
        reading
            .horizontal
            .first()
            .map_or("no motion".to_owned(), |named| named.0.clone())
    };
    let Some(second) = second else {
        let mut reading = Reading::of(args)?;
        let name = name(&reading);
        let x = reading.horizontal.pop().map(|named| named.1);
        let y = args
            .spatial
            .motion_y
            .as_ref()
            .map(|path| reading.read(&args.read, path))
            .transpose()?;
        reading.inputs.extend(args.spatial.motion_y.clone());
        return Ok((name, [x, y.map(|named| named.1)], reading));
    };
    let mut reading = Reading::without_horizontal(args)?;
    let mut values = Values::default();
    let mut files = args.read.files(&args.motion, &mut values);
    values.finish()?;
    files.second = second;
    let mut across = None;
    for read in read_all(&files)? {
        across = read
            .motion
            .across
            .as_ref()
            .map(|across| across.motion.clone());
        reading.enter(&read);
        reading
            .horizontal
            .push((read.motion.name, read.motion.motion));
    }
    let name = name(&reading);
    let x = reading.horizontal.pop().map(|named| named.1);
    Ok((name, [x, across], reading))
}
