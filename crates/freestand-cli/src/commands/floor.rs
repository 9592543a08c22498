//! `freestand floor`: how the floors of a building move.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use freestand::building::Damping;
use freestand::code_spectrum::{FrameKind, fundamental_period_s};
use freestand::synthesis::DAMPING_RATIO;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_input::words::number;
use freestand_output::figure::{Figure, FigureError};
use freestand_study::building::{
    Axis, AxisModel, AxisRequest, DEFAULT_DAMPING_RATIO, DEFAULT_SHEAR_FLEXURE_RATIO, DEFAULT_STOREY_HEIGHT_M,
    DEFAULT_STOREYS, axis,
};
use freestand_study::floor::{
    FloorReport, FloorRequest, SpectraReport, SpectraRequest, every_floor, floors, spectra_csv,
};
use freestand_study::floor::{ProfilePicture, floor_profile_figure, floor_response_figure};
use freestand_study::recorded::{MotionFiles, ReadMotion, read_recorded};

use super::Done;
use crate::args::{GlobalArgs, at_least_one};
use crate::failure::{Failure, problem};
use crate::files::Files;
use freestand_output::facts::Facts;

use crate::printer::{Column, Printer, facts_table};
use crate::reading::{ReadArgs, SecondArgs};
use crate::target::TargetArgs;
use crate::values::{Given, Reads, Values};

/// Calculate the motions of the floors of a building
#[derive(Debug, Args)]
#[command(
    after_help = "\
The building is a shear-flexure beam (Miranda and Taghavi 2005), or a table of storeys (height,
mass, stiffness) or of modes (period, participation, shape); see docs/buildings.md.

