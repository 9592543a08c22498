//! The force over the weight by each source: the clauses of the codes, and the computed floor.

use freestand::code_spectrum::part_forces::{
    As1170_4Part, Asce7_16Part, Asce7_22Part, Eurocode8Part, Governing, Nzs1170_5Part, PartForce, as1170_4_force,
    asce7_16_force, asce7_22_force, eurocode8_force, nzs1170_5_force,
};
use freestand::code_spectrum::parts::{PartsQuestion, as1170_4_height_ratio, asce7_height_ratio, floor_acceleration_g};
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};
use freestand_input::words::number;
use freestand_study::study::assessment::Bracket;

use super::RestraintQuestion;

/// Height of a building that every code counts as tall \[m\].
const TALL_M: f64 = 30.0;

const RECALLED: &str = "This clause is quoted from memory: check it in your edition of the code.";

/// Amplification of a part on a flexible bracket, whose period is not known: 2.5 in AS 1170.4 (a_c)
/// and in ASCE 7-16 (a_p), and of the computed floor.
const FLEXIBLE_RATIO: f64 = 2.5;

/// C_AR of ASCE 7-22 for a part above the ground that resonance is likely for, with moderate
/// ductility; from memory, table 13.3-1.
const LIKELY_RESONANCE_RATIO: f64 = 2.2;

/// Ω₀ of ASCE 7 for cabinets and equipment, tables 13.5-1 and 13.6-1; from memory.
const ASCE7_OVERSTRENGTH_RATIO: f64 = 2.0;

/// Importance factor of a part that is critical to life safety.
const CRITICAL_RATIO: f64 = 1.5;

/// E_v of ASCE 7 over S_DS D, 12.4.2.2.
const VERTICAL_RATIO: f64 = 0.2;

/// A force by one source.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Source {
    /// The clause.
    pub(super) name: &'static str,
    /// Whether the hazard of the study is by this code.
    pub(super) is_own: bool,
    /// Force over weight.
    pub(super) force_ratio: f64,
    /// Share of the weight that is deducted for vertical shaking.
    pub(super) vertical_ratio: f64,
    /// That share in words, `0.2 S_DS`; empty where the source has none.
    pub(super) vertical_words: &'static str,
    /// Ω₀, factor on the force of anchors in concrete.
    pub(super) overstrength_ratio: f64,
    /// The formula with its numbers, the factors and what was assumed.
    pub(super) formula: String,
}

/// A factor of a source, by the study or assumed.
#[derive(Debug, Clone, Copy)]
struct Factor {
    symbol: &'static str,
    value: f64,
    /// Why this value is assumed; may be empty.
    reason: &'static str,
    is_stated: bool,
}

impl Factor {
    fn new(symbol: &'static str, stated: Option<f64>, assumed: f64, reason: &'static str) -> Self {
        Self { symbol, value: stated.unwrap_or(assumed), reason, is_stated: stated.is_some() }
    }

    fn number(&self) -> String {
        number(self.value, 4)
    }
}

/// ` Assumed: a_p = 1 (rigid). Stated in the study: R_p = 2.`
fn said(factors: &[Factor]) -> String {
    let list = |is_stated: bool, title: &str| {
        let chosen = factors.iter().filter(|factor| factor.is_stated == is_stated);
        let each = chosen.map(|factor| match factor.reason {
            reason if !is_stated && !reason.is_empty() => format!("{} = {} ({reason})", factor.symbol, factor.number()),
            _ => format!("{} = {}", factor.symbol, factor.number()),
        });
        let each: Vec<String> = each.collect();
        if each.is_empty() { String::new() } else { format!(" {title}: {}.", each.join(", ")) }
    };
    format!("{}{}", list(false, "Assumed"), list(true, "Stated in the study"))
}

/// `; the lower limit governs: 0.05 W`, where a limit does.
fn governs(force: &PartForce) -> String {
    let limit = |name: &str| format!("; the {name} limit governs: {} W", number(force.force_ratio, 4));
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

/// The factors that every source asks the question for.
struct Asked<'a> {
    question: &'a RestraintQuestion,
    place: PartsQuestion,
    /// Empty where the height of the building is known.
    tall: &'static str,
}

