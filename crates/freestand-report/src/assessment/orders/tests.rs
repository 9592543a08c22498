use std::sync::Arc;

use freestand_assess::result::{Decision, Probability};
use freestand_assess::verdict::Effect;
use freestand_risk::budget::{Fitting, LifeSafety, NotPlanned, Planned, Standing, ToFit, Unfunded};

use super::*;
use crate::assessment::fixture::forces;

fn row(id: &str, room: &str, kind: RestraintKind, change: impl FnOnce(&mut ToFit)) -> PlanRow {
    let chance = |value| Probability {
        value,
        low: value,
        high: value,
    };
    let mut object = ToFit {
        room: room.to_owned(),
        height_m: Some(1.8),
        thickness_m: Some(0.4),
        mass_kg: Some(90.0),
        wall_gap_m: Some(0.05),
        force: forces().into_iter().next(),
        ..ToFit::default()
    };
    change(&mut object);
    PlanRow {
        id: id.to_owned(),
        item: "Cabinet <b>".to_owned(),
        place: room.to_owned(),
        quantity: 2,
        measure: kind.name().to_owned(),
        measure_item: "what it is".to_owned(),
        kind,
        standing: Standing::In(Planned::LifeSafety),
        cost: [100.0, 120.0, 140.0],
        currency: "NZD".to_owned(),
        capacity_n: Some(4700.0),
        beta: 0.3,
        beta_is_assumed: true,
        capacity_confidence: Some(Confidence::Recalled),
        price_confidence: Confidence::Assumption,
        decision: Decision::Restrain,
        before: chance(0.5),
        effect: Some(Effect {
            overturn: chance(0.01),
            exceeded_ratio: Some(0.0),
            force_n: Some(800.0),
            levels: Vec::new(),
        }),
        rates: None,
        is_at_least: false,
        losses: None,
        benefit: None,
        life_safety: LifeSafety {
            rating: None,
            is_assumed: false,
        },
        object: Arc::new(object),
        fitting: Fitting {
            height_ratio: 0.9,
            anchors: Some(4),
            price: [10.0, 30.0],
            minutes: Some(40.0),
            work: Some(40.0),
            capacity_source: "a handbook".to_owned(),
            price_source: "an offer, 2025".to_owned(),
            note: String::new(),
        },
    }
}

fn plan(rows: Vec<PlanRow>) -> BudgetPlan {
    BudgetPlan {
        amount: 1e3,
        currency: "NZD".to_owned(),
        cost: 0.0,
        horizon_years: 50.0,
        discount_ratio: 0.03,
        is_horizon_assumed: true,
        has_rates: false,
        extends: false,
        has_costs: false,
        converted: None,
        unfunded: Unfunded {
            objects: 0,
            cost: 0.0,
        },
        without_measure: 0,
        not_restrained: 0,
        without_option: 0,
        is_optimal: true,
        rows,
    }
}

fn files(plan: &BudgetPlan, sites: Option<&[String]>) -> Vec<String> {
    let orders = orders(plan, sites).into_iter();
    orders.map(|order| order.file).collect()
}

/// Whatever a room is called, its order is a file of its own in the folder, on every system; what is not planned has none.
#[test]
fn every_room_has_a_file_of_its_own() {
    let rooms = ["../x", "CON", "con", "", "a/b", "a b", "仙台 1"];
    let mut rows: Vec<PlanRow> = rooms
        .iter()
        .map(|room| row("a", room, RestraintKind::Strap, |_| ()))
        .collect();
    let mut left = row("b", "elsewhere", RestraintKind::Strap, |_| ());
    left.standing = Standing::Out(NotPlanned::Unfunded);
    rows.push(left);
    let plan = plan(rows);
    let found = files(&plan, None);
    let expected = ["no-room", "x", "CON-", "a-b", "a-b-2", "con--2", "仙台-1"];
    assert_eq!(found, expected.map(|name| format!("orders/{name}.html")));
    // A room of the same name at another site is another room.
    let sites: Vec<String> = ["A", "A", "B", "A", "A", "A", "A", "A"]
        .map(str::to_owned)
        .into();
    assert!(files(&plan, Some(&sites)).contains(&"orders/B-con.html".to_owned()));
}

/// The forces are those of the assessment: 950 N of tension doubled in concrete and shared by two anchors at each edge,
/// and a bracket whose moment about the feet stays the same at another height.
#[test]
fn the_anchors_share_the_force_of_the_assessment() {
    let of = |row: &PlanRow| each_anchor(row);
    let base = row("a", "1", RestraintKind::BasePlate, |_| ());
    assert_eq!(
        of(&base),
        "of 2 along each edge, in concrete: tension 950 N, shear 205 N"
    );
    // 205 N at 1.35 m is 170.8 N at 1.62 m, a quarter on each of four; the 800 N of the simulated earthquakes are more.
    let stronger = row("a", "1", RestraintKind::Bracket, |_| ());
    assert!(of(&stronger).starts_with("200 N on each of 4 anchors, shared equally (assumed): 800 N in all (in the simulated earthquakes)"));
    let mut bracket = stronger;
    bracket.effect = None;
    assert!(of(&bracket).starts_with(
        "42.7 N on each of 4 anchors, shared equally (assumed): 171 N in all at 1.62 m"
    ));
    let without = row("a", "1", RestraintKind::Bracket, |object| {
        object.force = None
    });
    assert!(of(&without).starts_with("unknown"));
    let mut uncounted = bracket.clone();
    uncounted.fitting.anchors = None;
    assert!(of(&uncounted).starts_with("unknown"));
    let lock = row("a", "1", RestraintKind::WheelLock, |_| ());
    assert!(of(&lock).starts_with("none"));
}

