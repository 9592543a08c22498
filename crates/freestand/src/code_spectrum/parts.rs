//! Code clauses on parts and components: the acceleration of a floor, and the factors for the
//! design of a part.
//!
//! These clauses apply to parts that are fixed, so not to a free-standing object. The acceleration
//! of a rigid part is the code's own estimate of the peak floor acceleration, which is useful to
//! compare with calculated ones.

use super::{Asce7, Asce7Edition, CodeSpectrum};

/// The floor and the building that a clause is evaluated for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartsQuestion {
    /// Height of the floor divided by that of the building: 0 is the ground, 1 the roof.
    pub level_ratio: f64,
    /// Height of the building \[m\]; only AS 1170.4 and NZS 1170.5 use it.
    pub building_height_m: Option<f64>,
    /// Fundamental period of the building \[s\]; only ASCE 7-22 uses it, and it also has a rule for
    /// an unknown one.
    pub building_period_s: Option<f64>,
}

/// Building height from which the factor of AS 1170.4 is proportional to the height of the
/// building \[m\].
const AS_TALL_M: f64 = 12.0;

/// Acceleration of a rigid part (period 0, rigidly fixed, no importance or ductility) on a
/// floor \[g\]; `None` for a user's table, a level outside 0 to 1, a height or a period that is not
/// positive, or without a height that the code needs.
///
/// | code | acceleration |
/// |---|---|
/// | AS 1170.4, section 8 | kpZ Ch(0) (1 + kc hx), kc = 2/hn from 12 m, 0.17 below |
/// | EN 1998-1, 4.3.5.2 | a_g S (1 + 1.5 z/H): [`eurocode8_factor_ratio`] with Ta = 0 |
/// | ASCE 7-22, 13.3 | 0.4 SDS Hf, Hf = 1 + a1 z/h + a2 (z/h)^10, or 1 + 2.5 z/h without a period |
/// | ASCE 7-16, 13.3 | 0.4 SDS (1 + 2 z/h) |
/// | NZS 1170.5, section 8 | C(0) CHi, CHi = the smallest of 1 + hi/6, 1 + 10 hi/hn and 3 |
///
/// # Example
/// The roof of a tower in Melbourne: 0.08 · 1.1 · 3 = 0.264 g.
/// ```
/// use freestand::code_spectrum::{As1170_4, CodeSpectrum, Edition, SiteClass};
/// use freestand::code_spectrum::parts::{PartsQuestion, floor_acceleration_g};
/// let code = CodeSpectrum::from(As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)?);
/// let roof = PartsQuestion { level_ratio: 1.0, building_height_m: Some(96.0), building_period_s: None };
/// assert!((floor_acceleration_g(&code, &roof).unwrap() - 0.264).abs() < 1e-15);
/// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
/// ```
pub fn floor_acceleration_g(code: &CodeSpectrum, question: &PartsQuestion) -> Option<f64> {
    let PartsQuestion {
        level_ratio,
        building_height_m,
        building_period_s,
    } = *question;
    let is_fine = |value: Option<f64>| value.is_none_or(|value| value > 0.0 && value.is_finite());
    if !(0.0..=1.0).contains(&level_ratio)
        || !is_fine(building_height_m)
        || !is_fine(building_period_s)
    {
        return None;
    }
    let factor = match code {
        CodeSpectrum::As1170_4(_) => as1170_4_height_ratio(level_ratio, building_height_m?),
        // NTC 2018, 7.2.3, leaves the acceleration to comprehensive methods: that of Eurocode 8 serves.
        CodeSpectrum::Eurocode8(_) | CodeSpectrum::Ntc2018(_) => {
            eurocode8_factor_ratio(level_ratio, 0.0)
        }
        CodeSpectrum::Asce7(code) => {
            asce7_height_factor_ratio(code, level_ratio, building_period_s)
        }
        CodeSpectrum::Nzs1170_5(_) => (1.0 + level_ratio * building_height_m? / 6.0)
            .min(1.0 + 10.0 * level_ratio)
            .min(3.0),
        CodeSpectrum::Tbdy2018(_) | CodeSpectrum::Ts1170_5(_) | CodeSpectrum::Table(_) => {
            return None;
        }
    };
    // In every code the acceleration of the ground is the value at T = 0: kpZ Ch(0), a_g S, 0.4
    // SDS, C(0).
    Some(factor * code.sa_g(0.0))
}

/// The clause of [`floor_acceleration_g`] and its formula in words; `None` for a user's table.
pub fn clause(code: &CodeSpectrum) -> Option<&'static str> {
    match code {
        CodeSpectrum::As1170_4(_) => Some("AS 1170.4, section 8: kpZ Ch(0) (1 + kc hx)"),
        CodeSpectrum::Eurocode8(_) => Some("EN 1998-1, 4.3.5.2: a_g S (1 + 1.5 z/H), a rigid part"),
        CodeSpectrum::Asce7(code) => Some(match code.edition() {
            Asce7Edition::Asce7_16 => "ASCE 7-16, 13.3: 0.4 SDS (1 + 2 z/h)",
            Asce7Edition::Asce7_22 => "ASCE 7-22, 13.3: 0.4 SDS Hf",
        }),
        CodeSpectrum::Nzs1170_5(_) => Some("NZS 1170.5, section 8: C(0) CHi"),
        CodeSpectrum::Ntc2018(_) => {
            Some("NTC 2018, 7.2.3, by EN 1998-1, 4.3.5.2: ag S (1 + 1.5 z/H), a rigid part")
        }
        CodeSpectrum::Tbdy2018(_) | CodeSpectrum::Ts1170_5(_) | CodeSpectrum::Table(_) => None,
    }
}

