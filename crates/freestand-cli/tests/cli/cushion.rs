//! `freestand cushion` as it is called, on files that know nothing of the program.

use std::fmt::Write;

use serde_json::Value;

use crate::program::{document, execute, freestand_in, json, root};

/// The plate of 0.365 kg from 100 mm on 2190 N/mm: 349.808 g over 1.28255 ms, 60 samples of it,
/// with a zero line of 1 g and a wobble of 0.5 % in place of noise.
fn half_sine(top_g: f64) -> String {
    let mut text = String::from("time [ms],acceleration [g]\n");
    for i in 0..420 {
        let time_ms = f64::from(i) * 1.28255 / 60.0;
        let s = (time_ms - 3.9) / 1.28255;
        let pulse = if (0.0..1.0).contains(&s) {
            349.808 * (std::f64::consts::PI * s).sin()
        } else {
            0.0
        };
        let wobble = 2.4 * (f64::from(i * i) * 0.7).sin();
        writeln!(
            text,
            "{time_ms:.6},{:.3}",
            (1.0 + pulse + wobble).min(top_g)
        )
        .unwrap();
    }
    text
}

const KNOWN: [&str; 4] = ["--mass", "0.365 kg", "--height", "100 mm"];

#[test]
fn a_half_sine_gives_its_stiffness() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("drop.csv"), half_sine(1e9)).unwrap();
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &[&["cushion", "drop", "drop.csv"], &KNOWN[..]].concat()
    ));
    let output = execute(
        folder.path(),
        &[&["cushion", "drop", "drop.csv", "--json"], &KNOWN[..]].concat(),
    );
    let document = json(&output);
    let test = &document["tests"][0];
    assert_eq!(test["quality"]["flags"], Value::Array(Vec::new()));
    for name in [
        "fit",
        "peak_over_velocity",
        "contact_time",
        "velocity_over_compression",
        "energy",
    ] {
        // 2 % on the peak is what the wobble does to single estimates at most, twice that to their
        // stiffness.
        let most = if name == "fit" { 0.02 } else { 0.04 };
        assert!(
            (test["stiffness_n_m"][name].as_f64().unwrap() / 2.19e6 - 1.0).abs() < most,
            "{name}: {test}"
        );
    }
    let interval = &document["pooled"]["ci95_n_m"];
    assert!(
        interval[0].as_f64().unwrap() < 2.19e6 && 2.19e6 < interval[1].as_f64().unwrap(),
        "{interval}"
    );
}

/// Four pulses of the plate with 1.5 s between them, far longer than the 0.29 s of a bounce from
/// 100 mm: read as one drop, they would have a restitution of 5.
#[test]
#[ignore = "ten seconds: many fits"]
fn several_drops_of_a_file_are_several_tests() {
    let folder = tempfile::tempdir().unwrap();
    let one = half_sine(1e9);
    let step_ms = 1.28255 / 60.0;
    let (mut text, mut row) = (String::from("time [ms],acceleration [g]\n"), 0);
    for _ in 0..4 {
        for _ in 0..(1500.0 / step_ms) as usize {
            writeln!(
                text,
                "{:.6},{:.3}",
                f64::from(row) * step_ms,
                1.0 + 2.4 * (f64::from(row) * 0.7).sin()
            )
            .unwrap();
            row += 1;
        }
        for line in one.lines().skip(1) {
            writeln!(
                text,
                "{:.6},{}",
                f64::from(row) * step_ms,
                line.split(',').nth(1).unwrap()
            )
            .unwrap();
            row += 1;
        }
    }
    std::fs::write(folder.path().join("four.csv"), text).unwrap();
    let output = execute(
        folder.path(),
        &[&["cushion", "drop", "four.csv", "--json"], &KNOWN[..]].concat(),
    );
    let found = json(&output);
    let tests = found["tests"].as_array().unwrap();
    assert_eq!(tests.len(), 4);
    for (i, test) in tests.iter().enumerate() {
        assert_eq!(test["drop"], i as i64 + 1);
        let start_s = 1.5 * (i as f64 + 1.0) + i as f64 * 420.0 * step_ms * 1e-3 + 3.9e-3;
        // The pulse has risen to a fifth 6 % of the contact later; rows between are rounded.
        assert!(
            (test["start_time_s"].as_f64().unwrap() - start_s).abs() < 3e-4,
            "{test}"
        );
        // 2190 N/mm to the wobble of 0.5 %.
        assert!((test["stiffness_n_m"]["fit"].as_f64().unwrap() / 2.19e6 - 1.0).abs() < 0.02);
        assert!(test["restitution_ratio"].as_f64().is_none_or(|e| e <= 1.0));
    }
    assert_eq!(found["pooled"]["count"], 4);
    assert!(
        found["warnings"][0]
            .as_str()
            .unwrap()
            .contains("the record has 4 drops")
    );
    let table = freestand_in(
        folder.path(),
        &[&["cushion", "drop", "four.csv"], &KNOWN[..]].concat(),
    );
    assert!(
        table
            .lines()
            .any(|line| line.starts_with("file") && line.contains("drop")),
        "{table}"
    );
}

