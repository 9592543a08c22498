//! One cell that the user corrects.

use std::fmt::{Display, Formatter};

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::cell::{MAX_COLUMNS, MAX_ROWS};
use super::columns::letters;

/// A cell with the text that is read in place of its content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Its row, counted from 1.
    pub(super) row: u32,
    /// Its column, counted from 0.
    pub(super) column: u32,
    pub(super) text: String,
}

impl Edit {
    /// From a cell as a spreadsheet names it, such as `D7`, and its new text; an empty text empties
    /// the cell.
    ///
    /// # Errors
    /// What is not the name of a cell.
    ///
    /// # Example
    /// ```
    /// use freestand_inventory::Edit;
    /// assert_eq!(Edit::new("d7", "900 mm")?.to_string(), "D7=900 mm");
    /// assert!(Edit::new("7", "900 mm").is_err());
    /// # Ok::<(), freestand_input::problem::Problem>(())
    /// ```
    pub fn new(cell: &str, text: &str) -> Result<Self, Problem> {
        let refused = || {
            let message = format!("\"{}\" is not the name of a cell", shorten(cell));
            Problem::value(
                message,
                "name a cell as a spreadsheet does: the column, then the row, such as D7",
            )
        };
        let cell = cell.trim();
        let (column, row) = cell.split_at(
            cell.find(|c: char| c.is_ascii_digit())
                .ok_or_else(refused)?,
        );
        let digit = |c: char| {
            c.is_ascii_alphabetic()
                .then(|| u32::from(c.to_ascii_uppercase()) - u32::from('A') + 1)
        };
        let column = column
            .chars()
            .try_fold(0, |all: u32, c| all.checked_mul(26)?.checked_add(digit(c)?));
        let column = column
            .filter(|column| (1..=MAX_COLUMNS).contains(column))
            .ok_or_else(refused)?
            - 1;
        // Digits only: `parse` also takes a sign.
        let row = Some(row).filter(|row| row.bytes().all(|byte| byte.is_ascii_digit()));
        let row = row
            .and_then(|row| row.parse().ok())
            .filter(|row| (1..=MAX_ROWS).contains(row))
            .ok_or_else(refused)?;
        if let Some(control) = text.trim().chars().find(|c| c.is_control()) {
            let message = format!("the text of cell {cell} contains {control:?}");
            return Err(Problem::value(message, "give one line without tabs"));
        }
        Ok(Self {
            row,
            column,
            text: text.trim().to_owned(),
        })
    }

    /// From one text: `D7=900 mm`.
    ///
    /// # Errors
    /// A text without `=`, or what is not the name of a cell.
    pub fn parse(text: &str) -> Result<Self, Problem> {
        let (cell, text) = text.split_once('=').ok_or_else(|| {
            let message = format!("\"{}\" has no =", shorten(text));
            Problem::value(message, "give a cell and its text, such as \"D7=900 mm\"")
        })?;
        Self::new(cell, text)
    }

    /// Whether it changes or confirms this cell; the row counts from 1, the column from 0.
    pub(super) fn is_of(&self, row: u32, column: u32) -> bool {
        (self.row, self.column) == (row, column)
    }

    /// The name of the cell.
    pub fn cell(&self) -> String {
        format!("{}{}", letters(self.column as usize), self.row)
    }
}

impl Display for Edit {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}={}", self.cell(), self.text)
    }
}
