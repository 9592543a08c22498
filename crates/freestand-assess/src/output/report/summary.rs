//! The first pages: counts, the most urgent objects, floors, consequences, assumptions.

use std::fmt::Write;

use crate::output::Head;
use crate::output::overview::{Counts, Overview, RATINGS, Urgent};
use crate::output::words::{HOW_TO_READ, advice, label, probability, ranked, sign};
use crate::result::{Criterion, Decision};
use freestand_input::words::{counted, fixed, number, percent};
use freestand_output::html::{Cell, figure, list, markup, paragraph, properties, section, table, words as text};

use super::drawing::stacked_bar;
use super::{anchor, name, words};

/// Everything before the pages of the objects.
pub(super) fn summary(head: &Head, overview: &Overview, pages: usize) -> String {
    let mut html = String::new();
    if let Some(partial) = overview.partial() {
        let _ = writeln!(html, "<div class=\"warn partial\"><h2>Partial result</h2>{}</div>", paragraph(&partial));
    }
    html.push_str(&tiles(overview));
    html.push_str(&section("first", "The most urgent objects", &first(overview, pages)));
    html.push_str(&section("floors", "Verdicts by floor", &floors(overview, head.is_elastic)));
    html.push_str(&section("consequences", "Verdicts by consequence", &consequences(overview)));
    html.push_str(&section("warnings", "Warnings", &warnings(head, overview)));
    let facts: Vec<(&str, String)> = head.facts.iter().map(|(name, value)| (name.as_str(), value.clone())).collect();
    html.push_str(&section("facts", "Inputs", &properties("", &facts)));
    html.push_str(&section("assumptions", "Assumptions", &list(&head.assumptions)));
    html.push_str(&section("reading", "How to read this report", &list(&HOW_TO_READ)));
    html
}

/// A box for each decision with its count.
fn tiles(overview: &Overview) -> String {
    let mut html = String::from("<div class=\"tiles\">\n");
    for decision in Decision::ALL {
        let objects = overview.counts.of(decision);
        let pieces = overview.counts.pieces[decision as usize];
        let share = if overview.assessed == 0 { 0.0 } else { objects as f64 / overview.assessed as f64 };
        let _ = writeln!(
            html,
            "<div class=\"tile {}\"><span class=\"badge\">{} {}</span><strong>{objects}</strong><span>{} of the \
             objects, {pieces} {}: {}</span></div>",
            decision.name(),
            sign(decision),
            label(decision),
            percent(share, 0),
            if pieces == 1 { "piece" } else { "pieces" },
            advice(decision),
        );
    }
    html.push_str("</div>\n");
    let words = format!("Assessed: {} of {}.", overview.assessed, counted(overview.total, "object"));
    html.push_str(&paragraph(&words));
    if overview.only_falling > 0 {
        html.push_str(&paragraph(&format!(
            "Of the objects that may be left as they are, {} for falling alone: whether a shock damages them was not \
             asked, or no tolerance was given.",
            match overview.only_falling {
                1 => "1 was assessed".to_owned(),
                many => format!("{many} were assessed"),
            }
        )));
    }
    let decided: Vec<String> = (0u8..)
        .zip(overview.tiers)
        .filter(|(_, count)| *count > 0)
        .map(|(tier, count)| format!("{} ({count})", crate::output::words::tier(tier)))
        .collect();
    if !decided.is_empty() {
        html.push_str(&paragraph(&format!("Decided by: {}.", decided.join("; "))));
    }
    html
}

/// The list of the most urgent objects, with links to their pages.
fn first(overview: &Overview, pages: usize) -> String {
    if overview.urgent.is_empty() {
        return paragraph("No object was assessed.");
    }
    let mut html = String::new();
    let mut note =
        format!("The {} most urgent of {}, by rank.", overview.urgent.len(), counted(overview.assessed, "object"));
    if pages < overview.assessed {
        let _ = write!(
            note,
            " Objects up to rank {pages} have a page below. All objects are in objects.csv and in the sheet Objects of \
             assessment.xlsx, with every number.",
        );
    }
    html.push_str(&paragraph(&note));
    html.push_str(
        "<table class=\"first\"><thead><tr><th scope=\"col\" class=\"n\">Rank</th><th scope=\"col\">Object</th><th \
         scope=\"col\">Verdict</th><th scope=\"col\" class=\"n\">Demand / capacity</th><th \
         scope=\"col\">Governing</th><th scope=\"col\">P(exceeded)</th><th scope=\"col\" class=\"n\">Median \
         shock</th></tr></thead>\n<tbody>\n",
    );
    for one in overview.urgent.values() {
        html.push_str(&first_row(one, one.rank <= pages));
    }
    html.push_str("</tbody></table>\n");
    html
}

