//! What failures and options cost: the user's columns, never a default.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, parse_positive, shorten};

use crate::fragility::table::{Row, RowProblems, Table};
use crate::fragility::{Change, ChangedObject, ObjectCurves, UnusedColumn, load_curves};
use freestand_inventory::too_mild::TooMild;
use freestand_inventory::{
    Amounts, CellsRequest, Cost, Item, Rating, cost_name, costs_of_list, is_list, rating,
};
use strum::EnumCount;

const HINT: &str = "the columns are id, and quantity, repair_cost [AUD], replacement_cost [AUD], downtime [day], \
                    downtime_cost [AUD/day], casualty_probability, casualty_cost [AUD], accepted_annual_rate [1/yr], \
                    accepted_exceed_annual_rate [1/yr], floor, longitude, latitude";
/// The columns of an inventory. `item`, `building` and `location` are for readers only, and `anchored`
/// tells them why an object was not run.
const COLUMNS: [&str; 18] = [
    "id",
    "item",
    "building",
    "location",
    "anchored",
    "life_safety",
    "quantity",
    "repair_cost",
    "replacement_cost",
    "downtime",
    "downtime_cost",
    "casualty_probability",
    "casualty_cost",
    "accepted_annual_rate",
    "accepted_exceed_annual_rate",
    "floor",
    "longitude",
    "latitude",
];
/// The columns of a file of options.
const OPTION_COLUMNS: [&str; 9] = [
    "id",
    "option",
    "cost",
    "life",
    "median_factor",
    "curves",
    "stiffness",
    "base_thickness",
    "mass",
];
const OPTIONS_HINT: &str = "the columns are id, option, cost [AUD], perhaps life [yr], and one effect: median_factor, \
                            curves, or a change of stiffness [N/mm], base_thickness [mm] or mass [kg]";

/// The highest floor.
const MAX_FLOOR: u32 = 1000;

/// What the failures of one object cost, and how often they are accepted.
#[derive(Debug, Clone, PartialEq)]
pub struct CostRow {
    /// Identifier of the object.
    pub id: String,
    /// Its line in the file, from 1.
    pub line: usize,
    /// How many objects it stands for.
    pub quantity: f64,
    /// Whether the list states it; else it is 1.
    pub(crate) has_quantity: bool,
    /// Cost of a repair after its tolerance was exceeded.
    pub repair: Option<f64>,
    /// Cost of another one after it overturned.
    pub replacement: Option<f64>,
    /// Days without it after it overturned.
    pub(crate) downtime_days: Option<f64>,
    /// Cost of a day without it.
    pub(crate) downtime_cost: Option<f64>,
    /// Probability of a casualty where it overturns.
    pub casualty_probability: Option<f64>,
    /// Cost of a casualty.
    pub(crate) casualty_cost: Option<f64>,
    /// Accepted rate of overturning \[1/year\].
    pub(crate) accepted_rate: Option<f64>,
    /// Accepted rate of exceeding its tolerance \[1/year\].
    pub(crate) accepted_exceed_rate: Option<f64>,
    /// What it is.
    pub item: String,
    /// Its building.
    pub building: String,
    /// Its place.
    pub location: String,
    /// What the inventory says about its anchors.
    pub anchored: String,
    /// What its fall means for people.
    pub life_safety: Option<Rating>,
    /// 0: the ground.
    pub floor: Option<u32>,
    /// Longitude and latitude \[degrees\].
    pub site_deg: Option<(f64, f64)>,
}

impl CostRow {
    /// Cost of overturning of one object.
    pub(crate) fn overturned(&self) -> f64 {
        let product = |a: Option<f64>, b: Option<f64>| a.zip(b).map_or(0.0, |(a, b)| a * b);
        self.replacement.unwrap_or(0.0)
            + product(self.downtime_days, self.downtime_cost)
            + product(self.casualty_probability, self.casualty_cost)
    }

    /// Whether any cost is known.
    pub(crate) fn has_costs(&self) -> bool {
        self.repair.is_some()
            || self.replacement.is_some()
            || self.downtime_days.zip(self.downtime_cost).is_some()
            || self.casualty_probability.zip(self.casualty_cost).is_some()
    }

