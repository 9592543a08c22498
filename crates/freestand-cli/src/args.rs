//! Arguments that several commands share.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use freestand_study::study::DEFAULT_SEED;

/// Flags that every command has.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Options of every command")]
pub(crate) struct GlobalArgs {
    /// Print exactly one JSON document on standard output
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Folder for all files that the command writes
    #[arg(long, value_name = "DIR", global = true)]
    pub(crate) out: Option<PathBuf>,
    /// Print no progress and no warnings (JSON still contains the warnings)
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Print more about the calculation on standard error
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
    /// Number of threads; results do not depend on it [default: one per core]
    #[arg(long, value_name = "N", global = true, value_parser = at_least_one)]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Seed of the random numbers; replaces the seed of a study [default: 1]
    #[arg(long, value_name = "N", global = true, value_parser = zero_or_more)]
    pub(crate) seed: Option<u64>,
    /// Write into an output folder even if it contains other files
    #[arg(long, global = true)]
    pub(crate) force: bool,
}

impl GlobalArgs {
    /// Those of a request of the page; `out` is the folder for its files, if it wants any.
    #[cfg(feature = "page")]
    pub(crate) fn of_request(out: Option<PathBuf>) -> Self {
        Self {
            json: true,
            out,
            quiet: true,
            verbose: false,
            threads: None,
            seed: None,
            force: false,
        }
    }

    /// The seed of `--seed`, or the default.
    pub(crate) fn seed(&self) -> u64 {
        self.seed.unwrap_or(DEFAULT_SEED)
    }

    /// The output folder of a command that always writes one; `default` is where no `--out` is given.
    /// Each command has its own, because a folder belongs to the command that wrote it.
    pub(crate) fn folder(&self, default: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| PathBuf::from(default))
    }
}

/// A count of at least 1.
pub(crate) fn at_least_one(text: &str) -> Result<NonZeroUsize, String> {
    text.parse()
        .map_err(|_| "a whole number is expected, at least 1".to_owned())
}

/// A seed, at most 2⁶³ − 1: the largest whole number that a study can store.
fn zero_or_more(text: &str) -> Result<u64, String> {
    let seed = text
        .parse::<u64>()
        .ok()
        .filter(|&seed| i64::try_from(seed).is_ok());
    seed.ok_or_else(|| format!("a whole number is expected, 0 to {}", i64::MAX))
}
