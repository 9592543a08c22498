//! What must hold for all inventories: the check of the fuzz targets and of the mutation test of
//! freestand-assess.

use freestand_inventory::library::Lookup;
use freestand_inventory::{ReadOptions, Target, convert_bytes, parse_inventory};
use std::path::Path;

/// Reads `bytes` as an inventory and converts them both ways.
///
/// # Panics
/// A problem without a file or a remedy, an object that cannot be, or a conversion that reads
/// differently.
pub fn check_inventory(bytes: Vec<u8>) {
    let path = Path::new("/nowhere/objects");
    match parse_inventory(bytes.clone(), path, &ReadOptions::new(&Lookup::NONE)) {
        Err(error) => {
            assert!(!error.problems.is_empty());
            for problem in &error.problems {
                assert!(
                    problem.path.is_some() && problem.hint.is_some() && !problem.message.is_empty(),
                    "{problem:?}"
                );
            }
        }
        Ok(reading) => {
            let inventory = reading.inventory;
            assert!(!inventory.items.is_empty());
            for item in &inventory.items {
                assert!(
                    !item.id.is_empty()
                        && item.quantity > 0
                        && item.carried.len() == inventory.carried.len()
                );
                let values = [
                    item.height_m,
                    item.thickness_m,
                    item.width_m,
                    item.mass_kg,
                    item.level_ratio,
                ];
                assert!(
                    values
                        .into_iter()
                        .flatten()
                        .all(|value| value.is_finite() && value >= 0.0),
                    "{item:?}"
                );
            }
            // A row without an id is called by its number, which is another one without the titles
            // above.
            if inventory
                .items
                .iter()
                .any(|item| item.id.starts_with("row-"))
            {
                return;
            }
            for target in [Target::Csv, Target::Xlsx] {
                // What cannot be written is refused: text that is too long for a cell once it is
                // guarded.
                if let Ok(converted) = convert_bytes(bytes.clone(), path, None, target) {
                    let again =
                        parse_inventory(converted.bytes, path, &ReadOptions::new(&Lookup::NONE))
                            .expect("ours is read again");
                    assert_eq!(again.inventory.items.len(), inventory.items.len());
                }
            }
        }
    }
}

/// A workbook whose only sheet is `sheet`, unchanged.
///
/// # Panics
/// If memory cannot be written to: never.
pub fn workbook(sheet: &[u8]) -> Vec<u8> {
    use std::io::Write;
    const RELATIONS: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let relation = |kind: &str, target: &str| {
        format!(
            "<Relationships><Relationship Id=\"a\" Type=\"{RELATIONS}/{kind}\" Target=\"{target}\"/></Relationships>"
        )
    };
    let parts = [
        ("[Content_Types].xml", b"<Types/>".to_vec()),
        ("_rels/.rels", relation("officeDocument", "xl/workbook.xml").into_bytes()),
        (
            "xl/workbook.xml",
            b"<workbook><sheets><sheet name=\"Objects\" sheetId=\"1\" r:id=\"a\"/></sheets></workbook>".to_vec(),
        ),
        ("xl/_rels/workbook.xml.rels", relation("worksheet", "worksheets/sheet1.xml").into_bytes()),
        ("xl/worksheets/sheet1.xml", sheet.to_vec()),
    ];
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options =
        zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, bytes) in parts {
        archive.start_file(name, options).expect("memory takes it");
        archive.write_all(&bytes).expect("memory takes it");
    }
    archive.finish().expect("memory takes it").into_inner()
}
