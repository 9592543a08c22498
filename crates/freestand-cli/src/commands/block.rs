//! Flags that describe the object and its motion, shared by `rock`, `spectrum` and `shock`.

use clap::Args;
use freestand::block::Block;
use freestand::rocking::{Accuracy, Restitution, RockingModel};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_study::restitution::checked;
use freestand_study::rock::{ACCURACIES, MODELS};
use freestand_study::shape::Shape;

use crate::values::{Given, Reads, Values, choice, name_of};

/// Flags for the calculation of the rocking.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "The rocking")]
pub(crate) struct RockingArgs {
    /// Restitution: angular velocity after an impact divided by the one before, in (0, 1]
    /// [default: Housner's]
    #[arg(long, any = Dimension::Ratio, conflicts_with = "restitution_factor")]
    restitution: Option<Given>,
    /// Factor that multiplies Housner's restitution
    #[arg(long, positive = Dimension::Ratio)]
    restitution_factor: Option<Given>,
    /// Equation of motion
    #[arg(long, value_parser = choice(MODELS), default_value = name_of(MODELS, RockingModel::default()))]
    pub(crate) model: RockingModel,
    /// Accuracy of the solver
    #[arg(long, value_parser = choice(ACCURACIES), default_value = name_of(ACCURACIES, Accuracy::default()))]
    pub(crate) accuracy: Accuracy,
}

impl RockingArgs {
    /// The first of the given flags that applies only to a rigid base.
    pub(crate) fn of_rigid_base(&self) -> Option<&'static str> {
        let flags = [
            ("--restitution", self.restitution.is_some()),
            ("--restitution-factor", self.restitution_factor.is_some()),
            ("--model linear", self.model == RockingModel::Linearised),
        ];
        flags
            .into_iter()
            .find_map(|(name, given)| given.then_some(name))
    }

    /// The restitution of these blocks; problems are added to `values`.
    pub(crate) fn restitution(&self, blocks: &[Block], values: &mut Values) -> Restitution {
        let factor = values
            .read(&self.restitution_factor)
            .map_or(Restitution::Housner, Restitution::Factor);
        let restitution = values
            .read(&self.restitution)
            .map_or(factor, Restitution::Value);
        values
            .take(checked(restitution, blocks))
            .unwrap_or_default()
    }
}

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
