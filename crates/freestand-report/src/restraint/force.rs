//! A force of a restraint in words: its clause, its formula with the numbers, who states its factors, what
//! nobody has read in the code, and how anchors and a bracket follow from it.

use freestand::code_spectrum::part_forces::{Governing, PartForce};
use freestand_assess::restraint::RestraintAxis;
use freestand_assess::restraint::factor::{
    Assumed, Factor, FactorKey, FactorSource, Found, Recalled,
};
use freestand_assess::restraint::footing::Pivot;
use freestand_assess::restraint::force::{FOOT_FRICTION_RATIO, RestraintForce};
use freestand_assess::restraint::source::{Clause, Remark, Source, SourceKind, Unread};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;

/// The names of a clause.
pub(super) struct Names {
    /// The code as it is printed; `None` for the acceleration of a floor.
    pub(super) code: Option<&'static str>,
    /// The clause, without the code.
    pub(super) clause: &'static str,
    /// Code and clause.
    name: &'static str,
}

/// The names of a clause.
pub(super) fn names(clause: Clause) -> Names {
    let named = |code, clause, name| Names {
        code: Some(code),
        clause,
        name,
    };
    let floor = |name| Names {
        code: None,
        clause: "F = m a",
        name,
    };
    match clause {
        Clause::As1170_4 => named("AS 1170.4", "section 8", "AS 1170.4-2007, section 8"),
        Clause::Asce7_16 => named("ASCE 7-16", "13.3.1", "ASCE 7-16, 13.3.1"),
        Clause::Asce7_22 => named("ASCE 7-22", "13.3.1", "ASCE 7-22, 13.3.1"),
        Clause::Eurocode8 => named(
            "Eurocode 8",
            "EN 1998-1, 4.3.5.2",
            "EN 1998-1:2004, 4.3.5.2",
        ),
        Clause::Ntc2018 => named("NTC 2018", "7.2.3", "NTC 2018, 7.2.3"),
        Clause::Nzs1170_5 => named("NZS 1170.5", "section 8", "NZS 1170.5:2004, section 8"),
        Clause::Tbdy2018 => named("TBDY 2018", "chapter 6", "TBDY 2018, chapter 6"),
        Clause::Ts1170_5 => named("TS 1170.5", "section 8", "TS 1170.5:2025, section 8"),
        Clause::GivenFloor => floor("the given floor acceleration"),
        Clause::ComputedFloor => floor("computed floor acceleration"),
    }
}

/// Code and clause of a force: `ASCE 7-16, 13.3.1`, `computed floor acceleration`.
pub(crate) fn source_name(source: &Source) -> &'static str {
    names(source.clause).name
}

/// What a number by such a source is.
pub(crate) fn kind_words(kind: SourceKind) -> &'static str {
    match kind {
        SourceKind::OwnCode => "a clause of the study's code",
        SourceKind::Floor => "the floor of the simulated earthquakes",
        SourceKind::OtherCode => "a clause of another code, for comparison",
    }
}

