//! The columns of an inventory: their names, what they hold, and how a heading is recognised.

use freestand_input::quantity::{Dimension, Unit, lookup};

/// A column that freestand reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Column {
    /// `id`
    Id,
    /// `item`
    Item,
    /// `quantity`
    Quantity,
    /// `priority`
    Priority,
    /// `location`
    Location,
    /// `building`
    Building,
    /// `floor`
    Floor,
    /// `room`
    Room,
    /// `life_safety`
    LifeSafety,
    /// `property`
    Property,
    /// `function`
    Function,
    /// `level_ratio`
    LevelRatio,
    /// `height`
    Height,
    /// `thickness`
    Thickness,
    /// `width`
    Width,
    /// `base_thickness`
    BaseThickness,
    /// `base_width`
    BaseWidth,
    /// `cg_height`
    CgHeight,
    /// `mass`
    Mass,
    /// `stiffness`
    Stiffness,
    /// `pad_stiffness`
    PadStiffness,
    /// `pads_per_edge`
    PadsPerEdge,
    /// `series_stiffness`
    SeriesStiffness,
    /// `cushion`
    Cushion,
    /// `pad_thickness`
    PadThickness,
    /// `tolerance`
    Tolerance,
    /// `tolerance_duration`
    ToleranceDuration,
    /// `tolerance_velocity_change`
    ToleranceVelocityChange,
    /// `tolerance_edge_lift`
    ToleranceEdgeLift,
    /// `tolerance_entry`
    ToleranceEntry,
    /// `restitution`
    Restitution,
    /// `restitution_factor`
    RestitutionFactor,
    /// `friction`
    Friction,
    /// `accepted`
    Accepted,
    /// What is asked of the object.
    Questions,
    /// `notes`
    Notes,
}

/// What the cells of a column hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// Text.
    Text,
    /// A whole number from 1.
    Count,
    /// High, medium or low.
    Rating,
    /// A quantity with its unit in the heading or in the cell; a ratio has none.
    Quantity(Dimension),
    /// One ratio or a range of two: `0.3-0.5`.
    Range,
}

/// The specification of a column.
#[derive(Debug, Clone, Copy)]
pub struct ColumnSpec {
    /// The column.
    pub column: Column,
    /// Its name in files and messages.
    pub name: &'static str,
    /// Other headings that are accepted, in the form of [`canonical`].
    aliases: &'static [&'static str],
    /// What its cells hold.
    pub holds: Holds,
    /// Its unit in the template.
    pub unit: &'static str,
    /// Whether a file must have it.
    pub is_required: bool,
    /// What it means, for people.
    pub meaning: &'static str,
    /// An example of a cell.
    pub example: &'static str,
}

const fn text(column: Column, name: &'static str, aliases: &'static [&'static str]) -> ColumnSpec {
    ColumnSpec { column, name, aliases, holds: Holds::Text, unit: "", is_required: false, meaning: "", example: "" }
}

const fn quantity(column: Column, name: &'static str, dimension: Dimension, unit: &'static str) -> ColumnSpec {
    ColumnSpec { holds: Holds::Quantity(dimension), unit, ..text(column, name, &[]) }
}

const fn said(spec: ColumnSpec, meaning: &'static str, example: &'static str) -> ColumnSpec {
    ColumnSpec { meaning, example, ..spec }
}

const fn required(spec: ColumnSpec) -> ColumnSpec {
    ColumnSpec { is_required: true, ..spec }
}

const fn also(spec: ColumnSpec, aliases: &'static [&'static str]) -> ColumnSpec {
    ColumnSpec { aliases, ..spec }
}

const fn of(spec: ColumnSpec, holds: Holds) -> ColumnSpec {
    ColumnSpec { holds, ..spec }
}

use Dimension::{Acceleration, Length, Mass, Ratio, Stiffness, Time, Velocity};

