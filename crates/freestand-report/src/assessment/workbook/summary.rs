//! The sheets of text: summary, meanings of the columns, sources.

use std::ops::Range;

use rust_xlsxwriter::{ColNum, Format, RowNum, Worksheet, XlsxError};

use crate::assessment::Head;
use crate::assessment::head::RULE;
use crate::assessment::orders::{part_cells, part_headings};
use crate::assessment::overview::{Counts, Overview, RATINGS};
use crate::assessment::plan::{assumptions, sentences, sheet_headings, sheet_rows};
use crate::assessment::sheet_cell::SheetCell;
use crate::assessment::sources::Sources;
use crate::assessment::table::{COLUMNS, Kind};
use crate::assessment::words::{HOW_TO_READ, advice, colours, label, ranked, sign};
use freestand_assess::result::{Criterion, Decision};
use freestand_input::keys::KeyStyle;

use freestand_risk::budget::BudgetPlan;

use super::cells::{Styles, put_number, put_text};

/// Widths of the columns of the first sheet, in characters.
const WIDTHS: [f64; 8] = [34.0, 22.0, 30.0, 16.0, 16.0, 26.0, 16.0, 70.0];

/// Height of a line of text \[points\].
const LINE_POINTS: f64 = 15.0;

/// The first sheet.
pub(super) fn summary(
    head: &Head,
    overview: &Overview,
    styles: &Styles,
) -> Result<Worksheet, XlsxError> {
    let mut sheet = Worksheet::new();
    sheet.set_name("Summary")?;
    sheet.set_landscape();
    sheet.set_print_fit_to_pages(1, 0);
    for (column, width) in (0..).zip(WIDTHS) {
        sheet.set_column_width(column, width)?;
    }
    let mut page = Page {
        sheet,
        styles,
        row: 0,
    };
    page.text(
        0,
        "Assessment: which objects must be restrained",
        &styles.title,
    )?;
    page.row += 1;
    if let Some(no_study) = &head.no_study {
        page.text(0, no_study, &styles.warning)?;
        page.row += 1;
    }
    if let Some(partial) = overview.partial() {
        page.text(0, &partial, &styles.warning)?;
        page.row += 1;
    }
    page.pairs("Building and earthquake", &head.place)?;
    page.counts(overview)?;
    page.floors(overview)?;
    page.consequences(overview)?;
    page.first(overview)?;
    page.list("Problems of the list", &head.problems)?;
    page.list("Warnings", &head.warnings)?;
    page.pairs("Inputs", &head.facts)?;
    page.list("Assumptions", &head.assumptions)?;
    page.list("How to read this workbook", &HOW_TO_READ)?;
    Ok(page.sheet)
}

/// Every option of the plan, and those that it was chosen from, then what is said of them.
pub(super) fn plan(plan: &BudgetPlan, styles: &Styles) -> Result<Worksheet, XlsxError> {
    let mut sheet = Worksheet::new();
    sheet.set_name("Plan")?;
    sheet.set_landscape();
    sheet.set_print_fit_to_pages(1, 0);
    sheet.set_freeze_panes(1, 0)?;
    let mut next = put_rows(&mut sheet, sheet_headings(plan), sheet_rows(plan), styles)?;
    for said in sentences(plan).iter().chain(&assumptions(plan)) {
        next += 1;
        put_text(&mut sheet, (next, 0), said, &styles.text)?;
    }
    Ok(sheet)
}

/// The parts of the plan, with their sum.
pub(super) fn parts(plan: &BudgetPlan, styles: &Styles) -> Result<Worksheet, XlsxError> {
    let mut sheet = Worksheet::new();
    sheet.set_name("Parts")?;
    sheet.set_landscape();
    sheet.set_print_fit_to_pages(1, 0);
    sheet.set_freeze_panes(1, 0)?;
    put_rows(&mut sheet, part_headings(plan), part_cells(plan), styles)?;
    Ok(sheet)
}

/// Headings with the widths of their columns, and the rows below them; the next free row.
fn put_rows(
    sheet: &mut Worksheet,
    headings: Vec<(String, f64)>,
    rows: impl IntoIterator<Item = Vec<SheetCell>>,
    styles: &Styles,
) -> Result<u32, XlsxError> {
    for (column, (name, width)) in (0..).zip(headings) {
        sheet.set_column_width(column, width)?;
        put_text(sheet, (0, column), &name, &styles.header)?;
    }
    let mut next = 1;
    for row in rows {
        for (column, cell) in (0..).zip(row) {
            let at = (next, column);
            match cell {
                SheetCell::Text(text) => put_text(sheet, at, &text, &styles.text)?,
                SheetCell::Number(value) => put_number(sheet, at, value, &styles.count)?,
                SheetCell::Share(value) => put_number(sheet, at, value, &styles.percent)?,
            }
        }
        next += 1;
    }
    Ok(next)
}

