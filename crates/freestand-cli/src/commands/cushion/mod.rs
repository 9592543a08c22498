//! `freestand cushion`: how a pad behaves, from tests, virtual tests and a library.

mod curve;
mod drop;
mod library;
mod recovery;
mod simulate;
mod static_curve;

use clap::{Args, Subcommand};

use super::{Done, Tell as _};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// Evaluate and simulate tests of cushions, and show a library of typical cushions
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion.txt").trim_end())]
pub(crate) struct CushionArgs {
    #[command(subcommand)]
    command: CushionCommand,
}

#[derive(Debug, Subcommand)]
enum CushionCommand {
    Drop(Box<drop::DropArgs>),
    Static(Box<static_curve::StaticArgs>),
    Simulate(Box<simulate::SimulateArgs>),
    Recovery(Box<recovery::RecoveryArgs>),
    Curve(Box<curve::CurveArgs>),
    List(library::ListArgs),
    Show(library::ShowArgs),
    Search(library::SearchArgs),
}

pub(crate) fn run(
    args: &CushionArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        CushionCommand::Drop(args) => args.request.run(&args.output, global, printer),
        CushionCommand::Static(args) => args.request.run(&args.output, global, printer),
        CushionCommand::Simulate(args) => args.request.run(&(), global, printer),
        CushionCommand::Recovery(args) => args.request.run(&(), global, printer),
        CushionCommand::Curve(args) => args.request.run(&(), global, printer),
        CushionCommand::List(args) => args.request.run(&(), global, printer),
        CushionCommand::Show(args) => args.request.run(&(), global, printer),
        CushionCommand::Search(args) => args.request.run(&(), global, printer),
    }
}
