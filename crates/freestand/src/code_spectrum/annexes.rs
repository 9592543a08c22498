//! Shapes of the spectra of Eurocode 8 in national annexes that differ from the recommended one.

use super::{GroundType, SpectrumShape, SpectrumType};
use crate::G0_M_S2;

/// A national annex to EN 1998-1, or a national code of its form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NationalAnnex {
    /// Metropolitan France, zones 1 to 4: arrêté of 22 October 2010, article 4.
    France,
    /// NP EN 1998-1:2010: two spectra, type 1 for distant and type 2 for near earthquakes.
    Portugal,
    /// P100-1/2013: the corner period belongs to the place, and there is no ground type.
    Romania {
        /// T_C of the place \[s\].
        corner_period_s: f64,
    },
    /// NCSE-02: no branch of constant displacement.
    Spain {
        /// K of the municipality.
        contribution_ratio: f64,
    },
}

impl NationalAnnex {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::France => "arrêté of 22 October 2010 (France, zones 1 to 4)",
            Self::Portugal => "NP EN 1998-1:2010 (Portugal)",
            Self::Romania { .. } => "P100-1/2013 (Romania)",
            Self::Spain { .. } => "NCSE-02 (Spain)",
        }
    }

    /// Mean return period of its reference acceleration \[years\]: 20 % in 50 years in Romania, 10 % in
    /// 50 years elsewhere; 500 years in Spain.
    pub fn return_period_years(self) -> u32 {
        match self {
            Self::Romania { .. } => 225,
            Self::Spain { .. } => 500,
            Self::France | Self::Portugal => 475,
        }
    }

    /// Whether the spectrum depends on the ground type.
    pub fn has_ground_types(self) -> bool {
        !matches!(self, Self::Romania { .. })
    }

    /// The shape of its spectrum on a ground, for a design acceleration on rock a_g \[g\].
    ///
    /// # Reference
    /// France: arrêté of 22 October 2010, article 4, II d and e (read in etalab's copy); it has one
    /// spectrum, whatever the type. Portugal: NP EN 1998-1:2010, tables NA.I to NA.III (read in
    /// eurocodepy 2026.1.1, P. Cachim), S = S_max up to 1 m/s², 1 from 4 m/s², linear between.
    /// Romania: P100-1/2013, 3.1, T_B = 0.2 T_C, T_D = 2 s where T_C = 1.6 s and 3 s elsewhere
    /// (quoted from memory), S = 1. Spain: NCSE-02, 2.2 to 2.4 (quoted from memory), with ρ = the importance factor: terrain
    /// I, II, III, IV as ground A, B, C, D and E has C = 1, 1.3, 1.6, 2; S = C/1.25 up to 0.1 g, 1 from 0.4 g, linear between;
    /// T_A = K C/10, T_B = K C/2.5.
    ///
    /// # Example
    /// Bucharest, T_C = 1.6 s; Lisbon, type 1 on ground B, 1.5 m/s²: S = 1.35 − 0.35 · 0.5/3.
    /// ```
    /// use freestand::code_spectrum::{GroundType, NationalAnnex, SpectrumType};
    /// let bucharest = NationalAnnex::Romania { corner_period_s: 1.6 };
    /// let shape = bucharest.shape(SpectrumType::Type1, GroundType::B, 0.3);
    /// assert_eq!((shape.soil_factor_ratio, shape.tc_s, shape.td_s), (1.0, 1.6, 2.0));
    /// let lisbon = NationalAnnex::Portugal.shape(SpectrumType::Type1, GroundType::B, 1.5 / 9.80665);
    /// assert!((lisbon.soil_factor_ratio - 1.291_667).abs() < 1e-6);
    /// ```
    pub fn shape(
        self,
        spectrum_type: SpectrumType,
        ground: GroundType,
        ground_acceleration_g: f64,
    ) -> SpectrumShape {
        match self {
            Self::France => france(ground),
            Self::Portugal => portugal(spectrum_type, ground, ground_acceleration_g * G0_M_S2),
            Self::Romania { corner_period_s } => SpectrumShape {
                soil_factor_ratio: 1.0,
                tb_s: 0.2 * corner_period_s,
                tc_s: corner_period_s,
                td_s: if corner_period_s > 1.0 { 2.0 } else { 3.0 },
            },
            Self::Spain { contribution_ratio } => {
                spain(ground, contribution_ratio, ground_acceleration_g)
            }
        }
    }
}

