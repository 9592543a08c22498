use super::*;
use crate::G0_M_S2;
use crate::code_spectrum::{As1170_4, Edition, SiteClass};
use crate::measures::{Integrals, integrals};
use crate::oscillator::response_spectrum;

fn melbourne_de(period_s: f64) -> f64 {
    As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)
        .unwrap()
        .sa_g(period_s)
}

fn motion(index: u64) -> MatchedMotion {
    synthesize(melbourne_de, 1, index, &SynthesisOptions::default()).unwrap()
}

#[test]
fn the_misfit_is_that_of_the_motion_that_is_returned() {
    let MatchedMotion { motion, misfit, .. } = motion(0);
    let spectrum = response_spectrum(&motion, DAMPING_RATIO, &matched_periods_s()).unwrap();
    let errors: Vec<f64> = spectrum
        .periods_s
        .iter()
        .zip(&spectrum.psa_m_s2)
        .map(|(&t, psa)| psa / (melbourne_de(t) * G0_M_S2) - 1.0)
        .collect();
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    // The same peaks to the digits below, multiplied in another order, and once through ln and exp.
    assert!((misfit.rms_ratio - rms).abs() < 2.5e-12);
    let worst = errors.iter().map(|e| e.abs()).fold(0.0, f64::max);
    // The recurrence of the passes loses 1e-16 (T/2π dt)² of a peak in a step: 2.5e-12 at 5 s.
    assert!((misfit.worst_ratio.abs() - worst).abs() < 2.5e-12);
    let at = matched_periods_s()
        .iter()
        .position(|&t| t == misfit.worst_period_s)
        .unwrap();
    assert_eq!(errors[at].abs(), worst);
    assert!((misfit.target_zpa_g - 0.088).abs() < 1e-15);
    assert_eq!(misfit.pga_g, motion.peak_m_s2() / G0_M_S2);
}

#[test]
fn motions_fit_and_have_the_pga_that_the_shape_of_class_de_forces() {
    for index in 0..3 {
        let misfit = motion(index).misfit;
        // The goal is 5 %; the ten motions of the module's table are at 2.6 to 4.0 %.
        assert!(misfit.rms_ratio < 0.05, "{misfit:?}");
        // Broad-band motions amplify by at most 2.71 in 84 of 100 cases (Newmark and Hall, 5 %), so
        // the plateau of 0.2944 g requires a PGA of 0.109 g rather than 0.088 g; and an oscillator
        // of 0.05 s nearly follows the ground.
        assert!(
            misfit.pga_g > 0.2944 / 2.71 && misfit.pga_g < melbourne_de(0.05),
            "{misfit:?}"
        );
    }
}

#[test]
fn a_motion_starts_and_ends_at_rest_after_quiet() {
    let MatchedMotion { motion, .. } = motion(4);
    let accel = motion.accel_m_s2();
    assert_eq!(motion.duration_s(), 45.0);
    assert!(
        accel[..=200]
            .iter()
            .chain(&accel[8200..])
            .all(|&a| a == 0.0)
    );
    let Integrals {
        velocity_m_s: velocity,
        displacement_m: displacement,
    } = integrals(&motion);
    let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
    // 9000 additions of numbers up to the peak, ε each, and 45 s of the velocity's error in the
    // displacement.
    assert!(velocity[9000].abs() < 9000.0 * f64::EPSILON * peak(&velocity));
    assert!(
        displacement[9000].abs()
            < 45.0 * 9000.0 * f64::EPSILON * (peak(&velocity) + peak(&displacement))
    );
    // No drift: within three times the 59 mm of the spectrum. Without the low cut ten motions had
    // 0.28 m on average.
    assert!(peak(&displacement) < 3.0 * 0.059, "{}", peak(&displacement));
}

#[test]
fn a_motion_is_its_seed_and_index() {
    assert_eq!(motion(2), motion(2));
    let other_seed = synthesize(melbourne_de, 2, 2, &SynthesisOptions::default()).unwrap();
    for other in [motion(3), other_seed] {
        let (a, b) = (motion(2).motion, other.motion);
        let product = |a: &Motion, b: &Motion| -> f64 {
            a.accel_m_s2()
                .iter()
                .zip(b.accel_m_s2())
                .map(|(a, b)| a * b)
                .sum()
        };
        let correlation = product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt();
        // Independent narrow-band noise worth about 11 s · 10 Hz = 100 samples: a standard
        // deviation of 0.1.
        assert!(correlation.abs() < 0.4, "{correlation}");
    }
}

