//! Records that a study selects from a folder.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use std::f64::consts::{PI, TAU};
use std::path::Path;

use freestand::motion::Motion;
use freestand::oscillator::response_spectrum;
use freestand::suite::SuiteScale;
use freestand_input::quantity::UnitSystem;
use freestand_output::answer::Answer;
use freestand_records::formats::{write_at2, write_csv, write_pair_csv};
use freestand_report::doubts::{assumed_at, study_doubts, two_spectra};
use freestand_report::study::check::Check;
use freestand_report::study::outputs::write_outputs;
use freestand_study::provenance::provenance;
use freestand_study::resolve::{Overrides, motion_paths, resolve, resolve_with};
use freestand_study::result::{NotVaried, WhyNotVaried};
use freestand_study::run::{no_progress, run};
use freestand_study::study::{Ground, RecordedMotion, Study, StudyDoubt};
use freestand_study::suite::{LeftOut, SuiteDoubt};
use freestand_study::vary::{changes, parse_variation};

/// A sweep from 0.1 to 25 Hz under a half sine, with a peak near 1 m/s²: `tilt` is the power of its
/// frequency that its amplitude grows with.
fn record(tilt: f64, amplitude_m_s2: f64) -> Motion {
    let duration_s = 20.0;
    let rate = (25.0f64 / 0.1).ln();
    let sample = |i: u32| {
        let x = f64::from(i) * 0.01 / duration_s;
        let phase = TAU * 0.1 * duration_s / rate * ((rate * x).exp() - 1.0);
        amplitude_m_s2 * (tilt * rate * (x - 0.5)).exp() * (PI * x).sin() * phase.sin()
    };
    Motion::new(0.01, (0..=2000).map(sample).collect()).unwrap()
}

/// The components of pair `i`, as a sweep of its own tilt and amplitude each.
fn pair(i: u32) -> [Motion; 2] {
    let tilt = 0.12 * (f64::from(i) - 3.5);
    [
        record(tilt, 1.0 + 0.2 * f64::from(i)),
        record(tilt - 0.1, 1.3 + 0.1 * f64::from(i)),
    ]
}

/// Eight pairs in all the ways that pairs come, and files that are none.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("records")).unwrap();
    for i in 0..8 {
        let [x, y] = pair(i);
        let write = |name: String, motion: &Motion| {
            std::fs::write(path(&format!("records/{name}")), write_csv(motion))
        };
        match i {
            0 | 1 => std::fs::write(
                path(&format!("records/both{i}.csv")),
                write_pair_csv(&x, &y),
            )
            .unwrap(),
            2 | 3 => {
                std::fs::write(
                    path(&format!("records/RSN{i}_PLACE_STA090.AT2")),
                    write_at2(&x, "a"),
                )
                .unwrap();
                std::fs::write(
                    path(&format!("records/RSN{i}_PLACE_STA180.AT2")),
                    write_at2(&y, "b"),
                )
                .unwrap();
                std::fs::write(
                    path(&format!("records/RSN{i}_PLACE_STA-UP.AT2")),
                    write_at2(&y, "c"),
                )
                .unwrap();
            }
            _ => {
                write(format!("p{i}1_1.csv"), &x).unwrap();
                write(format!("p{i}1_2.csv"), &y).unwrap();
            }
        }
    }
    for name in [
        "README.md",
        "index.json",
        "CI.CLC.xml",
        "readme.txt",
        ".hidden",
        "RSN2.VT2",
    ] {
        std::fs::write(path(&format!("records/{name}")), "not a record").unwrap();
    }
    std::fs::create_dir(path("records/more")).unwrap();
    std::fs::copy(path("records/both0.csv"), path("records/copy of both0.csv")).unwrap();
    std::fs::write(
        path("records/broken.csv"),
        "time [s],a [g]\n0,0\n0.01,what\n",
    )
    .unwrap();
    folder
}

const CODE: &str =
    "code = \"eurocode8\"\nspectrum_type = 1\nsite = \"C\"\nground_acceleration = \"0.2 g\"\n";

