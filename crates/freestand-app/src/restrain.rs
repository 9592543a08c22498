//! `restrain`: how strongly one object, or each object of a list, must be held.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Arg;
use freestand::G0_M_S2;
use freestand_assess::restrain::{
    self, Anchor, Anchors, DEFAULT_ANCHORS_PER_EDGE, Pivot, RestrainFactors, RestrainFloor,
    RestrainHazard, RestrainListRequest, RestrainRequest,
};
use freestand_input::file::load as load_file;
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::quantity::{Dimension, UnitSystem};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_report::signature::Signing;
use freestand_study::building::MAX_STOREYS;
use freestand_study::resolve::{Overrides, StudySource};
use freestand_study::target::Target;

use crate::block::sizes;
use crate::cells::CellKeys;
use crate::files::Files;
use crate::place;
use crate::request::{
    Question, Request as _, one_of, path_without_flag, reader, request, typed_units,
};
use crate::study;
use crate::target::TargetKeys;

/// The schema of the response.
pub const SCHEMA: &str = "freestand.restrain/1";

request! { question
    /// One object, or a list of them, and what shakes it.
    #[command(mut_args(of_parts))]
    pub struct Restrain {
        /// List of objects (CSV or XLSX), in place of one object: a row with its force for each
        #[arg(value_name = "LIST")]
        pub list: Option<Written>,
        /// How the list is read.
        #[command(flatten)]
        pub cells: CellKeys,
        /// Mass of the object
        pub mass = "MASS",
        /// Height of the object
        pub height = "LENGTH",
        /// Horizontal size of the object, the smaller one
        pub thickness = "LENGTH",
        /// The other horizontal size [default: only the thickness is checked]
        pub width = "LENGTH",
        /// Height of the centre of gravity [default: half of the height]
        pub cg_height = "LENGTH",

        /// Study (TOML) whose code, building and table `restraint` are used
        #[arg(
            long,
            value_name = "FILE.toml",
            help_heading = EARTHQUAKE
        )]
        pub study: Option<Written>,
        /// Acceleration of the floor, for F = m a
        #[arg(
            long,
            value_name = "ACCELERATION",
            help_heading = EARTHQUAKE
        )]
        pub floor_acceleration: Option<Written>,
        /// A place, or a code with its values.
        #[command(flatten)]
        pub target: TargetKeys,

        /// Name or number of the floor; floor 1 is the first above the ground [default: the ground]
        pub floor = "NAME" under "The floor",
        /// Number of storeys of the building
        pub storeys = "N" under "The floor",
        /// Height of a storey [default: 3.2 m]
        pub storey_height = "LENGTH" under "The floor",
        /// Height of the floor over that of the building: 0 is the ground, 1 the roof
        pub level_ratio = "RATIO" under "The floor",

        /// Importance: I_p of ASCE 7, I_c of AS 1170.4, γ_a of Eurocode 8, R_p of NZS 1170.5
        /// [default: 1; critical to life safety: 1.5]
        pub importance = "RATIO" under "Factors",
        /// Amplification of the part: a_p, a_c, C_i, or A of a floor acceleration [default: by code]
        pub amplification = "RATIO" under "Factors",
        /// Response of the part, which divides: R_p of ASCE 7-16, R_c, q_a, 1/C_ph [default: by code]
        pub response = "RATIO" under "Factors",
        /// C_AR of ASCE 7-22 [default: 1]
        pub resonance = "RATIO" under "Factors",
        /// R_po of ASCE 7-22 [default: 1.5]
        pub strength = "RATIO" under "Factors",
        /// R_μ of ASCE 7-22, from 1.3 [default: 1.3; 1 on the ground]
        pub building_ductility = "RATIO" under "Factors",

        /// What the object is, or those of a list whose name does not say it, for the tables of ASCE 7 and table 4.4 of EN 1998-1: cabinet, shelving,
        /// generator, engine, switchgear, computer, air-side, wet-side, isolated, other, or its name in
        /// words, such as "emergency generator" [default: other, the row for other components]
        pub component = "NAME",
        /// Distance of the anchors from the edge that they hold down, inwards [default: assumed, 75 mm or
        /// a quarter of the side]
        pub anchor_inset = "LENGTH",
        /// The line about which an object tips: edge of the base, or feet that the anchors fix
        /// [default: edge]
        pub pivot = "LINE" with (value_parser = one_of(&Pivot::ALL)),
        /// Name of the anchor that you have chosen
        pub anchor = "NAME",
        /// Its design capacity in tension, with which the tension in concrete is compared
        pub anchor_capacity = "FORCE",
        /// Its design capacity in shear; the ratio of the shear is then added
        pub anchor_shear_capacity = "FORCE",
        /// Units of the texts and of the sheet; the JSON document is in SI [default: those of most of
        /// --mass, --height, --thickness, or of the list]
        pub units = "UNITS" with (value_parser = one_of(&UnitSystem::ALL)),
        /// Anchors along each of the two edges [default: 2]
        pub anchors_per_edge = "N",
        /// Show the forces by other codes too, on the same spectrum
        pub compare = switch,
        /// Whoever signs has confirmed the values that are quoted from memory: without it a sheet that rests on one is a
        /// draft
        pub allow_recalled = switch,
    }
}

