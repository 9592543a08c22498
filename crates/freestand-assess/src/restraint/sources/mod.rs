//! The force over the weight by each source: the clauses of the codes, and the acceleration of the
//! floor.

use freestand::code_spectrum::part_forces::{
    As1170_4Part, Asce7_16Part, Asce7_22Part, Eurocode8Part, Governing,
    LEAST_BUILDING_DUCTILITY_RATIO, Nzs1170_5Part, PartForce, as1170_4_force, asce7_16_force,
    asce7_22_force, eurocode8_force, nzs1170_5_force,
};
use freestand::code_spectrum::parts::{
    PartsQuestion, as1170_4_height_ratio, asce7_height_ratio, floor_acceleration_g,
};
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};
use freestand_study::study::assessment::Bracket;

mod recalled;

use super::RestraintQuestion;
use super::components::Component;
use super::factor::{Assumed, Factor, FactorKey, FactorSource, Found, Recalled};
use super::source::{Clause, Remark, Source, SourceKind, Unread};

/// Height of a building that every code counts as tall \[m\]: from 12 m on the factor of AS 1170.4
/// depends on z/h alone, from 60 m on that of NZS 1170.5, where it is largest.
const TALL_M: f64 = 60.0;

/// Amplification of a part on a flexible bracket, whose period is not known: 2.5 in AS 1170.4 (a_c)
/// and in ASCE 7-16 (a_p), and of the computed floor.
const FLEXIBLE_RATIO: f64 = 2.5;

/// C_AR of ASCE 7-22 for a part that resonance is likely for: at or below the ground, and above it, as
/// for equipment on vibration isolators in table 13.6-1.
const LIKELY_RESONANCE_RATIO: [f64; 2] = [1.8, 2.2];

/// Ω₀ of ASCE 7-16, tables 13.5-1 and 13.6-1; from memory.
const ASCE7_OVERSTRENGTH_RATIO: f64 = 2.0;

/// Importance factor of a part that is critical to life safety.
const CRITICAL_RATIO: f64 = 1.5;

/// E_v of ASCE 7 over S_DS D, 12.4.2.2.
const VERTICAL_RATIO: f64 = 0.2;

/// Sa(0), or Sa at the shortest period of a table.
fn ground_g(spectrum: &CodeSpectrum) -> f64 {
    spectrum.sa_g(spectrum.shortest_period_s())
}

/// The factors that every source asks the question for.
struct Asked<'a> {
    question: &'a RestraintQuestion,
    place: PartsQuestion,
    /// The height of the building is not known.
    tall: Option<Remark>,
}

impl<'a> Asked<'a> {
    fn new(question: &'a RestraintQuestion) -> Self {
        let place = PartsQuestion {
            level_ratio: question.object.level_ratio,
            building_height_m: Some(question.building_height_m.unwrap_or(TALL_M)),
            building_period_s: question.building_period_s,
        };
        let is_known = question.building_height_m.is_some() || question.object.level_ratio <= 0.0;
        Self {
            question,
            place,
            tall: (!is_known).then_some(Remark::TallBuilding),
        }
    }

    fn is_flexible(&self) -> bool {
        self.question.settings.bracket == Bracket::Flexible
    }

    /// The amplification on a rigid and on a flexible bracket.
    fn amplification(&self, rigid: f64, flexible: f64) -> Factor {
        self.amplified(
            FactorKey::Amplification,
            self.question.settings.amplification_ratio,
            [rigid, flexible],
        )
    }

    fn amplified(&self, key: FactorKey, stated: Option<f64>, assumed: [f64; 2]) -> Factor {
        let [rigid, flexible] = assumed;
        let (value, why) = if self.is_flexible() {
            (flexible, Assumed::FlexibleBracket)
        } else {
            (rigid, Assumed::RigidBracket)
        };
        Factor::new(key, stated, value, FactorSource::Assumed(why))
    }

    fn response(&self, value: f64, why: Recalled) -> Factor {
        let stated = self.question.settings.response_ratio;
        let source = FactorSource::Recalled(why);
        Factor::new(FactorKey::Response, stated, value, source)
    }

