//! The result as tables: CSV with a header, commas, LF and the shortest numbers that read back the
//! same. A missing value is an empty field.

use freestand_output::facts::{Facts, table};
use freestand_output::table::Table;

use freestand::block::Block;
use freestand::rocking::FREE_FLIGHT;
use freestand::spectra::{ShockCell, UpliftCell};
use freestand_input::problem::Problem;
use freestand_study::result::{FloorProfile, ObjectResponse, Ranked, StudyResult};
use freestand_study::statistics::{QUANTILES, ranked_quantile};
use freestand_study::study::Study;

/// One row for each motion, level and object, in this order; `extra` are the facts after the common
/// ones, of a history that did not fail.
fn by_object(
    study: &Study,
    result: &StudyResult,
    extra: impl Fn(Option<(&UpliftCell, &ShockCell)>) -> Facts<'static>,
) -> Result<Table, Problem> {
    let rows = result
        .motions
        .iter()
        .enumerate()
        .flat_map(|(motion, name)| {
            let extra = &extra;
            result.levels.iter().flat_map(move |level| {
                study
                    .objects
                    .blocks
                    .iter()
                    .zip(&level.responses[motion])
                    .map(move |(block, response)| {
                        let (direction_deg, unfinished) = match response {
                            ObjectResponse::Done { direction_deg, .. } => (*direction_deg, None),
                            ObjectResponse::FreeFlight(reason) => {
                                (None, Some((FREE_FLIGHT, reason.as_str())))
                            }
                            ObjectResponse::Failed(reason) => {
                                (None, Some(("failed", reason.as_str())))
                            }
                        };
                        let done = response.done();
                        let (failed, reason) = unfinished.unzip();
                        let (rocking, shock) =
                            done.map(|(uplift, shock)| (&uplift.rocking, shock)).unzip();
                        Facts::default()
                            .key("motion", name.as_str())
                            .and(object(&level.level.name, block))
                            .key(
                                "outcome",
                                rocking.map(|rocking| rocking.outcome.name()).or(failed),
                            )
                            .key("uplift_m", rocking.map(|rocking| rocking.uplift_m))
                            .key("cg_rise_m", rocking.map(|rocking| rocking.cg_rise_m))
                            .key(
                                "edge_acceleration_g",
                                shock.and_then(|shock| shock.edge_acceleration_g),
                            )
                            .key("ceiling_g", shock.map(|shock| shock.ceiling_g))
                            .and(extra(done))
                            .key("direction_deg", direction_deg)
                            .key("reason", reason)
                    })
            })
        });
    table(rows)
}

/// `urs.csv`: the uplift spectra, one row for each motion, level and object; for motions
/// with two components, in the governing direction.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn urs_table(study: &Study, result: &StudyResult) -> Result<Table, Problem> {
    by_object(study, result, |done| {
        let uplift = done.map(|(uplift, _)| uplift);
        Facts::default()
            .key(
                "peak_rotation_rad",
                uplift.map(|uplift| uplift.rocking.peak_rotation_rad),
            )
            .key(
                "impact_count",
                uplift.map(|uplift| uplift.rocking.impact_count),
            )
            .key(
                "impact_omega_rad_s",
                uplift.map(UpliftCell::impact_omega_rad_s),
            )
    })
}

/// `srs.csv`: the shock spectra, from both sources of the energy at impact.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn srs_table(study: &Study, result: &StudyResult) -> Result<Table, Problem> {
    by_object(study, result, |done| {
        let shock_g = done.and_then(|(_, shock)| shock.edge_acceleration_impact_velocity_g);
        Facts::default().key("edge_acceleration_impact_velocity_g", shock_g)
    })
}

/// An object on a level.
fn object<'a>(level: &'a str, block: &Block) -> Facts<'a> {
    Facts::default()
        .key("level", level)
        .key("height_m", block.height_m())
        .key("thickness_m", block.thickness_m())
}

/// The quantiles of one value, under the names of [`QUANTILES`].
fn quantiles<'a>(
    row: Facts<'a>,
    names: [&'static str; 3],
    values: Option<[Ranked; 3]>,
) -> Facts<'a> {
    let values = values.unwrap_or([Ranked::NoData; 3]);
    names
        .into_iter()
        .zip(values)
        .fold(row, |row, (name, value)| row.key(name, value))
}

