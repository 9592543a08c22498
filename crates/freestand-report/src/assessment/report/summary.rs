//! The first pages: counts, the most urgent objects, floors, consequences, assumptions.

use std::collections::BTreeMap;

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
    Cell, Section, checkbox, contents, figure, list, properties, sections, table, words as text,
};
use freestand_risk::budget::BudgetPlan;
use maud::{Markup, Render, html};

use super::drawing::stacked_bar;
use super::{anchor, name, words};

/// Everything before the pages of the objects.
pub(super) fn summary(head: &Head, overview: &Overview, pages: usize, wanted: Wanted) -> Markup {
    let lacks_plan = wanted.lacks_plan.then(|| {
        "PARTIAL: the run was stopped before its plan within the budget was made. A run that is resumed makes it.".to_owned()
    });
    let partial = overview.partial().into_iter().chain(lacks_plan);
    let recalled = recalled(head, overview, wanted);
    let parts = after_the_first_sheet(head, overview, pages, wanted, &recalled);
    html! {
        @if let Some(no_study) = &head.no_study { div.warn.study { p { (no_study) } } }
        @for said in partial { div.warn.partial { h2 { "Partial result" } p { (said) } } }
        (one_page(head, overview, pages, wanted, &recalled))
        (contents(&parts))
        (print_choices(head, pages.min(overview.assessed)))
        (sections(&parts))
    }
}

/// The sections that follow the first sheet.
fn after_the_first_sheet(
    head: &Head,
    overview: &Overview,
    pages: usize,
    wanted: Wanted,
    recalled: &[String],
) -> Vec<Section> {
    let tasks = work_list(overview, pages);
    // A plan has its work orders, room by room.
    let tasks = match wanted.plan {
        Some(_) => long(tasks, overview.tasks.len(), WORKLIST_NAME),
        None => tasks,
    };
    let work = html! { (floors(overview, head.is_elastic)) (tasks) };
    let unread = (!recalled.is_empty()).then(|| {
        Section::new(
            "recalled",
            "Values quoted from memory (confidence: recalled)",
            list(recalled),
        )
    });
    let planned = wanted.plan.map(|plan| {
        Section::new(
            "plan",
            "The plan within the budget",
            plan_html(plan, &orders::links(plan)),
        )
    });
    let changed = wanted
        .since
        .map(|since| Section::new("since", "What has changed", since_html(since)));
    let rest = [
        Section::new(
            "first",
            "The most urgent objects",
            long(first(overview, pages), overview.urgent.len(), CSV_NAME),
        ),
        Section::new("floors", "Work list by floor and room", work),
        Section::new(
            "consequences",
            "Verdicts by consequence",
            consequences(overview),
        ),
        Section::new(
            "warnings",
            "Problems and warnings",
            warnings(head, overview),
        ),
        Section::new("facts", "Inputs", properties("", &head.facts)),
        Section::new("assumptions", "Assumptions", list(&head.assumptions)),
        Section::new("reading", "How to read this report", list(HOW_TO_READ)),
    ];
    planned
        .into_iter()
        .chain(changed)
        .chain(rest)
        .chain(unread)
        .collect()
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
) -> Markup {
    let flows = wanted.signing.is_draft(recalled) || wanted.plan.is_some();
    html! {
        section #one-page class=[flows.then_some("flows")] {
            (tiles(overview))
            @if let Some(said) = wanted.plan.and_then(unfunded) { div.warn { p { (said) } } }
            (properties("", &head.place))
            h3 { "The first ten" }
            (ten(overview, pages))
            p {
                "In brackets: the interval in which the probability lies with " (number(100.0 * head.confidence, 3))
                " % confidence, given the earthquakes that were simulated; a verdict counts on its worse end."
            }
            h3 { "What was assumed" }
            (list(&head.most_important))
            (title_block(head, recalled, wanted.signing))
        }
    }
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
fn title_block(head: &Head, recalled: &[String], signing: Signing) -> Markup {
    let field = |label: &str, value: Option<&String>| {
        html! {
            div { b { @if let Some(value) = value { (name(value)) } } span { (label) } }
        }
    };
    let title = &head.title;
    html! {
        div.title-block {
            (field("Date", title.date.as_ref()))
            (field("Prepared by", title.preparer.as_ref()))
            (field("Revision", title.revision.as_ref()))
            @if !signing.is_draft(recalled) { (field("Signature", None)) }
        }
        (signature(Markup::default(), recalled, ON_THE_FIRST_SHEET, signing))
    }
}

/// The boxes by which a reader chooses whether the long lists and the cards of the objects, if it has any, are printed.
fn print_choices(head: &Head, pages: usize) -> Markup {
    html! {
        p.choice {
            label { (checkbox("print-lists", false)) " Print the long lists too" }
            @if pages > 0 {
                " " label { (checkbox("print-cards", head.cards)) " Print the cards of the objects too" }
            }
        }
    }
}

