//! `freestand fragility` from motions and from an inventory, as it is called.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::program::{command, document, execute, refused};

const CABINET: [&str; 8] = [
    "--height",
    "1.8m",
    "--thickness",
    "0.4m",
    "--mass",
    "150kg",
    "--stiffness",
    "4380 N/mm",
];

/// Six motions of 6 s: three sines each, with periods and phases that differ, under one envelope.
fn motions(folder: &Path) -> Vec<String> {
    let motion = |i: u32| {
        let mut text = "time [s],acceleration [g]\n".to_owned();
        for k in 0..601 {
            let t = f64::from(k) * 0.01;
            let sines: f64 = [0.4, 0.9, 1.7]
                .iter()
                .enumerate()
                .map(|(j, period)| {
                    let period = period * (1.0 + 0.13 * f64::from(i));
                    (std::f64::consts::TAU * t / period + f64::from(i * 3 + j as u32)).sin()
                        / (1.0 + j as f64)
                })
                .sum();
            let envelope = (std::f64::consts::PI * t / 6.0).sin();
            writeln!(text, "{t:.2},{:.9}", 0.12 * envelope * sines).unwrap();
        }
        let name = format!("m{i}.csv");
        fs::write(folder.join(&name), text).unwrap();
        name
    };
    (0..6).map(motion).collect()
}

/// The command with these flags, under all motions.
fn call<'a>(motions: &'a [String], flags: &[&'a str]) -> Vec<&'a str> {
    let names = motions.iter().map(String::as_str);
    ["fragility"]
        .into_iter()
        .chain(CABINET)
        .chain(["--motion"])
        .chain(names)
        .chain(flags.iter().copied())
        .collect()
}

/// The same without the mass and the pads of the cabinet.
fn on_floor<'a>(motions: &'a [String], flags: &[&'a str]) -> Vec<&'a str> {
    let mut all = call(motions, flags);
    all.drain(5..9);
    all
}

fn object<'v>(document: &'v Value, im: &str) -> &'v Value {
    document["objects"]
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["im"] == im)
        .unwrap()
}

fn curve<'v>(object: &'v Value, state: &str) -> &'v Value {
    object["curves"]
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["limit_state"] == state)
        .unwrap()
}

