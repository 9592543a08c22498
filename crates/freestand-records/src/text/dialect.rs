//! How a row of numbers is written: its separators and its decimal sign, detected from the row
//! itself.

use super::fortran::{BadField, Number, fields, number, words};

/// What separates the columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Separator {
    Byte(u8),
    Blank,
}

/// How the rows are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dialect {
    pub(crate) separator: Separator,
    pub(crate) decimal_comma: bool,
}

/// How a line of numbers is written; `None` if it is not one.
pub(crate) fn dialect_of(line: &[u8]) -> Option<Dialect> {
    let has = |byte: u8| line.contains(&byte);
    let candidates = [
        (has(b';'), Separator::Byte(b';'), has(b',') && !has(b'.')),
        (has(b'\t') && has(b','), Separator::Byte(b'\t'), true),
        (has(b','), Separator::Byte(b','), false),
        (
            has(b',') && has(b'"') && !has(b'.'),
            Separator::Byte(b','),
            true,
        ),
        (has(b'\t'), Separator::Byte(b'\t'), false),
        (has(b','), Separator::Blank, true),
        (true, Separator::Blank, false),
    ];
    candidates
        .into_iter()
        .filter(|(possible, ..)| *possible)
        .map(|(_, separator, decimal_comma)| Dialect {
            separator,
            decimal_comma,
        })
        .find(|dialect| looks_like_a_row(dialect, line))
}

/// All cells are numbers, missing or empty, and not all are empty. Missing values count: `NaN` in
/// the first row must be refused as a value, not skipped as a header.
fn looks_like_a_row(dialect: &Dialect, line: &[u8]) -> bool {
    let (mut numbers, mut words, mut others) = (0, 0, 0);
    for cell in cells(dialect, line) {
        match cell {
            Ok(_) => numbers += 1,
            Err(BadField::Missing(text)) if text.is_empty() => {}
            Err(BadField::Missing(_)) => words += 1,
            Err(BadField::NotANumber(_)) => others += 1,
        }
    }
    others == 0 && (numbers > 0 || words > 1)
}

/// The cells of a line, each a number or the reason why it is not one.
pub(crate) fn cells(dialect: &Dialect, line: &[u8]) -> Vec<Result<Number, BadField>> {
    let of = |text: &[u8]| cell(dialect, text);
    match dialect.separator {
        Separator::Blank => {
            // After a bad field nothing is known about the rest, so it is taken word by word.
            let mut numbers = Vec::new();
            if !dialect.decimal_comma && fields(line, |number| numbers.push(Ok(number))).is_ok() {
                return numbers;
            }
            words(line).map(of).collect()
        }
        // Tabs before the first column and after the last one only align the columns.
        Separator::Byte(b'\t') => line.trim_ascii().split(|&b| b == b'\t').map(of).collect(),
        Separator::Byte(byte) => {
            let mut quoted = false;
            let parts = line.split(|&b| {
                quoted ^= b == b'"';
                b == byte && !quoted
            });
            parts.map(of).collect()
        }
    }
}

fn cell(dialect: &Dialect, text: &[u8]) -> Result<Number, BadField> {
    let text = text.trim_ascii();
    let text = text
        .strip_prefix(b"\"")
        .and_then(|text| text.strip_suffix(b"\""))
        .unwrap_or(text)
        .trim_ascii();
    let found = match text.iter().position(|&b| b == b',') {
        Some(at) if dialect.decimal_comma => {
            let mut with_point = text.to_vec();
            with_point[at] = b'.';
            number(&with_point)
        }
        _ => number(text),
    };
    found.ok_or_else(|| match text {
        [] => BadField::Missing(String::new()),
        _ => BadField::new(text),
    })
}
