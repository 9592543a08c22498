//! Places.

use freestand_input::words::{counted, number};
use freestand_study::places::{Confidence, Place, PlaceHazard};

use crate::table::{pairs, table};

/// Places with their hazard.
pub fn places_text(found: &[Place]) -> String {
    let has_distance = found.iter().any(|place| place.distance_km.is_some());
    let row = |place: &Place| {
        let (code, values) = (place.hazard.code_title().to_owned(), place.words());
        let away = place
            .distance_km
            .map_or_else(String::new, |km| format!("{} km", number(km, 3)));
        let mut row = vec![
            place.name.to_string(),
            place.whereabouts(),
            code,
            values,
            place.confidence.name().to_owned(),
        ];
        row.extend(has_distance.then_some(away));
        row
    };
    let rows: Vec<Vec<String>> = found.iter().map(row).collect();
    let mut headings = vec!["place", "in", "code", "hazard", "confidence"];
    headings.extend(has_distance.then_some("away"));
    let mut text = table(&headings, &rows);
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
    let mut rows = vec![
        ("place", place.name.to_string()),
        ("in", place.whereabouts()),
        (
            "code",
            format!("{} ({})", place.hazard.code_title(), place.hazard.code()),
        ),
        ("hazard", place.words()),
        ("source", place.source.to_string()),
        ("confidence", place.confidence.name().to_owned()),
    ];
    if let Some(km) = place.distance_km {
        let to = match place.hazard {
            PlaceHazard::Ntc2018 { .. } => "to the nearest node",
            _ => "from the place that was asked for",
        };
        rows.push(("distance", format!("{} km {to}", number(km, 3))));
    }
    pairs(&rows)
}
