//! CSV tables with named columns, read strictly: a cell that cannot be read is refused with its line
//! and column.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use freestand_input::formula::unguarded;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::{nearest, some};
use freestand_study::run::Progress;

use super::doubt::UnusedColumn;
use super::go_on;

/// A heading such as `pfv [m/s]`: its name in small letters with `_` for blanks, and the unit in
/// brackets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Heading {
    pub(crate) name: String,
    pub(crate) unit: Option<String>,
    /// As it is written.
    written: String,
}

/// A row with its line in the file, from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) line: usize,
    cells: Vec<String>,
}

/// The largest number of problems with rows of a table that are reported one by one.
const MAX_TOLD: usize = 20;

/// The most lines that are named of one problem.
const MAX_LINES: usize = 5;

/// Number of rows after which the caller is asked whether to continue: some milliseconds of work.
const ROWS_UNASKED: usize = 4096;

/// The problems with the rows of a table, which are reported together.
#[derive(Default)]
pub(crate) struct RowProblems<'p> {
    told: Problems,
    /// The other lines with the same problem as each of those that are told.
    again: Vec<Vec<usize>>,
    /// Problems beyond [`MAX_TOLD`].
    more: usize,
    /// Who may stop the reading.
    progress: Option<Progress<'p>>,
    rows: usize,
}

impl<'p> RowProblems<'p> {
    /// For a table whose reading the caller can stop.
    pub(crate) fn watched(progress: Progress<'p>) -> Self {
        Self {
            progress: Some(progress),
            ..Self::default()
        }
    }

    /// Counts a row, and now and then asks the caller whether to continue.
    ///
    /// # Errors
    /// The caller stopped the reading.
    pub(crate) fn row(&mut self) -> Result<(), Problem> {
        self.rows += 1;
        match self.progress {
            Some(progress) if self.rows.is_multiple_of(ROWS_UNASKED) => go_on(progress),
            _ => Ok(()),
        }
    }

    /// Adds a problem. One that another row has, too, is told once, with its lines.
    pub(crate) fn push(&mut self, problem: Problem) {
        let is_same = |told: &Problem| {
            Problem {
                line: None,
                ..told.clone()
            } == Problem {
                line: None,
                ..problem.clone()
            }
        };
        let known = self.told.problems.iter().position(is_same);
        if let (Some(lines), Some(line)) = (
            known.and_then(|place| self.again.get_mut(place)),
            problem.line,
        ) {
            lines.push(line);
        } else if self.told.len() < MAX_TOLD {
            self.again.push(Vec::new());
            self.told.push(problem);
        } else {
            self.more += 1;
        }
    }

    /// The value of a result; if it has a problem instead, the problem is collected.
    pub(crate) fn keep<T>(&mut self, result: Result<T, Problem>) -> Option<T> {
        result.map_err(|problem| self.push(problem)).ok()
    }