    /// The row of the object in the tables of ASCE 7, or that of all others.
    fn component(&self) -> Option<&'static Component> {
        self.question.object.component.or_else(Component::other)
    }

    /// What an engineer must confirm of a force by ASCE 7.
    fn unconfirmed(&self, edition: Asce7Edition) -> Vec<Unread> {
        let is_named = self
            .question
            .object
            .component
            .is_some_and(|row| !row.is_other());
        let is_read = self.component().is_some_and(|row| row.source_16.is_some());
        let is_other_edition = edition == Asce7Edition::Asce7_16 && is_read;
        let mut list = vec![Unread::LoadCombination];
        list.extend(is_other_edition.then_some(Unread::OtherEdition));
        list.extend((!is_named).then_some(Unread::Component));
        list
    }

    fn importance(&self) -> Factor {
        let (value, why) = if self.question.object.is_critical {
            (CRITICAL_RATIO, Assumed::LifeSafety)
        } else {
            (1.0, Assumed::Ordinary)
        };
        let stated = self.question.settings.importance_ratio;
        Factor::new(
            FactorKey::Importance,
            stated,
            value,
            FactorSource::Assumed(why),
        )
    }

    fn overstrength(&self, value: f64) -> Factor {
        let stated = self.question.settings.overstrength_ratio;
        let source = FactorSource::Recalled(Recalled::Concrete);
        Factor::new(FactorKey::Overstrength, stated, value, source)
    }

    /// z/h.
    fn level(&self) -> Factor {
        Factor::found(FactorKey::LevelRatio, self.place.level_ratio, Found::Floor)
    }

    /// H_f of ASCE 7-22.
    fn height_of_22(&self, height_ratio: f64) -> Factor {
        let from = match self.place.building_period_s {
            Some(_) => Found::FloorAndPeriod,
            None => Found::FloorWithoutPeriod,
        };
        Factor::found(FactorKey::Height, height_ratio, from)
    }

    fn kind(&self, is_own: bool) -> SourceKind {
        if is_own {
            SourceKind::OwnCode
        } else {
            SourceKind::OtherCode
        }
    }

    fn australia(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let is_own = matches!(spectrum, CodeSpectrum::As1170_4(_));
        // a_x depends on the place alone: floor over ground acceleration of any spectrum of this
        // code.
        let height = as1170_4_height_ratio(self.place.level_ratio, self.place.building_height_m?);
        let floor_g = if is_own {
            floor_acceleration_g(spectrum, &self.place)?
        } else {
            ground_g(spectrum) * height
        };
        let importance = self.importance();
        let amplification = self.amplification(1.0, FLEXIBLE_RATIO);
        let ductility = self.response(1.0, Recalled::BrittleConnection);
        let part = As1170_4Part {
            amplification_ratio: amplification.value,
            ductility_ratio: ductility.value,
            importance_ratio: importance.value,
        };
        let borrowed = (!is_own).then_some(Remark::OtherSpectrum);
        Some(Source {
            kind: self.kind(is_own),
            clause: Clause::As1170_4,
            part: as1170_4_force(floor_g, &part),
            vertical_ratio: 0.0,
            factors: self.factors(
                Factor::found(
                    FactorKey::GroundAcceleration,
                    ground_g(spectrum),
                    Found::Hazard,
                ),
                Factor::found(FactorKey::Height, height, Found::FloorAlongLine),
                [importance, amplification, ductility, self.overstrength(1.0)],
            ),
            component: None,
            remarks: borrowed.into_iter().chain(self.tall).collect(),
            to_confirm: vec![Unread::Formula],
        })
    }

    fn america(&self, spectrum: &CodeSpectrum, edition: Asce7Edition) -> Option<Source> {
        let sds_g = spectrum.plateau_g();
        let own = self.own_edition(spectrum);
        let height = asce7_height_ratio(
            edition,
            self.place.level_ratio,
            self.place.building_period_s,
        );
        let row = self.component()?;
        let (clause, (part, factors)) = match edition {
            Asce7Edition::Asce7_16 => (Clause::Asce7_16, self.asce7_16(row, sds_g, height)),
            Asce7Edition::Asce7_22 => (Clause::Asce7_22, self.asce7_22(row, sds_g, height)),
        };
        let is_older = own == Some(Asce7Edition::Asce7_22)
            && matches!(spectrum, CodeSpectrum::Asce7(code) if code.edition() == Asce7Edition::Asce7_16);
        let remarks = [
            own.is_none().then_some(Remark::OtherSpectrum),
            Some(Remark::Row),
            is_older.then_some(Remark::OlderSpectrum),
        ];
        Some(Source {
            kind: self.kind(own == Some(edition)),
            clause,
            part,
            vertical_ratio: VERTICAL_RATIO * sds_g,
            factors,
            component: Some(row),
            remarks: remarks.into_iter().flatten().collect(),
            to_confirm: self.unconfirmed(edition),
        })
    }

    /// The edition by which the parts are designed where the hazard is by ASCE 7: that in force, else
    /// that of the spectrum.
    fn own_edition(&self, spectrum: &CodeSpectrum) -> Option<Asce7Edition> {
        let CodeSpectrum::Asce7(code) = spectrum else {
            return None;
        };
        Some(self.question.parts_edition.unwrap_or(code.edition()))
    }

    fn asce7_16(&self, row: &Component, sds_g: f64, height_ratio: f64) -> (PartForce, Vec<Factor>) {
        let settings = &self.question.settings;
        let of_row =
            |key, stated, value| Factor::of_row(key, stated, value, row.source_16.is_some());
        let amplification = if self.is_flexible() && row.amplification_ratio < FLEXIBLE_RATIO {
            self.amplification(FLEXIBLE_RATIO, FLEXIBLE_RATIO)
        } else {
            of_row(
                FactorKey::Amplification,
                settings.amplification_ratio,
                row.amplification_ratio,
            )
        };
        let response = of_row(
            FactorKey::Response,
            settings.response_ratio,
            row.response_ratio,
        );
        let importance = self.importance();
        let part = Asce7_16Part {
            amplification_ratio: amplification.value,
            response_ratio: response.value,
            importance_ratio: importance.value,
        };
        let factors = self.factors(
            Factor::found(FactorKey::Sds, sds_g, Found::Hazard),
            Factor::found(FactorKey::Height, height_ratio, Found::Floor),
            [
                amplification,
                response,
                importance,
                self.overstrength(ASCE7_OVERSTRENGTH_RATIO),
            ],
        );
        (asce7_16_force(sds_g, height_ratio, &part), factors)
    }

    /// The ground, the floor, what both give, and the numbers of the part.
    fn factors<const N: usize>(
        &self,
        ground: Factor,
        height: Factor,
        part: [Factor; N],
    ) -> Vec<Factor> {
        [ground, self.level(), height]
            .into_iter()
            .chain(part)
            .collect()
    }

    fn asce7_22(&self, row: &Component, sds_g: f64, height_ratio: f64) -> (PartForce, Vec<Factor>) {
        let settings = &self.question.settings;
        let of_row =
            |key, stated, value| Factor::of_row(key, stated, value, row.source_22.is_some());
        let is_at_grade = self.place.level_ratio <= 0.0;
        let [on_ground, above] = row.resonance_ratios;
        let of_place = if is_at_grade { on_ground } else { above };
        let likely = LIKELY_RESONANCE_RATIO[usize::from(!is_at_grade)];
        let stated = settings.resonance_ratio.or(settings.amplification_ratio);
        let resonance = if self.is_flexible() && of_place < likely {
            self.amplified(FactorKey::Resonance, stated, [of_place, likely])
        } else {
            of_row(FactorKey::Resonance, stated, of_place)
        };
        let strength = of_row(
            FactorKey::Strength,
            settings.strength_ratio.or(settings.response_ratio),
            row.strength_ratio,
        );
        let overstrength = of_row(
            FactorKey::Overstrength,
            settings.overstrength_ratio,
            row.overstrength_ratio,
        );
        // 13.3.1.2: on or below the ground 1, whatever the building is.
        let (stated, value, why) = if is_at_grade {
            (None, 1.0, Assumed::AtGrade)
        } else {
            (
                settings.building_ductility_ratio,
                LEAST_BUILDING_DUCTILITY_RATIO,
                Assumed::UnknownDuctility,
            )
        };
        let source = FactorSource::Assumed(why);
        let ductility = Factor::new(FactorKey::BuildingDuctility, stated, value, source);
        let importance = self.importance();
        let part = Asce7_22Part {
            resonance_ratio: resonance.value,
            strength_ratio: strength.value,
            building_ductility_ratio: ductility.value,
            importance_ratio: importance.value,
            is_at_grade,
        };
        let factors = self.factors(
            Factor::found(FactorKey::Sds, sds_g, Found::Hazard),
            self.height_of_22(height_ratio),
            [ductility, resonance, strength, importance, overstrength],
        );
        (asce7_22_force(sds_g, height_ratio, &part), factors)
    }

    fn europe(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        // NTC 2018 has the force of Eurocode 8 and leaves its acceleration open.
        let (ground_g, clause, remark) = match spectrum {
            CodeSpectrum::Eurocode8(code) => (code.zero_period_g(), Clause::Eurocode8, None),
            CodeSpectrum::Ntc2018(code) => (
                code.zero_period_g(),
                Clause::Ntc2018,
                Some(Remark::LeftOpen),
            ),
            _ => return None,
        };
        let stated = self.question.settings.amplification_ratio;
        // The formula has no factor for a part: a stated one multiplies the force of a rigid part.
        let (period_ratio, why) = if self.is_flexible() && stated.is_none() {
            (1.0, Assumed::Resonance)
        } else {
            (0.0, Assumed::RigidPart)
        };
        let source = FactorSource::Assumed(why);
        let period = Factor::new(FactorKey::PeriodRatio, None, period_ratio, source);
        let known = stated
            .map(|value| Factor::new(FactorKey::Amplification, None, value, FactorSource::Given));
        let importance = self.importance();
        let component = self.question.object.component;
        let behaviour = if component.is_some_and(Component::is_cabinet) {
            self.response(2.0, Recalled::Cabinet)
        } else {
            self.response(1.0, Recalled::NoCabinet)
        };
        let part = Eurocode8Part {
            period_ratio,
            amplification_ratio: stated.unwrap_or(1.0),
            importance_ratio: importance.value,
            behaviour_ratio: behaviour.value,
        };
        let mut factors = vec![
            Factor::found(FactorKey::GroundAcceleration, ground_g, Found::Hazard),
            self.level(),
            period,
            importance,
            behaviour,
            self.overstrength(1.0),
        ];
        factors.extend(known);
        Some(Source {
            kind: SourceKind::OwnCode,
            clause,
            part: eurocode8_force(ground_g, self.place.level_ratio, &part),
            vertical_ratio: 0.0,
            factors,
            component: None,
            remarks: remark.into_iter().collect(),
            to_confirm: Vec::new(),
        })
    }

    fn new_zealand(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let CodeSpectrum::Nzs1170_5(_) = spectrum else {
            return None;
        };
        let floor_g = floor_acceleration_g(spectrum, &self.place)?;
        let ground_g = ground_g(spectrum);
        let settings = &self.question.settings;
        let shape = Factor::new(
            FactorKey::Amplification,
            settings.amplification_ratio,
            2.0,
            FactorSource::Recalled(Recalled::ShortPeriod),
        );
        // The code multiplies by C_ph; a study states what a force is divided by.
        let response = Factor::new(
            FactorKey::Response,
            settings.response_ratio.map(f64::recip),
            1.0,
            FactorSource::Assumed(Assumed::Elastic),
        );
        let risk = Factor::new(
            FactorKey::Importance,
            settings.importance_ratio,
            1.0,
            FactorSource::Assumed(Assumed::Ordinary),
        );
        let part = Nzs1170_5Part {
            spectral_ratio: shape.value,
            response_ratio: response.value,
            risk_ratio: risk.value,
        };
        Some(Source {
            kind: SourceKind::OwnCode,
            clause: Clause::Nzs1170_5,
            part: nzs1170_5_force(floor_g, &part),
            vertical_ratio: 0.0,
            factors: self.factors(
                Factor::found(FactorKey::GroundAcceleration, ground_g, Found::Hazard),
                Factor::found(FactorKey::Height, floor_g / ground_g, Found::Floor),
                [shape, response, risk, self.overstrength(1.0)],
            ),
            component: None,
            remarks: self.tall.into_iter().collect(),
            to_confirm: vec![Unread::Formula],
        })
    }
}

