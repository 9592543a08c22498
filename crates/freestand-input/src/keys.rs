//! The keys under which a person writes values, and how messages name them.
//!
//! A key has one spelling in files, in Python and in this program: `pad_stiffness`. A message puts
//! a key in backticks, alone or with a value as in TOML: `` `pad_stiffness` ``,
//! `` `beyond = "hold"` ``. The shell that shows the message writes the keys as its user does, with
//! [`KeyStyle::shown`]. Backticks in messages are for keys only.

/// How a person writes a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum KeyStyle {
    /// `pad_stiffness`, `beyond = "hold"`.
    #[default]
    File,
    /// `--pad-stiffness`, `--beyond hold`.
    Flag,
}

impl KeyStyle {
    /// A key in this style. A flag does not state a unit: `return_period_years` is
    /// `--return-period`.
    pub fn name(self, key: &str) -> String {
        match self {
            Self::File => key.to_owned(),
            Self::Flag => format!("--{}", key.trim_end_matches("_years").replace('_', "-")),
        }
    }

    /// A message with its keys in this style.
    ///
    /// # Example
    /// ```
    /// use freestand_input::keys::KeyStyle;
    /// let message = "`pad_stiffness` needs `pads_per_edge = 2`";
    /// assert_eq!(KeyStyle::Flag.shown(message), "--pad-stiffness needs --pads-per-edge 2");
    /// assert_eq!(KeyStyle::File.shown(message), "pad_stiffness needs pads_per_edge = 2");
    /// ```
    pub fn shown(self, message: &str) -> String {
        let (mut shown, mut rest) = (String::with_capacity(message.len()), message);
        while let Some((before, tail)) = rest.split_once('`') {
            shown.push_str(before);
            // A backtick that does not mark a key stays unchanged.
            match tail.split_once('`').and_then(|(marked, after)| Some((self.entry(marked)?, after))) {
                Some((entry, after)) => {
                    shown.push_str(&entry);
                    rest = after;
                }
                None => {
                    shown.push('`');
                    rest = tail;
                }
            }
        }
        shown.push_str(rest);
        shown
    }

    /// `key` or `key = value` in this style; `None` for anything else.
    fn entry(self, marked: &str) -> Option<String> {
        let (key, value) = marked.split_once(" = ").map_or((marked, None), |(key, value)| (key, Some(value)));
        let is_key = key.starts_with(|c: char| c.is_ascii_lowercase())
            && key.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
        if !is_key {
            return None;
        }
        let name = self.name(key);
        Some(match (self, value) {
            (Self::File, _) => marked.to_owned(),
            (Self::Flag, None | Some("true")) => name,
            (Self::Flag, Some(value)) => {
                let bare = value.trim_matches('"');
                let is_word = bare.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c));
                format!("{name} {}", if is_word { bare } else { value })
            }
        })
    }
}

/// Values as a person wrote them, with their units, in the order of writing. Values from a file
/// have their line numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Words {
    entries: Vec<Word>,
}

#[derive(Debug, Clone, PartialEq)]
struct Word {
    key: &'static str,
    text: String,
    line: Option<usize>,
}

impl Words {
    /// Sets the value of a key and removes its earlier values.
    pub fn set(&mut self, key: &'static str, text: impl Into<String>) {
        self.remove(key);
        self.add(key, text, None);
    }

    /// Adds a value to those of a key, with its line if it is from a file.
    pub fn add(&mut self, key: &'static str, text: impl Into<String>, line: Option<usize>) {
        self.entries.push(Word { key, text: text.into(), line });
    }

    /// Removes the values of a key.
    pub fn remove(&mut self, key: &str) {
        self.entries.retain(|word| word.key != key);
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The first value of a key.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.all(key).next()
    }

    /// All values of a key.
    pub fn all(&self, key: &str) -> impl Iterator<Item = &str> {
        self.entries().filter(move |(name, _)| *name == key).map(|(_, text)| text)
    }

    /// Keys and values, in the order of writing.
    pub fn entries(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.entries.iter().map(|word| (word.key, word.text.as_str()))
    }

    /// Keys and their lines, in the order of writing.
    pub fn lines(&self) -> impl Iterator<Item = (&'static str, Option<usize>)> {
        self.entries.iter().map(|word| (word.key, word.line))
    }

    /// The last line on which one of these keys was written.
    pub fn line_of(&self, keys: &[&str]) -> Option<usize> {
        self.lines().filter(|(key, _)| keys.contains(key)).filter_map(|(_, line)| line).max()
    }
}

impl<T: Into<String>> FromIterator<(&'static str, T)> for Words {
    fn from_iter<I: IntoIterator<Item = (&'static str, T)>>(entries: I) -> Self {
        let word = |(key, text): (&'static str, T)| Word { key, text: text.into(), line: None };
        Self { entries: entries.into_iter().map(word).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_shown_as_the_reader_writes_them() {
        for (message, file, flag) in [
            ("`dt`: not a number", "dt: not a number", "--dt: not a number"),
            ("give `tolerance = \"5 g\"`", "give tolerance = \"5 g\"", "give --tolerance \"5 g\""),
            ("or `beyond = \"hold\"`", "or beyond = \"hold\"", "or --beyond hold"),
            ("`plot = true`", "plot = true", "--plot"),
            ("`return_period_years`", "return_period_years", "--return-period"),
            ("expected `=`, `dt`", "expected `=`, dt", "expected `=`, --dt"),
            ("a lone ` before `dt`", "a lone ` before dt", "a lone ` before --dt"),
            ("none", "none", "none"),
        ] {
            assert_eq!(
                (KeyStyle::File.shown(message), KeyStyle::Flag.shown(message)),
                (file.to_owned(), flag.to_owned())
            );
        }
    }
}
