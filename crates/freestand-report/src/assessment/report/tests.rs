use crate::assessment::Wanted;
use crate::assessment::fixture::{HOSTILE, TABLES, hostile_items, inventory, item, read, written};

use super::*;

const ALONE: Wanted = Wanted {
    report: true,
    pages: 200,
    ..TABLES
};

fn html(inventory: &Inventory, assessed: usize, pages: usize) -> String {
    let (folder, names) = written(inventory, assessed, Wanted { pages, ..ALONE });
    assert_eq!(names, ["objects.csv", REPORT_NAME, "worklist.csv"]);
    String::from_utf8(read(&folder, REPORT_NAME)).unwrap()
}

/// The document as XML: a browser would forgive mistakes.
fn parse(html: &str) -> roxmltree::Document<'_> {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    roxmltree::Document::parse_with_options(html, options).unwrap()
}

fn pages(document: &roxmltree::Document) -> Vec<String> {
    let sections = document
        .descendants()
        .filter(|node| node.attribute("class") == Some("object"));
    sections
        .filter_map(|node| node.attribute("id").map(str::to_owned))
        .collect()
}

#[test]
fn every_object_has_its_page_in_the_order_of_the_list() {
    let html = html(&inventory((0..12).map(item).collect()), 12, 200);
    let document = parse(&html);
    assert_eq!(pages(&document), (1..=12).map(anchor).collect::<Vec<_>>());
    // Every link leads somewhere, and nothing is loaded.
    let ids: Vec<&str> = document
        .descendants()
        .filter_map(|node| node.attribute("id"))
        .collect();
    for node in document.descendants() {
        if let Some(target) = node.attribute("href") {
            assert!(
                target.strip_prefix('#').is_some_and(|id| ids.contains(&id)),
                "{target}"
            );
        }
        assert!(
            node.attribute("src").is_none()
                && !node.has_tag_name("script")
                && !node.has_tag_name("link")
        );
    }
    assert!(!html.contains("url(") && !html.contains("@import"));
    for words in [
        "▲ RESTRAIN",
        "◆ SOFTEN",
        "? NO VERDICT",
        "● LEAVE",
        "Eq",
        "AS 1170.4-2007, section 8",
        "Level 4",
        "seed 1",
    ] {
        assert!(html.contains(words), "{words}");
    }
}

#[test]
fn it_prints_like_every_report() {
    let html = html(&inventory((0..31).map(item).collect()), 30, 200);
    crate::print_check::check_print(&html, TITLE, CSS);
}

/// Date, preparer, revision and a line to sign; what is not stated is empty. The cards are on the screen,
/// and on paper where the box is ticked; what the brackets mean stands on the first sheet.
#[test]
fn it_is_signed_and_its_cards_are_printed_on_request() {
    use crate::assessment::fixture::head;
    use crate::assessment::overview::Overview;
    let mut head = head(12);
    let overview = Overview::new(12, 50);
    let made = |head: &Head| summary::summary(head, &overview, 200, ALONE).0;
    let html = made(&head);
    let labels = ["Date", "Prepared by", "Revision", "Signature"];
    assert!(
        labels
            .iter()
            .all(|label| html.contains(&format!("<div><b></b><span>{label}</span></div>"))),
        "{html}"
    );
    assert!(html.contains("98 % confidence"));
    head.title.preparer = Some("A. <Person>".to_owned());
    assert!(made(&head).contains("<b>A. &lt;Person&gt;</b><span>Prepared by</span>"));
    let listed = |cards| {
        let inventory = inventory((0..3).map(item).collect());
        let mut overview = Overview::new(3, 50);
        for one in &inventory.items {
            let found = crate::assessment::fixture::assessment(one, 0);
            overview.add(&Line {
                item: one,
                found: Some((1, &found)),
            });
        }
        let head = Head {
            cards,
            ..crate::assessment::fixture::head(3)
        };
        let [with_cards, without] =
            [200, 0].map(|pages| summary::summary(&head, &overview, pages, ALONE).0);
        assert!(without.contains("id=\"print-lists\"") && !without.contains("id=\"print-cards\""));
        with_cards
    };
    assert!(
        listed(true).contains("id=\"print-cards\" checked")
            && listed(false).contains("id=\"print-cards\" />")
    );
    assert!(CSS.contains("main:not(:has(#print-cards:checked)) .object { display: none; }"));
}

#[test]
fn only_the_most_urgent_have_pages() {
    let html = html(&inventory((0..12).map(item).collect()), 12, 5);
    let document = parse(&html);
    assert_eq!(pages(&document), (1..=5).map(anchor).collect::<Vec<_>>());
    assert!(
        html.contains("Objects up to rank 5 have a card below.") && html.contains("objects.csv")
    );
    assert!(html.contains("O-0000") && !html.contains("href=\"#object-6\""));
}

