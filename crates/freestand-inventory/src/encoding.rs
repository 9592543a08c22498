//! The text of a CSV, whichever encoding it was saved in.

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE, WINDOWS_1252};

use freestand_input::problem::Problem;

use super::problems::bad_file;

/// Bytes of a file that are examined to detect UTF-16 without a byte-order mark.
const EXAMINED_BYTES: usize = 4096;

const SAVE_AGAIN: &str = "save the sheet as CSV (UTF-8) or as .xlsx";

/// The text of a file, and a warning about its encoding.
///
/// # Errors
/// A file that is empty or is not text.
pub(super) fn decode(mut bytes: Vec<u8>) -> Result<(String, Option<String>), Problem> {
    if let Some(what) = other_kind(&bytes) {
        return Err(bad_file(format!("is {what}, not an inventory"), SAVE_AGAIN));
    }
    let (encoding, mark) =
        Encoding::for_bom(&bytes).map_or((None, 0), |(encoding, mark)| (Some(encoding), mark));
    if let Some(encoding) = encoding
        .filter(|found| [UTF_16LE, UTF_16BE].contains(found))
        .or_else(|| utf16(&bytes))
    {
        let text = encoding.decode_without_bom_handling_and_without_replacement(
            bytes.get(mark..).unwrap_or_default(),
        );
        let text = text.filter(|text| !text.chars().any(is_unprintable));
        let text = text.ok_or_else(|| bad_file("is damaged UTF-16 text", SAVE_AGAIN))?;
        return not_empty(text.into_owned()).map(|text| (text, None));
    }
    bytes.drain(..mark);
    // The end-of-file character of DOS.
    while bytes.last() == Some(&0x1A) {
        bytes.pop();
    }
    if let Some(at) = bytes
        .iter()
        .position(|&byte| is_unprintable(char::from(byte)))
    {
        let line = 1 + bytes.iter().take(at).filter(|&&byte| byte == b'\n').count();
        let what = if bytes.get(at) == Some(&0) {
            "a NUL byte"
        } else {
            "a control character"
        };
        let message = format!("is not text: it contains {what}");
        return Err(bad_file(message, SAVE_AGAIN).at_line(line));
    }
    match String::from_utf8(bytes) {
        Ok(text) => not_empty(text).map(|text| (text, None)),
        Err(error) => {
            let warning = "the file is not UTF-8 and is read as Windows-1252 (Latin-1): check letters with accents";
            let (text, _) = WINDOWS_1252.decode_without_bom_handling(error.as_bytes());
            // Five bytes mean nothing in Windows-1252; the decoder makes control characters of
            // them.
            let text = text.replace(|c| ('\u{80}'..='\u{9f}').contains(&c), "\u{fffd}");
            not_empty(text).map(|text| (text, Some(warning.to_owned())))
        }
    }
}

fn not_empty(text: String) -> Result<String, Problem> {
    if text.trim().is_empty() {
        let hint = "freestand inventory template writes one to fill in";
        return Err(bad_file("the file is empty", hint));
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
    kinds
        .into_iter()
        .find(|(start, _)| bytes.starts_with(start))
        .map(|(_, what)| what)
}

/// Whether the file is UTF-16 without a byte-order mark, and which.
fn utf16(bytes: &[u8]) -> Option<&'static Encoding> {
    let head = bytes.get(..bytes.len().min(EXAMINED_BYTES) & !1)?;
    let zeros = |odd: usize| {
        head.iter()
            .skip(odd)
            .step_by(2)
            .filter(|&&byte| byte == 0)
            .count()
    };
    let (high, low) = (zeros(0), zeros(1));
    // Headings are mostly ASCII: every second byte is zero, and no other.
    let pairs = head.len() / 2;
    let mostly = |count: usize| pairs > 4 && 4 * count > 3 * pairs;
    match (mostly(high), mostly(low)) {
        (true, false) if low == 0 => Some(UTF_16BE),
        (false, true) if high == 0 => Some(UTF_16LE),
        _ => None,
    }
}

/// Whether this is a control character that no text contains; tabs and line endings are allowed.
pub(super) fn is_unprintable(c: char) -> bool {
    c < ' ' && !matches!(c, '\t' | '\n' | '\r')
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
        for bytes in [
            [b"\xFF\xFE", &little[..]].concat(),
            [b"\xFE\xFF", &big[..]].concat(),
            marked,
            plain,
        ] {
            assert_eq!(decode(bytes).unwrap(), (text.to_owned(), None));
        }
        // Without a mark UTF-16 is detected by its zeros; the dash and the euro sign have none.
        let ascii = "item;height [mm]\ncabinet;1800\n";
        let bare: Vec<u8> = ascii.encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(decode(bare).unwrap().0, ascii);
        let (read, warning) = decode(windows).unwrap();
        assert_eq!(read, text);
        assert!(warning.is_some_and(|warning| warning.contains("Windows-1252")));
        assert_eq!(decode(b"a\x81\xFF".to_vec()).unwrap().0, "a\u{fffd}\u{ff}");
    }

    #[test]
    fn what_is_not_text_is_refused() {
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
            assert!(
                problem.message.contains(said) && problem.hint.is_some(),
                "{problem}"
            );
        }
        assert_eq!(
            decode(b"a,b\n1,\x002\n".to_vec()).unwrap_err().line,
            Some(2)
        );
    }
}
