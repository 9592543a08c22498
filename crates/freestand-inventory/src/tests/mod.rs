//! Inventories of many hands, and of hostile ones.

mod bodies;
mod hostile;
mod large;
mod registers;
mod round_trip;
mod silence;
mod units;

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
    parse_inventory(
        bytes.as_ref().to_vec(),
        Path::new("objects.csv"),
        &ReadOptions::new(&Lookup::NONE),
    )
}

/// The problems of the cells of a list, as the console shows them.
fn found(bytes: impl AsRef<[u8]>) -> Vec<String> {
    read(bytes)
        .unwrap()
        .inventory
        .findings
        .iter()
        .map(Finding::line)
        .collect()
}

/// The problems of a file, each with its hint.
fn problems(bytes: impl AsRef<[u8]>) -> Vec<String> {
    let said = |problem: &Problem| {
        assert!(
            problem.path.is_some() && problem.hint.is_some(),
            "{problem}"
        );
        format!(
            "{problem} | {}",
            problem.hint.as_deref().unwrap_or_default()
        )
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
        related += &format!(
            "<Relationship Id=\"rId{n}\" Type=\"{RELATIONS}/worksheet\" Target=\"worksheets/sheet{n}.xml\"/>"
        );
        parts.push((
            format!("xl/worksheets/sheet{n}.xml"),
            xml.as_bytes().to_vec(),
        ));
    }
    let mut add = |name: &str, text: String| parts.push((name.to_owned(), text.into_bytes()));
    add(
        "[Content_Types].xml",
        format!("<Types xmlns=\"{package}/content-types\"></Types>"),
    );
    add(
        "_rels/.rels",
        format!(
            "<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"rId1\" \
             Type=\"{RELATIONS}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
        ),
    );
    add(
        "xl/workbook.xml",
        format!(
            "<workbook xmlns=\"{MAIN}\" xmlns:r=\"{RELATIONS}\"><sheets>{listed}</sheets></workbook>"
        ),
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
    format!(
        "<row r=\"{number}\">{}</row>",
        cells.iter().enumerate().map(cell).collect::<String>()
    )
}

const HEADINGS: [&str; 6] = [
    "id",
    "item",
    "level_ratio",
    "height [mm]",
    "thickness [mm]",
    "maker",
];

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
    assert_eq!(
        (
            item.id.as_str(),
            item.item.as_str(),
            item.quantity,
            item.row
        ),
        ("A1", "cabinet", 2, 2)
    );
    assert_eq!(
        [&item.priority, &item.location, &item.building],
        ["first", "east", "A"]
    );
    assert_eq!(
        [&item.floor, &item.room, &item.notes],
        ["3", "3.12", "by the door"]
    );
    let rated = [Rating::High, Rating::Medium, Rating::Low].map(Some);
    assert_eq!(
        [
            item.consequences.life_safety,
            item.consequences.property,
            item.consequences.function
        ],
        rated
    );
    // Exact: the power of ten is applied to the digits before they become binary.
    assert_eq!(
        (
            item.level_ratio,
            item.height_m,
            item.thickness_m,
            item.width_m
        ),
        (Some(0.5), Some(2.3), Some(0.6), Some(0.9))
    );
    assert_eq!(
        (item.base_thickness_m, item.base_width_m, item.cg_height_m),
        (Some(0.54), Some(0.85), Some(1.0))
    );
    assert_eq!(item.mass_kg, Some(140.0));
    let edge = item.cushion.as_ref().unwrap();
    // Two pads of 2190 N/mm side by side, on 20 MN/m: 1/(1/4.38e6 + 1/2e7) = 3.5931e6 N/m.
    assert!((edge.cushion.linear_stiffness_n_m().unwrap() - 3.593_109_1e6).abs() < 1.0);
    assert_eq!((edge.pad_thickness_m, edge.notes.len()), (Some(0.01), 2));
    let tolerance = item.tolerance.as_ref().unwrap();
    // One rounding each: 5 × 9.80665.
    assert_eq!(tolerance.peak_m_s2, Some(5.0 * G0_M_S2));
    assert_eq!(
        (
            tolerance.duration_s,
            tolerance.velocity_change_m_s,
            tolerance.edge_lift_m
        ),
        (Some(0.011), Some(0.9), Some(0.05))
    );
    assert_eq!(
        (tolerance.source.as_str(), tolerance.confidence),
        ("the inventory", Confidence::Stated)
    );
    assert_eq!(item.restitution, Restitution::Value(0.9));
    assert_eq!(
        (item.friction_ratio, item.accepted_ratio),
        (Some((0.3, 0.5)), Some(0.05))
    );
    assert_eq!(
        (&reading.inventory.carried, &item.carried),
        (&vec!["serial".to_owned()], &vec!["007".to_owned()])
    );
    assert_eq!(reading.columns.len(), 31);
    assert_eq!(
        (
            reading.columns[13].unit.as_deref(),
            reading.columns[13].unit_source
        ),
        (Some("cm"), Some("heading"))
    );
    assert_eq!(reading.inventory.warnings, Vec::<String>::new());
    assert_eq!(
        reading.inventory.sha256,
        freestand_input::file::sha256_hex(text.as_bytes())
    );
}

