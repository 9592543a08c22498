//! `motion synth`, `match` and `simulate`, as a user calls them.

use std::path::Path;

use serde_json::Value;

use crate::program::{self, execute, names};

fn document(args: &[&str]) -> Value {
    program::document(Path::new("."), &[args, &["--quiet"]].concat())
}

#[test]
fn a_magnitude_and_a_distance_give_motions_with_all_that_made_them() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let simulate = [
        "motion",
        "simulate",
        "--magnitude",
        "6",
        "--distance",
        "28 km",
        "--count",
        "2",
        "--seed",
        "3",
    ];
    let one = document(&[&simulate[..], &["--out", out.to_str().unwrap()]].concat());
    assert_eq!(one["schema"], "freestand.motion-simulate/1");
    assert_eq!(
        (&one["seed"], &one["parameters"]["stress_drop_pa"]),
        (&Value::from(3), &Value::from(2e7))
    );
    assert!(one["generator"].as_str().unwrap().contains("ChaCha12"));
    let earthquake = &one["earthquakes"][0];
    // f₀ of the reference, five digits; T_d = 1/f₀ + 0.05·28.
    let corner_hz = earthquake["corner_frequencies_hz"][0].as_f64().unwrap();
    assert!((corner_hz - 0.44854).abs() < 5e-6);
    assert!((earthquake["duration_s"].as_f64().unwrap() - 1.0 / corner_hz - 1.4).abs() < 1e-9);
    assert_eq!(earthquake["motions"].as_array().unwrap().len(), 2);
    let names = names(&out);
    for name in [
        "fourier_amplitude.csv",
        "m6.0-28km-01.csv",
        "m6.0-28km-02.csv",
        "m6.0-28km-01.png",
        "manifest.json",
    ] {
        assert!(
            names.iter().any(|other| other == name),
            "{name} in {names:?}"
        );
    }
    // Without a folder the same motions, and no paths.
    let again = document(&simulate);
    assert_eq!(again["earthquakes"][0]["motions"][1]["path"], Value::Null);
    assert_eq!(
        again["earthquakes"][0]["motions"][1]["pga_g"],
        earthquake["motions"][1]["pga_g"]
    );
}

#[test]
#[ignore = "seconds: the motions of several cities"]
fn a_city_gives_the_distances_of_its_spectrum() {
    let pairs = document(&[
        "motion",
        "simulate",
        "--city",
        "Melbourne",
        "--magnitude",
        "6",
        "--count",
        "4",
        "--site",
        "De",
    ]);
    let earthquake = &pairs["earthquakes"][0];
    assert_eq!(pairs["kpz_g"], 0.08);
    assert!((earthquake["mean_ratio_to_rock_spectrum"].as_f64().unwrap() - 1.0).abs() < 2e-3);
    // An independent computation has 30 km; means of twenty motions have a standard error of 7 %,
    // and it rounds to 5 km.
    let distance_m = earthquake["distance_m"].as_f64().unwrap();
    assert!((24e3..37e3).contains(&distance_m), "{distance_m}");
    // The search has its twenty, the four that are written say their own mean: within 2.7 of
    // 0.2/√4, and of what a ratio of Fourier amplitudes does to a spectrum.
    assert_eq!(earthquake["searched_motions"], 20);
    let written = earthquake["written_mean_ratio_to_site_spectrum"]
        .as_f64()
        .unwrap();
    assert!((0.6..1.5).contains(&written), "{written}");
    // The distance is that of the earthquake, not of how many are written or on what.
    let one = document(&[
        "motion",
        "simulate",
        "--city",
        "Melbourne",
        "--magnitude",
        "6",
        "--count",
        "1",
    ]);
    assert_eq!(
        one["earthquakes"][0]["distance_m"],
        earthquake["distance_m"]
    );
    assert!(
        pairs["assumptions"][1]
            .as_str()
            .unwrap()
            .contains("no soil column")
    );
}

