//! The cushion under one edge of an object: from the words of flags, studies and cushion files to a
//! [`Cushion`].
//!
//! A drop test is of one pad; the impact model needs all that is under one edge. `pads_per_edge`
//! connects the two, and every step from one to the other is stated in a note.

mod file;
mod note;

use freestand::cushion::{ContactLaw, Cushion, CushionError};
use freestand::impact::{ValidityWarning, compression_warnings, stiffness_warnings};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, format_si, parse, parse_positive};
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;
use serde::{Deserialize, Serialize};

use crate::law::contact_law_stiffness;

pub use file::{pad_words, read_cushion_file, with_file};
pub use note::CushionNote;

/// Exponent of a sphere on a thick pad (Hertz).
pub const HERTZ_EXPONENT: f64 = 1.5;

/// Why an object that does not overturn has no shock.
pub const BOTTOMED: &str = "the cushion bottoms, so that its law gives no reliable shock";

/// The cushion under one edge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgeCushion {
    /// The cushion itself.
    pub cushion: Cushion,
    /// Thickness of the pad, for the warnings \[m\].
    pub pad_thickness_m: Option<f64>,
    /// How the input was read: pads under an edge, layers in series, damping from its ratio.
    pub notes: Vec<CushionNote>,
}

impl EdgeCushion {
    /// What is doubtful about its stiffness under a mass.
    pub fn stiffness_doubts(&self, mass_kg: f64) -> Vec<ValidityWarning> {
        stiffness_warnings(mass_kg, &self.cushion, self.pad_thickness_m)
    }

    /// What is doubtful about a compression.
    pub fn compression_doubts(&self, compression_m: f64) -> Vec<ValidityWarning> {
        compression_warnings(compression_m, &self.cushion, self.pad_thickness_m)
    }
}

/// A linear cushion F = k d, with k in N/m of everything under one edge, and with the layers in series that
/// words with the key `series_stiffness` describe.
///
/// # Errors
/// A stiffness that is not positive, or that cannot be read.
pub fn linear(stiffness_n_m: f64, layers: &Words) -> Result<EdgeCushion, Problems> {
    let mut reader = Reader::new(layers);
    let edge = reader.made("stiffness", Cushion::linear(stiffness_n_m));
    let cushion = edge.and_then(|edge| reader.in_series(edge));
    reader.finish(cushion, None)
}

/// The words of a linear cushion F = k d, with k in N/m of everything under one edge.
pub fn spring(stiffness_n_m: f64) -> Words {
    Words::from_iter([("stiffness", format!("{stiffness_n_m} N/m"))])
}

/// The cushion that words with the keys of a cushion describe, under an edge of an object of `mass_kg`;
/// a damping *ratio* ζ refers to that mass: c = 2ζ√(k m).
///
/// # Errors
/// Everything that is wrong, each problem with its key.
pub fn resolve(words: &Words, mass_kg: Option<f64>) -> Result<EdgeCushion, Problems> {
    let mut reader = Reader::new(words);
    let cushion = reader.cushion(mass_kg);
    let pad_thickness_m = reader.words.positive("pad_thickness", Dimension::Length);
    reader.finish(cushion, pad_thickness_m)
}

/// The contact laws that a user can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LawName {
    Linear,
    Power,
    KelvinVoigt,
    HuntCrossley,
    Tangent,
    Tabulated,
}

const LAWS: [(&str, LawName); 7] = [
    ("linear", LawName::Linear),
    ("power", LawName::Power),
    ("hertz", LawName::Power),
    ("kelvin-voigt", LawName::KelvinVoigt),
    ("hunt-crossley", LawName::HuntCrossley),
    ("tangent", LawName::Tangent),
    ("tabulated", LawName::Tabulated),
];

/// Whether a law takes a key.
fn belongs(key: &str, law: LawName) -> bool {
    match key {
        "exponent" => matches!(law, LawName::Power | LawName::HuntCrossley),
        "damping" => law == LawName::KelvinVoigt,
        "dissipation" => law == LawName::HuntCrossley,
        "bottoming" => law == LawName::Tangent,
        "compressions" | "forces" => law == LawName::Tabulated,
        "stiffness" | "pad_stiffness" => law != LawName::Tabulated,
        _ => true,
    }
}

