use std::f64::consts::PI;
use std::ops::Range;

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::G0_M_S2;
use crate::cushion::Cushion;

pub(super) const MASS_KG: f64 = 0.365;
pub(super) const STIFFNESS_N_M: f64 = 2.19e6;

pub(super) fn fall_m_s() -> f64 {
    (2.0 * G0_M_S2 * 0.1).sqrt()
}

pub(super) fn setup(known: bool) -> DropSetup {
    let known_speed = ImpactVelocity::Known {
        speed_m_s: fall_m_s(),
        error_ratio: 0.01,
    };
    DropSetup {
        mass_kg: MASS_KG,
        impact_velocity: if known {
            known_speed
        } else {
            ImpactVelocity::FromImpulse
        },
        gravity_m_s2: G0_M_S2,
        filter_corner_hz: None,
        law: None,
    }
}

/// The pad of the worked example in the textbook form: a half-sine, no gravity during the contact,
/// a zero line of 1 g and noise as a share of the peak.
fn half_sine(
    per_contact: f64,
    noise: f64,
    phase: f64,
    seed: u64,
    stiffness_n_m: f64,
) -> (Vec<f64>, f64) {
    let omega = (stiffness_n_m / MASS_KG).sqrt();
    let peak = fall_m_s() * omega;
    let dt_s = PI / omega / per_contact;
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    let count = (6.0 * per_contact) as usize;
    let samples = (0..count).map(|i| {
        let t = (i as f64 - 2.0 * per_contact - phase) * dt_s;
        let pulse = if t > 0.0 && omega * t < PI {
            peak * (omega * t).sin()
        } else {
            0.0
        };
        let normal: f64 = StandardNormal.sample(&mut random);
        pulse + G0_M_S2 + noise * peak * normal
    });
    (samples.collect(), dt_s)
}

pub(super) fn interval(found: &Identified) -> (f64, f64) {
    let half = 1.959964 * found.error_ratio;
    (
        found.stiffness.fit_n_m * (-half).exp(),
        found.stiffness.fit_n_m * half.exp(),
    )
}

/// Half-sines of other seeds, rates and stiffnesses, with a zero line of 1 g: within 2 %, and
/// inside the interval. The interval includes gravity, which these contacts lack and which the
/// record of a stiff pad cannot show: 0.3 % at 350 g. The noise of 0.5 % alone causes 0.2 %; five
/// times both stay within 2 %.
#[test]
#[ignore = "seconds: several fits"]
fn half_sines_give_their_stiffness() {
    half_sines(0..1);
}

#[test]
#[ignore = "ten seconds: 24 drops"]
fn half_sines_under_any_noise_give_their_stiffness() {
    half_sines(0..6);
}

fn half_sines(seeds: Range<u64>) {
    for (per_contact, known, phase) in [
        (50.0, true, 0.0),
        (50.0, false, 0.37),
        (30.0, true, 0.8),
        (200.0, false, 0.5),
    ] {
        for seed in seeds.clone() {
            let (samples, dt_s) = half_sine(per_contact, 0.005, phase, seed, STIFFNESS_N_M);
            let test = drop_test(&samples, dt_s, &setup(known)).unwrap();
            assert_eq!(test.flags, [], "{per_contact} {seed}");
            let found = test.identified.unwrap();
            let error = found.stiffness.fit_n_m / STIFFNESS_N_M - 1.0;
            assert!(error.abs() < 0.02, "{per_contact} {known} {seed}: {error}");
            let (low, high) = interval(&found);
            assert!(
                low < STIFFNESS_N_M && STIFFNESS_N_M < high,
                "{per_contact} {known} {seed}: {low} {high}"
            );
            assert!((found.exponent - 1.0).abs() < 0.03, "{}", found.exponent);
            assert_eq!(found.chosen, FittedLaw::Linear);
            // A sample is a fiftieth of the contact, and the flanks are located to a small part of
            // a sample.
            assert!((test.samples_per_contact.unwrap() / per_contact - 1.0).abs() < 0.01);
        }
    }
}

