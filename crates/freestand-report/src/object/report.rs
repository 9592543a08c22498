//! What is said about one object: the sentence, its numbers, and the document.

use freestand::G0_M_S2;
use freestand::rocking::Restitution;
use freestand::wall::DEFAULT_WALL_RESTITUTION_RATIO;
use freestand_input::words::{counted, number, percent_significant};
use freestand_output::{answer, answer_of};
use freestand_study::hull::BodyAnswer;
use freestand_study::places::Place;
use freestand_study::result::Ranked;
use freestand_study::sliding::DEFAULT_ROLLING_RESISTANCE;
use freestand_study::study::Study;
use freestand_study::target::Target;

use super::sentence::{Answer, AnswerKind, Counts, ToldFloor, Withstands, noun};
use crate::assessment::reasons::{spectrum_decides, why};
use crate::assessment::words::too_mild;
use crate::doubts::{
    assumed_at, narrow_base, period_from, study_doubts, turned, two_spectra, unlikely_size,
};
use crate::near_fault::near_fault_words;
use freestand_assess::one_object::{
    AtScale, Earthquake, FloorPlace, HULL_FRICTION_RATIO, NamedEarthquake, ObjectRequest,
    ObjectResult, Tally, Unused, middle,
};
use freestand_assess::reason::{Note, Reason};
use freestand_assess::result::{
    Answers, Assessment, FallsAnswer, ObjectModel, Probability, Rolled, SlidingVerdict,
};
use freestand_input::quantity::UnitSystem;
use freestand_inventory::{Casters, Item, Surroundings};

/// The answer about one object.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectReport {
    /// One sentence.
    pub answer: String,
    /// What it says.
    pub kind: AnswerKind,
    /// The object under its motions at each scale.
    pub scales: Vec<Scaled>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// The earthquake in words.
    earthquake: String,
    /// What its motions are called.
    noun: &'static str,
    /// The building in words, of an object above the ground.
    building: Option<String>,
    level_ratio: Option<f64>,
    place: Option<Place>,
    is_round: bool,
    body: Option<BodyAnswer>,
    place_is_assumed: bool,
    building_is_assumed: bool,
    /// What nobody stated.
    assumptions: Vec<String>,
    withstands: Option<Withstands>,
    units: UnitSystem,
    /// Why it has its decision.
    why: String,
    found: Assessment,
    tally: Tally,
}

/// The answer about an object, from what became of it.
pub fn object_report(result: ObjectResult) -> ObjectReport {
    let ObjectResult {
        request,
        study,
        earthquake,
        item,
        at_one: AtScale { found, tally, .. },
        scales,
        study_doubts: of_study,
        unlikely_sizes,
        row_doubts,
        unused,
    } = result;
    let mut warnings = study_doubts(&of_study);
    warnings.extend(unlikely_sizes.iter().map(unlikely_size));
    warnings.extend(row_doubts);
    warnings.extend(unused.into_iter().map(|one| has_no_effect(one).to_owned()));
    let counts = counts(&found, &tally, &request.object.surroundings);
    let withstands = request.object.tolerance.map(|one| Withstands {
        peak_g: one.peak_m_s2 / G0_M_S2,
        duration_s: one.duration_s,
    });
    let is_given = matches!(request.earthquake, Earthquake::Motions { .. });
    let answer = Answer {
        kind: AnswerKind::of(
            &counts,
            found.accepted_ratio,
            found.p_overturn.filter(|_| !is_given),
        ),
        earthquake: earthquake.clone(),
        floor: floor(request, &item, &study),
        counts,
        probability: found.p_overturn,
        withstands,
        units: request.units,
    };
    if tally.failed > 0 {
        let failed = tally.failed;
        warnings.push(format!(
            "{failed} of {} histories failed: they widen the interval",
            tally.worlds
        ));
    }
    warnings.extend(doubts(&found, is_given));
    let body = request.object.body.as_ref();
    let narrow = body.and_then(|body| body.narrow_base());
    warnings.extend(narrow.as_ref().map(narrow_base));
    if !is_given
        && found
            .answers
            .as_ref()
            .is_some_and(|one| one.falls == FallsAnswer::Close && one.too_mild.is_none())
    {
        let accepted = percent_significant(found.accepted_ratio, 2);
        warnings.push(format!(
            "the interval holds the accepted probability, {accepted}: too close to call; an assessment would count it as \
             falling"
        ));
    }
    let decides = found.why.iter().find_map(|reason| match reason {
        Reason::Spectrum(number) => Some(format!("the {}", spectrum_decides(*number))),
        _ => None,
    });
    warnings.extend(decides);
    let level_ratio = item.level_ratio.filter(|_| !is_given);
    let is_above = level_ratio.is_some_and(|ratio| ratio > 0.0);
    let target = study.ground.code_spectrum();
    ObjectReport {
        answer: answer.sentence(),
        kind: answer.kind,
        scales: scales.into_iter().map(Scaled).collect(),
        warnings,
        earthquake: in_full(request, &earthquake, &study),
        noun: noun(&earthquake),
        building: building_words(&study, request.units).filter(|_| is_above),
        level_ratio,
        place: target.and_then(|target| target.place.clone()),
        is_round: item.is_round(),
        body: body.map(|body| body.answer()),
        place_is_assumed: study.place_is_assumed,
        building_is_assumed: study.building_is_assumed && is_above,
        assumptions: assumptions(request, (&item, &study), &found, is_given),
        withstands,
        units: request.units,
        why: why(&item, &found),
        found,
        tally,
    }
}

