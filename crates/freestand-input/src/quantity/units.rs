//! What a quantity measures, and the units that it may have.

use super::spelling::plain;
use super::{shorten, value_problem};
use crate::problem::Problem;

/// The unit g \[m/s²\], as the core has it; this crate uses none of the core's code.
pub(super) const G0_M_S2: f64 = 9.80665;

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

/// A unit: `value_si = value · 10^decimal_exponent · whole / divisor · factor`.
///
/// The power of ten and both whole numbers are kept apart from the factor because they can be
/// applied to the decimal digits before these become binary: "2300 mm", "230 cm" and "2.3 m" are
/// then the same f64, and so are "12 in", "1 ft" and "0.3048 m".
///
/// # Accuracy
/// A unit without a factor and a divisor gives the f64 that is nearest to the exact value (inches,
/// feet, pounds, pounds-force, kips); one with either has one rounding more (g, degrees, slugs,
/// lbf/in, psi).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Its usual spelling.
    pub symbol: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    pub(super) decimal_exponent: i32,
    pub(super) whole: u64,
    pub(super) divisor: u32,
    pub(super) factor: f64,
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
        Self {
            factor,
            ..unit(symbol, Dimension::Acceleration, decimal_exponent, false)
        }
    }

    /// A value in this unit, in SI.
    pub fn to_si(&self, value: f64) -> f64 {
        // The product with the whole number is exact for values of few digits. Powers of ten up to
        // 10^22 are exact in binary, negative ones are not: divide by the exact one. One rounding.
        let whole = value * self.whole as f64;
        let shifted = if self.decimal_exponent < 0 {
            whole / 10f64.powi(-self.decimal_exponent)
        } else {
            whole * 10f64.powi(self.decimal_exponent)
        };
        shifted / f64::from(self.divisor) * self.factor
    }

    /// An SI value in this unit.
    pub fn from_si(&self, value_si: f64) -> f64 {
        let shifted = value_si / self.factor * f64::from(self.divisor);
        let whole = if self.decimal_exponent < 0 {
            shifted * 10f64.powi(-self.decimal_exponent)
        } else {
            shifted / 10f64.powi(self.decimal_exponent)
        };
        whole / self.whole as f64
    }
}

const fn unit(
    symbol: &'static str,
    dimension: Dimension,
    decimal_exponent: i32,
    any_case: bool,
) -> Unit {
    Unit {
        symbol,
        dimension,
        decimal_exponent,
        whole: 1,
        divisor: 1,
        factor: 1.0,
        aliases: &[],
        any_case,
    }
}

/// A unit of `whole · 10^decimal_exponent` SI units, exactly; capitals are ignored.
const fn customary(
    symbol: &'static str,
    dimension: Dimension,
    whole: u64,
    decimal_exponent: i32,
    aliases: &'static [&'static str],
) -> Unit {
    Unit {
        whole,
        aliases,
        ..unit(symbol, dimension, decimal_exponent, true)
    }
}

// An inch is 25.4 mm, a foot 12 and a yard 36 inches; a pound 0.45359237 kg (international yard and
// pound agreement, 1959); a pound-force a pound times 9.80665 m/s²: 4.4482216152605 N. All exactly.
const INCH_E4: u64 = 254;
const FOOT_E4: u64 = 3048;
const YARD_E4: u64 = 9144;
const POUND_E8: u64 = 45_359_237;
const POUND_FORCE_E13: u64 = 44_482_216_152_605;

