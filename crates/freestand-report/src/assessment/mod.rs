//! The outputs of an assessment, written in one pass over its rows: a million objects are never in
//! memory together.

pub(crate) mod compared;
mod csv;
mod estimates;
#[cfg(test)]
mod fixture;
mod floors;
pub mod head;
mod hold;
mod losses;
mod orders;
mod outcomes;
mod overview;
mod parquet;
mod plan;
pub mod reasons;
mod report;
mod rows;
mod sheet_cell;
mod since;
mod sites;
mod sources;
mod table;
mod text;
mod told;
pub mod words;
mod workbook;
mod worklist;
mod worlds;

use freestand_assess::portfolio::Row;
use freestand_assess::result::Decision;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_inventory::Inventory;
use freestand_output::folder::OutputFolder;
use freestand_risk::budget::BudgetPlan;
use serde::{Deserialize, Serialize};

pub use estimates::{EstimateRow, first_estimates, time_left, usual_time};
pub use head::{Head, head};
pub use orders::{ORDERS_FOLDER, PARTS_NAME, PARTS_PAGE};
pub use outcomes::{OUTCOMES_NAME, outcomes_head, outcomes_rows};
pub use plan::{ALTERNATIVES_NAME, PLAN_NAME};
pub use rows::JsonRows;
pub use rows::{object_rows, row_schema};
pub use since::{CHANGES_NAME, Earlier, Since};
pub use sites::{SHARED_NAMES, SITES_NAME, SiteReport, SitesReport, sites_text, write_sites};
pub use text::{assessment_text, missing_text, plan_text, quoted};
pub use told::{JobReport, PlanReport, said};
pub use worklist::WORKLIST_NAME;
pub use worlds::{WORLDS_NAME, write_worlds};

use crate::signature::Signing;
use csv::CsvTable;
use overview::Overview;
use parquet::ParquetTable;
use report::Report;
use sources::Sources;
use table::Line;
use workbook::Book;
use worklist::{Worklist, task};

/// The outputs besides `objects.csv`, `worklist.csv` and `worlds.csv`, which are always written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted<'p> {
    /// `objects.parquet`.
    pub parquet: bool,
    /// `assessment.xlsx`.
    pub workbook: bool,
    /// `report.html`.
    pub report: bool,
    /// Number of objects with a page in the report: the most urgent ones.
    pub pages: usize,
    /// The plan within a budget, if one was asked for.
    pub plan: Option<&'p BudgetPlan>,
    /// Whether a plan was asked for, and the run was stopped before it was made.
    pub lacks_plan: bool,
    /// What has changed since an earlier assessment, if that was asked for.
    pub since: Option<&'p Since>,
    /// How the report and the orders are signed.
    pub signing: Signing,
}

/// One of the most urgent objects, in words for a console.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct First {
    /// 1 is the most urgent.
    pub rank: usize,
    /// Identifier of the object.
    pub id: String,
    /// What it is.
    pub item: String,
    /// Its floor.
    pub floor: String,
    /// What to do.
    pub action: Decision,
    /// The probability that decides: `falls 31 % (25–37 %)`.
    pub chance: String,
    /// Force of a restraint \[N\].
    pub force_n: Option<f64>,
}

/// Objects that a console lists.
const FIRST_ROWS: usize = 15;

/// Rows in the list of the most urgent objects.
pub const URGENT_ROWS: usize = 50;

