//! What failures and options cost: the user's columns, never a default.

use std::path::Path;

use freestand_input::file::{InputFile, load};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_positive, shorten};

use crate::fragility::table::{Row, Table};
use crate::fragility::{Change, ChangedObject, ObjectCurves, load_curves};

const HINT: &str = "the columns are id, and quantity, repair_cost [AUD], replacement_cost [AUD], downtime [day], \
                    downtime_cost [AUD/day], casualty_probability, casualty_cost [AUD], accepted_annual_rate [1/yr], \
                    accepted_exceed_annual_rate [1/yr], floor, longitude, latitude";
const OPTIONS_HINT: &str = "the columns are id, option, cost [AUD], perhaps life [yr], and one effect: median_factor, \
                            curves, or a change of stiffness [N/mm], base_thickness [mm] or mass [kg]";

/// The highest floor.
const MAX_FLOOR: u32 = 1000;

/// What the failures of one object cost, and how often they are accepted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CostRow {
    pub(crate) id: String,
    pub(crate) quantity: f64,
    pub(crate) repair: Option<f64>,
    pub(crate) replacement: Option<f64>,
    pub(crate) downtime_days: Option<f64>,
    pub(crate) downtime_cost: Option<f64>,
    pub(crate) casualty_probability: Option<f64>,
    pub(crate) casualty_cost: Option<f64>,
    pub(crate) accepted_rate: Option<f64>,
    pub(crate) accepted_exceed_rate: Option<f64>,
    /// 0: the ground.
    pub(crate) floor: Option<u32>,
    /// Longitude and latitude \[degrees\].
    pub(crate) site_deg: Option<(f64, f64)>,
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

    /// What is not counted because it was not given.
    pub(crate) fn not_counted(&self) -> Vec<&'static str> {
        let parts = [
            (self.repair.is_some(), "repair_cost"),
            (self.replacement.is_some(), "replacement_cost"),
            (self.downtime_days.zip(self.downtime_cost).is_some(), "downtime"),
            (self.casualty_probability.zip(self.casualty_cost).is_some(), "casualties"),
        ];
        parts.into_iter().filter(|(is_given, _)| !is_given).map(|(_, name)| name).collect()
    }
}

/// The costs of an inventory.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Costs {
    pub(crate) file: InputFile,
    pub(crate) currency: Option<String>,
    pub(crate) rows: Vec<CostRow>,
}

/// The currency of a column, `AUD` of `[AUD]` and of `[AUD/day]`; all columns have the same.
fn currency_of(table: &Table, columns: &[(&str, &str)], known: Option<&str>) -> Result<Option<String>, Problem> {
    let mut currency = known.map(str::to_owned);
    for (name, per) in columns {
        let Some(heading) = table.column(name).and_then(|column| table.headings.get(column)) else { continue };
        let unit = heading.unit.as_deref().and_then(|unit| unit.strip_suffix(per)).map(str::trim);
        let is_currency =
            |unit: &&str| !unit.is_empty() && unit.chars().all(|c| c.is_alphanumeric() || "$€£¥_".contains(c));
        let unit = unit.filter(is_currency).ok_or_else(|| {
            let message = format!("the column \"{name}\" states no currency");
            table.header_problem(message).hint(format!("write {name} [AUD{per}]"))
        })?;
        match &currency {
            Some(other) if other != unit => {
                let message = format!("\"{name}\" is in {}, and other costs are in {}", shorten(unit), shorten(other));
                return Err(table.header_problem(message).hint("convert all costs to one currency"));
            }
            _ => currency = Some(unit.to_owned()),
        }
    }
    Ok(currency)
}

fn check_unit(table: &Table, name: &str, units: &[&str]) -> Result<(), Problem> {
    let heading = table.column(name).and_then(|column| table.headings.get(column));
    match heading.map(|heading| heading.unit.as_deref()) {
        Some(unit) if !unit.is_some_and(|unit| units.contains(&unit)) => {
            let message = format!("the column \"{name}\" is not in {}", units[0]);
            Err(table.header_problem(message).hint(format!("write {name} [{}]", units[0])))
        }
        _ => Ok(()),
    }
}

/// Reads the costs of an inventory.
///
/// # Errors
/// Two currencies, a number below 0, an id that is there twice or missing.
pub(crate) fn load_costs(path: &Path) -> Result<Costs, Problem> {
    let bytes = load(path)?;
    read_costs(&bytes, path)
}

