//! What an object did under several motions.

use freestand_output::facts::Facts;

use crate::table::{Column, facts_table};

/// The table of several motions of an object that rocks.
const ROCKING: [Column; 6] = [
    ("motion", "motion", 0),
    ("outcome", "outcome", 0),
    ("peak_rotation_rad", "rotation [rad]", 4),
    ("uplift_m", "uplift [mm]", 4),
    ("cg_rise_m", "rise [mm]", 4),
    ("impact_count", "impacts", 0),
];

/// The table of several motions of an object that slides.
const SLIDING: [Column; 6] = [
    ("motion", "motion", 0),
    ("outcome", "outcome", 0),
    ("slide_peak_m", "slide [mm]", 4),
    ("slide_final_m", "at the end [mm]", 4),
    ("slide_speed_max_m_s", "speed [m/s]", 4),
    ("clearance_speed_m_s", "at the clearance [m/s]", 4),
];

/// The table of several motions, each with both components, of an object that slides.
const SLIDING_IN_PLANE: [Column; 7] = [
    ("motion", "motion", 0),
    ("outcome", "outcome", 0),
    ("slide_peak_m", "farthest [mm]", 4),
    ("slide_left_m", "to the left [mm]", 4),
    ("slide_final_x_m", "at the end [mm]", 4),
    ("slide_final_y_m", "and to the back [mm]", 4),
    ("slide_speed_max_m_s", "speed [m/s]", 4),
];

/// The table of several motions of a body on its hull.
const HULL: [Column; 4] = [
    ("motion", "motion", 0),
    ("outcome", "outcome", 0),
    ("peak_tilt_rad", "tilt [rad]", 4),
    ("peak_tilt_ratio", "of that of tipping", 3),
];

/// How an object that is followed under several motions moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Moves {
    /// It rocks.
    Rocks,
    /// It slides or rolls.
    Slides,
    /// It slides or rolls under both components.
    SlidesInPlane,
    /// It is a body on its hull.
    OnHull,
}

/// One row for each motion, with what the object did under it.
pub fn followed_text<'a>(
    each: impl IntoIterator<Item = (&'a str, Facts<'a>)>,
    moves: Moves,
) -> String {
    let row = |(motion, facts): (&'a str, Facts<'a>)| {
        Facts::default().key("motion", motion.to_owned()).and(facts)
    };
    let columns: &[Column] = match moves {
        Moves::Rocks => &ROCKING,
        Moves::Slides => &SLIDING,
        Moves::SlidesInPlane => &SLIDING_IN_PLANE,
        Moves::OnHull => &HULL,
    };
    facts_table(each.into_iter().map(row), columns)
}