struct Reader<'w> {
    words: WordReader<'w>,
    notes: Vec<CushionNote>,
}

impl<'w> Reader<'w> {
    fn new(words: &'w Words) -> Self {
        Self {
            words: WordReader::new(words),
            notes: Vec::new(),
        }
    }

    fn finish(
        self,
        cushion: Option<Cushion>,
        pad_thickness_m: Option<f64>,
    ) -> Result<EdgeCushion, Problems> {
        let Self { words, notes } = self;
        words.problems.finish(cushion.map(|cushion| EdgeCushion {
            cushion,
            pad_thickness_m,
            notes,
        }))
    }

    fn cushion(&mut self, mass_kg: Option<f64>) -> Option<Cushion> {
        let law = if self.words.has("law") {
            self.words.one_of("law", self.laws())?
        } else {
            LawName::Linear
        };
        let name = LAWS
            .iter()
            .find(|(_, other)| *other == law)
            .map_or("", |(name, _)| name);
        for (key, _) in self
            .words
            .words
            .entries()
            .filter(|(key, _)| !belongs(key, law))
        {
            self.words.note(
                &[key],
                format!("`{key}` is not part of a {name} law"),
                "delete it, or choose a law that uses it with `law`",
            );
        }
        let exponent = self.exponent(law)?;
        let pads = self.pads(law);
        let elastic = self.elastic(law, exponent)?;
        let edge = self.edge(elastic, pads?)?;
        let damped = self.damped(law, edge, pads?, mass_kg)?;
        self.in_series(damped)
    }

