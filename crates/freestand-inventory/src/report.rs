//! How a list was understood, as a document.
#![expect(
    missing_docs,
    reason = "the names are those of the JSON document and state the units"
)]

use freestand::G0_M_S2;
use freestand_input::keys::KeyStyle;
use freestand_study::cushion::cushion_words;
use schemars::JsonSchema;
use serde::Serialize;

use super::columns_read::{ColumnRead, HeadingReport};
use super::{COLUMNS, Casters, Column, ColumnSpec, Finding, Item, Rating, Reading};

/// The number of rows that people are shown.
pub const SHOWN: usize = 10;

/// How a list was understood: the document of `freestand inventory check`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CheckReport {
    pub path: String,
    pub sha256: String,
    pub sheet: Option<String>,
    pub header_row: u32,
    pub counts: Counts,
    /// The columns that freestand reads.
    pub columns: Vec<ColumnRead>,
    /// Every column of the file, with examples of its cells and what it was taken for.
    pub headings: Vec<HeadingReport>,
    /// What a column can be taken for.
    pub senses: Vec<SenseReport>,
    pub carried: Vec<String>,
    /// The first rows, in SI.
    pub first_rows: Vec<RowReport>,
    pub objects: Vec<ObjectReport>,
    pub left_out: Vec<LeftOutReport>,
    /// The headings, and the cells of each object, where they are wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<CellsReport>,
    pub problems: Vec<ProblemReport>,
    pub marked_copy: Option<String>,
}

/// What a column can be taken for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SenseReport {
    pub name: &'static str,
    pub meaning: &'static str,
    pub unit: Option<&'static str>,
}

/// What a column can be taken for, in the order of the template.
pub fn senses() -> Vec<SenseReport> {
    let sense = |spec: &ColumnSpec| SenseReport {
        name: spec.name,
        meaning: spec.meaning,
        unit: (!spec.unit.is_empty()).then_some(spec.unit),
    };
    COLUMNS.iter().map(sense).collect()
}

/// How many rows have each kind of value.
#[derive(Debug, Default, Serialize, JsonSchema)]
pub struct Counts {
    pub rows: usize,
    /// The sum of the quantities of all rows.
    pub objects: u64,
    pub with_size: usize,
    pub with_level: usize,
    pub with_width: usize,
    pub with_mass: usize,
    pub with_cushion: usize,
    pub with_tolerance: usize,
}

/// One of the first rows.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RowReport {
    pub row: u32,
    pub id: String,
    pub item: String,
    pub quantity: u32,
    pub level_ratio: Option<f64>,
    pub height_m: Option<f64>,
    pub thickness_m: Option<f64>,
    pub width_m: Option<f64>,
    pub mass_kg: Option<f64>,
    pub stiffness_n_m: Option<f64>,
    pub cushion: Option<String>,
    pub tolerance_m_s2: Option<f64>,
    pub tolerance_duration_s: Option<f64>,
    pub tolerance_source: Option<String>,
}

/// An object, in SI; what the list does not say is `null`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ObjectReport {
    pub row: u32,
    pub section: Option<String>,
    pub id: String,
    pub item: Option<String>,
    pub quantity: u32,
    pub building: Option<String>,
    pub floor: Option<String>,
    pub room: Option<String>,
    pub level_ratio: Option<f64>,
    pub height_m: Option<f64>,
    pub thickness_m: Option<f64>,
    pub width_m: Option<f64>,
    pub is_round: bool,
    pub cg_height_m: Option<f64>,
    pub mass_kg: Option<f64>,
    pub stiffness_n_m: Option<f64>,
    pub tolerance_g: Option<f64>,
    pub tolerance_duration_s: Option<f64>,
    pub anchored: Option<bool>,
    pub life_safety: Option<&'static str>,
    pub property: Option<&'static str>,
    pub function: Option<&'static str>,
    pub rests_on: Option<String>,
    pub wall_gap_m: Option<f64>,
    pub neighbour_gap_m: Option<f64>,
    pub casters: Option<&'static str>,
    pub clearance_m: Option<f64>,
    pub doubts: Vec<&'static str>,
    /// Edits that would mend or confirm sizes that are not believed; no verdict before.
    pub to_confirm: Vec<String>,
}

/// A row that is not an object.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LeftOutReport {
    pub row: u32,
    pub kind: &'static str,
    pub text: String,
}

/// The cells of a list as they were read.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CellsReport {
    pub columns: Vec<String>,
    pub headings: Vec<String>,
    /// The row of each object, counted from 1.
    pub rows: Vec<u32>,
    /// The texts of each object, one for each column.
    pub texts: Vec<Vec<String>>,
}

/// A problem, with all its cells.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProblemReport {
    pub severity: &'static str,
    pub kind: &'static str,
    pub column: Option<&'static str>,
    pub heading: Option<String>,
    pub count: usize,
    pub rows: Vec<u32>,
    pub cells: Vec<String>,
    pub examples: Vec<String>,
    pub message: String,
    pub hint: String,
    /// Texts that would mend or confirm the cells.
    pub edits: Vec<String>,
}

