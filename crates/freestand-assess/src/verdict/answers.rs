//! What the worlds of an object answer: whether it falls, and whether a shock damages it.

use freestand_study::statistics::QUANTILES;

use crate::result::{Answers, FallsAnswer, FewMotions, ModelAnswers, ShockAnswer};

use super::Context;
use super::object::{Model, Way};
use super::over_worlds::quantile;
use super::trial::{Question, Trial};

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
    let too_mild = trial.subject.too_mild;
    let falls = FallsAnswer::of(trial.side(context, Question::Falls), too_mild);
    let capacity = trial.subject.capacity.as_ref();
    let shock_side = capacity.map(|_| trial.side(context, Question::Shock));
    let is_above = |p: crate::result::Probability| p.value > accepted;
    let models_agree = rigid.zip(compliant).map(|(rigid, pads)| {
        let falls = is_above(rigid.overturn) == is_above(pads.overturn);
        let exceeds = rigid.exceed.map(is_above) == pads.exceed.map(is_above);
        falls && (exceeds || !trial.member.asks_shock)
    });
    let asked_on_pads = trial.lived.iter().filter(|one| one.pads.is_some()).count() as u32;
    let restitutions = || trial.lived.iter().map(|one| one.draw.restitution[0]);
    Answers {
        falls,
        shock: ShockAnswer::of(shock_side, is_known),
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

/// Whether the demand of every world is known: that of a stop needs its stiffness and the mass.
pub(super) fn stop_is_known(trial: &Trial) -> bool {
    trial
        .followed()
        .all(|(_, axes)| axes.iter().all(|one| one.terms.is_some()))
}
