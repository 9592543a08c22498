//! The head of every output: the inputs in words, and all assumptions.

use std::ffi::OsStr;
use std::path::Path;

use crate::doubts::{assumed_at, period_from, study_doubt, two_spectra};
use crate::ground::{earthquake, simulated_earthquakes, vertical_motion};
use crate::near_fault::near_fault_words;
use freestand_assess::accepted::accepted;
use freestand_assess::assumed::{self, Open};
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{counted, number, percent_significant};
use freestand_inventory::{Casters, Inventory, Surroundings, console_lines};
use freestand_study::places::Confidence;
use freestand_study::sliding::DEFAULT_ROLLING_RESISTANCE;
use freestand_study::study::assessment::{Dimensions, Settings, WallUse};
use freestand_study::study::{Ground, Study, TitleBlock, Unstated};
use freestand_study::target::Target;

/// What all outputs of an assessment share.
#[derive(Debug, Clone, PartialEq)]
pub struct Head {
    /// What the reader must know first where no study was given: whose building this is.
    pub no_study: Option<String>,
    /// Building, place, code, site, return period, motions, list: name and value in words.
    pub place: Vec<(String, String)>,
    /// Place and building on one line.
    pub one_line: String,
    /// Name and value in words: the inventory and its fingerprint, the study, the hazard, the
    /// building, the motions, seed, version.
    pub facts: Vec<(String, String)>,
    /// What was assumed, in a few lines for the first page.
    pub most_important: Vec<String>,
    /// What was assumed, one sentence each, with its source.
    pub assumptions: Vec<String>,
    /// Columns that are empty for some objects, and for how many.
    pub assumed_columns: Vec<(&'static str, usize)>,
    /// What is wrong or doubtful in the list, a line for each kind and column.
    pub problems: Vec<String>,
    /// Other warnings.
    pub warnings: Vec<String>,
    /// Whether the floors are those of a building that stays elastic, and not given.
    pub is_elastic: bool,
    /// Who signs for the report.
    pub title: TitleBlock,
    /// The place, where its hazard is quoted from memory.
    pub recalled_place: Option<String>,
    /// Whether the cards of objects are printed.
    pub cards: bool,
    /// Confidence of the intervals in brackets.
    pub confidence: f64,
    /// Rows of the inventory; more than there are results where the run was interrupted.
    pub total: usize,
}

/// How the names of files begin through which a study in memory reaches this program; the rest is random.
/// The Python package uses it (`freestand/dask.py`).
const IN_MEMORY: &str = ".freestand-study-";

/// The name of the file of the study, or where it comes from.
fn study_name(study: &Study) -> String {
    let file = study
        .source
        .as_deref()
        .and_then(Path::file_name)
        .map(OsStr::to_string_lossy);
    match file {
        Some(name) if !name.starts_with(IN_MEMORY) => name.into_owned(),
        None if study.is_builtin => "the built-in study".to_owned(),
        _ => "given as text".to_owned(),
    }
}

/// The head of an assessment of `inventory` on the floors of `study`.
pub fn head(study: &Study, inventory: &Inventory) -> Head {
    let mut facts: Vec<(String, String)> = Vec::new();
    let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
    fact("SHA-256 of the list", inventory.sha256.clone());
    fact("Study", study_name(study));
    if let Some(building) = &study.building {
        let period = number(building.along.period_s(), 3);
        fact(
            "Period of the building",
            format!("T₁ = {period} s: {}", period_from(&building.period_from)),
        );
    }
    if let Some(seed) = study.ground.seed() {
        fact("Seed of the motions", seed.to_string());
    }
    fact("Seed of the draws", study.assessment.seed.to_string());
    fact(
        "Version",
        format!("freestand {}", env!("CARGO_PKG_VERSION")),
    );
    Head {
        no_study: no_study(study),
        place: place(study, inventory),
        one_line: one_line(study),
        facts,
        most_important: most_important(study, inventory),
        assumptions: assumptions(study, inventory),
        assumed_columns: assumed::counted(&inventory.items)
            .into_iter()
            .map(|(open, objects)| (open.column().name(), objects))
            .collect(),
        problems: console_lines(&inventory.findings),
        warnings: study
            .doubts
            .iter()
            .map(study_doubt)
            .chain(few_worlds(study, inventory))
            .chain(inventory.warnings.iter().cloned())
            .collect(),
        is_elastic: study.building.is_some(),
        title: study.outputs.title.clone(),
        recalled_place: recalled_place(study),
        cards: study.outputs.cards,
        confidence: study.assessment.worlds.looks.confidence(),
        total: inventory.items.len(),
    }
}

/// The objects that the largest number of worlds can never show to stay, however rarely they fall.
fn few_worlds(study: &Study, inventory: &Inventory) -> Option<String> {
    let looks = study.assessment.worlds.looks;
    // Motions that worlds use in turn are counted by their number, object by object.
    if !matches!(study.ground, Ground::Synthetic(_)) {
        return None;
    }
    let needed = inventory.items.iter().filter_map(|item| {
        let (accepted_ratio, _) = accepted(item, &study.assessment);
        looks
            .fewest_worlds(accepted_ratio)
            .ok()
            .filter(|needed| *needed > looks.most())
    });
    let (objects, most) = needed.fold((0, 0), |(objects, most), needed| {
        (objects + 1, needed.max(most))
    });
    (objects > 0).then(|| {
        format!(
            "{} worlds at most cannot show that an object stays, even if it never falls: {} of {} cannot be left as they \
             are; give most = {most} or more in [worlds] of the study",
            looks.most(),
            counted(objects, "object"),
            inventory.items.len()
        )
    })
}

fn recalled_place(study: &Study) -> Option<String> {
    let place = study.ground.code_spectrum()?.approximate_place()?;
    Some(format!("hazard of {}", place.short_name()))
}

/// The name of the place whose hazard was used.
fn place_name(study: &Study) -> Option<String> {
    study.ground.code_spectrum()?.place_name()
}

/// Whose building and whose hazard this is, where nobody stated them.
fn no_study(study: &Study) -> Option<String> {
    let unstated = study.unstated(1.0)?;
    let storeys = study
        .building
        .as_ref()
        .map_or_else(String::new, |building| {
            format!("{}-storey ", building.storeys)
        });
    let name = study.building_name.as_deref().unwrap_or("building");
    let place = place_name(study).map_or_else(String::new, |place| format!(" in {place}"));
    let whose = match unstated {
        Unstated::Place => format!(
            "the hazard is that{}, not yours",
            place.replace(" in ", " of ")
        ),
        Unstated::Building | Unstated::Both => {
            format!("this is a {storeys}{name}{place}, not your building")
        }
    };
    Some(format!(
        "Nobody stated {}: {whose}. Give {}.",
        unstated.words(),
        unstated.keys()
    ))
}

/// `Main block, 8 storeys, 32 m high`.
pub fn building(study: &Study) -> String {
    let size = study.building.as_ref().map_or_else(
        || "the study gives the motions of the floors".to_owned(),
        |building| {
            format!(
                "{}, {} m high",
                counted(building.storeys, "storey"),
                number(building.height_m, 4)
            )
        },
    );
    study
        .building_name
        .as_ref()
        .map_or_else(|| size.clone(), |name| format!("{name}, {size}"))
}

/// `Melbourne (AS 1170.4, site class Ce, 500 years)`; `None` where the ground motions have no spectrum
/// of a code.
pub fn hazard(study: &Study) -> Option<String> {
    let target = study.ground.code_spectrum()?;
    Some(match target.place_name() {
        Some(place) => format!("{place} ({})", hazard_words(target).join(", ")),
        None => target.one_line(),
    })
}

fn one_line(study: &Study) -> String {
    let hazard = hazard(study).map_or_else(String::new, |hazard| format!("{hazard}; "));
    format!("{hazard}{}", building(study))
}

/// Code, site and return period, as far as the code has them.
fn hazard_words(target: &Target) -> Vec<String> {
    let years = target.return_period_years();
    let site = target.spectrum.site_name().map(|_| target.site_words());
    let code = Some(target.spectrum.name().to_owned());
    [code, site, years.map(|years| format!("{years} years"))]
        .into_iter()
        .flatten()
        .collect()
}

fn place(study: &Study, inventory: &Inventory) -> Vec<(String, String)> {
    let mut facts: Vec<(String, String)> = Vec::new();
    let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
    fact("Building", building(study));
    if let Some(target) = study.ground.code_spectrum() {
        let approximate = target
            .place
            .as_ref()
            .is_some_and(|place| place.confidence == Confidence::Approximate);
        let confirm = if approximate {
            " (approximate hazard: confirm it)"
        } else {
            ""
        };
        fact(
            "Place",
            target
                .place_name()
                .map_or_else(|| "not given".to_owned(), |name| format!("{name}{confirm}")),
        );
        if let Some(place) = &target.place {
            fact("Hazard from", place.provenance());
        }
        fact("Code", target.one_line());
        fact("Site", target.site_words());
        let years = target.return_period_years();
        let of_code = || "that of the hazard values of the code".to_owned();
        fact(
            "Return period",
            years.map_or_else(of_code, |years| format!("{years} years")),
        );
    }
    fact("Motions", motions(study));
    let file = inventory
        .path
        .file_name()
        .map(|name| name.to_string_lossy().into_owned())
        .unwrap_or_default();
    let sheet = inventory
        .sheet
        .as_ref()
        .map_or_else(String::new, |sheet| format!(", sheet {sheet}"));
    fact(
        "List",
        format!(
            "{file}{sheet}, {}",
            counted(inventory.items.len(), "object")
        ),
    );
    facts
}

fn motions(study: &Study) -> String {
    let of = match &study.ground {
        Ground::Synthetic(synthetic) => {
            return format!(
                "synthetic, a new one in every world: {}",
                earthquake(&synthetic.target)
            );
        }
        Ground::Simulated(simulated) => simulated_earthquakes(simulated),
        Ground::Recorded(_) => match (study.ground.suite(), study.ground.target()) {
            (Some(suite), _) => format!(
                "records selected and scaled for {}",
                earthquake(&suite.target)
            ),
            (None, Some(target)) => format!("records matched to {}", earthquake(target)),
            (None, None) => "records".to_owned(),
        },
        Ground::OnFloors => "given floor motions".to_owned(),
    };
    let count = study.ground.names(&study.levels).len();
    format!(
        "{}, used by the worlds in turn: {of}",
        counted(count, "motion")
    )
}

/// `2, 5, 20 %`: a probability for each rating.
fn ratings_words(ratios: [f64; 3]) -> String {
    let [high, medium, low] = ratios.map(|share| number(100.0 * share, 3));
    format!("{high}, {medium}, {low} %")
}

/// How many objects are assessed as free-standing, and what that means.
fn free_standing(study: &Study, inventory: &Inventory) -> String {
    let all = inventory.items.len();
    let is_free =
        |around: &Surroundings| !around.has_wall() && around.casters != Some(Casters::Free);
    let without = inventory
        .items
        .iter()
        .filter(|item| is_free(&item.surroundings))
        .count();
    match study.assessment.walls {
        WallUse::Ignore => {
            "Every object is assessed as free-standing: the study ignores the walls and neighbours of the list."
                .to_owned()
        }
        WallUse::AsListed if without == 0 => "No object is assessed as free-standing.".to_owned(),
        WallUse::AsListed => format!(
            "{without} of {} have no wall_gap and no neighbour_gap: they are assessed as free-standing. At a wall an object may fall much \
             less often or, on strong floors, no less.",
            counted(all, "object")
        ),
    }
}

/// In how many dimensions objects move.
fn planes(study: &Study) -> &'static str {
    match study.assessment.dimensions {
        // The largest difference in an audit of blocks with a square plan.
        Dimensions::Planar => {
            "Every object moves in one plane at a time: a second horizontal component adds up to 0.33 to the \
             probability of falling."
        }
        Dimensions::Three => {
            "Objects with mass, pads and width move in three dimensions, under both horizontal components at once, on \
             pads that slip at the friction that is drawn; every other object moves in one plane at a time, and its page \
             says why."
        }
    }
}

