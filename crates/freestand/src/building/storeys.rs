//! A shear building: rigid floors on storey springs, one degree of freedom per storey.

use super::{
    Building, BuildingError, Damping, FloorShape, Mode, ModeShape, Model, StoreyQuantity,
    check_period,
};
use std::f64::consts::TAU;

/// The largest number of storeys of a shear building.
pub const MAX_STOREYS: usize = 200;

/// One storey of a shear building.
///
/// **Units**: kg, N/m, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Storey {
    /// Mass of the floor above the storey \[kg\].
    pub mass_kg: f64,
    /// Lateral stiffness of the storey: its shear force for a drift of 1 m \[N/m\].
    pub stiffness_n_m: f64,
    /// Height of the storey \[m\].
    pub height_m: f64,
}

impl Building {
    /// A shear building of `storeys` from the ground up, with its `modes` longest modes.
    ///
    /// `K φ = ω² M φ` with floor masses and the tridiagonal stiffness of springs in series. Written
    /// as `ω = σ(K_s^½ L M^−½)`, with K_s the storey stiffnesses and L the drifts, the frequencies
    /// are singular values rather than square roots of rounded eigenvalues.
    ///
    /// # Reference
    /// Chopra, Dynamics of Structures, shear buildings; Demmel and Veselić (1992), "Jacobi's method
    /// is more accurate than QR", SIAM J. Matrix Anal. Appl. 13: singular values from rotations of
    /// columns are accurate to their last digits, however much the columns (the stiffnesses)
    /// differ.
    ///
    /// # Accuracy
    /// Frequencies of 200 equal storeys agree with the closed form to 1e-12, also with stiffnesses
    /// from 1 to 10⁶; shapes are orthogonal to 1e-12 even where two frequencies are nearly equal.
    ///
    /// # Limitation
    /// Floors move only sideways: no bending of the building as a whole, no torsion. For a slender
    /// tower use [`Building::beam`] or [`Building::from_modes`].
    ///
    /// # Errors
    /// No storeys or more than [`MAX_STOREYS`]; a mass, stiffness or height that is not positive
    /// and finite; no modes or more than storeys; a fundamental period above
    /// [`MAX_PERIOD_S`](super::MAX_PERIOD_S); damping, see [`Damping::ratios`].
    ///
    /// # Example
    /// Two equal storeys: ω₁ = 2√(k/m) sin 18° = 0.618 √(k/m), and the roof moves 1.618 times as
    /// far as the first floor.
    /// ```
    /// use freestand::building::{Building, Damping, Storey};
    /// let storey = Storey { mass_kg: 1000.0, stiffness_n_m: 1e6, height_m: 3.0 };
    /// let building = Building::shear(&[storey, storey], &Damping::Uniform(0.05), 2)?;
    /// let omega_rad_s = std::f64::consts::TAU / building.period_s();
    /// assert!((omega_rad_s / 1000.0f64.sqrt() - 0.618034).abs() < 1e-6);
    /// assert!((1.0 / building.modes()[0].shape_ratio(0.5) - 1.618034).abs() < 1e-6);
    /// # Ok::<(), freestand::building::BuildingError>(())
    /// ```
    pub fn shear(
        storeys: &[Storey],
        damping: &Damping,
        modes: usize,
    ) -> Result<Self, BuildingError> {
        check(storeys)?;
        if !(1..=storeys.len()).contains(&modes) {
            return Err(BuildingError::Modes {
                modes,
                at_most: storeys.len(),
            });
        }
        let levels_ratio = levels(storeys);
        let mass_kg: f64 = storeys.iter().map(|storey| storey.mass_kg).sum();
        let mut modes: Vec<Mode> = natural_modes(storeys)
            .into_iter()
            .take(modes)
            .map(|(omega_rad_s, vector)| {
                mode(storeys, mass_kg, &levels_ratio, omega_rad_s, &vector)
            })
            .collect();
        let periods_s: Vec<f64> = modes.iter().map(Mode::period_s).collect();
        for &period_s in &periods_s {
            check_period(period_s)?;
        }
        for (mode, ratio) in modes.iter_mut().zip(damping.ratios(&periods_s)?) {
            mode.damping_ratio = ratio;
        }
        Ok(Self {
            model: Model::Shear {
                storeys: storeys.len(),
            },
            modes,
            floors_ratio: levels_ratio,
        })
    }
}

