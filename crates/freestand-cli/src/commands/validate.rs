//! `freestand validate`: Table I of the paper and the closed forms.

use clap::Args;
use freestand_app::validate::{SCHEMA, Validate};
use freestand_inventory::validate::validate;
use freestand_study::validate::Validation;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};

/// Check the models against Table I of the paper and all built-in closed forms
#[derive(Debug, Args)]
#[command(after_help = "\
The exit status is 1 if a check fails.

Examples:
  freestand validate
  freestand validate --json")]
pub(crate) struct ValidateArgs {
    #[command(flatten)]
    pub(super) request: Validate,
}

impl Tell for Validate {
    type Output = ();

    fn tell((): (), (): &(), global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
        let files = Files::begin(global, &[])?;
        let validation = validate()?;
        let failed = validation.checks.iter().filter(|check| !check.ok).count();
        let mut warnings = Vec::new();
        if failed > 0 {
            let all = validation.checks.len();
            warnings.push(format!("{failed} of {all} checks failed"));
        }
        files.print(printer, SCHEMA, &validation, &warnings, || {
            text(&validation)
        })?;
        Ok(Done {
            criterion_met: validation.ok(),
        })
    }
}

fn text(validation: &Validation) -> String {
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
