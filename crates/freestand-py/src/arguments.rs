//! Arguments from Python: numbers in SI, and the texts that requests read by key.

use std::path::{Path, PathBuf};

use freestand_input::keys::{Words, argument_key};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{is_possible, too_large};
use freestand_input::words::shortest;
use freestand_output::facts::{Facts, Value};
use freestand_output::json::document;
use freestand_study::cushion::{self, EdgeCushion, read_cushion_file, with_file};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString};
use serde::Serialize;

use crate::errors::{raised, raised_all};

/// The arguments of a call that were given, by name, and the problems with them so far.
pub(crate) struct Given<'a, 'py> {
    values: &'a Bound<'py, PyDict>,
    problems: Problems,
}

impl<'a, 'py> Given<'a, 'py> {
    pub(crate) fn new(values: &'a Bound<'py, PyDict>) -> Self {
        Self {
            values,
            problems: Problems::default(),
        }
    }

    /// The value; `None` where it is missing or `None`.
    fn value(&self, name: &str) -> Option<Bound<'py, PyAny>> {
        self.values
            .get_item(name)
            .ok()
            .flatten()
            .filter(|value| !value.is_none())
    }

    fn wrong(&mut self, name: &str, expected: &str) {
        let shown = self
            .value(name)
            .map_or_else(String::new, |value| words_of(&value));
        let message = format!("{name} must be {expected}, not {shown}");
        self.problems.push(Problem::value(
            message,
            format!("give {name} as {expected}"),
        ));
    }

    pub(crate) fn push(&mut self, problem: Problem) {
        self.problems.push(problem);
    }

    /// The value of a result; its problems are collected.
    pub(crate) fn keep<T>(&mut self, result: Result<T, impl Into<Problems>>) -> Option<T> {
        self.problems.keep(result)
    }

    fn accepted(
        &mut self,
        name: &str,
        accept: impl Fn(f64) -> bool,
        expected: &str,
    ) -> Option<f64> {
        let value = self.value(name)?;
        // A truth value is a number to Python, and a mistake here.
        let number = if value.is_instance_of::<PyBool>() {
            None
        } else {
            value.extract::<f64>().ok()
        };
        if let Some(number) = number.filter(|number| number.is_finite() && !is_possible(*number)) {
            let mut problem = too_large(&shortest(number));
            problem.message = format!("{name}: {}", problem.message);
            self.problems.push(problem);
            return None;
        }
        let number = number.filter(|number| number.is_finite() && accept(*number));
        if number.is_none() {
            self.wrong(name, expected);
        }
        number
    }

    /// Any number.
    pub(crate) fn number(&mut self, name: &str) -> Option<f64> {
        self.accepted(name, |_| true, "a finite number, in SI units")
    }

    /// A number above zero.
    pub(crate) fn positive(&mut self, name: &str) -> Option<f64> {
        self.accepted(name, |value| value > 0.0, "a number above 0, in SI units")
    }

    pub(crate) fn text(&mut self, name: &str) -> Option<String> {
        let value = self.value(name)?;
        let text = value.extract::<String>().ok();
        if text.is_none() {
            self.wrong(name, "a text");
        }
        text
    }

    /// The texts of the dictionary called `name`, by the keys that requests know.
    pub(crate) fn words(&mut self, name: &str) -> Words {
        let Some(value) = self.value(name) else {
            return Words::default();
        };
        let Ok(entries) = value.cast_into::<PyDict>() else {
            self.wrong(name, "a dictionary");
            return Words::default();
        };
        let mut words = Words::default();
        for (argument, value) in &entries {
            let argument = argument.extract::<String>().unwrap_or_default();
            let Some((key, unit)) = argument_key(&argument) else {
                let hint = "this is a defect of the Python layer; please report it";
                self.problems.push(Problem::value(
                    format!("{argument} is not an argument"),
                    hint,
                ));
                continue;
            };
            match texts(&value, unit) {
                // Layers are values of their own, and others are one list.
                Some(texts) if key == "series_stiffness" => texts
                    .into_iter()
                    .for_each(|text| words.add(key, text, None)),
                Some(texts) if texts.is_empty() => {}
                Some(texts) => words.add(key, texts.join(", "), None),
                None => {
                    let shown = words_of(&value);
                    let problem = Problem::value(
                        format!("{argument} must be a finite number, not {shown}"),
                        "give one",
                    );
                    self.problems.push(problem);
                }
            }
        }
        words
    }

    /// The words of a cushion, with those of its file or of the pad of a drop test.
    pub(crate) fn cushion_words(&mut self) -> Words {
        let words = self.words("cushion");
        let file = match (
            words.get("cushion").map(PathBuf::from),
            self.text("pad_toml"),
        ) {
            (Some(path), _) => self.keep(read_cushion_file(&path)).map(|(file, _)| file),
            (None, Some(toml)) => self.keep(cushion::pad_words(&toml, Path::new("cushion.toml"))),
            (None, None) => return words,
        };
        let joined = file.map(|file| with_file(&words, file));
        joined
            .and_then(|joined| self.keep(joined))
            .unwrap_or_default()
    }

    /// The cushion under one edge; `None` if no argument describes it, or one is wrong.
    pub(crate) fn edge(&mut self, words: &Words, mass_kg: Option<f64>) -> Option<EdgeCushion> {
        if words.is_empty() {
            None
        } else {
            self.keep(cushion::resolve(words, mass_kg))
        }
    }

    /// Fails if there was any problem.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.problems.finish(Some(())).map_err(raised_all)
    }
}