    /// Amounts that were not given.
    pub(crate) fn not_counted(&self) -> Vec<NotCounted> {
        let has_downtime = self.downtime_days.zip(self.downtime_cost).is_some();
        let has_casualties = self.casualty_probability.zip(self.casualty_cost).is_some();
        let parts = [
            (self.repair.is_some(), NotCounted::Repair),
            (self.replacement.is_some(), NotCounted::Replacement),
            (has_downtime, NotCounted::Downtime),
            (has_casualties, NotCounted::Casualties),
        ];
        let missing = parts.into_iter().filter(|(is_given, _)| !is_given);
        missing.map(|(_, part)| part).collect()
    }
}

/// A part of a loss that is not counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotCounted {
    /// No amount was given for a repair.
    Repair,
    /// No amount was given for another object.
    Replacement,
    /// No days or no amount were given for the time without it.
    Downtime,
    /// No probability or no amount was given for casualties.
    Casualties,
    /// Repairs are priced, but there is no curve of exceeding.
    RepairWithoutCurve,
    /// The rate of exceeding is not known.
    ExceedingOfUnknownRate,
    /// The rate of overturning is not known.
    OverturningOfUnknownRate,
    /// There is no curve of overturning.
    OverturningWithoutCurve,
}

impl NotCounted {
    /// Whether it is not counted because no amount was given.
    pub fn lacks_amount(self) -> bool {
        matches!(
            self,
            Self::Repair | Self::Replacement | Self::Downtime | Self::Casualties
        )
    }
}

/// The costs of an inventory.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Costs {
    /// The file.
    pub file: InputFile,
    /// The currency of all costs.
    pub(crate) currency: Option<String>,
    /// One for each object.
    pub rows: Vec<CostRow>,
    /// Objects whose runs would be too mild, by what a list says of them.
    pub(crate) too_mild: Vec<(String, TooMild)>,
    /// What to know beside them.
    pub doubts: Vec<CostDoubt>,
}

/// What to know beside costs and options.
#[derive(Debug, Clone, PartialEq, Eq, EnumCount)]
pub enum CostDoubt {
    /// What the reader of a list says of it.
    OfList(String),
    /// A table has columns that nothing reads.
    Unused {
        /// Its file.
        path: PathBuf,
        /// The columns.
        columns: Vec<UnusedColumn>,
    },
    /// Rows have no quantity, and count as one object.
    NoQuantity {
        /// Their file.
        path: PathBuf,
        /// How many.
        rows: usize,
    },
    /// A repair costs more than overturning.
    DearRepair {
        /// Its file.
        path: PathBuf,
        /// Its line, from 1.
        line: usize,
        /// The object.
        id: String,
    },
}

impl CostDoubt {
    /// The columns of a table that are not among `known`, if there are any.
    fn unused(table: &Table, known: &[&str]) -> Option<Self> {
        let columns = table.unused(known);
        (!columns.is_empty()).then(|| Self::Unused {
            path: table.path.clone(),
            columns,
        })
    }
}

/// The currency of a column, `AUD` of `[AUD]` and of `[AUD/day]`; all columns have the same.
fn currency_of(
    table: &Table,
    columns: &[(&str, &str)],
    known: Option<&str>,
) -> Result<Option<String>, Problem> {
    let mut currency = known.map(str::to_owned);
    for (name, per) in columns {
        let Some(heading) = table
            .column(name)
            .and_then(|column| table.headings.get(column))
        else {
            continue;
        };
        let unit = heading
            .unit
            .as_deref()
            .and_then(|unit| unit.strip_suffix(per))
            .map(str::trim);
        let is_currency = |unit: &&str| {
            !unit.is_empty()
                && unit
                    .chars()
                    .all(|c| c.is_alphanumeric() || "$€£¥_".contains(c))
        };
        let unit = unit.filter(is_currency).ok_or_else(|| {
            let message = format!("the column \"{name}\" states no currency");
            table
                .header_problem(message)
                .hint(format!("write {name} [AUD{per}]"))
        })?;
        match &currency {
            Some(other) if other != unit => {
                let message = format!(
                    "\"{name}\" is in {}, and other costs are in {}",
                    shorten(unit),
                    shorten(other)
                );
                return Err(table
                    .header_problem(message)
                    .hint("convert all costs to one currency"));
            }
            _ => currency = Some(unit.to_owned()),
        }
    }
    Ok(currency)
}

