//! Everything that there is to know of a study, in words.

use std::collections::HashSet;
use std::mem::discriminant;

use freestand::code_spectrum::{FrameKind, PeriodCode, SiteClass};
use freestand::impact::ValidityWarning;
use freestand::synthesis::{HighCut, Misfit, Preset};
use freestand_records::tables::hazard::{Coordinates, Statistic};
use freestand_study::doubt::SquatObjects;
use freestand_study::places::{Derived, PlaceDoubt, WhyDoubted};
use freestand_study::simulated::{OutsideLimits, PresetAssumption, SimulationAssumption};
use freestand_study::study::Share;
use freestand_study::target::{AnnexSpectrum, TargetDoubt};
use strum::EnumCount;

use super::*;

/// None is forgotten: as many kinds are listed as there are.
fn all<T: EnumCount>(listed: Vec<T>) -> Vec<T> {
    let kinds: HashSet<_> = listed.iter().map(discriminant).collect();
    assert_eq!(kinds.len(), T::COUNT);
    listed
}

fn lines<T>(listed: &[T], words: impl Fn(&T) -> String) -> String {
    listed.iter().map(words).collect::<Vec<_>>().join("\n")
}

fn place(why: WhyDoubted) -> TargetDoubt {
    TargetDoubt::Place(PlaceDoubt {
        place: "Quito".to_owned(),
        values: "a_gR = 0.4 g".to_owned(),
        why,
    })
}

fn targets() -> Vec<TargetDoubt> {
    let name = || "uhs.csv".to_owned();
    let annex = |number, reference_acceleration_g| AnnexSpectrum {
        number,
        reference_acceleration_g,
    };
    let reasons = all(vec![
        WhyDoubted::AnnexNotRead,
        WhyDoubted::PerhapsAbroad,
        WhyDoubted::Approximate,
        WhyDoubted::Shape {
            by: None,
            is_approximate: false,
        },
        WhyDoubted::Shape {
            by: Some("NEC-SE-DS 2015"),
            is_approximate: true,
        },
    ]);
    let mut doubts = vec![
        TargetDoubt::EditionUnread,
        TargetDoubt::Derived {
            place: "Athens".to_owned(),
            derived: Derived {
                read_years: 475,
                years: 2475,
                slopes: [3.0, 1.9, 4.4],
                between_years: None,
            },
        },
        TargetDoubt::PlaceAssumed("Melbourne"),
        TargetDoubt::MinimumGoverns {
            least_ratio: 0.08,
            years: 500,
            hazard_factor: 0.03,
        },
        TargetDoubt::MaximumGoverns { zr_ratio: 1.08 },
        TargetDoubt::TwoSpectra([annex(1, 0.1), annex(2, 0.17)]),
        TargetDoubt::OwnShape,
        TargetDoubt::AsksForStudy,
        TargetDoubt::CoefficientsOf2016,
        TargetDoubt::BeginsLate {
            name: name(),
            first_s: 0.1,
        },
        TargetDoubt::EndsEarly {
            name: name(),
            last_s: 1.0,
        },
        TargetDoubt::OtherSite {
            name: name(),
            years: Some(475.0),
            at: Coordinates {
                latitude_deg: 41.01,
                longitude_deg: 28.97,
            },
            distance_km: 5.97,
        },
        TargetDoubt::NotMean {
            name: name(),
            statistic: Statistic::Quantile(0.84),
        },
    ];
    doubts.extend(reasons.into_iter().map(place));
    all(doubts)
}

#[test]
fn every_doubt_of_a_spectrum_in_words() {
    insta::assert_snapshot!(lines(&targets(), target_doubt));
}

