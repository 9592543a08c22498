//! One object: whether an earthquake rocks it and whether it falls over, in one sentence.
//!
//! It is one row of an assessment. `row` judges its values as those of a row of a list, `shaking` makes the
//! study; [`one_object`] lets the object live through its worlds as [`crate::portfolio`] does for a
//! list. `freestand-report` says what comes out.

mod earthquake;
mod row;
mod shaking;

use std::sync::Arc;

use freestand::worlds::NearFault;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::UnitSystem;
use freestand_input::words::number;
use freestand_study::doubt::UnlikelySize;
use freestand_study::hull::{BodyInPose, Surface};
use freestand_study::recorded::ReadMotion;
use freestand_study::resolve::StudySource;
use freestand_study::study::{Study, StudyDoubt};

use crate::reason::{Missing, Reason};
use crate::result::Assessment;
use crate::two_spectra::{is_worse, spectrum_type};
use crate::verdict::{AssessedOne, Context, Member, Subject, assess_one, round_body};
pub use crate::verdict::{Follow, HULL_FRICTION_RATIO, Shown, ShownEarthquake, Tally, middle};
pub use crate::worlds::Memory;
use crate::worlds::Worlds;
use freestand_inventory::{Casters, Item, Surroundings};
use strum::VariantArray;

pub use earthquake::NamedEarthquake;
pub use shaking::check_place;

/// Schema of the document of `freestand object`.
pub const SCHEMA: &str = "freestand.object/1";

/// The largest number of scales.
const MAX_SCALES: usize = 100;

/// Above any peak acceleration of a ground that was recorded, by far \[m/s²\]: 10 g.
const MAX_PEAK_M_S2: f64 = 98.0665;

/// One object, its floor and the earthquake.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectRequest {
    /// The object.
    pub object: Object,
    /// The earthquake.
    pub earthquake: Earthquake,
    /// Where it is.
    pub floor: Floor,
    /// The most simulated earthquakes; `None`: as in an assessment.
    pub worlds: Option<u32>,
    /// Replaces every seed.
    pub seed: Option<u64>,
    /// The units of the texts; those of names such as `uplift_m_max` do not change.
    pub units: UnitSystem,
}

/// An object as its owner describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Height \[m\].
    pub height_m: f64,
    /// Horizontal size in the plane of rocking \[m\].
    pub thickness_m: f64,
    /// Horizontal size across it \[m\]; `None`: it rocks about one axis only.
    pub width_m: Option<f64>,
    /// Whether its base is round; its sides are then those of the square around it.
    pub is_round: bool,
    /// Its shape, where it is neither a box nor round; its thickness is then that of the symmetric block with the same
    /// energy barrier.
    pub body: Option<Arc<BodyInPose>>,
    /// Height of the centre of gravity \[m\]; `None`: half the height.
    pub cg_height_m: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
    /// What is under one edge.
    pub rests_on: Option<RestsOn>,
    /// What it withstands.
    pub tolerance: Option<Withstood>,
    /// Coefficient of friction on the floor, from the first to the second; `None`: drawn as in an
    /// assessment.
    pub friction_ratio: Option<(f64, f64)>,
    /// What is beside it and on it, and whether it rolls.
    pub surroundings: Surroundings,
}

impl Object {
    /// A body of which nothing else is known.
    pub fn of_body(body: Arc<BodyInPose>) -> Self {
        Self {
            cg_height_m: Some(body.standing.pose().cg_height_m),
            body: Some(Arc::clone(&body)),
            ..Self::of_size(body.height_m, body.thickness_m())
        }
    }

    /// What it looks like in three dimensions, in the axes of a history there; `None`: it is drawn in a plane.
    pub fn surface(&self) -> Option<Surface> {
        if let Some(body) = &self.body {
            return Some(body.surface.clone());
        }
        let (height_m, diameter_m) = (self.height_m, self.thickness_m);
        let body = || round_body(height_m, diameter_m, self.cg_height_m, self.mass_kg);
        Some(self.is_round.then(body)??.surface)
    }

    /// A box of which nothing but its size is known, in a room without walls.
    pub fn of_size(height_m: f64, thickness_m: f64) -> Self {
        Self {
            height_m,
            thickness_m,
            width_m: None,
            is_round: false,
            body: None,
            cg_height_m: None,
            mass_kg: None,
            rests_on: None,
            tolerance: None,
            friction_ratio: None,
            surroundings: Surroundings::default(),
        }
    }
}

