//! Checks before a workbook is opened: what kind of zip file it is, and how much it really unpacks
//! to.
//!
//! The library that reads workbooks trusts the sizes and counts that the file declares. Here
//! everything is unpacked once, counted and discarded, and the few declarations that determine
//! memory are compared with the actual content.

use std::io::{Cursor, Read};

use memchr::{memchr, memmem};
use zip::ZipArchive;

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::problems::bad_file;

/// Largest size of all unpacked members together \[bytes\]: about five million cells. A server
/// reads several workbooks at a time.
const MAX_UNPACKED: u64 = 512 << 20;
/// Largest size of a member that does not grow with the rows: styles, relations, the list of sheets
/// \[bytes\].
const MAX_SMALL: u64 = 16 << 20;
/// Parts of the names of members that grow with the rows.
const LARGE: [&str; 8] = [
    "worksheets/",
    "sharedStrings",
    "pivotCache",
    "calcChain",
    "drawings",
    "comments",
    "tables/",
    "revisions",
];
/// Largest ratio of unpacked to packed size; real workbooks stay below 50, the format allows 1032.
const MAX_RATIO: u64 = 200;
/// Unpacked size up to which any ratio is harmless \[bytes\].
const RATIO_FROM: u64 = 64 << 20;
/// Largest number of members; workbooks have some dozens, with pictures some hundreds.
const MAX_MEMBERS: usize = 4096;
/// Longest tag \[bytes\].
const MAX_TAG: usize = 1 << 20;
/// Shortest entry of the table of texts, `<si><t/></si>` \[bytes\].
const MIN_TEXT_BYTES: u64 = 13;

const SAVE_AGAIN: &str = "open it in a spreadsheet program and save it again as .xlsx, or as CSV";

/// The results of the checks of a workbook.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Facts {
    /// Whether any sheet has merged cells.
    pub has_merges: bool,
    /// The names of the sheets, each with the id of its member.
    sheets: Vec<(String, String)>,
    /// Members by their ids.
    members: Vec<(String, String)>,
    /// Members with rows or columns that a spreadsheet does not show.
    hidden: Vec<(String, Hidden)>,
}

/// What a spreadsheet does not show: hidden, left out by a filter, or without a height or width.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Hidden {
    /// Counted from 1.
    pub rows: Vec<u32>,
    /// First and last, counted from 0.
    pub columns: Vec<(u32, u32)>,
}

impl Facts {
    /// What of a sheet is not shown.
    pub(super) fn hidden(&self, sheet: &str) -> Option<&Hidden> {
        let (_, id) = self.sheets.iter().find(|(name, _)| name == sheet)?;
        let (_, target) = self.members.iter().find(|(other, _)| other == id)?;
        let end = target.rsplit('/').next()?;
        let is_member =
            |name: &str| name.rsplit('/').next() == Some(end) && name.contains("worksheets/");
        self.hidden
            .iter()
            .find(|(name, _)| is_member(name))
            .map(|(_, hidden)| hidden)
    }
}

