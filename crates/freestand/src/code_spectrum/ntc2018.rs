//! NTC 2018, Italy: the elastic spectrum from ag, F0 and Tc* of a point and a return period.

use super::eurocode8::shape_ratio;
use super::{CodeSpectrumError, GroundType, class_named, positive};

/// T_B, T_C and T_D of the vertical spectrum on every ground, Table 3.2.VI \[s\].
const VERTICAL_CORNERS_S: [f64; 3] = [0.05, 0.15, 1.0];

/// Topographic category of NTC 2018, Table 3.2.III, at the top of the relief.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, strum::IntoStaticStr)]
pub enum Topography {
    /// Flat ground, slopes up to 15°.
    #[default]
    T1,
    /// Slopes above 15°.
    T2,
    /// A ridge narrower at the top than at the base, 15° to 30°.
    T3,
    /// The same, above 30°.
    T4,
}

impl Topography {
    /// All categories.
    pub const ALL: [Self; 4] = [Self::T1, Self::T2, Self::T3, Self::T4];

    /// The category as the code writes it.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The category with a given name, in upper or lower case.
    ///
    /// # Errors
    /// A name that is not one of the four categories.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "T1, T2, T3, T4")
    }

    /// S_T at the top of the relief, Table 3.2.V.
    pub fn factor_ratio(self) -> f64 {
        match self {
            Self::T1 => 1.0,
            Self::T2 | Self::T3 => 1.2,
            Self::T4 => 1.4,
        }
    }
}

/// The hazard of a point on rock for one return period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NtcHazard {
    /// Peak ground acceleration \[g\].
    pub ag_g: f64,
    /// Largest amplification F0.
    pub f0_ratio: f64,
    /// Tc*, where the branch of constant velocity begins \[s\].
    pub tc_star_s: f64,
}

/// An elastic spectrum of NTC 2018.
///
/// `Se(T) = ag S F0 [T/TB + (1/F0)(1 − T/TB)]` up to TB, `ag S F0` up to TC, `ag S F0 TC/T` up to TD, `ag S F0 TC TD/T²`
/// above; S = S_S S_T, TC = C_C Tc*, TB = TC/3, TD = 4 ag/g + 1.6 s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ntc2018 {
    hazard: NtcHazard,
    return_period_years: u32,
    ground: GroundType,
    topography: Topography,
}

