//! `shock`: one landing.

use std::path::PathBuf;

use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::shock::{
    BoundaryTests, Energy, MODELS, SCENARIOS, ShockRequest, boundary_tests,
};

use crate::block::{GeneralBlock, block, gravity, point, sizes};
use crate::cushion::CushionUnder;
use crate::files::Files;
use crate::request::{Question, Request, one_of, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.shock/1";

request! { question
    /// One landing of an object.
    pub struct Shock {
        /// Height of the object
        #[arg(long, value_name = "LENGTH")]
        pub height: Option<Written>,
        /// Horizontal size of the object in the plane of rocking
        #[arg(long, value_name = "LENGTH")]
        pub thickness: Option<Written>,
        /// Mass of the object
        #[arg(long, value_name = "MASS")]
        pub mass: Option<Written>,
        /// What else is known of the object.
        #[command(flatten)]
        pub block: GeneralBlock,

        /// The cushion under one edge.
        #[command(flatten)]
        pub pad: CushionUnder,
        /// Stiffness between the side of the object and what it falls onto
        #[arg(long, value_name = "STIFFNESS", help_heading = "The cushion")]
        pub contact_stiffness: Option<Written>,
        /// Measured peak acceleration of the same mass dropped by the same rise, instead of a stiffness
        #[arg(long, value_name = "ACCELERATION", help_heading = "The cushion")]
        pub drop_acceleration: Option<Written>,

        /// Rise of the centre of gravity
        #[arg(long, value_name = "LENGTH", help_heading = "The fall (one of)")]
        pub cg_rise: Option<Written>,
        /// Uplift of the free edge
        #[arg(long, value_name = "LENGTH", help_heading = "The fall (one of)")]
        pub uplift: Option<Written>,
        /// Rotation of the object
        #[arg(long, value_name = "ANGLE", help_heading = "The fall (one of)")]
        pub rotation: Option<Written>,
        /// Angular velocity just before the landing
        #[arg(
            long,
            value_name = "ANGULAR-VELOCITY",
            help_heading = "The fall (one of)"
        )]
        pub angular_velocity: Option<Written>,

        /// What ends the fall [default: rocking]
        #[arg(long, value_name = "SCENARIO", value_parser = one_of(SCENARIOS), help_heading = "The landing")]
        pub scenario: Option<Written>,
        /// Impact model [default: that of the scenario; halted for a squat object]
        #[arg(long, value_name = "MODEL", value_parser = one_of(MODELS), help_heading = "The landing")]
        pub model: Option<Written>,
        /// Distance to the obstacle
        #[arg(long, value_name = "LENGTH", help_heading = "The landing")]
        pub gap: Option<Written>,
        /// Height of the obstacle [default: taller than the object]
        #[arg(long, value_name = "LENGTH", help_heading = "The landing")]
        pub obstacle_height: Option<Written>,
        /// Point whose shock is wanted: "x, z", from the pivot and above the base
        #[arg(long = "at", value_name = "X, Z", help_heading = "The landing")]
        pub at_point: Option<Written>,
        /// Coefficient of friction, used for the warning about sliding [default: 0.5]
        #[arg(long, value_name = "RATIO", help_heading = "The landing")]
        pub friction: Option<Written>,
        /// Gravity [default: 1 g]
        #[arg(long, value_name = "ACCELERATION", help_heading = "The landing")]
        pub gravity: Option<Written>,

        /// Peak acceleration that the object withstands
        #[arg(long, value_name = "ACCELERATION", help_heading = "The verdict")]
        pub tolerance: Option<Written>,
        /// Duration of the half-sine pulse for which that peak was shown
        #[arg(long, value_name = "TIME", help_heading = "The verdict")]
        pub tolerance_duration: Option<Written>,
        /// Velocity change below which no peak damages the object
        #[arg(long, value_name = "VELOCITY", help_heading = "The verdict")]
        pub tolerance_velocity_change: Option<Written>,
        /// Shock tests of the object (ASTM D3332): a table with velocity change, peak acceleration and
        /// damaged (yes, no), and optionally method (A, B) or duration
        #[arg(long, value_name = "FILE", help_heading = "The verdict")]
        pub damage_boundary: Option<Written>,
        /// Uplift of one edge from which the object may fall back (bench handling)
        #[arg(long, value_name = "LENGTH", help_heading = "The verdict")]
        pub tolerance_edge_lift: Option<Written>,
        /// Natural frequency of the most delicate component; needs --component-capacity
        #[arg(long, value_name = "FREQUENCY", help_heading = "The verdict")]
        pub component_frequency: Option<Written>,
        /// Acceleration that this component withstands
        #[arg(long, value_name = "ACCELERATION", help_heading = "The verdict")]
        pub component_capacity: Option<Written>,
    }
}

