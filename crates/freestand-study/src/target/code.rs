//! The codes, and which keys of a spectrum belong to each.

use freestand::code_spectrum::CodeSpectrum;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;

/// The codes by the names that people give them, in lower case and without spaces, `-` and `_`.
/// Outputs use the first.
pub(super) const CODES: [(&[&str], Code); 8] = [
    (&["as1170.4", "as1170"], Code::As1170_4),
    (&["eurocode8", "ec8", "en1998", "en19981"], Code::Eurocode8),
    (&["asce7", "asce"], Code::Asce7),
    (&["nzs1170.5", "nzs1170"], Code::Nzs1170_5),
    (&["ntc2018", "ntc"], Code::Ntc2018),
    (&["tbdy2018", "tbdy"], Code::Tbdy2018),
    (&["ts1170.5"], Code::Ts1170_5),
    (&["table"], Code::Table),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Code {
    As1170_4,
    Eurocode8,
    Asce7,
    Nzs1170_5,
    Ntc2018,
    Tbdy2018,
    Ts1170_5,
    Table,
}

impl Code {
    pub(crate) fn parse(text: &str) -> Option<Self> {
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
            CodeSpectrum::Ntc2018(_) => Self::Ntc2018,
            CodeSpectrum::Tbdy2018(_) => Self::Tbdy2018,
            CodeSpectrum::Ts1170_5(_) => Self::Ts1170_5,
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
            Self::Ntc2018 => "NTC 2018",
            Self::Tbdy2018 => "TBDY 2018",
            Self::Ts1170_5 => "TS 1170.5",
            Self::Table => "a user's table",
        }
    }

    /// Whether the program has its clauses for parts.
    pub(super) fn has_parts(self) -> bool {
        self != Self::Table
    }

    /// The keys that it takes, in addition to `code`.
    pub(super) fn keys(self) -> Vec<&'static str> {
        /// Every code takes a place and a class of its ground.
        const PLACE: [&str; 5] = ["site", "place", "city", "latitude", "longitude"];
        let own: &[&str] = match self {
            Self::As1170_4 => &["edition", "hazard_factor", "return_period_years"],
            Self::Eurocode8 => &[
                "edition",
                "spectrum_type",
                "return_period_years",
                "ground_acceleration",
                "importance_factor",
                "soil_factor",
                "corner_periods",
            ],
            Self::Asce7 => &[
                "edition",
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
                "hazard_factor",
                "return_period_years",
                "fault_distance",
            ],
            Self::Ntc2018 => &["return_period_years", "topography"],
            Self::Tbdy2018 => &["return_period_years", "ss", "s1"],
            Self::Ts1170_5 => &["return_period_years"],
            Self::Table => return vec!["spectrum", "interpolation", "beyond"],
        };
        [&PLACE[..], own].concat()
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
