//! `freestand restrain`: how strongly one object must be held.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use freestand::G0_M_S2;
use freestand_assess::restrain::{
    DEFAULT_ANCHORS_PER_EDGE, RestrainFactors, RestrainFloor, RestrainHazard, RestrainListReport,
    RestrainListRequest, RestrainReport, RestrainRequest, ToConfirm, restrain, restrain_list,
};
use freestand_input::file::load as load_file;
use freestand_input::keys::{KeyStyle, Words};
use freestand_input::quantity::{Dimension, UnitSystem};
use freestand_study::resolve::{Overrides, load};

use super::Done;
use super::list::CellsArgs;
use crate::args::{GlobalArgs, at_least_one};
use crate::failure::Failure;
use crate::files::Files;
use crate::keys::{Key, KeySet, Keys, key};
use crate::printer::{Printer, lines, table};
use crate::values::{Given, Reads, Typed, Values, choice};

/// Calculate the force that the code asks a restraint to carry, and its anchors, on one sheet
///
/// The clause for parts of the place's code gives the force; the factors that are not stated are
/// assumed, and every one is printed with who says so. The formulas are those of `assess`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A cabinet on the third floor of six, in Los Angeles, in US units:
    freestand restrain --mass 800lb --height 6ft --thickness 24in --width 36in \\
      --component cabinet --anchor-inset 3in --place \"Los Angeles\" --floor 3 --storeys 6 --storey-height 13ft
  The same on the roof in Wellington, with a sheet to print and other codes beside it:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --width 0.9m \\
      --place Wellington --level-ratio 1 --compare --out restraint
  By the values of a code:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --code asce7 --edition 2022 \\
      --sds \"1 g\" --level-ratio 0.5 --importance 1.5 --strength 1.5
  For an object of a study, as assess has it:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --study hospital.toml --floor 2
  For every object of a list:
    freestand restrain objects.csv --place Wellington --storeys 5 --out restraint
  By an acceleration of the floor that somebody else has calculated, F = m a:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --floor-acceleration \"0.9 g\"")]
pub(crate) struct RestrainArgs {
    /// List of objects (CSV or XLSX), in place of one object: a row with its force for each
    #[arg(value_name = "LIST", conflicts_with_all = ["mass", "height", "thickness", "width", "cg_height", "component", "compare"])]
    list: Option<PathBuf>,
    #[command(flatten)]
    cells: CellsArgs,
    /// Mass of the object
    #[arg(long, typed = Dimension::Mass, required_unless_present = "list")]
    mass: Option<Given<Typed>>,
    /// Height of the object
    #[arg(long, typed = Dimension::Length, required_unless_present = "list")]
    height: Option<Given<Typed>>,
    /// Horizontal size of the object, the smaller one
    #[arg(long, typed = Dimension::Length, required_unless_present = "list")]
    thickness: Option<Given<Typed>>,
    /// The other horizontal size [default: only the thickness is checked]
    #[arg(long, positive = Dimension::Length)]
    width: Option<Given>,
    /// Height of the centre of gravity [default: half of the height]
    #[arg(long, positive = Dimension::Length)]
    cg_height: Option<Given>,