/// The symbol of a factor in a code. Where a code has no such factor, the symbol is that of a similar code.
pub(super) fn symbol(clause: Clause, key: FactorKey) -> &'static str {
    use Clause::*;
    match key {
        FactorKey::GroundAcceleration => match clause {
            As1170_4 => "kpZ Ch(0)",
            Eurocode8 | Ntc2018 => "α S",
            Nzs1170_5 => "C(0)",
            Asce7_16 | Asce7_22 | Tbdy2018 | Ts1170_5 | GivenFloor | ComputedFloor => "PGA",
        },
        FactorKey::FloorAcceleration => match clause {
            GivenFloor => "a",
            As1170_4 | Asce7_16 | Asce7_22 | Eurocode8 | Ntc2018 | Nzs1170_5 | Tbdy2018
            | Ts1170_5 | ComputedFloor => "PFA",
        },
        FactorKey::Sds => "S_DS",
        FactorKey::LevelRatio => "z/h",
        FactorKey::Height => match clause {
            As1170_4 => "a_x",
            Asce7_16 => "1 + 2 z/h",
            Asce7_22 => "H_f",
            Tbdy2018 => "1 + 2 z/H",
            Eurocode8 | Ntc2018 | Nzs1170_5 | Ts1170_5 | GivenFloor | ComputedFloor => "C_Hi",
        },
        FactorKey::PeriodRatio => "T_a/T_1",
        FactorKey::Amplification => match clause {
            As1170_4 => "a_c",
            Asce7_16 | Asce7_22 => "a_p",
            Eurocode8 | Ntc2018 => "amplification A",
            Nzs1170_5 | Ts1170_5 => "C_i",
            Tbdy2018 => "B_e",
            GivenFloor | ComputedFloor => "A",
        },
        FactorKey::Response => match clause {
            As1170_4 => "R_c",
            Asce7_16 | Asce7_22 | GivenFloor | ComputedFloor => "R_p",
            Eurocode8 | Ntc2018 => "q_a",
            Nzs1170_5 | Ts1170_5 => "C_ph",
            Tbdy2018 => "R_e",
        },
        FactorKey::Importance => match clause {
            As1170_4 => "I_c",
            Asce7_16 | Asce7_22 | GivenFloor | ComputedFloor => "I_p",
            Eurocode8 | Ntc2018 => "γ_a",
            Nzs1170_5 | Ts1170_5 => "R_p",
            Tbdy2018 => "I",
        },
        FactorKey::Overstrength => "Ω_0",
        FactorKey::Resonance => "C_AR",
        FactorKey::Strength => "R_po",
        FactorKey::BuildingDuctility => match clause {
            Ts1170_5 => "C_str",
            As1170_4 | Asce7_16 | Asce7_22 | Eurocode8 | Ntc2018 | Nzs1170_5 | Tbdy2018
            | GivenFloor | ComputedFloor => "R_μ",
        },
    }
}

/// Who states a factor: `given`, `assumed: a rigid bracket`, `from the hazard`.
pub(super) fn factor_source(source: &Source, factor: &Factor) -> String {
    match (factor.source, reason(source, factor)) {
        (FactorSource::Given, _) => "given".to_owned(),
        (FactorSource::Assumed(_), "") => "assumed: an ordinary object".to_owned(),
        (FactorSource::Assumed(_), reason) => format!("assumed: {reason}"),
        (FactorSource::Found(_), from) => format!("from {from}"),
        (FactorSource::Read, place) => format!("read: {place}"),
        (FactorSource::Recalled(_), "") => "to be confirmed".to_owned(),
        (FactorSource::Recalled(_), reason) => format!("to be confirmed: {reason}"),
    }
}

/// Why a factor has its value, or where it was read; may be empty.
fn reason(source: &Source, factor: &Factor) -> &'static str {
    match factor.source {
        FactorSource::Given => "",
        FactorSource::Assumed(why) => match why {
            Assumed::Ordinary => "",
            Assumed::LifeSafety => "life safety is rated high",
            Assumed::RigidBracket => "a rigid bracket",
            Assumed::FlexibleBracket => "a flexible bracket",
            Assumed::Resonance => "a flexible bracket: resonance",
            Assumed::RigidPart => "a rigid part",
            Assumed::Elastic => "elastic",
            Assumed::AtGrade => "on or below the ground",
            Assumed::UnknownDuctility => "the ductility of the building is not known",
        },
        FactorSource::Found(from) => match from {
            Found::Hazard => "the hazard",
            Found::Worlds => "the simulated earthquakes",
            Found::Floor => "the floor",
            Found::FloorAlongLine => "the floor: 1 + kc hx",
            Found::FloorAndPeriod => "the floor and the period of the building",
            Found::FloorWithoutPeriod => {
                "the floor: 1 + 2.5 z/h, because the period of the building is not known"
            }
        },
        FactorSource::Read => source
            .component
            .and_then(|row| match source.clause {
                Clause::Asce7_22 => row.source_22,
                Clause::Asce7_16 | Clause::Tbdy2018 => row.source_16,
                Clause::As1170_4
                | Clause::Eurocode8
                | Clause::Ntc2018
                | Clause::Nzs1170_5
                | Clause::Ts1170_5
                | Clause::GivenFloor
                | Clause::ComputedFloor => None,
            })
            .unwrap_or_default(),
        FactorSource::Recalled(why) => match why {
            Recalled::Ordinary => "",
            Recalled::Row => "the row of the table",
            Recalled::Concrete => in_concrete(source.clause),
            Recalled::BrittleConnection => "2.5 where the connection is shown to be ductile",
            Recalled::Cabinet => "table 4.4, anchorage of floor-supported cabinets and book stacks",
            Recalled::NoCabinet => {
                "no reduction: table 4.4 has a value for floor-supported cabinets alone"
            }
            Recalled::ShortPeriod => "a period up to 0.75 s",
            Recalled::RowOfAsce7_16 if factor.key == FactorKey::Amplification => {
                "a_p of the row of ASCE 7-16, from which table 6.1 descends"
            }
            Recalled::RowOfAsce7_16 => "R_p of the row of ASCE 7-16, from which table 6.1 descends",
            Recalled::Resonance => "a flexible bracket: an elastic part in resonance",
            Recalled::RigidPart => "a rigid part",
            Recalled::Elastic => "elastic",
            Recalled::ElasticBuilding => "a building that does not yield",
        },
    }
}

