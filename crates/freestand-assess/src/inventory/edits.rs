//! Cells that the user corrects while a list is read: the file itself is never changed.

use std::fmt::{Display, Formatter};

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;

use super::cell::{Cell, MAX_COLUMNS, MAX_ROWS};
use super::columns::{Column, letters};
use super::layout::Header;
use super::problems::{Finding, Kind};
use super::source::Sheet;
use super::understood::Understood;

/// A cell with the text that is read in place of its content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Its row, counted from 1.
    row: u32,
    /// Its column, counted from 0.
    column: u32,
    text: String,
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
    /// use freestand_assess::inventory::Edit;
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

impl Sheet {
    /// Replaces the content of cells below the headings; a text in the row of the headings, where none is, adds a
    /// column.
    ///
    /// # Errors
    /// A cell of the headings or above them, in a column without a heading, in an empty row, or twice.
    pub(super) fn edit(&mut self, edits: &[Edit]) -> Result<(), Problem> {
        let is_new = |header: &Header, edit: &Edit| {
            edit.row == header.row
                && !edit.text.is_empty()
                && !header.headings.contains_key(&edit.column)
        };
        let added: Vec<usize> = (0..)
            .zip(edits)
            .filter(|(_, edit)| is_new(&self.header, edit))
            .map(|(at, _)| at)
            .collect();
        for edit in added.iter().filter_map(|at| edits.get(*at)) {
            self.header.add(edit.column, &edit.text);
        }
        for (at, edit) in edits.iter().enumerate() {
            let refused = |what: &str| {
                let message = format!("cell {} cannot be changed: {what}", edit.cell());
                Problem::new(ProblemKind::Value, message).hint("change a cell of an object; a column that has no heading needs one first, in the row of the headings")
            };
            if edits
                .iter()
                .take(at)
                .any(|earlier| (earlier.row, earlier.column) == (edit.row, edit.column))
            {
                let message = format!("cell {} is changed twice", edit.cell());
                return Err(Problem::value(message, "give one text for each cell"));
            }
            if added.contains(&at) {
                continue;
            }
            if edit.row <= self.header.last_row {
                return Err(refused(&format!(
                    "the objects begin below row {}",
                    self.header.last_row
                )));
            }
            if !self.header.headings.contains_key(&edit.column) {
                return Err(refused("its column has no heading"));
            }
            let row = self.rows.binary_search_by_key(&edit.row, |row| row.number);
            let row = row
                .ok()
                .and_then(|at| self.rows.get_mut(at))
                .ok_or_else(|| refused("its row is empty"))?;
            let cell = Cell::text(edit.text.clone());
            match row
                .cells
                .binary_search_by_key(&edit.column, |(column, _)| *column)
            {
                Ok(at) if edit.text.is_empty() => _ = row.cells.remove(at),
                Ok(at) => row
                    .cells
                    .iter_mut()
                    .skip(at)
                    .take(1)
                    .for_each(|slot| slot.1 = cell.clone()),
                Err(_) if edit.text.is_empty() => {}
                Err(at) => row.cells.insert(at, (edit.column, cell)),
            }
        }
        Ok(())
    }
}

/// The edits that answer a doubt whose own cell cannot: in the column that has the answer, which may have to be added.
pub(super) fn answer(finding: &Finding, sheet: &Sheet, columns: &Understood) -> Option<String> {
    let (what, column, answer) = match finding.kind {
        Kind::Round => ("if it is not round, read", Column::Shape, "box"),
        Kind::Casters => ("if all are braked, read", Column::Casters, "braked"),
        _ => return None,
    };
    let row = finding.rows.first()?;
    let next = sheet
        .rows
        .iter()
        .filter_map(|row| row.cells.last())
        .map(|(last, _)| last + 1)
        .max()?;
    let known = columns.get(column).map(|one| one.index);
    let place = letters(known.unwrap_or(next) as usize);
    let heading = format!(
        "`edit = \"{place}{}={}\"` ",
        sheet.header.row,
        column.name()
    );
    let heading = if known.is_some() {
        ""
    } else {
        heading.as_str()
    };
    let otherwise = if finding.kind == Kind::Casters {
        "; if it has none, correct this cell"
    } else {
        ""
    };
    Some(format!(
        "{what} {heading}`edit = \"{place}{row}={answer}\"`{otherwise}"
    ))
}

