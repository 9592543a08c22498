//! Fragilities as the folders of other programs.

use freestand_input::problem::Problems;
use freestand_report::fragility::export_files;
use freestand_risk::export::{ExportRequest, export};
use freestand_risk::fragility::FragilityReport;

use crate::failure::Failure;
use crate::files::Files;

/// Folders for other programs.
#[derive(Debug, Default)]
pub(super) struct Exported {
    /// Their files, with their contents.
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// Warnings about them.
    pub(super) warnings: Vec<String>,
}

impl Exported {
    pub(super) fn of(
        report: &FragilityReport,
        requests: &[ExportRequest],
    ) -> Result<Self, Problems> {
        let mut all = Self::default();
        for request in requests {
            let folder = export_files(export(report, request)?)?;
            for warning in folder.warnings {
                // Two programs may say the same of an object.
                if !all.warnings.contains(&warning) {
                    all.warnings.push(warning);
                }
            }
            all.files.extend(folder.files);
        }
        Ok(all)
    }
}

/// Writes files with their contents.
pub(super) fn write(made: Vec<(String, Vec<u8>)>, files: &Files) -> Result<(), Failure> {
    made.into_iter()
        .try_for_each(|(name, bytes)| files.write(&name, || bytes).map(drop))
}
