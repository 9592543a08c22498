//! `freestand rock`: one object under one motion, or under each of several.

mod compliant;
mod sliding;
mod spatial;
mod stack;

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::Args;
use freestand::G0_M_S2;
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, Release, RigidPlane, Settings};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_positive, shorten};
use freestand_input::words::number;
use freestand_output::facts::Facts;
use freestand_output::table::Table;
use freestand_study::drawn::{DrawnHistory, drawn};
use freestand_study::figures::rock_figure;
use freestand_study::recorded::ReadMotion;
use freestand_study::rock::{RockRequest, history_table, rock, until};
use serde::Serialize;

use self::compliant::CompliantArgs;
use self::spatial::SpatialArgs;
use self::stack::StackArgs;
use super::Done;
use super::block::{RockingArgs, ShapeArgs};
use super::motion::plot::{PlotArgs, Target, place};
use super::sliding::SlidingArgs;
use super::walls::WallArgs;
use crate::args::{GlobalArgs, Named};
use crate::cushion::CushionArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs, write_table};
use crate::printer::{Column, Printer, facts_table, lines};
use crate::reading::{ReadArgs, VerticalArgs};
use crate::values::{Given, Reads, Values};

/// Follow one object under a motion: rotation, uplift, impacts, overturning and shock
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A cabinet under a record, with the shock on its pads:
    freestand rock --motion record.AT2 --height \"2.3 m\" --thickness \"600 mm\" \\
      --mass \"140 kg\" --stiffness \"4380 N/mm\"
  A column of accelerations in g every 5 ms, multiplied by 2, with the history in a file:
    freestand rock --motion floor.txt --unit g --dt 5ms --scale 2 --height 1.5m \\
      --thickness 0.3m --history history.csv
  Several motions, a result and a figure for each:
    freestand rock --motion a.AT2 b.AT2 --height 1.5m --thickness 0.3m --plot --out histories
  The same cabinet 50 mm in front of a wall, with the shock where its top strikes the wall:
    freestand rock --motion record.AT2 --height \"2.3 m\" --thickness \"600 mm\" \\
      --mass \"140 kg\" --wall-gap 50mm --wall-stiffness \"2000 N/mm\"
  Free rocking from a rotation of 5 degrees:
    freestand rock --initial-rotation 5deg --height 1.5m --thickness 0.4m
  A low chest that slides before it can rock, with 20 cm of room on its left:
    freestand rock --motion record.AT2 --sliding --friction 0.3 --friction-kinetic 0.25 \
      --height 0.8m --thickness 0.6m --clearance-left \"200 mm\"
  A trolley on casters, as a figure:
    freestand rock --motion record.AT2 --casters --rolling-resistance 0.02 --height 1.4m \
      --thickness 0.6m --plot trolley.svg
  A cabinet released on its pads, with the history of the landing:
    freestand rock --base compliant --cg-rise \"16 mm\" --height \"2.3 m\" --thickness \"600 mm\" \\
      --mass \"140 kg\" --stiffness \"4380 N/mm\" --law kelvin-voigt --damping 5% --out landing
  A cabinet in three dimensions under two components of a record, with its walk from above:
    freestand rock --base compliant --motion record.csv --components \"1, 2\" --height \"2.1 m\" \
      --thickness \"500 mm\" --width \"700 mm\" --mass \"200 kg\" --stiffness \"4000 N/mm\" \
      --law kelvin-voigt --damping 5% --friction 0.5 --plot walk.svg
  A vase on a pedestal:
    freestand rock --base compliant --motion record.AT2 --height \"1 m\" --thickness \"400 mm\" \
      --mass \"150 kg\" --stiffness \"4000 N/mm\" --law kelvin-voigt --damping 5% \
      --upper-height \"600 mm\" --upper-thickness \"150 mm\" --upper-mass \"12 kg\" \
      --interface-stiffness \"300 N/mm\"")]
pub(crate) struct RockArgs {
    /// Records of the horizontal acceleration of the floor, each for a result of its own [default:
    /// none, free rocking]
    #[arg(long, value_name = "FILE", num_args = 1..)]
    motion: Vec<PathBuf>,
    /// Record of the vertical acceleration of the floor, positive upward, with the same step and
    /// length
    #[arg(long, value_name = "FILE")]
    vertical: Option<PathBuf>,
    #[command(flatten)]
    vertically: VerticalArgs,
    #[command(flatten)]
    read: ReadArgs,

