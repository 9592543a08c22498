//! Properties of every solver of the rocking block: symmetries, event rules, a periodic orbit,
//! accuracy. The closed forms are checked by `freestand validate`.

#![expect(clippy::unwrap_used, reason = "a test may stop at an error")]

use std::f64::consts::{FRAC_PI_2, PI};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::impact::ImpactModel;
use freestand::motion::Motion;
use freestand::rocking::Outcome;
use freestand::rocking::{
    Accuracy, Base, HistoryPoint, HistoryRecorder, Restitution, Rocking, RockingError,
    RockingModel, RockingOptions, StopReason, Until, rock, rock_observed,
};
use freestand::spectra::UpliftCell;
use proptest::prelude::*;

/// A block of slenderness angle `alpha` and half diagonal 1 m.
fn block(alpha: f64) -> Block {
    Block::uniform(2.0 * alpha.cos(), 2.0 * alpha.sin()).unwrap()
}

fn frequency(block: &Block) -> f64 {
    block.pivot().frequency_parameter_rad_s(G0_M_S2)
}

fn under(motion: &Motion) -> Base<'_> {
    Base {
        horizontal: Some(motion),
        vertical: None,
    }
}

fn free(rotation_rad: f64, omega_rad_s: f64, until_s: f64, model: RockingModel) -> RockingOptions {
    RockingOptions {
        model,
        initial_rotation_rad: rotation_rad,
        initial_omega_rad_s: omega_rad_s,
        until: Until::Time(until_s),
        ..RockingOptions::default()
    }
}

/// A periodic orbit under ü/(αg) = β cos(wτ+ψ) has one impact in each half period, at ω⁺/(pα) =
/// 0.7360089115 for (β, w, r) = (5, 8, 0.85); a solver that starts there must return there.
#[test]
fn forced_periodic_orbit() {
    let (beta, w, r, v) = (5.0, 8.0, 0.85, 0.7360089115);
    let (alpha, half) = (0.2, PI / w);
    let block = block(alpha);
    let p = frequency(&block);
    // y'' = y − 1 − β cos(wτ+ψ) on the right side from (0, v) to (0, −v/r) at τ = π/w. With the
    // forcing's particular solution y = 1 + b cos(wτ+ψ), b = β/(1+w²), the two conditions give cos
    // ψ and sin ψ.
    let b = beta / (1.0 + w * w);
    let (ch, sh) = (half.cosh(), half.sinh());
    // y = 1 + b cos(wτ+ψ) + C cosh τ + S sinh τ; C = −1 − b cos ψ, S = v + b w sin ψ; y(half) = 0,
    // y'(half) = −v/r. 1 − b c + (−1 − b c) ch + (v + b w s) sh = 0 ; b w s + (−1 − b c) sh + (v +
    // b w s) ch = −v/r.
    let (a11, a12, r1) = (-b * (1.0 + ch), b * w * sh, ch - 1.0 - v * sh);
    let (a21, a22, r2) = (-b * sh, b * w * (1.0 + ch), sh - v * ch - v / r);
    let det = a11 * a22 - a12 * a21;
    let (c, s) = ((r1 * a22 - r2 * a12) / det, (a11 * r2 - a21 * r1) / det);
    assert!(
        (c * c + s * s - 1.0).abs() < 1e-8,
        "the printed velocity belongs to an orbit: {c} {s}"
    );
    let psi = s.atan2(c);
    let (dt, n) = (half / p / 4000.0, 8000);
    let samples = (0..=n)
        .map(|i| alpha * G0_M_S2 * beta * (w * p * dt * f64::from(i) + psi).cos())
        .collect();
    let motion = Motion::new(dt, samples).unwrap();
    let options = RockingOptions {
        model: RockingModel::Linearised,
        restitution: Restitution::Value(r),
        initial_omega_rad_s: v * p * alpha,
        ..RockingOptions::default()
    };
    let got = rock(&block, under(&motion), &options).unwrap();
    for (k, impact) in got.impacts.iter().take(2).enumerate() {
        // Straight lines over 1/4000 of a half period: (π/4000)²/12 of the forcing, 5e-8.
        assert!(
            (p * impact.time_s - half * (k + 1) as f64).abs() < 1e-6,
            "{k}"
        );
        assert!((impact.omega_after_rad_s.abs() / (p * alpha) - v).abs() < 1e-6);
    }
    // The second one is on the last sample and may fall just after it.
    assert!(!got.impacts.is_empty());
}

