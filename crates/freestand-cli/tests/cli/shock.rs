//! `freestand shock`: landings, tolerances and test points.

use crate::{cases, folder, freestand, freestand_in};

pub(crate) const CABINET: [&str; 7] = [
    "shock",
    "--height",
    "2.3 m",
    "--thickness",
    "600 mm",
    "--mass",
    "140 kg",
];

fn cabinet(more: &[&str]) -> String {
    freestand(&[&CABINET, more].concat())
}

#[test]
fn shock_of_table_one() {
    insta::assert_snapshot!(cabinet(&[
        "--stiffness",
        "4380 N/mm",
        "--cg-rise",
        "16 mm",
        "--gravity",
        "9.81 m/s2"
    ]));
}

#[test]
fn shock_as_json_and_exceeded() {
    insta::assert_snapshot!(cabinet(&[
        "--pad-stiffness=2190 N/mm",
        "--pads-per-edge=2",
        "--rotation",
        "-0.05 rad",
        "--tolerance",
        "3 g",
        "--tolerance-duration",
        "11 ms",
        "--at",
        "0.3 m, 2 m",
        "--json",
    ]));
}

#[test]
fn shock_of_a_fall() {
    insta::assert_snapshot!(cabinet(&[
        "--scenario",
        "overturn-floor",
        "--contact-stiffness",
        "2000 N/mm",
        "-q"
    ]));
}

#[test]
fn shock_with_newtons_per_metre_is_warned_about() {
    insta::assert_snapshot!(cabinet(&["--stiffness", "4380 N/m", "--cg-rise", "16 mm"]));
}

#[test]
fn shock_refuses_bad_values_all_at_once() {
    insta::assert_snapshot!(freestand(&[
        "shock",
        "--height",
        "2.3",
        "--thickness",
        "-1 m",
        "--mass",
        "3 m",
        "--stiffness",
        "nan N/mm",
        "--cg-rise",
        "1 furlong",
    ]));
}

#[test]
fn shock_refuses_what_contradicts_itself() {
    let all = [
        cabinet(&["--stiffness", "4380 N/mm"]),
        cabinet(&["--cg-rise", "16 mm"]),
        cabinet(&["--stiffness", "4380 N/mm", "--cg-rise", "39 mm"]),
        cabinet(&["--pad-stiffness", "2190 N/mm", "--cg-rise", "16 mm"]),
        cabinet(&[
            "--stiffness",
            "4380 N/mm",
            "--cg-rise",
            "16 mm",
            "--rotation",
            "1 deg",
        ]),
        cabinet(&[
            "--scenario",
            "overturn-obstacle",
            "--contact-stiffness",
            "2000 N/mm",
            "--gap",
            "100 mm",
        ]),
        cabinet(&[
            "--drop-acceleration",
            "10 g",
            "--tolerance",
            "5 g",
            "--tolerance-duration",
            "11 ms",
        ]),
    ];
    cases::each("shock_refuses_what_contradicts_itself", &all);
}

/// V_c between 0.4 and 0.45 m/s, A_c between 3.5 and 4.5 g, and a landing with 0.451 m/s and 4.17
/// g.
const SHOCK_TESTS: &str = "velocity change [m/s],peak acceleration [g],damaged,method\n0.3,120,no,A\n0.4,160,no,A\n\
                           0.45,180,yes,A\n0.7,3.5,no,B\n0.7,4.5,yes,B\n";

#[test]
fn shock_beside_its_test_points() {
    let missing = SHOCK_TESTS.lines().take(4).collect::<Vec<_>>().join("\n");
    let turned = SHOCK_TESTS
        .replace("0.3,120,no", "0.3,120,yes")
        .replace("0.7,3.5,no,B", "0.7,3.5,perhaps,B");
    let contradictory = SHOCK_TESTS.replace("0.3,120,no", "0.3,120,yes");
    let folder = folder(&[
        ("tests.csv", SHOCK_TESTS),
        ("missing.csv", &missing),
        ("perhaps.csv", &turned),
        ("contradictory.csv", &contradictory),
    ]);
    let with = |more: &[&str]| {
        let landing = ["--stiffness", "4380 N/mm", "--uplift", "30 mm"];
        freestand_in(
            folder.path(),
            &[&CABINET[..], &landing, &["--damage-boundary"], more].concat(),
        )
    };
    let all = [
        with(&["tests.csv"]),
        with(&["tests.csv", "--json", "--out", "out"]),
        with(&["missing.csv"]),
        with(&["perhaps.csv"]),
        with(&["contradictory.csv"]),
        with(&["tests.csv", "--tolerance", "5 g"]),
    ];
    cases::each("shock_beside_its_test_points", &all);
    let manifest = std::fs::read_to_string(folder.path().join("out/manifest.json")).unwrap();
    assert!(
        manifest.contains("damage-boundary.svg") && manifest.contains("damage-boundary.png"),
        "{manifest}"
    );
}
