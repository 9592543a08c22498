//! Studies whose motions are simulated or matched, as a user runs them.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{document, execute, folder, refused};

const OBJECTS: &str = "[objects]\nheights = \"1 m, 2 m\"\nthicknesses = \"300 mm, 500 mm\"\n";

fn done(folder: &Path, args: &[&str]) -> Vec<u8> {
    let output = execute(folder, &[args, &["--quiet"]].concat());
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    output.stdout
}

/// Runs the study, the study once more, and the study in the first output folder: the same bytes;
/// gives `summary.json`.
fn run_three_times(folder: &Path, ground: &str) -> (Value, String) {
    fs::write(
        folder.join("s.toml"),
        format!("[ground]\n{ground}{OBJECTS}"),
    )
    .unwrap();
    done(folder, &["run", "s.toml", "--out", "first"]);
    done(
        folder,
        &["run", "s.toml", "--out", "again", "--threads", "1"],
    );
    done(folder, &["run", "first/study.toml", "--out", "rerun"]);
    let read = |name: &str| fs::read(folder.join(name)).unwrap();
    assert!(read("first/report.html") == read("again/report.html"));
    for name in ["srs.csv", "urs.csv", "statistics.csv", "study.toml"] {
        assert!(
            read(&format!("first/{name}")) == read(&format!("again/{name}")),
            "{name}"
        );
        assert!(
            read(&format!("first/{name}")) == read(&format!("rerun/{name}")),
            "{name}"
        );
    }
    let summary = serde_json::from_slice(&read("first/summary.json")).unwrap();
    (
        summary,
        String::from_utf8(read("first/report.html")).unwrap(),
    )
}

#[test]
#[ignore = "ten seconds: simulated motions, twice"]
fn a_point_source_gives_the_motions_of_motion_simulate() {
    let folder = tempfile::tempdir().unwrap();
    let ground = "point_source = { magnitude = 6, distance = \"28 km\", window = \"saragoni-hart\" }\nsite = \"Ce\"\n\
                  count = 2\nseed = 3\n";
    let (summary, report) = run_three_times(folder.path(), ground);
    let flags = "motion simulate --magnitude 6 --distance 28km --window saragoni-hart --site Ce --count 2 --seed 3 --out m";
    done(folder.path(), &flags.split(' ').collect::<Vec<_>>());
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    for name in ["m6.0-28km-01.csv", "m6.0-28km-02.csv"] {
        assert!(
            read(&format!("first/motions/{name}")) == read(&format!("m/{name}")),
            "{name}"
        );
    }
    let ground = &summary["inputs"]["ground"];
    assert_eq!(
        (&ground["preset"], &ground["site"], &ground["seed"]),
        (&"victoria".into(), &"Ce".into(), &3.into())
    );
    assert_eq!(ground["parameters"]["window"], "saragoni-hart");
    assert_eq!(summary["seeds"]["ground"], 3);
    // f₀ of the reference in docs/motions.md, five digits.
    let earthquake = &ground["earthquakes"][0];
    assert!((earthquake["corner_frequencies_hz"][0].as_f64().unwrap() - 0.44854).abs() < 5e-6);
    for words in [
        "a simulated earthquake of magnitude 6 at 28 km",
        "ChaCha12",
        "0.449",
        "no soil column",
        "20 MPa",
    ] {
        assert!(report.contains(words), "{words}");
    }
    assert!(
        !report.contains("How well the motions meet"),
        "there is no target"
    );
    let check: Value =
        serde_json::from_slice(&done(folder.path(), &["check", "s.toml", "--json"])).unwrap();
    assert_eq!(
        check["ground"],
        "2 simulated motions, seed 3, victoria, site Ce: M 6.0 at 28.0 km"
    );
}

