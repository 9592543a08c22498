//! `freestand inventory`: the objects of a building as a spreadsheet.

mod check;
mod convert;
mod template;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use freestand_app::check_list::SCHEMA;
use freestand_app::inventory::FORMATS;
use freestand_input::words::name_of;
use freestand_inventory::Target;
use freestand_output::folder::write_file;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::files::path_text;
use crate::printer::Printer;

/// Create, check and convert inventories of objects
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/inventory.txt").trim_end())]
pub(crate) struct InventoryArgs {
    #[command(subcommand)]
    command: InventoryCommand,
}

#[derive(Debug, Subcommand)]
enum InventoryCommand {
    Template(template::TemplateArgs),
    Check(Box<check::CheckArgs>),
    Convert(convert::ConvertArgs),
}

pub(crate) fn run(
    args: &InventoryArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        InventoryCommand::Template(args) => args.request.run(&args.output, global, printer),
        InventoryCommand::Check(args) => args.request.run(&args.output, global, printer),
        InventoryCommand::Convert(args) => args.request.run(&args.output, global, printer),
    }
}

/// The format that the name of a file implies.
fn format_of(path: &Path) -> Option<Target> {
    let extension = path.extension()?.to_str()?;
    let known = FORMATS.iter();
    known
        .filter(|(_, name, _)| name.eq_ignore_ascii_case(extension))
        .map(|(format, ..)| *format)
        .next()
}

/// Where an inventory was written: a named file, a file in `--out`, or nowhere, so that its text is
/// printed.
struct Placed {
    path: Option<String>,
    text: Option<String>,
}

/// Writes an inventory; a workbook is never printed.
fn place(
    bytes: &[u8],
    format: Target,
    file: Option<&Path>,
    files: &Files,
    inputs: &[PathBuf],
) -> Result<Placed, Failure> {
    if let Some(file) = file {
        write_file(file, bytes, inputs)?;
        return Ok(Placed {
            path: Some(path_text(file)),
            text: None,
        });
    }
    let path = files.write(&format!("inventory.{}", name_of(FORMATS, format)), || bytes)?;
    let text = path
        .is_none()
        .then(|| String::from_utf8_lossy(bytes).into_owned());
    Ok(Placed { path, text })
}

/// Refuses a workbook without a file to write to, a file given together with `--out`, one that is named as another
/// format, and, without `--force`, one that exists: it may be a list that somebody filled in.
fn check_place(
    format: Target,
    file: Option<&Path>,
    global: &GlobalArgs,
    inputs: &[PathBuf],
) -> Result<(), Failure> {
    match (file, &global.out) {
        (Some(file), None) if format_of(file).is_some_and(|named| named != format) => {
            let name = name_of(FORMATS, format);
            Err(Failure::usage(
                format!(
                    "{} does not end in .{name}, the format that is written",
                    file.display()
                ),
                format!("give a name that ends in .{name}"),
            ))
        }
        // What is read is never replaced; that is said when the file is written.
        (Some(file), None)
            if file.is_file() && !global.force && !inputs.iter().any(|input| input == file) =>
        {
            Err(Failure::usage(
                format!("{} exists", file.display()),
                "give another name, or replace the file with --force",
            ))
        }
        (Some(file), Some(_)) => {
            let message = format!("both {} and --out are given", file.display());
            Err(Failure::usage(
                message,
                "give either the file or the folder",
            ))
        }
        (None, None) if format == Target::Xlsx => Err(Failure::usage(
            "a workbook cannot be printed",
            "give a file, such as objects.xlsx, or a folder with --out",
        )),
        _ => Ok(()),
    }
}

/// What is printed: the text, or the path of the file.
fn shown(text: &Option<String>, path: &Option<String>) -> String {
    match (text, path) {
        (Some(text), _) => text.clone(),
        (None, Some(path)) => format!("{path}\n"),
        (None, None) => String::new(),
    }
}
