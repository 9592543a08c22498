//! One file for each command.

mod assess;
mod check;
mod completions;
mod cushion;
mod exports;
mod floor;
mod fragility;
mod fragility_runs;
mod inventory;
mod library;
mod manual;
mod motion;
mod object;
mod place;
mod restrain;
mod risk;
mod rock;
mod run;
#[cfg(feature = "page")]
mod serve;
mod shard;
mod shock;
mod shock_spectrum;
mod spectrum;
mod tolerance;
mod validate;

use clap::{Parser, Subcommand};
use freestand_app::files::Files as Sources;
use freestand_app::request::Question;
use freestand_input::written::Written;

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// What a command reports back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Done {
    /// `false` (exit status 1): some items failed, or a criterion is exceeded.
    pub(crate) criterion_met: bool,
}

impl Done {
    /// Nothing failed and no criterion is exceeded.
    pub(crate) const OK: Self = Self {
        criterion_met: true,
    };
}

/// A command that is asked by a struct.
pub(crate) trait Tell: Question + Clone {
    /// The flags that say which files are written; the page has none.
    type Output: Default;

    /// Whether it writes a folder even if none is named.
    const WRITES_A_FOLDER: bool = false;

    /// Answers what is meant, writes the files and prints the result.
    fn tell(
        meant: Self::Meant,
        output: &Self::Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure>;

    /// Answers what a person typed.
    fn run(
        &self,
        output: &Self::Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let mut request = self.clone();
        request.set_seed(global.seed.map(|seed| Written::Text(seed.to_string())));
        Self::tell(request.resolve(&Sources::Disk)?, output, global, printer)
    }
}

/// How hard an earthquake knocks a free-standing object, and whether it falls.
#[derive(Debug, Parser)]
#[command(
    name = "freestand",
    version,
    propagate_version = false,
    subcommand_required = true
)]
#[command(after_help = include_str!("../help/freestand.txt").trim_end())]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) global: GlobalArgs,
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Run(Box<run::RunArgs>),
    Assess(Box<assess::AssessArgs>),
    Shard(shard::ShardArgs),
    Object(Box<object::ObjectArgs>),
    Check(check::CheckArgs),
    Shock(Box<shock::ShockArgs>),
    ShockSpectrum(Box<shock_spectrum::ShockSpectrumArgs>),
    Rock(Box<rock::RockArgs>),
    Spectrum(Box<spectrum::SpectrumArgs>),
    Motion(Box<motion::MotionArgs>),
    Cushion(Box<cushion::CushionArgs>),
    Floor(Box<floor::FloorArgs>),
    Inventory(inventory::InventoryArgs),
    Tolerance(tolerance::ToleranceArgs),
    Place(place::PlaceArgs),
    Restrain(Box<restrain::RestrainArgs>),
    Fragility(Box<fragility::FragilityArgs>),
    Risk(Box<risk::RiskArgs>),
    Validate(validate::ValidateArgs),
    #[cfg(feature = "page")]
    Serve(serve::ServeArgs),
    Completions(completions::CompletionsArgs),
    Manual(manual::ManualArgs),
}

impl Command {
    pub(crate) fn run(&self, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
        match self {
            Self::Run(args) => run::run(args, global, printer),
            Self::Assess(args) => args.request.run(&(), global, printer),
            Self::Shard(args) => shard::run(args, global, printer),
            Self::Object(args) => args.request.run(&(), global, printer),
            Self::Check(args) => args.request.run(&(), global, printer),
            Self::Shock(args) => args.request.run(&(), global, printer),
            Self::ShockSpectrum(args) => args.request.run(&args.output, global, printer),
            Self::Rock(args) => args.request.run(&args.output, global, printer),
            Self::Spectrum(args) => args.request.run(&args.output, global, printer),
            Self::Motion(args) => motion::run(args, global, printer),
            Self::Cushion(args) => cushion::run(args, global, printer),
            Self::Floor(args) => args.request.run(&args.output, global, printer),
            Self::Inventory(args) => inventory::run(args, global, printer),
            Self::Tolerance(args) => tolerance::run(args, global, printer),
            Self::Place(args) => place::run(args, global, printer),
            Self::Restrain(args) => args.request.run(&(), global, printer),
            Self::Fragility(args) => args.request.run(&args.output, global, printer),
            Self::Risk(args) => args.request.run(&args.output, global, printer),
            Self::Validate(args) => args.request.run(&(), global, printer),
            #[cfg(feature = "page")]
            Self::Serve(args) => serve::run(args, global, printer),
            Self::Completions(args) => completions::run(args, global, printer),
            Self::Manual(_) => manual::run(global, printer),
        }
    }
}