#[test]
#[ignore = "ten seconds: the distance of a city, three times"]
fn pairs_of_a_city_are_those_of_motion_simulate() {
    let folder = tempfile::tempdir().unwrap();
    let ground = "city = \"Adelaide\"\nsite = \"De\"\ncount = 2\nseed = 5\npoint_source = { pairs = true, magnitude = 6.5 }\n";
    let (summary, report) = run_three_times(folder.path(), ground);
    let flags =
        "motion simulate --city Adelaide --magnitude 6.5 --site De --count 2 --seed 5 --json";
    let flags: Value =
        serde_json::from_slice(&done(folder.path(), &flags.split(' ').collect::<Vec<_>>()))
            .unwrap();
    let (one, other) = (
        &summary["inputs"]["ground"]["earthquakes"][0],
        &flags["earthquakes"][0],
    );
    assert_eq!(
        (&one["distance_m"], &one["duration_s"]),
        (&other["distance_m"], &other["duration_s"])
    );
    assert_eq!(summary["inputs"]["ground"]["kpz_g"], flags["kpz_g"]);
    assert_eq!(
        summary["inputs"]["motions"][1]["pga_g"],
        other["motions"][1]["pga_g"]
    );
    for words in [
        "simulated earthquakes equivalent to a 500-year earthquake: Adelaide",
        "Distances fitted to",
        ">code spectrum<",
    ] {
        assert!(report.contains(words), "{words}");
    }
    assert!(!report.contains("target: code spectrum"));
}

#[test]
#[ignore = "ten seconds: matched motions, twice"]
fn matched_records_are_those_of_motion_match() {
    matched_records(&["wavelet"]);
}

#[test]
#[ignore = "ten seconds: three studies for each method"]
fn records_of_every_method_are_those_of_motion_match() {
    matched_records(&["wavelet", "fft"]);
}

fn matched_records(methods: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let synth = "motion synth --site Be --count 2 --time-step 0.01s --out rock";
    done(folder.path(), &synth.split(' ').collect::<Vec<_>>());
    for method in methods {
        let ground = format!(
            "motions = [\"rock/synthetic-01.csv\", \"rock/synthetic-02.csv\"]\nmatch = \"{method}\"\nsite = \"De\"\n"
        );
        for name in ["first", "again", "rerun", "m"] {
            let _ = fs::remove_dir_all(folder.path().join(name));
        }
        let (summary, report) = run_three_times(folder.path(), &ground);
        let flags =
            format!("motion match rock/synthetic-02.csv --site De --method {method} --out m");
        done(folder.path(), &flags.split(' ').collect::<Vec<_>>());
        let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
        assert!(
            read("first/motions/synthetic-02.csv") == read("m/synthetic-02-matched.csv"),
            "{method}"
        );
        let one = &summary["inputs"]["ground"][0];
        let check: Value =
            serde_json::from_slice(&done(folder.path(), &["check", "s.toml", "--json"])).unwrap();
        let rms = &summary["inputs"]["motions"][0]["misfit"]["rms_ratio"];
        assert_eq!(&check["motions"][0]["rms_misfit_ratio"], rms);
        assert_eq!(one["matched"]["method"], *method);
        assert!(
            summary["inputs"]["motions"][0]["misfit"]["rms_ratio"]
                .as_f64()
                .unwrap()
                < 0.05
        );
        assert_eq!(summary["seeds"], Value::Null);
        for words in [
            "How well the motions fit their target",
            "matched to AS 1170.4",
            "The records were matched",
        ] {
            assert!(report.contains(words), "{words}");
        }
    }
}

