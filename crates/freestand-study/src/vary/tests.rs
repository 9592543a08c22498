use std::ops::ControlFlow;

use super::*;
use crate::resolve::{Overrides, resolve};
use crate::run::no_progress;

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

fn wishes(texts: &[&str]) -> Vec<Wish> {
    texts.iter().map(|text| parse_wish(text).unwrap()).collect()
}

fn sensitivity(texts: &[&str]) -> Sensitivity {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let base = run(&study, &no_progress).unwrap();
    vary(&study, &base, &wishes(texts), &Overrides::default(), &|_, _, _| {}, &no_progress).unwrap()
}

/// A value that is the study's own gives the study's own result, to the bit: nothing else is changed with it.
#[test]
fn the_same_value_changes_nothing() {
    let result = sensitivity(&["damping = 5 %", "damping = 2 %", "seed = 1", "seed = 2"]);
    let [base, same, softer, first, second] = &result.rows[..] else { panic!("{:?}", result.rows) };
    let numbers = |row: &VariedLevel| (row.pfa_g_median, row.overturned_share, row.edge_acceleration_g_max);
    assert_eq!((base.parameter.as_str(), base.value.as_str()), ("base", ""));
    assert_eq!(numbers(base), numbers(same));
    assert_eq!(numbers(base), numbers(first));
    assert_ne!(numbers(base), numbers(second));
    assert!(base.edge_acceleration_ratio.is_none_or(|ratio| ratio == 1.0), "{base:?}");
    // Less damping, more acceleration at the roof.
    assert!(softer.pfa_g_median > base.pfa_g_median);
}

#[test]
fn what_does_not_apply_is_said_and_what_fails_is_a_row() {
    let result = sensitivity(&["period = 3 s", "shear-flexure = -1", "scale"]);
    assert_eq!(result.rows.len(), 3);
    assert!(result.rows[1].reason.is_none());
    let reason = result.rows[2].reason.as_deref().unwrap();
    assert!(reason.contains("shear_flexure must be 0 or more"), "{reason}");
    assert_eq!(result.rows[2].pfa_g_median, None);
    assert_eq!(result.left_out, ["scale is not varied: synthetic motions follow their target"]);
}

#[test]
fn usual_values_leave_out_the_studys_own() {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let (variations, left_out) = variations(&study, &usual_wishes());
    let words: Vec<String> = variations.iter().map(Variation::words).collect();
    assert!(left_out.is_empty());
    assert!(words.contains(&"damping = 2 %".to_owned()) && !words.contains(&"damping = 5 %".to_owned()));
    assert!(words.contains(&"site = Ae".to_owned()) && !words.contains(&"site = De".to_owned()));
}

#[test]
fn a_stopped_run_stops_the_variations() {
    let study = resolve(STUDY, None, "".as_ref()).unwrap();
    let base = run(&study, &no_progress).unwrap();
    let stop = |_: Step| ControlFlow::Break(());
    let error = vary(&study, &base, &wishes(&["damping"]), &Overrides::default(), &|_, _, _| {}, &stop).unwrap_err();
    assert!(error.to_string().contains("stopped"), "{error}");
}

#[test]
fn wishes_are_forgiving_in_spelling_and_strict_in_words() {
    assert_eq!(parse_wish("building.shear-flexure = 0, 20"), parse_wish("shear_flexure=0,20"));
    let hint = parse_wish("dampin").unwrap_err().hint.unwrap();
    assert!(hint.contains("damping"), "{hint}");
    assert!(parse_wish("damping = 2 %,, 5 %").is_err());
}
