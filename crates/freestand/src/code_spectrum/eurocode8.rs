//! Eurocode 8, EN 1998-1:2004, with its recommended values or those of a national annex.

use super::eurocode8_shape::{GroundType, SpectrumShape, SpectrumType};
use super::{CodeSpectrumError, NationalAnnex, positive, within};

/// Corner periods TB, TC, TD of the vertical spectrum, EN 1998-1, Table 3.4 \[s\].
const VERTICAL_CORNERS_S: [f64; 3] = [0.05, 0.15, 1.0];

/// An elastic spectrum of Eurocode 8.
///
/// `Se(T) = a_g S [1 + (T/TB)(2.5η − 1)]` up to TB, `2.5η a_g S` up to TC, `2.5η a_g S TC/T` up to
/// TD, `2.5η a_g S TC TD/T²` above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eurocode8 {
    spectrum_type: SpectrumType,
    ground: Option<GroundType>,
    reference_acceleration_g: f64,
    importance_factor_ratio: f64,
    shape: SpectrumShape,
    is_recommended: bool,
    annex: Option<NationalAnnex>,
}

impl Eurocode8 {
    /// The spectrum with the recommended shape for a ground type: a_g = γ_I a_gR.
    ///
    /// # Reference
    /// EN 1998-1:2004, 3.2.2.2, Eqs. (3.2)–(3.5), Tables 3.2 and 3.3.
    ///
    /// # Limitation
    /// The code's formulas end at 4 s, above which its Annex A reduces the displacement. Here it
    /// stays constant.
    ///
    /// # Errors
    /// An acceleration or an importance factor that is not positive and finite.
    ///
    /// # Example
    /// Type 1, ground B, 0.2 g: the plateau is 2.5 · 0.2 g · 1.2 = 0.6 g, at 1 s half of it (TC =
    /// 0.5 s).
    /// ```
    /// use freestand::code_spectrum::{Eurocode8, GroundType, SpectrumType};
    /// let code = Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.2, 1.0)?;
    /// assert!((code.sa_g(0.3) - 0.6).abs() < 1e-15);
    /// assert!((code.sa_g(1.0) - 0.3).abs() < 1e-15);
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        spectrum_type: SpectrumType,
        ground: GroundType,
        reference_acceleration_g: f64,
        importance_factor_ratio: f64,
    ) -> Result<Self, CodeSpectrumError> {
        Ok(Self {
            spectrum_type,
            ground: Some(ground),
            reference_acceleration_g: positive(
                "the ground acceleration a_gR",
                reference_acceleration_g,
            )?,
            importance_factor_ratio: positive(
                "the importance factor γ_I",
                importance_factor_ratio,
            )?,
            shape: SpectrumShape::recommended(spectrum_type, ground),
            is_recommended: true,
            annex: None,
        })
    }

    /// The spectrum of a national annex.
    ///
    /// # Errors
    /// Those of [`Self::with_shape`].
    pub fn of_annex(
        annex: NationalAnnex,
        spectrum_type: SpectrumType,
        ground: GroundType,
        reference_acceleration_g: f64,
        importance_factor_ratio: f64,
    ) -> Result<Self, CodeSpectrumError> {
        let shape = annex.shape(
            spectrum_type,
            ground,
            importance_factor_ratio * reference_acceleration_g,
        );
        let ground = annex.has_ground_types().then_some(ground);
        let code = Self::with_shape(
            spectrum_type,
            ground,
            reference_acceleration_g,
            importance_factor_ratio,
            shape,
        )?;
        Ok(Self {
            annex: Some(annex),
            ..code
        })
    }

    /// The national annex, where the spectrum is that of one.
    pub fn annex(&self) -> Option<NationalAnnex> {
        self.annex
    }

    /// The same spectrum with the shape of a national annex or of a site study. The type still
    /// selects the vertical spectrum, and the ground type still appears in the name.
    ///
    /// # Errors
    /// Those of [`Self::new`]; a soil factor that is not positive; corner periods that are not 0 <
    /// TB ≤ TC ≤ TD.
    pub fn with_shape(
        spectrum_type: SpectrumType,
        ground: Option<GroundType>,
        reference_acceleration_g: f64,
        importance_factor_ratio: f64,
        shape: SpectrumShape,
    ) -> Result<Self, CodeSpectrumError> {
        let base = Self::new(
            spectrum_type,
            GroundType::A,
            reference_acceleration_g,
            importance_factor_ratio,
        )?;
        positive("the soil factor S", shape.soil_factor_ratio)?;
        positive("TB", shape.tb_s)?;
        for (name, value, least) in [
            ("TC", shape.tc_s, shape.tb_s),
            ("TD", shape.td_s, shape.tc_s),
        ] {
            let requirement = "finite and at least the previous corner period";
            within(
                value >= least && value.is_finite(),
                name,
                requirement,
                value,
            )?;
        }
        let is_recommended =
            ground.is_some_and(|ground| shape == SpectrumShape::recommended(spectrum_type, ground));
        Ok(Self {
            ground,
            shape,
            is_recommended,
            annex: None,
            ..base
        })
    }

    /// Type 1 or 2.
    pub fn spectrum_type(&self) -> SpectrumType {
        self.spectrum_type
    }

    /// Ground type, if one was given.
    pub fn ground(&self) -> Option<GroundType> {
        self.ground
    }

    /// Reference ground acceleration on rock, a_gR \[g\].
    pub fn reference_acceleration_g(&self) -> f64 {
        self.reference_acceleration_g
    }

    /// Importance factor γ_I.
    pub fn importance_factor_ratio(&self) -> f64 {
        self.importance_factor_ratio
    }

    /// Design ground acceleration on rock, a_g = γ_I a_gR \[g\].
    pub fn ground_acceleration_g(&self) -> f64 {
        self.importance_factor_ratio * self.reference_acceleration_g
    }

    /// Soil factor and corner periods.
    pub fn shape(&self) -> SpectrumShape {
        self.shape
    }

    /// Whether the shape is that recommended by EN 1998-1.
    pub fn is_recommended(&self) -> bool {
        self.is_recommended
    }

    /// TB, TC and TD \[s\].
    pub fn corner_periods_s(&self) -> [f64; 3] {
        [self.shape.tb_s, self.shape.tc_s, self.shape.td_s]
    }

    /// The plateau at 5 % damping, 2.5 a_g S \[g\].
    pub fn plateau_g(&self) -> f64 {
        2.5 * self.zero_period_g()
    }

    /// The value at T = 0, a_g S \[g\].
    pub fn zero_period_g(&self) -> f64 {
        self.ground_acceleration_g() * self.shape.soil_factor_ratio
    }

    /// Horizontal spectral acceleration, 5 % damping \[g\]; NaN for a negative period.
    pub fn sa_g(&self, period_s: f64) -> f64 {
        self.zero_period_g() * shape_ratio(self.corner_periods_s(), 2.5, period_s)
    }

    /// Vertical spectral acceleration, 5 % damping \[g\]: a_vg = 0.90 a_g (type 1) or 0.45 a_g
    /// (type 2), 3.0 in place of 2.5, no soil factor. NaN for a negative period.
    ///
    /// # Reference
    /// EN 1998-1:2004, 3.2.2.3, Eqs. (3.8)–(3.11), Table 3.4.
    pub fn vertical_sa_g(&self, period_s: f64) -> f64 {
        let ratio = match self.spectrum_type {
            SpectrumType::Type1 => 0.90,
            SpectrumType::Type2 => 0.45,
        };
        ratio * self.ground_acceleration_g() * shape_ratio(VERTICAL_CORNERS_S, 3.0, period_s)
    }
}