/// A suite that cannot be made stops `run` and `assess` before they write anything.
#[test]
fn a_suite_that_cannot_be_used_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("records")).unwrap();
    for (name, period_s) in [("a", 0.3), ("b", 0.7)] {
        let sample = |i: usize| {
            3.0 * (std::f64::consts::TAU * i as f64 * 0.01 / period_s).sin()
                * (-0.003 * i as f64).exp()
        };
        let rows: String = (0..1000)
            .map(|i| format!("{},{}\n", i as f64 * 0.01, sample(i)))
            .collect();
        fs::write(
            folder.path().join(format!("records/{name}.csv")),
            format!("time_s,accel_m_s2\n{rows}"),
        )
        .unwrap();
    }
    fs::write(
        folder.path().join("list.csv"),
        "id,level_ratio,height [mm],thickness [mm]\na,0,900,700\n",
    )
    .unwrap();
    let commands = |study: &str| -> Vec<(Option<i32>, String)> {
        fs::write(
            folder.path().join("s.toml"),
            format!("[ground]\nplace = \"Christchurch\"\n{study}\n{OBJECTS}"),
        )
        .unwrap();
        let with = |args: &[&str]| {
            let output = execute(
                folder.path(),
                &[args, &["--quiet", "--out", "out"]].concat(),
            );
            (
                output.status.code(),
                String::from_utf8(output.stderr).unwrap(),
            )
        };
        vec![
            with(&["assess", "s.toml", "--inventory", "list.csv"]),
            with(&["run", "s.toml"]),
        ]
    };
    for (study, said) in [
        (
            "suite = \"records\"\nsuite_count = 5",
            "s.toml:4: suite_count asks for 5 records, but 2 records of records",
        ),
        (
            "suite = \"nowhere\"",
            "s.toml:3: suite: nowhere: does not exist",
        ),
        (
            "suite = \"records\"\nseed = 3",
            "s.toml:4: seed and suite exclude each other",
        ),
    ] {
        for (code, error) in commands(study) {
            assert_eq!(code, Some(2), "{error}");
            assert!(
                error.contains(said) && error.contains("hint: "),
                "{study}: {error}"
            );
        }
        assert!(!folder.path().join("out").exists(), "{study}");
    }
}

/// A file of design values says for which site class it was asked: that counts, unless another one is given. It has no
/// return period to choose.
#[test]
fn design_values_have_the_site_class_of_their_file() {
    let text = r#"{"request":{"parameters":{"latitude":34,"longitude":-118,"siteClass":"D-default"}},"response":{"data":{"ss":1.9,"s1":0.7}}}"#;
    let other = text.replace("D-default", "C");
    let here = folder(&[("d.json", text), ("c.json", &other)]);
    let object = ["object", "--height", "2 m", "--thickness", "0.5 m"];
    let earthquake = |more: &[&str]| {
        let told = document(here.path(), &[&object[..], more].concat());
        told["earthquake"].as_str().unwrap().to_owned()
    };
    let of_c = earthquake(&["--spectrum", "c.json"]);
    assert!(of_c.contains("site C"), "{of_c}");
    assert!(earthquake(&["--spectrum", "d.json"]).contains("site D"));
    assert_eq!(
        earthquake(&["--spectrum", "d.json", "--site", "C"]),
        of_c.replace("c.json", "d.json")
    );
    let years = [
        &object[..],
        &["--spectrum", "c.json", "--return-period", "475"],
    ]
    .concat();
    refused(here.path(), &years);
}

/// Of a file with several sites, the answer says which one was used, how far away it is, and the return period.
#[test]
fn the_site_of_a_spectrum_is_told() {
    let text = "#,,,\"kind='mean', investigation_time=50.0\"\nlon,lat,0.1~PGA,0.1~SA(0.2),0.1~SA(1.0)\n\
                12.5,41.9,0.12,0.28,0.1\n13.0,42.3,0.26,0.6,0.2\n";
    let here = folder(&[("uhs.csv", text)]);
    let object = [
        "object",
        "--height",
        "2 m",
        "--thickness",
        "0.4 m",
        "--spectrum",
        "uhs.csv",
    ];
    let at = ["--place", "41.95, 12.40", "--return-period", "475"];
    let told = document(here.path(), &[&object[..], &at].concat());
    let warnings = told["warnings"].to_string();
    // 10 % in 50 years: 50/−ln 0.9. 0.05° of latitude and 0.1° of longitude: √(5.56² + 8.29²) = 9.98 km.
    let said =
        "the spectrum at 474.6 years is that of the site of uhs.csv at 41.9, 12.5, 10 km away";
    assert!(warnings.contains(said), "{warnings}");
}