fn text(keys: &str) -> String {
    format!("[ground]\nsuite = \"records\"\n{CODE}{keys}\n[building]\nlevels = [0.0]\n")
}

fn study(folder: &Path, keys: &str) -> Study {
    resolve(&text(keys), Some(Path::new("s.toml")), folder)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn motions(study: &Study) -> &[RecordedMotion] {
    match &study.ground {
        Ground::Recorded(motions) => motions,
        _ => panic!("{:?}", study.ground),
    }
}

fn refused(folder: &Path, ground: &str) -> Vec<String> {
    match resolve(
        &format!("[ground]\n{ground}"),
        Some(Path::new("s.toml")),
        folder,
    ) {
        Ok(_) => Vec::new(),
        Err(error) => error.problems.iter().map(ToString::to_string).collect(),
    }
}

/// Everything that the facts say follows from the motions themselves.
#[test]
fn the_motions_have_the_mean_and_the_dispersion_that_are_reported() {
    let folder = folder();
    for (keys, count) in [
        ("", 8),
        ("suite_count = 5\n", 5),
        ("suite_count = 5\nsuite_scale = \"one\"\n", 5),
    ] {
        let study = study(folder.path(), keys);
        let (motions, suite) = (motions(&study), study.ground.suite().unwrap());
        assert_eq!(
            (motions.len(), suite.members.len(), suite.usable),
            (count, count, 8),
            "{keys}"
        );
        assert!(
            (suite.periods_s[0] - 0.2).abs() < 1e-12 && (suite.periods_s[29] - 3.0).abs() < 1e-12
        );
        assert_eq!(
            (study.ground.target(), study.ground.code_spectrum()),
            (None, Some(&suite.target))
        );
        let mut ln_ratios: Vec<Vec<f64>> = Vec::new();
        for (motion, (name, factor)) in motions.iter().zip(&suite.members) {
            assert_eq!((&motion.name, motion.scale_ratio), (name, *factor));
            assert!(
                (0.25..=4.0).contains(factor)
                    && motion
                        .processing
                        .last()
                        .unwrap()
                        .starts_with("multiplied by")
            );
            let across = &motion.across.as_ref().unwrap().motion;
            for component in [&motion.motion, across] {
                let spectrum = response_spectrum(component, 0.05, &suite.periods_s).unwrap();
                let target = suite
                    .periods_s
                    .iter()
                    .map(|&t| suite.target.spectrum.sa_g(t) * freestand::G0_M_S2);
                ln_ratios.push(
                    spectrum
                        .psa_m_s2
                        .iter()
                        .zip(target)
                        .map(|(a, b)| (a / b).ln())
                        .collect(),
                );
            }
        }
        for i in 0..30 {
            let at: Vec<f64> = ln_ratios.iter().map(|one| one[i]).collect();
            let mean = at.iter().sum::<f64>() / at.len() as f64;
            let sd =
                (at.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (at.len() - 1) as f64).sqrt();
            // Spectra of scaled motions against scaled spectra: a few roundings, and the root of a
            // difference of sums of squares.
            assert!(
                (mean - suite.mean_ln_ratio[i]).abs() < 1e-12 && (sd - suite.sd_ln[i]).abs() < 1e-9,
                "{keys} {i}"
            );
        }
        let factors: Vec<f64> = suite.members.iter().map(|(_, factor)| *factor).collect();
        assert_eq!(
            suite.scale == SuiteScale::One,
            factors.iter().all(|factor| *factor == factors[0]),
            "{factors:?}"
        );
    }
}

#[test]
fn components_are_paired_and_other_files_are_named() {
    let folder = folder();
    let study = study(folder.path(), "");
    let names: Vec<&str> = motions(&study)
        .iter()
        .map(|motion| motion.name.as_str())
        .collect();
    let expected = [
        "RSN2_PLACE_STA090",
        "RSN3_PLACE_STA090",
        "both0",
        "both1",
        "p41_1",
        "p51_1",
        "p61_1",
        "p71_1",
    ];
    assert_eq!(names, expected);
    for (i, at) in [
        (2, 0),
        (3, 1),
        (0, 2),
        (1, 3),
        (4, 4),
        (5, 5),
        (6, 6),
        (7, 7),
    ] {
        let (motion, [x, y]) = (&motions(&study)[at], pair(i));
        let peaks =
            [&motion.motion, &motion.across.as_ref().unwrap().motion].map(Motion::peak_m_s2);
        for (peak, original) in peaks.into_iter().zip([&x, &y]) {
            // AT2 files have seven digits.
            assert!(
                (peak / (original.peak_m_s2() * motion.scale_ratio) - 1.0).abs() < 1e-6,
                "{}",
                motion.name
            );
        }
    }
    let suite = study.ground.suite().unwrap();
    let others = [
        "CI.CLC.xml",
        "README.md",
        "RSN2.VT2",
        "RSN2_PLACE_STA-UP.AT2",
        "RSN3_PLACE_STA-UP.AT2",
        "index.json",
        "more",
        "readme.txt",
    ];
    assert_eq!(suite.skipped, others);
    let left_out: Vec<&str> = suite.left_out.iter().map(|one| one.file.as_str()).collect();
    assert_eq!(left_out, ["broken.csv", "copy of both0.csv"]);
    assert_eq!(suite.left_out[1].reason, "is the same as both0.csv");
    let warnings = study_doubts(&study.doubts);
    let warning = warnings
        .iter()
        .find(|one| one.contains("broken.csv"))
        .unwrap();
    assert!(
        warning.starts_with("suite: 2 files are left out: broken.csv: ")
            && warning.contains("what"),
        "{warning}"
    );
    // Every file that was used can be fingerprinted and protected.
    assert_eq!(motion_paths(&study).len(), 8 + 6);
    assert_eq!(provenance(&study).inputs.len(), 8 + 6);
    assert_eq!(provenance(&study).seed, None);
}

#[test]
fn one_component_of_each_file_where_that_is_asked_for() {
    let folder = folder();
    for name in ["broken.csv", "both0.csv", "copy of both0.csv"] {
        std::fs::remove_file(folder.path().join("records").join(name)).unwrap();
    }
    let one = study(folder.path(), "component = 1\n");
    // Each file of six pairs, and the first component of the other.
    assert_eq!(motions(&one).len(), 2 * 6 + 1);
    assert!(
        motions(&one).iter().all(|motion| motion.across.is_none()) && one.directions_deg == [0.0]
    );
    // Of two kinds the fewer are left out, and said.
    std::fs::remove_file(folder.path().join("records/p41_2.csv")).unwrap();
    let two = study(folder.path(), "");
    assert_eq!((motions(&two).len(), two.directions_deg.len()), (6, 12));
    let reason = "has one horizontal component, but 6 other records have two; component = 1 uses one of each file";
    let expected = StudyDoubt::Suite(SuiteDoubt::LeftOut(vec![LeftOut {
        file: "p41_1.csv".to_owned(),
        reason: reason.to_owned(),
    }]));
    assert!(two.doubts.contains(&expected), "{:?}", two.doubts);
    for i in 4..8 {
        let _ = std::fs::remove_file(folder.path().join(format!("records/p{i}1_2.csv")));
    }
    let mostly_one = study(folder.path(), "");
    assert_eq!(
        (motions(&mostly_one).len(), mostly_one.directions_deg.len()),
        (4, 1)
    );
    assert_eq!(
        motions(&study(folder.path(), "components = \"both\"\n")).len(),
        3
    );
}

/// `unit` and `dt` are for files that state none.
#[test]
fn files_that_state_their_unit_and_step_need_no_other() {
    let folder = folder();
    let values: Vec<String> = record(0.3, 0.1)
        .accel_m_s2()
        .iter()
        .map(f64::to_string)
        .collect();
    std::fs::write(folder.path().join("records/bare.txt"), values.join("\n")).unwrap();
    let bare = |keys: &str| motions(&study(folder.path(), &format!("component = 1\n{keys}"))).len();
    assert_eq!(bare("unit = \"g\"\ndt = \"0.01 s\"\n"), bare("") + 1);
}

#[test]
fn a_suite_that_cannot_be_meant_is_refused_at_its_line() {
    let folder = folder();
    let with = |keys: &str| refused(folder.path(), &format!("suite = \"records\"\n{CODE}{keys}"));
    for (keys, expected) in [
        (
            "motions = \"a.csv\"\n",
            "s.toml:7: motions and suite exclude each other: the records come from the folder",
        ),
        (
            "match = \"fft\"\n",
            "s.toml:7: match and suite exclude each other: the records are scaled and not matched",
        ),
        (
            "point_source = { magnitude = 6, distance_km = 30 }\n",
            "s.toml:7: point_source and suite exclude each other: the records replace it",
        ),
        (
            "count = 3\n",
            "s.toml:7: count and suite exclude each other: a suite has its own number",
        ),
        (
            "seed = 3\n",
            "s.toml:7: seed and suite exclude each other: a record has no random numbers",
        ),
        (
            "scale = 3\n",
            "s.toml:7: scale and suite exclude each other: the target sets the amplitudes",
        ),
        (
            "processing = { scale_to = \"1 g\" }\n",
            "s.toml:7: scale_to and suite exclude each other: the target sets the amplitudes",
        ),
        (
            "across = \"a.csv\"\n",
            "s.toml:7: across and suite exclude each other: two components of one record are found by their names",
        ),
        (
            "component = 1\ncomponents = \"both\"\n",
            "s.toml:8: component and components exclude each other",
        ),
        (
            "suite_count = 1\n",
            "s.toml:7: suite_count must be a whole number from 2 to 1000, not 1",
        ),
        (
            "suite_scale = \"all\"\n",
            "s.toml:7: suite_scale \"all\" is not known",
        ),
    ] {
        assert_eq!(with(keys), [expected], "{keys}");
    }
    let many = with("suite_count = 9\n");
    assert!(
        many.len() == 1
            && many[0].starts_with(
                "s.toml:7: suite_count asks for 9 records, but 8 records of records can be used (broken.csv: "
            ),
        "{many:?}"
    );
    for (ground, expected) in [
        (
            "suite = \"records\"\n",
            "s.toml:2: suite needs a code spectrum",
        ),
        ("suite_count = 3\n", "s.toml:2: suite_count needs suite"),
        (
            "suite_scale = \"one\"\n",
            "s.toml:2: suite_scale needs suite",
        ),
        (
            "suite = \"records\"\nsite = \"X\"\n",
            "s.toml:3: site \"X\" is not a class of AS 1170.4",
        ),
    ] {
        assert_eq!(refused(folder.path(), ground), [expected], "{ground}");
    }
    let on_floors = "suite = \"records\"\n[building]\nlevels = [{ name = \"roof\", motions = [\"records/both0.csv\"] }]\n";
    let said = refused(folder.path(), on_floors);
    assert!(
        said.iter()
            .any(|one| one
                == "s.toml:2: suite has no effect: the study gives the motions of its floors"),
        "{said:?}"
    );
    // A table that ends before the periods of the suite.
    std::fs::write(folder.path().join("t.csv"), "T [s],PSA [g]\n0,0.3\n2,0.1\n").unwrap();
    let short = refused(
        folder.path(),
        "suite = \"records\"\nspectrum = \"t.csv\"\n[building]\nlevels = [0]\n",
    );
    assert!(
        short.len() == 1
            && short[0].contains("covers 0 s to 2 s, but records are selected from 0.2 s to 3 s"),
        "{short:?}"
    );
}

#[test]
fn a_folder_without_usable_records_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let refused = || refused(folder.path(), &format!("suite = \"records\"\n{CODE}"));
    let only = |start: &str, end: &str| {
        let said = refused();
        assert!(
            said.len() == 1 && said[0].starts_with(start) && said[0].contains(end),
            "{said:?}"
        );
    };
    only("s.toml:2: suite: ", "records: does not exist");
    let records = folder.path().join("records");
    std::fs::write(&records, "a file").unwrap();
    only("s.toml:2: suite: ", "records: cannot be read as a folder");
    std::fs::remove_file(&records).unwrap();
    std::fs::create_dir(&records).unwrap();
    only(
        "s.toml:2: no record of the folder records can be used",
        "(it has no files)",
    );
    for i in 0..7 {
        std::fs::write(
            records.join(format!("b{i}.csv")),
            "time [s],a [g]\n0,0\n0.01,what\n",
        )
        .unwrap();
    }
    std::fs::write(records.join("s.xml"), "").unwrap();
    only(
        "s.toml:2: no record of the folder records can be used (b0.csv: ",
        "and 2 more; not records of horizontal motion: s.xml)",
    );
    std::fs::write(records.join("one.csv"), write_csv(&record(0.0, 1.0))).unwrap();
    only(
        "s.toml:2: a suite needs two records, but only one of records can be used",
        "b0.csv",
    );
    // 0.01 m/s² needs a factor above 4; zeros have no spectrum.
    std::fs::write(records.join("faint.csv"), write_csv(&record(0.1, 0.01))).unwrap();
    std::fs::write(records.join("zero.csv"), write_csv(&record(0.1, 0.0))).unwrap();
    (0..7).for_each(|i| std::fs::remove_file(records.join(format!("b{i}.csv"))).unwrap());
    only(
        "s.toml:2: a suite needs two records",
        "faint.csv: it needs a factor of ",
    );
    only(
        "s.toml:2: a suite needs two records",
        "zero.csv: it has no content at some of the periods",
    );
    // Nothing is said of a folder whose files are all used.
    for name in ["faint.csv", "zero.csv", "s.xml"] {
        std::fs::remove_file(records.join(name)).unwrap();
    }
    only(
        "s.toml:2: a suite needs two records, but only one of records can be used",
        "can be used",
    );
    assert!(!refused()[0].contains("it has no files"), "{:?}", refused());
    std::fs::write(records.join("two.csv"), write_csv(&record(0.1, 1.0))).unwrap();
    assert_eq!(refused(), [] as [String; 0]);
}