fn check(storeys: &[Storey]) -> Result<(), BuildingError> {
    if !(1..=MAX_STOREYS).contains(&storeys.len()) {
        return Err(BuildingError::Storeys {
            storeys: storeys.len(),
        });
    }
    for (i, storey) in storeys.iter().enumerate() {
        for (quantity, value) in [
            (StoreyQuantity::Mass, storey.mass_kg),
            (StoreyQuantity::Stiffness, storey.stiffness_n_m),
            (StoreyQuantity::Height, storey.height_m),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(BuildingError::Storey {
                    storey: i + 1,
                    quantity,
                    value,
                });
            }
        }
    }
    // Guards against modes outside the range of floating-point numbers: stiffness over mass must
    // not overflow or vanish.
    let omega2 = |below: &Storey, above: &Storey| above.stiffness_n_m / below.mass_kg;
    let pairs = storeys.windows(2).map(|pair| omega2(&pair[0], &pair[1]));
    let own = storeys.iter().map(|storey| omega2(storey, storey));
    match pairs
        .chain(own)
        .find(|omega2| !(*omega2 > 0.0 && omega2.is_finite()))
    {
        Some(omega2) => Err(BuildingError::Period {
            period_s: TAU / omega2.sqrt(),
        }),
        None => Ok(()),
    }
}

/// Heights of the floors as shares of the total; exactly 1 at the roof.
fn levels(storeys: &[Storey]) -> Vec<f64> {
    let total_m: f64 = storeys.iter().map(|storey| storey.height_m).sum();
    let mut height_m = 0.0;
    let floors = storeys.iter().map(|storey| {
        height_m += storey.height_m;
        height_m / total_m
    });
    floors.collect()
}

/// The mode of circular frequency ω and unit vector v = M^½ φ.
fn mode(
    storeys: &[Storey],
    mass_kg: f64,
    levels_ratio: &[f64],
    omega_rad_s: f64,
    vector: &[f64],
) -> Mode {
    let mut values_ratio: Vec<f64> = vector
        .iter()
        .zip(storeys)
        .map(|(v, storey)| v / storey.mass_kg.sqrt())
        .collect();
    let largest = values_ratio
        .iter()
        .fold(0.0, |a: f64, b| if b.abs() > a.abs() { *b } else { a });
    let roof = values_ratio.last().copied().unwrap_or(0.0);
    let unit = if roof.abs() >= STILL_ROOF * largest.abs() {
        roof
    } else {
        largest
    };
    values_ratio.iter_mut().for_each(|value| *value /= unit);
    // Γ = Σmφ/Σmφ² for φ = M^−½ v/unit and |v| = 1.
    let excitation: f64 = vector
        .iter()
        .zip(storeys)
        .map(|(v, storey)| v * storey.mass_kg.sqrt())
        .sum();
    Mode {
        period_s: TAU / omega_rad_s,
        damping_ratio: 0.0,
        participation_ratio: excitation * unit,
        effective_mass_ratio: Some(excitation / mass_kg * excitation),
        shape: ModeShape::Floors(FloorShape {
            levels_ratio: levels_ratio.to_vec(),
            values_ratio,
        }),
    }
}

/// A roof that moves less than this share of the mode's largest value is not used to normalise it.
const STILL_ROOF: f64 = 1e-3;

/// Largest number of sweeps. No matrix needs more than about ten, because the rotations converge
/// quadratically at the end.
const MAX_SWEEPS: usize = 60;

/// Columns of `n` values with a cosine below this are orthogonal: rounding leaves about √n ε.
fn orthogonal(n: usize) -> f64 {
    (8.0 + (n as f64).sqrt()) * f64::EPSILON
}

