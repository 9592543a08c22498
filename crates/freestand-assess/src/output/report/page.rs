//! The page of one object.

use std::fmt::Write;

use crate::inventory::{Inventory, Item, Rating};
use crate::output::overview::place;
use crate::output::words::{margin, probability, ranked, ranked_milli, tier};
use crate::result::{Assessment, AxisResponse, ModelAnswers, Probability, Response, RestraintForce, RestraintKind};
use freestand_input::words::{counted, fixed, number, percent};
use freestand_output::html::{Cell, classed_table, figure, heading, markup, paragraph, table, words as text};
use freestand_study::cushion::cushion_words;
use freestand_study::result::Ranked;

use super::drawing::sketch;
use super::equations::equations;
use super::summary::badge;
use super::{anchor, name, words};

/// The page of one object.
pub(super) fn page(inventory: &Inventory, item: &Item, rank: usize, found: &Assessment) -> String {
    let mut html = format!("<section class=\"object\" id=\"{}\">\n", anchor(rank));
    let _ = writeln!(
        html,
        "<div class=\"name\">\n<p class=\"up\"><a href=\"#first\">Rank {rank}</a></p>\n\
         <h2>{} <span class=\"what\">{}</span></h2>\n</div>",
        name(&item.id),
        name(&item.item)
    );
    let _ = writeln!(
        html,
        "<div class=\"verdict {}\">{} <span>{}</span></div>",
        found.decision.name(),
        badge(found.decision),
        words(&found.why)
    );
    html.push_str("<div class=\"two\">\n");
    html.push_str(&pairs(&verdict_figures(item, found)));
    html.push_str("<div class=\"thing\">\n");
    html.push_str(&sketch(item));
    html.push_str(&pairs(&object_figures(item, found)));
    html.push_str("</div>\n</div>\n");
    html.push_str(&response(found));
    html.push_str(&what_it_depends_on(found));
    html.push_str(&what_to_do(found));
    if let Some(chain) = &found.chain {
        html.push_str(&heading("The shock, step by step"));
        html.push_str(&equations(item, chain));
    }
    html.push_str(&comparisons_and_notes(inventory, item, found));
    html.push_str("</section>\n");
    html
}

/// Names and values; empty ones are left out.
fn pairs(rows: &[(&str, String)]) -> String {
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(key, value)| vec![text(key), markup(words(value), "")])
        .collect();
    classed_table("pairs", "", &[], &rows)
}

/// The numbers on which the verdict is based.
fn verdict_figures(item: &Item, found: &Assessment) -> Vec<(&'static str, String)> {
    let overturn = found.p_overturn.map_or_else(String::new, probability);
    let exceed = found.p_exceed.map_or_else(String::new, probability);
    let accepted = format!("{} ({})", percent(found.accepted_ratio, 0), found.accepted_for.name());
    let worlds = found.answers.as_ref().map_or_else(String::new, |answers| {
        format!("{} of at most {}", counted(answers.worlds as usize, "world"), answers.worlds_cap)
    });
    let mut rows = vec![
        ("Demand/capacity", margin(found)),
        ("Probability of exceeding the tolerance", exceed),
        ("Probability of overturning", overturn),
        ("Accepted probability", accepted),
        (
            "Decided by",
            [tier(found.tier), &worlds].into_iter().filter(|s| !s.is_empty()).collect::<Vec<_>>().join(", "),
        ),
    ];
    match (&found.capacity, &item.tolerance) {
        (Some(capacity), _) => {
            let recalled =
                if capacity.decides { "" } else { "; recalled without a source, so no verdict depends on it" };
            rows.push(("Governing criterion", capacity.governing.name().to_owned()));
            rows.push(("Tolerance", capacity.tolerance.clone()));
            rows.push(("Source of the tolerance", format!("{}{recalled}", capacity.source)));
            rows.push((
                "Median PFA over tolerance",
                capacity.floor_ratio.map_or_else(String::new, |ratio| number(ratio, 3)),
            ));
        }
        (None, Some(tolerance)) => rows.push(("Source of the tolerance", tolerance.source.clone())),
        (None, None) => rows.push(("Tolerance", "not given".to_owned())),
    }
    rows
}

