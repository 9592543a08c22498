//! The keys of `[building]`.

use toml::de::DeValue;

use super::Kind::{self, Count, Name, Number, Quantity};
use super::{Place, Reader, Section, Written, read_words, within};
use crate::building::axis_key;
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

options! {
    /// `[building]`, as written.
    BuildingOptions(reader, table) {
        /// The values of [`crate::building::resolve`]. The key `across` stands for its table.
        words: (Words) = words(reader, table);
        name: string;
        first_floor: string;
        period_measured: boolean;
        vertical_amplification: ratio;
        levels: (Option<Written<Vec<LevelOptions>>>) = levels(reader, table);
        /// Floors by the names that lists of objects use.
        floors: (Option<Written<Vec<FloorOptions>>>) = floors(reader, table);
    }
}

options! {
    /// One entry of `floors`.
    FloorOptions(reader, table) {
        line: (usize) = table.line;
        aliases: (Vec<String>) = table
            .strings(reader, "aliases")
            .into_iter()
            .flat_map(|aliases| aliases.value)
            .map(|alias| alias.value)
            .collect();
        name: string;
        /// \[m\]
        elevation: [quantity "elevation" Length];
    }
}

options! {
    /// One entry of `levels`.
    LevelOptions(reader, table) {
        line: (usize) = table.line;
        name: string;
        level_ratio: ratio;
        motions: strings;
        across: strings;
    }
}

const STOREY_KEYS: [(&str, Kind); 4] = [
    ("storeys", Count),
    ("storey_height", Quantity(Dimension::Length)),
    ("height", Quantity(Dimension::Length)),
    ("period_code", Name),
];

const AXIS_KEYS: [(&str, Kind); 8] = [
    ("frame", Name),
    ("period", Quantity(Dimension::Time)),
    ("damping", Number),
    ("rayleigh_modes", Quantity(Dimension::Ratio)),
    ("shear_flexure", Number),
    ("modes", Count),
    ("storey_table", Name),
    ("mode_table", Name),
];

/// The values of [`crate::building::resolve`].
fn words(reader: &mut Reader, table: &mut Section) -> Words {
    let mut words = read_words(reader, table, STOREY_KEYS.iter().chain(&AXIS_KEYS));
    let across = within(table, reader, "across", |reader, across| {
        (across.line, read_words(reader, across, &AXIS_KEYS))
    });
    if let Some((line, across)) = across {
        words.add("across", "", Some(line));
        for (key, _) in AXIS_KEYS {
            if let Some(text) = across.get(key) {
                words.add(axis_key(key, 1), text, across.line_of(&[key]));
            }
        }
    }
    words
}

/// The entries of a list of tables, each with its line.
fn entries<'t, 'i>(
    reader: &mut Reader,
    table: &mut Section<'t, 'i>,
    key: &'static str,
    hint: &str,
) -> Option<Written<Vec<(&'t DeValue<'i>, usize)>>> {
    let (value, line) = table.take(reader, key)?;
    let DeValue::Array(items) = value else {
        reader.wrong_type(line, key, "a list", value, hint);
        return None;
    };
    let value = items
        .iter()
        .map(|item| (item.get_ref(), reader.line_of(item.span().start)))
        .collect();
    Some(Written { value, line })
}

fn floors(reader: &mut Reader, table: &mut Section) -> Option<Written<Vec<FloorOptions>>> {
    let hint = "write floors = [{ name = \"Lobby\", aliases = [\"G\"], elevation = \"0 m\" }, …]";
    let found = entries(reader, table, "floors", hint)?;
    let mut floors = Vec::new();
    for (value, line) in found.value {
        let DeValue::Table(entries) = value else {
            reader.wrong_type(line, "floors", "a list of tables", value, hint);
            continue;
        };
        let mut entry = Section::new(Place::Table("floors"), entries, line);
        floors.push(FloorOptions::read(reader, &mut entry));
        entry.finish(reader);
    }
    Some(Written {
        value: floors,
        line: found.line,
    })
}

fn levels(reader: &mut Reader, table: &mut Section) -> Option<Written<Vec<LevelOptions>>> {
    let hint = "write levels = [{ name = \"roof\", level_ratio = 1.0 }]";
    let found = entries(reader, table, "levels", hint)?;
    let mut level = |(value, line): (&DeValue, usize)| match value {
        DeValue::Table(entries) => {
            let mut entry = Section::new(Place::Table("levels"), entries, line);
            let level = LevelOptions::read(reader, &mut entry);
            entry.finish(reader);
            level
        }
        value => LevelOptions {
            line,
            level_ratio: reader.ratio_value("levels", value, line),
            ..LevelOptions::default()
        },
    };
    Some(Written {
        value: found.value.into_iter().map(&mut level).collect(),
        line: found.line,
    })
}
