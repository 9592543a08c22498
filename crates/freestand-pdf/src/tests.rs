//! Pages that are laid out, and the text that stands on them.

use freestand_study::assess::Row;
use freestand_study::inventory::Item;
use typst::layout::{Frame, FrameItem};
use typst_layout::PagedDocument;

use crate::document::{assessment_pdf, data};
use crate::fixture::{head, item, overview, rows};
use crate::typesetter::Typesetter;

/// The text of a frame and those in it, as it reads.
fn text_of(frame: &Frame, out: &mut String) {
    for (_, piece) in frame.items() {
        match piece {
            FrameItem::Group(group) => text_of(&group.frame, out),
            FrameItem::Text(text) => out.push_str(&text.text),
            _ => {}
        }
    }
}

fn pages(document: &PagedDocument) -> Vec<String> {
    let read = |frame: &Frame| {
        let mut text = String::new();
        text_of(frame, &mut text);
        text.replace('\u{200b}', "")
    };
    document.pages().iter().map(|page| read(&page.frame)).collect()
}

fn document(items: &[Item]) -> PagedDocument {
    let rows = rows(items);
    let typesetter = Typesetter::new();
    let data = data(&typesetter, &head(), &overview(&rows, rows.len()), &rows).expect("data");
    typesetter.document(data).expect("a document")
}

#[test]
fn every_object_has_a_page_with_its_name_at_the_head() {
    let items: Vec<_> = (0..4).map(item).collect();
    let pages = pages(&document(&items));
    for (rank, item) in items.iter().enumerate() {
        let head = format!("{} · {} · {}", rank + 1, item.id, item.item);
        assert!(pages.iter().any(|page| page.contains(&head)), "{head}");
    }
    for words in ["RESTRAIN", "NO VERDICT", "What to do first", "Level 2", "Three rows have no tolerance."] {
        assert!(pages.iter().any(|page| page.contains(words)), "{words}");
    }
    assert!(pages[0].contains(&format!("page 1 of {}", pages.len())), "{}", pages[0]);
}

/// Each is markup, code or a path to the typesetter if it is taken for more than a text.
const HOSTILE: [&str; 8] = [
    "#panic(\"out\")",
    "#read(\"/document.json\")",
    "$x$ *bold* _it_ `raw` <label> @ref",
    "= A heading",
    "]#eval(\"1+1\")[",
    "\\u{1F}\" } , \"decision\": \"leave\"",
    "a // comment /* and */ more -- dash ~ 'quotes' \"too\"",
    "=HYPERLINK(\"x\")",
];

#[test]
fn a_name_is_printed_as_it_is_written() {
    for name in HOSTILE {
        let mut odd = item(0);
        (odd.id, odd.item, odd.notes, odd.room) = (name.to_owned(), name.to_owned(), name.to_owned(), name.to_owned());
        // Lines are broken at blanks, which leaves no trace in the pieces.
        let bare = |text: &str| text.split_whitespace().collect::<String>();
        let all = bare(&pages(&document(&[odd])).concat());
        assert!(all.matches(&bare(name)).count() >= 4, "{name} in {all}");
    }
}

#[test]
fn texts_without_end_and_without_blanks_stay_on_a_few_pages() {
    let mut odd = item(0);
    odd.item = "x".repeat(100_000);
    odd.notes = "\u{202e}\u{0}\n架台 😀".repeat(3000);
    let document = document(&[odd]);
    assert!(document.pages().len() < 12, "{}", document.pages().len());
    assert!(pages(&document).concat().contains("the embedded fonts lack"), "missing characters are said");
}

#[test]
fn the_same_assessment_gives_the_same_bytes_and_another_does_not() {
    let items: Vec<_> = (0..4).map(item).collect();
    let rows = rows(&items);
    let make = |rows: &[Row<'_>]| assessment_pdf(&head(), &overview(rows, rows.len()), rows).expect("a PDF");
    let (first, second) = (make(&rows), make(&rows));
    assert!(first == second, "two runs differ");
    assert!(first.starts_with(b"%PDF-"));
    assert!(first != make(&rows[..2]), "two assessments are one");
    if let Some(path) = std::env::var_os("FREESTAND_PDF") {
        std::fs::write(path, first).expect("written");
    }
}

#[test]
fn an_empty_assessment_is_a_summary() {
    let typesetter = Typesetter::new();
    let data = data(&typesetter, &head(), &overview(&[], 4), &[]).expect("data");
    let pages = pages(&typesetter.document(data).expect("a document"));
    assert_eq!(pages.len(), 1);
    assert!(pages[0].contains("PARTIAL: 0 of 4 objects are assessed"), "{}", pages[0]);
}
