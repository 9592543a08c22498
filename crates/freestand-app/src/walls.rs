//! Walls beside an object.

use freestand::block::Block;
use freestand::rocking::RockingModel;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_study::walls::{GivenWalls, WallStiffness, needs_a_gap};

use crate::request::request;

request! {
    /// Walls beside an object.
    pub struct Walls under "Walls beside the object" {
        /// Distance of the wall behind the object (on its left) from its face; 0 where they touch
        /// [default: no wall]
        pub wall_gap_left = "LENGTH" with (visible_alias = "wall-gap"),
        /// Distance of the wall on the right [default: no wall]
        pub wall_gap_right = "LENGTH",
        /// Height of the walls [default: taller than the object]
        pub wall_height = "LENGTH",
        /// Angular velocity after an impact on a wall divided by the one before, at least 0 and less
        /// than 1, on a rigid base [default: 0.5]
        pub wall_restitution = "RATIO",
        /// Stiffness of the walls at the point of contact; with --mass it gives the shock there [default
        /// on a compliant base: that of the cushion under an edge]
        pub wall_stiffness = "STIFFNESS",
    }
}

/// The walls beside `block`, their stiffness, and the mass for the shock there; no walls if something is wrong.
/// `model` is that of a rigid base.
pub(crate) fn walls(
    read: &mut WordReader<'_>,
    block: Option<&Block>,
    mass_kg: Option<f64>,
    model: Option<RockingModel>,
) -> (freestand::wall::Walls, WallStiffness) {
    let given = GivenWalls {
        left_gap_m: read.non_negative("wall_gap_left", Dimension::Length),
        right_gap_m: read.non_negative("wall_gap_right", Dimension::Length),
        height_m: read.positive("wall_height", Dimension::Length),
        // On cushions it follows from the cushion.
        restitution_ratio: model.and_then(|_| read.quantity("wall_restitution", Dimension::Ratio)),
    };
    let stiffness_n_m = read.positive("wall_stiffness", Dimension::Stiffness);
    let is_beside = read.has("wall_gap_left") || read.has("wall_gap_right");
    // Where only the height or the restitution is given, `GivenWalls` says so.
    let is_told = given.height_m.or(given.restitution_ratio).is_some() && block.is_some();
    if !is_beside && read.has("wall_stiffness") && !is_told {
        read.problems.push(needs_a_gap().of(&["wall_gap_left"]));
    }
    if is_beside && model == Some(RockingModel::Linearised) {
        read.note(
            &["model"],
            "the linearised equation of motion has no walls",
            "leave `model = \"linear\"` out, or the walls",
        );
    }
    if stiffness_n_m.is_some() && !read.has("mass") {
        read.missing(
            &["mass"],
            "the stiffness of the walls is used for the shock, which also needs the mass of the object",
            "add `mass`, or leave `wall_stiffness` out",
        );
    }
    let walls = block.and_then(|block| {
        read.problems.keep(
            given
                .walls(block)
                .map_err(|problem| problem.of(&["wall_gap_left"])),
        )
    });
    let stiffness = WallStiffness {
        mass_kg,
        stiffness_n_m,
    };
    (walls.unwrap_or_default(), stiffness)
}