/// 1 at T = 0, `amplification` on the plateau.
pub(super) fn shape_ratio([tb_s, tc_s, td_s]: [f64; 3], amplification: f64, period_s: f64) -> f64 {
    match period_s {
        t if (0.0..tb_s).contains(&t) => 1.0 + (amplification - 1.0) * t / tb_s,
        t if t >= tb_s && t <= tc_s => amplification,
        t if t > tc_s && t <= td_s => amplification * tc_s / t,
        t if t > td_s => amplification * tc_s * td_s / (t * t),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sa/(a_g S) at T = 0, TB/2, TB, TC, 2 TC or TD, TD, 2 TD by hand from Eqs. (3.2)–(3.5): 1,
    /// (1 + 2.5)/2 = 1.75, 2.5, 2.5, 2.5 TC/T, 2.5 TC/TD, and a quarter of that.
    #[test]
    fn every_type_and_ground_at_its_corners() {
        let tables = [
            // EN 1998-1:2004, Table 3.2 (type 1) and Table 3.3 (type 2): S, TB, TC, TD.
            (SpectrumType::Type1, GroundType::A, [1.0, 0.15, 0.4, 2.0]),
            (SpectrumType::Type1, GroundType::B, [1.2, 0.15, 0.5, 2.0]),
            (SpectrumType::Type1, GroundType::C, [1.15, 0.20, 0.6, 2.0]),
            (SpectrumType::Type1, GroundType::D, [1.35, 0.20, 0.8, 2.0]),
            (SpectrumType::Type1, GroundType::E, [1.4, 0.15, 0.5, 2.0]),
            (SpectrumType::Type2, GroundType::A, [1.0, 0.05, 0.25, 1.2]),
            (SpectrumType::Type2, GroundType::B, [1.35, 0.05, 0.25, 1.2]),
            (SpectrumType::Type2, GroundType::C, [1.5, 0.10, 0.25, 1.2]),
            (SpectrumType::Type2, GroundType::D, [1.8, 0.10, 0.30, 1.2]),
            (SpectrumType::Type2, GroundType::E, [1.6, 0.05, 0.25, 1.2]),
        ];
        for (spectrum_type, ground, [s, tb, tc, td]) in tables {
            let code = Eurocode8::new(spectrum_type, ground, 0.16, 1.25).unwrap();
            assert_eq!(
                code.corner_periods_s(),
                [tb, tc, td],
                "{spectrum_type:?} {ground:?}"
            );
            // a_g = 1.25 · 0.16 g = 0.2 g.
            let cases = [
                (0.0, 1.0),
                (0.5 * tb, 1.75),
                (tb, 2.5),
                (0.5 * (tb + tc), 2.5),
                (tc, 2.5),
                (0.5 * (tc + td), 2.5 * tc / (0.5 * (tc + td))),
                (td, 2.5 * tc / td),
                (2.0 * td, 2.5 * tc / td / 4.0),
            ];
            for (period_s, ratio) in cases {
                // A few multiplications of numbers of order one.
                assert!(
                    (code.sa_g(period_s) - 0.2 * s * ratio).abs() < 4e-15,
                    "{spectrum_type:?} {ground:?} {period_s}"
                );
            }
            for corner in [tb, tc, td] {
                let (before, after) = (code.sa_g(corner.next_down()), code.sa_g(corner.next_up()));
                // Continuous: only rounding and the slope over two units in the last place remain.
                assert!(
                    (after / before - 1.0).abs() < 1e-14,
                    "{spectrum_type:?} {ground:?} {corner}"
                );
            }
        }
    }

    /// By hand, type 1, a_g = 0.2 g: a_vg = 0.18 g; 0.18 at 0, 0.54 from 0.05 to 0.15 s, 0.54 ·
    /// 0.15/0.3 = 0.27 at 0.3 s, 0.54 · 0.15/4 = 0.02025 at 2 s. Type 2 has half of these values.
    #[test]
    fn the_vertical_spectrum_has_no_soil_factor() {
        for (spectrum_type, factor) in [(SpectrumType::Type1, 1.0), (SpectrumType::Type2, 0.5)] {
            let code = Eurocode8::new(spectrum_type, GroundType::D, 0.2, 1.0).unwrap();
            for (period_s, sa_g) in [
                (0.0, 0.18),
                (0.05, 0.54),
                (0.15, 0.54),
                (0.3, 0.27),
                (2.0, 0.02025),
            ] {
                assert!(
                    (code.vertical_sa_g(period_s) - factor * sa_g).abs() < 1e-15,
                    "{period_s}"
                );
            }
        }
    }

    #[test]
    fn a_shape_of_a_national_annex() {
        let shape = SpectrumShape {
            soil_factor_ratio: 1.3,
            tb_s: 0.1,
            tc_s: 0.4,
            td_s: 2.5,
        };
        let code = Eurocode8::with_shape(SpectrumType::Type1, None, 0.24, 1.0, shape).unwrap();
        // 2.5 · 0.24 · 1.3 = 0.78; at 5 s 0.78 · 0.4 · 2.5/25 = 0.0312.
        assert!((code.sa_g(0.2) - 0.78).abs() < 1e-15 && (code.sa_g(5.0) - 0.0312).abs() < 1e-15);
        assert!(!code.is_recommended() && code.ground().is_none());
        for bad in [
            SpectrumShape { tb_s: 0.0, ..shape },
            SpectrumShape {
                tc_s: 0.05,
                ..shape
            },
            SpectrumShape { td_s: 0.3, ..shape },
            SpectrumShape {
                td_s: f64::INFINITY,
                ..shape
            },
            SpectrumShape {
                soil_factor_ratio: f64::NAN,
                ..shape
            },
        ] {
            assert!(
                Eurocode8::with_shape(SpectrumType::Type1, None, 0.24, 1.0, bad).is_err(),
                "{bad:?}"
            );
        }
        assert!(Eurocode8::new(SpectrumType::Type1, GroundType::A, 0.0, 1.0).is_err());
        assert!(Eurocode8::new(SpectrumType::Type1, GroundType::A, 0.1, f64::INFINITY).is_err());
        assert!(GroundType::parse("s1").is_err() && GroundType::parse(" b ") == Ok(GroundType::B));
    }
}
