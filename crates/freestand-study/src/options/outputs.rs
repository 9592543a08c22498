//! The keys of `[outputs]`.

use super::within;

options! {
    /// `[outputs]`, as written.
    OutputsOptions(reader, table) {
        figures: boolean;
        report: boolean;
        parquet: boolean;
        cards: boolean;
        date: string;
        preparer: string;
        revision: string;
        history: (Option<HistoryOptions>) = within(table, reader, "history", HistoryOptions::read);
    }
}

options! {
    /// `history` of `[outputs]`.
    HistoryOptions(reader, table) {
        line: (usize) = table.line;
        level: string;
        motion: string;
        height_m: [quantity "height" Length];
        thickness_m: [quantity "thickness" Length];
    }
}
