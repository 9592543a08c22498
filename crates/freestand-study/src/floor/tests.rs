use super::*;
use crate::building::PeriodFrom;
use crate::recorded::{MotionFiles, Second, read_recorded};
use freestand_records::formats::ReadOptions;

fn beam(period_s: f64) -> Building {
    Building::beam(period_s, 0.05, 5.0, 4).unwrap()
}

fn request(along: Building, across: Option<Building>) -> FloorRequest {
    let building = BuildingInput {
        storeys: 10,
        height_m: 30.0,
        storey_height_m: Some(3.0),
        along,
        across,
        period_from: PeriodFrom::Given,
        period_code: None,
        across_from: None,
        tables: Vec::new(),
        doubts: Vec::new(),
    };
    FloorRequest {
        building,
        levels_ratio: vec![0.0, 0.5, 1.0],
        is_storeys: true,
        tail_s: 2.0,
        upsample: 1,
        spectra: None,
        vertical_amplification_ratio: None,
        code: None,
    }
}

/// AS 1170.4, section 8, Melbourne on De: 0.08 · 1.1 g at the ground, twice that at mid-height,
/// three times at the roof.
#[test]
fn a_codes_parts_are_listed_with_the_floors() {
    let target =
        crate::target::Target::resolve(&freestand_input::keys::Words::default(), "".as_ref())
            .unwrap();
    let request = FloorRequest {
        code: Some(target.spectrum),
        ..request(beam(1.0), None)
    };
    let motions = vec![floors(&read(1, 1.0), &request).unwrap().report];
    let report = FloorReport::new(&request, motions, None).unwrap();
    for (level, expected_g) in report.levels.iter().zip([0.088, 0.176, 0.264]) {
        // Three roundings of decimal factors.
        assert!(
            (level.profile.code_part_g.unwrap() - expected_g).abs() < 1e-15,
            "{level:?}"
        );
    }
    assert!(report.code_clause.unwrap().starts_with("AS 1170.4"));
    assert!(
        report
            .profile_table()
            .unwrap()
            .to_string()
            .lines()
            .next()
            .unwrap()
            .ends_with(",code_part_g")
    );
}

/// A record of one or two components, `scale` times a wave.
fn read(components: usize, scale: f64) -> ReadMotion {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wave.csv");
    let mut text = String::from(if components == 2 {
        "time_s,a_m_s2,b_m_s2\n"
    } else {
        "time_s,a_m_s2\n"
    });
    for k in 0..400 {
        let t = 0.02 * f64::from(k);
        let (a, b) = (scale * (7.0 * t).sin(), scale * (3.0 * t).sin());
        let row = if components == 2 {
            format!("{t},{a},{b}\n")
        } else {
            format!("{t},{a}\n")
        };
        text.push_str(&row);
    }
    std::fs::write(&path, text).unwrap();
    let second = if components == 2 {
        Second::SameFile(None)
    } else {
        Second::None
    };
    let files = MotionFiles {
        paths: vec![path],
        read: ReadOptions::default(),
        component: None,
        second,
        vertical: Default::default(),
        processing: Default::default(),
    };
    let (mut motions, failures) = read_recorded(&files);
    assert!(failures.is_empty(), "{failures:?}");
    motions.pop().unwrap()
}

