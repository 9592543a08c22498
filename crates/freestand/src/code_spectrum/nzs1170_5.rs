//! NZS 1170.5:2004, New Zealand.

use super::{CodeSpectrumError, class_named, positive, within};

/// Site subsoil class of NZS 1170.5, clause 3.1.3.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
pub enum SubsoilClass {
    /// Strong rock.
    A,
    /// Rock.
    B,
    /// Shallow soil.
    C,
    /// Deep or soft soil.
    D,
    /// Very soft soil.
    E,
}

/// Constants of Ch(T): at T = 0, plateau, its end \[s\], `c (t₀/T)^0.75` up to 1.5 s, `d/T` up to
/// 3 s, `3 d/T²` above.
struct Shape {
    zero: f64,
    plateau: f64,
    plateau_end_s: f64,
    middle: (f64, f64),
    velocity: f64,
}

/// Period at which the plateau begins in every class \[s\].
const PLATEAU_START_S: f64 = 0.1;
/// Period at which `d/T` begins \[s\].
const VELOCITY_START_S: f64 = 1.5;
/// Period at which `3 d/T²` begins \[s\].
const DISPLACEMENT_START_S: f64 = 3.0;

impl SubsoilClass {
    /// All classes, from hard to soft.
    pub const ALL: [Self; 5] = [Self::A, Self::B, Self::C, Self::D, Self::E];

    /// The class as the code writes it.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The class in words.
    pub fn description(self) -> &'static str {
        match self {
            Self::A => "strong rock",
            Self::B => "rock",
            Self::C => "shallow soil",
            Self::D => "deep or soft soil",
            Self::E => "very soft soil",
        }
    }

    /// The class with a given name, in upper or lower case.
    ///
    /// # Errors
    /// A name that is not one of the five classes.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "A, B, C, D, E")
    }

    fn shape(self) -> Shape {
        let (zero, plateau, plateau_end_s, middle, velocity) = match self {
            Self::A | Self::B => (1.0, 2.35, 0.3, (1.6, 0.5), 1.05),
            Self::C => (1.33, 2.93, 0.3, (2.0, 0.5), 1.32),
            Self::D => (1.12, 3.0, 0.56, (2.4, 0.75), 2.14),
            Self::E => (1.12, 3.0, 1.0, (3.0, 1.0), 3.32),
        };
        Shape {
            zero,
            plateau,
            plateau_end_s,
            middle,
            velocity,
        }
    }

    /// Spectral shape factor Ch(T) for modal and time-history analysis, 5 % damping. NaN for a
    /// negative period.
    ///
    /// # Reference
    /// NZS 1170.5:2004, Table 3.1 and the formulas of its commentary.
    ///
    /// # Limitation
    /// The constants are rounded, so branches do not meet exactly: the step is −0.13 % (A, B) and
    /// −0.4 % (D) at the end of the plateau, and −0.27 % (A, B), +0.30 % (C), −0.03 % (D) at 1.5 s.
    /// Class D is not interpolated towards C by the period of the site.
    ///
    /// # Example
    /// ```
    /// use freestand::code_spectrum::SubsoilClass;
    /// assert_eq!(SubsoilClass::C.shape_factor_ratio(0.0), 1.33);
    /// assert_eq!(SubsoilClass::C.shape_factor_ratio(0.5), 2.0);
    /// assert_eq!(SubsoilClass::C.shape_factor_ratio(2.0), 0.66);
    /// ```
    pub fn shape_factor_ratio(self, period_s: f64) -> f64 {
        let Shape {
            zero,
            plateau,
            plateau_end_s,
            middle: (c, t0_s),
            velocity,
        } = self.shape();
        match period_s {
            t if (0.0..PLATEAU_START_S).contains(&t) => {
                zero + (plateau - zero) * t / PLATEAU_START_S
            }
            t if t >= PLATEAU_START_S && t <= plateau_end_s => plateau,
            // Class C begins 0.1 % above its plateau, so it is limited to the plateau.
            t if t > plateau_end_s && t <= VELOCITY_START_S => {
                (c * (t0_s / t).powf(0.75)).min(plateau)
            }
            t if t > VELOCITY_START_S && t <= DISPLACEMENT_START_S => velocity / t,
            t if t > DISPLACEMENT_START_S => velocity * DISPLACEMENT_START_S / (t * t),
            _ => f64::NAN,
        }
    }
}

