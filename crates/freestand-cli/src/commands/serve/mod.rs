//! `freestand serve`: the local page.

mod request;

use std::path::PathBuf;
use std::process::{Command, Stdio};

use clap::Args;
use freestand_input::file::read_only_from;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_output::json::document;
use freestand_page::{BindError, Server, Settings};
use serde_json::json;

use self::request::PROGRAM;
use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// Open a page in the browser that answers on this machine
///
/// The page asks this program; nothing leaves the machine. It is served on 127.0.0.1 only, to whoever
/// has the address with its token. Ctrl-C ends it.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/serve.txt").trim_end())]
pub(crate) struct ServeArgs {
    /// Port on 127.0.0.1 [default: any free one]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Print the address, but open no browser
    #[arg(long)]
    no_open: bool,
    /// Folder for the results of assessments, each in a folder of its own [default: a temporary
    /// one, removed at the end]
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

/// The line with the address.
const SCHEMA: &str = "freestand.serve/1";

pub(crate) fn run(
    args: &ServeArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    if global.out.is_some() {
        return Err(Failure::usage(
            "--out does not apply to serve",
            "give --folder for the results of assessments",
        ));
    }
    let stop = printer.stop();
    stop.listen_to_hangup();
    let settings = Settings {
        port: args.port,
        folder: args.folder.clone(),
    };
    let server = Server::bind(&settings, PROGRAM).map_err(|error| refused(args.port, &error))?;
    read_only_from(server.uploads());
    if printer.json() {
        let body = json!({
            "url": server.url(),
            "port": server.port(),
            "token": server.token(),
            "version": env!("CARGO_PKG_VERSION"),
        });
        // One line: whoever starts the server reads it and goes on.
        let text = document(SCHEMA, &body, &[])?;
        let line: serde_json::Value =
            serde_json::from_str(&text).unwrap_or(serde_json::Value::Null);
        printer.print(&format!("{line}\n"))?;
    } else {
        printer.print(&format!(
            "The page is at {} until you press Ctrl-C.\n",
            server.url()
        ))?;
    }
    if !args.no_open && !printer.json() {
        open(
            &server.url_for_browser().unwrap_or_else(|_| server.url()),
            printer,
        );
    }
    server.serve(|| stop.wanted());
    Ok(Done::OK)
}

fn refused(port: u16, error: &BindError) -> Failure {
    let error = match error {
        BindError::Port(error) => error,
        BindError::Folder(error) => {
            let folder = std::env::temp_dir();
            return Problem::new(
                ProblemKind::Io,
                format!("no folder for uploaded files can be made here: {error}"),
            )
            .in_file(&folder)
            .hint("check that it exists and can be written, or set TMPDIR to a folder that can")
            .into();
        }
    };
    let hint = match error.kind() {
        std::io::ErrorKind::AddrInUse => "another program has this port: leave --port out",
        std::io::ErrorKind::PermissionDenied => {
            "ports below 1024 belong to the system: leave --port out"
        }
        _ => "leave --port out",
    };
    Problem::new(
        ProblemKind::Io,
        format!("cannot listen on 127.0.0.1, port {port}: {error}"),
    )
    .hint(hint)
    .into()
}

/// Opens the page with the browser of the system.
fn open(url: &str, printer: &Printer) {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let quiet = || Stdio::null();
    let started = Command::new(program)
        .arg(url)
        .stdin(quiet())
        .stdout(quiet())
        .stderr(quiet())
        .spawn();
    if started.is_err() {
        printer.note("No browser could be started: open the address yourself.");
    }
}
