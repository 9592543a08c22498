//! `cushion simulate`: virtual drop tests and static tests of a cushion.

use std::path::PathBuf;

use freestand::cushion::Cushion;
use freestand::identify::{VirtualDropOptions, VirtualStaticOptions};
use freestand::impact::ValidityWarning;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::cushion::EdgeCushion;
use freestand_study::laboratory::virtual_laboratory::{
    AssumedDamping, assume_damping, leave_out_damping,
};
use freestand_study::study::DEFAULT_SEED;

use crate::CushionUnder;
use crate::files::Files;
use crate::request::{Question, Request as _, reader, request, seed};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.cushion-simulate/1";

/// The highest drop towers for experiments are about 150 m; the sum of numbers far beyond is no number.
const HIGHEST_M: f64 = 1000.0;

/// More bounces are none.
const MOST_BOUNCES: u32 = 20;

request! { question
    /// A cushion, and tests of it.
    pub struct VirtualTests {
        /// The cushion.
        #[command(flatten)]
        pub pad: CushionUnder,
        /// Mass of the impactor
        pub mass = "MASS",
        /// Drop height
        pub height = "LENGTH",
        /// Samples per second [default: 50 per contact]
        pub sample_rate = "FREQUENCY",
        /// Standard deviation of white noise, as a share of the peak (in a static test, of the largest
        /// force) [default: 0]
        pub noise = "RATIO",
        /// Bias added to every sample [default: 0 g]
        pub bias = "ACCELERATION",
        /// Shift of the zero line after the peak, as a share of the peak [default: 0]
        pub zero_shift = "RATIO",
        /// Corner frequency of a two-pole low-pass filter before the A/D converter [default: no filter]
        pub filter_corner = "FREQUENCY",
        /// Time before the first touch [default: 3 contacts]
        pub pre_trigger = "TIME",
        /// Number of bounces after the first contact [default: 0]
        pub bounces = "N",
        /// Gravity during the contact [default: 1 g]
        pub gravity = "ACCELERATION",
        /// Number of tests [default: 1]
        pub count = "N",
        /// Simulate static tests instead of drops
        pub r#static = switch under "Static tests",
        /// Largest force [default: 1 kN]
        pub load = "FORCE" under "Static tests",
        /// Energy lost as a share of the energy put in [default: 0]
        pub hysteresis = "RATIO" under "Static tests",
        /// Slack before the pad is touched [default: 0 mm]
        pub slack = "LENGTH" under "Static tests",
        /// Stiffness of the machine [default: rigid]
        pub machine_compliance = "STIFFNESS" under "Static tests",

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

/// What is asked, in SI.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The cushion.
    pub edge: EdgeCushion,
    /// Its damping, where it was assumed.
    pub assumed: Option<AssumedDamping>,
    /// What is doubtful about its stiffness.
    pub doubts: Vec<ValidityWarning>,
    /// What is done with it.
    pub plan: Plan,
    /// The number of tests.
    pub count: u16,
    /// The seed of their random numbers.
    pub seed: u64,
    /// The files that were read.
    pub inputs: Vec<PathBuf>,
}

/// What all tests share.
#[derive(Debug, Clone, Copy)]
pub enum Plan {
    /// A mass falls.
    Drop(VirtualDropOptions),
    /// A press pushes.
    Static(VirtualStaticOptions),
}

/// Keys that only drops read.
const OF_DROPS: [&str; 9] = [
    "mass",
    "height",
    "sample_rate",
    "bias",
    "zero_shift",
    "filter_corner",
    "pre_trigger",
    "bounces",
    "gravity",
];

/// Keys of forces that come with the speed.
const OF_SPEED: [&str; 2] = ["damping", "dissipation"];

/// Keys that only static tests read.
const OF_STATIC: [&str; 4] = ["load", "hysteresis", "slack", "machine_compliance"];

impl Question for VirtualTests {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let is_static = read.flag("static");
        let mass_kg = match is_static {
            true => None,
            false => read.positive("mass", Dimension::Mass),
        };
        let noise = read.share("noise");
        let edge = self.edge(&mut read, is_static, mass_kg, files);
        let count = read.whole_within("count", 1..=1000).unwrap_or(1);
        let seed = seed(&mut read).unwrap_or(DEFAULT_SEED);
        let ((edge, assumed), plan) = if is_static {
            read.idle(&OF_DROPS, "a `static` test drops nothing");
            read.idle(&OF_SPEED, "a `static` test is too slow to feel it");
            read.idle(&["pad_thickness"], "it serves warnings about drops");
            let options = presses(&mut read, noise, seed);
            (read.problems.finish(edge)?, Plan::Static(options))
        } else {
            read.idle(&OF_STATIC, "only a `static` test reads it");
            let options = drops(&mut read, mass_kg, noise, seed);
            let (edge, options) = read.problems.finish(edge.zip(options))?;
            let options = options(&edge.0.cushion);
            (edge, Plan::Drop(options))
        };
        Ok(Meant {
            doubts: match &plan {
                Plan::Drop(options) => edge.stiffness_doubts(options.mass_kg),
                Plan::Static(_) => Vec::new(),
            },
            edge,
            assumed,
            plan,
            count,
            seed,
            inputs: self.pad.input(files).into_iter().collect(),
        })
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

impl VirtualTests {
    /// The cushion, with the damping that its law needs; without damping if it is pressed slowly.
    fn edge(
        &self,
        read: &mut WordReader<'_>,
        is_static: bool,
        mass_kg: Option<f64>,
        files: &Files,
    ) -> Option<(EdgeCushion, Option<AssumedDamping>)> {
        if self.pad.words().is_empty() {
            let hint = "give `stiffness`, such as \"2190 N/mm\"";
            read.missing(&["stiffness"], "the cushion is missing", hint);
        }
        let mut words = self.pad.described(read, files)?;
        let assumed = match is_static {
            true => {
                leave_out_damping(&mut words);
                words.remove("pad_thickness");
                None
            }
            false => assume_damping(&mut words),
        };
        // A wrong mass has been told, and is not missing.
        let mass_kg = mass_kg.or(read.has("mass").then_some(1.0));
        let edge = self.pad.of_words(&words, read, mass_kg, files)?;
        Some((edge, assumed))
    }
}

fn presses(read: &mut WordReader<'_>, noise: Option<f64>, seed: u64) -> VirtualStaticOptions {
    let usual = VirtualStaticOptions::default();
    let load = read.positive("load", Dimension::Force);
    let hysteresis = read.share("hysteresis");
    let slack = read.non_negative("slack", Dimension::Length);
    VirtualStaticOptions {
        max_force_n: load.unwrap_or(usual.max_force_n),
        hysteresis_ratio: hysteresis.unwrap_or(usual.hysteresis_ratio),
        toe_m: slack.unwrap_or(usual.toe_m),
        machine_stiffness_n_m: read.positive("machine_compliance", Dimension::Stiffness),
        noise_ratio: noise.unwrap_or(usual.noise_ratio),
        seed,
        ..usual
    }
}

/// Drops onto a cushion, whose contact is the measure of what is not given.
fn drops(
    read: &mut WordReader<'_>,
    mass_kg: Option<f64>,
    noise: Option<f64>,
    seed: u64,
) -> Option<impl FnOnce(&Cushion) -> VirtualDropOptions + use<>> {
    for key in ["mass", "height"] {
        let hint = "give `mass` and `height`, or `static`";
        read.require(key, format!("a drop needs `{key}`"), hint);
    }
    let height_m = height(read);
    let gravity = read.non_negative("gravity", Dimension::Acceleration);
    let rate = read.positive("sample_rate", Dimension::Frequency);
    let bias = read.quantity("bias", Dimension::Acceleration);
    let zero_shift = read.quantity("zero_shift", Dimension::Ratio);
    let filter_corner_hz = read.positive("filter_corner", Dimension::Frequency);
    let pre_trigger = read.non_negative("pre_trigger", Dimension::Time);
    let bounces = read.whole_within("bounces", 0..=MOST_BOUNCES);
    let (mass_kg, height_m) = mass_kg.zip(height_m)?;
    Some(move |cushion: &Cushion| {
        let usual = VirtualDropOptions::from_height(cushion, mass_kg, height_m);
        VirtualDropOptions {
            gravity_m_s2: gravity.unwrap_or(usual.gravity_m_s2),
            sample_rate_hz: rate.unwrap_or(usual.sample_rate_hz),
            pre_trigger_s: pre_trigger.unwrap_or(usual.pre_trigger_s),
            noise_ratio: noise.unwrap_or(usual.noise_ratio),
            bias_m_s2: bias.unwrap_or(usual.bias_m_s2),
            zero_shift_ratio: zero_shift.unwrap_or(usual.zero_shift_ratio),
            filter_corner_hz,
            bounces: bounces.unwrap_or(usual.bounces),
            seed,
            ..usual
        }
    })
}

fn height(read: &mut WordReader<'_>) -> Option<f64> {
    let height_m = read.positive("height", Dimension::Length)?;
    if height_m > HIGHEST_M {
        let hint = "check the unit: the height of a drop test is millimeters to meters";
        let message = format!("`height`: a drop of {height_m} m is more than {HIGHEST_M} m");
        read.note(&["height"], message, hint);
    }
    Some(height_m)
}
