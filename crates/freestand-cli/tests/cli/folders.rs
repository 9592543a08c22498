//! Folders of results: what is written there, and what is never replaced.

use crate::{RECORD, SMALL, cases, expect, folder, freestand_in, shock::CABINET};

#[test]
fn floors_are_written_into_a_folder_that_is_ours_only() {
    let folder = folder(&[("pulse.csv", RECORD)]);
    let floor = [
        "floor",
        "--motion",
        "pulse.csv",
        "--storeys",
        "4",
        "--storey-height",
        "3 m",
        "--modes",
        "2",
        "--levels",
        "0, 1",
    ];
    let first = freestand_in(
        folder.path(),
        &[&floor[..], &["--out", "floors", "--json"]].concat(),
    );
    let ground = std::fs::read_to_string(folder.path().join("floors/level-0.csv")).unwrap();
    // 0.5 g at the second sample: the base returns the ground motion exactly.
    assert_eq!(ground.lines().nth(2), Some("0.25,4.903325"));
    // Ours: replaced. Not ours: refused, and nothing is left behind.
    let again = freestand_in(
        folder.path(),
        &[&floor[..], &["--out", "floors", "-q"]].concat(),
    );
    std::fs::create_dir(folder.path().join("thesis")).unwrap();
    std::fs::write(folder.path().join("thesis/chapter.txt"), "").unwrap();
    let refused = freestand_in(folder.path(), &[&floor[..], &["--out", "thesis"]].concat());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
    // The folder of the test has another name each time.
    let refused: String = refused.replace(
        &*folder.path().canonicalize().unwrap().to_string_lossy(),
        "…",
    );
    cases::each(
        "floors_are_written_into_a_folder_that_is_ours_only",
        &[first, again, refused],
    );
}

#[test]
fn a_run_replaces_its_own_files_only() {
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("s.toml", SMALL),
        ("thesis.doc", "years of work"),
    ]);
    let exists = |name: &str| folder.path().join(name).exists();
    expect(&folder, &["run", "s.toml", "--out", "."], 2);
    expect(&folder, &["run", "s.toml", "--out", ".", "--force"], 0);
    expect(&folder, &["run", "s.toml", "--out", "."], 0);
    assert!(exists("thesis.doc") && exists("pulse.csv") && exists("s.toml") && exists("srs.csv"));
    // The folder is that of `run`: another command does not touch it, and with --force removes nothing.
    let convert = [
        "motion",
        "convert",
        "pulse.csv",
        "--to",
        "at2",
        "--out",
        ".",
    ];
    let shown = expect(&folder, &convert, 2);
    assert!(
        shown.contains("has the results of freestand run") && shown.contains("--force"),
        "{shown}"
    );
    assert!(exists("srs.csv") && !exists("pulse.AT2") && !exists("manifest.json"));
    expect(&folder, &[&convert[..], &["--force"]].concat(), 0);
    assert!(exists("thesis.doc") && exists("pulse.AT2") && exists("srs.csv") && exists("motions"));
    // A result that was edited is the user's; what is removed is named.
    expect(&folder, &["run", "s.toml", "--out", "r"], 0);
    std::fs::write(folder.path().join("r/srs.csv"), "edited").unwrap();
    let shown = expect(&folder, &["run", "s.toml", "--out", "r"], 2);
    assert!(
        shown.contains("r/srs.csv: was changed after freestand wrote it"),
        "{shown}"
    );
    expect(&folder, &["run", "s.toml", "--out", "r", "--force"], 0);
    let with_report = SMALL.replace("report = false", "report = true");
    std::fs::write(folder.path().join("report.toml"), with_report).unwrap();
    expect(&folder, &["run", "report.toml", "--out", "r"], 0);
    let shown = expect(&folder, &["run", "s.toml", "--out", "r"], 0);
    assert!(
        shown.contains("removed report.html of the earlier run") && !exists("r/report.html"),
        "{shown}"
    );
    // An output that would replace its own input is refused, whatever is allowed.
    for force in [&[][..], &["--force"]] {
        let shown = expect(
            &folder,
            &[
                &[
                    "motion",
                    "convert",
                    "pulse.csv",
                    "--to",
                    "csv",
                    "--out",
                    ".",
                ][..],
                force,
            ]
            .concat(),
            2,
        );
        assert!(shown.contains("its output would replace it"), "{shown}");
    }
    assert_eq!(
        std::fs::read_to_string(folder.path().join("pulse.csv")).unwrap(),
        RECORD
    );
}

