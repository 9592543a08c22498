//! Clauses that nobody has read: TBDY 2018, chapter 6, and TS 1170.5, section 8. Their formulas and all of
//! their factors are to be confirmed.

use freestand::code_spectrum::part_forces::{
    Tbdy2018Part, Ts1170_5Part, tbdy2018_force, ts1170_5_force,
};
use freestand::code_spectrum::parts::asce7_height_ratio;
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};

use super::{Asked, FLEXIBLE_RATIO};
use crate::restraint::factor::{Factor, FactorKey, FactorSource, Found, Recalled};
use crate::restraint::source::{Clause, Remark, Source, SourceKind, Unread};

/// C_i of TS 1170.5 for an elastic part in resonance with the ground, and with a building.
const RESONANT_RATIO: [f64; 2] = [2.5, 4.0];

/// The stated value, or one that nobody has read.
fn recalled(key: FactorKey, stated: Option<f64>, value: f64, why: Recalled) -> Factor {
    Factor::new(key, stated, value, FactorSource::Recalled(why))
}

impl Asked<'_> {
    /// TBDY 2018: A_ie is the floor's largest acceleration by an analysis of the building, which there is
    /// none of: 0.4 S_DS (1 + 2 z/H) of ASCE 7-16, from which the chapter descends, stands in for it.
    pub(super) fn turkey(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let CodeSpectrum::Tbdy2018(code) = spectrum else {
            return None;
        };
        let sds_g = code.sds_g();
        let height = asce7_height_ratio(Asce7Edition::Asce7_16, self.place.level_ratio, None);
        let row = self.component()?;
        let settings = &self.question.settings;
        let amplification = if self.is_flexible() {
            row.amplification_ratio.max(FLEXIBLE_RATIO)
        } else {
            row.amplification_ratio
        };
        let amplification = recalled(
            FactorKey::Amplification,
            settings.amplification_ratio,
            amplification,
            Recalled::RowOfAsce7_16,
        );
        let response = self.response(row.response_ratio, Recalled::RowOfAsce7_16);
        let importance = self.importance();
        let part = Tbdy2018Part {
            amplification_ratio: amplification.value,
            response_ratio: response.value,
            importance_ratio: importance.value,
        };
        Some(Source {
            kind: SourceKind::OwnCode,
            clause: Clause::Tbdy2018,
            part: tbdy2018_force(0.4 * sds_g * height, sds_g, &part),
            vertical_ratio: 0.0,
            factors: self.factors(
                Factor::found(FactorKey::Sds, sds_g, Found::Hazard),
                Factor::found(FactorKey::Height, height, Found::Floor),
                [amplification, response, importance, self.overstrength(1.0)],
            ),
            component: Some(row),
            remarks: vec![Remark::Row],
            to_confirm: vec![Unread::Formula, Unread::FloorAcceleration],
        })
    }

    /// TS 1170.5:2025. C_Hi is H_f of ASCE 7-22, from whose research the section descends.
    pub(super) fn new_zealand_ts(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let CodeSpectrum::Ts1170_5(code) = spectrum else {
            return None;
        };
        let pga_g = code.values().pga_g;
        let level_ratio = self.place.level_ratio;
        let height = asce7_height_ratio(
            Asce7Edition::Asce7_22,
            level_ratio,
            self.place.building_period_s,
        );
        let settings = &self.question.settings;
        let (shape, why) = if self.is_flexible() {
            let above = usize::from(level_ratio > 0.0);
            (RESONANT_RATIO[above], Recalled::Resonance)
        } else {
            (1.0, Recalled::RigidPart)
        };
        let shape = recalled(
            FactorKey::Amplification,
            settings.amplification_ratio,
            shape,
            why,
        );
        let response = self.response(1.0, Recalled::Elastic);
        let structure = recalled(
            FactorKey::BuildingDuctility,
            None,
            1.0,
            Recalled::ElasticBuilding,
        );
        let risk = recalled(
            FactorKey::Importance,
            settings.importance_ratio,
            1.0,
            Recalled::Ordinary,
        );
        let part = Ts1170_5Part {
            structure_ratio: structure.value,
            spectral_ratio: shape.value,
            response_ratio: response.value,
            risk_ratio: risk.value,
        };
        Some(Source {
            kind: SourceKind::OwnCode,
            clause: Clause::Ts1170_5,
            part: ts1170_5_force(pga_g, height, &part),
            vertical_ratio: 0.0,
            factors: self.factors(
                Factor::found(FactorKey::GroundAcceleration, pga_g, Found::Hazard),
                self.height_of_22(height),
                [structure, shape, response, risk, self.overstrength(1.0)],
            ),
            component: None,
            remarks: vec![Remark::NoReserve],
            to_confirm: vec![Unread::Formula, Unread::Height],
        })
    }
}
