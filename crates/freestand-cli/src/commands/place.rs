//! `freestand place`: the places whose hazard is known.

use clap::{Args, Subcommand};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::counted;
use freestand_output::facts::Facts;
use freestand_study::places::{Confidence, Place, near, places};

use super::Done;
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
        /// Country or code, such as greece or asce7
        #[arg(value_name = "WORD")]
        of: Option<String>,
    },
    /// Show one place with its values and their source
    #[command(after_help = "\
Examples:
  freestand place show melbourne
  freestand place show \"Salt Lake City\" --json")]
    Show {
        /// Name of the place
        #[arg(value_name = "NAME")]
        name: String,
    },
}

const SCHEMA: &str = "freestand.place/1";

pub(crate) fn run(
    args: &PlaceArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let found: Vec<&Place> = match &args.command {
        PlaceCommand::List { of: None } => places().iter().collect(),
        PlaceCommand::List { of: Some(word) } => listed(word)?,
        PlaceCommand::Show { name } => vec![shown(name)?],
    };
    let warnings: Vec<String> = match args.command {
        PlaceCommand::Show { .. } => found.iter().filter_map(|place| place.doubt()).collect(),
        PlaceCommand::List { .. } => Vec::new(),
    };
    let facts: Vec<Facts> = found.iter().map(|place| place.facts()).collect();
    let document = Facts::default().key("places", facts);
    let files = Files::begin(global, &[])?;
    files.print(printer, SCHEMA, &document, &warnings, || {
        match (&args.command, found.as_slice()) {
            (PlaceCommand::Show { .. }, [place]) => one(place),
            _ => list(&found),
        }
    })?;
    Ok(Done::OK)
}

/// The places of a country or a code.
fn listed(word: &str) -> Result<Vec<&'static Place>, Failure> {
    let plain = |text: &str| {
        text.to_lowercase()
            .chars()
            .filter(|c| c.is_alphanumeric())
            .collect::<String>()
    };
    let wanted = plain(word);
    let is_of = |place: &&Place| {
        [
            place.country,
            place.region,
            place.hazard.code(),
            place.hazard.code_title(),
        ]
        .iter()
        .any(|one| !one.is_empty() && plain(one) == wanted)
    };
    let found: Vec<&Place> = places().iter().filter(is_of).collect();
    if found.is_empty() {
        let mut countries: Vec<&str> = places().iter().map(|place| place.country).collect();
        countries.dedup();
        let message = format!("no place is in \"{}\"", shorten(word));
        return Err(Problem::value(message, format!("countries: {}", countries.join(", "))).into());
    }
    Ok(found)
}

fn shown(name: &str) -> Result<&'static Place, Failure> {
    Place::find(name).ok_or_else(|| {
        let hint = match near(name).as_slice() {
            [] => "freestand place list shows all of them".to_owned(),
            names => format!("did you mean {}?", names.join(" or ")),
        };
        Problem::value(
            format!("\"{}\" is not in the table of places", shorten(name)),
            hint,
        )
        .into()
    })
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
