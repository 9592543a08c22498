//! An object in three dimensions on its pads in one world, and one with another body on it.

use freestand::compliant::{CompliantAccuracy, CompliantError, EdgeSide};
use freestand::spatial::{
    Shape, SpatialMotion, SpatialObject, SpatialOptions, Stack, StackBody, StackPart, Support,
    Wall, rock_spatial, rock_stack,
};

use crate::result::Axis;
use crate::worlds::FloorOfWorld;

use super::draw::Draw;
use super::object::{Beside, Subject, Upper};
use super::response::{PadMotion, TOPPLED, resolved, space_motion};

/// Accuracy of every history. Single histories differ from those at `standard`, distributions do
/// not: of 40 pairs of motions a square cabinet falls in 14 against 16, a bookshelf in 30 against 31,
/// and the median tilt of the cabinet is 0.260 against 0.273; it takes half of the time.
const ACCURACY: CompliantAccuracy = CompliantAccuracy::Fast;

fn options() -> SpatialOptions {
    SpatialOptions {
        accuracy: ACCURACY,
        ..SpatialOptions::default()
    }
}

fn missing() -> String {
    "mass or cushion is missing".to_owned()
}

/// A block whose pads do not keep it upright falls in any world.
pub(super) fn toppled(error: &CompliantError) -> Result<PadMotion, String> {
    match error {
        CompliantError::Unstable { .. } => Ok(TOPPLED),
        _ => Err(error.to_string()),
    }
}

/// The object under both horizontal motions of its floor, and the vertical one where there is one.
/// A floor with one component moves along x alone.
pub(super) fn in_space(
    subject: &Subject,
    beside: Option<&Beside>,
    draw: &Draw,
    floor: &FloorOfWorld,
) -> Result<PadMotion, String> {
    let (mass_kg, cushion) = draw.damped_body(subject).ok_or_else(missing)?;
    let (height_m, thickness_m) = draw.size_m(subject, 0);
    let (_, width_m) = draw.size_m(subject, 1);
    let support = Support {
        friction_ratio: draw.friction_ratio,
        ..Support::new(cushion)
    };
    let object = SpatialObject {
        shape: Shape::Prism {
            thickness_m,
            width_m,
            height_m,
        },
        mass_kg,
        support,
        walls: beside
            .into_iter()
            .flat_map(|beside| walls(beside, draw, mass_kg))
            .collect(),
    };
    let along = |axis: usize| {
        let is_x = draw.is_along_x(axis);
        (is_x || floor.motion.across.is_some()).then(|| floor.component(is_x))
    };
    let motion = SpatialMotion {
        x: along(0),
        y: along(1),
        vertical: floor.base(true).vertical,
    };
    match rock_spatial(&object, motion, &options()) {
        Ok(found) => {
            resolved(found.body.outcome).map_err(|lost| lost.why().to_owned())?;
            let history = (found.body.outcome, &found.body, &found.landings);
            Ok(space_motion(subject, draw, history, floor.pfa_m_s2))
        }
        Err(error) => toppled(&error),
    }
}

/// The wall behind it, on the side that was drawn.
fn walls(beside: &Beside, draw: &Draw, mass_kg: f64) -> Vec<Wall> {
    let Some(drawn) = &draw.wall else {
        return Vec::new();
    };
    let walls = beside.walls(Axis::Thickness, drawn);
    let wall = |(side, wall): (EdgeSide, Option<freestand::wall::Wall>)| {
        let wall = wall?;
        Some(Wall {
            side,
            gap_m: wall.gap_m,
            height_m: wall.height_m.unwrap_or(f64::INFINITY),
            cushion: beside
                .stiffness_n_m
                .and_then(|stiffness_n_m| draw.damped(stiffness_n_m, mass_kg)),
        })
    };
    [(EdgeSide::Left, walls.left), (EdgeSide::Right, walls.right)]
        .into_iter()
        .filter_map(wall)
        .collect()
}

/// An object and what stands on it, with the values of a world.
pub(super) fn stack(subject: &Subject, upper: &Upper, draw: &Draw) -> Option<Stack> {
    let (mass_kg, cushion) = draw.damped_body(subject)?;
    let (height_m, thickness_m) = draw.size_m(subject, 0);
    let support = Support {
        friction_ratio: draw.friction_ratio,
        ..Support::new(cushion)
    };
    let [mass, height, thickness] = draw.upper;
    Some(Stack {
        lower: StackBody {
            height_m,
            thickness_m,
            mass_kg,
        },
        upper: StackBody {
            height_m: upper.height_m * height,
            thickness_m: upper.thickness_m * thickness,
            mass_kg: upper.mass_kg * mass,
        },
        interface: support.clone(),
        support,
    })
}

/// Both in the plane of the thickness. The shock is that of the lower one.
pub(super) fn stacked(
    subject: &Subject,
    upper: &Upper,
    draw: &Draw,
    floor: &FloorOfWorld,
) -> Result<PadMotion, String> {
    let stack = stack(subject, upper, draw).ok_or_else(missing)?;
    match rock_stack(&stack, floor.base(draw.is_along_x(0)), &options()) {
        Ok(found) => {
            resolved(found.outcome).map_err(|lost| lost.why().to_owned())?;
            let history = (found.outcome, &found.lower, &found.landings);
            let motion = space_motion(subject, draw, history, floor.pfa_m_s2);
            Ok(PadMotion {
                space: None,
                fallen: found.overturned_body,
                ..motion
            })
        }
        // Its pads do not keep it upright.
        Err(error) => toppled(&error).map(|motion| PadMotion {
            fallen: Some(StackPart::Lower),
            ..motion
        }),
    }
}
