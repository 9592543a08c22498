//! The list itself.

use freestand::G0_M_S2;
use freestand::rocking::Restitution;

use crate::assess::result::{Assessment, Probability, RestraintForce};
use crate::inventory::{Item, Rating};
use freestand_study::cushion::cushion_words;

use super::{Cell, Column, Kind, Line};

/// Every column of ours, in order; those of the inventory that are not ours follow behind.
pub const COLUMNS: &[Column] = &[
    // Who it is.
    count("rank", "place in the list: 1 is the most urgent", |l| Cell::count(l.found.map(|(rank, _)| rank))),
    text("id", "name of the object", |l| Cell::text(&l.item.id)),
    text("item", "what it is", |l| Cell::text(&l.item.item)),
    count("quantity", "how many of them stand there", |l| Cell::Count(l.item.quantity.into())),
    text("priority", "rank given by the owner", |l| Cell::text(&l.item.priority)),
    text("location", "where it stands, in words", |l| Cell::text(&l.item.location)),
    text("building", "building", |l| Cell::text(&l.item.building)),
    text("floor", "floor, by its name", |l| Cell::text(&l.item.floor)),
    text("room", "room", |l| Cell::text(&l.item.room)),
    text("life_safety", "FEMA E-74: whether somebody may be hurt (H, M, L)", |l| {
        rating(l.item.consequences.life_safety)
    }),
    text("property_loss", "FEMA E-74: whether it costs money (H, M, L)", |l| rating(l.item.consequences.property)),
    text("functional_loss", "FEMA E-74: whether work stops (H, M, L)", |l| rating(l.item.consequences.function)),
    number("level_ratio", "1", "height of its floor over that of the building: 0 ground, 1 roof", |l| {
        of_item(l, |item| item.level_ratio)
    }),
    // The verdict.
    text("decision", "restrain, soften, no-verdict or leave; empty: not assessed yet", |l| {
        of_text(l, |found| Some(found.decision.name()))
    }),
    text("why", "the decision in one or two sentences", |l| match l.assessment() {
        Some(found) => Cell::text(&found.why),
        None => Cell::text(NOT_ASSESSED),
    }),
    text("governing", "criterion that governs at the motion that decides", |l| {
        of_text(l, |found| found.capacity.as_ref().map(|capacity| capacity.governing.as_str()))
    }),
    ranked("demand_capacity_ratio", "1", "demand over capacity of the median motion; above 1 it is damaged", |l| {
        Cell::ranked(l.assessment().and_then(|found| Some(found.capacity.as_ref()?.demand_capacity)))
    }),
    ranked("demand_capacity_ratio_p84", "1", "demand over capacity that 84 % of the motions stay below", |l| {
        Cell::ranked(l.assessment().and_then(|found| Some(found.capacity.as_ref()?.demand_capacity_p84)))
    }),
    number("p_exceed", "1", "probability that a criterion is exceeded or that it overturns", |l| {
        chance(l, |found| found.p_exceed, |p| p.value)
    }),
    number("p_exceed_low", "1", "lower end of the 95 % interval of p_exceed", |l| {
        chance(l, |found| found.p_exceed, |p| p.low)
    }),
    number("p_exceed_high", "1", "upper end of the 95 % interval of p_exceed", |l| {
        chance(l, |found| found.p_exceed, |p| p.high)
    }),
    number("p_overturn", "1", "probability that it overturns", |l| chance(l, |found| found.p_overturn, |p| p.value)),
    number("p_overturn_low", "1", "lower end of the 95 % interval of p_overturn", |l| {
        chance(l, |found| found.p_overturn, |p| p.low)
    }),
    number("p_overturn_high", "1", "upper end of the 95 % interval of p_overturn", |l| {
        chance(l, |found| found.p_overturn, |p| p.high)
    }),
    number("accepted_ratio", "1", "probability that is accepted", |l| of(l, |found| Some(found.accepted_ratio))),
    text("accepted_for", "the consequence that the accepted probability is for", |l| {
        of_text(l, |found| Some(found.accepted_for.as_str()))
    }),
    count("draws", "draws of the uncertain values for each motion; 0: none were needed", |l| {
        Cell::count(l.assessment().map(|found| found.draws as usize))
    }),
    count("tier", "what decided: 0 thresholds, 1 spectra, 2 its own histories, 3 the compliant base", |l| {
        Cell::count(l.assessment().map(|found| found.tier.into()))
    }),
    // What it does.
    count("motions", "motions that were followed about every axis", |l| {
        Cell::count(l.assessment().and_then(|found| Some(found.response.as_ref()?.motions)))
    }),
    count("motions_failed", "motions that could not be followed", |l| {
        Cell::count(l.assessment().and_then(|found| Some(found.response.as_ref()?.failed)))
    }),
    number("uplift_share", "1", "share of the motions under which it lifts off", |l| {
        of(l, |found| Some(found.response.as_ref()?.uplift_share))
    }),
    number("overturn_share", "1", "share of the motions under which it overturns", |l| {
        of(l, |found| Some(found.response.as_ref()?.overturn_share))
    }),
    ranked("uplift_m_median", "m", "lift of the free edge, median motion", |l| lift(l, 1)),
    ranked("uplift_m_p16", "m", "lift of the free edge, 16 % of the motions", |l| lift(l, 0)),
    ranked("uplift_m_p84", "m", "lift of the free edge, 84 % of the motions", |l| lift(l, 2)),
    ranked("rotation_ratio_median", "1", "peak rotation over the overturning angle, median motion", |l| {
        Cell::ranked(l.assessment().and_then(|found| Some(found.response.as_ref()?.rotation_ratio[1])))
    }),
    count("impacts_max", "largest number of impacts of a motion", |l| {
        Cell::count(l.assessment().and_then(|found| Some(found.response.as_ref()?.impacts_max)))
    }),
    // Its shock.
    ranked("edge_acceleration_g_median", "g", "shock at the landing edge, the larger source, median motion", |l| {
        shock(l, 1)
    }),
    ranked("edge_acceleration_g_p16", "g", "shock at the landing edge, the larger source, 16 % of the motions", |l| {
        shock(l, 0)
    }),
    ranked("edge_acceleration_g_p84", "g", "shock at the landing edge, the larger source, 84 % of the motions", |l| {
        shock(l, 2)
    }),
    number("edge_acceleration_g_max", "g", "largest shock of any motion that it survives", |l| {
        of(l, |found| found.shock.as_ref()?.edge_acceleration_max_g)
    }),
    ranked(
        "edge_acceleration_uplift_g_median",
        "g",
        "shock from the rise of the centre of gravity, median motion",
        |l| lifted(l, 1),
    ),
    ranked("edge_acceleration_uplift_g_p16", "g", "shock from the rise of the centre of gravity, 16 %", |l| {
        lifted(l, 0)
    }),
    ranked("edge_acceleration_uplift_g_p84", "g", "shock from the rise of the centre of gravity, 84 %", |l| {
        lifted(l, 2)
    }),
    number("ceiling_g", "g", "no record gives more shock from the rise of the centre of gravity", |l| {
        of(l, |found| Some(found.shock.as_ref()?.ceiling_g))
    }),
    number("pulse_duration_s", "s", "duration of the pulse, π√(m_eff/k) on a spring", |l| {
        of(l, |found| Some(found.shock.as_ref()?.pulse_duration_s))
    }),
    ranked("velocity_change_m_s", "m/s", "change of the edge's velocity at the median shock", |l| {
        Cell::ranked(l.assessment().and_then(|found| Some(found.shock.as_ref()?.velocity_change_m_s)))
    }),
    count("impacts_above_tolerance", "impacts above the tolerance under the worst motion that it survives", |l| {
        Cell::count(l.assessment().and_then(|found| found.shock.as_ref()?.impacts_above_tolerance))
    }),
    // Its floor, sliding, room.
    number("pfa_g_median", "g", "peak acceleration of its floor, median motion", |l| {
        of(l, |found| Some(found.floor.as_ref()?.pfa_g_median))
    }),
    number("pfa_g_max", "g", "peak acceleration of its floor, largest of all motions", |l| {
        of(l, |found| Some(found.floor.as_ref()?.pfa_g_max))
    }),
    number("pfv_m_s_median", "m/s", "peak velocity of its floor, median motion", |l| {
        of(l, |found| Some(found.floor.as_ref()?.pfv_m_s_median))
    }),
    number("floor_ratio", "1", "median floor acceleration over the peak that is tolerated", |l| {
        of(l, |found| found.capacity.as_ref()?.floor_ratio)
    }),
    text("sliding", "whether it slides: no, possible, yes", |l| {
        of_text(l, |found| Some(found.sliding.as_ref()?.verdict.as_str()))
    }),
    number("friction_low_ratio", "1", "lowest coefficient of friction, stated or assumed", |l| {
        of(l, |found| Some(found.sliding.as_ref()?.friction_ratio.0))
    }),
    number("friction_high_ratio", "1", "highest coefficient of friction, stated or assumed", |l| {
        of(l, |found| Some(found.sliding.as_ref()?.friction_ratio.1))
    }),
    number("clearance_m", "m", "clearance that it needs on every side where it rocks", |l| {
        of(l, |found| found.clearance_m)
    }),
    // What to do.
    number("max_stiffness_n_m", "N/m", "largest stiffness under one edge of a pad that would do", |l| {
        of(l, |found| found.softening.as_ref()?.max_stiffness_n_m)
    }),
    flag("softening_admissible", "whether that pad passes everything that was checked", |l| {
        yes(l.assessment().and_then(|found| Some(found.softening.as_ref()?.admissible)))
    }),
    number("softened_edge_acceleration_g", "g", "shock on that pad from the motions that were run again", |l| {
        of(l, |found| found.softening.as_ref()?.edge_acceleration_g)
    }),
    number("pad_stroke_m", "m", "largest compression of that pad", |l| {
        of(l, |found| found.softening.as_ref()?.stroke_m)
    }),
    number("restraint_force_n", "N", "largest horizontal force to fix it with, of all the sources", |l| {
        of(l, |found| largest(found, |force| force.force_n))
    }),
    text("restraint_source", "clause that this force is from", |l| {
        of_text(l, |found| Some(strongest(found, |force| force.force_n)?.source.as_str()))
    }),
    number("anchor_tension_n", "N", "largest tension of all the anchors along one edge, of all the sources", |l| {
        of(l, |found| largest(found, |force| force.anchor_tension_n))
    }),
    // What it was computed with.
    text("tolerance", "what it stands, in words", |l| {
        of_text(l, |found| found.capacity.as_ref().map(|capacity| capacity.tolerance.as_str()))
    }),
    number("tolerance_g", "g", "peak acceleration that it stands", |l| {
        of_item(l, |item| Some(item.tolerance.as_ref()?.peak_m_s2? / G0_M_S2))
    }),
    number("tolerance_duration_s", "s", "duration of the half-sine of that peak", |l| {
        of_item(l, |item| item.tolerance.as_ref()?.duration_s)
    }),
    number("tolerance_velocity_change_m_s", "m/s", "velocity change below which no peak does harm", |l| {
        of_item(l, |item| item.tolerance.as_ref()?.velocity_change_m_s)
    }),
    number("tolerance_edge_lift_m", "m", "lift of one edge from which it may fall back", |l| {
        of_item(l, |item| item.tolerance.as_ref()?.edge_lift_m)
    }),
    text("tolerance_source", "where the tolerance is from", |l| {
        l.item.tolerance.as_ref().map_or(Cell::Missing, |tolerance| Cell::text(&tolerance.source))
    }),
    flag("tolerance_decides", "whether that source may decide; a recalled one may not", |l| {
        yes(l.item.tolerance.as_ref().map(|tolerance| tolerance.confidence.decides()))
    }),
    number("height_m", "m", "height", |l| of_item(l, |item| item.height_m)),
    number("thickness_m", "m", "side in the first plane of motion", |l| of_item(l, |item| item.thickness_m)),
    number("width_m", "m", "the other side; empty: looked at about one axis only", |l| of_item(l, |item| item.width_m)),
    number("base_thickness_m", "m", "distance between the pivot edges in the direction of the thickness", |l| {
        of_item(l, |item| item.base_thickness_m.or(item.thickness_m))
    }),
    number("base_width_m", "m", "distance between the pivot edges in the direction of the width", |l| {
        of_item(l, |item| item.base_width_m.or(item.width_m))
    }),
    number("cg_height_m", "m", "height of the centre of gravity; half the height where nobody says", |l| {
        of_item(l, |item| item.cg_height_m.or(item.height_m.map(|height_m| 0.5 * height_m)))
    }),
    number("mass_kg", "kg", "mass", |l| of_item(l, |item| item.mass_kg)),
    number("stiffness_n_m", "N/m", "stiffness under one edge; empty for a law that has none", |l| {
        of_item(l, |item| item.cushion.as_ref()?.cushion.linear_stiffness_n_m())
    }),
    text("cushion", "what stands under one edge", |l| {
        Cell::owned(l.item.cushion.as_ref().map(|edge| cushion_words(&edge.cushion)))
    }),
    text("cushion_source", "where the cushion is from, where it is from the library", |l| {
        l.item.cushion_source.as_deref().map_or(Cell::Missing, Cell::text)
    }),
    number("restitution", "1", "restitution of the motion as stated; empty: Housner's of the block", |l| {
        of_item(l, |item| match item.restitution {
            Restitution::Value(value) => Some(value),
            Restitution::Housner | Restitution::Factor(_) => None,
        })
    }),
    number("restitution_factor", "1", "factor on Housner's restitution as stated", |l| {
        of_item(l, |item| match item.restitution {
            Restitution::Factor(factor) => Some(factor),
            Restitution::Housner | Restitution::Value(_) => None,
        })
    }),
    number("compliant_shock_ratio", "1", "shock on the compliant base over that of Eq. (5)", |l| {
        of(l, |found| found.compliant.as_ref()?.shock_ratio)
    }),
    flag("compliant_agrees", "whether the compliant base leads to the same decision", |l| {
        yes(l.assessment().and_then(|found| found.compliant.as_ref()).map(|compliant| compliant.agrees))
    }),
    text("notes", "notes of the inventory", |l| Cell::text(&l.item.notes)),
    text("remarks", "assumptions and doubts about this object", |l| {
        Cell::owned(l.assessment().map(|found| found.notes.join(" ")))
    }),
];

