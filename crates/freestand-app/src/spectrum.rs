//! `spectrum`: a grid of objects under motions.

use std::path::PathBuf;

use freestand::block::Block;
use freestand::respond::Settings;
use freestand::rocking::{Base, Restitution, RockingModel};
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::counted;
use freestand_input::written::Written;
use freestand_output::answer;
use freestand_records::notes::{Note, grouped};
use freestand_report::doubts::study_doubts;
use freestand_study::at_place::{LastGround, motions_at};
use freestand_study::building::MAX_STOREYS;
use freestand_study::recorded::Second;
use freestand_study::resolve::{Hazard, Values, of_values};
use freestand_study::spectrum::{Grid, SpectrumMotion, SpectrumRequest, SpectrumTiming};
use freestand_study::unsolved::rocking_problem;

use crate::block::{Rocking, accuracy, model, restitution};
use crate::cushion::CushionUnder;
use crate::files::Files;
use crate::records::{NamedRecords, OneMotion, ReadMotions, Records, VerticalRecords};
use crate::request::{Question, Request, reader, request, seed};
use crate::sliding::{Sliding, contact, surface};
use crate::walls::{Walls, walls};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.spectrum/1";

request! { question
    /// A grid of objects, and what shakes it.
    // Rows have no shock of a stop: the flag is known only to be refused with a hint.
    #[command(mut_arg("stop_stiffness", |arg| arg.hide(true)))]
    pub struct Spectrum {
        /// Records of the horizontal acceleration of the floor
        #[arg(long, value_name = "FILE", num_args = 1..)]
        pub motion: Vec<Written>,
        /// Records of the vertical acceleration of the floor, positive upward: one for each --motion,
        /// with the same step and length
        #[arg(long, value_name = "FILE", num_args = 1..)]
        pub vertical: Vec<Written>,
        /// How the vertical records are read.
        #[command(flatten)]
        pub upward: VerticalRecords,
        /// How records are read.
        #[command(flatten)]
        pub records: Records,
        /// A floor of a building at a place, instead of records.
        #[command(flatten)]
        pub place: Place,

        /// Heights: a grid "from:to:count" or a list
        pub heights = "GRID" under "The objects",
        /// Thicknesses: a grid "from:to:count" or a list
        pub thicknesses = "GRID" under "The objects",
        /// One object for each height and the thickness at the same place, instead of all combinations
        pub pairs = switch under "The objects",
        /// Mass of each object; needed for the shock
        pub mass = "MASS" under "The objects",
        /// The cushion under one edge.
        #[command(flatten)]
        pub pad: CushionUnder,
        /// Coefficient of friction of objects that slide, at rest [default: 0.5]
        pub friction = "RATIO" under "Sliding and casters",
        /// Whether the objects slide or stand on casters.
        #[command(flatten)]
        pub slides: Sliding,
        /// Walls beside them.
        #[command(flatten)]
        pub walls: Walls,
        /// How their rocking is calculated.
        #[command(flatten)]
        pub rocking: Rocking,
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
        pub sensitivity = switch under "The rocking",

        /// Seed of the random numbers of synthetic motions.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

request! {
    /// A floor of a building at a place, instead of records.
    pub struct Place under "A place instead of records" {
        /// Place, with its code and hazard; see freestand place list
        pub place = "NAME",
        /// Site class of the code
        pub site = "CLASS",
        /// Return period in years, of AS 1170.4 and NZS 1170.5
        #[arg(
            long = "return-period",
            value_name = "YEARS",
            help_heading = "A place instead of records"
        )]
        pub return_period_years: Option<Written>,
        /// Number of synthetic motions [default: 10]
        pub count = "N",
        /// Height of the floor divided by that of the building: 0 is the ground, 1 the roof [default: 0]
        pub level_ratio = "RATIO",
        /// Number of storeys of the building [default: 30]
        pub storeys = "N",
        /// Height of a storey [default: 3.2 m]
        pub storey_height = "LENGTH",
    }
}

/// What is asked, in SI.
#[derive(Debug)]
pub struct Meant {
    /// The objects.
    pub objects: SpectrumRequest,
    /// What shakes them.
    pub shaking: Shaking,
    /// The files that were read.
    pub inputs: Vec<PathBuf>,
}