/// Unpacks everything once.
///
/// # Errors
/// A zip file that is not a workbook, is damaged or encrypted, or unpacks to more than any
/// inventory needs.
pub(super) fn check(bytes: &[u8]) -> Result<Facts, Problem> {
    let damaged = |error: &dyn std::fmt::Display| {
        bad_file(
            format!("is a damaged workbook or zip file ({error})"),
            SAVE_AGAIN,
        )
    };
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
    if archive.len() > MAX_MEMBERS {
        let message = format!(
            "is a zip file of {} members; a workbook has at most {MAX_MEMBERS}",
            archive.len()
        );
        return Err(bad_file(message, SAVE_AGAIN));
    }
    let names: Vec<String> = archive
        .file_names_raw()
        .map(|name| String::from_utf8_lossy(name).into_owned())
        .collect();
    is_workbook(&names, bytes)?;
    let mut facts = Facts::default();
    let mut total = 0;
    let mut buffer = vec![0; 1 << 16];
    for index in 0..archive.len() {
        let name = names.get(index).map_or("", String::as_str);
        // Opening an encrypted member fails too, but with a message of its own.
        if archive
            .by_index_raw(index)
            .is_ok_and(|member| member.encrypted())
        {
            return Err(bad_file(
                "is encrypted",
                "remove the password and save it again",
            ));
        }
        let mut member = archive.by_index(index).map_err(|error| damaged(&error))?;
        let is_small = is_xml(name) && !LARGE.iter().any(|part| name.contains(part));
        let mut tags = is_xml(name).then(Tags::default);
        let mut size = 0;
        loop {
            let count = member.read(&mut buffer).map_err(|error| damaged(&error))?;
            let Some(chunk) = buffer.get(..count).filter(|chunk| !chunk.is_empty()) else {
                break;
            };
            size += count as u64;
            total += count as u64;
            let is_bomb = total > RATIO_FROM && total / MAX_RATIO > bytes.len() as u64;
            if total > MAX_UNPACKED || is_bomb || is_small && size > MAX_SMALL {
                let message = format!(
                    "unpacks to more than {} MiB, which is too large for an inventory",
                    total >> 20
                );
                return Err(bad_file(
                    message,
                    "copy the rows into a new workbook, or save them as CSV",
                ));
            }
            if let Some(tags) = &mut tags {
                tags.feed(chunk)
                    .map_err(|what| bad_file(format!("{} {what}", shorten(name)), SAVE_AGAIN))?;
            }
        }
        if let Some(tags) = tags {
            if tags.texts_declared > size / MIN_TEXT_BYTES {
                let message = format!(
                    "{} declares {} texts, more than it can hold",
                    shorten(name),
                    tags.texts_declared
                );
                return Err(bad_file(message, SAVE_AGAIN));
            }
            facts.has_merges |= tags.has_merges;
            facts.sheets.extend(tags.sheets);
            if name.ends_with("workbook.xml.rels") {
                facts.members.extend(tags.members);
            }
            if tags.hidden != Hidden::default() {
                facts.hidden.push((name.to_owned(), tags.hidden));
            }
        }
    }
    Ok(facts)
}

fn is_xml(name: &str) -> bool {
    !name.contains("/media/")
        && [".xml", ".rels"]
            .iter()
            .any(|end| name.to_ascii_lowercase().ends_with(end))
}

/// Distinguishes a workbook from other zip files.
fn is_workbook(names: &[String], bytes: &[u8]) -> Result<(), Problem> {
    let has = |name: &str| names.iter().any(|other| other.eq_ignore_ascii_case(name));
    let starts = |folder: &str| names.iter().any(|name| name.starts_with(folder));
    // The first member of an OpenDocument file is its type, not compressed.
    let is_open_document = memmem::find(
        bytes.get(..200).unwrap_or(bytes),
        b"application/vnd.oasis.opendocument",
    )
    .is_some();
    let is_table = |name: &&String| {
        let name = name.to_ascii_lowercase();
        [".xlsx", ".csv", ".xlsm", ".xls", ".ods"]
            .iter()
            .any(|end| name.ends_with(end))
    };
    let refused = if is_open_document {
        (
            "is an OpenDocument file (ODS)",
            "save the sheet as .xlsx or CSV",
        )
    } else if has("xl/workbook.bin") {
        ("is a binary workbook (XLSB)", "save it as .xlsx or CSV")
    } else if let Some(inner) = names.iter().find(is_table) {
        let message = format!("is a zip file that contains {}", shorten(inner));
        return Err(bad_file(message, "unpack it first"));
    } else if starts("word/") || starts("ppt/") {
        (
            "is a text document or a presentation, not a workbook",
            "save the table as .xlsx or CSV",
        )
    } else if !has("[Content_Types].xml") || !has("_rels/.rels") {
        (
            "is a zip file, but not a workbook",
            "unpack it first, and give the .xlsx or CSV file in it",
        )
    } else {
        return Ok(());
    };
    Err(bad_file(refused.0, refused.1))
}