Examples:
  freestand floor --motion record.AT2 --storeys 30 --storey-height \"3.2 m\" --levels \"0.5, 1.0\" \\
    --out floors
  freestand floor --motion record.AT2 --storeys 12 --storey-height \"3 m\" --period \"1.2 s\" --json
  freestand floor --motion a.AT2 b.AT2 c.AT2 --storey-table tower.csv --levels all --spectra \\
    --out floors
  freestand floor --motion a.AT2 --levels all --code as1170.4 --city Melbourne --site De \\
    --out floors
  freestand floor --motion record.v2 --components both --mode-table x.csv \\
    --across-mode-table y.csv --levels all",
    mut_arg("rotation_step", |arg| arg.hide(true))
)]
pub(crate) struct FloorArgs {
    /// Records of the ground motion; of several, medians are printed
    #[arg(long, value_name = "FILE", num_args = 1.., required = true)]
    motion: Vec<PathBuf>,
    #[command(flatten)]
    building: BuildingArgs,
    /// Levels as shares of the height (0 is the ground, 1 the roof), or "all" for every floor
    #[arg(long, value_name = "GRID|all", read = levels, default_value = "0.5, 1.0")]
    levels: Given<Option<Vec<f64>>>,
    /// Length of the zeros appended to the record, in which the building comes to rest [default: 0
    /// s]
    #[arg(long, non_negative = Dimension::Time)]
    tail: Option<Given>,
    /// Find peaks of the floors at N points in each sample interval; the ground stays linear
    /// between its samples
    #[arg(long, value_name = "N", default_value = "1", value_parser = at_least_one)]
    upsample: NonZeroUsize,
    /// Also give response spectra of the levels
    #[arg(long)]
    spectra: bool,
    /// Damping ratios of the spectra [default: 5 %]
    #[arg(long, grid = Dimension::Ratio, value_name = "LIST", requires = "spectra")]
    spectrum_damping: Option<Given<Vec<f64>>>,
    /// Periods of the spectra: from:to:count or a list [default: 0 s and 121 from 0.05 s to 5 s]
    #[arg(long, grid = Dimension::Time, requires = "spectra")]
    periods: Option<Given<Vec<f64>>>,
    #[command(flatten)]
    second: SecondArgs,
    #[command(flatten)]
    read: ReadArgs,
    /// The code whose accelerations of rigid parts are compared with the floors
    #[command(flatten)]
    target: TargetArgs,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Building")]
struct BuildingArgs {
    /// Number of storeys [default: 30]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=500))]
    storeys: Option<u32>,
    /// Height of a storey [default: 3.2 m]
    #[arg(long, positive = Dimension::Length)]
    storey_height: Option<Given>,
    /// Fundamental period [default: from the height, by AS 1170.4]
    #[arg(long, positive = Dimension::Time, conflicts_with = "frame")]
    period: Option<Given>,
    /// Structure, for the period by AS 1170.4: steel-moment, concrete-moment, steel-braced, other
    /// [default: other]
    #[arg(long, value_name = "FRAME", value_parser = frame_kind)]
    frame: Option<FrameKind>,
    /// Damping ratio of every mode for which a table states none [default: 5 %]
    #[arg(long, non_negative = Dimension::Ratio)]
    damping: Option<Given>,
    /// Rayleigh damping, with that ratio at two modes, such as "1, 3"
    #[arg(long, value_name = "N, N", read = two_modes)]
    rayleigh_modes: Option<Given<[usize; 2]>>,
    /// α₀ = H√(GA/EI): 0 for a flexural wall, 5 for walls with frames, 20 and more for a frame
    /// [default: 5]
    #[arg(long, non_negative = Dimension::Ratio)]
    shear_flexure: Option<Given>,
    /// Number of modes [default: 10, or the number of storeys]
    #[arg(long, value_name = "N")]
    modes: Option<usize>,
    /// Table of storeys from the ground up: height, mass and stiffness with their units
    #[arg(long, value_name = "FILE", conflicts_with_all = BEAM, conflicts_with = "mode_table")]
    storey_table: Option<PathBuf>,
    /// Table of modes: period, participation factor, and the shape at each floor in a column headed
    /// by its height
    #[arg(long, value_name = "FILE", conflicts_with_all = BEAM, conflicts_with = "modes")]
    mode_table: Option<PathBuf>,
    /// Fundamental period along the second axis [default: the same as along the first]
    #[arg(long, positive = Dimension::Time, conflicts_with_all = TABLES)]
    across_period: Option<Given>,
    /// α₀ along the second axis
    #[arg(long, non_negative = Dimension::Ratio, requires = "across_period")]
    across_shear_flexure: Option<Given>,
    /// Table of storeys for the second axis
    #[arg(long, value_name = "FILE", conflicts_with = "across_mode_table")]
    across_storey_table: Option<PathBuf>,
    /// Table of modes for the second axis
    #[arg(long, value_name = "FILE")]
    across_mode_table: Option<PathBuf>,
}

/// Flags of a beam, which a table replaces.
const BEAM: [&str; 5] = ["storeys", "storey_height", "period", "frame", "shear_flexure"];
const TABLES: [&str; 4] = ["across_storey_table", "across_mode_table", "storey_table", "mode_table"];

const SCHEMA: &str = "freestand.floor/1";

/// Most levels of one call: each is a motion in memory.
const MAX_LEVELS: usize = 1000;

pub(crate) fn run(args: &FloorArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    if args.second.rotation_step.is_some() {
        let hint = "the largest of all directions is found without steps: leave --rotation-step out";
        return Err(Failure::usage("--rotation-step turns objects, not floors", hint));
    }
    let mut values = Values::default();
    let building = args.building.read(&mut values);
    let tail_s = values.read(&args.tail).unwrap_or(0.0);
    let levels = values.read(&args.levels).flatten();
    let spectra = args.spectra.then(|| SpectraRequest {
        damping_ratios: values.read(&args.spectrum_damping).unwrap_or_else(|| vec![DAMPING_RATIO]),
        periods_s: super::motion::periods(&args.periods, &mut values),
    });
    let motions = MotionFiles {
        second: args.second.second(args.motion.len(), &mut values),
        ..args.read.files(&args.motion, &mut values)
    };
    values.finish()?;
    let request = building.request()?;
    let says_damping = args.building.damping.is_some() || args.building.rayleigh_modes.is_some();
    let axes = [Some(&request.along), request.across.as_ref()];
    let states_damping =
        |axis: &&freestand_study::building::Axis| axis.table.as_ref().is_some_and(|table| table.states_damping);
    if says_damping && axes.into_iter().flatten().all(|axis| states_damping(&axis)) {
        let hint = "leave --damping and --rayleigh-modes out, or the column of damping";
        return Err(Failure::usage("every mode of the table has a damping of its own", hint));
    }
    let is_storeys = levels.is_none();
    let target = if args.target.is_given() { Some(args.target.target()?) } else { None };
    let request = FloorRequest {
        levels_ratio: levels.unwrap_or_else(|| every_floor(&request.along.building, building.storeys as usize)),
        is_storeys,
        tail_s,
        upsample: args.upsample.get(),
        spectra,
        along: request.along,
        across: request.across,
        height_m: request.height_m,
        code: target.as_ref().map(|target| target.spectrum.clone()),
    };
    if args.building.has_second_axis() && matches!(motions.second, freestand_study::recorded::Second::None) {
        return Err(Failure::usage(
            "a second axis of the building needs a second component of the motion",
            "name it with --components both, or --across FILE",
        ));
    }
    let (read, failures) = read_recorded(&motions);
    if !failures.is_empty() {
        return Err(Failure::Problems(failures.into_iter().map(|(_, problem)| problem).collect()));
    }
    let mut inputs = args.read.inputs(&args.motion);
    inputs.extend(args.second.across.iter().cloned());
    inputs.extend(args.building.tables().cloned());
    inputs.extend(args.target.inputs());
    let files = Files::begin(global, &inputs)?;
    let (report, mut warnings) = report(&read, &request, &files)?;
    warnings.extend(target.into_iter().flat_map(|target| target.warnings));
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

/// Follows the motions one by one, so that the floors of one are in memory, and writes the files.
fn report(read: &[ReadMotion], request: &FloorRequest, files: &Files) -> Result<(FloorReport, Vec<String>), Failure> {
    let mut warnings: Vec<String> = request.along.warnings.clone();
    warnings.extend(request.across.iter().flat_map(|axis| axis.warnings.clone()));
    let (mut motions, mut spectra_g) = (Vec::new(), Vec::new());
    for one in read {
        let mut done = floors(one, request)?;
        for (level, floor) in done.report.levels.iter_mut().zip(&done.floors) {
            let folder = if read.len() > 1 { format!("{}/", done.report.motion) } else { String::new() };
            // Floors of a table are at any share; those that were asked for keep their digits.
            let ratio = if request.is_storeys { number(level.level_ratio, 4) } else { level.level_ratio.to_string() };
            let name = format!("{folder}level-{ratio}.csv");
            level.path = files.write(&name, || floor.csv())?;
        }
        warnings.extend(done.warnings);
        motions.push(done.report);
        spectra_g.push(done.spectra_g);
    }
    let spectra =
        request.spectra.as_ref().map(|spectra| SpectraReport::new(&request.levels_ratio, spectra, &spectra_g));
    let report = FloorReport::new(request, motions, spectra)
        .ok_or_else(|| Failure::computation("the files were read but hold no motion"))?;
    let profile = report.profile_csv()?;
    files.write("profile.csv", || profile)?;
    files.figure("profile", || profile_figure(&report))?;
    if let Some(spectra) = &report.spectra {
        let csv = spectra_csv(spectra)?;
        files.write("spectra.csv", || csv)?;
        let draw = || floor_response_figure(spectra, report.building_height_m, report.motions.len());
        files.figure("spectra", draw)?;
    }
    Ok((report, warnings))
}

fn profile_figure(report: &FloorReport) -> Result<Figure, FigureError> {
    let level = |name: &str| report.levels.iter().filter_map(|level| level.facts.number(name)).collect::<Vec<f64>>();
    let levels_ratio = level("level_ratio");
    let pfa_g: Vec<Vec<f64>> =
        report.motions.iter().map(|motion| motion.levels.iter().map(|level| level.pfa_g).collect()).collect();
    // A code gives every level its part, or none.
    let code: Vec<(f64, f64)> = levels_ratio.iter().copied().zip(level("code_part_g")).collect();
    let pga_g: Vec<f64> = report.motions.iter().map(|motion| motion.pga_g).collect();
    floor_profile_figure(&ProfilePicture {
        title: "Peak floor accelerations",
        levels_ratio: &levels_ratio,
        height_m: Some(report.building_height_m),
        pfa_g: &pfa_g,
        pga_g: &pga_g,
        code: report.code_clause.filter(|_| !code.is_empty()).map(|clause| (clause, &code[..])),
    })
}

/// `None`: every floor.
fn levels(text: &str) -> Result<Option<Vec<f64>>, Problem> {
    if text.trim().eq_ignore_ascii_case("all") {
        return Ok(None);
    }
    let levels = parse_grid(text, Dimension::Ratio)?;
    if let Some(outside) = levels.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        return Err(problem(format!("{outside} is not a share of the height"), "0 is the ground, 1 the roof"));
    }
    if levels.len() > MAX_LEVELS {
        let hint = format!("at most {MAX_LEVELS} in one call");
        return Err(problem(format!("{} levels are too many", levels.len()), hint));
    }
    Ok(Some(levels))
}

/// The flags of the building, read.
struct ReadBuilding {
    storeys: u32,
    height_m: f64,
    along: AxisModel,
    across: Option<AxisModel>,
    damping: Damping,
    modes: Option<usize>,
}

/// Both axes.
struct Axes {
    along: Axis,
    across: Option<Axis>,
    height_m: f64,
}

impl BuildingArgs {
    fn tables(&self) -> impl Iterator<Item = &PathBuf> {
        let tables = [&self.storey_table, &self.mode_table, &self.across_storey_table, &self.across_mode_table];
        tables.into_iter().flatten()
    }

