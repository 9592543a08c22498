//! The kernel for many blocks compared with the scalar solver, over a grid of blocks at each
//! accuracy level, in one run on one thread: time per block-step, and evaluations of the equation
//! of motion.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark may stop and prints its effort"
)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Base, Effort, RockingOptions, rock, rock_many, rock_many_on};
use freestand::wall::{Wall, Walls};
use freestand_benches::time_of;
use pulp::Arch;

/// 4000 samples every 5 ms, peak 0.45 g: `validation/rocking/records/bench4000.csv`.
fn record(scale: f64) -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.parse().unwrap())
        .collect();
    Motion::new(0.005, samples).unwrap().scaled(scale).unwrap()
}

/// 64 × 64 blocks between two heights and two thicknesses \[m\].
fn grid(heights: [f64; 2], thicknesses: [f64; 2]) -> Vec<Block> {
    let at = |[from, to]: [f64; 2], i: usize| from + (to - from) * i as f64 / 63.0;
    (0..64)
        .flat_map(|i| {
            (0..64).map(move |j| Block::uniform(at(heights, i), at(thicknesses, j)).unwrap())
        })
        .collect()
}

fn solve(blocks: &[Block], base: Base, options: &RockingOptions) -> Effort {
    blocks.iter().fold(Effort::default(), |sum, block| {
        let effort = rock(block, base, options).unwrap().effort;
        Effort {
            steps: sum.steps + effort.steps,
            evaluations: sum.evaluations + effort.evaluations,
        }
    })
}

fn compare(criterion: &mut Criterion, name: &str, record: &Motion, blocks: &[Block]) {
    let base = Base {
        horizontal: Some(record),
        vertical: None,
    };
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let block_steps = (blocks.len() * (record.accel_m_s2().len() - 1)) as u64;
    let mut group = criterion.benchmark_group(format!("{name} (elements: nominal block-steps)"));
    group
        .throughput(Throughput::Elements(block_steps))
        .sample_size(10);
    for accuracy in [Accuracy::Fast, Accuracy::Standard, Accuracy::Tight] {
        let options = RockingOptions {
            accuracy,
            ..RockingOptions::default()
        };
        let effort = solve(blocks, base, &options);
        println!(
            "{accuracy:?}, scalar: {:.0} Taylor steps and {:.0} evaluations a record, {:.2} of the block-steps",
            effort.steps as f64 / blocks.len() as f64,
            effort.evaluations as f64 / blocks.len() as f64,
            effort.steps as f64 / block_steps as f64
        );
        group.bench_function(format!("{accuracy:?}, scalar"), |b| {
            b.iter(|| solve(blocks, base, &options))
        });
        group.bench_function(format!("{accuracy:?}, kernel"), |b| {
            b.iter(|| one.install(|| rock_many(blocks, base, &options)));
        });
    }
    let two = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .unwrap();
    let options = RockingOptions::default();
    group.bench_function("Standard, kernel on two threads", |b| {
        b.iter(|| two.install(|| rock_many(blocks, base, &options)));
    });
    for (name, arch) in vector_units() {
        group.bench_function(format!("Standard, kernel by {name}"), |b| {
            b.iter(|| one.install(|| rock_many_on(arch, blocks, base, &options)));
        });
    }
    group.finish();
}

/// The vector units of this processor other than the widest one, which is the default.
#[cfg(target_arch = "x86_64")]
fn vector_units() -> Vec<(&'static str, Arch)> {
    let avx2 = pulp::x86::V3::try_new().map(|v3| ("AVX2", Arch::V3(v3)));
    avx2.into_iter()
        .chain([("no vector units", Arch::Scalar)])
        .collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn vector_units() -> Vec<(&'static str, Arch)> {
    vec![("no vector units", Arch::Scalar)]
}

/// Grids whose blocks rest most of the time.
fn resting(criterion: &mut Criterion) {
    compare(
        criterion,
        "0.3-4 m by 0.1-1 m, as recorded",
        &record(1.0),
        &grid([0.3, 4.0], [0.1, 1.0]),
    );
    compare(
        criterion,
        "0.3-4 m by 0.1-1 m, x 0.5",
        &record(0.5),
        &grid([0.3, 4.0], [0.1, 1.0]),
    );
}

/// A grid whose blocks rock nearly all the time; none of them overturns.
fn rocking(criterion: &mut Criterion) {
    compare(
        criterion,
        "4-20 m by 0.4-0.8 m, x 0.5",
        &record(0.5),
        &grid([4.0, 20.0], [0.4, 0.8]),
    );
}

/// What walls cost: they stop blocks from overturning, and blocks that fall back from them land more
/// often. Processor time.
fn between_walls(criterion: &mut Criterion) {
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build()
        .unwrap();
    for (grid_name, record, blocks) in [
        (
            "0.3-4 m by 0.1-1 m, as recorded",
            record(1.0),
            grid([0.3, 4.0], [0.1, 1.0]),
        ),
        (
            "4-20 m by 0.4-0.8 m, x 0.5",
            record(0.5),
            grid([4.0, 20.0], [0.4, 0.8]),
        ),
    ] {
        let base = Base {
            horizontal: Some(&record),
            vertical: None,
        };
        let mut group = criterion.benchmark_group(format!(
            "walls, {grid_name} (elements: nominal block-steps)"
        ));
        let block_steps = (blocks.len() * (record.accel_m_s2().len() - 1)) as u64;
        group
            .throughput(Throughput::Elements(block_steps))
            .sample_size(10);
        let at = |gap_mm: f64| Some(Wall::at(1e-3 * gap_mm));
        let mut cases = vec![("no wall".to_owned(), Walls::NONE)];
        for gap_mm in [50.0, 10.0, 1.0] {
            cases.push((
                format!("{gap_mm} mm behind"),
                Walls {
                    left: at(gap_mm),
                    right: None,
                },
            ));
            cases.push((
                format!("{gap_mm} mm on both sides"),
                Walls {
                    left: at(gap_mm),
                    right: at(gap_mm),
                },
            ));
        }
        for (name, walls) in cases {
            let options = RockingOptions {
                walls,
                ..RockingOptions::default()
            };
            let run = || one.install(|| rock_many(&blocks, base, &options));
            let (floor, wall) = run()
                .iter()
                .flatten()
                .fold((0, 0), |(floor, wall), summary| {
                    (
                        floor + summary.impact_count,
                        wall + summary.wall_impact_count,
                    )
                });
            println!("{name}: {floor} impacts on the floor, {wall} on walls");
            group.bench_function(name, |b| b.iter_custom(|rounds| time_of(rounds, run)));
        }
        group.finish();
    }
}

criterion_group!(benches, resting, rocking, between_walls);
criterion_main!(benches);
