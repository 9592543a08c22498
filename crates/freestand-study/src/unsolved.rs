//! Histories that a solver refused or did not end: what is wrong, and what to do about it.

use freestand::compliant::CompliantError;
use freestand::motion::Motion;
use freestand::respond::RespondError;
use freestand::rocking::{Base, Outcome, RockingError};
use freestand::sliding::SlidingError;
use freestand_input::problem::{Problem, ProblemKind};

use crate::doubt::HistoryDoubt;
use crate::walls::wall_problem;

/// The motions under an object, as far as they are given.
pub(crate) fn base<'m>(horizontal: &'m Option<Motion>, vertical: &'m Option<Motion>) -> Base<'m> {
    Base {
        horizontal: horizontal.as_ref(),
        vertical: vertical.as_ref(),
    }
}

/// A problem of a history, with what to do about it.
pub fn problem(error: RespondError) -> Problem {
    match error {
        RespondError::Rocking(error) => rocking_problem(error),
        RespondError::Sliding(error) => sliding_problem(error),
        RespondError::Compliant(error) => compliant_problem(error),
        RespondError::Hull(error) => {
            Problem::value(error.to_string(), "check the shape of the object")
        }
        RespondError::TooLong { .. } => Problem::value(
            error.to_string(),
            "give a shorter `duration`, or leave `history` and `out` out",
        ),
    }
}

/// A problem of an object that rocks on a rigid base, or of its motion.
pub fn rocking_problem(error: RockingError) -> Problem {
    let hint = match error {
        RockingError::FreeFlight { .. } => "check the unit and the scale of the vertical motion",
        RockingError::TooManyImpacts { .. } => {
            "a `restitution` of 1 loses no energy: give a smaller one or a shorter `duration`"
        }
        RockingError::StepTooSmall { .. } => {
            "check the unit and the scale of the motion, and the size of the object"
        }
        RockingError::Restitution { .. } => "give a `restitution` in (0, 1]",
        RockingError::InitialState { .. } => {
            "give an `initial_rotation` below 90 deg, at which the object is overturned"
        }
        RockingError::Wall(error) => return wall_problem(error),
        RockingError::BeyondWall { .. } => "give a smaller `initial_rotation`, or a wider gap",
        RockingError::LinearisedWall => "leave `model` out, or the walls",
        RockingError::Duration { .. } => "give `motion`, or `initial_rotation` with `duration`",
        RockingError::Gravity { .. } => "leave `gravity` out for 9.80665 m/s2",
        RockingError::Accuracy { .. } => "use `accuracy` fast, standard or tight",
        RockingError::VerticalMismatch { .. } => {
            "resample one of them so that both have the same step and length"
        }
    };
    let kind = match error {
        RockingError::FreeFlight { .. }
        | RockingError::TooManyImpacts { .. }
        | RockingError::StepTooSmall { .. } => ProblemKind::Computation,
        _ => ProblemKind::Value,
    };
    Problem::new(kind, error.to_string()).hint(hint)
}

/// A problem of an object that slides or rolls.
pub(crate) fn sliding_problem(error: SlidingError) -> Problem {
    let hint = match error {
        SlidingError::Base(error) => return rocking_problem(error),
        SlidingError::Friction { .. } => "give a `friction_kinetic` of at most `friction`",
        SlidingError::Clearance { .. } => {
            "give the distance to whatever is beside the object, at least 0 m"
        }
    };
    Problem::value(error.to_string(), hint)
}

/// A problem of an object on its pads.
fn compliant_problem(error: CompliantError) -> Problem {
    let hint = match error {
        CompliantError::Value { .. } => "check the values of the object and its cushion",
        CompliantError::Contacts { .. } => "2 contact elements are the two edges alone",
        CompliantError::Unstable { .. } => {
            "check the unit of the stiffness: N/m in place of N/mm is a thousand times too soft"
        }
        CompliantError::Duration { .. } => "give `motion`, `cg_rise` or `initial_rotation`",
        CompliantError::BeyondWall => "give a smaller `initial_rotation`, or a wider gap",
        CompliantError::VerticalMismatch => {
            "resample one of them so that both have the same step and length"
        }
        CompliantError::StepTooSmall { .. } | CompliantError::NotFinite { .. } => {
            "check the units of the motion and of the cushion, and whether the cushion bottoms"
        }
        CompliantError::TooManySteps { .. } => {
            "use a shorter `duration` or `accuracy = \"fast\"`; for a very stiff base use `base = \"rigid\"`"
        }
    };
    let kind = match error {
        CompliantError::StepTooSmall { .. }
        | CompliantError::NotFinite { .. }
        | CompliantError::TooManySteps { .. } => ProblemKind::Computation,
        _ => ProblemKind::Value,
    };
    Problem::new(kind, error.to_string()).hint(hint)
}

/// A history that ended before it was certain what becomes of the object.
pub(crate) fn unresolved(outcome: Outcome) -> Option<HistoryDoubt> {
    (outcome == Outcome::Unresolved).then_some(HistoryDoubt::Unresolved)
}
