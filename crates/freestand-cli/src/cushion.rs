//! Flags that describe what stands under one edge.

use std::path::PathBuf;

use clap::Args;
use freestand_input::keys::KeyStyle;
use freestand_study::cushion::{CushionWords, EdgeCushion, read_cushion_file};

use crate::failure::Failure;
use crate::values::Values;

#[derive(Debug, Args)]
#[command(next_help_heading = "The cushion")]
pub(crate) struct CushionArgs {
    /// Stiffness of ALL the cushion under one edge; of a power law such as "2e7 N/m^1.5"
    #[arg(long, value_name = "STIFFNESS", allow_hyphen_values = true)]
    stiffness: Option<String>,
    /// Stiffness (and law) of one pad, with --pads-per-edge
    #[arg(long, value_name = "STIFFNESS", allow_hyphen_values = true)]
    pad_stiffness: Option<String>,
    /// One pad, from a file that freestand cushion drop wrote, with --pads-per-edge
    #[arg(long, value_name = "FILE.toml")]
    cushion: Option<PathBuf>,
    /// Pads that share the landing of one edge
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pads_per_edge: Option<String>,
    /// Acts in series with the cushion: legs, floor covering (repeatable)
    #[arg(long, value_name = "STIFFNESS", allow_hyphen_values = true)]
    series_stiffness: Vec<String>,
    /// Thickness of the pad, for the warnings [default: 20 mm]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pad_thickness: Option<String>,
    /// Contact law: linear, power (hertz), kelvin-voigt, hunt-crossley, tangent [default: linear]
    #[arg(long, value_name = "LAW")]
    law: Option<String>,
    /// Exponent of power and hunt-crossley [default: 1.5]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    exponent: Option<String>,
    /// Damping of kelvin-voigt: a ratio of the mass on the edge's stiffness, or such as "300 N s/m"
    #[arg(long, value_name = "DAMPING", allow_hyphen_values = true)]
    damping: Option<String>,
    /// Dissipation of hunt-crossley, such as "0.3 s/m"
    #[arg(long, value_name = "DISSIPATION", allow_hyphen_values = true)]
    dissipation: Option<String>,
    /// Compression at which tangent ends
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    bottoming: Option<String>,
}

impl CushionArgs {
    /// The words of the flags, or of the file that they name.
    pub(crate) fn words(&self, values: &mut Values) -> Result<CushionWords, Failure> {
        let mut words = CushionWords::new(KeyStyle::Flag);
        let texts = [
            ("law", &self.law),
            ("stiffness", &self.stiffness),
            ("pad_stiffness", &self.pad_stiffness),
            ("pads_per_edge", &self.pads_per_edge),
            ("pad_thickness", &self.pad_thickness),
            ("exponent", &self.exponent),
            ("damping", &self.damping),
            ("dissipation", &self.dissipation),
            ("bottoming", &self.bottoming),
        ];
        for (key, text) in texts {
            if let Some(text) = text {
                words.set(key, text.clone());
            }
        }
        for text in &self.series_stiffness {
            words.set("series_stiffness", text.clone());
        }
        let Some(path) = &self.cushion else { return Ok(words) };
        words.set("cushion", path.display().to_string());
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
                    values.push(self.cushion.iter().fold(problem, |problem, path| problem.in_file(path)));
                }
                None
            }
        }
    }

    /// Whether any of these flags is given.
    pub(crate) fn is_given(&self) -> bool {
        let texts = [
            &self.law,
            &self.stiffness,
            &self.pad_stiffness,
            &self.pads_per_edge,
            &self.pad_thickness,
            &self.exponent,
            &self.damping,
            &self.dissipation,
            &self.bottoming,
        ];
        texts.iter().any(|text| text.is_some()) || self.cushion.is_some() || !self.series_stiffness.is_empty()
    }

    /// The files that these flags name.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.cushion.iter()
    }
}
