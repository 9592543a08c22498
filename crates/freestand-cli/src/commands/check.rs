//! `freestand check`: validates and explains a study without running it.

use std::path::PathBuf;

use clap::Args;
use freestand_app::place::{self, PlaceKeys};
use freestand_app::request::Request as _;
use freestand_study::resolve::{Overrides, builtin, load, motion_paths};

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, lines};

/// Check a study without running it, and show how it was understood
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand check study.toml
  freestand check study.toml --json
  freestand check            (the built-in study)
  freestand check study.toml --place Wellington --site D")]
#[command(mut_args(|arg| place::under(arg, place::OF_STUDY)))]
pub(crate) struct CheckArgs {
    /// Study file (TOML) [default: the built-in study]
    #[arg(value_name = "STUDY.toml")]
    study: Option<PathBuf>,
    #[command(flatten)]
    hazard: PlaceKeys,
}

pub(crate) fn run(
    args: &CheckArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let overrides = Overrides {
        seed: global.seed,
        hazard: args.hazard.words(),
        ..Overrides::default()
    };
    let study = match &args.study {
        Some(path) => load(path, &overrides)?,
        None => builtin(&overrides)?,
    };
    let inputs: Vec<PathBuf> = args
        .study
        .iter()
        .cloned()
        .chain(motion_paths(&study))
        .collect();
    let files = Files::begin(global, &inputs)?;
    let facts = freestand_study::check::check(&study);
    files.print(
        printer,
        "freestand.check/1",
        &facts,
        &study.warnings,
        || lines(&facts),
    )?;
    Ok(Done::OK)
}
