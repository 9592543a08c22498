use std::io::Cursor;

use calamine::{Data, DataType, Reader, Xlsx, open_workbook_from_rs};

use crate::assessment::Wanted;
use crate::assessment::fixture::{HOSTILE, TABLES, hostile_items, inventory, item, read, written};
use crate::assessment::table::COLUMNS;

use super::*;

const ALONE: Wanted = Wanted {
    workbook: true,
    ..TABLES
};

fn bytes(inventory: &Inventory, assessed: usize) -> Vec<u8> {
    let (folder, names) = written(inventory, assessed, ALONE);
    assert_eq!(names, [WORKBOOK_NAME, "objects.csv", "worklist.csv"]);
    read(&folder, WORKBOOK_NAME)
}

type Cells = Vec<Vec<Data>>;

fn sheet_of(bytes: &[u8], name: &str) -> Cells {
    let mut book: Xlsx<_> = open_workbook_from_rs(Cursor::new(bytes.to_vec())).unwrap();
    let range = book.worksheet_range(name).unwrap();
    // A range begins at its first cell that is not empty, which is A1 in all of our sheets.
    assert_eq!(range.start(), Some((0, 0)));
    range.rows().map(<[Data]>::to_vec).collect()
}

fn at<'c>(cells: &'c Cells, header: usize, row: usize, name: &str) -> &'c Data {
    let column = cells[header]
        .iter()
        .position(|cell| *cell == Data::String(name.to_owned()))
        .unwrap();
    &cells[row][column]
}

#[test]
fn the_sheets_are_there_in_order() {
    let book: Xlsx<_> = open_workbook_from_rs(Cursor::new(bytes(
        &inventory((0..3).map(item).collect()),
        3,
    )))
    .unwrap();
    assert_eq!(
        book.sheet_names(),
        ["Summary", "Objects", "Audit", "Columns", "Sources"]
    );
}

#[test]
fn the_objects_are_those_of_the_table() {
    let bytes = bytes(&inventory((0..5).map(item).collect()), 4);
    let cells = sheet_of(&bytes, "Objects");
    assert_eq!(cells.len(), 6);
    for (column, header) in COLUMNS.iter().zip(&cells[0]) {
        assert_eq!(*header, Data::String(column.name.to_owned()));
    }
    assert_eq!(
        *at(&cells, 0, 1, "edge_acceleration_g_median"),
        Data::Float(4.2)
    );
    assert_eq!(
        *at(&cells, 0, 1, "edge_acceleration_g_p84"),
        Data::String("overturned".into())
    );
    assert_eq!(*at(&cells, 0, 1, "width_m"), Data::Empty);
    assert_eq!(*at(&cells, 0, 5, "decision"), Data::Empty);
    // A text of the inventory stays a text, although it looks like a number.
    assert_eq!(
        *at(&cells, 0, 1, "rank (inventory)"),
        Data::String("-12".into())
    );
    let columns = sheet_of(&bytes, "Columns");
    assert_eq!(
        columns[1][..2],
        [Data::String("rank".into()), Data::String("–".into())]
    );
    assert!(
        sheet_of(&bytes, "Summary")
            .iter()
            .flatten()
            .any(|cell| cell.to_string().starts_with("PARTIAL: 4 of 5"))
    );
    let sources = sheet_of(&bytes, "Sources");
    assert!(
        sources
            .iter()
            .any(|row| row[1] == Data::String("ASCE 7-22, 13.3.1".into()))
    );
}

#[test]
fn text_is_never_a_formula() {
    let bytes = bytes(&inventory(hostile_items()), 8);
    let cells = sheet_of(&bytes, "Objects");
    for (row, text) in HOSTILE.iter().enumerate() {
        let Data::String(shown) = at(&cells, 0, row + 1, "notes") else {
            panic!("row {row} is not a text")
        };
        // Excel keeps one kind of line ending, and characters that XML cannot hold are left out.
        let plain = |text: &str| {
            text.replace(['\r', '\u{fffe}', '\u{1}'], "")
                .replace("_x0001_", "")
                .replace("_x000D_", "")
        };
        assert_eq!(plain(shown), plain(text));
    }
    let mut book: Xlsx<_> = open_workbook_from_rs(Cursor::new(bytes)).unwrap();
    for name in ["Summary", "Objects", "Columns", "Sources"] {
        let formulas = book.worksheet_formula(name).unwrap();
        assert!(formulas.used_cells().next().is_none(), "{name}");
    }
}

/// The formulas in the file are those of the paper; they were evaluated by hand for one block.
#[test]
fn the_formulas_are_live() {
    let inventory = inventory((0..6).map(item).collect());
    let bytes = bytes(&inventory, 6);
    let cells = sheet_of(&bytes, "Audit");
    let header = cells
        .iter()
        .position(|row| row[0] == Data::String("rank".into()))
        .unwrap();
    assert_eq!(cells.len(), header + 7);
    let mut book: Xlsx<_> = open_workbook_from_rs(Cursor::new(bytes)).unwrap();
    let formulas = book.worksheet_formula("Audit").unwrap();
    let column = |name: &str| {
        let found = cells[header]
            .iter()
            .position(|cell| cell.to_string().starts_with(name));
        u32::try_from(found.unwrap()).unwrap()
    };
    let formula = |name: &str| {
        formulas
            .get_value((header as u32 + 1, column(name)))
            .unwrap()
            .clone()
    };
    assert_eq!(formula("R_D landing_ratio"), "1-3/8*U9");
    assert_eq!(
        formula("a drop_acceleration_g"),
        "SQRT(2*K9*$B$4*L9/J9)/$B$4"
    );
    assert_eq!(
        formula("a_edge edge_acceleration_g"),
        "3/4/SQRT(1-W9^2)*U9*Z9"
    );
    assert_eq!(cells[header + 1][4], Data::String("Eqs. (5)–(7)".into()));
    // The second item has inset feet.
    assert_eq!(cells[header + 2][4], Data::String("general block".into()));
    let shown = |name: &str| {
        cells[header + 1][column(name) as usize]
            .get_float()
            .unwrap()
    };
    let chain = crate::assessment::fixture::chain(&inventory.items[0]).unwrap();
    assert_eq!(shown("a_edge: value"), chain.edge_acceleration_g);
    assert_eq!(shown("a_edge edge"), chain.edge_acceleration_g);
}

#[test]
fn the_same_rows_give_the_same_bytes() {
    let inventory = inventory((0..7).map(item).collect());
    assert!(bytes(&inventory, 7) == bytes(&inventory, 7));
    assert_eq!(
        sheet_of(&bytes(&self::inventory_of(0), 0), "Objects").len(),
        1
    );
}

fn inventory_of(count: usize) -> Inventory {
    inventory((0..count).map(item).collect())
}

/// Large workbooks, whose sheets are in temporary files, have the same cells.
#[test]
fn large_and_small_workbooks_are_alike() {
    let count = LARGE + 1;
    let inventory = inventory_of(count);
    // Rows without results are cheap and use the same code.
    let cells = sheet_of(&bytes(&inventory, 3), "Objects");
    assert_eq!(cells.len(), count + 1);
    assert_eq!(
        *at(&cells, 0, 1, "edge_acceleration_g_median"),
        Data::Float(4.2)
    );
    assert_eq!(
        *at(&cells, 0, count, "id"),
        Data::String(format!("O-{:04}", count - 1))
    );
}
