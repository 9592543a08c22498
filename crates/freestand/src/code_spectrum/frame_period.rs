//! The fundamental period of a building from its height, as codes estimate it.

use super::CodeSpectrumError;

/// Kind of structure in the code's estimate of the fundamental period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameKind {
    /// Moment-resisting steel frames.
    MomentSteel,
    /// Moment-resisting concrete frames.
    MomentConcrete,
    /// Eccentrically braced steel frames.
    EccentricallyBracedSteel,
    /// All other structures.
    Other,
}

impl FrameKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [
        Self::MomentSteel,
        Self::MomentConcrete,
        Self::EccentricallyBracedSteel,
        Self::Other,
    ];

    /// The name in flags and studies.
    pub fn name(self) -> &'static str {
        match self {
            Self::MomentSteel => "steel-moment",
            Self::MomentConcrete => "concrete-moment",
            Self::EccentricallyBracedSteel => "steel-braced",
            Self::Other => "other",
        }
    }

    /// The factor kt of AS 1170.4, clause 6.2.3.
    pub fn period_factor(self) -> f64 {
        match self {
            Self::MomentSteel => 0.11,
            Self::MomentConcrete => 0.075,
            Self::EccentricallyBracedSteel => 0.06,
            Self::Other => 0.05,
        }
    }
}

/// A code that estimates the period of a building from its height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PeriodCode {
    /// AS 1170.4—2007, clause 6.2.3.
    #[default]
    As1170_4,
    /// NZS 1170.5:2004, commentary C4.1.2.2; recalled, not read.
    Nzs1170_5,
    /// ASCE 7-16, 12.8.2.1 and Table 12.8-2.
    Asce7,
    /// EN 1998-1:2004, 4.3.3.2.2(3), for buildings up to 40 m.
    Eurocode8,
}

impl PeriodCode {
    /// All codes.
    pub const ALL: [Self; 4] = [
        Self::As1170_4,
        Self::Nzs1170_5,
        Self::Asce7,
        Self::Eurocode8,
    ];

    /// The name in flags and studies.
    pub fn name(self) -> &'static str {
        match self {
            Self::As1170_4 => "as1170.4",
            Self::Nzs1170_5 => "nzs1170.5",
            Self::Asce7 => "asce7",
            Self::Eurocode8 => "eurocode8",
        }
    }

    /// The clause, for reports.
    pub fn clause(self) -> &'static str {
        match self {
            Self::As1170_4 => "AS 1170.4, 6.2.3",
            Self::Nzs1170_5 => "NZS 1170.5, C4.1.2.2",
            Self::Asce7 => "ASCE 7-16, 12.8.2.1",
            Self::Eurocode8 => "EN 1998-1, 4.3.3.2.2",
        }
    }

    /// The formula for a kind of structure.
    ///
    /// # Reference
    /// The clauses of the variants, in metres: `1.25 kt H^0.75` with kt of 0.11, 0.075, 0.06 and 0.05
    /// (Australia, New Zealand); 0.0724 H^0.8, 0.0466 H^0.9, 0.0731 H^0.75 and 0.0488 H^0.75 (United
    /// States); 0.085, 0.075, 0.075 and 0.050 times H^0.75 (Europe).
    ///
    /// # Limitation
    /// Estimates from the height alone, deliberately short so that design forces are conservative;
    /// the periods of real towers are often longer.
    ///
    /// # Example
    /// ```
    /// use freestand::code_spectrum::{FrameKind, PeriodCode};
    /// let formula = PeriodCode::Asce7.formula(FrameKind::MomentSteel);
    /// assert!((formula.period_s(30.0)? - 1.100).abs() < 0.0005);
    /// assert_eq!(formula.words(), "0.0724 H^0.8");
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn formula(self, frame: FrameKind) -> PeriodFormula {
        let (factor, exponent) = match (self, frame) {
            (Self::As1170_4 | Self::Nzs1170_5, frame) => (1.25 * frame.period_factor(), 0.75),
            (Self::Asce7, FrameKind::MomentSteel) => (0.0724, 0.8),
            (Self::Asce7, FrameKind::MomentConcrete) => (0.0466, 0.9),
            (Self::Asce7, FrameKind::EccentricallyBracedSteel) => (0.0731, 0.75),
            (Self::Asce7, FrameKind::Other) => (0.0488, 0.75),
            (Self::Eurocode8, FrameKind::MomentSteel) => (0.085, 0.75),
            (Self::Eurocode8, FrameKind::MomentConcrete | FrameKind::EccentricallyBracedSteel) => {
                (0.075, 0.75)
            }
            (Self::Eurocode8, FrameKind::Other) => (0.050, 0.75),
        };
        PeriodFormula {
            factor,
            exponent,
            code: self,
            frame,
        }
    }

    /// The height up to which the code allows its formula, if it says so \[m\].
    pub fn greatest_height_m(self) -> Option<f64> {
        (self == Self::Eurocode8).then_some(40.0)
    }
}

