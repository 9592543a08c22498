//! Arguments that several commands share.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;

/// Flags of every command.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Options of every command")]
pub(crate) struct GlobalArgs {
    /// Print exactly one JSON document on standard output
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Folder for the files that are written
    #[arg(long, value_name = "DIR", global = true)]
    pub(crate) out: Option<PathBuf>,
    /// No progress and no warnings on standard error (JSON keeps the warnings)
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// More about what is being done, on standard error
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
    /// Threads to compute on; results do not depend on it [default: one per core]
    #[arg(long, value_name = "N", global = true)]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Seed of the random numbers, in place of the study's
    // A study, where it is kept, holds no larger number.
    #[arg(long, value_name = "N", global = true, value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub(crate) seed: Option<u64>,
    /// Write into an output folder that holds other files
    #[arg(long, global = true)]
    pub(crate) force: bool,
}
