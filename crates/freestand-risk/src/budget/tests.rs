use freestand::fragility::uniform_draw;
use freestand::worlds::{Group, object_stream};
use freestand_study::run::no_progress;

use super::*;

fn request(budget: &str) -> BudgetRequest {
    BudgetRequest {
        budget: crate::amount(budget).unwrap(),
        horizon_years: None,
        discount_ratio: None,
        restraints: None,
        cells: CellsRequest::default(),
    }
}

const LIST: &str = "id,item,height [mm],thickness [mm],level_ratio,replacement_cost [NZD],life_safety\n\
                    a,shelf,1900,400,1,5000,H\n";

fn of_list(list: &str, request: &BudgetRequest) -> Result<Budget, Problems> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(&path, list).unwrap();
    Budget::new(request, &path, UnitSystem::Si)
}

fn refused(list: &str, request: &BudgetRequest) -> String {
    let problems = of_list(list, request).unwrap_err();
    problems
        .into_iter()
        .map(|one| one.message)
        .collect::<Vec<_>>()
        .join("; ")
}

#[test]
fn a_budget_needs_one_currency() {
    assert_eq!(
        crate::amount("15,000 NZD").unwrap(),
        (15e3, "NZD".to_owned())
    );
    for bad in ["15000", "-5 NZD", "NZD", "", "1,2345 NZD"] {
        assert!(crate::amount(bad).is_err(), "{bad}");
    }
    assert!(of_list(LIST, &request("15000 NZD")).is_ok());
    let message = refused(LIST, &request("15000 EUR"));
    assert_eq!(
        message,
        "the budget is in EUR, and the costs of the list are in NZD"
    );
    let message = refused(LIST, &request("15000 BRL"));
    assert_eq!(
        message,
        "the prices of the built-in restraints are not known in BRL"
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.csv");
    let rows = "id,item,kind,for,hold,price_low,price_high,currency,price_source,price_confidence\n\
                rope,rope,tether,at-wall,rigid,5,9,EUR,shop,stated\n";
    std::fs::write(&path, rows).unwrap();
    let mine = BudgetRequest {
        restraints: Some(path),
        ..request("15000 NZD")
    };
    let message = refused(LIST, &mine);
    assert_eq!(
        message,
        "the restraint \"rope\" is priced in EUR, and the budget is in NZD"
    );
}

/// A list without costs is planned for people alone, and says so.
#[test]
fn a_list_without_costs_has_none() {
    let list = "id,item,height [mm],thickness [mm],level_ratio\na,shelf,1900,400,1\n";
    assert!(!of_list(list, &request("900 NZD")).unwrap().has_costs);
    assert!(of_list(LIST, &request("900 NZD")).unwrap().has_costs);
}

fn row(object: usize, measure: usize, draw: &mut impl FnMut(f64, f64) -> f64) -> PlanRow {
    let probability = |value| Probability {
        value,
        low: value,
        high: value,
    };
    let before = draw(0.2, 1.0);
    let after = before * draw(0.0, 1.0);
    let loss = draw(0.0, 300.0);
    let saved = loss * draw(0.0, 1.0);
    let cost = draw(1.0, 10.0);
    // Each rating a third of the objects.
    let rating = [Some(Rating::High), Some(Rating::Medium), None][object % 3];
    PlanRow {
        id: object.to_string(),
        item: String::new(),
        place: String::new(),
        quantity: 1,
        measure: measure.to_string(),
        measure_item: String::new(),
        kind: RestraintKind::Strap,
        standing: Standing::Out(NotPlanned::AvoidsNoFalls),
        cost: [cost; 3],
        currency: "NZD".to_owned(),
        capacity_n: Some(1.0),
        beta: 0.3,
        beta_is_assumed: true,
        capacity_confidence: None,
        price_confidence: Confidence::Stated,
        decision: Decision::Restrain,
        before: probability(before),
        effect: Some(Effect {
            overturn: probability(after),
            exceeded_ratio: Some(0.0),
            force_n: None,
            levels: Vec::new(),
        }),
        rates: Some([before / 100.0, after / 100.0]),
        is_at_least: false,
        losses: Some([loss, loss - saved]),
        benefit: Some(0.1 * saved),
        life_safety: LifeSafety {
            rating,
            is_assumed: false,
        },
        object: Arc::default(),
        fitting: Fitting {
            height_ratio: 0.9,
            anchors: Some(2),
            price: [cost; 2],
            minutes: None,
            work: None,
            capacity_source: String::new(),
            price_source: String::new(),
            note: String::new(),
        },
    }
}

fn priced(rows: Vec<(usize, PlanRow)>, objects: usize, has_rates: bool) -> Priced {
    let asked = |object: usize| {
        let own = rows.iter().find(|(place, _)| *place == object);
        own.map_or(
            Asked {
                quantity: 0,
                decision: Decision::Leave,
                rating: None,
            },
            |(_, row)| Asked {
                quantity: row.quantity,
                decision: row.decision,
                rating: row.life_safety.rating,
            },
        )
    };
    Priced {
        objects: (0..objects).map(asked).collect(),
        rows,
        has_rates,
        extends: false,
        has_costs: true,
        losses: None,
    }
}

/// What a plan is worth: falls of what is rated high, of what is rated medium, then money.
fn worth(rows: &[&PlanRow]) -> [f64; 3] {
    let falls = |rating| {
        let own = rows
            .iter()
            .filter(|row| row.life_safety.rating == Some(rating));
        own.filter_map(|row| row.falls_avoided()).sum::<f64>()
    };
    // Money is spent on what is not bought for people.
    let money = rows.iter().filter(|row| row.life_safety.rating.is_none());
    let money = money
        .map(|row| row.benefit.unwrap_or(0.0) - row.cost[1])
        .sum();
    [falls(Rating::High), falls(Rating::Medium), money]
}

/// The plan against every choice of a measure or none for each of five objects: no choice within the budget avoids more
/// falls of what is rated high; of those that avoid as many, none more of what is rated medium; of those, none saves more
/// money. Sums of at most five numbers: 1e-12.
#[test]
fn a_plan_is_the_best_of_all_choices() {
    let budget = of_list(LIST, &request("15 NZD")).unwrap();
    let (mut all_bought, mut some_left) = (0, 0);
    for sample in 0..120 {
        let mut random = object_stream(7, sample, 1, Group::Restraint, 0);
        let mut draw = |low: f64, high: f64| uniform_draw(&mut random, low, high);
        let objects = 5;
        let rows: Vec<(usize, PlanRow)> = (0..objects)
            .flat_map(|object| (0..2).map(move |measure| (object, measure)))
            .map(|(object, measure)| (object, row(object, measure, &mut draw)))
            .collect();
        let mut best = [0.0; 3];
        for choice in 0..3usize.pow(objects as u32) {
            let chosen: Vec<&PlanRow> = (0..objects)
                .filter_map(|object| {
                    let measure = choice / 3usize.pow(object as u32) % 3;
                    rows.iter()
                        .find(|(place, row)| *place == object && row.measure == measure.to_string())
                })
                .map(|(_, row)| row)
                .collect();
            let cost: f64 = chosen.iter().map(|row| row.cost[1]).sum();
            let worth = worth(&chosen);
            if cost <= budget.amount && worth > best {
                best = worth;
            }
        }
        let plan = budget.plan(priced(rows.clone(), objects, true), &no_progress);
        // The same objects at two sites have the same plan.
        let (first, second) = rows.iter().cloned().partition(|(object, _)| *object < 2);
        let second: Vec<(usize, PlanRow)> = second;
        let second = second.into_iter().map(|(object, row)| (object - 2, row));
        let site = |name: &str, priced| PlannedSite {
            name: name.to_owned(),
            budget: &budget,
            priced,
        };
        let sites = vec![
            site("a", priced(first, 2, true)),
            site("b", priced(second.collect(), 3, true)),
        ];
        let (over_sites, names) = plan_over_sites(sites, &no_progress).unwrap();
        assert_eq!(over_sites, plan);
        for (row, name) in over_sites.rows.iter().zip(names) {
            let object: usize = row.id.parse().unwrap();
            assert_eq!(name, if object < 2 { "a" } else { "b" });
        }
        let planned: Vec<&PlanRow> = plan.planned().collect();
        let found = worth(&planned);
        assert!(plan.cost <= budget.amount && plan.is_optimal);
        for (found, best) in found.iter().zip(best) {
            assert!((found - best).abs() < 1e-12, "{sample}: {found:?} {best:?}");
        }
        // Objects that somebody needs are bought, or counted as unfunded.
        let people = |row: &&PlanRow| row.life_safety.rating.is_some();
        let bought = planned.iter().copied().filter(people).count();
        assert_eq!(bought + plan.unfunded.objects as usize, 4, "{sample}");
        all_bought += usize::from(plan.unfunded.objects == 0);
        some_left += usize::from(plan.unfunded.objects > 0);
    }
    assert!(all_bought > 5 && some_left > 5, "{all_bought} {some_left}");
}

/// Without yearly rates what is left is spent on falls of everything else.
#[test]
fn without_rates_falls_are_avoided() {
    let budget = of_list(LIST, &request("15 NZD")).unwrap();
    let mut random = object_stream(7, 0, 2, Group::Restraint, 0);
    let mut draw = |low: f64, high: f64| uniform_draw(&mut random, low, high);
    let mut one = row(2, 0, &mut draw);
    (one.rates, one.losses, one.benefit) = (None, None, None);
    let plan = budget.plan(priced(vec![(0, one.clone())], 1, false), &no_progress);
    let standing = plan.rows[0].standing;
    assert_eq!(standing, Standing::In(Planned::AvoidsFalls));
    let expected = one.before.value - one.effect.as_ref().unwrap().overturn.value;
    assert_eq!(one.falls_avoided(), Some(expected));
    // With rates but without costs there is nothing to save.
    one.rates = Some([0.01, 0.0]);
    // At two sites, of which one has no yearly rates, falls in the earthquakes of the studies count for both.
    let both = [true, false].map(|has_rates| {
        let row = PlanRow {
            losses: Some([1.0, 0.0]),
            benefit: Some(100.0),
            ..one.clone()
        };
        PlannedSite {
            name: "s".to_owned(),
            budget: &budget,
            priced: priced(vec![(0, row)], 1, has_rates),
        }
    });
    let (plan, _) = plan_over_sites(both.into(), &no_progress).unwrap();
    assert!(
        plan.rows
            .iter()
            .all(|row| row.benefit.is_none() && row.falls_avoided() == Some(expected))
    );
    let plan = budget.plan(priced(vec![(0, one)], 1, true), &no_progress);
    assert_eq!(
        plan.rows[0].standing,
        Standing::Out(NotPlanned::NothingToSave)
    );
}

/// The upper end with a restraint is not below the probability that it gives way.
#[test]
fn a_restraint_that_may_give_way_promises_nothing() {
    let mut random = object_stream(7, 0, 3, Group::Restraint, 0);
    let mut draw = |low: f64, high: f64| uniform_draw(&mut random, low, high);
    let mut one = row(0, 0, &mut draw);
    let effect = one.effect.as_mut().unwrap();
    effect.overturn = Probability {
        value: 0.01,
        low: 0.0,
        high: 0.04,
    };
    effect.exceeded_ratio = Some(0.3);
    assert_eq!(one.after_high(), Some(0.3));
    one.effect.as_mut().unwrap().exceeded_ratio = Some(0.02);
    assert_eq!(one.after_high(), Some(0.04));
}

/// What may be left as it is comes after what must be restrained, however well it pays, unless people need it; and both
/// are counted.
#[test]
fn a_plan_puts_what_must_be_restrained_first() {
    let budget = of_list(LIST, &request("15 NZD")).unwrap();
    let mut random = object_stream(7, 0, 4, Group::Restraint, 0);
    let mut draw = |low: f64, high: f64| uniform_draw(&mut random, low, high);
    // In the order of the list; what each costs and what it saves.
    let rows = [
        ("pays best", Some(Rating::Low), Decision::Leave, 4.0, 400.0),
        ("pays", None, Decision::Restrain, 4.0, 40.0),
        ("people", Some(Rating::High), Decision::Leave, 4.0, 0.0),
        ("too dear", None, Decision::Restrain, 14.0, 20.0),
    ];
    let rows = rows.into_iter().enumerate();
    let rows = rows.map(|(object, (id, rating, decision, cost, benefit))| {
        let mut row = row(object, 0, &mut draw);
        row.id = id.to_owned();
        row.quantity = 2;
        row.life_safety.rating = rating;
        row.decision = decision;
        row.cost = [cost; 3];
        row.benefit = Some(benefit);
        (object, row)
    });
    let mut all = priced(rows.collect(), 4, true);
    // Nothing in the library suits it.
    all.objects.push(Asked {
        quantity: 5,
        decision: Decision::Restrain,
        rating: Some(Rating::High),
    });
    let plan = budget.plan(all, &no_progress);
    let planned: Vec<&str> = plan.planned().map(|row| row.id.as_str()).collect();
    assert_eq!(planned, ["people", "pays", "pays best"]);
    assert_eq!(plan.left_and_planned(Planned::LifeSafety), 2);
    assert_eq!(plan.left_and_planned(Planned::Pays), 2);
    assert_eq!(plan.left_and_planned(Planned::AvoidsFalls), 0);
    assert_eq!((plan.not_restrained, plan.without_option), (7, 5));
    assert_eq!(plan.without_measure, 5);
}
