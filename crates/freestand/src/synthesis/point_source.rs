//! The stochastic point source: Fourier amplitudes of an earthquake with a given magnitude and
//! distance.
//!
//! `A(f) = C M₀ (2πf)² S(f) G(R) e^(−πfR/(Q(f)β)) Amp(f) P(f)`, the Fourier amplitude of the ground
//! acceleration \[m/s\], with the source spectrum S, the spreading G, the path attenuation Q, the
//! amplification of the crust Amp and the attenuation near the surface P.

use super::site_amplification::ShearWaveProfile;
use super::{Parameter, SynthesisError, Window};
use std::f64::consts::{PI, TAU};

/// Mean radiation pattern of shear waves, R_θφ.
const RADIATION_RATIO: f64 = 0.55;
/// Amplification by the free surface, which doubles waves, F.
const FREE_SURFACE_RATIO: f64 = 2.0;
/// Reference distance of the spreading, R₀ \[m\].
const REFERENCE_DISTANCE_M: f64 = 1000.0;
/// Coefficient of Brune's corner frequency in SI units (4.906e6 in km/s, bar and dyn·cm).
const CORNER_COEFFICIENT: f64 = 0.4906;
/// More than any κ0 that was measured, on soft sites about 0.1 s: a larger one is a wrong unit \[s\].
const LARGEST_KAPPA_S: f64 = 0.5;

/// The shape of the source spectrum S(f).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SourceSpectrum {
    /// 1/(1 + (f/f₀)²) (Brune 1970).
    SingleCorner,
    /// (1−ε)/(1 + (f/f_a)²) + ε/(1 + (f/f_b)²), log f_a = 2.41 − 0.533M, log ε = 2.52 − 0.637M
    /// (Atkinson and Boore 1995), with f_b such that high frequencies are those of the single
    /// corner (Boore, Di Alessandro and Abrahamson 2014).
    TwoCorner,
}

/// A range of distances, in which amplitudes are proportional to R^(−exponent).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpreadingPiece {
    /// Distance at which the range begins \[m\]; the first begins at 1 km.
    pub from_distance_m: f64,
    /// The exponent: 1 for body waves, 0.5 for surface waves; negative where amplitudes rise.
    pub exponent_ratio: f64,
}

/// Attenuation along the path, Q(f).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quality {
    /// Q₀ f^n, f in Hz.
    Power {
        /// Q at 1 Hz.
        at_1_hz_ratio: f64,
        /// The power n.
        exponent_ratio: f64,
    },
    /// log₁₀ Q = c₀ + c₁ x + c₂ x² + c₃ x³ with x = log₁₀ f; constant beyond the frequencies of the
    /// fit.
    LogCubic {
        /// Coefficients c₀ to c₃.
        coefficients_ratio: [f64; 4],
        /// Lowest frequency of the fit \[Hz\].
        lowest_hz: f64,
        /// Highest frequency of the fit \[Hz\].
        highest_hz: f64,
    },
}

/// Attenuation near the surface, P(f).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HighCut {
    /// e^(−πκ₀f).
    Kappa {
        /// Attenuation parameter κ₀ \[s\].
        kappa_s: f64,
    },
    /// (1 + (f/f_max)⁸)^(−½).
    MaximumFrequency {
        /// Cut-off frequency f_max \[Hz\].
        frequency_hz: f64,
    },
}

/// The duration that the path adds to that of the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathDuration {
    /// 0.05 s per km.
    Boore,
    /// 0.16 R up to 70 km, 11.2 − 0.03 (R − 70) up to 130 km, 9.4 + 0.04 (R − 130) above, in s and
    /// km (Atkinson and Boore 1995).
    AtkinsonBoore,
}

/// An earthquake at a distance, with the crust in between.
///
/// # Reference
/// Boore (2003), "Simulation of ground motion using the stochastic method", Pure and Applied
/// Geophysics 160; Lam, Wilson and Hutchinson (2000).
#[derive(Debug, Clone, PartialEq)]
pub struct PointSource {
    /// Moment magnitude M.
    pub magnitude: f64,
    /// Distance R from the source to the site \[m\]; at least 1 km.
    pub distance_m: f64,
    /// Stress drop Δσ \[Pa\]; 1 bar is 10⁵ Pa.
    pub stress_drop_pa: f64,
    /// Density at the source ρ \[kg/m³\].
    pub density_kg_m3: f64,
    /// Shear-wave velocity at the source β \[m/s\].
    pub shear_velocity_m_s: f64,
    /// Shape of the source spectrum.
    pub spectrum: SourceSpectrum,
    /// Geometric spreading, by range of distance.
    pub spreading: Vec<SpreadingPiece>,
    /// Attenuation along the path.
    pub quality: Quality,
    /// Attenuation near the surface.
    pub high_cut: HighCut,
    /// Shear-wave velocities above the source; `None`: no amplification.
    pub profile: Option<ShearWaveProfile>,
    /// Duration added by the path.
    pub path_duration: PathDuration,
    /// How the strength of shaking rises and falls.
    pub window: Window,
}

