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
use freestand_input::words::number;
use freestand_study::study::assessment::Bracket;

use crate::result::RestraintKind;

mod recalled;

use super::RestraintQuestion;
use super::components::Component;
use super::factor::{Factor, FactorSource, said};

/// Height of a building that every code counts as tall \[m\]: from 12 m on the factor of AS 1170.4
/// depends on z/h alone, from 60 m on that of NZS 1170.5, where it is largest.
const TALL_M: f64 = 60.0;

/// What nobody has read of AS 1170.4, NZS 1170.5, TBDY 2018 and TS 1170.5.
const CLAUSE_RECALLED: &str =
    "the formula of this clause and its limits, which are quoted from memory";

/// The same of ASCE 7: the weight that holds the object down.
const COMBINATION_RECALLED: &str =
    "the load combination 0.9 D − 0.2 S_DS D (2.3.6, 12.4.2.2), quoted from memory";

/// What of tables that were read in another edition must be confirmed.
const OTHER_EDITION: &str = "that ASCE 7-16 has kept a_p and R_p of the edition that was read";

/// What an object is that nobody has named.
const UNNAMED: &str = "what the object is: no row of tables 13.5-1 and 13.6-1 was named, so the one for other components \
                       stands here";

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

/// A force by one source.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// What kind of source it is.
    pub kind: RestraintKind,
    /// The code as it is printed; `None` for the acceleration of a floor.
    pub code: Option<&'static str>,
    /// The clause, without the code.
    pub clause: &'static str,
    /// Code and clause.
    pub name: &'static str,
    /// Force over weight, with the result of the formula and its limits.
    pub force: PartForce,
    /// Share of the weight that is deducted for vertical shaking.
    pub(super) vertical_ratio: f64,
    /// That share in words, `0.2 S_DS`; empty where the source has none.
    pub(super) vertical_words: &'static str,
    /// Ω₀, factor on the force of anchors in concrete.
    pub(super) overstrength_ratio: f64,
    /// The formula with its limits, in symbols.
    pub equation: String,
    /// The same in numbers: `0.4 × 1 × 1 × 3 × 1/2.5`.
    pub numbers: String,
    /// What the formula is made from: the hazard, the floor, the part.
    pub factors: Vec<Factor>,
    /// What the reader must know, a sentence each.
    pub remarks: Vec<String>,
    /// What nobody has read, beside the factors that say so: what an engineer must confirm.
    pub to_confirm: Vec<&'static str>,
}

/// What nobody has read in the code.
#[derive(Debug, Clone, PartialEq)]
pub struct Unread {
    /// What it is: a factor with what it stands for, or a clause.
    pub what: String,
    /// The value that was used; empty for a clause.
    pub value: String,
}

impl Source {
    /// The factors and clauses that nobody has read.
    pub fn unread(&self) -> Vec<Unread> {
        let factor = |factor: &Factor| {
            let what = match factor.source {
                FactorSource::Recalled("") => factor.symbol.to_owned(),
                FactorSource::Recalled(reason) => format!("{}: {reason}", factor.symbol),
                FactorSource::Given
                | FactorSource::Assumed(_)
                | FactorSource::Found(_)
                | FactorSource::Read(_) => return None,
            };
            let value = factor.number();
            Some(Unread { what, value })
        };
        let clause = |what: &&str| Unread {
            what: (*what).to_owned(),
            value: String::new(),
        };
        let factors = self.factors.iter().filter_map(factor);
        factors.chain(self.to_confirm.iter().map(clause)).collect()
    }

    /// The formula with its numbers, the factors and what was assumed.
    pub(super) fn note(&self, stated: &str) -> String {
        let mut note = format!(
            "{}: {} = {} W{}.{}",
            self.equation,
            self.numbers,
            number(self.force.formula_ratio, 4),
            governs(&self.force),
            said(&self.factors, stated)
        );
        for remark in &self.remarks {
            note.push(' ');
            note.push_str(remark);
        }
        if !self.to_confirm.is_empty() {
            note.push_str(&format!(
                " An engineer must confirm {}.",
                self.to_confirm.join("; ")
            ));
        }
        note
    }
}