#[test]
fn the_periods_are_those_of_the_building_above_the_ground() {
    let folder = folder();
    let range = |building: &str| {
        let text = format!("[ground]\nsuite = \"records\"\n{CODE}[building]\n{building}");
        let study = resolve(&text, None, folder.path()).unwrap();
        let periods_s = &study.ground.suite().unwrap().periods_s;
        let period_s = study.building.as_ref().unwrap().along.period_s();
        (
            periods_s[0] / period_s,
            periods_s[29] / period_s,
            study.ground.suite().unwrap().periods_from.clone(),
        )
    };
    let (from, to, words) = range("period = \"1 s\"\n");
    assert!((from - 0.2).abs() < 1e-12 && (to - 2.0).abs() < 1e-12);
    assert_eq!(words, "0.2 and 2 times the building's period of 1 s");
    let (from, to, words) = range("period = \"1 s\"\nacross = { period = \"0.8 s\" }\n");
    assert!((from - 0.16).abs() < 1e-12 && (to - 2.0).abs() < 1e-12);
    assert_eq!(
        words,
        "0.2 times the building's period of 0.8 s, 2 times that of 1 s"
    );
    assert_eq!(
        range("period = \"1 s\"\nlevels = [0]\n").2,
        "no floor above the ground"
    );
}

