//! `freestand floor`: how the floors of a building move.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::Args;
use freestand::synthesis::DAMPING_RATIO;
use freestand_app::TargetKeys;
use freestand_app::files::Files as Sources;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_input::words::{counted, number};
use freestand_records::notes::grouped;
use freestand_records::write::write_csv;
use freestand_study::building;
use freestand_study::floor::{
    DEFAULT_LEVELS, FloorReport, FloorRequest, SpectraReport, SpectraRequest, every_floor,
    floor_response_figure, floors, spectra_table,
};
use freestand_study::recorded::{MotionFiles, ReadMotion, Upward, read_all};

use super::Done;
use crate::args::{GlobalArgs, at_least_one};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use freestand_output::facts::Facts;

use crate::keys::{Key, KeySet, Keys, key};
use crate::printer::{Column, Printer, facts_table};
use crate::reading::{ReadArgs, SecondArgs};
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
  freestand floor --motion h1.AT2 --vertical up.AT2 --vertical-amplification 1.5 --levels all \\
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
    building: Keys<BuildingKeys>,
    /// Levels as shares of the height (0 is the ground, 1 the roof), or "all" for every floor
    #[arg(long, value_name = "GRID|all", read = levels, default_value = DEFAULT_LEVELS)]
    levels: Given<Option<Vec<f64>>>,
    /// Duration of the zeros appended to the record, during which the building comes to rest
    /// [default: 0 s]
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
    /// Files with the vertical component, one for each --motion, or \"record\": the vertical component
    /// of each file of --motion; processed and scaled as the horizontal one
    #[arg(long, value_name = "FILE", num_args = 1..)]
    vertical: Vec<PathBuf>,
    /// Vertical acceleration of the floors above the ground, divided by that of the ground: 1 at
    /// columns, more in the middle of a slab [default: 1]
    #[arg(long, positive = Dimension::Ratio, requires = "vertical")]
    vertical_amplification: Option<Given>,
    #[command(flatten)]
    second: SecondArgs,
    #[command(flatten)]
    read: ReadArgs,
    /// The code whose accelerations of rigid parts are compared with the floors
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    target: TargetKeys,
}

#[derive(Debug, Clone)]
struct BuildingKeys;

impl KeySet for BuildingKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[(
        "Building",
        &[
            key("storeys", "N", "Number of storeys [default: 30]"),
            key(
                "storey_height",
                "LENGTH",
                "Height of a storey [default: 3.2 m]",
            ),
            key(
                "height",
                "LENGTH",
                "Height of the building, in place of --storey-height",
            ),
            key(
                "period",
                "TIME",
                "Fundamental period [default: from the height, by the code]",
            ),
            key(
                "frame",
                "FRAME",
                "Structure, for the period by the code: steel-moment, concrete-moment, steel-braced, other [default: \
                 other]",
            ),
            key(
                "period_code",
                "CODE",
                "Code of the formula for the period: as1170.4, nzs1170.5, asce7, eurocode8 [default: --code]",
            ),
            key(
                "damping",
                "RATIO",
                "Damping ratio of every mode for which a table states none [default: 5 %]",
            ),
            key(
                "rayleigh_modes",
                "N, N",
                "Rayleigh damping, with that ratio at two modes, such as \"1, 3\"",
            ),
            key(
                "shear_flexure",
                "RATIO",
                "α₀ = H√(GA/EI): 0 for a flexural wall, 5 for walls with frames, 20 and more for a frame [default: 5]",
            ),
            key(
                "modes",
                "N",
                "Number of modes [default: 10, or the number of storeys]",
            ),
            key(
                "storey_table",
                "FILE",
                "Table of storeys from the ground up: height, mass and stiffness with their units",
            ),
            key(
                "mode_table",
                "FILE",
                "Table of modes: period, participation factor, and the shape at each floor in a column headed by its \
                 height",
            ),
            key(
                "across_period",
                "TIME",
                "Fundamental period along the second axis [default: the same as along the first]",
            ),
            key("across_shear_flexure", "RATIO", "α₀ along the second axis"),
            key(
                "across_storey_table",
                "FILE",
                "Table of storeys for the second axis",
            ),
            key(
                "across_mode_table",
                "FILE",
                "Table of modes for the second axis",
            ),
        ],
    )];
}

