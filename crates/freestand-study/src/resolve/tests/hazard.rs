//! A hazard in place of that of a study, and periods of buildings by its code.

use freestand::code_spectrum::{FrameKind, PeriodCode};

use super::*;
use crate::building::{BuildingDoubt, PeriodFrom};

#[test]
fn a_place_in_place_of_the_hazard_of_a_study() {
    let hazard = |pairs: &[(&'static str, &str)]| Overrides {
        hazard: pairs.iter().copied().collect(),
        ..Overrides::default()
    };
    let target = |study: &Study| match &study.ground {
        Ground::Synthetic(ground) => ground.target.parameters(),
        _ => panic!(),
    };
    let cases: [(&[(&str, &str)], &str); 4] = [
        (
            &[("place", "Wellington")],
            "site C, Z = 0.4 (Wellington), 500 years, Z R = 0.4 g, a fault 0 km away",
        ),
        (
            &[("place", "Perth")],
            "site De, Z = 0.09 (Perth), 500 years, kpZ = 0.09 g",
        ),
        (
            &[("site", "Be")],
            "site Be, Z = 0.08 (Melbourne), 500 years, kpZ = 0.08 g",
        ),
        (
            &[
                ("place", "Napier"),
                ("site", "D"),
                ("return_period_years", "1000"),
            ],
            "site D, Z = 0.38 (Napier), 1000 years, Z R = 0.494 g",
        ),
    ];
    for (pairs, line) in cases {
        let study = builtin(&hazard(pairs)).unwrap();
        assert_eq!(target(&study), line);
        // The study that the run leaves behind gives the same ground and the same building.
        let again = resolve(&study.toml, None, "".as_ref()).unwrap();
        assert_eq!(
            (&again.ground, &again.building),
            (&study.ground, &study.building),
            "{}",
            study.toml
        );
    }
    // The formula of New Zealand is Australia's; that of the United States is not.
    let period = |place: &str| {
        builtin(&hazard(&[("place", place)]))
            .unwrap()
            .building
            .unwrap()
            .along
            .period_s()
    };
    assert_eq!(period("Wellington"), period("Melbourne"));
    // 0.0488 · 96^0.75, to its last digit.
    assert!((period("Reno") - 1.4967).abs() < 5e-5, "{}", period("Reno"));
    let got = builtin(&hazard(&[("place", "Renno")])).unwrap_err();
    // A flag is on no line of the study.
    let problem = &got.problems[0];
    assert!(
        problem
            .message
            .contains("`place` \"Renno\" is not in the table of places")
            && problem.line.is_none()
    );
    let text = "[ground]\nmotions = [\"a.csv\"]\n";
    let got = resolve_with(text, None, "".as_ref(), &hazard(&[("place", "Reno")])).unwrap_err();
    assert!(
        got.problems
            .iter()
            .any(|one| one.message.contains("the ground motions are records")),
        "{got}"
    );
}

#[test]
fn periods_by_the_code_and_the_height() {
    let building = |text: &str| study(text).building.unwrap();
    let tower =
        building("[building]\nstoreys = 12\nheight = \"40 m\"\nframe = \"concrete-moment\"\n");
    assert_eq!((tower.storeys, tower.height_m), (12, 40.0));
    assert_eq!(
        tower.period_from,
        PeriodFrom::Formula {
            code: PeriodCode::As1170_4,
            frame: FrameKind::MomentConcrete,
            height_m: 40.0
        }
    );
    // 131 ft 3 in is 40.005 m: 12.5 storeys of 3.2 m.
    assert_eq!(
        building("[building]\nheight = \"131' 3\\\"\"\n").storeys,
        13
    );
    let athens = building(
        "[ground]\nplace = \"Athens\"\n[building]\nstoreys = 5\nstorey_height = \"3.2 m\"\n",
    );
    // 0.05 · 16^0.75 = 0.4, to the rounding of the power.
    assert!((athens.along.period_s() - 0.4).abs() < 1e-14 && athens.doubts.is_empty());
    let high = building("[ground]\nplace = \"Athens\"\n");
    assert!(
        matches!(
            high.doubts[0],
            BuildingDoubt::TooHigh {
                greatest_m: 40.0,
                ..
            }
        ),
        "{:?}",
        high.doubts
    );
    let stated = building("[ground]\nplace = \"Athens\"\n[building]\nperiod = \"2 s\"\n");
    assert!(stated.doubts.is_empty() && stated.period_code.is_none());
    let other = building(
        "[building]\nperiod_code = \"asce7\"\nheight = \"30 m\"\nframe = \"steel-moment\"\n",
    );
    assert!((other.along.period_s() - 1.100).abs() < 5e-4);
    assert!(problems("[building]\nperiod_code = \"ibc\"\n")[0].contains("is not known"));
    assert!(
        problems("[building]\nstoreys = 3\nstorey_height = \"3 m\"\nheight = \"9 m\"\n")[0]
            .contains("exclude")
    );
}
