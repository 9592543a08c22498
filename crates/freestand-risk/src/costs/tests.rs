//! Tables of costs and measures: tests.

use super::*;

fn costs(text: &str) -> Result<Costs, Problems> {
    read_costs(text.as_bytes(), Path::new("i.csv"))
}

/// The only problem.
fn only<T>(result: Result<T, Problems>) -> Problem {
    let problems = result.err().unwrap();
    assert_eq!(problems.len(), 1, "{problems}");
    problems.problems[0].clone()
}

#[test]
fn what_is_missing_is_listed_and_not_guessed() {
    let read = costs(
        "id,item,quantity,repair_cost [AUD],replacement_cost [AUD],downtime [day],downtime_cost [AUD/day]\n\
         a,rack,3,1000,5000,2,100\nb,cabinet,,,,2,\n",
    )
    .unwrap();
    assert_eq!(
        (read.currency.as_deref(), read.rows[0].overturned()),
        (Some("AUD"), 5200.0)
    );
    assert_eq!(read.rows[0].not_counted(), [NotCounted::Casualties]);
    assert_eq!(
        (read.rows[1].quantity, read.rows[1].has_costs()),
        (1.0, false)
    );
    assert_eq!(
        read.rows[1].not_counted(),
        [
            NotCounted::Repair,
            NotCounted::Replacement,
            NotCounted::Downtime,
            NotCounted::Casualties
        ]
    );
}

#[test]
fn what_counts_for_nothing_is_said() {
    let doubts = |text: &str| costs(text).unwrap().doubts;
    assert_eq!(
        doubts("ID,Item,Quantity,Repair cost [AUD],floor\na,x,2,100,1\n"),
        []
    );
    assert_eq!(
        costs("id,Repair cost [AUD]\na,100\n").unwrap().rows[0].repair,
        Some(100.0)
    );
    let path = PathBuf::from("i.csv");
    let unused = |heading: &str, near: Option<&str>| UnusedColumn {
        heading: heading.to_owned(),
        near: near.map(str::to_owned),
    };
    assert_eq!(
        doubts("id,qty,repair_costs [AUD]\na,2,5\n"),
        [CostDoubt::Unused {
            path: path.clone(),
            columns: vec![
                unused("qty", None),
                unused("repair_costs [AUD]", Some("repair_cost"))
            ],
        }]
    );
    assert_eq!(
        doubts("id,quantity\na,\nb,3\n"),
        [CostDoubt::NoQuantity {
            path: path.clone(),
            rows: 1
        }]
    );
    assert_eq!(
        doubts("id,repair_cost [AUD],replacement_cost [AUD]\na,100,5\n"),
        [CostDoubt::DearRepair {
            path,
            line: 2,
            id: "a".to_owned()
        }]
    );
}

