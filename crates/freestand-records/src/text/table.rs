//! Columns of numbers in a text. Separators, headers and comments are detected from the text.

use super::dialect::{Dialect, Separator, cells, dialect_of};
use super::digit_style::DigitStyle;
use super::fortran::{BadField, Number, bad_field, fields};
use super::gaps::Markers;
use super::lines::{Line, lines};
use super::units::GAP;
use freestand_input::problem::Problem;
use freestand_input::words::counted;

/// The last line on which the first row of numbers may be; some files have thousands of lines above
/// it.
const HEADER_LINES: usize = 20_000;

/// Rows among which one shows the decimal sign.
const SIGN_ROWS: usize = 100;

/// How many of the lines above the numbers are kept, half of them from the top, where units and
/// steps are stated, and half from the bottom, where headings are.
const KEPT_LINES: usize = 1000;

/// Longest line \[bytes\]: some hundred thousand numbers, more than any table has. Parsing a longer
/// one would take ten times the memory of its text, only to refuse it.
const LONGEST_ROW: usize = 4 << 20;

/// A column.
#[derive(Debug, Default)]
pub(crate) struct Column {
    pub(crate) values: Vec<f64>,
    /// Its finest printed digit counts 10^this.
    pub(crate) last_digit_exponent: i32,
    /// Some whole number in it begins with a zero, `0123`, or is `-0`.
    zero_padded: bool,
    /// How its numbers are printed.
    pub(crate) digit_style: DigitStyle,
    /// How many of its numbers are printed as whole numbers.
    whole: usize,
}

impl Column {
    fn new() -> Self {
        Self {
            last_digit_exponent: i32::MAX,
            ..Self::default()
        }
    }

    fn push(&mut self, number: &Number, line: usize) {
        self.digit_style.see(number, line);
        self.whole += usize::from(number.tail == 0 && number.last_digit_exponent >= 0);
        self.values.push(number.value);
        self.last_digit_exponent = self.last_digit_exponent.min(number.last_digit_exponent);
        // -0 is not a whole number either.
        let is_minus_zero = number.value == 0.0 && number.value.is_sign_negative();
        self.zero_padded |= number.zero_padded || is_minus_zero && number.last_digit_exponent == 0;
    }
}

/// A table and the lines above it.
pub(crate) struct Table {
    pub(crate) dialect: Dialect,
    pub(crate) columns: Vec<Column>,
    /// Lines above the numbers that are neither blank nor comments.
    pub(crate) header: Vec<(usize, String)>,
    /// Comment lines above the numbers, without the `#`.
    pub(crate) comments: Vec<(usize, String)>,
    pub(crate) line_of_first_value: usize,
    /// The step of the old dialect whose first row is `npts dt`; the values are then one series.
    pub(crate) series_dt_s: Option<f64>,
    /// Whether the first row stated the number of rows and is not one of them.
    pub(crate) has_row_of_counts: bool,
}

/// Whether a line holds data: neither blank nor comment.
fn is_row(line: &Line<'_>) -> bool {
    !line.is_blank() && !line.is_comment()
}

/// Reads a table.
pub(crate) fn read(bytes: &[u8]) -> Result<Table, Problem> {
    if let Some(line) = lines(bytes).find(|line| line.bytes.len() > LONGEST_ROW) {
        let message = format!(
            "a line of {} MB is not a row of a table",
            line.bytes.len() >> 20
        );
        return Err(Problem::format(
            message,
            "write one row per line, or the values of one series under an AT2 header (NPTS, DT)",
        )
        .at_line(line.number));
    }
    let (mut header, mut comments) = (Vec::new(), Vec::new());
    let mut rest = lines(bytes);
    let (dialect, first) = loop {
        let before = rest.clone();
        let Some(line) = rest.next().filter(|line| line.number <= HEADER_LINES) else {
            return Err(Problem::format(
                "no row of numbers was found; the format is not recognised",
                "known formats: PEER AT2, those of the agencies, and text with columns of \
                 time and acceleration",
            ));
        };
        if line.is_comment() {
            let text = line.text();
            keep(
                &mut comments,
                (
                    line.number,
                    text.trim_start().trim_start_matches('#').trim().to_owned(),
                ),
            );
        } else if let Some(dialect) = dialect_of(line.bytes) {
            rest = before;
            break (dialect, line);
        } else if !line.is_blank() {
            keep(&mut header, (line.number, line.text().trim().to_owned()));
        }
    };
    // A first row of whole numbers does not show the decimal sign.
    let shows_sign = |line: &Line| line.bytes.iter().any(|byte| matches!(byte, b',' | b'.'));
    let below = rest
        .clone()
        .filter(is_row)
        .take(SIGN_ROWS)
        .find(shows_sign)
        .and_then(|line| dialect_of(line.bytes));
    let dialect = match below {
        Some(below) if !shows_sign(&first) && below.separator == dialect.separator => below,
        _ => dialect,
    };
    check_not_a_broken_row(&dialect, &header, first.bytes)?;
    let rows = rest.filter(is_row);
    let mut table = Table {
        dialect,
        columns: Vec::new(),
        header,
        comments,
        line_of_first_value: first.number,
        series_dt_s: None,
        has_row_of_counts: false,
    };
    if !read_as_series(&mut table, rows.clone())? {
        read_rows(&mut table, rows)?;
        check_first_row(&table)?;
    }
    Ok(table)
}

