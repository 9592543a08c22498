//! The motions of one floor of a building at a place, for users without records.

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};

use crate::resolve::{Overrides, resolve_with};
use crate::result::GroundMotion;
use crate::run::{floors_under, ground_motions};
use crate::spectrum::SpectrumMotion;
use crate::study::{Ground, Study};

/// A floor of a building at a place. What is left out is as in the built-in study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AtPlace {
    /// Keys of the hazard: `place`, `site`, `return_period_years`.
    pub hazard: Words,
    /// Number of synthetic motions.
    pub count: Option<u16>,
    /// Number of storeys.
    pub storeys: Option<u16>,
    /// Height of a storey \[m\].
    pub storey_height_m: Option<f64>,
    /// Height of the floor over that of the building, 0 to 1.
    pub level_ratio: f64,
    /// Seed of the motions.
    pub seed: Option<u64>,
}

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
    pub warnings: Vec<String>,
}

/// The motions of a floor.
///
/// # Errors
/// Everything that is wrong with the keys, and what `go_on` returns.
pub fn motions_at(
    place: &AtPlace,
    last: &LastGround,
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<FloorMotions, Problems> {
    if !(0.0..=1.0).contains(&place.level_ratio) {
        let message = format!(
            "`level_ratio`: {} is not a share of the height",
            place.level_ratio
        );
        return Err(Problem::value(
            message,
            "give 0 for the ground, 1 for the roof, or a value between them",
        )
        .into());
    }
    let overrides = Overrides {
        seed: place.seed,
        hazard: place.hazard.clone(),
        ..Overrides::default()
    };
    let study = resolve_with(&text(place), None, Path::new(""), &overrides)?;
    let ground = last.of(&study.ground, &go_on)?;
    let mut motions = Vec::with_capacity(ground.len());
    for one in ground.iter() {
        go_on()?;
        let floors = match &study.building {
            Some(building) => floors_under(one, building, &[place.level_ratio])?,
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
        processing: processing(&study, place),
        warnings: study.warnings,
    })
}

/// The tables of a study, as far as they are given.
fn text(place: &AtPlace) -> String {
    let count = place.count.map(|count| format!("count = {count}\n"));
    let storeys = place
        .storeys
        .map(|storeys| format!("storeys = {storeys}\n"));
    let height = place
        .storey_height_m
        .map(|height_m| format!("storey_height = \"{height_m} m\"\n"));
    format!(
        "[ground]\n{}[building]\n{}{}levels = [{{ name = \"floor\", level_ratio = {:?} }}]\n",
        count.unwrap_or_default(),
        storeys.unwrap_or_default(),
        height.unwrap_or_default(),
        place.level_ratio
    )
}

fn processing(study: &Study, place: &AtPlace) -> Vec<String> {
    let ground = study
        .ground
        .code_spectrum()
        .map(|target| format!("matched to {}", target.one_line()));
    let floor = study.building.as_ref().map(|building| {
        format!(
            "carried to {} of the height of {} storeys",
            place.level_ratio, building.storeys
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
    use super::*;
    use crate::resolve::resolve;
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
        let hazard =
            Words::from_iter([("place", "Melbourne".to_owned()), ("site", "De".to_owned())]);
        let last = LastGround::default();
        let place = AtPlace {
            hazard,
            count: Some(2),
            level_ratio: 1.0,
            ..AtPlace::default()
        };
        let made = motions_at(&place, &last, || Ok(())).unwrap();
        assert_eq!(made.motions.len(), roof.floors.len());
        for (made, floor) in made.motions.iter().zip(&roof.floors) {
            assert_eq!(made.horizontal, floor.along, "{}", made.name);
        }
        // Another floor, and back: what is remembered changes nothing.
        let lower = AtPlace {
            level_ratio: 0.5,
            ..place.clone()
        };
        let middle = motions_at(&lower, &last, || Ok(())).unwrap();
        assert!(middle.motions[0].horizontal.peak_m_s2() < made.motions[0].horizontal.peak_m_s2());
        assert_eq!(
            motions_at(&place, &last, || Ok(())).unwrap().motions,
            made.motions
        );
    }

    #[test]
    fn what_is_wrong_is_said() {
        let hazard = Words::from_iter([("place", "Atlantis".to_owned())]);
        let problems = motions_at(
            &AtPlace {
                hazard,
                ..AtPlace::default()
            },
            &LastGround::default(),
            || Ok(()),
        );
        assert!(problems.unwrap_err().to_string().contains("Atlantis"));
        let outside = AtPlace {
            level_ratio: 1.5,
            ..AtPlace::default()
        };
        let problems = motions_at(&outside, &LastGround::default(), || Ok(())).unwrap_err();
        assert!(
            problems.to_string().contains("`level_ratio`: 1.5"),
            "{problems}"
        );
    }
}
