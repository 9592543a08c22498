//! Motions of a study that are simulated, and records that are matched: what goes together and what does not.

#![expect(clippy::unwrap_used, reason = "a test may stop at an error")]

use std::path::Path;

use freestand::motion::Motion;
use freestand_input::problem::Problem;
use freestand_records::formats::write_csv;
use freestand_study::resolve::{Overrides, resolve, resolve_with};
use freestand_study::result::{NotVaried, WhyNotVaried};
use freestand_study::simulated::SimulationAssumption;
use freestand_study::study::{Ground, Study, StudyDoubt};
use freestand_study::vary::{changes, parse_variation};

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("record.csv"), write_csv(&record(20.0))).unwrap();
    std::fs::write(folder.path().join("short.csv"), write_csv(&record(4.0))).unwrap();
    folder
}

/// A sweep from 0.15 to 25 Hz under a half sine: something at every period that is matched.
fn record(duration_s: f64) -> Motion {
    let sample = |i: u32| {
        let t = f64::from(i) * 0.01;
        let x = t / duration_s;
        let rate = (25.0f64 / 0.15).ln();
        let phase = std::f64::consts::TAU * 0.15 * duration_s / rate * ((rate * x).exp() - 1.0);
        (std::f64::consts::PI * x).sin() * phase.sin()
    };
    Motion::new(
        0.01,
        (0..=(duration_s * 100.0) as u32).map(sample).collect(),
    )
    .unwrap()
}

fn problems(folder: &Path, keys: &str) -> Vec<String> {
    let said = |problem: &Problem| problem.to_string();
    match resolve(
        &format!("[ground]\n{keys}"),
        Some(Path::new("s.toml")),
        folder,
    ) {
        Ok(_) => Vec::new(),
        Err(error) => error.problems.iter().map(said).collect(),
    }
}

fn study(folder: &Path, keys: &str) -> Study {
    resolve(
        &format!("[ground]\n{keys}"),
        Some(Path::new("s.toml")),
        folder,
    )
    .unwrap()
}

#[test]
fn a_source_that_cannot_be_meant_is_refused_at_its_line() {
    let folder = folder();
    for (keys, expected) in [
        (
            "point_source = { distance = \"30 km\" }\n",
            "s.toml:2: point_source needs magnitude",
        ),
        (
            "point_source = { magnitude = 6 }\n",
            "s.toml:2: point_source needs distance",
        ),
        (
            "[ground.point_source]\nmagnitude = 6\ndistance = 30\n",
            "s.toml:4: distance: \"30\" needs a unit",
        ),
        (
            "[ground.point_source]\nmagnitude = 9\ndistance_km = 30\n",
            "s.toml:3: magnitude must be from 3 to 8.5, not 9",
        ),
        (
            "[ground.point_source]\nmagnitude = 6\ndistance_km = 3000\n",
            "s.toml:4: distance must be from 1 km to 1000 km, not 3000000 m",
        ),
        (
            "[ground.point_source]\nmagnitude = 6\ndistance_km = 30\npreset = \"mars\"\n",
            "s.toml:5: preset \"mars\" is not known",
        ),
        (
            "[ground.point_source]\nmagnitude = 6\ndistance_km = 30\nkapa = \"1 ms\"\n",
            "s.toml:5: unknown key kapa in [point_source]",
        ),
        (
            "point_source = 6\n",
            "s.toml:2: point_source must be a table, not 6",
        ),
        (
            "city = \"Perth\"\npoint_source = { magnitude = 6, distance_km = 30 }\n",
            "s.toml:2: city needs pairs = true: a given magnitude and distance need no code",
        ),
        (
            "point_source = { magnitude = 6, distance_km = 30 }\nsite = \"X\"\n",
            "s.toml:3: site \"X\" is not a class of AS 1170.4",
        ),
        (
            "point_source = { magnitude = 6, distance_km = 30 }\ncount = 1001\n",
            "s.toml:3: count must be a whole number from 1 to 1000, not 1001",
        ),
        (
            "count = 251\npoint_source = { pairs = true }\n",
            "s.toml:2: count, the motions of each of four earthquakes, must be a whole number from 1 to 250, not 251",
        ),
        (
            "[ground.point_source]\npairs = true\ndistance_km = 3\n",
            "s.toml:4: distance and pairs exclude each other",
        ),
        (
            "code = \"ec8\"\npoint_source = { pairs = true }\n",
            "s.toml:2: code: pairs = true searches for earthquakes that fit AS 1170.4 only",
        ),
        (
            "city = \"Melborne\"\npoint_source = { pairs = true }\n",
            "s.toml:2: city \"Melborne\" is not in the table of places",
        ),
        // kpZ = 20 g is met nowhere.
        (
            "hazard_factor = 20\ncount = 1\npoint_source = { pairs = true, magnitude = 5.5 }\n",
            "s.toml:4: no distance from 2 to 300 km gives earthquakes of magnitude 5.5 the rock spectrum of kpZ = 20 g",
        ),
        (
            "point_source = { magnitude = 6, distance_km = 30 }\nmotions = \"record.csv\"\n",
            "s.toml:3: point_source and motions exclude each other",
        ),
        (
            "point_source = { magnitude = 6, distance_km = 30 }\nscale = 2\n",
            "s.toml:3: scale needs motions",
        ),
    ] {
        assert_eq!(problems(folder.path(), keys), [expected], "{keys}");
    }
}