/// All columns, in the order of the template and of [`Column`].
pub static COLUMNS: [ColumnSpec; 36] = [
    said(
        text(Column::Id, "id", &[]),
        "Identifier of the object, unique in the file; without it the row number is used",
        "ward3-07",
    ),
    said(
        text(Column::Item, "item", &["nonstructural_item", "nonstructural_component", "object"]),
        "What it is",
        "instrument cabinet",
    ),
    said(
        of(text(Column::Quantity, "quantity", &["qty"]), Holds::Count),
        "How many such objects there are; empty: 1",
        "2",
    ),
    said(text(Column::Priority, "priority", &[]), "Rank given by the owner, in any form", "1"),
    said(text(Column::Location, "location", &[]), "Where it is, in words", "east wing"),
    said(text(Column::Building, "building", &[]), "Building", "Block A"),
    said(text(Column::Floor, "floor", &[]), "Name of the floor", "Level 3"),
    said(text(Column::Room, "room", &[]), "Room", "3.12"),
    said(
        of(text(Column::LifeSafety, "life_safety", &["ls", "life_safety_ls"]), Holds::Rating),
        "FEMA E-74, LS: risk that somebody is hurt (H, M or L)",
        "H",
    ),
    said(
        of(text(Column::Property, "property", &["pl", "property_loss", "property_loss_pl"]), Holds::Rating),
        "FEMA E-74, PL: risk of a loss of property (H, M or L)",
        "M",
    ),
    said(
        of(
            text(Column::Function, "function", &["fl", "functional_loss", "function_loss", "functional_loss_fl"]),
            Holds::Rating,
        ),
        "FEMA E-74, FL: risk that work stops (H, M or L)",
        "M",
    ),
    required(said(
        quantity(Column::LevelRatio, "level_ratio", Ratio, ""),
        "Height of its floor over the height of the building: 0 ground, 1 roof",
        "0.5",
    )),
    required(said(quantity(Column::Height, "height", Length, "mm"), "Height", "1800")),
    required(said(
        also(quantity(Column::Thickness, "thickness", Length, "mm"), &["depth"]),
        "Horizontal size in the plane of rocking, usually the shorter side; the heading depth is accepted too",
        "450",
    )),
    said(
        quantity(Column::Width, "width", Length, "mm"),
        "Horizontal size across the thickness; empty: rocking is computed about one axis only",
        "900",
    ),
    said(
        also(quantity(Column::BaseThickness, "base_thickness", Length, "mm"), &["base_depth"]),
        "Distance between the feet in the direction of the thickness; empty: the thickness",
        "400",
    ),
    said(
        quantity(Column::BaseWidth, "base_width", Length, "mm"),
        "Distance between the feet in the direction of the width; empty: the width",
        "850",
    ),
    said(
        also(quantity(Column::CgHeight, "cg_height", Length, "mm"), &["c_g_height"]),
        "Height of the centre of gravity; empty: half the height",
        "800",
    ),
    said(quantity(Column::Mass, "mass", Mass, "kg"), "Mass; without it no shock can be computed", "140"),
    said(
        quantity(Column::Stiffness, "stiffness", Stiffness, "N/mm"),
        "Stiffness of everything under one edge (or give pad_stiffness with pads_per_edge, or cushion)",
        "4380",
    ),
    said(quantity(Column::PadStiffness, "pad_stiffness", Stiffness, "N/mm"), "Stiffness of one pad or foot", "2190"),
    said(
        of(text(Column::PadsPerEdge, "pads_per_edge", &[]), Holds::Count),
        "Number of pads under one edge: a cabinet on four feet has 2",
        "2",
    ),
    said(
        quantity(Column::SeriesStiffness, "series_stiffness", Stiffness, "N/mm"),
        "Stiffness of a layer in series with the pads: legs, floor covering",
        "20000",
    ),
    said(text(Column::Cushion, "cushion", &[]), "Entry of the cushion library, in place of a stiffness", ""),
    said(
        quantity(Column::PadThickness, "pad_thickness", Length, "mm"),
        "Thickness of the pad, for the check against bottoming",
        "10",
    ),
    said(
        quantity(Column::Tolerance, "tolerance", Acceleration, "g"),
        "Peak acceleration that it withstands; without a tolerance only overturning is assessed",
        "5",
    ),
    said(
        quantity(Column::ToleranceDuration, "tolerance_duration", Time, "ms"),
        "Duration of the half-sine of that peak",
        "11",
    ),
    said(
        quantity(Column::ToleranceVelocityChange, "tolerance_velocity_change", Velocity, "m/s"),
        "Velocity change below which no peak causes damage",
        "0.9",
    ),
    said(
        quantity(Column::ToleranceEdgeLift, "tolerance_edge_lift", Length, "mm"),
        "Uplift from which it may fall back without damage",
        "50",
    ),
    said(
        text(Column::ToleranceEntry, "tolerance_entry", &[]),
        "Entry of the tolerance library, in place of the other tolerance columns",
        "",
    ),
    said(
        quantity(Column::Restitution, "restitution", Ratio, ""),
        "Angular velocity after an impact over the one before, above 0 and up to 1; empty: Housner's",
        "0.9",
    ),
    said(
        quantity(Column::RestitutionFactor, "restitution_factor", Ratio, ""),
        "Factor on Housner's restitution",
        "0.95",
    ),
    said(
        of(text(Column::Friction, "friction", &[]), Holds::Range),
        "Coefficient of friction on the floor, one value or a range",
        "0.3-0.5",
    ),
    said(
        quantity(Column::Accepted, "accepted", Ratio, ""),
        "Probability of overturning or damage that the owner accepts; empty: that of the study",
        "10 %",
    ),
    said(
        text(Column::Questions, "questions", &["question"]),
        "What the verdict rests on: falls, or falls+shock; empty: shock too where a tolerance is given or the loss of \
         function or property is rated high",
        "falls",
    ),
    said(text(Column::Notes, "notes", &["note", "remarks"]), "Notes", "photo 12"),
];