#[test]
fn several_motions_have_a_result_each() {
    let folder = folder(&[("a.csv", RECORD), ("b.csv", RECORD)]);
    let object = ["--height", "1 m", "--thickness", "200 mm"];
    let several = [&["rock", "--motion", "a.csv", "b.csv"], &object[..]].concat();
    let shown = expect(
        &folder,
        &[&several[..], &["--plot", "--out", "out", "--json"]].concat(),
        0,
    );
    assert_eq!(
        (
            shown.matches("\"motion\": \"").count(),
            shown.matches("\"outcome\":").count()
        ),
        (2, 2),
        "{shown}"
    );
    for name in [
        "history-01-a.csv",
        "history-01-a.svg",
        "history-02-b.csv",
        "history-02-b.png",
    ] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
    // Each result is that of the motion alone.
    let alone = expect(
        &folder,
        &[&["rock", "--motion", "b.csv", "--json"], &object[..]].concat(),
        0,
    );
    let peak = alone
        .lines()
        .find(|line| line.contains("peak_rotation_rad"))
        .unwrap()
        .trim();
    assert_eq!(shown.matches(peak).count(), 2, "{peak}");
    let table = expect(&folder, &several, 0);
    assert!(table.contains("motion  outcome"), "{table}");
    expect(
        &folder,
        &[
            &["rock", "--motion", "a.csv", "--plot", "a.svg"],
            &object[..],
        ]
        .concat(),
        0,
    );
    assert!(folder.path().join("a.svg").is_file());
    for more in [
        &["--history", "h.csv"][..],
        &["--vertical", "a.csv"],
        &["--plot", "x.svg"],
        &["--plot"],
    ] {
        assert!(
            expect(&folder, &[&several[..], more].concat(), 2).contains("hint: "),
            "{more:?}"
        );
    }
}

/// `--out` is never ignored.
#[test]
fn every_command_writes_what_it_found() {
    let folder = folder(&[("pulse.csv", RECORD), ("s.toml", SMALL)]);
    let object = ["--height", "1 m", "--thickness", "200 mm"];
    let cases: [(&[&str], &[&str]); 8] = [
        (
            &[
                &CABINET[..],
                &["--stiffness", "4380 N/mm", "--cg-rise", "16 mm"],
            ]
            .concat(),
            &[],
        ),
        (
            &[&["rock", "--motion", "pulse.csv"], &object[..]].concat(),
            &["history.csv"],
        ),
        (
            &[
                "spectrum",
                "--motion",
                "pulse.csv",
                "--heights",
                "1 m",
                "--thicknesses",
                "200 mm",
            ],
            &["rows.csv"],
        ),
        (&["motion", "info", "pulse.csv"], &["measures.csv"]),
        (&["motion", "spectrum", "pulse.csv"], &["spectrum.csv"]),
        (
            &["motion", "code-spectrum"],
            &["spectrum.csv", "spectrum.png", "spectrum.svg"],
        ),
        (&["validate"], &[]),
        (&["check", "s.toml"], &[]),
    ];
    let json = |path: &str| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(folder.path().join(path)).unwrap()).unwrap()
    };
    for (command, tables) in cases {
        // Twice into the same folder: a command replaces its own files.
        expect(&folder, &[command, &["--json", "--out", "out"]].concat(), 0);
        let shown = expect(&folder, &[command, &["--json", "--out", "out"]].concat(), 0);
        let files: Vec<&str> = tables
            .iter()
            .chain(&["manifest.json", "result.json"])
            .copied()
            .collect();
        let mut sorted = files.clone();
        sorted.sort_unstable();
        assert_eq!(
            json("out/manifest.json")["files"],
            serde_json::json!(sorted),
            "{command:?}"
        );
        assert_eq!(
            std::fs::read_dir(folder.path().join("out"))
                .unwrap()
                .count(),
            files.len(),
            "{command:?}"
        );
        let result = std::fs::read_to_string(folder.path().join("out/result.json")).unwrap();
        // The file has no seconds, so that equal runs write equal files.
        let untimed = |text: &str| {
            text.lines()
                .filter(|line| !line.contains("solve_s"))
                .collect::<Vec<_>>()
                .join("\n")
        };
        assert!(
            untimed(&shown).contains(&untimed(result.trim_end())),
            "{command:?}"
        );
        for table in tables.iter().filter(|name| name.ends_with(".csv")) {
            let text = std::fs::read_to_string(folder.path().join("out").join(table)).unwrap();
            assert!(
                text.lines().count() > 1 && !text.contains(",0.0,"),
                "{text}"
            );
        }
        std::fs::remove_dir_all(folder.path().join("out")).unwrap();
    }
}
