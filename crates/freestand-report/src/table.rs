//! Tables and lists for people, in plain text.

use comfy_table::{Cell, CellAlignment, Table, presets};
use freestand_input::words::significant;
use freestand_output::facts::Facts;
use freestand_study::recorded::Failed;

/// A table for people: a line of headings, then rows; columns of numbers are aligned to the right.
pub fn table(headings: &[&str], rows: &[Vec<String>]) -> String {
    let numeric = |column: usize| {
        rows.iter()
            .filter_map(|row| row.get(column))
            .all(|text| text == "-" || text.parse::<f64>().is_ok())
    };
    let right: Vec<bool> = (0..headings.len())
        .map(|column| !rows.is_empty() && numeric(column))
        .collect();
    let cell = |column: usize, text: &str| {
        let right = right.get(column).copied().unwrap_or(false);
        // A cell of somebody's workbook must neither break a row nor tell a terminal what to do.
        Cell::new(text.replace(char::is_control, " ")).set_alignment(if right {
            CellAlignment::Right
        } else {
            CellAlignment::Left
        })
    };
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_header(
        headings
            .iter()
            .enumerate()
            .map(|(column, heading)| cell(column, heading)),
    );
    for row in rows {
        table.add_row(
            row.iter()
                .enumerate()
                .map(|(column, text)| cell(column, text)),
        );
    }
    // Cells are padded with a blank on both sides; remove the first one.
    table
        .lines()
        .map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(&line).trim_end()))
        .collect()
}

/// Names and values in two columns.
pub fn pairs(rows: &[(&str, String)]) -> String {
    let width = rows
        .iter()
        .map(|(name, _)| name.chars().count())
        .max()
        .unwrap_or(0);
    rows.iter()
        .map(|(name, value)| {
            format!(
                "{name}{}  {value}\n",
                " ".repeat(width - name.chars().count())
            )
        })
        .collect()
}

/// Labels and values of a result in two columns.
pub fn lines(facts: &Facts) -> String {
    pairs(&facts.lines())
}

/// A column of a table of results: the name of a fact, a heading that states the unit in brackets,
/// and the digits of a number.
pub type Column = (&'static str, &'static str, usize);

/// Results as rows of a table.
pub fn facts_table<'a>(rows: impl IntoIterator<Item = Facts<'a>>, columns: &[Column]) -> String {
    table(
        &headings(columns),
        &rows
            .into_iter()
            .map(|row| cells(&row, columns))
            .collect::<Vec<_>>(),
    )
}

/// The headings of columns.
pub fn headings(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|(_, heading, _)| *heading).collect()
}

/// A row of a table.
pub fn cells(row: &Facts, columns: &[Column]) -> Vec<String> {
    columns
        .iter()
        .map(|(name, heading, digits)| row.cell(name, in_brackets(heading), *digits))
        .collect()
}

/// The files that failed, one line for each.
pub fn failed_lines(failed: &[Failed]) -> String {
    failed
        .iter()
        .map(|one| format!("failed: {}: {}\n", one.path, one.reason))
        .collect()
}

/// The unit in a heading: `N/mm` in `stiffness [N/mm]`.
fn in_brackets(heading: &str) -> &str {
    heading
        .split_once('[')
        .and_then(|(_, rest)| rest.split_once(']'))
        .map_or("", |(unit, _)| unit)
}

/// Significant digits and a unit, or `-` for a value that is missing.
pub fn optional(value: Option<f64>, digits: usize, unit: &str) -> String {
    value.map_or_else(
        || "-".to_owned(),
        |value| {
            format!("{} {unit}", significant(value, digits))
                .trim_end()
                .to_owned()
        },
    )
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_cell_has_no_control_characters() {
        let text = super::table(&["id"], &[vec!["a\u{1b}[2J\nb".to_owned()]]);
        assert_eq!(text, "id\na [2J b\n");
    }
}
