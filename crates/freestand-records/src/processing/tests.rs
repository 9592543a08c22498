use super::*;
use crate::formats::{Direction, ReadOptions, parse_motions};
use freestand::G0_M_S2;
use freestand_input::word_reader::WordReader;

/// Two horizontal components and a vertical one: north 0.2 g, east −0.1 g and up 0.05 g times a
/// wave of 2 Hz for 8 s.
fn file(header: &str) -> MotionFile {
    let rows: String = (0..=800)
        .map(|k| {
            let wave = (std::f64::consts::TAU * 0.02 * f64::from(k)).sin();
            format!(
                "{},{},{},{}\n",
                f64::from(k) / 100.0,
                0.2 * wave,
                -0.1 * wave,
                0.05 * wave
            )
        })
        .collect();
    parse_motions(
        format!("{header}\n{rows}").into_bytes(),
        "three.csv".as_ref(),
        &ReadOptions::default(),
    )
    .unwrap()
}

pub(super) fn three() -> MotionFile {
    let mut file = file("time [s],N-S [g],E-W [g],UP [g]");
    let directions = [
        Direction::Azimuth(0.0),
        Direction::Azimuth(90.0),
        Direction::Up,
    ];
    for (component, direction) in file.components.iter_mut().zip(directions) {
        component.direction = Some(direction);
    }
    file
}

#[test]
fn nothing_is_altered_unasked() {
    let file = three();
    let done = process(&file.components[0], &Processing::default()).unwrap();
    assert_eq!(done.motion, file.components[0].motion);
    assert_eq!(
        (done.steps.len(), done.notes.len(), done.scale_ratio),
        (0, 0, 1.0)
    );
}

#[test]
fn everything_is_done_in_the_order_that_the_steps_say() {
    let file = three();
    let processing = Processing {
        azimuth_deg: Some(30.0),
        baseline: Some(Baseline::Polynomial { degree: 1 }),
        taper_ratio: Some(0.05),
        low_cut_hz: Some(0.5),
        high_cut_hz: Some(20.0),
        resample_dt_s: Some(0.005),
        scale: Scale::Peak { target_m_s2: 3.0 },
        ..Processing::default()
    };
    let (done, name) = process_file(&file, None, &processing).unwrap();
    assert_eq!(name, ", components N-S and E-W");
    let begins = [
        "components N-S (0 deg) and E-W (90 deg) rotated to 30 deg",
        "polynomial of degree 1 in the acceleration removed, at most ",
        "cosine taper over 5 % at each end",
        "Butterworth filters from 0.5 Hz to 20 Hz of order 4, forwards and backwards; 12 s of zeros added before and after \
         the record: the motion starts 12 s earlier",
        "resampled from 0.01 s to 0.005 s (band-limited)",
        "multiplied by ",
    ];
    assert_eq!(done.steps.len(), begins.len());
    for (step, begin) in done.steps.iter().zip(begins) {
        assert!(step.starts_with(begin), "{step}");
    }
    assert!(
        done.steps[5].ends_with(" to a peak of 0.305915 g"),
        "{}",
        done.steps[5]
    );
    // 8 s and two pads of 12 s, at the new step.
    assert_eq!(
        (done.motion.dt_s(), done.motion.accel_m_s2().len()),
        (0.005, 6401)
    );
    // One multiplication of the largest sample by the factor that was found for it.
    assert!((done.motion.peak_m_s2() - 3.0).abs() < 1e-15);
    // The same by hand, from the core's own steps.
    let turned: Vec<f64> = file.components[0]
        .motion
        .accel_m_s2()
        .iter()
        .zip(file.components[1].motion.accel_m_s2())
        .map(|(n, e)| n * 30f64.to_radians().cos() + e * 30f64.to_radians().sin())
        .collect();
    let by_hand = Motion::new(0.01, turned).unwrap();
    let by_hand = corrected(&by_hand, Baseline::Polynomial { degree: 1 }).unwrap();
    let by_hand = tapered(&by_hand, 0.05).unwrap();
    let by_hand = filtered(
        &by_hand,
        Pass::Band {
            low_cut_hz: 0.5,
            high_cut_hz: 20.0,
        },
        4,
    )
    .unwrap()
    .motion;
    let by_hand = resampled(&by_hand, 0.005)
        .unwrap()
        .scaled(done.scale_ratio)
        .unwrap();
    for (a, b) in done.motion.accel_m_s2().iter().zip(by_hand.accel_m_s2()) {
        // The sine and cosine of 30 and 60 degrees differ in their last bit; the filter, of corner
        // π·0.5·0.01, magnifies that by the inverse of its square.
        assert!((a - b).abs() < 1e-11, "{a} {b}");
    }
}

