//! What is in record files, and the response spectrum of one of them: request → report.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::measures::{measures, rocking_measures, spectral_measures};
use freestand::motion::Motion;
use freestand::oscillator::{ResponseSpectrum, response_spectrum};
use freestand::signal::resample::upsampled_sinc;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Map, Value};

use crate::error::{Problem, ProblemKind};
use crate::figures::{Figure, FigureError, Words, record_figure, response_spectrum_figure};
use crate::processing::{Processed, process};
use crate::recorded::{MotionFiles, ReadMotion, name_of, unique};
use crate::records::{Component, Direction, MotionFile, read_motions};
use crate::tables::{columns_csv, records_csv};

/// Record files to look into.
#[derive(Debug, Clone, PartialEq)]
pub struct InfoRequest {
    /// The files; without a choice of component every one of each file is taken.
    pub files: MotionFiles,
    /// The block that the rocking measures are of.
    pub block: Option<Block>,
    /// Whether the report keeps the motions, for figures.
    pub keep_motions: bool,
}

/// What is in record files.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfoReport {
    /// One for each component, in the order of the files and within them.
    pub motions: Vec<MotionInfo>,
    /// What readers concluded or left out.
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// One component of a file. First, last, mean and sum are of the values as the file has them; the measures are of the
/// motion after `processing`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are those of the JSON document and state the units")]
pub struct MotionInfo {
    pub path: String,
    /// A name for outputs, different for each motion.
    pub name: String,
    pub format: &'static str,
    pub component: String,
    pub station: Option<String>,
    /// `horizontal` or `up`, where the file says so.
    pub direction: Option<&'static str>,
    /// Of a horizontal component, clockwise from north.
    pub azimuth_deg: Option<f64>,
    /// The unit in the file.
    pub unit: &'static str,
    pub is_raw: bool,
    pub dt_s: f64,
    pub npts: usize,
    pub duration_s: f64,
    pub pga_m_s2: f64,
    pub pga_g: f64,
    pub pga_signed_m_s2: f64,
    pub pga_index: usize,
    pub pga_time_s: f64,
    pub pgv_m_s: f64,
    pub pgd_m: f64,
    pub rms_m_s2: f64,
    pub arias_m_s: f64,
    pub cav_m_s: f64,
    pub cav_std_m_s: f64,
    pub specific_energy_density_m2_s: f64,
    pub d5_75_s: f64,
    pub d5_95_s: f64,
    pub bracketed_duration_s: f64,
    pub uniform_duration_s: f64,
    /// Housner's spectrum intensity.
    pub housner_m: f64,
    pub asi_m_s: f64,
    pub mean_period_s: Option<f64>,
    pub predominant_period_s: Option<f64>,
    /// g tan α of the block, in g; `None` without a block, as the four that follow.
    pub uplift_threshold_g: Option<f64>,
    /// PGA/(g tan α).
    pub pga_over_threshold_ratio: Option<f64>,
    /// p·PGV/(g tan α).
    pub pgv_over_threshold_ratio: Option<f64>,
    pub time_above_threshold_s: Option<f64>,
    pub excursions_above_threshold: Option<usize>,
    pub mean_m_s2: f64,
    pub sum_abs_m_s2: f64,
    /// The first five.
    pub first_values_m_s2: Vec<f64>,
    /// The last two.
    pub last_values_m_s2: Vec<f64>,
    /// What was done to the samples, one step each, in words.
    pub processing: Vec<String>,
    /// The motion, where it was to be kept.
    #[serde(skip)]
    pub motion: Option<Motion>,
}

