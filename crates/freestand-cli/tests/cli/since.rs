//! What has changed since an earlier assessment.

use serde_json::{Value, json};

use crate::program::{document, refused};

const HEAD: &str = "id,item,level_ratio,height,thickness,anchored\n";
/// It falls in Wellington.
const SHELF: &str = "shelf,0,2 m,0.25 m";
const DESK: &str = "a-desk,desk,0,0.8 m,1.4 m,no\n";

#[test]
fn what_has_changed_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let assess = |name: &str, rows: &str, place: &str, more: &[&str]| -> Value {
        let list = format!("{name}.csv");
        std::fs::write(folder.path().join(&list), format!("{HEAD}{rows}")).unwrap();
        let own = [
            "assess",
            "--inventory",
            &list,
            "--place",
            place,
            "--out",
            name,
        ];
        document(folder.path(), &[&own[..], more].concat())
    };
    let first = format!("a-shelf,{SHELF},no\na-rack,{SHELF},no\n{DESK}row-9,{SHELF},no\n");
    assess("first", &first, "Wellington", &[]);
    // One is anchored now, one is gone, one is new, and one without an id has another name.
    let second = format!("a-shelf,{SHELF},yes\n{DESK}b-shelf,{SHELF},no\nrow-9,a {SHELF},no\n");
    let told = assess("second", &second, "Wellington", &["--since", "first"]);
    let since = &told["since"];
    let changes = since["changes"].as_array().unwrap();
    let kinds: Vec<[&str; 2]> = changes
        .iter()
        .map(|one| ["change", "id"].map(|key| one[key].as_str().unwrap()))
        .collect();
    let expected = [
        ["new", "b-shelf"],
        ["new", "row-9"],
        ["done", "a-shelf"],
        ["gone", "a-rack"],
        ["gone", "row-9"],
    ];
    assert_eq!(kinds, expected);
    assert_eq!(changes[2]["anchored"], true);
    assert_eq!(changes[2]["decision_before"], "restrain");
    assert_eq!(since["unchanged"], 1);
    assert_eq!(since["other_study"], false);
    let table = std::fs::read_to_string(folder.path().join("second/changes.csv")).unwrap();
    assert_eq!(table.lines().count(), 6, "{table}");
    let report = std::fs::read_to_string(folder.path().join("second/report.html")).unwrap();
    assert!(report.contains("nobody has calculated whether the anchors hold"));

    // Into the same folder, which is read before anything is written; another place is another study.
    let third = assess("second", &first, "Melbourne", &["--since", "second"]);
    assert_eq!(third["since"]["other_study"], true);
    let of = |id: &str| {
        let mut all = third["since"]["changes"].as_array().unwrap().iter();
        all.find(|one| one["id"] == id).unwrap()["change"].clone()
    };
    assert_eq!(of("b-shelf"), json!("gone"));
    assert_eq!(of("a-rack"), json!("new"));
}

#[test]
fn a_folder_without_an_assessment_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("list.csv"), format!("{HEAD}{DESK}")).unwrap();
    let assess = [
        "assess",
        "--inventory",
        "list.csv",
        "--place",
        "Wellington",
        "--since",
    ];
    let told = |since: &str| refused(folder.path(), &[&assess[..], &[since]].concat());
    assert!(told("nowhere").contains("nowhere"));
    std::fs::create_dir(folder.path().join("other")).unwrap();
    std::fs::write(
        folder.path().join("other/manifest.json"),
        "{\"schema\": \"freestand.run/1\"}",
    )
    .unwrap();
    assert!(told("other").contains("is not that of an assessment"));
    let stopped = "{\"schema\": \"freestand.assess/1\", \"complete\": false}";
    std::fs::write(folder.path().join("other/manifest.json"), stopped).unwrap();
    assert!(told("other").contains("stopped before its end"));
    assert!(!folder.path().join("freestand-assessment").exists());
}
