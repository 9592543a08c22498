//! Runs of lists, runs that are stopped, kept or too many, and their shocks.

use super::fragility_runs::{call, curve, motions, names, stopped};
use crate::program::{command, document, execute, refused};
use serde_json::Value;
use std::fmt::Write as _;
use std::fs;

/// Runs at added intensities are kept as the first ones are, for the same hazard.
#[test]
#[ignore = "ten seconds: runs at many intensities"]
fn runs_at_added_intensities_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let list = "id,floor,height [m],thickness [m]\nlow,1,1.6,0.4\nhigh,2,2.2,0.4\n";
    fs::write(folder.join("list.csv"), list).unwrap();
    let study =
        "[building]\nstoreys = 2\nstorey_height = \"3 m\"\n[assessment]\ncompliant = false\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let runs = [
        "fragility",
        "study.toml",
        "--inventory",
        "list.csv",
        "--worlds",
        "4",
        "--bootstrap",
        "0",
        "--quiet",
    ];
    let stripes = [
        "--method",
        "stripes",
        "--scales",
        "0.3 m/s, 0.9 m/s",
        "--resume",
        "--hazard-power",
    ];
    let law = "k0=1e-2 /yr, k=2.5, reference=0.2 m/s";
    let call = |law: &str, flags: &[&str]| {
        execute(
            folder,
            &[&runs[..], &stripes, &[law, "--out"], flags].concat(),
        )
        .status
        .code()
    };
    assert_eq!(call(law, &["whole"]), Some(0));
    // Stopped by what cannot be exported, and one of the later parts is lost.
    let wrong = ["parts", "--fit", "separate", "--format", "pelicun"];
    assert_eq!(call(law, &wrong), Some(2));
    let progress = folder.join("parts/progress");
    let written = |name: &str| {
        fs::metadata(progress.join(name))
            .unwrap()
            .modified()
            .unwrap()
    };
    let before = ["000000.jsonl", "0100000000.jsonl"].map(written);
    fs::remove_file(progress.join("0200000000.jsonl")).unwrap();
    assert_eq!(call(law, &wrong), Some(2));
    assert!(progress.join("0200000000.jsonl").exists());
    assert_eq!(["000000.jsonl", "0100000000.jsonl"].map(written), before);
    let plan = || fs::read_to_string(progress.join("plan")).unwrap();
    let of_law = plan();
    assert_eq!(call(law, &["parts"]), Some(0));
    let [whole, parts] = ["whole", "parts"]
        .map(|out| fs::read_to_string(folder.join(out).join("outcomes.csv")).unwrap());
    assert!(whole == parts && !progress.exists());
    // Other intensities belong to another hazard.
    assert_eq!(call("k0=1e-2 /yr, k=3, reference=0.2 m/s", &wrong), Some(2));
    assert!(plan() != of_law);
}

#[test]
fn what_memory_cannot_hold_is_refused_with_its_bound() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let said = |flags: &[&str]| refused(folder, &call(&motions, flags));
    assert!(said(&["--bootstrap", "4294967295"]).contains("samples are too many"));
    assert!(
        said(&["--method", "stripes", "--scales", "0.1 m/s:1 m/s:300000"])
            .contains("300000 scales are too many")
    );
    let many = [
        "--format",
        "pelicun",
        "--demand",
        "1 m/s",
        "--out",
        "o",
        "--realizations",
        "4294967295",
    ];
    assert!(said(&many).contains("realizations are too many"));
}