/// The record shows whether the weight acts where it matters: a pad of 100 N/mm (75 g) with a
/// stated velocity gives its stiffness within 2 % with and without the weight, where the wrong
/// assumption costs 1.6 %.
#[test]
fn weight_is_told_from_the_record() {
    weight_is_told(0..1);
}

#[test]
#[ignore = "seconds: six drops"]
fn weight_is_told_under_any_noise() {
    weight_is_told(0..6);
}

fn weight_is_told(seeds: Range<u64>) {
    let stiffness_n_m = 1e5;
    let pad = Cushion::linear(stiffness_n_m).unwrap();
    let contact_s = pad.land(MASS_KG, fall_m_s()).duration_s;
    for seed in seeds {
        let (without, dt_s) = half_sine(50.0, 0.005, 0.2, seed, stiffness_n_m);
        let options = VirtualDropOptions {
            sample_rate_hz: 50.0 / contact_s,
            pre_trigger_s: 3.0 * contact_s,
            after_s: 4.0 * contact_s,
            noise_ratio: 0.005,
            ..virtual_options(seed)
        };
        let with = virtual_drop(&pad, &options).unwrap();
        for (samples, dt_s, has_gravity) in
            [(without, dt_s, false), (with.samples_m_s2, with.dt_s, true)]
        {
            let found = drop_test(&samples, dt_s, &setup(true))
                .unwrap()
                .identified
                .unwrap();
            assert_eq!(found.has_gravity, has_gravity, "{seed}");
            let (low, high) = interval(&found);
            assert!(
                (found.stiffness.fit_n_m / stiffness_n_m - 1.0).abs() < 0.01,
                "{seed} {has_gravity} {found:?}"
            );
            assert!(low < stiffness_n_m && stiffness_n_m < high);
        }
    }
}

/// Without noise the four estimates agree with the closed forms: peak 349.808 g, 1.28255 ms,
/// 0.571741 mm. The trapezoidal rule over 50 samples reduces the compression by (π/50)²/12 = 3e-4.
/// Without noise the record also shows that no weight acts.
#[test]
#[ignore = "seconds: several fits"]
fn four_estimates_agree_where_the_pad_is_linear() {
    let (samples, dt_s) = half_sine(50.0, 0.0, 0.0, 1, STIFFNESS_N_M);
    let plain = DropSetup {
        gravity_m_s2: 0.0,
        ..setup(true)
    };
    let test = drop_test(&samples, dt_s, &plain).unwrap();
    assert!((test.peak_acceleration_m_s2.unwrap() / G0_M_S2 / 349.808 - 1.0).abs() < 1e-3);
    assert!((test.contact_time_s.unwrap() * 1e3 / 1.282550 - 1.0).abs() < 1e-3);
    assert!((test.max_compression_m.unwrap() * 1e3 / 0.571741 - 1.0).abs() < 1e-3);
    assert!((test.restitution_ratio.unwrap() - 1.0).abs() < 2e-3);
    let found = test.identified.unwrap();
    assert!(found.stiffness.spread_ratio() < 4e-3);
    assert!((found.exponent_by_identity - 1.0).abs() < 4e-3);
    let falling = drop_test(&samples, dt_s, &setup(true)).unwrap();
    assert!(!falling.identified.unwrap().has_gravity);
}

/// A pulse of a law in the time domain, from small steps of the equation of motion: semi-implicit
/// Euler, 1e-4.
fn stepped(force_n: impl Fn(f64, f64) -> f64, per_contact: f64, contact_s: f64) -> (Vec<f64>, f64) {
    let dt_s = contact_s / per_contact;
    let fine = 400;
    let h = dt_s / f64::from(fine);
    let lead = 3 * per_contact as usize;
    let mut samples = vec![0.0; lead];
    let (mut d, mut v, mut left) = (0.0, fall_m_s(), false);
    for step in 0..(4.0 * per_contact) as i32 * fine {
        let force = if left { 0.0 } else { force_n(d, v).max(0.0) };
        left |= v < 0.0 && force == 0.0;
        if step % fine == fine / 3 {
            samples.push(force / MASS_KG);
        }
        v += h * (G0_M_S2 - force / MASS_KG);
        d += h * v;
    }
    (samples, dt_s)
}

