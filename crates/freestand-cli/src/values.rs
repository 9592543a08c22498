//! Flags whose values have units. clap reads each of them once and stores the value or, under the
//! name of the flag, the problem with it: so a command reports all problems at once.

use std::any::TypeId;
use std::ffi::OsStr;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParserFactory};
use clap::{Arg, Command};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{self, Dimension};
pub(crate) use freestand_input::words::{Choices, name_of};

use crate::failure::Failure;

/// The value of a flag, or the problem with it. The definition of the flag says how it is read, see
/// [`Reads`].
#[derive(Debug, Clone)]
pub(crate) struct Given<T = f64>(pub(crate) Result<T, Problem>);

/// Reads a flag with a function.
#[derive(Debug, Clone)]
pub(crate) struct Reader<F>(F);

impl<F, T> TypedValueParser for Reader<F>
where
    F: Fn(&str) -> Result<T, Problem> + Clone + Send + Sync + 'static,
    T: Clone + Send + Sync + 'static,
{
    type Value = Given<T>;

    fn parse_ref(
        &self,
        _: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Given<T>, clap::Error> {
        let flag = arg.and_then(Arg::get_long).unwrap_or_default();
        Ok(Given(
            (self.0)(&value.to_string_lossy()).map_err(|problem| named(flag, problem)),
        ))
    }
}

/// clap's derive needs a reader for every type; the definition of a flag replaces this one.
impl<T: Clone + Send + Sync + 'static> ValueParserFactory for Given<T> {
    type Parser = Reader<fn(&str) -> Result<T, Problem>>;

    fn value_parser() -> Self::Parser {
        Reader(|_| {
            Err(Problem::value(
                "this flag cannot be read",
                "this is a defect of freestand; please report it",
            ))
        })
    }
}

/// A problem under the name of its flag.
fn named(flag: &str, mut problem: Problem) -> Problem {
    problem.message = format!("--{flag}: {}", problem.message);
    problem
}

/// How the value of a flag is read: `#[arg(long, positive = Dimension::Length)]`. The help names
/// the value after its dimension.
pub(crate) trait Reads: Into<Arg> {
    /// A value read by a function; the definition also states its name.
    fn read<T, F>(self, read: F) -> Arg
    where
        T: Clone + Send + Sync + 'static,
        F: Fn(&str) -> Result<T, Problem> + Clone + Send + Sync + 'static,
    {
        self.into().value_parser(Reader(read))
    }

    /// Any finite value.
    fn any(self, dimension: Dimension) -> Arg {
        let arg = self.into().value_name(value_name(dimension));
        arg.read(move |text| quantity::parse(text, dimension))
    }

    /// A value above zero.
    fn positive(self, dimension: Dimension) -> Arg {
        let arg = self.into().value_name(value_name(dimension));
        arg.read(move |text| quantity::parse_positive(text, dimension, "the value"))
    }

    /// A value of zero or more.
    fn non_negative(self, dimension: Dimension) -> Arg {
        let arg = self.into().value_name(value_name(dimension));
        arg.read(move |text| quantity::parse_non_negative(text, dimension, "the value"))
    }

    /// A grid or a list.
    fn grid(self, dimension: Dimension) -> Arg {
        self.into()
            .value_name("GRID")
            .read(move |text| quantity::parse_grid(text, dimension))
    }
}

impl Reads for Arg {}

/// `LENGTH`, `ANGULAR-VELOCITY`.
fn value_name(dimension: Dimension) -> String {
    let name = dimension.with_article();
    name.split_once(' ')
        .map_or(name, |(_, name)| name)
        .to_uppercase()
        .replace(' ', "-")
}

/// One of these values, chosen by its name.
pub(crate) fn choice<T: Copy + Send + Sync>(
    choices: Choices<T>,
) -> impl TypedValueParser<Value = T> {
    let names = choices
        .iter()
        .map(|(_, name, meaning)| PossibleValue::new(*name).help(*meaning));
    PossibleValuesParser::new(names).try_map(|text| {
        let known = choices.iter().find(|(_, name, _)| *name == text);
        known
            .map(|(value, ..)| *value)
            .ok_or("not one of the values")
    })
}

/// A command and its subcommands, with flags that accept negative values and with help that ends
/// with the units.
pub(crate) fn finished(command: Command) -> Command {
    let units = units(&command);
    let command = match command.get_after_help() {
        Some(help) if !units.is_empty() => {
            let help = format!("{help}\n\nUnits:\n{units}");
            command.after_long_help(help)
        }
        _ => command,
    };
    command
        .mut_args(with_negative_values)
        .mut_subcommands(finished)
}

/// Lets a value begin with a minus sign, as in `--x "-1 rad"`. Names of files and lists of values
/// are excluded: they would take the next flag for a value.
fn with_negative_values(arg: Arg) -> Arg {
    let is_single =
        arg.get_action().takes_values() && arg.get_num_args().is_none_or(|count| count == 1.into());
    let names = arg.get_value_names().unwrap_or_default();
    let is_named = names.iter().any(|name| name.starts_with("FILE"));
    let is_path = is_named || arg.get_value_parser().type_id() == TypeId::of::<PathBuf>();
    let allowed = !arg.is_positional() && is_single && !is_path;
    arg.allow_hyphen_values(allowed)
}

/// The units of the values that a command takes, one line for each dimension.
fn units(command: &Command) -> String {
    let values = command
        .get_arguments()
        .filter(|arg| arg.get_action().takes_values());
    let names: Vec<&str> = values
        .flat_map(|arg| arg.get_value_names().unwrap_or_default())
        .map(|name| &**name)
        .collect();
    let taken = Dimension::ALL
        .into_iter()
        .filter(|dimension| names.contains(&&*value_name(*dimension)));
    let line = |dimension: Dimension| {
        let units: Vec<&str> = dimension.units().map(|unit| unit.symbol).collect();
        let bare = if dimension == Dimension::Ratio {
            "none, or "
        } else {
            ""
        };
        format!("  {:17}  {bare}{}", value_name(dimension), units.join(", "))
    };
    taken.map(line).collect::<Vec<_>>().join("\n")
}

/// Collects the problems with the values of flags.
#[derive(Debug, Default)]
pub(crate) struct Values {
    problems: Problems,
}

impl Values {
    /// The value of a flag; `None` if it is not given or wrong.
    pub(crate) fn read<'a, T: Clone + 'a>(
        &mut self,
        given: impl Into<Option<&'a Given<T>>>,
    ) -> Option<T> {
        self.take(given.into()?.0.clone())
    }

    /// The value of a result; a problem is collected.
    pub(crate) fn take<T>(&mut self, result: Result<T, impl Into<Problems>>) -> Option<T> {
        self.problems.keep(result)
    }

    /// Adds a problem.
    pub(crate) fn push(&mut self, problem: Problem) {
        self.problems.push(problem);
    }

    /// Fails if there was any problem.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        self.finish_with(Some(()))
    }

    /// The value, if there was no problem. If the value is `None`, its problem must have been
    /// collected.
    pub(crate) fn finish_with<T>(self, value: Option<T>) -> Result<T, Failure> {
        Ok(self.problems.finish(value)?)
    }
}
