//! Variations of a study, and the changes that they ask for.

use freestand::building::Model;
use freestand::code_spectrum::{
    CodeSpectrum, GroundType, SiteClass, SubsoilClass, TbdySite, TsSite,
};

use crate::options::Change;
use crate::resolve::Overrides;
use crate::result::{NotVaried, WhyNotVaried};
use crate::study::{Ground, Study};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{nearest, number};

/// A key to vary, and the values to try; without any, the default ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    key: &'static Key,
    values: Vec<String>,
}

/// A key of a study that can be varied.
#[derive(Debug, PartialEq)]
struct Key {
    table: &'static str,
    name: &'static str,
    /// Keys that state the same quantity in another way: this one replaces them.
    in_place_of: &'static [&'static str],
}

const fn key(table: &'static str, name: &'static str, in_place_of: &'static [&'static str]) -> Key {
    Key {
        table,
        name,
        in_place_of,
    }
}

static KEYS: [Key; 23] = [
    key("building", "damping", &[]),
    key("building", "period", &["frame"]),
    key("building", "shear_flexure", &[]),
    key("building", "modes", &[]),
    key("building", "storeys", &[]),
    key("ground", "seed", &[]),
    key("ground", "site", &[]),
    key("ground", "return_period_years", &[]),
    key("ground", "hazard_factor", &["city", "place"]),
    key("ground", "city", &["hazard_factor", "place"]),
    key("ground", "place", &["hazard_factor", "city"]),
    key("ground", "spectrum_type", &[]),
    key("ground", "ground_acceleration", &["place", "city"]),
    key("ground", "importance_factor", &[]),
    key("ground", "sds", &[]),
    key("ground", "sd1", &[]),
    key("ground", "fault_distance", &[]),
    key("ground", "scale", &[]),
    key("objects", "mass", &[]),
    key(
        "objects",
        "stiffness",
        &[
            "cushion",
            "law",
            "pad_stiffness",
            "pads_per_edge",
            "series_stiffness",
        ],
    ),
    key("objects", "restitution", &["restitution_factor"]),
    key("objects", "restitution_factor", &["restitution"]),
    key("objects", "accuracy", &[]),
];

/// The keys that are varied where none is named.
const DEFAULT_KEYS: [&str; 5] = ["damping", "period", "shear_flexure", "seed", "site"];

/// Damping, period, shear-flexure ratio, seed and site class, each with its default values.
pub fn default_variations() -> Vec<Variation> {
    DEFAULT_KEYS
        .iter()
        .filter_map(|name| find(name))
        .map(|key| Variation {
            key,
            values: Vec::new(),
        })
        .collect()
}

fn find(name: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.name == name)
}

/// A variation as a user writes it: `damping`, or `damping = 2 %, 10 %`.
///
/// # Errors
/// A key that cannot be varied, an empty list of values.
///
/// # Example
/// ```
/// use freestand_study::vary::parse_variation;
/// assert!(parse_variation("shear-flexure = 0, 20").is_ok());
/// assert!(parse_variation("colour").is_err());
/// ```
pub fn parse_variation(text: &str) -> Result<Variation, Problem> {
    let (name, values) = text
        .split_once('=')
        .map_or((text, None), |(name, values)| (name, Some(values)));
    let name = name.trim().to_lowercase().replace(['-', ' '], "_");
    // The name of the table may come before the key.
    let bare = name.rsplit('.').next().unwrap_or(&name);
    let Some(key) = find(bare) else {
        let names = KEYS.each_ref().map(|key| key.name);
        let hint = match nearest(bare, &names) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("keys that can be varied: {}", names.join(", ")),
        };
        let message = format!("\"{}\" cannot be varied", shorten(text));
        return Err(Problem::value(message, hint));
    };
    let values: Vec<String> = match values {
        None => Vec::new(),
        Some(list) => list
            .split(',')
            .map(|value| value.trim().to_owned())
            .collect(),
    };
    if values.iter().any(String::is_empty) {
        let message = format!("\"{}\" has an empty value", shorten(text));
        return Err(Problem::value(
            message,
            "separate values by single commas, as in \"damping = 2 %, 10 %\"",
        ));
    }
    Ok(Variation { key, values })
}

/// The changes that variations ask for, and the variations that do not apply to this study under these
/// overrides.
pub fn changes(
    study: &Study,
    variations: &[Variation],
    overrides: &Overrides,
) -> (Vec<Change>, Vec<NotVaried>) {
    let (mut changes, mut left_out) = (Vec::new(), Vec::new());
    for Variation { key, values } in variations {
        let not_varied = |why| NotVaried { key: key.name, why };
        if let Some(why) = inapplicable(study, key, overrides) {
            left_out.push(not_varied(why));
            continue;
        }
        let is_default = values.is_empty();
        let values = if is_default {
            default_values(study, key.name)
        } else {
            values.clone()
        };
        if values.is_empty() {
            left_out.push(not_varied(WhyNotVaried::NoDefaults));
        }
        changes.extend(values.into_iter().map(|value| Change {
            table: key.table,
            key: key.name,
            value,
            in_place_of: key.in_place_of,
            is_default,
        }));
    }
    (changes, left_out)
}

