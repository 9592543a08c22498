//! Events where two rules meet: landings on samples, thresholds that are just reached, the end of
//! the wait for rest.

use super::super::rock_many;
use crate::G0_M_S2;
use crate::block::Block;
use crate::motion::Motion;
use crate::rocking::{
    Base, Outcome, Restitution, Rocking, RockingModel, RockingOptions, RockingSummary, StopReason,
    Until, rock,
};

fn under(motion: &Motion) -> Base<'_> {
    Base {
        horizontal: Some(motion),
        vertical: None,
    }
}

fn both(block: &Block, base: Base, options: &RockingOptions) -> (RockingSummary, Rocking) {
    let kernel = rock_many(std::slice::from_ref(block), base, options);
    (kernel[0].unwrap(), rock(block, base, options).unwrap())
}

/// Blocks a few units in the last place apart, around one whose first landing falls on a sample:
/// some of them land on it to the last bit, and go on rocking all the same.
#[test]
fn a_landing_on_a_sample_is_one_landing() {
    let options = RockingOptions::default();
    for (dt, peak_g) in [
        (0.02, 0.5),
        (0.05, 0.6),
        (0.01, 0.9),
        (0.03, 0.4),
        (0.002, 1.1),
    ] {
        let mut accel = vec![
            0.0,
            -peak_g * G0_M_S2,
            -peak_g * G0_M_S2,
            -0.3 * peak_g * G0_M_S2,
        ];
        accel.resize(400, 0.0);
        let motion = Motion::new(dt, accel).unwrap();
        let block = |height: f64, thickness: f64| Block::uniform(height, thickness).unwrap();
        let first = rock(&block(1.2, 0.3), under(&motion), &options)
            .unwrap()
            .impacts[0]
            .time_s;
        let sample = (first / dt) as usize + 1;
        // The kernel's own landing, before or behind the sample: the two solvers differ by 1e-10,
        // half a million units.
        let until_then = Motion::new(dt, motion.accel_m_s2()[..=sample].to_vec()).unwrap();
        let landed = |thickness| {
            both(&block(1.2, thickness), under(&until_then), &options)
                .0
                .impact_count
                > 0
        };
        let (mut low, step) = (0.3, 0.001);
        while landed(low - step) {
            low -= step;
        }
        let mut high = low - step;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if landed(middle) { &mut low } else { &mut high }) = middle;
        }
        let near = |value: f64, units: i32| value * (1.0 + f64::from(units) * f64::EPSILON);
        let blocks: Vec<Block> = (-60..60)
            .flat_map(|i| (-60..60).map(move |j| block(near(1.2, i), near(low, j))))
            .collect();
        let scalar = rock(&block(1.2, low), under(&motion), &options).unwrap();
        assert!(
            (scalar.impacts[0].time_s / dt - sample as f64).abs() < 1e-7,
            "it lands on the sample"
        );
        let expected = RockingSummary::from(&scalar);
        for (block, got) in blocks
            .iter()
            .zip(rock_many(&blocks, under(&motion), &options))
        {
            let got = got.unwrap();
            for (got, expected) in got.sides.iter().zip(expected.sides) {
                // Far above what the solvers differ by, and far below the flight that a rest on the
                // sample would lose.
                let error = (got.peak_rotation_rad / expected.peak_rotation_rad - 1.0).abs();
                assert!(
                    error < 1e-6,
                    "every {dt} s, {block:?}: {got:?} instead of {expected:?}"
                );
            }
            // One more or less where the last speed is about that of rest.
            assert!(
                got.impact_count.abs_diff(expected.impact_count) <= 1,
                "{got:?} instead of {expected:?}"
            );
        }
    }
}

