//! `freestand fragility` and `freestand risk` as they are called.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{self, execute, refused, root};

fn json(folder: &Path, args: &[&str]) -> Value {
    let output = execute(folder, &[args, &["--json"]].concat());
    assert!(
        output.status.code().unwrap() < 2,
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    program::json(&output)
}

fn example(name: &str) -> String {
    root()
        .join("examples/risk")
        .join(name)
        .to_string_lossy()
        .into_owned()
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

/// The example as counts.
fn counts(text: &str) -> String {
    let mut levels: Vec<(String, String, [usize; 4])> = Vec::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let class = ["no-uplift", "rocked", "exceeded", "overturned"]
            .iter()
            .position(|name| *name == cells[3])
            .unwrap();
        let known = levels
            .iter_mut()
            .find(|level| level.0 == cells[0] && level.1 == cells[2]);
        match known {
            Some(level) => level.2[class] += 1,
            None => {
                levels.push((cells[0].to_owned(), cells[2].to_owned(), [0; 4]));
                levels.last_mut().unwrap().2[class] += 1;
            }
        }
    }
    let mut out = "object,pgv [m/s],no_uplift,rocked,exceeded,overturned\n".to_owned();
    for (id, level, counts) in levels {
        out += &format!(
            "{id},{level},{},{},{},{}\n",
            counts[0], counts[1], counts[2], counts[3]
        );
    }
    out
}

#[test]
fn rows_and_counts_are_one_fit() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(example("outcomes.csv")).unwrap();
    write(folder.path(), "counts.csv", &counts(&text));
    let rows = json(
        folder.path(),
        &[
            "fragility",
            "--outcomes",
            &example("outcomes.csv"),
            "--bootstrap",
            "20",
        ],
    );
    let counts = json(
        folder.path(),
        &["fragility", "--outcomes", "counts.csv", "--bootstrap", "20"],
    );
    assert_eq!(rows["schema"], "freestand.fragility/1");
    for i in 0..2 {
        let (a, b) = (&rows["objects"][i], &counts["objects"][i]);
        assert_eq!(
            (&a["id"], &a["counts"], &a["log_likelihood"]),
            (&b["id"], &b["counts"], &b["log_likelihood"])
        );
        assert_eq!(
            (&a["motions"], &b["motions"]),
            (&Value::from(40), &Value::Null)
        );
        for state in 0..3 {
            let (a, b) = (&a["curves"][state], &b["curves"][state]);
            assert_eq!((&a["median"], &a["beta"]), (&b["median"], &b["beta"]));
            assert!(a["median_ci95"].is_array() && b["median_ci95"].is_null());
        }
    }
}

#[test]
fn threads_do_not_change_a_byte() {
    let folder = tempfile::tempdir().unwrap();
    let of = |threads: &str, out: &str| {
        let outcomes = example("outcomes.csv");
        let args = [
            "fragility",
            "--outcomes",
            &outcomes,
            "--bootstrap",
            "50",
            "--threads",
            threads,
            "--out",
            out,
        ];
        assert_eq!(execute(folder.path(), &args).status.code(), Some(0));
        let names = [
            "fragility.json",
            "fragility.csv",
            "empirical.csv",
            "fragility.svg",
        ];
        names.map(|name| fs::read(folder.path().join(out).join(name)).unwrap())
    };
    assert_eq!(of("1", "one"), of("3", "three"));
}

/// The written curves give the rates of the fit, and Cornell's closed form.
#[test]
fn rates_are_those_of_the_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let law = [
        "--hazard-im",
        "pgv",
        "--hazard-power",
        "k0=1e-4 /yr, k=2.5, reference=100 cm/s",
    ];
    let curves = "id,im,im_unit,at,limit_state,kind,median,beta\na,pgv,m/s,ground,overturns,lognormal,0.5,0.25\n";
    write(folder.path(), "curves.csv", curves);
    let risk = json(
        folder.path(),
        &[&["risk", "--fragility", "curves.csv"], &law[..]].concat(),
    );
    let state = &risk["objects"][0]["limit_states"][0];
    let rate = state["annual_rate"].as_f64().unwrap();
    let cornell = 1e-4 * 0.5_f64.powf(-2.5) * (0.5 * 0.625_f64.powi(2)).exp();
    // Rounding alone differs.
    assert!((rate / cornell - 1.0).abs() < 1e-12, "{rate} {cornell}");
    let chance = state["probability"].as_f64().unwrap();
    assert!((chance - (1.0 - (-50.0 * cornell).exp())).abs() < 1e-12);
    let bins = risk["objects"][0]["deaggregation"].as_array().unwrap();
    let sum: f64 = bins
        .iter()
        .map(|bin| bin["annual_rate"].as_f64().unwrap())
        .sum();
    assert!(bins.len() >= 20 && (sum / rate - 1.0).abs() < 1e-12);
    assert_eq!(
        (&bins[0]["im_low"], &bins[bins.len() - 1]["im_high"]),
        (&Value::from(0.0), &Value::Null)
    );

    let fit = [
        "risk",
        "--outcomes",
        &example("outcomes.csv"),
        "--bootstrap",
        "20",
    ];
    let fitted = json(folder.path(), &[&fit[..], &law[..]].concat());
    let outcomes = example("outcomes.csv");
    assert!(
        execute(
            folder.path(),
            &[
                "fragility",
                "--outcomes",
                &outcomes,
                "--bootstrap",
                "0",
                "--out",
                "o"
            ]
        )
        .status
        .success()
    );
    let read = json(
        folder.path(),
        &[&["risk", "--fragility", "o/fragility.csv"], &law[..]].concat(),
    );
    for (a, b) in fitted["objects"]
        .as_array()
        .unwrap()
        .iter()
        .zip(read["objects"].as_array().unwrap())
    {
        for state in 0..3 {
            let (a, b) = (&a["limit_states"][state], &b["limit_states"][state]);
            assert_eq!(a["annual_rate"], b["annual_rate"]);
            // Nothing bounds what is below the lowest intensity of the rack.
            let Some(ends) = a["annual_rate_ci95"].as_array() else {
                assert!(a["annual_rate_upper"].is_null(), "{a}");
                continue;
            };
            let rate = a["annual_rate"].as_f64().unwrap();
            assert!(
                ends[0].as_f64().unwrap() < rate
                    && rate < ends[1].as_f64().unwrap()
                    && b["annual_rate_ci95"].is_null()
            );
        }
    }
}