const EARTHQUAKE: &str = "The earthquake (one of --place, --code, --study, --floor-acceleration)";

/// The keys of a target as the clauses for parts read them: nothing stands in for a hazard, and what only a spectrum
/// needs is not shown.
fn of_parts(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "place" => arg
            .help("Place or coordinates, with their code and hazard; see freestand place list")
            .help_heading(EARTHQUAKE),
        "code" => arg
            .help("Design code, with its values: as1170.4, eurocode8, asce7, nzs1170.5, ntc2018, tbdy2018, ts1170.5")
            .help_heading(EARTHQUAKE),
        "edition" => arg.help(
            "Edition: 2016 or 2022 of ASCE 7 [default: 2022; with --place 2016, in California 2022]",
        ),
        "site" => arg.help("Site class of the code"),
        "hazard_factor" => arg.help("Hazard factor Z"),
        "city" | "latitude" | "longitude" | "fault_distance" | "corner_periods" | "sd1" | "long_period" | "spectrum"
        | "interpolation" | "beyond" => arg.hide(true),
        _ => arg,
    }
}

/// What is asked, in SI.
#[derive(Debug, Clone)]
pub struct Meant {
    /// One object or a list; its hazard is added when the study has been read.
    asked: Asked,
    hazard: Hazard,
    /// The files that are read.
    pub inputs: Vec<PathBuf>,
    /// How the sheets are signed.
    pub signing: Signing,
}

/// One object, or a list of them.
#[derive(Debug, Clone)]
pub enum Asked {
    /// One object.
    One(RestrainRequest),
    /// A list.
    List(RestrainListRequest),
}

/// What shakes the floor.
#[derive(Debug, Clone)]
enum Hazard {
    Known(RestrainHazard),
    /// A study to read, with a place in place of its own.
    OfStudy(StudySource, Words),
}

impl Meant {
    /// One object or a list, with what shakes it.
    ///
    /// # Errors
    /// Everything that is wrong with a study.
    pub fn asked(self) -> Result<Asked, Problems> {
        let hazard = match self.hazard {
            Hazard::Known(hazard) => hazard,
            Hazard::OfStudy(source, hazard) => {
                let overrides = Overrides {
                    hazard,
                    ..Overrides::default()
                };
                RestrainHazard::Study(Arc::new(source.load(&overrides)?))
            }
        };
        Ok(match self.asked {
            Asked::One(one) => Asked::One(RestrainRequest { hazard, ..one }),
            Asked::List(list) => Asked::List(RestrainListRequest { hazard, ..list }),
        })
    }
}

