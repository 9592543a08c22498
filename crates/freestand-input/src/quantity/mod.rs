//! Numbers with units, as people write them, converted to SI.
//!
//! A bare number is refused where a dimension is expected: a height of `200` means 200 m to one
//! reader and 200 mm to another. Ratios are bare numbers or percentages.

use crate::problem::{Problem, ProblemKind};
use crate::words::number;

mod number;
mod spelling;
mod system;
mod units;

use number::{Number, Split, split};
use spelling::plain;
pub use system::UnitSystem;
pub use units::{Dimension, Unit, find_unit, find_unit_any_case, lookup};
use units::{unknown_unit, wrong_dimension};

/// A number, and the unit it was written with, if there is one.
///
/// For tables, where the unit may also come from a heading: the unit of a cell is known before its
/// value is needed.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    number: Number,
    /// The unit; inches after feet and inches.
    pub unit: Option<&'static Unit>,
}

impl Quantity {
    /// Reads `6'2"`, `11 1/2 in`, `150 lbs`, `52½`, `2.3 m` or `0.35`.
    ///
    /// # Errors
    /// No number, a unit that is not known, or what [`parse`] refuses in a number.
    ///
    /// # Example
    /// ```
    /// use freestand_input::quantity::{Dimension, Quantity, find_unit};
    /// let inch = find_unit("in", Dimension::Length)?;
    /// let cell = Quantity::read("6'2\"")?;
    /// assert_eq!((cell.unit, cell.si(None)?), (Some(inch), 1.8796));
    /// let bare = Quantity::read("52½")?;
    /// assert_eq!((bare.unit, bare.si(Some(inch))?), (None, 1.3335));
    /// # Ok::<(), freestand_input::problem::Problem>(())
    /// ```
    pub fn read(text: &str) -> Result<Self, Problem> {
        let text = text.trim();
        let plain = plain(text);
        let found = split(plain.trim(), text)?;
        let unit = match found.unit.as_ref() {
            "" => None,
            unit => Some(
                lookup(unit)
                    .ok_or_else(|| value_problem(format!("\"{}\" is not a unit", shorten(unit))))?,
            ),
        };
        Ok(Self {
            number: found.number,
            unit,
        })
    }

    /// The value in SI. `other` is the unit where the quantity states none; without either, the
    /// bare number.
    ///
    /// # Errors
    /// A value that is larger than [`LARGEST_SI`].
    pub fn si(&self, other: Option<&Unit>) -> Result<f64, Problem> {
        let unit = self.unit.or(other);
        self.number
            .in_unit(unit)
            .filter(|value_si| is_possible(*value_si))
            .ok_or_else(|| value_problem("the number is too large").hint(TOO_LARGE))
    }

    /// The number as it was written, without its unit; feet and inches in inches.
    ///
    /// # Errors
    /// A number that is larger than [`LARGEST_SI`].
    pub fn bare(&self) -> Result<f64, Problem> {
        self.number
            .in_unit(None)
            .filter(|value| is_possible(*value))
            .ok_or_else(|| value_problem("the number is too large").hint(TOO_LARGE))
    }
}
/// A quantity such as `"2.3 m"`, `2300mm`, `6'2"`, `11 1/2 in`, `0.35g` or `5 %`, in SI.
///
/// Feet and inches: whole feet without a sign, then less than 12 inches with their mark. A fraction
/// may follow a whole number after a blank or a hyphen, or be a character (`52½`).
///
/// # Errors
/// No number, a number without its unit, a unit that is unknown or measures something else, or a
/// value that is larger than [`LARGEST_SI`].
///
/// # Example
/// ```
/// use freestand_input::quantity::{Dimension, parse};
/// assert_eq!(parse("2300mm", Dimension::Length)?, 2.3);
/// assert_eq!(parse("4380 N/mm", Dimension::Stiffness)?, 4_380_000.0);
/// assert_eq!(parse("5 %", Dimension::Ratio)?, 0.05);
/// assert_eq!(parse("6'2\"", Dimension::Length)?, 1.8796);
/// assert_eq!(parse("150 lb", Dimension::Mass)?, 68.038_855_5);
/// let problem = parse("2.3", Dimension::Length).unwrap_err();
/// assert_eq!(problem.message, "\"2.3\" needs a unit");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse(text: &str, dimension: Dimension) -> Result<f64, Problem> {
    possible(read(text, dimension)?, text)
}

/// As [`parse`], but of any size: a coefficient whose unit has a power, such as N/mm⁵.
///
/// # Errors
/// As [`parse`], and a value that is not above zero; `name` is what the message calls it.
pub fn parse_coefficient(text: &str, dimension: Dimension, name: &str) -> Result<f64, Problem> {
    above_zero(
        read(text, dimension)?.ok_or_else(|| too_large(text))?,
        text,
        name,
    )
}

