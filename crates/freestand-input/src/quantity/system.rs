//! The system of units in which a person reads a result.

use serde::Deserialize;

use super::{Dimension, lookup};
use crate::words::number;

/// A system of units.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UnitSystem {
    /// Millimetres, metres, kilograms, newtons.
    #[default]
    Si,
    /// Inches, feet, pounds, pounds-force.
    Us,
}

/// Symbols and words of the units that only the US customary system has, as people type them.
const US_UNITS: [&str; 17] = [
    "in", "inch", "inches", "ft", "foot", "feet", "yd", "lb", "lbs", "lbm", "lbf", "pound",
    "pounds", "oz", "slug", "kip", "psi",
];

impl UnitSystem {
    /// Every value with its name and its meaning.
    pub const ALL: [(Self, &'static str, &'static str); 2] = [
        (Self::Si, "si", "mm, m, kg, N, kN"),
        (Self::Us, "us", "in, lb, lbf, lbf·ft"),
    ];

    /// The system of a quantity as it was typed; `None` for a bare number.
    ///
    /// # Example
    /// ```
    /// use freestand_input::quantity::UnitSystem;
    /// assert_eq!(UnitSystem::of("6'2\""), Some(UnitSystem::Us));
    /// assert_eq!(UnitSystem::of("800lb"), Some(UnitSystem::Us));
    /// assert_eq!(UnitSystem::of("1.8 m"), Some(UnitSystem::Si));
    /// assert_eq!(UnitSystem::of("1.8"), None);
    /// ```
    pub fn of(text: &str) -> Option<Self> {
        if text.contains(['"', '\'', '″', '′']) {
            return Some(Self::Us);
        }
        let mut words = text
            .split(|letter: char| !letter.is_alphabetic())
            .filter(|word| !word.is_empty());
        let first = words.next()?.to_lowercase();
        Some(if US_UNITS.contains(&first.as_str()) {
            Self::Us
        } else {
            Self::Si
        })
    }

    /// The system of most of these quantities; SI where there are as many of both.
    pub fn of_most_systems(systems: impl IntoIterator<Item = Option<Self>>) -> Self {
        let found = systems.into_iter().flatten();
        let balance: i32 = found
            .map(|system| if system == Self::Us { 1 } else { -1 })
            .sum();
        if balance > 0 { Self::Us } else { Self::Si }
    }

    /// A length as engineers read it: `914.4 mm`, `1.646 m`; `36 in`
    pub fn length(self, length_m: f64) -> String {
        match self {
            Self::Si if length_m.abs() < 1.0 => format!("{} mm", number(1e3 * length_m, 4)),
            Self::Si => format!("{} m", number(length_m, 4)),
            Self::Us => format!("{} in", number(from_si("in", length_m), 4)),
        }
    }

    /// The height of a storey: `3.2 m`; `13 ft`.
    pub fn storey(self, height_m: f64) -> String {
        match self {
            Self::Si => super::format_si(height_m, Dimension::Length),
            Self::Us => format!("{} ft", number(from_si("ft", height_m), 4)),
        }
    }

    /// A short distance with so many digits: `310 mm`; `12.2 in`.
    pub fn distance(self, length_m: f64, digits: usize) -> String {
        match self {
            Self::Si => format!("{} mm", number(1e3 * length_m, digits)),
            Self::Us => format!("{} in", number(from_si("in", length_m), digits)),
        }
    }

    /// How far something goes, rounded up: whole millimetres; tenths of an inch.
    pub fn reach(self, length_m: f64) -> String {
        match self {
            Self::Si => format!("{} mm", number((1e3 * length_m).ceil(), 6)),
            Self::Us => format!(
                "{} in",
                number((10.0 * from_si("in", length_m)).ceil() / 10.0, 6)
            ),
        }
    }

    /// A speed with so many digits: `1.1 m/s`; `3.61 ft/s`.
    pub fn speed(self, speed_m_s: f64, digits: usize) -> String {
        match self {
            Self::Si => format!("{} m/s", number(speed_m_s, digits)),
            Self::Us => format!("{} ft/s", number(from_si("ft", speed_m_s), digits)),
        }
    }

    /// A mass: `363 kg`; `800 lb`.
    pub fn mass(self, mass_kg: f64) -> String {
        match self {
            Self::Si => super::format_si(mass_kg, Dimension::Mass),
            Self::Us => format!("{} lb", number(from_si("lb", mass_kg), 4)),
        }
    }

