//! Numbers with units, as people write them, converted to SI.
//!
//! A bare number is refused where a dimension is expected: a height of `200` means 200 m to one
//! reader and 200 mm to another. Ratios are bare numbers or percentages.

use crate::problem::{Problem, ProblemKind};
use crate::words::number;

/// The unit g \[m/s²\], as the core has it; this crate uses none of the core's code.
const G0_M_S2: f64 = 9.80665;

/// What a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// Metres.
    Length,
    /// Kilograms.
    Mass,
    /// Seconds.
    Time,
    /// m/s².
    Acceleration,
    /// N/m.
    Stiffness,
    /// Newtons.
    Force,
    /// Viscous damping, N s/m.
    Damping,
    /// Pascals.
    Pressure,
    /// Square metres.
    Area,
    /// Hunt and Crossley's Λ, s/m.
    Dissipation,
    /// Hertz.
    Frequency,
    /// Radians.
    Angle,
    /// rad/s.
    AngularVelocity,
    /// m/s.
    Velocity,
    /// Moment of inertia, kg·m².
    Inertia,
    /// A pure number, bare or in per cent.
    Ratio,
}

impl Dimension {
    /// All dimensions.
    pub const ALL: [Self; 16] = [
        Self::Length,
        Self::Mass,
        Self::Time,
        Self::Acceleration,
        Self::Stiffness,
        Self::Force,
        Self::Damping,
        Self::Pressure,
        Self::Area,
        Self::Dissipation,
        Self::Frequency,
        Self::Angle,
        Self::AngularVelocity,
        Self::Velocity,
        Self::Inertia,
        Self::Ratio,
    ];

    /// The name with its article: `a length`, `an acceleration`.
    pub fn with_article(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Mass => "a mass",
            Self::Time => "a time",
            Self::Acceleration => "an acceleration",
            Self::Stiffness => "a stiffness",
            Self::Force => "a force",
            Self::Damping => "a damping",
            Self::Pressure => "a pressure",
            Self::Area => "an area",
            Self::Dissipation => "a dissipation",
            Self::Frequency => "a frequency",
            Self::Angle => "an angle",
            Self::AngularVelocity => "an angular velocity",
            Self::Velocity => "a velocity",
            Self::Inertia => "a moment of inertia",
            Self::Ratio => "a ratio",
        }
    }

    /// The units of this dimension, the most usual first.
    pub fn units(self) -> impl Iterator<Item = &'static Unit> {
        UNITS.iter().filter(move |unit| unit.dimension == self)
    }

    /// The list of units for hints: `m, mm, cm, km`.
    fn unit_list(self) -> String {
        let symbols: Vec<&str> = self.units().map(|unit| unit.symbol).collect();
        symbols.join(", ")
    }
}

/// A unit: `value_si = value · 10^decimal_exponent · factor`.
///
/// The power of ten is kept apart from the factor because it can be applied to the decimal digits
/// before they become binary: "2300 mm", "230 cm" and "2.3 m" are then the same f64, and so is the
/// result of a study that states either.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Its usual spelling.
    pub symbol: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    decimal_exponent: i32,
    factor: f64,
    /// Other spellings, in the canonical form of [`canonical`].
    aliases: &'static [&'static str],
    /// Whether capitals are ignored. They matter for a leading milli (`mm`, `mg`, `ms`), which as a
    /// capital means mega, and for `m`, `s` and `t`, whose capitals are other units or prefixes.
    any_case: bool,
}

impl Unit {
    /// A unit of acceleration that only a record format has, of `10^decimal_exponent · factor`
    /// m/s².
    pub const fn acceleration(symbol: &'static str, decimal_exponent: i32, factor: f64) -> Self {
        Self { factor, ..unit(symbol, Dimension::Acceleration, decimal_exponent, false) }
    }

    /// A value in this unit, in SI.
    pub fn to_si(&self, value: f64) -> f64 {
        // Powers of ten up to 10^22 are exact in binary, negative ones are not: divide by the exact
        // one. One rounding.
        let shifted = if self.decimal_exponent < 0 {
            value / 10f64.powi(-self.decimal_exponent)
        } else {
            value * 10f64.powi(self.decimal_exponent)
        };
        shifted * self.factor
    }