#[test]
fn neither_seed_nor_threads_change_a_suite_and_the_command_line_replaces_it() {
    let folder = folder();
    let text = text("suite_count = 4\n");
    let with = |overrides: &Overrides| resolve_with(&text, None, folder.path(), overrides).unwrap();
    let one = with(&Overrides::default());
    assert_eq!(
        with(&Overrides {
            seed: Some(9),
            ..Overrides::default()
        }),
        one
    );
    let single = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    assert_eq!(single.install(|| with(&Overrides::default())), one);
    let variations: Vec<_> = ["seed", "site", "scale = 2"]
        .iter()
        .map(|text| parse_variation(text).unwrap())
        .collect();
    let (list, left_out) = changes(&one, &variations, &Overrides::default());
    let not_varied = |key, why| NotVaried { key, why };
    let sites: Vec<&str> = list.iter().map(|change| change.value.as_str()).collect();
    assert_eq!(sites, ["A", "B", "D", "E"]);
    assert_eq!(
        left_out,
        [
            not_varied("seed", WhyNotVaried::SuiteSeed),
            not_varied("scale", WhyNotVaried::SuiteScale)
        ]
    );
}

/// The study that a run writes needs neither the folder nor the selection.
#[test]
#[ignore = "seconds: a study, twice"]
fn a_run_writes_what_was_selected_and_runs_again_from_its_output() {
    let folder = folder();
    let objects =
        "[objects]\nheights = \"1.5 m\"\nthicknesses = \"300 mm\"\n[outputs]\nfigures = false\n";
    let text = text("suite_count = 4\nrotation_step = \"90 deg\"\n") + objects;
    let study = resolve(&text, None, folder.path()).unwrap();
    let result = run(&study, &no_progress).unwrap();
    let out = folder.path().join("out");
    let stage =
        freestand_output::folder::OutputFolder::stage(&out, false, &motion_paths(&study)).unwrap();
    write_outputs(stage, &study, &result).unwrap();
    let summary = std::fs::read(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&summary).unwrap();
    let suite = &summary["inputs"]["suite"];
    let records = suite["records"].as_array().unwrap();
    assert_eq!(
        (records.len(), &suite["count"], &suite["usable"]),
        (4, &4.into(), &8.into())
    );
    assert_eq!(records[0]["motion"], motions(&study)[0].name.as_str());
    assert_eq!(suite["mean_ln_ratio"].as_array().unwrap().len(), 30);
    assert_eq!(suite["left_out"][0]["file"], "broken.csv");
    let report = std::fs::read_to_string(out.join("report.html")).unwrap();
    for words in [
        "4 of 8 usable records",
        "selected for a spectrum",
        "broken.csv",
        "index.json",
        "Standard deviation of ln Sa",
    ] {
        assert!(report.contains(words), "{words}");
    }
    let said: Vec<String> = Check(&study)
        .facts()
        .lines()
        .into_iter()
        .map(|(label, text)| format!("{label}: {text}"))
        .collect();
    for start in [
        "ground: 4 recorded motions, a suite for ",
        "suite: 4 of 8 usable records, each",
        "left out: 2 files: broken.csv",
    ] {
        assert!(
            said.iter().any(|line| line.starts_with(start)),
            "{start} {said:#?}"
        );
    }
    let again = std::fs::read_to_string(out.join("study.toml")).unwrap();
    let again = resolve(&again, None, &out).unwrap();
    for (one, other) in motions(&study).iter().zip(motions(&again)) {
        assert_eq!(
            (&one.motion, one.as_used()),
            (&other.motion, other.as_used())
        );
    }
}

