//! The cells of one row as values; each that cannot be read is a problem with its place.

use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, parse, parse_in_unit, shorten};

use freestand_study::study::assessment::Questions;

use super::Rating;
use super::cell::{Cell, Row};
use super::columns::{Column, Holds, canonical};
use super::findings::{At, Doubt, Findings};
use super::layout::{Layout, Place};
use super::workbook::Merges;

/// A row with everything that is needed to read its cells.
pub(super) struct Values<'r, 'f, 'p> {
    pub(super) row: &'r Row,
    pub(super) layout: &'r Layout,
    pub(super) merges: &'r Merges,
    pub(super) has_decimal_comma: bool,
    /// The decimal signs so far, to detect files that mix them.
    pub(super) signs: &'r mut Signs,
    pub(super) findings: &'f mut Findings<'p>,
}

/// Decimal signs that were found, where both are allowed.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Signs {
    comma: bool,
    point: Option<u32>,
}

impl Signs {
    /// The first row with a point, if others have a comma.
    pub(super) fn mixed(self) -> Option<u32> {
        self.point.filter(|_| self.comma)
    }
}

/// Words that people write for a value that is not known.
const UNKNOWN: [&str; 10] = ["n_a", "na", "none", "unknown", "tbd", "tbc", "nil", "null", "nan", ""];

