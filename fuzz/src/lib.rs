//! What the fuzz targets share.

pub mod check;

/// A record of a known family: `bytes`, behind the family's signature unless they begin with it.
///
/// Without it the fuzzer would spend its time on finding the words by which a format is told.
pub fn check_family(signature: &[u8], bytes: &[u8]) {
    if bytes.starts_with(signature) {
        check::check_record(bytes);
    } else {
        check::check_record(&[signature, bytes].concat());
    }
}

/// A workbook of one sheet, which is `sheet` as it stands.
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
    let options = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, bytes) in parts {
        archive.start_file(name, options).expect("memory takes it");
        archive.write_all(&bytes).expect("memory takes it");
    }
    archive.finish().expect("memory takes it").into_inner()
}