fn read_costs(bytes: &[u8], path: &Path) -> Result<Costs, Problem> {
    let table = Table::read(bytes, path, HINT)?;
    let id = table.needed("id")?;
    let amounts = [("repair_cost", ""), ("replacement_cost", ""), ("downtime_cost", "/day"), ("casualty_cost", "")];
    let currency = currency_of(&table, &amounts, None)?;
    check_unit(&table, "downtime", &["day", "days", "d"])?;
    for name in ["accepted_annual_rate", "accepted_exceed_annual_rate"] {
        check_unit(&table, name, &["1/yr", "/yr", "1/year"])?;
    }
    let mut rows: Vec<CostRow> = Vec::new();
    for row in &table.rows {
        let name = table.filled(row, id)?;
        if rows.iter().any(|other| other.id == name) {
            return Err(table.cell_problem(row, id, "this id is there twice"));
        }
        let of = |name: &str| table.optional(row, table.column(name));
        let probability = of("casualty_probability")?;
        if let (Some(column), true) = (table.column("casualty_probability"), probability.is_some_and(|p| p > 1.0)) {
            return Err(table.cell_problem(row, column, "a probability cannot be above 1"));
        }
        let positive = |name: &str| match filled(&table, row, name) {
            Some(column) => table.positive(row, column).map(Some),
            None => Ok(None),
        };
        rows.push(CostRow {
            id: name.to_owned(),
            quantity: of("quantity")?.unwrap_or(1.0),
            repair: of("repair_cost")?,
            replacement: of("replacement_cost")?,
            downtime_days: of("downtime")?,
            downtime_cost: of("downtime_cost")?,
            casualty_probability: probability,
            casualty_cost: of("casualty_cost")?,
            accepted_rate: positive("accepted_annual_rate")?,
            accepted_exceed_rate: positive("accepted_exceed_annual_rate")?,
            floor: floor_of(&table, row)?,
            site_deg: site_of(&table, row)?,
        });
    }
    Ok(Costs { file: InputFile::new(path, bytes), currency, rows })
}

/// The number of a floor, from 0 for the ground.
fn floor_of(table: &Table, row: &Row) -> Result<Option<u32>, Problem> {
    let Some(column) = filled(table, row, "floor") else { return Ok(None) };
    let text = table.text(row, column);
    let floor = text.parse::<u32>().ok().filter(|floor| *floor <= MAX_FLOOR);
    floor.map(Some).ok_or_else(|| {
        let message = format!("\"{}\" is not the number of a floor", shorten(text));
        table.cell_problem(row, column, &message).hint("write 0 for the ground, 1 for the first floor above it")
    })
}

fn site_of(table: &Table, row: &Row) -> Result<Option<(f64, f64)>, Problem> {
    let degrees = |name: &str, most: f64| -> Result<Option<f64>, Problem> {
        let Some(column) = filled(table, row, name) else { return Ok(None) };
        let text = table.text(row, column);
        let value = text.parse::<f64>().ok().filter(|value| value.abs() <= most);
        value.map(Some).ok_or_else(|| {
            let message = format!("\"{}\" is not a {name} in degrees", shorten(text));
            table.cell_problem(row, column, &message)
        })
    };
    match (degrees("longitude", 360.0)?, degrees("latitude", 90.0)?) {
        (Some(lon), Some(lat)) => Ok(Some((lon, lat))),
        (None, None) => Ok(None),
        (one, _) => {
            let (given, missing) = if one.is_some() { ("longitude", "latitude") } else { ("latitude", "longitude") };
            let message = format!("the row has a {given} and no {missing}");
            let column = table.column(given).unwrap_or(0);
            Err(table.cell_problem(row, column, &message).hint("give both, in degrees, or neither"))
        }
    }
}

/// The place of a column whose cell is not empty.
fn filled(table: &Table, row: &Row, name: &str) -> Option<usize> {
    table.column(name).filter(|&column| !table.text(row, column).is_empty())
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
    pub(crate) id: String,
    pub(crate) option: String,
    pub(crate) cost: f64,
    pub(crate) life_years: Option<f64>,
    pub(crate) effect: Effect,
}

/// Reads the options; `currency` is that of the costs, and `curves` those of all objects, with those of
/// changed objects as `ID/option`.
///
/// # Errors
/// Another currency, no effect or two, an option that is there twice, a changed object without
/// curves.
pub(crate) fn load_options(
    path: &Path,
    currency: Option<&str>,
    curves: &[ObjectCurves],
) -> Result<(InputFile, Vec<OptionRow>), Problem> {
    let bytes = load(path)?;
    let rows = read_options(&bytes, path, currency, |object| {
        let found = curves.iter().find(|one| one.id == object.curve_id).ok_or_else(|| {
            let wanted = shorten(&object.curve_id);
            let message = format!("the option changes the object itself, and no curves have the id \"{wanted}\"");
            let hint = "run the changed objects with freestand fragility, its list and these options, and give its \
                        fragility.csv or outcomes.csv here; or name a file in the column curves";
            Problem::value(message, hint).in_file(path).at_line(object.line)
        })?;
        Ok(Some(Effect::Curves(found.clone())))
    })?;
    Ok((InputFile::new(path, &bytes), rows))
}

