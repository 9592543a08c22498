use std::ops::ControlFlow;

use super::*;
use crate::recorded::{MotionFiles, Second};
use crate::resolve::{Overrides, resolve};
use crate::result::Ranked;
use crate::run::{Step, no_progress};
use freestand_records::formats::ReadOptions;
use freestand_records::processing::Processing;

/// Two motions, two objects, one level: quick, and one of the objects rocks.
const STUDY: &str = "\
[ground]
count = 2
[building]
damping = 0.05
period_s = 1.92
levels = [1.0]
[objects]
heights = \"1.5 m, 2 m\"
thicknesses = \"500 mm\"
";

fn parsed(texts: &[&str]) -> Vec<Variation> {
    texts
        .iter()
        .map(|text| parse_variation(text).unwrap())
        .collect()
}

fn sensitivity(texts: &[&str]) -> Sensitivity {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let base = run(&study, &no_progress).unwrap();
    vary(
        &study,
        &base,
        &parsed(texts),
        &Overrides::default(),
        &|_, _, _| {},
        &no_progress,
    )
    .unwrap()
}

/// A change gives the same bits as a study with the changed value: nothing else changes.
#[test]
fn a_variation_changes_one_value() {
    let result = sensitivity(&["damping = 2 %", "seed = 2"]);
    let [base, softer, second] = &result.rows[..] else {
        panic!("{:?}", result.rows)
    };
    let numbers = |row: &VariedLevel| {
        (
            row.pfa_g_median,
            row.overturned_share,
            row.edge_acceleration_g_max,
        )
    };
    assert_eq!((base.parameter.as_str(), base.value.as_str()), ("base", ""));
    let study = resolve(&STUDY.replace("0.05", "0.02"), None, "".as_ref()).unwrap();
    let alone = run(&study, &no_progress).unwrap();
    assert_eq!(
        numbers(&rows("base", "", &study, &alone, &alone)[0]),
        numbers(softer)
    );
    assert_ne!(numbers(base), numbers(second));
    assert!(
        base.edge_acceleration_ratio
            .is_none_or(|ratio| ratio == 1.0),
        "{base:?}"
    );
    // Less damping, more acceleration at the roof.
    assert!(softer.pfa_g_median > base.pfa_g_median);
}

fn reason(row: &VariedLevel) -> &NoResult {
    row.reason.as_ref().unwrap()
}

fn not_varied(key: &'static str, why: WhyNotVaried) -> NotVaried {
    NotVaried { key, why }
}

/// A folder with a study and its files.
fn in_folder(
    study: &str,
    files: &[(&str, &str)],
    overrides: &Overrides,
) -> (tempfile::TempDir, Study) {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let source = folder.path().join("s.toml");
    let study = resolve_with(study, Some(&source), folder.path(), overrides).unwrap();
    (folder, study)
}

fn varied(study: &Study, texts: &[&str], overrides: &Overrides) -> Sensitivity {
    let base = run(study, &no_progress).unwrap();
    vary(
        study,
        &base,
        &parsed(texts),
        overrides,
        &|_, _, _| {},
        &no_progress,
    )
    .unwrap()
}

/// One motion, one object, one level.
fn quick(ground: &str, building: &str) -> String {
    format!(
        "[ground]\n{ground}\n[building]\n{building}\nlevels = [1.0]\n[objects]\nheights = \"1.5 m\"\n\
         thicknesses = \"500 mm\"\n"
    )
}

const EUROCODE: &str =
    "count = 1\ncode = \"ec8\"\nspectrum_type = 1\nsite = \"C\"\nground_acceleration = \"0.2 g\"";
const STOREYS: (&str, &str) = (
    "x.csv",
    "height [m],mass [t],stiffness [kN/mm]\n3,100,90\n3,80,90\n3,60,90\n",
);
const PULSE: (&str, &str) = (
    "pulse.csv",
    "time [s],a [g]\n0,0\n0.1,0.4\n0.2,-0.4\n0.3,0\n0.4,0\n",
);

