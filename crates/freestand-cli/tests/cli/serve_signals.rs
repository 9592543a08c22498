//! How `freestand serve` ends, and what it leaves.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::program::PROGRAM;
use crate::serve::Page;

#[cfg(unix)]
fn killed(page: &mut Page, signal: &str) {
    let status = Command::new("kill")
        .args([signal, &page.child.id().to_string()])
        .status()
        .unwrap();
    assert!(status.success());
    assert_eq!(page.child.wait().unwrap().code(), Some(0), "{signal}");
}

/// Whatever ends it, its files do not stay.
#[cfg(unix)]
#[test]
fn signals_end_it_with_success_and_leave_nothing() {
    for signal in ["-TERM", "-INT", "-HUP"] {
        if signal == "-HUP" && ignores_hanging_up() {
            println!(
                "skipped: hanging up is ignored where the tests run, and so by what they start (nohup)"
            );
            continue;
        }
        let temporary = tempfile::tempdir().unwrap();
        let mut page = Page::open_with(|command| command.env("TMPDIR", temporary.path()));
        let file = temporary.path().join("list.csv");
        std::fs::write(&file, "a,b\n1,2\n").unwrap();
        page.upload(&file);
        std::fs::remove_file(&file).unwrap();
        assert_eq!(std::fs::read_dir(temporary.path()).unwrap().count(), 1);
        killed(&mut page, signal);
        assert_eq!(
            std::fs::read_dir(temporary.path()).unwrap().count(),
            0,
            "{signal}"
        );
    }
}

/// Whether this process ignores SIGHUP, the first bit of the mask.
fn ignores_hanging_up() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .map(str::trim);
    mask.and_then(|mask| u64::from_str_radix(mask, 16).ok())
        .is_some_and(|mask| mask & 1 == 1)
}

/// Where hanging up is ignored it goes on: `nohup freestand serve`.
#[cfg(target_os = "linux")]
#[test]
fn nohup_keeps_it() {
    let mut child = Command::new("nohup")
        .args([PROGRAM, "serve", "--json", "--no-open"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap())
        .read_line(&mut line)
        .unwrap();
    let line: Value = serde_json::from_str(&line).unwrap();
    let port = line["port"].as_u64().unwrap();
    let token = line["token"].as_str().unwrap().to_owned();
    let mut page = Page { child, port, token };
    let id = page.child.id().to_string();
    let hung_up = Command::new("kill").args(["-HUP", &id]).status();
    assert!(hung_up.unwrap().success());
    page.answered(&json!({"command": "tolerance search", "options": {"word": ["cabinet"]}}));
    killed(&mut page, "-TERM");
}