#[test]
#[ignore = "ten seconds: runs of an inventory"]
fn the_fit_of_runs_is_that_of_their_outcomes() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let measures = ["--im", "pfv, pfa, velocity_ratio, acceleration_ratio"];
    let flags = [&["--tolerance", "2g", "--bootstrap", "40"], &measures[..]].concat();
    let one = document(
        folder,
        &call(
            &motions,
            &[&flags[..], &["--out", "one", "--threads", "1"]].concat(),
        ),
    );
    let two = document(
        folder,
        &call(
            &motions,
            &[&flags[..], &["--out", "two", "--threads", "2"]].concat(),
        ),
    );
    assert_eq!(one, two);
    for file in [
        "fragility.json",
        "fragility.csv",
        "outcomes.csv",
        "outcomes_velocity_ratio.csv",
        "ida.svg",
    ] {
        assert_eq!(
            fs::read(folder.join("one").join(file)).unwrap(),
            fs::read(folder.join("two").join(file)).unwrap()
        );
    }
    for (file, im) in [("outcomes.csv", "pfv"), ("outcomes_pfa.csv", "pfa")] {
        let path = format!("one/{file}");
        let again = document(
            folder,
            &["fragility", "--outcomes", &path, "--bootstrap", "40"],
        );
        let (run, fit) = (object(&one, im), &again["objects"][0]);
        for key in [
            "id",
            "at",
            "motions",
            "runs",
            "unresolved",
            "counts",
            "curves",
            "log_likelihood",
            "goodness",
        ] {
            assert_eq!(run[key], fit[key], "{im} {key}");
        }
        assert_eq!(
            (&run["method"], &fit["method"]),
            (&Value::from("ida"), &Value::from("outcomes"))
        );
    }

    // Both ratios are the peaks times numbers of the block: p/(g tan α) and 1/(g tan α), with
    // tan α = 0.4/1.8 and p² = 3g/4R.
    let (tan_alpha, half_diagonal_m) = (0.4 / 1.8, 0.5 * 1.8_f64.hypot(0.4));
    let p = (0.75 * 9.80665 / half_diagonal_m).sqrt();
    let of = |im: &str, key: &str| curve(object(&one, im), "overturns")[key].as_f64().unwrap();
    // The likelihood is solved to 1e-8.
    let ratio = of("velocity_ratio", "median") / of("pfv", "median") / (p / (9.80665 * tan_alpha));
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
    assert!((of("velocity_ratio", "beta") / of("pfv", "beta") - 1.0).abs() < 1e-6);
    assert!(
        (of("acceleration_ratio", "median") / of("pfa", "median") * tan_alpha - 1.0).abs() < 1e-6
    );

    // Without vertical motion an edge lifts from a rigid base exactly at an acceleration ratio of 1, which is run 0.1 %
    // below and above; intensities have 16 digits.
    let rigid = document(
        folder,
        &on_floor(&motions, &[&measures[..], &["--bootstrap", "0"]].concat()),
    );
    let rocks = curve(object(&rigid, "acceleration_ratio"), "rocks");
    let end = |key: &str| rocks[key].as_f64().unwrap();
    assert_eq!(rocks["kind"], "step");
    assert!(
        (end("lower") * 1.001 - 1.0).abs() < 1e-6 && (end("upper") / 1.001 - 1.0).abs() < 1e-6,
        "{rocks}"
    );
    assert!((end("median") - 1.0).abs() < 1e-12, "{rocks}");

    // Every measure has its quality, and the ranking puts the most proficient one first.
    let ranking = rigid["im_ranking"]
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["limit_state"] == "overturns")
        .unwrap();
    let proficiencies: Vec<f64> = ranking["measures"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["proficiency"].as_f64().unwrap())
        .collect();
    assert!(
        proficiencies.len() == 4 && proficiencies.is_sorted(),
        "{proficiencies:?}"
    );
    let overturns = &object(&rigid, "pfv")["measures"][1];
    let quality = |key: &str| overturns[key].as_f64().unwrap();
    assert_eq!(
        quality("proficiency"),
        quality("efficiency") / quality("practicality")
    );
    assert!(
        overturns["sufficiency"]["magnitude"].is_null()
            && overturns["sufficiency"]["mean_period"].is_f64()
    );
}

