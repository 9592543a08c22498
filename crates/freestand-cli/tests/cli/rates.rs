//! Rates and losses at the edges of what was run and of what the hazard curve covers.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{self, execute, folder, refused, shared};

fn json(folder: &Path, args: &[&str]) -> Value {
    let output = execute(folder, &[args, &["--json"]].concat());
    assert!(
        output.status.code().unwrap() < 2,
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    program::json(&output)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// A limit state of an object.
fn state<'a>(risk: &'a Value, id: &str, limit_state: &str) -> &'a Value {
    let object = risk["objects"]
        .as_array()
        .unwrap()
        .iter()
        .find(|object| object["id"] == id)
        .unwrap();
    object["limit_states"]
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["limit_state"] == limit_state)
        .unwrap()
}

/// How often a capacity of each of 20 motions is reached under λ = 10⁻² (x/0.1)^−2.5.
fn capacity(motion: usize) -> f64 {
    0.12 * 1.09_f64.powi(motion as i32)
}

/// Outcomes of 20 motions at these intensities: the object rocks at 0.4 of each capacity.
fn outcomes(levels: &[f64]) -> String {
    let mut text = "object,motion,pga [g],outcome,uplift_intensity [g]\n".to_owned();
    for motion in 0..20 {
        for level in levels {
            let x = capacity(motion);
            let outcome = if *level >= x {
                "overturned"
            } else if *level >= 0.4 * x {
                "rocked"
            } else {
                "no-uplift"
            };
            text += &format!("shelf,m{motion},{level},{outcome},{}\n", 0.4 * x);
        }
    }
    text
}

const LAW: [&str; 2] = ["--hazard-power", "k0=1e-2 /yr, k=2.5, reference=0.1 g"];

/// Equal steps from 0.3 g on leave the weak motions out: the fit alone is far off, and its interval does not
/// contain the rate; with the bounds of the runs it does, and that is said. Intensities close together
/// give the rate itself.
#[test]
fn a_rate_is_bounded_by_what_is_between_the_intensities() {
    let truth = (0..20)
        .map(|motion| 1e-2 * (capacity(motion) / 0.1).powf(-2.5))
        .sum::<f64>()
        / 20.0;
    let coarse: Vec<f64> = (1..6).map(|i| 0.3 * f64::from(i)).collect();
    let fine: Vec<f64> = (0..160).map(|i| 0.03 * 1.025_f64.powi(i)).collect();
    let costs = "id,replacement_cost [EUR]\nshelf,1000\n";
    let folder = folder(&[
        ("coarse.csv", &outcomes(&coarse)),
        ("fine.csv", &outcomes(&fine)),
        ("costs.csv", costs),
    ]);
    let of = |name: &str| {
        let args = [
            "risk",
            "--outcomes",
            name,
            "--bootstrap",
            "100",
            "--inventory",
            "costs.csv",
        ];
        json(folder.path(), &[&args[..], &LAW].concat())
    };
    let (coarse, fine) = (of("coarse.csv"), of("fine.csv"));
    let one = state(&coarse, "shelf", "overturns");
    let ends = |key: &str| {
        [
            number(&one[format!("{key}_lower")]),
            number(&one[format!("{key}_upper")]),
        ]
    };
    let [low, high] = ends("annual_rate");
    assert!(low <= truth && truth <= high, "{one}");
    let interval = one["annual_rate_ci95"].as_array().unwrap();
    assert!(
        number(&interval[0]) <= truth && truth <= number(&interval[1]),
        "{one}"
    );
    assert_eq!(
        (&one["is_bound"], &one["is_at_least"]),
        (&Value::from(true), &Value::from(false))
    );
    let warned = coarse["warnings"].to_string();
    assert!(
        warned.contains("more than a tenth of a rate of shelf may be below 0.3 g"),
        "{warned}"
    );
    // The money follows.
    let object = &coarse["objects"][0];
    let loss = ["expected_annual_loss_lower", "expected_annual_loss_upper"]
        .map(|key| number(&object[key]));
    assert!(
        loss[0] <= 1000.0 * truth && 1000.0 * truth <= loss[1] && object["is_bound"] == true,
        "{object}"
    );
    let one = state(&fine, "shelf", "overturns");
    // The capacities are uniform in the logarithm, and the fit is normal; 1.025^2.5 is 1.06.
    assert!(
        (number(&one["annual_rate"]) / truth - 1.0).abs() < 0.15,
        "{one} {truth}"
    );
    assert!(
        number(&one["annual_rate_lower"]) <= truth && truth <= number(&one["annual_rate_upper"]),
        "{one}"
    );
    assert!(
        !fine["warnings"].to_string().contains("more than a tenth"),
        "{}",
        fine["warnings"]
    );
}

