//! Whether two studies describe the same model, however they are written.

use freestand::synthesis::matched_periods_s;

use crate::cushion::EdgeCushion;
use crate::study::{Ground, Objects, RecordedMotion, Study};
use crate::target::Target;

/// Whether everything that a result is computed from is equal; texts, notes and names may differ.
pub(super) fn is_same_model(one: &Study, other: &Study) -> bool {
    let both_given = one.levels.len() == other.levels.len();
    let mut levels = one.levels.iter().zip(&other.levels);
    one.directions_deg == other.directions_deg
        && both_given
        && levels
            .all(|(a, b)| a.level_ratio == b.level_ratio && same_records(&a.motions, &b.motions))
        && same_ground(&one.ground, &other.ground)
        && same_building(one, other)
        && plain(&one.objects) == plain(&other.objects)
}

fn same_ground(one: &Ground, other: &Ground) -> bool {
    match (one, other) {
        (Ground::Synthetic(a), Ground::Synthetic(b)) => {
            a.count == b.count && a.seed == b.seed && same_spectrum(&a.target, &b.target)
        }
        (Ground::Recorded(a), Ground::Recorded(b)) => same_records(a, b),
        (Ground::OnFloors, Ground::OnFloors) => true,
        _ => false,
    }
}

/// Motions are generated from the target at these periods and compared with it at zero.
fn same_spectrum(one: &Target, other: &Target) -> bool {
    let mut periods_s = matched_periods_s().into_iter().chain([0.0]);
    periods_s.all(|period_s| one.spectrum.sa_g(period_s) == other.spectrum.sa_g(period_s))
}

fn same_records(one: &[RecordedMotion], other: &[RecordedMotion]) -> bool {
    let across =
        |record: &RecordedMotion| record.across.as_ref().map(|second| second.motion.clone());
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(a, b)| a.motion == b.motion && across(a) == across(b))
}

/// Once the modes are known, height and storeys only name the levels. A second axis matters only if
/// it is used.
fn same_building(one: &Study, other: &Study) -> bool {
    match (&one.building, &other.building) {
        (Some(a), Some(b)) => {
            let second_axis = one.ground.has_two_components(&one.levels);
            a.along == b.along && (!second_axis || a.across == b.across)
        }
        (None, None) => true,
        _ => false,
    }
}

fn plain(objects: &Objects) -> Objects {
    let cushion = EdgeCushion {
        notes: Vec::new(),
        ..objects.cushion.clone()
    };
    Objects {
        cushion,
        cushion_file: None,
        ..objects.clone()
    }
}
