//! A file that was written on Windows ends its lines with a carriage return and a line feed. It says the
//! same as with line feeds alone, whatever reads it.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{execute, json, root};

/// Texts of each kind that the program reads: lists, tables, records, TOML, scans.
const FILES: [(&str, &str); 12] = [
    ("crates/freestand-cli/tests/same_answer", "study.toml"),
    ("crates/freestand-cli/tests/same_answer", "list.csv"),
    ("crates/freestand-cli/tests/same_answer", "sine.csv"),
    ("crates/freestand-cli/tests/same_answer", "weak.csv"),
    ("crates/freestand-cli/tests/same_answer", "decaying.csv"),
    ("examples/risk", "outcomes.csv"),
    ("examples/risk", "curves.csv"),
    ("examples/risk", "hazard.csv"),
    ("examples/risk", "costs.csv"),
    ("examples/risk", "options.csv"),
    ("validation/cushion", "drop-001.csv"),
    ("crates/freestand-inventory/tests/lists", "english_si.csv"),
];

const CUBE: &str = "v 0 0 0\nv 200 0 0\nv 0 300 0\nv 200 300 0\nv 0 0 900\nv 200 0 900\nv 0 300 900\nv 200 300 900\n\
                    f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
const TOLERANCES: &str = "id,class,kind,state,peak [g],duration [ms],source,page,confidence\n\
                          ct,scanner,vendor-limit,operating,2,11,installation manual,12,stated\n";
const SITES: &str =
    "[sites.One]\nplace = \"Lisbon\"\nstoreys = 3\ninventory = \"few.csv\" # the list\n";
const FEW: &str = "id,item,level_ratio,height,thickness,mass\nshelf,shelf,0,2 m,0.3 m,100 kg\n";

const COMMANDS: [&str; 8] = [
    "check study.toml",
    "assess study.toml --inventory list.csv",
    "assess --sites sites.toml",
    "risk --outcomes outcomes.csv --bootstrap 0 --hazard hazard.csv --inventory costs.csv --options options.csv --horizon 40yr --discount 3%",
    "risk --fragility curves.csv --hazard hazard.csv",
    "cushion drop drop-001.csv",
    "tolerance show ct --library tolerances.csv",
    "inventory check english_si.csv --storeys 5",
];

fn written(folder: &Path, end: &str) {
    let write = |name: &str, text: &str| {
        let text = text.replace("\r\n", "\n").replace('\n', end);
        fs::write(folder.join(name), text).unwrap();
    };
    for (from, name) in FILES {
        write(
            name,
            &fs::read_to_string(root().join(from).join(name)).unwrap(),
        );
    }
    for (name, text) in [
        ("cube.obj", CUBE),
        ("tolerances.csv", TOLERANCES),
        ("sites.toml", SITES),
        ("few.csv", FEW),
    ] {
        write(name, text);
    }
}

/// The document without fingerprints, which are others by right.
fn without_prints(value: &mut Value) {
    let is_print =
        |text: &str| text.len() == 64 && text.chars().all(|letter| letter.is_ascii_hexdigit());
    match value {
        Value::Object(keys) => keys.values_mut().for_each(without_prints),
        Value::Array(values) => values.iter_mut().for_each(without_prints),
        Value::String(text) if is_print(text) => text.clear(),
        _ => {}
    }
}

#[test]
fn the_ends_of_lines_do_not_matter() {
    let scanned =
        "rock --scan cube.obj --scan-unit mm --scan-base measured --motion sine.csv --mass 20kg";
    for asked in COMMANDS.into_iter().chain([scanned]) {
        let [line_feeds, carriage_returns] = ["\n", "\r\n"].map(|end| {
            let folder = tempfile::tempdir().unwrap();
            written(folder.path(), end);
            let words: Vec<&str> = asked.split(' ').collect();
            let output = execute(folder.path(), &[&words[..], &["--json"]].concat());
            let mut told = json(&output);
            without_prints(&mut told);
            (output.status.code(), told)
        });
        assert_eq!(line_feeds, carriage_returns, "{asked}");
    }
}