impl Ntc2018 {
    /// The spectrum of a point on a ground.
    ///
    /// # Reference
    /// NTC 2018 (decree of 17 January 2018), 3.2.3.2.1, Eqs. 3.2.2 to 3.2.7, Tables 3.2.IV to 3.2.VI, quoted from memory.
    ///
    /// # Errors
    /// Values that are not positive and finite.
    ///
    /// # Example
    /// L'Aquila at 475 years on ground B: S_S = 1.40 − 0.40 · 2.364 · 0.2607, the plateau is ag S_S F0.
    /// ```
    /// use freestand::code_spectrum::{GroundType, Ntc2018, NtcHazard, Topography};
    /// let hazard = NtcHazard { ag_g: 0.2607, f0_ratio: 2.364, tc_star_s: 0.347 };
    /// let code = Ntc2018::new(hazard, 475, GroundType::B, Topography::T1)?;
    /// assert!((code.soil_factor_ratio() - 1.153_482).abs() < 1e-6);
    /// assert!((code.sa_g(0.3) - 0.710_885).abs() < 1e-6);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        hazard: NtcHazard,
        return_period_years: u32,
        ground: GroundType,
        topography: Topography,
    ) -> Result<Self, CodeSpectrumError> {
        positive("ag", hazard.ag_g)?;
        positive("F0", hazard.f0_ratio)?;
        positive("Tc*", hazard.tc_star_s)?;
        Ok(Self {
            hazard,
            return_period_years,
            ground,
            topography,
        })
    }

    /// The hazard on rock.
    pub fn hazard(&self) -> NtcHazard {
        self.hazard
    }

    /// The return period \[years\].
    pub fn return_period_years(&self) -> u32 {
        self.return_period_years
    }

    /// The ground.
    pub fn ground(&self) -> GroundType {
        self.ground
    }

    /// The topographic category.
    pub fn topography(&self) -> Topography {
        self.topography
    }

    /// S_S of Table 3.2.IV.
    pub fn soil_factor_ratio(&self) -> f64 {
        let product = self.hazard.f0_ratio * self.hazard.ag_g;
        match self.ground {
            GroundType::A => 1.0,
            GroundType::B => (1.40 - 0.40 * product).clamp(1.0, 1.2),
            GroundType::C => (1.70 - 0.60 * product).clamp(1.0, 1.5),
            GroundType::D => (2.40 - 1.50 * product).clamp(0.9, 1.8),
            GroundType::E => (2.00 - 1.10 * product).clamp(1.0, 1.6),
        }
    }

    /// C_C of Table 3.2.IV.
    fn period_ratio(&self) -> f64 {
        let tc_star_s = self.hazard.tc_star_s;
        match self.ground {
            GroundType::A => 1.0,
            GroundType::B => 1.10 * tc_star_s.powf(-0.20),
            GroundType::C => 1.05 * tc_star_s.powf(-0.33),
            GroundType::D => 1.25 * tc_star_s.powf(-0.50),
            GroundType::E => 1.15 * tc_star_s.powf(-0.40),
        }
    }

    /// TB, TC and TD \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        let tc_s = self.period_ratio() * self.hazard.tc_star_s;
        [tc_s / 3.0, tc_s, 4.0 * self.hazard.ag_g + 1.6]
    }

    /// The largest spectral acceleration, ag S F0 \[g\].
    pub fn plateau_g(&self) -> f64 {
        self.zero_period_g() * self.hazard.f0_ratio
    }

    /// The value at T = 0, ag S \[g\].
    pub fn zero_period_g(&self) -> f64 {
        self.hazard.ag_g * self.soil_factor_ratio() * self.topography.factor_ratio()
    }

    /// Horizontal spectral acceleration, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        self.zero_period_g() * shape_ratio(self.corner_periods_s(), self.hazard.f0_ratio, period_s)
    }

    /// Vertical spectral acceleration, 5 % damping \[g\]: `Fv = 1.35 F0 √(ag/g)` is its value on the plateau in units of
    /// ag S_T, and its ratio to the value at T = 0 is F0.
    ///
    /// # Reference
    /// NTC 2018, 3.2.3.2.2, Eqs. 3.2.8 and 3.2.9, Table 3.2.VI: S_S = 1 on every ground.
    pub fn vertical_sa_g(&self, period_s: f64) -> f64 {
        // ag S Fv [T/TB + 1/F0 (1 − T/TB)]: at T = 0 it is ag S Fv/F0 = 1.35 ag S √(ag/g).
        let zero_g = 1.35 * self.hazard.ag_g.powf(1.5) * self.topography.factor_ratio();
        zero_g * shape_ratio(VERTICAL_CORNERS_S, self.hazard.f0_ratio, period_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(ag_g: f64, f0_ratio: f64, tc_star_s: f64, ground: GroundType) -> Ntc2018 {
        let hazard = NtcHazard {
            ag_g,
            f0_ratio,
            tc_star_s,
        };
        Ntc2018::new(hazard, 475, ground, Topography::T1).unwrap()
    }

    fn near(got: f64, expected: f64, tolerance: f64) {
        assert!((got - expected).abs() <= tolerance, "{got} {expected}");
    }

    /// By hand from Tables 3.2.IV and 3.2.VI for L'Aquila (0.2607 g, 2.364, 0.347 s), F0 ag = 0.616295: S_S and C_C Tc* of
    /// each ground. Tolerance: the digits written here.
    #[test]
    fn every_ground_of_laquila() {
        for (ground, soil, tc_s) in [
            (GroundType::A, 1.0, 0.347),
            (GroundType::B, 1.15348, 0.47169),
            (GroundType::C, 1.33022, 0.51667),
            (GroundType::D, 1.47556, 0.73633),
            (GroundType::E, 1.32208, 0.60939),
        ] {
            let code = at(0.2607, 2.364, 0.347, ground);
            near(code.soil_factor_ratio(), soil, 1e-5);
            let [tb, tc, td] = code.corner_periods_s();
            near(tc, tc_s, 1e-5);
            near(tb, tc_s / 3.0, 1e-5);
            near(td, 4.0 * 0.2607 + 1.6, 1e-12);
        }
    }

    /// Weak shaking reaches the upper limits of S_S, strong shaking the lower ones.
    #[test]
    fn limits_of_the_soil_factor() {
        for (ground, upper, lower) in [
            (GroundType::B, 1.2, 1.0),
            (GroundType::C, 1.5, 1.0),
            (GroundType::D, 1.8, 0.9),
            (GroundType::E, 1.6, 1.0),
        ] {
            near(at(0.05, 2.6, 0.3, ground).soil_factor_ratio(), upper, 0.0);
            near(at(0.5, 2.4, 0.4, ground).soil_factor_ratio(), lower, 0.0);
        }
    }

    /// The branches meet, and the vertical spectrum has Fv on its plateau: 1.35 · 2.364 · √0.2607 · 0.2607 g.
    #[test]
    fn branches() {
        let code = at(0.2607, 2.364, 0.347, GroundType::C);
        let [tb, tc, td] = code.corner_periods_s();
        near(code.sa_g(0.0), code.zero_period_g(), 1e-15);
        for corner in [tb, tc, td] {
            near(
                code.sa_g(corner * (1.0 - 1e-9)),
                code.sa_g(corner * (1.0 + 1e-9)),
                1e-8,
            );
        }
        near(code.sa_g(2.0 * td), code.plateau_g() * tc / td / 4.0, 1e-15);
        near(
            code.vertical_sa_g(0.1),
            1.35 * 2.364 * 0.2607f64.sqrt() * 0.2607,
            1e-15,
        );
        let steep = Ntc2018 {
            topography: Topography::T4,
            ..code
        };
        near(steep.sa_g(0.3), 1.4 * code.sa_g(0.3), 1e-15);
    }
}