/// Examines the tags of a member chunk by chunk.
#[derive(Debug, Default)]
struct Tags {
    /// Bytes not examined yet: the beginning of a tag.
    rest: Vec<u8>,
    /// The text that ends the part being skipped.
    until: Option<&'static [u8]>,
    /// Whether there were any bytes.
    begun: bool,
    texts_declared: u64,
    has_merges: bool,
    sheets: Vec<(String, String)>,
    members: Vec<(String, String)>,
    /// The last row: one without a number is the next.
    row: u32,
    hidden: Hidden,
}

/// Parts that are skipped: their beginnings and their ends.
const SKIPPED: [(&[u8], &[u8]); 3] = [(b"<!--", b"-->"), (b"<![CDATA[", b"]]>"), (b"<?", b"?>")];

impl Tags {
    fn feed(&mut self, chunk: &[u8]) -> Result<(), String> {
        if !self.begun && (chunk.starts_with(&[0xFF, 0xFE]) || chunk.starts_with(&[0xFE, 0xFF])) {
            return Err("is UTF-16".to_owned());
        }
        self.begun = true;
        let mut rest = std::mem::take(&mut self.rest);
        rest.extend_from_slice(chunk);
        let mut at = 0;
        while let Some(left) = rest.get(at..).filter(|left| !left.is_empty()) {
            if let Some(end) = self.until {
                match memmem::find(left, end) {
                    Some(found) => at += found + end.len(),
                    None => {
                        // The end itself may be split between two chunks.
                        at = rest.len().saturating_sub(end.len() - 1).max(at);
                        break;
                    }
                }
                self.until = None;
                continue;
            }
            let Some(found) = memchr(b'<', left) else {
                at = rest.len();
                break;
            };
            at += found;
            let tag = rest.get(at..).unwrap_or_default();
            if let Some((start, end)) = SKIPPED.iter().find(|(start, _)| tag.starts_with(start)) {
                at += start.len();
                self.until = Some(end);
                continue;
            }
            // Not enough bytes yet to distinguish a comment from a declaration.
            if tag.len() < 9 && tag.starts_with(b"<!") || tag.len() < 2 {
                break;
            }
            if tag.starts_with(b"<!") {
                return Err("declares a document type, which no workbook does".to_owned());
            }
            match tag_length(tag) {
                Some(length) => {
                    self.tag(tag.get(1..length - 1).unwrap_or_default())?;
                    at += length;
                }
                None if tag.len() > MAX_TAG => {
                    return Err("contains a tag without an end".to_owned());
                }
                None => break,
            }
        }
        rest.drain(..at);
        self.rest = rest;
        Ok(())
    }

    /// Examines what is between `<` and `>`.
    fn tag(&mut self, inner: &[u8]) -> Result<(), String> {
        let name = inner
            .split(|byte| byte.is_ascii_whitespace() || *byte == b'/')
            .next()
            .unwrap_or_default();
        let name = name.rsplit(|&byte| byte == b':').next().unwrap_or_default();
        match name {
            b"row" => {
                let place = attribute(inner, b"r").map(check_place).transpose()?;
                self.row = place.map_or(self.row.saturating_add(1), |(_, row)| row);
                let hidden = is_hidden(inner, b"ht").then_some(self.row);
                self.hidden.rows.extend(hidden);
            }
            b"col" => {
                let columns = number::<u32>(inner, b"min").zip(number::<u32>(inner, b"max"));
                let hidden = columns.filter(|_| is_hidden(inner, b"width"));
                // Counted from 1 in the file.
                self.hidden.columns.extend(
                    hidden.map(|(first, last)| (first.saturating_sub(1), last.saturating_sub(1))),
                );
            }
            b"sheet" => self.sheets.extend(pair(inner, b"name", b"r:id")),
            b"Relationship" => self.members.extend(pair(inner, b"Id", b"Target")),
            b"c" => _ = attribute(inner, b"r").map(check_place).transpose()?,
            b"dimension" | b"mergeCell" | b"f" => {
                self.has_merges |= name == b"mergeCell";
                attribute(inner, b"ref").map_or(Ok(()), check_range)?;
            }
            b"sst" => {
                let count = text(inner, b"uniqueCount").map_or(0, declared);
                self.texts_declared = self.texts_declared.max(count);
            }
            _ => {}
        }
        Ok(())
    }
}