#[test]
fn a_match_that_cannot_be_meant_is_refused_at_its_line() {
    let folder = folder();
    for (keys, expected) in [
        ("match = \"wavelet\"\n", "s.toml:2: match needs motions"),
        (
            "motions = \"record.csv\"\nmatch = \"wavelets\"\n",
            "s.toml:3: match \"wavelets\" is not known",
        ),
        (
            "motions = \"record.csv\"\nsite = \"De\"\n",
            "s.toml:3: site and motions exclude each other",
        ),
        (
            "motions = \"record.csv\"\nseed = 3\nmatch = \"fft\"\n",
            "s.toml:4: seed and match exclude each other: a record has no random numbers",
        ),
        (
            "motions = \"record.csv\"\nmatch = \"fft\"\nscale = 3\n",
            "s.toml:4: scale and match exclude each other: the target sets the amplitudes",
        ),
        (
            "motions = \"record.csv\"\nmatch = \"fft\"\nprocessing = { scale_to = \"1 g\" }\n",
            "s.toml:4: scale_to and match exclude each other: the target sets the amplitudes",
        ),
        (
            "motions = \"record.csv\"\nmatch = \"fft\"\nacross = \"record.csv\"\n",
            "s.toml:4: across and match exclude each other: only one component of a record is matched",
        ),
        (
            "motions = \"record.csv\"\nmatch = \"fft\"\nsite = \"X\"\n",
            "s.toml:4: site \"X\" is not a class of AS 1170.4",
        ),
    ] {
        assert_eq!(problems(folder.path(), keys), [expected], "{keys}");
    }
    let short = problems(
        folder.path(),
        "motions = [\"record.csv\", \"short.csv\"]\nmatch = \"fft\"\n",
    );
    assert!(
        short.len() == 1 && short[0].contains("short.csv: a motion of 4 s is too short"),
        "{short:?}"
    );
    let text = "[ground]\nmatch = \"fft\"\n[building]\nlevels = [{ name = \"roof\", motions = [\"record.csv\"] }]\n";
    let error = resolve(text, Some(Path::new("s.toml")), folder.path())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("s.toml:2: match has no effect: the study gives the motions of its floors"),
        "{error}"
    );
}

