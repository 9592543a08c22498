//! The page of one object.

use std::fmt::Write;

use crate::assess::overview::place;
use crate::assess::result::{Assessment, AxisResponse, Response};
use crate::assess::words::{margin, probability, ranked, ranked_milli, tier};
use crate::inventory::{Inventory, Item, Rating};
use freestand_input::words::{fixed, number, percent};
use freestand_output::html::{Cell, classed_table, figure, heading, markup, paragraph, table, words as text};
use freestand_study::cushion::cushion_words;

use super::drawing::{Scale, sketch, swing_bar};
use super::equations::equations;
use super::summary::badge;
use super::{anchor, name, words};

/// Everything about one object.
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
    html.push_str(&what_it_does(found));
    html.push_str(&what_would_change_it(found));
    html.push_str(&what_to_do(found));
    if let Some(chain) = &found.chain {
        html.push_str(&heading("The shock, step by step"));
        html.push_str(&equations(item, chain));
    }
    html.push_str(&beside(inventory, item, found));
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

/// What the verdict rests on.
fn verdict_figures(item: &Item, found: &Assessment) -> Vec<(&'static str, String)> {
    let overturn = found.p_overturn.map_or_else(String::new, probability);
    let exceed = found.p_exceed.map_or_else(String::new, probability);
    let accepted = format!("{} ({})", percent(found.accepted_ratio, 0), found.accepted_for);
    let draws = if found.draws == 0 { String::new() } else { format!("{} draws a motion", found.draws) };
    let mut rows = vec![
        ("Margin", margin(found)),
        ("P(a criterion is exceeded)", exceed),
        ("P(it overturns)", overturn),
        ("Accepted", accepted),
        ("Decided by", [tier(found.tier), &draws].into_iter().filter(|s| !s.is_empty()).collect::<Vec<_>>().join(", ")),
    ];
    match (&found.capacity, &item.tolerance) {
        (Some(capacity), _) => {
            let recalled = if capacity.decides { "" } else { "; recalled, decides nothing" };
            rows.push(("Governing", capacity.governing.clone()));
            rows.push(("It stands", capacity.tolerance.clone()));
            rows.push(("Source", format!("{}{recalled}", capacity.source)));
            rows.push((
                "Floor over tolerance",
                capacity.floor_ratio.map_or_else(String::new, |ratio| number(ratio, 3)),
            ));
        }
        (None, Some(tolerance)) => rows.push(("Source of its tolerance", tolerance.source.clone())),
        (None, None) => rows.push(("It stands", "not known".to_owned())),
    }
    rows
}

/// What the object is, and where it stands.
fn object_figures(item: &Item, found: &Assessment) -> Vec<(&'static str, String)> {
    let mut rows =
        vec![("Where", place(item)), ("Quantity", item.quantity.to_string()), ("Consequences", consequences(item))];
    if let Some(floor) = &found.floor {
        rows.push((
            "Its floor",
            format!(
                "level {}; peak acceleration {} g in the median, {} g at most; peak velocity {} m/s",
                fixed(floor.level_ratio, 2),
                number(floor.pfa_g_median, 3),
                number(floor.pfa_g_max, 3),
                number(floor.pfv_m_s_median, 3)
            ),
        ));
    }
    rows.push((
        "Mass",
        item.mass_kg.map_or_else(|| "not stated".to_owned(), |mass_kg| format!("{} kg", number(mass_kg, 5))),
    ));
    rows.push(("Under one edge", cushion(item)));
    rows
}

