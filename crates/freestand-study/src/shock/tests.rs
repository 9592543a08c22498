use super::*;
use crate::cushion::spring;
use freestand_output::answer::Answer;
use freestand_output::facts::Value;

fn cabinet() -> ShockRequest {
    ShockRequest {
        cushion: spring(4.38e6),
        energy: Some(Energy::CgRise(0.016)),
        gravity_m_s2: 9.81,
        ..ShockRequest::new(Block::uniform(2.3, 0.6).unwrap(), 140.0)
    }
}

fn number(report: &ShockReport, name: &str) -> f64 {
    report.answer.facts().number(name).unwrap()
}

fn text(report: &ShockReport, name: &str) -> String {
    report.answer.facts().text(name).unwrap().to_owned()
}

fn refused(request: &ShockRequest) -> String {
    shock(request).unwrap_err().to_string()
}

/// Table I, test 1, in units of 9.81 m/s².
#[test]
fn table_one_test_one() {
    let report = shock(&cabinet()).unwrap();
    let g = G0_M_S2 / 9.81;
    assert!((number(&report, "drop_acceleration_g") * g - 10.102).abs() < 5e-4);
    assert!((number(&report, "edge_acceleration_g") * g - 4.526).abs() < 5e-4);
    assert_eq!(
        (report.answer.model, report.answer.verdict),
        ("paper", "no-verdict")
    );
    assert!(
        (number(&report, "velocity_change_m_s") / number(&report, "edge_velocity_m_s") - 2.0).abs()
            < 1e-15
    );
    let (paper_g, edge_g) = (
        number(&report, "paper_g"),
        number(&report, "edge_acceleration_g"),
    );
    assert_eq!((paper_g * 1e9).round(), (edge_g * 1e9).round());
}

#[test]
fn ceilings_of_three_objects() {
    for (h, t, ceiling) in [(1.5, 0.2, 1.45), (1.5, 0.4, 5.72), (2.0, 0.6, 8.32)] {
        let request = ShockRequest {
            mass_kg: 150.0,
            gravity_m_s2: G0_M_S2,
            ..cabinet()
        };
        let request = ShockRequest {
            block: Block::uniform(h, t).unwrap(),
            energy: Some(Energy::CgRise(1e-3)),
            ..request
        };
        assert!((number(&shock(&request).unwrap(), "ceiling_g") - ceiling).abs() < 5.1e-3);
    }
}

#[test]
fn a_drop_acceleration_replaces_the_stiffness() {
    let known = shock(&cabinet()).unwrap();
    let mut measured = cabinet();
    measured.cushion = Words::default();
    measured.drop_acceleration_m_s2 = Some(number(&known, "drop_acceleration_g") * G0_M_S2);
    let implied = shock(&measured).unwrap();
    assert!((number(&implied, "stiffness_n_m") / 4.38e6 - 1.0).abs() < 1e-12);
    measured.energy = None;
    let alone = shock(&measured).unwrap();
    assert!(
        (number(&alone, "edge_acceleration_g") / number(&known, "edge_acceleration_g") - 1.0).abs()
            < 1e-12
    );
    for missing in ["pulse_duration_s", "velocity_change_m_s", "ceiling_g"] {
        assert_eq!(alone.answer.facts().get(missing), Some(&Value::Missing));
    }
    measured.cushion = spring(4.38e6);
    assert!(refused(&measured).contains("exclude each other"));
}

#[test]
fn pads_and_series_become_an_edge() {
    let mut request = cabinet();
    request.cushion = Words::default();
    request.cushion.set("pad_stiffness", "2190 N/mm");
    assert!(refused(&request).contains("`pad_stiffness` needs `pads_per_edge`"));
    request.cushion.set("pads_per_edge", "2");
    let report = shock(&request).unwrap();
    assert!(matches!(report.notes[..], [ShockNote::Cushion(_)]));
    assert_eq!(
        number(&report, "edge_acceleration_g"),
        number(&shock(&cabinet()).unwrap(), "edge_acceleration_g")
    );
    request.cushion.add("series_stiffness", "4380 N/mm", None);
    request.cushion.add("series_stiffness", "2190 N/mm", None);
    assert!((number(&shock(&request).unwrap(), "stiffness_n_m") / 1.095e6 - 1.0).abs() < 1e-14);
}

