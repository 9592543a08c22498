//! The lines of a text file, whichever system wrote it.

use freestand_input::problem::Problem;

const UNPACK: &str = "unpack it first";
const CONVERT: &str =
    "convert the record to miniSEED, AT2, or CSV with time and acceleration columns";
const NAME_RECORD: &str = "name the record file; name a StationXML file with `station_xml`";

/// Other files that people try to read: position of the signature, signature, kind of file, remedy.
const OTHERS: &[(usize, &[u8], &str, &str)] = &[
    (0, b"\x1F\x8B", "a gzip file", UNPACK),
    (
        0,
        b"PK\x03\x04",
        "a zip file (or an office document, which is one)",
        "unpack it first; save a worksheet as CSV",
    ),
    (0, b"BZh", "a bzip2 file", UNPACK),
    (0, b"\xFD7zXZ\x00", "an xz file", UNPACK),
    (0, b"7z\xBC\xAF", "a 7-zip file", UNPACK),
    (257, b"ustar", "a tar file", UNPACK),
    (
        0,
        b"\xD0\xCF\x11\xE0",
        "an old Excel or Word file",
        "save the worksheet as CSV",
    ),
    (
        0,
        b"\x89HDF\r\n\x1A\n",
        "an HDF5 file (ASDF, MATLAB 7.3)",
        CONVERT,
    ),
    (0, b"MATLAB 5.0", "a MATLAB file", CONVERT),
    (0, b"\x93NUMPY", "a NumPy file", CONVERT),
    (0, b"K\x01\x01", "a Kinemetrics EVT file", CONVERT),
    (0, b"WID2 ", "a GSE2 file", CONVERT),
    (0, b"BEGIN GSE2", "a GSE2 file", CONVERT),
    (0, b"XW01", "a GSE1 file", CONVERT),
    (0, b"WID1 ", "a GSE1 file", CONVERT),
    (
        0,
        b"\x89PNG",
        "a picture (PNG)",
        "name the record file itself",
    ),
    (
        0,
        b"\xFF\xD8\xFF",
        "a picture (JPEG)",
        "name the record file itself",
    ),
    (0, b"%PDF", "a PDF document", "name the record file itself"),
    (0, b"<?xml", "an XML document", NAME_RECORD),
    (0, b"<FDSNStationXML", "a StationXML", NAME_RECORD),
];

/// Refuses what is not text, and removes a byte-order mark and the end-of-file character of DOS.
pub(crate) fn check_text(bytes: &mut Vec<u8>) -> Result<(), Problem> {
    if let Some(text) = from_utf16(bytes)? {
        *bytes = text.into_bytes();
    }
    if bytes.starts_with(&[0xEF, 0xBB, 0xBF]) {
        bytes.drain(..3);
    }
    // Line ends and padding may alternate.
    while let [.., 0x1A] = bytes.trim_ascii_end() {
        bytes.truncate(bytes.trim_ascii_end().len() - 1);
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Problem::format(
            "the file is empty",
            "check that the record was saved",
        ));
    }
    if let Some((_, _, kind, remedy)) = OTHERS
        .iter()
        .find(|(at, start, ..)| bytes.get(*at..).is_some_and(|rest| rest.starts_with(start)))
    {
        return Err(Problem::format(format!("is {kind}"), *remedy));
    }
    if bytes.contains(&0) {
        return Err(Problem::format(
            "is a binary file of an unknown format",
            "convert the record to AT2, or to CSV with time and acceleration columns",
        ));
    }
    Ok(())
}

/// The text of a file that begins with the byte-order mark of UTF-16, as Windows programs save "Unicode text".
///
/// # Errors
/// Half of a character.
fn from_utf16(bytes: &[u8]) -> Result<Option<String>, Problem> {
    let unit: fn([u8; 2]) -> u16 = match bytes {
        [0xFF, 0xFE, ..] => u16::from_le_bytes,
        [0xFE, 0xFF, ..] => u16::from_be_bytes,
        _ => return Ok(None),
    };
    let (pairs, rest) = bytes[2..].as_chunks::<2>();
    let text: Result<String, _> =
        char::decode_utf16(pairs.iter().map(|pair| unit(*pair))).collect();
    match text {
        Ok(text) if rest.is_empty() => Ok(Some(text)),
        _ => Err(Problem::format(
            "is damaged UTF-16 text",
            "save it as UTF-8 or plain text",
        )),
    }
}

/// A line with its number, counted from 1.
#[derive(Clone, Copy)]
pub(crate) struct Line<'a> {
    pub(crate) number: usize,
    pub(crate) bytes: &'a [u8],
}

/// The lines of a text: ended by LF, CR LF, CR, or the CR CR LF that a file gets when it is
/// "converted" twice.
#[derive(Clone)]
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

pub(crate) fn lines(bytes: &[u8]) -> Lines<'_> {
    Lines {
        rest: bytes,
        number: 0,
    }
}