    /// A force: `659 N`, `1.29 kN`; `148 lbf`.
    pub fn force(self, force_n: f64) -> String {
        match self {
            Self::Si if force_n.abs() < 1000.0 => format!("{} N", number(force_n, 3)),
            Self::Si => format!("{} kN", number(1e-3 * force_n, 3)),
            // Up to 9999 lbf without an exponent, and beyond it with the digits that are known.
            Self::Us => format!("{} lbf", number(from_si("lbf", force_n), 3)),
        }
    }

    /// A force with the other system in brackets: `659 N (148 lbf)`, `148 lbf (659 N)`.
    pub fn force_in_both(self, force_n: f64) -> String {
        if force_n == 0.0 {
            return self.force(force_n);
        }
        format!("{} ({})", self.force(force_n), self.other().force(force_n))
    }

    /// A force as a number, and its unit: N; lbf.
    pub fn force_number(self, force_n: f64) -> (f64, &'static str) {
        match self {
            Self::Si => (force_n, "N"),
            Self::Us => (from_si("lbf", force_n), "lbf"),
        }
    }

    /// A length as a number, and its unit: mm; in.
    pub fn length_number(self, length_m: f64) -> (f64, &'static str) {
        match self {
            Self::Si => (1e3 * length_m, "mm"),
            Self::Us => (from_si("in", length_m), "in"),
        }
    }

    /// A moment: `1110 N·m`; `819 lbf·ft`.
    pub fn moment(self, moment_n_m: f64) -> String {
        match self {
            Self::Si => format!("{} N·m", number(moment_n_m, 4)),
            Self::Us => format!(
                "{} lbf·ft",
                number(from_si("lbf", from_si("ft", moment_n_m)), 4)
            ),
        }
    }

    fn other(self) -> Self {
        match self {
            Self::Si => Self::Us,
            Self::Us => Self::Si,
        }
    }
}

/// A value in a unit of the table; unchanged where the table has no such unit.
fn from_si(unit: &str, value_si: f64) -> f64 {
    lookup(unit).map_or(value_si, |unit| unit.from_si(value_si))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_systems() {
        // 24 in = 0.6096 m; 800 lb = 362.87 kg; 148 lbf = 658.3 N; 819 lbf ft = 1110.4 N m.
        assert_eq!(
            (UnitSystem::Us.length(0.6096), UnitSystem::Si.length(0.6096)),
            ("24 in".into(), "609.6 mm".into())
        );
        // 310 mm = 12.205 in, rounded up 12.3 in; 1.1 m/s = 3.609 ft/s.
        assert_eq!(
            (
                UnitSystem::Si.distance(0.31, 3),
                UnitSystem::Us.distance(0.31, 3)
            ),
            ("310 mm".into(), "12.2 in".into())
        );
        assert_eq!(
            (UnitSystem::Si.reach(0.3092), UnitSystem::Us.reach(0.31)),
            ("310 mm".into(), "12.3 in".into())
        );
        assert_eq!(
            (UnitSystem::Si.speed(1.1, 2), UnitSystem::Us.speed(1.1, 2)),
            ("1.1 m/s".into(), "3.6 ft/s".into())
        );
        assert_eq!(UnitSystem::Us.mass(362.873_896), "800 lb");
        assert_eq!(UnitSystem::Us.force_in_both(658.3), "148 lbf (658 N)");
        assert_eq!(UnitSystem::Si.force_in_both(658.3), "658 N (148 lbf)");
        assert_eq!(UnitSystem::Us.moment(1110.4), "819 lbf·ft");
        assert_eq!(UnitSystem::Us.force(0.0), "0 lbf");
        assert_eq!(UnitSystem::Si.length_number(0.6), (600.0, "mm"));
        let (lbf, unit) = UnitSystem::Us.force_number(4_448.221_615_260_5);
        assert!((lbf - 1000.0).abs() < 1e-9 && unit == "lbf", "{lbf}");
        assert_eq!(UnitSystem::Us.force(44_482.216), "10000 lbf");
    }

    #[test]
    fn the_system_of_most_quantities() {
        let most = |texts: &[&str]| {
            UnitSystem::of_most_systems(texts.iter().map(|text| UnitSystem::of(text)))
        };
        assert_eq!(most(&["800lb", "6 ft 2 in", "600 mm"]), UnitSystem::Us);
        assert_eq!(most(&["360kg", "24in"]), UnitSystem::Si);
        assert_eq!(most(&["5 1/2 in"]), UnitSystem::Us);
        assert_eq!(most(&["1.8", "0.6"]), UnitSystem::Si);
    }
}
