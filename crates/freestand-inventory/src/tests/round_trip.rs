//! From CSV to a workbook and back: every cell as it was.

use proptest::prelude::*;

use super::*;

fn convert(bytes: &[u8], target: Target) -> Vec<u8> {
    convert_bytes(bytes.to_vec(), Path::new("objects"), None, target)
        .unwrap()
        .bytes
}

#[test]
fn text_never_becomes_a_formula() {
    let text = "id,item,level_ratio,height [mm],thickness [mm],maker\n\
        a,'=HYPERLINK(\"x\"),0.50,1800,600,'@cmd\nb,'-,1,1800,600,'+1\nc,'=1,1,1800,600,''-2\n";
    let text = text.replace("'=HYPERLINK(\"x\")", "\"'=HYPERLINK(\"\"x\"\")\"");
    let book = convert(text.as_bytes(), Target::Xlsx);
    // No formula is in the workbook.
    let mut archive = zip::ZipArchive::new(Cursor::new(&book)).unwrap();
    let mut xml = String::new();
    std::io::Read::read_to_string(
        &mut archive.by_name("xl/worksheets/sheet1.xml").unwrap(),
        &mut xml,
    )
    .unwrap();
    assert!(!xml.contains("<f>"), "{xml}");
    let items = read(&book).unwrap().inventory.items;
    assert_eq!(items[0].item, "=HYPERLINK(\"x\")");
    assert_eq!(
        [
            &items[0].carried[0],
            &items[1].carried[0],
            &items[2].carried[0]
        ],
        ["@cmd", "+1", "'-2"]
    );
    assert_eq!(
        String::from_utf8(convert(&book, Target::Csv)).unwrap(),
        text
    );
    assert_eq!(read(&text).unwrap().inventory.items, items);
}

#[test]
fn the_template_is_an_inventory_and_always_the_same() {
    let (csv, book) = (template_csv().unwrap(), template_xlsx().unwrap());
    assert_eq!(book, template_xlsx().unwrap());
    let (from_csv, from_book) = (read(&csv).unwrap(), read(&book).unwrap());
    assert_eq!(from_csv.inventory.items, from_book.inventory.items);
    assert_eq!(
        from_csv.columns.len(),
        COLUMNS.iter().filter(|spec| spec.is_in_template).count()
    );
    assert_eq!(from_book.inventory.sheet.as_deref(), Some("Inventory"));
    let findings = &from_csv.inventory.findings;
    // The third example is a gas cylinder.
    let kinds: Vec<(Kind, &[u32])> = findings
        .iter()
        .map(|one| (one.kind, one.rows.as_slice()))
        .collect();
    assert_eq!(
        kinds,
        [(Kind::Example, [2, 3, 4].as_slice()), (Kind::Round, &[4])]
    );
    let rack = &from_csv.inventory.items[1];
    assert_eq!(
        (rack.height_m, rack.cg_height_m, rack.accepted_ratio),
        (Some(2.0), Some(0.85), Some(0.05))
    );
    // Without the examples there is no row; the headings are still found.
    let first_line = csv.iter().position(|&byte| byte == b'\n').unwrap();
    assert!(problems(&csv[..=first_line])[0].contains("there are no rows below the headings"));
    assert_eq!(convert(&convert(&csv, Target::Xlsx), Target::Csv), csv);
}

#[test]
fn units_beside_the_headings_go_into_them() {
    let text = "All weights in kg\nitem;height;thickness;level_ratio;mass;price\nunits;mm;cm;-;;EUR\nrack;1800,5;60;0,5;85;12,50\n";
    let csv = String::from_utf8(convert(text.as_bytes(), Target::Csv)).unwrap();
    assert_eq!(
        csv,
        "item,height [mm],thickness [cm],level_ratio,mass [kg],price\nrack,\"1800,5\",60,\"0,5\",85,\"12,50\"\n"
    );
    let (before, after) = (
        read(text).unwrap().inventory.items,
        read(&csv).unwrap().inventory.items,
    );
    assert_eq!(before[0].height_m, Some(1.8005));
    let of = |item: &Item| {
        (
            item.height_m,
            item.thickness_m,
            item.level_ratio,
            item.mass_kg,
            item.carried.clone(),
        )
    };
    assert_eq!(of(&before[0]), of(&after[0]));
}

/// A cell that a spreadsheet can hold; CSV has no others.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        "[ -~äß€\\n\\t]{0,12}",
        "['=+@\\-]{1,3}[a-z0-9]{0,3}",
        "_x[0-9A-F]{4}_",
        any::<f64>()
            .prop_filter("finite", |value| value.is_finite())
            .prop_map(|value| format!("{value}")),
        (-1000i32..1000).prop_map(|value| format!("{}", f64::from(value) / 8.0)),
        "0[0-9]{2}",
    ]
}

/// Rows of four more columns, as a file of CSV, as a workbook and back.
fn comes_back(rows: &[Vec<String>]) -> Result<(), TestCaseError> {
    let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
    let headings = [
        "id",
        "item",
        "level_ratio",
        "height [mm]",
        "thickness [mm]",
        "k1",
        "k2",
        "k3",
        "k4",
    ];
    writer.write_record(headings).unwrap();
    for (n, cells) in rows.iter().enumerate() {
        let guarded = cells
            .iter()
            .map(|text| freestand_input::formula::guarded(text).into_owned());
        let fixed = [
            format!("n{n}"),
            "x".to_owned(),
            "0.5".to_owned(),
            "1800".to_owned(),
            "600".to_owned(),
        ];
        writer
            .write_record(fixed.into_iter().chain(guarded))
            .unwrap();
    }
    let text = writer.into_inner().unwrap();
    let before = read(&text).unwrap().inventory;
    for (item, cells) in before.items.iter().zip(rows) {
        prop_assert_eq!(&item.carried, cells);
    }
    let book = convert(&text, Target::Xlsx);
    prop_assert_eq!(&read(&book).unwrap().inventory.items, &before.items);
    let again = convert(&book, Target::Csv);
    prop_assert_eq!(&read(&again).unwrap().inventory.items, &before.items);
    prop_assert_eq!(convert(&again, Target::Xlsx), book);
    Ok(())
}

fn cells() -> impl Strategy<Value = Vec<Vec<String>>> {
    proptest::collection::vec(proptest::collection::vec(cell(), 4), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn cells_come_back(rows in cells()) {
        comes_back(&rows)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    #[ignore = "ten seconds: 200 lists as workbooks"]
    fn every_cell_comes_back(rows in cells()) {
        comes_back(&rows)?;
    }
}
