//! The text of a CSV, whichever encoding it was saved in.

use freestand_input::problem::{Problem, ProblemKind};

/// What Windows-1252 has where Latin-1 has control characters; 0 where it has nothing.
const WINDOWS_1252: [u16; 32] = [
    0x20AC, 0, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0, 0x017D, 0, 0,
    0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0, 0x017E, 0x0178,
];

/// How much of a file is looked at to tell UTF-16 without a byte-order mark.
const LOOKED_AT: usize = 4096;

/// The text of a file, and what has to be said of its encoding.
///
/// # Errors
/// A file that is empty or no text.
pub(super) fn decode(mut bytes: Vec<u8>) -> Result<(String, Option<String>), Problem> {
    if let Some(what) = other_kind(&bytes) {
        return Err(
            format_problem(format!("is {what}, no inventory")).hint("save the sheet as CSV (UTF-8) or as .xlsx")
        );
    }
    if let Some((is_big, mark)) = utf16(&bytes) {
        let text = from_utf16(bytes.get(mark..).unwrap_or_default(), is_big)?;
        return not_empty(text).map(|text| (text, None));
    }
    if bytes.starts_with(&[0xEF, 0xBB, 0xBF]) {
        bytes.drain(..3);
    }
    // The end-of-file character of DOS.
    while bytes.last() == Some(&0x1A) {
        bytes.pop();
    }
    if let Some(at) = bytes.iter().position(|&byte| byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r')) {
        let line = 1 + bytes.iter().take(at).filter(|&&byte| byte == b'\n').count();
        let what = if bytes.get(at) == Some(&0) { "a NUL byte" } else { "a control character" };
        return Err(format_problem(format!("is no text: {what} stands in it"))
            .at_line(line)
            .hint("save the sheet as CSV (UTF-8) or as .xlsx"));
    }
    match String::from_utf8(bytes) {
        Ok(text) => not_empty(text).map(|text| (text, None)),
        Err(error) => {
            let warning = "the file is not UTF-8: it is read as Windows-1252 (Latin-1); check letters with accents";
            not_empty(from_windows_1252(error.as_bytes())).map(|text| (text, Some(warning.to_owned())))
        }
    }
}

fn format_problem(message: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Format, message)
}

fn not_empty(text: String) -> Result<String, Problem> {
    if text.trim().is_empty() {
        return Err(format_problem("the file is empty").hint("freestand inventory template writes one to fill in"));
    }
    Ok(text)
}

fn other_kind(bytes: &[u8]) -> Option<&'static str> {
    let kinds: [(&[u8], &str); 8] = [
        (b"\x1F\x8B", "a gzip file"),
        (b"\x89PNG", "a picture (PNG)"),
        (b"\xFF\xD8\xFF", "a picture (JPEG)"),
        (b"%PDF", "a PDF document"),
        (b"<?xml", "an XML document"),
        (b"<html", "a web page"),
        (b"<!DOCTYPE", "a web page"),
        (b"{\\rtf", "a text document (RTF)"),
    ];
    kinds.into_iter().find(|(start, _)| bytes.starts_with(start)).map(|(_, what)| what)
}

/// Whether the file is UTF-16: big end first, and the length of its mark.
fn utf16(bytes: &[u8]) -> Option<(bool, usize)> {
    match bytes {
        [0xFF, 0xFE, ..] => return Some((false, 2)),
        [0xFE, 0xFF, ..] => return Some((true, 2)),
        _ => {}
    }
    let head = bytes.get(..bytes.len().min(LOOKED_AT) & !1)?;
    let zeros = |odd: usize| head.iter().skip(odd).step_by(2).filter(|&&byte| byte == 0).count();
    let (high, low) = (zeros(0), zeros(1));
    // Headings are ASCII for the most part: every second byte is zero, and no other.
    let pairs = head.len() / 2;
    let mostly = |count: usize| pairs > 4 && 4 * count > 3 * pairs;
    match (mostly(high), mostly(low)) {
        (true, false) if low == 0 => Some((true, 0)),
        (false, true) if high == 0 => Some((false, 0)),
        _ => None,
    }
}

/// Control characters that no text has; blanks and line ends are none.
pub(super) fn is_unprintable(c: char) -> bool {
    c < ' ' && !matches!(c, '\t' | '\n' | '\r')
}

fn from_utf16(bytes: &[u8], is_big: bool) -> Result<String, Problem> {
    let unit = |pair: &[u8]| match *pair {
        [a, b] if is_big => u16::from_be_bytes([a, b]),
        [a, b] => u16::from_le_bytes([a, b]),
        _ => 0xD800,
    };
    let broken = || format_problem("is damaged UTF-16 text").hint("save the sheet as CSV (UTF-8) or as .xlsx");
    let text = char::decode_utf16(bytes.chunks(2).map(unit)).collect::<Result<String, _>>().map_err(|_| broken())?;
    if text.chars().any(is_unprintable) { Err(broken()) } else { Ok(text) }
}

fn from_windows_1252(bytes: &[u8]) -> String {
    bytes
        .iter()
        .map(|&byte| match byte {
            0x80..=0x9F => {
                let code = WINDOWS_1252.get(usize::from(byte - 0x80)).copied().unwrap_or(0);
                char::from_u32(u32::from(code)).filter(|&c| c != '\0').unwrap_or(char::REPLACEMENT_CHARACTER)
            }
            _ => char::from(byte),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_text_in_many_encodings() {
        let text = "item;height [mm]\nSchränke – 5 €;1800\n";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let windows = b"item;height [mm]\nSchr\xE4nke \x96 5 \x80;1800\n".to_vec();
        let marked = [b"\xEF\xBB\xBF", text.as_bytes()].concat();
        let plain = [text.as_bytes(), b"\x1A"].concat();
        for bytes in [[b"\xFF\xFE", &little[..]].concat(), [b"\xFE\xFF", &big[..]].concat(), marked, plain] {
            assert_eq!(decode(bytes).unwrap(), (text.to_owned(), None));
        }
        // Without a mark it is told by its zeros; the dash and the sign of the euro have none.
        let ascii = "item;height [mm]\ncabinet;1800\n";
        let bare: Vec<u8> = ascii.encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(decode(bare).unwrap().0, ascii);
        let (read, warning) = decode(windows).unwrap();
        assert_eq!(read, text);
        assert!(warning.is_some_and(|warning| warning.contains("Windows-1252")));
    }

    #[test]
    fn what_is_no_text_is_refused() {
        for (bytes, said) in [
            (&b""[..], "empty"),
            (b"\xEF\xBB\xBF \r\n", "empty"),
            (b"a,b\n1,\x002\n", "NUL"),
            (b"a,b\n1,\x022\n", "control character"),
            (b"\x1F\x8B\x08", "gzip"),
            (b"%PDF-1.7", "PDF"),
            (b"\xFF\xFEa", "UTF-16"),
            (b"\xFF\xFE\x00\xD8", "UTF-16"),
        ] {
            let problem = decode(bytes.to_vec()).unwrap_err();
            assert!(problem.message.contains(said) && problem.hint.is_some(), "{problem}");
        }
        assert_eq!(decode(b"a,b\n1,\x002\n".to_vec()).unwrap_err().line, Some(2));
    }
}
