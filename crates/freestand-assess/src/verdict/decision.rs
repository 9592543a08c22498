//! The decision on an object, and the reason for it in words.

use freestand::decision::Side;

use crate::result::{
    Answers, Criterion, Decision, FallsAnswer, FewMotions, ModelAnswers, Probability, ShockAnswer,
    TooMild,
};
use freestand_input::words::listed;
use freestand_input::words::{counted, percent_significant};

impl FallsAnswer {
    /// From where the probability lies. An object that is calculated too mildly never stays for certain.
    pub(super) fn of(side: Side, too_mild: Option<TooMild>) -> Self {
        match side {
            Side::Below if too_mild.is_none() => Self::Stays,
            Side::Above => Self::Falls,
            Side::Below | Side::Open => Self::Close,
        }
    }
}

impl ShockAnswer {
    /// From where the probability lies; `None`: it has no tolerance. Where its shock is not known, the
    /// acceleration of the floor alone may be too much.
    pub(super) fn of(side: Option<Side>, shock_is_known: bool) -> Self {
        match (side, shock_is_known) {
            (Some(Side::Above), _) => Self::Exceeded,
            (Some(Side::Below), true) => Self::Stands,
            (Some(Side::Open), true) => Self::Close,
            (None, _) | (Some(Side::Below | Side::Open), false) => Self::Unknown,
        }
    }
}

/// The last word on an object: one that goes farther than it has room is locked or restrained instead
/// of being left or without a verdict, and in shaking that nobody stated nothing is left as it is.
pub(super) fn settled(by_answers: Decision, loose: Option<Decision>, unstated: bool) -> Decision {
    let decision = match by_answers {
        Decision::Leave | Decision::NoVerdict => loose.unwrap_or(by_answers),
        Decision::Restrain | Decision::Soften | Decision::Lock => by_answers,
    };
    if decision == Decision::Leave && unstated {
        Decision::NoVerdict
    } else {
        decision
    }
}

/// What a decision is made from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Case<'a> {
    pub(super) accepted_ratio: f64,
    pub(super) answers: &'a Answers,
    /// Whether it uplifts in any world by any model.
    pub(super) lifts: bool,
    /// Whether the tolerance may decide.
    pub(super) decides: bool,
    pub(super) governing: Option<Criterion>,
    /// What a comparison lacks: `tolerance`, `mass`, `cushion`.
    pub(super) missing: &'a [&'static str],
    /// The softer pad that was looked for: whether it passed, and what was found.
    pub(super) softer: Option<(bool, &'a str)>,
    /// Why no softer pad was looked for.
    pub(super) beyond_pads: &'a str,
    pub(super) tolerance_source: &'a str,
}

/// The decision and its reason.
pub(super) fn decide(case: &Case) -> (Decision, String) {
    let Answers {
        falls,
        shock,
        asks_shock,
        ..
    } = *case.answers;
    let falling = falling(case);
    if falls != FallsAnswer::Stays {
        return (Decision::Restrain, falling);
    }
    if !asks_shock {
        return (
            Decision::Leave,
            format!(
                "{falling} Only falling was assessed: {}.",
                only_falling(case)
            ),
        );
    }
    if shock == ShockAnswer::Unknown {
        let missing = listed(case.missing);
        let verb = if case.missing.len() == 1 {
            "was"
        } else {
            "were"
        };
        let why = format!(
            "{falling} Whether a shock damages it is unknown, because its {missing} {verb} not given."
        );
        return (Decision::NoVerdict, why);
    }
    let shock_words = shock_words(case);
    if !case.decides {
        let source = case.tolerance_source;
        let why = format!(
            "{falling} {shock_words} But this tolerance was not checked against its source and cannot decide: confirm it. Its \
             source: {source}."
        );
        return (Decision::NoVerdict, why);
    }
    match (shock, case.softer) {
        (ShockAnswer::Stands, _) => (Decision::Leave, format!("{falling} {shock_words}")),
        (_, Some((true, note))) => (Decision::Soften, format!("{falling} {shock_words} {note}")),
        (_, Some((false, note))) => (
            Decision::Restrain,
            format!("{falling} {shock_words} No softer pad is enough: {note}"),
        ),
        (_, None) if case.governing == Some(Criterion::FloorAcceleration) => (
            Decision::Restrain,
            format!(
                "{falling} {shock_words} Neither a pad nor a restraint lowers the acceleration of the floor: restrain \
                 it, and move it to a lower floor or isolate it."
            ),
        ),
        (_, None) => (
            Decision::Restrain,
            format!(
                "{falling} {shock_words} No softer pad helps: {}.",
                case.beyond_pads
            ),
        ),
    }
}