#[test]
#[ignore = "seconds: several fits"]
fn a_bad_file_is_flagged_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("clipped.csv"), half_sine(300.0)).unwrap();
    std::fs::write(folder.path().join("good.csv"), half_sine(1e9)).unwrap();
    std::fs::write(
        folder.path().join("gap.csv"),
        "time [ms],acceleration [g]\n0,0\n1,nan\n2,0\n",
    )
    .unwrap();
    let run = |files: &[&str]| {
        execute(
            folder.path(),
            &[&["cushion", "drop", "--json"], files, &KNOWN[..]].concat(),
        )
    };
    let clipped = run(&["clipped.csv"]);
    assert_eq!(clipped.status.code(), Some(1));
    assert_eq!(json(&clipped)["tests"][0]["quality"]["flags"][0], "clipped");
    assert!(
        json(&clipped)["tests"][0]["stiffness_n_m"]["fit"].is_null()
            && json(&clipped)["pooled"]["ci95_n_m"].is_null()
    );
    let mixed = run(&["good.csv", "gap.csv"]);
    assert_eq!(mixed.status.code(), Some(1));
    assert_eq!(
        (
            json(&mixed)["tests"].as_array().unwrap().len(),
            json(&mixed)["pooled"]["count"].as_i64()
        ),
        (1, Some(1))
    );
    let none = run(&["gap.csv"]);
    assert_eq!((none.status.code(), none.stdout.len()), (Some(2), 0));
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["cushion", "drop", "good.csv", "--height", "0.1"]
    ));
}

