//! The list of columns.

use freestand::G0_M_S2;
use freestand::rocking::Restitution;

use crate::assumed;
use crate::result::{
    Answers, Assessment, Cause, InSpace, ModelAnswers, ObjectModel, Probability, Ranked,
    RestraintForce, Rolled, Stacked, design_force, reported_force,
};
use freestand_inventory::{Item, Rating};
use freestand_study::cushion::cushion_words;

use super::{Cell, Column, Kind, Line};

/// Every column of freestand, in order; other columns of the inventory follow.
pub(crate) const COLUMNS: &[Column] = &[
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
            Some(found) => Cell::text(&found.why),
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
        "whether it is round: not calculated in three dimensions, and never left as it is",
        |l| yes(Some(l.item.is_round)),
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
        "its model: rock, rock-wall, compliant, roll, slide, compliant-3d, stack",
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
    // Its response.
    count(
        "motions",
        "worlds for which the histories about every axis succeeded",
        |l| {
            Cell::count(
                l.assessment()
                    .and_then(|found| Some(found.response.as_ref()?.motions)),
            )
        },
    ),
    count("motions_failed", "worlds for which a history failed", |l| {
        Cell::count(
            l.assessment()
                .and_then(|found| Some(found.response.as_ref()?.failed)),
        )
    }),
    share(
        "uplift_share",
        "share of the worlds that cause uplift",
        |l| of(l, |found| Some(found.response.as_ref()?.uplift_share)),
    ),
    share(
        "overturn_share",
        "share of the worlds that overturn it",
        |l| of(l, |found| Some(found.response.as_ref()?.overturn_share)),
    ),
    ranked("uplift_m_median", "m", "uplift, median world", |l| {
        lift(l, 1)
    }),
    ranked(
        "uplift_m_p16",
        "m",
        "uplift that 16 % of the worlds do not exceed",
        |l| lift(l, 0),
    ),
    ranked(
        "uplift_m_p84",
        "m",
        "uplift that 84 % of the worlds do not exceed",
        |l| lift(l, 2),
    ),
    ranked(
        "rotation_ratio_median",
        "1",
        "peak rotation over the slenderness angle, median world",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.response.as_ref()?.rotation_ratio[1])),
            )
        },
    ),
    count(
        "impacts_max",
        "largest number of impacts in one world",
        |l| {
            Cell::count(
                l.assessment()
                    .and_then(|found| Some(found.response.as_ref()?.impacts_max)),
            )
        },
    ),
    // Its shock.
    ranked(
        "edge_acceleration_g_median",
        "g",
        "shock, the larger source, median world",
        |l| shock(l, 1),
    ),
    ranked(
        "edge_acceleration_g_p16",
        "g",
        "shock, the larger source, that 16 % of the worlds do not exceed",
        |l| shock(l, 0),
    ),
    ranked(
        "edge_acceleration_g_p84",
        "g",
        "shock, the larger source, that 84 % of the worlds do not exceed",
        |l| shock(l, 2),
    ),
    number(
        "edge_acceleration_g_max",
        "g",
        "largest shock of the worlds that do not overturn it",
        |l| of(l, |found| found.shock.as_ref()?.edge_acceleration_max_g),
    ),
    ranked(
        "edge_acceleration_uplift_g_median",
        "g",
        "shock from the rise of the centre of gravity, median world",
        |l| lifted(l, 1),
    ),
    ranked(
        "edge_acceleration_uplift_g_p16",
        "g",
        "shock from the rise of the centre of gravity that 16 % of the worlds do not exceed",
        |l| lifted(l, 0),
    ),
    ranked(
        "edge_acceleration_uplift_g_p84",
        "g",
        "shock from the rise of the centre of gravity that 84 % of the worlds do not exceed",
        |l| lifted(l, 2),
    ),
    number(
        "ceiling_g",
        "g",
        "ceiling: the largest shock from the rise of the centre of gravity in any world",
        |l| of(l, |found| Some(found.shock.as_ref()?.ceiling_g)),
    ),
    number(
        "pulse_duration_s",
        "s",
        "duration of the pulse; π√(m_eff/k) on a spring",
        |l| of(l, |found| Some(found.shock.as_ref()?.pulse_duration_s)),
    ),
    ranked(
        "velocity_change_m_s",
        "m/s",
        "velocity change of the edge at the median shock",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.shock.as_ref()?.velocity_change_m_s)),
            )
        },
    ),
    count(
        "impacts_above_tolerance",
        "impacts above the tolerance in the hardest world that does not overturn it",
        |l| {
            Cell::count(
                l.assessment()
                    .and_then(|found| found.shock.as_ref()?.impacts_above_tolerance),
            )
        },
    ),
    // Its floor, sliding and clearance.
    number("pfa_g_median", "g", "PFA of its floor, median world", |l| {
        of(l, |found| Some(found.floor.as_ref()?.pfa_g_median))
    }),
    number(
        "pfa_g_max",
        "g",
        "PFA of its floor, largest of all worlds",
        |l| of(l, |found| Some(found.floor.as_ref()?.pfa_g_max)),
    ),
    number(
        "pfv_m_s_median",
        "m/s",
        "PFV of its floor, median world",
        |l| of(l, |found| Some(found.floor.as_ref()?.pfv_m_s_median)),
    ),
    number(
        "floor_ratio",
        "1",
        "median PFA over the peak of the tolerance",
        |l| of(l, |found| found.capacity.as_ref()?.floor_ratio),
    ),
    text("sliding", "whether it slides: no, possible, yes", |l| {
        of_text(l, |found| Some(found.sliding.as_ref()?.verdict.name()))
    }),
    number(
        "friction_low_ratio",
        "1",
        "lowest coefficient of friction, stated or assumed",
        |l| of(l, |found| Some(found.sliding.as_ref()?.friction_ratio.0)),
    ),
    number(
        "friction_high_ratio",
        "1",
        "highest coefficient of friction, stated or assumed",
        |l| of(l, |found| Some(found.sliding.as_ref()?.friction_ratio.1)),
    ),
    number(
        "clearance_m",
        "m",
        "clearance that it needs on every side while it rocks",
        |l| of(l, |found| found.clearance_m),
    ),
    // A softer pad, and restraint.
    number(
        "max_stiffness_n_m",
        "N/m",
        "largest stiffness under one edge with which a softer pad suffices",
        |l| of(l, |found| found.softening.as_ref()?.max_stiffness_n_m),
    ),
    flag(
        "softening_admissible",
        "whether that pad passed every check",
        |l| {
            yes(l
                .assessment()
                .and_then(|found| Some(found.softening.as_ref()?.admissible)))
        },
    ),
    number(
        "softened_edge_acceleration_g",
        "g",
        "median shock on that pad, on the compliant base",
        |l| of(l, |found| found.softening.as_ref()?.edge_acceleration_g),
    ),
    number(
        "pad_stroke_m",
        "m",
        "compression of that pad that 95 % of the worlds do not exceed",
        |l| of(l, |found| found.softening.as_ref()?.stroke_m),
    ),
    number(
        "restraint_force_n",
        "N",
        "horizontal force of a restraint by the study's own code, or by its floor",
        |l| {
            Cell::number(
                l.assessment()
                    .and_then(|found| reported_force(&found.restraint))
                    .map(|force| force.force_n),
            )
        },
    ),
    text("restraint_source", "clause of this force", |l| {
        of_text(l, |found| {
            Some(reported_force(&found.restraint)?.source.as_str())
        })
    }),
    text(
        "anchor_source",
        "source of the anchors and the bracket: the floor where the code's force lifts nothing",
        |l| {
            of_text(l, |found| {
                Some(design_force(&found.restraint)?.source.as_str())
            })
        },
    ),
    number(
        "held_weight_ratio",
        "1",
        "weight that holds it down against the force, over its weight",
        |l| restraint(l, |force| force.held_weight_ratio),
    ),
    number(
        "overstrength_ratio",
        "1",
        "factor on the force for anchors in concrete",
        |l| restraint(l, |force| force.overstrength_ratio),
    ),
    number(
        "anchor_tension_n",
        "N",
        "tension of all anchors along one edge together; 0: its weight suffices",
        |l| restraint(l, |force| force.anchor_tension_n),
    ),
    number(
        "anchor_tension_concrete_n",
        "N",
        "the same for anchors in concrete",
        |l| {
            // Never less than by the code, whose Ω_0 may lift what its force does not.
            let forces = l.assessment().map(|found| &found.restraint);
            let both = forces.map(|forces| [design_force(forces), reported_force(forces)]);
            let tensions = both
                .into_iter()
                .flatten()
                .flatten()
                .map(|force| force.anchor_tension_concrete_n);
            Cell::number(tensions.reduce(f64::max))
        },
    ),
    number(
        "bracket_height_m",
        "m",
        "height of a bracket in place of the anchors",
        |l| restraint(l, |force| force.bracket_height_m),
    ),
    number(
        "bracket_force_n",
        "N",
        "horizontal force of that bracket",
        |l| restraint(l, |force| force.bracket_force_n),
    ),
    number(
        "bracket_base_shear_n",
        "N",
        "horizontal force at the feet beside that bracket",
        |l| restraint(l, |force| force.bracket_base_shear_n),
    ),
    // The values of the calculation.
    text("tolerance", "its tolerance, in words", |l| {
        of_text(l, |found| {
            found
                .capacity
                .as_ref()
                .map(|capacity| capacity.tolerance.as_str())
        })
    }),
    number(
        "tolerance_g",
        "g",
        "peak acceleration that it withstands",
        |l| {
            of_item(l, |item| {
                Some(item.tolerance.as_ref()?.peak_m_s2? / G0_M_S2)
            })
        },
    ),
    number(
        "tolerance_duration_s",
        "s",
        "duration of the half-sine with that peak",
        |l| of_item(l, |item| item.tolerance.as_ref()?.duration_s),
    ),
    number(
        "tolerance_velocity_change_m_s",
        "m/s",
        "velocity change below which no peak causes damage",
        |l| of_item(l, |item| item.tolerance.as_ref()?.velocity_change_m_s),
    ),
    number(
        "tolerance_edge_lift_m",
        "m",
        "uplift from which it may fall back without damage",
        |l| of_item(l, |item| item.tolerance.as_ref()?.edge_lift_m),
    ),
    text("tolerance_source", "source of the tolerance", |l| {
        l.item
            .tolerance
            .as_ref()
            .map_or(Cell::Missing, |tolerance| Cell::text(&tolerance.source))
    }),
    flag(
        "tolerance_decides",
        "whether a verdict may depend on that source; false if it is recalled",
        |l| {
            yes(l
                .item
                .tolerance
                .as_ref()
                .map(|tolerance| tolerance.confidence.decides()))
        },
    ),
    number("height_m", "m", "height", |l| {
        of_item(l, |item| item.height_m)
    }),
    number(
        "thickness_m",
        "m",
        "horizontal size in the plane of rocking",
        |l| of_item(l, |item| item.thickness_m),
    ),
    number(
        "width_m",
        "m",
        "horizontal size across it; empty: computed about one axis only",
        |l| of_item(l, |item| item.width_m),
    ),
    number(
        "base_thickness_m",
        "m",
        "distance between the edges in the direction of the thickness",
        |l| of_item(l, |item| item.base_thickness_m.or(item.thickness_m)),
    ),
    number(
        "base_width_m",
        "m",
        "distance between the edges in the direction of the width",
        |l| of_item(l, |item| item.base_width_m.or(item.width_m)),
    ),
    number(
        "cg_height_m",
        "m",
        "height of the centre of gravity; half the height where it was not given",
        |l| {
            of_item(l, |item| {
                item.cg_height_m
                    .or(item.height_m.map(|height_m| 0.5 * height_m))
            })
        },
    ),
    number("mass_kg", "kg", "mass", |l| of_item(l, |item| item.mass_kg)),
    number(
        "stiffness_n_m",
        "N/m",
        "stiffness under one edge; empty for a contact law that has none",
        |l| {
            of_item(l, |item| {
                item.cushion.as_ref()?.cushion.linear_stiffness_n_m()
            })
        },
    ),
    text("cushion", "the cushion under one edge", |l| {
        Cell::owned(
            l.item
                .cushion
                .as_ref()
                .map(|edge| cushion_words(&edge.cushion)),
        )
    }),
    text(
        "cushion_source",
        "source of the cushion, where it comes from the library",
        |l| {
            l.item
                .cushion_source
                .as_deref()
                .map_or(Cell::Missing, Cell::text)
        },
    ),
    number(
        "restitution",
        "1",
        "restitution as stated; empty: Housner's",
        |l| {
            of_item(l, |item| match item.restitution {
                Restitution::Value(value) => Some(value),
                Restitution::Housner | Restitution::Factor(_) => None,
            })
        },
    ),
    number(
        "restitution_factor",
        "1",
        "factor on Housner's restitution as stated",
        |l| {
            of_item(l, |item| match item.restitution {
                Restitution::Factor(factor) => Some(factor),
                Restitution::Housner | Restitution::Value(_) => None,
            })
        },
    ),
    number(
        "restitution_p16",
        "1",
        "restitution that was drawn, at 16 %",
        |l| {
            of(l, |found| {
                Some(found.answers.as_ref()?.restitution_p16_p84[0])
            })
        },
    ),
    number(
        "restitution_p84",
        "1",
        "restitution that was drawn, at 84 %",
        |l| {
            of(l, |found| {
                Some(found.answers.as_ref()?.restitution_p16_p84[1])
            })
        },
    ),
    number(
        "rebound_restitution",
        "1",
        "rebound over landing velocity of an edge on its pads",
        |l| of(l, |found| Some(found.on_pads.as_ref()?.rebound_restitution)),
    ),
    number(
        "rocking_frequency_hz",
        "Hz",
        "frequency of rocking with both edges on their pads",
        |l| of(l, |found| found.on_pads.as_ref()?.rocking_frequency_hz),
    ),
    number(
        "pad_uplift_threshold_g",
        "g",
        "steady floor acceleration that lifts an edge off its pad",
        |l| of(l, |found| found.on_pads.as_ref()?.pad_uplift_threshold_g),
    ),
    number(
        "pad_uplift_ratio_p84",
        "1",
        "U that 84 % of the worlds do not exceed; above 1 an edge leaves its pad",
        |l| of(l, |found| found.on_pads.as_ref()?.pad_uplift_ratio_p84),
    ),
    ranked(
        "edge_acceleration_compliant_g_median",
        "g",
        "shock on its pads, median world",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.on_pads.as_ref()?.edge_acceleration_g_median)),
            )
        },
    ),
    ranked(
        "demand_capacity_compliant_ratio_median",
        "1",
        "demand/capacity on its pads, median world",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.on_pads.as_ref()?.demand_capacity_median)),
            )
        },
    ),
    ranked(
        "lift_compliant_m_median",
        "m",
        "uplift on its pads, median world",
        |l| {
            Cell::ranked(
                l.assessment()
                    .and_then(|found| Some(found.on_pads.as_ref()?.lift_m_median)),
            )
        },
    ),
    share(
        "softened_p_exceed_high",
        "upper end of the interval of p_exceed on the softer pad",
        |l| of(l, |found| found.softening.as_ref()?.p_exceed_high),
    ),
    share(
        "softened_p_overturn_high",
        "upper end of the interval of p_overturn on the softer pad",
        |l| of(l, |found| found.softening.as_ref()?.p_overturn_high),
    ),
    number(
        "share_motion",
        "1",
        "share of the answer that depends on the ground motion",
        |l| depends(l, Cause::Motion),
    ),
    number(
        "share_building",
        "1",
        "share that depends on the building",
        |l| depends(l, Cause::Building),
    ),
    number(
        "share_restitution",
        "1",
        "share that depends on restitution",
        |l| depends(l, Cause::Restitution),
    ),
    number("share_pad", "1", "share that depends on the pads", |l| {
        depends(l, Cause::Pad)
    }),
    number(
        "share_body",
        "1",
        "share that depends on size and mass",
        |l| depends(l, Cause::Body),
    ),
    number(
        "share_model",
        "1",
        "share that depends on the error of the models",
        |l| depends(l, Cause::Model),
    ),
    text(
        "measure_first",
        "what to measure first: the accepted probability lies between its two ends",
        |l| {
            of_text(l, |found| {
                Some(found.shares.as_ref()?.measure_first?.0.name())
            })
        },
    ),
    number(
        "measure_first_low",
        "1",
        "probability where that is at its 10 % point",
        |l| of(l, |found| Some(found.shares.as_ref()?.measure_first?.1)),
    ),
    number(
        "measure_first_high",
        "1",
        "probability where that is at its 90 % point",
        |l| of(l, |found| Some(found.shares.as_ref()?.measure_first?.2)),
    ),
    text("notes", "notes in the inventory", |l| {
        Cell::text(&l.item.notes)
    }),
    text(
        "remarks",
        "assumptions and warnings about this object",
        |l| Cell::owned(l.assessment().map(|found| found.notes.join(" "))),
    ),
];