fn only_falling(case: &Case) -> &'static str {
    if case.missing.contains(&"tolerance") {
        "no tolerance was given"
    } else {
        "nothing else was asked"
    }
}

/// The model with the larger upper end: the one that decides.
pub(super) fn deciding(
    answers: &Answers,
    of: impl Fn(&ModelAnswers) -> Option<Probability>,
) -> Option<Probability> {
    let both = [&answers.rigid, &answers.compliant].map(|model| model.as_ref().and_then(&of));
    both.into_iter()
        .flatten()
        .reduce(|most, next| if next.high > most.high { next } else { most })
}

/// `8 % (6 to 11 %)`.
fn spread(p: Probability) -> String {
    format!(
        "{} ({} to {})",
        percent(p.value),
        percent(p.low).replace(" %", ""),
        percent(p.high)
    )
}

fn falling(case: &Case) -> String {
    let answers = case.answers;
    let (worlds, limit) = (
        counted(answers.worlds as usize, "world"),
        percent(case.accepted_ratio),
    );
    let Some(p) = deciding(answers, |model| Some(model.overturn)) else {
        return String::new();
    };
    let models = both_words(answers, |model| Some(model.overturn), case.accepted_ratio);
    let hits = (p.value * f64::from(answers.worlds)).round();
    if let Some(why) = answers.too_mild {
        return mild(why, case, p);
    }
    match answers.falls {
        FallsAnswer::Stays if !case.lifts => {
            format!("It stays standing: it rocks in none of {worlds} (accepted {limit}).")
        }
        // Whoever accepts that most fall is not told that it stands.
        FallsAnswer::Stays if p.value > 0.5 => {
            format!(
                "It falls in {} of {worlds}, and {limit} is accepted.{models}",
                spread(p)
            )
        }
        FallsAnswer::Stays => {
            let high = percent(p.high);
            format!(
                "It stays standing: at most {high} fall ({hits} of {worlds}; accepted {limit}).{models}"
            )
        }
        FallsAnswer::Falls => {
            format!(
                "It falls in {} of {worlds}, more than the accepted {limit}.{models}",
                spread(p)
            )
        }
        FallsAnswer::Close => {
            let few = answers
                .few_motions
                .as_ref()
                .map_or_else(String::new, few_words);
            let few = answers
                .worlds_needed
                .map_or(few, |needed| few_worlds(answers.worlds_cap, needed));
            format!(
                "It falls in {} of {worlds} against {limit}: too close to call.{few}{models}",
                spread(p)
            )
        }
    }
}

/// What is known of an object that may fall where its calculation lets it stand.
fn mild(why: TooMild, case: &Case, p: Probability) -> String {
    let (worlds, limit) = (
        counted(case.answers.worlds as usize, "world"),
        percent(case.accepted_ratio),
    );
    let verdict = if case.answers.falls == FallsAnswer::Falls {
        "too often"
    } else {
        "too close to call"
    };
    format!(
        "It is {}. In that calculation it falls in {} of {worlds} (accepted {limit}), and the real object may fall more \
         often: {verdict}.",
        why.words(),
        spread(p)
    )
}

/// How many worlds would do, where the study allows fewer.
fn few_worlds(most: u32, needed: u32) -> String {
    format!(
        " {} are too few to leave it as it is, even if it falls in none: at least {needed} would do: give most = {needed} in [worlds].",
        counted(most as usize, "world")
    )
}

/// How many motions would do, where there are too few for `leave`.
fn few_words(few: &FewMotions) -> String {
    let motions = counted(few.motions as usize, "motion");
    let verb = if few.motions == 1 { "is" } else { "are" };
    match few.needed {
        Some(needed) => format!(
            " {motions} {verb} too few to leave it as it is, even if none overturns it: at least {needed} would do."
        ),
        None => format!(" {motions} {verb} too few to leave it as it is: use synthetic motions."),
    }
}

/// Both models, where they disagree.
fn both_words(
    answers: &Answers,
    of: impl Fn(&ModelAnswers) -> Option<Probability>,
    accepted_ratio: f64,
) -> String {
    let (Some(rigid), Some(pads)) = (
        answers.rigid.as_ref().and_then(&of),
        answers.compliant.as_ref().and_then(&of),
    ) else {
        return String::new();
    };
    if (rigid.value > accepted_ratio) == (pads.value > accepted_ratio) {
        return String::new();
    }
    format!(
        " On a rigid base it is {}, on its pads {}: the models disagree, and the worse counts.",
        percent(rigid.value),
        percent(pads.value)
    )
}