/// What the object is, and where it is.
fn object_figures(item: &Item, found: &Assessment) -> Vec<(&'static str, String)> {
    let mut rows =
        vec![("Place", place(item)), ("Quantity", item.quantity.to_string()), ("Consequences", consequences(item))];
    if let Some(floor) = &found.floor {
        rows.push((
            "Floor",
            format!(
                "level {}; PFA {} g (median), {} g (largest); PFV {} m/s (median)",
                fixed(floor.level_ratio, 2),
                number(floor.pfa_g_median, 3),
                number(floor.pfa_g_max, 3),
                number(floor.pfv_m_s_median, 3)
            ),
        ));
    }
    rows.push((
        "Mass",
        item.mass_kg.map_or_else(|| "not given".to_owned(), |mass_kg| format!("{} kg", number(mass_kg, 5))),
    ));
    rows.push(("Cushion under one edge", cushion(item)));
    rows
}

fn cushion(item: &Item) -> String {
    let Some(edge) = &item.cushion else { return "not given".to_owned() };
    let source = item.cushion_source.as_ref().map_or_else(String::new, |source| format!(" ({source})"));
    format!("{}{source}", cushion_words(&edge.cushion))
}

fn consequences(item: &Item) -> String {
    let rated = [
        ("life safety", item.consequences.life_safety),
        ("property", item.consequences.property),
        ("function", item.consequences.function),
    ];
    let words = rated.into_iter().filter_map(|(name, rating)| {
        let rating = match rating? {
            Rating::High => "high",
            Rating::Medium => "medium",
            Rating::Low => "low",
        };
        Some(format!("{name} {rating}"))
    });
    words.collect::<Vec<_>>().join(", ")
}

fn response(found: &Assessment) -> String {
    let mut html = heading("Response");
    let Some(response) = &found.response else {
        html.push_str(&paragraph("Its response was not computed; the reason is given with the verdict above."));
        return html;
    };
    html.push_str(&format!("<p>{}</p>\n", words(&response_words(response))));
    html.push_str(&axes(&response.axes));
    if let Some(shock) = &found.shock {
        let mut said = format!(
            "{} Pulse duration: {} ms; median velocity change: {}.",
            quantiles("Shock", shock.edge_acceleration_g, |g| ranked(g, "g")),
            number(1e3 * shock.pulse_duration_s, 3),
            ranked(shock.velocity_change_m_s, "m/s")
        );
        if let Some(impacts) = shock.impacts_above_tolerance {
            let _ = write!(
                said,
                " Impacts above the peak of its tolerance, in the hardest world that does not overturn it: \
                 {impacts}."
            );
        }
        html.push_str(&paragraph(&said));
    }
    let mut said = String::new();
    if let Some(sliding) = &found.sliding {
        let (low, high) = sliding.friction_ratio;
        let origin = if sliding.is_stated { "stated" } else { "assumed" };
        let (low, high) = (number(low, 3), number(high, 3));
        let _ = write!(
            said,
            "Sliding: {} (coefficient of friction {low} to {high}, {origin}; the motion of sliding is not computed). ",
            sliding.verdict.name()
        );
    }
    if let Some(clearance_m) = found.clearance_m {
        let _ = write!(said, "Clearance needed on every side: {} mm.", number((1e3 * clearance_m).ceil(), 6));
    }
    if !said.is_empty() {
        html.push_str(&paragraph(&said));
    }
    html
}

fn response_words(response: &Response) -> String {
    let mut said = format!(
        "On a rigid base it uplifts in {} and overturns in {} of {}. {} At most {} in one world.",
        percent(response.uplift_share, 0),
        percent(response.overturn_share, 0),
        counted(response.motions, "world"),
        quantiles("Uplift", response.uplift_m, |lift| ranked_milli(lift, "mm")),
        counted(response.impacts_max, "impact")
    );
    if response.failed > 0 {
        let reason = response.failure.as_deref().unwrap_or("the reason is not known");
        let _ = write!(said, " The histories in {} failed: {reason}.", counted(response.failed, "further world"));
    }
    said
}

/// The values that 16, 50 and 84 % of the worlds do not exceed, in a sentence.
fn quantiles(name: &str, values: [Ranked; 3], shown: impl Fn(Ranked) -> String) -> String {
    let [low, median, high] = values.map(shown);
    match values {
        [Ranked::Overturned, ..] => "At least 84 % of the worlds overturn it.".to_owned(),
        [_, Ranked::Overturned, _] => format!("At least half of the worlds overturn it. {name} at 16 %: {low}."),
        _ => format!("{name}: median {median}, 16 % {low}, 84 % {high}."),
    }
}

