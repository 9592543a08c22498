//! Blocks that slide: block-steps per second of processor time on one thread, under 1024 coefficients
//! of friction, so that blocks stick most of the time or slide most of it.

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use freestand::motion::Motion;
use freestand::rocking::Base;
use freestand::sliding::{Clearance, Friction, SlidingOptions, slide};
use freestand_benches::time_of;

/// 4000 samples every 5 ms, peak 0.45 g: `validation/rocking/records/bench4000.csv`.
fn record() -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.parse().unwrap())
        .collect();
    Motion::new(0.005, samples).unwrap()
}

/// 1024 coefficients between two values, with clearances on both sides.
fn blocks(from: f64, to: f64) -> Vec<SlidingOptions> {
    let ratio = |i: usize| from + (to - from) * i as f64 / 1023.0;
    let clearance = Clearance {
        left_m: Some(0.2),
        right_m: Some(0.3),
    };
    let block = |i| SlidingOptions {
        clearance,
        ..SlidingOptions::new(Friction::uniform(ratio(i)).unwrap())
    };
    (0..1024).map(block).collect()
}

fn sliding(criterion: &mut Criterion) {
    let record = record();
    let vertical = record.scaled(0.6).unwrap();
    let mut group = criterion.benchmark_group("sliding (elements: nominal block-steps)");
    group
        .throughput(Throughput::Elements(
            1024 * (record.accel_m_s2().len() as u64 - 1),
        ))
        .sample_size(10);
    for (name, from, to) in [
        ("friction 0.1 to 0.4", 0.1, 0.4),
        ("casters, 0.005 to 0.05", 0.005, 0.05),
    ] {
        for vertical in [None, Some(&vertical)] {
            let base = Base {
                horizontal: Some(&record),
                vertical,
            };
            let blocks = blocks(from, to);
            let name = format!(
                "{name}, {}",
                if vertical.is_some() {
                    "vertical"
                } else {
                    "horizontal only"
                }
            );
            let run = || {
                let slides = blocks.iter().map(|options| slide(base, options));
                slides.collect::<Vec<_>>()
            };
            group.bench_function(name, |b| b.iter_custom(|rounds| time_of(rounds, run)));
        }
    }
    group.finish();
}

criterion_group!(benches, sliding);
criterion_main!(benches);