/// Magnitudes for which the model of [`Preset::SouthEastAustralia`] was made.
pub const SOUTH_EAST_AUSTRALIA_MAGNITUDES: std::ops::RangeInclusive<f64> = 4.0..=7.5;
/// The largest distance for which it was made \[m\].
pub const SOUTH_EAST_AUSTRALIA_FARTHEST_M: f64 = 400e3;

/// Sets of parameters that were published together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// Victoria, on the rock of Melbourne: 200 bar, one corner, Q = 100 f^0.85 (Wilkie and Gibson),
    /// trilinear spreading of Atkinson and Boore (1995), κ₀ = 0.025 s, the Melbourne profile.
    Victoria,
    /// Eastern North America, the defaults of GMSS 1.0 for regions within plates: 200 bar, two
    /// corners, Q = 680 f^0.36, trilinear spreading, f_max = 50 Hz, hard rock. f_max is quoted from
    /// memory of Atkinson and Boore (1995). The path adds 0.05 s/km to the duration, instead
    /// of following their law, and the source adds 1/f₀ of the single corner.
    IntraplateHardRock,
    /// South-eastern Australia: 23 MPa (depth below 10 km: 50 MPa), spreading and Q of Allen et al.
    /// (2007), κ₀ = 0.006 s, the Melbourne profile. κ₀ is quoted from memory of Allen (2012);
    /// neither publication gives the profile. Made for [`SOUTH_EAST_AUSTRALIA_MAGNITUDES`] and
    /// distances below [`SOUTH_EAST_AUSTRALIA_FARTHEST_M`]; Q was fitted from 0.78 to 19.9 Hz.
    SouthEastAustralia,
}

impl Preset {
    /// All presets.
    pub const ALL: [Self; 3] = [
        Self::Victoria,
        Self::IntraplateHardRock,
        Self::SouthEastAustralia,
    ];

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Victoria => "victoria",
            Self::IntraplateHardRock => "intraplate",
            Self::SouthEastAustralia => "se-australia",
        }
    }

    /// The source with these parameters, a magnitude and a distance.
    pub fn source(self, magnitude: f64, distance_m: f64) -> PointSource {
        let piece = |from_distance_m, exponent_ratio| SpreadingPiece {
            from_distance_m,
            exponent_ratio,
        };
        let trilinear = vec![piece(1e3, 1.0), piece(70e3, 0.0), piece(130e3, 0.5)];
        let victoria = PointSource {
            magnitude,
            distance_m,
            stress_drop_pa: 200e5,
            density_kg_m3: 2800.0,
            shear_velocity_m_s: 3500.0,
            spectrum: SourceSpectrum::SingleCorner,
            spreading: trilinear,
            quality: Quality::Power {
                at_1_hz_ratio: 100.0,
                exponent_ratio: 0.85,
            },
            high_cut: HighCut::Kappa { kappa_s: 0.025 },
            profile: Some(ShearWaveProfile::melbourne()),
            path_duration: PathDuration::Boore,
            window: Window::Lam,
        };
        match self {
            Self::Victoria => victoria,
            Self::IntraplateHardRock => PointSource {
                spectrum: SourceSpectrum::TwoCorner,
                quality: Quality::Power {
                    at_1_hz_ratio: 680.0,
                    exponent_ratio: 0.36,
                },
                high_cut: HighCut::MaximumFrequency { frequency_hz: 50.0 },
                profile: None,
                ..victoria
            },
            Self::SouthEastAustralia => PointSource {
                stress_drop_pa: 23e6,
                spreading: vec![piece(1e3, 1.3), piece(90e3, -0.1), piece(160e3, 1.6)],
                quality: Quality::LogCubic {
                    coefficients_ratio: [3.66, -1.44, 0.768, 0.058],
                    lowest_hz: 0.78,
                    highest_hz: 19.9,
                },
                high_cut: HighCut::Kappa { kappa_s: 0.006 },
                ..victoria
            },
        }
    }
}

