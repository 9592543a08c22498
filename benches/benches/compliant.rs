//! The cabinet on its pads under a motion of 40 s, compared with the same block on a rigid base, in
//! one run on one thread.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark may stop and prints its effort")]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::block::Block;
use freestand::compliant::{CompliantAccuracy, CompliantBase, CompliantOptions, rock_compliant};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::motion::Motion;
use freestand::rocking::{Base, RockingOptions, rock};

/// 4000 samples every 5 ms, peak 0.45 g, twice in succession: 40 s.
fn record() -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples = || text.lines().filter(|line| !line.starts_with('#')).map(|line| line.parse().unwrap());
    Motion::new(0.005, samples().chain(samples()).chain([0.0]).collect()).unwrap()
}

fn histories(criterion: &mut Criterion) {
    let (block, record) = (Block::uniform(2.3, 0.6).unwrap(), record());
    let base = Base { horizontal: Some(&record), vertical: None };
    let mut group = criterion.benchmark_group("2.3 m by 0.6 m, 40 s");
    group.sample_size(10);
    let rigid = RockingOptions::default();
    group.bench_function("rigid base", |b| b.iter(|| rock(&block, base, &rigid).unwrap()));
    let spring = ContactLaw::Linear { stiffness_n_m: 4.38e6 };
    let pad = ContactLaw::KelvinVoigt { stiffness_n_m: 4.38e6, damping_n_s_m: 2400.0 };
    for (name, law) in [("springs", spring), ("pads, 5 % damped", pad)] {
        for accuracy in [CompliantAccuracy::Fast, CompliantAccuracy::Standard] {
            let cushions = CompliantBase::new(140.0, Cushion::new(law.clone()).unwrap());
            let options = CompliantOptions { accuracy, ..CompliantOptions::default() };
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

criterion_group!(benches, histories);
criterion_main!(benches);
