//! Flags that describe the object and its motion, shared by `rock`, `spectrum` and `shock`.

use clap::{Args, ValueEnum};
use freestand::block::Block;
use freestand::rocking::{Accuracy, Restitution, RockingModel};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Dimension;
use freestand_study::shape::Shape;

use crate::values::Values;

/// How the rocking is computed.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "The rocking")]
pub(crate) struct RockingArgs {
    /// Ratio of the angular velocities after and before an impact, in (0, 1] [default: Housner's]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, conflicts_with = "restitution_factor")]
    restitution: Option<String>,
    /// Factor on Housner's ratio
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true)]
    restitution_factor: Option<String>,
    /// Equation of motion
    #[arg(long, value_enum, default_value_t)]
    model: ModelName,
    /// Accuracy of the solver
    #[arg(long, value_enum, default_value_t)]
    accuracy: AccuracyName,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum ModelName {
    /// The exact equation
    #[default]
    Rigid,
    /// sin x → x, tan α → α: for comparison with closed forms
    Linear,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum AccuracyName {
    /// 1e-9 a step; in spectra rotations to 1e-7 or so
    Fast,
    /// 1e-13 a step; in spectra rotations to 1e-9 or better
    #[default]
    Standard,
    /// As far as double precision goes; in spectra nearly so
    Tight,
}

impl RockingArgs {
    pub(crate) fn model(&self) -> RockingModel {
        match self.model {
            ModelName::Rigid => RockingModel::Rigid,
            ModelName::Linear => RockingModel::Linearised,
        }
    }

    pub(crate) fn accuracy(&self) -> Accuracy {
        match self.accuracy {
            AccuracyName::Fast => Accuracy::Fast,
            AccuracyName::Standard => Accuracy::Standard,
            AccuracyName::Tight => Accuracy::Tight,
        }
    }

    /// The first flag given that only a rigid base has a use for.
    pub(crate) fn of_rigid_base(&self) -> Option<&'static str> {
        let flags = [
            ("--restitution", self.restitution.is_some()),
            ("--restitution-factor", self.restitution_factor.is_some()),
            ("--model linear", matches!(self.model, ModelName::Linear)),
        ];
        flags.into_iter().find_map(|(name, given)| given.then_some(name))
    }

    /// The restitution; what is wrong with it goes into `values`.
    pub(crate) fn restitution(&self, values: &mut Values) -> Restitution {
        let refuse = |flag: &str, value: f64| {
            Problem::new(ProblemKind::Value, format!("{flag} must lie in (0, 1], not {value}"))
                .hint("1 loses no energy in an impact; leave it out for Housner's ratio of the object")
        };
        if let Some(value) = values.any("--restitution", self.restitution.as_deref(), Dimension::Ratio) {
            if value > 0.0 && value <= 1.0 {
                return Restitution::Value(value);
            }
            values.push(refuse("--restitution", value));
        }
        let factor = self.restitution_factor.as_deref();
        values
            .positive("--restitution-factor", factor, Dimension::Ratio)
            .map_or(Restitution::Housner, Restitution::Factor)
    }
}

/// The general block.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "The general block")]
pub(crate) struct ShapeArgs {
    /// Distance between the pivot edges, where the feet are set in
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    base_width: Option<String>,
    /// Height of the centre of gravity, where it is not in the middle
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    cg_height: Option<String>,
    /// Horizontal offset of the centre of gravity, positive to the right (in `shock`: towards the landing edge)
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    cg_offset: Option<String>,
    /// Moment of inertia about the left pivot edge, such as "120 kg m2"; needs --mass
    #[arg(long, value_name = "INERTIA", allow_hyphen_values = true, requires = "mass")]
    inertia: Option<String>,
}

impl ShapeArgs {
    /// The block; what is wrong goes into `values`.
    pub(crate) fn block(
        &self,
        height_m: f64,
        thickness_m: f64,
        mass_kg: Option<f64>,
        values: &mut Values,
    ) -> Option<Block> {
        let inertia = values.positive("--inertia", self.inertia.as_deref(), Dimension::Inertia);
        let shape = Shape {
            base_width_m: values.positive("--base-width", self.base_width.as_deref(), Dimension::Length),
            cg_height_m: values.positive("--cg-height", self.cg_height.as_deref(), Dimension::Length),
            cg_offset_m: values.any("--cg-offset", self.cg_offset.as_deref(), Dimension::Length),
            inertia_kg_m2: inertia.zip(mass_kg),
        };
        match shape.block(height_m, thickness_m) {
            Ok(block) => Some(block),
            Err(error) => {
                values.push(Problem::new(ProblemKind::Value, error.to_string()).hint("check the sizes of the object"));
                None
            }
        }
    }
}
