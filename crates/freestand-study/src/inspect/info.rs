//! What is in record files.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::measures::{RockingMeasures, measures, rocking_measures, spectral_measures};
use freestand::motion::Motion;
use rayon::prelude::*;

use crate::inspect::{Words, record_figure};
use crate::recorded::{Failed, MotionFiles, name_of, unique};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_output::facts;
use freestand_output::facts::{Facts, table};
use freestand_output::figure::{Figure, FigureError};
use freestand_output::table::Table;
use freestand_records::formats::{Component, Direction, MotionFile, read_motions};
use freestand_records::notes::{Note, grouped};
use freestand_records::processing::{Processed, process};

/// A request for the contents and the measures of record files.
#[derive(Debug, Clone, PartialEq)]
pub struct InfoRequest {
    /// The files; without a chosen component all components of each file.
    pub files: MotionFiles,
    /// The block of the rocking measures.
    pub block: Option<Block>,
    /// Whether the report keeps the motions, for figures.
    pub keep_motions: bool,
}

/// The contents and the measures of record files.
#[derive(Debug, Clone, PartialEq)]
pub struct InfoReport {
    /// One for each component, in the order of the files and within them.
    pub motions: Vec<MotionInfo>,
    /// Files that could not be read or processed, in their order.
    pub failed: Vec<Failed>,
    /// What readers concluded or ignored.
    pub warnings: Vec<String>,
}

/// One component of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionInfo {
    path: String,
    /// A name for outputs, different for each motion.
    pub name: String,
    /// The component.
    pub component: String,
    /// Format, component and station, for a figure.
    description: String,
    /// What was done to the samples, one step each.
    processing: Vec<String>,
    /// What is in it and its measures. First and last values, mean and sum are those of the file;
    /// the measures, and the values called processed, those of the motion after `processing`.
    facts: Facts<'static>,
    /// The motion, where it was kept.
    motion: Option<Motion>,
}

/// Reads the files, on the threads of the current pool; the report does not depend on their number.
///
/// # Errors
/// Everything that is wrong with the only file, or with all of several; otherwise the report lists
/// the files that failed.
pub fn info(request: &InfoRequest) -> Result<InfoReport, Problems> {
    let each: Vec<_> = request
        .files
        .paths
        .par_iter()
        .map(|path| info_of_file(path, request))
        .collect();
    let mut report = InfoReport {
        motions: Vec::new(),
        failed: Vec::new(),
        warnings: Vec::new(),
    };
    let mut notes = Vec::new();
    for (path, found) in request.files.paths.iter().zip(each) {
        report.motions.extend(found.motions);
        let name = path.to_string_lossy();
        notes.extend(found.notes.into_iter().map(|note| (name.clone(), note)));
        report.failed.extend(
            found
                .problems
                .into_iter()
                .map(|problem| Failed::new(path, problem)),
        );
    }
    report.warnings = grouped(notes.iter().map(|(name, note)| (name, note)));
    if !report.failed.is_empty() && (report.motions.is_empty() || request.files.paths.len() == 1) {
        return Err(report.failed.into_iter().map(|one| one.problem).collect());
    }
    let mut names = HashSet::new();
    for one in &mut report.motions {
        one.name = unique(&one.name, &mut names);
    }
    Ok(report)
}

/// The results of one file.
#[derive(Debug, Default)]
struct Found {
    motions: Vec<MotionInfo>,
    notes: Vec<Note>,
    problems: Problems,
}

