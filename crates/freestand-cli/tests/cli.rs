//! The commands as they are called: exit status, standard output and standard error in snapshots.
//!
//! After a wanted change: `INSTA_UPDATE=always cargo test -p freestand-cli`, and read the
//! difference.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it cannot set up")]

mod cases;

use std::path::Path;
use std::process::Command;

/// Runs freestand in `folder` and shows what came of it.
fn freestand_in(folder: &Path, args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).current_dir(folder).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().trim_end().to_owned();
    format!(
        "$ freestand {}\nexit status {}\n--- stdout\n{}\n--- stderr\n{}",
        args.join(" "),
        output.status.code().unwrap(),
        text(&output.stdout),
        text(&output.stderr)
    )
}

fn freestand(args: &[&str]) -> String {
    freestand_in(Path::new("."), args)
}

/// A folder with the files of a test.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

const CABINET: [&str; 7] = ["shock", "--height", "2.3 m", "--thickness", "600 mm", "--mass", "140 kg"];

fn cabinet(more: &[&str]) -> String {
    freestand(&[&CABINET, more].concat())
}

/// A pulse of 0.5 g in 1 s, then quiet.
const RECORD: &str = "time [s],a [g]\n0,0\n0.25,0.5\n0.5,0\n0.75,-0.5\n1,0\n1.25,0\n";

#[test]
fn shock_of_table_one() {
    insta::assert_snapshot!(cabinet(&["--stiffness", "4380 N/mm", "--cg-rise", "16 mm", "--gravity", "9.81 m/s2"]));
}

#[test]
fn shock_as_json_and_exceeded() {
    insta::assert_snapshot!(cabinet(&[
        "--pad-stiffness=2190 N/mm",
        "--pads-per-edge=2",
        "--rotation",
        "-0.05 rad",
        "--tolerance",
        "3 g",
        "--tolerance-duration",
        "11 ms",
        "--at",
        "0.3 m, 2 m",
        "--json",
    ]));
}

#[test]
fn shock_of_a_fall() {
    insta::assert_snapshot!(cabinet(&["--scenario", "overturn-floor", "--contact-stiffness", "2000 N/mm", "-q"]));
}

#[test]
fn shock_with_newtons_per_metre_is_warned_about() {
    insta::assert_snapshot!(cabinet(&["--stiffness", "4380 N/m", "--cg-rise", "16 mm"]));
}

#[test]
fn shock_refuses_bad_values_all_at_once() {
    insta::assert_snapshot!(freestand(&[
        "shock",
        "--height",
        "2.3",
        "--thickness",
        "-1 m",
        "--mass",
        "3 m",
        "--stiffness",
        "nan N/mm",
        "--cg-rise",
        "1 furlong",
    ]));
}

#[test]
fn shock_refuses_what_contradicts_itself() {
    let all = [
        cabinet(&["--stiffness", "4380 N/mm"]),
        cabinet(&["--cg-rise", "16 mm"]),
        cabinet(&["--stiffness", "4380 N/mm", "--cg-rise", "39 mm"]),
        cabinet(&["--pad-stiffness", "2190 N/mm", "--cg-rise", "16 mm"]),
        cabinet(&["--stiffness", "4380 N/mm", "--cg-rise", "16 mm", "--rotation", "1 deg"]),
        cabinet(&["--scenario", "overturn-obstacle", "--contact-stiffness", "2000 N/mm", "--gap", "100 mm"]),
        cabinet(&["--drop-acceleration", "10 g", "--tolerance", "5 g", "--tolerance-duration", "11 ms"]),
    ];
    cases::each("shock_refuses_what_contradicts_itself", &all);
}

/// V_c between 0.4 and 0.45 m/s, A_c between 3.5 and 4.5 g, and a landing with 0.451 m/s and 4.17
/// g.
const SHOCK_TESTS: &str = "velocity change [m/s],peak acceleration [g],damaged,method\n0.3,120,no,A\n0.4,160,no,A\n\
                           0.45,180,yes,A\n0.7,3.5,no,B\n0.7,4.5,yes,B\n";

#[test]
fn shock_beside_its_test_points() {
    let missing = SHOCK_TESTS.lines().take(4).collect::<Vec<_>>().join("\n");
    let turned = SHOCK_TESTS.replace("0.3,120,no", "0.3,120,yes").replace("0.7,3.5,no,B", "0.7,3.5,perhaps,B");
    let contradictory = SHOCK_TESTS.replace("0.3,120,no", "0.3,120,yes");
    let folder = folder(&[
        ("tests.csv", SHOCK_TESTS),
        ("missing.csv", &missing),
        ("perhaps.csv", &turned),
        ("contradictory.csv", &contradictory),
    ]);
    let with = |more: &[&str]| {
        let landing = ["--stiffness", "4380 N/mm", "--uplift", "30 mm"];
        freestand_in(folder.path(), &[&CABINET[..], &landing, &["--damage-boundary"], more].concat())
    };
    let all = [
        with(&["tests.csv"]),
        with(&["tests.csv", "--json", "--out", "out"]),
        with(&["missing.csv"]),
        with(&["perhaps.csv"]),
        with(&["contradictory.csv"]),
        with(&["tests.csv", "--tolerance", "5 g"]),
    ];
    cases::each("shock_beside_its_test_points", &all);
    let manifest = std::fs::read_to_string(folder.path().join("out/manifest.json")).unwrap();
    assert!(manifest.contains("damage-boundary.svg") && manifest.contains("damage-boundary.png"), "{manifest}");
}