/// An inventory, options and a budget: what is not given is null or listed.
#[test]
fn money_is_the_users() {
    let folder = tempfile::tempdir().unwrap();
    let (outcomes, hazard) = (example("outcomes.csv"), example("hazard.csv"));
    let (costs, options) = (example("costs.csv"), example("options.csv"));
    let base = [
        "risk",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "20",
        "--hazard",
        &hazard,
    ];
    let without = json(folder.path(), &base);
    assert!(
        [
            "portfolio",
            "ranking",
            "plan",
            "currency",
            "expected_annual_loss"
        ]
        .iter()
        .all(|key| without[key].is_null())
    );
    let money = [
        &base[..],
        &[
            "--inventory",
            &costs,
            "--options",
            &options,
            "--budget",
            "3000 AUD",
        ],
    ]
    .concat();
    let whole = [&money[..], &["--horizon", "40 yr", "--discount", "3 %"]].concat();
    let output = execute(folder.path(), &[&whole[..], &["--json"]].concat());
    assert_eq!(
        output.status.code(),
        Some(1),
        "the cabinet overturns more often than accepted"
    );
    let risk: Value = serde_json::from_slice(&output.stdout).unwrap();
    let cabinet = &risk["objects"][0];
    let rate = |i: usize| cabinet["limit_states"][i]["annual_rate"].as_f64().unwrap();
    let loss = 4.0 * ((rate(1) - rate(2)) * 1500.0 + rate(2) * (9000.0 + 2.0 * 400.0));
    assert!((cabinet["expected_annual_loss"].as_f64().unwrap() / loss - 1.0).abs() < 1e-12);
    assert_eq!(cabinet["not_counted"], serde_json::json!(["casualties"]));
    let plan = &risk["plan"];
    assert_eq!(
        (&plan["optimal"], plan["frontier"].as_array().unwrap().len()),
        (&Value::from(true), 20)
    );
    assert!(
        plan["cost"].as_f64().unwrap() <= 3000.0
            && plan["net_present_value"].as_f64().unwrap() > 0.0
    );
    let portfolio = &risk["portfolio"];
    assert_eq!(
        (&portfolio["worlds"], &portfolio["currency"]),
        (&Value::from(560), &Value::from("AUD"))
    );
    let curve = portfolio["loss_exceedance"].as_array().unwrap();
    let point = |i: usize, key: &str| curve[i][key].as_f64().unwrap();
    assert!((1..curve.len()).all(|i| point(i, "loss") > point(i - 1, "loss")));
    assert!((1..curve.len()).all(|i| point(i, "annual_rate") < point(i - 1, "annual_rate")));

    assert!(refused(folder.path(), &money).contains("--horizon is not given"));
    let hundred = [&whole[..], &[]]
        .concat()
        .iter()
        .map(|arg| if *arg == "3000 AUD" { "100 USD" } else { *arg })
        .collect::<Vec<_>>();
    assert!(
        refused(folder.path(), &hundred).contains("the budget is in USD, and the costs are in AUD")
    );
}

/// Two equal objects lose twice as much at every rate.
#[test]
fn equal_objects_fail_together() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(example("outcomes.csv")).unwrap();
    let rows = |id: &str| -> String {
        let cabinet = text.lines().filter(|line| line.starts_with("cabinet,"));
        cabinet
            .map(|line| format!("{}\n", line.replacen("cabinet", id, 1)))
            .collect()
    };
    let head = text.lines().next().unwrap();
    write(folder.path(), "one.csv", &format!("{head}\n{}", rows("a")));
    write(
        folder.path(),
        "two.csv",
        &format!("{head}\n{}{}", rows("a"), rows("b")),
    );
    write(
        folder.path(),
        "costs.csv",
        "id,repair_cost [EUR],replacement_cost [EUR]\na,10,100\nb,10,100\n",
    );
    let hazard = example("hazard.csv");
    let portfolio = |name: &str| {
        let args = [
            "risk",
            "--outcomes",
            name,
            "--bootstrap",
            "0",
            "--hazard",
            &hazard,
            "--inventory",
            "costs.csv",
        ];
        json(folder.path(), &args)["portfolio"]["loss_exceedance"]
            .as_array()
            .unwrap()
            .clone()
    };
    let (one, two) = (portfolio("one.csv"), portfolio("two.csv"));
    assert!(one.len() == 2 && two.len() == 2);
    for (a, b) in one.iter().zip(&two) {
        assert_eq!(a["annual_rate"], b["annual_rate"]);
        assert_eq!(
            2.0 * a["loss"].as_f64().unwrap(),
            b["loss"].as_f64().unwrap()
        );
    }
    let missing: Vec<&str> = text.lines().take(1100).collect();
    write(folder.path(), "missing.csv", &missing.join("\n"));
    write(
        folder.path(),
        "costs.csv",
        "id,replacement_cost [EUR]\ncabinet,100\nserver-rack,100\n",
    );
    let args = [
        "risk",
        "--outcomes",
        "missing.csv",
        "--bootstrap",
        "0",
        "--hazard",
        &hazard,
        "--inventory",
        "costs.csv",
    ];
    assert!(
        refused(folder.path(), &args)
            .contains("missing.csv: object server-rack has no outcome under motion m39 at")
    );
}

#[test]
fn exports_are_refused_where_they_would_mislead() {
    let folder = tempfile::tempdir().unwrap();
    let outcomes = example("outcomes.csv");
    let base = [
        "fragility",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "0",
        "--out",
        "o",
    ];
    let with = |args: &[&'static str]| -> Vec<&str> { [&base[..], args].concat() };
    assert!(
        refused(
            folder.path(),
            &with(&["--fit", "separate", "--format", "pelicun"])
        )
        .contains("separate fits may cross")
    );
    assert!(refused(folder.path(), &with(&["--format", "openquake"])).contains("needs --demand"));
    assert!(
        refused(
            folder.path(),
            &with(&["--format", "pelicun", "--demand", "0.4 g"])
        )
        .contains("--demand"),
        "another unit"
    );
    let floor = "object,motion,pfv [m/s],outcome\na,m,0.1,rocked\na,m,0.2,overturned\na,m,0.3,rocked\na,m,0.4,overturned\n";
    write(folder.path(), "floor.csv", floor);
    let args = [
        "fragility",
        "--outcomes",
        "floor.csv",
        "--format",
        "openquake",
        "--out",
        "o",
        "--demand",
        "0.4 m/s",
    ];
    let of_floor = refused(
        folder.path(),
        &[&args[..], &["--site-coordinates", "1,2"]].concat(),
    );
    assert!(
        of_floor.contains("OpenQuake has no measure pfv of the floor"),
        "{of_floor}"
    );
    assert!(
        !folder.path().join("o").exists(),
        "nothing is written where anything is refused"
    );
    let step = "object,motion,pgv [m/s],outcome\na-1,m,0.1,no-uplift\na-1,m,0.4,overturned\n";
    write(folder.path(), "step.csv", step);
    let args = [
        "fragility",
        "--outcomes",
        "step.csv",
        "--format",
        "pelicun",
        "--out",
        "o",
        "--demand",
        "0.4 m/s",
    ];
    assert!(refused(folder.path(), &args).contains("overturns is a step"));
    assert!(
        execute(
            folder.path(),
            &[&args[..], &["--beta", "0.3", "--realizations", "5"]].concat()
        )
        .status
        .success()
    );
    let written = fs::read_to_string(folder.path().join("o/pelicun/fragility.csv")).unwrap();
    assert_eq!(
        written.lines().nth(1).unwrap(),
        "FS.a_1,0,Peak Ground Velocity,mps,0,1,lognormal,0.2,0.3,,,,,"
    );
}

#[test]
fn flags_that_do_not_go_together_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (curves, hazard) = (example("curves.csv"), example("hazard.csv"));
    let base = ["risk", "--fragility", &curves];
    let with = |args: &[&'static str]| -> Vec<&str> { [&base[..], args].concat() };
    assert!(refused(folder.path(), &base).contains("there is no hazard curve"));
    let law = "k0=1e-4 /yr, k=2.5, reference=1 m/s";
    let of_floor = refused(
        folder.path(),
        &with(&["--hazard-im", "pfv", "--hazard-power", law]),
    );
    assert!(
        of_floor.contains("curves.csv:2: the hazard is that of pfv of the floor"),
        "{of_floor}"
    );
    let two = "id,im,im_unit,at,limit_state,kind,median,beta\na,pgv,m/s,ground,overturns,step,1,\n\
               b,pga,g,ground,overturns,step,1,\n";
    write(folder.path(), "two.csv", two);
    let unnamed = refused(
        folder.path(),
        &["risk", "--fragility", "two.csv", "--hazard-power", law],
    );
    assert!(unnamed.contains("several intensity measures"), "{unnamed}");
    assert!(
        refused(
            folder.path(),
            &with(&["--hazard-im", "pgx", "--hazard-power", law])
        )
        .contains("\"pgx\" is not")
    );
    let both = [&base[..], &["--hazard", &hazard, "--hazard-power", law]].concat();
    assert!(
        refused(folder.path(), &both).contains("--hazard and --hazard-power exclude each other")
    );
    let code = [
        "--hazard-code",
        "as1170.4",
        "--hazard-im",
        "pga",
        "--site",
        "De",
        "--hazard-factor",
        "0.1",
    ];
    assert!(
        refused(folder.path(), &with(&code)).contains("the hazard is that of pga of the ground")
    );
    let budget = [&base[..], &["--hazard", &hazard, "--budget", "100 AUD"]].concat();
    assert!(refused(folder.path(), &budget).contains("a budget needs options"));
}

/// Shocks of 10 g per m/s, spread evenly in the logarithm, below a ceiling of 22 g.
#[test]
fn shocks_give_the_probability_of_exceeding_a_tolerance() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = "object,motion,pgv [m/s],outcome,edge_acceleration [g]\n".to_owned();
    for motion in 0..40 {
        let factor = (f64::from(motion % 20 - 10) / 25.0).exp();
        for level in [0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2] {
            let shock = 10.0 * level * factor;
            let row = match shock {
                shock if shock > 22.0 => "overturned,".to_owned(),
                shock if shock < 0.6 => "no-uplift,".to_owned(),
                shock => format!("rocked,{shock}"),
            };
            text += &format!("a,m{motion},{level},{row}\n");
        }
    }
    write(folder.path(), "o.csv", &text);
    let base = ["fragility", "--outcomes", "o.csv", "--bootstrap", "0"];
    let of = |tolerance: &'static str| {
        let document = json(
            folder.path(),
            &[&base[..], &["--tolerance", tolerance, "--ceiling", "22 g"]].concat(),
        );
        document["objects"][0].clone()
    };
    let object = of("5 g");
    assert_eq!(
        object["curves"].as_array().unwrap().len(),
        2,
        "rocks and overturns"
    );
    let shock = &object["exceeds_by_shock"];
    // ln 10 = 2.3 and a power of 1, but for what is cut off at both ends.
    assert!(
        (shock["intercept"].as_f64().unwrap() - 10.0_f64.ln()).abs() < 0.1,
        "{shock}"
    );
    assert!(
        (shock["slope"].as_f64().unwrap() - 1.0).abs() < 0.1 && shock["why"].is_null(),
        "{shock}"
    );
    let median = shock["median"].as_f64().unwrap();
    assert!(
        (median / 0.5 - 1.0).abs() < 0.1,
        "5 g is half of the ceiling's intensity: {median}"
    );
    let above = of("22 g");
    assert_eq!(above["exceeds_by_shock"]["why"], "ceiling");
    let median = |value: &Value| value["median"].as_f64().unwrap();
    assert!((median(&above["exceeds_by_shock"]) / median(&above["curves"][1]) - 1.0).abs() < 1e-9);
    let low = [&base[..], &["--tolerance", "5 g", "--ceiling", "3 g"]].concat();
    assert!(refused(folder.path(), &low).contains("at most the ceiling, 3 g"));
    let export = [
        &base[..],
        &[
            "--tolerance",
            "5 g",
            "--ceiling",
            "22 g",
            "--format",
            "pelicun",
            "--out",
            "o",
        ],
    ]
    .concat();
    assert!(refused(folder.path(), &export).contains("a fit of shocks has no lognormal curve"));
}

