//! Every reason and every note in words.

use strum::{EnumCount as _, VariantArray as _};

use super::*;
use crate::assessment::fixture::{assessment, item};

fn p(value: f64, low: f64, high: f64) -> Probability {
    Probability { value, low, high }
}

fn exceeding(value: f64, low: f64, high: f64) -> ModelAnswers {
    ModelAnswers {
        overturn: p(0.0, 0.0, 0.014),
        exceed: Some(p(value, low, high)),
    }
}

/// An object that stands and exceeds the peak of its tolerance, with 320 worlds.
fn answers() -> Answers {
    Answers {
        falls: FallsAnswer::Stays,
        shock: ShockAnswer::Exceeded,
        asks_shock: true,
        models_agree: None,
        worlds: 320,
        worlds_cap: 320,
        worlds_compliant: None,
        confidence: 0.98,
        rigid: Some(exceeding(0.04, 0.02, 0.07)),
        compliant: Some(exceeding(0.31, 0.25, 0.37)),
        restitution_p16_p84: [0.9, 0.95],
        few_motions: None,
        worlds_needed: None,
        too_mild: None,
    }
}

/// A full assessment: every reason finds its numbers.
fn full() -> (Item, Assessment) {
    let item = item(1);
    let mut found = assessment(&item, 0);
    found.answers = Some(Answers {
        rigid: Some(ModelAnswers {
            overturn: p(0.2, 0.16, 0.25),
            exceed: Some(p(0.04, 0.02, 0.07)),
        }),
        ..answers()
    });
    found.restraint[0].anchor_tension_n = 0.0;
    found.restraint[1].source.kind = freestand_assess::restraint::source::SourceKind::Floor;
    found.softening = Some(Softening {
        max_stiffness_n_m: Some(1.1e6),
        stroke_m: Some(0.011),
        pad_thickness_m: 0.04,
        edge_acceleration_g: None,
        p_exceed_high: Some(0.02),
        p_overturn_high: Some(0.014),
        is_assumed: true,
        outcome: PadOutcome::Enough,
    });
    found.rolled = Some(Rolled {
        travel_m_median: 0.1,
        travel_m_p84: 0.3,
        is_at_least: false,
        clearance_m: Some(0.2),
        clearance_needed_m: 0.45,
        room_m: [0.18, 0.29, 0.4],
        stop_share: 0.2,
        stop_speed_m_s_p84: Some(0.5),
        trip_speed_m_s: 0.9,
    });
    found.braked = Some(Braked {
        overturn: p(0.02, 0.01, 0.04),
        worlds: 320,
        stands: true,
    });
    found.stacked = Some(Stacked {
        worlds: 320,
        lower_falls: 3,
        upper_falls: 17,
        threshold_upper_g: 0.2,
        threshold_together_g: 0.3,
    });
    found.in_space = Some(freestand_assess::result::InSpace {
        tilt_rad_median: Ranked::Value(0.02),
        tilt_rad_p84: Ranked::Value(0.05),
        walk_m_median: Ranked::Value(0.01),
        walk_m_p84: Ranked::Value(0.03),
    });
    found.before_wall = Some(BeforeWall {
        touching: p(0.02, 0.01, 0.04),
        at_50_mm: p(0.3, 0.25, 0.36),
    });
    (item, found)
}