#[test]
fn empty_cells_are_missing_and_cost_no_file() {
    let reading =
        read("level_ratio,height,thickness,mass,tolerance\n0.5,2.3 m,600 mm,,\n\n0,,60 cm,n/a,\n")
            .unwrap();
    let [first, second] = reading.inventory.items.as_slice() else {
        panic!("two rows")
    };
    assert_eq!(
        (first.id.as_str(), second.id.as_str(), second.row),
        ("row-2", "row-4", 4)
    );
    assert_eq!(
        (first.height_m, first.thickness_m, first.mass_kg),
        (Some(2.3), Some(0.6), None)
    );
    assert_eq!(
        (second.height_m, second.level_ratio, second.quantity),
        (None, Some(0.0), 1)
    );
    assert!(first.tolerance.is_none() && first.cushion.is_none() && first.friction_ratio.is_none());
    let height = &reading.columns[1];
    assert_eq!(
        (
            height.unit.as_deref(),
            height.unit_source,
            height.values,
            height.missing
        ),
        (None, Some("cell"), 1, 1)
    );
    assert_eq!(reading.inventory.findings, []);
}

#[test]
fn a_bad_cell_costs_its_value_alone() {
    let text = "id,level_ratio,height,depth [mm],cg_height [mm],base_width [mm],width [mm],mass \
         [kg],quantity,LS,friction,restitution,accepted\n\
        a,7,2300 mm,600,,,,,,,,,\n\
        a,0.5,2.3 m,-600,2400,900,800,x9,1.5,severe,0.5-0.3,1.2,100 %\n\
        b,0.5,2.3 kg,n/a,,,,\"1.500,5\",0,,,,\n";
    let reading = read(text).unwrap();
    let said: Vec<String> = reading
        .inventory
        .findings
        .iter()
        .map(Finding::line)
        .collect();
    for one in [
        "error: out-of-range: level_ratio: 1 cell (B2), such as \"7\"; the level must be from 0 to 1; hint: give the height",
        "error: out-of-range: depth [mm]: 1 cell (D3), such as \"-600\"",
        "error: out-of-range: cg_height [mm]: 1 cell (E3)",
        "error: out-of-range: base_width [mm]: 1 cell (F3)",
        "error: unreadable: mass [kg]: 1 cell (H3), such as \"x9\"; hint: correct the cell",
        "error: out-of-range: quantity: 2 cells (I3, I4), such as \"1.5\"",
        "error: unreadable: LS: 1 cell (J3), such as \"severe\"; is not a rating",
        "error: out-of-range: friction: 1 cell (K3)",
        "error: out-of-range: restitution: 1 cell (L3)",
        "error: out-of-range: accepted: 1 cell (M3)",
        "error: unit-wrong: height: 1 cell (C4), such as \"2.3 kg\"",
        "doubt: duplicate-id: id: 1 cell (A3), such as \"a\"",
    ] {
        assert!(
            said.iter().any(|line| line.starts_with(one)),
            "{one}\nnot in\n{}",
            said.join("\n")
        );
    }
    assert_eq!(said.len(), 12, "{}", said.join("\n"));
    let items = &reading.inventory.items;
    let ids: Vec<&str> = items.iter().map(|item| item.id.as_str()).collect();
    assert_eq!(ids, ["a", "a #2", "b"]);
    assert_eq!(
        (items[1].height_m, items[1].width_m, items[1].thickness_m),
        (Some(2.3), Some(0.8), None)
    );
    assert_eq!(items[2].mass_kg, Some(1500.5));
    assert_eq!(items[1].doubts, [Kind::DuplicateId]);
}

