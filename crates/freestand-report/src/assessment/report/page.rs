//! The page of one object. What a reader decides by comes first and is compact, so that a long list
//! prints on few sheets; how it was calculated follows, folded.

use std::fmt::Write;

use crate::assessment::compared::{comparison, tolerance};
use crate::assessment::overview::place;
use crate::assessment::plan::options_html;
use crate::assessment::reasons::{self, softer_pad};
use crate::assessment::words::{exceeded, falls, margin, probability, ranked, ranked_milli, tier};
use crate::restraint::force::{note, source_name};
use freestand_assess::restraint::source::SourceKind;
use freestand_assess::result::{
    Assessment, AxisResponse, ModelAnswers, ObjectModel, OnPads, OnRigidBase, Ranked,
    RestraintForce, Shares, Softening,
};
use freestand_input::words::{counted, fixed, number, percent};
use freestand_inventory::{Inventory, Item};
use freestand_output::html::{Cell, classed_table, figure, list, table, words as text};
use freestand_risk::budget::PlanRow;
use freestand_study::cushion::cushion_words;
use maud::{Markup, html};

use super::drawing::sketch;
use super::equations::equations;
use super::summary::{badge, kilonewtons};
use super::{anchor, name, words};

/// The page of one object.
pub(super) fn page(
    inventory: &Inventory,
    item: &Item,
    rank: usize,
    found: &Assessment,
    options: &[&PlanRow],
) -> Markup {
    html! {
        section.object #(anchor(rank)) {
            div.name {
                p.up { a href="#first" { "Rank " (rank) } }
                h2 { (name(&item.id)) " " span.what { (name(&item.item)) } }
            }
            div.verdict.(found.decision.name()) {
                (badge(found.decision)) " " span { (words(&reasons::why(item, found))) }
            }
            div.two {
                (pairs(&verdict_figures(item, found)))
                (pairs(&object_figures(item, found)))
                (sketch(item))
            }
            (response(found))
            (what_to_do(found))
            (options_html(options))
            (paragraph(&reasons::notes(item, found)))
            details {
                summary { "How it was calculated" }
                (calculation(inventory, item, found))
            }
        }
    }
}

/// A paragraph, if there is something to say.
fn paragraph(said: &str) -> Markup {
    html! { @if !said.is_empty() { p { (words(said)) } } }
}

/// Names and values; empty ones are left out.
fn pairs(rows: &[(&str, String)]) -> Markup {
    let stated = rows.iter().filter(|(_, value)| !value.is_empty());
    let rows = stated.map(|(key, value)| [text(key), text(words(value))]);
    classed_table("pairs", "", &[], rows)
}

