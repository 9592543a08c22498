//! A made-up study and result for tests: 10 motions, 2 levels, 26 heights × 5 thicknesses. The
//! rocking is a formula, not a history: some objects do not uplift, some rock, some overturn, one
//! cannot be followed.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::PathBuf;

use freestand::block::Block;
use freestand::building::{Building, floor_motions};
use freestand::impact::ImpactModel;
use freestand::motion::Motion;
use freestand::oscillator::response_spectrum;
use freestand::rocking::Outcome;
use freestand::rocking::{Accuracy, Restitution, RockingSummary, SideExtremes, StopReason};
use freestand::spectra::UpliftCell;
use freestand::synthesis::Misfit;
use freestand::{G0_M_S2, impact::Landing};

use freestand_input::file::InputFile;
use freestand_input::keys::Words;
use freestand_records::horizontal::HorizontalMotion;
use freestand_study::building::PeriodFrom;
use freestand_study::cushion::{self, EdgeCushion};
use freestand_study::result::{
    ExampleHistory, FloorProfile, GroundMotion, LevelResult, ObjectResponse, PseudoSpectrum,
    StudyResult,
};
use freestand_study::statistics::object_statistics;
use freestand_study::study::{
    BuildingInput, Ground, HistoryChoice, Level, Objects, Outputs, RecordedMotion, Study,
    StudyDoubt, SyntheticGround, TitleBlock, VerticalTarget,
};
use freestand_study::target::CodeParts;
use freestand_study::target::Target;

pub(super) const MASS_KG: f64 = 150.0;
/// Two pads of 2190 N/mm.
pub(super) fn spring() -> EdgeCushion {
    cushion::linear(4.38e6, &Words::default()).unwrap()
}

/// A study with synthetic ground motions.
pub(super) fn study() -> Study {
    let heights_m: Vec<f64> = (0..26).map(|i| 0.5 + 0.1 * f64::from(i)).collect();
    let thicknesses_m = vec![0.2, 0.3, 0.4, 0.5, 0.6];
    let mut blocks = Vec::new();
    for &h in &heights_m {
        blocks.extend(thicknesses_m.iter().map(|&t| Block::uniform(h, t).unwrap()));
    }
    Study {
        source: None,
        is_builtin: false,
        place_is_assumed: false,
        building_is_assumed: false,
        assumed: Vec::new(),
        toml: "[ground]\ncity = \"Melbourne\"\n".into(),
        ground: Ground::Synthetic(SyntheticGround {
            near_fault: None,
            target: Target::resolve(&Words::default(), "".as_ref()).unwrap(),
            count: 10,
            seed: 1,
            vertical: VerticalTarget::None,
        }),
        other_ground: None,
        directions_deg: vec![0.0],
        building_name: None,
        building: Some(BuildingInput {
            storeys: 30,
            height_m: 90.0,
            storey_height_m: Some(3.0),
            across: None,
            along: Building::beam(2.74, 0.05, 5.0, 5).unwrap(),
            period_code: None,
            period_from: PeriodFrom::Given,
            across_from: None,
            tables: Vec::new(),
            doubts: Vec::new(),
        }),
        vertical_amplification_ratio: 1.0,
        floors: Vec::new(),
        first_floor: None,
        levels: vec![
            Level {
                name: "mid-height".into(),
                level_ratio: Some(0.5),
                motions: Vec::new(),
            },
            Level {
                name: "roof".into(),
                level_ratio: Some(1.0),
                motions: Vec::new(),
            },
        ],
        objects: Objects {
            heights_m,
            thicknesses_m,
            blocks,
            mass_kg: MASS_KG,
            cushion: spring(),
            cushion_file: None,
            restitution: Restitution::Housner,
            accuracy: Accuracy::Standard,
            tolerance_m_s2: None,
            friction: None,
        },
        assessment: freestand_study::study::assessment::Settings::default(),
        outputs: Outputs {
            figures: true,
            parquet: false,
            report: true,
            cards: false,
            title: TitleBlock::default(),
            history: Some(HistoryChoice {
                level: "roof".into(),
                motion: None,
                height_m: 1.5,
                thickness_m: 0.3,
            }),
        },
        doubts: vec![StudyDoubt::OfRecords(
            "the building is a uniform beam".into(),
        )],
    }
}