/// The objects that options change, of a file of options.
///
/// # Errors
/// As for the options of `risk`, or none that changes an object.
pub fn load_changed(path: &Path) -> Result<(InputFile, Vec<ChangedObject>), Problem> {
    let bytes = load(path)?;
    let mut objects: Vec<ChangedObject> = Vec::new();
    read_options(&bytes, path, None, |object| {
        objects.push(object);
        Ok(None)
    })?;
    if objects.is_empty() {
        let hint = "give a column stiffness [N/mm], base_thickness [mm] or mass [kg], or leave the options out";
        return Err(Problem::value("no option changes an object, so there is nothing to run", hint).in_file(path));
    }
    Ok((InputFile::new(path, &bytes), objects))
}

/// `changed` gives the effect of an option that changes its object; `None`: the option is left out.
fn read_options(
    bytes: &[u8],
    path: &Path,
    currency: Option<&str>,
    mut changed: impl FnMut(ChangedObject) -> Result<Option<Effect>, Problem>,
) -> Result<Vec<OptionRow>, Problem> {
    let table = Table::read(bytes, path, OPTIONS_HINT)?;
    let (id, option, cost) = (table.needed("id")?, table.needed("option")?, table.needed("cost")?);
    currency_of(&table, &[("cost", "")], currency)?;
    check_unit(&table, "life", &["yr", "year", "years"])?;
    let (factor, curves) = (table.column("median_factor"), table.column("curves"));
    let mut rows: Vec<OptionRow> = Vec::new();
    for row in &table.rows {
        let (name, choice) = (table.filled(row, id)?.to_owned(), table.filled(row, option)?.to_owned());
        if rows.iter().any(|other| other.id == name && other.option == choice) {
            return Err(table.cell_problem(row, option, "this option of the object is there twice"));
        }
        let is_filled = |column: Option<usize>| column.filter(|&column| !table.text(row, column).is_empty());
        let change = change_of(&table, row)?;
        let effect = match (is_filled(factor), is_filled(curves), change) {
            (Some(column), None, None) => Some(Effect::MedianFactor(table.positive(row, column)?)),
            (None, Some(column), None) => Some(Effect::Curves(curves_of(&table, row, column, &name, &choice)?)),
            (None, None, Some(change)) => {
                let curve_id = curve_id(&name, &choice);
                changed(ChangedObject { id: name.clone(), curve_id, change, line: row.line })?
            }
            _ => {
                let message = "an option needs one effect: a median_factor, curves, or a change of the object";
                return Err(table.cell_problem(row, option, message).hint(OPTIONS_HINT));
            }
        };
        let life_years = match is_filled(table.column("life")) {
            Some(column) => Some(table.positive(row, column)?),
            None => None,
        };
        let cost = table.non_negative(row, cost)?;
        rows.extend(effect.map(|effect| OptionRow { id: name, option: choice, cost, life_years, effect }));
    }
    Ok(rows)
}

/// The id of the curves of an object with an option.
pub(crate) fn curve_id(id: &str, option: &str) -> String {
    format!("{id}/{option}")
}

/// What an option changes; `None`: nothing.
fn change_of(table: &Table, row: &Row) -> Result<Option<Change>, Problem> {
    let of = |name: &str, dimension: Dimension, example: &str| -> Result<Option<f64>, Problem> {
        let Some(column) = filled(table, row, name) else { return Ok(None) };
        let Some(unit) = table.headings.get(column).and_then(|heading| heading.unit.as_deref()) else {
            return Err(table.header_problem(format!("the column {name} states no unit, as in \"{name} [{example}]\"")));
        };
        let value = table.positive(row, column)?;
        let si = parse_positive(&format!("{value} {unit}"), dimension, name);
        si.map(Some).map_err(|problem| table.cell_problem(row, column, &problem.to_string()))
    };
    let change = Change {
        stiffness_n_m: of("stiffness", Dimension::Stiffness, "N/mm")?,
        base_thickness_m: of("base_thickness", Dimension::Length, "mm")?,
        mass_kg: of("mass", Dimension::Mass, "kg")?,
    };
    Ok(Some(change).filter(|change| *change != Change::default()))
}

