//! The page of one object: the verdict, what was written in the inventory, and what was found.

use freestand::rocking::Restitution;
use freestand_study::assess::Row;
use freestand_study::assess::overview::place;
use freestand_study::assess::result::FloorFacts;
use freestand_study::cushion::cushion_words;
use freestand_study::inventory::{Item, Rating};

use crate::block::{Block, Page};
use crate::details;
use crate::text::{millimetres, number, optional, or_dash, percent, quantity, shortened};

/// The page of a row.
pub(crate) fn page(row: &Row<'_>) -> Page {
    let (item, found) = (row.item, &row.found);
    let mut blocks = vec![Block::Verdict { decision: found.decision.name(), why: found.why.clone() }];
    blocks.extend(details::chances(found));
    let written = Block::Facts { title: "The object, as the inventory has it", pairs: as_written(item) };
    let behaviour = Block::Facts { title: "What it does", pairs: details::behaviour(found) };
    blocks.push(Block::Beside { left: Box::new(written), right: Box::new(behaviour) });
    blocks.extend(details::axes(found));
    match (details::capacity(found), details::softening(found)) {
        (Some(left), Some(right)) => blocks.push(Block::Beside { left: Box::new(left), right: Box::new(right) }),
        (capacity, softening) => blocks.extend(capacity.into_iter().chain(softening)),
    }
    blocks.extend(details::restraint(found));
    blocks.extend(details::tornado(found));
    blocks.extend(details::chain(found));
    blocks.push(Block::List { title: "Other people's numbers", items: found.context.clone(), is_warning: false });
    blocks.push(Block::List { title: "Assumptions and doubts", items: found.notes.clone(), is_warning: true });
    Page {
        anchor: anchor(row.rank),
        running: format!("{} · {} · {}", row.rank, shortened(&item.id, 24), shortened(&item.item, 60)),
        title: if item.item.trim().is_empty() { item.id.clone() } else { item.item.clone() },
        subtitle: format!("{} · place {} of the list · row {} of the inventory", item.id, row.rank, item.row),
        blocks,
    }
}

/// What links to a page say.
pub(crate) fn anchor(rank: usize) -> String {
    format!("object-{rank}")
}

fn rating(rating: Option<Rating>) -> &'static str {
    match rating {
        Some(Rating::High) => "high",
        Some(Rating::Medium) => "medium",
        Some(Rating::Low) => "low",
        None => "–",
    }
}

fn as_written(item: &Item) -> Vec<(String, String)> {
    let consequences = &item.consequences;
    let mut pairs = vec![
        ("Where", or_dash(&place(item))),
        ("Level", item.level_ratio.map_or("–".to_owned(), |z| format!("{} of the height", number(z, 3)))),
        ("Quantity, priority", format!("{}, {}", item.quantity, or_dash(&item.priority))),
        (
            "LS, PL, FL (FEMA E-74)",
            format!(
                "{}, {}, {}",
                rating(consequences.life_safety),
                rating(consequences.property),
                rating(consequences.function)
            ),
        ),
        ("Height, sides", sides(item)),
        ("Base", bases(item)),
        (
            "Centre of gravity",
            item.cg_height_m.map_or("at half the height".to_owned(), |h| format!("{} up", millimetres(h))),
        ),
        ("Mass", optional(item.mass_kg, 4, "kg")),
        ("Under one edge", item.cushion.as_ref().map_or("–".to_owned(), |edge| cushion_words(&edge.cushion))),
        ("Restitution", restitution(item.restitution)),
        (
            "Friction",
            item.friction_ratio
                .map_or("–".to_owned(), |(low, high)| format!("{} to {}", number(low, 3), number(high, 3))),
        ),
    ];
    if let Some(source) = &item.cushion_source {
        pairs.push(("Source of the cushion", source.clone()));
    }
    if let Some(ratio) = item.accepted_ratio {
        pairs.push(("Accepted by its owner", percent(ratio)));
    }
    if !item.notes.trim().is_empty() {
        pairs.push(("Notes", item.notes.clone()));
    }
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn side(value_m: Option<f64>) -> String {
    value_m.map_or("–".to_owned(), |value| number(1000.0 * value, 4))
}

fn sides(item: &Item) -> String {
    format!("{} × {} × {} mm", side(item.height_m), side(item.thickness_m), side(item.width_m))
}

fn bases(item: &Item) -> String {
    if item.base_thickness_m.is_none() && item.base_width_m.is_none() {
        return "the full sides".to_owned();
    }
    format!("{} × {} mm", side(item.base_thickness_m.or(item.thickness_m)), side(item.base_width_m.or(item.width_m)))
}

fn restitution(restitution: Restitution) -> String {
    match restitution {
        Restitution::Housner => "Housner's".to_owned(),
        Restitution::Value(value) => number(value, 3),
        Restitution::Factor(factor) => format!("{} × Housner's", number(factor, 3)),
    }
}

/// The floor in one line.
pub(crate) fn floor_words(floor: &FloorFacts) -> String {
    format!(
        "{} of the height: peak acceleration {} (median), {} (largest); peak velocity {} (median)",
        number(floor.level_ratio, 3),
        quantity(floor.pfa_g_median, 3, "g"),
        quantity(floor.pfa_g_max, 3, "g"),
        quantity(floor.pfv_m_s_median, 3, "m/s"),
    )
}