/// A box for each decision with its count.
fn tiles(overview: &Overview) -> Markup {
    let tile = |decision: Decision| {
        let rows = overview.counts.of(decision);
        let pieces = overview.counts.pieces[decision as usize];
        let pieces = counted(usize::try_from(pieces).unwrap_or(usize::MAX), "piece");
        html! {
            div.tile.(decision.name()) {
                span.badge { (sign(decision)) " " (label(decision)) }
                strong { (rows) }
                span { (pieces) " in " (counted(rows, "row")) ": " (advice(decision)) }
            }
        }
    };
    html! {
        div.tiles { @for decision in Decision::ALL { (tile(decision)) } }
        p {
            "Assessed: " (overview.assessed) " of " (counted(overview.total, "object")) "."
            @if overview.only_falling > 0 {
                " Of the " (overview.counts.of(Decision::Leave)) " to leave, only falling was assessed for "
                (overview.only_falling)
                ": whether a shock damages them was not asked, or no tolerance was given."
            }
        }
    }
}

/// The id of an object with a link to its page, if it has one, and what it is.
fn object_name(one: (usize, &str, &str, u32), pages: usize) -> Markup {
    let (rank, id, item, quantity) = one;
    html! {
        @if rank <= pages {
            a href={ "#" (anchor(rank)) } { (name(id)) }
        } @else {
            (name(id))
        }
        " " (name(item))
        @if quantity != 1 { " × " (quantity) }
    }
}

/// A cell with its heading, which a narrow screen shows before it.
fn labelled(label: &str, content: impl Render) -> Markup {
    html! { td data-label=(label) { (content) } }
}

fn number_cell(label: &str, text: &str) -> Markup {
    html! { td.n data-label=(label) { (name(text)) } }
}

/// A force as a table shows it.
pub(super) fn kilonewtons(force_n: f64) -> String {
    format!("{} kN", significant(1e-3 * force_n, 3))
}

fn force_words(force_n: Option<f64>) -> String {
    force_n.map_or_else(|| "–".to_owned(), kilonewtons)
}

/// A table whose rows become cards on a narrow screen; `bodies` are its `tbody` elements.
fn cards(class: &str, headings: &[(&str, bool)], bodies: &Markup) -> Markup {
    html! {
        table.cards.(class) {
            thead {
                tr {
                    @for (heading, is_number) in headings {
                        th scope="col" class=[is_number.then_some("n")] { (heading) }
                    }
                }
            }
            (bodies)
        }
    }
}

fn ten(overview: &Overview, pages: usize) -> Markup {
    if overview.urgent.is_empty() {
        return nothing_assessed();
    }
    let headings = [
        ("Rank", true),
        ("Object", false),
        ("Floor", false),
        ("Action", false),
        ("Probability", false),
        ("Force", true),
    ];
    let rows = html! {
        tbody {
            @for one in overview.urgent.values().take(TEN) {
                tr {
                    (number_cell("Rank", &one.rank.to_string()))
                    th scope="row" { (object_name((one.rank, &one.id, &one.item, one.quantity), pages)) }
                    (labelled("Floor", name(&one.floor)))
                    (labelled("Action", badge(one.decision)))
                    (labelled("Probability", name(&one.chance)))
                    (number_cell("Force", &force_words(one.force_n)))
                }
            }
        }
    };
    cards("ten", &headings, &rows)
}

fn nothing_assessed() -> Markup {
    html! { p { "No object was assessed." } }
}

/// The list of the most urgent objects, with links to their pages.
fn first(overview: &Overview, pages: usize) -> Markup {
    if overview.urgent.is_empty() {
        return nothing_assessed();
    }
    let headings = [
        ("Rank", true),
        ("Object", false),
        ("Action", false),
        ("Falls over", false),
        ("Tolerance exceeded", false),
        ("Demand / capacity", true),
        ("Governing", false),
        ("Median shock", true),
        ("Force", true),
    ];
    let rows = html! {
        tbody { @for one in overview.urgent.values() { (first_row(one, pages)) } }
    };
    let all = counted(overview.assessed, "object");
    html! {
        p {
            @if overview.assessed == overview.urgent.len() {
                "All " (all) " by rank."
            } @else {
                "The " (overview.urgent.len()) " most urgent of " (all) ", by rank."
            }
            @if pages < overview.assessed { " Objects up to rank " (pages) " have a card below." }
            " All objects are in objects.csv and in the sheet Objects of assessment.xlsx, with every number. " (RULE)
        }
        (cards("first", &headings, &rows))
        p {
            "Demand/capacity and shock are those of the median world, by the model that decides. Force: of a restraint, at \
             the centre of gravity."
        }
    }
}

fn first_row(one: &Urgent, pages: usize) -> Markup {
    let ratio = one
        .demand_capacity
        .map_or_else(|| "–".to_owned(), |ratio| ranked(ratio, ""));
    let shock = one
        .shock_g
        .map_or_else(|| "–".to_owned(), |shock| ranked(shock, "g"));
    html! {
        tr {
            (number_cell("Rank", &one.rank.to_string()))
            th scope="row" {
                (object_name((one.rank, &one.id, &one.item, one.quantity), pages)) " " small { (name(&one.place)) }
            }
            (labelled("Action", badge(one.decision)))
            (labelled("Falls over", name(&one.falls)))
            (labelled("Tolerance exceeded", name(&one.exceeded)))
            (number_cell("Demand / capacity", &ratio))
            (labelled("Governing", one.governing.map_or("–", Criterion::name)))
            (number_cell("Median shock", &shock))
            (number_cell("Force", &force_words(one.force_n)))
        }
    }
}

