//! The library of restraints: what each may hold, how, how strong it is, and what it costs.

use std::path::Path;

use strum::{IntoStaticStr, VariantArray};

use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;

use super::Confidence;
use super::collection::{Library, Shelf};
use super::reader::RowReader;
use super::table::{Column, Row, Table};

/// The columns of a library of restraints.
const RESTRAINT_COLUMNS: [Column; 21] = [
    Column::text("id").needed(),
    Column::text("item").needed(),
    Column::text("kind").needed(),
    Column::text("for").needed(),
    Column::text("hold").needed(),
    Column::number("period", Dimension::Time),
    Column::number("height", Dimension::Ratio),
    Column::number("capacity", Dimension::Force),
    Column::number("beta", Dimension::Ratio),
    Column::number("anchors", Dimension::Ratio),
    Column::text("capacity_source"),
    Column::text("capacity_confidence"),
    Column::number("price_low", Dimension::Ratio).needed(),
    Column::number("price_high", Dimension::Ratio).needed(),
    Column::text("currency").needed(),
    Column::number("fitter_minutes", Dimension::Ratio),
    Column::number("fitter_hour", Dimension::Ratio),
    Column::text("price_source").needed(),
    Column::text("price_year"),
    Column::text("price_confidence").needed(),
    Column::text("note"),
];

/// β of a capacity whose row has none, an assumption.
pub const ASSUMED_BETA: f64 = 0.3;

/// What a restraint is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum RestraintKind {
    /// Straps at the top.
    Strap,
    /// Angles at the top.
    Bracket,
    /// Anchors at the base.
    BasePlate,
    /// Chains around cylinders.
    Chain,
    /// Wheels that no longer roll.
    WheelLock,
    /// A tether to a point on the wall.
    Tether,
    /// Softer pads under the feet.
    Pad,
    /// Lips in front of shelves.
    ShelfLip,
}

impl RestraintKind {
    /// The name in files and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// How a restraint acts on an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// It lets the object not move at all.
    Rigid,
    /// The held object is an oscillator of this period \[s\].
    Flexible(f64),
    /// The object moves until the slack is taken up, and then is stopped by an impact.
    Slack,
    /// Its wheels no longer roll.
    Lock,
    /// It lands on softer pads.
    Pad,
    /// It holds what is on the object, not the object.
    Contents,
}

/// A hold without its period, by its name in files.
#[derive(Clone, Copy, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
enum HoldWord {
    Rigid,
    Flexible,
    Slack,
    Lock,
    Pad,
    Contents,
}

/// What a restraint may be used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum HoldsWhat {
    /// Gas cylinders.
    Cylinder,
    /// What stands before a wall, without casters.
    AtWall,
    /// What stands on the floor without casters.
    OnFloor,
    /// What stands on casters.
    OnCasters,
}

/// One restraint of the library.
#[derive(Debug, Clone, PartialEq)]
pub struct RestraintEntry {
    /// Unique, in lower case.
    pub id: String,
    /// What it is.
    pub item: String,
    /// Its kind.
    pub kind: RestraintKind,
    /// What it may be used for.
    pub holds: Vec<HoldsWhat>,
    /// How it acts.
    pub hold: Hold,
    /// Height of the bracket over that of the object; at the base this has no meaning.
    pub height_ratio: f64,
    /// Median of its capacity; `None`: not known, and nothing is calculated \[N\].
    pub capacity_n: Option<f64>,
    /// Standard deviation of the logarithm of its capacity.
    pub beta: f64,
    /// Whether nobody stated β.
    pub beta_is_assumed: bool,
    /// How many anchors share its force: screws in studs, anchors in concrete; `None`: not known.
    pub anchors: Option<u16>,
    /// Where the capacity comes from.
    pub capacity_source: String,
    /// How far it can be trusted; `None`: there is none.
    pub capacity_confidence: Option<Confidence>,
    /// Its price, without work.
    pub price: (f64, f64),
    /// The currency of its prices.
    pub currency: String,
    /// Work for one object; `None`: not known \[min\].
    pub fitter_minutes: Option<f64>,
    /// What an hour of work costs; `None`: not known.
    pub fitter_hour: Option<f64>,
    /// Where the prices come from.
    pub price_source: String,
    /// Their year.
    pub price_year: String,
    /// How far they can be trusted.
    pub price_confidence: Confidence,
    /// Notes.
    pub note: String,
    /// `built-in`, or the user's file.
    pub origin: String,
}

