//! Registers as hospitals keep them, compared with what a person reads in them.

use super::*;

/// The folder of files that are shared beside the project.
fn shared(file: &str) -> Option<std::path::PathBuf> {
    let folder = std::env::var_os("FREESTAND_SHARED").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
        std::path::PathBuf::from,
    );
    let path = folder.join(file);
    if path.exists() {
        return Some(path);
    }
    println!(
        "skipped: {} is not there ($FREESTAND_SHARED)",
        path.display()
    );
    None
}

#[test]
fn a_register_of_a_hospital_reads_as_a_person_reads_it() {
    let (Some(workbook), Some(truth)) = (
        shared("registers/hospital.xlsx"),
        shared("registers/hospital-truth.csv"),
    ) else {
        return;
    };
    let floors = Floors {
        storeys: Some(7),
        ..Floors::default()
    };
    let options = ReadOptions {
        floors,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let inventory = inspect_inventory(&workbook, &options).unwrap().inventory;
    let mut truth = csv::Reader::from_path(truth).unwrap();
    let rows: Vec<csv::StringRecord> = truth.records().map(Result::unwrap).collect();
    let ids: Vec<&str> = rows.iter().map(|row| &row[0]).collect();
    let found: Vec<&str> = inventory
        .items
        .iter()
        .map(|item| item.id.as_str())
        .collect();
    assert_eq!(found, ids);
    let doubted = |item: &Item, columns: &[Column]| {
        let is_here = |finding: &Finding| {
            finding.rows.contains(&item.row)
                && finding
                    .column
                    .is_some_and(|column| columns.contains(&column))
        };
        inventory.findings.iter().any(is_here)
    };
    let (mut equal, mut doubts, mut silent) = (0, Vec::new(), Vec::new());
    for (row, item) in rows.iter().zip(&inventory.items) {
        let mut compare = |what: &'static str, is_equal: bool, columns: &[Column]| match (
            is_equal,
            doubted(item, columns),
        ) {
            (true, _) => equal += 1,
            (false, true) => doubts.push((item.id.as_str(), what)),
            (false, false) => silent.push(format!("{} {what}: {item:?}, not {row:?}", item.id)),
        };
        let same = |found: Option<f64>, at: usize, scale: f64| match (
            found,
            row[at].parse::<f64>().ok(),
        ) {
            // Inches are given to a tenth of a millimetre, pounds to ten grams.
            (Some(found), Some(expected)) => {
                (found - expected / scale).abs() <= 1e-3 * (expected / scale).max(0.1)
            }
            (found, expected) => found.is_none() && expected.is_none(),
        };
        compare("height", same(item.height_m, 2, 1e3), &[Column::Height]);
        // The truth has the shorter side first.
        let mut sides = [item.thickness_m, item.width_m];
        if sides[1].is_some() {
            sides.sort_by(|a, b| a.unwrap_or_default().total_cmp(&b.unwrap_or_default()));
        }
        let of_sides = [Column::Thickness, Column::Width];
        compare("shorter side", same(sides[0], 3, 1e3), &of_sides);
        compare("longer side", same(sides[1], 4, 1e3), &of_sides);
        compare("mass", same(item.mass_kg, 5, 1.0), &[Column::Mass]);
        compare(
            "quantity",
            same(Some(f64::from(item.quantity)), 7, 1.0),
            &[Column::Quantity],
        );
        let level = match &row[6] {
            "roof" => 1.0,
            text => text.parse::<f64>().unwrap().max(0.0) / 7.0,
        };
        let is_level = item
            .level_ratio
            .is_some_and(|found| (found - level).abs() <= 1e-9);
        compare("level", is_level, &[Column::Floor]);
        let anchored = (
            item.anchored == Some(true),
            item.doubts.contains(&Kind::AnchoredUnclear),
        );
        compare(
            "anchored",
            anchored == (&row[8] == "yes", &row[8] == "yes?"),
            &[],
        );
        let casters = item
            .surroundings
            .casters
            .filter(|casters| *casters != Casters::None)
            .map_or("", Casters::name);
        compare("casters", casters == &row[9], &[]);
    }
    assert!(silent.is_empty(), "{}", silent.join("\n"));
    // Eight columns of 74 rows. Doubted are the sizes of two rows in a wrong unit, and a mezzanine.
    assert_eq!(equal + doubts.len(), 8 * 74);
    let of_sizes = ["height", "shorter side", "longer side"];
    let sizes = ["ED-011", "WA-406"]
        .into_iter()
        .flat_map(|id| of_sizes.map(|what| (id, what)));
    assert_eq!(
        doubts,
        sizes.chain([("WA-410", "level")]).collect::<Vec<_>>()
    );
    // The round ones: cylinders, a dewar.
    let round: Vec<&str> = inventory
        .items
        .iter()
        .filter(|item| item.is_round())
        .map(|item| item.id.as_str())
        .collect();
    assert_eq!(round, ["ED-007", "ED-007 #2", "PA-207", "PA-211"]);
    // Impossible sizes have an edit that mends them.
    let to_confirm: Vec<(&str, &[String])> = inventory
        .items
        .iter()
        .filter(|item| !item.to_confirm.is_empty())
        .map(|item| (item.id.as_str(), item.to_confirm.as_slice()))
        .collect();
    let edits = |all: [&str; 3]| all.map(str::to_owned).to_vec();
    assert_eq!(
        to_confirm,
        [
            (
                "ED-011",
                edits(["F17=1.45 m", "H17=0.85 m", "G17=0.55 m"]).as_slice()
            ),
            (
                "WA-406",
                edits(["F60=190 cm", "H60=65 cm", "G60=60 cm"]).as_slice()
            )
        ]
    );
    // Applied, nothing is left to confirm.
    let edits: Vec<Edit> = inventory
        .items
        .iter()
        .flat_map(|item| &item.to_confirm)
        .map(|edit| Edit::parse(edit).unwrap())
        .collect();
    let options = ReadOptions {
        edits: &edits,
        ..options
    };
    let mended = inspect_inventory(&workbook, &options).unwrap().inventory;
    assert!(mended.items.iter().all(|item| item.to_confirm.is_empty()));
    let mended = mended
        .items
        .iter()
        .find(|item| item.id == "ED-011")
        .unwrap();
    assert_eq!(
        (mended.height_m, mended.thickness_m),
        (Some(1.45), Some(0.85))
    );
}