/// What is asked, in SI.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The landing.
    pub landing: ShockRequest,
    /// The files that were read.
    pub inputs: Vec<PathBuf>,
}

/// What contradicts each other is found where the landing is calculated.
impl Question for Shock {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let size = sizes(&mut read);
        read.require(
            "mass",
            "`mass` is missing",
            "give the mass of the object, such as `mass = \"140 kg\"`",
        );
        let mass = read.positive("mass", Dimension::Mass);
        let block = block(&mut read, size, mass);
        let cushion = self.pad.described(&mut read, files);
        // Wrong values are told with the others; missing and contradictory ones where the landing is calculated.
        if let Some(words) = &cushion
            && ["law", "stiffness", "pad_stiffness"]
                .iter()
                .any(|key| words.get(key).is_some())
        {
            self.pad.of_words(words, &mut read, mass, files);
        }
        let energy = energy(&mut read);
        let tests = tests(&mut read, files);
        let (acceleration, length) = (Dimension::Acceleration, Dimension::Length);
        let contact_stiffness_n_m = read.positive("contact_stiffness", Dimension::Stiffness);
        let drop_acceleration_m_s2 = read.positive("drop_acceleration", acceleration);
        let scenario = read.choice("scenario", SCENARIOS).unwrap_or_default();
        let model = read.choice("model", MODELS);
        let gap_m = read.positive("gap", length);
        let obstacle_height_m = read.positive("obstacle_height", length);
        let at_m = point(&mut read);
        let friction_ratio = read.positive("friction", Dimension::Ratio);
        let gravity_m_s2 = gravity(&mut read);
        let tolerance_m_s2 = read.positive("tolerance", acceleration);
        let tolerance_duration_s = read.positive("tolerance_duration", Dimension::Time);
        let tolerance_velocity_change_m_s =
            read.positive("tolerance_velocity_change", Dimension::Velocity);
        let tolerance_edge_lift_m = read.positive("tolerance_edge_lift", length);
        let component_frequency_hz = read.positive("component_frequency", Dimension::Frequency);
        let component_capacity_m_s2 = read.positive("component_capacity", acceleration);
        let (block, mass_kg) = read.problems.finish(block.zip(mass))?;
        Ok(Meant {
            landing: ShockRequest {
                cushion: cushion.unwrap_or_default(),
                contact_stiffness_n_m,
                drop_acceleration_m_s2,
                energy,
                scenario,
                model,
                gap_m,
                obstacle_height_m,
                at_m,
                gravity_m_s2,
                friction_ratio,
                tolerance_m_s2,
                tolerance_duration_s,
                tolerance_velocity_change_m_s,
                boundary_tests: tests,
                tolerance_edge_lift_m,
                component_frequency_hz,
                component_capacity_m_s2,
                ..ShockRequest::new(block, mass_kg)
            },
            inputs: [
                self.pad.input(files),
                files.path_of(self.damage_boundary.as_ref()),
            ]
            .into_iter()
            .flatten()
            .collect(),
        })
    }
}

/// The energy of the fall, of which one measure is given.
fn energy(read: &mut WordReader<'_>) -> Option<Energy> {
    let measures = ["cg_rise", "uplift", "rotation", "angular_velocity"];
    for (index, first) in measures.iter().enumerate() {
        for second in measures.iter().skip(index + 1) {
            read.exclusive(first, second);
        }
    }
    let rise = read.non_negative("cg_rise", Dimension::Length);
    let uplift = read.non_negative("uplift", Dimension::Length);
    let rotation = read.quantity("rotation", Dimension::Angle);
    let speed = read.quantity("angular_velocity", Dimension::AngularVelocity);
    rise.map(Energy::CgRise)
        .or(uplift.map(Energy::Uplift))
        .or(rotation.map(Energy::Rotation))
        .or(speed.map(Energy::AngularVelocity))
}

/// The tests of a damage boundary, which are in a file.
fn tests(read: &mut WordReader<'_>, files: &Files) -> Option<BoundaryTests> {
    for key in [
        "tolerance",
        "tolerance_duration",
        "tolerance_velocity_change",
    ] {
        read.exclusive("damage_boundary", key);
    }
    let name = read.text("damage_boundary")?;
    let path = read.keep("damage_boundary", files.path(name))?;
    let tests = boundary_tests(&path).map_err(|problems| {
        let named = problems
            .into_iter()
            .map(|problem| problem.of(&["damage_boundary"]));
        named.collect::<Problems>()
    });
    read.problems.keep(tests)
}