    fn has_second_axis(&self) -> bool {
        self.across_period.is_some() || self.across_storey_table.is_some() || self.across_mode_table.is_some()
    }

    fn read(&self, values: &mut Values) -> ReadBuilding {
        let storey_height_m = values.read(&self.storey_height).unwrap_or(DEFAULT_STOREY_HEIGHT_M);
        let period = values.read(&self.period);
        let damping_ratio = values.read(&self.damping).unwrap_or(DEFAULT_DAMPING_RATIO);
        let alpha = values.read(&self.shear_flexure).unwrap_or(DEFAULT_SHEAR_FLEXURE_RATIO);
        let across_period = values.read(&self.across_period);
        let across_alpha = values.read(&self.across_shear_flexure);
        let storeys = self.storeys.unwrap_or(DEFAULT_STOREYS);
        let height_m = f64::from(storeys) * storey_height_m;
        let table = |storeys: &Option<PathBuf>, modes: &Option<PathBuf>| match (storeys, modes) {
            (Some(path), _) => Some(AxisModel::StoreyTable(path.clone())),
            (None, Some(path)) => Some(AxisModel::ModeTable(path.clone())),
            (None, None) => None,
        };
        let along = table(&self.storey_table, &self.mode_table).unwrap_or_else(|| {
            let period_s = period.or_else(|| {
                let frame = self.frame.unwrap_or(FrameKind::Other);
                values.keep(
                    "storey-height",
                    fundamental_period_s(frame, height_m)
                        .map_err(|error| problem(error.to_string(), "give --period, or another height")),
                )
            });
            AxisModel::Beam { period_s: period_s.unwrap_or(1.0), shear_flexure_ratio: alpha }
        });
        let beam = across_period
            .map(|period_s| AxisModel::Beam { period_s, shear_flexure_ratio: across_alpha.unwrap_or(alpha) });
        let across = table(&self.across_storey_table, &self.across_mode_table).or(beam);
        let rayleigh = values.read(&self.rayleigh_modes).map(|modes| Damping::Rayleigh { damping_ratio, modes });
        let damping = rayleigh.unwrap_or(Damping::Uniform(damping_ratio));
        ReadBuilding { storeys, height_m, along, across, damping, modes: self.modes }
    }
}

fn two_modes(text: &str) -> Result<[usize; 2], Problem> {
    let modes = text.split_once(',').map(|(one, other)| (one.trim().parse(), other.trim().parse()));
    match modes {
        Some((Ok(one), Ok(other))) => Ok([one, other]),
        _ => Err(problem("two modes are expected", "write --rayleigh-modes \"1, 3\"")),
    }
}

impl ReadBuilding {
    fn request(&self) -> Result<Axes, Failure> {
        let of = |model: &AxisModel, modes: Option<usize>| {
            axis(&AxisRequest { model: model.clone(), damping: self.damping.clone(), modes })
        };
        let along = of(&self.along, self.modes)?;
        // The number of modes is that of the first axis; a table has its own.
        let modes = |model: &AxisModel| if matches!(model, AxisModel::Beam { .. }) { self.modes } else { None };
        let across = self.across.as_ref().map(|model| of(model, modes(model))).transpose()?;
        // A beam is as high as its storeys, whatever a table says of the other axis.
        let height_m = along.height_m.unwrap_or(self.height_m);
        if let Some(other_m) = across.as_ref().and_then(|axis| axis.height_m)
            && (other_m - height_m).abs() > 1e-3 * height_m
        {
            let message = format!("the building is {other_m} m high across and {height_m} m along");
            return Err(Failure::usage(
                message,
                "levels are shares of one height: check both tables, or --storeys and --storey-height",
            ));
        }
        Ok(Axes { along, across, height_m })
    }
}

fn frame_kind(name: &str) -> Result<FrameKind, String> {
    FrameKind::parse(name).ok_or_else(|| format!("known: {}", FrameKind::ALL.map(FrameKind::name).join(", ")))
}

const MODES: [Column; 5] = [
    ("mode", "mode", 0),
    ("period_s", "period [s]", 4),
    ("damping_ratio", "damping [%]", 3),
    ("participation_ratio", "participation", 4),
    ("effective_mass_ratio", "share of the mass", 4),
];

fn text(report: &FloorReport) -> String {
    let several = report.motions.len() > 1;
    let has = |name: &str| report.levels.iter().any(|level| level.facts.number(name).is_some());
    let mut columns = vec![("level_ratio", "level", 4), ("height_m", "height [m]", 4)];
    columns.push(("pfa_g", if several { "median PFA [g]" } else { "PFA [g]" }, 4));
    if several {
        columns.extend([("pfa_g_p16", "16 % [g]", 4), ("pfa_g_p84", "84 % [g]", 4)]);
    }
    columns.extend([("pfv_m_s", "PFV [m/s]", 4), ("pfd_m", "PFD [m]", 4)]);
    columns.extend(has("drift_ratio").then_some(("drift_ratio", "drift [%]", 4)));
    columns.extend(report.code_clause.map(|_| ("code_part_g", "code part [g]", 4)));
    columns.extend((!several).then_some(("path", "file", 0)));
    let levels = report.levels.iter().map(|level| level.facts.clone().key("path", level.path.clone()));
    let numbered = |(i, mode): (usize, &Facts<'static>)| Facts::default().key("mode", i + 1).and(mode.clone());
    let modes: Vec<Facts> = report.modes.iter().enumerate().map(numbered).collect();
    facts_table(&modes, &MODES) + "\n" + &facts_table(&levels.collect::<Vec<_>>(), &columns)
}