/// With g = 1 m/s² a sample is the threshold to the bit; neither solver may round it to the other
/// side.
#[test]
fn thresholds_that_are_just_reached() {
    for model in [RockingModel::Rigid, RockingModel::Linearised] {
        for (height, thickness) in [(2.0, 0.5), (1.7, 0.3), (0.3, 0.33), (5.0, 0.1)] {
            let block = Block::uniform(height, thickness).unwrap();
            let options = RockingOptions {
                model,
                gravity_m_s2: 1.0,
                ..RockingOptions::default()
            };
            let threshold = model.uplift_threshold_ratio(&block);
            for units in -3..=3 {
                let bits = threshold.to_bits() as i64 + units;
                let at = f64::from_bits(bits as u64);
                for accel in [
                    vec![0.0, at, 0.0],
                    vec![at, at],
                    vec![0.0, at, at, 0.0],
                    vec![-at, 0.0, at],
                ] {
                    let mirrored = accel.iter().map(|a| -a).collect();
                    for accel in [accel.clone(), mirrored] {
                        let motion = Motion::new(0.1, accel.clone()).unwrap();
                        let (kernel, scalar) = both(&block, under(&motion), &options);
                        assert_eq!(
                            kernel.outcome, scalar.outcome,
                            "{block:?} {model:?} {accel:?}"
                        );
                        let has_lifted = scalar.outcome != Outcome::NoUplift;
                        assert_eq!(has_lifted, units > 0, "{block:?} {model:?} {accel:?}");
                    }
                }
            }
        }
    }
}

/// The wait for rest may be longer or shorter than a step, or no multiple of it.
#[test]
fn every_wait_for_rest_ends_as_it_does_for_the_scalar_solver() {
    let dt = 0.1;
    let strong = Motion::new(dt, vec![0.0, 3.0, -3.0, 4.0, 0.0, 2.0]).unwrap();
    let weak = Motion::new(dt, vec![0.0, 0.1]).unwrap();
    let block = Block::uniform(2.0, 0.5).unwrap();
    for motion in [&strong, &weak] {
        for steps in [0.0, 0.3, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 10.7, 1000.0] {
            let options = RockingOptions {
                until: Until::Settled {
                    at_most_s: steps * dt,
                },
                ..RockingOptions::default()
            };
            let (kernel, scalar) = both(&block, under(motion), &options);
            assert_eq!(
                (kernel.outcome, kernel.stop),
                (scalar.outcome, scalar.stop),
                "{steps} steps, {motion:?}"
            );
            assert_eq!(kernel.impact_count, scalar.impacts.len(), "{steps} steps");
            // 1e-10 a step, over fewer than a hundred steps.
            assert!(
                (kernel.peak_rotation_rad - scalar.peak_rotation_rad).abs()
                    <= 1e-8 * scalar.peak_rotation_rad
            );
        }
    }
}

/// A block that still rocks at the end of the wait has rocked if its energy is too small to pass a balance point,
/// also of the steeper edge; what has more is unresolved. Both follow from the long run.
#[test]
fn a_block_that_cannot_fall_any_more_has_rocked() {
    let dt = 0.02;
    let mut counts = [0; 3];
    for (steps, off_m, r) in [
        (2.0, 0.0, 0.8),
        (5.3, 0.0, 0.999),
        (60.0, 0.01, 0.999),
        (200.5, 0.0, 0.999),
    ] {
        let block = Block::uniform(2.0, 0.3)
            .unwrap()
            .with_cg_offset(off_m)
            .unwrap();
        for scale in 0..120 {
            let peak = 1.6 + 0.02 * f64::from(scale);
            let push = |k: i32| peak * (0.12 * f64::from(k)).sin();
            let motion = Motion::new(dt, (0..53).map(push).collect()).unwrap();
            let followed = |at_most_s| RockingOptions {
                restitution: Restitution::Value(r),
                until: Until::Settled { at_most_s },
                ..RockingOptions::default()
            };
            let (kernel, scalar) = both(&block, under(&motion), &followed(steps * dt));
            assert_eq!((kernel.outcome, kernel.stop), (scalar.outcome, scalar.stop));
            assert_eq!(kernel.impact_count, scalar.impacts.len());
            let later = rock(&block, under(&motion), &followed(1e4)).unwrap();
            let expected = match (scalar.stop, scalar.outcome) {
                (StopReason::EndOfMotion, Outcome::Rocked) => {
                    counts[0] += 1;
                    Outcome::Rocked
                }
                (StopReason::EndOfMotion, Outcome::Unresolved) => {
                    counts[1] += usize::from(later.outcome == Outcome::Overturned);
                    counts[2] += usize::from(later.outcome == Outcome::Rocked);
                    later.outcome
                }
                (_, outcome) => outcome,
            };
            assert_eq!(later.outcome, expected, "{steps} steps, {peak} m/s²");
        }
    }
    // All of them occur: rocked, and unresolved with either end.
    assert!(counts.iter().all(|count| *count > 0), "{counts:?}");
}