#[test]
fn usage_errors_have_an_error_and_a_hint() {
    let all = [
        freestand(&[]),
        freestand(&["shok"]),
        freestand(&["shock", "--hight", "2 m"]),
        freestand(&["shock"]),
        freestand(&["shock", "--scenario", "flying"]),
        freestand(&["motion", "synth", "--count", "0"]),
        freestand(&["validate", "--threads", "0"]),
        freestand(&["validate", "--threads", "-1"]),
        freestand(&["validate", "--seed", "-1"]),
        freestand(&["motion", "synth", "--count", "-1"]),
        freestand(&["validate", "-1"]),
    ];
    cases::each("usage_errors_have_an_error_and_a_hint", &all);
}

#[test]
fn a_pdf_is_left_to_the_browser() {
    insta::assert_snapshot!(freestand(&["assess", "--format", "csv,pdf"]), @r"
    $ freestand assess --format csv,pdf
    exit status 2
    --- stdout

    --- stderr
    error: --format pdf: freestand does not write PDF files
    hint: leave pdf out, open report.html in a browser and print it, to paper or as a PDF
    ");
}

#[test]
fn check_explains_the_built_in_study() {
    insta::assert_snapshot!(freestand(&["check"]));
}

#[test]
fn check_reports_every_problem_with_its_line() {
    let study = "[ground]\ncity = \"Melborne\"\nreturn_period = 500\n\n[objects]\nmass = 150\nheights = \"3 m:1\"\n";
    let folder = folder(&[("study.toml", study), ("broken.toml", "[ground\ncount = 3\n")]);
    let all = [
        freestand_in(folder.path(), &["check", "study.toml"]),
        freestand_in(folder.path(), &["check", "broken.toml"]),
        freestand_in(folder.path(), &["check", "gone.toml"]),
        freestand_in(folder.path(), &["check", "."]),
    ];
    cases::each("check_reports_every_problem_with_its_line", &all);
}

#[test]
fn motion_info_and_spectrum() {
    let folder = folder(&[("pulse.csv", RECORD)]);
    let all = [
        freestand_in(folder.path(), &["motion", "info", "pulse.csv", "--json"]),
        freestand_in(folder.path(), &["motion", "info", "pulse.csv", "--scale", "-2"]),
        freestand_in(folder.path(), &["motion", "spectrum", "pulse.csv", "--periods", "0 s, 1 s", "--upsample", "10"]),
        freestand_in(folder.path(), &["motion", "convert", "pulse.csv", "--to", "csv"]),
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
            &["motion", "spectrum", "pulse.csv", "--damping", "2 %, 5 %", "--periods", "1 s, 2 s"],
        ),
    ];
    cases::each("motion_info_of_several_and_for_a_block", &all);
}

#[test]
fn pictures_of_motions_go_where_they_are_sent() {
    let two = "time [s],ns [g],up [g]\n0,0,0\n0.25,0.5,0.1\n0.5,0,-0.1\n0.75,-0.5,0\n1,0,0\n";
    let folder = folder(&[("pulse.csv", RECORD), ("two.csv", two), ("record.svg", RECORD)]);
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
    assert_eq!(std::fs::read_to_string(folder.path().join("record.svg")).unwrap(), RECORD);

    motion(&["info", "two.csv", "--component", "up", "--plot", "up.svg"]);
    motion(&["spectrum", "pulse.csv", "--plot", "s.PNG", "--json"]);
    let json = motion(&["info", "two.csv", "pulse.csv", "--plot", "--out", "out", "--json"]);
    assert!(std::fs::read(folder.path().join("up.svg")).unwrap().starts_with(b"<svg"));
    assert!(std::fs::read(folder.path().join("s.PNG")).unwrap().starts_with(b"\x89PNG"));
    let pictures = ["pulse.png", "pulse.svg", "two_ns.png", "two_ns.svg", "two_up.png", "two_up.svg"];
    let mut expected = vec!["manifest.json", "measures.csv", "result.json"];
    expected.extend(pictures);
    expected.sort_unstable();
    assert_eq!(names(&folder.path().join("out")), expected);
    assert!(pictures.iter().all(|name| json.contains(&format!("\"out/{name}\""))), "{json}");
}

fn names(path: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
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
            &["motion", "info", "empty.csv", "nan.csv", "one.csv", "bare.csv", "gone.csv", "."],
        ),
        freestand_in(folder.path(), &["motion", "spectrum", "two.csv"]),
    ];
    cases::each("broken_records_are_refused", &all);
}

#[test]
fn a_study_behind_the_records_is_told_from_a_record() {
    let folder = folder(&[("pulse.csv", RECORD), ("study.toml", "[building]\nstoreys = 4\n")]);
    insta::assert_snapshot!(freestand_in(folder.path(), &["run", "--motion", "pulse.csv", "study.toml"]));
}

/// A flag that nothing is read with would be ignored in silence.
#[test]
fn reading_flags_need_a_record() {
    let free = ["rock", "--height", "2 m", "--thickness", "0.5 m", "--initial-rotation", "1 deg", "--duration", "1 s"];
    let all = [
        freestand(&["run", "--scale", "2", "--unit", "g"]),
        freestand(&["run", "--dump-study", "--dt", "0.01 s"]),
        freestand(&[&free[..], &["--component", "1"]].concat()),
    ];
    cases::each("reading_flags_need_a_record", &all);
}

