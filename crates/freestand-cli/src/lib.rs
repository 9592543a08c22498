//! The command `freestand`: it reads arguments and prints results, and contains no physics.

mod args;
mod commands;
mod failure;
mod files;
mod help;
mod printer;
mod rows;
mod session;
mod stop;

use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};
use freestand_input::words::counted;

use commands::Cli;
use failure::Failure;
use help::finished;
use printer::Printer;

/// The largest number of threads accepted: more than any machine has cores.
const MAX_THREADS: usize = 1024;

/// Lets the allocator of glibc keep up to twice as much freed memory as this: a world takes some megabytes and frees them
/// again, and to get a page from the system anew takes as long as to calculate what it holds. Freeing one block of this size
/// raises both thresholds, M_MMAP_THRESHOLD and M_TRIM_THRESHOLD (mallopt(3)).
fn keep_freed_memory() {
    const BYTES: usize = 8 << 20;
    if cfg!(all(target_os = "linux", target_env = "gnu")) {
        std::hint::black_box(Vec::<u8>::with_capacity(BYTES));
    }
}

/// Runs the command with the arguments of the process, and returns its exit status: 0, or 1 if a criterion is not met,
/// 2 for an error, and that of an interrupt.
pub fn run() -> ExitCode {
    keep_freed_memory();
    match try_main() {
        Ok(code) => code,
        // The reader of our output has closed it (`freestand … | head`): there is no one to tell.
        Err(Failure::BrokenPipe) => ExitCode::SUCCESS,
        Err(Failure::Stopped(left)) => {
            printer::print_failure(&Failure::usage("stopped", left.words()));
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
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.get())
            .build_global()
            .map_err(|error| {
                Failure::computation(format!(
                    "cannot start {}: {error}",
                    counted(threads.get(), "thread")
                ))
            })?;
    }
    printer.detail(&format!(
        "freestand {}, {}",
        env!("CARGO_PKG_VERSION"),
        counted(rayon::current_num_threads(), "thread")
    ));
    let done = cli.command.run(&cli.global, &printer)?;
    Ok(if done.criterion_met {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(1)
    })
}
