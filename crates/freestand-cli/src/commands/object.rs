//! `freestand object`: one object, one sentence.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use freestand_assess::inventory::{CASTERS, Casters, Surroundings, UpperBody};
use freestand_assess::one_object::{
    Earthquake, Floor, FloorPlace, Object, ObjectReport, ObjectRequest, RestsOn, SCHEMA,
    StudySource, Withstood, one_object_shown,
};
use freestand_input::keys::Words;
use freestand_input::problem::Problem;
use freestand_input::quantity::{self, Dimension, UnitSystem};
use freestand_output::facts::Facts;

use super::Done;
use crate::args::{GlobalArgs, at_least_one};
use crate::failure::Failure;
use crate::files::Files;
use crate::keys::{Key, KeySet, Keys, key};
use crate::printer::{Printer, lines, table};
use crate::reading::ReadArgs;
use crate::session::Session;
use crate::values::{Given, Reads, Typed, Values, choice};

/// Say in one sentence whether an earthquake rocks one object and whether it falls over
///
/// Name the earthquake in one of four ways: --place, --pga, --study or --motion. Earthquakes are
/// simulated until the answer is settled; under motions of the floor, the object is calculated as
/// given. The sentence is followed by at most 20 lines of numbers.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A bookcase on the ground in Melbourne:
    freestand object --height 2m --thickness \"300 mm\" --place Melbourne
  A cabinet on the third floor of a building with six, in Los Angeles, in US units:
    freestand object --height \"6'6\\\"\" --thickness 18in --width 36in --place \"Los Angeles\" \\
      --floor 3 --storeys 6 --storey-height 13ft
  With its mass, its feet and what it withstands, its landings are compared too:
    freestand object --height 1.8m --thickness 0.6m --mass 150kg --on \"4380 N/mm\" \\
      --tolerance 10g --pga 0.3g --json
  In the building and the earthquake of a study:
    freestand object --height 1.8m --thickness 0.5m --study hospital.toml --floor 2
  Beside its wall, 20 mm away:
    freestand object --height 1.95m --thickness 0.42m --wall-gap 20mm --place Wellington
  On free casters, with 400 mm of room until its stop:
    freestand object --height 1.4m --thickness 0.6m --casters free --clearance 400mm --pga 0.4g
  Under motions of its floor, also weaker and stronger ones:
    freestand object --height 1.8m --thickness 0.5m --motion floor-1.csv floor-2.csv \\
      --scales \"0.5, 1, 2\"

Floors: 1 is the first above the ground. freestand place list shows the places, freestand cushion
list the entries for --on. Several objects are a list: freestand assess.")]
pub(crate) struct ObjectArgs {
    /// Height of the object
    #[arg(long, typed = Dimension::Length, help_heading = "The object")]
    height: Given<Typed>,
    /// Horizontal size in the plane of rocking, usually the smaller one
    #[arg(long, typed = Dimension::Length, help_heading = "The object")]
    thickness: Given<Typed>,
    /// Horizontal size across the thickness [default: it rocks about one axis only]
    #[arg(long, positive = Dimension::Length, help_heading = "The object")]
    width: Option<Given>,
    /// Height of the centre of gravity [default: half of the height]
    #[arg(long, positive = Dimension::Length, help_heading = "The object")]
    cg_height: Option<Given>,
    /// Shape of its base; of a cylinder, --thickness is the diameter. A cylinder is not calculated in three
    /// dimensions: the numbers are those of the square prism around it, and it is never said to stand
    #[arg(long, value_enum, default_value = "box", help_heading = "The object")]
    shape: BaseShape,
    /// Mass
    #[arg(long, typed = Dimension::Mass, help_heading = "The object")]
    mass: Option<Given<Typed>>,
    /// What is under one edge: the stiffness of all pads there, such as "4380 N/mm", or an entry of
    /// the cushion library, such as rubber-foot; needs --mass
    #[arg(long, value_name = "STIFFNESS|ENTRY", read = rests_on, help_heading = "The object")]
    on: Option<Given<RestsOn>>,
    /// Peak acceleration that it withstands, such as "10 g", or with the duration of its half-sine,
    /// "15 g 11 ms"; needs --mass and --on
    #[arg(long, value_name = "ACCELERATION", read = withstood, help_heading = "The object")]
    tolerance: Option<Given<Withstood>>,