/// A motion of a few sines with an envelope: irregular enough for uplift, impact, rest and uplift
/// again.
fn rough(seed: u64, peak_g: f64, seconds: f64) -> Motion {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let waves: Vec<_> = (0..12)
        .map(|_| (0.3 + 6.0 * uniform(), 2.0 * PI * uniform(), uniform()))
        .collect();
    let dt = 0.01;
    let n = (seconds / dt) as usize;
    let raw: Vec<f64> = (0..=n)
        .map(|i| {
            let t = i as f64 * dt;
            let envelope = (t / 2.0).min(1.0) * (1.0 - t / seconds).max(0.0);
            envelope
                * waves
                    .iter()
                    .map(|(f, phase, a)| a * (2.0 * PI * f * t + phase).sin())
                    .sum::<f64>()
        })
        .collect();
    let peak = raw.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    Motion::new(
        dt,
        raw.iter().map(|a| a / peak * peak_g * G0_M_S2).collect(),
    )
    .unwrap()
}

fn solve(block: &Block, motion: &Motion) -> Rocking {
    rock(block, under(motion), &RockingOptions::default()).unwrap()
}

/// Whether a change of the motion by 1e-7 hardly changes outcome and peak: only then is a
/// comparison meaningful.
fn insensitive(block: &Block, motion: &Motion) -> bool {
    let (a, b) = (
        solve(block, motion),
        solve(block, &motion.scaled(1.0 + 1e-7).unwrap()),
    );
    a.outcome == b.outcome
        && (a.peak_rotation_rad - b.peak_rotation_rad).abs() <= 1e-5 * a.peak_rotation_rad
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// −ü gives −θ, to the bit.
    #[test]
    fn mirror(seed: u64, height in 0.3f64..4.0, ratio in 0.8f64..8.0, peak in 0.1f64..1.2) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, peak, 8.0);
        let (a, b) = (solve(&block, &motion), solve(&block, &motion.scaled(-1.0).unwrap()));
        prop_assert_eq!(a.final_rotation_rad, -b.final_rotation_rad);
        prop_assert_eq!(a.peak_rotation_rad, b.peak_rotation_rad);
        prop_assert_eq!(a.impacts.len(), b.impacts.len());
        for (x, y) in a.impacts.iter().zip(&b.impacts) {
            prop_assert_eq!((x.time_s, x.omega_before_rad_s), (y.time_s, -y.omega_before_rad_s));
        }
    }

    /// The mirrored block under the mirrored motion, with the centre of gravity off the middle.
    #[test]
    fn mirror_with_an_offset(seed: u64, offset in -0.15f64..0.15, peak in 0.1f64..0.8) {
        let of = |offset| Block::uniform(1.8, 0.5).unwrap().with_cg_offset(offset).unwrap();
        let motion = rough(seed, peak, 6.0);
        let (a, b) = (solve(&of(offset), &motion), solve(&of(-offset), &motion.scaled(-1.0).unwrap()));
        prop_assert_eq!(a.final_rotation_rad, -b.final_rotation_rad);
        prop_assert_eq!(a.peak_rotation_rad, b.peak_rotation_rad);
    }

    /// R·4 and time·2 at the same accelerations give the same θ: powers of two, so to the bit,
    /// except for the rest speed.
    #[test]
    fn similarity(seed: u64, height in 0.3f64..2.0, ratio in 1.0f64..8.0, peak in 0.1f64..1.0) {
        let small = Block::uniform(height, height / ratio).unwrap();
        let large = Block::uniform(4.0 * height, 4.0 * height / ratio).unwrap();
        let fast = rough(seed, peak, 6.0);
        let slow = Motion::new(2.0 * fast.dt_s(), fast.accel_m_s2().to_vec()).unwrap();
        prop_assume!(insensitive(&small, &fast));
        let (a, b) = (solve(&small, &fast), solve(&large, &slow));
        prop_assert_eq!(a.outcome, b.outcome);
        // The rest speed is in rad/s and does not scale: the results of a block that came to rest
        // differ accordingly.
        prop_assert!((a.peak_rotation_rad - b.peak_rotation_rad).abs() <= 1e-8 * a.peak_rotation_rad);
    }

    /// Zeros appended to the motion change nothing before them.
    #[test]
    fn zero_padding(seed: u64, height in 0.3f64..4.0, ratio in 0.8f64..8.0, peak in 0.1f64..1.2) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, peak, 6.0);
        let short = solve(&block, &motion);
        let long = solve(&block, &motion.with_zero_tail(5.0).unwrap());
        prop_assert!(long.peak_rotation_rad >= short.peak_rotation_rad);
        prop_assert!(long.impacts.len() >= short.impacts.len());
        prop_assert_eq!(&short.impacts[..], &long.impacts[..short.impacts.len()]);
        // A longer duration is equivalent to zeros.
        let options = RockingOptions { until: Until::Time(motion.duration_s() + 5.0), ..RockingOptions::default() };
        let lasting = rock(&block, under(&motion), &options).unwrap();
        prop_assert_eq!(lasting.outcome, long.outcome);
        prop_assert_eq!(lasting.at_rest, long.at_rest);
        prop_assert!(lasting.impacts.is_sorted_by(|a, b| a.time_s < b.time_s));
        let late = |history: &Rocking| history.impacts.iter().filter(|i| i.omega_before_rad_s.abs() > 1e-6).count();
        prop_assert_eq!(late(&lasting), late(&long));
        let end = (lasting.final_rotation_rad - long.final_rotation_rad).abs();
        prop_assert!(end <= 1e-7 * long.peak_rotation_rad, "{} {}", lasting.final_rotation_rad, long.final_rotation_rad);
        prop_assert!((lasting.peak_rotation_rad - long.peak_rotation_rad).abs() <= 1e-9 * long.peak_rotation_rad);
    }

    /// An additional sample on the straight line between two others changes nothing.
    #[test]
    fn resampling_on_the_straight_lines(seed: u64, height in 0.3f64..4.0, ratio in 1.0f64..8.0, peak in 0.1f64..1.0) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let coarse = rough(seed, peak, 6.0);
        let a = coarse.accel_m_s2();
        let fine: Vec<f64> = (0..2 * a.len() - 1)
            .map(|i| if i % 2 == 0 { a[i / 2] } else { 0.5 * (a[i / 2] + a[i / 2 + 1]) })
            .collect();
        let fine = Motion::new(0.5 * coarse.dt_s(), fine).unwrap();
        prop_assume!(insensitive(&block, &coarse));
        let (a, b) = (solve(&block, &coarse), solve(&block, &fine));
        prop_assert_eq!(a.outcome, b.outcome);
        // 1e-13 per step, times an amplification of up to 100 (`insensitive`), times the number of
        // steps.
        prop_assert!((a.peak_rotation_rad - b.peak_rotation_rad).abs() <= 1e-9 * a.peak_rotation_rad);
    }

    /// Without base motion and with r = 1 the energy p²cos(α−|θ|) + ω²/2 is constant.
    #[test]
    fn energy(alpha in 0.05f64..1.0, share in 0.01f64..0.99) {
        let block = block(alpha);
        let p2 = frequency(&block).powi(2);
        let options = RockingOptions {
            restitution: Restitution::Value(1.0),
            ..free(alpha * share, 0.0, 5.0, RockingModel::Rigid)
        };
        let energy = |(theta, omega): (f64, f64)| p2 * (alpha - theta.abs()).cos() + 0.5 * omega * omega;
        let start = energy((alpha * share, 0.0));
        let swing = p2 * (1.0 - alpha.cos());
        let mut worst = 0.0f64;
        rock_observed(&block, Base::default(), &options, |segment| {
            worst = worst.max((energy(segment.rotation(segment.end_ratio)) - start).abs());
        }).unwrap();
        // 1e-13 per step over some hundreds of steps, relative to the height of the potential well.
        prop_assert!(worst <= 1e-10 * swing, "{} of {}", worst, swing);
    }

    /// No finite input causes a panic, an endless loop or a result that is not a number.
    #[test]
    fn any_finite_input_ends(
        seed: u64,
        log_height in -3.0f64..2.0,
        ratio in 0.3f64..50.0,
        log_peak in -6.0f64..6.0,
        r in 0.0f64..=1.0,
    ) {
        let height = 10f64.powf(log_height);
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, 10f64.powf(log_peak), 4.0);
        let options = RockingOptions { restitution: Restitution::Value(r), ..RockingOptions::default() };
        match rock(&block, under(&motion), &options) {
            Ok(got) => prop_assert!(got.peak_rotation_rad.is_finite() && got.peak_rotation_rad <= FRAC_PI_2),
            Err(error) => prop_assert!(matches!(error, RockingError::TooManyImpacts { .. }), "{}", error),
        }
    }
}

