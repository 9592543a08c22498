//! `freestand inventory` as it is called.

use serde_json::Value;

use crate::program::{document, execute, folder, freestand_in};
use crate::{cases, expect};

#[test]
fn a_template_is_written_checked_and_converted() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let csv = execute(here, &["inventory", "template"]);
    assert!(csv.status.success() && csv.stdout.starts_with(b"id,item,quantity,"));
    assert!(
        execute(here, &["inventory", "template", "objects.xlsx"])
            .status
            .success()
    );
    assert!(
        execute(here, &["inventory", "template", "--xlsx", "--out", "made"])
            .status
            .success()
    );
    let book = std::fs::read(here.join("objects.xlsx")).unwrap();
    assert_eq!(
        book,
        std::fs::read(here.join("made/inventory.xlsx")).unwrap()
    );
    assert!(here.join("made/manifest.json").exists() && here.join("made/result.json").exists());
    let back = execute(
        here,
        &["inventory", "convert", "objects.xlsx", "--to", "csv"],
    );
    assert_eq!(back.stdout, csv.stdout);
    std::fs::write(here.join("objects.csv"), &csv.stdout).unwrap();
    assert!(
        execute(
            here,
            &[
                "inventory",
                "convert",
                "objects.csv",
                "again.xlsx",
                "--to",
                "xlsx"
            ]
        )
        .status
        .success()
    );
    insta::assert_snapshot!(freestand_in(here, &["inventory", "check", "again.xlsx"]));
    let json = execute(here, &["inventory", "check", "objects.csv", "--json"]);
    let document: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(document["schema"], "freestand.inventory/1");
    assert_eq!(
        (&document["counts"]["rows"], &document["counts"]["objects"]),
        (&Value::from(3), &Value::from(9))
    );
    // Two pads of 2190 N/mm under an edge.
    assert_eq!(document["first_rows"][0]["stiffness_n_m"], 4.38e6);
    // The third example is a gas cylinder.
    let kinds: Vec<&Value> = document["problems"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| &one["kind"])
        .collect();
    assert_eq!(kinds, ["example", "round"]);
}

#[test]
fn what_is_wrong_is_said_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = "Ward 3\n\nid,item,level,height,depth [px],mass [kg]\n\
                a,rack,3,1800,24,140\na,rack,0.5,1.8 m,24,abc\n";
    std::fs::write(here.join("objects.csv"), text).unwrap();
    let cases: [&[&str]; 8] = [
        &["inventory", "check", "objects.csv"],
        &["inventory", "check", "objects.csv", "--sheet", "Ward 3"],
        &["inventory", "check", "nowhere.xlsx"],
        &["inventory", "template", "--xlsx"],
        &[
            "inventory",
            "convert",
            "objects.csv",
            "objects.csv",
            "--to",
            "csv",
        ],
        // A list that somebody filled in.
        &["inventory", "template", "objects.csv"],
        &["inventory", "template", "--xlsx", "new.csv"],
        &[
            "inventory",
            "convert",
            "objects.csv",
            "new.xlsx",
            "--to",
            "csv",
        ],
    ];
    let all: Vec<String> = cases.iter().map(|args| freestand_in(here, args)).collect();
    cases::each("what_is_wrong_is_said_at_once", &all);
    assert_eq!(
        std::fs::read_to_string(here.join("objects.csv")).unwrap(),
        text
    );
}

/// An object that falls in every world, and one that cannot be read: as few worlds as possible.
const LIST: &str = "id,item,floor,quantity,life safety,PL,FL,height [mm],thickness [mm],mass [kg]\n\
                    pole,=Pole,roof,2,H,M,,4000,100,20\nbox,Box,ground,1,,,L,tall0x,900,50\n";

#[test]
fn an_assessment_says_whose_building_it_is_and_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(
        here.join("list.csv"),
        LIST.lines()
            .take(2)
            .map(|line| format!("{line}\n"))
            .collect::<String>(),
    )
    .unwrap();
    let done = execute(here, &["assess", "--inventory", "list.csv"]);
    let text = String::from_utf8(done.stdout).unwrap();
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    assert!(
        text.starts_with(
            "Nobody stated the place and the building: this is a 30-storey tower in Melbourne"
        ),
        "{text}"
    );
    for said in [
        "restrain          1  fix it to the building",
        "   1  pole  =Pole  roof   restrain  falls 100 %",
        "worklist.csv",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let report = std::fs::read_to_string(here.join("freestand-assessment/report.html")).unwrap();
    let main = report.split("<main>").nth(1).unwrap();
    assert!(
        main.trim_start()
            .starts_with("<div class=\"warn study\"><p>Nobody stated the place and the building: ")
    );
    let work = std::fs::read_to_string(here.join("freestand-assessment/worklist.csv")).unwrap();
    assert!(
        work.lines()
            .nth(1)
            .unwrap()
            .starts_with("roof,,pole,'=Pole,2,restrain,"),
        "{work}"
    );
    // A run that finds its folder complete says the same.
    let again = execute(here, &["assess", "--inventory", "list.csv", "--resume"]);
    let again = String::from_utf8(again.stdout).unwrap();
    assert!(
        again.contains("falls 100 %")
            && again.contains("1 of 1 object, 1 of them from an earlier run"),
        "{again}"
    );
}