/// What Ω_0 stands for.
fn in_concrete(clause: Clause) -> &'static str {
    match clause {
        Clause::As1170_4 => "AS 5216 has rules of its own for anchors in concrete",
        Clause::Asce7_16 | Clause::Asce7_22 => "anchors in concrete",
        Clause::Eurocode8 | Clause::Ntc2018 => {
            "EN 1992-4 has rules of its own for anchors in concrete"
        }
        Clause::Nzs1170_5 | Clause::Ts1170_5 => {
            "NZS 3101 has rules of its own for anchors in concrete"
        }
        Clause::Tbdy2018 => "anchors in concrete have rules of their own",
        Clause::GivenFloor | Clause::ComputedFloor => {
            "the standard for anchors in concrete has rules of its own"
        }
    }
}

/// The formula with its limits, in symbols.
pub(super) fn equation(source: &Source) -> String {
    let equation = match source.clause {
        Clause::As1170_4 => "F_c = kpZ Ch(0) a_x I_c a_c/R_c W, from 0.05 W to 0.5 W",
        Clause::Asce7_16 => {
            "F_p = 0.4 a_p S_DS (1 + 2 z/h) I_p/R_p W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W"
        }
        Clause::Asce7_22 => {
            "F_p = 0.4 S_DS I_p (H_f/R_μ)(C_AR/R_po) W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W"
        }
        Clause::Eurocode8 | Clause::Ntc2018 => {
            let is_amplified = source.factor(FactorKey::Amplification).is_some();
            let amplified = if is_amplified { "A " } else { "" };
            return format!(
                "F_a = α S [3 (1 + z/H)/(1 + (1 − T_a/T_1)²) − 0.5] {amplified}γ_a/q_a W, at least α S γ_a/q_a W"
            );
        }
        Clause::Nzs1170_5 => "F_ph = C(0) C_Hi C_i C_ph R_p W, at most 3.6 W",
        Clause::Tbdy2018 => {
            "F_ie = A_ie B_e/R_e W, at least 0.3 S_DS I W, with A_ie = 0.4 S_DS (1 + 2 z/H)"
        }
        Clause::Ts1170_5 => "F_ph = PGA (C_Hi/C_str)(C_i/C_ph) R_p W",
        Clause::GivenFloor => "F = A m a, A at least 1",
        Clause::ComputedFloor => {
            "F = A m PFA, A at least 1, with the PFA that the accepted share of the worlds exceeds"
        }
    };
    equation.to_owned()
}

