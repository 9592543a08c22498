//! Records: read, measured, drawn, written, and refused.

use std::path::Path;

use crate::program::{execute, json, shared};
use crate::{RECORD, cases, folder, freestand_in};

#[test]
fn motion_info_and_spectrum() {
    let folder = folder(&[("pulse.csv", RECORD)]);
    let all = [
        freestand_in(folder.path(), &["motion", "info", "pulse.csv", "--json"]),
        freestand_in(
            folder.path(),
            &["motion", "info", "pulse.csv", "--scale", "-2"],
        ),
        freestand_in(
            folder.path(),
            &[
                "motion",
                "spectrum",
                "pulse.csv",
                "--periods",
                "0 s, 1 s",
                "--upsample",
                "10",
            ],
        ),
        freestand_in(
            folder.path(),
            &["motion", "convert", "pulse.csv", "--to", "csv"],
        ),
    ];
    cases::each("motion_info_and_spectrum", &all);
}

/// The block of 2 m × 0.5 m uplifts at 0.25 g.
#[test]
fn motion_info_of_several_and_for_a_block() {
    let two = "time [s],ns [g],up [g]\n0,0,0\n0.25,0.5,0.1\n0.5,0,-0.1\n0.75,-0.5,0\n1,0,0\n";
    let folder = folder(&[("pulse.csv", RECORD), ("two.csv", two)]);
    let block = ["--height", "2 m", "--thickness", "0.5 m"];
    let info = |more: &[&str]| freestand_in(folder.path(), &[&["motion", "info"], more].concat());
    let all = [
        info(&["two.csv", "pulse.csv"]),
        info(&[&["two.csv", "pulse.csv"], &block[..]].concat()),
        info(&[&["two.csv", "--component", "ns"], &block[..]].concat()),
        info(&["two.csv", "--height", "2 m"]),
        info(&["two.csv", "--height", "-2 m", "--thickness", "0.5"]),
        info(&["two.csv", "gone.csv", "none.csv"]),
        freestand_in(
            folder.path(),
            &[
                "motion",
                "spectrum",
                "pulse.csv",
                "--damping",
                "2 %, 5 %",
                "--periods",
                "1 s, 2 s",
            ],
        ),
    ];
    cases::each("motion_info_of_several_and_for_a_block", &all);
}

/// Of many files the broken ones are listed and hide nothing else: exit status 1. Where nothing is
/// left: 2.
#[test]
fn motion_info_goes_on_behind_broken_files() {
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("nan.csv", "time [s],a [g]\n0,0\n0.1,nan\n0.2,0\n"),
        (
            "two.csv",
            "time [s],ns [g],up [g]\n0,0,0\n0.25,0.5,0.1\n0.5,0,-0.1\n0.75,-0.5,0\n1,0,0\n",
        ),
    ]);
    let info = |args: &[&str]| freestand_in(folder.path(), &[&["motion", "info"], args].concat());
    let all = [
        info(&["pulse.csv", "nan.csv", "two.csv", "gone.csv"]),
        info(&["nan.csv", "pulse.csv", "--quiet"]),
        info(&["nan.csv", "gone.csv"]),
        info(&["nan.csv"]),
    ];
    cases::each("motion_info_goes_on_behind_broken_files", &all);
    let shown = info(&["nan.csv", "pulse.csv", "two.csv", "--out", "out", "--json"]);
    assert!(shown.contains("exit status 1\n"), "{shown}");
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    assert_eq!(read("measures.csv").lines().count(), 4);
    let json: serde_json::Value = serde_json::from_str(&read("result.json")).unwrap();
    let failed = json["failed"].as_array().unwrap();
    assert_eq!(
        (failed.len(), json["motions"].as_array().unwrap().len()),
        (1, 3)
    );
    assert_eq!(
        (failed[0]["path"].as_str(), failed[0]["hint"].is_string()),
        (Some("nan.csv"), true)
    );
    assert!(
        failed[0]["reason"]
            .as_str()
            .unwrap()
            .starts_with("line 3: "),
        "{failed:?}"
    );
}