    /// # Errors
    /// The problems that were collected in this file: the first [`MAX_TOLD`], and the number of the
    /// rest.
    pub(crate) fn finish(mut self, path: &Path) -> Result<(), Problems> {
        for (problem, lines) in self.told.problems.iter_mut().zip(&self.again) {
            if !lines.is_empty() {
                let named: Vec<String> = lines.iter().map(usize::to_string).collect();
                let word = if lines.len() == 1 { "line" } else { "lines" };
                problem.message = format!(
                    "{} (also {word} {})",
                    problem.message,
                    some(&named, MAX_LINES)
                );
            }
        }
        if self.more > 0 {
            let message = format!(
                "and {} more {}",
                self.more,
                if self.more == 1 {
                    "problem"
                } else {
                    "problems"
                }
            );
            self.told.push(
                Problem::value(
                    message,
                    "correct the problems above, and run the command again",
                )
                .in_file(path),
            );
        }
        self.told.finish(Some(()))
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Table {
    pub(crate) path: PathBuf,
    pub(crate) headings: Vec<Heading>,
    pub(crate) rows: Vec<Row>,
    /// Line of the headings.
    line: usize,
    /// Comments, which begin with `#`, above the headings.
    pub(crate) comments: Vec<String>,
    /// What the headings should be.
    hint: &'static str,
}

impl Table {
    /// Reads the bytes of a file; `hint` says what its headings should be. A row with a wrong
    /// number of cells is left out, and its problem is collected.
    pub(crate) fn read(
        bytes: &[u8],
        path: &Path,
        hint: &'static str,
        problems: &mut RowProblems<'_>,
    ) -> Result<Self, Problem> {
        let format = |message: String| {
            Problem::new(ProblemKind::Format, message)
                .in_file(path)
                .hint(hint)
        };
        if bytes.starts_with(b"PK\x03\x04") {
            let problem = format("this is a workbook, not a CSV file".to_owned());
            return Err(problem.hint("save the sheet as CSV"));
        }
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .comment(Some(b'#'))
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(bytes);
        let mut records = reader.records().map(|record| {
            let record = record.map_err(|error| {
                let line = error
                    .position()
                    .map_or(1, |position| position.line() as usize);
                format("the text is not UTF-8, or a quotation mark is not closed".to_owned())
                    .at_line(line)
            })?;
            let line = record
                .position()
                .map_or(1, |position| line_of(bytes, position));
            Ok(Row {
                line,
                cells: record
                    .iter()
                    .map(|cell| unguarded(cell).to_owned())
                    .collect(),
            })
        });
        let head: Row = records
            .next()
            .unwrap_or_else(|| Err(format("the file is empty".to_owned()).at_line(1)))?;
        let headings: Vec<Heading> = head.cells.iter().map(|cell| heading(cell)).collect();
        if let [only] = headings.as_slice()
            && let Some((_, name)) = [(';', "semicolons"), ('\t', "tabs")]
                .iter()
                .find(|(c, _)| only.written.contains(*c))
        {
            let message = format!(
                "the cells are separated by {name}, and this table has commas between them"
            );
            let hint = "save it as CSV with commas between the cells, and write decimals with a point: 0.2";
            return Err(format(message).at_line(head.line).hint(hint));
        }
        let mut rows = Vec::new();
        for row in records {
            let row = row?;
            problems.row()?;
            if row.cells.len() != headings.len() {
                let message = format!(
                    "this row has {} cells, and the header has {}",
                    row.cells.len(),
                    headings.len()
                );
                let hint = "write one row per line with a cell for each heading; quote a text that has a comma";
                problems.push(format(message).at_line(row.line).hint(hint));
                continue;
            }
            rows.push(row);
        }
        let comments = String::from_utf8_lossy(bytes)
            .lines()
            .take_while(|line| line.starts_with('#'))
            .map(str::to_owned)
            .collect();
        let table = Self {
            path: path.to_path_buf(),
            headings,
            rows,
            line: head.line,
            comments,
            hint,
        };
        let mut names = HashSet::new();
        for one in &table.headings {
            if !one.name.is_empty() && !names.insert(&one.name) {
                return Err(table.header_problem(format!(
                    "the column \"{}\" appears twice",
                    shorten(&one.name)
                )));
            }
        }
        if table.rows.is_empty() && problems.told.is_empty() {
            return Err(table.header_problem("no rows follow the headings".to_owned()));
        }
        Ok(table)
    }

    /// The columns that are not among `known`: unsaid, a misspelt one would be ignored silently.
    pub(crate) fn unused(&self, known: &[&str]) -> Vec<UnusedColumn> {
        let unknown = |heading: &&Heading| {
            !heading.name.is_empty() && !known.contains(&heading.name.as_str())
        };
        let unused = self.headings.iter().filter(unknown);
        unused
            .map(|heading| UnusedColumn {
                heading: heading.written.clone(),
                near: nearest(&heading.name, known).map(str::to_owned),
            })
            .collect()
    }

    /// A problem with the headings.
    pub(crate) fn header_problem(&self, message: String) -> Problem {
        Problem::new(ProblemKind::Format, message)
            .in_file(&self.path)
            .at_line(self.line)
            .hint(self.hint)
    }

    /// The place of a column.
    pub(crate) fn column(&self, name: &str) -> Option<usize> {
        self.headings
            .iter()
            .position(|heading| heading.name == name)
    }

    /// The place of a column that must be there.
    pub(crate) fn needed(&self, name: &str) -> Result<usize, Problem> {
        self.column(name).ok_or_else(|| {
            let names: Vec<&str> = self
                .headings
                .iter()
                .map(|heading| heading.name.as_str())
                .collect();
            let similar = nearest(name, &names)
                .map(|near| format!("; is it \"{near}\"?"))
                .unwrap_or_default();
            self.header_problem(format!("there is no column \"{name}\"{similar}"))
        })
    }

    /// What `read` makes of each row; `problems` are those that were found before. `read` adds the
    /// problems of a row to them and then returns `None`, so that all problems are reported
    /// together.
    pub(crate) fn each_row<'a, T>(
        &'a self,
        mut problems: RowProblems<'_>,
        mut read: impl FnMut(&'a Row, &mut RowProblems<'_>) -> Option<T>,
    ) -> Result<Vec<T>, Problems> {
        let values = self
            .rows
            .iter()
            .filter_map(|row| read(row, &mut problems))
            .collect();
        problems.finish(&self.path)?;
        Ok(values)
    }

    /// A problem with a cell.
    pub(crate) fn cell_problem(&self, row: &Row, column: usize, message: &str) -> Problem {
        let written = self
            .headings
            .get(column)
            .map_or("", |heading| heading.written.as_str());
        Problem::new(
            ProblemKind::Value,
            format!(
                "column {} (\"{}\"): {message}",
                column + 1,
                shorten(written)
            ),
        )
        .in_file(&self.path)
        .at_line(row.line)
        .hint("correct the cell, or leave out the row")
    }

    /// The text of a cell.
    pub(crate) fn text<'a>(&self, row: &'a Row, column: usize) -> &'a str {
        row.cells.get(column).map_or("", String::as_str)
    }

    /// The text of a cell that must not be empty.
    pub(crate) fn filled<'a>(&self, row: &'a Row, column: usize) -> Result<&'a str, Problem> {
        match self.text(row, column) {
            "" => Err(self.cell_problem(row, column, "the cell is empty")),
            text => Ok(text),
        }
    }

    /// A number.
    fn number(
        &self,
        row: &Row,
        column: usize,
        kind: &str,
        is_fine: impl Fn(f64) -> bool,
    ) -> Result<f64, Problem> {
        let text = self.filled(row, column)?;
        let value = text
            .parse::<f64>()
            .ok()
            .filter(|value| value.is_finite() && is_fine(*value));
        value.ok_or_else(|| {
            self.cell_problem(row, column, &format!("\"{}\" is not {kind}", shorten(text)))
        })
    }

    /// A number above 0.
    pub(crate) fn positive(&self, row: &Row, column: usize) -> Result<f64, Problem> {
        self.number(row, column, "a number above 0", |value| value > 0.0)
    }

    /// A number of 0 or more.
    pub(crate) fn non_negative(&self, row: &Row, column: usize) -> Result<f64, Problem> {
        self.number(row, column, "a number of 0 or more", |value| value >= 0.0)
    }

    /// An angle from −`most` to `most` \[degrees\].
    pub(crate) fn degrees(&self, row: &Row, column: usize, most: f64) -> Result<f64, Problem> {
        let kind = format!("an angle from -{most} to {most} degrees");
        let value = self.number(row, column, &kind, |value| value.abs() <= most);
        value.map_err(|problem| problem.hint("write decimal degrees, such as -33.9"))
    }

    /// The place of the column, if its cell in this row is not empty.
    pub(crate) fn given(&self, row: &Row, name: &str) -> Option<usize> {
        self.column(name)
            .filter(|&column| !self.text(row, column).is_empty())
    }

    /// A number of 0 or more; `None` without the column or in an empty cell.
    pub(crate) fn optional(
        &self,
        row: &Row,
        column: Option<usize>,
    ) -> Result<Option<f64>, Problem> {
        let filled = column.filter(|&column| !self.text(row, column).is_empty());
        filled
            .map(|column| self.non_negative(row, column))
            .transpose()
    }
}

