//! AS 1170.4, Australia.

use super::{CodeSpectrumError, class_named};

/// Edition of AS 1170.4.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Edition {
    /// AS 1170.4—2007 with Amendments 1 and 2 (2018): hazard design factors and minimum kpZ of
    /// Amendment 2.
    #[default]
    As1170_4Ed2007Amd2,
    /// AS 1170.4:2024. According to one public tool its spectral shape is that of 2007. Its tables
    /// were not available; the tables of 2007 with Amendment 2 are used instead.
    As1170_4Ed2024Unconfirmed,
}

impl Edition {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::As1170_4Ed2007Amd2 => "AS 1170.4-2007 (Amdt 1, 2)",
            Self::As1170_4Ed2024Unconfirmed => "AS 1170.4:2024 (not confirmed)",
        }
    }
}

/// Site sub-soil class of AS 1170.4, clause 4.2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
pub enum SiteClass {
    /// Strong rock.
    Ae,
    /// Rock.
    Be,
    /// Shallow soil.
    Ce,
    /// Deep or soft soil.
    De,
    /// Very soft soil.
    Ee,
}

impl SiteClass {
    /// All classes, from hard to soft.
    pub const ALL: [Self; 5] = [Self::Ae, Self::Be, Self::Ce, Self::De, Self::Ee];

    /// The class as the code writes it, for example `"De"`.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The class in words.
    pub fn description(self) -> &'static str {
        match self {
            Self::Ae => "strong rock",
            Self::Be => "rock",
            Self::Ce => "shallow soil",
            Self::De => "deep or soft soil",
            Self::Ee => "very soft soil",
        }
    }

    /// The class with a given name, in upper or lower case, for example `"De"` or `"de"`.
    ///
    /// # Errors
    /// A name that is not one of the five classes.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "Ae, Be, Ce, De, Ee")
    }

    /// Spectral shape factor Ch(T), 5 % damping, as a ratio to the rock (Be) acceleration at T = 0.
    ///
    /// `a + b T` up to 0.1 s, `min(c/T, plateau)` up to 1.5 s, `d/T²` above. NaN for a negative
    /// period.
    ///
    /// # Reference
    /// AS 1170.4—2007, clause 6.4 and Table 6.4 (below 0.1 s the branch for dynamic analysis).
    ///
    /// # Limitation
    /// The printed table ends at 5 s and is rounded (up to 3 % from the formula); class Ce has a
    /// step of 0.05 % at 1.5 s.
    ///
    /// # Example
    /// ```
    /// use freestand::code_spectrum::SiteClass;
    /// assert_eq!(SiteClass::De.shape_factor_ratio(0.0), 1.1);
    /// assert_eq!(SiteClass::De.shape_factor_ratio(0.3), 3.68);
    /// assert_eq!(SiteClass::De.shape_factor_ratio(1.0), 1.98);
    /// ```
    pub fn shape_factor_ratio(self, period_s: f64) -> f64 {
        let Shape {
            zero,
            rise,
            plateau,
            velocity,
            displacement,
        } = self.shape();
        match period_s {
            t if (0.0..=PLATEAU_START_S).contains(&t) => zero + rise * t,
            t if t > PLATEAU_START_S && t <= DISPLACEMENT_START_S => (velocity / t).min(plateau),
            t if t > DISPLACEMENT_START_S => displacement / (t * t),
            _ => f64::NAN,
        }
    }

    fn shape(self) -> Shape {
        let (zero, rise, plateau, velocity, displacement) = match self {
            Self::Ae => (0.8, 15.5, 2.35, 0.704, 1.056),
            Self::Be => (1.0, 19.4, 2.94, 0.88, 1.32),
            Self::Ce => (1.3, 23.8, 3.68, 1.25, 1.874),
            Self::De => (1.1, 25.8, 3.68, 1.98, 2.97),
            Self::Ee => (1.1, 25.8, 3.68, 3.08, 4.62),
        };
        Shape {
            zero,
            rise,
            plateau,
            velocity,
            displacement,
        }
    }
}

/// Constants of Ch(T): `zero + rise T`, `plateau`, `velocity/T`, `displacement/T²`.
struct Shape {
    zero: f64,
    rise: f64,
    plateau: f64,
    velocity: f64,
    displacement: f64,
}

/// Period at which the plateau begins in every class \[s\].
const PLATEAU_START_S: f64 = 0.1;
/// Period at which constant displacement begins in every class \[s\].
const DISPLACEMENT_START_S: f64 = 1.5;

