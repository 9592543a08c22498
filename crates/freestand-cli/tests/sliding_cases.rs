//! Slides that were solved in 160-bit arithmetic (`validation/sliding`), through the command line,
//! and those of the shared folder where it is present.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop at broken data and says what it skips")]

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The folder of cases that the repository may not hold.
fn shared() -> PathBuf {
    std::env::var_os("FREESTAND_SHARED").map_or_else(|| workspace().join("../shared"), PathBuf::from)
}

fn record(name: &str) -> PathBuf {
    workspace().join("validation/rocking/records").join(format!("{name}.csv"))
}

fn solve(case: &Value) -> Result<Value, String> {
    let path = record(case["record"].as_str().unwrap());
    let text = std::fs::read_to_string(&path).unwrap();
    let dt = text.split_whitespace().find_map(|word| word.strip_prefix("dt=")).unwrap().to_owned();
    let mut command = Command::new(env!("CARGO_BIN_EXE_freestand"));
    for arg in case["args"].as_array().unwrap() {
        match arg.as_str().unwrap() {
            "{horizontal}" | "{vertical}" => command.arg(&path),
            "{dt}" => command.arg(format!("{dt} s")),
            other => command.arg(other),
        };
    }
    if text.lines().last().unwrap().contains(',') {
        command.args(["--component", "1", "--vertical-component", "2"]);
    }
    let output = command.args(["--json", "--quiet"]).output().unwrap();
    serde_json::from_slice(&output.stdout).map_err(|_| String::from_utf8_lossy(&output.stderr).into_owned())
}

/// What differs, if anything.
///
/// 1e-8 of the path (of the largest speed, for speeds) and 1e-8 s, times the amplification of an
/// error of the motion where that is above 1. A peak is a stop: its time is the root of a quadratic
/// that may touch zero, so 1e-6 s.
fn difference(case: &Value, got: &Value) -> Option<String> {
    let amplification = case["amplification"].as_f64().unwrap().max(1.0);
    for (key, expected) in case["expect"].as_object().unwrap() {
        let tolerance = match key.as_str() {
            "slide_peak_time_s" => 1e-6,
            time if time.ends_with("time_s") => 1e-8,
            speed if speed.ends_with("_m_s") => 1e-8 * got["slide_speed_max_m_s"].as_f64()?,
            length if length.ends_with("_m") => 1e-8 * got["slide_path_m"].as_f64()?,
            _ => 0.0,
        };
        let is_same = match (expected.as_f64(), got[key].as_f64()) {
            // 1e-16: a slide that never began.
            (Some(expected), Some(got)) => (expected - got).abs() <= tolerance * amplification + 1e-16,
            _ => *expected == got[key],
        };
        if !is_same {
            return Some(format!("{key} is {}, not {expected}", got[key]));
        }
    }
    None
}

/// How many cases were compared, and how many are sensitive.
fn check(cases: &Value) -> (usize, usize) {
    let (mut done, mut sensitive, mut failures) = (0, 0, Vec::new());
    for case in cases["cases"].as_array().unwrap().iter() {
        if case.get("kind").is_some_and(|kind| kind != "slide") {
            continue;
        }
        let got = solve(case);
        if case["sensitive"] == true {
            sensitive += 1;
            failures.extend(got.err().map(|error| format!("{}: {error}", case["id"])));
            continue;
        }
        done += 1;
        let difference = got.map_or_else(Some, |got| difference(case, &got));
        failures.extend(difference.map(|what| format!("{} ({}): {what}", case["id"], case["group"])));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    (done, sensitive)
}

#[test]
fn every_slide_through_the_command_line() {
    let cases = serde_json::from_str(include_str!("../../../validation/sliding/sliding_cases.json")).unwrap();
    let (done, sensitive) = check(&cases);
    println!("{done} slides, {sensitive} sensitive ones left out");
    assert!(done >= 40, "only {done} cases ran");
}

#[test]
fn every_slide_of_the_shared_folder() {
    let path = shared().join("cases/object_cases.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: {} is not there ($FREESTAND_SHARED)", path.display());
        return;
    };
    let (done, sensitive) = check(&serde_json::from_str(&text).unwrap());
    println!("{done} slides, {sensitive} sensitive ones left out");
    assert!(done >= 20, "only {done} cases ran");
}
