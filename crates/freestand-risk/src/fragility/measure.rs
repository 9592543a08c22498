//! Intensity measures.

use freestand::G0_M_S2;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, lookup, parse_grid, parse_in_unit, parse_positive};
use freestand_input::words::shortest;

/// Where a measure is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumString, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum At {
    /// Of the ground motion.
    Ground,
    /// Of the floor motion.
    Floor,
}

impl At {
    /// The name in inputs and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// How strong a motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// Peak ground acceleration \[g\].
    Pga,
    /// Peak ground velocity \[m/s\].
    Pgv,
    /// Peak floor acceleration \[g\].
    Pfa,
    /// Peak floor velocity \[m/s\].
    Pfv,
    /// Spectral acceleration, 5 % damping \[g\].
    Sa {
        /// Its period \[s\].
        period_s: f64,
    },
    /// Geometric mean of ten spectral accelerations \[g\].
    SaAverage {
        /// The shortest period \[s\].
        from_s: f64,
        /// The longest period \[s\].
        to_s: f64,
    },
    /// p·PFV/(g tan α).
    VelocityRatio,
    /// PFA/(g tan α).
    AccelerationRatio,
}

/// What is expected of a measure, for hints.
pub(crate) const MEASURES: &str = "pga [g], pgv [m/s], pfa [g], pfv [m/s], sa(0.5) [g], sa_avg(0.2:2) [g], velocity_ratio, acceleration_ratio";

impl Measure {
    /// The measure with a name, `pfv` or `sa(0.5)`.
    pub fn parse(text: &str) -> Option<Self> {
        let period = |text: &str| {
            text.trim()
                .parse::<f64>()
                .ok()
                .filter(|period| *period > 0.0 && period.is_finite())
        };
        let text = text.trim().to_lowercase();
        match text.as_str() {
            "pga" => Some(Self::Pga),
            "pgv" => Some(Self::Pgv),
            "pfa" => Some(Self::Pfa),
            "pfv" => Some(Self::Pfv),
            "velocity_ratio" => Some(Self::VelocityRatio),
            "acceleration_ratio" => Some(Self::AccelerationRatio),
            text => {
                let (name, inside) = text.strip_suffix(')')?.split_once('(')?;
                match name {
                    "sa" => Some(Self::Sa {
                        period_s: period(inside)?,
                    }),
                    "sa_avg" => {
                        let (from, to) = inside.split_once(':')?;
                        let (from_s, to_s) = (period(from)?, period(to)?);
                        (from_s < to_s).then_some(Self::SaAverage { from_s, to_s })
                    }
                    _ => None,
                }
            }
        }
    }

    /// The name in inputs and outputs.
    pub fn name(self) -> String {
        match self {
            Self::Pga => "pga".to_owned(),
            Self::Pgv => "pgv".to_owned(),
            Self::Pfa => "pfa".to_owned(),
            Self::Pfv => "pfv".to_owned(),
            Self::Sa { period_s } => format!("sa({})", shortest(period_s)),
            Self::SaAverage { from_s, to_s } => {
                format!("sa_avg({}:{})", shortest(from_s), shortest(to_s))
            }
            Self::VelocityRatio => "velocity_ratio".to_owned(),
            Self::AccelerationRatio => "acceleration_ratio".to_owned(),
        }
    }

