//! A spectrum from a user's table.

use super::CodeSpectrumError;

/// How values between two periods of a table are calculated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Linear in ln Sa over ln T, which reproduces every power of the period. From a period of 0,
    /// which has no logarithm, linear in Sa over T.
    #[default]
    LogLog,
    /// Linear in Sa over T.
    Linear,
}

/// How values outside a table are calculated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OutOfRange {
    /// There is no value.
    #[default]
    Refuse,
    /// Constant Sa below the first period, constant Sa·T² (displacement) above the last.
    Hold,
}

/// A spectrum of periods and accelerations, 5 % damping.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumTable {
    periods_s: Vec<f64>,
    sa_g: Vec<f64>,
    interpolation: Interpolation,
    out_of_range: OutOfRange,
}

impl SpectrumTable {
    /// A table with ascending periods; a period of 0 gives the value at T = 0.
    ///
    /// # Errors
    /// Fewer than two rows; a period that is negative, not finite or not above the previous one; an
    /// acceleration that is not positive and finite.
    ///
    /// # Example
    /// Between 0.5 s and 2 s the acceleration falls as 1/T:
    /// ```
    /// use freestand::code_spectrum::{Interpolation, OutOfRange, SpectrumTable};
    /// let (between, outside) = (Interpolation::LogLog, OutOfRange::Hold);
    /// let table = SpectrumTable::new(vec![0.5, 2.0], vec![0.8, 0.2], between, outside)?;
    /// assert!((table.sa_g(1.0).unwrap() - 0.4).abs() < 1e-15);
    /// assert!((table.sa_g(4.0).unwrap() - 0.05).abs() < 1e-15); // 1/T² above
    /// # Ok::<(), freestand::code_spectrum::CodeSpectrumError>(())
    /// ```
    pub fn new(
        periods_s: Vec<f64>,
        sa_g: Vec<f64>,
        interpolation: Interpolation,
        out_of_range: OutOfRange,
    ) -> Result<Self, CodeSpectrumError> {
        let (periods, accelerations) = (periods_s.len(), sa_g.len());
        if periods < 2 || periods != accelerations {
            return Err(CodeSpectrumError::TableLength {
                periods,
                accelerations,
            });
        }
        let mut before = None;
        for (row, (&period_s, &sa_g)) in periods_s.iter().zip(&sa_g).enumerate() {
            let requirement = if !(period_s >= 0.0 && period_s.is_finite()) {
                "a period must be at least 0 and finite"
            } else if before.is_some_and(|before| period_s <= before) {
                "the periods must rise from row to row"
            } else if !(sa_g > 0.0 && sa_g.is_finite()) {
                "an acceleration must be positive and finite"
            } else {
                before = Some(period_s);
                continue;
            };
            return Err(CodeSpectrumError::TableRow {
                row: row + 1,
                period_s,
                sa_g,
                requirement,
            });
        }
        Ok(Self {
            periods_s,
            sa_g,
            interpolation,
            out_of_range,
        })
    }

    /// Periods, ascending \[s\].
    pub fn periods_s(&self) -> &[f64] {
        &self.periods_s
    }

    /// Spectral accelerations at the periods \[g\].
    pub fn sa_values_g(&self) -> &[f64] {
        &self.sa_g
    }

    /// The interpolation between the periods.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The rule outside the periods.
    pub fn out_of_range(&self) -> OutOfRange {
        self.out_of_range
    }

    /// The first period of the table itself \[s\].
    pub fn first_period_s(&self) -> f64 {
        self.periods_s.first().copied().unwrap_or(0.0)
    }

    /// The last period of the table itself \[s\].
    pub fn last_period_s(&self) -> f64 {
        self.periods_s.last().copied().unwrap_or(0.0)
    }

    /// The shortest period with a value \[s\].
    pub fn shortest_period_s(&self) -> f64 {
        match self.out_of_range {
            OutOfRange::Refuse => self.first_period_s(),
            OutOfRange::Hold => 0.0,
        }
    }

    /// The longest period with a value; `None` where the table is extended past its last
    /// period \[s\].
    pub fn longest_period_s(&self) -> Option<f64> {
        (self.out_of_range == OutOfRange::Refuse).then(|| self.last_period_s())
    }

    /// Spectral acceleration \[g\]; `None` for a negative period, and outside a table that is not
    /// extended.
    pub fn sa_g(&self, period_s: f64) -> Option<f64> {
        if period_s.is_nan() || period_s < 0.0 {
            return None;
        }
        let after = self.periods_s.partition_point(|&period| period < period_s);
        let row = |i: usize| Some((*self.periods_s.get(i)?, *self.sa_g.get(i)?));
        match (after.checked_sub(1).and_then(row), row(after)) {
            // A period of the table gives its own value, to the bit.
            (_, Some((period, sa_g))) if period == period_s => Some(sa_g),
            (Some(low), Some(high)) => Some(self.between(low, high, period_s)),
            _ if self.out_of_range == OutOfRange::Refuse => None,
            (None, Some((_, sa_g))) => Some(sa_g),
            (Some((period, sa_g)), None) => Some(sa_g * (period / period_s).powi(2)),
            (None, None) => None,
        }
    }