/// The object under its motions, all multiplied by a scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaled(AtScale);

answer_of!(Scaled as at {
    scale_ratio: f64 = at.0.scale_ratio;
    floor_acceleration_g: OnFloor = OnFloor::of(&at.0.found);
    motions: u64 = at.0.tally.worlds.into();
    motions_lifted: u64 = at.0.tally.lifted.into();
    motions_overturned: u64 = at.0.tally.overturned.into();
    /// Largest uplift without a fall.
    uplift_m_max: Option<f64> = at.0.tally.uplift_m_max;
    /// Largest shock without a fall.
    landing_acceleration_g_max: Option<f64> = at.0.tally.shock_g_max;
});

answer! {
    /// Peak accelerations of the floor over the motions.
    pub struct OnFloor {
        median: Option<f64> = "floor acceleration, median",
        max: Option<f64> = "floor acceleration, largest",
    }
}

impl OnFloor {
    fn of(found: &Assessment) -> Self {
        let floor = found.floor.as_ref();
        Self {
            median: floor.map(|floor| floor.pfa_g_median),
            max: floor.map(|floor| floor.pfa_g_max),
        }
    }
}

impl ObjectReport {
    /// A probability with its interval, for people.
    fn interval(&self, p: Option<Probability>) -> Option<String> {
        let confidence = self.found.answers.as_ref()?.confidence;
        let p = p?;
        let [value, low, high, sure] =
            [p.value, p.low, p.high, confidence].map(|share| percent_significant(share, 2));
        let low = low.trim_end_matches(" %");
        Some(format!("{value} ({sure} interval: {low} to {high})"))
    }

    /// What people call the acceleration that lifts an edge; its casters let an object roll before.
    fn lift_label(&self) -> &'static str {
        match (self.found.rolled, self.found.model) {
            (Some(_), _) => "",
            // On its pads it may lift earlier, in resonance with the floor.
            (None, Some(ObjectModel::Compliant)) => "acceleration that lifts an edge, rigid base",
            (None, _) => "acceleration that lifts an edge",
        }
    }

    fn sliding(&self) -> Option<SlidingVerdict> {
        self.found.sliding.as_ref().map(|sliding| sliding.verdict)
    }

    /// What people call how far it moves.
    fn travel_label(&self) -> &'static str {
        match self.found.model {
            Some(ObjectModel::Slide) => "slides, median",
            _ => "rolls, median",
        }
    }
}