const SCHEMA: &str = "freestand.floor/1";

/// The largest number of levels of one call: each is a motion in memory.
const MAX_LEVELS: usize = 1000;

pub(crate) fn run(
    args: &FloorArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    if args.second.rotation_step.is_some() {
        let hint =
            "leave --rotation-step out: the largest value of all directions is found without steps";
        return Err(Failure::usage(
            "--rotation-step applies to objects, not to floors",
            hint,
        ));
    }
    let mut values = Values::default();
    let building = values.take(building::resolve(
        &args.building.words,
        Path::new(""),
        args.target.period_code(),
    ));
    let tail_s = values.read(&args.tail).unwrap_or(0.0);
    let levels = values.read(&args.levels).flatten();
    let spectra = args.spectra.then(|| SpectraRequest {
        damping_ratios: values
            .read(&args.spectrum_damping)
            .unwrap_or_else(|| vec![DAMPING_RATIO]),
        periods_s: super::motion::periods(&args.periods, &mut values),
    });
    let vertical = upward(args, &mut values);
    let vertical_amplification_ratio = values.read(&args.vertical_amplification);
    let motions = MotionFiles {
        vertical,
        second: args.second.second(args.motion.len(), &mut values),
        ..args.read.files(&args.motion, &mut values)
    };
    let building = values.finish_with(building)?;
    let is_storeys = levels.is_none();
    let target = if args.target.is_given() {
        Some(args.target.resolved(&Sources::Disk)?)
    } else {
        None
    };
    let request = FloorRequest {
        levels_ratio: levels.unwrap_or_else(|| every_floor(&building.along, building.storeys)),
        is_storeys,
        tail_s,
        upsample: args.upsample.get(),
        spectra,
        vertical_amplification_ratio,
        building,
        code: target.as_ref().map(|target| target.spectrum.clone()),
    };
    if request.building.across.is_some()
        && matches!(motions.second, freestand_study::recorded::Second::None)
    {
        return Err(Failure::usage(
            "a second axis of the building needs a second component of the motion",
            "name it with --components both, or --across FILE",
        ));
    }
    let read = read_all(&motions)?;
    let mut inputs = args.read.inputs(&args.motion);
    inputs.extend(args.second.across.iter().cloned());
    if let Upward::Files(files) = &motions.vertical {
        inputs.extend(files.iter().cloned());
    }
    inputs.extend(
        request
            .building
            .tables
            .iter()
            .map(|(_, table)| table.file.path.clone()),
    );
    inputs.extend(args.target.inputs(&Sources::Disk));
    let files = Files::with_tables(global, &inputs, &args.tables, SCHEMA, None)?;
    let (report, mut warnings) = report(&read, &request, &files)?;
    warnings.extend(target.into_iter().flat_map(|target| target.warnings));
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

/// Where the vertical components are.
fn upward(args: &FloorArgs, values: &mut Values) -> Upward {
    match args.vertical.as_slice() {
        [] => Upward::None,
        [only] if only.as_os_str() == "record" => Upward::SameFile,
        files => {
            if files.len() != args.motion.len() {
                let message = format!(
                    "--vertical has {}, --motion {}",
                    counted(files.len(), "file"),
                    args.motion.len()
                );
                values.push(Problem::value(
                    message,
                    "name one file for each file of --motion, in the same order",
                ));
            }
            Upward::Files(files.to_vec())
        }
    }
}

/// Calculates one motion at a time, so that only its floors are in memory, and writes the files.
fn report(
    read: &[ReadMotion],
    request: &FloorRequest,
    files: &Files,
) -> Result<(FloorReport, Vec<String>), Failure> {
    let (mut motions, mut spectra_g, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for one in read {
        let mut done = floors(one, request)?;
        let mut verticals = done.verticals.iter();
        for (level, floor) in done.report.levels.iter_mut().zip(&done.floors) {
            let folder = if read.len() > 1 {
                format!("{}/", done.report.motion)
            } else {
                String::new()
            };
            // Floors of a table may be at any level; levels that the user gave keep their digits.
            let ratio = if request.is_storeys {
                number(level.level_ratio, 4)
            } else {
                level.level_ratio.to_string()
            };
            let name = format!("{folder}level-{ratio}.csv");
            level.path = files.write(&name, || floor.csv())?;
            if let Some(vertical) = verticals.next() {
                let name = format!("{folder}level-{ratio}-vertical.csv");
                level.vertical_path = files.write(&name, || write_csv(vertical))?;
            }
        }
        notes.extend(done.notes.into_iter().map(|note| (&one.motion.name, note)));
        motions.push(done.report);
        spectra_g.push(done.spectra_g);
    }
    let spectra = request
        .spectra
        .as_ref()
        .map(|spectra| SpectraReport::new(&request.levels_ratio, spectra, &spectra_g));
    let report = FloorReport::new(request, motions, spectra)
        .ok_or_else(|| Failure::computation("the files were read but contain no motion"))?;
    files.table("profile", || report.profile_table())?;
    files.figure("profile", || report.profile_figure())?;
    if let Some(spectra) = &report.spectra {
        files.table("spectra", || spectra_table(spectra))?;
        let draw =
            || floor_response_figure(spectra, report.building_height_m, report.motions.len());
        files.figure("spectra", draw)?;
    }
    let notes = grouped(notes.iter().map(|(name, note)| (name, note)));
    Ok((report, [request.building.warnings.clone(), notes].concat()))
}

/// Reads `--levels`; `None` means every floor.
fn levels(text: &str) -> Result<Option<Vec<f64>>, Problem> {
    if text.trim().eq_ignore_ascii_case("all") {
        return Ok(None);
    }
    let levels = parse_grid(text, Dimension::Ratio)?;
    if let Some(outside) = levels.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        return Err(Problem::value(
            format!("{outside} is not a share of the height"),
            "give levels from 0 (the ground) to 1 (the roof)",
        ));
    }
    if levels.len() > MAX_LEVELS {
        let hint = format!("give at most {MAX_LEVELS} levels");
        return Err(Problem::value(
            format!("{} levels are too many", levels.len()),
            hint,
        ));
    }
    Ok(Some(levels))
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
    let has = |name: &str| {
        report
            .levels
            .iter()
            .any(|level| level.facts.number(name).is_some())
    };
    let mut columns = vec![("level_ratio", "level", 4), ("height_m", "height [m]", 4)];
    columns.push((
        "pfa_g",
        if several { "median PFA [g]" } else { "PFA [g]" },
        4,
    ));
    if several {
        columns.extend([("pfa_g_p16", "16 % [g]", 4), ("pfa_g_p84", "84 % [g]", 4)]);
    }
    columns.extend([("pfv_m_s", "PFV [m/s]", 4), ("pfd_m", "PFD [m]", 4)]);
    columns.extend(has("drift_ratio").then_some(("drift_ratio", "drift [%]", 4)));
    columns.extend(has("pfa_vertical_g").then_some(("pfa_vertical_g", "vertical PFA [g]", 4)));
    columns.extend(
        report
            .code_clause
            .map(|_| ("code_part_g", "code part [g]", 4)),
    );
    columns.extend((!several).then_some(("path", "file", 0)));
    let levels = report
        .levels
        .iter()
        .map(|level| level.facts.clone().key("path", level.path.clone()));
    let numbered =
        |(i, mode): (usize, &Facts<'static>)| Facts::default().key("mode", i + 1).and(mode.clone());
    let modes: Vec<Facts> = report.modes.iter().enumerate().map(numbered).collect();
    facts_table(&modes, &MODES) + "\n" + &facts_table(&levels.collect::<Vec<_>>(), &columns)
}