/// A change that does not reach the model is reported, not run: zero sensitivity would mislead.
#[test]
fn what_does_not_reach_the_model_is_said() {
    let own = sensitivity(&["damping = 5 %", "seed = 1", "mass = 150 kg"]);
    let annex = format!("{EUROCODE}\nsoil_factor = 1.2\ncorner_periods = \"0.1 s, 0.4 s, 2 s\"");
    let (_one, annexed) = in_folder(&quick(&annex, ""), &[], &Overrides::default());
    let (_two, least) = in_folder(
        &quick("count = 1\nhazard_factor = 0.04", ""),
        &[],
        &Overrides::default(),
    );
    let annex = varied(&annexed, &["site = B", "site"], &Overrides::default());
    let least = varied(
        &least,
        &["hazard_factor = 0.05", "hazard_factor = 0.2"],
        &Overrides::default(),
    );
    for (row, same) in own.rows[1..]
        .iter()
        .zip([Same::Modes, Same::Motions, Same::Objects])
    {
        assert_eq!(reason(row), &NoResult::Unchanged(same));
        assert_eq!((row.pfa_g_median, row.uplift_share), (None, None));
    }
    assert_eq!(
        (own.rows.len(), annex.rows.len(), least.rows.len()),
        (4, 2, 3)
    );
    assert_eq!(reason(&annex.rows[1]), &NoResult::Unchanged(Same::Motions));
    assert_eq!(reason(&least.rows[1]), &NoResult::Unchanged(Same::Motions));
    assert!(
        least.rows[2].reason.is_none() && least.rows[2].pfa_g_median > least.rows[0].pfa_g_median
    );

    // Default values without effect are left out, and that is reported once.
    let defaults = varied(&annexed, &["site"], &Overrides::default());
    assert_eq!(defaults.rows.len(), 1);
    assert_eq!(
        defaults.left_out,
        [not_varied("site", WhyNotVaried::DefaultsChangeNothing)]
    );
}

#[test]
fn damping_of_a_table_and_records_of_the_command_line_are_not_varied() {
    let modes =
        "period [s],participation,damping [%],5 m,10 m\n0.8,1.3,2,0.5,1\n0.3,-0.3,3,-1.2,1\n";
    let files = [("m.csv", modes), PULSE];
    let (folder, study) = in_folder(
        &quick("count = 1", "mode_table = \"m.csv\""),
        &files,
        &Overrides::default(),
    );
    let (list, left_out) = changes(
        &study,
        &parsed(&["damping", "damping = 2 %", "period"]),
        &Overrides::default(),
    );
    assert_eq!(list, []);
    let damping = not_varied("damping", WhyNotVaried::DampingOfTable);
    let period = not_varied("period", WhyNotVaried::BuildingOfTable);
    assert_eq!(left_out, [damping, damping, period]);

    let motions = MotionFiles {
        paths: vec![folder.path().join("pulse.csv")],
        read: ReadOptions::default(),
        component: None,
        second: Second::None,
        vertical: Default::default(),
        processing: Processing::default(),
    };
    let overrides = Overrides {
        motions: Some(motions),
        ..Overrides::default()
    };
    let study = resolve_with(
        &study.toml,
        study.source.as_deref(),
        folder.path(),
        &overrides,
    )
    .unwrap();
    let (list, left_out) = changes(&study, &parsed(&["scale = 2", "seed"]), &overrides);
    assert_eq!((list.len(), left_out.len()), (0, 2));
    assert_eq!(left_out[0].why, WhyNotVaried::OtherMotions);
}

#[test]
fn a_table_of_storeys_is_varied_in_its_damping_and_modes() {
    let building = "storey_table = \"x.csv\"\ndamping = \"5 %\"";
    let (_folder, study) = in_folder(
        &quick("count = 1", building),
        &[STOREYS],
        &Overrides::default(),
    );
    let (list, left_out) = changes(&study, &default_variations(), &Overrides::default());
    let count = |key: &str| list.iter().filter(|change| change.key == key).count();
    assert_eq!(
        (count("damping"), count("seed"), count("site"), list.len()),
        (4, 4, 4, 12)
    );
    assert_eq!(left_out.len(), 2, "{left_out:?}");
    let result = varied(
        &study,
        &["damping = 1 %", "modes = 1, 3"],
        &Overrides::default(),
    );
    let [base, softer, one, all] = &result.rows[..] else {
        panic!("{:?}", result.rows)
    };
    assert!(softer.pfa_g_median > base.pfa_g_median);
    assert!(one.reason.is_none() && one.pfa_g_median != base.pfa_g_median);
    assert_eq!(reason(all), &NoResult::Unchanged(Same::Modes));
}

/// Only two modes have the damping that is written; that value is the base again.
#[test]
fn rayleigh_damping_is_varied_without_its_own_value() {
    let building = "storey_table = \"x.csv\"\ndamping = \"5 %\"\nrayleigh_modes = [1, 2]";
    let (_folder, study) = in_folder(
        &quick("count = 1", building),
        &[STOREYS],
        &Overrides::default(),
    );
    let result = varied(&study, &["damping"], &Overrides::default());
    let values: Vec<&str> = result.rows.iter().map(|row| row.value.as_str()).collect();
    assert_eq!(
        (values, result.left_out.len()),
        (vec!["", "2 %", "3 %", "7 %", "10 %"], 0)
    );
    assert!(result.rows[1].pfa_g_median > result.rows[4].pfa_g_median);
}

