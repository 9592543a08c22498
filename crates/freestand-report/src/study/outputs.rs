//! The files of a run: either all of them are written, or none.

use std::path::PathBuf;

use rayon::prelude::*;

use crate::doubts::study_doubts;
use crate::figures::figures;
use crate::study::page::report;
use crate::study::sensitivity::VariedRow;
use crate::study::summary::{SCHEMA, Summary};
use crate::study::tables::{profile_table, srs_table, statistics_table, urs_table};
use freestand::code_spectrum::{CodeSpectrum, OutOfRange, PeriodCode};
use freestand_input::problem::{Problem, Problems};
use freestand_output::folder::{Committed, OutputFolder};
use freestand_output::json::document;
use freestand_output::parquet;
use freestand_output::rows::table_of_records;
use freestand_output::table::Table;
use freestand_records::write::write_csv;
use freestand_study::building::BuildingTable;
use freestand_study::provenance::{Provenance, provenance};
use freestand_study::rerun::{
    LevelFiles, MovedTable, with_building_tables, with_cushion, with_floor_motions, with_motions,
    with_period_code, with_seed, with_spectrum,
};
use freestand_study::result::{LevelResult, StudyResult};
use freestand_study::study::{Ground, Level, Study};
use freestand_study::summary::{LevelSummary, level_summaries};

/// What was written.
#[derive(Debug, Clone)]
pub struct Written {
    /// The folder.
    pub folder: PathBuf,
    /// The names of its files.
    pub files: Vec<String>,
    /// The key figures of each level.
    pub levels: Vec<LevelSummary>,
    /// The files of an earlier run that were removed from it.
    pub removed: Vec<String>,
}

/// The names of the files that a run of `study` will write, with variations or without. The figures
/// are missing, because they depend on the result.
pub fn expected_names(study: &Study, is_varied: bool) -> Vec<String> {
    let mut names: Vec<String> = vec!["study.toml".to_owned(), "summary.json".to_owned()];
    let tables = ["urs", "srs", "statistics"].into_iter();
    let tables = tables
        .chain(study.building.is_some().then_some("floor_profile"))
        .chain(is_varied.then_some("vary"));
    for name in tables {
        names.push(format!("{name}.csv"));
        names.extend(study.outputs.parquet.then(|| format!("{name}.parquet")));
    }
    names.extend(study.outputs.report.then(|| "report.html".to_owned()));
    for motion in study.ground.names(&study.levels) {
        if !matches!(study.ground, Ground::OnFloors) {
            names.push(ground_name(&motion));
        }
        names.extend(study.ground.has_vertical().then(|| vertical_name(&motion)));
        names.extend(
            study
                .levels
                .iter()
                .map(|level| floor_name(&motion, &level.name)),
        );
    }
    names.extend(building_tables(study).map(|table| name_of_table(table).to_owned()));
    names
}

fn ground_name(motion: &str) -> String {
    format!("motions/{motion}.csv")
}

/// A folder of its own: no level and no motion can have this name.
fn vertical_name(motion: &str) -> String {
    format!("vertical/{motion}.csv")
}

fn floor_name(motion: &str, level: &str) -> String {
    // A folder for each level: "rec" on the level "roof" and the ground motion "rec_roof" are two
    // files.
    format!("motions/{level}/{motion}.csv")
}

/// Writes the files of a run into `folder`, then moves the folder to its final place.
///
/// # Errors
/// A full disk, or a folder that has changed in the meantime; then nothing is written.
pub fn write_outputs(
    folder: OutputFolder,
    study: &Study,
    result: &StudyResult,
) -> Result<Written, Problems> {
    let (tables, pages) = rayon::join(|| tables(study, result), || pages(study, result));
    let mut files = tables?;
    files.extend(pages?);

    let mut names: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    names.push("summary.json".to_owned());
    names.sort_unstable();
    let levels = level_summaries(study, result);
    let summary = Summary {
        study,
        result,
        levels: &levels,
        files: &names,
    };
    files.push((
        "summary.json".to_owned(),
        document(SCHEMA, &summary, &study_doubts(&result.doubts))?.into_bytes(),
    ));

    files.sort_unstable_by(|a, b| a.0.cmp(&b.0));
    for (name, bytes) in &files {
        folder.write(name, bytes)?;
    }
    let Committed { folder, removed } = folder.commit()?;
    Ok(Written {
        folder,
        files: names,
        levels,
        removed,
    })
}

