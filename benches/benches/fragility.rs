//! Incremental analyses with their fits: one object, and, without intervals, 20 objects instead of
//! 1,000, because criterion repeats every benchmark ten times.

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::block::Block;
use freestand::fragility::FitKind;
use freestand::motion::Motion;
use freestand::rocking::Restitution;
use freestand_risk::fragility::{
    DEFAULT_MAX_SCALE, FitMethod, FloorMotion, GivenObject, Limits, Measure, Method, RunObjects,
    RunsRequest, fragility_of_runs,
};
use freestand_study::run::no_progress;

/// 44 motions of 20 s, every 5 ms: 12 sines each, under an envelope that peaks at 5 s.
fn motions() -> Vec<FloorMotion> {
    let motion = |i: usize| {
        let sine = |t: f64, j: usize| {
            let turn = (i * 12 + j) as f64 * 0.618_033_988_749_895;
            let frequency_hz = 0.3 * 1.25_f64.powf(j as f64 + turn.fract());
            (std::f64::consts::TAU * (frequency_hz * t + turn)).sin()
        };
        let accel = (0..4000).map(|k| {
            let t = k as f64 * 0.005;
            let envelope = (t / 5.0).powi(2) * (2.0 - 0.4 * t).exp();
            0.5 * envelope * (0..12).map(|j| sine(t, j)).sum::<f64>()
        });
        let horizontal = Motion::new(0.005, accel.collect()).unwrap();
        FloorMotion {
            name: format!("m{i:02}"),
            horizontal,
            vertical: None,
        }
    };
    (0..44).map(motion).collect()
}

fn request(
    height_m: f64,
    thickness_m: f64,
    replicates: u32,
    motions: &[FloorMotion],
) -> RunsRequest {
    let object = GivenObject {
        block: Block::uniform(height_m, thickness_m).unwrap(),
        restitution: Restitution::Housner,
        body: None,
        limits: Limits::default(),
        motions: motions.to_vec(),
        is_on_ground: false,
    };
    RunsRequest {
        objects: RunObjects::Given(Box::new(object)),
        measures: vec![Measure::Pfv],
        at: None,
        method: Method::Incremental,
        scales: None,
        max_scale_ratio: DEFAULT_MAX_SCALE,
        rotation_ratio: None,
        hazard: None,
        site_deg: None,
        site_is_exported: false,
        fit: FitMethod::Curves(FitKind::Ordered),
        replicates: Some(replicates),
        seed: 1,
        inputs: Vec::new(),
        keep: None,
    }
}

fn incremental(criterion: &mut Criterion) {
    let motions = motions();
    let mut group = criterion.benchmark_group("incremental analysis, 44 motions x 4000 samples");
    group.sample_size(10);
    for replicates in [0, 1000] {
        let one = request(1.8, 0.4, replicates, &motions);
        group.bench_function(format!("1 object, {replicates} samples"), |bencher| {
            bencher.iter(|| fragility_of_runs(&one, &no_progress).unwrap());
        });
    }
    group.bench_function("20 of 1000 objects, 0 samples", |bencher| {
        bencher.iter(|| {
            for i in (0..1000).step_by(50) {
                let height_m = 0.8 + 0.0016 * f64::from(i);
                let thickness_m =
                    height_m * (0.15 + 0.25 * (f64::from(i) * 0.618_033_988_749_895).fract());
                fragility_of_runs(&request(height_m, thickness_m, 0, &motions), &no_progress)
                    .unwrap();
            }
        });
    });
    group.finish();
}

criterion_group!(benches, incremental);
criterion_main!(benches);