#[test]
#[ignore = "seconds: a picture of every kind"]
fn pictures_of_motions_go_where_they_are_sent() {
    let two = "time [s],ns [g],up [g]\n0,0,0\n0.25,0.5,0.1\n0.5,0,-0.1\n0.75,-0.5,0\n1,0,0\n";
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("two.csv", two),
        ("record.svg", RECORD),
    ]);
    let motion = |args: &[&str]| freestand_in(folder.path(), &[&["motion"], args].concat());
    let all = [
        motion(&["info", "pulse.csv", "--plot"]),
        motion(&["info", "--plot", "pulse.csv", "two.csv"]),
        motion(&["info", "pulse.csv", "two.csv", "--plot", "x.svg"]),
        motion(&["info", "two.csv", "--plot", "x.svg"]),
        motion(&["info", "record.svg", "--plot", "record.svg"]),
        motion(&["spectrum", "record.svg", "--plot", "record.svg"]),
    ];
    cases::each("pictures_of_motions_go_where_they_are_sent", &all);
    // Nothing was written by what was refused.
    assert_eq!(names(folder.path()), ["pulse.csv", "record.svg", "two.csv"]);
    assert_eq!(
        std::fs::read_to_string(folder.path().join("record.svg")).unwrap(),
        RECORD
    );

    motion(&["info", "two.csv", "--component", "up", "--plot", "up.svg"]);
    motion(&["spectrum", "pulse.csv", "--plot", "s.PNG", "--json"]);
    let json = motion(&[
        "info",
        "two.csv",
        "pulse.csv",
        "--plot",
        "--out",
        "out",
        "--json",
    ]);
    assert!(
        std::fs::read(folder.path().join("up.svg"))
            .unwrap()
            .starts_with(b"<svg")
    );
    assert!(
        std::fs::read(folder.path().join("s.PNG"))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    let pictures = [
        "pulse.png",
        "pulse.svg",
        "two_ns.png",
        "two_ns.svg",
        "two_up.png",
        "two_up.svg",
    ];
    let mut expected = vec!["manifest.json", "measures.csv", "result.json"];
    expected.extend(pictures);
    expected.sort_unstable();
    assert_eq!(names(&folder.path().join("out")), expected);
    assert!(
        pictures
            .iter()
            .all(|name| json.contains(&format!("\"out/{name}\""))),
        "{json}"
    );
}

fn names(path: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(path)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort_unstable();
    names
}

#[test]
fn broken_records_are_refused() {
    let folder = folder(&[
        ("empty.csv", ""),
        ("nan.csv", "time [s],a [g]\n0,0\n0.1,nan\n0.2,0\n"),
        ("one.csv", "time [s],a [g]\n0,1\n"),
        ("bare.csv", "0 0\n0.1 1\n0.2 0\n"),
        ("two.csv", "time [s],x [g],y [g]\n0,0,0\n0.1,1,2\n0.2,0,0\n"),
    ]);
    let all = [
        freestand_in(
            folder.path(),
            &[
                "motion",
                "info",
                "empty.csv",
                "nan.csv",
                "one.csv",
                "bare.csv",
                "gone.csv",
                ".",
            ],
        ),
        freestand_in(folder.path(), &["motion", "spectrum", "two.csv"]),
    ];
    cases::each("broken_records_are_refused", &all);
}

/// A factor of zero makes a motion of nothing, from a flag as from a study; wrong flags are said
/// once, not per file.
#[test]
fn wrong_reading_flags_are_refused() {
    let study = "[ground]\nmotions = \"pulse.csv\"\nscale = 0\n";
    let folder = folder(&[("pulse.csv", RECORD), ("study.toml", study)]);
    let all = [
        freestand_in(
            folder.path(),
            &["motion", "info", "pulse.csv", "--scale", "0"],
        ),
        freestand_in(folder.path(), &["check", "study.toml"]),
        freestand_in(
            folder.path(),
            &[
                "motion",
                "info",
                "pulse.csv",
                "pulse.csv",
                "--unit",
                "furlong",
                "--dt",
                "1000 s",
            ],
        ),
    ];
    cases::each("wrong_reading_flags_are_refused", &all);
}

/// Times are counted from the first sample in what is written, and that the start is lost is said
/// where it is.
#[test]
fn a_start_that_is_not_kept_is_said() {
    let late = "time [s],N [g],E [g]\n12.5,0,0\n12.75,0.5,0.1\n13,0,0\n";
    let folder = folder(&[("late.csv", late), ("pulse.csv", RECORD)]);
    let motion = |args: &[&str]| freestand_in(folder.path(), &[&["motion"], args].concat());
    let all = [
        motion(&["convert", "late.csv", "--to", "csv", "--component", "N"]),
        motion(&["rotate", "late.csv", "--to", "0 deg"]),
        motion(&["convert", "pulse.csv", "--to", "csv"]),
    ];
    cases::each("a_start_that_is_not_kept_is_said", &all);
    // Nothing is written by others, and so nothing is lost.
    let spectrum = motion(&[
        "spectrum",
        "late.csv",
        "--component",
        "N",
        "--periods",
        "5 s",
    ]);
    assert!(!spectrum.contains("not kept"), "{spectrum}");
}

