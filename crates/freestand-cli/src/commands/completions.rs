//! `freestand completions`: scripts with which a shell completes commands and flags.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};
use freestand_output::facts::Facts;

use super::{Cli, Done};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::help::finished;
use crate::printer::Printer;

/// Print a script with which your shell completes commands and flags
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/completions.txt").trim_end())]
pub(crate) struct CompletionsArgs {
    /// Shell
    #[arg(value_name = "SHELL", value_enum)]
    shell: Shell,
}

pub(crate) fn run(
    args: &CompletionsArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let files = Files::begin(global, &[])?;
    let mut script = Vec::new();
    generate(
        args.shell,
        &mut finished(Cli::command()),
        "freestand",
        &mut script,
    );
    let script = String::from_utf8_lossy(&script).into_owned();
    let facts = Facts::default()
        .key("shell", args.shell.to_string())
        .key("script", script.clone());
    files.print(printer, "freestand.completions/1", &facts, &[], || script)?;
    Ok(Done::OK)
}
