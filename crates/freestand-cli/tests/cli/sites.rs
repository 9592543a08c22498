//! Several sites in one run.

use std::path::Path;

use serde_json::Value;

use crate::program::{document, refused};

const HEAD: &str = "id,item,level_ratio,height,thickness,mass,life_safety,falls_cost,wall_gap\n";
const FILE: &str = "[sites.Wellington]\nplace = \"Wellington\"\nstoreys = 6\ninventory = \"lists/a.csv\"\n\n\
                    [sites.\"Auckland 2\"]\nplace = \"Auckland\"\nstoreys = 3\ninventory = \"lists/b.csv\"\n";

fn written(folder: &Path) {
    std::fs::create_dir(folder.join("lists")).unwrap();
    // Only the second list has a column of its own.
    let a = format!(
        "{HEAD}shelf,shelf,0,2 m,0.3 m,100 kg,high,500,0 mm\ndesk,desk,0,0.8 m,1.4 m,60 kg,,,\n"
    );
    std::fs::write(folder.join("lists/a.csv"), a).unwrap();
    let b = "id,item,level_ratio,height,thickness,mass,wall_gap,owner\nshelf,shelf,0,2 m,0.12 m,100 kg,300 mm,Ann\n";
    std::fs::write(folder.join("lists/b.csv"), b).unwrap();
    std::fs::write(folder.join("sites.toml"), FILE).unwrap();
}

