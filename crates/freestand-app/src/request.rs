//! What all requests have in common: the values that were written, from JSON and from keywords.

use std::collections::BTreeMap;

use clap::{Args, Command};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::nearest;
use freestand_input::written::Written;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

/// Keys that a request does not know; the message names them.
pub type Unknown = BTreeMap<String, IgnoredAny>;

/// A request or a part of one.
pub trait Request: Args + DeserializeOwned {
    /// Adds every value that was written, under its key.
    fn write(&self, words: &mut Words);

    /// All values that were written.
    fn words(&self) -> Words {
        let mut words = Words::default();
        self.write(&mut words);
        words
    }
}

/// Lists the fields of a request: values, then `;` and the parts that it consists of.
macro_rules! request {
    ($name:ident { $($field:ident),* $(,)? $(; $($part:ident),* $(,)?)? }) => {
        impl $crate::request::Request for $name {
            fn write(&self, words: &mut freestand_input::keys::Words) {
                // A field that is not listed is an error here.
                let Self { $($field,)* $($($part,)*)? } = self;
                $( $crate::request::Field::write($field, stringify!($field), words); )*
                $($( $crate::request::Field::write($part, stringify!($part), words); )*)?
            }
        }
    };
}
pub(crate) use request;

/// A field of a request.
pub trait Field {
    /// Adds its value.
    fn write(&self, key: &'static str, words: &mut Words);
}

impl Field for Option<Written> {
    fn write(&self, key: &'static str, words: &mut Words) {
        if let Some(written) = self {
            words.write(key, written);
        }
    }
}

impl Field for Vec<Written> {
    fn write(&self, key: &'static str, words: &mut Words) {
        self.iter().for_each(|written| words.write(key, written));
    }
}

impl Field for Unknown {
    fn write(&self, _: &'static str, _: &mut Words) {}
}

impl<R: Request> Field for R {
    fn write(&self, _: &'static str, words: &mut Words) {
        Request::write(self, words);
    }
}

/// One value or a list of them.
pub(crate) fn one_or_many<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Written>, D::Error> {
    Ok(match Option::<Written>::deserialize(from)? {
        None => Vec::new(),
        Some(Written::List(all)) => all,
        Some(one) => vec![one],
    })
}

/// The keys of a request, in the order of their definition.
pub fn keys<R: Request>() -> Vec<String> {
    let command = R::augment_args(Command::new("request"));
    let ids = command.get_arguments().map(|arg| arg.get_id().to_string());
    ids.collect()
}

/// A request from values by key, as a program gives them. `-` in a key is read as `_`, and a bare number under
/// a key that ends in a unit is in that unit: `height_m`, `tolerance_g`.
///
/// # Errors
/// The same key twice, such as with and without its unit.
pub fn from_entries<R: Request>(entries: &Map<String, Value>) -> Result<R, Problem> {
    let known = keys::<R>();
    let mut found = Map::new();
    for (given, value) in entries {
        let plain = given.replace('-', "_");
        let (key, value) = match in_unit(&plain, &known) {
            Some((key, unit)) => (key, with_unit(value, unit)),
            None => (plain, value.clone()),
        };
        if found.contains_key(&key) {
            let message = format!("{key} is given twice");
            return Err(Problem::value(message, format!("leave {given} out")).of_key(key));
        }
        found.insert(key, value);
    }
    serde_json::from_value(Value::Object(found)).map_err(|error| {
        // Every value can be read: what is left is a defect of this program.
        Problem::new(ProblemKind::Computation, error.to_string())
            .hint("this is a defect of freestand; please report it")
    })
}

/// Bare numbers with a unit.
fn with_unit(value: &Value, unit: &str) -> Value {
    match value {
        Value::Number(number) => format!("{number} {unit}").trim_end().into(),
        Value::Array(all) => all.iter().map(|one| with_unit(one, unit)).collect(),
        other => other.clone(),
    }
}

/// The key and the unit of a key that states its unit.
fn in_unit(given: &str, known: &[String]) -> Option<(String, &'static str)> {
    if known.iter().any(|key| key == given) {
        return None;
    }
    let split = |key: &String| Some((key.clone(), unit(given.strip_prefix(key.as_str())?)?));
    known.iter().find_map(split)
}

/// The unit of an ending: `_m`, `_n_s_m`; nothing for a ratio.
fn unit(ending: &str) -> Option<&'static str> {
    const ENDINGS: [(&str, &str); 16] = [
        ("_ratio", ""),
        ("_m", "m"),
        ("_kg", "kg"),
        ("_s", "s"),
        ("_g", "g"),
        ("_m_s2", "m/s2"),
        ("_m_s", "m/s"),
        ("_n", "N"),
        ("_n_m", "N/m"),
        ("_n_s_m", "N s/m"),
        ("_s_m", "s/m"),
        ("_hz", "Hz"),
        ("_rad", "rad"),
        ("_deg", "deg"),
        ("_rad_s", "rad/s"),
        ("_kg_m2", "kg m2"),
    ];
    ENDINGS
        .iter()
        .find(|(name, _)| *name == ending)
        .map(|(_, unit)| *unit)
}

/// A problem for each key that the request does not know.
pub(crate) fn unknown<R: Request>(unknown: &Unknown) -> impl Iterator<Item = Problem> {
    let known = keys::<R>();
    unknown.keys().map(move |key| {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let hint = match nearest(key, &known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "leave it out".to_owned(),
        };
        Problem::value(format!("`{key}` is not known"), hint).of_key(key.clone())
    })
}
