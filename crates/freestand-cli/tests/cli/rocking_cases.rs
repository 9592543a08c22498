//! Every history that was solved to 160 bits, through the command line at `standard` accuracy.
//!
//! The library's own run of these cases, at every accuracy, is in `freestand-study`; this one holds
//! the flags, the reading of the records and the JSON.

use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use crate::program::{self, PROGRAM, shared};

/// A record of the repository, or of the shared folder.
fn record(name: &str) -> Option<PathBuf> {
    let file = format!("{name}.csv");
    [
        program::record(name),
        shared().join("cases/records").join(file),
    ]
    .into_iter()
    .find(|path| path.exists())
}

/// The command of a case; `None` where its record is missing.
fn command(case: &Value) -> Option<Command> {
    let path = record(case["record"].as_str().unwrap())?;
    let number = |key: &str| case.get(key).and_then(Value::as_f64);
    let mut command = Command::new(PROGRAM);
    command
        .args(["rock", "--json", "--quiet", "--motion"])
        .arg(&path);
    let mut flag = |flag: &str, value: Option<f64>, unit: &str| {
        if let Some(value) = value {
            command.arg(flag).arg(format!("{value}{unit}"));
        }
    };
    flag("--height", number("h"), " m");
    flag("--thickness", number("t"), " m");
    flag("--scale", number("scale"), "");
    flag("--restitution", number("r"), "");
    flag("--gravity", number("g"), " m/s2");
    flag("--initial-rotation", number("theta0"), " rad");
    flag("--initial-velocity", number("omega0"), " rad/s");
    flag("--vertical-scale", number("scale_v"), "");
    // The cases end with their records.
    flag(
        "--duration",
        case["final"]["t"]
            .as_f64()
            .filter(|_| case["overturned"] == false),
        " s",
    );
    if number("scale_v").is_some() {
        command
            .args([
                "--component",
                "1",
                "--vertical-component",
                "2",
                "--vertical",
            ])
            .arg(&path);
    }
    if case["group"].as_str().unwrap().contains("lin") && case["group"] != "nonlinear" {
        command.args(["--model", "linear"]);
    }
    Some(command)
}

#[test]
#[ignore = "seconds: a process for every case"]
fn cases_through_the_command_line() {
    through_the_command_line(8);
}

#[test]
#[ignore = "ten seconds: hundreds of commands"]
fn every_case_through_the_command_line() {
    through_the_command_line(1);
}

/// Every so many-th case.
#[expect(
    clippy::print_stdout,
    reason = "a test says what it skips on its standard output"
)]
fn through_the_command_line(step: usize) {
    let cases: Value = serde_json::from_str(include_str!(
        "../../../../validation/rocking/rocking_cases.json"
    ))
    .unwrap();
    let (mut done, mut skipped) = (0, 0);
    let mut failures = Vec::new();
    for case in cases["cases"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|case| case["sensitive"] == false)
        .step_by(step)
    {
        let id = &case["id"];
        let Some(mut command) = command(case) else {
            skipped += 1;
            continue;
        };
        done += 1;
        let output = command.output().unwrap();
        let Ok(got) = serde_json::from_slice::<Value>(&output.stdout) else {
            failures.push(format!("{id}: {}", String::from_utf8_lossy(&output.stderr)));
            continue;
        };
        let peak = case["theta_max"].as_f64().unwrap();
        let outcome = match case["overturned"].as_bool().unwrap() {
            true => "overturned",
            false if case["final"]["at_rest"] == false => "unresolved",
            false if peak > 0.0 => "rocked",
            false => "no-uplift",
        };
        if got["outcome"] != outcome {
            failures.push(format!("{id}: {} instead of {outcome}", got["outcome"]));
            continue;
        }
        // 1e-8 of the rotation and 1e-8 s: what `standard` promises.
        if (got["peak_rotation_rad"].as_f64().unwrap() - peak).abs() > 1e-8 * peak {
            failures.push(format!(
                "{id}: {} instead of {peak}",
                got["peak_rotation_rad"]
            ));
        }
        let strong = got["impacts"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|i| i["omega_before_rad_s"].as_f64().unwrap().abs() >= 1e-3);
        if Some(strong.count() as u64) != case["n_impacts"]["0.001"].as_u64() {
            failures.push(format!(
                "{id}: not {} impacts at 1e-3 rad/s and above",
                case["n_impacts"]["0.001"]
            ));
        }
        for (expected, impact) in case["impacts"]
            .as_array()
            .unwrap()
            .iter()
            .zip(got["impacts"].as_array().unwrap())
        {
            if (expected["t"].as_f64().unwrap() - impact["time_s"].as_f64().unwrap()).abs() > 1e-8 {
                failures.push(format!(
                    "{id}: an impact at {} instead of {}",
                    impact["time_s"], expected["t"]
                ));
            }
        }
    }
    if skipped > 0 {
        println!(
            "skipped: {skipped} cases whose record is not in $FREESTAND_SHARED/cases/records (../shared)"
        );
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    let all = done + skipped;
    assert!(
        all * step >= 300 && done > skipped,
        "only {done} of {all} cases ran"
    );
}
