//! How a list was understood.

use freestand_input::quantity::{Dimension, UnitSystem, format_si, shorten};
use freestand_input::words::counted;
use freestand_inventory::{CheckReport, Inventory, Item, Kind, SHOWN};
use freestand_study::cushion::cushion_words;

use crate::table::{pairs, table};

/// How a list was understood.
pub fn list_text(report: &CheckReport, inventory: &Inventory, units: UnitSystem) -> String {
    let counts = &report.counts;
    let of = |count: usize| format!("{count} of {}", counts.rows);
    let mut facts = vec![
        ("file", report.path.clone()),
        ("headings", format!("row {}", report.header_row)),
        (
            "rows",
            format!(
                "{} ({})",
                counts.rows,
                counted(counts.objects as usize, "object")
            ),
        ),
        ("with height and thickness", of(counts.with_size)),
        ("with a level", of(counts.with_level)),
        ("with a width (both axes)", of(counts.with_width)),
        ("with a mass", of(counts.with_mass)),
        ("with a cushion", of(counts.with_cushion)),
        ("with a tolerance", of(counts.with_tolerance)),
    ];
    if let Some(sheet) = &report.sheet {
        facts.insert(1, ("sheet", sheet.clone()));
    }
    if !report.carried.is_empty() {
        facts.push(("carried through", report.carried.join(", ")));
    }
    let columns: Vec<Vec<String>> = report
        .columns
        .iter()
        .map(|one| {
            let unit = match (&one.unit, one.unit_source) {
                (Some(unit), Some("heading")) => unit.clone(),
                (Some(unit), Some(source)) => format!("{unit} ({source})"),
                (None, Some(_)) => "in each cell".to_owned(),
                _ => String::new(),
            };
            let dialect = one.dialect.unwrap_or_default().to_owned();
            let (values, missing) = (one.values.to_string(), one.missing.to_string());
            vec![
                one.letter.clone(),
                one.heading.clone(),
                one.name.to_owned(),
                unit,
                dialect,
                values,
                missing,
            ]
        })
        .collect();
    let left_out: Vec<Vec<String>> = report
        .left_out
        .iter()
        .take(SHOWN)
        .map(|left| {
            vec![
                left.row.to_string(),
                left.kind.to_owned(),
                shorten(&left.text),
            ]
        })
        .collect();
    let shown: Vec<Vec<String>> = inventory
        .items
        .iter()
        .take(SHOWN)
        .map(|item| line(item, units))
        .collect();
    let headings = [
        "row",
        "id",
        "item",
        "level",
        "height",
        "thickness",
        "width",
        "mass",
        "cushion",
        "tolerance",
    ];
    let mut text = pairs(&facts);
    text += "\n";
    text += &table(
        &[
            "column",
            "heading",
            "meaning",
            "unit",
            "decimal sign",
            "values",
            "missing",
        ],
        &columns,
    );
    if !left_out.is_empty() {
        text += "\nrows that are not objects\n";
        text += &table(&["row", "kind", "text"], &left_out);
        if report.left_out.len() > SHOWN {
            text += &format!("and {} more\n", report.left_out.len() - SHOWN);
        }
    }
    text += "\n";
    text += &table(&headings, &shown);
    if inventory.items.len() > SHOWN {
        text += &format!("and {} more\n", inventory.items.len() - SHOWN);
    }
    if let Some(path) = &report.marked_copy {
        text += &format!("\nmarked copy: {path}\n");
    }
    text
}

fn line(item: &Item, units: UnitSystem) -> Vec<String> {
    let value = |value: Option<f64>, dimension| {
        value.map_or_else(
            || "-".to_owned(),
            |value| match (units, dimension) {
                (UnitSystem::Us, Dimension::Length) => units.length(value),
                (UnitSystem::Us, Dimension::Mass) => units.mass(value),
                _ => format_si(value, dimension),
            },
        )
    };
    let tolerance = item
        .tolerance
        .as_ref()
        .and_then(|tolerance| tolerance.peak_m_s2);
    let name: String = item.item.chars().take(30).collect();
    let is_hidden = item.doubts.contains(&Kind::HiddenRow);
    vec![
        if is_hidden {
            format!("{} (hidden)", item.row)
        } else {
            item.row.to_string()
        },
        item.id.clone(),
        name,
        value(item.level_ratio, Dimension::Ratio),
        value(item.height_m, Dimension::Length),
        value(item.thickness_m, Dimension::Length),
        value(item.width_m, Dimension::Length),
        value(item.mass_kg, Dimension::Mass),
        item.cushion
            .as_ref()
            .map_or_else(|| "-".to_owned(), |edge| cushion_words(&edge.cushion)),
        value(tolerance, Dimension::Acceleration),
    ]
}
