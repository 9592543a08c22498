//! The first pages: counts, the most urgent objects, floors, consequences, assumptions.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::assessment::Head;
use crate::assessment::Wanted;
use crate::assessment::csv::CSV_NAME;
use crate::assessment::floors::{FloorKey, floor_words};
use crate::assessment::head::RULE;
use crate::assessment::orders;
use crate::assessment::overview::{Counts, Overview, RATINGS, Urgent};
use crate::assessment::plan::{plan_html, unfunded};
use crate::assessment::since::since_html;
use crate::assessment::words::{HOW_TO_READ, advice, label, long, ranked, sign};
use crate::assessment::worklist::{Task, WORKLIST_NAME, sort_floors};
use crate::signature::{Signing, signature};
use freestand_assess::result::{Criterion, Decision};
use freestand_input::keys::KeyStyle;
use freestand_input::words::{counted, fixed, number, significant};
use freestand_output::html::{
    Cell, figure, heading, list, markup, paragraph, properties, section, table, words as text,
};
use freestand_risk::budget::BudgetPlan;

use super::drawing::stacked_bar;
use super::{anchor, name, words};

/// Everything before the pages of the objects.
pub(super) fn summary(head: &Head, overview: &Overview, pages: usize, wanted: Wanted) -> String {
    let mut html = String::new();
    if let Some(no_study) = &head.no_study {
        let _ = writeln!(
            html,
            "<div class=\"warn study\">{}</div>",
            paragraph(no_study)
        );
    }
    let lacks_plan = wanted.lacks_plan.then(|| {
        "PARTIAL: the run was stopped before its plan within the budget was made. A run that is resumed makes it.".to_owned()
    });
    for partial in overview.partial().into_iter().chain(lacks_plan) {
        let _ = writeln!(
            html,
            "<div class=\"warn partial\"><h2>Partial result</h2>{}</div>",
            paragraph(&partial)
        );
    }
    let recalled = recalled(head, overview, wanted);
    html.push_str(&one_page(head, overview, pages, wanted, &recalled));
    let facts: Vec<(&str, String)> = head
        .facts
        .iter()
        .map(|(name, value)| (name.as_str(), value.clone()))
        .collect();
    let tasks = work_list(overview, pages);
    // A plan has its work orders, room by room.
    let tasks = match wanted.plan {
        Some(_) => long(tasks, overview.tasks.len(), WORKLIST_NAME),
        None => tasks,
    };
    let work = floors(overview, head.is_elastic) + &tasks;
    let unread = (!recalled.is_empty()).then(|| {
        (
            "recalled",
            "Values quoted from memory (confidence: recalled)",
            list(&recalled),
        )
    });
    let planned = wanted.plan.map(|plan| {
        (
            "plan",
            "The plan within the budget",
            plan_html(plan, &orders::links(plan)),
        )
    });
    let changed = wanted
        .since
        .map(|since| ("since", "What has changed", since_html(since)));
    let rest = [
        (
            "first",
            "The most urgent objects",
            long(first(overview, pages), overview.urgent.len(), CSV_NAME),
        ),
        ("floors", "Work list by floor and room", work),
        (
            "consequences",
            "Verdicts by consequence",
            consequences(overview),
        ),
        (
            "warnings",
            "Problems and warnings",
            warnings(head, overview),
        ),
        ("facts", "Inputs", properties("", &facts)),
        ("assumptions", "Assumptions", list(&head.assumptions)),
        ("reading", "How to read this report", list(&HOW_TO_READ)),
    ];
    let sections: Vec<(&str, &str, String)> = planned
        .into_iter()
        .chain(changed)
        .chain(rest)
        .chain(unread)
        .collect();
    html.push_str("<nav aria-label=\"Contents\">\n");
    for (id, heading, _) in &sections {
        let _ = writeln!(html, "<a href=\"#{id}\">{heading}</a>");
    }
    html.push_str("</nav>\n");
    html.push_str(&print_choices(head, pages.min(overview.assessed)));
    for (id, heading, content) in &sections {
        html.push_str(&section(id, heading, content));
    }
    html
}

/// Objects on the first page.
const TEN: usize = 10;

