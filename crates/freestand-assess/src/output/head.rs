//! The head of every output: the inputs in words, and all assumptions.

use crate::inventory::Inventory;
use freestand_input::words::{counted, number, percent_significant};
use freestand_study::study::assessment::Settings;
use freestand_study::study::{Ground, Study};

/// What all outputs of an assessment share.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Head {
    /// Name and value in words: the inventory and its fingerprint, the study, the hazard, the
    /// building, the motions, seed, version.
    pub facts: Vec<(String, String)>,
    /// What was assumed, one sentence each, with its source.
    pub assumptions: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Whether the floors are those of a building that stays elastic, and not given.
    pub is_elastic: bool,
    /// Rows of the inventory; more than there are results where the run was interrupted.
    pub total: usize,
}

/// The head of an assessment of `inventory` on the floors of `study`.
pub(crate) fn head(study: &Study, inventory: &Inventory) -> Head {
    let mut facts: Vec<(String, String)> = Vec::new();
    let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
    let file = inventory.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let sheet = inventory.sheet.as_ref().map_or_else(String::new, |sheet| format!(", sheet {sheet}"));
    fact("Inventory", format!("{file}{sheet}, {}", counted(inventory.items.len(), "object")));
    fact("SHA-256 of the inventory", inventory.sha256.clone());
    let source = study.source.as_deref().and_then(|path| path.file_name());
    fact("Study", source.map_or_else(|| "the built-in study".to_owned(), |name| name.to_string_lossy().into_owned()));
    fact("Motions", motions(study));
    if let Some(building) = &study.building {
        let height = number(building.height_m, 4);
        let period = number(building.along.period_s(), 3);
        fact(
            "Building",
            format!("{}, {height} m, T₁ = {period} s: {}", counted(building.storeys, "storey"), building.period_note),
        );
    }
    if let Some(seed) = study.ground.seed() {
        fact("Seed of the motions", seed.to_string());
    }
    fact("Seed of the draws", study.assessment.seed.to_string());
    fact("Version", format!("freestand {}", env!("CARGO_PKG_VERSION")));
    Head {
        facts,
        assumptions: assumptions(study),
        warnings: study.warnings.iter().chain(&inventory.warnings).cloned().collect(),
        is_elastic: study.building.is_some(),
        total: inventory.items.len(),
    }
}

fn motions(study: &Study) -> String {
    let of = match &study.ground {
        Ground::Synthetic(synthetic) => {
            return format!("a synthetic motion in every world, for {}", synthetic.target.title_words());
        }
        Ground::Simulated(simulated) => simulated.title_words(),
        Ground::Recorded(_) => match (study.ground.suite(), study.ground.target()) {
            (Some(suite), _) => format!("records selected and scaled for {}", suite.target.title_words()),
            (None, Some(target)) => format!("records matched to {}", target.title_words()),
            (None, None) => "records".to_owned(),
        },
        Ground::OnFloors => "given floor motions".to_owned(),
    };
    let count = study.ground.names(&study.levels).len();
    format!("{}, used by the worlds in turn: {of}", counted(count, "motion"))
}

fn assumptions(study: &Study) -> Vec<String> {
    let Settings {
        accepted,
        spread,
        friction_ratio,
        pad_strain_ratio,
        pad_damping_ratio,
        compliant_factor,
        worlds,
        ..
    } = &study.assessment;
    let percent = |share: f64| percent_significant(share, 3);
    let ratings = |[high, medium, low]: [f64; 3]| format!("{}, {}, {}", percent(high), percent(medium), percent(low));
    let looks = worlds.looks;
    vec![
        "Every probability is given the earthquake of this study; it is not an annual probability.".to_owned(),
        format!(
            "Accepted probability of overturning or damage, rated high, medium, low: life safety {}; function {}; \
             property {}. Without a rating {}, or {} where an object falls with less than 100 J. No code prescribes \
             it: the owner chooses it.",
            ratings(accepted.life_safety_ratio),
            ratings(accepted.function_ratio),
            ratings(accepted.property_ratio),
            percent(accepted.other_ratio),
            percent(accepted.small_item_ratio)
        ),
        format!(
            "Worlds: {} at first, doubled up to {}, until the {} interval of Clopper and Pearson leaves the accepted \
             probability; where it does not, the call is close and the cautious verdict is shown. Motions that worlds \
             use in turn are clusters.",
            looks.first(),
            looks.most(),
            percent(looks.confidence())
        ),
        format!(
            "Standard deviations of logarithms from world to world: spectrum at one period {}, intensity {}, period of \
             the building {}, its damping {}; stiffness of pads {} (a library entry has its own), mass {}, sides and \
             heights {}, Eq. (5) {} (Table I of Al Abadi et al., five tests of one cabinet), the compliant base {} \
             about a factor of {}. Restitution: {} of the logit of the energy that an impact takes.",
            worlds.spectral_spread,
            worlds.intensity_spread,
            worlds.period_spread,
            worlds.damping_spread,
            spread.stiffness,
            spread.mass,
            spread.geometry,
            spread.model,
            spread.compliant,
            compliant_factor,
            spread.restitution
        ),
        format!(
            "{} Not in the worlds: the soil, damage to the building (it stays elastic), sliding while rocking, walls \
             and neighbours, rotation about a vertical axis.",
            if study.ground.has_vertical() {
                format!(
                    "Vertical motion: {}; floors above the ground have {} times that of the ground.",
                    study.ground.vertical_words(),
                    study.vertical_amplification_ratio
                )
            } else {
                "The motions are horizontal only.".to_owned()
            }
        ),
        format!(
            "Coefficient of friction where the inventory does not give it: {} to {}. Sliding is not computed; where it \
             occurs, rocking and its shock are smaller.",
            friction_ratio.0, friction_ratio.1
        ),
        format!(
            "A softer pad may be compressed by {} of its thickness (20 mm where it is not given). A pad of which only \
             the stiffness is known has {} to {} of critical damping.",
            percent(*pad_strain_ratio),
            percent(pad_damping_ratio.0),
            percent(pad_damping_ratio.1)
        ),
        "Every object is free-standing on a level, rigid floor and moves in one plane at a time. The objects do not \
         affect the motion of the floor."
            .to_owned(),
    ]
}
