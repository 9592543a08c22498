//! Elastic design spectra of codes, 5 % damping: AS 1170.4, Eurocode 8, ASCE 7, NZS 1170.5, NTC 2018, TBDY 2018,
//! TS 1170.5, and user tables.
//!
//! | code | parameters | short periods | plateau | then | long periods |
//! |---|---|---|---|---|---|
//! | [`As1170_4`] | Z, return period, class | kpZ (a + b T) | kpZ c | 1/T | 1/T² above 1.5 s |
//! | [`Eurocode8`] | a_g, type, ground | a_g S (1 + 1.5 T/TB) | 2.5 a_g S | 1/T | 1/T² above TD |
//! | [`Asce7`] | SDS, SD1, TL | SDS (0.4 + 0.6 T/T0) | SDS | 1/T | 1/T² above TL |
//! | [`Nzs1170_5`] | Z, R, class, fault | Z R (a + b T) | Z R c | T^−0.75 | 1/T, 1/T² above 3 s |
//! | [`Ntc2018`] | ag, F0, Tc*, ground | ag S (1 + (F0 − 1) T/TB) | ag S F0 | 1/T | 1/T² above TD |
//! | [`Tbdy2018`] | Ss, S1, class | S_DS (0.4 + 0.6 T/T_A) | S_DS | 1/T | 1/T² above 6 s |
//! | [`Ts1170_5`] | four values of a table | PGA + (S_a,s − PGA) T/0.1 s | S_a,s | 1/T | T^−1.5 above T_d |
//! | [`SpectrumTable`] | periods, accelerations | log-log or linear, bounded or extended | | | |
//!
//! [`parts`] has the acceleration of a rigid part on a floor according to each code,
//! [`part_forces`] the design force of its fixing.
//!
//! # Example
//! ```
//! use freestand::code_spectrum::{As1170_4, CodeSpectrum, Edition, SiteClass};
//! let code = CodeSpectrum::from(As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)?);
//! assert!((code.sa_g(1.0) - 0.1584).abs() < 1e-15);
//! assert_eq!(code.name(), "AS 1170.4-2007 (Amdt 1, 2)");
//! # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
//! ```

mod annexes;
mod as1170_4;
mod asce7;
mod eurocode8;
mod eurocode8_shape;
mod frame_period;
mod ntc2018;
mod nzs1170_5;
pub mod part_forces;
pub mod parts;
mod table;
mod tbdy2018;
mod ts1170_5;

use thiserror::Error;

pub use annexes::NationalAnnex;
pub use as1170_4::{
    As1170_4, Edition, SiteClass, minimum_kpz, probability_factor, probability_factors,
};
pub use asce7::{Asce7, Asce7Edition, Asce7Site, SiteCoefficients, site_coefficients};
pub use eurocode8::Eurocode8;
pub use eurocode8_shape::{GroundType, SpectrumShape, SpectrumType};
pub use frame_period::{FrameKind, PeriodCode, PeriodFormula, fundamental_period_s};
pub use ntc2018::{Ntc2018, NtcHazard, Topography};
pub use nzs1170_5::{
    Nzs1170_5, SubsoilClass, near_fault_ratio, return_period_factor, return_period_factors,
};
pub use table::{Interpolation, OutOfRange, SpectrumTable};
pub use tbdy2018::{Tbdy2018, TbdySite};
pub use ts1170_5::{Ts1170_5, TsSite, TsValues};

/// An elastic code spectrum at 5 % damping, with which motions are compared and to which they are
/// matched.
#[derive(Debug, Clone, PartialEq)]
pub enum CodeSpectrum {
    /// Australia.
    As1170_4(As1170_4),
    /// Europe, first generation.
    Eurocode8(Eurocode8),
    /// United States.
    Asce7(Asce7),
    /// New Zealand.
    Nzs1170_5(Nzs1170_5),
    /// Italy.
    Ntc2018(Ntc2018),
    /// Türkiye.
    Tbdy2018(Tbdy2018),
    /// New Zealand, from 2025.
    Ts1170_5(Ts1170_5),
    /// A table from the user.
    Table(SpectrumTable),
}

impl CodeSpectrum {
    /// Vertical spectral acceleration at 5 % damping \[g\]; `None` for a code whose vertical spectrum
    /// is not in this crate.
    pub fn vertical_sa_g(&self, period_s: f64) -> Option<f64> {
        match self {
            Self::Eurocode8(code) => Some(code.vertical_sa_g(period_s)),
            Self::Ntc2018(code) => Some(code.vertical_sa_g(period_s)),
            Self::Tbdy2018(code) => Some(code.vertical_sa_g(period_s)),
            Self::As1170_4(_)
            | Self::Asce7(_)
            | Self::Nzs1170_5(_)
            | Self::Ts1170_5(_)
            | Self::Table(_) => None,
        }
    }