/// How many objects roll, and what that means; nothing where none does.
fn rolling(inventory: &Inventory) -> Option<String> {
    let count = inventory
        .items
        .iter()
        .filter(|item| item.surroundings.casters == Some(Casters::Free))
        .count();
    (count > 0).then(|| {
        format!(
            "On free casters: {}. What rolls does not rock: its verdict is its travel, and the speed at its stop where the \
             list gives a clearance. The resistance of casters is {DEFAULT_ROLLING_RESISTANCE} of the weight where the \
             list does not give it.",
            counted(count, "object")
        )
    })
}

fn most_important(study: &Study, inventory: &Inventory) -> Vec<String> {
    let Settings { accepted, .. } = &study.assessment;
    let building = match &study.building {
        Some(building) => format!(
            "The building stays elastic; its fundamental period is {} s ({}).",
            number(building.along.period_s(), 3),
            period_from(&building.period_from)
        ),
        None => "The floors move as given.".to_owned(),
    };
    vec![
        "Probabilities are those in the earthquake above, not per year.".to_owned(),
        format!(
            "Accepted probabilities, for a rating of high, medium, low: life safety {}; function {}; property {}; \
             unrated {}, small and unrated {}. They are the owner's choice: no code gives them.",
            ratings_words(accepted.life_safety_ratio),
            ratings_words(accepted.function_ratio),
            ratings_words(accepted.property_ratio),
            percent_significant(accepted.other_ratio, 3),
            percent_significant(accepted.small_item_ratio, 3)
        ),
        building,
        format!(
            "{} {} Sliding is calculated where the list gives the friction. The floor is level.{}",
            free_standing(study, inventory),
            planes(study),
            if study.ground.has_vertical() { "" } else { " Vertical shaking is not calculated." }
        ),
        "The forces follow the clause that each page names. An engineer has to check them and to design the anchors and \
         what they are fixed to."
            .to_owned(),
    ]
}