/// A factor of zero makes a motion of nothing, from a flag as from a study; wrong flags are said
/// once, not per file.
#[test]
fn wrong_reading_flags_are_refused() {
    let study = "[ground]\nmotions = \"pulse.csv\"\nscale = 0\n";
    let folder = folder(&[("pulse.csv", RECORD), ("study.toml", study)]);
    let all = [
        freestand_in(folder.path(), &["motion", "info", "pulse.csv", "--scale", "0"]),
        freestand_in(folder.path(), &["check", "study.toml"]),
        freestand_in(
            folder.path(),
            &["motion", "info", "pulse.csv", "pulse.csv", "--unit", "furlong", "--dt", "1000 s"],
        ),
    ];
    cases::each("wrong_reading_flags_are_refused", &all);
}

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
    let first = freestand_in(folder.path(), &[&floor[..], &["--out", "floors", "--json"]].concat());
    let ground = std::fs::read_to_string(folder.path().join("floors/level-0.csv")).unwrap();
    // 0.5 g at the second sample: the base returns the ground motion exactly.
    assert_eq!(ground.lines().nth(2), Some("0.25,4.903325"));
    // Ours: replaced. Not ours: refused, and nothing is left behind.
    let again = freestand_in(folder.path(), &[&floor[..], &["--out", "floors", "-q"]].concat());
    std::fs::create_dir(folder.path().join("thesis")).unwrap();
    std::fs::write(folder.path().join("thesis/chapter.txt"), "").unwrap();
    let refused = freestand_in(folder.path(), &[&floor[..], &["--out", "thesis"]].concat());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
    // The folder of the test has another name each time.
    let refused: String = refused.replace(&*folder.path().canonicalize().unwrap().to_string_lossy(), "…");
    cases::each("floors_are_written_into_a_folder_that_is_ours_only", &[first, again, refused]);
}

#[test]
fn code_spectrum() {
    let all = [
        freestand(&["motion", "code-spectrum", "--city", "Hobart", "--periods", "0 s, 0.3 s, 2 s"]),
        freestand(&["motion", "code-spectrum", "--site", "X"]),
        freestand(&["motion", "code-spectrum", "--return-period", "475"]),
    ];
    cases::each("code_spectrum", &all);
}

#[test]
fn spectra_of_other_codes_and_what_is_wrong_with_them() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("short.csv"), "T [s],PSA [g]\n0.1,0.3\n2,0.05\n").unwrap();
    let spectrum = |more: &[&str]| freestand_in(folder.path(), &[&["motion", "code-spectrum"], more].concat());
    let periods = ["--periods", "0 s, 0.3 s, 2 s"];
    let europe = ["--code", "ec8", "--spectrum-type", "1", "--site", "B", "--ground-acceleration", "0.2g"];
    let all = [
        spectrum(&[&europe[..], &periods, &["--parts"]].concat()),
        spectrum(&[&["--code", "asce7", "--sds", "1g", "--sd1", "0.6g", "--long-period", "8s"], &periods[..]].concat()),
        spectrum(&[&["--code", "nzs1170.5", "--site", "C", "--hazard-factor", "0.4", "--json"], &periods[..]].concat()),
        spectrum(&[&["--edition", "2024"], &periods[..]].concat()),
        spectrum(&["--spectrum", "short.csv", "--periods", "0.1 s, 2 s, 2.1 s"]),
        spectrum(&["--spectrum", "short.csv", "--parts"]),
        spectrum(&["--parts"]),
        spectrum(&["--code", "ec8", "--city", "Oslo", "--ground-acceleration", "0.1"]),
        spectrum(&["--code", "nzs1170.5", "--site", "De", "--hazard-factor", "-1", "--fault-distance", "3"]),
        spectrum(&["--code", "as1170.5"]),
        freestand_in(folder.path(), &["motion", "synth", "--spectrum", "short.csv"]),
        freestand_in(folder.path(), &["motion", "synth", "--spectrum", "gone.csv"]),
    ];
    cases::each("spectra_of_other_codes_and_what_is_wrong_with_them", &all);
}

/// Every flag of a code has its place in `--out`: the spectrum with its corners, as numbers and as
/// a picture.
#[test]
fn a_code_spectrum_is_written_with_its_corners() {
    let folder = tempfile::tempdir().unwrap();
    let shown = freestand_in(
        folder.path(),
        &["motion", "code-spectrum", "--parts", "--building-height", "96 m", "--out", "s", "-q"],
    );
    assert!(shown.contains("exit status 0"), "{shown}");
    let csv = std::fs::read_to_string(folder.path().join("s/spectrum.csv")).unwrap();
    // De ends its plateau at 1.98/3.68 s.
    let corner = format!("\n{},", 1.98 / 3.68);
    assert!(csv.starts_with("period_s,sa_g\n0,0.088") && csv.contains(&corner) && csv.contains("\n1.5,"), "{csv}");
    for name in ["spectrum.svg", "spectrum.png", "result.json", "manifest.json"] {
        assert!(folder.path().join("s").join(name).exists(), "{name}");
    }
}

/// The same numbers on one thread and on two, and a seed that matters.
#[test]
fn synthetic_motions_do_not_depend_on_threads() {
    let synth = |more: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let shown =
            freestand_in(folder.path(), &[&["motion", "synth", "--count", "2", "--out", "m", "-q"], more].concat());
        assert!(shown.contains("exit status 0"), "{shown}");
        std::fs::read(folder.path().join("m/synthetic-02.csv")).unwrap()
    };
    let one = synth(&["--threads", "1"]);
    assert!(one == synth(&["--threads", "2", "--seed", "1"]));
    assert!(one != synth(&["--seed", "2"]));
}

#[test]
fn validation_holds() {
    let shown = freestand(&["validate"]);
    assert!(shown.contains("exit status 0") && !shown.contains("FAILED"), "{shown}");
}

/// Each script names the command and a flag of it; the rest is clap's.
#[test]
fn shells_get_their_completions() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = freestand(&["completions", shell]);
        assert!(script.contains("exit status 0") && script.contains("return-period"), "{shell}");
    }
    assert!(freestand(&["completions", "tcsh"]).contains("exit status 2"));
}