/// The error of a history decreases with the tolerance of its steps.
#[test]
fn accuracy_is_what_was_asked_for() {
    let block = Block::uniform(1.5, 0.5).unwrap();
    let motion = rough(7, 0.5, 8.0);
    let peak = |accuracy| {
        let options = RockingOptions {
            accuracy,
            ..RockingOptions::default()
        };
        rock(&block, under(&motion), &options)
            .unwrap()
            .peak_rotation_rad
    };
    let exact = peak(Accuracy::Tight);
    for tolerance in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        let error = (peak(Accuracy::Tolerance(tolerance)) / exact - 1.0).abs();
        // Hundreds of steps, amplified, with series that stop well below the tolerance.
        assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
    }
    // The levels really differ.
    assert!((peak(Accuracy::Tolerance(1e-5)) / exact - 1.0).abs() > 1e-9);
}

#[test]
fn an_impact_on_a_sample_is_one_impact() {
    // Free rocking with its first impact on a sample of a record of zeros.
    let block = block(0.2);
    let first = rock(
        &block,
        Base::default(),
        &free(0.1, 0.0, 3.0, RockingModel::Rigid),
    )
    .unwrap();
    let dt = first.impacts[0].time_s / 100.0;
    let quiet = Motion::new(dt, vec![0.0; 301]).unwrap();
    let options = free(0.1, 0.0, 300.0 * dt, RockingModel::Rigid);
    let got = rock(&block, under(&quiet), &options).unwrap();
    for (a, b) in got.impacts.iter().zip(&first.impacts) {
        assert!((a.time_s - b.time_s).abs() < 1e-11);
        assert!((a.omega_before_rad_s / b.omega_before_rad_s - 1.0).abs() < 1e-10);
    }
    assert!(!got.impacts.is_empty());
}