/// Looks into the files, on the threads of the current pool; the report does not depend on them.
///
/// # Errors
/// Everything that is wrong with any of the files; one that fails hides nothing else.
pub fn info(request: &InfoRequest) -> Result<InfoReport, Vec<Problem>> {
    let each: Vec<_> = request.files.paths.par_iter().map(|path| info_of_file(path, request)).collect();
    let (mut motions, mut warnings, mut problems) = (Vec::new(), Vec::new(), Vec::new());
    let mut names = HashSet::new();
    for one in each {
        match one {
            Ok((found, notes)) => {
                motions.extend(found);
                warnings.extend(notes);
            }
            Err(found) => problems.extend(found),
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    for one in &mut motions {
        one.name = unique(&one.name, &mut names);
    }
    Ok(InfoReport { motions, warnings })
}

fn info_of_file(path: &Path, request: &InfoRequest) -> Result<(Vec<MotionInfo>, Vec<String>), Vec<Problem>> {
    let file = read_motions(path, &request.files.read).map_err(|error| error.problems)?;
    let components: Vec<&Component> = match request.files.component.as_deref() {
        Some(wanted) => vec![file.select(Some(wanted)).map_err(|problem| vec![problem])?],
        None => file.components.iter().collect(),
    };
    let each: Vec<Result<(MotionInfo, Vec<String>), Problem>> =
        components.into_par_iter().map(|component| info_of_component(&file, component, request)).collect();
    let (mut found, mut notes, mut problems) = (Vec::new(), file.notes.clone(), Vec::new());
    for one in each {
        match one {
            Ok((info, more)) => {
                notes.extend(more.into_iter().map(|note| format!("{}: {note}", info.component)));
                found.push(info);
            }
            Err(problem) => problems.push(problem),
        }
    }
    let notes = notes.iter().map(|note| format!("{}: {note}", path.display())).collect();
    if problems.is_empty() { Ok((found, notes)) } else { Err(problems) }
}

fn info_of_component(
    file: &MotionFile,
    component: &Component,
    request: &InfoRequest,
) -> Result<(MotionInfo, Vec<String>), Problem> {
    let Processed { motion, steps, notes, .. } =
        process(component, &request.files.processing).map_err(|problem| problem.in_file(&file.path))?;
    let m = measures(&motion);
    let spectral = spectral_measures(&motion);
    let rocking = request.block.map(|block| rocking_measures(&motion, &block, G0_M_S2));
    let raw = component.motion.accel_m_s2();
    let (direction, azimuth_deg) = match component.direction {
        Some(Direction::Up) => (Some("up"), None),
        Some(Direction::Azimuth(degrees)) => (Some("horizontal"), Some(degrees)),
        None => (None, None),
    };
    let info = MotionInfo {
        path: file.path.to_string_lossy().into_owned(),
        name: motion_name(file, component),
        format: file.format,
        component: component.name.clone(),
        station: component.station.clone(),
        direction,
        azimuth_deg,
        unit: component.unit,
        is_raw: component.is_raw,
        dt_s: motion.dt_s(),
        npts: motion.accel_m_s2().len(),
        duration_s: motion.duration_s(),
        pga_m_s2: m.pga_m_s2,
        pga_g: m.pga_m_s2 / G0_M_S2,
        pga_signed_m_s2: m.pga_signed_m_s2,
        pga_index: m.pga_index,
        pga_time_s: m.pga_index as f64 * motion.dt_s(),
        pgv_m_s: m.pgv_m_s,
        pgd_m: m.pgd_m,
        rms_m_s2: m.rms_m_s2,
        arias_m_s: m.arias_m_s,
        cav_m_s: m.cav_m_s,
        cav_std_m_s: m.cav_std_m_s,
        specific_energy_density_m2_s: m.specific_energy_density_m2_s,
        d5_75_s: m.d5_75_s,
        d5_95_s: m.d5_95_s,
        bracketed_duration_s: m.bracketed_duration_s,
        uniform_duration_s: m.uniform_duration_s,
        housner_m: spectral.housner_m,
        asi_m_s: spectral.asi_m_s,
        mean_period_s: spectral.mean_period_s,
        predominant_period_s: spectral.predominant_period_s,
        uplift_threshold_g: rocking.map(|r| r.uplift_threshold_m_s2 / G0_M_S2),
        pga_over_threshold_ratio: rocking.map(|r| r.pga_ratio),
        pgv_over_threshold_ratio: rocking.map(|r| r.pgv_ratio),
        time_above_threshold_s: rocking.map(|r| r.time_above_s),
        excursions_above_threshold: rocking.map(|r| r.excursions),
        mean_m_s2: component.motion.mean_m_s2(),
        sum_abs_m_s2: raw.iter().map(|a| a.abs()).sum(),
        first_values_m_s2: raw.iter().take(5).copied().collect(),
        last_values_m_s2: raw[raw.len() - 2..].to_vec(),
        processing: steps,
        motion: request.keep_motions.then_some(motion),
    };
    Ok((info, notes))
}

/// The file's name, with the component's where there are several.
fn motion_name(file: &MotionFile, component: &Component) -> String {
    let name = name_of(&file.path);
    if file.components.len() == 1 {
        return name;
    }
    format!("{name}_{}", name_of(&PathBuf::from(format!("{}.x", component.name.replace(['/', '\\'], "-")))))
}

impl InfoReport {
    /// The measures as CSV, one row for each component; the header states the units.
    ///
    /// # Errors
    /// None in practice: see [`records_csv`].
    pub fn measures_csv(&self) -> Result<Vec<u8>, Problem> {
        let rows: Vec<Map<String, Value>> = self
            .motions
            .iter()
            .map(|one| {
                // A list is no field of a table, and a table holds names, never paths.
                let mut row = Map::new();
                row.insert("motion".to_owned(), Value::from(one.name.clone()));
                if let Ok(Value::Object(all)) = serde_json::to_value(one) {
                    row.extend(
                        all.into_iter().filter(|(key, value)| !value.is_array() && key != "path" && key != "name"),
                    );
                }
                row.insert("processing".to_owned(), Value::from(one.processing.join("; ")));
                row
            })
            .collect();
        records_csv(&rows)
    }
}

impl MotionInfo {
    /// The motion as a figure; nothing where it was not kept.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn figure(&self) -> Result<Option<Figure>, FigureError> {
        let Some(motion) = &self.motion else { return Ok(None) };
        let station = self.station.as_ref().map_or(String::new(), |station| format!(", {station}"));
        let description = format!("{}, component {}{station}", self.format, self.component);
        let words = Words { name: &self.name, description: &description, processing: &self.processing };
        record_figure(words, motion).map(Some)
    }
}

/// A response spectrum to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumRequest {
    /// Damping ratios, at least one.
    pub damping_ratios: Vec<f64>,
    /// Periods; 0 is the rigid oscillator \[s\].
    pub periods_s: Vec<f64>,
    /// Samples in place of each, on the band-limited curve through them; 1: as they are.
    pub upsample: usize,
}