/// Why a row has no decision.
const NOT_ASSESSED: &str = "Partial result: not assessed yet, the run was stopped before.";

type Extract = for<'a> fn(&Line<'a>) -> Cell<'a>;

const fn text(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column { name, kind: Kind::Text, unit: "–", meaning, cell }
}

const fn count(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column { name, kind: Kind::Count, unit: "–", meaning, cell }
}

const fn number(name: &'static str, unit: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column { name, kind: Kind::Number, unit, meaning, cell }
}

const fn ranked(name: &'static str, unit: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column { name, kind: Kind::Ranked, unit, meaning, cell }
}

const fn flag(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column { name, kind: Kind::Flag, unit: "–", meaning, cell }
}

fn yes<'a>(flag: Option<bool>) -> Cell<'a> {
    flag.map_or(Cell::Missing, Cell::Flag)
}

fn of_item<'a>(line: &Line<'a>, value: fn(&Item) -> Option<f64>) -> Cell<'a> {
    Cell::number(value(line.item))
}

fn of<'a>(line: &Line<'a>, value: fn(&Assessment) -> Option<f64>) -> Cell<'a> {
    Cell::number(line.assessment().and_then(value))
}

fn of_text<'a>(line: &Line<'a>, text: for<'t> fn(&'t Assessment) -> Option<&'t str>) -> Cell<'a> {
    line.assessment().and_then(text).map_or(Cell::Missing, Cell::text)
}