/// A folder for pelicun has quantities and floors as blocks and locations, costs where there are any, and ids without
/// hyphens.
#[test]
fn a_folder_for_pelicun_has_what_the_inventory_says() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "floors.csv",
        "object,motion,pfv [m/s],outcome\na-1,m,0.1,rocked\na-1,n,0.2,exceeded\na-1,m,0.25,rocked\na-1,n,0.3,overturned\n\
         a-1,m,0.35,exceeded\na-1,n,0.4,overturned\nb,m,0.1,rocked\nb,m,0.2,overturned\nb,m,0.3,rocked\nb,m,0.4,overturned\n",
    );
    write(
        folder.path(),
        "costs.csv",
        "id,quantity,floor,repair_cost [AUD],replacement_cost [AUD],downtime [day]\na-1,3,2,100,900,4\nb,,,,50,\n",
    );
    let base = [
        "fragility",
        "--outcomes",
        "floors.csv",
        "--bootstrap",
        "0",
        "--out",
        "o",
        "--format",
        "pelicun",
    ];
    let with = |args: &[&'static str]| execute(folder.path(), &[&base[..], args].concat());
    let output = with(&[
        "--inventory",
        "costs.csv",
        "--demand",
        "0.3 m/s",
        "--realizations",
        "3",
    ]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && told.contains("pelicun writes every cost as USD"),
        "{told}"
    );
    let read = |name: &str| fs::read_to_string(folder.path().join("o/pelicun").join(name)).unwrap();
    assert_eq!(
        read("CMP_QNT.csv"),
        "ID,Units,Location,Direction,Theta_0,Blocks,Comment\nFS.a_1,ea,3,1,3,3,a-1\nFS.b,ea,1,1,1,1,b\n"
    );
    // A component takes the demand of the floor below its location.
    assert_eq!(
        read("demand.csv"),
        ",1-PFV-0-1,1-PFV-2-1\nUnits,mps,mps\n0,0.3,0.3\n1,0.3,0.3\n2,0.3,0.3\n"
    );
    assert_eq!(
        read("consequence_repair.csv"),
        "ID,Incomplete,Quantity-Unit,DV-Unit,DS1-Family,DS1-Theta_0,DS1-Theta_1,DS2-Family,DS2-Theta_0,DS2-Theta_1\n\
         FS.a_1-Cost,0,1 EA,USD,,100,,,900,\nFS.a_1-Time,0,1 EA,worker_day,,0,,,4,\nFS.b-Cost,0,1 EA,USD,,50,,,,\n"
    );
    let config: Value = serde_json::from_str(&read("config.json")).unwrap();
    assert_eq!(config["DL"]["Asset"]["NumberOfStories"], 3);
    assert_eq!(
        config["DL"]["Losses"]["Repair"]["ConsequenceDatabasePath"],
        "consequence_repair.csv"
    );
    assert!(
        read("fragility.csv")
            .lines()
            .skip(1)
            .all(|line| line.contains(",Peak Floor Velocity,mps,0,1,lognormal,"))
    );

    assert!(
        with(&["--demand", "0.3 m/s", "--realizations", "3"])
            .status
            .success()
    );
    let config: Value = serde_json::from_str(&read("config.json")).unwrap();
    assert!(
        config["DL"]["Losses"].is_null() && config["DL"]["Outputs"]["Loss"].is_null(),
        "no costs, no losses"
    );

    write(folder.path(), "costs.csv", "id,quantity\na-1,2.5\n");
    let halves = [&base[..], &["--inventory", "costs.csv"]].concat();
    assert!(refused(folder.path(), &halves).contains("not 2.5"));
}