impl Question for Restrain {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let list = path_without_flag(&mut read, "list", files);
        let asked = match read.has("list") {
            true => self.list(&mut read, list.clone(), files).map(Asked::List),
            false => self.one(&mut read, &words).map(Asked::One),
        };
        let hazard = self.hazard(&mut read, files);
        let signing = Signing {
            allows_recalled: read.flag("allow_recalled"),
        };
        if let (Some(Asked::One(one)), Some(Hazard::Known(hazard))) = (&asked, &hazard) {
            let one = RestrainRequest {
                hazard: hazard.clone(),
                ..one.clone()
            };
            read.problems.keep_comparisons(restrain::check(one));
        }
        if let Some(path) = list
            && !read.problems.is_empty()
            && let Err(problem) = load_file(&path)
        {
            // Told first. If nothing else is wrong, the list is read later and tells this itself.
            read.problems.problems.insert(0, problem);
        }
        let mut inputs = self.cells.inputs(files);
        inputs.extend(files.path_of(self.list.as_ref()));
        inputs.extend(files.path_of(self.study.as_ref()));
        inputs.extend(self.target.inputs(files));
        let (asked, hazard) = read.problems.finish(asked.zip(hazard))?;
        Ok(Meant {
            asked,
            hazard,
            inputs,
            signing,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.resolve(files)?.asked().map(drop)
    }
}

/// Keys of one object alone.
const OF_ONE: [&str; 6] = [
    "mass",
    "height",
    "thickness",
    "width",
    "cg_height",
    "compare",
];

/// The most anchors along an edge.
const MAX_ANCHORS: u16 = 100;

/// In place of what shakes an object, until that is known.
const NOTHING: RestrainHazard = RestrainHazard::FloorAcceleration(0.0);

impl Restrain {
    fn one(&self, read: &mut WordReader<'_>, words: &Words) -> Option<RestrainRequest> {
        for key in ["sheet", "columns", "edit"] {
            if read.has(key) {
                read.note(
                    &[key],
                    format!("`{key}` says how a list is read, and there is none"),
                    "give a list, or leave it out",
                );
            }
        }
        let hint = "give the mass of the object, such as `mass = \"140 kg\"`";
        read.require("mass", "`mass` is missing", hint);
        let mass_kg = read.positive("mass", Dimension::Mass);
        let size = sizes(read);
        let common = common(read);
        let width_m = read.positive("width", Dimension::Length);
        let cg_height_m = read.positive("cg_height", Dimension::Length);
        let is_compared = read.flag("compare");
        let (height_m, thickness_m) = size?;
        let units = common.units.unwrap_or_else(|| typed_units(words));
        Some(RestrainRequest {
            mass_kg: mass_kg?,
            height_m,
            thickness_m,
            width_m,
            cg_height_m,
            hazard: NOTHING,
            floor: common.floor,
            factors: common.factors,
            component: common.component,
            anchors: common.anchors,
            units,
            is_compared,
        })
    }

    fn list(
        &self,
        read: &mut WordReader<'_>,
        list: Option<PathBuf>,
        files: &Files,
    ) -> Option<RestrainListRequest> {
        for key in OF_ONE {
            if read.has(key) {
                read.note(
                    &[key],
                    format!("`{key}` is that of one object, and there is a list"),
                    "leave it out, or leave the list out",
                );
            }
        }
        read.pass(&OF_ONE);
        let common = common(read);
        let cells = self.cells.cells(read, files);
        Some(RestrainListRequest {
            list: list?,
            cells,
            hazard: NOTHING,
            floor: common.floor,
            factors: common.factors,
            component: common.component,
            anchors: common.anchors,
            units: common.units,
        })
    }

