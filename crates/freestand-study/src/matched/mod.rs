//! Records matched to a spectrum.

mod figure;

pub use figure::{MatchedPicture, matched_figure};
use freestand::motion::Motion;
use freestand::synthesis::{MatchedMotion, Misfit, Resemblance, SynthesisOptions, match_by_wavelets, match_motion};

use crate::target::Target;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::number;

/// How the spectrum of a record is matched to the target.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum MatchMethod {
    /// Scales wavelets, which preserves more of the record.
    #[default]
    Wavelet,
    /// Scales Fourier amplitudes, each at its own period.
    Fft,
}

impl MatchMethod {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Wavelet, Self::Fft];

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wavelet => "wavelet",
            Self::Fft => "fft",
        }
    }

    /// The method with this name, in capitals or not.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name().eq_ignore_ascii_case(name.trim()))
    }
}

/// What a record was matched to, and how well.
#[derive(Debug, Clone, PartialEq)]
pub struct Matched {
    /// How.
    pub method: MatchMethod,
    /// The target.
    pub target: Target,
    /// How well the motion fits it.
    pub misfit: Misfit,
    /// How similar the motion is to the record.
    pub resemblance: Resemblance,
}

impl Matched {
    /// One step of the processing, in words.
    pub fn words(&self) -> String {
        let by = match self.method {
            MatchMethod::Wavelet => "wavelets",
            MatchMethod::Fft => "Fourier amplitudes",
        };
        format!(
            "matched to {} by {by}: rms misfit {} %, {} % at {} s; correlation with the record {}",
            self.target.one_line(),
            number(100.0 * self.misfit.rms_ratio, 2),
            number(100.0 * self.misfit.worst_ratio, 2),
            number(self.misfit.worst_period_s, 3),
            number(self.resemblance.correlation_ratio, 2)
        )
    }
}

/// The record matched to the target in thirty passes; its phases are kept.
///
/// # Errors
/// A record that is too short or has no content at some of the periods.
pub fn match_record(record: &Motion, target: &Target, method: MatchMethod) -> Result<MatchedMotion, Problem> {
    let passes = SynthesisOptions::default().passes;
    let sa_g = |period_s| target.spectrum.sa_g(period_s);
    let matched = match method {
        MatchMethod::Wavelet => match_by_wavelets(record, sa_g, passes),
        MatchMethod::Fft => match_motion(record, sa_g, passes),
    };
    matched.map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string())
            .hint("a record of 5 s or more with energy at all periods from 0.05 to 5 s is needed")
    })
}
