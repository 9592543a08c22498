//! Inventories of many hands, and of hostile ones.

mod hostile;
mod large;
mod round_trip;

use std::io::{Cursor, Write};
use std::path::Path;

use freestand::G0_M_S2;
use freestand::rocking::Restitution;
use zip::write::{SimpleFileOptions, ZipWriter};

use crate::library::Confidence;
use crate::library::{CushionPrior, Lookup};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_study::cushion::cushion_words;

use super::*;

/// Reads the bytes of a file called `objects.csv`.
fn read(bytes: impl AsRef<[u8]>) -> Result<Reading, Problems> {
    parse_inventory(bytes.as_ref().to_vec(), Path::new("objects.csv"), None, &Lookup::NONE)
}

/// The problems of a file, each with its hint.
fn problems(bytes: impl AsRef<[u8]>) -> Vec<String> {
    let said = |problem: &Problem| {
        assert!(problem.path.is_some() && problem.hint.is_some(), "{problem}");
        format!("{problem} | {}", problem.hint.as_deref().unwrap_or_default())
    };
    read(bytes).unwrap_err().problems.iter().map(said).collect()
}

/// A workbook of one sheet with these rows (`<row>…</row>`) and what follows them.
fn workbook(rows: &str, after: &str) -> Vec<u8> {
    workbook_of(&[("Objects", "", &sheet(rows, after))])
}

fn sheet(rows: &str, after: &str) -> String {
    format!(
        "<worksheet xmlns=\"{MAIN}\"><dimension ref=\"A1:XFD1048576\"/><sheetData>{rows}</sheetData>{after}</worksheet>"
    )
}

const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const RELATIONS: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";

/// A workbook of sheets: name, further attributes, XML. Style 1 is a date.
fn workbook_of(sheets: &[(&str, &str, &str)]) -> Vec<u8> {
    archive_of(&parts(sheets))
}

fn parts(sheets: &[(&str, &str, &str)]) -> Vec<(String, Vec<u8>)> {
    let package = "http://schemas.openxmlformats.org/package/2006";
    let (mut listed, mut related) = (String::new(), String::new());
    let mut parts = Vec::new();
    for (n, (name, attributes, xml)) in (1..).zip(sheets) {
        listed += &format!("<sheet name=\"{name}\" sheetId=\"{n}\" r:id=\"rId{n}\" {attributes}/>");
        related +=
            &format!("<Relationship Id=\"rId{n}\" Type=\"{RELATIONS}/worksheet\" Target=\"worksheets/sheet{n}.xml\"/>");
        parts.push((format!("xl/worksheets/sheet{n}.xml"), xml.as_bytes().to_vec()));
    }
    let mut add = |name: &str, text: String| parts.push((name.to_owned(), text.into_bytes()));
    add("[Content_Types].xml", format!("<Types xmlns=\"{package}/content-types\"></Types>"));
    add(
        "_rels/.rels",
        format!(
            "<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"rId1\" \
             Type=\"{RELATIONS}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
        ),
    );
    add(
        "xl/workbook.xml",
        format!("<workbook xmlns=\"{MAIN}\" xmlns:r=\"{RELATIONS}\"><sheets>{listed}</sheets></workbook>"),
    );
    add(
        "xl/_rels/workbook.xml.rels",
        format!("<Relationships xmlns=\"{package}/relationships\">{related}</Relationships>"),
    );
    add(
        "xl/styles.xml",
        format!(
            "<styleSheet xmlns=\"{MAIN}\"><cellXfs count=\"2\"><xf numFmtId=\"0\"/><xf \
             numFmtId=\"14\"/></cellXfs></styleSheet>"
        ),
    );
    parts
}