    /// The laws that may be meant: one of a table is written in files alone, with its table.
    fn laws(&self) -> &'static [(&'static str, LawName)] {
        let has_table = ["compressions", "forces"]
            .iter()
            .any(|key| self.words.has(key));
        let is_table = |text: &str| text.trim().eq_ignore_ascii_case("tabulated");
        match has_table || self.words.words.get("law").is_some_and(is_table) {
            true => &LAWS,
            false => LAWS.get(..LAWS.len() - 1).unwrap_or(&LAWS),
        }
    }

    fn exponent(&mut self, law: LawName) -> Option<f64> {
        if !belongs("exponent", law) {
            return Some(1.0);
        }
        if self.words.has("exponent") {
            return self.words.positive("exponent", Dimension::Ratio);
        }
        self.notes.push(CushionNote::HertzExponent);
        Some(HERTZ_EXPONENT)
    }

    /// The number of pads under an edge; the inner `None`: the values are those of the whole edge.
    fn pads(&mut self, law: LawName) -> Option<Option<u32>> {
        const KEY: &str = "pads_per_edge";
        let is_pad = self.words.has("pad_stiffness");
        if is_pad && self.words.has("stiffness") {
            self.words.note(
                &["stiffness"],
                "`stiffness` and `pad_stiffness` exclude each other",
                "keep one of them",
            );
            return None;
        }
        let hint = "give the number of pads that share the landing of one edge: a cabinet on four feet has 2";
        match self.words.words.get(KEY).map(str::trim) {
            None if is_pad => {
                self.words.note(
                    &[KEY],
                    "`pad_stiffness` needs `pads_per_edge`, at least 1",
                    hint,
                );
                None
            }
            None => Some(None),
            Some(_) if !is_pad && law != LawName::Tabulated => {
                let hint = "`stiffness` already includes all the pads under one edge";
                self.words
                    .note(&[KEY], "`pads_per_edge` needs `pad_stiffness`", hint);
                None
            }
            Some(text) => {
                let pads = text.parse::<u32>().ok().filter(|&pads| pads > 0);
                if pads.is_none() {
                    self.words.note(
                        &[KEY],
                        "`pads_per_edge` must be a whole number, at least 1",
                        hint,
                    );
                }
                pads.map(Some)
            }
        }
    }

    /// The law of the edge or of one pad, without its damping.
    fn elastic(&mut self, law: LawName, exponent: f64) -> Option<Cushion> {
        if law == LawName::Tabulated {
            return self.tabulated();
        }
        let key = if self.words.has("pad_stiffness") {
            "pad_stiffness"
        } else {
            "stiffness"
        };
        let Some(text) = self.words.words.get(key) else {
            let hint = "give `stiffness` (all the cushion under one edge), or `pad_stiffness` with `pads_per_edge`";
            self.words
                .note(&[key], "the stiffness of the cushion is missing", hint);
            return None;
        };
        let (stiffness, secant) = self
            .words
            .keep(key, contact_law_stiffness(text, exponent))?;
        self.notes.extend(secant.map(CushionNote::Secant));
        let contact_law = match law {
            LawName::Linear | LawName::KelvinVoigt | LawName::Tabulated => ContactLaw::Linear {
                stiffness_n_m: stiffness,
            },
            LawName::Power => ContactLaw::Power {
                coefficient_n_mn: stiffness,
                exponent,
            },
            LawName::HuntCrossley => {
                self.required(
                    "dissipation",
                    "a hunt-crossley law",
                    "Λ of F = K dⁿ(1 + Λḋ), such as",
                    "0.3 s/m",
                )?;
                let dissipation_s_m = self
                    .words
                    .non_negative("dissipation", Dimension::Dissipation)?;
                ContactLaw::HuntCrossley {
                    coefficient_n_mn: stiffness,
                    exponent,
                    dissipation_s_m,
                }
            }
            LawName::Tangent => {
                self.required(
                    "bottoming",
                    "a tangent law",
                    "the compression at which it bottoms, such as",
                    "12 mm",
                )?;
                let bottoming_m = self.words.positive("bottoming", Dimension::Length)?;
                ContactLaw::Tangent {
                    stiffness_n_m: stiffness,
                    bottoming_m,
                }
            }
        };
        self.made(key, Cushion::new(contact_law))
    }

    /// Notes that a law lacks a key.
    fn required(&mut self, key: &'static str, law: &str, what: &str, example: &str) -> Option<()> {
        if self.words.has(key) {
            return Some(());
        }
        self.words.note(
            &[key],
            format!("{law} needs `{key}`"),
            format!("give {what} `{key} = \"{example}\"`"),
        );
        None
    }

    fn tabulated(&mut self) -> Option<Cushion> {
        if !(self.words.has("compressions") && self.words.has("forces")) {
            let hint = "in a cushion file write compressions = [\"0 mm\", \"1 mm\"] and forces = [\"0 N\", \"900 N\"], and give `cushion = \"pad.toml\"`";
            self.words.note(
                &["compressions"],
                "a tabulated law needs the table of a cushion file: compressions and forces",
                hint,
            );
            return None;
        }
        let compressions_m = self.words.grid("compressions", Dimension::Length);
        let forces_n = self.words.grid("forces", Dimension::Force);
        let law = ContactLaw::Tabulated {
            compressions_m: compressions_m?,
            forces_n: forces_n?,
        };
        self.made("compressions", Cushion::new(law))
    }

    fn edge(&mut self, pad: Cushion, pads: Option<u32>) -> Option<Cushion> {
        let Some(count) = pads else { return Some(pad) };
        let edge = pad.side_by_side(count);
        self.notes.push(CushionNote::Pads {
            count,
            pad,
            edge: edge.clone(),
        });
        Some(edge)
    }

    /// Kelvin–Voigt with the stiffness of the edge; c is that of a pad if the stiffness is.
    fn damped(
        &mut self,
        law: LawName,
        edge: Cushion,
        pads: Option<u32>,
        mass_kg: Option<f64>,
    ) -> Option<Cushion> {
        const KEY: &str = "damping";
        let (LawName::KelvinVoigt, Some(stiffness_n_m)) = (law, edge.linear_stiffness_n_m()) else {
            return Some(edge);
        };
        self.required(
            KEY,
            "a kelvin-voigt law",
            "a value such as \"300 N s/m\", or a ratio such as",
            "5 %",
        )?;
        let text = self.words.words.get(KEY)?;
        let damping_n_s_m = if parse(text, Dimension::Ratio).is_ok() {
            let ratio = self.words.non_negative(KEY, Dimension::Ratio)?;
            let Some(mass_kg) = mass_kg else {
                let hint = "give the mass, or the damping of the pad such as \"300 N s/m\"";
                self.words.note(
                    &[KEY],
                    "a damping ratio needs the mass that it refers to",
                    hint,
                );
                return None;
            };
            let damping_n_s_m = 2.0 * ratio * (stiffness_n_m * mass_kg).sqrt();
            self.notes.push(CushionNote::DampingRatio {
                ratio,
                mass_kg,
                damping_n_s_m,
            });
            damping_n_s_m
        } else {
            self.words.non_negative(KEY, Dimension::Damping)? * f64::from(pads.unwrap_or(1))
        };
        self.made(
            KEY,
            Cushion::new(ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            }),
        )
    }

    fn in_series(&mut self, edge: Cushion) -> Option<Cushion> {
        const KEY: &str = "series_stiffness";
        let texts: Vec<&str> = self
            .words
            .words
            .all(KEY)
            .flat_map(|text| text.split(','))
            .collect();
        if texts.is_empty() {
            return Some(edge);
        }
        let mut layers = vec![edge];
        for text in texts {
            let result = parse_positive(text, Dimension::Stiffness, "the value");
            let stiffness_n_m = self.words.keep(KEY, result)?;
            layers.push(self.made(KEY, Cushion::linear(stiffness_n_m))?);
        }
        let whole = self.made(KEY, Cushion::in_series(&layers))?;
        self.notes.push(CushionNote::InSeries {
            layers,
            whole: whole.clone(),
        });
        Some(whole)
    }

    fn made(
        &mut self,
        key: &'static str,
        result: Result<Cushion, CushionError>,
    ) -> Option<Cushion> {
        let hint = match result {
            Err(CushionError::DampedSeries { .. }) => {
                "give one damped law, measured on everything that is under the edge"
            }
            _ => "check the numbers of the cushion",
        };
        self.words.keep(
            key,
            result.map_err(|error| Problem::value(error.to_string(), hint)),
        )
    }
}