/// A command that is not stopped ends with 0.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_stops_runs_and_bootstrap_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let mut table = "object,motion,pfv [m/s],outcome\n".to_owned();
    for (motion, level) in (0..30).flat_map(|motion| (1..40).map(move |level| (motion, level))) {
        let class = if 10 + motion % 17 < level {
            "overturned"
        } else {
            "no-uplift"
        };
        writeln!(table, "a,m{motion},0.{level:02},{class}").unwrap();
    }
    fs::write(folder.join("table.csv"), table).unwrap();
    let before = names(folder);
    let scales = [
        "--scales",
        "0.001:9:10000",
        "--bootstrap",
        "0",
        "--quiet",
        "--out",
        "o",
    ];
    assert_eq!(stopped(folder, &call(&motions, &scales)), Some(130));
    let fit = [
        "fragility",
        "--outcomes",
        "table.csv",
        "--bootstrap",
        "100000",
        "--quiet",
        "--out",
        "o",
    ];
    assert_eq!(stopped(folder, &fit), Some(130));
    assert_eq!(names(folder), before);
}

/// After a command was killed after the first of three parts, that part is used, the others are
/// run, and every file has the bytes of a command that was not killed.
#[test]
#[ignore = "ten seconds: runs of an inventory, twice"]
fn runs_of_an_inventory_that_are_killed_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut list =
        "id,floor,height [m],thickness [m],mass [kg],stiffness [N/mm],tolerance [g]\n".to_owned();
    for i in 0..48 {
        writeln!(list, "o{i},{},1.{i:02},0.4,{},3000,3", i % 4, 100 + i).unwrap();
    }
    fs::write(folder.join("list.csv"), list).unwrap();
    // Without the pads, which take longest.
    let study =
        "[building]\nstoreys = 4\nstorey_height = \"3 m\"\n[assessment]\ncompliant = false\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let runs = [
        "fragility",
        "study.toml",
        "--inventory",
        "list.csv",
        "--worlds",
        "4",
        "--bootstrap",
        "0",
        "--quiet",
    ];
    assert!(
        execute(folder, &[&runs[..], &["--out", "whole"]].concat())
            .status
            .success()
    );
    assert!(!folder.join("whole/progress").exists());

    let killed = [&runs[..], &["--out", "killed"]].concat();
    let mut child = command(folder)
        .args(&killed)
        .args(["--threads", "1"])
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let part = folder.join("killed/progress/000000.jsonl");
    while !part.exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    child.kill().unwrap();
    assert_eq!(
        child.wait().unwrap().code(),
        None,
        "it had ended before it was killed"
    );
    let written = fs::metadata(&part).unwrap().modified().unwrap();
    assert!(!folder.join("killed/outcomes.csv").exists());
    // Other fits of the same runs use the part as well: stopped by what cannot be exported.
    let wrong = [
        &killed[..],
        &["--resume", "--fit", "separate", "--format", "pelicun"],
    ]
    .concat();
    assert_eq!(execute(folder, &wrong).status.code(), Some(2));
    assert_eq!(fs::metadata(&part).unwrap().modified().unwrap(), written);
    assert!(
        execute(folder, &[&killed[..], &["--resume"]].concat())
            .status
            .success()
    );
    for entry in fs::read_dir(folder.join("whole")).unwrap() {
        let name = entry.unwrap().file_name();
        let [one, other] =
            ["whole", "killed"].map(|out| fs::read(folder.join(out).join(&name)).unwrap());
        assert!(one == other, "{}", name.display());
    }
    assert!(!folder.join("killed/progress").exists());
    let said = refused(
        folder,
        &["fragility", "--inventory", "list.csv", "--resume"],
    );
    assert!(
        said.contains("--resume continues runs in their folder"),
        "{said}"
    );
}