/// K and n of a Hertz pad, ζ of a Kelvin–Voigt pad, Λ of Hunt and Crossley: the time steps are
/// accurate to 1e-3.
#[test]
#[ignore = "ten seconds: many fits"]
fn other_laws_are_recognised() {
    let (samples, dt_s) = stepped(|d, _| 2e7 * d.max(0.0).powf(1.5), 60.0, 2.4146e-3);
    let found = drop_test(&samples, dt_s, &setup(true))
        .unwrap()
        .identified
        .unwrap();
    let ContactLaw::Power {
        coefficient_n_mn,
        exponent,
    } = found.law
    else {
        panic!("{found:?}")
    };
    assert!(
        (exponent - 1.5).abs() < 0.005 && (coefficient_n_mn / 2e7 - 1.0).abs() < 0.03,
        "{found:?}"
    );
    for zeta in [0.05, 0.15, 0.3] {
        let c = 2.0 * zeta * (STIFFNESS_N_M * MASS_KG).sqrt();
        let (samples, dt_s) = stepped(|d, v| STIFFNESS_N_M * d + c * v, 60.0, 1.2826e-3);
        let test = drop_test(&samples, dt_s, &setup(true)).unwrap();
        let found = test.identified.unwrap();
        assert_eq!(found.chosen, FittedLaw::KelvinVoigt);
        assert!(
            (found.damping_ratio / zeta - 1.0).abs() < 0.02,
            "{zeta}: {}",
            found.damping_ratio
        );
        assert!(
            (found.stiffness.fit_n_m / STIFFNESS_N_M - 1.0).abs() < 0.01,
            "{zeta}: {found:?}"
        );
        assert!(
            (found.exponent - 1.0).abs() < 0.03,
            "{zeta}: {}",
            found.exponent
        );
        assert!(test.restitution_ratio.unwrap() < 1.0 - zeta);
    }
    let (samples, dt_s) = stepped(
        |d, v| 2e7 * d.max(0.0).powf(1.5) * (1.0 + 0.3 * v),
        60.0,
        2.4146e-3,
    );
    let found = drop_test(&samples, dt_s, &setup(false))
        .unwrap()
        .identified
        .unwrap();
    let ContactLaw::HuntCrossley {
        exponent,
        dissipation_s_m,
        ..
    } = found.law
    else {
        panic!("{found:?}")
    };
    assert!(
        (exponent - 1.5).abs() < 0.01 && (dissipation_s_m / 0.3 - 1.0).abs() < 0.03,
        "{found:?}"
    );
}

/// Noise-free records of 50 samples per contact, for each law: the secant is recovered to 1e-3,
/// wherever the first contact falls between two samples. This is the documented accuracy, and the
/// lower limit of every interval.
#[test]
#[ignore = "seconds: several fits"]
fn clean_records_give_their_stiffness() {
    clean_records(0..1);
}

#[test]
#[ignore = "half a minute: 32 drops"]
fn clean_records_of_many_drops_give_their_stiffness() {
    clean_records(0..8);
}

fn clean_records(drops: Range<u64>) {
    let laws = [
        ContactLaw::Linear {
            stiffness_n_m: STIFFNESS_N_M,
        },
        ContactLaw::Power {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
        },
        ContactLaw::HuntCrossley {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
            dissipation_s_m: 0.3,
        },
        ContactLaw::KelvinVoigt {
            stiffness_n_m: STIFFNESS_N_M,
            damping_n_s_m: 0.2 * (STIFFNESS_N_M * MASS_KG).sqrt(),
        },
    ];
    for law in laws {
        let cushion = Cushion::new(law).unwrap();
        let deepest_m = cushion.deepest_of_fall();
        let truth_n_m = cushion.force_n(deepest_m, 0.0) / deepest_m;
        let contact_s = cushion.land(MASS_KG, fall_m_s()).duration_s;
        for index in drops.clone() {
            let sample_rate_hz = 50.0 / contact_s;
            let clean = VirtualDropOptions {
                noise_ratio: 0.0,
                sample_rate_hz,
                ..virtual_options(index)
            };
            let drop = virtual_drop(&cushion, &clean).unwrap();
            let found = drop_test(&drop.samples_m_s2, drop.dt_s, &setup(true))
                .unwrap()
                .identified
                .unwrap();
            let error = found.stiffness.fit_n_m / truth_n_m - 1.0;
            assert!(
                error.abs() < 1e-3,
                "{} {index}: {error}",
                cushion.law().name()
            );
        }
    }
}