/// What a manager needs, on one printed sheet: where, how many, what first, what was assumed.
fn one_page(
    head: &Head,
    overview: &Overview,
    pages: usize,
    wanted: Wanted,
    recalled: &[String],
) -> String {
    let flows = match wanted.signing.is_draft(recalled) || wanted.plan.is_some() {
        true => " class=\"flows\"",
        false => "",
    };
    let mut html = format!("<section id=\"one-page\"{flows}>\n");
    html.push_str(&tiles(overview));
    if let Some(said) = wanted.plan.and_then(unfunded) {
        let _ = writeln!(html, "<div class=\"warn\">{}</div>", paragraph(&said));
    }
    let place: Vec<(&str, String)> = head
        .place
        .iter()
        .map(|(name, value)| (name.as_str(), value.clone()))
        .collect();
    html.push_str(&properties("", &place));
    html.push_str(&heading("The first ten"));
    html.push_str(&ten(overview, pages));
    html.push_str(&paragraph(&brackets(head)));
    html.push_str(&heading("What was assumed"));
    html.push_str(&list(&head.most_important));
    html.push_str(&title_block(head, recalled, wanted.signing));
    html.push_str("</section>\n");
    html
}

/// What the numbers in brackets are.
fn brackets(head: &Head) -> String {
    format!(
        "In brackets: the interval in which the probability lies with {} % confidence, given the earthquakes that were \
         simulated; a verdict counts on its worse end.",
        number(100.0 * head.confidence, 3)
    )
}

/// Recalled values that the first sheet has room for; all are in a section of their own.
const ON_THE_FIRST_SHEET: usize = 2;

/// The values quoted from memory on which the report rests.
fn recalled(head: &Head, overview: &Overview, wanted: Wanted) -> Vec<String> {
    let planned = wanted.plan.into_iter().flat_map(BudgetPlan::planned);
    let mut found = overview.recalled.clone();
    found.extend(orders::recalled(planned));
    found.extend(head.recalled_place.iter().cloned());
    let more = "others, which are too many to name".to_owned();
    let more = overview.has_more_recalled.then_some(more);
    found.into_iter().chain(more).collect()
}

/// Date, preparer, revision and signature; what is not stated is a line to fill in. A draft has no signature.
fn title_block(head: &Head, recalled: &[String], signing: Signing) -> String {
    let field = |label: &str, value: Option<&String>| {
        let value = value.map_or_else(String::new, |value| name(value));
        format!("<div><b>{value}</b><span>{label}</span></div>")
    };
    let title = &head.title;
    let fields = format!(
        "<div class=\"title-block\">\n{}{}{}{}</div>\n",
        field("Date", title.date.as_ref()),
        field("Prepared by", title.preparer.as_ref()),
        field("Revision", title.revision.as_ref()),
        match signing.is_draft(recalled) {
            true => String::new(),
            false => field("Signature", None),
        }
    );
    let below = signature("", recalled, ON_THE_FIRST_SHEET, signing);
    fields + &below
}

/// The boxes by which a reader chooses whether the long lists and the cards of the objects, if it has any, are printed.
fn print_choices(head: &Head, pages: usize) -> String {
    let checked = if head.cards {
        " checked=\"checked\""
    } else {
        ""
    };
    let cards = match pages {
        0 => String::new(),
        _ => format!(
            " <label><input type=\"checkbox\" id=\"print-cards\"{checked}/> Print the cards of the objects too</label>"
        ),
    };
    format!(
        "<p class=\"choice\"><label><input type=\"checkbox\" id=\"print-lists\"/> Print the long lists too</label>\
         {cards}</p>\n"
    )
}