#[test]
fn several_motions_have_a_result_each() {
    let folder = folder(&[("a.csv", RECORD), ("b.csv", RECORD)]);
    let object = ["--height", "1 m", "--thickness", "200 mm"];
    let several = [&["rock", "--motion", "a.csv", "b.csv"], &object[..]].concat();
    let shown = expect(&folder, &[&several[..], &["--plot", "--out", "out", "--json"]].concat(), 0);
    assert_eq!((shown.matches("\"motion\": \"").count(), shown.matches("\"outcome\":").count()), (2, 2), "{shown}");
    for name in ["history-01-a.csv", "history-01-a.svg", "history-02-b.csv", "history-02-b.png"] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
    // Each result is that of the motion alone.
    let alone = expect(&folder, &[&["rock", "--motion", "b.csv", "--json"], &object[..]].concat(), 0);
    let peak = alone.lines().find(|line| line.contains("peak_rotation_rad")).unwrap().trim();
    assert_eq!(shown.matches(peak).count(), 2, "{peak}");
    let table = expect(&folder, &several, 0);
    assert!(table.contains("motion  outcome"), "{table}");
    expect(&folder, &[&["rock", "--motion", "a.csv", "--plot", "a.svg"], &object[..]].concat(), 0);
    assert!(folder.path().join("a.svg").is_file());
    for more in [&["--history", "h.csv"][..], &["--vertical", "a.csv"], &["--plot", "x.svg"], &["--plot"]] {
        assert!(expect(&folder, &[&several[..], more].concat(), 2).contains("hint: "), "{more:?}");
    }
}

#[test]
fn places_are_listed_and_shown() {
    let cases: [&[&str]; 6] = [
        &["place", "list", "new zealand"],
        &["place", "show", "zürich"],
        &["place", "show", "Salt Lake City", "--json"],
        &["place", "show", "Welington"],
        &["place", "list", "atlantis"],
        &["motion", "code-spectrum", "--place", "Athens", "--periods", "0.2 s, 1 s"],
    ];
    cases::each("places_are_listed_and_shown", &cases.map(freestand));
    assert_eq!(freestand(&["place", "list", "--json"]).matches("\"confidence\":").count(), 99);
}

/// Every command, found by walking the help.
fn commands(of: &[String]) -> Vec<Vec<String>> {
    let help = freestand(&[of.iter().map(String::as_str).collect::<Vec<_>>(), vec!["--help"]].concat());
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names = listed.filter(|line| !line.starts_with("   ")).filter_map(|line| line.split_whitespace().next());
    let below = names.filter(|name| *name != "help").flat_map(|name| commands(&[of, &[name.to_owned()]].concat()));
    std::iter::once(of.to_vec()).chain(below).collect()
}

#[test]
fn help_of_every_command_has_examples() {
    let commands = commands(&[]);
    assert_eq!(commands.len(), 50);
    for command in commands {
        let words: Vec<&str> = command.iter().map(String::as_str).chain(["--help"]).collect();
        let shown = freestand(&words);
        let (_, examples) = shown.split_once("\nExamples:\n").unwrap_or_default();
        let count = examples.lines().filter(|line| line.starts_with("  ") && line.contains("freestand ")).count();
        assert!(shown.contains("exit status 0") && count >= 2, "{shown}");
        // Lines that clap had to wrap cannot be copied.
        assert!(shown.lines().all(|line| line.chars().count() <= 100), "{shown}");
    }
}

/// `freestand … | head -1`: no message, no panic.
#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_error() {
    let binary = env!("CARGO_BIN_EXE_freestand");
    let script = format!("'{binary}' motion code-spectrum --periods '0 s:5 s:200000' --json | head -c 1");
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

/// A study of one record, one floor and one object: done in no time.
const SMALL: &str = "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\nlevels = [{ name = \"roof\", level_ratio = 1.0 }]\n[objects]\nheights = \"1 m\"\nthicknesses = \"200 mm\"\n[outputs]\nfigures = false\nreport = false\n";

/// Runs freestand in `folder` and expects an exit status.
fn expect(folder: &tempfile::TempDir, args: &[&str], status: i32) -> String {
    let shown = freestand_in(folder.path(), args);
    assert!(shown.contains(&format!("\nexit status {status}\n")), "{shown}");
    shown
}

#[test]
fn a_run_replaces_its_own_files_only() {
    let folder = folder(&[("pulse.csv", RECORD), ("s.toml", SMALL), ("thesis.doc", "years of work")]);
    let exists = |name: &str| folder.path().join(name).exists();
    expect(&folder, &["run", "s.toml", "--out", "."], 2);
    expect(&folder, &["run", "s.toml", "--out", ".", "--force"], 0);
    expect(&folder, &["run", "s.toml", "--out", "."], 0);
    assert!(exists("thesis.doc") && exists("pulse.csv") && exists("s.toml") && exists("srs.csv"));
    // The folder is that of `run`: another command does not touch it, and with --force removes nothing.
    let convert = ["motion", "convert", "pulse.csv", "--to", "at2", "--out", "."];
    let shown = expect(&folder, &convert, 2);
    assert!(shown.contains("has the results of freestand run") && shown.contains("--force"), "{shown}");
    assert!(exists("srs.csv") && !exists("pulse.AT2") && !exists("manifest.json"));
    expect(&folder, &[&convert[..], &["--force"]].concat(), 0);
    assert!(exists("thesis.doc") && exists("pulse.AT2") && exists("srs.csv") && exists("motions"));
    // A result that was edited is the user's; what is removed is named.
    expect(&folder, &["run", "s.toml", "--out", "r"], 0);
    std::fs::write(folder.path().join("r/srs.csv"), "edited").unwrap();
    let shown = expect(&folder, &["run", "s.toml", "--out", "r"], 2);
    assert!(shown.contains("r/srs.csv: was changed after freestand wrote it"), "{shown}");
    expect(&folder, &["run", "s.toml", "--out", "r", "--force"], 0);
    let with_report = SMALL.replace("report = false", "report = true");
    std::fs::write(folder.path().join("report.toml"), with_report).unwrap();
    expect(&folder, &["run", "report.toml", "--out", "r"], 0);
    let shown = expect(&folder, &["run", "s.toml", "--out", "r"], 0);
    assert!(shown.contains("removed report.html of the earlier run") && !exists("r/report.html"), "{shown}");
    // An output that would replace its own input is refused, whatever is allowed.
    for force in [&[][..], &["--force"]] {
        let shown =
            expect(&folder, &[&["motion", "convert", "pulse.csv", "--to", "csv", "--out", "."][..], force].concat(), 2);
        assert!(shown.contains("its output would replace it"), "{shown}");
    }
    assert_eq!(std::fs::read_to_string(folder.path().join("pulse.csv")).unwrap(), RECORD);
}