impl Source {
    /// ` (0.2 S_DS is deducted for vertical shaking)`; empty where nothing is.
    pub fn deduction_words(&self) -> String {
        if self.vertical_words.is_empty() {
            return String::new();
        }
        format!(
            " ({} is deducted for vertical shaking)",
            self.vertical_words
        )
    }
}

/// `; the lower limit governs: 0.05 W`, where a limit does.
fn governs(force: &PartForce) -> String {
    let limit = |name: &str| {
        format!(
            "; the {name} limit governs: {} W",
            number(force.force_ratio, 4)
        )
    };
    match force.governing {
        Governing::Formula => String::new(),
        Governing::Minimum => limit("lower"),
        Governing::Maximum => limit("upper"),
    }
}

/// Sa(0), or Sa at the shortest period of a table.
fn ground_g(spectrum: &CodeSpectrum) -> f64 {
    spectrum.sa_g(spectrum.shortest_period_s())
}

/// A clause of ASCE 7 with its numbers.
struct Clause {
    force: PartForce,
    equation: &'static str,
    numbers: String,
    overstrength_ratio: f64,
    factors: Vec<Factor>,
}

/// The factors that every source asks the question for.
struct Asked<'a> {
    question: &'a RestraintQuestion,
    place: PartsQuestion,
    /// Empty where the height of the building is known.
    tall: Option<String>,
}

impl<'a> Asked<'a> {
    fn new(question: &'a RestraintQuestion) -> Self {
        let tall = "The height of the building was not given; a tall one is assumed.";
        let place = PartsQuestion {
            level_ratio: question.object.level_ratio,
            building_height_m: Some(question.building_height_m.unwrap_or(TALL_M)),
            building_period_s: question.building_period_s,
        };
        let is_known = question.building_height_m.is_some() || question.object.level_ratio <= 0.0;
        Self {
            question,
            place,
            tall: (!is_known).then(|| tall.to_owned()),
        }
    }

    fn is_flexible(&self) -> bool {
        self.question.settings.bracket == Bracket::Flexible
    }

    /// The amplification on a rigid and on a flexible bracket.
    fn amplification(&self, symbol: &'static str, rigid: f64, flexible: f64) -> Factor {
        self.amplified(
            "amplification",
            symbol,
            self.question.settings.amplification_ratio,
            [rigid, flexible],
        )
    }

    fn amplified(
        &self,
        key: &'static str,
        symbol: &'static str,
        stated: Option<f64>,
        assumed: [f64; 2],
    ) -> Factor {
        let [rigid, flexible] = assumed;
        let (assumed, reason) = if self.is_flexible() {
            (flexible, "a flexible bracket")
        } else {
            (rigid, "a rigid bracket")
        };
        Factor::new(key, symbol, stated, assumed, reason)
    }

    fn response(&self, symbol: &'static str, value: f64, reason: &'static str) -> Factor {
        Factor::recalled(
            "response",
            symbol,
            self.question.settings.response_ratio,
            value,
            reason,
        )
    }

