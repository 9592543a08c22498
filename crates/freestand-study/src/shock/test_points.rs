//! A damage boundary from the shocks of a test, ASTM D3332: Method A (short pulses) gives the
//! critical velocity change, Method B (long ones) the critical acceleration.

use std::path::Path;

use freestand::G0_M_S2;
use freestand::damage_boundary::KNEE_RATIO;

use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_output::answer;
use freestand_records::tables::{DamageRow, TestMethod, load_damage_points};
use strum::EnumCount;

/// The longest pulse of Method A \[s\].
const MAX_METHOD_A_S: f64 = 3e-3;

/// One shock of a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TestPoint {
    /// Its method.
    pub method: TestMethod,
    /// Δv \[m/s\].
    pub velocity_change_m_s: f64,
    /// A \[g\].
    pub peak_acceleration_g: f64,
    /// Whether it damaged the object.
    pub damaged: bool,
    /// Its line in the file, from 1.
    pub line: usize,
}

/// The largest value that was survived and the smallest that damaged; `None` where there is no
/// such test.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bracket {
    /// The largest that was survived below the first damage: the critical value.
    pub survived: Option<f64>,
    /// The first damage.
    pub damaged: Option<f64>,
}

/// The tests of an object and what they show about its damage boundary.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BoundaryTests {
    /// V_c, by Method A.
    pub critical_velocity_change_m_s: Bracket,
    /// A_c, by Method B.
    pub critical_acceleration_g: Bracket,
    /// All points, in the order of the file.
    pub points: Vec<TestPoint>,
    /// What is missing or doubtful.
    pub doubts: Vec<TestsDoubt>,
}

/// What is missing or doubtful in shock tests.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum TestsDoubt {
    /// There is no shock of this method.
    NoShock(TestMethod),
    /// No shock of this method below the first damage was survived.
    NoneSurvived(TestMethod),
    /// Every shock of this method is ignored.
    AllIgnored(TestMethod),
    /// No shock of this method did damage.
    NoDamage(TestMethod),
    /// The lines of shocks of Method B that are ignored, because their velocity change is too small.
    BelowKnee(Vec<usize>),
    /// The lines of shocks that give the critical velocity change, although their peaks do no damage at any.
    WeakPeaks(Vec<usize>),
}

impl BoundaryTests {
    /// A_c \[m/s²\] and V_c \[m/s\], where both are known.
    pub fn critical(&self) -> Option<(f64, f64)> {
        let acceleration_m_s2 = G0_M_S2 * self.critical_acceleration_g.survived?;
        Some((
            acceleration_m_s2,
            self.critical_velocity_change_m_s.survived?,
        ))
    }
}

answer! {
    /// Shock tests of an object.
    pub struct TestsAnswer of (tests: &BoundaryTests) {
        /// Between which velocity changes the critical one lies.
        critical_velocity_change_m_s: BracketAnswer =
            BracketAnswer::of(&tests.critical_velocity_change_m_s);
        /// Between which peaks the critical one lies.
        critical_acceleration_g: PeakBracket = PeakBracket::of(&tests.critical_acceleration_g);
        /// All tests.
        points: Vec<TestPointAnswer> = tests.points.iter().map(TestPointAnswer::of).collect();
    }

    /// What was survived last and damaged first.
    pub struct BracketAnswer of (bracket: &Bracket) {
        survived: Option<f64> => "largest survived velocity change";
        damaged: Option<f64> => "smallest damaging velocity change";
    }

    /// What was survived last and damaged first.
    pub struct PeakBracket of (bracket: &Bracket) {
        survived: Option<f64> => "largest survived peak";
        damaged: Option<f64> => "smallest damaging peak";
    }

    /// A shock test.
    pub struct TestPointAnswer of (point: &TestPoint) {
        /// A or B.
        method: String = point.method.to_string();
        /// Velocity change of the pulse.
        velocity_change_m_s: f64;
        /// Peak of the pulse.
        peak_acceleration_g: f64;
        /// Whether it damaged the object.
        damaged: bool;
        /// Line of the file.
        line: usize;
    }
}

