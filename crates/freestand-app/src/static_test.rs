//! `cushion static`: static tests of a pad.

use freestand::identify::Toe;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::words::Choices;
use freestand_input::written::Written;
use freestand_records::formats::parse_sensitivity;
use freestand_study::laboratory::static_curve::StaticRequest;
use freestand_study::laboratory::{BOUNDARIES, IMPACTORS};

use crate::files::Files;
use crate::request::{Question, Request, one_of, one_of_names, paths, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.cushion-static/1";

const TOES: Choices<Toe> = &[
    (
        Toe::Slack,
        "cut",
        "The displacement before the pad is touched is cut off",
    ),
    (
        Toe::Tangent,
        "tangent",
        "All before the tangent at the working load meets zero force is cut off (ASTM D695)",
    ),
    (Toe::Keep, "keep", "The toe is kept"),
];

request! { question
    /// Static tests of a pad: force against displacement.
    pub struct StaticTests {
        /// Files with tests of one pad
        #[arg(value_name = "FILE")]
        pub files: Vec<Written>,
        /// Working load [default: half of the largest force]
        pub load = "FORCE",
        /// Stiffness of the frame of the machine, whose deformation is subtracted [default: rigid]
        pub machine_compliance = "STIFFNESS",
        /// What to cut off the toe of the curve [default: cut, but keep for a sphere]
        pub toe = "WHAT" with (value_parser = one_of(TOES)),
        /// Reverse the signs of force and displacement, for a press that writes compression as negative
        pub invert = switch,
        /// Sensitivity of a sensor whose column is in volts, such as "2 mV/N" or "1 V/mm"; give it
        /// once for each such sensor
        #[arg(long, value_name = "SENSITIVITY")]
        pub sensitivity: Vec<Written>,
        /// Shape of the impactor; replaces what the files state
        pub impactor = "SHAPE" with (value_parser = one_of_names(&IMPACTORS)),
        /// Boundary of the pad; replaces what the files state
        pub boundary = "BOUNDARY" with (value_parser = one_of_names(&BOUNDARIES)),
        /// Dynamic stiffness from a drop test, to compare with the secant stiffness
        pub dynamic = "STIFFNESS",
    }
}

impl Question for StaticTests {
    type Meant = StaticRequest;

    fn resolve(&self, files: &Files) -> Result<StaticRequest, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        read.pass(&["sensitivity"]);
        let sensitivities = self.sensitivity.iter().map(Written::text);
        let sensitivities = sensitivities
            .filter_map(|text| read.keep("sensitivity", parse_sensitivity(&text)))
            .collect();
        let request = StaticRequest {
            files: paths(&mut read, "files", &self.files, files),
            load_n: read.positive("load", Dimension::Force),
            machine_stiffness_n_m: read.positive("machine_compliance", Dimension::Stiffness),
            toe: read.choice("toe", TOES),
            inverted: read.flag("invert"),
            impactor: read.name("impactor", &IMPACTORS),
            boundary: read.name("boundary", &BOUNDARIES),
            sensitivities,
            dynamic_stiffness_n_m: read.positive("dynamic", Dimension::Stiffness),
        };
        read.problems.finish(Some(request))
    }
}
