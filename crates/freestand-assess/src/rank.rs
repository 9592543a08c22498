//! The order of every list of objects: the most urgent comes first.

use std::cmp::{Ordering, Reverse};

use crate::result::{Assessment, Decision, Probability};
use freestand_inventory::{Item, Rating};

/// What the rank of an object depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Urgency {
    decision: Decision,
    life_safety: Option<Rating>,
    /// P(it falls) and P(its tolerance is exceeded), by the model that decides.
    probabilities: [f64; 2],
    property: Option<Rating>,
    function: Option<Rating>,
    quantity: u32,
    row: u32,
}

impl Urgency {
    /// Of an object and its assessment.
    pub(crate) fn new(item: &Item, found: &Assessment) -> Self {
        let value = |p: Option<Probability>| p.map_or(0.0, |p| p.value);
        Self {
            decision: found.decision,
            life_safety: item.consequences.life_safety,
            probabilities: [value(found.p_overturn), value(found.p_exceed)],
            property: item.consequences.property,
            function: item.consequences.function,
            quantity: item.quantity,
            row: item.row,
        }
    }

    /// The order of [`RULE`]: the more urgent object is the lesser.
    pub(crate) fn order(&self, other: &Self) -> Ordering {
        let [falls, exceeds] = self.probabilities;
        let [other_falls, other_exceeds] = other.probabilities;
        self.decision
            .cmp(&other.decision)
            .then(Reverse(self.life_safety).cmp(&Reverse(other.life_safety)))
            .then(other_falls.total_cmp(&falls))
            .then(other_exceeds.total_cmp(&exceeds))
            .then(
                Reverse((self.property, self.function))
                    .cmp(&Reverse((other.property, other.function))),
            )
            .then(other.quantity.cmp(&self.quantity))
            .then(self.row.cmp(&other.row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEAST: Urgency = Urgency {
        decision: Decision::Leave,
        life_safety: None,
        probabilities: [0.0, 0.0],
        property: None,
        function: None,
        quantity: 1,
        row: 100,
    };

    /// Each line differs from the one below in the criterion that its place in the rule names, while
    /// every later criterion says the opposite.
    #[test]
    fn each_criterion_decides_before_those_after_it() {
        let high = Some(Rating::High);
        let low = Some(Rating::Low);
        let most = Urgency {
            life_safety: high,
            probabilities: [0.9, 0.9],
            quantity: 9,
            row: 1,
            ..LEAST
        };
        let list = [
            Urgency {
                decision: Decision::Restrain,
                ..LEAST
            },
            Urgency {
                decision: Decision::Soften,
                ..most
            },
            Urgency {
                decision: Decision::Lock,
                ..most
            },
            Urgency {
                decision: Decision::NoVerdict,
                ..most
            },
            Urgency {
                life_safety: high,
                ..LEAST
            },
            Urgency {
                life_safety: low,
                ..LEAST
            },
            Urgency {
                probabilities: [0.2, 0.0],
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.9],
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.3],
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.2],
                property: high,
                function: high,
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.2],
                property: high,
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.2],
                property: low,
                function: high,
                quantity: 5,
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.2],
                quantity: 5,
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.2],
                quantity: 4,
                row: 7,
                ..LEAST
            },
            Urgency {
                probabilities: [0.1, 0.2],
                quantity: 4,
                row: 8,
                ..LEAST
            },
        ];
        for (i, one) in list.iter().enumerate() {
            for (j, other) in list.iter().enumerate() {
                assert_eq!(one.order(other), i.cmp(&j), "{i} {j}");
            }
        }
    }
}