fn check_unit(table: &Table, name: &str, units: &[&str]) -> Result<(), Problem> {
    let heading = table
        .column(name)
        .and_then(|column| table.headings.get(column));
    match heading.map(|heading| heading.unit.as_deref()) {
        Some(unit) if !unit.is_some_and(|unit| units.contains(&unit)) => {
            let message = format!("the column \"{name}\" is not in {}", units[0]);
            Err(table
                .header_problem(message)
                .hint(format!("write {name} [{}]", units[0])))
        }
        _ => Ok(()),
    }
}

/// Reads the costs of an inventory.
///
/// # Errors
/// Two currencies; every row with a number below 0, or with an id that is missing or appears twice.
pub(crate) fn load_costs(path: &Path, list: &CellsRequest) -> Result<Costs, Problems> {
    let bytes = load(path)?;
    if !list.is_given() && is_table(&bytes, path) {
        return Ok(Costs {
            file: InputFile::new(path, &bytes),
            ..read_costs(&bytes, path)?
        });
    }
    costs_of_register(path, list)
}

/// Reads the costs of a list as people keep it.
///
/// # Errors
/// Two currencies, or a list that cannot be read.
pub(crate) fn costs_of_register(path: &Path, list: &CellsRequest) -> Result<Costs, Problems> {
    let file = InputFile::new(path, &load(path)?);
    let found = costs_of_list(path, list)?;
    let row = |(item, amounts): (Item, Amounts)| {
        let [repair, replacement, downtime_days, downtime_cost] = [
            Cost::Repair,
            Cost::Replacement,
            Cost::Downtime,
            Cost::DowntimeDay,
        ]
        .map(|cost| amounts.of(cost));
        let words = [&item.location, &item.floor, &item.room]
            .into_iter()
            .filter(|text| !text.is_empty());
        CostRow {
            line: usize::try_from(item.row).unwrap_or(0),
            quantity: f64::from(item.quantity),
            has_quantity: true,
            repair,
            replacement,
            downtime_days,
            downtime_cost,
            casualty_probability: amounts.of(Cost::CasualtyProbability),
            casualty_cost: amounts.of(Cost::Casualty),
            accepted_rate: amounts.of(Cost::AcceptedRate),
            accepted_exceed_rate: amounts.of(Cost::AcceptedExceedRate),
            anchored: if item.anchored == Some(true) {
                "yes".to_owned()
            } else {
                String::new()
            },
            life_safety: item.consequences.life_safety,
            floor: None,
            site_deg: amounts.of(Cost::Longitude).zip(amounts.of(Cost::Latitude)),
            location: words.map(String::as_str).collect::<Vec<_>>().join(", "),
            building: item.building,
            item: item.item,
            id: item.id,
        }
    };
    let rows: Vec<CostRow> = found.objects.into_iter().map(row).collect();
    let of_list = found.warnings.into_iter().map(CostDoubt::OfList);
    let doubts = dear(&rows, path).chain(of_list).collect();
    Ok(Costs {
        file,
        currency: found.currency,
        rows,
        too_mild: found.too_mild,
        doubts,
    })
}

/// Whether a file has the names of costs themselves; any other is read as a list as people keep it.
fn is_table(bytes: &[u8], path: &Path) -> bool {
    let is_workbook = bytes.starts_with(b"PK");
    match Table::read(bytes, path, HINT, &mut RowProblems::default()) {
        Ok(table) => {
            let has_costs = COLUMNS
                .iter()
                .any(|name| cost_name(name).is_some() && table.column(name).is_some());
            table.column("id").is_some() && (has_costs || table.unused(&COLUMNS).is_empty())
        }
        // What is wrong with a table is said of the table.
        Err(_) => !is_workbook && !is_list(path),
    }
}

/// That a repair costs more than a new object.
fn dear(rows: &[CostRow], path: &Path) -> impl Iterator<Item = CostDoubt> {
    let is_dear = |row: &&CostRow| {
        row.replacement.is_some() && row.repair.is_some_and(|cost| cost > row.overturned())
    };
    rows.iter()
        .filter(is_dear)
        .map(|row| CostDoubt::DearRepair {
            path: path.to_path_buf(),
            line: row.line,
            id: row.id.clone(),
        })
}

