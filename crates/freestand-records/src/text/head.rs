//! The lines above the numbers of a file, with their line numbers.

use super::fortran::{fields, leading_value};
use super::lines::{Line, Lines};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

/// The lines, counted from 1.
pub(crate) struct Head {
    pub(crate) lines: Vec<(usize, String)>,
}

impl Head {
    /// Takes up to `most` lines, down to the first for which `ends` holds; that line stays unread.
    pub(crate) fn take(
        rest: &mut Lines<'_>,
        most: usize,
        mut ends: impl FnMut(&Line<'_>) -> bool,
    ) -> Self {
        let above = rest.leading(|line| !ends(line)).take(most);
        Self {
            lines: above.map(|line| (line.number, line.text())).collect(),
        }
    }

    /// The first line for which `value` returns something, and what it returns.
    ///
    /// # Errors
    /// No such line; `key` is what it should begin with.
    pub(crate) fn find<'a>(
        &'a self,
        key: &str,
        hint: &str,
        value: impl Fn(&'a str) -> Option<&'a str>,
    ) -> Result<(usize, &'a str), Problem> {
        self.lines
            .iter()
            .find_map(|(line, text)| Some((*line, value(text)?)))
            .ok_or_else(|| {
                Problem::format(format!("the header has no line \"{key}\""), hint)
                    .at_line(self.lines.last().map_or(1, |(line, _)| *line))
            })
    }
}

/// The first line of the next component in a file of several, and how many lines of text stand above it.
///
/// # Errors
/// Numbers where a component should begin: the header declared fewer than there are.
pub(crate) fn next_title<'a>(
    rest: &mut Lines<'a>,
    is_title: impl Fn(&Line<'a>) -> bool,
) -> Result<(Option<Line<'a>>, usize), Problem> {
    let mut above = 0;
    for line in rest.filled() {
        if is_title(&line) {
            return Ok((Some(line), above));
        }
        if fields(line.bytes, |_| {}).is_ok() {
            return Err(Problem::format(
                "there are more values than the header declares",
                "the number of values in the header does not match the file: fetch it again",
            )
            .at_line(line.number));
        }
        above += 1;
    }
    Ok((None, above))
}

/// The number that follows a key; text after it, as in `100Hz`, is ignored.
///
/// # Errors
/// No number.
pub(crate) fn leading_number(key: &str, (line, text): (usize, &str)) -> Result<f64, Problem> {
    leading_value(text)
        .filter(|value| value.is_finite())
        .ok_or_else(|| {
            Problem::format(
                format!("\"{}\" is not a number for \"{key}\"", shorten(text)),
                "the header is damaged: fetch the file again",
            )
            .at_line(line)
        })
}