/// Ctrl-C and `kill`: one line, and nothing left behind.
#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_leaves_nothing() {
    use std::time::{Duration, Instant};
    let slow = "[ground]\ncount = 1000\n[objects]\naccuracy = \"tight\"\n";
    let folder = folder(&[("slow.toml", slow), ("pulse.csv", RECORD), ("s.toml", SMALL)]);
    let entries = || std::fs::read_dir(folder.path()).unwrap().count();
    let stopped_by = |signal: &str| {
        let run = Command::new(env!("CARGO_BIN_EXE_freestand"))
            .args(["run", "slow.toml", "--out", "out"])
            .current_dir(folder.path())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        let start = Instant::now();
        while entries() == 3 {
            assert!(start.elapsed() < Duration::from_secs(60), "the run does not begin");
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap().success());
        let output = run.wait_with_output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
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
    let folder = folder(&[("rec.csv", RECORD), ("rec_roof.csv", &other), ("s.toml", SMALL)]);
    expect(&folder, &["run", "s.toml", "--motion", "rec.csv", "rec_roof.csv", "--out", "out"], 0);
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&read("summary.json")).unwrap();
    let files: Vec<&str> = summary["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let motions = ["motions/rec.csv", "motions/rec_roof.csv", "motions/roof/rec.csv", "motions/roof/rec_roof.csv"];
    assert_eq!(files.iter().filter(|name| name.starts_with("motions/")).collect::<Vec<_>>(), motions.each_ref());
    let contents: std::collections::HashSet<String> = motions.map(read).into();
    assert_eq!(contents.len(), 4);
    // A level whose folder would have the name of a motion's file.
    std::fs::write(folder.path().join("clash.toml"), SMALL.replace("\"roof\"", "\"rec.csv\"")).unwrap();
    let shown = expect(&folder, &["run", "clash.toml", "--motion", "rec.csv", "--out", "out"], 2);
    assert!(shown.contains("cannot be the name of a level"), "{shown}");
}

/// `--out` is never ignored.
#[test]
fn every_command_writes_what_it_found() {
    let folder = folder(&[("pulse.csv", RECORD), ("s.toml", SMALL)]);
    let object = ["--height", "1 m", "--thickness", "200 mm"];
    let cases: [(&[&str], &[&str]); 8] = [
        (&[&CABINET[..], &["--stiffness", "4380 N/mm", "--cg-rise", "16 mm"]].concat(), &[]),
        (&[&["rock", "--motion", "pulse.csv"], &object[..]].concat(), &["history.csv"]),
        (&["spectrum", "--motion", "pulse.csv", "--heights", "1 m", "--thicknesses", "200 mm"], &["rows.csv"]),
        (&["motion", "info", "pulse.csv"], &["measures.csv"]),
        (&["motion", "spectrum", "pulse.csv"], &["spectrum.csv"]),
        (&["motion", "code-spectrum"], &["spectrum.csv", "spectrum.png", "spectrum.svg"]),
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
        let files: Vec<&str> = tables.iter().chain(&["manifest.json", "result.json"]).copied().collect();
        let mut sorted = files.clone();
        sorted.sort_unstable();
        assert_eq!(json("out/manifest.json")["files"], serde_json::json!(sorted), "{command:?}");
        assert_eq!(std::fs::read_dir(folder.path().join("out")).unwrap().count(), files.len(), "{command:?}");
        let result = std::fs::read_to_string(folder.path().join("out/result.json")).unwrap();
        assert!(shown.contains(result.trim_end()), "{command:?}");
        for table in tables.iter().filter(|name| name.ends_with(".csv")) {
            let text = std::fs::read_to_string(folder.path().join("out").join(table)).unwrap();
            assert!(text.lines().count() > 1 && !text.contains(",0.0,"), "{text}");
        }
        std::fs::remove_dir_all(folder.path().join("out")).unwrap();
    }
}

#[test]
fn the_study_of_an_output_folder_runs_again() {
    let folder = folder(&[("pulse.csv", RECORD), ("s.toml", SMALL)]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    expect(&folder, &["run", "s.toml", "--motion", "pulse.csv", "--scale", "0.5", "--out", "a"], 0);
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
        let output = Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).current_dir(&folder).output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = dump(&["--seed", "7"]);
    assert!(text.contains("\nseed = 7\n"));
    let document: serde_json::Value = serde_json::from_str(&dump(&["--json", "--seed", "7", "--out", "out"])).unwrap();
    assert_eq!(document, serde_json::json!({"schema": "freestand.study/1", "study": text, "warnings": []}));
    assert_eq!(std::fs::read_to_string(folder.path().join("out/study.toml")).unwrap(), text);
}

/// A wave of 2 Hz that comes and goes within 4 s, 0.3 g north and 0.2 g east, on an offset of 0.01
/// g.
fn two_components(heading: &str) -> String {
    let row = |k: u32| {
        let t = f64::from(k) / 50.0;
        let wave = (-(t - 2.0) * (t - 2.0)).exp() * (std::f64::consts::TAU * 2.0 * t).sin();
        format!("{t},{:.6},{:.6}\n", 0.01 + 0.3 * wave, 0.01 + 0.2 * (wave - 0.1 * wave * wave))
    };
    format!("{heading}\n{}", (0..=200).map(row).collect::<String>())
}

