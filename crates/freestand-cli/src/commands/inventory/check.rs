//! `freestand inventory check`: shows how a list was understood.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_app::check_list::{CheckList, HeadingsReport, Meant, SCHEMA};
use freestand_input::keys::KeyStyle;
use freestand_input::problem::Problems;
use freestand_input::words::counted;
use freestand_inventory::{check_report, console_lines, mapping_of_headings, senses};
use freestand_output::folder::write_file;
use freestand_report::list::list_text;
use freestand_report::table::table;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::files::path_text;
use crate::printer::Printer;

/// Read a list of objects and show how it was understood, with all its problems
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/inventory_check.txt").trim_end())]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(super) request: CheckList,
    #[command(flatten)]
    pub(super) output: MappingArgs,
}

/// The mapping file that is written.
#[derive(Debug, Default, Args)]
pub(crate) struct MappingArgs {
    /// Write a mapping file to edit, also where too few headings are known to read the list
    #[arg(long, value_name = "MAP.toml")]
    write_columns: Option<PathBuf>,
}

impl Tell for CheckList {
    type Output = MappingArgs;

    fn tell(
        meant: Meant,
        MappingArgs { write_columns }: &MappingArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &meant.inputs)?;
        let write_columns = write_columns.as_deref();
        if meant.is_headings {
            return headings(&meant, write_columns, files, printer);
        }
        let unread = |problems| unread(&meant, write_columns, problems);
        let (reading, copy) = meant.reading(meant.floors()?, files.wanted(), unread)?;
        if let Some(path) = write_columns {
            write_file(path, reading.mapping_file.as_bytes(), &meant.inputs)?;
        }
        let marked_copy = match &copy {
            Some(bytes) => files.write("checked.xlsx", || bytes)?,
            None => None,
        };
        let report = check_report(&reading, marked_copy, KeyStyle::Flag);
        let inventory = &reading.inventory;
        printer.said(&console_lines(&inventory.findings));
        files.print(printer, SCHEMA, &report, &inventory.warnings, || {
            list_text(&report, inventory, meant.units.unwrap_or(inventory.units))
        })?;
        Ok(Done {
            criterion_met: !inventory.has_errors(),
        })
    }
}

fn headings(
    meant: &Meant,
    write_columns: Option<&Path>,
    files: Files,
    printer: &Printer,
) -> Result<Done, Failure> {
    let headings = meant.headings()?;
    if let Some(path) = write_columns {
        write_file(
            path,
            mapping_of_headings(&headings).as_bytes(),
            &meant.inputs,
        )?;
    }
    let report = HeadingsReport {
        path: path_text(&meant.file),
        headings,
        senses: senses(),
    };
    let lines: Vec<Vec<String>> = report
        .headings
        .iter()
        .map(|one| {
            let name = one.name.unwrap_or("-").to_owned();
            vec![
                one.column.clone(),
                one.heading.clone(),
                name,
                one.samples.join(" | "),
            ]
        })
        .collect();
    files.print(printer, SCHEMA, &report, &[], || {
        table(&["column", "heading", "meaning", "examples"], &lines)
    })?;
    Ok(Done::OK)
}

/// A list that cannot be read, because too few of its headings are known: its mapping file is written all
/// the same, to be completed.
fn unread(meant: &Meant, write_columns: Option<&Path>, problems: Problems) -> Problems {
    let (Some(path), None) = (write_columns, &meant.cells.columns) else {
        return problems;
    };
    let Ok(headings) = meant.headings() else {
        return problems;
    };
    let mapping = mapping_of_headings(&headings);
    if let Err(unwritten) = write_file(path, mapping.as_bytes(), &meant.inputs) {
        return unwritten.into();
    }
    let unknown = headings.iter().filter(|one| one.name.is_none()).count();
    let hint = format!(
        "{} was written: put the names of {} into it, and give it as `columns`",
        path.display(),
        counted(unknown, "heading")
    );
    let problems = problems.into_iter();
    problems.map(|problem| problem.hint(hint.clone())).collect()
}
