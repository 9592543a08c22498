//! The half-sine whose shock response spectrum is on or above a given one.

use super::{
    HalfSine, Peak, Pulse, PulseError, PulseShape, ResponseKind, ShockResponseError, pulse_spectrum,
};

/// Frequencies of the unit spectrum per octave: a straight line between two misses a curve of unit
/// curvature by (ln 2/48)²/8 = 3e-5, which the final scaling corrects.
const PER_OCTAVE: f64 = 48.0;
/// Range of f T of the unit spectrum, which is proportional to f T to 1e-4 below this range and
/// within 1 % of its limit above it.
const UNIT_RANGE: (f64, f64) = (0.01, 50.0);
/// Durations that are tried per octave before the best one is refined.
const TRIED_PER_OCTAVE: f64 = 24.0;

/// The half-sine with the **smallest peak** whose maximax spectrum of absolute acceleration is
/// nowhere below the given one, at the same damping; of equal peaks the shortest.
///
/// For a duration T the enveloping peak is A(T) = max over f of S(f)/R(fT), with R the spectrum of
/// a half-sine of peak 1 and duration 1; A is minimised over T. The spectrum of a half-sine gives
/// that half-sine back: any other has a larger peak, because all R tend to 1 for stiff components.
/// The spectrum is enveloped at the given frequencies; it should extend well below and above its
/// peak, otherwise the pulse is shorter or longer than necessary.
///
/// Another rule, used by endaq, takes A as the peak of the spectrum without its amplification and
/// the duration from the largest pseudo-velocity: it is simpler, and gives peaks up to 1.65 times
/// as high (Q = 10).
///
/// **Units**: Hz; any unit of acceleration in, the same out; s. `None` for a spectrum of zeros.
///
/// # Accuracy
/// The result envelopes the spectrum to rounding; its peak is within 1e-3 of the smallest possible.
///
/// # Errors
/// A frequency that is not positive, damping outside 0 ≤ ζ < 1, or values too large.
///
/// # Example
/// A constant spectrum of 16 over five octaves:
/// ```
/// use freestand::shock_response::enveloping_half_sine;
/// let frequencies: Vec<f64> = (0..=60).map(|i| 100.0 * 2f64.powf(f64::from(i) / 12.0)).collect();
/// let pulse = enveloping_half_sine(&frequencies, &[16.0; 61], 0.05)?.expect("not zero");
/// assert!((10.0..=16.0).contains(&pulse.peak_acceleration));
/// # Ok::<(), freestand::shock_response::ShockResponseError>(())
/// ```
pub fn enveloping_half_sine(
    frequencies_hz: &[f64],
    spectrum: &[f64],
    damping_ratio: f64,
) -> Result<Option<HalfSine>, ShockResponseError> {
    let points: Vec<(f64, f64)> = frequencies_hz
        .iter()
        .copied()
        .zip(spectrum.iter().copied())
        .filter(|point| point.1 > 0.0)
        .collect();
    if let Some(&(frequency_hz, _)) = points.iter().find(|(f, _)| !(*f > 0.0 && f.is_finite())) {
        return Err(ShockResponseError::Frequency { frequency_hz });
    }
    if points.is_empty() {
        return Ok(None);
    }
    let unit = UnitSpectrum::new(damping_ratio)?;
    let peak = |log_t: f64| {
        points
            .iter()
            .map(|(f, value)| value / unit.at(f.ln() + log_t))
            .fold(0.0, f64::max)
    };
    let lowest = points
        .iter()
        .map(|point| point.0)
        .fold(f64::INFINITY, f64::min);
    let highest = points.iter().map(|point| point.0).fold(0.0, f64::max);
    // A pulse shorter than 0.1/f of every oscillator only needs a higher peak; one of ten periods
    // of every oscillator is only longer than necessary.
    let (from, to) = ((0.1 / highest).ln(), (10.0 / lowest).ln());
    let step = std::f64::consts::LN_2 / TRIED_PER_OCTAVE;
    let tried = (0..=((to - from) / step).ceil() as usize).map(|i| from + i as f64 * step);
    let (mut log_t, mut least) = (from, f64::INFINITY);
    for one in tried {
        let value = peak(one);
        if value < least {
            (log_t, least) = (one, value);
        }
    }
    for fine in (1..40)
        .map(|i| log_t + step * (f64::from(i) / 20.0 - 1.0))
        .collect::<Vec<_>>()
    {
        let value = peak(fine);
        if value < least {
            (log_t, least) = (fine, value);
        }
    }
    let duration_s = log_t.exp();
    enveloping(&points, least, duration_s, damping_ratio).map(Some)
}

