//! `object`: one object, one sentence.

use std::path::PathBuf;

use freestand_assess::one_object::{
    self, Earthquake, FloorPlace, ObjectRequest, RestsOn, Withstood, check_place,
};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{self, Dimension, UnitSystem};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_inventory::{CASTERS, Surroundings, UpperBody};
use freestand_study::building::MAX_STOREYS;
use freestand_study::hull::Surface;
use freestand_study::hull::body::Form;
use freestand_study::near_fault::near_fault;
use freestand_study::resolve::Overrides;

use crate::block::{self, sizes};
use crate::body::{self, BodyShape};
use crate::files::Files;
use crate::place::{self, FaultKeys, PlaceKeys};
use crate::records::{NamedRecords, Records};
use crate::request::{Question, Request as _, one_of, reader, request, seed, typed_units};
use crate::study;

/// The schema of the response.
pub use freestand_assess::one_object::SCHEMA;

request! { question
    /// One object, its floor and the earthquake.
    #[command(mut_args(|arg| place::under(arg, "The earthquake (one of four)")))]
    pub struct Object {
        /// Height of the object
        pub height = "LENGTH" under "The object",
        /// Horizontal size in the plane of rocking, usually the smaller one
        pub thickness = "LENGTH" under "The object",
        /// Horizontal size across the thickness [default: it rocks about one axis only]
        pub width = "LENGTH" under "The object",
        /// Height of the centre of gravity [default: half of the height]
        pub cg_height = "LENGTH" under "The object",
        /// Its shape, in three dimensions. A cylinder beside a wall lower than it is calculated as the square prism around it.
        #[command(flatten)]
        pub shape: BodyShape,
        /// Mass
        pub mass = "MASS" under "The object",
        /// What is under one edge: the stiffness of all pads there, such as "4380 N/mm", or an entry of
        /// the cushion library, such as rubber-foot; needs --mass
        #[arg(
            long,
            aliases = ["stiffness", "cushion"],
            value_name = "STIFFNESS|ENTRY",
            help_heading = "The object"
        )]
        pub on: Option<Written>,
        /// Peak acceleration that it withstands, such as "10 g", or with the duration of its half-sine,
        /// "15 g 11 ms"; needs --mass and --on
        pub tolerance = "ACCELERATION" under "The object",
        /// Duration of the half-sine with that peak, if --tolerance does not state it
        pub tolerance_duration = "TIME" under "The object",

        /// Coefficient of friction on the floor, one value or a range; it then slides where rocking needs
        /// more [default: enough for rocking; 0.2 to 0.8 tells whether it may slide, and counts for a stack]
        pub friction = "RATIO" under "The object",
        /// What is around it.
        #[command(flatten)]
        pub around: Around,

        /// A place.
        #[command(flatten)]
        pub hazard: PlaceKeys,
        /// Its fault.
        #[command(flatten)]
        pub fault: FaultKeys,
        /// Peak acceleration of the ground, such as "0.3 g"; the spectrum is that of Eurocode 8, type 1,
        /// ground B, scaled to it
        pub pga = "ACCELERATION" under "The earthquake (one of four)",
        /// Study file (TOML) with the ground motions and the building
        pub study = "FILE.toml" under "The earthquake (one of four)",
        /// Records of the motion of its floor
        #[arg(long, value_name = "FILE", num_args = 1.., help_heading = "The earthquake (one of four)")]
        pub motion: Vec<Written>,
        /// Factors on these motions, such as "0.5, 1, 2": a table by scale; the sentence is about the
        /// motions as they are
        pub scales = "GRID" under "The earthquake (one of four)",
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,

        /// Floor by its number (1 is the first above the ground) or name (ground, roof); needs
        /// --storeys, or the building of a study [default: the ground]
        pub floor = "NAME" under "The floor",
        /// Height of the floor over that of the building, 0 to 1, in place of --floor
        pub level_ratio = "RATIO" under "The floor",
        /// Number of storeys of the building [default: 30]
        pub storeys = "N" under "The floor",
        /// Height of a storey [default: 3.2 m]
        pub storey_height = "LENGTH" under "The floor",

        /// Largest number of simulated earthquakes [default: until the answer is settled, at most 1280]
        pub worlds = "N",
        /// Units of the texts; the JSON document is in SI [default: those in which most of
        /// --mass, --height and --thickness are typed]
        pub units = "UNITS" with (value_parser = one_of(&UnitSystem::ALL)),

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