/// The numbers on which the verdict is based.
fn verdict_figures(item: &Item, found: &Assessment) -> Vec<(&'static str, String)> {
    let known = |p: bool, said: String| if p { said } else { String::new() };
    let model = if found.decides_on_pads() {
        "on its pads"
    } else {
        "on a rigid base"
    };
    let worlds = found.answers.as_ref().map_or_else(String::new, |answers| {
        format!(
            "{} of at most {}",
            counted(answers.worlds as usize, "world"),
            answers.worlds_cap
        )
    });
    let by = match (found.model, found.tier) {
        (Some(ObjectModel::Roll), _) => "the model on casters",
        (Some(ObjectModel::Slide), _) => "the model of sliding",
        (Some(ObjectModel::Spatial), _) => "the model in three dimensions, on its pads",
        (Some(ObjectModel::Stack), _) => "the model of a stack, on its pads",
        (Some(ObjectModel::Hull), _) => "the model in three dimensions, on a stiff floor",
        (Some(ObjectModel::RockWall), 0) => "the model on a rigid base: it does not rock",
        (_, by) => tier(by),
    };
    let decided = match by {
        "" => worlds,
        by if worlds.is_empty() => by.to_owned(),
        by => format!("{by}; {worlds}"),
    };
    let shock = found
        .edge_acceleration_g_median()
        .map_or_else(String::new, |shock| ranked(shock, "g"));
    let mut rows = vec![
        (
            "Falls over",
            known(found.p_overturn.is_some(), falls(found)),
        ),
        (
            "Tolerance exceeded",
            known(found.p_exceed.is_some(), exceeded(found)),
        ),
        (
            "Accepted",
            format!(
                "{} ({})",
                percent(found.accepted_ratio, 0),
                found.accepted_for.name()
            ),
        ),
        ("Demand/capacity", margin(found)),
        ("Median shock", shock),
        (
            "These two are",
            known(
                found.answers.is_some() && found.shock.is_some(),
                model.to_owned(),
            ),
        ),
        ("Model", model_words(found)),
        ("Calculated with", decided),
    ];
    if let Some(space) = &found.in_space {
        let degrees = |tilt: Ranked| match tilt {
            Ranked::Value(tilt_rad) => format!("{}°", number(tilt_rad.to_degrees(), 2)),
            Ranked::Overturned | Ranked::NoData => ranked(tilt, "rad"),
        };
        let milli = |walk: Ranked| ranked_milli(walk, "mm");
        let both = |median: String, p84: String| format!("median {median}, 84 % {p84}");
        rows.push((
            "Tilt",
            both(degrees(space.tilt_rad_median), degrees(space.tilt_rad_p84)),
        ));
        rows.push((
            "Walk of its base",
            both(milli(space.walk_m_median), milli(space.walk_m_p84)),
        ));
    }
    if let Some(stacked) = &found.stacked {
        let falls = format!(
            "{} of {} worlds; the object itself: {}",
            stacked.upper_falls, stacked.worlds, stacked.lower_falls
        );
        rows.push(("What stands on it falls first", falls));
        rows.push((
            "It rocks alone from",
            format!("{} g", number(stacked.threshold_upper_g, 3)),
        ));
        rows.push((
            "Both rock together from",
            format!("{} g", number(stacked.threshold_together_g, 3)),
        ));
    }
    match (&found.capacity, &item.tolerance) {
        (Some(capacity), _) => {
            let recalled = if capacity.tolerance.decides {
                ""
            } else {
                "; recalled without a source, so no verdict depends on it"
            };
            rows.push(("Governing criterion", capacity.governing.name().to_owned()));
            rows.push(("Tolerance", tolerance(&capacity.tolerance)));
            rows.push(("Its source", format!("{}{recalled}", capacity.source)));
        }
        (None, Some(tolerance)) => rows.push(("Source of the tolerance", tolerance.source.clone())),
        (None, None) => rows.push(("Tolerance", "not given".to_owned())),
    }
    rows
}

/// The model of the object, and why it is this one.
fn model_words(found: &Assessment) -> String {
    let why = match found.model {
        None => return String::new(),
        Some(ObjectModel::Rock) => {
            "it stands freely; mass or pads are not given, or the study does not follow them"
        }
        Some(ObjectModel::RockWall) => "it stands beside a wall or neighbours",
        Some(ObjectModel::Roll) => "its casters are free, so it does not rock",
        Some(ObjectModel::Slide) => {
            "its friction is at most half its base over the height of its centre of gravity, so it slides and does not rock"
        }
        Some(ObjectModel::Compliant) => "it stands freely, and mass and pads are given",
        Some(ObjectModel::Spatial) => {
            "the study asks for three dimensions, and mass, pads and width are given"
        }
        Some(ObjectModel::Stack) => "another object stands on it",
        Some(ObjectModel::Hull) => "it is round, so it moves in three dimensions on its rim",
    };
    format!("{}: {why}", found.model.map_or("", ObjectModel::name))
}

/// What the object is, and where it is.
fn object_figures(item: &Item, found: &Assessment) -> Vec<(&'static str, String)> {
    let mut rows = vec![
        ("Place", place(item)),
        ("Quantity", item.quantity.to_string()),
        ("Consequences", consequences(item)),
    ];
    if let Some(floor) = &found.floor {
        rows.push(("Level", fixed(floor.level_ratio, 2)));
        let (median, most) = (number(floor.pfa_g_median, 3), number(floor.pfa_g_max, 3));
        rows.push(("PFA", format!("median {median} g, largest {most} g")));
        rows.push((
            "Median PFV",
            format!("{} m/s", number(floor.pfv_m_s_median, 3)),
        ));
    }
    rows.push((
        "Mass",
        item.mass_kg.map_or_else(
            || "not given".to_owned(),
            |mass_kg| format!("{} kg", number(mass_kg, 5)),
        ),
    ));
    rows.push(("Cushion, one edge", cushion(item)));
    rows
}

