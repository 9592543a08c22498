//! Reads a point source: the same keys in the flags of `motion simulate` and in `point_source` of a
//! study.

use freestand::synthesis::{PathDuration, Preset, SimulationOptions, SourceSpectrum, Window};

use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;

use super::SourceChanges;

const SPECTRA: [(&str, SourceSpectrum); 2] = [
    ("single-corner", SourceSpectrum::SingleCorner),
    ("two-corner", SourceSpectrum::TwoCorner),
];
const PATHS: [(&str, PathDuration); 2] = [
    ("boore", PathDuration::Boore),
    ("atkinson-boore", PathDuration::AtkinsonBoore),
];
const WINDOWS: [(&str, Window); 2] = [
    ("lam", Window::Lam),
    ("saragoni-hart", Window::SaragoniHart),
];
const SWITCH: [(&str, bool); 2] = [("true", true), ("false", false)];

/// The name of a source spectrum in files.
pub fn spectrum_name(spectrum: SourceSpectrum) -> &'static str {
    SPECTRA
        .iter()
        .find(|(_, one)| *one == spectrum)
        .map_or("", |(name, _)| name)
}

/// A resolved source, without the site and its hazard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceInput {
    /// A set of parameters that belong together.
    pub preset: Preset,
    /// Changes to them.
    pub changes: SourceChanges,
    /// Moment magnitude.
    pub magnitude: Option<f64>,
    /// Distance \[m\].
    pub distance_m: Option<f64>,
    /// Time step and low cut.
    pub options: SimulationOptions,
}

/// The source that words with the keys of `point_source` describe; other values come from the
/// preset, by default `victoria`.
///
/// # Errors
/// Everything that is wrong with the words. Ranges are checked where the source is used.
///
/// # Example
/// ```
/// use freestand_input::keys::Words;
/// use freestand_study::simulated::read_source;
/// let words = Words::from_iter([("magnitude", "6"), ("distance", "30 km"), ("stress_drop", "20 MPa")]);
/// let source = read_source(&words)?;
/// assert_eq!((source.distance_m, source.changes.stress_drop_pa), (Some(30e3), Some(20e6)));
/// # Ok::<(), freestand_input::problem::Problems>(())
/// ```
pub fn read_source(words: &Words) -> Result<SourceInput, Problems> {
    let mut reader = WordReader::new(words);
    let defaults = SimulationOptions::default();
    let [victoria, intraplate, se_australia] = Preset::ALL.map(|preset| (preset.name(), preset));
    let presets = [
        victoria,
        ("melbourne", Preset::Victoria),
        intraplate,
        se_australia,
    ];
    let changes = SourceChanges {
        stress_drop_pa: reader.positive("stress_drop", Dimension::Pressure),
        kappa_s: reader.non_negative("kappa", Dimension::Time),
        spectrum: reader.one_of("source_spectrum", &SPECTRA),
        path_duration: reader.one_of("path_duration", &PATHS),
        window: reader.one_of("window", &WINDOWS),
        hard_rock: reader.one_of("hard_rock", &SWITCH).unwrap_or(false),
    };
    let source = SourceInput {
        preset: reader
            .one_of("preset", &presets)
            .unwrap_or(Preset::Victoria),
        changes,
        magnitude: reader.positive("magnitude", Dimension::Ratio),
        distance_m: reader.positive("distance", Dimension::Length),
        options: SimulationOptions {
            dt_s: reader
                .positive("time_step", Dimension::Time)
                .unwrap_or(defaults.dt_s),
            low_cut_hz: reader
                .positive("low_cut", Dimension::Frequency)
                .unwrap_or(defaults.low_cut_hz),
        },
    };
    reader.problems.finish(Some(source))
}
