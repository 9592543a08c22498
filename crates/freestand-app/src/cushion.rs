//! The cushion under one edge of an object.

use std::path::{Path, PathBuf};

use clap::ArgAction;
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::cushion::{self, EdgeCushion, pad_words, read_cushion_file, with_file};

use crate::files::{Content, Files};
use crate::request::{Request, request};

request! {
    /// The cushion under one edge of an object.
    pub struct CushionUnder under "The cushion" {
        /// Stiffness of the whole cushion under one edge; for a power law, such as "2e7 N/m^1.5"
        pub stiffness = "STIFFNESS",
        /// Stiffness (and law) of one pad; needs --pads-per-edge
        pub pad_stiffness = "STIFFNESS",
        /// One pad, from a file written by freestand cushion drop; needs --pads-per-edge
        pub cushion = "FILE.toml",
        /// Number of pads under one edge
        pub pads_per_edge = "N",
        /// A layer in series with the cushion: legs, floor covering (repeatable)
        #[arg(long, value_name = "STIFFNESS", action = ArgAction::Append, help_heading = "The cushion")]
        pub series_stiffness: Vec<Written>,
        /// Thickness of the pad, used in warnings only [default: 20 mm]
        pub pad_thickness = "LENGTH",
        /// Contact law: linear, power (hertz), kelvin-voigt, hunt-crossley, tangent [default: linear]
        pub law = "LAW",
        /// Exponent of a power or hunt-crossley law [default: 1.5]
        pub exponent = "N",
        /// Damping of kelvin-voigt: a damping ratio for this mass on the cushion, or a value such as "300 N s/m"
        pub damping = "DAMPING",
        /// Dissipation of hunt-crossley, such as "0.3 s/m"
        pub dissipation = "DISSIPATION",
        /// Compression at which a tangent law bottoms
        pub bottoming = "LENGTH",
    }
}

impl CushionUnder {
    /// The cushion under one edge of an object of `mass_kg`; `None` if nothing describes it, or something is wrong.
    pub(crate) fn resolve(
        &self,
        read: &mut WordReader<'_>,
        mass_kg: Option<f64>,
        files: &Files,
    ) -> Option<EdgeCushion> {
        let words = self.described(read, files)?;
        self.of_words(&words, read, mass_kg, files)
    }

    /// The cushion that its [description](Self::described) means.
    pub(crate) fn of_words(
        &self,
        words: &Words,
        read: &mut WordReader<'_>,
        mass_kg: Option<f64>,
        files: &Files,
    ) -> Option<EdgeCushion> {
        let resolved = cushion::resolve(words, mass_kg);
        // A wrong value from a file is told with the path of the file.
        let path = self.input(files);
        let in_file = |problems: Problems| -> Problems {
            let named = problems.into_iter().map(|problem| match &path {
                Some(path) => problem.in_file(path),
                None => problem,
            });
            named.collect()
        };
        read.problems.keep(resolved.map_err(in_file))
    }

    /// What describes the cushion, with what is in its file; `None` if nothing does, or the file is wrong.
    pub(crate) fn described(&self, read: &mut WordReader<'_>, files: &Files) -> Option<Words> {
        let words = self.with_units();
        let keys: Vec<&'static str> = words.entries().map(|(key, _)| key).collect();
        read.pass(&keys);
        if words.is_empty() {
            return None;
        }
        read.one("cushion");
        read.problems.keep(with_its_file(words, files))
    }

    /// The file that it names.
    pub(crate) fn input(&self, files: &Files) -> Option<PathBuf> {
        files.path_of(self.cushion.as_ref())
    }

    /// As it was written, every bare number with its unit.
    fn with_units(&self) -> Words {
        let of = |written: &Option<Written>, unit| written.as_ref().map(|one| one.in_unit(unit));
        let written = Self {
            stiffness: of(&self.stiffness, "N/m"),
            pad_stiffness: of(&self.pad_stiffness, "N/m"),
            series_stiffness: self
                .series_stiffness
                .iter()
                .map(|one| one.in_unit("N/m"))
                .collect(),
            pad_thickness: of(&self.pad_thickness, "m"),
            dissipation: of(&self.dissipation, "s/m"),
            bottoming: of(&self.bottoming, "m"),
            ..self.clone()
        };
        written.words()
    }
}

/// The words of a cushion, with those of the file that they name.
fn with_its_file(words: Words, files: &Files) -> Result<Words, Problems> {
    let Some(name) = words.get("cushion") else {
        return Ok(words);
    };
    let file = match files
        .find(name)
        .map_err(|problem| problem.named("cushion"))?
    {
        Content::At(path) => read_cushion_file(&path)?.0,
        Content::Text(text) => pad_words(&text, Path::new(name))?,
        Content::Motion(_) | Content::Mesh(_) => return Ok(words),
    };
    Ok(with_file(&words, file)?)
}