/// The value in SI; `None` if it is not finite.
fn read(text: &str, dimension: Dimension) -> Result<Option<f64>, Problem> {
    let text = text.trim();
    let plain = plain(text);
    let Split { number, unit } = split(plain.trim(), text)?;
    if unit.is_empty() {
        return if dimension == Dimension::Ratio {
            Ok(number.in_unit(None))
        } else {
            let text = shorten(text);
            let mut written = dimension
                .units()
                .take(2)
                .map(|unit| format!("\"{text} {}\"", unit.symbol));
            let (first, second) = (written.next().unwrap_or_default(), written.next());
            let hint = second.map_or_else(
                || format!("write {first}"),
                |second| format!("write {first} or {second}"),
            );
            Err(Problem::value(format!("\"{text}\" needs a unit"), hint))
        };
    }
    let Some(unit) = lookup(&unit) else {
        return Err(unknown_unit(&unit, dimension));
    };
    if unit.dimension != dimension {
        return Err(wrong_dimension(text, unit, dimension));
    }
    Ok(number.in_unit(Some(unit)))
}

/// A bare number in a place whose key or column header states the unit: `("200", "mm")`, in SI.
///
/// # Errors
/// Anything but one number up to [`LARGEST_SI`], or a unit that is unknown or measures something else.
pub fn parse_in_unit(text: &str, unit: &Unit) -> Result<f64, Problem> {
    let text = text.trim();
    let plain = plain(text);
    let found = split(plain.trim(), text)?;
    if !found.unit.is_empty() {
        return Err(
            value_problem(format!("\"{}\" is not a number", shorten(text))).hint(format!(
                "the unit is already stated ({}): write only the number",
                unit.symbol
            )),
        );
    }
    possible(found.number.in_unit(Some(unit)), text)
}

fn possible(value: Option<f64>, text: &str) -> Result<f64, Problem> {
    let value = value.filter(|value_si| is_possible(*value_si));
    value.ok_or_else(|| too_large(text))
}

/// What is said of a quantity that is too large.
pub fn too_large(written: &str) -> Problem {
    value_problem(format!("\"{}\" is too large", shorten(written.trim()))).hint(TOO_LARGE)
}

/// No quantity is larger, in SI: a larger one is a slip, and its powers would overflow.
pub const LARGEST_SI: f64 = 1e18;

/// The remedy for a larger one.
const TOO_LARGE: &str = "check the number and its unit: no quantity is above 1e18 in SI units";

/// Whether a quantity may have this value in SI.
pub fn is_possible(value_si: f64) -> bool {
    value_si.abs() <= LARGEST_SI
}

/// As [`parse`], and positive; `name` is what the message calls it ("the height").
///
/// # Errors
/// As [`parse`], or a value that is zero or negative.
pub fn parse_positive(text: &str, dimension: Dimension, name: &str) -> Result<f64, Problem> {
    above_zero(parse(text, dimension)?, text, name)
}

fn above_zero(value: f64, text: &str, name: &str) -> Result<f64, Problem> {
    if value > 0.0 {
        Ok(value)
    } else {
        Err(value_problem(format!(
            "{name} must be positive, not \"{}\"",
            shorten(text.trim())
        )))
    }
}

/// As [`parse`], and zero or more; `name` is what the message calls it ("the cg rise").
///
/// # Errors
/// As [`parse`], or a negative value.
pub fn parse_non_negative(text: &str, dimension: Dimension, name: &str) -> Result<f64, Problem> {
    let value = parse(text, dimension)?;
    if value >= 0.0 {
        Ok(value)
    } else {
        Err(value_problem(format!(
            "{name} must not be negative: \"{}\"",
            shorten(text.trim())
        )))
    }
}

/// The most values that a grid may have: a typing error in the count must not fill the memory.
pub const MAX_GRID_VALUES: usize = 1_000_000;

/// A grid, in SI: `from:to:count` (linear, both ends exact) or a list `200 mm, 400 mm`, each value
/// with its own unit.
///
/// Frequencies may also be spaced by parts of an octave, `1 Hz:10 kHz:12/oct`: from the first
/// upwards in steps of 2^(1/12), up to the last, which is added if the steps do not reach it.
///
/// # Errors
/// A value that [`parse`] refuses, a count that is not a whole number from 2 (from 1 where both
/// ends are equal) to [`MAX_GRID_VALUES`], or an octave grid that does not rise from a positive
/// frequency.
///
/// # Example
/// ```
/// use freestand_input::quantity::{Dimension, parse_grid};
/// assert_eq!(parse_grid("1 m:2 m:3", Dimension::Length)?, [1.0, 1.5, 2.0]);
/// assert_eq!(parse_grid("200 mm, 0.4 m", Dimension::Length)?, [0.2, 0.4]);
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse_grid(text: &str, dimension: Dimension) -> Result<Vec<f64>, Problem> {
    grid_of(text, dimension, |item| parse(item, dimension))
}

/// As [`parse_grid`], of bare numbers in a place whose key states the unit: `("500:1000:3", "mm")`,
/// in SI.
///
/// # Errors
/// As [`parse_grid`], with [`parse_in_unit`] for each value.
pub fn parse_grid_in_unit(text: &str, unit: &Unit) -> Result<Vec<f64>, Problem> {
    grid_of(text, unit.dimension, |item| parse_in_unit(item, unit))
}

