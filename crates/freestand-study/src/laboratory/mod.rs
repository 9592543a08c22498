//! The laboratory: cushions from drop tests, static tests and stress–energy curves, and virtual
//! tests of these methods.

pub mod cushion_curve;
pub mod drop_test;
pub mod static_curve;
pub mod virtual_laboratory;

use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_records::formats::Sensitivity;

/// What strikes the pad, as a user names it.
pub const IMPACTORS: [&str; 2] = ["flat", "sphere"];

/// How the pad is held between its faces, as a user names it.
pub const BOUNDARIES: [&str; 3] = ["glued", "unglued", "lubricated"];

/// Refuses the sensitivity of a sensor that measures nothing of a test, and a second one of the same kind.
fn check_sensors(
    sensors: &[Sensitivity],
    measured: &[Dimension],
    example: &str,
) -> Result<(), Problem> {
    let is_spare = |(i, sensor): (usize, &Sensitivity)| {
        let of = sensor.dimension();
        !measured.contains(&of) || sensors[..i].iter().any(|earlier| earlier.dimension() == of)
    };
    if !sensors.iter().enumerate().any(is_spare) {
        return Ok(());
    }
    let message = "a `sensitivity` belongs to no column of the test";
    Err(Problem::value(
        message,
        format!("give one for each sensor, such as \"{example}\""),
    )
    .of(&["sensitivity"]))
}

/// What strikes the pad, as far as the evaluation depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Impactor {
    Flat,
    Sphere,
    Other,
}

impl Impactor {
    /// From the words of a file or a user, such as `sphere of steel`.
    fn of(words: Option<&str>) -> Self {
        let words = words.unwrap_or_default().to_lowercase();
        match () {
            () if words.starts_with("flat") => Self::Flat,
            () if words.starts_with("sphere") => Self::Sphere,
            () => Self::Other,
        }
    }
}