/// The fit of the shocks of runs equals that of their table of outcomes with the tolerance and the
/// ceiling of the object, and agrees with P(exceeds) of the runs themselves.
#[test]
#[ignore = "seconds: the runs of several intensities"]
fn shocks_of_runs_are_fitted_below_their_ceiling() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let measure = ["--im", "pfa", "--bootstrap", "0"];
    let flags = [
        "--tolerance",
        "2g",
        "--fit",
        "two-stage",
        "--parquet",
        "--out",
        "o",
    ];
    let found = document(folder, &call(&motions, &[&measure[..], &flags].concat()));
    let one = &found["objects"][0];
    let shock = &one["exceeds_by_shock"];
    assert_eq!(
        (&one["fit"], &shock["why"]),
        (&"two-stage".into(), &Value::Null)
    );
    assert!(
        one["curves"]
            .as_array()
            .unwrap()
            .iter()
            .all(|curve| curve["limit_state"] != "exceeds")
    );
    let ceiling = format!("{} g", shock["ceiling_g"]);
    let table = [
        "fragility",
        "--outcomes",
        "o/outcomes.csv",
        "--fit",
        "two-stage",
        "--bootstrap",
        "0",
    ];
    let again = document(
        folder,
        &[&table[..], &["--tolerance", "2g", "--ceiling", &ceiling]].concat(),
    );
    assert_eq!(shock, &again["objects"][0]["exceeds_by_shock"]);
    assert!(
        fs::read(folder.join("o/outcomes.parquet"))
            .unwrap()
            .starts_with(b"PAR1")
    );

    // At the intensity at which half of the runs exceed the tolerance by an ordered fit, they do so
    // by this fit, too. Both are models; the standard error of six motions is β/√6, 0.1 in ln x.
    let ordered = document(
        folder,
        &call(&motions, &[&measure[..], &["--tolerance", "2g"]].concat()),
    );
    let by_class = curve(&ordered["objects"][0], "exceeds")["median"]
        .as_f64()
        .unwrap();
    assert!(
        (shock["median"].as_f64().unwrap() / by_class).ln().abs() < 0.2,
        "{shock} {by_class}"
    );

    // At the ceiling only overturning exceeds it.
    let above = document(
        folder,
        &call(
            &motions,
            &[&measure[..], &["--tolerance", "99g", "--fit", "two-stage"]].concat(),
        ),
    );
    let one = &above["objects"][0];
    assert_eq!(one["exceeds_by_shock"]["why"], "ceiling");
    let median = one["exceeds_by_shock"]["median"].as_f64().unwrap();
    // Bisected to the last digits of ln x.
    assert!((median / curve(one, "overturns")["median"].as_f64().unwrap() - 1.0).abs() < 1e-9);
    for (flags, why) in [
        (
            &["--tolerance-edge-lift", "2mm"][..],
            "not a peak acceleration alone",
        ),
        (&[], "no tolerance"),
    ] {
        let said = refused(
            folder,
            &call(&motions, &[&["--fit", "two-stage"], flags].concat()),
        );
        assert!(
            said.contains("--fit two-stage needs the shocks") && said.contains(why),
            "{said}"
        );
    }
    assert!(refused(folder, &table).contains("needs the tolerance and the ceiling"));
}

#[test]
#[ignore = "ten seconds: runs of an inventory"]
fn an_inventory_is_run_on_the_floors_of_its_study() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let list = "id,floor,height [m],thickness [m],mass [kg],stiffness [N/mm],tolerance [g],casters\n\
                shelf,2,1.8,0.4,,,,\nrack,4,2.0,0.6,300,4000,3,\ntrolley,1,1.0,0.5,,,,free\n";
    fs::write(folder.join("list.csv"), list).unwrap();
    let study = "[building]\nstoreys = 4\nstorey_height = \"3 m\"\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let call = [
        "fragility",
        "study.toml",
        "--inventory",
        "list.csv",
        "--worlds",
        "3",
        "--bootstrap",
        "0",
    ];
    let found = document(
        folder,
        &[&call[..], &["--im", "pgv, pfv", "--out", "o"]].concat(),
    );
    let ids: Vec<(&str, &str)> = found["objects"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| (one["id"].as_str().unwrap(), one["at"].as_str().unwrap()))
        .collect();
    let each = |at| ["shelf", "rack", "trolley"].map(|id| (id, at));
    assert_eq!(ids, [each("ground"), each("floor")].concat());
    assert_eq!(found["left_out"], serde_json::json!([]));
    // It rolls, and nothing that was named stops it.
    let trolley = &found["objects"][2]["counts"];
    assert!(
        trolley["no_uplift"].as_f64().unwrap() > 0.0 && trolley["overturned"] == 0.0,
        "{trolley}"
    );
    let states = |i: usize| {
        found["objects"][i]["curves"]
            .as_array()
            .unwrap()
            .iter()
            .any(|one| one["limit_state"] == "exceeds")
    };
    assert!(!states(0) && (states(1) || found["objects"][1]["counts"]["exceeded"] == 0.0));
    // An object depends on its row alone.
    fs::write(
        folder.join("short.csv"),
        list.lines().take(2).collect::<Vec<_>>().join("\n"),
    )
    .unwrap();
    let call = [
        "fragility",
        "study.toml",
        "--inventory",
        "short.csv",
        "--worlds",
        "3",
        "--bootstrap",
        "0",
    ];
    let short = document(folder, &[&call[..], &["--im", "pgv, pfv"]].concat());
    assert_eq!(found["objects"][0], short["objects"][0]);
}