/// What shakes the objects.
#[derive(Debug)]
pub enum Shaking {
    /// Records.
    Recorded(Shaken),
    /// Synthetic motions of a floor at a place, and the height of the floor divided by that of the building.
    AtPlace(Box<Values>, f64),
}

/// Motions, with what was done to them.
#[derive(Debug, Clone, Default)]
pub struct Shaken {
    /// The motions.
    pub motions: Vec<SpectrumMotion>,
    /// What was done to each of them.
    pub processing: Vec<Processed>,
    /// What is doubtful about them.
    pub warnings: Vec<String>,
}

answer! {
    /// What was done to a motion.
    pub struct Processed {
        /// The motion.
        motion: String,
        /// Each step.
        steps: Vec<String>,
    }
}

answer! {
    /// What follows the rows in the document.
    pub struct Others {
        /// What was done to each motion.
        processing: Vec<Processed>,
        /// Time in the solver alone, and its work.
        timing: SpectrumTiming,
    }
}

/// Synthetic motions are made later, see [`Shaking::motions`].
impl Question for Spectrum {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let Judged {
            objects,
            shaking,
            named,
        } = judged(self, files)?;
        let (shaking, mut inputs) = match shaking {
            Some(shaking) => (shaking, Vec::new()),
            None => {
                let read = named.read(Second::None, None)?;
                let inputs = read.inputs.clone();
                (Shaking::Recorded(recorded(read)?), inputs)
            }
        };
        inputs.extend(self.pad.input(files));
        inputs.extend(self.records.inputs(files));
        Ok(Meant {
            objects,
            shaking,
            inputs,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        judged(self, files).map(drop)
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

/// What a request means, with records that have not been read.
struct Judged<'f> {
    objects: SpectrumRequest,
    shaking: Option<Shaking>,
    /// What shakes the objects where nothing else does.
    named: NamedRecords<'f>,
}

/// What a request means.
fn judged<'f>(request: &Spectrum, files: &'f Files) -> Result<Judged<'f>, Problems> {
    let words = request.words();
    let mut read = reader::<Spectrum>(&words, &request.unknown);
    let vertical = (request.vertical.as_slice(), &request.upward);
    let named = request
        .records
        .named(&mut read, &request.motion, vertical, files);
    let (motions, verticals) = (request.motion.len(), request.vertical.len());
    if verticals > 0 && verticals != motions {
        let message = format!(
            "`vertical` has {}, `motion` {motions}",
            counted(verticals, "file")
        );
        let hint = "give one vertical record for each horizontal one, in the same order, or none";
        read.note(&["vertical"], message, hint);
    }
    let shaking = shaking(request, &mut read);
    let objects = objects(request, &mut read, files);
    for key in read.unread() {
        let (home, hint) = match key {
            "brakes" | "rolling_resistance" => ("objects on casters", "add `casters`"),
            _ => ("objects that slide or roll", "add `sliding`, or `casters`"),
        };
        read.note(&[key], format!("`{key}` applies only to {home}"), hint);
    }
    Ok(Judged {
        objects: read.problems.finish(objects)?,
        shaking,
        named,
    })
}

/// The synthetic motions of a place; `None`: records, or something is wrong.
fn shaking(request: &Spectrum, read: &mut WordReader<'_>) -> Option<Shaking> {
    let mut place = Words::default();
    request.place.write(&mut place);
    let keys: Vec<&'static str> = place.entries().map(|(key, _)| key).collect();
    let seed = seed(read);
    if !request.motion.is_empty() {
        read.pass(&keys);
        if let Some(key) = keys.first() {
            let message =
                format!("`{key}` applies to motions of a place, but `motion` names records");
            read.note(&[key], message, "leave out one of the two");
        }
        return None;
    }
    if !read.has("place") {
        let hint = "name records of the floor with `motion`, or a place with `place`";
        read.missing(&["motion"], "no motion is named", hint);
    }
    let count = read.whole_within("count", 1..=1000);
    let storeys = read.whole_within("storeys", 1..=MAX_STOREYS);
    let level_ratio = read.quantity("level_ratio", Dimension::Ratio);
    let storey_height_m = read.positive("storey_height", Dimension::Length);
    for key in ["count", "storeys", "level_ratio", "storey_height"] {
        place.remove(key);
    }
    read.pass(&["place", "site", "return_period_years"]);
    let values = Values {
        hazard: Hazard::Keys(place),
        count,
        seed,
        storeys,
        storey_height_m,
    };
    if read.has("place") {
        read.problems.keep(of_values(&values));
    }
    let level_ratio = level_ratio.unwrap_or(0.0);
    if !(0.0..=1.0).contains(&level_ratio) {
        let message = format!("`level_ratio` must be from 0 to 1, not {level_ratio}");
        let hint = "give 0 for the ground, 1 for the roof, or a value between them";
        read.note(&["level_ratio"], message, hint);
    }
    Some(Shaking::AtPlace(Box::new(values), level_ratio))
}

