//! The cabinet on its pads under a motion of 40 s, compared with the same block on a rigid base; and
//! many worlds of it and of two racks by the kernel, compared with one by the scalar solver: in one
//! run on one thread.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark may stop and prints its effort"
)]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::{
    CompliantAccuracy, CompliantBase, CompliantOptions, CompliantWorld, pad_uplift_threshold_m_s2,
    rock_compliant, rock_compliant_many_on,
};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::motion::Motion;
use freestand::rocking::{Base, RockingOptions, rock};

/// 4000 samples every 5 ms, peak 0.45 g, twice in succession: 40 s.
fn record() -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples = || {
        text.lines()
            .filter(|line| !line.starts_with('#'))
            .map(|line| line.parse().unwrap())
    };
    Motion::new(0.005, samples().chain(samples()).chain([0.0]).collect()).unwrap()
}

fn histories(criterion: &mut Criterion) {
    let (block, record) = (Block::uniform(2.3, 0.6).unwrap(), record());
    let base = Base {
        horizontal: Some(&record),
        vertical: None,
    };
    let mut group = criterion.benchmark_group("2.3 m by 0.6 m, 40 s");
    group.sample_size(10);
    let rigid = RockingOptions::default();
    group.bench_function("rigid base", |b| {
        b.iter(|| rock(&block, base, &rigid).unwrap())
    });
    let spring = ContactLaw::Linear {
        stiffness_n_m: 4.38e6,
    };
    let pad = ContactLaw::KelvinVoigt {
        stiffness_n_m: 4.38e6,
        damping_n_s_m: 2400.0,
    };
    for (name, law) in [("springs", spring), ("pads, 5 % damped", pad)] {
        for accuracy in [CompliantAccuracy::Fast, CompliantAccuracy::Standard] {
            let cushions = CompliantBase::new(140.0, Cushion::new(law.clone()).unwrap());
            let options = CompliantOptions {
                accuracy,
                ..CompliantOptions::default()
            };
            let run = || rock_compliant(&block, &cushions, base, &options).unwrap();
            let done = run();
            println!(
                "{name}, {accuracy:?}: {} steps, {} evaluations, {} touches, energy open by {:.1e}",
                done.effort.steps,
                done.effort.evaluations,
                done.touches.len(),
                done.energy.residual_ratio
            );
            group.bench_function(format!("{name}, {accuracy:?}"), |b| b.iter(run));
        }
    }
    group.finish();
}

/// Worlds of one object, as many as a thread takes at once.
const WORLDS: usize = 128;

/// 45 s of the record, from another place in each world, with peaks of 1 to 2 times what lifts the object.
fn motions(up_m_s2: f64) -> Vec<Motion> {
    let record = record();
    let accel = record.accel_m_s2();
    let motion = |i: usize| {
        let samples = accel
            .iter()
            .cycle()
            .skip(61 * i)
            .take(9001)
            .copied()
            .collect();
        let peak_m_s2 = up_m_s2 * 2.0_f64.powf(i as f64 / (WORLDS - 1) as f64);
        Motion::new(0.005, samples)
            .unwrap()
            .scaled(peak_m_s2 / record.peak_m_s2())
            .unwrap()
    };
    (0..WORLDS).map(motion).collect()
}

fn worlds(criterion: &mut Criterion) {
    let alone = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    for (height_m, width_m, mass_kg, stiffness_n_m) in [
        (2.0, 0.9, 400.0, 1.5e6),
        (2.0, 0.6, 300.0, 4e6),
        (2.3, 0.6, 140.0, 4.38e6),
    ] {
        let block = Block::uniform(height_m, width_m).unwrap();
        let motions = motions(pad_uplift_threshold_m_s2(
            &block,
            mass_kg,
            stiffness_n_m,
            G0_M_S2,
        ));
        let still: Vec<Motion> = motions
            .iter()
            .map(|motion| motion.scaled(0.2).unwrap())
            .collect();
        let damping_n_s_m = 0.2 * (stiffness_n_m * mass_kg).sqrt();
        let world = |motion| CompliantWorld {
            block,
            mass_kg,
            stiffness_n_m,
            damping_n_s_m,
            motion: Base {
                horizontal: Some(motion),
                vertical: None,
            },
        };
        let mut group =
            criterion.benchmark_group(format!("{height_m} m by {width_m} m, {mass_kg} kg, 45 s"));
        group.sample_size(10);
        for (what, motions) in [("lifting", &motions), ("not lifting", &still)] {
            let worlds: Vec<CompliantWorld> = motions.iter().map(world).collect();
            group.throughput(criterion::Throughput::Elements(WORLDS as u64));
            for (name, arch) in units() {
                let run = || alone.install(|| rock_compliant_many_on(arch, &worlds, G0_M_S2));
                group.bench_function(format!("{WORLDS} worlds {what}, {name}"), |b| b.iter(run));
            }
            let pads = ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            };
            let base = CompliantBase::new(mass_kg, Cushion::new(pads).unwrap());
            let options = CompliantOptions::default();
            let middle = worlds[WORLDS / 2].motion;
            group.throughput(criterion::Throughput::Elements(1));
            group.bench_function(format!("one world {what}, scalar solver"), |b| {
                b.iter(|| rock_compliant(&block, &base, middle, &options).unwrap());
            });
        }
        group.finish();
    }
}

/// The vector units of this processor.
#[cfg(target_arch = "x86_64")]
fn units() -> Vec<(&'static str, pulp::Arch)> {
    let units = [
        ("x86-64-v3", pulp::x86::V3::try_new().map(pulp::Arch::V3)),
        ("x86-64-v4", pulp::x86::V4::try_new().map(pulp::Arch::V4)),
    ];
    units
        .into_iter()
        .filter_map(|(name, arch)| Some((name, arch?)))
        .collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn units() -> Vec<(&'static str, pulp::Arch)> {
    vec![("default", pulp::Arch::new())]
}

criterion_group!(benches, histories, worlds);
criterion_main!(benches);