fn noisy(samples: &[f64], noise_ratio: f64, seed: u64) -> Vec<f64> {
    let peak = samples.iter().copied().fold(0.0, f64::max);
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    samples
        .iter()
        .map(|a| a + noise_ratio * peak * normal())
        .collect()
}

/// The force of a damped pad jumps at first contact, and a sample may be on the jump, just before
/// it or just after it. Closed form, without weight: d = v₀/ω_d e^(−ζωt) sin ω_d t. Noise of 0.5 %
/// causes 0.3 % of k here; 1.5 % is five times that.
#[test]
#[ignore = "seconds: several fits"]
fn a_sample_may_lie_on_the_jump() {
    on_the_jump(0..1);
}

#[test]
#[ignore = "ten seconds: twenty drops"]
fn a_sample_may_lie_on_the_jump_under_any_noise() {
    on_the_jump(0..5);
}

fn on_the_jump(seeds: Range<u64>) {
    let (zeta, omega) = (0.1, (STIFFNESS_N_M / MASS_KG).sqrt());
    let damped = omega * (1.0_f64 - zeta * zeta).sqrt();
    let accel = |t: f64| {
        let d = fall_m_s() / damped * (-zeta * omega * t).exp() * (damped * t).sin();
        let v = fall_m_s()
            * (-zeta * omega * t).exp()
            * ((damped * t).cos() - zeta * omega / damped * (damped * t).sin());
        if t >= 0.0 && damped * t < PI {
            (omega * omega * d + 2.0 * zeta * omega * v).max(0.0)
        } else {
            0.0
        }
    };
    let dt_s = PI / omega / 50.0;
    let plain = DropSetup {
        gravity_m_s2: 0.0,
        ..setup(true)
    };
    for phase in [0.0, 1e-6, 0.25, 0.999] {
        let clean: Vec<f64> = (0..350)
            .map(|i| accel((f64::from(i) - 150.0 + phase) * dt_s))
            .collect();
        for seed in seeds.clone() {
            let test = drop_test(&noisy(&clean, 0.005, seed), dt_s, &plain).unwrap();
            assert_eq!(test.flags, [], "{phase} {seed}");
            let found = test.identified.unwrap();
            assert_eq!(found.chosen, FittedLaw::KelvinVoigt, "{phase} {seed}");
            assert!(
                (found.stiffness.fit_n_m / STIFFNESS_N_M - 1.0).abs() < 0.015,
                "{phase} {seed}: {found:?}"
            );
        }
    }
}

impl Cushion {
    /// The largest compression of the worked drop, with its weight.
    fn deepest_of_fall(&self) -> f64 {
        let history = self.landing_history(MASS_KG, fall_m_s(), G0_M_S2);
        history.iter().map(|p| p.compression_m).fold(0.0, f64::max)
    }
}