impl<'a> Asked<'a> {
    fn new(question: &'a RestraintQuestion) -> Self {
        let tall = match question.building_height_m {
            Some(_) => "",
            None => " The height of the building was not given; 12 m or more is assumed.",
        };
        let place = PartsQuestion {
            level_ratio: question.level_ratio,
            building_height_m: Some(question.building_height_m.unwrap_or(TALL_M)),
            building_period_s: question.building_period_s,
        };
        Self { question, place, tall }
    }

    fn is_flexible(&self) -> bool {
        self.question.settings.bracket == Bracket::Flexible
    }

    /// The amplification on a rigid and on a flexible bracket.
    fn amplification(&self, symbol: &'static str, rigid: f64, flexible: f64) -> Factor {
        let (assumed, reason) =
            if self.is_flexible() { (flexible, "a flexible bracket") } else { (rigid, "a rigid bracket") };
        Factor::new(symbol, self.question.settings.amplification_ratio, assumed, reason)
    }

    fn response(&self, symbol: &'static str, assumed: f64, reason: &'static str) -> Factor {
        Factor::new(symbol, self.question.settings.response_ratio, assumed, reason)
    }

    fn importance(&self, symbol: &'static str) -> Factor {
        let (assumed, reason) =
            if self.question.is_critical { (CRITICAL_RATIO, "life safety is rated high") } else { (1.0, "") };
        Factor::new(symbol, self.question.settings.importance_ratio, assumed, reason)
    }

    fn overstrength(&self, assumed: f64, reason: &'static str) -> Factor {
        Factor::new("Ω_0", self.question.settings.overstrength_ratio, assumed, reason)
    }

    fn australia(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let is_own = matches!(spectrum, CodeSpectrum::As1170_4(_));
        // a_x depends on the place alone: floor over ground acceleration of any spectrum of this
        // code.
        let floor_g = if is_own {
            floor_acceleration_g(spectrum, &self.place)?
        } else {
            ground_g(spectrum) * as1170_4_height_ratio(self.place.level_ratio, self.place.building_height_m?)
        };
        let borrowed = if is_own { "" } else { " kpZ Ch(0) is taken as Sa(0) of the study's spectrum." };
        let importance = self.importance("I_c");
        let amplification = self.amplification("a_c", 1.0, FLEXIBLE_RATIO);
        let ductility = self.response("R_c", 1.0, "2.5 where the connection is shown to be ductile");
        let overstrength = self.overstrength(1.0, "AS 5216 has rules of its own for anchors in concrete");
        let found = as1170_4_force(
            floor_g,
            &As1170_4Part {
                amplification_ratio: amplification.value,
                ductility_ratio: ductility.value,
                importance_ratio: importance.value,
            },
        );
        let formula = format!(
            "F_c = kpZ Ch(0) a_x I_c a_c/R_c W, from 0.05 W to 0.5 W: {} × {} × {}/{} = {} W{}.{}{borrowed}{} \
             {RECALLED}",
            number(floor_g, 4),
            importance.number(),
            amplification.number(),
            ductility.number(),
            number(found.formula_ratio, 4),
            governs(&found),
            said(&[importance, amplification, ductility, overstrength]),
            self.tall
        );
        Some(Source {
            name: "AS 1170.4-2007, section 8",
            is_own,
            force_ratio: found.force_ratio,
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            formula,
        })
    }

