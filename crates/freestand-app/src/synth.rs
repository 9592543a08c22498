//! `motion synth` and `motion match`: motions that fit a target.

use freestand::synthesis::SynthesisOptions;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::Choices;
use freestand_input::written::Written;
use freestand_study::matched::{MatchMethod, MatchRequest, SynthRequest, check_layout};
use freestand_study::recorded::ReadMotion;
use freestand_study::study::{DEFAULT_MOTIONS, DEFAULT_SEED};
use freestand_study::target::Target;

use crate::files::Files;
use crate::motion::{Meant, inputs, one_record};
use crate::records::{NamedRecords, Records};
use crate::request::{Question, Request, motions, one_of, reader, request, seed};
use crate::target::TargetKeys;

/// The schema of both responses.
pub const SCHEMA: &str = "freestand.motion-synth/1";

request! { question
    /// Synthetic motions that fit a target.
    pub struct Synth {
        /// The target.
        #[command(flatten)]
        pub target: TargetKeys,
        /// Number of motions [default: 10]
        pub count = "N",
        /// Time step, at most 0.01 s [default: 0.005 s]
        pub time_step = "TIME" under "The motion",
        /// Length of the shaking including its tapers, at least 10 s [default: 40 s]
        pub shaking = "TIME" under "The motion",
        /// Duration of the window that shapes the noise, about equal to D5-95 [default: 10 s]
        pub envelope = "TIME" under "The motion",
        /// Whether the peak is that of the target.
        #[command(flatten)]
        pub peak: Peak,

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

request! { question
    /// A record matched to a target.
    pub struct Match {
        /// Record
        #[arg(value_name = "FILE")]
        pub motion: Option<Written>,
        /// Method [default: wavelet]
        pub method = "METHOD" with (value_parser = one_of(METHODS)),
        /// Whether the peak is that of the target.
        #[command(flatten)]
        pub peak: Peak,
        /// The target.
        #[command(flatten)]
        pub target: TargetKeys,
        /// How the record is read.
        #[command(flatten)]
        pub records: Records,
    }
}

request! {
    /// Whether the peak acceleration is that of the target.
    pub struct Peak under "The motion" {
        /// Scale half-cycles so that the peak acceleration is that of the target at T = 0; the fit at
        /// short periods gets worse
        pub match_pga = switch,
    }
}

/// How the spectrum of a record is matched to the target.
const METHODS: Choices<MatchMethod> = &[
    (
        MatchMethod::Wavelet,
        "wavelet",
        "Scale wavelets; keeps more of the record",
    ),
    (
        MatchMethod::Fft,
        "fft",
        "Scale the Fourier amplitudes at each period by the misfit at that period",
    ),
];

impl Question for Synth {
    type Meant = Meant<SynthRequest>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let target = self.target.matched(&mut read, files);
        let pga_g = pga_g(&mut read, target.as_ref());
        let count = motions(&mut read).unwrap_or(DEFAULT_MOTIONS);
        let seed = seed(&mut read).unwrap_or(DEFAULT_SEED);
        let options = layout(&mut read);
        let asked = target.map(|target| SynthRequest {
            target,
            count,
            seed,
            options,
            pga_g,
        });
        Ok(Meant {
            asked: read.problems.finish(asked)?,
            inputs: self.target.inputs(files),
        })
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

impl Question for Match {
    type Meant = Meant<(ReadMotion, MatchRequest)>;

    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems> {
        let (named, request) = self.judged(files)?;
        let mut inputs = inputs(&named, &self.records, files);
        inputs.extend(self.target.inputs(files));
        Ok(Meant {
            asked: (named.one()?, request),
            inputs,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

impl Match {
    fn judged<'f>(&self, files: &'f Files) -> Result<(NamedRecords<'f>, MatchRequest), Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let named = one_record(&mut read, self.motion.as_ref(), &self.records, files);
        let target = self.target.matched(&mut read, files);
        let pga_g = pga_g(&mut read, target.as_ref());
        let method = read.choice("method", METHODS).unwrap_or_default();
        let request = target.map(|target| MatchRequest {
            target,
            method,
            pga_g,
        });
        read.problems
            .finish(request.map(|request| (named, request)))
    }
}

/// The peak acceleration of the target, if motions get it.
fn pga_g(read: &mut WordReader<'_>, target: Option<&Target>) -> Option<f64> {
    let is_wanted = read.flag("match_pga");
    let peak_g = target.filter(|_| is_wanted)?.peak_g();
    read.keep("match_pga", peak_g)
}

/// The times of synthetic motions.
fn layout(read: &mut WordReader<'_>) -> SynthesisOptions {
    let usual = SynthesisOptions::default();
    let [dt_s, shaking_s, envelope_s] =
        ["time_step", "shaking", "envelope"].map(|key| read.positive(key, Dimension::Time));
    let dt_s = dt_s.unwrap_or(usual.dt_s);
    let shaking_s = shaking_s.unwrap_or(usual.shaking_s);
    let envelope_s = envelope_s.unwrap_or(usual.envelope_s);
    let all = SynthesisOptions {
        dt_s,
        shaking_s,
        envelope_s,
        ..usual
    };
    read.problems.keep_comparisons(check_layout(&all));
    all
}
