//! What is said about one object: the sentence, its numbers, and the document.

use freestand::G0_M_S2;
use freestand::rocking::Restitution;
use freestand::wall::DEFAULT_WALL_RESTITUTION_RATIO;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{number, percent_significant};
use freestand_output::facts::{Facts, Value};
use freestand_study::result::Ranked;
use freestand_study::sliding::DEFAULT_ROLLING_RESISTANCE;
use freestand_study::study::Study;

use super::row::Row;
use super::sentence::{Answer, AnswerKind, Counts, ToldFloor, Withstands};
use super::shaking::{Shaken, building_words};
use super::{Earthquake, FloorPlace, ObjectReport, ObjectRequest};
use crate::inventory::{Casters, Surroundings};
use crate::result::{
    Answers, Assessment, FallsAnswer, ObjectModel, Probability, Rolled, SlidingVerdict,
};
use crate::verdict::{Tally, middle};

/// Makes the report; `scales` are the factors with what was found at each.
pub(super) fn report(
    request: &ObjectRequest,
    shaken: &Shaken,
    row: &Row,
    (found, tally): (Assessment, Tally),
    scales: Vec<(f64, (Assessment, Tally))>,
) -> ObjectReport {
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
        earthquake: shaken.told.clone(),
        floor: floor(request, row, &shaken.study),
        counts,
        probability: found.p_overturn,
        withstands,
        units: request.units,
    };
    let mut warnings = shaken.warnings.clone();
    warnings.extend(row.warnings.iter().cloned());
    if tally.failed > 0 {
        let failed = tally.failed;
        warnings.push(format!(
            "{failed} of {} histories failed: they widen the interval",
            tally.worlds
        ));
    }
    warnings.extend(doubts(&found, is_given));
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
    let scales: Vec<Facts> = scales
        .iter()
        .map(|(scale, (found, tally))| at_scale(*scale, found, tally))
        .collect();
    let sentence = answer.sentence();
    let level_ratio = row.item.level_ratio.filter(|_| !is_given);
    let is_above = level_ratio.is_some_and(|ratio| ratio > 0.0);
    let building = building_words(&shaken.study, request.units).filter(|_| is_above);
    let target = shaken.study.ground.code_spectrum();
    let place = target.and_then(|target| target.place);
    let assumptions = assumptions(request, (row, &shaken.study), &found, is_given);
    let facts = Facts::default()
        .key("answer", sentence.clone())
        .key("answer_kind", <&str>::from(answer.kind))
        .fact("earthquake", "earthquake", shaken.words.clone())
        .fact("building", "building", building)
        .and(numbers(
            (&found, &tally),
            withstands,
            shaken.told.noun(),
            request.units,
        ))
        .key("level_ratio", level_ratio)
        .key("place", place)
        .key("scales", (!scales.is_empty()).then(|| scales.clone()))
        .key("decision", found.decision.name())
        .key("why", found.why.clone())
        .key("close_call", found.answers.as_ref().map(Answers::is_close))
        .key(
            "worlds_needed",
            found
                .answers
                .as_ref()
                .and_then(|answers| answers.worlds_needed)
                .map(u64::from),
        )
        .key("is_round", row.item.is_round)
        .key(
            "clearance_needed_m",
            found.rolled.map(|rolled| rolled.clearance_needed_m),
        )
        .key(
            "p_overturn_locked",
            found.braked.map(|braked| braked.overturn.value),
        )
        .key("place_is_assumed", shaken.study.place_is_assumed)
        .key(
            "building_is_assumed",
            shaken.study.building_is_assumed && is_above,
        )
        .key("assumptions", assumptions.clone())
        // One line, however many there are.
        .line("assumed", Some(assumptions.join("; ")));
    ObjectReport {
        answer: sentence,
        kind: answer.kind,
        facts,
        scales,
        warnings,
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
        leaning: leaning(found, tally),
        upper_falls: found.stacked.map(|stacked| stacked.upper_falls),
        rolled: found.rolled,
        slides: found.model == Some(ObjectModel::Slide),
        has_wall: names_wall(around),
        too_mild: found.answers.as_ref().and_then(|answers| answers.too_mild),
    }
}

/// The worlds at whose end it leans on a wall.
fn leaning(found: &Assessment, tally: &Tally) -> u32 {
    found.at_wall.as_ref().map_or(0, |wall| {
        (wall.lean_share * f64::from(tally.worlds)).round() as u32
    })
}