/// The text of an attribute.
fn text<'t>(inner: &'t [u8], name: &[u8]) -> Option<&'t str> {
    std::str::from_utf8(attribute(inner, name)?).ok()
}

/// The number of an attribute.
fn number<T: std::str::FromStr>(inner: &[u8], name: &[u8]) -> Option<T> {
    text(inner, name)?.trim().parse().ok()
}

/// Whether a row or a column is not shown: by its mark, or because it has no size.
fn is_hidden(inner: &[u8], size: &[u8]) -> bool {
    matches!(attribute(inner, b"hidden"), Some(b"1" | b"true"))
        || number::<f64>(inner, size) == Some(0.0)
}

/// Two attributes as texts.
fn pair(inner: &[u8], first: &[u8], second: &[u8]) -> Option<(String, String)> {
    let text = |name| {
        let text = String::from_utf8_lossy(attribute(inner, name)?).into_owned();
        let text = text
            .replace("&lt;", "<")
            .replace("&gt;", ">")
            .replace("&quot;", "\"")
            .replace("&apos;", "'");
        Some(text.replace("&amp;", "&"))
    };
    text(first).zip(text(second))
}

/// A declared count. Text that is not a number counts as 0, a number that is too large as the
/// largest one.
fn declared(text: &str) -> u64 {
    let digits = text.trim();
    if digits.bytes().all(|byte| byte.is_ascii_digit()) {
        digits.parse().unwrap_or(u64::MAX)
    } else {
        0
    }
}

/// Length of a tag from `<` to `>`, both included; a `>` in quotes does not end it.
fn tag_length(tag: &[u8]) -> Option<usize> {
    let mut quote = None;
    for (at, &byte) in tag.iter().enumerate() {
        match quote {
            Some(open) if byte == open => quote = None,
            Some(_) => {}
            None if byte == b'>' => return Some(at + 1),
            None if matches!(byte, b'"' | b'\'') => quote = Some(byte),
            None => {}
        }
    }
    None
}

/// The value of an attribute, by its name without a prefix.
fn attribute<'t>(inner: &'t [u8], wanted: &[u8]) -> Option<&'t [u8]> {
    let mut rest = inner;
    loop {
        let equals = memchr(b'=', rest)?;
        let name = rest.get(..equals)?.trim_ascii();
        let name = name
            .rsplit(u8::is_ascii_whitespace)
            .next()
            .unwrap_or_default();
        let value = rest.get(equals + 1..)?.trim_ascii_start();
        let quote = *value.first()?;
        let value = value.get(1..)?;
        let end = memchr(quote, value)?;
        if name == wanted {
            return value.get(..end);
        }
        rest = value.get(end + 1..)?;
    }
}

/// Column and row of `A1`, column 0 for the bare row `1`.
fn check_place(place: &[u8]) -> Result<(u32, u32), String> {
    let letters = place
        .iter()
        .take_while(|byte| byte.is_ascii_alphabetic())
        .count();
    let (column, row) = place.split_at(letters);
    let no_place = || {
        let place = shorten(&String::from_utf8_lossy(place));
        format!("refers to cell \"{place}\", which no sheet has")
    };
    if column.len() > 3 || row.len() > 7 || !row.iter().all(u8::is_ascii_digit) {
        return Err(no_place());
    }
    let column = column.iter().fold(0, |sum, byte| {
        26 * sum + u32::from(byte.to_ascii_uppercase() - b'A' + 1)
    });
    let row = row
        .iter()
        .fold(0, |sum, byte| 10 * sum + u32::from(byte - b'0'));
    if row == 0 {
        Err(no_place())
    } else {
        Ok((column, row))
    }
}