/// The same in numbers: `0.4 × 1 × 1 × 3 × 1/2.5`.
pub(super) fn numbers(source: &Source) -> String {
    let value = |key| source.factor(key).map_or(1.0, |factor| factor.value);
    let shown = |key| number(value(key), 4);
    let [ground, sds, height] = [
        FactorKey::GroundAcceleration,
        FactorKey::Sds,
        FactorKey::Height,
    ]
    .map(shown);
    let [amplification, response, importance, ductility] = [
        FactorKey::Amplification,
        FactorKey::Response,
        FactorKey::Importance,
        FactorKey::BuildingDuctility,
    ]
    .map(shown);
    let floor = number(
        value(FactorKey::GroundAcceleration) * value(FactorKey::Height),
        4,
    );
    match source.clause {
        Clause::As1170_4 => format!("{floor} × {importance} × {amplification}/{response}"),
        Clause::Asce7_16 => {
            format!("0.4 × {amplification} × {sds} × {height} × {importance}/{response}")
        }
        Clause::Asce7_22 => format!(
            "0.4 × {sds} × {importance} × {height}/{ductility} × {}/{}",
            shown(FactorKey::Resonance),
            shown(FactorKey::Strength)
        ),
        Clause::Eurocode8 | Clause::Ntc2018 => {
            let amplified = source.factor(FactorKey::Amplification);
            let times = amplified.map_or_else(String::new, |_| format!("{amplification} × "));
            format!(
                "{ground} × [3 (1 + {})/(1 + (1 − {})²) − 0.5] × {times}{importance}/{response}",
                number(value(FactorKey::LevelRatio), 3),
                shown(FactorKey::PeriodRatio)
            )
        }
        Clause::Nzs1170_5 => format!("{floor} × {amplification} × {response} × {importance}"),
        Clause::Tbdy2018 => format!("0.4 × {sds} × {height} × {amplification}/{response}"),
        Clause::Ts1170_5 => {
            format!("{ground} × {height}/{ductility} × {amplification}/{response} × {importance}")
        }
        Clause::GivenFloor | Clause::ComputedFloor => format!(
            "{} × {} g",
            number(value(FactorKey::Amplification).max(1.0), 4),
            shown(FactorKey::FloorAcceleration)
        ),
    }
}

/// What the reader of a force must know, a sentence each.
pub(super) fn remarks(source: &Source) -> Vec<String> {
    let remark = |remark: &Remark| {
        let sentence = match *remark {
            Remark::OtherSpectrum => match source.clause {
                Clause::As1170_4 => "kpZ Ch(0) is taken as Sa(0) of the study's spectrum.",
                Clause::Asce7_16
                | Clause::Asce7_22
                | Clause::Eurocode8
                | Clause::Ntc2018
                | Clause::Nzs1170_5
                | Clause::Tbdy2018
                | Clause::Ts1170_5
                | Clause::GivenFloor
                | Clause::ComputedFloor => "S_DS is taken as the plateau of the study's spectrum.",
            },
            Remark::TallBuilding => {
                "The height of the building was not given; a tall one is assumed."
            }
            Remark::Row => return row_words(source),
            Remark::OlderSpectrum => {
                "The clause is that of ASCE 7-22, the code in force; S_DS is from the mapped values of ASCE 7-16."
            }
            Remark::LeftOpen => {
                "F_a = S_a W_a/q_a by NTC 2018, 7.2.3, which leaves S_a and q_a to documents of proven \
                 reliability: they are those of EN 1998-1, 4.3.5.2."
            }
            Remark::NoReserve => {
                "The reserve of the part, which also divides, and the upper limit of the force are not used: both would lower \
                 it."
            }
            Remark::NoReduction => "Without factors for ductility or importance.",
            Remark::AboveCode { ratio, clause } => {
                let (times, name) = (number(ratio, 3), names(clause).name);
                return format!("It is {times} times the force by {name}.");
            }
        };
        sentence.to_owned()
    };
    source.remarks.iter().map(remark).collect()
}

/// Whose factors those of the component are.
fn row_words(source: &Source) -> String {
    let Some(row) = source.component else {
        return String::new();
    };
    let of = match source.clause {
        Clause::Tbdy2018 => " of ASCE 7-16",
        _ => "",
    };
    format!(
        "The factors are those of {} (table {}{of}).",
        row.title, row.table
    )
}

/// What nobody has read in the code, and an engineer must confirm before the sheet is signed.
#[derive(Debug, Clone, PartialEq)]
pub struct ToConfirm {
    /// What it is: a factor with what it stands for, or a clause.
    pub what: String,
    /// The value that was used; empty for a clause.
    pub value: String,
}