fn cushion(item: &Item) -> String {
    let Some(edge) = &item.cushion else {
        return "not given".to_owned();
    };
    let source = item
        .cushion_source
        .as_ref()
        .map_or_else(String::new, |source| format!(" ({source})"));
    format!("{}{source}", cushion_words(&edge.cushion))
}

fn consequences(item: &Item) -> String {
    let rated = [
        ("life safety", item.consequences.life_safety),
        ("property", item.consequences.property),
        ("function", item.consequences.function),
    ];
    let words = rated
        .into_iter()
        .filter_map(|(name, rating)| Some(format!("{name} {}", rating?.name())));
    words.collect::<Vec<_>>().join(", ")
}

/// What both models say, a row for each.
fn response(found: &Assessment) -> Markup {
    let rows = found.answers.as_ref().map_or_else(Vec::new, |answers| {
        let rigid = answers.rigid.as_ref().zip(found.response.as_ref());
        let pads = answers.compliant.as_ref().zip(found.on_pads.as_ref());
        let rigid = rigid.map(|(model, response)| on_rigid_base(found, model, response));
        let pads = pads.map(|(model, pads)| on_pads(found, model, pads));
        rigid.into_iter().chain(pads).collect()
    });
    if rows.is_empty() {
        return html! { p { "Its response was not calculated; the reason is given above." } };
    }
    let headings = [
        text("Model"),
        figure("Falls over"),
        figure("Tolerance exceeded"),
        figure("Lifts an edge"),
        figure("Median uplift (16 to 84 %)"),
        figure("Median shock (16 to 84 %)"),
    ];
    html! {
        (table("", &headings, rows))
        (paragraph(&in_brief(found)))
    }
}

fn on_rigid_base(found: &Assessment, model: &ModelAnswers, response: &OnRigidBase) -> [Cell; 6] {
    let base = match found.model {
        Some(ObjectModel::Roll) => "on its casters",
        Some(ObjectModel::Slide) => "sliding",
        _ => "rigid base, Eq. (5)",
    };
    let shocks = found.shock.as_ref().map(|shock| shock.edge_acceleration_g);
    let [falls, exceeds] = chances(model);
    [
        text(base),
        falls,
        exceeds,
        figure(percent(response.uplift_share, 0)),
        figure(quantiles(response.uplift_m, |lift| {
            ranked_milli(lift, "mm")
        })),
        figure(shocks.map_or_else(
            || "–".to_owned(),
            |shocks| quantiles(shocks, |g| ranked(g, "g")),
        )),
    ]
}

fn on_pads(found: &Assessment, model: &ModelAnswers, pads: &OnPads) -> [Cell; 6] {
    let base = match found.model {
        Some(ObjectModel::Spatial) => "in three dimensions, on its pads",
        Some(ObjectModel::Stack) => "with what stands on it, on pads",
        _ => "on its pads",
    };
    let [falls, exceeds] = chances(model);
    [
        text(base),
        falls,
        exceeds,
        figure(percent(pads.let_go_share, 0)),
        figure(said(pads.lift_m_median, |lift| ranked_milli(lift, "mm"))),
        figure(said(pads.edge_acceleration_g_median, |g| ranked(g, "g"))),
    ]
}

/// The probabilities that an object falls and that its tolerance is exceeded, by one model.
fn chances(model: &ModelAnswers) -> [Cell; 2] {
    let exceed = model.exceed.map_or_else(|| "–".to_owned(), probability);
    [figure(probability(model.overturn)), figure(exceed)]
}

/// A median; in words where at least half of the worlds overturn the object.
fn said(value: Ranked, shown: impl Fn(Ranked) -> String) -> String {
    match value {
        Ranked::Overturned => "half or more overturn".to_owned(),
        other => shown(other),
    }
}

/// The median, and the values that 16 and 84 % of the worlds do not exceed.
fn quantiles([low, median, high]: [Ranked; 3], shown: impl Fn(Ranked) -> String) -> String {
    match (median, high) {
        (Ranked::Overturned | Ranked::NoData, _) => said(median, shown),
        (_, Ranked::Overturned) => format!("{} ({} to overturned)", shown(median), shown(low)),
        _ => format!("{} ({} to {})", shown(median), shown(low), shown(high)),
    }
}