impl Values<'_, '_, '_> {
    /// The place of the row.
    pub(super) fn at(&self) -> At {
        At { row: self.row.number, line: self.row.line }
    }

    /// Reports a problem of a cell.
    pub(super) fn wrong(&mut self, column: Column, problem: &Problem) {
        let at = self.at();
        if let Some(place) = self.layout.place(column) {
            self.findings.of_cell(at, place.index, &place.heading, &problem.message, problem.hint.clone());
        }
    }

    /// Reports a wrong value, with what to write instead.
    pub(super) fn refuse(&mut self, column: Column, message: impl Into<String>, hint: &str) {
        self.wrong(column, &Problem::value(message, hint));
    }

    /// A cell that is not empty. A cell that is empty because it is merged with another is a
    /// problem.
    pub(super) fn cell(&mut self, column: Column) -> Option<(&Place, &Cell)> {
        let layout = self.layout;
        let place = layout.place(column).filter(|place| place.is_readable)?;
        if let Some(cell) = self.row.get(place.index).filter(|cell| !cell.is_blank()) {
            return Some((place, cell));
        }
        if let Some(other) = self.merges.value_of(self.row.number, place.index) {
            let message = format!("is empty because it is merged with {other}");
            self.refuse(column, message, "unmerge the cells, and put the value into each row");
        }
        None
    }

    /// Text without the blanks around it; empty where there is none.
    pub(super) fn text(&mut self, column: Column) -> String {
        let Some((_, cell)) = self.cell(column) else { return String::new() };
        let (shown, wrong) = match cell {
            Cell::Error(_) | Cell::Unevaluated | Cell::TooLong(_) => (String::new(), not_a_value(cell)),
            _ => (cell.shown().trim().to_owned(), None),
        };
        if let Some(problem) = wrong {
            self.wrong(column, &problem);
        }
        shown
    }

    /// A number as it is written, but with a decimal point.
    fn plain(&mut self, column: Column) -> Option<String> {
        let has_decimal_comma = self.has_decimal_comma;
        let number = self.row.number;
        let (_, cell) = self.cell(column)?;
        let read = match cell {
            Cell::Text(text) => plain_text(text.trim(), has_decimal_comma),
            Cell::Number(value) if value.is_finite() => Ok((format!("{value}"), false)),
            other => Err(not_a_value(other)
                .unwrap_or_else(|| Problem::value("is not a number", "write a number, or leave the cell empty"))),
        };
        match read {
            Ok((text, had_comma)) => {
                if has_decimal_comma {
                    self.signs.comma |= had_comma;
                    if !had_comma && text.contains('.') {
                        self.signs.point.get_or_insert(number);
                    }
                }
                Some(text)
            }
            Err(problem) => {
                self.wrong(column, &problem);
                None
            }
        }
    }

    /// A quantity in SI, and as text with its unit.
    fn quantity_text(&mut self, column: Column) -> Option<(f64, String)> {
        let Holds::Quantity(dimension) = column.spec().holds else { return None };
        let text = self.plain(column)?;
        let unit = self.layout.place(column)?.unit;
        let read = match unit {
            Some(unit) => parse_in_unit(&text, unit).map(|value| (value, format!("{text} {}", unit.symbol))),
            None => parse(&text, dimension).map(|value| (value, text.clone())),
        };
        match read {
            Ok(read) => Some(read),
            Err(problem) => {
                let problem = explained(problem, &text, column, unit);
                self.wrong(column, &problem);
                None
            }
        }
    }

    /// A quantity in SI.
    pub(super) fn quantity(&mut self, column: Column) -> Option<f64> {
        self.quantity_text(column).map(|(value, _)| value)
    }

    /// A positive quantity in SI, and as text with its unit.
    pub(super) fn positive_text(&mut self, column: Column) -> Option<(f64, String)> {
        let (value, text) = self.quantity_text(column)?;
        if value > 0.0 {
            return Some((value, text));
        }
        let message = format!("must be positive, not {}", shorten(&text));
        self.refuse(column, message, "leave the cell empty if the value is not known");
        None
    }

    /// A positive quantity in SI.
    pub(super) fn positive(&mut self, column: Column) -> Option<f64> {
        self.positive_text(column).map(|(value, _)| value)
    }

    /// A ratio above 0 and below 1.
    pub(super) fn share(&mut self, column: Column) -> Option<f64> {
        let value = self.positive(column)?;
        if value < 1.0 {
            return Some(value);
        }
        self.refuse(column, format!("must be above 0 and below 1, not {value}"), "write a ratio such as 0.1, or 10 %");
        None
    }

    /// A whole number, at least 1.
    pub(super) fn count(&mut self, column: Column) -> Option<u32> {
        let text = self.plain(column)?;
        // Workbooks have no whole numbers, and some programs write 2 as 2.0.
        let whole = text.strip_suffix(".0").unwrap_or(&text);
        match whole.parse::<u32>() {
            Ok(count) if count > 0 => Some(count),
            _ => {
                let message = format!("must be a whole number, at least 1, not \"{}\"", shorten(&text));
                self.refuse(column, message, "write a count, or leave the cell empty if it is not known");
                None
            }
        }
    }

    /// High, medium or low.
    pub(super) fn rating(&mut self, column: Column) -> Option<Rating> {
        let text = self.text(column);
        match canonical(&text).as_str() {
            "" if text.is_empty() => None,
            "h" | "high" => Some(Rating::High),
            "m" | "medium" | "med" => Some(Rating::Medium),
            "l" | "low" => Some(Rating::Low),
            _ => {
                let message = format!("\"{}\" is not a rating", shorten(&text));
                self.refuse(column, message, "write H, M or L (high, medium, low), or leave the cell empty");
                None
            }
        }
    }

    /// What is asked of the object.
    pub(super) fn questions(&mut self, column: Column) -> Option<Questions> {
        let text = self.text(column);
        if text.is_empty() {
            return None;
        }
        let plain: String = text.to_lowercase().chars().filter(|c| !c.is_whitespace()).collect();
        let found = Questions::ALL.iter().find(|(name, _)| *name == plain).map(|(_, questions)| *questions);
        if found.is_none() {
            let message = format!("\"{}\" is not a question", shorten(&text));
            self.refuse(column, message, "write falls or falls+shock, or leave the cell empty");
        }
        found
    }

    /// Two positive ratios in rising order, `0.3-0.5` or `0.3 to 0.5`, or one for both.
    pub(super) fn range(&mut self, column: Column) -> Option<(f64, f64)> {
        let (_, cell) = self.cell(column)?;
        let whole = cell.shown();
        let is_text = matches!(cell, Cell::Text(_));
        let unit = self.layout.place(column)?.unit;
        let read = |text: &str| unit.map_or_else(|| parse(text, Dimension::Ratio), |unit| parse_in_unit(text, unit));
        let Some((low, high)) = split_range(&whole).filter(|_| is_text) else {
            let text = self.plain(column)?;
            return self.ratios(column, &text, read(&text).map(|value| (value, value)));
        };
        let has_decimal_comma = self.has_decimal_comma;
        let part = |text: &str| plain_text(text, has_decimal_comma).and_then(|(text, _)| read(&text));
        let both = part(low).and_then(|low| Ok((low, part(high)?)));
        self.ratios(column, &whole, both)
    }

    fn ratios(&mut self, column: Column, text: &str, both: Result<(f64, f64), Problem>) -> Option<(f64, f64)> {
        match both {
            Ok((low, high)) if low > 0.0 && low <= high => return Some((low, high)),
            Ok(_) => {
                let message = format!("\"{}\" is not a positive value or a rising range", shorten(text));
                self.refuse(column, message, "write 0.4, or the lowest and the highest value, such as 0.3-0.5");
            }
            Err(problem) => self.wrong(column, &explained(problem, text, column, None)),
        }
        None
    }

    /// Adds a warning about this row.
    pub(super) fn doubt(&mut self, doubt: Doubt) {
        self.findings.doubt(doubt, self.row.number);
    }
}

/// A number with a decimal point, and whether it had a comma.
fn plain_text(text: &str, has_decimal_comma: bool) -> Result<(String, bool), Problem> {
    let commas = text.matches(',').count();
    if commas == 0 {
        return Ok((text.to_owned(), false));
    }
    if has_decimal_comma && commas == 1 && !text.contains('.') {
        return Ok((text.replace(',', "."), true));
    }
    Err(Problem::value(
        format!("\"{}\" has a comma in the number", shorten(text)),
        "write a decimal point, and nothing between the thousands, such as 1500.5",
    ))
}

