//! The columns of an inventory: their names, what they hold, and what they mean.

use freestand_input::quantity::Dimension;

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

/// How much a list needs a column.
enum Need {
    /// A file must have it.
    Required,
    /// The template has it.
    Usual,
    /// In place of others, or seldom.
    Alternative,
}

/// A column with its name, what it holds, its unit in the template, whether a list needs it, its meaning and an example.
macro_rules! columns {
    ($($column:ident $name:literal $holds:expr, $unit:literal $need:ident $meaning:literal $example:literal;)*) => {
        /// A column that freestand reads.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Column {
            $(#[doc = $meaning] $column,)*
        }

        /// All columns, in the order of the template and of [`Column`].
        pub static COLUMNS: [ColumnSpec; 56] = [$(ColumnSpec {
            column: Column::$column,
            name: $name,
            holds: $holds,
            unit: $unit,
            is_required: matches!(Need::$need, Need::Required),
            is_in_template: !matches!(Need::$need, Need::Alternative),
            meaning: $meaning,
            example: $example,
        },)*];
    };
}

use Dimension::{Acceleration, Length, Mass, Ratio, Stiffness, Time, Velocity};
use Holds::{Answer, Count, Quantity, Range, Rating, Sizes, Text};

columns! {
    Id "id" Text, "" Usual
        "Identifier of the object, unique in the file; without it the row number is used" "ward3-07";
    Item "item" Text, "" Usual "What it is" "instrument cabinet";
    Quantity "quantity" Count, "" Usual "How many such objects there are; empty: 1" "2";
    Priority "priority" Text, "" Usual "Rank given by the owner, in any form" "1";
    Location "location" Text, "" Usual "Where it is, in words" "east wing";
    Building "building" Text, "" Usual "Building" "Block A";
    Floor "floor" Text, "" Usual "Name of the floor" "Level 3";
    Room "room" Text, "" Usual "Room" "3.12";
    LifeSafety "life_safety" Rating, "" Usual "FEMA E-74, LS: risk that somebody is hurt (H, M or L)" "H";
    Property "property" Rating, "" Usual "FEMA E-74, PL: risk of a loss of property (H, M or L)" "M";
    Function "function" Rating, "" Usual "FEMA E-74, FL: risk that work stops (H, M or L)" "M";
    LevelRatio "level_ratio" Quantity(Ratio), "" Required
        "Height of its floor over the height of the building: 0 ground, 1 roof" "0.5";
    Height "height" Quantity(Length), "mm" Required "Height" "1800";
    Thickness "thickness" Quantity(Length), "mm" Required
        "Horizontal size in the plane of rocking, usually the shorter side; the heading depth is accepted too" "450";
    Width "width" Quantity(Length), "mm" Usual
        "Horizontal size across the thickness; empty: rocking is computed about one axis only" "900";
    BaseThickness "base_thickness" Quantity(Length), "mm" Usual
        "Distance between the feet in the direction of the thickness; empty: the thickness" "400";
    BaseWidth "base_width" Quantity(Length), "mm" Usual
        "Distance between the feet in the direction of the width; empty: the width" "850";
    CgHeight "cg_height" Quantity(Length), "mm" Usual "Height of the centre of gravity; empty: half the height" "800";
    Mass "mass" Quantity(Mass), "kg" Usual "Mass; without it no shock can be computed" "140";
    Stiffness "stiffness" Quantity(Stiffness), "N/mm" Usual
        "Stiffness of everything under one edge (or give pad_stiffness with pads_per_edge, or cushion)" "4380";
    PadStiffness "pad_stiffness" Quantity(Stiffness), "N/mm" Usual "Stiffness of one pad or foot" "2190";
    PadsPerEdge "pads_per_edge" Count, "" Usual "Number of pads under one edge: a cabinet on four feet has 2" "2";
    SeriesStiffness "series_stiffness" Quantity(Stiffness), "N/mm" Usual
        "Stiffness of a layer in series with the pads: legs, floor covering" "20000";
    Cushion "cushion" Text, "" Usual "Entry of the cushion library, in place of a stiffness" "";
    PadThickness "pad_thickness" Quantity(Length), "mm" Usual
        "Thickness of the pad, for the check against bottoming" "10";
    Tolerance "tolerance" Quantity(Acceleration), "g" Usual
        "Peak acceleration that it withstands; without a tolerance only overturning is assessed" "5";
    ToleranceDuration "tolerance_duration" Quantity(Time), "ms" Usual "Duration of the half-sine of that peak" "11";
    ToleranceVelocityChange "tolerance_velocity_change" Quantity(Velocity), "m/s" Usual
        "Velocity change below which no peak causes damage" "0.9";
    ToleranceEdgeLift "tolerance_edge_lift" Quantity(Length), "mm" Usual
        "Uplift from which it may fall back without damage" "50";
    ToleranceEntry "tolerance_entry" Text, "" Usual
        "Entry of the tolerance library, in place of the other tolerance columns" "";
    Restitution "restitution" Quantity(Ratio), "" Usual
        "Angular velocity after an impact over the one before, above 0 and up to 1; empty: Housner's" "0.9";
    RestitutionFactor "restitution_factor" Quantity(Ratio), "" Usual "Factor on Housner's restitution" "0.95";
    Friction "friction" Range, "" Usual "Coefficient of friction on the floor, one value or a range" "0.3-0.5";
    Accepted "accepted" Quantity(Ratio), "" Usual
        "Probability of overturning or damage that the owner accepts; empty: that of the study" "10 %";
    Questions "questions" Text, "" Usual
        "What the verdict rests on: falls, or falls+shock; empty: shock too where a tolerance is given or \
         the loss of function or property is rated high" "falls";
    Anchored "anchored" Answer, "" Usual
        "Whether it is anchored: yes or no; an anchored object is listed and not rocked" "no";
    RestsOn "rests_on" Text, "" Usual "What it stands on, in words; or its feet as points from the middle of its outline: -200 mm, -150 mm; 200 mm, \
         -150 mm; 0 mm, 180 mm" "four levelling feet";
    WallGap "wall_gap" Quantity(Length), "mm" Usual
        "Distance from its back to the wall; 0: it touches; empty: there is no wall" "50";
    NeighbourGap "neighbour_gap" Quantity(Length), "mm" Usual
        "Distance to what stands on either side of it; empty: nothing does" "20";
    WallHeight "wall_height" Quantity(Length), "mm" Alternative
        "Height of that wall or neighbour; empty: taller than the object" "1100";
    WallStiffness "wall_stiffness" Quantity(Stiffness), "N/mm" Alternative
        "Stiffness of the wall where the top of the object strikes it" "2000";
    WallRestitution "wall_restitution" Quantity(Ratio), "" Alternative
        "Angular velocity after an impact at the wall over the one before, from 0 to below 1; empty: drawn \
         from 0 to 0.5" "0.2";
    Casters "casters" Holds::Casters, "" Usual "Casters: no, free or braked" "no";
    RollingResistance "rolling_resistance" Quantity(Ratio), "" Alternative
        "Resistance of its free casters over its weight; empty: 0.02" "0.02";
    Clearance "clearance" Quantity(Length), "mm" Usual
        "How far it may slide or roll before it strikes something" "400";
    UpperHeight "upper_height" Quantity(Length), "mm" Alternative
        "Height of what stands on the object, such as a statue on its pedestal" "900";
    UpperThickness "upper_thickness" Quantity(Length), "mm" Alternative
        "Thickness of what stands on the object" "300";
    UpperMass "upper_mass" Quantity(Mass), "kg" Alternative "Mass of what stands on the object" "60";
    Notes "notes" Text, "" Usual "Notes" "photo 12";
    Dimensions "dimensions" Sizes, "" Alternative
        "Height, width and depth in one cell, in place of their own columns" "1800 x 600 x 450 mm";
    Shape "shape" Text, "" Alternative
        "Shape of its base: box, cylinder where it is round, or polygon:8 with its number of corners" "cylinder";
    Diameter "diameter" Quantity(Length), "mm" Alternative
        "Diameter of a round base, or of the circle through the corners of a polygon, in place of thickness and width"
        "400";
    Scan "scan" Text, "" Alternative
        "Scan of it in the folder of the list (OBJ, STL, PLY, binary glTF; z upward), in place of its sizes"
        "bust.glb";
    ScanUnit "scan_unit" Text, "" Alternative "Unit of length of that scan: m, cm, mm, in or ft" "mm";
    ScanBase "scan_base" Text, "" Alternative
        "Underside of that scan: measured to less than 1 mm, or flat; empty: flat" "measured";
    Unit "unit" Text, "" Alternative
        "Unit of the bare sizes or of the bare mass of the row, where their headings state none" "cm";
}

impl Column {
    /// Its specification.
    pub(super) fn spec(self) -> &'static ColumnSpec {
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