/// Circular frequencies in increasing order, and the unit vectors v = M^½ φ.
///
/// One-sided Jacobi rotations: column j of `M^−½ Lᵀ K_s^½` belongs to storey j. Pairs of columns
/// are rotated until all columns are orthogonal; then each column is ω v.
fn natural_modes(storeys: &[Storey]) -> Vec<(f64, Vec<f64>)> {
    let n = storeys.len();
    let mut columns: Vec<Vec<f64>> = (0..n)
        .map(|j| {
            let mut column = vec![0.0; n];
            column[j] = (storeys[j].stiffness_n_m / storeys[j].mass_kg).sqrt();
            if j > 0 {
                column[j - 1] = -(storeys[j].stiffness_n_m / storeys[j - 1].mass_kg).sqrt();
            }
            column
        })
        .collect();
    // The product that rounding leaves between two orthogonal columns.
    let orthogonal = orthogonal(n);
    for _ in 0..MAX_SWEEPS {
        // Longest columns first, which halves the number of sweeps.
        columns.sort_by(|a, b| dot(b, b).total_cmp(&dot(a, a)));
        let mut turned = false;
        for q in 1..n {
            let (before, rest) = columns.split_at_mut(q);
            let Some(other) = rest.first_mut() else {
                continue;
            };
            for one in before {
                turned |= turn(one, other, orthogonal);
            }
        }
        if !turned {
            break;
        }
    }
    let mut modes: Vec<(f64, Vec<f64>)> = columns
        .into_iter()
        .map(|mut column| {
            let omega_rad_s = dot(&column, &column).sqrt();
            column.iter_mut().for_each(|value| *value /= omega_rad_s);
            (omega_rad_s, column)
        })
        .collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    modes
}

