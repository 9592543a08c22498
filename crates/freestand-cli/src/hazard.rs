//! Flags that put another hazard in place of that of a study.

use clap::Args;
use freestand_input::keys::Words;

use crate::keys::{Key, KeySet, Keys, key};

/// Flags that put another hazard in place of that of a study.
#[derive(Debug, Args)]
pub(crate) struct HazardArgs {
    #[command(flatten)]
    keys: Keys<HazardKeys>,
}

#[derive(Debug, Clone)]
struct HazardKeys;

impl KeySet for HazardKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[(
        "Hazard, in place of that of the study",
        &[
            key("place", "NAME", "Place, with its code and hazard; see freestand place list"),
            key("site", "CLASS", "Site class of the code"),
            key("return_period_years", "YEARS", "Return period in years, of AS 1170.4 and NZS 1170.5"),
        ],
    )];
}

impl HazardArgs {
    /// The keys of `[ground]` that were given.
    pub(crate) fn words(&self) -> Words {
        self.keys.words.clone()
    }
}