/// The curves `ID/option` of a file that an option names, relative to its own.
fn curves_of(table: &Table, row: &Row, column: usize, id: &str, option: &str) -> Result<ObjectCurves, Problem> {
    let folder = table.path.parent().unwrap_or_else(|| Path::new(""));
    let (_, objects) = load_curves(&folder.join(table.text(row, column)))?;
    let wanted = curve_id(id, option);
    objects.into_iter().find(|object| object.id == wanted).ok_or_else(|| {
        let message = format!("the file has no curves with the id \"{}\"", shorten(&wanted));
        table.cell_problem(row, column, &message).hint("name the curves of an option ID/option")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn costs(text: &str) -> Result<Costs, Problem> {
        read_costs(text.as_bytes(), Path::new("i.csv"))
    }

    #[test]
    fn what_is_missing_is_listed_and_not_guessed() {
        let read = costs(
            "id,item,quantity,repair_cost [AUD],replacement_cost [AUD],downtime [day],downtime_cost [AUD/day]\n\
             a,rack,3,1000,5000,2,100\nb,cabinet,,,,2,\n",
        )
        .unwrap();
        assert_eq!((read.currency.as_deref(), read.rows[0].overturned()), (Some("AUD"), 5200.0));
        assert_eq!(read.rows[0].not_counted(), ["casualties"]);
        assert_eq!((read.rows[1].quantity, read.rows[1].has_costs()), (1.0, false));
        assert_eq!(read.rows[1].not_counted(), ["repair_cost", "replacement_cost", "downtime", "casualties"]);
    }

    #[test]
    fn what_is_wrong_is_said_with_line_and_column() {
        let cases = [
            ("id,repair_cost [AUD],replacement_cost [USD]\na,1,2\n", "is in USD, and other costs are in AUD"),
            ("id,repair_cost\na,1\n", "states no currency"),
            ("id,downtime_cost [AUD]\na,1\n", "states no currency"),
            ("id,repair_cost [AUD]\na,-1\n", "i.csv:2: column 2"),
            ("id,repair_cost [AUD]\na,1\na,2\n", "i.csv:3: column 1"),
            ("id,downtime [h]\na,1\n", "is not in day"),
            ("id,casualty_probability\na,1.5\n", "above 1"),
            ("id,accepted_annual_rate\na,1e-4\n", "is not in 1/yr"),
            ("id,floor\na,1.5\n", "i.csv:2: column 2 (\"floor\"): \"1.5\" is not the number of a floor"),
            ("id,longitude,latitude\na,151,-133\n", "i.csv:2: column 3"),
            ("id,longitude,latitude\na,151,\n", "the row has a longitude and no latitude"),
        ];
        for (text, said) in cases {
            let problem = costs(text).unwrap_err();
            assert!(problem.to_string().contains(said) && problem.hint.is_some(), "{said}: {problem}");
        }
        let options = |text: &str| read_options(text.as_bytes(), Path::new("o.csv"), Some("AUD"), |_| Ok(None));
        let fine = options("id,option,cost [AUD],median_factor,life [yr]\na,strap,100,3,15\na,pad,50,1.2,\n").unwrap();
        assert_eq!((fine.len(), fine[0].life_years, fine[1].life_years), (2, Some(15.0), None));
        let cases = [
            ("id,option,cost [USD],median_factor\na,strap,100,3\n", "is in USD"),
            ("id,option,cost [AUD],stiffness\na,pad,100,3\n", "states no unit"),
            ("id,option,cost [AUD],stiffness [kg]\na,pad,100,3\n", "o.csv:2: column 4 (\"stiffness [kg]\")"),
            ("id,option,cost [AUD],mass [kg]\na,pad,100,-3\n", "o.csv:2: column 4"),
            ("id,option,cost [AUD],mass [kg],median_factor\na,pad,100,3,2\n", "one effect"),
            ("id,option,cost [AUD],median_factor\na,strap,100,\n", "o.csv:2: column 2"),
            ("id,option,cost [AUD],median_factor\na,strap,100,2\na,strap,100,3\n", "there twice"),
        ];
        for (text, said) in cases {
            let problem = options(text).unwrap_err();
            assert!(problem.to_string().contains(said) && problem.hint.is_some(), "{said}: {problem}");
        }
    }

    #[test]
    fn an_option_that_changes_its_object_has_curves_of_its_own() {
        let text = "id,option,cost [AUD],stiffness [N/mm],base_thickness [cm]\na,pad,100,300,60\n";
        let mut seen = Vec::new();
        let rows = read_options(text.as_bytes(), Path::new("o.csv"), None, |object| {
            seen.push(object);
            Ok(Some(Effect::MedianFactor(1.0)))
        });
        let change = Change { stiffness_n_m: Some(3e5), base_thickness_m: Some(0.6), mass_kg: None };
        assert_eq!(seen, [ChangedObject { id: "a".to_owned(), curve_id: "a/pad".to_owned(), change, line: 2 }]);
        assert_eq!(rows.unwrap().len(), 1);
    }
}