// The numbers with the names of `objects.csv` are the same.
answer_of!(ObjectReport as report {
    /// The answer in one sentence.
    answer: String = report.answer.clone();
    answer_kind: &'static str = report.kind.into();
    earthquake: String = report.earthquake.clone() => "earthquake";
    __: Option<String> = report.place.as_ref().map(Place::provenance) => "hazard from";
    building: Option<String> = report.building.clone() => "building";
    falls: Option<&'static str> = report.found.answers.as_ref().map(|answers| answers.falls.into());
    shock: Option<&'static str> = report.found.answers.as_ref().map(|answers| answers.shock.into());
    motions: u64 = report.tally.worlds.into() => (report.noun);
    motions_lifted: u64 = report.tally.lifted.into() => "of them lift an edge";
    motions_overturned: u64 = report.tally.overturned.into() => "of them overturn it";
    p_overturn: Option<f64> = report.found.p_overturn.map(|p| p.value);
    p_overturn_low: Option<f64> = report.found.p_overturn.map(|p| p.low);
    p_overturn_high: Option<f64> = report.found.p_overturn.map(|p| p.high);
    __: Option<String> = report.interval(report.found.p_overturn) => "probability that it falls";
    accepted_ratio: f64 = report.found.accepted_ratio;
    __: String = percent_significant(report.found.accepted_ratio, 2) => "accepted probability";
    accepted_for: &'static str = report.found.accepted_for.name();
    /// Of the intervals.
    confidence: Option<f64> = report.found.answers.as_ref().map(|answers| answers.confidence);
    floor_acceleration_g: OnFloor = OnFloor::of(&report.found);
    model: Option<&'static str> = report.found.model.map(ObjectModel::name);
    /// The steady floor acceleration that first lifts an edge.
    lift_acceleration_g: f64 = lift_g(&report.found, &report.tally) => (report.lift_label());
    motions_leaning: Option<u64> = report.found.at_wall.as_ref().map(|_| leaning(&report.found).into());
    p_lean: Option<f64> = report.found.at_wall.as_ref().map(|wall| wall.lean_share);
    __: Option<String> = report.found.at_wall.as_ref().map(|wall| percent_significant(wall.strike_share, 2)) => "strikes its wall in";
    wall_strike_share: Option<f64> = report.found.at_wall.as_ref().map(|wall| wall.strike_share);
    wall_speed_m_s_median: Option<f64> = report.found.at_wall.as_ref().map(|wall| wall.speed_m_s_median);
    __: Option<String> = report.found.at_wall.as_ref().map(|wall| report.units.speed(wall.speed_m_s_median, 3)) => "  speed there, median";
    wall_acceleration_g_median: Option<f64> = report.found.at_wall.as_ref().and_then(|wall| wall.acceleration_g_median);
    __: Option<String> = report.found.at_wall.as_ref().and_then(|wall| shock_words(Ranked::Value(wall.acceleration_g_median?))) => "  shock there, median";
    slide_m_median: Option<f64> = report.found.rolled.map(|rolled| rolled.travel_m_median);
    slide_m_p84: Option<f64> = report.found.rolled.map(|rolled| rolled.travel_m_p84);
    __: Option<String> = report.found.rolled.map(|rolled| report.units.distance(rolled.travel_m_median, 3)) => (report.travel_label());
    __: Option<String> = report.found.rolled.map(|rolled| report.units.distance(rolled.travel_m_p84, 3)) => "  in 84 % up to";
    stop_share: Option<f64> = report.found.rolled.map(|rolled| rolled.stop_share);
    trip_speed_m_s: Option<f64> = report.found.rolled.map(|rolled| rolled.trip_speed_m_s);
    __: Option<String> = report.found.rolled.map(|rolled| report.units.speed(rolled.trip_speed_m_s, 4)) => "speed at which a stop trips it";
    trip_margin: Option<f64> = report.found.rolled.as_ref().and_then(Rolled::trip_margin);
    uplift_m_max: Option<f64> = report.tally.uplift_m_max;
    __: Option<String> = report.tally.uplift_m_max.map(|most_m| report.units.distance(most_m, 3)) => "largest uplift without a fall";
    uplift_m_median: Ranked = report.found.response.as_ref().map(|response| response.uplift_m[1]).unwrap_or(Ranked::NoData);
    rotation_ratio_median: Ranked = report.found.response.as_ref().map(|response| response.rotation_ratio[1]).unwrap_or(Ranked::NoData);
    edge_acceleration_g_median: Ranked = report.found.shock.as_ref().map(|shock| shock.edge_acceleration_g[1]).unwrap_or(Ranked::NoData);
    __: Option<String> = report.found.shock.as_ref().and_then(|shock| shock_words(shock.edge_acceleration_g[1])) => "shock, median";
    edge_acceleration_g_p16: Ranked = report.found.shock.as_ref().map(|shock| shock.edge_acceleration_g[0]).unwrap_or(Ranked::NoData);
    edge_acceleration_g_p84: Ranked = report.found.shock.as_ref().map(|shock| shock.edge_acceleration_g[2]).unwrap_or(Ranked::NoData);
    edge_acceleration_compliant_g_median: Ranked = report.found.on_pads.as_ref().map(|pads| pads.edge_acceleration_g_median).unwrap_or(Ranked::NoData);
    edge_acceleration_g_max: Option<f64> = report.found.shock.as_ref().and_then(|shock| shock.edge_acceleration_max_g);
    landing_acceleration_g_max: Option<f64> = report.tally.shock_g_max;
    __: Option<String> = report.tally.shock_g_max.and_then(|most_g| shock_words(Ranked::Value(most_g))) => "largest shock without a fall";
    ceiling_g: Option<f64> = report.found.shock.as_ref().map(|shock| shock.ceiling_g);
    pulse_duration_s: Option<f64> = report.found.shock.as_ref().map(|shock| shock.pulse_duration_s);
    velocity_change_m_s: Ranked = report.found.shock.as_ref().map(|shock| shock.velocity_change_m_s).unwrap_or(Ranked::NoData);
    pad_uplift_threshold_g: Option<f64> = report.found.on_pads.as_ref().and_then(|pads| pads.pad_uplift_threshold_g);
    rocking_frequency_hz: Option<f64> = report.found.on_pads.as_ref().and_then(|pads| pads.rocking_frequency_hz);
    __: Option<String> = report.withstands.map(|one| one.words()) => "withstands";
    tolerance_g: Option<f64> = report.withstands.map(|one| one.peak_g);
    tolerance_duration_s: Option<f64> = report.withstands.and_then(|one| one.duration_s);
    demand_capacity_ratio: Ranked = report.found.capacity.as_ref().map(|capacity| capacity.demand_capacity).unwrap_or(Ranked::NoData);
    p_exceed: Option<f64> = report.found.p_exceed.map(|p| p.value);
    p_exceed_low: Option<f64> = report.found.p_exceed.map(|p| p.low);
    p_exceed_high: Option<f64> = report.found.p_exceed.map(|p| p.high);
    __: Option<String> = report.interval(report.found.p_exceed) => "probability of more than that, or a fall";
    models_agree: Option<bool> = report.found.answers.as_ref().and_then(|answers| answers.models_agree);
    clearance_m: Option<f64> = report.found.clearance_m;
    sliding: Option<&'static str> = report.sliding().map(SlidingVerdict::name);
    __: Option<&'static str> = report.sliding().filter(|one| report.found.rolled.is_none() && *one != SlidingVerdict::No).map(SlidingVerdict::name) => "slides";
    level_ratio: Option<f64> = report.level_ratio;
    place: Option<&Place> = report.place.as_ref();
    /// The object under its motions at each scale.
    scales: Option<Vec<&Scaled>> = (!report.scales.is_empty()).then(|| report.scales.iter().collect());
    decision: &'static str = report.found.decision.name();
    why: String = report.why.clone();
    /// Whether its model is known to say too little: of a body on its hull.
    model_bias: bool = report.found.model == Some(ObjectModel::Hull);
    close_call: Option<bool> = report.found.answers.as_ref().map(Answers::is_close);
    /// Earthquakes that would settle the question.
    worlds_needed: Option<u64> = report.found.answers.as_ref().and_then(|answers| answers.worlds_needed).map(u64::from);
    is_round: bool = report.is_round;
    /// Where its shape is given: the body, and the hill that it must climb to fall.
    body: Option<BodyAnswer> = report.body.clone();
    clearance_needed_m: Option<f64> = report.found.rolled.map(|rolled| rolled.clearance_needed_m);
    /// Room on every side that 50, 84 and 98 % of the earthquakes do not exceed.
    clearance_m_median: Option<f64> = report.found.rolled.map(|rolled| rolled.room_m[0]);
    clearance_m_p84: Option<f64> = report.found.rolled.map(|rolled| rolled.room_m[1]);
    clearance_m_p98: Option<f64> = report.found.rolled.map(|rolled| rolled.room_m[2]);
    p_overturn_locked: Option<f64> = report.found.braked.map(|braked| braked.overturn.value);
    place_is_assumed: bool = report.place_is_assumed;
    building_is_assumed: bool = report.building_is_assumed;
    /// What nobody stated.
    assumptions: Vec<String> = report.assumptions.clone();
    // One line, however many there are.
    __: String = report.assumptions.join("; ") => "assumed";
});

