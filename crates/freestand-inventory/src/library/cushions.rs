//! The cushion library: likely stiffnesses of pads, feet and floors, as ranges.

use schemars::JsonSchema;
use serde::Serialize;

use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, shorten};

use super::collection::{Library, Shelf};
use super::reader::RowReader;
use super::table::{Column, Row, Table};
use super::tolerances::{range_words, source_words};
use super::{Confidence, CushionPrior};

/// The columns of a cushion library.
const CUSHION_COLUMNS: [Column; 12] = [
    Column::text("id").needed(),
    Column::text("item").needed(),
    Column::number("stiffness_low", Dimension::Stiffness).needed(),
    Column::number("stiffness_high", Dimension::Stiffness).needed(),
    Column::number("thickness", Dimension::Length),
    Column::text("pads_per_edge"),
    Column::text("source").needed(),
    Column::text("edition"),
    Column::text("clause"),
    Column::text("page"),
    Column::text("confidence").needed(),
    Column::text("note"),
];

/// Pads under one edge where the entry does not say: two feet.
const PADS_PER_EDGE: u32 = 2;

/// An estimate for one pad, foot or patch of floor under a foot: a range, never a measurement. The
/// keys are those of the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CushionEntry {
    /// Unique, in lower case.
    pub id: String,
    /// What it is.
    pub item: String,
    /// Low end of the range for one pad, foot or patch \[N/m\].
    pub stiffness_low_n_m: f64,
    /// High end of the range \[N/m\].
    pub stiffness_high_n_m: f64,
    /// Geometric mean of the two \[N/m\].
    pub stiffness_n_m: f64,
    /// ln(high/low)/2.
    pub log_sd: f64,
    /// Its thickness \[m\].
    pub thickness_m: Option<f64>,
    /// Number of pads under one edge, where the inventory does not give it.
    pub pads_per_edge: u32,
    /// Document.
    pub source: String,
    /// Its edition.
    pub edition: String,
    /// Clause or table.
    pub clause: String,
    /// Page.
    pub page: String,
    /// The confidence in its source.
    pub confidence: Confidence,
    /// Notes.
    pub note: String,
    /// `built-in`, or the user's file.
    pub origin: String,
}

impl CushionEntry {
    fn read(table: &Table, row: &Row, origin: &str) -> Result<Self, Problems> {
        let mut reader = RowReader::new(table, row);
        let id = reader.id();
        let item = reader.needed("item");
        let low = reader.positive("stiffness_low", Dimension::Stiffness);
        let high = reader.positive("stiffness_high", Dimension::Stiffness);
        let (low, high) = match low.zip(high) {
            Some((low, high)) if low <= high => (low, high),
            Some(_) => {
                let [low, high] =
                    ["stiffness_low", "stiffness_high"].map(|column| shorten(&reader.text(column)));
                let message = format!("{high} is below stiffness_low, {low}");
                reader.note("stiffness_high", message, "swap the two values");
                (1.0, 1.0)
            }
            None => {
                if reader.problems.is_empty() {
                    let hint = "for a single value, write it twice";
                    reader.note("stiffness_low", "a range needs both ends", hint);
                }
                (1.0, 1.0)
            }
        };
        let entry = Self {
            id,
            item,
            stiffness_low_n_m: low,
            stiffness_high_n_m: high,
            stiffness_n_m: (low * high).sqrt(),
            log_sd: 0.5 * (high / low).ln(),
            thickness_m: reader.positive("thickness", Dimension::Length),
            pads_per_edge: reader.count("pads_per_edge").unwrap_or(PADS_PER_EDGE),
            source: reader.text("source"),
            edition: reader.text("edition"),
            clause: reader.text("clause"),
            page: reader.text("page"),
            confidence: reader.confidence(),
            note: reader.text("note"),
            origin: origin.to_owned(),
        };
        reader.problems.finish(Some(entry))
    }