fn read_costs(bytes: &[u8], path: &Path) -> Result<Costs, Problems> {
    let mut rows = RowProblems::default();
    let table = Table::read(bytes, path, HINT, &mut rows)?;
    let mut problems = Problems::default();
    let id = problems.keep(table.needed("id"));
    let amounts = [
        ("repair_cost", ""),
        ("replacement_cost", ""),
        ("downtime_cost", "/day"),
        ("casualty_cost", ""),
    ];
    let currency = problems.keep(currency_of(&table, &amounts, None));
    problems.keep(check_unit(&table, "downtime", &["day", "days", "d"]));
    for name in ["accepted_annual_rate", "accepted_exceed_annual_rate"] {
        problems.keep(check_unit(&table, name, &["1/yr", "/yr", "1/year"]));
    }
    let (id, currency) = problems.finish(id.zip(currency))?;
    let mut known = HashMap::new();
    let rows = table.each_row(rows, |row, problems| {
        let name = problems.keep(new_name(&table, row, id, &mut known, "id"));
        let mut amount = |name: &str| problems.keep(table.optional(row, table.column(name)));
        let (quantity, repair, replacement) = (
            amount("quantity"),
            amount("repair_cost"),
            amount("replacement_cost"),
        );
        let (downtime_days, downtime_cost) = (amount("downtime"), amount("downtime_cost"));
        let casualty_cost = amount("casualty_cost");
        let casualty_probability = problems.keep(probability_of(&table, row));
        let mut rate = |name: &str| problems.keep(positive_of(&table, row, name));
        let (accepted_rate, accepted_exceed_rate) = (
            rate("accepted_annual_rate"),
            rate("accepted_exceed_annual_rate"),
        );
        let (floor, site_deg) = (
            problems.keep(floor_of(&table, row)),
            problems.keep(site_of(&table, row)),
        );
        let life_safety = problems.keep(rating_of(&table, row));
        let text = |name: &str| {
            table
                .column(name)
                .map_or(String::new(), |column| table.text(row, column).to_owned())
        };
        Some(CostRow {
            item: text("item"),
            building: text("building"),
            location: text("location"),
            anchored: text("anchored"),
            life_safety: life_safety?,
            id: name?,
            line: row.line,
            quantity: quantity?.unwrap_or(1.0),
            has_quantity: quantity?.is_some(),
            repair: repair?,
            replacement: replacement?,
            downtime_days: downtime_days?,
            downtime_cost: downtime_cost?,
            casualty_probability: casualty_probability?,
            casualty_cost: casualty_cost?,
            accepted_rate: accepted_rate?,
            accepted_exceed_rate: accepted_exceed_rate?,
            floor: floor?,
            site_deg: site_deg?,
        })
    })?;
    let mut doubts: Vec<CostDoubt> = CostDoubt::unused(&table, &COLUMNS).into_iter().collect();
    if let Some(quantity) = table.column("quantity") {
        let blank = table
            .rows
            .iter()
            .filter(|row| table.text(row, quantity).is_empty())
            .count();
        doubts.extend((blank > 0).then(|| CostDoubt::NoQuantity {
            path: path.to_path_buf(),
            rows: blank,
        }));
    }
    doubts.extend(dear(&rows, path));
    Ok(Costs {
        file: InputFile::new(path, bytes),
        currency,
        rows,
        too_mild: Vec::new(),
        doubts,
    })
}

/// The text of a cell, which no row above may have; `known` has the lines of the texts above.
fn new_name(
    table: &Table,
    row: &Row,
    column: usize,
    known: &mut HashMap<String, usize>,
    what: &str,
) -> Result<String, Problem> {
    let name = table.filled(row, column)?.to_owned();
    twice(
        table,
        row,
        column,
        known.insert(name.clone(), row.line),
        &format!("the {what} \"{}\"", shorten(&name)),
    )?;
    Ok(name)
}

fn twice(
    table: &Table,
    row: &Row,
    column: usize,
    above: Option<usize>,
    what: &str,
) -> Result<(), Problem> {
    above.map_or(Ok(()), |line| {
        let message = format!("{what} appears twice, first in line {line}");
        Err(table
            .cell_problem(row, column, &message)
            .hint("rename one of the two, or leave out one of the rows"))
    })
}

