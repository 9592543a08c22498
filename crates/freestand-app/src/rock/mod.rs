//! `rock`: one object under one motion, or under each of several.

mod answer;
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
        #[arg(long, value_name = "FILE")]
        pub vertical: Option<Written>,
        /// How the vertical record is read.
        #[command(flatten)]
        pub upward: VerticalRecords,
        /// How records are read.
        #[command(flatten)]
        pub records: Records,

        /// Height of the object
        #[arg(long, value_name = "LENGTH", help_heading = "The object")]
        pub height: Option<Written>,
        /// Horizontal size of the object in the plane of rocking
        #[arg(long, value_name = "LENGTH", help_heading = "The object")]
        pub thickness: Option<Written>,
        /// Mass of the object; needed for the shock
        #[arg(long, value_name = "MASS", help_heading = "The object")]
        pub mass: Option<Written>,
        /// Coefficient of friction: on a rigid base, used for the warning about sliding [default: 0.5];
        /// with --sliding or --brakes, the friction at rest [default: 0.5]; on a compliant base, the
        /// ratio at which the edges slip [default: no slip]; of a shape or a scan [default: 0.6]
        #[arg(long, value_name = "RATIO", help_heading = "The object")]
        pub friction: Option<Written>,
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
        #[arg(long, value_name = "RATIO", help_heading = "Walls beside the object")]
        pub wall_damping: Option<Written>,
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
        #[arg(long, value_name = "ANGLE", help_heading = "The rocking")]
        pub initial_rotation: Option<Written>,
        /// Angular velocity at the start
        #[arg(long, value_name = "ANGULAR-VELOCITY", help_heading = "The rocking")]
        pub initial_velocity: Option<Written>,
        /// Gravity [default: 1 g]
        #[arg(long, value_name = "ACCELERATION", help_heading = "The rocking")]
        pub gravity: Option<Written>,
        /// Time at which to stop, whether or not the object has come to rest; the floor does not move after
        /// the last sample [default: when the object rests or lies, at most 120 s after the last sample]
        #[arg(long, value_name = "TIME", help_heading = "The rocking")]
        pub duration: Option<Written>,
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
    pub struct Base {
        /// Floor contact: rigid edges, or a cushion under each edge, which needs --mass and --stiffness
        /// [default: rigid]
        #[arg(long, value_name = "BASE", value_parser = one_of(BASES), help_heading = "The base")]
        pub base: Option<Written>,
        /// Tangential stiffness of the cushion under one edge [default: equal to the normal stiffness,
        /// an assumption]
        #[arg(long, value_name = "STIFFNESS", help_heading = "The base")]
        pub tangential_stiffness: Option<Written>,
        /// Tangential stiffness divided by the normal stiffness under half of the weight
        #[arg(long, value_name = "RATIO", help_heading = "The base")]
        pub tangential_ratio: Option<Written>,
        /// The edges never slip while loaded (the default without --friction)
        #[arg(long, action = clap::ArgAction::SetTrue, help_heading = "The base")]
        pub no_slip: Switch,
        /// Number of contact elements, evenly spaced from edge to edge; more than 2 share the cushions
        /// of both edges [default: 2]
        #[arg(long, value_name = "N", help_heading = "The base")]
        pub contacts: Option<Written>,
        /// Start at rest at this rise of the centre of gravity, rotated to the right
        #[arg(long, value_name = "LENGTH", help_heading = "The base")]
        pub cg_rise: Option<Written>,
        /// Point whose acceleration is wanted: "x, z", from the left edge and above the base
        #[arg(long = "at", value_name = "X, Z", help_heading = "The base")]
        pub at_point: Option<Written>,
    }
}

request! {
    /// An object in three dimensions.
    pub struct Space {
        /// Horizontal size of the object across the thickness; with it an object on cushions moves in three
        /// dimensions, and --motion acts along the thickness
        #[arg(
            long,
            value_name = "LENGTH",
            help_heading = "Three dimensions"
        )]
        pub width: Option<Written>,
        /// Record of the horizontal acceleration along the width, with the step and length of --motion
        #[arg(
            long,
            value_name = "FILE",
            help_heading = "Three dimensions"
        )]
        pub motion_y: Option<Written>,
        /// Two horizontal components of the file of --motion, along the thickness and along the width:
        /// "both", or two by name or number, such as "1, 2"
        #[arg(
            long,
            value_name = "both|NAME, NAME",
            help_heading = "Three dimensions"
        )]
        pub components: Option<Written>,
        /// How far the object is turned from the direction of --motion, anticlockwise from above
        /// [default: 0 deg]
        #[arg(
            long,
            value_name = "ANGLE",
            help_heading = "Three dimensions"
        )]
        pub orientation: Option<Written>,
    }
}

request! {
    /// The upper body of a stack.
    pub struct Upper {
        /// Height of a body that stands on top, in the plane of the thickness; --height, --thickness
        /// and --mass describe the lower one
        #[arg(
            long,
            value_name = "LENGTH",
            help_heading = "A second body on top, on a compliant base"
        )]
        pub upper_height: Option<Written>,
        /// Thickness of the upper body
        #[arg(
            long,
            value_name = "LENGTH",
            help_heading = "A second body on top, on a compliant base"
        )]
        pub upper_thickness: Option<Written>,
        /// Mass of the upper body
        #[arg(
            long,
            value_name = "MASS",
            help_heading = "A second body on top, on a compliant base"
        )]
        pub upper_mass: Option<Written>,
        /// Stiffness of the cushion under one edge of the upper body [default: that under the lower
        /// one]
        #[arg(
            long,
            value_name = "STIFFNESS",
            help_heading = "A second body on top, on a compliant base"
        )]
        pub interface_stiffness: Option<Written>,
        /// Coefficient of friction between the bodies [default: no slip]
        #[arg(
            long,
            value_name = "RATIO",
            help_heading = "A second body on top, on a compliant base"
        )]
        pub interface_friction: Option<Written>,
    }
}
