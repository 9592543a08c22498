//! The documents of commands are those that docs/schema describes.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value, json};

use crate::program::{execute, folder, json as printed};
use crate::{RECORD, SMALL};

/// What is wrong with a value, by the keywords that the schemas use; a key that is not described is wrong, too.
fn problems(value: &Value, schema: &Value, at: &str) -> Vec<String> {
    let said = |key: &str| {
        schema
            .get(key)
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
    };
    let mut found = Vec::new();
    let has_type = |kind: &Value| match kind.as_str() {
        Some("null") => value.is_null(),
        Some("boolean") => value.is_boolean(),
        Some("integer") => value.is_u64(),
        Some("number") => value.is_number(),
        Some("string") => value.is_string(),
        Some("array") => value.is_array(),
        _ => value.is_object(),
    };
    let fits = match schema.get("type") {
        Some(Value::Array(kinds)) => kinds.iter().any(has_type),
        Some(kind) => has_type(kind),
        None => true,
    };
    let is_one = schema.get("const").is_none_or(|one| one == value)
        && (schema.get("enum").is_none() || said("enum").any(|one| one == value));
    if !fits || !is_one {
        found.push(format!("{at}: {value}"));
    }
    let choices = said("anyOf").map(|one| problems(value, one, at));
    found.extend(choices.min_by_key(Vec::len).unwrap_or_default());
    for (index, one) in value.as_array().into_iter().flatten().enumerate() {
        if let Some(schema) = schema.get("items") {
            found.extend(problems(one, schema, &format!("{at}[{index}]")));
        }
    }
    let (Some(values), true) = (value.as_object(), schema.get("anyOf").is_none()) else {
        return found;
    };
    let missing = said("required").filter_map(Value::as_str);
    let missing = missing.filter(|key| !values.contains_key(*key));
    found.extend(missing.map(|key| format!("{at}: {key} is missing")));
    for (key, value) in values {
        let at = format!("{at}.{key}");
        let of_key = schema.get("properties").and_then(|all| all.get(key));
        match of_key.or_else(|| schema.get("additionalProperties")) {
            Some(schema) => found.extend(problems(value, schema, &at)),
            None => found.push(format!("{at} is not described")),
        }
    }
    found
}

/// Runs a command, whose document must be as docs/schema says.
fn check(folder: &Path, name: &str, args: &str) -> Value {
    let file = format!(
        "{}/../../docs/schema/{name}.response.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let schema: Value = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
    let of_all = schema["properties"].as_object().unwrap();
    let kinds = schema["anyOf"].as_array().unwrap().iter().map(|kind| {
        let own = kind["properties"].as_object().unwrap();
        let all: Map<String, Value> = of_all.clone().into_iter().chain(own.clone()).collect();
        let mut kind = kind.clone();
        kind["properties"] = Value::from(all);
        kind
    });
    let args: Vec<&str> = args.split(' ').chain(["--json"]).collect();
    let document = printed(&execute(folder, &args));
    let schema = json!({"anyOf": kinds.collect::<Vec<Value>>()});
    assert_eq!(
        problems(&document, &schema, name),
        Vec::<String>::new(),
        "{args:?}"
    );
    document
}

#[test]
fn spectra_are_as_described() {
    let folder = folder(&[("pulse.csv", RECORD)]);
    let grid = "spectrum --motion pulse.csv --heights 1m,2m --thicknesses 0.2m,0.3m";
    for flags in [
        "",
        " --sensitivity --wall-gap 20mm",
        " --mass 150kg --stiffness 4380N/mm --wall-gap 20mm --wall-stiffness 1000N/mm",
        " --casters --brakes --friction 0.25",
    ] {
        check(folder.path(), "spectrum", &format!("{grid}{flags}"));
    }
}

#[test]
fn runs_are_as_described() {
    let synthetic = "[ground]\ncount = 2\n[objects]\nheights = \"1 m\"\nthicknesses = \"200 mm\"\n\
                     [outputs]\nfigures = false\nreport = false\n";
    let simulated = synthetic.replace(
        "count = 2",
        "count = 2\npoint_source = { magnitude = 6.0, distance = \"30 km\" }",
    );
    let on_floors = SMALL
        .replace("[ground]\nmotions = [\"pulse.csv\"]\n", "")
        .replace(
            "level_ratio = 1.0",
            "level_ratio = 1.0, motions = [\"pulse.csv\"]",
        )
        .replace("storeys = 4\nperiod = \"0.5 s\"\n", "");
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("recorded.toml", SMALL),
        ("synthetic.toml", synthetic),
        ("simulated.toml", &simulated),
        ("floors.toml", &on_floors),
    ]);
    for args in [
        "recorded.toml --out recorded",
        "synthetic.toml --out synthetic --vary damping",
        "simulated.toml --out simulated",
        "floors.toml --out floors",
    ] {
        check(folder.path(), "run", &format!("run {args}"));
    }
}

#[test]
fn assessments_are_as_described() {
    let study = format!(
        "{SMALL}[worlds]\nfirst = 2\nmost = 2\nshares = false\n[assessment]\ncompliant = false\n"
    );
    let list =
        "id,floor,height [m],thickness [m],mass [kg],shelf\na,roof,1,0.2,80,7\nb,roof,2,0.5,,\n";
    let folder = folder(&[
        ("pulse.csv", RECORD),
        ("study.toml", &study),
        ("list.csv", list),
    ]);
    let folder = folder.path();
    let args = "assess study.toml --inventory list.csv --out whole";
    let whole = check(folder, "assess", args);
    assert_eq!(whole["rows"].as_array().map(Vec::len), Some(2));
    check(folder, "assess", &format!("{args} --resume"));
    let plan = "shard plan study.toml --inventory list.csv --shards 2 --out plan";
    check(folder, "shard-plan", plan);
    check(folder, "shard-run", "shard run plan --shard 0");
    let merge = "shard merge plan --out merged";
    assert_eq!(check(folder, "shard-merge", merge)["missing"], json!([1]));
    check(folder, "shard-run", "shard run plan --shard 1");
    assert_eq!(check(folder, "shard-merge", merge)["rows"], whole["rows"]);
}
