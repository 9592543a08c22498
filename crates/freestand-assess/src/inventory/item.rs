//! Makes an object from the values of a row.

use freestand::block::{Block, BlockError};
use freestand::impact::stiffness_warnings;
use freestand::rocking::Restitution;

use crate::library::{Confidence, Lookup, Tolerance};
use freestand_input::keys::Words;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::nearest;
use freestand_study::cushion::{self, EdgeCushion};
use freestand_study::shape::Shape;

use super::cell::Cell;
use super::columns::{COLUMNS, Column, canonical};
use super::findings::Doubt;
use super::layout::Role;
use super::template::EXAMPLE;
use super::values::Values;
use super::{Consequences, Item};
use freestand_study::restitution::checked;

/// Lower than any object that rocks: probably metres in a column of millimetres.
const MIN_HEIGHT_M: f64 = 0.02;
/// Thinner than any object that rocks.
const MIN_SIDE_M: f64 = 0.005;
/// Larger than any object in a building: probably millimetres in a column of metres.
const MAX_LENGTH_M: f64 = 50.0;

/// First words of rows that are totals of the rows above.
const TOTALS: [&str; 9] = ["total", "totals", "grand_total", "subtotal", "sub_total", "sum", "sums", "summe", "gesamt"];

/// Whether a row is a total of others: it begins with such a word and has no dimensions.
pub(super) fn is_total(values: &Values<'_, '_, '_>) -> bool {
    let size = [Column::Height, Column::Thickness, Column::LevelRatio];
    let has_size = size.iter().any(|&column| {
        values.layout.place(column).and_then(|place| values.row.get(place.index)).is_some_and(|cell| !cell.is_blank())
    });
    let first = values.row.cells.iter().find(|(_, cell)| !cell.is_blank());
    !has_size && first.is_some_and(|(_, cell)| TOTALS.contains(&canonical(&cell.shown()).as_str()))
}

/// The object of a row.
pub(super) fn item(values: &mut Values<'_, '_, '_>, lookup: &Lookup<'_>) -> Item {
    let carried = carried(values);
    let size = size(values);
    let mass_kg = values.positive(Column::Mass);
    let support = support(values, lookup, mass_kg);
    let quantity = values.count(Column::Quantity).unwrap_or(1);
    Item {
        row: values.row.number,
        id: id(values),
        item: values.text(Column::Item),
        quantity,
        priority: values.text(Column::Priority),
        location: values.text(Column::Location),
        building: values.text(Column::Building),
        floor: values.text(Column::Floor),
        room: values.text(Column::Room),
        consequences: Consequences {
            life_safety: values.rating(Column::LifeSafety),
            property: values.rating(Column::Property),
            function: values.rating(Column::Function),
        },
        level_ratio: level(values),
        height_m: size.height_m,
        thickness_m: size.thickness_m,
        width_m: size.width_m,
        base_thickness_m: size.base_thickness_m,
        base_width_m: size.base_width_m,
        cg_height_m: size.cg_height_m,
        mass_kg,
        cushion: support.cushion,
        cushion_log_sd: support.log_sd,
        cushion_source: support.source,
        tolerance: tolerance(values, lookup),
        restitution: restitution(values, &size.blocks),
        friction_ratio: values.range(Column::Friction),
        accepted_ratio: values.share(Column::Accepted),
        questions: values.questions(Column::Questions),
        notes: values.text(Column::Notes),
        carried,
    }
}

fn id(values: &mut Values<'_, '_, '_>) -> String {
    let id = values.text(Column::Id);
    if !id.is_empty() {
        if id.starts_with(EXAMPLE) {
            values.doubt(Doubt::Example);
        }
        return id;
    }
    if values.layout.place(Column::Id).is_some() {
        values.doubt(Doubt::NoId);
    }
    format!("row-{}", values.row.number)
}

