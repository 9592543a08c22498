//! What a person enters in the field of a form: a bare number is in the units that the form shows.

use freestand_input::quantity::{Dimension, Quantity, UnitSystem, parse};
use serde::{Deserialize, Serialize};

/// A text in a field.
#[derive(Debug, Clone, Deserialize)]
pub struct Entered {
    /// As it was typed.
    pub text: String,
    /// What the field holds.
    pub quantity: Field,
    /// The units that the form showed.
    pub units: UnitSystem,
}

/// What a field holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Field {
    /// A length: `1.8` is in metres, `1800` in millimetres.
    Length,
    /// A mass.
    Mass,
    /// A stiffness, or the name of something that has one.
    Stiffness,
    /// An acceleration; in g in both systems.
    Acceleration,
    /// Anything else.
    Other,
}

/// A text of a field as the program reads it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reading {
    /// As it is asked: as it was typed, with a decimal point and with the unit of a bare number.
    pub asked: String,
    /// Its value in SI, if it has one.
    pub si: Option<f64>,
}

/// Above this, a bare number is in millimetres: nothing that people ask about is taller in metres.
const TALLEST_M: f64 = 12.0;

impl Entered {
    /// The text as the program reads it. What is wrong with it is said when it is asked.
    ///
    /// # Example
    /// ```
    /// use freestand_app::entered::{Entered, Field};
    /// use freestand_input::quantity::UnitSystem;
    /// let (quantity, units) = (Field::Length, UnitSystem::Si);
    /// let read = Entered { text: "1800".to_owned(), quantity, units }.read();
    /// assert_eq!((read.asked.as_str(), read.si), ("1800 mm", Some(1.8)));
    /// ```
    pub fn read(&self) -> Reading {
        let text = with_points(self.text.trim());
        let dimension = match self.quantity {
            Field::Length => Dimension::Length,
            Field::Mass => Dimension::Mass,
            Field::Stiffness => Dimension::Stiffness,
            Field::Acceleration => Dimension::Acceleration,
            Field::Other => {
                return Reading {
                    asked: text,
                    si: None,
                };
            }
        };
        let bare = Quantity::read(&text)
            .ok()
            .filter(|read| read.unit.is_none());
        let asked = match bare.and_then(|read| read.bare().ok()) {
            Some(number) => format!("{text} {}", self.unit(dimension, number)),
            None => text,
        };
        let si = parse(&asked, dimension).ok();
        Reading { asked, si }
    }

    /// The unit of a bare number.
    fn unit(&self, dimension: Dimension, number: f64) -> &'static str {
        let is_us = self.units == UnitSystem::Us;
        match dimension {
            Dimension::Length if is_us => "in",
            Dimension::Length if number > TALLEST_M || number == 0.0 => "mm",
            Dimension::Length => "m",
            Dimension::Mass if is_us => "lb",
            Dimension::Mass => "kg",
            Dimension::Stiffness if is_us => "lb/in",
            Dimension::Stiffness => "N/mm",
            _ => "g",
        }
    }
}

/// A text with its decimal commas as points. Before three digits, a comma may also mark thousands: it stays, and
/// whoever reads the number refuses it.
fn with_points(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let is_decimal = |at: usize| {
        let (before, after) = letters.split_at(at);
        let digits = after
            .iter()
            .skip(1)
            .take_while(|letter| letter.is_ascii_digit());
        before.last().is_some_and(char::is_ascii_digit) && ![0, 3].contains(&digits.count())
    };
    let point = |(at, letter): (usize, &char)| match letter {
        ',' if is_decimal(at) => '.',
        other => *other,
    };
    letters.iter().enumerate().map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, quantity: Field, units: UnitSystem) -> (String, Option<f64>) {
        let text = text.to_owned();
        let read = Entered {
            text,
            quantity,
            units,
        }
        .read();
        (read.asked, read.si)
    }

    #[test]
    fn bare_numbers_have_the_units_of_the_form() {
        use Field::{Acceleration, Length, Mass, Other, Stiffness};
        use UnitSystem::{Si, Us};
        for (text, quantity, units, asked, si) in [
            ("1,8 m", Length, Si, "1.8 m", Some(1.8)),
            ("1800", Length, Si, "1800 mm", Some(1.8)),
            ("1.8", Length, Si, "1.8 m", Some(1.8)),
            (" 0 ", Length, Si, "0 mm", Some(0.0)),
            ("36", Length, Us, "36 in", Some(0.9144)),
            ("36½", Length, Us, "36½ in", Some(0.9271)),
            ("400 mm", Length, Us, "400 mm", Some(0.4)),
            ("6'6\"", Length, Si, "6'6\"", Some(1.9812)),
            // Metres or thousands of millimetres: nobody guesses.
            ("1,800 mm", Length, Si, "1,800 mm", None),
            ("1,800", Length, Si, "1,800", None),
            ("3 apples", Length, Si, "3 apples", None),
            ("", Length, Si, "", None),
            ("150", Mass, Si, "150 kg", Some(150.0)),
            ("2", Mass, Us, "2 lb", Some(0.907_184_74)),
            ("4380", Stiffness, Si, "4380 N/mm", Some(4.38e6)),
            ("rubber-foot", Stiffness, Us, "rubber-foot", None),
            ("0,3", Acceleration, Us, "0.3 g", Some(0.3 * 9.80665)),
            ("0,2-0,8", Other, Si, "0.2-0.8", None),
        ] {
            let expected = (asked.to_owned(), si);
            assert_eq!(read(text, quantity, units), expected, "{text}");
        }
    }
}