#[test]
fn what_is_wrong_is_said_with_line_and_column() {
    let cases = [
        (
            "id,repair_cost [AUD],replacement_cost [USD]\na,1,2\n",
            "is in USD, and other costs are in AUD",
        ),
        ("id,repair_cost\na,1\n", "states no currency"),
        ("id,downtime_cost [AUD]\na,1\n", "states no currency"),
        ("id,repair_cost [AUD]\na,-1\n", "i.csv:2: column 2"),
        ("id,repair_cost [AUD]\na,1\na,2\n", "i.csv:3: column 1"),
        ("id,downtime [h]\na,1\n", "is not in day"),
        (
            "id,casualty_probability\na,1.5\n",
            "i.csv:2: column 2 (\"casualty_probability\"): 1.5 is not a probability",
        ),
        ("id,accepted_annual_rate\na,1e-4\n", "is not in 1/yr"),
        (
            "id,floor\na,1.5\n",
            "i.csv:2: column 2 (\"floor\"): \"1.5\" is not the number of a floor",
        ),
        ("id,longitude,latitude\na,151,-133\n", "i.csv:2: column 3"),
        (
            "id,longitude,latitude\na,151,\n",
            "the row has a longitude but no latitude",
        ),
    ];
    for (text, said) in cases {
        let problem = only(costs(text));
        assert!(
            problem.to_string().contains(said) && problem.hint.is_some(),
            "{said}: {problem}"
        );
    }
    let options = |text: &str| {
        read_options(text.as_bytes(), Path::new("o.csv"), Some("AUD"), |_| {
            Ok(None)
        })
    };
    let fine =
        options("id,option,cost [AUD],median_factor,life [yr]\na,strap,100,3,15\na,pad,50,1.2,\n")
            .unwrap()
            .rows;
    assert_eq!(
        (fine.len(), fine[0].life_years, fine[1].life_years),
        (2, Some(15.0), None)
    );
    let cases = [
        (
            "id,option,cost [USD],median_factor\na,strap,100,3\n",
            "is in USD",
        ),
        (
            "id,option,cost [AUD],stiffness\na,pad,100,3\n",
            "states no unit",
        ),
        (
            "id,option,cost [AUD],stiffness [kg]\na,pad,100,3\n",
            "o.csv:2: column 4 (\"stiffness [kg]\")",
        ),
        (
            "id,option,cost [AUD],mass [kg]\na,pad,100,-3\n",
            "o.csv:2: column 4",
        ),
        (
            "id,option,cost [AUD],mass [kg],median_factor\na,pad,100,3,2\n",
            "\"pad\" of a has more than one effect",
        ),
        (
            "id,option,cost [AUD],median_factor\na,strap,100,\n",
            "o.csv:2: column 2 (\"option\"): the option \"strap\"",
        ),
        (
            "id,option,cost [AUD],median_factor\na,strap,-100,3\n",
            "o.csv:2: column 3",
        ),
        (
            "id,option,cost [AUD],median_factor\na,strap,,3\n",
            "o.csv:2: column 3 (\"cost [AUD]\"): the cell is empty",
        ),
        (
            "id,option,cost [AUD],median_factor\na,strap,1,2\na,strap,2,3\n",
            "o.csv:3: column 2",
        ),
        (
            "id,option,cost [AUD],curves\na,strap,100,none.csv\n",
            "o.csv:2: column 4 (\"curves\"): the curves cannot",
        ),
    ];
    for (text, said) in cases {
        let problem = only(options(text));
        assert!(
            problem.to_string().contains(said) && problem.hint.is_some(),
            "{said}: {problem}"
        );
    }
}

/// All wrong cells are reported at once, also two in one row.
#[test]
fn all_wrong_rows_are_told_at_once() {
    let lines = |problems: Problems| -> Vec<Option<usize>> {
        problems
            .problems
            .iter()
            .map(|problem| problem.line)
            .collect()
    };
    let text = "id,quantity,repair_cost [AUD],floor\na,x,-1,0\nb,1,1,1\n,1,1,1.5\nb,1,1,\n";
    assert_eq!(
        lines(costs(text).unwrap_err()),
        [Some(2), Some(2), Some(4), Some(4), Some(5)]
    );
    let text = "id,downtime [h],repair_cost\na,1,1\n";
    assert_eq!(costs(text).unwrap_err().len(), 2, "both headings");
    let text =
        "id,option,cost [AUD],median_factor,life [yr]\na,strap,-1,2,0\na,pad,1,0,\nb,,1,2,\n";
    let read = read_options(text.as_bytes(), Path::new("o.csv"), Some("AUD"), |_| {
        Ok(None)
    });
    assert_eq!(
        lines(read.err().unwrap()),
        [Some(2), Some(2), Some(3), Some(4)]
    );
}

#[test]
fn an_option_that_changes_its_object_has_curves_of_its_own() {
    let text = "id,option,cost [AUD],stiffness [N/mm],base_thickness [cm]\na,pad,100,300,60\n";
    let mut seen = Vec::new();
    let rows = read_options(text.as_bytes(), Path::new("o.csv"), None, |object| {
        seen.push(object);
        Ok(Some(Effect::MedianFactor(1.0)))
    });
    let change = Change {
        stiffness_n_m: Some(3e5),
        base_thickness_m: Some(0.6),
        mass_kg: None,
    };
    let (id, curve_id, file) = ("a".to_owned(), "a/pad".to_owned(), PathBuf::from("o.csv"));
    assert_eq!(
        seen,
        [ChangedObject {
            id,
            curve_id,
            change,
            file,
            line: 2
        }]
    );
    assert_eq!(rows.unwrap().rows.len(), 1);
}