/// An order names its object, shows it with its dimensions in the units of the list, and is a draft until the recalled
/// values are confirmed.
#[test]
fn an_order_can_be_given_away() {
    let plan = plan(vec![
        row("a", "Ward 3", RestraintKind::Strap, |_| ()),
        row("b", "Ward 3", RestraintKind::BasePlate, |object| {
            object.units = UnitSystem::Us;
            object.approximate_place = Some("Athens".to_owned());
        }),
        row("c", "Ward 3", RestraintKind::Chain, |object| {
            object.height_m = None
        }),
    ]);
    let orders = orders(&plan, None);
    let order = orders.first().unwrap();
    let write = |allows_recalled| {
        let signing = Signing { allows_recalled };
        page(&plan, order, &TitleBlock::default(), signing)
    };
    let draft = write(false);
    for said in [
        "a Cabinet &lt;b&gt; × 2",
        "1.8 m</text>",
        "50 mm to the wall</text>",
        "70.87 in</text>",
        "anchors 2.953 in from the edge (assumed)</text>",
        "There is no drawing",
        "DRAFT",
        "AS 1170.4-2007, section 8: R_c; capacity of base-plate",
        "; hazard of Athens",
        "10–30 NZD each: an offer, 2025 (confidence: assumption)",
        "40 min each, 80 min in all",
    ] {
        assert!(draft.contains(said), "{said}: {draft}");
    }
    assert!(!draft.contains("more than the median capacity"));
    let mut weak = row("a", "1", RestraintKind::Strap, |_| ());
    weak.capacity_n = Some(790.0);
    assert!(simulated(&weak).contains("more than the median capacity"));
    assert!(!draft.contains("Date and signature") && draft.matches("<svg").count() == 2);
    assert!(write(true).contains("Date and signature"));
}

/// The parts are added over rooms; one restraint whose anchors are not known leaves their sum unknown.
#[test]
fn the_parts_are_those_of_all_rooms() {
    let mut rows = vec![
        row("a", "1", RestraintKind::Strap, |_| ()),
        row("b", "2", RestraintKind::Strap, |_| ()),
        row("c", "2", RestraintKind::BasePlate, |_| ()),
    ];
    rows[2].fitting.anchors = None;
    let plan = plan(rows);
    let html = parts::page(&plan, &orders(&plan, None));
    assert!(html.contains("unknown") && html.contains("300–420") && html.contains("orders/2.html"));
    let csv = parts::csv(&plan).unwrap();
    let text = String::from_utf8(csv.as_ref().to_vec()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 3);
    assert!(
        lines[2].starts_with("strap,what it is,4,16,40,120,160,200,280,NZD,assumption,"),
        "{text}"
    );
    // Without anything to buy there are headings alone.
    let nothing = parts::csv(&super::tests::plan(Vec::new())).unwrap();
    assert_eq!(
        String::from_utf8(nothing.as_ref().to_vec())
            .unwrap()
            .lines()
            .count(),
        1
    );
}

/// Whoever reads the plan or fits a restraint sees the verdict, and why what may be left as it is was planned.
#[test]
fn a_plan_shows_the_verdict_of_each_object() {
    let mut left = row("a", "1", RestraintKind::Strap, |_| ());
    left.decision = Decision::Leave;
    left.standing = Standing::In(Planned::Pays);
    let mut plan = plan(vec![row("b", "1", RestraintKind::Strap, |_| ()), left]);
    (plan.not_restrained, plan.without_option) = (3, 1);
    let text = super::super::plan::plan_text(&plan);
    let html = super::super::plan::plan_html(&plan, &Markup::default()).0;
    for told in [&text, &html] {
        assert!(
            told.contains("Planned although the verdict is leave: 2 objects, because the restraint saves more than it costs."),
            "{told}"
        );
        assert!(told.contains("Not planned although the verdict is restrain: 3 objects."));
        assert!(told.contains("For 1 of these no restraint suits"), "{told}");
        assert!(
            told.contains("RESTRAIN") && told.contains("LEAVE"),
            "{told}"
        );
    }
    assert!(html.contains("planned: it pays"), "{html}");
    let order = &orders(&plan, None)[0];
    let page = page(&plan, order, &TitleBlock::default(), Signing::default());
    assert!(page.contains("LEAVE; planned: it pays"), "{page}");
}
