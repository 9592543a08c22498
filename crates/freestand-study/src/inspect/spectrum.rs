//! The response spectra of one motion.

use freestand::oscillator::response_spectrum;
use freestand::signal::resample::{MAX_LENGTH, upsampled_sinc};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use crate::doubt::MotionDoubt;
use crate::inspect::DampedSpectrum;
use crate::recorded::ReadMotion;
use freestand_input::problem::Problem;
use freestand_output::rows::table_of_columns;
use freestand_output::table::Table;
use freestand_records::notes::Note;
use freestand_records::processing::samples_needed;

/// A response spectrum to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumRequest {
    /// Damping ratios, at least one.
    pub damping_ratios: Vec<f64>,
    /// Periods; 0 is the rigid oscillator \[s\].
    pub periods_s: Vec<f64>,
    /// Number of samples that replace each sample, on the band-limited curve through all of them;
    /// 1: none are added.
    pub upsample: usize,
}

/// The response spectra of one motion.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[expect(
    missing_docs,
    reason = "the names are those of the JSON document and state the units"
)]
pub struct SpectrumReport {
    pub path: String,
    pub name: String,
    pub upsample: usize,
    pub processing: Vec<String>,
    /// The factor applied to the samples, with all digits.
    pub scale_ratio: f64,
    pub periods_s: Vec<f64>,
    /// The spectrum at the first damping; its four arrays are next to the periods in the document.
    #[serde(flatten)]
    pub first: DampedSpectrum,
    /// The spectra at the other dampings.
    pub more: Vec<DampedSpectrum>,
    #[serde(skip)]
    pub doubts: Vec<MotionDoubt>,
}

/// Checks that a motion of so many samples can be upsampled by `factor`; 0 and 1 change nothing.
///
/// # Errors
/// More than [`MAX_LENGTH`] samples, the bound of resampling.
pub fn check_upsampling(factor: usize, samples: usize) -> Result<(), Problem> {
    if factor <= 1 || samples.saturating_mul(factor) <= MAX_LENGTH {
        return Ok(());
    }
    let message = format!(
        "upsampling {samples} samples {factor} times gives more than resampling allows ({MAX_LENGTH})"
    );
    Err(Problem::value(message, ENOUGH))
}

const ENOUGH: &str =
    "reduce `upsample`: ten samples in the shortest period are enough for a damping of 5 %";

/// Computes the response spectra of a motion.
///
/// # Errors
/// Invalid dampings or periods, or too many samples.
pub fn spectrum(read: &ReadMotion, request: &SpectrumRequest) -> Result<SpectrumReport, Problem> {
    let recorded = &read.motion;
    check_upsampling(request.upsample, recorded.motion.accel_m_s2().len())?;
    let motion = upsampled_sinc(&recorded.motion, request.upsample)
        .map_err(|error| Problem::value(error.to_string(), ENOUGH))?;
    let mut processing = recorded.processing.clone();
    if request.upsample > 1 {
        processing.push(format!(
            "upsampled {} times by sinc interpolation",
            request.upsample
        ));
    }
    let of = |damping_ratio: f64| {
        let spectrum =
            response_spectrum(&motion, damping_ratio, &request.periods_s).map_err(|error| {
                Problem::value(
                    error.to_string(),
                    "damping from 0 to below 1, periods of 0 or more",
                )
            })?;
        Ok(DampedSpectrum::new(damping_ratio, &spectrum))
    };
    let all: Vec<Result<DampedSpectrum, Problem>> = request
        .damping_ratios
        .par_iter()
        .map(|&ratio| of(ratio))
        .collect();
    let mut all = all.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter();
    let first = all.next().ok_or_else(|| {
        Problem::value("a spectrum needs a damping ratio", "give one, such as 5 %")
    })?;
    let notes = read.notes.iter().map(Note::to_string);
    let (dt_s, upsample) = (recorded.motion.dt_s(), request.upsample);
    let few = samples_needed(&request.periods_s, dt_s, upsample);
    let few = few.map(|(shortest_s, needed)| MotionDoubt::FewSteps {
        shortest_s,
        dt_s,
        upsample,
        needed,
    });
    Ok(SpectrumReport {
        path: recorded.path.to_string_lossy().into_owned(),
        name: recorded.name.clone(),
        upsample: request.upsample,
        processing,
        scale_ratio: recorded.scale_ratio,
        periods_s: request.periods_s.clone(),
        first,
        more: all.collect(),
        doubts: notes.map(MotionDoubt::OfRecords).chain(few).collect(),
    })
}

impl SpectrumReport {
    /// The spectra of all dampings.
    pub fn all(&self) -> impl Iterator<Item = &DampedSpectrum> {
        std::iter::once(&self.first).chain(&self.more)
    }

    /// The spectra as a table, damping by damping.
    ///
    /// # Errors
    /// None in practice: see [`table_of_columns`].
    pub fn table(&self) -> Result<Table, Problem> {
        let joined = |of: &dyn Fn(&DampedSpectrum) -> Vec<f64>| {
            self.all().flat_map(of).collect::<Vec<f64>>()
        };
        table_of_columns(&[
            ("period_s", &joined(&|_| self.periods_s.clone())),
            ("sd_m", &joined(&|one| one.sd_m.clone())),
            ("psv_m_s", &joined(&|one| one.psv_m_s.clone())),
            ("psa_g", &joined(&|one| one.psa_g.clone())),
            ("sa_g", &joined(&|one| one.sa_g.clone())),
            (
                "damping_ratio",
                &joined(&|one| vec![one.damping_ratio; self.periods_s.len()]),
            ),
        ])
    }
}
