//! `cushion drop`: drop tests of a pad.

use freestand::G0_M_S2;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_records::formats::{ReadOptions, parse_sensitivity, parse_unit};
use freestand_records::processing::read_step;
use freestand_study::laboratory::drop_test::{DropRequest, LAWS};
use freestand_study::laboratory::{BOUNDARIES, IMPACTORS};
use freestand_study::study::DEFAULT_SEED;

use crate::files::Files;
use crate::request::{Question, Request, one_of, one_of_names, paths, reader, request, seed};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.cushion-drop/1";

request! { question
    /// Drop tests of a pad: the acceleration of a mass that falls onto it.
    pub struct DropTests {
        /// Files with drops on one pad
        #[arg(value_name = "FILE")]
        pub files: Vec<Written>,
        /// Mass of the impactor
        pub mass = "MASS",
        /// Drop height
        pub height = "LENGTH",
        /// Velocity at the first touch [default: from the drop height, or from the pulse itself]
        pub impact_velocity = "VELOCITY",
        /// Standard deviation of the impact velocity, as a share of it [default: 1 %]
        pub velocity_error = "RATIO",
        /// Gravity during the contact; 0 m/s2 if the zero line is not that of free fall [default: 1 g]
        pub gravity = "ACCELERATION",
        /// Corner frequency of the low-pass filter before the A/D converter, after which the laws are fitted
        pub corner = "FREQUENCY",
        /// Fit only this law [default: the simplest one that no other clearly improves on]
        pub law = "LAW" with (value_parser = one_of(LAWS)),
        /// Thickness of the pad, used in warnings only
        pub pad_thickness = "LENGTH",
        /// Shape of the impactor; replaces what the files state
        pub impactor = "SHAPE" with (value_parser = one_of_names(&IMPACTORS)),
        /// Radius of a spherical impactor
        pub sphere_radius = "LENGTH",
        /// Boundary of the pad; replaces what the files state
        pub boundary = "BOUNDARY" with (value_parser = one_of_names(&BOUNDARIES)),
        /// Change the sign of all samples, for a sensor that is mounted upside down
        pub invert = switch,
        /// Unit of acceleration of a file that does not state it
        pub unit = "UNIT",
        /// Sensitivity of the accelerometer of a column in volts, such as "10 mV/g"
        pub sensitivity = "SENSITIVITY",
        /// Time step of a file without a column of times
        pub dt = "TIME",
        /// Step to which unevenly spaced samples are interpolated on straight lines [default: they are refused]
        pub resample = "TIME",
        /// Column of accelerations, by name or by number (from 1)
        pub component = "NAME",

        /// Seed of the random numbers of the intervals.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

impl Question for DropTests {
    type Meant = DropRequest;

    fn resolve(&self, files: &Files) -> Result<DropRequest, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        read.exclusive("height", "impact_velocity");
        read.exclusive("unit", "sensitivity");
        let request = DropRequest {
            files: paths(&mut read, "files", &self.files, files),
            mass_kg: read.positive("mass", Dimension::Mass),
            height_m: read.positive("height", Dimension::Length),
            impact_velocity_m_s: read.positive("impact_velocity", Dimension::Velocity),
            velocity_error_ratio: velocity_error(&mut read),
            gravity_m_s2: read
                .non_negative("gravity", Dimension::Acceleration)
                .unwrap_or(G0_M_S2),
            filter_corner_hz: read.positive("corner", Dimension::Frequency),
            law: read.choice("law", LAWS),
            read: ReadOptions {
                unit: read.read("unit", parse_unit),
                sensitivity: read.read("sensitivity", parse_sensitivity),
                dt_s: read_step(&mut read, "dt"),
                uneven_dt_s: read_step(&mut read, "resample"),
                ..ReadOptions::default()
            },
            component: read.one("component").map(str::to_owned),
            inverted: read.flag("invert"),
            thickness_m: read.positive("pad_thickness", Dimension::Length),
            impactor: read.name("impactor", &IMPACTORS),
            sphere_radius_m: read.positive("sphere_radius", Dimension::Length),
            boundary: read.name("boundary", &BOUNDARIES),
            seed: seed(&mut read).unwrap_or(DEFAULT_SEED),
        };
        read.problems.finish(Some(request))
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

fn velocity_error(read: &mut WordReader<'_>) -> Option<f64> {
    let given = read.positive("velocity_error", Dimension::Ratio);
    if let Some(ratio) = given.filter(|ratio| *ratio > 0.5) {
        read.note(
            &["velocity_error"],
            format!("`velocity_error` must be at most 50 %, not {} %", 100.0 * ratio),
            "give a smaller one; without `height` and `impact_velocity` the velocity is found from the pulse",
        );
    }
    given
}
