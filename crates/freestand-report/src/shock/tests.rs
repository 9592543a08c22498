//! Every doubt and every note of a shock, in words.

use freestand::impact::ValidityWarning;
use freestand_study::shock::BalancePoint;

use super::*;
use crate::doubts::tests::{all, two_pads};

#[test]
fn every_doubt_and_note_in_words() {
    let of_tests = [
        TestsDoubt::NoShock(TestMethod::A),
        TestsDoubt::NoneSurvived(TestMethod::B),
        TestsDoubt::AllIgnored(TestMethod::B),
        TestsDoubt::NoDamage(TestMethod::A),
        TestsDoubt::BelowKnee(vec![3, 7]),
        TestsDoubt::WeakPeaks(vec![2]),
    ];
    all(&of_tests);
    let mut doubts = vec![
        ShockDoubt::FromRest,
        ShockDoubt::BeyondBalance(BalancePoint {
            rise_m: 0.0384,
            rotation_rad: 0.25526,
            uplift_m: 0.1515,
        }),
        ShockDoubt::Validity(ValidityWarning::Sliding {
            needed_ratio: 0.61,
            friction_ratio: 0.5,
            in_impact: true,
        }),
        ShockDoubt::EdgeUnused,
        ShockDoubt::RiseUnused,
        ShockDoubt::FreeCorner,
        ShockDoubt::PointOutside,
        ShockDoubt::ComponentNotCompared,
        ShockDoubt::UpliftNotCompared,
    ];
    doubts.extend(of_tests.map(ShockDoubt::Tests));
    all(&doubts);
    let notes = [
        ShockNote::Cushion(two_pads()),
        ShockNote::ImpliedStiffness(4.38e6),
        ShockNote::NoLargestStiffness(NoLargestStiffness::UpliftTooLarge),
        ShockNote::NoLargestStiffness(NoLargestStiffness::VelocityChangeTooLarge),
        ShockNote::NoLargestStiffness(NoLargestStiffness::VelocityChangeSmall),
        ShockNote::NoLargestStiffness(NoLargestStiffness::AnyWillDo),
    ];
    all(&notes);
    let told = doubts.iter().map(shock_doubt).chain(notes.iter().map(note));
    insta::assert_snapshot!(told.collect::<Vec<_>>().join("\n"));
}
