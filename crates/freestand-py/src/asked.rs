//! What Python asks: values by key, motions in memory, and files.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use freestand_app::files::{Content, Files, Sent};
use freestand_app::request::{Request, from_entries};
use freestand_input::problem::Problem;
use freestand_input::written::Written;
use freestand_scan::mesh::Mesh;
use freestand_study::recorded::ReadMotion;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use serde_json::{Map, Number, Value};

use crate::arguments::{doubles, words_of};
use crate::errors::raised;

/// Files by the keys that name them.
pub(crate) type Named = HashMap<String, NamedFile>;

/// What Python names as a file.
#[derive(FromPyObject)]
pub(crate) enum NamedFile {
    /// A path, or the text of the file.
    #[pyo3(transparent)]
    File((Option<PathBuf>, Option<String>)),
    /// The coordinates of the vertices of a mesh, and the numbers of those of its triangles.
    #[pyo3(transparent)]
    Mesh((Vec<u8>, Vec<u8>)),
}

impl NamedFile {
    fn content(self) -> PyResult<Option<Content>> {
        Ok(match self {
            Self::File((Some(path), _)) => Some(Content::At(path)),
            Self::File((None, Some(text))) => Some(Content::Text(text)),
            Self::File((None, None)) => None,
            Self::Mesh((vertices, faces)) => {
                let mesh = mesh(&vertices, &faces).map_err(raised)?;
                Some(Content::Mesh(Arc::new(mesh)))
            }
        })
    }
}

fn mesh(vertices: &[u8], faces: &[u8]) -> Result<Mesh, Problem> {
    let (vertices, faces) = (doubles(vertices), doubles(faces));
    let faces: Vec<usize> = faces.into_iter().map(|one| one as usize).collect();
    Mesh::of_triangles(vertices.as_chunks().0, faces.as_chunks().0)
}

/// A request whose files are on the disk.
pub(crate) fn typed<R: Request>(values: &Bound<'_, PyDict>) -> PyResult<R> {
    from_entries(&entries(values)?).map_err(raised)
}

fn entries(values: &Bound<'_, PyDict>) -> PyResult<Map<String, Value>> {
    let entry =
        |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| Ok((key.extract()?, written(&value)));
    values.iter().map(entry).collect()
}

/// Gives a key the numbers of an array, if there are any.
pub(crate) fn fill(list: &mut Option<Written>, numbers: &[u8]) {
    if !numbers.is_empty() {
        let all = doubles(numbers).into_iter().map(Written::Number);
        *list = Some(Written::List(all.collect()));
    }
}

/// A request, and what it names. A motion has the key that names it.
pub(crate) fn asked<R: Request>(
    values: &Bound<'_, PyDict>,
    motions: impl IntoIterator<Item = (&'static str, ReadMotion)>,
    files: Named,
) -> PyResult<(R, Files)> {
    let mut entries = entries(values)?;
    let mut sent: Vec<Sent> = Vec::new();
    for (key, motion) in motions {
        let called = format!("{key} {}", sent.len() + 1);
        let list = entries
            .entry(key)
            .or_insert_with(|| Value::Array(Vec::new()));
        if let Value::Array(list) = list {
            list.push(called.as_str().into());
        }
        sent.push(Sent {
            name: called,
            content: Content::Motion(Box::new(motion)),
        });
    }
    for (key, file) in files {
        let Some(content) = file.content()? else {
            continue;
        };
        entries.insert(key.clone(), key.as_str().into());
        sent.push(Sent { name: key, content });
    }
    // A key of one value has no list.
    for list in entries.values_mut() {
        if let Value::Array(all) = list
            && let [Value::String(one)] = all.as_slice()
            && sent.iter().any(|sent| sent.name == *one)
        {
            *list = one.as_str().into();
        }
    }
    let request = from_entries(&entries).map_err(raised)?;
    Ok((request, Files::Sent(sent)))
}

/// A value as a request reads it; what is no value of a request is shown as Python writes it.
fn written(value: &Bound<'_, PyAny>) -> Value {
    if value.is_none() {
        return Value::Null;
    }
    // Also NumPy's.
    if let Ok(flag) = value.extract::<bool>() {
        return flag.into();
    }
    if let Ok(text) = value.cast::<PyString>() {
        return text.to_string_lossy().into_owned().into();
    }
    if let Ok(whole) = value.extract::<i64>() {
        return whole.into();
    }
    if let Ok(whole) = value.extract::<u64>() {
        return whole.into();
    }
    if let Ok(number) = value.extract::<f64>() {
        return Number::from_f64(number).map_or_else(|| number.to_string().into(), Value::Number);
    }
    if value.is_instance_of::<PyDict>() {
        return Value::Object(Map::new());
    }
    match value.try_iter() {
        Ok(all) => all.flatten().map(|one| written(&one)).collect(),
        Err(_) => words_of(value).into(),
    }
}