/// The same with recorded ground motions, a tolerance, and names that an HTML writer must not
/// trust.
pub(super) fn recorded(mut study: Study, result: &StudyResult) -> Study {
    let motions = result.ground.iter().map(|g| RecordedMotion {
        name: "<b>El & \"Centro\"</b> $x$ $y$".into(),
        path: PathBuf::from("records/<script>alert(1)</script>.AT2"),
        sha256: "ab".repeat(32),
        description: "PEER AT2 & more".into(),
        scale_ratio: 1.25,
        station_xml: vec![InputFile {
            path: "stations/<c>.xml".into(),
            sha256: "ef".repeat(32),
        }],
        scale_target: Some(InputFile {
            path: "targets/<b>.csv".into(),
            sha256: "cd".repeat(32),
        }),
        processing: vec!["multiplied by 1.25".to_owned()],
        matched: None,
        suite: None,
        motion: g.motion.along.clone(),
        across: None,
        vertical: None,
    });
    study.ground = Ground::Recorded(motions.collect());
    study.source = Some(PathBuf::from("studies/<my> & study.toml"));
    study.levels[1].name = "roof & <i>mast</i>".into();
    study.objects.tolerance_m_s2 = Some(2.0 * G0_M_S2);
    study.objects.friction = Some(0.4);
    study.objects.restitution = Restitution::Value(0.9);
    study
}

/// What came out of it.
pub(super) fn result(study: &Study) -> StudyResult {
    let ground: Vec<GroundMotion> = (0..10).map(|i| ground_motion(i, study)).collect();
    let ratios: Vec<f64> = study
        .levels
        .iter()
        .map(|l| l.level_ratio.unwrap())
        .collect();
    let beam = &study.building.as_ref().unwrap().along;
    let floors: Vec<Vec<Motion>> = ground
        .iter()
        .map(|g| floor_motions(&g.motion.along, beam, &ratios).unwrap())
        .collect();
    let levels: Vec<LevelResult> = study
        .levels
        .iter()
        .enumerate()
        .map(|(i, level)| level_result(study, level, floors.iter().map(|f| f[i].clone()).collect()))
        .collect();
    let history = history(&levels[levels.len() - 1], "synthetic-01");
    StudyResult {
        motions: ground.iter().map(|g| g.name.clone()).collect(),
        ground,
        profile: Some(FloorProfile {
            levels_ratio: vec![0.0, 0.5, 1.0],
            pfa_g: (0..10)
                .map(|i| {
                    [0.1, 0.14, 0.3]
                        .map(|g| g * (0.8 + 0.05 * f64::from(i)))
                        .to_vec()
                })
                .collect(),
            pfv_m_s: (0..10)
                .map(|i| {
                    [0.1, 0.2, 0.4]
                        .map(|v| v * (0.8 + 0.05 * f64::from(i)))
                        .to_vec()
                })
                .collect(),
            code: Some(CodeParts {
                clause: "a code’s line",
                accel_g: vec![0.088, 0.176, 0.264],
            }),
        }),
        modes: beam.modes().to_vec(),
        levels,
        history: Some(history),
        sensitivity: None,
        doubts: vec![StudyDoubt::OfRecords(
            "12 objects of 130 need more friction than 0.5 under some motion: they may slide"
                .into(),
        )],
    }
}

/// Shaking of 25 s: a sum of decaying sines whose amplitudes follow the target.
fn ground_motion(index: u32, study: &Study) -> GroundMotion {
    let dt_s = 0.01;
    let mut state = u64::from(index) * 7919 + 12345;
    let mut random = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let waves: Vec<(f64, f64, f64)> = (0..80)
        .map(|k| {
            (
                0.2 * 1.055f64.powi(k),
                0.010 * (0.3 + 1.4 * random()),
                TAU * random(),
            )
        })
        .collect();
    let accel = (0..3000).map(|i| {
        let t = f64::from(i) * dt_s;
        let envelope = (t / 4.0).min(1.0) * (-(t - 8.0).max(0.0) / 4.0).exp();
        G0_M_S2
            * envelope
            * waves
                .iter()
                .map(|(f, a, phase)| a * (TAU * f * t + phase).sin())
                .sum::<f64>()
    });
    let motion = Motion::new(dt_s, accel.collect()).unwrap();
    let spectrum = spectrum(&motion);
    let misfit = Misfit {
        rms_ratio: 0.021,
        worst_ratio: -0.083,
        worst_period_s: 0.052,
        pga_g: motion.peak_m_s2() / G0_M_S2,
        target_zpa_g: 0.088,
        d5_95_s: 11.4,
        pgv_m_s: 0.17,
    };
    let misfit = matches!(study.ground, Ground::Synthetic(_)).then_some(misfit);
    GroundMotion {
        name: freestand_study::matched::synthetic_name(index as usize),
        motion: one(motion),
        vertical: None,
        spectrum,
        misfit,
    }
}

fn one(along: Motion) -> HorizontalMotion {
    HorizontalMotion {
        along,
        across: None,
    }
}

fn spectrum(motion: &Motion) -> PseudoSpectrum {
    let periods: Vec<f64> = (0..81)
        .map(|i| 0.05 * 10f64.powf(f64::from(i) / 40.0))
        .collect();
    let psa_m_s2 = response_spectrum(motion, 0.05, &periods).unwrap().psa_m_s2;
    PseudoSpectrum {
        periods_s: periods,
        psa_m_s2,
    }
}