pub(super) const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Every unit, the first of a dimension being its SI unit or the one that engineers expect in a
/// hint.
static UNITS: &[Unit] = &[
    Unit {
        aliases: &["metre", "metres", "meter", "meters"],
        ..unit("m", Dimension::Length, 0, false)
    },
    Unit {
        aliases: &["millimetre", "millimetres", "millimeter", "millimeters"],
        ..unit("mm", Dimension::Length, -3, false)
    },
    Unit {
        aliases: &["centimetre", "centimetres", "centimeter", "centimeters"],
        ..unit("cm", Dimension::Length, -2, true)
    },
    unit("dm", Dimension::Length, -1, true),
    unit("km", Dimension::Length, 3, true),
    customary(
        "in",
        Dimension::Length,
        INCH_E4,
        -4,
        &["inch", "inches", "\"", "''"],
    ),
    customary("ft", Dimension::Length, FOOT_E4, -4, &["feet", "foot", "'"]),
    customary("yd", Dimension::Length, YARD_E4, -4, &["yard", "yards"]),
    Unit {
        aliases: &["kgs", "kilogram", "kilograms"],
        ..unit("kg", Dimension::Mass, 0, true)
    },
    Unit {
        aliases: &["tonne", "tonnes"],
        ..unit("t", Dimension::Mass, 3, false)
    },
    customary(
        "lb",
        Dimension::Mass,
        POUND_E8,
        -8,
        &["lbs", "lbm", "pound", "pounds"],
    ),
    // A sixteenth of a pound, 625e-4 of it.
    customary(
        "oz",
        Dimension::Mass,
        POUND_E8 * 625,
        -12,
        &["ounce", "ounces"],
    ),
    // The mass to which a pound-force gives 1 ft/s²: 4.448… N over 0.3048 m/s².
    Unit {
        divisor: 3048,
        ..customary("slug", Dimension::Mass, POUND_FORCE_E13, -9, &["slugs"])
    },
    // 2000 pounds.
    customary(
        "short ton",
        Dimension::Mass,
        POUND_E8 * 2,
        -5,
        &["short·ton", "short·tons"],
    ),
    unit("s", Dimension::Time, 0, false),
    unit("ms", Dimension::Time, -3, false),
    Unit {
        aliases: &["µs", "μs"],
        ..unit("us", Dimension::Time, -6, false)
    },
    Unit {
        factor: G0_M_S2,
        ..unit("g", Dimension::Acceleration, 0, true)
    },
    Unit {
        aliases: &["m/s/s"],
        ..unit("m/s2", Dimension::Acceleration, 0, false)
    },
    Unit {
        factor: G0_M_S2,
        aliases: &["milli-g", "milli·g"],
        ..unit("mg", Dimension::Acceleration, -3, false)
    },
    Unit {
        aliases: &["cm/s/s"],
        ..unit("cm/s2", Dimension::Acceleration, -2, true)
    },
    Unit {
        aliases: &["mm/s/s"],
        ..unit("mm/s2", Dimension::Acceleration, -3, false)
    },
    Unit {
        aliases: &["nm/s/s"],
        ..unit("nm/s2", Dimension::Acceleration, -9, false)
    },
    unit("gal", Dimension::Acceleration, -2, true),
    Unit {
        aliases: &["µm/s2", "μm/s2", "um/s/s"],
        ..unit("um/s2", Dimension::Acceleration, -6, false)
    },
    Unit {
        factor: G0_M_S2,
        aliases: &["%·g"],
        ..unit("%g", Dimension::Acceleration, -2, true)
    },
    Unit {
        factor: G0_M_S2,
        ..unit("g/10", Dimension::Acceleration, -1, true)
    },
    Unit {
        factor: G0_M_S2,
        aliases: &["µg", "μg", "micro-g", "micro·g"],
        ..unit("ug", Dimension::Acceleration, -6, false)
    },
    customary("in/s2", Dimension::Acceleration, INCH_E4, -4, &["in/s/s"]),
    customary("ft/s2", Dimension::Acceleration, FOOT_E4, -4, &["ft/s/s"]),
    unit("N/mm", Dimension::Stiffness, 3, true),
    unit("N/m", Dimension::Stiffness, 0, true),
    unit("kN/m", Dimension::Stiffness, 3, true),
    unit("kN/mm", Dimension::Stiffness, 6, true),
    unit("MN/m", Dimension::Stiffness, 6, false),
    // A pound-force over 0.0254 m, and over 0.3048 m.
    Unit {
        divisor: 254,
        ..customary(
            "lbf/in",
            Dimension::Stiffness,
            POUND_FORCE_E13,
            -9,
            &["lb/in", "lbs/in", "lb/inch", "lbf/inch"],
        )
    },
    Unit {
        divisor: 3048,
        ..customary(
            "lbf/ft",
            Dimension::Stiffness,
            POUND_FORCE_E13,
            -9,
            &["lb/ft", "lbs/ft", "lb/foot", "lbf/foot"],
        )
    },
    Unit {
        divisor: 254,
        ..customary(
            "kip/in",
            Dimension::Stiffness,
            POUND_FORCE_E13,
            -6,
            &["kips/in", "kip/inch", "kips/inch"],
        )
    },
    Unit {
        divisor: 3048,
        ..customary(
            "kip/ft",
            Dimension::Stiffness,
            POUND_FORCE_E13,
            -6,
            &["kips/ft", "kip/foot", "kips/foot"],
        )
    },
    unit("N", Dimension::Force, 0, false),
    unit("kN", Dimension::Force, 3, true),
    unit("MN", Dimension::Force, 6, false),
    customary("lbf", Dimension::Force, POUND_FORCE_E13, -13, &[]),
    customary("kip", Dimension::Force, POUND_FORCE_E13, -10, &["kips"]),
    customary("kgf", Dimension::Force, 980_665, -5, &[]),
    unit("N·s/m", Dimension::Damping, 0, true),
    Unit {
        aliases: &["N·s/mm"],
        ..unit("kN·s/m", Dimension::Damping, 3, true)
    },
    unit("kPa", Dimension::Pressure, 3, false),
    unit("Pa", Dimension::Pressure, 0, false),
    unit("MPa", Dimension::Pressure, 6, false),
    unit("bar", Dimension::Pressure, 5, true),
    // A pound-force on (0.0254 m)² = 64516e-8 m².
    Unit {
        divisor: 64_516,
        ..customary(
            "psi",
            Dimension::Pressure,
            POUND_FORCE_E13,
            -5,
            &["lb/in2", "lbf/in2"],
        )
    },
    Unit {
        divisor: 64_516,
        ..customary(
            "ksi",
            Dimension::Pressure,
            POUND_FORCE_E13,
            -2,
            &["kip/in2"],
        )
    },
    unit("m2", Dimension::Area, 0, false),
    unit("cm2", Dimension::Area, -4, false),
    unit("mm2", Dimension::Area, -6, false),
    unit("s/m", Dimension::Dissipation, 0, false),
    unit("s/mm", Dimension::Dissipation, 3, false),
    unit("Hz", Dimension::Frequency, 0, true),
    unit("kHz", Dimension::Frequency, 3, true),
    unit("rad", Dimension::Angle, 0, true),
    Unit {
        factor: DEGREE,
        aliases: &["°"],
        ..unit("deg", Dimension::Angle, 0, true)
    },
    unit("mrad", Dimension::Angle, -3, false),
    unit("rad/s", Dimension::AngularVelocity, 0, true),
    Unit {
        factor: DEGREE,
        aliases: &["°/s"],
        ..unit("deg/s", Dimension::AngularVelocity, 0, true)
    },
    unit("m/s", Dimension::Velocity, 0, false),
    unit("mm/s", Dimension::Velocity, -3, false),
    unit("cm/s", Dimension::Velocity, -2, true),
    customary("in/s", Dimension::Velocity, INCH_E4, -4, &["ips"]),
    customary("ft/s", Dimension::Velocity, FOOT_E4, -4, &["fps"]),
    Unit {
        aliases: &["kgm2"],
        ..unit("kg·m2", Dimension::Inertia, 0, true)
    },
    unit("%", Dimension::Ratio, -2, false),
];