/// The curves that fragility writes say between which intensities they are known.
#[test]
fn curves_keep_what_their_runs_leave_open() {
    let coarse: Vec<f64> = (1..6).map(|i| 0.3 * f64::from(i)).collect();
    let folder = folder(&[("o.csv", &outcomes(&coarse))]);
    let fit = [
        "fragility",
        "--outcomes",
        "o.csv",
        "--bootstrap",
        "0",
        "--out",
        "f",
    ];
    assert_eq!(execute(folder.path(), &fit).status.code(), Some(0));
    let of = |from: [&str; 2]| json(folder.path(), &[&["risk"], &from[..], &LAW].concat());
    let by_curves = of(["--fragility", "f/fragility.csv"]);
    let by_outcomes = of(["--outcomes", "o.csv"]);
    for key in [
        "annual_rate",
        "annual_rate_lower",
        "annual_rate_upper",
        "is_bound",
    ] {
        let of = |risk: &Value| state(risk, "shelf", "overturns")[key].clone();
        assert_eq!(of(&by_curves), of(&by_outcomes), "{key}");
    }
}

/// Who overturns has rocked, also where every run rocked and only the least of that rate is known.
#[test]
fn limit_states_keep_their_order_in_rates() {
    let coarse: Vec<f64> = (1..6).map(|i| 0.3 * f64::from(i)).collect();
    let text: String = outcomes(&coarse)
        .lines()
        .map(|line| line.rsplit_once(',').unwrap().0.to_owned() + "\n")
        .collect();
    let separate = "id,im,im_unit,at,limit_state,kind,median,beta\n\
                    a,pga,g,ground,rocks,lognormal,0.5,0.1\na,pga,g,ground,overturns,lognormal,0.6,1.5\n";
    let folder = folder(&[("o.csv", &text), ("c.csv", separate)]);
    let of = |from: [&str; 2]| json(folder.path(), &[&["risk"], &from[..], &LAW].concat());
    for (risk, id) in [
        (of(["--outcomes", "o.csv"]), "shelf"),
        (of(["--fragility", "c.csv"]), "a"),
    ] {
        let (rocks, overturns) = (state(&risk, id, "rocks"), state(&risk, id, "overturns"));
        let stated = |one: &Value| {
            one["annual_rate"]
                .as_f64()
                .unwrap_or(number(&one["annual_rate_lower"]))
        };
        assert!(stated(rocks) >= stated(overturns), "{rocks} {overturns}");
    }
}

const CURVE: &str =
    "id,im,im_unit,at,limit_state,kind,median,beta\nx,pga,g,ground,overturns,lognormal,0.4,0.35\n";
const HAZARD: &str = "pga [g],annual_rate\n0.0264,0.05\n0.066,0.01\n0.132,0.002\n0.2376,0.0004\n";

