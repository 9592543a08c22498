//! Results as structs. [`answer!`](crate::answer!) defines one: each field has its name in JSON, CSV and Python, its
//! type, and the label under which people read it; from these follow its document, its text and the
//! schema of its document.

use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value as Json, json};

use crate::answer;
use crate::facts::{Facts, Value};
use crate::table::{Holds, Table};

/// A result that [`answer!`](crate::answer!) defined.
pub trait Answer {
    /// Its values, with names and labels.
    fn facts(&self) -> Facts<'static>;

    /// The names of its values, each with the schema of its value.
    fn properties() -> Map<String, Json>;

    /// Whether it may be missing.
    const IS_OPTIONAL: bool = false;
}

/// A part of a result that may not apply.
impl<A: Answer> Answer for Option<A> {
    fn facts(&self) -> Facts<'static> {
        self.as_ref().map(Answer::facts).unwrap_or_default()
    }

    fn properties() -> Map<String, Json> {
        A::properties()
    }

    const IS_OPTIONAL: bool = true;
}

/// What is told of a struct, by reference.
impl<A: Answer> Answer for &A {
    fn facts(&self) -> Facts<'static> {
        (*self).facts()
    }

    fn properties() -> Map<String, Json> {
        A::properties()
    }

    const IS_OPTIONAL: bool = A::IS_OPTIONAL;
}

/// What a value is in a JSON schema (draft 2020-12).
pub trait Described {
    /// The schema of such a value.
    fn schema() -> Json;
}

impl<A: Answer> Described for A {
    fn schema() -> Json {
        let schema = object(A::properties());
        if A::IS_OPTIONAL {
            or_null(schema)
        } else {
            schema
        }
    }
}

/// The mark of a value that is absent where its part does not apply.
const MAY_BE_ABSENT: &str = "may be absent";

/// The schema of a value that may be absent, among the properties of an [`object`].
pub fn may_be_absent(mut schema: Json) -> Json {
    if let Json::Object(schema) = &mut schema {
        schema.insert(MAY_BE_ABSENT.to_owned(), true.into());
    }
    schema
}

/// The values of a part on the same level.
pub fn flattened<A: Answer>() -> Map<String, Json> {
    let properties = A::properties().into_iter();
    let marked = |(name, schema)| match A::IS_OPTIONAL {
        true => (name, may_be_absent(schema)),
        false => (name, schema),
    };
    properties.map(marked).collect()
}

/// The schema of an object with these values.
pub fn object(mut properties: Map<String, Json>) -> Json {
    let mut required = Vec::new();
    for (name, schema) in &mut properties {
        let mark = schema
            .as_object_mut()
            .and_then(|schema| schema.remove(MAY_BE_ABSENT));
        if mark.is_none() {
            required.push(name.clone());
        }
    }
    json!({"type": "object", "required": required, "properties": properties})
}

/// A value that may be missing: `null`.
fn or_null(mut schema: Json) -> Json {
    match schema.get_mut("type") {
        Some(Json::Array(_)) => {}
        Some(kind) => *kind = json!([kind.take(), "null"]),
        None => schema = json!({"anyOf": [schema, {"type": "null"}]}),
    }
    schema
}

macro_rules! described {
    ($($type:ty = $schema:tt),+ $(,)?) => {$(
        impl Described for $type {
            fn schema() -> Json {
                json!($schema)
            }
        }
        impl Described for Option<$type> {
            fn schema() -> Json {
                or_null(<$type>::schema())
            }
        }
        impl Described for Vec<$type> {
            fn schema() -> Json {
                json!({"type": "array", "items": <$type>::schema()})
            }
        }
    )+};
}

described! {
    // What is not finite is `null` in a document.
    f64 = {"type": ["number", "null"]},
    usize = {"type": "integer"},
    u64 = {"type": "integer"},
    bool = {"type": "boolean"},
    &'static str = {"type": "string"},
    String = {"type": "string"},
    [f64; 2] = {"type": "array", "items": {"type": ["number", "null"]}},
    [usize; 4] = {"type": "array", "items": {"type": "integer"}},
}

impl<A: Answer> Described for Vec<A> {
    fn schema() -> Json {
        json!({"type": "array", "items": A::schema()})
    }
}

