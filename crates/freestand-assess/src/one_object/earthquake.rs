//! What shakes one object, as an answer names it.

/// The earthquake that a sentence names.
#[derive(Debug, Clone, PartialEq)]
pub enum NamedEarthquake {
    /// The hazard of a place.
    Place {
        /// Its name.
        name: String,
        /// Whether its name is coordinates.
        is_point: bool,
        /// Its code in print.
        code: String,
        /// The return period, if the code has one \[years\].
        years: Option<u32>,
        /// The site, such as `site De`.
        site: Option<String>,
        /// Whether the hazard was recalled and not read.
        is_approximate: bool,
    },
    /// A peak acceleration of the ground.
    GroundAcceleration {
        /// The peak \[g\].
        peak_g: f64,
    },
    /// The earthquake of a study that names no place.
    Study {
        /// The study, such as `hospital.toml`.
        study: String,
        /// Its code in print.
        code: String,
        /// The return period, if the code has one \[years\].
        years: Option<u32>,
        /// The site, such as `site De`.
        site: Option<String>,
    },
    /// The records or simulated motions of a study, which its worlds use in turn.
    MotionsOfStudy {
        /// How many.
        motions: usize,
        /// The study.
        study: String,
    },
    /// Motions of the floor itself.
    Motions,
}
