//! The height of one floor by its name, for flags.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_study::study::FirstFloor;

use super::floors::{FloorFinder, Floors, Found};

/// Most names of floors that a hint lists.
const MAX_NAMES: usize = 8;

/// The height of a floor over that of the building. Unless the building says otherwise, floor 1 is
/// the first above the ground.
///
/// # Errors
/// A name that is not known, or that is above the roof; nothing says how many storeys there are.
pub fn level_of_floor(floors: &Floors, name: &str) -> Result<f64, Problem> {
    let floors = Floors {
        first_floor: floors.first_floor.or(Some(FirstFloor::Above)),
        ..floors.clone()
    };
    let hint = match FloorFinder::new(&floors, &[], false, false).find(name) {
        Found::Ratio(ratio, _) => return Ok(ratio),
        Found::NoStoreys => "add `storeys`, the number of storeys of the building".to_owned(),
        Found::Unknown => match (&floors.named[..], floors.storeys) {
            ([], Some(storeys)) => {
                format!(
                    "write 1 to {storeys} (1 is the first above the ground, {storeys} the roof), ground or roof"
                )
            }
            ([], None) => {
                "give `level_ratio`, the height of the floor over that of the building".to_owned()
            }
            (named, _) => {
                let names: Vec<String> = named
                    .iter()
                    .take(MAX_NAMES)
                    .map(|(name, _)| format!("\"{name}\""))
                    .collect();
                format!(
                    "the study names the floors {}; or give `level_ratio`",
                    names.join(", ")
                )
            }
        },
    };
    Err(Problem::value(
        format!(
            "`floor` \"{}\" is not a floor of the building",
            shorten(name)
        ),
        hint,
    )
    .of(&["floor"]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_by_their_names() {
        let six = Floors {
            storeys: Some(6),
            ..Floors::default()
        };
        for (name, ratio) in [
            ("3", 0.5),
            ("Level 6", 1.0),
            ("roof", 1.0),
            ("G", 0.0),
            ("1", 1.0 / 6.0),
        ] {
            assert_eq!(level_of_floor(&six, name).unwrap(), ratio, "{name}");
        }
        let error = |floors: &Floors, name| level_of_floor(floors, name).unwrap_err().hint.unwrap();
        assert!(error(&six, "7").starts_with("write 1 to 6"));
        assert!(error(&Floors::default(), "3").contains("`storeys`"));
        let named = Floors {
            named: vec![("Lobby".to_owned(), 0.0), ("Ward".to_owned(), 0.4)],
            ..Floors::default()
        };
        assert_eq!(level_of_floor(&named, "ward").unwrap(), 0.4);
        assert!(error(&named, "Attic 2").contains("\"Lobby\", \"Ward\""));
    }
}
