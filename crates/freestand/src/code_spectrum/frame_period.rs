//! AS 1170.4: the fundamental period of a building from its height.

use super::CodeSpectrumError;

/// Kind of structure in the code's estimate of the fundamental period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameKind {
    /// Moment-resisting steel frames, kt = 0.11.
    MomentSteel,
    /// Moment-resisting concrete frames, kt = 0.075.
    MomentConcrete,
    /// Eccentrically braced steel frames, kt = 0.06.
    EccentricallyBracedSteel,
    /// All other structures, kt = 0.05.
    Other,
}

impl FrameKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::MomentSteel, Self::MomentConcrete, Self::EccentricallyBracedSteel, Self::Other];

    /// The name in flags and studies.
    pub fn name(self) -> &'static str {
        match self {
            Self::MomentSteel => "steel-moment",
            Self::MomentConcrete => "concrete-moment",
            Self::EccentricallyBracedSteel => "steel-braced",
            Self::Other => "other",
        }
    }

    /// The kind with a given name, in upper or lower case.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name().eq_ignore_ascii_case(name.trim()))
    }

    /// The factor kt of clause 6.2.3.
    pub fn period_factor(self) -> f64 {
        match self {
            Self::MomentSteel => 0.11,
            Self::MomentConcrete => 0.075,
            Self::EccentricallyBracedSteel => 0.06,
            Self::Other => 0.05,
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
    if !(height_m > 0.0 && height_m.is_finite()) {
        return Err(CodeSpectrumError::Height { height_m });
    }
    Ok(1.25 * frame.period_factor() * height_m.powf(0.75))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_of_30_storeys() {
        let kinds =
            [FrameKind::MomentSteel, FrameKind::MomentConcrete, FrameKind::EccentricallyBracedSteel, FrameKind::Other];
        for (height_m, periods_s) in [(96.0, [4.22, 2.88, 2.30, 1.92]), (105.0, [4.51, 3.08, 2.46, 2.05])] {
            for (kind, want) in kinds.into_iter().zip(periods_s) {
                // Hand values to two decimals.
                assert!((fundamental_period_s(kind, height_m).unwrap() - want).abs() < 0.005);
            }
        }
        assert!(matches!(fundamental_period_s(FrameKind::Other, 0.0), Err(CodeSpectrumError::Height { .. })));
    }
}