/// A block that would need more than 1e5 impacts counts as rocking for ever, for both.
#[test]
fn a_block_that_rocks_for_ever_stops_at_once() {
    let motion = Motion::new(0.002, vec![0.0, 3.0, 3.0, 3.0, 0.0]).unwrap();
    for r in [0.99, 0.999, 0.9997, 0.9998, 0.99985, 0.9999, 0.99995, 1.0] {
        for height in [0.001, 0.01, 0.5] {
            let block = Block::uniform(height, 0.25 * height).unwrap();
            let until = Until::Settled { at_most_s: 60.0 };
            let options = RockingOptions {
                restitution: Restitution::Value(r),
                until,
                ..RockingOptions::default()
            };
            let (kernel, scalar) = both(&block, under(&motion), &options);
            assert_eq!(
                (kernel.outcome, kernel.stop),
                (scalar.outcome, scalar.stop),
                "r {r}, {height} m"
            );
            // No later flight is higher; 1e-13 a step, over many impacts.
            let longer = RockingOptions {
                until: Until::Time(scalar.end_time_s + 1.0),
                ..options
            };
            let later = rock(&block, under(&motion), &longer).unwrap();
            for side in [0, 1] {
                let [later, peak] = [&later, &scalar].map(|r| r.sides[side].peak_rotation_rad);
                assert!((later - peak).abs() <= 1e-9 * peak, "r {r}, {height} m");
            }
            // One more or less where the last speed is about that of rest.
            assert!(
                kernel.impact_count.abs_diff(scalar.impacts.len()) <= 1,
                "r {r}, {height} m"
            );
        }
    }
}

/// A base that stays a unit in the last place above the threshold hardly lifts a block, in steps
/// that no binary fraction divides an interval into; it must come to an end all the same.
#[test]
fn a_plateau_at_the_threshold_ends_in_any_number_of_steps() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let options = RockingOptions {
        gravity_m_s2: 1.0,
        ..RockingOptions::default()
    };
    let threshold = options.model.uplift_threshold_ratio(&block);
    for i in 0..150 {
        let dt = 0.1 * 1.035_f64.powi(i);
        for units in [-1, 0, 1, 2] {
            let at = f64::from_bits((threshold.to_bits() as i64 + units) as u64);
            let motion = Motion::new(dt, vec![at, at, at, 0.0]).unwrap();
            let (kernel, scalar) = both(&block, under(&motion), &options);
            assert_eq!(
                kernel.outcome, scalar.outcome,
                "every {dt} s, {units} units"
            );
        }
    }
}

/// Blocks a few units in the last place apart, whose largest rotation falls on a sample.
#[test]
fn a_maximum_on_a_sample_is_found() {
    let options = RockingOptions::default();
    for (dt, peak_g) in [(0.02, 0.5), (0.05, 0.6), (0.01, 0.9), (0.03, 0.4)] {
        let mut accel = vec![
            0.0,
            -peak_g * G0_M_S2,
            -peak_g * G0_M_S2,
            -0.3 * peak_g * G0_M_S2,
        ];
        accel.resize(400, 0.0);
        let motion = Motion::new(dt, accel).unwrap();
        let block = |thickness: f64| Block::uniform(1.2, thickness).unwrap();
        let peak_at = |thickness: f64| {
            rock(&block(thickness), under(&motion), &options)
                .unwrap()
                .peak_rotation_time_s
                .unwrap()
                / dt
        };
        let sample = peak_at(0.3).floor();
        // A thicker block turns back earlier.
        let (mut before, mut behind) = (0.4, 0.3);
        assert!(
            peak_at(before) < sample && peak_at(behind) >= sample,
            "every {dt} s"
        );
        for _ in 0..60 {
            let middle = 0.5 * (before + behind);
            *(if peak_at(middle) < sample {
                &mut before
            } else {
                &mut behind
            }) = middle;
        }
        let expected = rock(&block(before), under(&motion), &options)
            .unwrap()
            .peak_rotation_rad;
        let blocks: Vec<Block> = (-20_000..20_000)
            .map(|i| block(before * (1.0 + f64::from(i) * f64::EPSILON)))
            .collect();
        for (block, got) in blocks
            .iter()
            .zip(rock_many(&blocks, under(&motion), &options))
        {
            // 1e-10 is the accuracy; without the maximum what is left is 0, or a later one.
            let got = got.unwrap().peak_rotation_rad;
            assert!(
                (got / expected - 1.0).abs() < 1e-9,
                "every {dt} s, {block:?}: {got} instead of {expected}"
            );
        }
    }
}
