//! The points of a body side by side, for vectors.

use super::Vector;

/// Points whose heights and distances are calculated at once.
pub(super) const LANES: usize = 8;

/// Points by coordinate, [`LANES`] at once.
pub(super) fn lanes(points_m: &[Vector]) -> Vec<[[f64; LANES]; 3]> {
    // The last lanes have no point of their own; what stands there is the centre of gravity, inside the body.
    let none = [0.0; 3];
    let lanes = points_m.chunks(LANES).map(|points| {
        let at = |lane: usize| points.get(lane).unwrap_or(&none);
        [0, 1, 2].map(|axis| std::array::from_fn(|lane| at(lane)[axis]))
    });
    lanes.collect()
}