fn info_of_file(path: &Path, request: &InfoRequest) -> Found {
    let file = match read_motions(path, &request.files.read) {
        Ok(file) => file,
        Err(error) => {
            return Found {
                problems: error,
                ..Found::default()
            };
        }
    };
    let components: Vec<&Component> = match request.files.component.as_deref() {
        Some(wanted) => match file.select(Some(wanted)) {
            Ok(component) => vec![component],
            Err(problem) => {
                return Found {
                    problems: problem.into(),
                    ..Found::default()
                };
            }
        },
        None => file.components.iter().collect(),
    };
    let count = components.len();
    let of = |component: &Component| {
        info_of_component(&file, component, request).map_err(|mut problem| {
            if count > 1 {
                problem.message = format!(
                    "component {}: {}",
                    shorten(&component.name),
                    problem.message
                );
            }
            problem
        })
    };
    let each: Vec<Result<(MotionInfo, Vec<Note>), Problem>> =
        components.into_par_iter().map(of).collect();
    let mut found = Found {
        notes: file.notes.clone(),
        ..Found::default()
    };
    for one in each {
        match one {
            Ok((info, more)) => {
                found
                    .notes
                    .extend(more.into_iter().map(|note| note.about(&info.component)));
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
) -> Result<(MotionInfo, Vec<Note>), Problem> {
    let Processed {
        motion,
        steps,
        notes,
        scale_ratio,
    } = process(component, &request.files.processing)
        .map_err(|problem| problem.in_file(&file.path))?;
    let rocking = request
        .block
        .map(|block| rocking_measures(&motion, &block, G0_M_S2));
    let raw = component.motion.accel_m_s2();
    let (direction, azimuth_deg) = match component.direction {
        Some(Direction::Up) => (Some("up"), None),
        Some(Direction::Azimuth(degrees)) => (Some("horizontal"), Some(degrees)),
        None => (None, None),
    };
    let of_block = |value: fn(&RockingMeasures) -> f64| rocking.as_ref().map(value);
    let facts = Facts::default()
        .fact("format", "format", file.format)
        .fact("component", "component", component.name.clone())
        .fact("station", "station", component.station.clone())
        .fact("direction", "direction", direction)
        .fact("azimuth_deg", "azimuth", azimuth_deg)
        .fact("unit", "unit in the file", component.unit)
        .fact("is_raw", "raw", component.is_raw)
        .fact("dt_s", "time step", motion.dt_s())
        .fact("npts", "samples", motion.accel_m_s2().len())
        .fact("duration_s", "duration", motion.duration_s())
        .and(measure_facts(&motion))
        .fact(
            "uplift_threshold_g",
            "uplift threshold g tan α",
            of_block(|r| r.uplift_threshold_m_s2 / G0_M_S2),
        )
        .fact(
            "pga_over_threshold_ratio",
            "PGA/(g tan α)",
            of_block(|r| r.pga_ratio),
        )
        .fact(
            "pgv_over_threshold_ratio",
            "p PGV/(g tan α)",
            of_block(|r| r.pgv_ratio),
        )
        .fact(
            "time_above_threshold_s",
            "time above the threshold",
            of_block(|r| r.time_above_s),
        )
        .fact(
            "excursions_above_threshold",
            "  excursions",
            rocking.map(|r| r.excursions),
        )
        .key("mean_m_s2", component.motion.mean_m_s2())
        .key("sum_abs_m_s2", raw.iter().map(|a| a.abs()).sum::<f64>())
        .key("first_values_m_s2", first(raw))
        .key("last_values_m_s2", last(raw))
        .key("processed_first_values_m_s2", first(motion.accel_m_s2()))
        .key("processed_last_values_m_s2", last(motion.accel_m_s2()))
        .key("scale_ratio", scale_ratio)
        .fact("processing", "processing", steps.clone());
    let station = component
        .station
        .as_ref()
        .map_or(String::new(), |station| format!(", {station}"));
    let info = MotionInfo {
        path: file.path.to_string_lossy().into_owned(),
        name: motion_name(file, component),
        component: component.name.clone(),
        description: format!("{}, component {}{station}", file.format, component.name),
        processing: steps,
        facts,
        motion: request.keep_motions.then_some(motion),
    };
    Ok((info, notes))
}

/// The measures of a motion: peaks, intensities, durations and periods.
pub fn measure_facts(motion: &Motion) -> Facts<'static> {
    let m = measures(motion);
    let spectral = spectral_measures(motion);
    Facts::default()
        .key("pga_m_s2", m.pga_m_s2)
        .fact("pga_g", "PGA", m.pga_m_s2 / G0_M_S2)
        .fact("pga_signed_m_s2", "  with its sign", m.pga_signed_m_s2)
        .key("pga_index", m.pga_index)
        .fact("pga_time_s", "  at", m.pga_index as f64 * motion.dt_s())
        .and(facts!(m; pgv_m_s "PGV", pgd_m "PGD", rms_m_s2 "RMS acceleration", arias_m_s "Arias intensity",
            cav_m_s "CAV", cav_std_m_s "CAV, standardised", specific_energy_density_m2_s "specific energy density",
            d5_75_s "significant duration D5-75", d5_95_s "significant duration D5-95",
            bracketed_duration_s "bracketed duration, 0.05 g", uniform_duration_s "uniform duration, 0.05 g"))
        .and(facts!(spectral; housner_m "Housner intensity", asi_m_s "ASI", mean_period_s "mean period",
            predominant_period_s "predominant period"))
}

fn first(values: &[f64]) -> &[f64] {
    &values[..values.len().min(5)]
}

fn last(values: &[f64]) -> &[f64] {
    &values[values.len().saturating_sub(2)..]
}

/// The file's name, with the component's where there are several.
fn motion_name(file: &MotionFile, component: &Component) -> String {
    let name = name_of(&file.path);
    if file.components.len() == 1 {
        return name;
    }
    format!(
        "{name}_{}",
        name_of(&PathBuf::from(format!(
            "{}.x",
            component.name.replace(['/', '\\'], "-")
        )))
    )
}

impl InfoReport {
    /// The document of `freestand motion info`.
    pub fn facts(&self) -> Facts<'_> {
        let motions = Facts::default().key(
            "motions",
            self.motions
                .iter()
                .map(MotionInfo::facts)
                .collect::<Vec<_>>(),
        );
        let failed = self
            .failed
            .iter()
            .map(|one| one.facts().key("hint", one.problem.hint.as_deref()));
        motions.key("failed", failed.collect::<Vec<_>>())
    }

    /// The measures as CSV, one row for each component; the header states the units.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn measures_table(&self) -> Result<Table, Problem> {
        // A table holds names, never paths.
        table(self.motions.iter().map(|one| {
            let row = Facts::default()
                .key("motion", one.name.as_str())
                .and(one.facts.clone());
            row.key("processing", one.processing.join("; "))
        }))
    }
}

impl MotionInfo {
    /// Its part of the document.
    pub fn facts(&self) -> Facts<'_> {
        let named = Facts::default()
            .fact("path", "file", self.path.as_str())
            .key("name", self.name.as_str());
        named.and(self.facts.clone())
    }

    /// The motion as a figure; `None` where it was not kept.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn figure(&self) -> Result<Option<Figure>, FigureError> {
        let Some(motion) = &self.motion else {
            return Ok(None);
        };
        let words = Words {
            name: &self.name,
            description: &self.description,
            processing: &self.processing,
        };
        record_figure(words, motion).map(Some)
    }
}
