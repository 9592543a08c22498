//! What is wrong or doubtful in a list: one problem for each kind and column, however many cells.

use std::collections::HashMap;

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;
use freestand_input::words::counted;

use super::columns::{Column, letters};

/// How serious a problem is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Severity {
    /// The cell has no value.
    Error,
    /// The value is used; a person should look at it.
    Doubt,
}

impl Severity {
    /// Its name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

macro_rules! kinds {
    ($($kind:ident $severity:ident $what:literal $hint:literal;)*) => {
        /// The kind of a problem.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize, strum::IntoStaticStr)]
        #[strum(serialize_all = "kebab-case")]
        pub enum Kind {
            $(#[doc = $what] $kind,)*
        }

        impl Kind {
            /// Its name in outputs.
            pub fn name(self) -> &'static str {
                self.into()
            }

            /// How serious it is.
            pub fn severity(self) -> Severity {
                match self { $(Self::$kind => Severity::$severity,)* }
            }

            /// What is wrong, in words.
            pub fn words(self) -> &'static str {
                match self { $(Self::$kind => $what,)* }
            }

            /// What to do about it.
            fn hint(self) -> &'static str {
                match self { $(Self::$kind => $hint,)* }
            }
        }
    };
}

kinds! {
    Unreadable Error "cannot be read"
        "correct the cell, or leave it empty if the value is not known";
    UnitMissing Error "has no unit"
        "put the unit into the heading, such as \"Height (mm)\", or give it in a mapping file (`columns`)";
    UnitWrong Error "has a unit that does not fit or is not known"
        "write a unit that is known, such as mm, in, kg, lb";
    UnitContradicted Error "has one unit by its heading and another by the column of units or a sentence of the list"
        "write the unit into the cell, such as \"200 cm\", or correct the heading, the column of units or the sentence";
    NumberAmbiguous Error "can be read in two ways"
        "write the number without thousands, or give decimal = \"comma\" or \"point\" under [numbers] of a mapping file (`columns`)";
    OutOfRange Error "is not possible"
        "check the number and its unit";
    FloorUnknown Error "is not a floor that is known"
        "name it under [floors] of a mapping file, or among the floors under [building] of the study";
    StoreysMissing Error "names floors, and nothing says how many storeys the building has"
        "give `storeys`, or a study with the building";
    Formula Error "is a formula without a value"
        "open the workbook in a spreadsheet program, correct the formula and save it again";
    DimensionOrder Doubt "does not say which size is which; the largest was taken as the height"
        "write the order into the heading, such as \"Size (H x W x D)\"";
    UnitAssumed Doubt "states no unit; the one that fits the list was taken"
        "put the unit into the heading";
    Approximate Doubt "is a rough value or a range; its middle was taken"
        "measure it if the verdict depends on it";
    DuplicateId Doubt "occurs more than once; a number was added to the later ones"
        "give every row its own id";
    FloorNumbering Doubt "does not say whether floor 1 is the ground; it was taken as the one above"
        "give first_floor = \"ground\" or \"above\" under [building] of the study or [floors] of a mapping file";
    FloorFromSection Doubt "was taken from the heading of the section"
        "add a column with the floor";
    Density Doubt "does not fit the size: the density is outside 20 to 3000 kg/m³"
        "check the mass, the sizes and their units";
    Height Doubt "is outside 0.1 to 6 m"
        "check the number and its unit";
    Side Doubt "is outside 0.05 to 6 m"
        "check the number and its unit";
    Slenderness Doubt "is more than 15 times the shorter side"
        "check the height and the sides";
    Low Doubt "is less than half of the shorter side"
        "check that height and depth are not swapped";
    Mass Doubt "is outside 0.5 kg to 100 t"
        "check the number and its unit";
    Tolerance Doubt "is outside 0.3 to 1000 g"
        "check the number and its unit";
    Stiffness Doubt "is outside 10 to 1000000 N/mm, or the object alone would press its pads by more than 20 mm"
        "check that N/m was not typed for N/mm";
    TwoColumns Doubt "differs from another column with the same meaning; this one was used"
        "correct one of the columns, or set it to \"ignore\" in a mapping file";
    Merged Doubt "is merged over several objects; only the first has the value"
        "unmerge the cells and put the value into each row";
    Casters Doubt "speaks of wheels and does not say for certain that all of them are braked, or that there are none: taken as free to roll, so it does not rock"
        "write no, free or braked in a column casters";
    PadsMissing Doubt "is the stiffness of one pad without pads_per_edge; no shock is computed"
        "add a column pads_per_edge";
    DampingMass Doubt "is a cushion with a damping ratio but no mass; no shock is computed"
        "give the mass";
    PadAlone Doubt "describes a pad without its stiffness; it is ignored"
        "give the stiffness of the pad";
    UpperAlone Doubt "describes what stands on the object in part only; it is ignored"
        "give upper_height and upper_thickness, and upper_mass";
    PulseAlone Doubt "is the duration of a pulse without its peak"
        "give the peak of that pulse as the tolerance";
    ImplausibleSize Doubt "is a size that such an object can hardly have: no verdict until it is confirmed"
        "correct the cell, or confirm it as it is";
    Mezzanine Doubt "is half a storey; it was taken as the one above the ground"
        "give its height under [floors] of a mapping file, such as \"Mezzanine\" = 0.2";
    NotUnderstood Doubt "is not understood; it was not used"
        "write it in one of the usual words, or leave the cell empty if it is not known";
    AnchoredUnclear Doubt "does not clearly say that it is anchored, or its casters are free; it was assessed as free"
        "write yes or no; what is anchored does not roll";
    Round Doubt "is the name of a round object, so it is calculated as a cylinder"
        "if it is not round, write box in a column shape";
    HiddenRow Doubt "is not shown by a spreadsheet, because it is hidden or a filter leaves it out; it was read like the others"
        "show the row, or delete it if the object is no longer there";
    Unprintable Doubt "contains a control character, which nobody sees and most programs refuse"
        "type the cell again";
    Example Doubt "is an example of the template"
        "delete the row";
}

