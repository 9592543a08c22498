//! Work orders: what whoever fits the restraints of a plan does in one room, to print and to sign; and the parts of
//! all rooms.

mod drawing;
mod parts;

use std::collections::{BTreeMap, BTreeSet, HashSet};

use freestand_assess::restraint::anchors::{bracket_at, of_each_anchor};
use freestand_input::file_names;
use freestand_input::problem::Problem;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{counted, number};
use freestand_inventory::library::{Confidence, RestraintKind};
use freestand_output::folder::OutputFolder;
use freestand_output::html::{ONE_PAGE_CSS, document, figure, properties, table, words};
use freestand_risk::budget::{BudgetPlan, PlanRow};
use freestand_study::study::TitleBlock;
use maud::{Markup, html};

use super::plan::standing_words;
use super::words::{amount, label};
use crate::restraint::force::{source_name, to_confirm};
use crate::signature::{ON_A_SHEET, SIGNATURE_CSS, Signing, signature};

pub use parts::{PARTS_NAME, PARTS_PAGE};
pub(super) use parts::{part_cells, part_headings};

/// The folder of the orders.
pub const ORDERS_FOLDER: &str = "orders";

/// The style of an order, added to that of a one-page report.
const CSS: &str = "\
.work { display: flex; gap: 1.2rem; align-items: flex-start; flex-wrap: wrap; }
.work > svg { flex: none; width: 24rem; max-width: 100%; height: auto; }
.work > div { flex: 1 1 20rem; min-width: 0; }
.object { border-top: 2px solid #1a1a1a; margin-top: 1.4rem; break-inside: avoid; }
.object h2 { margin: .4rem 0; border: none; padding: 0; overflow-wrap: anywhere; }
.sign { display: flex; gap: 1.5rem; margin-top: 1.6rem; break-inside: avoid; }
.sign span { flex: 1; border-top: 1px solid #1a1a1a; padding-top: .2rem; font-size: .85rem; color: #444; }
.fitted { display: flex; gap: 2rem; margin: .5rem 0 0; }
@media print {
  .object { margin-top: .7rem; }
  .work { flex-wrap: nowrap; gap: .8rem; }
  .work > svg { width: 76mm; }
  .work > div { flex-basis: 0; }
}
";

/// The work in one room.
pub(super) struct Order<'p> {
    /// Its file in the folder of the results.
    pub(super) file: String,
    /// The room in words.
    pub(super) room: String,
    /// The floor, the building and the site; empty where none is known.
    place: String,
    /// What is fitted there.
    pub(super) rows: Vec<&'p PlanRow>,
}

/// What an order is for: site, building, floor, and room or another place.
type Place<'p> = [&'p str; 4];

/// The orders of a plan, by site, building, floor and room. `sites` has the site of each row of the plan.
pub(super) fn orders<'p>(plan: &'p BudgetPlan, sites: Option<&'p [String]>) -> Vec<Order<'p>> {
    let mut rooms: BTreeMap<Place<'p>, Vec<&PlanRow>> = BTreeMap::new();
    for (at, row) in plan.rows.iter().enumerate() {
        if !row.is_planned() {
            continue;
        }
        let site = sites
            .and_then(|sites| sites.get(at))
            .map_or("", String::as_str);
        let object = &row.object;
        let room = match object.room.as_str() {
            "" => object.location.as_str(),
            room => room,
        };
        let place = [site, &object.building, &object.floor, room].map(str::trim);
        rooms.entry(place).or_default().push(row);
    }
    let mut taken = HashSet::new();
    let mut order = |(place, rows): (Place, Vec<&'p PlanRow>)| {
        let [site, building, floor, room] = place;
        let given: Vec<&str> = place.into_iter().filter(|part| !part.is_empty()).collect();
        let stem = match room {
            "" => file_names::of_words(&format!("{} no room", given.join(" "))),
            _ => file_names::of_words(&given.join(" ")),
        };
        let name = file_names::unique(&stem, &mut taken);
        let above: Vec<&str> = [site, building, floor]
            .into_iter()
            .filter(|part| !part.is_empty())
            .collect();
        Order {
            file: format!("{ORDERS_FOLDER}/{name}.html"),
            room: match room {
                "" => "no room in the list".to_owned(),
                room => room.to_owned(),
            },
            place: above.join(", "),
            rows,
        }
    };
    rooms.into_iter().map(&mut order).collect()
}