/// The study that shakes one object with records; its warnings.
fn warnings_of(folder: &Path, motions: &[String]) -> Vec<String> {
    let study = format!("[ground]\nmotions = {motions:?}\nunit = \"g\"\n[building]\nstoreys = 3\n");
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let document = json(&execute(folder, &["check", "study.toml", "--json"]));
    document["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|text| text.as_str().unwrap().to_owned())
        .collect()
}

/// What many records have in common is one warning with their number, and another thing is another one.
#[test]
fn many_records_give_one_warning_of_a_kind() {
    let folder = folder(&[]);
    // A shaking that does not end at rest, in the files from the 13th on.
    let text = |number: usize| -> String {
        let last = if number > 12 { 0.1 } else { -0.4 };
        let accel = [
            0.0,
            0.01 * number as f64,
            0.4 - 0.01 * number as f64,
            last,
            last,
            last,
            last,
        ];
        let rows = accel.iter().chain(&[0.0; 60]).enumerate();
        rows.map(|(row, a)| format!("{:.2} {a:.3}\n", 0.05 * row as f64))
            .collect()
    };
    let names: Vec<String> = (1..=24).map(|number| format!("R{number:02}.txt")).collect();
    for (number, name) in (1..).zip(&names) {
        std::fs::write(folder.path().join(name), text(number)).unwrap();
    }
    let of = |kind: &str, warnings: &[String]| {
        warnings
            .iter()
            .filter(|text| text.contains(kind))
            .cloned()
            .collect()
    };
    let warnings = warnings_of(folder.path(), &names);
    let time: Vec<String> = of("read as time", &warnings);
    let words = "a column without a unit is read as time in seconds in 24 records: R01, R02, R03 and 21 more";
    assert!(
        time.len() == 1 && time[0].starts_with(words),
        "{warnings:#?}"
    );
    let moving: Vec<String> = of("does not stop", &warnings);
    assert_eq!(moving.len(), 1, "{warnings:#?}");
    // One record has its own sentence.
    let alone = warnings_of(folder.path(), &names[..1]);
    assert!(
        alone.contains(&"R01: the first column is read as time in seconds".to_owned()),
        "{alone:?}"
    );
}

/// The 44 components of FEMA P-695.
#[test]
fn many_recorded_motions_give_few_warnings() {
    let records = shared().join("records/p695");
    let Ok(entries) = std::fs::read_dir(&records) else {
        println!(
            "skipped: {} is not there ($FREESTAND_SHARED)",
            records.display()
        );
        return;
    };
    let paths: Vec<String> = entries
        .map(|entry| entry.unwrap().path().to_string_lossy().into_owned())
        .collect();
    let paths: Vec<String> = paths
        .into_iter()
        .filter(|path| path.ends_with(".txt"))
        .collect();
    let warnings = warnings_of(folder(&[]).path(), &paths);
    let time: Vec<&String> = warnings
        .iter()
        .filter(|text| text.contains("read as time"))
        .collect();
    assert!(
        time.len() == 1 && time[0].contains(" in 44 records: "),
        "{warnings:#?}"
    );
}

/// Nobody writes into the pipe: to open it would wait for ever.
#[cfg(unix)]
#[test]
fn a_named_pipe_is_refused_wherever_a_file_is_named() {
    let folder = folder(&[]);
    assert!(
        std::process::Command::new("mkfifo")
            .arg(folder.path().join("pipe"))
            .status()
            .unwrap()
            .success()
    );
    for args in [
        &["motion", "info", "pipe"][..],
        &["check", "pipe"],
        &["inventory", "check", "pipe"],
        &["cushion", "drop", "pipe"],
        &["risk", "--fragility", "pipe", "--hazard", "pipe"],
    ] {
        let shown = freestand_in(folder.path(), args);
        assert!(
            shown.contains("pipe: is a named pipe") && shown.contains("give a regular file"),
            "{args:?}: {shown}"
        );
    }
}
