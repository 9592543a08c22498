//! Why an object has its decision, and what there is to know besides, in sentences.

use freestand::decision::{Interval, Side};
use freestand_assess::reason::{Flat, Missing, NoPad, Note, Reason, Slips, WithoutPads};
use freestand_assess::result::{
    Answers, Assessment, BeforeWall, Braked, Criterion, FallsAnswer, FewMotions, ModelAnswers,
    ObjectModel, PadOutcome, Probability, Ranked, Rolled, ShockAnswer, Softening, Stacked, TooMild,
};
use freestand_assess::verdict::deciding;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{counted, listed, number, percent_words as percent, significant};
use freestand_inventory::{Casters, Item, ItemShape, Surroundings};
use freestand_study::study::Unstated;

use super::compared::reach;
use super::words::too_mild;
use crate::doubts::cushion_notes;

/// P(it falls) with friction over that without it, at a friction of 0.3 and of 0.5: by an audit of one
/// object (1.95 m × 0.42 m) on a spectrum of EN 1998-1, ground C, 100 motions, in three dimensions.
const FALLS_WITH_FRICTION: [(f64, f64); 2] = [(0.3, 0.8), (0.5, 1.05)];

/// Why an object has its decision.
pub fn why(item: &Item, found: &Assessment) -> String {
    joined(found.why.iter().map(|reason| sentence(reason, item, found)))
}

/// How the row was read, what was assumed where it is silent, and what there is to know of the result.
pub fn notes(item: &Item, found: &Assessment) -> String {
    let of_found = found.notes.iter().map(|note| of_note(note, found));
    joined(of_item(item).into_iter().chain(of_found))
}

fn joined(sentences: impl Iterator<Item = String>) -> String {
    let all: Vec<String> = sentences.filter(|one| !one.is_empty()).collect();
    all.join(" ")
}

fn were_not_given(missing: &[Missing]) -> String {
    let verb = if missing.len() == 1 { "was" } else { "were" };
    format!("{} {verb} not given", Missing::listed(missing))
}

fn sentence(reason: &Reason, item: &Item, found: &Assessment) -> String {
    match reason {
        Reason::Anchored => "Reported as anchored; its anchors were not checked.".to_owned(),
        Reason::NoMotion => {
            "Nothing was assessed, because the study has no motion for this floor.".to_owned()
        }
        Reason::NotGiven(missing) => format!(
            "Nothing was assessed, because {}.",
            were_not_given(missing)
        ),
        Reason::Travels => found.rolled.map_or_else(String::new, |rolled| {
            travels(found, &rolled, item.surroundings.has_wall())
        }),
        Reason::Falling { lifts } => of_answers(found, |answers| falling(found, answers, *lifts)),
        Reason::OnlyFalling { lacks_tolerance } => {
            let why = match lacks_tolerance {
                true => "no tolerance was given",
                false => "nothing else was asked",
            };
            format!("Only falling was assessed: {why}.")
        }
        Reason::ShockUnknown(missing) => format!(
            "Whether a shock damages it is unknown, because {}.",
            were_not_given(missing)
        ),
        Reason::Shock(governing) => of_answers(found, |answers| shock(found, answers, *governing)),
        Reason::Unchecked => format!(
            "But this tolerance was not checked against its source and cannot decide: confirm it. Its source: {}.",
            item.tolerance.as_ref().map_or("", |tolerance| &tolerance.source)
        ),
        Reason::SofterPad => found
            .softening
            .as_ref()
            .map_or_else(String::new, |pad| match pad.admissible() {
                true => softer_pad(pad, found.accepted_ratio),
                false => format!(
                    "No softer pad is enough: {}",
                    softer_pad(pad, found.accepted_ratio)
                ),
            }),
        Reason::FloorTooStrong => {
            "Neither a pad nor a restraint lowers the acceleration of the floor: restrain it, and move it to a lower \
             floor or isolate it."
                .to_owned()
        }
        Reason::NoPadHelps(why) => format!("No softer pad helps: {}.", no_pad(*why)),
        Reason::StiffnessIsRange => {
            "Its stiffness is a range from the cushion library, not a measurement.".to_owned()
        }
        Reason::Leans { worlds, followed } => format!(
            "It ends leaning on its wall in {worlds} of {}, which count as falls.",
            counted(*followed as usize, "world")
        ),
        Reason::PadsNotFollowed => {
            "Beside a wall its pads are not followed: the rigid base alone answers.".to_owned()
        }
        Reason::NoRoom { room_m } => found
            .rolled
            .zip(found.braked)
            .map_or_else(String::new, |(rolled, braked)| {
                no_room(found, *room_m, &rolled, &braked)
            }),
        Reason::Unstated(unstated) => unstated_words(*unstated),
        Reason::Slips(slips) => format!(
            "{}: there it slides as well, and its pads answer for both models.",
            too_little_friction(slips)
        ),
        Reason::InSpace => in_space(found),
        Reason::Stacked => found.stacked.map_or_else(String::new, |stack| {
            stacked(&stack) + &left_out(&item.surroundings)
        }),
        Reason::BeyondCode { overturned, worlds } => {
            let design = found
                .design_force()
                .map_or(0.0, |force| 1e-3 * force.force_n);
            let verb = if *overturned == 1 { "overturns" } else { "overturn" };
            format!(
                "The code's force alone would not lift it, but {overturned} of {} {verb} it: design for {} kN.",
                counted(*worlds as usize, "simulated earthquake"),
                significant(design, 2)
            )
        }
        Reason::BeforeWall => found.before_wall.map_or_else(String::new, |before| {
            before_wall(&before, found.accepted_ratio)
        }),
        Reason::Spectrum(number) => format!("The {}.", spectrum_decides(*number)),
        Reason::Stopped { worlds: 0 } => {
            "The run was stopped before its first world: continue it.".to_owned()
        }
        Reason::Stopped { worlds } => format!(
            "The run was stopped after {}, before its verdict: continue it.",
            counted(*worlds as usize, "world")
        ),
    }
}

