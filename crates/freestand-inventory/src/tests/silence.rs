//! Cells that contradict each other or say two things: none is read as one of them in silence.

use super::*;

/// The first object of a list, and its problems.
fn first(list: &str) -> (Item, Vec<String>) {
    let inventory = read(list).unwrap().inventory;
    let lines = inventory.findings.iter().map(Finding::line).collect();
    (inventory.items.into_iter().next().unwrap(), lines)
}

#[test]
fn a_name_or_a_note_that_speaks_of_wheels_is_heard() {
    let list = |item: &str, casters: &str, rests_on: &str, notes: &str| {
        first(&format!(
            "id,item,height [mm],thickness [mm],casters,rests on,notes\n1,\"{item}\",1800,600,{casters},\"{rests_on}\",{notes}\n"
        ))
    };
    for (item, casters, rests_on, notes, place) in [
        (
            "Linen shelving on castors",
            "no",
            "",
            "",
            "item: 1 cell (B2)",
        ),
        ("Linen shelving on castors", "", "", "", "item: 1 cell (B2)"),
        ("shelf", "", "", "on wheels", "notes: 1 cell (G2)"),
        ("shelf", "no", "castors, free", "", "rests on: 1 cell (F2)"),
        ("shelf", "no", "wheels", "", "rests on: 1 cell (F2)"),
        (
            "shelf",
            "braked",
            "castors, free",
            "",
            "rests on: 1 cell (F2)",
        ),
        ("shelf", "was locked", "", "", "casters: 1 cell (E2)"),
    ] {
        let (found, lines) = list(item, casters, rests_on, notes);
        assert_eq!(
            found.surroundings.casters,
            Some(Casters::Free),
            "{item} {casters} {rests_on} {notes}"
        );
        assert!(
            lines.len() == 1 && lines[0].starts_with(&format!("doubt: casters: {place}")),
            "{lines:?}"
        );
        assert!(
            lines[0].ends_with(
                "if all are braked, read `edit = \"E2=braked\"`; if it has none, correct this cell"
            ),
            "{lines:?}"
        );
    }
    for (item, casters, rests_on, notes, expected) in [
        ("shelf on castors", "braked", "", "", Some(Casters::Braked)),
        ("shelf on castors", "free", "", "", Some(Casters::Free)),
        ("Ventilator, castors braked", "", "", "", None),
        ("shelf", "no", "", "no castors", Some(Casters::None)),
        ("shelf", "Rollen: keine", "feet", "", Some(Casters::None)),
    ] {
        let (found, lines) = list(item, casters, rests_on, notes);
        assert_eq!(
            (found.surroundings.casters, lines.len()),
            (expected, 0),
            "{item} {casters} {rests_on} {notes}"
        );
    }
}

#[test]
fn what_rolls_is_not_anchored() {
    let list = |casters: &str| {
        first(&format!(
            "id,item,height [mm],thickness [mm],anchored,casters\n1,shelf,1800,600,yes,{casters}\n"
        ))
    };
    let (found, lines) = list("free");
    assert!(
        found.anchored.is_none()
            && lines[0].starts_with("doubt: anchored-unclear: anchored: 1 cell (E2)")
    );
    assert_eq!(list("braked").0.anchored, Some(true));
}

#[test]
fn a_sentence_of_units_in_the_list_is_no_section() {
    let list = |unit: &str, sentence: &str| {
        read(format!(
            "id,item,height{unit},depth{unit},clearance (in)\n1,shelf,180,60,\n{sentence},,,,\n2,rack,200,60,4\n"
        ))
        .unwrap()
        .inventory
    };
    let agreed = list("", "all dimensions in cm");
    assert_eq!(
        (agreed.items[0].height_m, agreed.items[1].section.as_str()),
        (Some(1.8), "")
    );
    let differs = list(" (in)", "all dimensions in cm");
    assert_eq!(
        (differs.items[0].height_m, differs.items[1].thickness_m),
        (None, None)
    );
    let lines: Vec<String> = differs.findings.iter().map(Finding::line).collect();
    assert!(
        lines.len() == 2
            && lines[0].starts_with("error: unit-contradicted: height (in): 2 cells (C2, C4)")
    );
    assert!(
        lines[0].contains("in by the heading, cm by a sentence of the list"),
        "{lines:?}"
    );
    // The gap keeps the unit of its heading.
    assert_eq!(
        differs.items[1].surroundings.clearance_m,
        Some(4.0 * 0.0254)
    );
    assert!(
        list(" (in)", "all dimensions in cm unless noted")
            .findings
            .is_empty()
    );
    assert!(
        list(" (in)", "all dimensions in inches")
            .findings
            .is_empty()
    );
}

#[test]
fn two_values_in_a_cell_are_none_of_them() {
    let lines = found("id,item,height [mm],depth [mm],mass [kg]\n1,shelf,1800/2000,600,150/300\n");
    assert!(
        lines
            .iter()
            .all(|line| line.starts_with("error: number-ambiguous: ")),
        "{lines:?}"
    );
    assert!(
        lines.len() == 2 && lines.iter().all(|line| !line.contains("edit")),
        "{lines:?}"
    );
}