/// A problem: one kind in one column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// How serious it is.
    pub severity: Severity,
    /// The kind.
    pub kind: Kind,
    /// The column, if it belongs to one.
    pub column: Option<Column>,
    /// Its heading in the file.
    pub heading: Option<String>,
    /// The place of the column in the sheet, counted from 0.
    pub index: Option<u32>,
    /// The rows.
    pub rows: Vec<u32>,
    /// Up to three different texts of these cells.
    pub examples: Vec<String>,
    /// What to do about it.
    pub hint: String,
    /// What is wrong in the first of them, in words.
    pub detail: Option<String>,
    /// Texts that would mend or confirm the cells, such as `F17=1.45 m`.
    pub edits: Vec<String>,
}

impl Finding {
    /// The cells, such as `D2`; empty where no column is known.
    pub fn cells(&self) -> Vec<String> {
        let Some(index) = self.index else {
            return Vec::new();
        };
        let letters = letters(index as usize);
        self.rows
            .iter()
            .map(|row| format!("{letters}{row}"))
            .collect()
    }

    /// What is wrong, in a sentence without the cells.
    pub fn message(&self) -> String {
        match &self.detail {
            Some(detail) => detail.clone(),
            None => format!("{} {}", self.name(), self.kind.words()),
        }
    }

    /// How the column is called: its heading, or its name.
    fn name(&self) -> String {
        match (&self.heading, self.column) {
            (Some(heading), _) => shorten(heading),
            (None, Some(column)) => column.name().to_owned(),
            (None, None) => "the row".to_owned(),
        }
    }

    /// Its cells, or its rows where no column is known: `row 7`.
    pub(super) fn places(&self) -> Vec<String> {
        let cells = self.cells();
        if cells.is_empty() {
            self.rows.iter().map(|row| format!("row {row}")).collect()
        } else {
            cells
        }
    }

    /// `error: unreadable: Height: 60 cells (D2, D3, D4 …), such as "tall0x"; hint: …`.
    pub fn line(&self) -> String {
        let begun = format!("{}: {}", self.severity.name(), self.kind.name());
        let such = self.examples.first().map_or_else(String::new, |text| {
            format!(", such as \"{}\"", shorten(text))
        });
        if self.rows.is_empty() {
            return format!("{begun}: {}{such}; hint: {}", self.message(), self.hint);
        }
        let noun = if self.index.is_some() { "cell" } else { "row" };
        let more = if self.rows.len() > 3 { " …" } else { "" };
        let mut first = self.places();
        first.truncate(3);
        let said = match (&self.detail, self.kind) {
            (Some(detail), _) => format!("; {detail}"),
            (None, Kind::Unreadable) => String::new(),
            (None, kind) => format!("; {}", kind.words()),
        };
        format!(
            "{begun}: {}: {} ({}{more}){such}{said}; hint: {}",
            self.name(),
            counted(self.rows.len(), noun),
            first.join(", "),
            self.hint
        )
    }
}

/// Cells of which a hint names the edit.
const NAMED_EDITS: usize = 3;

/// The most rows that a warning names.
const NOTED_ROWS: usize = 5;

/// At most this many lines on the console.
const MAX_LINES: usize = 12;