impl Quality {
    /// Q at a frequency.
    pub fn at_ratio(self, frequency_hz: f64) -> f64 {
        match self {
            Self::Power {
                at_1_hz_ratio,
                exponent_ratio,
            } => at_1_hz_ratio * frequency_hz.powf(exponent_ratio),
            Self::LogCubic {
                coefficients_ratio: [c0, c1, c2, c3],
                lowest_hz,
                highest_hz,
            } => {
                let x = frequency_hz.clamp(lowest_hz, highest_hz).log10();
                10.0_f64.powf(c0 + x * (c1 + x * (c2 + x * c3)))
            }
        }
    }
}

/// G(R), 1 at 1 km: the product over the ranges up to R.
fn spreading_ratio(pieces: &[SpreadingPiece], distance_m: f64) -> f64 {
    let ends = pieces
        .iter()
        .skip(1)
        .map(|piece| piece.from_distance_m)
        .chain([f64::INFINITY]);
    let reached = pieces
        .iter()
        .zip(ends)
        .take_while(|(piece, _)| piece.from_distance_m < distance_m);
    reached
        .map(|(piece, end)| {
            (end.min(distance_m) / piece.from_distance_m).powf(-piece.exponent_ratio)
        })
        .product()
}

/// Corner frequencies of the source \[Hz\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Corners {
    /// One corner, f₀.
    Single {
        /// Corner frequency f₀ \[Hz\].
        corner_hz: f64,
    },
    /// Two corners, f_a and f_b, and the share ε of the upper one.
    Two {
        /// Lower corner frequency f_a \[Hz\].
        lower_hz: f64,
        /// Upper corner frequency f_b \[Hz\].
        upper_hz: f64,
        /// Share ε of the upper corner.
        upper_share_ratio: f64,
    },
}

impl PointSource {
    /// Seismic moment M₀ = 10^(1.5 M + 9.05) \[N·m\].
    pub fn moment_n_m(&self) -> f64 {
        10.0_f64.powf(1.5 * self.magnitude + 9.05)
    }

    /// Brune's corner frequency f₀ = 0.4906 β (Δσ/M₀)^⅓ \[Hz\] (4.906e6 in km/s, bar and dyn·cm).
    ///
    /// # Example
    /// ```
    /// use freestand::synthesis::Preset;
    /// assert!((Preset::Victoria.source(6.0, 28e3).corner_hz() - 0.44854).abs() < 5e-6);
    /// ```
    pub fn corner_hz(&self) -> f64 {
        CORNER_COEFFICIENT
            * self.shear_velocity_m_s
            * (self.stress_drop_pa / self.moment_n_m()).cbrt()
    }

    /// The corners of the source spectrum.
    pub fn corners(&self) -> Corners {
        let corner_hz = self.corner_hz();
        match self.spectrum {
            SourceSpectrum::SingleCorner => Corners::Single { corner_hz },
            SourceSpectrum::TwoCorner => {
                let lower_hz = 10.0_f64.powf(2.41 - 0.533 * self.magnitude);
                let share = 10.0_f64.powf(2.52 - 0.637 * self.magnitude);
                let upper_hz =
                    ((corner_hz * corner_hz - (1.0 - share) * lower_hz * lower_hz) / share).sqrt();
                Corners::Two {
                    lower_hz,
                    upper_hz,
                    upper_share_ratio: share,
                }
            }
        }
    }

    /// Duration T_d of the window, 1/f₀ plus the duration added by the path \[s\]; for a source
    /// with two corners f₀ is also Brune's.
    pub fn duration_s(&self) -> f64 {
        let r_km = self.distance_m / 1000.0;
        let path_s = match self.path_duration {
            PathDuration::Boore => 0.05 * r_km,
            PathDuration::AtkinsonBoore if r_km <= 70.0 => 0.16 * r_km,
            PathDuration::AtkinsonBoore if r_km <= 130.0 => 11.2 - 0.03 * (r_km - 70.0),
            PathDuration::AtkinsonBoore => 9.4 + 0.04 * (r_km - 130.0),
        };
        1.0 / self.corner_hz() + path_s
    }