#[test]
#[ignore = "ten seconds: runs at many intensities"]
fn every_scale_is_bracketed_and_marked() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let found = document(
        folder,
        &call(&motions, &["--bootstrap", "0", "--out", "ida"]),
    );
    // Without a tolerance there is nothing to exceed.
    let states: Vec<&Value> = found["objects"][0]["curves"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| &one["limit_state"])
        .collect();
    assert_eq!(states, ["rocks", "overturns"]);
    let text = fs::read_to_string(folder.join("ida/outcomes.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let marked = rows
        .iter()
        .filter(|row| row[6].parse::<f64>().unwrap() > 4.0)
        .count();
    assert_eq!(found["objects"][0]["scaled_above_4"], marked);
    for name in ["m0", "m3", "m5"] {
        let runs: Vec<(f64, &str)> = rows
            .iter()
            .filter(|row| row[1] == name)
            .map(|row| (row[6].parse().unwrap(), row[3]))
            .collect();
        assert!(
            runs.windows(2)
                .all(|pair| pair[0].0 < pair[1].0 && pair[1].0 <= 10.0),
            "{name}"
        );
        let first = runs.iter().position(|run| run.1 == "overturned").unwrap();
        assert!(runs[first].0 / runs[first - 1].0 <= 1.05 + 1e-12, "{name}");
        // No gap is wider than the step of 1.3.
        assert!(
            runs.windows(2)
                .all(|pair| pair[1].0 / pair[0].0 <= 1.3 + 1e-9),
            "{name}"
        );
    }

    // Without another tolerance, an upright run exceeds it just where its rotation is above 0.4 α.
    document(
        folder,
        &call(
            &motions,
            &[
                "--bootstrap",
                "0",
                "--tolerance-rotation",
                "0.4",
                "--out",
                "limited",
            ],
        ),
    );
    let text = fs::read_to_string(folder.join("limited/outcomes.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let mut counts = [0, 0];
    for row in rows
        .iter()
        .filter(|row| ["rocked", "exceeded"].contains(&row[3]))
    {
        let is_above = row[7].parse::<f64>().unwrap() > 0.4;
        assert_eq!(row[3] == "exceeded", is_above, "{row:?}");
        counts[usize::from(is_above)] += 1;
    }
    assert!(
        counts.iter().all(|count| *count >= 6),
        "both sides of the boundary of every motion: {counts:?}"
    );
}

/// Of the rigid base and the pads the worse counts: what overturns on the floor does so on any pads. Where
/// a pad bottoms the rigid base answers, no run is left out, and hard landings exceed the tolerance.
#[test]
#[ignore = "ten seconds: runs on pads"]
fn the_worse_of_rigid_base_and_pads_counts() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let stripes = [
        "--method",
        "stripes",
        "--scales",
        "0.1 m/s:1.2 m/s:12",
        "--max-scale",
        "50",
        "--bootstrap",
        "0",
    ];
    let tolerance = ["--tolerance", "20 g", "--fit", "separate"];
    let bottoms = ["--law", "tangent", "--bottoming", "0.3mm"];
    let outcomes = |name: &str, call: Vec<&str>| -> Vec<(String, String)> {
        let found = document(folder, &[&call[..], &["--out", name]].concat());
        assert_eq!(
            (
                &found["objects"][0]["unresolved"],
                found["objects"][0]["runs"].as_f64()
            ),
            (&Value::from(0), Some(72.0))
        );
        let text = fs::read_to_string(folder.join(name).join("outcomes.csv")).unwrap();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        text.lines()
            .skip(1)
            .map(cells)
            .map(|mut row| (row.remove(3), row.remove(3)))
            .collect()
    };
    let floor = outcomes("floor", on_floor(&motions, &stripes));
    let pads = outcomes("pads", call(&motions, &[&stripes[..], &tolerance].concat()));
    let soft = outcomes(
        "soft",
        call(&motions, &[&stripes[..], &tolerance, &bottoms].concat()),
    );
    let fallen =
        |rows: &[(String, String)]| rows.iter().filter(|row| row.0 == "overturned").count();
    for (floor, found) in floor.iter().zip(&pads).chain(floor.iter().zip(&soft)) {
        assert!(
            floor.0 != "overturned" || found.0 == "overturned",
            "{floor:?} {found:?}"
        );
    }
    assert!(
        (10..60).contains(&fallen(&floor)) && fallen(&pads) > fallen(&floor),
        "{} {}",
        fallen(&floor),
        fallen(&pads)
    );
    let bottomed = soft
        .iter()
        .filter(|row| row.0 == "exceeded" && row.1.is_empty())
        .count();
    assert!(bottomed > 3, "{soft:?}");
}

#[test]
fn stripes_have_the_same_levels_and_a_cloud_its_motions() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let scales = [
        "--method",
        "stripes",
        "--scales",
        "0.2 m/s, 0.4 m/s, 0.8 m/s",
        "--bootstrap",
        "0",
        "--out",
        "s",
    ];
    let stripes = document(folder, &call(&motions, &scales));
    assert_eq!(stripes["objects"][0]["runs"].as_f64(), Some(18.0));
    let text = fs::read_to_string(folder.join("s/outcomes.csv")).unwrap();
    for row in text.lines().skip(1) {
        let x: f64 = row.split(',').nth(2).unwrap().parse().unwrap();
        assert!(
            [0.2, 0.4, 0.8]
                .iter()
                .any(|level| (x / level - 1.0_f64).abs() < 1e-12),
            "{x}"
        );
    }
    let cloud = document(
        folder,
        &call(&motions, &["--method", "cloud", "--bootstrap", "0"]),
    );
    assert_eq!(
        (
            cloud["objects"][0]["runs"].as_f64(),
            &cloud["objects"][0]["method"]
        ),
        (Some(6.0), &"cloud".into())
    );
    assert!(cloud["objects"][0]["goodness"]["ks"].is_null());
}

/// Stripes without intensities take some from the uplift on, so close together that little of a rate is
/// between two of them.
#[test]
#[ignore = "seconds: the runs of several intensities"]
fn stripes_choose_their_intensities() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let found = document(
        folder,
        &call(&motions, &["--method", "stripes", "--bootstrap", "0"]),
    );
    let levels: Vec<f64> = found["scales"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect();
    // A factor of 1.1, and rounding.
    assert!(
        levels.len() > 5 && levels.windows(2).all(|pair| pair[1] / pair[0] < 1.1 + 1e-9),
        "{levels:?}"
    );
    let rocks = &found["objects"][0]["curves"][0];
    let below = rocks["capacity"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|one| one["to"].as_f64() == Some(levels[0]));
    assert_eq!(below.count(), 0, "nothing rocks at the lowest: {rocks}");
}

/// What the runs of a folder say about the rate of overturning: its ends, the rate, and the warnings.
fn overturning(folder: &Path, runs: &str, law: &[&str]) -> ([f64; 2], f64, String) {
    let table = format!("{runs}/outcomes.csv");
    let risk = document(
        folder,
        &[&["risk", "--outcomes", &table, "--bootstrap", "0"], law].concat(),
    );
    let states = risk["objects"][0]["limit_states"].as_array().unwrap();
    let one = states
        .iter()
        .find(|one| one["limit_state"] == "overturns")
        .unwrap();
    let number = |key: &str| one[key].as_f64().unwrap_or_else(|| panic!("{key}: {one}"));
    let ends = ["annual_rate_lower", "annual_rate_upper"].map(number);
    (ends, number("annual_rate"), risk["warnings"].to_string())
}

/// Two intensities leave the rates open; with the hazard, those are added that tell them. The rate of many
/// intensities is then between its ends, and nothing depends on the threads.
#[test]
#[ignore = "seconds: as many intensities as it needs"]
fn a_hazard_adds_intensities_until_the_rates_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let law = ["--hazard-power", "k0=1e-2 /yr, k=2.5, reference=0.2 m/s"];
    let run = |scales: &str, flags: &[&str], out: &str| {
        let stripes = [
            "--method",
            "stripes",
            "--bootstrap",
            "0",
            "--scales",
            scales,
            "--out",
            out,
        ];
        document(folder, &on_floor(&motions, &[&stripes[..], flags].concat()))
    };
    let coarse = run("0.4 m/s, 1.2 m/s", &[], "coarse");
    assert_eq!(
        (&coarse["scales_given"], &coarse["scales_added"]),
        (&2.into(), &Value::Null)
    );
    assert!(
        overturning(folder, "coarse", &law)
            .2
            .contains("more than a tenth")
    );

    let told = run("0.4 m/s, 1.2 m/s", &law, "told");
    let levels: Vec<f64> = told["scales"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect();
    let added = told["scales_added"].as_u64().unwrap() as usize;
    assert!(
        added > 0 && levels.len() == 2 + added && levels.is_sorted(),
        "{levels:?}"
    );
    assert!(
        [0.4, 1.2].iter().all(|given| levels.contains(given)),
        "{levels:?}"
    );
    assert_eq!(told["hazard_curve"]["power_law"]["k"], 2.5);
    let runs = fs::read_to_string(folder.join("told/outcomes.csv")).unwrap();
    assert_eq!(runs.lines().count(), 1 + 6 * levels.len());
    let (ends, _, said) = overturning(folder, "told", &law);
    assert!(!said.contains("more than a tenth"), "{said}");

    run("0.05 m/s:1.5 m/s:120", &[], "fine");
    let (_, rate, _) = overturning(folder, "fine", &law);
    assert!(ends[0] <= rate && rate <= ends[1], "{ends:?} {rate}");

    run(
        "0.4 m/s, 1.2 m/s",
        &[&law[..], &["--threads", "1"]].concat(),
        "one",
    );
    assert_eq!(
        fs::read_to_string(folder.join("one/outcomes.csv")).unwrap(),
        runs
    );

    let ida = refused(folder, &on_floor(&motions, &law));
    assert!(
        ida.contains("a hazard curve adds intensities to stripes, but the method is ida"),
        "{ida}"
    );
    let stripes = [
        "--method",
        "stripes",
        "--hazard-im",
        "pfa",
        "--hazard-power",
        "k0=1e-2 /yr, k=2, reference=1 g",
    ];
    let other = refused(folder, &on_floor(&motions, &stripes));
    assert!(
        other.contains("for pfa of the floor, and the outcomes are for pfv of the floor"),
        "{other}"
    );
}

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
fn what_cannot_be_run_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    let said = |flags: &[&str]| refused(folder, &call(&motions, flags));
    assert!(said(&["--im", "pga"]).contains("pga is a measure of the ground"));
    assert!(said(&["--im", "pgx"]).contains("\"pgx\" is not an intensity measure"));
    assert!(said(&["--im", "pfv,pfv"]).contains("twice"));
    assert!(said(&["--scales", "1, 20"]).contains("scaled by 20, above the largest scale of 10"));
    assert!(
        said(&["--method", "cloud", "--scales", "1,2"])
            .contains("a cloud uses every motion unscaled")
    );
    assert!(said(&["--scales", "0:5:6"]).contains("not above 0"));
    assert!(said(&["--outcomes", "o.csv"]).contains("--outcomes contains the runs"));
    assert!(
        said(&["--ceiling", "9g", "--tolerance", "2g"])
            .contains("--ceiling is for --outcomes only")
    );
    assert!(said(&["--inventory", "list.csv"]).contains("is for one object, but an inventory"));
    let alone = |flags: &[&str]| refused(folder, &[&["fragility"], flags].concat());
    assert!(alone(&[]).contains("nothing to run and nothing to fit"));
    assert!(alone(&["--height", "2m", "--thickness", "0.5m"]).contains("no motions"));
    assert!(alone(&["--motion", "m0.csv"]).contains("--height is missing"));
    let no_shock = alone(&[
        "--height",
        "2m",
        "--thickness",
        "0.5m",
        "--tolerance",
        "2g",
        "--motion",
        "m0.csv",
    ]);
    assert!(no_shock.contains("shock of a landing"), "{no_shock}");
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

/// Runs a command until it listens to signals and has worked, stops it, and returns its status.
#[cfg(target_os = "linux")]
pub(crate) fn stopped(folder: &Path, args: &[&str]) -> Option<i32> {
    let mut child = command(folder).args(args).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    // Bit n − 1 of the mask of caught signals is signal n; 15 is SIGTERM.
    let listens = || {
        let status = fs::read_to_string(&status).unwrap_or_default();
        let mask = status
            .lines()
            .find_map(|line| line.strip_prefix("SigCgt:"))
            .map(str::trim);
        mask.and_then(|mask| u64::from_str_radix(mask, 16).ok())
            .is_some_and(|mask| mask >> 14 & 1 == 1)
    };
    // It has used 0.1 s of processor, which is counted in hundredths: fields 14 and 15, where the name
    // of the program in brackets is field 2.
    let stat = format!("/proc/{}/stat", child.id());
    let has_worked = || {
        let stat = fs::read_to_string(&stat).unwrap_or_default();
        let fields = stat.rsplit(") ").next().into_iter();
        let used = fields.flat_map(|rest| rest.split(' ').skip(11).take(2));
        used.filter_map(|ticks| ticks.parse::<u64>().ok())
            .sum::<u64>()
            >= 10
    };
    while !(listens() && has_worked()) && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    assert!(
        Command::new("kill")
            .arg(child.id().to_string())
            .status()
            .unwrap()
            .success()
    );
    child.wait().unwrap().code()
}

#[cfg(target_os = "linux")]
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let name =
        |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
    let mut names: Vec<String> = fs::read_dir(folder).unwrap().map(name).collect();
    names.sort();
    names
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
fn flags_that_would_be_ignored_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (folder, motions) = (folder.path(), motions(folder.path()));
    for flags in [
        &["--place", "Wellington"][..],
        &["--site", "C"],
        &["--return-period", "500"],
        &["--worlds", "3"],
        &["--storeys", "3"],
        &["--sheet", "S"],
        &["--strict"],
        &["--columns", "m.toml"],
        &["--library", "l.csv"],
    ] {
        let said = refused(folder, &call(&motions, flags));
        assert!(
            said.contains(flags[0]) && said.contains("is for an inventory"),
            "{said}"
        );
        let said = refused(
            folder,
            &[&["fragility", "--outcomes", "o.csv"], flags].concat(),
        );
        assert!(said.contains(flags[0]), "{said}");
    }
    for flags in [
        ["--demand", "1 m/s"],
        ["--beta", "0.3"],
        ["--realizations", "5"],
        ["--site-coordinates", "1,2"],
    ] {
        let output = execute(folder, &call(&motions, &flags));
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.code() == Some(2) && said.contains("--format"),
            "{said}"
        );
    }
    let read = execute(
        folder,
        &["fragility", "--inventory", "list.csv", "--unit", "g"],
    );
    assert!(
        read.status.code() == Some(2)
            && String::from_utf8(read.stderr)
                .unwrap()
                .contains("--unit is for records of --motion")
    );
}