/// Sliding, clearance, and what the answer depends on, in one paragraph.
fn in_brief(found: &Assessment) -> String {
    let mut said: Vec<String> = Vec::new();
    if let Some(response) = found
        .response
        .as_ref()
        .filter(|response| response.failed > 0)
    {
        let reason = response
            .failure
            .as_deref()
            .unwrap_or("the reason is not known");
        said.push(format!(
            "The histories in {} failed: {reason}.",
            counted(response.failed, "further world")
        ));
    }
    // What rolls is told by its travel.
    if let Some(sliding) = found.sliding.as_ref().filter(|_| found.rolled.is_none()) {
        let (low, high) = sliding.friction_ratio;
        let origin = if sliding.is_stated {
            "stated"
        } else {
            "assumed"
        };
        let (low, high) = (number(low, 3), number(high, 3));
        let verdict = sliding.verdict.name();
        said.push(format!(
            "Sliding: {verdict} (coefficient of friction {low} to {high}, {origin})."
        ));
    }
    if let Some(rolled) = &found.rolled {
        let margin = rolled.trip_margin().map_or_else(String::new, |margin| {
            format!(
                " The speed that overturns it at its stop is {} times that of 84 % of the worlds.",
                number(margin, 3)
            )
        });
        let how = if found.model == Some(ObjectModel::Slide) {
            "Sliding"
        } else {
            "Travel on its casters"
        };
        said.push(format!(
            "{how} to one side: median {} mm, {} mm in 84 % of the worlds. Nothing overturns it without a \
             stop.{margin}",
            number(1e3 * rolled.travel_m_median, 3),
            number(1e3 * rolled.travel_m_p84, 3)
        ));
    }
    if let Some(at_wall) = &found.at_wall {
        let shock = at_wall.acceleration_g_median.map_or_else(
            || "its shock there is not known".to_owned(),
            |shock_g| {
                format!(
                    "shock there, apart from that on the floor, {} g",
                    number(shock_g, 3)
                )
            },
        );
        said.push(format!(
            "Its wall: struck in {} of the worlds; median world: speed {} m/s, {shock}. It ends leaning on it in {}.",
            percent(at_wall.strike_share, 0),
            number(at_wall.speed_m_s_median, 3),
            percent(at_wall.lean_share, 1)
        ));
    }
    if let Some(clearance_m) = found.clearance_m {
        said.push(format!(
            "Clearance needed on every side: {} mm.",
            number((1e3 * clearance_m).ceil(), 6)
        ));
    }
    if let Some(shares) = &found.shares {
        said.extend(depends_on(shares));
    }
    if let Some(per_year) = &found.per_year {
        let at_least = if per_year.is_at_least {
            "at least "
        } else {
            ""
        };
        let exceed = per_year.exceed.map_or_else(String::new, |p| {
            format!(
                "; that its tolerance is exceeded, {at_least}{}",
                number(p, 2)
            )
        });
        said.push(format!(
            "Probability per year that it falls: {at_least}{}{exceed}. It does not decide.",
            number(per_year.overturn, 2)
        ));
    }
    said.join(" ")
}

/// The groups of unknowns, the one that matters most first, and what to measure.
fn depends_on(shares: &Shares) -> Vec<String> {
    let mut known: Vec<_> = shares
        .by_group
        .iter()
        .filter_map(|(cause, share)| Some((cause, (*share)?)))
        .collect();
    known.sort_by(|a, b| b.1.total_cmp(&a.1));
    let named: Vec<String> = known
        .iter()
        .map(|(cause, share)| format!("{} {}", cause.name(), percent(*share, 0)))
        .collect();
    let mut said = Vec::new();
    if !named.is_empty() {
        said.push(format!("The answer depends on: {}.", named.join(", ")));
    }
    if let Some(first) = &shares.measure_first {
        said.push(format!(
            "Measure first: {}. At its 10 % point the probability is {}, at its 90 % point {}: on both sides of the \
             accepted one.",
            first.cause.name(),
            percent(first.low_ratio, 0),
            percent(first.high_ratio, 0)
        ));
    }
    said
}

fn what_to_do(found: &Assessment) -> Markup {
    let design = found
        .restraint
        .iter()
        .filter(|force| force.source.kind != SourceKind::OtherCode);
    let is_held = found
        .design_force()
        .is_some_and(|force| force.anchor_tension_n <= 0.0);
    html! {
        @if let Some(softening) = &found.softening {
            p {
                (words(&softer_words(softening))) " Check: " (words(&softer_pad(softening, found.accepted_ratio)))
            }
        }
        (forces(design))
        @if is_held { p { "No tension: its weight holds it down." } }
    }
}