    /// C = R_θφ F V/(4πρβ³R₀) with R_θφ = 0.55, F = 2, V = 1/√2, R₀ = 1 km \[s³/(kg·m): m/s of
    /// A(f) for N·m/s²\].
    fn scale(&self) -> f64 {
        let partition = 0.5_f64.sqrt();
        RADIATION_RATIO * FREE_SURFACE_RATIO * partition
            / (4.0
                * PI
                * self.density_kg_m3
                * self.shear_velocity_m_s.powi(3)
                * REFERENCE_DISTANCE_M)
    }

    /// Fourier amplitude of the ground acceleration without the amplification of the crust \[m/s\].
    ///
    /// # Reference
    /// Boore (2003), Eqs. (1) to (25), in the form of GMSS 2.0.
    ///
    /// # Accuracy
    /// A product of closed forms: rounding.
    ///
    /// # Example
    /// M 6 at 28 km, 200 bar, 1/R, Q = 100 f^0.85, κ₀ = 0.025 s: 9.823 cm/s at 1 Hz, to a unit of
    /// the fifth digit:
    /// ```
    /// use freestand::synthesis::Preset;
    /// let amplitude_m_s = Preset::Victoria.source(6.0, 28e3).unamplified_m_s(1.0);
    /// assert!((amplitude_m_s - 0.098230).abs() < 1e-6);
    /// ```
    pub fn unamplified_m_s(&self, frequency_hz: f64) -> f64 {
        let brune = |corner_hz: f64| 1.0 / (1.0 + (frequency_hz / corner_hz).powi(2));
        let shape = match self.corners() {
            Corners::Single { corner_hz } => brune(corner_hz),
            Corners::Two {
                lower_hz,
                upper_hz,
                upper_share_ratio,
            } => (1.0 - upper_share_ratio) * brune(lower_hz) + upper_share_ratio * brune(upper_hz),
        };
        let source = self.scale() * self.moment_n_m() * (TAU * frequency_hz).powi(2) * shape;
        let q = self.quality.at_ratio(frequency_hz);
        let path = spreading_ratio(&self.spreading, self.distance_m)
            * (-PI * frequency_hz * self.distance_m / (q * self.shear_velocity_m_s)).exp();
        let surface = match self.high_cut {
            HighCut::Kappa { kappa_s } => (-PI * kappa_s * frequency_hz).exp(),
            HighCut::MaximumFrequency {
                frequency_hz: maximum_hz,
            } => 1.0 / (1.0 + (frequency_hz / maximum_hz).powi(8)).sqrt(),
        };
        source * path * surface
    }

    /// Amplification of the crust at a frequency; 1 without a profile.
    pub fn amplification_ratio(&self, frequency_hz: f64) -> f64 {
        self.profile.as_ref().map_or(1.0, |profile| {
            profile.amplification_ratio(frequency_hz, self.density_kg_m3, self.shear_velocity_m_s)
        })
    }

    /// Fourier amplitude A(f) of the ground acceleration at the site \[m/s\].
    pub fn fourier_amplitude_m_s(&self, frequency_hz: f64) -> f64 {
        self.unamplified_m_s(frequency_hz) * self.amplification_ratio(frequency_hz)
    }