/// Reads the tests of an object: columns of velocity change, peak acceleration and `damaged`,
/// and optionally `method` (A or B) or a duration.
///
/// Where the method is not stated, it follows from the duration: up to 3 ms is Method A. Where
/// neither is stated, it follows from velocity change and peak: a pulse lasts between Δv/A (a
/// rectangle) and 2Δv/A (a sawtooth). Where 3 ms lies between the two, the row is refused.
///
/// # Reference
/// ASTM D3332, in our own words: V_c and A_c are the last values that were survived before the
/// first damage; Method B is run at 1.57 V_c or more, so a shock survived below that says nothing
/// about A_c.
///
/// # Errors
/// A file without such columns, a point whose method is not known, damage at or below a survived
/// value.
pub fn boundary_tests(path: &Path) -> Result<BoundaryTests, Problems> {
    let rows = load_damage_points(path)?;
    let mut problems = Vec::new();
    let mut points = Vec::new();
    for row in &rows {
        match method(row) {
            Ok(method) => points.push(TestPoint {
                method,
                velocity_change_m_s: row.velocity_change_m_s,
                peak_acceleration_g: row.peak_acceleration_m_s2 / G0_M_S2,
                damaged: row.damaged,
                line: row.line,
            }),
            Err(problem) => problems.push(problem),
        }
    }
    problems.extend(contradiction(
        &points,
        TestMethod::A,
        "velocity change",
        velocity_change,
    ));
    problems.extend(contradiction(&points, TestMethod::B, "peak", peak));
    let problems: Problems = problems
        .into_iter()
        .map(|problem| problem.in_file(path))
        .collect();
    if problems.is_empty() {
        return Ok(evaluated(points));
    }
    Err(problems)
}

/// The quantity that a method increases from shock to shock.
type Size = fn(&TestPoint) -> f64;

fn velocity_change(point: &TestPoint) -> f64 {
    point.velocity_change_m_s
}

fn peak(point: &TestPoint) -> f64 {
    point.peak_acceleration_g
}

fn method(row: &DamageRow) -> Result<TestMethod, Problem> {
    if let Some(method) = row.method {
        return Ok(method);
    }
    let rectangle_s = row.velocity_change_m_s / row.peak_acceleration_m_s2;
    let (shortest_s, longest_s) = row
        .duration_s
        .map_or((rectangle_s, 2.0 * rectangle_s), |duration_s| {
            (duration_s, duration_s)
        });
    if longest_s <= MAX_METHOD_A_S {
        Ok(TestMethod::A)
    } else if shortest_s > MAX_METHOD_A_S {
        Ok(TestMethod::B)
    } else {
        let message =
            "velocity change and peak do not tell whether this shock belongs to Method A or B";
        let problem = Problem::new(ProblemKind::Value, message).at_line(row.line);
        Err(problem.hint(
            "add a column \"method\" with A or B, or one of durations, such as \"duration [ms]\"",
        ))
    }
}

/// The shocks of a method that did damage, or did not.
fn tested(
    points: &[TestPoint],
    method: TestMethod,
    damaged: bool,
) -> impl Iterator<Item = &TestPoint> {
    points
        .iter()
        .filter(move |point| point.method == method && point.damaged == damaged)
}

/// A problem where a shock of a method was survived at or above the first damage.
fn contradiction(
    points: &[TestPoint],
    method: TestMethod,
    what: &str,
    size: Size,
) -> Option<Problem> {
    let of = |damaged| tested(points, method, damaged);
    let first = of(true).min_by(|a, b| size(a).total_cmp(&size(b)))?;
    let last = of(false).max_by(|a, b| size(a).total_cmp(&size(b)))?;
    (size(last) >= size(first)).then(|| {
        let message = format!(
            "Method {method}: this {what} did damage, but that of line {} is at least as large and was survived; \
             the tests contradict each other",
            last.line
        );
        let problem = Problem::new(ProblemKind::Value, message).at_line(first.line);
        problem.hint("use a new specimen for each test, and leave out specimens weakened by an earlier shock")
    })
}