/// A pulse that rebounds faster than it arrived, fitted with a damped law: both damping values are
/// zero, and the record has a flag. The second half of the half-sine is 10 % higher: e = 1.1, ζ of
/// about −0.03.
#[test]
#[ignore = "seconds: several fits"]
fn negative_damping_is_none_and_flagged() {
    let omega = (STIFFNESS_N_M / MASS_KG).sqrt();
    let dt_s = PI / omega / 100.0;
    let pulse = |i: i32, gain: f64| {
        let angle = omega * (f64::from(i) - 300.3) * dt_s;
        let share = if angle > PI / 2.0 { gain } else { 1.0 };
        if angle > 0.0 && angle < PI {
            share * fall_m_s() * omega * angle.sin()
        } else {
            0.0
        }
    };
    let forced = DropSetup {
        law: Some(FittedLaw::KelvinVoigt),
        gravity_m_s2: 0.0,
        ..setup(true)
    };
    for (gain, is_flagged) in [(1.0, false), (1.1, true)] {
        let samples: Vec<f64> = (0..800).map(|i| pulse(i, gain)).collect();
        let test = drop_test(&samples, dt_s, &forced).unwrap();
        let found = test.identified.as_ref().unwrap();
        let ContactLaw::KelvinVoigt { damping_n_s_m, .. } = found.law else {
            panic!("{found:?}")
        };
        assert_eq!(
            test.flags.contains(&Flag::Damping),
            is_flagged,
            "{:?}",
            test.flags
        );
        assert_eq!(found.damping_ratio == 0.0, damping_n_s_m == 0.0);
        assert!(
            found.damping_ratio >= 0.0 && found.damping_ratio < 1e-3,
            "{}",
            found.damping_ratio
        );
    }
}

/// A pad with F = Kd² rises below the noise for a large part of the contact, which is hundreds of
/// samples of a fast recorder. d = (3mv₀²/(2K))^⅓ = 1.0240 mm, so F/d = 1.0240e6 (gravity adds 0.06
/// %); four times the error of the fit itself is 2 %.
#[test]
#[ignore = "seconds: two drops of a thousand samples"]
fn a_long_toe_is_followed() {
    let (clean, dt_s) = stepped(|d, _| 1e9 * d.max(0.0).powi(2), 1000.0, 2.0505e-3);
    for seed in 0..2 {
        let found = drop_test(&noisy(&clean, 0.01, seed), dt_s, &setup(true))
            .unwrap()
            .identified
            .unwrap();
        assert!(
            (found.stiffness.fit_n_m / 1.0240e6 - 1.0).abs() < 0.02,
            "{seed}: {found:?}"
        );
        assert!(
            (found.exponent - 2.0).abs() < 0.05,
            "{seed}: {}",
            found.exponent
        );
    }
}

fn flags_of(samples: &[f64], dt_s: f64) -> Vec<Flag> {
    let test = drop_test(samples, dt_s, &setup(true)).unwrap();
    let fatal = [Flag::ZeroShift, Flag::Drift];
    assert!(
        test.identified.is_none() || test.flags.iter().any(|flag| fatal.contains(flag)),
        "{:?}",
        test.flags
    );
    test.flags
}

/// A record that cannot give a stiffness is flagged.
#[test]
#[ignore = "seconds: several fits"]
fn faults_are_flagged() {
    for noise in [0.0, 0.005] {
        let (clean, dt_s) = half_sine(50.0, noise, 0.3, 7, STIFFNESS_N_M);
        let peak = clean.iter().copied().fold(0.0, f64::max);
        for share in [0.98, 0.9, 0.6] {
            let clipped: Vec<f64> = clean.iter().map(|a| a.min(share * peak)).collect();
            assert!(
                flags_of(&clipped, dt_s).contains(&Flag::Clipped),
                "{noise} {share}"
            );
        }
        let shifted: Vec<f64> = clean
            .iter()
            .enumerate()
            .map(|(i, a)| a + if i > 125 { 0.02 * peak } else { 0.0 })
            .collect();
        assert!(
            flags_of(&shifted, dt_s).contains(&Flag::ZeroShift),
            "{noise}"
        );
        let drifting: Vec<f64> = clean
            .iter()
            .enumerate()
            .map(|(i, a)| a + 0.1 * peak * i as f64 / 300.0)
            .collect();
        assert!(flags_of(&drifting, dt_s).contains(&Flag::Drift), "{noise}");
        let down: Vec<f64> = clean.iter().map(|a| -a).collect();
        assert_eq!(flags_of(&down, dt_s), [Flag::UpsideDown]);
        assert_eq!(flags_of(&clean[97..], dt_s), [Flag::NoPreTrigger]);
        assert_eq!(flags_of(&clean[120..], dt_s), [Flag::NoPreTrigger]);
        assert_eq!(flags_of(&clean[101..149], dt_s), [Flag::NoPreTrigger]);
        assert!(flags_of(&clean[..130], dt_s).contains(&Flag::CutOff));
        // Values in cm/s² read as m/s².
        let other: Vec<f64> = clean.iter().map(|a| 100.0 * a).collect();
        assert!(flags_of(&other, dt_s).contains(&Flag::Impulse));
        let (coarse, dt_s) = half_sine(8.0, noise, 0.3, 7, STIFFNESS_N_M);
        let coarse: Vec<f64> = vec![G0_M_S2; 20].into_iter().chain(coarse).collect();
        assert!(
            flags_of(&coarse, dt_s).contains(&Flag::FewSamples),
            "{noise}"
        );
    }
    assert_eq!(flags_of(&[0.0; 100], 1e-5), [Flag::NoPulse]);
}

