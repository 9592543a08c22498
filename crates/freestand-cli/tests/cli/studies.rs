//! Studies: checked, dumped, run again and stopped.

use std::process::Command;

use crate::program::{command, execute};
use crate::{RECORD, SMALL, cases, expect, folder, freestand, freestand_in};

#[test]
fn check_explains_the_built_in_study() {
    insta::assert_snapshot!(freestand(&["check"]));
}

#[test]
fn check_reports_every_problem_with_its_line() {
    let study = "[ground]\ncity = \"Melborne\"\nreturn_period = 500\n\n[objects]\nmass = 150\nheights = \"3 m:1\"\n";
    let folder = folder(&[
        ("study.toml", study),
        ("broken.toml", "[ground\ncount = 3\n"),
    ]);
    let all = [
        freestand_in(folder.path(), &["check", "study.toml"]),
        freestand_in(folder.path(), &["check", "broken.toml"]),
        freestand_in(folder.path(), &["check", "gone.toml"]),
        freestand_in(folder.path(), &["check", "."]),
    ];
    cases::each("check_reports_every_problem_with_its_line", &all);
}

#[test]
fn a_study_behind_the_records_is_told_from_a_record() {
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("study.toml", "[building]\nstoreys = 4\n"),
    ]);
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["run", "--motion", "pulse.csv", "study.toml"]
    ));
}

/// Ctrl-C and `kill`: one line, and nothing left behind.
#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_leaves_nothing() {
    use std::time::{Duration, Instant};
    let slow = "[ground]\ncount = 1000\n[objects]\naccuracy = \"tight\"\n";
    let folder = folder(&[
        ("slow.toml", slow),
        ("pulse.csv", RECORD),
        ("s.toml", SMALL),
    ]);
    let entries = || std::fs::read_dir(folder.path()).unwrap().count();
    let stopped_by = |signal: &str| {
        let run = command(folder.path())
            .args(["run", "slow.toml", "--out", "out"])
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        let start = Instant::now();
        while entries() == 3 {
            assert!(
                start.elapsed() < Duration::from_secs(60),
                "the run does not begin"
            );
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(
            Command::new("kill")
                .args([signal, &run.id().to_string()])
                .status()
                .unwrap()
                .success()
        );
        let output = run.wait_with_output().unwrap();
        (
            output.status.code(),
            String::from_utf8(output.stderr).unwrap(),
        )
    };
    for signal in ["-INT", "-TERM"] {
        let (code, message) = stopped_by(signal);
        assert_eq!(code, Some(130), "{message}");
        assert_eq!(message.lines().next(), Some("error: stopped"));
        assert_eq!(entries(), 3);
    }
    // Nobody can tidy up behind SIGKILL but the next run.
    assert_eq!(stopped_by("-KILL").0, None);
    assert_eq!(entries(), 4);
    expect(&folder, &["run", "s.toml", "--out", "out"], 0);
    if cfg!(target_os = "linux") {
        assert_eq!(entries(), 4);
        assert!(folder.path().join("out/srs.csv").exists());
    }
}

#[test]
fn motions_do_not_overwrite_each_other() {
    let other = RECORD.replace("0.5\n", "0.4\n");
    let folder = folder(&[
        ("rec.csv", RECORD),
        ("rec_roof.csv", &other),
        ("s.toml", SMALL),
    ]);
    expect(
        &folder,
        &[
            "run",
            "s.toml",
            "--motion",
            "rec.csv",
            "rec_roof.csv",
            "--out",
            "out",
        ],
        0,
    );
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&read("summary.json")).unwrap();
    let files: Vec<&str> = summary["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| name.as_str().unwrap())
        .collect();
    let motions = [
        "motions/rec.csv",
        "motions/rec_roof.csv",
        "motions/roof/rec.csv",
        "motions/roof/rec_roof.csv",
    ];
    assert_eq!(
        files
            .iter()
            .filter(|name| name.starts_with("motions/"))
            .collect::<Vec<_>>(),
        motions.each_ref()
    );
    let contents: std::collections::HashSet<String> = motions.map(read).into();
    assert_eq!(contents.len(), 4);
    // A level whose folder would have the name of a motion's file.
    std::fs::write(
        folder.path().join("clash.toml"),
        SMALL.replace("\"roof\"", "\"rec.csv\""),
    )
    .unwrap();
    let shown = expect(
        &folder,
        &["run", "clash.toml", "--motion", "rec.csv", "--out", "out"],
        2,
    );
    assert!(shown.contains("cannot be the name of a level"), "{shown}");
}

#[test]
fn the_study_of_an_output_folder_runs_again() {
    let folder = folder(&[("pulse.csv", RECORD), ("s.toml", SMALL)]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    expect(
        &folder,
        &[
            "run",
            "s.toml",
            "--motion",
            "pulse.csv",
            "--scale",
            "0.5",
            "--out",
            "a",
        ],
        0,
    );
    expect(&folder, &["run", "a/study.toml", "--out", "b"], 0);
    assert!(read("a/srs.csv").contains("rocked") && read("a/srs.csv") == read("b/srs.csv"));
    let synthetic = SMALL.replace("motions = [\"pulse.csv\"]", "count = 1 # one");
    std::fs::write(folder.path().join("s.toml"), &synthetic).unwrap();
    expect(&folder, &["run", "s.toml", "--seed", "9", "--out", "c"], 0);
    expect(&folder, &["run", "c/study.toml", "--out", "d"], 0);
    expect(&folder, &["run", "s.toml", "--out", "e"], 0);
    assert!(read("c/srs.csv") == read("d/srs.csv") && read("c/srs.csv") != read("e/srs.csv"));
    assert!(read("c/study.toml").contains("count = 1 # one\nseed = 9\n"));
}

#[test]
fn the_dumped_study_is_one_json_document_and_has_the_seed() {
    let folder = folder(&[]);
    let dump = |more: &[&str]| {
        let args = [&["run", "--dump-study"], more].concat();
        let output = execute(folder.path(), &args);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = dump(&["--seed", "7"]);
    assert!(text.contains("\nseed = 7\n"));
    let document: serde_json::Value =
        serde_json::from_str(&dump(&["--json", "--seed", "7", "--out", "out"])).unwrap();
    assert_eq!(
        document,
        serde_json::json!({"schema": "freestand.study/1", "study": text, "warnings": []})
    );
    assert_eq!(
        std::fs::read_to_string(folder.path().join("out/study.toml")).unwrap(),
        text
    );
}