/// What is said of a softer pad.
fn softer_words(softening: &Softening) -> String {
    let mut said = match softening.max_stiffness_n_m {
        Some(stiffness) => format!(
            "A softer pad: at most {} N/mm under one edge; it {} every check.",
            number(1e-3 * stiffness, 3),
            if softening.admissible() {
                "passed"
            } else {
                "did not pass"
            }
        ),
        None => "A softer pad: no stiffness suffices.".to_owned(),
    };
    if let Some(stroke_m) = softening.stroke_m {
        let (stroke, pad) = (
            number(1e3 * stroke_m, 3),
            number(1e3 * softening.pad_thickness_m, 3),
        );
        let _ = write!(
            said,
            " It is {pad} mm thick and is compressed by {stroke} mm."
        );
    }
    if let Some(shock_g) = softening.edge_acceleration_g {
        let _ = write!(
            said,
            " The median shock on this pad is {} g.",
            number(shock_g, 3)
        );
    }
    said
}

/// The clause of a force, and whether something of it is quoted from memory.
fn by(force: &RestraintForce) -> String {
    let name = source_name(&force.source);
    match force.source.is_recalled() {
        true => format!("{name} (confidence: recalled)"),
        false => name.to_owned(),
    }
}

/// Forces of a restraint, a row for each source; nothing where there are none.
fn forces<'a>(forces: impl Iterator<Item = &'a RestraintForce>) -> Markup {
    let tension = |force_n: f64| {
        if force_n > 0.0 {
            kilonewtons(force_n)
        } else {
            "none".to_owned()
        }
    };
    let row = |force: &RestraintForce| {
        [
            text(name(&by(force))),
            figure(kilonewtons(force.force_n)),
            figure(number(force.force_ratio(), 3)),
            figure(tension(force.anchor_tension_n)),
            figure(tension(force.anchor_tension_concrete_n)),
            figure(format!("{} mm", number(1e3 * force.bracket_height_m, 4))),
            figure(kilonewtons(force.bracket_force_n)),
            figure(kilonewtons(force.bracket_force_concrete_n)),
            figure(kilonewtons(force.bracket_base_shear_n)),
        ]
    };
    let headings = [
        text("Force of a restraint by"),
        figure("Force"),
        figure("Force/weight"),
        figure("Tension along one edge"),
        figure("in concrete"),
        figure("Or a bracket at"),
        figure("Force"),
        figure("in concrete"),
        figure("at the feet"),
    ];
    let mut forces = forces.peekable();
    html! {
        @if forces.peek().is_some() { (table("", &headings, forces.map(row))) }
    }
}

/// Everything that a reviewer needs besides: both axes, formulas, equations, comparisons.
fn calculation(inventory: &Inventory, item: &Item, found: &Assessment) -> Markup {
    let known = |value: Option<f64>, unit: &str| {
        value.map_or_else(
            || "–".to_owned(),
            |value| format!("{} {unit}", number(value, 3)),
        )
    };
    let has_shares = found
        .shares
        .as_ref()
        .is_some_and(|shares| shares.by_group.iter().any(|(_, share)| share.is_some()));
    let other_codes = found
        .restraint
        .iter()
        .filter(|force| force.source.kind == SourceKind::OtherCode);
    html! {
        @if let Some(response) = &found.response {
            h3 { "Both sides of the object, on a rigid base" }
            (axes(&response.axes))
            p { "At most " (counted(response.impacts_max, "impact")) " in one world." }
        }
        @if let Some(shock) = &found.shock {
            p {
                "Duration of the pulse: " (number(1e3 * shock.pulse_duration_s, 3)) " ms; median velocity change: "
                (said(shock.velocity_change_m_s, |v| ranked(v, "m/s"))) "."
                @if let Some(impacts) = shock.impacts_above_tolerance {
                    " Impacts above the peak of its tolerance, in the hardest world that does not overturn it: "
                    (impacts) "."
                }
                @if let Some(ratio) = found.capacity.as_ref().and_then(|capacity| capacity.floor_ratio) {
                    " Median PFA over tolerance: " (number(ratio, 3)) "."
                }
            }
        }
        @if let Some(pads) = &found.on_pads {
            p {
                "On its pads it rocks at " (known(pads.rocking_frequency_hz, "Hz"))
                " with both edges down; a steady " (known(pads.pad_uplift_threshold_g, "g"))
                " lifts an edge off its pad."
            }
        }
        @if has_shares {
            p {
                "What the answer depends on: each share is that of worlds in which the answer changes if only this value is \
                 drawn again, divided by that of two unrelated worlds. The shares of values that act together overlap."
            }
        }
        @if !found.restraint.is_empty() {
            h3 { "Forces of the restraint" }
            (forces(other_codes))
            dl {
                @for force in &found.restraint {
                    dt { (name(source_name(&force.source))) }
                    dd { (words(&note(force))) }
                }
            }
        }
        @if let Some(chain) = &found.chain {
            h3 { "The shock, step by step" }
            (equations(item, chain))
        }
        (comparisons(inventory, item, found))
    }
}

