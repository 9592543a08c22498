//! What holds for every command: errors of usage, help, completions, a reader that leaves.

use std::collections::HashSet;
use std::path::Path;
use std::process::Command;

use freestand_input::keys::KeyStyle;

use crate::program::{PROGRAM, root};
use crate::{cases, freestand};

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

/// A flag that nothing is read with would be ignored in silence.
#[test]
fn reading_flags_need_a_record() {
    let free = [
        "rock",
        "--height",
        "2 m",
        "--thickness",
        "0.5 m",
        "--initial-rotation",
        "1 deg",
        "--duration",
        "1 s",
    ];
    let all = [
        freestand(&["run", "--scale", "2", "--unit", "g"]),
        freestand(&["run", "--dump-study", "--dt", "0.01 s"]),
        freestand(&[&free[..], &["--component", "1"]].concat()),
    ];
    cases::each("reading_flags_need_a_record", &all);
}

/// Each script names the command and a flag of it; the rest is clap's.
#[test]
fn shells_get_their_completions() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = freestand(&["completions", shell]);
        assert!(
            script.contains("exit status 0") && script.contains("return-period"),
            "{shell}"
        );
    }
    assert!(freestand(&["completions", "tcsh"]).contains("exit status 2"));
}

/// One page for each command, in a folder of its own; without it, that of the program.
#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("manual");
    let written = freestand(&["manual", "--quiet", "--out", &pages.to_string_lossy()]);
    assert!(written.contains("exit status 0"), "{written}");
    let named: HashSet<String> = commands(&[])
        .iter()
        .map(|names| [&["freestand".to_owned()], &names[..]].concat().join("-") + ".1")
        .collect();
    let found: HashSet<String> = std::fs::read_dir(&pages)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".1"))
        .collect();
    assert_eq!(found, named);
    let page = std::fs::read_to_string(pages.join("freestand-rock.1")).unwrap();
    assert!(page.contains(r"\-\-thickness") && page.contains("Examples:"));
}

/// Every command, found by walking the help.
fn commands(of: &[String]) -> Vec<Vec<String>> {
    let help = freestand(
        &[
            of.iter().map(String::as_str).collect::<Vec<_>>(),
            vec!["--help"],
        ]
        .concat(),
    );
    let listed = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty());
    let names = listed
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next());
    let below = names
        .filter(|name| *name != "help")
        .flat_map(|name| commands(&[of, &[name.to_owned()]].concat()));
    std::iter::once(of.to_vec()).chain(below).collect()
}

#[test]
fn help_of_every_command_has_examples() {
    let commands = commands(&[]);
    assert_eq!(commands.len(), 51);
    for command in commands {
        let words: Vec<&str> = command
            .iter()
            .map(String::as_str)
            .chain(["--help"])
            .collect();
        let shown = freestand(&words);
        let (_, examples) = shown.split_once("\nExamples:\n").unwrap_or_default();
        let count = examples
            .lines()
            .filter(|line| line.starts_with("  ") && line.contains("freestand "))
            .count();
        assert!(shown.contains("exit status 0") && count >= 2, "{shown}");
        // Lines that clap had to wrap cannot be copied.
        assert!(
            shown.lines().all(|line| line.chars().count() <= 100),
            "{shown}"
        );
    }
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
        let help = freestand(&["motion", command, "--help"]);
        assert_eq!(help.contains(flag), is_listed, "{command} {flag}: {help}");
    }
}

/// The help does not break the lines of its examples, so that they can be copied.
#[test]
fn examples_of_the_help_fit_into_a_terminal() {
    let folder = root().join("crates/freestand-cli/src/help");
    let mut texts = Vec::new();
    sources(&folder, &mut texts);
    assert!(texts.len() > 40, "{}", texts.len());
    let long = texts.iter().flat_map(|text| text.lines());
    let long: Vec<&str> = long.filter(|line| line.chars().count() > 100).collect();
    assert!(long.is_empty(), "{long:#?}");
}

/// `freestand … | head -1`: no message, no panic.
#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_error() {
    let script =
        format!("'{PROGRAM}' motion code-spectrum --periods '0 s:5 s:200000' --json | head -c 1");
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
fn validation_holds() {
    let shown = freestand(&["validate"]);
    assert!(
        shown.contains("exit status 0") && !shown.contains("FAILED"),
        "{shown}"
    );
}

fn sources(folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else {
            // A font is no source.
            found.extend(String::from_utf8(std::fs::read(path).unwrap()));
        }
    }
}

/// A key in backticks in a message of these commands is shown as a flag, so the flag must exist.
#[test]
fn keys_in_messages_are_flags() {
    // The completions list every flag of every command.
    let completions = freestand(&["completions", "bash"]);
    let known: HashSet<&str> = completions
        .split_whitespace()
        .map(|word| word.trim_matches(['"', ')']))
        .collect();
    let mut texts = Vec::new();
    for name in ["app", "report", "risk"] {
        let folder = format!("crates/freestand-{name}/src");
        sources(&root().join(folder), &mut texts);
    }
    let mut seen = 0;
    let lines = texts
        .iter()
        .flat_map(|text| text.lines())
        .filter(|line| !line.trim_start().starts_with("//"));
    for line in lines {
        for marked in line.split('`').skip(1).step_by(2) {
            let shown = KeyStyle::Flag.shown(&format!("`{}`", marked.replace('\\', "")));
            let Some(flag) = shown
                .split(' ')
                .next()
                .filter(|flag| flag.starts_with("--"))
            else {
                continue;
            };
            seen += 1;
            assert!(known.contains(flag), "{flag} is no flag: {line}");
        }
    }
    // A smaller number would mean that the messages were not found.
    assert!(seen > 20, "{seen}");
}

/// Flags of other programs in the sources: Slurm's in an example, and an invented processing step in a test.
const FOREIGN: [&str; 4] = ["--array", "--cpus-per-task", "--wrap", "--le"];

/// A flag that a message, a hint or an example names exists.
#[test]
fn flags_in_messages_exist() {
    let completions = freestand(&["completions", "bash"]);
    let known: HashSet<&str> = completions
        .split_whitespace()
        .map(|word| word.trim_matches(['"', ')']))
        .collect();
    let mut texts = Vec::new();
    for name in [
        "app",
        "assess",
        "cli",
        "input",
        "inventory",
        "output",
        "records",
        "report",
        "risk",
        "study",
    ] {
        let folder = format!("crates/freestand-{name}/src");
        sources(&root().join(folder), &mut texts);
    }
    let mut seen = HashSet::new();
    let lines = texts
        .iter()
        .flat_map(|text| text.lines())
        .filter(|line| !line.trim_start().starts_with("//"));
    for line in lines {
        let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        for word in line
            .split(|c| !is_part(c))
            .filter(|word| word.starts_with("--"))
        {
            let begins = word
                .trim_start_matches('-')
                .starts_with(|c: char| c.is_ascii_lowercase());
            if begins && !word.starts_with("---") && !FOREIGN.contains(&word) {
                // "all three --upper flags" means those that begin so.
                let exists = known.contains(word)
                    || known
                        .iter()
                        .any(|flag| flag.starts_with(&format!("{word}-")));
                assert!(exists, "{word} is no flag: {line}");
                seen.insert(word);
            }
        }
    }
    assert!(seen.len() > 100, "{}", seen.len());
}
