//! `freestand motion info`: what is in record files.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::measures::measures;
use freestand_study::processing::{Processed, Processing, process};
use freestand_study::records::{Component, MotionFile, read_motions};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::{ReadArgs, path_text};
use crate::values::Values;

/// What is in record files: every component with its peaks, intensities and duration
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion info record.AT2
  freestand motion info columns.txt --unit gal --dt \"0.01 s\"
  freestand motion info a.csv b.csv --json")]
pub(crate) struct InfoArgs {
    /// Record files
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct InfoReport {
    motions: Vec<MotionInfo>,
}

#[derive(Debug, Serialize)]
struct MotionInfo {
    path: String,
    format: &'static str,
    component: String,
    station: Option<String>,
    unit: &'static str,
    dt_s: f64,
    npts: usize,
    duration_s: f64,
    pga_m_s2: f64,
    pga_g: f64,
    pga_time_s: f64,
    pgv_m_s: f64,
    pgd_m: f64,
    arias_m_s: f64,
    cav_m_s: f64,
    d5_75_s: f64,
    d5_95_s: f64,
    first_values_m_s2: Vec<f64>,
    processing: Vec<String>,
}

pub(crate) fn run(args: &InfoArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let files = args.read.files(&args.files, &mut values);
    values.finish()?;
    let (mut motions, mut warnings, mut problems) = (Vec::new(), Vec::new(), Vec::new());
    for path in &files.paths {
        match read_motions(path, &files.read) {
            Ok(file) => {
                warnings.extend(file.notes.iter().map(|note| format!("{}: {note}", path.display())));
                match chosen(&file, files.component.as_deref()) {
                    Ok(components) => {
                        for component in components {
                            match info(&file, component, &files.processing) {
                                Ok(one) => motions.push(one),
                                Err(problem) => problems.push(problem),
                            }
                        }
                    }
                    Err(problem) => problems.push(problem),
                }
            }
            Err(error) => problems.extend(error.problems),
        }
    }
    if !problems.is_empty() {
        return Err(Failure::Problems(problems));
    }
    let report = InfoReport { motions };
    Files::begin(global, &args.files)?
        .print(printer, "freestand.motion-info/1", &report, &warnings, || text(&report.motions))?;
    Ok(Done::OK)
}

/// All components, or the one that was asked for.
fn chosen<'f>(file: &'f MotionFile, component: Option<&str>) -> Result<Vec<&'f Component>, freestand_study::Problem> {
    match component {
        Some(_) => file.select(component).map(|one| vec![one]),
        None => Ok(file.components.iter().collect()),
    }
}

fn info(
    file: &MotionFile,
    component: &Component,
    processing: &Processing,
) -> Result<MotionInfo, freestand_study::Problem> {
    let Processed { motion, steps, .. } =
        process(component, processing).map_err(|problem| problem.in_file(&file.path))?;
    let m = measures(&motion);
    Ok(MotionInfo {
        path: path_text(&file.path),
        format: file.format,
        component: component.name.clone(),
        station: component.station.clone(),
        unit: component.unit,
        dt_s: motion.dt_s(),
        npts: motion.accel_m_s2().len(),
        duration_s: motion.duration_s(),
        pga_m_s2: m.pga_m_s2,
        pga_g: m.pga_m_s2 / G0_M_S2,
        pga_time_s: m.pga_index as f64 * motion.dt_s(),
        pgv_m_s: m.pgv_m_s,
        pgd_m: m.pgd_m,
        arias_m_s: m.arias_m_s,
        cav_m_s: m.cav_m_s,
        d5_75_s: m.d5_75_s,
        d5_95_s: m.d5_95_s,
        first_values_m_s2: component.motion.accel_m_s2().iter().take(5).copied().collect(),
        processing: steps,
    })
}

fn text(motions: &[MotionInfo]) -> String {
    let headings = [
        "file",
        "format",
        "component",
        "unit",
        "dt [s]",
        "npts",
        "PGA [g]",
        "PGV [m/s]",
        "PGD [m]",
        "Arias [m/s]",
        "CAV [m/s]",
        "D5-95 [s]",
    ];
    let rows: Vec<Vec<String>> = motions
        .iter()
        .map(|one| {
            vec![
                one.path.clone(),
                one.format.to_owned(),
                one.component.clone(),
                one.unit.to_owned(),
                one.dt_s.to_string(),
                one.npts.to_string(),
                significant(one.pga_g, 4),
                significant(one.pgv_m_s, 4),
                significant(one.pgd_m, 4),
                significant(one.arias_m_s, 4),
                significant(one.cav_m_s, 4),
                significant(one.d5_95_s, 4),
            ]
        })
        .collect();
    table(&headings, &rows)
}