/// That a spectrum of a national annex decides, after an article.
pub fn spectrum_decides(number: u8) -> String {
    format!(
        "spectrum of type {number} of the national annex decides: it is the worse for this object"
    )
}

fn of_answers(found: &Assessment, words: impl FnOnce(&Answers) -> String) -> String {
    found.answers.as_ref().map_or_else(String::new, words)
}

/// `8 % (6 to 11 %)`.
pub(super) fn spread(p: Probability) -> String {
    format!(
        "{} ({} to {})",
        percent(p.value),
        percent(p.low).replace(" %", ""),
        percent(p.high)
    )
}

/// Whether it falls.
fn falling(found: &Assessment, answers: &Answers, lifts: bool) -> String {
    let (worlds, limit) = (
        counted(answers.worlds as usize, "world"),
        percent(found.accepted_ratio),
    );
    let Some(p) = deciding(answers, |model| Some(model.overturn)) else {
        return String::new();
    };
    let models = both_words(answers, |model| Some(model.overturn), found.accepted_ratio);
    let hits = (p.value * f64::from(answers.worlds)).round();
    if let Some(why) = answers.too_mild {
        return mild(why, found, answers, p);
    }
    match answers.falls {
        FallsAnswer::Stays if !lifts => {
            format!("It stays standing: it rocks in none of {worlds} (accepted {limit}).")
        }
        // Whoever accepts that most fall is not told that it stands.
        FallsAnswer::Stays if p.value > 0.5 => {
            format!(
                "It falls in {} of {worlds}, and {limit} is accepted.{models}",
                spread(p)
            )
        }
        FallsAnswer::Stays => {
            let high = percent(p.high);
            format!(
                "It stays standing: at most {high} fall ({hits} of {worlds}; accepted {limit}).{models}"
            )
        }
        FallsAnswer::Falls => {
            format!(
                "It falls in {} of {worlds}, more than the accepted {limit}.{models}",
                spread(p)
            )
        }
        FallsAnswer::Open => {
            format!(
                "It falls in {} of {worlds} so far (accepted {limit}).{models}",
                spread(p)
            )
        }
        FallsAnswer::Close => {
            let few = answers
                .few_motions
                .as_ref()
                .map_or_else(String::new, few_words);
            let few = answers
                .worlds_needed
                .map_or(few, |needed| few_worlds(answers.worlds_cap, needed));
            format!(
                "It falls in {} of {worlds} against the accepted {limit}: too close to call.{few}{models}",
                spread(p)
            )
        }
    }
}