/// The floor as people call it.
fn floor(request: &ObjectRequest, row: &Row, study: &Study) -> ToldFloor {
    let ratio = row.item.level_ratio.unwrap_or(0.0);
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

/// The numbers: those with the names of `objects.csv` are the same.
fn numbers(
    (found, tally): (&Assessment, &Tally),
    withstands: Option<Withstands>,
    noun: &'static str,
    units: UnitSystem,
) -> Facts<'static> {
    let answers = found.answers.as_ref();
    let confidence = answers.map(|answers| answers.confidence);
    let interval = |p: Option<Probability>| {
        let (p, confidence) = p.zip(confidence)?;
        let [value, low, high, sure] =
            [p.value, p.low, p.high, confidence].map(|share| percent_significant(share, 2));
        let low = low.trim_end_matches(" %");
        Some(format!("{value} ({sure} interval: {low} to {high})"))
    };
    let [p_overturn, p_exceed] = [found.p_overturn, found.p_exceed];
    let response = found.response.as_ref();
    let (shock, on_pads) = (found.shock.as_ref(), found.on_pads.as_ref());
    let sliding = found.sliding.as_ref().map(|sliding| sliding.verdict);
    let shares = |name: [&'static str; 3], p: Option<Probability>| {
        Facts::default()
            .key(name[0], p.map(|p| p.value))
            .key(name[1], p.map(|p| p.low))
            .key(name[2], p.map(|p| p.high))
    };
    Facts::default()
        .key("falls", answers.map(|answers| <&str>::from(answers.falls)))
        .key("shock", answers.map(|answers| <&str>::from(answers.shock)))
        .fact("motions", noun, u64::from(tally.worlds))
        .fact(
            "motions_lifted",
            "of them lift an edge",
            u64::from(tally.lifted),
        )
        .fact(
            "motions_overturned",
            "of them overturn it",
            u64::from(tally.overturned),
        )
        .and(shares(
            ["p_overturn", "p_overturn_low", "p_overturn_high"],
            p_overturn,
        ))
        .line("probability that it falls", interval(p_overturn))
        .key("accepted_ratio", found.accepted_ratio)
        .line(
            "accepted probability",
            Some(percent_significant(found.accepted_ratio, 2)),
        )
        .key("accepted_for", found.accepted_for.name())
        .key("confidence", confidence)
        .fact("floor_acceleration_g", "", floor_acceleration(found))
        .and(around(found, tally, units))
        .key("uplift_m_max", tally.uplift_m_max)
        .line(
            "largest uplift without a fall",
            tally.uplift_m_max.map(|most_m| units.distance(most_m, 3)),
        )
        .key(
            "uplift_m_median",
            ranked(response.map(|response| response.uplift_m[1])),
        )
        .key(
            "rotation_ratio_median",
            ranked(response.map(|response| response.rotation_ratio[1])),
        )
        .key(
            "edge_acceleration_g_median",
            ranked(shock.map(|shock| shock.edge_acceleration_g[1])),
        )
        .line(
            "shock, median",
            shock.and_then(|shock| shock_words(shock.edge_acceleration_g[1])),
        )
        .key(
            "edge_acceleration_g_p16",
            ranked(shock.map(|shock| shock.edge_acceleration_g[0])),
        )
        .key(
            "edge_acceleration_g_p84",
            ranked(shock.map(|shock| shock.edge_acceleration_g[2])),
        )
        .key(
            "edge_acceleration_compliant_g_median",
            ranked(on_pads.map(|pads| pads.edge_acceleration_g_median)),
        )
        .key(
            "edge_acceleration_g_max",
            shock.and_then(|shock| shock.edge_acceleration_max_g),
        )
        .key("landing_acceleration_g_max", tally.shock_g_max)
        .line(
            "largest shock without a fall",
            tally
                .shock_g_max
                .and_then(|most_g| shock_words(Ranked::Value(most_g))),
        )
        .key("ceiling_g", shock.map(|shock| shock.ceiling_g))
        .key(
            "pulse_duration_s",
            shock.map(|shock| shock.pulse_duration_s),
        )
        .key(
            "velocity_change_m_s",
            ranked(shock.map(|shock| shock.velocity_change_m_s)),
        )
        .key(
            "pad_uplift_threshold_g",
            on_pads.and_then(|pads| pads.pad_uplift_threshold_g),
        )
        .key(
            "rocking_frequency_hz",
            on_pads.and_then(|pads| pads.rocking_frequency_hz),
        )
        .line("withstands", withstands.map(|one| one.words()))
        .key("tolerance_g", withstands.map(|one| one.peak_g))
        .key(
            "tolerance_duration_s",
            withstands.and_then(|one| one.duration_s),
        )
        .key(
            "demand_capacity_ratio",
            ranked(
                found
                    .capacity
                    .as_ref()
                    .map(|capacity| capacity.demand_capacity),
            ),
        )
        .and(shares(
            ["p_exceed", "p_exceed_low", "p_exceed_high"],
            p_exceed,
        ))
        .line(
            "probability of more than that, or a fall",
            interval(p_exceed),
        )
        .key(
            "models_agree",
            answers.and_then(|answers| answers.models_agree),
        )
        .key("clearance_m", found.clearance_m)
        .key("sliding", sliding.map(SlidingVerdict::name))
        .line(
            "slides",
            sliding
                .filter(|one| found.rolled.is_none() && *one != SlidingVerdict::No)
                .map(|one| one.name().to_owned()),
        )
}