#[test]
fn beyond_the_balance_point_rocking_is_refused_and_halting_warned_about() {
    let mut request = cabinet();
    for energy in [
        Energy::CgRise(0.039),
        Energy::Uplift(0.16),
        Energy::Uplift(0.7),
        Energy::Rotation(-0.26),
    ] {
        request.energy = Some(energy);
        request.scenario = Scenario::Rocking;
        assert!(refused(&request).contains("balance point"), "{energy:?}");
        request.scenario = Scenario::Halted;
        let doubts = shock(&request).unwrap().doubts;
        assert!(
            matches!(doubts[0], ShockDoubt::BeyondBalance(_)),
            "{energy:?}"
        );
    }
    // An angular velocity may carry more energy than any rise.
    request.scenario = Scenario::Rocking;
    request.energy = Some(Energy::AngularVelocity(-3.0));
    let report = shock(&request).unwrap();
    assert!(number(&report, "edge_acceleration_g") > number(&report, "ceiling_g"));
    assert!((number(&report, "edge_velocity_m_s") - 1.8).abs() < 1e-12);
}

#[test]
fn rise_uplift_and_rotation_say_the_same() {
    let first = shock(&cabinet()).unwrap();
    for energy in [
        Energy::Uplift(number(&first, "uplift_m")),
        Energy::Rotation(-number(&first, "rotation_rad")),
    ] {
        let report = shock(&ShockRequest {
            energy: Some(energy),
            ..cabinet()
        })
        .unwrap();
        assert!(
            (number(&report, "edge_acceleration_g") / number(&first, "edge_acceleration_g") - 1.0)
                .abs()
                < 1e-12
        );
    }
}

#[test]
fn overturning_lands_on_its_side() {
    let mut request = ShockRequest {
        scenario: Scenario::OverturnFloor,
        energy: None,
        ..cabinet()
    };
    assert!(refused(&request).contains("contact_stiffness"));
    request.contact_stiffness_n_m = Some(2e6);
    let floor = shock(&request).unwrap();
    assert_eq!(
        (floor.answer.model, number(&floor, "contact_distance_m")),
        ("halted", 2.3)
    );
    assert_eq!(
        (
            floor.answer.facts().number("ceiling_g"),
            floor.answer.facts().number("paper_g")
        ),
        (None, None)
    );
    // Δh = R − t/2.
    assert!(
        (number(&floor, "cg_rise_m") - (number(&floor, "half_diagonal_m") - 0.3)).abs() < 1e-15
    );
    // The edge's stiffness, and a rise, have no part in the fall: said, and the same shock without
    // them.
    assert!(floor.doubts.contains(&ShockDoubt::EdgeUnused));
    request.cushion = Words::default();
    request.energy = Some(Energy::CgRise(0.01));
    let again = shock(&request).unwrap();
    assert_eq!(
        again.answer.facts().number("edge_acceleration_g"),
        floor.answer.facts().number("edge_acceleration_g")
    );
    assert!(again.doubts.contains(&ShockDoubt::RiseUnused));

    request.scenario = Scenario::OverturnObstacle;
    request.energy = None;
    assert!(refused(&request).contains("needs `gap`"));
    request.gap_m = Some(0.2);
    assert!(refused(&request).contains("angular_velocity"));
    request.energy = Some(Energy::AngularVelocity(1.0));
    assert!((number(&shock(&request).unwrap(), "edge_velocity_m_s") - 2.3).abs() < 1e-12);
    request.gap_m = Some(3.0);
    assert!(refused(&request).contains(
        "the obstacle is 3 m away and the object is 2.3 m high, so the object cannot reach it"
    ));
}

#[test]
fn squat_objects_are_halted_with_a_warning() {
    let request = ShockRequest {
        block: Block::uniform(0.6, 1.0).unwrap(),
        ..cabinet()
    };
    let report = shock(&request).unwrap();
    assert_eq!(
        (report.answer.model, report.answer.facts().number("paper_g")),
        ("halted", None)
    );
    let landing_ratio = number(&report, "landing_ratio");
    let squat = ValidityWarning::Squat { landing_ratio };
    assert!(landing_ratio < 0.0 && report.doubts[0] == ShockDoubt::Validity(squat));
}

#[test]
fn newtons_per_metre_are_noticed() {
    let report = shock(&ShockRequest {
        cushion: spring(4380.0),
        ..cabinet()
    })
    .unwrap();
    assert!(report.doubts.iter().any(|doubt| matches!(
        doubt,
        ShockDoubt::Validity(ValidityWarning::LowStiffness { .. })
    )));
}