/// What is known of an object that may fall where its calculation lets it stand.
fn mild(why: TooMild, found: &Assessment, answers: &Answers, p: Probability) -> String {
    let (worlds, limit) = (
        counted(answers.worlds as usize, "world"),
        percent(found.accepted_ratio),
    );
    let (is, chance) = (too_mild(why), spread(p));
    if answers.falls == FallsAnswer::Falls {
        return format!(
            "It is {is}. In that calculation it falls in {chance} of {worlds}, more than the accepted {limit}; the \
             real object may fall more often still."
        );
    }
    format!(
        "It is {is}. In that calculation it falls in {chance} of {worlds} (accepted {limit}), and the real object may \
         fall more often: too close to call."
    )
}

/// How many worlds would do, where the study allows fewer.
fn few_worlds(most: u32, needed: u32) -> String {
    format!(
        " {} are too few to leave it as it is, even if it falls in none: give most = {needed} or more in [worlds].",
        counted(most as usize, "world")
    )
}

/// How many motions would do, where there are too few for `leave`.
fn few_words(few: &FewMotions) -> String {
    let motions = counted(few.motions as usize, "motion");
    let verb = if few.motions == 1 { "is" } else { "are" };
    match few.needed {
        Some(needed) => format!(
            " {motions} {verb} too few to leave it as it is, even if none overturns it: at least {needed} would do."
        ),
        None => format!(" {motions} {verb} too few to leave it as it is: use synthetic motions."),
    }
}

/// Both models, where they disagree.
fn both_words(
    answers: &Answers,
    of: impl Fn(&ModelAnswers) -> Option<Probability>,
    accepted_ratio: f64,
) -> String {
    let (Some(rigid), Some(pads)) = (
        answers.rigid.as_ref().and_then(&of),
        answers.compliant.as_ref().and_then(&of),
    ) else {
        return String::new();
    };
    if (rigid.value > accepted_ratio) == (pads.value > accepted_ratio) {
        return String::new();
    }
    format!(
        " On a rigid base it is {}, on its pads {}: the models disagree, and the worse counts.",
        percent(rigid.value),
        percent(pads.value)
    )
}

/// Whether its tolerance is exceeded.
fn shock(found: &Assessment, answers: &Answers, governing: Option<Criterion>) -> String {
    let limit = percent(found.accepted_ratio);
    let Some(p) = deciding(answers, |model| model.exceed) else {
        return String::new();
    };
    let what = governing_words(governing);
    let models = both_words(answers, |model| model.exceed, found.accepted_ratio);
    match answers.shock {
        ShockAnswer::Stands => {
            format!(
                "{what} in at most {} of the worlds (accepted {limit}).{models}",
                percent(p.high)
            )
        }
        ShockAnswer::Exceeded => {
            format!(
                "{what} in {} of the worlds, more than the accepted {limit}.{models}",
                spread(p)
            )
        }
        ShockAnswer::Close => {
            format!(
                "{what} in {} of the worlds against the accepted {limit}: too close to call.{models}",
                spread(p)
            )
        }
        ShockAnswer::Open => {
            format!(
                "{what} in {} of the worlds so far (accepted {limit}).{models}",
                spread(p)
            )
        }
        ShockAnswer::Unknown => String::new(),
    }
}

fn governing_words(governing: Option<Criterion>) -> &'static str {
    match governing {
        Some(Criterion::Peak) => "Its shock exceeds the peak that it withstands",
        Some(Criterion::Spectrum) => "The spectrum of its shock exceeds that of its tolerance",
        Some(Criterion::DamageBoundary) => "Its shock exceeds its damage boundary",
        Some(Criterion::VelocityChange) => "Its velocity change exceeds its tolerance",
        Some(Criterion::EdgeLift) => "Its uplift exceeds its tolerance",
        Some(Criterion::FloorAcceleration) => "The acceleration of its floor exceeds its tolerance",
        Some(Criterion::Overturning) => "It falls or exceeds its tolerance",
        None => "It exceeds its tolerance",
    }
}