/// The steady floor acceleration that first lifts an edge: of a stack, of the upper body or of both \[g\].
fn lift_g(found: &Assessment, tally: &Tally) -> f64 {
    found.stacked.map_or(tally.lift_g, |stack| {
        stack.threshold_upper_g.min(stack.threshold_together_g)
    })
}

/// Its model, its wall and its casters, with the names of `objects.csv`.
fn around(found: &Assessment, tally: &Tally, units: UnitSystem) -> Facts<'static> {
    let (wall, rolled) = (found.at_wall.as_ref(), found.rolled.as_ref());
    let lift = match found.model {
        // On its pads it may lift earlier, in resonance with the floor.
        Some(ObjectModel::Compliant) => "acceleration that lifts an edge, rigid base",
        _ => "acceleration that lifts an edge",
    };
    let shock_g = wall.and_then(|wall| wall.acceleration_g_median);
    let facts = Facts::default().key("model", found.model.map(ObjectModel::name));
    // Its casters let an object roll before an edge lifts.
    let facts = match rolled {
        Some(_) => facts.key("lift_acceleration_g", lift_g(found, tally)),
        None => facts.fact("lift_acceleration_g", lift, lift_g(found, tally)),
    };
    facts
        .key(
            "motions_leaning",
            wall.map(|_| u64::from(leaning(found, tally))),
        )
        .key("p_lean", wall.map(|wall| wall.lean_share))
        .line(
            "strikes its wall in",
            wall.map(|wall| percent_significant(wall.strike_share, 2)),
        )
        .key("wall_strike_share", wall.map(|wall| wall.strike_share))
        .key(
            "wall_speed_m_s_median",
            wall.map(|wall| wall.speed_m_s_median),
        )
        .line(
            "  speed there, median",
            wall.map(|wall| units.speed(wall.speed_m_s_median, 3)),
        )
        .key("wall_acceleration_g_median", shock_g)
        .line(
            "  shock there, median",
            shock_g.and_then(|shock_g| shock_words(Ranked::Value(shock_g))),
        )
        .key(
            "slide_m_median",
            rolled.map(|rolled| rolled.travel_m_median),
        )
        .key("slide_m_p84", rolled.map(|rolled| rolled.travel_m_p84))
        .line(
            if found.model == Some(ObjectModel::Slide) {
                "slides, median"
            } else {
                "rolls, median"
            },
            rolled.map(|rolled| units.distance(rolled.travel_m_median, 3)),
        )
        .line(
            "  in 84 % up to",
            rolled.map(|rolled| units.distance(rolled.travel_m_p84, 3)),
        )
        .key("stop_share", rolled.map(|rolled| rolled.stop_share))
        .key("trip_speed_m_s", rolled.map(|rolled| rolled.trip_speed_m_s))
        .line(
            "speed at which a stop trips it",
            rolled.map(|rolled| units.speed(rolled.trip_speed_m_s, 4)),
        )
        .key("trip_margin", rolled.and_then(Rolled::trip_margin))
}

