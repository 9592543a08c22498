//! `cushion curve`: the stress–energy curve of a packaging cushion.

use std::path::PathBuf;

use freestand::G0_M_S2;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::laboratory::cushion_curve::CurveRequest;

use crate::files::Files;
use crate::request::{Question, Request as _, path_without_flag, reader, request};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.cushion-curve/1";

request! { question
    /// Drops on a packaging cushion, and a design.
    pub struct CushionCurve {
        /// Table of tests with a header such as `static stress [kPa],drop height [mm],thickness [mm],peak acceleration [g]`
        #[arg(value_name = "FILE")]
        pub file: Option<Written>,
        /// Drop height of the design, and of tests in a file without that column
        pub drop_height = "LENGTH",
        /// Thickness of the design, and of tests in a file without that column
        pub thickness = "LENGTH",
        /// Static stress of the design
        pub static_stress = "PRESSURE",
        /// Mass on the cushion; needs --area
        pub mass = "MASS",
        /// Area of the cushion; needs --mass
        pub area = "AREA",
        /// Peak acceleration that must not be exceeded
        pub limit = "ACCELERATION",
    }
}

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Meant {
    /// The table of tests.
    pub file: PathBuf,
    /// The design.
    pub design: CurveRequest,
}

impl Question for CushionCurve {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let hint = "name a table of tests, such as foam.csv";
        read.require("file", "no file is named", hint);
        let file = path_without_flag(&mut read, "file", files);
        check_design(&mut read);
        let design = CurveRequest {
            drop_height_m: read.positive("drop_height", Dimension::Length),
            thickness_m: read.positive("thickness", Dimension::Length),
            static_stress_pa: static_stress(&mut read),
            limit_m_s2: read.positive("limit", Dimension::Acceleration),
        };
        read.problems
            .finish(file.map(|file| Meant { file, design }))
    }
}

/// Notes values of a design that nothing is calculated from.
fn check_design(read: &mut WordReader<'_>) {
    let has_height = read.has("drop_height");
    if read.has("limit") && !has_height {
        let message = "`limit` needs `drop_height`, from which the cushion must keep it";
        let hint = "give the drop height of the design, or leave `limit` out";
        read.missing(&["drop_height"], message, hint);
        return;
    }
    let is_design = has_height && (read.has("thickness") || read.has("limit"));
    // A mass and an area make a static stress.
    let mut stress = ["static_stress", "mass", "area"].into_iter();
    if let Some(key) = stress.find(|key| !is_design && read.has(key)) {
        let message = format!(
            "`{key}` has no effect: a design also needs `drop_height`, and `thickness` or `limit`"
        );
        let first = if has_height {
            "thickness"
        } else {
            "drop_height"
        };
        read.missing(
            &[first],
            message,
            format!("give them, or leave `{key}` out"),
        );
    }
}

/// The static stress: itself, or a weight over an area.
fn static_stress(read: &mut WordReader<'_>) -> Option<f64> {
    for (key, other) in [("mass", "area"), ("area", "mass")] {
        read.exclusive("static_stress", key);
        if read.has(key) && !read.has(other) && !read.has("static_stress") {
            let hint = "give both, or `static_stress`";
            read.missing(&[other], format!("`{key}` needs `{other}`"), hint);
        }
    }
    let stated_pa = read.positive("static_stress", Dimension::Pressure);
    let mass_kg = read.positive("mass", Dimension::Mass);
    let area_m2 = read.positive("area", Dimension::Area);
    stated_pa.or(mass_kg
        .zip(area_m2)
        .map(|(mass_kg, area_m2)| mass_kg * G0_M_S2 / area_m2))
}