/// What a softer pad comes to.
pub(super) fn softer_pad(pad: &Softening, accepted_ratio: f64) -> String {
    let milli = |value: Option<f64>| number(1e3 * value.unwrap_or_default(), 3);
    let stiffness = format!(
        "{} N/mm",
        number(1e-3 * pad.max_stiffness_n_m.unwrap_or_default(), 3)
    );
    let assumed = if pad.is_assumed {
        " (assumed thickness)"
    } else {
        ""
    };
    let pressed = format!(
        "it is compressed by {} mm of {} mm{assumed}",
        milli(pad.stroke_m),
        milli(Some(pad.pad_thickness_m))
    );
    let [exceed, overturn] =
        [pad.p_exceed_high, pad.p_overturn_high].map(|p| percent(p.unwrap_or_default()));
    match pad.outcome {
        PadOutcome::Enough => format!(
            "A pad of at most {stiffness} under one edge brings it to at most {exceed}; {pressed}."
        ),
        PadOutcome::Pressed(most_ratio) => format!(
            "with {stiffness} under one edge {pressed} in 95 % of the worlds, more than {}.",
            percent(most_ratio)
        ),
        PadOutcome::Falls => {
            format!("with {stiffness} under one edge it falls in up to {overturn} of the worlds.")
        }
        PadOutcome::Exceeded { is_close } => {
            let close = if is_close { ": too close to call" } else { "" };
            format!(
                "with {stiffness} under one edge its tolerance is still exceeded in up to {exceed} of the worlds, against the \
                 accepted {}{close}.",
                percent(accepted_ratio)
            )
        }
    }
}

/// Why no softer pad helps.
fn no_pad(why: NoPad) -> &'static str {
    match why {
        NoPad::Rolls => "it rolls on its casters",
        NoPad::Slides => "it slides on its base",
        NoPad::NoPads => "its pads were not given",
        NoPad::Uplift => "its uplift on a rigid base does not depend on the stiffness",
        NoPad::NoSpring => "its cushion is not a spring",
        NoPad::Other => "what exceeds its tolerance does not depend on the pad",
    }
}

/// How far it rolls or slides, and what a stop does.
fn travels(found: &Assessment, rolled: &Rolled, has_wall: bool) -> String {
    let verb = match found.model {
        Some(ObjectModel::Slide) => "slides",
        _ => "rolls",
    };
    let travel = format!(
        "It {verb}: up to {} in 84 % of worlds, farther in the rest",
        reach(rolled, UnitSystem::Si)
    );
    let Some(clearance_m) = rolled.clearance_m else {
        if has_wall {
            return format!(
                "{travel}; it may run into what stands beside it, which is not calculated."
            );
        }
        return format!(
            "{travel}; nothing in the list stops it, and nothing overturns it without a stop."
        );
    };
    let trip = number(rolled.trip_speed_m_s, 3);
    let speed = rolled
        .stop_speed_m_s_p84
        .map_or_else(String::new, |speed_m_s| {
            format!(" (up to {} m/s there in 84 %)", number(speed_m_s, 3))
        });
    format!(
        "{travel}. It reaches its clearance of {} mm in {} of them{speed}; a stop there overturns it from {trip} m/s.",
        number(1e3 * clearance_m, 6),
        percent(rolled.stop_share)
    )
}

/// What becomes of an object that goes farther than it has room, locked.
fn no_room(found: &Assessment, room_m: Option<f64>, rolled: &Rolled, braked: &Braked) -> String {
    let slides = found.model == Some(ObjectModel::Slide);
    let locked = if slides {
        "Held in its place"
    } else {
        "Locked"
    };
    let needed_mm = number((1e3 * rolled.clearance_needed_m).ceil(), 6);
    let has = match rolled.clearance_m {
        Some(clearance_m) => format!("Its clearance is {} mm", number(1e3 * clearance_m, 6)),
        None if slides => {
            let room_mm = room_m.map_or_else(String::new, |room_m| number(1e3 * room_m, 3));
            format!("It slides farther than {room_mm} mm, the list gives no clearance")
        }
        None => "The list gives no clearance".to_owned(),
    };
    let room = format!("{has}, and it needs at least {needed_mm} mm on every side");
    let worlds = counted(braked.worlds as usize, "world");
    if braked.stands {
        let high = percent(braked.overturn.high);
        return format!("{room}. {locked}, at most {high} fall ({worlds}).");
    }
    let p = braked.overturn;
    let fate = if p.high < found.accepted_ratio {
        "its landings are too hard for it".to_owned()
    } else {
        let [value, low, high] = [p.value, p.low, p.high].map(percent);
        format!(
            "it falls in {value} ({} to {high}) of {worlds}",
            low.trim_end_matches(" %")
        )
    };
    format!(
        "{room}. Locking it is no remedy: {}, {fate}.",
        locked.to_lowercase()
    )
}