/// What was done is said step by step, with what was found.
#[test]
fn records_are_processed_step_by_step() {
    let folder = folder(&[("two.csv", &two_components("time [s],N [g],E [g]"))]);
    let processed = |flags: &[&str]| {
        let args = [&["motion", "convert", "two.csv", "--to", "csv", "--json"], flags].concat();
        let output = Command::new(env!("CARGO_BIN_EXE_freestand")).args(&args).current_dir(folder.path()).output();
        let output = output.unwrap();
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        let motion = &json["motions"][0];
        format!(
            "$ {}\n{}\ndt {} npts {} warnings {}\n{}",
            flags.join(" "),
            serde_json::to_string_pretty(&motion["processing"]).unwrap(),
            motion["dt_s"],
            motion["npts"],
            json["warnings"],
            String::from_utf8_lossy(&output.stderr)
        )
    };
    let all = [
        processed(&["--component", "N"]),
        processed(&["--component", "N", "--baseline", "mean", "--taper", "5%"]),
        processed(&["--component", "E", "--baseline", "pre-event:0.5s", "--low-cut", "0.5 Hz"]),
        processed(&["--component", "E", "--baseline", "graizer:2:1s", "--high-cut", "10Hz", "--filter-order", "2"]),
        processed(&["--component", "1", "--baseline", "boore:1s:3s", "--resample", "10 ms"]),
        processed(&["--azimuth", "30 deg", "--baseline", "poly:2", "--scale-to", "0.3 g"]),
        processed(&["--azimuth", "-60 deg", "--resample", "0.04 s", "--scale-to-sa", "9 g at 1.2 s, 2 %"]),
    ];
    cases::each("records_are_processed_step_by_step", &all);
}

#[test]
fn wrong_processing_is_refused() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("h1h2.csv", &two_components("time [s],H1 [g],H2 [g]")),
        ("other.csv", RECORD),
    ]);
    let convert = |flags: &[&str]| {
        freestand_in(
            folder.path(),
            &[&["motion", "convert", "two.csv", "--to", "csv", "--component", "1"], flags].concat(),
        )
    };
    let all = [
        convert(&["--low-cut", "-1 Hz", "--taper", "60%", "--filter-order", "0", "--resample", "0 s"]),
        convert(&["--low-cut", "5", "--baseline", "straight", "--scale-to", "0 g", "--filter-order", "two"]),
        convert(&["--low-cut", "5 Hz", "--high-cut", "5 Hz"]),
        convert(&["--high-cut", "25 Hz"]),
        convert(&["--low-cut", "1e-9 Hz"]),
        convert(&["--resample", "1000 s"]),
        convert(&["--resample", "50 s"]),
        convert(&["--resample", "0.0173 s", "--filter-order", "4"]),
        convert(&["--resample", "0.017321 s"]),
        convert(&["--baseline", "pre-event:50s"]),
        convert(&["--scale-to-sa", "0.4 g"]),
        convert(&["--scale", "2", "--scale-to", "1 g"]),
        convert(&["--azimuth", "30 deg"]),
        freestand_in(folder.path(), &["motion", "convert", "h1h2.csv", "--to", "csv", "--azimuth", "30 deg"]),
        freestand_in(folder.path(), &["motion", "convert", "other.csv", "--to", "csv", "--azimuth", "30 deg"]),
        freestand_in(folder.path(), &["motion", "info", "two.csv", "--azimuth", "30 deg"]),
        freestand(&["run", "--low-cut", "1 Hz", "--azimuth", "3 deg"]),
    ];
    cases::each("wrong_processing_is_refused", &all);
}

#[test]
fn records_are_scaled_to_a_spectrum() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("target.csv", "# 500 years\nperiod [s]; PSA [g]\n0,2; 0,8\n0,5; 1,1\n1; 0,35\n2; 0,1\n"),
        ("bare.csv", "T,Sa\n0.2,0.8\n"),
        ("zero.csv", "T (s),Sa (m/s2)\n0.2,8\n0.5,0\n"),
    ]);
    let run = |args: &[&str]| freestand_in(folder.path(), args);
    let convert = |target: &str| {
        let text = run(&[
            "motion",
            "convert",
            "two.csv",
            "--to",
            "csv",
            "--component",
            "1",
            "--json",
            "--scale-to-spectrum",
            target,
        ]);
        // The samples are those of other tests.
        text.lines().filter(|line| !line.contains("\"text\"")).collect::<Vec<_>>().join("\n")
    };
    let rock =
        ["rock", "--motion", "two.csv", "--component", "1", "--height", "2 m", "--thickness", "500 mm", "--quiet"];
    let all = [
        convert("target.csv"),
        convert("target.csv, 0.5 s to 1 s, 2 %"),
        convert("target.csv, 3 s to 4 s"),
        convert("target.csv, 5 s"),
        convert("bare.csv"),
        convert("zero.csv"),
        convert("two.csv"),
        convert("none.csv"),
        run(&["motion", "rotd", "two.csv", "--scale-to-spectrum", "target.csv"]),
        run(&["motion", "info", "two.csv", "--scale-to-spectrum", "target.csv", "--scale-to-sa", "1 g at 1 s"]),
        // The vertical component has a factor of its own.
        run(&[&rock[..], &["--vertical", "two.csv", "--vertical-component", "2", "--scale-to-spectrum", "target.csv"]]
            .concat()),
    ];
    cases::each("records_are_scaled_to_a_spectrum", &all);
}