fn inapplicable(study: &Study, key: &Key, overrides: &Overrides) -> Option<WhyNotVaried> {
    match (key.table, key.name) {
        ("ground", _) if overrides.motions.is_some() => Some(WhyNotVaried::OtherMotions),
        ("ground", name) => inapplicable_ground(&study.ground, name),
        ("building", name) => match &study.building {
            None => Some(WhyNotVaried::MotionsOfFloors),
            Some(input) => match (input.along.model(), name) {
                (_, "damping") => input
                    .tables
                    .iter()
                    .any(|table| !table.is_across && table.states_damping)
                    .then_some(WhyNotVaried::DampingOfTable),
                (Model::Beam { .. }, _) | (Model::Shear { .. }, "modes") => None,
                (Model::Shear { .. } | Model::Table { .. }, _) => {
                    Some(WhyNotVaried::BuildingOfTable)
                }
            },
        },
        _ => None,
    }
}

fn inapplicable_ground(ground: &Ground, name: &str) -> Option<WhyNotVaried> {
    let is_matched = matches!(ground, Ground::Recorded(_)) && ground.target().is_some();
    let is_suite = ground.suite().is_some();
    match (ground, name) {
        (Ground::Synthetic(_), "scale") => Some(WhyNotVaried::Synthetic),
        (Ground::Synthetic(_), _) => None,
        (Ground::Simulated(_), "scale") => Some(WhyNotVaried::Simulated),
        (Ground::Simulated(_), "seed" | "site") => None,
        (Ground::Simulated(simulated), _) if simulated.hazard.is_some() => None,
        (Ground::Simulated(_), _) => Some(WhyNotVaried::OneEarthquake),
        (_, "seed") if is_matched => Some(WhyNotVaried::MatchedSeed),
        (_, "seed") if is_suite => Some(WhyNotVaried::SuiteSeed),
        (_, "scale") if is_suite => Some(WhyNotVaried::SuiteScale),
        (_, _) if is_suite => None,
        (_, "scale") if is_matched => Some(WhyNotVaried::MatchedScale),
        (_, "scale") => None,
        (_, _) if is_matched => None,
        _ => Some(WhyNotVaried::Files),
    }
}

/// Values around the study's own, without that one.
fn default_values(study: &Study, name: &str) -> Vec<String> {
    match (name, &study.building, &study.ground) {
        ("damping", Some(building), _) => {
            let percents = [2.0, 3.0, 5.0, 7.0, 10.0];
            let own = building.along.damping_ratio();
            let differs =
                |percent: &f64| own.is_none_or(|own| (percent - 100.0 * own).abs() > 1e-9);
            percents
                .into_iter()
                .filter(differs)
                .map(|p| format!("{p} %"))
                .collect()
        }
        ("period", Some(building), _) => {
            let period_s = building.along.period_s();
            [0.7, 0.85, 1.2, 1.5, 2.0]
                .iter()
                .map(|factor| format!("{} s", number(factor * period_s, 4)))
                .collect()
        }
        ("shear_flexure", Some(building), _) => {
            let own = building.along.shear_flexure_ratio();
            let ratios = [0.0, 2.0, 5.0, 10.0, 20.0, 30.0];
            ratios
                .into_iter()
                .filter(|a| own.is_none_or(|own| (a - own).abs() > 1e-9))
                .map(|a| a.to_string())
                .collect()
        }
        ("seed", _, ground) => {
            let seed = ground.seed();
            (1..=4)
                .filter_map(|i| seed?.checked_add(i))
                .map(|seed| seed.to_string())
                .collect()
        }
        ("site", _, Ground::Simulated(simulated)) => {
            let own = simulated.request.site;
            SiteClass::ALL
                .into_iter()
                .filter(|class| *class != own)
                .map(|class| class.name().to_owned())
                .collect()
        }
        ("site", _, ground) => {
            let Some(target) = ground.code_spectrum() else {
                return Vec::new();
            };
            let own = target.spectrum.site_name();
            let classes: Vec<&str> = match &target.spectrum {
                CodeSpectrum::As1170_4(_) => SiteClass::ALL.map(SiteClass::name).to_vec(),
                CodeSpectrum::Eurocode8(_) => GroundType::ALL.map(GroundType::name).to_vec(),
                CodeSpectrum::Nzs1170_5(_) => SubsoilClass::ALL.map(SubsoilClass::name).to_vec(),
                CodeSpectrum::Ntc2018(_) => GroundType::ALL.map(GroundType::name).to_vec(),
                CodeSpectrum::Tbdy2018(_) => TbdySite::ALL.map(TbdySite::name).to_vec(),
                CodeSpectrum::Ts1170_5(_) => TsSite::ALL.map(TsSite::name).to_vec(),
                CodeSpectrum::Asce7(_) | CodeSpectrum::Table(_) => Vec::new(),
            };
            classes
                .into_iter()
                .filter(|class| Some(*class) != own)
                .map(str::to_owned)
                .collect()
        }
        _ => Vec::new(),
    }
}
