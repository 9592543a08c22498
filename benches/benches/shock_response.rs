//! Shock response spectrum of a record of 1 s at 100 kHz, 160 frequencies from 1 Hz to 10 kHz, on one thread.
//!
//! `cargo bench -p freestand-benches --bench shock_response`

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::motion::Motion;
use freestand::shock_response::{ShockSpectrumOptions, shock_spectrum};
use std::hint::black_box;

/// A shock that rings: three tones that are struck and die away.
fn record() -> Motion {
    let tone =
        |t: f64, f: f64, decay: f64| (-t / decay).exp() * (std::f64::consts::TAU * f * t).sin();
    let shock = |t: f64| {
        900.0 * tone(t, 120.0, 0.02)
            + 1500.0 * tone(t, 1300.0, 0.005)
            + 700.0 * tone(t, 4200.0, 0.002)
    };
    let samples = (0..100_000).map(|k| shock((1e-5 * f64::from(k) - 0.01).max(0.0)));
    Motion::new(1e-5, samples.collect()).unwrap()
}

fn shock_response(criterion: &mut Criterion) {
    let record = record();
    let frequencies: Vec<f64> = (0..160).map(|i| (f64::from(i) / 12.0).exp2()).collect();
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let mut group = criterion.benchmark_group("shock_response");
    group.sample_size(20);
    for (name, upsample) in [("upsampled", true), ("as_sampled", false)] {
        let options = ShockSpectrumOptions {
            upsample,
            ..ShockSpectrumOptions::default()
        };
        let run = || shock_spectrum(black_box(&record), &frequencies, options);
        group.bench_function(name, |bencher| bencher.iter(|| one.install(run)));
    }
    group.finish();
}

criterion_group!(benches, shock_response);
criterion_main!(benches);