/// Amplification of a part relative to a_g S in Eurocode 8: `3 (1 + z/H)/(1 + (1 − Ta/T1)²) − 0.5`,
/// at least 1; `period_ratio` is Ta/T1, the period of the part divided by that of the building.
///
/// # Reference
/// EN 1998-1:2004, Eq. (4.25).
///
/// # Example
/// In resonance at the roof: 3 · 2 − 0.5.
/// ```
/// assert_eq!(freestand::code_spectrum::parts::eurocode8_factor_ratio(1.0, 1.0), 5.5);
/// ```
pub fn eurocode8_factor_ratio(level_ratio: f64, period_ratio: f64) -> f64 {
    (3.0 * (1.0 + level_ratio) / (1.0 + (1.0 - period_ratio).powi(2)) - 0.5).max(1.0)
}

/// Height factor of AS 1170.4, section 8: 1 + kc hx, with kc = 2/hn from 12 m, 0.17 below.
///
/// # Example
/// ```
/// use freestand::code_spectrum::parts::as1170_4_height_ratio;
/// assert_eq!(as1170_4_height_ratio(1.0, 96.0), 3.0);
/// assert_eq!(as1170_4_height_ratio(1.0, 10.0), 2.7);
/// ```
pub fn as1170_4_height_ratio(level_ratio: f64, building_height_m: f64) -> f64 {
    if building_height_m >= AS_TALL_M {
        1.0 + 2.0 * level_ratio
    } else {
        1.0 + 0.17 * (level_ratio * building_height_m)
    }
}

/// Height factor of ASCE 7: 1 + 2 z/h in edition 16; Hf in edition 22, with `a1 = min(1/Ta, 2.5)`
/// and `a2 = max(0, 1 − (0.4/Ta)²)` for the building's period Ta, or 1 + 2.5 z/h if the period is
/// unknown.
///
/// # Reference
/// ASCE 7-16, Eq. (13.3-1); ASCE 7-22, Eqs. (13.3-4) and (13.3-5).
pub fn asce7_height_factor_ratio(
    code: &Asce7,
    level_ratio: f64,
    building_period_s: Option<f64>,
) -> f64 {
    asce7_height_ratio(code.edition(), level_ratio, building_period_s)
}