    fn america(&self, spectrum: &CodeSpectrum, edition: Asce7Edition) -> Source {
        let sds_g = spectrum.plateau_g();
        let (own, borrowed) = match spectrum {
            CodeSpectrum::Asce7(code) => (Some(code.edition()), ""),
            _ => (None, " S_DS is taken as the plateau of the study's spectrum."),
        };
        let height = asce7_height_ratio(edition, self.place.level_ratio, self.place.building_period_s);
        let importance = self.importance("I_p");
        let overstrength = self.overstrength(ASCE7_OVERSTRENGTH_RATIO, "cabinets and equipment, in concrete");
        let (name, found, formula) = match edition {
            Asce7Edition::Asce7_16 => {
                let amplification = self.amplification("a_p", 1.0, FLEXIBLE_RATIO);
                let response = self.response("R_p", 2.5, "storage cabinets, laboratory equipment");
                let part = Asce7_16Part {
                    amplification_ratio: amplification.value,
                    response_ratio: response.value,
                    importance_ratio: importance.value,
                };
                let found = asce7_16_force(sds_g, height, &part);
                let formula = format!(
                    "F_p = 0.4 a_p S_DS (1 + 2 z/h) I_p/R_p W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W: \
                     0.4 × {} × {} × {} × {}/{} = {} W{}.{}",
                    amplification.number(),
                    number(sds_g, 4),
                    number(height, 4),
                    importance.number(),
                    response.number(),
                    number(found.formula_ratio, 4),
                    governs(&found),
                    said(&[amplification, response, importance, overstrength])
                );
                ("ASCE 7-16, 13.3.1", found, formula)
            }
            Asce7Edition::Asce7_22 => {
                let resonance = self.amplification("C_AR", 1.0, LIKELY_RESONANCE_RATIO);
                let strength = self.response("R_po", 1.5, "storage cabinets, laboratory equipment");
                let ductility = Factor::new("R_μ", None, 1.3, "the ductility of the building is not known");
                let part = Asce7_22Part {
                    resonance_ratio: resonance.value,
                    strength_ratio: strength.value,
                    building_ductility_ratio: ductility.value,
                    importance_ratio: importance.value,
                };
                let found = asce7_22_force(sds_g, height, &part);
                let formula = format!(
                    "F_p = 0.4 S_DS I_p (H_f/R_μ)(C_AR/R_po) W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W: \
                     0.4 × {} × {} × {}/{} × {}/{} = {} W{}.{}",
                    number(sds_g, 4),
                    importance.number(),
                    number(height, 4),
                    ductility.number(),
                    resonance.number(),
                    strength.number(),
                    number(found.formula_ratio, 4),
                    governs(&found),
                    said(&[ductility, resonance, strength, importance, overstrength])
                );
                ("ASCE 7-22, 13.3.1", found, formula)
            }
        };
        Source {
            name,
            is_own: own == Some(edition),
            force_ratio: found.force_ratio,
            vertical_ratio: VERTICAL_RATIO * sds_g,
            vertical_words: "0.2 S_DS",
            overstrength_ratio: overstrength.value,
            formula: format!("{formula}{borrowed} {RECALLED}"),
        }
    }

    fn europe(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let CodeSpectrum::Eurocode8(code) = spectrum else { return None };
        let ground_g = code.zero_period_g();
        let stated = self.question.settings.amplification_ratio;
        // The formula has no factor for a part: a stated one multiplies the force of a rigid part.
        let period = if self.is_flexible() && stated.is_none() {
            Factor::new("T_a/T_1", None, 1.0, "a flexible bracket: resonance")
        } else {
            Factor::new("T_a/T_1", None, 0.0, "a rigid part")
        };
        let known = stated.map(|_| Factor::new("amplification A", stated, 1.0, ""));
        let importance = self.importance("γ_a");
        let behaviour = self.response("q_a", 2.0, "anchorage of floor-supported cabinets");
        let overstrength = self.overstrength(1.0, "EN 1992-4 has rules of its own for anchors in concrete");
        let part = Eurocode8Part {
            period_ratio: period.value,
            amplification_ratio: known.map_or(1.0, |factor| factor.value),
            importance_ratio: importance.value,
            behaviour_ratio: behaviour.value,
        };
        let found = eurocode8_force(ground_g, self.place.level_ratio, &part);
        let mut factors = vec![period, importance, behaviour, overstrength];
        factors.extend(known);
        let formula = format!(
            "F_a = α S [3 (1 + z/H)/(1 + (1 − T_a/T_1)²) − 0.5] {}γ_a/q_a W, at least α S γ_a/q_a W, with α S = {}, \
             z/H = {}, T_a/T_1 = {}, γ_a = {}, q_a = {}: {} W{}.{} {RECALLED}",
            if known.is_some() { "A " } else { "" },
            number(ground_g, 4),
            number(self.place.level_ratio, 3),
            period.number(),
            importance.number(),
            behaviour.number(),
            number(found.formula_ratio, 4),
            governs(&found),
            said(&factors)
        );
        Some(Source {
            name: "EN 1998-1:2004, 4.3.5.2",
            is_own: true,
            force_ratio: found.force_ratio,
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            formula,
        })
    }

