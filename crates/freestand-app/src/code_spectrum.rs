//! `motion code-spectrum`: the spectrum of a code, and its accelerations of parts on floors.

use std::path::PathBuf;

use freestand::code_spectrum::{Asce7Edition, CodeSpectrum as Spectrum};
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_study::target::{CodeSpectrumReport, Target, code_spectrum};

use crate::files::Files;
use crate::request::{Question, Request, reader, request};
use crate::target::TargetKeys;

/// The schema of the response.
pub const SCHEMA: &str = "freestand.code-spectrum/1";

request! { question
    /// The spectrum of a code.
    pub struct CodeSpectrum {
        /// The target.
        #[command(flatten)]
        pub target: TargetKeys,
        /// Periods: from:to:count or a list [default: 0 s, 121 from 0.05 s to 5 s, corners of the code]
        pub periods = "GRID",
        /// Add the acceleration that the code prescribes for a rigid part on each floor
        pub parts = switch under "Parts and components",
        /// Height of the building; needed by AS 1170.4 and NZS 1170.5
        pub building_height = "LENGTH" under "Parts and components",
        /// Fundamental period of the building, used by ASCE 7-22 [default: unknown]
        pub building_period = "TIME" under "Parts and components",
    }
}

/// What is asked, in SI.
#[derive(Debug)]
pub struct Meant {
    /// The target.
    pub target: Target,
    periods_s: Option<Vec<f64>>,
    /// Height \[m\] and period \[s\] of the building whose parts are wanted.
    parts: Option<(Option<f64>, Option<f64>)>,
    /// The files that were read.
    pub inputs: Vec<PathBuf>,
}

impl Meant {
    /// The spectrum.
    ///
    /// # Errors
    /// A period beyond a table; parts that the code does not give.
    pub fn report(&self) -> Result<CodeSpectrumReport, Problems> {
        code_spectrum(&self.target, self.periods_s.clone(), self.parts)
    }
}

impl Question for CodeSpectrum {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let target = self.target.target(&mut read, files);
        let periods_s = read.grid("periods", Dimension::Time);
        let building = (
            read.positive("building_height", Dimension::Length),
            read.positive("building_period", Dimension::Time),
        );
        let parts = read.flag("parts");
        for key in ["building_height", "building_period"] {
            if read.has(key) && !parts {
                read.note(
                    &[key],
                    format!("`{key}` needs `parts`"),
                    "ask for the accelerations of parts, or leave it out",
                );
            }
        }
        let is_used = |target: &Target| match &target.spectrum {
            Spectrum::Asce7(code) => code.edition() == Asce7Edition::Asce7_22,
            _ => false,
        };
        if parts && building.1.is_some() && target.as_ref().is_some_and(|target| !is_used(target)) {
            read.idle(
                &["building_period"],
                "only ASCE 7-22 has parts whose acceleration depends on it",
            );
        }
        let target = read.problems.finish(target)?;
        Ok(Meant {
            target,
            periods_s,
            parts: parts.then_some(building),
            inputs: self.target.inputs(files),
        })
    }
}