/// The spectrum that the program writes is a target that it reads: a motion has the factor 1 to its
/// own, at any damping in the file, and 2 to that of twice the motion.
#[test]
fn a_motion_is_scaled_to_the_spectrum_of_its_own() {
    let folder = folder(&[("two.csv", &two_components("time [s],N [g],E [g]"))]);
    let json = |args: &[&str]| -> serde_json::Value {
        let output =
            Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let one = ["motion", "spectrum", "two.csv", "--component", "N", "--damping", "2 %, 5 %", "--json"];
    json(&[&one[..], &["--out", "once"]].concat());
    json(&[&one[..], &["--scale", "2", "--out", "twice"]].concat());
    for (target, expected) in [
        ("once/spectrum.csv", 1.0),
        ("once/spectrum.csv, 2 %", 1.0),
        ("twice/spectrum.csv", 2.0),
        ("twice/spectrum.csv, 0.1 s to 2 s, 2 %", 2.0),
    ] {
        let scaled = json(&[&one[..], &["--scale-to-spectrum", target]].concat());
        let plain = json(&one);
        for (scaled, plain) in ["psa_g", "sa_g"]
            .map(|key| (&scaled[key], &plain[key]))
            .into_iter()
            .flat_map(|(a, b)| a.as_array().unwrap().iter().zip(b.as_array().unwrap()))
        {
            let ratio = scaled.as_f64().unwrap() / plain.as_f64().unwrap();
            // The file has every digit: roundings of 122 logarithms, and of the response.
            assert!((ratio - expected).abs() < 1e-12, "{target}: {ratio}");
        }
        let step = &scaled["processing"];
        // A factor of 1 has its step too.
        let misfit = step[0].as_str().is_some_and(|step| step.ends_with("misfit below 0.01 % rms in ln)"));
        assert!(misfit && (scaled["scale_ratio"].as_f64().unwrap() / expected - 1.0).abs() < 1e-12, "{step}");
        // Where the damping is not named, the one that is left out is.
        let is_named = target.ends_with('%');
        let left_out = scaled["warnings"].to_string().contains("those for 2 % are left out");
        assert_eq!(left_out, !is_named, "{target}: {}", scaled["warnings"]);
    }
    // What is read is not replaced, whatever is allowed.
    let before = std::fs::read(folder.path().join("once/spectrum.csv")).unwrap();
    for flag in ["--scale-to-spectrum", "--station-xml"] {
        let onto = [&one[..], &[flag, "once/spectrum.csv", "--out", "once", "--force"]].concat();
        let refused = freestand_in(folder.path(), &onto);
        assert!(refused.contains("exit status 2") && refused.contains("once/spectrum.csv"), "{refused}");
        assert_eq!(std::fs::read(folder.path().join("once/spectrum.csv")).unwrap(), before);
    }
}

#[test]
fn components_are_turned() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("h1h2.csv", &two_components("time [s],H1 [g],H2 [g]")),
        ("one.csv", "time [s],a [g]\n0,0\n0.02,0.3\n0.04,-0.3\n"),
        ("other.csv", "time [s],a [g]\n0,0\n0.02,0.4\n0.04,0\n0.06,0\n"),
        ("slow.csv", "time [s],a [g]\n0,0\n0.04,0.4\n0.08,0\n"),
    ]);
    let rotate = |args: &[&str]| freestand_in(folder.path(), &[&["motion", "rotate"], args].concat());
    let short = |text: String| text.lines().take(8).collect::<Vec<_>>().join("\n");
    let all = [
        rotate(&["one.csv", "other.csv", "--azimuths", "0 deg, 90 deg", "--to", "53.13010235415598 deg"]),
        rotate(&["one.csv", "other.csv", "--azimuths", "0 deg, 90 deg", "--to", "90 deg", "--json"]),
        short(rotate(&["two.csv", "--to", "-30 deg", "--format", "at2"])),
        short(rotate(&["h1h2.csv", "--azimuths", "10 deg, 100 deg", "--components", "H2, H1", "--to", "45 deg"])),
        rotate(&["h1h2.csv", "--to", "45 deg"]),
        rotate(&["one.csv", "other.csv", "--to", "45 deg"]),
        rotate(&["one.csv", "slow.csv", "--azimuths", "0 deg, 90 deg", "--to", "45 deg"]),
        rotate(&["one.csv", "other.csv", "--azimuths", "0 deg, 175 deg", "--to", "45 deg"]),
        rotate(&["one.csv", "--azimuths", "0 deg, 90 deg", "--to", "45 deg"]),
        rotate(&["two.csv", "--components", "N, N", "--to", "45 deg"]),
        rotate(&["two.csv", "--components", "N", "--azimuths", "0 deg", "--to", "45"]),
        rotate(&["two.csv", "--azimuth", "0 deg", "--to", "45 deg"]),
        rotate(&["one.csv", "other.csv", "two.csv", "--to", "45 deg"]),
    ];
    cases::each("components_are_turned", &all);
}

#[test]
fn spectra_over_all_directions() {
    let folder = folder(&[
        ("two.csv", &two_components("time [s],N [g],E [g]")),
        ("skew.csv", &two_components("time [s],N [g],N60E [g]")),
    ]);
    let rotd = |args: &[&str]| freestand_in(folder.path(), &[&["motion", "rotd"], args].concat());
    let all = [
        rotd(&["two.csv", "--periods", "0 s, 0.5 s, 2 s", "--baseline", "mean"]),
        rotd(&["two.csv", "--periods", "0.5 s", "--percentiles", "0, 50, 100", "--damping", "2%", "--json"]),
        rotd(&["skew.csv", "--periods", "0.5 s"]),
        rotd(&["two.csv", "--percentiles", "150", "--periods", "0.5 s"]),
        rotd(&["two.csv", "--periods", "-1 s"]),
        rotd(&["two.csv", "--scale-to", "1 g"]),
        rotd(&["two.csv", "--component", "N"]),
        rotd(&["two.csv", "--percentiles", "50, 50"]),
    ];
    cases::each("spectra_over_all_directions", &all);
    rotd(&["two.csv", "--periods", "0.5 s, 1 s", "--out", "out"]);
    let csv = std::fs::read_to_string(folder.path().join("out/rotd.csv")).unwrap();
    assert!(csv.starts_with("period_s,rotd50_g,rotd100_g,larger_g,geometric_mean_g,first_g,second_g\n0.5,"), "{csv}");
}

