//! Rolling friction of a round body.
//!
//! The moment −μ_r R N ω/|ω| of a point of the rim, at the distance R from the axis of the body: Coulomb's rolling friction with
//! the lever arm μ_r R, model A of Ai, Chen, Rotter and Ooi (2011), Powder Technol. 206, 269. ω is the
//! horizontal part of the rotation, and of the moment only the part along the horizontal line from the point towards the
//! axis counts: a body that rolls on its rim turns about this line; one that only rocks turns at right angles to
//! it, and keeps its energy.

use super::Vector;
use crate::space::{Shift, cross, dot, turned};

/// It has its full size from this rate of rotation, and grows with it below \[rad/s\].
const FULL_RAD_S: f64 = 0.01;

/// The moment over μ_r N at a point of the body, whose axis in its pose is `down`, along x and y of the floor \[m\].
#[inline(always)]
pub(super) fn moment_m(
    point_m: &Vector,
    down: &Vector,
    shift: &Shift,
    omega_rad_s: &Vector,
) -> [f64; 2] {
    let along_axis_m = dot(point_m, down);
    let radial_m = [0, 1, 2].map(|i| point_m[i] - along_axis_m * down[i]);
    let radius_m = dot(&radial_m, &radial_m).sqrt();
    // The line is at right angles to the tangent of the rim.
    let [x, y, _] = turned(shift, &cross(down, &radial_m));
    let size_m = (x * x + y * y).sqrt();
    if size_m <= 0.0 {
        return [0.0; 2];
    }
    let line = [-y / size_m, x / size_m];
    let rate_rad_s = line[0] * omega_rad_s[0] + line[1] * omega_rad_s[1];
    let turning_rad_s = (omega_rad_s[0].powi(2) + omega_rad_s[1].powi(2)).sqrt();
    let share = rate_rad_s / turning_rad_s.max(FULL_RAD_S);
    line.map(|x| -radius_m * share * x)
}
