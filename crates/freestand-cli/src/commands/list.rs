//! The study and the list of commands that have other arguments, too.

use freestand_app::CellKeys;
use freestand_app::files::Files;
use freestand_app::list::{ListKeys, ListMeant};
use freestand_app::request::Request as _;
use freestand_assess::inventory::{CellsRequest, Inventory};
use freestand_input::keys::KeyStyle;
use freestand_input::word_reader::WordReader;
use freestand_study::study::Study;

use crate::args::GlobalArgs;
use crate::failure::Failure;

/// What is asked of a study and its list, with both.
pub(crate) fn read(
    keys: &ListKeys,
    global: &GlobalArgs,
    pages: Option<usize>,
) -> Result<(Study, ListMeant, Inventory), Failure> {
    let words = keys.words();
    let mut read = WordReader::new(&words);
    let meant = keys.judged(&mut read, &Files::Disk, global.seed);
    let meant = read.problems.finish(Some(meant))?;
    let study = meant.study(pages)?;
    let inventory = meant.inventory(&study)?;
    Ok((study, meant, inventory))
}

/// How the cells of a list are read.
pub(crate) fn cells(keys: &CellKeys) -> Result<CellsRequest, Failure> {
    let words = keys.words();
    let mut read = WordReader::new(&words);
    let cells = keys.cells(&mut read, &Files::Disk);
    Ok(read.problems.finish(Some(cells))?)
}

/// A flag that says how a list is read, if one is given.
pub(crate) fn of_cells(keys: &CellKeys) -> Option<String> {
    flag(keys.words().entries().map(|(key, _)| key).next())
}

/// A flag that only a list or its study needs, if one is given.
pub(crate) fn of_list(keys: &ListKeys) -> Option<String> {
    let words = keys.words();
    let cells = keys.cells.words();
    let named = |key: &&str| !["study", "inventory"].contains(key) && cells.get(key).is_none();
    flag(words.entries().map(|(key, _)| key).find(named))
}

fn flag(key: Option<&str>) -> Option<String> {
    key.map(|key| KeyStyle::Flag.name(key))
}