request! {
    /// What a list says in the columns of the same names.
    pub struct Around under "What is around it" {
        /// Distance from its back to the wall; 0 where they touch [default: no wall]
        pub wall_gap = "LENGTH",
        /// Distance to what is on both sides of it, in the direction of the width [default: nothing]
        pub neighbour_gap = "LENGTH" with (alias = "neighbor-gap"),
        /// Height of the wall and of the neighbours [default: taller than the object]
        pub wall_height = "LENGTH",
        /// Stiffness of the wall where the top of the object strikes it, or of the stop of free casters
        pub wall_stiffness = "STIFFNESS",
        /// Angular velocity after an impact at the wall divided by the one before, at least 0 and less
        /// than 1 [default: drawn from 0 to 0.5; under given motions 0.5]
        pub wall_restitution = "RATIO",
        /// Casters: free ones roll, and only a stop can overturn the object
        pub casters = "CASTERS" with (alias = "castors", value_parser = one_of(CASTERS)),
        /// Rolling resistance of free casters: 0.01 on a hard floor, 0.05 on carpet [default: 0.02]
        pub rolling_resistance = "RATIO",
        /// How far it may slide or roll before it strikes something
        pub clearance = "LENGTH",
        /// Height of what stands on the object
        pub upper_height = "LENGTH",
        /// Thickness of what stands on the object
        pub upper_thickness = "LENGTH",
        /// Mass of what stands on the object
        pub upper_mass = "MASS",
    }
}

/// What is asked, in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Meant {
    /// The object, its floor and the earthquake.
    pub object: ObjectRequest,
    /// The files that are read.
    pub inputs: Vec<PathBuf>,
}

impl Question for Object {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let (mut object, named) = self.judged(files)?;
        if let Earthquake::Motions { motions, .. } = &mut object.earthquake {
            *motions = named.read_as(named.how())?;
        }
        let mut inputs = named.paths();
        inputs.extend(self.records.inputs(files));
        inputs.extend(files.path_of(self.study.as_ref()));
        inputs.extend(self.hazard.input(files));
        Ok(Meant { object, inputs })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        let (object, _) = self.judged(files)?;
        if let Earthquake::Study { source, hazard } = &object.earthquake {
            source.load(&Overrides {
                hazard: hazard.clone(),
                ..Overrides::default()
            })?;
        }
        Ok(())
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

impl Object {
    /// What the object looks like in three dimensions, in the axes of its histories there; `None`: it is drawn in a
    /// plane.
    ///
    /// # Errors
    /// As for [`Question::check`].
    pub fn surface(&self, files: &Files) -> Result<Option<Surface>, Problems> {
        Ok(self.judged(files)?.0.object.surface())
    }

    /// The request without its motions, and how they are read.
    fn judged<'f>(&self, files: &'f Files) -> Result<(ObjectRequest, NamedRecords<'f>), Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let named = self.records.named_alone(&mut read, &self.motion, files);
        let object = self.described(&mut read, files);
        let earthquake = self.earthquake(&mut read, files);
        let floor = floor(&mut read);
        let worlds = read.whole_within("worlds", 1..);
        let seed = seed(&mut read);
        let units = read.choice("units", &UnitSystem::ALL);
        let request = object
            .zip(earthquake)
            .map(|(object, earthquake)| ObjectRequest {
                object,
                earthquake,
                floor,
                worlds,
                seed,
                units: units.unwrap_or_else(|| typed_units(&words)),
            });
        if let Some(request) = &request {
            read.problems.keep_comparisons(one_object::check(request));
        }
        Ok((read.problems.finish(request)?, named))
    }

    /// The object as its owner describes it.
    fn described(&self, read: &mut WordReader<'_>, files: &Files) -> Option<one_object::Object> {
        let mass_kg = read.positive("mass", Dimension::Mass);
        let shape = self.shaped(read, mass_kg, files);
        let rests_on = rests_on(read);
        let tolerance = tolerance(read);
        let friction_ratio = friction(read);
        let surroundings = surroundings(read);
        Some(one_object::Object {
            mass_kg,
            rests_on,
            tolerance,
            friction_ratio,
            surroundings,
            ..shape?
        })
    }

    /// What is known of its shape alone.
    fn shaped(
        &self,
        read: &mut WordReader<'_>,
        mass_kg: Option<f64>,
        files: &Files,
    ) -> Option<one_object::Object> {
        if !read.has("scan") {
            let of_scan = [
                "scan_unit",
                "scan_base",
                "scan_error",
                "scan_hull",
                "stand_on",
            ];
            read.idle(&of_scan, "there is no scan");
        }
        if body::is_body(read, self.shape.shape.as_ref()) {
            if read.has("scan") {
                let sizes = ["height", "thickness", "width", "diameter"];
                read.idle(&sizes, "a scan has its own");
            }
            if !read.has("scan") && self.shape.is_polygon() {
                read.idle(&["width"], "a polygon has a diameter");
            }
            return body::body(read, mass_kg, files).map(one_object::Object::of_body);
        }
        let named = body::named(read);
        if named.is_none() && self.shape.shape.is_some() {
            // Which sizes it has is not known.
            return None;
        }
        let is_round = named == Some(Form::Cylinder);
        let size = match is_round {
            true => block::height(read).zip(body::diameter(read)),
            false => sizes(read),
        };
        let width_m = read.positive("width", Dimension::Length);
        let cg_height_m = read.positive("cg_height", Dimension::Length);
        let (height_m, thickness_m) = size?;
        Some(one_object::Object {
            width_m,
            is_round,
            cg_height_m,
            ..one_object::Object::of_size(height_m, thickness_m)
        })
    }

