//! An inventory to fill in: headings with units, rows marked as examples, and the meaning of each
//! column.

use rust_xlsxwriter::{Workbook, XlsxError};

use freestand_input::problem::Problem;

use super::columns::{COLUMNS, Column, ColumnSpec, Holds};
use super::write::{self, Table, Written, csv, xlsx};

/// The beginning of the ids of the example rows.
pub(super) const EXAMPLE: &str = "example-";

/// The example rows, from a hospital, by column.
const EXAMPLES: [&[(Column, &str)]; 3] = [
    &[
        (Column::Id, "example-1"),
        (Column::Item, "EXAMPLE, delete this row: instrument cabinet"),
        (Column::Quantity, "2"),
        (Column::Priority, "1"),
        (Column::Location, "operating theatre"),
        (Column::Building, "Block A"),
        (Column::Floor, "Level 3"),
        (Column::Room, "3.12"),
        (Column::LifeSafety, "H"),
        (Column::Property, "M"),
        (Column::Function, "M"),
        (Column::LevelRatio, "0.5"),
        (Column::Height, "1800"),
        (Column::Thickness, "450"),
        (Column::Width, "900"),
        (Column::Mass, "140"),
        (Column::PadStiffness, "2190"),
        (Column::PadsPerEdge, "2"),
        (Column::PadThickness, "10"),
        (Column::Tolerance, "15"),
        (Column::ToleranceDuration, "11"),
        (Column::Friction, "0.3-0.5"),
        (Column::Notes, "four feet, two under each edge"),
    ],
    &[
        (Column::Id, "example-2"),
        (Column::Item, "EXAMPLE, delete this row: monitoring rack"),
        (Column::Quantity, "1"),
        (Column::Location, "nurses' station"),
        (Column::Building, "Block A"),
        (Column::Floor, "Level 5"),
        (Column::LifeSafety, "M"),
        (Column::Property, "M"),
        (Column::Function, "H"),
        (Column::LevelRatio, "0.8"),
        (Column::Height, "2000"),
        (Column::Thickness, "600"),
        (Column::Width, "800"),
        (Column::BaseThickness, "540"),
        (Column::CgHeight, "850"),
        (Column::Mass, "310"),
        (Column::Stiffness, "4380"),
        (Column::Tolerance, "5"),
        (Column::ToleranceDuration, "11"),
        (Column::ToleranceEdgeLift, "50"),
        (Column::Accepted, "0.05"),
        (
            Column::Notes,
            "stiffness of everything under one edge, from a drop test",
        ),
    ],
    &[
        (Column::Id, "example-3"),
        (Column::Item, "EXAMPLE, delete this row: gas cylinder"),
        (Column::Quantity, "6"),
        (Column::Building, "Block A"),
        (Column::Floor, "Basement"),
        (Column::LifeSafety, "H"),
        (Column::Property, "L"),
        (Column::Function, "L"),
        (Column::LevelRatio, "0"),
        (Column::Height, "1500"),
        (Column::Thickness, "230"),
        (
            Column::Notes,
            "without mass, cushion or tolerance, only overturning is assessed",
        ),
    ],
];

/// The heading of a column, with its unit.
fn heading(spec: &ColumnSpec) -> String {
    if spec.unit.is_empty() {
        spec.name.to_owned()
    } else {
        format!("{} [{}]", spec.name, spec.unit)
    }
}

/// The columns of the template.
fn columns() -> impl Iterator<Item = &'static ColumnSpec> {
    COLUMNS.iter().filter(|spec| spec.is_in_template)
}

fn table() -> Table {
    let row = |example: &&[(Column, &str)]| {
        let cell = |spec: &ColumnSpec| {
            let text = example
                .iter()
                .find(|(column, _)| *column == spec.column)
                .map_or("", |(_, text)| text);
            Written::of(
                text,
                !matches!(
                    spec.holds,
                    Holds::Text | Holds::Rating | Holds::Range | Holds::Answer | Holds::Casters
                ),
            )
        };
        columns().map(cell).collect()
    };
    Table {
        headings: columns().map(heading).collect(),
        rows: EXAMPLES.iter().map(row).collect(),
    }
}

/// The template as CSV.
///
/// # Errors
/// None that a user can cause.
pub fn template_csv() -> Result<Vec<u8>, Problem> {
    csv(&table())
}

/// The template as a workbook, with a second sheet that explains the columns. Always the same
/// bytes.
///
/// # Errors
/// None that a user can cause.
pub fn template_xlsx() -> Result<Vec<u8>, Problem> {
    xlsx(&table(), explain)
}

/// The sheet with the meaning of each column.
fn explain(workbook: &mut Workbook) -> Result<(), XlsxError> {
    let sheet = workbook.add_worksheet().set_name("Columns")?;
    let headings = [
        ("Column", 26),
        ("Unit", 8),
        ("Required", 10),
        ("Cells", 28),
        ("Meaning", 70),
        ("Example", 18),
    ];
    let row = |spec: &ColumnSpec| {
        let required = if spec.is_required { "yes" } else { "" };
        let (meaning, example) = (spec.meaning, spec.example);
        [
            spec.name,
            spec.unit,
            required,
            cells(spec),
            meaning,
            example,
        ]
        .map(str::to_owned)
    };
    write::explain(sheet, headings, columns().map(row))?;
    let notes = [
        "The columns may be in any order. Columns that stay empty may be removed; other columns may be added \
         and are carried through.",
        "Units may be changed: height [m], mass [t], stiffness [kN/m] … Under a heading without a unit, each cell \
         has its own, such as 2.3 m.",
        "Leave a cell empty if its value is not known. The object may then have no verdict, but the file is still \
         read.",
    ];
    let first = columns().count() as u32 + 2;
    for (row, text) in (first..).zip(notes) {
        sheet.write_string(row, 0, text)?;
    }
    Ok(())
}

/// What the cells of a column hold, in words.
fn cells(spec: &ColumnSpec) -> &'static str {
    match (spec.column, spec.holds) {
        (_, Holds::Text) => "text",
        (_, Holds::Count) => "a whole number, at least 1",
        (_, Holds::Rating) => "H, M or L",
        (_, Holds::Answer) => "yes or no",
        (_, Holds::Casters) => "no, free or braked",
        (_, Holds::Sizes) => "height, width and depth",
        (_, Holds::Range) => "one value, or a range such as 0.3-0.5",
        (Column::Accepted, _) => "between 0 and 1, or 10 %",
        (Column::LevelRatio, _) => "from 0 to 1, or 50 %",
        (_, Holds::Quantity(_)) if spec.unit.is_empty() => "a ratio",
        (_, Holds::Quantity(_)) => "a number, in the unit of the heading",
    }
}
