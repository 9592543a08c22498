//! Flags that describe the object and its motion, shared by `rock`, `spectrum` and `shock`.

use clap::Args;
use freestand::block::Block;
use freestand::rocking::{Accuracy, Restitution, RockingModel};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse};
use freestand_study::rock::MODELS;
use freestand_study::shape::Shape;

use crate::failure::problem;
use crate::values::{Choices, Given, Reads, Values, choice, name_of};

/// How the rocking is computed.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "The rocking")]
pub(crate) struct RockingArgs {
    /// Ratio of the angular velocities after and before an impact, in (0, 1] [default: Housner's]
    #[arg(long, value_name = "RATIO", read = restitution, conflicts_with = "restitution_factor")]
    restitution: Option<Given>,
    /// Factor on Housner's ratio
    #[arg(long, positive = Dimension::Ratio)]
    restitution_factor: Option<Given>,
    /// Equation of motion
    #[arg(long, value_parser = choice(MODELS), default_value = name_of(MODELS, RockingModel::default()))]
    pub(crate) model: RockingModel,
    /// Accuracy of the solver
    #[arg(long, value_parser = choice(ACCURACIES), default_value = name_of(ACCURACIES, Accuracy::default()))]
    pub(crate) accuracy: Accuracy,
}

const ACCURACIES: Choices<Accuracy> = &[
    (Accuracy::Fast, "fast", "1e-9 a step; in spectra rotations to 1e-7 or so"),
    (Accuracy::Standard, "standard", "1e-13 a step; in spectra rotations to 1e-9 or better"),
    (Accuracy::Tight, "tight", "As far as double precision goes; in spectra nearly so"),
];

impl RockingArgs {
    /// The first flag given that only a rigid base has a use for.
    pub(crate) fn of_rigid_base(&self) -> Option<&'static str> {
        let flags = [
            ("--restitution", self.restitution.is_some()),
            ("--restitution-factor", self.restitution_factor.is_some()),
            ("--model linear", self.model == RockingModel::Linearised),
        ];
        flags.into_iter().find_map(|(name, given)| given.then_some(name))
    }

    /// The restitution; what is wrong with it goes into `values`.
    pub(crate) fn restitution(&self, values: &mut Values) -> Restitution {
        let factor = values.read(&self.restitution_factor).map_or(Restitution::Housner, Restitution::Factor);
        values.read(&self.restitution).map_or(factor, Restitution::Value)
    }
}

fn restitution(text: &str) -> Result<f64, Problem> {
    match parse(text, Dimension::Ratio)? {
        value if value > 0.0 && value <= 1.0 => Ok(value),
        value => Err(problem(
            format!("must lie in (0, 1], not {value}"),
            "1 loses no energy in an impact; leave it out for Housner's ratio of the object",
        )),
    }
}

/// The general block.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "The general block")]
pub(crate) struct ShapeArgs {
    /// Distance between the pivot edges, where the feet are set in
    #[arg(long, positive = Dimension::Length)]
    base_width: Option<Given>,
    /// Height of the centre of gravity, where it is not in the middle
    #[arg(long, positive = Dimension::Length)]
    cg_height: Option<Given>,
    /// Horizontal offset of the centre of gravity, positive to the right (in `shock`: towards the landing edge)
    #[arg(long, any = Dimension::Length)]
    cg_offset: Option<Given>,
    /// Moment of inertia about the left pivot edge, such as "120 kg m2"; needs --mass
    #[arg(long, positive = Dimension::Inertia, requires = "mass")]
    inertia: Option<Given>,
}

impl ShapeArgs {
    /// The block; what is wrong goes into `values`.
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
        values.take(block.map_err(|error| problem(error.to_string(), "check the sizes of the object")))
    }
}