fn shock_words(case: &Case) -> String {
    let answers = case.answers;
    let limit = percent(case.accepted_ratio);
    let Some(p) = deciding(answers, |model| model.exceed) else {
        return String::new();
    };
    let what = governing_words(case.governing);
    let models = both_words(answers, |model| model.exceed, case.accepted_ratio);
    match answers.shock {
        ShockAnswer::Stands => {
            format!(
                "{what} in at most {} of the worlds (accepted {limit}).{models}",
                percent(p.high)
            )
        }
        ShockAnswer::Exceeded => {
            format!(
                "{what} in {} of the worlds, more than the accepted {limit}.{models}",
                spread(p)
            )
        }
        ShockAnswer::Close => {
            format!(
                "{what} in {} of the worlds against {limit}: too close to call.{models}",
                spread(p)
            )
        }
        ShockAnswer::Unknown => String::new(),
    }
}

fn governing_words(governing: Option<Criterion>) -> &'static str {
    match governing {
        Some(Criterion::Peak) => "Its shock exceeds the peak that it withstands",
        Some(Criterion::Spectrum) => "The spectrum of its shock exceeds that of its tolerance",
        Some(Criterion::DamageBoundary) => "Its shock exceeds its damage boundary",
        Some(Criterion::VelocityChange) => "Its velocity change exceeds its tolerance",
        Some(Criterion::EdgeLift) => "Its uplift exceeds its tolerance",
        Some(Criterion::FloorAcceleration) => "The acceleration of its floor exceeds its tolerance",
        Some(Criterion::Overturning) => "It falls or exceeds its tolerance",
        None => "It exceeds its tolerance",
    }
}