fn axes(axes: &[AxisResponse]) -> Markup {
    let headings = [
        text("Side in the plane of rocking"),
        figure("Slenderness angle"),
        figure("R"),
        figure("Uplift threshold"),
        figure("Worlds with uplift"),
        figure("Worlds that overturn it"),
        figure("Shock 16 %"),
        figure("median"),
        figure("84 %"),
        figure("Ceiling"),
    ];
    let rows = axes.iter().map(|axis| {
        let mut cells = vec![
            text(axis.axis.name()),
            figure(format!(
                "{}°",
                fixed(axis.slenderness_angle_rad.to_degrees(), 1)
            )),
            figure(format!("{} mm", number(1e3 * axis.half_diagonal_m, 4))),
            figure(format!("{} g", number(axis.uplift_threshold_g, 3))),
            figure(percent(axis.uplift_share, 0)),
            figure(percent(axis.overturn_share, 0)),
        ];
        match axis.edge_acceleration_g {
            Some(shocks) => cells.extend(shocks.map(|g| figure(ranked(g, "g")))),
            None => cells.push(text("mass or cushion not given").class("over").over(3)),
        }
        cells.push(figure(
            axis.ceiling_g
                .map_or_else(|| "–".to_owned(), |g| format!("{} g", number(g, 3))),
        ));
        cells
    });
    table("", &headings, rows)
}

/// Comparisons with published numbers, and the other columns of the inventory.
fn comparisons(inventory: &Inventory, item: &Item, found: &Assessment) -> Markup {
    let compared = found
        .comparisons
        .iter()
        .filter_map(|one| Some(comparison(one, found.floor.as_ref()?)));
    let notes = (!item.notes.is_empty()).then(|| format!("Notes: {}", item.notes));
    let cells = inventory
        .carried
        .iter()
        .zip(&item.carried)
        .filter(|(_, cell)| !cell.is_empty())
        .take(MAX_CARRIED)
        .map(|(header, cell)| format!("{header}: {cell}"));
    let titled = [
        ("Comparison with published numbers", compared.collect()),
        (
            "Other columns of the list",
            notes.into_iter().chain(cells).collect::<Vec<String>>(),
        ),
    ];
    html! {
        @for (title, lines) in titled {
            @if !lines.is_empty() {
                h3 { (title) }
                (list(lines.iter().map(|line| words(line))))
            }
        }
    }
}

/// Largest number of other columns of the inventory on a page.
const MAX_CARRIED: usize = 30;

#[cfg(test)]
mod tests {
    use super::*;

    /// An object without geometry, level, mass and tolerance has a page, which says what is
    /// missing.
    #[test]
    fn a_bare_object_has_a_page() {
        let inventory = crate::assessment::fixture::inventory(vec![]);
        let item = crate::assessment::fixture::hostile_items().pop().unwrap();
        let html = page(
            &inventory,
            &item,
            3,
            &crate::assessment::fixture::unknown(&item),
            &[],
        )
        .0;
        for said in [
            "NO VERDICT",
            "Nothing was assessed, because its height, its thickness and its floor level were not given.",
            "not given",
            "was not calculated",
        ] {
            assert!(html.contains(said), "{said}: {html}");
        }
        assert!(!html.contains("step by step") && !html.contains("<svg"));
        assert_eq!(ranked_milli(Ranked::Value(0.0305), "mm"), "30.5 mm");
    }
}
