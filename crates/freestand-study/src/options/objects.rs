//! The keys of `[objects]`.

use super::cushion::CUSHION_KEYS;
use super::{Reader, Section, Written, read_words};
use freestand_input::keys::Words;
use freestand_input::problem::Problem;
use freestand_input::toml_reader::describe;

options! {
    /// `[objects]`, as written.
    ObjectsOptions(reader, table) {
        /// The values of [`CUSHION_KEYS`].
        cushion: (Words) = read_words(reader, table, &CUSHION_KEYS);
        heights_m: [grid "heights" Length];
        thicknesses_m: [grid "thicknesses" Length];
        mass_kg: [quantity "mass" Mass];
        restitution: (Option<Written<RestitutionOption>>) = restitution(reader, table);
        restitution_factor: ratio;
        accuracy: string;
        tolerance_m_s2: [quantity "tolerance" Acceleration];
        friction: ratio;
    }
}

/// `restitution`: a word or a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RestitutionOption {
    Housner,
    Value(f64),
}

fn restitution(reader: &mut Reader, table: &mut Section) -> Option<Written<RestitutionOption>> {
    let (value, line) = table.take(reader, "restitution")?;
    if value
        .as_str()
        .is_some_and(|word| word.eq_ignore_ascii_case("housner"))
    {
        return Some(Written {
            value: RestitutionOption::Housner,
            line,
        });
    }
    if value
        .as_str()
        .is_some_and(|word| !word.contains(|c: char| c.is_ascii_digit()))
    {
        let message = format!("restitution = {} is not known", describe(value));
        reader.note(
            Some(line),
            Problem::value(message, "write \"housner\" or a number in (0, 1]"),
        );
        return None;
    }
    reader
        .ratio_value("restitution", value, line)
        .map(|ratio| ratio.map(RestitutionOption::Value))
}