/// Why an object is not left as it is in shaking that nobody stated.
fn unstated_words(unstated: Unstated) -> String {
    format!(
        "But nobody stated {}: this is the answer for another one, and no verdict. Give {}.",
        unstated.words(),
        unstated.keys()
    )
}

/// Why the friction does not suffice.
fn too_little_friction(slips: &Slips) -> String {
    let (low, high) = slips.friction_ratio;
    let range = if low == high {
        number(low, 3)
    } else {
        format!("{} to {}", number(low, 3), number(high, 3))
    };
    format!(
        "In {} of {} its friction ({range}) is less than rocking needs",
        slips.worlds,
        counted(slips.of as usize, "world")
    )
}

/// How far it tilts and walks.
fn in_space(found: &Assessment) -> String {
    let Some(in_space) = found.in_space else {
        return String::new();
    };
    match (in_space.tilt_rad_p84, in_space.walk_m_p84) {
        (Ranked::Value(tilt_rad), Ranked::Value(walk_m)) => format!(
            "In three dimensions it tilts up to {}° and its base walks up to {} mm in 84 % of the worlds.",
            number(tilt_rad.to_degrees(), 2),
            number((1e3 * walk_m).ceil(), 6)
        ),
        _ => "In three dimensions it falls in more than 16 % of the worlds.".to_owned(),
    }
}

/// Which body of a stack falls, and which begins to rock.
fn stacked(stacked: &Stacked) -> String {
    let falls = format!(
        "The object itself falls first in {} of {}, what stands on it in {}.",
        stacked.lower_falls,
        counted(stacked.worlds as usize, "world"),
        stacked.upper_falls
    );
    let [alone, together] =
        [stacked.threshold_upper_g, stacked.threshold_together_g].map(|g| number(g, 3));
    let begins = if stacked.threshold_upper_g < stacked.threshold_together_g {
        format!(
            " What stands on it begins to rock alone at {alone} g, both together at {together} g."
        )
    } else {
        format!(
            " Both begin to rock together at {together} g, what stands on it alone at {alone} g."
        )
    };
    falls + &begins
}

/// What is around a stack and does not count.
fn left_out(around: &Surroundings) -> String {
    let left_out = [
        (around.wall_gap_m.is_some(), "wall"),
        (around.neighbour_gap_m.is_some(), "neighbours"),
        (around.casters == Some(Casters::Free), "casters"),
    ];
    let named: Vec<&str> = left_out
        .into_iter()
        .filter_map(|(is_there, name)| is_there.then_some(name))
        .collect();
    match named[..] {
        [] => String::new(),
        ["wall"] => " Its wall does not count.".to_owned(),
        _ => format!(" Its {} do not count.", listed(&named)),
    }
}

fn side(p: Probability, accepted_ratio: f64) -> Side {
    Interval {
        low: p.low,
        high: p.high,
    }
    .side(accepted_ratio)
}

/// What a wall would change, in a sentence.
fn before_wall(before: &BeforeWall, accepted_ratio: f64) -> String {
    let sides = [before.touching, before.at_50_mm].map(|p| side(p, accepted_ratio));
    let enough = match sides {
        [Side::Below, Side::Below] => ", and it would stand at either",
        [Side::Below, _] => ", and touching it, it would stand",
        [_, Side::Below] => ", and with that gap it would stand",
        [Side::Above, Side::Above] => ", and it would stand at neither",
        _ => "",
    };
    format!(
        "The list gives no wall behind it: at a wall that it touches it falls in {} of the worlds, at one 50 mm away in \
         {} (on a rigid base){enough}.",
        percent(before.touching.value),
        percent(before.at_50_mm.value)
    )
}

/// How the row was read, and what was assumed where it is silent.
fn of_item(item: &Item) -> Vec<String> {
    let mut notes: Vec<String> = item
        .cushion
        .iter()
        .flat_map(|edge| cushion_notes(&edge.notes))
        .collect();
    notes.extend(
        item.cushion_source
            .iter()
            .map(|source| format!("Cushion: {source}.")),
    );
    notes.extend(
        item.doubts
            .iter()
            .map(|doubt| format!("Check the input: {} ({}).", doubt.words(), doubt.name())),
    );
    if item.surroundings.upper.is_some() {
        let note = match item.surroundings.casters {
            Some(Casters::Free) => {
                "Another object stands on it: both are followed on pads, as if its casters were held, which is the harder case."
            }
            _ => {
                "Another object stands on it: both are followed on pads, which needs both masses and the cushion."
            }
        };
        notes.push(note.to_owned());
    }
    if item.width_m.is_none() && !matches!(item.shape, ItemShape::Body(_)) {
        notes.push("No width is given, so rocking was computed about one axis only.".to_owned());
    }
    notes
}