    /// Exactly one earthquake, with the keys that belong to it.
    fn earthquake(&self, read: &mut WordReader<'_>, files: &Files) -> Option<Earthquake> {
        let hazard = self.hazard.words_with(&self.fault, read, files);
        read.pass(&place::FAULT_KEYS);
        let has_study = read.has("study");
        // The file is the hazard of the place.
        let of_place = if read.has("place") {
            "place"
        } else {
            "spectrum"
        };
        let has_place = read.has(of_place);
        if has_place && !has_study {
            read.problems.keep(check_place(&hazard));
        }
        let peak_m_s2 = read.positive("pga", Dimension::Acceleration);
        let scales = read.grid("scales", Dimension::Ratio);
        let source = study::source(read, files);
        let has_motion = !self.motion.is_empty();
        if has_motion {
            for key in place::FAULT_KEYS
                .into_iter()
                .filter(|key| read.words.get(key).is_some())
            {
                read.problems.push(
                    Problem::value(
                        format!("`{key}` does not apply: the motions of the floor are given"),
                        format!(
                            "leave `{key}` out: a record from near a fault already has its pulse"
                        ),
                    )
                    .of(&[key]),
                );
            }
        }
        if !has_motion && read.has("scales") {
            read.note(
                &["scales"],
                "`scales` applies to motions of the floor",
                "name them with `motion`, or leave `scales` out",
            );
        }
        let has_site = self.hazard.site.is_some() || self.hazard.return_period_years.is_some();
        let named = [
            (of_place, has_place && !has_study),
            ("pga", read.has("pga")),
            ("study", has_study),
            ("motion", has_motion),
        ];
        let named: Vec<&'static str> = named
            .into_iter()
            .filter_map(|(key, is_named)| is_named.then_some(key))
            .collect();
        if has_site && !named.is_empty() && !has_place && !has_study {
            read.note(
                &["site", "return_period_years"],
                "`site` and `return_period_years` belong to the code of a place",
                "add `place`, or leave them out",
            );
        }
        match named[..] {
            ["place" | "spectrum"] => Some(Earthquake::Place(hazard)),
            ["pga"] => Some(Earthquake::GroundAcceleration {
                near_fault: read.problems.keep(near_fault(&self.fault.words(), None))?,
                peak_m_s2: peak_m_s2?,
            }),
            ["study"] => Some(Earthquake::Study {
                source: source?,
                hazard,
            }),
            ["motion"] => Some(Earthquake::Motions {
                motions: Vec::new(),
                scales: scales.unwrap_or_default(),
            }),
            [] => {
                read.missing(
                    &["place"],
                    "no earthquake is named",
                    "name one: `place`, `pga`, `study`, or `motion` with motions of its floor",
                );
                None
            }
            _ => {
                let keys: Vec<String> = named.iter().map(|key| format!("`{key}`")).collect();
                let message = format!("{} name different earthquakes", keys.join(" and "));
                read.note(&named, message, "keep one of them");
                None
            }
        }
    }
}

/// What is around the object.
fn surroundings(read: &mut WordReader<'_>) -> Surroundings {
    let keys = ["upper_height", "upper_thickness", "upper_mass"];
    let height_m = read.positive("upper_height", Dimension::Length);
    let thickness_m = read.positive("upper_thickness", Dimension::Length);
    let mass_kg = read.positive("upper_mass", Dimension::Mass);
    let is_complete = read.has("upper_height") && read.has("upper_thickness");
    if !is_complete && keys.iter().any(|key| read.has(key)) {
        read.missing(
            &["upper_height", "upper_thickness"],
            "what stands on the object lacks its height or its thickness",
            "give `upper_height` and `upper_thickness`, or leave out what stands on it",
        );
    }
    Surroundings {
        wall_gap_m: read.non_negative("wall_gap", Dimension::Length),
        neighbour_gap_m: read.non_negative("neighbour_gap", Dimension::Length),
        wall_height_m: read.positive("wall_height", Dimension::Length),
        wall_stiffness_n_m: read.positive("wall_stiffness", Dimension::Stiffness),
        wall_restitution: read.non_negative("wall_restitution", Dimension::Ratio),
        casters: read.choice("casters", CASTERS),
        rolling_resistance_ratio: read.positive("rolling_resistance", Dimension::Ratio),
        clearance_m: read.non_negative("clearance", Dimension::Length),
        upper: height_m
            .zip(thickness_m)
            .map(|(height_m, thickness_m)| UpperBody {
                height_m,
                thickness_m,
                mass_kg,
            }),
    }
}

