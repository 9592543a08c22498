//! Cells and rows as a file has them, before they are interpreted.

/// The most rows that a sheet can have; a CSV with more is refused too.
pub(super) const MAX_ROWS: u32 = 1_048_576;
/// The most columns of a sheet.
pub(super) const MAX_COLUMNS: u32 = 16_384;
/// The most characters of a cell.
pub(super) const MAX_CELL_CHARS: usize = 32_767;

/// The content of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cell {
    /// A text, or a number of a CSV.
    Text(String),
    /// A number of a workbook.
    Number(f64),
    /// A truth value of a workbook.
    Bool(bool),
    /// A date, a time or a duration of a workbook, as ISO 8601 writes it.
    Date(String),
    /// An error such as `#REF!`.
    Error(String),
    /// A formula that was saved without its value.
    Unevaluated,
    /// More characters than a spreadsheet allows.
    TooLong(usize),
}

impl Cell {
    /// A text, if it is not longer than a cell may be.
    pub(super) fn text(text: String) -> Self {
        // Counting bytes first is cheaper: a character has at least one.
        if text.len() > MAX_CELL_CHARS && text.chars().count() > MAX_CELL_CHARS {
            Self::TooLong(text.chars().count())
        } else {
            Self::Text(text)
        }
    }

    /// The cell as the sheet shows it; empty where it shows nothing.
    pub(super) fn shown(&self) -> String {
        match self {
            Self::Text(text) | Self::Date(text) | Self::Error(text) => text.clone(),
            Self::Number(value) => format!("{value}"),
            Self::Bool(value) => if *value { "TRUE" } else { "FALSE" }.to_owned(),
            Self::Unevaluated | Self::TooLong(_) => String::new(),
        }
    }

    /// Whether it contains only blanks.
    pub(super) fn is_blank(&self) -> bool {
        matches!(self, Self::Text(text) if text.trim().is_empty())
    }
}

/// A row with at least one cell that is not empty.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Counted from 1, as in a spreadsheet.
    pub number: u32,
    /// Line of the file, where the file has lines.
    pub line: Option<usize>,
    /// The cells that are not empty with their columns, counted from 0, in rising order.
    pub cells: Vec<(u32, Cell)>,
    /// How many cells the row has in total, where the file says so.
    pub width: Option<u32>,
}

impl Row {
    /// Without cells.
    pub(super) fn new(number: u32) -> Self {
        Self {
            number,
            line: None,
            cells: Vec::new(),
            width: None,
        }
    }

    /// Whether it contains only blanks.
    pub(super) fn is_blank(&self) -> bool {
        self.cells.iter().all(|(_, cell)| cell.is_blank())
    }

    /// A cell.
    pub(super) fn get(&self, column: u32) -> Option<&Cell> {
        let at = self
            .cells
            .binary_search_by_key(&column, |(column, _)| *column)
            .ok()?;
        self.cells.get(at).map(|(_, cell)| cell)
    }

    /// A cell as the sheet shows it.
    pub(super) fn shown(&self, column: u32) -> String {
        self.get(column).map(Cell::shown).unwrap_or_default()
    }
}

/// The row with this number, if it is not empty.
pub(super) fn row_at(rows: &[Row], number: u32) -> Option<&Row> {
    let at = rows.binary_search_by_key(&number, |row| row.number).ok()?;
    rows.get(at)
}

/// Whether the caller wants more rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flow {
    More,
    Enough,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_holds_as_much_as_in_a_spreadsheet() {
        assert_eq!(
            Cell::text("ü".repeat(MAX_CELL_CHARS)),
            Cell::Text("ü".repeat(MAX_CELL_CHARS))
        );
        assert_eq!(
            Cell::text("x".repeat(MAX_CELL_CHARS + 1)),
            Cell::TooLong(MAX_CELL_CHARS + 1)
        );
    }
}
