//! The parts of all rooms: a row for each restraint, with their sum.

use std::collections::BTreeMap;

use freestand_input::problem::Problem;
use freestand_input::words::counted;
use freestand_output::answer;
use freestand_output::answer::table_of;
use freestand_output::html::{Cell, document, figure, table as html_table, words};
use freestand_output::table::Table;
use freestand_risk::budget::{BudgetPlan, PlanRow};
use maud::{Markup, html};

use super::{Order, confidence, cost, hours, minutes, pieces, range, rooms};
use crate::assessment::sheet_cell::SheetCell;

/// The page of the parts, which also links to the orders.
pub const PARTS_PAGE: &str = "parts.html";

/// Their table.
pub const PARTS_NAME: &str = "parts.csv";

/// One restraint, wherever it is fitted.
struct Part<'p> {
    row: &'p PlanRow,
    quantity: u32,
    anchors: Option<u64>,
    price: [f64; 2],
    minutes: Option<f64>,
    cost: [f64; 2],
}

/// The parts by the ids of the restraints.
fn parts(plan: &BudgetPlan) -> Vec<Part<'_>> {
    let mut by_measure: BTreeMap<&str, Vec<&PlanRow>> = BTreeMap::new();
    for row in plan.planned() {
        by_measure.entry(&row.measure).or_default().push(row);
    }
    by_measure
        .into_values()
        .filter_map(|rows| part(&rows))
        .collect()
}

fn part<'p>(rows: &[&'p PlanRow]) -> Option<Part<'p>> {
    let row = *rows.first()?;
    let quantity = pieces(rows);
    let many = f64::from(quantity);
    let of_each = row.fitting.anchors;
    Some(Part {
        row,
        quantity,
        anchors: of_each.map(|each| u64::from(each) * u64::from(quantity)),
        price: row.fitting.price.map(|price| many * price),
        minutes: minutes(rows),
        cost: cost(rows),
    })
}

answer! {
    /// A restraint of the plan, wherever it is fitted.
    pub struct PartRow {
        measure: String,
        item: String,
        quantity: usize,
        /// Anchors of all of them; empty: not known.
        anchors: Option<usize>,
        /// Without work.
        parts_low: f64,
        parts_high: f64,
        /// Empty: not known.
        work_minutes: Option<f64>,
        /// With work, as far as what it costs is known.
        cost_low: f64,
        cost_high: f64,
        currency: String,
        price_confidence: &'static str,
        price_source: String,
    }
}

/// `parts.csv`; the sum is for people, and not among the rows.
pub(super) fn csv(plan: &BudgetPlan) -> Result<Table, Problem> {
    let parts = parts(plan).into_iter();
    let rows: Vec<PartRow> = parts
        .map(|part| PartRow {
            measure: part.row.measure.clone(),
            item: part.row.measure_item.clone(),
            quantity: part.quantity as usize,
            anchors: part.anchors.map(|count| count as usize),
            parts_low: part.price[0],
            parts_high: part.price[1],
            work_minutes: part.minutes,
            cost_low: part.cost[0],
            cost_high: part.cost[1],
            currency: plan.currency.clone(),
            price_confidence: part.row.price_confidence.name(),
            price_source: part.row.fitting.price_source.clone(),
        })
        .collect();
    table_of(&rows)
}

/// The headings of the sheet, with the widths of their columns.
pub(crate) fn part_headings(plan: &BudgetPlan) -> Vec<(String, f64)> {
    let money = |head: &str| (format!("{head} [{}]", plan.currency), 12.0);
    let plain = |head: &str, width: f64| (head.to_owned(), width);
    vec![
        plain("restraint", 18.0),
        plain("what it is", 48.0),
        plain("quantity", 9.0),
        plain("anchors", 9.0),
        money("parts, low"),
        money("parts, high"),
        plain("work [min]", 10.0),
        money("all, low"),
        money("all, high"),
        plain("confidence of the price", 14.0),
        plain("source of the price", 48.0),
    ]
}