/// A folder for OpenQuake has numbers, values and coordinates of the inventory, PGV in cm/s, and a hazard with at least
/// 300 levels.
#[test]
fn a_folder_for_openquake_has_what_the_inventory_says() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "costs.csv",
        "id,quantity,replacement_cost [AUD],longitude,latitude\ncabinet,4,9000,151.2,-33.9\nserver-rack,2,60000,,\n",
    );
    let (outcomes, hazard) = (example("outcomes.csv"), example("hazard.csv"));
    let base = [
        "fragility",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "0",
        "--out",
        "o",
        "--format",
        "openquake",
    ];
    let with = |args: &[&str]| -> Vec<String> {
        [&base[..], args]
            .concat()
            .iter()
            .map(|arg| (*arg).to_owned())
            .collect()
    };
    let call = |args: Vec<String>| {
        execute(
            folder.path(),
            &args.iter().map(String::as_str).collect::<Vec<_>>(),
        )
    };
    let given = [
        "--inventory",
        "costs.csv",
        "--demand",
        "0.4 m/s",
        "--hazard",
        &hazard,
    ];
    let without_site = call(with(&given));
    let told = String::from_utf8(without_site.stderr).unwrap();
    assert!(
        without_site.status.code() == Some(2) && told.contains("object server-rack has none"),
        "{told}"
    );
    assert!(
        call(with(
            &[&given[..], &["--site-coordinates", "150.5,-33.5"]].concat()
        ))
        .status
        .success()
    );
    let read =
        |name: &str| fs::read_to_string(folder.path().join("o/openquake").join(name)).unwrap();
    assert_eq!(
        read("exposure.csv"),
        "id,lon,lat,taxonomy,number,contents\ncabinet,151.2,-33.9,cabinet,4,36000\n\
         server-rack,150.5,-33.5,server-rack,2,120000\n"
    );
    assert!(read("exposure.xml").contains("unit=\"AUD\""));
    assert_eq!(
        read("gmf.csv"),
        "rlzi,sid,eid,gmv_PGV\n0,0,0,40\n0,1,0,40\n"
    );
    assert!(read("job_scenario_damage.ini").contains("sites = 151.2 -33.9, 150.5 -33.5\n"));
    let job = read("job_classical_damage.ini");
    assert!(
        job.contains("calculation_mode = classical_damage")
            && job.contains("risk_investigation_time = 50"),
        "{job}"
    );
    let written = read("hazard.csv");
    let header = written.lines().nth(1).unwrap();
    assert!(
        header.split(',').count() > 303 && written.lines().count() == 4,
        "{header}"
    );
    // freestand reads what it writes: the rates are those of the first file.
    let copy = folder.path().join("o/openquake/hazard.csv");
    let rates = |hazard: &str| {
        let args = [
            "risk",
            "--fragility",
            "o/fragility.csv",
            "--hazard",
            hazard,
            "--site-coordinates",
            "151.2,-33.9",
        ];
        json(folder.path(), &args)["objects"][0]["limit_states"][2]["annual_rate"]
            .as_f64()
            .unwrap()
    };
    let (own, other) = (rates(&hazard), rates(&copy.to_string_lossy()));
    // The tail beyond the last point is at 1.000001 times it.
    assert!((own / other - 1.0).abs() < 1e-5, "{own} {other}");
    write(
        folder.path(),
        "pga.csv",
        "pga [g],annual_rate\n0.1,0.1\n1,0.001\n",
    );
    let wrong = call(with(&["--site-coordinates", "1,2", "--hazard", "pga.csv"]));
    let told = String::from_utf8(wrong.stderr).unwrap();
    assert!(
        wrong.status.code() == Some(2)
            && told.contains("pga of the ground, and the outcomes are for pgv"),
        "{told}"
    );
}

/// Points in place of curves: the shares of runs, also where no lognormal curve can be exported.
#[test]
fn shares_are_exported_as_points() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "o.csv",
        "object,motion,pga [g],outcome\na,m,0.1,rocked\na,n,0.1,rocked\na,m,0.2,rocked\na,n,0.2,overturned\n\
         a,m,0.4,overturned\na,n,0.4,overturned\n",
    );
    let args = [
        "fragility",
        "--outcomes",
        "o.csv",
        "--bootstrap",
        "0",
        "--discrete",
        "--out",
        "out",
        "--demand",
        "0.3 g",
    ];
    let formats = [
        "--format",
        "pelicun",
        "--format",
        "openquake",
        "--site-coordinates",
        "1,2",
        "--realizations",
        "2",
    ];
    assert!(
        execute(folder.path(), &[&args[..], &formats].concat())
            .status
            .success()
    );
    let pelicun = fs::read_to_string(folder.path().join("out/pelicun/fragility.csv")).unwrap();
    assert!(
        pelicun.ends_with("\nFS.a,0,Peak Ground Acceleration,g,0,1,multilinear_CDF,\"0.1,0.2,0.4|0,0.5,1\",,,,,,\n"),
        "{pelicun}"
    );
    let openquake = fs::read_to_string(folder.path().join("out/openquake/fragility.xml")).unwrap();
    assert!(
        openquake.contains("<imls imt=\"PGA\">1e-7 0.1 0.2 0.4</imls>"),
        "{openquake}"
    );
    assert!(
        openquake.contains("<poes ls=\"overturns\">0 0 0.5 1</poes>"),
        "{openquake}"
    );
}

#[test]
fn numbers_that_no_one_means_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (curves, hazard) = (example("curves.csv"), example("hazard.csv"));
    let base = ["risk", "--fragility", &curves];
    for (law, said) in [
        (
            "k0=1e300 /yr, k=250, reference=1 m/s",
            "with k0 = 1e300 /yr and k = 250",
        ),
        (
            "k0=1e300 /yr, k=2.5, reference=1 m/s",
            "with k0 = 1e300 /yr and k = 2.5",
        ),
    ] {
        let law = ["--hazard-im", "pgv", "--hazard-power", law];
        assert!(refused(folder.path(), &[&base[..], &law].concat()).contains(said));
    }
    write(
        folder.path(),
        "high.csv",
        "pgv [m/s],annual_rate\n0.01,1e300\n1,1e299\n",
    );
    let high = refused(
        folder.path(),
        &[&base[..], &["--hazard", "high.csv"]].concat(),
    );
    assert!(
        high.contains("high.csv: the annual rate of cabinet is above"),
        "{high}"
    );
    write(
        folder.path(),
        "costs.csv",
        "id,quantity,replacement_cost [AUD]\ncabinet,1e200,1e200\n",
    );
    let rich = [
        &base[..],
        &["--hazard", &hazard, "--inventory", "costs.csv"],
    ]
    .concat();
    assert!(
        refused(folder.path(), &rich)
            .contains("costs.csv:2: the loss a year of cabinet is too large")
    );
    write(
        folder.path(),
        "costs.csv",
        "id,replacement_cost [AUD]\ncabinet,9000\n",
    );
    write(
        folder.path(),
        "options.csv",
        "id,option,cost [AUD],stiffness [N/mm]\ncabinet,soft pads,50,400\n",
    );
    let pads = [
        &base[..],
        &[
            "--hazard",
            &hazard,
            "--inventory",
            "costs.csv",
            "--options",
            "options.csv",
        ],
    ]
    .concat();
    let told = refused(
        folder.path(),
        &[&pads[..], &["--horizon", "40 yr", "--discount", "3 %"]].concat(),
    );
    assert!(
        told.contains("options.csv:2: the option changes the object itself"),
        "{told}"
    );
}