/// Noise of 5 % on a fast record crosses every threshold many times on a flank. The peak alone is
/// only as accurate as its noise; the 1000 samples give 5 %/√1000 = 0.2 %, and the correlation of k
/// with first contact and zero line no more than five times that.
#[test]
fn noisy_flanks_are_one_pulse() {
    noisy_flanks(&[(200.0, 1)]);
}

#[test]
#[ignore = "seconds: two drops of a thousand samples"]
fn noisy_flanks_of_many_samples_are_one_pulse() {
    noisy_flanks(&[(200.0, 1), (200.0, 2), (1000.0, 1), (1000.0, 2)]);
}

fn noisy_flanks(drops: &[(f64, u64)]) {
    for &(per_contact, seed) in drops {
        let (samples, dt_s) = half_sine(per_contact, 0.05, 0.3, seed, STIFFNESS_N_M);
        let test = drop_test(&samples, dt_s, &setup(true)).unwrap();
        assert_eq!(test.flags, [], "{per_contact} {seed}");
        let error = test.identified.unwrap().stiffness.fit_n_m / STIFFNESS_N_M - 1.0;
        assert!(
            error.abs() < if per_contact > 500.0 { 0.01 } else { 0.025 },
            "{per_contact} {seed}: {error}"
        );
    }
}

/// A zero line that is higher after the impact still ends the pulse, and a record that ends on the
/// flank is flagged as cut off.
#[test]
#[ignore = "seconds: several fits"]
fn a_shifted_zero_line_is_no_missing_end() {
    for (per_contact, shift) in [(50.0, 0.03), (50.0, 0.06), (200.0, 0.03), (200.0, 0.08)] {
        let (samples, dt_s) = half_sine(per_contact, 0.005, 0.3, 3, STIFFNESS_N_M);
        let peak = samples.iter().copied().fold(0.0, f64::max);
        let top = (2.5 * per_contact) as usize;
        let shifted: Vec<f64> = samples
            .iter()
            .enumerate()
            .map(|(i, a)| a + if i > top { shift * peak } else { 0.0 })
            .collect();
        let flags = drop_test(&shifted, dt_s, &setup(true)).unwrap().flags;
        assert!(
            flags.contains(&Flag::ZeroShift) && !flags.contains(&Flag::CutOff),
            "{per_contact} {shift}: {flags:?}"
        );
        assert!(
            !flags.contains(&Flag::Impulse),
            "{per_contact} {shift}: {flags:?}"
        );
        let cut = drop_test(
            &samples[..(2.96 * per_contact) as usize],
            dt_s,
            &setup(true),
        )
        .unwrap();
        assert!(
            cut.flags.contains(&Flag::CutOff),
            "{per_contact}: {:?}",
            cut.flags
        );
    }
}

/// A top that was clipped before the noise was added has no equal samples, but no law fits it
/// either.
#[test]
#[ignore = "seconds: several fits"]
fn a_clipped_top_under_noise_is_no_law() {
    clipped_tops(&[50.0], 0..1);
}

#[test]
#[ignore = "half a minute: 24 drops"]
fn a_clipped_top_under_any_noise_is_no_law() {
    clipped_tops(&[50.0, 200.0], 0..3);
}

