//! What is in record files.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::measures::{measures, rocking_measures, spectral_measures};
use freestand::motion::Motion;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Map, Value};

use super::failed::{Failed, Found};
use crate::inspect::{Words, record_figure};
use crate::recorded::{MotionFiles, name_of, unique};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_output::figure::{Figure, FigureError};
use freestand_output::rows::records_csv;
use freestand_records::formats::{Component, Direction, MotionFile, read_motions};
use freestand_records::processing::{Processed, process};

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
    /// What could not be read or processed, in the order of the files.
    pub failed: Vec<Failed>,
    /// What readers concluded or left out.
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// One component of a file. First, last, mean and sum are of the values as the file has them; the measures, and the values
/// that are called processed, are of the motion after `processing`.
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
    /// The first five after `processing`.
    pub processed_first_values_m_s2: Vec<f64>,
    /// The last two after `processing`.
    pub processed_last_values_m_s2: Vec<f64>,
    /// The factor on the samples, with every digit.
    pub scale_ratio: f64,
    /// What was done to the samples, one step each, in words.
    pub processing: Vec<String>,
    /// The motion, where it was to be kept.
    #[serde(skip)]
    pub motion: Option<Motion>,
}

/// Looks into the files, on the threads of the current pool; the report does not depend on them.
///
/// # Errors
/// Everything that is wrong with the only file, or with all of several; of others the report has what is right, and
/// lists what failed.
pub fn info(request: &InfoRequest) -> Result<InfoReport, Vec<Problem>> {
    let each: Vec<_> = request.files.paths.par_iter().map(|path| info_of_file(path, request)).collect();
    let mut report = InfoReport { motions: Vec::new(), failed: Vec::new(), warnings: Vec::new() };
    for (path, found) in request.files.paths.iter().zip(each) {
        report.motions.extend(found.motions);
        report.warnings.extend(found.notes.iter().map(|note| format!("{}: {note}", path.display())));
        report.failed.extend(found.problems.into_iter().map(|problem| Failed::new(path, problem)));
    }
    if !report.failed.is_empty() && (report.motions.is_empty() || request.files.paths.len() == 1) {
        return Err(report.failed.into_iter().map(|one| one.problem).collect());
    }
    let mut names = HashSet::new();
    for one in &mut report.motions {
        one.name = unique(&one.name, &mut names);
    }
    Ok(report)
}

fn info_of_file(path: &Path, request: &InfoRequest) -> Found {
    let file = match read_motions(path, &request.files.read) {
        Ok(file) => file,
        Err(error) => return Found { problems: error.problems, ..Found::default() },
    };
    let components: Vec<&Component> = match request.files.component.as_deref() {
        Some(wanted) => match file.select(Some(wanted)) {
            Ok(component) => vec![component],
            Err(problem) => return Found { problems: vec![problem], ..Found::default() },
        },
        None => file.components.iter().collect(),
    };
    let count = components.len();
    let of = |component: &Component| {
        info_of_component(&file, component, request).map_err(|mut problem| {
            if count > 1 {
                problem.message = format!("component {}: {}", shorten(&component.name), problem.message);
            }
            problem
        })
    };
    let each: Vec<Result<(MotionInfo, Vec<String>), Problem>> = components.into_par_iter().map(of).collect();
    let mut found = Found { notes: file.notes.clone(), ..Found::default() };
    for one in each {
        match one {
            Ok((info, more)) => {
                found.notes.extend(more.into_iter().map(|note| format!("{}: {note}", info.component)));
                found.motions.push(info);
            }
            Err(problem) => found.problems.push(problem),
        }
    }
    found
}

fn info_of_component(
    file: &MotionFile,
    component: &Component,
    request: &InfoRequest,
) -> Result<(MotionInfo, Vec<String>), Problem> {
    let Processed { motion, steps, notes, scale_ratio } =
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
        first_values_m_s2: first(raw),
        last_values_m_s2: last(raw),
        processed_first_values_m_s2: first(motion.accel_m_s2()),
        processed_last_values_m_s2: last(motion.accel_m_s2()),
        scale_ratio,
        processing: steps,
        motion: request.keep_motions.then_some(motion),
    };
    Ok((info, notes))
}

fn first(values: &[f64]) -> Vec<f64> {
    values.iter().take(5).copied().collect()
}

fn last(values: &[f64]) -> Vec<f64> {
    values.iter().skip(values.len().saturating_sub(2)).copied().collect()
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