/// The objects; `None` if something is missing or wrong.
fn objects(
    request: &Spectrum,
    read: &mut WordReader<'_>,
    files: &Files,
) -> Option<SpectrumRequest> {
    for key in ["heights", "thicknesses"] {
        let hint = format!("give them, such as `{key} = \"1.5 m, 2 m\"`");
        read.require(key, format!("`{key}` is missing"), hint);
    }
    let heights = read.grid("heights", Dimension::Length);
    let thicknesses = read.grid("thicknesses", Dimension::Length);
    let mass_kg = read.positive("mass", Dimension::Mass);
    let edge = request.pad.resolve(read, mass_kg, files);
    let has_cushion = !request.pad.words().is_empty();
    if read.has("mass") != (has_cushion || read.has("wall_stiffness")) {
        let message = "the shock needs both the mass and the cushion of the objects";
        let key = if read.has("mass") {
            "stiffness"
        } else {
            "mass"
        };
        read.missing(
            &[key],
            message,
            "give `mass` and `stiffness` (or another cushion), or neither",
        );
    }
    let settings = Settings {
        model: model(read),
        accuracy: accuracy(read),
        ..Settings::default()
    };
    let is_paired = read.flag("pairs");
    // Whether walls are refused does not depend on the size of the objects.
    let first = |list: &Option<Vec<f64>>| list.as_ref().and_then(|list| list.first().copied());
    let first = first(&heights).zip(first(&thicknesses));
    let first =
        first.and_then(|(height_m, thickness_m)| Block::uniform(height_m, thickness_m).ok());
    let grid = heights.zip(thicknesses).and_then(|(heights, thicknesses)| {
        let grid = match is_paired {
            true => Grid::pairs(heights, thicknesses),
            false => Grid::new(heights, thicknesses),
        };
        read.problems
            .keep(grid.map_err(|problem| problem.of(&["heights", "thicknesses"])))
    });
    // Only a factor depends on the objects.
    let blocks: Vec<Block> = grid
        .iter()
        .filter(|_| read.has("restitution_factor"))
        .flat_map(|grid| grid.blocks(0..grid.objects()))
        .collect();
    let (walls, wall) = walls(read, first.as_ref(), mass_kg, Some(settings.model));
    let restitution = restitution(read, &blocks);
    let sensitivity = read.flag("sensitivity");
    let contact = match read.has("sliding") || read.has("casters") {
        true => contact(read),
        false => None,
    };
    let surface = contact.map(|contact| surface(read, contact));
    if contact.is_none() && (read.has("sliding") || read.has("casters")) {
        // What is wrong with these two has been said.
        let keys: Vec<&'static str> = request
            .slides
            .words()
            .entries()
            .map(|(key, _)| key)
            .collect();
        read.pass(&keys);
        read.pass(&["friction"]);
    } else if contact.is_none() && read.has("friction") {
        read.pass(&["friction"]);
        let hint = "add `sliding`, or `casters` with `brakes`";
        read.note(
            &["friction"],
            "`friction` is used by objects that slide",
            hint,
        );
    }
    if read.has("stop_stiffness") {
        read.pass(&["stop_stiffness"]);
        let message = "`stop_stiffness` is for the command rock only: rows have no shock of a stop";
        read.note(&["stop_stiffness"], message, "leave it out");
    }
    if contact.is_some() && (read.has("mass") || sensitivity) {
        let key = if read.has("mass") {
            "mass"
        } else {
            "sensitivity"
        };
        let message =
            "the shock and the sensitivity are those of rocking objects, and these slide or roll";
        read.note(
            &[key],
            message,
            "leave `mass`, the cushion and `sensitivity` out",
        );
    }
    if contact.is_some() && !walls.is_none() {
        let message = "walls stop objects that rock, and these slide or roll";
        let hint =
            "leave the walls out, and give the room as `clearance_left` and `clearance_right`";
        let key = if read.has("wall_gap_left") {
            "wall_gap_left"
        } else {
            "wall_gap_right"
        };
        read.note(&[key], message, hint);
    }
    let objects = SpectrumRequest {
        grid: grid?,
        restitution,
        walls,
        settings,
        cushion: mass_kg.zip(edge),
        wall,
        sensitivity,
        surface: match surface {
            Some(surface) => Some(surface?),
            None => None,
        },
    };
    idle(&objects, read);
    Some(objects)
}