/// A sensor that is mounted upside down, and a recorder that left out samples: the same pulse.
#[test]
#[ignore = "seconds: several fits"]
fn inverted_and_uneven_records_give_the_same_stiffness() {
    let folder = tempfile::tempdir().unwrap();
    let upright = half_sine(1e9);
    let (mut inverted, mut uneven) = (String::new(), String::new());
    for (i, line) in upright.lines().enumerate() {
        let (time, accel) = line.split_once(',').unwrap();
        match accel.parse::<f64>() {
            Ok(accel) => writeln!(inverted, "{time},{:.3}", -accel).unwrap(),
            Err(_) => writeln!(inverted, "{line}").unwrap(),
        }
        // A gap at the top of the pulse, where straight lines are wrong by (π/60)²/8 = 0.03 %, and some before it.
        if i % 50 != 13 {
            writeln!(uneven, "{line}").unwrap();
        }
    }
    for (name, text) in [
        ("up.csv", upright),
        ("down.csv", inverted),
        ("gaps.csv", uneven),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let run = |args: &[&str]| {
        execute(
            folder.path(),
            &[&["cushion", "drop", "--json"], args, &KNOWN[..]].concat(),
        )
    };
    let fit = |args: &[&str]| json(&run(args))["tests"][0]["stiffness_n_m"]["fit"].as_f64();
    let known_n_m = fit(&["up.csv"]).unwrap();
    assert_eq!(fit(&["down.csv", "--invert"]), Some(known_n_m));
    assert_eq!(fit(&["down.csv"]), None);
    assert_eq!(
        json(&run(&["down.csv"]))["tests"][0]["quality"]["flags"][0],
        "upside-down"
    );
    let refused = run(&["gaps.csv"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        String::from_utf8_lossy(&refused.stderr).contains("--resample"),
        "{refused:?}"
    );
    // A sixtieth of the samples are others, with another wobble of 0.5 %.
    let resampled_n_m = fit(&["gaps.csv", "--resample", "21.37583 us"]).unwrap();
    assert!(
        (resampled_n_m / known_n_m - 1.0).abs() < 0.005,
        "{resampled_n_m} {known_n_m}"
    );
}

#[test]
#[ignore = "seconds: drops from several heights"]
fn virtual_drops_become_a_cushion_of_an_edge() {
    let folder = tempfile::tempdir().unwrap();
    let simulate = [
        "cushion",
        "simulate",
        "--law",
        "hertz",
        "--stiffness",
        "2e7 N/m^1.5",
        "--exponent",
        "1.5",
    ];
    let more = [
        "--noise",
        "0.5%",
        "--bias",
        "2 g",
        "--sample-rate",
        "40 kHz",
        "--count",
        "2",
        "--out",
        "drops",
    ];
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &[&simulate[..], &KNOWN, &more].concat()
    ));
    // Mass and height stand in the files.
    let drop = [
        "cushion",
        "drop",
        "drops/drop-001.csv",
        "drops/drop-002.csv",
        "--out",
        "pad",
        "--json",
    ];
    let output = execute(folder.path(), &drop);
    assert_eq!(output.status.code(), Some(0));
    let pooled = &json(&output)["pooled"];
    // The noise of 0.5 % at 100 samples is 1 % of the exponent; three times that.
    assert!(
        (pooled["exponent"].as_f64().unwrap() - 1.5).abs() < 0.045,
        "{pooled}"
    );
    for name in [
        "cushion.toml",
        "loop-002.csv",
        "force_displacement.svg",
        "acceleration_displacement.png",
    ] {
        assert!(folder.path().join("pad").join(name).is_file(), "{name}");
    }
    let shock = [
        "shock",
        "--height",
        "2.3 m",
        "--thickness",
        "600 mm",
        "--mass",
        "140 kg",
        "--cg-rise",
        "16 mm",
    ];
    let cushion = [
        "--cushion",
        "pad/cushion.toml",
        "--pads-per-edge",
        "2",
        "--json",
    ];
    assert_eq!(
        execute(folder.path(), &[&shock[..], &cushion].concat())
            .status
            .code(),
        Some(0)
    );
}

