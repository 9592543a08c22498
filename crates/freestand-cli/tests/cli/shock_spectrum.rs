//! `freestand shock-spectrum`: pulses, files, and what it refuses.

use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::cases;
use crate::program::{execute, freestand_in};

/// A half-sine of 200 g and 10 ms at 20 kHz between stretches of rest, as a laboratory writes it.
/// More than 20 g, which would be noted of a floor.
fn record() -> String {
    let row = |k: u32| {
        let share = (f64::from(k) - 100.0) / 200.0;
        let g = if (100..=300).contains(&k) {
            200.0 * (std::f64::consts::PI * share).sin()
        } else {
            0.0
        };
        format!("{:.2},{g:.6}\n", 0.05 * f64::from(k))
    };
    format!(
        "time [ms],acceleration [g]\n{}",
        (0..=800).map(row).collect::<String>()
    )
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("drop.csv"), record()).unwrap();
    std::fs::write(
        folder.path().join("words.csv"),
        "time [ms],acceleration [g]\n0,0\n0.5,soft\n1,0\n",
    )
    .unwrap();
    folder
}

fn spectrum(folder: &Path, args: &[&str]) -> Output {
    execute(folder, &[&["shock-spectrum"], args].concat())
}

/// All that a command says, without the time that it took.
fn said(folder: &Path, args: &[&str]) -> String {
    let text = freestand_in(folder, &[&["shock-spectrum"], args].concat());
    text.lines()
        .filter(|line| !line.contains("\"solve_s\""))
        .collect::<Vec<_>>()
        .join("\n")
}

const PULSE: [&str; 6] = [
    "--pulse",
    "half-sine",
    "--peak-acceleration",
    "200 g",
    "--duration",
    "10 ms",
];
const FREQUENCIES: [&str; 2] = ["--frequencies", "20 Hz, 100 Hz, 300 Hz"];

#[test]
fn a_pulse() {
    insta::assert_snapshot!(said(Path::new("."), &[&PULSE[..], &FREQUENCIES].concat()));
}

#[test]
fn a_pulse_as_json() {
    let more = [
        "--q",
        "25",
        "--kind",
        "pseudo-velocity",
        "--peak",
        "residual",
        "--json",
    ];
    insta::assert_snapshot!(said(
        Path::new("."),
        &[&PULSE[..], &FREQUENCIES, &more].concat()
    ));
}

/// The record is the pulse: within the 0.05 % of the method, the corners of a half-sine of 200
/// samples (π²/(12 · 200²) of its impulse is 2e-5) and six printed decimals.
#[test]
fn a_file_is_its_pulse() {
    let folder = folder();
    insta::assert_snapshot!(said(
        folder.path(),
        &[&["drop.csv"][..], &FREQUENCIES].concat()
    ));
    let values = |args: &[&str]| -> Vec<f64> {
        let output = spectrum(folder.path(), &[args, &FREQUENCIES, &["--json"]].concat());
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        let values = document["spectra"][0]["values"].as_array().unwrap().clone();
        values.iter().map(|value| value.as_f64().unwrap()).collect()
    };
    let (file, pulse) = (values(&["drop.csv"]), values(&PULSE));
    assert_eq!((file.len(), pulse.len()), (3, 3));
    for (file, pulse) in file.iter().zip(&pulse) {
        assert!((file / pulse - 1.0).abs() < 6e-4, "{file} {pulse}");
    }
    // By hand: ζ = 5 % at fT = 1 is 1.62379 times the peak.
    assert!((pulse[1] / 200.0 - 1.62379).abs() < 1e-5, "{}", pulse[1]);
}

#[test]
fn files_go_into_a_folder() {
    let folder = folder();
    let output = spectrum(
        folder.path(),
        &[&["drop.csv"][..], &FREQUENCIES, &["--json", "--out", "out"]].concat(),
    );
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let manifest: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("out/manifest.json")).unwrap())
            .unwrap();
    let names: Vec<&str> = manifest["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| name.as_str().unwrap())
        .collect();
    let expected = [
        "manifest.json",
        "result.json",
        "shock_spectrum.csv",
        "shock_spectrum.png",
        "shock_spectrum.svg",
    ];
    assert_eq!(names, expected);
    assert!(
        names
            .iter()
            .all(|name| folder.path().join("out").join(name).exists())
    );
    let mut told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(
        told["timing"]
            .as_object_mut()
            .unwrap()
            .remove("solve_s")
            .is_some_and(|seconds| seconds.is_f64())
    );
    let kept = std::fs::read(folder.path().join("out/result.json")).unwrap();
    assert_eq!(serde_json::from_slice::<Value>(&kept).unwrap(), told);
    let table = std::fs::read_to_string(folder.path().join("out/shock_spectrum.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 3);
}

#[test]
fn bad_input_is_refused() {
    let folder = folder();
    let cases: [&[&str]; 5] = [
        &["words.csv"],
        &["drop.csv", "--q", "0.4", "--frequencies", "0 Hz, 20 Hz"],
        &[
            "--pulse",
            "half-sine",
            "--peak-acceleration",
            "20",
            "--duration",
            "-1 ms",
        ],
        &["--pulse", "half-sine"],
        &["drop.csv", "--damping", "5 %", "--q", "10"],
    ];
    let all: Vec<String> = cases.iter().map(|args| said(folder.path(), args)).collect();
    for one in &all {
        assert!(
            one.contains("exit status 2\n--- stdout\n\n--- stderr\nerror: ")
                && one.contains("hint: "),
            "{one}"
        );
    }
    cases::each("bad_input_is_refused", &all);
}