/// Writes the orders, and the parts of all of them as a page and as a table.
///
/// # Errors
/// A full disk.
pub(super) fn write_orders(
    folder: &OutputFolder,
    plan: &BudgetPlan,
    sites: Option<&[String]>,
    title: &TitleBlock,
    signing: Signing,
) -> Result<(), Problem> {
    let orders = orders(plan, sites);
    for order in &orders {
        folder.write(&order.file, page(plan, order, title, signing).as_bytes())?;
    }
    folder.write(PARTS_NAME, parts::csv(plan)?.as_ref())?;
    folder.write(PARTS_PAGE, parts::page(plan, &orders).as_bytes())
}

/// Links to the orders and to the parts, for a page in the folder of the results.
pub(super) fn links(plan: &BudgetPlan) -> Markup {
    let orders = orders(plan, None);
    html! {
        @if !orders.is_empty() {
            h3 { "Work orders, one for each room" }
            p { "The parts of all rooms: " a href=(PARTS_PAGE) { (PARTS_PAGE) } ", " (PARTS_NAME) "." }
            (rooms(plan, &orders))
        }
    }
}

/// A row for each room, with a link to its order.
fn rooms(plan: &BudgetPlan, orders: &[Order]) -> Markup {
    let headings = [
        words("room"),
        words("where"),
        figure("objects"),
        figure("work"),
        figure(format!("cost ({})", plan.currency)),
    ];
    let row = |order: &Order| {
        [
            words(html! { a href=(order.file) { (order.room) } }),
            words(&order.place),
            figure(pieces(&order.rows)),
            figure(hours(minutes(&order.rows))),
            figure(range(cost(&order.rows))),
        ]
    };
    table("", &headings, orders.iter().map(row))
}

fn pieces(rows: &[&PlanRow]) -> u32 {
    rows.iter()
        .fold(0, |sum, row| sum.saturating_add(row.quantity))
}

/// Work; `None`: that of some row is not known \[min\].
fn minutes(rows: &[&PlanRow]) -> Option<f64> {
    rows.iter().try_fold(0.0, |sum, row| {
        Some(sum + f64::from(row.quantity) * row.fitting.minutes?)
    })
}

/// The low and the high end of what the work of these rows costs, with its parts.
fn cost(rows: &[&PlanRow]) -> [f64; 2] {
    rows.iter().fold([0.0; 2], |[low, high], row| {
        [low + row.cost[0], high + row.cost[2]]
    })
}

/// `156–269`.
fn range([low, high]: [f64; 2]) -> String {
    match (amount(low), amount(high)) {
        (low, high) if low == high => low,
        (low, high) => format!("{low}–{high}"),
    }
}

/// `45 min`, `2.5 h`.
fn hours(minutes: Option<f64>) -> String {
    match minutes {
        None => "unknown".to_owned(),
        Some(minutes) if minutes < 120.0 => format!("{} min", number(minutes, 3)),
        Some(minutes) => format!("{} h", number(minutes / 60.0, 3)),
    }
}

/// How far a value can be trusted, as a word beside it.
fn confidence(word: Confidence) -> String {
    format!("confidence: {}", word.name())
}

/// The values of these rows that are quoted from memory.
pub(super) fn recalled<'r>(rows: impl Iterator<Item = &'r PlanRow>) -> Vec<String> {
    let mut found = BTreeSet::new();
    for row in rows {
        if row.capacity_confidence == Some(Confidence::Recalled) {
            found.insert(format!("capacity of {}", row.measure));
        }
        if row.price_confidence == Confidence::Recalled {
            found.insert(format!("price of {}", row.measure));
        }
        if let Some(force) = &row.object.force {
            let unread = to_confirm(&force.source).into_iter();
            let name = source_name(&force.source);
            found.extend(unread.map(|one| format!("{name}: {}", one.what)));
        }
        let place = row.object.approximate_place.iter();
        found.extend(place.map(|place| format!("hazard of {place}")));
    }
    found.into_iter().collect()
}