/// What a list that was edited says about itself.
pub(super) fn edited(edits: &[Edit]) -> Option<String> {
    const NAMED: usize = 10;
    let mut cells: Vec<String> = edits.iter().take(NAMED).map(Edit::cell).collect();
    if edits.len() > NAMED {
        cells.push("…".to_owned());
    }
    let verb = if edits.len() == 1 {
        "cell was"
    } else {
        "cells were"
    };
    let said = format!(
        "{} {verb} read as corrected, not as in the file: {}",
        edits.len(),
        cells.join(", ")
    );
    (!edits.is_empty()).then_some(said)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inventory::{ReadOptions, Reading, parse_inventory};
    use crate::library::Lookup;

    const LIST: &str =
        "id,item,height,thickness,mass\nA,cabinet,1800 mm,40 apples,150 kg\nB,shelf,2 m,0.3 m,\n";

    fn read(edits: &[&str]) -> Result<Reading, String> {
        let edits: Vec<Edit> = edits
            .iter()
            .map(|text| Edit::parse(text).unwrap())
            .collect();
        let options = ReadOptions {
            edits: &edits,
            wants_cells: true,
            ..ReadOptions::new(&Lookup::NONE)
        };
        parse_inventory(LIST.into(), "list.csv".as_ref(), &options)
            .map_err(|problems| problems.to_string())
    }

    #[test]
    fn a_corrected_cell_is_read_and_said() {
        let plain = read(&[]).unwrap();
        assert_eq!(
            (
                plain.inventory.items[0].thickness_m,
                plain.inventory.findings.len()
            ),
            (None, 1)
        );
        let mended = read(&["D2=40 cm", "E3= 80 kg "]).unwrap();
        let items = &mended.inventory.items;
        assert_eq!(
            (items[0].thickness_m, items[1].mass_kg, items[1].height_m),
            (Some(0.4), Some(80.0), Some(2.0))
        );
        assert!(mended.inventory.findings.is_empty());
        let said = "2 cells were read as corrected, not as in the file: D2, E3";
        assert!(
            mended
                .inventory
                .warnings
                .iter()
                .any(|warning| warning == said),
            "{:?}",
            mended.inventory.warnings
        );
        assert_eq!(
            mended.cells[0].texts,
            ["A", "cabinet", "1800 mm", "40 cm", "150 kg"]
        );
        // The file is the same file: its fingerprint is that of its bytes.
        assert_eq!(mended.inventory.sha256, plain.inventory.sha256);
        // An empty text empties the cell.
        assert_eq!(read(&["C3="]).unwrap().inventory.items[1].height_m, None);
    }

    #[test]
    fn only_cells_of_objects_are_corrected() {
        for (edit, why) in [
            ("D1=depth", "below row 1"),
            ("F2=1", "no heading"),
            ("A9=C", "row is empty"),
        ] {
            let told = read(&[edit]).unwrap_err();
            assert!(told.contains(why), "{edit}: {told}");
        }
        // A column of its own.
        let shaped = read(&["F1=shape", "F2=box", "F3=round"])
            .unwrap()
            .inventory
            .items;
        assert_eq!([shaped[0].is_round, shaped[1].is_round], [false, true]);
        let twice = read(&["D2=40 cm", "d2=50 cm"]).unwrap_err();
        assert!(twice.contains("cell D2 is changed twice"), "{twice}");
        // What contains `=` is not another cell, and a cell has one line.
        for (cell, text) in [
            ("C2=5\nD2", "1"),
            ("C2\nD2", "1"),
            ("C2=5", "1"),
            ("C 2", "1"),
            ("C+2", "1"),
            ("C2", "1\n2"),
        ] {
            assert!(Edit::new(cell, text).is_err(), "{cell:?} {text:?}");
        }
        for text in [
            "D7",
            "7=1",
            "D=1",
            "=1",
            "D0=1",
            "ÄÄ1=2",
            "XFE1=1",
            "D99999999999=1",
            "ZZZZZZZZZZZZ1=1",
        ] {
            assert!(Edit::parse(text).is_err(), "{text}");
        }
        assert_eq!(
            Edit::parse("XFD1048576=a=b").unwrap().to_string(),
            "XFD1048576=a=b"
        );
    }
}
