//! Objects that slide or roll, through the command line: slides that were solved in 160-bit arithmetic
//! (`validation/sliding`), those of the shared folder where it is present, `spectrum`, what is refused.

use std::process::{Command, Output};

use serde_json::Value;

use crate::program::{PROGRAM, json, record, shared, to_its_end};

fn solve(case: &Value) -> Result<Value, String> {
    let path = record(case["record"].as_str().unwrap());
    let text = std::fs::read_to_string(&path).unwrap();
    let dt = text
        .split_whitespace()
        .find_map(|word| word.strip_prefix("dt="))
        .unwrap()
        .to_owned();
    let mut command = Command::new(PROGRAM);
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
    command.arg(to_its_end(&path));
    let output = command.args(["--json", "--quiet"]).output().unwrap();
    serde_json::from_slice(&output.stdout)
        .map_err(|_| String::from_utf8_lossy(&output.stderr).into_owned())
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
            (Some(expected), Some(got)) => {
                (expected - got).abs() <= tolerance * amplification + 1e-16
            }
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
        failures
            .extend(difference.map(|what| format!("{} ({}): {what}", case["id"], case["group"])));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    (done, sensitive)
}

#[test]
#[ignore = "seconds: a process for every case"]
fn every_slide_through_the_command_line() {
    let cases = serde_json::from_str(include_str!(
        "../../../../validation/sliding/sliding_cases.json"
    ))
    .unwrap();
    let (done, sensitive) = check(&cases);
    println!("{done} slides, {sensitive} sensitive ones left out");
    assert!(done >= 40, "only {done} cases ran");
}

#[test]
#[ignore = "seconds: a process for every case"]
fn every_slide_of_the_shared_folder() {
    let path = shared().join("cases/object_cases.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!(
            "skipped: {} is not there ($FREESTAND_SHARED)",
            path.display()
        );
        return;
    };
    let (done, sensitive) = check(&serde_json::from_str(&text).unwrap());
    println!("{done} slides, {sensitive} sensitive ones left out");
    assert!(done >= 20, "only {done} cases ran");
}

/// `freestand` with these arguments after the record `decsine_f1.25`, times 4.
fn strongly(command: &str, args: &[&str]) -> Output {
    let mut freestand = Command::new(PROGRAM);
    freestand
        .args([command, "--quiet", "--scale", "4", "--motion"])
        .arg(record("decsine_f1.25"));
    freestand.args(args).output().unwrap()
}

/// The slide of a row is that of `rock` to the bit; an object that would rock on braked casters has the
/// row of one that rocks.
#[test]
fn a_spectrum_of_sliding_objects_has_the_slides_of_rock() {
    let casters = [
        "--casters",
        "--brakes",
        "--friction",
        "0.25",
        "--clearance-left",
        "20 mm",
    ];
    let grid = ["--heights", "1 m, 2 m", "--thicknesses", "0.4 m", "--json"];
    let rows = json(&strongly("spectrum", &[&grid[..], &casters].concat()));
    let plain = json(&strongly("spectrum", &grid));
    let alone = json(&strongly(
        "rock",
        &[
            &casters[..],
            &["--height", "1 m", "--thickness", "0.4 m", "--json"],
        ]
        .concat(),
    ));
    let (slides, rocks) = (&rows["rows"][0], &rows["rows"][1]);
    for key in [
        "outcome",
        "slide_peak_m",
        "slide_speed_max_m_s",
        "clearance_time_s",
        "clearance_speed_m_s",
    ] {
        assert_eq!(slides[key], alone[key], "{key}");
    }
    assert_eq!(
        (&slides["outcome"], &rocks["outcome"]),
        (&Value::from("slid"), &Value::from("rocked"))
    );
    assert!(slides["clearance_time_s"].is_number() && rocks["slide_peak_m"].is_null());
    for key in ["peak_rotation_rad", "impact_count", "uplift_m"] {
        assert_eq!(rocks[key], plain["rows"][1][key], "{key}");
    }
    // With --sliding the second object is a row with a reason, and the status says so.
    let output = strongly(
        "spectrum",
        &[&grid[..], &["--sliding", "--friction", "0.25"]].concat(),
    );
    assert_eq!(output.status.code(), Some(1));
    let row = &json(&output)["rows"][1];
    assert_eq!(row["outcome"], "failed");
    assert!(
        row["reason"]
            .as_str()
            .unwrap()
            .contains("an edge lifts before the object slides"),
        "{row}"
    );
}

