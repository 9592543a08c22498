//! What the reader of a spectrum must know, as data: `freestand-report` has the words.

use freestand_input::words::number;
use freestand_records::tables::hazard::Statistic;
use strum::EnumCount;

use crate::places::{Coordinates, Derived, PlaceDoubt};

/// Something that the reader of a spectrum must know.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum TargetDoubt {
    /// The edition of its code was not read.
    EditionUnread,
    /// About the values of its place.
    Place(PlaceDoubt),
    /// The values of the place were converted from another return period.
    Derived {
        /// The place.
        place: String,
        /// How.
        derived: Derived,
    },
    /// Nobody stated a place: it is this one.
    PlaceAssumed(&'static str),
    /// The smallest kpZ of AS 1170.4 governs.
    MinimumGoverns {
        /// kpZ.
        least_ratio: f64,
        /// The return period \[years\].
        years: u32,
        /// Z.
        hazard_factor: f64,
    },
    /// Z R is above the largest of NZS 1170.5.
    MaximumGoverns {
        /// Z R.
        zr_ratio: f64,
    },
    /// A national annex has two spectra: the one that is used where one alone is, and the other.
    TwoSpectra([AnnexSpectrum; 2]),
    /// Soil factor or corner periods are not those that EN 1998-1 recommends.
    OwnShape,
    /// ASCE 7-16 asks for a study of the site.
    AsksForStudy,
    /// The coefficients of ASCE 7-16 stand in a spectrum of ASCE 7-22.
    CoefficientsOf2016,
    /// A table begins above T = 0, and holds its first value below.
    BeginsLate {
        /// The file.
        name: String,
        /// Its first period \[s\].
        first_s: f64,
    },
    /// The spectrum of a hazard file ends early, and its displacement is held beyond.
    EndsEarly {
        /// The file.
        name: String,
        /// Its last period \[s\].
        last_s: f64,
    },
    /// A hazard file has no site at the place: the nearest one is used.
    OtherSite {
        /// The file.
        name: String,
        /// The return period of the spectrum \[years\].
        years: Option<f64>,
        /// Where its site is.
        at: Coordinates,
        /// From the place \[km\].
        distance_km: f64,
    },
    /// A hazard file is not the mean of its model.
    NotMean {
        /// The file.
        name: String,
        /// What it is.
        statistic: Statistic,
    },
}

/// One of two spectra of a national annex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnexSpectrum {
    /// The number of its type.
    pub number: u8,
    /// a_gR \[g\].
    pub reference_acceleration_g: f64,
}

impl AnnexSpectrum {
    /// `type 1 (a_gR = 0.1 g)`
    pub fn name(self) -> String {
        let a_g = number(self.reference_acceleration_g, 4);
        format!("type {} (a_gR = {a_g} g)", self.number)
    }
}