#[test]
fn headings_are_checked_as_a_whole() {
    // Inches and millimetres agree, or the first is used with a doubt.
    let twice =
        "id,Height (in),weight [lb],Height (mm),depth [mm]\na,72,150,1829,600\nb,72,150,1500,600\n";
    let reading = read(twice).unwrap();
    let heights: Vec<Option<f64>> = reading
        .inventory
        .items
        .iter()
        .map(|item| item.height_m)
        .collect();
    assert_eq!(heights, [Some(1.8288), Some(1.8288)]);
    assert_eq!(
        [
            &reading.inventory.items[0].doubts[..],
            &reading.inventory.items[1].doubts[..]
        ],
        [&[][..], &[Kind::TwoColumns]]
    );
    // A unit that does not fit is said once, whatever the cells.
    let said = found("id,item,height [kg],depth [mm]\na,x,1800,600\nb,x,1.8 m,600\n");
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].starts_with("error: unit-wrong: height [kg]: 1 cell (C2), such as \"1800\""),
        "{said:?}"
    );
    // Kilograms and pounds are never guessed.
    assert!(
        found("id,height [mm],depth [mm],mass\na,1800,600,85\n")[0]
            .starts_with("error: unit-missing: mass: 1 cell (D2)")
    );
    assert!(problems("a,b\n1,2\n")[0].contains("contain no row of headings"));
    assert!(
        problems("id,level_ratio,height [mm],thickness [mm]\n\n")[0]
            .contains("there are no rows below the headings")
    );
    let reading =
        read("id,level_ratio,height [mm],thickness [mm],tolerence [g]\na,0,1800,600,5\n").unwrap();
    assert!(reading.inventory.warnings[0].contains(
        "column E (tolerence [g]) is not read, only carried through: did you mean tolerance?"
    ));
    assert_eq!(reading.inventory.items[0].carried, ["5"]);
}

/// Height and mass of each object.
fn height_and_mass(bytes: impl AsRef<[u8]>) -> Vec<(Option<f64>, Option<f64>)> {
    read(bytes)
        .unwrap()
        .inventory
        .items
        .iter()
        .map(|item| (item.height_m, item.mass_kg))
        .collect()
}

