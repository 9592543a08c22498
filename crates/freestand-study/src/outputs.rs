//! Everything that a run leaves behind, complete or not at all.

use std::path::PathBuf;

use serde_json::{Map, Value};

use crate::error::{Problem, ProblemKind, StudyError};
use crate::output::OutputFolder;
use crate::records::write_csv;
use crate::result::StudyResult;
use crate::study::Study;
use crate::summary::{SCHEMA, summary};
use crate::tables::{srs_csv, statistics_csv, urs_csv};

/// What was written.
#[derive(Debug, Clone)]
pub struct Written {
    /// The folder.
    pub folder: PathBuf,
    /// `summary.json` as it stands in it.
    pub summary: Value,
}

/// Writes the files of a run into `folder` and puts it in its place.
///
/// # Errors
/// A disk that is full or a folder that has changed since; nothing is left behind then.
pub fn write_outputs(folder: OutputFolder, study: &Study, result: &StudyResult) -> Result<Written, StudyError> {
    let mut files: Vec<(String, Vec<u8>)> = vec![
        ("study.toml".to_owned(), study.toml.clone().into_bytes()),
        ("urs.csv".to_owned(), urs_csv(study, result)?),
        ("srs.csv".to_owned(), srs_csv(study, result)?),
        ("statistics.csv".to_owned(), statistics_csv(study, result)?),
    ];
    for (i, ground) in result.ground.iter().enumerate() {
        files.push((format!("motions/{}.csv", ground.name), write_csv(&ground.motion).into_bytes()));
        for level in &result.levels {
            let name = format!("motions/{}_{}.csv", ground.name, level.level.name);
            files.push((name, write_csv(&level.floors[i]).into_bytes()));
        }
    }

    let mut names: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    names.push("summary.json".to_owned());
    names.sort_unstable();
    let mut document = Map::new();
    document.insert("schema".to_owned(), Value::from(SCHEMA));
    if let Value::Object(keys) = summary(study, result, &names) {
        document.extend(keys);
    }
    document.insert("warnings".to_owned(), Value::from(result.warnings.clone()));
    let document = Value::Object(document);
    let mut text = serde_json::to_vec_pretty(&document)
        .map_err(|error| Problem::new(ProblemKind::Io, format!("summary.json cannot be written: {error}")))?;
    text.push(b'\n');
    files.push(("summary.json".to_owned(), text));

    for (name, bytes) in &files {
        folder.write(name, bytes)?;
    }
    Ok(Written { folder: folder.commit()?, summary: document })
}
