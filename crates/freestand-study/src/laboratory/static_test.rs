//! Static tests of a cushion: request → report.

use std::path::{Path, PathBuf};

use freestand::identify::{StaticError, StaticOptions, StaticTest, static_test};
use serde::Serialize;

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::push_shortest;
use freestand_input::words::significant;
use freestand_records::tables::laboratory::load_static;

/// Standard errors by which a toe must lie below zero to be worth a word.
const NOISE_ERRORS: f64 = 3.0;
/// And the share of the largest compression.
const NEGATIVE_TOE_SHARE: f64 = 0.005;

/// What is known of all files.
#[derive(Debug, Clone, Default)]
pub struct StaticRequest {
    /// The files.
    pub files: Vec<PathBuf>,
    /// Working load \[N\].
    pub load_n: Option<f64>,
    /// Stiffness of the machine \[N/m\].
    pub machine_stiffness_n_m: Option<f64>,
    /// `Some(false)`: the foot of the curve stays; `None`: it is cut off unless the impactor is a sphere.
    pub compensates_toe: Option<bool>,
    /// Flat or sphere, over what the file says.
    pub impactor: Option<String>,
    /// Glued, unglued, lubricated, over what the file says.
    pub boundary: Option<String>,
    /// A dynamic stiffness to set beside the static one \[N/m\].
    pub dynamic_stiffness_n_m: Option<f64>,
}

/// One test: the keys of `tests` in `freestand cushion static --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct StaticReport {
    pub path: String,
    pub tangent_stiffness_n_m: f64,
    pub secant_stiffness_n_m: f64,
    pub hysteresis_ratio: Option<f64>,
    pub load_n: f64,
    pub max_force_n: f64,
    pub max_compression_m: f64,
    pub toe_m: f64,
    pub toe_compensated: bool,
    /// Cycles of the file beside the one that was evaluated.
    pub other_cycles: usize,
    pub exponent: Option<f64>,
    pub dynamic_over_static_ratio: Option<f64>,
    pub impactor: Option<String>,
    pub boundary: Option<String>,
    #[serde(skip)]
    pub test: StaticTest,
}

/// A file that gave nothing.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation")]
pub struct FailedStatic {
    pub path: String,
    pub reason: String,
    #[serde(skip)]
    pub problem: Problem,
}

/// The keys of `freestand cushion static --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation")]
pub struct StaticsReport {
    pub tests: Vec<StaticReport>,
    pub failed: Vec<FailedStatic>,
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// Reads and evaluates every file; one that fails hides no other.
///
/// # Errors
/// No file gave anything.
pub fn static_tests(request: &StaticRequest) -> Result<StaticsReport, Vec<Problem>> {
    let (mut tests, mut failed, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    for path in &request.files {
        match one(path, request) {
            Ok(test) => tests.push(test),
            Err(problem) => failed.push(FailedStatic {
                path: path.to_string_lossy().into_owned(),
                reason: problem.message.clone(),
                problem,
            }),
        }
    }
    if tests.is_empty() {
        return Err(failed.into_iter().map(|one| one.problem).collect());
    }
    if request.dynamic_stiffness_n_m.is_some() {
        warnings.push(
            "the dynamic over static ratio is that of these tests alone: it holds for no other pad, boundary or impactor"
                .to_owned(),
        );
    }
    for test in tests.iter().filter(|test| test.hysteresis_ratio.is_some_and(|ratio| ratio < -1e-3)) {
        warnings.push(format!("{}: the way out lies above the way in: check signs and order of the points", test.path));
    }
    tests.iter().for_each(|test| notes(test, &mut warnings));
    Ok(StaticsReport { tests, failed, warnings })
}

/// Which cycle it is, and where its foot lies.
fn notes(report: &StaticReport, warnings: &mut Vec<String>) {
    let mut say = |text: String| warnings.push(format!("{}: {text}", report.path));
    if report.other_cycles > 0 {
        let others = if report.other_cycles == 1 { "cycle is" } else { "cycles are" };
        say(format!("{} other {others} left out: the last full one is evaluated", report.other_cycles));
    }
    let least_m = (NOISE_ERRORS * report.test.toe_error_m).max(NEGATIVE_TOE_SHARE * report.max_compression_m);
    if report.toe_m < -least_m {
        say(format!(
            "the tangent meets zero force {} mm before the first point: a preload, or a pad that softens, for which \
             --toe keep has the secant from the first point on",
            significant(-1e3 * report.toe_m, 3)
        ));
    }
}

fn one(path: &Path, request: &StaticRequest) -> Result<StaticReport, Problem> {
    let read = load_static(path)?;
    let said = |key: &str| read.said.iter().find(|(k, ..)| k == key).map(|(_, value, _)| value.clone());
    let impactor = request.impactor.clone().or_else(|| said("impactor"));
    let is_sphere = impactor.as_deref().is_some_and(|text| text.to_lowercase().starts_with("sphere"));
    let compensates_toe = request.compensates_toe.unwrap_or(!is_sphere);
    let options =
        StaticOptions { load_n: request.load_n, machine_stiffness_n_m: request.machine_stiffness_n_m, compensates_toe };
    let test =
        static_test(&read.force_n, &read.displacement_m, &options).map_err(|error| problem(&error).in_file(path))?;
    Ok(StaticReport {
        path: path.to_string_lossy().into_owned(),
        tangent_stiffness_n_m: test.tangent_stiffness_n_m,
        secant_stiffness_n_m: test.secant_stiffness_n_m,
        hysteresis_ratio: test.hysteresis_ratio,
        load_n: test.load_n,
        max_force_n: test.max_force_n,
        max_compression_m: test.max_compression_m,
        toe_m: test.toe_m,
        toe_compensated: compensates_toe,
        other_cycles: test.other_cycles,
        exponent: test.exponent,
        dynamic_over_static_ratio: request.dynamic_stiffness_n_m.map(|k| k / test.secant_stiffness_n_m),
        impactor,
        boundary: request.boundary.clone().or_else(|| said("boundary")),
        test,
    })
}

fn problem(error: &StaticError) -> Problem {
    let hint = match error {
        StaticError::TooFew { .. } => "record more points on the way in",
        StaticError::NotFinite { .. } => "repair the file",
        StaticError::NoForce { .. } => "compression must be positive: turn the signs of the columns",
        StaticError::Load { .. } => "give a --load that the test reached",
        StaticError::NotRising { .. } => "check which columns are force and displacement, and their signs",
        StaticError::Foot { .. } => "unload between the cycles, or give a higher --load",
        StaticError::Machine { .. } => {
            "check --machine-compliance: it is the stiffness of the frame, such as \"50 kN/mm\""
        }
    };
    Problem::new(ProblemKind::Value, error.to_string()).hint(hint)
}

/// Compression and force of a test, after machine and toe, as CSV.
pub fn curve_csv(test: &StaticTest) -> String {
    let mut text = String::from("compression_m,force_n\n");
    for &(d, f) in &test.curve {
        push_shortest(&mut text, d);
        text.push(',');
        push_shortest(&mut text, f);
        text.push('\n');
    }
    text
}
