//! What is given is read, or refused as having no effect: in every mode of a command, a value that is
//! nonsense is refused, whatever its flag. A mode that does not read a flag would accept it.

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{PROGRAM, root};

const RECORD: &str = "validation/rocking/records/synthfloor.csv";

/// A mode of a command: the words of the command, and what selects the mode.
const MODES: &[(&[&str], &str)] = &[
    (
        &["rock"],
        "--motion RECORD --scale 3 --height 1.8m --thickness 0.5m",
    ),
    (
        &["rock"],
        "--motion RECORD --scale 8 --sliding --friction 0.25 --height 0.8m --thickness 0.6m",
    ),
    (
        &["rock"],
        "--height 1.8m --thickness 0.5m --mass 150kg --stiffness 4380N/mm --base compliant --cg-rise 10mm --duration 0.5s",
    ),
    (
        &["spectrum"],
        "--motion RECORD --scale 3 --heights 1.2m --thicknesses 0.3m",
    ),
    (
        &["spectrum"],
        "--motion RECORD --scale 3 --heights 0.8m --thicknesses 0.6m --sliding --friction 0.25",
    ),
    (
        &["spectrum"],
        "--place Wellington --count 1 --heights 1.2m --thicknesses 0.3m",
    ),
    (
        &["shock"],
        "--height 2.3m --thickness 0.6m --mass 140kg --stiffness 4380N/mm --cg-rise 16mm",
    ),
    (&["shock-spectrum"], "RECORD --frequencies 1Hz"),
    (
        &["shock-spectrum"],
        "--pulse half-sine --peak-acceleration 30g --duration 11ms --frequencies 1Hz",
    ),
    (&["floor"], "--motion RECORD --storeys 5 --storey-height 3m"),
    (
        &["object"],
        "--height 1.8m --thickness 0.5m --motion RECORD --scale 3",
    ),
    (&["motion", "code-spectrum"], ""),
    (
        &["cushion", "simulate"],
        "--stiffness 2190N/mm --mass 0.365kg --height 100mm",
    ),
    (&["cushion", "simulate"], "--static --stiffness 1100N/mm"),
    (
        &["restrain"],
        "--height 1.8m --thickness 0.5m --mass 150kg --floor-acceleration 0.5g",
    ),
];

/// Flags whose nonsense is accepted, each for its reason.
const EXCEPT: [&str; 7] = [
    "out",         // a folder that is made
    "history",     // a file that is written
    "csv",         // a file that is written
    "parquet",     // a file that is written
    "plot",        // a file that is written
    "seed",        // read where something is drawn; the same for every command
    "station-xml", // read where a record of a folder needs it; a note says where none does
];

/// The flags of a command that take a value, as the short help lists them: without the processing of
/// records, which every command with records reads by one function.
fn flags(command: &[&str]) -> Vec<String> {
    let help = Command::new(PROGRAM)
        .args(command)
        .arg("-h")
        .output()
        .unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let flag = |line: &str| {
        let (name, value) = line.trim_start().strip_prefix("--")?.split_once(' ')?;
        let is_flag = name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
        (is_flag && value.starts_with(['<', '['])).then(|| name.to_owned())
    };
    help.lines()
        .filter_map(flag)
        .filter(|name| !EXCEPT.contains(&name.as_str()))
        .collect()
}

/// The flags of a mode that accept nonsense.
fn unread((command, mode): &(&[&str], &str)) -> Vec<String> {
    let words: Vec<&str> = mode
        .split_whitespace()
        .map(|word| if word == "RECORD" { RECORD } else { word })
        .collect();
    let run = |more: &[&str]| {
        let mut program = Command::new(PROGRAM);
        program
            .args(*command)
            .args(&words)
            .args(more)
            .arg("--quiet")
            .current_dir(root());
        program
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .unwrap()
            .code()
    };
    assert!(matches!(run(&[]), Some(0 | 1)), "{command:?} {mode}");
    let all = flags(command);
    assert!(
        all.len() > 3,
        "{command:?}: the flags of the help are not found"
    );
    let is_free = |flag: &&String| !words.contains(&format!("--{flag}").as_str());
    let accepted = |flag: &&String| run(&[&format!("--{flag}"), "/no/such/nons$nse"]) != Some(2);
    all.iter()
        .filter(is_free)
        .filter(accepted)
        .map(|flag| format!("{command:?} {mode}: --{flag}"))
        .collect()
}

#[test]
fn nonsense_is_refused() {
    refused(4);
}

#[test]
#[ignore = "ten seconds: every flag of every mode"]
fn nonsense_is_refused_in_every_mode() {
    refused(1);
}