/// The earthquake in full.
fn in_full(request: &ObjectRequest, earthquake: &NamedEarthquake, study: &Study) -> String {
    match (earthquake, &request.earthquake) {
        (NamedEarthquake::GroundAcceleration { peak_g }, _) => format!(
            "a ground acceleration of {} g, with the spectrum of Eurocode 8, type 1, ground B, scaled to it",
            number(*peak_g, 4)
        ),
        (NamedEarthquake::Motions, Earthquake::Motions { motions, .. }) => {
            match motions.as_slice() {
                [one] => format!("the motion {}", one.motion.name),
                several => format!("{} motions of the floor", several.len()),
            }
        }
        (NamedEarthquake::MotionsOfStudy { study, .. }, _) => format!("the motions of {study}"),
        _ => study
            .ground
            .code_spectrum()
            .map_or_else(String::new, Target::one_line),
    }
}

/// What was given and changes nothing.
fn has_no_effect(unused: Unused) -> &'static str {
    match unused {
        Unused::Clearance => {
            "`clearance` has no effect on an object that rocks: for a wall beside it, give `wall_gap`"
        }
        Unused::Walls => {
            "`wall_gap` and `neighbour_gap` have no effect on an object that rolls or slides: the way to what stops it \
             is `clearance`"
        }
        Unused::WallsOfStack => {
            "`wall_gap` and `neighbour_gap` have no effect on an object with another one on it"
        }
        Unused::CastersOfStack => {
            "`casters` have no effect on an object with another one on it: it is calculated as if they were braked"
        }
        Unused::Friction => {
            "`friction` has no effect on free casters: they roll by `rolling_resistance`"
        }
        Unused::Pads => {
            "`on` has no effect on free casters: the object rolls before it lifts from its pads"
        }
        Unused::WallStiffness => {
            "`wall_stiffness` has no effect without `mass`: the shock at a wall needs both"
        }
    }
}

