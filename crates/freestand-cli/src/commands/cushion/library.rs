//! `freestand cushion list|show|search`: what pads, feet and floors are likely to be.

use std::path::Path;

use clap::Args;
use freestand_assess::library::{CushionEntry, CushionLibrary};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;
use serde::Serialize;

use super::Done;
use crate::args::GlobalArgs;
use crate::commands::tolerance::LibraryArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};

/// The cushion library: typical stiffness of pads, feet and floor coverings, as ranges
///
/// These are estimates for objects without a test, not measurements: the range of one pad or foot,
/// and its geometric mean. The column cushion of an inventory names an entry, or several layers
/// such as "rubber-foot + carpet-underlay".
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion list
  freestand cushion list --library ours.csv --json

Columns of a library:
  id, item, stiffness_low [N/mm], stiffness_high [N/mm], thickness [mm], pads_per_edge, source,
  edition, clause, page, confidence (stated, primary, secondary, assumption, recalled), note")]
pub(crate) struct ListArgs {
    #[command(flatten)]
    library: LibraryArgs,
}

/// One entry of the cushion library with all its fields
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion show rubber-foot
  freestand cushion show rubber-foot --json")]
pub(crate) struct ShowArgs {
    /// Id of the entry
    #[arg(value_name = "ID")]
    id: String,
    #[command(flatten)]
    library: LibraryArgs,
}

/// Entries of the cushion library that contain all of these words
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion search rubber
  freestand cushion search rubber foot --library ours.csv")]
pub(crate) struct SearchArgs {
    /// Words to find in id, item, source or note
    #[arg(value_name = "WORD", required = true)]
    words: Vec<String>,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Debug, Serialize)]
struct Listed<'a> {
    entries: &'a [&'a CushionEntry],
}

fn library(path: Option<&Path>) -> Result<CushionLibrary, Failure> {
    Ok(match path {
        Some(path) => CushionLibrary::with_file(path)?,
        None => CushionLibrary::builtin(),
    })
}

pub(crate) fn list(args: &ListArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let library = library(args.library.library.as_deref())?;
    print(&args.library, &library, &library.entries().iter().collect::<Vec<_>>(), listed, (global, printer))
}

pub(crate) fn show(args: &ShowArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let library = library(args.library.library.as_deref())?;
    print(&args.library, &library, &[library.get(&args.id)?], shown, (global, printer))
}

pub(crate) fn search(args: &SearchArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let library = library(args.library.library.as_deref())?;
    print(&args.library, &library, &library.search(&args.words), listed, (global, printer))
}

fn print(
    from: &LibraryArgs,
    library: &CushionLibrary,
    entries: &[&CushionEntry],
    text: fn(&[&CushionEntry]) -> String,
    (global, printer): (&GlobalArgs, &Printer),
) -> Result<Done, Failure> {
    let files = Files::begin(global, from.library.as_slice())?;
    let body = Listed { entries };
    files.print(printer, "freestand.cushion-library/1", &body, &library.warnings, || text(entries))?;
    Ok(Done::OK)
}

fn listed(entries: &[&CushionEntry]) -> String {
    if entries.is_empty() {
        return "nothing has all of these words\n".to_owned();
    }
    let row = |entry: &&CushionEntry| {
        vec![
            entry.id.clone(),
            entry.range_words(),
            mean(entry),
            entry.confidence.name().to_owned(),
            entry.item.clone(),
            entry.source_words(),
        ]
    };
    let headings = ["id", "range of one", "mean", "confidence", "item", "source"];
    let rows: Vec<_> = entries.iter().map(row).collect();
    table(&headings, &rows) + &format!("{} entries; priors, none of them a measurement\n", entries.len())
}

/// Of a range that wide three digits are plenty.
fn mean(entry: &CushionEntry) -> String {
    format!("{} N/mm", number(entry.stiffness_n_m / 1e3, 3))
}

fn shown(entries: &[&CushionEntry]) -> String {
    entries.iter().map(|entry| one(entry)).collect()
}

fn one(entry: &CushionEntry) -> String {
    let text = |text: &str| Some(text.to_owned()).filter(|text| !text.is_empty());
    let rows = [
        ("id", text(&entry.id)),
        ("item", text(&entry.item)),
        ("range of one", Some(entry.range_words())),
        ("geometric mean", Some(mean(entry))),
        ("scatter of ln k", Some(format!("{} (the range is read as 16 to 84 %)", number(entry.log_sd, 3)))),
        ("thickness", entry.thickness_m.map(|t| format_si(t, Dimension::Length))),
        ("pads per edge", Some(format!("{} where nothing else is said", entry.pads_per_edge))),
        ("source", text(&entry.source)),
        ("edition", text(&entry.edition)),
        ("clause", text(&entry.clause)),
        ("page", text(&entry.page)),
        ("confidence", Some(format!("{}: {}", entry.confidence.name(), entry.confidence.description()))),
        ("use", text("a prior, not a measurement: a drop test tells more")),
        ("note", text(&entry.note)),
        ("origin", text(&entry.origin)),
    ];
    pairs(&rows.into_iter().filter_map(|(name, value)| Some((name, value?))).collect::<Vec<_>>())
}