    /// Coefficient of friction on the floor, one value or a range; it then slides where rocking needs
    /// more [default: enough for rocking; 0.2 to 0.8 tells whether it may slide, and counts for a stack]
    #[arg(long, value_name = "RATIO", read = ratios, help_heading = "The object")]
    friction: Option<Given<(f64, f64)>>,
    #[command(flatten)]
    around: AroundArgs,

    #[command(flatten)]
    hazard: Keys<HazardKeys>,
    /// Peak acceleration of the ground, such as "0.3 g"; the spectrum is that of Eurocode 8, type 1,
    /// ground B, scaled to it
    #[arg(long, positive = Dimension::Acceleration, help_heading = "The earthquake (one of four)")]
    pga: Option<Given>,
    /// Study file (TOML) with the ground motions and the building
    #[arg(
        long,
        value_name = "FILE.toml",
        help_heading = "The earthquake (one of four)"
    )]
    study: Option<PathBuf>,
    /// Records of the motion of its floor
    #[arg(long, value_name = "FILE", num_args = 1.., help_heading = "The earthquake (one of four)")]
    motion: Vec<PathBuf>,
    /// Factors on these motions, such as "0.5, 1, 2": a table by scale; the sentence is about the
    /// motions as they are
    #[arg(long, grid = Dimension::Ratio, help_heading = "The earthquake (one of four)")]
    scales: Option<Given<Vec<f64>>>,
    #[command(flatten)]
    read: ReadArgs,

    /// Floor by its number (1 is the first above the ground) or name (ground, roof); needs
    /// --storeys, or the building of a study [default: the ground]
    #[arg(long, value_name = "NAME", help_heading = "The floor")]
    floor: Option<String>,
    /// Height of the floor over that of the building, 0 to 1, in place of --floor
    #[arg(long, any = Dimension::Ratio, help_heading = "The floor")]
    level_ratio: Option<Given>,
    /// Number of storeys of the building [default: 30]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=500), help_heading = "The floor")]
    storeys: Option<u16>,
    /// Height of a storey [default: 3.2 m]
    #[arg(long, positive = Dimension::Length, help_heading = "The floor")]
    storey_height: Option<Given>,

    /// Largest number of simulated earthquakes [default: until the answer is settled, at most 1280]
    #[arg(long, value_name = "N", value_parser = at_least_one)]
    worlds: Option<NonZeroUsize>,
    /// Units of the texts; the JSON document is in SI [default: those in which most of
    /// --mass, --height and --thickness are typed]
    #[arg(long, value_parser = choice(&UnitSystem::ALL))]
    units: Option<UnitSystem>,
}

/// The base of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BaseShape {
    /// Rectangular
    Box,
    /// Round
    Cylinder,
}

/// What a list says in the columns of the same names.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "What is around it")]
struct AroundArgs {
    /// Distance from its back to the wall; 0 where they touch [default: no wall]
    #[arg(long, non_negative = Dimension::Length)]
    wall_gap: Option<Given>,
    /// Distance to what is on both sides of it, in the direction of the width [default: nothing]
    #[arg(long, alias = "neighbor-gap", non_negative = Dimension::Length)]
    neighbour_gap: Option<Given>,
    /// Height of the wall and of the neighbours [default: taller than the object]
    #[arg(long, positive = Dimension::Length)]
    wall_height: Option<Given>,
    /// Stiffness of the wall where the top of the object strikes it, or of the stop of free casters
    #[arg(long, positive = Dimension::Stiffness)]
    wall_stiffness: Option<Given>,
    /// Angular velocity after an impact at the wall divided by the one before, at least 0 and less
    /// than 1 [default: drawn from 0 to 0.5; under given motions 0.5]
    #[arg(long, non_negative = Dimension::Ratio)]
    wall_restitution: Option<Given>,
    /// Casters: free ones roll, and only a stop can overturn the object
    #[arg(long, alias = "castors", value_parser = choice(CASTERS))]
    casters: Option<Casters>,
    /// Rolling resistance of free casters: 0.01 on a hard floor, 0.05 on carpet [default: 0.02]
    #[arg(long, positive = Dimension::Ratio)]
    rolling_resistance: Option<Given>,
    /// How far it may slide or roll before it strikes something
    #[arg(long, non_negative = Dimension::Length)]
    clearance: Option<Given>,
    /// Height of what stands on the object
    #[arg(long, positive = Dimension::Length)]
    upper_height: Option<Given>,
    /// Thickness of what stands on the object
    #[arg(long, positive = Dimension::Length)]
    upper_thickness: Option<Given>,
    /// Mass of what stands on the object
    #[arg(long, positive = Dimension::Mass)]
    upper_mass: Option<Given>,
}

