//! Objects that are no blocks: polygons, bodies on feet, scans.

use std::path::Path;

use crate::library::Lookup;
use crate::{
    Inventory, ItemShape, Kind, ReadOptions, items_from_lines, lines_of_items, read_inventory,
};

/// A box of 0.4 m × 0.4 m × 1 m, in metres.
const BOX: &str = "v 0 0 0\nv .4 0 0\nv .4 .4 0\nv 0 .4 0\nv 0 0 1\nv .4 0 1\nv .4 .4 1\nv 0 .4 1\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn read(folder: &Path, list: &str) -> Inventory {
    std::fs::write(folder.join("box.obj"), BOX).unwrap();
    let path = folder.join("list.csv");
    std::fs::write(&path, list).unwrap();
    read_inventory(&path, &ReadOptions::new(&Lookup::NONE)).unwrap()
}

fn kinds(inventory: &Inventory) -> Vec<(Kind, &'static str)> {
    let column = |finding: &crate::Finding| finding.column.map_or("", crate::Column::name);
    let all = inventory.findings.iter();
    all.map(|finding| (finding.kind, column(finding))).collect()
}

/// The tilt at which a body tips is known by hand: over the side of an octagon r cos 22.5°, over a
/// slanting side of a tripod its distance from the middle, over the side of the scanned box half of it.
#[test]
fn bodies_of_a_list_have_their_shape() {
    let folder = tempfile::tempdir().unwrap();
    let list = "id,height [mm],diameter [mm],thickness [mm],width [mm],shape,feet,scan,scan unit,scan base\n\
        octagon,1000,400,,,polygon:8,,,,\n\
        tripod,1000,,400,400,,\"-150 mm, -120 mm; 150 mm, -120 mm; 0 mm, 180 mm\",,,\n\
        scan,,,,,,,box.obj,m,measured\n\
        in words,1000,,400,400,,\"4 feet, levelled; 2 pads\",,,\n";
    let read = read(folder.path(), list);
    assert_eq!(kinds(&read), []);
    let tip_m = |place: usize| match &read.items[place].shape {
        ItemShape::Body(body) => body.barrier.tilt_rad.tan() * 0.5,
        other => panic!("{other:?}"),
    };
    let expected_m = [
        0.2 * 22.5_f64.to_radians().cos(),
        0.15 * 0.18 / 0.15_f64.hypot(0.3),
        0.2,
    ];
    for (place, expected_m) in expected_m.into_iter().enumerate() {
        // The barrier is found to a hundredth of a millimetre.
        let found_m = tip_m(place);
        assert!(
            (found_m - expected_m).abs() < 1e-4,
            "{found_m} {expected_m}"
        );
    }
    assert_eq!(read.items[2].height_m, Some(1.0));
    assert_eq!(
        (&read.items[3].shape, &*read.items[3].rests_on),
        (&ItemShape::Block, "4 feet, levelled; 2 pads")
    );
    assert_eq!(read.scans.len(), 1);
    let lines = lines_of_items(&read.items).unwrap();
    assert_eq!(items_from_lines(&lines), Some(read.items));
}

/// A body that cannot be used is no block instead.
#[test]
fn a_body_that_cannot_be_used_is_said_and_has_no_shape() {
    let folder = tempfile::tempdir().unwrap();
    let list = "id,height [mm],thickness [mm],width [mm],feet,scan,scan unit,scan base,mass [kg]\n\
        outside,1000,400,400,\"-300 mm, -120 mm; 150 mm, -120 mm; 0 mm, 180 mm\",,,,\n\
        two,1000,400,400,\"-150 mm, -120 mm; 150 mm, -120 mm\",,,,\n\
        no unit,,,,,box.obj,,,\n\
        in mm,,,,,box.obj,mm,,\n\
        no file,,,,,no.obj,m,,\n\
        other height,2000,,,,box.obj,m,,\n\
        lead,,,,,box.obj,m,,9000\n";
    let read = read(folder.path(), list);
    let unknown = |item: &crate::Item| item.shape == ItemShape::Unknown;
    assert!(read.items.iter().all(unknown), "{:#?}", read.items);
    let mut found = kinds(&read);
    found.sort_by_key(|(kind, name)| (format!("{kind:?}"), *name));
    let expected = [
        (Kind::OutOfRange, "height"),
        (Kind::OutOfRange, "mass"),
        (Kind::OutOfRange, "rests_on"),
        (Kind::OutOfRange, "scan"),
        (Kind::OutOfRange, "scan_unit"),
        (Kind::Unreadable, "rests_on"),
        (Kind::Unreadable, "scan"),
    ];
    assert_eq!(found, expected);
}

/// What stands beside a shape in its row and contradicts it, or cannot be read, is said; nothing else takes its place.
#[test]
fn what_contradicts_a_body_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let feet = "-150 mm, -120 mm; 150 mm, -120 mm; 0 mm, 180 mm";
    let typo = "x150 mm, -120 mm; 150 mm, -120 mm; 0 mm, 180 mm";
    let cases = [
        (format!("1000,400,400,,,\"{typo}\",,,"), "rests_on"),
        (format!("1000,400,400,300,,\"{feet}\",,,"), "base_thickness"),
        (format!("1000,400,,,,\"{feet}\",,,"), "width"),
        (",700,,,,,box.obj,m,".to_owned(), "thickness"),
        (",,,,cylinder,,box.obj,m,".to_owned(), "shape"),
        (",,,,,,../box.obj,m,".to_owned(), "scan"),
        ("1000,400,,,polygon:9999,,,,".to_owned(), "shape"),
    ];
    for (row, column) in cases {
        let head = "id,height [mm],thickness [mm],width [mm],base thickness [mm],shape,feet,scan,scan unit,mass [kg]";
        let read = read(folder.path(), &format!("{head}\na,{row}\n"));
        let named: Vec<&str> = kinds(&read).into_iter().map(|(_, name)| name).collect();
        assert_eq!(named, [column], "{row}: {:?}", read.findings);
    }
    // Sides in the other order and within a tenth are those of the scan; a polygon stands on its base.
    let list = "id,height [mm],thickness [mm],width [mm],base thickness [mm],shape,scan,scan unit,scan base\n\
        scan,1010,390,410,,,box.obj,m,measured\n\
        foot,1000,400,,200,polygon:8,,,\n\
        two sides,1000,400,900,,cylinder,,,\n";
    let read = read(folder.path(), list);
    assert_eq!(kinds(&read), [(Kind::TwoColumns, "width")]);
    let ItemShape::Body(foot) = &read.items[1].shape else {
        panic!("{:?}", read.items[1].shape);
    };
    let tip_m = foot.barrier.tilt_rad.tan() * 0.5;
    assert!(
        (tip_m - 0.1 * 22.5_f64.to_radians().cos()).abs() < 1e-4,
        "{tip_m}"
    );
}
