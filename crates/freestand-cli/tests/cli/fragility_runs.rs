//! `freestand fragility` from motions and from an inventory, as it is called.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::program::{command, document, execute, refused};

pub(super) const CABINET: [&str; 8] = [
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
pub(super) fn motions(folder: &Path) -> Vec<String> {
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
pub(super) fn call<'a>(motions: &'a [String], flags: &[&'a str]) -> Vec<&'a str> {
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
pub(super) fn on_floor<'a>(motions: &'a [String], flags: &[&'a str]) -> Vec<&'a str> {
    let mut all = call(motions, flags);
    all.drain(5..9);
    all
}

pub(super) fn object<'v>(document: &'v Value, im: &str) -> &'v Value {
    document["objects"]
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["im"] == im)
        .unwrap()
}

pub(super) fn curve<'v>(object: &'v Value, state: &str) -> &'v Value {
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
pub(super) fn overturning(folder: &Path, runs: &str, law: &[&str]) -> ([f64; 2], f64, String) {
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
