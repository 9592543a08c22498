//! Reads the rows of a CSV.

use freestand_input::problem::Problem;

use super::cell::{Cell, Flow, MAX_COLUMNS, MAX_ROWS, Row};
use super::problems::bad_file;
use freestand_input::formula::unguarded;

/// Longest row \[bytes\]: more than all columns of a sheet with a few words each.
const MAX_ROW_BYTES: u64 = 4 << 20;

/// Passes the rows that are not empty to `on_row`, as long as it asks for more.
///
/// # Errors
/// Quotes that are not closed or end within a cell, and rows, columns or lines beyond what a sheet
/// has.
pub(super) fn rows(
    text: &str,
    separator: u8,
    on_row: &mut dyn FnMut(Row) -> Flow,
) -> Result<(), Problem> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let mut record = csv::StringRecord::new();
    let (mut number, mut line) = (0u32, 1usize);
    loop {
        let start = reader.position().byte();
        let more = reader.read_record(&mut record).map_err(|error| {
            let hint = "save the sheet again as CSV (UTF-8) or as .xlsx";
            bad_file(format!("cannot be read as CSV: {error}"), hint).at_line(line)
        })?;
        if !more {
            return Ok(());
        }
        let end = reader.position().byte();
        let raw = raw(text.as_bytes(), start, end);
        // Empty lines are rows of a spreadsheet; the reader skips them.
        let blank = raw
            .iter()
            .take_while(|byte| matches!(byte, b'\r' | b'\n'))
            .count();
        let (before, raw) = raw.split_at(blank);
        let skipped = line_ends(before);
        line += skipped;
        number = u32::try_from(skipped)
            .ok()
            .and_then(|skipped| number.checked_add(skipped)?.checked_add(1))
            .unwrap_or(u32::MAX);
        check_row(raw, &record, separator, number, line, end - start)?;
        let cells: Vec<(u32, Cell)> = (0u32..)
            .zip(&record)
            .filter(|(_, text)| !text.is_empty())
            .map(|(column, text)| (column, Cell::text(unguarded(text).to_owned())))
            .collect();
        let width = u32::try_from(record.len()).ok();
        if !cells.is_empty()
            && on_row(Row {
                number,
                line: Some(line),
                cells,
                width,
            }) == Flow::Enough
        {
            return Ok(());
        }
        line += line_ends(raw);
    }
}

/// The bytes of a row; the reader ends a row at CR and leaves a following LF to the next row.
fn raw(text: &[u8], start: u64, end: u64) -> &[u8] {
    let (Ok(start), Ok(end)) = (usize::try_from(start), usize::try_from(end)) else {
        return &[];
    };
    let is_half = start
        .checked_sub(1)
        .and_then(|before| text.get(before..=start))
        == Some(b"\r\n");
    text.get(start + usize::from(is_half)..end)
        .unwrap_or_default()
}

/// LF, CR LF and CR each end a line.
fn line_ends(bytes: &[u8]) -> usize {
    let mut count = 0;
    let mut last = 0;
    for &byte in bytes {
        count += usize::from(byte == b'\r' || byte == b'\n' && last != b'\r');
        last = byte;
    }
    count
}

fn check_row(
    raw: &[u8],
    record: &csv::StringRecord,
    separator: u8,
    number: u32,
    line: usize,
    length: u64,
) -> Result<(), Problem> {
    let wrong = |message: String, hint: &str| Err(bad_file(message, hint).at_line(line));
    if number > MAX_ROWS {
        return wrong(
            format!("the file has more than {MAX_ROWS} rows, the limit of a sheet"),
            "split the inventory into one file for each building",
        );
    }
    if record.len() > MAX_COLUMNS as usize {
        return wrong(
            format!(
                "row {number} has {} cells; a sheet has at most {MAX_COLUMNS} columns",
                record.len()
            ),
            "check that this is an inventory; freestand inventory template prints one",
        );
    }
    if let Some(message) = bad_quotes(raw, separator) {
        return wrong(
            format!("row {number}: {message}"),
            "double the quotes inside a cell (\"19\"\" rack\"), and close the quotes around it",
        );
    }
    if length > MAX_ROW_BYTES {
        return wrong(
            format!(
                "row {number} has {} MB; a row has at most {} MB",
                length >> 20,
                MAX_ROW_BYTES >> 20
            ),
            "check that this is an inventory and that every quote is closed",
        );
    }
    Ok(())
}

