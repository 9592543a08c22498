//! Walls beside an object on its cushions.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::EdgeSide;
use freestand::cushion::Cushion;
use freestand::spatial::{Shape, SpatialObject, SpatialRocking, Wall};
use freestand::wall::{self, Contact, Walls};
use freestand_input::problem::Problem;
use freestand_output::answer;

use super::with_stiffness;

/// The walls of an object on these cushions: an edge of it meets the cushion of an edge, or the same
/// law with the stiffness of the wall and the same damping ratio. Their restitution is not used: on
/// cushions it follows from the cushion.
///
/// # Errors
/// A stiffness for a law that has none.
pub fn walls_on_cushions(
    walls: &Walls,
    stiffness_n_m: Option<f64>,
    cushion: &Cushion,
    mass_kg: f64,
) -> Result<Vec<Wall>, Problem> {
    let cushion = stiffness_n_m
        .map(|stiffness_n_m| {
            with_stiffness(cushion, stiffness_n_m, [mass_kg; 2]).unwrap_or_else(|| {
                Err(Problem::value(
                    format!(
                        "`wall_stiffness` does not describe a cushion of the law {}",
                        cushion.law().name()
                    ),
                    "leave it out: the walls then have the cushion of an edge; or use a linear law",
                ))
            })
        })
        .transpose()?;
    let wall = |side: EdgeSide, given: Option<wall::Wall>| {
        given.map(|given| Wall {
            side,
            gap_m: given.gap_m,
            height_m: given.height_m.unwrap_or(f64::INFINITY),
            cushion: cushion.clone(),
        })
    };
    Ok([
        wall(EdgeSide::Left, walls.left),
        wall(EdgeSide::Right, walls.right),
    ]
    .into_iter()
    .flatten()
    .collect())
}

/// Refuses an object that cannot stand at a wall.
///
/// # Errors
/// A cylinder: its rim would roll along the wall, and the elements of a wall are those of an edge.
pub(super) fn check(object: &SpatialObject) -> Result<(), Problem> {
    if object.walls.is_empty() || !matches!(object.shape, Shape::Cylinder { .. }) {
        return Ok(());
    }
    let hint = "leave the wall out, or give the cylinder as a prism with its diameter as thickness and width";
    Err(Problem::value(
        "a cylinder at a wall is not modelled: its rim would roll along it",
        hint,
    )
    .of(&["wall_gap_left"]))
}

/// What a wall beside an object on cushions does not do.
pub(super) fn feet_warning(object: &SpatialObject) -> Option<String> {
    (!object.walls.is_empty()).then(|| {
        "the top and the face of the object meet the wall, and its feet pass through it: on a rigid base it may fall \
         where it stands here"
            .to_owned()
    })
}

/// The contact of the object with one of its walls where it turns about an edge that does not give.
fn contact(object: &SpatialObject, wall: &Wall) -> Option<Contact> {
    let [thickness_m, _, height_m] = object.shape.sizes_m();
    let block = Block::uniform(height_m, thickness_m).ok()?;
    let height_m = Some(wall.height_m).filter(|height_m| height_m.is_finite());
    let given = wall::Wall {
        height_m,
        ..wall::Wall::at(wall.gap_m)
    };
    given.contact(&block, block.pivot()).ok()?
}

answer! {
    /// What a history on cushions says about walls.
    pub struct CushionWallAnswer {
        wall_angle_left_rad: Option<f64> = "touches the left wall at",
        wall_angle_right_rad: Option<f64> = "touches the right wall at",
        wall_impact_count: usize = "contacts with walls",
        wall_speed_max_m_s: Option<f64> = "  largest speed",
        wall_acceleration_g: Option<f64> = "  shock at the point of contact",
        /// The largest force on a wall.
        wall_force_max_n: Option<f64>,
    }
}

/// What a history says about walls; nothing without one.
pub(super) fn answer(
    object: &SpatialObject,
    rocking: &SpatialRocking,
) -> Option<CushionWallAnswer> {
    if object.walls.is_empty() {
        return None;
    }
    let of = |side: EdgeSide| object.walls.iter().find(|wall| wall.side == side);
    let angle = |side| {
        of(side)
            .and_then(|wall| contact(object, wall))
            .map(|contact| contact.angle_rad)
    };
    let [thickness_m, _, height_m] = object.shape.sizes_m();
    // The effective mass where the object strikes each wall.
    let shock_g = |(side, force_n): (EdgeSide, f64)| {
        let block = Block::uniform(height_m, thickness_m).ok()?;
        let effective_kg =
            object.mass_kg * contact(object, of(side)?)?.effective_mass_ratio(&block);
        Some(force_n / (effective_kg * G0_M_S2))
    };
    let has_struck = rocking.wall_contact_count > 0;
    let forces_n = rocking.wall_forces_max_n;
    let shock_g = EdgeSide::BOTH
        .into_iter()
        .zip(forces_n)
        .filter_map(shock_g)
        .reduce(f64::max);
    Some(CushionWallAnswer {
        wall_angle_left_rad: angle(EdgeSide::Left),
        wall_angle_right_rad: angle(EdgeSide::Right),
        wall_impact_count: rocking.wall_contact_count,
        wall_speed_max_m_s: has_struck.then_some(rocking.wall_speed_max_m_s),
        wall_acceleration_g: shock_g.filter(|_| has_struck),
        wall_force_max_n: has_struck.then_some(forces_n[0].max(forces_n[1])),
    })
}