    /// Height of the object
    #[arg(long, positive = Dimension::Length, help_heading = "The object")]
    height: Given,
    /// Horizontal size of the object in the plane of rocking
    #[arg(long, positive = Dimension::Length, help_heading = "The object")]
    thickness: Given,
    /// Mass of the object; needed for the shock
    #[arg(long, positive = Dimension::Mass, help_heading = "The object")]
    mass: Option<Given>,
    /// Coefficient of friction: on a rigid base, used for the warning about sliding [default: 0.5];
    /// with --sliding or --brakes, the friction at rest [default: 0.5]; on a compliant base, the
    /// ratio at which the edges slip [default: no slip]
    #[arg(long, non_negative = Dimension::Ratio, help_heading = "The object")]
    friction: Option<Given>,
    #[command(flatten)]
    shape: ShapeArgs,
    #[command(flatten)]
    cushion: CushionArgs,
    #[command(flatten)]
    walls: Named<WallArgs>,

    #[command(flatten)]
    compliant: Named<CompliantArgs>,
    #[command(flatten)]
    sliding: Named<SlidingArgs>,
    #[command(flatten)]
    spatial: Named<SpatialArgs>,
    #[command(flatten)]
    stack: Named<StackArgs>,

    #[command(flatten)]
    rocking: RockingArgs,
    /// Rotation at the start, positive to the right
    #[arg(long, any = Dimension::Angle, help_heading = "The rocking")]
    initial_rotation: Option<Given>,
    /// Angular velocity at the start
    #[arg(long, any = Dimension::AngularVelocity, help_heading = "The rocking")]
    initial_velocity: Option<Given>,
    /// Gravity [default: 1 g]
    #[arg(long, value_name = "ACCELERATION", read = gravity, help_heading = "The rocking")]
    gravity: Option<Given>,
    /// Time at which to stop, whether or not the object has come to rest; the floor does not move after
    /// the last sample [default: when the object rests or lies, at most 120 s after the last sample]
    #[arg(long, positive = Dimension::Time, help_heading = "The rocking")]
    duration: Option<Given>,
    /// File to write the history to: CSV, or Parquet if its name ends in .parquet
    #[arg(long, value_name = "FILE")]
    history: Option<PathBuf>,
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    plot: PlotArgs,
}

const SCHEMA: &str = "freestand.rock/1";

pub(crate) fn run(
    args: &RockArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    if let Some(failure) = args.sliding.refused(args.compliant.is_compliant()) {
        return Err(failure);
    }
    if args.compliant.is_compliant() {
        return compliant::run(args, global, printer);
    }
    if args.sliding.is_given()
        && let Some(flag) = args.walls.given.first()
    {
        let hint = "leave it out: the room beside it is --clearance-left and --clearance-right, what it strikes there \
                    --stop-stiffness";
        return Err(Failure::usage(
            format!("--{flag} applies only to an object that rocks"),
            hint,
        ));
    }
    let compliant = args.compliant.given.iter().filter(|flag| *flag != "base");
    if let Some(flag) = compliant
        .chain(&args.spatial.given)
        .chain(&args.stack.given)
        .next()
    {
        return Err(Failure::usage(
            format!("--{flag} applies only to a compliant base"),
            "add --base compliant",
        ));
    }
    if args.sliding.is_given()
        && let Some(done) = sliding::run(args, global, printer)?
    {
        return Ok(done);
    }
    let target = args.plot.target(global)?;
    let (mut request, mut reading) = request(args)?;
    if let Some(target) = &target {
        target.check(reading.horizontal.len().max(1))?;
    }
    let files = Files::with_tables(global, &reading.inputs, &args.tables, SCHEMA, None)?;
    let session = printer.session().filter(|session| session.wants_history());
    request.how.is_sampled =
        args.history.is_some() || files.wanted() || target.is_some() || session.is_some();
    if reading.horizontal.len() > 1 {
        return several(&request, reading, target.as_ref(), files, printer);
    }
    let (name, horizontal) = reading
        .horizontal
        .pop()
        .map_or((None, None), |(name, motion)| (Some(name), Some(motion)));
    let request = RockRequest {
        horizontal,
        ..request
    };
    let report = rock(&request)?;
    let block = &request.object.plane.block;
    let history = || history_table(block, &report.history.samples);
    if let Some(session) = session {
        let floor = request.horizontal.as_ref();
        session.beside(&Beside {
            history: drawn(&request.object, &report.history, &report.landings, floor),
        });
    }
    let mut plots = None;
    if let Some(target) = &target {
        let name = name.unwrap_or_else(|| "free rocking".to_owned());
        let figure = rock_figure(&name, block, &report)?;
        let figures = figure
            .into_iter()
            .map(|figure| ("history".to_owned(), figure))
            .collect();
        plots = Some(place(target, figures, &files, &reading.inputs)?);
    }
    let facts = match plots {
        Some(plots) => report.facts.key("plots", plots),
        None => report.facts,
    };
    reading.finish(
        args.history.as_deref(),
        history,
        (facts, report.warnings),
        files,
        printer,
    )
}