/// A cushion in a few words: `4380 N/mm`, `K = 2e7 N/m^1.5`, `1000 N/mm bottoming at 12 mm`.
pub fn cushion_words(cushion: &Cushion) -> String {
    law_words(cushion.law())
}

fn law_words(law: &ContactLaw) -> String {
    let stiffness = |k: f64| format_si(k, Dimension::Stiffness);
    let power = |k: f64, n: f64| format!("{} N/m^{}", number(k, 5), number(n, 5));
    match law {
        ContactLaw::Linear { stiffness_n_m } => stiffness(*stiffness_n_m),
        ContactLaw::Power {
            coefficient_n_mn,
            exponent,
        } => power(*coefficient_n_mn, *exponent),
        ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        } => {
            format!(
                "{} with {}",
                stiffness(*stiffness_n_m),
                format_si(*damping_n_s_m, Dimension::Damping)
            )
        }
        ContactLaw::HuntCrossley {
            coefficient_n_mn,
            exponent,
            dissipation_s_m,
        } => {
            let law = power(*coefficient_n_mn, *exponent);
            format!(
                "{law} with {}",
                format_si(*dissipation_s_m, Dimension::Dissipation)
            )
        }
        ContactLaw::Tangent {
            stiffness_n_m,
            bottoming_m,
        } => {
            format!(
                "{} bottoming at {}",
                stiffness(*stiffness_n_m),
                format_si(*bottoming_m, Dimension::Length)
            )
        }
        ContactLaw::Tabulated {
            compressions_m,
            forces_n,
        } => {
            let end = compressions_m.last().zip(forces_n.last());
            let (d, f) = end.map_or((0.0, 0.0), |(d, f)| (*d, *f));
            let (d, f) = (
                format_si(d, Dimension::Length),
                format_si(f, Dimension::Force),
            );
            format!(
                "a table of {} points up to {d} and {f}",
                compressions_m.len()
            )
        }
        ContactLaw::Series { parts } => parts
            .iter()
            .map(law_words)
            .collect::<Vec<_>>()
            .join(" in series with "),
    }
}

#[cfg(test)]
mod tests;