#[test]
fn every_assumption_of_a_simulation_in_words() {
    let high_cut = HighCut::MaximumFrequency { frequency_hz: 20.0 };
    let of_presets = all(vec![
        PresetAssumption::OtherRegions {
            stress_drop_pa: Some(19.3e6),
            high_cut: Some(HighCut::Kappa { kappa_s: 0.04 }),
        },
        PresetAssumption::OtherRegions {
            stress_drop_pa: None,
            high_cut: None,
        },
        PresetAssumption::CutRecalled {
            high_cut,
            after: "Allen (2012)",
        },
        PresetAssumption::ForeignProfile,
        PresetAssumption::DeepSources(50e6),
        PresetAssumption::OtherStress(30e6),
        PresetAssumption::OtherCut(high_cut),
        PresetAssumption::HardRock,
    ]);
    let of_preset = |one| SimulationAssumption::OfPreset(Preset::Victoria, one);
    let mut assumptions: Vec<_> = of_presets.into_iter().map(of_preset).collect();
    assumptions.extend([
        SimulationAssumption::PathOfBoore,
        SimulationAssumption::DurationOfOneCorner,
        SimulationAssumption::QualityFitted {
            lowest_hz: 0.78,
            highest_hz: 19.9,
        },
        SimulationAssumption::SiteRatio(SiteClass::De),
        SimulationAssumption::DistancesFound,
    ]);
    insta::assert_snapshot!(lines(&all(assumptions), simulation_assumption));
}

#[test]
fn every_doubt_of_a_study_in_words() {
    let file = || "tower.csv".to_owned();
    let modes = |doubt| BuildingDoubt::Modes {
        file: file(),
        doubt,
    };
    let buildings = all(vec![
        BuildingDoubt::LooksLikeElevations { file: file() },
        modes(ModalDoubt::EffectiveMass { sum_ratio: 1.2 }),
        modes(ModalDoubt::EffectiveMass { sum_ratio: 0.78 }),
        modes(ModalDoubt::RoofShare { sum_ratio: 1.9 }),
        BuildingDoubt::TooHigh {
            code: PeriodCode::Eurocode8,
            greatest_m: 40.0,
            height_m: 96.0,
        },
        BuildingDoubt::FormulaUnread(PeriodCode::Nzs1170_5),
    ]);
    let left_out = |file: &str| LeftOut {
        file: file.to_owned(),
        reason: "cannot be read".to_owned(),
    };
    let dispersion = |rms| {
        SuiteDoubt::Dispersion(Dispersion {
            rms,
            least: 0.2,
            most: 0.71,
            asked: 0.6,
        })
    };
    let suites = all(vec![
        SuiteDoubt::LeftOut(vec![left_out("a.csv")]),
        SuiteDoubt::LeftOut(["a.csv", "b.csv"].map(left_out).to_vec()),
        SuiteDoubt::MeanOff(MeanOff {
            rms: 0.123,
            worst_ln: -0.4,
        }),
        dispersion(0.45),
        dispersion(0.75),
    ]);
    let friction = |is_assumed| UsedFriction {
        ratio: 0.5,
        is_assumed,
    };
    let share = Share { count: 2, of: 130 };
    let mut doubts: Vec<StudyDoubt> = buildings.into_iter().map(StudyDoubt::Building).collect();
    doubts.extend(suites.into_iter().map(StudyDoubt::Suite));
    doubts.extend([
        // Keys are named as in files.
        StudyDoubt::Target(TargetDoubt::PlaceAssumed("Melbourne")),
        StudyDoubt::Restraint(TargetDoubt::AsksForStudy),
        StudyDoubt::OutsideLimits(OutsideLimits {
            magnitude: 7.5,
            distance_m: 600e3,
        }),
        StudyDoubt::Simulated(SimulationAssumption::DurationOfOneCorner),
        StudyDoubt::VerticalUnused,
        StudyDoubt::AcrossUnused,
        StudyDoubt::BuildingAssumed {
            storeys: 30,
            height_m: 96.0,
        },
        StudyDoubt::Cushion(ValidityWarning::BeyondTable {
            compression_mm: 3.456,
        }),
        StudyDoubt::Squat(SquatObjects {
            count: 2,
            objects: 5,
            height_m: 0.3,
            thickness_m: 0.5,
            landing_ratio: -0.1,
        }),
        StudyDoubt::OfType {
            number: 2,
            doubt: Box::new(StudyDoubt::NoPulses),
        },
        StudyDoubt::OfRecords("`resample` of a record".to_owned()),
        StudyDoubt::HighPeak(1.234),
        StudyDoubt::Failed(share),
        StudyDoubt::Unsettled(share),
        StudyDoubt::NoPulses,
        StudyDoubt::Slide(share, friction(true)),
        StudyDoubt::Slip(share, friction(false)),
        StudyDoubt::NoHistory("an error".to_owned()),
    ]);
    insta::assert_snapshot!(lines(&all(doubts), study_doubt));
}

