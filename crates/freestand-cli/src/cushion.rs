//! Flags that describe what stands under one edge.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::keys::KeyStyle;
use freestand_study::cushion::{CushionWords, EdgeCushion, read_cushion_file};

use crate::failure::Failure;
use crate::keys::{Key, KeySet, Keys, key, list};
use crate::values::Values;

#[derive(Debug, Args)]
pub(crate) struct CushionArgs {
    #[command(flatten)]
    keys: Keys<CushionKeys>,
}

#[derive(Debug, Clone)]
struct CushionKeys;

impl KeySet for CushionKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[(
        "The cushion",
        &[
            key(
                "stiffness",
                "STIFFNESS",
                "Stiffness of ALL the cushion under one edge; of a power law such as \"2e7 N/m^1.5\"",
            ),
            key("pad_stiffness", "STIFFNESS", "Stiffness (and law) of one pad, with --pads-per-edge"),
            key("cushion", "FILE.toml", "One pad, from a file that freestand cushion drop wrote, with --pads-per-edge"),
            key("pads_per_edge", "N", "Number of pads under one edge, which share its landing"),
            list("series_stiffness", "STIFFNESS", "Acts in series with the cushion: legs, floor covering (repeatable)"),
            key("pad_thickness", "LENGTH", "Thickness of the pad, for the warnings [default: 20 mm]"),
            key(
                "law",
                "LAW",
                "Contact law: linear, power (hertz), kelvin-voigt, hunt-crossley, tangent [default: linear]",
            ),
            key("exponent", "N", "Exponent of power and hunt-crossley [default: 1.5]"),
            key(
                "damping",
                "DAMPING",
                "Damping of kelvin-voigt: a ratio for the mass on the edge's stiffness, or such as \"300 N s/m\"",
            ),
            key("dissipation", "DISSIPATION", "Dissipation of hunt-crossley, such as \"0.3 s/m\""),
            key("bottoming", "LENGTH", "Compression at which a tangent law ends"),
        ],
    )];
}

impl CushionArgs {
    /// The words of the flags, or of the file that they name.
    pub(crate) fn words(&self, values: &mut Values) -> Result<CushionWords, Failure> {
        let mut words = CushionWords::new(KeyStyle::Flag);
        self.keys.texts().for_each(|(key, text)| words.set(key, text));
        let Some(path) = self.keys.get("cushion").map(Path::new) else { return Ok(words) };
        let (file, _) = read_cushion_file(path)?;
        match words.with_file(file) {
            Ok(words) => Ok(words),
            Err((_, problem)) => {
                values.push(problem);
                Ok(words)
            }
        }
    }

    /// What stands under one edge of an object of `mass_kg`; `None` where no flag says anything, or a wrong thing.
    pub(crate) fn edge(&self, mass_kg: Option<f64>, values: &mut Values) -> Result<Option<EdgeCushion>, Failure> {
        let words = self.words(values)?;
        Ok(self.resolved(&words, mass_kg, values))
    }

    /// What stands under one edge by these words; `None` where there are none, or a wrong one.
    pub(crate) fn resolved(
        &self,
        words: &CushionWords,
        mass_kg: Option<f64>,
        values: &mut Values,
    ) -> Option<EdgeCushion> {
        if words.is_empty() {
            return None;
        }
        match words.resolve(mass_kg) {
            Ok(edge) => Some(edge),
            Err(problems) => {
                for (_, problem) in problems {
                    // What a file says is the fault of the file.
                    values.push(self.inputs().iter().fold(problem, |problem, path| problem.in_file(path)));
                }
                None
            }
        }
    }

    /// Whether any of these flags is given.
    pub(crate) fn is_given(&self) -> bool {
        !self.keys.is_empty()
    }

    /// The file that these flags name.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        self.keys.get("cushion").map(PathBuf::from).into_iter().collect()
    }
}