/// NZS 1170.5, Table 3.5: return period \[years\] and return period factor R.
const RETURN_PERIOD_FACTORS: [(u32, f64); 9] = [
    (20, 0.20),
    (25, 0.25),
    (50, 0.35),
    (100, 0.5),
    (250, 0.75),
    (500, 1.0),
    (1000, 1.3),
    (2000, 1.7),
    (2500, 1.8),
];

/// Largest value of Z·R, by clause 3.1.1 \[g\].
const LARGEST_ZR_G: f64 = 0.7;

/// Up to this R the code ignores near faults.
const LARGEST_R_WITHOUT_FAULT: f64 = 0.75;

/// Return period factor R; the period must be in the code's table.
///
/// # Reference
/// NZS 1170.5:2004, Table 3.5.
///
/// # Errors
/// Any other return period; the error lists those in the table.
pub fn return_period_factor(return_period_years: u32) -> Result<f64, CodeSpectrumError> {
    let known = RETURN_PERIOD_FACTORS
        .iter()
        .find(|&&(years, _)| years == return_period_years);
    known
        .map(|&(_, factor)| factor)
        .ok_or_else(|| CodeSpectrumError::ReturnPeriod {
            return_period_years,
            known_years: RETURN_PERIOD_FACTORS
                .iter()
                .map(|&(years, _)| years)
                .collect(),
        })
}

/// Return periods \[years\] and their factors R, both rising.
///
/// # Reference
/// NZS 1170.5:2004, Table 3.5.
pub fn return_period_factors() -> &'static [(u32, f64)] {
    &RETURN_PERIOD_FACTORS
}

/// Near-fault factor N(T, D) for the distance D to one of the code's major faults; 1 for return periods
/// with R ≤ 0.75, for which the code ignores near faults.
///
/// Nmax up to 2 km, `1 + (Nmax − 1)(20 − D)/18` up to 20 km, 1 above, with Nmax(T) = 1 up to 1.5 s,
/// 0.24 T + 0.64 up to 4 s, 0.12 T + 1.12 up to 5 s, 1.72 above.
///
/// # Reference
/// NZS 1170.5:2004, clause 3.1.6 and Table 3.7.
///
/// # Example
/// At 3 s and 11 km Nmax = 1.36, and half of its excess over 1 remains: N = 1.18 for 500 years (R = 1)
/// and 1 for 250 years (R = 0.75).
/// ```
/// use freestand::code_spectrum::near_fault_ratio;
/// assert!((near_fault_ratio(3.0, 11.0, 1.0) - 1.18).abs() < 1e-15);
/// assert_eq!(near_fault_ratio(3.0, 11.0, 0.75), 1.0);
/// ```
pub fn near_fault_ratio(period_s: f64, fault_distance_km: f64, return_factor_ratio: f64) -> f64 {
    if return_factor_ratio <= LARGEST_R_WITHOUT_FAULT {
        return 1.0;
    }
    let largest = match period_s {
        t if t <= 1.5 => 1.0,
        t if t <= 4.0 => 0.24 * t + 0.64,
        t if t <= 5.0 => 0.12 * t + 1.12,
        _ => 1.72,
    };
    let share = ((20.0 - fault_distance_km) / 18.0).clamp(0.0, 1.0);
    1.0 + (largest - 1.0) * share
}

/// An elastic site spectrum of NZS 1170.5, 5 % damping: `C(T) = Ch(T) Z R N(T, D)` in g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nzs1170_5 {
    site: SubsoilClass,
    hazard_factor: f64,
    return_period_years: u32,
    return_factor_ratio: f64,
    fault_distance_km: Option<f64>,
}

