//! A mapping file: what a person says about the columns, floors and numbers of a list.

use std::path::Path;

use freestand_input::file::load_up_to;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, parse, shorten};
use freestand_input::words::{canonical, nearest};
use freestand_study::study::FirstFloor;
use toml_edit::{Document, Item, Value};

use super::columns::{COLUMNS, Column};
use super::cost_columns::{CostHeading, cost_name};
use super::floors::Floors;
use super::headings::{dimension, meaning};
use super::numbers::Decimal;
use super::problems::bad_file;
use super::units::{CellUnit, find};

/// What a mapping file says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mapping {
    columns: Vec<(String, Mapped)>,
    floors: Vec<(String, MappedFloor)>,
    units: Vec<(Column, CellUnit)>,
    pub(super) decimal: Option<Decimal>,
    first_floor: Option<FirstFloor>,
    /// Headings of costs, which only `risk` reads, with their currencies.
    costs: Vec<MappedCost>,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

/// A column by the heading that the file gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mapped {
    /// `None`: it is not read.
    pub column: Option<Column>,
    pub unit: Option<CellUnit>,
}

/// A column of costs by the heading that the file gives it.
#[derive(Debug, Clone, PartialEq)]
struct MappedCost {
    /// The words of the heading.
    words: String,
    /// The name of the column.
    name: &'static str,
    currency: Option<String>,
}

#[derive(Debug, Clone, PartialEq)]
enum MappedFloor {
    Ratio(f64),
    Elevation(f64),
    As(String),
}

const TABLES: [&str; 4] = ["columns", "floors", "units", "numbers"];

impl Mapping {
    /// Reads a mapping file.
    ///
    /// # Errors
    /// A file that cannot be read, or all that is wrong in it.
    pub fn load(path: &Path) -> Result<Self, Problems> {
        let hint = "name a mapping file; `write_columns` writes one to edit";
        let bytes = load_up_to(path, 4 << 20, "is too large for a mapping file", hint)?;
        let in_file = |problem: Problem| problem.in_file(path);
        let text =
            String::from_utf8(bytes).map_err(|_| in_file(bad_file("is not text (UTF-8)", hint)))?;
        Self::parse(&text).map_err(|error| error.into_iter().map(in_file).collect())
    }