fn keep(lines: &mut Vec<(usize, String)>, line: (usize, String)) {
    if lines.len() == KEPT_LINES {
        lines.remove(KEPT_LINES / 2);
    }
    lines.push(line);
}

impl Table {
    /// The first number of a single column of whole numbers if it is the number of those below it:
    /// it may be a value or their count. With fewer than ten numbers, a coincidence is too likely.
    pub(crate) fn possible_count(&self) -> Option<usize> {
        let [column] = self.columns.as_slice() else {
            return None;
        };
        let below = column.values.len().saturating_sub(1);
        (below >= 10
            && column.last_digit_exponent >= 0
            && column.values.first() == Some(&(below as f64)))
        .then_some(below)
    }

    /// The line of row `row` (from 0). It is searched for only when a message needs it, because
    /// storing the lines of all rows would take more memory than a column.
    pub(crate) fn line_of_row(&self, bytes: &[u8], row: usize) -> usize {
        self.lines_of_rows(bytes)
            .nth(row)
            .unwrap_or(self.line_of_first_value)
    }

    /// The lines of the rows, in order.
    pub(crate) fn lines_of_rows<'a>(
        &self,
        bytes: &'a [u8],
    ) -> impl Iterator<Item = usize> + use<'a> {
        lines(bytes)
            .skip(self.line_of_first_value - 1)
            .filter(is_row)
            .map(|line| line.number)
    }

    /// The cells of a header line, if there are as many as columns.
    pub(crate) fn names(&self, text: &str) -> Option<Vec<String>> {
        let wanted = self.columns.len();
        let own = match self.dialect.separator {
            Separator::Byte(byte) => Some(byte),
            Separator::Blank => None,
        };
        // The separators of the header often differ from those of the rows.
        own.into_iter()
            .chain([b',', b';', b'\t'])
            .map(|byte| quoted_cells(text, byte))
            .chain([words(text), gaps(text)])
            .find_map(|mut cells| {
                if cells.len() == wanted + 1 && cells.last().is_some_and(String::is_empty) {
                    cells.pop();
                }
                (cells.len() == wanted).then_some(cells)
            })
    }
}

/// The cells of one line of CSV, without the blanks around them; none of an empty line.
pub(crate) fn quoted_cells(text: &str, separator: u8) -> Vec<String> {
    // A reader of CSV builds its tables anew: for each line of a long file that took nine tenths of the time.
    let is_plain = !text.contains(['"', '\n', '\r', '\u{feff}']);
    if text.is_empty() {
        return Vec::new();
    }
    if is_plain && separator.is_ascii() {
        let cells = text.split(char::from(separator)).map(str::trim);
        return cells.map(str::to_owned).collect();
    }
    cells_of_csv(text, separator)
}

fn cells_of_csv(text: &str, separator: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut record = csv::StringRecord::new();
    match reader.read_record(&mut record) {
        Ok(true) => record.iter().map(str::to_owned).collect(),
        _ => Vec::new(),
    }
}

/// Cells separated by two blanks or more: `Acc. NS (g)   Acc. EW (g)`.
fn gaps(text: &str) -> Vec<String> {
    text.split(['\t'])
        .flat_map(|part| part.split("  "))
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .map(str::to_owned)
        .collect()
}

/// Words between blanks; a unit in brackets belongs to the word before it.
fn words(text: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut open = false;
    for word in text.split_whitespace() {
        match out.last_mut() {
            Some(last) if open || word.starts_with(['(', '[']) => {
                last.push(' ');
                last.push_str(word);
            }
            _ => out.push(word.to_owned()),
        }
        open = out.last().is_some_and(|last| {
            last.matches(['(', '[']).count() > last.matches([')', ']']).count()
        });
    }
    out
}

