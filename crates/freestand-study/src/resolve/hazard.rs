//! The hazard that flags put in place of that of `[ground]`.

use super::{Overrides, Resolver};
use crate::options::{GroundOptions, TARGET_KEYS};
use crate::places::PlaceHazard;
use crate::rerun::with_hazard;
use crate::target::{Code, code_of, place_of};

impl Resolver<'_> {
    /// Puts the hazard of `overrides` into the options, and returns the text of the study with it.
    pub(super) fn with_hazard(
        &mut self,
        ground: &mut GroundOptions,
        text: &str,
        overrides: &Overrides,
    ) -> String {
        let hazard = &overrides.hazard;
        if hazard.is_empty() {
            return text.to_owned();
        }
        let keys: Vec<&str> = hazard.entries().map(|(key, _)| key).collect();
        let has_records =
            overrides.motions.is_some() || ground.motions.is_some() && ground.match_by.is_none();
        if has_records {
            let message = format!(
                "{} does not apply: the ground motions are records",
                keys.join(", ")
            );
            self.note(
                None,
                message,
                "leave it out, or match the records to a spectrum with match = \"wavelet\"",
            );
            return text.to_owned();
        }
        let stays = |key: &str| match place_of(hazard) {
            // The spectrum of a file is the whole hazard.
            _ if hazard.get("spectrum").is_some() => false,
            None if hazard.get("place").is_some() => false,
            None => !keys.contains(&key),
            Some(_) if keys.contains(&key) => false,
            Some(place) => {
                let code = Code::parse(place.hazard.code());
                let has_factors = matches!(
                    place.hazard,
                    PlaceHazard::As1170_4 { .. } | PlaceHazard::Nzs1170_5 { .. }
                );
                key == "return_period_years" && has_factors
                    || key == "site" && code_of(&ground.target) == code
            }
        };
        let removed: Vec<&'static str> = TARGET_KEYS
            .iter()
            .map(|(key, _)| *key)
            .filter(|key| !stays(key))
            .collect();
        for key in &removed {
            ground.target.remove(key);
        }
        for (key, value) in hazard.entries() {
            ground.target.set(key, value);
        }
        match with_hazard(text, &removed, hazard) {
            Ok(text) => text,
            // Text that is not TOML was noted when it was read.
            Err(_) => text.to_owned(),
        }
    }
}
