//! Places.

use freestand_input::words::counted;
use freestand_study::places::{Confidence, Place};

use crate::table::{pairs, table};

/// Places with their hazard.
pub fn places_text(found: &[&Place]) -> String {
    let row = |place: &&Place| {
        let (code, values) = (place.hazard.code_title().to_owned(), place.hazard.words());
        vec![
            place.name.to_owned(),
            place.whereabouts(),
            code,
            values,
            place.confidence.name().to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = found.iter().map(row).collect();
    let mut text = table(&["place", "in", "code", "hazard", "confidence"], &rows);
    text.push_str(&format!("\n{}", counted(found.len(), "place")));
    let approximate = found
        .iter()
        .filter(|place| place.confidence == Confidence::Approximate)
        .count();
    if approximate > 0 {
        text.push_str(&format!(
            "; {approximate} approximate: confirm those values before you rely on them"
        ));
    }
    text.push('\n');
    text
}

/// One place.
pub fn place_text(place: &Place) -> String {
    let rows = [
        ("place", place.name.to_owned()),
        ("in", place.whereabouts()),
        (
            "code",
            format!("{} ({})", place.hazard.code_title(), place.hazard.code()),
        ),
        ("hazard", place.hazard.words()),
        ("source", place.source.to_owned()),
        ("confidence", place.confidence.name().to_owned()),
    ];
    pairs(&rows)
}
