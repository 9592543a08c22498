//! `freestand inventory` as it is called.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it cannot set up")]

mod cases;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn freestand(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).current_dir(folder).output().unwrap()
}

fn shown(folder: &Path, args: &[&str]) -> String {
    let output = freestand(folder, args);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().trim_end().to_owned();
    format!(
        "$ freestand {}\nexit status {}\n--- stdout\n{}\n--- stderr\n{}",
        args.join(" "),
        output.status.code().unwrap(),
        text(&output.stdout),
        text(&output.stderr)
    )
}

#[test]
fn a_template_is_written_checked_and_converted() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let csv = freestand(here, &["inventory", "template"]);
    assert!(csv.status.success() && csv.stdout.starts_with(b"id,item,quantity,"));
    assert!(freestand(here, &["inventory", "template", "objects.xlsx"]).status.success());
    assert!(freestand(here, &["inventory", "template", "--xlsx", "--out", "made"]).status.success());
    let book = std::fs::read(here.join("objects.xlsx")).unwrap();
    assert_eq!(book, std::fs::read(here.join("made/inventory.xlsx")).unwrap());
    assert!(here.join("made/manifest.json").exists() && here.join("made/result.json").exists());
    let back = freestand(here, &["inventory", "convert", "objects.xlsx", "--to", "csv"]);
    assert_eq!(back.stdout, csv.stdout);
    std::fs::write(here.join("objects.csv"), &csv.stdout).unwrap();
    assert!(freestand(here, &["inventory", "convert", "objects.csv", "again.xlsx", "--to", "xlsx"]).status.success());
    insta::assert_snapshot!(shown(here, &["inventory", "check", "again.xlsx"]));
    let json = freestand(here, &["inventory", "check", "objects.csv", "--json"]);
    let document: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(document["schema"], "freestand.inventory/1");
    assert_eq!((&document["counts"]["rows"], &document["counts"]["objects"]), (&Value::from(3), &Value::from(9)));
    // Two pads of 2190 N/mm under an edge.
    assert_eq!(document["first_rows"][0]["stiffness_n_m"], 4.38e6);
    assert_eq!(document["problems"].as_array().unwrap().len(), 1);
    assert_eq!(document["problems"][0]["kind"], "example");
}

#[test]
fn what_is_wrong_is_said_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = "Ward 3\n\nid,item,level,height,depth [px],mass [kg]\n\
                a,rack,3,1800,24,140\na,rack,0.5,1.8 m,24,abc\n";
    std::fs::write(here.join("objects.csv"), text).unwrap();
    let cases: [&[&str]; 5] = [
        &["inventory", "check", "objects.csv"],
        &["inventory", "check", "objects.csv", "--sheet", "Ward 3"],
        &["inventory", "check", "nowhere.xlsx"],
        &["inventory", "template", "--xlsx"],
        &["inventory", "convert", "objects.csv", "objects.csv", "--to", "csv"],
    ];
    let all: Vec<String> = cases.iter().map(|args| shown(here, args)).collect();
    cases::each("what_is_wrong_is_said_at_once", &all);
    assert_eq!(std::fs::read_to_string(here.join("objects.csv")).unwrap(), text);
}
