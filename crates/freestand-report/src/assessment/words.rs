//! The words, signs and colours that all outputs of an assessment share.

use freestand_assess::result::{Assessment, Decision, FallsAnswer, Probability, TooMild};
use freestand_input::words::{counted, fixed, number, percent};
use freestand_study::result::Ranked;
use maud::{Markup, html};

/// The colours of a decision; its sign and its word always accompany them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colours {
    /// Dark enough for text on white.
    pub ink: u32,
    /// Light enough for black text on it.
    pub fill: u32,
}

/// The sign of a decision; no two signs have the same shape.
pub fn sign(decision: Decision) -> &'static str {
    match decision {
        Decision::Restrain => "▲",
        Decision::Soften => "◆",
        Decision::Lock => "■",
        Decision::NoVerdict => "?",
        Decision::Leave => "●",
    }
}

/// Why the calculation of an object is too mild: what is calculated, after "It is".
pub(crate) fn too_mild(why: TooMild) -> &'static str {
    match why {
        TooMild::Round => {
            "round, and calculated with a model that underestimates how often it falls"
        }
        TooMild::OnHull => {
            "calculated on the points of the hull, with a model that underestimates how often it falls"
        }
        TooMild::UnseenBase => "a scan, but nobody measured the side on which it stands",
        TooMild::TouchesWall => {
            "against a wall, where it falls too often in three dimensions on a stiff floor, and calculated in one plane on \
             a rigid base"
        }
        TooMild::Glides => "free to roll or slide, which counts only where a stop overturns it",
    }
}

/// A decision in capitals.
pub fn label(decision: Decision) -> &'static str {
    match decision {
        Decision::Restrain => "RESTRAIN",
        Decision::Soften => "SOFTEN",
        Decision::Lock => "LOCK",
        Decision::NoVerdict => "NO VERDICT",
        Decision::Leave => "LEAVE",
    }
}

/// What a decision recommends.
pub fn advice(decision: Decision) -> &'static str {
    match decision {
        Decision::Restrain => "fix it to the building",
        Decision::Soften => "put it on a softer pad",
        Decision::Lock => "lock it, tether it, or give it room",
        Decision::NoVerdict => "complete the missing data",
        Decision::Leave => "leave it as it is",
    }
}

/// The colours of a decision (after Okabe and Ito). The colour-blind can tell them apart; in grey
/// their lightness differs.
pub fn colours(decision: Decision) -> Colours {
    match decision {
        Decision::Restrain => Colours {
            ink: 0x00A8_4300,
            fill: 0x00F7_C5A0,
        },
        Decision::Soften => Colours {
            ink: 0x0000_5A8C,
            fill: 0x00BF_DDF2,
        },
        Decision::Lock => Colours {
            ink: 0x008A_2A66,
            fill: 0x00F2_D3E6,
        },
        Decision::NoVerdict => Colours {
            ink: 0x0055_5555,
            fill: 0x00E4_E4E4,
        },
        Decision::Leave => Colours {
            ink: 0x0000_6B4E,
            fill: 0x00D3_EFE4,
        },
    }
}

/// The tier that decided, in words.
pub fn tier(tier: u8) -> &'static str {
    match tier {
        0 => "both models: it does not rock",
        2 => "the model on a rigid base",
        3 => "both models: on a rigid base and on its pads",
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

/// The same in thousandths, such as an uplift in mm.
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
        percent(value, 0)
    } else {
        with_interval(probability, "")
    }
}

/// With its interval, and `after` that in the brackets.
fn with_interval(Probability { value, low, high }: Probability, after: &str) -> String {
    let digits = |share: f64| fixed(100.0 * share, usize::from(high < 0.1));
    format!(
        "{} % ({}–{} %{after})",
        digits(value),
        digits(low),
        digits(high)
    )
}

/// P(it falls) in words; a dash where it is not known. Motions that are too few to leave an object
/// as it is are named.
pub fn falls(found: &Assessment) -> String {
    with_motions(found, found.p_overturn)
}

/// The same for P(its tolerance is exceeded).
pub fn exceeded(found: &Assessment) -> String {
    with_motions(found, found.p_exceed)
}

/// The probability that decides in words: `falls 31 % (25–37 %)`.
pub fn chance(found: &Assessment) -> String {
    let Some(answers) = &found.answers else {
        return "–".to_owned();
    };
    let is_shock =
        answers.falls == FallsAnswer::Stays && answers.asks_shock && found.p_exceed.is_some();
    if is_shock {
        format!("exceeded {}", exceeded(found))
    } else {
        format!("falls {}", falls(found))
    }
}

fn with_motions(found: &Assessment, p: Option<Probability>) -> String {
    let Some(p) = p else { return "–".to_owned() };
    let few = found
        .answers
        .as_ref()
        .and_then(|answers| answers.few_motions);
    few.map_or_else(
        || probability(p),
        |few| with_interval(p, &format!(", {}", counted(few.motions as usize, "motion"))),
    )
}