fn archive_of(parts: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
    for (name, bytes) in parts {
        archive.start_file(name, options).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// A row of texts from column A; a text that begins with `<` is the XML of a cell.
fn row(number: u32, cells: &[&str]) -> String {
    let cell = |(column, text): (usize, &&str)| {
        let place = format!("{}{number}", columns::letters(column));
        match text.strip_prefix('<') {
            Some(rest) => format!("<c r=\"{place}\" {rest}"),
            None if text.is_empty() => String::new(),
            None => format!("<c r=\"{place}\" t=\"inlineStr\"><is><t>{text}</t></is></c>"),
        }
    };
    format!("<row r=\"{number}\">{}</row>", cells.iter().enumerate().map(cell).collect::<String>())
}

const HEADINGS: [&str; 6] = ["id", "item", "level_ratio", "height [mm]", "thickness [mm]", "maker"];

#[test]
fn every_column_becomes_its_value() {
    let text = "id,item,quantity,priority,location,building,floor,room,life safety,PL,Functional Loss,level_ratio,\
        height [mm],depth (cm),width_m,base_thickness [mm],base_width [mm],cg_height [mm],mass [kg],pad_stiffness \
        [N/mm],\
        pads_per_edge,series_stiffness [kN/m],pad_thickness [mm],tolerance [g],tolerance_duration [ms],\
        tolerance_velocity_change [m/s],tolerance_edge_lift [mm],restitution,friction,accepted,notes,serial\n\
        A1,cabinet,2,first,east,A,3,3.12,H,medium,l,50 %,2300,60,0.9,540,850,1000,140,2190,2,20000,10,5,11,0.9,50,0.9,\
        0.3-0.5,5%, by the door ,007\n";
    let reading = read(text).unwrap();
    let item = &reading.inventory.items[0];
    assert_eq!((item.id.as_str(), item.item.as_str(), item.quantity, item.row), ("A1", "cabinet", 2, 2));
    assert_eq!([&item.priority, &item.location, &item.building], ["first", "east", "A"]);
    assert_eq!([&item.floor, &item.room, &item.notes], ["3", "3.12", "by the door"]);
    let rated = [Rating::High, Rating::Medium, Rating::Low].map(Some);
    assert_eq!([item.consequences.life_safety, item.consequences.property, item.consequences.function], rated);
    // Exact: the power of ten is applied to the digits before they become binary.
    assert_eq!(
        (item.level_ratio, item.height_m, item.thickness_m, item.width_m),
        (Some(0.5), Some(2.3), Some(0.6), Some(0.9))
    );
    assert_eq!((item.base_thickness_m, item.base_width_m, item.cg_height_m), (Some(0.54), Some(0.85), Some(1.0)));
    assert_eq!(item.mass_kg, Some(140.0));
    let edge = item.cushion.as_ref().unwrap();
    // Two pads of 2190 N/mm side by side, on 20 MN/m: 1/(1/4.38e6 + 1/2e7) = 3.5931e6 N/m.
    assert!((edge.cushion.linear_stiffness_n_m().unwrap() - 3.593_109_1e6).abs() < 1.0);
    assert_eq!((edge.pad_thickness_m, edge.notes.len()), (Some(0.01), 2));
    let tolerance = item.tolerance.as_ref().unwrap();
    // One rounding each: 5 × 9.80665.
    assert_eq!(tolerance.peak_m_s2, Some(5.0 * G0_M_S2));
    assert_eq!(
        (tolerance.duration_s, tolerance.velocity_change_m_s, tolerance.edge_lift_m),
        (Some(0.011), Some(0.9), Some(0.05))
    );
    assert_eq!((tolerance.source.as_str(), tolerance.confidence), ("the inventory", Confidence::Stated));
    assert_eq!(item.restitution, Restitution::Value(0.9));
    assert_eq!((item.friction_ratio, item.accepted_ratio), (Some((0.3, 0.5)), Some(0.05)));
    assert_eq!((&reading.inventory.carried, &item.carried), (&vec!["serial".to_owned()], &vec!["007".to_owned()]));
    assert_eq!(reading.columns.len(), 31);
    assert_eq!(reading.columns[13].unit.as_deref(), Some("cm"));
    assert_eq!(reading.inventory.warnings, Vec::<String>::new());
    assert_eq!(reading.inventory.sha256, freestand_input::file::sha256_hex(text.as_bytes()));
}

#[test]
fn empty_cells_are_missing_and_cost_no_file() {
    let reading = read("level_ratio,height,thickness,mass,tolerance\n0.5,2.3 m,600 mm,,\n\n,,60 cm,,\n").unwrap();
    let [first, second] = reading.inventory.items.as_slice() else { panic!("{reading:?}") };
    assert_eq!((first.id.as_str(), second.id.as_str(), second.row), ("row-2", "row-4", 4));
    assert_eq!((first.height_m, first.thickness_m, first.mass_kg), (Some(2.3), Some(0.6), None));
    assert_eq!((second.height_m, second.level_ratio, second.quantity), (None, None, 1));
    assert!(first.tolerance.is_none() && first.cushion.is_none() && first.friction_ratio.is_none());
    assert_eq!(reading.columns[1].unit.as_deref(), Some("in each cell"));
}

#[test]
fn all_problems_of_a_file_at_once() {
    let text = "id,level_ratio,height,depth [mm],cg_height [mm],base_width [mm],width [mm],mass \
         [kg],quantity,LS,friction,restitution,accepted\n\
        a,7,2300,600,,,,,,,,,\n\
        a,0.5,2.3 m,-600,2400,900,800,x,1.5,severe,0.5-0.3,1.2,100 %\n\
        b,0.5,2.3 kg,n/a,,,,\"1.500,5\",0,,,,\n";
    let said = problems(text);
    let expected = [
        "objects.csv:2: row 2, column B (level_ratio): the level must be from 0 to 1, not 7 | give the height of the floor",
        "objects.csv:2: row 2, column C (height): \"2300\" needs a unit | write \"2300 m\" or \"2300 mm\", or put \
         the unit into the heading, such as \"height [mm]\"",
        "objects.csv:3: row 3, column D (depth [mm]): must be positive, not -600",
        "objects.csv:3: row 3, column F (base_width [mm]): the base width",
        "objects.csv:3: row 3, column H (mass [kg]): \"x\" is not a quantity | write the number alone, because \
         the heading has the unit (kg)",
        "objects.csv:3: row 3, column I (quantity): must be a whole number, at least 1, not \"1.5\"",
        "objects.csv:3: row 3, column J (LS): \"severe\" is not a rating | write H, M or L",
        "objects.csv:3: row 3, column K (friction): \"0.5-0.3\" is not a positive value or a rising range",
        "objects.csv:3: row 3, column L (restitution): restitution must be above 0 and at most 1, not 1.2",
        "objects.csv:3: row 3, column M (accepted): must be above 0 and below 1, not 1 | write a ratio",
        "objects.csv:4: row 4, column C (height): \"2.3 kg\" is a mass, not a length",
        "objects.csv:4: row 4, column D (depth [mm]): \"n/a\" is not a value | leave the cell empty",
        "objects.csv:4: row 4, column H (mass [kg]): \"1.500,5\" has a comma in the number",
        "objects.csv:4: row 4, column I (quantity): must be a whole number, at least 1, not \"0\"",
        "objects.csv: row 3, column A (id): row 2 already has the id \"a\"",
    ];
    for one in expected {
        assert!(said.iter().any(|problem| problem.starts_with(one)), "{one}\nnot in\n{}", said.join("\n"));
    }
    assert_eq!(said.len(), expected.len(), "{}", said.join("\n"));
    let high = problems("level_ratio,height [mm],depth [mm],cg_height [mm]\n0.5,2300,600,2400\n");
    assert!(high[0].contains("column D (cg_height [mm]): the "), "{high:?}");
}

#[test]
fn headings_are_checked_as_a_whole() {
    let said = problems("id,height [px],weight,Height (mm)\na,1,2,3\n");
    for one in [
        "objects.csv:1: column B (height [px]): \"px\" is not a unit of height | write one of m, mm, cm",
        "objects.csv:1: columns B (height [px]) and D (Height (mm)) are both height",
        "objects.csv:1: the column level_ratio is missing",
        "objects.csv:1: the column thickness is missing | add a column \"thickness [mm]\"",
    ] {
        assert!(said.iter().any(|problem| problem.starts_with(one)), "{one}\nnot in\n{}", said.join("\n"));
    }
    // No cell under a heading with a wrong unit is reported again.
    assert_eq!(said.len(), 4, "{said:?}");
    let said = problems("id,level,height [m],thickness [m]\na,3,1,1\n");
    assert!(said[0].contains("the column level_ratio is missing | if \"level\" is that column, rename it"), "{said:?}");
    assert!(problems("a,b\n1,2\n")[0].contains("contain no row of headings"));
    assert!(
        problems("id,level_ratio,height [mm],thickness [mm]\n\n")[0].contains("there are no rows below the headings")
    );
    let reading = read("id,level_ratio,height [mm],thickness [mm],tolerence [g]\na,0,1800,600,5\n").unwrap();
    assert!(
        reading.inventory.warnings[0]
            .contains("column E (tolerence [g]) is not read, only carried through: did you mean tolerance?")
    );
    assert_eq!(reading.inventory.items[0].carried, ["5"]);
}

#[test]
fn doubtful_rows_are_warned_about_together() {
    let mut text = "Register of the north wing\n\nid,level_ratio,height [mm],thickness [mm],mass [kg],stiffness \
         [N/mm],pad_stiffness [N/mm]\n"
        .to_owned();
    for n in 0..40 {
        text += &format!("a{n},0.5,1.8,0.45,,,\n");
    }
    text += "s,0.5,600,1000,140,4.38,\np,0.5,1800,600,140,,2190\n,0.5,1800,600,,,\nTotal,,,,420,,\n";
    let reading = read(&text).unwrap();
    let expected = [
        "the headings are in row 3; the row above them is ignored",
        "row 46 has no id",
        "row 47 is left out",
        "rows 4, 5, 6, 7, 8 and 35 more have a height below 20 mm",
        "row 44 is squat",
        "row 44 has a stiffness under one edge that is very low",
        "row 45 has the stiffness of a pad without pads_per_edge",
    ];
    let warnings = &reading.inventory.warnings;
    for one in expected {
        assert!(warnings.iter().any(|warning| warning.starts_with(one)), "{one}\nnot in\n{}", warnings.join("\n"));
    }
    assert_eq!(warnings.len(), expected.len(), "{}", warnings.join("\n"));
    assert_eq!((reading.header_row, reading.inventory.items.len()), (3, 43));
}

#[test]
fn csv_of_other_countries() {
    for (separator, comma) in [(";", ","), ("\t", ","), (";", "."), ("\t", ".")] {
        let text = "id,level_ratio,height [m],thickness [mm],friction\r\na,0.5,2.3,600.5,0.3-0.45\r\n";
        let text = text.replace(',', separator).replace('.', comma);
        let item = read(&text).unwrap().inventory.items.remove(0);
        assert_eq!((item.level_ratio, item.height_m, item.thickness_m), (Some(0.5), Some(2.3), Some(0.6005)), "{text}");
        assert_eq!(item.friction_ratio, Some((0.3, 0.45)), "{text}");
    }
    let mixed = read("id;level_ratio;height [m];thickness [m]\na;0,5;2,3;0,6\nb;0.5;1,234;0.6\n").unwrap();
    assert!(mixed.inventory.warnings[0].starts_with("row 3 has numbers with a decimal point while other rows"));
    // Where commas separate the cells, a decimal comma gives too many cells.
    assert!(
        problems("id,level_ratio,height [m],thickness [m]\na,0,5,2,3,0,6\n")[0]
            .contains("the row has 7 cells for 4 headings")
    );
    let latin = b"id;item;level_ratio;height [m];thickness [m]\na;Schr\xE4nke;0,5;2,3;0,6\n";
    let reading = read(latin).unwrap();
    assert_eq!(reading.inventory.items[0].item, "Schränke");
    assert!(reading.inventory.warnings[0].contains("Windows-1252"));
}

/// A pad of a class and one entry of tolerances.
fn prior(name: &str) -> Option<CushionPrior> {
    let mut words = Words::default();
    match name {
        "pad" => words.set("pad_stiffness", "2190 N/mm"),
        "edge" => words.set("stiffness", "4380 N/mm"),
        "damped" => {
            words.set("law", "kelvin-voigt");
            words.set("stiffness", "4380 N/mm");
            words.set("damping", "5 %");
        }
        _ => return None,
    }
    Some(CushionPrior { words, log_sd: 0.5, source: format!("{name}: a class") })
}

#[test]
fn entries_of_the_libraries_are_looked_up() {
    let stands = |name: &str| {
        (name == "bench").then(|| Tolerance {
            peak_m_s2: Some(150.0),
            duration_s: Some(0.011),
            velocity_change_m_s: None,
            edge_lift_m: None,
            source: "bench: a class".to_owned(),
            confidence: Confidence::Assumption,
        })
    };
    let names = [["bench".to_owned()], ["damped".to_owned()]];
    let lookup = Lookup { tolerance: &stands, cushion: &prior, tolerance_names: &names[0], cushion_names: &names[1] };
    let head = "level_ratio,height [mm],depth [mm],mass [kg],stiffness [N/mm],pads_per_edge,series_stiffness \
         [N/mm],cushion,tolerance [g],tolerance_entry\n";
    let read = |rows: &str| parse_inventory(format!("{head}{rows}").into_bytes(), Path::new("a.csv"), None, &lookup);
    let reading = read(
        "0,1800,600,140,,2,,pad,,bench\n0,1800,600,140,,,,edge,,\n0,1800,600,140,,,20000,edge,,\n\
        0,1800,600,140,,,,damped,,\n0,1800,600,,,,,damped,,\n0,1800,600,140,,,,pad,,\n",
    )
    .unwrap();
    let items = &reading.inventory.items;
    let stiffness = |n: usize| items[n].cushion.as_ref().map(|edge| cushion_words(&edge.cushion));
    assert_eq!(stiffness(0).as_deref(), Some("4380 N/mm"));
    assert_eq!(stiffness(1).as_deref(), Some("4380 N/mm"));
    assert!(stiffness(2).is_some_and(|words| words.starts_with("3593.11")));
    assert!(stiffness(3).is_some_and(|words| words.contains(" with ")));
    assert_eq!((stiffness(4), stiffness(5)), (None, None));
    assert_eq!((items[0].cushion_log_sd, items[0].cushion_source.as_deref()), (Some(0.5), Some("pad: a class")));
    assert_eq!(items[0].tolerance.as_ref().map(|t| t.source.as_str()), Some("bench: a class"));
    let warnings = reading.inventory.warnings.join("\n");
    assert!(
        warnings.contains("row 6 has a cushion with a damping ratio")
            && warnings.contains("row 7 has the stiffness of a pad without")
    );
    let error = read(
        "0,1800,600,140,,,,dampd,,\n0,1800,600,140,4380,,,edge,,\n0,1800,600,,,,,,5,bench\n0,1800,600,,,,,,,bnch\n",
    );
    let said: Vec<String> =
        error.unwrap_err().problems.iter().map(|p| format!("{} | {}", p.message, p.hint.as_deref().unwrap())).collect();
    assert_eq!(said.len(), 4, "{said:?}");
    assert!(
        said[0].contains("column H (cushion): \"dampd\" is not an entry of the cushion library | did you mean damped?"),
        "{said:?}"
    );
    assert!(said[1].contains("column E (stiffness [N/mm]): cushion and stiffness exclude each other"), "{said:?}");
    assert!(said[2].contains("exclude each other"), "{said:?}");
    assert!(
        said[3].contains("column J (tolerance_entry): \"bnch\"") && said[3].ends_with("did you mean bench?"),
        "{said:?}"
    );
}

#[test]
fn a_workbook_reads_as_the_same_csv() {
    let rows = row(1, &HEADINGS)
        + &row(3, &["A1", " cabinet ", "<><v>0.5</v></c>", "<><v>2300</v></c>", "600", "<><v>7</v></c>"]);
    let reading = parse_inventory(workbook(&rows, ""), Path::new("misnamed.csv"), None, &Lookup::NONE).unwrap();
    let csv = read("id,item,level_ratio,height [mm],thickness [mm],maker\n\nA1,cabinet,0.5,2300,600,7\n").unwrap();
    assert_eq!(reading.inventory.items, csv.inventory.items);
    assert_eq!((reading.inventory.sheet.as_deref(), reading.inventory.items[0].row), (Some("Objects"), 3));
}

#[test]
fn the_sheet_with_the_headings_is_found() {
    let objects = sheet(&(row(2, &HEADINGS) + &row(3, &["a", "x", "0.5", "1800", "600"])), "");
    let other = sheet(&row(1, &["notes", "nothing else"]), "");
    let book = workbook_of(&[
        ("Cover", "", &other),
        ("Old", "state=\"hidden\"", &objects),
        ("New", "", &objects),
        ("Copy", "", &objects),
    ]);
    let reading = read(&book).unwrap();
    assert_eq!(reading.inventory.sheet.as_deref(), Some("New"));
    assert!(
        reading.inventory.warnings[0].contains("other sheets also look like inventories: \"Copy\""),
        "{:?}",
        reading.inventory.warnings
    );
    let named = |name: &str| parse_inventory(book.clone(), Path::new("a.xlsx"), Some(name), &Lookup::NONE);
    assert_eq!(named("old").unwrap().inventory.sheet.as_deref(), Some("Old"));
    assert!(
        named("Cover").unwrap_err().problems[0]
            .message
            .starts_with("sheet \"Cover\": the first 100 rows contain no row of headings")
    );
    let missing = named("Objects").unwrap_err();
    assert!(missing.problems[0].hint.as_deref().is_some_and(|hint| hint.contains("\"New\"")), "{missing}");
    let hidden = workbook_of(&[("Cover", "", &other), ("Old", "state=\"hidden\"", &objects)]);
    assert!(problems(hidden)[0].contains("only the hidden sheet \"Old\""));
    assert!(parse_inventory(b"id,height\n".to_vec(), Path::new("a.csv"), Some("x"), &Lookup::NONE).is_err());
}