/// What neither the study nor the list says, in sentences.
pub fn silent(study: &Study, inventory: &Inventory) -> Vec<String> {
    nobody_stated(study)
        .into_iter()
        .chain(list_is_silent(inventory))
        .collect()
}

/// The rule of the order in words; every output that shows the list prints it.
pub const RULE: &str = "Order of the list: first what to restrain, then what to soften, what to lock, what has no \
    verdict, and what to leave. Within each: life safety (high first), probability of falling over, probability of exceeding the \
    tolerance, property and function (high first), quantity (largest first), row of the list. An unrated object comes \
    after one rated low, and a probability that is not known counts as 0.";

/// What nobody stated of the place and the building.
fn nobody_stated(study: &Study) -> Option<String> {
    let all: Vec<String> = assumed_at(study, 1.0, UnitSystem::Si).collect();
    (!all.is_empty()).then(|| format!("Assumed, because nobody stated it: {}.", all.join("; ")))
}

/// The columns that are empty for some objects, and what is then assumed.
fn list_is_silent(inventory: &Inventory) -> Option<String> {
    let all = assumed::counted(&inventory.items);
    let of = |(open, objects): (Open, usize)| {
        format!(
            "{} ({objects}): {}",
            open.column().name(),
            in_place_of(open)
        )
    };
    let said: Vec<String> = all.into_iter().map(of).collect();
    (!said.is_empty()).then(|| {
        format!(
            "Assumed, because the list does not say it, with the number of objects of {}: {}.",
            inventory.items.len(),
            said.join("; ")
        )
    })
}

