//! The general block, from what is known of an object.

use freestand::block::{Block, BlockError};

/// What is known of an object beside its height and thickness; `None`: as in a uniform block.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shape {
    /// Distance between the pivot edges, where the feet are set in \[m\].
    pub base_width_m: Option<f64>,
    /// Height of the centre of gravity \[m\].
    pub cg_height_m: Option<f64>,
    /// Horizontal offset of the centre of gravity, positive to the right \[m\].
    pub cg_offset_m: Option<f64>,
    /// Moment of inertia about the left pivot edge, and the mass that it belongs to \[kg m², kg\].
    pub inertia_kg_m2: Option<(f64, f64)>,
}

impl Shape {
    /// The block.
    ///
    /// # Errors
    /// Sizes that no object has: see [`Block`].
    pub fn block(&self, height_m: f64, thickness_m: f64) -> Result<Block, BlockError> {
        let mut block = Block::uniform(height_m, thickness_m)?;
        if let Some(base_width_m) = self.base_width_m {
            block = block.with_base_width(base_width_m)?;
        }
        if let Some(cg_height_m) = self.cg_height_m {
            block = block.with_cg_height(cg_height_m)?;
        }
        if let Some(cg_offset_m) = self.cg_offset_m {
            block = block.with_cg_offset(cg_offset_m)?;
        }
        // Last: the distance from the edge to the centre of gravity is part of it.
        match self.inertia_kg_m2 {
            Some((inertia_kg_m2, mass_kg)) => block.with_inertia_per_mass(inertia_kg_m2 / mass_kg),
            None => Ok(block),
        }
    }
}
