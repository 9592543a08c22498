//! The measures that are worth most within a budget.

/// One measure for one object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// What it costs.
    pub cost: f64,
    /// What it is worth beyond its cost, its net present value.
    pub value: f64,
}

/// Measures within a budget.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// For each object its measure, by number, or none.
    pub chosen: Vec<Option<usize>>,
    /// Σ cost.
    pub cost: f64,
    /// Σ value.
    pub value: f64,
    /// No plan within the budget is worth more than this.
    pub bound: f64,
    /// Whether the plan is proven to be the best; otherwise the search was stopped.
    pub is_optimal: bool,
}

/// The plan with the largest value whose cost is within the budget, with at most one measure for
/// each object: a knapsack problem with multiple choices.
///
/// Exact: objects are added one after the other, and of the plans so far those are dropped that
/// another one beats in cost and value, and those that cannot become the best one even if measures
/// could be taken in part (the bound of the linear relaxation). `go_on` is asked after each object;
/// when it says no, the best plan so far is returned with its bound.
///
/// Measures without a finite cost of 0 or more and a positive value are never chosen.
///
/// # Reference
/// Nemhauser, G. L. and Ullmann, Z. (1969) for the list of undominated plans; Sinha, P. and
/// Zoltners, A. A. (1979). The multiple-choice knapsack problem. Operations Research 27, 503–515,
/// for the bound.
///
/// # Example
/// The best ratio is not in the best plan: 60/6 beats 50/5.5 alone, but two of the latter fit.
/// ```
/// use freestand::risk::{Choice, best_plan};
/// let one = |cost, value| vec![Choice { cost, value }];
/// let plan = best_plan(&[one(6.0, 60.0), one(5.5, 50.0), one(5.5, 50.0)], 11.0, || true);
/// assert_eq!((plan.value, plan.chosen), (100.0, vec![None, Some(0), Some(0)]));
/// ```
pub fn best_plan(objects: &[Vec<Choice>], budget: f64, mut go_on: impl FnMut() -> bool) -> Plan {
    let classes = classes(objects, budget);
    let increments = increments(&classes);
    let mut best = Completed::default();
    let mut nodes: Vec<Node> = Vec::new();
    let mut partial = vec![Partial {
        cost: 0.0,
        value: 0.0,
        node: None,
    }];
    let mut stopped_bound = None;
    for position in 0..=classes.len() {
        let relaxed = Relaxed::new(&increments, position);
        let bound = |plan: &Partial| plan.value + relaxed.value(budget - plan.cost);
        // The most promising plan, completed as long as measures fit, is often the best one.
        let promising = partial
            .iter()
            .reduce(|a, b| if bound(b) > bound(a) { b } else { a });
        if let Some(start) = promising {
            let completed = complete(start, &nodes, &classes, &increments, position, budget);
            if completed.value > best.value {
                best = completed;
            }
        }
        partial.retain(|plan| bound(plan) > best.value);
        let Some(class) = classes.get(position).filter(|_| !partial.is_empty()) else {
            break;
        };
        if !go_on() {
            stopped_bound = Some(partial.iter().map(bound).fold(best.value, f64::max));
            break;
        }
        let mut next = partial.clone();
        for plan in &partial {
            for (option, choice) in class.options.iter().enumerate() {
                let cost = plan.cost + choice.cost;
                if cost <= budget {
                    nodes.push(Node {
                        before: plan.node,
                        position,
                        option,
                    });
                    next.push(Partial {
                        cost,
                        value: plan.value + choice.value,
                        node: Some(nodes.len() - 1),
                    });
                }
            }
        }
        // By cost, the better value first; then only plans that are worth more than every cheaper
        // one.
        next.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(b.value.total_cmp(&a.value)));
        let mut most = f64::NEG_INFINITY;
        next.retain(|plan| {
            let is_better = plan.value > most;
            most = most.max(plan.value);
            is_better
        });
        partial = next;
    }
    let mut chosen = vec![None; objects.len()];
    for taken in best.taken {
        if let Some(class) = classes.get(taken.position) {
            chosen[class.object] = class.numbers.get(taken.option).copied();
        }
    }
    let bound = stopped_bound.unwrap_or(best.value);
    Plan {
        chosen,
        cost: best.cost,
        value: best.value,
        bound,
        is_optimal: bound <= best.value,
    }
}

