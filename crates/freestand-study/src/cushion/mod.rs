//! What stands under one edge of an object, from the words of flags, studies and cushion files to a
//! [`Cushion`].
//!
//! A drop test is of one pad, the impact model asks for all that is under one edge: `pads_per_edge` joins the two, and
//! every step from the one to the other is said in words.

mod file;

use freestand::cushion::{ContactLaw, Cushion, CushionError};
use freestand_input::keys::KeyStyle;

pub use file::read_cushion_file;

use crate::law::contact_law_stiffness;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, format_si, parse, parse_grid, parse_non_negative, parse_positive, shorten};
use freestand_input::words::number;

/// Exponent of a sphere on a thick pad (Hertz).
pub const HERTZ_EXPONENT: f64 = 1.5;

/// Why an object has no shock although it stays upright.
pub const BOTTOMED: &str = "the cushion bottoms: its law gives no shock to rely on";

/// The words that describe a cushion; the same in flags (`--pad-stiffness`) and in files (`pad_stiffness`).
pub const CUSHION_KEYS: [&str; 13] = [
    "law",
    "stiffness",
    "pad_stiffness",
    "pads_per_edge",
    "series_stiffness",
    "exponent",
    "damping",
    "dissipation",
    "bottoming",
    "compressions",
    "forces",
    "pad_thickness",
    "cushion",
];

/// What stands under one edge, as written: values with their units, by [`CUSHION_KEYS`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CushionWords {
    style: KeyStyle,
    entries: Vec<(&'static str, String)>,
}

/// What stands under one edge.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeCushion {
    /// All of it.
    pub cushion: Cushion,
    /// Thickness of the pad, for the guards \[m\].
    pub pad_thickness_m: Option<f64>,
    /// How the input was read: pads to an edge, layers in series, damping from its ratio.
    pub notes: Vec<String>,
}

/// What is wrong, and with which of [`CUSHION_KEYS`].
pub type KeyProblem = (&'static str, Problem);

impl CushionWords {
    /// No words yet.
    pub fn new(style: KeyStyle) -> Self {
        Self { style, entries: Vec::new() }
    }

    /// F = k d with k in N/m, all under one edge.
    pub fn spring(stiffness_n_m: f64) -> Self {
        let mut words = Self::default();
        words.set("stiffness", format!("{stiffness_n_m} N/m"));
        words
    }

    /// Adds a word, or puts it in place of what was said before; `series_stiffness` may come several times.
    pub fn set(&mut self, key: &'static str, text: impl Into<String>) {
        if key != "series_stiffness" {
            self.entries.retain(|(name, _)| *name != key);
        }
        self.entries.push((key, text.into()));
    }

    /// Takes a word back.
    pub fn remove(&mut self, key: &str) {
        self.entries.retain(|(name, _)| *name != key);
    }

    /// Whether nothing was said.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// What was said, in order.
    pub fn entries(&self) -> &[(&'static str, String)] {
        &self.entries
    }

    /// A word.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.entries.iter().find(|(name, _)| *name == key).map(|(_, text)| text.as_str())
    }

    /// A key as the user writes it.
    pub fn name(&self, key: &str) -> String {
        match self.style {
            KeyStyle::File => key.to_owned(),
            KeyStyle::Flag => format!("--{}", key.replace('_', "-")),
        }
    }

    /// The cushion under an edge that carries an object of `mass_kg`, which a damping *ratio* ζ is of: c = 2ζ√(k m).
    ///
    /// # Errors
    /// Everything that is wrong, each with its key.
    pub fn resolve(&self, mass_kg: Option<f64>) -> Result<EdgeCushion, Vec<KeyProblem>> {
        let mut reader = Reader { words: self, problems: Vec::new(), notes: Vec::new() };
        let cushion = reader.cushion(mass_kg);
        let pad_thickness_m = reader.positive("pad_thickness", Dimension::Length);
        match cushion {
            Some(cushion) if reader.problems.is_empty() => {
                Ok(EdgeCushion { cushion, pad_thickness_m, notes: reader.notes })
            }
            _ => Err(reader.problems),
        }
    }
}

/// The laws by the names that people give them.
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

/// The words that only some laws take.
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
    words: &'w CushionWords,
    problems: Vec<KeyProblem>,
    notes: Vec<String>,
}

