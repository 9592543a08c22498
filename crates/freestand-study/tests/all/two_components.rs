//! Motions with two horizontal components, and given motions of floors, through a whole study.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at an error"
)]

use std::path::Path;

use freestand::motion::Motion;
use freestand_records::formats::{write_csv, write_pair_csv};
use freestand_report::study::tables::srs_table;
use freestand_study::resolve::resolve;
use freestand_study::result::{ObjectResponse, StudyResult};
use freestand_study::run::{no_progress, run};

const OBJECTS: &str =
    "[objects]\nheights = \"1 m, 1.5 m, 2 m\"\nthicknesses = \"300 mm, 500 mm\"\n";

/// A swing of 12 s with a period of 1.2 s that grows and decays; peak near 3.5 m/s².
fn swing(factor: f64) -> Motion {
    let sample = |i: u32| {
        let t = f64::from(i) * 0.01;
        factor
            * 3.5
            * (std::f64::consts::TAU * t / 1.2).sin()
            * (std::f64::consts::PI * t / 12.0).sin()
    };
    Motion::new(0.01, (0..=1200).map(sample).collect()).unwrap()
}

fn result_of(folder: &Path, text: &str) -> (StudyResult, Vec<u8>) {
    let study = resolve(text, None, folder).unwrap();
    let result = run(&study, &no_progress).unwrap();
    let table = srs_table(&study, &result).unwrap();
    (result, table.into())
}

/// Rotation, and the direction that governs, of every object on the first level under the first motion.
fn responses(result: &StudyResult) -> Vec<(f64, Option<f64>)> {
    let row = &result.levels[0].responses[0];
    row.iter()
        .map(|response| match response {
            ObjectResponse::Done {
                uplift,
                direction_deg,
                ..
            } => (uplift.rocking.peak_rotation_rad, *direction_deg),
            ObjectResponse::FreeFlight(reason) | ObjectResponse::Failed(reason) => {
                panic!("{reason}")
            }
        })
        .collect()
}

fn study(keys: &str) -> String {
    format!("[ground]\n{keys}\n[building]\nlevels = [0.0]\n{OBJECTS}")
}

/// Nothing across: the first direction is the motion itself, every other one is less of it.
#[test]
fn a_component_of_zeros_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("one.csv"), write_csv(&swing(1.0))).unwrap();
    std::fs::write(
        folder.path().join("two.csv"),
        write_pair_csv(&swing(1.0), &swing(0.0)),
    )
    .unwrap();
    let one = responses(&result_of(folder.path(), &study("motions = [\"one.csv\"]")).0);
    let two = responses(
        &result_of(
            folder.path(),
            &study("motions = [\"two.csv\"]\ncomponents = \"both\""),
        )
        .0,
    );
    assert!(one.iter().any(|(rotation, _)| *rotation > 0.0));
    for ((alone, none), (rotation, direction_deg)) in one.iter().zip(&two) {
        assert_eq!((alone, *none, *direction_deg), (rotation, None, Some(0.0)));
    }
}

/// The same motion of 1/√2 along and across is the whole of it at 45 degrees, wherever the record stands.
#[test]
fn the_direction_of_the_shaking_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let part = swing(std::f64::consts::FRAC_1_SQRT_2);
    std::fs::write(folder.path().join("whole.csv"), write_csv(&swing(1.0))).unwrap();
    std::fs::write(folder.path().join("x.csv"), write_csv(&part)).unwrap();
    std::fs::write(folder.path().join("y.csv"), write_csv(&part)).unwrap();
    let whole = responses(&result_of(folder.path(), &study("motions = [\"whole.csv\"]")).0);
    let keys = "motions = [\"x.csv\"]\nacross = [\"y.csv\"]\nrotation_step = \"45 deg\"";
    let (result, _) = result_of(folder.path(), &study(keys));
    // The floor's peak is that of the vector, not of a component.
    let peak = result.levels[0].floors[0].peak_m_s2();
    assert!((peak - swing(1.0).peak_m_s2()).abs() < 1e-14 * peak);
    let mut rocking = 0;
    for ((alone, _), (rotation, direction_deg)) in whole.iter().zip(responses(&result)) {
        // cos 45° + sin 45° round once each; the rocking of these few cycles amplifies that by far less than 1e4.
        assert!(
            (alone - rotation).abs() <= 1e-11 * alone,
            "{alone} {rotation}"
        );
        // Of directions that are equal the first counts: for objects that do not uplift, and for those that overturn in
        // several.
        let rocks = *alone > 0.0 && *alone < std::f64::consts::FRAC_PI_2;
        rocking += usize::from(rocks);
        assert!(!rocks || direction_deg == Some(45.0), "{direction_deg:?}");
    }
    assert!(rocking > 0);
}