/// Refuses a last header line that is really a first row with a typing error ("O.123"): skipping it
/// would silently lose a sample.
fn check_not_a_broken_row(
    dialect: &Dialect,
    header: &[(usize, String)],
    first: &[u8],
) -> Result<(), Problem> {
    let Some((line, text)) = header.last() else {
        return Ok(());
    };
    let own = cells(dialect, text.as_bytes());
    if own.len() != cells(dialect, first).len() {
        return Ok(());
    }
    let (mut values, mut broken) = (0, None);
    for cell in &own {
        match cell {
            Ok(_) => values += 1,
            Err(BadField::Missing(text)) if text.is_empty() => {}
            Err(bad @ BadField::Missing(_)) => {
                values += 1;
                broken.get_or_insert(bad);
            }
            // A lone dash or point marks a missing value; dashes below other words underline them.
            Err(bad @ BadField::NotANumber(text))
                if is_damaged_number(text, own.len() == 1, header.len() == 1) =>
            {
                broken.get_or_insert(bad);
            }
            // Prose with numbers in it ("Station 24278") has words that are not damaged numbers.
            Err(BadField::NotANumber(_)) => return Ok(()),
        }
    }
    match broken {
        // "1st" and "2nd" above two columns are names; a name alone above its column does not begin
        // with a digit.
        Some(bad) if values > 0 || own.len() == 1 => Err(bad_field(bad, *line)
            .hint("correct the number, or begin the line with # if it is a comment")),
        _ => Ok(()),
    }
}

/// Whether a word that is not a number looks like one that was damaged: `0.12O`, `-nan(ind)`,
/// `O.123`.
fn is_damaged_number(word: &str, is_alone: bool, is_first: bool) -> bool {
    let unsigned = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    let has_digit = unsigned.contains(|c: char| c.is_ascii_digit());
    let like_zero = unsigned.starts_with('o')
        && (!is_alone || unsigned.starts_with("o.") || unsigned.starts_with("o,"));
    let starts_as_number =
        word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) || like_zero;
    let placeholder = is_alone && is_first && word.chars().all(|c| "+-.".contains(c));
    has_digit && starts_as_number || unsigned.starts_with("nan(") || placeholder
}

/// Pushes the rows into the columns.
fn read_rows<'a>(table: &mut Table, rows: impl Iterator<Item = Line<'a>>) -> Result<(), Problem> {
    let dialect = table.dialect;
    let plain_blanks = dialect
        == Dialect {
            separator: Separator::Blank,
            decimal_comma: false,
        };
    for line in rows {
        let mut at = 0;
        let first_row = table.columns.is_empty();
        let mut put = |columns: &mut Vec<Column>, number: Number| {
            if first_row {
                columns.push(Column::new());
            }
            if let Some(column) = columns.get_mut(at) {
                column.push(&number, line.number);
            }
            at += 1;
        };
        if plain_blanks {
            fields(line.bytes, |number| put(&mut table.columns, number))
                .map_err(|bad| bad_field(&bad, line.number))?;
        } else {
            let mut separated = cells(&dialect, line.bytes);
            // A separator at the end of every line does not begin a column.
            let spare = separated.len() > 1
                && matches!(separated.last(), Some(Err(BadField::Missing(text))) if text.is_empty());
            if spare && (first_row || separated.len() == table.columns.len() + 1) {
                separated.pop();
            }
            for cell in separated {
                put(
                    &mut table.columns,
                    cell.map_err(|bad| empty_or_bad(&bad, line.number))?,
                );
            }
        }
        if !first_row && at != table.columns.len() {
            return Err(ragged(line.number, at, table.columns.len()));
        }
    }
    check_decimal_comma(table)
}

fn empty_or_bad(bad: &BadField, line: usize) -> Problem {
    match bad {
        BadField::Missing(text) if text.is_empty() => {
            Problem::format("a value is missing", GAP).at_line(line)
        }
        _ => bad_field(bad, line),
    }
}

fn ragged(line: usize, found: usize, expected: usize) -> Problem {
    Problem::format(
format!("the first row has {}, this one has {found}", counted(expected, "value")),
"every row must have the same columns; one series with several values per line needs an AT2 header \
               (NPTS, DT)",
)
        .at_line(line)
}

/// Refuses a whole number above a column of decimals that is larger than all of them: it is a
/// number of values that does not match.
fn check_first_row(table: &Table) -> Result<(), Problem> {
    let [column] = table.columns.as_slice() else {
        return Ok(());
    };
    let Some((&first, others)) = column.values.split_first() else {
        return Ok(());
    };
    // If the same program had printed it as a value, it would have a point.
    let is_count = column.whole == 1
        && column.digit_style.first_is_whole()
        && first >= 2.0
        && others.len() >= 2;
    if !(is_count && others.iter().all(|other| other.abs() < first)) {
        return Ok(());
    }
    let message = format!(
        "the first row, {first}, seems to be the number of values, but {} values follow",
        others.len()
    );
    Err(Problem::format(
        message,
        "the file may be cut off: fetch it again; if the row is a value, write it \
                 with a decimal point",
    )
    .at_line(table.line_of_first_value))
}