#[test]
fn a_floor_with_a_height_is_not_guessed() {
    let list = "id,item,floor,height [mm],depth [mm]\n1,shelf,Mezzanine,1800,600\n";
    let floors = Floors {
        named: vec![("Mezzanine".to_owned(), 0.2)],
        storeys: Some(5),
        ..Floors::default()
    };
    let options = ReadOptions {
        floors,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let inventory = parse_inventory(list.into(), "list.csv".as_ref(), &options)
        .unwrap()
        .inventory;
    assert_eq!(
        (inventory.items[0].level_ratio, inventory.findings.len()),
        (Some(0.2), 0)
    );
}

/// The edits that a hint names are those that answer it.
#[test]
fn a_doubt_is_answered_by_the_edits_of_its_hint() {
    let list =
        "id,item,height [mm],depth [mm]\n1,oxygen cylinder,1500,230\n2,shelf on castors,1800,600\n";
    let read = |edits: &[Edit]| {
        let options = ReadOptions {
            edits,
            ..ReadOptions::new(&Lookup::NONE)
        };
        parse_inventory(list.into(), "list.csv".as_ref(), &options)
            .unwrap()
            .inventory
    };
    let findings = read(&[]).findings;
    assert_eq!(findings.len(), 2, "{findings:?}");
    for finding in findings {
        let edits: Vec<Edit> = finding
            .hint
            .split("`edit = \"")
            .skip(1)
            .map(|rest| Edit::parse(rest.split('"').next().unwrap()).unwrap())
            .collect();
        assert_eq!(edits.len(), 2, "{}", finding.hint);
        assert!(
            !read(&edits)
                .findings
                .iter()
                .any(|other| other.kind == finding.kind),
            "{}",
            finding.hint
        );
    }
}

#[test]
fn a_total_without_a_value_costs_nothing() {
    let rows = row(1, &HEADINGS)
        + &row(2, &["a", "x", "0.5", "1800", "600", ""])
        + &row(3, &["Total", "", "", "", "", "<><f>SUM(F2:F2)</f></c>"]);
    let said = "row 3: formulas without a value in rows that are no objects are left empty";
    let inventory = read(workbook(&rows, "")).unwrap().inventory;
    assert_eq!(inventory.warnings, [said]);
    let converted = convert_bytes(
        workbook(&rows, ""),
        Path::new("objects.xlsx"),
        None,
        Target::Csv,
    )
    .unwrap();
    assert!(
        converted.warnings.iter().any(|warning| warning == said),
        "{:?}",
        converted.warnings
    );
}

#[test]
fn hidden_columns_are_named_and_rows_without_a_height_are_hidden() {
    let rows = row(1, &HEADINGS)
        + &row(2, &["a", "x", "0.5", "1800", "600", ""]).replace("<row ", "<row ht=\"0\" ");
    let sheet = sheet(&rows, "").replace(
        "<sheetData>",
        "<cols><col min=\"4\" max=\"4\" hidden=\"1\"/></cols><sheetData>",
    );
    let inventory = read(workbook_of(&[("Objects", "", &sheet)]))
        .unwrap()
        .inventory;
    let said = "a spreadsheet does not show all columns that were read, as D (height [mm]) is hidden; show or delete them";
    assert_eq!(inventory.warnings, [said]);
    assert_eq!(inventory.items[0].doubts, [Kind::HiddenRow]);
    // Costs are read as well, when money is asked for.
    let headings = [&HEADINGS[..], &["Replacement value NZD"]].concat();
    let rows = row(1, &headings) + &row(2, &["a", "x", "0.5", "1800", "600", "", "900"]);
    let last = headings.len();
    let hidden =
        format!("<cols><col min=\"{last}\" max=\"{last}\" hidden=\"1\"/></cols><sheetData>");
    let sheet = self::sheet(&rows, "").replace("<sheetData>", &hidden);
    let warnings = read(workbook_of(&[("Objects", "", &sheet)]))
        .unwrap()
        .inventory
        .warnings;
    assert!(
        warnings.len() == 1 && warnings[0].contains("(Replacement value NZD) is hidden"),
        "{warnings:?}"
    );
}

/// What it stands on may contradict the column of casters, which then does not brake it.
#[test]
fn wheels_that_two_columns_describe_differently_are_free() {
    let read = |casters: &str, rests_on: &str| {
        let list = format!(
            "id,item,height [mm],depth [mm],casters,rests on\n1,shelf,1800,600,{casters},\"{rests_on}\"\n"
        );
        let options = ReadOptions::new(&Lookup::NONE);
        let inventory = parse_inventory(list.into(), "list.csv".as_ref(), &options)
            .unwrap()
            .inventory;
        (
            inventory.items[0].surroundings.casters,
            inventory.items[0].doubts.contains(&Kind::Casters),
        )
    };
    assert_eq!(
        read("braked", "castors, 2 of 4 locked"),
        (Some(Casters::Free), true)
    );
    assert_eq!(read("braked", "castors, free"), (Some(Casters::Free), true));
    assert_eq!(read("free", "castors, braked"), (Some(Casters::Free), true));
    assert_eq!(
        read("braked", "castors with brakes"),
        (Some(Casters::Braked), false)
    );
    assert_eq!(
        read("braked", "castors, locked"),
        (Some(Casters::Braked), false)
    );
}

#[test]
fn further_edits_of_impossible_sizes_are_counted() {
    let rows: String = (0..5)
        .map(|row| format!("{row},shelf,18,600,800\n"))
        .collect();
    let finding = &read(format!("id,item,height [mm],depth [mm],width [mm]\n{rows}"))
        .unwrap()
        .inventory
        .findings[0];
    assert_eq!(finding.edits.len(), 5);
    assert!(
        finding
            .hint
            .ends_with("; 2 more cells to correct or confirm in the same way"),
        "{}",
        finding.hint
    );
}
