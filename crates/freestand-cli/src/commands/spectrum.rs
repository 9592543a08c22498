//! `freestand spectrum`: uplift and shock spectra over a grid of objects.

use std::path::PathBuf;
use std::sync::LazyLock;

use clap::Args;
use freestand::block::Block;
use freestand::respond::{HistoryOptions, RigidHistory, Settings};
use freestand::rocking::Base;
use freestand_assess::one_object::Follow;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_input::words::counted;
use freestand_records::notes::grouped;
use freestand_study::at_place::{LastGround, motions_at};
use freestand_study::drawn::{DrawnHistory, drawn};
use freestand_study::recorded::ReadMotion;
use freestand_study::resolve::{Hazard, Values as StudyValues};
use freestand_study::restitution::checked;
use freestand_study::rock::edge_landings;
use freestand_study::spectrum::{
    Grid, SpectrumMotion, SpectrumRequest, SpectrumTiming, chunk_objects, spectrum,
};
use freestand_study::unsolved::{self, rocking_problem};
use serde::Serialize;

use super::Done;
use super::block::RockingArgs;
use super::sliding::SlidingArgs;
use super::spectrum_text::Seen;
use super::walls::WallArgs;
use crate::args::{GlobalArgs, Named, refuse_idle};
use crate::cushion::CushionArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::keys::{Key, KeySet, Keys, key};
use crate::printer::Printer;
use crate::reading::{ReadArgs, VerticalArgs, path_text};
use crate::rows::{ROWS, Rows};
use crate::stop::Stop;
use crate::values::{Given, Reads, Values};

const SCHEMA: &str = "freestand.spectrum/1";

/// Calculate uplift and shock spectra: a grid of objects under one or more records
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  Uplift of 64 × 64 objects:
    freestand spectrum --motion record.AT2 --heights \"0.3 m:4 m:64\" --thicknesses \"0.1 m:1 m:64\" \\
      --json
  Shock of four cabinets on their pads under two records:
    freestand spectrum --motion a.AT2 b.AT2 --heights \"1.5 m, 2 m\" \\
      --thicknesses \"300 mm, 400 mm\" --mass 150kg --stiffness \"4380 N/mm\"
  The same objects 20 mm in front of a wall; the rows also contain the speed at the wall:
    freestand spectrum --motion record.AT2 --heights \"1.5 m, 2 m\" \\
      --thicknesses \"300 mm, 400 mm\" --wall-gap 20mm
  Uplift on the roof of 30 storeys in Melbourne, under ten synthetic motions:
    freestand spectrum --place Melbourne --site De --level-ratio 1 --storeys 30 \\
      --heights \"0.3 m:3 m:64\" --thicknesses \"0.1 m:1 m:64\" --csv rows.csv
  A million objects in a file, each with its sensitivity to an error of the motion:
    freestand spectrum --motion record.AT2 --heights \"0.3 m:4 m:1000\" \\
      --thicknesses \"0.1 m:1 m:1000\" --accuracy fast --sensitivity --csv rows.csv
  The same as a table with types and units, for pandas, polars or DuckDB:
    freestand spectrum --motion record.AT2 --heights \"0.3 m:4 m:1000\" \\
      --thicknesses \"0.1 m:1 m:1000\" --parquet rows.parquet
  Trolleys with brakes on half of their wheels, which slide or rock according to their size:
    freestand spectrum --motion record.AT2 --heights \"0.8 m:1.6 m:9\" --thicknesses \"0.4 m\" \\
      --casters --brakes --friction 0.25