/// The page for the owner states the loss, the chance, the plan, what it leaves and what is not counted, loads nothing,
/// and has both figures.
#[test]
fn the_owner_gets_one_page() {
    let folder = tempfile::tempdir().unwrap();
    let (outcomes, hazard) = (example("outcomes.csv"), example("hazard.csv"));
    let (costs, options) = (example("costs.csv"), example("options.csv"));
    let base = [
        "risk",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "0",
        "--hazard",
        &hazard,
        "--inventory",
        &costs,
    ];
    let plan = [
        "--options",
        &options,
        "--budget",
        "3000 AUD",
        "--horizon",
        "40 yr",
        "--discount",
        "3 %",
        "--out",
        "o",
    ];
    assert_eq!(
        execute(folder.path(), &[&base[..], &plan].concat())
            .status
            .code(),
        Some(1)
    );
    let page = fs::read_to_string(folder.path().join("o/report.html")).unwrap();
    let said = [
        "<strong>392 AUD a year</strong>",
        "<strong>44 %</strong>",
        "<strong>2600 AUD</strong>",
        "Expected loss that remains with the plan.",
        "Only its bounds are known: 294 to 581 AUD.",
        "Casualties, for which no amount was given: cabinet, server-rack.",
        "Net present value (thousand AUD)",
        "Of 2 kinds of object with an accepted rate, 2 fail more often than that. The object cabinet overturns 1.6 times \
         as often as accepted: once in 626 years instead of once in 1000 years.",
        "<td>3 % more often, not certain</td>",
    ];
    for text in said {
        assert!(page.contains(text), "{text}");
    }
    assert!(
        !page.contains("src=")
            && !page.replace("url(#", "").contains("url(")
            && !page.contains("NaN"),
        "it loads nothing"
    );
    let files = [
        "risk.csv",
        "risk.json",
        "risk.svg",
        "risk.png",
        "manifest.json",
    ];
    assert!(
        files
            .iter()
            .all(|name| folder.path().join("o").join(name).exists())
    );
    // Without costs and options there is a page without figures.
    let curves = example("curves.csv");
    let plain = [
        "risk",
        "--fragility",
        &curves,
        "--hazard",
        &hazard,
        "--out",
        "p",
    ];
    assert!(execute(folder.path(), &plain).status.success());
    let page = fs::read_to_string(folder.path().join("p/report.html")).unwrap();
    assert!(
        page.contains("overturns the object cabinet within 50 years") && !page.contains("<svg"),
        "{page}"
    );
    assert!(!folder.path().join("p/risk.svg").exists());
}

/// Rates of fitted outcomes are stated with 95 % intervals, rates of given curves without.
#[test]
fn rates_are_told_with_their_intervals() {
    let folder = tempfile::tempdir().unwrap();
    let (outcomes, curves, hazard) = (
        example("outcomes.csv"),
        example("curves.csv"),
        example("hazard.csv"),
    );
    let text = |args: &[&str]| {
        let output = execute(
            folder.path(),
            &[&["risk"], args, &["--hazard", &hazard]].concat(),
        );
        String::from_utf8(output.stdout).unwrap()
    };
    let fitted = text(&["--outcomes", &outcomes, "--bootstrap", "50"]);
    let rates: Vec<&str> = fitted
        .lines()
        .filter(|line| line.contains(" a year"))
        .collect();
    assert!(
        rates.len() == 6 && rates.iter().all(|line| line.contains("; 95 % interval ")),
        "{fitted}"
    );
    assert!(
        !text(&["--fragility", &curves]).contains("95 %"),
        "curves have none"
    );
}

/// All bad rows of all tables are reported at once, with line and column, and nothing is written.
#[test]
fn all_bad_rows_are_told_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let (curves, hazard) = (example("curves.csv"), example("hazard.csv"));
    write(
        folder.path(),
        "h.csv",
        "pgv [m/s],annual_rate\n0.1,0.1\n0.2\n0.3,x\n0.4,0.5\n",
    );
    write(
        folder.path(),
        "c.csv",
        "id,repair_cost [AUD],floor\ncabinet,-1,1\nserver-rack,1,roof\n",
    );
    write(
        folder.path(),
        "good.csv",
        "id,replacement_cost [AUD]\ncabinet,9000\nserver-rack,9000\n",
    );
    let options = "id,option,cost [AUD],median_factor\nshelf,strap,100,3\ncabinet,strap,100,3\nrack,strap,100,3\n";
    write(folder.path(), "o.csv", options);
    write(
        folder.path(),
        "bad.csv",
        "id,option,cost [AUD],median_factor\ncabinet,strap,,3\ncabinet,strap,100,\n",
    );
    let told = |args: &[&str]| -> Vec<String> {
        let output = execute(folder.path(), &[&["risk", "--out", "o"], args].concat());
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            (output.status.code(), output.stdout.len()),
            (Some(2), 0),
            "{args:?}: {text}"
        );
        let errors = text.lines().filter_map(|line| line.strip_prefix("error: "));
        let errors: Vec<String> = errors.map(str::to_owned).collect();
        assert_eq!(
            text.lines()
                .filter(|line| line.starts_with("hint: "))
                .count(),
            errors.len(),
            "{text}"
        );
        errors
    };
    let starts = |errors: &[String], wanted: &[&str]| {
        assert_eq!(errors.len(), wanted.len(), "{errors:?}");
        assert!(
            errors
                .iter()
                .zip(wanted)
                .all(|(error, start)| error.starts_with(start)),
            "{errors:?}"
        );
    };
    starts(
        &told(&["--fragility", &curves, "--hazard", "h.csv"]),
        &["h.csv:3: ", "h.csv:4: ", "h.csv:5: "],
    );
    let base = [
        "--fragility",
        &curves,
        "--hazard",
        &hazard,
        "--horizon",
        "40 yr",
        "--discount",
        "3 %",
    ];
    let with = |args: &[&'static str]| told(&[&base[..], args].concat());
    let costs = told(&[
        "--fragility",
        &curves,
        "--hazard",
        &hazard,
        "--inventory",
        "c.csv",
    ]);
    starts(&costs, &["c.csv:2: column 2", "c.csv:3: column 3"]);
    let unknown = with(&["--inventory", "good.csv", "--options", "o.csv"]);
    starts(
        &unknown,
        &[
            "o.csv:2: the option \"strap\" is for shelf",
            "o.csv:4: the option \"strap\" is for rack",
        ],
    );
    let bad = with(&["--inventory", "good.csv", "--options", "bad.csv"]);
    starts(&bad, &["bad.csv:2: column 3", "bad.csv:3: column 2"]);
    assert!(!folder.path().join("o").exists(), "nothing is written");
}

/// Ids that OpenQuake or pelicun would refuse are changed; a table lists both ids, and a warning
/// names it.
#[test]
fn ids_are_mapped_for_other_programs() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(60);
    let rows: String = ["2 racks/Ä", &long, "plain"]
        .iter()
        .flat_map(|id| {
            [
                (0.1, "rocked"),
                (0.2, "overturned"),
                (0.3, "rocked"),
                (0.4, "overturned"),
            ]
            .map(|(x, outcome)| format!("{id},m{x},{x},{outcome}\n"))
        })
        .collect();
    write(
        folder.path(),
        "o.csv",
        &format!("object,motion,pgv [m/s],outcome\n{rows}"),
    );
    let formats = [
        "--format",
        "pelicun",
        "--format",
        "openquake",
        "--site-coordinates",
        "1,2",
        "--demand",
        "0.3 m/s",
    ];
    let base = [
        "fragility",
        "--outcomes",
        "o.csv",
        "--bootstrap",
        "0",
        "--out",
        "out",
    ];
    let output = execute(folder.path(), &[&base[..], &formats].concat());
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && told.contains("2 ids were changed for OpenQuake, such as"),
        "{told}"
    );
    assert!(told.contains("openquake/ids.csv lists both"), "{told}");
    let read = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let cut = "x".repeat(50);
    assert_eq!(
        read("openquake/ids.csv"),
        format!("id,exported_id\n2 racks/Ä,2_racks__\n{long},{cut}\nplain,plain\n")
    );
    assert!(read("pelicun/ids.csv").contains("2 racks/Ä,FS.2_racks__\n"));
    assert!(read("openquake/exposure.csv").contains(&format!("\n{cut},1,2,{cut},1,1\n")));
}

