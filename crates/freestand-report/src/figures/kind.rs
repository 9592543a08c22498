//! Which figures a study has.

/// Which figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum FigureKind {
    /// Uplift spectra: uplift against height.
    Urs,
    /// Shock spectra: shock against height.
    Srs,
    /// Share of the motions that overturn against height.
    Overturning,
    /// Acceleration spectra of the ground and the floors.
    FloorSpectra,
    /// Peak floor accelerations over the height.
    FloorProfile,
    /// One rocking history.
    History,
    /// A ground motion, by its index from 0.
    Record(usize),
    /// How the result depends on each assumption.
    Vary,
}

/// Largest number of recorded ground motions that are drawn: the first ones.
pub const MAX_RECORDS: usize = 6;

/// Number of generated motions that are drawn: they are all alike.
pub(super) const MAX_SYNTHETIC: usize = 2;

impl FigureKind {
    /// Its name for files.
    pub fn name(self) -> String {
        match self {
            Self::Record(index) => format!("record_{:02}", index + 1),
            named => <&str>::from(named).to_owned(),
        }
    }
}