#[test]
fn a_wave_along_one_line_is_found_along_it() {
    // North 0.2 and east −0.1: the wave points to −26.565 degrees, and is √5/10 g there.
    let azimuth = |azimuth_deg| Processing {
        azimuth_deg: Some(azimuth_deg),
        ..Processing::default()
    };
    let peak = |azimuth_deg| {
        process_file(&three(), None, &azimuth(azimuth_deg))
            .unwrap()
            .0
            .motion
            .peak_m_s2()
            / G0_M_S2
    };
    let along = (-0.1_f64).atan2(0.2).to_degrees();
    // The wave has its peak at no sample (sin 0.125·2π·k): 0.1·√5 times the largest sample, here 1.
    let largest = (0..=800)
        .map(|k| (std::f64::consts::TAU * 0.02 * f64::from(k)).sin())
        .fold(0.0, f64::max);
    assert!((peak(along) - 0.05_f64.sqrt() * largest).abs() < 1e-15);
    assert!(peak(along + 90.0) < 1e-16);
    assert_eq!(
        peak(90.0),
        three().components[1].motion.peak_m_s2() / G0_M_S2
    );
}

#[test]
fn an_azimuth_needs_two_directions() {
    let azimuth = Processing {
        azimuth_deg: Some(30.0),
        ..Processing::default()
    };
    let refused = |file: &MotionFile| process_file(file, None, &azimuth).unwrap_err().to_string();
    let mut silent = three();
    silent.components[1].direction = None;
    assert_eq!(
        refused(&silent),
        "three.csv: the file does not state the direction of E-W"
    );
    let mut four = three();
    four.components.push(four.components[0].clone());
    assert!(
        refused(&four).contains("has 3 horizontal components, but two are needed: N-S, E-W, N-S")
    );
    let mut one = three();
    one.components.remove(0);
    assert!(refused(&one).contains("has 1 horizontal component, but two are needed"));
    let mut parallel = three();
    parallel.components[1].direction = Some(Direction::Azimuth(170.0));
    assert!(refused(&parallel).contains("too close to parallel"));
    assert!(
        process(&three().components[0], &azimuth)
            .unwrap_err()
            .message
            .contains("needs two components")
    );
}

#[test]
fn components_of_different_length_are_cut_to_the_shorter_and_it_is_said() {
    let mut file = three();
    let short = file.components[1].motion.accel_m_s2()[..700].to_vec();
    file.components[1].motion = Motion::new(0.01, short).unwrap();
    let azimuth = Processing {
        azimuth_deg: Some(30.0),
        ..Processing::default()
    };
    let (done, _) = process_file(&file, None, &azimuth).unwrap();
    assert_eq!(done.motion.accel_m_s2().len(), 700);
    assert_eq!(
        done.steps[0],
        "last 101 samples of N-S left out: the other component ends earlier"
    );
}

#[test]
fn the_mean_of_raw_components_goes_first() {
    let mut file = three();
    for component in &mut file.components {
        component.is_raw = true;
        let shifted = component
            .motion
            .accel_m_s2()
            .iter()
            .map(|a| a + 5.0)
            .collect();
        component.motion = Motion::new(0.01, shifted).unwrap();
    }
    // Of each it is said once, and with the component that lost it.
    let (one, two) = process_pair(
        (&file.components[0], &file.components[1]),
        ("N-S", "E-W"),
        &Processing::default(),
    )
    .unwrap();
    for (done, end) in [
        (one, "removed from N-S (raw record)"),
        (two, "removed from E-W (raw record)"),
    ] {
        assert!(
            done.notes.len() == 1
                && done.notes[0].to_string().ends_with(end)
                && done.steps == done.notes,
            "{:?}",
            done.notes
        );
    }
    let azimuth = Processing {
        azimuth_deg: Some(45.0),
        ..Processing::default()
    };
    let (done, _) = process_file(&file, None, &azimuth).unwrap();
    assert!(
        done.steps[0].starts_with("mean of 5.00")
            && done.steps[0].ends_with("removed from N-S (raw record)")
    );
    // The sum of 801 values of 7 m/s².
    assert!(done.motion.mean_m_s2().abs() < 1e-13);
    let kept = Processing {
        keep_mean: true,
        ..azimuth
    };
    assert!(
        (process_file(&file, None, &kept)
            .unwrap()
            .0
            .motion
            .mean_m_s2()
            - 50f64.sqrt())
        .abs()
            < 0.01
    );
}