/// A box for each decision with its count.
fn tiles(overview: &Overview) -> String {
    let mut html = String::from("<div class=\"tiles\">\n");
    for decision in Decision::ALL {
        let objects = overview.counts.of(decision);
        let pieces = overview.counts.pieces[decision as usize];
        let _ = writeln!(
            html,
            "<div class=\"tile {}\"><span class=\"badge\">{} {}</span><strong>{objects}</strong><span>{} in {}: \
             {}</span></div>",
            decision.name(),
            sign(decision),
            label(decision),
            counted(usize::try_from(pieces).unwrap_or(usize::MAX), "piece"),
            if objects == 1 {
                "1 row".to_owned()
            } else {
                format!("{objects} rows")
            },
            advice(decision),
        );
    }
    html.push_str("</div>\n");
    let mut said = format!(
        "Assessed: {} of {}.",
        overview.assessed,
        counted(overview.total, "object")
    );
    if overview.only_falling > 0 {
        let _ = write!(
            said,
            " Of the {} to leave, only falling was assessed for {}: whether a shock damages them was not asked, or no \
             tolerance was given.",
            overview.counts.of(Decision::Leave),
            overview.only_falling,
        );
    }
    html.push_str(&paragraph(&said));
    html
}

/// The id of an object with a link to its page, if it has one, and what it is.
fn object_name(one: (usize, &str, &str, u32), pages: usize) -> String {
    let (rank, id, item, quantity) = one;
    let id = name(id);
    let link = if rank <= pages {
        format!("<a href=\"#{}\">{id}</a>", anchor(rank))
    } else {
        id
    };
    let many = if quantity == 1 {
        String::new()
    } else {
        format!(" × {quantity}")
    };
    format!("{link} {}{many}", name(item))
}

/// A cell with its heading, which a narrow screen shows before it.
fn labelled(label: &str, class: &str, html: &str) -> String {
    format!("<td{class} data-label=\"{label}\">{html}</td>")
}

fn number_cell(label: &str, text: &str) -> String {
    labelled(label, " class=\"n\"", &name(text))
}

/// A force as a table shows it.
pub(super) fn kilonewtons(force_n: f64) -> String {
    format!("{} kN", significant(1e-3 * force_n, 3))
}

fn force_words(force_n: Option<f64>) -> String {
    force_n.map_or_else(|| "–".to_owned(), kilonewtons)
}

/// The opening of a table whose rows become cards on a narrow screen.
fn cards(class: &str, headings: &[(&str, bool)]) -> String {
    let mut html = format!("<table class=\"cards {class}\"><thead><tr>");
    for (heading, is_number) in headings {
        let class = if *is_number { " class=\"n\"" } else { "" };
        let _ = write!(html, "<th scope=\"col\"{class}>{heading}</th>");
    }
    html.push_str("</tr></thead>\n");
    html
}

fn ten(overview: &Overview, pages: usize) -> String {
    if overview.urgent.is_empty() {
        return paragraph("No object was assessed.");
    }
    let mut html = cards(
        "ten",
        &[
            ("Rank", true),
            ("Object", false),
            ("Floor", false),
            ("Action", false),
            ("Probability", false),
            ("Force", true),
        ],
    );
    html.push_str("<tbody>\n");
    for one in overview.urgent.values().take(TEN) {
        let _ = writeln!(
            html,
            "<tr>{}<th scope=\"row\">{}</th>{}{}{}{}</tr>",
            number_cell("Rank", &one.rank.to_string()),
            object_name((one.rank, &one.id, &one.item, one.quantity), pages),
            labelled("Floor", "", &name(&one.floor)),
            labelled("Action", "", &badge(one.decision)),
            labelled("Probability", "", &name(&one.chance)),
            number_cell("Force", &force_words(one.force_n)),
        );
    }
    html.push_str("</tbody></table>\n");
    html
}

/// The list of the most urgent objects, with links to their pages.
fn first(overview: &Overview, pages: usize) -> String {
    if overview.urgent.is_empty() {
        return paragraph("No object was assessed.");
    }
    let mut html = String::new();
    let mut note = match overview.assessed {
        all if all == overview.urgent.len() => format!("All {} by rank.", counted(all, "object")),
        all => format!(
            "The {} most urgent of {}, by rank.",
            overview.urgent.len(),
            counted(all, "object")
        ),
    };
    if pages < overview.assessed {
        let _ = write!(note, " Objects up to rank {pages} have a card below.");
    }
    note.push_str(" All objects are in objects.csv and in the sheet Objects of assessment.xlsx, with every number. ");
    note.push_str(RULE);
    html.push_str(&paragraph(&note));
    html.push_str(&cards(
        "first",
        &[
            ("Rank", true),
            ("Object", false),
            ("Action", false),
            ("Falls over", false),
            ("Tolerance exceeded", false),
            ("Demand / capacity", true),
            ("Governing", false),
            ("Median shock", true),
            ("Force", true),
        ],
    ));
    html.push_str("<tbody>\n");
    for one in overview.urgent.values() {
        html.push_str(&first_row(one, pages));
    }
    html.push_str("</tbody></table>\n");
    html.push_str(&paragraph(
        "Demand/capacity and shock are those of the median world, by the model that decides. Force: of a restraint, at \
         the centre of gravity.",
    ));
    html
}

