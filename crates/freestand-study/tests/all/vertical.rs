//! Vertical motion in studies: synthetic, from records, on the floors, and where it ends a history.

#![expect(clippy::unwrap_used, reason = "a test may stop at an error")]

use std::fmt::Write as _;
use std::path::Path;

use freestand::oscillator::response_spectrum;
use freestand::rocking::{Base, RockingOptions, Until, rock};
use freestand_output::folder::OutputFolder;
use freestand_report::study::outputs::write_outputs;
use freestand_report::study::tables::{srs_table, urs_table};
use freestand_study::resolve::{Overrides, load, resolve};
use freestand_study::result::{ObjectResponse, StudyResult};
use freestand_study::run::{LONGEST_TAIL_S, no_progress, run};
use freestand_study::study::Study;

const REST: &str = "[building]\nstoreys = 8\nlevels = [0.0, 1.0]\nvertical_amplification = 1.5\n[objects]\nheights = \
                    \"1.5 m, 2 m\"\nthicknesses = \"0.3 m, 0.5 m\"\n[outputs]\nfigures = false\nreport = false\n";

/// Two motions of a strong target, with more keys of `[ground]`.
fn study(keys: &str) -> Study {
    let ground = "[ground]\ncode = \"eurocode8\"\nspectrum_type = 1\nsite = \"C\"\nground_acceleration = \"0.3 g\"\ncount = 2\n";
    resolve(&format!("{ground}{keys}{REST}"), None, Path::new("")).unwrap()
}

fn tables(keys: &str) -> (Study, StudyResult, Vec<Vec<u8>>) {
    let study = study(keys);
    let result = run(&study, &no_progress).unwrap();
    let tables = vec![
        urs_table(&study, &result).unwrap().into(),
        srs_table(&study, &result).unwrap().into(),
    ];
    (study, result, tables)
}

/// What is wrong with a study.
fn refused(text: &str) -> String {
    resolve(&format!("{text}{REST}"), None, Path::new(""))
        .unwrap_err()
        .to_string()
}

#[test]
fn a_ratio_of_zero_is_no_vertical_motion_to_the_byte() {
    let (_, none, without) = tables("");
    let (_, zero, with_zero) = tables("vertical = 0\n");
    let (_, some, with_some) = tables("vertical = 0.67\n");
    assert_eq!(without, with_zero);
    assert_ne!(without, with_some);
    assert!(zero.ground.iter().all(|ground| ground.vertical.is_none()));
    // The horizontal motions are those without a vertical one.
    for (one, other) in none.ground.iter().zip(&some.ground) {
        assert_eq!(one.motion, other.motion);
    }
}

/// Matched as horizontal motions are (rms misfit 3 to 5 %), with phases of its own.
#[test]
fn a_synthetic_vertical_motion_has_its_share_of_the_target() {
    for (keys, is_code) in [
        ("vertical = 0.67\n", false),
        ("vertical = \"code\"\n", true),
    ] {
        let (study, result, _) = tables(keys);
        let target = study.ground.target().unwrap();
        for ground in &result.ground {
            let vertical = ground.vertical.as_ref().unwrap();
            assert_eq!(
                vertical.accel_m_s2().len(),
                ground.motion.along.accel_m_s2().len()
            );
            let periods_s: Vec<f64> = (0..60).map(|i| 0.06 * 1.075f64.powi(i)).collect();
            let psa_m_s2 = response_spectrum(vertical, 0.05, &periods_s)
                .unwrap()
                .psa_m_s2;
            let squares = periods_s.iter().zip(&psa_m_s2).map(|(&period_s, psa)| {
                let share = 0.67 * target.spectrum.sa_g(period_s);
                let wanted = if is_code {
                    target.spectrum.vertical_sa_g(period_s).unwrap()
                } else {
                    share
                };
                (psa / (wanted * 9.80665) - 1.0).powi(2)
            });
            let rms = (squares.sum::<f64>() / 60.0).sqrt();
            assert!(rms < 0.08, "{keys}: rms misfit {rms}");
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let (h, v) = (ground.motion.along.accel_m_s2(), vertical.accel_m_s2());
            let correlation = dot(h, v) / (dot(h, h) * dot(v, v)).sqrt();
            // About 1/√(60 independent cycles) for motions that share nothing.
            assert!(correlation.abs() < 0.4, "{keys}: {correlation}");
        }
    }
}

/// Every history of a run is that of the scalar solver under the floor's horizontal motion and the
/// ground's vertical one, times the amplification above the ground. 1e-9: the kernel's error.
#[test]
fn floors_have_the_vertical_motion_of_the_ground_times_the_amplification() {
    let (study, result, _) = tables("vertical = 0.9\n");
    let mut rocked = 0;
    for (level, factor) in result.levels.iter().zip([1.0, 1.5]) {
        for (motion, ground) in result.ground.iter().enumerate() {
            let floor = &level.floors[motion].along;
            let tail_s = floor.duration_s() - ground.motion.along.duration_s();
            let vertical = ground
                .vertical
                .as_ref()
                .unwrap()
                .scaled(factor)
                .unwrap()
                .with_zero_tail(tail_s)
                .unwrap();
            let base = Base {
                horizontal: Some(floor),
                vertical: Some(&vertical),
            };
            for (block, response) in study.objects.blocks.iter().zip(&level.responses[motion]) {
                let ObjectResponse::Done { uplift, .. } = response else {
                    panic!("{response:?}")
                };
                let until = Until::Settled {
                    at_most_s: LONGEST_TAIL_S,
                };
                let alone = rock(
                    block,
                    base,
                    &RockingOptions {
                        until,
                        ..RockingOptions::default()
                    },
                )
                .unwrap();
                assert_eq!(uplift.rocking.outcome, alone.outcome);
                let (one, other) = (uplift.rocking.peak_rotation_rad, alone.peak_rotation_rad);
                assert!((one - other).abs() <= 1e-9 * other, "{one} {other}");
                rocked += usize::from(other > 0.0);
            }
        }
    }
    assert!(rocked >= 4, "{rocked}");
}