#[test]
fn two_impacts_between_two_samples_are_both_found() {
    let block = block(0.2);
    let coarse = Motion::new(3.0, vec![0.0, 0.0]).unwrap();
    let got = rock(
        &block,
        under(&coarse),
        &free(0.05, 0.0, 3.0, RockingModel::Rigid),
    )
    .unwrap();
    let fine = Motion::new(0.01, vec![0.0; 301]).unwrap();
    let expected = rock(
        &block,
        under(&fine),
        &free(0.05, 0.0, 3.0, RockingModel::Rigid),
    )
    .unwrap();
    assert!(got.impacts.len() > 3);
    assert_eq!(got.impacts.len(), expected.impacts.len());
    for (a, b) in got.impacts.iter().zip(&expected.impacts) {
        assert!((a.time_s - b.time_s).abs() < 1e-11);
    }
}

/// The geometric series of impacts of a block without base motion: it comes to rest, exactly at 0,
/// and the time is reported.
#[test]
fn chatter_ends_in_rest() {
    let block = block(0.2);
    let options = RockingOptions {
        until: Until::Settled { at_most_s: 600.0 },
        ..free(0.1, 0.0, 1.0, RockingModel::Rigid)
    };
    let got = rock(&block, Base::default(), &options).unwrap();
    assert_eq!(
        (got.stop, got.at_rest, got.final_rotation_rad),
        (StopReason::Settled, true, 0.0)
    );
    let last = got.impacts.last().unwrap();
    assert!(last.omega_after_rad_s.abs() <= 1e-9 && got.rest_time_s == Some(last.time_s));
    // A halted landing comes to rest at the first impact.
    let halted = RockingOptions {
        restitution: Restitution::Value(0.0),
        ..options
    };
    assert_eq!(
        rock(&block, Base::default(), &halted)
            .unwrap()
            .impacts
            .len(),
        1
    );
}

