//! Reads the keys of a spectrum: its place, its code, and what that code does not take.

use std::path::Path;

use freestand::code_spectrum::PeriodCode;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::word_reader::WordReader;

use super::code::{CODES, Code};
use super::named::{found, named_place, place_of};
use super::{Target, codes, countries, table};
use crate::places::{CONVERTED_YEARS, NotDerived, NotFound, Place, places};

/// What a person may write besides a place, and so what a remedy may name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Remedies {
    /// A code and its values, or a table.
    Codes,
    /// A code and its values: a table has no clauses for parts.
    Parts,
    /// Nothing: the place says what the hazard is.
    PlaceAlone,
}

pub(super) fn resolve(
    words: &Words,
    base_dir: &Path,
    remedies: Remedies,
) -> Result<Target, Problems> {
    let mut reader = WordReader::new(words);
    let target = place(&mut reader, remedies)
        .and_then(|place| Some((code(&mut reader, place.as_ref())?, place)))
        .and_then(|(code, place)| {
            let place = place.as_ref();
            check_keys(&mut reader, code, remedies);
            match code {
                Code::As1170_4 => codes::as1170_4(&mut reader, place),
                Code::Eurocode8 => codes::eurocode8(&mut reader, place),
                Code::Asce7 => codes::asce7(&mut reader, place),
                Code::Nzs1170_5 => codes::nzs1170_5(&mut reader, place),
                Code::Ntc2018 => countries::ntc2018(&mut reader, place),
                Code::Tbdy2018 => countries::tbdy2018(&mut reader, place),
                Code::Ts1170_5 => countries::ts1170_5(&mut reader, place),
                Code::Table => table::table(&mut reader, base_dir),
            }
        });
    reader.problems.finish(target)
}

/// The place, if one is named; `None` after a problem with it that leaves the code open. A misspelt
/// place is noted, and another of the code stands in for it so that the other words are checked.
fn place(reader: &mut WordReader, remedies: Remedies) -> Option<Option<Place>> {
    if reader.has("place") && reader.has("city") {
        reader.note(
            &["place", "city"],
            "`place` and `city` are two names of the same key",
            "keep `place`",
        );
        return None;
    }
    for (key, other) in [("latitude", "longitude"), ("longitude", "latitude")] {
        reader.exclusive("place", key);
        reader.exclusive("city", key);
        if reader.has(key) && !reader.has(other) {
            let message = format!("`{key}` needs `{other}`");
            reader.missing(&[other, key], message, format!("give `{other}` in degrees"));
            return None;
        }
    }
    let Some((key, name)) = named_place(reader.words) else {
        return Some(None);
    };
    let why = match found(reader.words, &name) {
        Ok(found) => return Some(at_return_period(reader, found)),
        Err(why) => why,
    };
    let bring = match remedies {
        Remedies::PlaceAlone => "a study takes a hazard of your own",
        Remedies::Codes => {
            "give the hazard itself, such as `hazard_factor = \"0.08\"`, or a table as `spectrum`"
        }
        Remedies::Parts => {
            "give the hazard itself, such as `code = \"asce7\"` and `sds = \"1 g\"`, or the acceleration of the floor"
        }
    };
    let code = match (reader.words.get("code"), &why) {
        (Some(text), _) => Code::parse(text).map(Code::name),
        (None, NotFound::Unknown(near, _) | NotFound::Several(near)) => near
            .first()
            .and_then(|name| Place::find(name))
            .map(|place| place.hazard.code()),
        (None, _) => None,
    };
    reader
        .problems
        .push(why.problem(Some(key), &name, bring).of(&[key]));
    places()
        .iter()
        .find(|place| Some(place.hazard.code()) == code)
        .cloned()
        .map(Some)
}

/// The place with values at the return period that the words name, where its code has none there.
fn at_return_period(reader: &mut WordReader, place: Place) -> Option<Place> {
    let key = "return_period_years";
    if !reader.has(key) {
        return Some(place);
    }
    // A number that is none is noted by the code.
    let text = reader.words.get(key).unwrap_or_default();
    let Some(derived) = text
        .trim()
        .parse()
        .ok()
        .and_then(|years| place.derived_at(years))
    else {
        return Some(place);
    };
    match derived {
        Ok(derived) => return Some(derived),
        Err(NotDerived::Unknown) => reader.note(
            &[key],
            format!(
                "the values of {} have no return period, so that none can be derived from them",
                place.name
            ),
            format!("leave `{key}` out"),
        ),
        Err(NotDerived::Beyond) => {
            let [first, last] = CONVERTED_YEARS;
            reader.note(
                &[key],
                format!("`{key}` {} is outside of the {first} to {last} years to which values are converted", shorten(text)),
                format!("give {first} to {last} years, or a spectrum of your own"),
            );
        }
    }
    Some(place)
}