    /// An SI value in this unit.
    pub fn from_si(&self, value_si: f64) -> f64 {
        let shifted = value_si / self.factor;
        if self.decimal_exponent < 0 {
            shifted * 10f64.powi(-self.decimal_exponent)
        } else {
            shifted / 10f64.powi(self.decimal_exponent)
        }
    }
}

const fn unit(symbol: &'static str, dimension: Dimension, decimal_exponent: i32, any_case: bool) -> Unit {
    Unit { symbol, dimension, decimal_exponent, factor: 1.0, aliases: &[], any_case }
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Every unit, the first of a dimension being its SI unit or the one that engineers expect in a
/// hint.
static UNITS: &[Unit] = &[
    unit("m", Dimension::Length, 0, false),
    unit("mm", Dimension::Length, -3, false),
    unit("cm", Dimension::Length, -2, true),
    unit("km", Dimension::Length, 3, true),
    unit("kg", Dimension::Mass, 0, true),
    unit("t", Dimension::Mass, 3, false),
    unit("s", Dimension::Time, 0, false),
    unit("ms", Dimension::Time, -3, false),
    Unit { aliases: &["µs", "μs"], ..unit("us", Dimension::Time, -6, false) },
    Unit { factor: G0_M_S2, ..unit("g", Dimension::Acceleration, 0, true) },
    Unit { aliases: &["m/s/s"], ..unit("m/s2", Dimension::Acceleration, 0, false) },
    Unit { factor: G0_M_S2, aliases: &["milli-g", "milli·g"], ..unit("mg", Dimension::Acceleration, -3, false) },
    Unit { aliases: &["cm/s/s"], ..unit("cm/s2", Dimension::Acceleration, -2, true) },
    Unit { aliases: &["mm/s/s"], ..unit("mm/s2", Dimension::Acceleration, -3, false) },
    Unit { aliases: &["nm/s/s"], ..unit("nm/s2", Dimension::Acceleration, -9, false) },
    unit("gal", Dimension::Acceleration, -2, true),
    Unit { aliases: &["µm/s2", "μm/s2", "um/s/s"], ..unit("um/s2", Dimension::Acceleration, -6, false) },
    Unit { factor: G0_M_S2, aliases: &["%·g"], ..unit("%g", Dimension::Acceleration, -2, true) },
    Unit { factor: G0_M_S2, ..unit("g/10", Dimension::Acceleration, -1, true) },
    Unit {
        factor: G0_M_S2,
        aliases: &["µg", "μg", "micro-g", "micro·g"],
        ..unit("ug", Dimension::Acceleration, -6, false)
    },
    // An inch is 25.4 mm and a foot 12 inches, exactly (1959).
    Unit { factor: 0.0254, aliases: &["in/s/s"], ..unit("in/s2", Dimension::Acceleration, 0, true) },
    Unit { factor: 0.3048, aliases: &["ft/s/s"], ..unit("ft/s2", Dimension::Acceleration, 0, true) },
    unit("N/mm", Dimension::Stiffness, 3, true),
    unit("N/m", Dimension::Stiffness, 0, true),
    unit("kN/m", Dimension::Stiffness, 3, true),
    unit("kN/mm", Dimension::Stiffness, 6, true),
    unit("MN/m", Dimension::Stiffness, 6, false),
    unit("N", Dimension::Force, 0, false),
    unit("kN", Dimension::Force, 3, true),
    unit("MN", Dimension::Force, 6, false),
    unit("N·s/m", Dimension::Damping, 0, true),
    Unit { aliases: &["N·s/mm"], ..unit("kN·s/m", Dimension::Damping, 3, true) },
    unit("kPa", Dimension::Pressure, 3, false),
    unit("Pa", Dimension::Pressure, 0, false),
    unit("MPa", Dimension::Pressure, 6, false),
    unit("bar", Dimension::Pressure, 5, true),
    // A pound is 0.45359237 kg, an inch 25.4 mm, exactly.
    Unit { factor: 0.453_592_37 * G0_M_S2 / (0.0254 * 0.0254), ..unit("psi", Dimension::Pressure, 0, true) },
    unit("m2", Dimension::Area, 0, false),
    unit("cm2", Dimension::Area, -4, false),
    unit("mm2", Dimension::Area, -6, false),
    unit("s/m", Dimension::Dissipation, 0, false),
    unit("s/mm", Dimension::Dissipation, 3, false),
    unit("Hz", Dimension::Frequency, 0, true),
    unit("kHz", Dimension::Frequency, 3, true),
    unit("rad", Dimension::Angle, 0, true),
    Unit { factor: DEGREE, aliases: &["°"], ..unit("deg", Dimension::Angle, 0, true) },
    unit("mrad", Dimension::Angle, -3, false),
    unit("rad/s", Dimension::AngularVelocity, 0, true),
    Unit { factor: DEGREE, aliases: &["°/s"], ..unit("deg/s", Dimension::AngularVelocity, 0, true) },
    unit("m/s", Dimension::Velocity, 0, false),
    unit("mm/s", Dimension::Velocity, -3, false),
    unit("cm/s", Dimension::Velocity, -2, true),
    Unit { aliases: &["kgm2"], ..unit("kg·m2", Dimension::Inertia, 0, true) },
    unit("%", Dimension::Ratio, -2, false),
];

/// Converts the spellings of a unit to one: `m / s²`, `m s^-2`, `m·s⁻²` → `m/s2`, `kg m^2` and
/// `kg*m2` → `kg·m2`.
fn canonical(text: &str) -> String {
    let plain = text.replace('⁻', "-").replace('²', "2").replace(['⋅', '*'], "·");
    let spaced = plain.replace('^', "").replace('º', "°");
    let mut out = spaced.split_whitespace().collect::<Vec<_>>().join(" ");
    for sign in ["/", "·"] {
        out = out.split(sign).map(str::trim).collect::<Vec<_>>().join(sign);
    }
    out.replace(' ', "·").replace("kg.m2", "kg·m2").replace("·s-2", "/s2").replace(".s-2", "/s2")
}

/// The unit that is written `text`, of any dimension.
pub fn lookup(text: &str) -> Option<&'static Unit> {
    let name = canonical(text);
    UNITS.iter().find(|unit| {
        unit.symbol == name
            || unit.aliases.contains(&name.as_str())
            || unit.any_case
                && (unit.symbol.eq_ignore_ascii_case(&name)
                    || unit.aliases.iter().any(|alias| alias.eq_ignore_ascii_case(&name)))
    })
}

