//! The general block, from what is known of an object.

use freestand::block::{Block, BlockError};
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::number;
use std::ops::RangeInclusive;

use crate::doubt::{SquatObjects, UnlikelySize};

/// Height of an object \[m\]: a paperweight to a tank of three storeys.
pub const HEIGHT_M: RangeInclusive<f64> = 0.05..=12.0;
/// Either side of an object \[m\].
pub const SIDE_M: RangeInclusive<f64> = 0.01..=6.0;
/// So many times outside of these, nobody means a size.
const IMPOSSIBLE: f64 = 10.0;

/// The outer sizes of one object \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// Its height.
    pub height_m: f64,
    /// Its side in the plane of rocking.
    pub thickness_m: f64,
    /// The other side, if it is known.
    pub width_m: Option<f64>,
}

impl Sizes {
    /// Of a block.
    pub fn of(block: &Block) -> Self {
        Self {
            height_m: block.height_m(),
            thickness_m: block.thickness_m(),
            width_m: None,
        }
    }

    /// Sizes outside of these ranges, each with its key.
    fn outside(self, times: f64) -> impl Iterator<Item = (&'static str, f64, RangeInclusive<f64>)> {
        let sizes = [
            ("height", Some(self.height_m), HEIGHT_M),
            ("thickness", Some(self.thickness_m), SIDE_M),
            ("width", self.width_m, SIDE_M),
        ];
        let given = sizes
            .into_iter()
            .filter_map(|(key, size_m, range)| Some((key, size_m?, range)));
        given.filter(move |(_, size_m, range)| {
            !(range.start() / times..=range.end() * times).contains(size_m)
        })
    }

    /// Sizes that hardly any object has. Models on a shaking table are so small.
    pub fn doubts(self) -> Vec<UnlikelySize> {
        let doubt = |(key, size_m, usual_m)| UnlikelySize {
            key,
            size_m,
            usual_m,
        };
        self.outside(1.0).map(doubt).collect()
    }

    /// As [`Sizes::doubts`], where the answer is about an object that exists.
    ///
    /// # Errors
    /// Sizes that no object has.
    pub fn check(self) -> Result<Vec<UnlikelySize>, Problems> {
        let refused = |(key, size_m, range): (&'static str, f64, RangeInclusive<f64>)| {
            let message = format!("`{key}`: no object has {} m", number(size_m, 4));
            let hint = format!(
                "check the unit: such a size is between {} and {} m",
                range.start(),
                range.end()
            );
            Problem::value(message, hint).of(&[key])
        };
        let problems: Problems = self.outside(IMPOSSIBLE).map(refused).collect();
        problems.finish(Some(self.doubts()))
    }
}

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

/// The size of an object in figures.
pub fn size_words(thickness_m: f64, height_m: f64) -> String {
    format!(
        "{} mm × {} m",
        number(1e3 * thickness_m, 4),
        number(height_m, 4)
    )
}

/// How many of `objects` blocks are squat, and the first of them; `None` if there is none.
pub(crate) fn squat(objects: usize, blocks: impl Iterator<Item = Block>) -> Option<SquatObjects> {
    let mut squat = blocks.filter(|block| block.landing_ratio() < 0.0);
    let first = squat.next()?;
    Some(SquatObjects {
        count: 1 + squat.count(),
        objects,
        height_m: first.height_m(),
        thickness_m: first.thickness_m(),
        landing_ratio: first.landing_ratio(),
    })
}

#[cfg(test)]
mod tests {
    use super::Sizes;

    #[test]
    fn sizes_are_believed_doubted_or_refused() {
        let told = |height_m, thickness_m, width_m| {
            let found = Sizes {
                height_m,
                thickness_m,
                width_m,
            }
            .check();
            found
                .map(|doubts| doubts.len())
                .map_err(|problems| problems.problems.len())
        };
        assert_eq!(told(2.0, 0.4, Some(0.9)), Ok(0));
        assert_eq!(told(15.0, 4.0, None), Ok(1));
        assert_eq!(told(0.04, 0.008, Some(7.0)), Ok(3));
        assert_eq!(told(1.8e6, 5e5, None), Err(2));
        assert_eq!(told(0.001, 0.0004, None), Err(2));
        assert_eq!(told(2.0, 0.4, Some(61.0)), Err(1));
    }
}
