//! The result as tables: CSV with a header, comma, LF, shortest numbers that read back the same; a
//! missing value is an empty field.

use freestand_output::rows::{csv, optional};

use crate::result::{FloorProfile, ObjectResponse, Ranked, StudyResult};
use crate::statistics::{QUANTILES, ranked_quantile};
use crate::study::Study;
use freestand_input::problem::Problem;
use freestand_input::words::shortest;

/// One row for each motion, level and object, in this order; `extra` are the columns after the
/// common ones.
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
    header.extend(["direction_deg", "reason"]);
    let rows = result.motions.iter().enumerate().flat_map(|(motion, name)| {
        let cells = &cells;
        result.levels.iter().flat_map(move |level| {
            study.objects.blocks.iter().zip(&level.responses[motion]).map(move |(block, response)| {
                let mut row = vec![
                    name.clone(),
                    level.level.name.clone(),
                    shortest(block.height_m()),
                    shortest(block.thickness_m()),
                ];
                match response {
                    ObjectResponse::Done { uplift, shock, .. } => row.extend([
                        uplift.rocking.outcome.name().to_owned(),
                        shortest(uplift.rocking.uplift_m),
                        shortest(uplift.rocking.cg_rise_m),
                        optional(shock.edge_acceleration_g),
                        shortest(shock.ceiling_g),
                    ]),
                    ObjectResponse::Failed(_) => {
                        row.push("failed".to_owned());
                        row.extend(std::iter::repeat_n(String::new(), 4));
                    }
                }
                row.extend(cells(response));
                row.extend(match response {
                    ObjectResponse::Done { direction_deg, .. } => [optional(*direction_deg), String::new()],
                    ObjectResponse::Failed(reason) => [String::new(), reason.clone()],
                });
                row
            })
        })
    });
    csv(&header, rows)
}

/// `urs.csv`: the uplift response spectra, one row for each motion, level and object; for motions
/// with two components, in the governing direction.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn urs_csv(study: &Study, result: &StudyResult) -> Result<Vec<u8>, Problem> {
    by_object(study, result, &["peak_rotation_rad", "impact_count", "impact_omega_rad_s"], |response| match response {
        ObjectResponse::Done { uplift, .. } => vec![
            shortest(uplift.rocking.peak_rotation_rad),
            uplift.rocking.impact_count.to_string(),
            shortest(uplift.impact_omega_rad_s()),
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
            let mut row = vec![level.level.name.clone(), shortest(block.height_m()), shortest(block.thickness_m())];
            let Some(s) = statistics else {
                row.push("0".to_owned());
                row.resize(header.len(), String::new());
                return row;
            };
            row.extend([s.motions.to_string(), shortest(s.uplift_share), shortest(s.overturned_share)]);
            for quantiles in [s.uplift_m, s.edge_acceleration_g, s.edge_acceleration_impact_velocity_g] {
                row.extend(quantiles.map(Ranked::cell));
            }
            row.extend([
                optional(s.edge_acceleration_survivors_g),
                optional(s.edge_acceleration_max_g),
                shortest(s.ceiling_g),
            ]);
            row
        })
    });
    csv(&header, rows)
}

/// `floor_profile.csv`: peak floor accelerations and velocities over the height, quantiles over the
/// motions, one row for each floor.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn profile_csv(study: &Study, profile: &FloorProfile) -> Result<Vec<u8>, Problem> {
    let header = [
        "level_ratio",
        "height_m",
        "pfa_g_p16",
        "pfa_g_median",
        "pfa_g_p84",
        "pfv_m_s_p16",
        "pfv_m_s_median",
        "pfv_m_s_p84",
        "code_part_g",
    ];
    let height_m = study.building.as_ref().map(|building| building.height_m);
    let rows = profile.levels_ratio.iter().enumerate().map(|(level, &ratio)| {
        let quantiles = |peaks: &[Vec<f64>]| {
            let mut of_level: Vec<f64> = peaks.iter().filter_map(|motion| motion.get(level)).copied().collect();
            QUANTILES.map(|quantile| ranked_quantile(&mut of_level, quantile).cell())
        };
        let code_g = profile.code.as_ref().and_then(|code| code.accel_g.get(level)).copied();
        let mut row = vec![shortest(ratio), optional(height_m.map(|height_m| ratio * height_m))];
        row.extend(quantiles(&profile.pfa_g));
        row.extend(quantiles(&profile.pfv_m_s));
        row.push(optional(code_g));
        row
    });
    csv(&header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use freestand_output::rows::{columns_csv, records_csv};

    /// 1e-300 in full has 300 digits; a whole number needs no `.0`.
    #[test]
    fn every_table_writes_the_shortest_numbers() {
        #[derive(serde::Serialize)]
        struct Row {
            x: f64,
        }
        let values = [0.0, 1.0, -1e-300, 0.1, 1e22];
        let expected = b"x\n0\n1\n-1e-300\n0.1\n1e22\n";
        assert_eq!(records_csv(&values.map(|x| Row { x })).unwrap(), expected);
        assert_eq!(columns_csv(&[("x", &values)]).unwrap(), expected);
        assert_eq!(Ranked::Value(1e-300).cell(), "1e-300");
        let study = crate::fixture::study();
        let mut result = crate::fixture::result(&study);
        for response in result.levels.iter_mut().flat_map(|level| level.responses.iter_mut().flatten()) {
            if let ObjectResponse::Done { uplift, shock, .. } = response {
                uplift.rocking.uplift_m = 1e-300;
                uplift.rocking.cg_rise_m = 1e-300;
                uplift.rocking.peak_rotation_rad = 1e-300;
                shock.edge_acceleration_g = Some(1e-300);
                shock.ceiling_g = 1e-300;
            }
        }
        for table in [urs_csv(&study, &result).unwrap(), srs_csv(&study, &result).unwrap()] {
            let text = String::from_utf8(table).unwrap();
            assert!(text.contains(",1e-300,1e-300,1e-300,") && !text.contains(&"0".repeat(20)), "{text:.300}");
        }
    }
}