/// The height of a bracket where a row has none, over that of the object: that of `restrain`.
const HEIGHT_RATIO: f64 = 0.9;

/// The most anchors of one restraint.
const MOST_ANCHORS: u16 = 100;

impl RestraintEntry {
    fn read(table: &Table, row: &Row, origin: &str) -> Result<Self, Problems> {
        let mut reader = RowReader::new(table, row);
        let id = reader.id();
        let item = reader.needed("item");
        let kind = reader.word("kind", RestraintKind::VARIANTS);
        let word = reader.word("hold", HoldWord::VARIANTS);
        let holds = reader.words("for", HoldsWhat::VARIANTS);
        let period_s = reader.positive("period", Dimension::Time);
        let hold = match (word, period_s) {
            (Some(HoldWord::Flexible), Some(period_s)) => Hold::Flexible(period_s),
            (Some(HoldWord::Flexible), None) => {
                let hint = "write the period of the held object, such as 0.15 s";
                reader.note("period", "a flexible hold needs one", hint);
                Hold::Slack
            }
            (Some(HoldWord::Slack), _) | (None, _) => Hold::Slack,
            (Some(HoldWord::Rigid), _) => Hold::Rigid,
            (Some(HoldWord::Lock), _) => Hold::Lock,
            (Some(HoldWord::Pad), _) => Hold::Pad,
            (Some(HoldWord::Contents), _) => Hold::Contents,
        };
        let height_ratio = reader.positive("height", Dimension::Ratio);
        if height_ratio.is_some_and(|height| height > 1.0) {
            let hint = "give the height of the bracket over that of the object, such as 0.9";
            reader.note("height", "is above the object", hint);
        }
        let capacity_n = reader.positive("capacity", Dimension::Force);
        let beta = reader.beta("beta");
        let anchors = reader.positive("anchors", Dimension::Ratio);
        if anchors.is_some_and(|count| count.fract() != 0.0 || count > f64::from(MOST_ANCHORS)) {
            let hint = format!("write a whole number up to {MOST_ANCHORS}, or leave it empty");
            reader.note("anchors", "is not a number of anchors", &hint);
        }
        let anchors = anchors.map(|count| count.min(f64::from(MOST_ANCHORS)) as u16);
        let capacity_confidence =
            capacity_n.and_then(|_| reader.word("capacity_confidence", Confidence::VARIANTS));
        let [low, high] = ["price_low", "price_high"].map(|column| {
            let price = reader.positive(column, Dimension::Ratio);
            if price.is_none() && reader.text(column).is_empty() {
                reader.note(column, "is empty", "every restraint needs its prices");
            }
            price.unwrap_or(1.0)
        });
        if low > high {
            reader.note("price_high", "is below price_low", "swap the two values");
        }
        let currency = reader.needed("currency");
        if !currency.is_empty() && !crate::cost_columns::is_currency(&currency) {
            reader.note(
                "currency",
                "is not a currency",
                "write its code, such as NZD",
            );
        }
        let entry = Self {
            id,
            item,
            kind: kind.unwrap_or(RestraintKind::Strap),
            holds: holds.unwrap_or_default(),
            hold,
            height_ratio: height_ratio.unwrap_or(HEIGHT_RATIO),
            capacity_n,
            beta: beta.unwrap_or(ASSUMED_BETA),
            beta_is_assumed: beta.is_none(),
            anchors,
            capacity_source: reader.text("capacity_source"),
            capacity_confidence,
            price: (low, high),
            currency: crate::cost_columns::code(&currency).to_owned(),
            fitter_minutes: reader.positive("fitter_minutes", Dimension::Ratio),
            fitter_hour: reader.positive("fitter_hour", Dimension::Ratio),
            price_source: reader.needed("price_source"),
            price_year: reader.text("price_year"),
            price_confidence: reader
                .word("price_confidence", Confidence::VARIANTS)
                .unwrap_or(Confidence::Recalled),
            note: reader.text("note"),
            origin: origin.to_owned(),
        };
        reader.problems.finish(Some(entry))
    }