/// The unit that is written `text`, which must measure `dimension`.
///
/// # Errors
/// An unknown unit, or one that measures something else.
///
/// # Example
/// ```
/// use freestand_input::quantity::{Dimension, find_unit};
/// assert_eq!(find_unit("m/s²", Dimension::Acceleration)?.to_si(2.0), 2.0);
/// assert!(find_unit("kg", Dimension::Acceleration).is_err());
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn find_unit(text: &str, dimension: Dimension) -> Result<&'static Unit, Problem> {
    let Some(unit) = lookup(text) else { return Err(unknown_unit(text, dimension)) };
    if unit.dimension == dimension { Ok(unit) } else { Err(wrong_dimension(text, unit, dimension)) }
}

fn unknown_unit(text: &str, dimension: Dimension) -> Problem {
    let name = canonical(text);
    // A capital that changes the meaning is refused; the hint names the unit that was probably
    // meant.
    let near = dimension.units().find(|unit| unit.symbol.eq_ignore_ascii_case(&name));
    let problem = value_problem(format!("\"{}\" is not a unit of {}", shorten(text), dimension.with_article()));
    match near {
        Some(unit) => problem.hint(format!("write \"{}\": capital letters matter here", unit.symbol)),
        None if dimension == Dimension::Ratio => {
            problem.hint("write a bare number or a percentage, such as 0.05 or 5 %")
        }
        None => problem.hint(format!("known: {}", dimension.unit_list())),
    }
}

