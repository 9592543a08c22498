//! Rows as they were understood, as lines of JSON: a part of a list that is assessed elsewhere.
//!
//! A row is nested (a contact law with its layers, a tolerance with its source, doubts), so it is
//! kept as the results of objects are, and not in a table. Numbers keep all their bits.

use freestand::rocking::Restitution;
use freestand_input::problem::{Problem, ProblemKind};
use serde::{Deserialize, Serialize};

use super::Item;

/// The rows as lines of JSON, one for each.
///
/// # Errors
/// A row that is not the same when it is read back, such as one with a number that is not finite.
///
/// # Example
/// ```
/// use freestand_inventory::{ReadOptions, items_from_lines, lines_of_items, parse_inventory};
/// use freestand_inventory::library::Lookup;
/// let list = "id,height [m],thickness [mm],stiffness [N/mm]\nA-1,2.3,610,4380\n";
/// let options = ReadOptions::new(&Lookup::NONE);
/// let items = parse_inventory(list.into(), "list.csv".as_ref(), &options)?.inventory.items;
/// assert_eq!(items_from_lines(&lines_of_items(&items)?), Some(items));
/// # Ok::<(), freestand_input::problem::Problems>(())
/// ```
pub fn lines_of_items(items: &[Item]) -> Result<Vec<u8>, Problem> {
    let mut lines = Vec::new();
    for item in items {
        let broken = || {
            let message = format!(
                "row {} (\"{}\") cannot be kept for a shard",
                item.row, item.id
            );
            Problem::new(ProblemKind::Computation, message)
                .hint("this is a defect of freestand; please report it")
        };
        let line = serde_json::to_vec(item).map_err(|_| broken())?;
        if serde_json::from_slice::<Item>(&line).ok().as_ref() != Some(item) {
            return Err(broken());
        }
        lines.extend(line);
        lines.push(b'\n');
    }
    Ok(lines)
}

/// The rows of [`lines_of_items`]; `None` where these are not such lines.
pub fn items_from_lines(lines: &[u8]) -> Option<Vec<Item>> {
    lines
        .split_inclusive(|byte| *byte == b'\n')
        .map(|line| serde_json::from_slice(line).ok())
        .collect()
}

/// The restitution of a row, for its field of [`Item`].
#[derive(Serialize, Deserialize)]
#[serde(remote = "Restitution", rename_all = "kebab-case")]
pub(super) enum KeptRestitution {
    Housner,
    Value(f64),
    Factor(f64),
    Edges([f64; 2]),
}

/// For the field `questions` of [`Item`]: the names that lists use.
pub(super) mod questions {
    use freestand_study::study::assessment::Questions;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in super::super) fn serialize<S: Serializer>(
        asked: &Option<Questions>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let name = |asked| {
            Questions::ALL
                .iter()
                .find(|one| one.1 == asked)
                .map(|one| one.0)
        };
        asked.and_then(name).serialize(to)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Questions>, D::Error> {
        let Some(name) = Option::<String>::deserialize(from)? else {
            return Ok(None);
        };
        let found = Questions::ALL
            .iter()
            .find(|one| one.0 == name)
            .map(|one| one.1);
        found
            .map(Some)
            .ok_or_else(|| D::Error::custom("an unknown question"))
    }
}

/// For a shape of [`Item`] that is a body.
pub(super) mod body {
    use std::sync::Arc;

    use freestand_study::hull::BodyInPose;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in super::super) fn serialize<S: Serializer>(
        body: &Arc<BodyInPose>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        body.as_ref().serialize(to)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Arc<BodyInPose>, D::Error> {
        let body = BodyInPose::deserialize(from)?;
        match body.standing.has_its_pose() {
            true => Ok(Arc::new(body)),
            false => Err(D::Error::custom("a body without its pose")),
        }
    }
}

#[cfg(test)]
mod tests {
    use freestand::cushion::{ContactLaw, Cushion};
    use freestand_study::cushion::{CushionNote, EdgeCushion};

    use super::*;
    use crate::library::Lookup;
    use crate::{ReadOptions, parse_inventory};

