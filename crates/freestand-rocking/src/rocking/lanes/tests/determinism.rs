//! The same bits, whatever the machine and the company.

use super::super::{TILE, rock_many, rock_many_on};
use super::trouble::{Random, Trouble};
use crate::block::Block;
use crate::rocking::{Accuracy, RockingError, RockingOptions, RockingSummary, Until};

type Answers = Vec<Result<RockingSummary, RockingError>>;

/// Numbers as bits: −0 is not 0 here, and a NaN is itself.
fn bits(answers: &Answers) -> Vec<Result<(String, [u64; 9]), String>> {
    let one = |answer: &RockingSummary| {
        let [right, left] = answer.sides;
        let numbers = [
            answer.peak_rotation_rad,
            right.peak_rotation_rad,
            left.peak_rotation_rad,
            right.impact_omega_rad_s,
            left.impact_omega_rad_s,
            right.wall_omega_rad_s,
            left.wall_omega_rad_s,
            answer.uplift_m,
            answer.cg_rise_m,
        ];
        let counts = (answer.impact_count, answer.wall_impact_count);
        (
            format!("{:?} {:?} {counts:?}", answer.outcome, answer.stop),
            numbers.map(f64::to_bits),
        )
    };
    answers
        .iter()
        .map(|answer| {
            answer
                .as_ref()
                .map(one)
                .map_err(|error| format!("{error:?}"))
        })
        .collect()
}

/// Free-standing blocks, and blocks between walls.
fn both(seed: u64, count: usize) -> [Trouble; 2] {
    [
        Trouble::new(seed, count),
        Trouble::between_walls(seed, count),
    ]
}

fn solve(trouble: &Trouble, blocks: &[Block]) -> Answers {
    rock_many(blocks, trouble.base(), &trouble.options)
}

#[test]
fn threads_change_nothing() {
    for trouble in (500..503).flat_map(|seed| both(seed, 100)) {
        let by = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            bits(&pool.install(|| solve(&trouble, &trouble.blocks)))
        };
        let one = by(1);
        for threads in [2, 3] {
            assert_eq!(one, by(threads), "{}, {threads} threads", trouble.kind);
        }
    }
}

#[test]
fn company_and_order_change_nothing() {
    for (seed, trouble) in (510..513).flat_map(|seed| both(seed, 60).map(|trouble| (seed, trouble)))
    {
        let all = bits(&solve(&trouble, &trouble.blocks));
        // Fisher and Yates.
        let mut random = Random::new(seed);
        let mut order: Vec<usize> = (0..trouble.blocks.len()).collect();
        for i in (1..order.len()).rev() {
            order.swap(i, random.pick(i + 1));
        }
        let shuffled: Vec<Block> = order.iter().map(|&i| trouble.blocks[i]).collect();
        for (&i, shuffled) in order.iter().zip(bits(&solve(&trouble, &shuffled))) {
            assert_eq!(all[i], shuffled, "seed {seed}, block {i} in another order");
        }
        for i in (0..all.len()).step_by(7) {
            assert_eq!(
                all[i..=i],
                bits(&solve(&trouble, &trouble.blocks[i..=i])),
                "seed {seed}, block {i} alone"
            );
        }
        // Every number of lanes that are left over beside full vectors.
        for count in 1..18 {
            assert_eq!(
                all[..count],
                bits(&solve(&trouble, &trouble.blocks[..count])),
                "seed {seed}, {count} blocks"
            );
        }
    }
}

/// The last block of a tile, and the first ones of the next.
#[test]
fn tile_boundaries_change_nothing() {
    let trouble = (530..)
        .map(|seed| Trouble::new(seed, 64))
        .find(|trouble| trouble.kind == "noise")
        .unwrap();
    let count = TILE + 9;
    let many: Vec<Block> = (0..count)
        .map(|i| trouble.blocks[i % trouble.blocks.len()])
        .collect();
    let few = bits(&solve(&trouble, &trouble.blocks));
    for (i, got) in bits(&solve(&trouble, &many)).into_iter().enumerate() {
        assert_eq!(got, few[i % few.len()], "block {i}");
    }
}

#[test]
fn every_vector_unit_gives_the_same_bits() {
    have_the_same_bits(540..542, 10);
}

#[test]
#[ignore = "a minute: one lane at a time"]
fn every_vector_unit_gives_the_same_bits_to_many_blocks() {
    have_the_same_bits(540..545, 20);
}

fn have_the_same_bits(seeds: std::ops::Range<u64>, blocks: usize) {
    let units = vector_units();
    for (seed, trouble) in seeds.flat_map(|seed| both(seed, blocks).map(|trouble| (seed, trouble)))
    {
        for accuracy in [Accuracy::Fast, Accuracy::Standard, Accuracy::Tight] {
            // One lane at a time without fused arithmetic in the processor is slow: a short wait
            // for rest.
            let until = match trouble.options.until {
                Until::Settled { .. } => Until::Settled { at_most_s: 1.0 },
                until => until,
            };
            let options = RockingOptions {
                accuracy,
                until,
                ..trouble.options
            };
            let by = |arch| {
                bits(&rock_many_on(
                    arch,
                    &trouble.blocks,
                    trouble.base(),
                    &options,
                ))
            };
            let plain = by(pulp::Arch::Scalar);
            assert_eq!(
                plain,
                bits(&rock_many(&trouble.blocks, trouble.base(), &options)),
                "seed {seed}, the default"
            );
            for (name, arch) in &units {
                assert_eq!(
                    plain,
                    by(*arch),
                    "seed {seed}, {accuracy:?}: {name} against one lane at a time"
                );
            }
        }
    }
}

/// The vector units of this processor by name; prints those that it lacks.
#[cfg(target_arch = "x86_64")]
fn vector_units() -> Vec<(&'static str, pulp::Arch)> {
    let units = [
        ("x86-64-v3", pulp::x86::V3::try_new().map(pulp::Arch::V3)),
        ("x86-64-v4", pulp::x86::V4::try_new().map(pulp::Arch::V4)),
    ];
    for (name, _) in units.iter().filter(|(_, arch)| arch.is_none()) {
        println!("skipped: this processor has no {name}");
    }
    units
        .into_iter()
        .filter_map(|(name, arch)| Some((name, arch?)))
        .collect()
}

/// Elsewhere there is one vector unit, and it is the default.
#[cfg(not(target_arch = "x86_64"))]
fn vector_units() -> Vec<(&'static str, pulp::Arch)> {
    println!("skipped: the vector units of x86-64");
    Vec::new()
}