fn clipped_tops(per_contacts: &[f64], seeds: Range<u64>) {
    for &per_contact in per_contacts {
        for (share, noise) in [(0.9, 0.002), (0.9, 0.005), (0.9, 0.01), (0.95, 0.005)] {
            let (clean, dt_s) = half_sine(per_contact, 0.0, 0.3, 1, STIFFNESS_N_M);
            let peak = clean.iter().copied().fold(0.0, f64::max);
            let clipped: Vec<f64> = clean.iter().map(|a| a.min(share * peak)).collect();
            for seed in seeds.clone() {
                let test = drop_test(&noisy(&clipped, noise, seed), dt_s, &setup(true)).unwrap();
                let is_told = test
                    .flags
                    .iter()
                    .any(|flag| matches!(flag, Flag::Clipped | Flag::PoorFit));
                assert!(
                    is_told,
                    "{per_contact} {share} {noise} {seed}: {:?}",
                    test.flags
                );
            }
        }
    }
}

/// A sensor that measures gravity reads 1 g while the mass is held and nothing while it falls: the
/// zero line is that of the fall.
#[test]
fn the_mass_may_have_been_held_before() {
    let (samples, dt_s) = half_sine(50.0, 0.002, 0.3, 1, STIFFNESS_N_M);
    let fall = std::iter::repeat_n(0.0, 1500);
    let held: Vec<f64> = std::iter::repeat_n(G0_M_S2, 4000)
        .chain(fall)
        .chain(samples.iter().map(|a| a - G0_M_S2))
        .collect();
    // Noise everywhere, as in the record of a sensor.
    let mut random = ChaCha12Rng::seed_from_u64(5);
    let noisy = held.iter().map(|a| {
        let normal: f64 = StandardNormal.sample(&mut random);
        a + 5.0 * normal
    });
    let test = drop_test(&noisy.collect::<Vec<_>>(), dt_s, &setup(true)).unwrap();
    assert_eq!(test.flags, []);
    assert!((test.identified.unwrap().stiffness.fit_n_m / STIFFNESS_N_M - 1.0).abs() < 0.02);
}

/// A slow drift over a long record, 5 % of the peak in 100 contacts, is flagged although the
/// contact is hardly affected.
#[test]
fn a_slow_drift_is_flagged() {
    let (samples, dt_s) = half_sine(50.0, 0.002, 0.3, 1, STIFFNESS_N_M);
    let peak = 349.8 * G0_M_S2;
    let noisy = half_sine(800.0, 0.002, 0.3, 2, STIFFNESS_N_M).0;
    let quiet = noisy.iter().take(1500).copied().cycle().take(5000);
    let long = quiet
        .chain(samples)
        .enumerate()
        .map(|(i, a)| a + 0.05 * peak * i as f64 / 5300.0);
    let flags = drop_test(&long.collect::<Vec<_>>(), dt_s, &setup(true))
        .unwrap()
        .flags;
    assert!(flags.contains(&Flag::Drift), "{flags:?}");
}

/// Rounding to whole g makes the top flat over a few samples, which is not clipping.
#[test]
#[ignore = "seconds: several fits"]
fn rounded_samples_are_not_clipped() {
    for digit in [0.01, 0.1, 1.0] {
        let (samples, dt_s) = half_sine(200.0, 0.0, 0.3, 1, STIFFNESS_N_M);
        let rounded: Vec<f64> = samples
            .iter()
            .map(|a| (a / G0_M_S2 / digit).round() * digit * G0_M_S2)
            .collect();
        assert_eq!(
            drop_test(&rounded, dt_s, &setup(true)).unwrap().flags,
            [],
            "{digit}"
        );
    }
}

pub(super) fn virtual_options(index: u64) -> VirtualDropOptions {
    VirtualDropOptions {
        mass_kg: MASS_KG,
        speed_m_s: fall_m_s(),
        gravity_m_s2: G0_M_S2,
        sample_rate_hz: 40e3,
        pre_trigger_s: 3e-3,
        after_s: 5e-3,
        noise_ratio: 0.01,
        bias_m_s2: G0_M_S2,
        zero_shift_ratio: 0.0,
        filter_corner_hz: None,
        bounces: 0,
        speed_error_ratio: 0.0,
        seed: 3,
        index,
    }
}

