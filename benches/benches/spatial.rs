//! A prism and a cylinder in three dimensions under two components of 24 s, and a stack: one history
//! each, on one thread; processor time.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark may stop and prints its effort"
)]

use criterion::{Criterion, criterion_group, criterion_main};
use freestand::compliant::CompliantAccuracy;
use freestand::cushion::{ContactLaw, Cushion};
use freestand::motion::Motion;
use freestand::rocking::Base;
use freestand::spatial::{
    Shape, SpatialMotion, SpatialObject, SpatialOptions, Stack, StackBody, Support, rock_spatial,
    rock_stack,
};
use freestand_benches::time_of;

/// 24 s every 5 ms of the record of the other benchmarks, from sample `from` on.
fn record(from: usize) -> Motion {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let samples: Vec<f64> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|l| l.parse().unwrap())
        .collect();
    Motion::new(
        0.005,
        samples
            .iter()
            .cycle()
            .skip(from)
            .take(4801)
            .copied()
            .collect(),
    )
    .unwrap()
}

fn support(law: &ContactLaw, friction_ratio: Option<f64>) -> Support {
    Support {
        friction_ratio,
        ..Support::new(Cushion::new(law.clone()).unwrap())
    }
}

fn histories(criterion: &mut Criterion) {
    let (x, y) = (record(0), record(1700));
    let motion = SpatialMotion {
        x: Some(&x),
        y: Some(&y),
        vertical: None,
    };
    let spring = ContactLaw::Linear { stiffness_n_m: 4e6 };
    let pad = ContactLaw::KelvinVoigt {
        stiffness_n_m: 4e6,
        damping_n_s_m: 2800.0,
    };
    let mut group = criterion.benchmark_group("24 s");
    group.sample_size(10);
    for accuracy in [CompliantAccuracy::Fast, CompliantAccuracy::Standard] {
        let options = SpatialOptions {
            accuracy,
            ..SpatialOptions::default()
        };
        for (name, shape) in [
            (
                "prism",
                Shape::Prism {
                    thickness_m: 0.6,
                    width_m: 0.8,
                    height_m: 1.8,
                },
            ),
            (
                "cylinder",
                Shape::Cylinder {
                    diameter_m: 0.6,
                    height_m: 1.8,
                },
            ),
        ] {
            for (law_name, law) in [("springs", &spring), ("pads, 5 % damped", &pad)] {
                for friction_ratio in [None, Some(0.5)] {
                    let support = support(law, friction_ratio);
                    let object = SpatialObject {
                        shape,
                        mass_kg: 200.0,
                        support,
                        walls: Vec::new(),
                    };
                    let run = || rock_spatial(&object, motion, &options).unwrap();
                    let done = run();
                    let friction = if friction_ratio.is_some() {
                        "friction 0.5"
                    } else {
                        "no slip"
                    };
                    let name = format!("{name}, {law_name}, {friction}, {accuracy:?}");
                    println!(
                        "{name}: {} until {:.1} s, tilt {:.3} rad, {} steps, {} evaluations, energy open by {:.1e}",
                        done.body.outcome.name(),
                        done.end_time_s,
                        done.body.peak_tilt_rad,
                        done.effort.steps,
                        done.effort.evaluations,
                        done.energy.residual_ratio
                    );
                    group.bench_function(name, |b| b.iter_custom(|rounds| time_of(rounds, run)));
                }
            }
        }
        let stack = Stack {
            lower: StackBody {
                height_m: 0.8,
                thickness_m: 0.6,
                mass_kg: 200.0,
            },
            upper: StackBody {
                height_m: 0.6,
                thickness_m: 0.25,
                mass_kg: 40.0,
            },
            support: support(&pad, None),
            interface: support(
                &ContactLaw::KelvinVoigt {
                    stiffness_n_m: 8e5,
                    damping_n_s_m: 560.0,
                },
                None,
            ),
        };
        let base = Base {
            horizontal: Some(&x),
            vertical: None,
        };
        let run = || rock_stack(&stack, base, &options).unwrap();
        group.bench_function(format!("stack, {accuracy:?}"), |b| {
            b.iter_custom(|rounds| time_of(rounds, run))
        });
    }
    group.finish();
}

criterion_group!(benches, histories);
criterion_main!(benches);