/// What is under one edge of an object.
#[derive(Debug, Clone, PartialEq)]
pub enum RestsOn {
    /// A cushion of this stiffness \[N/m\].
    Stiffness(f64),
    /// An entry of the cushion library.
    Entry(String),
}

/// A peak acceleration that an object withstands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Withstood {
    /// The peak \[m/s²\].
    pub peak_m_s2: f64,
    /// Duration of the half-sine with that peak \[s\].
    pub duration_s: Option<f64>,
}

/// The earthquake.
#[derive(Debug, Clone, PartialEq)]
pub enum Earthquake {
    /// The hazard of a place by its code: the keys `place`, `site`, `return_period_years` of a study.
    Place(Words),
    /// A peak acceleration of the ground, with the spectrum of Eurocode 8, type 1, ground B.
    GroundAcceleration {
        /// Its value \[m/s²\].
        peak_m_s2: f64,
        /// The fault of the earthquake, if one is known.
        near_fault: Option<NearFault>,
    },
    /// The ground motions and the building of a study, perhaps with the hazard of a place.
    Study {
        /// The study.
        source: StudySource,
        /// Keys that replace its hazard.
        hazard: Words,
    },
    /// Motions of the floor, under which the object is taken as given.
    Motions {
        /// The motions.
        motions: Vec<ReadMotion>,
        /// Factors on them; empty: none.
        scales: Vec<f64>,
    },
}

/// Where an object is.
#[derive(Debug, Clone, PartialEq)]
pub struct Floor {
    /// The floor.
    pub place: FloorPlace,
    /// Number of storeys; `None`: the study's.
    pub storeys: Option<u16>,
    /// Height of a storey \[m\]; `None`: the study's.
    pub storey_height_m: Option<f64>,
}

/// A floor of a building.
#[derive(Debug, Clone, PartialEq)]
pub enum FloorPlace {
    /// The ground.
    Ground,
    /// By its name or number; floor 1 is the first above the ground.
    Name(String),
    /// By its height over that of the building.
    Share(f64),
}

/// What became of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectResult<'r> {
    /// What was asked.
    pub request: &'r ObjectRequest,
    /// The study that shook it.
    pub study: Study,
    /// Its earthquake, as an answer names it.
    pub earthquake: NamedEarthquake,
    /// The object, as a list has it.
    pub item: Item,
    /// The object under its motions.
    pub at_one: AtScale,
    /// The object under its motions at each scale that was asked for.
    pub scales: Vec<AtScale>,
    /// What is doubtful about the study.
    pub study_doubts: Vec<StudyDoubt>,
    /// Its sizes that hardly any object has.
    pub unlikely_sizes: Vec<UnlikelySize>,
    /// What else is doubtful about it, as of a row of a list.
    pub row_doubts: Vec<String>,
    /// What was given and changes nothing.
    pub unused: Vec<Unused>,
}

/// An object under its motions, all multiplied by a scale.
#[derive(Debug, Clone, PartialEq)]
pub struct AtScale {
    /// The scale.
    pub scale_ratio: f64,
    /// Its assessment.
    pub found: Assessment,
    /// What its worlds add up to.
    pub tally: Tally,
}

/// Assesses one object, on the current thread pool. Nothing is written.
///
/// With motions of its floor the object is taken as given, and every motion counts once; otherwise
/// worlds are added until the probability that it falls is settled, as in an assessment.
///
/// # Errors
/// Everything that is wrong with the request; a motion that cannot be generated; a stop.
pub fn one_object<'r>(
    request: &'r ObjectRequest,
    wants_to_stop: &(dyn Fn() -> bool + Sync),
) -> Result<ObjectResult<'r>, Problems> {
    Ok(one_object_shown(request, &Memory::default(), None, wants_to_stop)?.0)
}

/// As [`one_object`], with some of its earthquakes and the history in the one that is followed; motions
/// of the ground and the floor are taken from `memory` and kept there.
///
/// # Errors
/// As for [`one_object`], or no earthquake of the name that is followed.
pub fn one_object_shown<'r>(
    request: &'r ObjectRequest,
    memory: &Memory,
    follow: Option<&Follow>,
    wants_to_stop: &(dyn Fn() -> bool + Sync),
) -> Result<(ObjectResult<'r>, Option<Shown>), Problems> {
    check(request)?;
    let shaken = shaking::shaken(request)?;
    let other = shaken.alternative();
    let one = in_study(request, shaken, memory, follow, wants_to_stop)?;
    let Some(other) = other else {
        return Ok(one);
    };
    // Motions of one spectrum must not serve for the other.
    let (mut other, shown) = in_study(request, other, &Memory::default(), follow, wants_to_stop)?;
    if !is_worse(&other.item, &one.0.at_one.found, &other.at_one.found) {
        return Ok(one);
    }
    let decides = Reason::Spectrum(spectrum_type(&other.study));
    other.at_one.found.why.push(decides);
    Ok((other, shown))
}