    /// Study (TOML) whose code, building and [restraint] are used
    #[arg(
        long,
        value_name = "STUDY.toml",
        help_heading = "The earthquake (one of --place, --code, --study, --floor-acceleration)"
    )]
    study: Option<PathBuf>,
    /// Acceleration of the floor, for F = m a
    #[arg(long, positive = Dimension::Acceleration, help_heading = "The earthquake (one of --place, --code, --study, --floor-acceleration)")]
    floor_acceleration: Option<Given>,
    #[command(flatten)]
    hazard: Keys<HazardKeys>,

    /// Name or number of the floor; floor 1 is the first above the ground [default: the ground]
    #[arg(long, value_name = "NAME", help_heading = "The floor")]
    floor: Option<String>,
    /// Number of storeys of the building
    #[arg(long, value_name = "N", help_heading = "The floor", value_parser = at_least_one)]
    storeys: Option<NonZeroUsize>,
    /// Height of a storey [default: 3.2 m]
    #[arg(long, positive = Dimension::Length, help_heading = "The floor")]
    storey_height: Option<Given>,
    /// Height of the floor over that of the building: 0 is the ground, 1 the roof
    #[arg(long, non_negative = Dimension::Ratio, help_heading = "The floor")]
    level_ratio: Option<Given>,

    /// Importance: I_p of ASCE 7, I_c of AS 1170.4, γ_a of Eurocode 8, R_p of NZS 1170.5
    /// [default: 1; critical to life safety: 1.5]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Factors")]
    importance: Option<Given>,
    /// Amplification of the part: a_p, a_c, C_i, or A of a floor acceleration [default: by code]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Factors")]
    amplification: Option<Given>,
    /// Response of the part, which divides: R_p of ASCE 7-16, R_c, q_a, 1/C_ph [default: by code]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Factors")]
    response: Option<Given>,
    /// C_AR of ASCE 7-22 [default: 1]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Factors")]
    resonance: Option<Given>,
    /// R_po of ASCE 7-22 [default: 1.5]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Factors")]
    strength: Option<Given>,
    /// R_μ of ASCE 7-22, from 1.3 [default: 1.3; 1 on the ground]
    #[arg(long, positive = Dimension::Ratio, help_heading = "Factors")]
    building_ductility: Option<Given>,

    /// What the object is, for the tables of ASCE 7 and table 4.4 of EN 1998-1: cabinet, shelving,
    /// generator, engine, switchgear, computer, air-side, wet-side, isolated, other, or its name in
    /// words, such as "emergency generator" [default: other, the row for other components]
    #[arg(long, value_name = "NAME")]
    component: Option<String>,
    /// Distance of the anchors from the edge that they hold down, inwards [default: assumed, 75 mm or
    /// a quarter of the side]
    #[arg(long, non_negative = Dimension::Length)]
    anchor_inset: Option<Given>,
    /// Units of the texts and of the sheet; the JSON document is in SI [default: those of most of
    /// --mass, --height, --thickness, or of the list]
    #[arg(long, value_parser = choice(&UnitSystem::ALL))]
    units: Option<UnitSystem>,
    /// Anchors along each of the two edges
    #[arg(long, value_name = "N", default_value_t = DEFAULT_ANCHORS_PER_EDGE, value_parser = at_least_one)]
    anchors_per_edge: NonZeroUsize,
    /// Show the forces by other codes too, on the same spectrum
    #[arg(long)]
    compare: bool,
}

#[derive(Debug, Clone)]
struct HazardKeys;

impl KeySet for HazardKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[
        (
            "The earthquake (one of --place, --code, --study, --floor-acceleration)",
            &[
                key(
                    "place",
                    "NAME",
                    "Place, with its code and hazard; see freestand place list",
                ),
                key(
                    "code",
                    "CODE",
                    "Design code, with its values: as1170.4, eurocode8, asce7, nzs1170.5",
                ),
            ],
        ),
        (
            "Values of the code",
            &[
                key("site", "CLASS", "Site class of the code"),
                key(
                    "edition",
                    "YEAR",
                    "Edition: 2016 or 2022 of ASCE 7 [default: 2022; with --place 2016, in California 2022]",
                ),
                key("sds", "ACCELERATION", "S_DS of ASCE 7"),
                key(
                    "ss",
                    "ACCELERATION",
                    "Mapped acceleration S_s of ASCE 7, with --fa, or with --s1 and --site",
                ),
                key("s1", "ACCELERATION", "Mapped acceleration S_1 of ASCE 7"),
                key(
                    "fa",
                    "RATIO",
                    "Site coefficient F_a of ASCE 7 [default: that of --site]",
                ),
                key(
                    "fv",
                    "RATIO",
                    "Site coefficient F_v of ASCE 7 [default: that of --site]",
                ),
                key(
                    "hazard_factor",
                    "RATIO",
                    "Hazard factor Z of AS 1170.4 or NZS 1170.5",
                ),
                key(
                    "return_period_years",
                    "YEARS",
                    "Return period of AS 1170.4 or NZS 1170.5 [default: 500]",
                ),
                key("ground_acceleration", "ACCELERATION", "a_gR of Eurocode 8"),
                key("spectrum_type", "1|2", "Type of spectrum of Eurocode 8"),
                key(
                    "importance_factor",
                    "RATIO",
                    "Importance factor γ_I of the building in Eurocode 8 [default: 1]",
                ),
                key(
                    "soil_factor",
                    "RATIO",
                    "Soil factor S of a national annex to Eurocode 8",
                ),
            ],
        ),
    ];
}