#[test]
fn everything_that_nobody_stated_in_words() {
    let sources = all(vec![
        PeriodFrom::Given,
        PeriodFrom::Storeys,
        PeriodFrom::Modes,
        PeriodFrom::Formula {
            code: PeriodCode::As1170_4,
            frame: FrameKind::MomentConcrete,
            height_m: 40.0,
        },
    ]);
    let values = all(vec![
        Assumed::Place(Some("Melbourne".to_owned())),
        Assumed::Place(None),
        Assumed::Site("site class De".to_owned()),
        Assumed::ReturnPeriod(500),
        Assumed::NoVertical,
        Assumed::Building(30),
        Assumed::StoreyHeight(3.2),
        Assumed::Damping(0.05),
        Assumed::WallsAndFrames,
        Assumed::FirstPeriod {
            period_s: 1.9166,
            from: sources[3],
        },
    ]);
    let told = [
        lines(&sources, period_from),
        lines(&values, |one| assumed(one, UnitSystem::Si)),
    ];
    insta::assert_snapshot!(told.join("\n"));
}

#[test]
fn every_doubt_of_fitted_motions_and_everything_that_is_not_varied_in_words() {
    let fits = all(vec![
        FitDoubt::Target(TargetDoubt::OwnShape),
        FitDoubt::Poor {
            name: "synthetic-01".to_owned(),
            misfit: Misfit {
                rms_ratio: 0.123,
                worst_ratio: -0.4,
                worst_period_s: 0.05,
                pga_g: 0.1,
                target_zpa_g: 0.08,
                d5_95_s: 12.0,
                pgv_m_s: 0.1,
            },
        },
        FitDoubt::HighPeak(1.234),
        FitDoubt::PeakScaled {
            before_ratio: 0.031,
            after_ratio: 0.052,
        },
    ]);
    let results = all(vec![
        NoResult::Unchanged(Same::Modes),
        NoResult::Unchanged(Same::Objects),
        NoResult::Unchanged(Same::Motions),
        NoResult::Failed("an error".to_owned()),
    ]);
    let reasons = all(vec![
        WhyNotVaried::DefaultsChangeNothing,
        WhyNotVaried::NoDefaults,
        WhyNotVaried::OtherMotions,
        WhyNotVaried::MotionsOfFloors,
        WhyNotVaried::DampingOfTable,
        WhyNotVaried::BuildingOfTable,
        WhyNotVaried::Synthetic,
        WhyNotVaried::Simulated,
        WhyNotVaried::OneEarthquake,
        WhyNotVaried::MatchedSeed,
        WhyNotVaried::SuiteSeed,
        WhyNotVaried::SuiteScale,
        WhyNotVaried::MatchedScale,
        WhyNotVaried::Files,
    ]);
    let reason = |why: &WhyNotVaried| {
        not_varied(&NotVaried {
            key: "site",
            why: *why,
        })
    };
    let told = [
        lines(&fits, fit_doubt),
        lines(&results, no_result),
        lines(&reasons, reason),
    ];
    insta::assert_snapshot!(told.join("\n"));
}