Rows are written as they are calculated: a large grid needs time and disk space, not memory.")]
pub(crate) struct SpectrumArgs {
    /// Records of the horizontal acceleration of the floor
    #[arg(long, value_name = "FILE", num_args = 1..)]
    motion: Vec<PathBuf>,
    /// Records of the vertical acceleration of the floor, positive upward: one for each --motion,
    /// with the same step and length
    #[arg(long, value_name = "FILE", num_args = 1..)]
    vertical: Vec<PathBuf>,
    #[command(flatten)]
    vertically: VerticalArgs,
    #[command(flatten)]
    read: ReadArgs,
    #[command(flatten)]
    place: Named<PlaceArgs>,
    /// Heights: a grid "from:to:count" or a list
    #[arg(long, grid = Dimension::Length, help_heading = "The objects")]
    heights: Given<Vec<f64>>,
    /// Thicknesses: a grid "from:to:count" or a list
    #[arg(long, grid = Dimension::Length, help_heading = "The objects")]
    thicknesses: Given<Vec<f64>>,
    /// Mass of each object; needed for the shock
    #[arg(long, positive = Dimension::Mass, help_heading = "The objects")]
    mass: Option<Given>,
    #[command(flatten)]
    cushion: CushionArgs,
    /// Coefficient of friction of objects that slide, at rest [default: 0.5]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Sliding and casters")]
    friction: Option<Given>,
    #[command(flatten)]
    sliding: Named<SlidingArgs>,
    #[command(flatten)]
    walls: WallArgs,
    #[command(flatten)]
    rocking: RockingArgs,
    /// Report how strongly each object amplifies an error of the motion
    ///
    /// Every object is calculated again under 1.000001 times the horizontal motion, which doubles
    /// the work. `sensitivity_ratio` is the relative change of its peak rotation, divided by 1e-6:
    /// 1 to a few tens is usual; with 1000, an error of 0.1 % in the record makes the result
    /// meaningless. An object is `sensitive` if the ratio is above 10 (the peak changes by more
    /// than 1e-5), if its fastest impacts change as much, or if its outcome differs between the two
    /// motions; the ratio is then empty, as it is for objects that do not rock or that overturn
    /// under both. An object that overturns under both is `sensitive` if its history before that
    /// differs by more than 0.1 %.
    #[arg(long, help_heading = "The rocking")]
    sensitivity: bool,
    /// File to write the rows to (CSV)
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// File to write the rows to (Parquet)
    #[arg(long, value_name = "FILE.parquet")]
    parquet: Option<PathBuf>,
}

/// A floor of a building at a place, instead of records.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "A place instead of records")]
struct PlaceArgs {
    #[command(flatten)]
    hazard: Keys<HazardKeys>,
    /// Number of synthetic motions [default: 10]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    count: Option<u16>,
    /// Height of the floor divided by that of the building: 0 is the ground, 1 the roof [default: 0]
    #[arg(long, any = Dimension::Ratio)]
    level_ratio: Option<Given>,
    /// Number of storeys of the building [default: 30]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=500))]
    storeys: Option<u16>,
    /// Height of a storey [default: 3.2 m]
    #[arg(long, positive = Dimension::Length)]
    storey_height: Option<Given>,
}

#[derive(Debug, Clone)]
struct HazardKeys;

impl KeySet for HazardKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[(
        "A place instead of records",
        &[
            key(
                "place",
                "NAME",
                "Place, with its code and hazard; see freestand place list",
            ),
            key("site", "CLASS", "Site class of the code"),
            key(
                "return_period_years",
                "YEARS",
                "Return period in years, of AS 1170.4 and NZS 1170.5",
            ),
        ],
    )];
}

/// The ground of the last request of the page.
static LAST: LazyLock<LastGround> = LazyLock::new(LastGround::default);

/// The keys that follow the rows in the document.
#[derive(Debug, Serialize)]
struct Others {
    processing: Vec<Processed>,
    timing: SpectrumTiming,
}

#[derive(Debug, Serialize)]
struct Processed {
    motion: String,
    steps: Vec<String>,
}

/// The motions, with their processing and their warnings.
#[derive(Debug, Default)]
struct Reading {
    motions: Vec<SpectrumMotion>,
    processing: Vec<Processed>,
    warnings: Vec<String>,
}

pub(crate) fn run(
    args: &SpectrumArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let request = request(args)?;
    let stop = printer.stop();
    let reading = match args.motion.as_slice() {
        [] => at_place(args, global, &stop)?,
        _ => read(args)?,
    };
    let mut warnings = reading.warnings;
    let inputs = args.read.inputs(
        args.motion
            .iter()
            .chain(&args.vertical)
            .chain(&args.cushion.inputs()),
    );
    let files = Files::begin(global, &inputs)?;
    let mut rows = Rows::begin(
        SCHEMA,
        printer,
        &files,
        (args.csv.as_deref(), args.parquet.as_deref()),
        &inputs,
    )?;
    let total = request.grid.objects() * reading.motions.len();
    if let Some(session) = printer.session() {
        session.check_histories(total)?;
    }
    if let Some((session, follow)) = printer
        .session()
        .and_then(|session| Some((session, session.follow()?)))
    {
        session.beside(&followed(&request, &reading.motions, &follow)?);
    }
    let mut seen = Seen::new(reading.motions.len(), total, &request);
    let bar = printer.progress_bar(printer.json());
    bar.set_length(total as u64);
    bar.set_message("rocking histories");
    let solved = spectrum(&request, &reading.motions, chunk_objects, |chunk| {
        rows.write(chunk)?;
        seen.add(chunk);
        bar.inc(chunk.objects() as u64);
        if stop.wanted() {
            Err(Failure::Stopped {
                printed: printer.json(),
            })
        } else {
            Ok(())
        }
    });
    bar.finish_and_clear();
    let timing = solved?;

    warnings.extend(request.warnings(&seen.tallies));
    let failed = seen.tallies.iter().any(|tally| tally.failed > 0);
    let place = args
        .csv
        .as_deref()
        .or(args.parquet.as_deref())
        .map(path_text)
        .or_else(|| files.path(ROWS));
    let text = || seen.text(&reading.motions, place.as_deref(), &timing);
    let others = Others {
        processing: reading.processing,
        timing,
    };
    rows.finish(files, printer, &others, &warnings, text)?;
    Ok(Done {
        criterion_met: !failed,
    })
}

