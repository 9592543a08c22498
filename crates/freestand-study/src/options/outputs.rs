//! The keys of `[outputs]`.

use super::{Reader, Section, Written};
use freestand_input::quantity::Dimension;

/// `[outputs]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct OutputsOptions {
    pub(crate) figures: Option<Written<bool>>,
    pub(crate) report: Option<Written<bool>>,
    pub(crate) parquet: Option<Written<bool>>,
    pub(crate) cards: Option<Written<bool>>,
    pub(crate) date: Option<Written<String>>,
    pub(crate) preparer: Option<Written<String>>,
    pub(crate) revision: Option<Written<String>>,
    pub(crate) history: Option<HistoryOptions>,
}

/// `history` of `[outputs]`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HistoryOptions {
    pub(crate) line: usize,
    pub(crate) level: Option<Written<String>>,
    pub(crate) motion: Option<Written<String>>,
    pub(crate) height_m: Option<Written<f64>>,
    pub(crate) thickness_m: Option<Written<f64>>,
}

pub(super) fn outputs(reader: &mut Reader, table: &mut Section) -> OutputsOptions {
    OutputsOptions {
        figures: table.boolean(reader, "figures"),
        report: table.boolean(reader, "report"),
        parquet: table.boolean(reader, "parquet"),
        cards: table.boolean(reader, "cards"),
        date: table.string(reader, "date"),
        preparer: table.string(reader, "preparer"),
        revision: table.string(reader, "revision"),
        history: table.table(reader, "history").map(|mut entry| {
            let history = HistoryOptions {
                line: entry.line,
                level: entry.string(reader, "level"),
                motion: entry.string(reader, "motion"),
                height_m: entry.quantity(reader, "height", Dimension::Length),
                thickness_m: entry.quantity(reader, "thickness", Dimension::Length),
            };
            entry.finish(reader);
            history
        }),
    }
}
