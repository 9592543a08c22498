//! A request as a person types it: the line of a shell, and the call of the Python package.

use clap::{Arg, ArgAction, Command};
use freestand_assess::one_object::Withstood;
use freestand_input::keys::{KeyStyle, unit_of_argument};
use freestand_input::quantity::{Dimension, Unit, lookup, parse};
use freestand_input::words::shortest;
use serde::Serialize;

use crate::object::{ratios, withstood};
use crate::records::Records;
use crate::request::{Request, keys};

/// What asks the same elsewhere.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Typed {
    /// The line of a shell.
    pub line: String,
    /// The lines of Python; none where no function takes all values, or where a text is not understood.
    pub python: Option<String>,
}

/// A request of a command as it is typed.
///
/// # Example
/// ```
/// use freestand_app::object::Object;
/// use freestand_app::request::from_entries;
/// use freestand_app::typed::typed;
/// let asked = serde_json::json!({"height": "6 ft", "thickness": "400 mm", "place": "Athens"});
/// let typed = typed::<Object>("object", &from_entries(asked.as_object().unwrap())?);
/// assert_eq!(typed.line, r#"freestand object --height "6 ft" --thickness "400 mm" --place Athens"#);
/// let call = r#"fs.check_object(1.8288, 0.4, place="Athens")"#;
/// assert_eq!(typed.python.unwrap(), format!("import freestand as fs\n{call}"));
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn typed<R: Request>(command: &str, request: &R) -> Typed {
    let given = given(request);
    Typed {
        line: line(command, &given),
        python: python(command, &given),
    }
}

/// A key with its values.
#[derive(Default)]
struct Given {
    key: String,
    /// Its flag; files often have none.
    flag: Option<String>,
    /// What a value is, as the help says it: `LENGTH`.
    what: String,
    /// The unit of a bare number in Python.
    unit: Option<&'static Unit>,
    is_switch: bool,
    is_list: bool,
    /// Whether all values follow one flag.
    is_together: bool,
    texts: Vec<String>,
}

/// What was written, in the order of the help; what has no flag is first, where no flag takes it for its own.
fn given<R: Request>(request: &R) -> Vec<Given> {
    let words = request.words();
    let command = R::augment_args(Command::new("request"));
    let mut args: Vec<_> = command.get_arguments().collect();
    args.sort_by_key(|arg| !arg.is_positional());
    let of = |arg: &Arg| {
        let key = arg.get_id().as_str();
        let unit = lookup(unit_of_argument(key));
        // A person writes the unit of a number.
        let text = |(text, numbers): (&str, &[f64])| match unit.filter(|_| !numbers.is_empty()) {
            Some(unit) => {
                let texts = numbers.iter();
                let texts =
                    texts.map(|si| format!("{} {}", digits(unit.from_si(*si)), unit.symbol));
                texts.collect::<Vec<_>>().join(", ")
            }
            None => text.to_owned(),
        };
        Given {
            key: key.to_owned(),
            flag: arg.get_long().map(str::to_owned),
            what: arg
                .get_value_names()
                .and_then(|names| names.first())
                .map(ToString::to_string)
                .unwrap_or_default(),
            unit,
            is_switch: !arg.get_action().takes_values(),
            is_list: matches!(arg.get_action(), ArgAction::Append),
            is_together: arg
                .get_num_args()
                .is_some_and(|count| count.max_values() > 1),
            texts: words.all_with_numbers(key).map(text).collect(),
        }
    };
    let mut given: Vec<Given> = args.into_iter().map(of).collect();
    // In the command line, every command has it.
    given.push(Given {
        key: "seed".to_owned(),
        flag: Some("seed".to_owned()),
        what: "N".to_owned(),
        texts: words.all("seed").map(str::to_owned).collect(),
        ..Given::default()
    });
    given.retain(|one| !one.texts.is_empty());
    given
}

fn line(command: &str, given: &[Given]) -> String {
    let mut parts = vec!["freestand".to_owned(), command.to_owned()];
    for one in given {
        let texts = one.texts.iter().map(|text| in_shell(text));
        match &one.flag {
            None => parts.extend(texts),
            Some(flag) if one.is_switch => parts.push(format!("--{flag}")),
            Some(flag) if one.is_together => {
                parts.push(format!("--{flag}"));
                parts.extend(texts);
            }
            Some(flag) => texts.for_each(|text| parts.push(format!("--{flag} {text}"))),
        }
    }
    parts.join(" ")
}

/// A text in quotation marks, if a shell needs them.
fn in_shell(text: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "_.:/%+-".contains(letter);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text.to_owned();
    }
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        if "\"\\$`".contains(letter) {
            quoted.push('\\');
        }
        quoted.push(letter);
    }
    quoted + "\""
}

