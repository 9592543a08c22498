//! ASCE 7: the two-parameter design spectrum.

use super::{CodeSpectrumError, positive};

/// Edition of ASCE 7; the spectrum is the same, but the rules for parts and components differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Asce7Edition {
    /// ASCE 7-16.
    Asce7_16,
    /// ASCE 7-22, which prefers the multi-period spectrum: use a table for that.
    #[default]
    Asce7_22,
}

impl Asce7Edition {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Asce7_16 => "ASCE 7-16",
            Self::Asce7_22 => "ASCE 7-22 (two-period spectrum)",
        }
    }
}

/// A design spectrum of ASCE 7, 5 % damping.
///
/// `SDS (0.4 + 0.6 T/T0)` below T0 = 0.2 TS, `SDS` up to TS = SD1/SDS, `SD1/T` up to TL,
/// `SD1 TL/T²` above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asce7 {
    edition: Asce7Edition,
    sds_g: f64,
    sd1_g: f64,
    long_period_s: f64,
}

impl Asce7 {
    /// The spectrum for the design accelerations SDS and SD1 and the transition period TL.
    ///
    /// # Reference
    /// ASCE 7-16, 11.4.6; ASCE 7-22, 11.4.5.2.
    ///
    /// # Errors
    /// A value that is not positive and finite, or a TL below TS = SD1/SDS.
    ///
    /// # Example
    /// SDS = 1 g, SD1 = 0.6 g, TL = 8 s: TS = 0.6 s, T0 = 0.12 s.
    /// ```
    /// use freestand::code_spectrum::{Asce7, Asce7Edition};
    /// let code = Asce7::new(Asce7Edition::Asce7_22, 1.0, 0.6, 8.0)?;
    /// assert!((code.sa_g(0.06) - 0.7).abs() < 1e-15);
    /// assert!((code.sa_g(2.0) - 0.3).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(edition: Asce7Edition, sds_g: f64, sd1_g: f64, long_period_s: f64) -> Result<Self, CodeSpectrumError> {
        let (sds_g, sd1_g) = (positive("SDS", sds_g)?, positive("SD1", sd1_g)?);
        let long_period_s = positive("TL", long_period_s)?;
        if long_period_s < sd1_g / sds_g {
            let requirement = "at least TS = SD1/SDS";
            return Err(CodeSpectrumError::Parameter { name: "TL", requirement, value: long_period_s });
        }
        Ok(Self { edition, sds_g, sd1_g, long_period_s })
    }

    /// The spectrum for the mapped accelerations: SDS = ⅔ Fa Ss and SD1 = ⅔ Fv S1.
    ///
    /// # Reference
    /// ASCE 7-16, 11.4.4 and 11.4.5.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    ///
    /// # Example
    /// Ss = 1.5 g, Fa = 1: SDS = 1 g.
    /// ```
    /// use freestand::code_spectrum::{Asce7, Asce7Edition};
    /// let code = Asce7::from_mapped(Asce7Edition::Asce7_16, (1.5, 1.0), (0.6, 1.5), 12.0)?;
    /// assert!((code.sds_g() - 1.0).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn from_mapped(
        edition: Asce7Edition,
        (ss_g, fa_ratio): (f64, f64),
        (s1_g, fv_ratio): (f64, f64),
        long_period_s: f64,
    ) -> Result<Self, CodeSpectrumError> {
        let short = positive("Ss", ss_g)? * positive("Fa", fa_ratio)?;
        let second = positive("S1", s1_g)? * positive("Fv", fv_ratio)?;
        Self::new(edition, 2.0 * short / 3.0, 2.0 * second / 3.0, long_period_s)
    }

    /// Edition of the code.
    pub fn edition(&self) -> Asce7Edition {
        self.edition
    }

    /// Design acceleration at short periods, SDS \[g\].
    pub fn sds_g(&self) -> f64 {
        self.sds_g
    }

    /// Design acceleration at 1 s, SD1 \[g\].
    pub fn sd1_g(&self) -> f64 {
        self.sd1_g
    }

    /// Long-period transition TL \[s\].
    pub fn long_period_s(&self) -> f64 {
        self.long_period_s
    }

    /// T0, TS and TL \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        let ts_s = self.sd1_g / self.sds_g;
        [0.2 * ts_s, ts_s, self.long_period_s]
    }

    /// Spectral acceleration, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        let [t0_s, ts_s, tl_s] = self.corner_periods_s();
        match period_s {
            t if (0.0..t0_s).contains(&t) => self.sds_g * (0.4 + 0.6 * t / t0_s),
            t if t >= t0_s && t <= ts_s => self.sds_g,
            t if t > ts_s && t <= tl_s => self.sd1_g / t,
            t if t > tl_s => self.sd1_g * tl_s / (t * t),
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// SDS = 0.8 g, SD1 = 0.4 g, TL = 6 s: TS = 0.5 s, T0 = 0.1 s. By hand: 0.32 at 0, 0.56 at
    /// T0/2, 0.8, 0.8, 0.4 at 1 s, 0.4/6 at TL, 0.4 · 6/144 = 1/60 at 12 s.
    #[test]
    fn every_corner_and_between() {
        let code = Asce7::new(Asce7Edition::Asce7_16, 0.8, 0.4, 6.0).unwrap();
        assert_eq!(code.corner_periods_s(), [0.1, 0.5, 6.0]);
        let cases = [
            (0.0, 0.32),
            (0.05, 0.56),
            (0.1, 0.8),
            (0.3, 0.8),
            (0.5, 0.8),
            (1.0, 0.4),
            (6.0, 0.4 / 6.0),
            (12.0, 1.0 / 60.0),
        ];
        for (period_s, sa_g) in cases {
            // Two or three multiplications.
            assert!((code.sa_g(period_s) - sa_g).abs() < 4e-16, "{period_s}");
        }
        for corner in code.corner_periods_s() {
            let (before, after) = (code.sa_g(corner.next_down()), code.sa_g(corner.next_up()));
            assert!((after / before - 1.0).abs() < 1e-14, "{corner}");
        }
    }

    #[test]
    fn mapped_values_are_two_thirds() {
        let code = Asce7::from_mapped(Asce7Edition::Asce7_22, (1.2, 1.02), (0.45, 1.85), 8.0).unwrap();
        // ⅔ · 1.2 · 1.02 = 0.816, ⅔ · 0.45 · 1.85 = 0.555.
        assert!((code.sds_g() - 0.816).abs() < 1e-15 && (code.sd1_g() - 0.555).abs() < 1e-15);
        assert!(Asce7::from_mapped(Asce7Edition::Asce7_22, (1.2, 0.0), (0.45, 1.85), 8.0).is_err());
        assert!(Asce7::new(Asce7Edition::Asce7_22, 0.5, 0.5, 0.9).is_err());
        assert!(Asce7::new(Asce7Edition::Asce7_22, f64::NAN, 0.5, 8.0).is_err());
    }
}