/// The CSV library reads `"19" rack` as `19 rack`, and a quote that is not closed as the rest of
/// the file.
fn bad_quotes(raw: &[u8], separator: u8) -> Option<String> {
    if !raw.contains(&b'"') {
        return None;
    }
    let mut bytes = raw.iter().copied().peekable();
    let mut at_start = true;
    while let Some(byte) = bytes.next() {
        if byte == b'"' && at_start {
            loop {
                match bytes.next() {
                    None => return Some("a quote is not closed".to_owned()),
                    Some(b'"') if bytes.next_if_eq(&b'"').is_none() => break,
                    Some(_) => {}
                }
            }
            match bytes.peek() {
                None | Some(b'\r' | b'\n') => {}
                Some(&next) if next == separator => {}
                Some(_) => return Some("text follows a closing quote".to_owned()),
            }
            at_start = false;
        } else {
            at_start = byte == separator;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, separator: u8) -> Result<Vec<(u32, usize, Vec<String>)>, Problem> {
        let mut all = Vec::new();
        rows(text, separator, &mut |row| {
            let cells = row
                .cells
                .iter()
                .map(|(column, cell)| format!("{column}={}", cell.shown()))
                .collect();
            all.push((row.number, row.line.unwrap(), cells));
            Flow::More
        })?;
        Ok(all)
    }

    #[test]
    fn rows_are_counted_as_a_spreadsheet_does_and_lines_as_an_editor_does() {
        for ending in ["\n", "\r\n", "\r"] {
            let text = ["a,b", "", "\"x\ny\",", ",,", "c,'=d", "", ""].join(ending);
            let expected = [
                (1, 1, vec!["0=a".to_owned(), "1=b".to_owned()]),
                (3, 3, vec!["0=x\ny".to_owned()]),
                (5, 6, vec!["0=c".to_owned(), "1==d".to_owned()]),
            ];
            assert_eq!(read(&text, b',').unwrap(), expected, "{ending:?}");
        }
        assert_eq!(read("a;\"b;c\"\n", b';').unwrap()[0].2, ["0=a", "1=b;c"]);
    }

    #[test]
    fn quotes_that_would_swallow_or_lose_text_are_refused() {
        for (text, said, line) in [
            ("a,b\n1,\"2\n3,4\n", "not closed", 2),
            ("a,b\n\n\"19\" rack\",4\n", "follows a closing quote", 3),
        ] {
            let problem = read(text, b',').unwrap_err();
            assert!(
                problem.message.contains(said) && problem.hint.is_some(),
                "{problem}"
            );
            assert_eq!(problem.line, Some(line));
        }
        // A quote within a cell that does not begin with a quote is an ordinary character.
        assert_eq!(read("a,19\" rack\n", b',').unwrap()[0].2[1], "1=19\" rack");
        assert_eq!(
            read("a,\"19\"\" rack\"\n", b',').unwrap()[0].2[1],
            "1=19\" rack"
        );
    }

    #[test]
    fn rows_and_columns_have_the_limits_of_a_sheet() {
        let wide = ",".repeat(MAX_COLUMNS as usize);
        assert!(
            read(&wide, b',')
                .unwrap_err()
                .message
                .contains("16384 columns")
        );
        let long = "\n".repeat(MAX_ROWS as usize) + "x";
        assert!(
            read(&long, b',')
                .unwrap_err()
                .message
                .contains("1048576 rows")
        );
    }
}
