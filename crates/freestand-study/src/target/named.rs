//! The place that the words of a spectrum name.

use freestand_input::keys::Words;

use super::code::Code;
use crate::places::{NotFound, Place};

/// What names a place: the key, and its name or its coordinates.
pub(super) fn named_place(words: &Words) -> Option<(&'static str, String)> {
    let named = ["place", "city"]
        .into_iter()
        .find_map(|key| Some((key, words.get(key)?.to_owned())));
    named.or_else(|| {
        let (latitude, longitude) = (words.get("latitude")?, words.get("longitude")?);
        Some(("latitude", format!("{latitude}, {longitude}")))
    })
}

/// The place that the words name, by the code that they name.
pub(crate) fn place_of(words: &Words) -> Option<Place> {
    found(words, &named_place(words)?.1).ok()
}

/// The place with a name or at coordinates, by the code that the words name.
pub(super) fn found(words: &Words, name: &str) -> Result<Place, NotFound> {
    let code = words.get("code").and_then(Code::parse).map(Code::name);
    Place::look_up(name, code)
}
