//! Files that break readers: each a clear error, or read, in bounded time and memory.

use std::sync::LazyLock;

use proptest::prelude::*;

use crate::library::Lookup;

use super::*;

/// A data row of a workbook whose cell D (the height) is `height`.
fn with_height(height: &str) -> Vec<u8> {
    workbook(
        &(row(1, &HEADINGS) + &row(2, &["a", "x", "0.5", height, "600", ""])),
        "",
    )
}

/// A CSV with one could not be read again, and a spreadsheet cannot open a workbook with one. The check of the list says
/// where they are before.
#[test]
fn a_control_character_is_told_and_not_converted() {
    let mut headings = HEADINGS;
    headings[5] = "ma\u{1}ker";
    let book = workbook(
        &(row(1, &headings) + &row(2, &["a", "x", "0.5", "1800", "600", "y\u{2}"])),
        "",
    );
    for target in [Target::Csv, Target::Xlsx] {
        let error = convert_bytes(book.clone(), Path::new("objects"), None, target).unwrap_err();
        let said = "contains a control character, which nobody sees and most programs refuse";
        let messages: Vec<&str> = error
            .problems
            .iter()
            .map(|problem| problem.message.as_str())
            .collect();
        assert!(
            messages.len() == 2 && messages.iter().all(|one| one.ends_with(said)),
            "{messages:?}"
        );
    }
    let lines = found(book);
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(
        lines[0].starts_with("doubt: unprintable: ma ker: 2 cells (F1, F2)"),
        "{lines:?}"
    );
}

#[test]
fn cells_that_are_not_numbers() {
    for (cell, kind, said) in [
        (
            "<t=\"e\"><v>#REF!</v></c>",
            "formula",
            "is the error of a formula",
        ),
        ("<t=\"b\"><v>1</v></c>", "unreadable", "such as \"TRUE\""),
        ("<s=\"1\"><v>45413</v></c>", "unreadable", "is a date"),
        ("<><f>B1*2</f></c>", "formula", "a formula without a value"),
        ("<t=\"d\"><v>2024-05-01</v></c>", "unreadable", "is a date"),
        ("18 00", "unreadable", "such as \"18 00\""),
    ] {
        let lines = found(with_height(cell));
        let start = format!("error: {kind}: height [mm]: 1 cell (D2)");
        assert!(
            lines.len() == 1 && lines[0].starts_with(&start) && lines[0].contains(said),
            "{lines:?}"
        );
    }
    for (cell, height) in [("1.500,5", 1.5005), ("1 800", 1.8)] {
        assert_eq!(
            read(with_height(cell)).unwrap().inventory.items[0].height_m,
            Some(height)
        );
    }
}

#[test]
fn formulas_give_their_saved_values() {
    let reading = read(with_height("<><f>900*2</f><v>1800</v></c>")).unwrap();
    assert_eq!(reading.inventory.items[0].height_m, Some(1.8));
    assert_eq!(
        reading.inventory.warnings,
        ["1 cell contains a formula, the first in D2: the saved values are read"]
    );
    let carried = row(1, &HEADINGS)
        + &row(
            2,
            &["a", "x", "0.5", "1800", "600", "<t=\"e\"><v>#N/A</v></c>"],
        );
    let reading = read(workbook(&carried, "")).unwrap();
    assert_eq!(reading.inventory.items[0].carried, ["#N/A"]);
    assert!(reading.inventory.warnings[0].starts_with("row 2: an error such as #REF!"));
}

#[test]
fn merged_cells_have_the_value_of_the_first() {
    let rows = row(1, &HEADINGS)
        + &row(2, &["a", "x", "0.5", "1800", "600"])
        + &row(3, &["b", "y", "", "1800", "600"]);
    let merged = "<mergeCells count=\"1\"><mergeCell ref=\"C2:C3\"/></mergeCells>";
    assert_eq!(
        read(workbook(&rows, merged)).unwrap().inventory.items[1].level_ratio,
        Some(0.5)
    );
    assert_eq!(
        read(workbook(&rows, "")).unwrap().inventory.items[1].level_ratio,
        None
    );
    // A mass over two rows may be that of both.
    let heads = [
        "id",
        "item",
        "level_ratio",
        "height [mm]",
        "thickness [mm]",
        "mass [kg]",
    ];
    let rows = row(1, &heads)
        + &row(2, &["a", "x", "0", "1800", "600", "85"])
        + &row(3, &["b", "y", "0", "1800", "600"]);
    let merged = "<mergeCells count=\"1\"><mergeCell ref=\"F2:F3\"/></mergeCells>";
    let inventory = read(workbook(&rows, merged)).unwrap().inventory;
    assert_eq!(
        (inventory.items[1].mass_kg, inventory.findings[0].kind),
        (None, Kind::Merged)
    );
    // A merged title costs nothing.
    let title = "<mergeCells count=\"1\"><mergeCell ref=\"A1:XFD1\"/></mergeCells>";
    let rows =
        row(1, &["Register"]) + &row(2, &HEADINGS) + &row(3, &["a", "x", "0.5", "1800", "600"]);
    assert_eq!(
        read(workbook(&rows, title)).unwrap().inventory.items.len(),
        1
    );
}