    /// Every parameter that is out of its range, with the range.
    pub fn faults(&self) -> Vec<SynthesisError> {
        let positive =
            |parameter: Parameter, value: f64| parameter.check(value > 0.0, "positive", value);
        let is_known = (3.0..=8.5).contains(&self.magnitude);
        let is_near = (1.0..=1000.0).contains(&(self.distance_m / 1000.0));
        let mut checks = vec![
            Parameter::Magnitude.check(is_known, "from 3 to 8.5", self.magnitude),
            Parameter::Distance.check(is_near, "from 1 km to 1000 km", self.distance_m),
            positive(Parameter::StressDrop, self.stress_drop_pa),
            positive(Parameter::Other("density_kg_m3"), self.density_kg_m3),
            positive(
                Parameter::Other("shear_velocity_m_s"),
                self.shear_velocity_m_s,
            ),
        ];
        // They follow from the values above.
        if let Corners::Two {
            upper_hz,
            upper_share_ratio,
            ..
        } = self.corners()
            && checks.iter().all(Result::is_ok)
        {
            let fine = upper_hz > 0.0 && upper_share_ratio < 1.0;
            let requirement =
                "one for which two corners exist (4 or more, with a large enough stress drop)";
            checks.push(Parameter::Magnitude.check(fine, requirement, self.magnitude));
        }
        match self.quality {
            Quality::Power {
                at_1_hz_ratio,
                exponent_ratio,
            } => {
                checks.push(positive(Parameter::Other("at_1_hz_ratio"), at_1_hz_ratio));
                let fine = (0.0..=1.0).contains(&exponent_ratio);
                let exponent = Parameter::Other("exponent_ratio");
                checks.push(exponent.check(fine, "from 0 to 1", exponent_ratio));
            }
            Quality::LogCubic {
                lowest_hz,
                highest_hz,
                ..
            } => {
                let fine = lowest_hz > 0.0 && lowest_hz < highest_hz;
                let lowest = Parameter::Other("lowest_hz");
                checks.push(lowest.check(fine, "positive and below highest_hz", lowest_hz));
            }
        }
        checks.push(match self.high_cut {
            HighCut::Kappa { kappa_s } => {
                let fine = (0.0..=LARGEST_KAPPA_S).contains(&kappa_s);
                Parameter::Kappa.check(fine, "from 0 s to 0.5 s", kappa_s)
            }
            HighCut::MaximumFrequency { frequency_hz } => {
                positive(Parameter::Other("frequency_hz"), frequency_hz)
            }
        });
        checks.push(self.check_spreading());
        checks.into_iter().filter_map(Result::err).collect()
    }

