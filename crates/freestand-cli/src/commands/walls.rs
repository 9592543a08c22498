//! Flags for walls beside the object, shared by `rock` and `spectrum`.

use clap::Args;
use freestand::block::Block;
use freestand::rocking::RockingModel;
use freestand::wall::Walls;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_study::walls::{GivenWalls, WallStiffness, needs_a_gap};

use crate::values::{Given, Reads, Values};

/// Flags for walls and neighbours.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Walls beside the object")]
pub(crate) struct WallArgs {
    /// Distance of the wall behind the object (on its left) from its face; 0 where they touch
    /// [default: no wall]
    #[arg(long, visible_alias = "wall-gap", non_negative = Dimension::Length)]
    wall_gap_left: Option<Given>,
    /// Distance of the wall on the right [default: no wall]
    #[arg(long, non_negative = Dimension::Length)]
    wall_gap_right: Option<Given>,
    /// Height of the walls [default: taller than the object]
    #[arg(long, positive = Dimension::Length)]
    wall_height: Option<Given>,
    /// Angular velocity after an impact on a wall divided by the one before, at least 0 and less
    /// than 1, on a rigid base [default: 0.5]
    #[arg(long, any = Dimension::Ratio)]
    wall_restitution: Option<Given>,
    /// Stiffness of the walls at the point of contact; with --mass it gives the shock there [default
    /// on a compliant base: that of the cushion under an edge]
    #[arg(long, positive = Dimension::Stiffness)]
    wall_stiffness: Option<Given>,
}

impl WallArgs {
    /// Whether a flag was given that needs the mass of the object.
    pub(crate) fn needs_mass(&self) -> bool {
        self.wall_stiffness.is_some()
    }

    /// The walls beside `block`, the stiffness of the walls and the mass for the shock there;
    /// problems are added to `values`.
    pub(crate) fn read(
        &self,
        block: Option<&Block>,
        mass_kg: Option<f64>,
        model: RockingModel,
        values: &mut Values,
    ) -> (Walls, WallStiffness) {
        let given = GivenWalls {
            left_gap_m: values.read(&self.wall_gap_left),
            right_gap_m: values.read(&self.wall_gap_right),
            height_m: values.read(&self.wall_height),
            restitution_ratio: values.read(&self.wall_restitution),
        };
        let stiffness_n_m = values.read(&self.wall_stiffness);
        if self.wall_gap_left.is_none() && self.wall_gap_right.is_none() {
            // Where only the height or the restitution is given, `GivenWalls` says so.
            if self.wall_stiffness.is_some()
                && given.height_m.is_none()
                && given.restitution_ratio.is_none()
            {
                values.push(needs_a_gap());
            }
        } else if model == RockingModel::Linearised {
            let message = "the linearised equation of motion has no walls";
            values.push(Problem::value(
                message,
                "leave --model linear out, or the flags of the walls",
            ));
        }
        if stiffness_n_m.is_some() && mass_kg.is_none() {
            let message = "the stiffness of the walls is used for the shock, which also needs the mass of the object";
            values.push(Problem::value(
                message,
                "add --mass, or leave --wall-stiffness out",
            ));
        }
        let walls = block
            .and_then(|block| values.take(given.walls(block)))
            .unwrap_or_default();
        (
            walls,
            WallStiffness {
                mass_kg,
                stiffness_n_m,
            },
        )
    }
}