#[test]
fn sizes_that_no_object_has_wait_for_a_person() {
    let list = "id,item,floor,height mm,depth mm,width mm,weight kg\n1,a,0,1800,500,600,80\n2,b,0,1900,600,700,90\n\
        3,c,0,1700,550,650,70\n4,d,0,1750,500,600,85\n5,e,0,1.45,0.55,0.85,145\n6,f,0,190,60,65,95\n7,g,0,18500,600,600,95\n";
    let inventory = read(list).unwrap().inventory;
    let edits: Vec<&[String]> = inventory
        .items
        .iter()
        .map(|item| item.to_confirm.as_slice())
        .collect();
    assert!(edits[..4].iter().all(|edits| edits.is_empty()), "{edits:?}");
    assert_eq!(edits[4], ["D6=1.45 m", "E6=0.55 m", "F6=0.85 m"]);
    assert_eq!(edits[5], ["D7=190 cm", "E7=60 cm", "F7=65 cm"]);
    // Ten times too high, and in no other unit right: it can only be confirmed or corrected by hand.
    assert_eq!(edits[6], ["D8=18500"]);
    // An edit with the same text confirms the cell.
    let edits = [Edit::parse("D8=18500").unwrap()];
    let options = ReadOptions {
        edits: &edits,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let confirmed = parse_inventory(list.into(), Path::new("objects.csv"), &options)
        .unwrap()
        .inventory;
    assert!(confirmed.items[6].to_confirm.is_empty() && !confirmed.items[5].to_confirm.is_empty());
    // A list of things as different as statues and rings is no list of mistakes.
    let museum = "id,item,height mm,depth mm,width mm\n1,a,3000,900,900\n2,b,200,60,60\n3,c,900,300,300\n4,d,70,30,30\n\
        5,e,1800,500,500\n6,f,450,150,200\n7,g,120,80,80\n";
    assert!(
        read(museum)
            .unwrap()
            .inventory
            .items
            .iter()
            .all(|item| item.to_confirm.is_empty())
    );
}

#[test]
fn a_cell_that_is_not_understood_is_a_doubt() {
    let list = "id,item,Castors,Fixed?,Qty,height mm,depth mm,width mm,weight kg,max shock (g)\n\
        1,a,see photo,no,2,1800,500,600,80,5\n2,b,no,Y?,2,1900,600,700,90,5\n3,c,no,no,several,1700,550,650,70,5\n\
        4,d,no,no,2 pairs,tall,500,600,heavy,5\n5,e,no,no,6 off,1800,ditto,600,1400 full,low\n";
    let inventory = read(list).unwrap().inventory;
    let found: Vec<(&str, &str, &[u32])> = inventory
        .findings
        .iter()
        .map(|finding| {
            (
                finding.kind.name(),
                finding.column.map_or("", Column::name),
                finding.rows.as_slice(),
            )
        })
        .collect();
    for expected in [
        ("not-understood", "casters", [2].as_slice()),
        ("anchored-unclear", "anchored", &[3]),
        ("not-understood", "quantity", &[4]),
        ("approximate", "quantity", &[5]),
        ("not-understood", "height", &[5]),
        ("not-understood", "mass", &[5]),
        ("not-understood", "thickness", &[6]),
        ("not-understood", "tolerance", &[6]),
    ] {
        assert!(
            found.contains(&expected),
            "{expected:?} is not among {found:?}"
        );
    }
    let quantities: Vec<u32> = inventory.items.iter().map(|item| item.quantity).collect();
    assert_eq!(
        (quantities, inventory.items[4].mass_kg),
        (vec![2, 2, 1, 4, 6], Some(1400.0))
    );
}

#[test]
fn headings_again_in_another_order_begin_another_table() {
    let list = "id,item,height mm,depth mm,width mm\n1,a,1800,500,600\n2,b,1900,600,700\n\
        id,item,depth mm,height mm,width mm\n3,c,500,1700,600\nInv.-Nr.,Bezeichnung,Höhe [cm],Tiefe [cm],Breite [cm]\n\
        4,d,195,60,120\nid,item,height mm,depth mm,width mm\n";
    let items = read(list).unwrap().inventory.items;
    let sizes: Vec<(Option<f64>, Option<f64>)> = items
        .iter()
        .map(|item| (item.height_m, item.thickness_m))
        .collect();
    let expected = [(1.8, 0.5), (1.9, 0.6), (1.7, 0.5), (1.95, 0.6)]
        .map(|(height, depth)| (Some(height), Some(depth)));
    assert_eq!(sizes, expected);
}

/// Height and depth in each other's columns make low objects that nothing overturns.
#[test]
fn low_objects_are_doubted() {
    let list =
        "id,item,height mm,depth mm,width mm\n1,cabinet,300,1800,900\n2,bench,900,700,1600\n";
    let items = read(list).unwrap().inventory.items;
    assert_eq!(
        (items[0].doubts.as_slice(), items[1].doubts.as_slice()),
        (&[Kind::Low][..], &[][..])
    );
}

#[test]
fn one_floor_of_several_names_is_one() {
    let list = "id,item,floor,height mm,depth mm\n1,a,Level 6,1800,500\n2,b,L6,1800,500\n3,c,6,1800,500\n4,d,first,1800,500\n\
        5,e,Level -1,1800,500\n6,f,L1,1800,500\n";
    let floors = Floors {
        storeys: Some(7),
        ..Floors::default()
    };
    let options = ReadOptions {
        floors,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let items = parse_inventory(list.into(), Path::new("objects.csv"), &options)
        .unwrap()
        .inventory
        .items;
    let floors: Vec<&str> = items.iter().map(|item| item.floor.as_str()).collect();
    assert_eq!(
        floors,
        [
            "Level 6", "Level 6", "Level 6", "first", "Level -1", "first"
        ]
    );
    assert_eq!(
        (items[3].level_ratio, items[4].level_ratio),
        (Some(1.0 / 7.0), Some(0.0))
    );
}

#[test]
fn the_order_in_a_heading_holds() {
    for heading in [
        "Dimensions H x W x D (mm)",
        "Dimensions HxWxD mm",
        "H x W x D (mm)",
        "Boyutlar (YxGxD) mm",
        "尺寸 (高x长x宽) mm",
    ] {
        let list = format!("id,item,{heading}\n1,a,900 x 1200 x 400\n");
        let item = read(&list).unwrap().inventory.items.swap_remove(0);
        assert_eq!(
            (item.height_m, item.width_m, item.thickness_m),
            (Some(0.9), Some(1.2), Some(0.4)),
            "{heading}"
        );
        assert!(item.doubts.is_empty(), "{heading}");
    }
}

#[test]
fn a_turkish_list_is_read_alone() {
    let list = "Demirbaş No;Tanım;Kat;Adet;Yükseklik (cm);Genişlik (cm);Derinlik (cm);Ağırlık (kg);Sabit mi?;Tekerlek\n\
        TR-1;İlaç dolabı;3. kat;2;200;90;40;120,0;hayır;yok\nTR-2;Küvöz;4. kat;1;140;110;70;95;evet;kilitli\n\
        TR-3;Buzdolabı;Zemin kat;1;185;60;65;88;hayır;yok\n";
    let floors = Floors {
        storeys: Some(6),
        ..Floors::default()
    };
    let options = ReadOptions {
        floors,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let items = parse_inventory(list.into(), Path::new("objects.csv"), &options)
        .unwrap()
        .inventory
        .items;
    assert_eq!(
        (items[0].height_m, items[0].mass_kg, items[0].level_ratio),
        (Some(2.0), Some(120.0), Some(0.5))
    );
    assert_eq!(
        (items[0].anchored, items[1].anchored),
        (Some(false), Some(true))
    );
    assert_eq!(
        (items[1].surroundings.casters, items[2].level_ratio),
        (Some(Casters::Braked), Some(0.0))
    );
}

/// The sheet that explains the columns of the template has more cells than the list.
#[test]
fn the_headings_of_a_workbook_are_those_of_its_list() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.xlsx");
    std::fs::write(&path, template_xlsx().unwrap()).unwrap();
    let headings = inspect_headings(&path, None).unwrap();
    let named: Vec<_> = headings.iter().take(3).map(|one| one.name).collect();
    assert_eq!(named, [Some("id"), Some("item"), Some("quantity")]);
}

#[test]
fn headings_that_nobody_knows_give_a_mapping_file_to_complete() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(
        &path,
        "Koodi;Nimi;Korkeus;Syvyys\nA;kaappi;1800;450\nB;hylly;2000;300\n",
    )
    .unwrap();
    assert!(read(std::fs::read(&path).unwrap()).is_err());
    let headings = inspect_headings(&path, None).unwrap();
    let elsewhere = inspect_headings(&path, Some("nosuch")).unwrap_err();
    assert!(
        elsewhere.to_string().contains("has no sheet \"nosuch\""),
        "{elsewhere}"
    );
    let named: Vec<&str> = headings.iter().map(|one| one.heading.as_str()).collect();
    assert_eq!(
        (named, headings[2].samples.as_slice()),
        (
            vec!["Koodi", "Nimi", "Korkeus", "Syvyys"],
            &["1800".to_owned(), "2000".to_owned()][..]
        )
    );
    let text = mapping_of_headings(&headings);
    let mapped = text
        .replace("\"Koodi\" = \"ignore\"", "\"Koodi\" = \"id\"")
        .replace(
            "\"Korkeus\" = \"ignore\"",
            "\"Korkeus\" = { name = \"height\", unit = \"mm\" }",
        )
        .replace(
            "\"Syvyys\" = \"ignore\"",
            "\"Syvyys\" = { name = \"thickness\", unit = \"mm\" }",
        );
    let mapping = Mapping::parse(&mapped).unwrap();
    let options = ReadOptions {
        mapping: Some(&mapping),
        ..ReadOptions::new(&Lookup::NONE)
    };
    let items = inspect_inventory(&path, &options)
        .unwrap_or_else(|error| panic!("{error}\n{mapped}"))
        .inventory
        .items;
    assert_eq!(
        (
            items[0].id.as_str(),
            items[0].height_m,
            items[1].thickness_m
        ),
        ("A", Some(1.8), Some(0.3))
    );
}

#[test]
fn a_missing_number_of_storeys_is_one_problem() {
    let mut list = "id,item,floor,height mm,depth mm\n".to_owned();
    for row in 0..500 {
        list += &format!("{row},rack,{},1800,500\n", 1 + row % 6);
    }
    let findings = read(&list).unwrap().inventory.findings;
    let kinds: Vec<(&str, usize)> = findings
        .iter()
        .map(|one| (one.kind.name(), one.rows.len()))
        .collect();
    assert_eq!(kinds, [("storeys-missing", 0)]);
    let report = problem_reports(&findings, freestand_input::keys::KeyStyle::Flag);
    assert_eq!((report[0].count, report[0].severity), (1, "error"));
}

#[test]
fn rows_that_a_spreadsheet_hides_are_read_and_said() {
    let heading = row(1, &HEADINGS);
    let shown = row(2, &["a", "rack", "0.5", "1800", "600", ""]);
    let hidden =
        row(3, &["b", "rack", "0.5", "1800", "600", ""]).replace("<row ", "<row hidden=\"1\" ");
    let book = workbook(&[heading, shown, hidden].concat(), "");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.xlsx");
    std::fs::write(&path, &book).unwrap();
    let inventory = read(book).unwrap().inventory;
    let doubted: Vec<bool> = inventory
        .items
        .iter()
        .map(|item| item.doubts.contains(&Kind::HiddenRow))
        .collect();
    assert_eq!(doubted, [false, true]);
    let finding = inventory
        .findings
        .iter()
        .find(|finding| finding.kind == Kind::HiddenRow)
        .unwrap();
    assert_eq!(finding.rows, [3]);
    // In the marked copy a style of its own strikes it through.
    let copy = marked_copy(&path, &ReadOptions::new(&Lookup::NONE), &inventory.findings).unwrap();
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(copy)).unwrap();
    let mut styles = String::new();
    std::io::Read::read_to_string(&mut archive.by_name("xl/styles.xml").unwrap(), &mut styles)
        .unwrap();
    assert!(styles.contains("<strike/>"), "{styles}");
}