/// In every so many-th mode.
fn refused(step: usize) {
    let modes: Vec<_> = MODES.iter().step_by(step).collect();
    let halves = modes.split_at(modes.len() / 2);
    let of = |modes: &[&_]| modes.iter().copied().flat_map(unread).collect::<Vec<_>>();
    let found: Vec<String> = std::thread::scope(|scope| {
        let (first, second) = (scope.spawn(|| of(halves.0)), scope.spawn(|| of(halves.1)));
        [first.join().unwrap(), second.join().unwrap()].concat()
    });
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A value that can be read, of a flag that nothing reads.
#[test]
fn flags_without_effect_are_refused() {
    let cases = [
        (
            "spectrum --motion RECORD --heights 1.2m --thicknesses 0.3m --clearance-left 50mm",
            "--clearance-left",
        ),
        (
            "spectrum --motion RECORD --heights 0.8m --thicknesses 0.6m --sliding --friction 0.2 --restitution 0.9",
            "--restitution",
        ),
        (
            "cushion simulate --stiffness 2190N/mm --mass 0.365kg --height 100mm --hysteresis 10%",
            "--hysteresis",
        ),
        (
            "cushion simulate --static --stiffness 1100N/mm --bounces 2 --gravity 1g",
            "--bounces --gravity",
        ),
        (
            "cushion simulate --static --stiffness 1100N/mm --law kelvin-voigt --damping 5% --mass 3kg --pad-thickness 9mm",
            "--mass --damping --pad-thickness",
        ),
    ];
    for (line, flags) in cases {
        let words = line
            .split_whitespace()
            .map(|word| if word == "RECORD" { RECORD } else { word });
        let output = Command::new(PROGRAM)
            .args(words)
            .current_dir(root())
            .output()
            .unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{line}\n{told}");
        let errors = told.lines().filter_map(|line| line.strip_prefix("error: "));
        let named: Vec<&str> = errors.filter_map(|error| error.split(' ').next()).collect();
        assert_eq!(named.join(" "), flags, "{line}\n{told}");
    }
}

/// The warnings of a command.
fn warned(folder: &Path, line: &str) -> String {
    let record = root().join(RECORD);
    let words = line.split_whitespace().map(|word| match word {
        "RECORD" => record.as_os_str(),
        _ => OsStr::new(word),
    });
    let output = Command::new(PROGRAM)
        .args(words)
        .current_dir(folder)
        .output()
        .unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{line}\n{told}");
    told
}

/// Coordinates are for a hazard file with sites, or for exported objects.
#[test]
fn coordinates_that_choose_no_site_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let openquake = "#,,,,\"kind='mean', investigation_time=50.0, imt='PGV'\"\nlon,lat,depth,poe-0.01,poe-1.0,poe-2.0\n\
                     151.2,-33.9,0.0,1.0,0.1,0.01\n";
    let ours = "pgv [m/s],annual_rate\n0.05,0.02\n0.5,0.0002\n";
    std::fs::write(folder.join("openquake.csv"), openquake).unwrap();
    std::fs::write(folder.join("ours.csv"), ours).unwrap();
    let runs = "fragility --motion RECORD --height 1.8m --thickness 0.5m --method stripes --im pgv --at ground --bootstrap 0 \
                --site-coordinates 151.2,-33.9 --hazard";
    let said = |rest: &str| warned(folder, &format!("{runs} {rest}"));
    let idle = "--site-coordinates has no effect";
    assert!(said("ours.csv").contains(idle));
    assert!(!said("openquake.csv").contains(idle));
    assert!(!said("ours.csv --format openquake --out ours").contains(idle));
    // What is wrong with the curve is said once, however many read it.
    let told = said("openquake.csv --format openquake --out theirs");
    assert_eq!(told.matches("1 point left out").count(), 1, "{told}");
}

/// A thickness of a pad that serves warnings gives them.
#[test]
fn pads_that_are_too_thin_for_a_weight_are_said() {
    let lines = [
        "cushion simulate --stiffness 4N/mm --mass 3kg --height 100mm",
        "fragility --motion RECORD --height 1.8m --thickness 0.5m --bootstrap 0 --mass 100kg --stiffness 100N/mm",
    ];
    for line in lines {
        let of = |thickness: &str| warned(&root(), &format!("{line} --pad-thickness {thickness}"));
        let words = "the weight alone would compress the cushion";
        assert!(of("1mm").contains(words), "{line}");
        assert!(!of("50mm").contains(words), "{line}");
    }
}

#[test]
fn equal_runs_write_equal_files() {
    let folder = tempfile::tempdir().unwrap();
    let lines = [
        "spectrum --motion RECORD --heights 1.2m --thicknesses 0.3m",
        "shock-spectrum RECORD --frequencies 1Hz",
    ];
    for (index, line) in lines.iter().enumerate() {
        let written = |run: usize| {
            let out = folder.path().join(format!("{index}-{run}"));
            let words = line
                .split_whitespace()
                .map(|word| if word == "RECORD" { RECORD } else { word });
            let mut command = Command::new(PROGRAM);
            let status = command
                .args(words)
                .arg("--out")
                .arg(&out)
                .arg("--quiet")
                .current_dir(root())
                .output();
            assert_eq!(status.unwrap().status.code(), Some(0), "{line}");
            ["result.json", "manifest.json"]
                .map(|name| std::fs::read_to_string(out.join(name)).unwrap())
        };
        let first = written(1);
        assert_eq!(first, written(2), "{line}");
        assert!(
            first[0].contains("\"timing\"") && !first[0].contains("solve_s"),
            "{line}"
        );
    }
}

#[test]
fn numbers_beyond_any_laboratory_are_refused() {
    let simulate = [
        "cushion",
        "simulate",
        "--stiffness",
        "2190 N/mm",
        "--mass",
        "0.365kg",
        "--height",
        "1e308 m",
    ];
    let line = "rock --height 1.8m --thickness 0.5m --mass 150kg --stiffness 4380N/mm --base compliant \
                --cg-rise 10mm --duration 1s --tangential-ratio 4294967296";
    let rock: Vec<&str> = line.split_whitespace().collect();
    for words in [&simulate[..], &rock] {
        let output = Command::new(PROGRAM).args(words).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        assert!(output.stdout.is_empty(), "{words:?}");
    }
}