fn first_row(one: &Urgent, pages: usize) -> String {
    let ratio = one
        .demand_capacity
        .map_or_else(|| "–".to_owned(), |ratio| ranked(ratio, ""));
    let shock = one
        .shock_g
        .map_or_else(|| "–".to_owned(), |shock| ranked(shock, "g"));
    format!(
        "<tr>{}<th scope=\"row\">{} <small>{}</small></th>{}{}{}{}{}{}{}</tr>\n",
        number_cell("Rank", &one.rank.to_string()),
        object_name((one.rank, &one.id, &one.item, one.quantity), pages),
        name(&one.place),
        labelled("Action", "", &badge(one.decision)),
        labelled("Falls over", "", &name(&one.falls)),
        labelled("Tolerance exceeded", "", &name(&one.exceeded)),
        number_cell("Demand / capacity", &ratio),
        labelled("Governing", "", one.governing.map_or("–", Criterion::name)),
        number_cell("Median shock", &shock),
        number_cell("Force", &force_words(one.force_n)),
    )
}

/// What has to be done, floor by floor and room by room.
fn work_list(overview: &Overview, pages: usize) -> String {
    if overview.tasks.is_empty() {
        return if overview.assessed == 0 {
            String::new()
        } else {
            paragraph("Nothing has to be done.")
        };
    }
    let mut note = format!(
        "What has to be done, from the top floor down, room by room: {}. The same list is in worklist.csv.",
        counted(overview.to_do, "object")
    );
    if overview.tasks.len() < overview.to_do {
        let _ = write!(
            note,
            " Here are the {} most urgent; worklist.csv has all.",
            overview.tasks.len()
        );
    }
    let mut html = heading("What has to be done") + &paragraph(&note);
    html.push_str(&cards(
        "work",
        &[
            ("Room", false),
            ("Object", false),
            ("Action", false),
            ("How and why", false),
            ("Force", true),
            ("Tension along one edge", true),
            ("Done", false),
        ],
    ));
    let mut tasks: Vec<&Task> = overview.tasks.values().collect();
    // A floor has the level of its most urgent object, so that its tasks stay together.
    let mut levels: BTreeMap<&FloorKey, Option<f64>> = BTreeMap::new();
    for task in &tasks {
        levels.entry(&task.floor).or_insert(task.level_ratio);
    }
    tasks.sort_by(|a, b| a.room.cmp(&b.room).then(a.rank.cmp(&b.rank)));
    sort_floors(&mut tasks, |task| {
        (levels.get(&task.floor).copied().flatten(), &task.floor)
    });
    let mut last: Option<&FloorKey> = None;
    for task in tasks {
        if last != Some(&task.floor) {
            html.push_str(if last.is_some() {
                "</tbody>\n<tbody>\n"
            } else {
                "<tbody>\n"
            });
            let floor = floor_words(&task.floor, overview.has_buildings());
            let _ = writeln!(
                html,
                "<tr class=\"floor\"><th scope=\"rowgroup\" colspan=\"7\">{}</th></tr>",
                name(&floor)
            );
            last = Some(&task.floor);
        }
        html.push_str(&work_row(task, pages));
    }
    html.push_str("</tbody></table>\n");
    html
}

