//! `cushion recovery`: how well the evaluation of drop tests recovers known values.

use std::ops::RangeInclusive;

use freestand::G0_M_S2;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::laboratory::virtual_laboratory::RecoveryRequest;
use freestand_study::study::DEFAULT_SEED;

use crate::files::Files;
use crate::request::{Question, Request as _, reader, request, seed};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.cushion-recovery/1";

request! { question
    /// What is varied.
    pub struct Recovery {
        /// Number of drops for each combination [default: 100]
        pub drops = "N",
        /// Samples per contact [default: 25, 50, 200]
        pub samples_per_contact = "LIST",
        /// Noise as a share of the peak [default: 0.5 %, 2 %]
        pub noise = "LIST",
        /// Bias of the whole record [default: 5 g]
        pub bias = "LIST",
        /// Shift of the zero line at the peak, as a share of the peak [default: 0]
        pub zero_shift = "LIST",

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

impl Question for Recovery {
    type Meant = RecoveryRequest;

    fn resolve(&self, _: &Files) -> Result<RecoveryRequest, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let usual = RecoveryRequest::worked_example()?;
        let drops = read.whole_within("drops", 1..=10_000);
        let samples = within(
            &mut read,
            "samples_per_contact",
            2.0..=10_000.0,
            ["2 to 10000", "write \"25, 50, 200\""],
        );
        let noise = within(
            &mut read,
            "noise",
            0.0..=1.0,
            ["0 to 100 %", "write \"0.5 %, 2 %\""],
        );
        let biases_m_s2 = read.grid("bias", Dimension::Acceleration);
        let biases_g = biases_m_s2.map(|all| all.iter().map(|bias| bias / G0_M_S2).collect());
        let zero_shifts = read.grid("zero_shift", Dimension::Ratio);
        let request = RecoveryRequest {
            samples_per_contact: samples.unwrap_or(usual.samples_per_contact),
            noise_ratios: noise.unwrap_or(usual.noise_ratios),
            biases_g: biases_g.unwrap_or(usual.biases_g),
            zero_shift_ratios: zero_shifts.unwrap_or(usual.zero_shift_ratios),
            drops: drops.unwrap_or(usual.drops),
            seed: seed(&mut read).unwrap_or(DEFAULT_SEED),
            ..usual
        };
        read.problems.finish(Some(request))
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

/// Ratios in a range; the words say which, and what to write.
fn within(
    read: &mut WordReader<'_>,
    key: &'static str,
    range: RangeInclusive<f64>,
    [expected, hint]: [&str; 2],
) -> Option<Vec<f64>> {
    let found = read.grid(key, Dimension::Ratio)?;
    if let Some(wrong) = found.iter().find(|ratio| !range.contains(*ratio)) {
        read.note(
            &[key],
            format!("`{key}` must be {expected}, not {wrong}"),
            hint,
        );
    }
    Some(found)
}
