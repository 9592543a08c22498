//! Reads a study: a TOML text, key by key, with the line of each value.
//!
//! No reader stops at a problem: it notes the problem and continues, so that a person can correct a
//! file in one go. Unknown keys are found because each reader states the keys that it knows.

/// The keys of a table, in the order in which they are listed for who mistypes one: each has a field with its value as
/// written and its line. After a key stands how it is written, by the function of [`Section`]; in brackets that of a
/// quantity, whose key has no unit, and its dimension; in parentheses the type of what is read in another way.
macro_rules! options {
    ($(#[$meta:meta])* $name:ident($reader:ident, $table:ident) {
        $( $(#[$doc:meta])* $key:ident: $how:tt $(= $value:expr)?; )*
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Default, PartialEq)]
        pub(crate) struct $name {
            $( $(#[$doc])* pub(crate) $key: options!(@type $how), )*
        }

        impl $name {
            pub(super) fn read($reader: &mut super::Reader<'_>, $table: &mut super::Section<'_, '_>) -> Self {
                Self { $( $key: options!(@read $reader, $table, $key, $how $(, $value)?), )* }
            }
        }
    };
    (@type ($type:ty)) => { $type };
    (@type [$function:ident $($_:tt)*]) => { options!(@type $function) };
    (@type $function:ident) => { Option<freestand_input::toml_reader::Written<options!(@value $function)>> };
    (@value string) => { String };
    (@value strings) => { Vec<freestand_input::toml_reader::Written<String>> };
    (@value boolean) => { bool };
    (@value count) => { u64 };
    (@value grid) => { Vec<f64> };
    (@value $number:ident) => { f64 };
    (@read $reader:ident, $table:ident, $key:ident, ($type:ty), $value:expr) => { $value };
    (@read $reader:ident, $table:ident, $key:ident, [$function:ident $name:literal $dimension:ident]) => {
        $table.$function($reader, $name, freestand_input::quantity::Dimension::$dimension)
    };
    (@read $reader:ident, $table:ident, $key:ident, $function:ident) => {
        $table.$function($reader, stringify!($key))
    };
}

mod assessment;
mod building;
mod change;
mod cushion;
mod ground;
mod objects;
mod outputs;
mod point_source;
mod processing;
mod target;

use std::path::Path;

use toml::de::{DeTable, DeValue};

pub use change::Change;
use cushion::CUSHION_KEYS;
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::toml_reader::{Place, Reader, Section, Written, bare_number, example};
use ground::ground;

pub(crate) use assessment::{ACCEPTED_KEYS, AssessmentOptions, RestraintOptions, WorldOptions};
pub(crate) use building::{BuildingOptions, LevelOptions};
pub(crate) use ground::{ComponentsOption, GroundOptions, VerticalOption};
pub(crate) use objects::{ObjectsOptions, RestitutionOption};
pub(crate) use outputs::{HistoryOptions, OutputsOptions};
pub(crate) use point_source::PointSourceOptions;
pub(crate) use target::TARGET_KEYS;

/// A study as a person wrote it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Options {
    pub(crate) ground: GroundOptions,
    pub(crate) building: BuildingOptions,
    pub(crate) objects: ObjectsOptions,
    pub(crate) outputs: OutputsOptions,
    pub(crate) assessment: AssessmentOptions,
    pub(crate) worlds: WorldOptions,
    pub(crate) restraint: RestraintOptions,
}

/// Whether a text is TOML and has a table of a study.
pub(crate) fn has_table_of_ours(text: &str) -> bool {
    let names = [
        "ground",
        "building",
        "objects",
        "outputs",
        "assessment",
        "worlds",
        "restraint",
    ];
    DeTable::parse(text.trim_start_matches('\u{feff}')).is_ok_and(|table| {
        table
            .get_ref()
            .keys()
            .any(|key| names.contains(&key.get_ref().as_ref()))
    })
}

/// Whether a text is TOML with no table and no key.
pub(crate) fn is_empty(text: &str) -> bool {
    DeTable::parse(text.trim_start_matches('\u{feff}'))
        .is_ok_and(|table| table.get_ref().is_empty())
}

/// Reads a study, with one value in place of its own if `change` is given: what can be read, and all
/// problems.
pub(crate) fn parse(
    text: &str,
    change: Option<&Change>,
    source: Option<&Path>,
) -> (Options, Problems) {
    let mut reader = Reader::new(text, source);
    let mut options = Options::default();
    let number = change.and_then(Change::number);
    let Some(mut document) = reader.document(text) else {
        return (options, reader.problems);
    };
    if let Some(change) = change {
        change.put(number.as_deref(), document.get_mut());
    }
    let mut top = Section::new(Place::Document, document.get_ref(), 1);
    if let Some(ground) = within(&mut top, &mut reader, "ground", ground) {
        options.ground = ground;
        options.ground.is_incomplete = !reader.problems.is_empty();
    }
    macro_rules! read {
        ($($key:ident: $options:ident),*) => {$(
            options.$key = within(&mut top, &mut reader, stringify!($key), $options::read).unwrap_or_default();
        )*};
    }
    read!(
        building: BuildingOptions,
        objects: ObjectsOptions,
        outputs: OutputsOptions,
        assessment: AssessmentOptions,
        worlds: WorldOptions,
        restraint: RestraintOptions
    );
    top.finish(&mut reader);
    (options, reader.problems)
}

/// How the value of a key is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Name,
    /// A name, or a pure number.
    Number,
    /// One quantity or several; if the key ends in a unit, they may be bare numbers.
    Quantity(Dimension),
    Count,
    Flag,
}

/// The value of a key as a text with its line; `None` if it is missing or was refused.
fn read_text(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
    (key, kind): (&'static str, Kind),
) -> Option<Written<String>> {
    match kind {
        Kind::Name => table.string(reader, key),
        Kind::Number => table.name_or_number(reader, key),
        Kind::Quantity(dimension) => texts(reader, table, key, dimension),
        Kind::Count => table
            .count(reader, key)
            .map(|count| count.map(|count| count.to_string())),
        Kind::Flag => table
            .boolean(reader, key)
            .map(|flag| flag.map(|flag| flag.to_string())),
    }
}

/// Reads a table within another one.
fn within<'t, 'i, T>(
    outer: &mut Section<'t, 'i>,
    reader: &mut Reader<'_>,
    key: &'static str,
    read: impl FnOnce(&mut Reader<'_>, &mut Section<'t, 'i>) -> T,
) -> Option<T> {
    let mut table = outer.table(reader, key)?;
    let found = read(reader, &mut table);
    table.finish(reader);
    Some(found)
}

/// The values of keys as texts.
fn read_words<'k>(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
    keys: impl IntoIterator<Item = &'k (&'static str, Kind)>,
) -> Words {
    let mut words = Words::default();
    add_words(reader, table, keys, &mut words);
    words
}

/// Adds the values of keys as texts.
fn add_words<'k>(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
    keys: impl IntoIterator<Item = &'k (&'static str, Kind)>,
    words: &mut Words,
) {
    for &(key, kind) in keys {
        if let Some(Written { value, line }) = read_text(reader, table, (key, kind)) {
            words.add(key, value, Some(line));
        }
    }
}

