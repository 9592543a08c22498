//! What all requests have in common: the values that were written, from JSON and from keywords.

use std::collections::{BTreeMap, BTreeSet};
use std::convert::Infallible;
use std::ffi::OsStr;
use std::marker::PhantomData;
use std::path::PathBuf;
use std::str::FromStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Args, Command};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, UnitSystem, shorten};
use freestand_input::word_reader::WordReader;
use freestand_input::words::{Choices, nearest, number};
use freestand_input::written::Written;
use freestand_study::resolve::MAX_MOTIONS;
use serde_json::{Map, Value};

use crate::files::Files;

/// Keys that a request does not know; the message names them.
pub type Unknown = BTreeSet<String>;

/// A request or a part of one.
pub trait Request: Args + Default {
    /// Takes the values of its keys out of those that were given.
    fn fill(&mut self, given: &mut BTreeMap<String, Written>);

    /// Adds every value that was written, under its key.
    fn write(&self, words: &mut Words);

    /// All values that were written.
    fn words(&self) -> Words {
        let mut words = Words::default();
        self.write(&mut words);
        words
    }
}

/// A request that has an answer of its own; others are parts of such requests.
pub trait Question: Request {
    /// What is asked, in SI.
    type Meant;

    /// What the request means.
    ///
    /// # Errors
    /// All its problems, each under its key.
    fn resolve(&self, files: &Files) -> Result<Self::Meant, Problems>;

    /// What is wrong with the request, as far as that is known before any work.
    ///
    /// # Errors
    /// As [`Question::resolve`], but for what is in records.
    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.resolve(files).map(drop)
    }

    /// Takes the seed of a shell, if random numbers are drawn.
    fn set_seed(&mut self, _seed: Option<Written>) {}
}