/// The losses of all sites: the yearly loss is that of the plan, insurance pays less, and common earthquakes cost most.
#[test]
fn sites_lose_together() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let head = "id,item,level_ratio,height,thickness,mass,replacement_cost [NZD],downtime [day],wall_gap\n";
    for (name, place) in [("a", "shelf,0,2 m,0.3 m"), ("b", "rack,0,2 m,0.35 m")] {
        let list = format!("{head}1,{place},100 kg,5000,4,300 mm\n2,{place},100 kg,3000,,300 mm\n");
        std::fs::write(here.join(format!("{name}.csv")), list).unwrap();
    }
    let site =
        |name: &str| format!("place = \"Wellington\"\nstoreys = 6\ninventory = \"{name}.csv\"\n");
    let file = format!(
        "[sites.A]\n{}deductible = \"1000 NZD\"\n[sites.B]\n{}[policy]\nlimit = \"9,000 NZD\"\ncorrelation_range = \"10 km\"\n",
        site("a"),
        site("b")
    );
    std::fs::write(here.join("sites.toml"), &file).unwrap();
    let asked = [
        "assess",
        "--sites",
        "sites.toml",
        "--out",
        "out",
        "--budget",
        "5000 NZD",
    ];
    let told = document(here, &asked);
    let losses = &told["losses"];
    let number = |value: &Value| value.as_f64().unwrap();
    // One yearly loss: that of each object once, as the plan has it, and that of its site.
    let mut seen = std::collections::BTreeMap::new();
    for row in told["plan_alternatives"].as_array().unwrap() {
        let key = (row["site"].as_str().unwrap(), row["id"].as_str().unwrap());
        if let Some(loss) = row["annual_loss"].as_f64() {
            seen.insert(key, loss);
        }
    }
    let expected: f64 = seen.values().sum();
    assert!(expected > 0.0);
    assert!((number(&losses["annual_loss"]) / expected - 1.0).abs() < 1e-9);
    let sites = losses["sites"].as_array().unwrap();
    assert!(number(&sites[0]["annual_paid"]) < number(&sites[0]["annual_loss"]));
    assert_eq!(sites[1]["annual_paid"], sites[1]["annual_loss"]);
    assert!(number(&sites[0]["downtime_days_per_year"]) > 0.0);
    assert_eq!(losses["correlation_range_km"], 10.0);
    let row = |dependence: &str, years: u64| {
        let mut rows = losses["rows"].as_array().unwrap().iter();
        rows.find(|row| row["dependence"] == dependence && row["return_period_years"] == years)
            .unwrap()
    };
    // All falls together cost 16,000 NZD; independent earthquakes are at one site, which has 8000.
    assert_eq!(row("common", 1000)["event_loss"], 16_000.0);
    assert_eq!(row("independent", 1000)["event_loss"], 8_000.0);
    assert_eq!(row("common", 1000)["event_paid"], 9_000.0);
    // At one place the correlation is 1.
    let correlated = number(&row("correlated", 1000)["event_loss"]);
    assert!(correlated > 8_000.0, "{correlated}");
    assert!(here.join("out/losses.svg").exists());
    let exposure = std::fs::read_to_string(here.join("out/openquake/exposure.csv")).unwrap();
    let lines: Vec<&str> = exposure.lines().collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(lines[0], "id,lon,lat,taxonomy,number,contents");
    assert!(
        lines[1].starts_with("A-1,174.7") && lines[1].ends_with(",A-1,1,5000"),
        "{exposure}"
    );
    let model = std::fs::read_to_string(here.join("out/openquake/exposure.xml")).unwrap();
    assert!(model.contains("unit=\"NZD\""));
    // What is wrong is said of its table.
    let wrong = file
        .replace("1000 NZD", "1000 EUR")
        .replace("10 km", "ten")
        .replace("limit", "limits");
    std::fs::write(here.join("sites.toml"), wrong).unwrap();
    let output = crate::program::execute(here, &asked);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    for part in [
        "[sites.A]: deductible is in EUR, and the budget in NZD",
        "[policy]: correlation_range",
        "[policy]: \"limits\" is not known",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

/// Each site has the verdicts of an assessment of it alone, in one table; the plan is over all of them.
#[test]
fn sites_are_assessed_together() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    written(here);
    let asked = ["assess", "--sites", "sites.toml", "--out", "out"];
    let told = document(here, &[&asked[..], &["--budget", "5000 NZD"]].concat());
    let rows = told["rows"].as_array().unwrap();
    let sites: Vec<[&str; 2]> = rows
        .iter()
        .map(|row| ["site", "id"].map(|key| row[key].as_str().unwrap()))
        .collect();
    let expected = [
        ["Wellington", "shelf"],
        ["Wellington", "desk"],
        ["Auckland 2", "shelf"],
    ];
    assert_eq!(sites, expected);
    let alone = [
        "assess",
        "--inventory",
        "lists/a.csv",
        "--place",
        "Wellington",
        "--storeys",
        "6",
    ];
    let alone = document(here, &[&alone[..], &["--out", "alone"]].concat());
    for (row, own) in rows.iter().zip(alone["rows"].as_array().unwrap()) {
        for key in ["decision", "p_overturn", "p_overturn_high", "why"] {
            assert_eq!(row[key], own[key], "{key}");
        }
    }
    let table = std::fs::read_to_string(here.join("out/objects.csv")).unwrap();
    let mut lines = csv::Reader::from_reader(table.as_bytes());
    let heads = lines.headers().unwrap().clone();
    let owner = heads.iter().position(|head| head == "owner").unwrap();
    let owners: Vec<String> = lines
        .records()
        .map(|one| one.unwrap()[owner].to_owned())
        .collect();
    assert_eq!(
        (&heads[0], owners),
        ("site", ["", "", "Ann"].map(str::to_owned).to_vec())
    );
    // One plan: what it leaves out is told of the objects of both sites.
    let all = told["plan_alternatives"].as_array().unwrap();
    let of = |name: &str| {
        all.iter()
            .any(|row| row["site"] == name && row["id"] == "shelf")
    };
    assert!(of("Wellington") && of("Auckland 2"));
    let plan = told["plan"].as_array().unwrap();
    let cost: f64 = plan.iter().map(|row| row["cost"].as_f64().unwrap()).sum();
    assert!((cost - told["budget"]["cost"].as_f64().unwrap()).abs() < 1e-9);
    assert!(cost <= 5000.0 && cost > 0.0 && !plan.is_empty());
    assert_eq!(plan[0]["site"], "Wellington");
    let written = std::fs::read_to_string(here.join("out/plan.csv")).unwrap();
    assert_eq!(written.lines().count(), 1 + plan.len());
    assert!(here.join("out/Auckland 2/report.html").is_file());
    // The orders of all sites are beside their folders, and name their site.
    let parts = std::fs::read_to_string(here.join("out/parts.html")).unwrap();
    assert!(parts.contains("href=\"orders/Wellington-"), "{parts}");
    assert!(here.join("out/parts.csv").is_file());
    let counted: Vec<&Value> = told["sites"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| &one["objects"])
        .collect();
    assert_eq!(counted, [2, 1]);
    // The same run replaces its own files.
    document(here, &asked);
}

#[test]
fn what_is_wrong_with_a_site_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    written(here);
    let told = |file: &str, more: &[&str]| {
        std::fs::write(here.join("wrong.toml"), file).unwrap();
        refused(
            here,
            &[&["assess", "--sites", "wrong.toml"][..], more].concat(),
        )
    };
    assert!(
        told("[sites.nul]\ninventory = \"lists/a.csv\"\n", &[])
            .contains("[sites.nul]: Windows keeps")
    );
    assert!(told("[sites.a]\nplac = \"Rome\"\n", &[]).contains("[sites.a]: \"plac\" is not known"));
    assert!(told("[sites.a]\nplace = \"Wellington\"\n", &[]).contains("[sites.a]: it has no list"));
    assert!(told("x = 1\n", &[]).contains("is not a table of a file of sites"));
    let unknown = "[sites.a]\nplace = \"Nowhere at all\"\ninventory = \"lists/a.csv\"\n";
    assert!(told(unknown, &[]).contains("[sites.a]: "));
    assert!(told(FILE, &["--place", "Auckland"]).contains("each site has its own"));
    assert!(told(FILE, &["--resume"]).contains("not for several sites"));
    assert!(!here.join("freestand-assessment").exists());
}