/// A function of Python that asks what a command asks.
struct Call {
    command: &'static str,
    /// Its name; after a point, that of a method of the motion that is read.
    function: &'static str,
    /// Keys whose values are given without a name.
    first: &'static [&'static str],
    /// Keys any of which lets those of `first` be missing.
    instead: &'static [&'static str],
    /// Whether a key is one of its other arguments; parts of a request may be objects in Python.
    takes: fn(&str) -> bool,
}

const CALLS: [Call; 8] = [
    Call {
        command: "object",
        function: "check_object",
        first: &["height", "thickness"],
        instead: &["scan", "diameter"],
        takes: |key| key != "units" && !keys::<Records>().iter().any(|one| one == key),
    },
    Call {
        command: "spectrum",
        function: "spectrum",
        first: &["motion", "heights", "thicknesses"],
        instead: &[],
        takes: |key| {
            let others = [
                "pairs",
                "mass",
                "stiffness",
                "cushion",
                "model",
                "accuracy",
                "sensitivity",
            ];
            others.contains(&key) || key.starts_with("restitution")
        },
    },
    Call {
        command: "motion spectrum",
        function: ".spectrum",
        first: &["motion"],
        instead: &[],
        takes: |_| true,
    },
    Call {
        command: "cushion drop",
        function: "drop_test",
        first: &["files"],
        instead: &[],
        takes: |key| key != "resample",
    },
    Call {
        command: "cushion static",
        function: "static_test",
        first: &["files"],
        instead: &[],
        takes: |_| true,
    },
    Call {
        command: "inventory check",
        function: "check_inventory",
        first: &["file"],
        instead: &[],
        takes: |key| !["units", "headings", "cells"].contains(&key),
    },
    Call {
        command: "assess",
        function: "assess",
        first: &[],
        instead: &[],
        takes: |key| {
            // Several sites are a loop in Python.
            let others = ["format", "pages", "cards", "fail_on", "sites"];
            !others.contains(&key)
        },
    },
    Call {
        command: "validate",
        function: "validate",
        first: &[],
        instead: &[],
        takes: |_| true,
    },
];

fn python(command: &str, given: &[Given]) -> Option<String> {
    let call = CALLS.iter().find(|call| call.command == command)?;
    let motion = given.iter().find(|one| one.key == MOTION);
    let code = match motion {
        None if command == "spectrum" => at_place(given)?,
        _ => called(call, given, motion)?,
    };
    let numpy = match code.contains("np.") {
        true => "import numpy as np\n",
        false => "",
    };
    Some(format!("import freestand as fs\n{numpy}{code}"))
}

/// The records of a command, which Python reads first.
const MOTION: &str = "motion";

/// The call of a function, with what reads its motions.
fn called(call: &Call, given: &[Given], motion: Option<&Given>) -> Option<String> {
    let of_records = keys::<Records>();
    let (of_motion, others): (Vec<&Given>, Vec<&Given>) = given
        .iter()
        .filter(|one| one.key != MOTION)
        .partition(|one| motion.is_some() && of_records.contains(&one.key));
    let motion = match motion {
        Some(motion) => Some(motion.read(&of_motion)?),
        None => None,
    };
    let mut first = Vec::new();
    let keys = call.first.iter().filter(|key| **key != MOTION);
    let places = keys.map(|key| others.iter().position(|one| one.key == *key));
    let has_other = given
        .iter()
        .any(|one| call.instead.contains(&one.key.as_str()));
    let mut placed = Vec::new();
    // One that follows a missing one is given by its name.
    for place in places {
        match place {
            Some(place) => {
                first.push(others.get(place)?.code()?);
                placed.push(place);
            }
            None if has_other => break,
            None => return None,
        }
    }
    let mut named = Vec::new();
    for (_, one) in others
        .iter()
        .enumerate()
        .filter(|(place, _)| !placed.contains(place))
    {
        if !(call.takes)(&one.key) {
            return None;
        }
        named.push(one.named()?);
    }
    let mut function = format!("fs.{}", call.function);
    match motion {
        Some(motion) if call.function.starts_with('.') => function = motion + call.function,
        Some(motion) if call.first.contains(&MOTION) => first.insert(0, motion),
        Some(motion) => named.push(format!("motions={motion}")),
        None if call.first.contains(&MOTION) => return None,
        None => {}
    }
    first.extend(named);
    Some(format!("{function}({})", first.join(", ")))
}

