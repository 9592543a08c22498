//! Objects between walls: the scalar solver and the kernel for many blocks against histories that
//! were solved to 160 bits (`validation/walls`, and `object_cases.json` where it is at hand).

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may stop at broken data and says what it skips"
)]

use std::fs;
use std::path::Path;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{
    Accuracy, Base, Outcome, Restitution, Rocking, RockingOptions, RockingSummary, Until, rock,
    rock_many,
};
use freestand::wall::{DEFAULT_WALL_RESTITUTION_RATIO, Wall, Walls};
use serde_json::Value;

use crate::cases::{record, shared, workspace};

/// The number of a flag of a case, in SI.
fn flag(case: &Value, name: &str) -> Option<f64> {
    let args: Vec<&str> = case["args"]
        .as_array()
        .unwrap()
        .iter()
        .map(|arg| arg.as_str().unwrap())
        .collect();
    let name = format!("--{name}");
    let value = args
        .iter()
        .position(|arg| *arg == name)
        .map(|at| args[at + 1])
        .or_else(|| {
            // `--flag=-1 rad`
            args.iter()
                .find_map(|arg| arg.strip_prefix(&name)?.strip_prefix('='))
        })?;
    let number = value.split_whitespace().next().unwrap();
    Some(number.parse().unwrap())
}

/// What both solvers say of a case, first the scalar one; `None` without its record.
///
/// Of the kernel's cases those that are given a rotation or a velocity test that it hands them to
/// the scalar solver.
fn solve(case: &Value, accuracy: Accuracy) -> Option<(Rocking, RockingSummary)> {
    let has_motion = case["args"]
        .as_array()
        .unwrap()
        .iter()
        .any(|arg| arg == "--motion");
    let motion = |column: usize, scale: &str| {
        let (dt_s, columns) = record(case["record"].as_str()?)?;
        let factor = flag(case, scale).unwrap_or(1.0);
        Some(Motion::new(dt_s, columns[column].iter().map(|a| a * factor).collect()).unwrap())
    };
    let horizontal = if has_motion {
        Some(motion(0, "scale")?)
    } else {
        None
    };
    let vertical = if flag(case, "vertical-scale").is_some() {
        Some(motion(1, "vertical-scale")?)
    } else {
        None
    };
    let wall = |gap_m: f64| Wall {
        gap_m,
        height_m: flag(case, "wall-height"),
        restitution_ratio: flag(case, "wall-restitution").unwrap_or(DEFAULT_WALL_RESTITUTION_RATIO),
    };
    let options = RockingOptions {
        restitution: flag(case, "restitution").map_or(Restitution::Housner, Restitution::Value),
        accuracy,
        initial_rotation_rad: flag(case, "initial-rotation").unwrap_or(0.0),
        initial_omega_rad_s: flag(case, "initial-velocity").unwrap_or(0.0),
        until: flag(case, "duration").map_or(Until::EndOfMotion, Until::Time),
        walls: Walls {
            left: flag(case, "wall-gap-left").map(wall),
            right: flag(case, "wall-gap-right").map(wall),
        },
        ..RockingOptions::default()
    };
    let block = Block::uniform(
        flag(case, "height").unwrap(),
        flag(case, "thickness").unwrap(),
    )
    .unwrap();
    let base = Base {
        horizontal: horizontal.as_ref(),
        vertical: vertical.as_ref(),
    };
    let kernel = rock_many(&[block], base, &options).remove(0).unwrap();
    Some((rock(&block, base, &options).unwrap(), kernel))
}

/// Collects what differs from a case, with the largest errors.
struct Check<'a> {
    expect: &'a Value,
    amplification: f64,
    time_amplification: f64,
    /// Allowed relative error of rotations and velocities, and error of times \[s\], at an
    /// amplification of 1.
    bound: f64,
    failures: Vec<String>,
    worst: f64,
    worst_s: f64,
}

