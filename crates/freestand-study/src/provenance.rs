//! Where the numbers come from.

use crate::study::{Ground, RecordedMotion, Study};
use freestand_input::file::{InputFile, file_name, sha256_hex};

/// What is needed to get the same numbers again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    /// Version of freestand.
    pub version: String,
    /// SHA-256 of the study as TOML, in hexadecimal.
    pub study_sha256: String,
    /// Every other file that was read: name and SHA-256.
    pub inputs: Vec<(String, String)>,
    /// Seed of the random numbers, if there are any.
    pub seed: Option<u64>,
    /// The generator of the random numbers.
    pub generator: Option<String>,
}

/// The provenance of a study that this version runs.
pub fn provenance(study: &Study) -> Provenance {
    let seed = study.ground.seed();
    let generator = seed.map(|_| freestand::synthesis::GENERATOR.to_owned());
    let named = |file: &InputFile| {
        (
            file_name(&file.path).unwrap_or_default(),
            file.sha256.clone(),
        )
    };
    let records: Vec<&RecordedMotion> = study.ground.recorded(&study.levels).collect();
    let record = |r: &&RecordedMotion| {
        (
            file_name(&r.path).unwrap_or_else(|| r.name.clone()),
            r.sha256.clone(),
        )
    };
    let mut inputs: Vec<(String, String)> = records.iter().map(record).collect();
    for input in records
        .iter()
        .flat_map(|record| record.other_inputs())
        .map(named)
    {
        if !inputs.contains(&input) {
            inputs.push(input);
        }
    }
    let tables = study.building.iter().flat_map(|building| &building.tables);
    inputs.extend(tables.map(|table| named(&table.file)));
    if let Ground::Synthetic(synthetic) = &study.ground {
        inputs.extend(synthetic.target.file.iter().map(named));
    }
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        study_sha256: sha256_hex(study.toml.as_bytes()),
        inputs,
        seed,
        generator,
    }
}
