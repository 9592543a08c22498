//! What stands above every list: the inputs in words, and everything that was assumed.

use super::Head;
use crate::inventory::Inventory;
use freestand_input::words::number;
use freestand_study::study::assessment::Settings;
use freestand_study::study::{Ground, Study};

/// The head of an assessment of `inventory` on the floors of `study`.
pub fn head(study: &Study, inventory: &Inventory) -> Head {
    let mut facts: Vec<(String, String)> = Vec::new();
    let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
    let file = inventory.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let sheet = inventory.sheet.as_ref().map_or_else(String::new, |sheet| format!(", sheet {sheet}"));
    fact("Inventory", format!("{file}{sheet}, {} objects", inventory.items.len()));
    fact("SHA-256 of the inventory", inventory.sha256.clone());
    let source = study.source.as_deref().and_then(|path| path.file_name());
    fact("Study", source.map_or_else(|| "the built-in study".to_owned(), |name| name.to_string_lossy().into_owned()));
    fact("Shaking", shaking(study));
    if let Some(building) = &study.building {
        let height = number(building.height_m, 4);
        let period = number(building.along.period_s(), 3);
        fact(
            "Building",
            format!("{} storeys, {height} m, T₁ = {period} s: {}", building.storeys, building.period_note),
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
        total: inventory.items.len(),
    }
}

fn shaking(study: &Study) -> String {
    let count = study.ground.names(&study.levels).len();
    let directions = match study.directions_deg.len() {
        1 => String::new(),
        n => format!(", objects in {n} directions of which the worst counts"),
    };
    let of = match &study.ground {
        Ground::Synthetic(synthetic) => format!("synthetic motions for {}", synthetic.target.title_words()),
        Ground::Simulated(simulated) => simulated.title_words(),
        Ground::Recorded(_) => match study.ground.target() {
            Some(target) => format!("records matched to {}", target.title_words()),
            None => "records".to_owned(),
        },
        Ground::OnFloors => "given floor motions".to_owned(),
    };
    format!("{count} {}: {of}{directions}", if count == 1 { "motion" } else { "motions" })
}

fn assumptions(study: &Study) -> Vec<String> {
    let Settings { accepted, spread, friction_ratio, draws, most_draws, pad_strain_ratio, pad_damping_ratio, .. } =
        &study.assessment;
    let percent = |share: f64| format!("{} %", number(100.0 * share, 3));
    vec![
        "Every probability is that of this shaking: it is not a probability in a year.".to_owned(),
        format!(
            "Accepted probability of being overturned or damaged: {} (life safety rated high {}, property {}, function {}). No code gives it: it \
             is the owner's to choose.",
            percent(accepted.other_ratio),
            percent(accepted.life_safety_ratio),
            percent(accepted.property_ratio),
            percent(accepted.function_ratio)
        ),
        format!(
            "Drawn lognormally about the values of the inventory, {draws} to {most_draws} times for each motion: restitution (standard deviation of \
             its logarithm {}, nothing above 0.99), stiffness {} (a library entry has its own), mass {}, sides and heights {}, Eq. (5) {}. The \
             last is the coefficient of variation of Table I of Al Abadi et al.: five tests of one cabinet.",
            spread.restitution, spread.stiffness, spread.mass, spread.geometry, spread.model
        ),
        "Intervals of probabilities are those of Korn and Graubard (1998) at 95 %, with the motions as clusters: they say what the number of motions \
         leaves open, not whether the motions are the right ones."
            .to_owned(),
        format!(
            "Friction where the inventory does not say it: {} to {}. No sliding is computed; where it is likely, rocking and its shock are less.",
            friction_ratio.0, friction_ratio.1
        ),
        format!(
            "A softer pad may be pressed to {} of its thickness (20 mm where nobody says it). On the compliant base a pad of which only the \
             stiffness is known is damped by {} of critical; without damping objects bounce far higher.",
            percent(*pad_strain_ratio),
            percent(*pad_damping_ratio)
        ),
        "Objects stand alone, on a level floor that does not give, and shake in one plane at a time; the floor shakes as if they were not there."
            .to_owned(),
    ]
}
