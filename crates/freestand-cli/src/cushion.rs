//! Flags that describe the cushion under one edge.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::keys::Words;
use freestand_study::cushion::{self, EdgeCushion, read_cushion_file, with_file};

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
                "Stiffness of the whole cushion under one edge; for a power law, such as \"2e7 N/m^1.5\"",
            ),
            key(
                "pad_stiffness",
                "STIFFNESS",
                "Stiffness (and law) of one pad; needs --pads-per-edge",
            ),
            key(
                "cushion",
                "FILE.toml",
                "One pad, from a file written by freestand cushion drop; needs --pads-per-edge",
            ),
            key("pads_per_edge", "N", "Number of pads under one edge"),
            list(
                "series_stiffness",
                "STIFFNESS",
                "A layer in series with the cushion: legs, floor covering (repeatable)",
            ),
            key(
                "pad_thickness",
                "LENGTH",
                "Thickness of the pad, used in warnings only [default: 20 mm]",
            ),
            key(
                "law",
                "LAW",
                "Contact law: linear, power (hertz), kelvin-voigt, hunt-crossley, tangent [default: linear]",
            ),
            key(
                "exponent",
                "N",
                "Exponent of a power or hunt-crossley law [default: 1.5]",
            ),
            key(
                "damping",
                "DAMPING",
                "Damping of kelvin-voigt: a damping ratio for this mass on the cushion, or a value such as \"300 N s/m\"",
            ),
            key(
                "dissipation",
                "DISSIPATION",
                "Dissipation of hunt-crossley, such as \"0.3 s/m\"",
            ),
            key(
                "bottoming",
                "LENGTH",
                "Compression at which a tangent law bottoms",
            ),
        ],
    )];
}

impl CushionArgs {
    /// The texts of the flags, with those of the file that `--cushion` names.
    pub(crate) fn words(&self, values: &mut Values) -> Result<Words, Failure> {
        let words = self.keys.words.clone();
        let Some(path) = words.get("cushion").map(Path::new) else {
            return Ok(words);
        };
        let (file, _) = read_cushion_file(path)?;
        Ok(values.take(with_file(&words, file)).unwrap_or(words))
    }

    /// The cushion that these texts describe; `None` if there are none, or one is wrong.
    pub(crate) fn resolved(
        &self,
        words: &Words,
        mass_kg: Option<f64>,
        values: &mut Values,
    ) -> Option<EdgeCushion> {
        if words.is_empty() {
            return None;
        }
        let resolved = cushion::resolve(words, mass_kg).map_err(|problems| {
            for problem in problems {
                // A wrong value from the file is reported with the name of the file.
                values.push(
                    self.inputs()
                        .iter()
                        .fold(problem, |problem, path| problem.in_file(path)),
                );
            }
        });
        resolved.ok()
    }

    /// The file that `--cushion` names.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        self.keys
            .words
            .get("cushion")
            .map(PathBuf::from)
            .into_iter()
            .collect()
    }
}
