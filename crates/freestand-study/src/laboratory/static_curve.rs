//! Static tests of a cushion: request → report.

use std::path::{Path, PathBuf};

use freestand::identify::{StaticError, StaticOptions, StaticTest, Toe, static_test};

use super::{Impactor, check_sensors};
use crate::recorded::Failed;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::Dimension;
use freestand_input::words::significant;
use freestand_output::answer_of;
use freestand_output::rows::table_of_numbers;
use freestand_output::table::Table;
use freestand_records::formats::Sensitivity;
use freestand_records::tables::laboratory::load_static;

/// A warning needs a toe below zero by this many standard errors at least.
const NOISE_ERRORS: f64 = 3.0;
/// A warning needs a toe below zero by this share of the largest compression at least.
const NEGATIVE_TOE_SHARE: f64 = 0.005;

/// A request to evaluate static tests: values for all files.
#[derive(Debug, Clone, Default)]
pub struct StaticRequest {
    /// The files.
    pub files: Vec<PathBuf>,
    /// Working load \[N\].
    pub load_n: Option<f64>,
    /// Stiffness of the machine \[N/m\].
    pub machine_stiffness_n_m: Option<f64>,
    /// What is removed from the beginning of the curve; `None`: its slack, or nothing if the impactor is a
    /// sphere.
    pub toe: Option<Toe>,
    /// Whether the signs of force and displacement are reversed: tension is written as positive.
    pub inverted: bool,
    /// Flat or sphere; overrides the file.
    pub impactor: Option<String>,
    /// Glued, unglued or lubricated; overrides the file.
    pub boundary: Option<String>,
    /// Of the sensors whose columns are in volts.
    pub sensitivities: Vec<Sensitivity>,
    /// A dynamic stiffness to compare with the static one \[N/m\].
    pub dynamic_stiffness_n_m: Option<f64>,
}

/// One test.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticReport {
    /// The file.
    pub path: String,
    toe: Toe,
    dynamic_stiffness_n_m: Option<f64>,
    impactor: Option<String>,
    boundary: Option<String>,
    /// The evaluation of its curve.
    pub test: StaticTest,
}

/// All tests.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticsReport {
    /// One for each file that could be evaluated.
    pub tests: Vec<StaticReport>,
    /// Files that could not be evaluated.
    pub failed: Vec<Failed>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

answer_of!(StaticReport as one {
    path: String;
    tangent_stiffness_n_m: f64 = one.test.tangent_stiffness_n_m;
    secant_stiffness_n_m: f64 = one.test.secant_stiffness_n_m;
    hysteresis_ratio: Option<f64> = one.test.hysteresis_ratio;
    load_n: f64 = one.test.load_n;
    max_force_n: f64 = one.test.max_force_n;
    max_compression_m: f64 = one.test.max_compression_m;
    toe_m: f64 = one.test.toe_m;
    toe_compensated: bool = one.toe != Toe::Keep;
    /// Cycles of the file that were not evaluated.
    other_cycles: usize = one.test.other_cycles;
    exponent: Option<f64> = one.test.exponent;
    dynamic_over_static_ratio: Option<f64> =
        one.dynamic_stiffness_n_m.map(|k| k / one.test.secant_stiffness_n_m);
    impactor: Option<String>;
    boundary: Option<String>;
});

answer_of!(StaticsReport as report {
    tests: Vec<&StaticReport> = report.tests.iter().collect();
    /// Files that could not be evaluated.
    failed: Vec<&Failed> = report.failed.iter().collect();
});