fn axes(axes: &[AxisResponse]) -> String {
    let headings = vec![
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
    let rows: Vec<Vec<Cell>> = axes
        .iter()
        .map(|axis| {
            let mut cells = vec![
                text(axis.axis.name()),
                figure(format!("{}°", fixed(axis.slenderness_angle_rad.to_degrees(), 1))),
                figure(format!("{} m", number(axis.half_diagonal_m, 3))),
                figure(format!("{} g", number(axis.uplift_threshold_g, 3))),
                figure(percent(axis.uplift_share, 0)),
                figure(percent(axis.overturn_share, 0)),
            ];
            match axis.edge_acceleration_g {
                Some(shocks) => cells.extend(shocks.map(|g| figure(ranked(g, "g")))),
                None => cells.push(markup("mass or cushion not given".to_owned(), "over").over(3)),
            }
            cells.push(figure(axis.ceiling_g.map_or_else(|| "–".to_owned(), |g| format!("{} g", number(g, 3)))));
            cells
        })
        .collect();
    table("", &[headings], &rows)
}

/// Both models, what the answer depends on, and what to measure.
fn what_it_depends_on(found: &Assessment) -> String {
    let mut html = String::new();
    if let Some(answers) = &found.answers {
        html.push_str(&heading("The models"));
        let cell = |p: Option<Probability>| figure(p.map_or_else(|| "–".to_owned(), probability));
        let row = |name: &str, model: &ModelAnswers| vec![text(name), cell(Some(model.overturn)), cell(model.exceed)];
        let mut rows = vec![row("Rigid base, Eq. (5)", &answers.rigid)];
        rows.extend(answers.compliant.as_ref().map(|model| row("Compliant base, on its pads", model)));
        let headings = vec![text("Model"), figure("Falls"), figure("Tolerance exceeded")];
        html.push_str(&table("", &[headings], &rows));
        if let Some(pads) = &found.on_pads {
            let number = |value: Option<f64>, unit: &str| {
                value.map_or_else(|| "–".to_owned(), |value| format!("{} {unit}", number(value, 3)))
            };
            html.push_str(&paragraph(&format!(
                "On its pads it rocks at {} with both edges down; a steady {} lifts an edge off its pad, and an edge \
                 leaves its pad in {} of the worlds. The median shock is {}, the median uplift {}.",
                number(pads.rocking_frequency_hz, "Hz"),
                number(pads.pad_uplift_threshold_g, "g"),
                percent(pads.let_go_share, 0),
                ranked(pads.edge_acceleration_g_median, "g"),
                ranked_milli(pads.lift_m_median, "mm")
            )));
        }
    }
    if let Some(shares) = &found.shares {
        let known: Vec<_> = shares.by_group.iter().filter_map(|(cause, share)| Some((cause, (*share)?))).collect();
        if !known.is_empty() {
            html.push_str(&heading("What the answer depends on"));
            let rows: Vec<Vec<Cell>> =
                known.iter().map(|(cause, share)| vec![text(cause.name()), figure(percent(*share, 0))]).collect();
            html.push_str(&table("", &[vec![text("Drawn again alone"), figure("Share")]], &rows));
            html.push_str(&paragraph(
                "The share is that of worlds in which the answer changes if only this value is drawn again, divided by \
                 that of two unrelated worlds. The shares of values that act together overlap.",
            ));
        }
        if let Some((cause, low, high)) = &shares.measure_first {
            html.push_str(&paragraph(&format!(
                "Measure first: {}. At its 10 % point the probability is {}, at its 90 % point {}: on both sides of \
                 the accepted one.",
                cause.name(),
                percent(*low, 0),
                percent(*high, 0)
            )));
        }
    }
    if let Some(per_year) = &found.per_year {
        let at_least = if per_year.is_at_least { "at least " } else { "" };
        let exceed = per_year
            .exceed
            .map_or_else(String::new, |p| format!("; that its tolerance is exceeded, {at_least}{}", number(p, 2)));
        html.push_str(&paragraph(&format!(
            "Probability per year that it falls: {at_least}{}{exceed}. It does not decide.",
            number(per_year.overturn, 2)
        )));
    }
    html
}

fn what_to_do(found: &Assessment) -> String {
    let mut html = String::new();
    if let Some(softening) = &found.softening {
        html.push_str(&heading("A softer pad"));
        let mut said = match softening.max_stiffness_n_m {
            Some(stiffness) => format!(
                "Largest stiffness under one edge: {} kN/m{}.",
                number(1e-3 * stiffness, 3),
                if softening.admissible {
                    ". The pad passed every check"
                } else {
                    ". The pad did not pass every check"
                }
            ),
            None => "No stiffness suffices.".to_owned(),
        };
        if let Some(stroke_m) = softening.stroke_m {
            let (stroke, pad) = (number(1e3 * stroke_m, 3), number(1e3 * softening.pad_thickness_m, 3));
            let _ = write!(said, " It is {pad} mm thick and is compressed by {stroke} mm.");
        }
        if let Some(shock_g) = softening.edge_acceleration_g {
            let _ = write!(said, " The median shock on this pad is {} g.", number(shock_g, 3));
        }
        let _ = writeln!(html, "<p>{} Check: {}</p>", words(&said), words(&softening.note));
    }
    if !found.restraint.is_empty() {
        html.push_str(&heading("Restraint forces"));
        let headings = vec![
            text("Source"),
            figure("Force"),
            figure("Force/weight"),
            figure("Tension of all anchors along one edge"),
            figure("in concrete"),
            figure("Or a bracket"),
            figure("in concrete"),
            figure("with, at the feet"),
            text("Formula"),
        ];
        let force_of = |force_n: f64| format!("{} kN", number(1e-3 * force_n, 3));
        let tension = |force_n: f64| match force_n > 0.0 {
            true => force_of(force_n),
            false => "none: its weight holds it down".to_owned(),
        };
        let source_of = |force: &RestraintForce| match force.kind {
            RestraintKind::OtherCode => format!("For comparison: {}", force.source),
            RestraintKind::OwnCode | RestraintKind::Floor => force.source.clone(),
        };
        let rows: Vec<Vec<Cell>> = found
            .restraint
            .iter()
            .map(|force| {
                let bracket = format!("{} at {} m", force_of(force.bracket_force_n), number(force.bracket_height_m, 3));
                vec![
                    markup(name(&source_of(force)), ""),
                    figure(force_of(force.force_n)),
                    figure(number(force.force_ratio, 3)),
                    figure(tension(force.anchor_tension_n)),
                    figure(tension(force.anchor_tension_concrete_n)),
                    figure(bracket),
                    figure(force_of(force.bracket_force_concrete_n)),
                    figure(force_of(force.bracket_base_shear_n)),
                    markup(words(&force.note), ""),
                ]
            })
            .collect();
        html.push_str(&table("", &[headings], &rows));
    }
    html
}

/// Comparisons with published numbers, notes, and the other columns of the inventory.
fn comparisons_and_notes(inventory: &Inventory, item: &Item, found: &Assessment) -> String {
    let mut html = String::from("<div class=\"beside\">\n");
    let mut add = |title: &str, lines: &[String]| {
        if !lines.is_empty() {
            let _ = writeln!(html, "<div>{}<ul>", heading(title));
            for line in lines {
                let _ = writeln!(html, "<li>{}</li>", words(line));
            }
            html.push_str("</ul></div>\n");
        }
    };
    add("Comparison with published numbers", &found.context);
    add("Notes", &found.notes);
    let mut carried = Vec::new();
    if !item.notes.is_empty() {
        carried.push(format!("Notes: {}", item.notes));
    }
    let cells = inventory.carried.iter().zip(&item.carried).filter(|(_, cell)| !cell.is_empty());
    carried.extend(cells.take(MAX_CARRIED).map(|(header, cell)| format!("{header}: {cell}")));
    add("Other columns of the inventory", &carried);
    html.push_str("</div>\n");
    html
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
        let inventory = crate::output::fixture::inventory(vec![]);
        let item = crate::output::fixture::hostile_items().pop().unwrap();
        let html = page(&inventory, &item, 3, &crate::output::fixture::unknown(&item));
        for said in ["NO VERDICT", "Height, thickness and level are missing.", "not given", "was not computed"] {
            assert!(html.contains(said), "{said}: {html}");
        }
        assert!(!html.contains("step by step") && !html.contains("<svg"));
        assert_eq!(ranked_milli(Ranked::Value(0.0305), "mm"), "30.5 mm");
    }
}