fn request(args: &SpectrumArgs) -> Result<SpectrumRequest, Failure> {
    if let Some(failure) = args.sliding.refused(false) {
        return Err(failure);
    }
    let mut values = Values::default();
    let heights = values.read(&args.heights).unwrap_or_default();
    let thicknesses = values.read(&args.thicknesses).unwrap_or_default();
    let mass = values.read(&args.mass);
    let cushion = args.cushion.edge(mass, &mut values)?;
    if args.mass.is_some() != (args.cushion.is_given() || args.walls.needs_mass()) {
        let message = "the shock needs both the mass and the cushion of the objects";
        values.push(Problem::value(
            message,
            "give --mass and --stiffness (or another cushion), or neither",
        ));
    }
    // Whether walls are refused does not depend on the size of the objects.
    let first = heights
        .first()
        .zip(thicknesses.first())
        .and_then(|(&h, &t)| Block::uniform(h, t).ok());
    let (walls, wall) = args
        .walls
        .read(first.as_ref(), mass, args.rocking.model, &mut values);
    let restitution = args.rocking.restitution(&[], &mut values);
    let settings = Settings {
        model: args.rocking.model,
        accuracy: args.rocking.accuracy,
        ..Settings::default()
    };
    if args.friction.is_some() && !args.sliding.is_given() {
        values.push(Problem::value(
            "--friction is used by objects that slide",
            "add --sliding, or --casters --brakes",
        ));
    }
    let friction = values.read(&args.friction);
    let surface = args.sliding.surface(friction, &mut values);
    if args.sliding.stop_stiffness.is_some() {
        let message =
            "--stop-stiffness is used by freestand rock only: rows have no shock of a stop";
        values.push(Problem::value(message, "leave it out"));
    }
    if let Some(flag) = args.place.given.first().filter(|_| !args.motion.is_empty()) {
        let message = format!("--{flag} applies to motions of a place, but --motion names records");
        values.push(Problem::value(message, "leave out one of the two"));
    }
    if args.sliding.is_given() && (args.mass.is_some() || args.sensitivity) {
        let message =
            "the shock and the sensitivity are those of rocking objects, and these slide or roll";
        values.push(Problem::value(
            message,
            "leave --mass, the cushion and --sensitivity out",
        ));
    }
    if args.sliding.is_given() && !walls.is_none() {
        let message = "walls stop objects that rock, and these slide or roll";
        values.push(Problem::value(
            message,
            "leave the walls out, and give the room as --clearance-left and --clearance-right",
        ));
    }
    values.finish()?;
    let (motions, verticals) = (args.motion.len(), args.vertical.len());
    if verticals > 0 && verticals != motions {
        return Err(Failure::usage(
            format!(
                "--vertical has {}, --motion {motions}",
                counted(verticals, "file")
            ),
            "give one vertical record for each horizontal one, in the same order, or none",
        ));
    }
    let grid = Grid::new(heights, thicknesses)?;
    let blocks: Vec<Block> = grid.blocks(0..grid.objects()).collect();
    checked(restitution, &blocks)?;
    let cushion = mass.zip(cushion);
    let request = SpectrumRequest {
        grid,
        restitution,
        walls,
        settings,
        cushion,
        wall,
        sensitivity: args.sensitivity,
        surface,
    };
    if let Some(flag) = args.rocking.of_rigid_base()
        && request.none_rocks()
    {
        refuse_idle([flag], "every object slides or rolls, and none rocks")?;
    }
    Ok(request)
}

