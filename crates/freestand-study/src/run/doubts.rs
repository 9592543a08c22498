//! What the reader must know that follows from a result.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::impact::{ASSUMED_FRICTION, ImpactModel, Landing, impact_friction_needed_ratio};
use freestand::rocking::{Outcome, RockingModel, StopReason};

use crate::matched::high_peak_ratio;
use crate::result::{GroundMotion, LevelResult, ObjectResponse};
use crate::study::{Ground, Share, Study, StudyDoubt, UsedFriction};

/// What the reader must know of a result, beside what is known of its study.
pub(super) fn doubts(
    study: &Study,
    ground: &[GroundMotion],
    levels: &[LevelResult],
) -> Vec<StudyDoubt> {
    let peak = high_peak_ratio(ground.iter().filter_map(|motion| motion.misfit.as_ref()));
    let mut doubts: Vec<StudyDoubt> = peak.map(StudyDoubt::HighPeak).into_iter().collect();
    let rows = || {
        levels
            .iter()
            .flat_map(|level| level.responses.iter().flatten())
    };
    let done = || rows().filter_map(ObjectResponse::done);
    let histories = rows().count();
    let share = |count, of| Some(Share { count, of }).filter(|share| share.count > 0);
    let failed = share(histories - done().count(), histories);
    doubts.extend(failed.map(StudyDoubt::Failed));
    let unsettled = done()
        .filter(|(uplift, _)| uplift.rocking.stop == StopReason::EndOfMotion)
        .count();
    doubts.extend(share(unsettled, histories).map(StudyDoubt::Unsettled));
    if matches!(&study.ground, Ground::Synthetic(ground) if ground.near_fault.is_some()) {
        doubts.push(StudyDoubt::NoPulses);
    }

    let objects = &study.objects;
    let friction = UsedFriction {
        ratio: objects.friction.unwrap_or(ASSUMED_FRICTION),
        is_assumed: objects.friction.is_none(),
    };
    let of_objects = |is: &dyn Fn(&Block) -> bool| {
        let count = objects.blocks.iter().filter(|block| is(block)).count();
        share(count, objects.blocks.len())
    };
    let slide = of_objects(&|b| RockingModel::Rigid.uplift_threshold_ratio(b) > friction.ratio);
    doubts.extend(slide.map(|share| StudyDoubt::Slide(share, friction)));
    let slip = of_objects(&|b| {
        let r = objects
            .restitution
            .ratios(b)
            .map_or(0.0, |ratios| ratios[0]);
        impact_friction_needed_ratio(b, r) > friction.ratio
    });
    doubts.extend(slip.map(|share| StudyDoubt::Slip(share, friction)));
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
        let of_cushion = objects.cushion.compression_doubts(impact.compression_m);
        doubts.extend(of_cushion.into_iter().map(StudyDoubt::Cushion));
    }
    doubts
}
