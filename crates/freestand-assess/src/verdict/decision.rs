//! The decision on an object, and the reasons for it.

use freestand::decision::Side;

use crate::reason::{Missing, NoPad, Reason};
use crate::result::{
    Answers, Criterion, Decision, FallsAnswer, ModelAnswers, Probability, ShockAnswer, TooMild,
};

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
    pub(super) answers: &'a Answers,
    /// Whether it uplifts in any world by any model.
    pub(super) lifts: bool,
    /// Whether the tolerance may decide.
    pub(super) decides: bool,
    pub(super) governing: Option<Criterion>,
    /// What a comparison lacks.
    pub(super) missing: &'a [Missing],
    /// Whether the softer pad passed that was looked for.
    pub(super) softer: Option<bool>,
    /// Why no softer pad was looked for.
    pub(super) beyond_pads: NoPad,
}

/// The decision and its reasons.
pub(super) fn decide(case: &Case) -> (Decision, Vec<Reason>) {
    let Answers {
        falls,
        shock,
        asks_shock,
        ..
    } = *case.answers;
    let falling = Reason::Falling { lifts: case.lifts };
    if falls != FallsAnswer::Stays {
        return (Decision::Restrain, vec![falling]);
    }
    if !asks_shock {
        let lacks_tolerance = case.missing.contains(&Missing::Tolerance);
        let only = Reason::OnlyFalling { lacks_tolerance };
        return (Decision::Leave, vec![falling, only]);
    }
    if shock == ShockAnswer::Unknown {
        let unknown = Reason::ShockUnknown(case.missing.to_vec());
        return (Decision::NoVerdict, vec![falling, unknown]);
    }
    let of_shock = Reason::Shock(case.governing);
    if !case.decides {
        return (
            Decision::NoVerdict,
            vec![falling, of_shock, Reason::Unchecked],
        );
    }
    let (decision, remedy) = match (shock, case.softer) {
        (ShockAnswer::Stands, _) => return (Decision::Leave, vec![falling, of_shock]),
        (_, Some(true)) => (Decision::Soften, Reason::SofterPad),
        (_, Some(false)) => (Decision::Restrain, Reason::SofterPad),
        (_, None) if case.governing == Some(Criterion::FloorAcceleration) => {
            (Decision::Restrain, Reason::FloorTooStrong)
        }
        (_, None) => (Decision::Restrain, Reason::NoPadHelps(case.beyond_pads)),
    };
    (decision, vec![falling, of_shock, remedy])
}

/// The model with the larger upper end: the one that decides.
pub fn deciding(
    answers: &Answers,
    of: impl Fn(&ModelAnswers) -> Option<Probability>,
) -> Option<Probability> {
    let both = [&answers.rigid, &answers.compliant].map(|model| model.as_ref().and_then(&of));
    both.into_iter()
        .flatten()
        .reduce(|most, next| if next.high > most.high { next } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::FewMotions;

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
            answers,
            lifts: true,
            decides: true,
            governing: Some(Criterion::Peak),
            missing: &[],
            softer: None,
            beyond_pads: NoPad::NoPads,
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
            assert_eq!(decided(Stays, shock, Some(true), true), Decision::Soften);
            assert_eq!(decided(Stays, shock, Some(false), true), Decision::Restrain);
            assert_eq!(decided(Stays, shock, None, false), Decision::NoVerdict);
        }
        let only = Answers {
            asks_shock: false,
            ..answers(Stays, ShockAnswer::Unknown)
        };
        let (decision, why) = decide(&Case {
            missing: &[Missing::Tolerance],
            ..case(&only)
        });
        let lacks_tolerance = true;
        assert_eq!(decision, Decision::Leave);
        assert_eq!(why[1..], [Reason::OnlyFalling { lacks_tolerance }]);
    }

    #[test]
    fn answers_from_where_a_probability_lies() {
        use Side::{Above, Below, Open};
        let falls = |too_mild| [Below, Open, Above].map(|side| FallsAnswer::of(side, too_mild));
        let [stays, close, fall] = [FallsAnswer::Stays, FallsAnswer::Close, FallsAnswer::Falls];
        assert_eq!(falls(None), [stays, close, fall]);
        for why in [TooMild::Round, TooMild::OnHull] {
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

    /// No pad lowers the acceleration of the floor, and what is not checked cannot decide.
    #[test]
    fn reasons_beside_the_shock() {
        let exceeded = answers(FallsAnswer::Stays, ShockAnswer::Exceeded);
        let of = |governing, decides| {
            let (decision, why) = decide(&Case {
                governing: Some(governing),
                decides,
                ..case(&exceeded)
            });
            assert_eq!(
                why[..2],
                [
                    Reason::Falling { lifts: true },
                    Reason::Shock(Some(governing))
                ]
            );
            (decision, why[2].clone())
        };
        let [floor, peak] = [Criterion::FloorAcceleration, Criterion::Peak];
        assert_eq!(
            of(floor, true),
            (Decision::Restrain, Reason::FloorTooStrong)
        );
        assert_eq!(
            of(peak, true),
            (Decision::Restrain, Reason::NoPadHelps(NoPad::NoPads))
        );
        let unchecked = (Decision::NoVerdict, Reason::Unchecked);
        assert_eq!(of(peak, false), unchecked);
    }

    #[test]
    fn few_motions_are_those_below_what_is_needed() {
        assert_eq!(FewMotions::of(44, Some(44)), None);
        assert!(FewMotions::of(43, Some(44)).is_some());
    }
}
