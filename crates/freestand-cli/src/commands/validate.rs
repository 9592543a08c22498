//! `freestand validate`: Table I of the paper and the closed forms.

use clap::Args;
use freestand_app::validate::{SCHEMA, Validate};
use freestand_inventory::validate::validate;
use freestand_report::validation::validation_text;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Check the models against Table I of the paper and all built-in closed forms
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/validate.txt").trim_end())]
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
            validation_text(&validation)
        })?;
        Ok(Done {
            criterion_met: validation.ok(),
        })
    }
}