/// A share in percent; below 0.01 % its digits mean nothing.
pub(super) fn percent(share: f64) -> String {
    if share > 0.0 && share < 1e-4 {
        "under 0.01 %".to_owned()
    } else {
        percent_significant(share, 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(value: f64, low: f64, high: f64) -> Probability {
        Probability { value, low, high }
    }

    fn answers(falls: FallsAnswer, shock: ShockAnswer) -> Answers {
        let model = ModelAnswers {
            overturn: p(0.0, 0.0, 0.014),
            exceed: Some(p(0.04, 0.02, 0.07)),
        };
        Answers {
            falls,
            shock,
            asks_shock: true,
            models_agree: None,
            worlds: 320,
            worlds_cap: 320,
            worlds_compliant: None,
            confidence: 0.98,
            rigid: Some(model),
            compliant: None,
            restitution_p16_p84: [0.9, 0.95],
            few_motions: None,
            worlds_needed: None,
            too_mild: None,
        }
    }

    fn case(answers: &Answers) -> Case<'_> {
        Case {
            accepted_ratio: 0.1,
            answers,
            lifts: true,
            decides: true,
            governing: Some(Criterion::Peak),
            missing: &[],
            softer: None,
            beyond_pads: "its pads were not given",
            tolerance_source: "a test",
        }
    }

    #[test]
    fn the_rules_one_by_one() {
        use FallsAnswer::{Close, Falls, Stays};
        let decided = |falls, shock, softer, decides| {
            let answers = answers(falls, shock);
            decide(&Case {
                softer,
                decides,
                ..case(&answers)
            })
            .0
        };
        for shock in [
            ShockAnswer::Stands,
            ShockAnswer::Exceeded,
            ShockAnswer::Close,
            ShockAnswer::Unknown,
        ] {
            assert_eq!(decided(Falls, shock, None, true), Decision::Restrain);
            assert_eq!(decided(Close, shock, None, true), Decision::Restrain);
        }
        assert_eq!(
            decided(Stays, ShockAnswer::Stands, None, true),
            Decision::Leave
        );
        assert_eq!(
            decided(Stays, ShockAnswer::Unknown, None, true),
            Decision::NoVerdict
        );
        for shock in [ShockAnswer::Exceeded, ShockAnswer::Close] {
            assert_eq!(decided(Stays, shock, None, true), Decision::Restrain);
            assert_eq!(
                decided(Stays, shock, Some((true, "")), true),
                Decision::Soften
            );
            assert_eq!(
                decided(Stays, shock, Some((false, "")), true),
                Decision::Restrain
            );
            assert_eq!(decided(Stays, shock, None, false), Decision::NoVerdict);
        }
        let only = Answers {
            asks_shock: false,
            ..answers(Stays, ShockAnswer::Unknown)
        };
        let (decision, why) = decide(&Case {
            missing: &["tolerance"],
            ..case(&only)
        });
        assert_eq!(decision, Decision::Leave);
        assert_eq!(
            why,
            "It stays standing: at most 1.4 % fall (0 of 320 worlds; accepted 10 %). Only falling was assessed: no \
             tolerance was given."
        );
    }

    #[test]
    fn answers_from_where_a_probability_lies() {
        use Side::{Above, Below, Open};
        let falls = |too_mild| [Below, Open, Above].map(|side| FallsAnswer::of(side, too_mild));
        let [stays, close, fall] = [FallsAnswer::Stays, FallsAnswer::Close, FallsAnswer::Falls];
        assert_eq!(falls(None), [stays, close, fall]);
        for why in [TooMild::Round, TooMild::FeetPassWall] {
            assert_eq!(falls(Some(why)), [close, close, fall]);
        }
        let shock = |is_known| {
            [Some(Below), Some(Open), Some(Above), None].map(|side| ShockAnswer::of(side, is_known))
        };
        use ShockAnswer::{Close, Exceeded, Stands, Unknown};
        assert_eq!(shock(true), [Stands, Close, Exceeded, Unknown]);
        assert_eq!(shock(false), [Unknown, Unknown, Exceeded, Unknown]);
    }

    /// Every decision by the answers, with and without the room to move, stated and not.
    #[test]
    fn the_last_word() {
        use Decision::{Leave, Lock, NoVerdict, Restrain, Soften};
        for unstated in [false, true] {
            for firm in [Restrain, Soften, Lock] {
                assert_eq!(settled(firm, Some(Lock), unstated), firm);
            }
            for open in [Leave, NoVerdict] {
                for loose in [Lock, Restrain] {
                    assert_eq!(settled(open, Some(loose), unstated), loose);
                }
            }
            assert_eq!(settled(NoVerdict, None, unstated), NoVerdict);
        }
        assert_eq!(settled(Leave, None, false), Leave);
        assert_eq!(settled(Leave, None, true), NoVerdict);
    }

    /// No pad lowers the acceleration of the floor, and an object that was calculated too mildly is told
    /// as that.
    #[test]
    fn the_floor_alone_and_what_is_too_mild() {
        let exceeded = answers(FallsAnswer::Stays, ShockAnswer::Exceeded);
        let of = |governing| {
            decide(&Case {
                governing: Some(governing),
                ..case(&exceeded)
            })
        };
        let (decision, why) = of(Criterion::FloorAcceleration);
        assert_eq!(decision, Decision::Restrain);
        assert!(why.contains("move it to a lower floor"), "{why}");
        assert!(of(Criterion::Peak).1.contains("No softer pad helps"));
        let mild = Answers {
            too_mild: Some(TooMild::Round),
            ..answers(FallsAnswer::Close, ShockAnswer::Stands)
        };
        let (decision, why) = decide(&case(&mild));
        assert_eq!(decision, Decision::Restrain);
        assert!(why.starts_with("It is round"), "{why}");
    }

    #[test]
    fn too_few_motions_are_said_with_how_many_would_do() {
        let why = |few_motions| {
            let close = answers(FallsAnswer::Close, ShockAnswer::Unknown);
            decide(&case(&Answers {
                few_motions,
                ..close
            }))
            .1
        };
        let said = why(FewMotions::of(3, Some(44)));
        assert!(
            said.contains("3 motions are too few to leave it as it is")
                && said.contains("at least 44 would do"),
            "{said}"
        );
        assert!(why(FewMotions::of(1, None)).contains("1 motion is too few"));
        assert_eq!(
            (
                FewMotions::of(44, Some(44)),
                FewMotions::of(43, Some(44)).is_some()
            ),
            (None, true)
        );
    }

    #[test]
    fn models_that_disagree_are_both_told() {
        let both = Answers {
            rigid: Some(ModelAnswers {
                overturn: p(0.0, 0.0, 0.014),
                exceed: Some(p(0.04, 0.02, 0.07)),
            }),
            compliant: Some(ModelAnswers {
                overturn: p(0.0, 0.0, 0.014),
                exceed: Some(p(0.31, 0.25, 0.37)),
            }),
            ..answers(FallsAnswer::Stays, ShockAnswer::Exceeded)
        };
        let (_, why) = decide(&case(&both));
        let expected = "exceeds the peak that it withstands in 31 % (25 to 37 %) of the worlds, more than the accepted \
                        10 %. On a rigid base it is 4 %, on its pads 31 %: the models disagree, and the worse counts.";
        assert!(why.contains(expected), "{why}");
    }
}