/// The meanings of the columns.
pub(super) fn columns(styles: &Styles) -> Result<Worksheet, XlsxError> {
    let mut sheet = Worksheet::new();
    sheet.set_name("Columns")?;
    sheet.set_freeze_panes(1, 0)?;
    for (column, (width, name)) in (0..).zip([
        (40.0, "name"),
        (10.0, "unit"),
        (14.0, "kind"),
        (90.0, "meaning"),
    ]) {
        sheet.set_column_width(column, width)?;
        put_text(&mut sheet, (0, column), name, &styles.header)?;
    }
    for (column, row) in COLUMNS.iter().zip(1..) {
        let kind = match column.kind {
            Kind::Text | Kind::Decision => "text",
            Kind::Number | Kind::Share => "number",
            Kind::Count => "whole number",
            Kind::Ranked => "number or overturned",
            Kind::Flag => "yes or no",
        };
        for (text, at) in [column.name, column.unit, kind, column.meaning]
            .into_iter()
            .zip(0..)
        {
            put_text(&mut sheet, (row, at), text, &styles.text)?;
        }
    }
    let row = COLUMNS.len() as RowNum + 2;
    let note = "Other columns of the inventory follow these; they are carried through as text.";
    put_text(&mut sheet, (row, 0), note, &styles.text)?;
    Ok(sheet)
}

/// The sources.
pub(super) fn sources(sources: &Sources, styles: &Styles) -> Result<Worksheet, XlsxError> {
    let mut sheet = Worksheet::new();
    sheet.set_name("Sources")?;
    sheet.set_freeze_panes(1, 0)?;
    for (column, (width, name)) in (0..).zip([
        (18.0, "of"),
        (90.0, "source"),
        (28.0, "trust"),
        (10.0, "objects"),
    ]) {
        sheet.set_column_width(column, width)?;
        put_text(&mut sheet, (0, column), name, &styles.header)?;
    }
    for ((what, source, worth, count), row) in sources.rows().zip(1..) {
        for (text, at) in [what, source, worth].into_iter().zip(0..) {
            put_text(&mut sheet, (row, at), text, &styles.wrapped)?;
        }
        put_number(&mut sheet, (row, 3), Some(count as f64), &styles.count)?;
    }
    Ok(sheet)
}