    /// Its unit in outputs: `g`, `m/s` or `1`.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Pga | Self::Pfa | Self::Sa { .. } | Self::SaAverage { .. } => "g",
            Self::Pgv | Self::Pfv => "m/s",
            Self::VelocityRatio | Self::AccelerationRatio => "1",
        }
    }

    /// A value with its unit, or with the name of the measure if it has no unit: `0.2 m/s`,
    /// `velocity_ratio 0.5`.
    pub fn value_words(self, value: f64) -> String {
        match self.unit() {
            "1" => format!("{} {}", self.name(), shortest(value)),
            unit => format!("{} {unit}", shortest(value)),
        }
    }

    /// Its name with the unit, as on an axis.
    pub fn with_unit(self) -> String {
        match self.unit() {
            "1" => self.name(),
            unit => format!("{} ({unit})", self.name()),
        }
    }

    fn dimension(self) -> Dimension {
        match self.unit() {
            "g" => Dimension::Acceleration,
            "m/s" => Dimension::Velocity,
            _ => Dimension::Ratio,
        }
    }

    /// Where it is taken; `None` where it may be either.
    pub fn place(self) -> Option<At> {
        match self {
            Self::Pga | Self::Pgv => Some(At::Ground),
            Self::Pfa | Self::Pfv | Self::VelocityRatio | Self::AccelerationRatio => {
                Some(At::Floor)
            }
            Self::Sa { .. } | Self::SaAverage { .. } => None,
        }
    }

    /// Where it is taken, given what the user says; the ground where it may be either.
    ///
    /// # Errors
    /// A place that contradicts the measure.
    pub(crate) fn at(self, given: Option<At>) -> Result<At, Problem> {
        match (self.place(), given) {
            (Some(place), Some(given)) if place != given => {
                let message = format!(
                    "{} is a measure of the {}, not of the {}",
                    self.name(),
                    place.name(),
                    given.name()
                );
                Err(Problem::value(
                    message,
                    format!("leave out `at`, or write `at = \"{}\"`", place.name()),
                )
                .of(&["at"]))
            }
            (place, given) => Ok(place.or(given).unwrap_or(At::Ground)),
        }
    }

    /// An intensity with its unit, in the unit of outputs.
    ///
    /// # Errors
    /// No number above 0, or a unit of something else.
    pub(crate) fn quantity(self, text: &str) -> Result<f64, Problem> {
        let value = parse_positive(text, self.dimension(), "the intensity")?;
        Ok(if self.dimension() == Dimension::Acceleration {
            value / G0_M_S2
        } else {
            value
        })
    }

    /// Intensities as a grid or a list with units, in the unit of outputs.
    ///
    /// # Errors
    /// A grid that cannot be read, or a unit of something else.
    pub(crate) fn quantities(self, text: &str) -> Result<Vec<f64>, Problem> {
        let to_output = if self.dimension() == Dimension::Acceleration {
            1.0 / G0_M_S2
        } else {
            1.0
        };
        Ok(parse_grid(text, self.dimension())?
            .into_iter()
            .map(|value| value * to_output)
            .collect())
    }

    /// The factor from a unit to that of outputs.
    ///
    /// # Errors
    /// A unit of something else, or none where there must be one.
    pub(crate) fn factor_from(self, unit: Option<&str>) -> Result<f64, Problem> {
        let dimension = self.dimension();
        let wrong = |message: String| Problem::value(message, format!("write one of {MEASURES}"));
        match (unit, dimension) {
            (None | Some("1" | "-"), Dimension::Ratio) => Ok(1.0),
            (None, _) => Err(wrong(format!("{} has no unit", self.name()))),
            (Some(symbol), _) if symbol == self.unit() => Ok(1.0),
            (Some(symbol), _) => {
                let unit = lookup(symbol).filter(|unit| unit.dimension == dimension);
                let unit = unit
                    .ok_or_else(|| wrong(format!("{} cannot be in \"{symbol}\"", self.name())))?;
                let in_si = parse_in_unit("1", unit)?;
                Ok(if dimension == Dimension::Acceleration {
                    in_si / G0_M_S2
                } else {
                    in_si
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in [
            "pga",
            "pgv",
            "pfa",
            "pfv",
            "sa(0.5)",
            "sa_avg(0.2:2)",
            "velocity_ratio",
            "acceleration_ratio",
        ] {
            assert_eq!(Measure::parse(name).unwrap().name(), name);
        }
        for bad in ["pgd", "sa", "sa()", "sa(-1)", "sa_avg(2:1)", "sa(0.5", ""] {
            assert_eq!(Measure::parse(bad), None, "{bad}");
        }
    }

    #[test]
    fn units_become_those_of_outputs() {
        let factor = |measure: Measure, unit| measure.factor_from(unit);
        assert_eq!(factor(Measure::Pgv, Some("cm/s")), Ok(0.01));
        assert_eq!(factor(Measure::Pga, Some("g")), Ok(1.0));
        assert!((factor(Measure::Pga, Some("m/s2")).unwrap() - 1.0 / G0_M_S2).abs() < 1e-16);
        assert_eq!(factor(Measure::VelocityRatio, None), Ok(1.0));
        assert!(factor(Measure::Pfv, None).is_err() && factor(Measure::Pfv, Some("g")).is_err());
        assert!(Measure::Pfv.at(Some(At::Ground)).is_err());
        assert_eq!(
            Measure::Sa { period_s: 1.0 }.at(Some(At::Floor)),
            Ok(At::Floor)
        );
    }
}
