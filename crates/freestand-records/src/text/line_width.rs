//! Whether the lines of a block fill the columns of its format. A line that lost a character is too
//! short.

use super::lines::Line;
use freestand_input::problem::Problem;

/// What is known about the lines of a block.
#[derive(Debug, Default)]
pub(crate) struct LineWidth {
    /// Lines that fill their columns.
    filled: usize,
    /// Whether one of them begins with a blank. Where an editor removed leading blanks, only lines
    /// of negative numbers are full.
    has_blank: bool,
    /// Lines that are shorter than their columns and do not end with one.
    short: usize,
    /// The first of these: its line, its length and the length that its fields have \[characters\].
    first_short: Option<(usize, usize, usize)>,
}

impl LineWidth {
    /// Adds a line whose fields need `full` characters, and whether it was read by its columns.
    pub(crate) fn see(&mut self, line: &Line<'_>, full: usize, by_column: bool) {
        let length = line.bytes.trim_ascii_end().len();
        if by_column {
            self.filled += 1;
            self.has_blank |= line.bytes.first().is_some_and(u8::is_ascii_whitespace);
        } else if length < full {
            self.short += 1;
            self.first_short.get_or_insert((line.number, length, full));
        }
    }

    /// Refuses a block whose lines fill their columns except for one that is too short: its numbers
    /// are damaged.
    ///
    /// In a block that was not written in columns, few lines fit them by chance, and a length means
    /// nothing.
    ///
    /// # Errors
    /// The first line that is too short.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        match self
            .first_short
            .filter(|_| self.has_blank && self.filled > self.short)
        {
            None => Ok(()),
            Some((line, length, full)) => {
                let message =
                    format!("the line has {length} characters, but its numbers need {full}");
                Err(Problem::format(
message,
"a character is missing or the file is cut off: fetch it again, or align the numbers with \
                     those of the other lines",
).at_line(line))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::text::fixed_width::Format;
    use crate::text::lines::lines;

    /// 8 lines of 4F8.3 and a last of 2.
    fn block() -> String {
        let value = |i: i32| format!("{:8.3}", f64::from(i * 37 % 23 - 11) * 0.731);
        let lines: Vec<String> = (0..9)
            .map(|row| {
                (4 * row..(4 * row + 4).min(34))
                    .map(value)
                    .collect::<String>()
                    + "\r\n"
            })
            .collect();
        lines.concat()
    }

    fn read(text: &str) -> Result<Vec<f64>, String> {
        let block = Format::new(4, 8).read(&mut lines(text.as_bytes()), 34, "it");
        block
            .map(|block| block.values)
            .map_err(|problem| problem.to_string())
    }

    #[test]
    fn a_line_that_lost_a_character_is_refused() {
        let whole = block();
        assert_eq!(read(&whole).unwrap().len(), 34);
        let mut refused = 0;
        for at in 0..whole.len() {
            let mut cut = whole.clone();
            let lost = cut.remove(at);
            let line = whole[..at].matches('\n').count() + 1;
            match read(&cut) {
                Err(problem) => {
                    assert!(
                        problem.starts_with(&format!("line {line}: ")),
                        "{at}: {problem}"
                    );
                    refused += 1;
                }
                // CR or LF alone ends a line too.
                Ok(values) => assert!(
                    lost.is_whitespace() && values == read(&whole).unwrap(),
                    "{at} {lost:?}"
                ),
            }
        }
        assert_eq!(refused, 34 * 8);
        // Cut off within the last number.
        assert!(
            read(&whole[..whole.len() - 4])
                .unwrap_err()
                .contains("line 9: the line has 14 characters")
        );
    }

    #[test]
    fn blocks_that_are_not_set_in_columns_are_read_as_before() {
        let whole = block();
        let values = read(&whole).unwrap();
        let trimmed: String = whole
            .lines()
            .map(|line| line.trim().to_owned() + "\n")
            .collect();
        let single: String = whole
            .lines()
            .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ") + "\n")
            .collect();
        // C widens a field that its number does not fit; nothing is lost.
        let wider = whole.replacen("  -8.041", "-8.0410000", 1);
        assert_ne!(wider, whole);
        for text in [trimmed, single, wider] {
            assert_eq!(read(&text), Ok(values.clone()), "{text}");
        }
    }
}
