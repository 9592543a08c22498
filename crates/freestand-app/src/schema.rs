//! JSON schemas (draft 2020-12) of requests and responses, from the structs that they describe.

use clap::{Arg, ArgAction, Command};
use freestand_output::answer::object;
use schemars::generate::SchemaSettings;
use schemars::transform::transform_subschemas;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

use crate::request::{Request, names_of, unit_endings};

const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The schema of a request of `command`; `others` are its keys that are flags of every command.
pub fn of_request<R: Request>(command: &str, others: &[&str]) -> Value {
    let flags = R::augment_args(Command::new("request"));
    let names: Vec<String> = flags
        .get_arguments()
        .map(|arg| arg.get_id().to_string())
        .collect();
    let others = others.iter().map(|key| (*key).to_owned());
    let properties: Map<String, Value> = flags
        .get_arguments()
        .flat_map(|arg| {
            let value = of_value(arg, &names);
            names_of(arg)
                .into_iter()
                .map(move |name| (name, value.clone()))
        })
        .chain(others.map(|key| (key, json!({"type": ["string", "number"]}))))
        .collect();
    let in_units = format!("^({})({})$", names.join("|"), unit_endings().join("|"));
    json!({
        "$schema": DRAFT,
        "title": format!("What {command} is asked"),
        "description": "A number is in SI, a text has its unit. A key may end in the unit of its number: height_m. \
                        A refused request gets all its problems at once.",
        "type": "object",
        "properties": properties,
        "patternProperties": {in_units: {"type": ["number", "string", "array"]}},
        "additionalProperties": false,
    })
}

/// The schema of a value, by the flag of the command line.
fn of_value(arg: &Arg, names: &[String]) -> Value {
    let one = ["string", "number"];
    let takes_several = arg
        .get_num_args()
        .is_some_and(|count| count.max_values() > 1);
    let mut schema = match arg.get_action() {
        ArgAction::SetTrue => json!({"type": "boolean"}),
        ArgAction::Append => json!({"type": ["string", "number", "array"], "items": {"type": one}}),
        _ if takes_several => json!({"type": ["string", "array"], "items": {"type": "string"}}),
        _ if is_pair(arg) => json!({"type": ["string", "array"], "items": {"type": one}}),
        _ => json!({"type": one}),
    };
    let choices: Vec<String> = arg
        .get_possible_values()
        .iter()
        .map(|choice| choice.get_name().to_owned())
        .collect();
    if !choices.is_empty() && !matches!(arg.get_action(), ArgAction::SetTrue) {
        schema = json!({"type": "string", "enum": choices});
    }
    let help = arg.get_long_help().or(arg.get_help());
    if let Some(help) = help {
        schema["description"] = keys_in(&help.to_string(), names).into();
    }
    schema
}

/// Whether its value may be a list.
fn is_pair(arg: &Arg) -> bool {
    let names = arg.get_value_names().unwrap_or_default();
    names.iter().any(|name| {
        [", ", "GRID", "LIST"]
            .iter()
            .any(|list| name.contains(list))
    })
}

/// A help with the flags of the request as keys.
fn keys_in(help: &str, names: &[String]) -> String {
    let mut names: Vec<&String> = names.iter().collect();
    // The longer one first, where one begins with another.
    names.sort_by_key(|name| std::cmp::Reverse(name.len()));
    names.iter().fold(help.to_owned(), |text, name| {
        text.replace(&format!("--{}", name.replace('_', "-")), name)
    })
}

/// The schema of a struct whose keys are its fields, with their comments.
pub fn of_fields<T: JsonSchema>() -> Value {
    let mut settings = SchemaSettings::draft2020_12().for_serialize();
    settings.inline_subschemas = true;
    settings.meta_schema = None;
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    as_written(&mut schema);
    schema.to_value()
}

/// Numbers as they are written: what is not finite is `null`; brackets as they are in plain text.
fn as_written(schema: &mut Schema) {
    schema.remove("title");
    schema.remove("format");
    if let Some(kind) = schema.get_mut("type") {
        let is_number = |one: &Value| one == "number";
        match kind {
            Value::Array(kinds) if kinds.iter().any(is_number) => {
                kinds.retain(|one| one != "null");
                kinds.push("null".into());
            }
            kind if is_number(kind) => *kind = json!(["number", "null"]),
            _ => {}
        }
    }
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text
            .replace("\\[", "[")
            .replace("\\]", "]")
            .replace('\n', " ");
    }
    transform_subschemas(&mut as_written, schema);
}

/// The schema of a response of `command`: `kinds` are the results that it may have.
pub fn of_response(command: &str, schema: &str, kinds: &[Value]) -> Value {
    answered(command, json!({"const": schema}), kinds)
}

/// As [`of_response`], of a command whose kinds of responses have schemas of their own.
pub fn of_responses(command: &str, kinds: [(&str, Map<String, Value>); 2]) -> Value {
    let names = kinds.each_ref().map(|(schema, _)| *schema);
    let kinds = kinds.map(|(schema, mut kind)| {
        kind.insert("schema".to_owned(), json!({"const": schema}));
        object(kind)
    });
    answered(command, json!({"enum": names}), &kinds)
}

/// The values of a response with rows, and `others` beside them.
pub fn with_rows(row: Value, others: Map<String, Value>) -> Map<String, Value> {
    let rows = json!({"type": "array", "items": row});
    [("rows".to_owned(), rows)]
        .into_iter()
        .chain(others)
        .collect()
}

fn answered(command: &str, schema: Value, kinds: &[Value]) -> Value {
    let of_all = json!({
        "schema": schema,
        "warnings": {"type": "array", "items": {"type": "string"}},
    });
    json!({
        "$schema": DRAFT,
        "title": format!("What {command} answers"),
        "description": "Numbers are in SI; a key ends in its unit. A value that does not exist is null.",
        "type": "object",
        "properties": of_all,
        "required": ["schema", "warnings"],
        "anyOf": kinds,
    })
}