    /// Spectral acceleration at 5 % damping \[g\].
    ///
    /// NaN for a negative period, and outside a table that is not extended: check
    /// [`Self::longest_period_s`] and [`Self::shortest_period_s`] first.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        match self {
            Self::As1170_4(code) => code.sa_g(period_s),
            Self::Eurocode8(code) => code.sa_g(period_s),
            Self::Asce7(code) => code.sa_g(period_s),
            Self::Nzs1170_5(code) => code.sa_g(period_s),
            Self::Ntc2018(code) => code.sa_g(period_s),
            Self::Tbdy2018(code) => code.sa_g(period_s),
            Self::Ts1170_5(code) => code.sa_g(period_s),
            Self::Table(table) => table.sa_g(period_s).unwrap_or(f64::NAN),
        }
    }

    /// The code with its edition.
    pub fn name(&self) -> &'static str {
        match self {
            Self::As1170_4(code) => code.edition().name(),
            Self::Eurocode8(_) => "EN 1998-1:2004",
            Self::Asce7(code) => code.edition().name(),
            Self::Nzs1170_5(_) => "NZS 1170.5:2004",
            Self::Ntc2018(_) => "NTC 2018",
            Self::Tbdy2018(_) => "TBDY 2018",
            Self::Ts1170_5(_) => "TS 1170.5:2025",
            Self::Table(_) => "user's table",
        }
    }

    /// The periods at which branches meet, ascending; those of a table are its own, without
    /// 0 \[s\].
    pub fn corner_periods_s(&self) -> Vec<f64> {
        match self {
            Self::As1170_4(code) => code.corner_periods_s().to_vec(),
            Self::Eurocode8(code) => code.corner_periods_s().to_vec(),
            Self::Asce7(code) => code.corner_periods_s().to_vec(),
            Self::Nzs1170_5(code) => code.corner_periods_s(),
            Self::Ntc2018(code) => code.corner_periods_s().to_vec(),
            Self::Tbdy2018(code) => code.corner_periods_s().to_vec(),
            Self::Ts1170_5(code) => code.corner_periods_s().to_vec(),
            Self::Table(table) => table
                .periods_s()
                .iter()
                .copied()
                .filter(|&period| period > 0.0)
                .collect(),
        }
    }

    /// The shortest period with a value: 0, except for a table that begins later and is not
    /// extended \[s\].
    pub fn shortest_period_s(&self) -> f64 {
        match self {
            Self::Table(table) => table.shortest_period_s(),
            _ => 0.0,
        }
    }

    /// The longest period with a value; `None` where there is no limit \[s\].
    ///
    /// The tables printed in codes end at about 5 s; their formulas continue, and so do these
    /// spectra.
    pub fn longest_period_s(&self) -> Option<f64> {
        match self {
            Self::Table(table) => table.longest_period_s(),
            _ => None,
        }
    }

    /// The largest spectral acceleration \[g\].
    pub fn plateau_g(&self) -> f64 {
        match self {
            Self::As1170_4(code) => code.plateau_g(),
            Self::Eurocode8(code) => code.plateau_g(),
            Self::Asce7(code) => code.sds_g(),
            Self::Nzs1170_5(code) => code.plateau_g(),
            Self::Ntc2018(code) => code.plateau_g(),
            Self::Tbdy2018(code) => code.sds_g(),
            Self::Ts1170_5(code) => code.values().sas_g,
            Self::Table(table) => table.sa_values_g().iter().copied().fold(0.0, f64::max),
        }
    }

    /// The site class or ground type as the code writes it; `None` where the code expresses it by
    /// factors.
    pub fn site_name(&self) -> Option<&'static str> {
        match self {
            Self::As1170_4(code) => Some(code.site().name()),
            Self::Eurocode8(code) => code.ground().map(GroundType::name),
            Self::Nzs1170_5(code) => Some(code.site().name()),
            Self::Asce7(code) => code.site().map(Asce7Site::name),
            Self::Ntc2018(code) => Some(code.ground().name()),
            Self::Tbdy2018(code) => Some(code.site().name()),
            Self::Ts1170_5(code) => Some(code.site().name()),
            Self::Table(_) => None,
        }
    }

    /// The return period \[years\], if it is a parameter of the code.
    pub fn return_period_years(&self) -> Option<u32> {
        match self {
            Self::As1170_4(code) => Some(code.return_period_years()),
            Self::Nzs1170_5(code) => Some(code.return_period_years()),
            Self::Ntc2018(code) => Some(code.return_period_years()),
            Self::Ts1170_5(code) => Some(code.return_period_years()),
            Self::Tbdy2018(code) => code.return_period_years(),
            Self::Eurocode8(code) => code.annex().map(NationalAnnex::return_period_years),
            _ => None,
        }
    }
}