#[test]
fn rows_of_an_assessment_are_those_of_its_table_and_named_verdicts_fail() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let study = "[building]\nname = \"Hut\"\nstoreys = 2\n[worlds]\nfirst = 3\nmost = 3\nshares = false\n[assessment]\n\
                 inventory = \"list.csv\"\n";
    std::fs::write(here.join("study.toml"), study).unwrap();
    std::fs::write(here.join("list.csv"), LIST).unwrap();
    let assess = |more: &[&str]| {
        let done = execute(
            here,
            &[
                &["assess", "study.toml", "--json", "--resume", "--out", "out"],
                more,
            ]
            .concat(),
        );
        (
            done.status.code().unwrap(),
            serde_json::from_slice::<Value>(&done.stdout).unwrap(),
        )
    };
    // A cell of the list cannot be read.
    let (status, document) = assess(&[]);
    assert_eq!(
        (status, &document["objects"], &document["building_name"]),
        (1, &Value::from(2), &Value::from("Hut"))
    );
    let rows = document["rows"].as_array().unwrap();
    let table = std::fs::read_to_string(here.join("out/objects.csv")).unwrap();
    assert_eq!(rows.len(), 2);
    for name in table.lines().next().unwrap().split(',') {
        assert!(rows[0].get(name).is_some(), "{name}");
    }
    let pole = &rows[0];
    assert_eq!(
        (&pole["row"], &pole["item"], &pole["falls"]),
        (
            &Value::from(2),
            &Value::from("=Pole"),
            &Value::from("falls")
        )
    );
    assert_eq!(
        (&pole["life_safety"], &pole["property"], &pole["function"]),
        (&"high".into(), &"medium".into(), &Value::Null)
    );
    assert_eq!(
        (
            &rows[1]["function"],
            &rows[1]["shock"],
            &rows[1]["height_m"]
        ),
        (&"low".into(), &Value::Null, &Value::Null)
    );
    std::fs::write(here.join("list.csv"), LIST.replace("tall0x", "")).unwrap();
    let statuses = [
        &[][..],
        &["--fail-on", "soften"],
        &["--fail-on", "soften", "--fail-on", "restrain"],
    ]
    .map(|more| assess(more).0);
    assert_eq!(statuses, [0, 0, 1]);
}

/// A register: a height in metres in a column of millimetres, amounts with thousands.
const REGISTER: &str = "Asset No;Description;Level;Height (mm);Depth (mm);Width (mm);Weight (kg);Replacement value NZD\n\
                        A-1;cabinet;roof;1.8;450;900;140;62,000\nA-2;cabinet;roof;1900;460;900;150;$4,500\n";