#[test]
fn a_record_is_matched_by_both_methods_and_to_a_peak() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("rock");
    document(&[
        "motion",
        "synth",
        "--site",
        "Be",
        "--count",
        "1",
        "--time-step",
        "0.01 s",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(names(&out).contains(&"target.svg".to_owned()));
    let record = out.join("synthetic-01.csv");
    let match_it = ["motion", "match", record.to_str().unwrap(), "--site", "De"];
    for (method, more) in [("wavelet", &[][..]), ("fft", &["--method", "fft"][..])] {
        let matched = document(&[&match_it[..], more].concat());
        assert_eq!(
            (&matched["method"], &matched["motions"][0]["dt_s"]),
            (&Value::from(method), &Value::from(0.01))
        );
        assert!(matched["motions"][0]["rms_misfit_ratio"].as_f64().unwrap() < 0.05);
        assert!(matched["motions"][0]["correlation_ratio"].as_f64().unwrap() > 0.5);
    }
    let peak = document(&[&match_it[..], &["--match-pga"]].concat());
    let one = &peak["motions"][0];
    // A thousandth is the tolerance of the peak.
    assert!((one["pga_g"].as_f64().unwrap() / 0.088 - 1.0).abs() < 1e-3);
    assert!(one["rms_misfit_ratio"].as_f64() > one["rms_misfit_before_pga_ratio"].as_f64());
}

#[test]
fn what_cannot_be_simulated_is_said() {
    for (args, words) in [
        (
            &["--magnitude", "9", "--distance", "30 km"][..],
            "magnitude must be from 3 to 8.5",
        ),
        (&["--magnitude", "6", "--distance", "30"], "--distance"),
        (
            &[
                "--magnitude",
                "6",
                "--distance",
                "30 km",
                "--preset",
                "mars",
            ],
            "\"mars\" is not known",
        ),
        (&["--city", "Atlantis"], "is not in the table of places"),
        (
            &["--city", "Melbourne", "--return-period", "7"],
            "--return-period",
        ),
        (&["--magnitude", "6"], "--distance"),
    ] {
        let output = execute(Path::new("."), &[&["motion", "simulate"], args].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words) && said.contains("hint:"), "{said}");
    }
}

#[test]
fn changes_of_a_preset_are_in_what_is_assumed() {
    let at = |distance: &str, more: &[&str]| {
        let one = [
            "motion",
            "simulate",
            "--magnitude",
            "6",
            "--distance",
            distance,
            "--count",
            "1",
        ];
        document(&[&one[..], more].concat())["warnings"].to_string()
    };
    let said = |more: &[&str]| at("30 km", more);
    let intraplate = said(&["--preset", "intraplate"]);
    assert!(
        intraplate.contains("f_max = 50 Hz is quoted from memory")
            && intraplate.contains("0.05 s/km"),
        "{intraplate}"
    );
    let kappa = said(&["--preset", "intraplate", "--kappa", "0.01 s"]);
    assert!(
        !kappa.contains("f_max") && kappa.contains("κ0 = 0.01 s, not the preset's"),
        "{kappa}"
    );
    let hard = said(&[
        "--preset",
        "se-australia",
        "--hard-rock",
        "--stress-drop",
        "50 MPa",
    ]);
    assert!(
        !hard.contains("Melbourne profile") && !hard.contains("23 MPa") && hard.contains("50 MPa"),
        "{hard}"
    );
    assert!(
        hard.contains("0.78 to 19.9 Hz") && !hard.contains("was made for"),
        "{hard}"
    );
    assert!(at("410 km", &["--preset", "se-australia"]).contains("below 400 km"));
}

#[test]
fn the_least_kpz_of_a_code_is_told_and_a_period_needs_a_city() {
    let hobart = document(&[
        "motion",
        "simulate",
        "--city",
        "Hobart",
        "--magnitude",
        "6",
        "--count",
        "1",
    ]);
    assert!(
        hobart["warnings"].to_string().contains("minimum kpZ"),
        "{}",
        hobart["warnings"]
    );
    let one = [
        "motion",
        "simulate",
        "--magnitude",
        "6",
        "--distance",
        "30 km",
        "--return-period",
        "2500",
    ];
    let output = execute(Path::new("."), &one);
    assert!(
        output.status.code() == Some(2)
            && String::from_utf8_lossy(&output.stderr).contains("--city")
    );
}

#[test]
fn a_held_table_has_no_peak_to_match() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("uhs.csv");
    std::fs::write(&table, "period [s],sa [g]\n0.05,0.2\n0.5,0.2\n5,0.02\n").unwrap();
    let synth = [
        "motion",
        "synth",
        "--spectrum",
        table.to_str().unwrap(),
        "--beyond",
        "hold",
        "--match-pga",
    ];
    let output = execute(Path::new("."), &synth);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code() == Some(2) && said.contains("--match-pga") && said.contains("0.05 s"),
        "{said}"
    );
}
