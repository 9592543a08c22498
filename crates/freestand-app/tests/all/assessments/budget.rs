//! A list with a budget: the plan in every output.

use freestand_app::job::{Beside, Job, Spending, Told, assess_telling};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_inventory::CellsRequest;
use freestand_output::answer::Answer as _;
use freestand_risk::budget::{Budget, BudgetRequest};
use freestand_study::resolve::resolve;
use freestand_study::run::no_progress;

const LIST: &str = "id,item,quantity,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],wall_gap [mm],\
                    replacement_cost [NZD],life_safety\n\
                    gas,Oxygen cylinder,2,0.5,1520,230,230,78,,400,\n\
                    shelf,Bookcase,1,1,2000,350,900,120,0,90000,L\n\
                    table,Table,1,1,700,900,1500,60,0,900,\n";

const STUDY: &str = "[ground]\ncode = \"nzs1170.5\"\nsite = \"C\"\nhazard_factor = 0.4\n[building]\nstoreys = 5\n\
                     [worlds]\nfirst = 20\nmost = 80\nshares = false\n";

/// Both objects that fall are planned, the cylinder for the sake of people; the plan costs no more than the budget, and is the
/// same in `plan.csv`, in the document and in the report. With less money the dearer one is left, and with less still what
/// people need is said to be unfunded.
#[test]
fn a_plan_is_in_every_output() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(&path, LIST).unwrap();
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let inventory = inventory_of(&study, Some(&path), &ListRequest::default()).unwrap();
    let planned = |amount: &str| {
        let request = BudgetRequest {
            budget: freestand_risk::amount(amount).unwrap(),
            horizon_years: None,
            discount_ratio: None,
            restraints: None,
            cells: CellsRequest::default(),
        };
        let budget = Budget::new(&request, &path, inventory.units).unwrap();
        let out = folder.path().join(amount);
        let job = Job::default();
        let report = assess_telling(
            &study,
            &inventory,
            &out,
            &job,
            Beside {
                spending: Some(Spending::Planned(&budget)),
                earlier: None,
            },
            Told::default(),
            &no_progress,
        )
        .unwrap();
        (report, out)
    };
    let (report, out) = planned("900 NZD");
    let plan = report.plan.as_ref().unwrap();
    let named: Vec<(&str, &str)> = plan
        .iter()
        .map(|row| (row.id.as_str(), row.standing.name()))
        .collect();
    assert_eq!(named, [("gas", "life-safety"), ("shelf", "pays")]);
    let cost: f64 = plan.iter().map(|row| row.cost[1]).sum();
    assert!(cost <= 900.0);
    for row in plan {
        let after = row.effect.as_ref().unwrap().overturn;
        assert!(after.value < row.before.value && row.after_high() >= Some(after.high));
    }
    let csv = std::fs::read_to_string(out.join("plan.csv")).unwrap();
    let mut lines = csv.lines();
    let heads: Vec<&str> = lines.next().unwrap().split(',').collect();
    let keys: Vec<String> = plan[0]
        .facts()
        .named()
        .map(|(name, _)| name.to_owned())
        .collect();
    assert_eq!(heads, keys);
    assert_eq!(lines.count(), plan.len());
    let html = std::fs::read_to_string(out.join("report.html")).unwrap();
    for said in [
        "The plan within the budget",
        "cylinder-chain",
        "does not rate the life safety of gas",
    ] {
        assert!(html.contains(said), "{said}");
    }
    // The list has no rooms: what is fitted is in one order, which the report links to. Nobody has read the capacities.
    let order = std::fs::read_to_string(out.join("orders/no-room.html")).unwrap();
    assert!(html.contains("href=\"orders/no-room.html\"") && html.contains("DRAFT"));
    assert!(order.contains("gas Oxygen cylinder × 2") && order.contains("shelf Bookcase"));
    assert!(order.contains("DRAFT") && !order.contains("Date and signature"));
    assert!(report.files.iter().any(|name| name == "parts.csv"));
    let (report, out) = planned("20 NZD");
    assert!(!out.join("orders").exists());
    let nothing = std::fs::read_to_string(out.join("parts.html")).unwrap();
    assert!(nothing.contains("nothing to buy"));
    let html = std::fs::read_to_string(out.join("report.html")).unwrap();
    let first = html.find("Unfunded life safety").unwrap();
    assert!(first < html.find("The first ten").unwrap());
    assert!(report.plan.as_ref().unwrap().is_empty());
    assert_eq!(report.budget.as_ref().unwrap().unfunded.objects, 2);
    let text = freestand_report::assessment::assessment_text(&report);
    assert!(text.contains("Unfunded life safety: 2 objects"), "{text}");
}
