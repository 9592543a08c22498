//! A building described by the modes of the user's own model.

use super::{
    Building, BuildingError, Damping, FloorShape, MAX_MODES, Mode, ModeQuantity, ModeShape, Model,
    check_period,
};

/// One mode of a modal table.
///
/// **Units**: s; the other values are ratios. Only the product of participation factor and shape
/// matters, so any normalisation is valid (mass, roof, largest value) as long as both use the same
/// one.
#[derive(Debug, Clone, PartialEq)]
pub struct TableMode {
    /// Period \[s\].
    pub period_s: f64,
    /// The damping ratio of this mode; `None`: that of the building.
    pub damping_ratio: Option<f64>,
    /// Participation factor Γ in the direction of the motion.
    pub participation_ratio: f64,
    /// Share of the mass that acts in the mode, if it is known.
    pub effective_mass_ratio: Option<f64>,
    /// Shape φ at each floor.
    pub shape_ratio: Vec<f64>,
}

/// Why the modes of a table may be wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModalDoubt {
    /// The modes carry too little of the mass, or more than all of it: modes are missing, or they
    /// belong to another direction.
    EffectiveMass {
        /// Σ of the effective mass ratios.
        sum_ratio: f64,
    },
    /// `Σ Γφ` at the roof, which approaches 1 as modes are added, is far from 1: factors and shapes
    /// with different normalisations, in other units, or for another direction.
    RoofShare {
        /// The sum.
        sum_ratio: f64,
    },
}

/// Range of a plausible sum of the effective mass ratios: codes usually require modes with 90 % of
/// the mass (from memory, not checked), and rounding may take the sum slightly above 1.
const ENOUGH_MASS: std::ops::RangeInclusive<f64> = 0.9..=1.01;

/// Range of a plausible `Σ Γφ` at the roof, with a margin: it is 1.57 with the first mode of a
/// cantilever wall and 1.57 − 0.87 = 0.70 with the first two.
const LIKELY_ROOF_SHARE: std::ops::RangeInclusive<f64> = 0.5..=1.75;

/// Range of a possible `Σ Γφ` at the roof. No building is near its ends: beyond them, factors and shapes are not of one
/// normalisation, and every floor motion would be wrong by this factor.
const POSSIBLE_ROOF_SHARE: std::ops::RangeInclusive<f64> = 0.25..=3.0;

impl Building {
    /// A building with the user's own `modes`, whose shapes are given at floors at `levels_ratio`
    /// of the height.
    ///
    /// The modes are sorted by decreasing period; `damping` applies where a mode has no ratio of
    /// its own.
    ///
    /// # Limitation
    /// Whatever the table leaves out (modes, directions, torsion) is missing from the results; see
    /// [`Building::doubts`].
    ///
    /// # Errors
    /// Levels that do not rise from above 0 to exactly 1; no modes or more than [`MAX_MODES`]; a
    /// mode whose number of values differs from that of the floors, or a value that is not finite;
    /// an effective mass outside 0 to 1; periods above [`MAX_PERIOD_S`](super::MAX_PERIOD_S);
    /// damping, see [`Damping::ratios`]; `Σ Γφ` at the roof outside 0.25 to 3.
    ///
    /// # Example
    /// A single mass at the roof, as its one mode with a product of 1; half-way up, by
    /// interpolation, it moves half as far:
    /// ```
    /// use freestand::building::{Building, Damping, TableMode};
    /// let mode = TableMode {
    ///     period_s: 0.5,
    ///     damping_ratio: None,
    ///     participation_ratio: 2.0,
    ///     effective_mass_ratio: Some(1.0),
    ///     shape_ratio: vec![0.5],
    /// };
    /// let building = Building::from_modes(&[1.0], &[mode], &Damping::Uniform(0.02))?;
    /// assert_eq!(building.modes()[0].share_ratio(1.0), 1.0);
    /// assert_eq!(building.modes()[0].share_ratio(0.5), 0.5);
    /// # Ok::<(), freestand::building::BuildingError>(())
    /// ```
    pub fn from_modes(
        levels_ratio: &[f64],
        modes: &[TableMode],
        damping: &Damping,
    ) -> Result<Self, BuildingError> {
        check_floors(levels_ratio)?;
        if !(1..=MAX_MODES).contains(&modes.len()) {
            return Err(BuildingError::Modes {
                modes: modes.len(),
                at_most: MAX_MODES,
            });
        }
        for (i, mode) in modes.iter().enumerate() {
            check_mode(i + 1, mode, levels_ratio.len())?;
        }
        let mut sorted: Vec<&TableMode> = modes.iter().collect();
        sorted.sort_by(|a, b| b.period_s.total_cmp(&a.period_s));
        let periods_s: Vec<f64> = sorted.iter().map(|mode| mode.period_s).collect();
        check_period(periods_s[0])?;
        // Where every mode has its own ratio, that of the building is not used.
        let common = if sorted.iter().all(|mode| mode.damping_ratio.is_some()) {
            vec![0.0; sorted.len()]
        } else {
            damping.ratios(&periods_s)?
        };
        let roof = |mode: &&TableMode| {
            mode.participation_ratio * mode.shape_ratio.last().copied().unwrap_or(0.0)
        };
        let sum_ratio: f64 = sorted.iter().map(roof).sum();
        if !POSSIBLE_ROOF_SHARE.contains(&sum_ratio) {
            return Err(BuildingError::RoofShare { sum_ratio });
        }
        let modes = sorted.into_iter().zip(common);
        let modes = modes.map(|(mode, common)| Mode {
            period_s: mode.period_s,
            damping_ratio: mode.damping_ratio.unwrap_or(common),
            participation_ratio: mode.participation_ratio,
            effective_mass_ratio: mode.effective_mass_ratio,
            shape: ModeShape::Floors(FloorShape {
                levels_ratio: levels_ratio.to_vec(),
                values_ratio: mode.shape_ratio.clone(),
            }),
        });
        Ok(Self {
            model: Model::Table {
                floors: levels_ratio.len(),
            },
            modes: modes.collect(),
            floors_ratio: levels_ratio.to_vec(),
        })
    }