/// A number, `overturned`, or nothing.
fn ranked(value: Option<Ranked>) -> Value<'static> {
    match value {
        Some(Ranked::Value(value)) => value.into(),
        Some(Ranked::Overturned) => "overturned".into(),
        Some(Ranked::NoData) | None => Value::Missing,
    }
}

fn shock_words(shock_g: Ranked) -> Option<String> {
    match shock_g {
        Ranked::Value(value) => Some(format!("{} g", number(value, 3))),
        Ranked::Overturned => Some("most of them overturn it".to_owned()),
        Ranked::NoData => None,
    }
}

/// The object under its motions, all multiplied by a scale.
fn at_scale(scale: f64, found: &Assessment, tally: &Tally) -> Facts<'static> {
    Facts::default()
        .key("scale_ratio", scale)
        .key("floor_acceleration_g", floor_acceleration(found))
        .key("motions", u64::from(tally.worlds))
        .key("motions_lifted", u64::from(tally.lifted))
        .key("motions_overturned", u64::from(tally.overturned))
        .key("uplift_m_max", tally.uplift_m_max)
        .key("landing_acceleration_g_max", tally.shock_g_max)
}

fn floor_acceleration(found: &Assessment) -> Facts<'static> {
    let floor = found.floor.as_ref();
    Facts::default()
        .fact(
            "median",
            "floor acceleration, median",
            floor.map(|floor| floor.pfa_g_median),
        )
        .fact(
            "max",
            "floor acceleration, largest",
            floor.map(|floor| floor.pfa_g_max),
        )
}

/// Whether a wall or a neighbour was named.
fn names_wall(around: &Surroundings) -> bool {
    around.wall_gap_m.is_some() || around.neighbour_gap_m.is_some()
}

/// What nobody stated of its feet, its friction, its casters and what is beside it.
fn of_object(
    request: &ObjectRequest,
    (row, study): (&Row, &Study),
    found: &Assessment,
) -> Vec<String> {
    let around = &request.object.surroundings;
    let mut said = vec!["it stands on its full thickness".to_owned()];
    let settings = &study.assessment;
    if row.item.restitution == Restitution::Housner && found.rolled.is_none() {
        said.push("Housner's restitution".to_owned());
    }
    if request.object.friction_ratio.is_none() && found.rolled.is_none() {
        let (low, high) = settings.friction_ratio;
        let is_whole = found.in_space.is_some() || found.stacked.is_some();
        said.push(
            match matches!(request.earthquake, Earthquake::Motions { .. }) {
                true if is_whole => format!(
                    "friction {}, the middle of {low} to {high}",
                    middle(settings.friction_ratio)
                ),
                false if is_whole => format!("friction {low} to {high}, drawn for each earthquake"),
                _ => format!(
                    "friction enough for rocking; {low} to {high} only tells whether it may slide"
                ),
            },
        );
    }
    if found.on_pads.is_some() && row.item.cushion.is_some() {
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
    if !names_wall(around) {
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
            why.words()
        ));
    }
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
    if let Some(unstated) = found.unstated {
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
    (row, study): (&Row, &Study),
    found: &Assessment,
    is_given: bool,
) -> Vec<String> {
    let object = &request.object;
    let around = &object.surroundings;
    let is_free = around.casters == Some(Casters::Free);
    let names_wall = names_wall(around);
    let is_at_wall = found.at_wall.is_some();
    let mut said: Vec<String> = study
        .assumed_at(row.item.level_ratio.unwrap_or(0.0), request.units)
        .collect();
    said.extend(study.two_spectra_words());
    said.push(match (object.cg_height_m, object.width_m) {
        (None, None) => {
            "centre of gravity at half the height; without a width it rocks about one axis only"
                .to_owned()
        }
        (None, Some(_)) => "centre of gravity at half the height".to_owned(),
        (Some(_), None) => "without a width it rocks about one axis only".to_owned(),
        (Some(_), Some(_)) => String::new(),
    });
    said.extend(of_object(request, (row, study), found));
    said.extend(
        row.item
            .cushion_source
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
    } else if is_at_wall && row.item.cushion.is_some() && found.on_pads.is_none() {
        said.push("on a rigid floor: beside a wall its pads are not followed".to_owned());
    } else if found.rolled.is_some() {
        said.push("a level floor that carries it".to_owned());
    } else if matches!(found.model, Some(ObjectModel::Spatial | ObjectModel::Stack)) {
        said.push("on its pads alone".to_owned());
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
