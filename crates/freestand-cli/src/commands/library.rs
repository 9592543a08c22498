//! Lists, shows and searches a library: `freestand tolerance` and `freestand cushion` print theirs
//! with it.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_assess::library::Library;
use freestand_input::words::counted;
use serde::Serialize;

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};

/// The user's own library.
#[derive(Debug, Args)]
pub(crate) struct LibraryArgs {
    /// Your own library: adds to the built-in one and replaces entries with the same id
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) library: Option<PathBuf>,
}

/// The entries to print.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Wanted<'a> {
    All,
    WithId(&'a str),
    WithWords(&'a [String]),
}

/// Labels and values.
pub(crate) type Fields = Vec<(&'static str, Option<String>)>;

/// How the entries of a library are printed.
#[derive(Debug)]
pub(crate) struct Layout<E> {
    pub(crate) schema: &'static str,
    /// A list: its headings, the cells of an entry, and a remark after the count.
    pub(crate) headings: [&'static str; 6],
    pub(crate) cells: fn(&E) -> [String; 6],
    pub(crate) remark: &'static str,
    /// All fields of an entry, of which empty ones are left out, and the notice that it requires.
    pub(crate) fields: fn(&E) -> Fields,
    pub(crate) notice: fn(&E) -> &str,
}

#[derive(Debug, Serialize)]
struct Listed<'a, E> {
    entries: &'a [&'a E],
}

/// Prints entries of the built-in library with the user's own.
pub(crate) fn print<E: Serialize>(
    builtin: Library<E>,
    library: Option<&Path>,
    wanted: Wanted,
    layout: &Layout<E>,
    (global, printer): (&GlobalArgs, &Printer),
) -> Result<Done, Failure> {
    let inputs: Vec<PathBuf> = library.into_iter().map(Path::to_path_buf).collect();
    let library = builtin.with_file(library)?;
    let entries = match wanted {
        Wanted::All => library.entries().iter().collect(),
        Wanted::WithId(id) => vec![library.get(id)?],
        Wanted::WithWords(words) => library.search(words),
    };
    let files = Files::begin(global, &inputs)?;
    let text = || match (wanted, entries.as_slice()) {
        (Wanted::WithId(_), entries) => entries.iter().map(|entry| shown(*entry, layout)).collect(),
        (_, []) => "no entry contains all of these words\n".to_owned(),
        (_, entries) => {
            let rows: Vec<_> = entries
                .iter()
                .map(|entry| (layout.cells)(entry).to_vec())
                .collect();
            table(&layout.headings, &rows)
                + &format!("{}; {}\n", counted(rows.len(), "entry"), layout.remark)
        }
    };
    files.print(
        printer,
        layout.schema,
        &Listed { entries: &entries },
        &library.warnings,
        text,
    )?;
    Ok(Done::OK)
}

fn shown<E>(entry: &E, layout: &Layout<E>) -> String {
    let fields = (layout.fields)(entry).into_iter();
    let given =
        fields.filter_map(|(name, value)| Some((name, value.filter(|value| !value.is_empty())?)));
    let notice = (layout.notice)(entry);
    let notice = if notice.is_empty() {
        String::new()
    } else {
        format!("\n{notice}\n")
    };
    pairs(&given.collect::<Vec<_>>()) + &notice
}
