//! A grid of objects under many motions, as columns.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};

use freestand::block::Block;
use freestand::respond::Settings;
use freestand::rocking::{Base, Restitution, RockingModel};
use freestand_input::problem::{Problem, Problems};
use freestand_output::facts::{Facts, Value};
use freestand_study::rock::{ACCURACIES, MODELS};
use freestand_study::spectrum::{
    Grid, SpectrumChunk, SpectrumMotion, SpectrumRequest, SpectrumTally, chunk_objects,
    spectrum as calculated,
};
use freestand_study::unsolved::rocking_problem;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::Given;
use crate::errors::{raised, raised_all};
use crate::motion::Record;
use crate::rock::{restitution, surface, walls};
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
    values: &Bound<'py, PyDict>,
    threads: Option<usize>,
) -> PyResult<Answer<'py>> {
    let mut given = Given::new(values);
    let heights_m = given.numbers("heights_m").unwrap_or_default();
    let thicknesses_m = given.numbers("thicknesses_m").unwrap_or_default();
    let mass_kg = given.positive("mass_kg");
    let words = given.cushion_words();
    let edge = given.edge(&words, mass_kg);
    let model = given.choice("model", MODELS).unwrap_or_default();
    let first = heights_m
        .first()
        .zip(thicknesses_m.first())
        .and_then(|(&h, &t)| Block::uniform(h, t).ok());
    let (walls, wall) = walls(&mut given, first.as_ref(), mass_kg);
    if mass_kg.is_some() != (!words.is_empty() || wall.stiffness_n_m.is_some()) {
        let message = "the shock needs both the mass and the cushion of the objects";
        given.push(Problem::value(
            message,
            "give mass_kg and stiffness_n_m (or another cushion), or neither",
        ));
    }
    if !walls.is_none() && model == RockingModel::Linearised {
        let message = "the linearised equation of motion has no walls";
        given.push(Problem::value(message, "leave model out, or the walls"));
    }
    let grid = if given.flag("pairs") {
        Grid::pairs(heights_m, thicknesses_m)
    } else {
        Grid::new(heights_m, thicknesses_m)
    };
    let grid = given.keep(grid);
    let blocks = || {
        grid.iter()
            .flat_map(|grid| grid.blocks(0..grid.objects()))
            .collect::<Vec<Block>>()
    };
    let restitution = restitution(&mut given, blocks);
    let settings = Settings {
        model,
        accuracy: given.choice("accuracy", ACCURACIES).unwrap_or_default(),
        ..Settings::default()
    };
    let sensitivity = given.flag("sensitivity");
    let surface = if given.flag("sliding") {
        surface(&mut given)
    } else {
        None
    };
    if surface.is_some() && (mass_kg.is_some() || sensitivity || !walls.is_none()) {
        let message = "the shock, the sensitivity and walls are those of objects that rock, and these slide or roll";
        given.push(Problem::value(
            message,
            "leave mass_kg, the cushion, sensitivity and walls out",
        ));
    }
    given.finish()?;
    let Some(grid) = grid else {
        return Err(raised_all(Problems::default()));
    };
    let request = SpectrumRequest {
        grid,
        restitution,
        walls,
        settings,
        cushion: mass_kg.zip(edge),
        wall,
        sensitivity,
        surface,
    };
    let of_rocking = [
        (
            "restitution",
            matches!(request.restitution, Restitution::Value(_)),
        ),
        (
            "restitution_factor",
            matches!(request.restitution, Restitution::Factor(_)),
        ),
        ("model", request.settings.model == RockingModel::Linearised),
    ];
    if let Some((name, _)) = of_rocking
        .into_iter()
        .find(|(_, is_given)| *is_given && request.none_rocks())
    {
        let message = format!("{name} has no effect: every object slides or rolls, and none rocks");
        return Err(raised(Problem::value(message, "leave it out")));
    }
    let taken = |(name, horizontal, vertical): &(
        String,
        PyRef<'py, Record>,
        Option<PyRef<'py, Record>>,
    )| {
        let vertical = vertical.as_ref().map(|record| record.motion().clone());
        SpectrumMotion {
            name: name.clone(),
            horizontal: horizontal.motion().clone(),
            vertical,
        }
    };
    let motions: Vec<SpectrumMotion> = motions.iter().map(taken).collect();
    for motion in &motions {
        let base = Base {
            horizontal: Some(&motion.horizontal),
            vertical: motion.vertical.as_ref(),
        };
        base.check()
            .map_err(|error| raised_all(rocking_problem(error)))?;
    }
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
        Ok::<_, Problem>((all, request.warnings(&tallies), timing))
    };
    let (all, warnings, timing) = watched(py, threads, work)?.map_err(raised_all)?;
    let made = |(name, column): (&'static str, Column)| {
        let (kind, data, texts) = column.finish(py)?;
        Ok((name, kind, data, texts))
    };
    let made: PyResult<Vec<Made<'py>>> = all.into_iter().map(made).collect();
    Ok((made?, warnings, (timing.solve_s, timing.block_steps)))
}
