//! The motions of one floor of a building at a place, for users without records.

use std::sync::{Arc, Mutex, PoisonError};

use freestand_input::problem::{Problem, Problems};

use crate::resolve::{Values, of_values};
use crate::result::GroundMotion;
use crate::run::{floors_under, ground_motions};
use crate::spectrum::SpectrumMotion;
use crate::study::{Ground, Study, StudyDoubt};

/// The ground motions of the last place: a user who moves a slider asks for another floor above the
/// same ground, and to match ten motions to a spectrum takes longer than to carry them to a floor.
#[derive(Debug, Default)]
pub struct LastGround(Mutex<Option<Kept>>);

/// A ground and its motions.
type Kept = (Ground, Arc<Vec<GroundMotion>>);

/// What shakes the floor: synthetic motions of the ground, matched to the spectrum of the code and
/// carried up the building, as in [`run`](crate::run::run) of the study with the same keys.
#[derive(Debug, Clone)]
pub struct FloorMotions {
    /// The motions of the floor.
    pub motions: Vec<SpectrumMotion>,
    /// What was done to make them.
    pub processing: Vec<String>,
    /// What the code and the building leave open.
    pub doubts: Vec<StudyDoubt>,
}

/// The motions of the floor at a share of the height of a building, 0 to 1.
///
/// # Errors
/// Everything that is wrong with the values, and what `go_on` returns.
pub fn motions_at(
    values: &Values,
    level_ratio: f64,
    last: &LastGround,
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<FloorMotions, Problems> {
    if !(0.0..=1.0).contains(&level_ratio) {
        let message = format!("`level_ratio`: {level_ratio} is not a share of the height");
        return Err(Problem::value(
            message,
            "give 0 for the ground, 1 for the roof, or a value between them",
        )
        .into());
    }
    let study = of_values(values)?;
    let ground = last.of(&study.ground, &go_on)?;
    let mut motions = Vec::with_capacity(ground.len());
    for one in ground.iter() {
        go_on()?;
        let floors = match &study.building {
            Some(building) => floors_under(one, building, &[level_ratio])?,
            None => vec![one.motion.clone()],
        };
        let named = |motion| SpectrumMotion {
            name: one.name.clone(),
            horizontal: motion,
            vertical: None,
        };
        motions.extend(floors.into_iter().map(|floor| named(floor.along)));
    }
    Ok(FloorMotions {
        motions,
        processing: processing(&study, level_ratio),
        doubts: study.and_assumed_building(),
    })
}

fn processing(study: &Study, level_ratio: f64) -> Vec<String> {
    let ground = study
        .ground
        .code_spectrum()
        .map(|target| format!("matched to {}", target.one_line()));
    let floor = study.building.as_ref().map(|building| {
        format!(
            "carried to {level_ratio} of the height of {} storeys",
            building.storeys
        )
    });
    ground.into_iter().chain(floor).collect()
}

impl LastGround {
    /// The motions of a ground, made only if they are not those of the last one.
    fn of(
        &self,
        ground: &Ground,
        go_on: &(impl Fn() -> Result<(), Problems> + Sync),
    ) -> Result<Arc<Vec<GroundMotion>>, Problems> {
        // The lock is not held while motions are made: whoever asks for another ground need not wait.
        let found = self
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        if let Some((_, motions)) = found.filter(|(of, _)| of == ground) {
            return Ok(motions);
        }
        let motions = Arc::new(ground_motions(ground, go_on)?);
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) =
            Some((ground.clone(), Arc::clone(&motions)));
        Ok(motions)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use freestand_input::keys::Words;

    use super::*;
    use crate::resolve::{Hazard, resolve};
    use crate::run::{no_progress, run};

    /// A study that says nothing else asks for the roof too: its floor motions are the same to the last bit.
    #[test]
    fn the_motions_are_those_of_the_study_with_the_same_keys() {
        let mut study = resolve("[ground]\ncount = 2\n", None, Path::new("")).unwrap();
        study.objects.blocks.truncate(1);
        let result = run(&study, &no_progress).unwrap();
        let roof = result
            .levels
            .iter()
            .find(|level| level.level.level_ratio == Some(1.0))
            .unwrap();
        let last = LastGround::default();
        let values = Values {
            hazard: Hazard::Keys(Words::from_iter([("place", "Melbourne"), ("site", "De")])),
            count: Some(2),
            ..Values::default()
        };
        let at = |level_ratio| motions_at(&values, level_ratio, &last, || Ok(())).unwrap();
        let made = at(1.0);
        assert_eq!(made.motions.len(), roof.floors.len());
        for (made, floor) in made.motions.iter().zip(&roof.floors) {
            assert_eq!(made.horizontal, floor.along, "{}", made.name);
        }
        // Another floor, and back: what is remembered changes nothing.
        let middle = at(0.5);
        assert!(middle.motions[0].horizontal.peak_m_s2() < made.motions[0].horizontal.peak_m_s2());
        assert_eq!(at(1.0).motions, made.motions);
    }

    #[test]
    fn what_is_wrong_is_said() {
        let said = |values: Values, level_ratio| {
            let found = motions_at(&values, level_ratio, &LastGround::default(), || Ok(()));
            found.unwrap_err().to_string()
        };
        let elsewhere = Values {
            hazard: Hazard::Keys(Words::from_iter([("place", "Atlantis")])),
            ..Values::default()
        };
        assert!(said(elsewhere, 0.0).contains("Atlantis"));
        assert!(said(Values::default(), 1.5).contains("`level_ratio`: 1.5"));
        // A value that nobody wrote has no line.
        let tall = Values {
            storey_height_m: Some(40.0),
            ..Values::default()
        };
        assert_eq!(
            said(tall, 1.0),
            "storey_height must be a height between 1 and 30 m, not \"40 m\" (give a length such as \"3.2 m\", from \
             floor to floor)"
        );
    }
}