/// The reason in a row without a decision.
const NOT_ASSESSED: &str =
    "Not assessed yet: the run was stopped before its end, and this result is partial.";

fn of_count<'a>(line: &Line<'a>, get: impl Fn(&Answers) -> Option<u32>) -> Cell<'a> {
    Cell::count(
        line.assessment()
            .and_then(|found| get(found.answers.as_ref()?))
            .map(|count| count as usize),
    )
}

fn rigid<'a>(
    line: &Line<'a>,
    of: fn(&ModelAnswers) -> Option<Probability>,
    end: fn(&Probability) -> f64,
) -> Cell<'a> {
    chance(
        line,
        |found| of(found.answers.as_ref()?.rigid.as_ref()?),
        end,
    )
}

fn pads<'a>(
    line: &Line<'a>,
    of: fn(&ModelAnswers) -> Option<Probability>,
    end: fn(&Probability) -> f64,
) -> Cell<'a> {
    chance(
        line,
        |found| of(found.answers.as_ref()?.compliant.as_ref()?),
        end,
    )
}

fn depends<'a>(line: &Line<'a>, cause: Cause) -> Cell<'a> {
    of(line, |found| {
        found
            .shares
            .as_ref()?
            .by_group
            .iter()
            .find(|(one, _)| *one == cause)?
            .1
    })
}

