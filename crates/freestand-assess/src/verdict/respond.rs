//! What an object does under the motions of its floor: the one way in which it is asked, by an
//! assessment in every world and by a fragility at every scale. [`Way`] decides the model; an object
//! in a plane is followed about both of its axes, and the worse one counts.

use freestand::compliant::{
    CompliantAccuracy, CompliantBase, CompliantError, CompliantOptions, CompliantSummary,
    CompliantWorld, rock_compliant_observed,
};
use freestand::rocking::{Restitution, RockingError, RockingSummary, rock_between};
use freestand::wall::Walls;

use crate::worlds::FloorOfWorld;

use super::draw::Draw;
use super::object::{Subject, Way};
use super::pulse::Pulses;
use super::response::{
    AxisMotion, Lost, PadMotion, RigidResponse, Roll, axis_motion, leans, lifts, options,
    overturned, pad_motion, pad_motion_of, resolved,
};
use super::roll::rolled;
use super::space::{in_space, stacked, toppled};

/// An object with the values of one draw.
#[derive(Clone, Copy)]
pub(super) struct Drawn<'a> {
    pub(super) subject: &'a Subject,
    pub(super) draw: &'a Draw,
}

/// What an object did under one motion, about the worse of its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Outcome {
    /// No edge lifted, and it stayed where it was.
    Stood,
    /// An edge lifted, and it did not fall.
    Rocked {
        /// Largest uplift of an edge \[m\].
        uplift_m: f64,
    },
    /// It rolled on its casters, or its stop tripped it.
    Rolled(Travelled),
    /// It slid on its base, or its stop tripped it.
    Slid(Travelled),
    /// It ended leaning on a wall.
    Leaned,
    /// It fell.
    Overturned,
}

/// How an object rolled or slid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Travelled {
    /// The largest way from where it stood, as if nothing were in the way \[m\].
    pub(crate) travel_m: f64,
    /// Speed at which it reached its stop; `None`: it did not \[m/s\].
    pub(crate) stop_speed_m_s: Option<f64>,
    /// Whether one component of the floor is all that is known, so that it went farther.
    pub(crate) is_at_least: bool,
    /// Whether the stop overturned it.
    pub(crate) has_tripped: bool,
}

impl Outcome {
    /// On a rigid base, from every axis.
    pub(super) fn on_rigid(way: &Way, axes: &[AxisMotion]) -> Self {
        let travelled = || {
            let rolls = || axes.iter().filter_map(|one| one.roll);
            Travelled {
                travel_m: rolls().map(|roll: Roll| roll.travel_m).fold(0.0, f64::max),
                stop_speed_m_s: rolls()
                    .filter_map(|roll| roll.stop_speed_m_s)
                    .reduce(f64::max),
                is_at_least: rolls().any(|roll| roll.is_at_least),
                has_tripped: overturned(axes),
            }
        };
        match way {
            Way::Rolls(_) => Self::Rolled(travelled()),
            Way::Slides(_) => Self::Slid(travelled()),
            Way::Planar | Way::Walled(_) | Way::Spatial(_) | Way::Stack(_) => {
                if leans(axes) {
                    Self::Leaned
                } else if overturned(axes) {
                    Self::Overturned
                } else if lifts(axes) {
                    Self::Rocked {
                        uplift_m: axes
                            .iter()
                            .map(|one| one.rocking.uplift_m)
                            .fold(0.0, f64::max),
                    }
                } else {
                    Self::Stood
                }
            }
        }
    }

    /// On its pads, from every axis or of the whole body.
    pub(super) fn on_pads(axes: &[PadMotion]) -> Self {
        if axes.iter().any(|one| one.has_overturned) {
            return Self::Overturned;
        }
        if axes.iter().any(|one| one.has_let_go) {
            return Self::Rocked {
                uplift_m: axes.iter().map(|one| one.lift_m).fold(0.0, f64::max),
            };
        }
        Self::Stood
    }

    /// How it rolled or slid; `None`: it rocks.
    pub(crate) fn travelled(self) -> Option<Travelled> {
        match self {
            Self::Rolled(way) | Self::Slid(way) => Some(way),
            Self::Stood | Self::Rocked { .. } | Self::Leaned | Self::Overturned => None,
        }
    }

    /// Largest uplift of an edge, 0 where none lifted; `None`: it fell \[m\].
    pub(crate) fn uplift_m(self) -> Option<f64> {
        match self {
            Self::Rocked { uplift_m } => Some(uplift_m),
            Self::Leaned | Self::Overturned => None,
            Self::Rolled(way) | Self::Slid(way) => (!way.has_tripped).then_some(0.0),
            Self::Stood => Some(0.0),
        }
    }

    /// Whether it has fallen over, onto the floor or against a wall: what counts in decisions.
    pub(crate) fn has_fallen(self) -> bool {
        match self {
            Self::Leaned | Self::Overturned => true,
            Self::Rolled(way) | Self::Slid(way) => way.has_tripped,
            Self::Stood | Self::Rocked { .. } => false,
        }
    }
}