/// Demand/capacity of the median world by the model that decides, in a sentence.
pub fn margin(found: &Assessment) -> String {
    match found.demand_capacity_median() {
        None => "not known: no tolerance was given".to_owned(),
        Some(Ranked::Overturned) => "at least half of the worlds overturn it".to_owned(),
        Some(Ranked::NoData) if found.rolled.is_some() => {
            "not known: its mass or the stiffness of its stop (wall_stiffness) was not given"
                .to_owned()
        }
        Some(Ranked::NoData) => "not known: its mass or its cushion was not given".to_owned(),
        Some(Ranked::Value(ratio)) => number(ratio, 3),
    }
}

/// How to read a list of objects; shown with every such list.
pub const HOW_TO_READ: [&str; 9] = [
    "Restrain (▲): it falls or exceeds its tolerance with a probability above the accepted one, or too close to it to \
     call, and no softer pad is enough.",
    "Soften (◆): its shock alone is too hard or too close to call, and on a softer pad it would be left as it is. The pad \
     went through the same worlds in both models.",
    "Lock (■): it rolls on its casters or slides on its base, and with a probability that is not below the accepted one \
     it goes farther than it has room. Locked or tethered it stands: it went through the same worlds as if its brakes held. \
     The room that would suffice is given.",
    "No verdict (?): data that a verdict needs are missing; the reason says which. Whether it falls is always said.",
    "Leave (●): the object may stay as it is under the assumed hazard: the upper end of every interval that was asked \
     for is below the accepted probability.",
    "Demand/capacity and the median shock are those of the median world, by the model that decides; above 1 the \
     tolerance is exceeded. The governing criterion is that of the world that decides. “Overturned” ranks above every \
     number: at least half of the worlds overturn the object.",
    "A world is one draw of everything that is not known: ground motion, building, restitution, pads, size, mass, error \
     of the models. A probability is the share of the worlds; its interval (98 % unless the study says otherwise) \
     follows in brackets. Worlds are added until the interval leaves the accepted probability.",
    "Shocks are those of the edge that lands: by Eq. (5) or (8) of Al Abadi et al. on a rigid base, and calculated in \
     time on its pads. The worse model counts.",
    "“How it was calculated” below an object holds its equations, the formulas of the forces and comparisons. It is \
     printed where it is open.",
];

/// Rows up to which a list of the report is printed with it: the report of a manager is at most six sheets.
const SHORT_ROWS: usize = 25;

/// A list of the report with so many rows. A long one is on the screen, and on paper only where that is asked for;
/// `file` has it too.
pub(super) fn long(list: Markup, rows: usize, file: &str) -> Markup {
    if rows <= SHORT_ROWS {
        return list;
    }
    html! {
        div.long { (list) }
        p.instead {
            "The list of " (rows) " rows is left out on paper: it is in " (file)
            ", and is printed if “Print the long lists too” is ticked."
        }
    }
}

/// An amount of money in whole units, with a narrow space between its thousands.
pub(super) fn amount(value: f64) -> String {
    let digits = format!("{:.0}", value.abs());
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place) % 3 == 0 && digits.len() > 4 {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    match value < 0.0 && text != "0" {
        true => format!("−{text}"),
        false => text,
    }
}

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

    /// The probability that decides is that of falling where it falls, else that of a shock that is too
    /// hard; motions that are too few are named.
    #[test]
    fn the_probability_that_decides_is_named() {
        let item = crate::assessment::fixture::item(0);
        let mut found = crate::assessment::fixture::assessment(&item, 0);
        found.p_overturn = Some(Probability {
            value: 0.0,
            low: 0.0,
            high: 0.78,
        });
        found.p_exceed = Some(Probability {
            value: 0.42,
            low: 0.31,
            high: 0.53,
        });
        assert_eq!(chance(&found), "falls 0 % (0–78 %)");
        found.answers.as_mut().unwrap().few_motions =
            freestand_assess::result::FewMotions::of(3, Some(44));
        assert_eq!(
            (chance(&found).as_str(), falls(&found).as_str()),
            ("falls 0 % (0–78 %, 3 motions)", "0 % (0–78 %, 3 motions)")
        );
        let answers = found.answers.as_mut().unwrap();
        (answers.few_motions, answers.falls) = (None, FallsAnswer::Stays);
        assert_eq!(chance(&found), "exceeded 42 % (31–53 %)");
        found.answers = None;
        assert_eq!(
            (
                chance(&found),
                falls(&Assessment {
                    p_overturn: None,
                    ..found
                })
            ),
            ("–".into(), "–".into())
        );
    }

    /// Word, sign and colour of every decision differ from those of the others.
    #[test]
    fn decisions_are_told_apart_without_colour() {
        for a in Decision::ALL {
            for b in Decision::ALL {
                assert!(
                    a == b
                        || (sign(a) != sign(b) && label(a) != label(b) && colours(a) != colours(b))
                );
            }
        }
    }
}
