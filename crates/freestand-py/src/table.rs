//! Columns as an Arrow stream (the Arrow PyCapsule interface), without a copy: the buffers are bytes
//! that Python owns.

use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::types::Int32Type;
use arrow_array::{
    Array, ArrayRef, BooleanArray, DictionaryArray, Float64Array, Int32Array, Int64Array,
    RecordBatch, RecordBatchIterator, StringArray,
};
use arrow_buffer::{BooleanBuffer, Buffer, NullBuffer, ScalarBuffer};
use arrow_schema::{ArrowError, Field, Schema};
use bytes::Bytes;
use freestand_input::problem::{Problem, ProblemKind};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyCapsule;

use crate::errors::raised;

/// A column: its name, its kind, its values, and the texts that those of a text column count.
type Column = (String, String, PyBackedBytes, Vec<String>);

/// The columns as one record batch. Kinds and what is missing in them: `number`, doubles, NaN;
/// `count`, 64-bit, negative; `flag`, bytes, 255; `text`, 32-bit indices of texts, negative.
#[pyfunction]
pub(crate) fn arrow_stream<'py>(
    py: Python<'py>,
    columns: Vec<Column>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let defect = |error: ArrowError| {
        let message = format!("the table cannot be passed on: {error}");
        raised(
            Problem::new(ProblemKind::Computation, message)
                .hint("this is a defect of freestand; please report it"),
        )
    };
    let (mut fields, mut arrays) = (Vec::new(), Vec::new());
    for (name, kind, data, texts) in columns {
        let array = array(&kind, data, texts).map_err(defect)?;
        fields.push(Field::new(name, array.data_type().clone(), true));
        arrays.push(array);
    }
    let schema = Arc::new(Schema::new(fields));
    let batch = RecordBatch::try_new(Arc::clone(&schema), arrays).map_err(defect)?;
    let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(batch)], schema)));
    PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
}

fn array(kind: &str, data: PyBackedBytes, texts: Vec<String>) -> Result<ArrayRef, ArrowError> {
    let length = data.len();
    let buffer = Buffer::from(Bytes::from_owner(data));
    // A validity map only where something is missing.
    let nulls =
        |map: BooleanBuffer| Some(NullBuffer::new(map)).filter(|nulls| nulls.null_count() > 0);
    let array: ArrayRef = match kind {
        "number" => {
            let values = ScalarBuffer::<f64>::new(buffer, 0, length / 8);
            let map = values.iter().map(|value| !value.is_nan()).collect();
            Arc::new(Float64Array::try_new(values, nulls(map))?)
        }
        "count" => {
            let values = ScalarBuffer::<i64>::new(buffer, 0, length / 8);
            let map = values.iter().map(|value| *value >= 0).collect();
            Arc::new(Int64Array::try_new(values, nulls(map))?)
        }
        "flag" => {
            let map = buffer.iter().map(|value| *value != u8::MAX).collect();
            let values: BooleanBuffer = buffer.iter().map(|value| *value == 1).collect();
            Arc::new(BooleanArray::new(values, nulls(map)))
        }
        "text" => {
            let values = ScalarBuffer::<i32>::new(buffer, 0, length / 4);
            let map = values.iter().map(|value| *value >= 0).collect();
            let indices = Int32Array::try_new(values, nulls(map))?;
            Arc::new(DictionaryArray::<Int32Type>::try_new(
                indices,
                Arc::new(StringArray::from(texts)),
            )?)
        }
        other => {
            return Err(ArrowError::InvalidArgumentError(format!(
                "{other} is not a kind of column"
            )));
        }
    };
    Ok(array)
}