    /// What may be wrong with the modes of a table; empty for a beam and for a shear building.
    pub fn doubts(&self) -> Vec<ModalDoubt> {
        let mut doubts = Vec::new();
        if !matches!(self.model, Model::Table { .. }) {
            return doubts;
        }
        let masses: Option<Vec<f64>> = self.modes.iter().map(Mode::effective_mass_ratio).collect();
        if let Some(sum_ratio) = masses.map(|masses| masses.iter().sum())
            && !ENOUGH_MASS.contains(&sum_ratio)
        {
            doubts.push(ModalDoubt::EffectiveMass { sum_ratio });
        }
        let sum_ratio = self.modes.iter().map(|mode| mode.share_ratio(1.0)).sum();
        if !LIKELY_ROOF_SHARE.contains(&sum_ratio) {
            doubts.push(ModalDoubt::RoofShare { sum_ratio });
        }
        doubts
    }
}

fn check_floors(levels_ratio: &[f64]) -> Result<(), BuildingError> {
    let mut below = 0.0;
    for (i, &level_ratio) in levels_ratio.iter().enumerate() {
        if !(level_ratio > below && level_ratio <= 1.0) {
            return Err(BuildingError::Floor {
                floor: i + 1,
                level_ratio,
            });
        }
        below = level_ratio;
    }
    if below == 1.0 {
        Ok(())
    } else {
        Err(BuildingError::Floor {
            floor: levels_ratio.len(),
            level_ratio: below,
        })
    }
}

