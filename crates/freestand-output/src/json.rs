//! The JSON document of a command.

use freestand_input::{Problem, ProblemKind};
use serde::Serialize;
use serde_json::{Map, Value};

/// One JSON document: the keys of `body` between `schema` and `warnings`; a number that is not
/// finite is `null`.
///
/// # Errors
/// A body that is not JSON: a defect.
pub fn document<T: Serialize>(
    schema: &str,
    body: &T,
    warnings: &[String],
) -> Result<String, Problem> {
    let not_json = |error: serde_json::Error| {
        Problem::new(
            ProblemKind::Computation,
            format!("the result is not JSON: {error}"),
        )
        .hint("this is a defect of freestand; please report it")
    };
    let mut all = Map::new();
    all.insert("schema".to_owned(), Value::from(schema));
    match serde_json::to_value(body).map_err(not_json)? {
        Value::Object(keys) => all.extend(keys),
        other => {
            all.insert("result".to_owned(), other);
        }
    }
    all.insert("warnings".to_owned(), Value::from(warnings));
    let mut text = serde_json::to_string_pretty(&all).map_err(not_json)?;
    text.push('\n');
    Ok(text)
}