/// What goes beside the document of who wants to draw the history.
#[derive(Debug, Serialize)]
struct Beside {
    history: DrawnHistory,
}

/// The table of several motions.
const COLUMNS: [Column; 6] = [
    ("motion", "motion", 0),
    ("outcome", "outcome", 0),
    ("peak_rotation_rad", "rotation [rad]", 4),
    ("uplift_m", "uplift [mm]", 4),
    ("cg_rise_m", "rise [mm]", 4),
    ("impact_count", "impacts", 0),
];

/// The object under each of several motions.
fn several(
    request: &RockRequest,
    mut reading: Reading,
    target: Option<&Target>,
    files: Files,
    printer: &Printer,
) -> Result<Done, Failure> {
    let (mut results, mut plots) = (Vec::new(), Vec::new());
    for (index, (name, motion)) in std::mem::take(&mut reading.horizontal)
        .into_iter()
        .enumerate()
    {
        let request = RockRequest {
            horizontal: Some(motion),
            ..request.clone()
        };
        let report = rock(&request)?;
        let block = &request.object.plane.block;
        let file = format!("history-{:02}-{name}", index + 1);
        files.table(&file, || Ok(history_table(block, &report.history.samples)))?;
        if let Some(target) = target
            && let Some(figure) = rock_figure(&name, block, &report)?
        {
            plots.extend(place(
                target,
                vec![(file, figure)],
                &files,
                &reading.inputs,
            )?);
        }
        reading.warnings.extend(
            report
                .warnings
                .iter()
                .map(|warning| format!("{name}: {warning}")),
        );
        results.push(Facts::default().key("motion", name).and(report.facts));
    }
    let text = || facts_table(&results, &COLUMNS);
    let table = text();
    let facts = Facts::default()
        .key("results", results)
        .key("plots", plots)
        .key("processing", reading.processing.clone());
    files.print(printer, SCHEMA, &facts, &reading.warnings, || table)?;
    Ok(Done::OK)
}

/// The motions, with their warnings and their processing.
#[derive(Debug, Default)]
struct Reading {
    /// Each with its name.
    horizontal: Vec<(String, Motion)>,
    vertical: Option<Motion>,
    warnings: Vec<String>,
    processing: Vec<String>,
    inputs: Vec<PathBuf>,
}

/// Gravity, as small as on a minor planet and as large as where anything stands: 9.81 g is a slip.
fn gravity(text: &str) -> Result<f64, Problem> {
    const BELIEVED_M_S2: RangeInclusive<f64> = 0.1..=30.0;
    let value_m_s2 = parse_positive(text, Dimension::Acceleration, "the value")?;
    if BELIEVED_M_S2.contains(&value_m_s2) {
        return Ok(value_m_s2);
    }
    let message = format!(
        "\"{}\" is {} m/s2, which is no gravity",
        shorten(text),
        number(value_m_s2, 4)
    );
    Err(Problem::value(message, "write \"9.81 m/s2\" or \"1 g\""))
}

impl Reading {
    fn of(args: &RockArgs) -> Result<Self, Failure> {
        let mut reading = Self::without_horizontal(args)?;
        for path in &args.motion {
            let named = reading.read(&args.read, path)?;
            reading.horizontal.push(named);
        }
        Ok(reading)
    }

    /// The inputs and the vertical motion alone.
    fn without_horizontal(args: &RockArgs) -> Result<Self, Failure> {
        let inputs = args.read.inputs(
            args.motion
                .iter()
                .chain(&args.vertical)
                .chain(&args.cushion.inputs()),
        );
        let mut reading = Self {
            inputs,
            ..Self::default()
        };
        for read in args
            .vertically
            .read_all(&args.read, args.vertical.as_slice())?
        {
            reading.enter(&read);
            reading.vertical = Some(read.motion.motion);
        }
        Ok(reading)
    }

    fn read(&mut self, args: &ReadArgs, path: &Path) -> Result<(String, Motion), Failure> {
        let read = args.read_one(path, ReadArgs::read_all)?;
        self.enter(&read);
        Ok((read.motion.name.clone(), read.motion.motion))
    }

