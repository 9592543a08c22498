//! Walls and neighbours beside the object: where it touches them, and with which lever.

use thiserror::Error;

use crate::block::{Block, Pivot};

/// Restitution of a wall that nothing is known about: that of a frictionless elastic contact with
/// a slender block whose foot may lift, and so the most that a passive wall returns.
pub const DEFAULT_WALL_RESTITUTION_RATIO: f64 = 0.5;

/// What stands on both sides of an object. It moves with the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walls {
    /// On the left, where θ < 0.
    pub left: Option<Wall>,
    /// On the right, where θ > 0.
    pub right: Option<Wall>,
}

impl Walls {
    /// No walls: a free-standing object.
    pub const NONE: Self = Self {
        left: None,
        right: None,
    };

    /// Whether there is neither wall.
    pub fn is_none(&self) -> bool {
        self.left.is_none() && self.right.is_none()
    }

    /// Left and right exchanged.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self {
            left: self.right,
            right: self.left,
        }
    }

    /// Where `block` touches the right and the left wall; `None` on a side without a wall within
    /// reach.
    ///
    /// # Errors
    /// A gap, a height or a restitution outside its range.
    pub fn contacts(&self, block: &Block) -> Result<[Option<Contact>; 2], WallError> {
        // Without a wall no pivot is calculated: in a grid that would cost more than the walls.
        let right = self
            .right
            .map_or(Ok(None), |wall| wall.contact(block, block.right_pivot()))?;
        let left = self
            .left
            .map_or(Ok(None), |wall| wall.contact(block, block.pivot()))?;
        Ok([right, left])
    }
}

impl Default for Walls {
    fn default() -> Self {
        Self::NONE
    }
}

/// A wall, a neighbour or another obstacle beside an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Distance from the face of the object \[m\]; 0 where they touch.
    pub gap_m: f64,
    /// Height above the floor \[m\]; `None`: taller than the object.
    pub height_m: Option<f64>,
    /// e_w: |ω| after an impact on the wall divided by |ω| before it, in \[0, 1).
    pub restitution_ratio: f64,
}

/// The rotation at which an object touches a wall, and how the wall then pushes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// θ_c: |θ| at the contact \[rad\].
    pub angle_rad: f64,
    /// ℓ: lever of the force of the wall about the pivot edge \[m\]. The force is normal to the
    /// wall, or to the face of the object where that leans on an edge of the obstacle.
    pub lever_m: f64,
    /// z: lever of the same force about the centre of gravity \[m\], positive where the contact is
    /// above it.
    pub lever_about_cg_m: f64,
    /// Angle between the force and the horizontal \[rad\]: 0 on a wall, θ_c on the edge of a low
    /// obstacle, whose force also lifts the object.
    pub force_angle_rad: f64,
    /// e_w.
    pub restitution_ratio: f64,
}

/// Why a wall cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum WallError {
    /// A gap that is negative or not finite.
    #[error("the gap to a wall must be zero or positive and finite, not {gap_m} m")]
    Gap {
        /// The gap that was given \[m\].
        gap_m: f64,
    },
    /// A height that is not positive.
    #[error("the height of a wall must be positive, not {height_m} m")]
    Height {
        /// The height that was given \[m\].
        height_m: f64,
    },
    /// e_w outside \[0, 1).
    #[error("the restitution of a wall must be at least 0 and less than 1, not {value}")]
    Restitution {
        /// The value that was given.
        value: f64,
    },
}

impl Wall {
    /// A wall taller than the object, with [`DEFAULT_WALL_RESTITUTION_RATIO`].
    pub fn at(gap_m: f64) -> Self {
        Self {
            gap_m,
            height_m: None,
            restitution_ratio: DEFAULT_WALL_RESTITUTION_RATIO,
        }
    }

