//! `freestand fragility` and `freestand risk` as they are called.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it cannot set up")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/risk/");

fn freestand(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_freestand")).args(args).current_dir(folder).output().unwrap()
}

fn json(folder: &Path, args: &[&str]) -> Value {
    let output = freestand(folder, &[args, &["--json"]].concat());
    assert!(output.status.code().unwrap() < 2, "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The error line of a command that cannot run, which also has a hint.
fn refused(folder: &Path, args: &[&str]) -> String {
    let output = freestand(folder, args);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{args:?}: {text}");
    assert!(text.contains("\nhint: "), "{text}");
    text.lines().next().unwrap().to_owned()
}

fn example(name: &str) -> String {
    format!("{EXAMPLES}{name}")
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

/// The example as counts.
fn counts(text: &str) -> String {
    let mut levels: Vec<(String, String, [usize; 4])> = Vec::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let class =
            ["no-uplift", "rocked", "exceeded", "overturned"].iter().position(|name| *name == cells[3]).unwrap();
        let known = levels.iter_mut().find(|level| level.0 == cells[0] && level.1 == cells[2]);
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
        out += &format!("{id},{level},{},{},{},{}\n", counts[0], counts[1], counts[2], counts[3]);
    }
    out
}

#[test]
fn rows_and_counts_are_one_fit() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(example("outcomes.csv")).unwrap();
    write(folder.path(), "counts.csv", &counts(&text));
    let rows = json(folder.path(), &["fragility", "--outcomes", &example("outcomes.csv"), "--bootstrap", "20"]);
    let counts = json(folder.path(), &["fragility", "--outcomes", "counts.csv", "--bootstrap", "20"]);
    assert_eq!(rows["schema"], "freestand.fragility/1");
    for i in 0..2 {
        let (a, b) = (&rows["objects"][i], &counts["objects"][i]);
        assert_eq!((&a["id"], &a["counts"], &a["log_likelihood"]), (&b["id"], &b["counts"], &b["log_likelihood"]));
        assert_eq!((&a["motions"], &b["motions"]), (&Value::from(40), &Value::Null));
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
        let args = ["fragility", "--outcomes", &outcomes, "--bootstrap", "50", "--threads", threads, "--out", out];
        assert_eq!(freestand(folder.path(), &args).status.code(), Some(0));
        let names = ["fragility.json", "fragility.csv", "empirical.csv", "fragility.svg"];
        names.map(|name| fs::read(folder.path().join(out).join(name)).unwrap())
    };
    assert_eq!(of("1", "one"), of("3", "three"));
}

/// The written curves give the rates of the fit, and Cornell's closed form.
#[test]
fn rates_are_those_of_the_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let law = ["--hazard-im", "pgv", "--hazard-power", "k0=1e-4 /yr, k=2.5, reference=100 cm/s"];
    let curves = "id,im,im_unit,at,limit_state,kind,median,beta\na,pgv,m/s,ground,overturns,lognormal,0.5,0.25\n";
    write(folder.path(), "curves.csv", curves);
    let risk = json(folder.path(), &[&["risk", "--fragility", "curves.csv"], &law[..]].concat());
    let state = &risk["objects"][0]["limit_states"][0];
    let rate = state["annual_rate"].as_f64().unwrap();
    let cornell = 1e-4 * 0.5_f64.powf(-2.5) * (0.5 * 0.625_f64.powi(2)).exp();
    // Rounding alone differs.
    assert!((rate / cornell - 1.0).abs() < 1e-12, "{rate} {cornell}");
    let chance = state["probability"].as_f64().unwrap();
    assert!((chance - (1.0 - (-50.0 * cornell).exp())).abs() < 1e-12);
    let bins = risk["objects"][0]["deaggregation"].as_array().unwrap();
    let sum: f64 = bins.iter().map(|bin| bin["annual_rate"].as_f64().unwrap()).sum();
    assert!(bins.len() >= 20 && (sum / rate - 1.0).abs() < 1e-12);
    assert_eq!((&bins[0]["im_low"], &bins[bins.len() - 1]["im_high"]), (&Value::from(0.0), &Value::Null));

    let fit = ["risk", "--outcomes", &example("outcomes.csv"), "--bootstrap", "20"];
    let fitted = json(folder.path(), &[&fit[..], &law[..]].concat());
    let outcomes = example("outcomes.csv");
    assert!(
        freestand(folder.path(), &["fragility", "--outcomes", &outcomes, "--bootstrap", "0", "--out", "o"])
            .status
            .success()
    );
    let read = json(folder.path(), &[&["risk", "--fragility", "o/fragility.csv"], &law[..]].concat());
    for (a, b) in fitted["objects"].as_array().unwrap().iter().zip(read["objects"].as_array().unwrap()) {
        for state in 0..3 {
            let (a, b) = (&a["limit_states"][state], &b["limit_states"][state]);
            assert_eq!(a["annual_rate"], b["annual_rate"]);
            let ends = a["annual_rate_ci95"].as_array().unwrap();
            let rate = a["annual_rate"].as_f64().unwrap();
            assert!(
                ends[0].as_f64().unwrap() < rate && rate < ends[1].as_f64().unwrap() && b["annual_rate_ci95"].is_null()
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
    let base = ["risk", "--outcomes", &outcomes, "--bootstrap", "20", "--hazard", &hazard];
    let without = json(folder.path(), &base);
    assert!(
        ["portfolio", "ranking", "plan", "currency", "expected_annual_loss"].iter().all(|key| without[key].is_null())
    );
    let money = [&base[..], &["--inventory", &costs, "--options", &options, "--budget", "3000 AUD"]].concat();
    let whole = [&money[..], &["--horizon", "40 yr", "--discount", "3 %"]].concat();
    let output = freestand(folder.path(), &[&whole[..], &["--json"]].concat());
    assert_eq!(output.status.code(), Some(1), "the cabinet overturns more often than accepted");
    let risk: Value = serde_json::from_slice(&output.stdout).unwrap();
    let cabinet = &risk["objects"][0];
    let rate = |i: usize| cabinet["limit_states"][i]["annual_rate"].as_f64().unwrap();
    let loss = 4.0 * ((rate(1) - rate(2)) * 1500.0 + rate(2) * (9000.0 + 2.0 * 400.0));
    assert!((cabinet["expected_annual_loss"].as_f64().unwrap() / loss - 1.0).abs() < 1e-12);
    assert_eq!(cabinet["not_counted"], serde_json::json!(["casualties"]));
    let plan = &risk["plan"];
    assert_eq!((&plan["optimal"], plan["frontier"].as_array().unwrap().len()), (&Value::from(true), 20));
    assert!(plan["cost"].as_f64().unwrap() <= 3000.0 && plan["net_present_value"].as_f64().unwrap() > 0.0);
    let portfolio = &risk["portfolio"];
    assert_eq!((&portfolio["worlds"], &portfolio["currency"]), (&Value::from(560), &Value::from("AUD")));
    let curve = portfolio["loss_exceedance"].as_array().unwrap();
    let point = |i: usize, key: &str| curve[i][key].as_f64().unwrap();
    assert!((1..curve.len()).all(|i| point(i, "loss") > point(i - 1, "loss")));
    assert!((1..curve.len()).all(|i| point(i, "annual_rate") < point(i - 1, "annual_rate")));

    assert!(refused(folder.path(), &money).contains("the horizon or the discount rate is not given"));
    let hundred = [&whole[..], &[]]
        .concat()
        .iter()
        .map(|arg| if *arg == "3000 AUD" { "100 USD" } else { *arg })
        .collect::<Vec<_>>();
    assert!(refused(folder.path(), &hundred).contains("the budget is in USD, and the costs are in AUD"));
}

/// Two equal objects lose twice as much at every rate.
#[test]
fn equal_objects_fail_together() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(example("outcomes.csv")).unwrap();
    let rows = |id: &str| -> String {
        let cabinet = text.lines().filter(|line| line.starts_with("cabinet,"));
        cabinet.map(|line| format!("{}\n", line.replacen("cabinet", id, 1))).collect()
    };
    let head = text.lines().next().unwrap();
    write(folder.path(), "one.csv", &format!("{head}\n{}", rows("a")));
    write(folder.path(), "two.csv", &format!("{head}\n{}{}", rows("a"), rows("b")));
    write(folder.path(), "costs.csv", "id,repair_cost [EUR],replacement_cost [EUR]\na,10,100\nb,10,100\n");
    let hazard = example("hazard.csv");
    let portfolio = |name: &str| {
        let args = ["risk", "--outcomes", name, "--bootstrap", "0", "--hazard", &hazard, "--inventory", "costs.csv"];
        json(folder.path(), &args)["portfolio"]["loss_exceedance"].as_array().unwrap().clone()
    };
    let (one, two) = (portfolio("one.csv"), portfolio("two.csv"));
    assert!(one.len() == 2 && two.len() == 2);
    for (a, b) in one.iter().zip(&two) {
        assert_eq!(a["annual_rate"], b["annual_rate"]);
        assert_eq!(2.0 * a["loss"].as_f64().unwrap(), b["loss"].as_f64().unwrap());
    }
    let missing: Vec<&str> = text.lines().take(1100).collect();
    write(folder.path(), "missing.csv", &missing.join("\n"));
    write(folder.path(), "costs.csv", "id,replacement_cost [EUR]\ncabinet,100\nserver-rack,100\n");
    let args =
        ["risk", "--outcomes", "missing.csv", "--bootstrap", "0", "--hazard", &hazard, "--inventory", "costs.csv"];
    assert!(
        refused(folder.path(), &args).contains("missing.csv: object server-rack has no outcome under motion m39 at")
    );
}

#[test]
fn exports_are_refused_where_they_would_mislead() {
    let folder = tempfile::tempdir().unwrap();
    let outcomes = example("outcomes.csv");
    let base = ["fragility", "--outcomes", &outcomes, "--bootstrap", "0", "--out", "o"];
    let with = |args: &[&'static str]| -> Vec<&str> { [&base[..], args].concat() };
    assert!(
        refused(folder.path(), &with(&["--fit", "separate", "--format", "pelicun"]))
            .contains("separate fits may cross")
    );
    assert!(refused(folder.path(), &with(&["--format", "openquake"])).contains("needs --demand"));
    assert!(
        refused(folder.path(), &with(&["--format", "pelicun", "--demand", "0.4 g"])).contains("--demand"),
        "another unit"
    );
    let floor =
        "object,motion,pfv [m/s],outcome\na,m,0.1,rocked\na,m,0.2,overturned\na,m,0.3,rocked\na,m,0.4,overturned\n";
    write(folder.path(), "floor.csv", floor);
    let args = ["fragility", "--outcomes", "floor.csv", "--format", "openquake", "--out", "o", "--demand", "0.4 m/s"];
    let of_floor = refused(folder.path(), &[&args[..], &["--site-coordinates", "1,2"]].concat());
    assert!(of_floor.contains("OpenQuake has no measure pfv of the floor"), "{of_floor}");
    assert!(!folder.path().join("o").exists(), "nothing is written where anything is refused");
    let step = "object,motion,pgv [m/s],outcome\na-1,m,0.1,no-uplift\na-1,m,0.4,overturned\n";
    write(folder.path(), "step.csv", step);
    let args = ["fragility", "--outcomes", "step.csv", "--format", "pelicun", "--out", "o", "--demand", "0.4 m/s"];
    assert!(refused(folder.path(), &args).contains("overturns is a step"));
    assert!(
        freestand(folder.path(), &[&args[..], &["--beta", "0.3", "--realizations", "5"]].concat()).status.success()
    );
    let written = fs::read_to_string(folder.path().join("o/pelicun/fragility.csv")).unwrap();
    assert_eq!(written.lines().nth(1).unwrap(), "FS.a_1,0,Peak Ground Velocity,mps,0,1,lognormal,0.2,0.3,,,,,");
}

#[test]
fn flags_that_do_not_go_together_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (curves, hazard) = (example("curves.csv"), example("hazard.csv"));
    let base = ["risk", "--fragility", &curves];
    let with = |args: &[&'static str]| -> Vec<&str> { [&base[..], args].concat() };
    assert!(refused(folder.path(), &base).contains("nothing says how often"));
    let law = "k0=1e-4 /yr, k=2.5, reference=1 m/s";
    let of_floor = refused(folder.path(), &with(&["--hazard-im", "pfv", "--hazard-power", law]));
    assert!(of_floor.contains("curves.csv:2: the hazard is that of pfv of the floor"), "{of_floor}");
    assert!(refused(folder.path(), &with(&["--hazard-power", law])).contains("needs --hazard-im"));
    assert!(refused(folder.path(), &with(&["--hazard-im", "pgx", "--hazard-power", law])).contains("\"pgx\" is not"));
    let both = [&base[..], &["--hazard", &hazard, "--hazard-power", law]].concat();
    assert!(refused(folder.path(), &both).contains("exclude each other"));
    let code = ["--hazard-code", "as1170.4", "--hazard-im", "pga", "--site", "De", "--hazard-factor", "0.1"];
    assert!(refused(folder.path(), &with(&code)).contains("the hazard is that of pga of the ground"));
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
        let document = json(folder.path(), &[&base[..], &["--tolerance", tolerance, "--ceiling", "22 g"]].concat());
        document["objects"][0].clone()
    };
    let object = of("5 g");
    assert_eq!(object["curves"].as_array().unwrap().len(), 2, "rocks and overturns");
    let shock = &object["exceeds_by_shock"];
    // ln 10 = 2.3 and a power of 1, but for what is cut off at both ends.
    assert!((shock["intercept"].as_f64().unwrap() - 10.0_f64.ln()).abs() < 0.1, "{shock}");
    assert!((shock["slope"].as_f64().unwrap() - 1.0).abs() < 0.1 && shock["why"].is_null(), "{shock}");
    let median = shock["median"].as_f64().unwrap();
    assert!((median / 0.5 - 1.0).abs() < 0.1, "5 g is half of the ceiling's intensity: {median}");
    let above = of("22 g");
    assert_eq!(above["exceeds_by_shock"]["why"], "ceiling");
    let median = |value: &Value| value["median"].as_f64().unwrap();
    assert!((median(&above["exceeds_by_shock"]) / median(&above["curves"][1]) - 1.0).abs() < 1e-9);
    let low = [&base[..], &["--tolerance", "5 g", "--ceiling", "3 g"]].concat();
    assert!(refused(folder.path(), &low).contains("at most the ceiling, 3 g"));
    let export =
        [&base[..], &["--tolerance", "5 g", "--ceiling", "22 g", "--format", "pelicun", "--out", "o"]].concat();
    assert!(refused(folder.path(), &export).contains("a fit of shocks has no lognormal curve"));
}
