//! Ten matched motions, one record matched by each method, ten simulations; on one thread.
//!
//! `cargo bench -p freestand-benches --bench synthesis`

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::code_spectrum::{As1170_4, Edition, SiteClass};
use freestand::synthesis::{
    Preset, SimulationOptions, Simulator, SynthesisOptions, match_by_wavelets, match_motion,
    synthesize,
};
use std::hint::black_box;

fn synthesis(criterion: &mut Criterion) {
    let code = |site| As1170_4::new(Edition::default(), site, 0.08, 500).unwrap();
    let (soil, rock) = (code(SiteClass::De), code(SiteClass::Be));
    let options = SynthesisOptions::default();
    // 45 s at 200 Hz, matched to rock: a record for the matching to soil.
    let record = synthesize(|t| rock.sa_g(t), 1, 0, &options).unwrap().motion;
    let simulations = || {
        let source = Preset::Victoria.source(black_box(6.0), 30e3);
        let simulator = Simulator::new(&source, |_| 1.0, &SimulationOptions::default()).unwrap();
        (0..10)
            .map(|index| simulator.motion(1, index).unwrap().peak_m_s2())
            .fold(0.0, f64::max)
    };
    let mut group = criterion.benchmark_group("synthesis");
    group.sample_size(10);
    group.bench_function("ten_matched_motions", |bencher| {
        bencher.iter(|| {
            (0..10)
                .map(|i| synthesize(|t| soil.sa_g(t), 1, i, &options).unwrap().pass)
                .sum::<usize>()
        });
    });
    group.bench_function("one_record_by_wavelets", |bencher| {
        bencher.iter(|| match_by_wavelets(black_box(&record), |t| soil.sa_g(t), 30).unwrap());
    });
    group.bench_function("one_record_by_fft", |bencher| {
        bencher.iter(|| match_motion(black_box(&record), |t| soil.sa_g(t), 30).unwrap());
    });
    group.bench_function("ten_simulations", |bencher| bencher.iter(simulations));
    group.finish();
}

criterion_group!(benches, synthesis);
criterion_main!(benches);
