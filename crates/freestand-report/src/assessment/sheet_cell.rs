//! A cell of a sheet of the workbook, of those that have no styles of their own.

/// A cell of the sheet.
pub(super) enum SheetCell {
    Text(String),
    Number(Option<f64>),
    Share(Option<f64>),
}
