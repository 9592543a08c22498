//! The errors and the warnings about an inventory, collected row by row in bounded memory.

use std::path::Path;

use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;

use super::columns::letters;

/// Largest number of problems that are listed.
const MAX_PROBLEMS: usize = 200;
/// Largest number of rows that a warning names.
const NAMED_ROWS: usize = 5;

/// A warning that can apply to several rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Doubt {
    NoId,
    Totals,
    FewCells,
    Unnamed,
    CarriedError,
    CarriedFormula,
    DecimalPoint,
    SmallLength,
    LargeLength,
    Squat,
    Stiffness,
    PadsMissing,
    DampingMass,
    PadAlone,
    PeakMissing,
    Example,
}

impl Doubt {
    fn words(self) -> &'static str {
        match self {
            Self::NoId => "have no id: the row number is used, such as row-12",
            Self::Totals => "are left out: they begin with \"total\" and have no dimensions",
            Self::FewCells => {
                "have fewer cells than there are headings: the missing ones count as empty; check that the file is \
                 complete"
            }
            Self::Unnamed => "have cells in columns without a heading: these cells are ignored",
            Self::CarriedError => "have an error such as #REF! in a column that is carried through",
            Self::CarriedFormula => {
                "have a formula without a value in a column that is carried through: it is left empty"
            }
            Self::DecimalPoint => {
                "have numbers with a decimal point while other rows have a decimal comma: check that no comma \
                 separates thousands"
            }
            Self::SmallLength => {
                "have a height below 20 mm or a side below 5 mm: check that it was not typed in m in a column of mm"
            }
            Self::LargeLength => {
                "have a height or a side above 50 m: check that it was not typed in mm in a column of m"
            }
            Self::Squat => {
                "are squat (Housner's restitution is negative; h/t < 0.707 for a uniform block): their landings are \
                 halted"
            }
            Self::Stiffness => {
                "have a stiffness under one edge that is very low, or with which the weight alone flattens the pad: \
                 check that N/m was not typed in place of N/mm"
            }
            Self::PadsMissing => {
                "have the stiffness of a pad without pads_per_edge: their cushion is not known, and no shock is \
                 computed"
            }
            Self::DampingMass => {
                "have a cushion with a damping ratio but no mass: their cushion is not known, and no shock is computed"
            }
            Self::PadAlone => {
                "describe a pad (pad_thickness, pads_per_edge, series_stiffness) without its stiffness: it is ignored"
            }
            Self::Example => "are examples of the template: delete them",
            Self::PeakMissing => "have a tolerance_duration without a tolerance: give the peak of that pulse",
        }
    }
}

/// The rows to which one warning applies.
#[derive(Debug, Clone)]
struct Doubtful {
    doubt: Doubt,
    count: usize,
    first: Vec<u32>,
    last: u32,
}

/// The problems and warnings so far.
#[derive(Debug)]
pub(super) struct Findings<'a> {
    path: &'a Path,
    sheet: Option<String>,
    problems: Problems,
    more: usize,
    doubts: Vec<Doubtful>,
}

/// Where a row is.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    pub(super) row: u32,
    pub(super) line: Option<usize>,
}

impl<'a> Findings<'a> {
    pub(super) fn new(path: &'a Path, sheet: Option<String>) -> Self {
        Self { path, sheet, problems: Problems::default(), more: 0, doubts: Vec::new() }
    }

    /// A problem of the file as a whole, or of its headings.
    pub(super) fn of_file(&mut self, line: Option<usize>, message: impl Into<String>, hint: impl Into<String>) {
        let mut problem = Problem::new(ProblemKind::Format, self.in_sheet(message.into())).hint(hint);
        problem.line = line;
        self.push(problem);
    }

    /// A problem of a row.
    pub(super) fn of_row(&mut self, at: At, message: &str, hint: impl Into<String>) {
        self.value(at, format!("row {}: {message}", at.row), Some(hint.into()));
    }

    /// A problem of a cell, under its heading.
    pub(super) fn of_cell(&mut self, at: At, column: u32, heading: &str, message: &str, hint: Option<String>) {
        if self.problems.len() >= MAX_PROBLEMS {
            self.more += 1;
            return;
        }
        let place = format!("row {}, column {} ({})", at.row, letters(column as usize), shorten(heading));
        self.value(at, format!("{place}: {message}"), hint);
    }