impl<'a> Lines<'a> {
    /// The next line that is not blank, which stays unread.
    pub(crate) fn ahead(&self) -> Option<Line<'a>> {
        self.clone().find(|line| !line.is_blank())
    }

    /// The next line if `holds`; another one stays unread.
    pub(crate) fn next_if(&mut self, holds: impl FnOnce(&Line<'a>) -> bool) -> Option<Line<'a>> {
        let mut ahead = self.clone();
        let line = ahead.next().filter(holds)?;
        *self = ahead;
        Some(line)
    }

    /// The next lines, as long as `holds`; the first other one stays unread.
    pub(crate) fn leading(
        &mut self,
        mut holds: impl FnMut(&Line<'a>) -> bool,
    ) -> impl Iterator<Item = Line<'a>> {
        std::iter::from_fn(move || self.next_if(&mut holds))
    }

    /// The next lines without those that are blank.
    pub(crate) fn filled(&mut self) -> impl Iterator<Item = Line<'a>> {
        self.filter(|line| !line.is_blank())
    }

    /// Bytes that are not read yet.
    pub(crate) fn bytes_left(&self) -> usize {
        self.rest.len()
    }

    /// Number of the line that was read last, counted from 1; 0 before the first.
    pub(crate) fn line_number(&self) -> usize {
        self.number
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let end = memchr::memchr2(b'\n', b'\r', self.rest).unwrap_or(self.rest.len());
        let (bytes, tail) = self.rest.split_at(end);
        let ending = match tail {
            [b'\r', b'\r', b'\n', ..] => 3,
            [b'\r', b'\n', ..] => 2,
            [] => 0,
            _ => 1,
        };
        self.rest = &tail[ending..];
        self.number += 1;
        Some(Line {
            number: self.number,
            bytes,
        })
    }
}

impl Line<'_> {
    pub(crate) fn is_blank(&self) -> bool {
        self.bytes.trim_ascii().is_empty()
    }

    pub(crate) fn is_comment(&self) -> bool {
        self.bytes.trim_ascii_start().starts_with(b"#")
    }

    /// Whether it holds words. The letters of an exponent are not words.
    pub(crate) fn is_text(&self) -> bool {
        let bytes = self.bytes.trim_ascii();
        let is_word = |b: &u8| {
            b.is_ascii_alphabetic() && !matches!(b, b'e' | b'E' | b'd' | b'D')
                || matches!(b, b'/' | b'&')
        };
        bytes.iter().any(is_word) || bytes.starts_with(b"--")
    }

    /// As text: UTF-8, or else Latin-1, in which every byte is a character.
    pub(crate) fn text(&self) -> String {
        // Only headers are read as text; a "line" of megabytes is not a header.
        text_of(&self.bytes[..self.bytes.len().min(4096)])
    }
}

/// The parts that are not empty; `None` if all are.
pub(crate) fn joined(parts: &[&str], between: &str) -> Option<String> {
    let filled: Vec<&str> = parts
        .iter()
        .copied()
        .filter(|part| !part.is_empty())
        .collect();
    (!filled.is_empty()).then(|| filled.join(between))
}

pub(crate) fn text_of(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_ending_ends_one_line() {
        for ending in ["\n", "\r\n", "\r", "\r\r\n"] {
            let text = ["a", "", "b c", "d"].join(ending);
            let found: Vec<_> = lines(text.as_bytes())
                .map(|line| (line.number, line.text()))
                .collect();
            let expected =
                [(1, "a"), (2, ""), (3, "b c"), (4, "d")].map(|(n, s)| (n, s.to_owned()));
            assert_eq!(found, expected, "{ending:?}");
        }
    }

    #[test]
    fn utf16_is_text() {
        for unit in [u16::to_le_bytes, u16::to_be_bytes] {
            let mut bytes: Vec<u8> = "\u{feff}Kraft [N]\r\n1\r\n"
                .encode_utf16()
                .flat_map(unit)
                .collect();
            check_text(&mut bytes).unwrap();
            assert_eq!(bytes, b"Kraft [N]\r\n1\r\n");
        }
    }

    #[test]
    fn what_is_not_text_is_refused() {
        for (bytes, message) in [
            (&b""[..], "empty"),
            (b" \r\n\t\n", "empty"),
            (b"\xEF\xBB\xBF\n\x1A", "empty"),
            (b"\xFF\xFE0\x00\x00", "UTF-16"),
            (b"12 \x00 3", "binary"),
            (b"\x1F\x8B\x08", "a gzip file"),
            (b"PK\x03\x04\x14", "a zip file"),
            (b"\x89HDF\r\n\x1A\n\0", "an HDF5 file"),
            (b"WID2 2009/05/18 06:47:20.255", "a GSE2 file"),
            (b"\xEF\xBB\xBF<?xml version=", "an XML document"),
        ] {
            assert!(
                check_text(&mut bytes.to_vec())
                    .unwrap_err()
                    .message
                    .contains(message),
                "{bytes:?}"
            );
        }
        let mut bytes = b"\xEF\xBB\xBF1\n\x1A".to_vec();
        check_text(&mut bytes).unwrap();
        assert_eq!(bytes, b"1\n");
        let mut bytes = b"1\r\n\x1A\x1A\r\n\x1A\r\n".to_vec();
        check_text(&mut bytes).unwrap();
        assert_eq!(bytes, b"1\r\n");
    }
}