/// The problems as lines for the console, most cells first.
pub fn console_lines(findings: &[Finding]) -> Vec<String> {
    let mut order: Vec<&Finding> = findings.iter().collect();
    // What leaves objects without a verdict comes first.
    order.sort_by_key(|finding| {
        (
            finding.edits.is_empty(),
            std::cmp::Reverse(finding.rows.len()),
            finding.severity,
        )
    });
    let mut lines: Vec<String> = order
        .iter()
        .take(MAX_LINES)
        .map(|finding| finding.line())
        .collect();
    if order.len() > MAX_LINES {
        let more = counted(order.len() - MAX_LINES, "more kind");
        lines.push(format!("and {more}: --json"));
    }
    lines
}

/// The problems so far.
#[derive(Debug, Default)]
pub(super) struct Findings {
    all: Vec<Finding>,
    places: HashMap<(Kind, Option<Column>, Option<u32>), usize>,
    /// Every doubt is an error.
    is_strict: bool,
    notes: Vec<Noted>,
}

/// Something about rows that is no problem of a cell.
#[derive(Debug)]
struct Noted {
    words: &'static str,
    rows: Vec<u32>,
    count: usize,
}

/// Where a problem is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'h> {
    pub column: Option<Column>,
    pub index: Option<u32>,
    pub heading: Option<&'h str>,
}

impl Place<'_> {
    /// A problem of whole rows.
    pub(super) const ROW: Place<'static> = Place {
        column: None,
        index: None,
        heading: None,
    };
}

impl Findings {
    /// None so far; `is_strict`: every doubt is an error.
    pub(super) fn new(is_strict: bool) -> Self {
        Self {
            is_strict,
            ..Self::default()
        }
    }

    /// Adds a cell to the problem of its kind and column; with a detail, that is said in place of the words of
    /// the kind.
    pub(super) fn add(
        &mut self,
        kind: Kind,
        place: Place<'_>,
        row: Option<u32>,
        example: &str,
        detail: &str,
    ) {
        let severity = if self.is_strict {
            Severity::Error
        } else {
            kind.severity()
        };
        let key = (kind, place.column, place.index);
        let at = *self.places.entry(key).or_insert_with(|| {
            self.all.push(Finding {
                severity,
                kind,
                column: place.column,
                heading: place.heading.map(str::to_owned),
                index: place.index,
                rows: Vec::new(),
                examples: Vec::new(),
                hint: kind.hint().to_owned(),
                detail: (!detail.is_empty()).then(|| detail.to_owned()),
                edits: Vec::new(),
            });
            self.all.len() - 1
        });
        let Some(finding) = self.all.get_mut(at) else {
            return;
        };
        if let Some(row) = row
            && finding.rows.last() != Some(&row)
        {
            finding.rows.push(row);
        }
        if finding.examples.len() < 3
            && !example.is_empty()
            && !finding.examples.iter().any(|other| other == example)
        {
            finding.examples.push(shorten(example));
        }
    }

    /// Adds the problems of later rows.
    pub(super) fn append(&mut self, later: Self) {
        for finding in later.all {
            let key = (finding.kind, finding.column, finding.index);
            match self.places.get(&key).and_then(|at| self.all.get_mut(*at)) {
                Some(first) => {
                    first.rows.extend(finding.rows);
                    first.edits.extend(finding.edits);
                    for example in finding.examples {
                        if first.examples.len() < 3 && !first.examples.contains(&example) {
                            first.examples.push(example);
                        }
                    }
                }
                None => {
                    self.places.insert(key, self.all.len());
                    self.all.push(finding);
                }
            }
        }
        for noted in later.notes {
            self.take_note(noted);
        }
    }

    fn at(&mut self, kind: Kind, place: Place<'_>) -> Option<&mut Finding> {
        let at = self.places.get(&(kind, place.column, place.index))?;
        self.all.get_mut(*at)
    }

    /// Replaces the hint of a problem; that of its first cell stays, as its message does.
    pub(super) fn hint(&mut self, kind: Kind, place: Place<'_>, hint: &str) {
        if let Some(finding) = self
            .at(kind, place)
            .filter(|found| found.hint == kind.hint())
        {
            hint.clone_into(&mut finding.hint);
        }
    }

