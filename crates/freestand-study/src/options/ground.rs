//! The keys of `[ground]`.

use toml::de::DeValue;

use super::point_source::PointSourceOptions;
use super::processing::processing;
use super::target::TARGET_KEYS;
use super::{Reader, Section, Written, bare_number, read_words, within};
use freestand_input::keys::Words;
use freestand_input::quantity::{Dimension, parse};

/// `[ground]`, as written. A `None` is a key that is missing or that was refused.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct GroundOptions {
    pub(crate) line: Option<usize>,
    /// The values of [`TARGET_KEYS`].
    pub(crate) target: Words,
    pub(crate) count: Option<Written<u64>>,
    pub(crate) seed: Option<Written<u64>>,
    pub(crate) point_source: Option<PointSourceOptions>,
    pub(crate) match_by: Option<Written<String>>,
    /// The folder of a suite.
    pub(crate) suite: Option<Written<String>>,
    pub(crate) suite_count: Option<Written<u64>>,
    pub(crate) suite_scale: Option<Written<String>>,
    pub(crate) motions: Option<Written<Vec<Written<String>>>>,
    pub(crate) across: Option<Written<Vec<Written<String>>>>,
    pub(crate) components: Option<Written<ComponentsOption>>,
    pub(crate) rotation_step_rad: Option<Written<f64>>,
    pub(crate) vertical: Option<Written<VerticalOption>>,
    /// The values of [`crate::recorded::MotionFiles::read`].
    pub(crate) reading: Words,
    /// The line of `processing`.
    pub(crate) processing: Option<usize>,
    /// A key was refused, so that files cannot be read as intended.
    pub(crate) is_incomplete: bool,
}

pub(super) fn ground(reader: &mut Reader<'_>, table: &mut Section) -> GroundOptions {
    let (reading, processing) = processing(reader, table);
    GroundOptions {
        line: Some(table.line),
        target: read_words(reader, table, &TARGET_KEYS),
        count: table.count(reader, "count"),
        seed: table.count(reader, "seed"),
        point_source: within(table, reader, "point_source", PointSourceOptions::read),
        match_by: table.string(reader, "match"),
        suite: table.string(reader, "suite"),
        suite_count: table.count(reader, "suite_count"),
        suite_scale: table.string(reader, "suite_scale"),
        motions: table.strings(reader, "motions"),
        across: table.strings(reader, "across"),
        components: components(reader, table),
        rotation_step_rad: table.quantity(reader, "rotation_step", Dimension::Angle),
        vertical: vertical(reader, table),
        reading,
        processing,
        is_incomplete: false,
    }
}

/// `vertical`: where the vertical motion comes from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum VerticalOption {
    /// This share of the target.
    Ratio(f64),
    /// The vertical spectrum of the code.
    Code,
    /// The vertical component of each record.
    Record,
    /// These files, one for each motion.
    Files(Vec<Written<String>>),
}

fn vertical(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
) -> Option<Written<VerticalOption>> {
    let (value, line) = table.take(reader, "vertical")?;
    let named = |word: &str| {
        value
            .as_str()
            .is_some_and(|text| text.eq_ignore_ascii_case(word))
    };
    let option = match value {
        _ if named("code") => Some(VerticalOption::Code),
        _ if named("record") => Some(VerticalOption::Record),
        DeValue::Array(items) => {
            let file = |item: &toml::Spanned<DeValue>| {
                let line = reader.line_of(item.span().start);
                item.get_ref().as_str().map(|name| Written {
                    value: name.to_owned(),
                    line,
                })
            };
            items
                .iter()
                .map(file)
                .collect::<Option<Vec<_>>>()
                .map(VerticalOption::Files)
        }
        _ => {
            let text = value
                .as_str()
                .map(str::to_owned)
                .or_else(|| bare_number(value));
            let ratio = text.and_then(|text| parse(&text, Dimension::Ratio).ok());
            ratio.map(VerticalOption::Ratio)
        }
    };
    if option.is_none() {
        let hint = "write vertical = 0.67 (a share of the target), \"code\", \"record\", or a list of files";
        reader.wrong_type(
            line,
            "vertical",
            "a ratio, \"code\", \"record\" or a list of files",
            value,
            hint,
        );
    }
    option.map(|value| Written { value, line })
}

/// `components`: both components of a file, or two by name or number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ComponentsOption {
    Both,
    Named(String, String),
}

fn components(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
) -> Option<Written<ComponentsOption>> {
    let (value, line) = table.take(reader, "components")?;
    if value
        .as_str()
        .is_some_and(|word| word.eq_ignore_ascii_case("both"))
    {
        return Some(Written {
            value: ComponentsOption::Both,
            line,
        });
    }
    let names: Vec<String> = value.as_array().map_or_else(Vec::new, |items| {
        let name = |item: &DeValue| {
            item.as_str()
                .map(str::to_owned)
                .or_else(|| bare_number(item))
        };
        items
            .iter()
            .filter_map(|item| name(item.get_ref()))
            .collect()
    });
    match <[String; 2]>::try_from(names) {
        Ok([first, second]) => Some(Written {
            value: ComponentsOption::Named(first, second),
            line,
        }),
        Err(_) => {
            let hint = "write components = \"both\", or components = [\"N-S\", \"E-W\"]";
            reader.wrong_type(line, "components", "\"both\" or two names", value, hint);
            None
        }
    }
}
