//! Walls beside an object on its cushions.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::EdgeSide;
use freestand::cushion::{ContactLaw, Cushion};
use freestand::respond::HistoryOptions;
use freestand::spatial::{Shape, SpatialMotion, SpatialObject, SpatialRocking, Wall};
use freestand::wall::{self, Contact, Walls};
use freestand_input::problem::Problem;
use freestand_output::answer;

use super::{SpatialRequest, with_stiffness};
use crate::compliant::damped;
use crate::doubt::{BesideWall, HistoryDoubt};
use crate::unsolved;
use crate::walls::GivenCushion;

/// The walls of an object on these cushions: an edge of it meets the cushion of an edge, or one with the stiffness and
/// the damping ratio of the wall; without one of them that of the edge. Their restitution is not used: on
/// cushions it follows from the cushion.
///
/// # Errors
/// A stiffness or a damping alone for a law that has none.
pub fn walls_on_cushions(
    walls: &Walls,
    given: GivenCushion,
    cushion: &Cushion,
    mass_kg: f64,
) -> Result<Vec<Wall>, Problem> {
    let nonlinear = || {
        Problem::value(
            format!(
                "`wall_stiffness` or `wall_damping` alone does not describe a cushion of the law {}",
                cushion.law().name()
            ),
            "leave it out: the walls then have the cushion of an edge; give both, or use a linear law",
        )
    };
    let stiffness_n_m = given.stiffness_n_m.or(match *cushion.law() {
        ContactLaw::Linear { stiffness_n_m } | ContactLaw::KelvinVoigt { stiffness_n_m, .. } => {
            Some(stiffness_n_m)
        }
        _ => None,
    });
    let cushion = match (given.stiffness_n_m, given.damping_ratio) {
        (None, None) => None,
        (Some(stiffness_n_m), None) => Some(
            with_stiffness(cushion, stiffness_n_m, [mass_kg; 2])
                .unwrap_or_else(|| Err(nonlinear()))?,
        ),
        (_, Some(ratio)) => Some(damped(
            mass_kg,
            stiffness_n_m.ok_or_else(nonlinear)?,
            ratio,
        )?),
    };
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

/// What it does beside the softest and the stiffest walls that may stand there, where their cushion was not given.
///
/// # Errors
/// Those of the solver.
pub(super) fn ends(
    request: &SpatialRequest,
    motion: SpatialMotion<'_>,
) -> Result<Option<HistoryDoubt>, Problem> {
    let object = &request.object;
    let edge = &object.support.cushion;
    let weight_n = object.mass_kg * request.how.settings.gravity_m_s2;
    let edge_n_m = edge.tangent_stiffness_n_m(edge.static_compression_m(0.5 * weight_n));
    let Some(ends) = request.wall_cushion.ends(edge_n_m) else {
        return Ok(None);
    };
    if object.walls.is_empty() {
        return Ok(None);
    }
    let followed = |(stiffness_n_m, damping_ratio): (f64, f64)| -> Result<BesideWall, Problem> {
        let cushion = damped(object.mass_kg, stiffness_n_m, damping_ratio)?;
        let mut object = object.clone();
        for wall in &mut object.walls {
            wall.cushion = Some(cushion.clone());
        }
        let how = HistoryOptions {
            is_sampled: false,
            ..request.how.clone()
        };
        let body = object
            .follow(motion, &how)
            .map_err(unsolved::problem)?
            .rocking
            .body;
        Ok(BesideWall {
            stiffness_ratio: stiffness_n_m / edge_n_m,
            damping_ratio,
            outcome: body.outcome.name(),
            tilt_rad: body.peak_tilt_rad,
        })
    };
    let [soft, stiff] = ends.map(followed);
    Ok(Some(HistoryDoubt::WallCushionAssumed([soft?, stiff?])))
}

/// Refuses an object that cannot stand at a wall.
///
/// # Errors
/// A cylinder at a wall lower than it: its rims meet a wall, and no elements are on its curved face.
pub(super) fn check(object: &SpatialObject) -> Result<(), Problem> {
    let [.., height_m] = object.shape.sizes_m();
    let is_low = |wall: &Wall| wall.height_m < height_m;
    if !matches!(object.shape, Shape::Cylinder { .. }) || !object.walls.iter().any(is_low) {
        return Ok(());
    }
    let hint = "leave `wall_height` out, or give the cylinder as a prism with its diameter as thickness and width";
    Err(
        Problem::value("a cylinder at a wall lower than it is not modelled", hint)
            .of(&["wall_height"]),
    )
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
        .zip(rocking.wall_edge_forces_max_n)
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
