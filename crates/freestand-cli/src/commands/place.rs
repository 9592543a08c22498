//! `freestand place`: the places whose hazard is known.

use clap::{Args, Subcommand};
use freestand_app::places::{Found, PlaceList, PlaceShow, SCHEMA};
use freestand_input::words::counted;
use freestand_study::places::{Confidence, Place};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};

/// Show the places whose seismic hazard is built in, each with its source
///
/// Commands take them by name: --place Wellington, or place = "Wellington" in [ground] of a study.
/// A value that is approximate was recalled and not read: confirm it before you rely on it.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand place list
  freestand place list \"new zealand\" --json
  freestand place show wellington
  freestand run --place \"Los Angeles\" --site C --out results")]
pub(crate) struct PlaceArgs {
    #[command(subcommand)]
    command: PlaceCommand,
}

#[derive(Debug, Subcommand)]
enum PlaceCommand {
    /// List all places, or those of a country or a code
    #[command(after_help = "\
Examples:
  freestand place list
  freestand place list greece
  freestand place list asce7 --json")]
    List {
        #[command(flatten)]
        request: PlaceList,
    },
    /// Show one place with its values and their source
    #[command(after_help = "\
Examples:
  freestand place show melbourne
  freestand place show \"Salt Lake City\" --json")]
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
        found: Vec<&'static Place>,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        print(found, &[], list, (global, printer))
    }
}

impl Tell for PlaceShow {
    type Output = ();

    fn tell(
        place: &'static Place,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let doubts: Vec<String> = place.doubt().into_iter().collect();
        print(vec![place], &doubts, |_| one(place), (global, printer))
    }
}

fn print(
    found: Vec<&'static Place>,
    warnings: &[String],
    text: impl FnOnce(&[&'static Place]) -> String,
    (global, printer): (&GlobalArgs, &Printer),
) -> Result<Done, Failure> {
    let found = Found(found);
    let files = Files::begin(global, &[])?;
    files.print(printer, SCHEMA, &found, warnings, || text(&found.0))?;
    Ok(Done::OK)
}

fn list(found: &[&Place]) -> String {
    let row = |place: &&Place| {
        let (code, values) = (place.hazard.code_title().to_owned(), place.hazard.words());
        vec![
            place.name.to_owned(),
            place.whereabouts(),
            code,
            values,
            place.confidence.name().to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = found.iter().map(row).collect();
    let mut text = table(&["place", "in", "code", "hazard", "confidence"], &rows);
    text.push_str(&format!("\n{}", counted(found.len(), "place")));
    let approximate = found
        .iter()
        .filter(|place| place.confidence == Confidence::Approximate)
        .count();
    if approximate > 0 {
        text.push_str(&format!(
            "; {approximate} approximate: confirm those values before you rely on them"
        ));
    }
    text.push('\n');
    text
}

fn one(place: &Place) -> String {
    let rows = [
        ("place", place.name.to_owned()),
        ("in", place.whereabouts()),
        (
            "code",
            format!("{} ({})", place.hazard.code_title(), place.hazard.code()),
        ),
        ("hazard", place.hazard.words()),
        ("source", place.source.to_owned()),
        ("confidence", place.confidence.name().to_owned()),
    ];
    pairs(&rows)
}