/// What is refused about measures names the cause, the file and a remedy that works.
#[test]
fn measures_that_are_not_known_have_a_remedy_that_works() {
    let folder = tempfile::tempdir().unwrap();
    let motion = &motions(folder.path())[0];
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write(
        "study.toml",
        &format!(
            "[building]\nlevels = [{{ name = \"ground\", level_ratio = 0, motions = [\"{motion}\"] }}]\n"
        ),
    );
    write(
        "list.csv",
        "id,floor,height [mm],depth [mm]\nA,ground,1800,500\n",
    );
    write("pga.csv", "pga [g],annual_rate\n0.1,0.05\n1,0.001\n");
    write("pfa.csv", "pfa [g],annual_rate\n0.1,0.05\n1,0.001\n");
    write("sa.csv", "sa(0.5) [g],annual_rate\n0.1,0.05\n1,0.001\n");
    let base = [
        "fragility",
        "study.toml",
        "--inventory",
        "list.csv",
        "--bootstrap",
        "0",
        "--im",
    ];
    let output = |more: &[&str]| execute(folder.path(), &[&base[..], more].concat());
    for more in [&["pga"][..], &["pga", "--at", "ground"]] {
        let told = String::from_utf8(output(more).stderr).unwrap();
        assert!(
            told.contains("the study gives the motions of the floors"),
            "{told}"
        );
        assert!(
            told.contains("write pfa or pfv") && !told.contains("give --at ground"),
            "{told}"
        );
    }
    assert_eq!(output(&["pfa"]).status.code(), Some(0));
    let stripes = ["pfa", "--method", "stripes", "--hazard"];
    let told = String::from_utf8(output(&[&stripes[..], &["pga.csv"]].concat()).stderr).unwrap();
    assert!(
        told.contains("pga.csv: ") && told.contains("is for pga of the ground"),
        "{told}"
    );
    assert!(
        told.contains("are for pfa of the floor") && !told.contains("--at"),
        "{told}"
    );
    assert_eq!(
        output(&[&stripes[..], &["pfa.csv"]].concat()).status.code(),
        Some(0)
    );
    // A spectral acceleration is taken where that of the runs is.
    let of_floor = ["sa(0.5)", "--method", "stripes", "--hazard", "sa.csv"];
    assert_eq!(output(&of_floor).status.code(), Some(0));
}