/// Raises the peak until the actual spectrum of the pulse, not the interpolated one, is nowhere
/// below.
fn enveloping(
    points: &[(f64, f64)],
    peak_acceleration: f64,
    duration_s: f64,
    damping_ratio: f64,
) -> Result<HalfSine, ShockResponseError> {
    let frequencies: Vec<f64> = points.iter().map(|point| point.0).collect();
    let unit = unit_pulse(&frequencies, duration_s, damping_ratio)?;
    let needed = points
        .iter()
        .zip(unit)
        .map(|(point, unit)| point.1 / unit)
        .fold(0.0, f64::max);
    // Where the table is slightly low the pulse is slightly too strong; it still envelopes, so it
    // is not reduced.
    Ok(HalfSine {
        peak_acceleration: if needed > 0.0 {
            needed
        } else {
            peak_acceleration
        },
        duration_s,
    })
}

/// Maximax absolute acceleration under a half-sine of peak 1.
fn unit_pulse(
    frequencies_hz: &[f64],
    duration_s: f64,
    damping_ratio: f64,
) -> Result<Vec<f64>, ShockResponseError> {
    let highest = frequencies_hz.iter().copied().fold(0.0, f64::max);
    let refused = |_: PulseError| ShockResponseError::Frequency {
        frequency_hz: highest,
    };
    let pulse = Pulse::new(PulseShape::HalfSine, 1.0, duration_s).map_err(refused)?;
    let spectrum = pulse_spectrum(
        &pulse,
        frequencies_hz,
        ResponseKind::AbsoluteAcceleration,
        damping_ratio,
    )?;
    Ok(spectrum
        .peaks
        .iter()
        .map(|one| one.peak(Peak::Maximax))
        .collect())
}

/// R(fT) on a logarithmic grid.
struct UnitSpectrum {
    values: Vec<f64>,
}

impl UnitSpectrum {
    fn new(damping_ratio: f64) -> Result<Self, ShockResponseError> {
        let (from, to) = UNIT_RANGE;
        let count = (PER_OCTAVE * (to / from).log2()).ceil();
        let grid: Vec<f64> = (0..=count as usize)
            .map(|i| from * (i as f64 / PER_OCTAVE).exp2())
            .collect();
        Ok(Self {
            values: unit_pulse(&grid, 1.0, damping_ratio)?,
        })
    }

    fn at(&self, log_q: f64) -> f64 {
        let position = (log_q - UNIT_RANGE.0.ln()) / std::f64::consts::LN_2 * PER_OCTAVE;
        let (Some(first), Some(last)) = (self.values.first(), self.values.last()) else {
            return 1.0;
        };
        if position <= 0.0 {
            return first * log_q.exp() / UNIT_RANGE.0;
        }
        let index = position as usize;
        match (self.values.get(index), self.values.get(index + 1)) {
            (Some(low), Some(high)) => low + (position - index as f64) * (high - low),
            _ => *last,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Vec<f64> {
        (0..=159).map(|i| (f64::from(i) / 12.0).exp2()).collect()
    }

    /// Spectra of pulses and of a random shape: nowhere below, and touching.
    #[test]
    fn it_envelopes_and_touches() {
        let frequencies = grid();
        let mut spectra = Vec::new();
        for shape in PulseShape::ALL {
            let pulse = Pulse::new(shape, 300.0, 0.004).unwrap();
            let found = pulse_spectrum(
                &pulse,
                &frequencies,
                ResponseKind::AbsoluteAcceleration,
                0.05,
            )
            .unwrap();
            spectra.push(
                found
                    .peaks
                    .iter()
                    .map(|one| one.peak(Peak::Maximax))
                    .collect::<Vec<f64>>(),
            );
        }
        spectra.push(
            frequencies
                .iter()
                .map(|f| 3.0 * f / (1.0 + (f / 90.0).powi(3)))
                .collect(),
        );
        for spectrum in spectra {
            let found = enveloping_half_sine(&frequencies, &spectrum, 0.05)
                .unwrap()
                .unwrap();
            let own = unit_pulse(&frequencies, found.duration_s, 0.05).unwrap();
            let margins = || {
                own.iter()
                    .zip(&spectrum)
                    .map(|(own, value)| found.peak_acceleration * own / value)
            };
            let least = margins().fold(f64::INFINITY, f64::min);
            assert!((least - 1.0).abs() < 1e-12, "{least}");
        }
    }

    #[test]
    fn a_half_sine_gives_itself_back() {
        let frequencies = grid();
        let spectrum: Vec<f64> = unit_pulse(&frequencies, 0.011, 0.05)
            .unwrap()
            .iter()
            .map(|r| 30.0 * r)
            .collect();
        let found = enveloping_half_sine(&frequencies, &spectrum, 0.05)
            .unwrap()
            .unwrap();
        // The durations are tried in steps of 2^(1/480) = 1.4e-3; the peak then follows.
        assert!((found.duration_s / 0.011 - 1.0).abs() < 3e-3, "{found:?}");
        assert!(
            (found.peak_acceleration / 30.0 - 1.0).abs() < 3e-3,
            "{found:?}"
        );
    }

    #[test]
    fn nothing_to_envelope_is_none() {
        assert_eq!(enveloping_half_sine(&[10.0], &[0.0], 0.05).unwrap(), None);
        assert!(enveloping_half_sine(&[-1.0], &[1.0], 0.05).is_err());
    }
}
