//! Warnings that follow from a result.

use freestand::G0_M_S2;
use freestand::impact::{ASSUMED_FRICTION, ImpactModel, Landing, impact_friction_needed_ratio};
use freestand::rocking::{Outcome, RockingModel, StopReason};

use crate::matched::peak_warning;
use crate::result::{GroundMotion, LevelResult, ObjectResponse};
use crate::study::{Ground, Study};

/// One sentence each.
pub(super) fn result_warnings(
    study: &Study,
    ground: &[GroundMotion],
    levels: &[LevelResult],
) -> Vec<String> {
    let peak = peak_warning(ground.iter().filter_map(|motion| motion.misfit.as_ref()));
    let mut warnings: Vec<String> = peak.into_iter().collect();
    let rows = || {
        levels
            .iter()
            .flat_map(|level| level.responses.iter().flatten())
    };
    let done = || rows().filter_map(ObjectResponse::done);
    let failed = rows().count() - done().count();
    if failed > 0 {
        warnings.push(format!(
            "{failed} of {} histories could not be calculated: see the column reason of srs.csv",
            rows().count()
        ));
    }

    let unsettled = done()
        .filter(|(uplift, _)| uplift.rocking.stop == StopReason::EndOfMotion)
        .count();
    if unsettled > 0 {
        warnings.push(format!(
            "{unsettled} of {} histories had not come to rest when the calculation stopped after the motion: later \
             impacts are not counted",
            rows().count()
        ));
    }

    if matches!(&study.ground, Ground::Synthetic(ground) if ground.near_fault.is_some()) {
        warnings.push(
            "the earthquake is near its fault, and the motions of a study have no velocity pulses: those of a list and of one \
             object have"
                .to_owned(),
        );
    }

    let objects = &study.objects;
    let friction = objects.friction.unwrap_or(ASSUMED_FRICTION);
    let assumed = if objects.friction.is_some() {
        ""
    } else {
        " (assumed)"
    };
    let squat = objects
        .blocks
        .iter()
        .filter(|b| RockingModel::Rigid.uplift_threshold_ratio(b) > friction)
        .count();
    if squat > 0 {
        warnings.push(format!(
            "for {squat} of {} objects t/h is above the friction of {friction}{assumed}: such objects slide before \
             they uplift, which the model neglects",
            objects.blocks.len()
        ));
    }
    let slipping = objects
        .blocks
        .iter()
        .filter(|b| {
            let r = objects
                .restitution
                .ratios(b)
                .map_or(0.0, |ratios| ratios[0]);
            impact_friction_needed_ratio(b, r) > friction
        })
        .count();
    if slipping > 0 {
        warnings.push(format!(
            "for {slipping} of {} objects the friction needed in an impact is above {friction}{assumed}: the edge \
             that lands may slip",
            objects.blocks.len()
        ));
    }
    let worst = done()
        .filter(|(uplift, _)| uplift.rocking.outcome == Outcome::Rocked)
        .map(|(uplift, _)| {
            let landing = Landing::rocking(&uplift.block, ImpactModel::Paper);
            landing.impact(
                objects.mass_kg,
                &objects.cushion.cushion,
                uplift.rocking.cg_rise_m,
                G0_M_S2,
            )
        })
        .max_by(|a, b| a.compression_m.total_cmp(&b.compression_m));
    if let Some(impact) = worst {
        let doubts = objects.cushion.compression_doubts(impact.compression_m);
        warnings.extend(doubts.iter().map(ToString::to_string));
    }
    warnings
}