/// A block that is thrown beyond its balance point within the record is followed until it lies, one that
/// is not until it rests; zeros after the record change nothing, and a time that was given ends it.
#[test]
fn a_history_goes_on_until_the_block_rests_or_lies() {
    let block = Block::uniform(1.5, 0.3).unwrap();
    let settled = RockingOptions {
        until: Until::Settled { at_most_s: 120.0 },
        ..RockingOptions::default()
    };
    let sine = |peak_g: f64| {
        let sample =
            |i: u32| peak_g * G0_M_S2 * (std::f64::consts::TAU * f64::from(i) / 100.0).sin();
        Motion::new(0.01, (0..=100).map(sample).collect()).unwrap()
    };
    for (peak_g, outcome) in [
        (0.1, Outcome::NoUplift),
        (0.23, Outcome::Rocked),
        (0.5, Outcome::Overturned),
    ] {
        let motion = sine(peak_g);
        let bare = rock(&block, under(&motion), &settled).unwrap();
        let padded = rock(
            &block,
            under(&motion.with_zero_tail(20.0).unwrap()),
            &settled,
        )
        .unwrap();
        assert_eq!(
            (bare.outcome, padded.outcome),
            (outcome, outcome),
            "{peak_g} g"
        );
        // The steps of the padded history end at its samples.
        assert!(
            (bare.peak_rotation_rad - padded.peak_rotation_rad).abs()
                <= 1e-9 * padded.peak_rotation_rad
        );
    }
    let ended = RockingOptions {
        until: Until::Time(1.0),
        ..RockingOptions::default()
    };
    assert_eq!(
        rock(&block, under(&sine(0.5)), &ended).unwrap().outcome,
        Outcome::Unresolved
    );
    // A restitution of 1 never ends: what comes down fast enough falls over on the other side.
    let fast = RockingOptions {
        restitution: Restitution::Value(1.0),
        initial_rotation_rad: 0.1,
        initial_omega_rad_s: -3.0,
        ..settled
    };
    assert_eq!(
        rock(&block, Base::default(), &fast).unwrap().outcome,
        Outcome::Overturned
    );
}

/// The quiet after a short record is calculated once: a block released at α + 0.01 is still falling
/// at 0.8 s.
#[test]
fn the_tail_is_passed_once() {
    let block = Block::uniform(1.0, 0.2).unwrap();
    let still = Motion::new(0.1, vec![0.0; 3]).unwrap();
    let options = free(0.21, 0.0, 0.8, RockingModel::Rigid);
    let (behind, alone) = (
        rock(&block, under(&still), &options).unwrap(),
        rock(&block, Base::default(), &options).unwrap(),
    );
    assert_eq!(
        (behind.outcome, behind.end_time_s),
        (Outcome::Unresolved, 0.8)
    );
    // Three steps of 1e-13, growing with e^(p t).
    assert!((behind.peak_rotation_rad / alone.peak_rotation_rad - 1.0).abs() < 1e-10);
}

/// In free rocking, which loses no energy between impacts, both sources of energy agree at the
/// first landing, from either edge.
#[test]
fn both_energy_sources_agree_in_a_free_landing() {
    for (offset, rotation) in [(0.0, 0.1), (0.2, 0.1), (0.2, -0.1), (-0.1, 0.15)] {
        let block = Block::uniform(2.0, 0.8)
            .unwrap()
            .with_cg_offset(offset)
            .unwrap();
        // Up to the first impact: later ones start from the other edge.
        let first = rock(
            &block,
            Base::default(),
            &free(rotation, 0.0, 5.0, RockingModel::Rigid),
        )
        .unwrap()
        .impacts[0];
        let options = free(
            rotation,
            0.0,
            first.time_s * (1.0 + 1e-9),
            RockingModel::Rigid,
        );
        let got = rock(&block, Base::default(), &options).unwrap();
        let shock = UpliftCell::new(block, &got).shock(
            100.0,
            &Cushion::linear(4e6).unwrap(),
            ImpactModel::Paper,
            G0_M_S2,
        );
        let (uplift, velocity) = (
            shock.edge_acceleration_g.unwrap(),
            shock.edge_acceleration_impact_velocity_g.unwrap(),
        );
        // Energy to 1e-13 per step.
        assert!(
            (velocity / uplift - 1.0).abs() < 1e-10,
            "{offset} {rotation}: {uplift} {velocity}"
        );
    }
}

#[test]
fn the_threshold_itself_does_not_uplift_and_a_hair_more_does() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let threshold = 0.25 * G0_M_S2;
    let at = |factor: f64| {
        let motion = Motion::new(0.1, vec![0.0, factor * threshold, 0.0]).unwrap();
        solve(&block, &motion).outcome
    };
    assert_eq!(at(1.0), Outcome::NoUplift);
    assert_eq!(at(1.0 - 1e-12), Outcome::NoUplift);
    assert_eq!(at(1.0 + 1e-9), Outcome::Rocked);
}

#[test]
fn the_base_pushes_the_block_the_other_way() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let motion = Motion::new(0.01, vec![0.3 * G0_M_S2; 5]).unwrap();
    let got = solve(&block, &motion);
    assert!(got.final_rotation_rad < 0.0);
    assert_eq!(got.first_uplift_time_s, Some(0.0));
}

