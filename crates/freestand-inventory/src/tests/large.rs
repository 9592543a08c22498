//! Inventories of a city.

use std::fmt::Write;
use std::time::Instant;

use super::*;

/// Rows as in an asset register: both axes, pads, tolerance, two other columns.
fn register(rows: usize) -> String {
    let mut text =
        "id,item,quantity,building,floor,room,LS,PL,FL,level_ratio,height [mm],depth [mm],width [mm],mass [kg],\
        pad_stiffness [N/mm],pads_per_edge,tolerance [g],tolerance_duration [ms],friction,notes,maker,bought\n"
            .to_owned();
    for n in 0..rows {
        let (height, depth, level) = (1000 + n % 1300, 300 + n % 400, (n % 101) as f64 / 100.0);
        writeln!(
            text,
            "obj-{n},cabinet {},1,Block {},Level {},{},H,M,L,{level},{height},{depth},900,{},2190,2,5,11,0.3-0.5,note \
             {n},maker {},2019",
            n % 50,
            n % 7,
            n % 12,
            n % 300,
            80 + n % 200,
            n % 9
        )
        .unwrap();
    }
    text
}

/// The most memory that this process has had \[MB\], where the system reports it.
fn peak_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? / 1024)
}

fn measured(bytes: &[u8], rows: usize) -> Inventory {
    let started = Instant::now();
    let inventory = read(bytes).unwrap().inventory;
    println!(
        "{rows} rows, {} MB: {:?}, peak {:?} MB",
        bytes.len() >> 20,
        started.elapsed(),
        peak_mb()
    );
    assert_eq!(inventory.items.len(), rows);
    inventory
}

/// Rows of a CSV, and as many of them from a workbook.
fn are_read(rows: usize, in_a_book: usize) {
    let from_csv = measured(register(rows).as_bytes(), rows);
    let book = register(in_a_book).into_bytes();
    let book = convert_bytes(book, Path::new("objects"), None, Target::Xlsx)
        .unwrap()
        .bytes;
    println!("converted: peak {:?} MB", peak_mb());
    assert!(measured(&book, in_a_book).items == from_csv.items[..in_a_book]);
}

#[test]
#[ignore = "seconds: a thousand rows in every format"]
fn a_thousand_rows_are_read() {
    are_read(2_000, 1_000);
}

/// More rows than 16 bits count.
#[test]
#[ignore = "half a minute: 66,000 rows"]
fn many_rows_are_read() {
    are_read(66_000, 20_000);
}