/// Rotates two columns so that they are orthogonal; `true` if they were not yet.
fn turn(one: &mut [f64], other: &mut [f64], orthogonal: f64) -> bool {
    let (a, b, product) = (dot(one, one), dot(other, other), dot(one, other));
    if product.abs() <= orthogonal * a.sqrt() * b.sqrt() {
        return false;
    }
    let zeta = (b - a) / (2.0 * product);
    let tan = (1.0f64.copysign(zeta)) / (zeta.abs() + zeta.hypot(1.0));
    let cos = 1.0 / tan.hypot(1.0);
    let sin = cos * tan;
    for (x, y) in one.iter_mut().zip(other) {
        (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
    }
    true
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::building::{floor_motions, floor_peaks};
    use crate::motion::Motion;
    use std::f64::consts::PI;

    const UNIFORM: Damping = Damping::Uniform(0.05);

    fn equal(n: usize) -> Vec<Storey> {
        vec![
            Storey {
                mass_kg: 4e5,
                stiffness_n_m: 9e8,
                height_m: 3.2
            };
            n
        ]
    }

    fn omega(mode: &Mode) -> f64 {
        TAU / mode.period_s()
    }

    #[test]
    fn thirty_equal_storeys_are_the_printed_table() {
        let building = Building::shear(&equal(30), &UNIFORM, 5).unwrap();
        let modes = building.modes();
        // Half a unit of the last printed digit.
        for (mode, ratio) in modes
            .iter()
            .skip(1)
            .zip([0.33363, 0.20053, 0.14362, 0.11210])
        {
            assert!((mode.period_s() / building.period_s() - ratio).abs() < 5.1e-6);
        }
        for (mode, participation) in modes.iter().zip([1.27254, -0.42231, 0.25114]) {
            assert!((mode.participation_ratio() - participation).abs() < 5.1e-6);
        }
        for (mode, share) in modes.iter().zip([0.88845, 0.31085, -0.16718]) {
            assert!((mode.share_ratio(0.5) - share).abs() < 5.1e-6);
        }
    }

    #[test]
    fn equal_storeys_follow_the_closed_form_at_every_height() {
        for n in [1, 2, 3, 7, 30, 100, MAX_STOREYS] {
            let storeys = equal(n);
            let building = Building::shear(&storeys, &UNIFORM, n).unwrap();
            let unit = (storeys[0].stiffness_n_m / storeys[0].mass_kg).sqrt();
            for (i, mode) in building.modes().iter().enumerate() {
                let angle = (2 * i + 1) as f64 * PI / (2 * n + 1) as f64;
                // n rotations of each column in ten sweeps, ε each: 200·10·1.1e-16 = 2e-13, with a
                // margin.
                assert!(
                    (omega(mode) / (2.0 * unit * (0.5 * angle).sin()) - 1.0).abs() < 1e-12,
                    "{n} {i}"
                );
                let roof = (angle * n as f64).sin();
                // Two vectors whose product is not below `orthogonal` are mixed by that over the
                // gap between their frequencies, from both neighbours, by a few times that; a unit
                // vector has 1/√(n/2) for φ = 1.
                let gap = (PI / (2 * n + 1) as f64) / (0.5 * angle).tan();
                // And each value is rotated n times in each of about ten sweeps, with rounding of
                // ε.
                let mixed = 4.0 * orthogonal(n) / gap + (10 * n) as f64 * f64::EPSILON;
                for (j, &level) in building.floors_ratio().iter().enumerate() {
                    let expected = (angle * (j + 1) as f64).sin() / roof;
                    let error = (mode.shape_ratio(level) - expected).abs();
                    assert!(
                        error < mixed / (roof * roof),
                        "{n} {i} {j}: {error} {mixed} {roof}"
                    );
                }
            }
        }
    }

    /// Number of frequencies below ω by the signs of the pivots of K − ω²M, an independent count.
    fn below(storeys: &[Storey], omega: f64) -> usize {
        let (mut count, mut pivot) = (0, f64::INFINITY);
        for (j, storey) in storeys.iter().enumerate() {
            let above = storeys.get(j + 1).map_or(0.0, |next| next.stiffness_n_m);
            pivot = storey.stiffness_n_m + above
                - omega * omega * storey.mass_kg
                - storey.stiffness_n_m * storey.stiffness_n_m / pivot;
            count += usize::from(pivot < 0.0);
        }
        count
    }

    /// Random numbers that are good enough for a test: splitmix64 in [0, 1).
    fn random(state: &mut u64) -> f64 {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = *state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 2f64.powi(64)
    }

    /// A tower of any kind, biased towards difficult cases: stiffnesses and masses over six
    /// decades, soft storeys, light tops.
    fn trouble(n: usize, decades: f64, seed: u64) -> Vec<Storey> {
        let mut state = seed;
        (0..n)
            .map(|_| Storey {
                mass_kg: 1e5 * 10f64.powf(decades * (random(&mut state) - 0.5)),
                stiffness_n_m: 1e12 * 10f64.powf(decades * (random(&mut state) - 0.5)),
                height_m: 2.5 + random(&mut state),
            })
            .collect()
    }

    #[test]
    fn any_storeys_have_orthogonal_modes_that_carry_all_the_mass() {
        for (n, decades, seed) in [
            (2, 6.0, 1),
            (5, 6.0, 2),
            (12, 6.0, 3),
            (40, 6.0, 4),
            (60, 1.0, 5),
            (25, 0.0, 6),
        ] {
            let storeys = trouble(n, decades, seed);
            let building = Building::shear(&storeys, &UNIFORM, n)
                .unwrap_or_else(|error| panic!("{n}: {error}"));
            let modes = building.modes();
            let mass: f64 = modes.iter().filter_map(Mode::effective_mass_ratio).sum();
            // Each pair is orthogonal to (n + 8) ε at most; a sum over n of them.
            assert!((mass - 1.0).abs() < 1e-12, "{n}: {mass}");
            for (j, &level) in building.floors_ratio().iter().enumerate() {
                // Σ Γφ = 1 at each floor; φ of a light floor is √(M/m) times its v, here up to 10³
                // times √n.
                let sum: f64 = modes.iter().map(|mode| mode.share_ratio(level)).sum();
                assert!((sum - 1.0).abs() < 1e-9, "{n} floor {j}: {sum}");
            }
            for (i, a) in modes.iter().enumerate() {
                let product = |b: &Mode| -> f64 {
                    let floors = building.floors_ratio().iter().zip(&storeys);
                    floors
                        .map(|(&x, storey)| storey.mass_kg * a.shape_ratio(x) * b.shape_ratio(x))
                        .sum()
                };
                let own = product(a);
                for b in &modes[..i] {
                    let theirs: f64 = {
                        let floors = building.floors_ratio().iter().zip(&storeys);
                        floors
                            .map(|(&x, storey)| storey.mass_kg * b.shape_ratio(x).powi(2))
                            .sum()
                    };
                    assert!(
                        product(b).abs() < 1e-12 * (own * theirs).sqrt(),
                        "{n}: modes not orthogonal"
                    );
                }
            }
        }
    }

    #[test]
    fn no_frequency_is_missed_or_found_twice() {
        for seed in 1..20 {
            let n = 3 + 2 * seed as usize;
            let storeys = trouble(n, 3.0, seed);
            for (i, mode) in Building::shear(&storeys, &UNIFORM, n)
                .unwrap()
                .modes()
                .iter()
                .enumerate()
            {
                // The count itself is accurate to ε·ω_max²/ω² of ω², and the stiffnesses and the
                // masses differ by 10³.
                assert_eq!(
                    below(&storeys, omega(mode) * (1.0 - 1e-7)),
                    i,
                    "{n} mode {i}"
                );
                assert_eq!(
                    below(&storeys, omega(mode) * (1.0 + 1e-7)),
                    i + 1,
                    "{n} mode {i}"
                );
            }
        }
    }

    /// Two masses, the upper one light and tuned to the lower one: ω² = (k/m)(1 + μ/2 ± √(μ +
    /// μ²/4)), with μ the ratio of the masses.
    #[test]
    fn nearly_equal_frequencies_are_told_apart() {
        for mu in [1e-2, 1e-6, 1e-12] {
            let storey = Storey {
                mass_kg: 1e6,
                stiffness_n_m: 1e8,
                height_m: 3.0,
            };
            let light = Storey {
                mass_kg: 1e6 * mu,
                stiffness_n_m: 1e8 * mu,
                height_m: 3.0,
            };
            let building = Building::shear(&[storey, light], &UNIFORM, 2).unwrap();
            let spread = (mu + 0.25 * mu * mu).sqrt();
            for (mode, sign) in building.modes().iter().zip([-1.0, 1.0]) {
                let omega2 = 100.0 * (1.0 + 0.5 * mu + sign * spread);
                assert!((omega(mode) / omega2.sqrt() - 1.0).abs() < 1e-14, "{mu}");
                assert_eq!(mode.shape_ratio(1.0), 1.0);
                // φ(floor)/φ(roof) = 1 − ω² m/k = −(μ/2 ± spread); of two nearly equal vectors,
                // each contains ε/spread of the other.
                let expected = -(0.5 * mu + sign * spread);
                assert!(
                    (mode.shape_ratio(0.5) / expected - 1.0).abs() < 1e-14 / spread,
                    "{mu}"
                );
            }
        }
    }

    fn shaking() -> Motion {
        let wave = |k: u32| (0.07 * f64::from(k)).sin() * 2.0 + (0.4 * f64::from(k)).cos() - 1.0;
        Motion::new(0.01, (0..600).map(wave).collect()).unwrap()
    }

    /// Absolute floor accelerations and relative displacements by fourth-order Runge–Kutta steps of
    /// the matrices.
    fn integrated(
        storeys: &[Storey],
        mass_factor: f64,
        stiffness_factor: f64,
        ground: &Motion,
    ) -> Vec<[Vec<f64>; 2]> {
        let n = storeys.len();
        let springs = |x: &[f64]| -> Vec<f64> {
            let drift = |j: usize| x[j] - if j > 0 { x[j - 1] } else { 0.0 };
            (0..n)
                .map(|j| {
                    let above = if j + 1 < n {
                        storeys[j + 1].stiffness_n_m * drift(j + 1)
                    } else {
                        0.0
                    };
                    (storeys[j].stiffness_n_m * drift(j) - above) / storeys[j].mass_kg
                })
                .collect()
        };
        // −M⁻¹(C u̇ + K u), C = a₀ M + a₁ K.
        let absolute = |u: &[f64], v: &[f64]| -> Vec<f64> {
            let (elastic, viscous) = (springs(u), springs(v));
            (0..n)
                .map(|j| -(elastic[j] + stiffness_factor * viscous[j] + mass_factor * v[j]))
                .collect()
        };
        let derivative = |ground: f64, y: &[f64]| -> Vec<f64> {
            let (u, v) = y.split_at(n);
            v.iter()
                .copied()
                .chain(absolute(u, v).into_iter().map(|a| a - ground))
                .collect()
        };
        const SUBSTEPS: u32 = 40;
        let h = ground.dt_s() / f64::from(SUBSTEPS);
        let mut y = vec![0.0; 2 * n];
        let mut floors = vec![[Vec::new(), Vec::new()]; n];
        let samples = ground.accel_m_s2();
        for (k, &from) in samples.iter().enumerate() {
            let (u, v) = y.split_at(n);
            for (j, a) in absolute(u, v).into_iter().enumerate() {
                floors[j][0].push(a);
                floors[j][1].push(u[j]);
            }
            let Some(to) = samples.get(k + 1) else { break };
            for i in 0..SUBSTEPS {
                let at =
                    |more: f64| from + (to - from) * (f64::from(i) + more) / f64::from(SUBSTEPS);
                let moved = |k: &[f64], by: f64| -> Vec<f64> {
                    y.iter().zip(k).map(|(y, k)| y + by * k).collect()
                };
                let k1 = derivative(at(0.0), &y);
                let k2 = derivative(at(0.5), &moved(&k1, 0.5 * h));
                let k3 = derivative(at(0.5), &moved(&k2, 0.5 * h));
                let k4 = derivative(at(1.0), &moved(&k3, h));
                for j in 0..2 * n {
                    y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
                }
            }
        }
        floors
    }

    #[test]
    fn all_modes_together_are_the_matrices_integrated_in_time() {
        let soft = |mass_kg, stiffness_n_m| Storey {
            mass_kg,
            stiffness_n_m,
            height_m: 3.0,
        };
        let storeys = [
            soft(4e5, 9e7),
            soft(3e5, 6e8),
            soft(3e5, 2e8),
            soft(2e5, 2e8),
            soft(5e4, 1e8),
        ];
        let damping = Damping::Rayleigh {
            damping_ratio: 0.07,
            modes: [1, 3],
        };
        let building = Building::shear(&storeys, &damping, 5).unwrap();
        let periods: Vec<f64> = building.modes().iter().map(Mode::period_s).collect();
        let (one, three) = (TAU / periods[0], TAU / periods[2]);
        let factor = 2.0 * 0.07 / (one + three);
        let reference = integrated(&storeys, factor * one * three, factor, &shaking());
        let floors = floor_motions(&shaking(), &building, building.floors_ratio()).unwrap();
        let peaks = floor_peaks(&shaking(), &building, building.floors_ratio()).unwrap();
        for ((floor, [accel, displacement]), peaks) in floors.iter().zip(&reference).zip(peaks) {
            // ω h = 90 · 0.00025: an error per step of (ωh)⁵/120 = 5e-11 of the state, over 24 000
            // steps with some damping.
            for (a, b) in floor.accel_m_s2().iter().zip(accel) {
                assert!((a - b).abs() < 1e-6, "{a} {b}");
            }
            let largest = displacement.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            assert!((peaks.displacement_m / largest - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn what_is_no_shear_building_is_refused() {
        let with = |change: fn(&mut Storey)| {
            let mut storeys = equal(3);
            change(&mut storeys[1]);
            Building::shear(&storeys, &UNIFORM, 2).unwrap_err()
        };
        let of = |error| matches!(error, BuildingError::Storey { storey: 2, .. });
        assert!(of(with(|s| s.mass_kg = 0.0)) && of(with(|s| s.mass_kg = f64::NAN)));
        assert!(of(with(|s| s.stiffness_n_m = -1.0)) && of(with(|s| s.height_m = f64::INFINITY)));
        assert!(matches!(
            with(|s| s.stiffness_n_m = f64::MIN_POSITIVE),
            BuildingError::Period { .. }
        ));
        assert!(matches!(
            with(|s| s.stiffness_n_m = 1.0),
            BuildingError::Period { .. }
        ));
        assert!(matches!(
            Building::shear(&[], &UNIFORM, 1),
            Err(BuildingError::Storeys { storeys: 0 })
        ));
        assert!(matches!(
            Building::shear(&equal(201), &UNIFORM, 1),
            Err(BuildingError::Storeys { .. })
        ));
        for modes in [0, 4] {
            let error = Building::shear(&equal(3), &UNIFORM, modes).unwrap_err();
            assert!(matches!(error, BuildingError::Modes { at_most: 3, .. }));
        }
    }
}
