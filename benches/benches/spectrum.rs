//! A response spectrum of 200 periods of a record of 8000 samples, on one thread; `compare.py` compares it with others.

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::measures::{measures, spectral_measures};
use freestand::motion::Motion;
use freestand::oscillator::response_spectrum;
use freestand::signal::resample::upsampled_sinc;

/// Two cycles of `bench4000`, which has 4000 samples.
fn record() -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples: Vec<f64> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|l| l.parse().unwrap())
        .collect();
    Motion::new(0.005, samples.repeat(2)).unwrap()
}

fn spectra(criterion: &mut Criterion) {
    let record = record();
    let periods_s: Vec<f64> = (0..200)
        .map(|i| 0.05 * 100f64.powf(f64::from(i) / 199.0))
        .collect();
    let mut group = criterion.benchmark_group("8000 samples");
    group.bench_function("spectrum of 200 periods", |bencher| {
        bencher.iter(|| response_spectrum(&record, 0.05, &periods_s).unwrap());
    });
    group.bench_function("upsampled 10 times", |bencher| {
        bencher.iter(|| upsampled_sinc(&record, 10).unwrap())
    });
    group.bench_function("measures", |bencher| bencher.iter(|| measures(&record)));
    group.bench_function("spectral measures", |bencher| {
        bencher.iter(|| spectral_measures(&record))
    });
    group.finish();
}

criterion_group!(benches, spectra);
criterion_main!(benches);