/// The cells of other columns, unchanged.
fn carried(values: &mut Values<'_, '_, '_>) -> Vec<String> {
    let mut carried = vec![String::new(); values.layout.carried.len()];
    let row = values.row;
    let mut too_many = None;
    for (index, cell) in &row.cells {
        match values.layout.role(*index) {
            Role::Ours(_) => {}
            Role::Unnamed if row.width.is_some() && *index >= values.layout.widest && !cell.is_blank() => {
                too_many = Some(index + 1);
            }
            Role::Unnamed if cell.is_blank() => {}
            Role::Unnamed => values.doubt(Doubt::Unnamed),
            Role::Carried(n) => {
                match cell {
                    Cell::Error(_) => values.doubt(Doubt::CarriedError),
                    Cell::Unevaluated => values.doubt(Doubt::CarriedFormula),
                    Cell::TooLong(chars) => {
                        let message = format!("a cell has {chars} characters, more than a spreadsheet allows");
                        let at = values.at();
                        values.findings.of_row(at, &message, "shorten it, and check that every quote is closed");
                    }
                    _ => {}
                }
                if let Some(slot) = carried.get_mut(n) {
                    *slot = cell.shown();
                }
            }
        }
    }
    if let Some(count) = too_many {
        let message = format!("the row has {count} cells for {} headings", values.layout.widest);
        let hint = "put cells that contain the separator in quotes, or give every column a heading";
        let at = values.at();
        values.findings.of_row(at, &message, hint);
    }
    if row.width.is_some_and(|width| width < values.layout.width) {
        values.doubt(Doubt::FewCells);
    }
    carried
}

fn level(values: &mut Values<'_, '_, '_>) -> Option<f64> {
    let level = values.quantity(Column::LevelRatio)?;
    if (0.0..=1.0).contains(&level) {
        return Some(level);
    }
    let hint = if level > 1.0 {
        "give the height of the floor over the height of the building, not its number: 0 is the ground, 1 the roof, \
         and 50 % is 0.5"
    } else {
        "0 is the ground, 1 the roof; a basement moves like the ground, so give 0"
    };
    values.refuse(Column::LevelRatio, format!("the level must be from 0 to 1, not {level}"), hint);
    None
}

/// The dimensions of an object, as far as they are known.
struct Size {
    height_m: Option<f64>,
    thickness_m: Option<f64>,
    width_m: Option<f64>,
    base_thickness_m: Option<f64>,
    base_width_m: Option<f64>,
    cg_height_m: Option<f64>,
    /// The object about both axes, as far as they are known.
    blocks: Vec<Block>,
}

fn size(values: &mut Values<'_, '_, '_>) -> Size {
    let mut size = Size {
        height_m: values.positive(Column::Height),
        thickness_m: values.positive(Column::Thickness),
        width_m: values.positive(Column::Width),
        base_thickness_m: values.positive(Column::BaseThickness),
        base_width_m: values.positive(Column::BaseWidth),
        cg_height_m: values.positive(Column::CgHeight),
        blocks: Vec::new(),
    };
    let sides = [size.thickness_m, size.width_m];
    if size.height_m.is_some_and(|h| h < MIN_HEIGHT_M) || sides.iter().flatten().any(|&side| side < MIN_SIDE_M) {
        values.doubt(Doubt::SmallLength);
    }
    if size.height_m.iter().chain(sides.iter().flatten()).any(|&length| length > MAX_LENGTH_M) {
        values.doubt(Doubt::LargeLength);
    }
    let Some(height_m) = size.height_m else { return size };
    let planes = [
        (size.thickness_m, size.base_thickness_m, Column::BaseThickness),
        (size.width_m, size.base_width_m, Column::BaseWidth),
    ];
    let mut is_cg_refused = false;
    for (side, base_width_m, column) in planes {
        let Some(side_m) = side else { continue };
        let feet = Shape { base_width_m, ..Shape::default() };
        let whole = Shape { cg_height_m: size.cg_height_m, ..feet };
        match (feet.block(height_m, side_m), whole.block(height_m, side_m)) {
            (Err(error), _) => refuse_block(values, column, &error),
            (Ok(_), Err(error)) if !is_cg_refused => {
                is_cg_refused = true;
                refuse_block(values, Column::CgHeight, &error);
            }
            (Ok(_), Err(_)) => {}
            (Ok(_), Ok(block)) => size.blocks.push(block),
        }
    }
    if size.blocks.iter().any(|block| block.landing_ratio() < 0.0) {
        values.doubt(Doubt::Squat);
    }
    size
}