/// A grid of objects at a place is a study.
fn at_place(given: &[Given]) -> Option<String> {
    let (mut building, mut objects, mut level) = (Vec::new(), Vec::new(), None);
    let mut named = Vec::new();
    for one in given {
        let (key, code) = (one.key.as_str(), one.code()?);
        match key {
            "place" | "site" | "return_period_years" => named.push(format!("{key}={code}")),
            "storeys" => building.push(format!("\"{key}\": {code}")),
            "level_ratio" => level = Some(code),
            "restitution_factor" => objects.push(format!("\"{key}\": {code}")),
            "heights" | "thicknesses" | "mass" | "stiffness" | "accuracy" => {
                objects.push(format!("\"{key}\": {}", quoted(one.texts.first()?)));
            }
            _ => return None,
        }
    }
    building.push(format!(
        "\"levels\": [{{\"name\": \"floor\", \"level_ratio\": {}}}]",
        level?
    ));
    let (building, objects) = (building.join(", "), objects.join(", "));
    let study = format!("{{\"building\": {{{building}}}, \"objects\": {{{objects}}}}}");
    named.insert(0, study);
    Some(format!("fs.run({}).rows", named.join(", ")))
}

impl Given {
    /// What reads the motions of these files.
    fn read(&self, how: &[&Self]) -> Option<String> {
        let mut arguments = vec![self.code()?];
        for one in how {
            arguments.push(one.named()?);
        }
        let function = if self.is_list {
            "read_motions"
        } else {
            "read_motion"
        };
        Some(format!("fs.{function}({})", arguments.join(", ")))
    }

    /// Its argument with its name.
    fn named(&self) -> Option<String> {
        let text = self.texts.first()?;
        match self.key.as_str() {
            // Two values in one text.
            "tolerance" => {
                let Withstood {
                    peak_m_s2,
                    duration_s,
                } = withstood(text).ok()?;
                let peak = format!("tolerance_g={}", digits(self.unit?.from_si(peak_m_s2)));
                Some(duration_s.map_or(peak.clone(), |duration_s| {
                    format!("{peak}, tolerance_duration_s={}", digits(duration_s))
                }))
            }
            // One value under two names.
            "on" => Some(match parse(text, Dimension::Stiffness) {
                Ok(stiffness) => format!("stiffness_n_m={}", digits(stiffness)),
                Err(_) if text.starts_with(char::is_alphabetic) => {
                    format!("cushion={}", quoted(text))
                }
                Err(_) => return None,
            }),
            key => Some(format!("{}={}", KeyStyle::Argument.name(key), self.code()?)),
        }
    }

    /// Its value as Python writes it.
    fn code(&self) -> Option<String> {
        let text = self.texts.first()?;
        let is_number =
            self.unit.is_some() || ["RATIO", "N", "YEARS"].contains(&self.what.as_str());
        Some(match self.what.as_str() {
            _ if self.is_switch => "True".to_owned(),
            _ if self.is_list => listed(self.texts.iter().map(|text| quoted(text))),
            _ if self.key == "friction" => match ratios(text).ok()? {
                (low, high) if low == high => digits(low),
                (low, high) => format!("({}, {})", digits(low), digits(high)),
            },
            "GRID" | "LIST" => self.grid(text)?,
            _ if is_number => self.number(text)?,
            _ => quoted(text),
        })
    }

    /// A number in the unit of the argument.
    fn number(&self, text: &str) -> Option<String> {
        // A seed may have more digits than a double.
        if self.unit.is_none() && text.chars().all(|letter| letter.is_ascii_digit()) {
            return Some(text.to_owned());
        }
        let dimension = self.unit.map_or(Dimension::Ratio, |unit| unit.dimension);
        let si = parse(text, dimension).ok()?;
        Some(digits(self.unit.map_or(si, |unit| unit.from_si(si))))
    }

    fn grid(&self, text: &str) -> Option<String> {
        match text.split(':').collect::<Vec<_>>()[..] {
            [from, to, count] => {
                let count: u32 = count.trim().parse().ok()?;
                Some(format!(
                    "np.linspace({}, {}, {count})",
                    self.number(from)?,
                    self.number(to)?
                ))
            }
            _ => {
                let numbers = text.split(',').map(|one| self.number(one));
                Some(listed(numbers.collect::<Option<Vec<_>>>()?.into_iter()))
            }
        }
    }
}

fn listed(codes: impl Iterator<Item = String>) -> String {
    format!("[{}]", codes.collect::<Vec<_>>().join(", "))
}

/// A text as Python writes it.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A number without the last digits, which say how it was calculated.
fn digits(value: f64) -> String {
    shortest(format!("{value:.14e}").parse().unwrap_or(value))
}