/// The rows of the sheet, and their sum.
pub(crate) fn part_cells(plan: &BudgetPlan) -> Vec<Vec<SheetCell>> {
    let number = |value: f64| SheetCell::Number(Some(value));
    let text = |value: &str| SheetCell::Text(value.to_owned());
    let parts = parts(plan);
    let cells = |measure: &str, what: &str, of: &[Part]| {
        let sum = Sum::of(of);
        vec![
            text(measure),
            text(what),
            number(f64::from(sum.quantity)),
            SheetCell::Number(sum.anchors.map(|count| count as f64)),
            number(sum.price[0]),
            number(sum.price[1]),
            SheetCell::Number(sum.minutes),
            number(sum.cost[0]),
            number(sum.cost[1]),
        ]
    };
    let row = |part: &Part| {
        let (row, one) = (&part.row, std::slice::from_ref(part));
        let mut cells = cells(&row.measure, &row.measure_item, one);
        cells.push(text(row.price_confidence.name()));
        cells.push(text(&row.fitting.price_source));
        cells
    };
    let mut rows: Vec<Vec<SheetCell>> = parts.iter().map(row).collect();
    rows.push(cells("all", "", &parts));
    rows
}

/// All parts together.
struct Sum {
    quantity: u32,
    /// `None`: the anchors of some part are not known.
    anchors: Option<u64>,
    price: [f64; 2],
    /// `None`: that of some part is not known \[min\].
    minutes: Option<f64>,
    cost: [f64; 2],
}

impl Sum {
    fn of(parts: &[Part]) -> Self {
        let add = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
        let nothing = Self {
            quantity: 0,
            anchors: Some(0),
            price: [0.0; 2],
            minutes: Some(0.0),
            cost: [0.0; 2],
        };
        parts.iter().fold(nothing, |sum, part| Self {
            quantity: sum.quantity.saturating_add(part.quantity),
            anchors: sum.anchors.zip(part.anchors).map(|(a, b)| a + b),
            price: add(sum.price, part.price),
            minutes: sum.minutes.zip(part.minutes).map(|(a, b)| a + b),
            cost: add(sum.cost, part.cost),
        })
    }
}

/// `parts.html`.
pub(super) fn page(plan: &BudgetPlan, orders: &[Order]) -> String {
    let subtitle = format!(
        "Of the plan within the budget · freestand {}",
        env!("CARGO_PKG_VERSION")
    );
    let parts = parts(plan);
    let content = html! {
        @if parts.is_empty() {
            p { "The plan restrains nothing: there is nothing to buy." }
        } @else {
            (table_of_parts(plan, &parts))
            h3 { "Work orders: " (counted(orders.len(), "room")) }
            (rooms(plan, orders))
        }
    };
    document("Parts and work orders", &subtitle, "", &content)
}

/// The parts, and their sum.
fn table_of_parts(plan: &BudgetPlan, parts: &[Part]) -> Markup {
    let head = |text: &str| figure(format!("{text} ({})", plan.currency));
    let all = match parts.iter().all(|part| part.row.fitting.work.is_some()) {
        true => "parts and work",
        false => "parts, and work that is known",
    };
    let headings = [
        words("restraint"),
        words("what it is"),
        figure("quantity"),
        figure("anchors"),
        head("parts"),
        figure("work"),
        head(all),
        words("price"),
    ];
    let cells = |measure: &str, what: &str, price: &str, of: &[Part]| -> [Cell; 8] {
        let sum = Sum::of(of);
        let anchors = sum.anchors.map(|count| count.to_string());
        [
            words(measure),
            words(what),
            figure(sum.quantity),
            figure(anchors.as_deref().unwrap_or("unknown")),
            figure(range(sum.price)),
            figure(hours(sum.minutes)),
            figure(range(sum.cost)),
            words(price),
        ]
    };
    let row = |part: &Part| {
        let (source, confidence) = (
            &part.row.fitting.price_source,
            confidence(part.row.price_confidence),
        );
        cells(
            &part.row.measure,
            &part.row.measure_item,
            &format!("{source} ({confidence})"),
            std::slice::from_ref(part),
        )
    };
    let sum = cells("all", "", "", parts);
    html_table("", &headings, parts.iter().map(row).chain([sum]))
}