fn evaluated(points: Vec<TestPoint>) -> BoundaryTests {
    let mut doubts = Vec::new();
    let bracket = |method: TestMethod, size: Size, counts: &dyn Fn(&TestPoint) -> bool| {
        let of = |damaged| tested(&points, method, damaged);
        Bracket {
            survived: of(false)
                .filter(|point| counts(point))
                .map(size)
                .max_by(f64::total_cmp),
            damaged: of(true).map(size).min_by(f64::total_cmp),
        }
    };
    let v = bracket(TestMethod::A, velocity_change, &|_| true);
    let knee_m_s = v.survived.map(|survived| KNEE_RATIO * survived);
    // 1.57, as the standard rounds it, is enough.
    let beyond_knee =
        |point: &TestPoint| knee_m_s.is_none_or(|knee| point.velocity_change_m_s >= 0.999 * knee);
    let a = bracket(TestMethod::B, peak, &beyond_knee);
    for (method, found) in [(TestMethod::A, v), (TestMethod::B, a)] {
        let tested = points.iter().any(|point| point.method == method);
        doubts.extend(match (found.survived, found.damaged) {
            (None, _) if !tested => Some(TestsDoubt::NoShock(method)),
            (None, Some(_)) => Some(TestsDoubt::NoneSurvived(method)),
            (None, None) => Some(TestsDoubt::AllIgnored(method)),
            (Some(_), None) => Some(TestsDoubt::NoDamage(method)),
            (Some(_), Some(_)) => None,
        });
    }
    let lines = |is_it: &dyn Fn(&TestPoint) -> bool| {
        let found = points.iter().filter(|point| is_it(point));
        let lines: Vec<usize> = found.map(|point| point.line).collect();
        (!lines.is_empty()).then_some(lines)
    };
    let is_ignored =
        |point: &TestPoint| point.method == TestMethod::B && !point.damaged && !beyond_knee(point);
    doubts.extend(lines(&is_ignored).map(TestsDoubt::BelowKnee));
    // Below A_c every velocity change is survived.
    let says_nothing = |point: &TestPoint| {
        point.method == TestMethod::A
            && !point.damaged
            && v.survived == Some(point.velocity_change_m_s)
            && a.survived
                .is_some_and(|a_c| point.peak_acceleration_g <= a_c)
    };
    doubts.extend(lines(&says_nothing).map(TestsDoubt::WeakPeaks));
    BoundaryTests {
        critical_velocity_change_m_s: v,
        critical_acceleration_g: a,
        points,
        doubts,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: &str = "velocity change [m/s],peak acceleration [g],damaged,method\n";
    /// V_c between 0.9 and 1.1 m/s, A_c between 30 and 35 g.
    const POINTS: &str =
        "0.7,120,no,A\n0.9,150,no,A\n1.1,180,yes,A\n1.6,20,no,B\n1.6,30,no,B\n1.6,35,yes,B\n";

    fn read(text: &str) -> Result<BoundaryTests, String> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        boundary_tests(file.path()).map_err(|error| error.to_string())
    }

    #[test]
    fn the_last_survived_before_the_first_damage() {
        let tests = read(&format!("{NAMES}{POINTS}")).unwrap();
        assert_eq!(
            tests.critical_velocity_change_m_s,
            Bracket {
                survived: Some(0.9),
                damaged: Some(1.1)
            }
        );
        let a = tests.critical_acceleration_g;
        assert!(
            (a.survived.unwrap() - 30.0).abs() < 1e-12 && (a.damaged.unwrap() - 35.0).abs() < 1e-12
        );
        let (a_c, v_c) = tests.critical().unwrap();
        assert!((a_c - 30.0 * G0_M_S2).abs() < 1e-12 && v_c == 0.9);
        assert_eq!(
            (
                tests.points.len(),
                tests.points[3].method,
                tests.doubts.len()
            ),
            (6, TestMethod::B, 0)
        );
    }

    /// The order of the lines changes nothing.
    #[test]
    fn the_order_does_not_matter() {
        let mut lines: Vec<&str> = POINTS.lines().collect();
        let straight = read(&format!("{NAMES}{POINTS}")).unwrap();
        for _ in 0..lines.len() {
            lines.rotate_left(1);
            let turned = read(&format!("{NAMES}{}\n", lines.join("\n"))).unwrap();
            assert_eq!(turned.critical(), straight.critical());
        }
    }

    #[test]
    fn the_method_is_told_or_asked_for() {
        // 1 m/s at 100 g is 1.02 ms for a rectangle and 2.04 ms for a sawtooth; 2 m/s at 30 g is
        // 6.8 ms at least; 1.5 m/s at 60 g between 2.5 and 5.1 ms.
        let names = "velocity change [m/s],peak [g],damaged\n";
        let tests = read(&format!("{names}1,100,0\n2,30,0\n")).unwrap();
        assert_eq!(
            tests
                .points
                .iter()
                .map(|point| point.method.to_string())
                .collect::<String>(),
            "AB"
        );
        let asked = read(&format!("{names}1,100,0\n1.5,60,0\n")).unwrap_err();
        assert!(
            asked.contains(":3: ")
                && asked.contains("Method A or B")
                && asked.contains("column \"method\"")
        );
        let names = "velocity change [m/s],peak [g],damaged,duration [ms]\n";
        let tests = read(&format!("{names}1.5,60,0,3\n1.5,60,0,4\n")).unwrap();
        assert_eq!(
            tests
                .points
                .iter()
                .map(|point| point.method.to_string())
                .collect::<String>(),
            "AB"
        );
    }

    #[test]
    fn contradictions_are_refused_with_their_lines() {
        let said = read(&format!(
            "{NAMES}1.1,180,no,A\n0.9,150,yes,A\n1.6,20,no,B\n1.6,20,yes,B\n"
        ))
        .unwrap_err();
        assert!(
            said.contains(":3: Method A: this velocity change did damage")
                && said.contains("line 2 is at least"),
            "{said}"
        );
        assert!(
            said.contains(":5: Method B: this peak did damage")
                && said.contains("line 4 is at least"),
            "{said}"
        );
        // A peak above the first damage of the other method is no contradiction.
        assert!(read(&format!("{NAMES}{POINTS}0.5,400,no,A\n")).is_ok());
    }

    #[test]
    fn what_is_missing_is_said() {
        let cases = [
            (
                "0.9,150,no,A\n1.1,180,yes,A\n",
                TestsDoubt::NoShock(TestMethod::B),
            ),
            (
                "1.6,30,no,B\n1.6,35,yes,B\n",
                TestsDoubt::NoShock(TestMethod::A),
            ),
            (
                "0.9,150,no,A\n1.6,35,yes,B\n",
                TestsDoubt::NoneSurvived(TestMethod::B),
            ),
            // 1.57 × 0.9 = 1.413
            (
                "0.9,150,no,A\n1.4,30,no,B\n",
                TestsDoubt::BelowKnee(vec![3]),
            ),
        ];
        for (points, doubt) in cases {
            let tests = read(&format!("{NAMES}{points}")).unwrap();
            assert_eq!(tests.critical(), None, "{points}");
            assert!(tests.doubts.contains(&doubt), "{:?}", tests.doubts);
        }
        let never = read(&format!("{NAMES}0.9,150,no,A\n1.413,30,no,B\n")).unwrap();
        assert_eq!(
            (never.critical().map(|(_, v_c)| v_c), never.doubts),
            (
                Some(0.9),
                [TestMethod::A, TestMethod::B]
                    .map(TestsDoubt::NoDamage)
                    .to_vec()
            )
        );
        let weak = read(&format!("{NAMES}0.9,25,no,A\n1.6,30,no,B\n1.6,35,yes,B\n")).unwrap();
        assert!(weak.doubts.contains(&TestsDoubt::WeakPeaks(vec![2])));
    }
}
