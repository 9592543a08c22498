//! A grid of objects under many motions, as columns.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};

use freestand_app::request::Question as _;
use freestand_app::spectrum::Spectrum;
use freestand_input::problem::Problem;
use freestand_output::facts::{Facts, Value};
use freestand_report::doubts::spectrum_doubt;
use freestand_study::at_place::LastGround;
use freestand_study::spectrum::{
    SpectrumChunk, SpectrumTally, chunk_objects, spectrum as calculated,
};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::asked::{Named, asked, fill};
use crate::errors::raised_all;
use crate::motion::Record;
use crate::work::watched;

/// Block-steps of a chunk for each thread: 10 to 50 ms of work, after which Ctrl-C is noticed.
/// Smaller chunks would leave the vectors of the kernel partly empty.
const CHUNK_STEPS: usize = 25_000_000;
/// The fewest objects of a chunk for each thread, which fill its lanes.
const LEAST_OBJECTS: usize = 512;

/// A column while it grows.
enum Column {
    Number(Vec<f64>),
    Count(Vec<i64>),
    Flag(Vec<u8>),
    Text {
        codes: Vec<i32>,
        texts: Vec<String>,
        code_of: HashMap<String, i32>,
    },
}

impl Column {
    /// An empty column: the kinds of all values are known from their names.
    fn of(name: &str) -> Self {
        match name {
            "motion" | "outcome" | "reason" => Self::Text {
                codes: Vec::new(),
                texts: Vec::new(),
                code_of: HashMap::new(),
            },
            "impact_count" => Self::Count(Vec::new()),
            "sensitive" => Self::Flag(Vec::new()),
            _ => Self::Number(Vec::new()),
        }
    }

    fn push(&mut self, value: &Value<'_>) {
        match (self, value) {
            (Self::Number(values), Value::Number(value)) => values.push(*value),
            (Self::Number(values), _) => values.push(f64::NAN),
            (Self::Count(values), Value::Count(count)) => {
                values.push(i64::try_from(*count).unwrap_or(i64::MAX))
            }
            (Self::Count(values), _) => values.push(-1),
            (Self::Flag(values), Value::Flag(flag)) => values.push(u8::from(*flag)),
            (Self::Flag(values), _) => values.push(u8::MAX),
            (
                Self::Text {
                    codes,
                    texts,
                    code_of,
                },
                Value::Text(text),
            ) => {
                // Neighbours are often equal, and a comparison is cheaper than a search.
                let last = codes.last().copied();
                let is_last = |last: &i32| {
                    usize::try_from(*last)
                        .ok()
                        .and_then(|last| texts.get(last))
                        .is_some_and(|known| known == text)
                };
                let code = last
                    .filter(is_last)
                    .unwrap_or_else(|| code(texts, code_of, text));
                codes.push(code);
            }
            (Self::Text { codes, .. }, _) => codes.push(-1),
        }
    }

    /// Appends a column of the same kind.
    fn append(&mut self, other: Self) {
        match (self, other) {
            (Self::Number(all), Self::Number(more)) => all.extend(more),
            (Self::Count(all), Self::Count(more)) => all.extend(more),
            (Self::Flag(all), Self::Flag(more)) => all.extend(more),
            (
                Self::Text {
                    codes,
                    texts,
                    code_of,
                },
                Self::Text {
                    codes: more,
                    texts: words,
                    ..
                },
            ) => {
                let known: Vec<i32> = words
                    .iter()
                    .map(|word| code(texts, code_of, word))
                    .collect();
                let renamed = |one: i32| {
                    usize::try_from(one)
                        .ok()
                        .and_then(|one| known.get(one))
                        .copied()
                };
                codes.extend(more.into_iter().map(|one| renamed(one).unwrap_or(-1)));
            }
            _ => {}
        }
    }

    /// Its kind, its bytes and its texts.
    fn finish(self, py: Python<'_>) -> PyResult<(&'static str, Bound<'_, PyBytes>, Vec<String>)> {
        let (kind, data, texts) = match self {
            Self::Number(values) => (
                "number",
                bytes_of(py, &values, f64::to_ne_bytes)?,
                Vec::new(),
            ),
            Self::Count(values) => (
                "count",
                bytes_of(py, &values, i64::to_ne_bytes)?,
                Vec::new(),
            ),
            Self::Flag(values) => ("flag", PyBytes::new(py, &values), Vec::new()),
            Self::Text { codes, texts, .. } => {
                ("text", bytes_of(py, &codes, i32::to_ne_bytes)?, texts)
            }
        };
        Ok((kind, data, texts))
    }
}

