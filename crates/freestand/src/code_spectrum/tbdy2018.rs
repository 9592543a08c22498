//! TBDY 2018, Türkiye: the elastic design spectrum from Ss and S1 of a point and a level of ground motion.

use super::asce7::between;
use super::{CodeSpectrumError, class_named, positive};

/// T_L \[s\], 2.3.4.1.
const LONG_PERIOD_S: f64 = 6.0;
/// The columns of Table 2.1 \[g\].
const SS_G: [f64; 6] = [0.25, 0.5, 0.75, 1.0, 1.25, 1.5];
/// The columns of Table 2.2 \[g\].
const S1_G: [f64; 6] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];

/// Local site class of TBDY 2018, Table 16.1. Class ZF needs a study and is not part of this list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
pub enum TbdySite {
    /// Hard rock.
    ZA,
    /// Rock, little weathered.
    ZB,
    /// Very dense sand or gravel, hard clay, weathered rock.
    ZC,
    /// Medium dense sand or gravel, stiff clay.
    ZD,
    /// Loose sand or gravel, soft clay.
    ZE,
}

impl TbdySite {
    /// All classes, from hard to soft.
    pub const ALL: [Self; 5] = [Self::ZA, Self::ZB, Self::ZC, Self::ZD, Self::ZE];

    /// The class as the code writes it.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The class in words.
    pub fn description(self) -> &'static str {
        match self {
            Self::ZA => "hard rock",
            Self::ZB => "rock",
            Self::ZC => "very dense soil, hard clay or weathered rock",
            Self::ZD => "medium dense soil or stiff clay",
            Self::ZE => "loose soil or soft clay",
        }
    }

    /// The class with a given name, in upper or lower case.
    ///
    /// # Errors
    /// A name that is not one of the five classes.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "ZA, ZB, ZC, ZD, ZE")
    }

    /// F_S and F_1, linear between the columns.
    ///
    /// # Reference
    /// TBDY 2018, Tables 2.1 and 2.2, quoted from memory; they are those of ASCE 7-16 (Tables 11.4-1 and 11.4-2), which were
    /// compared with two public copies, except F_S of ZE from 1 g on.
    pub fn factors(self, ss_g: f64, s1_g: f64) -> [f64; 2] {
        let (short, one) = match self {
            Self::ZA => ([0.8; 6], [0.8; 6]),
            Self::ZB => ([0.9; 6], [0.8; 6]),
            Self::ZC => (
                [1.3, 1.3, 1.2, 1.2, 1.2, 1.2],
                [1.5, 1.5, 1.5, 1.5, 1.5, 1.4],
            ),
            Self::ZD => (
                [1.6, 1.4, 1.2, 1.1, 1.0, 1.0],
                [2.4, 2.2, 2.0, 1.9, 1.8, 1.7],
            ),
            Self::ZE => (
                [2.4, 1.7, 1.3, 1.1, 0.9, 0.8],
                [4.2, 3.3, 2.8, 2.4, 2.2, 2.0],
            ),
        };
        [between(&SS_G, &short, ss_g), between(&S1_G, &one, s1_g)]
    }
}

/// An elastic design spectrum of TBDY 2018.
///
/// `Sae(T) = (0.4 + 0.6 T/T_A) S_DS` up to T_A, `S_DS` up to T_B, `S_D1/T` up to T_L, `S_D1 T_L/T²` above; S_DS = Ss F_S,
/// S_D1 = S1 F_1, T_A = 0.2 S_D1/S_DS, T_B = S_D1/S_DS, T_L = 6 s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tbdy2018 {
    ss_g: f64,
    s1_g: f64,
    site: TbdySite,
    return_period_years: Option<u32>,
}