/// What an engineer must confirm of a force.
pub(crate) fn to_confirm(source: &Source) -> Vec<ToConfirm> {
    let is_recalled = |factor: &&Factor| matches!(factor.source, FactorSource::Recalled(_));
    let factor = |factor: &Factor| {
        let symbol = symbol(source.clause, factor.key);
        let what = match reason(source, factor) {
            "" => symbol.to_owned(),
            reason => format!("{symbol}: {reason}"),
        };
        let value = number(factor.value, 4);
        ToConfirm { what, value }
    };
    let clause = |unread: &Unread| ToConfirm {
        what: unread_words(*unread).to_owned(),
        value: String::new(),
    };
    let factors = source.factors.iter().filter(is_recalled).map(factor);
    factors
        .chain(source.to_confirm.iter().map(clause))
        .collect()
}

fn unread_words(unread: Unread) -> &'static str {
    match unread {
        Unread::Formula => {
            "the formula of this clause and its limits, which are quoted from memory"
        }
        Unread::LoadCombination => {
            "the load combination 0.9 D − 0.2 S_DS D (2.3.6, 12.4.2.2), quoted from memory"
        }
        Unread::OtherEdition => "that ASCE 7-16 has kept a_p and R_p of the edition that was read",
        Unread::Component => {
            "what the object is: no row of tables 13.5-1 and 13.6-1 was named, so the one for other components \
             stands here"
        }
        Unread::FloorAcceleration => {
            "A_ie, the largest acceleration of the floor: TBDY 2018 takes it from an analysis of the building, here it is \
             0.4 S_DS (1 + 2 z/H) of ASCE 7-16"
        }
        Unread::Height => "C_Hi, which is taken as H_f of ASCE 7-22",
    }
}

/// The share of the weight that a clause deducts for vertical shaking; `None`: it deducts nothing.
fn deducted(clause: Clause) -> Option<&'static str> {
    matches!(clause, Clause::Asce7_16 | Clause::Asce7_22).then_some("0.2 S_DS")
}

/// ` (0.2 S_DS is deducted for vertical shaking)`; empty where nothing is.
pub(super) fn deduction_words(source: &Source) -> String {
    deducted(source.clause).map_or_else(String::new, |share| {
        format!(" ({share} is deducted for vertical shaking)")
    })
}

/// The formula with its numbers, the factors, what was assumed, and how anchors and a bracket follow.
pub(crate) fn note(force: &RestraintForce) -> String {
    let source = &force.source;
    let mut note = match source.kind {
        SourceKind::OtherCode => "For comparison, on your spectrum. ".to_owned(),
        SourceKind::OwnCode | SourceKind::Floor => String::new(),
    };
    note += &format!(
        "{}: {} = {} W{}.{}",
        equation(source),
        numbers(source),
        number(source.part.formula_ratio, 4),
        governs(&source.part),
        factors_words(source)
    );
    for remark in remarks(source) {
        note += &format!(" {remark}");
    }
    if !source.to_confirm.is_empty() {
        let unread = source.to_confirm.iter().copied().map(unread_words);
        let unread: Vec<&str> = unread.collect();
        note += &format!(" An engineer must confirm {}.", unread.join("; "));
    }
    note += &held_words(force);
    if let Some(axis) = &force.axis {
        note += &anchor_words(force, axis);
    }
    note += &bracket_words(force);
    if source.overstrength_ratio() != 1.0 {
        note += " In concrete, Ω_0 F takes the place of F.";
    }
    note
}

/// `; the lower limit governs: 0.05 W`, where a limit does.
fn governs(part: &PartForce) -> String {
    let limit = |name: &str| {
        let share = number(part.force_ratio, 4);
        format!("; the {name} limit governs: {share} W")
    };
    match part.governing {
        Governing::Formula => String::new(),
        Governing::Minimum => limit("lower"),
        Governing::Maximum => limit("upper"),
    }
}