#[test]
fn the_verdict_follows_what_is_known_of_the_tolerance() {
    let peak_only = ShockRequest {
        tolerance_m_s2: Some(4.0 * G0_M_S2),
        ..cabinet()
    };
    let report = shock(&peak_only).unwrap();
    assert_eq!(
        (report.answer.governing.unwrap(), report.verdict),
        ("peak", Verdict::Exceeded)
    );
    // At the largest stiffness the shock is the tolerance.
    let softer = ShockRequest {
        cushion: spring(number(&report, "max_stiffness_n_m")),
        ..peak_only.clone()
    };
    assert!((number(&shock(&softer).unwrap(), "demand_capacity_ratio") - 1.0).abs() < 1e-12);

    let boundary = ShockRequest {
        tolerance_velocity_change_m_s: Some(10.0),
        ..peak_only.clone()
    };
    let report = shock(&boundary).unwrap();
    assert_eq!(
        (report.answer.governing.unwrap(), report.verdict),
        ("damage-boundary", Verdict::Ok)
    );
    assert!(
        (number(&report, "demand_capacity_ratio") - number(&report, "velocity_change_m_s") / 10.0)
            .abs()
            < 1e-15
    );

    // The survived pulse has the demand's own duration: the spectra differ by the peaks alone.
    let duration = report.answer.facts().number("pulse_duration_s");
    let spectrum = ShockRequest {
        tolerance_duration_s: duration,
        ..peak_only.clone()
    };
    let report = shock(&spectrum).unwrap();
    assert_eq!(report.answer.governing.unwrap(), "spectrum");
    assert!((number(&report, "spectrum") / number(&report, "peak") - 1.0).abs() < 1e-12);

    let both = ShockRequest {
        tolerance_velocity_change_m_s: Some(10.0),
        ..spectrum
    };
    assert_eq!(text(&shock(&both).unwrap(), "governing"), "spectrum");
    let no_peak = ShockRequest {
        tolerance_m_s2: None,
        ..both
    };
    assert!(refused(&no_peak).contains("need `tolerance`"));
}

#[test]
fn a_point_of_the_object() {
    let at = shock(&ShockRequest {
        at_m: Some((0.6, 0.0)),
        ..cabinet()
    })
    .unwrap();
    let ratio = number(&at, "vertical_g") / number(&at, "edge_acceleration_g");
    assert!(number(&at, "horizontal_g") == 0.0 && (ratio - 1.0).abs() < 1e-14);
}

#[test]
fn all_problems_come_at_once() {
    let cube = Block::uniform(1.0, 1.0).unwrap();
    let request = ShockRequest {
        gap_m: Some(1.0),
        ..ShockRequest::new(cube, f64::NAN)
    };
    // The mass, the gap without an obstacle, the cushion and the fall that nobody gives.
    assert_eq!(shock(&request).unwrap_err().problems.len(), 4);
}

/// The largest stiffness is where the verdict turns, by whatever criterion; where none turns it, a
/// note says so.
#[test]
fn the_largest_stiffness_is_where_the_verdict_turns() {
    let with = |duration_s, velocity_change_m_s| ShockRequest {
        energy: Some(Energy::CgRise(0.027)),
        tolerance_m_s2: Some(5.0 * G0_M_S2),
        tolerance_duration_s: duration_s,
        tolerance_velocity_change_m_s: velocity_change_m_s,
        ..cabinet()
    };
    for request in [
        with(None, None),
        with(Some(0.025), None),
        with(None, Some(0.5)),
        with(Some(0.03), Some(0.5)),
    ] {
        let largest = number(&shock(&request).unwrap(), "max_stiffness_n_m");
        let at = |factor: f64| {
            shock(&ShockRequest {
                cushion: spring(factor * largest),
                ..request.clone()
            })
            .unwrap()
        };
        assert_eq!(
            (at(1.0 - 1e-6).verdict, at(1.0 + 1e-6).verdict),
            (Verdict::Ok, Verdict::Exceeded),
            "{largest}"
        );
    }
    // 5 g for 11 ms carry less velocity than the landing; a limit of 1 m/s carries more.
    for (request, why) in [
        (
            with(Some(0.011), None),
            NoLargestStiffness::VelocityChangeTooLarge,
        ),
        (
            with(None, Some(1.0)),
            NoLargestStiffness::VelocityChangeSmall,
        ),
    ] {
        let report = shock(&request).unwrap();
        assert_eq!(report.answer.facts().number("max_stiffness_n_m"), None);
        assert_eq!(report.notes, [ShockNote::NoLargestStiffness(why)]);
    }
}

