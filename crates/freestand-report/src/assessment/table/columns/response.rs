//! What an object does, what it takes, and the values of the calculation.

use freestand::G0_M_S2;
use freestand::rocking::Restitution;
use freestand_study::cushion::cushion_words;

use crate::assessment::compared::tolerance;
use crate::assessment::reasons::notes;
use crate::assessment::table::{Cell, Column};
use crate::restraint::force::source_name;
use freestand_assess::result::{Cause, design_force, reported_force};

use super::{
    count, depends, flag, lift, lifted, number, of, of_item, of_text, ranked, restraint, share,
    shock, text, yes,
};

pub(super) const COLUMNS: &[Column] = &[
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
                .and_then(|found| Some(found.softening.as_ref()?.admissible())))
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
            Some(source_name(&reported_force(&found.restraint)?.source))
        })
    }),
    text(
        "anchor_source",
        "source of the anchors and the bracket: the floor where the code's force lifts nothing",
        |l| {
            of_text(l, |found| {
                Some(source_name(&design_force(&found.restraint)?.source))
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
        |l| restraint(l, |force| force.source.overstrength_ratio()),
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
        let capacity = l.assessment().and_then(|found| found.capacity.as_ref());
        Cell::owned(capacity.map(|one| tolerance(&one.tolerance)))
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
                Restitution::Housner | Restitution::Factor(_) | Restitution::Edges(_) => None,
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
                Restitution::Housner | Restitution::Value(_) | Restitution::Edges(_) => None,
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
                Some(found.shares.as_ref()?.measure_first?.cause.name())
            })
        },
    ),
    number(
        "measure_first_low",
        "1",
        "probability where that is at its 10 % point",
        |l| {
            of(l, |found| {
                Some(found.shares.as_ref()?.measure_first?.low_ratio)
            })
        },
    ),
    number(
        "measure_first_high",
        "1",
        "probability where that is at its 90 % point",
        |l| {
            of(l, |found| {
                Some(found.shares.as_ref()?.measure_first?.high_ratio)
            })
        },
    ),
    text("notes", "notes in the inventory", |l| {
        Cell::text(&l.item.notes)
    }),
    text(
        "remarks",
        "assumptions and warnings about this object",
        |l| Cell::owned(l.assessment().map(|found| notes(l.item, found))),
    ),
];