fn france(ground: GroundType) -> SpectrumShape {
    let (soil_factor_ratio, tb_s, tc_s, td_s) = match ground {
        GroundType::A => (1.0, 0.03, 0.20, 2.5),
        GroundType::B => (1.35, 0.05, 0.25, 2.5),
        GroundType::C => (1.5, 0.06, 0.40, 2.0),
        GroundType::D => (1.6, 0.10, 0.60, 1.5),
        GroundType::E => (1.8, 0.08, 0.45, 1.25),
    };
    SpectrumShape {
        soil_factor_ratio,
        tb_s,
        tc_s,
        td_s,
    }
}

/// The last period of the spectrum of NCSE-02, whose branch `K C/T` has no end \[s\].
const NCSE_LAST_S: f64 = 10.0;

fn spain(ground: GroundType, contribution_ratio: f64, ground_acceleration_g: f64) -> SpectrumShape {
    let soil = match ground {
        GroundType::A => 1.0,
        GroundType::B => 1.3,
        GroundType::C => 1.6,
        GroundType::D | GroundType::E => 2.0,
    };
    let share = ((ground_acceleration_g - 0.1) / 0.3).clamp(0.0, 1.0);
    let weak = soil / 1.25;
    SpectrumShape {
        soil_factor_ratio: weak + (1.0 - weak) * share,
        tb_s: contribution_ratio * soil / 10.0,
        tc_s: contribution_ratio * soil / 2.5,
        td_s: NCSE_LAST_S,
    }
}

fn portugal(
    spectrum_type: SpectrumType,
    ground: GroundType,
    ground_acceleration_m_s2: f64,
) -> SpectrumShape {
    let largest = match ground {
        GroundType::A => 1.0,
        GroundType::B => 1.35,
        GroundType::C => 1.6,
        GroundType::D => 2.0,
        GroundType::E => 1.8,
    };
    let share = ((ground_acceleration_m_s2 - 1.0) / 3.0).clamp(0.0, 1.0);
    let tc_s = match (spectrum_type, ground) {
        (SpectrumType::Type1, GroundType::D) => 0.8,
        (SpectrumType::Type1, _) => 0.6,
        (SpectrumType::Type2, GroundType::D) => 0.3,
        (SpectrumType::Type2, _) => 0.25,
    };
    SpectrumShape {
        soil_factor_ratio: largest - (largest - 1.0) * share,
        tb_s: 0.1,
        tc_s,
        td_s: 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The plateau of the type 1 spectrum of Lisbon ends at 0.6 s, that of type 2 at 0.25 s; S ends at
    /// 1 from 4 m/s² on. Nice on ground C: 1.5, 0.06, 0.4, 2.
    #[test]
    fn annexes_as_published() {
        let at =
            |kind, ground, m_s2: f64| NationalAnnex::Portugal.shape(kind, ground, m_s2 / G0_M_S2);
        let near =
            |got: f64, expected: f64| assert!((got - expected).abs() < 1e-12, "{got} {expected}");
        near(
            at(SpectrumType::Type1, GroundType::D, 1.0).soil_factor_ratio,
            2.0,
        );
        near(
            at(SpectrumType::Type1, GroundType::D, 2.5).soil_factor_ratio,
            1.5,
        );
        near(
            at(SpectrumType::Type2, GroundType::C, 4.5).soil_factor_ratio,
            1.0,
        );
        near(at(SpectrumType::Type2, GroundType::B, 1.7).tc_s, 0.25);
        near(at(SpectrumType::Type1, GroundType::D, 1.5).tc_s, 0.8);
        let nice = NationalAnnex::France.shape(SpectrumType::Type1, GroundType::C, 0.163);
        assert_eq!(
            nice,
            SpectrumShape {
                soil_factor_ratio: 1.5,
                tb_s: 0.06,
                tc_s: 0.4,
                td_s: 2.0
            }
        );
        for ground in GroundType::ALL {
            let shape = NationalAnnex::France.shape(SpectrumType::Type2, ground, 0.1);
            assert!(
                shape.tb_s < shape.tc_s
                    && shape.tc_s < shape.td_s
                    && shape.soil_factor_ratio >= 1.0
            );
        }
        let rest = NationalAnnex::Romania {
            corner_period_s: 0.7,
        }
        .shape(SpectrumType::Type1, GroundType::B, 0.2);
        near(rest.tb_s, 0.14);
        // Granada on terrain III, a_b = 0.23 g, K = 1: S = 1.28 + 3.33 (0.13) (1 − 1.28).
        let granada = NationalAnnex::Spain {
            contribution_ratio: 1.0,
        }
        .shape(SpectrumType::Type1, GroundType::C, 0.23);
        near(granada.soil_factor_ratio, 1.28 - 0.28 * 0.13 / 0.3);
        near(granada.tb_s, 0.16);
        near(granada.tc_s, 0.64);
        near(rest.td_s, 3.0);
    }
}
