//! The checks of the models.

use freestand_input::words::significant;
use freestand_study::validate::Validation;

use crate::table::table;

/// The checks with their numbers.
pub fn validation_text(validation: &Validation) -> String {
    let rows: Vec<Vec<String>> = validation
        .table_one
        .iter()
        .map(|row| {
            vec![
                row.test.to_string(),
                significant(1e3 * row.cg_rise_m, 2),
                significant(row.drop_acceleration_g, 5),
                significant(row.edge_acceleration_g, 4),
                row.published_g.to_string(),
                row.measured_g.to_string(),
                format!("{:+.1}", 100.0 * (row.measured_over_computed_ratio - 1.0)),
                significant(row.compliant_g, 4),
                significant(row.compliant_damped_g, 4),
            ]
        })
        .collect();
    let headings = [
        "test",
        "rise [mm]",
        "a [g]",
        "a_edge [g]",
        "published [g]",
        "measured [g]",
        "measured/computed - 1 [%]",
        "on cushions [g]",
        "5 % damped [g]",
    ];
    let mut text = format!(
        "Table I of Al Abadi et al., g = {} m/s²\n",
        validation.table_one_gravity_m_s2
    );
    text += &table(&headings, &rows);
    let rows: Vec<Vec<String>> = validation
        .checks
        .iter()
        .map(|check| {
            vec![
                if check.ok { "ok" } else { "FAILED" }.to_owned(),
                check.name.clone(),
                significant(check.computed, 8),
                significant(check.expected, 8),
                format!("{:.1e}", check.computed - check.expected),
                format!("{:.1e}", check.tolerance),
            ]
        })
        .collect();
    text += "\n";
    text += &table(
        &[
            "",
            "check",
            "computed",
            "expected",
            "difference",
            "tolerance",
        ],
        &rows,
    );
    text + &format!(
        "\n{} of {} checks passed\n",
        validation.checks.iter().filter(|check| check.ok).count(),
        validation.checks.len()
    )
}