impl AroundArgs {
    /// What is around the object; problems are added to `values`.
    fn read(&self, values: &mut Values) -> Surroundings {
        let upper = (
            values.read(&self.upper_height),
            values.read(&self.upper_thickness),
            values.read(&self.upper_mass),
        );
        let is_given =
            [&self.upper_height, &self.upper_thickness, &self.upper_mass].map(Option::is_some);
        if is_given.contains(&true) && !(is_given[0] && is_given[1]) {
            let message = "what stands on the object lacks its height or its thickness";
            values.push(Problem::value(
                message,
                "give --upper-height and --upper-thickness, or leave out all three --upper flags",
            ));
        }
        Surroundings {
            wall_gap_m: values.read(&self.wall_gap),
            neighbour_gap_m: values.read(&self.neighbour_gap),
            wall_height_m: values.read(&self.wall_height),
            wall_stiffness_n_m: values.read(&self.wall_stiffness),
            wall_restitution: values.read(&self.wall_restitution),
            casters: self.casters,
            rolling_resistance_ratio: values.read(&self.rolling_resistance),
            clearance_m: values.read(&self.clearance),
            upper: match upper {
                (Some(height_m), Some(thickness_m), mass_kg) => Some(UpperBody {
                    height_m,
                    thickness_m,
                    mass_kg,
                }),
                _ => None,
            },
        }
    }
}

/// One ratio, or the two ends of a range: `0.4`, `0.3-0.5`, `0.3 to 0.5`.
fn ratios(text: &str) -> Result<(f64, f64), Problem> {
    let positive = |text: &str| quantity::parse_positive(text, Dimension::Ratio, "the value");
    let (low, high) = text
        .split_once(" to ")
        .or_else(|| text.split_once('-').filter(|(low, _)| !low.is_empty()))
        .unwrap_or((text, text));
    let (low, high) = (positive(low)?, positive(high)?);
    if low > high {
        return Err(Problem::value(
            format!("the range from {low} to {high} falls"),
            "write the smaller value first",
        ));
    }
    Ok((low, high))
}

#[derive(Debug, Clone)]
struct HazardKeys;