    /// Adds the notes and the processing of a motion.
    fn enter(&mut self, read: &ReadMotion) {
        let name = &read.motion.name;
        self.warnings
            .extend(read.notes.iter().map(|note| format!("{name}: {note}")));
        self.processing.extend(
            read.motion
                .processing
                .iter()
                .map(|step| format!("{name}: {step}")),
        );
    }

    /// Writes the history, prints the result and ends the command.
    fn finish(
        self,
        place: Option<&Path>,
        history: impl Fn() -> Table,
        (facts, warnings): (Facts<'static>, Vec<String>),
        files: Files,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        files.table("history", || Ok(history()))?;
        if let Some(path) = place {
            write_table(path, history(), SCHEMA, &self.inputs)?;
        }
        let facts = facts.key("processing", self.processing);
        let warnings = [self.warnings, warnings].concat();
        files.print(printer, SCHEMA, &facts, &warnings, || lines(&facts))?;
        Ok(Done::OK)
    }
}

impl RockArgs {
    /// How closely the object is followed, and until when.
    fn settings(&self, gravity_m_s2: Option<f64>, duration_s: Option<f64>) -> Settings {
        Settings {
            accuracy: self.rocking.accuracy,
            on_pads: self.rocking.accuracy.into(),
            gravity_m_s2: gravity_m_s2.unwrap_or(G0_M_S2),
            until: until(duration_s),
            ..Settings::default()
        }
    }

    /// Refuses flags that name one file if there are several motions.
    fn refuse_one_file_for_several(&self) -> Result<(), Failure> {
        if self.motion.len() < 2 {
            return Ok(());
        }
        if self.vertical.is_some() {
            let hint = "give one --motion with its --vertical at a time";
            return Err(Failure::usage(
                "--vertical belongs to one motion, but several are given",
                hint,
            ));
        }
        if self.history.is_some() {
            let hint = "name a folder with --out: it gets the history of each";
            return Err(Failure::usage(
                "--history names one file, but there are several motions",
                hint,
            ));
        }
        Ok(())
    }
}

fn request(args: &RockArgs) -> Result<(RockRequest, Reading), Failure> {
    let mut values = Values::default();
    let height = values.read(&args.height);
    let thickness = values.read(&args.thickness);
    let mass = values.read(&args.mass);
    let edge = args.cushion.edge(mass, &mut values)?;
    if args.cushion.is_given() && args.mass.is_none() {
        let message = "the cushion is used for the shock, which also needs the mass of the object";
        values.push(Problem::value(
            message,
            "add --mass, or leave the cushion out",
        ));
    }
    let block = height
        .zip(thickness)
        .and_then(|size| args.shape.block(size, mass, &mut values));
    let friction = values.read(&args.friction);
    if friction == Some(0.0) {
        values.push(Problem::value(
            "--friction: the value must be positive, not 0",
            "only a compliant base accepts 0",
        ));
    }
    let rotation = values.read(&args.initial_rotation);
    let omega = values.read(&args.initial_velocity);
    let gravity = values.read(&args.gravity);
    let duration = values.read(&args.duration);
    let (walls, wall) = args
        .walls
        .read(block.as_ref(), mass, args.rocking.model, &mut values);
    let restitution = args.rocking.restitution(block.as_slice(), &mut values);
    let start = Release {
        rotation_rad: rotation.unwrap_or(0.0),
        omega_rad_s: omega.unwrap_or(0.0),
    };
    let settings = Settings {
        model: args.rocking.model,
        ..args.settings(gravity, duration)
    };
    values.finish()?;
    let Some(block) = block else {
        return Err(Failure::usage(
            "the size of the object is missing",
            "give --height and --thickness",
        ));
    };
    args.refuse_one_file_for_several()?;
    let no_motion = args.motion.is_empty() && args.vertical.is_none();
    if no_motion {
        args.read
            .refuse_without_record(|_| "name the record with --motion".to_owned())?;
    }
    if no_motion && start.is_at_rest() {
        return Err(Failure::usage(
            "nothing moves the object",
            "give --motion FILE, or --initial-rotation or --initial-velocity",
        ));
    }
    let mut reading = Reading::of(args)?;
    let vertical = reading.vertical.take();
    Ok((
        RockRequest {
            object: RigidPlane::along_x(block, restitution, walls),
            horizontal: None,
            vertical,
            how: HistoryOptions {
                settings,
                start,
                ..HistoryOptions::default()
            },
            cushion: mass.zip(edge),
            wall,
            friction,
        },
        reading,
    ))
}