/// A number above 0; `None` without the column or in an empty cell.
fn positive_of(table: &Table, row: &Row, name: &str) -> Result<Option<f64>, Problem> {
    table
        .given(row, name)
        .map(|column| table.positive(row, column))
        .transpose()
}

/// High, medium or low, by the words of inventories.
fn rating_of(table: &Table, row: &Row) -> Result<Option<Rating>, Problem> {
    let Some(column) = table.given(row, "life_safety") else {
        return Ok(None);
    };
    let text = table.text(row, column);
    let found = match rating(text) {
        Some(2) => Some(Rating::High),
        Some(1) => Some(Rating::Medium),
        Some(_) => Some(Rating::Low),
        None => None,
    };
    found.map(Some).ok_or_else(|| {
        let message = format!("\"{}\" is not a rating", shorten(text));
        table
            .cell_problem(row, column, &message)
            .hint("write high, medium or low")
    })
}

fn probability_of(table: &Table, row: &Row) -> Result<Option<f64>, Problem> {
    let Some(column) = table.given(row, "casualty_probability") else {
        return Ok(None);
    };
    let probability = table.non_negative(row, column)?;
    if probability > 1.0 {
        let message = format!(
            "{} is not a probability: it is above 1",
            shorten(table.text(row, column))
        );
        return Err(table
            .cell_problem(row, column, &message)
            .hint("write a number from 0 to 1"));
    }
    Ok(Some(probability))
}

/// The number of a floor, from 0 for the ground.
fn floor_of(table: &Table, row: &Row) -> Result<Option<u32>, Problem> {
    let Some(column) = table.given(row, "floor") else {
        return Ok(None);
    };
    let text = table.text(row, column);
    let floor = text.parse::<u32>().ok().filter(|floor| *floor <= MAX_FLOOR);
    floor.map(Some).ok_or_else(|| {
        let message = format!("\"{}\" is not the number of a floor", shorten(text));
        table
            .cell_problem(row, column, &message)
            .hint("write 0 for the ground, 1 for the first floor above it")
    })
}

fn site_of(table: &Table, row: &Row) -> Result<Option<(f64, f64)>, Problem> {
    let degrees = |name: &str, most: f64| {
        table
            .given(row, name)
            .map(|column| table.degrees(row, column, most))
            .transpose()
    };
    match (degrees("longitude", 360.0)?, degrees("latitude", 90.0)?) {
        (Some(lon), Some(lat)) => Ok(Some((lon, lat))),
        (None, None) => Ok(None),
        (one, _) => {
            let (given, missing) = if one.is_some() {
                ("longitude", "latitude")
            } else {
                ("latitude", "longitude")
            };
            let message = format!("the row has a {given} but no {missing}");
            let column = table.column(given).unwrap_or(0);
            Err(table
                .cell_problem(row, column, &message)
                .hint("give both, in degrees, or neither"))
        }
    }
}

/// How an option changes the curves of an object.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Effect {
    /// All medians are multiplied.
    MedianFactor(f64),
    /// Other curves, such as those of the object that `freestand fragility --options` changed.
    Curves(ObjectCurves),
}

/// An option for one object: a pad, a strap, an anchor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OptionRow {
    /// Identifier of the object.
    pub id: String,
    /// Its line in the file, from 1.
    pub line: usize,
    /// Name of the option.
    pub option: String,
    /// What it costs once.
    pub cost: f64,
    /// After how long it is renewed \[years\]; `None`: never.
    pub(crate) life_years: Option<f64>,
    /// What it changes.
    pub effect: Effect,
}

/// The options of a file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Options {
    /// The file.
    pub file: InputFile,
    /// One for each object and option.
    pub rows: Vec<OptionRow>,
    /// The curves that options name, with their files.
    pub curves: Vec<(InputFile, ObjectCurves)>,
    /// What to know beside them.
    pub doubts: Vec<CostDoubt>,
}

