//! The shock of one landing.

use freestand_input::quantity::{Dimension, format_si};
use freestand_output::answer;
use freestand_records::tables::TestMethod;
use freestand_study::shock::{
    NoLargestStiffness, ShockAnswer, ShockDoubt, ShockNote, ShockReport, TestsDoubt,
};

use crate::doubts::{cushion_note, model_limit};

answer! {
    /// The shock of a landing, and what its reader must know.
    pub struct LandingReport {
        shock: ShockAnswer = flat,
        notes: Vec<String> = "note",
    }
}

/// What there is to tell of a shock.
pub fn landing_report(report: &ShockReport) -> LandingReport {
    LandingReport {
        shock: report.answer.clone(),
        notes: report.notes.iter().map(note).collect(),
    }
}

/// What may make a shock wrong.
pub fn shock_doubt(doubt: &ShockDoubt) -> String {
    let words = match doubt {
        ShockDoubt::FromRest => {
            "the fall starts from rest at the balance point: this is a lower estimate, because an object that overturns \
             while rocking still has some speed there"
        }
        ShockDoubt::BeyondBalance(balance) => {
            let balance = balance.words();
            return format!("the object is beyond its {balance}: if released, it would overturn");
        }
        ShockDoubt::Validity(limit) => return model_limit(limit),
        ShockDoubt::EdgeUnused => {
            "an object that falls over lands on its side: the stiffness of its edge is not used"
        }
        ShockDoubt::RiseUnused => {
            "an object that falls over starts from its balance point: the given rise is not used"
        }
        ShockDoubt::FreeCorner => "the free-corner model is for comparison only",
        ShockDoubt::Tests(doubt) => return tests_doubt(doubt),
        ShockDoubt::PointOutside => "the point `at_point` lies outside the object",
        ShockDoubt::ComponentNotCompared => {
            "the component is not compared: a drop acceleration alone has no duration; give the rise at which it was \
             measured, or the cushion"
        }
        ShockDoubt::UpliftNotCompared => {
            "the survived uplift is not compared: it needs `uplift`, `rotation` or `cg_rise`"
        }
    };
    words.to_owned()
}

fn tests_doubt(doubt: &TestsDoubt) -> String {
    match doubt {
        TestsDoubt::NoShock(method) => format!(
            "no damage boundary: the tests have no shock of Method {method}, which gives the {}",
            critical(*method)
        ),
        TestsDoubt::NoneSurvived(method) => format!(
            "no damage boundary: no shock of Method {method} below the first damage was survived, so the {} is not known",
            critical(*method)
        ),
        TestsDoubt::AllIgnored(method) => {
            format!("no damage boundary: every shock of Method {method} is ignored")
        }
        TestsDoubt::NoDamage(method) => format!(
            "no shock of Method {method} did damage: the {} is at least the largest survived one",
            critical(*method)
        ),
        TestsDoubt::BelowKnee(lines) => format!(
            "shocks of Method B below 1.57 times the critical velocity change say nothing about the critical \
             acceleration and are ignored: line {}",
            joined(lines)
        ),
        TestsDoubt::WeakPeaks(lines) => format!(
            "the critical velocity change is based on a peak that the object withstands at any velocity change: line \
             {}; use shorter pulses for Method A",
            joined(lines)
        ),
    }
}

/// What a method gives.
fn critical(method: TestMethod) -> &'static str {
    match method {
        TestMethod::A => "critical velocity change",
        TestMethod::B => "critical acceleration",
    }
}

fn joined(lines: &[usize]) -> String {
    let lines: Vec<String> = lines.iter().map(usize::to_string).collect();
    lines.join(", ")
}

fn note(note: &ShockNote) -> String {
    match note {
        ShockNote::Cushion(note) => cushion_note(note),
        ShockNote::ImpliedStiffness(stiffness_n_m) => format!(
            "the measured drop acceleration implies {}",
            format_si(*stiffness_n_m, Dimension::Stiffness)
        ),
        ShockNote::NoLargestStiffness(why) => match why {
            NoLargestStiffness::UpliftTooLarge => {
                "no stiffness brings the verdict to ok: the uplift does not depend on it"
            }
            NoLargestStiffness::VelocityChangeTooLarge => {
                "no stiffness brings the verdict to ok: the velocity change does not depend on it"
            }
            NoLargestStiffness::VelocityChangeSmall => {
                "at any stiffness the verdict is ok: the velocity change is below its limit"
            }
            NoLargestStiffness::AnyWillDo => "at any stiffness the verdict is ok",
        }
        .to_owned(),
    }
}

#[cfg(test)]
mod tests;
