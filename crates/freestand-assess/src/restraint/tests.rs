use freestand::code_spectrum::{
    As1170_4, Asce7, Edition, Eurocode8, GroundType, Interpolation, Nzs1170_5, OutOfRange, SiteClass, SpectrumTable,
    SpectrumType, SubsoilClass,
};

use super::*;

/// The paper's cabinet on the roof of a tower.
fn cabinet(spectrum: Option<CodeSpectrum>) -> RestraintQuestion {
    let axis = |axis, base_m: f64| RestraintAxis { axis, base_m, weight_lever_m: base_m / 2.0 };
    RestraintQuestion {
        mass_kg: 140.0,
        cg_height_m: 1.15,
        axes: vec![axis(Axis::Thickness, 0.6), axis(Axis::Width, 0.9)],
        level_ratio: 1.0,
        building_height_m: Some(96.0),
        building_period_s: Some(3.0),
        spectrum,
        floor_acceleration_g: Some(0.4),
        parameters: RestraintParameters::default(),
    }
}

fn melbourne() -> CodeSpectrum {
    As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500).unwrap().into()
}

/// Source, F/W and T/W.
fn held(forces: &[RestraintForce], source: &str) -> (f64, f64) {
    let force = forces.iter().find(|force| force.source.starts_with(source)).unwrap();
    let weight_n = 140.0 * 9.80665;
    assert!((force.force_n / weight_n - force.force_ratio).abs() < 1e-15 && !force.note.is_empty());
    (force.force_ratio, force.anchor_tension_n / weight_n)
}

fn near(got: (f64, f64), expected: (f64, f64)) {
    // A handful of products of numbers near one.
    assert!((got.0 - expected.0).abs() < 1e-12 && (got.1 - expected.1).abs() < 1e-12, "{got:?} {expected:?}");
}

/// kpZ Ch(0) = 0.088 g, a_x = 3: 0.264 W. T = (0.264 · 1.15 − 0.3)/0.6 W = 0.006 W; across the
/// width (0.3036 − 0.45)/0.9 < 0. S_DS = 0.088/1.1 · 3.68 = 0.2944 g: 16: 0.4 · 0.2944 · 3/2.5 =
/// 0.141312, 22 (T = 3 s: a1 = 1/3, a2 = 1 − (0.4/3)²): H_f = 1 + 0.3333 + 0.98222 = 2.315556,
/// 0.4 · 0.2944 · 2.315556/1.3/1.5 = 0.139836 W: both above 0.3 S_DS = 0.08832.
#[test]
fn the_cabinet_in_melbourne_by_hand() {
    let forces = restraint_forces(&cabinet(Some(melbourne())));
    let names: Vec<&str> = forces.iter().map(|force| force.source.as_str()).collect();
    let expected =
        ["AS 1170.4-2007, section 8", "ASCE 7-16, 13.3.1", "ASCE 7-22, 13.3.1", "computed floor acceleration"];
    assert_eq!(names, expected);
    near(held(&forces, "AS"), (0.264, 0.006));
    near(held(&forces, "ASCE 7-16"), (0.141_312, 0.0));
    let height = 1.0 + 1.0 / 3.0 + 1.0 - (0.4_f64 / 3.0).powi(2);
    near(held(&forces, "ASCE 7-22"), (0.4 * 0.2944 * height / 1.3 / 1.5, 0.0));
    // (0.4 · 1.15 − 0.3)/0.6; across the width (0.46 − 0.45)/0.9 is less.
    near(held(&forces, "computed"), (0.4, 0.16 / 0.6));
    assert!(forces[1].note.contains("S_DS is taken as the plateau") && forces[0].note.contains("from memory"));
    assert!(!forces[0].note.contains("taken as"), "its own spectrum");
}

/// S_DS = 1 g: 0.2 of the weight goes. 16: 0.4 · 3/2.5 = 0.48: T = (0.48 · 1.15 − 0.8 · 0.3)/0.6 =
/// 0.52 W. Critical: 1.5 times. AS with Sa(0) = 0.4 g: 1.2 W, held to 0.5.
#[test]
fn america_takes_some_of_the_weight_away() {
    let code = Asce7::new(Asce7Edition::Asce7_16, 1.0, 0.6, 8.0).unwrap();
    let forces = restraint_forces(&cabinet(Some(code.into())));
    near(held(&forces, "ASCE 7-16"), (0.48, 0.52));
    near(held(&forces, "AS 1170.4"), (0.5, (0.575 - 0.3) / 0.6));
    let note = |forces: &[RestraintForce], i: usize| forces[i].note.clone();
    assert!(note(&forces, 0).contains("the upper limit governs: 0.5 W") && note(&forces, 0).contains("taken as Sa(0)"));
    assert!(!note(&forces, 1).contains("plateau") && note(&forces, 1).contains("0.8 W"));
    let critical = RestraintQuestion { parameters: RestraintParameters::critical(), ..cabinet(Some(code.into())) };
    near(held(&restraint_forces(&critical), "ASCE 7-16"), (0.72, (0.72 * 1.15 - 0.24) / 0.6));
}

