//! The free-standing object as a rigid block on two edges.

use thiserror::Error;

/// Slenderness h/t below which a uniform block cannot rock through an impact: Housner's r = 1 − 1.5
/// sin²α is negative for h/t < 1/√2.
pub const SQUAT_SLENDERNESS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A rigid object seen in the plane of its motion. All lengths are in metres.
///
/// By default it is a uniform rectangle. The general block has edges set in from its sides, a
/// centre of gravity off the middle, or a measured inertia. Nothing here depends on the mass: the
/// inertia is stored as a gyration radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    height_m: f64,
    thickness_m: f64,
    base_width_m: f64,
    cg_height_m: f64,
    cg_offset_m: f64,
    gyration_radius_m: f64,
}

/// One pivot edge and the geometry of the block about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pivot {
    /// R: distance from the pivot edge to the centre of gravity \[m\].
    pub half_diagonal_m: f64,
    /// α: angle between R and the vertical at rest \[rad\]; at θ = α the block balances on the
    /// edge.
    pub slenderness_angle_rad: f64,
    /// I/m about this edge \[m²\]: (4/3)R² for a uniform block.
    pub inertia_per_mass_m2: f64,
}

impl Pivot {
    /// p = √(m g R / I) \[rad/s\]: √(3g/4R) for a uniform block (Housner 1963).
    pub fn frequency_parameter_rad_s(&self, gravity_m_s2: f64) -> f64 {
        (gravity_m_s2 * self.half_diagonal_m / self.inertia_per_mass_m2).sqrt()
    }

    /// Rise of the centre of gravity at rotation |θ|: R\[cos(α−|θ|) − cos α\] \[m\].
    ///
    /// Written as a product of sines, which loses no digits at small rotations.
    pub fn cg_rise_m(&self, rotation_rad: f64) -> f64 {
        let theta = rotation_rad.abs();
        2.0 * self.half_diagonal_m
            * (self.slenderness_angle_rad - 0.5 * theta).sin()
            * (0.5 * theta).sin()
    }

    /// The largest rise on the way to a peak rotation: R(1 − cos α) once |θ| has passed α \[m\].
    pub fn largest_rise_m(&self, peak_rotation_rad: f64) -> f64 {
        self.cg_rise_m(peak_rotation_rad.abs().min(self.slenderness_angle_rad))
    }

    /// The largest rise that a block can reach without overturning: R(1 − cos α) at θ = α \[m\].
    pub fn balance_rise_m(&self) -> f64 {
        self.cg_rise_m(self.slenderness_angle_rad)
    }

    /// Rotation at which the centre of gravity has risen by `cg_rise_m` \[rad\]: the inverse of
    /// [`Pivot::cg_rise_m`] up to the balance point, `None` beyond it.
    pub fn rotation_at_rise_rad(&self, cg_rise_m: f64) -> Option<f64> {
        let tilt = (self.slenderness_angle_rad.cos() + cg_rise_m / self.half_diagonal_m).min(1.0);
        let balance = self.balance_rise_m();
        if !(0.0..=balance).contains(&cg_rise_m) {
            return None;
        }
        let mut theta = self.slenderness_angle_rad - tilt.acos();
        // acos loses half of the digits near the rest position; two Newton steps restore them.
        for _ in 0..2 {
            let slope = self.half_diagonal_m * (self.slenderness_angle_rad - theta).sin();
            if slope > 1e-6 * self.half_diagonal_m {
                theta -= (self.cg_rise_m(theta) - cg_rise_m) / slope;
            }
        }
        Some(theta.clamp(0.0, self.slenderness_angle_rad))
    }
}

/// Why dimensions do not define a [`Block`].
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BlockError {
    /// A length that is not positive and finite.
    #[error("the {name} must be positive and finite, not {value_m} m")]
    Length {
        /// Name of the length.
        name: &'static str,
        /// The length that was given \[m\].
        value_m: f64,
    },
    /// A base wider than the object, or a centre of gravity above the object or outside its base.
    #[error(
        "the {name} is {value_m} m, beyond the limit of {limit_m} m set by the size of the object"
    )]
    OutOfObject {
        /// Name of the length.
        name: &'static str,
        /// The length that was given \[m\].
        value_m: f64,
        /// The limit that it exceeds \[m\].
        limit_m: f64,
    },
    /// An inertia about the edge that is smaller than if all the mass were at the centre of
    /// gravity.
    #[error(
        "the inertia about the pivot edge is {given} m² per unit mass; with this centre of gravity it must be more \
         than {least} m²"
    )]
    Inertia {
        /// I/m that was given \[m²\].
        given: f64,
        /// R², which I/m must exceed \[m²\].
        least: f64,
    },
}

