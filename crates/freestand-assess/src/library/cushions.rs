//! The cushion library: what pads, feet and floors are likely to be, as ranges.

use std::path::Path;

use serde::Serialize;

use super::entry::source_words;
use super::reader::RowReader;
use super::sheet::{self, Column, Sheet, SheetRow};
use super::tolerances::{BUILT_IN, matches_all, put_over, unique, unknown};
use super::{Confidence, CushionPrior, nearest_ids};
use freestand_input::file::InputFile;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, format_si};
use freestand_study::cushion::CushionWords;

/// The columns of a cushion library.
pub const CUSHION_COLUMNS: [Column; 12] = [
    Column::needed("id"),
    Column::needed("item"),
    Column { needed: true, ..Column::number("stiffness_low", Dimension::Stiffness) },
    Column { needed: true, ..Column::number("stiffness_high", Dimension::Stiffness) },
    Column::number("thickness", Dimension::Length),
    Column::text("pads_per_edge"),
    Column::needed("source"),
    Column::text("edition"),
    Column::text("clause"),
    Column::text("page"),
    Column::needed("confidence"),
    Column::text("note"),
];

/// Pads that share the landing of an edge where nothing is said: two feet.
const PADS_PER_EDGE: u32 = 2;

/// A prior of one pad, foot or patch of floor under a foot: a range, never a measurement. The keys are those of the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CushionEntry {
    /// Unique, in small letters.
    pub id: String,
    /// What it is.
    pub item: String,
    /// Low end of the range of one \[N/m\].
    pub stiffness_low_n_m: f64,
    /// High end \[N/m\].
    pub stiffness_high_n_m: f64,
    /// Geometric mean of the two \[N/m\].
    pub stiffness_n_m: f64,
    /// ln(high/low)/2.
    pub log_sd: f64,
    /// Its thickness \[m\].
    pub thickness_m: Option<f64>,
    /// How many share the landing of an edge, where the inventory does not say.
    pub pads_per_edge: u32,
    /// Document.
    pub source: String,
    /// Its edition.
    pub edition: String,
    /// Clause or table.
    pub clause: String,
    /// Page.
    pub page: String,
    /// How sure.
    pub confidence: Confidence,
    /// Notes.
    pub note: String,
    /// `built-in`, or the file of the user's.
    pub origin: String,
}