/// The page of one room.
fn page(plan: &BudgetPlan, order: &Order, title: &TitleBlock, signing: Signing) -> String {
    let facts = [
        ("Objects", pieces(&order.rows).to_string()),
        ("Work", hours(minutes(&order.rows))),
        (
            match order.rows.iter().all(|row| row.fitting.work.is_some()) {
                true => "Cost of parts and work",
                false => "Cost, without work that is not known",
            },
            format!("{} {}", range(cost(&order.rows)), plan.currency),
        ),
        ("Date", title.date.clone().unwrap_or_default()),
        ("Prepared by", title.preparer.clone().unwrap_or_default()),
        ("Revision", title.revision.clone().unwrap_or_default()),
    ];
    let lines = html! {
        div.sign { span { "Fitted by" } span { "Checked by" } span { "Date and signature" } }
    };
    let recalled = recalled(order.rows.iter().copied());
    let content = html! {
        (properties("", &facts))
        @for row in &order.rows { (object(plan, row)) }
        p {
            "Before you drill, look for pipes and cables, and find out what the wall or the floor is made of. Where the force by \
             the code and that in the simulated earthquakes differ, the larger one counts. These are the forces that the \
             restraint must carry; the wall, the floor and the part of the object that is held need checks of their own."
        }
        (signature(lines, &recalled, ON_A_SHEET, signing))
    };
    document(
        &format!("Work order: {}", order.room),
        &order.place,
        &format!("{ONE_PAGE_CSS}{SIGNATURE_CSS}{CSS}"),
        &content,
    )
}

/// What is fitted to one object.
fn object(plan: &BudgetPlan, row: &PlanRow) -> Markup {
    let many = match row.quantity {
        1 => String::new(),
        many => format!(" × {many}"),
    };
    let name = format!("{} {}{many}", row.id, row.item);
    html! {
        section.object {
            h2 { (name.trim()) }
            div.work {
                @if let Some(drawing) = drawing::drawing(row) {
                    (drawing)
                } @else {
                    p { "There is no drawing: its height or its thickness is not known." }
                }
                div {
                    (properties("", &facts(plan, row)))
                    p.fitted { span { "☐ fitted" } span { "Initials: ____________" } }
                }
            }
        }
    }
}

fn facts(plan: &BudgetPlan, row: &PlanRow) -> Vec<(&'static str, String)> {
    let (fitting, units) = (&row.fitting, row.object.units);
    let currency = &plan.currency;
    let [low, high] = fitting.price;
    let force = match &row.object.force {
        Some(force) => {
            let unread = to_confirm(&force.source).into_iter().map(|one| one.what);
            let unread: Vec<String> = unread.collect();
            let recalled = match unread.as_slice() {
                [] => String::new(),
                unread => format!("; an engineer must confirm {}", unread.join(", ")),
            };
            format!(
                "{} at its centre of gravity, by {}{recalled}",
                units.force(force.force_n),
                source_name(&force.source)
            )
        }
        None => UNKNOWN_FORCE.to_owned(),
    };
    let work = match fitting.minutes {
        None => "unknown: the list of restraints does not say how long it takes".to_owned(),
        each if row.quantity == 1 => hours(each),
        each => format!("{} each, {} in all", hours(each), hours(minutes(&[row]))),
    };
    vec![
        (
            "Restraint",
            format!("{} ({})", row.measure_item, row.measure),
        ),
        ("Quantity", row.quantity.to_string()),
        (
            "Verdict",
            format!("{}; {}", label(row.decision), standing_words(row.standing)),
        ),
        (
            "Mass",
            row.object
                .mass_kg
                .map_or_else(|| "unknown".to_owned(), |mass_kg| units.mass(mass_kg)),
        ),
        ("Force", force),
        ("Each anchor", each_anchor(row)),
        ("In the simulated earthquakes", simulated(row)),
        ("Work", work),
        (
            "Parts",
            format!(
                "{} {currency} each: {} ({})",
                range([low, high]),
                fitting.price_source,
                confidence(row.price_confidence)
            ),
        ),
        (
            match fitting.work {
                Some(_) => "Parts and work, all",
                None => "Parts without work, all",
            },
            format!("{} {currency}", range([row.cost[0], row.cost[2]])),
        ),
        ("Note", fitting.note.clone()),
    ]
}