/// The code: as named; otherwise a table if a file is named, or that of the place, or else
/// AS 1170.4.
fn code(reader: &mut WordReader, place: Option<&Place>) -> Option<Code> {
    let of_place = place.and_then(|place| Code::parse(place.hazard.code()));
    let Some(text) = reader.words.get("code") else {
        return Some(if reader.has("spectrum") {
            Code::Table
        } else {
            of_place.unwrap_or(Code::As1170_4)
        });
    };
    let found = Code::parse(text);
    if let (Some(found), Some(of_place), Some(place)) = (found, of_place, place)
        && found != of_place
        && found.keys().contains(&"place")
    {
        let key = named_place(reader.words).map_or("place", |(key, _)| key);
        let (title, known) = (found.title(), of_place.title());
        let message = format!(
            "`{key}` \"{}\" has values for {known}, not for {title}",
            place.name
        );
        reader.note(
            &["code", key],
            message,
            "leave `code` out, or give the values of that code instead of the place",
        );
        return None;
    }
    if found.is_none() {
        let known = CODES.iter().map(|(_, code)| *code);
        reader.problems.push(unknown_code(text, known));
    }
    found
}

/// The problem with the name of a code that is not one of these.
pub(super) fn unknown_code(text: &str, known: impl Iterator<Item = Code>) -> Problem {
    let names: Vec<&str> = known.map(Code::name).collect();
    let message = format!("`code` \"{}\" is not known", shorten(text));
    Problem::value(message, format!("known: {}", names.join(", "))).of(&["code"])
}

/// The code that the words describe; AS 1170.4 where they name none. `None` for a code that is not
/// known.
pub(crate) fn code_of(words: &Words) -> Option<Code> {
    match words.get("code") {
        Some(text) => Code::parse(text),
        None if words.get("spectrum").is_some() => Some(Code::Table),
        None => {
            let of_place = place_of(words).and_then(|place| Code::parse(place.hazard.code()));
            of_place.or(Some(Code::As1170_4))
        }
    }
}

/// The code of the periods of buildings of a study: that of its spectrum.
pub fn period_code(words: &Words) -> Option<PeriodCode> {
    period_code_named(code_of(words)?.name())
}

pub(super) fn period_code_named(name: &str) -> Option<PeriodCode> {
    PeriodCode::ALL.into_iter().find(|code| code.name() == name)
}

/// The key that names a spectrum other than that of AS 1170.4, if any.
pub(crate) fn key_of_other_code(words: &Words) -> Option<&'static str> {
    let is_elsewhere = |place: &Place| Code::parse(place.hazard.code()) != Some(Code::As1170_4);
    if place_of(words).as_ref().is_some_and(is_elsewhere) {
        return named_place(words).map(|(key, _)| key);
    }
    let has_other_code = words
        .get("code")
        .is_some_and(|text| Code::parse(text) != Some(Code::As1170_4));
    match () {
        () if words.get("spectrum").is_some() => Some("spectrum"),
        () if has_other_code => Some("code"),
        () => None,
    }
}

/// Refuses keys that the code does not take.
pub(super) fn check_keys(reader: &mut WordReader, code: Code, remedies: Remedies) {
    let strangers = reader
        .words
        .entries()
        .filter(|(key, _)| *key != "code" && !code.keys().contains(key));
    for (key, _) in strangers {
        let takers: Vec<&str> = CODES
            .iter()
            .filter(|(_, other)| other.keys().contains(&key))
            .map(|(_, other)| other.name())
            .collect();
        let hint = if remedies == Remedies::PlaceAlone && code != Code::Table {
            "leave it out: the code of the place does not have it".to_owned()
        } else if remedies == Remedies::Parts && takers == ["table"] {
            "leave it out: the clauses for parts take the values of a code".to_owned()
        } else if code == Code::Table || takers == ["table"] {
            "leave it out; a spectrum is either that of a code or the table in `spectrum`"
                .to_owned()
        } else {
            format!(
                "leave it out, or name a code that has it: `code = \"{}\"`",
                takers.join("\"` or `code = \"")
            )
        };
        reader.note(
            &[key],
            format!("`{key}` is not part of {}", code.title()),
            hint,
        );
    }
}
