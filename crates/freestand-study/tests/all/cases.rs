//! The files of cases with known answers.

#![expect(clippy::unwrap_used, reason = "a test may stop at broken data")]

use std::fs;
use std::path::{Path, PathBuf};

pub(crate) fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The folder of cases and records that the repository may not hold.
pub(crate) fn shared() -> PathBuf {
    std::env::var_os("FREESTAND_SHARED")
        .map_or_else(|| workspace().join("../shared"), PathBuf::from)
}

/// Time step and columns of a record; `None` where the file is missing.
pub(crate) fn record(name: &str) -> Option<(f64, Vec<Vec<f64>>)> {
    let file = format!("{name}.csv");
    let text = fs::read_to_string(workspace().join("validation/rocking/records").join(&file))
        .or_else(|_| fs::read_to_string(shared().join("cases/records").join(&file)))
        .ok()?;
    let (comments, rows): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.starts_with('#'));
    let step = comments
        .iter()
        .flat_map(|line| line.split_whitespace())
        .find_map(|word| word.strip_prefix("dt="));
    let rows: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| row.split(',').map(|value| value.parse().unwrap()).collect())
        .collect();
    let columns = (0..rows[0].len())
        .map(|i| rows.iter().map(|row| row[i]).collect())
        .collect();
    Some((step.unwrap().parse().unwrap(), columns))
}