/// The texts of a value in a unit: one, or one for each member of a list.
fn texts(value: &Bound<'_, PyAny>, unit: &str) -> Option<Vec<String>> {
    if let Ok(text) = value.cast::<PyString>() {
        return Some(vec![text.to_string_lossy().into_owned()]);
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Some(if flag.is_true() {
            vec!["true".to_owned()]
        } else {
            Vec::new()
        });
    }
    if let Ok(list) = value.cast::<PyList>() {
        let each: Option<Vec<Vec<String>>> = list.iter().map(|one| texts(&one, unit)).collect();
        return each.map(|each| each.concat());
    }
    if let Ok(whole) = value.extract::<i64>() {
        return Some(vec![format!("{whole}{unit}")]);
    }
    let number = value
        .extract::<f64>()
        .ok()
        .filter(|number| number.is_finite())?;
    Some(vec![format!("{number}{unit}")])
}

/// A value of Python in a message.
pub(crate) fn words_of(value: &Bound<'_, PyAny>) -> String {
    let text = value.repr().map_or_else(
        |_| "this value".to_owned(),
        |text| text.to_string_lossy().into_owned(),
    );
    freestand_input::quantity::shorten(&text)
}

/// Numbers of an array of doubles in the byte order of the machine.
pub(crate) fn doubles(bytes: &[u8]) -> Vec<f64> {
    let (each, _) = bytes.as_chunks::<8>();
    each.iter()
        .map(|bytes| f64::from_ne_bytes(*bytes))
        .collect()
}

/// The bytes of doubles.
pub(crate) fn bytes(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    let each: Vec<[u8; 8]> = values.into_iter().map(f64::to_ne_bytes).collect();
    each.into_flattened()
}

/// Facts as a dictionary, without those that `is_left_out` names.
pub(crate) fn dictionary<'py>(
    py: Python<'py>,
    facts: &Facts<'_>,
    is_left_out: impl Fn(&str) -> bool + Copy,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (name, value) in facts.named().filter(|(name, _)| !is_left_out(name)) {
        found.set_item(PyString::intern(py, name), object(py, value)?)?;
    }
    Ok(found)
}

fn object<'py>(py: Python<'py>, value: &Value<'_>) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Missing => py.None().into_bound(py),
        Value::Text(text) => PyString::new(py, text).into_any(),
        // As in a document, where a number that is not finite is null.
        Value::Number(number) | Value::NumberOr(Some(number), _) if !number.is_finite() => {
            py.None().into_bound(py)
        }
        Value::Number(number) | Value::NumberOr(Some(number), _) => {
            number.into_pyobject(py)?.into_any()
        }
        Value::NumberOr(None, word) => PyString::new(py, word).into_any(),
        Value::Count(count) => count.into_pyobject(py)?.into_any(),
        Value::Flag(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::List(values) => {
            let each: PyResult<Vec<_>> = values.iter().map(|value| object(py, value)).collect();
            PyList::new(py, each?)?.into_any()
        }
        Value::Facts(facts) => dictionary(py, facts, |_| false)?.into_any(),
    })
}

/// The document that the command prints with `--json`, as text.
pub(crate) fn told<T: Serialize>(schema: &str, body: &T, warnings: &[String]) -> PyResult<String> {
    document(schema, body, warnings).map_err(raised)
}
