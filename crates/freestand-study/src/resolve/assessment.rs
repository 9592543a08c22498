//! Resolves `[assessment]`.

use std::path::PathBuf;

use super::{Resolver, or};
use crate::options::AssessmentOptions;
use crate::study::assessment::{Accepted, Settings, Spread};
use freestand_input::toml_reader::Written;

/// Largest number of draws of the uncertain values for each motion.
const MAX_DRAWS: u64 = 10_000;

impl Resolver<'_> {
    pub(super) fn assessment(&mut self, written: &AssessmentOptions) -> Settings {
        let defaults = Settings::default();
        let accepted_ratio = self.probability("accepted", &written.accepted, defaults.accepted.other_ratio);
        let Spread { restitution, stiffness, mass, geometry, model } = defaults.spread;
        let path = |written: &Option<Written<String>>| -> Option<PathBuf> {
            written.as_ref().map(|written| self.base_dir.join(&written.value))
        };
        let [inventory, library, cushion_library] =
            [&written.inventory, &written.library, &written.cushion_library].map(path);
        let settings = Settings {
            inventory,
            sheet: written.sheet.as_ref().map(|sheet| sheet.value.clone()),
            library,
            cushion_library,
            accepted: Accepted {
                other_ratio: accepted_ratio,
                life_safety_ratio: self.probability(
                    "accepted_life_safety",
                    &written.accepted_life_safety,
                    accepted_ratio,
                ),
                property_ratio: self.probability("accepted_property", &written.accepted_property, accepted_ratio),
                function_ratio: self.probability("accepted_function", &written.accepted_function, accepted_ratio),
            },
            seed: or(&written.seed, defaults.seed),
            draws: self.draws("draws", &written.draws, defaults.draws),
            most_draws: self.draws("most_draws", &written.most_draws, defaults.most_draws),
            spread: Spread {
                restitution: self.spread("restitution_spread", &written.restitution_spread, restitution),
                stiffness: self.spread("stiffness_spread", &written.stiffness_spread, stiffness),
                mass: self.spread("mass_spread", &written.mass_spread, mass),
                geometry: self.spread("geometry_spread", &written.geometry_spread, geometry),
                model: self.spread("model_spread", &written.model_spread, model),
            },
            friction_ratio: self.friction(written, defaults.friction_ratio),
            pad_strain_ratio: self.pad_strain(&written.pad_strain, defaults.pad_strain_ratio),
            pad_damping_ratio: self.spread("pad_damping", &written.pad_damping, defaults.pad_damping_ratio),
            compliant: or(&written.compliant, defaults.compliant),
            screen: or(&written.screen, defaults.screen),
            pages: usize::try_from(or(&written.pages, defaults.pages as u64)).unwrap_or(usize::MAX),
        };
        if settings.most_draws < settings.draws {
            let line = written.most_draws.as_ref().or(written.draws.as_ref()).map(|one| one.line);
            let message = format!("most_draws = {} is less than draws = {}", settings.most_draws, settings.draws);
            self.note(line, message, "give both: draws are doubled until they reach most_draws");
        }
        settings
    }

    fn probability(&mut self, key: &str, written: &Option<Written<f64>>, default: f64) -> f64 {
        self.require(written, |value| value > 0.0 && value < 1.0, key, "a probability between 0 and 1");
        or(written, default)
    }

    /// With a spread above 1 a value is practically unknown, and its draws leave the range of the
    /// models.
    fn spread(&mut self, key: &str, written: &Option<Written<f64>>, default: f64) -> f64 {
        self.require(written, |value| (0.0..=1.0).contains(&value), key, "a number from 0 to 1");
        or(written, default)
    }

    fn draws(&mut self, key: &str, written: &Option<Written<u64>>, default: u32) -> u32 {
        let expected = format!("a whole number from 1 to {MAX_DRAWS}");
        self.require(written, |count| (1..=MAX_DRAWS).contains(&count), key, &expected);
        u32::try_from(or(written, u64::from(default))).unwrap_or(default)
    }

    fn friction(&mut self, written: &AssessmentOptions, default: (f64, f64)) -> (f64, f64) {
        for (key, one) in [("friction_low", &written.friction_low), ("friction_high", &written.friction_high)] {
            self.require(one, |value| (0.0..=10.0).contains(&value), key, "a coefficient from 0 to 10");
        }
        let range = (or(&written.friction_low, default.0), or(&written.friction_high, default.1));
        if range.0 > range.1 {
            let line = written.friction_low.as_ref().or(written.friction_high.as_ref()).map(|one| one.line);
            let message = format!("friction_low = {} is above friction_high = {}", range.0, range.1);
            self.note(line, message, "give both: one that is left out has its default value");
        }
        range
    }

    fn pad_strain(&mut self, written: &Option<Written<f64>>, default: f64) -> f64 {
        let expected = "a share of the pad's thickness, above 0 and below 1";
        self.require(written, |value| value > 0.0 && value < 1.0, "pad_strain", expected);
        or(written, default)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolve::{Overrides, builtin, resolve};

    /// What the built-in study says in words is what a study has that says nothing.
    #[test]
    fn the_built_in_study_states_the_defaults() {
        assert_eq!(builtin(&Overrides::default()).unwrap().assessment, Settings::default());
        assert_eq!(resolve("", None, "".as_ref()).unwrap().assessment, Settings::default());
    }

    #[test]
    fn what_is_accepted_counts_for_every_class_that_is_not_named() {
        let text = "[assessment]\naccepted = \"5 %\"\naccepted_life_safety = 0.01\ninventory = \"a/b.csv\"\n";
        let settings = resolve(text, None, "here".as_ref()).unwrap().assessment;
        let Accepted { other_ratio, life_safety_ratio, property_ratio, function_ratio } = settings.accepted;
        assert_eq!((other_ratio, life_safety_ratio, property_ratio, function_ratio), (0.05, 0.01, 0.05, 0.05));
        assert_eq!(settings.inventory, Some("here/a/b.csv".into()));
    }

    #[test]
    fn everything_that_is_wrong_is_said_with_its_line() {
        let text = "[assessment]\naccepted = 1.5\ndraws = 0\nmost_draws = 4\nmass_spread = -1\nfriction_low = \
                    0.9\npad_strain = 2\nscren = true\n";
        let problems = resolve(text, None, "".as_ref()).unwrap_err().problems;
        let lines: Vec<Option<usize>> = problems.iter().map(|problem| problem.line).collect();
        assert_eq!(lines, [2, 3, 5, 6, 7, 8].map(Some), "{problems:?}");
    }
}
