//! `freestand manual`: the pages that `man freestand` shows.

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use freestand_output::facts::Facts;

use super::{Cli, Done};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::help::finished;
use crate::printer::Printer;

/// Print the manual page of the program; with --out, write one page for each command
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/manual.txt").trim_end())]
pub(crate) struct ManualArgs {}

pub(crate) fn run(global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let files = Files::begin(global, &[])?;
    let mut command = finished(Cli::command()).disable_help_subcommand(true);
    command.build();
    let mut pages = Vec::new();
    add_pages(&command, &mut pages)?;
    let names = pages.iter().map(|(name, _)| name.as_str());
    let facts = Facts::default().key("pages", names.collect::<Vec<_>>());
    for (name, page) in &pages {
        files.write(name, || page)?;
    }
    let own = pages.first().map_or("", |(_, text)| text).to_owned();
    files.print(printer, "freestand.manual/1", &facts, &[], || own)?;
    Ok(Done::OK)
}

/// The names and texts of the pages of a command and of those below it.
fn add_pages(command: &Command, pages: &mut Vec<(String, String)>) -> Result<(), Failure> {
    let page = Man::new(command.clone());
    let mut text = Vec::new();
    let defect =
        |error| Failure::computation(format!("the manual page cannot be written: {error}"));
    page.render(&mut text).map_err(defect)?;
    pages.push((
        page.get_filename(),
        String::from_utf8_lossy(&text).into_owned(),
    ));
    for below in command.get_subcommands().filter(|one| !one.is_hide_set()) {
        add_pages(below, pages)?;
    }
    Ok(())
}
