//! Buildings whose storeys or modes come from tables.

use super::*;

const TOWER: &str =
    "storey,height [m],mass [t],stiffness [kN/mm]\n1,4,100,300\n2,3,100,200\n3,3,60,200\n";
const MODES: &str =
    "period [s],participation,damping [%],5 m,10 m\n0.8,1.3,2,0.5,1\n0.3,-0.3,,-1.2,1\n";

fn in_folder(building: &str) -> Result<Study, Problems> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tower.csv"), TOWER).unwrap();
    std::fs::write(folder.path().join("modes.csv"), MODES).unwrap();
    std::fs::write(
        folder.path().join("broken.csv"),
        TOWER.replace("60,200", "0,200"),
    )
    .unwrap();
    resolve(building, Some(Path::new("s.toml")), folder.path())
}

/// Damping without effect is refused where it is written, but not where it is inherited.
#[test]
fn damping_beside_a_table_that_has_its_own_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("own.csv"),
        MODES.replace("-0.3,,", "-0.3,4,"),
    )
    .unwrap();
    std::fs::write(folder.path().join("some.csv"), MODES).unwrap();
    let said =
        |building: &str| match resolve(&format!("[building]\n{building}"), None, folder.path()) {
            Ok(study) => Ok(study.building.unwrap()),
            Err(error) => Err(error
                .problems
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()),
        };
    let unused = |key: &str, line: usize| {
        format!("line {line}: {key} is not used: the table states the damping of every mode")
    };
    let both =
        said("mode_table = \"own.csv\"\ndamping = 0.05\nrayleigh_modes = [1, 2]\n").unwrap_err();
    assert_eq!(both, [unused("damping", 3), unused("rayleigh_modes", 4)]);
    let across =
        said("mode_table = \"some.csv\"\nacross = { mode_table = \"own.csv\", damping = 0.03 }\n");
    assert_eq!(across.unwrap_err(), [unused("across damping", 3)]);
    assert!(said("mode_table = \"own.csv\"\n").is_ok());
    let inherited =
        said("mode_table = \"some.csv\"\ndamping = 0.03\nacross = { mode_table = \"own.csv\" }\n")
            .unwrap();
    assert_eq!(inherited.along.modes()[1].damping_ratio(), 0.03);
    assert_eq!(inherited.across.unwrap().modes()[1].damping_ratio(), 0.04);
}

/// The study of the outputs names every table where it lies, though both axes read one.
#[test]
fn one_table_of_both_axes_is_a_table_of_each_that_names_it() {
    let of = |building: &str| in_folder(building).unwrap().building.unwrap().tables.len();
    assert_eq!(
        of("[building]\nmode_table = \"modes.csv\"\nacross = { mode_table = \"modes.csv\" }\n"),
        2
    );
    assert_eq!(
        of("[building]\nmode_table = \"modes.csv\"\nacross = { damping = 0.02 }\n"),
        1
    );
}

#[test]
fn buildings_come_from_tables_on_either_axis() {
    let text = "[building]\nstorey_table = \"tower.csv\"\ndamping = 0.03\nrayleigh_modes = [1, 2]\n\
                across = { mode_table = \"modes.csv\" }\n";
    let building = in_folder(text).unwrap().building.unwrap();
    assert_eq!(
        (
            building.storeys,
            building.height_m,
            building.storey_height_m
        ),
        (3, 10.0, None)
    );
    assert_eq!(building.along.modes().len(), 3);
    let [first, second, third] = [0, 1, 2].map(|i| building.along.modes()[i].damping_ratio());
    assert!((first - 0.03).abs() < 1e-15 && (second - 0.03).abs() < 1e-15 && third > 0.031);
    let across = building.across.unwrap();
    // Two modes and Rayleigh damping at both, but for the mode that says its own.
    assert_eq!(across.modes()[0].damping_ratio(), 0.02);
    assert!((across.modes()[1].damping_ratio() - 0.03).abs() < 1e-15);
    let tables: Vec<(bool, &str)> = building
        .tables
        .iter()
        .map(|table| (table.is_across, table.key))
        .collect();
    assert_eq!(tables, [(false, "storey_table"), (true, "mode_table")]);

    let text = "[building]\nperiod = \"2 s\"\nshear_flexure = 3\nmodes = 4\nacross = { period = \"1 s\" }\n";
    let building = in_folder(text).unwrap().building.unwrap();
    let across = building.across.unwrap();
    assert_eq!(
        (
            across.period_s(),
            across.shear_flexure_ratio(),
            across.modes().len()
        ),
        (1.0, Some(3.0), 4)
    );
    // A beam beside a table takes the table's height.
    let text = "[building]\nstorey_table = \"tower.csv\"\nacross = { frame = \"other\" }\n";
    let building = in_folder(text).unwrap().building.unwrap();
    // 1.25 · 0.05 · 10^0.75.
    assert!((building.across.unwrap().period_s() - 0.0625 * 10f64.powf(0.75)).abs() < 1e-15);
}

#[test]
fn wrong_tables_of_buildings_are_refused_where_they_are_wrong() {
    let said = |building: &str| -> Vec<String> {
        in_folder(&format!("[building]\n{building}\n"))
            .unwrap_err()
            .problems
            .iter()
            .map(ToString::to_string)
            .collect()
    };
    let ends = |building: &str, expected: &str| {
        let got = said(building);
        assert!(
            got.len() == 1 && got[0].ends_with(expected),
            "{building}: {got:?}"
        );
    };
    ends(
        "storey_table = \"broken.csv\"",
        "broken.csv:4: the mass of storey 3 must be positive and finite, not 0",
    );
    ends(
        "storey_table = \"tower.csv\"\nstoreys = 3",
        "s.toml:3: storey_table and storeys exclude each other",
    );
    ends(
        "mode_table = \"modes.csv\"\nmodes = 2",
        "s.toml:3: modes and mode_table exclude each other",
    );
    ends(
        "mode_table = \"modes.csv\"\nstorey_table = \"tower.csv\"",
        "s.toml:3: storey_table and mode_table exclude each other",
    );
    ends(
        "storey_table = \"tower.csv\"\nmodes = 4",
        "/tower.csv: the number of modes must be 1 to 3, not 4",
    );
    assert!(
        said("storey_table = \"tower.csv\"\nmodes = 4")[0].starts_with("s.toml:2: storey_table: ")
    );
    ends(
        "rayleigh_modes = [1]",
        "s.toml:2: rayleigh_modes must be two mode numbers, not \"1\"",
    );
    ends(
        "rayleigh_modes = [1, 11]",
        "among the first 10, not 1 and 11",
    );
    ends(
        "storeys = 2\nacross = { storey_table = \"tower.csv\" }",
        "s.toml:3: the building is 10 m high across, but 6.4 m high along its first axis",
    );
    ends(
        "storey_height = 3.2",
        "s.toml:2: storey_height: \"3.2\" needs a unit",
    );
    ends(
        "across = { period = 3 }",
        "s.toml:2: across period: \"3\" needs a unit",
    );
    let none = said("storey_table = \"none.csv\"");
    assert!(none[0].starts_with("s.toml:2: storey_table: "), "{none:?}");
    assert!(
        none[0].contains("/none.csv: cannot open the file"),
        "{none:?}"
    );
    let both = said("period = \"0 s\"\nacross = { damping = 2 }");
    assert_eq!(both.len(), 2, "{both:?}");
}