const UNKNOWN_FORCE: &str = "unknown: no force of its restraint was calculated";

/// What each anchor of a restraint carries, in words: by the code or in the simulated earthquakes, whichever is more.
fn each_anchor(row: &PlanRow) -> String {
    let object = &row.object;
    let units = object.units;
    if row.kind == RestraintKind::WheelLock {
        return "none: nothing is fixed to the building".to_owned();
    }
    let Some(force) = &object.force else {
        return UNKNOWN_FORCE.to_owned();
    };
    let Some(count) = row.fitting.anchors else {
        return "unknown: the list of restraints does not say how many anchors share the force"
            .to_owned();
    };
    let simulated_n = row.effect.as_ref().and_then(|effect| effect.force_n);
    let larger = |by_code_n: f64, simulated_n: f64| match simulated_n > by_code_n {
        true => (simulated_n, " (in the simulated earthquakes)"),
        false => (by_code_n, ""),
    };
    if row.kind == RestraintKind::BasePlate {
        let per_edge = (usize::from(count) / 2).max(1);
        let each = of_each_anchor(force, per_edge);
        let simulated_n = simulated_n.unwrap_or(0.0) / per_edge as f64;
        let (tension_n, whence) = larger(each.tension_concrete_n, simulated_n);
        return format!(
            "of {per_edge} along each edge, in concrete: tension {}{whence}, shear {}",
            tension(units, tension_n),
            units.force(each.shear_concrete_n)
        );
    }
    let Some(height_m) = object.height_m else {
        return "unknown: the height of the object is not known".to_owned();
    };
    let at_m = row.fitting.height_ratio * height_m;
    let (all_n, whence) = larger(bracket_at(force, at_m), simulated_n.unwrap_or(0.0));
    format!(
        "{} on each of {}, shared equally (assumed): {} in all{whence} at {}, outwards or along the wall",
        units.force(all_n / f64::from(count)),
        counted(count.into(), "anchor"),
        units.force(all_n),
        units.length(at_m)
    )
}

fn tension(units: UnitSystem, tension_n: f64) -> String {
    if tension_n > 0.0 {
        units.force(tension_n)
    } else {
        "none, its weight holds it down".to_owned()
    }
}

/// What the restraint carries in the simulated earthquakes, and what it can carry.
fn simulated(row: &PlanRow) -> String {
    let units = row.object.units;
    let force = row.effect.as_ref().and_then(|effect| effect.force_n);
    let capacity = match (row.capacity_n, row.capacity_confidence) {
        (Some(capacity_n), Some(word)) => format!(
            "median capacity {}: {} ({})",
            units.force(capacity_n),
            row.fitting.capacity_source,
            confidence(word)
        ),
        (Some(capacity_n), None) => format!("median capacity {}", units.force(capacity_n)),
        (None, _) => String::new(),
    };
    match force {
        Some(force_n) => {
            let capacity = match capacity.as_str() {
                "" => "its capacity is unknown",
                known => known,
            };
            let beyond = match row.capacity_n {
                Some(capacity_n) if force_n > capacity_n => {
                    ". This is more than the median capacity: ask an engineer for a stronger restraint"
                }
                _ => "",
            };
            format!(
                "at most {} on the restraint, except in the share of them that is accepted for the fall of this object; \
                 {capacity}{beyond}",
                units.force(force_n)
            )
        }
        None => capacity,
    }
}

#[cfg(test)]
mod tests;