    /// Where a block that turns about `pivot` touches this wall; `None` out of reach.
    ///
    /// With the edges set in from the faces by o: a wall meets the top corner where
    /// h sin θ − o(1 − cos θ) = gap, at the lever h cos θ − o sin θ. An obstacle whose top H_w is
    /// below that corner meets the face where H_w sin θ = (gap + o) cos θ − o, at the lever
    /// H_w cos θ + (gap + o) sin θ. For o = 0: θ = asin(gap/h) and h cos θ; θ = atan(gap/H_w) and
    /// √(gap² + H_w²). Both equations are quadratic in tan(θ/2); the form that is used has no
    /// cancellation at small gaps.
    ///
    /// # Errors
    /// A gap, a height or a restitution outside its range.
    ///
    /// # Example
    /// ```
    /// use freestand_rocking::{block::Block, wall::Wall};
    /// let cabinet = Block::uniform(2.0, 0.5)?;
    /// let contact = Wall::at(0.05).contact(&cabinet, cabinet.pivot())?.ok_or("out of reach")?;
    /// assert!((contact.angle_rad - f64::asin(0.05 / 2.0)).abs() < 1e-16);
    /// assert!(Wall::at(2.0).contact(&cabinet, cabinet.pivot())?.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn contact(&self, block: &Block, pivot: Pivot) -> Result<Option<Contact>, WallError> {
        let Self {
            gap_m: gap,
            height_m,
            restitution_ratio,
        } = *self;
        if !(gap >= 0.0 && gap.is_finite()) {
            return Err(WallError::Gap { gap_m: gap });
        }
        if let Some(height_m) = height_m.filter(|&height| height.is_nan() || height <= 0.0) {
            return Err(WallError::Height { height_m });
        }
        if !(0.0..1.0).contains(&restitution_ratio) {
            return Err(WallError::Restitution {
                value: restitution_ratio,
            });
        }
        let h = block.height_m();
        let set_in = 0.5 * (block.thickness_m() - block.base_width_m());
        let across = gap * (2.0 * set_in + gap);
        let square = h * h - across;
        // The top corner is furthest out at tan θ = h/o, where the square root vanishes.
        if gap >= h || square <= 0.0 {
            return Ok(None);
        }
        let tall_rad = 2.0 * gap.atan2(h + square.sqrt());
        let (sin, cos) = tall_rad.sin_cos();
        let corner_m = h * cos - set_in * sin;
        let contact = match height_m.filter(|&height| height < corner_m) {
            Some(low) => {
                let angle_rad = 2.0 * gap.atan2(low + (low * low + across).sqrt());
                let (sin, cos) = angle_rad.sin_cos();
                // Measured along the face.
                let lever_m = low * cos + (gap + set_in) * sin;
                let lever_about_cg_m = lever_m - block.cg_height_m();
                Contact {
                    angle_rad,
                    lever_m,
                    lever_about_cg_m,
                    force_angle_rad: angle_rad,
                    restitution_ratio,
                }
            }
            None => {
                let cg_m = pivot.half_diagonal_m * (pivot.slenderness_angle_rad - tall_rad).cos();
                Contact {
                    angle_rad: tall_rad,
                    lever_m: corner_m,
                    lever_about_cg_m: corner_m - cg_m,
                    force_angle_rad: 0.0,
                    restitution_ratio,
                }
            }
        };
        Ok(Some(contact))
    }
}

impl Contact {
    /// Whether the object at rest touches the wall.
    pub fn touches(&self) -> bool {
        self.angle_rad == 0.0
    }