/// AS 1170.4, Table 3.1: return period \[years\] and probability factor kp.
const PROBABILITY_FACTORS: [(u32, f64); 12] = [
    (20, 0.20),
    (25, 0.25),
    (50, 0.35),
    (100, 0.50),
    (200, 0.70),
    (250, 0.75),
    (500, 1.0),
    (800, 1.25),
    (1000, 1.3),
    (1500, 1.5),
    (2000, 1.7),
    (2500, 1.8),
];

/// AS 1170.4, Table 3.3 (Amendment 2): return period \[years\] and smallest value of kp·Z.
const MINIMUM_KPZ: [(u32, f64); 5] = [
    (500, 0.08),
    (1000, 0.10),
    (1500, 0.12),
    (2000, 0.14),
    (2500, 0.15),
];

/// Probability factor kp of a return period; the period must be in the code's table.
///
/// # Reference
/// AS 1170.4—2007, Table 3.1.
///
/// # Errors
/// Any other return period; the error lists those in the table.
///
/// # Example
/// ```
/// assert_eq!(freestand::code_spectrum::probability_factor(2500), Ok(1.8));
/// ```
pub fn probability_factor(return_period_years: u32) -> Result<f64, CodeSpectrumError> {
    PROBABILITY_FACTORS
        .iter()
        .find(|&&(years, _)| years == return_period_years)
        .map(|&(_, kp)| kp)
        .ok_or_else(|| CodeSpectrumError::ReturnPeriod {
            return_period_years,
            known_years: PROBABILITY_FACTORS
                .iter()
                .map(|&(years, _)| years)
                .collect(),
        })
}

/// Return periods \[years\] and their probability factors kp, both rising.
///
/// # Reference
/// AS 1170.4—2007, Table 3.1.
pub fn probability_factors() -> &'static [(u32, f64)] {
    &PROBABILITY_FACTORS
}

/// Smallest value of kp·Z for a return period; `None` where the code's table has none (below
/// 500 years, and 800).
///
/// # Reference
/// AS 1170.4—2007 Amendment 2, Table 3.3.
pub fn minimum_kpz(return_period_years: u32) -> Option<f64> {
    MINIMUM_KPZ
        .iter()
        .find(|&&(years, _)| years == return_period_years)
        .map(|&(_, least)| least)
}

/// An elastic site spectrum of AS 1170.4, 5 % damping: `Sa(T) = kpZ · Ch(T)` in g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct As1170_4 {
    edition: Edition,
    site: SiteClass,
    hazard_factor: f64,
    return_period_years: u32,
    kpz_g: f64,
    minimum_governs: bool,
}