    /// What it costs for one object, with the work where this is known: the low end, the middle, and the high end,
    /// in its currency.
    pub fn cost(&self) -> [f64; 3] {
        let work = self.work().unwrap_or(0.0);
        let (low, high) = self.price;
        [low, 0.5 * (low + high), high].map(|price| price + work)
    }

    /// What the work for one object costs, in its currency; `None`: not known.
    pub fn work(&self) -> Option<f64> {
        Some(self.fitter_minutes? / 60.0 * self.fitter_hour?)
    }

    /// Whether it is a built-in one, whose prices are rough.
    pub fn is_builtin(&self) -> bool {
        self.origin == super::collection::BUILT_IN
    }
}

/// The library of restraints.
pub type RestraintLibrary = Library<RestraintEntry>;

static SHELF: Shelf<RestraintEntry> = Shelf {
    name: "restraint",
    columns: &RESTRAINT_COLUMNS,
    builtin: include_bytes!("restraints.csv"),
    read: RestraintEntry::read,
    id: |entry| &entry.id,
    texts: |entry| vec![&entry.id, &entry.item, &entry.note],
};

impl RestraintLibrary {
    /// The built-in restraints, and those of a file, which replace built-in ones with the same id.
    ///
    /// # Errors
    /// All problems of the file, with line and column.
    pub fn restraints(path: Option<&Path>) -> Result<Self, Problems> {
        Self::new(&SHELF).with_file(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_builtin_restraints_are_read_whole() {
        let library = RestraintLibrary::restraints(None).unwrap();
        let rows = include_str!("restraints.csv").lines().count() - 1;
        assert_eq!(library.entries().len(), rows);
        for entry in library.entries() {
            // A capacity says where it comes from; a restraint without a hold has none.
            assert!(
                entry.capacity_n.is_none() || !entry.capacity_source.is_empty(),
                "{}",
                entry.id
            );
            let has_force = matches!(entry.hold, Hold::Rigid | Hold::Flexible(_) | Hold::Slack);
            assert!(has_force || entry.capacity_n.is_none(), "{}", entry.id);
            assert!(!entry.holds.is_empty() && entry.is_builtin());
        }
    }

    /// 20 to 50 with three quarters of an hour at 75.
    #[test]
    fn a_cost_has_its_work() {
        let library = RestraintLibrary::restraints(None).unwrap();
        let strap = library.get("wall-strap").unwrap();
        assert_eq!(strap.cost(), [76.25, 91.25, 106.25]);
        assert!(strap.beta_is_assumed && strap.beta == ASSUMED_BETA);
    }

    #[test]
    fn what_is_wrong_with_a_row_is_told_at_once() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("mine.csv");
        let rows = "id,item,kind,for,hold,beta,price_low,price_high,currency,price_source,price_confidence\n\
                    a,strap,rope,at-wall,flexible,30,9,5,dollars,shop,stated\n";
        std::fs::write(&path, rows).unwrap();
        let error = RestraintLibrary::restraints(Some(&path)).unwrap_err();
        let told: Vec<String> = error.into_iter().map(|one| one.message).collect();
        for column in ["kind", "period", "beta", "price_high", "currency"] {
            let start = format!("column {column}:");
            assert!(told.iter().any(|one| one.starts_with(&start)), "{told:?}");
        }
    }
}