    /// m_c/m = 1/(1 + z²/k_g²): the mass that lands on the wall, divided by the mass of the object,
    /// where the force is frictionless and the foot may lift.
    pub fn effective_mass_ratio(&self, block: &Block) -> f64 {
        1.0 / (1.0 + (self.lever_about_cg_m / block.gyration_radius_m()).powi(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(wall: Wall, block: &Block) -> Contact {
        wall.contact(block, block.pivot()).unwrap().unwrap()
    }

    /// The two equations of the contact, each to a few roundings of lengths of order 1.
    #[test]
    fn the_corner_is_on_the_wall_and_the_edge_of_a_low_obstacle_on_the_face() {
        for base in [0.6, 0.5, 0.2] {
            let block = Block::uniform(1.8, 0.6)
                .unwrap()
                .with_base_width(base)
                .unwrap();
            let o = 0.5 * (0.6 - base);
            for gap in [1e-12, 1e-3, 0.05, 0.4, 1.2] {
                let tall = contact(Wall::at(gap), &block);
                let (sin, cos) = tall.angle_rad.sin_cos();
                assert!(
                    (1.8 * sin - o * (1.0 - cos) - gap).abs() < 1e-15,
                    "{base} {gap}: {tall:?}"
                );
                // The corner that tops out first is the one that is on its way up.
                assert!(
                    tall.angle_rad < f64::atan2(1.8, o)
                        && (tall.lever_m - (1.8 * cos - o * sin)).abs() < 1e-15
                );
                for height in [0.1, 0.7] {
                    let low = contact(
                        Wall {
                            height_m: Some(height),
                            ..Wall::at(gap)
                        },
                        &block,
                    );
                    let (sin, cos) = low.angle_rad.sin_cos();
                    assert!(
                        (height * sin - (gap + o) * cos + o).abs() < 1e-15,
                        "{base} {gap} {height}: {low:?}"
                    );
                    assert!(
                        low.angle_rad >= tall.angle_rad
                            && low.angle_rad < std::f64::consts::FRAC_PI_2
                    );
                }
            }
        }
    }

    /// asin(gap/h) and atan(gap/H_w) of a block with its edges at its faces; relative, also at gaps
    /// of a nanometre.
    #[test]
    fn edges_at_the_faces_give_the_closed_forms() {
        let block = Block::uniform(1.8, 0.6).unwrap();
        for gap in [1e-9, 1e-4, 0.3, 1.79] {
            let tall = contact(Wall::at(gap), &block);
            assert!(
                (tall.angle_rad / (gap / 1.8f64).asin() - 1.0).abs() < 1e-14,
                "{gap}"
            );
            let low = contact(
                Wall {
                    height_m: Some(0.02),
                    ..Wall::at(gap)
                },
                &block,
            );
            assert!(
                (low.angle_rad / (gap / 0.02f64).atan() - 1.0).abs() < 1e-14 || gap == 1.79,
                "{gap}"
            );
        }
    }

    /// A slender block has κ = m_c ℓ²/I₀ = ¾ at a wall that it all but touches: with t = h/1000 the
    /// terms in t²/h² are 1e-6.
    #[test]
    fn the_mass_of_a_slender_block_at_a_wall_is_a_quarter() {
        let block = Block::uniform(2.0, 0.002).unwrap();
        let at = contact(Wall::at(0.0), &block);
        assert!((at.effective_mass_ratio(&block) - 0.25).abs() < 1e-5);
        let share = at.effective_mass_ratio(&block) * at.lever_m.powi(2)
            / block.pivot().inertia_per_mass_m2;
        assert!((share - 0.75).abs() < 1e-5);
    }

    #[test]
    fn a_wall_out_of_reach_is_none_and_an_impossible_one_is_refused() {
        let block = Block::uniform(1.8, 0.6)
            .unwrap()
            .with_base_width(0.4)
            .unwrap();
        let pivot = block.pivot();
        // The corner goes no further out than √(h² + o²) − o.
        let reach = 1.8f64.hypot(0.1) - 0.1;
        assert!(
            Wall::at(reach * (1.0 - 1e-9))
                .contact(&block, pivot)
                .unwrap()
                .is_some()
        );
        assert_eq!(
            Wall::at(reach * (1.0 + 1e-9)).contact(&block, pivot),
            Ok(None)
        );
        assert_eq!(
            Wall {
                height_m: Some(0.1),
                ..Wall::at(1.8)
            }
            .contact(&block, pivot),
            Ok(None)
        );
        for gap_m in [-1e-9, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Wall::at(gap_m).contact(&block, pivot),
                Err(WallError::Gap { .. })
            ));
        }
        for value in [-0.1, 1.0, f64::NAN] {
            let wall = Wall {
                restitution_ratio: value,
                ..Wall::at(0.1)
            };
            assert!(matches!(
                wall.contact(&block, pivot),
                Err(WallError::Restitution { .. })
            ));
        }
        for height in [0.0, -1.0, f64::NAN] {
            let wall = Wall {
                height_m: Some(height),
                ..Wall::at(0.1)
            };
            assert!(matches!(
                wall.contact(&block, pivot),
                Err(WallError::Height { .. })
            ));
        }
    }
}
