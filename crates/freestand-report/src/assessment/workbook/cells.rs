//! Formats, and cells written with a definite type.

use rust_xlsxwriter::{
    ColNum, Format, FormatAlign, FormatBorder, Formula, RowNum, Worksheet, XlsxError,
};

use crate::assessment::csv::OVERTURNED;
use crate::assessment::table::Cell;

/// Longest text of a cell in UTF-16 units; Excel takes 32,767.
const MAX_TEXT_UNITS: usize = 32_000;

/// The end of a text that was truncated.
const CUT: &str = " … (truncated; the whole text is in objects.csv)";

/// The formats of the workbook.
pub(super) struct Styles {
    pub(super) title: Format,
    pub(super) heading: Format,
    pub(super) header: Format,
    pub(super) header_of_numbers: Format,
    pub(super) wrapped: Format,
    pub(super) text: Format,
    pub(super) number: Format,
    pub(super) count: Format,
    pub(super) percent: Format,
    pub(super) input: Format,
    pub(super) formula: Format,
    pub(super) value: Format,
    pub(super) difference: Format,
    pub(super) warning: Format,
}

impl Styles {
    pub(super) fn new() -> Self {
        let top = Format::new().set_align(FormatAlign::Top);
        let header = top
            .clone()
            .set_bold()
            .set_text_wrap()
            .set_border_bottom(FormatBorder::Medium);
        let number = top.clone().set_num_format("0.0###");
        Self {
            title: Format::new().set_bold().set_font_size(16),
            heading: Format::new()
                .set_bold()
                .set_font_size(12)
                .set_border_bottom(FormatBorder::Thin),
            header_of_numbers: header
                .clone()
                .set_background_color(0x00E8_EDF2)
                .set_align(FormatAlign::Right),
            header: header.set_background_color(0x00E8_EDF2),
            wrapped: top.clone().set_text_wrap(),
            text: top.clone(),
            count: top.clone().set_num_format("#,##0"),
            percent: top.clone().set_num_format("0.0%"),
            input: number.clone().set_font_color(0x0000_0099),
            formula: number.clone().set_background_color(0x00EE_F5EA),
            value: number.clone(),
            difference: top.clone().set_num_format("0.0E+00"),
            warning: top
                .set_bold()
                .set_border(FormatBorder::Medium)
                .set_background_color(0x00FF_F2CC),
            number,
        }
    }
}

/// A text, truncated where Excel would refuse it.
pub(super) fn put_text(
    sheet: &mut Worksheet,
    (row, column): (RowNum, ColNum),
    text: &str,
    format: &Format,
) -> Result<(), XlsxError> {
    sheet.write_string_with_format(row, column, fitting(text), format)?;
    Ok(())
}

/// A finite number; otherwise the cell stays empty.
pub(super) fn put_number(
    sheet: &mut Worksheet,
    (row, column): (RowNum, ColNum),
    value: Option<f64>,
    format: &Format,
) -> Result<(), XlsxError> {
    if let Some(value) = value.filter(|value| value.is_finite()) {
        sheet.write_number_with_format(row, column, value, format)?;
    }
    Ok(())
}

/// A formula with its result, for programs that do not calculate; without a finite result the cell
/// stays empty.
pub(super) fn put_formula(
    sheet: &mut Worksheet,
    (row, column): (RowNum, ColNum),
    formula: &str,
    value: Option<f64>,
    format: &Format,
) -> Result<(), XlsxError> {
    if let Some(value) = value.filter(|value| value.is_finite()) {
        let formula = Formula::new(formula).set_result(value.to_string());
        sheet.write_formula_with_format(row, column, formula, format)?;
    }
    Ok(())
}

/// A cell of the table.
pub(super) fn put(
    sheet: &mut Worksheet,
    place: (RowNum, ColNum),
    cell: &Cell,
    styles: &Styles,
    is_share: bool,
) -> Result<(), XlsxError> {
    match cell {
        Cell::Text(text) => put_text(sheet, place, text, &styles.text),
        Cell::Number(value) => {
            let format = if is_share {
                &styles.percent
            } else {
                &styles.number
            };
            put_number(sheet, place, Some(*value), format)
        }
        // A count beyond 2^53 loses its last digits, as every number of a spreadsheet does.
        Cell::Count(value) => put_number(sheet, place, Some(*value as f64), &styles.count),
        Cell::Overturned => put_text(sheet, place, OVERTURNED, &styles.text),
        Cell::Flag(value) => put_text(
            sheet,
            place,
            if *value { "yes" } else { "no" },
            &styles.text,
        ),
        Cell::Missing => Ok(()),
    }
}

/// The text, or as much of it as fits with [`CUT`].
pub(super) fn fitting(text: &str) -> String {
    // XML cannot hold U+FFFE and U+FFFF; the library escapes control characters.
    let text = text.replace(['\u{fffe}', '\u{ffff}'], "");
    if text.len() <= MAX_TEXT_UNITS {
        return text;
    }
    let mut units = 0;
    let end = text.char_indices().find(|(_, c)| {
        units += c.len_utf16();
        units > MAX_TEXT_UNITS
    });
    end.map_or_else(|| text.clone(), |(end, _)| format!("{}{CUT}", &text[..end]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_truncated_at_a_character() {
        assert_eq!(fitting("=A1\u{fffe}"), "=A1");
        let long = fitting(&"🪨".repeat(20_000));
        assert!(long.ends_with(CUT) && long.encode_utf16().count() < 32_767);
        assert_eq!(
            long.encode_utf16().count(),
            MAX_TEXT_UNITS + CUT.encode_utf16().count()
        );
        // 20,000 characters of three bytes each are 20,000 units.
        assert_eq!(fitting(&"–".repeat(20_000)).len(), 60_000);
    }
}
