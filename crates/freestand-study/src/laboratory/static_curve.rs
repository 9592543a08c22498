//! Static tests of a cushion: request → report.

use std::path::{Path, PathBuf};

use freestand::identify::{StaticError, StaticOptions, StaticTest, Toe, static_test};

use super::{Impactor, check_sensors};
use crate::recorded::Failed;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::Dimension;
use freestand_output::answer_of;
use freestand_output::rows::table_of_numbers;
use freestand_output::table::Table;
use freestand_records::formats::Sensitivity;
use freestand_records::tables::laboratory::load_static;
use strum::EnumCount;

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
    /// What is doubtful.
    pub doubts: Vec<StaticsDoubt>,
}

/// Something doubtful in static tests.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum StaticsDoubt {
    /// The ratio of dynamic to static stiffness is that of these tests alone.
    RatioOfTheseTests,
    /// The unloading curve is above the loading curve in this file.
    UnloadsAbove(String),
    /// Other cycles of a file are left out.
    OtherCycles {
        /// The file.
        path: String,
        /// How many.
        cycles: usize,
    },
    /// The tangent meets zero force before the first point.
    NegativeToe {
        /// The file.
        path: String,
        /// How far before it \[m\].
        before_m: f64,
    },
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
    let (mut tests, mut failed, mut doubts) = (Vec::new(), Vec::new(), Vec::new());
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
        doubts.push(StaticsDoubt::RatioOfTheseTests);
    }
    for test in tests.iter().filter(|test| {
        test.test
            .hysteresis_ratio
            .is_some_and(|ratio| ratio < -1e-3)
    }) {
        doubts.push(StaticsDoubt::UnloadsAbove(test.path.clone()));
    }
    doubts.extend(tests.iter().flat_map(doubts_of));
    Ok(StaticsReport {
        tests,
        failed,
        doubts,
    })
}

/// What is doubtful about the cycle and the toe of a test.
fn doubts_of(report: &StaticReport) -> impl Iterator<Item = StaticsDoubt> {
    let (path, test) = (&report.path, &report.test);
    let least_m =
        (NOISE_ERRORS * test.toe_error_m).max(NEGATIVE_TOE_SHARE * test.max_compression_m);
    let cycles = (test.other_cycles > 0).then(|| StaticsDoubt::OtherCycles {
        path: path.clone(),
        cycles: test.other_cycles,
    });
    let toe = (test.toe_m < -least_m).then(|| StaticsDoubt::NegativeToe {
        path: path.clone(),
        before_m: -test.toe_m,
    });
    cycles.into_iter().chain(toe)
}

fn one(path: &Path, request: &StaticRequest) -> Result<StaticReport, Problem> {
    let read = load_static(path, &request.sensitivities)?;
    let said = |key: &str| {
        let mut comments = read.comments.iter();
        Some(comments.find(|one| one.key == key)?.value.clone())
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
