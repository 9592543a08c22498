//! Bad requests have the same problems in the command line and on the page.

use std::process::Command;

use serde_json::{Value, json};

use crate::program::{PROGRAM, root};
use crate::serve::Page;

/// A request, whether a person can type it, and its problems.
fn table() -> Vec<Value> {
    let path = root().join("crates/freestand-app/tests/requests.jsonl");
    let text = std::fs::read_to_string(path).unwrap();
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// What the problems of a line are called by flags.
fn flags(line: &Value) -> Vec<&str> {
    let problems = line["problems"].as_array().unwrap();
    problems
        .iter()
        .map(|problem| problem["flag"].as_str().unwrap())
        .collect()
}

/// Every fourth request of the table: a process for each takes time.
#[test]
fn what_is_typed_has_the_problems_of_the_table() {
    typed(table().into_iter().step_by(4));
}

#[test]
#[ignore = "500 processes"]
fn whatever_is_typed_has_the_problems_of_the_table() {
    typed(table().into_iter());
}

fn typed(requests: impl Iterator<Item = Value>) {
    let files = [
        "motion",
        "vertical",
        "motion_y",
        "cushion",
        "scan",
        "station_xml",
        "scale_to_spectrum",
        "damage_boundary",
        "study",
        "columns",
        "inventory",
        "file",
        "words",
        "id",
        "word",
        "name",
        "library",
        "cushion_library",
        "restraints",
        "since",
        "sites",
        "list",
        "files",
        "spectrum",
        "across",
        "storey_table",
        "mode_table",
        "across_storey_table",
        "across_mode_table",
        "dir",
        "fragility",
        "hazard",
        "options",
    ];
    for line in requests {
        let request = line["request"].as_object().unwrap();
        // A file that is not there has another message than one that was not sent.
        let names_a_file = files.iter().any(|key| request.contains_key(*key));
        if line["typed"] == false || names_a_file {
            continue;
        }
        let arguments = request.iter().map(|(key, value)| {
            let flag = key.trim_end_matches("_years").trim_end_matches("_point");
            let flag = flag.replace('_', "-");
            match value {
                Value::Bool(true) => format!("--{flag}"),
                value => format!("--{flag}={}", value.as_str().unwrap()),
            }
        });
        let switches = [
            "sliding",
            "casters",
            "brakes",
            "no_slip",
            "no_upsample",
            "invert",
            "parts",
            "match_pga",
            "hard_rock",
            "spectra",
            "keep_mean",
            "scan_hull",
            "pairs",
            "compare",
            "parquet",
            "assess_anchored",
            "resume",
            "outcomes",
            "allow_recalled",
            "cards",
            "strict",
            "discrete",
            "headings",
            "cells",
            "sensitivity",
            "static",
            "xlsx",
            "csv",
        ];
        if switches
            .iter()
            .any(|key| request.get(*key).is_some_and(Value::is_string))
        {
            continue;
        }
        let output = Command::new(PROGRAM)
            .args(line["command"].as_str().unwrap().split(' '))
            .args(arguments)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        let found: Vec<&str> = text
            .lines()
            .filter_map(|line| line.strip_prefix("error: "))
            .collect();
        assert_eq!(found, flags(&line), "{line}");
        assert_eq!(output.status.code(), Some(2), "{line}");
    }
}

#[test]
fn what_the_page_asks_has_the_problems_of_the_table() {
    let page = Page::open();
    let asked = page.facts()["commands"].take();
    let asked = asked.as_array().unwrap();
    let is_asked = |line: &Value| asked.contains(&line["command"]);
    for line in table().into_iter().filter(is_asked) {
        let (status, answer) =
            page.run(&json!({"command": line["command"], "options": line["request"]}));
        let first = &answer["error"];
        let others = first["others"].as_array().into_iter().flatten();
        let all: Vec<&Value> = std::iter::once(first).chain(others).collect();
        let told: Vec<&str> = all
            .iter()
            .map(|one| one["message"].as_str().unwrap())
            .collect();
        assert_eq!((status, told), (400, flags(&line)), "{line}");
        let keys = line["problems"]
            .as_array()
            .unwrap()
            .iter()
            .map(|one| &one["keys"][0]);
        for (one, key) in all.iter().zip(keys) {
            let key = key.as_str().unwrap().replace('_', "-");
            assert_eq!(
                one["key"].as_str().unwrap(),
                key.trim_end_matches("-years").trim_end_matches("-point"),
                "{line}"
            );
        }
    }
}