/// Numbers with decimal commas read as two columns of whole numbers each: `0,0123`. No program
/// prints a whole number with a leading zero, so a leading zero after the comma reveals them.
fn check_decimal_comma(table: &Table) -> Result<(), Problem> {
    let whole = table
        .columns
        .iter()
        .all(|column| column.last_digit_exponent == 0);
    let padded = table.columns.iter().any(|column| column.zero_padded);
    if table.dialect.separator == Separator::Byte(b',') && whole && padded {
        return Err(Problem::format(
            "the comma may be a decimal sign or a separator",
            "write decimal points, or a ; between the columns",
        )
        .at_line(table.line_of_first_value));
    }
    Ok(())
}

/// Reads old dialects whose first row is `npts dt`, `dt npts` or `npts`. This applies only if the
/// rows below have another width and hold exactly npts values, or are npts rows whose time has that
/// step: then no other reading is possible.
fn read_as_series<'a>(
    table: &mut Table,
    mut rows: impl Iterator<Item = Line<'a>> + Clone,
) -> Result<bool, Problem> {
    let Some(first) = rows.next() else {
        return Ok(false);
    };
    let Some((npts, dt)) = counts(&cells(&table.dialect, first.bytes)) else {
        return Ok(false);
    };
    let Some(second) = rows.clone().next() else {
        return Ok(false);
    };
    let Some(own) = dialect_of(second.bytes) else {
        return Ok(false);
    };
    let width = cells(&own, second.bytes).len();
    match dt {
        Some(dt) if width == 2 => {
            let time = |line: Line<'a>| {
                cells(&own, line.bytes)
                    .first()
                    .and_then(|cell| Some(cell.as_ref().ok()?.value))
            };
            let times: Vec<f64> = rows.clone().take(2).filter_map(time).collect();
            let fits = matches!(times.as_slice(), [t0, t1] if (t1 - t0 - dt).abs() <= 1e-3 * dt);
            if !fits || rows.clone().count() as f64 != npts {
                return Ok(false);
            }
            table.dialect = own;
            read_rows(table, rows)?;
        }
        None if width != 1 => return Ok(false),
        _ => {
            let (mut column, mut markers) = (Column::new(), Markers::default());
            for line in rows {
                for cell in cells(&own, line.bytes) {
                    let number = cell.map_err(|bad| empty_or_bad(&bad, line.number))?;
                    markers.see(number.value, line.number)?;
                    column.push(&number, line.number);
                }
            }
            // A number alone is taken as a count only above values with decimals.
            if column.values.len() as f64 != npts || dt.is_none() && column.last_digit_exponent >= 0
            {
                return Ok(false);
            }
            // The reader of the columns reports values that are not numbers.
            markers.judge(&column.values)?;
            table.columns = vec![column];
            table.series_dt_s = dt;
        }
    }
    table.has_row_of_counts = true;
    table.line_of_first_value = second.number;
    Ok(true)
}

/// The number of values that a row states, and the step if it states one.
fn counts(row: &[Result<Number, BadField>]) -> Option<(f64, Option<f64>)> {
    let is_count = |number: &Number| number.last_digit_exponent == 0 && number.value >= 2.0;
    match row {
        [Ok(npts)] => is_count(npts).then_some((npts.value, None)),
        [Ok(a), Ok(b)] => {
            let (npts, dt) = if is_count(a) { (a, b) } else { (b, a) };
            let is_step = dt.value > 0.0 && dt.value.is_finite();
            (is_count(npts) && is_step).then_some((npts.value, Some(dt.value)))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{cells_of_csv, quoted_cells};

    #[test]
    fn a_line_is_cut_as_csv_is() {
        for text in [
            "",
            " ",
            ",",
            "a",
            " a , b;c\t,",
            "a,,b, ",
            "\u{a0}é,\"\"",
            "\"a,b\", \"c\"\"d\",e",
            "a,b\rc",
            "\u{feff}a,b",
            "\0,'x'",
        ] {
            for separator in [b',', b';', b'\t'] {
                let expected = cells_of_csv(text, separator);
                assert_eq!(quoted_cells(text, separator), expected, "{text:?}");
            }
        }
        assert_eq!(quoted_cells(" a ,\"b,c\"", b','), ["a", "b,c"]);
    }
}