type Extract = for<'a> fn(&Line<'a>) -> Cell<'a>;

const fn text(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Text,
        unit: "–",
        meaning,
        cell,
    }
}

const fn count(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Count,
        unit: "–",
        meaning,
        cell,
    }
}

const fn number(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    cell: Extract,
) -> Column {
    Column {
        name,
        kind: Kind::Number,
        unit,
        meaning,
        cell,
    }
}

const fn share(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Share,
        unit: "1",
        meaning,
        cell,
    }
}

const fn ranked(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    cell: Extract,
) -> Column {
    Column {
        name,
        kind: Kind::Ranked,
        unit,
        meaning,
        cell,
    }
}

const fn flag(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Flag,
        unit: "–",
        meaning,
        cell,
    }
}

fn yes<'a>(flag: Option<bool>) -> Cell<'a> {
    flag.map_or(Cell::Missing, Cell::Flag)
}

fn of_item<'a>(line: &Line<'a>, value: fn(&Item) -> Option<f64>) -> Cell<'a> {
    Cell::number(value(line.item))
}

fn of<'a>(line: &Line<'a>, value: impl Fn(&Assessment) -> Option<f64>) -> Cell<'a> {
    Cell::number(line.assessment().and_then(value))
}

fn of_text<'a>(line: &Line<'a>, text: for<'t> fn(&'t Assessment) -> Option<&'t str>) -> Cell<'a> {
    line.assessment()
        .and_then(text)
        .map_or(Cell::Missing, Cell::text)
}