/// Values as bytes that Python owns, written in place.
fn bytes_of<'py, T: Copy, const N: usize>(
    py: Python<'py>,
    values: &[T],
    bytes: impl Fn(T) -> [u8; N],
) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, values.len() * N, |place| {
        let (each, _) = place.as_chunks_mut::<N>();
        each.iter_mut()
            .zip(values)
            .for_each(|(place, value)| *place = bytes(*value));
        Ok(())
    })
}

/// The code of a text, which is new if the text is.
fn code(texts: &mut Vec<String>, code_of: &mut HashMap<String, i32>, text: &str) -> i32 {
    if let Some(code) = code_of.get(text) {
        return *code;
    }
    let code = i32::try_from(texts.len()).unwrap_or(-1);
    texts.push(text.to_owned());
    code_of.insert(text.to_owned(), code);
    code
}

/// Columns with their names, in the order of a row.
type Columns = Vec<(&'static str, Column)>;

/// The columns of a few rows.
fn columns(rows: &mut dyn Iterator<Item = Facts<'_>>) -> Columns {
    let mut columns: Columns = Vec::new();
    for row in rows {
        if columns.is_empty() {
            columns = row
                .named()
                .map(|(name, _)| (name, Column::of(name)))
                .collect();
        }
        columns
            .iter_mut()
            .zip(row.named())
            .for_each(|((_, column), (_, value))| column.push(value));
    }
    columns
}

/// Appends the rows of a chunk, made on all threads.
fn append(all: &mut Columns, chunk: &SpectrumChunk<'_>) {
    for piece in chunk.pieces(columns) {
        if all.is_empty() {
            *all = piece;
        } else {
            all.iter_mut()
                .zip(piece)
                .for_each(|((_, column), (_, more))| column.append(more));
        }
    }
}

/// A column for Python: name, kind, bytes, texts.
type Made<'py> = (&'static str, &'static str, Bound<'py, PyBytes>, Vec<String>);

/// Columns, warnings, seconds in the solver, block-steps.
type Answer<'py> = (Vec<Made<'py>>, Vec<String>, (f64, u64));

/// The rows of the command `spectrum`, by column.
#[pyfunction]
pub(crate) fn spectrum<'py>(
    py: Python<'py>,
    motions: Vec<(String, PyRef<'py, Record>, Option<PyRef<'py, Record>>)>,
    heights_m: &[u8],
    thicknesses_m: &[u8],
    request: &Bound<'py, PyDict>,
    files: Named,
    threads: Option<usize>,
) -> PyResult<Answer<'py>> {
    let named = motions.iter().flat_map(|(name, horizontal, vertical)| {
        let one = |key, record: &Record| (key, record.samples(name));
        let upward = vertical.as_ref().map(|record| one("vertical", record));
        std::iter::once(one("motion", horizontal)).chain(upward)
    });
    let (mut request, files) = asked::<Spectrum>(request, named, files)?;
    fill(&mut request.heights, heights_m);
    fill(&mut request.thicknesses, thicknesses_m);
    let meant = request.resolve(&files).map_err(raised_all)?;
    drop((request, files));
    let request = meant.objects;
    let shaken = meant.shaking.motions(&LastGround::default(), || Ok(()));
    let motions = shaken.map_err(raised_all)?.motions;
    let work = |stop: &AtomicBool| {
        let threads = rayon::current_num_threads();
        let size = |intervals: usize| {
            let lively = (CHUNK_STEPS * threads / intervals.max(1)).max(LEAST_OBJECTS * threads);
            lively.min(chunk_objects(intervals))
        };
        let mut tallies = vec![SpectrumTally::default(); motions.len()];
        let mut all = Columns::new();
        let timing = calculated(&request, &motions, size, |chunk| {
            append(&mut all, chunk);
            if let Some(tally) = tallies.get_mut(chunk.motion) {
                chunk.add_to(tally);
            }
            if stop.load(Ordering::Relaxed) {
                Err(Problem::stopped())
            } else {
                Ok(())
            }
        })?;
        Ok::<_, Problem>((
            all,
            request
                .doubts(&tallies)
                .iter()
                .map(spectrum_doubt)
                .collect::<Vec<_>>(),
            timing,
        ))
    };
    let (all, warnings, timing) = watched(py, threads, work)?.map_err(raised_all)?;
    let made = |(name, column): (&'static str, Column)| {
        let (kind, data, texts) = column.finish(py)?;
        Ok((name, kind, data, texts))
    };
    let made: PyResult<Vec<Made<'py>>> = all.into_iter().map(made).collect();
    Ok((made?, warnings, (timing.solve_s, timing.block_steps)))
}