fn refuse_block(values: &mut Values<'_, '_, '_>, column: Column, error: &BlockError) {
    let hint = match error {
        BlockError::OutOfObject { .. } => {
            "the feet must be under the object and its centre of gravity inside it: check the numbers and their units"
        }
        _ => "check the number and its unit",
    };
    values.refuse(column, error.to_string(), hint);
}

/// What is under one edge.
#[derive(Default)]
struct Support {
    cushion: Option<EdgeCushion>,
    log_sd: Option<f64>,
    source: Option<String>,
}

fn support(values: &mut Values<'_, '_, '_>, lookup: &Lookup<'_>, mass_kg: Option<f64>) -> Support {
    let mut words = Words::default();
    for column in [Column::Stiffness, Column::PadStiffness, Column::SeriesStiffness, Column::PadThickness] {
        if let Some((_, text)) = values.positive_text(column) {
            words.set(column.name(), text);
        }
    }
    if let Some(pads) = values.count(Column::PadsPerEdge) {
        words.set(Column::PadsPerEdge.name(), pads.to_string());
    }
    let entry = values.text(Column::Cushion);
    let mut support = Support::default();
    if !entry.is_empty() {
        let Some(prior) = (lookup.cushion)(&entry) else {
            refuse_entry(values, Column::Cushion, &entry, lookup.cushion_names, "cushion");
            return support;
        };
        words.set(Column::Cushion.name(), entry);
        match joined(words, prior.words) {
            Ok(both) => words = both,
            Err(problem) => {
                values.wrong(column_of(&problem), &problem);
                return support;
            }
        }
        support.log_sd = Some(prior.log_sd);
        support.source = Some(prior.source);
    }
    if words.is_empty() {
        return support;
    }
    // Missing data cost the object its verdict, but do not stop the reading.
    if words.get("stiffness").is_none() && words.get("pad_stiffness").is_none() && words.get("law").is_none() {
        values.doubt(Doubt::PadAlone);
        return Support::default();
    }
    if words.get("pad_stiffness").is_some() && words.get("pads_per_edge").is_none() {
        values.doubt(Doubt::PadsMissing);
        return Support::default();
    }
    match cushion::resolve(&words, mass_kg) {
        Ok(edge) => {
            let doubts = mass_kg.map(|mass| stiffness_warnings(mass, &edge.cushion, edge.pad_thickness_m));
            if doubts.is_some_and(|doubts| !doubts.is_empty()) {
                values.doubt(Doubt::Stiffness);
            }
            support.cushion = Some(edge);
            support
        }
        Err(problems) => {
            if mass_kg.is_none() && problems.problems.iter().all(|problem| problem.keys == ["damping"]) {
                values.doubt(Doubt::DampingMass);
            } else {
                for problem in &problems.problems {
                    values.wrong(column_of(problem), problem);
                }
            }
            Support::default()
        }
    }
}

/// Joins the cushion keys of a row with those of the library entry that it names. The row may add
/// pads, layers and a thickness, but not another contact law.
fn joined(words: Words, entry: Words) -> Result<Words, Problem> {
    let mut words = words;
    // An entry for a whole edge needs no count of pads; for one pad, a missing count only costs the
    // shock.
    let is_counted = words.get("pads_per_edge").is_some() || entry.get("pads_per_edge").is_some();
    if !is_counted {
        words.set("pads_per_edge", "1");
    }
    let mut both = cushion::with_file(&words, entry)?;
    if !is_counted {
        both.remove("pads_per_edge");
    }
    Ok(both)
}

