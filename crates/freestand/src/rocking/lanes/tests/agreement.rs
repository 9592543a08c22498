//! The kernel follows the scalar solver through trouble.

#![expect(clippy::print_stdout, reason = "a test says how far it went")]

use super::super::rock_many;
use super::trouble::{Random, Trouble};
use crate::motion::Motion;
use crate::rocking::{Accuracy, Base, Rocking, RockingError, RockingOptions, RockingSummary, rock};

/// A relative change of the motion, by which it is measured how much a block amplifies errors.
const CHANGE: f64 = 1e-9;

/// Amplification beyond which nothing is left to compare: the motion is then chaotic or at the edge of overturning.
const SENSITIVE: f64 = 1e4;

/// What a test found.
#[derive(Debug, Default)]
struct Tally {
    blocks: usize,
    errors: usize,
    sensitive: usize,
    counts: usize,
    worst: f64,
    failures: Vec<String>,
}

/// Every number of a history that its summary keeps.
fn numbers(summary: &RockingSummary) -> [f64; 5] {
    let [right, left] = summary.sides;
    [
        summary.peak_rotation_rad,
        right.peak_rotation_rad,
        left.peak_rotation_rad,
        right.impact_omega_rad_s,
        left.impact_omega_rad_s,
    ]
}

/// The scalar solver's history, and those of two motions that differ by [`CHANGE`]: all of it larger, and each sample by
/// itself larger or smaller.
fn histories(trouble: &Trouble) -> Vec<[Result<Rocking, RockingError>; 3]> {
    let options = RockingOptions { accuracy: Accuracy::Tight, ..trouble.options };
    let mut random = Random::new(1);
    let mut each = |motion: &Motion| {
        let change = |a: &f64| a * (1.0 + if random.chance(0.5) { CHANGE } else { -CHANGE });
        Motion::new(motion.dt_s(), motion.accel_m_s2().iter().map(change).collect()).unwrap()
    };
    let larger = trouble.horizontal.scaled(1.0 + CHANGE).unwrap();
    let (other, other_vertical) = (each(&trouble.horizontal), trouble.vertical.as_ref().map(&mut each));
    let bases = [
        trouble.base(),
        Base { horizontal: Some(&larger), ..trouble.base() },
        Base { horizontal: Some(&other), vertical: other_vertical.as_ref() },
    ];
    trouble.blocks.iter().map(|block| bases.map(|base| rock(block, base, &options))).collect()
}

/// Holds the kernel to the scalar solver: `tolerance` is of each number where its amplification is 1 or less.
fn compare(seed: u64, trouble: &Trouble, accuracy: Accuracy, tolerance: f64, tally: &mut Tally) {
    let options = RockingOptions { accuracy, ..trouble.options };
    let kernel = rock_many(&trouble.blocks, trouble.base(), &options);
    for (i, (histories, got)) in histories(trouble).iter().zip(&kernel).enumerate() {
        tally.blocks += 1;
        let mut fail = |what: String| {
            let (kind, block) = (trouble.kind, &trouble.blocks[i]);
            {let s = super::super::Shaking::new(trouble.base(), 9.80665, true).unwrap();
            println!("DBG {accuracy:?} seed {seed} block {i} {kind} dt {:.4} pdt {:.3} largest {:.2} plan {:?} :: {}", s.dt_s, block.pivot().frequency_parameter_rad_s(9.80665)*s.dt_s, s.largest, super::super::plan(block, &s, &options).map(|p| p.0), what);}
            tally.failures.push(format!("seed {seed}, block {i} ({kind}, {accuracy:?}): {what}; {block:?} {options:?}"));
        };
        let (expected, changed) = match histories {
            [Ok(expected), Ok(larger), Ok(other)] => (expected, [larger, other].map(RockingSummary::from)),
            [Err(expected), ..] => {
                tally.errors += 1;
                // The kernel has no errors of its own: they are the scalar solver's at the accuracy that was asked for.
                if *got != rock(&trouble.blocks[i], trouble.base(), &options).map(|r| RockingSummary::from(&r)) {
                    fail(format!("{got:?} instead of {expected:?}"));
                }
                continue;
            }
            _ => continue,
        };
        let Ok(got) = got else {
            fail(format!("{got:?} instead of {:?}", expected.outcome));
            continue;
        };
        let (rests, expected) = (expected.uplift_count, RockingSummary::from(expected));
        let fate = |summary: &RockingSummary| (summary.outcome, summary.stop);
        let spread = |n: usize| {
            changed.iter().map(|c| (numbers(c)[n] - numbers(&expected)[n]).abs()).fold(0.0, f64::max) / CHANGE
        };
        let same_fate = changed.iter().all(|changed| fate(changed) == fate(&expected));
        if !same_fate || (0..5).any(|n| spread(n) > SENSITIVE * numbers(&expected)[n]) {
            tally.sensitive += 1;
            continue;
        }
        if fate(got) != fate(&expected) {
            fail(format!("{:?} instead of {:?}", fate(got), fate(&expected)));
            continue;
        }
        for n in 0..5 {
            let (expected, got) = (numbers(&expected)[n], numbers(got)[n]);
            let error = (got - expected).abs() / spread(n).max(expected).max(f64::MIN_POSITIVE);
            tally.worst = tally.worst.max(error);
            if error > tolerance {
                fail(format!("number {n}: {got} instead of {expected}, {error:.1e} of its amplification"));
            }
        }
        let apart = got.impact_count.abs_diff(expected.impact_count);
        if apart > 0 {
            tally.counts += 1;
            println!("COUNT seed {seed} block {i} {} {} rests {rests} kind {} {:?} pert {:?} {:?}", got.impact_count, expected.impact_count, trouble.kind, trouble.options.until, changed.map(|c| c.impact_count), trouble.options.restitution);
        }
    }
}

fn tally(seeds: std::ops::Range<u64>, accuracy: Accuracy, tolerance: f64) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        compare(seed, &Trouble::new(seed, 20), accuracy, tolerance, &mut tally);
    }
    println!("{accuracy:?}: {} blocks, {} refused, {} sensitive, {} counts apart, worst {:.1e}", tally.blocks, tally.errors, tally.sensitive, tally.counts, tally.worst);
    tally
}

#[test]
fn standard_accuracy_follows_the_scalar_solver() {
    let tally = tally(0..200, Accuracy::Standard, 1e-8);
    assert!(tally.failures.is_empty(), "{}\n{}", tally.failures.len(), tally.failures.join("\n"));
}

#[test]
fn tight_accuracy_follows_the_scalar_solver() {
    let tally = tally(200..300, Accuracy::Tight, 1e-10);
    assert!(tally.failures.is_empty(), "{}\n{}", tally.failures.len(), tally.failures.join("\n"));
}

#[test]
fn fast_accuracy_follows_the_scalar_solver() {
    let tally = tally(300..400, Accuracy::Fast, 1e-4);
    assert!(tally.failures.is_empty(), "{}\n{}", tally.failures.len(), tally.failures.join("\n"));
}
