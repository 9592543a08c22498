//! Walls as a person gives them, and what a history says about them.

use freestand::G0_M_S2;
use freestand::block::{Block, Pivot};
use freestand::rocking::{Rocking, SideExtremes, WallImpact};
use freestand::wall::{Contact, DEFAULT_WALL_RESTITUTION_RATIO, Wall, WallError, Walls};
use freestand::wall_shock::{WallShock, largest};
use freestand::worlds::{WALL_DAMPING_RATIO, WALL_STIFFNESS_RATIO};
use freestand_input::problem::Problem;
use freestand_output::answer;

use crate::doubt::HistoryDoubt;

/// The walls beside an object, in SI, as far as they were given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GivenWalls {
    /// Gap on the left \[m\].
    pub left_gap_m: Option<f64>,
    /// Gap on the right \[m\].
    pub right_gap_m: Option<f64>,
    /// Height of both \[m\]; without it they are taller than the object.
    pub height_m: Option<f64>,
    /// Restitution of both.
    pub restitution_ratio: Option<f64>,
}

impl GivenWalls {
    /// The walls, checked with `block`.
    ///
    /// # Errors
    /// A height or a restitution without a gap, and values that the solver refuses.
    pub fn walls(&self, block: &Block) -> Result<Walls, Problem> {
        let Self {
            left_gap_m,
            right_gap_m,
            height_m,
            restitution_ratio,
        } = *self;
        let wall = |gap_m: f64| Wall {
            gap_m,
            height_m,
            restitution_ratio: restitution_ratio.unwrap_or(DEFAULT_WALL_RESTITUTION_RATIO),
        };
        let walls = Walls {
            left: left_gap_m.map(wall),
            right: right_gap_m.map(wall),
        };
        if walls.is_none() && (height_m.is_some() || restitution_ratio.is_some()) {
            return Err(needs_a_gap());
        }
        walls.contacts(block).map_err(wall_problem)?;
        Ok(walls)
    }
}

/// The cushion of walls, as far as it was given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GivenCushion {
    /// k_w \[N/m\].
    pub stiffness_n_m: Option<f64>,
    /// ζ_w = c_w/(2√(k_w m)).
    pub damping_ratio: Option<f64>,
}

impl GivenCushion {
    /// k_w and ζ_w of the softest and least damped wall that may stand beside an object with edges of this stiffness, and of
    /// the stiffest and most damped one; `None`: both were given.
    pub fn ends(&self, edge_n_m: f64) -> Option<[(f64, f64); 2]> {
        let ((soft, stiff), (least, most)) = (WALL_STIFFNESS_RATIO, WALL_DAMPING_RATIO);
        let of = |stiffness_ratio: f64, damping_ratio: f64| {
            (
                self.stiffness_n_m.unwrap_or(stiffness_ratio * edge_n_m),
                self.damping_ratio.unwrap_or(damping_ratio),
            )
        };
        let is_open = self.stiffness_n_m.is_none() || self.damping_ratio.is_none();
        is_open.then(|| [of(soft, least), of(stiff, most)])
    }
}

/// A wall that cannot be used, with what to do about it.
pub fn wall_problem(error: WallError) -> Problem {
    let (key, hint) = match error {
        WallError::Gap { .. } => (
            "wall_gap_left",
            "give a gap of 0 (touching) or more, or leave it out where there is no wall",
        ),
        WallError::Height { .. } => (
            "wall_height",
            "give a positive `wall_height`, or leave it out for a wall taller than the object",
        ),
        WallError::Restitution { .. } => (
            "wall_restitution",
            "give a `wall_restitution` of 0 or more and less than 1; 0.5 is the most of a passive wall",
        ),
    };
    Problem::value(error.to_string(), hint).of(&[key])
}

/// Something about a wall whose place is not given.
pub fn needs_a_gap() -> Problem {
    Problem::value(
        "there is no wall: its distance from the object is missing",
        "give `wall_gap_left` (behind the object) or `wall_gap_right`; 0 where they touch",
    )
}

/// Mass and stiffness for the shock on a wall, as far as they are known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WallStiffness {
    /// Mass of the object \[kg\].
    pub mass_kg: Option<f64>,
    /// k_w \[N/m\].
    pub stiffness_n_m: Option<f64>,
}

impl WallStiffness {
    /// a_w of an impact \[g\].
    fn acceleration_g(&self, shock: &WallShock, omega_rad_s: f64) -> Option<f64> {
        Some(shock.acceleration_m_s2(omega_rad_s, self.mass_kg?, self.stiffness_n_m?) / G0_M_S2)
    }
}