/// A record longer than any integer is refused.
#[test]
fn endless_records_are_refused() {
    let pad = Cushion::linear(STIFFNESS_N_M).unwrap();
    let plain = virtual_options(0);
    assert_eq!(
        virtual_drop(
            &pad,
            &VirtualDropOptions {
                pre_trigger_s: 1e30,
                ..plain
            }
        ),
        None
    );
    assert_eq!(
        virtual_drop(
            &pad,
            &VirtualDropOptions {
                sample_rate_hz: 1e40,
                ..plain
            }
        ),
        None
    );
    assert_eq!(
        virtual_drop(
            &pad,
            &VirtualDropOptions {
                after_s: f64::NAN,
                ..plain
            }
        ),
        None
    );
}

/// Student's t of 3 drops is 4.303, and the factor √(n/(n−1)) of the bootstrap turns it into the
/// usual standard error s/√n.
#[test]
fn pooled_drops_have_the_interval_of_student() {
    let drops = [2.0e6, 2.2e6, 2.1e6].map(|k| PooledDrop {
        stiffness_n_m: k,
        error_ratio: 1e-4,
        exponent: 1.0,
    });
    let pooled = pool_drops(&drops, 1).unwrap();
    let logs = drops.map(|drop| drop.stiffness_n_m.ln());
    let mean = logs.iter().sum::<f64>() / 3.0;
    let error = (logs.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 2.0 / 3.0).sqrt();
    assert!((pooled.stiffness_n_m.ln() - mean).abs() < 1e-6);
    // 2000 resamples: 1.6 % of the standard deviation; five times that.
    let half = pooled.ci95_n_m.1.ln() - mean;
    assert!(
        (half / (4.302_653 * error) - 1.0).abs() < 0.08,
        "{half} {error}"
    );
    assert_eq!(pool_drops(&[], 1), None);
    assert_eq!(
        pool_drops(&drops, 9).unwrap().stiffness_n_m,
        pooled.stiffness_n_m
    );
}

proptest::proptest! {
    /// Every record has a result: finite numbers, or a flag that says why there are none. Pulses of
    /// any width and position, several of them, plateaus, steps, huge and tiny values.
    #[test]
    #[ignore = "ten seconds: many fits"]
    fn every_record_has_an_answer(
        length in 20..300usize,
        pulses in proptest::collection::vec((0.0..1.0f64, 0.5..80.0f64, -2.0..2.0f64, proptest::bool::ANY), 0..4),
        scale in proptest::sample::select(vec![1e-300, 1e-9, 1.0, 3e3, 1e9, 1e150]),
        noise in proptest::sample::select(vec![0.0, 1e-4, 0.05]),
        top in 0.2..3.0f64,
        known in proptest::bool::ANY,
    ) {
        let samples: Vec<f64> = (0..length)
            .map(|i| {
                let x = i as f64;
                let sum: f64 = pulses
                    .iter()
                    .map(|&(place, width, height, is_step)| {
                        let s = (x - place * length as f64) / width;
                        if is_step { if s > 0.0 { height } else { 0.0 } } else { height * (-s * s).exp() }
                    })
                    .sum();
                scale * (sum + noise * (x * x * 0.7).sin()).min(top)
            })
            .collect();
        let test = drop_test(&samples, 2e-5, &setup(known)).unwrap();
        if let Some(found) = &test.identified {
            proptest::prop_assert!(found.stiffness.fit_n_m > 0.0 && found.stiffness.fit_n_m.is_finite());
            proptest::prop_assert!(found.error_ratio.is_finite() && found.exponent.is_finite());
            proptest::prop_assert!(test.max_compression_m.is_some_and(|d| d > 0.0 && d.is_finite()));
            proptest::prop_assert!(test.restitution_ratio.is_none_or(|e| e.is_finite() && e <= 1.0));
        } else {
            proptest::prop_assert!(!test.flags.is_empty());
        }
        let drops = drop_tests(&samples, 2e-5, &setup(known)).unwrap();
        proptest::prop_assert!(!drops.is_empty());
        proptest::prop_assert!(drops.windows(2).all(|pair| pair[0].start_time_s < pair[1].start_time_s));
    }
}
