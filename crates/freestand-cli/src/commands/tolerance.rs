//! `freestand tolerance`: what objects withstand, each number with its source.

use clap::{Args, Subcommand};
use freestand_app::library::{List, Search, Show, Tolerances};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{name_of, number};
use freestand_inventory::library::{ToleranceEntry, to_tolerance};
use freestand_study::shock_spectrum::SHAPES;

use super::library::{Fields, Layout, Printed};
use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// Show the tolerance library: what objects withstand, each number with its source
///
/// A recalled entry (without a source that has a page or a clause) may be shown but never decides a
/// verdict. A fragility is the median of the floor motion at which such objects fail, and never a
/// tolerance. Your own library, --library FILE.csv with the same columns, adds entries and replaces
/// those with the same id.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand tolerance list
  freestand tolerance search bookcase
  freestand tolerance show expansion-card-operating
  freestand tolerance list --library ours.csv --json

Columns of a library, with units in brackets such as \"peak [g]\":
  id, class, kind (vendor-limit, test-severity, class, fragility), state (operating,
  non-operating, packaged, any), axis, peak, peak_high, duration, shape, velocity_change,
  edge_lift, pfa_median, pfv_median, beta, n_shocks, source, edition, clause, page, licence,
  notice, confidence (stated, primary, secondary, assumption, recalled), note")]
pub(crate) struct ToleranceArgs {
    #[command(subcommand)]
    command: ToleranceCommand,
}

#[derive(Debug, Subcommand)]
enum ToleranceCommand {
    /// List all entries
    #[command(
        after_help = "Examples:\n  freestand tolerance list\n  freestand tolerance list --library ours.csv --json"
    )]
    List {
        #[command(flatten)]
        request: List<Tolerances>,
    },
    /// Show one entry with all its fields and its notice
    #[command(after_help = "\
Examples:
  freestand tolerance show p58-bookcase-5-shelves
  freestand tolerance show expansion-card-operating --json")]
    Show {
        #[command(flatten)]
        request: Show<Tolerances>,
    },
    /// List entries that contain all of these words in id, class, kind, state, source, clause or
    /// note
    #[command(after_help = "\
Examples:
  freestand tolerance search bookcase
  freestand tolerance search disk operating")]
    Search {
        #[command(flatten)]
        request: Search<Tolerances>,
    },
}

impl Printed for Tolerances {
    const LAYOUT: Layout<ToleranceEntry> = Layout {
        headings: ["id", "withstands", "state", "confidence", "class", "source"],
        cells: |entry| {
            let (state, confidence) = (
                <&str>::from(entry.state).to_owned(),
                entry.confidence.name().to_owned(),
            );
            [
                entry.id.clone(),
                entry.words(),
                state,
                confidence,
                entry.class.clone(),
                entry.source_words(),
            ]
        },
        remark: "recalled entries do not decide verdicts, and medians are not tolerances",
        fields,
        notice: |entry| &entry.notice,
    };
}

pub(crate) fn run(
    args: &ToleranceArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        ToleranceCommand::List { request } => request.run(&(), global, printer),
        ToleranceCommand::Show { request } => request.run(&(), global, printer),
        ToleranceCommand::Search { request } => request.run(&(), global, printer),
    }
}

fn fields(entry: &ToleranceEntry) -> Fields {
    let si = |value: Option<f64>, dimension| value.map(|value| format_si(value, dimension));
    let text = |text: &str| Some(text.to_owned());
    let decides = match (entry.decides, to_tolerance(entry)) {
        (true, Some(_)) => "a verdict may depend on it",
        (false, Some(_)) => "no verdict depends on it",
        (_, None) => "not a tolerance: shown for comparison only",
    };
    vec![
        ("id", text(&entry.id)),
        ("class", text(&entry.class)),
        ("kind", text(entry.kind.into())),
        ("state", text(<&str>::from(entry.state))),
        ("axis", text(&entry.axis)),
        ("peak", si(entry.peak_m_s2, Dimension::Acceleration)),
        (
            "peak, high end",
            si(entry.peak_high_m_s2, Dimension::Acceleration),
        ),
        ("duration", si(entry.duration_s, Dimension::Time)),
        (
            "shape",
            entry.shape.map(|shape| name_of(SHAPES, shape).to_owned()),
        ),
        (
            "velocity change of the pulse",
            entry
                .pulse_velocity_change_m_s
                .map(|v| format!("{} m/s", number(v, 3))),
        ),
        (
            "critical velocity change",
            si(entry.velocity_change_m_s, Dimension::Velocity),
        ),
        ("uplift", si(entry.edge_lift_m, Dimension::Length)),
        (
            "median peak floor acceleration",
            si(entry.pfa_median_m_s2, Dimension::Acceleration),
        ),
        (
            "median peak floor velocity",
            si(entry.pfv_median_m_s, Dimension::Velocity),
        ),
        ("beta", entry.beta.map(|beta| number(beta, 4))),
        ("shocks", entry.n_shocks.map(|count| count.to_string())),
        ("source", text(&entry.source)),
        ("edition", text(&entry.edition)),
        ("clause", text(&entry.clause)),
        ("page", text(&entry.page)),
        ("licence", text(&entry.licence)),
        (
            "confidence",
            Some(format!(
                "{}: {}",
                entry.confidence.name(),
                entry.confidence.description()
            )),
        ),
        ("use", text(decides)),
        ("note", text(&entry.note)),
        ("origin", text(&entry.origin)),
    ]
}
