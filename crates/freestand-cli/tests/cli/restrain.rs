//! `freestand restrain`.

use crate::program::{document, refused};
use crate::{cases, folder, freestand, freestand_in};

const RACK: [&str; 7] = [
    "restrain",
    "--mass",
    "360kg",
    "--height",
    "1.8m",
    "--thickness",
    "0.6m",
];

#[test]
fn restrain_by_place_code_study_and_acceleration() {
    let study = "[ground]\nplace = \"Newcastle\"\n[building]\nstoreys = 8\n[restraint]\nresponse_ratio = 2.5\n";
    let folder = folder(&[("study.toml", study)]);
    let with = |more: &[&str]| freestand_in(folder.path(), &[&RACK[..], more].concat());
    let all = [
        with(&[
            "--place",
            "Athens",
            "--floor",
            "2",
            "--storeys",
            "5",
            "--width",
            "3 ft",
        ]),
        with(&[
            "--code",
            "asce7",
            "--sds",
            "1 g",
            "--resonance",
            "1.8",
            "--building-ductility",
            "1.5",
            "--json",
        ]),
        with(&[
            "--study",
            "study.toml",
            "--floor",
            "roof",
            "--anchors-per-edge",
            "3",
        ]),
        with(&["--floor-acceleration", "0.9 g", "--out", "out"]),
    ];
    cases::each("restrain_by_place_code_study_and_acceleration", &all);
    let sheet = std::fs::read_to_string(folder.path().join("out/restraint.html")).unwrap();
    assert!(
        sheet.contains("<svg") && sheet.contains("DRAFT") && !sheet.contains("Date and signature"),
        "a factor is to be confirmed: {sheet}"
    );
    let signed = [
        "--floor-acceleration",
        "0.9 g",
        "--allow-recalled",
        "--out",
        "signed",
    ];
    with(&signed);
    let sheet = std::fs::read_to_string(folder.path().join("signed/restraint.html")).unwrap();
    assert!(
        sheet.contains("Date and signature") && !sheet.contains("DRAFT"),
        "{sheet}"
    );
}

#[test]
fn restrain_refuses_what_it_cannot_know() {
    let with = |more: &[&str]| freestand(&[&RACK[..], more].concat());
    let all = [
        with(&[]),
        with(&["--place", "Wellinton"]),
        with(&["--sds", "1 g"]),
        with(&["--code", "asce7", "--place", "Wellington"]),
        with(&["--code", "nzs1170.5"]),
        with(&["--place", "Melbourne", "--importance", "0"]),
        with(&["--place", "Melbourne", "--strength", "2", "--floor", "3"]),
        with(&["--floor-acceleration", "1 g", "--place", "Melbourne"]),
        with(&["--study", "study.toml", "--sds", "1 g"]),
    ];
    cases::each("restrain_refuses_what_it_cannot_know", &all);
}