fn work_row(task: &Task, pages: usize) -> String {
    let tension = match task.anchor_tension_n {
        None => "–".to_owned(),
        Some(tension_n) if tension_n > 0.0 => kilonewtons(tension_n),
        Some(_) => "none".to_owned(),
    };
    format!(
        "<tr>{}<th scope=\"row\">{}</th>{}{}{}{}{}</tr>\n",
        labelled("Room", "", &name(&task.room)),
        object_name((task.rank, &task.id, &task.item, task.quantity), pages),
        labelled("Action", "", &badge(task.action)),
        labelled(
            "How and why",
            "",
            &format!("{} <small>{}</small>", words(&task.how), words(&task.why))
        ),
        number_cell("Force", &force_words(task.force_n)),
        number_cell("Tension along one edge", &tension),
        labelled("Done", "", "☐"),
    )
}

/// Sign and word of a decision on its colour.
pub(super) fn badge(decision: Decision) -> String {
    format!(
        "<span class=\"badge {}\">{} {}</span>",
        decision.name(),
        sign(decision),
        label(decision)
    )
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
    let mut cells: Vec<Cell> = Decision::ALL
        .into_iter()
        .map(|decision| figure(counts.of(decision).to_string()))
        .collect();
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
    let largest = floors
        .iter()
        .map(|floor| floor.counts.total())
        .max()
        .unwrap_or(0);
    let headings = decision_headings(vec![text("Floor"), figure("Level"), figure("Median PFA")]);
    let rows: Vec<Vec<Cell>> = floors
        .iter()
        .map(|floor| {
            let level = floor
                .level_ratio
                .map_or_else(|| "–".to_owned(), |level| fixed(level, 2));
            let pfa = floor.pfa_g_median.map_or_else(
                || "–".to_owned(),
                |pfa_g| {
                    let elastic = if is_elastic && pfa_g > DAMAGED_FROM_G {
                        " (elastic building)"
                    } else {
                        ""
                    };
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
        "Number of objects by floor, from the top down, and by verdict. Median PFA: the median of the peak floor \
         accelerations of all worlds.",
    ));
    if floors.iter().any(|floor| {
        is_elastic
            && floor
                .pfa_g_median
                .is_some_and(|pfa_g| pfa_g > DAMAGED_FROM_G)
    }) {
        html.push_str(&paragraph(
            "Elastic building: in the calculation the building does not yield. One that yields mostly shakes its floors \
             less.",
        ));
    }
    html
}

fn consequences(overview: &Overview) -> String {
    let all = overview
        .consequences
        .iter()
        .flat_map(|consequence| &consequence.ratings);
    let largest = all.map(Counts::total).max().unwrap_or(0);
    let headings = decision_headings(vec![text("Consequence"), text("Rating"), figure("Objects")]);
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for consequence in &overview.consequences {
        for (counts, rating) in consequence
            .ratings
            .iter()
            .zip(RATINGS)
            .filter(|(counts, _)| counts.total() > 0)
        {
            let mut cells = vec![
                text(consequence.name),
                text(rating),
                figure(counts.total().to_string()),
            ];
            cells.extend(decision_cells(counts, largest));
            rows.push(cells);
        }
    }
    if rows.is_empty() {
        return paragraph("No object was assessed.");
    }
    let mut html = table("", &[headings], &rows);
    html.push_str(&paragraph(
        "The three consequences of FEMA E-74, as rated in the inventory.",
    ));
    html
}

fn warnings(head: &Head, overview: &Overview) -> String {
    let mut warnings: Vec<String> = Vec::new();
    let mut count = |objects: usize, what: &str, why: &str| {
        if objects > 0 {
            warnings.push(format!("{what}: {}. {why}", counted(objects, "object")));
        }
    };
    count(
        overview.without_response,
        "Without a response",
        "Geometry or level is missing, or every history failed.",
    );
    count(
        overview.without_tolerance,
        "Without a tolerance",
        "Only falling was assessed.",
    );
    let left_out = "The failed histories are left out of every number.";
    count(
        overview.with_failed_motions,
        "With histories that failed",
        left_out,
    );
    if head.warnings.is_empty() && head.problems.is_empty() && warnings.is_empty() {
        return paragraph("None.");
    }
    let mut html = String::from("<ul>\n");
    for warning in warnings.iter().chain(&head.problems).chain(&head.warnings) {
        let _ = writeln!(html, "<li>{}</li>", words(&KeyStyle::Flag.shown(warning)));
    }
    html.push_str("</ul>\n");
    html
}
