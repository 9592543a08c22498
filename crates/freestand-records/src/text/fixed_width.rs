//! Blocks of numbers in columns of fixed width, as a Fortran format describes them: `8F10.3`,
//! `16I5`, `10F8`.

use super::fortran::{bad_field, fields, number};
use super::gaps::{gap, ordinary_note};
use super::line_width::LineWidth;
use super::lines::{Line, Lines};
use super::units::missing;
use crate::notes::Note;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

/// One repeated field: how many a line has, and how wide each is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Format {
    pub(crate) per_line: usize,
    pub(crate) width: usize,
}

/// Numbers read from a block.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Block {
    pub(crate) values: Vec<f64>,
    /// Line of the first value, counted from 1.
    pub(crate) first_line: usize,
}

impl Format {
    pub(crate) const fn new(per_line: usize, width: usize) -> Self {
        Self { per_line, width }
    }

    /// The format that `text` names: `(8F10.3)`, `8f9.6`, `1P5E14.7`, `16I5`, `10F8`, `F10.4`.
    ///
    /// `None` for fields of several kinds (`2I5,6F10.3`), which do not have a single width.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let text = text
            .trim()
            .trim_start_matches('(')
            .trim_end_matches(')')
            .trim()
            .to_ascii_uppercase();
        // A scale factor, 1P, changes what is printed but not its width.
        let text = text
            .split_once('P')
            .map_or(text.as_str(), |(_, rest)| rest.trim_start_matches(','));
        let kind = text.find(|c: char| !c.is_ascii_digit())?;
        let (repeat, rest) = text.split_at(kind);
        if !matches!(
            rest.as_bytes().first(),
            Some(b'F' | b'E' | b'D' | b'G' | b'I')
        ) {
            return None;
        }
        let per_line = if repeat.is_empty() {
            1
        } else {
            repeat.parse().ok()?
        };
        let (width, decimals) = rest[1..].split_once('.').unwrap_or((&rest[1..], "0"));
        decimals
            .trim_end_matches("E2")
            .trim_end_matches("E3")
            .parse::<usize>()
            .ok()?;
        let width = width.parse().ok()?;
        let sensible = (1..=10_000).contains(&per_line) && (1..=100).contains(&width);
        sensible.then_some(Self { per_line, width })
    }

    /// The format that a line names after the word, as in `Format: (8f9.6)` or `Format=8F10.3`,
    /// else in brackets.
    pub(crate) fn named_in(text: &str) -> Option<Self> {
        let behind_word = text.to_ascii_lowercase().rfind("format").and_then(|at| {
            let tail = text
                .get(at + 6..)?
                .trim_start_matches(|c: char| c.is_whitespace() || "=:(".contains(c));
            Self::parse(tail.split([')', ' ', '\t']).next()?)
        });
        let in_brackets = || {
            text.split('(')
                .skip(1)
                .find_map(|part| Self::parse(part.split(')').next()?))
        };
        behind_word.or_else(in_brackets)
    }

    /// Reads `count` values from the lines that follow, and leaves `lines` after the last of them.
    ///
    /// A field ends at its last column, whether or not a blank separates it from the next. Fortran
    /// aligns numbers to the right, so a line whose last number does not end at the end of a field
    /// was not written in this format: it is read as numbers between blanks.
    ///
    /// # Errors
    /// A field that is not a number, too few or too many fields on a line, a line that is too short
    /// although the others are not, the end of the file.
    pub(crate) fn read(
        self,
        lines: &mut Lines<'_>,
        count: usize,
        what: &str,
    ) -> Result<Block, Problem> {
        // A count in a damaged header must not reserve memory that the file cannot fill.
        let mut values: Vec<f64> = Vec::with_capacity(count.min(lines.bytes_left() / 2 + 1));
        let (mut first_line, mut line_width) = (0, LineWidth::default());
        while values.len() < count {
            let Some(line) = lines.next() else {
                return Err(Problem::format(
                    format!(
                        "the file ends after {} of {count} values of {what}",
                        values.len()
                    ),
                    "the file may be cut off: fetch it again",
                )
                .at_line(lines.line_number()));
            };
            if line.is_blank() {
                continue;
            }
            if first_line == 0 {
                first_line = line.number;
            }
            let before = values.len();
            let wanted = self.per_line.min(count - before);
            let by_column = self.read_line(&line, wanted, &mut values)?;
            line_width.see(&line, wanted * self.width, by_column);
            let found = values.len() - before;
            if found > wanted {
                return Err(Problem::format(
                    format!("the line has {found} values of {what}, but should have {wanted}"),
                    "the number of values in the header does not match the file: fetch it again",
                )
                .at_line(line.number));
            }
        }
        line_width.check()?;
        // A block without values has no line of its own; the line read last announced it.
        Ok(Block {
            values,
            first_line: if first_line == 0 {
                lines.line_number().max(1)
            } else {
                first_line
            },
        })
    }

    /// Reads up to `wanted` values of a line, and returns whether they fill its columns.
    ///
    /// # Errors
    /// A field that is not a number.
    pub(crate) fn read_line(
        self,
        line: &Line<'_>,
        wanted: usize,
        values: &mut Vec<f64>,
    ) -> Result<bool, Problem> {
        let text = line.bytes.trim_ascii_end();
        let before = values.len();
        let by_column = text.len() <= wanted * self.width
            && text.len().is_multiple_of(self.width)
            && text.chunks(self.width).all(|field| {
                number(field.trim_ascii())
                    .map(|number| values.push(number.value))
                    .is_some()
            });
        if by_column {
            return Ok(true);
        }
        values.truncate(before);
        fields(text, |number| values.push(number.value))
            .map_err(|bad| bad_field(&bad, line.number))?;
        Ok(false)
    }
}