#[test]
fn doubts_are_one_for_each_kind_and_column() {
    let mut text = "Register of the north wing\n\nid,level_ratio,height [mm],thickness [mm],mass [kg],stiffness \
         [N/mm],pad_stiffness [N/mm]\n"
        .to_owned();
    for n in 0..40 {
        text += &format!("a{n},0.5,1.8,0.45,,,\n");
    }
    text += "s,0.5,600,1000,140,4.38,\np,0.5,1800,600,140,,2190\n,0.5,1800,600,9000,,\nTotal,,,,420,,\n";
    let reading = read(&text).unwrap();
    let said: Vec<String> = reading
        .inventory
        .findings
        .iter()
        .map(Finding::line)
        .collect();
    for one in [
        "doubt: implausible-size: height [mm]: 40 cells (C4, C5, C6 …), such as \"1.8\"",
        "doubt: implausible-size: thickness [mm]: 40 cells (D4, D5, D6 …), such as \"0.45\"",
        "doubt: stiffness: stiffness [N/mm]: 1 cell (F44), such as \"4.38\"",
        "doubt: pads-missing: pad_stiffness [N/mm]: 1 cell (G45)",
        "doubt: density: mass [kg]: 1 cell (E46), such as \"9000\"",
    ] {
        assert!(
            said.iter().any(|line| line.starts_with(one)),
            "{one}\nnot in\n{}",
            said.join("\n")
        );
    }
    assert_eq!(said.len(), 5, "{}", said.join("\n"));
    let warnings = &reading.inventory.warnings;
    for one in [
        "the headings are in row 3; the row above them is not part",
        "row 46: no id",
        "row 44: squat",
    ] {
        assert!(
            warnings.iter().any(|warning| warning.starts_with(one)),
            "{one}\nnot in\n{}",
            warnings.join("\n")
        );
    }
    assert_eq!(warnings.len(), 3, "{}", warnings.join("\n"));
    assert_eq!((reading.header_row, reading.inventory.items.len()), (3, 43));
    let left: Vec<(u32, &str)> = reading
        .left_out
        .iter()
        .map(|left| (left.row, <&str>::from(left.kind)))
        .collect();
    assert_eq!(left, [(47, "total")]);
    // The value is kept, and waits for a person; with `strict` the doubts are errors.
    assert_eq!(reading.inventory.items[0].height_m, Some(0.0018));
    assert_eq!(
        reading.inventory.items[0].to_confirm,
        ["C4=1.8 m", "D4=0.45 m"]
    );
    assert!(!reading.inventory.has_errors());
    let strict = ReadOptions {
        is_strict: true,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let reading = parse_inventory(text.into_bytes(), Path::new("a.csv"), &strict).unwrap();
    assert!(reading.inventory.has_errors());
}

#[test]
fn csv_of_other_countries() {
    for (separator, comma) in [(";", ","), ("\t", ","), (";", "."), ("\t", "."), ("|", ",")] {
        let text =
            "id,level_ratio,height [m],thickness [mm],friction\r\na,0.5,2.3,600.5,0.3-0.45\r\n";
        let text = text.replace(',', separator).replace('.', comma);
        let item = read(&text).unwrap().inventory.items.remove(0);
        assert_eq!(
            (item.level_ratio, item.height_m, item.thickness_m),
            (Some(0.5), Some(2.3), Some(0.6005)),
            "{text}"
        );
        assert_eq!(item.friction_ratio, Some((0.3, 0.45)), "{text}");
    }
    // A column of both signs: each cell by its own evidence, the rest by plausibility.
    let mixed =
        read("id;level_ratio;height [m];thickness [m]\na;0,5;2,3;0,6\nb;0.5;1,234;0.6\n").unwrap();
    assert_eq!(mixed.inventory.items[1].height_m, Some(1.234));
    assert_eq!(mixed.columns[1].dialect, Some("mixed"));
    // Where commas separate the cells, a decimal comma moves all that follows.
    let said = found("id,level_ratio,height [m],thickness [m]\na,0,5,2,3,0,6\n");
    assert!(
        said[0].contains("the row: 1 row (row 2); has 7 cells for 4 headings"),
        "{said:?}"
    );
    let latin = b"id;item;level_ratio;height [m];thickness [m]\na;Schr\xE4nke;0,5;2,3;0,6\n";
    let reading = read(latin).unwrap();
    assert_eq!(reading.inventory.items[0].item, "Schränke");
    assert!(reading.inventory.warnings[0].contains("Windows-1252"));
}

#[test]
fn a_factor_of_a_thousand_is_never_read_silently() {
    let mass = |text: &str| {
        let reading = read(text).unwrap();
        let kinds: Vec<&str> = reading
            .inventory
            .findings
            .iter()
            .map(|finding| finding.kind.name())
            .collect();
        (
            reading
                .inventory
                .items
                .iter()
                .map(|item| item.mass_kg)
                .collect::<Vec<_>>(),
            kinds,
        )
    };
    // A cabinet of 1.2 kg does not exist.
    assert_eq!(
        mass("id,item,height [mm],depth [mm],width [mm],mass [kg]\na,x,1800,600,900,1.200\n"),
        (vec![Some(1200.0)], vec![])
    );
    // Beside 0.350 t, 1.200 t are 1.2 t.
    assert_eq!(
        mass("id,item,height [mm],depth [mm],mass [t]\na,x,1800,600,1.200\nb,x,1800,900,0.350\n").0,
        [Some(1200.0), Some(350.0)]
    );
    // Nothing tells: no value.
    assert_eq!(
        mass("id,item,height [mm],mass [kg]\na,x,1800,1.200\n"),
        (vec![None], vec!["number-ambiguous"])
    );
    // Semicolons do.
    assert_eq!(
        mass("id;item;height [mm];mass [kg]\na;x;1800;1.200\n").0,
        [Some(1200.0)]
    );
    // Against plausibility: no value.
    assert_eq!(
        mass("id,item,height [m],depth [m],width [m],mass [kg]\na,x,1.85,0.62,0.95,1.200\n"),
        (vec![None], vec!["number-ambiguous"])
    );
}

/// If a list uses both decimal signs, plausibility decides. But a size that no object has says
/// nothing about the mass: the decimal sign of the column counts.
#[test]
fn an_implausible_size_does_not_change_the_reading_of_a_mass() {
    let list = "id,height [cm],thickness [cm],mass [kg]\na,180,60,1.200\nb,180,60,\"220,5\"\nc,\"180,5\",60,1.200\n\
                d,180.5,60,1.200\ne,1.80,60,1.200\n";
    let masses: Vec<_> = read(list)
        .unwrap()
        .inventory
        .items
        .iter()
        .map(|item| item.mass_kg)
        .collect();
    assert_eq!(
        masses,
        [
            Some(1200.0),
            Some(220.5),
            Some(1200.0),
            Some(1200.0),
            Some(1200.0)
        ]
    );
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
    Some(CushionPrior {
        words,
        log_sd: 0.5,
        source: format!("{name}: a class"),
    })
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
    let lookup = Lookup {
        tolerance: &stands,
        cushion: &prior,
        tolerance_names: &names[0],
        cushion_names: &names[1],
    };
    let head = "level_ratio,height [mm],depth [mm],mass [kg],stiffness [N/mm],pads_per_edge,series_stiffness \
         [N/mm],cushion,tolerance [g],tolerance_entry\n";
    let read = |rows: &str| {
        parse_inventory(
            format!("{head}{rows}").into_bytes(),
            Path::new("a.csv"),
            &ReadOptions::new(&lookup),
        )
    };
    let reading = read(
        "0,1800,600,140,,2,,pad,,bench\n0,1800,600,140,,,,edge,,\n0,1800,600,140,,,20000,edge,,\n\
        0,1800,600,140,,,,damped,,\n0,1800,600,,,,,damped,,\n0,1800,600,140,,,,pad,,\n",
    )
    .unwrap();
    let items = &reading.inventory.items;
    let stiffness = |n: usize| {
        items[n]
            .cushion
            .as_ref()
            .map(|edge| cushion_words(&edge.cushion))
    };
    assert_eq!(stiffness(0).as_deref(), Some("4380 N/mm"));
    assert_eq!(stiffness(1).as_deref(), Some("4380 N/mm"));
    assert!(stiffness(2).is_some_and(|words| words.starts_with("3593.11")));
    assert!(stiffness(3).is_some_and(|words| words.contains(" with ")));
    assert_eq!((stiffness(4), stiffness(5)), (None, None));
    assert_eq!(
        (items[0].cushion_log_sd, items[0].cushion_source.as_deref()),
        (Some(0.5), Some("pad: a class"))
    );
    assert_eq!(
        items[0].tolerance.as_ref().map(|t| t.source.as_str()),
        Some("bench: a class")
    );
    assert_eq!(
        (&items[4].doubts[..], &items[5].doubts[..]),
        (&[Kind::DampingMass][..], &[Kind::PadsMissing][..])
    );
    let said = |rows: &str| -> Vec<String> {
        read(rows)
            .unwrap()
            .inventory
            .findings
            .iter()
            .map(Finding::line)
            .collect()
    };
    let expected = [
        (
            "0,1800,600,140,,,,dampd,,\n",
            "is not an entry of the cushion library; hint: did you mean damped?",
        ),
        (
            "0,1800,600,140,4380,,,edge,,\n",
            "cushion` and `stiffness` exclude each other",
        ),
        ("0,1800,600,,,,,,5,bench\n", "exclude each other"),
        ("0,1800,600,,,,,,,bnch\n", "hint: did you mean bench?"),
    ];
    for (row, words) in expected {
        let lines = said(row);
        assert!(
            lines.len() == 1
                && lines[0].starts_with("error: unreadable")
                && lines[0].contains(words),
            "{lines:?}"
        );
    }
}

#[test]
fn a_workbook_reads_as_the_same_csv() {
    let rows = row(1, &HEADINGS)
        + &row(
            3,
            &[
                "A1",
                " cabinet ",
                "<><v>0.5</v></c>",
                "<><v>2300</v></c>",
                "600",
                "<><v>7</v></c>",
            ],
        );
    let reading = parse_inventory(
        workbook(&rows, ""),
        Path::new("misnamed.csv"),
        &ReadOptions::new(&Lookup::NONE),
    )
    .unwrap();
    let csv =
        read("id,item,level_ratio,height [mm],thickness [mm],maker\n\nA1,cabinet,0.5,2300,600,7\n")
            .unwrap();
    assert_eq!(reading.inventory.items, csv.inventory.items);
    assert_eq!(
        (
            reading.inventory.sheet.as_deref(),
            reading.inventory.items[0].row
        ),
        (Some("Objects"), 3)
    );
}

#[test]
fn the_sheet_with_the_headings_is_found() {
    let objects = sheet(
        &(row(2, &HEADINGS) + &row(3, &["a", "x", "0.5", "1800", "600"])),
        "",
    );
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
    let named = |name: &str| {
        parse_inventory(
            book.clone(),
            Path::new("a.xlsx"),
            &ReadOptions {
                sheet: Some(name),
                ..ReadOptions::new(&Lookup::NONE)
            },
        )
    };
    assert_eq!(
        named("old").unwrap().inventory.sheet.as_deref(),
        Some("Old")
    );
    assert!(
        named("Cover").unwrap_err().problems[0]
            .message
            .starts_with("sheet \"Cover\": the first 100 rows contain no row of headings")
    );
    let missing = named("Objects").unwrap_err();
    assert!(
        missing.problems[0]
            .hint
            .as_deref()
            .is_some_and(|hint| hint.contains("\"New\"")),
        "{missing}"
    );
    let hidden = workbook_of(&[("Cover", "", &other), ("Old", "state=\"hidden\"", &objects)]);
    assert!(problems(hidden)[0].contains("only the hidden sheet \"Old\""));
    assert!(
        parse_inventory(
            b"id,height\n".to_vec(),
            Path::new("a.csv"),
            &ReadOptions {
                sheet: Some("x"),
                ..ReadOptions::new(&Lookup::NONE)
            }
        )
        .is_err()
    );
}

#[test]
fn what_is_around_an_object() {
    let list = "id,height [mm],depth [mm],Gap to wall [mm],neighbour gap (in),wall_restitution,casters,feet,clearance,\
                upper_height [mm],upper_thickness [mm],upper_mass [kg]\n\
                a,1800,450,0,2,0.2,,four castors,40 cm,,,\n\
                b,1800,450,50,,0,braked,castors,,900,300,60\n\
                c,1800,450,,,1,,\"castors, locked\",,,,\n\
                d,1800,450,-5,,,perhaps,feet,,900,,\n\
                e,1800,450,touching,none,,,feet,near the wall,,,\n";
    let reading = read(list).unwrap();
    let of = |n: usize| reading.inventory.items[n].surroundings;
    let plain = Surroundings::default();
    assert_eq!(
        of(0),
        Surroundings {
            wall_gap_m: Some(0.0),
            neighbour_gap_m: Some(0.0508),
            wall_restitution: Some(0.2),
            casters: Some(Casters::Free),
            clearance_m: Some(0.4),
            ..plain
        }
    );
    let upper = Some(UpperBody {
        height_m: 0.9,
        thickness_m: 0.3,
        mass_kg: Some(60.0),
    });
    let b = Surroundings {
        wall_gap_m: Some(0.05),
        wall_restitution: Some(0.0),
        casters: Some(Casters::Braked),
        ..plain
    };
    assert_eq!(of(1), Surroundings { upper, ..b });
    assert_eq!(
        of(2),
        Surroundings {
            casters: Some(Casters::Braked),
            ..plain
        }
    );
    assert_eq!([of(3), of(4)], [plain; 2]);
    let mut said: Vec<String> = reading
        .inventory
        .findings
        .iter()
        .map(|one| format!("{} {}", one.kind.name(), one.cells().join(" ")))
        .collect();
    said.sort();
    assert_eq!(
        said[..4],
        [
            "casters H2",
            "not-understood G5",
            "out-of-range D5",
            "out-of-range F4"
        ]
    );
    assert_eq!(
        said[4..],
        ["unreadable D6", "unreadable I6", "upper-alone J5"]
    );
}

#[test]
fn round_objects_are_known_by_a_column_a_mark_or_their_name() {
    let list = "id,item,shape,height mm,depth mm,width mm,diameter mm\n\
        a,tank,cylinder,1000,400,400,\n\
        b,pole,,1000,Ø400,,\n\
        c,dewar on a base,,950,500,500 dia,\n\
        d,Oxygen cylinder,,1520,230,230,\n\
        e,bookcase,,1800,300,900,\n\
        f,bin,,1000,,,400\n\
        g,gas cylinder in a box,box,1520,230,230,\n\
        h,Bottle rack,,1500,400,400,\n";
    let inventory = read(list).unwrap().inventory;
    let round: Vec<&str> = inventory
        .items
        .iter()
        .filter(|item| item.is_round())
        .map(|item| item.id.as_str())
        .collect();
    assert_eq!(round, ["a", "b", "c", "d", "f"]);
    for (place, side) in [(1, 0.4), (2, 0.5), (5, 0.4)] {
        let item = &inventory.items[place];
        assert_eq!(
            (item.thickness_m, item.width_m),
            (Some(side), Some(side)),
            "{}",
            item.id
        );
    }
    // The name alone is a doubt, and said.
    let doubted: Vec<(&str, &[u32])> = inventory
        .findings
        .iter()
        .map(|finding| (finding.kind.name(), finding.rows.as_slice()))
        .collect();
    assert_eq!(doubted, [("round", [5].as_slice())]);
}