/// A record of 3 s every 0.01 s, as a column with its heading.
fn write_record(path: &Path, heading: &str, peak: f64, frequency_hz: f64) {
    let mut text = format!("{heading}\n");
    for i in 0..300 {
        let t = 0.01 * f64::from(i);
        writeln!(
            text,
            "{t},{}",
            peak * (std::f64::consts::TAU * frequency_hz * t).sin()
        )
        .unwrap();
    }
    std::fs::write(path, text).unwrap();
}

/// The study that a run writes runs again from its folder, with the same tables; the vertical record
/// is scaled as the horizontal one is.
#[test]
fn vertical_records_are_scaled_used_and_written() {
    let folder = tempfile::tempdir().unwrap();
    write_record(&folder.path().join("h.csv"), "time [s],ns [g]", 0.25, 1.1);
    write_record(&folder.path().join("v.csv"), "time [s],up [g]", 0.2, 4.0);
    let ground = "[ground]\nmotions = [\"h.csv\"]\nscale = 1.5\nvertical = [\"v.csv\"]\n";
    let study = resolve(&format!("{ground}{REST}"), None, folder.path()).unwrap();
    let result = run(&study, &no_progress).unwrap();
    let vertical = result.ground[0].vertical.as_ref().unwrap();
    // The sine is sampled close to its crest.
    assert!((vertical.peak_m_s2() / 9.80665 - 0.3).abs() < 1e-3);

    let out = folder.path().join("out");
    let staged = OutputFolder::stage(&out, false, &[]).unwrap();
    let written = write_outputs(staged, &study, &result).unwrap();
    assert!(
        written.files.contains(&"vertical/h.csv".to_owned()),
        "{:?}",
        written.files
    );
    let again = load(&out.join("study.toml"), &Overrides::default()).unwrap();
    let second = run(&again, &no_progress).unwrap();
    assert_eq!(
        urs_table(&again, &second).unwrap(),
        urs_table(&study, &result).unwrap()
    );
    let summary = std::fs::read(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&summary).unwrap();
    assert_eq!(
        summary["inputs"]["vertical"],
        "the vertical components of the records"
    );
}

/// 1.5 × 1.5 × 0.5 g upward and downward: the roof falls away, the ground does not.
#[test]
fn a_floor_that_falls_away_ends_the_history() {
    let folder = tempfile::tempdir().unwrap();
    write_record(&folder.path().join("h.csv"), "time [s],ns [g]", 0.25, 1.1);
    write_record(&folder.path().join("v.csv"), "time [s],up [g]", 0.8, 4.0);
    let ground = "[ground]\nmotions = [\"h.csv\"]\nvertical = [\"v.csv\"]\n";
    let study = resolve(&format!("{ground}{REST}"), None, folder.path()).unwrap();
    let result = run(&study, &no_progress).unwrap();
    let table = urs_table(&study, &result).unwrap().to_string();
    let outcomes: Vec<&str> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(4).unwrap())
        .collect();
    assert_eq!(outcomes.len(), 8);
    assert!(
        outcomes[..4]
            .iter()
            .all(|outcome| *outcome != "free-flight"),
        "{table}"
    );
    assert!(
        outcomes[4..]
            .iter()
            .all(|outcome| *outcome == "free-flight"),
        "{table}"
    );
}

#[test]
fn a_vertical_motion_that_does_not_exist_is_refused() {
    let synthetic = "[ground]\ncode = \"as1170.4\"\ncity = \"Melbourne\"\nsite = \"De\"\nreturn_period_years = 500\n";
    for (text, expected) in [
        (
            format!("{synthetic}vertical = \"code\"\n"),
            "the vertical spectrum of",
        ),
        (
            format!("{synthetic}vertical = -0.5\n"),
            "vertical must be from 0 to 3, not -0.5",
        ),
        (
            format!("{synthetic}vertical = \"record\"\n"),
            "vertical names records, but the motions are synthetic",
        ),
        (
            format!("{synthetic}vertical = \"up\"\n"),
            "vertical must be a ratio",
        ),
        (
            "[ground]\nmotions = [\"gone.csv\"]\nvertical = 0.67\n".to_owned(),
            "records are not matched to a vertical",
        ),
        (
            "[ground]\nmotions = [\"a\"]\nvertical = [\"b\", \"c\"]\n".to_owned(),
            "vertical names 2 files",
        ),
        (
            "[ground]\npoint_source = { magnitude = 6.0, distance = \"30 km\" }\nvertical = 0.67\n"
                .to_owned(),
            "vertical has no effect here: simulated motions are horizontal",
        ),
    ] {
        let error = refused(&text);
        assert!(error.contains(expected), "{error}");
    }
    let error = resolve(
        "[building]\nvertical_amplification = 0\n",
        None,
        Path::new(""),
    )
    .unwrap_err()
    .to_string();
    assert!(
        error.contains("vertical_amplification must be a ratio above 0"),
        "{error}"
    );
}