/// The far-field records of FEMA P-695 belong to others and are not shipped.
#[test]
#[ignore = "seconds: 44 records"]
fn the_far_field_records_of_p695_are_a_suite() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let shared = std::env::var_os("FREESTAND_SHARED")
        .map_or_else(|| workspace.join("../shared"), Into::into);
    let folder = shared.join("records");
    if !folder.join("p695/index.json").is_file() {
        println!(
            "skipped: the records of FEMA P-695 are not in $FREESTAND_SHARED/records/p695 (../shared)"
        );
        return;
    }
    let suite = |keys: &str, building: &str| {
        let text = format!(
            "[ground]\nsuite = \"p695\"\nunit = \"g\"\n{CODE}{keys}[building]\n{building}\n"
        );
        resolve(&text, None, &folder).unwrap_or_else(|error| panic!("{error}"))
    };
    for scale in ["each", "one"] {
        for (count, building) in [
            ("", "levels = [0]"),
            ("suite_count = 11\n", "levels = [0]"),
            ("", "period = \"0.65 s\""),
        ] {
            let study = suite(&format!("{count}suite_scale = \"{scale}\"\n"), building);
            let suite = study.ground.suite().unwrap();
            let (mean, dispersion) = (suite.mean_off(), suite.dispersion());
            println!("{scale}: {:?} {mean:?} {dispersion:?}", suite.members);
            assert_eq!((suite.usable, suite.left_out.len()), (22, 0));
            assert_eq!(suite.skipped, ["README.md", "index.json"]);
            assert!(motions(&study).iter().all(|motion| motion.across.is_some()));
            // As the core measures them: where there is a choice, the mean and the dispersion are met.
            let is_met = mean.rms < 0.06 && (dispersion.rms - dispersion.asked).abs() < 0.015;
            assert_eq!(is_met, suite.members.len() < 22, "{mean:?} {dispersion:?}");
            let is_of_suite = |doubt: &StudyDoubt| matches!(doubt, StudyDoubt::Suite(_));
            assert_eq!(
                study.doubts.iter().any(is_of_suite),
                suite.members.len() == 22,
                "{:?}",
                study.doubts
            );
        }
    }
    let singles = suite("component = 1\n", "levels = [0]");
    println!("{:?}", singles.ground.suite().unwrap().members);
    assert_eq!(motions(&singles).len(), 44);
}