impl As1170_4 {
    /// The spectrum of a site: `kpZ = max(kp·Z, minimum)`.
    ///
    /// # Reference
    /// AS 1170.4—2007 with Amendment 2, clauses 3.1–3.3 and 6.4.
    ///
    /// # Limitation
    /// Where the code tabulates no minimum of kpZ (return periods below 500 years, and 800 years),
    /// none is applied.
    ///
    /// # Errors
    /// A hazard factor that is not positive and finite, or a return period that is not in the
    /// code's table.
    ///
    /// # Example
    /// Melbourne, deep soil, 500 years:
    /// ```
    /// use freestand::code_spectrum::{As1170_4, Edition, SiteClass};
    /// let spectrum = As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)?;
    /// assert!((spectrum.sa_g(0.3) - 0.2944).abs() < 1e-15);
    /// assert!((spectrum.sa_g(1.0) - 0.1584).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        edition: Edition,
        site: SiteClass,
        hazard_factor: f64,
        return_period_years: u32,
    ) -> Result<Self, CodeSpectrumError> {
        if !(hazard_factor > 0.0 && hazard_factor.is_finite()) {
            return Err(CodeSpectrumError::HazardFactor { hazard_factor });
        }
        let kpz = probability_factor(return_period_years)? * hazard_factor;
        let least = minimum_kpz(return_period_years).unwrap_or(0.0);
        Ok(Self {
            edition,
            site,
            hazard_factor,
            return_period_years,
            kpz_g: kpz.max(least),
            minimum_governs: kpz < least,
        })
    }

    /// Edition of the code.
    pub fn edition(&self) -> Edition {
        self.edition
    }

    /// Site class.
    pub fn site(&self) -> SiteClass {
        self.site
    }

    /// Hazard design factor Z as given \[g\].
    pub fn hazard_factor(&self) -> f64 {
        self.hazard_factor
    }

    /// Return period \[years\].
    pub fn return_period_years(&self) -> u32 {
        self.return_period_years
    }

    /// kp·Z, at least the code's minimum \[g\].
    pub fn kpz_g(&self) -> f64 {
        self.kpz_g
    }

    /// Whether the minimum of kp·Z replaced the product.
    pub fn minimum_governs(&self) -> bool {
        self.minimum_governs
    }

    /// The plateau of the spectrum, which includes 0.2 s in every site class \[g\].
    pub fn plateau_g(&self) -> f64 {
        self.sa_g(0.2)
    }

    /// Beginning and end of the plateau, and beginning of constant displacement \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        let Shape {
            plateau, velocity, ..
        } = self.site.shape();
        [PLATEAU_START_S, velocity / plateau, DISPLACEMENT_START_S]
    }

    /// Spectral acceleration `Sa(T) = kpZ · Ch(T)`, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        self.kpz_g * self.site.shape_factor_ratio(period_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::G0_M_S2;
    use std::f64::consts::{PI, TAU};

    fn melbourne() -> As1170_4 {
        As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500).unwrap()
    }

    #[test]
    fn shape_factors_are_those_of_table_6_4() {
        const PERIODS_S: [f64; 21] = [
            0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 1.7, 2.0, 2.5, 3.0,
            3.5, 4.0, 4.5, 5.0,
        ];
        // AS 1170.4—2007, Table 6.4.
        let table = [
            (
                SiteClass::Ae,
                [
                    0.8, 2.35, 2.35, 2.35, 1.76, 1.41, 1.17, 1.01, 0.88, 0.78, 0.70, 0.59, 0.47,
                    0.37, 0.26, 0.17, 0.12, 0.086, 0.066, 0.052, 0.042,
                ],
            ),
            (
                SiteClass::Be,
                [
                    1.0, 2.94, 2.94, 2.94, 2.20, 1.76, 1.47, 1.26, 1.10, 0.98, 0.88, 0.73, 0.59,
                    0.46, 0.33, 0.21, 0.15, 0.11, 0.083, 0.065, 0.053,
                ],
            ),
            (
                SiteClass::Ce,
                [
                    1.3, 3.68, 3.68, 3.68, 3.12, 2.50, 2.08, 1.79, 1.56, 1.39, 1.25, 1.04, 0.83,
                    0.65, 0.47, 0.30, 0.21, 0.15, 0.12, 0.093, 0.075,
                ],
            ),
            (
                SiteClass::De,
                [
                    1.1, 3.68, 3.68, 3.68, 3.68, 3.68, 3.30, 2.83, 2.48, 2.20, 1.98, 1.65, 1.32,
                    1.03, 0.74, 0.48, 0.33, 0.24, 0.19, 0.15, 0.12,
                ],
            ),
            (
                SiteClass::Ee,
                [
                    1.1, 3.68, 3.68, 3.68, 3.68, 3.68, 3.68, 3.68, 3.68, 3.42, 3.08, 2.57, 2.05,
                    1.60, 1.16, 0.74, 0.51, 0.38, 0.29, 0.23, 0.18,
                ],
            ),
        ];
        for (class, factors) in table {
            for (period_s, printed) in PERIODS_S.into_iter().zip(factors) {
                let got = class.shape_factor_ratio(period_s);
                // The table has two decimals, three below 0.1: half a unit of the last. At 0.3 s it
                // prints its plateau, where the constants c give 2.933; they have only enough
                // digits (0.88 stands for anything up to 0.885) for half a digit, 0.57 %, which is
                // added.
                let half_unit = if printed < 0.1 { 0.0005 } else { 0.005 };
                assert!(
                    (got - printed).abs() <= half_unit + 0.0057 * printed,
                    "{class:?} {period_s}: {got} {printed}"
                );
            }
        }
    }

    #[test]
    fn corners_are_where_the_branches_meet() {
        let ends_s = [
            (SiteClass::Ae, 0.2996),
            (SiteClass::Be, 0.2993),
            (SiteClass::Ce, 0.3397),
        ];
        for (class, end_s) in ends_s
            .into_iter()
            .chain([(SiteClass::De, 0.5380), (SiteClass::Ee, 0.8370)])
        {
            let plateau = class.shape_factor_ratio(0.2);
            let spectrum = As1170_4::new(Edition::default(), class, 0.08, 500).unwrap();
            assert_eq!(
                [
                    spectrum.corner_periods_s()[0],
                    spectrum.corner_periods_s()[2]
                ],
                [0.1, 1.5]
            );
            assert!((spectrum.corner_periods_s()[1] - end_s).abs() < 5e-5);
            // The ends have 4 digits, so the plateau still applies 1e-4 s before and no longer
            // 1e-4 s after.
            assert_eq!(class.shape_factor_ratio(end_s - 1e-4), plateau);
            assert!(class.shape_factor_ratio(end_s + 1e-4) < plateau);
            // At 1.5 s c/T meets d/T² exactly, except for class Ce, whose constants leave a step of
            // 0.05 %.
            let step =
                class.shape_factor_ratio(1.5_f64.next_up()) / class.shape_factor_ratio(1.5) - 1.0;
            let want = if class == SiteClass::Ce {
                1.874 / 1.875 - 1.0
            } else {
                0.0
            };
            assert!((step - want).abs() < 1e-14, "{class:?}: {step}");
            // At 0.1 s the rise meets the plateau, up to the rounding of Ae (2.35) to the last
            // digit.
            assert!((class.shape_factor_ratio(0.1) - plateau).abs() < 1e-14);
        }
        assert!(
            SiteClass::De.shape_factor_ratio(-0.1).is_nan()
                && SiteClass::De.shape_factor_ratio(f64::NAN).is_nan()
        );
    }

    #[test]
    fn melbourne_500_years_class_de() {
        let spectrum = melbourne();
        assert_eq!(
            (spectrum.kpz_g(), spectrum.minimum_governs()),
            (0.08, false)
        );
        for (period_s, sa_g) in [
            (0.0, 0.088),
            (0.1, 0.2944),
            (0.538, 0.2944),
            (1.0, 0.1584),
            (1.5, 0.1056),
            (2.0, 0.0594),
        ] {
            // Two or three multiplications.
            assert!((spectrum.sa_g(period_s) - sa_g).abs() < 1e-15, "{period_s}");
        }
        // Constant displacement above 1.5 s and constant pseudo-velocity below, each to its last
        // printed digit.
        for period_s in [1.6, 3.0, 5.0] {
            let sd_m = spectrum.sa_g(period_s) * G0_M_S2 * (period_s / TAU).powi(2);
            assert!((sd_m - 0.0590).abs() < 0.00005, "{sd_m}");
        }
        for period_s in [0.6, 1.0, 1.5] {
            let psv_m_s = spectrum.sa_g(period_s) * G0_M_S2 * period_s / (2.0 * PI);
            assert!((psv_m_s - 0.247).abs() < 0.0005, "{psv_m_s}");
        }
        assert!((spectrum.sa_g(0.3) / spectrum.sa_g(0.0) - 3.68 / 1.1).abs() < 1e-14);
    }

    #[test]
    fn the_minimum_lifts_low_hazard() {
        let cases = [
            // Z, years, kpZ, minimum governs: Hobart, Brisbane, Melbourne and Adelaide
            (0.03, 500, 0.08, true),
            (0.05, 500, 0.08, true),
            (0.03, 2500, 0.15, true),
            (0.08, 1000, 0.104, false),
            (0.08, 1500, 0.12, false),
            (0.08, 2000, 0.14, true),
            (0.08, 2500, 0.15, true),
            (0.10, 2500, 0.18, false),
            (0.03, 100, 0.015, false),
            (0.03, 800, 0.0375, false),
        ];
        for (z, years, kpz, governs) in cases {
            let spectrum = As1170_4::new(Edition::default(), SiteClass::Be, z, years).unwrap();
            // One multiplication.
            assert!((spectrum.kpz_g() - kpz).abs() < 1e-15, "{z} {years}");
            assert_eq!(spectrum.minimum_governs(), governs, "{z} {years}");
        }
    }

    #[test]
    fn lookups_take_any_case_and_refuse_the_unknown() {
        assert_eq!(SiteClass::parse("de"), Ok(SiteClass::De));
        assert_eq!(SiteClass::parse(" EE "), Ok(SiteClass::Ee));
        assert!(
            matches!(SiteClass::parse("D"), Err(CodeSpectrumError::SiteClass { name, .. }) if name == "D")
        );
        let refused = probability_factor(475);
        assert!(
            matches!(refused, Err(CodeSpectrumError::ReturnPeriod { return_period_years: 475, known_years })
                if known_years == [20, 25, 50, 100, 200, 250, 500, 800, 1000, 1500, 2000, 2500])
        );
        let factor = As1170_4::new(Edition::default(), SiteClass::De, 0.0, 500);
        assert_eq!(
            factor,
            Err(CodeSpectrumError::HazardFactor { hazard_factor: 0.0 })
        );
    }

    #[test]
    fn the_edition_of_2024_has_the_shape_of_2007() {
        let new =
            As1170_4::new(Edition::As1170_4Ed2024Unconfirmed, SiteClass::De, 0.08, 500).unwrap();
        assert_eq!(new.sa_g(0.7), melbourne().sa_g(0.7));
        assert!(new.edition().name().contains("not confirmed"));
    }
}