#[test]
fn a_record_is_matched_with_its_own_step() {
    // The motion of rock, every second sample, matched to the spectrum of deep soil.
    let rock = As1170_4::new(Edition::default(), SiteClass::Be, 0.08, 500).unwrap();
    let rock = synthesize(|t| rock.sa_g(t), 1, 0, &SynthesisOptions::default())
        .unwrap()
        .motion;
    let record = Motion::new(0.01, rock.accel_m_s2().iter().copied().step_by(2).collect()).unwrap();
    let unmatched = match_motion(&record, melbourne_de, 0).unwrap();
    let matched = match_motion(&record, melbourne_de, 30).unwrap();
    assert_eq!((unmatched.pass, matched.motion.dt_s()), (0, 0.01));
    assert_eq!(matched.motion.accel_m_s2().len(), record.accel_m_s2().len());
    assert!(
        matched.misfit.rms_ratio < 0.05 && unmatched.misfit.rms_ratio > 0.2,
        "{matched:?}"
    );
}

#[test]
fn a_coarse_record_is_matched_between_its_samples_too() {
    // Every fourth sample of a motion, 0.02 s apart, matched to another spectrum; then the spectrum
    // of the match with its straight lines cut into steps of 0.002 s, from the oscillators of the
    // library.
    let rock = As1170_4::new(Edition::default(), SiteClass::Be, 0.08, 500).unwrap();
    let rock = synthesize(|t| rock.sa_g(t), 1, 0, &SynthesisOptions::default())
        .unwrap()
        .motion;
    let record = Motion::new(0.02, rock.accel_m_s2().iter().copied().step_by(4).collect()).unwrap();
    let MatchedMotion {
        motion: matched,
        misfit: said,
        ..
    } = match_by_wavelets(&record, melbourne_de, 30).unwrap();
    let accel = matched.accel_m_s2();
    let fine = (0..10 * (accel.len() - 1)).map(|k| {
        let (a, b) = (accel[k / 10], accel[k / 10 + 1]);
        a + (b - a) * (k % 10) as f64 / 10.0
    });
    let fine = Motion::new(0.002, fine.collect()).unwrap();
    let spectrum = response_spectrum(&fine, DAMPING_RATIO, &matched_periods_s()).unwrap();
    let errors = |spectrum: &crate::oscillator::ResponseSpectrum| -> Vec<f64> {
        let psa = spectrum.periods_s.iter().zip(&spectrum.psa_m_s2);
        psa.map(|(&t, psa)| psa / (melbourne_de(t) * G0_M_S2) - 1.0)
            .collect()
    };
    let rms =
        |errors: &[f64]| (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let between = errors(&spectrum);
    // A peak between two samples is missed by at most 1 − cos(ω dt/2): 5 % at T = 0.05 s and
    // 0.005 s, 1.2 % at 0.1 s, and much less over all periods.
    assert!(
        (said.rms_ratio - rms(&between)).abs() < 0.005,
        "{said:?} {}",
        rms(&between)
    );
    assert!(
        rms(&between) < 0.06 && between.iter().all(|error| error.abs() < 0.2),
        "{}",
        rms(&between)
    );
    // The samples alone give another result: 1 − cos(ω dt/2) at 0.05 s and 0.02 s is 0.69.
    let at_samples =
        errors(&response_spectrum(&matched, DAMPING_RATIO, &matched_periods_s()).unwrap());
    assert!(
        at_samples[0] < between[0] - 0.03,
        "{} {}",
        at_samples[0],
        between[0]
    );
}

#[test]
#[ignore = "seconds: motions of every class of soil"]
fn every_class_fits_with_every_seed() {
    for site in SiteClass::ALL {
        let code = As1170_4::new(Edition::default(), site, 0.08, 500).unwrap();
        for seed in 1..=10 {
            let misfit = synthesize(|t| code.sa_g(t), seed, 0, &SynthesisOptions::default())
                .unwrap()
                .misfit;
            // The goal that the documentation states.
            assert!(
                misfit.rms_ratio < 0.05,
                "{} {seed}: {misfit:?}",
                site.name()
            );
        }
    }
}

#[test]
fn other_last_digits_of_a_machine_do_not_change_a_matched_record() {
    for index in 0..3 {
        let mut disturbance = noise(97, index);
        let mut wobble = move || 1.0 + 1e-15 * disturbance();
        let factors: Vec<f64> = (0..1000).map(|_| wobble()).collect();
        let target = |t: f64| melbourne_de(t) * factors[(t * 150.0) as usize];
        let plain = match_by_wavelets(&record(), melbourne_de, 30).unwrap();
        let accel = record().accel_m_s2().iter().map(|a| a * wobble()).collect();
        let nudged = match_by_wavelets(&Motion::new(0.01, accel).unwrap(), target, 30).unwrap();
        assert_eq!(nudged.pass, plain.pass);
        let change = change(&plain.motion, &nudged.motion);
        assert!(change > 0.0 && change < 1e-9, "{change}");
    }
}

#[test]
fn what_cannot_be_matched_is_refused() {
    let fine = SynthesisOptions::default();
    let refused = |options: SynthesisOptions| match synthesize(melbourne_de, 1, 0, &options) {
        Err(SynthesisError::Option { parameter, .. }) => parameter.name(),
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(SynthesisOptions { dt_s: 0.02, ..fine }), "dt_s");
    assert_eq!(
        refused(SynthesisOptions {
            lead_in_s: f64::NAN,
            ..fine
        }),
        "lead_in_s"
    );
    assert_eq!(
        refused(SynthesisOptions {
            shaking_s: 9.0,
            ..fine
        }),
        "shaking_s"
    );
    assert_eq!(
        refused(SynthesisOptions {
            tail_s: -1.0,
            ..fine
        }),
        "tail_s"
    );
    assert_eq!(
        refused(SynthesisOptions {
            envelope_s: 0.0,
            ..fine
        }),
        "envelope_s"
    );
    assert_eq!(
        refused(SynthesisOptions {
            tail_s: 1e9,
            ..fine
        }),
        "the number of samples"
    );
    let target = synthesize(|t| 1.0 - t, 1, 0, &fine);
    assert!(
        matches!(target, Err(SynthesisError::Target { period_s, .. }) if period_s >= 1.0),
        "{target:?}"
    );
    let zeros = Motion::new(0.01, vec![0.0; 2000]).unwrap();
    assert_eq!(
        match_motion(&zeros, melbourne_de, 5),
        Err(SynthesisError::NoContent)
    );
    let short = Motion::new(0.01, vec![1.0; 200]).unwrap();
    assert!(matches!(
        match_motion(&short, melbourne_de, 5),
        Err(SynthesisError::TooShort { .. })
    ));
}

/// Relative change of a motion: largest difference over the peak.
fn change(one: &Motion, other: &Motion) -> f64 {
    let difference = one
        .accel_m_s2()
        .iter()
        .zip(other.accel_m_s2())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    difference / one.peak_m_s2()
}

#[test]
fn other_last_digits_of_a_machine_do_not_change_a_motion() {
    // The differences between mathematical libraries, an ulp or two: in the noise and its window,
    // in the step, and through the target in the logarithm and the gain of every period in every
    // pass.
    for index in 0..10 {
        let mut disturbance = noise(99, index);
        let mut wobble = move || 1.0 + 1e-15 * disturbance();
        let factors: Vec<f64> = (0..1000).map(|_| wobble()).collect();
        let target = |t: f64| melbourne_de(t) * factors[(t * 150.0) as usize];
        let mut numbers = noise(1, index);
        let nudged = from_noise(
            target,
            || numbers() * wobble(),
            &SynthesisOptions::default(),
        )
        .unwrap();
        let plain = motion(index);
        assert_eq!(nudged.pass, plain.pass);
        assert!(change(&plain.motion, &nudged.motion) < 1e-9);
    }
}

/// The state of rest at the end of a motion: final velocity and displacement are zero up to
/// rounding.
fn assert_ends_at_rest(motion: &Motion) {
    let accel = motion.accel_m_s2();
    let Integrals {
        velocity_m_s: velocity,
        displacement_m: displacement,
    } = integrals(motion);
    let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
    let (n, last) = (accel.len() as f64, accel.len() - 1);
    // n additions of numbers up to the peak, ε each, and the length times the error of the
    // velocity.
    assert!(
        velocity[last].abs() < n * f64::EPSILON * peak(&velocity),
        "{}",
        velocity[last]
    );
    let bound = motion.duration_s() * n * f64::EPSILON * (peak(&velocity) + peak(&displacement));
    assert!(displacement[last].abs() < bound, "{}", displacement[last]);
}

/// A record with distinctive features: two bursts and a pulse, 20 s at 0.01 s, not at rest at its
/// end.
fn record() -> Motion {
    let mut numbers = noise(5, 0);
    let accel = (0..2000).map(|k| {
        let t = 0.01 * f64::from(k);
        let bursts = Window::Lam.at((t - 2.0) / 3.0) + 0.5 * Window::Lam.at((t - 10.0) / 2.0);
        3.0 * bursts * numbers() + 0.5 * (-((t - 4.0) / 0.8).powi(2)).exp() * (3.0 * t).sin() + 0.01
    });
    Motion::new(0.01, accel.collect()).unwrap()
}

#[test]
fn wavelets_match_a_record_and_keep_its_character() {
    let record = record();
    let wavelets = match_by_wavelets(&record, melbourne_de, 30).unwrap();
    let fourier = match_motion(&record, melbourne_de, 30).unwrap();
    let kept = |matched: &MatchedMotion| Resemblance::between(&record, &matched.motion);
    // The goal is 5 %; for a record with a gap and a pulse both methods reach 3 %.
    assert!(
        wavelets.misfit.rms_ratio < 0.05
            && wavelets.misfit.rms_ratio < 1.2 * fourier.misfit.rms_ratio
    );
    // Broader gains without a low cut preserve more of the record: its samples, and the times at
    // which its energy arrives.
    let (by_wavelets, by_fourier) = (kept(&wavelets), kept(&fourier));
    assert!(
        by_wavelets.correlation_ratio > by_fourier.correlation_ratio
            && by_wavelets.correlation_ratio > 0.6
    );
    assert!(by_wavelets.husid_difference_ratio < by_fourier.husid_difference_ratio);
    assert_ends_at_rest(&wavelets.motion);
    assert_ends_at_rest(&fourier.motion);
}

#[test]
fn a_peak_is_met_and_its_cost_is_told() {
    let before = motion(0);
    let after = with_pga(&before.motion, melbourne_de, 0.088).unwrap();
    assert!((after.misfit.pga_g / 0.088 - 1.0).abs() < 1e-3);
    assert!(after.misfit.rms_ratio > before.misfit.rms_ratio);
    assert_ends_at_rest(&after.motion);
    let raised = with_pga(&before.motion, melbourne_de, 0.2).unwrap();
    assert!((raised.misfit.pga_g / 0.2 - 1.0).abs() < 1e-3);
    assert_ends_at_rest(&raised.motion);
    // The quiet before and after is preserved.
    let accel = after.motion.accel_m_s2();
    assert!(
        accel[..=200]
            .iter()
            .chain(&accel[8200..])
            .all(|&a| a == 0.0)
    );
    let refused = with_pga(&before.motion, melbourne_de, 0.0);
    assert!(matches!(
        refused,
        Err(SynthesisError::Option {
            parameter: Parameter::Other("pga_g"),
            ..
        })
    ));
}

#[test]
fn motions_of_all_layouts_end_at_rest() {
    for (index, (dt_s, lead_in_s, shaking_s, tail_s, envelope_s)) in [
        (0.01, 0.0, 10.0, 0.0, 1.0),
        (0.005, 0.3, 25.0, 7.0, 4.0),
        (0.0025, 2.0, 60.0, 30.0, 20.0),
    ]
    .into_iter()
    .enumerate()
    {
        let options = SynthesisOptions {
            dt_s,
            lead_in_s,
            shaking_s,
            tail_s,
            envelope_s,
            passes: 5,
        };
        assert_ends_at_rest(
            &synthesize(melbourne_de, 7, index as u64, &options)
                .unwrap()
                .motion,
        );
    }
}