    fn value(&mut self, at: At, message: String, hint: Option<String>) {
        // Some problems of quantities have no hint of their own.
        let hint = hint.as_deref().unwrap_or("correct the cell, or leave it empty if the value is not known");
        let mut problem = Problem::value(self.in_sheet(message), hint);
        problem.line = at.line;
        self.push(problem);
    }

    fn in_sheet(&self, message: String) -> String {
        match &self.sheet {
            Some(sheet) => format!("sheet \"{}\", {message}", shorten(sheet)),
            None => message,
        }
    }

    /// Adds a problem.
    pub(super) fn push(&mut self, problem: Problem) {
        if self.problems.len() < MAX_PROBLEMS {
            self.problems.push(problem.shown(KeyStyle::File).in_file(self.path));
        } else {
            self.more += 1;
        }
    }

    /// Adds a warning about a row; it counts once for each row.
    pub(super) fn doubt(&mut self, doubt: Doubt, row: u32) {
        let at = self.doubts.iter().position(|other| other.doubt == doubt).unwrap_or_else(|| {
            self.doubts.push(Doubtful { doubt, count: 0, first: Vec::new(), last: 0 });
            self.doubts.len() - 1
        });
        let Some(entry) = self.doubts.get_mut(at) else { return };
        if entry.last == row {
            return;
        }
        entry.last = row;
        entry.count += 1;
        if entry.first.len() < NAMED_ROWS {
            entry.first.push(row);
        }
    }

    /// The warnings, or all problems.
    ///
    /// # Errors
    /// All problems.
    pub(super) fn finish(mut self) -> Result<Vec<String>, Problems> {
        if self.more > 0 {
            let message = format!("{} more problems are not listed", self.more);
            self.problems.push(Problem::value(message, "correct the problems above first").in_file(self.path));
        }
        self.doubts.sort_by_key(|entry| entry.doubt);
        self.problems.finish(Some(self.doubts.iter().map(Doubtful::words).collect()))
    }
}

impl Doubtful {
    /// `rows 4, 7, 9 and 120 more have …`
    fn words(&self) -> String {
        let rows: Vec<String> = self.first.iter().map(u32::to_string).collect();
        let more = self.count - self.first.len();
        let words = self.doubt.words();
        match (rows.as_slice(), more) {
            ([one], 0) => format!("row {one} {}", singular(words)),
            (_, 0) => format!("rows {} {words}", rows.join(", ")),
            (_, more) => format!("rows {} and {more} more {words}", rows.join(", ")),
        }
    }
}

/// The singular of a warning: `has no id` for `have no id`.
fn singular(words: &str) -> String {
    let pairs = [("have ", "has "), ("are ", "is "), ("describe ", "describes ")];
    let found = pairs.iter().find_map(|(many, one)| Some(format!("{one}{}", words.strip_prefix(many)?)));
    found.unwrap_or_else(|| words.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_capped_and_doubts_grouped() {
        let path = Path::new("objects.csv");
        let mut findings = Findings::new(path, Some("Ward 3".to_owned()));
        for row in 1..=3000 {
            findings.of_cell(At { row, line: None }, 5, "height [mm]", "\"x\" is not a number", None);
        }
        let problems = findings.finish().unwrap_err().problems;
        assert_eq!(problems.len(), MAX_PROBLEMS + 1);
        assert_eq!(
            problems[11].to_string(),
            "objects.csv: sheet \"Ward 3\", row 12, column F (height [mm]): \"x\" is not a number"
        );
        assert!(problems[MAX_PROBLEMS].message.starts_with("2800 more"));
        let mut findings = Findings::new(path, None);
        findings.doubt(Doubt::Squat, 7);
        for row in 10..=99 {
            findings.doubt(Doubt::NoId, row);
            findings.doubt(Doubt::NoId, row);
        }
        let warnings = findings.finish().unwrap();
        assert!(warnings[0].starts_with("rows 10, 11, 12, 13, 14 and 85 more have no id"), "{warnings:?}");
        assert!(warnings[1].starts_with("row 7 is squat"), "{warnings:?}");
    }
}