impl Reader<'_> {
    fn note(&mut self, key: &'static str, message: impl Into<String>, hint: impl Into<String>) {
        self.problems.push((key, Problem::new(ProblemKind::Value, message).hint(hint)));
    }

    fn keep<T>(&mut self, key: &'static str, result: Result<T, Problem>) -> Option<T> {
        result
            .map_err(|mut problem| {
                problem.message = format!("{}: {}", self.words.name(key), problem.message);
                self.problems.push((key, problem));
            })
            .ok()
    }

    fn positive(&mut self, key: &'static str, dimension: Dimension) -> Option<f64> {
        let result = parse_positive(self.words.get(key)?, dimension, "the value");
        self.keep(key, result)
    }

    fn law(&mut self) -> Option<LawName> {
        let Some(text) = self.words.get("law") else { return Some(LawName::Linear) };
        let name = text.trim().to_lowercase().replace(['_', ' '], "-");
        if let Some((_, law)) = LAWS.iter().find(|(known, _)| *known == name) {
            return Some(*law);
        }
        let names: Vec<&str> = LAWS.iter().map(|(name, _)| *name).collect();
        let message = format!("{}: \"{}\" is not a contact law", self.words.name("law"), shorten(text));
        self.note("law", message, format!("one of {}", names.join(", ")));
        None
    }

    fn cushion(&mut self, mass_kg: Option<f64>) -> Option<Cushion> {
        let law = self.law()?;
        for (key, _) in &self.words.entries {
            if !belongs(key, law) {
                let name = LAWS.iter().find(|(_, other)| *other == law).map_or("", |(name, _)| name);
                let hint = format!("name the law that has it with {}", self.words.name("law"));
                self.note(key, format!("{} is no part of a {name} law", self.words.name(key)), hint);
            }
        }
        let exponent = self.exponent(law)?;
        let pads = self.pads(law);
        let elastic = self.elastic(law, exponent)?;
        let edge = self.edge(elastic, pads?)?;
        let damped = self.damped(law, edge, pads?, mass_kg)?;
        self.in_series(damped)
    }

    fn exponent(&mut self, law: LawName) -> Option<f64> {
        if !belongs("exponent", law) {
            return Some(1.0);
        }
        if self.words.get("exponent").is_some() {
            return self.positive("exponent", Dimension::Ratio);
        }
        self.notes.push(format!("the exponent of the law is not given: {HERTZ_EXPONENT}, as of a sphere (Hertz)"));
        Some(HERTZ_EXPONENT)
    }

    /// How many pads share the landing of an edge; `None` within: what is given is the edge.
    fn pads(&mut self, law: LawName) -> Option<Option<u32>> {
        let (edge, pad) = (self.words.name("stiffness"), self.words.name("pad_stiffness"));
        let key = "pads_per_edge";
        let is_pad = self.words.get("pad_stiffness").is_some();
        if is_pad && self.words.get("stiffness").is_some() {
            self.note("stiffness", format!("{edge} and {pad} exclude each other"), "keep one of them");
            return None;
        }
        let hint = "how many pads share the landing of one edge? A cabinet on four feet has 2";
        match self.words.get(key).map(str::trim) {
            None if is_pad => {
                self.note(key, format!("{pad} needs {}, at least 1", self.words.name(key)), hint);
                None
            }
            None => Some(None),
            Some(_) if !is_pad && law != LawName::Tabulated => {
                let message = format!("{} goes with {pad}", self.words.name(key));
                self.note(key, message, format!("{edge} is already that of all the pads under one edge"));
                None
            }
            Some(text) => match text.parse::<u32>() {
                Ok(pads) if pads > 0 => Some(Some(pads)),
                _ => {
                    self.note(key, format!("{} must be a whole number, at least 1", self.words.name(key)), hint);
                    None
                }
            },
        }
    }

    /// The law of the edge or of one pad, without its damping.
    fn elastic(&mut self, law: LawName, exponent: f64) -> Option<Cushion> {
        if law == LawName::Tabulated {
            return self.tabulated();
        }
        let key = if self.words.get("pad_stiffness").is_some() { "pad_stiffness" } else { "stiffness" };
        let Some(text) = self.words.get(key) else {
            let message = "the stiffness of the cushion is missing";
            let (edge, pad) = (self.words.name("stiffness"), self.words.name("pad_stiffness"));
            let pads = self.words.name("pads_per_edge");
            self.note(key, message, format!("give {edge} (all the cushion under one edge) or {pad} with {pads}"));
            return None;
        };
        let (stiffness, note) = self.keep(key, contact_law_stiffness(text, exponent))?;
        self.notes.extend(note);
        let contact_law = match law {
            LawName::Linear | LawName::KelvinVoigt | LawName::Tabulated => {
                ContactLaw::Linear { stiffness_n_m: stiffness }
            }
            LawName::Power => ContactLaw::Power { coefficient_n_mn: stiffness, exponent },
            LawName::HuntCrossley => {
                let Some(text) = self.words.get("dissipation") else {
                    let hint = format!("Λ of F = K dⁿ(1 + Λḋ), such as {} \"0.3 s/m\"", self.words.name("dissipation"));
                    self.note("dissipation", "a hunt-crossley law needs its dissipation", hint);
                    return None;
                };
                let result = parse_non_negative(text, Dimension::Dissipation, "the value");
                let dissipation_s_m = self.keep("dissipation", result)?;
                ContactLaw::HuntCrossley { coefficient_n_mn: stiffness, exponent, dissipation_s_m }
            }
            LawName::Tangent => {
                if self.words.get("bottoming").is_none() {
                    let hint =
                        format!("the compression at which it ends, such as {} 12mm", self.words.name("bottoming"));
                    self.note("bottoming", "a tangent law needs the compression at which it bottoms", hint);
                    return None;
                }
                let bottoming_m = self.positive("bottoming", Dimension::Length)?;
                ContactLaw::Tangent { stiffness_n_m: stiffness, bottoming_m }
            }
        };
        self.made(key, Cushion::new(contact_law))
    }

    fn tabulated(&mut self) -> Option<Cushion> {
        let (Some(compressions), Some(forces)) = (self.words.get("compressions"), self.words.get("forces")) else {
            let hint = "compressions = [\"0 mm\", \"1 mm\"] and forces = [\"0 N\", \"900 N\"] in a cushion file";
            self.note("compressions", "a tabulated law needs its compressions and forces", hint);
            return None;
        };
        let compressions_m = self.keep("compressions", parse_grid(compressions, Dimension::Length));
        let forces_n = self.keep("forces", parse_grid(forces, Dimension::Force));
        let law = ContactLaw::Tabulated { compressions_m: compressions_m?, forces_n: forces_n? };
        self.made("compressions", Cushion::new(law))
    }

    fn edge(&mut self, pad: Cushion, pads: Option<u32>) -> Option<Cushion> {
        let Some(count) = pads else { return Some(pad) };
        let edge = pad.side_by_side(count);
        let plural = if count == 1 { "pad" } else { "pads" };
        self.notes.push(format!("{count} {plural} of {} → edge {}", cushion_words(&pad), cushion_words(&edge)));
        Some(edge)
    }

    /// Kelvin–Voigt on the stiffness of the edge; its c is that of a pad where the stiffness is.
    fn damped(&mut self, law: LawName, edge: Cushion, pads: Option<u32>, mass_kg: Option<f64>) -> Option<Cushion> {
        let (LawName::KelvinVoigt, Some(stiffness_n_m)) = (law, edge.linear_stiffness_n_m()) else { return Some(edge) };
        let Some(text) = self.words.get("damping") else {
            let hint = format!("such as {} 5% or \"300 N s/m\"", self.words.name("damping"));
            self.note("damping", "a kelvin-voigt law needs its damping", hint);
            return None;
        };
        let damping_n_s_m = if let Ok(ratio) = parse(text, Dimension::Ratio) {
            let ratio = self.keep("damping", not_negative(ratio, text))?;
            let Some(mass_kg) = mass_kg else {
                let hint = "give the mass, or the damping of the pad such as \"300 N s/m\"";
                self.note("damping", "a damping ratio needs the mass that it is of", hint);
                return None;
            };
            let damping_n_s_m = 2.0 * ratio * (stiffness_n_m * mass_kg).sqrt();
            self.notes.push(format!(
                "damping of {} % of {} → {} under the edge",
                number(100.0 * ratio, 4),
                format_si(mass_kg, Dimension::Mass),
                format_si(damping_n_s_m, Dimension::Damping)
            ));
            damping_n_s_m
        } else {
            let result = parse_non_negative(text, Dimension::Damping, "the value");
            self.keep("damping", result)? * f64::from(pads.unwrap_or(1))
        };
        self.made("damping", Cushion::new(ContactLaw::KelvinVoigt { stiffness_n_m, damping_n_s_m }))
    }

    fn in_series(&mut self, edge: Cushion) -> Option<Cushion> {
        let texts: Vec<&String> =
            self.words.entries.iter().filter(|(key, _)| *key == "series_stiffness").map(|(_, text)| text).collect();
        if texts.is_empty() {
            return Some(edge);
        }
        let mut layers = vec![edge];
        for text in texts {
            for part in text.split(',') {
                let result = parse_positive(part, Dimension::Stiffness, "the value");
                let stiffness_n_m = self.keep("series_stiffness", result)?;
                layers.push(self.made("series_stiffness", Cushion::linear(stiffness_n_m))?);
            }
        }
        let whole = self.made("series_stiffness", Cushion::in_series(&layers))?;
        let parts: Vec<String> = layers.iter().map(cushion_words).collect();
        let sum = if whole.linear_stiffness_n_m().is_some() { cushion_words(&whole) } else { "one law".to_owned() };
        self.notes.push(format!("{} in series → {sum}", parts.join(" and ")));
        Some(whole)
    }

    fn made(&mut self, key: &'static str, result: Result<Cushion, CushionError>) -> Option<Cushion> {
        let hint = match result {
            Err(CushionError::DampedSeries { .. }) => {
                "give the damped law of all that is under the edge, measured as one"
            }
            _ => "check the numbers of the cushion",
        };
        self.keep(key, result.map_err(|error| Problem::new(ProblemKind::Value, error.to_string()).hint(hint)))
    }
}