/// Reads the options; `currency` is that of the costs, and `curves` those of all objects, with those of
/// changed objects as `ID/option`.
///
/// # Errors
/// Another currency; every row with no effect or more than one, with an option that appears twice,
/// or with a changed object without curves.
pub(crate) fn load_options(
    path: &Path,
    currency: Option<&str>,
    curves: &[ObjectCurves],
) -> Result<Options, Problems> {
    let bytes = load(path)?;
    let known: HashMap<&str, &ObjectCurves> =
        curves.iter().map(|one| (one.id.as_str(), one)).collect();
    let read = read_options(&bytes, path, currency, |object| {
        let found = known.get(object.curve_id.as_str()).copied().ok_or_else(|| {
            let wanted = shorten(&object.curve_id);
            let message = format!("the option changes the object itself, but no curves have the id \"{wanted}\"");
            let hint = "run freestand fragility with the inventory and these options, and give its fragility.csv or \
                        outcomes.csv here; or name a file of curves in the column curves";
            Problem::value(message, hint).in_file(&object.file).at_line(object.line)
        })?;
        Ok(Some(Effect::Curves(found.clone())))
    })?;
    let ReadOptions {
        rows,
        curves,
        doubts,
    } = read;
    Ok(Options {
        file: InputFile::new(path, &bytes),
        rows,
        curves,
        doubts,
    })
}

/// The objects that options change, of a file of options.
///
/// # Errors
/// As for the options of `risk`, or none that changes an object.
pub fn load_changed(path: &Path) -> Result<(InputFile, Vec<ChangedObject>), Problems> {
    let bytes = load(path)?;
    let mut objects: Vec<ChangedObject> = Vec::new();
    read_options(&bytes, path, None, |object| {
        objects.push(object);
        Ok(None)
    })?;
    if objects.is_empty() {
        let hint = "give a column stiffness [N/mm], base_thickness [mm] or mass [kg], or leave the options out";
        let problem = Problem::value(
            "no option changes an object, so there is nothing to run",
            hint,
        );
        return Err(problem.in_file(path).into());
    }
    Ok((InputFile::new(path, &bytes), objects))
}

/// The rows of a file of options.
struct ReadOptions {
    rows: Vec<OptionRow>,
    curves: Vec<(InputFile, ObjectCurves)>,
    doubts: Vec<CostDoubt>,
}

/// The options, and what to know beside them. `changed` returns the effect of an option that changes
/// its object, or `None` to leave the option out.
fn read_options(
    bytes: &[u8],
    path: &Path,
    currency: Option<&str>,
    mut changed: impl FnMut(ChangedObject) -> Result<Option<Effect>, Problem>,
) -> Result<ReadOptions, Problems> {
    let mut rows = RowProblems::default();
    let table = Table::read(bytes, path, OPTIONS_HINT, &mut rows)?;
    let mut problems = Problems::default();
    let [id, option, cost] = ["id", "option", "cost"].map(|name| problems.keep(table.needed(name)));
    problems.keep(currency_of(&table, &[("cost", "")], currency));
    problems.keep(check_unit(&table, "life", &["yr", "year", "years"]));
    let ((id, option), cost) = problems.finish(id.zip(option).zip(cost))?;
    let (mut known, mut files, mut named) = (HashMap::new(), CurveFiles::new(), Vec::new());
    let rows = table.each_row(rows, |row, problems| {
        let names = problems.keep(names_of(&table, row, id, option, &mut known));
        let cost = problems.keep(table.non_negative(row, cost));
        let life_years = problems.keep(positive_of(&table, row, "life"));
        let change = problems.keep(change_of(&table, row));
        let (name, choice) = names?;
        let effect = match (
            table.given(row, "median_factor"),
            table.given(row, "curves"),
            change?,
        ) {
            (Some(column), None, None) => table
                .positive(row, column)
                .map(Effect::MedianFactor)
                .map(Some),
            (None, Some(column), None) => {
                curves_of(&table, row, column, &curve_id(&name, &choice), &mut files).map(|found| {
                    named.push(found.clone());
                    Some(Effect::Curves(found.1))
                })
            }
            (None, None, Some(change)) => {
                let curve_id = curve_id(&name, &choice);
                changed(ChangedObject {
                    id: name.clone(),
                    curve_id,
                    change,
                    file: path.to_path_buf(),
                    line: row.line,
                })
            }
            (factor, curves, change) => {
                let given = [factor.is_some(), curves.is_some(), change.is_some()]
                    .iter()
                    .any(|is_given| *is_given);
                let message = format!(
                    "the option \"{}\" of {} has {} effect",
                    shorten(&choice),
                    shorten(&name),
                    if given { "more than one" } else { "no" }
                );
                Err(table.cell_problem(row, option, &message).hint(OPTIONS_HINT))
            }
        };
        let effect = problems.keep(effect)?;
        let (cost, life_years) = (cost?, life_years?);
        Some(effect.map(|effect| OptionRow {
            id: name,
            line: row.line,
            option: choice,
            cost,
            life_years,
            effect,
        }))
    })?;
    Ok(ReadOptions {
        rows: rows.into_iter().flatten().collect(),
        curves: named,
        doubts: CostDoubt::unused(&table, &OPTION_COLUMNS)
            .into_iter()
            .collect(),
    })
}

