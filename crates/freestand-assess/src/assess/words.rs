//! How an assessment is said to people: the words, signs and colours that all its pages share.

use freestand_input::words::{number, percent};
use freestand_study::result::Ranked;

use super::result::{Assessment, Decision, Probability};

/// How a decision is shown; the sign and the word stand wherever the colour does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colours {
    /// Dark enough for text on white.
    pub ink: u32,
    /// Light enough for black text on it.
    pub fill: u32,
}

/// The sign of a decision, which differs in shape too.
pub fn sign(decision: Decision) -> &'static str {
    match decision {
        Decision::Restrain => "▲",
        Decision::Soften => "◆",
        Decision::NoVerdict => "?",
        Decision::Leave => "●",
    }
}

/// A decision in capitals.
pub fn label(decision: Decision) -> &'static str {
    match decision {
        Decision::Restrain => "RESTRAIN",
        Decision::Soften => "SOFTEN",
        Decision::NoVerdict => "NO VERDICT",
        Decision::Leave => "LEAVE",
    }
}

/// What a decision asks for.
pub fn advice(decision: Decision) -> &'static str {
    match decision {
        Decision::Restrain => "fix it to the building",
        Decision::Soften => "put it on a softer pad",
        Decision::NoVerdict => "find what is missing first",
        Decision::Leave => "let it stand as it is",
    }
}

/// The colours of a decision (after Okabe and Ito): told apart by the colour-blind, and in grey by their lightness.
pub fn colours(decision: Decision) -> Colours {
    match decision {
        Decision::Restrain => Colours { ink: 0x00A8_4300, fill: 0x00F7_C5A0 },
        Decision::Soften => Colours { ink: 0x0000_5A8C, fill: 0x00BF_DDF2 },
        Decision::NoVerdict => Colours { ink: 0x0055_5555, fill: 0x00E4_E4E4 },
        Decision::Leave => Colours { ink: 0x0000_6B4E, fill: 0x00D3_EFE4 },
    }
}

/// What decided, in words.
pub fn tier(tier: u8) -> &'static str {
    match tier {
        0 => "tier 0: thresholds",
        1 => "tier 1: spectra",
        2 => "tier 2: its own histories",
        3 => "tier 3: the compliant base",
        _ => "",
    }
}

/// A number with its unit, `overturned`, or a dash.
pub fn ranked(value: Ranked, unit: &str) -> String {
    match value {
        Ranked::Value(value) if unit.is_empty() => number(value, 3),
        Ranked::Value(value) => format!("{} {unit}", number(value, 3)),
        Ranked::Overturned => "overturned".to_owned(),
        Ranked::NoData => "–".to_owned(),
    }
}

/// The same in thousandths: lifts in mm.
pub fn ranked_milli(value: Ranked, unit: &str) -> String {
    match value {
        Ranked::Value(value) => ranked(Ranked::Value(1e3 * value), unit),
        other => ranked(other, unit),
    }
}

/// `42 % (31–53 %)`.
pub fn probability(probability: Probability) -> String {
    let Probability { value, low, high } = probability;
    if low == high {
        return percent(value, 0);
    }
    let digits = |share: f64| freestand_input::words::fixed(100.0 * share, usize::from(high < 0.1));
    format!("{} % ({}–{} %)", digits(value), digits(low), digits(high))
}

/// How far demand is from capacity, of the median motion: `1.3 times what it stands`.
pub fn margin(found: &Assessment) -> String {
    let Some(capacity) = &found.capacity else {
        return "no tolerance is known: nothing to compare with".to_owned();
    };
    match capacity.demand_capacity {
        Ranked::Overturned => "the median motion overturns it: beyond every capacity".to_owned(),
        Ranked::NoData => "demand over capacity could not be found".to_owned(),
        Ranked::Value(ratio) if ratio > 1.0 => {
            format!("the median motion asks {} times what it stands", number(ratio, 3))
        }
        Ranked::Value(ratio) => format!("the median motion asks {} of what it stands", percent(ratio, 0)),
    }
}

/// How a list of objects is to be read, for every page that has one.
pub const HOW_TO_READ: [&str; 7] = [
    "restrain (▲): the probability of overturning, or of exceeding what the object stands, is above what is accepted and no pad can help.",
    "soften (◆): an acceleration governs, and a softer pad under the object brings the probability below what is accepted; the pad was checked by running the motions again.",
    "no verdict (?): something is missing that a verdict would need; the row says what. What can be said without it is said.",
    "leave (●): the object may stand as it is under the hazard that was assumed.",
    "Demand over capacity is that of the median motion; above 1 the object is damaged. “Overturned” is beyond every number.",
    "The probability counts motions and draws of what is uncertain (stiffness, restitution, mass, geometry, model); overturned counts as exceeded. Its 95 % interval is given behind it.",
    "Shocks are at the landing edge, by Eq. (5) of Al Abadi et al. or Eq. (8) where the landing is halted, from the larger of two energy sources: the rise of the centre of gravity and the velocity before the impact.",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_have_digits_where_they_are_small() {
        let said = |value, low, high| probability(Probability { value, low, high });
        assert_eq!(said(0.42, 0.314, 0.526), "42 % (31–53 %)");
        assert_eq!(said(0.004, 0.0, 0.021), "0.4 % (0.0–2.1 %)");
        assert_eq!(said(0.25, 0.25, 0.25), "25 %");
    }

    /// Every decision is told by its word and by the shape of its sign, not by its colour alone.
    #[test]
    fn decisions_are_told_apart_without_colour() {
        for a in Decision::ALL {
            for b in Decision::ALL {
                assert!(a == b || (sign(a) != sign(b) && label(a) != label(b) && colours(a) != colours(b)));
            }
        }
    }
}
