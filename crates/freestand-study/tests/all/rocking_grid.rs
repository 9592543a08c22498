//! The kernel for many blocks against the scalar solver over a grid of blocks under one record.

#![expect(clippy::unwrap_used, reason = "a test may stop at broken data")]

use std::fs;
use std::path::Path;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{
    Accuracy, Base, Outcome, RockingOptions, RockingSummary, rock, rock_many,
};

/// 4000 samples every 5 ms, peak 0.45 g.
fn record() -> Motion {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../validation/rocking/records/bench4000.csv");
    let text = fs::read_to_string(path).unwrap();
    let samples = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.parse().unwrap())
        .collect();
    Motion::new(0.005, samples).unwrap()
}

/// 64 × 64 blocks, 0.3–4 m high and 0.1–1 m thick: the grid of `benches/`.
fn grid() -> Vec<Block> {
    let at = |from: f64, to: f64, i: usize| from + (to - from) * i as f64 / 63.0;
    (0..64)
        .flat_map(|i| {
            (0..64).map(move |j| Block::uniform(at(0.3, 4.0, i), at(0.1, 1.0, j)).unwrap())
        })
        .collect()
}

fn with(accuracy: Accuracy) -> RockingOptions {
    RockingOptions {
        accuracy,
        ..RockingOptions::default()
    }
}

/// The scalar solver to rounding, and whether a block is not sensitive: 1e-6 more motion changes it by less than 1e-5
/// (as in `validation/rocking`).
fn exact(blocks: &[Block], record: &Motion) -> Vec<(RockingSummary, bool)> {
    let more = record.scaled(1.0 + 1e-6).unwrap();
    let under = |block: &Block, motion: &Motion| {
        let base = Base {
            horizontal: Some(motion),
            vertical: None,
        };
        RockingSummary::from(&rock(block, base, &with(Accuracy::Tight)).unwrap())
    };
    let one = |block| {
        let (exact, changed) = (under(block, record), under(block, &more));
        let change = (changed.peak_rotation_rad - exact.peak_rotation_rad).abs();
        (
            exact,
            changed.outcome == exact.outcome && change <= 1e-5 * exact.peak_rotation_rad,
        )
    };
    blocks.iter().map(one).collect()
}

/// Whether it rocked and did not fall, at rest or not where the record ends.
fn has_rocked(one: &RockingSummary) -> bool {
    matches!(one.outcome, Outcome::Rocked | Outcome::Unresolved)
}

/// Relative errors in the peak rotation of the blocks that rocked and are not sensitive, the smallest first.
fn errors(exact: &[(RockingSummary, bool)], got: &[RockingSummary]) -> Vec<f64> {
    let rocked = exact
        .iter()
        .zip(got)
        .filter(|((exact, insensitive), _)| *insensitive && has_rocked(exact));
    let mut errors: Vec<f64> = rocked
        .map(|((exact, _), got)| (got.peak_rotation_rad / exact.peak_rotation_rad - 1.0).abs())
        .collect();
    errors.sort_by(f64::total_cmp);
    errors
}

#[test]
#[ignore = "seconds: a grid of blocks"]
fn a_grid_of_blocks_is_as_accurate_as_was_asked_for() {
    let (record, blocks) = (record(), grid());
    let base = Base {
        horizontal: Some(&record),
        vertical: None,
    };
    let exact = exact(&blocks, &record);
    // What a level promises: half of the blocks, and ninety-nine of a hundred.
    for (accuracy, half, most) in [
        (Accuracy::Fast, 1e-6, 1e-5),
        (Accuracy::Standard, 1e-9, 1e-8),
        (Accuracy::Tight, 1e-13, 1e-12),
    ] {
        let got: Vec<RockingSummary> = rock_many(&blocks, base, &with(accuracy))
            .into_iter()
            .map(|summary| summary.unwrap())
            .collect();
        for (block, ((exact, insensitive), got)) in blocks.iter().zip(exact.iter().zip(&got)) {
            // Not even a sensitive block differs: none of this grid is within an error of falling.
            assert_eq!(exact.outcome, got.outcome, "{accuracy:?} {block:?}");
            let apart = exact.impact_count.abs_diff(got.impact_count);
            // The errors of `fast` can lift a block once more or less.
            assert!(
                !insensitive || apart <= 1 || accuracy == Accuracy::Fast,
                "{accuracy:?}: {apart} impacts apart {block:?}"
            );
        }
        let errors = errors(&exact, &got);
        let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
        let below = |limit: f64| {
            errors.iter().filter(|error| **error <= limit).count() as f64 / errors.len() as f64
        };
        let apart = exact
            .iter()
            .zip(&got)
            .filter(|((e, _), g)| e.impact_count != g.impact_count)
            .count();
        println!(
            "{accuracy:?}: {} blocks rocked, median {:.1e}, 99 % {:.1e}, worst {:.1e}; {:.4} of them within {most:e}; \
             {apart} impact counts apart",
            errors.len(),
            at(0.5),
            at(0.99),
            at(1.0),
            below(most)
        );
        assert!(errors.len() > 1000, "{} blocks rocked", errors.len());
        assert!(at(0.5) <= half && at(0.99) <= most, "{accuracy:?}");
    }
}