/// a_g S = 0.24 g, roof, rigid, q_a = 2: 0.3 W; C(0) C_Hi = 0.532 · 3 = 1.596 g, C_i = 2: 3.192 W.
#[test]
fn europe_and_new_zealand_have_their_own() {
    let code = Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.2, 1.0).unwrap();
    let forces = restraint_forces(&cabinet(Some(code.into())));
    near(held(&forces, "EN 1998"), (0.3, (0.345 - 0.3) / 0.6));
    assert_eq!(forces.len(), 5);
    let code = Nzs1170_5::new(SubsoilClass::C, 0.4, 500, None).unwrap();
    let forces = restraint_forces(&cabinet(Some(code.into())));
    let tension: [f64; 2] = [(3.192 * 1.15 - 0.3) / 0.6, (3.192 * 1.15 - 0.45) / 0.9];
    near(held(&forces, "NZS"), (3.192, tension[0].max(tension[1])));
}

/// A table that begins at 0.1 s: its first value is the ground's. A low building: 1 + 0.17 · 10 m ·
/// 0.5.
#[test]
fn a_table_and_a_low_building() {
    let table = SpectrumTable::new(vec![0.1, 1.0], vec![0.2, 0.1], Interpolation::LogLog, OutOfRange::Refuse).unwrap();
    let low = RestraintQuestion {
        level_ratio: 0.5,
        building_height_m: Some(10.0),
        building_period_s: None,
        ..cabinet(Some(table.into()))
    };
    let forces = restraint_forces(&low);
    near(held(&forces, "AS"), (0.2 * 1.85, (0.37 * 1.15 - 0.3) / 0.6));
    near(held(&forces, "ASCE 7-22"), (0.4 * 0.2 * 2.25 / 1.3 / 1.5, 0.0));
    let unknown = restraint_forces(&RestraintQuestion { building_height_m: None, ..low });
    near(held(&unknown, "AS"), (0.4, (0.46 - 0.3) / 0.6));
    assert!(unknown[0].note.contains("was not given"));
}

#[test]
fn without_a_hazard_only_the_computed_floor_speaks() {
    let forces = restraint_forces(&cabinet(None));
    assert_eq!(forces.len(), 1);
    assert!(restraint_forces(&RestraintQuestion { floor_acceleration_g: None, ..cabinet(None) }).is_empty());
    assert!(restraint_forces(&RestraintQuestion { mass_kg: 0.0, ..cabinet(Some(melbourne())) }).is_empty());
    // No side to tip over: the force alone.
    let flat = restraint_forces(&RestraintQuestion { axes: Vec::new(), ..cabinet(None) });
    assert_eq!(flat[0].anchor_tension_n, 0.0);
}

/// The largest reach of all four corners, followed one by one.
#[test]
fn clearance_is_that_of_the_farthest_corner() {
    for (h, t) in [(2.3, 0.6), (1.0, 1.0), (0.5, 0.8)] {
        for share in [0.0, 0.1, 0.5, 0.99] {
            let theta: f64 = share * f64::atan(t / h);
            let corners = [(0.0, 0.0), (-t, 0.0), (-t, h), (0.0, h)];
            let reach = corners.map(|(x, z)| {
                let moved = x * theta.cos() + z * theta.sin();
                moved.max(-t - moved)
            });
            let farthest = reach.into_iter().fold(0.0, f64::max);
            assert!(
                (clearance_m(h, t, theta) - farthest).abs() < 1e-15
                    && clearance_m(h, t, -theta) == clearance_m(h, t, theta)
            );
        }
        assert_eq!(clearance_m(h, t, 1.5), h);
    }
}

/// A cabinet of 2.3 m × 0.6 m at 5°, and past its balance point at 14.6°.
#[test]
fn the_clearance_is_that_of_the_top_or_of_the_fallen_object() {
    assert!((clearance_m(2.3, 0.6, 5.0_f64.to_radians()) - 0.2005).abs() < 5e-5);
    assert_eq!(clearance_m(2.3, 0.6, 0.3), 2.3);
}