/// The column of a key of a cushion; keys of a library entry belong to the column with its name.
fn column_of(problem: &Problem) -> Column {
    let column = |key: &&str| COLUMNS.iter().find(|spec| spec.name == *key).map(|spec| spec.column);
    problem.keys.iter().find_map(column).unwrap_or(Column::Cushion)
}

fn refuse_entry(values: &mut Values<'_, '_, '_>, column: Column, entry: &str, names: &[String], library: &str) {
    let all: Vec<&str> = names.iter().map(String::as_str).collect();
    let entry = shorten(entry);
    let hint = match nearest(&entry, &all) {
        Some(near) => format!("did you mean {near}?"),
        None if all.is_empty() => {
            format!("no {library} library is available here: put the values into their own columns")
        }
        None => {
            let some: Vec<&str> = all.iter().copied().take(6).collect();
            format!("known: {}{}", some.join(", "), if all.len() > 6 { " and more" } else { "" })
        }
    };
    values.refuse(column, format!("\"{entry}\" is not an entry of the {library} library"), &hint);
}

fn tolerance(values: &mut Values<'_, '_, '_>, lookup: &Lookup<'_>) -> Option<Tolerance> {
    let stated = Tolerance {
        peak_m_s2: values.positive(Column::Tolerance),
        duration_s: values.positive(Column::ToleranceDuration),
        velocity_change_m_s: values.positive(Column::ToleranceVelocityChange),
        edge_lift_m: values.positive(Column::ToleranceEdgeLift),
        source: "the inventory".to_owned(),
        confidence: Confidence::Stated,
    };
    let Tolerance { peak_m_s2, duration_s, velocity_change_m_s, edge_lift_m, .. } = &stated;
    let is_stated = [peak_m_s2, duration_s, velocity_change_m_s, edge_lift_m].into_iter().any(Option::is_some);
    if duration_s.is_some() && peak_m_s2.is_none() {
        values.doubt(Doubt::PeakMissing);
    }
    let entry = values.text(Column::ToleranceEntry);
    if entry.is_empty() {
        return is_stated.then_some(stated);
    }
    if is_stated {
        let hint = "keep either the entry or the values in the other tolerance columns";
        let message = "tolerance_entry and the other tolerance columns exclude each other";
        values.refuse(Column::ToleranceEntry, message, hint);
        return None;
    }
    let found = (lookup.tolerance)(&entry);
    if found.is_none() {
        refuse_entry(values, Column::ToleranceEntry, &entry, lookup.tolerance_names, "tolerance");
    }
    found
}

fn restitution(values: &mut Values<'_, '_, '_>, blocks: &[Block]) -> Restitution {
    let is_housner = values.cell(Column::Restitution).is_some_and(|(_, cell)| canonical(&cell.shown()) == "housner");
    let value = if is_housner { None } else { values.positive(Column::Restitution) };
    let factor = values.positive(Column::RestitutionFactor);
    let (column, restitution) = match (value, factor) {
        (None, None) => return Restitution::Housner,
        (Some(value), None) => (Column::Restitution, Restitution::Value(value)),
        (Some(_), Some(_)) => {
            let hint = "keep one of them; the factor multiplies Housner's restitution";
            values.refuse(Column::RestitutionFactor, "restitution and restitution_factor exclude each other", hint);
            return Restitution::Housner;
        }
        (None, Some(factor)) => (Column::RestitutionFactor, Restitution::Factor(factor)),
    };
    checked(restitution, blocks).unwrap_or_else(|problem| {
        values.wrong(column, &problem);
        Restitution::Housner
    })
}