/// [`asce7_height_factor_ratio`] of an edition, for a site with the spectrum of another code.
///
/// # Example
/// ```
/// use freestand::code_spectrum::{Asce7Edition, parts::asce7_height_ratio};
/// assert_eq!(asce7_height_ratio(Asce7Edition::Asce7_16, 0.5, None), 2.0);
/// assert_eq!(asce7_height_ratio(Asce7Edition::Asce7_22, 1.0, None), 3.5);
/// ```
pub fn asce7_height_ratio(
    edition: Asce7Edition,
    level_ratio: f64,
    building_period_s: Option<f64>,
) -> f64 {
    match (edition, building_period_s) {
        (Asce7Edition::Asce7_16, _) => 1.0 + 2.0 * level_ratio,
        (Asce7Edition::Asce7_22, None) => 1.0 + 2.5 * level_ratio,
        (Asce7Edition::Asce7_22, Some(period_s)) => {
            let a1 = (1.0 / period_s).min(2.5);
            let a2 = (1.0 - (0.4 / period_s).powi(2)).max(0.0);
            1.0 + a1 * level_ratio + a2 * level_ratio.powi(10)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code_spectrum::{
        As1170_4, Edition, Eurocode8, GroundType, Interpolation, Nzs1170_5, OutOfRange, SiteClass,
        SpectrumTable, SpectrumType, SubsoilClass,
    };

    fn at(
        code: &CodeSpectrum,
        level_ratio: f64,
        height_m: f64,
        building_period_s: Option<f64>,
    ) -> f64 {
        let building_height_m = Some(height_m);
        floor_acceleration_g(
            code,
            &PartsQuestion {
                level_ratio,
                building_height_m,
                building_period_s,
            },
        )
        .unwrap()
    }

    fn melbourne() -> CodeSpectrum {
        As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)
            .unwrap()
            .into()
    }

    /// kpZ Ch(0) = 0.088 g; 1 + 2 z/hn from 12 m on, 1 + 0.17 hx below: 10 m high, 5 m up, 1.85.
    #[test]
    fn as_1170_4_up_the_height() {
        for (level, height_m, factor) in [
            (0.0, 96.0, 1.0),
            (0.5, 96.0, 2.0),
            (1.0, 96.0, 3.0),
            (1.0, 12.0, 3.0),
            (0.5, 10.0, 1.85),
            (1.0, 10.0, 2.7),
        ] {
            assert!(
                (at(&melbourne(), level, height_m, None) - 0.088 * factor).abs() < 1e-15,
                "{level} {height_m}"
            );
        }
    }

    /// a_g S = 0.24 g: (1 + 1.5 z/H). The general form by hand: Ta = 0 at the roof 3 · 2/2 − 0.5 =
    /// 2.5; Ta = T1/2 at mid-height 4.5/1.25 − 0.5 = 3.1; Ta = 4 T1 at the ground 3/10 − 0.5 < 1.
    #[test]
    fn eurocode_8_up_the_height() {
        let code = CodeSpectrum::from(
            Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.2, 1.0).unwrap(),
        );
        for (level, factor) in [(0.0, 1.0), (0.5, 1.75), (1.0, 2.5)] {
            assert!(
                (at(&code, level, 30.0, Some(1.0)) - 0.24 * factor).abs() < 1e-15,
                "{level}"
            );
        }
        for (level, ratio, factor) in [
            (1.0, 0.0, 2.5),
            (0.5, 0.5, 3.1),
            (0.0, 4.0, 1.0),
            (0.0, 0.0, 1.0),
        ] {
            assert!(
                (eurocode8_factor_ratio(level, ratio) - factor).abs() < 1e-15,
                "{level} {ratio}"
            );
        }
    }

    /// 0.4 SDS = 0.4 g. Edition 22: Ta = 0.2 s has a1 = 2.5, a2 = 0; Ta = 0.8 s 1.25 and 0.75; Ta =
    /// 2 s 0.5 and 0.96; z/h = 0.5 has (z/h)^10 = 1/1024.
    #[test]
    fn asce_7_up_the_height() {
        let code = |edition| CodeSpectrum::from(Asce7::new(edition, 1.0, 0.6, 8.0).unwrap());
        let (old, new) = (code(Asce7Edition::Asce7_16), code(Asce7Edition::Asce7_22));
        for (level, factor) in [(0.0, 1.0), (0.5, 2.0), (1.0, 3.0)] {
            assert!(
                (at(&old, level, 30.0, Some(2.0)) - 0.4 * factor).abs() < 1e-15,
                "{level}"
            );
        }
        let cases = [
            (1.0, None, 3.5),
            (0.5, None, 2.25),
            (1.0, Some(0.2), 3.5),
            (1.0, Some(0.8), 3.0),
            (0.5, Some(0.8), 1.0 + 0.625 + 0.75 / 1024.0),
            (1.0, Some(2.0), 2.46),
            (0.0, Some(2.0), 1.0),
        ];
        for (level, period_s, factor) in cases {
            assert!(
                (at(&new, level, 30.0, period_s) - 0.4 * factor).abs() < 1e-15,
                "{level} {period_s:?}"
            );
        }
    }

    /// C(0) = 1.33 · 0.4 = 0.532 g. Tall (60 m): 3 m up 1 + 3/6 = 1.5 is as 1 + 10 · 3/60, 9 m up
    /// 2.5, from 12 m on 3. Low (6 m): 1 + hi/6 governs, 2 at the roof.
    #[test]
    fn nzs_1170_5_up_the_height() {
        let code =
            CodeSpectrum::from(Nzs1170_5::new(SubsoilClass::C, 0.4, 500, Some(1.0)).unwrap());
        let cases = [
            (0.0, 60.0, 1.0),
            (0.05, 60.0, 1.5),
            (0.15, 60.0, 2.5),
            (0.2, 60.0, 3.0),
            (1.0, 60.0, 3.0),
            (1.0, 6.0, 2.0),
            (0.1, 120.0, 2.0),
        ];
        for (level, height_m, factor) in cases {
            assert!(
                (at(&code, level, height_m, None) - 0.532 * factor).abs() < 1e-15,
                "{level} {height_m}"
            );
        }
    }

    #[test]
    fn a_table_has_no_clause_and_bad_questions_no_answer() {
        let table = SpectrumTable::new(
            vec![0.0, 1.0],
            vec![0.1, 0.1],
            Interpolation::LogLog,
            OutOfRange::Hold,
        )
        .unwrap();
        let roof = PartsQuestion {
            level_ratio: 1.0,
            building_height_m: Some(30.0),
            building_period_s: None,
        };
        assert_eq!(
            (
                floor_acceleration_g(&table.clone().into(), &roof),
                clause(&table.into())
            ),
            (None, None)
        );
        for bad in [
            PartsQuestion {
                level_ratio: 1.01,
                ..roof
            },
            PartsQuestion {
                level_ratio: f64::NAN,
                ..roof
            },
            PartsQuestion {
                building_height_m: Some(0.0),
                ..roof
            },
            PartsQuestion {
                building_height_m: None,
                ..roof
            },
            PartsQuestion {
                building_period_s: Some(0.0),
                ..roof
            },
        ] {
            assert_eq!(floor_acceleration_g(&melbourne(), &bad), None, "{bad:?}");
        }
        assert!(clause(&melbourne()).unwrap().starts_with("AS 1170.4"));
    }
}
