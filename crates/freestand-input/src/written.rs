//! Values of a request as a person or a program wrote them, before anything judges them.

use std::convert::Infallible;
use std::str::FromStr;

use crate::words::shortest;

/// A value of a request. Reading one cannot fail: whether it is a length, a choice or nothing that is
/// known is judged where the request is resolved, together with all other values.
///
/// # Example
/// ```
/// use freestand_input::written::Written;
/// assert_eq!("2.3 m".parse(), Ok(Written::Text("2.3 m".to_owned())));
/// assert_eq!(Written::List(vec![Written::Number(0.3), "1.2 m".parse()?]).text(), "0.3, 1.2 m");
/// # Ok::<(), std::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Written {
    /// Yes or no.
    Flag(bool),
    /// A number; in SI where a quantity is expected.
    Number(f64),
    /// A text; where a quantity is expected, with its unit.
    Text(String),
    /// Several values.
    List(Vec<Written>),
    /// A table, where no value is one.
    Table,
}

impl Written {
    /// The value as a text, as a message shows it.
    pub fn text(&self) -> String {
        match self {
            Self::Flag(flag) => flag.to_string(),
            Self::Number(number) => shortest(*number),
            Self::Text(text) => text.clone(),
            Self::List(all) => all.iter().map(Self::text).collect::<Vec<_>>().join(", "),
            Self::Table => "a table".to_owned(),
        }
    }

    /// A bare number in this unit; what is no number stays as it is.
    #[must_use]
    pub fn in_unit(&self, unit: &str) -> Self {
        match self {
            Self::Number(number) => Self::Text(format!("{number} {unit}")),
            Self::List(all) => Self::List(all.iter().map(|one| one.in_unit(unit)).collect()),
            other => other.clone(),
        }
    }
}

impl FromStr for Written {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(Self::Text(text.to_owned()))
    }
}