/// Refuses what belongs to rocking where no object rocks.
fn idle(objects: &SpectrumRequest, read: &mut WordReader<'_>) {
    let of_rocking = [
        (
            "restitution",
            matches!(objects.restitution, Restitution::Value(_)),
        ),
        (
            "restitution_factor",
            matches!(objects.restitution, Restitution::Factor(_)),
        ),
        ("model", objects.settings.model == RockingModel::Linearised),
    ];
    for (key, _) in of_rocking.into_iter().filter(|(_, is_given)| *is_given) {
        if objects.none_rocks() {
            let message =
                format!("`{key}` has no effect: every object slides or rolls, and none rocks");
            read.note(&[key], message, "leave it out");
        }
    }
}

/// Records as what shakes the objects.
fn recorded(read: ReadMotions) -> Result<Shaken, Problems> {
    let notes = |motions: &[OneMotion], before: &str| {
        let named = |one: &OneMotion| {
            let name = format!("{before}{}", one.name);
            let notes = one
                .notes
                .iter()
                .map(move |note| (name.clone(), note.clone()));
            notes.collect::<Vec<(String, Note)>>()
        };
        let all: Vec<(String, Note)> = motions.iter().flat_map(named).collect();
        grouped(all.iter().map(|(name, note)| (name.clone(), note)))
    };
    let mut warnings = notes(&read.horizontal, "");
    warnings.extend(notes(&read.vertical, "vertical "));
    let mut verticals = read.vertical.into_iter();
    let (mut motions, mut processing) = (Vec::new(), Vec::new());
    for one in read.horizontal {
        let mut steps = one.processing;
        let vertical = verticals.next().map(|upward| {
            let name = format!("vertical {}", upward.name);
            steps.extend(
                upward
                    .processing
                    .iter()
                    .map(|step| format!("{name}: {step}")),
            );
            upward.motion
        });
        // Once, not for every object.
        Base {
            horizontal: Some(&one.motion),
            vertical: vertical.as_ref(),
        }
        .check()
        .map_err(|error| rocking_problem(error).of(&["vertical"]))?;
        processing.push(Processed {
            motion: one.name.clone(),
            steps,
        });
        motions.push(SpectrumMotion {
            name: one.name,
            horizontal: one.motion,
            vertical,
        });
    }
    Ok(Shaken {
        motions,
        processing,
        warnings,
    })
}

impl Shaking {
    /// The motions; those of a place are made now, or taken from `last`.
    ///
    /// # Errors
    /// What the code or the building refuses, and what `go_on` returns.
    pub fn motions(
        self,
        last: &LastGround,
        go_on: impl Fn() -> Result<(), Problems> + Sync,
    ) -> Result<Shaken, Problems> {
        let (values, level_ratio) = match self {
            Self::Recorded(shaken) => return Ok(shaken),
            Self::AtPlace(values, level_ratio) => (values, level_ratio),
        };
        let made = motions_at(&values, level_ratio, last, go_on)?;
        let processed = |motion: &SpectrumMotion| Processed {
            motion: motion.name.clone(),
            steps: made.processing.clone(),
        };
        Ok(Shaken {
            processing: made.motions.iter().map(processed).collect(),
            motions: made.motions,
            warnings: study_doubts(&made.doubts),
        })
    }
}