/// As [`one_object_shown`], in one study.
fn in_study<'r>(
    request: &'r ObjectRequest,
    shaken: shaking::Shaken,
    memory: &Memory,
    follow: Option<&Follow>,
    wants_to_stop: &(dyn Fn() -> bool + Sync),
) -> Result<(ObjectResult<'r>, Option<Shown>), Problems> {
    let row = row::row(request, &shaken.study)?;
    let settings = &shaken.study.assessment;
    let subject = Subject::new(&row.item, settings).map_err(|missing| {
        let verb = if missing.len() == 1 { "is" } else { "are" };
        let message = format!("{} {verb} missing", Missing::listed(&missing));
        Problem::new(ProblemKind::Missing, message)
    })?;
    let subject = match request.earthquake {
        // Nothing is drawn for motions that are given.
        Earthquake::Motions { .. } => subject.with_middle_friction(settings),
        _ => subject,
    };
    let unused = unused(&request.object, &subject);
    let member = Member::new(&row.item, subject, settings);
    let go_on = || {
        if wants_to_stop() {
            Err(Problem::stopped().into())
        } else {
            Ok(())
        }
    };
    let worlds = Worlds::new(&shaken.study, go_on)?.remembering(memory);
    if !worlds.has_floor(member.subject.level_ratio) {
        let hint = "name a floor whose motions the study gives, or give the study a building";
        return Err(Problem::value("the study has no motion for this floor", hint).into());
    }
    let at = |scale_ratio: f64, follow| -> Result<(AtScale, Option<Shown>), Problems> {
        let worlds = worlds.at_intensity(scale_ratio);
        let context = Context::new(&shaken.study, worlds, 1, wants_to_stop);
        let AssessedOne {
            found,
            tally,
            shown,
        } = assess_one(&context, &member, follow)?;
        let at = AtScale {
            scale_ratio,
            found,
            tally,
        };
        Ok((at, shown))
    };
    let (at_one, shown) = at(1.0, follow)?;
    let mut scales = Vec::new();
    if let Earthquake::Motions {
        scales: factors, ..
    } = &request.earthquake
    {
        for scale in factors {
            scales.push(at(*scale, None)?.0);
        }
    }
    let result = ObjectResult {
        request,
        study: shaken.study,
        earthquake: shaken.earthquake,
        item: row.item,
        at_one,
        scales,
        study_doubts: shaken.doubts,
        unlikely_sizes: row.unlikely_sizes,
        row_doubts: row.doubts,
        unused,
    };
    Ok((result, shown))
}

