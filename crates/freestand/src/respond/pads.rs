//! An object on its pads: in a plane, in three dimensions, or with another body on it.

use crate::compliant::{
    CompliantBase, CompliantError, CompliantSummary, PadOutcome, rock_compliant_observed,
};
use crate::rocking::Outcome as Rocking;
use crate::spatial::{
    BaseLandings, BodyMotion, SpatialMotion, SpatialObject, Stack, StackPart, rock_spatial,
    rock_stack,
};

use super::error::RespondError;
use super::object::{Along, Plane, Shaking};
use super::pulse::Pulses;
use super::settings::Settings;

/// What an object on its pads did.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PadSummary {
    /// How it ended; [`Rocking::NoUplift`]: no edge let go of its pad.
    pub outcome: Rocking,
    /// U, as in [`CompliantSummary`]; `None` from a solver that does not know it.
    pub pad_uplift_ratio: Option<f64>,
    /// Largest height of an edge above its unloaded pad \[m\].
    pub lift_m: f64,
    /// Largest upward acceleration of an edge during contact \[m/s²\].
    pub edge_acceleration_m_s2: f64,
    /// Whether an edge landed at all.
    pub has_landed: bool,
    /// Δv of a landing \[m/s\].
    pub velocity_change_m_s: f64,
    /// Duration of the pulse with the highest peak \[s\].
    pub pulse_duration_s: Option<f64>,
    /// Largest compression of a pad under an edge \[m\].
    pub compression_m: f64,
}

/// What an object does in three dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tilt {
    /// Largest angle of its axis to the vertical \[rad\].
    pub tilt_rad: f64,
    /// Largest horizontal displacement of the centre of its base \[m\].
    pub walk_m: f64,
}

impl PadSummary {
    /// Whether it fell.
    pub fn has_fallen(&self) -> bool {
        self.outcome.has_fallen()
    }

    /// Whether an edge let go of its pad.
    pub fn has_let_go(&self) -> bool {
        self.outcome != Rocking::NoUplift
    }

    /// An object that its pads do not keep upright.
    const TOPPLED: Self = Self {
        outcome: Rocking::Overturned,
        pad_uplift_ratio: None,
        lift_m: 0.0,
        edge_acceleration_m_s2: 0.0,
        has_landed: false,
        velocity_change_m_s: 0.0,
        pulse_duration_s: None,
        compression_m: 0.0,
    };

    /// What the kernel found.
    pub(super) fn of_springs(
        found: Result<CompliantSummary, CompliantError>,
    ) -> Result<Self, RespondError> {
        match found {
            Ok(found) => Ok(Self {
                outcome: match found.outcome {
                    PadOutcome::StayedOn => Rocking::NoUplift,
                    PadOutcome::LetGo => Rocking::Rocked,
                    PadOutcome::Overturned => Rocking::Overturned,
                },
                pad_uplift_ratio: Some(found.pad_uplift_ratio),
                lift_m: found.lift_m,
                edge_acceleration_m_s2: found.peak_edge_acceleration_m_s2(),
                has_landed: found.touch_count > 0,
                velocity_change_m_s: found.velocity_change_m_s,
                pulse_duration_s: found.pulse_duration_s,
                compression_m: found.peak_compression_m,
            }),
            Err(error) => toppled(error),
        }
    }

    /// By the solver for any contact law, with or without friction.
    pub(super) fn followed(
        plane: &Plane,
        base: &CompliantBase,
        shaking: &Shaking<'_>,
        settings: &Settings,
    ) -> Result<Self, RespondError> {
        let motion = shaking.base(plane.along);
        let options = settings.compliant(motion.horizontal.or(motion.vertical));
        let mut pulses = Pulses::new(plane.block.base_width_m());
        let found = rock_compliant_observed(&plane.block, base, motion, &options, |piece| {
            pulses.observe(piece)
        });
        let found = match found {
            Ok(found) => found,
            Err(error) => return toppled(error),
        };
        let (velocity_change_m_s, pulse_duration_s) = pulses.found(&found);
        Ok(Self {
            outcome: found.outcome,
            pad_uplift_ratio: None,
            lift_m: found.uplift_m,
            edge_acceleration_m_s2: found.peak_edge_acceleration_m_s2(),
            has_landed: !found.touches.is_empty(),
            velocity_change_m_s,
            pulse_duration_s,
            compression_m: found.peak_compression_m,
        })
    }

    /// Of a body in space.
    fn of_body(outcome: Rocking, body: &BodyMotion, landings: &BaseLandings) -> Self {
        Self {
            outcome,
            pad_uplift_ratio: None,
            lift_m: body.uplift_m,
            edge_acceleration_m_s2: landings.peak_acceleration_m_s2,
            has_landed: landings.pulse_duration_s.is_some(),
            velocity_change_m_s: landings.velocity_change_m_s,
            pulse_duration_s: landings.pulse_duration_s,
            compression_m: landings.peak_compression_m,
        }
    }
}

/// A block whose pads do not keep it upright falls under any motion.
fn toppled(error: CompliantError) -> Result<PadSummary, RespondError> {
    match error {
        CompliantError::Unstable { .. } => Ok(PadSummary::TOPPLED),
        _ => Err(error.into()),
    }
}

/// Under both horizontal motions of the floor, and the vertical one where there is one. A floor with
/// one component moves along x alone.
pub(super) fn in_space(
    object: &SpatialObject,
    along: Along,
    shaking: &Shaking<'_>,
    settings: &Settings,
) -> Result<(PadSummary, Option<Tilt>), RespondError> {
    let across = match along {
        Along::X => Along::Y,
        Along::Y => Along::X,
    };
    let component = |along: Along| match along {
        Along::X => shaking.x,
        Along::Y => shaking.y,
    };
    let motion = SpatialMotion {
        x: component(along),
        y: component(across),
        vertical: shaking.vertical,
    };
    let found = match rock_spatial(object, motion, &settings.spatial(shaking.any())) {
        Ok(found) => found,
        Err(error) => return toppled(error).map(|body| (body, None)),
    };
    let tilt = Tilt {
        tilt_rad: found.body.peak_tilt_rad,
        walk_m: found.body.base_slide_peak_m,
    };
    let body = PadSummary::of_body(found.body.outcome, &found.body, &found.landings);
    Ok((body, Some(tilt)))
}

/// Both bodies in one plane. The shock is that of the lower one.
pub(super) fn stacked(
    stack: &Stack,
    along: Along,
    shaking: &Shaking<'_>,
    settings: &Settings,
) -> Result<(PadSummary, Option<StackPart>), RespondError> {
    let found = match rock_stack(stack, shaking.base(along), &settings.spatial(shaking.any())) {
        Ok(found) => found,
        Err(error) => {
            return toppled(error).map(|body| (body, Some(StackPart::Lower)));
        }
    };
    let lower = PadSummary::of_body(found.outcome, &found.lower, &found.landings);
    Ok((lower, found.overturned_body))
}