fn not_negative(value: f64, text: &str) -> Result<f64, Problem> {
    if value >= 0.0 {
        return Ok(value);
    }
    Err(Problem::new(ProblemKind::Value, format!("the value must not be negative: \"{}\"", shorten(text))))
}

/// A cushion in a few words: `4380 N/mm`, `K = 2e7 N/m^1.5`, `1000 N/mm, bottoming at 12 mm`.
pub fn cushion_words(cushion: &Cushion) -> String {
    law_words(cushion.law())
}

fn law_words(law: &ContactLaw) -> String {
    let stiffness = |k: f64| format_si(k, Dimension::Stiffness);
    let power = |k: f64, n: f64| format!("{} N/m^{}", number(k, 5), number(n, 5));
    match law {
        ContactLaw::Linear { stiffness_n_m } => stiffness(*stiffness_n_m),
        ContactLaw::Power { coefficient_n_mn, exponent } => power(*coefficient_n_mn, *exponent),
        ContactLaw::KelvinVoigt { stiffness_n_m, damping_n_s_m } => {
            format!("{} with {}", stiffness(*stiffness_n_m), format_si(*damping_n_s_m, Dimension::Damping))
        }
        ContactLaw::HuntCrossley { coefficient_n_mn, exponent, dissipation_s_m } => {
            let law = power(*coefficient_n_mn, *exponent);
            format!("{law} with {}", format_si(*dissipation_s_m, Dimension::Dissipation))
        }
        ContactLaw::Tangent { stiffness_n_m, bottoming_m } => {
            format!("{} bottoming at {}", stiffness(*stiffness_n_m), format_si(*bottoming_m, Dimension::Length))
        }
        ContactLaw::Tabulated { compressions_m, forces_n } => {
            let end = compressions_m.last().zip(forces_n.last());
            let (d, f) = end.map_or((0.0, 0.0), |(d, f)| (*d, *f));
            let (d, f) = (format_si(d, Dimension::Length), format_si(f, Dimension::Force));
            format!("a table of {} points to {d} and {f}", compressions_m.len())
        }
        ContactLaw::Series { parts } => parts.iter().map(law_words).collect::<Vec<_>>().join(" in series with "),
    }
}

#[cfg(test)]
mod tests;