impl Check<'_> {
    fn number(&mut self, what: &str, got: f64, expected: f64, scale: f64) {
        let error =
            (got - expected).abs() / scale.max(f64::MIN_POSITIVE) / self.amplification.max(1.0);
        self.worst = self.worst.max(error);
        if error.is_nan() || error > self.bound {
            self.failures
                .push(format!("{what} {got} instead of {expected}, {error:.1e}"));
        }
    }

    fn time(&mut self, what: &str, got: Option<f64>, expected: &Value, times: f64) {
        match (got, expected.as_f64()) {
            (None, None) => {}
            (Some(got), Some(expected)) => {
                let error = (got - expected).abs() / self.time_amplification.max(1.0) / times;
                self.worst_s = self.worst_s.max(error);
                if error.is_nan() || error > self.bound {
                    self.failures.push(format!(
                        "{what} at {got} s instead of {expected} s, {error:.1e}"
                    ));
                }
            }
            _ => self
                .failures
                .push(format!("{what} at {got:?} instead of {expected}")),
        }
    }

    /// Of the first ten impacts those with a speed of 1e-2 rad/s or more before them.
    fn impacts(&mut self, key: &str, got: impl Iterator<Item = (f64, f64, f64)>, fastest: f64) {
        let got: Vec<_> = got
            .take(10)
            .filter(|(_, before, _)| before.abs() >= 1e-2)
            .collect();
        let expected = self.expect[key].as_array().unwrap().clone();
        if got.len() != expected.len() {
            self.failures
                .push(format!("{} {key} instead of {}", got.len(), expected.len()));
            return;
        }
        for ((time_s, before, after), expected) in got.into_iter().zip(&expected) {
            self.time(key, Some(time_s), &expected["time_s"], 1.0);
            self.number(
                key,
                before,
                expected["omega_before_rad_s"].as_f64().unwrap(),
                fastest,
            );
            self.number(
                key,
                after,
                expected["omega_after_rad_s"].as_f64().unwrap(),
                fastest,
            );
        }
    }
}

fn compare<'a>(
    case: &'a Value,
    scalar: &Rocking,
    kernel: &RockingSummary,
    bound: f64,
) -> Check<'a> {
    let number = |key: &str| case[key].as_f64().unwrap_or(1.0);
    let mut check = Check {
        expect: &case["expect"],
        amplification: number("amplification"),
        time_amplification: number("time_amplification"),
        bound,
        failures: Vec::new(),
        worst: 0.0,
        worst_s: 0.0,
    };
    let expect = check.expect;
    let expected = |key: &str| expect[key].as_f64().unwrap();
    for (who, outcome) in [("scalar", scalar.outcome), ("kernel", kernel.outcome)] {
        // The cases end with their records, where the block is at rest or not.
        let is_moving = expect["outcome"] == "rocked" && expect["final_rotation_rad"] != 0.0;
        let known = if is_moving {
            Some(Outcome::Unresolved.name())
        } else {
            expect["outcome"].as_str()
        };
        if known != Some(outcome.name()) {
            check.failures.push(format!(
                "{who}: {} instead of {}",
                outcome.name(),
                expect["outcome"]
            ));
        }
    }
    let peak = expected("peak_rotation_rad");
    check.number("scalar peak", scalar.peak_rotation_rad, peak, peak);
    check.number("kernel peak", kernel.peak_rotation_rad, peak, peak);
    check.number(
        "rotation at the end",
        scalar.final_rotation_rad,
        expected("final_rotation_rad"),
        peak,
    );
    // A rotation is flat about its extreme: an error of 1e-8 of the peak moves it by 1e-4 of a
    // period, and what is left of double precision by 1e-8 of it.
    // Some cases leave the time out where a block starts with a velocity from θ = 0.
    if !expect["peak_rotation_time_s"].is_null() || flag(case, "initial-velocity").is_none() {
        check.time(
            "peak",
            scalar.peak_rotation_time_s,
            &expect["peak_rotation_time_s"],
            100.0,
        );
    }
    check.time(
        "overturns",
        scalar.overturn_time_s,
        &expect["overturn_time_s"],
        1.0,
    );
    check.time(
        "passes α",
        scalar.passed_alpha_time_s,
        &expect["passed_alpha_time_s"],
        1.0,
    );
    if !expect["first_uplift_time_s"].is_null() || expect.get("first_uplift_time_s").is_some() {
        check.time(
            "first uplift",
            scalar.first_uplift_time_s,
            &expect["first_uplift_time_s"],
            1.0,
        );
    }
    for (contact, key) in scalar
        .contacts
        .iter()
        .zip(["wall_angle_right_rad", "wall_angle_left_rad"])
    {
        match (contact, expect[key].as_f64()) {
            (None, None) => {}
            // A few roundings.
            (Some(contact), Some(angle))
                if (contact.angle_rad - angle).abs() <= 1e-15 * angle.max(1e-3) => {}
            (contact, angle) => check
                .failures
                .push(format!("{key}: {contact:?} instead of {angle:?}")),
        }
    }
    let fastest = |key: &str| {
        let speeds = expect[key].as_array().unwrap().iter();
        speeds
            .map(|impact| impact["omega_before_rad_s"].as_f64().unwrap().abs())
            .fold(1e-2, f64::max)
    };
    let impacts = scalar
        .impacts
        .iter()
        .map(|i| (i.time_s, i.omega_before_rad_s, i.omega_after_rad_s));
    check.impacts("impacts", impacts, fastest("impacts"));
    let impacts = scalar
        .wall_impacts
        .iter()
        .map(|i| (i.time_s, i.omega_before_rad_s, i.omega_after_rad_s));
    check.impacts("wall_impacts", impacts, fastest("wall_impacts"));
    if case["counts_change"] != true {
        let counts = [
            (
                "impacts_over",
                scalar
                    .impacts
                    .iter()
                    .map(|i| i.omega_before_rad_s.abs())
                    .collect::<Vec<_>>(),
            ),
            (
                "wall_impacts_over",
                scalar
                    .wall_impacts
                    .iter()
                    .map(|i| i.omega_before_rad_s.abs())
                    .collect(),
            ),
        ];
        for (key, speeds) in counts {
            for (threshold, count) in expect[key].as_object().unwrap() {
                let threshold: f64 = threshold.parse().unwrap();
                let counted = speeds.iter().filter(|&&speed| speed >= threshold).count() as u64;
                if Some(counted) != count.as_u64() {
                    check
                        .failures
                        .push(format!("{key} {threshold}: {counted} instead of {count}"));
                }
            }
        }
    }
    check
}