/// The measures of one object that can be in a best plan, by rising cost and value.
struct Class {
    object: usize,
    options: Vec<Choice>,
    /// Their numbers.
    numbers: Vec<usize>,
    /// Those on the upper hull of value over cost from (0, 0).
    hull: Vec<usize>,
}

/// A plan for the first objects.
#[derive(Clone)]
struct Partial {
    cost: f64,
    value: f64,
    node: Option<usize>,
}

/// The last measure of a plan, and the plan before it.
struct Node {
    before: Option<usize>,
    position: usize,
    option: usize,
}

/// A measure that is taken: the place of its object, and its place among the measures of that.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Taken {
    position: usize,
    option: usize,
}

/// A plan for all objects.
#[derive(Default)]
struct Completed {
    taken: Vec<Taken>,
    cost: f64,
    value: f64,
}

/// A step from one measure on the hull of an object to the next.
struct Increment {
    position: usize,
    /// Place on the hull after the step, from 1.
    place: usize,
    cost: f64,
    value: f64,
}

impl Increment {
    /// More value for the cost comes first; what costs nothing comes before all.
    fn slope(&self) -> f64 {
        if self.cost > 0.0 {
            self.value / self.cost
        } else {
            f64::INFINITY
        }
    }
}

fn classes(objects: &[Vec<Choice>], budget: f64) -> Vec<Class> {
    let mut classes = Vec::new();
    for (object, all) in objects.iter().enumerate() {
        let is_useful =
            |choice: &Choice| choice.cost >= 0.0 && choice.cost <= budget && choice.value > 0.0;
        let mut useful: Vec<(usize, Choice)> = all
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, choice)| is_useful(choice) && choice.value.is_finite())
            .collect();
        useful
            .sort_by(|(_, a), (_, b)| a.cost.total_cmp(&b.cost).then(b.value.total_cmp(&a.value)));
        let mut most = 0.0;
        useful.retain(|(_, choice)| {
            let is_better = choice.value > most;
            most = choice.value.max(most);
            is_better
        });
        if useful.is_empty() {
            continue;
        }
        let options: Vec<Choice> = useful.iter().map(|(_, choice)| *choice).collect();
        let mut hull: Vec<usize> = Vec::new();
        for (i, choice) in options.iter().enumerate() {
            while let Some(&top) = hull.last() {
                let before = hull
                    .len()
                    .checked_sub(2)
                    .and_then(|i| hull.get(i))
                    .map(|&i| options[i]);
                let before = before.unwrap_or(Choice {
                    cost: 0.0,
                    value: 0.0,
                });
                let (a, b) = (options[top], *choice);
                // The point on top is on or below the line past it.
                if (a.value - before.value) * (b.cost - before.cost)
                    > (b.value - before.value) * (a.cost - before.cost)
                {
                    break;
                }
                hull.pop();
            }
            hull.push(i);
        }
        classes.push(Class {
            object,
            numbers: useful.iter().map(|(number, _)| *number).collect(),
            options,
            hull,
        });
    }
    // The best ratios first, so that later objects hardly matter.
    let ratio = |class: &Class| {
        let first = class.options[class.hull[0]];
        if first.cost > 0.0 {
            first.value / first.cost
        } else {
            f64::INFINITY
        }
    };
    classes.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
    classes
}

fn increments(classes: &[Class]) -> Vec<Increment> {
    let mut all = Vec::new();
    for (position, class) in classes.iter().enumerate() {
        let mut before = Choice {
            cost: 0.0,
            value: 0.0,
        };
        for (i, &option) in class.hull.iter().enumerate() {
            let here = class.options[option];
            all.push(Increment {
                position,
                place: i + 1,
                cost: here.cost - before.cost,
                value: here.value - before.value,
            });
            before = here;
        }
    }
    // Stable: the steps of one object stay in order where their slopes are equal.
    all.sort_by(|a, b| b.slope().total_cmp(&a.slope()));
    all
}