fn chance<'a>(
    line: &Line<'a>,
    chance: fn(&Assessment) -> Option<Probability>,
    value: fn(&Probability) -> f64,
) -> Cell<'a> {
    Cell::number(line.assessment().and_then(chance).map(|probability| value(&probability)))
}

fn lift<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let response = line.assessment().and_then(|found| found.response.as_ref());
    Cell::ranked(response.and_then(|response| response.uplift_m.get(quantile)).copied())
}

fn shock<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let shock = line.assessment().and_then(|found| found.shock.as_ref());
    Cell::ranked(shock.and_then(|shock| shock.edge_acceleration_g.get(quantile)).copied())
}

fn lifted<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let shock = line.assessment().and_then(|found| found.shock.as_ref());
    Cell::ranked(shock.and_then(|shock| shock.edge_acceleration_uplift_g.get(quantile)).copied())
}

fn rating<'a>(rating: Option<Rating>) -> Cell<'a> {
    Cell::text(match rating {
        None => "",
        Some(Rating::High) => "H",
        Some(Rating::Medium) => "M",
        Some(Rating::Low) => "L",
    })
}

/// The force that needs most; the first of two alike.
pub(crate) fn strongest(found: &Assessment, need: fn(&RestraintForce) -> f64) -> Option<&RestraintForce> {
    found.restraint.iter().reduce(|most, next| if need(next) > need(most) { next } else { most })
}

fn largest(found: &Assessment, need: fn(&RestraintForce) -> f64) -> Option<f64> {
    strongest(found, need).map(need)
}