/// Defines a request or a part of one: every field is a value that was written, or a part. As `question`, it has
/// an answer of its own, and knows which keys it does not know.
///
/// `pub width = "LENGTH",` is a flag with a value, which the help calls LENGTH; `pub no_slip = switch,` one without.
/// `with (value_parser = one_of(LAWS))` adds to its attributes.
/// `under "Building"` is the heading of their help: of one, or of all such fields where it follows the name of the struct.
macro_rules! request {
    (question $(#[$meta:meta])* pub struct $name:ident $(<$of:ident: $kind:path>)? $(under $heading:literal)? {
        $($fields:tt)*
    }) => {
        $crate::request::request! {
            $(#[$meta])*
            pub struct $name $(<$of: $kind>)? $(under $heading)? {
                $($fields)*
                /// Keys that are not known.
                #[arg(skip)]
                pub unknown: $crate::request::Unknown,
            }
        }
    };
    ($(#[$meta:meta])* pub struct $name:ident $(<$of:ident: $kind:path>)? $(under $heading:literal)? {
        $($fields:tt)*
    }) => {
        $crate::request::request! {
            @next { $(#[$meta])* pub struct $name $(<$of: $kind>)? } ($($heading)?) [] $($fields)*
        }
    };
    (@next $head:tt $under:tt [$($done:tt)*] $(#[$of_field:meta])* pub $field:ident: $type:ty, $($rest:tt)*) => {
        $crate::request::request! { @next $head $under [$($done)* $(#[$of_field])* pub $field: $type,] $($rest)* }
    };
    (@next $head:tt ($heading:literal) $done:tt
        $(#[$of_field:meta])* pub $field:ident = $value:tt $(with $more:tt)?, $($rest:tt)*
    ) => {
        $crate::request::request! {
            @next $head ($heading) $done $(#[$of_field])* pub $field = $value $(with $more)? under $heading, $($rest)*
        }
    };
    (@next $head:tt $under:tt [$($done:tt)*]
        $(#[$of_field:meta])* pub $field:ident = switch $(under $heading:literal)?, $($rest:tt)*
    ) => {
        $crate::request::request! { @next $head $under [$($done)* $(#[$of_field])*
            #[arg(long, action = clap::ArgAction::SetTrue $(, help_heading = $heading)?)]
            pub $field: $crate::request::Switch,] $($rest)* }
    };
    (@next $head:tt $under:tt [$($done:tt)*]
        $(#[$of_field:meta])* pub $field:ident = $value:literal
            $(with ($($more:tt)*))? $(under $heading:literal)?, $($rest:tt)*
    ) => {
        $crate::request::request! { @next $head $under [$($done)* $(#[$of_field])*
            #[arg(long, value_name = $value $(, $($more)*)? $(, help_heading = $heading)?)]
            pub $field: Option<freestand_input::written::Written>,] $($rest)* }
    };
    (@next { $(#[$meta:meta])* pub struct $name:ident $(<$of:ident: $kind:path>)? } $under:tt
        [$($(#[$of_field:meta])* pub $field:ident: $type:ty,)*]
    ) => {
        #[derive(Debug, Clone, Default, PartialEq, clap::Args)]
        #[group(skip)]
        $(#[$meta])*
        pub struct $name $(<$of: $kind>)? {
            $($(#[$of_field])* pub $field: $type,)*
        }

        impl $(<$of: $kind>)? $crate::request::Request for $name $(<$of>)? {
            fn fill(
                &mut self,
                given: &mut std::collections::BTreeMap<String, freestand_input::written::Written>,
            ) {
                $( $crate::request::Field::fill(
                    &mut self.$field,
                    $crate::request::key_of(stringify!($field)),
                    given,
                ); )*
            }

            fn write(&self, words: &mut freestand_input::keys::Words) {
                $( $crate::request::Field::write(
                    &self.$field,
                    $crate::request::key_of(stringify!($field)),
                    words,
                ); )*
            }
        }
    };
}
pub(crate) use request;

/// The key of a field whose name may be a word of Rust, such as `r#in`.
pub(crate) fn key_of(field: &'static str) -> &'static str {
    field.trim_start_matches("r#")
}

/// A field of a request.
pub trait Field {
    /// Takes its value out of those that were given; in a request, the last field takes what is left.
    fn fill(&mut self, key: &'static str, given: &mut BTreeMap<String, Written>);

    /// Adds its value.
    fn write(&self, key: &'static str, words: &mut Words);
}

impl Field for Option<Written> {
    fn fill(&mut self, key: &'static str, given: &mut BTreeMap<String, Written>) {
        *self = given.remove(key);
    }

    fn write(&self, key: &'static str, words: &mut Words) {
        if let Some(written) = self {
            words.write(key, written);
        }
    }
}

impl Field for Vec<Written> {
    /// One value or a list of them.
    fn fill(&mut self, key: &'static str, given: &mut BTreeMap<String, Written>) {
        *self = match given.remove(key) {
            None => Vec::new(),
            Some(Written::List(all)) => all,
            Some(one) => vec![one],
        };
    }

    fn write(&self, key: &'static str, words: &mut Words) {
        self.iter().for_each(|written| words.write(key, written));
    }
}

/// A value that is yes or no; no, where it is not given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Switch(Option<Written>);

impl FromStr for Switch {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(Self(Some(Written::Text(text.to_owned()))))
    }
}

impl Field for Switch {
    fn fill(&mut self, key: &'static str, given: &mut BTreeMap<String, Written>) {
        self.0.fill(key, given);
    }

    fn write(&self, key: &'static str, words: &mut Words) {
        let given = self.0.as_ref().filter(|written| written.text() != "false");
        given
            .into_iter()
            .for_each(|written| words.write(key, written));
    }
}

impl Field for Unknown {
    fn fill(&mut self, _: &'static str, given: &mut BTreeMap<String, Written>) {
        *self = std::mem::take(given).into_keys().collect();
    }

    fn write(&self, _: &'static str, _: &mut Words) {}
}

impl<T> Field for PhantomData<T> {
    fn fill(&mut self, _: &'static str, _: &mut BTreeMap<String, Written>) {}

    fn write(&self, _: &'static str, _: &mut Words) {}
}

impl<R: Request> Field for R {
    fn fill(&mut self, _: &'static str, given: &mut BTreeMap<String, Written>) {
        Request::fill(self, given);
    }

    fn write(&self, _: &'static str, words: &mut Words) {
        Request::write(self, words);
    }
}

/// A value that is one of these: the help and the shells' completions list them, and whether it is one is judged with
/// all other values.
pub(crate) fn one_of<T: Clone + Send + Sync + 'static>(choices: Choices<T>) -> OneOf {
    let value = |(_, name, meaning): &(T, &'static str, &'static str)| {
        PossibleValue::new(*name).help(*meaning)
    };
    OneOf(choices.iter().map(value).collect())
}

/// As [`one_of`], of names that need no explanation.
pub(crate) fn one_of_names(names: &[&'static str]) -> OneOf {
    OneOf(names.iter().map(PossibleValue::new).collect())
}

#[derive(Debug, Clone)]
pub(crate) struct OneOf(Vec<PossibleValue>);

impl TypedValueParser for OneOf {
    type Value = Written;

    fn parse_ref(
        &self,
        _: &Command,
        _: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Written, clap::Error> {
        Ok(Written::Text(value.to_string_lossy().into_owned()))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.0.iter().cloned()))
    }
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
    let known = names::<R>();
    let mut found = BTreeMap::new();
    for (given, value) in entries {
        let plain = given.replace('-', "_");
        let (key, unit) = known_as(&plain, &known).unwrap_or((plain, None));
        let Some(value) = written(value, unit) else {
            continue;
        };
        if found.contains_key(&key) {
            let message = format!("`{key}` is given twice");
            return Err(Problem::value(message, format!("leave `{given}` out")).of_key(key));
        }
        found.insert(key, value);
    }
    let mut request = R::default();
    request.fill(&mut found);
    Ok(request)
}

/// A value of JSON, a bare number in this unit; none where it is null.
fn written(value: &Value, unit: Option<&str>) -> Option<Written> {
    const MOST: u64 = 1 << 53;
    let part = |value| written(value, unit).unwrap_or(Written::Table);
    Some(match value {
        Value::Null => return None,
        Value::Bool(flag) => Written::Flag(*flag),
        Value::Number(number) => match (unit, number.as_u64()) {
            (Some(unit), _) => Written::Text(format!("{number} {unit}").trim_end().to_owned()),
            // A whole number that a double cannot hold is a text.
            (None, Some(whole)) if whole > MOST => Written::Text(whole.to_string()),
            (None, _) => Written::Number(number.as_f64().unwrap_or(f64::NAN)),
        },
        Value::String(text) => Written::Text(text.clone()),
        Value::Array(all) => Written::List(all.iter().map(part).collect()),
        Value::Object(_) => Written::Table,
    })
}

/// A name under which a value of a request is known.
struct Name {
    name: String,
    key: String,
    /// What its value is, as the help says it: `LENGTH`.
    value: String,
}

/// What people call the files of a command that takes them without a flag.
const FILES: [&str; 6] = ["file", "files", "motion", "motions", "record", "records"];

/// The names under which the value of a flag is known, its key first.
pub(crate) fn names_of(arg: &Arg) -> Vec<String> {
    let mut names = vec![arg.get_id().to_string()];
    let aliases = arg.get_all_aliases().unwrap_or_default();
    let is_file = arg.is_positional() && arg.get_value_names().is_some_and(|of| of == ["FILE"]);
    let files = FILES.iter().filter(|_| is_file).copied();
    // Without a flag, an argument is also known by its name in the usage line.
    let shown = arg.get_value_names().and_then(|names| names.first());
    let shown = shown.filter(|name| {
        arg.is_positional() && name.chars().all(|letter| letter.is_ascii_uppercase())
    });
    let shown = shown.map(|name| name.to_lowercase());
    let flags = arg.get_long().into_iter().chain(aliases).chain(files);
    for name in flags.chain(shown.as_deref()) {
        let name = name.replace('-', "_");
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// The names of the values of a request.
fn names<R: Request>() -> Vec<Name> {
    let command = R::augment_args(Command::new("request"));
    let of = |arg: &Arg| {
        let key = arg.get_id().to_string();
        let value = arg.get_value_names().and_then(|names| names.first());
        let value = value.map(ToString::to_string).unwrap_or_default();
        names_of(arg)
            .into_iter()
            .map(move |name| Name {
                name,
                key: key.clone(),
                value: value.clone(),
            })
            .collect::<Vec<_>>()
    };
    command.get_arguments().flat_map(of).collect()
}

/// The key of a name, and the unit that the name ends in.
fn known_as(given: &str, known: &[Name]) -> Option<(String, Option<&'static str>)> {
    if let Some(is) = known.iter().find(|one| one.name == given) {
        return Some((is.key.clone(), None));
    }
    let in_unit = |one: &Name| {
        let (unit, values) = unit(given.strip_prefix(one.name.as_str())?)?;
        values
            .contains(&one.value.as_str())
            .then(|| (one.key.clone(), Some(unit)))
    };
    known.iter().find_map(in_unit)
}

/// What the name of a number may end in, with its unit, and what such numbers are; a ratio has no unit.
const ENDINGS: [(&str, &str, &[&str]); 16] = [
    ("_ratio", "", &["RATIO", "DAMPING", "LIST"]),
    ("_m", "m", &["LENGTH", "X, Z", "GRID"]),
    ("_kg", "kg", &["MASS"]),
    ("_s", "s", &["TIME", "GRID", "LIST"]),
    ("_g", "g", &["ACCELERATION"]),
    ("_m_s2", "m/s2", &["ACCELERATION"]),
    ("_m_s", "m/s", &["VELOCITY"]),
    ("_n", "N", &["FORCE"]),
    ("_n_m", "N/m", &["STIFFNESS", "STIFFNESS|ENTRY"]),
    ("_n_s_m", "N s/m", &["DAMPING"]),
    ("_s_m", "s/m", &["DISSIPATION"]),
    ("_hz", "Hz", &["FREQUENCY", "GRID"]),
    ("_rad", "rad", &["ANGLE"]),
    ("_deg", "deg", &["ANGLE"]),
    ("_rad_s", "rad/s", &["ANGULAR-VELOCITY"]),
    ("_kg_m2", "kg m2", &["MOMENT-OF-INERTIA"]),
];

/// What the name of a number may end in.
pub(crate) fn unit_endings() -> Vec<&'static str> {
    ENDINGS.iter().map(|(ending, ..)| *ending).collect()
}

/// The unit of an ending, and what such numbers are.
fn unit(ending: &str) -> Option<(&'static str, &'static [&'static str])> {
    let found = ENDINGS.iter().find(|(name, ..)| *name == ending);
    found.map(|(_, unit, values)| (*unit, *values))
}

/// The file that a key names, if it names one.
pub(crate) fn path(read: &mut WordReader<'_>, key: &'static str, files: &Files) -> Option<PathBuf> {
    let name = read.one(key)?;
    read.keep(key, files.path(name))
}

/// As [`path`], of a key that has no flag in the command line that a message could name.
pub(crate) fn path_without_flag(
    read: &mut WordReader<'_>,
    key: &'static str,
    files: &Files,
) -> Option<PathBuf> {
    let name = read.one(key)?;
    let path = files.path(name).map_err(|problem| problem.of(&[key]));
    read.problems.keep(path)
}

/// The system of units in which most of mass, height and thickness were written.
pub(crate) fn typed_units(words: &Words) -> UnitSystem {
    let typed = ["mass", "height", "thickness"].map(|key| words.get(key));
    UnitSystem::of_most_systems(typed.map(|text| text.and_then(UnitSystem::of)))
}

/// The files that a request names; it must name one.
pub(crate) fn paths(
    read: &mut WordReader<'_>,
    key: &'static str,
    names: &[Written],
    files: &Files,
) -> Vec<PathBuf> {
    read.pass(&[key]);
    if names.is_empty() {
        read.missing(&[key], "no file is named", "name one or more files");
    }
    // In the command line they have no flag that a message could name.
    let path = |name: &Written| {
        files
            .path(&name.text())
            .map_err(|problem| problem.of(&[key]))
    };
    let found = names.iter().map(path);
    found
        .filter_map(|path| read.problems.keep(path.map_err(Problems::from)))
        .collect()
}

/// The number of motions to make.
pub(crate) fn motions(read: &mut WordReader<'_>) -> Option<u64> {
    let most = u32::try_from(MAX_MOTIONS).unwrap_or(u32::MAX);
    read.whole_within("count", 1..=most).map(u64::from)
}

/// The seed of random numbers.
pub(crate) fn seed(read: &mut WordReader<'_>) -> Option<u64> {
    read.read("seed", |text| {
        let wrong = |_| Problem::value(format!("{text} is not a seed"), "give a whole number");
        text.parse::<u64>().map_err(wrong)
    })
}

/// A discount rate per year. 1 or more is a percentage without its sign.
pub(crate) fn discount(read: &mut WordReader<'_>) -> Option<f64> {
    let ratio = read.non_negative("discount", Dimension::Ratio)?;
    if ratio < 1.0 {
        return Some(ratio);
    }
    let percent = number(100.0 * ratio, 4);
    let message = format!("`discount`: {} is {percent} % a year", number(ratio, 4));
    let hint = match ratio < 100.0 {
        true => format!(
            "write {0} % a year as \"{0} %\" or {1}",
            number(ratio, 4),
            number(ratio / 100.0, 4)
        ),
        false => "give less than 100 % a year, such as \"3 %\"".to_owned(),
    };
    read.note(&["discount"], message, hint);
    None
}

/// Reads the values of a request; a problem for each key that it does not know is noted.
pub(crate) fn reader<'w, R: Request>(words: &'w Words, others: &Unknown) -> WordReader<'w> {
    let mut read = WordReader::new(words);
    unknown::<R>(others).for_each(|problem| read.problems.push(problem));
    read
}

/// A problem for each key that the request does not know.
pub(crate) fn unknown<R: Request>(unknown: &Unknown) -> impl Iterator<Item = Problem> {
    let known = keys::<R>();
    unknown.iter().map(move |key| {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let hint = match nearest(key, &known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "leave it out".to_owned(),
        };
        Problem::value(format!("`{}` is not known", shorten(key)), hint).of_key(key.clone())
    })
}
