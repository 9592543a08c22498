//! Motions that fit a spectrum: synthetic ones, and matched records.

use freestand::motion::Motion;
use freestand::synthesis::{
    MatchedMotion, Misfit, Resemblance, SynthesisError, SynthesisOptions, match_by_wavelets,
    match_motion, synthesize, with_pga,
};
use rayon::prelude::*;

use crate::simulated::source_problem;
use crate::target::{Target, TargetDoubt};
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::words::number;
use freestand_output::answer_of;
use strum::EnumCount;

/// How the spectrum of a record is matched to the target.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, strum::EnumString, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case", ascii_case_insensitive)]
pub enum MatchMethod {
    /// Scales wavelets, which preserves more of the record.
    #[default]
    Wavelet,
    /// Scales Fourier amplitudes, each at its own period.
    Fft,
}

impl MatchMethod {
    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// What a record was matched to, and how well.
#[derive(Debug, Clone, PartialEq)]
pub struct Matched {
    /// The method.
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
pub fn match_record(
    record: &Motion,
    target: &Target,
    method: MatchMethod,
) -> Result<MatchedMotion, Problem> {
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

/// Synthetic motions for a target, each with its own random numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct SynthRequest {
    /// The target.
    pub target: Target,
    /// Number of motions.
    pub count: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Time step, length and window.
    pub options: SynthesisOptions,
    /// The peak acceleration that half-cycles are scaled to, if any \[g\].
    pub pga_g: Option<f64>,
}

/// What a record is matched to.
#[derive(Debug, Clone, PartialEq)]
pub struct MatchRequest {
    /// The target.
    pub target: Target,
    /// How it is matched.
    pub method: MatchMethod,
    /// The peak acceleration that half-cycles are scaled to, if any \[g\].
    pub pga_g: Option<f64>,
}

/// Motions that fit a target.
#[derive(Debug, Clone)]
pub struct FitReport {
    /// The target.
    pub target: Target,
    /// Seed of synthetic motions.
    pub seed: Option<u64>,
    /// How their spectra are matched.
    pub method: MatchMethod,
    /// The motions.
    pub motions: Vec<FittedMotion>,
}

/// A motion that fits a target.
#[derive(Debug, Clone)]
pub struct FittedMotion {
    /// Name for files.
    pub name: String,
    /// The file that it was written to.
    pub path: Option<String>,
    /// The motion.
    pub motion: Motion,
    misfit: Misfit,
    /// The misfit before the peak was scaled.
    before_pga: Option<Misfit>,
    /// How similar it is to the record.
    resemblance: Option<Resemblance>,
}

/// A larger misfit causes a warning: motions for code spectra have 3 to 5 %.
const POOR_FIT_RATIO: f64 = 0.1;

/// A larger peak, relative to the target at T = 0, causes a warning.
const HIGH_PEAK_RATIO: f64 = 1.1;

/// The name of a synthetic motion, counted from 0.
pub fn synthetic_name(index: usize) -> String {
    format!("synthetic-{:02}", index + 1)
}

/// Refuses times that no synthetic motion has.
///
/// # Errors
/// A time step, a length or a window out of range.
pub fn check_layout(options: &SynthesisOptions) -> Result<(), Problems> {
    let problems: Problems = options.faults().into_iter().map(source_problem).collect();
    problems.finish(Some(()))
}

/// Makes synthetic motions.
///
/// # Errors
/// A time step, a length or a window out of range; a peak that is not reached.
pub fn synth(request: &SynthRequest) -> Result<FitReport, Problem> {
    let SynthRequest {
        target,
        count,
        seed,
        options,
        pga_g,
    } = request;
    let sa_g = |period_s| target.spectrum.sa_g(period_s);
    let made = (0..*count).into_par_iter().map(|index| {
        FittedMotion::new(
            synthetic_name(index as usize),
            synthesize(sa_g, *seed, index, options)?,
            target,
            *pga_g,
        )
    });
    let motions = made
        .collect::<Result<_, SynthesisError>>()
        .map_err(source_problem)?;
    Ok(FitReport {
        target: target.clone(),
        seed: Some(*seed),
        method: MatchMethod::Fft,
        motions,
    })
}

/// Matches a record; the motion gets this name.
///
/// # Errors
/// As [`match_record`]; a peak that is not reached.
pub fn match_one(
    record: &Motion,
    name: String,
    request: &MatchRequest,
) -> Result<FitReport, Problem> {
    let MatchRequest {
        target,
        method,
        pga_g,
    } = request;
    let matched = match_record(record, target, *method)?;
    let mut one = FittedMotion::new(name, matched, target, *pga_g).map_err(source_problem)?;
    one.resemblance = Some(Resemblance::between(record, &one.motion));
    Ok(FitReport {
        target: target.clone(),
        seed: None,
        method: *method,
        motions: vec![one],
    })
}

/// The largest peak of motions over that of their target, where that is more than it may be.
pub(crate) fn high_peak_ratio<'a>(misfits: impl Iterator<Item = &'a Misfit>) -> Option<f64> {
    let above = misfits.map(|misfit| misfit.pga_g / misfit.target_zpa_g);
    above
        .reduce(f64::max)
        .filter(|most| *most > HIGH_PEAK_RATIO)
}

/// Something that the reader of motions that fit a target must know.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum FitDoubt {
    /// About the target.
    Target(TargetDoubt),
    /// A motion does not fit it.
    Poor {
        /// The motion.
        name: String,
        /// How far it is from it.
        misfit: Misfit,
    },
    /// The peaks are up to so many times that of the target.
    HighPeak(f64),
    /// Half-cycles were scaled to its peak.
    PeakScaled {
        /// The rms misfit of the first motion before.
        before_ratio: f64,
        /// And after.
        after_ratio: f64,
    },
}

