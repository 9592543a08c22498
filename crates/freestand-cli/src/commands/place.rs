//! `freestand place`: the places whose hazard is known.

use clap::{Args, Subcommand};
use freestand_app::places::{Found, PlaceList, PlaceShow, SCHEMA};
use freestand_report::doubts::place_doubt;
use freestand_report::place::{place_text, places_text};
use freestand_study::places::Place;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Show the places whose seismic hazard is built in, each with its source
///
/// Commands take them by name: --place Wellington, or place = "Wellington" in [ground] of a study.
/// A value that is approximate was recalled and not read: confirm it before you rely on it.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/place.txt").trim_end())]
pub(crate) struct PlaceArgs {
    #[command(subcommand)]
    command: PlaceCommand,
}

#[derive(Debug, Subcommand)]
enum PlaceCommand {
    /// List all places, or those of a country or a code
    #[command(after_help = include_str!("../help/place_list.txt").trim_end())]
    List {
        #[command(flatten)]
        request: PlaceList,
    },
    /// Show one place with its values and their source
    #[command(after_help = include_str!("../help/place_show.txt").trim_end())]
    Show {
        #[command(flatten)]
        request: PlaceShow,
    },
}

pub(crate) fn run(
    args: &PlaceArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        PlaceCommand::List { request } => request.run(&(), global, printer),
        PlaceCommand::Show { request } => request.run(&(), global, printer),
    }
}

impl Tell for PlaceList {
    type Output = ();

    fn tell(
        found: Vec<Place>,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        print(found, &[], places_text, (global, printer))
    }
}

impl Tell for PlaceShow {
    type Output = ();

    fn tell(
        place: Place,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let doubt = place.doubt();
        let doubts: Vec<String> = doubt.iter().map(place_doubt).collect();
        print(
            vec![place],
            &doubts,
            |found| found.iter().map(place_text).collect(),
            (global, printer),
        )
    }
}

fn print(
    found: Vec<Place>,
    warnings: &[String],
    text: impl FnOnce(&[Place]) -> String,
    (global, printer): (&GlobalArgs, &Printer),
) -> Result<Done, Failure> {
    let found = Found(found);
    let files = Files::begin(global, &[])?;
    files.print(printer, SCHEMA, &found, warnings, || text(&found.0))?;
    Ok(Done::OK)
}