type File = (String, Vec<u8>);

/// The tables of results, by name without ending. Motions, and the tables that the study itself
/// reads, are inputs of the next run and remain CSV.
fn results(study: &Study, result: &StudyResult) -> Result<Vec<(&'static str, Table)>, Problem> {
    let mut tables = vec![
        ("urs", urs_table(study, result)?),
        ("srs", srs_table(study, result)?),
        ("statistics", statistics_table(study, result)?),
    ];
    if let Some(profile) = &result.profile {
        tables.push(("floor_profile", profile_table(study, profile)?));
    }
    if let Some(sensitivity) = &result.sensitivity {
        let rows: Vec<VariedRow> = sensitivity.rows.iter().map(VariedRow).collect();
        tables.push(("vary", table_of_records(&rows)?));
    }
    Ok(tables)
}

fn building_tables(study: &Study) -> impl Iterator<Item = &BuildingTable> {
    study.building.iter().flat_map(|building| &building.tables)
}

/// The name of a table of the building in the output folder.
fn name_of_table(table: &BuildingTable) -> &'static str {
    match table.is_across {
        true => "building/across.csv",
        false => "building/along.csv",
    }
}

/// The table that synthetic motions were made for, as it was read.
const TARGET_NAME: &str = "target_spectrum.csv";

/// The study in a form that gives the same result from the output folder.
fn rerun_toml(study: &Study) -> Result<String, Problem> {
    let toml = match &study.objects.cushion_file {
        Some((_, words)) => with_cushion(&study.toml, words)?,
        None => study.toml.clone(),
    };
    let tables = building_tables(study).map(|table| MovedTable {
        is_across: table.is_across,
        key: table.key,
        file: name_of_table(table),
    });
    let tables: Vec<MovedTable> = tables.collect();
    let toml = if tables.is_empty() {
        toml
    } else {
        with_building_tables(&toml, tables)?
    };
    // Without the code of the ground, the period would be by another formula.
    let code = study
        .building
        .as_ref()
        .and_then(|building| building.period_code);
    let toml = match (
        &study.ground,
        code.filter(|code| *code != PeriodCode::default()),
    ) {
        (Ground::Recorded(_), Some(code)) => with_period_code(&toml, code.name())?,
        _ => toml,
    };
    let names = study.ground.names(&study.levels);
    let two = study.ground.has_two_components(&study.levels);
    let step_deg = two.then(|| rotation_step_deg(study));
    match &study.ground {
        Ground::Synthetic(synthetic) => {
            let seeded = with_seed(&toml, synthetic.seed)?;
            if synthetic.target.table_csv.is_some() {
                let is_held = matches!(
                    &synthetic.target.spectrum,
                    CodeSpectrum::Table(table) if table.out_of_range() == OutOfRange::Hold
                );
                with_spectrum(&seeded, TARGET_NAME, is_held)
            } else {
                Ok(seeded)
            }
        }
        Ground::Simulated(simulated) => with_seed(&toml, simulated.request.seed),
        Ground::Recorded(_) => {
            let files: Vec<String> = names.iter().map(|name| ground_name(name)).collect();
            let verticals: Vec<String> = names.iter().map(|name| vertical_name(name)).collect();
            let verticals = study.ground.has_vertical().then_some(verticals.as_slice());
            with_motions(&toml, &files, verticals, step_deg)
        }
        Ground::OnFloors => {
            let files = |level: &Level| LevelFiles {
                name: level.name.clone(),
                level_ratio: level.level_ratio,
                motions: names
                    .iter()
                    .map(|name| floor_name(name, &level.name))
                    .collect(),
            };
            let levels: Vec<LevelFiles> = study.levels.iter().map(files).collect();
            with_floor_motions(&toml, &levels, step_deg)
        }
    }
}

/// The step between the directions \[degrees\]; 90 if there is only one direction.
fn rotation_step_deg(study: &Study) -> f64 {
    study.directions_deg.get(1).copied().unwrap_or(90.0)
}