fn counts(found: &Assessment, tally: &Tally, around: &Surroundings) -> Counts {
    Counts {
        motions: tally.worlds,
        lifted: tally.lifted,
        asked: tally.asked,
        overturned: tally.overturned,
        exceeded: tally.exceeded,
        uplift_m_max: tally.uplift_m_max,
        shock_g_max: tally.shock_g_max,
        floor_g_max: found.floor.as_ref().map_or(0.0, |floor| floor.pfa_g_max),
        lift_g: lift_g(found, tally),
        leaning: leaning(found),
        upper_falls: found.stacked.map(|stacked| stacked.upper_falls),
        rolled: found.rolled,
        slides: found.model == Some(ObjectModel::Slide),
        has_wall: around.has_wall(),
        too_mild: found.answers.as_ref().and_then(|answers| answers.too_mild),
    }
}

/// The worlds at whose end it leans on a wall.
fn leaning(found: &Assessment) -> u32 {
    let leans = |reason: &Reason| match reason {
        Reason::Leans { worlds, .. } => Some(*worlds),
        _ => None,
    };
    found.why.iter().find_map(leans).unwrap_or(0)
}

/// The floor as people call it.
fn floor(request: &ObjectRequest, item: &Item, study: &Study) -> ToldFloor {
    let ratio = item.level_ratio.unwrap_or(0.0);
    let roof = |other| if ratio >= 1.0 { ToldFloor::Roof } else { other };
    match &request.floor.place {
        FloorPlace::Ground => ToldFloor::Ground,
        FloorPlace::Share(_) if ratio <= 0.0 => ToldFloor::Ground,
        FloorPlace::Share(ratio) => roof(ToldFloor::Share(*ratio)),
        FloorPlace::Name(name) => {
            let is_named = study
                .floors
                .iter()
                .any(|floor| floor.names.iter().any(|one| one == name));
            let storeys = study
                .building
                .as_ref()
                .map_or(0, |building| building.storeys);
            let number = ratio * storeys as f64;
            let is_whole = storeys > 0 && (number - number.round()).abs() < 1e-9;
            let has_number = name.chars().any(|c| c.is_ascii_digit());
            if is_named || !is_whole {
                ToldFloor::Name(name.clone())
            } else if ratio <= 0.0 {
                ToldFloor::Ground
            } else if ratio >= 1.0 && !has_number {
                ToldFloor::Roof
            } else {
                ToldFloor::Number {
                    floor: number.round() as u32,
                    storeys,
                }
            }
        }
    }
}