/// The line of a record, whose position is where the one before it ended: above it may be blank lines
/// and comments.
fn line_of(bytes: &[u8], position: &csv::Position) -> usize {
    let mut line = position.line() as usize;
    let mut rest = bytes.get(position.byte() as usize..).unwrap_or_default();
    while let Some((first, after)) = rest.split_first() {
        rest = match first {
            b'\n' => {
                line += 1;
                after
            }
            b'\r' => after,
            // Up to the end of the comment, which is counted above.
            b'#' => rest
                .iter()
                .position(|byte| *byte == b'\n')
                .map_or(&[][..], |end| &rest[end..]),
            _ => break,
        };
    }
    line
}

fn heading(cell: &str) -> Heading {
    let split = cell
        .strip_suffix(']')
        .and_then(|cell| cell.rsplit_once('['));
    let (name, unit) = split.map_or((cell, None), |(name, unit)| {
        (name, Some(unit.trim().to_owned()))
    });
    Heading {
        name: name.trim().to_lowercase().replace(' ', "_"),
        unit,
        written: cell.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table, or its first problem.
    fn read(text: &str) -> Result<Table, Problem> {
        let mut problems = RowProblems::default();
        let table = Table::read(text.as_bytes(), Path::new("t.csv"), "a, b", &mut problems)?;
        problems
            .told
            .problems
            .into_iter()
            .next()
            .map_or(Ok(table), Err)
    }

    #[test]
    fn lines_are_those_of_the_file() {
        let table = read("\u{feff}# a comment\nid, pfv [m/s]\n\n\"a, b\",0.5\n# more\r\n\r\nc,x\n")
            .unwrap();
        assert_eq!(table.headings[1].unit.as_deref(), Some("m/s"));
        assert_eq!(
            (table.rows[0].line, table.text(&table.rows[0], 0)),
            (4, "a, b")
        );
        assert_eq!(table.positive(&table.rows[0], 1), Ok(0.5));
        let problem = table.positive(&table.rows[1], 1).unwrap_err();
        assert_eq!(
            problem.to_string(),
            "t.csv:7: column 2 (\"pfv [m/s]\"): \"x\" is not a number above 0"
        );
    }

    /// All bad rows are reported at once, also rows with too few cells. Of more than 20 problems
    /// the first 20 are reported, and the number of the rest.
    #[test]
    fn the_problems_of_all_rows_are_told() {
        let numbers = |text: &str| {
            let mut problems = RowProblems::default();
            let table =
                Table::read(text.as_bytes(), Path::new("t.csv"), "a, b", &mut problems).unwrap();
            table.each_row(problems, |row, problems| {
                problems.keep(table.positive(row, 1))
            })
        };
        assert_eq!(numbers("a,b\nx,1\ny,2\n"), Ok(vec![1.0, 2.0]));
        let problems = numbers("a,b\nx,0\ny\ny,2\nz,\n").unwrap_err();
        let mut lines: Vec<Option<usize>> = problems
            .problems
            .iter()
            .map(|problem| problem.line)
            .collect();
        lines.sort();
        assert_eq!(lines, [Some(2), Some(3), Some(5)]);
        let rows: String = (0..50).map(|i| format!("x,{}\n", -i)).collect();
        let many = numbers(&format!("a,b\n{rows}")).unwrap_err();
        assert_eq!(
            (many.len(), many.problems[20].to_string().as_str()),
            (21, "t.csv: and 30 more problems")
        );
        // The same problem of many rows is one, with their lines.
        let same = numbers(&format!("a,b\n{}y,1\n", "x,0\n".repeat(287))).unwrap_err();
        assert_eq!(same.len(), 1, "{same}");
        assert!(
            same.problems[0]
                .message
                .ends_with("(also lines 3, 4, 5, 6, 7 and 281 more)"),
            "{same}"
        );
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let cases = [
            ("", "empty"),
            ("a,b\n", "no rows"),
            ("a,b\n1\n", "t.csv:2: this row has 1 cells"),
            ("a,a [g]\n1,2\n", "twice"),
            (
                "object;motion;pgv [m/s]\na;m1;0,2\n",
                "t.csv:1: the cells are separated by semicolons",
            ),
            ("a\tb\n1\t2\n", "separated by tabs"),
            ("PK\u{3}\u{4}", "a workbook"),
        ];
        for (text, said) in cases {
            let problem = read(text).unwrap_err();
            assert!(
                problem.to_string().contains(said) && problem.hint.is_some(),
                "{problem}"
            );
        }
        assert!(
            read("objekt,b\n1,2\n")
                .unwrap()
                .needed("object")
                .unwrap_err()
                .message
                .contains("is it \"objekt\"?")
        );
    }
}
