//! The columns of an inventory: their names, what they hold, and what they mean.

use freestand_input::quantity::Dimension;

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
    /// Whether it is anchored.
    Anchored,
    /// What it stands on.
    RestsOn,
    /// `wall_gap`
    WallGap,
    /// `neighbour_gap`
    NeighbourGap,
    /// `wall_height`
    WallHeight,
    /// `wall_stiffness`
    WallStiffness,
    /// `wall_restitution`
    WallRestitution,
    /// `casters`
    Casters,
    /// `rolling_resistance`
    RollingResistance,
    /// `clearance`
    Clearance,
    /// `upper_height`
    UpperHeight,
    /// `upper_thickness`
    UpperThickness,
    /// `upper_mass`
    UpperMass,
    /// `notes`
    Notes,
    /// Height, width and depth in one cell.
    Dimensions,
    /// What its base is: a rectangle, or round.
    Shape,
    /// The diameter of a round base.
    Diameter,
    /// `unit`
    Unit,
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
    /// Yes or no.
    Answer,
    /// Whether it stands on casters, and whether they are braked.
    Casters,
    /// Height, width and depth: `1800 x 600 x 450 mm`.
    Sizes,
}

/// The specification of a column.
#[derive(Debug, Clone, Copy)]
pub struct ColumnSpec {
    /// The column.
    pub column: Column,
    /// Its name in files and messages.
    pub name: &'static str,
    /// What its cells hold.
    pub holds: Holds,
    /// Its unit in the template.
    pub unit: &'static str,
    /// Whether a file must have it.
    pub is_required: bool,
    /// Whether the template has it.
    pub is_in_template: bool,
    /// What it means, for people.
    pub meaning: &'static str,
    /// An example of a cell.
    pub example: &'static str,
}

const fn text(column: Column, name: &'static str) -> ColumnSpec {
    ColumnSpec {
        column,
        name,
        holds: Holds::Text,
        unit: "",
        is_required: false,
        is_in_template: true,
        meaning: "",
        example: "",
    }
}

const fn quantity(
    column: Column,
    name: &'static str,
    dimension: Dimension,
    unit: &'static str,
) -> ColumnSpec {
    ColumnSpec {
        holds: Holds::Quantity(dimension),
        unit,
        ..text(column, name)
    }
}

const fn said(spec: ColumnSpec, meaning: &'static str, example: &'static str) -> ColumnSpec {
    ColumnSpec {
        meaning,
        example,
        ..spec
    }
}

const fn required(spec: ColumnSpec) -> ColumnSpec {
    ColumnSpec {
        is_required: true,
        ..spec
    }
}

const fn alternative(spec: ColumnSpec) -> ColumnSpec {
    ColumnSpec {
        is_in_template: false,
        ..spec
    }
}

const fn of(spec: ColumnSpec, holds: Holds) -> ColumnSpec {
    ColumnSpec { holds, ..spec }
}

use Dimension::{Acceleration, Length, Mass, Ratio, Stiffness, Time, Velocity};

