//! What is in record files.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::measures::{
    Measures, RockingMeasures, SpectralMeasures, measures, rocking_measures, spectral_measures,
};
use freestand::motion::Motion;
use rayon::prelude::*;

use crate::recorded::{Failed, MotionFiles, name_of};
use freestand_input::file_names;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_output::answer::Answer;
use freestand_output::facts::{Facts, table};
use freestand_output::table::Table;
use freestand_output::{answer, answer_of};
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
    /// The figures that were written.
    pub plots: Vec<String>,
    /// What readers concluded or ignored.
    pub warnings: Vec<String>,
}

/// One component of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionInfo {
    path: String,
    /// A name for outputs, different for each motion.
    pub name: String,
    /// What is in it.
    pub contents: Contents,
    /// The motion, where it was kept.
    pub motion: Option<Motion>,
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
        plots: Vec::new(),
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
        one.name = file_names::unique(&one.name, &mut names);
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
    let refused = |problems: Problems| Found {
        problems,
        ..Found::default()
    };
    let file = match read_motions(path, &request.files.read) {
        Ok(file) => file,
        Err(problems) => return refused(problems),
    };
    let components: Vec<&Component> = match request.files.component.as_deref() {
        Some(wanted) => match file.select(Some(wanted)) {
            Ok(component) => vec![component],
            Err(problem) => return refused(problem.into()),
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
                found.notes.extend(
                    more.into_iter()
                        .map(|note| note.about(&info.contents.component)),
                );
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
    let info = MotionInfo {
        path: file.path.to_string_lossy().into_owned(),
        name: motion_name(file, component),
        contents: Contents::of(component, file, &motion, rocking, scale_ratio, steps),
        motion: request.keep_motions.then_some(motion),
    };
    Ok((info, notes))
}

answer! {
    /// What is in a component, and its measures. First and last values, mean and sum are those of the file;
    /// the measures, and the values called processed, those of the motion after `processing`.
    pub struct Contents of (
        component: &Component,
        file: &MotionFile,
        motion: &Motion,
        rocking: Option<RockingMeasures>,
        scale_ratio: f64,
        processing: Vec<String>,
    ) {
        format: &'static str = file.format => "format";
        component: String = component.name.clone() => "component";
        station: Option<String> => "station";
        /// up or horizontal, where the file says so.
        direction: Option<&'static str> = component.direction.map(direction_name) => "direction";
        azimuth_deg: Option<f64> = component.direction.and_then(direction_deg) => "azimuth";
        unit: &'static str => "unit in the file";
        /// Whether the values of the file include the offset of the instrument.
        is_raw: bool => "raw";
        dt_s: f64 = motion.dt_s() => "time step";
        npts: usize = motion.accel_m_s2().len() => "samples";
        duration_s: f64 = motion.duration_s() => "duration";
        measures: MotionMeasures = MotionMeasures::of(motion) => flat;
        above_threshold: AboveThreshold = AboveThreshold(rocking) => flat;
        /// Of the file.
        mean_m_s2: f64 = component.motion.mean_m_s2();
        /// Of the file.
        sum_abs_m_s2: f64 = component.motion.accel_m_s2().iter().map(|a| a.abs()).sum::<f64>();
        /// Five of the file.
        first_values_m_s2: Vec<f64> = first(component.motion.accel_m_s2());
        /// Two of the file.
        last_values_m_s2: Vec<f64> = last(component.motion.accel_m_s2());
        /// Five of the processed motion.
        processed_first_values_m_s2: Vec<f64> = first(motion.accel_m_s2());
        /// Two of the processed motion.
        processed_last_values_m_s2: Vec<f64> = last(motion.accel_m_s2());
        /// The factor of the samples.
        scale_ratio: f64 = scale_ratio;
        /// What was done to the samples, one step each.
        processing: Vec<String> = processing => "processing";
    }
}

/// The measures of a motion: peaks, intensities, durations and periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionMeasures {
    of_time: Measures,
    spectral: SpectralMeasures,
    dt_s: f64,
}

impl MotionMeasures {
    /// Those of a motion.
    pub fn of(motion: &Motion) -> Self {
        Self {
            of_time: measures(motion),
            spectral: spectral_measures(motion),
            dt_s: motion.dt_s(),
        }
    }
}

