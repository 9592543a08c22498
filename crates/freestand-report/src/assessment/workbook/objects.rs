//! The sheets of objects: every column of `objects.csv`.

use rust_xlsxwriter::{
    ColNum, ConditionalFormatCell, ConditionalFormatCellRule, ConditionalFormatText,
    ConditionalFormatTextRule, Format, RowNum, Workbook, Worksheet, XlsxError,
};

use crate::assessment::csv::OVERTURNED;
use crate::assessment::table::{COLUMNS, Column, Kind, Line, carried_cells, carried_names};
use crate::assessment::words::colours;
use freestand_assess::result::Decision;
use freestand_inventory::Inventory;

use super::cells::{Styles, put, put_text};
use super::{SHEET_ROWS, sheet};

/// The sheets so far.
pub(super) struct Objects {
    sheets: Vec<Worksheet>,
    /// The next free row of the last sheet.
    row: RowNum,
    columns: ColNum,
}

impl Objects {
    pub(super) fn begin(
        workbook: &mut Workbook,
        is_large: bool,
        styles: &Styles,
        inventory: &Inventory,
    ) -> Result<Self, XlsxError> {
        // A sheet has 16,384 columns; carried ones beyond them are in the CSV alone.
        let columns = (COLUMNS.len() + inventory.carried.len()).min(16_384);
        let mut objects = Self {
            sheets: Vec::new(),
            row: 0,
            columns: columns as ColNum,
        };
        objects.next_sheet(workbook, is_large, styles, inventory)?;
        Ok(objects)
    }

    pub(super) fn row(
        &mut self,
        workbook: &mut Workbook,
        is_large: bool,
        styles: &Styles,
        inventory: &Inventory,
        line: &Line,
    ) -> Result<(), XlsxError> {
        if self.row >= SHEET_ROWS {
            self.next_sheet(workbook, is_large, styles, inventory)?;
        }
        let (row, columns) = (self.row, self.columns);
        let Some(sheet) = self.sheets.last_mut() else {
            return Ok(());
        };
        for (column, at) in COLUMNS.iter().zip(0..) {
            put(
                sheet,
                (row, at),
                &(column.cell)(line),
                styles,
                column.kind == Kind::Share,
            )?;
        }
        for (cell, at) in carried_cells(inventory, line.item).zip(COLUMNS.len() as ColNum..columns)
        {
            put(sheet, (row, at), &cell, styles, false)?;
        }
        self.row += 1;
        Ok(())
    }

    pub(super) fn finish(self) -> Result<Vec<Worksheet>, XlsxError> {
        let (mut sheets, last_row, columns) = (self.sheets, self.row, self.columns);
        let full = sheets.len().saturating_sub(1);
        for (i, sheet) in sheets.iter_mut().enumerate() {
            let rows = if i < full { SHEET_ROWS } else { last_row };
            sheet.autofilter(0, 0, rows.saturating_sub(1).max(1), columns - 1)?;
            colour(sheet, rows.saturating_sub(1).max(1))?;
        }
        Ok(sheets)
    }

    fn next_sheet(
        &mut self,
        workbook: &mut Workbook,
        is_large: bool,
        styles: &Styles,
        inventory: &Inventory,
    ) -> Result<(), XlsxError> {
        let name = match self.sheets.len() {
            0 => "Objects".to_owned(),
            n => format!("Objects {}", n + 1),
        };
        let mut sheet = sheet(workbook, is_large, &name)?;
        sheet.set_freeze_panes(1, 2)?;
        sheet.set_row_height(0, 48)?;
        for (column, at) in COLUMNS.iter().zip(0..) {
            sheet.set_column_width(at, width(column))?;
            put_text(&mut sheet, (0, at), column.name, &styles.header)?;
        }
        for (name, at) in carried_names(&inventory.carried)
            .iter()
            .zip(COLUMNS.len() as ColNum..self.columns)
        {
            sheet.set_column_width(at, 16)?;
            put_text(&mut sheet, (0, at), name, &styles.header)?;
        }
        self.sheets.push(sheet);
        self.row = 1;
        Ok(())
    }
}

fn width(column: &Column) -> f64 {
    match (column.kind, column.name) {
        (_, "why" | "remarks" | "notes") => 60.0,
        (
            _,
            "item" | "location" | "tolerance" | "tolerance_source" | "cushion" | "restraint_source"
            | "anchor_source",
        ) => 26.0,
        (Kind::Text | Kind::Decision, _) => 15.0,
        (Kind::Count, _) => 9.0,
        _ => 14.0,
    }
}

/// Colours in addition to words: the decision, and what exceeds its capacity.
fn colour(sheet: &mut Worksheet, last_row: RowNum) -> Result<(), XlsxError> {
    for (column, at) in COLUMNS.iter().zip(0..) {
        if column.kind == Kind::Decision {
            for decision in Decision::ALL {
                let rule = ConditionalFormatCellRule::EqualTo(decision.name());
                let format = Format::new()
                    .set_bold()
                    .set_background_color(colours(decision).fill);
                let rule = ConditionalFormatCell::new()
                    .set_rule(rule)
                    .set_format(format);
                sheet.add_conditional_format(1, at, last_row, at, &rule)?;
            }
        }
        if column.kind == Kind::Ranked {
            let rule = ConditionalFormatTextRule::Contains(OVERTURNED.to_owned());
            let format = Format::new().set_bold().set_italic();
            let rule = ConditionalFormatText::new()
                .set_rule(rule)
                .set_format(format);
            sheet.add_conditional_format(1, at, last_row, at, &rule)?;
        }
        if matches!(
            column.name,
            "demand_capacity_ratio" | "demand_capacity_ratio_p84"
        ) {
            let rule = ConditionalFormatCellRule::GreaterThan(1.0);
            let rule = ConditionalFormatCell::new()
                .set_rule(rule)
                .set_format(Format::new().set_bold());
            sheet.add_conditional_format(1, at, last_row, at, &rule)?;
        }
    }
    Ok(())
}