/// The wording of every reason and every note, in one place.
#[test]
fn every_reason_in_words() {
    let (item, found) = full();
    let slips = Slips {
        worlds: 12,
        of: 320,
        friction_ratio: (0.2, 0.4),
    };
    let reasons = [
        Reason::Anchored,
        Reason::NoMotion,
        Reason::NotGiven(vec![Missing::Height]),
        Reason::NotGiven(vec![Missing::Level, Missing::Height, Missing::Thickness]),
        Reason::Travels,
        Reason::Falling { lifts: true },
        Reason::Falling { lifts: false },
        Reason::OnlyFalling {
            lacks_tolerance: true,
        },
        Reason::OnlyFalling {
            lacks_tolerance: false,
        },
        Reason::ShockUnknown(vec![Missing::Mass, Missing::Stiffness]),
        Reason::Shock(Some(Criterion::Peak)),
        Reason::Shock(Some(Criterion::FloorAcceleration)),
        Reason::Unchecked,
        Reason::SofterPad,
        Reason::FloorTooStrong,
        Reason::StiffnessIsRange,
        Reason::Leans {
            worlds: 4,
            followed: 320,
        },
        Reason::PadsNotFollowed,
        Reason::NoRoom { room_m: None },
        Reason::Unstated(Unstated::Both),
        Reason::Slips(slips),
        Reason::InSpace,
        Reason::Stacked,
        Reason::BeyondCode {
            overturned: 1,
            worlds: 320,
        },
        Reason::BeyondCode {
            overturned: 7,
            worlds: 20,
        },
        Reason::BeforeWall,
        Reason::Spectrum(2),
        Reason::Stopped { worlds: 0 },
        Reason::Stopped { worlds: 40 },
    ];
    // None is forgotten: what is not listed above is a pad that does not help.
    let named: std::collections::HashSet<_> = reasons.iter().map(std::mem::discriminant).collect();
    assert_eq!(named.len() + 1, Reason::COUNT);
    let pads = [
        NoPad::Rolls,
        NoPad::Slides,
        NoPad::NoPads,
        NoPad::Uplift,
        NoPad::NoSpring,
        NoPad::Other,
    ];
    let mut told: Vec<String> = reasons
        .into_iter()
        .chain(pads.map(Reason::NoPadHelps))
        .map(|reason| format!("{reason:?}\n  {}", sentence(&reason, &item, &found)))
        .collect();
    let failed = |on_pads| Note::Failed {
        on_pads,
        worlds: 2,
        of: 320,
        why: "no end".to_owned(),
    };
    let without = |why| Note::SlipsWithoutPads { slips, why };
    let notes = [
        Note::WallShockUnknown,
        Note::WallShockNotCompared,
        failed(false),
        failed(true),
        Note::TipsAtRest { worlds: 1, of: 20 },
        Note::Flies { worlds: 3, of: 320 },
        Note::FliesWithoutPads,
        without(WithoutPads::BesideWall),
        without(WithoutPads::NotGiven),
        without(WithoutPads::NotFollowed),
        Note::Flat(Flat::Missing(vec![Missing::Mass, Missing::Width])),
        Note::Flat(Flat::NotUniform),
        Note::Flat(Flat::Neighbours),
        Note::Flat(Flat::Stack),
        Note::OneRealisation,
        Note::OneComponent,
        Note::LowWall,
        Note::StackInPlane,
        Note::LowestTail,
    ];
    told.extend(
        notes
            .iter()
            .map(|note| format!("{note:?}\n  {}", of_note(note, &found))),
    );
    insta::assert_snapshot!(told.join("\n"));
}