answer_of!(MotionMeasures as m {
    pga_m_s2: f64 = m.of_time.pga_m_s2;
    pga_g: f64 = m.of_time.pga_m_s2 / G0_M_S2 => "PGA";
    /// The peak with its sign.
    pga_signed_m_s2: f64 = m.of_time.pga_signed_m_s2 => "  with its sign";
    pga_index: usize = m.of_time.pga_index;
    pga_time_s: f64 = m.of_time.pga_index as f64 * m.dt_s => "  at";
    pgv_m_s: f64 = m.of_time.pgv_m_s => "PGV";
    pgd_m: f64 = m.of_time.pgd_m => "PGD";
    rms_m_s2: f64 = m.of_time.rms_m_s2 => "RMS acceleration";
    arias_m_s: f64 = m.of_time.arias_m_s => "Arias intensity";
    cav_m_s: f64 = m.of_time.cav_m_s => "CAV";
    cav_std_m_s: f64 = m.of_time.cav_std_m_s => "CAV, standardised";
    specific_energy_density_m2_s: f64 = m.of_time.specific_energy_density_m2_s => "specific energy density";
    d5_75_s: f64 = m.of_time.d5_75_s => "significant duration D5-75";
    d5_95_s: f64 = m.of_time.d5_95_s => "significant duration D5-95";
    bracketed_duration_s: f64 = m.of_time.bracketed_duration_s => "bracketed duration, 0.05 g";
    uniform_duration_s: f64 = m.of_time.uniform_duration_s => "uniform duration, 0.05 g";
    housner_m: f64 = m.spectral.housner_m => "Housner intensity";
    asi_m_s: f64 = m.spectral.asi_m_s => "ASI";
    mean_period_s: Option<f64> = m.spectral.mean_period_s => "mean period";
    predominant_period_s: Option<f64> = m.spectral.predominant_period_s => "predominant period";
});

/// How far a motion is above the acceleration that uplifts a block, if one is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AboveThreshold(Option<RockingMeasures>);

answer_of!(AboveThreshold as of {
    uplift_threshold_g: Option<f64> =
        of.0.map(|r| r.uplift_threshold_m_s2 / G0_M_S2) => "uplift threshold g tan α";
    pga_over_threshold_ratio: Option<f64> = of.0.map(|r| r.pga_ratio) => "PGA/(g tan α)";
    pgv_over_threshold_ratio: Option<f64> = of.0.map(|r| r.pgv_ratio) => "p PGV/(g tan α)";
    time_above_threshold_s: Option<f64> = of.0.map(|r| r.time_above_s) => "time above the threshold";
    excursions_above_threshold: Option<usize> = of.0.map(|r| r.excursions) => "  excursions";
});

/// What a file says of the direction of a component.
fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Up => "up",
        Direction::Azimuth(_) => "horizontal",
    }
}

/// Its azimuth \[degrees\].
fn direction_deg(direction: Direction) -> Option<f64> {
    match direction {
        Direction::Up => None,
        Direction::Azimuth(degrees) => Some(degrees),
    }
}

fn first(values: &[f64]) -> Vec<f64> {
    values[..values.len().min(5)].to_vec()
}

fn last(values: &[f64]) -> Vec<f64> {
    values[values.len().saturating_sub(2)..].to_vec()
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

answer_of!(InfoReport as report {
    motions: Vec<&MotionInfo> = report.motions.iter().collect();
    /// Files that could not be read or processed.
    failed: Vec<FailedFile<'_>> = report.failed.iter().map(FailedFile).collect();
    /// The figures that were written.
    plots: Vec<String>;
});

answer_of!(
    /// A file that could not be read, and what to do.
    struct FailedFile<'r>(&'r Failed) as file {
    failed: &Failed = file.0 => flat;
    /// What to do.
    hint: Option<String> = file.0.problem.hint.clone();
});

answer_of!(MotionInfo as one {
    path: String => "file";
    name: String;
    contents: &Contents = &one.contents => flat;
});

impl InfoReport {
    /// The measures as CSV, one row for each component; the header states the units.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn measures_table(&self) -> Result<Table, Problem> {
        // A table holds names, never paths.
        table(self.motions.iter().map(|one| {
            let row = Facts::default()
                .key("motion", one.name.as_str())
                .and(one.contents.facts());
            row.key("processing", one.contents.processing.join("; "))
        }))
    }
}

impl MotionInfo {}
