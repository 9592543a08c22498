//! `freestand shock`: one landing.

use clap::Args;
use freestand_app::shock::{Meant, SCHEMA, Shock};
use freestand_output::answer::Answer;
use freestand_study::shock::{Verdict, shock};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, lines};

/// Calculate the shock of one landing: acceleration of the edge, pulse, ceiling and verdict
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  Test 1 of Table I in the paper, a cabinet released at a rise of its centre of gravity of 16 mm:
    freestand shock --height \"2.3 m\" --thickness \"600 mm\" --mass \"140 kg\" \\
      --stiffness \"4380 N/mm\" --cg-rise \"16 mm\"
  Two pads under each edge, and an object that withstands 5 g:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg --pad-stiffness \"2190 N/mm\" \\
      --pads-per-edge 2 --uplift \"30 mm\" --tolerance 5g
  The same on pads that a laboratory tested, under legs of 9000 N/mm:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg --cushion cushion.toml \\
      --pads-per-edge 2 --series-stiffness \"9000 N/mm\" --uplift \"30 mm\"
  A verdict from shock tests of the object (ASTM D3332), in a file with the columns
  velocity change [m/s],peak acceleration [g],damaged,method:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg --stiffness \"4380 N/mm\" \\
      --uplift \"30 mm\" --damage-boundary tests.csv --out shock
  The object falls over onto the floor:
    freestand shock --height 2.3m --thickness 0.6m --mass 140kg \\
      --scenario overturn-floor --contact-stiffness \"2000 N/mm\"")]
pub(crate) struct ShockArgs {
    #[command(flatten)]
    pub(super) request: Shock,
}

impl Tell for Shock {
    type Output = ();

    fn tell(
        meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &meant.inputs)?;
        let report = shock(&meant.landing)?;
        if let Some(boundary) = report.damage_boundary {
            let tests = meant.landing.boundary_tests.as_ref();
            files.figure("damage-boundary", || boundary.figure(tests))?;
        }
        let answer = &report.answer;
        files.print(printer, SCHEMA, answer, &report.warnings, || {
            lines(&answer.facts())
        })?;
        Ok(Done {
            criterion_met: report.verdict != Verdict::Exceeded,
        })
    }
}