    fn check_spreading(&self) -> Result<(), SynthesisError> {
        let mut before_m = None;
        for piece in &self.spreading {
            let fine = match before_m {
                None => piece.from_distance_m == REFERENCE_DISTANCE_M,
                Some(before_m) => piece.from_distance_m > before_m,
            };
            if !(fine && piece.from_distance_m.is_finite() && piece.exponent_ratio.is_finite()) {
                return Err(SynthesisError::Option {
                    parameter: Parameter::Other("spreading"),
                    requirement: "a list of rising distances, the first at 1 km, with finite exponents",
                    value: piece.from_distance_m,
                });
            }
            before_m = Some(piece.from_distance_m);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::first;
    use super::*;

    fn reference() -> PointSource {
        PointSource {
            profile: None,
            ..Preset::Victoria.source(6.0, 28e3)
        }
    }

    #[test]
    fn the_amplitudes_are_those_of_the_reference() {
        // From an independent computation in cgs units, printed to five digits.
        let source = reference();
        assert!((source.corner_hz() - 0.44854).abs() < 5e-6);
        // m/s for N·m to cm/s for dyn·cm.
        assert!((source.scale() * 100.0 * 1e-7 / 5.156e-24 - 1.0).abs() < 1e-4);
        let cm_s = [
            (0.1, 0.64529),
            (0.5, 6.9705),
            (1.0, 9.8230),
            (2.0, 10.104),
            (5.0, 7.9824),
            (10.0, 5.2356),
            (20.0, 2.2995),
        ];
        for (frequency_hz, expected) in cm_s {
            let got = 100.0 * source.fourier_amplitude_m_s(frequency_hz);
            // Half a unit of the fifth digit of the smallest leading one.
            assert!(
                (got / expected - 1.0).abs() < 5e-5,
                "{frequency_hz} Hz: {got}"
            );
        }
        // 2.23 s of the source and 1.5 s of the path: 3.7 s, as in the reference.
        assert!((Preset::Victoria.source(6.0, 30e3).duration_s() - 3.7).abs() < 0.05);
    }

    #[test]
    fn two_corners_meet_the_single_one_at_both_ends() {
        let single = reference();
        let two = PointSource {
            spectrum: SourceSpectrum::TwoCorner,
            ..reference()
        };
        let ratio = |frequency_hz: f64| {
            two.unamplified_m_s(frequency_hz) / single.unamplified_m_s(frequency_hz)
        };
        // Both are M₀ at f → 0 and M₀ f₀² at f → ∞, with corrections of (f/f_a)² and (f_b/f)².
        assert!((ratio(1e-4) - 1.0).abs() < 1e-5 && (ratio(1e3) - 1.0).abs() < 1e-5);
        // Between them it sags: log f_a = 2.41 − 3.198.
        assert!(ratio(0.4) < 0.8, "{}", ratio(0.4));
        let Corners::Two {
            lower_hz,
            upper_share_ratio,
            ..
        } = two.corners()
        else {
            panic!()
        };
        assert!((lower_hz - 0.16293).abs() < 5e-6 && (upper_share_ratio - 0.049888).abs() < 5e-7);
    }

    #[test]
    fn spreading_and_durations_join_at_their_corners() {
        let at = |r_km: f64| spreading_ratio(&reference().spreading, 1000.0 * r_km);
        // 1/R up to 70 km, constant up to 130 km, then R^(−½).
        assert!((at(28.0) * 28.0 - 1.0).abs() < 1e-14);
        assert!((at(100.0) * 70.0 - 1.0).abs() < 1e-14 && (at(520.0) * 140.0 - 1.0).abs() < 1e-14);
        // Allen et al. (2007): R^(−1.3) up to 90 km, R^(+0.1) up to 160 km, then R^(−1.6).
        let allen = Preset::SouthEastAustralia.source(6.0, 30e3).spreading;
        let expected = 90.0_f64.powf(-1.3) * (160.0_f64 / 90.0).powf(0.1) * 2.0_f64.powf(-1.6);
        assert!((spreading_ratio(&allen, 320e3) / expected - 1.0).abs() < 1e-13);
        let path = |r_km: f64| {
            let source = PointSource {
                distance_m: 1000.0 * r_km,
                path_duration: PathDuration::AtkinsonBoore,
                ..reference()
            };
            source.duration_s() - 1.0 / source.corner_hz()
        };
        for (r_km, expected) in [
            (50.0, 8.0),
            (70.0, 11.2),
            (100.0, 10.3),
            (130.0, 9.4),
            (230.0, 13.4),
        ] {
            assert!((path(r_km) - expected).abs() < 1e-12, "{r_km} km");
        }
    }

    #[test]
    fn losses_have_their_closed_forms() {
        let allen = Preset::SouthEastAustralia.source(6.0, 30e3).quality;
        // log Q(1 Hz) = 3.66; Q(10 Hz) = 10^(3.66 − 1.44 + 0.768 + 0.058) = 10^3.046; constant
        // beyond 0.78 and 19.9 Hz.
        assert!((allen.at_ratio(1.0).log10() - 3.66).abs() < 1e-13);
        assert!((allen.at_ratio(10.0).log10() - 3.046).abs() < 1e-13);
        assert_eq!(
            (allen.at_ratio(0.1), allen.at_ratio(50.0)),
            (allen.at_ratio(0.78), allen.at_ratio(19.9))
        );
        let cut = PointSource {
            high_cut: HighCut::MaximumFrequency { frequency_hz: 15.0 },
            ..reference()
        };
        let uncut = PointSource {
            high_cut: HighCut::Kappa { kappa_s: 0.0 },
            ..reference()
        };
        // 1/√2 at f_max.
        assert!(
            (cut.unamplified_m_s(15.0) / uncut.unamplified_m_s(15.0) - 0.5_f64.sqrt()).abs()
                < 1e-14
        );
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        let name = |source: PointSource| match first(source.faults()) {
            Err(SynthesisError::Option { parameter, .. }) => parameter.name(),
            other => panic!("{other:?}"),
        };
        for preset in Preset::ALL {
            assert_eq!(preset.source(6.0, 30e3).faults(), []);
        }
        assert_eq!(name(Preset::Victoria.source(9.0, 30e3)), "magnitude");
        assert_eq!(
            name(Preset::IntraplateHardRock.source(3.5, 30e3)),
            "magnitude"
        );
        assert_eq!(name(Preset::Victoria.source(6.0, 500.0)), "distance_m");
        assert_eq!(
            name(PointSource {
                stress_drop_pa: f64::NAN,
                ..reference()
            }),
            "stress_drop_pa"
        );
        assert_eq!(
            name(PointSource {
                high_cut: HighCut::Kappa { kappa_s: -1.0 },
                ..reference()
            }),
            "kappa_s"
        );
        // 30 ms without its unit's prefix.
        assert_eq!(
            name(PointSource {
                high_cut: HighCut::Kappa { kappa_s: 30.0 },
                ..reference()
            }),
            "kappa_s"
        );
        let spreading = vec![SpreadingPiece {
            from_distance_m: 2e3,
            exponent_ratio: 1.0,
        }];
        assert_eq!(
            name(PointSource {
                spreading,
                ..reference()
            }),
            "spreading"
        );
    }
}