impl FitReport {
    /// What is known of the target, and about motions that do not fit it.
    pub fn doubts(&self) -> Vec<FitDoubt> {
        let poor = self
            .motions
            .iter()
            .filter(|one| one.misfit.rms_ratio > POOR_FIT_RATIO);
        let poor = poor.map(|one| FitDoubt::Poor {
            name: one.name.clone(),
            misfit: one.misfit,
        });
        let scaled = self.motions.first().and_then(|one| {
            Some(FitDoubt::PeakScaled {
                before_ratio: one.before_pga?.rms_ratio,
                after_ratio: one.misfit.rms_ratio,
            })
        });
        let high = high_peak_ratio(self.motions.iter().map(|one| &one.misfit));
        let of_target = self.target.doubts.iter().cloned().map(FitDoubt::Target);
        of_target
            .chain(poor)
            .chain(high.map(FitDoubt::HighPeak))
            .chain(scaled)
            .collect()
    }
}

impl FittedMotion {
    /// A motion whose peak is scaled to `pga_g`, if it is given.
    fn new(
        name: String,
        matched: MatchedMotion,
        target: &Target,
        pga_g: Option<f64>,
    ) -> Result<Self, SynthesisError> {
        let MatchedMotion { motion, misfit, .. } = matched;
        let one = Self {
            name,
            path: None,
            motion,
            misfit,
            before_pga: None,
            resemblance: None,
        };
        let Some(pga_g) = pga_g else { return Ok(one) };
        let MatchedMotion { motion, misfit, .. } =
            with_pga(&one.motion, |t| target.spectrum.sa_g(t), pga_g)?;
        Ok(Self {
            motion,
            before_pga: Some(one.misfit),
            misfit,
            ..one
        })
    }
}

answer_of!(FittedMotion as one {
    name: String;
    /// The file that it was written to.
    path: Option<String>;
    dt_s: f64 = one.motion.dt_s();
    npts: usize = one.motion.accel_m_s2().len();
    rms_misfit_ratio: f64 = one.misfit.rms_ratio;
    worst_misfit_ratio: f64 = one.misfit.worst_ratio;
    worst_misfit_period_s: f64 = one.misfit.worst_period_s;
    pga_g: f64 = one.misfit.pga_g;
    /// The acceleration of the target at T = 0.
    target_zpa_g: f64 = one.misfit.target_zpa_g;
    pgv_m_s: f64 = one.misfit.pgv_m_s;
    d5_95_s: f64 = one.misfit.d5_95_s;
    /// Where the peak was scaled.
    rms_misfit_before_pga_ratio: Option<f64> = one.before_pga.map(|misfit| misfit.rms_ratio);
    /// With the record.
    correlation_ratio: Option<f64> = one.resemblance.map(|kept| kept.correlation_ratio);
    /// From the record.
    husid_difference_ratio: Option<f64> = one.resemblance.map(|kept| kept.husid_difference_ratio);
});
