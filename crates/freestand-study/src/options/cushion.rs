//! The keys that describe a cushion, in `[objects]` and in a cushion file: kept as texts, each with
//! its line.

use toml::de::DeValue;

use super::{Reader, Section, Written, bare_number, words};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

/// Keys with a unit: if the key ends in one, the value may be a bare number.
const QUANTITIES: [(&str, Dimension); 7] = [
    ("stiffness", Dimension::Stiffness),
    ("pad_stiffness", Dimension::Stiffness),
    ("series_stiffness", Dimension::Stiffness),
    ("bottoming", Dimension::Length),
    ("compressions", Dimension::Length),
    ("forces", Dimension::Force),
    ("pad_thickness", Dimension::Length),
];

/// Keys that hold a name or a pure number.
const NAMES: [&str; 6] = ["law", "cushion", "pads_per_edge", "exponent", "damping", "dissipation"];

pub(super) fn cushion(reader: &mut Reader<'_>, table: &mut Section<'_, '_>) -> Words {
    let quantities = QUANTITIES.map(|(key, dimension)| (key, texts(reader, table, key, dimension)));
    let names = NAMES.map(|key| (key, table.name_or_number(reader, key)));
    words(quantities.into_iter().chain(names))
}

/// One quantity or a list of them, as one text with units.
pub(super) fn texts(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
    key: &'static str,
    dimension: Dimension,
) -> Option<Written<String>> {
    let (name, value, line, unit) = table.take_with_unit(reader, key, dimension)?;
    let text_of = |value: &DeValue| match (unit, bare_number(value), value.as_str()) {
        (Some(unit), Some(number), _) => Some(format!("{number} {}", unit.symbol)),
        (Some(unit), None, Some(number)) => Some(format!("{number} {}", unit.symbol)),
        (None, Some(number), _) => Some(number),
        (None, None, Some(text)) => Some(text.to_owned()),
        _ => None,
    };
    let items: Vec<&DeValue> = match value {
        DeValue::Array(items) => items.iter().map(toml::Spanned::get_ref).collect(),
        one => vec![one],
    };
    let texts: Option<Vec<String>> = items.into_iter().map(text_of).collect();
    if let Some(texts) = texts {
        return Some(Written { value: texts.join(", "), line });
    }
    let hint = format!("write numbers and their units, such as {}", super::example(dimension));
    reader.wrong_type(line, &name, dimension.with_article(), value, &hint);
    None
}