impl KeySet for HazardKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[(
        "The earthquake (one of four)",
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

/// What is under one edge: a stiffness begins with a digit, an entry with a letter.
fn rests_on(text: &str) -> Result<RestsOn, Problem> {
    let text = text.trim();
    if text.starts_with(|c: char| c.is_alphabetic()) {
        return Ok(RestsOn::Entry(text.to_owned()));
    }
    let hint = "write a stiffness such as \"4380 N/mm\" or \"25 kip/in\", or an entry of freestand cushion list";
    quantity::parse_positive(text, Dimension::Stiffness, "the value")
        .map(RestsOn::Stiffness)
        .map_err(|problem| problem.hint(hint))
}

/// A peak, perhaps with the duration of its half-sine: `10 g`, `15g 11ms`.
fn withstood(text: &str) -> Result<Withstood, Problem> {
    let peak = |text: &str| quantity::parse_positive(text, Dimension::Acceleration, "the value");
    let problem = match peak(text) {
        Ok(peak_m_s2) => {
            return Ok(Withstood {
                peak_m_s2,
                duration_s: None,
            });
        }
        Err(problem) => problem,
    };
    // The duration is the last number, where what is before it is a peak.
    let begins = |at: usize| {
        !text
            .get(..at)
            .unwrap_or_default()
            .ends_with(|c: char| c.is_ascii_digit() || c == '.')
    };
    let numbers = text
        .char_indices()
        .rev()
        .filter(|(at, c)| c.is_ascii_digit() && begins(*at));
    for (first, second) in numbers.map(|(at, _)| text.split_at(at)) {
        if let Ok(peak_m_s2) = peak(first.trim_end_matches([' ', ','])) {
            let duration_s = quantity::parse_positive(second, Dimension::Time, "the duration")?;
            return Ok(Withstood {
                peak_m_s2,
                duration_s: Some(duration_s),
            });
        }
    }
    Err(problem)
}

pub(crate) fn run(
    args: &ObjectArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let request = request(args, global)?;
    let inputs: Vec<PathBuf> = args
        .read
        .inputs(&args.motion)
        .into_iter()
        .chain(args.study.clone())
        .collect();
    let files = Files::begin(global, &inputs)?;
    let stop = printer.stop();
    let session = printer.session();
    let (memory, follow) = (
        session.map(Session::memory).unwrap_or_default(),
        session.and_then(Session::follow),
    );
    let shown = one_object_shown(&request, &memory, follow.as_ref(), &|| stop.wanted());
    let (report, shown) = shown.map_err(|problems| match problems.is_stopped() {
        true => Failure::Stopped { printed: false },
        false => problems.into(),
    })?;
    if let Some((session, shown)) = session.zip(shown.as_ref()) {
        session.beside(shown);
    }
    files.print(printer, SCHEMA, &report.facts, &report.warnings, || {
        text(&report, request.units)
    })?;
    Ok(Done::OK)
}

fn request(args: &ObjectArgs, global: &GlobalArgs) -> Result<ObjectRequest, Failure> {
    let mut values = Values::default();
    let (height, thickness) = (values.read(&args.height), values.read(&args.thickness));
    let (width, cg_height) = (values.read(&args.width), values.read(&args.cg_height));
    let mass = values.read(&args.mass);
    let (rests_on, tolerance) = (values.read(&args.on), values.read(&args.tolerance));
    let (friction_ratio, surroundings) =
        (values.read(&args.friction), args.around.read(&mut values));
    let peak_m_s2 = values.read(&args.pga);
    let scales = values.read(&args.scales);
    let storey_height_m = values.read(&args.storey_height);
    let place = match (&args.floor, values.read(&args.level_ratio)) {
        (Some(_), _) if args.level_ratio.is_some() => {
            let message = "--floor and --level-ratio are two ways to name the floor";
            values.push(Problem::value(message, "keep one of them"));
            FloorPlace::Ground
        }
        (Some(name), _) => FloorPlace::Name(name.clone()),
        (None, Some(ratio)) => FloorPlace::Share(ratio),
        (None, None) => FloorPlace::Ground,
    };
    check_earthquake(args, &mut values);
    values.finish()?;
    let Some((height, thickness)) = height.zip(thickness) else {
        return Err(Failure::usage(
            "the size of the object is missing",
            "give --height and --thickness",
        ));
    };
    let earthquake = if let Some(path) = &args.study {
        Earthquake::Study {
            source: StudySource::File(path.clone()),
            hazard: args.hazard.words.clone(),
        }
    } else if let Some(peak_m_s2) = peak_m_s2 {
        Earthquake::GroundAcceleration(peak_m_s2)
    } else if args.motion.is_empty() {
        Earthquake::Place(args.hazard.words.clone())
    } else {
        Earthquake::Motions {
            motions: args.read.read_all(&args.motion)?,
            scales: scales.unwrap_or_default(),
        }
    };
    let typed = [
        mass.and_then(|mass| mass.system),
        height.system,
        thickness.system,
    ];
    Ok(ObjectRequest {
        object: Object {
            height_m: height.value_si,
            thickness_m: thickness.value_si,
            width_m: width,
            is_round: args.shape == BaseShape::Cylinder,
            cg_height_m: cg_height,
            mass_kg: mass.map(|mass| mass.value_si),
            rests_on,
            tolerance,
            friction_ratio,
            surroundings,
        },
        earthquake,
        floor: Floor {
            place,
            storeys: args.storeys,
            storey_height_m,
        },
        worlds: args
            .worlds
            .map(|worlds| u32::try_from(worlds.get()).unwrap_or(u32::MAX)),
        seed: global.seed,
        units: args.units.unwrap_or(UnitSystem::of_most_systems(typed)),
    })
}

/// Exactly one earthquake, with the flags that belong to it.
fn check_earthquake(args: &ObjectArgs, values: &mut Values) {
    let hazard: &Words = &args.hazard.words;
    let has_place = hazard.get("place").is_some();
    let given = [
        (has_place && args.study.is_none(), "--place"),
        (args.pga.is_some(), "--pga"),
        (args.study.is_some(), "--study"),
        (!args.motion.is_empty(), "--motion"),
    ];
    let given: Vec<&str> = given
        .into_iter()
        .filter_map(|(is_given, flag)| is_given.then_some(flag))
        .collect();
    match given.as_slice() {
        [] => values.push(Problem::value(
            "no earthquake is named",
            "name one: --place NAME, --pga \"0.3 g\", --study FILE.toml, or --motion FILE with motions of its floor",
        )),
        [_] => {}
        several => {
            let message = format!("{} name different earthquakes", several.join(" and "));
            values.push(Problem::value(message, "keep one of them"));
        }
    }
    let has_site = hazard.get("site").is_some() || hazard.get("return_period_years").is_some();
    if has_site && !given.is_empty() && !has_place && args.study.is_none() {
        let message = "--site and --return-period belong to the code of a place";
        values.push(Problem::value(message, "add --place, or leave them out"));
    }
    if args.motion.is_empty() {
        if args.scales.is_some() {
            let message = "--scales applies to motions of the floor";
            values.push(Problem::value(
                message,
                "name them with --motion, or leave --scales out",
            ));
        }
        if let Err(Failure::Problems(problems)) = args
            .read
            .refuse_without_record(|_| "name the record with --motion, or leave it out".to_owned())
        {
            problems
                .into_iter()
                .for_each(|problem| values.push(problem));
        }
    }
}

/// The unit of uplifts, and of the headings of the table by scale.
fn scale_headings(units: UnitSystem) -> (&'static str, [&'static str; 7]) {
    let (unit, uplift) = match units {
        UnitSystem::Si => ("mm", "uplift [mm]"),
        UnitSystem::Us => ("in", "uplift [in]"),
    };
    (
        unit,
        [
            "scale",
            "median PFA [g]",
            "largest PFA [g]",
            "lift an edge",
            "overturn it",
            uplift,
            "shock [g]",
        ],
    )
}

/// A row of that table.
fn at_scale(row: &Facts, length: &str) -> Vec<String> {
    let columns = [
        ("scale_ratio", "", 0),
        ("median", "", 3),
        ("max", "", 3),
        ("motions_lifted", "", 0),
        ("motions_overturned", "", 0),
        ("uplift_m_max", length, 3),
        ("landing_acceleration_g_max", "", 3),
    ];
    columns
        .map(|(name, unit, digits)| row.cell(name, unit, digits))
        .to_vec()
}

/// The most lines of a table below the sentence.
const MAX_ROWS: usize = 18;

fn text(report: &ObjectReport, units: UnitSystem) -> String {
    let mut text = format!("{}\n\n", report.answer);
    if report.scales.is_empty() {
        text.push_str(&lines(&report.facts));
        return text;
    }
    let (length, headings) = scale_headings(units);
    let rows: Vec<Vec<String>> = report
        .scales
        .iter()
        .take(MAX_ROWS)
        .map(|row| at_scale(row, length))
        .collect();
    text.push_str(&table(&headings, &rows));
    if report.scales.len() > MAX_ROWS {
        text.push_str(&format!(
            "and {} more: --json\n",
            report.scales.len() - MAX_ROWS
        ));
    }
    text
}