/// The answers one by one: too close, too mild, too few motions or worlds, and pads that fail.
#[test]
fn answers_and_pads_in_words() {
    let (item, mut found) = full();
    let mut told = Vec::new();
    let mut answered = |name: &str, answers: Answers, reason: Reason| {
        found.answers = Some(answers);
        told.push(format!("{name}\n  {}", sentence(&reason, &item, &found)));
    };
    let falls = |falls| Answers {
        falls,
        rigid: Some(ModelAnswers {
            overturn: p(0.31, 0.25, 0.37),
            exceed: None,
        }),
        compliant: None,
        ..answers()
    };
    let falling = Reason::Falling { lifts: true };
    answered("falls", falls(FallsAnswer::Falls), falling.clone());
    answered("close", falls(FallsAnswer::Close), falling.clone());
    for motions in [1, 3] {
        let few = Answers {
            few_motions: FewMotions::of(motions, Some(44).filter(|_| motions == 3)),
            ..falls(FallsAnswer::Close)
        };
        answered(&format!("{motions} motions"), few, falling.clone());
    }
    let needed = Answers {
        worlds_needed: Some(1200),
        ..falls(FallsAnswer::Close)
    };
    answered("few worlds", needed, falling.clone());
    for why in [TooMild::Round, TooMild::TouchesWall] {
        let mild = Answers {
            too_mild: Some(why),
            ..falls(FallsAnswer::Close)
        };
        answered("too mild", mild, falling.clone());
    }
    for shock in [ShockAnswer::Stands, ShockAnswer::Close] {
        let shocked = Answers { shock, ..answers() };
        answered(
            <&str>::from(shock),
            shocked,
            Reason::Shock(Some(Criterion::Spectrum)),
        );
    }
    for outcome in [
        PadOutcome::Pressed(0.25),
        PadOutcome::Falls,
        PadOutcome::Exceeded { is_close: true },
        PadOutcome::Exceeded { is_close: false },
    ] {
        found.softening.as_mut().unwrap().outcome = outcome;
        let said = sentence(&Reason::SofterPad, &item, &found);
        told.push(format!("{outcome:?}\n  {said}"));
    }
    for (model, stands, high) in [
        (ObjectModel::Roll, false, 0.3),
        (ObjectModel::Slide, false, 0.04),
        (ObjectModel::Slide, true, 0.04),
    ] {
        found.model = Some(model);
        found.rolled = found.rolled.map(|rolled| Rolled {
            clearance_m: None,
            ..rolled
        });
        found.braked = Some(Braked {
            overturn: p(0.02, 0.01, high),
            worlds: 320,
            stands,
        });
        let reason = Reason::NoRoom { room_m: Some(0.1) };
        let said = sentence(&reason, &item, &found);
        told.push(format!(
            "{model:?}, {stands}, {}\n  {said}",
            number(high, 2)
        ));
    }
    for wall_gap_m in [None, Some(0.1)] {
        let mut beside = item.clone();
        beside.surroundings.wall_gap_m = wall_gap_m;
        let said = sentence(&Reason::Travels, &beside, &found);
        told.push(format!("travels without a clearance\n  {said}"));
    }
    let mut say = |name: &str, found: &Assessment, reason: Reason| {
        told.push(format!("{name}\n  {}", sentence(&reason, &item, found)));
    };
    for criterion in [
        Criterion::DamageBoundary,
        Criterion::VelocityChange,
        Criterion::EdgeLift,
        Criterion::Overturning,
    ] {
        found.answers = Some(answers());
        say("exceeds", &found, Reason::Shock(Some(criterion)));
    }
    say("exceeds", &found, Reason::Shock(None));
    let often = Answers {
        rigid: Some(ModelAnswers {
            overturn: p(0.8, 0.7, 0.9),
            exceed: None,
        }),
        compliant: None,
        ..answers()
    };
    found.answers = Some(often.clone());
    say(
        "stays, mostly falling",
        &found,
        Reason::Falling { lifts: true },
    );
    found.answers = Some(Answers {
        falls: FallsAnswer::Falls,
        too_mild: Some(TooMild::Round),
        ..often
    });
    say(
        "falls and too mild",
        &found,
        Reason::Falling { lifts: true },
    );
    let (near, far) = (p(0.02, 0.01, 0.04), p(0.3, 0.25, 0.36));
    for (touching, at_50_mm) in [
        (near, near),
        (far, near),
        (far, far),
        (p(0.1, 0.05, 0.2), far),
    ] {
        found.before_wall = Some(BeforeWall { touching, at_50_mm });
        say("before a wall", &found, Reason::BeforeWall);
    }
    found.in_space = None;
    found.stacked = found.stacked.map(|stack| Stacked {
        threshold_upper_g: 0.4,
        ..stack
    });
    let mut walled = item.clone();
    walled.surroundings.wall_gap_m = Some(0.05);
    told.push(sentence(&Reason::Stacked, &walled, &found));
    walled.surroundings.casters = Some(Casters::Free);
    walled.width_m = None;
    told.push(sentence(&Reason::Stacked, &walled, &found));
    told.push(joined(of_item(&walled).into_iter()));
    insta::assert_snapshot!(told.join("\n"));
}

#[test]
fn everything_that_may_be_missing() {
    insta::assert_snapshot!(Missing::listed(Missing::VARIANTS));
}