fn chance<'a>(
    line: &Line<'a>,
    chance: impl Fn(&Assessment) -> Option<Probability>,
    value: fn(&Probability) -> f64,
) -> Cell<'a> {
    Cell::number(
        line.assessment()
            .and_then(chance)
            .map(|probability| value(&probability)),
    )
}

fn lift<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let response = line.assessment().and_then(|found| found.response.as_ref());
    Cell::ranked(
        response
            .and_then(|response| response.uplift_m.get(quantile))
            .copied(),
    )
}

fn space<'a>(line: &Line<'a>, of: fn(&InSpace) -> Ranked) -> Cell<'a> {
    Cell::ranked(
        line.assessment()
            .and_then(|found| found.in_space.as_ref().map(of)),
    )
}

fn slide<'a>(
    line: &Line<'a>,
    rolls: fn(&Rolled) -> f64,
    walks: fn(&InSpace) -> Ranked,
) -> Cell<'a> {
    let rolled = line
        .assessment()
        .and_then(|found| found.rolled.as_ref().map(rolls));
    rolled.map_or_else(
        || space(line, walks),
        |travel_m| Cell::number(Some(travel_m)),
    )
}

fn stacked<'a>(line: &Line<'a>, of: fn(&Stacked) -> u32) -> Cell<'a> {
    Cell::count(
        line.assessment()
            .and_then(|found| found.stacked.as_ref().map(of))
            .map(|count| count as usize),
    )
}

fn shock<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let shock = line.assessment().and_then(|found| found.shock.as_ref());
    Cell::ranked(
        shock
            .and_then(|shock| shock.edge_acceleration_g.get(quantile))
            .copied(),
    )
}

fn lifted<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let shock = line.assessment().and_then(|found| found.shock.as_ref());
    Cell::ranked(
        shock
            .and_then(|shock| shock.edge_acceleration_uplift_g.get(quantile))
            .copied(),
    )
}

fn rating<'a>(rating: Option<Rating>) -> Cell<'a> {
    rating.map_or(Cell::Missing, |rating| Cell::text(rating.name()))
}

/// A value of the force that counts for the object.
fn restraint<'a>(line: &Line<'a>, value: fn(&RestraintForce) -> f64) -> Cell<'a> {
    Cell::number(
        line.assessment()
            .and_then(|found| design_force(&found.restraint))
            .map(value),
    )
}