/// Holds both solvers to the cases of a file; the number of cases that were compared.
fn check(path: &Path, accuracy: Accuracy, bound: f64) -> usize {
    let Ok(text) = fs::read_to_string(path) else {
        println!(
            "skipped: {} is not there ($FREESTAND_SHARED)",
            path.display()
        );
        return 0;
    };
    let cases: Value = serde_json::from_str(&text).unwrap();
    let (mut done, mut sensitive, mut skipped) = (0, 0, 0);
    let (mut worst, mut worst_s) = (0.0_f64, 0.0_f64);
    let mut failures = Vec::new();
    for case in cases["cases"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|case| case["kind"] == "wall")
    {
        let Some((scalar, kernel)) = solve(case, accuracy) else {
            skipped += 1;
            continue;
        };
        if case["sensitive"] == true {
            sensitive += 1;
            continue;
        }
        done += 1;
        let check = compare(case, &scalar, &kernel, bound);
        (worst, worst_s) = (worst.max(check.worst), worst_s.max(check.worst_s));
        let all = check.failures.into_iter();
        failures
            .extend(all.map(|failure| format!("{} ({}): {failure}", case["id"], case["group"])));
    }
    println!(
        "{}: {done} cases, {sensitive} sensitive ones left out, {skipped} skipped without their record; errors {worst:.1e} \
         relative, {worst_s:.1e} s",
        path.display()
    );
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    done
}

#[test]
fn the_shared_cases_at_every_level() {
    let path = shared().join("cases/object_cases.json");
    for (accuracy, bound) in [(Accuracy::Standard, 1e-8), (Accuracy::Tight, 1e-9)] {
        check(&path, accuracy, bound);
    }
}

#[test]
fn the_cases_of_the_repository_at_every_level() {
    let path = workspace().join("validation/walls/wall_cases.json");
    for (accuracy, bound) in [(Accuracy::Standard, 1e-8), (Accuracy::Tight, 1e-9)] {
        assert!(check(&path, accuracy, bound) >= 60);
    }
}