#[test]
fn factors_are_found_and_large_ones_are_noted() {
    let file = three();
    let component = &file.components[0];
    let scaled = |scale| {
        process(
            component,
            &Processing {
                scale,
                ..Processing::default()
            },
        )
    };
    let sa = Scale::Sa {
        target_m_s2: 2.0,
        period_s: 1.0,
        damping_ratio: 0.02,
    };
    let done = scaled(sa.clone()).unwrap();
    let spectrum = freestand::oscillator::response_spectrum(&done.motion, 0.02, &[1.0]).unwrap();
    assert!((spectrum.psa_m_s2[0] - 2.0).abs() < 1e-14);
    assert!(
        done.steps[0].ends_with("to a pseudo-acceleration of 0.203943 g at 1 s, 2 % damping"),
        "{:?}",
        done.steps
    );
    let peak = component.motion.peak_m_s2();
    for (target_m_s2, notes) in [
        (9.9 * peak, 0),
        (10.1 * peak, 1),
        (peak / 9.9, 0),
        (peak / 10.1, 1),
    ] {
        assert_eq!(
            scaled(Scale::Peak { target_m_s2 }).unwrap().notes.len(),
            notes,
            "{target_m_s2}"
        );
    }
    // A factor that the user gives needs no note.
    assert_eq!(scaled(Scale::Factor(100.0)).unwrap().notes.len(), 0);
    let mut still = file.components[0].clone();
    still.motion = Motion::new(0.01, vec![0.0; 10]).unwrap();
    let refused = process(
        &still,
        &Processing {
            scale: sa,
            ..Processing::default()
        },
    )
    .unwrap_err();
    assert!(
        refused.message.contains("no factor scales it to a target"),
        "{refused}"
    );
}

fn target(periods_s: &[f64], psa_m_s2: &[f64], damping_ratio: f64) -> TargetSpectrum {
    TargetSpectrum {
        name: "own".into(),
        file: None,
        periods_s: periods_s.to_vec(),
        psa_m_s2: psa_m_s2.to_vec(),
        damping_ratio,
        note: None,
    }
}