fn cushion(item: &Item) -> String {
    let Some(edge) = &item.cushion else { return "not stated".to_owned() };
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

fn what_it_does(found: &Assessment) -> String {
    let mut html = heading("What it does");
    let Some(response) = &found.response else {
        html.push_str(&paragraph("It could not be followed: something is missing, see above."));
        return html;
    };
    html.push_str(&format!("<p>{}</p>\n", words(&response_words(response))));
    html.push_str(&axes(&response.axes));
    if let Some(shock) = &found.shock {
        let [low, median, high] = shock.edge_acceleration_g.map(|g| ranked(g, "g"));
        let mut said = format!(
            "Shock at the landing edge: {median} in the median ({low} at 16 %, {high} at 84 % of the motions), for {} ms with a \
             velocity change of {}.",
            number(1e3 * shock.pulse_duration_s, 3),
            ranked(shock.velocity_change_m_s, "m/s")
        );
        if let Some(impacts) = shock.impacts_above_tolerance {
            let _ = write!(said, " Impacts above its tolerance under the worst motion that it survives: {impacts}.");
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
            "Does it slide: {} (friction {low} to {high}, {origin}; sliding itself is not followed). ",
            sliding.verdict
        );
    }
    if let Some(clearance_m) = found.clearance_m {
        let _ = write!(said, "Clearance that it needs on every side: {} mm.", number((1e3 * clearance_m).ceil(), 6));
    }
    if !said.is_empty() {
        html.push_str(&paragraph(&said));
    }
    html
}

fn response_words(response: &Response) -> String {
    let [low, median, high] = response.uplift_m.map(|lift| ranked_milli(lift, "mm"));
    let mut said = format!(
        "Of {} motions it lifts off under {} and overturns under {}. The free edge lifts {median} in the median ({low} at 16 %, {high} \
         at 84 %); {} impacts at most.",
        response.motions,
        percent(response.uplift_share, 0),
        percent(response.overturn_share, 0),
        response.impacts_max
    );
    if response.failed > 0 {
        let reason = response.failure.as_deref().unwrap_or("no reason is known");
        let _ = write!(said, " {} further motions could not be followed: {reason}.", response.failed);
    }
    said
}

fn axes(axes: &[AxisResponse]) -> String {
    let headings = vec![
        text("In its plane of motion"),
        figure("Overturning angle"),
        figure("R"),
        figure("Lifts off at"),
        figure("Lifts off"),
        figure("Overturns"),
        figure("Shock 16 %"),
        figure("median"),
        figure("84 %"),
        figure("Ceiling"),
    ];
    let rows: Vec<Vec<Cell>> = axes
        .iter()
        .map(|axis| {
            let mut cells = vec![
                text(&axis.axis),
                figure(format!("{}°", fixed(axis.slenderness_angle_rad.to_degrees(), 1))),
                figure(format!("{} m", number(axis.half_diagonal_m, 3))),
                figure(format!("{} g", number(axis.uplift_threshold_g, 3))),
                figure(percent(axis.uplift_share, 0)),
                figure(percent(axis.overturn_share, 0)),
            ];
            match axis.edge_acceleration_g {
                Some(shocks) => cells.extend(shocks.map(|g| figure(ranked(g, "g")))),
                None => cells.push(markup("mass or cushion is missing".to_owned(), "over").over(3)),
            }
            cells.push(figure(axis.ceiling_g.map_or_else(|| "–".to_owned(), |g| format!("{} g", number(g, 3)))));
            cells
        })
        .collect();
    table("", &[headings], &rows)
}

fn what_would_change_it(found: &Assessment) -> String {
    if found.tornado.is_empty() {
        return String::new();
    }
    let (measure, limit, of) = match &found.capacity {
        Some(_) => ("", Some(1.0), "demand over capacity of the median motion, the dashed line where it is 1"),
        None => ("g", None, "shock of the median motion in g"),
    };
    let mut html = heading("What would change it");
    html.push_str(&paragraph(&format!(
        "Bars: {of}, from one end of a value's range to the other; the black line is the result as it is. ✱ crosses the limit: more motions than are accepted then exceed it, or no more do."
    )));
    let scale = Scale::of(&found.tornado, limit);
    let rows: Vec<Vec<Cell>> = found
        .tornado
        .iter()
        .map(|swing| {
            vec![
                markup(name(&swing.parameter), ""),
                markup(name(&swing.low), ""),
                figure(ranked(swing.at_low, measure)),
                markup(swing_bar(swing, scale), "bar"),
                figure(ranked(swing.at_high, measure)),
                markup(name(&swing.high), ""),
                text(if swing.flips { "✱ crosses the limit" } else { "the same side" }),
            ]
        })
        .collect();
    let headings = ["Value", "From", "gives", "", "gives", "To", "Decision"];
    let headings = headings.map(|heading| if heading == "gives" { figure(heading) } else { text(heading) });
    html.push_str(&table("", &[headings.to_vec()], &rows));
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
                if softening.admissible { ", and it passes every check" } else { ", but it does not pass every check" }
            ),
            None => "No stiffness would do.".to_owned(),
        };
        if let Some(stroke_m) = softening.stroke_m {
            let (stroke, pad) = (number(1e3 * stroke_m, 3), number(1e3 * softening.pad_thickness_m, 3));
            let _ = write!(said, " It is compressed by {stroke} mm of {pad} mm.");
        }
        if let Some(shock_g) = softening.edge_acceleration_g {
            let _ = write!(said, " Shock on it: {} g.", number(shock_g, 3));
        }
        let _ = writeln!(html, "<p>{} {}</p>", words(&said), words(&softening.note));
    }
    if !found.restraint.is_empty() {
        html.push_str(&heading("Forces to fix it with"));
        let headings =
            vec![text("Source"), figure("Force"), figure("over its weight"), figure("Anchors of an edge"), text("How")];
        let rows: Vec<Vec<Cell>> = found
            .restraint
            .iter()
            .map(|force| {
                let tension = if force.anchor_tension_n > 0.0 {
                    format!("{} kN", number(1e-3 * force.anchor_tension_n, 3))
                } else {
                    "0: held by its weight".to_owned()
                };
                vec![
                    markup(name(&force.source), ""),
                    figure(format!("{} kN", number(1e-3 * force.force_n, 3))),
                    figure(number(force.force_ratio, 3)),
                    figure(tension),
                    markup(words(&force.note), ""),
                ]
            })
            .collect();
        html.push_str(&table("", &[headings], &rows));
    }
    if let Some(compliant) = &found.compliant {
        html.push_str(&heading("Second opinion: the compliant base"));
        let shock = match compliant.shock_ratio {
            Some(ratio) => format!("its shock is {} of that of Eq. (5) in the median", number(ratio, 3)),
            None => "it survives none of them".to_owned(),
        };
        let agrees = if compliant.agrees { "It leads to the same decision." } else { "It leads to ANOTHER decision." };
        html.push_str(&paragraph(&format!(
            "Of {} motions it overturns under {}; {shock}. {agrees}",
            compliant.motions, compliant.overturned
        )));
    }
    html
}