    /// Its source, ready to print.
    pub fn source_words(&self) -> String {
        source_words(&self.source, &self.edition, &self.clause, &self.page)
    }

    /// `803–3196 N/mm`.
    pub fn range_words(&self) -> String {
        range_words(
            self.stiffness_low_n_m,
            self.stiffness_high_n_m,
            Dimension::Stiffness,
        )
    }
}

/// The library of cushions.
pub type CushionLibrary = Library<CushionEntry>;

static SHELF: Shelf<CushionEntry> = Shelf {
    name: "cushion",
    columns: &CUSHION_COLUMNS,
    builtin: include_bytes!("cushions.csv"),
    read: CushionEntry::read,
    id: |entry| &entry.id,
    texts: |entry| vec![&entry.id, &entry.item, &entry.source, &entry.note],
};

impl CushionLibrary {
    /// The built-in library.
    pub fn builtin() -> Self {
        Self::new(&SHELF)
    }

    /// The estimate of an entry, or of layers in series: `rubber-foot`, `rubber-foot +
    /// carpet-underlay`.
    ///
    /// The stiffness is the geometric mean of the range. Layers act in series under each foot,
    /// 1/k = Σ 1/kᵢ, and the scatter of ln k is √Σ(wᵢ sᵢ)² with the shares wᵢ = k/kᵢ of the
    /// compression: the softest layer governs.
    ///
    /// # Errors
    /// An unknown id.
    ///
    /// # Example
    /// A hard rubber foot: √(300 · 3000) N/mm, half of ln 10 either way, two under each edge.
    /// ```
    /// use freestand_study::cushion::resolve;
    /// let prior = freestand_inventory::library::CushionLibrary::builtin().prior("rubber-foot")?;
    /// let edge = resolve(&prior.words, None)?.cushion.linear_stiffness_n_m().unwrap();
    /// assert!((edge / (2.0 * 948.683e3) - 1.0).abs() < 1e-5 && (prior.log_sd - 1.151293).abs() < 1e-6);
    /// # Ok::<(), freestand_input::problem::Problems>(())
    /// ```
    pub fn prior(&self, id: &str) -> Result<CushionPrior, Problem> {
        let layers = id
            .split('+')
            .map(|id| self.get(id))
            .collect::<Result<Vec<_>, _>>()?;
        let mut words = Words::default();
        let newtons_per_metre = |k: f64| format!("{k} N/m");
        let pads = layers.iter().map(|entry| entry.pads_per_edge).max();
        let pads = pads.unwrap_or(PADS_PER_EDGE);
        let (first, below) = layers.split_first().unzip();
        if let Some(first) = first {
            words.set("pad_stiffness", newtons_per_metre(first.stiffness_n_m));
            words.set("pads_per_edge", pads.to_string());
        }
        for entry in below.into_iter().flatten() {
            // A layer in series is under all pads of the edge.
            let stiffness_n_m = f64::from(pads) * entry.stiffness_n_m;
            words.add("series_stiffness", newtons_per_metre(stiffness_n_m), None);
        }
        let thickness_m: f64 = layers.iter().filter_map(|entry| entry.thickness_m).sum();
        if thickness_m > 0.0 {
            words.set("pad_thickness", format!("{thickness_m} m"));
        }
        let softness: f64 = layers.iter().map(|entry| 1.0 / entry.stiffness_n_m).sum();
        let variance = layers
            .iter()
            .map(|entry| (entry.log_sd / (entry.stiffness_n_m * softness)).powi(2))
            .sum::<f64>();
        let source = |entry: &&CushionEntry| {
            let (range, source) = (entry.range_words(), entry.source_words());
            format!(
                "{}: an estimate, {range} each; {source} ({})",
                entry.id,
                entry.confidence.name()
            )
        };
        let source = layers.iter().map(source).collect::<Vec<_>>().join("; ");
        Ok(CushionPrior {
            words,
            log_sd: variance.sqrt(),
            source,
        })
    }
}