/// `T₁ = factor · H^exponent`, H in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodFormula {
    /// The factor \[s at H = 1 m\].
    pub factor: f64,
    /// The exponent of the height.
    pub exponent: f64,
    code: PeriodCode,
    frame: FrameKind,
}

impl PeriodFormula {
    /// The period of a building of this height \[s\].
    ///
    /// # Errors
    /// A height that is not positive and finite.
    pub fn period_s(&self, height_m: f64) -> Result<f64, CodeSpectrumError> {
        if !(height_m > 0.0 && height_m.is_finite()) {
            return Err(CodeSpectrumError::Height { height_m });
        }
        Ok(self.factor * height_m.powf(self.exponent))
    }

    /// The formula as its code writes it: `1.25 × 0.05 H^0.75`, `0.0724 H^0.8`.
    pub fn words(&self) -> String {
        match self.code {
            PeriodCode::As1170_4 | PeriodCode::Nzs1170_5 => {
                format!("1.25 × {} H^{}", self.frame.period_factor(), self.exponent)
            }
            PeriodCode::Asce7 | PeriodCode::Eurocode8 => {
                format!("{} H^{}", self.factor, self.exponent)
            }
        }
    }
}

/// Fundamental period of a building according to the code, `T₁ = 1.25 kt hn^0.75` (hn in m) \[s\].
///
/// # Reference
/// AS 1170.4—2007, clause 6.2.3 (ultimate limit states).
///
/// # Limitation
/// An estimate from the height alone, which is deliberately short so that design forces are
/// conservative; the periods of real towers are often longer.
///
/// # Errors
/// A height that is not positive and finite.
///
/// # Example
/// 30 storeys of 3.2 m, "all other structures":
/// ```
/// use freestand::code_spectrum::{FrameKind, fundamental_period_s};
/// let t1 = fundamental_period_s(FrameKind::Other, 96.0)?;
/// assert!((t1 - 1.917).abs() < 0.0005);
/// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
/// ```
pub fn fundamental_period_s(frame: FrameKind, height_m: f64) -> Result<f64, CodeSpectrumError> {
    PeriodCode::As1170_4.formula(frame).period_s(height_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_in_words() {
        for (code, words) in [
            (PeriodCode::As1170_4, "1.25 × 0.05 H^0.75"),
            (PeriodCode::Nzs1170_5, "1.25 × 0.05 H^0.75"),
            (PeriodCode::Asce7, "0.0488 H^0.75"),
            (PeriodCode::Eurocode8, "0.05 H^0.75"),
        ] {
            assert_eq!(code.formula(FrameKind::Other).words(), words);
        }
    }

    #[test]
    fn periods_of_30_storeys() {
        let kinds = [
            FrameKind::MomentSteel,
            FrameKind::MomentConcrete,
            FrameKind::EccentricallyBracedSteel,
            FrameKind::Other,
        ];
        for (height_m, periods_s) in [
            (96.0, [4.22, 2.88, 2.30, 1.92]),
            (105.0, [4.51, 3.08, 2.46, 2.05]),
        ] {
            for (kind, want) in kinds.into_iter().zip(periods_s) {
                // Hand values to two decimals.
                assert!((fundamental_period_s(kind, height_m).unwrap() - want).abs() < 0.005);
            }
        }
        // Table 12.8-2 in feet, converted: 0.028 (30/0.3048)^0.8, 0.016 H^0.9, 0.03 and 0.02 H^0.75. The
        // factors in metres have three digits: half a unit of the last, 0.1 %.
        let feet: f64 = 30.0 / 0.3048;
        for (kind, want) in kinds.into_iter().zip([
            0.028 * feet.powf(0.8),
            0.016 * feet.powf(0.9),
            0.03 * feet.powf(0.75),
            0.02 * feet.powf(0.75),
        ]) {
            let got = PeriodCode::Asce7.formula(kind).period_s(30.0).unwrap();
            assert!((got / want - 1.0).abs() < 0.002, "{kind:?}: {got} {want}");
        }
        // 16^0.75 = 8, to the rounding of the power.
        for (kind, want) in kinds.into_iter().zip([0.68, 0.6, 0.6, 0.4]) {
            assert!(
                (PeriodCode::Eurocode8.formula(kind).period_s(16.0).unwrap() - want).abs() < 1e-14
            );
        }
        assert!(matches!(
            fundamental_period_s(FrameKind::Other, 0.0),
            Err(CodeSpectrumError::Height { .. })
        ));
    }
}
