//! TS 1170.5:2025, New Zealand: the elastic spectrum from the four values that its tables have for a settlement, a return
//! period and a site class.

use super::{CodeSpectrumError, class_named, positive};

/// Where the plateau begins \[s\].
const PLATEAU_FROM_S: f64 = 0.1;

/// Site class of TS 1170.5:2025.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
pub enum TsSite {
    /// Vs30 above 750 m/s.
    I,
    /// 450 to 750 m/s.
    II,
    /// 300 to 450 m/s.
    III,
    /// 250 to 300 m/s.
    IV,
    /// 200 to 250 m/s.
    V,
    /// 150 to 200 m/s.
    VI,
}

impl TsSite {
    /// All classes, from hard to soft.
    pub const ALL: [Self; 6] = [Self::I, Self::II, Self::III, Self::IV, Self::V, Self::VI];

    /// The class as the code writes it.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The class with a given name, in upper or lower case.
    ///
    /// # Errors
    /// A name that is not one of the six classes.
    pub fn parse(name: &str) -> Result<Self, CodeSpectrumError> {
        class_named(&Self::ALL, name, "I, II, III, IV, V, VI")
    }
}

/// The four values of Table 3.1 for a class and a return period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TsValues {
    /// Peak ground acceleration \[g\].
    pub pga_g: f64,
    /// Spectral acceleration on the plateau S_a,s \[g\].
    pub sas_g: f64,
    /// T_c, where the plateau ends \[s\].
    pub tc_s: f64,
    /// T_d, where the branch of constant velocity ends \[s\].
    pub td_s: f64,
}

/// An elastic spectrum of TS 1170.5:2025.
///
/// `PGA + (S_a,s − PGA) T/0.1 s` up to 0.1 s, `S_a,s` up to T_c, `S_a,s T_c/T` up to T_d, `S_a,s (T_c/T) √(T_d/T)` above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ts1170_5 {
    values: TsValues,
    site: TsSite,
    return_period_years: u32,
}

impl Ts1170_5 {
    /// The spectrum of four values.
    ///
    /// # Reference
    /// TS 1170.5:2025, 3.1, as `uhs_value` of GNS-Science/TS1170.5-SDP, which made its tables. The near-fault factor, which
    /// depends on D, is not part of it.
    ///
    /// # Errors
    /// Values that are not positive and finite, or corner periods that do not ascend from 0.1 s.
    ///
    /// # Example
    /// ```
    /// use freestand::code_spectrum::{Ts1170_5, TsSite, TsValues};
    /// let values = TsValues { pga_g: 0.18, sas_g: 0.38, tc_s: 0.52, td_s: 2.8 };
    /// let code = Ts1170_5::new(values, TsSite::III, 500)?;
    /// assert!((code.sa_g(0.05) - 0.28).abs() < 1e-15 && (code.sa_g(1.04) - 0.19).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        values: TsValues,
        site: TsSite,
        return_period_years: u32,
    ) -> Result<Self, CodeSpectrumError> {
        positive("PGA", values.pga_g)?;
        positive("Sa,s", values.sas_g)?;
        positive("Tc − 0.1 s", values.tc_s - PLATEAU_FROM_S)?;
        positive("Td − Tc", values.td_s - values.tc_s)?;
        Ok(Self {
            values,
            site,
            return_period_years,
        })
    }

    /// Its values.
    pub fn values(&self) -> TsValues {
        self.values
    }

    /// The site.
    pub fn site(&self) -> TsSite {
        self.site
    }

    /// The return period \[years\].
    pub fn return_period_years(&self) -> u32 {
        self.return_period_years
    }

    /// 0.1 s, T_c and T_d \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        [PLATEAU_FROM_S, self.values.tc_s, self.values.td_s]
    }

    /// Horizontal spectral acceleration, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        let TsValues {
            pga_g,
            sas_g,
            tc_s,
            td_s,
        } = self.values;
        match period_s {
            t if (0.0..PLATEAU_FROM_S).contains(&t) => pga_g + (sas_g - pga_g) * t / PLATEAU_FROM_S,
            t if t >= PLATEAU_FROM_S && t <= tc_s => sas_g,
            t if t > tc_s && t <= td_s => sas_g * tc_s / t,
            t if t > td_s => sas_g * tc_s / t * (td_s / t).sqrt(),
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values that the tests of GNS-Science/TS1170.5-SDP have for its function.
    #[test]
    fn branches() {
        let values = TsValues {
            pga_g: 2.0,
            sas_g: 1.5,
            tc_s: 0.45,
            td_s: 2.0,
        };
        let code = Ts1170_5::new(values, TsSite::IV, 500).unwrap();
        for (period_s, expected) in [
            (0.0, 2.0),
            (0.001, 1.995),
            (0.2, 1.5),
            (0.5, 1.5 * 0.45 / 0.5),
            (5.0, 1.5 * 0.45 / 5.0 * 0.4f64.sqrt()),
        ] {
            assert!((code.sa_g(period_s) - expected).abs() < 1e-15);
        }
        assert!(
            Ts1170_5::new(
                TsValues {
                    tc_s: 0.1,
                    ..values
                },
                TsSite::I,
                25
            )
            .is_err()
        );
    }
}