/// The headers of a table with a count for each decision.
fn with_decisions(first: [&'static str; 3]) -> Vec<&'static str> {
    first
        .into_iter()
        .chain(Decision::ALL.map(Decision::name))
        .collect()
}

/// A sheet that is written from the top down.
struct Page<'s> {
    sheet: Worksheet,
    styles: &'s Styles,
    row: RowNum,
}

impl Page<'_> {
    fn text(&mut self, column: ColNum, text: &str, format: &Format) -> Result<(), XlsxError> {
        put_text(&mut self.sheet, (self.row, column), text, format)
    }

    /// A sentence over the whole width. Without a line break it would widen the printed page until
    /// nothing on it can be read.
    fn sentence(&mut self, text: &str) -> Result<(), XlsxError> {
        let last = WIDTHS.len() as ColNum - 1;
        let fitting = super::cells::fitting(text);
        self.sheet
            .merge_range(self.row, 0, self.row, last, &fitting, &self.styles.wrapped)?;
        self.heighten(&fitting, WIDTHS.iter().sum())?;
        self.row += 1;
        Ok(())
    }

    /// Makes the row high enough for a text that is wrapped within `width` characters.
    fn heighten(&mut self, text: &str, width: f64) -> Result<(), XlsxError> {
        // Letters differ in width: a tenth is left free.
        let lines = (text.chars().count() as f64 / (0.9 * width))
            .ceil()
            .clamp(1.0, 20.0);
        self.sheet.set_row_height(self.row, LINE_POINTS * lines)?;
        Ok(())
    }

    fn heading(&mut self, text: &str) -> Result<(), XlsxError> {
        self.row += 1;
        self.text(0, text, &self.styles.heading)?;
        self.row += 1;
        Ok(())
    }

    /// Headers of a table; the columns `numbers` hold numbers.
    fn header(&mut self, names: &[&str], numbers: Range<ColNum>) -> Result<(), XlsxError> {
        self.sheet.set_row_height(self.row, 31)?;
        for (name, column) in names.iter().zip(0..) {
            let is_number = numbers.contains(&column);
            let format = if is_number {
                &self.styles.header_of_numbers
            } else {
                &self.styles.header
            };
            self.text(column, name, format)?;
        }
        self.row += 1;
        Ok(())
    }

    fn number(&mut self, column: ColNum, value: f64) -> Result<(), XlsxError> {
        put_number(
            &mut self.sheet,
            (self.row, column),
            Some(value),
            &self.styles.count,
        )
    }

    fn counts(&mut self, overview: &Overview) -> Result<(), XlsxError> {
        self.heading("Verdicts")?;
        self.header(
            &[
                "verdict",
                "objects",
                "pieces",
                "share of the objects",
                "action",
            ],
            1..4,
        )?;
        for decision in Decision::ALL {
            let format = self
                .styles
                .text
                .clone()
                .set_background_color(colours(decision).fill);
            self.text(
                0,
                &format!("{} {}", sign(decision), label(decision)),
                &format,
            )?;
            let objects = overview.counts.of(decision) as f64;
            self.number(1, objects)?;
            self.number(2, overview.counts.pieces[decision as usize] as f64)?;
            let share = (overview.assessed > 0).then(|| objects / overview.assessed as f64);
            put_number(&mut self.sheet, (self.row, 3), share, &self.styles.percent)?;
            self.text(4, advice(decision), &self.styles.text)?;
            self.row += 1;
        }
        self.text(0, "assessed in all", &self.styles.text)?;
        self.number(1, overview.assessed as f64)?;
        self.row += 1;
        self.text(0, "rows of the inventory", &self.styles.text)?;
        self.number(1, overview.total as f64)?;
        self.row += 1;
        Ok(())
    }

    fn by_decision(&mut self, first: ColNum, counts: &Counts) -> Result<(), XlsxError> {
        for (decision, column) in Decision::ALL.into_iter().zip(first..) {
            self.number(column, counts.of(decision) as f64)?;
        }
        self.row += 1;
        Ok(())
    }

    fn floors(&mut self, overview: &Overview) -> Result<(), XlsxError> {
        self.heading("Verdicts by floor, from the top down")?;
        let header = with_decisions(["floor", "level_ratio", "pfa_g_median"]);
        self.header(&header, 1..header.len() as ColNum)?;
        for floor in overview.floors() {
            self.text(0, &floor.name, &self.styles.text)?;
            put_number(
                &mut self.sheet,
                (self.row, 1),
                floor.level_ratio,
                &self.styles.number,
            )?;
            put_number(
                &mut self.sheet,
                (self.row, 2),
                floor.pfa_g_median,
                &self.styles.number,
            )?;
            self.by_decision(3, &floor.counts)?;
        }
        Ok(())
    }

    fn consequences(&mut self, overview: &Overview) -> Result<(), XlsxError> {
        self.heading("Verdicts by consequence (FEMA E-74)")?;
        let header = with_decisions(["consequence", "rating", "objects"]);
        self.header(&header, 2..header.len() as ColNum)?;
        for consequence in &overview.consequences {
            for (counts, rating) in consequence.ratings.iter().zip(RATINGS) {
                self.text(0, consequence.name, &self.styles.text)?;
                self.text(1, rating, &self.styles.text)?;
                self.number(2, counts.total() as f64)?;
                self.by_decision(3, counts)?;
            }
        }
        Ok(())
    }

    fn first(&mut self, overview: &Overview) -> Result<(), XlsxError> {
        self.heading("The most urgent objects (all objects: sheet Objects, column rank)")?;
        self.sentence(RULE)?;
        self.header(
            &[
                "rank, object",
                "verdict",
                "place",
                "demand/capacity",
                "governing criterion",
                "probability (interval)",
                "median shock",
                "why",
            ],
            0..0,
        )?;
        for one in overview.urgent.values() {
            let format = self
                .styles
                .text
                .clone()
                .set_background_color(colours(one.decision).fill);
            self.text(
                0,
                &format!("{}. {} {}", one.rank, one.id, one.item),
                &self.styles.text,
            )?;
            self.text(
                1,
                &format!("{} {}", sign(one.decision), label(one.decision)),
                &format,
            )?;
            self.text(2, &one.place, &self.styles.text)?;
            let ratio = one
                .demand_capacity
                .map_or_else(|| "–".to_owned(), |ratio| ranked(ratio, ""));
            self.text(3, &ratio, &self.styles.text)?;
            self.text(
                4,
                one.governing.map_or("–", Criterion::name),
                &self.styles.text,
            )?;
            self.text(5, &one.chance, &self.styles.text)?;
            let shock = one
                .shock_g
                .map_or_else(|| "–".to_owned(), |shock| ranked(shock, "g"));
            self.text(6, &shock, &self.styles.text)?;
            self.text(7, &one.why, &self.styles.wrapped)?;
            self.heighten(&one.why, WIDTHS[7])?;
            self.row += 1;
        }
        Ok(())
    }

    fn list<S: AsRef<str>>(&mut self, heading: &str, texts: &[S]) -> Result<(), XlsxError> {
        self.heading(heading)?;
        if texts.is_empty() {
            self.text(0, "none", &self.styles.text)?;
            self.row += 1;
        }
        for text in texts {
            self.sentence(&KeyStyle::Flag.shown(text.as_ref()))?;
        }
        Ok(())
    }

    fn pairs(&mut self, heading: &str, pairs: &[(String, String)]) -> Result<(), XlsxError> {
        self.heading(heading)?;
        for (name, value) in pairs {
            self.text(0, name, &self.styles.text)?;
            self.text(1, value, &self.styles.text)?;
            self.row += 1;
        }
        Ok(())
    }
}
