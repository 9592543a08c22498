use crate::assessment::fixture::{inventory, item, rows};

use super::*;

fn overview(count: usize, assessed: usize) -> Overview {
    let inventory = inventory((0..count).map(item).collect());
    let mut overview = Overview::new(count, 3);
    for row in &rows(&inventory, assessed) {
        overview.add(&Line::of(row));
    }
    overview
}

/// Of 24 items every fourth has no tolerance; the other 18 are restrained, left and softened in
/// turn, a third each.
#[test]
fn decisions_are_counted() {
    let overview = overview(24, 24);
    assert_eq!(
        Decision::ALL.map(|decision| overview.counts.of(decision)),
        [6, 6, 0, 6, 6]
    );
    assert_eq!(
        (
            overview.counts.total(),
            overview.without_tolerance,
            overview.tiers
        ),
        (24, 6, [6; 4])
    );
    // The quantities are 1, 2, 3, 1, 2, 3 …
    assert_eq!(overview.counts.pieces.iter().sum::<u64>(), 48);
    assert_eq!(overview.partial(), None);
    let consequence = |i: usize| {
        overview.consequences[i]
            .ratings
            .map(|counts| counts.total())
    };
    assert_eq!(
        (consequence(0), consequence(1), consequence(2)),
        ([8, 0, 8, 8], [0, 12, 0, 12], [24, 0, 0, 0])
    );
}

#[test]
fn the_list_holds_the_first_ranks() {
    let overview = overview(24, 24);
    let listed: Vec<(usize, &str)> = overview
        .urgent
        .values()
        .map(|one| (one.rank, one.id.as_str()))
        .collect();
    assert_eq!(listed, [(1, "O-0023"), (2, "O-0022"), (3, "O-0021")]);
}

#[test]
fn floors_come_from_the_roof_down_and_are_bounded() {
    let overview = overview(24, 24);
    let names: Vec<&str> = overview
        .floors()
        .iter()
        .map(|floor| floor.name.as_str())
        .collect();
    assert_eq!(
        names,
        [
            "Main, Level 4",
            "Main, Level 3",
            "Main, Level 2",
            "Main, Level 1",
            "Main, Level 0"
        ]
    );
    let mut items: Vec<_> = (0..250).map(item).collect();
    for item in &mut items {
        item.floor = format!("F{}", item.row);
    }
    let inventory = inventory(items);
    let mut overview = Overview::new(250, 3);
    for row in &rows(&inventory, 250) {
        overview.add(&Line::of(row));
    }
    let floors = overview.floors();
    assert_eq!(
        (floors.len(), floors.last().unwrap().name.as_str()),
        (MAX_FLOORS + 1, "other floors")
    );
    assert_eq!(
        floors
            .iter()
            .map(|floor| floor.counts.total())
            .sum::<usize>(),
        250
    );
}

#[test]
fn a_part_says_that_it_is_one() {
    let mut overview = overview(10, 4);
    overview.total = 10;
    assert!(
        overview
            .partial()
            .unwrap()
            .starts_with("PARTIAL: 4 of 10 objects")
    );
}

#[test]
fn a_place_is_said_once() {
    let mut one = item(0);
    one.location = "Main".into();
    assert_eq!(place(&one), "Main, Level 0, 100");
    for text in [
        &mut one.location,
        &mut one.building,
        &mut one.floor,
        &mut one.room,
    ] {
        text.clear();
    }
    assert_eq!(place(&one), "level 0");
    one.level_ratio = None;
    assert_eq!(place(&one), "");
}