fn wrong_dimension(text: &str, unit: &Unit, expected: Dimension) -> Problem {
    let text = shorten(text);
    let problem =
        value_problem(format!("\"{text}\" is {}, not {}", unit.dimension.with_article(), expected.with_article()));
    match expected {
        // A user who writes "150 g" for a mass means grams.
        Dimension::Mass if unit.symbol == "g" => problem.hint("g is the acceleration of gravity here; write kg or t"),
        Dimension::Ratio => problem.hint("write a bare number or a percentage, such as 0.05 or 5 %"),
        _ => problem.hint(format!("known units: {}", expected.unit_list())),
    }
}

/// A quantity such as `"2.3 m"`, `2300mm`, `0.35g` or `5 %`, in SI.
///
/// # Errors
/// No number, a number without its unit, a unit that is unknown or measures something else, or a
/// value that is not finite.
///
/// # Example
/// ```
/// use freestand_input::quantity::{Dimension, parse};
/// assert_eq!(parse("2300mm", Dimension::Length)?, 2.3);
/// assert_eq!(parse("4380 N/mm", Dimension::Stiffness)?, 4_380_000.0);
/// assert_eq!(parse("5 %", Dimension::Ratio)?, 0.05);
/// let problem = parse("2.3", Dimension::Length).unwrap_err();
/// assert_eq!(problem.message, "\"2.3\" needs a unit");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse(text: &str, dimension: Dimension) -> Result<f64, Problem> {
    let text = text.trim();
    let number = split_number(text)?;
    if number.unit.is_empty() {
        return if dimension == Dimension::Ratio {
            number.scaled(text, 0, 1.0)
        } else {
            let text = shorten(text);
            let mut written = dimension.units().take(2).map(|unit| format!("\"{text} {}\"", unit.symbol));
            let (first, second) = (written.next().unwrap_or_default(), written.next());
            let hint = second.map_or_else(|| format!("write {first}"), |second| format!("write {first} or {second}"));
            Err(Problem::value(format!("\"{text}\" needs a unit"), hint))
        };
    }
    let Some(unit) = lookup(number.unit) else { return Err(unknown_unit(number.unit, dimension)) };
    if unit.dimension != dimension {
        return Err(wrong_dimension(text, unit, dimension));
    }
    number.scaled(text, unit.decimal_exponent, unit.factor)
}

/// A bare number in a place whose key or column header states the unit: `("200", "mm")`, in SI.
///
/// # Errors
/// Anything but one finite number, or a unit that is unknown or measures something else.
pub fn parse_in_unit(text: &str, unit: &Unit) -> Result<f64, Problem> {
    let text = text.trim();
    let number = split_number(text)?;
    if !number.unit.is_empty() {
        return Err(value_problem(format!("\"{}\" is not a number", shorten(text)))
            .hint(format!("the unit is already stated ({}): write only the number", unit.symbol)));
    }
    number.scaled(text, unit.decimal_exponent, unit.factor)
}

/// As [`parse`], and positive; `name` is what the message calls it ("the height").
///
/// # Errors
/// As [`parse`], or a value that is zero or negative.
pub fn parse_positive(text: &str, dimension: Dimension, name: &str) -> Result<f64, Problem> {
    let value = parse(text, dimension)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err(value_problem(format!("{name} must be positive, not \"{}\"", shorten(text.trim()))))
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
        Err(value_problem(format!("{name} must not be negative: \"{}\"", shorten(text.trim()))))
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
        return Err(value_problem(format!("\"{}\" is not a grid", shorten(text)))
            .hint("write from:to:count, such as \"0.3 m:4 m:64\", or a list"));
    };
    let (from_si, to_si) = (value(from)?, value(to)?);
    if let (Some(per_octave), Dimension::Frequency) = (count.strip_suffix("/oct"), dimension) {
        return octave_grid(from_si, to_si, grid_count(per_octave.trim_end(), 1)?);
    }
    let count = grid_count(count, if from_si == to_si { 1 } else { 2 })?;
    Ok((0..count).map(|i| linear_point(from_si, to_si, i, count)).collect())
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
        return Err(Problem::value("a grid in octaves must rise from a positive frequency", hint));
    }
    let steps = (to_hz / from_hz).log2() * per_octave as f64;
    if steps >= MAX_GRID_VALUES as f64 {
        return Err(too_many());
    }
    // 1e-9 of a step is far above the rounding of the logarithm and far below any difference that
    // matters: it keeps "1 Hz:8 Hz:3/oct" from ending in two values that differ by rounding.
    let whole = (steps + 1e-9).floor();
    let mut grid: Vec<f64> = (0..=whole as usize).map(|i| from_hz * (i as f64 / per_octave as f64).exp2()).collect();
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
        _ => Err(value_problem(format!("\"{}\" is not a whole number of at least {least}", shorten(text)))
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

/// The parts of a number, and the text that follows it.
struct Number<'a> {
    /// Sign, digits and point, without exponent.
    mantissa: String,
    exponent: i32,
    unit: &'a str,
}

