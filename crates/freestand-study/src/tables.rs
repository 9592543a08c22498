//! The result as tables: CSV with a header, comma, LF, shortest numbers that read back the same; a missing value is an
//! empty field.

use crate::error::{Problem, ProblemKind};
use crate::result::{ObjectResponse, Ranked, StudyResult};
use crate::study::Study;

/// Rows of text as CSV.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
fn csv(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<Vec<u8>, Problem> {
    let broken = |error: csv::Error| Problem::new(ProblemKind::Io, format!("a table cannot be written: {error}"));
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::Any(b'\n')).from_writer(Vec::new());
    writer.write_record(header).map_err(broken)?;
    for row in rows {
        writer.write_record(row).map_err(broken)?;
    }
    writer.into_inner().map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// Records of a serializable type as CSV: field names as the header, `None` as an empty field.
///
/// # Errors
/// None in practice: memory does not fail.
pub fn records_csv<T: serde::Serialize>(records: &[T]) -> Result<Vec<u8>, Problem> {
    let broken = |error: csv::Error| Problem::new(ProblemKind::Io, format!("a table cannot be written: {error}"));
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::Any(b'\n')).from_writer(Vec::new());
    for record in records {
        writer.serialize(record).map_err(broken)?;
    }
    writer.into_inner().map_err(|error| broken(csv::Error::from(error.into_error())))
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// One row for each motion, level and object, in this order; `extra` are the columns behind the common ones.
fn by_object(
    study: &Study,
    result: &StudyResult,
    extra: &[&str],
    cells: impl Fn(&ObjectResponse) -> Vec<String>,
) -> Result<Vec<u8>, Problem> {
    let mut header = vec![
        "motion",
        "level",
        "height_m",
        "thickness_m",
        "outcome",
        "uplift_m",
        "cg_rise_m",
        "edge_acceleration_g",
        "ceiling_g",
    ];
    header.extend_from_slice(extra);
    header.push("reason");
    let rows = result.ground.iter().enumerate().flat_map(|(motion, ground)| {
        let cells = &cells;
        result.levels.iter().flat_map(move |level| {
            study.objects.blocks.iter().zip(&level.responses[motion]).map(move |(block, response)| {
                let mut row = vec![
                    ground.name.clone(),
                    level.level.name.clone(),
                    block.height_m().to_string(),
                    block.thickness_m().to_string(),
                ];
                match response {
                    ObjectResponse::Done { uplift, shock } => row.extend([
                        uplift.outcome.name().to_owned(),
                        uplift.uplift_m.to_string(),
                        uplift.cg_rise_m.to_string(),
                        optional(shock.edge_acceleration_g),
                        shock.ceiling_g.to_string(),
                    ]),
                    ObjectResponse::Failed(_) => {
                        row.push("failed".to_owned());
                        row.extend(std::iter::repeat_n(String::new(), 4));
                    }
                }
                row.extend(cells(response));
                row.push(match response {
                    ObjectResponse::Done { .. } => String::new(),
                    ObjectResponse::Failed(reason) => reason.clone(),
                });
                row
            })
        })
    });
    csv(&header, rows)
}

/// `urs.csv`: the uplift response spectra, one row for each motion, level and object.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn urs_csv(study: &Study, result: &StudyResult) -> Result<Vec<u8>, Problem> {
    by_object(study, result, &["peak_rotation_rad", "impact_count", "impact_omega_rad_s"], |response| match response {
        ObjectResponse::Done { uplift, .. } => vec![
            uplift.peak_rotation_rad.to_string(),
            uplift.impact_count.to_string(),
            uplift.impact_omega_rad_s().to_string(),
        ],
        ObjectResponse::Failed(_) => vec![String::new(); 3],
    })
}

/// `srs.csv`: the shock spectra, from both sources of the energy at impact.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn srs_csv(study: &Study, result: &StudyResult) -> Result<Vec<u8>, Problem> {
    by_object(study, result, &["edge_acceleration_impact_velocity_g"], |response| match response {
        ObjectResponse::Done { shock, .. } => vec![optional(shock.edge_acceleration_impact_velocity_g)],
        ObjectResponse::Failed(_) => vec![String::new()],
    })
}

/// `statistics.csv`: quantiles over all motions, one row for each level and object.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn statistics_csv(study: &Study, result: &StudyResult) -> Result<Vec<u8>, Problem> {
    let header = [
        "level",
        "height_m",
        "thickness_m",
        "motions",
        "uplift_share",
        "overturned_share",
        "uplift_m_p16",
        "uplift_m_median",
        "uplift_m_p84",
        "edge_acceleration_g_p16",
        "edge_acceleration_g_median",
        "edge_acceleration_g_p84",
        "edge_acceleration_impact_velocity_g_p16",
        "edge_acceleration_impact_velocity_g_median",
        "edge_acceleration_impact_velocity_g_p84",
        "edge_acceleration_g_median_of_survivors",
        "edge_acceleration_g_max_of_survivors",
        "ceiling_g",
    ];
    let rows = result.levels.iter().flat_map(|level| {
        study.objects.blocks.iter().zip(&level.statistics).map(|(block, statistics)| {
            let mut row = vec![level.level.name.clone(), block.height_m().to_string(), block.thickness_m().to_string()];
            let Some(s) = statistics else {
                row.push("0".to_owned());
                row.resize(header.len(), String::new());
                return row;
            };
            row.extend([s.motions.to_string(), s.uplift_share.to_string(), s.overturned_share.to_string()]);
            for quantiles in [s.uplift_m, s.edge_acceleration_g, s.edge_acceleration_impact_velocity_g] {
                row.extend(quantiles.map(Ranked::cell));
            }
            row.extend([
                optional(s.edge_acceleration_survivors_g),
                optional(s.edge_acceleration_max_g),
                s.ceiling_g.to_string(),
            ]);
            row
        })
    });
    csv(&header, rows)
}