fn length(name: &'static str, value_m: f64) -> Result<f64, BlockError> {
    if value_m > 0.0 && value_m.is_finite() {
        Ok(value_m)
    } else {
        Err(BlockError::Length { name, value_m })
    }
}

impl Block {
    /// A uniform rectangular block of height h and thickness t (its width in the plane of motion).
    ///
    /// # Errors
    /// A dimension that is not positive and finite.
    ///
    /// # Example
    /// The cabinet of Al Abadi et al., 2.3 m × 0.6 m:
    /// ```
    /// let cabinet = freestand_rocking::block::Block::uniform(2.3, 0.6)?;
    /// let edge = cabinet.pivot();
    /// assert!((edge.half_diagonal_m - 1.188486).abs() < 1e-6);
    /// assert!((edge.balance_rise_m() - 0.03849).abs() < 1e-5); // 38.5 mm
    /// # Ok::<(), freestand_rocking::block::BlockError>(())
    /// ```
    pub fn uniform(height_m: f64, thickness_m: f64) -> Result<Self, BlockError> {
        let (h, t) = (
            length("height", height_m)?,
            length("thickness", thickness_m)?,
        );
        Ok(Self {
            height_m: h,
            thickness_m: t,
            base_width_m: t,
            cg_height_m: 0.5 * h,
            cg_offset_m: 0.0,
            gyration_radius_m: h.hypot(t) / 12f64.sqrt(),
        })
    }

    /// The block on edges `base_width_m` apart: its base is narrower than the object.
    ///
    /// # Errors
    /// A width that is not positive, or larger than the thickness of the object.
    pub fn with_base_width(self, base_width_m: f64) -> Result<Self, BlockError> {
        if base_width_m > self.thickness_m && base_width_m.is_finite() {
            return Err(BlockError::OutOfObject {
                name: "base width",
                value_m: base_width_m,
                limit_m: self.thickness_m,
            });
        }
        self.with_outriggers(base_width_m)
    }

    /// The block on feet that reach beyond it on both sides, such as outriggers or a base plate, with
    /// their edges `base_width_m` apart. The feet are rigid and have no mass: the inertia about the
    /// centre of gravity does not change.
    ///
    /// # Limitation
    /// Only the edges of the feet are modelled: make sure that a wall beside the object leaves the
    /// feet room.
    ///
    /// # Errors
    /// A width that is not positive.
    ///
    /// # Example
    /// Outriggers that double the base double the floor acceleration that lifts an edge, tan α:
    /// ```
    /// let rack = freestand_rocking::block::Block::uniform(2.0, 0.5)?;
    /// let wide = rack.with_outriggers(1.0)?;
    /// assert!((rack.pivot().slenderness_angle_rad.tan() - 0.25).abs() < 1e-15);
    /// assert!((wide.pivot().slenderness_angle_rad.tan() - 0.5).abs() < 1e-15);
    /// # Ok::<(), freestand_rocking::block::BlockError>(())
    /// ```
    pub fn with_outriggers(mut self, base_width_m: f64) -> Result<Self, BlockError> {
        self.base_width_m = length("base width", base_width_m)?;
        self.check_offset()
    }

    /// The block with its centre of gravity `cg_height_m` above the base. The inertia about the
    /// centre of gravity does not change.
    ///
    /// # Errors
    /// A height that is not positive, or above the top.
    pub fn with_cg_height(mut self, cg_height_m: f64) -> Result<Self, BlockError> {
        self.cg_height_m = length("height of the centre of gravity", cg_height_m)?;
        if cg_height_m > self.height_m {
            return Err(BlockError::OutOfObject {
                name: "height of the centre of gravity",
                value_m: cg_height_m,
                limit_m: self.height_m,
            });
        }
        Ok(self)
    }

    /// The block with its centre of gravity off the middle of the base, positive towards the right
    /// edge.
    ///
    /// # Errors
    /// A centre of gravity at or outside an edge.
    pub fn with_cg_offset(mut self, cg_offset_m: f64) -> Result<Self, BlockError> {
        self.cg_offset_m = cg_offset_m;
        self.check_offset()
    }

    fn check_offset(self) -> Result<Self, BlockError> {
        let limit_m = 0.5 * self.base_width_m;
        if self.cg_offset_m.abs() < limit_m {
            Ok(self)
        } else {
            Err(BlockError::OutOfObject {
                name: "offset of the centre of gravity",
                value_m: self.cg_offset_m,
                limit_m,
            })
        }
    }