#[test]
fn static_tests() {
    let folder = tempfile::tempdir().unwrap();
    // 1000 N/mm with 0.2 mm of slack up, and back 10 % of the force lower, in kN and mm.
    let mut text = String::from("# boundary: glued\nLVDT [mm],load [kN]\n");
    for i in 0..=100 {
        let d = f64::from(i) * 0.01;
        writeln!(text, "{:.3},{:.4}", d, (d - 0.2_f64).max(0.0)).unwrap();
    }
    for i in (0..100).rev() {
        let d = f64::from(i) * 0.01;
        writeln!(text, "{:.3},{:.4}", d, 0.9 * (d - 0.2_f64).max(0.0)).unwrap();
    }
    std::fs::write(folder.path().join("press.csv"), text).unwrap();
    let args = [
        "cushion",
        "static",
        "press.csv",
        "--load",
        "400 N",
        "--dynamic",
        "2190 N/mm",
    ];
    insta::assert_snapshot!(freestand_in(folder.path(), &args));
    let test = &json(&execute(folder.path(), &[&args[..], &["--json"]].concat()))["tests"][0];
    // Straight lines of printed numbers: rounding alone. The way out lies 10 % lower.
    assert!((test["tangent_stiffness_n_m"].as_f64().unwrap() / 1e6 - 1.0).abs() < 1e-6);
    // The slack is searched by least squares, which hide half of the digits.
    assert!((test["secant_stiffness_n_m"].as_f64().unwrap() / 1e6 - 1.0).abs() < 1e-4);
    // ∫F dd of the way in is 0.32 J; the jump to 90 % at the turn costs half a step of 8 N·mm of
    // it.
    assert!(
        (test["hysteresis_ratio"].as_f64().unwrap() - 0.1).abs() < 2e-3,
        "{test}"
    );
    // A press that writes compression as negative.
    let text = std::fs::read_to_string(folder.path().join("press.csv")).unwrap();
    let negative = |line: &str| match line.split_once(',') {
        Some((d, force)) if d.parse::<f64>().is_ok() => format!("-{d},-{force}\n"),
        _ => format!("{line}\n"),
    };
    std::fs::write(
        folder.path().join("negative.csv"),
        text.lines().map(negative).collect::<String>(),
    )
    .unwrap();
    let negative = [
        "cushion",
        "static",
        "negative.csv",
        "--load",
        "400 N",
        "--dynamic",
        "2190 N/mm",
        "--json",
    ];
    let inverted = json(&execute(
        folder.path(),
        &[&negative[..], &["--invert"]].concat(),
    ));
    assert_eq!(
        inverted["tests"][0]["tangent_stiffness_n_m"],
        test["tangent_stiffness_n_m"]
    );
    let refused = execute(folder.path(), &negative);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        String::from_utf8_lossy(&refused.stderr).contains("--invert"),
        "{refused:?}"
    );
    let heavy = execute(
        folder.path(),
        &["cushion", "static", "press.csv", "--load", "2 kN"],
    );
    assert_eq!(heavy.status.code(), Some(2));
}

/// A file and its user who say different things are not read in silence; what says the same is no news.
#[test]
#[ignore = "seconds: several drops"]
fn a_flag_that_contradicts_the_file_is_said() {
    let warnings = |flags: &[&str]| {
        let drop = ["cushion", "drop", "validation/cushion/drop-001.csv"];
        document(&root(), &[&drop[..], flags].concat())["warnings"].to_string()
    };
    let other = warnings(&["--mass", "0.5 kg", "--height", "5 in"]);
    assert!(
        other.contains("the file says mass 0.365 kg") && other.contains("0.5 kg, is used"),
        "{other}"
    );
    assert!(
        other.contains("the file says height 0.1 m") && other.contains("0.127 m, is used"),
        "{other}"
    );
    let same = warnings(&["--mass", "0.000365 t", "--height", "100 mm"]);
    assert!(!same.contains("the file says"), "{same}");
    // A drop of 100 mm ends with 1.4 m/s.
    assert!(!warnings(&["--impact-velocity", "1.35 m/s"]).contains("contradicts"));
    // A mass of 365 kg in place of grams gives what no pad has.
    assert!(warnings(&["--mass", "365 kg"]).contains("no pad is stiffer than 1e6 N/mm"));
}

/// Of two impact velocities in one file none is used in silence.
#[test]
fn a_file_that_contradicts_itself_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let drop = std::fs::read_to_string(root().join("validation/cushion/drop-001.csv")).unwrap();
    std::fs::write(
        folder.path().join("drop.csv"),
        format!("# impact velocity: 2.8 m/s\n{drop}"),
    )
    .unwrap();
    let output = execute(folder.path(), &["cushion", "drop", "drop.csv"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.code() == Some(2) && told.contains("gives 1.4 m/s"),
        "{told}"
    );
    let chosen = document(
        folder.path(),
        &["cushion", "drop", "drop.csv", "--height", "100 mm"],
    );
    assert!(
        chosen["warnings"]
            .to_string()
            .contains("the impact velocity in the file contradicts"),
        "{chosen}"
    );
}
