//! Tables with one row per site: commas, semicolons or tabs between the cells, `#` before comments.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::numbers::Value;
use super::sites::{Chosen, Site, Wanted, chosen};
use super::{Coordinates, HazardFormat, SiteHazard, numbers};
use crate::text::lines::{lines, text_of};
use crate::text::table::quoted_cells;

/// Most sites of a file: a country in steps of a hundredth of a degree.
const MAX_ROWS: usize = 5_000_000;
const DOWNLOAD: &str = "download the file again: it may be cut off";

/// What stands above the rows.
pub(super) struct Head {
    /// Comments above the headings.
    pub(super) comments: String,
    pub(super) headings: Vec<String>,
    /// Their line, from 1.
    pub(super) line: usize,
    separator: u8,
}

impl Head {
    /// The place of a column.
    pub(super) fn column(&self, name: &str) -> Option<usize> {
        self.headings
            .iter()
            .position(|one| one.eq_ignore_ascii_case(name))
    }

    pub(super) fn problem(&self, message: String, hint: &str) -> Problem {
        Problem::format(message, hint).at_line(self.line)
    }
}

/// A row.
pub(super) struct Row {
    pub(super) line: usize,
    cells: Vec<String>,
}

pub(super) struct Table {
    pub(super) head: Head,
    pub(super) rows: Vec<Row>,
}

impl Table {
    /// The headings; `None` for what is no text.
    pub(super) fn head(bytes: &[u8]) -> Option<Head> {
        let mut comments = String::new();
        for line in lines(bytes).filter(|line| !line.is_blank()) {
            if line.is_comment() {
                comments.push_str(&line.text());
                continue;
            }
            if line.bytes.contains(&0) {
                return None;
            }
            let text = text_of(line.bytes);
            let separator = [b';', b'\t']
                .into_iter()
                .find(|byte| text.as_bytes().contains(byte))
                .unwrap_or(b',');
            return Some(Head {
                comments,
                headings: quoted_cells(&text, separator),
                line: line.number,
                separator,
            });
        }
        None
    }

    pub(super) fn read(bytes: &[u8]) -> Result<Self, Problem> {
        let head =
            Self::head(bytes).ok_or_else(|| Problem::format("the file is empty", DOWNLOAD))?;
        for (k, name) in head.headings.iter().enumerate() {
            if !name.is_empty() && head.headings[..k].contains(name) {
                let message = format!("the column \"{}\" appears twice", shorten(name));
                return Err(head.problem(message, "leave one of them in the file"));
            }
        }
        let mut rows = Vec::new();
        let below = lines(bytes)
            .skip_while(|line| line.number <= head.line)
            .filter(|line| !line.is_blank() && !line.is_comment());
        for line in below {
            let cells = quoted_cells(&text_of(line.bytes), head.separator);
            if rows.len() == MAX_ROWS {
                let message = format!("there are more than {MAX_ROWS} rows");
                let hint = "keep the rows around the site alone";
                return Err(Problem::format(message, hint).at_line(line.number));
            }
            if cells.len() != head.headings.len() {
                let message = format!(
                    "this row has {} cells, and the header has {}",
                    cells.len(),
                    head.headings.len()
                );
                return Err(Problem::format(message, DOWNLOAD).at_line(line.number));
            }
            rows.push(Row {
                line: line.number,
                cells,
            });
        }
        if rows.is_empty() {
            return Err(head.problem("no rows follow the headings".to_owned(), DOWNLOAD));
        }
        Ok(Self { head, rows })
    }

    /// The text of a cell.
    pub(super) fn text<'r>(&self, row: &'r Row, column: usize) -> &'r str {
        row.cells.get(column).map_or("", |cell| cell.trim())
    }

    /// The number in a cell. Where semicolons are between the cells, a comma is a decimal one.
    pub(super) fn number(&self, row: &Row, column: usize) -> Result<Value, Problem> {
        let text = self.text(row, column);
        let plain = match self.head.separator {
            b';' => text.replace(',', "."),
            _ => text.to_owned(),
        };
        let name = self.head.headings.get(column).map_or("", String::as_str);
        let place = format!("column {} (\"{}\")", column + 1, shorten(name));
        match plain.parse::<f64>() {
            Ok(number) => Ok(Value {
                number,
                place,
                line: Some(row.line),
            }),
            Err(_) => {
                let message = format!("{place}: \"{}\" is not a number", shorten(text));
                Err(
                    Problem::value(message, "correct the cell, or download the file again")
                        .at_line(row.line),
                )
            }
        }
    }

    /// Where the site of a row is, by the columns of its longitude and its latitude.
    pub(super) fn at(&self, row: &Row, columns: [usize; 2]) -> Result<Coordinates, Problem> {
        let [longitude, latitude] = columns;
        numbers::coordinates(&self.number(row, longitude)?, &self.number(row, latitude)?)
    }

    /// The columns of longitude and latitude.
    pub(super) fn place_columns(&self) -> Result<[usize; 2], Problem> {
        let column = |name: &str| {
            self.head.column(name).ok_or_else(|| {
                self.head
                    .problem(format!("there is no column \"{name}\""), DOWNLOAD)
            })
        };
        Ok([column("lon")?, column("lat")?])
    }

    /// The site that is meant, with its row: by the columns of its longitude and its latitude, and of its name.
    pub(super) fn site(
        &self,
        format: HazardFormat,
        columns: [usize; 2],
        name: Option<usize>,
        wanted: &Wanted,
    ) -> Result<(SiteHazard, &Row), Problem> {
        let sites = self.rows.iter().map(|row| {
            let name = name.map(|column| self.text(row, column).to_owned());
            Ok(Site {
                line: Some(row.line),
                name: name.filter(|name| !name.is_empty()),
                at: Some(self.at(row, columns)?),
            })
        });
        let sites: Vec<Site> = sites.collect::<Result<_, Problem>>()?;
        let Chosen { index, distance_km } =
            chosen(&sites, wanted).map_err(|problem| problem.at_line(self.head.line))?;
        let site = SiteHazard {
            sites: sites.len(),
            name: sites[index].name.clone(),
            at: sites[index].at,
            distance_km,
            ..SiteHazard::of(format)
        };
        Ok((site, &self.rows[index]))
    }
}
