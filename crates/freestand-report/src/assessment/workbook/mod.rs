//! `assessment.xlsx`: summary, objects, live formulas for a reviewer, the meanings of the columns,
//! the sources.
//!
//! Text is always written as text, so that no cell of an inventory becomes a formula. The same rows
//! give the same bytes.

mod audit;
mod cells;
mod objects;
mod summary;

use std::fs::File;
use std::io::BufWriter;
use std::panic::{AssertUnwindSafe, catch_unwind};

use audit::Audit;
use cells::Styles;
use objects::Objects;
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Workbook, Worksheet, XlsxError};

use freestand_input::problem::{Problem, ProblemKind};
use freestand_inventory::Inventory;
use freestand_output::folder::OutputFolder;
use freestand_risk::budget::BudgetPlan;

use super::Head;
use super::overview::Overview;
use super::sources::Sources;
use super::table::Line;

/// The file's name.
pub(super) const WORKBOOK_NAME: &str = "assessment.xlsx";

/// Rows of a sheet, of which one is the header.
const SHEET_ROWS: u32 = 1_048_576;

/// Objects from which sheets are kept in temporary files: each object takes about 20 kB of memory
/// otherwise.
const LARGE: usize = 2_000;

/// The workbook as it is written.
pub(super) struct Book {
    workbook: Workbook,
    styles: Styles,
    objects: Objects,
    audit: Audit,
    is_large: bool,
}

impl Book {
    /// Begins the workbook. The temporary files of a large one are in its folder, which needs the
    /// space anyway.
    pub(super) fn begin(folder: &OutputFolder, inventory: &Inventory) -> Result<Self, Problem> {
        let beside = folder.path_of(WORKBOOK_NAME)?;
        guarded(|| {
            let mut workbook = Workbook::new();
            let is_large = inventory.items.len() > LARGE;
            if is_large {
                workbook.use_zip_large_file(true);
                if let Some(parent) = beside.parent() {
                    workbook.set_tempdir(parent)?;
                }
            }
            // With the date of a clock, two runs of the same study would give different files.
            let date = ExcelDateTime::from_ymd(2000, 1, 1)?;
            workbook.set_properties(
                &DocProperties::new()
                    .set_title("Assessment")
                    .set_creation_datetime(&date),
            );
            let styles = Styles::new();
            let objects = Objects::begin(&mut workbook, is_large, &styles, inventory)?;
            let audit = Audit::begin(&mut workbook, is_large, &styles, inventory)?;
            Ok(Self {
                workbook,
                styles,
                objects,
                audit,
                is_large,
            })
        })
    }

    /// One object.
    pub(super) fn row(&mut self, inventory: &Inventory, line: &Line) -> Result<(), Problem> {
        guarded(|| {
            let Self {
                workbook,
                styles,
                objects,
                audit,
                is_large,
            } = self;
            objects.row(workbook, *is_large, styles, inventory, line)?;
            audit.row(styles, line)
        })
    }

    /// Writes the sheets that are only known at the end, and the file.
    pub(super) fn finish(
        mut self,
        folder: &OutputFolder,
        head: &Head,
        overview: &Overview,
        sources: &Sources,
        plan: Option<&BudgetPlan>,
    ) -> Result<(), Problem> {
        let path = folder.path_of(WORKBOOK_NAME)?;
        guarded(move || {
            let styles = &self.styles;
            self.workbook
                .push_worksheet(summary::summary(head, overview, styles)?);
            if let Some(plan) = plan {
                self.workbook.push_worksheet(summary::plan(plan, styles)?);
                self.workbook.push_worksheet(summary::parts(plan, styles)?);
            }
            for sheet in self.objects.finish()? {
                self.workbook.push_worksheet(sheet);
            }
            self.workbook.push_worksheet(self.audit.finish(styles)?);
            self.workbook.push_worksheet(summary::columns(styles)?);
            self.workbook
                .push_worksheet(summary::sources(sources, styles)?);
            let file = File::create_new(path)?;
            self.workbook.save_to_writer(BufWriter::new(file))
        })
    }
}

/// A sheet, in a temporary file for a large workbook: rows then come in order.
fn sheet(workbook: &mut Workbook, is_large: bool, name: &str) -> Result<Worksheet, XlsxError> {
    let mut sheet = if is_large {
        workbook.new_worksheet_with_constant_memory()?
    } else {
        Worksheet::new()
    };
    sheet.set_name(name)?;
    Ok(sheet)
}

/// The library panics where a temporary file cannot be written, mostly because the disk is full:
/// that becomes a problem.
fn guarded<T>(work: impl FnOnce() -> Result<T, XlsxError>) -> Result<T, Problem> {
    let failed = |message: String| {
        Problem::new(
            ProblemKind::Io,
            format!("cannot write {WORKBOOK_NAME}: {message}"),
        )
    };
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(result) => result.map_err(|error| failed(error.to_string())),
        Err(_) => Err(failed("its temporary files cannot be written".to_owned())
            .hint("check whether the disk is full")),
    }
}

#[cfg(test)]
mod tests;
