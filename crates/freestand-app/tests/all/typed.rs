//! Requests as they are typed elsewhere: lines of a shell, and calls of Python with arguments that its functions have.

#![expect(
    clippy::unwrap_used,
    reason = "a test may stop at what it cannot set up"
)]

use std::path::Path;

use freestand_app::assess::Assess;
use freestand_app::check_list::CheckList;
use freestand_app::drop_test::DropTests;
use freestand_app::motion::MotionSpectrum;
use freestand_app::object::Object;
use freestand_app::request::{Request, from_entries, keys};
use freestand_app::shock::Shock;
use freestand_app::spectrum::Spectrum;
use freestand_app::static_test::StaticTests;
use freestand_app::typed::{Typed, typed};
use freestand_app::validate::Validate;
use freestand_input::keys::KeyStyle;
use serde_json::{Value, json};

fn asked<R: Request>(command: &str, request: &Value) -> Typed {
    let entries = request.as_object().unwrap();
    typed::<R>(command, &from_entries(entries).unwrap())
}

/// The call of Python, after what it imports.
fn call<R: Request>(command: &str, request: &Value) -> Option<String> {
    let lines = asked::<R>(command, request).python?;
    Some(lines.strip_prefix("import freestand as fs\n")?.to_owned())
}

#[test]
fn lines_are_those_of_a_shell() {
    let line = |request: Value| asked::<Object>("object", &request).line;
    assert_eq!(
        line(
            json!({"cg-height": "0,5 m", "height": "6'0\"", "place": "L'Aquila $x", "storeys": 30, "seed": 7})
        ),
        r#"freestand object --height "6'0\"" --cg-height "0,5 m" --place "L'Aquila \$x" --storeys 30 --seed 7"#
    );
    // A number of a program is in SI.
    assert_eq!(
        line(
            json!({"height": 1.8, "tolerance": 98.0665, "level-ratio": 0.5, "motion": ["a b.csv", "c.csv"]})
        ),
        r#"freestand object --height "1.8 m" --tolerance "10 g" --motion "a b.csv" c.csv --level-ratio 0.5"#
    );
    // What has no flag is before a flag that would take it.
    let list = json!({"inventory": "list.xlsx", "study": "study.toml", "edit": ["D7=900 mm", "E2="], "strict": true, "resume": false});
    assert_eq!(
        asked::<Assess>("assess", &list).line,
        r#"freestand assess study.toml --inventory list.xlsx --edit "D7=900 mm" --edit "E2=" --strict"#
    );
    let drops = json!({"file": ["1.csv", "2.csv"], "mass": "0.365 kg", "gravity": "-1 m/s2"});
    assert_eq!(
        asked::<DropTests>("cushion drop", &drops).line,
        r#"freestand cushion drop 1.csv 2.csv --mass "0.365 kg" --gravity "-1 m/s2""#
    );
}

#[test]
fn python_has_numbers_in_the_units_of_its_arguments() {
    let object = |request: Value| call::<Object>("object", &request);
    let on_pads = json!({"height": "1.8 m", "thickness": "400 mm", "place": "Melbourne", "floor": "roof", "storeys": "30",
        "mass": "150 kg", "on": "4380 N/mm"});
    assert_eq!(
        object(on_pads).unwrap(),
        r#"fs.check_object(1.8, 0.4, mass_kg=150, stiffness_n_m=4380000, place="Melbourne", floor="roof", storeys=30)"#
    );
    let more = json!({"height": "6'0\"", "thickness": "18 in", "on": "rubber-foot", "tolerance": "15 g 11 ms",
        "friction": "0.3-0.5", "wall-gap": "0 mm", "motion": "roof.csv", "unit": "g", "taper": "5 %"});
    assert_eq!(
        object(more).unwrap(),
        "fs.check_object(1.8288, 0.4572, cushion=\"rubber-foot\", tolerance_g=15, tolerance_duration_s=0.011, \
         friction=(0.3, 0.5), wall_gap_m=0, motions=fs.read_motions([\"roof.csv\"], unit=\"g\", taper_ratio=0.05))"
    );
    // A scan and a diameter take the place of sizes.
    let scan = json!({"scan": "bust.glb", "scan-unit": "mm", "scan-error": "1 mm", "scan-hull": true, "place": "Athens"});
    assert_eq!(
        object(scan).unwrap(),
        r#"fs.check_object(scan="bust.glb", scan_unit="mm", scan_error_m=0.001, scan_hull=True, place="Athens")"#
    );
    assert_eq!(
        object(json!({"height": "1.5 m", "diameter": "225 mm", "pga": "0.3 g"})).unwrap(),
        "fs.check_object(1.5, diameter_m=0.225, pga_g=0.3)"
    );
    // What the program would refuse has no call, nor what no function takes.
    assert_eq!(
        object(json!({"height": "1 fathom", "thickness": "400 mm"})),
        None
    );
    assert_eq!(object(json!({"thickness": "400 mm"})), None);
    assert_eq!(
        object(json!({"height": "2 m", "thickness": "400 mm", "units": "us"})),
        None
    );
    assert_eq!(call::<Shock>("shock", &json!({"height": "2 m"})), None);
}