#[test]
fn one_list_goes_through_all_commands_and_its_cells_are_corrected_alike() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let study =
        "[building]\nname = \"Hut\"\nstoreys = 2\n[worlds]\nfirst = 3\nmost = 3\nshares = false\n";
    std::fs::write(here.join("study.toml"), study).unwrap();
    std::fs::write(here.join("list.csv"), REGISTER).unwrap();
    let document = |args: &[&str]| {
        let done = execute(here, &[args, &["--json"]].concat());
        assert!(
            done.status.code().unwrap() < 2,
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        serde_json::from_slice::<Value>(&done.stdout).unwrap()
    };
    let checked = document(&["inventory", "check", "list.csv", "--storeys", "2"]);
    let problems = checked["problems"].as_array().unwrap();
    let problem = problems
        .iter()
        .find(|problem| problem["kind"] == "implausible-size")
        .unwrap();
    assert_eq!(problem["edits"][0], "D2=1.8 m");
    assert_eq!(checked["objects"][0]["to_confirm"][0], "D2=1.8 m");
    let heading = &checked["headings"][3];
    assert_eq!(
        (&heading["column"], &heading["name"], &heading["samples"][0]),
        (&"D".into(), &"height".into(), &"1.8".into())
    );
    assert!(
        checked["senses"]
            .as_array()
            .unwrap()
            .iter()
            .any(|sense| sense["name"] == "height")
    );
    // No verdict until the size is confirmed, and it says how.
    let assess = |more: &[&str], out: &str| {
        document(
            &[
                &[
                    "assess",
                    "study.toml",
                    "--inventory",
                    "list.csv",
                    "--out",
                    out,
                ],
                more,
            ]
            .concat(),
        )
    };
    let before = assess(&[], "before");
    assert_eq!(
        (&before["rows"][0]["decision"], &before["rows"][0]["rank"]),
        (&"no-verdict".into(), &2.into())
    );
    assert_ne!(before["rows"][1]["decision"], "no-verdict");
    let work = std::fs::read_to_string(here.join("before/worklist.csv")).unwrap();
    assert!(work.contains("D2=1.8 m"), "{work}");
    let after = assess(&["--edit", "D2=1.8 m"], "after");
    assert_eq!(
        (
            &after["rows"][0]["height_m"],
            &after["rows"][0]["overturn_share"].is_null()
        ),
        (&1.8.into(), &false)
    );
    // Every command that reads a list takes the same flags.
    for command in [
        &["fragility", "study.toml"][..],
        &["shard", "plan", "study.toml", "--shards", "2"],
    ] {
        let done = execute(
            here,
            &[
                command,
                &[
                    "--inventory",
                    "list.csv",
                    "--edit",
                    "nonsense",
                    "--out",
                    "x",
                ],
            ]
            .concat(),
        );
        let said = String::from_utf8(done.stderr).unwrap();
        assert!(
            done.status.code() == Some(2) && said.contains("has no ="),
            "{said}"
        );
    }
    // Costs come from the same list.
    let outcomes: String = ["A-1", "A-2"]
        .iter()
        .flat_map(|id| {
            (0..8).map(move |n| {
                let outcome = if n < 3 {
                    "no-uplift"
                } else if n < 5 {
                    "rocked"
                } else {
                    "overturned"
                };
                format!("{id},m{n},{},{outcome}\n", 0.2 + 0.1 * f64::from(n))
            })
        })
        .collect();
    std::fs::write(
        here.join("outcomes.csv"),
        format!("object,motion,pgv [m/s],outcome\n{outcomes}"),
    )
    .unwrap();
    let risk = |more: &[&str]| {
        let law = [
            "--hazard-im",
            "pgv",
            "--hazard-power",
            "k0=1e-3 /yr, k=2.5, reference=1 m/s",
            "--bootstrap",
            "0",
        ];
        let list = [
            "risk",
            "--outcomes",
            "outcomes.csv",
            "--inventory",
            "list.csv",
        ];
        document(&[&list[..], &law, more].concat())
    };
    let loss = |document: &Value| document["expected_annual_loss"].as_f64();
    let (first, doubled) = (risk(&[]), risk(&["--edit", "H2=124,000"]));
    assert_eq!(first["currency"], "NZD", "{first}");
    let (first, doubled) = (loss(&first).unwrap(), loss(&doubled).unwrap());
    // Both objects fail alike: 62,000 and 4,500 NZD, then 124,000 and 4,500 NZD.
    assert!(
        first > 0.0 && (doubled / first - 128.5 / 66.5).abs() < 1e-9,
        "{first} {doubled}"
    );
}

/// What came in US units is shown in them, unless others are asked for; JSON is in SI.
#[test]
fn inventory_check_shows_the_units_of_the_list() {
    const US: &str =
        "id,level_ratio,height [in],depth [in],mass [lb],tolerance [g]\na,0.5,72,18,300,5\n";
    let folder = folder(&[
        ("us.csv", US),
        (
            "cells.csv",
            "id,level_ratio,height,depth,Unit\na,0.5,72,18,in\n",
        ),
        (
            "si.csv",
            "id,level_ratio,height [mm],depth [mm]\na,0.5,1800,450\n",
        ),
    ]);
    let shown = |args: &[&str]| expect(&folder, &[&["inventory", "check"], args].concat(), 0);
    for (args, sizes) in [
        (&["us.csv"][..], ["72 in", "18 in", "300 lb"]),
        (
            &["us.csv", "--units", "si"],
            ["1.8288 m", "457.2 mm", "136.078 kg"],
        ),
        (&["cells.csv"], ["72 in", "18 in", "-"]),
        (&["si.csv"], ["1.8 m", "450 mm", "-"]),
        (&["si.csv", "--units", "us"], ["70.87 in", "17.72 in", "-"]),
    ] {
        let text = shown(args);
        assert!(
            sizes.iter().all(|size| text.contains(size)),
            "{args:?}: {text}"
        );
    }
    let told = document(
        folder.path(),
        &["inventory", "check", "us.csv", "--units", "us"],
    );
    assert_eq!(told["first_rows"][0]["height_m"], 1.8288);
}
