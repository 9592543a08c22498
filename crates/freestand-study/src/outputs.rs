//! Everything that a run leaves behind, complete or not at all.

use std::path::PathBuf;

use rayon::prelude::*;
use serde_json::Value;

use crate::error::{Problem, ProblemKind, StudyError};
use crate::figures::figures;
use crate::output::{OutputFolder, document};
use crate::records::write_csv;
use crate::report::{provenance, report};
use crate::rerun::{with_cushion, with_motions, with_seed};
use crate::result::StudyResult;
use crate::study::{Ground, Study};
use crate::summary::{SCHEMA, summary};
use crate::tables::{srs_csv, statistics_csv, urs_csv};

/// What was written.
#[derive(Debug, Clone)]
pub struct Written {
    /// The folder.
    pub folder: PathBuf,
    /// The names of its files.
    pub files: Vec<String>,
    /// `summary.json` without its schema and warnings.
    pub body: Value,
}

/// The names of the files that a run of `study` will write, but for the figures: these depend on the result.
pub fn expected_names(study: &Study) -> Vec<String> {
    let mut names: Vec<String> =
        ["study.toml", "urs.csv", "srs.csv", "statistics.csv", "summary.json"].map(str::to_owned).into();
    names.extend(study.outputs.report.then(|| "report.html".to_owned()));
    for motion in study.ground.names() {
        names.push(ground_name(&motion));
        names.extend(study.levels.iter().map(|level| floor_name(&motion, &level.name)));
    }
    names
}

fn ground_name(motion: &str) -> String {
    format!("motions/{motion}.csv")
}

fn floor_name(motion: &str, level: &str) -> String {
    // A folder for each level: "rec" on the level "roof" and the ground motion "rec_roof" are two files.
    format!("motions/{level}/{motion}.csv")
}

/// Writes the files of a run into `folder` and puts it in its place.
///
/// # Errors
/// A disk that is full or a folder that has changed since; nothing is left behind then.
pub fn write_outputs(folder: OutputFolder, study: &Study, result: &StudyResult) -> Result<Written, StudyError> {
    let (tables, pages) = rayon::join(|| tables(study, result), || pages(study, result));
    let mut files = tables?;
    files.extend(pages?);

    let mut names: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    names.push("summary.json".to_owned());
    names.sort_unstable();
    let body = summary(study, result, &names);
    files.push(("summary.json".to_owned(), document(SCHEMA, &body, &result.warnings)?.into_bytes()));

    files.sort_unstable_by(|a, b| a.0.cmp(&b.0));
    for (name, bytes) in &files {
        folder.write(name, bytes)?;
    }
    Ok(Written { folder: folder.commit()?, files: names, body })
}

type File = (String, Vec<u8>);

/// The study, as it gives the same result from the output folder.
fn rerun_toml(study: &Study) -> Result<String, Problem> {
    let toml = match &study.objects.cushion_file {
        Some((_, words)) => with_cushion(&study.toml, words)?,
        None => study.toml.clone(),
    };
    match &study.ground {
        Ground::Synthetic(synthetic) => with_seed(&toml, synthetic.seed),
        Ground::Recorded(_) => {
            let files: Vec<String> = study.ground.names().iter().map(|name| ground_name(name)).collect();
            with_motions(&toml, &files)
        }
    }
}

/// The study, the tables and the motions.
fn tables(study: &Study, result: &StudyResult) -> Result<Vec<File>, StudyError> {
    let mut files: Vec<File> = vec![
        ("study.toml".to_owned(), rerun_toml(study)?.into_bytes()),
        ("urs.csv".to_owned(), urs_csv(study, result)?),
        ("srs.csv".to_owned(), srs_csv(study, result)?),
        ("statistics.csv".to_owned(), statistics_csv(study, result)?),
    ];
    let motions: Vec<Vec<File>> = (0..result.ground.len())
        .into_par_iter()
        .map(|i| {
            let name = &result.ground[i].name;
            let floors = result
                .levels
                .iter()
                .map(|level| (floor_name(name, &level.level.name), write_csv(&level.floors[i]).into_bytes()));
            let ground = (ground_name(name), write_csv(&result.ground[i].motion).into_bytes());
            std::iter::once(ground).chain(floors).collect()
        })
        .collect();
    files.extend(motions.into_iter().flatten());
    Ok(files)
}

/// The figures and the report; the report shows them whether or not they are files too.
fn pages(study: &Study, result: &StudyResult) -> Result<Vec<File>, StudyError> {
    if !(study.outputs.figures || study.outputs.report) {
        return Ok(Vec::new());
    }
    let drawn = figures(study, result).map_err(|error| Problem::new(ProblemKind::Computation, error.to_string()))?;
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
