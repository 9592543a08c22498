//! The first pages: counts, what to restrain first, floors, consequences, and what it all rests on.

use std::collections::BTreeSet;

use freestand_study::assess::overview::{Counts, Overview, RATINGS, Urgent};
use freestand_study::assess::words::{HOW_TO_READ, advice, probability, tier};
use freestand_study::assess::{Decision, Head, Row};
use freestand_study::result::Ranked;

use crate::block::{Block, Cell, Column, Count};
use crate::object::anchor;
use crate::text::{number, or_dash, percent, quantity, ranked};

/// The summary of an assessment whose `pages` follow it.
pub(crate) fn summary(head: &Head, overview: &Overview, pages: &[Row<'_>]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let doubts: Vec<String> = overview.partial().into_iter().chain(head.warnings.iter().cloned()).collect();
    if overview.partial().is_some() {
        blocks.push(warnings(doubts.clone()));
    }
    blocks.push(counts(overview));
    blocks.push(urgent(overview, pages));
    blocks.push(floors(overview));
    blocks.push(consequences(overview));
    blocks.push(Block::Facts { title: "How it was decided", pairs: decided(overview) });
    if overview.partial().is_none() {
        blocks.push(warnings(doubts));
    }
    blocks.push(Block::Facts { title: "What it rests on", pairs: head.facts.clone() });
    blocks.push(Block::List { title: "Assumptions", items: head.assumptions.clone(), is_warning: false });
    let reading = HOW_TO_READ.map(str::to_owned).to_vec();
    blocks.push(Block::List { title: "How to read it", items: reading, is_warning: false });
    blocks.push(objects(overview, pages));
    blocks
}

fn warnings(items: Vec<String>) -> Block {
    Block::List { title: "Doubts", items, is_warning: true }
}

fn counts(overview: &Overview) -> Block {
    let rows = Decision::ALL
        .into_iter()
        .zip(overview.counts.pieces)
        .map(|(decision, pieces)| {
            let objects = overview.counts.of(decision);
            let count =
                if pieces == objects as u64 { objects.to_string() } else { format!("{objects} ({pieces} pieces)") };
            Count { decision: decision.name(), count, meaning: advice(decision) }
        })
        .collect();
    Block::Counts { rows }
}

fn urgent(overview: &Overview, pages: &[Row<'_>]) -> Block {
    let with_page: BTreeSet<usize> = pages.iter().map(|row| row.rank).collect();
    let row = |urgent: &Urgent| {
        let name = if urgent.item.is_empty() { urgent.id.clone() } else { format!("{} ({})", urgent.item, urgent.id) };
        let chance = urgent.probability.map_or("–".to_owned(), |p| {
            let of = if urgent.is_overturn_only { ", overturns" } else { "" };
            format!("{}{of}", probability(p))
        });
        vec![
            Cell::from(urgent.rank.to_string()),
            Cell::Decision { decision: urgent.decision.name() },
            linked(name, urgent.rank, &with_page),
            or_dash(&urgent.place).into(),
            or_dash(urgent.governing.as_deref().unwrap_or_default()).into(),
            demand(urgent.demand_capacity).into(),
            chance.into(),
        ]
    };
    Block::Table {
        title: "What to do first".to_owned(),
        note: "The most urgent of the list, by the probability that the shock exceeds what the object stands or that it falls."
            .to_owned(),
        columns: vec![
            Column::number("#"),
            Column::text("do"),
            Column::wide("object", 5),
            Column::wide("where", 4),
            Column::wide("governs", 2),
            Column::number("D/C"),
            Column::wide("probability (95 %)", 3),
        ],
        rows: overview.urgent.values().map(row).collect(),
    }
}

fn linked(text: String, rank: usize, with_page: &BTreeSet<usize>) -> Cell {
    if with_page.contains(&rank) { Cell::Link { text, anchor: anchor(rank) } } else { Cell::Text(text) }
}

fn demand(value: Option<Ranked>) -> String {
    value.map_or("–".to_owned(), |value| ranked(value, 1.0, 3))
}

fn tally(counts: &Counts) -> impl Iterator<Item = Cell> {
    counts.objects.into_iter().map(|count| Cell::from(if count == 0 { "–".to_owned() } else { count.to_string() }))
}

fn floors(overview: &Overview) -> Block {
    let mut columns = vec![Column::wide("floor", 1), Column::number("level"), Column::number("median PFA [g]")];
    columns.extend(Decision::ALL.map(|decision| Column::number(decision.name())));
    let rows = overview
        .floors()
        .into_iter()
        .map(|floor| {
            let number = |value: Option<f64>| value.map_or("–".to_owned(), |value| number(value, 3));
            let mut cells: Vec<Cell> =
                vec![floor.name.as_str().into(), number(floor.level_ratio).into(), number(floor.pfa_g_median).into()];
            cells.extend(tally(&floor.counts));
            cells
        })
        .collect();
    Block::Table { title: "Floors, the highest first".to_owned(), note: String::new(), columns, rows }
}

fn consequences(overview: &Overview) -> Block {
    let mut columns = vec![Column::wide("consequence", 1), Column::text("rated")];
    columns.extend(Decision::ALL.map(|decision| Column::number(decision.name())));
    let mut rows = Vec::new();
    for consequence in &overview.consequences {
        for (rating, counts) in RATINGS.iter().zip(&consequence.ratings).filter(|(_, counts)| counts.total() > 0) {
            let mut cells: Vec<Cell> = vec![consequence.name.into(), (*rating).into()];
            cells.extend(tally(counts));
            rows.push(cells);
        }
    }
    Block::Table { title: "Consequences".to_owned(), note: String::new(), columns, rows }
}

fn decided(overview: &Overview) -> Vec<(String, String)> {
    let tiers: Vec<String> = (0u8..)
        .zip(overview.tiers)
        .filter(|(_, count)| *count > 0)
        .map(|(number, count)| format!("{count} by {}", tier(number)))
        .collect();
    let mut pairs = vec![
        ("Objects", format!("{} assessed of {}", overview.assessed, overview.total)),
        ("What decided", or_dash(&tiers.join("; "))),
    ];
    if !overview.governing.is_empty() {
        let governing: Vec<String> = overview.governing.iter().map(|(name, count)| format!("{name} {count}")).collect();
        pairs.push(("Criterion that governs", governing.join(", ")));
    }
    let missing = [
        (overview.without_tolerance, "without a tolerance"),
        (overview.without_response, "without a history: geometry or level is missing, or no motion could be followed"),
        (overview.with_failed_motions, "with a motion that could not be followed to its end"),
    ];
    let missing: Vec<String> =
        missing.into_iter().filter(|(count, _)| *count > 0).map(|(count, words)| format!("{count} {words}")).collect();
    if !missing.is_empty() {
        pairs.push(("What is missing", missing.join("; ")));
    }
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Every object that has a page.
fn objects(overview: &Overview, pages: &[Row<'_>]) -> Block {
    let rows = pages
        .iter()
        .map(|row| {
            let found = &row.found;
            let chance = found.p_exceed.or(found.p_overturn);
            let capacity = found.capacity.as_ref();
            vec![
                Cell::from(row.rank.to_string()),
                Cell::Decision { decision: found.decision.name() },
                Cell::Link { text: row.item.id.clone(), anchor: anchor(row.rank) },
                row.item.item.as_str().into(),
                found.floor.as_ref().map_or("–".to_owned(), |floor| quantity(floor.pfa_g_median, 3, "g")).into(),
                demand(found.shock.as_ref().map(|shock| shock.edge_acceleration_g[1])).into(),
                demand(capacity.map(|capacity| capacity.demand_capacity)).into(),
                chance.map_or("–".to_owned(), |p| percent(p.value)).into(),
            ]
        })
        .collect();
    let note = if pages.len() < overview.assessed {
        format!("The {} most urgent of {}; the others are in objects.csv.", pages.len(), overview.assessed)
    } else {
        "PFA: of its floor; shock, D/C: of the median motion; P: exceeded or overturned, overturned alone where no tolerance is known."
            .to_owned()
    };
    Block::Table {
        title: "The objects, the most urgent first".to_owned(),
        note,
        columns: vec![
            Column::number("#"),
            Column::text("do"),
            Column::wide("id", 2),
            Column::wide("object", 5),
            Column::number("PFA"),
            Column::number("shock [g]"),
            Column::number("D/C"),
            Column::number("P"),
        ],
        rows,
    }
}