    fn new_zealand(&self, spectrum: &CodeSpectrum) -> Option<Source> {
        let CodeSpectrum::Nzs1170_5(_) = spectrum else { return None };
        let floor_g = floor_acceleration_g(spectrum, &self.place)?;
        let settings = &self.question.settings;
        let shape = Factor::new("C_i", settings.amplification_ratio, 2.0, "a period up to 0.75 s");
        // The code multiplies by C_ph; a study states what a force is divided by.
        let response = Factor::new("C_ph", settings.response_ratio.map(f64::recip), 1.0, "elastic");
        let risk = Factor::new("R_p", settings.importance_ratio, 1.0, "");
        let overstrength = self.overstrength(1.0, "NZS 3101 has rules of its own for anchors in concrete");
        let part =
            Nzs1170_5Part { spectral_ratio: shape.value, response_ratio: response.value, risk_ratio: risk.value };
        let found = nzs1170_5_force(floor_g, &part);
        let formula = format!(
            "F_ph = C(0) C_Hi C_i C_ph R_p W, at most 3.6 W: {} × {} × {} × {} = {} W{}.{}{} {RECALLED}",
            number(floor_g, 4),
            shape.number(),
            response.number(),
            risk.number(),
            number(found.formula_ratio, 4),
            governs(&found),
            said(&[shape, response, risk, overstrength]),
            self.tall
        );
        Some(Source {
            name: "NZS 1170.5:2004, section 8",
            is_own: true,
            force_ratio: found.force_ratio,
            vertical_ratio: 0.0,
            vertical_words: "",
            overstrength_ratio: overstrength.value,
            formula,
        })
    }
}

/// The forces by the codes.
pub(super) fn codes(question: &RestraintQuestion) -> Vec<Source> {
    let Some(spectrum) = &question.spectrum else { return Vec::new() };
    let asked = Asked::new(question);
    [asked.europe(spectrum), asked.new_zealand(spectrum), asked.australia(spectrum)]
        .into_iter()
        .flatten()
        .chain([Asce7Edition::Asce7_16, Asce7Edition::Asce7_22].map(|edition| asked.america(spectrum, edition)))
        .collect()
}

/// The force by the computed floor: F = m A PFA, with A at least 1.
pub(super) fn computed_floor(question: &RestraintQuestion, pfa_g: f64) -> Source {
    let asked = Asked::new(question);
    let amplification = asked.amplification("A", 1.0, FLEXIBLE_RATIO);
    let used_ratio = amplification.value.max(1.0);
    let overstrength = asked.overstrength(1.0, "the standard for anchors in concrete has rules of its own");
    let force_ratio = used_ratio * pfa_g;
    let formula = format!(
        "F = A m PFA, A at least 1, with the PFA that the accepted share of the worlds exceeds: {} × {} g = {} W.{} \
         Without factors for ductility or importance.",
        number(used_ratio, 4),
        number(pfa_g, 4),
        number(force_ratio, 4),
        said(&[amplification, overstrength])
    );
    Source {
        name: "computed floor acceleration",
        is_own: true,
        force_ratio,
        vertical_ratio: 0.0,
        vertical_words: "",
        overstrength_ratio: overstrength.value,
        formula,
    }
}