/// What is assumed where a column is empty.
fn in_place_of(open: Open) -> &'static str {
    match open {
        Open::Width => "it rocks about one axis only",
        Open::CgHeight => "half the height",
        Open::BaseThickness => "it stands on its full thickness",
        Open::Mass => "no shock, no pads and no force is calculated",
        Open::Stiffness => "a rigid floor",
        Open::Tolerance => "only falling is asked",
        Open::Restitution => "Housner's, drawn about it",
        Open::Friction => "enough for rocking",
        Open::WallGap => "nothing within its reach",
        Open::Casters => "none",
        Open::RollingResistance => "that of the default casters",
    }
}

fn assumptions(study: &Study, inventory: &Inventory) -> Vec<String> {
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
    let looks = worlds.looks;
    let mut assumed = silent(study, inventory);
    assumed.extend(two_spectra(study).map(|words| format!("Assumed: {words}.")));
    assumed.extend(near_fault_words(study).map(|words| format!("Assumed: {words}.")));
    assumed.extend([
        "Every probability is given the earthquake of this study; it is not an annual probability.".to_owned(),
        format!(
            "Accepted probability of overturning or damage, rated high, medium, low: life safety {}; function {}; \
             property {}. Without a rating {}, or {} where an object falls with less than 100 J. No code prescribes \
             it: the owner chooses it.",
            ratings_words(accepted.life_safety_ratio),
            ratings_words(accepted.function_ratio),
            ratings_words(accepted.property_ratio),
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
            "{} Not in the worlds: the soil, damage to the building (it stays elastic), rotation about a \
             vertical axis.",
            if study.ground.has_vertical() {
                format!(
                    "Vertical motion: {}; floors above the ground have {} times that of the ground.",
                    vertical_motion(&study.ground),
                    study.vertical_amplification_ratio
                )
            } else {
                "The motions are horizontal only.".to_owned()
            }
        ),
        format!(
            "Where the inventory gives the friction of an object, it slides instead of rocking if none of it exceeds half \
             its base over the height of its centre of gravity; if rocking needs more in a world, its pads answer with \
             that friction. Elsewhere friction is assumed to be {} to {}: each world draws it for a stack and for an \
             object in three dimensions; for any other it only tells whether it may slide, and no number depends on it.",
            friction_ratio.0, friction_ratio.1
        ),
        format!(
            "A softer pad may be compressed by {} of its thickness (20 mm where it is not given). A pad of which only \
             the stiffness is known has {} to {} of critical damping.",
            percent(*pad_strain_ratio),
            percent(pad_damping_ratio.0),
            percent(pad_damping_ratio.1)
        ),
        format!(
            "{} A wall moves with the floor; its restitution is between 0 and 0.5 where the list does not give it, and \
             the floor moves towards it or away from it with the same chance.",
            free_standing(study, inventory)
        ),
        format!(
            "Every object stands on a level, rigid floor. {} The objects do not affect the motion of the floor.",
            planes(study)
        ),
    ]);
    assumed.extend(rolling(inventory));
    assumed
}
