//! What a page is made of. The template draws these and knows nothing of assessments.

use std::collections::BTreeMap;

use serde::Serialize;

/// The whole document.
#[derive(Debug, Serialize)]
pub(crate) struct Document {
    pub(crate) title: String,
    /// Stands at the foot of every page.
    pub(crate) footer: String,
    /// By the names of decisions.
    pub(crate) signs: BTreeMap<&'static str, Sign>,
    pub(crate) summary: Vec<Block>,
    pub(crate) objects: Vec<Page>,
}

/// How a decision is shown.
#[derive(Debug, Serialize)]
pub(crate) struct Sign {
    pub(crate) symbol: &'static str,
    pub(crate) label: &'static str,
    /// `#a84300`
    pub(crate) ink: String,
    pub(crate) fill: String,
}

/// One object.
#[derive(Debug, Serialize)]
pub(crate) struct Page {
    /// What links point to.
    pub(crate) anchor: String,
    /// Stands at the head of every page of the object.
    pub(crate) running: String,
    pub(crate) title: String,
    pub(crate) subtitle: String,
    pub(crate) blocks: Vec<Block>,
}

/// A part of a page.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(crate) enum Block {
    /// How many of each decision.
    Counts { rows: Vec<Count> },
    /// The decision and why.
    Verdict { decision: &'static str, why: String },
    /// Names and values.
    Facts { title: &'static str, pairs: Vec<(String, String)> },
    /// Two blocks beside each other.
    Beside { left: Box<Self>, right: Box<Self> },
    /// A table whose header repeats on every page.
    Table { title: String, note: String, columns: Vec<Column>, rows: Vec<Vec<Cell>> },
    /// Sentences.
    List { title: &'static str, items: Vec<String>, is_warning: bool },
    /// Probabilities on a line from 0 to 1.
    Chances { title: &'static str, rows: Vec<Chance>, accepted_ratio: f64, accepted: String },
    /// What would change it.
    Tornado { title: &'static str, note: String, rows: Vec<Bar>, as_is_ratio: f64, limit_ratio: Option<f64> },
    /// Eqs. (5)–(7) with their numbers.
    Chain { title: &'static str, note: String, values: Box<ChainValues> },
}

/// How many objects have a decision.
#[derive(Debug, Serialize)]
pub(crate) struct Count {
    pub(crate) decision: &'static str,
    pub(crate) count: String,
    pub(crate) meaning: &'static str,
}

/// A column of a table.
#[derive(Debug, Serialize)]
pub(crate) struct Column {
    pub(crate) name: String,
    /// Of a number.
    pub(crate) is_right: bool,
    /// Share of the width that is left; 0: as wide as its cells.
    pub(crate) share: u8,
}

/// A cell of a table.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Cell {
    Text(String),
    Decision { decision: &'static str },
    Link { text: String, anchor: String },
}

/// A probability with its interval.
#[derive(Debug, Serialize)]
pub(crate) struct Chance {
    pub(crate) name: &'static str,
    pub(crate) value_ratio: f64,
    pub(crate) low_ratio: f64,
    pub(crate) high_ratio: f64,
    pub(crate) words: String,
}

/// A bar of the tornado: ends as shares of the width, 1 and beyond where it is overturned.
#[derive(Debug, Serialize)]
pub(crate) struct Bar {
    pub(crate) name: String,
    pub(crate) low: String,
    pub(crate) high: String,
    pub(crate) at_low: String,
    pub(crate) at_high: String,
    pub(crate) from_ratio: f64,
    pub(crate) to_ratio: f64,
    pub(crate) is_beyond: bool,
    pub(crate) is_drawn: bool,
    pub(crate) flips: bool,
}

/// The numbers of the equations, as they are printed.
#[derive(Debug, Serialize)]
pub(crate) struct ChainValues {
    pub(crate) is_uniform: bool,
    pub(crate) is_halted: bool,
    pub(crate) radius: String,
    pub(crate) base: String,
    pub(crate) mass: String,
    pub(crate) stiffness: String,
    pub(crate) rise: String,
    pub(crate) landing_ratio: String,
    pub(crate) drop: String,
    pub(crate) edge: String,
    pub(crate) effective_mass: String,
    pub(crate) impact_velocity_edge: String,
    pub(crate) velocity_change: String,
    pub(crate) duration: String,
}

impl Column {
    /// Text that takes a share of the width that is left.
    pub(crate) fn wide(name: &str, share: u8) -> Self {
        Self { name: name.to_owned(), is_right: false, share }
    }

    /// Short text.
    pub(crate) fn text(name: &str) -> Self {
        Self { name: name.to_owned(), is_right: false, share: 0 }
    }

    /// Numbers.
    pub(crate) fn number(name: &str) -> Self {
        Self { name: name.to_owned(), is_right: true, share: 0 }
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}
