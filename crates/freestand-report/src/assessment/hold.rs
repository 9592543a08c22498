//! How an object is held: what moves on wheels is not bolted to the floor, and what stands on a table
//! has no edges to anchor.

use freestand_input::words::{canonical, number};

use freestand_assess::result::RestraintForce;
use freestand_inventory::{Casters, Item};

/// Words for things that are made to be moved, singular, in the form in which they are compared.
const MOBILE: [&str; 26] = [
    "trolley",
    "cart",
    "mobile",
    "wheelchair",
    "stretcher",
    "gurney",
    "portable",
    "wheeled",
    "dolly",
    "bed",
    "cot",
    "crib",
    "isolette",
    "incubator",
    "wagen",
    "rollwagen",
    "visitenwagen",
    "bett",
    "chariot",
    "brancard",
    "lit",
    "carro",
    "carrito",
    "camilla",
    "carrello",
    "barella",
];

/// Lighter than this an object is usually on a table, a bench or a shelf \[kg\]: an assumption.
const SMALL_KG: f64 = 20.0;

/// How an object can be held where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hold {
    /// It is moved every day: a tether or a dock.
    Tether,
    /// It stands on furniture: a strap or a clip.
    Strap,
    /// It stands on the floor: anchors or a bracket.
    Anchor,
}

impl Hold {
    fn of(item: &Item) -> Self {
        let is_named = canonical(&item.item)
            .split(|letter: char| !letter.is_alphanumeric())
            .any(|word| {
                let singular = word.strip_suffix('s').unwrap_or(word);
                MOBILE.contains(&word) || MOBILE.contains(&singular)
            });
        if matches!(
            item.surroundings.casters,
            Some(Casters::Free | Casters::Braked)
        ) || is_named
        {
            return Self::Tether;
        }
        if item.mass_kg.is_some_and(|mass_kg| mass_kg < SMALL_KG) {
            Self::Strap
        } else {
            Self::Anchor
        }
    }
}

/// How an object that must be restrained is held, in one or two sentences.
pub(super) fn how_to_hold(item: &Item, force: &RestraintForce) -> String {
    let bracket_mm = number(1e3 * force.bracket_height_m, 4);
    match Hold::of(item) {
        Hold::Tether => format!(
            "Do not bolt it to the floor, because it is moved: lock its wheels and tether it to the wall at a height of \
             {bracket_mm} mm, or dock it, wherever it is parked."
        ),
        Hold::Strap => {
            "Fasten it with straps, clips or a lip to the furniture that it stands on, and fix that furniture too."
                .to_owned()
        }
        Hold::Anchor if force.anchor_tension_n > 0.0 => {
            format!("Anchor it along both edges, or fix it with a bracket at a height of {bracket_mm} mm.")
        }
        Hold::Anchor => format!(
            "No tension: its weight holds it down. Fix its base against the force, or fix it with a bracket at a height \
             of {bracket_mm} mm."
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(item: &str, change: impl Fn(&mut Item)) -> Hold {
        let mut one = crate::assessment::fixture::item(0);
        (one.item, one.mass_kg, one.surroundings.casters) = (item.to_owned(), Some(140.0), None);
        change(&mut one);
        Hold::of(&one)
    }

    /// A drug trolley is tethered, a monitor is strapped, a cabinet is anchored.
    #[test]
    fn the_action_fits_the_object() {
        assert_eq!(of("Drug trolley", |_| ()), Hold::Tether);
        assert_eq!(of("Infant incubators", |_| ()), Hold::Tether);
        assert_eq!(
            of("Ultrasound", |item| item.surroundings.casters =
                Some(Casters::Free)),
            Hold::Tether
        );
        assert_eq!(
            of("Patient monitor", |item| item.mass_kg = Some(9.0)),
            Hold::Strap
        );
        assert_eq!(of("Instrument cabinet", |_| ()), Hold::Anchor);
        // A word within another one is none.
        assert_eq!(of("Cartography cabinet", |_| ()), Hold::Anchor);
    }
}
