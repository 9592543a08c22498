//! The object, and its verdict.

use crate::assessment::reasons::why;
use crate::assessment::table::{Cell, Column, Kind};
use freestand_assess::assumed;
use freestand_assess::result::ObjectModel;

use super::{
    NOT_ASSESSED, chance, count, flag, number, of, of_count, of_item, of_text, pads, ranked,
    rating, rigid, share, slide, space, stacked, text, yes,
};

pub(super) const COLUMNS: &[Column] = &[
    // The object.
    count(
        "rank",
        "place in the order of urgency: 1 is the most urgent",
        |l| Cell::count(l.found.map(|(rank, _)| rank)),
    ),
    text("id", "identifier of the object", |l| Cell::text(&l.item.id)),
    text("item", "what it is", |l| Cell::text(&l.item.item)),
    count("quantity", "how many such objects there are", |l| {
        Cell::Count(l.item.quantity.into())
    }),
    text("priority", "rank given by the owner", |l| {
        Cell::text(&l.item.priority)
    }),
    text("location", "place of the object, in words", |l| {
        Cell::text(&l.item.location)
    }),
    text("building", "building", |l| Cell::text(&l.item.building)),
    text("floor", "name of the floor", |l| Cell::text(&l.item.floor)),
    text("room", "room", |l| Cell::text(&l.item.room)),
    text(
        "life_safety",
        "FEMA E-74: risk that somebody is hurt: high, medium, low; empty: not rated",
        |l| rating(l.item.consequences.life_safety),
    ),
    text(
        "property",
        "FEMA E-74: risk of a loss of property: high, medium, low; empty: not rated",
        |l| rating(l.item.consequences.property),
    ),
    text(
        "function",
        "FEMA E-74: risk that work stops: high, medium, low; empty: not rated",
        |l| rating(l.item.consequences.function),
    ),
    number(
        "level_ratio",
        "1",
        "height of its floor over the height of the building: 0 ground, 1 roof",
        |l| of_item(l, |item| item.level_ratio),
    ),
    // The verdict.
    Column {
        kind: Kind::Decision,
        ..text(
            "decision",
            "the verdict: restrain, soften, lock, no-verdict or leave; empty: not assessed yet",
            |l| of_text(l, |found| Some(found.decision.name())),
        )
    },
    text(
        "why",
        "the reason for the verdict, in one or two sentences",
        |l| match l.assessment() {
            Some(found) => Cell::owned(Some(why(l.item, found))),
            None => Cell::text(NOT_ASSESSED),
        },
    ),
    text(
        "governing",
        "the governing criterion in the world that decides",
        |l| {
            of_text(l, |found| {
                found
                    .capacity
                    .as_ref()
                    .map(|capacity| capacity.governing.name())
            })
        },
    ),
    ranked(
        "demand_capacity_ratio",
        "1",
        "demand/capacity of the median world on a rigid base; above 1 the tolerance is exceeded",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.capacity.as_ref()?.demand_capacity)),
            )
        },
    ),
    ranked(
        "demand_capacity_ratio_p84",
        "1",
        "demand/capacity that 84 % of the worlds do not exceed",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.capacity.as_ref()?.demand_capacity_p84)),
            )
        },
    ),
    share(
        "p_exceed",
        "probability that a criterion is exceeded or that it overturns",
        |l| chance(l, |found| found.p_exceed, |p| p.value),
    ),
    share(
        "p_exceed_low",
        "lower end of the interval of p_exceed",
        |l| chance(l, |found| found.p_exceed, |p| p.low),
    ),
    share(
        "p_exceed_high",
        "upper end of the interval of p_exceed",
        |l| chance(l, |found| found.p_exceed, |p| p.high),
    ),
    share("p_overturn", "probability that it overturns", |l| {
        chance(l, |found| found.p_overturn, |p| p.value)
    }),
    share(
        "p_overturn_low",
        "lower end of the interval of p_overturn",
        |l| chance(l, |found| found.p_overturn, |p| p.low),
    ),
    share(
        "p_overturn_high",
        "upper end of the interval of p_overturn",
        |l| chance(l, |found| found.p_overturn, |p| p.high),
    ),
    share("accepted_ratio", "accepted probability", |l| {
        of(l, |found| Some(found.accepted_ratio))
    }),
    text("accepted_for", "what sets the accepted probability", |l| {
        of_text(l, |found| Some(found.accepted_for.name()))
    }),
    text("falls", "whether it falls: stays, falls, close", |l| {
        of_text(l, |found| Some(found.answers.as_ref()?.falls.into()))
    }),
    text(
        "shock",
        "whether a shock is too hard: stands, exceeded, close, unknown",
        |l| of_text(l, |found| Some(found.answers.as_ref()?.shock.into())),
    ),
    flag(
        "close_call",
        "whether an answer is too close to the accepted probability to call",
        |l| {
            yes(l
                .assessment()
                .and_then(|found| Some(found.answers.as_ref()?.is_close())))
        },
    ),
    text(
        "close_on",
        "which answer is too close to call: falls, shock, both",
        |l| {
            of_text(l, |found| {
                Some(found.answers.as_ref()?.close_on()).filter(|on| !on.is_empty())
            })
        },
    ),
    text(
        "models_agree",
        "whether both models are on one side of the accepted probability; empty: one model",
        |l| {
            of_text(l, |found| {
                found
                    .answers
                    .as_ref()?
                    .models_agree
                    .map(|agree| if agree { "yes" } else { "no" })
            })
        },
    ),
    count("worlds", "worlds", |l| {
        of_count(l, |answers| Some(answers.worlds))
    }),
    count(
        "settled_at",
        "worlds at which no question was open any more; empty: a close call",
        |l| of_count(l, |answers| (!answers.is_close()).then_some(answers.worlds)),
    ),
    count("worlds_cap", "worlds after which no more are added", |l| {
        of_count(l, |answers| Some(answers.worlds_cap))
    }),
    count(
        "worlds_needed",
        "fewest worlds that could leave it as it is, where the study allows fewer",
        |l| of_count(l, |answers| answers.worlds_needed),
    ),
    text(
        "assumed",
        "columns that the list leaves empty, so that something is assumed",
        |l| {
            Cell::owned(Some(
                assumed::columns(l.item).collect::<Vec<_>>().join(", "),
            ))
        },
    ),
    count("assumed_count", "how many these are", |l| {
        Cell::count(Some(assumed::columns(l.item).count()))
    }),
    flag(
        "is_round",
        "whether it is round: its model underestimates how often it falls, so it is left only where more than 8 % is accepted",
        |l| yes(Some(l.item.is_round())),
    ),
    count(
        "worlds_compliant",
        "worlds on the compliant base, where they are fewer",
        |l| of_count(l, |answers| answers.worlds_compliant),
    ),
    number("confidence", "1", "confidence of the intervals", |l| {
        of(l, |found| Some(found.answers.as_ref()?.confidence))
    }),
    share(
        "p_overturn_rigid",
        "probability that it falls, on a rigid base",
        |l| rigid(l, |m| Some(m.overturn), |p| p.value),
    ),
    share("p_overturn_rigid_low", "lower end of its interval", |l| {
        rigid(l, |m| Some(m.overturn), |p| p.low)
    }),
    share("p_overturn_rigid_high", "upper end of its interval", |l| {
        rigid(l, |m| Some(m.overturn), |p| p.high)
    }),
    share(
        "p_overturn_compliant",
        "probability that it falls, on its pads",
        |l| pads(l, |m| Some(m.overturn), |p| p.value),
    ),
    share(
        "p_overturn_compliant_low",
        "lower end of its interval",
        |l| pads(l, |m| Some(m.overturn), |p| p.low),
    ),
    share(
        "p_overturn_compliant_high",
        "upper end of its interval",
        |l| pads(l, |m| Some(m.overturn), |p| p.high),
    ),
    share(
        "p_exceed_rigid",
        "probability that a criterion is exceeded or that it falls, on a rigid base",
        |l| rigid(l, |m| m.exceed, |p| p.value),
    ),
    share("p_exceed_rigid_low", "lower end of its interval", |l| {
        rigid(l, |m| m.exceed, |p| p.low)
    }),
    share("p_exceed_rigid_high", "upper end of its interval", |l| {
        rigid(l, |m| m.exceed, |p| p.high)
    }),
    share(
        "p_exceed_compliant",
        "probability that a criterion is exceeded or that it falls, on its pads",
        |l| pads(l, |m| m.exceed, |p| p.value),
    ),
    share("p_exceed_compliant_low", "lower end of its interval", |l| {
        pads(l, |m| m.exceed, |p| p.low)
    }),
    share(
        "p_exceed_compliant_high",
        "upper end of its interval",
        |l| pads(l, |m| m.exceed, |p| p.high),
    ),
    number(
        "p_overturn_per_year",
        "1",
        "probability per year that it falls",
        |l| of(l, |found| Some(found.per_year.as_ref()?.overturn)),
    ),
    number(
        "p_exceed_per_year",
        "1",
        "probability per year that a criterion is exceeded or that it falls",
        |l| of(l, |found| found.per_year.as_ref()?.exceed),
    ),
    text(
        "model",
        "its model: rock, rock-wall, compliant, roll, slide, compliant-3d, hull-3d, stack",
        |l| of_text(l, |found| found.model.map(ObjectModel::name)),
    ),
    share(
        "p_lean",
        "share of the worlds at whose end it leans on its wall; they count as falls",
        |l| of(l, |found| Some(found.at_wall?.lean_share)),
    ),
    number(
        "wall_speed_m_s_median",
        "m/s",
        "largest speed at its wall, median world; 0: it does not strike it",
        |l| of(l, |found| Some(found.at_wall?.speed_m_s_median)),
    ),
    number(
        "wall_acceleration_g_median",
        "g",
        "largest shock at its wall, median world",
        |l| of(l, |found| found.at_wall?.acceleration_g_median),
    ),
    share(
        "p_overturn_wall_touching",
        "probability that it falls if it touched a wall; only where it is to be restrained and the list gives no wall",
        |l| of(l, |found| Some(found.before_wall?.touching.value)),
    ),
    share("p_overturn_wall_50mm", "the same at a gap of 50 mm", |l| {
        of(l, |found| Some(found.before_wall?.at_50_mm.value))
    }),
    ranked(
        "tilt_rad_median",
        "rad",
        "largest tilt in three dimensions, median world",
        |l| space(l, |space| space.tilt_rad_median),
    ),
    ranked(
        "tilt_rad_p84",
        "rad",
        "the same that 84 % of the worlds do not exceed",
        |l| space(l, |space| space.tilt_rad_p84),
    ),
    ranked(
        "slide_m_median",
        "m",
        "travel on its casters or sliding, to one side as if nothing were in the way, or walk of its base in three \
         dimensions, median world",
        |l| {
            slide(
                l,
                |rolled| rolled.travel_m_median,
                |space| space.walk_m_median,
            )
        },
    ),
    ranked(
        "slide_m_p84",
        "m",
        "the same that 84 % of the worlds do not exceed",
        |l| slide(l, |rolled| rolled.travel_m_p84, |space| space.walk_m_p84),
    ),
    number(
        "clearance_needed_m",
        "m",
        "room on every side that would suffice for its travel; only where it rolls or slides",
        |l| of(l, |found| Some(found.rolled?.clearance_needed_m)),
    ),
    number(
        "clearance_m_median",
        "m",
        "room on every side that it needs in the median world, turned as it is there; only where it rolls or slides",
        |l| of(l, |found| Some(found.rolled?.room_m[0])),
    ),
    number(
        "clearance_m_p84",
        "m",
        "the same that 84 % of the worlds do not exceed",
        |l| of(l, |found| Some(found.rolled?.room_m[1])),
    ),
    number(
        "clearance_m_p98",
        "m",
        "the same that 98 % of the worlds do not exceed",
        |l| of(l, |found| Some(found.rolled?.room_m[2])),
    ),
    share(
        "p_overturn_locked",
        "probability that it falls when it is locked; only where it lacks room",
        |l| of(l, |found| Some(found.braked?.overturn.value)),
    ),
    share("p_overturn_locked_high", "upper end of its interval", |l| {
        of(l, |found| Some(found.braked?.overturn.high))
    }),
    count(
        "falls_lower",
        "worlds in which an object with another one on it falls first",
        |l| stacked(l, |stacked| stacked.lower_falls),
    ),
    count(
        "falls_upper",
        "worlds in which what stands on it falls first",
        |l| stacked(l, |stacked| stacked.upper_falls),
    ),
    number(
        "threshold_upper_g",
        "g",
        "steady floor acceleration at which what stands on it rocks alone",
        |l| of(l, |found| Some(found.stacked?.threshold_upper_g)),
    ),
    number(
        "threshold_together_g",
        "g",
        "the same at which both rock as one body",
        |l| of(l, |found| Some(found.stacked?.threshold_together_g)),
    ),
    number(
        "trip_margin",
        "1",
        "speed at which its stop overturns it over the speed there that 84 % of the worlds do not exceed",
        |l| of(l, |found| found.rolled?.trip_margin()),
    ),
    count(
        "tier",
        "tier that decided: 0 it rocks in no world, 2 a rigid base, 3 a rigid base and its pads",
        |l| Cell::count(l.assessment().map(|found| found.tier.into())),
    ),
];