fn check_range(range: &[u8]) -> Result<(), String> {
    let mut parts = range.split(|&byte| byte == b':');
    let first = check_place(parts.next().unwrap_or_default())?;
    let last = parts.next().map_or(Ok(first), check_place)?;
    if last.0 < first.0 || last.1 < first.1 || parts.next().is_some() {
        return Err(format!(
            "refers to cells \"{}\", which no sheet has",
            shorten(&String::from_utf8_lossy(range))
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_found_however_the_bytes_are_cut() {
        let text =
            b"<?xml version='1.0'?><!-- <c r=\"A0\"> --><sst count=\"9\" uniqueCount = '77'><si><t>a > b</t></si>\
            <![CDATA[<c r=\"AAAA1\"/>]]><x:c  r=\"XFD1048576\" t='>'/><mergeCell ref=\"A1:B2\"/></sst>";
        for size in [1, 2, 3, 7, 64, 1000] {
            let mut tags = Tags::default();
            for chunk in text.chunks(size) {
                tags.feed(chunk).unwrap();
            }
            assert_eq!(
                (tags.texts_declared, tags.has_merges, tags.rest.len()),
                (77, true, 0),
                "{size}"
            );
        }
    }

    #[test]
    fn cells_that_no_sheet_has_are_refused() {
        for text in [
            "<c r=\"A0\"/>",
            "<c r='ABCD1'/>",
            "<c s=\"1\" r=\"A12345678\"/>",
            "<row r=\"-1\"/>",
            "<dimension ref=\"B5:A1\"/>",
            "<x:f ref=\"A1:B2:C3\"/>",
            "<!DOCTYPE a [<!ENTITY b \"c\">]>",
        ] {
            assert!(Tags::default().feed(text.as_bytes()).is_err(), "{text}");
        }
        for text in [
            "<c r=\"A1\"/>",
            "<row r=\"1048576\"/>",
            "<f ref=\"A1:A1\"/>",
            "<cols r=\"x\"/>",
            "<c t=\"n\">",
        ] {
            assert_eq!(Tags::default().feed(text.as_bytes()), Ok(()), "{text}");
        }
    }

    #[test]
    fn a_row_without_a_number_follows_the_last_one() {
        let mut tags = Tags::default();
        let text = "<cols><col min='2' max='3' hidden='1'/><col min='5' max='5' width='0'/><col min='6' max='6' width='9'/>\
             </cols><row hidden='1'/><row/><row r='7'></row><row hidden='true'/><row r='12' hidden='1'/><row hidden='1'>\
             <row ht='0' customHeight='1'/><row ht='15'/>";
        tags.feed(text.as_bytes()).unwrap();
        assert_eq!(
            tags.hidden,
            Hidden {
                rows: vec![1, 8, 12, 13, 14],
                columns: vec![(1, 2), (4, 4)]
            }
        );
    }

    #[test]
    fn other_zip_files_are_recognised() {
        assert!(
            check(b"PK\x03\x04garbage")
                .unwrap_err()
                .message
                .contains("damaged")
        );
        let names = |all: &[&str]| {
            is_workbook(
                &all.iter().map(|&name| name.to_owned()).collect::<Vec<_>>(),
                b"PK",
            )
        };
        for (all, said) in [
            (&["xl/workbook.bin", "[Content_Types].xml"][..], "XLSB"),
            (&["objects.xlsx"], "contains objects.xlsx"),
            (
                &["[Content_Types].xml", "_rels/.rels", "word/document.xml"],
                "text document",
            ),
            (&["readme.txt"], "not a workbook"),
        ] {
            assert!(names(all).unwrap_err().message.contains(said));
        }
        assert!(names(&["[Content_Types].xml", "_rels/.rels", "xl/workbook.xml"]).is_ok());
    }
}