/// Where the object is.
fn floor(read: &mut WordReader<'_>) -> one_object::Floor {
    read.exclusive("floor", "level_ratio");
    let name = read.one("floor").map(str::to_owned);
    let ratio = read.quantity("level_ratio", Dimension::Ratio);
    one_object::Floor {
        place: match (name, ratio) {
            (Some(name), _) => FloorPlace::Name(name),
            (None, Some(ratio)) => FloorPlace::Share(ratio),
            (None, None) => FloorPlace::Ground,
        },
        storeys: read.whole_within("storeys", 1..=MAX_STOREYS),
        storey_height_m: read.positive("storey_height", Dimension::Length),
    }
}

/// What is under one edge: a stiffness begins with a digit, an entry with a letter.
fn rests_on(read: &mut WordReader<'_>) -> Option<RestsOn> {
    let is_entry = |text: &str| text.trim().starts_with(char::is_alphabetic);
    if read.words.get("on").is_some_and(is_entry) {
        let entry = read.one("on")?.trim();
        return Some(RestsOn::Entry(entry.to_owned()));
    }
    read.positive("on", Dimension::Stiffness)
        .map(RestsOn::Stiffness)
}

/// What it withstands.
fn tolerance(read: &mut WordReader<'_>) -> Option<Withstood> {
    let duration_s = read.positive("tolerance_duration", Dimension::Time);
    let withstood = match read.words.numbers("tolerance") {
        [_] => read
            .positive("tolerance", Dimension::Acceleration)
            .map(|peak_m_s2| Withstood {
                peak_m_s2,
                duration_s: None,
            }),
        _ => read.read("tolerance", withstood),
    };
    if read.has("tolerance_duration") {
        read.require(
            "tolerance",
            "`tolerance_duration` needs `tolerance`",
            "add the peak of the half-sine, or leave the duration out",
        );
        if withstood.is_some_and(|withstood| withstood.duration_s.is_some()) {
            read.note(
                &["tolerance_duration"],
                "`tolerance` states a duration already",
                "leave `tolerance_duration` out",
            );
        }
    }
    withstood.map(|withstood| Withstood {
        duration_s: withstood.duration_s.or(duration_s),
        ..withstood
    })
}

/// A peak, perhaps with the duration of its half-sine: `10 g`, `15g 11ms`.
pub(crate) fn withstood(text: &str) -> Result<Withstood, Problem> {
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

/// The coefficient of friction: one value, or the two ends of a range.
fn friction(read: &mut WordReader<'_>) -> Option<(f64, f64)> {
    match *read.words.numbers("friction") {
        [low, high] => {
            read.pass(&["friction"]);
            read.keep("friction", range(low, high))
        }
        _ => read.read("friction", ratios),
    }
}

/// One ratio, or the two ends of a range: `0.4`, `0.3-0.5`, `0.3 to 0.5`.
pub(crate) fn ratios(text: &str) -> Result<(f64, f64), Problem> {
    let positive = |text: &str| quantity::parse_positive(text, Dimension::Ratio, "the value");
    // A minus sign after an e is that of an exponent.
    let dashes = text.match_indices(['-', '\u{2013}']);
    let mut between = dashes.filter(|(at, _)| {
        let before = text.get(..*at).unwrap_or_default();
        !before.trim().is_empty() && !before.ends_with(['e', 'E'])
    });
    let ends = text.split_once(" to ").or_else(|| {
        let (at, dash) = between.next()?;
        Some((text.get(..at)?, text.get(at + dash.len()..)?))
    });
    let (low, high) = ends.unwrap_or((text, text));
    range(positive(low)?, positive(high)?)
}

fn range(low: f64, high: f64) -> Result<(f64, f64), Problem> {
    if !(low > 0.0 && quantity::is_possible(high)) {
        let message = format!("{low} to {high} is not a range of finite ratios above 0");
        return Err(Problem::value(message, "give ratios such as 0.3 to 0.5"));
    }
    if low > high {
        return Err(Problem::value(
            format!("the range from {low} to {high} falls"),
            "write the smaller value first",
        ));
    }
    Ok((low, high))
}