fn check_mode(number: usize, mode: &TableMode, floors: usize) -> Result<(), BuildingError> {
    if mode.shape_ratio.len() != floors {
        return Err(BuildingError::ShapeLength {
            mode: number,
            values: mode.shape_ratio.len(),
            floors,
        });
    }
    let wrong = |quantity, expected, value| {
        Err(BuildingError::ModeValue {
            mode: number,
            quantity,
            expected,
            value,
        })
    };
    if !(mode.period_s > 0.0 && mode.period_s.is_finite()) {
        return wrong(ModeQuantity::Period, "positive and finite", mode.period_s);
    }
    if !mode.participation_ratio.is_finite() {
        return wrong(
            ModeQuantity::Participation,
            "finite",
            mode.participation_ratio,
        );
    }
    if let Some(&value) = mode.shape_ratio.iter().find(|value| !value.is_finite()) {
        return wrong(ModeQuantity::Shape, "finite", value);
    }
    if let Some(value) = mode
        .effective_mass_ratio
        .filter(|value| !(0.0..=1.0).contains(value))
    {
        return wrong(ModeQuantity::EffectiveMass, "a ratio from 0 to 1", value);
    }
    match mode
        .damping_ratio
        .filter(|ratio| !(0.0..1.0).contains(ratio))
    {
        Some(damping_ratio) => Err(BuildingError::ModeDamping {
            mode: number,
            damping_ratio,
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::building::{Storey, floor_motions};
    use crate::motion::Motion;

    const UNIFORM: Damping = Damping::Uniform(0.05);

    fn tower() -> Building {
        let storey = |mass_kg| Storey {
            mass_kg,
            stiffness_n_m: 2e8,
            height_m: 3.0,
        };
        Building::shear(
            &[storey(3e5), storey(2e5), storey(2e5), storey(1e5)],
            &UNIFORM,
            4,
        )
        .unwrap()
    }

    /// The modes of a building as a table, each with its own normalisation.
    fn table(building: &Building, units: [f64; 4]) -> Vec<TableMode> {
        let modes = building.modes().iter().zip(units);
        modes
            .map(|(mode, unit)| TableMode {
                period_s: mode.period_s(),
                damping_ratio: None,
                participation_ratio: mode.participation_ratio() / unit,
                effective_mass_ratio: mode.effective_mass_ratio(),
                shape_ratio: building
                    .floors_ratio()
                    .iter()
                    .map(|&x| unit * mode.shape_ratio(x))
                    .collect(),
            })
            .collect()
    }

    #[test]
    fn only_the_product_of_factor_and_shape_counts() {
        let building = tower();
        let mut modes = table(&building, [1.0, -0.25, 8.0, 1024.0]);
        modes.swap(0, 2);
        let from_table = Building::from_modes(building.floors_ratio(), &modes, &UNIFORM).unwrap();
        assert_eq!(from_table.doubts(), []);
        let ground = Motion::new(
            0.01,
            (0..300).map(|k| (0.11 * f64::from(k)).sin()).collect(),
        )
        .unwrap();
        let levels = [0.0, 0.1, 0.5, 0.77, 1.0];
        let floors = |building| floor_motions(&ground, building, &levels).unwrap();
        // Powers of two divide without rounding: bit for bit, in the order of the periods.
        assert_eq!(floors(&building), floors(&from_table));
    }

    #[test]
    fn shapes_are_linear_between_floors_and_zero_at_the_ground() {
        let mode = TableMode {
            period_s: 1.0,
            damping_ratio: Some(0.01),
            participation_ratio: 1.5,
            effective_mass_ratio: None,
            shape_ratio: vec![-0.5, 1.0],
        };
        let building = Building::from_modes(&[0.25, 1.0], &[mode], &Damping::Uniform(7.0)).unwrap();
        let mode = &building.modes()[0];
        let values = [0.0, 0.125, 0.25, 0.625, 1.0].map(|level| mode.shape_ratio(level));
        assert_eq!(values, [0.0, -0.25, -0.5, 0.25, 1.0]);
        assert_eq!(mode.damping_ratio(), 0.01);
    }

    #[test]
    fn factors_and_shapes_of_different_units_are_doubted() {
        let building = tower();
        let mut modes = table(&building, [1.0; 4]);
        let doubts = |modes: &[TableMode]| {
            Building::from_modes(building.floors_ratio(), modes, &UNIFORM)
                .unwrap()
                .doubts()
        };
        for mode in &mut modes {
            mode.participation_ratio *= 2.0;
        }
        assert!(
            matches!(doubts(&modes)[..], [ModalDoubt::RoofShare { sum_ratio }] if sum_ratio > 1.9)
        );
        for factor in [1000.0f64.sqrt(), 0.01, -1.0] {
            let mut modes = table(&building, [1.0; 4]);
            modes
                .iter_mut()
                .for_each(|mode| mode.participation_ratio *= factor);
            let refused = Building::from_modes(building.floors_ratio(), &modes, &UNIFORM);
            assert!(
                matches!(refused, Err(BuildingError::RoofShare { .. })),
                "{factor}"
            );
        }
        let modes = table(&building, [1.0; 4]);
        assert!(
            matches!(doubts(&modes[..1]).first(), Some(ModalDoubt::EffectiveMass { sum_ratio }) if *sum_ratio < 0.9)
        );
    }

    #[test]
    fn what_is_no_modal_table_is_refused() {
        let good = table(&tower(), [1.0; 4]);
        let levels = tower().floors_ratio().to_vec();
        for floors in [
            &[0.0, 0.5, 0.7, 1.0][..],
            &[0.2, 0.2, 0.7, 1.0],
            &[0.2, 0.5, 0.7, 0.9],
            &[],
            &[0.5, f64::NAN],
        ] {
            let error = Building::from_modes(floors, &good, &UNIFORM).unwrap_err();
            assert!(matches!(error, BuildingError::Floor { .. }), "{floors:?}");
        }
        let with = |change: fn(&mut TableMode)| {
            let mut modes = good.clone();
            change(&mut modes[1]);
            Building::from_modes(&levels, &modes, &UNIFORM).unwrap_err()
        };
        let value = |error| matches!(error, BuildingError::ModeValue { mode: 2, .. });
        assert!(
            value(with(|m| m.period_s = 0.0)) && value(with(|m| m.participation_ratio = f64::NAN))
        );
        assert!(value(with(|m| m.shape_ratio[0] = f64::INFINITY)));
        assert!(value(with(|m| m.effective_mass_ratio = Some(78.0))));
        assert!(matches!(
            with(|m| m.damping_ratio = Some(5.0)),
            BuildingError::ModeDamping { mode: 2, .. }
        ));
        assert!(matches!(
            with(|m| m.shape_ratio.truncate(1)),
            BuildingError::ShapeLength { mode: 2, .. }
        ));
        assert!(matches!(
            with(|m| m.period_s = 101.0),
            BuildingError::Period { .. }
        ));
        assert!(matches!(
            Building::from_modes(&levels, &[], &UNIFORM),
            Err(BuildingError::Modes { .. })
        ));
    }
}