    /// Adds a text that would mend or confirm a cell of a problem.
    pub(super) fn propose(&mut self, kind: Kind, place: Place<'_>, edit: &str) {
        let Some(finding) = self.at(kind, place) else {
            return;
        };
        let cell = edit.split_once('=').map_or(edit, |(cell, _)| cell);
        if finding.edits.is_empty() {
            let same = finding.examples.first().map_or("", String::as_str);
            finding.hint = if edit.ends_with(&format!("={}", same.trim())) {
                format!("correct {cell}, or confirm it by `edit = \"{edit}\"`")
            } else {
                format!(
                    "read {cell} otherwise by `edit = \"{edit}\"`, or confirm it by `edit = \"{cell}={same}\"`"
                )
            };
        } else if finding.edits.len() < NAMED_EDITS {
            finding
                .hint
                .push_str(&format!("; read {cell} otherwise by `edit = \"{edit}\"`"));
        }
        finding.edits.push(edit.to_owned());
    }

    /// Adds a warning about a row.
    pub(super) fn note(&mut self, words: &'static str, row: u32) {
        self.take_note(Noted {
            words,
            rows: vec![row],
            count: 1,
        });
    }

    /// Adds rows to the warning of the same words.
    fn take_note(&mut self, more: Noted) {
        match self.notes.iter_mut().find(|one| one.words == more.words) {
            Some(first) => {
                first.count += more.count;
                let room = NOTED_ROWS.saturating_sub(first.rows.len());
                first.rows.extend(more.rows.into_iter().take(room));
            }
            None => self.notes.push(more),
        }
    }

    /// Replaces the hints of problems that can be answered in another way.
    pub(super) fn answer(&mut self, hint: impl Fn(&Finding) -> Option<String>) {
        for finding in &mut self.all {
            if let Some(hint) = hint(finding) {
                finding.hint = hint;
            }
        }
    }

    /// The problems, and the warnings about rows.
    pub(super) fn finish(mut self) -> (Vec<Finding>, Vec<String>) {
        for finding in self
            .all
            .iter_mut()
            .filter(|finding| finding.edits.len() > NAMED_EDITS)
        {
            let more = counted(finding.edits.len() - NAMED_EDITS, "more cell");
            finding
                .hint
                .push_str(&format!("; {more} to correct or confirm in the same way"));
        }
        let said =
            |noted: &Noted| format!("{}: {}", named_rows(&noted.rows, noted.count), noted.words);
        let notes = self.notes.iter().map(said).collect();
        (self.all, notes)
    }
}

/// A file that is not what it should be.
pub(super) fn bad_file(message: impl Into<String>, hint: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Format, message).hint(hint)
}

/// The first of these rows, of which there are `count`: `row 3`, `rows 3, 4, 5, 7, 8 and 12 more`.
pub(super) fn named_rows(rows: &[u32], count: usize) -> String {
    let named: Vec<String> = rows.iter().take(NOTED_ROWS).map(u32::to_string).collect();
    let noun = if count == 1 { "row" } else { "rows" };
    let more = match count - named.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("{noun} {}{more}", named.join(", "))
}

/// What is said of a row.
pub(super) struct RowFindings<'a> {
    pub findings: &'a mut Findings,
    /// What is doubtful about this object.
    pub doubts: Vec<Kind>,
}

impl<'a> RowFindings<'a> {
    /// Nothing so far.
    pub(super) fn new(findings: &'a mut Findings) -> Self {
        Self {
            findings,
            doubts: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, place: Place, kind: Kind, row: u32, example: &str, detail: &str) {
        self.findings.add(kind, place, Some(row), example, detail);
        if kind.severity() == Severity::Doubt && !self.doubts.contains(&kind) {
            self.doubts.push(kind);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_one_for_each_kind_and_column() {
        let mut findings = Findings::default();
        let place = Place {
            column: Some(Column::Height),
            index: Some(3),
            heading: Some("Height"),
        };
        for row in 2..62 {
            findings.add(
                Kind::Unreadable,
                place,
                Some(row),
                &format!("tall{}x", row % 2),
                "",
            );
        }
        let (all, _) = findings.finish();
        assert_eq!(
            all[0].line(),
            "error: unreadable: Height: 60 cells (D2, D3, D4 …), such as \"tall0x\"; hint: correct the cell, \
             or leave it empty if the value is not known"
        );
        assert_eq!(
            (all.len(), all[0].examples.len(), all[0].rows.len()),
            (1, 2, 60)
        );
    }

    #[test]
    fn the_console_has_a_dozen_lines() {
        let mut findings = Findings::default();
        for index in 0..15 {
            let place = Place {
                column: None,
                index: Some(index),
                heading: Some("x"),
            };
            for row in 0..=index {
                findings.add(Kind::Unreadable, place, Some(row), "", "");
            }
        }
        let lines = console_lines(&findings.finish().0);
        assert_eq!(
            (lines.len(), lines[12].as_str()),
            (13, "and 3 more kinds: --json")
        );
        assert!(lines[0].contains("15 cells"), "{}", lines[0]);
    }
}