/// The motions of a floor at a place.
fn at_place(args: &SpectrumArgs, global: &GlobalArgs, stop: &Stop) -> Result<Reading, Failure> {
    let place = &args.place;
    if place.hazard.words.get("place").is_none() {
        let hint = "name records of the floor with --motion FILE, or a place with --place NAME";
        return Err(Failure::usage("no motion is named", hint));
    }
    args.read
        .refuse_without_record(|_| "name the record with --motion, or leave it out".to_owned())?;
    let mut values = Values::default();
    let (level_ratio, storey_height_m) = (
        values.read(&place.level_ratio),
        values.read(&place.storey_height),
    );
    values.finish()?;
    let study = StudyValues {
        hazard: Hazard::Keys(place.hazard.words.clone()),
        count: place.count,
        seed: global.seed,
        storeys: place.storeys,
        storey_height_m,
    };
    let go_on = || {
        if stop.wanted() {
            Err(Problem::stopped().into())
        } else {
            Ok(())
        }
    };
    let made = motions_at(&study, level_ratio.unwrap_or(0.0), &LAST, go_on)?;
    let processed = |motion: &SpectrumMotion| Processed {
        motion: motion.name.clone(),
        steps: made.processing.clone(),
    };
    let processing = made.motions.iter().map(processed).collect();
    Ok(Reading {
        motions: made.motions,
        processing,
        warnings: made.warnings,
    })
}

/// What the page gets next to the document to draw the history of an object.
#[derive(Debug, Serialize)]
struct Followed {
    followed: String,
    history: DrawnHistory,
}

/// The history of the only object under one of the motions.
fn followed(
    request: &SpectrumRequest,
    motions: &[SpectrumMotion],
    follow: &Follow,
) -> Result<Followed, Failure> {
    let [block] = request
        .grid
        .blocks(0..request.grid.objects().min(2))
        .collect::<Vec<_>>()[..]
    else {
        let hint = "give one height and one thickness, or leave the history out";
        return Err(Failure::usage(
            "a history can be calculated for one object only",
            hint,
        ));
    };
    if request.surface.is_some() {
        return Err(Failure::usage(
            "an object that slides has no rocking history",
            "leave the history out",
        ));
    }
    let object = request.standing(block);
    let how = HistoryOptions::sampled(request.settings);
    let chosen: Vec<&SpectrumMotion> = match follow {
        Follow::Named(name) => motions
            .iter()
            .filter(|one| one.name == *name)
            .take(1)
            .collect(),
        Follow::Telling => motions.iter().collect(),
    };
    let histories = chosen.iter().map(|motion| {
        let base = Base {
            horizontal: Some(&motion.horizontal),
            vertical: motion.vertical.as_ref(),
        };
        object.follow(base, &how).map_err(unsolved::problem)
    });
    let histories = histories.collect::<Result<Vec<RigidHistory>, _>>()?;
    let farthest = |history: &RigidHistory| history.rocking.peak_rotation_rad;
    let found = chosen
        .into_iter()
        .zip(histories)
        .max_by(|a, b| farthest(&a.1).total_cmp(&farthest(&b.1)));
    let (motion, history) = found.ok_or_else(|| {
        let names: Vec<&str> = motions.iter().map(|motion| motion.name.as_str()).collect();
        Failure::usage(
            "no motion has this name",
            format!("choose one of {}", names.join(", ")),
        )
    })?;
    let body = request.cushion.as_ref();
    let body = body.map(|(mass_kg, edge)| (*mass_kg, &edge.cushion));
    let landings = edge_landings(
        &block,
        &history.rocking,
        body,
        request.settings.gravity_m_s2,
    );
    Ok(Followed {
        history: drawn(&object, &history, &landings, Some(&motion.horizontal)),
        followed: motion.name.clone(),
    })
}

/// Reads all records before the calculation, so that a problem in the last one is found early.
fn read(args: &SpectrumArgs) -> Result<Reading, Failure> {
    let mut reading = Reading::default();
    let read = args.read.read_all(&args.motion)?;
    reading.warnings = grouped(read.iter().flat_map(ReadMotion::named_notes));
    for read in read {
        let name = read.motion.name;
        reading.processing.push(Processed {
            motion: name.clone(),
            steps: read.motion.processing,
        });
        reading.motions.push(SpectrumMotion {
            name,
            horizontal: read.motion.motion,
            vertical: None,
        });
    }
    if args.vertical.is_empty() {
        return Ok(reading);
    }
    let verticals = args.vertically.read_all(&args.read, &args.vertical)?;
    let named = |text: &str| format!("vertical {text}");
    let notes = verticals.iter().flat_map(ReadMotion::named_notes);
    reading
        .warnings
        .extend(grouped(notes.map(|(name, note)| (named(name), note))));
    for ((motion, processed), read) in reading
        .motions
        .iter_mut()
        .zip(&mut reading.processing)
        .zip(verticals)
    {
        let name = named(&read.motion.name);
        processed.steps.extend(
            read.motion
                .processing
                .iter()
                .map(|step| format!("{name}: {step}")),
        );
        motion.vertical = Some(read.motion.motion);
        // Once, not for every object.
        Base {
            horizontal: Some(&motion.horizontal),
            vertical: motion.vertical.as_ref(),
        }
        .check()
        .map_err(rocking_problem)?;
    }
    Ok(reading)
}
