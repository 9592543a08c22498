//! Motions: samples from Python and from record files.

use std::path::PathBuf;

use freestand::motion::Motion;
use freestand_app::Records;
use freestand_app::motion::{MotionSpectrum, SPECTRUM};
use freestand_app::request::Question as _;
use freestand_input::file::sha256_hex;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_positive};
use freestand_output::answer::Answer as _;
use freestand_output::folder::write_file;
use freestand_records::formats::{Component, write_at2, write_csv};
use freestand_records::notes::{Note, NoteKind};
use freestand_records::processing::process;
use freestand_report::doubts::motion_doubts;
use freestand_study::inspect::{MotionMeasures, spectrum};
use freestand_study::recorded::ReadMotion;
use freestand_study::study::RecordedMotion;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{bytes, dictionary, doubles, told};
use crate::asked::{Named, asked, fill, typed};
use crate::errors::{raised, raised_all};
use crate::work::watched;

/// The motion behind `freestand.Motion`.
#[pyclass(frozen, module = "freestand._freestand")]
pub(crate) struct Record {
    pub(crate) read: ReadMotion,
}

/// A motion that is not from a file.
pub(crate) fn unread(name: String, motion: Motion, processing: Vec<String>) -> Record {
    let sha256 = sha256_hex(&bytes(motion.accel_m_s2().iter().copied()));
    let motion = RecordedMotion {
        path: PathBuf::from(&name),
        name,
        sha256,
        description: "samples from Python".to_owned(),
        scale_ratio: 1.0,
        station_xml: Vec::new(),
        scale_target: None,
        processing,
        matched: None,
        suite: None,
        motion,
        across: None,
        vertical: None,
    };
    Record {
        read: ReadMotion {
            motion,
            notes: Vec::new(),
            start_note: None,
            unit: "m/s2",
        },
    }
}

impl Record {
    pub(crate) fn motion(&self) -> &Motion {
        &self.read.motion.motion
    }

    /// Its samples under a name: what was said when it was read is not said again.
    pub(crate) fn samples(&self, name: &str) -> ReadMotion {
        let mut read = self.read.clone();
        read.motion.name = name.to_owned();
        read.motion.processing.clear();
        read.notes.clear();
        read
    }

    /// The same, with other samples.
    fn with(&self, motion: Motion, steps: Vec<String>) -> Self {
        let mut read = self.read.clone();
        read.motion.motion = motion;
        read.motion.processing.extend(steps);
        Self { read }
    }
}

#[pymethods]
impl Record {
    /// A motion of samples [m/s²], as bytes of doubles.
    #[new]
    #[pyo3(signature = (accel_m_s2, dt_s, name, notes=None, processing=None))]
    fn new(
        accel_m_s2: &[u8],
        dt_s: f64,
        name: String,
        notes: Option<Vec<String>>,
        processing: Option<Vec<String>>,
    ) -> PyResult<Self> {
        let motion = Motion::new(dt_s, doubles(accel_m_s2));
        let motion = motion.map_err(|error| {
            raised(Problem::value(
                error.to_string(),
                "check accel_m_s2 and dt_s",
            ))
        })?;
        let mut record = unread(name, motion, processing.unwrap_or_default());
        let given = |note| Note::new(NoteKind::Given, note);
        record.read.notes = notes.into_iter().flatten().map(given).collect();
        Ok(record)
    }

    fn accel<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &bytes(self.motion().accel_m_s2().iter().copied()))
    }

    #[getter]
    fn dt_s(&self) -> f64 {
        self.motion().dt_s()
    }

    #[getter]
    pub(crate) fn name(&self) -> &str {
        &self.read.motion.name
    }

    #[getter]
    fn description(&self) -> &str {
        &self.read.motion.description
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.read.notes.iter().map(Note::to_string).collect()
    }

    #[getter]
    fn processing(&self) -> Vec<String> {
        self.read.motion.processing.clone()
    }

    #[getter]
    fn pga_g(&self) -> f64 {
        self.motion().peak_m_s2() / freestand::G0_M_S2
    }

    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let measures = py.detach(|| MotionMeasures::of(self.motion()));
        dictionary(py, &measures.facts(), |_| false)
    }

    fn spectrum(
        &self,
        py: Python<'_>,
        periods_s: &[u8],
        damping_ratios: &[u8],
        values: &Bound<'_, PyDict>,
    ) -> PyResult<String> {
        let motion = [("motion", self.read.clone())];
        let (mut request, files) = asked::<MotionSpectrum>(values, motion, Named::new())?;
        fill(&mut request.periods, periods_s);
        fill(&mut request.damping, damping_ratios);
        let (read, request) = request.resolve(&files).map_err(raised_all)?.asked;
        let report = watched(py, None, |_| spectrum(&read, &request))?.map_err(raised)?;
        told(SPECTRUM, &report, &motion_doubts(&report.doubts))
    }

    fn process(&self, py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<Self> {
        let processing = typed::<Records>(values)?.processing().map_err(raised_all)?;
        let component = Component {
            name: self.read.motion.name.clone(),
            station: None,
            direction: None,
            unit: self.read.unit,
            // What is raw was centred when it was read.
            is_raw: false,
            start: None,
            station_xml: None,
            motion: self.motion().clone(),
            line_of_first_value: 1,
        };
        let processed = py
            .detach(|| process(&component, &processing))
            .map_err(raised)?;
        let mut record = self.with(processed.motion, processed.steps);
        record.read.notes.extend(processed.notes);
        record.read.motion.scale_ratio *= processed.scale_ratio;
        Ok(record)
    }

    fn scaled(&self, factor: f64) -> PyResult<Self> {
        let scaled = self.motion().scaled(factor);
        let scaled = scaled
            .map_err(|error| raised(Problem::value(error.to_string(), "give a finite factor")))?;
        let mut record = self.with(scaled, vec![format!("scaled by {factor}")]);
        record.read.motion.scale_ratio *= factor;
        Ok(record)
    }

    fn write(&self, path: PathBuf) -> PyResult<()> {
        let is = |ending: &str| {
            path.extension()
                .is_some_and(|found| found.eq_ignore_ascii_case(ending))
        };
        let text = match (is("csv"), is("at2")) {
            (true, _) => write_csv(self.motion()),
            (_, true) => write_at2(self.motion(), &self.read.motion.name),
            _ => {
                let message = format!("{} is neither .csv nor .at2", path.display());
                return Err(raised(Problem::value(
                    message,
                    "name the file with one of these endings",
                )));
            }
        };
        write_file(&path, text.as_bytes(), &[]).map_err(raised)
    }
}

/// The motions of files.
#[pyfunction]
pub(crate) fn read_motions(
    py: Python<'_>,
    paths: Vec<PathBuf>,
    values: &Bound<'_, PyDict>,
) -> PyResult<Vec<Record>> {
    let records = typed::<Records>(values)?;
    let read = watched(py, None, |_| records.read_files(paths))?.map_err(raised_all)?;
    Ok(read.into_iter().map(|read| Record { read }).collect())
}

/// Metres per second squared in a unit of acceleration.
#[pyfunction]
pub(crate) fn acceleration_unit(unit: &str) -> PyResult<f64> {
    parse_positive(&format!("1 {unit}"), Dimension::Acceleration, "the unit").map_err(raised)
}