impl Column {
    /// Its specification.
    pub fn spec(self) -> &'static ColumnSpec {
        // The table is in the order of the enum; a test checks that.
        &COLUMNS[self as usize]
    }

    /// Its name in files and messages.
    pub fn name(self) -> &'static str {
        self.spec().name
    }
}

/// The form in which headings are compared: lower-case letters and digits, with one `_` for
/// everything between them.
pub(super) fn canonical(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars().flat_map(char::to_lowercase) {
        if c.is_alphanumeric() {
            out.push(c);
        } else if !out.is_empty() && !out.ends_with('_') {
            out.push('_');
        }
    }
    out.truncate(out.trim_end_matches('_').len());
    out
}

/// What a heading means.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Heading {
    /// A column that freestand reads, with its unit; `None`: each cell must have its own.
    Ours(Column, Option<&'static Unit>),
    /// A column that freestand reads, with a text in brackets that is not a unit of it.
    BadUnit(Column, String),
    /// Another column.
    Other,
}

fn named(name: &str) -> Option<&'static ColumnSpec> {
    COLUMNS.iter().find(|spec| spec.name == name || spec.aliases.contains(&name))
}

/// Longest heading that is interpreted; known headings are far shorter.
const MAX_HEADING_BYTES: usize = 100;

/// Interprets a heading such as `height [mm]`, `Height (mm)`, `height_mm`, `Height, mm` or
/// `HEIGHT`.
pub(super) fn heading(text: &str) -> Heading {
    let text = text.trim();
    if text.is_empty() || text.len() > MAX_HEADING_BYTES {
        return Heading::Other;
    }
    if let Some((name, bracket)) = bracketed(text)
        && let Some(spec) = named(&canonical(name))
    {
        return match spec.holds {
            Holds::Quantity(dimension) => match lookup(bracket).filter(|unit| unit.dimension == dimension) {
                Some(unit) => Heading::Ours(spec.column, Some(unit)),
                // The brackets of a ratio say what it is a ratio of.
                None if dimension == Dimension::Ratio => Heading::Ours(spec.column, None),
                None => Heading::BadUnit(spec.column, bracket.to_owned()),
            },
            Holds::Range => Heading::Ours(spec.column, lookup(bracket).filter(|u| u.dimension == Dimension::Ratio)),
            _ => Heading::Ours(spec.column, None),
        };
    }
    suffixed(text)
        .unwrap_or_else(|| named(&canonical(text)).map_or(Heading::Other, |spec| Heading::Ours(spec.column, None)))
}

fn bracketed(text: &str) -> Option<(&str, &str)> {
    let open = text.find(['[', '('])?;
    let inner = text[open..].strip_prefix(['[', '('])?.trim_end().strip_suffix([']', ')'])?;
    Some((&text[..open], inner.trim()))
}

/// `height_mm`, `Height mm`, `height, mm`, `stiffness_n_mm`: the unit follows a known name.
fn suffixed(text: &str) -> Option<Heading> {
    let places = text.char_indices().filter(|(_, c)| !c.is_alphanumeric()).map(|(at, c)| (at, at + c.len_utf8()));
    // From the end: the longest name wins.
    places.collect::<Vec<_>>().into_iter().rev().find_map(|(end, start)| {
        let spec = named(&canonical(&text[..end]))?;
        let dimension = match spec.holds {
            Holds::Quantity(dimension) => dimension,
            Holds::Range => Dimension::Ratio,
            _ => return None,
        };
        let unit = text[start..].trim();
        let slashed = unit.replacen(['_', ' '], "/", 1);
        let found = lookup(unit).or_else(|| lookup(&slashed)).filter(|unit| unit.dimension == dimension)?;
        Some(Heading::Ours(spec.column, Some(found)))
    })
}