    /// Exactly one earthquake.
    fn hazard(&self, read: &mut WordReader<'_>, files: &Files) -> Option<Hazard> {
        let words = read.problems.keep(self.target.located(files));
        let written = self.target.words();
        let keys: Vec<&'static str> = written.entries().map(|(key, _)| key).collect();
        read.pass(&keys);
        let acceleration = read.positive("floor_acceleration", Dimension::Acceleration);
        let source = study::source(read, files);
        read.exclusive("study", "floor_acceleration");
        if read.has("study") {
            for key in keys.into_iter().filter(|key| !place::KEYS.contains(key)) {
                read.note(
                    &[key],
                    format!("`{key}` has no meaning beside `study`"),
                    "leave it out: beside a study stand `place`, `spectrum`, `site` and `return_period_years` alone",
                );
            }
            let mut words = words?;
            if let Some(path) = words.get("spectrum").map(PathBuf::from) {
                words.set("spectrum", place::absolute(path));
            }
            return Some(Hazard::OfStudy(source?, words));
        }
        if read.has("floor_acceleration") {
            for key in keys {
                read.exclusive(key, "floor_acceleration");
            }
            let of_g = acceleration? / G0_M_S2;
            return Some(Hazard::Known(RestrainHazard::FloorAcceleration(of_g)));
        }
        if keys.is_empty() {
            read.missing(
                &["place"],
                "nothing says how strongly the floor shakes",
                "give one of `place`, `code` with its values, `study`, or `floor_acceleration`",
            );
            return None;
        }
        let words = words?;
        read.problems.keep(Target::for_parts(&words))?;
        Some(Hazard::Known(RestrainHazard::Code(words)))
    }
}

/// What is asked of one object and of a list.
struct Common {
    floor: RestrainFloor,
    factors: RestrainFactors,
    component: Option<String>,
    anchors: Anchors,
    units: Option<UnitSystem>,
}

/// The anchors; a name or a shear capacity alone has no effect.
fn anchors(read: &mut WordReader<'_>) -> Anchors {
    let name = read.one("anchor").map(str::to_owned);
    let tension_n = read.positive("anchor_capacity", Dimension::Force);
    let shear_n = read.positive("anchor_shear_capacity", Dimension::Force);
    if !read.has("anchor_capacity") {
        read.idle(
            &["anchor", "anchor_shear_capacity"],
            "no `anchor_capacity` is given, the design capacity of the anchor in tension",
        );
    }
    Anchors {
        inset_m: read.non_negative("anchor_inset", Dimension::Length),
        pivot: read.choice("pivot", &Pivot::ALL).unwrap_or_default(),
        per_edge: read
            .whole_within("anchors_per_edge", 1..=MAX_ANCHORS)
            .map_or(DEFAULT_ANCHORS_PER_EDGE.get(), usize::from),
        chosen: tension_n.map(|tension_n| Anchor {
            name,
            tension_n,
            shear_n,
        }),
    }
}

fn common(read: &mut WordReader<'_>) -> Common {
    Common {
        floor: RestrainFloor {
            name: read.one("floor").map(str::to_owned),
            level_ratio: read.non_negative("level_ratio", Dimension::Ratio),
            storeys: read
                .whole_within("storeys", 1..=MAX_STOREYS)
                .map(usize::from),
            storey_height_m: read.positive("storey_height", Dimension::Length),
        },
        factors: RestrainFactors {
            importance_ratio: read.positive("importance", Dimension::Ratio),
            amplification_ratio: read.positive("amplification", Dimension::Ratio),
            response_ratio: read.positive("response", Dimension::Ratio),
            resonance_ratio: read.positive("resonance", Dimension::Ratio),
            strength_ratio: read.positive("strength", Dimension::Ratio),
            building_ductility_ratio: read.positive("building_ductility", Dimension::Ratio),
        },
        component: read.one("component").map(str::to_owned),
        anchors: anchors(read),
        units: read.choice("units", &UnitSystem::ALL),
    }
}