fn grid_of(
    text: &str,
    dimension: Dimension,
    value: impl Fn(&str) -> Result<f64, Problem>,
) -> Result<Vec<f64>, Problem> {
    let text = text.trim();
    if !text.contains(':') {
        return text.split(',').map(value).collect();
    }
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let &[from, to, count] = parts.as_slice() else {
        return Err(
            value_problem(format!("\"{}\" is not a grid", shorten(text)))
                .hint("write from:to:count, such as \"0.3 m:4 m:64\", or a list"),
        );
    };
    let (from_si, to_si) = (value(from)?, value(to)?);
    if let (Some(per_octave), Dimension::Frequency) = (count.strip_suffix("/oct"), dimension) {
        return octave_grid(from_si, to_si, grid_count(per_octave.trim_end(), 1)?);
    }
    let count = grid_count(count, if from_si == to_si { 1 } else { 2 })?;
    Ok((0..count)
        .map(|i| linear_point(from_si, to_si, i, count))
        .collect())
}

fn linear_point(from: f64, to: f64, i: usize, count: usize) -> f64 {
    // The ends are returned exactly as written: 0.3 + (4 - 0.3)·1 may differ from 4.
    match i {
        0 => from,
        _ if i + 1 == count => to,
        // One division after exact weights: 0.5 m:3 m:26 gives 1.5 m and 0.9 m, not their
        // neighbours.
        _ => (from * (count - 1 - i) as f64 + to * i as f64) / (count - 1) as f64,
    }
}

fn octave_grid(from_hz: f64, to_hz: f64, per_octave: usize) -> Result<Vec<f64>, Problem> {
    if !(from_hz > 0.0 && to_hz >= from_hz) {
        let hint = "write from:to:N/oct with rising frequencies, such as \"1 Hz:10 kHz:12/oct\"";
        return Err(Problem::value(
            "a grid in octaves must rise from a positive frequency",
            hint,
        ));
    }
    let steps = (to_hz / from_hz).log2() * per_octave as f64;
    if steps >= MAX_GRID_VALUES as f64 {
        return Err(too_many());
    }
    // 1e-9 of a step is far above the rounding of the logarithm and far below any difference that
    // matters: it keeps "1 Hz:8 Hz:3/oct" from ending in two values that differ by rounding.
    let whole = (steps + 1e-9).floor();
    let mut grid: Vec<f64> = (0..=whole as usize)
        .map(|i| from_hz * (i as f64 / per_octave as f64).exp2())
        .collect();
    if steps - whole > 1e-9 {
        grid.push(to_hz);
    } else if let Some(last) = grid.last_mut() {
        *last = to_hz;
    }
    Ok(grid)
}

fn grid_count(text: &str, least: usize) -> Result<usize, Problem> {
    match text.parse::<usize>() {
        Ok(count) if count > MAX_GRID_VALUES => Err(too_many()),
        Ok(count) if count >= least => Ok(count),
        _ => Err(value_problem(format!(
            "\"{}\" is not a whole number of at least {least}",
            shorten(text)
        ))
        .hint("a grid is from:to:count, such as \"0.3 m:4 m:64\"")),
    }
}

fn too_many() -> Problem {
    value_problem(format!("a grid may have at most {MAX_GRID_VALUES} values"))
}

/// An SI value in the unit in which engineers read it, to 6 significant digits: `200 mm`, `2.3 m`,
/// `4380 N/mm`, `0.35 g`.
pub fn format_si(value_si: f64, dimension: Dimension) -> String {
    let symbol = match dimension {
        Dimension::Length if value_si.abs() < 1.0 && value_si != 0.0 => "mm",
        Dimension::Length => "m",
        Dimension::Mass => "kg",
        Dimension::Time if value_si.abs() < 0.1 && value_si != 0.0 => "ms",
        Dimension::Time => "s",
        Dimension::Acceleration => "g",
        Dimension::Stiffness => "N/mm",
        Dimension::Force => "N",
        Dimension::Damping => "N·s/m",
        Dimension::Pressure => "kPa",
        Dimension::Area => "m2",
        Dimension::Dissipation => "s/m",
        Dimension::Frequency => "Hz",
        Dimension::Angle => "rad",
        Dimension::AngularVelocity => "rad/s",
        Dimension::Velocity => "m/s",
        Dimension::Inertia => "kg·m2",
        Dimension::Ratio => return number(value_si, 6),
    };
    let value = lookup(symbol).map_or(value_si, |unit| unit.from_si(value_si));
    format!("{} {}", number(value, 6), symbol.replace("m2", "m²"))
}

fn value_problem(message: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Value, message)
}

/// A text of the user, without line breaks and cut to a length that fits a message.
pub fn shorten(text: &str) -> String {
    const LONGEST: usize = 60;
    let clean: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .take(LONGEST + 1)
        .collect();
    if clean.chars().count() <= LONGEST {
        clean
    } else {
        clean.chars().take(LONGEST).chain(['…']).collect()
    }
}

#[cfg(test)]
mod tests;