/// The verdict names the limit that is not kept, and what a person wrote by mistake is asked about.
#[test]
fn a_verdict_names_its_limit_and_wrong_words_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (curves_path, hazard) = (example("curves.csv"), example("hazard.csv"));
    let costs = "id,accepted_annual_rate [1/yr],accepted_exceed_annual_rate [1/yr]\ncabinet,1,1e-12\nserver-rack,1e-12,\n";
    write(folder.path(), "accepted.csv", costs);
    let base = ["risk", "--fragility", &curves_path, "--hazard", &hazard];
    let output = execute(
        folder.path(),
        &[&base[..], &["--inventory", "accepted.csv"]].concat(),
    );
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains(
            "more often than accepted, uncertainty not known (accepted for exceeding: 1e-12 a year)"
        ),
        "{text}"
    );
    assert!(
        text.contains("more often than accepted, uncertainty not known (accepted for overturning: 1e-12 a year)"),
        "{text}"
    );

    let whole = refused(
        folder.path(),
        &[
            &base[..],
            &["--discount", "3", "--horizon", "5 yr", "--options", "o.csv"],
        ]
        .concat(),
    );
    assert!(
        whole.contains("a discount rate of 3 is 300 % a year"),
        "{whole}"
    );
    let law = [
        "risk",
        "--fragility",
        &curves_path,
        "--hazard-im",
        "pgv",
        "--hazard-power",
    ];
    let twice = refused(
        folder.path(),
        &[
            &law[..],
            &["k0=1e-4 /yr, k=2.5, k0=1e-3/yr, reference=1 m/s"],
        ]
        .concat(),
    );
    assert!(twice.contains("k0 appears twice"), "{twice}");
    let close = execute(
        folder.path(),
        &[
            &law[..],
            &["k0=1e-4/yr, k=2.5, reference=1m/s", "--years", "50yr"],
        ]
        .concat(),
    );
    assert_eq!(
        close.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&close.stderr)
    );
}

/// A budget of nothing buys nothing.
#[test]
fn a_budget_of_nothing_has_an_empty_plan() {
    let folder = tempfile::tempdir().unwrap();
    let (curves, hazard) = (example("curves.csv"), example("hazard.csv"));
    write(
        folder.path(),
        "c.csv",
        "id,repair_cost [AUD],replacement_cost [AUD]\ncabinet,100,9000\n",
    );
    write(
        folder.path(),
        "o.csv",
        "id,option,cost [AUD],median_factor\ncabinet,strap,100,3\n",
    );
    let args = [
        "risk",
        "--fragility",
        &curves,
        "--hazard",
        &hazard,
        "--inventory",
        "c.csv",
        "--options",
        "o.csv",
    ];
    let money = [
        "--horizon",
        "40yr",
        "--discount",
        "3%",
        "--budget",
        "0 AUD",
        "--out",
        "o",
    ];
    let found = json(folder.path(), &[&args[..], &money[..]].concat());
    assert_eq!(
        (&found["plan"]["chosen"], &found["plan"]["cost"]),
        (&serde_json::json!([]), &Value::from(0.0))
    );
}

const HEAD: &str = "id,im,im_unit,at,limit_state,kind,median,beta,lower,upper\n";
const LAW: [&str; 4] = [
    "--hazard-im",
    "pgv",
    "--hazard-power",
    "k0=1e-4 /yr, k=2.5, reference=1 m/s",
];
const MONEY: [&str; 4] = ["--horizon", "40 yr", "--discount", "3 %"];
/// Present value of 1 a year over 40 years at 3 %, (1 − e^(−rH))/r.
fn present_value() -> f64 {
    (1.0 - (-0.03 * 40.0_f64).exp()) / 0.03
}