impl Tbdy2018 {
    /// The spectrum of a point on a site; the return period is that of Ss and S1, where it is known.
    ///
    /// # Reference
    /// TBDY 2018, 2.3.2 to 2.3.4, Eqs. (2.1) to (2.3).
    ///
    /// # Errors
    /// Accelerations that are not positive and finite.
    ///
    /// # Example
    /// Istanbul at 475 years on ZC: S_DS = 0.999 · 1.2, S_D1 = 0.276 · 1.5.
    /// ```
    /// use freestand::code_spectrum::{Tbdy2018, TbdySite};
    /// let code = Tbdy2018::new(0.999, 0.276, TbdySite::ZC, Some(475))?;
    /// assert!((code.sds_g() - 1.1988).abs() < 1e-12 && (code.sa_g(1.0) - 0.414).abs() < 1e-12);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        ss_g: f64,
        s1_g: f64,
        site: TbdySite,
        return_period_years: Option<u32>,
    ) -> Result<Self, CodeSpectrumError> {
        Ok(Self {
            ss_g: positive("Ss", ss_g)?,
            s1_g: positive("S1", s1_g)?,
            site,
            return_period_years,
        })
    }

    /// Ss and S1 \[g\].
    pub fn mapped_g(&self) -> [f64; 2] {
        [self.ss_g, self.s1_g]
    }

    /// The site.
    pub fn site(&self) -> TbdySite {
        self.site
    }

    /// The return period, where it is known \[years\].
    pub fn return_period_years(&self) -> Option<u32> {
        self.return_period_years
    }

    /// F_S and F_1.
    pub fn factors(&self) -> [f64; 2] {
        self.site.factors(self.ss_g, self.s1_g)
    }

    /// S_DS \[g\].
    pub fn sds_g(&self) -> f64 {
        self.ss_g * self.factors()[0]
    }

    /// S_D1 \[g\].
    pub fn sd1_g(&self) -> f64 {
        self.s1_g * self.factors()[1]
    }

    /// T_A, T_B and T_L \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        let tb_s = self.sd1_g() / self.sds_g();
        [0.2 * tb_s, tb_s, LONG_PERIOD_S]
    }

    /// Horizontal spectral acceleration, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        let [ta_s, tb_s, tl_s] = self.corner_periods_s();
        let sds_g = self.sds_g();
        match period_s {
            t if (0.0..ta_s).contains(&t) => sds_g * (0.4 + 0.6 * t / ta_s),
            t if t >= ta_s && t <= tb_s => sds_g,
            t if t > tb_s && t <= tl_s => self.sd1_g() / t,
            t if t > tl_s => self.sd1_g() * tl_s / (t * t),
            _ => f64::NAN,
        }
    }

    /// Vertical spectral acceleration, 5 % damping \[g\]: `(0.32 + 0.48 T/T_AD) S_DS`, `0.8 S_DS`, `0.8 S_DS T_BD/T`, with
    /// T_AD = T_A/3 and T_BD = T_B/3. The code ends at T_L/2; here the last branch goes on.
    ///
    /// # Reference
    /// TBDY 2018, 2.3.5, Eqs. (2.4) and (2.5), quoted from memory.
    pub fn vertical_sa_g(&self, period_s: f64) -> f64 {
        let [ta_s, tb_s, _] = self.corner_periods_s().map(|corner_s| corner_s / 3.0);
        let sds_g = self.sds_g();
        match period_s {
            t if (0.0..ta_s).contains(&t) => sds_g * (0.32 + 0.48 * t / ta_s),
            t if t >= ta_s && t <= tb_s => 0.8 * sds_g,
            t if t > tb_s => 0.8 * sds_g * tb_s / t,
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(got: f64, expected: f64) {
        assert!((got - expected).abs() < 1e-12, "{got} {expected}");
    }

    /// Istanbul (41.01 N, 28.95 E; Ss 0.999 g, S1 0.276 g) by hand: ZD has F_S = 1.1 + 0.1 · 0.001/0.25, F_1 = 2.2 − 0.2 · 0.76.
    #[test]
    fn factors_between_the_columns() {
        let code = Tbdy2018::new(0.999, 0.276, TbdySite::ZD, Some(475)).unwrap();
        near(code.factors()[0], 1.1004);
        near(code.factors()[1], 2.048);
        // Beyond the table its ends hold.
        near(TbdySite::ZE.factors(2.0, 0.9)[0], 0.8);
        near(TbdySite::ZE.factors(0.1, 0.05)[1], 4.2);
    }

    #[test]
    fn branches() {
        let code = Tbdy2018::new(0.999, 0.276, TbdySite::ZC, Some(475)).unwrap();
        let [ta, tb, tl] = code.corner_periods_s();
        near(tb, 0.414 / 1.1988);
        near(tl, 6.0);
        near(code.sa_g(0.0), 0.4 * 1.1988);
        near(code.sa_g(ta / 2.0), 0.7 * 1.1988);
        near(code.sa_g(12.0), 0.414 * 6.0 / 144.0);
        near(code.vertical_sa_g(0.0), 0.32 * 1.1988);
        near(code.vertical_sa_g(tb / 4.0), 0.8 * 1.1988);
        near(code.vertical_sa_g(tb), 0.8 * 1.1988 / 3.0);
        assert!(code.sa_g(-1.0).is_nan());
    }
}