/// The built-in building is not the user's, and the document says so; cells that cannot be read are named.
#[test]
fn a_list_without_a_study_says_whose_building_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let list = "id,floor,height [mm],thickness [mm]\nshelf,0,1800,400\nrack,0,-5,500\n";
    fs::write(folder.join("list.csv"), list).unwrap();
    let call = [
        "fragility",
        "--inventory",
        "list.csv",
        "--place",
        "Wellington",
    ];
    let call = [&call[..], &["--worlds", "2", "--bootstrap", "0"]].concat();
    let output = execute(folder, &[&call[..], &["--json"]].concat());
    assert_eq!(output.status.code(), Some(1), "a cell could not be read");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let sentence = "Nobody stated the building: this is a 30-storey tower in Wellington, not your building. Give storeys.";
    assert_eq!(
        (&found["no_study"], &found["warnings"][0]),
        (&sentence.into(), &sentence.into())
    );
    assert!(
        found["hazard"]
            .as_str()
            .unwrap()
            .starts_with("Wellington (NZS 1170.5"),
        "{}",
        found["hazard"]
    );
    assert_eq!(found["building"], "tower, 30 storeys, 96 m high");
    assert!(
        found["study"]
            .as_str()
            .unwrap()
            .contains("place = \"Wellington\"")
    );
    let warnings = found["warnings"].to_string();
    assert!(
        warnings.contains("in the list: error: out-of-range"),
        "{warnings}"
    );
    assert_eq!(
        (&found["place_is_assumed"], &found["building_is_assumed"]),
        (&false.into(), &true.into())
    );
    assert!(
        found["assumptions"]
            .to_string()
            .contains("a building of 30 storeys"),
        "{}",
        found["assumptions"]
    );
    let output = execute(folder, &call);
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .starts_with(sentence)
    );
    // A number of storeys is a building.
    let output = execute(folder, &[&call[..], &["--storeys", "3", "--json"]].concat());
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (&found["no_study"], &found["building"]),
        (&Value::Null, &"3 storeys, 9.6 m high".into())
    );
}