    /// Reads the text of a mapping file.
    ///
    /// # Errors
    /// All that is wrong in it, each with its line.
    ///
    /// # Example
    /// ```
    /// use freestand_inventory::Mapping;
    /// let text = "[columns]\n\"Hgt over all\" = { name = \"height\", unit = \"in\" }\n\"Cost\" = \"ignore\"\n";
    /// assert!(Mapping::parse(text).is_ok());
    /// assert!(Mapping::parse("[columns]\n\"Hgt\" = \"hight\"\n").is_err());
    /// ```
    pub fn parse(text: &str) -> Result<Self, Problems> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let line = |at: usize| 1 + text.get(..at).unwrap_or(text).matches('\n').count();
        let document = Document::parse(text).map_err(|error| {
            let message = format!("not TOML: {}", error.message().replace('`', "\""));
            let problem = bad_file(message, "write \"Heading\" = \"height\" under [columns]");
            match error.span() {
                Some(span) => problem.at_line(line(span.start)),
                None => problem,
            }
        })?;
        let mut found = Self {
            sha256: freestand_input::file::sha256_hex(text.as_bytes()),
            ..Self::default()
        };
        let mut problems = Problems::default();
        for (name, item) in document.as_table() {
            let span = item.span().map_or(0, |span| span.start);
            let Some(table) = item.as_table_like().filter(|_| TABLES.contains(&name)) else {
                let message = format!("unknown table [{}]", shorten(name));
                problems.push(
                    Problem::value(message, "known: [columns], [floors], [units], [numbers]")
                        .at_line(line(span)),
                );
                continue;
            };
            for (key, item) in table.iter() {
                let at = table
                    .key(key)
                    .and_then(|key| key.span())
                    .or(item.span())
                    .map_or(span, |span| span.start);
                if let Err(problem) = found.entry(name, key, item) {
                    problems.push(problem.at_line(line(at)));
                }
            }
        }
        problems.finish(Some(found))
    }

    fn entry(&mut self, table: &str, key: &str, item: &Item) -> Result<(), Problem> {
        let wrong = |hint: &str| {
            Problem::value(
                format!("\"{}\" has a value that is not understood", shorten(key)),
                hint,
            )
        };
        match table {
            "columns" => {
                let hint = "write \"height\", { name = \"height\", unit = \"in\" } or \"ignore\"";
                let (name, unit) = match item.as_value() {
                    Some(Value::String(name)) => (name.value().clone(), None),
                    Some(Value::InlineTable(table)) => {
                        let text =
                            |key: &str| table.get(key).and_then(Value::as_str).map(str::to_owned);
                        (text("name").ok_or_else(|| wrong(hint))?, text("unit"))
                    }
                    _ => return Err(wrong(hint)),
                };
                if let Some(name) = cost_name(&name) {
                    let words = canonical(key);
                    let (column, currency) = (None, unit);
                    let mapped = Mapped { column, unit: None };
                    self.columns.push((words.clone(), mapped));
                    self.costs.push(MappedCost {
                        words,
                        name,
                        currency,
                    });
                    return Ok(());
                }
                let column = (name != "ignore").then(|| column(&name)).transpose()?;
                let unit = column
                    .zip(unit)
                    .map(|(column, unit)| unit_of(&unit, column))
                    .transpose()?;
                self.columns.push((canonical(key), Mapped { column, unit }));
            }
            "floors" if key == "first_floor" => {
                let name = item.as_str().unwrap_or_default();
                let found = FirstFloor::ALL.iter().find(|(other, _)| *other == name);
                let (_, first) = found.ok_or_else(|| wrong("write \"ground\" or \"above\""))?;
                self.first_floor = Some(*first);
            }
            "floors" => {
                let hint = "write a share of the height such as 0.75, an elevation such as \"12 m\", or another floor's name";
                let floor = match item.as_value() {
                    Some(Value::Float(ratio)) => MappedFloor::Ratio(*ratio.value()),
                    Some(Value::Integer(ratio)) if (0..=1).contains(ratio.value()) => {
                        MappedFloor::Ratio(*ratio.value() as f64)
                    }
                    Some(Value::String(text)) => match parse(text.value(), Dimension::Length) {
                        Ok(elevation) => MappedFloor::Elevation(elevation),
                        Err(_) => MappedFloor::As(text.value().clone()),
                    },
                    _ => return Err(wrong(hint)),
                };
                if matches!(floor, MappedFloor::Ratio(ratio) if !(0.0..=1.0).contains(&ratio)) {
                    return Err(wrong(hint));
                }
                self.floors.push((key.to_owned(), floor));
            }
            "units" => {
                let column = column(key)?;
                let text = item
                    .as_str()
                    .ok_or_else(|| wrong("write a unit, such as \"lb\""))?;
                self.units.push((column, unit_of(text, column)?));
            }
            _ => match (key, item.as_str()) {
                ("decimal", Some("comma")) => self.decimal = Some(Decimal::Comma),
                ("decimal", Some("point")) => self.decimal = Some(Decimal::Point),
                ("decimal", _) => {
                    return Err(wrong("write decimal = \"comma\" or decimal = \"point\""));
                }
                _ => return Err(wrong("known under [numbers]: decimal")),
            },
        }
        Ok(())
    }

    /// What the file says about a heading.
    pub(super) fn column(&self, heading: &str) -> Option<Mapped> {
        let words = canonical(heading);
        let mut columns = self.columns.iter();
        columns.find(|one| one.0 == words).map(|one| one.1)
    }

    /// Whether a heading is named as one that is not read.
    pub(super) fn ignores(&self, heading: &str) -> bool {
        self.column(heading)
            .is_some_and(|mapped| mapped.column.is_none())
            && self.cost(heading).is_none()
    }

    /// The column of costs that the file makes of a heading, and its currency.
    fn cost(&self, heading: &str) -> Option<(&'static str, Option<String>)> {
        let words = canonical(heading);
        let cost = self.costs.iter().find(|one| one.words == words)?;
        Some((cost.name, cost.currency.clone()))
    }

    /// The unit of a column by its name.
    pub(super) fn unit(&self, column: Column) -> Option<CellUnit> {
        let mut units = self.units.iter();
        units.find(|one| one.0 == column).map(|one| one.1)
    }

    /// Headings that the file names and the list does not have.
    pub(super) fn unused(&self, headings: impl Iterator<Item = String>) -> Vec<String> {
        let known: Vec<String> = headings.map(|heading| canonical(&heading)).collect();
        let named = self.columns.iter().map(|(words, _)| words);
        named
            .filter(|words| !known.contains(words))
            .cloned()
            .collect()
    }

    /// The floors of a building with those of the file.
    ///
    /// # Errors
    /// A floor by its elevation where the height of the building is not known.
    pub(super) fn floors(&self, floors: &Floors) -> Result<Floors, Problem> {
        let mut all = floors.clone();
        all.first_floor = self.first_floor.or(all.first_floor);
        let finder = super::floors::FloorFinder::new(&all, &[], false, false);
        for (name, floor) in &self.floors {
            let ratio = match floor {
                MappedFloor::Ratio(ratio) => *ratio,
                MappedFloor::Elevation(elevation) => {
                    let height = all.height_m.filter(|height| *height > 0.0).ok_or_else(|| {
                        let name = shorten(name);
                        Problem::value(
                            format!("the elevation of \"{name}\" needs the height of the building"),
                            "give a study with the building, or a share of the height such as 0.75",
                        )
                    })?;
                    (elevation / height).clamp(0.0, 1.0)
                }
                MappedFloor::As(other) => match finder.find(other) {
                    super::floors::Found::Ratio(ratio, _) => ratio,
                    _ => {
                        let message =
                            format!("\"{}\" is not a floor that is known", shorten(other));
                        return Err(Problem::value(
                            message,
                            "give `storeys`, or a share of the height such as 0.75",
                        ));
                    }
                },
            };
            all.named.push((name.clone(), ratio));
        }
        Ok(all)
    }
}