/// One quantity or a list of them, as one text with units.
fn texts(
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
        return Some(Written {
            value: texts.join(", "),
            line,
        });
    }
    let hint = format!(
        "write numbers and their units, such as {}",
        example(dimension)
    );
    reader.wrong_type(line, &name, dimension.with_article(), value, &hint);
    None
}

/// Keys of a cushion that a cushion file cannot have: the file describes one pad, so its stiffness
/// is that of the pad.
pub(crate) const NOT_IN_CUSHION_FILES: [&str; 2] = ["cushion", "pad_stiffness"];

/// Reads a cushion file, in which the keys belong to no table.
pub(crate) fn parse_cushion(text: &str, source: &Path) -> (Words, Problems) {
    let mut reader = Reader::new(text, Some(source));
    let Some(document) = reader.document(text) else {
        return (Words::default(), reader.problems);
    };
    let mut top = Section::new(Place::PlainDocument, document.get_ref(), 1);
    let options = read_words(&mut reader, &mut top, &CUSHION_KEYS);
    top.known.retain(|key| !NOT_IN_CUSHION_FILES.contains(key));
    top.finish(&mut reader);
    (options, reader.problems)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problems(text: &str) -> Vec<String> {
        let (_, problems) = parse(text, None, Some(Path::new("s.toml")));
        problems
            .problems
            .iter()
            .map(|p| format!("{p} | {}", p.hint.as_deref().unwrap_or("-")))
            .collect()
    }

    #[test]
    fn quantities_take_strings_with_units_or_keys_that_state_them() {
        let (options, problems) = parse(
            "[building]\nstorey_height_mm = 3200\nperiod = \"1.92 s\"\ndamping = \"5 %\"\n[objects]\nheights = \
             [\"0.5 m\", \"700 mm\"]\nthicknesses_mm = [200, 300.5]\nstiffness_n_mm = 4380\n",
            None,
            None,
        );
        assert!(problems.is_empty(), "{problems}");
        let building: Vec<_> = options
            .building
            .words
            .entries()
            .zip(options.building.words.lines())
            .collect();
        for ((key, text), line) in [
            ("storey_height", "3200 mm"),
            ("damping", "5 %"),
            ("period", "1.92 s"),
        ]
        .into_iter()
        .zip([2, 4, 3])
        {
            assert!(
                building.contains(&((key, text), (key, Some(line)))),
                "{building:?}"
            );
        }
        assert_eq!(options.objects.heights_m.unwrap().value, [0.5, 0.7]);
        assert_eq!(options.objects.thicknesses_m.unwrap().value, [0.2, 0.3005]);
        assert_eq!(
            options.objects.cushion.entries().next(),
            Some(("stiffness", "4380 N/mm"))
        );
    }

    #[test]
    fn a_key_with_a_unit_takes_a_number_a_list_and_a_grid() {
        for (value, expected) in [
            ("500", &[0.5][..]),
            ("\"500\"", &[0.5]),
            ("[500, 1000]", &[0.5, 1.0]),
            ("[\"500\", 1000.0]", &[0.5, 1.0]),
            ("\"500, 1000\"", &[0.5, 1.0]),
            ("\"500:1000:3\"", &[0.5, 0.75, 1.0]),
        ] {
            let (options, problems) =
                parse(&format!("[objects]\nheights_mm = {value}\n"), None, None);
            assert!(problems.is_empty(), "{problems}");
            assert_eq!(
                options.objects.heights_m.unwrap().value,
                expected,
                "{value}"
            );
        }
        assert_eq!(
            problems("[objects]\nheights_mm = \"500 mm, 1 m\"\n"),
            [
                "s.toml:2: heights_mm: \"500 mm\" is not a number | the unit is already stated (mm): write only the number"
            ]
        );
    }

    #[test]
    fn every_problem_is_reported_with_its_line() {
        let got = problems(
            "[ground]\ncout = 3\nsite = 5\n[bulding]\nstoreys = 3\n[building]\nframe = 3.2\nlevels = \
             4\n[objects]\nmass = \"3 m\"\nmass_kg = 4\ntolerance = 3.2\n",
        );
        assert_eq!(
            got,
            [
                "s.toml:3: site must be text, not 5 | write it in \"quotes\"",
                "s.toml:2: unknown key cout in [ground] | did you mean count?",
                "s.toml:7: frame must be text, not 3.2 | write it in \"quotes\"",
                "s.toml:8: levels must be a list, not 4 | write levels = [{ name = \"roof\", level_ratio = 1.0 }]",
                "s.toml:11: mass and mass_kg both state the same value | keep one of them",
                "s.toml:10: mass: \"3 m\" is a length, not a mass | known units: kg, t, lb, oz, slug, short ton",
                "s.toml:12: tolerance: \"3.2\" needs a unit | write \"3.2 g\" or \"3.2 m/s2\"",
                "s.toml:4: unknown table [bulding] | did you mean [building]?",
            ]
        );
    }

    #[test]
    fn text_that_is_not_toml_is_one_message_with_its_line() {
        let got = problems("[ground]\ncount = = 3\n");
        assert!(got[0].starts_with("s.toml:2: not TOML: "), "{got:?}");
        // One mistake gives one message: a key without a value or an incomplete table is not
        // reported in addition.
        for text in [
            "[ground]\nseed=\n",
            "[ground]\nseed = \n[objects]\nmass = 3\n",
            "[ground]\rcount = 3\r[objects]\rmass = \"150 kg\"\r",
            "[ground\ncount = \"x\"\n",
        ] {
            let got = problems(text);
            assert!(
                got.len() == 1 && got[0].contains("not TOML"),
                "{text:?}: {got:?}"
            );
        }
        assert!(problems("[ground]\rcount = 3\r")[0].contains("CR LF"));
    }
}