/// ` Assumed: a_p = 1 (rigid). Stated in the study: R_p = 2.`
fn factors_words(source: &Source) -> String {
    let list = |title: &str, is_wanted: fn(FactorSource) -> bool| {
        let wanted = source.factors.iter().filter(|one| is_wanted(one.source));
        let each = wanted.map(|factor| {
            let (symbol, value) = (symbol(source.clause, factor.key), number(factor.value, 4));
            match reason(source, factor) {
                "" => format!("{symbol} = {value}"),
                reason => format!("{symbol} = {value} ({reason})"),
            }
        });
        let each: Vec<String> = each.collect();
        if each.is_empty() {
            String::new()
        } else {
            format!(" {title}: {}.", each.join(", "))
        }
    };
    let stated = match source.clause {
        Clause::GivenFloor => "Given",
        _ => "Stated in the study",
    };
    list("Assumed", |source| {
        matches!(source, FactorSource::Assumed(_))
    }) + &list("Read", |source| source == FactorSource::Read)
        + &list("To be confirmed by the engineer", |source| {
            matches!(source, FactorSource::Recalled(_))
        })
        + &list(stated, |source| source == FactorSource::Given)
}

/// ` Held down by H = max(0, 0.9 − 0.2 S_DS) W = max(0, 0.9 − 0.2) W = 0.7 W.`
fn held_words(force: &RestraintForce) -> String {
    let dead = number(force.dead_load_ratio, 4);
    let held = number(force.held_weight_ratio, 4);
    match deducted(force.source.clause) {
        None => format!(" Held down by H = {dead} W; nothing is deducted for vertical shaking."),
        Some(share) => {
            let vertical = number(force.source.vertical_ratio, 4);
            format!(
                " Held down by H = max(0, {dead} − {share}) W = max(0, {dead} − {vertical}) W = {held} W."
            )
        }
    }
}

fn length(value_m: f64) -> String {
    format_si(value_m, Dimension::Length)
}

/// The tension of the anchors of one edge.
fn anchor_words(force: &RestraintForce, axis: &RestraintAxis) -> String {
    let assumed = if force.footing.inset_m.is_some() {
        ""
    } else {
        " (assumed)"
    };
    let inset = length(force.inset_m());
    let minus = match force.footing.pivot {
        Pivot::Edge => inset.clone(),
        Pivot::Feet => format!("2 × {inset}"),
    };
    format!(
        " Anchors along one edge, {}, {inset} inside it{assumed}: (F × {} − {} W × {})/({} − {minus}).",
        axis.axis.name(),
        length(force.cg_height_m),
        number(force.held_weight_ratio, 4),
        length(force.weight_lever_m()),
        length(axis.base_m),
    )
}

/// A bracket and the feet below it; the forces in N.
fn bracket_words(force: &RestraintForce) -> String {
    let newtons = |value_n: f64| format!("{} N", number(value_n, 4));
    let (shear_n, friction_n) = (force.bracket_base_shear_n, force.foot_friction_n());
    let limited = force
        .too_high_bracket_m
        .map_or_else(String::new, |stated_m| {
            format!(
                " The stated height, {}, is above the object: the bracket is taken at its top.",
                length(stated_m)
            )
        });
    let below = if force.cg_height_m > force.bracket_height_m {
        " The bracket is below the centre of gravity: it carries more than F, and the force at the feet is reversed. \
         Raise the bracket."
    } else {
        ""
    };
    let friction = newtons(friction_n);
    let overstrength_ratio = force.source.overstrength_ratio();
    let feet = if friction_n >= shear_n {
        format!("carries {friction}: it suffices")
    } else if overstrength_ratio == 1.0 {
        format!("carries only {friction}: fix the feet")
    } else {
        let in_concrete = newtons(overstrength_ratio * shear_n);
        format!("carries only {friction}: fix the feet, in concrete for {in_concrete}")
    };
    format!(
        " Or a bracket at {at}: F × {cg}/{at} = {}, the weight is not counted; at the feet F × |1 − {cg}/{at}| = \
         {}; friction with a coefficient of {FOOT_FRICTION_RATIO} {feet}.{limited}{below}",
        newtons(force.bracket_force_n),
        newtons(shear_n),
        at = length(force.bracket_height_m),
        cg = length(force.cg_height_m),
    )
}