    fn items() -> Vec<Item> {
        let list = "id,height [m],thickness [m],width [m],mass [kg],tolerance [g],stiffness [N/mm],restitution,\
                    questions,anchored,casters,floor,Asset\n\
                    a,1.1,0.3,0.1,80.7,5,2190,0.9,falls,no,free,3,=1+1 \"x\"\n\
                    a,tall,,,,,,,falls+shock,yes,,roof,\n";
        let options = ReadOptions::new(&Lookup::NONE);
        parse_inventory(list.into(), "list.csv".as_ref(), &options)
            .unwrap()
            .inventory
            .items
    }

    /// The second row has doubts, an id that was changed and almost no values.
    #[test]
    fn a_row_is_the_same_when_it_is_read_back() {
        let items = items();
        assert!(
            items[0].cushion.is_some()
                && items[0].questions.is_some()
                && !items[1].doubts.is_empty()
        );
        let lines = lines_of_items(&items).unwrap();
        assert_eq!(items_from_lines(&lines).unwrap(), items);
        assert_eq!(items_from_lines(&lines[..lines.len() - 3]), None);
        assert_eq!(items_from_lines(b""), Some(Vec::new()));
    }

    #[test]
    fn every_law_and_every_restitution_is_kept() {
        let laws = [
            ContactLaw::Linear {
                stiffness_n_m: 0.1 + 0.2,
            },
            ContactLaw::Power {
                coefficient_n_mn: 1e7 / 3.0,
                exponent: 1.5,
            },
            ContactLaw::KelvinVoigt {
                stiffness_n_m: 1e5,
                damping_n_s_m: 1e2 / 7.0,
            },
            ContactLaw::HuntCrossley {
                coefficient_n_mn: 1e6,
                exponent: 1.5,
                dissipation_s_m: 0.3,
            },
            ContactLaw::Tangent {
                stiffness_n_m: 1e5,
                bottoming_m: 0.01,
            },
            ContactLaw::Tabulated {
                compressions_m: vec![0.0, 0.001, 0.002],
                forces_n: vec![0.0, 5.0, 25.0],
            },
            ContactLaw::Series {
                parts: vec![
                    ContactLaw::Linear { stiffness_n_m: 1e5 },
                    ContactLaw::Tangent {
                        stiffness_n_m: 2e5,
                        bottoming_m: 0.02,
                    },
                ],
            },
        ];
        let restitutions = [
            Restitution::Housner,
            Restitution::Value(0.3),
            Restitution::Factor(1.1),
        ];
        for (law, restitution) in laws.into_iter().zip(restitutions.into_iter().cycle()) {
            let cushion = Cushion::new(law).unwrap();
            let edge = EdgeCushion {
                cushion,
                pad_thickness_m: Some(0.02),
                notes: vec![CushionNote::HertzExponent],
            };
            let item = Item {
                cushion: Some(edge),
                restitution,
                ..items().swap_remove(0)
            };
            let lines = lines_of_items(std::slice::from_ref(&item)).unwrap();
            assert_eq!(items_from_lines(&lines).unwrap(), [item]);
        }
    }

    /// A cushion is checked when it is read back: a line whose law is not valid is not a row.
    #[test]
    fn a_law_that_is_not_valid_is_refused() {
        let line = String::from_utf8(lines_of_items(&items()[..1]).unwrap()).unwrap();
        let stiffness = r#""stiffness_n_m":2190000.0"#;
        assert!(line.contains(stiffness), "{line}");
        assert_eq!(
            items_from_lines(
                line.replace(stiffness, r#""stiffness_n_m":-1.0"#)
                    .as_bytes()
            ),
            None
        );
    }

    /// A number that JSON does not have is refused, and not lost.
    #[test]
    fn what_cannot_be_kept_is_refused() {
        let item = Item {
            height_m: Some(f64::INFINITY),
            ..items().swap_remove(0)
        };
        let message = lines_of_items(&[item]).unwrap_err().message;
        assert!(
            message.starts_with("row 2 (\"a\") cannot be kept"),
            "{message}"
        );
    }
}