/// A wider base is run as an object of its own, and pays as an option does whose curves are in a file.
#[test]
#[ignore = "ten seconds: runs of an inventory"]
fn an_option_that_changes_its_object_is_run_and_worth_what_its_curves_say() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let list = "id,floor,height [m],thickness [m],base_thickness [m],quantity,replacement_cost [AUD]\n\
                shelf,2,1.8,0.7,0.35,3,9000\nrack,1,2,0.6,,1,5000\n";
    fs::write(folder.join("list.csv"), list).unwrap();
    let study = "[building]\nstoreys = 4\nstorey_height = \"3 m\"\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let options = "id,option,cost [AUD],base_thickness [mm],curves\nshelf,feet,200,700,\n";
    fs::write(folder.join("options.csv"), options).unwrap();
    let runs = [
        "fragility",
        "study.toml",
        "--inventory",
        "list.csv",
        "--worlds",
        "4",
        "--bootstrap",
        "0",
    ];
    let stripes = [
        "--im",
        "pgv",
        "--method",
        "stripes",
        "--scales",
        "0.2 m/s:2 m/s:5",
        "--max-scale",
        "30",
    ];
    let call = [&runs[..], &stripes[..]].concat();
    let found = document(
        folder,
        &[&call[..], &["--options", "options.csv", "--out", "runs"]].concat(),
    );
    let overturned = |i: usize| {
        found["objects"][i]["counts"]["overturned"]
            .as_f64()
            .unwrap()
    };
    let ids: Vec<&Value> = found["objects"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| &one["id"])
        .collect();
    assert_eq!(ids, ["shelf", "rack", "shelf/feet"]);
    // On a base that is twice as wide it overturns under fewer of the 20 runs.
    assert!(
        overturned(2) < overturned(0),
        "{} {}",
        overturned(0),
        overturned(2)
    );
    // The object itself is run as without options.
    let plain = document(folder, &[&call[..], &["--out", "plain"]].concat());
    assert_eq!(found["objects"][0], plain["objects"][0]);

    let hazard = [
        "--hazard-power",
        "k0=1e-3 /yr, k=2.5, reference=1 m/s",
        "--hazard-im",
        "pgv",
    ];
    let money = [
        "--inventory",
        "list.csv",
        "--horizon",
        "40 yr",
        "--discount",
        "3 %",
    ];
    let risk = |runs: &str, options: &str| {
        let outcomes = format!("{runs}/outcomes.csv");
        let flags = [
            "risk",
            "--outcomes",
            &outcomes,
            "--bootstrap",
            "0",
            "--options",
            options,
        ];
        document(folder, &[&flags[..], &hazard[..], &money[..]].concat())
    };
    let changed = risk("runs", "options.csv");
    let in_file =
        "id,option,cost [AUD],base_thickness [mm],curves\nshelf,feet,200,,runs/fragility.csv\n";
    fs::write(folder.join("in_file.csv"), in_file).unwrap();
    let named = risk("plain", "in_file.csv");
    assert_eq!(changed["portfolio"]["worlds"], 20);
    for key in ["objects", "portfolio", "ranking"] {
        assert_eq!(changed[key], named[key], "{key}");
    }
    assert!(
        changed["ranking"][0]["benefit_present_value"]
            .as_f64()
            .unwrap()
            > 0.0
    );
    let args = [
        "risk",
        "--outcomes",
        "plain/outcomes.csv",
        "--bootstrap",
        "0",
        "--options",
        "options.csv",
    ];
    let missing = refused(folder, &[&args[..], &hazard[..], &money[..]].concat());
    assert!(
        missing.contains("options.csv:2: ") && missing.contains("shelf/feet"),
        "{missing}"
    );
    // Outriggers may reach beyond the object, but not into its wall.
    fs::write(
        folder.join("wide.csv"),
        "id,option,cost [AUD],base_thickness [mm]\nshelf,arms,50,1100\n",
    )
    .unwrap();
    let wide = document(folder, &[&call[..], &["--options", "wide.csv"]].concat());
    let of_wide = wide["objects"][2]["counts"]["overturned"].as_f64().unwrap();
    assert!(of_wide < overturned(2), "{of_wide} {}", overturned(2));
    let walled = "id,floor,height [m],thickness [m],wall_gap [mm]\nshelf,2,1.8,0.7,150\n";
    fs::write(folder.join("walled.csv"), walled).unwrap();
    let args = [
        "fragility",
        "study.toml",
        "--inventory",
        "walled.csv",
        "--options",
        "wide.csv",
    ];
    let in_wall = refused(folder, &args);
    assert!(
        in_wall.contains("the feet of shelf would reach 0.2 m beyond it"),
        "{in_wall}"
    );
    let nobody = "id,option,cost [AUD],mass [kg]\nshelve,ballast,50,400\n";
    fs::write(folder.join("nobody.csv"), nobody).unwrap();
    let nobody = refused(folder, &[&call[..], &["--options", "nobody.csv"]].concat());
    assert!(nobody.contains("shelve"), "{nobody}");
}