/// Its own spectrum twice as high is met by a factor of 2 everywhere; a spectrum of another shape
/// in the mean of the logarithms, and the step says how nearly.
#[test]
fn a_motion_is_scaled_to_a_spectrum() {
    let file = three();
    let component = &file.components[0];
    let scaled = |target| {
        process(
            component,
            &Processing {
                scale: Scale::Spectrum(target),
                ..Processing::default()
            },
        )
    };
    let periods_s = [0.0, 0.2, 0.5, 1.0];
    let own = freestand::oscillator::response_spectrum(&component.motion, 0.02, &periods_s)
        .unwrap()
        .psa_m_s2;
    let twice: Vec<f64> = own.iter().map(|a| 2.0 * a).collect();
    let done = scaled(target(&periods_s, &twice, 0.02)).unwrap();
    // Four logarithms of exactly 2, their mean and its exponential.
    assert!(
        (done.scale_ratio - 2.0).abs() < 1e-15,
        "{}",
        done.scale_ratio
    );
    let end = " to the spectrum of own (4 periods from 0 s to 1 s, 2 % damping; misfit below 0.01 % rms in ln)";
    assert!(
        done.steps[0].starts_with("multiplied by ") && done.steps[0].ends_with(end),
        "{:?}",
        done.steps
    );
    // Factors of e and 1/e in addition to that of 3: each period is 1 off, in ln.
    let e = std::f64::consts::E;
    let apart: Vec<f64> = own
        .iter()
        .zip([e, 1.0 / e, e, 1.0 / e])
        .map(|(a, off)| 3.0 * a * off)
        .collect();
    let done = scaled(target(&periods_s, &apart, 0.02)).unwrap();
    // Two roundings of each of the four targets.
    assert!(
        (done.scale_ratio - 3.0).abs() < 1e-14,
        "{}",
        done.scale_ratio
    );
    assert!(
        done.steps[0].ends_with("; misfit 100 % rms in ln)") && done.notes.is_empty(),
        "{:?}",
        done.steps
    );
    let far: Vec<f64> = own.iter().map(|a| 11.0 * a).collect();
    assert_eq!(
        scaled(target(&periods_s, &far, 0.02)).unwrap().notes.len(),
        1
    );
    let mut still = component.clone();
    still.motion = Motion::new(0.01, vec![0.0; 10]).unwrap();
    // Its own is met by a factor of 1, and that is a step with its misfit.
    let done = scaled(TargetSpectrum {
        note: Some("said".into()),
        ..target(&periods_s, &own, 0.02)
    })
    .unwrap();
    assert!(
        done.steps.len() == 1 && done.steps[0].ends_with(end),
        "{:?}",
        done.steps
    );
    assert_eq!(done.notes, ["said"]);
    let scale = Scale::Spectrum(target(&[1.0], &[1.0], 0.05));
    let refused = process(
        &still,
        &Processing {
            scale,
            ..Processing::default()
        },
    )
    .unwrap_err();
    assert!(
        refused.message.contains("no factor scales it to a target"),
        "{refused}"
    );
}

#[test]
fn huge_and_tiny_factors_are_short_in_words_and_exact_in_numbers() {
    let file = three();
    for (factor, words) in [
        (1.234567891e200, "multiplied by 1.23457e200"),
        (-1.5e-200, "multiplied by -1.5e-200"),
        (123456789.5, "multiplied by 123456789.5"),
        (0.1 + 0.2, "multiplied by 0.30000000000000004"),
    ] {
        let processing = Processing {
            scale: Scale::Factor(factor),
            ..Processing::default()
        };
        let done = process(&file.components[0], &processing).unwrap();
        assert_eq!(
            (done.steps, done.scale_ratio),
            (vec![words.to_owned()], factor)
        );
    }
}

/// Ten steps of 0.01 s are 0.1 s: shorter periods of a target are warned of, the peak itself and
/// longer ones are not.
#[test]
fn short_periods_of_a_target_are_warned_of() {
    let file = three();
    let notes = |scale| {
        process(
            &file.components[0],
            &Processing {
                scale,
                ..Processing::default()
            },
        )
        .unwrap()
        .notes
    };
    let at = |period_s| Scale::Sa {
        target_m_s2: 2.0,
        period_s,
        damping_ratio: 0.05,
    };
    assert_eq!((notes(at(0.0)).len(), notes(at(0.1)).len()), (0, 0));
    let said = "the shortest period of the target, 0.03 s, has fewer than ten steps of 0.01 s";
    let sa = notes(at(0.03));
    assert!(
        sa[0].to_string().starts_with(said)
            && sa[0]
                .to_string()
                .ends_with("`resample = \"0.0025 s\"` gives it ten"),
        "{sa:?}"
    );
    let spectrum = notes(Scale::Spectrum(target(
        &[0.0, 0.03, 1.0],
        &[2.0, 2.0, 2.0],
        0.05,
    )));
    assert!(
        spectrum
            .iter()
            .any(|note| note.to_string().starts_with(said)),
        "{spectrum:?}"
    );
    // At a quarter of the step it has ten.
    let finer = Processing {
        resample_dt_s: Some(0.0025),
        scale: at(0.03),
        ..Processing::default()
    };
    assert_eq!(process(&file.components[0], &finer).unwrap().notes.len(), 0);
}