/// What the parts of a request contradict; motions and studies are not looked at.
///
/// # Errors
/// All of it, under the keys of the request.
pub fn check(request: &ObjectRequest) -> Result<(), Problems> {
    let Object {
        height_m,
        thickness_m,
        width_m,
        is_round,
        body,
        mass_kg,
        rests_on,
        tolerance,
        surroundings,
        ..
    } = &request.object;
    let mut problems = Problems::default();
    let mut note = |keys: &[&'static str], message: &str, hint: &str| {
        problems.push(Problem::value(message, hint).of(keys));
    };
    if let Some(body) = body {
        if let Some(wall_m) = surroundings.wall_height_m
            && surroundings.has_wall()
            && wall_m < *height_m
        {
            note(
                &["wall_height"],
                &format!(
                    "the wall, {} m high, is lower than the object, {} m: where its upper edge meets the surface of an object on \
                     the points of its hull is not calculated",
                    number(wall_m, 4),
                    number(*height_m, 4)
                ),
                "leave `wall_height` out for a wall that is taller, or leave the wall out, as if the object stood freely; a box is \
                 calculated beside a low wall",
            );
        }
        let on_hull = |what: &str| {
            let shape = body.kind.name();
            format!("an object of this shape ({shape}) is followed on a stiff floor, {what}")
        };
        let others = [
            (
                rests_on.is_some(),
                "on",
                "with nothing under it",
                "leave `on` out",
            ),
            (
                tolerance.is_some(),
                "tolerance",
                "without its shock",
                "leave `tolerance` out",
            ),
            (
                surroundings.upper.is_some(),
                "upper_height",
                "with nothing on it",
                "leave out what stands on it",
            ),
            (
                surroundings.casters.is_some(),
                "casters",
                "without casters",
                "leave `casters` out",
            ),
        ];
        for (is_given, key, what, hint) in others {
            if is_given {
                note(
                    &[key],
                    &on_hull(what),
                    &format!("{hint}, or describe it as a box"),
                );
            }
        }
        if surroundings.wall_restitution.is_some() {
            note(
                &["wall_restitution"],
                "`wall_restitution` has no effect beside an object on the points of its hull",
                "leave it out: the wall has a stiffness and a damping there",
            );
        }
        if surroundings.wall_stiffness_n_m.is_some() && mass_kg.is_none() {
            note(
                &["wall_stiffness", "mass"],
                "`wall_stiffness` needs `mass` beside an object on the points of its hull",
                "add `mass`, or leave it out",
            );
        }
    } else if thickness_m > height_m {
        note(
            &["thickness", "height"],
            "`thickness` is larger than `height`: were they swapped?",
            "`thickness` is the smaller horizontal size; objects that are lower than thick are assessed in a list, \
             with freestand assess",
        );
    }
    if *is_round && width_m.is_some_and(|width_m| width_m != *thickness_m) {
        note(
            &["width"],
            "`width` of a cylinder is its `thickness`, the diameter",
            "leave `width` out",
        );
    }
    // A body has its own sides.
    let has_width = width_m.is_some() || body.is_some();
    surroundings_agree(surroundings, has_width, &mut note);
    if let Some(upper) = &surroundings.upper
        && (mass_kg.is_none() || rests_on.is_none() || upper.mass_kg.is_none())
    {
        note(
            &["mass", "upper_mass", "on"],
            "an object with another one on it needs `mass`, `upper_mass` and `on`: both are calculated on pads",
            "add what is missing, such as `on = \"rubber-foot\"`, or leave out what stands on it",
        );
    }
    if rests_on.is_some() && mass_kg.is_none() {
        note(
            &["on", "mass"],
            "`on` needs `mass`: pads move with the mass on them",
            "add `mass`, or leave `on` out",
        );
    }
    if surroundings.casters == Some(Casters::Free) {
        if tolerance.is_some() && (mass_kg.is_none() || surroundings.wall_stiffness_n_m.is_none()) {
            note(
                &["tolerance", "mass", "wall_stiffness"],
                "`tolerance` of an object on free casters needs `mass` and `wall_stiffness`: its shock is that of its \
                 stop",
                "add what is missing, or leave `tolerance` out: whether it falls needs no tolerance",
            );
        }
    } else if tolerance.is_some() && (mass_kg.is_none() || rests_on.is_none()) {
        note(
            &["tolerance", "mass", "on", "casters"],
            "`tolerance` needs `mass` and `on`: without them no shock can be calculated",
            "add what is missing, such as `on = \"rubber-foot\"`, or leave `tolerance` out: whether it falls needs no \
             tolerance",
        );
    }
    let Floor {
        place,
        storeys,
        storey_height_m,
    } = &request.floor;
    match &request.earthquake {
        Earthquake::Motions { scales, .. } => {
            if *place != FloorPlace::Ground || storeys.is_some() || storey_height_m.is_some() {
                note(
                    &["floor", "level_ratio", "storeys", "storey_height"],
                    "the motions are those of the floor of the object: no floor or building can be named as well",
                    "leave it out, or calculate the motion of a floor with freestand floor",
                );
            }
            if request.worlds.is_some() {
                note(
                    &["worlds"],
                    "`worlds` does not apply to given motions: each motion counts once",
                    "leave it out",
                );
            }
            if let Some(scale) = scales
                .iter()
                .find(|scale| !(**scale > 0.0 && scale.is_finite()))
            {
                note(
                    &["scales"],
                    &format!("`scales` must be above 0, not {scale}"),
                    "give factors such as \"0.5, 1, 2\"",
                );
            }
            if scales.len() > MAX_SCALES {
                note(
                    &["scales"],
                    &format!("`scales` has {} values", scales.len()),
                    &format!("give at most {MAX_SCALES} scales"),
                );
            }
        }
        Earthquake::Study { .. } if storeys.is_some() || storey_height_m.is_some() => {
            note(
                &["storeys", "storey_height"],
                "the study describes the building: `storeys` and `storey_height` do not apply",
                "leave them out, or change [building] of the study",
            );
        }
        Earthquake::Study { .. } => {}
        Earthquake::Place(_) | Earthquake::GroundAcceleration { .. } => {
            if matches!(place, FloorPlace::Name(_)) && storeys.is_none() {
                note(
                    &["floor", "storeys"],
                    "`floor` needs `storeys`: the number of storeys of the building",
                    "add `storeys`, such as 6",
                );
            }
            if *place == FloorPlace::Ground && (storeys.is_some() || storey_height_m.is_some()) {
                note(
                    &["storeys", "storey_height", "floor", "level_ratio"],
                    "`storeys` and `storey_height` describe a building, but no floor of it is named",
                    "add `floor` or `level_ratio`, or leave them out: the object is then on the ground",
                );
            } else if storey_height_m.is_some()
                && storeys.is_none()
                && matches!(place, FloorPlace::Share(_))
            {
                note(
                    &["storey_height", "storeys"],
                    "`storey_height` needs `storeys`",
                    "add the number of storeys",
                );
            }
        }
    }
    if let Earthquake::GroundAcceleration { peak_m_s2, .. } = request.earthquake
        && peak_m_s2 > MAX_PEAK_M_S2
    {
        note(
            &["pga"],
            "`pga` is larger than that of any earthquake",
            "check the unit: 1 g is 9.81 m/s², and 100 gal about 0.1 g",
        );
    }
    if let FloorPlace::Share(ratio) = place
        && !(0.0..=1.0).contains(ratio)
    {
        note(
            &["level_ratio"],
            &format!("`level_ratio` must be from 0 (the ground) to 1 (the roof), not {ratio}"),
            "50 % is 0.5",
        );
    }
    problems.finish(Some(()))
}

