//! `rock`: one object under one motion, or under each of several.

mod answer;
mod kind;
mod resolve;

use crate::block::{GeneralBlock, Rocking};
use crate::body::{BodyShape, Contacts};
use crate::cushion::CushionUnder;
use crate::records::{Records, VerticalRecords};
use crate::request::{Switch, one_of, request};
use crate::sliding::Sliding;
use crate::walls::Walls;
use freestand_input::words::Choices;
use freestand_input::written::Written;

pub use answer::{Answer, Did, Followed, OfMotion, Results};
pub use resolve::{Asked, Meant};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.rock/1";

request! { question
    /// One object, and what shakes it or how it is released.
    pub struct Rock {
        /// Records of the horizontal acceleration of the floor, each for a result of its own [default:
        /// none, free rocking]
        #[arg(long, value_name = "FILE", num_args = 1..)]
        pub motion: Vec<Written>,
        /// Record of the vertical acceleration of the floor, positive upward, with the same step and
        /// length
        pub vertical = "FILE",
        /// How the vertical record is read.
        #[command(flatten)]
        pub upward: VerticalRecords,
        /// How records are read.
        #[command(flatten)]
        pub records: Records,

        /// Height of the object
        pub height = "LENGTH" under "The object",
        /// Horizontal size of the object in the plane of rocking
        pub thickness = "LENGTH" under "The object",
        /// Mass of the object; needed for the shock
        pub mass = "MASS" under "The object",
        /// Coefficient of friction: on a rigid base, used for the warning about sliding [default: 0.5];
        /// with --sliding or --brakes, the friction at rest [default: 0.5]; on a compliant base, the
        /// ratio at which the edges slip [default: no slip]; of a shape or a scan [default: 0.6]
        pub friction = "RATIO" under "The object",
        /// What else is known of the object.
        #[command(flatten)]
        pub block: GeneralBlock,
        /// The cushion under one edge.
        #[command(flatten)]
        pub pad: CushionUnder,
        /// Walls beside it.
        #[command(flatten)]
        pub walls: Walls,
        /// Damping ratio of the cushion of the walls, on a compliant base or of a shape [default: that under an edge]
        pub wall_damping = "RATIO" under "Walls beside the object",
        /// What it stands on.
        #[command(flatten)]
        pub on: Base,
        /// Whether it slides or stands on casters.
        #[command(flatten)]
        pub slides: Sliding,
        /// Its shape.
        #[command(flatten)]
        pub shape: BodyShape,
        /// How a body in three dimensions touches the floor.
        #[command(flatten)]
        pub contacts: Contacts,
        /// What it is in three dimensions.
        #[command(flatten)]
        pub space: Space,
        /// What stands on it.
        #[command(flatten)]
        pub upper: Upper,
        /// How its rocking is calculated.
        #[command(flatten)]
        pub rocking: Rocking,

        /// Rotation at the start, positive to the right
        pub initial_rotation = "ANGLE" under "The rocking",
        /// Angular velocity at the start
        pub initial_velocity = "ANGULAR-VELOCITY" under "The rocking",
        /// Gravity [default: 1 g]
        pub gravity = "ACCELERATION" under "The rocking",
        /// Time at which to stop, whether or not the object has come to rest; the floor does not move after
        /// the last sample [default: when the object rests or lies, at most 120 s after the last sample]
        pub duration = "TIME" under "The rocking",
    }
}

/// What an object stands on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BaseName {
    Rigid,
    Compliant,
}

const BASES: Choices<BaseName> = &[
    (
        BaseName::Rigid,
        "rigid",
        "Housner's model: the object rotates about fixed edges",
    ),
    (
        BaseName::Compliant,
        "compliant",
        "A rigid body on cushions, integrated in time",
    ),
];

request! {
    /// What the object stands on.
    pub struct Base under "The base" {
        /// Floor contact: rigid edges, or a cushion under each edge, which needs --mass and --stiffness
        /// [default: rigid]
        pub base = "BASE" with (value_parser = one_of(BASES)),
        /// Tangential stiffness of the cushion under one edge [default: equal to the normal stiffness,
        /// an assumption]
        pub tangential_stiffness = "STIFFNESS",
        /// Tangential stiffness divided by the normal stiffness under half of the weight
        pub tangential_ratio = "RATIO",
        /// The edges never slip while loaded (the default without --friction)
        #[arg(long, action = clap::ArgAction::SetTrue, help_heading = "The base")]
        pub no_slip: Switch,
        /// Number of contact elements, evenly spaced from edge to edge; more than 2 share the cushions
        /// of both edges [default: 2]
        pub contacts = "N",
        /// Start at rest at this rise of the centre of gravity, rotated to the right
        pub cg_rise = "LENGTH",
        /// Point whose acceleration is wanted: "x, z", from the left edge and above the base
        #[arg(long = "at", value_name = "X, Z", help_heading = "The base")]
        pub at_point: Option<Written>,
    }
}

request! {
    /// An object in three dimensions.
    pub struct Space under "Three dimensions" {
        /// Horizontal size of the object across the thickness; with it an object on cushions moves in three
        /// dimensions, and --motion acts along the thickness
        pub width = "LENGTH",
        /// Record of the horizontal acceleration along the width, with the step and length of --motion
        pub motion_y = "FILE",
        /// Two horizontal components of the file of --motion, along the thickness and along the width:
        /// "both", or two by name or number, such as "1, 2"
        pub components = "both|NAME, NAME",
        /// How far the object is turned from the direction of --motion, anticlockwise from above
        /// [default: 0 deg]
        pub orientation = "ANGLE",
    }
}

request! {
    /// The upper body of a stack.
    pub struct Upper under "A second body on top, on a compliant base" {
        /// Height of a body that stands on top, in the plane of the thickness; --height, --thickness
        /// and --mass describe the lower one
        pub upper_height = "LENGTH",
        /// Thickness of the upper body
        pub upper_thickness = "LENGTH",
        /// Mass of the upper body
        pub upper_mass = "MASS",
        /// Stiffness of the cushion under one edge of the upper body [default: that under the lower
        /// one]
        pub interface_stiffness = "STIFFNESS",
        /// Coefficient of friction between the bodies [default: no slip]
        pub interface_friction = "RATIO",
    }
}