#[test]
fn upward_acceleration_holds_the_block_down() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let push = Motion::new(0.01, vec![0.3 * G0_M_S2; 100]).unwrap();
    let lift = Motion::new(0.01, vec![0.21 * G0_M_S2; 100]).unwrap();
    let base = Base {
        horizontal: Some(&push),
        vertical: Some(&lift),
    };
    assert_eq!(
        rock(&block, base, &RockingOptions::default())
            .unwrap()
            .outcome,
        Outcome::NoUplift
    );
    let drop = Motion::new(0.01, vec![-1.01 * G0_M_S2; 100]).unwrap();
    let base = Base {
        horizontal: Some(&push),
        vertical: Some(&drop),
    };
    assert!(matches!(
        rock(&block, base, &RockingOptions::default()),
        Err(RockingError::FreeFlight { .. })
    ));
}

#[test]
fn passing_alpha_is_not_yet_overturning() {
    let block = block(0.2);
    let got = rock(
        &block,
        Base::default(),
        &free(0.25, 0.0, 0.1, RockingModel::Rigid),
    )
    .unwrap();
    assert_eq!(
        (got.outcome, got.passed_alpha_time_s, got.overturn_time_s),
        (Outcome::Unresolved, Some(0.0), None)
    );
    let fallen = rock(
        &block,
        Base::default(),
        &free(0.25, 0.0, 60.0, RockingModel::Rigid),
    )
    .unwrap();
    assert_eq!(
        (fallen.outcome, fallen.stop),
        (Outcome::Overturned, StopReason::Overturned)
    );
    assert_eq!(fallen.peak_rotation_rad, FRAC_PI_2);
    assert_eq!(fallen.cg_rise_m, block.pivot().balance_rise_m());
    assert_eq!(Some(fallen.end_time_s), fallen.overturn_time_s);
}

#[test]
fn a_recorded_history_passes_through_the_reported_events() {
    let block = Block::uniform(1.5, 0.4).unwrap();
    let motion = rough(3, 0.45, 6.0);
    let mut recorder = HistoryRecorder::new(Some(&motion), 0.01);
    let got = rock_observed(&block, under(&motion), &RockingOptions::default(), |s| {
        recorder.observe(s)
    })
    .unwrap();
    let points = recorder.finish(&got);
    assert!(points.windows(2).all(|w| w[0].time_s <= w[1].time_s));
    assert_eq!(
        (points[0].time_s, points.last().unwrap().time_s),
        (0.0, got.end_time_s)
    );
    let top = points
        .iter()
        .fold(0.0, |m: f64, p| m.max(p.theta_rad.abs()));
    assert_eq!(top, got.peak_rotation_rad);
    for impact in &got.impacts {
        // Roundings of the sum of a start and a step, and of a velocity times and over the step.
        let same = |p: &HistoryPoint| {
            (p.time_s - impact.time_s).abs() < 1e-14 * 6.0
                && (p.omega_rad_s - impact.omega_after_rad_s).abs() < 1e-15
        };
        assert!(points.iter().any(same), "{impact:?}");
    }
}

#[test]
fn input_outside_the_model_is_refused() {
    let block = block(0.2);
    let motion = rough(1, 0.1, 1.0);
    let with = |options: RockingOptions| rock(&block, under(&motion), &options);
    let ok = RockingOptions::default();
    for r in [-0.1, 1.0001, f64::NAN] {
        let options = RockingOptions {
            restitution: Restitution::Value(r),
            ..ok
        };
        assert!(matches!(
            with(options),
            Err(RockingError::Restitution { .. })
        ));
    }
    assert!(matches!(
        with(RockingOptions {
            restitution: Restitution::Factor(1.5),
            ..ok
        }),
        Err(RockingError::Restitution { .. })
    ));
    assert!(matches!(
        with(RockingOptions {
            initial_rotation_rad: 1.6,
            ..ok
        }),
        Err(RockingError::InitialState { .. })
    ));
    assert!(matches!(
        with(RockingOptions {
            gravity_m_s2: 0.0,
            ..ok
        }),
        Err(RockingError::Gravity { .. })
    ));
    assert!(matches!(
        with(RockingOptions {
            until: Until::Time(-1.0),
            ..ok
        }),
        Err(RockingError::Duration { .. })
    ));
    assert!(matches!(
        with(RockingOptions {
            accuracy: Accuracy::Tolerance(0.1),
            ..ok
        }),
        Err(RockingError::Accuracy { .. })
    ));
    assert!(matches!(
        rock(&block, Base::default(), &ok),
        Err(RockingError::Duration { .. })
    ));
}
