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
        pub height = "LENGTH",
        /// Horizontal size of the object in the plane of rocking
        pub thickness = "LENGTH",
        /// Mass of the object
        pub mass = "MASS",
        /// What else is known of the object.
        #[command(flatten)]
        pub block: GeneralBlock,

        /// The cushion under one edge.
        #[command(flatten)]
        pub pad: CushionUnder,
        /// Stiffness between the side of the object and what it falls onto
        pub contact_stiffness = "STIFFNESS" under "The cushion",
        /// Measured peak acceleration of the same mass dropped by the same rise, instead of a stiffness
        pub drop_acceleration = "ACCELERATION" under "The cushion",

        /// Rise of the centre of gravity
        pub cg_rise = "LENGTH" under "The fall (one of)",
        /// Uplift of the free edge
        pub uplift = "LENGTH" under "The fall (one of)",
        /// Rotation of the object
        pub rotation = "ANGLE" under "The fall (one of)",
        /// Angular velocity just before the landing
        pub angular_velocity = "ANGULAR-VELOCITY" under "The fall (one of)",

        /// What ends the fall [default: rocking]
        pub scenario = "SCENARIO" with (value_parser = one_of(SCENARIOS)) under "The landing",
        /// Impact model [default: that of the scenario; halted for a squat object]
        pub model = "MODEL" with (value_parser = one_of(MODELS)) under "The landing",
        /// Distance to the obstacle
        pub gap = "LENGTH" under "The landing",
        /// Height of the obstacle [default: taller than the object]
        pub obstacle_height = "LENGTH" under "The landing",
        /// Point whose shock is wanted: "x, z", from the pivot and above the base
        #[arg(long = "at", value_name = "X, Z", help_heading = "The landing")]
        pub at_point: Option<Written>,
        /// Coefficient of friction, used for the warning about sliding [default: 0.5]
        pub friction = "RATIO" under "The landing",
        /// Gravity [default: 1 g]
        pub gravity = "ACCELERATION" under "The landing",

        /// Peak acceleration that the object withstands
        pub tolerance = "ACCELERATION" under "The verdict",
        /// Duration of the half-sine pulse for which that peak was shown
        pub tolerance_duration = "TIME" under "The verdict",
        /// Velocity change below which no peak damages the object
        pub tolerance_velocity_change = "VELOCITY" under "The verdict",
        /// Shock tests of the object (ASTM D3332): a table with velocity change, peak acceleration and
        /// damaged (yes, no), and optionally method (A, B) or duration
        pub damage_boundary = "FILE" under "The verdict",
        /// Uplift of one edge from which the object may fall back (bench handling)
        pub tolerance_edge_lift = "LENGTH" under "The verdict",
        /// Natural frequency of the most delicate component; needs --component-capacity
        pub component_frequency = "FREQUENCY" under "The verdict",
        /// Acceleration that this component withstands
        pub component_capacity = "ACCELERATION" under "The verdict",
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
