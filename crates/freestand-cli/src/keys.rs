//! Flags that are keys of a study: the library reads their texts as it reads those of a file.

use std::fmt::Debug;
use std::marker::PhantomData;

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use freestand_input::keys::{KeyStyle, Words};

/// A flag, described by its key, the name of its value, how often it may be given, and its help.
pub(crate) struct Key(&'static str, Option<&'static str>, ArgAction, &'static str);

/// A key with a value.
pub(crate) const fn key(key: &'static str, value: &'static str, help: &'static str) -> Key {
    Key(key, Some(value), ArgAction::Set, help)
}

/// A key that is true if the flag is given.
pub(crate) const fn switch(key: &'static str, help: &'static str) -> Key {
    Key(key, None, ArgAction::SetTrue, help)
}

/// Related keys, under the headings that the help shows.
pub(crate) trait KeySet: Debug + Clone {
    const KEYS: &'static [(&'static str, &'static [Key])];
    /// More of them, which only the long help shows.
    const DETAILS: &'static [(&'static str, &'static [Key])] = &[];
}

/// The keys that were given, with their texts.
#[derive(Debug, Clone)]
pub(crate) struct Keys<S> {
    pub(crate) words: Words,
    set: PhantomData<S>,
}

impl<S: KeySet> Args for Keys<S> {
    fn augment_args(command: Command) -> Command {
        let arg = |heading, Key(key, value, action, help): &Key| {
            let flag = KeyStyle::Flag.name(key);
            let (short, rest) = help
                .split_once("\n\n")
                .map_or((*help, None), |(short, rest)| (short, Some(rest)));
            let arg = Arg::new(*key)
                .long(flag.trim_start_matches('-').to_owned())
                .action(action.clone())
                .help(short)
                .long_help(rest.map(|_| *help))
                .help_heading(heading);
            value.map_or(arg.clone(), |value| arg.value_name(value))
        };
        let args = |groups: &'static [(&'static str, &'static [Key])]| {
            groups
                .iter()
                .flat_map(move |(heading, keys)| keys.iter().map(move |key| arg(*heading, key)))
        };
        command
            .args(args(S::KEYS))
            .args(args(S::DETAILS).map(|arg| arg.hide_short_help(true)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: KeySet> FromArgMatches for Keys<S> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let keys = S::KEYS
            .iter()
            .chain(S::DETAILS)
            .flat_map(|(_, keys)| keys.iter().map(|key| key.0));
        let given = keys.filter(|key| matches.value_source(key) == Some(ValueSource::CommandLine));
        let texts = given.flat_map(|key| {
            let texts = matches.get_raw(key).into_iter().flatten();
            texts.map(move |text| (key, text.to_string_lossy().into_owned()))
        });
        Ok(Self {
            words: texts.collect(),
            set: PhantomData,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