/// Where a national annex has two spectra, motions of any source are made for both: synthetic ones, records
/// that are matched, and records that are selected. The first is that with the larger velocity; a type that
/// is named stands alone.
#[test]
fn every_source_serves_both_spectra_of_a_national_annex() {
    let folder = folder();
    for (source, lines) in [
        ("synthetic", "count = 1\n"),
        (
            "matched",
            "motions = [\"records/both1.csv\"]\ncomponent = 1\nmatch = \"fft\"\n",
        ),
        ("selected", "suite = \"records\"\n"),
    ] {
        let of = |kind: &str| {
            let text =
                format!("[ground]\nplace = \"Lisbon\"\n{kind}{lines}[building]\nstoreys = 2\n");
            resolve(&text, Some(Path::new("s.toml")), folder.path())
                .unwrap_or_else(|error| panic!("{source}: {error}"))
        };
        let spectrum = |study: &Study| study.ground.code_spectrum().unwrap().spectrum.clone();
        let both = of("");
        let other = both
            .alternative()
            .unwrap_or_else(|| panic!("{source} has one spectrum"));
        let [one, two] = ["spectrum_type = 1\n", "spectrum_type = 2\n"].map(of);
        assert_eq!(
            (spectrum(&both), spectrum(&other)),
            (spectrum(&one), spectrum(&two)),
            "{source}"
        );
        assert!(
            one.alternative().is_none() && other.alternative().is_none(),
            "{source}"
        );
        // The motions themselves are those of the study that names the type.
        if let (Ground::Recorded(found), Ground::Recorded(named)) = (&other.ground, &two.ground) {
            let same = |(a, b): (&RecordedMotion, &RecordedMotion)| a.motion == b.motion;
            assert!(
                found.len() == named.len() && found.iter().zip(named).all(same),
                "{source}"
            );
        }
        // A restraint is designed for the larger acceleration of the ground, whichever spectrum decides.
        let design = |study: &Study| study.restraint_target().unwrap().parts_spectrum().clone();
        assert_eq!(design(&both), design(&other), "{source}");
        // Only who asks both says so.
        assert!(
            two_spectra(&both).is_some() && two_spectra(&one).is_none(),
            "{source}"
        );
        assert!(
            !assumed_at(&both, 0.0, UnitSystem::Si).any(|said| said.contains("both spectra")),
            "{source}"
        );
        // What is noted of records is noted once, though each is read for either spectrum.
        let lacking: Vec<&StudyDoubt> = one
            .doubts
            .iter()
            .filter(|doubt| !both.doubts.contains(doubt))
            .collect();
        assert!(
            lacking.is_empty(),
            "{source}: {lacking:?} {:?}",
            both.doubts
        );
    }
}
