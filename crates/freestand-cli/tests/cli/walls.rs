//! Every case between walls that was solved to 160 bits, through the command line.
//!
//! The library's own run of these cases is in `freestand-study`; this one holds the flags, the
//! reading of the records and the JSON.

use std::process::Command;

use serde_json::Value;

use crate::program::{PROGRAM, record, to_its_end};

/// The document of a case.
fn run(case: &Value) -> Value {
    let mut command = Command::new(PROGRAM);
    let args: Vec<&str> = case["args"]
        .as_array()
        .unwrap()
        .iter()
        .map(|arg| arg.as_str().unwrap())
        .collect();
    let own = args
        .iter()
        .filter(|arg| !["rock", "--motion", "{horizontal}"].contains(arg));
    command.args(["rock", "--json", "--quiet"]).args(own);
    if let Some(name) = case["record"].as_str() {
        let path = record(name);
        command.arg("--motion").arg(&path).arg(to_its_end(&path));
        if args.iter().any(|arg| arg.starts_with("--vertical-scale")) {
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
    }
    let output = command.output().unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {words}", case["id"]);
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
#[ignore = "seconds: a process for every case"]
fn every_case_through_the_command_line() {
    let cases: Value =
        serde_json::from_str(include_str!("../../../../validation/walls/wall_cases.json")).unwrap();
    for case in cases["cases"].as_array().unwrap() {
        let (got, expect, id) = (run(case), &case["expect"], &case["id"]);
        // At the end of its record, a block that rocks is at rest or not.
        let is_moving = expect["outcome"] == "rocked" && expect["final_rotation_rad"] != 0.0;
        let outcome = if is_moving {
            &"unresolved".into()
        } else {
            &expect["outcome"]
        };
        assert_eq!(&got["outcome"], outcome, "{id}");
        // What `standard` promises, times how much the case amplifies errors.
        let bound = 1e-8 * case["amplification"].as_f64().unwrap().max(1.0);
        let near = |got: &Value, expect: &Value| match (got.as_f64(), expect.as_f64()) {
            (Some(got), Some(expect)) => (got - expect).abs() <= bound * expect.abs().max(1e-3),
            _ => got == expect,
        };
        for key in [
            "peak_rotation_rad",
            "wall_angle_left_rad",
            "wall_angle_right_rad",
            "restitution_ratio",
        ] {
            assert!(
                near(&got[key], &expect[key]),
                "{id}: {key} {} instead of {}",
                got[key],
                expect[key]
            );
        }
        let impacts = |document: &Value| document["wall_impacts"].as_array().unwrap().clone();
        assert_eq!(got["wall_impact_count"], impacts(&got).len(), "{id}");
        for (got, expect) in impacts(&got).iter().take(10).zip(impacts(expect)) {
            let omega = "omega_before_rad_s";
            // Later ones may follow one that was too slow to be listed.
            if got[omega].as_f64().unwrap().abs() < 1e-2 {
                break;
            }
            assert!(
                near(&got[omega], &expect[omega]),
                "{id}: {got} instead of {expect}"
            );
            assert_eq!(
                got["side"] == "right",
                got[omega].as_f64().unwrap() > 0.0,
                "{id}"
            );
        }
    }
}

#[test]
fn walls_that_make_no_sense_are_refused_with_a_hint() {
    let refused = |flags: &[&str]| {
        let mut command = Command::new(PROGRAM);
        command.args([
            "rock",
            "--height=2m",
            "--thickness=0.5m",
            "--duration=1s",
            "--initial-rotation=0.1rad",
        ]);
        let output = command.args(flags).output().unwrap();
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(2) && words.contains("\nhint: "),
            "{flags:?}: {words}"
        );
        words
    };
    assert!(refused(&["--wall-gap=-1mm"]).contains("must be 0 or more"));
    assert!(refused(&["--wall-gap=1m", "--wall-restitution=1"]).contains("less than 1"));
    assert!(refused(&["--wall-gap=1m", "--model=linear"]).contains("linearised"));
    assert!(refused(&["--wall-height=1m"]).contains("distance"));
    assert!(refused(&["--wall-gap=1m", "--wall-stiffness=2000N/mm"]).contains("mass"));
    assert!(refused(&["--wall-gap-right=10mm"]).contains("cannot start beyond it"));
    let on_cushions = |flags: &[&str]| {
        refused(
            &[
                &["--base=compliant", "--mass=9kg", "--stiffness=400N/mm"],
                flags,
            ]
            .concat(),
        )
    };
    let restitution = on_cushions(&["--wall-gap=1m", "--wall-restitution=0.3"]);
    assert!(
        restitution.contains("--wall-restitution applies only to a rigid base"),
        "{restitution}"
    );
    assert!(
        restitution.contains("follows from its cushion"),
        "{restitution}"
    );
    assert!(
        on_cushions(&["--wall-gap=1m", "--wall-height=1m", "--shape=cylinder"])
            .contains("a cylinder at a wall lower than it is not modelled")
    );
    assert!(on_cushions(&["--wall-stiffness=400N/mm"]).contains("there is no wall"));
    assert!(
        on_cushions(&["--wall-gap=1m", "--upper-height=1m"]).contains("does not apply to a stack")
    );
    let power = on_cushions(&[
        "--law=hunt-crossley",
        "--dissipation=0.3s/m",
        "--wall-gap=1m",
        "--wall-stiffness=9N/mm",
    ]);
    assert!(
        power.contains(
            "--wall-stiffness or --wall-damping alone does not describe a cushion of the law"
        ),
        "{power}"
    );
}

/// Both solvers between the same walls, with an elastic wall as stiff as what they assume: the same
/// angles of contact, and speeds at the walls within a third. The foot of the rigid base does not
/// lift, that on cushions does.
#[test]
fn walls_on_cushions_are_a_second_opinion() {
    let document = |flags: &[&str]| -> Value {
        let mut command = Command::new(PROGRAM);
        command.args([
            "rock",
            "--json",
            "--quiet",
            "--scale=6",
            "--height=1.8m",
            "--thickness=0.4m",
            "--mass=100kg",
        ]);
        command.args([
            "--wall-gap-left=30mm",
            "--wall-gap-right=200mm",
            "--wall-stiffness=2000N/mm",
            "--motion",
        ]);
        let output = command
            .arg(record("synthfloor"))
            .args(flags)
            .output()
            .unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let number = |document: &Value, key: &str| document[key].as_f64().unwrap();
    let rigid = document(&[]);
    let cushions = [
        "--base=compliant",
        "--stiffness=4000N/mm",
        "--law=kelvin-voigt",
        "--damping=5%",
    ];
    let plane = document(&cushions);
    for key in ["wall_angle_left_rad", "wall_angle_right_rad"] {
        assert_eq!(rigid[key], plane[key], "{key}");
    }
    for key in ["wall_speed_max_m_s", "wall_acceleration_g"] {
        let ratio = number(&plane, key) / number(&rigid, key);
        assert!((ratio - 1.0).abs() < 0.33, "{key}: {ratio}");
    }
    assert_eq!(
        (&plane["model"], &plane["width_m"]),
        (&Value::from("compliant"), &Value::Null)
    );
    // In three dimensions, shaken along the thickness alone, it moves as in the plane: 1e-6 of the
    // solver, times what its impacts on walls amplify.
    let space = document(&[&cushions[..], &["--width=600mm"]].concat());
    let [got, expect] = [&space, &plane].map(|document| number(document, "peak_tilt_rad"));
    assert!((got / expect - 1.0).abs() < 1e-4, "{got} {expect}");
    assert_eq!(space["model"], "compliant-3d");
}
