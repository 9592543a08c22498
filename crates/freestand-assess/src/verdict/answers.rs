//! What the worlds of an object answer: whether it falls, and whether a shock damages it.

use freestand_study::statistics::QUANTILES;

use crate::result::{Answers, FallsAnswer, FewMotions, ModelAnswers, ShockAnswer, TooMild};

use super::Context;
use super::object::{Model, Way};
use super::over_worlds::quantile;
use super::trial::{MILD_HIGH, Question, Trial};

/// The answers of both models, in the worlds that were lived through.
pub(super) fn answers(context: &Context, trial: &Trial) -> Answers {
    let accepted = trial.member.accepted_ratio;
    let is_known =
        trial
            .subject
            .capacity
            .as_ref()
            .is_some_and(|capacity| match trial.subject.way {
                Way::Rolls(_) | Way::Slides(_) => stop_is_known(trial),
                Way::Hull(..) => !capacity.needs_shock(),
                Way::Planar | Way::Walled(_) | Way::Spatial(_) | Way::Stack(_) => {
                    trial.subject.body.is_some() || !capacity.needs_shock()
                }
            });
    let model = |model| ModelAnswers {
        overturn: trial.probability(context, Question::Falls, model),
        exceed: trial
            .subject
            .capacity
            .as_ref()
            .map(|_| trial.probability(context, Question::Shock, model)),
    };
    let [rigid, compliant] =
        [Model::Rigid, Model::Pads].map(|one| trial.asks(context, one).then(|| model(one)));
    let too_mild = too_mild(trial);
    let falls = match FallsAnswer::of(trial.side(context, Question::Falls), too_mild) {
        FallsAnswer::Close if !trial.is_settled() => FallsAnswer::Open,
        falls => falls,
    };
    let capacity = trial.subject.capacity.as_ref();
    let shock_side = capacity.map(|_| trial.side(context, Question::Shock));
    let is_above = |p: crate::result::Probability| p.value > accepted;
    let models_agree = rigid.zip(compliant).map(|(rigid, pads)| {
        let falls = is_above(rigid.overturn) == is_above(pads.overturn);
        let exceeds = rigid.exceed.map(is_above) == pads.exceed.map(is_above);
        falls && (exceeds || !trial.member.asks_shock)
    });
    let asked_on_pads = trial.lived.iter().filter(|one| one.pads.is_some()).count() as u32;
    let restitutions = || trial.lived.iter().map(|one| one.draw.restitution());
    Answers {
        falls,
        shock: match ShockAnswer::of(shock_side, is_known) {
            ShockAnswer::Close if !trial.is_settled() => ShockAnswer::Open,
            shock => shock,
        },
        asks_shock: trial.member.asks_shock,
        models_agree,
        worlds: trial.worlds(),
        worlds_cap: trial.cap(),
        worlds_compliant: compliant
            .and_then(|_| (asked_on_pads < trial.worlds()).then_some(asked_on_pads)),
        confidence: context.study.assessment.worlds.looks.confidence(),
        rigid,
        compliant,
        restitution_p16_p84: [QUANTILES[0], QUANTILES[2]].map(|q| quantile(restitutions(), q)),
        too_mild,
        worlds_needed: context
            .fewest_worlds(accepted)
            .filter(|needed| context.worlds.records().is_none() && trial.cap() < *needed),
        few_motions: context
            .worlds
            .records()
            .and_then(|n| FewMotions::of(n, context.fewest_records(accepted))),
    }
}

/// Why it may fall where it stands in its calculation. A body on its hull that falls in no world is taken to fall in
/// as many as [`MILD_HIGH`]; one that falls in any is left only where half of them are accepted.
fn too_mild(trial: &Trial) -> Option<TooMild> {
    let accepted = trial.member.accepted_ratio;
    let is_bounded = matches!(trial.subject.way, Way::Hull(..))
        && trial.subject.too_mild != Some(TooMild::UnseenBase)
        && accepted > MILD_HIGH
        && (accepted >= 0.5 || !trial.falls_at_all());
    trial.subject.too_mild.filter(|_| !is_bounded)
}

/// Whether the demand of every world is known: that of a stop needs its stiffness and the mass.
pub(super) fn stop_is_known(trial: &Trial) -> bool {
    trial
        .followed()
        .all(|(_, axes)| axes.iter().all(|one| one.terms.is_some()))
}