impl Nzs1170_5 {
    /// The spectrum of a site. Without a distance N = 1: there is no major fault nearby.
    ///
    /// # Reference
    /// NZS 1170.5:2004, Eq. (3.1(1)): `Z R ≤ 0.7`; N = 1 for R ≤ 0.75 and beyond 20 km.
    ///
    /// # Errors
    /// A hazard factor that is not positive and finite, a return period that is not in the code's
    /// table, or a distance that is negative or not finite.
    ///
    /// # Example
    /// Wellington (Z = 0.40), class C, 500 years, far from a fault:
    /// ```
    /// use freestand::code_spectrum::{Nzs1170_5, SubsoilClass};
    /// let code = Nzs1170_5::new(SubsoilClass::C, 0.40, 500, None)?;
    /// assert!((code.sa_g(0.2) - 1.172).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        site: SubsoilClass,
        hazard_factor: f64,
        return_period_years: u32,
        fault_distance_km: Option<f64>,
    ) -> Result<Self, CodeSpectrumError> {
        positive("the hazard factor Z", hazard_factor)?;
        let return_factor_ratio = return_period_factor(return_period_years)?;
        if let Some(km) = fault_distance_km {
            let (name, requirement) = ("the distance to the fault in km", "at least 0 and finite");
            within(km >= 0.0 && km.is_finite(), name, requirement, km)?;
        }
        Ok(Self {
            site,
            hazard_factor,
            return_period_years,
            return_factor_ratio,
            fault_distance_km,
        })
    }

    /// Site subsoil class.
    pub fn site(&self) -> SubsoilClass {
        self.site
    }

    /// Hazard factor Z as given \[g\].
    pub fn hazard_factor(&self) -> f64 {
        self.hazard_factor
    }

    /// Return period \[years\].
    pub fn return_period_years(&self) -> u32 {
        self.return_period_years
    }

    /// Return period factor R.
    pub fn return_factor_ratio(&self) -> f64 {
        self.return_factor_ratio
    }

    /// Distance to the nearest major fault \[km\], if one was given.
    pub fn fault_distance_km(&self) -> Option<f64> {
        self.fault_distance_km
    }

    /// Z·R, at most 0.7 \[g\].
    pub fn zr_g(&self) -> f64 {
        (self.hazard_factor * self.return_factor_ratio).min(LARGEST_ZR_G)
    }

    /// Whether the code's largest Z·R replaced the product.
    pub fn maximum_governs(&self) -> bool {
        self.hazard_factor * self.return_factor_ratio > LARGEST_ZR_G
    }

    /// Whether a near fault raises the spectrum anywhere.
    pub fn is_near_fault(&self) -> bool {
        self.return_factor_ratio > LARGEST_R_WITHOUT_FAULT
            && self.fault_distance_km.is_some_and(|km| km < 20.0)
    }

    /// The plateau, which ends below the periods that near faults affect \[g\].
    pub fn plateau_g(&self) -> f64 {
        self.zr_g() * self.site.shape().plateau
    }

    /// The periods at which branches of Ch(T) meet and, with a near fault, those of N(T, D),
    /// ascending \[s\].
    pub fn corner_periods_s(&self) -> Vec<f64> {
        let mut corners = vec![
            PLATEAU_START_S,
            self.site.shape().plateau_end_s,
            VELOCITY_START_S,
            DISPLACEMENT_START_S,
        ];
        if self.is_near_fault() {
            corners.extend([4.0, 5.0]);
        }
        corners
    }

    /// Spectral acceleration `C(T)`, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        let near_fault = self.fault_distance_km.map_or(1.0, |km| {
            near_fault_ratio(period_s, km, self.return_factor_ratio)
        });
        self.site.shape_factor_ratio(period_s) * self.zr_g() * near_fault
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIODS_S: [f64; 18] = [
        0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5,
    ];

    /// NZS 1170.5:2004, Table 3.1, as printed by a public Python script (the formulas come from
    /// another source).
    #[test]
    fn shape_factors_are_those_of_table_3_1() {
        let rock = [
            1.0, 2.35, 2.35, 2.35, 1.89, 1.60, 1.40, 1.24, 1.12, 1.03, 0.95, 0.70, 0.53, 0.42,
            0.35, 0.26, 0.20, 0.16,
        ];
        let shallow = [
            1.33, 2.93, 2.93, 2.93, 2.36, 2.00, 1.74, 1.55, 1.41, 1.29, 1.19, 0.88, 0.66, 0.53,
            0.44, 0.32, 0.25, 0.20,
        ];
        let deep = [
            1.12, 3.0, 3.0, 3.0, 3.0, 3.0, 2.84, 2.53, 2.29, 2.09, 1.93, 1.43, 1.07, 0.86, 0.71,
            0.52, 0.40, 0.32,
        ];
        let soft = [
            1.12, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 2.21, 1.66, 1.33, 1.11, 0.81,
            0.62, 0.49,
        ];
        for (class, printed) in SubsoilClass::ALL
            .into_iter()
            .zip([rock, rock, shallow, deep, soft])
        {
            for (period_s, printed) in PERIODS_S.into_iter().zip(printed) {
                let got = class.shape_factor_ratio(period_s);
                // Half a unit of the last printed digit.
                assert!(
                    (got - printed).abs() <= 0.005 + 1e-12,
                    "{class:?} {period_s}: {got} {printed}"
                );
            }
        }
    }

    #[test]
    fn steps_between_branches_are_those_of_the_rounded_constants() {
        // By hand, e.g. A: 1.6 (0.5/0.3)^0.75 = 2.34693 over 2.35, and 0.7 over 1.6/3^0.75 =
        // 0.701906.
        let steps = [
            (SubsoilClass::A, 0.3, -0.0013),
            (SubsoilClass::C, 0.3, 0.0),
            (SubsoilClass::D, 0.56, -0.0040),
            (SubsoilClass::E, 1.0, 0.0),
            (SubsoilClass::A, 1.5, -0.0027),
            (SubsoilClass::C, 1.5, 0.0030),
            (SubsoilClass::D, 1.5, -0.0003),
            (SubsoilClass::E, 1.5, 0.0),
        ];
        for (class, corner, want) in steps {
            let step = class.shape_factor_ratio(f64::next_up(corner))
                / class.shape_factor_ratio(corner)
                - 1.0;
            // Steps to four digits.
            assert!((step - want).abs() < 6e-5, "{class:?} {corner}: {step}");
        }
        for class in SubsoilClass::ALL {
            for corner in [PLATEAU_START_S, DISPLACEMENT_START_S] {
                let step = class.shape_factor_ratio(corner.next_up())
                    / class.shape_factor_ratio(corner.next_down());
                assert!((step - 1.0).abs() < 1e-14, "{class:?} {corner}");
            }
        }
    }

    /// Table 3.7 has Nmax 1, 1.12, 1.36, 1.60, 1.72 at 1.5, 2, 3, 4, 5 s.
    #[test]
    fn near_faults_raise_long_periods() {
        for (period_s, largest) in [
            (0.5, 1.0),
            (1.5, 1.0),
            (2.0, 1.12),
            (3.0, 1.36),
            (4.0, 1.60),
            (5.0, 1.72),
            (9.0, 1.72),
        ] {
            assert!(
                (near_fault_ratio(period_s, 0.0, 1.0) - largest).abs() < 1e-15,
                "{period_s}"
            );
            assert!(
                (near_fault_ratio(period_s, 2.0, 1.0) - largest).abs() < 1e-15,
                "{period_s}"
            );
            assert_eq!(near_fault_ratio(period_s, 20.0, 1.0), 1.0);
            assert_eq!(near_fault_ratio(period_s, 300.0, 1.0), 1.0);
        }
        let far = Nzs1170_5::new(SubsoilClass::C, 0.4, 500, None).unwrap();
        let near = Nzs1170_5::new(SubsoilClass::C, 0.4, 500, Some(2.0)).unwrap();
        // 0.44 · 0.4 = 0.176 at 3 s, and 1.36 times it.
        assert!((far.sa_g(3.0) - 0.176).abs() < 1e-15 && (near.sa_g(3.0) - 0.239_36).abs() < 1e-15);
        // R = 0.75: the code ignores faults.
        let frequent = Nzs1170_5::new(SubsoilClass::C, 0.4, 250, Some(2.0)).unwrap();
        assert!((frequent.sa_g(3.0) - 0.75 * 0.176).abs() < 1e-15 && !frequent.is_near_fault());
        assert!(near.is_near_fault() && near.corner_periods_s().len() == 6);
    }

    #[test]
    fn the_product_of_z_and_r_ends_at_0_7() {
        // Otira, Z = 0.60: R = 1.3 would be 0.78.
        let code = Nzs1170_5::new(SubsoilClass::B, 0.60, 1000, None).unwrap();
        assert!(code.maximum_governs());
        assert!((code.sa_g(0.0) - 0.7).abs() < 1e-15 && (code.sa_g(0.2) - 1.645).abs() < 1e-15);
        assert!(
            !Nzs1170_5::new(SubsoilClass::B, 0.60, 500, None)
                .unwrap()
                .maximum_governs()
        );
    }

    #[test]
    fn wrong_values_are_refused() {
        for (z, years, km) in [
            (0.0, 500, None),
            (f64::NAN, 500, None),
            (0.4, 475, None),
            (0.4, 500, Some(-1.0)),
            (0.4, 500, Some(f64::INFINITY)),
        ] {
            assert!(
                Nzs1170_5::new(SubsoilClass::C, z, years, km).is_err(),
                "{z} {years} {km:?}"
            );
        }
        assert!(
            SubsoilClass::parse("f").is_err() && SubsoilClass::parse("d") == Ok(SubsoilClass::D)
        );
    }
}