    /// The block with a measured inertia: `inertia_per_mass_m2` = I₀/m about the left edge, which
    /// is the pivot when the object rotates to the left (without an offset both edges are alike).
    ///
    /// # Errors
    /// A value of R² or less, which no rigid object can have.
    pub fn with_inertia_per_mass(mut self, inertia_per_mass_m2: f64) -> Result<Self, BlockError> {
        let least = self.pivot().half_diagonal_m.powi(2);
        if !(inertia_per_mass_m2 > least && inertia_per_mass_m2.is_finite()) {
            return Err(BlockError::Inertia {
                given: inertia_per_mass_m2,
                least,
            });
        }
        self.gyration_radius_m = (inertia_per_mass_m2 - least).sqrt();
        Ok(self)
    }

    /// The block as its mirror image: left and right exchanged.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self {
            cg_offset_m: -self.cg_offset_m,
            ..self
        }
    }

    /// h \[m\].
    pub fn height_m(&self) -> f64 {
        self.height_m
    }

    /// t: width of the object in the plane of motion \[m\].
    pub fn thickness_m(&self) -> f64 {
        self.thickness_m
    }

    /// B: distance between the pivot edges \[m\]; equal to t unless the base is narrower or has
    /// outriggers.
    pub fn base_width_m(&self) -> f64 {
        self.base_width_m
    }

    /// Height of the centre of gravity above the base \[m\].
    pub fn cg_height_m(&self) -> f64 {
        self.cg_height_m
    }

    /// Gyration radius about the centre of gravity, √(I_cg/m) \[m\].
    pub fn gyration_radius_m(&self) -> f64 {
        self.gyration_radius_m
    }

    /// Horizontal distance from the left edge to the centre of gravity \[m\].
    pub fn cg_from_left_m(&self) -> f64 {
        0.5 * self.base_width_m + self.cg_offset_m
    }

    /// Horizontal distance from the right edge to the centre of gravity \[m\].
    pub fn cg_from_right_m(&self) -> f64 {
        0.5 * self.base_width_m - self.cg_offset_m
    }

    /// The block as seen from its left edge, which also serves where only one edge is considered.
    pub fn pivot(&self) -> Pivot {
        self.pivot_at(self.cg_from_left_m())
    }

    /// The block as seen from its right edge, the pivot of positive rotations.
    pub fn right_pivot(&self) -> Pivot {
        self.pivot_at(self.cg_from_right_m())
    }

    fn pivot_at(&self, cg_from_edge_m: f64) -> Pivot {
        let half_diagonal_m = cg_from_edge_m.hypot(self.cg_height_m);
        Pivot {
            half_diagonal_m,
            slenderness_angle_rad: cg_from_edge_m.atan2(self.cg_height_m),
            inertia_per_mass_m2: self.inertia_per_mass_m2(half_diagonal_m),
        }
    }

    /// I₀/m about a pivot at this distance from the centre of gravity \[m²\].
    fn inertia_per_mass_m2(&self, half_diagonal_m: f64) -> f64 {
        self.gyration_radius_m.powi(2) + half_diagonal_m.powi(2)
    }

    /// R_D = θ̇₂/θ̇₁, Eq. (6): the share of the angular velocity that remains when the pivot
    /// changes from the left edge to the right one without slip or bounce. Negative for squat
    /// blocks, which cannot rock through.
    ///
    /// Angular momentum about the landing edge: R_D = (k² + z² − x₁x₂)/(k² + z² + x₂²) with the
    /// gyration radius k, the centre of gravity at height z and at distances x₁, x₂ from the two
    /// edges; 1 − ⅜(d/R)² = 1 − (3/2)sin²α for a uniform block. For a landing on the left edge, use
    /// the ratio of [`Block::mirrored`].
    ///
    /// # Reference
    /// Housner (1963); Al Abadi et al., Eq. (6).
    pub fn landing_ratio(&self) -> f64 {
        let half_diagonal_m = self.cg_from_right_m().hypot(self.cg_height_m);
        1.0 - self.cg_from_right_m() * self.base_width_m / self.inertia_per_mass_m2(half_diagonal_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed forms of the uniform rectangle; 1e-14 is a few roundings of numbers of order 1.
    #[test]
    fn uniform_block_has_the_textbook_constants() {
        let block = Block::uniform(2.3, 0.6).unwrap();
        let edge = block.pivot();
        let r = 0.5 * (2.3f64 * 2.3 + 0.6 * 0.6).sqrt();
        assert!((edge.half_diagonal_m - r).abs() < 1e-14);
        assert!((edge.inertia_per_mass_m2 - 4.0 / 3.0 * r * r).abs() < 1e-14);
        assert!((edge.frequency_parameter_rad_s(9.81) - (0.75 * 9.81 / r).sqrt()).abs() < 1e-14);
        assert!(
            (block.landing_ratio() - (1.0 - 1.5 * edge.slenderness_angle_rad.sin().powi(2))).abs()
                < 1e-14
        );
        assert_eq!(block.pivot(), block.right_pivot());
    }

    #[test]
    fn landing_ratio_changes_sign_at_the_squat_slenderness() {
        assert!(
            Block::uniform(SQUAT_SLENDERNESS * 1.000001, 1.0)
                .unwrap()
                .landing_ratio()
                > 0.0
        );
        assert!(
            Block::uniform(SQUAT_SLENDERNESS * 0.999999, 1.0)
                .unwrap()
                .landing_ratio()
                < 0.0
        );
    }

    /// General block, r = 1 − 2mR² sin²α/I₀: narrow base, high centre of gravity, doubled central
    /// inertia.
    /// I₀/m = (h² + t²)/12 + (B/2)² + (h/2)², and Housner's ratio with the arms of the wider base.
    #[test]
    fn outriggers_move_the_edges_and_nothing_else() {
        let wide = Block::uniform(2.0, 0.5)
            .unwrap()
            .with_outriggers(1.0)
            .unwrap();
        let inertia = (4.0 + 0.25) / 12.0 + 0.25 + 1.0;
        let pivot = wide.pivot();
        assert!(
            (pivot.inertia_per_mass_m2 - inertia).abs() < 1e-15,
            "{pivot:?}"
        );
        assert!((pivot.half_diagonal_m - 1.25_f64.sqrt()).abs() < 1e-15);
        assert!((wide.landing_ratio() - (1.0 - 0.5 / inertia)).abs() < 1e-15);
        assert_eq!((wide.thickness_m(), wide.base_width_m()), (0.5, 1.0));
    }

    #[test]
    fn general_block_without_offset_follows_the_general_formula() {
        let block = Block::uniform(2.0, 0.8)
            .unwrap()
            .with_base_width(0.6)
            .unwrap()
            .with_cg_height(1.2)
            .unwrap();
        let least = block.pivot().half_diagonal_m.powi(2);
        let block = block.with_inertia_per_mass(1.5 * least).unwrap();
        let edge = block.pivot();
        assert!((edge.slenderness_angle_rad.tan() - 0.25).abs() < 1e-14);
        let r = 1.0 - 2.0 * edge.slenderness_angle_rad.sin().powi(2) / 1.5;
        assert!((block.landing_ratio() - r).abs() < 1e-14);
    }

    #[test]
    fn an_offset_makes_the_two_edges_differ_and_mirrors() {
        let right = Block::uniform(2.0, 0.8)
            .unwrap()
            .with_cg_offset(0.1)
            .unwrap();
        let left = Block::uniform(2.0, 0.8)
            .unwrap()
            .with_cg_offset(-0.1)
            .unwrap();
        assert!(right.pivot().slenderness_angle_rad > right.right_pivot().slenderness_angle_rad);
        assert_eq!(right.pivot(), left.right_pivot());
        assert_eq!(right.mirrored(), left);
    }

    /// Inverts the rise up to the balance point; near it a rise of ε changes θ by √ε, hence the
    /// looser bound there.
    #[test]
    fn rotation_at_rise_inverts_the_rise() {
        let edge = Block::uniform(2.3, 0.6).unwrap().pivot();
        for share in [0.0, 1e-9, 1e-4, 0.1, 0.5, 0.9, 0.99] {
            let theta = share * edge.slenderness_angle_rad;
            let back = edge.rotation_at_rise_rad(edge.cg_rise_m(theta)).unwrap();
            assert!(
                (back - theta).abs() <= 1e-13 + 1e-12 * theta,
                "{share}: {back} {theta}"
            );
        }
        let at_balance = edge.rotation_at_rise_rad(edge.balance_rise_m()).unwrap();
        assert!((at_balance - edge.slenderness_angle_rad).abs() < 1e-7);
        assert_eq!(
            edge.rotation_at_rise_rad(1.001 * edge.balance_rise_m()),
            None
        );
        assert_eq!(edge.rotation_at_rise_rad(-1e-9), None);
    }

    #[test]
    fn impossible_dimensions_are_refused() {
        for (h, t) in [
            (0.0, 1.0),
            (1.0, -1.0),
            (f64::NAN, 1.0),
            (1.0, f64::INFINITY),
        ] {
            assert!(matches!(
                Block::uniform(h, t),
                Err(BlockError::Length { .. })
            ));
        }
        let block = Block::uniform(2.0, 1.0).unwrap();
        assert!(block.with_base_width(1.1).is_err());
        assert!(
            block.with_base_width(f64::INFINITY).is_err() && block.with_outriggers(-1.0).is_err()
        );
        assert!(block.with_cg_height(2.1).is_err());
        assert!(block.with_cg_offset(0.5).is_err());
        assert!(block.with_cg_offset(f64::NAN).is_err());
        assert!(block.with_inertia_per_mass(1.0).is_err());
    }
}