#[test]
fn python_asks_about_grids_records_and_lists() {
    let spectrum = |request: &Value| call::<Spectrum>("spectrum", request);
    let mut grid = json!({"heights": "0.3 m:3 m:64", "thicknesses": "100 mm, 1 m", "mass": "150 kg",
        "stiffness": "4380 N/mm", "accuracy": "fast"});
    grid["motion"] = json!(["a.csv", "b.csv"]);
    assert_eq!(
        spectrum(&grid).unwrap(),
        "import numpy as np\n\
         fs.spectrum(fs.read_motions([\"a.csv\", \"b.csv\"]), np.linspace(0.3, 3, 64), [0.1, 1], mass_kg=150, \
         stiffness_n_m=4380000, accuracy=\"fast\")"
    );
    grid.as_object_mut().unwrap().remove("motion");
    assert_eq!(spectrum(&grid), None);
    for (key, value) in [
        ("place", json!("Athens")),
        ("level-ratio", json!(0.5)),
        ("storeys", json!(4)),
        ("restitution-factor", json!(0.9)),
    ] {
        grid[key] = value;
    }
    assert_eq!(
        spectrum(&grid).unwrap(),
        "fs.run({\"building\": {\"storeys\": 4, \"levels\": [{\"name\": \"floor\", \"level_ratio\": 0.5}]}, \
         \"objects\": {\"heights\": \"0.3 m:3 m:64\", \"thicknesses\": \"100 mm, 1 m\", \"mass\": \"150 kg\", \
         \"stiffness\": \"4380 N/mm\", \"restitution_factor\": 0.9, \"accuracy\": \"fast\"}}, place=\"Athens\").rows"
    );
    let record =
        json!({"file": ["r.at2"], "taper": "5 %", "low-cut": "0.1 Hz", "damping": "2 %, 5 %"});
    assert_eq!(
        call::<MotionSpectrum>("motion spectrum", &record).unwrap(),
        "fs.read_motion(\"r.at2\", taper_ratio=0.05, low_cut_hz=0.1).spectrum(damping_ratio=[0.02, 0.05])"
    );
    let list = json!({"place": "Athens", "inventory": "list.xlsx", "edit": ["D7=900 mm"]});
    assert_eq!(
        call::<Assess>("assess", &list).unwrap(),
        "fs.assess(place=\"Athens\", inventory=\"list.xlsx\", edits=[\"D7=900 mm\"])"
    );
}

/// The arguments of a function, which the sources of the package define with these first letters.
fn arguments(function: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../freestand-py/python/freestand");
    let files = [
        "_requests.py",
        "_rocking.py",
        "_laboratory.py",
        "_motion.py",
    ];
    let text: String = files
        .map(|file| std::fs::read_to_string(folder.join(file)).unwrap())
        .concat();
    let (_, after) = text.split_once(&format!("def {function}")).unwrap();
    let (inside, _) = after.split_once(") ->").unwrap();
    let names = inside
        .split([',', '\n'])
        .filter_map(|part| part.split_once(':'));
    names.map(|(name, _)| name.trim().to_owned()).collect()
}

/// Every key of a request has an argument of the function, or there is no call with it.
fn has_arguments<R: Request>(command: &str, first: &Value, functions: &[&str]) {
    let known: Vec<String> = functions
        .iter()
        .flat_map(|function| arguments(function))
        .collect();
    let values = [
        "1 m", "1 kg", "1 g", "1 s", "1 Hz", "1 N", "1 N/m", "1 m/s", "1 deg", "1", "true",
    ];
    for key in keys::<R>().into_iter().chain(["seed".to_owned()]) {
        if first.get(&key).is_some() {
            continue;
        }
        let with = |value: &&str| {
            let mut request = first.clone();
            request[&key] = if *value == "true" {
                json!(true)
            } else {
                json!(value)
            };
            call::<R>(command, &request)
        };
        let call = values.iter().find_map(with);
        let argument = if key == "motion" {
            "motions".to_owned()
        } else {
            KeyStyle::Argument.name(&key)
        };
        match call {
            Some(call) => {
                let named = call
                    .split(['(', ' '])
                    .filter_map(|part| part.split_once('='));
                let unknown: Vec<&str> = named
                    .map(|(name, _)| name)
                    .filter(|name| !known.iter().any(|one| one == name))
                    .collect();
                assert!(
                    unknown.is_empty(),
                    "{command}, {key}: {unknown:?} in {call}"
                );
            }
            None => assert!(
                !known.contains(&argument),
                "{command}: {argument} of {key} can be asked in Python"
            ),
        }
    }
}

#[test]
fn python_has_these_arguments() {
    let size = json!({"height": "1 m", "thickness": "1 m"});
    has_arguments::<Object>("object", &size, &["check_object("]);
    let with_motion = json!({"height": "1 m", "thickness": "1 m", "motion": ["a"]});
    has_arguments::<Object>("object", &with_motion, &["check_object(", "read_motions("]);
    has_arguments::<MotionSpectrum>(
        "motion spectrum",
        &json!({"motion": "a"}),
        &["read_motions(", "spectrum(\n        self,"],
    );
    has_arguments::<DropTests>("cushion drop", &json!({"files": ["a"]}), &["drop_test("]);
    has_arguments::<StaticTests>(
        "cushion static",
        &json!({"files": ["a"]}),
        &["static_test("],
    );
    has_arguments::<CheckList>(
        "inventory check",
        &json!({"file": "a"}),
        &["check_inventory("],
    );
    has_arguments::<Assess>("assess", &json!({}), &["assess("]);
    has_arguments::<Validate>("validate", &json!({}), &["validate("]);
}