#[test]
fn a_history_and_a_figure_of_the_slide_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (csv, svg) = (path("h.csv"), path("h.svg"));
    let size = [
        "--casters",
        "--height",
        "1 m",
        "--thickness",
        "0.4 m",
        "--clearance-right",
        "0.1 m",
        "--json",
    ];
    let got = json(&strongly(
        "rock",
        &[&size[..], &["--history", &csv, "--plot", &svg]].concat(),
    ));
    let table = std::fs::read_to_string(&csv).unwrap();
    assert!(
        table.starts_with("time_s,slide_m,velocity_m_s,base_accel_m_s2\n0,0,0,0\n"),
        "{table:.200}"
    );
    let last: Vec<f64> = table
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|field| field.parse().unwrap())
        .collect();
    assert_eq!(
        (Some(last[0]), Some(last[1])),
        (got["end_time_s"].as_f64(), got["slide_final_m"].as_f64())
    );
    let svg = std::fs::read_to_string(&svg).unwrap();
    assert!(svg.contains("Slide (mm)") && svg.contains("clearance"));
    assert_eq!(
        got["warnings"][3],
        "the rolling resistance of 0.02 is assumed: `rolling_resistance` replaces it"
    );
}

/// v √(k_s/m) at the first clearance, with the values given.
#[test]
fn a_stop_has_a_shock() {
    let size = [
        "--casters",
        "--height",
        "1 m",
        "--thickness",
        "0.4 m",
        "--clearance-left",
        "5 mm",
        "--clearance-right",
        "5 mm",
        "--json",
    ];
    let stop = ["--mass", "120 kg", "--stop-stiffness", "50 N/mm"];
    let got = json(&strongly("rock", &[&size[..], &stop].concat()));
    let speed_m_s = got["clearance_speed_m_s"].as_f64().unwrap();
    let expected = speed_m_s.abs() * (5e4f64 / 120.0).sqrt() / 9.80665;
    let shock_g = got["stop_acceleration_g"].as_f64().unwrap();
    assert!(
        speed_m_s.abs() > 0.01 && (shock_g / expected - 1.0).abs() < 1e-12,
        "{shock_g} {expected}"
    );
    let without = json(&strongly("rock", &size));
    assert!(without["stop_acceleration_g"].is_null() && without["clearance_speed_m_s"].is_number());
}

/// Exit status 2, the cause, and what to do.
#[test]
fn what_does_not_slide_is_refused() {
    let size = ["--height", "1 m", "--thickness", "0.4 m"];
    for (args, cause, hint) in [
        (
            &["--sliding"][..],
            "an edge lifts before the object slides",
            "use --base compliant with --friction",
        ),
        (
            &[
                "--sliding",
                "--friction",
                "0.2",
                "--friction-kinetic",
                "0.3",
            ],
            "the kinetic one at most the static one",
            "give a --friction-kinetic of at most --friction",
        ),
        (
            &["--sliding", "--friction", "0.2", "--clearance-left=-1 mm"],
            "must be 0 or more",
            "give a length of 0 or more",
        ),
        (
            &["--clearance-left", "1 mm"],
            "applies only to objects that slide or roll",
            "add --sliding",
        ),
        (
            &["--sliding", "--base", "compliant"],
            "applies only to a rigid base",
            "--friction decides",
        ),
        (
            &["--casters", "--model", "linear"],
            "applies only to an object that rocks",
            "leave it out",
        ),
        (
            &["--casters", "--initial-rotation", "1 deg"],
            "applies only to an object that rocks",
            "leave it out",
        ),
        (
            &["--sliding", "--friction", "0.2", "--wall-gap", "5 cm"],
            "applies only to an object that rocks",
            "--clearance-left",
        ),
        (
            &["--casters", "--wall-stiffness", "5 N/mm"],
            "applies only to an object that rocks",
            "--stop-stiffness",
        ),
        (
            &["--casters", "--stop-stiffness", "5 N/mm", "--mass", "9 kg"],
            "there is no stop",
            "give --clearance-left",
        ),
        (
            &[
                "--casters",
                "--stop-stiffness",
                "5 N/mm",
                "--clearance-left",
                "1 m",
            ],
            "also needs the mass of the object",
            "add --mass",
        ),
        (
            &[
                "--sliding",
                "--friction",
                "0.1",
                "--rolling-resistance",
                "0.1",
            ],
            "--rolling-resistance applies only to an object on casters",
            "in place of --sliding",
        ),
        (
            &["--sliding", "--friction", "0.1", "--brakes"],
            "--brakes applies only to an object on casters",
            "leave it out",
        ),
        (
            &["--casters", "--friction", "0.1"],
            "and these roll",
            "give --rolling-resistance, or add --brakes",
        ),
        (
            &["--casters", "--rolling-resistance", "0.5"],
            "an edge lifts before the object rolls",
            "a smaller --rolling",
        ),
        (
            &["--sliding", "--width", "1 m", "--friction", "0.1"],
            "--width applies only to an object that slides under both components",
            "add --motion-y or --components",
        ),
        (
            &["--upper-height", "1 m"],
            "applies only to a compliant base",
            "add --base compliant",
        ),
        (
            &["--wall-gap", "1 cm", "--initial-rotation=-5deg"],
            "cannot start beyond it",
            "",
        ),
        (&["--slope", "1 deg"], "unexpected argument", ""),
        (
            &["--stop-stiffness", "5 N/mm"],
            "applies only to objects that slide or roll",
            "add --sliding",
        ),
        (
            &["--sliding", "--casters"],
            "exclude each other",
            "keep one of them",
        ),
    ] {
        let output = strongly("rock", &[&size[..], args].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            error.contains(cause) && error.contains(hint),
            "{args:?}: {error}"
        );
    }
}