/// Curves that an option names belong to the hazard, are checked, and are an input of the result.
#[test]
fn curves_of_an_option_are_checked_as_those_of_objects() {
    let folder = tempfile::tempdir().unwrap();
    let row = |id: &str, im: &str, curve: &str| format!("{id},{im},{curve},,\n");
    write(
        folder.path(),
        "c.csv",
        &format!(
            "{HEAD}{}",
            row("a", "pgv,m/s,ground", "overturns,lognormal,0.3,0.4")
        ),
    );
    write(
        folder.path(),
        "costs.csv",
        "id,replacement_cost [AUD]\na,9000\n",
    );
    write(
        folder.path(),
        "o.csv",
        "id,option,cost [AUD],curves\na,strap,100,strap.csv\na,pad,100,strap.csv\n",
    );
    let args = [
        "risk",
        "--fragility",
        "c.csv",
        "--inventory",
        "costs.csv",
        "--options",
        "o.csv",
    ];
    let args = [&args[..], &LAW, &MONEY].concat();
    let pad = row("a/pad", "pgv,m/s,ground", "overturns,lognormal,0.6,0.4");
    for (im, at) in [
        ("pfa,g,floor", "pfa of the floor"),
        ("pga,g,ground", "pga of the ground"),
    ] {
        let strap = row("a/strap", im, "overturns,lognormal,0.6,0.4");
        write(folder.path(), "strap.csv", &format!("{HEAD}{pad}{strap}"));
        let told = refused(folder.path(), &args);
        let said = format!(
            "strap.csv:3: the hazard is that of pgv of the ground, and the fragility of a/strap is against {at}"
        );
        assert!(told.contains(&said), "{told}");
    }
    let crossing = ["exceeds,lognormal,0.5,0.1", "overturns,lognormal,0.6,1.5"];
    let strap = crossing
        .map(|curve| row("a/strap", "pgv,m/s,ground", curve))
        .concat();
    write(folder.path(), "strap.csv", &format!("{HEAD}{pad}{strap}"));
    let found = json(folder.path(), &args);
    let warned = |text: &str| {
        found["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .any(|one| one.as_str().unwrap().contains(text))
    };
    assert!(
        warned("a/strap: ") && warned("contradict each other"),
        "{}",
        found["warnings"]
    );
    let inputs: Vec<&str> = found["inputs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["path"].as_str().unwrap())
        .collect();
    assert_eq!(
        inputs,
        ["c.csv", "costs.csv", "o.csv", "strap.csv"],
        "each once"
    );
}

/// An option after which the object never overturned in the runs counts with the largest rate that it
/// may have; one whose rate has no bound has no known worth.
#[test]
fn an_option_with_an_unknown_rate_is_worth_at_least() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "a,pgv,m/s,ground,overturns,lognormal,0.2,0.4,,\n\
                a/strap,pgv,m/s,ground,overturns,none,,,0.3,\n\
                a/net,pgv,m/s,ground,overturns,not-increasing,,,0.1,0.5\n\
                b,pgv,m/s,ground,overturns,none,,,0.3,\n";
    write(folder.path(), "c.csv", &format!("{HEAD}{rows}"));
    write(
        folder.path(),
        "costs.csv",
        "id,replacement_cost [AUD]\na,9000\nb,9000\n",
    );
    let options = "id,option,cost [AUD],curves,median_factor\na,net,1,c.csv,\na,strap,100,c.csv,\nb,pad,50,,2\n";
    write(folder.path(), "o.csv", options);
    let args = [
        "risk",
        "--fragility",
        "c.csv",
        "--inventory",
        "costs.csv",
        "--options",
        "o.csv",
        "--budget",
        "500 AUD",
    ];
    let args = [&args[..], &LAW, &MONEY].concat();
    let found = json(folder.path(), &args);
    let ranking = found["ranking"].as_array().unwrap();
    let options: Vec<&str> = ranking
        .iter()
        .map(|one| one["option"].as_str().unwrap())
        .collect();
    assert_eq!(
        options,
        ["strap", "pad", "net"],
        "what has no known worth is last"
    );
    let before = 1e-4 * 0.2_f64.powf(-2.5) * (0.5 * (2.5 * 0.4_f64).powi(2)).exp();
    let worth = present_value() * 9000.0 * (before - 1e-4 * 0.3_f64.powf(-2.5));
    let stated = ranking[0]["benefit_present_value"].as_f64().unwrap();
    // Rounding alone differs.
    assert!((stated / worth - 1.0).abs() < 1e-10, "{stated} {worth}");
    assert_eq!(
        (&ranking[0]["is_at_least"], &found["plan"]["is_at_least"]),
        (&Value::from(true), &Value::from(true))
    );
    // Whatever the rate of b is, a factor of 2 does not raise it.
    assert_eq!(
        (
            &ranking[1]["benefit_present_value"],
            &ranking[1]["is_at_least"]
        ),
        (&Value::from(0.0), &Value::from(true))
    );
    let unknown = [
        "benefit_present_value",
        "benefit_cost_ratio",
        "net_present_value",
    ]
    .map(|key| &ranking[2][key]);
    assert_eq!(unknown, [&Value::Null; 3]);
    let chosen = found["plan"]["chosen"].as_array().unwrap();
    assert_eq!(
        (chosen.len(), &chosen[0]["option"]),
        (1, &Value::from("strap"))
    );
    let warnings = found["warnings"].to_string();
    assert!(
        warnings.contains("the worth of the option \\\"net\\\" for a is not known"),
        "{warnings}"
    );
    let output = execute(folder.path(), &[&args[..], &["--out", "o"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    for said in [
        "strap, cost 100 AUD, worth at least ",
        "net, cost 1 AUD, worth not known",
        "net present value at least ",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let page = fs::read_to_string(folder.path().join("o/report.html")).unwrap();
    for said in [
        "the plan saves at least ",
        "It avoids a loss of at least ",
        "Judged by the least that each saves",
        "What one option saves is not known",
    ] {
        assert!(page.contains(said), "{said}: {page}");
    }
    // The strap leaves at most λ(0.3), and nothing bounds less than λ(0.3) of b either.
    let left = 2.0 * 9000.0 * 1e-4 * 0.3_f64.powf(-2.5);
    assert!(
        (left - 36.5).abs() < 0.05 && page.contains("<strong>at most 36.5 AUD a year</strong>"),
        "{left}: {page}"
    );
}

/// The page ranks by what is known, and says what is not.
#[test]
fn the_page_says_whose_rates_are_not_known() {
    let folder = tempfile::tempdir().unwrap();
    let hazard = example("hazard.csv");
    let page = |rows: &str| {
        write(folder.path(), "c.csv", &format!("{HEAD}{rows}"));
        write(
            folder.path(),
            "costs.csv",
            "id,casualty_probability\na,0.1\nb,0.1\n",
        );
        let args = [
            "risk",
            "--fragility",
            "c.csv",
            "--hazard",
            &hazard,
            "--inventory",
            "costs.csv",
            "--force",
            "--out",
            "o",
        ];
        assert!(execute(folder.path(), &args).status.success());
        fs::read_to_string(folder.path().join("o/report.html")).unwrap()
    };
    let a = "a,pgv,m/s,ground,overturns,lognormal,0.5,0.3,,\n";
    let known = page(&format!(
        "{a}b,pgv,m/s,ground,overturns,lognormal,0.6,0.3,,\n"
    ));
    assert!(
        known.contains("No other object is more likely to overturn.")
            && !known.contains("at least"),
        "{known}"
    );
    let seldom = page(&format!("{a}b,pgv,m/s,ground,overturns,none,,,0.9,\n"));
    assert!(
        seldom.contains("No other object is more likely") && seldom.contains("at least"),
        "the casualties: {seldom}"
    );
    let always = page(&format!("{a}b,pgv,m/s,ground,overturns,all,,,,0.1\n"));
    let boxes = always.split("<h2").next().unwrap();
    assert!(
        boxes.contains("overturns the object b within 50 years")
            && boxes.matches("<strong>at least ").count() == 2
    );
    let between = page(&format!(
        "{a}b,pgv,m/s,ground,overturns,not-increasing,,,0.1,0.9\n"
    ));
    assert!(
        between.contains("The object b may be more likely to overturn"),
        "{between}"
    );
    let nothing = page("b,pgv,m/s,ground,overturns,not-increasing,,,0.1,0.9\n");
    assert!(nothing.contains("<strong>not known</strong>"), "{nothing}");
}

/// An accepted rate that nothing is compared with is told, with the reason.
#[test]
fn an_accepted_rate_without_a_curve_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let curves = "id,im,im_unit,at,limit_state,kind,median,beta\na,pgv,m/s,ground,overturns,lognormal,0.5,0.25\n";
    write(folder.path(), "c.csv", curves);
    let costs = "id,accepted_exceed_annual_rate [1/yr],accepted_annual_rate [1/yr]\na,1e-2,1e-2\n";
    write(folder.path(), "costs.csv", costs);
    let args = [
        &["risk", "--fragility", "c.csv", "--inventory", "costs.csv"],
        &LAW[..],
    ]
    .concat();
    let found = json(folder.path(), &args);
    let object = &found["objects"][0];
    assert_eq!(
        (&object["verdict"], &object["why"]),
        (&Value::Null, &Value::from("there is no curve of exceeding"))
    );
    let warned = found["warnings"].to_string();
    assert!(
        warned.contains("a: an accepted rate was not compared with anything: there is no curve"),
        "{warned}"
    );
    let text = String::from_utf8(execute(folder.path(), &args).stdout).unwrap();
    assert!(
        text.contains("  verdict     not known: there is no curve of exceeding"),
        "{text}"
    );
    // Overturning alone is more frequent than accepted.
    write(
        folder.path(),
        "costs.csv",
        &costs.replace("1e-2\n", "1e-9\n"),
    );
    assert_eq!(execute(folder.path(), &args).status.code(), Some(1));
}

/// A signal in the bootstrap ends the command, and nothing is written.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_stops_the_fits() {
    let folder = tempfile::tempdir().unwrap();
    let (outcomes, hazard) = (example("outcomes.csv"), example("hazard.csv"));
    let args = [
        "risk",
        "--outcomes",
        &outcomes,
        "--bootstrap",
        "100000",
        "--hazard",
        &hazard,
        "--quiet",
        "--out",
        "o",
    ];
    assert_eq!(
        crate::fragility_runs::stopped(folder.path(), &args),
        Some(130)
    );
    assert_eq!(crate::fragility_runs::names(folder.path()), [""; 0]);
}

/// The square prism around a round object stands where it falls: its curves and its rates say so.
#[test]
#[ignore = "ten seconds: runs of an inventory"]
fn round_objects_may_fail_more_often_than_their_curves() {
    let folder = tempfile::tempdir().unwrap();
    let list = "id,level_ratio,shape,casters,height [mm],thickness [mm],replacement cost NZD\ntank,0,cylinder,,1500,400,9\n\
                box,0,box,,1500,400,9\ntrolley,0,box,free,1500,400,9\n";
    write(folder.path(), "list.csv", list);
    let place = ["--place", "Wellington", "--worlds", "4", "--bootstrap", "0"];
    let runs = [
        &["fragility", "--inventory", "list.csv"],
        &place[..],
        &["--out", "runs"],
    ]
    .concat();
    let hazard = [
        "--hazard-im",
        "pgv",
        "--hazard-power",
        "k0=1e-4 /yr, k=2.5, reference=100 cm/s",
    ];
    let rates = [
        &[
            "risk",
            "--fragility",
            "runs/fragility.csv",
            "--inventory",
            "list.csv",
        ],
        &hazard[..],
    ]
    .concat();
    for call in [&runs, &rates] {
        let found = json(folder.path(), call);
        let said: Vec<&str> = found["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(Value::as_str)
            .collect();
        let round: Vec<&&str> = said
            .iter()
            .filter(|text| text.contains("square prism"))
            .collect();
        assert!(
            round.len() == 1 && round[0].ends_with("for example tank"),
            "{said:?}"
        );
        let rolls = said
            .iter()
            .any(|text| text.contains("roll or slide") && text.ends_with("for example trolley"));
        assert!(rolls, "{said:?}");
        let cautions: Vec<Option<&str>> = found["objects"]
            .as_array()
            .unwrap()
            .iter()
            .map(|one| one["caution"].as_str())
            .collect();
        assert_eq!(cautions, [Some("round"), None, Some("rolls-or-slides")]);
    }
    // Curves of another origin do not say it of themselves: the list does.
    let curves = fs::read_to_string(folder.path().join("runs/fragility.csv")).unwrap();
    let own = curves
        .replace(",round\n", ",\n")
        .replace(",rolls-or-slides\n", ",\n");
    write(folder.path(), "own.csv", &own);
    let of_own = [
        &["risk", "--fragility", "own.csv", "--inventory", "list.csv"],
        &hazard[..],
    ]
    .concat();
    let said = json(folder.path(), &of_own)["warnings"].to_string();
    assert!(
        said.contains("1 object is round") && said.contains("1 object is free to roll or slide"),
        "{said}"
    );
    let outcomes = [
        &[
            "risk",
            "--outcomes",
            "runs/outcomes.csv",
            "--inventory",
            "list.csv",
        ],
        &hazard[..],
    ]
    .concat();
    for (call, page) in [(rates, "of-curves"), (outcomes, "of-outcomes")] {
        let found = json(folder.path(), &[&call[..], &["--out", page]].concat());
        let losses: Vec<&Value> = found["objects"]
            .as_array()
            .unwrap()
            .iter()
            .map(|one| &one["expected_annual_loss_upper"])
            .collect();
        assert!(
            losses[0].is_null() && losses[1].is_number() && losses[2].is_null(),
            "{losses:?}"
        );
        let page = fs::read_to_string(folder.path().join(page).join("report.html")).unwrap();
        for words in ["1 object is free to roll or slide", "1 object is round"] {
            assert!(page.contains(words), "{words}: {page}");
        }
        // The years of the tank; the trolley has no rate in these worlds, and the box no caution.
        assert_eq!(page.matches(">at most ").count(), 1, "{page}");
        // The least is stated once, not beside a larger one that is "at least" as well.
        assert!(
            page.contains("<strong>at least ")
                && !page.contains("Only its bounds are known: at least"),
            "{page}"
        );
    }
}

/// A cell in another currency than its column, and a column that a mapping file leaves out, are not counted as if
/// they were not.
#[test]
fn costs_of_lists_are_in_the_currency_of_their_column() {
    let folder = tempfile::tempdir().unwrap();
    let curves = "id,im,im_unit,at,limit_state,kind,median,beta\na,pgv,m/s,ground,overturns,lognormal,0.6,0.25\n";
    write(folder.path(), "curves.csv", curves);
    let base = [
        "risk",
        "--fragility",
        "curves.csv",
        "--hazard-im",
        "pgv",
        "--inventory",
        "list.csv",
    ];
    let base = [
        &base[..],
        &["--hazard-power", "k0=1e-4 /yr, k=2.5, reference=100 cm/s"],
    ]
    .concat();
    let list = |cell: &str, between: &str| {
        let text = [
            "id,height (mm),depth (mm),replacement value NZD\n",
            &format!("a,1800,500,{cell}\n"),
        ]
        .concat();
        write(folder.path(), "list.csv", &text.replace(',', between));
    };
    for (cell, between) in [
        ("$62000 AUD", ","),
        ("€5000", ";"),
        ("5000 EUR", ";"),
        ("5000 AUD", ";"),
    ] {
        list(cell, between);
        let said = refused(folder.path(), &base);
        let line = format!(
            "list.csv:2: \"{cell}\" is not in NZD, as the column \"replacement value NZD\" is"
        );
        assert!(said.contains(&line), "{said}");
    }
    let loss = |args: &[&str]| {
        json(folder.path(), &[&base[..], args].concat())["expected_annual_loss"].clone()
    };
    list("5000", ",");
    let plain = loss(&[]);
    assert!(plain.as_f64().is_some_and(|loss| loss > 0.0), "{plain}");
    for cell in ["NZ$5000", "5000 NZD", "$5000"] {
        list(cell, ",");
        assert_eq!(loss(&[]), plain, "{cell}");
    }
    // A mapping file as the check of the list writes it reads the same costs; "ignore" is obeyed and said.
    execute(
        folder.path(),
        &[
            "inventory",
            "check",
            "list.csv",
            "--write-columns",
            "map.toml",
        ],
    );
    assert_eq!(loss(&["--columns", "map.toml"]), plain);
    write(
        folder.path(),
        "ignore.toml",
        "[columns]\n\"Replacement value NZD\" = \"ignore\"\n",
    );
    let found = json(
        folder.path(),
        &[&base[..], &["--columns", "ignore.toml"]].concat(),
    );
    assert!(found["expected_annual_loss"].is_null(), "{found}");
    let said = found["warnings"].to_string();
    assert!(
        said.contains("\\\"replacement value NZD\\\" is not counted"),
        "{said}"
    );
}

/// What a fall means for people is read in any list, so that the same budget buys the same options.
#[test]
fn life_safety_comes_first_in_every_list() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "curves.csv",
        "id,im,im_unit,at,limit_state,kind,median,beta\na,pgv,m/s,ground,overturns,lognormal,0.6,0.25\n\
         b,pgv,m/s,ground,overturns,lognormal,0.5,0.25\n",
    );
    let options = "id,option,cost [AUD],median_factor\na,strap,900,4\nb,strap,900,4\n";
    write(folder.path(), "options.csv", options);
    let table =
        "id,item,life_safety,replacement_cost [AUD]\na,rack,high,1000\nb,rack,low,9000000\n";
    let list = "Nr;Lebensgefahr;Neuwert [AUD];H\u{f6}he [mm];Tiefe [mm]\na;hoch;1.000;1800;400\nb;niedrig;9.000.000;1800;300\n";
    write(folder.path(), "table.csv", table);
    write(folder.path(), "list.csv", list);
    let plan = |inventory: &[&str]| {
        let base = [
            "risk",
            "--fragility",
            "curves.csv",
            "--options",
            "options.csv",
            "--budget",
            "1000 AUD",
        ];
        let money = [
            "--horizon",
            "40 yr",
            "--discount",
            "3 %",
            "--hazard-im",
            "pgv",
        ];
        let law = [
            "--hazard-power",
            "k0=1e-4 /yr, k=2.5, reference=100 cm/s",
            "--inventory",
        ];
        let found = json(
            folder.path(),
            &[&base[..], &money, &law, inventory].concat(),
        );
        found["plan"]["chosen"][0]["id"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    };
    for inventory in [
        &["table.csv"][..],
        &["table.csv", "--edit", "D2=2000"],
        &["list.csv"],
    ] {
        assert_eq!(plan(inventory), "a", "{inventory:?}");
    }
}