#[test]
fn each_axis_has_its_own_building_and_the_larger_direction_governs() {
    let two = floors(&read(2, 1.0), &request(beam(1.0), Some(beam(0.4)))).unwrap();
    for (floor, level) in two.floors.iter().zip(&two.report.levels) {
        let across = floor.across.as_ref().unwrap();
        let (x, y) = (
            floor.along.peak_m_s2() / G0_M_S2,
            across.peak_m_s2() / G0_M_S2,
        );
        assert_eq!((level.pfa_along_g, level.pfa_across_g), (x, Some(y)));
        assert!(level.pfa_g >= x.max(y) && level.pfa_g <= x.hypot(y));
        // In the stated direction the motion is as large as that, in every other no larger.
        let direction = level.pfa_direction_deg.unwrap();
        let turned = |deg: f64| floor.in_direction(deg).unwrap().peak_m_s2() / G0_M_S2;
        assert!(
            (0.0..180.0).contains(&direction)
                && (turned(direction) / level.pfa_g - 1.0).abs() < 1e-12
        );
        assert!((0..180).all(|deg| turned(f64::from(deg)) <= level.pfa_g * (1.0 + 1e-12)));
    }
    // Each component alone through its own building is the same floor.
    let second = two.floors[2].across.clone().unwrap();
    let swapped = ReadMotion {
        motion: crate::study::RecordedMotion {
            across: None,
            ..read(2, 1.0).motion
        },
        ..read(2, 1.0)
    };
    assert_eq!(
        floors(&swapped, &request(beam(1.0), None)).unwrap().floors[2].along,
        two.floors[2].along
    );
    let same = floors(&read(2, 1.0), &request(beam(1.0), None)).unwrap();
    assert_ne!(same.floors[2].across.clone().unwrap(), second);
}

#[test]
fn of_several_motions_medians_are_reported() {
    let request = request(beam(1.0), None);
    let motions: Vec<MotionReport> = [1.0, 3.0, 2.0]
        .map(|scale| floors(&read(1, scale), &request).unwrap().report)
        .into();
    let report = FloorReport::new(&request, motions, None).unwrap();
    for (i, level) in report.levels.iter().enumerate() {
        // All is linear: the median is that of the factor 2, and 16 and 84 % of 1, 2, 3 are 1.32
        // and 2.68.
        let one = report.motions[0].levels[i].pfa_g;
        let LevelProfile {
            pfa_g,
            pfa_g_p16,
            pfa_g_p84,
            ..
        } = level.profile;
        for (value, factor) in [
            (pfa_g, 2.0),
            (pfa_g_p16.unwrap(), 1.32),
            (pfa_g_p84.unwrap(), 2.68),
        ] {
            assert!((value / one - factor).abs() < 1e-12);
        }
    }
    let drifts: Vec<Option<f64>> = report
        .levels
        .iter()
        .map(|level| level.profile.drift_ratio)
        .collect();
    assert!(drifts[0].is_none() && drifts[1].is_some_and(|drift| drift > 0.0));
    // From the ground to half-way: the displacement over 15 m.
    assert!((drifts[1].unwrap() * 15.0 / report.levels[1].profile.pfd_m - 1.0).abs() < 1e-12);
}

#[test]
fn spectra_of_the_ground_level_are_those_of_the_record() {
    let spectra = SpectraRequest {
        damping_ratios: vec![0.02, 0.05],
        periods_s: vec![0.0, 0.3, 1.0],
    };
    let request = FloorRequest {
        spectra: Some(spectra.clone()),
        tail_s: 0.0,
        ..request(beam(1.0), None)
    };
    let record = read(1, 1.0);
    let done = floors(&record, &request).unwrap();
    let report = SpectraReport::new(&request.levels_ratio, &spectra, &[done.spectra_g]);
    for (ratio, row) in spectra.damping_ratios.iter().zip(&report.levels[0].psa_g) {
        let own = freestand::oscillator::response_spectrum(
            &record.motion.motion,
            *ratio,
            &spectra.periods_s,
        )
        .unwrap();
        let own: Vec<f64> = own.psa_m_s2.iter().map(|a| a / G0_M_S2).collect();
        assert_eq!(*row, own);
    }
    let csv = spectra_table(&report).unwrap().to_string();
    assert!(
        csv.starts_with("level_ratio,damping_ratio,period_s,psa_g,psa_g_p16,psa_g_p84\n0,0.02,0,")
    );
    assert_eq!(csv.lines().count(), 1 + 3 * 2 * 3);
}