/// Most of the rate is above the last point of the hazard curve: the rate continues the curve and says so,
/// and what is accepted is compared with the most that the rate can be.
#[test]
fn motions_above_the_hazard_curve_are_counted_and_told() {
    let costs = "id,replacement_cost [EUR]\nx,1000\n";
    let folder = folder(&[("c.csv", CURVE), ("h.csv", HAZARD), ("costs.csv", costs)]);
    let base = [
        "risk",
        "--fragility",
        "c.csv",
        "--hazard",
        "h.csv",
        "--inventory",
        "costs.csv",
    ];
    let risk = json(folder.path(), &base);
    let one = state(&risk, "x", "overturns");
    // Three digits of an independent quadrature.
    for (key, expected) in [
        ("annual_rate", 1.52e-4),
        ("annual_rate_in_table", 1.79e-5),
        ("annual_rate_upper", 4.18e-4),
    ] {
        assert!(
            (number(&one[key]) / expected - 1.0).abs() < 0.004,
            "{key}: {one}"
        );
    }
    assert_eq!(one["is_bound"], true);
    assert!(
        risk["warnings"]
            .to_string()
            .contains("the hazard curve ends at 0.2376 g"),
        "{}",
        risk["warnings"]
    );
    let loss = number(&risk["objects"][0]["expected_annual_loss"]);
    assert!(
        (loss / (1000.0 * number(&one["annual_rate"])) - 1.0).abs() < 1e-12,
        "{loss}"
    );
    let verdict = |accepted: &str| {
        let risk = json(
            folder.path(),
            &[&base[..], &["--accepted", accepted]].concat(),
        );
        (
            risk["objects"][0]["verdict"].clone(),
            risk["objects"][0]["certain"].clone(),
        )
    };
    let (exceeds, accepted) = (Value::from("exceeds"), Value::from("accepted"));
    assert_eq!(verdict("1e-4 /yr"), (exceeds.clone(), Value::from(false)));
    // Accepted by the continued curve alone.
    assert_eq!(verdict("3e-4 /yr"), (exceeds, Value::from(false)));
    assert_eq!(verdict("5e-4 /yr").0, accepted);
}