/// The first printed sheet says whose building it is, where, how many, what first, and what was
/// assumed; the work list has every object for which something has to be done, and no other.
#[test]
fn the_first_sheet_and_the_work_list_are_there() {
    let html = html(&inventory((0..12).map(item).collect()), 12, 5);
    let document = parse(&html);
    let section = |id: &str| {
        document
            .descendants()
            .find(|node| node.attribute("id") == Some(id))
            .unwrap()
    };
    let text = |node: roxmltree::Node| -> String {
        node.descendants().filter_map(|node| node.text()).collect()
    };
    let main = document
        .descendants()
        .find(|node| node.has_tag_name("main"))
        .unwrap();
    assert!(
        text(main)
            .trim_start()
            .starts_with("Nobody stated the place and the building: this is a 30-storey tower")
    );
    let sheet = text(section("one-page"));
    for said in [
        "Main, 30 storeys, 90 m high",
        "ward.xlsx, sheet Objects, 24 objects",
        "Assessed: 12 of 12 objects.",
    ] {
        assert!(sheet.contains(said), "{said}: {sheet}");
    }
    let rows = |id: &str, class: &str| -> Vec<String> {
        let tables = section(id)
            .descendants()
            .filter(|node| node.attribute("class") == Some(class));
        let bodies =
            tables.flat_map(|table| table.children().filter(|node| node.has_tag_name("tbody")));
        bodies
            .flat_map(|body| {
                body.children()
                    .filter(|row| row.has_tag_name("tr"))
                    .map(text)
            })
            .collect()
    };
    assert_eq!(rows("one-page", "cards ten").len(), 10);
    let work = rows("floors", "cards work");
    // Of 12 objects three may be left; the five floors have a row each.
    assert_eq!(work.len(), 9 + 5);
    assert!(
        work[0].contains("Level 4") && work.iter().all(|row| !row.contains("LEAVE")),
        "{work:#?}"
    );
    assert!(text(section("first")).contains(crate::assessment::head::RULE));
}

/// What is printed of an object is short: the rest is folded. A sheet holds some 4,300 characters of
/// its small print (measured: three objects of 1,450), so that two objects of 2,000 share one, and 62
/// stay under 40 sheets.
#[test]
fn an_object_prints_on_half_a_sheet() {
    let html = html(&inventory((0..12).map(item).collect()), 12, 200);
    let document = parse(&html);
    let is_folded =
        |node: &roxmltree::Node| node.ancestors().any(|one| one.has_tag_name("details"));
    for object in document
        .descendants()
        .filter(|node| node.attribute("class") == Some("object"))
    {
        let texts = object
            .descendants()
            .filter(|node| node.is_text() && !is_folded(node));
        let printed: usize = texts
            .filter_map(|node| node.text())
            .map(|text| text.trim().chars().count())
            .sum();
        assert!((300..2_000).contains(&printed), "{printed}");
        let folded: String = object
            .descendants()
            .filter(is_folded)
            .filter_map(|node| node.text())
            .collect();
        assert!(
            folded.contains("How it was calculated") && folded.contains("R_D"),
            "{folded}"
        );
    }
}

#[test]
fn hostile_texts_stay_texts() {
    let html = html(&inventory(hostile_items()), 8, 200);
    let document = parse(&html);
    let texts: String = document
        .descendants()
        .filter(|node| node.is_text())
        .filter_map(|node| node.text())
        .collect();
    for text in HOSTILE {
        let shown: String = text
            .chars()
            .filter(|c| *c == '\n' || *c == '\t' || !c.is_control() && *c != '\u{fffe}')
            .collect();
        assert!(texts.contains(&shown), "{shown}");
    }
    assert!(
        document
            .descendants()
            .all(|node| !["script", "img"].contains(&node.tag_name().name()))
    );
    // Fifty thousand characters of one name do not fill the report.
    assert!(
        html.contains("(truncated)") && html.len() < 200_000,
        "{}",
        html.len()
    );
}

/// Keys stand as their reader types them.
#[test]
fn problems_name_flags() {
    let html = html(&inventory((0..3).map(item).collect()), 3, 0);
    assert!(html.contains("give a mapping file (--columns)"), "{html}");
    // The styles have comments of their own.
    let (_, body) = html.rsplit_once("</style>").unwrap();
    assert!(!body.contains('`'));
}

#[test]
fn a_part_says_so_first() {
    let html = html(&inventory((0..9).map(item).collect()), 4, 200);
    let partial = html.find("PARTIAL: 4 of 9 objects").unwrap();
    assert!(partial < html.find("<section").unwrap());
    assert_eq!(pages(&parse(&html)).len(), 4);
}

#[test]
fn nothing_is_a_report_too() {
    for (items, assessed) in [(0, 0), (3, 0)] {
        let html = html(&inventory((0..items).map(item).collect()), assessed, 200);
        assert!(pages(&parse(&html)).is_empty() && html.contains("No object was assessed."));
    }
}

#[test]
fn without_a_verdict_every_page_says_why() {
    let items = hostile_items().split_off(7);
    let html = html(&inventory(items), 1, 200);
    assert!(
        html.contains("? NO VERDICT")
            && html.contains(
                "Nothing was assessed, because its height, its thickness and its floor level were not given."
            )
    );
    parse(&html);
}

#[test]
fn the_same_rows_give_the_same_bytes() {
    let inventory = inventory((0..7).map(item).collect());
    assert!(html(&inventory, 7, 3) == html(&inventory, 7, 3));
}
