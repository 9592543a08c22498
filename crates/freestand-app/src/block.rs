//! The object as a block, and how its rocking is calculated.

use clap::Args;
use freestand::block::Block;
use freestand::rocking::{Accuracy, Restitution, RockingModel};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::restitution::checked;
use freestand_study::rock::{ACCURACIES, MODELS};
use freestand_study::shape::Shape;
use serde::Deserialize;

use crate::request::request;

/// What is known of an object besides its height and its thickness.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Args)]
#[serde(default)]
#[group(skip)]
pub struct GeneralBlock {
    /// Distance between the two edges, if the feet are set in [default: the thickness]
    #[arg(long, value_name = "LENGTH", help_heading = "The general block")]
    pub base_width: Option<Written>,
    /// Height of the centre of gravity [default: half of the height]
    #[arg(long, value_name = "LENGTH", help_heading = "The general block")]
    pub cg_height: Option<Written>,
    /// Horizontal offset of the centre of gravity, positive to the right (in `shock`: towards the
    /// landing edge) [default: 0]
    #[arg(long, value_name = "LENGTH", help_heading = "The general block")]
    pub cg_offset: Option<Written>,
    /// Moment of inertia about the left edge, such as "120 kg m2"; needs the mass [default: uniform]
    #[arg(
        long,
        value_name = "MOMENT-OF-INERTIA",
        help_heading = "The general block"
    )]
    pub inertia: Option<Written>,
}

request!(GeneralBlock {
    base_width,
    cg_height,
    cg_offset,
    inertia
});

/// The block of an object; `None` if something is missing or wrong.
pub(crate) fn block(
    read: &mut WordReader<'_>,
    size: Option<(f64, f64)>,
    mass_kg: Option<f64>,
) -> Option<Block> {
    let inertia = read.positive("inertia", Dimension::Inertia);
    if inertia.is_some() && !read.has("mass") {
        read.missing(
            &["mass", "inertia"],
            "`inertia` needs `mass`",
            "give both, or leave `inertia` out",
        );
    }
    let shape = Shape {
        base_width_m: read.positive("base_width", Dimension::Length),
        cg_height_m: read.positive("cg_height", Dimension::Length),
        cg_offset_m: read.quantity("cg_offset", Dimension::Length),
        inertia_kg_m2: inertia.zip(mass_kg),
    };
    let (height_m, thickness_m) = size?;
    let block = shape.block(height_m, thickness_m);
    read.problems.keep(
        block.map_err(|error| {
            Problem::value(error.to_string(), "check the dimensions of the object")
        }),
    )
}

/// How the rocking of an object is calculated.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Args)]
#[serde(default)]
#[group(skip)]
pub struct Rocking {
    /// Restitution: angular velocity after an impact divided by the one before, in (0, 1]
    /// [default: Housner's]
    #[arg(long, value_name = "RATIO", help_heading = "The rocking")]
    pub restitution: Option<Written>,
    /// Factor that multiplies Housner's restitution
    #[arg(long, value_name = "RATIO", help_heading = "The rocking")]
    pub restitution_factor: Option<Written>,
    /// Equation of motion: rigid, the exact one, or linear (sin x → x, tan α → α), for comparison with closed forms
    /// [default: rigid]
    #[arg(long, value_name = "MODEL", help_heading = "The rocking")]
    pub model: Option<Written>,
    /// Accuracy of the solver: fast (an error of 1e-9 per step, about 1e-7 in the rotations of spectra), standard
    /// (1e-13, and 1e-9 or better) or tight (the limit of double precision) [default: standard]
    #[arg(long, value_name = "ACCURACY", help_heading = "The rocking")]
    pub accuracy: Option<Written>,
}

request!(Rocking {
    restitution,
    restitution_factor,
    model,
    accuracy
});

pub(crate) fn accuracy(read: &mut WordReader<'_>) -> Accuracy {
    read.choice("accuracy", ACCURACIES).unwrap_or_default()
}

pub(crate) fn model(read: &mut WordReader<'_>) -> RockingModel {
    read.choice("model", MODELS).unwrap_or_default()
}

/// The restitution of these blocks.
pub(crate) fn restitution(read: &mut WordReader<'_>, blocks: &[Block]) -> Restitution {
    read.exclusive("restitution", "restitution_factor");
    let value = read.quantity("restitution", Dimension::Ratio);
    let factor = read.positive("restitution_factor", Dimension::Ratio);
    let restitution = match (value, factor) {
        (Some(value), _) => Restitution::Value(value),
        (None, Some(factor)) => Restitution::Factor(factor),
        (None, None) => Restitution::Housner,
    };
    read.problems
        .keep(checked(restitution, blocks))
        .unwrap_or_default()
}
