//! One file for each command.

mod shock;

use clap::Subcommand;

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
    /// Everything is as it should be.
    pub(crate) const OK: Self = Self { criterion_met: true };
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Shock(Box<shock::ShockArgs>),
}

impl Command {
    pub(crate) fn run(&self, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
        let _ = global;
        match self {
            Self::Shock(args) => shock::run(args, printer),
        }
    }
}