/// `statistics.csv`: quantiles over all motions, one row for each level and object.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn statistics_table(study: &Study, result: &StudyResult) -> Result<Table, Problem> {
    let rows = result.levels.iter().flat_map(|level| {
        study
            .objects
            .blocks
            .iter()
            .zip(&level.statistics)
            .map(|(block, statistics)| {
                let s = statistics.as_ref();
                let row = object(&level.level.name, block)
                    .key("motions", s.map_or(0, |s| s.motions))
                    .key("uplift_share", s.map(|s| s.uplift_share))
                    .key("overturned_share", s.map(|s| s.overturned_share));
                let names = ["uplift_m_p16", "uplift_m_median", "uplift_m_p84"];
                let row = quantiles(row, names, s.map(|s| s.uplift_m));
                let names = [
                    "edge_acceleration_g_p16",
                    "edge_acceleration_g_median",
                    "edge_acceleration_g_p84",
                ];
                let row = quantiles(row, names, s.map(|s| s.edge_acceleration_g));
                let names = [
                    "edge_acceleration_impact_velocity_g_p16",
                    "edge_acceleration_impact_velocity_g_median",
                    "edge_acceleration_impact_velocity_g_p84",
                ];
                quantiles(row, names, s.map(|s| s.edge_acceleration_impact_velocity_g))
                    .key(
                        "edge_acceleration_g_median_of_survivors",
                        s.and_then(|s| s.edge_acceleration_survivors_g),
                    )
                    .key(
                        "edge_acceleration_g_max_of_survivors",
                        s.and_then(|s| s.edge_acceleration_max_g),
                    )
                    .key("ceiling_g", s.map(|s| s.ceiling_g))
            })
    });
    table(rows)
}

/// `floor_profile.csv`: peak floor accelerations and velocities over the height, quantiles over the
/// motions, one row for each floor.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn profile_table(study: &Study, profile: &FloorProfile) -> Result<Table, Problem> {
    let height_m = study.building.as_ref().map(|building| building.height_m);
    let rows = profile
        .levels_ratio
        .iter()
        .enumerate()
        .map(|(level, &ratio)| {
            let of_level = |peaks: &[Vec<f64>]| {
                let mut of_level: Vec<f64> = peaks
                    .iter()
                    .filter_map(|motion| motion.get(level))
                    .copied()
                    .collect();
                Some(QUANTILES.map(|quantile| ranked_quantile(&mut of_level, quantile)))
            };
            let row = Facts::default()
                .key("level_ratio", ratio)
                .key("height_m", height_m.map(|height_m| ratio * height_m));
            let row = quantiles(
                row,
                ["pfa_g_p16", "pfa_g_median", "pfa_g_p84"],
                of_level(&profile.pfa_g),
            );
            let row = quantiles(
                row,
                ["pfv_m_s_p16", "pfv_m_s_median", "pfv_m_s_p84"],
                of_level(&profile.pfv_m_s),
            );
            row.key(
                "code_part_g",
                profile
                    .code
                    .as_ref()
                    .and_then(|code| code.accel_g.get(level))
                    .copied(),
            )
        });
    table(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use freestand_output::rows::{table_of_columns, table_of_records};

    /// 1e-300 in full has 300 digits; a whole number needs no `.0`.
    #[test]
    fn every_table_writes_the_shortest_numbers() {
        #[derive(serde::Serialize)]
        struct Row {
            x: f64,
        }
        let values = [0.0, 1.0, -1e-300, 0.1, 1e22];
        let expected = b"x\n0\n1\n-1e-300\n0.1\n1e22\n";
        assert_eq!(
            table_of_records(&values.map(|x| Row { x }))
                .unwrap()
                .as_ref(),
            expected
        );
        assert_eq!(
            table_of_columns(&[("x", &values)]).unwrap().as_ref(),
            expected
        );
        assert_eq!(
            table([Facts::default().key("x", Ranked::Value(1e-300))])
                .unwrap()
                .as_ref(),
            b"x\n1e-300\n"
        );
        let study = crate::study::fixture::study();
        let mut result = crate::study::fixture::result(&study);
        for response in result
            .levels
            .iter_mut()
            .flat_map(|level| level.responses.iter_mut().flatten())
        {
            if let ObjectResponse::Done { uplift, shock, .. } = response {
                uplift.rocking.uplift_m = 1e-300;
                uplift.rocking.cg_rise_m = 1e-300;
                uplift.rocking.peak_rotation_rad = 1e-300;
                shock.edge_acceleration_g = Some(1e-300);
                shock.ceiling_g = 1e-300;
            }
        }
        for table in [
            urs_table(&study, &result).unwrap(),
            srs_table(&study, &result).unwrap(),
        ] {
            let text = table.to_string();
            assert!(
                text.contains(",1e-300,1e-300,1e-300,") && !text.contains(&"0".repeat(20)),
                "{text:.300}"
            );
        }
    }
}