/// Other people's numbers, notes, and what the inventory carries.
fn beside(inventory: &Inventory, item: &Item, found: &Assessment) -> String {
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
    add("Other numbers beside these", &found.context);
    add("Notes", &found.notes);
    let mut carried = Vec::new();
    if !item.notes.is_empty() {
        carried.push(format!("Notes: {}", item.notes));
    }
    let cells = inventory.carried.iter().zip(&item.carried).filter(|(_, cell)| !cell.is_empty());
    carried.extend(cells.take(MOST_CARRIED).map(|(header, cell)| format!("{header}: {cell}")));
    add("From the inventory", &carried);
    html.push_str("</div>\n");
    html
}

/// Columns of the inventory that are not ours, on a page.
const MOST_CARRIED: usize = 30;

#[cfg(test)]
mod tests {
    use super::*;
    use freestand_study::result::Ranked;

    /// Without geometry, level, mass and tolerance there is still a page, and it says what is missing.
    #[test]
    fn a_bare_object_has_a_page() {
        let inventory = crate::assess::fixture::inventory(vec![]);
        let item = crate::assess::fixture::hostile_items().pop().unwrap();
        let html = page(&inventory, &item, 3, &crate::assess::fixture::unknown(&item));
        for said in ["NO VERDICT", "Height, thickness and level are missing.", "not known", "could not be followed"] {
            assert!(html.contains(said), "{said}: {html}");
        }
        assert!(!html.contains("step by step") && !html.contains("<svg"));
        assert_eq!(ranked_milli(Ranked::Value(0.0305), "mm"), "30.5 mm");
    }
}