/// A number or a range with decimal commas, with points in their place; any other text is
/// unchanged.
pub(super) fn pointed(text: &str) -> String {
    let is_plain = |part: &str| plain_text(part, true).is_ok();
    let is_number = match split_range(text) {
        Some((low, high)) => is_plain(low) && is_plain(high),
        None => is_plain(text),
    };
    if is_number { text.replace(',', ".") } else { text.to_owned() }
}

/// The problem of a cell that has no value.
fn not_a_value(cell: &Cell) -> Option<Problem> {
    let (message, hint) = match cell {
        Cell::Text(_) => return None,
        Cell::Number(value) if value.is_finite() => return None,
        Cell::Number(_) => ("is not a finite number".to_owned(), "type the number again"),
        Cell::Bool(value) => (
            format!("{} is not a number", if *value { "TRUE" } else { "FALSE" }),
            "write the number, or leave the cell empty",
        ),
        Cell::Date(date) => (
            format!("is a date ({}), not a number", shorten(date)),
            "format the cell as a number and type the value again: spreadsheets turn 1-2 and 3/4 into dates",
        ),
        Cell::Error(error) => (format!("is the error {}", shorten(error)), "correct the formula, or type the value"),
        Cell::Unevaluated => (
            "is a formula that was saved without a value".to_owned(),
            "open the workbook in a spreadsheet program, which computes it, and save it again",
        ),
        Cell::TooLong(chars) => (
            format!("has {chars} characters, more than a cell of a spreadsheet can hold"),
            "shorten it, and check that every quote is closed",
        ),
    };
    Some(Problem::value(message, hint))
}

/// The problem of a quantity, with a hint for a table; `unit` is that of the heading.
fn explained(problem: Problem, text: &str, column: Column, unit: Option<&Unit>) -> Problem {
    if UNKNOWN.contains(&canonical(text).as_str()) {
        let message = format!("\"{}\" is not a value", shorten(text));
        return Problem::value(message, "leave the cell empty if the value is not known");
    }
    let is_number = text.contains(|c: char| c.is_ascii_digit()) && text.trim().parse::<f64>().is_ok();
    let spec = column.spec();
    match unit {
        Some(unit) if !is_number => problem.hint(format!(
            "write the number alone, because the heading has the unit ({}), or leave the cell empty",
            unit.symbol
        )),
        None if is_number && !spec.unit.is_empty() => {
            let heading = format!("or put the unit into the heading, such as \"{} [{}]\"", spec.name, spec.unit);
            let hint = problem.hint.as_ref().map_or_else(|| heading.clone(), |hint| format!("{hint}, {heading}"));
            problem.hint(hint)
        }
        _ => problem,
    }
}

/// The two ends of `0.3-0.5`, `0.3 – 0.5`, `0.3 to 0.5` or `0.3..0.5`; a minus at the start or
/// after an `e` is a sign.
fn split_range(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    for mark in [" to ", "...", "..", "…", "–", "—"] {
        if let Some((low, high)) = text.split_once(mark) {
            return Some((low.trim(), high.trim()));
        }
    }
    let (at, _) = text.match_indices('-').find(|(at, _)| {
        let before = text.get(..*at).unwrap_or_default().trim_end();
        before.ends_with(|c: char| c.is_ascii_digit() || matches!(c, '%' | '.'))
    })?;
    Some((text.get(..at)?.trim(), text.get(at + 1..)?.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_split() {
        for (text, ends) in [
            ("0.3-0.5", Some(("0.3", "0.5"))),
            ("0.3 – 0.5", Some(("0.3", "0.5"))),
            (" 0.3 to 0.5", Some(("0.3", "0.5"))),
            ("0.3..0.5", Some(("0.3", "0.5"))),
            ("30 % - 50 %", Some(("30 %", "50 %"))),
            ("3e-1", None),
            ("-0.3", None),
            ("0.3", None),
        ] {
            assert_eq!(split_range(text), ends, "{text}");
        }
    }

    #[test]
    fn a_decimal_comma_stands_alone() {
        assert_eq!(plain_text("0,35", true).unwrap(), ("0.35".to_owned(), true));
        assert_eq!(plain_text("0.35", true).unwrap(), ("0.35".to_owned(), false));
        for text in ["1.500,5", "1,500,000"] {
            assert!(plain_text(text, true).is_err());
        }
        for (text, with_points) in
            [("0,3-0,5", "0.3-0.5"), ("0.3-0,5", "0.3-0.5"), ("2,3 m", "2.3 m"), ("1.500,5", "1.500,5"), ("0.5", "0.5")]
        {
            assert_eq!(pointed(text), with_points);
        }
        assert!(plain_text("0,35", false).unwrap_err().hint.is_some());
    }
}