/// The forces by the codes.
pub(super) fn codes(question: &RestraintQuestion) -> Vec<Source> {
    let Some(spectrum) = &question.spectrum else {
        return Vec::new();
    };
    let asked = Asked::new(question);
    [
        asked.europe(spectrum),
        asked.new_zealand(spectrum),
        asked.turkey(spectrum),
        asked.new_zealand_ts(spectrum),
        asked.australia(spectrum),
    ]
    .into_iter()
    .flatten()
    .chain(
        [Asce7Edition::Asce7_16, Asce7Edition::Asce7_22]
            .into_iter()
            .filter_map(|edition| asked.america(spectrum, edition)),
    )
    .collect()
}

/// The force by the acceleration of the floor: F = m A PFA, with A at least 1. It is that of
/// simulated earthquakes, or one that the user gives.
pub(super) fn floor(question: &RestraintQuestion, pfa_g: f64) -> Source {
    let asked = Asked::new(question);
    let amplification = asked.amplification(1.0, FLEXIBLE_RATIO);
    let (clause, source) = if question.is_floor_given {
        (Clause::GivenFloor, FactorSource::Given)
    } else {
        (Clause::ComputedFloor, FactorSource::Found(Found::Worlds))
    };
    let pfa = Factor::new(FactorKey::FloorAcceleration, None, pfa_g, source);
    let ratio = amplification.value.max(1.0) * pfa_g;
    Source {
        kind: SourceKind::Floor,
        clause,
        part: PartForce {
            force_ratio: ratio,
            formula_ratio: ratio,
            minimum_ratio: 0.0,
            maximum_ratio: None,
            governing: Governing::Formula,
        },
        vertical_ratio: 0.0,
        factors: vec![pfa, amplification, asked.overstrength(1.0)],
        component: None,
        remarks: vec![Remark::NoReduction],
        to_confirm: Vec::new(),
    }
}