/// The intensities of a clinic in Messina few and in equal steps, many and low, and few with those that the
/// hazard adds: the rate of the fine ones is between the bounds of the few, and what is added makes these
/// narrow around it. Without the pads, which take longest.
#[test]
#[ignore = "ten seconds: three sets of runs"]
fn finer_runs_stay_between_the_bounds_of_coarse_ones() {
    let (study, list) = (
        shared().join("findings/messina.toml"),
        shared().join("findings/messina.csv"),
    );
    if !study.exists() {
        println!(
            "skipped: {} is not there ($FREESTAND_SHARED)",
            study.display()
        );
        return;
    }
    let rigid = fs::read_to_string(study).unwrap() + "\n[assessment]\ncompliant = false\n";
    // The rate of a round cylinder has no upper bound; that of the square prism around it has.
    let list = fs::read_to_string(list).unwrap();
    let boxes: String = list
        .lines()
        .enumerate()
        .map(|(i, row)| format!("{row},{}\n", ["shape", "box"][i.min(1)]))
        .collect();
    let folder = folder(&[("study.toml", &rigid), ("list.csv", &boxes)]);
    const FEW: &str = "0.15 g, 0.3 g, 0.45 g, 0.6 g, 0.75 g, 0.9 g, 1.05 g, 1.2 g, 1.35 g, 1.5 g";
    // EN 1998-1, 2.1(4): 475 years, k = 3.
    let law = ["--hazard-power", "k0=0.0021 /yr, k=3, reference=0.25 g"];
    let run = |scales: &str, law_of_runs: &[&str], out: &str| {
        let runs = [
            "fragility",
            "study.toml",
            "--inventory",
            "list.csv",
            "--im",
            "pga",
            "--method",
            "stripes",
        ];
        let how = [
            "--worlds",
            "12",
            "--bootstrap",
            "0",
            "--scales",
            scales,
            "--out",
            out,
            "--quiet",
        ];
        let output = execute(folder.path(), &[&runs[..], &how, law_of_runs].concat());
        assert!(
            output.status.code().unwrap() < 2,
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let table = format!("{out}/outcomes.csv");
        json(
            folder.path(),
            &[
                &["risk", "--outcomes", &table, "--bootstrap", "100"],
                &law[..],
            ]
            .concat(),
        )
    };
    let (coarse, fine) = (run(FEW, &[], "coarse"), run("0.01 g:1.5 g:40", &[], "fine"));
    let added = run(FEW, &law, "added");
    for id in ["M2", "M4", "M5"] {
        let [coarse, fine, added] =
            [&coarse, &fine, &added].map(|risk| state(risk, id, "overturns"));
        let ends = |one: &Value| {
            [
                number(&one["annual_rate_lower"]),
                number(&one["annual_rate_upper"]),
            ]
        };
        let rate = number(&fine["annual_rate"]);
        let [low, high] = ends(coarse);
        assert!(low <= rate && rate <= high, "{id}: {coarse} {fine}");
        // Both have the mean over the capacities of the same motions.
        let [[low, high], [least, most]] = [ends(added), ends(fine)];
        assert!(low <= most && least <= high, "{id}: {added} {fine}");
        // No gap has more than a tenth of the rate, so that the capacities are spread over several: a half is
        // left open by five of them.
        assert!(
            high - low < 0.5 * number(&added["annual_rate"]),
            "{id}: {added}"
        );
    }
    // The few leave open whether bookcases overturn once in 7 years or once in 180.
    let bookcases = state(&coarse, "M4", "overturns");
    assert!(
        number(&bookcases["annual_rate_upper"]) > 10.0 * number(&bookcases["annual_rate_lower"]),
        "{bookcases}"
    );
    let outcomes = fs::read_to_string(folder.path().join("coarse/outcomes.csv")).unwrap();
    assert!(
        outcomes
            .lines()
            .next()
            .unwrap()
            .contains(",uplift_intensity [g],"),
        "{outcomes}"
    );
}

/// People come before money: with 600 the budget reaches one of the two objects rated high, and not the
/// option that pays best.
#[test]
fn life_safety_comes_first_within_a_budget() {
    let row =
        |id: &str, median: f64| format!("{id},pga,g,ground,overturns,lognormal,{median},0.3\n");
    let curves = format!(
        "id,im,im_unit,at,limit_state,kind,median,beta\n{}{}{}",
        row("bed", 0.3),
        row("shelf", 0.4),
        row("server", 0.2)
    );
    let costs = "id,item,building,location,quantity,replacement_cost [EUR],life_safety,anchored\n\
                 bed,Hospital bed,East wing,ICU,1,10,high,\nshelf,Tall shelf,East wing,Ward 2,1,10,H,\n\
                 server,Server,East wing,IT,1,90000,low,\npole,Gas pole,East wing,ICU,2,500,high,Yes - planned\n";
    let options = "id,option,cost [EUR],median_factor\nbed,strap,500,4\nshelf,bracket,550,4\nserver,bolts,100,4\n";
    let folder = folder(&[("c.csv", &curves), ("costs.csv", costs), ("o.csv", options)]);
    let base = [
        "risk",
        "--fragility",
        "c.csv",
        "--inventory",
        "costs.csv",
        "--options",
        "o.csv",
        "--discount",
        "3 %",
    ];
    let with = ["--horizon", "40 yr", "--budget", "600 EUR"];
    let args = [&base[..], &with, &LAW].concat();
    let risk = json(folder.path(), &args);
    let plan = &risk["plan"];
    let chosen: Vec<&str> = plan["chosen"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["id"].as_str().unwrap())
        .collect();
    assert_eq!(chosen, ["bed", "server"], "{plan}");
    assert_eq!(
        (
            &plan["unfunded_life_safety"][0]["id"],
            &plan["unfunded_life_safety_cost"]
        ),
        (&"shelf".into(), &550.0.into())
    );
    assert_eq!(
        (&risk["not_run"][0]["id"], &risk["not_run"][0]["quantity"]),
        (&"pole".into(), &2.0.into())
    );
    let output = execute(folder.path(), &[&args[..], &["--out", "out"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.starts_with("Unfunded life safety: 1 object, 550 EUR (shelf)\n"),
        "{text}"
    );
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    for said in [
        "Hospital bed",
        "Building: East wing.",
        "The object pole (Gas pole), which was not run: anchored",
    ] {
        assert!(page.contains(said), "{said}: {page}");
    }
}

/// What is given is read, or refused as having no effect.
#[test]
fn flags_without_effect_are_refused() {
    let folder = folder(&[
        ("o.csv", &outcomes(&[0.1, 0.2, 0.4])),
        ("c.csv", CURVE),
        ("h.csv", HAZARD),
    ]);
    let fit = ["fragility", "--outcomes", "o.csv", "--bootstrap", "0"];
    for (idle, named) in [
        (&["--mass", "-1 kg"][..], "--mass"),
        (&["--law", "nonsense"], "--law"),
        (&["--scale", "rm -rf"], "--scale"),
        (&["--method", "stripes"], "--method"),
        (&["--restitution", "0.5"], "--restitution"),
        (
            &["--mass", "-1 kg", "--law", "nonsense", "--scale", "rm -rf"],
            "--mass",
        ),
    ] {
        let told = refused(folder.path(), &[&fit[..], idle].concat());
        assert!(told.contains(named) && told.contains("no effect"), "{told}");
    }
    let risk = ["risk", "--fragility", "c.csv", "--hazard", "h.csv"];
    for idle in [
        ["--bootstrap", "5"],
        ["--fit", "separate"],
        ["--horizon", "5 yr"],
        ["--discount", "3 %"],
    ] {
        let told = refused(folder.path(), &[&risk[..], &idle].concat());
        assert!(
            told.contains(idle[0]) && told.contains("has no effect"),
            "{told}"
        );
    }
    let law = ["risk", "--fragility", "c.csv", "--site-coordinates", "1,2"];
    assert!(
        refused(folder.path(), &[&law[..], &LAW].concat())
            .contains("--site-coordinates has no effect")
    );
}

/// The measure of a hazard that names none is that of the curves, if they have one.
#[test]
fn the_measure_of_the_hazard_is_that_of_the_curves() {
    let two = format!("{CURVE}y,pgv,m/s,ground,overturns,lognormal,0.4,0.35\n");
    let folder = folder(&[("c.csv", CURVE), ("two.csv", &two)]);
    let of = |name: &'static str| [&["risk", "--fragility", name][..], &LAW].concat();
    assert_eq!(json(folder.path(), &of("c.csv"))["hazard"]["im"], "pga");
    let told = refused(folder.path(), &of("two.csv"));
    assert!(told.contains("several intensity measures"), "{told}");
}

/// A text that a spreadsheet would calculate is a text in every table of fragility and risk, and an id stays
/// itself when it is read again.
#[test]
fn ids_are_texts_for_spreadsheets() {
    let text = outcomes(&[0.1, 0.2, 0.4]).replace("shelf,", "=cmd|x,");
    let folder = folder(&[("o.csv", &text)]);
    let fit = [
        "fragility",
        "--outcomes",
        "o.csv",
        "--bootstrap",
        "0",
        "--out",
        "f",
    ];
    assert_eq!(execute(folder.path(), &fit).status.code(), Some(0));
    let risk = [
        &["risk", "--fragility", "f/fragility.csv", "--out", "r"][..],
        &LAW,
    ]
    .concat();
    assert_eq!(json(folder.path(), &risk)["objects"][0]["id"], "=cmd|x");
    for name in ["f/fragility.csv", "f/empirical.csv", "r/risk.csv"] {
        let table = fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(
            table.contains("'=cmd|x") && !table.contains("\n=cmd"),
            "{name}: {table}"
        );
    }
}