/// The object and the option of a row; `known` has the lines of the pairs above.
fn names_of(
    table: &Table,
    row: &Row,
    id: usize,
    option: usize,
    known: &mut HashMap<(String, String), usize>,
) -> Result<(String, String), Problem> {
    let names = (
        table.filled(row, id)?.to_owned(),
        table.filled(row, option)?.to_owned(),
    );
    let what = format!(
        "the option \"{}\" of {}",
        shorten(&names.1),
        shorten(&names.0)
    );
    twice(
        table,
        row,
        option,
        known.insert(names.clone(), row.line),
        &what,
    )?;
    Ok(names)
}

/// The id of the curves of an object with an option.
pub(crate) fn curve_id(id: &str, option: &str) -> String {
    format!("{id}/{option}")
}

/// What an option changes; `None`: nothing.
fn change_of(table: &Table, row: &Row) -> Result<Option<Change>, Problem> {
    let of = |name: &str, dimension: Dimension, example: &str| -> Result<Option<f64>, Problem> {
        let Some(column) = table.given(row, name) else {
            return Ok(None);
        };
        let Some(unit) = table
            .headings
            .get(column)
            .and_then(|heading| heading.unit.as_deref())
        else {
            return Err(table.header_problem(format!(
                "the column {name} states no unit, as in \"{name} [{example}]\""
            )));
        };
        let value = table.positive(row, column)?;
        let si = parse_positive(&format!("{value} {unit}"), dimension, name);
        si.map(Some)
            .map_err(|problem| table.cell_problem(row, column, &problem.to_string()))
    };
    let change = Change {
        stiffness_n_m: of("stiffness", Dimension::Stiffness, "N/mm")?,
        base_thickness_m: of("base_thickness", Dimension::Length, "mm")?,
        mass_kg: of("mass", Dimension::Mass, "kg")?,
    };
    Ok(Some(change).filter(|change| *change != Change::default()))
}

/// A file of curves, by their ids.
type CurveFile = (InputFile, HashMap<String, ObjectCurves>);
/// The files of curves that options name; each is read once.
type CurveFiles = HashMap<PathBuf, Result<CurveFile, Problems>>;

/// The curves `ID/option` of a file that an option names, relative to its own.
fn curves_of(
    table: &Table,
    row: &Row,
    column: usize,
    wanted: &str,
    files: &mut CurveFiles,
) -> Result<(InputFile, ObjectCurves), Problem> {
    let folder = table.path.parent().unwrap_or_else(|| Path::new(""));
    let path = folder.join(table.text(row, column));
    let read = files.entry(path).or_insert_with_key(|path| {
        let (file, objects) = load_curves(path)?;
        Ok((
            file,
            objects
                .into_iter()
                .map(|object| (object.id.clone(), object))
                .collect(),
        ))
    });
    let (file, objects) = read.as_ref().map_err(|problems| {
        let first = problems
            .problems
            .first()
            .map_or(String::new(), Problem::to_string);
        let message = format!("the curves cannot be read: {first}");
        table
            .cell_problem(row, column, &message)
            .hint("correct that file, or name another one")
    })?;
    let found = objects.get(wanted).ok_or_else(|| {
        let message = format!("the file has no curves with the id \"{}\"", shorten(wanted));
        table
            .cell_problem(row, column, &message)
            .hint("name the curves of an option ID/option")
    })?;
    Ok((file.clone(), found.clone()))
}

#[cfg(test)]
mod tests;
