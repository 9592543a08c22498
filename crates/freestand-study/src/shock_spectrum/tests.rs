use super::*;
use crate::recorded::{MotionFiles, read_recorded};
use freestand_output::answer::Answer;
use freestand_records::formats::ReadOptions;
use freestand_records::processing::Processing;

/// A half-sine of 40 g and 2 ms at 100 kHz, as a drop test writes it.
fn drop_file(folder: &std::path::Path) -> std::path::PathBuf {
    let mut text = "time [ms],acceleration [g]\n".to_owned();
    for k in 0..1000 {
        let t_ms = 0.01 * f64::from(k);
        let inside = (1.0..=3.0).contains(&t_ms);
        let a = if inside {
            40.0 * (PI * (t_ms - 1.0) / 2.0).sin()
        } else {
            0.0
        };
        text += &format!("{t_ms:.2},{a:.9}\n");
    }
    let path = folder.join("drop.csv");
    std::fs::write(&path, text).unwrap();
    path
}

fn request(kind: ResponseKind, frequencies_hz: Vec<f64>) -> ShockSpectrumRequest {
    ShockSpectrumRequest {
        kind,
        peak: Peak::Maximax,
        damping_ratio: 0.05,
        frequencies_hz,
        upsample: true,
    }
}

fn read(path: std::path::PathBuf) -> Vec<ReadMotion> {
    let files = MotionFiles {
        paths: vec![path],
        read: ReadOptions {
            is_shock: true,
            ..ReadOptions::default()
        },
        component: None,
        second: crate::recorded::Second::None,
        vertical: Default::default(),
        processing: Processing::default(),
    };
    let (motions, failures) = read_recorded(&files);
    assert!(failures.is_empty(), "{failures:?}");
    motions
}

#[test]
fn a_drop_test_keeps_its_unit_and_has_the_known_spectrum() {
    let folder = tempfile::tempdir().unwrap();
    let motions = read(drop_file(folder.path()));
    let report = recorded_shock_spectra(
        &motions,
        &request(
            ResponseKind::AbsoluteAcceleration,
            vec![125.0, 250.0, 500.0, 1000.0],
        ),
        || Ok(()),
    )
    .unwrap();
    let one = &report.spectra[0];
    assert_eq!(
        (
            one.unit,
            one.samples,
            report.facts().number("quality_factor_ratio")
        ),
        ("g", Some(1000), Some(10.0))
    );
    for (value, expected) in one.values.iter().zip([0.87808, 1.46264, 1.62379, 1.21237]) {
        // The kinks of the pulse lie on samples of 1/200 of it; the band-limited curve rounds them
        // by 1e-4.
        assert!((value / 40.0 - expected).abs() < 3e-4, "{value} {expected}");
    }
    let pulse = one.enveloping_half_sine.as_ref().unwrap();
    let peak_g = pulse.size.peak_acceleration_g;
    assert!((40.0 * 0.999..60.0).contains(&peak_g), "{peak_g}");
    let displacement = recorded_shock_spectra(
        &motions,
        &request(ResponseKind::RelativeDisplacement, vec![100.0]),
        || Ok(()),
    )
    .unwrap();
    assert_eq!(
        (
            displacement.spectra[0].unit,
            &displacement.spectra[0].enveloping_half_sine
        ),
        ("m", &None)
    );
    let table = displacement.table().unwrap().to_string();
    assert!(table.starts_with(
        "name,frequency_hz,absolute_acceleration_g,absolute_acceleration_m_s2,relative_displacement_m,pseudo_velocity_m_s\ndrop,100,,,"
    ));
}

#[test]
fn a_pulse_is_in_the_unit_it_was_given_in() {
    let pulse = Pulse::new(PulseShape::HalfSine, 30.0 * G0_M_S2, 0.011).unwrap();
    let request = request(ResponseKind::AbsoluteAcceleration, vec![1.0 / 0.011]);
    let report =
        pulse_shock_spectrum(&pulse, acceleration_unit("30 g"), &request, || Ok(())).unwrap();
    assert!((report.spectra[0].values[0] / 30.0 - 1.62379).abs() < 1e-5);
    assert_eq!(
        (report.spectra[0].path.as_deref(), report.spectra[0].unit),
        (None, "g")
    );
    assert_eq!(
        ["294.2 m/s²", "3e4mm/s2", "1.5"].map(acceleration_unit),
        ["m/s2", "mm/s2", "m/s2"]
    );
}

#[test]
fn what_the_record_does_not_hold_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let motions = read(drop_file(folder.path()));
    let with = |f: f64, upsample: bool| {
        let request = ShockSpectrumRequest {
            upsample,
            ..request(ResponseKind::default(), vec![f])
        };
        recorded_shock_spectra(&motions, &request, || Ok(()))
            .unwrap()
            .doubts
    };
    // 40 g are no fault of a drop test.
    assert!(with(1e4, true).is_empty(), "{:?}", with(1e4, true));
    let has = |all: &[MotionDoubt], part: &str| {
        all.iter()
            .any(|one| matches!(one, MotionDoubt::OfRecords(words) if words.contains(part)))
    };
    assert!(
        has(&with(60e3, true), "half its sampling rate, 50000 Hz"),
        "{:?}",
        with(60e3, true)
    );
    assert!(
        has(&with(20e3, false), "19 % too low"),
        "{:?}",
        with(20e3, false)
    );
    let wrong = ShockSpectrumRequest {
        damping_ratio: 1.5,
        ..request(ResponseKind::default(), vec![1.0])
    };
    assert!(
        recorded_shock_spectra(&motions, &wrong, || Ok(()))
            .unwrap_err()
            .hint
            .is_some()
    );
}

/// It is asked between groups of frequencies, and the groups change no number.
#[test]
fn many_frequencies_can_be_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let motions = read(drop_file(folder.path()));
    let frequencies: Vec<f64> = (0..GROUP + 2).map(|i| 10.0 + i as f64 * 0.01).collect();
    let all = request(ResponseKind::RelativeDisplacement, frequencies.clone());
    let asked = std::cell::Cell::new(0);
    let until = |most: usize| {
        asked.set(0);
        recorded_shock_spectra(&motions, &all, || {
            asked.set(asked.get() + 1);
            if asked.get() > most {
                Err(Problem::stopped())
            } else {
                Ok(())
            }
        })
    };
    assert!(until(1).is_err() && asked.get() == 2);
    let whole = until(usize::MAX).unwrap();
    let last = request(
        ResponseKind::RelativeDisplacement,
        frequencies[GROUP..].to_vec(),
    );
    let alone = recorded_shock_spectra(&motions, &last, || Ok(())).unwrap();
    assert_eq!(whole.spectra[0].values[GROUP..], alone.spectra[0].values);
    assert_eq!(whole.spectra[0].samples_per_period.len(), GROUP + 2);
}
