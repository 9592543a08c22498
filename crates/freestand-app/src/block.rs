//! The object as a block, and how its rocking is calculated.

use std::ops::RangeInclusive;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::rocking::{Accuracy, Restitution, RockingModel};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;
use freestand_study::restitution::checked;
use freestand_study::rock::{ACCURACIES, MODELS};
use freestand_study::shape::Shape;

use crate::request::{one_of, request};

request! {
    /// What is known of an object besides its height and its thickness.
    pub struct GeneralBlock under "The general block" {
        /// Distance between the two edges, if the feet are set in [default: the thickness]
        pub base_width = "LENGTH",
        /// Height of the centre of gravity [default: half of the height]
        pub cg_height = "LENGTH",
        /// Horizontal offset of the centre of gravity, positive to the right (in `shock`: towards the
        /// landing edge) [default: 0]
        pub cg_offset = "LENGTH",
        /// Moment of inertia about the left edge, such as "120 kg m2"; needs the mass [default: uniform]
        pub inertia = "MOMENT-OF-INERTIA",
    }
}

/// Height and thickness of an object \[m\]; `None` if one is missing or wrong.
pub(crate) fn sizes(read: &mut WordReader<'_>) -> Option<(f64, f64)> {
    let height = height(read);
    let thickness = length(read, "thickness");
    height.zip(thickness)
}

/// Height of an object \[m\]; `None` if it is missing or wrong.
pub(crate) fn height(read: &mut WordReader<'_>) -> Option<f64> {
    length(read, "height")
}

/// A size that an object must have \[m\]; `None` if it is missing or wrong.
pub(crate) fn length(read: &mut WordReader<'_>, key: &'static str) -> Option<f64> {
    let hint = format!("give the size of the object, such as `{key} = \"600 mm\"`");
    read.require(key, format!("`{key}` is missing"), hint);
    read.positive(key, Dimension::Length)
}

/// A point of the object \[m\].
pub(crate) fn point(read: &mut WordReader<'_>) -> Option<(f64, f64)> {
    let hint =
        "write the horizontal distance and the height above the base, such as \"0.3 m, 1.2 m\"";
    read.two("at_point", Dimension::Length, hint)
}

/// Gravity, as small as on a minor planet and as large as where anything stands: 9.81 g is a slip.
pub(crate) fn gravity(read: &mut WordReader<'_>) -> f64 {
    const BELIEVED_M_S2: RangeInclusive<f64> = 0.1..=30.0;
    let Some(value_m_s2) = read.positive("gravity", Dimension::Acceleration) else {
        return G0_M_S2;
    };
    if !BELIEVED_M_S2.contains(&value_m_s2) {
        let message = format!(
            "`gravity` must be from {} to {} m/s2, not {}",
            BELIEVED_M_S2.start(),
            BELIEVED_M_S2.end(),
            number(value_m_s2, 4)
        );
        read.note(&["gravity"], message, "write \"9.81 m/s2\" or \"1 g\"");
    }
    value_m_s2
}

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
    read.problems.keep(block.map_err(|error| {
        Problem::value(error.to_string(), "check the dimensions of the object")
            .of(&["thickness", "height"])
    }))
}

request! {
    /// How the rocking of an object is calculated.
    pub struct Rocking under "The rocking" {
        /// Restitution: angular velocity after an impact divided by the one before, in (0, 1]
        /// [default: Housner's]
        pub restitution = "RATIO",
        /// Factor that multiplies Housner's restitution
        pub restitution_factor = "RATIO",
        /// Equation of motion [default: rigid]
        pub model = "MODEL" with (value_parser = one_of(MODELS)),
        /// Accuracy of the solver [default: standard]
        pub accuracy = "ACCURACY" with (value_parser = one_of(ACCURACIES)),
    }
}

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
