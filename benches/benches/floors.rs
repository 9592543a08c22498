//! Floor motions of 30 floors by 10 modes under 40 s at 200 Hz, on one thread: the matrix product of modes and floors in
//! blocks of time, and the formula floor by floor.
//!
//! `cargo bench -p freestand-benches --bench floors`

#![expect(clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::building::{Building, Damping, Storey, floor_motions, floor_peaks};
use freestand::motion::Motion;
use freestand::oscillator::absolute_acceleration_history_m_s2;
use std::hint::black_box;

const FLOORS: u32 = 30;
const MODES: usize = 10;

fn record() -> Motion {
    let wave = |k: u32| (0.11 * f64::from(k)).sin() + 0.6 * (0.37 * f64::from(k)).cos();
    Motion::new(0.005, (0..8000).map(wave).collect()).unwrap()
}

/// Calculates each floor alone, with its own oscillators and its own sum.
fn floor_by_floor(ground: &Motion, building: &Building, levels_ratio: &[f64]) -> Vec<Vec<f64>> {
    let floor = |&level: &f64| {
        let residual = 1.0
            - building
                .modes()
                .iter()
                .map(|mode| mode.share_ratio(level))
                .sum::<f64>();
        let mut floor: Vec<f64> = ground.accel_m_s2().iter().map(|a| residual * a).collect();
        for mode in building.modes() {
            let share = mode.share_ratio(level);
            let history =
                absolute_acceleration_history_m_s2(ground, mode.period_s(), mode.damping_ratio())
                    .unwrap();
            floor
                .iter_mut()
                .zip(history)
                .for_each(|(sample, absolute)| *sample += share * absolute);
        }
        floor
    };
    levels_ratio.iter().map(floor).collect()
}

fn floors(criterion: &mut Criterion) {
    let ground = record();
    let building = Building::beam(1.92, 0.05, 5.0, MODES).unwrap();
    let levels_ratio: Vec<f64> = (1..=FLOORS)
        .map(|k| f64::from(k) / f64::from(FLOORS))
        .collect();
    let together = floor_motions(&ground, &building, &levels_ratio).unwrap();
    let apart = floor_by_floor(&ground, &building, &levels_ratio);
    assert!(
        together
            .iter()
            .zip(&apart)
            .all(|(one, other)| one.accel_m_s2() == other),
        "one result, to the bit"
    );

    let mut group = criterion.benchmark_group("floors");
    group.bench_function("together", |bencher| {
        bencher.iter(|| floor_motions(black_box(&ground), &building, &levels_ratio).unwrap());
    });
    group.bench_function("floor_by_floor", |bencher| {
        bencher.iter(|| floor_by_floor(black_box(&ground), &building, &levels_ratio));
    });
    group.bench_function("peaks", |bencher| {
        bencher.iter(|| floor_peaks(black_box(&ground), &building, &levels_ratio).unwrap());
    });
    for storeys in [30, 200] {
        let storey = Storey {
            mass_kg: 4e5,
            stiffness_n_m: 9e8,
            height_m: 3.2,
        };
        let storeys = vec![storey; storeys];
        group.bench_function(format!("modes_of_{}_storeys", storeys.len()), |bencher| {
            bencher.iter(|| {
                Building::shear(black_box(&storeys), &Damping::Uniform(0.05), MODES).unwrap()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, floors);
criterion_main!(benches);
