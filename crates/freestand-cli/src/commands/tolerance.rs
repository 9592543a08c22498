//! `freestand tolerance`: what objects withstand, each number with its source.

use clap::{Args, Subcommand};
use freestand_app::library::{List, Search, Show, Tolerances};
use freestand_inventory::library::ToleranceEntry;
use freestand_report::library::{Layout, TOLERANCES};

use super::library::Printed;
use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// Show the tolerance library: what objects withstand, each number with its source
///
/// A recalled entry (without a source that has a page or a clause) may be shown but never decides a
/// verdict. A fragility is the median of the floor motion at which such objects fail, and never a
/// tolerance. Your own library, --library FILE.csv with the same columns, adds entries and replaces
/// those with the same id.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/tolerance.txt").trim_end())]
pub(crate) struct ToleranceArgs {
    #[command(subcommand)]
    command: ToleranceCommand,
}

#[derive(Debug, Subcommand)]
enum ToleranceCommand {
    /// List all entries
    #[command(
        after_help = include_str!("../help/tolerance_list.txt").trim_end()
    )]
    List {
        #[command(flatten)]
        request: List<Tolerances>,
    },
    /// Show one entry with all its fields and its notice
    #[command(after_help = include_str!("../help/tolerance_show.txt").trim_end())]
    Show {
        #[command(flatten)]
        request: Show<Tolerances>,
    },
    /// List entries that contain all of these words in id, class, kind, state, source, clause or
    /// note
    #[command(after_help = include_str!("../help/tolerance_search.txt").trim_end())]
    Search {
        #[command(flatten)]
        request: Search<Tolerances>,
    },
}

impl Printed for Tolerances {
    const LAYOUT: Layout<ToleranceEntry> = TOLERANCES;
}

pub(crate) fn run(
    args: &ToleranceArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        ToleranceCommand::List { request } => request.run(&(), global, printer),
        ToleranceCommand::Show { request } => request.run(&(), global, printer),
        ToleranceCommand::Search { request } => request.run(&(), global, printer),
    }
}