/// What was given and changes nothing, because of how an object moves or what is not known of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, VariantArray)]
pub enum Unused {
    /// The clearance of an object that rocks.
    Clearance,
    /// The walls of an object that rolls or slides.
    Walls,
    /// The walls of an object with another one on it.
    WallsOfStack,
    /// The casters of an object with another one on it.
    CastersOfStack,
    /// The friction of free casters.
    Friction,
    /// What is under free casters.
    Pads,
    /// The stiffness of a wall without the mass of the object.
    WallStiffness,
}

fn unused(object: &Object, subject: &Subject) -> Vec<Unused> {
    let around = &object.surroundings;
    let is_free = around.casters == Some(Casters::Free);
    let rolls = is_free && !subject.rocks();
    let has_upper = around.upper.is_some();
    let is_unused = |one: &Unused| match one {
        Unused::Clearance => around.clearance_m.is_some() && subject.rocks(),
        Unused::Walls => around.has_wall() && !subject.rocks(),
        Unused::WallsOfStack => around.has_wall() && has_upper,
        Unused::CastersOfStack => is_free && has_upper,
        Unused::Friction => rolls && object.friction_ratio.is_some(),
        Unused::Pads => rolls && object.rests_on.is_some(),
        Unused::WallStiffness => around.wall_stiffness_n_m.is_some() && object.mass_kg.is_none(),
    };
    let all = Unused::VARIANTS.iter().copied();
    all.filter(is_unused).collect()
}

/// What is said of a wall, a neighbour or casters that the object does not have.
fn surroundings_agree(
    around: &Surroundings,
    has_width: bool,
    note: &mut impl FnMut(&[&'static str], &str, &str),
) {
    let is_free = around.casters == Some(Casters::Free);
    let has_wall = around.has_wall();
    if !has_wall && (around.wall_height_m.is_some() || around.wall_restitution.is_some()) {
        note(
            &[
                "wall_height",
                "wall_restitution",
                "wall_gap",
                "neighbour_gap",
            ],
            "`wall_height` and `wall_restitution` describe a wall, but there is none",
            "add `wall_gap` or `neighbour_gap` (0 where they touch), or leave them out",
        );
    }
    if around.wall_stiffness_n_m.is_some() && !has_wall && !is_free {
        note(
            &["wall_stiffness", "wall_gap", "neighbour_gap", "casters"],
            "`wall_stiffness` describes a wall or the stop of free casters, but there is neither",
            "add `wall_gap`, `neighbour_gap` or `casters = \"free\"`, or leave it out",
        );
    }
    if around.neighbour_gap_m.is_some() && !has_width && !is_free {
        note(
            &["neighbour_gap", "width", "casters"],
            "`neighbour_gap` is measured in the direction of the width, which is not given",
            "add `width`; a wall behind the object is `wall_gap`",
        );
    }
    if around.rolling_resistance_ratio.is_some() && !is_free {
        note(
            &["rolling_resistance", "casters"],
            "`rolling_resistance` is that of free casters",
            "add `casters = \"free\"`, or leave it out",
        );
    }
}
