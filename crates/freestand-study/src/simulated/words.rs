//! A point source from words: the same in the flags of `motion simulate` and in `point_source` of a study.

use freestand::synthesis::{PathDuration, Preset, SimulationOptions, SourceSpectrum, Window};

use super::{SourceChanges, SourceProblem};
use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, parse_non_negative, parse_positive, shorten};
use freestand_input::words::nearest;

/// The words; `--stress-drop` is the flag of `stress_drop`.
pub const SOURCE_KEYS: [&str; 11] = [
    "magnitude",
    "distance",
    "preset",
    "stress_drop",
    "kappa",
    "source_spectrum",
    "path_duration",
    "window",
    "hard_rock",
    "time_step",
    "low_cut",
];

const SPECTRA: [(&str, SourceSpectrum); 2] =
    [("single-corner", SourceSpectrum::SingleCorner), ("two-corner", SourceSpectrum::TwoCorner)];
const PATHS: [(&str, PathDuration); 2] =
    [("boore", PathDuration::Boore), ("atkinson-boore", PathDuration::AtkinsonBoore)];
const WINDOWS: [(&str, Window); 2] = [("lam", Window::Lam), ("saragoni-hart", Window::SaragoniHart)];
const SWITCH: [(&str, bool); 2] = [("true", true), ("false", false)];

/// A source as written: values with their units, by [`SOURCE_KEYS`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SourceWords {
    style: KeyStyle,
    entries: Vec<(&'static str, String)>,
}

/// A source as meant, but for what goes with a place of a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceInput {
    /// Parameters that belong together.
    pub preset: Preset,
    /// What is changed in them.
    pub changes: SourceChanges,
    /// Moment magnitude.
    pub magnitude: Option<f64>,
    /// Distance \[m\].
    pub distance_m: Option<f64>,
    /// Time step and low cut.
    pub options: SimulationOptions,
}

impl SourceWords {
    /// No words yet.
    pub fn new(style: KeyStyle) -> Self {
        Self { style, entries: Vec::new() }
    }

    /// Adds a word, or puts it in place of what was said before.
    pub fn set(&mut self, key: &'static str, text: impl Into<String>) {
        self.entries.retain(|(name, _)| *name != key);
        self.entries.push((key, text.into()));
    }

    fn get(&self, key: &str) -> Option<&str> {
        self.entries.iter().find(|(name, _)| *name == key).map(|(_, text)| text.as_str())
    }

    /// A key as the user writes it.
    pub fn name(&self, key: &str) -> String {
        match self.style {
            KeyStyle::File => key.to_owned(),
            KeyStyle::Flag => format!("--{}", key.replace('_', "-")),
        }
    }

    /// The source; what is not said is the preset's, and the preset is `victoria`.
    ///
    /// # Errors
    /// Everything that is wrong with the words. Ranges are checked where the source is used.
    ///
    /// # Example
    /// ```
    /// use freestand_study::simulated::SourceWords;
    /// let mut words = SourceWords::default();
    /// words.set("magnitude", "6");
    /// words.set("distance", "30 km");
    /// words.set("stress_drop", "20 MPa");
    /// let source = words.resolve().map_err(|problems| problems[0].problem.clone())?;
    /// assert_eq!((source.distance_m, source.changes.stress_drop_pa), (Some(30e3), Some(20e6)));
    /// # Ok::<(), freestand_input::problem::Problem>(())
    /// ```
    pub fn resolve(&self) -> Result<SourceInput, Vec<SourceProblem>> {
        let mut problems = Vec::new();
        let fine = SimulationOptions::default();
        let [victoria, intraplate, se_australia] = Preset::ALL.map(|preset| (preset.name(), preset));
        let presets = [victoria, ("melbourne", Preset::Victoria), intraplate, se_australia];
        let changes = SourceChanges {
            stress_drop_pa: self.positive("stress_drop", Dimension::Pressure, &mut problems),
            kappa_s: self
                .quantity("kappa", &mut problems, |text| parse_non_negative(text, Dimension::Time, "the value")),
            spectrum: self.one_of("source_spectrum", &SPECTRA, &mut problems),
            path_duration: self.one_of("path_duration", &PATHS, &mut problems),
            window: self.one_of("window", &WINDOWS, &mut problems),
            hard_rock: self.one_of("hard_rock", &SWITCH, &mut problems).unwrap_or(false),
        };
        let input = SourceInput {
            preset: self.one_of("preset", &presets, &mut problems).unwrap_or(Preset::Victoria),
            changes,
            magnitude: self.positive("magnitude", Dimension::Ratio, &mut problems),
            distance_m: self.positive("distance", Dimension::Length, &mut problems),
            options: SimulationOptions {
                dt_s: self.positive("time_step", Dimension::Time, &mut problems).unwrap_or(fine.dt_s),
                low_cut_hz: self.positive("low_cut", Dimension::Frequency, &mut problems).unwrap_or(fine.low_cut_hz),
            },
        };
        if problems.is_empty() { Ok(input) } else { Err(problems) }
    }

    fn positive(&self, key: &'static str, dimension: Dimension, problems: &mut Vec<SourceProblem>) -> Option<f64> {
        self.quantity(key, problems, |text| parse_positive(text, dimension, "the value"))
    }

    fn quantity(
        &self,
        key: &'static str,
        problems: &mut Vec<SourceProblem>,
        read: impl Fn(&str) -> Result<f64, Problem>,
    ) -> Option<f64> {
        let result = read(self.get(key)?);
        result
            .map_err(|mut problem| {
                problem.message = format!("{}: {}", self.name(key), problem.message);
                problems.push(SourceProblem { key: Some(key), problem });
            })
            .ok()
    }

    fn one_of<T: Copy>(
        &self,
        key: &'static str,
        known: &[(&'static str, T)],
        problems: &mut Vec<SourceProblem>,
    ) -> Option<T> {
        let text = self.get(key)?;
        let plain = text.trim().to_lowercase();
        let found = known.iter().find(|(name, _)| *name == plain).map(|(_, value)| *value);
        if found.is_none() {
            let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
            let hint = match nearest(text, &names) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("one of {}", names.join(", ")),
            };
            let message = format!("{}: there is no {} \"{}\"", self.name(key), key.replace('_', " "), shorten(text));
            let problem = Problem::new(ProblemKind::Value, message).hint(hint);
            problems.push(SourceProblem { key: Some(key), problem });
        }
        found
    }
}
