//! `freestand cushion list|show|search`: likely stiffnesses of pads, feet and floors.

use clap::Args;
use freestand_assess::library::{CushionEntry, CushionLibrary};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{counted, number};
use serde::Serialize;

use super::Done;
use crate::args::GlobalArgs;
use crate::commands::tolerance::LibraryArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};

/// List the cushion library: likely stiffnesses of pads, feet and floors, as ranges
///
/// These are estimates for use without a test, never measurements: the range for one pad or foot,
/// and its geometric mean. An inventory names an entry in its column cushion, or layers in series
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

/// Show one entry of the cushion library with all its fields
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

/// List entries of the cushion library that contain all of these words
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion search rubber
  freestand cushion search rubber foot")]
pub(crate) struct SearchArgs {
    /// Words in id, item, source or note
    #[arg(value_name = "WORD", required = true)]
    words: Vec<String>,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Debug, Serialize)]
struct Listed<'a> {
    entries: &'a [&'a CushionEntry],
}

fn library(args: &LibraryArgs) -> Result<CushionLibrary, Failure> {
    Ok(CushionLibrary::builtin().with_file(args.library.as_deref())?)
}

pub(crate) fn list(args: &ListArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let library = library(&args.library)?;
    print(&args.library, &library, &library.entries().iter().collect::<Vec<_>>(), listed, (global, printer))
}

pub(crate) fn show(args: &ShowArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let library = library(&args.library)?;
    print(&args.library, &library, &[library.get(&args.id)?], shown, (global, printer))
}

pub(crate) fn search(args: &SearchArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let library = library(&args.library)?;
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
        return "no entry contains all of these words\n".to_owned();
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
    let headings = ["id", "range for one", "mean", "confidence", "item", "source"];
    let rows: Vec<_> = entries.iter().map(row).collect();
    let count = counted(rows.len(), "entry");
    table(&headings, &rows) + &format!("{count}; estimates, not measurements\n")
}

/// For so wide a range three digits are enough.
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
        ("range for one", Some(entry.range_words())),
        ("geometric mean", Some(mean(entry))),
        ("scatter of ln k", Some(format!("{} (the range is taken as 16 to 84 %)", number(entry.log_sd, 3)))),
        ("thickness", entry.thickness_m.map(|t| format_si(t, Dimension::Length))),
        ("pads per edge", Some(format!("{} unless the inventory gives another number", entry.pads_per_edge))),
        ("source", text(&entry.source)),
        ("edition", text(&entry.edition)),
        ("clause", text(&entry.clause)),
        ("page", text(&entry.page)),
        ("confidence", Some(format!("{}: {}", entry.confidence.name(), entry.confidence.description()))),
        ("use", text("an estimate, not a measurement: a drop test is better")),
        ("note", text(&entry.note)),
        ("origin", text(&entry.origin)),
    ];
    pairs(&rows.into_iter().filter_map(|(name, value)| Some((name, value?))).collect::<Vec<_>>())
}