/// The steady floor acceleration that first lifts an edge: of a stack, of the upper body or of both \[g\].
fn lift_g(found: &Assessment, tally: &Tally) -> f64 {
    found.stacked.map_or(tally.lift_g, |stack| {
        stack.threshold_upper_g.min(stack.threshold_together_g)
    })
}

fn shock_words(shock_g: Ranked) -> Option<String> {
    match shock_g {
        Ranked::Value(value) => Some(format!("{} g", number(value, 3))),
        Ranked::Overturned => Some("most of them overturn it".to_owned()),
        Ranked::NoData => None,
    }
}

/// What nobody stated of its feet, its friction, its casters and what is beside it.
fn of_object(
    request: &ObjectRequest,
    (item, study): (&Item, &Study),
    found: &Assessment,
) -> Vec<String> {
    let around = &request.object.surroundings;
    let mut said = Vec::new();
    if request.object.body.is_none() {
        said.push("it stands on its full thickness".to_owned());
    }
    let settings = &study.assessment;
    let is_on_hull = found.model == Some(ObjectModel::Hull);
    if item.restitution == Restitution::Housner && found.rolled.is_none() && !is_on_hull {
        said.push("Housner's restitution".to_owned());
    }
    if request.object.friction_ratio.is_none() && found.rolled.is_none() {
        let friction_ratio = match is_on_hull {
            true => HULL_FRICTION_RATIO,
            false => settings.friction_ratio,
        };
        let (low, high) = friction_ratio;
        let is_whole = found.in_space.is_some() || found.stacked.is_some() || is_on_hull;
        said.push(
            match matches!(request.earthquake, Earthquake::Motions { .. }) {
                true if is_whole => format!(
                    "friction {}, the middle of {low} to {high}",
                    number(middle(friction_ratio), 3)
                ),
                false if is_whole => format!("friction {low} to {high}, drawn for each earthquake"),
                _ => format!(
                    "friction enough for rocking; {low} to {high} only tells whether it may slide"
                ),
            },
        );
    }
    if found.on_pads.is_some() && item.cushion.is_some() {
        let [low, high] = [settings.pad_damping_ratio.0, settings.pad_damping_ratio.1]
            .map(|d| percent_significant(d, 2));
        said.push(if low == high {
            format!("pads with {low} of critical damping")
        } else {
            format!("pads with {low} to {high} of critical damping")
        });
    }
    if around.casters.is_none() {
        said.push("no casters".to_owned());
    }
    if !around.has_wall() {
        said.push("nothing beside it".to_owned());
    }
    said
}

/// What keeps the answer from being relied on.
fn doubts(found: &Assessment, is_given: bool) -> Vec<String> {
    let mut said = Vec::new();
    let Some(answers) = &found.answers else {
        return said;
    };
    if let Some(why) = answers.too_mild {
        said.push(format!(
            "it is {}: the real object may fall where the calculated one stands",
            too_mild(why)
        ));
    }
    said.extend(found.notes.iter().filter_map(|note| match note {
        Note::TipsAtRest { worlds, of } => Some(format!(
            "in {worlds} of {of} histories it does not stand even before the floor moves, on the base that was drawn within the \
             error of its scan: they count as falls; a measured base, or a more accurate scan with its `scan_error`, gives a better answer"
        )),
        _ => None,
    }));
    // Where it falls, no number of earthquakes would show that it stays.
    let is_open = !is_given && answers.falls != FallsAnswer::Falls;
    if let Some(needed) = answers.worlds_needed.filter(|_| is_open) {
        let accepted = percent_significant(found.accepted_ratio, 2);
        said.push(format!(
            "{} simulated earthquakes cannot show that it stays, even if it falls in none: at an accepted {accepted} at \
             least {needed} are needed; give `worlds = {needed}` or more",
            answers.worlds_cap
        ));
    }
    let unstated = found.why.iter().find_map(|reason| match reason {
        Reason::Unstated(unstated) => Some(*unstated),
        _ => None,
    });
    if let Some(unstated) = unstated {
        said.push(format!(
            "nobody stated {}: this is the answer for another one",
            unstated.words()
        ));
    }
    said
}