/// What has to be done, floor by floor and room by room.
fn work_list(overview: &Overview, pages: usize) -> Markup {
    if overview.tasks.is_empty() {
        return html! { @if overview.assessed > 0 { p { "Nothing has to be done." } } };
    }
    let headings = [
        ("Room", false),
        ("Object", false),
        ("Action", false),
        ("How and why", false),
        ("Force", true),
        ("Tension along one edge", true),
        ("Done", false),
    ];
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
    let rows = html! {
        @for of_floor in tasks.chunk_by(|a, b| a.floor == b.floor) {
            tbody {
                @for (i, task) in of_floor.iter().enumerate() {
                    @if i == 0 {
                        @let floor = floor_words(&task.floor, overview.has_buildings());
                        tr.floor { th scope="rowgroup" colspan="7" { (name(&floor)) } }
                    }
                    (work_row(task, pages))
                }
            }
        }
    };
    html! {
        h3 { "What has to be done" }
        p {
            "What has to be done, from the top floor down, room by room: " (counted(overview.to_do, "object"))
            ". The same list is in worklist.csv."
            @if overview.tasks.len() < overview.to_do {
                " Here are the " (overview.tasks.len()) " most urgent; worklist.csv has all."
            }
        }
        (cards("work", &headings, &rows))
    }
}

fn work_row(task: &Task, pages: usize) -> Markup {
    let tension = match task.anchor_tension_n {
        None => "–".to_owned(),
        Some(tension_n) if tension_n > 0.0 => kilonewtons(tension_n),
        Some(_) => "none".to_owned(),
    };
    html! {
        tr {
            (labelled("Room", name(&task.room)))
            th scope="row" { (object_name((task.rank, &task.id, &task.item, task.quantity), pages)) }
            (labelled("Action", badge(task.action)))
            (labelled("How and why", html! { (words(&task.how)) " " small { (words(&task.why)) } }))
            (number_cell("Force", &force_words(task.force_n)))
            (number_cell("Tension along one edge", &tension))
            (labelled("Done", "☐"))
        }
    }
}

/// Sign and word of a decision on its colour.
pub(super) fn badge(decision: Decision) -> Markup {
    html! {
        span.badge.(decision.name()) { (sign(decision)) " " (label(decision)) }
    }
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
        .map(|decision| figure(counts.of(decision)))
        .collect();
    cells.push(text(stacked_bar(counts, largest)).class("bar"));
    cells
}

/// Peak floor acceleration above which a building that stays elastic is hardly true \[g\].
const DAMAGED_FROM_G: f64 = 0.5;

fn floors(overview: &Overview, is_elastic: bool) -> Markup {
    let floors = overview.floors();
    if floors.is_empty() {
        return nothing_assessed();
    }
    let largest = floors
        .iter()
        .map(|floor| floor.counts.total())
        .max()
        .unwrap_or(0);
    let is_doubtful = |pfa_g: f64| is_elastic && pfa_g > DAMAGED_FROM_G;
    let headings = decision_headings(vec![text("Floor"), figure("Level"), figure("Median PFA")]);
    let rows = floors.iter().map(|floor| {
        let level = floor
            .level_ratio
            .map_or_else(|| "–".to_owned(), |level| fixed(level, 2));
        let pfa = floor.pfa_g_median.map_or_else(
            || "–".to_owned(),
            |pfa_g| {
                let elastic = if is_doubtful(pfa_g) {
                    " (elastic building)"
                } else {
                    ""
                };
                format!("{} g{elastic}", number(pfa_g, 3))
            },
        );
        let mut cells = vec![text(name(&floor.name)), figure(level), figure(pfa)];
        cells.extend(decision_cells(&floor.counts, largest));
        cells
    });
    html! {
        (table("", &headings, rows))
        p {
            "Number of objects by floor, from the top down, and by verdict. Median PFA: the median of the peak floor \
             accelerations of all worlds."
        }
        @if floors.iter().any(|floor| floor.pfa_g_median.is_some_and(is_doubtful)) {
            p {
                "Elastic building: in the calculation the building does not yield. One that yields mostly shakes its floors \
                 less."
            }
        }
    }
}

fn consequences(overview: &Overview) -> Markup {
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
            let mut cells = vec![text(consequence.name), text(rating), figure(counts.total())];
            cells.extend(decision_cells(counts, largest));
            rows.push(cells);
        }
    }
    if rows.is_empty() {
        return nothing_assessed();
    }
    html! {
        (table("", &headings, rows))
        p { "The three consequences of FEMA E-74, as rated in the inventory." }
    }
}

fn warnings(head: &Head, overview: &Overview) -> Markup {
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
    warnings.extend(head.problems.iter().chain(&head.warnings).cloned());
    if warnings.is_empty() {
        return html! { p { "None." } };
    }
    list(warnings.iter().map(|one| words(&KeyStyle::Flag.shown(one))))
}