fn first_row(one: &Urgent, has_page: bool) -> String {
    let id = name(&one.id);
    let link = if has_page { format!("<a href=\"#{}\">{id}</a>", anchor(one.rank)) } else { id };
    let many = if one.quantity == 1 { String::new() } else { format!(" × {}", one.quantity) };
    let ratio = one.demand_capacity.map_or_else(|| "–".to_owned(), |ratio| ranked(ratio, ""));
    let chance = match (one.probability, one.is_overturn_only) {
        (None, _) => "–".to_owned(),
        (Some(chance), false) => probability(chance),
        (Some(chance), true) => format!("overturns: {}", probability(chance)),
    };
    let shock = one.shock_g.map_or_else(|| "–".to_owned(), |shock| ranked(shock, "g"));
    format!(
        "<tr><td class=\"n\" data-label=\"Rank\">{}</td><th scope=\"row\">{link} {}{many}<br \
         /><small>{}</small><small class=\"why\">{}</small></th>\
         <td data-label=\"Verdict\">{}</td>\
         <td class=\"n\" data-label=\"Demand / capacity\">{}</td><td data-label=\"Governing\">{}</td>\
         <td data-label=\"P(exceeded)\">{}</td><td class=\"n\" data-label=\"Median shock\">{}</td></tr>\n",
        one.rank,
        name(&one.item),
        name(&one.place),
        words(&one.why),
        badge(one.decision),
        name(&ratio),
        one.governing.map_or("–", Criterion::name),
        name(&chance),
        name(&shock),
    )
}

/// Sign and word of a decision on its colour.
pub(super) fn badge(decision: Decision) -> String {
    format!("<span class=\"badge {}\">{} {}</span>", decision.name(), sign(decision), label(decision))
}

fn decision_headings(mut first: Vec<Cell>) -> Vec<Cell> {
    for decision in Decision::ALL {
        first.push(figure(format!("{} {}", sign(decision), decision.name())));
    }
    first.push(text(""));
    first
}

/// The counts of a row of a table, with a bar; the largest row fills it.
fn decision_cells(counts: &Counts, largest: usize) -> Vec<Cell> {
    let mut cells: Vec<Cell> =
        Decision::ALL.into_iter().map(|decision| figure(counts.of(decision).to_string())).collect();
    cells.push(markup(stacked_bar(counts, largest), "bar"));
    cells
}

/// Peak floor acceleration above which a building that stays elastic is hardly true \[g\].
const DAMAGED_FROM_G: f64 = 0.5;

fn floors(overview: &Overview, is_elastic: bool) -> String {
    let floors = overview.floors();
    if floors.is_empty() {
        return paragraph("No object was assessed.");
    }
    let largest = floors.iter().map(|floor| floor.counts.total()).max().unwrap_or(0);
    let headings = decision_headings(vec![text("Floor"), figure("Level"), figure("Median PFA")]);
    let rows: Vec<Vec<Cell>> = floors
        .iter()
        .map(|floor| {
            let level = floor.level_ratio.map_or_else(|| "–".to_owned(), |level| fixed(level, 2));
            let pfa = floor.pfa_g_median.map_or_else(
                || "–".to_owned(),
                |pfa_g| {
                    let elastic = if is_elastic && pfa_g > DAMAGED_FROM_G { " (elastic building)" } else { "" };
                    format!("{} g{elastic}", number(pfa_g, 3))
                },
            );
            let mut cells = vec![markup(name(&floor.name), ""), figure(level), figure(pfa)];
            cells.extend(decision_cells(&floor.counts, largest));
            cells
        })
        .collect();
    let mut html = table("", &[headings], &rows);
    html.push_str(&paragraph(
        "Number of objects by floor, from the top down, and by decision. Median PFA: the median of the peak floor \
         accelerations of all worlds.",
    ));
    if floors.iter().any(|floor| is_elastic && floor.pfa_g_median.is_some_and(|pfa_g| pfa_g > DAMAGED_FROM_G)) {
        html.push_str(&paragraph(
            "Elastic building: in the calculation the building does not yield. One that yields mostly shakes its floors \
             less.",
        ));
    }
    html
}

fn consequences(overview: &Overview) -> String {
    let all = overview.consequences.iter().flat_map(|consequence| &consequence.ratings);
    let largest = all.map(Counts::total).max().unwrap_or(0);
    let headings = decision_headings(vec![text("Consequence"), text("Rating"), figure("Objects")]);
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for consequence in &overview.consequences {
        for (counts, rating) in consequence.ratings.iter().zip(RATINGS).filter(|(counts, _)| counts.total() > 0) {
            let mut cells = vec![text(consequence.name), text(rating), figure(counts.total().to_string())];
            cells.extend(decision_cells(counts, largest));
            rows.push(cells);
        }
    }
    if rows.is_empty() {
        return paragraph("No object was assessed.");
    }
    let mut html = table("", &[headings], &rows);
    html.push_str(&paragraph("The three consequences of FEMA E-74, as rated in the inventory."));
    html
}

fn warnings(head: &Head, overview: &Overview) -> String {
    let mut warnings: Vec<String> = Vec::new();
    let mut count = |objects: usize, what: &str, why: &str| {
        if objects > 0 {
            warnings.push(format!("{what}: {}. {why}", counted(objects, "object")));
        }
    };
    count(overview.without_response, "Without a response", "Geometry or level is missing, or every history failed.");
    count(overview.without_tolerance, "Without a tolerance", "Only overturning was assessed.");
    let left_out = "The failed histories are left out of every number.";
    count(overview.with_failed_motions, "With histories that failed", left_out);
    if head.warnings.is_empty() && warnings.is_empty() {
        return paragraph("None.");
    }
    let mut html = String::from("<ul>\n");
    for warning in warnings.iter().chain(&head.warnings) {
        let _ = writeln!(html, "<li>{}</li>", words(warning));
    }
    html.push_str("</ul>\n");
    html
}