fn level_result(study: &Study, level: &Level, floors: Vec<Motion>) -> LevelResult {
    let responses: Vec<Vec<ObjectResponse>> = floors
        .iter()
        .enumerate()
        .map(|(m, floor)| {
            let one = |(i, block): (usize, &Block)| {
                if m == 3 && i == 64 && level.level_ratio == Some(1.0) {
                    return ObjectResponse::Failed("the floor falls away: g + ü_v ≤ 0".into());
                }
                let uplift = rocked(block, floor.peak_m_s2() / G0_M_S2, m);
                let shock = uplift.shock(MASS_KG, &spring().cushion, ImpactModel::Paper, G0_M_S2);
                ObjectResponse::Done {
                    uplift,
                    shock,
                    direction_deg: None,
                }
            };
            study.objects.blocks.iter().enumerate().map(one).collect()
        })
        .collect();
    let objects = study.objects.blocks.len();
    let statistics = (0..objects)
        .map(|i| object_statistics(responses.iter().map(|row| &row[i])))
        .collect();
    let spectra = floors.iter().map(spectrum).collect();
    let floors: Vec<HorizontalMotion> = floors.into_iter().map(one).collect();
    let verticals = vec![None; floors.len()];
    LevelResult {
        level: level.clone(),
        floors,
        verticals,
        spectra,
        responses,
        statistics,
    }
}

/// Rocking grows with what the peak has over the threshold and falls with the size.
fn rocked(block: &Block, peak_g: f64, motion: usize) -> UpliftCell {
    let pivot = block.pivot();
    let excess = peak_g / pivot.slenderness_angle_rad.tan() - 1.0;
    let ratio = (0.5 + 0.12 * motion as f64) * 0.55 * excess / pivot.half_diagonal_m;
    let outcome = match ratio {
        r if r <= 0.0 => Outcome::NoUplift,
        r if r < 1.0 => Outcome::Rocked,
        _ => Outcome::Overturned,
    };
    let peak = match outcome {
        Outcome::NoUplift => 0.0,
        Outcome::Rocked | Outcome::Unresolved => ratio * pivot.slenderness_angle_rad,
        Outcome::Overturned | Outcome::Leaned => FRAC_PI_2,
    };
    let cg_rise_m = pivot.cg_rise_m(peak.min(pivot.slenderness_angle_rad));
    let landing = Landing::rocking(block, ImpactModel::Paper);
    let rocking = RockingSummary {
        outcome,
        stop: if outcome == Outcome::Overturned {
            StopReason::Overturned
        } else {
            StopReason::Settled
        },
        peak_rotation_rad: peak,
        wall_impact_count: 0,
        impact_count: if outcome == Outcome::NoUplift { 0 } else { 17 },
        uplift_m: block.base_width_m() * peak.sin(),
        cg_rise_m,
        sides: [
            SideExtremes {
                peak_rotation_rad: peak,
                impact_omega_rad_s: landing.omega_rad_s(0.8 * cg_rise_m, G0_M_S2),
                wall_omega_rad_s: 0.0,
            },
            SideExtremes::default(),
        ],
    };
    UpliftCell {
        block: *block,
        rocking,
    }
}

fn history(level: &LevelResult, motion: &str) -> ExampleHistory {
    let floor = &level.floors[0].along;
    let slenderness_angle_rad = 0.3f64.atan2(1.5);
    let time_s: Vec<f64> = (0..floor.accel_m_s2().len())
        .map(|i| i as f64 * floor.dt_s())
        .collect();
    let swing = |t: f64| {
        let s = t - 6.0;
        if (0.0..14.0).contains(&s) {
            0.7 * slenderness_angle_rad * (s * (0.7 + 0.15 * s)).sin() * (-s / 5.0).exp()
        } else {
            0.0
        }
    };
    let theta_rad: Vec<f64> = time_s.iter().map(|&t| swing(t)).collect();
    let crosses = |i: &usize| theta_rad[*i] * theta_rad[*i + 1] < 0.0;
    let impacts = (0..time_s.len() - 1)
        .filter(crosses)
        .map(|i| (time_s[i], 2.6 * (-(time_s[i] - 6.0) / 5.0).exp()))
        .collect();
    ExampleHistory {
        level: level.level.name.clone(),
        motion: motion.into(),
        direction_deg: None,
        height_m: 1.5,
        thickness_m: 0.3,
        slenderness_angle_rad,
        outcome: Outcome::Rocked,
        accel_m_s2: floor.accel_m_s2().to_vec(),
        time_s,
        theta_rad,
        impacts,
    }
}
