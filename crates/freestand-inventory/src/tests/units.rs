//! Columns of units: each row may have its own.

use super::*;

#[test]
fn a_column_of_units_gives_each_row_its_own() {
    for heading in [
        "Unit", "UOM", "Units", "Einheit", "Unité", "Unidad", "Unità", "Birimi", "Unidade", "単位",
        "单位",
    ] {
        let text = format!(
            "id,height,depth,mass [kg],{heading}\na,200,60,90,cm\nb,1800,450,80,MM\nc,72,24,70,inches\nd,2 m,60,60,cm\n"
        );
        let heights = [Some(2.0), Some(1.8), Some(1.8288), Some(2.0)];
        let read: Vec<Option<f64>> = height_and_mass(&text)
            .into_iter()
            .map(|(height, _)| height)
            .collect();
        assert_eq!(read, heights, "{heading}");
        assert_eq!(found(&text), Vec::<String>::new(), "{heading}");
    }
    // Sizes in one cell, and a workbook, in which 200 is a number.
    let sizes = "id,Dimensions H x W x D,Unit\na,200 x 90 x 60,cm\nb,1800 x 900 x 450,mm\n";
    assert_eq!(
        height_and_mass(sizes),
        [(Some(2.0), None), (Some(1.8), None)]
    );
    let rows = [
        row(1, &["id", "height", "depth", "Einheit"]),
        row(2, &["a", "<><v>200</v></c>", "<><v>60</v></c>", "cm"]),
        row(3, &["b", "<><v>1800</v></c>", "<><v>450</v></c>", "mm"]),
    ];
    assert_eq!(
        height_and_mass(workbook(&rows.concat(), "")),
        [(Some(2.0), None), (Some(1.8), None)]
    );
    // One column for sizes, one for masses; or both in one cell.
    for (headings, rows) in [
        (
            "id,height,depth,Unit,weight,Unit",
            ["a,200,60,cm,90,kg", "b,72,24,in,100,lb"],
        ),
        (
            "id,height,Height unit,depth,Unit,weight,Weight unit",
            ["a,200,cm,600,mm,90,kg", "b,72,in,60,cm,100,lb"],
        ),
        (
            "id,height,depth,weight,Unit",
            ["a,200,60,90,cm / kg", "b,72,24,100,\"in, lb\""],
        ),
    ] {
        let text = format!("{headings}\n{}\n{}\n", rows[0], rows[1]);
        let expected = [(Some(2.0), Some(90.0)), (Some(1.8288), Some(45.359_237))];
        assert_eq!(height_and_mass(&text), expected, "{text}");
        let thickness = |item: &Item| item.thickness_m;
        let sides: Vec<Option<f64>> = read(&text)
            .unwrap()
            .inventory
            .items
            .iter()
            .map(thickness)
            .collect();
        assert!(
            sides
                .iter()
                .flatten()
                .all(|side| (0.6..0.61).contains(side)),
            "{text}: {sides:?}"
        );
    }
}

#[test]
fn a_column_of_units_that_contradicts_or_is_none() {
    // Two readings: no value.
    let text =
        "id,height (mm),depth (mm),Unit\na,200,60,cm\nb,1800,450,mm\nc,2 m,60 cm,cm\nd,1700,400,\n";
    let said = found(text);
    let first = "error: unit-contradicted: height (mm): 1 cell (B2), such as \"200\"; mm by the heading, cm by the row";
    assert!(said.iter().any(|line| line.starts_with(first)), "{said:?}");
    assert_eq!(
        height_and_mass(text),
        [None, Some(1.8), Some(2.0), Some(1.7)].map(|height| (height, None))
    );
    // A mapping file decides.
    let mapping = Mapping::parse("[units]\nheight = \"cm\"\n").unwrap();
    let options = ReadOptions {
        mapping: Some(&mapping),
        ..ReadOptions::new(&Lookup::NONE)
    };
    let reading = parse_inventory(text.into(), Path::new("objects.csv"), &options).unwrap();
    assert_eq!(reading.inventory.items[0].height_m, Some(2.0));
    // What is no unit is said, and a column of other things is carried through.
    let said = found("id,height,depth,Unit\na,200,60,cm\nb,180,45,cubits\n");
    assert!(
        said.iter()
            .any(|line| line.starts_with("doubt: not-understood: Unit: 1 cell (D3)")),
        "{said:?}"
    );
    let merged = "<mergeCells count=\"1\"><mergeCell ref=\"D2:D3\"/></mergeCells>";
    let rows = [
        row(1, &["id", "height", "depth", "Unit"]),
        row(2, &["a", "200", "60", "cm"]),
        row(3, &["b", "180", "45"]),
    ];
    let said = found(workbook(&rows.concat(), merged));
    assert!(
        said.iter()
            .any(|line| line.starts_with("doubt: merged: Unit")),
        "{said:?}"
    );
    for cells in [["each", "each"], ["Ward M", "ICU"], ["", ""]] {
        let text = format!(
            "id,height [mm],depth [mm],Unit\na,2000,600,{}\nb,1800,450,{}\n",
            cells[0], cells[1]
        );
        let reading = read(&text).unwrap().inventory;
        assert_eq!(
            (reading.carried, reading.findings),
            (vec!["Unit".to_owned()], vec![]),
            "{text}"
        );
    }
}
