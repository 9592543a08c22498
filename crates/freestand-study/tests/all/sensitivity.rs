//! Sensitivities against those of histories that were solved to 160 bits (`validation/rocking`).

#![expect(clippy::unwrap_used, reason = "a test may stop at broken data")]

use std::path::Path;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::respond::{RigidPlane, Settings};
use freestand::rocking::{Base, Outcome, Restitution, Until};
use freestand::spectra::{
    PERTURBATION_RATIO, SENSITIVE_RATIO, Sensitivity, uplift_sensitivity, uplift_spectrum,
};
use freestand::wall::Walls;
use serde_json::Value;

/// The horizontal samples of a record in the repository, and its step.
fn record(name: &str) -> Option<(f64, Vec<f64>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/rocking/records");
    let text = std::fs::read_to_string(folder.join(format!("{name}.csv"))).ok()?;
    let step = text
        .split_whitespace()
        .find_map(|word| word.strip_prefix("dt="))
        .unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    Some((
        step.parse().unwrap(),
        rows.map(|row| row.split(',').next().unwrap().parse().unwrap())
            .collect(),
    ))
}

fn solve(case: &Value) -> Option<(Outcome, Sensitivity)> {
    let (dt_s, samples) = record(case["record"].as_str().unwrap())?;
    let number = |key: &str| case.get(key).and_then(Value::as_f64);
    let motion = Motion::new(
        dt_s,
        samples
            .iter()
            .map(|a| a * number("scale").unwrap())
            .collect(),
    )
    .unwrap();
    let restitution = number("r").map_or(Restitution::Housner, Restitution::Value);
    let settings = Settings {
        gravity_m_s2: number("g").unwrap_or(freestand::G0_M_S2),
        until: Until::EndOfMotion,
        ..Settings::default()
    };
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    let block = Block::uniform(number("h").unwrap(), number("t").unwrap()).unwrap();
    let objects = [RigidPlane::along_x(block, restitution, Walls::NONE)];
    let cells = uplift_spectrum(&objects, base, &settings);
    Some((
        cells[0].unwrap().rocking.outcome,
        uplift_sensitivity(&objects, &cells, base, &settings)[0],
    ))
}

/// The reference takes the larger change of two, for 1e-6 more and 1e-6 less of the motion, ours is that for more: where
/// the slope bends, they differ (by 2.7 % in the worst case here, by less than 0.1 % in nine of ten).
#[test]
fn amplifications_are_those_of_the_reference() {
    let cases: Value = serde_json::from_str(include_str!(
        "../../../../validation/rocking/rocking_cases.json"
    ))
    .unwrap();
    let mut differences = Vec::new();
    let mut sensitive = 0;
    for case in cases["cases"].as_array().unwrap() {
        if !["nonlinear", "user_r"].contains(&case["group"].as_str().unwrap()) {
            continue;
        }
        let Some((outcome, got)) = solve(case) else {
            continue;
        };
        // The reference looks at the rotation only, ours at the impacts and at what comes before a fall, too.
        let reference = case["sensitive"].as_bool().unwrap();
        assert!(got.sensitive || !reference, "{}: {got:?}", case["id"]);
        assert!(
            got.ratio
                .is_none_or(|ratio| (ratio > SENSITIVE_RATIO) == reference),
            "{}: {got:?}",
            case["id"]
        );
        assert_eq!(
            got.ratio.is_some(),
            matches!(outcome, Outcome::Rocked | Outcome::Unresolved),
            "{}: {got:?}",
            case["id"]
        );
        sensitive += usize::from(got.sensitive);
        let expected = case["check"]["rel_change_pert_1e6"].as_f64().unwrap() / PERTURBATION_RATIO;
        differences.extend(got.ratio.map(|ratio| (ratio / expected - 1.0).abs()));
    }
    assert!(
        differences.len() > 90 && sensitive > 40,
        "{} and {sensitive}",
        differences.len()
    );
    let within = |bound: f64| {
        differences
            .iter()
            .filter(|&&difference| difference < bound)
            .count()
    };
    assert_eq!(within(0.05), differences.len());
    assert!(
        within(1e-3) > differences.len() * 9 / 10,
        "{} of {}",
        within(1e-3),
        differences.len()
    );
}
