//! `freestand cushion list|show|search`: likely stiffnesses of pads, feet and floors.

use clap::Args;
use freestand_app::library::{Cushions, List, Search, Show};
use freestand_inventory::library::CushionEntry;
use freestand_report::library::{CUSHIONS, Layout};

use crate::commands::library::Printed;

/// List the cushion library: likely stiffnesses of pads, feet and floors, as ranges
///
/// These are estimates for use without a test, never measurements: the range for one pad or foot,
/// and its geometric mean. An inventory names an entry in its column cushion, or layers in series
/// such as "rubber-foot + carpet-underlay".
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_list.txt").trim_end())]
pub(crate) struct ListArgs {
    #[command(flatten)]
    pub(super) request: List<Cushions>,
}

/// Show one entry of the cushion library with all its fields
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_show.txt").trim_end())]
pub(crate) struct ShowArgs {
    #[command(flatten)]
    pub(super) request: Show<Cushions>,
}

/// List entries of the cushion library that contain all of these words in id, item, source or note
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_search.txt").trim_end())]
pub(crate) struct SearchArgs {
    #[command(flatten)]
    pub(super) request: Search<Cushions>,
}

impl Printed for Cushions {
    const LAYOUT: Layout<CushionEntry> = CUSHIONS;
}