impl From<As1170_4> for CodeSpectrum {
    fn from(code: As1170_4) -> Self {
        Self::As1170_4(code)
    }
}

impl From<Eurocode8> for CodeSpectrum {
    fn from(code: Eurocode8) -> Self {
        Self::Eurocode8(code)
    }
}

impl From<Asce7> for CodeSpectrum {
    fn from(code: Asce7) -> Self {
        Self::Asce7(code)
    }
}

impl From<Nzs1170_5> for CodeSpectrum {
    fn from(code: Nzs1170_5) -> Self {
        Self::Nzs1170_5(code)
    }
}

impl From<Ntc2018> for CodeSpectrum {
    fn from(code: Ntc2018) -> Self {
        Self::Ntc2018(code)
    }
}

impl From<Tbdy2018> for CodeSpectrum {
    fn from(code: Tbdy2018) -> Self {
        Self::Tbdy2018(code)
    }
}

impl From<Ts1170_5> for CodeSpectrum {
    fn from(code: Ts1170_5) -> Self {
        Self::Ts1170_5(code)
    }
}

impl From<SpectrumTable> for CodeSpectrum {
    fn from(table: SpectrumTable) -> Self {
        Self::Table(table)
    }
}

/// Why parameters do not define a code spectrum.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CodeSpectrumError {
    /// A site class that does not exist.
    #[error("there is no site class {name:?}; the classes are {known}")]
    SiteClass {
        /// The name that was given.
        name: String,
        /// The classes of the code, from hard to soft.
        known: &'static str,
    },
    /// The hazard design factor is not a positive finite number.
    #[error("the hazard design factor must be positive and finite, not {hazard_factor}")]
    HazardFactor {
        /// The factor that was given.
        hazard_factor: f64,
    },
    /// The return period is not in the code's table.
    #[error(
        "the code has no factor for a return period of {return_period_years} years, only for {known_years:?}"
    )]
    ReturnPeriod {
        /// The return period that was given.
        return_period_years: u32,
        /// Return periods of the code's table, ascending.
        known_years: Vec<u32>,
    },
    /// The height of a structure is not a positive finite number.
    #[error("the height must be positive and finite, not {height_m} m")]
    Height {
        /// The height that was given.
        height_m: f64,
    },
    /// Coefficients that the code leaves to a site-specific study.
    #[error(
        "ASCE 7-16, 11.4.8, requires a site-specific study for site class E where Ss is above 0.75 g or S1 at least \
         0.2 g; here Ss = {ss_g} g and S1 = {s1_g} g"
    )]
    SiteStudy {
        /// Mapped acceleration at short periods \[g\].
        ss_g: f64,
        /// Mapped acceleration at 1 s \[g\].
        s1_g: f64,
    },
    /// A parameter that is out of range.
    #[error("{name} must be {requirement}, not {value}")]
    Parameter {
        /// Its symbol in the code.
        name: &'static str,
        /// The requirement that it does not meet.
        requirement: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A row of a table that is out of range.
    #[error("row {row} of the table (period {period_s} s, Sa {sa_g} g): {requirement}")]
    TableRow {
        /// The row, counted from 1.
        row: usize,
        /// Its period \[s\].
        period_s: f64,
        /// Its acceleration \[g\].
        sa_g: f64,
        /// The requirement that it does not meet.
        requirement: &'static str,
    },
    /// A table whose columns differ in length, or that has fewer than two rows.
    #[error(
        "a table needs at least two periods and as many accelerations: the number of periods is {periods}, that of \
         accelerations {accelerations}"
    )]
    TableLength {
        /// Number of periods.
        periods: usize,
        /// Number of accelerations.
        accelerations: usize,
    },
}

/// Checks that a parameter is positive and finite.
fn positive(name: &'static str, value: f64) -> Result<f64, CodeSpectrumError> {
    let fine = value > 0.0 && value.is_finite();
    within(fine, name, "positive and finite", value)
}

/// The value of a parameter.
///
/// # Errors
/// A value that is not `fine`.
fn within(
    fine: bool,
    name: &'static str,
    requirement: &'static str,
    value: f64,
) -> Result<f64, CodeSpectrumError> {
    fine.then_some(value).ok_or(CodeSpectrumError::Parameter {
        name,
        requirement,
        value,
    })
}

/// The class of a site with a given name, in upper or lower case; `known` lists them.
///
/// # Errors
/// Another name.
fn class_named<T: Copy + Into<&'static str>>(
    all: &[T],
    name: &str,
    known: &'static str,
) -> Result<T, CodeSpectrumError> {
    let mut all = all.iter().copied();
    all.find(|&class| class.into().eq_ignore_ascii_case(name.trim()))
        .ok_or_else(|| CodeSpectrumError::SiteClass {
            name: name.to_owned(),
            known,
        })
}

#[cfg(test)]
mod tests;
