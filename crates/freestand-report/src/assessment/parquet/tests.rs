use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};

use crate::assessment::Wanted;
use crate::assessment::fixture::{HOSTILE, TABLES, hostile_items, inventory, item, read, written};

use super::*;

const ALONE: Wanted = Wanted {
    parquet: true,
    ..TABLES
};

fn bytes(inventory: &Inventory, assessed: usize) -> Vec<u8> {
    let (folder, names) = written(inventory, assessed, ALONE);
    assert_eq!(names, ["objects.csv", PARQUET_NAME, "worklist.csv"]);
    read(&folder, PARQUET_NAME)
}

fn reader(bytes: Vec<u8>) -> SerializedFileReader<impl parquet::file::reader::ChunkReader> {
    let file = tempfile::tempfile().unwrap();
    std::io::Write::write_all(&mut &file, &bytes).unwrap();
    SerializedFileReader::new(file).unwrap()
}

fn rows(bytes: Vec<u8>) -> Vec<Row> {
    reader(bytes)
        .get_row_iter(None)
        .unwrap()
        .map(Result::unwrap)
        .collect()
}

fn at<'r>(row: &'r Row, name: &str) -> &'r Field {
    row.get_column_iter()
        .find(|(header, _)| *header == name)
        .unwrap()
        .1
}

#[test]
fn columns_keep_their_types() {
    let rows = rows(bytes(&inventory((0..5).map(item).collect()), 4));
    assert_eq!(rows.len(), 5);
    assert_eq!(*at(&rows[0], "id"), Field::Str("O-0000".into()));
    assert_eq!(*at(&rows[0], "rank"), Field::Long(4));
    assert_eq!(
        *at(&rows[0], "edge_acceleration_g_median"),
        Field::Double(4.2)
    );
    assert_eq!(
        *at(&rows[0], "edge_acceleration_g_median_overturned"),
        Field::Bool(false)
    );
    assert_eq!(*at(&rows[0], "edge_acceleration_g_p84"), Field::Null);
    assert_eq!(
        *at(&rows[0], "edge_acceleration_g_p84_overturned"),
        Field::Bool(true)
    );
    assert_eq!(*at(&rows[0], "tolerance_decides"), Field::Bool(true));
    assert_eq!(*at(&rows[0], "width_m"), Field::Null);
    assert_eq!(*at(&rows[1], "width_m"), Field::Double(0.8));
    assert_eq!(*at(&rows[2], "demand_capacity_ratio"), Field::Null);
    assert_eq!(
        *at(&rows[2], "demand_capacity_ratio_overturned"),
        Field::Null
    );
    // Not assessed, but present.
    assert_eq!(
        (at(&rows[4], "decision"), at(&rows[4], "rank")),
        (&Field::Null, &Field::Null)
    );
    assert_eq!(*at(&rows[4], "Asset"), Field::Str("A4".into()));
    assert_eq!(*at(&rows[4], "rank (inventory)"), Field::Str("-12".into()));
}

#[test]
fn texts_stay_as_they_are() {
    let rows = rows(bytes(&inventory(hostile_items()), 8));
    for (row, text) in rows.iter().zip(HOSTILE) {
        assert_eq!(*at(row, "notes"), Field::Str(text.to_owned()));
    }
}

#[test]
fn the_file_says_what_its_reader_must_know() {
    let value = |assessed: usize, key: &str| {
        let reader = reader(bytes(&inventory((0..3).map(item).collect()), assessed));
        let values = reader
            .metadata()
            .file_metadata()
            .key_value_metadata()
            .unwrap()
            .clone();
        values
            .into_iter()
            .find(|value| value.key == key)
            .unwrap()
            .value
            .unwrap()
    };
    assert_eq!(value(3, "freestand.partial"), "no");
    assert!(value(2, "freestand.partial").starts_with("PARTIAL: 2 of 3"));
    let columns: serde_json::Value = serde_json::from_str(&value(3, "freestand.columns")).unwrap();
    assert_eq!(columns["uplift_m_median"]["unit"], "m");
    assert_eq!(value(3, "freestand.version"), env!("CARGO_PKG_VERSION"));
}

#[test]
#[ignore = "seconds: many rows"]
fn the_same_rows_give_the_same_bytes_in_groups() {
    let many = inventory((0..45).map(item).collect());
    assert!(bytes(&many, 45) == bytes(&many, 45));
    assert_eq!(rows(bytes(&inventory(vec![]), 0)).len(), 0);
    // Names of 8 MB each: a group ends at 64 MB, whatever the number of rows.
    let mut items: Vec<_> = (0..10).map(item).collect();
    for item in &mut items {
        item.item = "x".repeat(8 << 20);
    }
    let reader = reader(bytes(&inventory(items), 0));
    assert_eq!(
        (
            reader.metadata().num_row_groups(),
            reader.metadata().file_metadata().num_rows()
        ),
        (2, 10)
    );
}