/// A hint for a heading that probably means a column that freestand reads.
pub(super) fn meant(text: &str) -> Option<String> {
    let text = text.trim();
    if text.is_empty() || text.len() > MAX_HEADING_BYTES {
        return None;
    }
    let name = canonical(bracketed(text).map_or(text, |(name, _)| name));
    let others = [
        ("weight", "if it is the mass, rename it mass; a weight is a force"),
        ("length", "if it is a horizontal size, rename it thickness or width"),
        ("level", "if it is the height of the floor over the height of the building, rename it level_ratio"),
    ];
    if let Some((_, hint)) = others.iter().find(|(other, _)| *other == name) {
        return Some((*hint).to_owned());
    }
    let names: Vec<&str> = COLUMNS.iter().map(|spec| spec.name).collect();
    let near = freestand_input::words::nearest(&name, &names)?;
    // Short words resemble too many names.
    (name.chars().count() > 3).then(|| format!("did you mean {near}?"))
}

/// The letters of a column in a spreadsheet, counted from 0: `A`, `B` … `Z`, `AA` …
pub(super) fn letters(index: usize) -> String {
    let mut out = Vec::new();
    let mut rest = index + 1;
    while rest > 0 {
        let digit = (rest - 1) % 26;
        out.push(b'A' + digit as u8);
        rest = (rest - 1 - digit) / 26;
    }
    out.iter().rev().map(|&byte| char::from(byte)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_the_order_of_the_columns() {
        for (index, spec) in COLUMNS.iter().enumerate() {
            assert_eq!(spec.column as usize, index, "{}", spec.name);
            assert_eq!(canonical(spec.name), spec.name);
            if let Holds::Quantity(dimension) = spec.holds {
                assert!(spec.unit.is_empty() == (dimension == Dimension::Ratio));
                assert!(spec.unit.is_empty() || lookup(spec.unit).is_some_and(|unit| unit.dimension == dimension));
            }
        }
    }

    #[test]
    fn headings_are_recognised_with_their_units() {
        let mm = lookup("mm");
        for text in ["height [mm]", "Height (mm)", "HEIGHT_mm", "height mm", "Height, mm", " height[ mm ] "] {
            assert_eq!(heading(text), Heading::Ours(Column::Height, mm), "{text}");
        }
        let cases = [
            ("Depth [cm]", Column::Thickness, "cm"),
            ("mass_kg", Column::Mass, "kg"),
            ("Base Width (m)", Column::BaseWidth, "m"),
            ("stiffness_n_mm", Column::Stiffness, "N/mm"),
            ("stiffness_N_m", Column::Stiffness, "N/m"),
            ("pad stiffness [kN/m]", Column::PadStiffness, "kN/m"),
            ("tolerance_g", Column::Tolerance, "g"),
            ("tolerance [m/s²]", Column::Tolerance, "m/s2"),
            ("tolerance_m_s2", Column::Tolerance, "m/s2"),
            ("tolerance_duration_ms", Column::ToleranceDuration, "ms"),
            ("tolerance velocity change m/s", Column::ToleranceVelocityChange, "m/s"),
            ("accepted [%]", Column::Accepted, "%"),
            ("level_ratio %", Column::LevelRatio, "%"),
            ("Friction (%)", Column::Friction, "%"),
        ];
        for (text, column, unit) in cases {
            assert_eq!(heading(text), Heading::Ours(column, lookup(unit)), "{text}");
        }
        for (text, column) in [
            ("Nonstructural Item", Column::Item),
            ("LS", Column::LifeSafety),
            ("Property Loss (PL)", Column::Property),
            ("level_ratio (0 ground, 1 roof)", Column::LevelRatio),
            ("Notes (photo no.)", Column::Notes),
            ("Pads per edge", Column::PadsPerEdge),
            ("mass", Column::Mass),
        ] {
            assert_eq!(heading(text), Heading::Ours(column, None), "{text}");
        }
        for text in ["", "serial number", "height of the table", "widthwise", "mass_st", "item_kg"] {
            assert_eq!(heading(text), Heading::Other, "{text}");
        }
        assert_eq!(heading("height [px]"), Heading::BadUnit(Column::Height, "px".to_owned()));
        assert_eq!(heading("mass (g)"), Heading::BadUnit(Column::Mass, "g".to_owned()));
    }

    #[test]
    fn near_names_are_noticed() {
        assert_eq!(meant("hieght [mm]").as_deref(), Some("did you mean height?"));
        assert_eq!(meant("Tolerence").as_deref(), Some("did you mean tolerance?"));
        assert!(meant("weight (N)").is_some_and(|hint| hint.contains("mass")));
        assert_eq!(meant("serial number"), None);
        assert_eq!(meant("no"), None);
    }

    #[test]
    fn columns_have_letters() {
        let named = [0, 25, 26, 51, 52, 701, 702, 16_383].map(letters);
        assert_eq!(named, ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA", "XFD"]);
    }
}
