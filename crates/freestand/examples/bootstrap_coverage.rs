//! How often the 95 % intervals of a fragility contain the true values.
//!
//!     cargo run --release -p freestand --example bootstrap_coverage
//!
//! Motions with one lognormal capacity each (β = 0.4 and, given the capacity of overturning, that of
//! the tolerance at 0.6 of it) at 12 levels; 500 samples of motions for each row, 400 bootstrap
//! replicates in each.

#![expect(clippy::print_stdout, reason = "the result is what it prints")]

use freestand::fragility::{
    FitKind, LimitState, OutcomeClass, Outcomes, Run, bootstrap, draw_stream, fit_curves,
    lognormal_draw,
};

const BETA: f64 = 0.4;
const SURVEYS: u64 = 500;

fn main() {
    println!("motions  median  beta  samples without a curve");
    for motions in [10_usize, 20, 40, 100] {
        let (mut median_holds, mut beta_holds, mut fitted, mut failed) = (0, 0, 0, 0);
        for survey in 0..SURVEYS {
            let mut random = draw_stream(2026, survey, motions as u64, 5);
            let mut runs = Vec::new();
            for motion in 0..motions {
                let capacity = lognormal_draw(&mut random, 1.0, BETA);
                for level in 0..12 {
                    let intensity = 0.15 * 1.4_f64.powi(level);
                    let class = if intensity >= capacity {
                        OutcomeClass::Overturned
                    } else if intensity >= 0.6 * capacity {
                        OutcomeClass::Exceeded
                    } else {
                        OutcomeClass::NoUplift
                    };
                    runs.push(Run {
                        motion: Some(motion),
                        intensity,
                        class,
                        weight: 1.0,
                    });
                }
            }
            let Ok(outcomes) = Outcomes::new(&runs) else {
                continue;
            };
            let states = [LimitState::Exceeds, LimitState::Overturns];
            if fit_curves(&outcomes, &states, FitKind::Ordered)
                .fitted_states()
                .len()
                < 2
            {
                continue;
            }
            let Some(samples) =
                bootstrap(&outcomes, &states, FitKind::Ordered, (400, survey), &|| {
                    true
                })
            else {
                continue;
            };
            let Some(interval) = samples.interval(LimitState::Overturns) else {
                continue;
            };
            let holds =
                |(low, high): (f64, f64), truth: f64| u32::from(low <= truth && truth <= high);
            fitted += 1;
            failed += samples.failed;
            median_holds += holds(interval.median, 1.0);
            beta_holds += holds(interval.beta, BETA);
        }
        let share = |holds: u32| 100.0 * f64::from(holds) / f64::from(fitted);
        let failed = 100.0 * failed as f64 / (400.0 * f64::from(fitted));
        println!(
            "{motions:>7}  {:>4.1} %  {:>4.1} %  {failed:.2} %",
            share(median_holds),
            share(beta_holds)
        );
    }
}