#[test]
fn a_range_of_a_million_rows_costs_nothing() {
    blank_rows_cost_nothing(100);
}

#[test]
#[ignore = "ten seconds: a million rows"]
fn a_million_blank_rows_cost_nothing() {
    blank_rows_cost_nothing(1);
}

fn blank_rows_cost_nothing(step: usize) {
    let mut rows = row(1, &HEADINGS) + &row(2, &["a", "x", "0.5", "1800", "600"]);
    for number in (3..1_048_576).step_by(step).chain([1_048_576]) {
        rows += &format!("<row r=\"{number}\"><c r=\"A{number}\" s=\"0\"/></row>");
    }
    let book = workbook(&rows, "");
    // A reader that makes a table of the used range needs 137 GB.
    assert_eq!(read(book).unwrap().inventory.items.len(), 1);
}

#[test]
#[ignore = "seconds: sheets with thousands of columns"]
fn wide_sheets() {
    let mut headings: Vec<String> = HEADINGS.iter().map(|&text| text.to_owned()).collect();
    headings.extend((headings.len()..16_384).map(|n| format!("x{n}")));
    let texts: Vec<&str> = headings.iter().map(String::as_str).collect();
    let wide = workbook(
        &(row(1, &texts) + &row(2, &["a", "x", "0.5", "1800", "600"])),
        "",
    );
    for bytes in [
        wide,
        (headings.join(",") + "\na,x,0.5,1800,600\n").into_bytes(),
    ] {
        let inventory = read(bytes).unwrap().inventory;
        assert_eq!(inventory.carried.len(), 256);
        assert!(
            inventory
                .warnings
                .iter()
                .any(|warning| warning.starts_with("16123 columns that are not read are left out"))
        );
    }
    let unnamed = row(1, &HEADINGS) + &row(2, &["a", "x", "0.5", "1800", "600", "", "stray"]);
    assert!(
        read(workbook(&unnamed, "")).unwrap().inventory.warnings[0]
            .starts_with("row 2: cells in columns without a heading")
    );
}

#[test]
fn a_cell_of_ten_megabytes() {
    let long = "x".repeat(10 << 20);
    let rows = row(1, &HEADINGS)
        + &row(2, &["a", &long, "0.5", "1800", "600"])
        + &row(3, &["b", "y", "0.5", "1800", "600", &long]);
    let inventory = read(workbook(&rows, "")).unwrap().inventory;
    let line = inventory.findings[0].line();
    assert!(
        line.starts_with("error: unreadable: item: 1 cell (B2); has 10485760 characters"),
        "{line}"
    );
    assert!(
        inventory.warnings[0].starts_with("row 3: a cell without a value"),
        "{:?}",
        inventory.warnings
    );
    let said = problems(format!(
        "id,item,level_ratio,height [m],depth [m]\na,{long},0,1,1\n"
    ));
    assert!(said[0].contains("row 2 has 10 MB"), "{said:?}");
}

/// Text of this many bytes that deflate compresses about 80-fold, as it does a real sheet: words,
/// which cost some bytes each, between blanks. Blanks alone would compress much further.
fn varied(bytes: usize) -> Vec<u8> {
    let word = |n: u64| format!("{:<1500}", n.wrapping_mul(0x9E37_79B9_7F4A_7C15)).into_bytes();
    (0..).flat_map(word).take(bytes).collect()
}