/// Twice the same motion is √2 times it along the diagonal, and so is one motion under an object that is turned by
/// 45°: what the exact solver finds along a line, within what its stepped sibling documents (1 mm and 0.2 %).
#[test]
fn two_components_slide_as_their_sum() {
    let size = [
        "--sliding",
        "--friction",
        "0.2",
        "--height",
        "0.8 m",
        "--thickness",
        "0.6 m",
        "--json",
    ];
    let path = record("decsine_f1.25");
    let path = path.to_str().unwrap();
    let ask = |scale: &str, more: &[&str]| -> Value {
        let mut freestand = Command::new(PROGRAM);
        freestand.args(["rock", "--quiet", "--scale", scale, "--motion", path]);
        json(&freestand.args(size).args(more).output().unwrap())
    };
    let number = |document: &Value, key: &str| document[key].as_f64().unwrap();
    let line = ask(&(4.0 * 2.0_f64.sqrt()).to_string(), &[]);
    let both = ask("4", &["--motion-y", path, "--clearance-left", "20 mm"]);
    let turned = ask(
        &(4.0 * 2.0_f64.sqrt()).to_string(),
        &["--orientation", "45 deg"],
    );
    let peak_m = number(&line, "slide_peak_m");
    assert!(peak_m.abs() > 0.05, "{line}");
    let is_near = |found: f64, exact: f64| (found - exact).abs() <= 1e-3 + 2e-3 * exact.abs();
    for (found, sense) in [(&both, 1.0), (&turned, -1.0)] {
        assert!(
            is_near(number(found, "slide_peak_m"), peak_m.abs()),
            "{found}"
        );
        assert!(is_near(
            number(found, "slide_path_m"),
            number(&line, "slide_path_m")
        ));
        let part_m = number(&line, "slide_final_m") / 2.0_f64.sqrt();
        assert!(is_near(number(found, "slide_final_x_m"), part_m), "{found}");
        // The axes of an object that is turned anticlockwise lie clockwise of the motion in it.
        assert!(
            is_near(number(found, "slide_final_y_m"), sense * part_m),
            "{found}"
        );
        let [left, right] = ["slide_left_m", "slide_right_m"].map(|key| number(found, key));
        assert!(
            is_near(left.max(right), peak_m.abs() / 2.0_f64.sqrt()),
            "{found}"
        );
    }
    // A wall that stands on the left is reached where the block comes 20 mm to the left.
    assert_eq!(
        number(&both, "slide_left_m") >= 0.02,
        both["clearance_time_s"].is_number()
    );
    assert!(number(&both, "clearance_speed_m_s") < 0.0, "{both}");
}

/// Under both components a narrower side counts too.
#[test]
fn a_block_slides_if_neither_side_is_too_narrow() {
    let path = record("decsine_f1.25");
    let path = path.to_str().unwrap();
    let of = |width: &str| {
        let mut freestand = Command::new(PROGRAM);
        freestand.args([
            "rock",
            "--quiet",
            "--motion",
            path,
            "--motion-y",
            path,
            "--sliding",
        ]);
        freestand.args([
            "--friction",
            "0.3",
            "--height",
            "0.8 m",
            "--thickness",
            "0.6 m",
            "--width",
            width,
        ]);
        freestand.output().unwrap()
    };
    let narrow = of("0.2 m");
    let said = String::from_utf8_lossy(&narrow.stderr);
    assert_eq!(narrow.status.code(), Some(2));
    assert!(
        said.contains("an edge lifts before the object slides"),
        "{said}"
    );
    assert_eq!(of("0.3 m").status.code(), Some(0));
}