/// Objects on rigid bases under the motions of one floor, each about both of its axes; those that roll
/// or slide as well. Blocks that rock along one component of the floor stand side by side in the
/// kernel.
pub(super) fn on_rigid(objects: &[Drawn<'_>], floor: &FloorOfWorld) -> Vec<RigidResponse> {
    let mut found: Vec<Vec<Option<_>>> = objects
        .iter()
        .map(|one| one.subject.axes.iter().map(|_| None).collect())
        .collect();
    for is_x in [true, false] {
        let mut places = Vec::new();
        let mut blocks = Vec::new();
        for (place, Drawn { subject, draw }) in objects
            .iter()
            .enumerate()
            .filter(|(_, one)| one.subject.way.rocks())
        {
            for axis in (0..subject.axes.len()).filter(|&axis| draw.is_along_x(axis) == is_x) {
                if let Some((block, restitution)) = draw.block(subject, axis) {
                    places.push((place, axis));
                    blocks.push((block, restitution, draw.walls(subject, axis)));
                }
            }
        }
        let rocked = rock_between(
            &blocks,
            floor.base(is_x),
            &options(Restitution::Housner, Walls::NONE),
        );
        for (((place, axis), (block, ..)), rocked) in places.into_iter().zip(blocks).zip(rocked) {
            found[place][axis] = Some((block, rocked));
        }
    }
    let of_object =
        |(Drawn { subject, draw }, found): (&Drawn<'_>, Vec<Option<_>>)| -> RigidResponse {
            if let Some(gliding) = subject.way.glides() {
                return rolled(subject, gliding, draw, floor);
            }
            let body = draw.body(subject);
            let known = found
                .into_iter()
                .enumerate()
                .filter_map(|(axis, one)| Some((axis, one?)));
            let axes = known.map(
                |(axis, (block, rocked)): (usize, (_, Result<RockingSummary, RockingError>))| {
                    let rocking = rocked.map_err(Lost::from)?;
                    resolved(rocking.outcome)?;
                    Ok(axis_motion(
                        subject,
                        draw,
                        axis,
                        &block,
                        rocking,
                        body.as_ref(),
                        floor.pfa_m_s2,
                    ))
                },
            );
            axes.collect()
        };
    objects.iter().zip(found).map(of_object).collect()
}

/// An object on pads that are springs about an axis; `None`: its body is followed at once, or its pads are
/// none.
pub(super) fn on_springs<'a>(
    one: Drawn<'_>,
    axis: usize,
    floor: &'a FloorOfWorld,
) -> Option<CompliantWorld<'a>> {
    let Drawn { subject, draw } = one;
    if subject.way.is_slow() {
        return None;
    }
    let (mass_kg, cushion) = draw.body(subject)?;
    let stiffness_n_m = cushion.linear_stiffness_n_m()?;
    let (block, _) = draw.block(subject, axis)?;
    Some(CompliantWorld {
        block,
        mass_kg,
        stiffness_n_m,
        damping_n_s_m: draw.pad_damping_n_s_m(stiffness_n_m, mass_kg),
        motion: floor.base(draw.is_along_x(axis)),
    })
}

/// What the kernel found of it.
pub(super) fn of_springs(
    Drawn { subject, draw }: Drawn<'_>,
    floor: &FloorOfWorld,
    found: Result<CompliantSummary, CompliantError>,
) -> Result<PadMotion, String> {
    match found {
        Ok(found) => Ok(pad_motion(subject, draw, &found, floor.pfa_m_s2)),
        Err(error) => toppled(&error),
    }
}

/// By the solver for any contact law, with or without friction.
pub(super) fn on_any_pads(
    subject: &Subject,
    draw: &Draw,
    axis: usize,
    floor: &FloorOfWorld,
    friction_ratio: Option<f64>,
) -> Result<PadMotion, String> {
    let missing = || "mass or cushion is missing".to_owned();
    let (block, _) = draw.block(subject, axis).ok_or_else(missing)?;
    let (mass_kg, cushion) = draw.damped_body(subject).ok_or_else(missing)?;
    let base = CompliantBase {
        friction_ratio,
        ..CompliantBase::new(mass_kg, cushion)
    };
    let options = CompliantOptions {
        accuracy: CompliantAccuracy::Fast,
        ..CompliantOptions::default()
    };
    let motion = floor.base(draw.is_along_x(axis));
    let mut pulses = Pulses::new(block.base_width_m());
    match rock_compliant_observed(&block, &base, motion, &options, |piece| {
        pulses.observe(piece)
    }) {
        Ok(found) => {
            resolved(found.outcome).map_err(|lost| lost.why().to_owned())?;
            Ok(pad_motion_of(subject, draw, &found, pulses, floor.pfa_m_s2))
        }
        Err(error) => toppled(&error),
    }
}

/// Histories on a rigid base that [`on_rigid`] follows for an object.
pub(super) fn histories_on_rigid(subject: &Subject) -> usize {
    if subject.way.rocks() {
        subject.axes.len()
    } else {
        0
    }
}

/// An object whose whole body is followed at once: in three dimensions, or with another body on it.
/// `None`: it is followed about each of its axes.
pub(super) fn whole(one: Drawn<'_>, floor: &FloorOfWorld) -> Option<Result<PadMotion, String>> {
    let Drawn { subject, draw } = one;
    match &subject.way {
        Way::Spatial(beside) => Some(in_space(subject, beside.as_ref(), draw, floor)),
        Way::Stack(upper) => Some(stacked(subject, upper, draw, floor)),
        Way::Planar | Way::Walled(_) | Way::Rolls(_) | Way::Slides(_) => None,
    }
}