#[test]
fn ground_types_of_eurocode_8_are_varied() {
    let (_folder, study) = in_folder(&quick(EUROCODE, ""), &[], &Overrides::default());
    let result = varied(
        &study,
        &["site", "importance_factor = 1, 1.4"],
        &Overrides::default(),
    );
    let values: Vec<&str> = result.rows.iter().map(|row| row.value.as_str()).collect();
    assert_eq!(values, ["", "A", "B", "D", "E", "1", "1.4"]);
    // Rock against the base on soft ground; 1 is the default importance.
    assert!(result.rows[1].pfa_g_median < result.rows[0].pfa_g_median);
    assert!(
        result.rows[5].reason.is_some()
            && result.rows[6].pfa_g_median > result.rows[0].pfa_g_median
    );
}

#[test]
fn records_are_scaled_and_the_rest_of_the_ground_left() {
    let ground = "motions = [\"pulse.csv\"]";
    let (_folder, study) = in_folder(
        &quick(ground, "period = \"1 s\""),
        &[PULSE],
        &Overrides::default(),
    );
    let (list, left_out) = changes(&study, &default_variations(), &Overrides::default());
    assert!(
        list.iter().all(|change| change.table == "building") && left_out.len() == 2,
        "{left_out:?}"
    );
    let result = varied(&study, &["scale = 1, 2"], &Overrides::default());
    let [base, same, double] = &result.rows[..] else {
        panic!("{:?}", result.rows)
    };
    assert!(same.reason.is_some());
    // The building is linear: to the last bits.
    let ratio = double.pfa_g_median.unwrap() / base.pfa_g_median.unwrap();
    assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
}

/// A row has the doubts of its change, without those of the base.
#[test]
fn doubts_of_variations_are_kept() {
    let (_folder, study) = in_folder(&quick(EUROCODE, ""), &[], &Overrides::default());
    let mut base = run(&study, &no_progress).unwrap();
    let mut more = base.clone();
    let doubts = |result: &StudyResult, base: &StudyResult| {
        rows("key", "1", &study, result, base)[0].doubts.clone()
    };
    assert_eq!(doubts(&more, &base), []);
    let [one, two] = [1.2, 1.3].map(StudyDoubt::HighPeak);
    more.doubts.extend([one.clone(), two.clone()]);
    assert_eq!(doubts(&more, &base), [one.clone(), two.clone()]);
    base.doubts.push(one);
    assert_eq!(doubts(&more, &base), [two]);
}

/// There is no ratio to a tiny shock: a result with its shocks a hundred thousand times smaller.
#[test]
fn a_ratio_needs_a_base() {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let result = run(&study, &no_progress).unwrap();
    let row = &rows("key", "1", &study, &result, &result)[0];
    assert_eq!(row.edge_acceleration_ratio, Some(1.0));
    let mut small = result.clone();
    for statistics in small.levels[0].statistics.iter_mut().flatten() {
        if let [_, Ranked::Value(g), _] = &mut statistics.edge_acceleration_g {
            *g *= 1e-5;
        }
    }
    let row = &rows("key", "1", &study, &result, &small)[0];
    assert_eq!(
        (row.edge_acceleration_ratio, row.compared_objects.is_some()),
        (None, true)
    );
}

#[test]
fn what_does_not_apply_is_said_and_what_fails_is_a_row() {
    let result = sensitivity(&["period = 3 s", "shear-flexure = -1", "scale"]);
    assert_eq!(result.rows.len(), 3);
    assert!(result.rows[1].reason.is_none());
    let reason = reason(&result.rows[2]);
    assert!(
        matches!(reason, NoResult::Failed(why) if why.contains("shear_flexure must be 0 or more")),
        "{reason:?}"
    );
    assert_eq!(result.rows[2].pfa_g_median, None);
    assert_eq!(
        result.left_out,
        [not_varied("scale", WhyNotVaried::Synthetic)]
    );
}

#[test]
fn default_values_leave_out_the_studys_own() {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let (changes, left_out) = changes(&study, &default_variations(), &Overrides::default());
    let words: Vec<String> = changes.iter().map(Change::words).collect();
    assert!(left_out.is_empty());
    assert!(
        words.contains(&"damping = 2 %".to_owned()) && !words.contains(&"damping = 5 %".to_owned())
    );
    assert!(words.contains(&"site = Ae".to_owned()) && !words.contains(&"site = De".to_owned()));
}

#[test]
fn a_stopped_run_stops_the_variations() {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let base = run(&study, &no_progress).unwrap();
    let stop = |_: Step| ControlFlow::Break(());
    let error = vary(
        &study,
        &base,
        &parsed(&["damping"]),
        &Overrides::default(),
        &|_, _, _| {},
        &stop,
    )
    .unwrap_err();
    assert!(error.is_stopped(), "{error}");
}

#[test]
fn variations_are_forgiving_in_spelling_and_strict_in_words() {
    assert_eq!(
        parse_variation("building.shear-flexure = 0, 20"),
        parse_variation("shear_flexure=0,20")
    );
    let hint = parse_variation("dampin").unwrap_err().hint.unwrap();
    assert!(hint.contains("damping"), "{hint}");
    assert!(parse_variation("damping = 2 %,, 5 %").is_err());
}