/// Reads and evaluates every file; one that fails does not stop the others.
///
/// # Errors
/// No file could be evaluated.
pub fn static_tests(request: &StaticRequest) -> Result<StaticsReport, Problems> {
    check_sensors(
        &request.sensitivities,
        &[Dimension::Force, Dimension::Length],
        "2 mV/N",
    )?;
    let (mut tests, mut failed, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    for path in &request.files {
        match one(path, request) {
            Ok(test) => tests.push(test),
            Err(problem) => failed.push(Failed::new(path, problem)),
        }
    }
    if tests.is_empty() {
        return Err(failed.into_iter().map(|one| one.problem).collect());
    }
    if request.dynamic_stiffness_n_m.is_some() {
        warnings.push(
            "the ratio of dynamic to static stiffness is valid for these tests only, not for another pad, boundary or \
             impactor"
                .to_owned(),
        );
    }
    for test in tests.iter().filter(|test| {
        test.test
            .hysteresis_ratio
            .is_some_and(|ratio| ratio < -1e-3)
    }) {
        warnings.push(format!(
            "{}: the unloading curve is above the loading curve: check the signs and the order of the points",
            test.path
        ));
    }
    tests.iter().for_each(|test| notes(test, &mut warnings));
    Ok(StaticsReport {
        tests,
        failed,
        warnings,
    })
}

/// Warnings about the cycle and the toe of a test.
fn notes(report: &StaticReport, warnings: &mut Vec<String>) {
    let mut say = |text: String| warnings.push(format!("{}: {text}", report.path));
    if report.test.other_cycles > 0 {
        let others = if report.test.other_cycles == 1 {
            "cycle is"
        } else {
            "cycles are"
        };
        say(format!(
            "{} other {others} left out: the last full one is evaluated",
            report.test.other_cycles
        ));
    }
    let least_m = (NOISE_ERRORS * report.test.toe_error_m)
        .max(NEGATIVE_TOE_SHARE * report.test.max_compression_m);
    if report.test.toe_m < -least_m {
        say(format!(
            "the tangent meets zero force {} mm before the first point: this indicates a preload or a pad that \
             softens; with `toe = \"keep\"` the secant starts at the first point",
            significant(-1e3 * report.test.toe_m, 3)
        ));
    }
}

fn one(path: &Path, request: &StaticRequest) -> Result<StaticReport, Problem> {
    let read = load_static(path, &request.sensitivities)?;
    let said = |key: &str| {
        read.said
            .iter()
            .find(|(k, ..)| k == key)
            .map(|(_, value, _)| value.clone())
    };
    let impactor = request.impactor.clone().or_else(|| said("impactor"));
    let usual = if Impactor::of(impactor.as_deref()) == Impactor::Sphere {
        Toe::Keep
    } else {
        Toe::Slack
    };
    let toe = request.toe.unwrap_or(usual);
    let options = StaticOptions {
        load_n: request.load_n,
        machine_stiffness_n_m: request.machine_stiffness_n_m,
        toe,
    };
    let sign = if request.inverted { -1.0 } else { 1.0 };
    let [force_n, displacement_m] = [&read.force_n, &read.displacement_m].map(|values| {
        values
            .iter()
            .map(|value| sign * value)
            .collect::<Vec<f64>>()
    });
    let test = static_test(&force_n, &displacement_m, &options)
        .map_err(|error| problem(&error).in_file(path))?;
    Ok(StaticReport {
        path: path.to_string_lossy().into_owned(),
        toe,
        dynamic_stiffness_n_m: request.dynamic_stiffness_n_m,
        impactor,
        boundary: request.boundary.clone().or_else(|| said("boundary")),
        test,
    })
}

fn problem(error: &StaticError) -> Problem {
    let hint = match error {
        StaticError::TooFew { .. } => "record more points while loading",
        StaticError::NotFinite { .. } => "repair the file",
        StaticError::NoForce { .. } => {
            "compression must be positive: `invert` reverses the signs of both columns"
        }
        StaticError::Load { .. } => "give a `load` that the test reached",
        StaticError::NotRising { .. } => {
            "check which columns are force and displacement, and their signs"
        }
        StaticError::Foot { .. } => "unload between the cycles, or give a higher `load`",
        StaticError::Machine { .. } => {
            "check `machine_compliance`: it is the stiffness of the frame, such as \"50 kN/mm\""
        }
    };
    Problem::value(error.to_string(), hint)
}

/// Compression and force of a test, corrected for machine and toe, as CSV.
pub fn curve_table(test: &StaticTest) -> Table {
    table_of_numbers(
        "compression_m,force_n",
        test.curve.iter().map(|&(d, f)| [d, f]),
    )
}
