//! Friction below what rocking needs: the object slides while it rocks, and only its pads can tell
//! what becomes of it.

use freestand::impact::impact_friction_needed_ratio;
use freestand::respond::{HistoryOptions, Plane, RigidPlane};
use freestand::rocking::Outcome;

use crate::worlds::FloorOfWorld;

use super::draw::{Draw, Drawn};
use super::object::Subject;
use super::response::{AxisMotion, RigidResponse};

/// Whether rocking, or one of its impacts, needs more friction than there is in this world. Never
/// where the list does not give the friction: an assumed one changes no number.
pub(super) fn slips(
    subject: &Subject,
    draw: &Draw,
    floor: &FloorOfWorld,
    rigid: Option<&RigidResponse>,
) -> bool {
    let Some(friction_ratio) = draw.friction_ratio.filter(|_| subject.way.rocks()) else {
        return false;
    };
    let Some(Ok(told)) = rigid else { return false };
    let rocking = told.axes.iter().map(AxisMotion::rocking).enumerate();
    let rocking = rocking.filter_map(|(axis, one)| Some((axis, one?)));
    let mut lifted = rocking.filter(|(_, one)| one.outcome != Outcome::NoUplift);
    lifted.any(|(axis, one)| {
        let drawn = Drawn { subject, draw };
        let needed = needed_ratio(drawn, floor, axis, one.impact_count > 0);
        needed.is_some_and(|needed| needed > friction_ratio)
    })
}

/// The friction that rocking about an axis needs, and an impact where it lands; `None`: its history
/// fails.
pub(super) fn needed_ratio(
    one: Drawn<'_>,
    floor: &FloorOfWorld,
    axis: usize,
    lands: bool,
) -> Option<f64> {
    let object = one.rigid_plane(axis)?;
    let RigidPlane {
        plane: Plane { along, block },
        restitution,
        ..
    } = object;
    let history = object.follow(floor.base(along), &HistoryOptions::default());
    let rocking = history.ok()?.friction_needed_ratio.unwrap_or(0.0);
    let landing = restitution.ratios(&block).ok().filter(|_| lands);
    Some(landing.map_or(rocking, |[ratio, _]| {
        rocking.max(impact_friction_needed_ratio(&block, ratio))
    }))
}