/// The value of the later objects if their measures could be taken in part, as a function of what is
/// left of the budget.
struct Relaxed {
    /// Cost and value of the first steps together, rising, from (0, 0).
    points: Vec<(f64, f64)>,
}

impl Relaxed {
    fn new(increments: &[Increment], position: usize) -> Self {
        let mut points = vec![(0.0, 0.0)];
        let (mut cost, mut value) = (0.0, 0.0);
        for step in increments.iter().filter(|step| step.position >= position) {
            (cost, value) = (cost + step.cost, value + step.value);
            points.push((cost, value));
        }
        Self { points }
    }

    fn value(&self, left: f64) -> f64 {
        let after = self.points.partition_point(|(cost, _)| *cost <= left);
        let Some(&(from, value)) = after.checked_sub(1).and_then(|i| self.points.get(i)) else {
            return 0.0;
        };
        match self.points.get(after) {
            Some(&(to, more)) => value + (more - value) * (left - from) / (to - from),
            None => value,
        }
    }
}

/// A plan completed by steps in the order of their slopes, as long as they fit.
fn complete(
    start: &Partial,
    nodes: &[Node],
    classes: &[Class],
    increments: &[Increment],
    position: usize,
    budget: f64,
) -> Completed {
    let mut places = vec![0; classes.len()];
    let mut cost = start.cost;
    for step in increments.iter().filter(|step| step.position >= position) {
        let place = &mut places[step.position];
        if *place + 1 == step.place && cost + step.cost <= budget {
            *place = step.place;
            cost += step.cost;
        }
    }
    let mut taken: Vec<Taken> = Vec::new();
    let mut node = start.node.and_then(|node| nodes.get(node));
    while let Some(here) = node {
        taken.push(Taken {
            position: here.position,
            option: here.option,
        });
        node = here.before.and_then(|node| nodes.get(node));
    }
    for (position, (class, place)) in classes.iter().zip(&places).enumerate() {
        let option = place.checked_sub(1).and_then(|i| class.hull.get(i));
        taken.extend(option.map(|&option| Taken { position, option }));
    }
    taken.sort_unstable();
    // Summed in one order, so that the way to a plan does not change its last digits.
    let sum = |of: &dyn Fn(Choice) -> f64| {
        taken
            .iter()
            .map(|one| of(classes[one.position].options[one.option]))
            .sum::<f64>()
    };
    let (cost, value) = (sum(&|choice| choice.cost), sum(&|choice| choice.value));
    Completed { taken, cost, value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::draw_stream;
    use rand::RngExt;

    /// Every combination.
    fn brute_force(objects: &[Vec<Choice>], budget: f64) -> f64 {
        let Some((first, rest)) = objects.split_first() else {
            return 0.0;
        };
        let with = first
            .iter()
            .filter(|choice| choice.cost <= budget && choice.value > 0.0);
        with.map(|choice| choice.value + brute_force(rest, budget - choice.cost))
            .fold(brute_force(rest, budget), f64::max)
    }

    fn random(sample: u64, objects: usize) -> (Vec<Vec<Choice>>, f64) {
        let mut random = draw_stream(11, sample, 0, 0);
        let is_coarse = random.random::<bool>();
        let mut number = |largest: f64| {
            let value = largest * random.random::<f64>();
            if is_coarse { value.round() } else { value }
        };
        let choices = |number: &mut dyn FnMut(f64) -> f64| -> Vec<Choice> {
            let count = number(4.0).round() as usize;
            (0..count)
                .map(|_| Choice {
                    cost: number(10.0),
                    value: number(24.0) - 4.0,
                })
                .collect()
        };
        let objects = (0..objects).map(|_| choices(&mut number)).collect();
        (objects, number(30.0))
    }

    /// Small plans of every kind, also with equal, free and useless measures. Sums of at most seven
    /// numbers, in another order: 1e-13.
    #[test]
    fn a_plan_is_the_best_of_all() {
        for sample in 0..600 {
            let (objects, budget) = random(sample, 1 + sample as usize % 7);
            let plan = best_plan(&objects, budget, || true);
            let expected = brute_force(&objects, budget);
            assert!(
                (plan.value - expected).abs() < 1e-12,
                "{sample}: {plan:?} {expected}"
            );
            assert!(
                plan.is_optimal && plan.bound == plan.value && plan.cost <= budget + 1e-12,
                "{plan:?}"
            );
            let chosen = objects
                .iter()
                .zip(&plan.chosen)
                .filter_map(|(of, chosen)| chosen.map(|chosen| of[chosen]));
            let sum = chosen.fold((0.0, 0.0), |sum, choice| {
                (sum.0 + choice.cost, sum.1 + choice.value)
            });
            assert!((sum.0 - plan.cost).abs() < 1e-12 && (sum.1 - plan.value).abs() < 1e-12);
        }
    }

    #[test]
    fn a_large_plan_is_found_and_a_stopped_one_says_so() {
        let (objects, _) = random(3, 400);
        let whole = best_plan(&objects, 300.0, || true);
        assert!(whole.is_optimal);
        let mut left = 3;
        let stopped = best_plan(&objects, 300.0, || {
            left -= 1;
            left > 0
        });
        assert!(stopped.value <= whole.value && stopped.bound >= whole.value);
        assert!(stopped.is_optimal == (stopped.bound <= stopped.value));
        // More money is never worth less.
        let mut before = 0.0;
        for i in 0..=20 {
            let value = best_plan(&objects, 30.0 * f64::from(i), || true).value;
            assert!(value >= before, "{i}");
            before = value;
        }
    }

    /// A budget above all costs buys the best option for each object, and the cheaper of two
    /// options that are worth the same. A budget of 0 buys only options that cost nothing.
    #[test]
    fn budgets_beyond_all_costs_and_of_nothing() {
        for sample in 0..200 {
            let (objects, _) = random(sample, 1 + sample as usize % 40);
            let (rich, poor) = (
                best_plan(&objects, 1e12, || true),
                best_plan(&objects, 0.0, || true),
            );
            assert!(rich.is_optimal && poor.is_optimal && poor.cost == 0.0);
            for ((of, rich), poor) in objects.iter().zip(&rich.chosen).zip(&poor.chosen) {
                let worth = |chosen: &Option<usize>| chosen.map_or(0.0, |chosen| of[chosen].value);
                let most = |is_there: &dyn Fn(&&Choice) -> bool| {
                    of.iter()
                        .filter(is_there)
                        .map(|choice| choice.value)
                        .fold(0.0, f64::max)
                };
                assert_eq!(
                    (worth(rich), worth(poor)),
                    (most(&|_| true), most(&|choice| choice.cost == 0.0))
                );
                let cheaper = |chosen: usize| {
                    of.iter()
                        .any(|one| one.value == of[chosen].value && one.cost < of[chosen].cost)
                };
                assert!(!rich.is_some_and(cheaper), "{of:?} {rich:?}");
            }
        }
    }

    #[test]
    fn nothing_to_choose() {
        let none = best_plan(&[], 100.0, || true);
        assert_eq!(
            (none.chosen, none.cost, none.value, none.is_optimal),
            (vec![], 0.0, 0.0, true)
        );
        let useless = [
            Choice {
                cost: 1.0,
                value: -5.0,
            },
            Choice {
                cost: f64::NAN,
                value: 5.0,
            },
        ];
        let useless = best_plan(
            &[
                useless.to_vec(),
                vec![Choice {
                    cost: 9.0,
                    value: 9.0,
                }],
            ],
            8.0,
            || true,
        );
        assert_eq!(useless.chosen, [None, None]);
    }
}