/// A workbook of many sheets that are copies of one, compressed once.
fn archive_of_copies(sheet: &[u8], copies: usize) -> Vec<u8> {
    let whole = parts(&[("Objects", "", &self::sheet(&row(1, &HEADINGS), ""))]);
    let one = archive_of(&[("sheet.xml".to_owned(), sheet.to_vec())]);
    let mut archive = ZipWriter::new_append(Cursor::new(archive_of(&whole))).unwrap();
    for copy in 0..copies {
        let mut one = zip::ZipArchive::new(Cursor::new(&one)).unwrap();
        let file = one.by_index_raw(0).unwrap();
        archive
            .raw_copy_file_rename(file, format!("xl/worksheets/sheet{}.xml", copy + 2))
            .unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn archives_that_unpack_to_too_much_or_lie() {
    let parts_with = |name: &str, bytes: Vec<u8>| {
        let mut parts = parts(&[("Objects", "", &sheet(&row(1, &HEADINGS), ""))]);
        parts.retain(|(other, _)| other != name);
        parts.push((name.to_owned(), bytes));
        archive_of(&parts)
    };
    // 1 : 1000, as far as deflate goes.
    let bomb = parts_with("xl/worksheets/sheet2.xml", vec![b' '; 300 << 20]);
    assert!(bomb.len() < 1 << 20);
    let said = problems(&bomb);
    assert!(said[0].contains("unpacks to more than 64 MiB"), "{said:?}");
    let styles = parts_with("xl/styles.xml", vec![b' '; 17 << 20]);
    assert!(problems(styles)[0].contains("unpacks to more than 1"));
    // Sheets of 8 MiB with an ordinary ratio, compressed once: together just over the limit.
    let said = problems(archive_of_copies(&varied(8 << 20), 65));
    assert!(said[0].contains("unpacks to more than 512 MiB"), "{said:?}");
    // The reader would allocate 24 bytes for each declared text.
    let liar = format!("<sst xmlns=\"{MAIN}\" uniqueCount=\"99999999999\"><si><t>a</t></si></sst>");
    assert!(
        problems(parts_with("xl/sharedStrings.xml", liar.into_bytes()))[0]
            .contains("declares 99999999999 texts")
    );
    let places = sheet("<row r=\"1\"><c r=\"ZZZZZZZZZZ99999999999\"/></row>", "");
    assert!(
        problems(parts_with("xl/worksheets/sheet1.xml", places.into_bytes()))[0]
            .contains("which no sheet has")
    );
    // A header that declares a wrong size is detected by the checksum and the count.
    let mut lying = workbook(&row(1, &HEADINGS), "");
    let start = lying
        .windows(4)
        .position(|four| four == b"PK\x01\x02")
        .unwrap();
    lying[start + 24..start + 28].copy_from_slice(&3u32.to_le_bytes());
    let _ = read(&lying);
    lying[start + 16..start + 20].copy_from_slice(&[1, 2, 3, 4]);
    assert!(problems(&lying)[0].contains("damaged"));
}

/// Four million cells in 60 MB of XML, which compress to less than one; `source` tests the count.
#[test]
#[ignore = "twenty seconds: four million cells"]
fn a_sheet_of_too_many_cells_is_refused() {
    let cells = "<c><v>1</v></c>".repeat(16_000);
    let row = |number: usize| format!("<row r=\"{number}\">{cells}</row>");
    let rows: String = (2..253).map(row).collect();
    let book = workbook(&(super::row(1, &HEADINGS) + &rows), "");
    let said = problems(&book);
    assert!(
        said[0].contains("the sheet has more than 4000000 cells, too many for an inventory"),
        "{said:?}"
    );
}

#[test]
fn what_is_no_inventory_at_all() {
    let book = workbook(
        &(row(1, &HEADINGS) + &row(2, &["a", "x", "0.5", "1800", "600"])),
        "",
    );
    for cut in [3, 30, book.len() / 2, book.len() - 1] {
        assert!(problems(&book[..cut]).len() == 1, "{cut}");
    }
    let nested = archive_of(&[("objects.xlsx".to_owned(), book)]);
    assert!(
        problems(nested)[0].contains("is a zip file that contains objects.xlsx | unpack it first")
    );
    let ods = archive_of(&[(
        "mimetype".to_owned(),
        b"application/vnd.oasis.opendocument.spreadsheet".to_vec(),
    )]);
    assert!(
        problems(&ods)[0].contains("zip file"),
        "deflated, its type is not visible"
    );
    let stored = [
        b"PK\x03\x04................................mimetypeapplication/vnd.oasis.opendocument.spreadsheet".as_slice(),
        &ods,
    ]
    .concat();
    assert!(problems(stored)[0].contains("OpenDocument"));
    for (bytes, said) in [
        (
            b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1".to_vec(),
            "old workbook (.xls), or one with a password",
        ),
        (Vec::new(), "empty"),
        (b"\x7FELF\x02\x01\x01\0\0\0".to_vec(), "not text"),
        (
            b"id,level_ratio,height [m],depth [m]\na,0,1\0,1\n".to_vec(),
            "NUL",
        ),
        (
            b"id,level_ratio,height [m],depth [m]\n\"a,0,1,1\nb,0,1,1\n".to_vec(),
            "a quote is not closed",
        ),
    ] {
        assert!(problems(&bytes)[0].contains(said), "{:?}", problems(&bytes));
    }
    // Rows in falling order would overwrite earlier ones.
    let rows = row(3, &HEADINGS)
        + &row(5, &["a", "x", "0.5", "1800", "600"])
        + &row(4, &["b", "x", "0.5", "1800", "600"]);
    assert!(problems(workbook(&rows, ""))[0].contains("row 4 follows row 5"));
}

/// A bound on cells, where `wide_sheets` has one on columns.
#[test]
#[ignore = "ten seconds: a hundred thousand rows"]
fn columns_carried_through_are_bounded() {
    // 200 columns × 100,001 rows are one row over the limit.
    let mut text = "id,level_ratio,height [m],depth [m]".to_owned();
    for n in 0..200 {
        text += &format!(",x{n}");
    }
    for n in 0..100_001 {
        text += &format!("\n{n},0,1,1");
    }
    let inventory = read(text).unwrap().inventory;
    assert_eq!(
        (inventory.items.len(), inventory.carried.len()),
        (100_001, 199)
    );
}

fn check(bytes: Vec<u8>) {
    match parse_inventory(
        bytes.clone(),
        Path::new("objects"),
        &ReadOptions::new(&Lookup::NONE),
    ) {
        Ok(reading) => {
            assert!(!reading.inventory.items.is_empty());
            let finite =
                |value: Option<f64>| value.is_none_or(|value| value.is_finite() && value >= 0.0);
            for item in &reading.inventory.items {
                assert!(
                    !item.id.is_empty()
                        && item.quantity > 0
                        && item.carried.len() == reading.inventory.carried.len()
                );
                assert!(
                    finite(item.height_m)
                        && finite(item.thickness_m)
                        && finite(item.mass_kg)
                        && finite(item.level_ratio)
                );
            }
        }
        Err(error) => {
            for problem in &error.problems {
                assert!(
                    problem.path.is_some() && problem.hint.is_some() && !problem.message.is_empty(),
                    "{problem:?}"
                );
            }
        }
    }
    let _ = convert_bytes(bytes, Path::new("objects"), None, Target::Csv);
}

/// The last one is UTF-16 without a mark.
static TEMPLATES: LazyLock<[Vec<u8>; 3]> = LazyLock::new(|| {
    let text = template_csv().unwrap();
    let wide = text.iter().flat_map(|&byte| [byte, 0]).collect();
    [text, template_xlsx().unwrap(), wide]
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn changed_bytes_never_break_the_reader(
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..8),
        kind in 0..3usize,
        cut in proptest::option::of(any::<proptest::sample::Index>()),
    ) {
        let mut bytes = TEMPLATES[kind].clone();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        check(bytes);
    }

    #[test]
    fn changed_xml_never_breaks_the_reader(
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..6),
        part in 0..6usize,
    ) {
        let cells = ["a", "x", "0.5", "<s=\"1\"><v>45413</v></c>", "<><f>1</f><v>600</v></c>"];
        let rows = row(1, &HEADINGS) + &row(2, &cells);
        let merged = "<mergeCells count=\"1\"><mergeCell ref=\"C2:C3\"/></mergeCells>";
        let mut parts = parts(&[("Objects", "", &sheet(&rows, merged))]);
        let count = parts.len();
        let bytes = &mut parts[part % count].1;
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        check(archive_of(&parts));
    }

    #[test]
    fn any_text_is_read_or_refused(text in "[a-c0-9,;\"'\\t\\n\\r\\. =+\\-@]{0,200}") {
        check(format!("id,item,level_ratio,height [mm],thickness [mm],x\n{text}").into_bytes());
        check(text.into_bytes());
    }
}
