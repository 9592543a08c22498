//! The codes, and which keys of a spectrum belong to each.

use freestand::code_spectrum::CodeSpectrum;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;

/// The codes by the names that people give them, in lower case and without spaces, `-` and `_`.
/// Outputs use the first.
pub(super) const CODES: [(&[&str], Code); 5] = [
    (&["as1170.4", "as1170"], Code::As1170_4),
    (&["eurocode8", "ec8", "en1998", "en19981"], Code::Eurocode8),
    (&["asce7", "asce"], Code::Asce7),
    (&["nzs1170.5", "nzs1170"], Code::Nzs1170_5),
    (&["table"], Code::Table),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Code {
    As1170_4,
    Eurocode8,
    Asce7,
    Nzs1170_5,
    Table,
}

impl Code {
    pub(super) fn parse(text: &str) -> Option<Self> {
        let plain: String = text
            .to_lowercase()
            .chars()
            .filter(|c| !c.is_whitespace() && !"-_".contains(*c))
            .collect();
        CODES
            .iter()
            .find(|(names, _)| names.contains(&plain.as_str()))
            .map(|(_, code)| *code)
    }

    pub(super) fn of(spectrum: &CodeSpectrum) -> Self {
        match spectrum {
            CodeSpectrum::As1170_4(_) => Self::As1170_4,
            CodeSpectrum::Eurocode8(_) => Self::Eurocode8,
            CodeSpectrum::Asce7(_) => Self::Asce7,
            CodeSpectrum::Nzs1170_5(_) => Self::Nzs1170_5,
            CodeSpectrum::Table(_) => Self::Table,
        }
    }

    pub(super) fn name(self) -> &'static str {
        CODES
            .iter()
            .find(|(_, code)| *code == self)
            .and_then(|(names, _)| names.first().copied())
            .unwrap_or_default()
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::As1170_4 => "AS 1170.4",
            Self::Eurocode8 => "Eurocode 8",
            Self::Asce7 => "ASCE 7",
            Self::Nzs1170_5 => "NZS 1170.5",
            Self::Table => "a user's table",
        }
    }

    /// The keys that it takes, in addition to `code`.
    pub(super) fn keys(self) -> &'static [&'static str] {
        match self {
            Self::As1170_4 => &[
                "edition",
                "site",
                "place",
                "city",
                "hazard_factor",
                "return_period_years",
            ],
            Self::Eurocode8 => &[
                "edition",
                "site",
                "place",
                "city",
                "spectrum_type",
                "ground_acceleration",
                "importance_factor",
                "soil_factor",
                "corner_periods",
            ],
            Self::Asce7 => &[
                "edition",
                "site",
                "place",
                "city",
                "sds",
                "sd1",
                "ss",
                "s1",
                "fa",
                "fv",
                "long_period",
            ],
            Self::Nzs1170_5 => &[
                "edition",
                "site",
                "place",
                "city",
                "hazard_factor",
                "return_period_years",
                "fault_distance",
            ],
            Self::Table => &["spectrum", "interpolation", "beyond"],
        }
    }
}

/// A positive value that the code requires.
pub(super) fn needed(
    reader: &mut WordReader,
    key: &'static str,
    dimension: Dimension,
    code: Code,
    example: &str,
) -> Option<f64> {
    if !reader.has(key) {
        missing(reader, key, code, example);
    }
    reader.positive(key, dimension)
}

pub(super) fn missing(reader: &mut WordReader, key: &'static str, code: Code, example: &str) {
    let message = format!("{} needs `{key}`", code.title());
    reader.missing(
        &[key, "code"],
        message,
        format!("give `{key} = \"{example}\"`"),
    );
}
