//! The command `freestand`: it reads arguments and prints results, and contains no physics.

mod args;
mod commands;
mod cushion;
mod failure;
mod files;
mod hazard;
mod keys;
mod printer;
mod processing;
mod reading;
mod rows;
mod stop;
mod target;
mod values;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser};
use freestand_input::words::counted;

use args::GlobalArgs;
use commands::Command;
use failure::Failure;
use printer::Printer;
use values::finished;

/// How hard an earthquake knocks a free-standing object, and whether it falls.
#[derive(Debug, Parser)]
#[command(name = "freestand", version, propagate_version = false, subcommand_required = true)]
#[command(after_help = "\
Write quantities with their unit: \"2.3 m\", 2300mm, \"140 kg\", \"4380 N/mm\", 0.35g, \"5 %\".
Exit status: 0 done; 1 done, but something failed or a criterion is exceeded; 2 could not run;
130 stopped by Ctrl-C.

Examples:
  freestand run
  freestand shock --height \"2.3 m\" --thickness \"600 mm\" --mass \"140 kg\" \\
    --stiffness \"4380 N/mm\" --cg-rise \"16 mm\"
  freestand motion info record.AT2
  freestand validate")]
struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    command: Command,
}

/// The largest number of threads accepted: more than any machine has cores.
const MAX_THREADS: usize = 1024;

fn main() -> ExitCode {
    match try_main() {
        Ok(code) => code,
        // The reader of our output has closed it (`freestand … | head`): there is no one to tell.
        Err(Failure::BrokenPipe) => ExitCode::SUCCESS,
        Err(Failure::Stopped { printed }) => {
            let hint = match printed {
                false => "nothing was written; the results of an earlier run are unchanged",
                true => "the printed output is incomplete; no file was written, and earlier results are unchanged",
            };
            printer::print_failure(&Failure::usage("stopped", hint));
            ExitCode::from(stop::EXIT_STATUS)
        }
        Err(Failure::StoppedAfterWriting) => {
            let hint = "the finished part was written; continue with --resume";
            printer::print_failure(&Failure::usage("stopped", hint));
            ExitCode::from(stop::EXIT_STATUS)
        }
        Err(failure) => {
            printer::print_failure(&failure);
            ExitCode::from(2)
        }
    }
}

fn try_main() -> Result<ExitCode, Failure> {
    let matches = finished(Cli::command()).try_get_matches();
    let cli = match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) if !error.use_stderr() => {
            printer::print_text(&error.render().to_string())?;
            return Ok(ExitCode::SUCCESS);
        }
        Err(error) => return Err(failure::usage(&error)),
    };
    let printer = Printer::new(&cli.global);
    if let Some(threads) = cli.global.threads {
        if threads.get() > MAX_THREADS {
            return Err(Failure::usage(
                format!("--threads {threads} is more than {MAX_THREADS}"),
                "leave --threads out: the results do not depend on it",
            ));
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global().map_err(|error| {
            Failure::computation(format!("cannot start {}: {error}", counted(threads.get(), "thread")))
        })?;
    }
    printer.detail(&format!(
        "freestand {}, {}",
        env!("CARGO_PKG_VERSION"),
        counted(rayon::current_num_threads(), "thread")
    ));
    let done = cli.command.run(|| finished(Cli::command()), &cli.global, &printer)?;
    Ok(if done.criterion_met { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