/// The keys that may stand beside a study: another place, or another ground.
const BESIDE_STUDY: [&str; 3] = ["place", "site", "return_period_years"];

const SCHEMA: &str = "freestand.restrain/1";

const SHEET: &str = "restraint.html";

pub(crate) fn run(
    args: &RestrainArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    if let Some(list) = &args.list {
        return run_list(list, args, global, printer);
    }
    if let Some(flag) = args.cells.given() {
        return Err(Failure::usage(
            format!("{flag} says how a list is read, and there is none"),
            "give a list, or leave it out",
        ));
    }
    let request = request(args)?;
    let inputs: Vec<PathBuf> = args.study.iter().cloned().collect();
    let report = restrain(request)?;
    let files = Files::begin(global, &inputs)?;
    let sheet = files.write(SHEET, || &report.sheet)?;
    let document = report.facts.clone().key("sheet", sheet.clone());
    files.print(printer, SCHEMA, &document, &report.warnings, || {
        text(&report, sheet.as_deref())
    })?;
    Ok(Done::OK)
}

fn run_list(
    list: &Path,
    args: &RestrainArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let acceleration = values.read(&args.floor_acceleration);
    let (floor, factors) = (floor(args, &mut values), factors(args, &mut values));
    let anchor_inset_m = values.read(&args.anchor_inset);
    values.finish()?;
    // Where the list cannot be read either, that is what to mend first. It is read once more only here.
    let hazard = hazard(args, acceleration)
        .map_err(|failure| load_file(list).err().map_or(failure, Failure::from))?;
    let request = RestrainListRequest {
        list: list.to_owned(),
        cells: args.cells.request()?,
        hazard,
        floor,
        factors,
        anchor_inset_m,
        anchors_per_edge: args.anchors_per_edge.get(),
        units: args.units,
    };
    let report = restrain_list(&request)?;
    let inputs: Vec<PathBuf> = [list.to_owned()]
        .into_iter()
        .chain(args.study.iter().chain(&args.cells.columns).cloned())
        .collect();
    let files = Files::begin(global, &inputs)?;
    files.table("restraint", || report.table())?;
    files.print(printer, SCHEMA, &report.facts(), &report.warnings, || {
        list_text(&report)
    })?;
    Ok(Done::OK)
}

fn list_text(report: &RestrainListReport) -> String {
    let headings = [
        "row",
        "object",
        "force",
        "force/weight",
        "tension of an edge",
        "in concrete",
    ];
    let rows: Vec<Vec<String>> = report.lines.iter().map(|row| row.to_vec()).collect();
    let mut text = table(&headings, &rows);
    text.push_str(&format!(
        "\n{} of {} objects have a force\n",
        report.held,
        report.lines.len()
    ));
    text.push_str(&open_text(&report.to_confirm, &report.assumptions));
    for problem in &report.problems {
        text.push_str(&format!("in the list: {}\n", KeyStyle::Flag.shown(problem)));
    }
    text
}

fn floor(args: &RestrainArgs, values: &mut Values) -> RestrainFloor {
    RestrainFloor {
        name: args.floor.clone(),
        level_ratio: values.read(&args.level_ratio),
        storeys: args.storeys.map(NonZeroUsize::get),
        storey_height_m: values.read(&args.storey_height),
    }
}

fn factors(args: &RestrainArgs, values: &mut Values) -> RestrainFactors {
    RestrainFactors {
        importance_ratio: values.read(&args.importance),
        amplification_ratio: values.read(&args.amplification),
        response_ratio: values.read(&args.response),
        resonance_ratio: values.read(&args.resonance),
        strength_ratio: values.read(&args.strength),
        building_ductility_ratio: values.read(&args.building_ductility),
    }
}