/// All columns, in the order of the template and of [`Column`].
pub static COLUMNS: [ColumnSpec; 53] = [
    said(
        text(Column::Id, "id"),
        "Identifier of the object, unique in the file; without it the row number is used",
        "ward3-07",
    ),
    said(
        text(Column::Item, "item"),
        "What it is",
        "instrument cabinet",
    ),
    said(
        of(text(Column::Quantity, "quantity"), Holds::Count),
        "How many such objects there are; empty: 1",
        "2",
    ),
    said(
        text(Column::Priority, "priority"),
        "Rank given by the owner, in any form",
        "1",
    ),
    said(
        text(Column::Location, "location"),
        "Where it is, in words",
        "east wing",
    ),
    said(text(Column::Building, "building"), "Building", "Block A"),
    said(text(Column::Floor, "floor"), "Name of the floor", "Level 3"),
    said(text(Column::Room, "room"), "Room", "3.12"),
    said(
        of(text(Column::LifeSafety, "life_safety"), Holds::Rating),
        "FEMA E-74, LS: risk that somebody is hurt (H, M or L)",
        "H",
    ),
    said(
        of(text(Column::Property, "property"), Holds::Rating),
        "FEMA E-74, PL: risk of a loss of property (H, M or L)",
        "M",
    ),
    said(
        of(text(Column::Function, "function"), Holds::Rating),
        "FEMA E-74, FL: risk that work stops (H, M or L)",
        "M",
    ),
    required(said(
        quantity(Column::LevelRatio, "level_ratio", Ratio, ""),
        "Height of its floor over the height of the building: 0 ground, 1 roof",
        "0.5",
    )),
    required(said(
        quantity(Column::Height, "height", Length, "mm"),
        "Height",
        "1800",
    )),
    required(said(
        quantity(Column::Thickness, "thickness", Length, "mm"),
        "Horizontal size in the plane of rocking, usually the shorter side; the heading depth is accepted too",
        "450",
    )),
    said(
        quantity(Column::Width, "width", Length, "mm"),
        "Horizontal size across the thickness; empty: rocking is computed about one axis only",
        "900",
    ),
    said(
        quantity(Column::BaseThickness, "base_thickness", Length, "mm"),
        "Distance between the feet in the direction of the thickness; empty: the thickness",
        "400",
    ),
    said(
        quantity(Column::BaseWidth, "base_width", Length, "mm"),
        "Distance between the feet in the direction of the width; empty: the width",
        "850",
    ),
    said(
        quantity(Column::CgHeight, "cg_height", Length, "mm"),
        "Height of the centre of gravity; empty: half the height",
        "800",
    ),
    said(
        quantity(Column::Mass, "mass", Mass, "kg"),
        "Mass; without it no shock can be computed",
        "140",
    ),
    said(
        quantity(Column::Stiffness, "stiffness", Stiffness, "N/mm"),
        "Stiffness of everything under one edge (or give pad_stiffness with pads_per_edge, or cushion)",
        "4380",
    ),
    said(
        quantity(Column::PadStiffness, "pad_stiffness", Stiffness, "N/mm"),
        "Stiffness of one pad or foot",
        "2190",
    ),
    said(
        of(text(Column::PadsPerEdge, "pads_per_edge"), Holds::Count),
        "Number of pads under one edge: a cabinet on four feet has 2",
        "2",
    ),
    said(
        quantity(
            Column::SeriesStiffness,
            "series_stiffness",
            Stiffness,
            "N/mm",
        ),
        "Stiffness of a layer in series with the pads: legs, floor covering",
        "20000",
    ),
    said(
        text(Column::Cushion, "cushion"),
        "Entry of the cushion library, in place of a stiffness",
        "",
    ),
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
        quantity(
            Column::ToleranceVelocityChange,
            "tolerance_velocity_change",
            Velocity,
            "m/s",
        ),
        "Velocity change below which no peak causes damage",
        "0.9",
    ),
    said(
        quantity(
            Column::ToleranceEdgeLift,
            "tolerance_edge_lift",
            Length,
            "mm",
        ),
        "Uplift from which it may fall back without damage",
        "50",
    ),
    said(
        text(Column::ToleranceEntry, "tolerance_entry"),
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
        of(text(Column::Friction, "friction"), Holds::Range),
        "Coefficient of friction on the floor, one value or a range",
        "0.3-0.5",
    ),
    said(
        quantity(Column::Accepted, "accepted", Ratio, ""),
        "Probability of overturning or damage that the owner accepts; empty: that of the study",
        "10 %",
    ),
    said(
        text(Column::Questions, "questions"),
        "What the verdict rests on: falls, or falls+shock; empty: shock too where a tolerance is given or the loss of \
         function or property is rated high",
        "falls",
    ),
    said(
        of(text(Column::Anchored, "anchored"), Holds::Answer),
        "Whether it is anchored: yes or no; an anchored object is listed and not rocked",
        "no",
    ),
    said(
        text(Column::RestsOn, "rests_on"),
        "What it stands on, in words",
        "four levelling feet",
    ),
    said(
        quantity(Column::WallGap, "wall_gap", Length, "mm"),
        "Distance from its back to the wall; 0: it touches; empty: there is no wall",
        "50",
    ),
    said(
        quantity(Column::NeighbourGap, "neighbour_gap", Length, "mm"),
        "Distance to what stands on either side of it; empty: nothing does",
        "20",
    ),
    alternative(said(
        quantity(Column::WallHeight, "wall_height", Length, "mm"),
        "Height of that wall or neighbour; empty: taller than the object",
        "1100",
    )),
    alternative(said(
        quantity(Column::WallStiffness, "wall_stiffness", Stiffness, "N/mm"),
        "Stiffness of the wall where the top of the object strikes it",
        "2000",
    )),
    alternative(said(
        quantity(Column::WallRestitution, "wall_restitution", Ratio, ""),
        "Angular velocity after an impact at the wall over the one before, from 0 to below 1; empty: drawn from 0 to 0.5",
        "0.2",
    )),
    said(
        of(text(Column::Casters, "casters"), Holds::Casters),
        "Casters: no, free or braked",
        "no",
    ),
    alternative(said(
        quantity(Column::RollingResistance, "rolling_resistance", Ratio, ""),
        "Resistance of its free casters over its weight; empty: 0.02",
        "0.02",
    )),
    said(
        quantity(Column::Clearance, "clearance", Length, "mm"),
        "How far it may slide or roll before it strikes something",
        "400",
    ),
    alternative(said(
        quantity(Column::UpperHeight, "upper_height", Length, "mm"),
        "Height of what stands on the object, such as a statue on its pedestal",
        "900",
    )),
    alternative(said(
        quantity(Column::UpperThickness, "upper_thickness", Length, "mm"),
        "Thickness of what stands on the object",
        "300",
    )),
    alternative(said(
        quantity(Column::UpperMass, "upper_mass", Mass, "kg"),
        "Mass of what stands on the object",
        "60",
    )),
    said(text(Column::Notes, "notes"), "Notes", "photo 12"),
    alternative(said(
        of(text(Column::Dimensions, "dimensions"), Holds::Sizes),
        "Height, width and depth in one cell, in place of their own columns",
        "1800 x 600 x 450 mm",
    )),
    alternative(said(
        text(Column::Shape, "shape"),
        "Shape of its base: box, or cylinder where it is round",
        "cylinder",
    )),
    alternative(said(
        quantity(Column::Diameter, "diameter", Length, "mm"),
        "Diameter of a round base, in place of thickness and width",
        "400",
    )),
    alternative(said(
        text(Column::Unit, "unit"),
        "Unit of the bare sizes or of the bare mass of the row, where their headings state none",
        "cm",
    )),
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

    /// Whether an empty cell means that there is nothing, and not that a number is not known.
    pub(super) fn means_nothing_there(self) -> bool {
        matches!(
            self,
            Self::WallGap
                | Self::NeighbourGap
                | Self::Clearance
                | Self::UpperHeight
                | Self::UpperThickness
        )
    }
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
        for (place, spec) in COLUMNS.iter().enumerate() {
            assert_eq!(spec.column as usize, place, "{}", spec.name);
        }
    }

    #[test]
    fn columns_have_letters() {
        let named = [0, 25, 26, 51, 52, 701, 702, 16_383].map(letters);
        assert_eq!(named, ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA", "XFD"]);
    }
}