/// Writes the outputs of an assessment into `folder` in a single pass over `rows`, which are in the
/// order of the inventory. Objects without a row were not assessed, because the run was
/// interrupted: they are in the tables without a decision, and every output says that it is partial
/// and how many objects were assessed.
///
/// Only the counts, the pages of the most urgent objects and one group of rows are in memory,
/// whatever the number of rows.
///
/// # Errors
/// The first problem of `rows`, rows that are not in the order of the inventory, or a full disk.
pub fn write_all(
    folder: &OutputFolder,
    head: &Head,
    inventory: &Inventory,
    wanted: Wanted,
    rows: &mut dyn Iterator<Item = Result<Row<'_>, Problem>>,
) -> Result<Vec<First>, Problem> {
    let mut outputs = Outputs::begin(folder, head, inventory, wanted)?;
    let mut next = rows.next().transpose()?;
    for item in &inventory.items {
        let is_assessed = next
            .as_ref()
            .is_some_and(|row| row.item.row == item.row && row.item.id == item.id);
        let row = if is_assessed { next.take() } else { None };
        outputs.add(
            inventory,
            &Line {
                item,
                found: row.as_ref().map(|row| (row.rank, &row.found)),
            },
        )?;
        if is_assessed {
            next = rows.next().transpose()?;
        }
    }
    if let Some(row) = next {
        return Err(out_of_order(&row.item.id));
    }
    outputs.finish(folder, head, wanted)
}

/// The files as they are written.
struct Outputs<'p> {
    overview: Overview,
    sources: Sources,
    csv: CsvTable,
    worklist: Worklist,
    parquet: Option<ParquetTable>,
    book: Option<Book>,
    report: Option<Report<'p>>,
}

impl<'p> Outputs<'p> {
    fn begin(
        folder: &OutputFolder,
        head: &Head,
        inventory: &Inventory,
        wanted: Wanted<'p>,
    ) -> Result<Self, Problem> {
        let total = head.total.max(inventory.items.len());
        Ok(Self {
            overview: Overview::new(total, URGENT_ROWS),
            sources: Sources::default(),
            csv: CsvTable::begin(folder, inventory)?,
            worklist: Worklist::begin(folder)?,
            parquet: wanted
                .parquet
                .then(|| ParquetTable::begin(folder, head, inventory))
                .transpose()?,
            book: wanted
                .workbook
                .then(|| Book::begin(folder, inventory))
                .transpose()?,
            report: wanted
                .report
                .then(|| Report::new(wanted.pages, wanted.plan)),
        })
    }

    fn add(&mut self, inventory: &Inventory, line: &Line) -> Result<(), Problem> {
        self.overview.add(line);
        self.sources.add(line);
        self.csv.row(inventory, line)?;
        if let Some(task) = task(line) {
            self.worklist.add(&task)?;
            self.overview.add_task(task);
        }
        if let Some(parquet) = &mut self.parquet {
            parquet.row(inventory, line)?;
        }
        if let Some(book) = &mut self.book {
            book.row(inventory, line)?;
        }
        if let Some(report) = &mut self.report {
            report.add(inventory, line);
        }
        Ok(())
    }

    fn finish(
        self,
        folder: &OutputFolder,
        head: &Head,
        wanted: Wanted,
    ) -> Result<Vec<First>, Problem> {
        let Wanted {
            plan,
            since,
            signing,
            ..
        } = wanted;
        self.csv.finish()?;
        self.worklist.finish(folder)?;
        if let Some(plan) = plan {
            plan::write_plan(folder, plan)?;
            orders::write_orders(folder, plan, None, &head.title, signing)?;
        }
        if let Some(since) = since {
            since::write(folder, since)?;
        }
        if let Some(parquet) = self.parquet {
            parquet.finish(&self.overview)?;
        }
        if let Some(book) = self.book {
            book.finish(folder, head, &self.overview, &self.sources, plan)?;
        }
        if let Some(report) = self.report {
            report.write(folder, head, &self.overview, wanted)?;
        }
        let first = self
            .overview
            .urgent
            .into_values()
            .take(FIRST_ROWS)
            .map(|one| First {
                rank: one.rank,
                id: one.id,
                item: one.item,
                floor: one.floor,
                action: one.decision,
                chance: one.chance,
                force_n: one.force_n,
            });
        Ok(first.collect())
    }
}

fn out_of_order(id: &str) -> Problem {
    let message = format!("the result of \"{id}\" is not in the order of the inventory");
    Problem::new(ProblemKind::Computation, message)
        .hint("this is a defect in freestand: please report it")
}