/// What a heading says of costs, which stand beside the objects until money is asked for; a mapping
/// file has the last word.
pub(super) fn cost_heading(heading: &str, mapping: Option<&Mapping>) -> Option<CostHeading> {
    match mapping.and_then(|mapping| mapping.cost(heading)) {
        Some((name, unit)) => CostHeading::mapped(heading, name, unit),
        None if mapping.is_some_and(|mapping| mapping.ignores(heading)) => None,
        None => CostHeading::of(heading),
    }
}

fn column(name: &str) -> Result<Column, Problem> {
    if let Some(spec) = COLUMNS.iter().find(|spec| spec.name == name) {
        return Ok(spec.column);
    }
    if let Some(found) = meaning(name) {
        return Ok(found.column);
    }
    let names: Vec<&str> = COLUMNS.iter().map(|spec| spec.name).collect();
    let hint = nearest(name, &names).map_or_else(
        || format!("known: {}", names.join(", ")),
        |near| format!("did you mean {near}?"),
    );
    Err(Problem::value(
        format!("\"{}\" is not the name of a column", shorten(name)),
        hint,
    ))
}

fn unit_of(text: &str, column: Column) -> Result<CellUnit, Problem> {
    let refused = || {
        let message = format!("\"{}\" is not a unit of {}", shorten(text), column.name());
        Problem::value(message, "write a unit such as mm, in, kg or lb")
    };
    dimension(column)
        .and_then(|dimension| find(text, dimension).ok())
        .ok_or_else(refused)
}

/// A heading, and the column and the unit that it was taken for.
pub(super) type Headed = (String, Option<Column>, Option<CellUnit>);