    fn between(&self, (t0_s, a0_g): (f64, f64), (t1_s, a1_g): (f64, f64), period_s: f64) -> f64 {
        if self.interpolation == Interpolation::Linear || t0_s == 0.0 {
            return a0_g + (a1_g - a0_g) * (period_s - t0_s) / (t1_s - t0_s);
        }
        a0_g * ((a1_g / a0_g).ln() * (period_s / t0_s).ln() / (t1_s / t0_s).ln()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(interpolation: Interpolation, out_of_range: OutOfRange) -> SpectrumTable {
        let (periods_s, sa_g) = (
            vec![0.0, 0.1, 0.4, 1.6, 3.2],
            vec![0.2, 0.5, 0.5, 0.125, 0.03125],
        );
        SpectrumTable::new(periods_s, sa_g, interpolation, out_of_range).unwrap()
    }

    /// By hand: linear halfway to 0.1 s, 0.35; the plateau; 1/T up to 1.6 s, 0.25 at 0.8 s and
    /// linear 0.375 at 1 s; 1/T² up to 3.2 s.
    #[test]
    fn between_its_periods() {
        let (log, linear) = (
            table(Interpolation::LogLog, OutOfRange::Refuse),
            table(Interpolation::Linear, OutOfRange::Refuse),
        );
        let cases = [
            (0.0, 0.2, 0.2),
            (0.05, 0.35, 0.35),
            (0.2, 0.5, 0.5),
            (0.4, 0.5, 0.5),
            (0.8, 0.25, 0.375),
            (1.6, 0.125, 0.125),
            (2.4, 0.125 / 2.25, 0.078_125),
            (3.2, 0.03125, 0.03125),
        ];
        for (period_s, of_log, of_linear) in cases {
            // Logarithms and an exponential: a few units in the last place.
            assert!(
                (log.sa_g(period_s).unwrap() - of_log).abs() < 1e-15,
                "{period_s}"
            );
            assert!(
                (linear.sa_g(period_s).unwrap() - of_linear).abs() < 1e-15,
                "{period_s}"
            );
        }
    }

    #[test]
    fn outside_is_refused_or_held() {
        let refused = table(Interpolation::LogLog, OutOfRange::Refuse);
        assert_eq!(
            (
                refused.sa_g(3.3),
                refused.sa_g(-0.1),
                refused.sa_g(f64::NAN)
            ),
            (None, None, None)
        );
        assert_eq!(
            (refused.shortest_period_s(), refused.longest_period_s()),
            (0.0, Some(3.2))
        );
        let held = table(Interpolation::LogLog, OutOfRange::Hold);
        // Twice the last period: a quarter.
        assert_eq!(
            (held.sa_g(6.4), held.longest_period_s()),
            (Some(0.0078125), None)
        );
        let late = SpectrumTable::new(
            vec![0.2, 1.0],
            vec![0.4, 0.1],
            Interpolation::LogLog,
            OutOfRange::Hold,
        )
        .unwrap();
        assert_eq!(
            (late.sa_g(0.0), late.sa_g(0.19), late.shortest_period_s()),
            (Some(0.4), Some(0.4), 0.0)
        );
        let late = SpectrumTable {
            out_of_range: OutOfRange::Refuse,
            ..late
        };
        assert_eq!((late.sa_g(0.19), late.shortest_period_s()), (None, 0.2));
    }

    #[test]
    fn what_is_no_spectrum_is_refused_with_its_row() {
        let made = |periods_s: &[f64], sa_g: &[f64]| {
            SpectrumTable::new(
                periods_s.to_vec(),
                sa_g.to_vec(),
                Interpolation::Linear,
                OutOfRange::Refuse,
            )
            .unwrap_err()
        };
        for (periods_s, sa_g) in [(&[1.0][..], &[1.0][..]), (&[1.0, 2.0], &[1.0]), (&[], &[])] {
            assert!(matches!(
                made(periods_s, sa_g),
                CodeSpectrumError::TableLength { .. }
            ));
        }
        for (periods_s, sa_g, at) in [
            ([0.1, 0.1, 0.2], [1.0, 1.0, 1.0], 2),
            ([0.1, 0.3, 0.2], [1.0, 1.0, 1.0], 3),
            ([-0.1, 0.3, 0.4], [1.0, 1.0, 1.0], 1),
            ([0.1, 0.3, f64::INFINITY], [1.0, 1.0, 1.0], 3),
            ([0.1, 0.3, 0.4], [1.0, 0.0, 1.0], 2),
            ([0.1, 0.3, 0.4], [1.0, 1.0, f64::NAN], 3),
        ] {
            assert!(
                matches!(made(&periods_s, &sa_g), CodeSpectrumError::TableRow { row, .. } if row == at),
                "{periods_s:?}"
            );
        }
    }
}