    /// The row of the object in the tables of ASCE 7, and whether somebody has named it.
    fn component(&self) -> Option<&'static Component> {
        self.question.object.component.or_else(Component::other)
    }

    /// What an engineer must confirm of a force by ASCE 7.
    fn unconfirmed(&self, edition: Asce7Edition) -> Vec<&'static str> {
        let is_named = self
            .question
            .object
            .component
            .is_some_and(|row| !row.is_other());
        let is_read = self.component().is_some_and(|row| row.source_16.is_some());
        let mut list = vec![COMBINATION_RECALLED];
        list.extend((edition == Asce7Edition::Asce7_16 && is_read).then_some(OTHER_EDITION));
        list.extend((!is_named).then_some(UNNAMED));
        list
    }

    fn importance(&self, symbol: &'static str) -> Factor {
        let (assumed, reason) = if self.question.object.is_critical {
            (CRITICAL_RATIO, "life safety is rated high")
        } else {
            (1.0, "")
        };
        Factor::new(
            "importance",
            symbol,
            self.question.settings.importance_ratio,
            assumed,
            reason,
        )
    }

    fn overstrength(&self, value: f64, reason: &'static str) -> Factor {
        Factor::recalled(
            "overstrength",
            "Ω_0",
            self.question.settings.overstrength_ratio,
            value,
            reason,
        )
    }

    /// z/h.
    fn level(&self) -> Factor {
        Factor::found(
            "level_ratio",
            "z/h",
            self.place.level_ratio,
            "1",
            "the floor",
        )
    }

    fn kind(&self, is_own: bool) -> RestraintKind {
        if is_own {
            RestraintKind::OwnCode
        } else {
            RestraintKind::OtherCode
        }
    }

    fn australia(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let is_own = matches!(spectrum, CodeSpectrum::As1170_4(_));
        // a_x depends on the place alone: floor over ground acceleration of any spectrum of this
        // code.
        let floor_g = if is_own {
            floor_acceleration_g(spectrum, &self.place)?
        } else {
            ground_g(spectrum)
                * as1170_4_height_ratio(self.place.level_ratio, self.place.building_height_m?)
        };
        let ground_g = ground_g(spectrum);
        let borrowed =
            (!is_own).then(|| "kpZ Ch(0) is taken as Sa(0) of the study's spectrum.".to_owned());
        let importance = self.importance("I_c");
        let amplification = self.amplification("a_c", 1.0, FLEXIBLE_RATIO);
        let ductility = self.response(
            "R_c",
            1.0,
            "2.5 where the connection is shown to be ductile",
        );
        let overstrength =
            self.overstrength(1.0, "AS 5216 has rules of its own for anchors in concrete");
        let force = as1170_4_force(
            floor_g,
            &As1170_4Part {
                amplification_ratio: amplification.value,
                ductility_ratio: ductility.value,
                importance_ratio: importance.value,
            },
        );
        let numbers = format!(
            "{} × {} × {}/{}",
            number(floor_g, 4),
            importance.number(),
            amplification.number(),
            ductility.number()
        );
        let height = as1170_4_height_ratio(self.place.level_ratio, self.place.building_height_m?);
        Some(Source {
            kind: self.kind(is_own),
            code: Some("AS 1170.4"),
            clause: "section 8",
            name: "AS 1170.4-2007, section 8",
            force,
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            equation: "F_c = kpZ Ch(0) a_x I_c a_c/R_c W, from 0.05 W to 0.5 W".to_owned(),
            numbers,
            factors: self.factors(
                Factor::found(
                    "ground_acceleration",
                    "kpZ Ch(0)",
                    ground_g,
                    "g",
                    "the hazard",
                ),
                Factor::found("height", "a_x", height, "1", "the floor: 1 + kc hx"),
                [importance, amplification, ductility, overstrength],
            ),
            remarks: borrowed.into_iter().chain(self.tall.clone()).collect(),
            to_confirm: vec![CLAUSE_RECALLED],
        })
    }

    fn america(&self, spectrum: &CodeSpectrum, edition: Asce7Edition) -> Option<Source> {
        let sds_g = spectrum.plateau_g();
        let own = self.own_edition(spectrum);
        let borrowed = own
            .is_none()
            .then(|| "S_DS is taken as the plateau of the study's spectrum.".to_owned());
        let height = asce7_height_ratio(
            edition,
            self.place.level_ratio,
            self.place.building_period_s,
        );
        let row = self.component()?;
        let (code, name, clause) = match edition {
            Asce7Edition::Asce7_16 => (
                "ASCE 7-16",
                "ASCE 7-16, 13.3.1",
                self.asce7_16(row, sds_g, height),
            ),
            Asce7Edition::Asce7_22 => (
                "ASCE 7-22",
                "ASCE 7-22, 13.3.1",
                self.asce7_22(row, sds_g, height),
            ),
        };
        let used = format!(
            "The factors are those of {} (table {}).",
            row.title, row.table
        );
        let of_older = (own == Some(Asce7Edition::Asce7_22)).then_some(spectrum).and_then(|spectrum| match spectrum {
            CodeSpectrum::Asce7(code) if code.edition() == Asce7Edition::Asce7_16 => Some(
                "The clause is that of ASCE 7-22, the code in force; S_DS is from the mapped values of ASCE 7-16."
                    .to_owned(),
            ),
            _ => None,
        });
        Some(Source {
            kind: self.kind(own == Some(edition)),
            code: Some(code),
            clause: "13.3.1",
            name,
            force: clause.force,
            vertical_ratio: VERTICAL_RATIO * sds_g,
            vertical_words: "0.2 S_DS",
            overstrength_ratio: clause.overstrength_ratio,
            equation: clause.equation.to_owned(),
            numbers: clause.numbers,
            factors: clause.factors,
            remarks: borrowed.into_iter().chain([used]).chain(of_older).collect(),
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

    fn asce7_16(&self, row: &Component, sds_g: f64, height_ratio: f64) -> Clause {
        let settings = &self.question.settings;
        let amplification = if self.is_flexible() && row.amplification_ratio < FLEXIBLE_RATIO {
            self.amplification("a_p", FLEXIBLE_RATIO, FLEXIBLE_RATIO)
        } else {
            let value = row.amplification_ratio;
            Factor::of_table(
                "amplification",
                "a_p",
                settings.amplification_ratio,
                value,
                row.source_16,
            )
        };
        let response = Factor::of_table(
            "response",
            "R_p",
            settings.response_ratio,
            row.response_ratio,
            row.source_16,
        );
        let importance = self.importance("I_p");
        let overstrength = self.overstrength(ASCE7_OVERSTRENGTH_RATIO, "anchors in concrete");
        let part = Asce7_16Part {
            amplification_ratio: amplification.value,
            response_ratio: response.value,
            importance_ratio: importance.value,
        };
        let numbers = format!(
            "0.4 × {} × {} × {} × {}/{}",
            amplification.number(),
            number(sds_g, 4),
            number(height_ratio, 4),
            importance.number(),
            response.number()
        );
        Clause {
            force: asce7_16_force(sds_g, height_ratio, &part),
            equation: "F_p = 0.4 a_p S_DS (1 + 2 z/h) I_p/R_p W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W",
            numbers,
            overstrength_ratio: overstrength.value,
            factors: self.factors(
                Factor::found("sds", "S_DS", sds_g, "g", "the hazard"),
                Factor::found("height", "1 + 2 z/h", height_ratio, "1", "the floor"),
                [amplification, response, importance, overstrength],
            ),
        }
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

    fn asce7_22(&self, row: &Component, sds_g: f64, height_ratio: f64) -> Clause {
        let settings = &self.question.settings;
        let is_at_grade = self.place.level_ratio <= 0.0;
        let [on_ground, above] = row.resonance_ratios;
        let of_row = if is_at_grade { on_ground } else { above };
        let likely = LIKELY_RESONANCE_RATIO[usize::from(!is_at_grade)];
        let stated = settings.resonance_ratio.or(settings.amplification_ratio);
        let resonance = if self.is_flexible() && of_row < likely {
            self.amplified("resonance", "C_AR", stated, [of_row, likely])
        } else {
            Factor::of_table("resonance", "C_AR", stated, of_row, row.source_22)
        };
        let stated = settings.strength_ratio.or(settings.response_ratio);
        let strength = Factor::of_table(
            "strength",
            "R_po",
            stated,
            row.strength_ratio,
            row.source_22,
        );
        let overstrength = Factor::of_table(
            "overstrength",
            "Ω_0",
            settings.overstrength_ratio,
            row.overstrength_ratio,
            row.source_22,
        );
        let ductility = if is_at_grade {
            // 13.3.1.2: whatever the building is.
            Factor::new(
                "building_ductility",
                "R_μ",
                None,
                1.0,
                "on or below the ground",
            )
        } else {
            let reason = "the ductility of the building is not known";
            let stated = settings.building_ductility_ratio;
            Factor::new(
                "building_ductility",
                "R_μ",
                stated,
                LEAST_BUILDING_DUCTILITY_RATIO,
                reason,
            )
        };
        let importance = self.importance("I_p");
        let part = Asce7_22Part {
            resonance_ratio: resonance.value,
            strength_ratio: strength.value,
            building_ductility_ratio: ductility.value,
            importance_ratio: importance.value,
            is_at_grade,
        };
        let numbers = format!(
            "0.4 × {} × {} × {}/{} × {}/{}",
            number(sds_g, 4),
            importance.number(),
            number(height_ratio, 4),
            number(part.used_building_ductility_ratio(), 4),
            resonance.number(),
            strength.number()
        );
        let how = match self.place.building_period_s {
            Some(_) => "the floor and the period of the building",
            None => "the floor: 1 + 2.5 z/h, because the period of the building is not known",
        };
        Clause {
            force: asce7_22_force(sds_g, height_ratio, &part),
            equation: "F_p = 0.4 S_DS I_p (H_f/R_μ)(C_AR/R_po) W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W",
            numbers,
            overstrength_ratio: overstrength.value,
            factors: self.factors(
                Factor::found("sds", "S_DS", sds_g, "g", "the hazard"),
                Factor::found("height", "H_f", height_ratio, "1", how),
                [ductility, resonance, strength, importance, overstrength],
            ),
        }
    }

    fn europe(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        // NTC 2018 has the force of Eurocode 8 and leaves its acceleration open.
        let (ground_g, code, clause, name, remark) = match spectrum {
            CodeSpectrum::Eurocode8(code) => (
                code.zero_period_g(),
                "Eurocode 8",
                "EN 1998-1, 4.3.5.2",
                "EN 1998-1:2004, 4.3.5.2",
                None,
            ),
            CodeSpectrum::Ntc2018(code) => (
                code.zero_period_g(),
                "NTC 2018",
                "7.2.3",
                "NTC 2018, 7.2.3",
                Some(
                    "F_a = S_a W_a/q_a by NTC 2018, 7.2.3, which leaves S_a and q_a to documents of proven \
                     reliability: they are those of EN 1998-1, 4.3.5.2.",
                ),
            ),
            _ => return None,
        };
        let stated = self.question.settings.amplification_ratio;
        // The formula has no factor for a part: a stated one multiplies the force of a rigid part.
        let period = if self.is_flexible() && stated.is_none() {
            Factor::new(
                "period_ratio",
                "T_a/T_1",
                None,
                1.0,
                "a flexible bracket: resonance",
            )
        } else {
            Factor::new("period_ratio", "T_a/T_1", None, 0.0, "a rigid part")
        };
        let known =
            stated.map(|_| Factor::new("amplification", "amplification A", stated, 1.0, ""));
        let importance = self.importance("γ_a");
        let is_cabinet = self
            .question
            .object
            .component
            .is_some_and(|row| row.is_cabinet());
        let (assumed, reason) = if is_cabinet {
            (
                2.0,
                "table 4.4, anchorage of floor-supported cabinets and book stacks",
            )
        } else {
            (
                1.0,
                "no reduction: table 4.4 has a value for floor-supported cabinets alone",
            )
        };
        let behaviour = self.response("q_a", assumed, reason);
        let overstrength = self.overstrength(
            1.0,
            "EN 1992-4 has rules of its own for anchors in concrete",
        );
        let part = Eurocode8Part {
            period_ratio: period.value,
            amplification_ratio: known.map_or(1.0, |factor| factor.value),
            importance_ratio: importance.value,
            behaviour_ratio: behaviour.value,
        };
        let amplified = if known.is_some() { "A " } else { "" };
        let times = known.map_or_else(String::new, |factor| format!("{} × ", factor.number()));
        let mut factors = vec![
            Factor::found("ground_acceleration", "α S", ground_g, "g", "the hazard"),
            self.level(),
            period,
            importance,
            behaviour,
            overstrength,
        ];
        factors.extend(known);
        Some(Source {
            kind: RestraintKind::OwnCode,
            code: Some(code),
            clause,
            name,
            force: eurocode8_force(ground_g, self.place.level_ratio, &part),
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            equation: format!(
                "F_a = α S [3 (1 + z/H)/(1 + (1 − T_a/T_1)²) − 0.5] {amplified}γ_a/q_a W, at least α S γ_a/q_a W"
            ),
            numbers: format!(
                "{} × [3 (1 + {})/(1 + (1 − {})²) − 0.5] × {times}{}/{}",
                number(ground_g, 4),
                number(self.place.level_ratio, 3),
                period.number(),
                importance.number(),
                behaviour.number()
            ),
            factors,
            remarks: remark.map(str::to_owned).into_iter().collect(),
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
        let shape = Factor::recalled(
            "amplification",
            "C_i",
            settings.amplification_ratio,
            2.0,
            "a period up to 0.75 s",
        );
        // The code multiplies by C_ph; a study states what a force is divided by.
        let response = Factor::new(
            "response",
            "C_ph",
            settings.response_ratio.map(f64::recip),
            1.0,
            "elastic",
        );
        let risk = Factor::new("importance", "R_p", settings.importance_ratio, 1.0, "");
        let overstrength =
            self.overstrength(1.0, "NZS 3101 has rules of its own for anchors in concrete");
        let part = Nzs1170_5Part {
            spectral_ratio: shape.value,
            response_ratio: response.value,
            risk_ratio: risk.value,
        };
        let height = Factor::found("height", "C_Hi", floor_g / ground_g, "1", "the floor");
        Some(Source {
            kind: RestraintKind::OwnCode,
            code: Some("NZS 1170.5"),
            clause: "section 8",
            name: "NZS 1170.5:2004, section 8",
            force: nzs1170_5_force(floor_g, &part),
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            equation: "F_ph = C(0) C_Hi C_i C_ph R_p W, at most 3.6 W".to_owned(),
            numbers: format!(
                "{} × {} × {} × {}",
                number(floor_g, 4),
                shape.number(),
                response.number(),
                risk.number()
            ),
            factors: self.factors(
                Factor::found("ground_acceleration", "C(0)", ground_g, "g", "the hazard"),
                height,
                [shape, response, risk, overstrength],
            ),
            remarks: self.tall.clone().into_iter().collect(),
            to_confirm: vec![CLAUSE_RECALLED],
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
    let amplification = asked.amplification("A", 1.0, FLEXIBLE_RATIO);
    let used_ratio = amplification.value.max(1.0);
    let overstrength = asked.overstrength(
        1.0,
        "the standard for anchors in concrete has rules of its own",
    );
    let (name, equation, pfa) = if question.is_floor_given {
        let pfa = Factor {
            source: FactorSource::Given,
            ..Factor::found("floor_acceleration", "a", pfa_g, "g", "")
        };
        (
            "the given floor acceleration",
            "F = A m a, A at least 1",
            pfa,
        )
    } else {
        let pfa = Factor::found(
            "floor_acceleration",
            "PFA",
            pfa_g,
            "g",
            "the simulated earthquakes",
        );
        let equation =
            "F = A m PFA, A at least 1, with the PFA that the accepted share of the worlds exceeds";
        ("computed floor acceleration", equation, pfa)
    };
    let ratio = used_ratio * pfa_g;
    Source {
        kind: RestraintKind::Floor,
        code: None,
        clause: "F = m a",
        name,
        force: PartForce {
            force_ratio: ratio,
            formula_ratio: ratio,
            minimum_ratio: 0.0,
            maximum_ratio: f64::INFINITY,
            governing: Governing::Formula,
        },
        vertical_ratio: 0.0,
        vertical_words: "",
        overstrength_ratio: overstrength.value,
        equation: equation.to_owned(),
        numbers: format!("{} × {} g", number(used_ratio, 4), number(pfa_g, 4)),
        factors: vec![pfa, amplification, overstrength],
        remarks: vec!["Without factors for ductility or importance.".to_owned()],
        to_confirm: Vec::new(),
    }
}