impl Block {
    /// Refuses values that mark missing values, naming the line. Returns a note if a value is a
    /// marker by `is_marker` but no larger than the others.
    ///
    /// # Errors
    /// The first value that marks a missing value.
    pub(crate) fn refuse_missing(
        &self,
        format: Format,
        is_marker: impl Fn(f64) -> bool,
    ) -> Result<Option<Note>, Problem> {
        let line_of = |at: usize| self.first_line + at / format.per_line;
        if let Some(at) = gap(&self.values, &is_marker) {
            return Err(missing(&shorten(&self.values[at].to_string()), line_of(at)));
        }
        let ordinary = self.values.iter().position(|&value| is_marker(value));
        Ok(ordinary.map(|at| ordinary_note(self.values[at], line_of(at))))
    }

    /// The count that a header has at place `at`, from 0.
    ///
    /// # Errors
    /// A value that is not a whole number from 0 to 1e9, or is missing.
    pub(crate) fn count(&self, at: usize, format: Format, what: &str) -> Result<usize, Problem> {
        let value = self.values.get(at).copied().unwrap_or(f64::NAN);
        if (0.0..1e9).contains(&value) && value.fract() == 0.0 {
            return Ok(value as usize);
        }
        let message =
            format!("the number of {what} is {value}; a whole number below 1e9 is expected");
        Err(
            Problem::format(message, "the file is damaged: fetch it again")
                .at_line(self.first_line + at / format.per_line),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::lines::lines;

    #[test]
    fn formats() {
        for (text, expected) in [
            ("(8F10.3)", Some((8, 10))),
            ("8f9.6", Some((8, 9))),
            (" (1P5E14.7) ", Some((5, 14))),
            ("16I5", Some((16, 5))),
            ("10F8", Some((10, 8))),
            ("F10.4", Some((1, 10))),
            ("(5E15.7E3)", Some((5, 15))),
            ("2I5,6F10.3", None),
            ("8A10", None),
            ("0F10.3", None),
            ("8F0.3", None),
            ("", None),
            ("F", None),
            ("99999999999999999999F8", None),
        ] {
            assert_eq!(
                Format::parse(text),
                expected.map(|(n, w)| Format::new(n, w)),
                "{text}"
            );
        }
    }

    #[test]
    fn formats_are_found_in_titles() {
        for (text, expected) in [
            (
                "13400 acceleration pts, units=g.     (02)Format=(8f9.6)   ",
                Some((8, 9)),
            ),
            (
                " 100 Real-header values follow on 20 lines , Format = (5F15.6)",
                Some((5, 15)),
            ),
            (
                " 3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)  (8F10.6)",
                Some((8, 10)),
            ),
            ("12 pts, Format: 8F10.3", Some((8, 10))),
            ("12 points (UNITS: CM/SEC/SEC)", None),
        ] {
            assert_eq!(
                Format::named_in(text),
                expected.map(|(n, w)| Format::new(n, w)),
                "{text}"
            );
        }
    }

    fn read(text: &str, format: Format, count: usize) -> Result<Vec<f64>, String> {
        format
            .read(&mut lines(text.as_bytes()), count, "it")
            .map(|block| block.values)
            .map_err(told)
    }

    #[test]
    fn counts_are_whole_numbers() {
        let format = Format::new(2, 10);
        let text = b"         7      -1.0\n       2.5     1E+09\n";
        let block = format.read(&mut lines(text), 4, "it").unwrap();
        let count = |at| block.count(at, format, "it").map_err(told);
        assert_eq!(count(0), Ok(7));
        for (at, message) in [
            (
                1,
                "line 1: the number of it is -1; a whole number below 1e9 is expected",
            ),
            (
                2,
                "line 2: the number of it is 2.5; a whole number below 1e9 is expected",
            ),
            (
                3,
                "line 2: the number of it is 1000000000; a whole number below 1e9 is expected",
            ),
            (
                4,
                "line 3: the number of it is NaN; a whole number below 1e9 is expected",
            ),
        ] {
            assert_eq!(count(at), Err(message.to_owned()));
        }
    }

    fn told(problem: Problem) -> String {
        problem.to_string()
    }

    /// Exact: each value is the nearest f64 to the decimal number.
    #[test]
    fn fields_touch_and_lines_are_short() {
        assert_eq!(
            read("  3   9031932\n  7\n", Format::new(3, 5), 3),
            Ok(vec![3.0, 9031932.0, 7.0])
        );
        assert_eq!(
            read("   12   3456789\n    1\n", Format::new(3, 5), 4),
            Ok(vec![12.0, 34.0, 56789.0, 1.0])
        );
        let touching = "-1.2345E-1-6.7890E-2 1.0000E+0\n 2.0000E+0\n";
        assert_eq!(
            read(touching, Format::new(3, 10), 4),
            Ok(vec![-0.12345, -0.067890, 1.0, 2.0])
        );
        // Set by an editor, not by Fortran: no field ends where it should.
        assert_eq!(
            read("1.5 -2.5\n3.5", Format::new(2, 10), 3),
            Ok(vec![1.5, -2.5, 3.5])
        );
        // Between blanks this would be one number with two points.
        assert_eq!(
            read("123.456 7.8901\n", Format::new(2, 7), 2),
            Ok(vec![123.456, 7.8901])
        );
        assert_eq!(
            read("123.4567.89012\n", Format::new(2, 7), 2),
            Ok(vec![123.456, 7.89012])
        );
    }

    #[test]
    fn what_does_not_fit_is_refused_with_its_line() {
        assert_eq!(
            read("    1    2\n    3\n", Format::new(2, 5), 4),
            Err("line 2: the file ends after 3 of 4 values of it".to_owned())
        );
        assert!(
            read("    1    x\n", Format::new(2, 5), 2)
                .unwrap_err()
                .starts_with("line 1: ")
        );
        assert!(
            read("    1    2    3\n", Format::new(3, 5), 2)
                .unwrap_err()
                .contains("3 values")
        );
        assert!(
            read("", Format::new(2, 5), usize::MAX)
                .unwrap_err()
                .contains("ends after 0")
        );
        assert_eq!(
            Format::new(2, 5)
                .read(&mut lines(b""), 0, "it")
                .unwrap()
                .first_line,
            1
        );
        let block = Format::new(2, 5)
            .read(&mut lines(b"    1    2\n    3 -999\n"), 4, "it")
            .unwrap();
        assert!(
            block
                .refuse_missing(Format::new(2, 5), |v| v == -999.0)
                .map_err(told)
                .unwrap_err()
                .starts_with("line 2: ")
        );
    }
}
