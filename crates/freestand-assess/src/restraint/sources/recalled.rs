//! Clauses that nobody has read: TBDY 2018, chapter 6, and TS 1170.5, section 8. Their formulas and all of
//! their factors are to be confirmed.

use freestand::code_spectrum::part_forces::{
    Tbdy2018Part, Ts1170_5Part, tbdy2018_force, ts1170_5_force,
};
use freestand::code_spectrum::parts::asce7_height_ratio;
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};
use freestand_input::words::number;

use super::{Asked, CLAUSE_RECALLED, FLEXIBLE_RATIO, Source};
use crate::restraint::factor::Factor;
use crate::result::RestraintKind;

/// C_i of TS 1170.5 for an elastic part in resonance with the ground, and with a building.
const RESONANT_RATIO: [f64; 2] = [2.5, 4.0];

impl Asked<'_> {
    /// TBDY 2018: A_ie is the floor's largest acceleration by an analysis of the building, which there is
    /// none of: 0.4 S_DS (1 + 2 z/H) of ASCE 7-16, from which the chapter descends, stands in for it.
    pub(super) fn turkey(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let CodeSpectrum::Tbdy2018(code) = spectrum else {
            return None;
        };
        let sds_g = code.sds_g();
        let height = asce7_height_ratio(Asce7Edition::Asce7_16, self.place.level_ratio, None);
        let floor_g = 0.4 * sds_g * height;
        let row = self.component()?;
        let settings = &self.question.settings;
        let amplification = if self.is_flexible() {
            row.amplification_ratio.max(FLEXIBLE_RATIO)
        } else {
            row.amplification_ratio
        };
        let amplification = Factor::recalled(
            "amplification",
            "B_e",
            settings.amplification_ratio,
            amplification,
            "a_p of the row of ASCE 7-16, from which table 6.1 descends",
        );
        let response = Factor::recalled(
            "response",
            "R_e",
            settings.response_ratio,
            row.response_ratio,
            "R_p of the row of ASCE 7-16, from which table 6.1 descends",
        );
        let importance = self.importance("I");
        let overstrength = self.overstrength(1.0, "anchors in concrete have rules of their own");
        let part = Tbdy2018Part {
            amplification_ratio: amplification.value,
            response_ratio: response.value,
            importance_ratio: importance.value,
        };
        let numbers = format!(
            "0.4 × {} × {} × {}/{}",
            number(sds_g, 4),
            number(height, 4),
            amplification.number(),
            response.number()
        );
        Some(Source {
            kind: RestraintKind::OwnCode,
            code: Some("TBDY 2018"),
            clause: "chapter 6",
            name: "TBDY 2018, chapter 6",
            force: tbdy2018_force(floor_g, sds_g, &part),
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            equation:
                "F_ie = A_ie B_e/R_e W, at least 0.3 S_DS I W, with A_ie = 0.4 S_DS (1 + 2 z/H)"
                    .to_owned(),
            numbers,
            factors: self.factors(
                Factor::found("sds", "S_DS", sds_g, "g", "the hazard"),
                Factor::found("height", "1 + 2 z/H", height, "1", "the floor"),
                [amplification, response, importance, overstrength],
            ),
            remarks: vec![format!(
                "The factors are those of {} (table {} of ASCE 7-16).",
                row.title, row.table
            )],
            to_confirm: vec![
                CLAUSE_RECALLED,
                "A_ie, the largest acceleration of the floor: TBDY 2018 takes it from an analysis of the building, here it is \
                 0.4 S_DS (1 + 2 z/H) of ASCE 7-16",
            ],
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
        let (shape, reason) = if self.is_flexible() {
            let above = usize::from(level_ratio > 0.0);
            (
                RESONANT_RATIO[above],
                "a flexible bracket: an elastic part in resonance",
            )
        } else {
            (1.0, "a rigid part")
        };
        let shape = Factor::recalled(
            "amplification",
            "C_i",
            settings.amplification_ratio,
            shape,
            reason,
        );
        let response = self.response("C_ph", 1.0, "elastic");
        let structure = Factor::recalled(
            "building_ductility",
            "C_str",
            None,
            1.0,
            "a building that does not yield",
        );
        let risk = Factor::recalled("importance", "R_p", settings.importance_ratio, 1.0, "");
        let overstrength =
            self.overstrength(1.0, "NZS 3101 has rules of its own for anchors in concrete");
        let part = Ts1170_5Part {
            structure_ratio: structure.value,
            spectral_ratio: shape.value,
            response_ratio: response.value,
            risk_ratio: risk.value,
        };
        let numbers = format!(
            "{} × {}/{} × {}/{} × {}",
            number(pga_g, 4),
            number(height, 4),
            structure.number(),
            shape.number(),
            response.number(),
            risk.number()
        );
        let how = match self.place.building_period_s {
            Some(_) => "the floor and the period of the building",
            None => "the floor: 1 + 2.5 z/h, because the period of the building is not known",
        };
        Some(Source {
            kind: RestraintKind::OwnCode,
            code: Some("TS 1170.5"),
            clause: "section 8",
            name: "TS 1170.5:2025, section 8",
            force: ts1170_5_force(pga_g, height, &part),
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            equation: "F_ph = PGA (C_Hi/C_str)(C_i/C_ph) R_p W".to_owned(),
            numbers,
            factors: self.factors(
                Factor::found("ground_acceleration", "PGA", pga_g, "g", "the hazard"),
                Factor::found("height", "C_Hi", height, "1", how),
                [structure, shape, response, risk, overstrength],
            ),
            remarks: vec![
                "The reserve of the part, which also divides, and the upper limit of the force are not used: both would lower \
                 it."
                .to_owned(),
            ],
            to_confirm: vec![
                CLAUSE_RECALLED,
                "C_Hi, which is taken as H_f of ASCE 7-22",
            ],
        })
    }
}
