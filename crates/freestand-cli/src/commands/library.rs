//! Lists, shows and searches a library: `freestand tolerance` and `freestand cushion` print theirs
//! with it.

use std::slice;

use freestand_app::library::{Library, List, Listed, Meant, Search, Show, Wanted};
use freestand_report::library::{Layout, entries_text, entry_text};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

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
    let text = || match wanted {
        Wanted::WithId(_) => {
            let shown = listed.entries.iter();
            shown.map(|entry| entry_text(*entry, layout)).collect()
        }
        _ => entries_text(&listed.entries, layout),
    };
    files.print(printer, L::SCHEMA, &listed, &library.warnings, text)?;
    Ok(Done::OK)
}