/// The report on a list as it was read; messages name keys in this style.
pub fn check_report(
    reading: &Reading,
    marked_copy: Option<String>,
    style: KeyStyle,
) -> CheckReport {
    let inventory = &reading.inventory;
    let left_out = reading.left_out.iter().map(|left| LeftOutReport {
        row: left.row,
        kind: left.kind.into(),
        text: left.text.clone(),
    });
    CheckReport {
        path: inventory.path.to_string_lossy().into_owned(),
        sha256: inventory.sha256.clone(),
        sheet: inventory.sheet.clone(),
        header_row: reading.header_row,
        counts: counts(&inventory.items),
        columns: reading.columns.clone(),
        headings: reading.headings.clone(),
        senses: senses(),
        carried: inventory.carried.clone(),
        first_rows: inventory.items.iter().take(SHOWN).map(row).collect(),
        objects: inventory.items.iter().map(object).collect(),
        left_out: left_out.collect(),
        cells: (!reading.cells.is_empty()).then(|| cells(reading)),
        problems: problem_reports(&inventory.findings, style),
        marked_copy,
    }
}

fn cells(reading: &Reading) -> CellsReport {
    let first = reading
        .headings
        .iter()
        .filter(|one| one.header_row == reading.header_row);
    let (columns, headings) = first
        .map(|one| (one.column.clone(), one.heading.clone()))
        .unzip();
    let (rows, texts) = reading
        .cells
        .iter()
        .map(|cells| (cells.row, cells.texts.clone()))
        .unzip();
    CellsReport {
        columns,
        headings,
        rows,
        texts,
    }
}

/// The problems of a list; messages name keys in this style.
pub fn problem_reports(findings: &[Finding], style: KeyStyle) -> Vec<ProblemReport> {
    let report = |finding: &Finding| ProblemReport {
        severity: finding.severity.name(),
        kind: finding.kind.name(),
        column: finding.column.map(Column::name),
        heading: finding.heading.clone(),
        // A problem of the whole list is one.
        count: finding.rows.len().max(1),
        rows: finding.rows.clone(),
        cells: finding.cells(),
        examples: finding.examples.clone(),
        message: style.shown(&finding.message()),
        hint: style.shown(&finding.hint),
        edits: finding.edits.clone(),
    };
    findings.iter().map(report).collect()
}

fn object(item: &Item) -> ObjectReport {
    let text = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    let rated = |rating: Option<Rating>| rating.map(Rating::name);
    let tolerance = item.tolerance.as_ref();
    ObjectReport {
        row: item.row,
        section: text(&item.section),
        id: item.id.clone(),
        item: text(&item.item),
        quantity: item.quantity,
        building: text(&item.building),
        floor: text(&item.floor),
        room: text(&item.room),
        level_ratio: item.level_ratio,
        height_m: item.height_m,
        thickness_m: item.thickness_m,
        width_m: item.width_m,
        is_round: item.is_round(),
        cg_height_m: item.cg_height_m,
        mass_kg: item.mass_kg,
        stiffness_n_m: item
            .cushion
            .as_ref()
            .and_then(|edge| edge.cushion.linear_stiffness_n_m()),
        tolerance_g: tolerance
            .and_then(|tolerance| tolerance.peak_m_s2)
            .map(|peak| peak / G0_M_S2),
        tolerance_duration_s: tolerance.and_then(|tolerance| tolerance.duration_s),
        anchored: item.anchored,
        life_safety: rated(item.consequences.life_safety),
        property: rated(item.consequences.property),
        function: rated(item.consequences.function),
        rests_on: text(&item.rests_on),
        wall_gap_m: item.surroundings.wall_gap_m,
        neighbour_gap_m: item.surroundings.neighbour_gap_m,
        casters: item.surroundings.casters.map(Casters::name),
        clearance_m: item.surroundings.clearance_m,
        doubts: item.doubts.iter().map(|kind| kind.name()).collect(),
        to_confirm: item.to_confirm.clone(),
    }
}

fn counts(items: &[Item]) -> Counts {
    let with = |has: fn(&Item) -> bool| items.iter().filter(|item| has(item)).count();
    Counts {
        rows: items.len(),
        objects: items.iter().map(|item| u64::from(item.quantity)).sum(),
        with_size: with(|item| item.height_m.is_some() && item.thickness_m.is_some()),
        with_level: with(|item| item.level_ratio.is_some()),
        with_width: with(|item| item.width_m.is_some()),
        with_mass: with(|item| item.mass_kg.is_some()),
        with_cushion: with(|item| item.cushion.is_some()),
        with_tolerance: with(|item| item.tolerance.is_some()),
    }
}

fn row(item: &Item) -> RowReport {
    let cushion = item.cushion.as_ref().map(|edge| &edge.cushion);
    let tolerance = item.tolerance.as_ref();
    RowReport {
        row: item.row,
        id: item.id.clone(),
        item: item.item.clone(),
        quantity: item.quantity,
        level_ratio: item.level_ratio,
        height_m: item.height_m,
        thickness_m: item.thickness_m,
        width_m: item.width_m,
        mass_kg: item.mass_kg,
        stiffness_n_m: cushion.and_then(|cushion| cushion.linear_stiffness_n_m()),
        cushion: cushion.map(cushion_words),
        tolerance_m_s2: tolerance.and_then(|tolerance| tolerance.peak_m_s2),
        tolerance_duration_s: tolerance.and_then(|tolerance| tolerance.duration_s),
        tolerance_source: tolerance.map(|tolerance| tolerance.source.clone()),
    }
}
