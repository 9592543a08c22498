//! `freestand restrain`: how strongly one object must be held.

use clap::Args;
use freestand_app::restrain::{Asked, Meant, Restrain, SCHEMA};
use freestand_assess::restrain::{
    RestrainListReport, RestrainReport, ToConfirm, restrain, restrain_list,
};
use freestand_input::keys::KeyStyle;
use freestand_output::answer::Answer as _;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, lines, table};

/// Calculate the force that the code asks a restraint to carry, and its anchors, on one sheet
///
/// The clause for parts of the place's code gives the force; the factors that are not stated are
/// assumed, and every one is printed with who says so. The formulas are those of `assess`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A cabinet on the third floor of six, in Los Angeles, in US units:
    freestand restrain --mass 800lb --height 6ft --thickness 24in --width 36in \\
      --component cabinet --anchor-inset 3in --place \"Los Angeles\" --floor 3 \\
      --storeys 6 --storey-height 13ft
  The same on the roof in Wellington, with a sheet to print and other codes beside it:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --width 0.9m \\
      --place Wellington --level-ratio 1 --compare --out restraint
  By the values of a code:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --code asce7 --edition 2022 \\
      --sds \"1 g\" --level-ratio 0.5 --importance 1.5 --strength 1.5
  For an object of a study, as assess has it:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --study hospital.toml --floor 2
  For every object of a list:
    freestand restrain objects.csv --place Wellington --storeys 5 --out restraint
  By an acceleration of the floor that somebody else has calculated, F = m a:
    freestand restrain --mass 360kg --height 1.8m --thickness 0.6m --floor-acceleration \"0.9 g\"")]
pub(crate) struct RestrainArgs {
    #[command(flatten)]
    pub(super) request: Restrain,
}

const SHEET: &str = "restraint.html";

impl Tell for Restrain {
    type Output = ();

    fn tell(
        mut meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let inputs = std::mem::take(&mut meant.inputs);
        match meant.asked()? {
            Asked::One(one) => {
                let mut report = restrain(one)?;
                let files = Files::begin(global, &inputs)?;
                report.sheet_path = files.write(SHEET, || &report.sheet)?;
                files.print(printer, SCHEMA, &report, &report.warnings, || text(&report))?;
            }
            Asked::List(list) => {
                let report = restrain_list(&list)?;
                let files = Files::begin(global, &inputs)?;
                files.table("restraint", || report.table())?;
                files.print(printer, SCHEMA, &report, &report.warnings, || {
                    list_text(&report)
                })?;
            }
        }
        Ok(Done::OK)
    }
}

fn list_text(report: &RestrainListReport) -> String {
    let headings = [
        "row",
        "object",
        "force",
        "force/weight",
        "tension of an edge",
        "in concrete",
    ];
    let cells = |row: &[String; 6]| row.each_ref().map(|cell| KeyStyle::Flag.shown(cell));
    let rows: Vec<Vec<String>> = report.lines.iter().map(|row| cells(row).to_vec()).collect();
    let mut text = table(&headings, &rows);
    text.push_str(&format!(
        "\n{} of {} objects have a force\n",
        report.held,
        report.lines.len()
    ));
    text.push_str(&open_text(&report.to_confirm, &report.assumptions));
    for problem in &report.problems {
        text.push_str(&format!("in the list: {}\n", KeyStyle::Flag.shown(problem)));
    }
    text
}

/// What an engineer must confirm, and what was assumed.
fn open_text(to_confirm: &[ToConfirm], assumptions: &[String]) -> String {
    let confirm = |open: &ToConfirm| {
        let value = if open.value.is_empty() {
            String::new()
        } else {
            format!(" (used: {})", open.value)
        };
        format!("an engineer must confirm: {}{value}\n", open.what)
    };
    let mut text = String::new();
    if !to_confirm.is_empty() {
        text.push('\n');
        text.extend(to_confirm.iter().map(confirm));
    }
    if !assumptions.is_empty() {
        text.push('\n');
        text.extend(
            assumptions
                .iter()
                .map(|assumption| format!("assumed: {}\n", KeyStyle::Flag.shown(assumption))),
        );
    }
    text
}

fn text(report: &RestrainReport) -> String {
    let mut text = format!("{}\n\n{}\n", report.answer, lines(&report.facts()));
    let rows: Vec<Vec<String>> = report.factors.iter().map(|row| row.to_vec()).collect();
    text.push_str(&table(&["factor", "value", "who says so"], &rows));
    if !report.others.is_empty() {
        let headings = [
            "for comparison",
            "force",
            "force/weight",
            "tension of an edge",
            "in concrete",
        ];
        let rows: Vec<Vec<String>> = report.others.iter().map(|row| row.to_vec()).collect();
        text.push('\n');
        text.push_str(&table(&headings, &rows));
    }
    text.push_str(&open_text(&report.to_confirm, &report.assumptions));
    if let Some(path) = &report.sheet_path {
        text.push_str(&format!("\nto print: {path}\n"));
    }
    text
}
