//! `freestand motion`: records and synthetic motions.

mod code;
mod convert;
mod info;
pub(crate) mod plot;
mod rotate;
mod rotd;
mod simulate;
mod spectrum;
mod synth;

use clap::{Args, Subcommand};

use super::{Done, Tell as _};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// Read, measure, convert, rotate, synthesise, match and simulate motions
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion.txt").trim_end())]
pub(crate) struct MotionArgs {
    #[command(subcommand)]
    command: MotionCommand,
}

#[derive(Debug, Subcommand)]
enum MotionCommand {
    Info(info::InfoArgs),
    Spectrum(spectrum::SpectrumArgs),
    Convert(convert::ConvertArgs),
    Rotate(rotate::RotateArgs),
    Rotd(rotd::RotdArgs),
    Synth(Box<synth::SynthArgs>),
    Match(Box<synth::MatchArgs>),
    Simulate(simulate::SimulateArgs),
    CodeSpectrum(Box<code::CodeSpectrumArgs>),
}

pub(crate) fn run(
    args: &MotionArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        MotionCommand::Info(args) => args.request.run(&args.output, global, printer),
        MotionCommand::Spectrum(args) => args.request.run(&args.output, global, printer),
        MotionCommand::Convert(args) => args.request.run(&(), global, printer),
        MotionCommand::Rotate(args) => args.request.run(&(), global, printer),
        MotionCommand::Rotd(args) => args.request.run(&args.output, global, printer),
        MotionCommand::Synth(args) => args.request.run(&(), global, printer),
        MotionCommand::Match(args) => args.request.run(&(), global, printer),
        MotionCommand::Simulate(args) => args.request.run(&args.output, global, printer),
        MotionCommand::CodeSpectrum(args) => args.request.run(&args.output, global, printer),
    }
}
