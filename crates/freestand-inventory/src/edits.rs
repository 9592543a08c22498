//! Cells that the user corrects while a list is read: the file itself is never changed.

use freestand_input::problem::{Problem, ProblemKind};

use super::cell::Cell;
use super::columns::{Column, letters};
use super::edit::Edit;
use super::layout::Header;
use super::problems::{Finding, Kind};
use super::source::Sheet;
use super::used::Understood;

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
            let row = row.map_err(|_| refused("its row is empty"))?;
            let row = &mut self.rows[row];
            let cell = Cell::text(edit.text.clone());
            match row
                .cells
                .binary_search_by_key(&edit.column, |(column, _)| *column)
            {
                Ok(at) if edit.text.is_empty() => _ = row.cells.remove(at),
                Ok(at) => row.cells[at].1 = cell,
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
    let heading = match known {
        Some(_) => String::new(),
        None => format!(
            "`edit = \"{place}{}={}\"` ",
            sheet.header.row,
            column.name()
        ),
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
    use crate::library::Lookup;
    use crate::{ReadOptions, Reading, parse_inventory};

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
        assert_eq!([shaped[0].is_round(), shaped[1].is_round()], [false, true]);
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
