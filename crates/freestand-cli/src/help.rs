//! What every command of the program has: flags that take negative values, and the units in its help.

use std::any::TypeId;
use std::path::PathBuf;

use clap::{Arg, Command};
use freestand_input::quantity::Dimension;

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
    if arg.is_positional() {
        return arg;
    }
    arg.allow_hyphen_values(is_single && !is_path)
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

/// `LENGTH`, `ANGULAR-VELOCITY`.
fn value_name(dimension: Dimension) -> String {
    let name = dimension.with_article();
    name.split_once(' ')
        .map_or(name, |(_, name)| name)
        .to_uppercase()
        .replace(' ', "-")
}
