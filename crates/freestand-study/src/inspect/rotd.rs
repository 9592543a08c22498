//! Response spectra of two horizontal components over all directions.

use freestand::G0_M_S2;
use freestand::signal::rotate::{Pair, directional_spectrum};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::doubt::MotionDoubt;
use crate::pair::ReadPair;
use freestand_input::problem::Problem;
use freestand_output::rows::table_of_columns;
use freestand_output::table::Table;
use freestand_records::notes::Note;
use freestand_records::processing::{not_perpendicular, process_pair, short_period_warning};

/// Spectra over all directions to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct RotdRequest {
    /// Damping ratio, 0 to below 1.
    pub damping_ratio: f64,
    /// Periods; 0 is the rigid oscillator \[s\].
    pub periods_s: Vec<f64>,
    /// Percentiles over the directions, 0 to 100, each once: 50 is the median, 100 the largest.
    pub percentiles: Vec<f64>,
}

/// Response spectra of two horizontal components over all directions.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(extend("patternProperties" = {
    r"^rotd\d+(\.\d+)?_g$": {"description": "RotDnn, one value for each period.", "type": "array", "items": {"type": ["number", "null"]}}
}))]
#[expect(
    missing_docs,
    reason = "the names are those of the JSON document and state the units"
)]
pub struct RotdReport {
    pub paths: Vec<String>,
    pub components: [String; 2],
    pub damping_ratio: f64,
    pub periods_s: Vec<f64>,
    /// In the order requested; the document has `rotd50_g` and so on next to the periods.
    #[serde(flatten, serialize_with = "by_name")]
    #[schemars(skip)]
    pub rotd: Vec<PercentileSpectrum>,
    pub first_g: Vec<f64>,
    pub second_g: Vec<f64>,
    pub larger_g: Vec<f64>,
    pub geometric_mean_g: Vec<f64>,
    /// What was done to each component, one step each.
    pub processing: [Vec<String>; 2],
    #[serde(skip)]
    pub doubts: Vec<MotionDoubt>,
}

/// RotDnn: at each period, the percentile of the pseudo-acceleration over all directions.
#[derive(Debug, Clone, PartialEq)]
pub struct PercentileSpectrum {
    /// The percentile nn, 0 to 100.
    pub percentile: f64,
    /// One value for each period \[g\].
    pub psa_g: Vec<f64>,
}

/// Computes the response spectra of a pair over all directions, after removing the means of raw
/// components.
///
/// # Errors
/// Not two components, or components with different steps; a scale to a target; an invalid damping,
/// period or percentile.
pub fn rotd(read: &ReadPair, request: &RotdRequest) -> Result<RotdReport, Problem> {
    check_percentiles(&request.percentiles)?;
    let (first, second) = read.components()?;
    let names = read.names((first, second));
    let names = (names.0.as_str(), names.1.as_str());
    let (one, two) = process_pair((first, second), names, &read.request.files.processing)?;
    let spectrum = Pair::new(&one.motion, &two.motion)
        .and_then(|pair| directional_spectrum(&pair, request.damping_ratio, &request.periods_s, &request.percentiles))
        .map_err(|error| {
            Problem::value(
                error.to_string(),
                "damping from 0 to below 1, periods of 0 or more, percentiles from 0 to 100, one time step",
            )
        })?;
    let in_g = |values: &[f64]| values.iter().map(|a| a / G0_M_S2).collect::<Vec<f64>>();
    let ranked = request.percentiles.iter().zip(&spectrum.rotd_m_s2);
    let processed = [&one, &two].into_iter().flat_map(|done| &done.notes);
    let askew = not_perpendicular(first, second);
    let noted = askew.iter().chain(processed).map(Note::to_string);
    let few = short_period_warning("the spectrum", &request.periods_s, one.motion.dt_s());
    let notes = read.notes().into_iter().chain(noted).chain(few);
    let doubts = notes.map(MotionDoubt::OfRecords).collect();
    Ok(RotdReport {
        paths: read
            .files
            .iter()
            .map(|file| file.path.to_string_lossy().into_owned())
            .collect(),
        components: [first.name.clone(), second.name.clone()],
        damping_ratio: request.damping_ratio,
        periods_s: request.periods_s.clone(),
        rotd: ranked
            .map(|(&percentile, row)| PercentileSpectrum {
                percentile,
                psa_g: in_g(row),
            })
            .collect(),
        first_g: in_g(&spectrum.first_m_s2),
        second_g: in_g(&spectrum.second_m_s2),
        larger_g: in_g(&spectrum.larger_m_s2),
        geometric_mean_g: in_g(&spectrum.geometric_mean_m_s2),
        processing: [one.steps, two.steps],
        doubts,
    })
}

/// Refuses what is no percentile, and one that is named twice.
///
/// # Errors
/// The first of them.
pub fn check_percentiles(percentiles: &[f64]) -> Result<(), Problem> {
    let is_none = |percentile: &&f64| !(0.0..=100.0).contains(*percentile);
    if let Some(wrong) = percentiles.iter().find(is_none) {
        return Err(Problem::value(
            format!("a percentile must be from 0 to 100, not {wrong}"),
            "give 50 for the median, 100 for the largest",
        ));
    }
    match repeated(percentiles) {
        Some(twice) => Err(Problem::value(
            format!("percentile {twice} is requested twice"),
            "name each percentile once",
        )),
        None => Ok(()),
    }
}

/// The first value that occurs a second time.
fn repeated(values: &[f64]) -> Option<f64> {
    let is_repeated =
        |&(index, value): &(usize, &f64)| values.iter().take(index).any(|before| before == value);
    values
        .iter()
        .enumerate()
        .find(is_repeated)
        .map(|(_, value)| *value)
}

impl PercentileSpectrum {
    /// `rotd50_g`, as in documents and tables.
    pub fn name(&self) -> String {
        // Minus zero is zero.
        format!("rotd{}_g", self.percentile + 0.0)
    }
}

fn by_name<S: Serializer>(
    spectra: &[PercentileSpectrum],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(spectra.iter().map(|one| (one.name(), &one.psa_g)))
}

impl RotdReport {
    /// Periods and spectra with their names, RotDnn in the order requested.
    pub fn columns(&self) -> Vec<(String, &[f64])> {
        let mut columns = vec![("period_s".to_owned(), self.periods_s.as_slice())];
        columns.extend(
            self.rotd
                .iter()
                .map(|one| (one.name(), one.psa_g.as_slice())),
        );
        let others = [
            ("larger_g", &self.larger_g),
            ("geometric_mean_g", &self.geometric_mean_g),
            ("first_g", &self.first_g),
            ("second_g", &self.second_g),
        ];
        columns.extend(
            others
                .into_iter()
                .map(|(name, values)| (name.to_owned(), values.as_slice())),
        );
        columns
    }

    /// The columns as a table.
    ///
    /// # Errors
    /// None in practice: see [`table_of_columns`].
    pub fn table(&self) -> Result<Table, Problem> {
        let columns = self.columns();
        table_of_columns(
            &columns
                .iter()
                .map(|(name, values)| (name.as_str(), *values))
                .collect::<Vec<_>>(),
        )
    }
}