impl Number<'_> {
    /// The value times `10^decimal_exponent · factor`. The power of ten is applied before the
    /// digits become binary.
    fn scaled(&self, text: &str, decimal_exponent: i32, factor: f64) -> Result<f64, Problem> {
        let exponent = self.exponent.saturating_add(decimal_exponent);
        match format!("{}e{exponent}", self.mantissa).parse::<f64>() {
            Ok(value) if (value * factor).is_finite() => Ok(value * factor),
            _ => Err(value_problem(format!("\"{}\" is too large for a number", shorten(text)))),
        }
    }
}

fn split_number(text: &str) -> Result<Number<'_>, Problem> {
    let not_a_number = || {
        if text.is_empty() {
            value_problem("a quantity is missing")
        } else {
            value_problem(format!("\"{}\" is not a quantity", shorten(text)))
        }
        .hint("write a number and its unit, such as \"2.3 m\"")
    };
    let (negative, unsigned) = match text.strip_prefix(['-', '\u{2212}']) {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let digits = |s: &str| s.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(unsigned);
    let mut end = whole;
    if unsigned[end..].starts_with('.') {
        let fraction = digits(&unsigned[end + 1..]);
        if whole + fraction == 0 {
            return Err(not_a_number());
        }
        end += 1 + fraction;
    } else if whole == 0 {
        return Err(not_a_number());
    }
    let mut mantissa = String::with_capacity(end + 1);
    if negative {
        mantissa.push('-');
    }
    mantissa.push_str(&unsigned[..end]);

    // An e that no digits follow is the beginning of a (wrong) unit.
    let mut rest = &unsigned[end..];
    let mut exponent = 0;
    if let Some(after) = rest.strip_prefix(['e', 'E']) {
        let sign = usize::from(after.starts_with(['+', '-']));
        let length = digits(&after[sign..]);
        if length > 0 {
            // Beyond i32 the value is 0 or infinite anyway; saturate and let the parser say which.
            let saturated = if after.starts_with('-') { i32::MIN / 2 } else { i32::MAX / 2 };
            exponent = after[..sign + length].parse().unwrap_or(saturated);
            rest = &after[sign + length..];
        }
    }
    let unit = rest.trim();
    match unit.chars().next() {
        Some(',') => Err(value_problem(format!("\"{}\" has a comma in the number", shorten(text)))
            .hint("write the decimal sign as a point: \"2.3 m\"")),
        Some(c) if c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '_' | '\'') => {
            Err(value_problem(format!("\"{}\" is more than one number", shorten(text)))
                .hint("write the digits without separators and the unit once, such as \"2300 mm\""))
        }
        _ => Ok(Number { mantissa, exponent, unit }),
    }
}

fn value_problem(message: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Value, message)
}

/// A text of the user, without line breaks and cut to a length that fits a message.
pub fn shorten(text: &str) -> String {
    const LONGEST: usize = 60;
    let clean: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(LONGEST + 1).collect();
    if clean.chars().count() <= LONGEST { clean } else { clean.chars().take(LONGEST).chain(['…']).collect() }
}

#[cfg(test)]
mod tests;