/// A row of a list has the numbers of its object alone; the others say why not.
#[test]
fn restrain_every_object_of_a_list() {
    const LIST: &str = "id,item,floor,height [mm],depth [mm],width [mm],base depth [mm],mass [kg],anchored\n\
        a,storage cabinet,2,1800,600,900,,360,no\n\
        b,emergency generator,Roof,1500,900,1800,700,900,no\n\
        c,fridge,2,1700,600,600,,,no\n\
        d,rack,2,2000,600,600,,300,yes\n\
        e,shelf,Penthouse,1.45,600,600,,,no\n\
        f,shelf,9,1450,600,600,,80,no\n";
    let study = "[ground]\nplace = \"Newcastle\"\n[building]\nstoreys = 8\n";
    let folder = folder(&[("list.csv", LIST), ("study.toml", study)]);
    let at = ["--place", "Wellington", "--storeys", "5"];
    let with = |more: &[&str]| freestand_in(folder.path(), &[&["restrain"], more].concat());
    let all = [
        with(&[&["list.csv"][..], &at, &["--out", "out"]].concat()),
        with(
            &[
                &["list.csv"][..],
                &at,
                &[
                    "--edit",
                    "H4=120",
                    "--units",
                    "us",
                    "--anchor-inset",
                    "2 in",
                ],
            ]
            .concat(),
        ),
        with(&["list.csv", "--floor-acceleration", "0.9 g"]),
        with(&["list.csv", "--study", "study.toml"]),
        with(&[&["list.csv"][..], &at, &["--mass", "80 kg"]].concat()),
        with(&[&["list.csv"][..], &at, &["--floor", "2"]].concat()),
        with(&["list.csv", "--place", "Wellington", "--strength", "2"]),
        with(&[
            "list.csv",
            "--floor-acceleration",
            "0.9 g",
            "--storeys",
            "5",
        ]),
        with(&[&RACK[1..], &at, &["--sheet", "Objects"]].concat()),
        with(
            &[
                &["list.csv"][..],
                &at,
                &[
                    "--pivot",
                    "feet",
                    "--anchor-inset",
                    "340 mm",
                    "--component",
                    "generator",
                ],
            ]
            .concat(),
        ),
        with(&[&["list.csv"][..], &at, &["--anchor", "M10"]].concat()),
        with(&[&["list.csv"][..], &at, &["--component", "gizmo"]].concat()),
    ];
    cases::each("restrain_every_object_of_a_list", &all);
    let told = |more: &[&str]| document(folder.path(), &[&["restrain"], more, &at[..]].concat());
    let alone = told(
        &[
            &RACK[1..],
            &["--width", "0.9m", "--component", "cabinet", "--floor", "2"],
        ]
        .concat(),
    );
    let listed = told(&["list.csv"]);
    for key in [
        "force_n",
        "force_ratio",
        "anchor_tension_n",
        "anchor_tension_concrete_n",
        "bracket_force_n",
        "axis",
    ] {
        assert_eq!(listed["rows"][0][key], alone[key], "{key}");
    }
    assert_eq!(
        (&listed["objects"], &listed["held"]),
        (&6.into(), &2.into())
    );
    // Feet that stand closer than the sides pull more.
    let generator = [
        "--mass",
        "900kg",
        "--height",
        "1.5m",
        "--thickness",
        "0.9m",
        "--width",
        "1.8m",
    ];
    let wide = told(
        &[
            &generator[..],
            &["--component", "generator", "--floor", "Roof"],
        ]
        .concat(),
    );
    assert_eq!(listed["rows"][1]["force_n"], wide["force_n"]);
    assert!(listed["rows"][1]["anchor_tension_n"].as_f64() > wide["anchor_tension_n"].as_f64());
}

/// A sheet for each object with a force, all objects in the workbook and the CSV.
#[test]
fn restrain_writes_a_list_to_print() {
    const LIST: &str = "id,item,floor,height [in],depth [in],width [in],weight [lb]\n\
        a,storage cabinet,2,72,24,36,800\nb,fridge,2,70,24,24,\n";
    let folder = folder(&[("list.csv", LIST)]);
    let anchor = ["--anchor", "M10", "--anchor-capacity", "1500 lbf"];
    let at = [
        "restrain",
        "list.csv",
        "--place",
        "Los Angeles",
        "--storeys",
        "5",
    ];
    let all = [freestand_in(
        folder.path(),
        &[&at[..], &anchor, &["--out", "out"]].concat(),
    )];
    cases::each("restrain_writes_a_list_to_print", &all);
    let read = |name: &str| std::fs::read(folder.path().join("out").join(name)).unwrap();
    let html = String::from_utf8(read("restraint.html")).unwrap();
    assert_eq!(html.matches("class=\"object\"").count(), 1, "{html}");
    assert!(html.contains("800 lb") && html.contains("its mass is not known"));
    assert!(read("restraint.xlsx").starts_with(b"PK"));
    let csv = String::from_utf8(read("restraint.csv")).unwrap();
    assert!(
        csv.contains("demand_capacity_ratio") && csv.lines().count() == 3,
        "{csv}"
    );
}

/// A list that is not there is said before what else is missing.
#[test]
fn a_list_that_is_missing_is_said_first() {
    let folder = folder(&[(
        "list.csv",
        "id,height [m],thickness [m],mass [kg]\na,1.8,0.6,360\n",
    )]);
    let said = |list: &str| refused(folder.path(), &["restrain", list]);
    assert!(
        said("nosuch.csv").contains("nosuch.csv: cannot open the file"),
        "{}",
        said("nosuch.csv")
    );
    assert!(
        said("list.csv").contains("how strongly the floor shakes"),
        "{}",
        said("list.csv")
    );
}
