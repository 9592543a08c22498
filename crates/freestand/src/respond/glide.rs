//! An object that rolls on free casters, or slides on its base, before it could rock: only a stop can
//! overturn it.

use crate::rocking::RockingError;
use crate::sliding::{
    PlaneMotion, PlaneSliding, Sliding, SlidingOptions, SlidingOutcome, slide, slide_in_plane,
    trip_speed_m_s,
};

use super::error::RespondError;
use super::object::{Along, Glider, Plane, Planes, Shaking};
use super::settings::Settings;

/// What an object that rolls or slides does in one plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Glide {
    /// The largest distance from where it stood, as if nothing were in the way \[m\].
    pub travel_m: f64,
    /// What it needs free on every side of it, if its sides are along its axes \[m\].
    pub room_m: f64,
    /// Whether one component of the floor is all that is known, so that it travels farther.
    pub is_at_least: bool,
    /// Speed at which it reaches its stop; `None`: it does not \[m/s\].
    pub stop_speed_m_s: Option<f64>,
    /// Whether that stop overturns it.
    pub has_tripped: bool,
}

impl Glider {
    pub(super) fn followed(
        &self,
        shaking: &Shaking<'_>,
        settings: &Settings,
    ) -> Result<Planes<Glide>, RespondError> {
        let options = settings.sliding(self.friction, self.clearance);
        let both = under_both(&options, self.yaw_rad, shaking)?;
        let in_plane = |plane: &Plane| {
            let (travel_m, room_m, stop_speed_m_s) = match &both {
                Some(found) => (
                    found.peak_m,
                    found.room_m(),
                    self.stop_speed_m_s(plane, found),
                ),
                None => {
                    let found = slid(&options, shaking, plane.along)?;
                    let stop_speed_m_s = found.contact.map(|(_, speed_m_s)| speed_m_s.abs());
                    (found.peak_m.abs(), found.peak_m.abs(), stop_speed_m_s)
                }
            };
            let trip_m_s = trip_speed_m_s(&plane.block, settings.gravity_m_s2);
            Ok(Glide {
                travel_m,
                room_m,
                is_at_least: both.is_none(),
                stop_speed_m_s,
                has_tripped: stop_speed_m_s.is_some_and(|speed_m_s| speed_m_s >= trip_m_s),
            })
        };
        self.planes.map(in_plane).all()
    }

    /// Without a width the one block stands for both directions: it meets the stops of both.
    fn stop_speed_m_s(&self, plane: &Plane, found: &PlaneSliding) -> Option<f64> {
        let own = usize::from(plane.along != self.planes.one.along);
        let contacts = found.contacts.into_iter().enumerate();
        contacts
            .filter(|(axis, _)| self.planes.other.is_none() || *axis == own)
            .filter_map(|(_, contact)| contact.map(|(_, velocity_m_s)| velocity_m_s.abs()))
            .reduce(f64::max)
    }
}

/// The slide under both components of the floor, of an object that is turned from x towards y; `None`: it has one.
fn under_both(
    options: &SlidingOptions,
    yaw_rad: f64,
    shaking: &Shaking<'_>,
) -> Result<Option<PlaneSliding>, RespondError> {
    let (Some(x), Some(y)) = (shaking.x, shaking.y) else {
        return Ok(None);
    };
    let motion = PlaneMotion {
        x,
        y,
        vertical: shaking.vertical,
    };
    let found = slide_in_plane(motion, yaw_rad, options)?;
    match found.free_flight_time_s {
        Some(time_s) => Err(RockingError::FreeFlight { time_s }.into()),
        None => Ok(Some(found)),
    }
}

fn slid(
    options: &SlidingOptions,
    shaking: &Shaking<'_>,
    along: Along,
) -> Result<Sliding, RespondError> {
    let found = slide(shaking.base(along), options)?;
    match found.outcome {
        SlidingOutcome::FreeFlight => Err(RockingError::FreeFlight {
            time_s: found.end_time_s,
        }
        .into()),
        SlidingOutcome::Stuck | SlidingOutcome::Slid => Ok(found),
    }
}
