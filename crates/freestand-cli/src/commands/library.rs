//! Lists, shows and searches a library: `freestand tolerance` and `freestand cushion` print theirs
//! with it.

use std::slice;

use freestand_app::library::{Library, List, Listed, Meant, Search, Show, Wanted};
use freestand_input::words::counted;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};

/// Labels and values.
pub(crate) type Fields = Vec<(&'static str, Option<String>)>;

/// How the entries of a library are printed.
#[derive(Debug)]
pub(crate) struct Layout<E> {
    /// A list: its headings, the cells of an entry, and a remark after the count.
    pub(crate) headings: [&'static str; 6],
    pub(crate) cells: fn(&E) -> [String; 6],
    pub(crate) remark: &'static str,
    /// All fields of an entry, of which empty ones are left out, and the notice that it requires.
    pub(crate) fields: fn(&E) -> Fields,
    pub(crate) notice: fn(&E) -> &str,
}

/// A library whose entries are printed.
pub(crate) trait Printed: Library {
    /// How they are printed.
    const LAYOUT: Layout<Self::Entry>;
}

macro_rules! printed {
    ($($question:ident),+) => {$(
        impl<L: Printed> Tell for $question<L> {
            type Output = ();

            fn tell(meant: Meant, (): &(), global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
                print::<L>(&meant, global, printer)
            }
        }
    )+};
}
printed!(List, Show, Search);

/// Prints entries of the built-in library with the user's own.
fn print<L: Printed>(
    Meant { wanted, library }: &Meant,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let layout = &L::LAYOUT;
    let inputs = library.as_ref().map_or(&[][..], slice::from_ref);
    let library = L::builtin().with_file(library.as_deref())?;
    let entries = match wanted {
        Wanted::All => library.entries().iter().collect(),
        Wanted::WithId(id) => vec![library.get(id)?],
        Wanted::WithWords(words) => library.search(words),
    };
    let listed = Listed { entries };
    let files = Files::begin(global, inputs)?;
    let text = || match (wanted, listed.entries.as_slice()) {
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
    files.print(printer, L::SCHEMA, &listed, &library.warnings, text)?;
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
