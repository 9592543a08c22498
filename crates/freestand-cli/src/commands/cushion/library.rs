//! `freestand cushion list|show|search`: likely stiffnesses of pads, feet and floors.

use clap::Args;
use freestand_app::library::{Cushions, List, Search, Show};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;
use freestand_inventory::library::CushionEntry;

use crate::commands::library::{Fields, Layout, Printed};

/// List the cushion library: likely stiffnesses of pads, feet and floors, as ranges
///
/// These are estimates for use without a test, never measurements: the range for one pad or foot,
/// and its geometric mean. An inventory names an entry in its column cushion, or layers in series
/// such as "rubber-foot + carpet-underlay".
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion list
  freestand cushion list --library ours.csv --json

Columns of a library:
  id, item, stiffness_low [N/mm], stiffness_high [N/mm], thickness [mm], pads_per_edge, source,
  edition, clause, page, confidence (stated, primary, secondary, assumption, recalled), note")]
pub(crate) struct ListArgs {
    #[command(flatten)]
    pub(super) request: List<Cushions>,
}

/// Show one entry of the cushion library with all its fields
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion show rubber-foot
  freestand cushion show rubber-foot --json")]
pub(crate) struct ShowArgs {
    #[command(flatten)]
    pub(super) request: Show<Cushions>,
}

/// List entries of the cushion library that contain all of these words in id, item, source or note
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion search rubber
  freestand cushion search rubber foot")]
pub(crate) struct SearchArgs {
    #[command(flatten)]
    pub(super) request: Search<Cushions>,
}

impl Printed for Cushions {
    const LAYOUT: Layout<CushionEntry> = Layout {
        headings: [
            "id",
            "stiffness range",
            "mean",
            "confidence",
            "item",
            "source",
        ],
        cells: |entry| {
            let confidence = entry.confidence.name().to_owned();
            [
                entry.id.clone(),
                entry.range_words(),
                mean(entry),
                confidence,
                entry.item.clone(),
                entry.source_words(),
            ]
        },
        remark: "estimates, not measurements",
        fields,
        notice: |_| "",
    };
}

/// The mean stiffness: three digits are enough for so wide a range.
fn mean(entry: &CushionEntry) -> String {
    format!("{} N/mm", number(entry.stiffness_n_m / 1e3, 3))
}

fn fields(entry: &CushionEntry) -> Fields {
    let text = |text: &str| Some(text.to_owned());
    vec![
        ("id", text(&entry.id)),
        ("item", text(&entry.item)),
        ("stiffness range", Some(entry.range_words())),
        ("geometric mean", Some(mean(entry))),
        (
            "scatter of ln k",
            Some(format!(
                "{} (the range is taken as 16 to 84 %)",
                number(entry.log_sd, 3)
            )),
        ),
        (
            "thickness",
            entry.thickness_m.map(|t| format_si(t, Dimension::Length)),
        ),
        (
            "pads per edge",
            Some(format!(
                "{} unless the inventory gives another number",
                entry.pads_per_edge
            )),
        ),
        ("source", text(&entry.source)),
        ("edition", text(&entry.edition)),
        ("clause", text(&entry.clause)),
        ("page", text(&entry.page)),
        (
            "confidence",
            Some(format!(
                "{}: {}",
                entry.confidence.name(),
                entry.confidence.description()
            )),
        ),
        (
            "use",
            text("an estimate, not a measurement: a drop test is better"),
        ),
        ("note", text(&entry.note)),
        ("origin", text(&entry.origin)),
    ]
}
