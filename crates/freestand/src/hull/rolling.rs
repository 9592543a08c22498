//! Rolling friction of a round body.
//!
//! A moment μ_r R N against the rotation about the horizontal line from a point of the rim towards the axis of the
//! body, at the distance R from that axis: Coulomb's rolling friction with the lever arm μ_r R, model A of Ai, Chen,
//! Rotter and Ooi (2011), Powder Technol. 206, 269. A body that rolls on its rim turns about this line; one that
//! only rocks turns at right angles to it, and keeps its energy.

use super::Vector;
use crate::space::{Shift, cross, dot, turned};

/// It has its full size from this rate of rolling, and grows with it below \[rad/s\].
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
    let share = (rate_rad_s / FULL_RAD_S).clamp(-1.0, 1.0);
    line.map(|x| -radius_m * share * x)
}