fn request(args: &RestrainArgs) -> Result<RestrainRequest, Failure> {
    let mut values = Values::default();
    let mass = values.read(&args.mass);
    let height = values.read(&args.height);
    let thickness = values.read(&args.thickness);
    let anchor_inset_m = values.read(&args.anchor_inset);
    let width_m = values.read(&args.width);
    let cg_height_m = values.read(&args.cg_height);
    let acceleration = values.read(&args.floor_acceleration);
    let (floor, factors) = (floor(args, &mut values), factors(args, &mut values));
    let object = values.finish_with(mass.zip(height).zip(thickness))?;
    let ((mass, height), thickness) = object;
    let units = UnitSystem::of_most_systems([mass.system, height.system, thickness.system]);
    Ok(RestrainRequest {
        mass_kg: mass.value_si,
        height_m: height.value_si,
        thickness_m: thickness.value_si,
        width_m,
        cg_height_m,
        hazard: hazard(args, acceleration)?,
        floor,
        factors,
        component: args.component.clone(),
        anchor_inset_m,
        units: args.units.unwrap_or(units),
        anchors_per_edge: args.anchors_per_edge.get(),
        is_compared: args.compare,
    })
}

fn hazard(args: &RestrainArgs, acceleration_m_s2: Option<f64>) -> Result<RestrainHazard, Failure> {
    let words = &args.hazard.words;
    let flags = |words: &mut dyn Iterator<Item = &'static str>| -> Option<String> {
        words.next().map(|key| KeyStyle::Flag.name(key))
    };
    match (&args.study, acceleration_m_s2) {
        (Some(_), Some(_)) => Err(Failure::usage(
            "--study and --floor-acceleration exclude each other",
            "keep one of them",
        )),
        (None, Some(acceleration)) => match flags(&mut words.entries().map(|(key, _)| key)) {
            Some(flag) => Err(Failure::usage(
                format!("{flag} and --floor-acceleration exclude each other"),
                "keep one of them",
            )),
            None => Ok(RestrainHazard::FloorAcceleration(acceleration / G0_M_S2)),
        },
        (Some(path), None) => {
            let mut strangers = words
                .entries()
                .map(|(key, _)| key)
                .filter(|key| !BESIDE_STUDY.contains(key));
            if let Some(flag) = flags(&mut strangers) {
                let hint =
                    "leave it out: beside a study stand --place, --site and --return-period alone";
                return Err(Failure::usage(
                    format!("{flag} has no meaning beside --study"),
                    hint,
                ));
            }
            let overrides = Overrides {
                hazard: words.clone(),
                ..Overrides::default()
            };
            Ok(RestrainHazard::Study(Arc::new(load(path, &overrides)?)))
        }
        (None, None) if Words::is_empty(words) => Err(Failure::usage(
            "nothing says how strongly the floor shakes",
            "give one of --place NAME, --code CODE with its values, --study STUDY.toml, or --floor-acceleration \"0.9 g\"",
        )),
        (None, None) => Ok(RestrainHazard::Code(words.clone())),
    }
}

/// What an engineer must confirm, and what was assumed.
fn open_text(to_confirm: &[ToConfirm], assumptions: &[String]) -> String {
    let confirm = |open: &ToConfirm| {
        let value = if open.value.is_empty() {
            String::new()
        } else {
            format!(" (used: {})", open.value)
        };
        format!("an engineer must confirm: {}{value}\n", open.what)
    };
    let mut text = String::new();
    if !to_confirm.is_empty() {
        text.push('\n');
        text.extend(to_confirm.iter().map(confirm));
    }
    if !assumptions.is_empty() {
        text.push('\n');
        text.extend(
            assumptions
                .iter()
                .map(|assumption| format!("assumed: {assumption}\n")),
        );
    }
    text
}

fn text(report: &RestrainReport, sheet: Option<&str>) -> String {
    let mut text = format!("{}\n\n{}\n", report.answer, lines(&report.facts));
    let rows: Vec<Vec<String>> = report.factors.iter().map(|row| row.to_vec()).collect();
    text.push_str(&table(&["factor", "value", "who says so"], &rows));
    if !report.others.is_empty() {
        let headings = [
            "for comparison",
            "force",
            "force/weight",
            "tension of an edge",
            "in concrete",
        ];
        let rows: Vec<Vec<String>> = report.others.iter().map(|row| row.to_vec()).collect();
        text.push('\n');
        text.push_str(&table(&headings, &rows));
    }
    text.push_str(&open_text(&report.to_confirm, &report.assumptions));
    if let Some(path) = sheet {
        text.push_str(&format!("\nto print: {path}\n"));
    }
    text
}