/// Converts the spellings of a unit to one: `m / s²`, `m s^-2`, `m·s⁻²` → `m/s2`, `kg m^2` and
/// `kg*m2` → `kg·m2`, `in.` → `in`, `″` → `"`.
fn canonical(text: &str) -> String {
    let text = plain(text);
    let plain = text
        .replace('⁻', "-")
        .replace('²', "2")
        .replace(['⋅', '*'], "·");
    let spaced = plain.replace('^', "").replace('º', "°");
    let mut out = spaced.split_whitespace().collect::<Vec<_>>().join(" ");
    for sign in ["/", "·"] {
        out = out
            .split(sign)
            .map(str::trim)
            .collect::<Vec<_>>()
            .join(sign);
    }
    // The point of an abbreviation: "72 in.", "150 lbs."
    if out.ends_with('.')
        && out
            .trim_end_matches('.')
            .ends_with(|c: char| c.is_alphabetic())
    {
        out.pop();
    }
    out.replace(' ', "·")
        .replace("kg.m2", "kg·m2")
        .replace("·s-2", "/s2")
        .replace(".s-2", "/s2")
}

/// The unit that is written `text`, of any dimension.
pub fn lookup(text: &str) -> Option<&'static Unit> {
    let name = canonical(text);
    UNITS.iter().find(|unit| {
        unit.symbol == name
            || unit.aliases.contains(&name.as_str())
            || unit.any_case
                && (unit.symbol.eq_ignore_ascii_case(&name)
                    || unit
                        .aliases
                        .iter()
                        .any(|alias| alias.eq_ignore_ascii_case(&name)))
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
    let Some(unit) = lookup(text) else {
        return Err(unknown_unit(text, dimension));
    };
    if unit.dimension == dimension {
        Ok(unit)
    } else {
        Err(wrong_dimension(text, unit, dimension))
    }
}

/// As [`find_unit`], in a place where capitals say nothing because everything is in capitals, such
/// as the heading `HEIGHT_MM`: `MM` is a millimetre where a length is expected.
///
/// # Errors
/// As [`find_unit`].
///
/// # Example
/// ```
/// use freestand_input::quantity::{Dimension, find_unit, find_unit_any_case};
/// assert_eq!(find_unit_any_case("MM", Dimension::Length)?.symbol, "mm");
/// assert!(find_unit("MM", Dimension::Length).is_err());
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn find_unit_any_case(text: &str, dimension: Dimension) -> Result<&'static Unit, Problem> {
    let name = canonical(text);
    let exact = find_unit(text, dimension);
    let mut alike = dimension.units().filter(|unit| {
        unit.symbol.eq_ignore_ascii_case(&name)
            || unit
                .aliases
                .iter()
                .any(|alias| alias.eq_ignore_ascii_case(&name))
    });
    match (exact, alike.next(), alike.next()) {
        (Err(_), Some(only), None) => Ok(only),
        (exact, ..) => exact,
    }
}