/// The response spectra of one motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are those of the JSON document and state the units")]
pub struct SpectrumReport {
    pub path: String,
    pub name: String,
    pub upsample: usize,
    pub processing: Vec<String>,
    pub periods_s: Vec<f64>,
    /// That of the first damping; its four arrays stand beside the periods.
    #[serde(flatten)]
    pub first: DampedSpectrum,
    /// Those of the other dampings.
    pub more: Vec<DampedSpectrum>,
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// A response spectrum at one damping.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are those of the JSON document and state the units")]
pub struct DampedSpectrum {
    pub damping_ratio: f64,
    pub sd_m: Vec<f64>,
    pub psv_m_s: Vec<f64>,
    pub psa_g: Vec<f64>,
    pub sa_g: Vec<f64>,
}

/// Most samples that a motion is refined to.
const MOST_SAMPLES: usize = 10_000_000;

/// Whether a motion of so many samples may have `factor` in place of each.
///
/// # Errors
/// More samples than a computer should hold for it.
pub fn check_upsampling(factor: usize, samples: usize) -> Result<(), Problem> {
    if samples.saturating_mul(factor) <= MOST_SAMPLES {
        return Ok(());
    }
    let message = format!("--upsample {factor} makes more than {MOST_SAMPLES} samples of {samples}");
    Err(Problem::new(ProblemKind::Value, message).hint("10 points in the shortest period are enough for 5 %"))
}

/// Computes the response spectra of a motion.
///
/// # Errors
/// Dampings or periods that no oscillator has, or more samples than can be held.
pub fn spectrum(read: &ReadMotion, request: &SpectrumRequest) -> Result<SpectrumReport, Problem> {
    let recorded = &read.motion;
    check_upsampling(request.upsample, recorded.motion.accel_m_s2().len())?;
    let motion = upsampled_sinc(&recorded.motion, request.upsample)
        .map_err(|error| Problem::new(ProblemKind::Value, error.to_string()).hint("leave --upsample out"))?;
    let mut processing = recorded.processing.clone();
    if request.upsample > 1 {
        processing.push(format!("upsampled {} times by sinc interpolation", request.upsample));
    }
    let of = |damping_ratio: f64| {
        let spectrum = response_spectrum(&motion, damping_ratio, &request.periods_s).map_err(|error| {
            Problem::new(ProblemKind::Value, error.to_string()).hint("damping from 0 to below 1, periods of 0 or more")
        })?;
        Ok(DampedSpectrum::new(damping_ratio, &spectrum))
    };
    let all: Vec<Result<DampedSpectrum, Problem>> = request.damping_ratios.par_iter().map(|&ratio| of(ratio)).collect();
    let mut all = all.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter();
    let first = all
        .next()
        .ok_or_else(|| Problem::new(ProblemKind::Value, "a spectrum needs a damping ratio").hint("5 % is usual"))?;
    let mut warnings = read.notes.clone();
    warnings.extend(short_period_warning(&request.periods_s, recorded.motion.dt_s(), request.upsample));
    Ok(SpectrumReport {
        path: recorded.path.to_string_lossy().into_owned(),
        name: recorded.name.clone(),
        upsample: request.upsample,
        processing,
        periods_s: request.periods_s.clone(),
        first,
        more: all.collect(),
        warnings,
    })
}

/// Peaks at the samples of a motion miss those between them where a period has fewer than ten.
fn short_period_warning(periods_s: &[f64], dt_s: f64, upsample: usize) -> Option<String> {
    const SAMPLES_A_PERIOD: f64 = 10.0;
    let shortest_s = periods_s.iter().copied().filter(|&t| t > 0.0).fold(f64::INFINITY, f64::min);
    // A period of ten steps, but for its last bits, has ten.
    let needed = (SAMPLES_A_PERIOD * dt_s / shortest_s * (1.0 - 1e-9)).ceil();
    (needed > upsample.max(1) as f64).then(|| {
        let given = if upsample > 1 { format!(", in {upsample} parts each") } else { String::new() };
        format!(
            "the shortest period, {shortest_s} s, has fewer than ten steps of {dt_s} s{given}: there the record says little \
             and peaks are missed; --upsample {needed} would give it ten"
        )
    })
}

impl DampedSpectrum {
    fn new(damping_ratio: f64, spectrum: &ResponseSpectrum) -> Self {
        let in_g = |values: &[f64]| values.iter().map(|a| a / G0_M_S2).collect();
        Self {
            damping_ratio,
            sd_m: spectrum.sd_m.clone(),
            psv_m_s: spectrum.psv_m_s.clone(),
            psa_g: in_g(&spectrum.psa_m_s2),
            sa_g: in_g(&spectrum.sa_m_s2),
        }
    }
}

impl SpectrumReport {
    /// The spectra of all dampings.
    pub fn all(&self) -> impl Iterator<Item = &DampedSpectrum> {
        std::iter::once(&self.first).chain(&self.more)
    }

    /// The spectra as CSV, damping by damping.
    ///
    /// # Errors
    /// None in practice: see [`columns_csv`].
    pub fn csv(&self) -> Result<Vec<u8>, Problem> {
        let joined = |of: &dyn Fn(&DampedSpectrum) -> Vec<f64>| self.all().flat_map(of).collect::<Vec<f64>>();
        columns_csv(&[
            ("period_s", &joined(&|_| self.periods_s.clone())),
            ("sd_m", &joined(&|one| one.sd_m.clone())),
            ("psv_m_s", &joined(&|one| one.psv_m_s.clone())),
            ("psa_g", &joined(&|one| one.psa_g.clone())),
            ("sa_g", &joined(&|one| one.sa_g.clone())),
            ("damping_ratio", &joined(&|one| vec![one.damping_ratio; self.periods_s.len()])),
        ])
    }

    /// The spectra as a figure.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn figure(&self) -> Result<Figure, FigureError> {
        let words = Words { name: &self.name, description: "", processing: &self.processing };
        let spectra: Vec<_> = self.all().collect();
        response_spectrum_figure(words, &self.periods_s, &spectra)
    }
}

#[cfg(test)]
mod tests;
