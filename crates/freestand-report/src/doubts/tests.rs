//! Every doubt and every note of a history, in words.

use freestand::cushion::Cushion;
use freestand::impact::ValidityWarning;
use freestand_study::cushion::CushionNote;
use freestand_study::doubt::SquatObjects;
use strum::EnumCount;

use super::*;

/// None is forgotten: as many kinds are listed as there are.
pub(crate) fn all<T: EnumCount>(listed: &[T]) {
    let kinds: std::collections::HashSet<_> = listed.iter().map(std::mem::discriminant).collect();
    assert_eq!(kinds.len(), T::COUNT);
}

pub(crate) fn two_pads() -> CushionNote {
    let pad = Cushion::linear(2.19e6).unwrap();
    CushionNote::Pads {
        count: 2,
        edge: pad.side_by_side(2),
        pad,
    }
}

#[test]
fn every_doubt_and_note_in_words() {
    let size = UnlikelySize {
        key: "height",
        size_m: 12.3456,
        usual_m: 0.05..=12.0,
    };
    let sliding = ValidityWarning::Sliding {
        needed_ratio: 0.6,
        friction_ratio: 0.5,
        in_impact: false,
    };
    let squat = ValidityWarning::Squat {
        landing_ratio: -0.1,
    };
    let beside = |stiffness_ratio| BesideWall {
        stiffness_ratio,
        damping_ratio: 0.05,
        outcome: "rocked",
        tilt_rad: 0.0123,
    };
    let doubts = [
        HistoryDoubt::Size(size.clone()),
        HistoryDoubt::Validity(squat),
        HistoryDoubt::SlidesByAssumption(sliding),
        HistoryDoubt::LeavesTheFloor,
        HistoryDoubt::Unresolved,
        HistoryDoubt::WallOutOfReach {
            side: "left",
            gap_m: 12.0,
            height_m: 2.0,
        },
        HistoryDoubt::WallPastBalance {
            side: "right",
            angle_rad: 0.2527,
            balance_rad: 0.1974,
        },
        HistoryDoubt::WallCushionAssumed([beside(1.0), beside(5.0)]),
        HistoryDoubt::OtherOutcomeNearby,
        HistoryDoubt::Undamped,
        HistoryDoubt::TooSoft,
        HistoryDoubt::EnergyError(1.234e-4),
        HistoryDoubt::Assumed {
            key: "rolling_resistance",
            ratio: 0.02,
        },
        HistoryDoubt::Trips {
            speed_m_s: 1.2345,
            trip_m_s: 0.9876,
        },
        HistoryDoubt::StillMoves,
        HistoryDoubt::MayRockAcross,
        HistoryDoubt::NarrowBase(NarrowBase {
            base_m: 0.0612,
            plan_m: 0.3,
        }),
        HistoryDoubt::HardlyStands(0.0012),
        HistoryDoubt::UnresolvedOnHull,
    ];
    all(&doubts);
    let notes = [
        HistoryNote::Leans,
        HistoryNote::PadsForShockAlone,
        HistoryNote::OneRealisation,
        HistoryNote::Underestimates,
        HistoryNote::Untested,
        HistoryNote::FlatUnderside,
        HistoryNote::Turned(0.0873),
        HistoryNote::HullOfScan,
        HistoryNote::Cushion(two_pads()),
    ];
    all(&notes);
    let objects = |count| SquatObjects {
        count,
        objects: 12,
        height_m: 0.5,
        thickness_m: 0.8,
        landing_ratio: -0.1,
    };
    let of_spectra = [
        SpectrumDoubt::Squat(objects(1)),
        SpectrumDoubt::Squat(objects(3)),
        SpectrumDoubt::Size(size),
        SpectrumDoubt::Validity(squat),
        SpectrumDoubt::OfDeepestLanding(ValidityWarning::BeyondTable {
            compression_mm: 3.456,
        }),
        SpectrumDoubt::Failed {
            failed: 2,
            total: 12,
        },
        SpectrumDoubt::Sensitive {
            sensitive: 3,
            total: 12,
        },
    ];
    all(&of_spectra);
    let few = |upsample, needed| MotionDoubt::FewSteps {
        shortest_s: 0.1,
        dt_s: 0.02,
        upsample,
        needed,
    };
    let of_motions = [
        MotionDoubt::OfRecords("n.csv: a note of its reader".to_owned()),
        MotionDoubt::OtherDirection {
            component: "e".to_owned(),
            stated_deg: 90.0,
            used_deg: 270.0,
        },
        few(1, 2.0),
        few(2, 4.0),
        MotionDoubt::LongPulse,
    ];
    all(&of_motions);
    let told = doubts
        .iter()
        .map(history_doubt)
        .chain(Notes::of(&notes).notes)
        .chain(of_spectra.iter().map(spectrum_doubt))
        .chain(motion_doubts(&of_motions));
    insta::assert_snapshot!(told.collect::<Vec<_>>().join("\n"));
}