fn of_note(note: &Note, found: &Assessment) -> String {
    match note {
        Note::WallShockUnknown => {
            "The shock at its wall is not compared with its tolerance: give wall_stiffness and mass.".to_owned()
        }
        Note::WallShockNotCompared => {
            "The shock at its wall is not compared with its tolerance.".to_owned()
        }
        Note::Failed {
            on_pads,
            worlds,
            of,
            why,
        } => {
            let model = if *on_pads { "its pads" } else { "a rigid base" };
            format!(
                "The histories on {model} failed in {worlds} of {of} worlds ({why}); they count as exceeded in the \
                 upper end of an interval and as not exceeded in the lower."
            )
        }
        Note::TipsAtRest { worlds, of } => format!(
            "In {worlds} of {of} worlds it does not stand even before the floor moves, on the base that was drawn within the error \
             of its scan: they count as falls."
        ),
        Note::Flies { worlds, of } => format!(
            "In {worlds} of {of} worlds its floor falls away (g + vertical acceleration ≤ 0), and it flies: there its \
             pads answer for both models."
        ),
        Note::FliesWithoutPads => {
            "Its pads could follow it through the air: give its mass and its pads.".to_owned()
        }
        Note::SlipsWithoutPads { slips, why } => slips_without_pads(slips, *why, found),
        Note::Flat(flat) => flat_words(flat),
        Note::OneRealisation => {
            "In three dimensions trust the shares and fractiles of all worlds, not a single history."
                .to_owned()
        }
        Note::OneComponent => {
            "Its floor moves in one direction only: the motions have one component.".to_owned()
        }
        Note::OnHull => {
            "It is followed in three dimensions on a stiff floor, with a model that underestimated overturning in tests of \
             two rocks on a shake table. Its pads and the restitution of its walls are ignored, and the shock of its landings is \
             not calculated."
                .to_owned()
        }
        Note::LowWall => {
            "The wall beside it is lower than the object and is left out: it is calculated as if it stood freely."
                .to_owned()
        }
        Note::StackInPlane => {
            "The object and what stands on it move in the plane of the thickness, with the same pads and the same \
             friction under both. The shock is that of the object itself, and forces for a restraint leave out what \
             stands on it."
                .to_owned()
        }
        Note::LowestTail => {
            "On the ground, synthetic motions may have too few of the rarest falls: a probability of a few percent or less may be \
             twice as large or more."
                .to_owned()
        }
    }
}

fn flat_words(flat: &Flat) -> String {
    let why = match flat {
        Flat::Missing(missing) => {
            let verb = if missing.len() == 1 { "is" } else { "are" };
            format!("{} {verb} not given", Missing::listed(missing))
        }
        Flat::NotUniform => {
            "its base or its centre of gravity is not that of a uniform block".to_owned()
        }
        Flat::Neighbours => "it has neighbours within its reach".to_owned(),
        Flat::Stack => "another object stands on it".to_owned(),
    };
    format!("It moves in a plane, not in three dimensions, because {why}.")
}

/// What sliding changes where no pads can answer.
fn slips_without_pads(slips: &Slips, why: WithoutPads, found: &Assessment) -> String {
    let why = match why {
        WithoutPads::BesideWall => "beside a wall its pads are not followed",
        WithoutPads::NotGiven => "its mass or its pads are not given",
        WithoutPads::NotFollowed => "its pads are not followed",
    };
    let rigid = found.answers.as_ref().and_then(|answers| answers.rigid);
    let p = rigid.map_or(0.0, |rigid| rigid.overturn.value);
    let [low, high] = FALLS_WITH_FRICTION.map(|(friction_ratio, factor)| {
        format!(
            "{factor} times the one without, {}, at a friction of {friction_ratio}",
            percent((factor * p).min(1.0))
        )
    });
    format!(
        "{}: there it slides as well. That is not calculated, because {why}; in an audit of one object the probability \
         of falling was {low}, and {high}.",
        too_little_friction(slips)
    )
}

#[cfg(test)]
mod tests;
