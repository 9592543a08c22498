//! The scalar solver over a grid of blocks at each accuracy, in one run: time per block-step, and evaluations of the
//! equation of motion per record.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark may stop and prints its effort")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Base, Effort, RockingOptions, rock};

/// 4000 samples every 5 ms, peak 0.45 g: `validation/rocking/records/bench4000.csv`.
fn record() -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples = text.lines().filter(|line| !line.starts_with('#')).map(|line| line.parse().unwrap()).collect();
    Motion::new(0.005, samples).unwrap()
}

/// 64 × 64 blocks, 0.3–4 m high and 0.1–1 m thick.
fn grid() -> Vec<Block> {
    let at = |from: f64, to: f64, i: usize| from + (to - from) * i as f64 / 63.0;
    (0..64).flat_map(|i| (0..64).map(move |j| Block::uniform(at(0.3, 4.0, i), at(0.1, 1.0, j)).unwrap())).collect()
}

fn solve(blocks: &[Block], base: Base, options: &RockingOptions) -> Effort {
    blocks.iter().fold(Effort::default(), |sum, block| {
        let effort = rock(block, base, options).unwrap().effort;
        Effort { steps: sum.steps + effort.steps, evaluations: sum.evaluations + effort.evaluations }
    })
}

fn scalar_solver(criterion: &mut Criterion) {
    let (record, blocks) = (record(), grid());
    let base = Base { horizontal: Some(&record), vertical: None };
    let block_steps = (blocks.len() * (record.accel_m_s2().len() - 1)) as u64;
    let mut group =
        criterion.benchmark_group("scalar solver, 64 x 64 blocks x 3999 steps (elements: nominal block-steps)");
    group.throughput(Throughput::Elements(block_steps)).sample_size(10);
    for accuracy in [Accuracy::Fast, Accuracy::Standard, Accuracy::Tight] {
        let options = RockingOptions { accuracy, ..RockingOptions::default() };
        let effort = solve(&blocks, base, &options);
        println!(
            "{accuracy:?}: {:.0} Taylor steps and {:.0} evaluations a record, {:.2} of the block-steps moving",
            effort.steps as f64 / blocks.len() as f64,
            effort.evaluations as f64 / blocks.len() as f64,
            effort.steps as f64 / block_steps as f64
        );
        group.bench_function(format!("{accuracy:?}"), |bencher| bencher.iter(|| solve(&blocks, base, &options)));
    }
    group.finish();
}

criterion_group!(benches, scalar_solver);
criterion_main!(benches);