/// A lift or a component alone is enough for a verdict, and the peak then is not known.
#[test]
fn a_lift_or_a_component_alone_is_enough() {
    let lifted = ShockRequest {
        tolerance_edge_lift_m: Some(0.1),
        energy: Some(Energy::Uplift(0.05)),
        ..cabinet()
    };
    let report = shock(&lifted).unwrap();
    assert_eq!(
        (report.answer.governing.unwrap(), report.verdict),
        ("edge-lift", Verdict::Ok)
    );
    assert_eq!(report.answer.facts().number("peak"), None);
    assert!((number(&report, "demand_capacity_ratio") - 0.5).abs() < 1e-12);
    let higher = ShockRequest {
        tolerance_edge_lift_m: Some(0.04),
        ..lifted
    };
    let report = shock(&higher).unwrap();
    assert_eq!(
        (
            report.verdict,
            report.answer.facts().number("max_stiffness_n_m")
        ),
        (Verdict::Exceeded, None)
    );
    let why = NoLargestStiffness::UpliftTooLarge;
    assert_eq!(report.notes, [ShockNote::NoLargestStiffness(why)]);

    // At fT = 1 the component feels 1.62379 times the half-sine, ζ = 0.05.
    let bare = shock(&cabinet()).unwrap();
    let (f, a) = (
        1.0 / number(&bare, "pulse_duration_s"),
        number(&bare, "edge_acceleration_m_s2"),
    );
    let delicate = ShockRequest {
        component_frequency_hz: Some(f),
        component_capacity_m_s2: Some(2.0 * a),
        ..cabinet()
    };
    let report = shock(&delicate).unwrap();
    assert_eq!(
        (report.answer.governing.unwrap(), report.verdict),
        ("component", Verdict::Ok)
    );
    assert!((number(&report, "demand_capacity_ratio") - 1.62379 / 2.0).abs() < 1e-5);
    // V_c = a_c/ω, A_c = a_c/2.
    let v_c = number(&report, "critical_velocity_change_m_s");
    assert!((v_c - 2.0 * a / (std::f64::consts::TAU * f)).abs() < 1e-12);
    assert_eq!(
        (
            report.answer.damage_boundary.as_ref().unwrap().source,
            number(&report, "critical_acceleration_g")
        ),
        ("component", a / G0_M_S2)
    );
    let largest = number(&report, "max_stiffness_n_m");
    let at = |factor: f64| {
        let cushion = spring(factor * largest);
        shock(&ShockRequest {
            cushion,
            ..delicate.clone()
        })
        .unwrap()
        .verdict
    };
    assert_eq!(
        (at(1.0 - 1e-6), at(1.0 + 1e-6)),
        (Verdict::Ok, Verdict::Exceeded)
    );
    let half = ShockRequest {
        component_capacity_m_s2: None,
        ..delicate
    };
    assert!(refused(&half).contains("go together"));
}

/// The largest of the kinds that apply governs; a peak that is part of a boundary never on its own.
#[test]
fn the_largest_of_several_kinds_governs() {
    let request = ShockRequest {
        energy: Some(Energy::Uplift(0.05)),
        tolerance_m_s2: Some(1.0 * G0_M_S2),
        tolerance_velocity_change_m_s: Some(10.0),
        tolerance_edge_lift_m: Some(0.025),
        ..cabinet()
    };
    let report = shock(&request).unwrap();
    let ratios = report.answer.demand_capacity.clone().unwrap();
    assert!(ratios.peak.unwrap() > 4.0 && ratios.damage_boundary.unwrap() < 0.2);
    assert_eq!(report.answer.governing.unwrap(), "edge-lift");
    assert!((number(&report, "demand_capacity_ratio") - 2.0).abs() < 1e-12);
    assert_eq!(
        report.answer.damage_boundary.as_ref().unwrap().source,
        "tests"
    );
    // A peak without duration or velocity change is a kind of its own: a lift that was survived
    // does not excuse it.
    let peak = ShockRequest {
        tolerance_velocity_change_m_s: None,
        tolerance_edge_lift_m: Some(0.1),
        ..request
    };
    let report = shock(&peak).unwrap();
    assert_eq!(
        (report.answer.governing.unwrap(), report.verdict),
        ("peak", Verdict::Exceeded)
    );
}
