//! The general block, from what is known of an object.

use freestand::block::{Block, BlockError};
use freestand::impact::ValidityWarning;
use freestand_input::quantity::{Dimension, format_si};

/// What is known of an object in addition to its height and thickness; `None`: as in a uniform
/// block.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shape {
    /// Distance between the pivot edges, if the feet are inset \[m\].
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
    /// Sizes that no object can have: see [`Block`].
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
        // Set last, because it depends on the distance from the edge to the centre of gravity.
        match self.inertia_kg_m2 {
            Some((inertia_kg_m2, mass_kg)) => block.with_inertia_per_mass(inertia_kg_m2 / mass_kg),
            None => Ok(block),
        }
    }
}

/// How many of `objects` blocks are squat, and the first of them; `None` if there is none.
pub(crate) fn squat_warning(objects: usize, blocks: impl Iterator<Item = Block>) -> Option<String> {
    let mut squat = blocks.filter(|block| block.landing_ratio() < 0.0);
    let first = squat.next()?;
    let count = 1 + squat.count();
    let size = |length_m| format_si(length_m, Dimension::Length);
    let are = if count == 1 { "is" } else { "are" };
    Some(format!(
        "{count} of {objects} objects {are} squat, the first {} high and {} thick: {}",
        size(first.height_m()),
        size(first.thickness_m()),
        ValidityWarning::Squat { landing_ratio: first.landing_ratio() }
    ))
}
