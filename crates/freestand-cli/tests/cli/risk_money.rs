//! Losses, and which options are worth their cost.

use super::risk::{HEAD, LAW, example, json, write};
use crate::program::{execute, refused};
use serde_json::Value;
use std::fs;

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