impl CushionEntry {
    fn read(sheet: &Sheet, row: &SheetRow, origin: &str) -> Result<Self, Vec<Problem>> {
        let mut reader = RowReader::new(sheet, row);
        let id = reader.id();
        let item = reader.needed("item");
        let low = reader.positive("stiffness_low", Dimension::Stiffness);
        let high = reader.positive("stiffness_high", Dimension::Stiffness);
        let (low, high) = match low.zip(high) {
            Some((low, high)) if low <= high => (low, high),
            Some(_) => {
                reader.note("stiffness_high", "is below stiffness_low", "write the lower one first");
                (1.0, 1.0)
            }
            None => {
                if reader.problems.is_empty() {
                    reader.note("stiffness_low", "a range needs both ends", "one value: write it twice");
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
        if reader.problems.is_empty() { Ok(entry) } else { Err(reader.problems) }
    }

    /// Where it comes from, ready to print.
    pub fn source_words(&self) -> String {
        source_words(&self.source, &self.edition, &self.clause, &self.page)
    }

    /// `803–3196 N/mm`.
    pub fn range_words(&self) -> String {
        let low = format_si(self.stiffness_low_n_m, Dimension::Stiffness);
        let high = format_si(self.stiffness_high_n_m, Dimension::Stiffness);
        format!("{}–{high}", low.split(' ').next().unwrap_or(&low))
    }
}

/// What pads, feet and floors are likely to be.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CushionLibrary {
    entries: Vec<CushionEntry>,
    /// The user's files.
    pub inputs: Vec<InputFile>,
    /// What is doubtful about them.
    pub warnings: Vec<String>,
}

impl CushionLibrary {
    /// What is built in.
    pub fn builtin() -> Self {
        // The table is part of the program; a test reads it.
        let entries = read_entries(include_bytes!("cushions.csv"), BUILT_IN).map(|(entries, _)| entries);
        Self { entries: entries.unwrap_or_default(), ..Self::default() }
    }

    /// What is built in, with the user's library over it.
    ///
    /// # Errors
    /// Everything that is wrong with the file, with line and column.
    pub fn with_file(path: &Path) -> Result<Self, Problems> {
        let mut library = Self::builtin();
        library.add_file(path)?;
        Ok(library)
    }

    /// Puts another file of the user's over what is there.
    ///
    /// # Errors
    /// As [`Self::with_file`]; the library then stays as it was.
    pub fn add_file(&mut self, path: &Path) -> Result<(), Problems> {
        let (input, warnings) = put_over(&mut self.entries, path, read_entries, |entry| &entry.id)?;
        self.warnings.extend(warnings);
        self.inputs.push(input);
        Ok(())
    }

    /// All entries, ours first.
    pub fn entries(&self) -> &[CushionEntry] {
        &self.entries
    }

    /// The entry of an id, in any case.
    pub fn find(&self, id: &str) -> Option<&CushionEntry> {
        let id = id.trim().to_lowercase();
        self.entries.iter().find(|entry| entry.id == id)
    }

    /// The entry of an id.
    ///
    /// # Errors
    /// None: the problem names what is nearest.
    pub fn get(&self, id: &str) -> Result<&CushionEntry, Problem> {
        self.find(id).ok_or_else(|| unknown(id.trim(), "cushion", &self.nearest(id)))
    }

    /// Entries that have every word somewhere in id, item, source or note.
    pub fn search(&self, words: &[String]) -> Vec<&CushionEntry> {
        let has = |entry: &CushionEntry| matches_all(words, &[&entry.id, &entry.item, &entry.source, &entry.note]);
        self.entries.iter().filter(|entry| has(entry)).collect()
    }

    /// Ids that were likely meant by one that is not there, three at most.
    pub fn nearest(&self, id: &str) -> Vec<&str> {
        nearest_ids(id, &self.entries.iter().map(|entry| entry.id.as_str()).collect::<Vec<_>>())
    }

    /// The prior of an id, or of layers one on the other: `rubber-foot`, `rubber-foot + carpet-underlay`.
    ///
    /// The stiffness is the geometric mean of the range. Layers act in series under each foot, 1/k = Σ 1/kᵢ, and the scatter of
    /// ln k is √Σ(wᵢ sᵢ)² with the shares wᵢ = k/kᵢ of the compression: the softest layer governs.
    ///
    /// # Errors
    /// An id that is not there.
    ///
    /// # Example
    /// A hard rubber foot: √(300 · 3000) N/mm, half of ln 10 either way, two to an edge.
    /// ```
    /// let prior = freestand_assess::library::CushionLibrary::builtin().prior("rubber-foot")?;
    /// let edge = prior.words.resolve(None).unwrap().cushion.linear_stiffness_n_m().unwrap();
    /// assert!((edge / (2.0 * 948.683e3) - 1.0).abs() < 1e-5 && (prior.log_sd - 1.151293).abs() < 1e-6);
    /// # Ok::<(), freestand_input::problem::Problem>(())
    /// ```
    pub fn prior(&self, id: &str) -> Result<CushionPrior, Problem> {
        let layers = id.split('+').map(|id| self.get(id)).collect::<Result<Vec<_>, _>>()?;
        let mut words = CushionWords::new(KeyStyle::File);
        let newtons_per_metre = |k: f64| format!("{k} N/m");
        let pads = layers.iter().map(|entry| entry.pads_per_edge).max().unwrap_or(PADS_PER_EDGE);
        for (i, entry) in layers.iter().enumerate() {
            if i == 0 {
                words.set("pad_stiffness", newtons_per_metre(entry.stiffness_n_m));
                words.set("pads_per_edge", pads.to_string());
            } else {
                // What is in series stands under all the pads of the edge.
                words.set("series_stiffness", newtons_per_metre(f64::from(pads) * entry.stiffness_n_m));
            }
        }
        let thickness_m: f64 = layers.iter().filter_map(|entry| entry.thickness_m).sum();
        if thickness_m > 0.0 {
            words.set("pad_thickness", format!("{thickness_m} m"));
        }
        let softness: f64 = layers.iter().map(|entry| 1.0 / entry.stiffness_n_m).sum();
        let variance =
            layers.iter().map(|entry| (entry.log_sd / (entry.stiffness_n_m * softness)).powi(2)).sum::<f64>();
        let source = |entry: &&CushionEntry| {
            let (range, source) = (entry.range_words(), entry.source_words());
            format!("{}: a prior, {range} each; {source} ({})", entry.id, entry.confidence.name())
        };
        let source = layers.iter().map(source).collect::<Vec<_>>().join("; ");
        Ok(CushionPrior { words, log_sd: variance.sqrt(), source })
    }
}

fn read_entries(bytes: &[u8], origin: &str) -> Result<(Vec<CushionEntry>, Vec<String>), Problems> {
    let sheet = sheet::read_sheet(bytes, &CUSHION_COLUMNS)?;
    let rows = sheet.rows.iter().map(|row| (row.line, CushionEntry::read(&sheet, row, origin)));
    let entries = unique(rows, |entry| &entry.id)?;
    Ok((entries, sheet.warnings))
}