/// The study, the tables and the motions.
fn tables(study: &Study, result: &StudyResult) -> Result<Vec<File>, Problems> {
    let mut files: Vec<File> = vec![("study.toml".to_owned(), rerun_toml(study)?.into_bytes())];
    for (name, table) in results(study, result)? {
        if study.outputs.parquet {
            let Provenance {
                seed,
                inputs,
                study_sha256,
                ..
            } = provenance(study);
            let inputs = inputs
                .into_iter()
                .map(|(name, sha256)| (name, Some(sha256)));
            let mut facts = parquet::provenance(seed, inputs);
            facts.push(("freestand.study_sha256".to_owned(), study_sha256));
            files.push((format!("{name}.parquet"), table.parquet(SCHEMA, facts)?));
        }
        files.push((format!("{name}.csv"), table.into()));
    }
    files.extend(
        building_tables(study).map(|table| (name_of_table(table).to_owned(), table.text.clone())),
    );
    if let Ground::Synthetic(synthetic) = &study.ground
        && let Some(csv) = &synthetic.target.table_csv
    {
        files.push((TARGET_NAME.to_owned(), csv.clone().into_bytes()));
    }
    let motions: Vec<Vec<File>> = result
        .motions
        .par_iter()
        .enumerate()
        .map(|(i, name)| {
            let floor = |level: &LevelResult| {
                let floor = level.floors.get(i)?;
                Some((
                    floor_name(name, &level.level.name),
                    floor.csv().into_bytes(),
                ))
            };
            let ground = result
                .ground
                .get(i)
                .map(|g| (ground_name(name), g.motion.csv().into_bytes()));
            let vertical = result.ground.get(i).and_then(|g| g.vertical.as_ref());
            let vertical =
                vertical.map(|motion| (vertical_name(name), write_csv(motion).into_bytes()));
            ground
                .into_iter()
                .chain(vertical)
                .chain(result.levels.iter().filter_map(floor))
                .collect()
        })
        .collect();
    files.extend(motions.into_iter().flatten());
    Ok(files)
}

/// The figures and the report, which contains the figures even if they are not written to files.
fn pages(study: &Study, result: &StudyResult) -> Result<Vec<File>, Problems> {
    if !(study.outputs.figures || study.outputs.report) {
        return Ok(Vec::new());
    }
    let drawn = figures(study, result).map_err(Problem::from)?;
    let mut files = Vec::new();
    if study.outputs.report {
        let html = report(study, result, &drawn, &provenance(study));
        files.push(("report.html".to_owned(), html.into_bytes()));
    }
    if study.outputs.figures {
        for figure in drawn {
            files.push((format!("{}.svg", figure.name), figure.svg.into_bytes()));
            files.push((format!("{}.png", figure.name), figure.png));
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use freestand_study::resolve::resolve;

    /// Both axes from one file: the written study runs in a folder without that file.
    #[test]
    fn every_key_that_names_a_table_is_written_anew() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(
            folder.path().join("m.csv"),
            "period [s],participation,3 m\n1,1,1\n",
        )
        .unwrap();
        let toml = "[building]\nmode_table = \"m.csv\"\nacross = { mode_table = \"m.csv\" }\n";
        let study = resolve(toml, None, folder.path()).unwrap();
        let out = tempfile::tempdir().unwrap();
        std::fs::create_dir(out.path().join("building")).unwrap();
        for table in building_tables(&study) {
            std::fs::write(out.path().join(name_of_table(table)), &table.text).unwrap();
        }
        let again = resolve(&rerun_toml(&study).unwrap(), None, out.path()).unwrap();
        let modes = |study: &Study| {
            study
                .building
                .clone()
                .map(|building| (building.along, building.across))
        };
        assert_eq!(modes(&again), modes(&study));
        let inherits = resolve(
            &toml.replace("mode_table = \"m.csv\" }", "damping = 0.02 }"),
            None,
            folder.path(),
        );
        let text = rerun_toml(&inherits.unwrap()).unwrap();
        assert!(
            text.contains("mode_table = \"building/along.csv\"\nacross = { damping = 0.02 }"),
            "{text}"
        );
    }
}