impl<A: Answer> Described for Option<Vec<A>> {
    fn schema() -> Json {
        or_null(Vec::<A>::schema())
    }
}

impl Described for Vec<Vec<f64>> {
    fn schema() -> Json {
        json!({"type": "array", "items": Vec::<f64>::schema()})
    }
}

impl Described for Option<Vec<f64>> {
    fn schema() -> Json {
        or_null(Vec::<f64>::schema())
    }
}

impl Described for Option<Vec<String>> {
    fn schema() -> Json {
        or_null(Vec::<String>::schema())
    }
}

answer! {
    /// A file that was read.
    pub struct Input {
        /// Its path.
        path: String,
        /// The SHA-256 of its bytes.
        sha256: String,
    }
}

impl From<&InputFile> for Input {
    fn from(file: &InputFile) -> Self {
        Self {
            path: file.path.display().to_string(),
            sha256: file.sha256.clone(),
        }
    }
}

/// Defines a result as a struct. After `=` stands the label of a field for people; `flat` puts the fields of a
/// part on the same level, `skip` leaves a field out; a field with none of them is for programs only. With `if`
/// people read it where another field has a value.
///
/// `named` before the fields says that their names say enough. Several structs may follow each other.
///
/// With `of` it also says what the values follow from, as [`answer_of!`](crate::answer_of!) does: the struct gets a
/// function `of`, and a value that is not said is the field of that name of its first argument.
///
/// # Example
/// ```
/// use freestand_output::answer;
/// use freestand_output::answer::Answer;
///
/// answer! {
///     /// A landing.
///     pub struct Landing {
///         edge_acceleration_g: Option<f64> = "shock",
///         /// How often an edge landed.
///         impact_count: usize,
///     }
/// }
///
/// let landing = Landing { edge_acceleration_g: Some(2.5), impact_count: 3 };
/// assert_eq!(serde_json::to_string(&landing)?, r#"{"edge_acceleration_g":2.5,"impact_count":3}"#);
/// assert_eq!(landing.facts().lines(), [("shock", "2.500 g".to_owned())]);
/// assert_eq!(Landing::properties()["edge_acceleration_g"]["type"], serde_json::json!(["number", "null"]));
///
/// answer! {
///     /// Where a landing leads.
///     pub struct Rebound of (landing: &Landing, mass_kg: f64) {
///         impact_count: usize;
///         force_n: Option<f64> = landing.edge_acceleration_g.map(|g| 9.81 * g * mass_kg) => "force";
///     }
/// }
///
/// let rebound = Rebound::of(&landing, 2.0);
/// assert_eq!((rebound.impact_count, rebound.facts().lines()), (3, vec![("force", "49.05 N".to_owned())]));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[macro_export]
macro_rules! answer {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $( $(#[doc = $doc:literal])* $field:ident : $type:ty $(= $label:tt $(if $given:ident)?)? ),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name {
            $( $(#[doc = $doc])* $(#[doc = $crate::answer!(@doc $label)])? pub $field: $type, )*
        }

        impl $crate::answer::Answer for $name {
            fn facts(&self) -> $crate::facts::Facts<'static> {
                let facts = $crate::facts::Facts::default();
                $( let facts = $crate::answer!(@add facts, stringify!($field), self.$field, $($label $(, self.$given)?)?); )*
                facts
            }

            fn properties() -> serde_json::Map<String, serde_json::Value> {
                let mut all = serde_json::Map::new();
                $( $crate::answer!(@describe all, $field, $type, concat!($($doc),*), $($label)?); )*
                all
            }
        }

        impl From<$name> for $crate::facts::Value<'static> {
            fn from(answer: $name) -> Self {
                Self::Facts($crate::answer::Answer::facts(&answer))
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::answer::Answer::facts(self).serialize(serializer)
            }
        }
    };
    (
        $(#[$meta:meta])*
        pub struct $name:ident of ($me:ident : $source:ty $(, $other:ident : $kind:ty)* $(,)?) {
            $(
                $(#[doc = $doc:literal])*
                $field:ident : $type:ty $(= $value:expr)? $(=> $label:tt $(if $given:ident)?)?;
            )*
        }
    ) => {
        $crate::answer! {
            $(#[$meta])*
            pub struct $name {
                $( $(#[doc = $doc])* $field: $type $(= $label $(if $given)?)?, )*
            }
        }

        impl $name {
            pub(crate) fn of($me: $source $(, $other: $kind)*) -> Self {
                Self { $( $field: $crate::answer_of!(@value ($me), $field, $($value)?), )* }
            }
        }
    };
    // Names that say enough: those of the document, with their units.
    ($(#[$meta:meta])* pub struct $name:ident named { $($fields:tt)* }) => {
        $crate::answer! {
            $(#[$meta])*
            #[expect(missing_docs, reason = "the names are those of the JSON document and state the units")]
            pub struct $name { $($fields)* }
        }
    };
    // Several.
    ($(#[$meta:meta])* pub struct $name:ident $(of $source:tt)? { $($fields:tt)* } $($more:tt)+) => {
        $crate::answer! { $(#[$meta])* pub struct $name $(of $source)? { $($fields)* } }
        $crate::answer! { $($more)+ }
    };
    ($(#[$meta:meta])* pub struct $name:ident named { $($fields:tt)* } $($more:tt)+) => {
        $crate::answer! { $(#[$meta])* pub struct $name named { $($fields)* } }
        $crate::answer! { $($more)+ }
    };
    (@name __) => { "" };
    (@name $name:ident) => { stringify!($name) };
    (@doc flat) => { "Values on the same level." };
    (@doc skip) => { "Not in the document." };
    (@doc $label:literal) => { $label };
    (@add $facts:ident, $name:expr, $value:expr, ) => { $facts.key($name, $value.clone()) };
    (@add $facts:ident, $name:expr, $value:expr, flat) => {
        $facts.and($crate::answer::Answer::facts(&$value))
    };
    (@add $facts:ident, $name:expr, $value:expr, skip) => { $facts };
    (@add $facts:ident, $name:expr, $value:expr, $label:literal) => {
        $facts.fact($name, $label, $value.clone())
    };
    (@add $facts:ident, $name:expr, $value:expr, ($label:expr)) => {
        $facts.fact($name, $label, $value.clone())
    };
    (@add $facts:ident, $name:expr, $value:expr, $label:literal, $given:expr) => {
        $facts.fact($name, if $given.is_some() { $label } else { "" }, $value.clone())
    };
    // A line for people alone is no value of the document.
    (@describe $all:ident, __, $type:ty, $doc:expr, $label:tt) => {};
    (@describe $all:ident, $name:ident, $type:ty, $doc:expr, flat) => {
        $all.extend($crate::answer::flattened::<$type>());
    };
    (@describe $all:ident, $name:ident, $type:ty, $doc:expr, skip) => {};
    (@describe $all:ident, $name:ident, $type:ty, $doc:expr, ($label:expr)) => {
        $crate::answer!(@describe $all, $name, $type, $doc,)
    };
    (@describe $all:ident, $name:ident, $type:ty, $doc:expr, $($label:literal)?) => {
        let schema = <$type as $crate::answer::Described>::schema();
        $all.insert(stringify!($name).to_owned(), $crate::answer::explained(schema, $doc, concat!($($label)?)));
    };
}

/// Says how a struct is told: the names of its values in JSON, CSV and Python, their types, the values, and after
/// `=>` the label under which people read one, in parentheses if it is calculated; `flat` puts the values of a part on
/// the same level, and a value that is called `__` is a line for people alone. A value that is not said is the field
/// of that name, of the struct itself or of the part that stands behind its name (`as of.0`). With `struct` the struct is
/// defined as well, by what it tells of: `struct OfMotion<'m>(&'m Motion) as of.0`.
///
/// # Example
/// ```
/// use freestand_output::answer::Answer;
/// use freestand_output::answer_of;
///
/// struct Fall {
///     height_m: f64,
/// }
///
/// answer_of!(Fall as fall {
///     height_m: f64 => "height";
///     /// Just before the landing.
///     speed_m_s: f64 = (2.0 * 9.81 * fall.height_m).sqrt();
///     __: &'static str = "no air" => "assumed";
/// });
///
/// let fall = Fall { height_m: 0.5 };
/// assert_eq!(fall.facts().lines(), [("height", "500 mm".to_owned()), ("assumed", "no air".to_owned())]);
/// assert_eq!(Fall::properties()["speed_m_s"]["description"], "Just before the landing.");
/// assert_eq!(serde_json::to_value(&fall)?["height_m"], 0.5);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[macro_export]
macro_rules! answer_of {
    (@value $of:tt, $field:ident,) => { $of.$field.clone() };
    (@value $of:tt, $field:ident, $value:expr) => { $value };
    (@tell $told:ty, $me:ident, $of:tt, { $(
        $(#[doc = $doc:literal])* $field:ident : $type:ty $(= $value:expr)? $(=> $label:tt)?;
    )* }) => {
        impl $crate::answer::Answer for $told {
            fn facts(&self) -> $crate::facts::Facts<'static> {
                let $me = self;
                let facts = $crate::facts::Facts::default();
                $(
                    let value: $type = $crate::answer_of!(@value $of, $field, $($value)?);
                    let facts = $crate::answer!(@add facts, $crate::answer!(@name $field), value, $($label)?);
                )*
                facts
            }

            fn properties() -> serde_json::Map<String, serde_json::Value> {
                let mut all = serde_json::Map::new();
                $( $crate::answer!(@describe all, $field, $type, concat!($($doc),*), $($label)?); )*
                all
            }
        }

        impl From<$told> for $crate::facts::Value<'static> {
            fn from(told: $told) -> Self {
                Self::Facts($crate::answer::Answer::facts(&told))
            }
        }

        impl From<&$told> for $crate::facts::Value<'static> {
            fn from(told: &$told) -> Self {
                Self::Facts($crate::answer::Answer::facts(told))
            }
        }

        impl serde::Serialize for $told {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::answer::Answer::facts(self).serialize(serializer)
            }
        }
    };
    (
        $(#[$meta:meta])*
        $seen:vis struct $name:ident<$life:lifetime>($($of:vis $inner:ty),+) as $($told:tt)+
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy)]
        $seen struct $name<$life>($($of $inner),+);

        $crate::answer_of!($name<'_> as $($told)+);
    };
    ($told:ty as $me:ident { $($values:tt)* }) => {
        $crate::answer_of!(@tell $told, $me, ($me), { $($values)* });
    };
    ($told:ty as $me:ident . $part:tt { $($values:tt)* }) => {
        $crate::answer_of!(@tell $told, $me, ($me.$part), { $($values)* });
    };
}

/// The rows of a table, whose headings are there without a row as well.
///
/// # Errors
/// None in practice: a defect of the writer of CSV.
pub fn table_of<'a, A: Answer + 'a>(
    rows: impl IntoIterator<Item = &'a A>,
) -> Result<Table, Problem> {
    let table = crate::facts::table(rows.into_iter().map(A::facts))?;
    if !table.as_ref().is_empty() {
        return Ok(table);
    }
    let names: Vec<String> = A::properties().keys().cloned().collect();
    let head = format!("{}\n", names.join(",")).into_bytes();
    let columns = names.into_iter().map(|name| (name, Holds::default()));
    Ok(Table::new(head, columns.collect()))
}

/// Values of one kind by names that are not known before.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ByName<A>(pub Vec<(&'static str, A)>);

impl<A: Described> Described for ByName<A> {
    fn schema() -> Json {
        json!({"type": "object", "additionalProperties": A::schema()})
    }
}

impl<A: Into<Value<'static>>> From<ByName<A>> for Value<'static> {
    fn from(named: ByName<A>) -> Self {
        let each = named.0.into_iter();
        Self::Facts(each.fold(Facts::default(), |facts, (name, one)| facts.key(name, one)))
    }
}

impl<A: Into<Value<'static>> + Clone> Serialize for ByName<A> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Value::from(self.clone()).serialize(serializer)
    }
}

/// A schema with what its value is: the comment of its field, or its label.
pub fn explained(mut schema: Json, comment: &str, label: &str) -> Json {
    let text = if comment.is_empty() { label } else { comment }.trim();
    if let (Json::Object(schema), false) = (&mut schema, text.is_empty()) {
        schema.insert("description".to_owned(), text.into());
    }
    schema
}
