//! `motion synth`, `match` and `simulate`, as a user calls them.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn freestand(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).output().unwrap()
}

fn document(args: &[&str]) -> Value {
    let output = freestand(&[args, &["--json", "--quiet"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort_unstable();
    names
}

#[test]
fn a_magnitude_and_a_distance_give_motions_with_all_that_made_them() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let simulate = ["motion", "simulate", "--magnitude", "6", "--distance", "28 km", "--count", "2", "--seed", "3"];
    let one = document(&[&simulate[..], &["--out", out.to_str().unwrap()]].concat());
    assert_eq!(one["schema"], "freestand.motion-simulate/1");
    assert_eq!((&one["seed"], &one["parameters"]["stress_drop_pa"]), (&Value::from(3), &Value::from(2e7)));
    assert!(one["generator"].as_str().unwrap().contains("ChaCha12"));
    let earthquake = &one["earthquakes"][0];
    // f₀ of the reference, five digits; T_d = 1/f₀ + 0.05·28.
    let corner_hz = earthquake["corner_frequencies_hz"][0].as_f64().unwrap();
    assert!((corner_hz - 0.44854).abs() < 5e-6);
    assert!((earthquake["duration_s"].as_f64().unwrap() - 1.0 / corner_hz - 1.4).abs() < 1e-9);
    assert_eq!(earthquake["motions"].as_array().unwrap().len(), 2);
    let names = files(&out);
    for name in ["fourier_amplitude.csv", "m6.0-28km-01.csv", "m6.0-28km-02.csv", "m6.0-28km-01.png", "manifest.json"] {
        assert!(names.iter().any(|other| other == name), "{name} in {names:?}");
    }
    // Without a folder the same motions, and no paths.
    let again = document(&simulate);
    assert_eq!(again["earthquakes"][0]["motions"][1]["path"], Value::Null);
    assert_eq!(again["earthquakes"][0]["motions"][1]["pga_g"], earthquake["motions"][1]["pga_g"]);
}

#[test]
fn a_city_gives_the_distances_of_its_spectrum() {
    let pairs =
        document(&["motion", "simulate", "--city", "Melbourne", "--magnitude", "6", "--count", "4", "--site", "De"]);
    let earthquake = &pairs["earthquakes"][0];
    assert_eq!(pairs["kpz_g"], 0.08);
    assert!((earthquake["mean_ratio_to_rock_spectrum"].as_f64().unwrap() - 1.0).abs() < 2e-3);
    // An independent computation has 30 km; four motions have a standard error of 15 %.
    let distance_m = earthquake["distance_m"].as_f64().unwrap();
    assert!((18e3..45e3).contains(&distance_m), "{distance_m}");
    assert!(pairs["assumptions"][1].as_str().unwrap().contains("no soil column"));
}

#[test]
fn a_record_is_matched_by_both_methods_and_to_a_peak() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("rock");
    document(&[
        "motion",
        "synth",
        "--site",
        "Be",
        "--count",
        "1",
        "--time-step",
        "0.01 s",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(files(&out).contains(&"target.svg".to_owned()));
    let record = out.join("synthetic-01.csv");
    let match_it = ["motion", "match", record.to_str().unwrap(), "--site", "De"];
    for (method, more) in [("wavelet", &[][..]), ("fft", &["--method", "fft"][..])] {
        let matched = document(&[&match_it[..], more].concat());
        assert_eq!((&matched["method"], &matched["motions"][0]["dt_s"]), (&Value::from(method), &Value::from(0.01)));
        assert!(matched["motions"][0]["rms_misfit_ratio"].as_f64().unwrap() < 0.05);
        assert!(matched["motions"][0]["correlation_ratio"].as_f64().unwrap() > 0.5);
    }
    let peak = document(&[&match_it[..], &["--match-pga"]].concat());
    let one = &peak["motions"][0];
    // A thousandth is the tolerance of the peak.
    assert!((one["pga_g"].as_f64().unwrap() / 0.088 - 1.0).abs() < 1e-3);
    assert!(one["rms_misfit_ratio"].as_f64() > one["rms_misfit_before_pga_ratio"].as_f64());
}

#[test]
fn what_cannot_be_simulated_is_said() {
    for (args, words) in [
        (&["--magnitude", "9", "--distance", "30 km"][..], "magnitude must be from 3 to 8.5"),
        (&["--magnitude", "6", "--distance", "30"], "--distance"),
        (&["--magnitude", "6", "--distance", "30 km", "--preset", "mars"], "no preset"),
        (&["--city", "Atlantis"], "no hazard factor"),
        (&["--magnitude", "6"], "--distance"),
    ] {
        let output = freestand(&[&["motion", "simulate"], args].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words) && said.contains("hint:"), "{said}");
    }
}
