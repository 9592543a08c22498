//! Damaged inventories: the seeds of the fuzz targets, altered in ways in which files do get damaged.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

#[path = "../../../../fuzz/src/damage.rs"]
#[allow(
    unreachable_pub,
    dead_code,
    reason = "other crates use it, and more of it"
)]
mod damage;
#[path = "../../../../fuzz/src/inventory.rs"]
#[allow(unreachable_pub, reason = "the fuzz targets use it from another crate")]
mod inventory;

use damage::{Chance, mutations};
use std::path::Path;

/// Every fifth mutation: some of each kind.
#[test]
#[ignore = "a quarter of a minute: thousands of damaged files"]
fn damaged_inventories_are_refused_or_read_but_never_break() {
    damage_all(5);
}

#[test]
#[ignore = "half a minute: thousands of damaged inventories"]
fn many_damaged_inventories_are_refused_or_read_but_never_break() {
    damage_all(1);
}

/// Inventories, damaged as records are, and converted where they are still read.
fn damage_all(step: usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    for (family, as_file) in [
        ("inventory_csv", None),
        ("inventory_xlsx", Some(inventory::workbook)),
    ] {
        let mut total = 0;
        for path in std::fs::read_dir(folder.join(family))
            .unwrap()
            .map(|entry| entry.unwrap().path())
        {
            let mutations = mutations(&std::fs::read(&path).unwrap(), &mut Chance(1));
            for mutation in mutations.into_iter().step_by(step) {
                inventory::check_inventory(
                    as_file.map_or_else(|| mutation.clone(), |file| file(&mutation)),
                );
                total += 1;
            }
        }
        println!("{family}: {total} mutations");
        assert!(total > 500 / step);
    }
}