/// A mapping file to edit: every heading of a list with what it was taken for, by the mapping in use if there is one.
pub(super) fn written(columns: &[Headed], used: Option<&Mapping>) -> String {
    let mut text = String::from(
        "# What the columns of the list are. Edit it and give it back with --columns.\n\
         # \"Heading\" = \"name\", { name = \"height\", unit = \"mm\" }, or \"ignore\"\n[columns]\n",
    );
    for (heading, column, unit) in columns {
        let key = Value::from(heading.as_str()).to_string();
        let named = match column {
            Some(column) => Some((column.name(), unit.map(|unit| unit.symbol().to_owned()))),
            None if used.is_some_and(|used| used.ignores(heading)) => None,
            None => used
                .and_then(|used| used.cost(heading))
                .or_else(|| CostHeading::of(heading).map(|found| (found.column.name, found.unit))),
        };
        let value = match named {
            None => "\"ignore\"".to_owned(),
            Some((name, None)) => format!("\"{name}\""),
            Some((name, Some(unit))) => {
                format!("{{ name = \"{name}\", unit = {} }}", Value::from(unit))
            }
        };
        text += &format!("{} = {value}\n", key.trim());
    }
    text += "\n# Floors by their names: a share of the height, an elevation, or another floor.\n[floors]\n\
             # \"Annex upper\" = 0.75\n# first_floor = \"ground\"\n\n\
             # Units of columns without one.\n[units]\n# mass = \"lb\"\n\n[numbers]\n";
    let sign = used.and_then(|used| used.decimal).map_or_else(
        || "# decimal = \"comma\"".to_owned(),
        |sign| format!("decimal = \"{}\"", sign.name()),
    );
    text += &format!("{sign}\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mapping_says_what_columns_and_floors_are() {
        let mapping = Mapping::parse(
            "[columns]\n\"Hgt over all\" = { name = \"height\", unit = \"in\" }\nZone = \"floor\"\nCost = \"ignore\"\n\
             [floors]\n\"Annex upper\" = 0.75\nLoft = \"9 m\"\nStreet = \"G\"\n[units]\nmass = \"lb\"\n[numbers]\ndecimal = \"comma\"\n",
        )
        .unwrap();
        let height = mapping.column("HGT over-all").unwrap();
        assert_eq!(
            (height.column, height.unit.map(CellUnit::symbol)),
            (Some(Column::Height), Some("in"))
        );
        assert_eq!(
            mapping.column("Cost"),
            Some(Mapped {
                column: None,
                unit: None
            })
        );
        assert_eq!(mapping.unit(Column::Mass).map(CellUnit::symbol), Some("lb"));
        assert_eq!(mapping.decimal, Some(Decimal::Comma));
        let floors = mapping
            .floors(&Floors {
                height_m: Some(12.0),
                storeys: Some(4),
                ..Floors::default()
            })
            .unwrap();
        let named: Vec<(&str, f64)> = floors
            .named
            .iter()
            .map(|(name, ratio)| (name.as_str(), *ratio))
            .collect();
        assert_eq!(
            named,
            [("Annex upper", 0.75), ("Loft", 0.75), ("Street", 0.0)]
        );
        assert!(mapping.floors(&Floors::default()).is_err());
    }

    #[test]
    fn all_that_is_wrong_has_its_line() {
        let error =
            Mapping::parse("[columns]\nA = \"hight\"\nB = 3\n[floors]\nC = 7\n[flors]\nx = 1\n")
                .unwrap_err();
        let lines: Vec<Option<usize>> = error.problems.iter().map(|problem| problem.line).collect();
        assert_eq!(lines, [Some(2), Some(3), Some(5), Some(6)], "{error}");
        assert!(
            error.problems[0]
                .hint
                .as_deref()
                .is_some_and(|hint| hint.contains("height"))
        );
        assert!(
            Mapping::parse("[columns\n").unwrap_err().problems[0]
                .line
                .is_some()
        );
    }

    #[test]
    fn what_is_written_is_read() {
        let mm = find("mm", Dimension::Length).ok();
        let text = written(
            &[
                ("Höhe \"h\"".to_owned(), Some(Column::Height), mm),
                ("x".to_owned(), None, None),
                ("Replacement value NZD".to_owned(), None, None),
            ],
            None,
        );
        let mapping = Mapping::parse(&text).unwrap();
        assert_eq!(
            mapping.cost("Replacement value NZD"),
            Some(("replacement_cost", Some("NZD".to_owned()))),
            "{text}"
        );
        assert!(
            mapping.ignores("x")
                && !mapping.ignores("Replacement value NZD")
                && !mapping.ignores("y")
        );
        // What a mapping ignores stays ignored, and what it renamed keeps its name.
        let used = Mapping::parse("[columns]\nWert = { name = \"replacement_cost\", unit = \"EUR\" }\n\"Replacement value NZD\" = \"ignore\"\n[numbers]\ndecimal = \"comma\"\n").unwrap();
        let again =
            ["Wert", "Replacement value NZD"].map(|heading| (heading.to_owned(), None, None));
        let again = Mapping::parse(&written(&again, Some(&used))).unwrap();
        assert_eq!(
            again.cost("Wert"),
            Some(("replacement_cost", Some("EUR".to_owned())))
        );
        assert!(again.ignores("Replacement value NZD") && again.decimal == Some(Decimal::Comma));
        assert_eq!(
            mapping.column("Höhe \"h\"").map(|mapped| mapped.column),
            Some(Some(Column::Height))
        );
    }
}