/// What a command refuses whatever the file is not among its flags; where it is of use it is.
#[test]
fn help_lists_no_flag_that_is_always_refused() {
    for (command, flag, is_listed) in [
        ("info", "--azimuth ", false),
        ("rotate", "--azimuth ", false),
        ("rotd", "--azimuth ", false),
        ("rotd", "--scale-to ", false),
        ("rotd", "--scale-to-sa ", false),
        ("rotd", "--scale-to-spectrum ", false),
        ("spectrum", "--azimuth ", true),
        ("rotate", "--scale-to-sa ", true),
        ("rotate", "--scale-to-spectrum ", true),
        ("rotd", "--scale ", true),
    ] {
        let run = Command::new(env!("CARGO_BIN_EXE_freestand")).args(["motion", command, "--help"]).output().unwrap();
        let help = String::from_utf8(run.stdout).unwrap();
        assert_eq!(help.contains(flag), is_listed, "{command} {flag}: {help}");
    }
}

/// A turned record has more energy in its own direction than in any other: the same is found by
/// `--azimuth`.
#[test]
fn azimuth_and_rotate_agree() {
    let folder = folder(&[("two.csv", &two_components("time [s],N [g],E [g]"))]);
    let text = |args: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).current_dir(folder.path()).output().unwrap().stdout
    };
    let converted = text(&["motion", "convert", "two.csv", "--to", "csv", "--azimuth", "30 deg"]);
    let rotated = text(&["motion", "rotate", "two.csv", "--to", "30 deg"]);
    assert!(converted == rotated && converted.len() > 1000);
}

/// Of many files the broken ones are listed and hide nothing else: exit status 1. Where nothing is
/// left: 2.
#[test]
fn motion_info_goes_on_behind_broken_files() {
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("nan.csv", "time [s],a [g]\n0,0\n0.1,nan\n0.2,0\n"),
        ("two.csv", "time [s],ns [g],up [g]\n0,0,0\n0.25,0.5,0.1\n0.5,0,-0.1\n0.75,-0.5,0\n1,0,0\n"),
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
    assert_eq!((failed.len(), json["motions"].as_array().unwrap().len()), (1, 3));
    assert_eq!((failed[0]["path"].as_str(), failed[0]["hint"].is_string()), (Some("nan.csv"), true));
    assert!(failed[0]["reason"].as_str().unwrap().starts_with("line 3: "), "{failed:?}");
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
    let spectrum = motion(&["spectrum", "late.csv", "--component", "N", "--periods", "5 s"]);
    assert!(!spectrum.contains("not kept"), "{spectrum}");
}

/// One recorder, times in four decimals, two lengths: one pair. Components of one name are told
/// apart by their files, each warning is said once, and one file is no pair.
#[test]
fn pairs_of_two_files() {
    let recorded = |rows: u32, pace: f64| {
        let row = |k: u32| format!("{:.4},{}\n", f64::from(k) / 128.0, 0.1 * (pace * f64::from(k)).sin());
        format!("time [s],a0 [g]\n{}", (0..rows).map(row).collect::<String>())
    };
    let (north, east) = (recorded(1000, 0.1), recorded(900, 0.13));
    let folder = folder(&[("north.csv", &north), ("east.csv", &east), ("copy.csv", &north)]);
    let rotd = |files: &[&str]| {
        freestand_in(folder.path(), &[&["motion", "rotd"], files, &["--periods", "0.05 s, 0.5 s"]].concat())
    };
    let all = [
        rotd(&["north.csv", "east.csv"]),
        rotd(&["north.csv", "copy.csv"]),
        rotd(&["north.csv", "./north.csv"]),
        rotd(&["north.csv", "east.csv", "--json"]),
    ];
    cases::each("pairs_of_two_files", &all);
}

const RACK: [&str; 7] = ["restrain", "--mass", "360kg", "--height", "1.8m", "--thickness", "0.6m"];

#[test]
fn restrain_by_place_code_study_and_acceleration() {
    let study = "[ground]\nplace = \"Newcastle\"\n[building]\nstoreys = 8\n[restraint]\nresponse_ratio = 2.5\n";
    let folder = folder(&[("study.toml", study)]);
    let with = |more: &[&str]| freestand_in(folder.path(), &[&RACK[..], more].concat());
    let all = [
        with(&["--place", "Athens", "--floor", "2", "--storeys", "5", "--width", "3 ft"]),
        with(&["--code", "asce7", "--sds", "1 g", "--resonance", "1.8", "--building-ductility", "1.5", "--json"]),
        with(&["--study", "study.toml", "--floor", "roof", "--anchors-per-edge", "3"]),
        with(&["--floor-acceleration", "0.9 g", "--out", "out"]),
    ];
    cases::each("restrain_by_place_code_study_and_acceleration", &all);
    let sheet = std::fs::read_to_string(folder.path().join("out/restraint.html")).unwrap();
    assert!(sheet.contains("<svg") && sheet.contains("Date and signature"), "{sheet}");
}

#[test]
fn restrain_refuses_what_it_cannot_know() {
    let with = |more: &[&str]| freestand(&[&RACK[..], more].concat());
    let all = [
        with(&[]),
        with(&["--place", "Wellinton"]),
        with(&["--sds", "1 g"]),
        with(&["--code", "asce7", "--place", "Wellington"]),
        with(&["--code", "nzs1170.5"]),
        with(&["--place", "Melbourne", "--importance", "0"]),
        with(&["--place", "Melbourne", "--strength", "2", "--floor", "3"]),
        with(&["--floor-acceleration", "1 g", "--place", "Melbourne"]),
        with(&["--study", "study.toml", "--sds", "1 g"]),
    ];
    cases::each("restrain_refuses_what_it_cannot_know", &all);
}