#[test]
fn what_this_record_does_not_allow_is_refused_with_a_hint() {
    let file = three();
    let default = Processing::default;
    for (processing, says) in [
        (
            Processing {
                high_cut_hz: Some(50.0),
                ..default()
            },
            "filter: a corner frequency must be above 0 and below 50 Hz",
        ),
        (
            Processing {
                low_cut_hz: Some(60.0),
                ..default()
            },
            "filter: a corner frequency",
        ),
        (
            Processing {
                low_cut_hz: Some(1e-9),
                ..default()
            },
            "filter: with pads of",
        ),
        (
            Processing {
                resample_dt_s: Some(9.0),
                ..default()
            },
            "resample: the new time step",
        ),
        (
            Processing {
                resample_dt_s: Some(0.0123456789),
                ..default()
            },
            "resample: the ratio of the time steps 0.01 s and",
        ),
        (
            Processing {
                baseline: Some(Baseline::PreEvent { until_s: 9.0 }),
                ..default()
            },
            "baseline: the quiet time",
        ),
    ] {
        let problem = process(&file.components[0], &processing).unwrap_err();
        assert!(
            problem.message.starts_with(says) && problem.hint.is_some(),
            "{problem:?}"
        );
    }
}

#[test]
fn what_no_record_allows_is_known_before_one_is_read() {
    let found = |entries: &[(&'static str, &str)]| {
        let words = entries.iter().copied().collect();
        let mut reader = WordReader::new(&words);
        let processing = Processing::read(&mut reader, freestand_input::file::as_named);
        let problems = reader.problems.problems;
        let is_told =
            |problem: &Problem| problem.hint.is_some() || problem.message.contains("must");
        assert!(problems.iter().all(is_told), "{problems:?}");
        (
            processing,
            problems
                .into_iter()
                .map(|problem| problem.keys)
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(found(&[]), (Processing::default(), vec![]));
    for (key, text) in [
        ("taper", "0"),
        ("taper", "51 %"),
        ("taper", "-5 %"),
        ("low_cut", "-0.1 Hz"),
        ("high_cut", "0 Hz"),
        ("filter_order", "4"),
        ("resample", "1e-7 s"),
        ("resample", "-0.01 s"),
        ("resample", "1000 s"),
        ("scale", "0"),
        ("scale", "inf"),
        ("scale_to", "-1 m/s2"),
        ("scale_to", "0 g"),
        ("scale_to_sa", "0.4 g"),
        ("scale_to_spectrum", "t.csv, 5 s"),
        ("azimuth", "nan deg"),
        ("azimuth", "inf deg"),
        ("baseline", "pre-event:0s"),
        ("baseline", "poly:11"),
    ] {
        assert_eq!(found(&[(key, text)]).1, [[key]], "{key} {text}");
    }
    for order in ["0", "11", "2.5", "-1"] {
        assert_eq!(
            found(&[("low_cut", "1 Hz"), ("filter_order", order)]).1,
            [["filter_order"]],
            "{order}"
        );
    }
    assert_eq!(
        found(&[("low_cut", "20 Hz"), ("high_cut", "20 Hz")]).1,
        [["low_cut"]]
    );
    assert_eq!(
        found(&[("component", "1"), ("azimuth", "30 deg")]).1,
        [["component", "azimuth"]]
    );
    let scales = [
        ("scale", "2"),
        ("scale_to", "1 g"),
        ("scale_to_sa", "1 g at 1 s"),
    ];
    assert_eq!(
        found(&scales).1,
        [
            ["scale", "scale_to"],
            ["scale", "scale_to_sa"],
            ["scale_to", "scale_to_sa"]
        ]
    );
    let all_wrong = [
        ("azimuth", "30"),
        ("baseline", "poly:11"),
        ("resample", "0 s"),
        ("scale", "0"),
    ];
    assert_eq!(
        found(&all_wrong).1,
        [["azimuth"], ["baseline"], ["resample"], ["scale"]]
    );
    let written = [
        ("keep_mean", "true"),
        ("filter_order", "2"),
        ("high_cut", "20 Hz"),
        ("scale_to", "3 m/s2"),
    ];
    let scale = Scale::Peak { target_m_s2: 3.0 };
    let expected = Processing {
        keep_mean: true,
        filter_order: 2,
        high_cut_hz: Some(20.0),
        scale,
        ..Processing::default()
    };
    assert_eq!(found(&written), (expected, vec![]));
}
