//! Lists in different styles and languages, scored cell by cell against their true values.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand_inventory::library::Lookup;
use freestand_inventory::{Floors, Item, Rating, ReadOptions, Reading, inspect_inventory};

/// The cells of an object as a list of true values has them.
fn cells(item: &Item) -> BTreeMap<&'static str, String> {
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    let rated = |rating: Option<Rating>| rating.map_or("", Rating::name).to_owned();
    let tolerance = item.tolerance.as_ref();
    let doubts: Vec<&str> = item.doubts.iter().map(|kind| kind.name()).collect();
    BTreeMap::from([
        ("row", item.row.to_string()),
        ("id", item.id.clone()),
        ("item", item.item.clone()),
        ("quantity", item.quantity.to_string()),
        ("floor", item.floor.clone()),
        ("room", item.room.clone()),
        ("level_ratio", number(item.level_ratio)),
        ("height_m", number(item.height_m)),
        ("thickness_m", number(item.thickness_m)),
        ("width_m", number(item.width_m)),
        ("cg_height_m", number(item.cg_height_m)),
        ("mass_kg", number(item.mass_kg)),
        (
            "stiffness_n_m",
            number(
                item.cushion
                    .as_ref()
                    .and_then(|edge| edge.cushion.linear_stiffness_n_m()),
            ),
        ),
        (
            "tolerance_g",
            number(
                tolerance
                    .and_then(|one| one.peak_m_s2)
                    .map(|peak| peak / G0_M_S2),
            ),
        ),
        (
            "tolerance_duration_s",
            number(tolerance.and_then(|one| one.duration_s)),
        ),
        (
            "anchored",
            item.anchored.map_or_else(String::new, |is| is.to_string()),
        ),
        ("life_safety", rated(item.consequences.life_safety)),
        ("property", rated(item.consequences.property)),
        ("function", rated(item.consequences.function)),
        ("section", item.section.clone()),
        ("doubts", doubts.join(" ")),
    ])
}

/// Whether two cells say the same; numbers are compared to the digits that are written.
fn is_same(found: &str, truth: &str) -> bool {
    match (found.parse::<f64>(), truth.parse::<f64>()) {
        // True values have at least seven digits, a third of a storey sixteen.
        (Ok(a), Ok(b)) => (a - b).abs() <= 5e-7 * b.abs(),
        _ => found == truth,
    }
}

fn read(path: &Path, storeys: Option<usize>) -> Reading {
    let options = ReadOptions {
        floors: Floors {
            storeys,
            ..Floors::default()
        },
        ..ReadOptions::new(&Lookup::NONE)
    };
    inspect_inventory(path, &options).unwrap()
}

/// A list (beside its true values, or one of the examples), the number of storeys of its building, and
/// its true values.
struct Truth {
    list: PathBuf,
    storeys: Option<usize>,
    rows: Vec<BTreeMap<String, String>>,
}

fn truths() -> Vec<Truth> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/lists");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let is_truth = |path: &&PathBuf| path.to_string_lossy().ends_with(".true.csv");
    paths
        .iter()
        .filter(is_truth)
        .map(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let (first, table) = text.split_once('\n').unwrap();
            let mut reader = csv::Reader::from_reader(table.as_bytes());
            let facts: BTreeMap<&str, &str> = first
                .trim_start_matches("# ")
                .split(' ')
                .filter_map(|fact| fact.split_once('='))
                .collect();
            let beside =
                || PathBuf::from(path.to_str().unwrap().strip_suffix(".true.csv").unwrap());
            let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
            Truth {
                list: facts
                    .get("list")
                    .map_or_else(beside, |list| root.join(list)),
                storeys: facts
                    .get("storeys")
                    .and_then(|storeys| storeys.parse().ok()),
                rows: reader.deserialize().map(|row| row.unwrap()).collect(),
            }
        })
        .collect()
}

#[test]
fn every_cell_of_every_list_is_read() {
    let (mut total, mut wrong_silently, mut refused, mut others) = (0, 0, 0, 0);
    let mut said = Vec::new();
    let all = truths();
    assert!(all.len() >= 16, "a dozen lists, and those of the examples");
    for Truth {
        list,
        storeys,
        rows,
    } in all
    {
        let reading = read(&list, storeys);
        let name = list.file_name().unwrap().to_string_lossy().into_owned();
        let items = &reading.inventory.items;
        let numbers: Vec<u32> = items.iter().map(|item| item.row).collect();
        let expected: Vec<u32> = rows.iter().map(|row| row["row"].parse().unwrap()).collect();
        assert_eq!(numbers, expected, "{name}: the rows that are objects");
        for (item, truth) in items.iter().zip(&rows) {
            for (column, found) in cells(item) {
                let truth = &truth[column];
                total += 1;
                if is_same(&found, truth) {
                    continue;
                }
                let has_doubt = !item.doubts.is_empty();
                match (found.is_empty(), has_doubt) {
                    (true, _) => refused += 1,
                    (false, false) => wrong_silently += 1,
                    (false, true) => others += 1,
                }
                said.push(format!(
                    "{name} row {}: {column} is \"{found}\", not \"{truth}\"",
                    item.row
                ));
            }
        }
    }
    println!("{total} cells: {wrong_silently} wrong silently, {refused} refused, {others} other");
    assert!(said.is_empty(), "{}", said.join("\n"));
}

#[test]
fn what_is_wrong_in_the_lists_is_said_once() {
    let problems = |name: &str, storeys| -> Vec<String> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/lists")
            .join(name);
        let reading = read(&path, storeys);
        let one = |finding: &freestand_inventory::Finding| {
            format!("{} {}", finding.kind.name(), finding.cells().join(" "))
        };
        let mut all: Vec<String> = reading.inventory.findings.iter().map(one).collect();
        all.sort();
        all
    };
    assert_eq!(problems("francais.csv", Some(5)), Vec::<String>::new());
    assert_eq!(problems("espanol.tsv", Some(3)), Vec::<String>::new());
    assert_eq!(problems("deutsch.csv", Some(4)), ["approximate C5"]);
    assert_eq!(
        problems("english_si.csv", Some(4)),
        [
            "anchored-unclear J9",
            "approximate I9",
            "duplicate-id A11",
            "round B8"
        ]
    );
    assert_eq!(problems("lwh_kn.csv", None), ["out-of-range H4"]);
    assert_eq!(
        problems("mixed.csv", Some(4)),
        [
            "approximate E8",
            "formula H8",
            "unit-assumed J6",
            "unit-wrong G8",
            "unit-wrong H7",
            "unreadable E7",
            "unreadable H5"
        ]
    );
    // Floors of a list, and nothing that says how many storeys there are: one error.
    let all = problems("nihongo.csv", None);
    assert_eq!(
        all.iter()
            .filter(|line| line.starts_with("storeys-missing"))
            .count(),
        1,
        "{all:?}"
    );
}
