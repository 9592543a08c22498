//! A motion in the plane of a floor.

use std::borrow::Cow;

use freestand::measures::{cumulative_trapezoid, longest, longest_integral};
use freestand::motion::{Motion, MotionError};

use crate::write::{write_csv, write_pair_csv};

/// A motion in the plane of the floor: one component, or two at right angles.
#[derive(Debug, Clone, PartialEq)]
pub struct HorizontalMotion {
    /// The first component, or the only one.
    pub along: Motion,
    /// The second, of the same length and time step.
    pub across: Option<Motion>,
}

impl HorizontalMotion {
    /// The component in a direction counted from the first one towards the second \[degrees\]:
    /// `a₁ cos θ + a₂ sin θ`. Without a second component, the first one in every direction.
    ///
    /// # Errors
    /// Samples that overflow.
    pub fn in_direction(&self, direction_deg: f64) -> Result<Cow<'_, Motion>, MotionError> {
        let Some(across) = &self.across else {
            return Ok(Cow::Borrowed(&self.along));
        };
        if direction_deg == 0.0 {
            return Ok(Cow::Borrowed(&self.along));
        }
        if direction_deg == 90.0 {
            return Ok(Cow::Borrowed(across));
        }
        let (sin, cos) = direction_deg.to_radians().sin_cos();
        let samples = self
            .along
            .accel_m_s2()
            .iter()
            .zip(across.accel_m_s2())
            .map(|(a, b)| a * cos + b * sin);
        Motion::new(self.along.dt_s(), samples.collect()).map(Cow::Owned)
    }

    /// Largest velocity, from rest by the trapezoid rule; of two components, the largest in any
    /// direction \[m/s\].
    pub fn peak_velocity_m_s(&self) -> f64 {
        let (dt_s, along) = (self.along.dt_s(), self.along.accel_m_s2());
        match &self.across {
            None => {
                let velocity = cumulative_trapezoid(dt_s, along);
                velocity.iter().fold(0.0, |peak, v| peak.max(v.abs()))
            }
            Some(across) => longest_integral(dt_s, along, across.accel_m_s2()),
        }
    }

    /// As a file: `time_s,accel_m_s2`, or `time_s,along_m_s2,across_m_s2`.
    pub fn csv(&self) -> String {
        match &self.across {
            None => write_csv(&self.along),
            Some(across) => write_pair_csv(&self.along, across),
        }
    }

    /// Largest acceleration at the samples; of two components, the largest in any direction
    /// \[m/s²\].
    pub fn peak_m_s2(&self) -> f64 {
        match &self.across {
            None => self.along.peak_m_s2(),
            Some(across) => longest(self.along.accel_m_s2(), across.accel_m_s2()),
        }
    }
}
