//! Flags that describe the object and its motion, shared by `rock`, `spectrum` and `shock`.

use clap::Args;
use freestand::block::Block;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_study::shape::Shape;

use crate::values::{Given, Reads, Values};

/// Flags that describe a general block.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "The general block")]
pub(crate) struct ShapeArgs {
    /// Distance between the two edges, if the feet are set in [default: the thickness]
    #[arg(long, positive = Dimension::Length)]
    base_width: Option<Given>,
    /// Height of the centre of gravity [default: half of the height]
    #[arg(long, positive = Dimension::Length)]
    cg_height: Option<Given>,
    /// Horizontal offset of the centre of gravity, positive to the right (in `shock`: towards the
    /// landing edge) [default: 0]
    #[arg(long, any = Dimension::Length)]
    cg_offset: Option<Given>,
    /// Moment of inertia about the left edge, such as "120 kg m2"; needs --mass [default: uniform]
    #[arg(long, positive = Dimension::Inertia, requires = "mass")]
    inertia: Option<Given>,
}

impl ShapeArgs {
    /// The first of these flags that is given.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let flags = [
            ("--base-width", self.base_width.is_some()),
            ("--cg-height", self.cg_height.is_some()),
            ("--cg-offset", self.cg_offset.is_some()),
            ("--inertia", self.inertia.is_some()),
        ];
        flags
            .into_iter()
            .find_map(|(name, given)| given.then_some(name))
    }

    /// The block; problems are added to `values`.
    pub(crate) fn block(
        &self,
        (height_m, thickness_m): (f64, f64),
        mass_kg: Option<f64>,
        values: &mut Values,
    ) -> Option<Block> {
        let inertia = values.read(&self.inertia);
        let shape = Shape {
            base_width_m: values.read(&self.base_width),
            cg_height_m: values.read(&self.cg_height),
            cg_offset_m: values.read(&self.cg_offset),
            inertia_kg_m2: inertia.zip(mass_kg),
        };
        let block = shape.block(height_m, thickness_m);
        values.take(block.map_err(|error| {
            Problem::value(error.to_string(), "check the dimensions of the object")
        }))
    }
}
