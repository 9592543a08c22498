//! `freestand tolerance` and `freestand cushion list` as they are called.

use serde_json::Value;

use crate::program::{execute, freestand_in, json};

#[test]
fn entries_are_shown_with_their_sources() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["tolerance", "search", "bookcase"]
    ));
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["tolerance", "show", "expansion-card-operating"]
    ));
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["tolerance", "show", "p58-bookcase-5-shelves"]
    ));
    insta::assert_snapshot!(freestand_in(folder.path(), &["cushion", "list"]));
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["cushion", "show", "rubber-foot"]
    ));
}

#[test]
fn an_unknown_id_names_the_nearest() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["tolerance", "show", "hdd-35-operatng"]
    ));
    insta::assert_snapshot!(freestand_in(folder.path(), &["cushion", "show", "carpet"]));
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["tolerance", "search", "no", "such", "thing"]
    ));
}

#[test]
fn a_library_of_the_users_is_read_and_its_slips_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "ours.csv",
        "id,class,kind,state,peak [g],duration [ms],source,page,confidence\n\
         ct-scanner,scanner,vendor-limit,operating,2,11,installation manual,12,stated\n",
    );
    let output = execute(
        folder.path(),
        &[
            "tolerance",
            "show",
            "ct-scanner",
            "--library",
            "ours.csv",
            "--json",
            "--out",
            "o",
        ],
    );
    let document = json(&output);
    assert_eq!(document["schema"], "freestand.tolerance/1");
    let entry = &document["entries"][0];
    assert_eq!(
        (&entry["duration_s"], &entry["decides"]),
        (&Value::from(0.011), &Value::from(true))
    );
    assert!((entry["peak_m_s2"].as_f64().unwrap() - 19.6133).abs() < 1e-12);
    assert_eq!(entry["edge_lift_m"], Value::Null);
    let written: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("o/result.json")).unwrap())
            .unwrap();
    assert_eq!(written, document);
    write(
        "slips.csv",
        "id,class,kind,state,peak [g],duration [ms],source,page,confidence\n\
         a,x,vendor-limit,operating,-2,11,s,1,stated\nb,x,vendor-limit,on,2,11,s,,stated\n",
    );
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["tolerance", "list", "--library", "slips.csv"]
    ));
    insta::assert_snapshot!(freestand_in(
        folder.path(),
        &["cushion", "list", "--library", "none.csv"]
    ));
}

#[test]
fn every_entry_is_in_the_document() {
    let folder = tempfile::tempdir().unwrap();
    let document = json(&execute(folder.path(), &["tolerance", "list", "--json"]));
    let entries = document["entries"].as_array().unwrap();
    assert!(entries.len() > 100 && document["warnings"] == Value::Array(Vec::new()));
    assert!(
        entries
            .iter()
            .all(|entry| entry["source"].is_string() && entry["confidence"].is_string())
    );
    let document = json(&execute(folder.path(), &["cushion", "list", "--json"]));
    assert_eq!(document["schema"], "freestand.cushion-library/1");
    assert!(document["entries"].as_array().unwrap().len() >= 9);
}