/// Floor motions that a study computed, given to another as they were written, give the same table.
#[test]
fn given_floor_motions_are_those_of_the_building() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("two.csv"),
        write_pair_csv(&swing(1.0), &swing(0.4)),
    )
    .unwrap();
    let keys = "motions = [\"two.csv\"]\ncomponents = \"both\"\nrotation_step = \"60 deg\"";
    let text = format!("[ground]\n{keys}\n[building]\nstoreys = 8\nlevels = [0.5, 1.0]\n{OBJECTS}");
    let (computed, table) = result_of(folder.path(), &text);
    for level in &computed.levels {
        let floor = &level.floors[0];
        let name = format!("{}.csv", level.level.name);
        std::fs::write(
            folder.path().join(name),
            write_pair_csv(&floor.along, floor.across.as_ref().unwrap()),
        )
        .unwrap();
    }
    let levels = "[{ name = \"level-0.5\", motions = [\"level-0.5.csv\"] }, { name = \"roof\", motions = [\"roof.csv\"] }]";
    let text = format!(
        "[ground]\ncomponents = \"both\"\nrotation_step = \"60 deg\"\n[building]\nlevels = {levels}\n{OBJECTS}"
    );
    let (given, again) = result_of(folder.path(), &text);
    assert!(given.ground.is_empty() && given.modes.is_empty());
    // The motion is named after its file; all else is the same to the bit.
    let (table, again) = (
        String::from_utf8(table).unwrap(),
        String::from_utf8(again).unwrap(),
    );
    assert_eq!(table.replace("two,", "level-0.5,"), again);
}

#[test]
fn what_does_not_go_together_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (name, amplitude) in [("a.csv", 1.0), ("b.csv", 0.9)] {
        std::fs::write(folder.path().join(name), write_csv(&swing(amplitude))).unwrap();
    }
    std::fs::write(
        folder.path().join("short.csv"),
        write_csv(&Motion::new(0.02, vec![0.0, 1.0, 0.0]).unwrap()),
    )
    .unwrap();
    for (keys, expected) in [
        (
            "motions = [\"a.csv\", \"b.csv\"]\nacross = [\"b.csv\"]",
            "across names 1 file, but motions names 2 files",
        ),
        (
            "motions = [\"a.csv\"]\ncomponents = \"both\"",
            "only one horizontal component",
        ),
        (
            "motions = [\"a.csv\"]\nacross = [\"b.csv\"]\ncomponents = \"both\"",
            "across and components exclude each other",
        ),
        (
            "motions = [\"a.csv\"]\nrotation_step = \"5 deg\"",
            "needs motions with two horizontal components",
        ),
        (
            "motions = [\"a.csv\"]\nacross = [\"b.csv\"]\nrotation_step = \"0.1 deg\"",
            "from 1 to 90 degrees",
        ),
        (
            "motions = [\"a.csv\"]\nacross = [\"short.csv\"]",
            "time step",
        ),
        ("across = [\"b.csv\"]", "across needs motions"),
    ] {
        let error = resolve(&study(keys), None, folder.path())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{keys}: {error}");
    }
    let levels = |second: &str| {
        format!(
            "[building]\nlevels = [{{ name = \"a\", motions = [\"a.csv\"] }}, {{ name = \"b\", {second} }}]\n{OBJECTS}"
        )
    };
    for (second, expected) in [
        (
            "level_ratio = 1.0",
            "this level has no motions, but others do",
        ),
        (
            "motions = [\"a.csv\", \"b.csv\"]",
            "level \"b\" has 2 motions, but level \"a\" has 1 motion",
        ),
        (
            "motions = [\"a.csv\"], across = [\"b.csv\"]",
            "some motions have a second component and others do not",
        ),
    ] {
        let error = resolve(&levels(second), None, folder.path())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{second}: {error}");
    }
}