#[test]
#[ignore = "seconds: motions of several earthquakes"]
fn each_earthquake_has_its_motions_and_the_seed_of_the_command_line_wins() {
    let folder = folder();
    let text = "[ground]\nsite = \"De\"\ncount = 2\nseed = 3\n\
                point_source = { pairs = true, stress_drop = \"30 MPa\", hard_rock = true }\n";
    let overrides = Overrides {
        seed: Some(9),
        ..Overrides::default()
    };
    let study = resolve_with(text, None, folder.path(), &overrides).unwrap();
    let names = study.ground.names(&study.levels);
    let Ground::Simulated(simulated) = &study.ground else {
        panic!()
    };
    assert_eq!(
        (
            names.len(),
            simulated.earthquakes.len(),
            study.ground.seed()
        ),
        (8, 4, Some(9))
    );
    assert!(
        names[7].starts_with("m7.0-") && names[7].ends_with("km-02"),
        "{names:?}"
    );
    for (found, magnitude) in simulated.earthquakes.iter().zip([5.5, 6.0, 6.5, 7.0]) {
        assert_eq!(
            (found.source.magnitude, found.source.stress_drop_pa),
            (magnitude, 30e6)
        );
        assert!(found.source.profile.is_none());
        // The search's tolerance.
        assert!((found.mean_ratio_to_rock_spectrum.unwrap() - 1.0).abs() < 2e-3);
    }
    assert!(
        study.doubts.iter().any(|one| matches!(
            one,
            StudyDoubt::Simulated(SimulationAssumption::SiteRatio(_))
        )),
        "{:?}",
        study.doubts
    );
    assert_eq!(simulated.hazard.as_ref().unwrap().kpz_g(), Some(0.08));
}

#[test]
fn what_can_be_varied_depends_on_the_ground() {
    let folder = folder();
    let variations: Vec<_> = ["seed", "site", "city = Perth", "scale = 2"]
        .iter()
        .map(|text| parse_variation(text).unwrap())
        .collect();
    let not_varied = |key, why| NotVaried { key, why };
    let varied = |keys: &str| {
        let (changes, left_out) = changes(
            &study(folder.path(), keys),
            &variations,
            &Default::default(),
        );
        let mut names: Vec<&str> = changes.iter().map(|one| one.key).collect();
        names.dedup();
        (names, left_out)
    };
    let (names, left_out) = varied("point_source = { magnitude = 6, distance_km = 30 }\n");
    assert_eq!(names, ["seed", "site"]);
    assert_eq!(
        left_out,
        [
            not_varied("city", WhyNotVaried::OneEarthquake),
            not_varied("scale", WhyNotVaried::Simulated)
        ]
    );
    assert_eq!(
        varied("count = 1\npoint_source = { pairs = true, magnitude = 6 }\n").0,
        ["seed", "site", "city"]
    );
    let (names, left_out) = varied("motions = \"record.csv\"\nmatch = \"fft\"\n");
    assert_eq!(names, ["site", "city"]);
    assert_eq!(left_out[0], not_varied("seed", WhyNotVaried::MatchedSeed));
}

/// The record's own misfit is far larger: the spectrum of a sweep of 1 m/s² is no code's.
#[test]
fn a_record_meets_the_target_by_either_method() {
    let folder = folder();
    for method in ["wavelet", "FFT"] {
        let keys = format!(
            "motions = \"record.csv\"\nhazard_factor = 0.12\nsite = \"Ce\"\nmatch = \"{method}\"\n"
        );
        let study = study(folder.path(), &keys);
        let Ground::Recorded(records) = &study.ground else {
            panic!()
        };
        let matched = records[0].matched.as_ref().unwrap();
        let spectrum = |period_s| matched.target.spectrum.sa_g(period_s);
        let before = freestand::synthesis::misfit(&record(20.0), spectrum).unwrap();
        let after = freestand::synthesis::misfit(&records[0].motion, spectrum).unwrap();
        // A tenth: records in docs/motions.md come to 2.5 to 3.5 %.
        assert!(
            before.rms_ratio > 0.5 && after.rms_ratio < 0.1,
            "{method}: {before:?} {after:?}"
        );
        assert!((after.rms_ratio - matched.misfit.rms_ratio).abs() < 1e-9);
        let words = records[0].processing.last().unwrap();
        assert!(
            words.starts_with("matched to AS 1170.4-2007 (Amdt 1, 2), site Ce, Z = 0.12,"),
            "{words}"
        );
    }
}