answer! {
    /// What a history says about walls.
    pub struct WallAnswer of (rocking: &Rocking, block: &Block, stiffness: WallStiffness) {
        wall_angle_left_rad: Option<f64> =
            rocking.contacts[1].map(|contact| contact.angle_rad) => "touches the left wall at";
        wall_angle_right_rad: Option<f64> =
            rocking.contacts[0].map(|contact| contact.angle_rad) => "touches the right wall at";
        wall_impact_count: usize = rocking.wall_impacts.len() => "impacts on walls" if wall_speed_max_m_s;
        /// All impacts on walls.
        wall_impacts: Vec<WallStrike> = strikes(rocking, block, stiffness);
        wall_speed_max_m_s: Option<f64> =
            speed_m_s(block, rocking.contacts, rocking.sides) => "  largest speed";
        wall_acceleration_g: Option<f64> =
            acceleration_g(block, rocking.contacts, rocking.sides, stiffness) => "  shock at the point of contact";
        wall_impulse_max_n_s: Option<f64> =
            stiffness.mass_kg.and_then(|mass_kg| impulse_n_s(rocking, block, mass_kg)) => "  largest impulse";
        /// Whether it leans on a wall at the end.
        leaning: bool;
    }

    /// An impact on a wall.
    pub struct WallStrike of (impact: &WallImpact, shock: Option<&WallShock>, stiffness: WallStiffness) {
        /// When it happened.
        time_s: f64;
        /// `left` or `right`.
        side: &'static str = impact.side.name();
        /// Angular velocity before the impact, signed.
        omega_before_rad_s: f64;
        /// Angular velocity after the impact.
        omega_after_rad_s: f64;
        /// Speed of the point of contact.
        speed_m_s: Option<f64> = shock.map(|shock| shock.speed_m_s(impact.omega_before_rad_s));
        /// Shock at the point of contact, with the mass of the object and the stiffness of the wall.
        acceleration_g: Option<f64> =
            shock.and_then(|shock| stiffness.acceleration_g(shock, impact.omega_before_rad_s));
    }
}

/// The impacts on the walls, in their order.
fn strikes(rocking: &Rocking, block: &Block, stiffness: WallStiffness) -> Vec<WallStrike> {
    let shocks = WallShock::of_sides(block, rocking.contacts);
    let strike = |impact: &WallImpact| {
        WallStrike::of(impact, shocks[impact.side.index()].as_ref(), stiffness)
    };
    rocking.wall_impacts.iter().map(strike).collect()
}

/// The largest impulse of a wall on an object of this mass \[N s\].
fn impulse_n_s(rocking: &Rocking, block: &Block, mass_kg: f64) -> Option<f64> {
    let of = |shock: &WallShock, omega: f64| shock.impulse_n_s(omega, mass_kg);
    largest(
        WallShock::of_sides(block, rocking.contacts),
        rocking.sides,
        of,
    )
}

/// Walls that hold nothing: beyond the reach of the object, or past its balance point.
pub(crate) fn doubts(
    block: &Block,
    walls: &Walls,
    contacts: [Option<Contact>; 2],
) -> Vec<HistoryDoubt> {
    let [right, left] = contacts;
    let (on_left, on_right) = (block.pivot(), block.right_pivot());
    let doubt = |side, wall: Option<Wall>, contact: Option<Contact>, pivot: Pivot| {
        let gap_m = wall?.gap_m;
        let Some(Contact { angle_rad, .. }) = contact else {
            return Some(HistoryDoubt::WallOutOfReach {
                side,
                gap_m,
                height_m: block.height_m(),
            });
        };
        let balance_rad = pivot.slenderness_angle_rad;
        (angle_rad >= balance_rad).then_some(HistoryDoubt::WallPastBalance {
            side,
            angle_rad,
            balance_rad,
        })
    };
    [
        doubt("left", walls.left, left, on_left),
        doubt("right", walls.right, right, on_right),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The largest speed of an impact on a wall; `None` without one.
pub(crate) fn speed_m_s(
    block: &Block,
    contacts: [Option<Contact>; 2],
    sides: [SideExtremes; 2],
) -> Option<f64> {
    largest(
        WallShock::of_sides(block, contacts),
        sides,
        WallShock::speed_m_s,
    )
}

/// The largest shock of an impact on a wall \[g\]; `None` without one, or without mass and
/// stiffness.
pub(crate) fn acceleration_g(
    block: &Block,
    contacts: [Option<Contact>; 2],
    sides: [SideExtremes; 2],
    stiffness: WallStiffness,
) -> Option<f64> {
    let (mass_kg, stiffness_n_m) = stiffness.mass_kg.zip(stiffness.stiffness_n_m)?;
    let of = |shock: &WallShock, omega: f64| {
        shock.acceleration_m_s2(omega, mass_kg, stiffness_n_m) / G0_M_S2
    };
    largest(WallShock::of_sides(block, contacts), sides, of)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gap of the height or more is out of reach; a low obstacle is met past the balance point.
    #[test]
    fn walls_that_hold_nothing_are_said() {
        let block = Block::uniform(2.0, 0.4).unwrap();
        let doubts = |left_gap_m, height_m| {
            let walls = GivenWalls {
                left_gap_m: Some(left_gap_m),
                height_m,
                ..GivenWalls::default()
            };
            let walls = walls.walls(&block).unwrap();
            doubts(&block, &walls, walls.contacts(&block).unwrap())
        };
        let out_of_reach = |gap_m| {
            vec![HistoryDoubt::WallOutOfReach {
                side: "left",
                gap_m,
                height_m: 2.0,
            }]
        };
        assert_eq!(doubts(12.0, None), out_of_reach(12.0));
        assert_eq!(doubts(2.0, None), out_of_reach(2.0));
        // asin(0.5/2) = 0.253 > atan(0.4/2) = 0.197; atan(0.01/0.005) = 1.107.
        for (gap_m, height_m, expected_rad) in [(0.5, None, 0.2527), (0.01, Some(0.005), 1.1071)] {
            let [
                HistoryDoubt::WallPastBalance {
                    side: "left",
                    angle_rad,
                    balance_rad,
                },
            ] = doubts(gap_m, height_m)[..]
            else {
                panic!("{:?}", doubts(gap_m, height_m))
            };
            assert!((angle_rad - expected_rad).abs() < 1e-4, "{angle_rad}");
            assert!((balance_rad - 0.1974).abs() < 1e-4, "{balance_rad}");
        }
        assert_eq!(
            (doubts(0.3, None), doubts(0.0, None)),
            (Vec::new(), Vec::new())
        );
    }
}