/// What nobody stated, in sentences.
fn assumptions(
    request: &ObjectRequest,
    (item, study): (&Item, &Study),
    found: &Assessment,
    is_given: bool,
) -> Vec<String> {
    let object = &request.object;
    let around = &object.surroundings;
    let is_free = around.casters == Some(Casters::Free);
    let names_wall = around.has_wall();
    let is_at_wall = found.at_wall.is_some();
    let mut said: Vec<String> =
        assumed_at(study, item.level_ratio.unwrap_or(0.0), request.units).collect();
    said.extend(two_spectra(study));
    said.extend(near_fault_words(study));
    let is_on_hull = found.model == Some(ObjectModel::Hull);
    said.push(match (object.cg_height_m, object.width_m) {
        (None, _) if is_on_hull => "centre of gravity at half the height".to_owned(),
        (Some(_), _) if is_on_hull => String::new(),
        (None, None) => {
            "centre of gravity at half the height; without a width it rocks about one axis only"
                .to_owned()
        }
        (None, Some(_)) => "centre of gravity at half the height".to_owned(),
        (Some(_), None) => "without a width it rocks about one axis only".to_owned(),
        (Some(_), Some(_)) => String::new(),
    });
    said.extend(of_object(request, (item, study), found));
    said.extend(
        item.cushion_source
            .as_ref()
            .map(|source| format!("under one edge: {source}")),
    );
    if is_free && found.rolled.is_none() {
        said.push("its casters resist so much that it rocks before it rolls".to_owned());
    } else if is_free {
        if around.rolling_resistance_ratio.is_none() {
            said.push(format!(
                "a rolling resistance of {DEFAULT_ROLLING_RESISTANCE} of its weight"
            ));
        }
    } else if is_at_wall && item.cushion.is_some() && found.on_pads.is_none() {
        said.push("on a rigid floor: beside a wall its pads are not followed".to_owned());
    } else if found.rolled.is_some() {
        said.push("a level floor that carries it".to_owned());
    } else if matches!(found.model, Some(ObjectModel::Spatial | ObjectModel::Stack)) {
        said.push("on its pads alone".to_owned());
    } else if is_on_hull {
        said.push(
            "in three dimensions on a stiff floor, turned in any direction, with a model that underestimated overturning \
             in tests of two rocks: the upper end of the probability is 8 % or more; no shock is calculated"
                .to_owned(),
        );
        let body = object.body.as_ref();
        said.extend(body.and_then(|body| body.turned_rad()).map(turned));
    } else if object.rests_on.is_none() || object.mass_kg.is_none() {
        said.push("a rigid floor: without mass and pads no shock is calculated".to_owned());
    } else {
        said.push("on a rigid floor and on its pads: the worse of the two counts".to_owned());
    }
    match found.model {
        _ if !names_wall || is_at_wall => {}
        Some(ObjectModel::Roll | ObjectModel::Slide) => {
            said.push(
                "no wall: what it would do at what stands beside it is not calculated".to_owned(),
            );
        }
        Some(ObjectModel::Stack) => said.push("no wall: stacks are followed without".to_owned()),
        Some(ObjectModel::Spatial) => {}
        _ => said.push("no wall: what is named is farther away than the object reaches".to_owned()),
    }
    if is_at_wall && is_given {
        let restitution = match around.wall_restitution {
            _ if found.model == Some(ObjectModel::Hull) => String::new(),
            None => format!("; a restitution of {DEFAULT_WALL_RESTITUTION_RATIO} there"),
            Some(_) => String::new(),
        };
        said.push(format!(
            "the side of its wall is drawn for each motion{restitution}"
        ));
    }
    if is_given {
        said.push("the object as given, without uncertainty; every motion counts once".to_owned());
    }
    said.retain(|one| !one.is_empty());
    said
}

/// The building in words: `30 storeys of 3.2 m, T₁ = 1.92 s (…)`.
fn building_words(study: &Study, units: UnitSystem) -> Option<String> {
    let building = study.building.as_ref()?;
    let storey = building
        .storey_height_m
        .map_or_else(String::new, |height_m| {
            format!(" of {}", units.storey(height_m))
        });
    Some(format!(
        "{}{storey}, first period {} s by {}",
        counted(building.storeys, "storey"),
        number(building.along.period_s(), 3),
        period_from(&building.period_from)
    ))
}