pub(super) fn unknown_unit(text: &str, dimension: Dimension) -> Problem {
    let name = canonical(text);
    // A capital that changes the meaning is refused; the hint names the unit that was probably
    // meant.
    let near = dimension
        .units()
        .find(|unit| unit.symbol.eq_ignore_ascii_case(&name));
    let problem = value_problem(format!(
        "\"{}\" is not a unit of {}",
        shorten(text),
        dimension.with_article()
    ));
    match near {
        Some(unit) => problem.hint(format!(
            "write \"{}\": capital letters matter here",
            unit.symbol
        )),
        None if matches!(name.to_ascii_lowercase().as_str(), "ton" | "tons") => {
            problem.hint("write t (1000 kg) or short ton (2000 lb)")
        }
        None if dimension == Dimension::Ratio => {
            problem.hint("write a bare number or a percentage, such as 0.05 or 5 %")
        }
        None => problem.hint(format!("known: {}", dimension.unit_list())),
    }
}

pub(super) fn wrong_dimension(text: &str, unit: &Unit, expected: Dimension) -> Problem {
    let text = shorten(text);
    let problem = value_problem(format!(
        "\"{text}\" is {}, not {}",
        unit.dimension.with_article(),
        expected.with_article()
    ));
    match expected {
        // A user who writes "150 g" for a mass means grams.
        Dimension::Mass if unit.symbol == "g" => {
            problem.hint("g is the acceleration of gravity here; write kg or t")
        }
        Dimension::Force if unit.symbol == "lb" => problem.hint("lb is a mass here; write lbf"),
        Dimension::Ratio => {
            problem.hint("write a bare number or a percentage, such as 0.05 or 5 %")
        }
        _ => problem.hint(format!("known units: {}", expected.unit_list())),
    }
}
