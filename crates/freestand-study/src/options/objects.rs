//! The keys of `[objects]`.

use super::cushion::CUSHION_KEYS;
use super::{Reader, Section, Written, read_words};
use freestand_input::keys::Words;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_input::toml_reader::describe;

/// `[objects]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ObjectsOptions {
    pub(crate) heights_m: Option<Written<Vec<f64>>>,
    pub(crate) thicknesses_m: Option<Written<Vec<f64>>>,
    pub(crate) mass_kg: Option<Written<f64>>,
    /// The values of [`CUSHION_KEYS`].
    pub(crate) cushion: Words,
    pub(crate) restitution: Option<Written<RestitutionOption>>,
    pub(crate) restitution_factor: Option<Written<f64>>,
    pub(crate) accuracy: Option<Written<String>>,
    pub(crate) tolerance_m_s2: Option<Written<f64>>,
    pub(crate) friction: Option<Written<f64>>,
}

/// `restitution`: a word or a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RestitutionOption {
    Housner,
    Value(f64),
}

pub(super) fn objects(reader: &mut Reader, table: &mut Section) -> ObjectsOptions {
    let mut cushion = Words::default();
    read_words(reader, table, &CUSHION_KEYS, &mut cushion);
    ObjectsOptions {
        cushion,
        heights_m: table.grid(reader, "heights", Dimension::Length),
        thicknesses_m: table.grid(reader, "thicknesses", Dimension::Length),
        mass_kg: table.quantity(reader, "mass", Dimension::Mass),
        restitution: restitution(reader, table),
        restitution_factor: table.ratio(reader, "restitution_factor"),
        accuracy: table.string(reader, "accuracy"),
        tolerance_m_s2: table.quantity(reader, "tolerance", Dimension::Acceleration),
        friction: table.ratio(reader, "friction"),
    }
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
