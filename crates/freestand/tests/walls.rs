//! Properties of a rocking block between walls: symmetries, limits, energy, and random trouble.

#![expect(clippy::unwrap_used, reason = "a test may stop at an error")]

use std::f64::consts::{FRAC_PI_2, TAU};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{
    Accuracy, Base, HistoryRecorder, Outcome, REST_OMEGA_RAD_S, Rocking, RockingError,
    RockingModel, RockingOptions, Side, StopReason, Until, rock, rock_many, rock_observed,
};
use freestand::wall::{Wall, WallError, Walls};
use proptest::prelude::*;

fn under(motion: &Motion) -> Base<'_> {
    Base {
        horizontal: Some(motion),
        vertical: None,
    }
}

fn between(walls: Walls) -> RockingOptions {
    RockingOptions {
        walls,
        ..RockingOptions::default()
    }
}

fn both(gap_m: f64) -> Walls {
    Walls {
        left: Some(Wall::at(gap_m)),
        right: Some(Wall::at(gap_m)),
    }
}

fn free(rotation_rad: f64, omega_rad_s: f64, until_s: f64, walls: Walls) -> RockingOptions {
    RockingOptions {
        initial_rotation_rad: rotation_rad,
        initial_omega_rad_s: omega_rad_s,
        until: Until::Time(until_s),
        ..between(walls)
    }
}

/// Two sines that fade, of which the faster one depends on the seed.
fn rough(seed: u64, peak_g: f64, seconds: f64) -> Motion {
    let (fast, phase) = (2.0 + (seed % 97) as f64 / 20.0, (seed % 89) as f64 / 14.0);
    let at = |t: f64| {
        (0.6 * (TAU * 0.7 * t + phase).sin() + 0.5 * (TAU * fast * t).sin()) * (1.0 - t / seconds)
    };
    let dt = 0.01;
    let samples = (0..=(seconds / dt) as u32)
        .map(|i| peak_g * G0_M_S2 * at(f64::from(i) * dt))
        .collect();
    Motion::new(dt, samples).unwrap()
}

/// Walls by three numbers in 0 to 1: which sides, how near, how elastic. A third of the gaps are
/// tiny, and a third put the contact within a hair of the balance point, so that the roots of both
/// fall in one step.
fn walls(block: &Block, sides: u8, near: f64, height: f64, restitution_ratio: f64) -> Walls {
    let h = block.height_m();
    let gap_m = match (near * 3.0) as u8 {
        0 => h * 10f64.powf(-16.0 + 15.0 * 3.0 * near),
        1 => {
            h * (block.pivot().slenderness_angle_rad * (1.0 + 1e-3 * (near - 0.5)))
                .min(1.5)
                .sin()
        }
        _ => h * (3.0 * near - 2.0),
    };
    let height_m = (height < 0.4).then_some(h * (0.02 + 2.0 * height));
    let wall = Some(Wall {
        gap_m,
        height_m,
        restitution_ratio,
    });
    let touching = Some(Wall {
        restitution_ratio,
        ..Wall::at(0.0)
    });
    match sides % 5 {
        0 => Walls {
            left: wall,
            right: None,
        },
        1 => Walls {
            left: None,
            right: wall,
        },
        2 => Walls {
            left: wall,
            right: wall,
        },
        3 => Walls {
            left: touching,
            right: wall,
        },
        _ => Walls {
            left: None,
            right: touching,
        },
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// −ü and the other wall give −θ, to the bit.
    #[test]
    fn mirror(
        seed: u64, height in 0.3f64..4.0, ratio in 0.8f64..8.0, peak in 0.1f64..1.5,
        sides: u8, near in 0.0f64..1.0, low in 0.0f64..1.0, e_w in 0.0f64..0.9,
    ) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, peak, 5.0);
        let walls = walls(&block, sides, near, low, e_w);
        let a = rock(&block, under(&motion), &between(walls)).unwrap();
        let b = rock(&block, under(&motion.scaled(-1.0).unwrap()), &between(walls.mirrored())).unwrap();
        prop_assert_eq!(a.outcome, b.outcome);
        prop_assert_eq!(a.final_rotation_rad, -b.final_rotation_rad);
        prop_assert_eq!(a.peak_rotation_rad, b.peak_rotation_rad);
        prop_assert_eq!(a.impacts.len(), b.impacts.len());
        prop_assert_eq!(a.wall_impacts.len(), b.wall_impacts.len());
        for (x, y) in a.wall_impacts.iter().zip(&b.wall_impacts) {
            prop_assert_eq!((x.time_s, x.omega_before_rad_s), (y.time_s, -y.omega_before_rad_s));
            prop_assert!(x.side != y.side);
        }
    }

    /// Size, gap and wall times 4 and time times 2 give the same θ: powers of two, so to the bit
    /// until speeds come near that of rest, which does not scale.
    #[test]
    fn similarity(
        seed: u64, height in 0.3f64..2.0, ratio in 1.0f64..8.0, peak in 0.1f64..1.5,
        sides: u8, near in 0.0f64..1.0, low in 0.0f64..1.0, e_w in 0.0f64..0.9,
    ) {
        let small = Block::uniform(height, height / ratio).unwrap();
        let large = Block::uniform(4.0 * height, 4.0 * height / ratio).unwrap();
        let fast = rough(seed, peak, 4.0);
        let slow = Motion::new(2.0 * fast.dt_s(), fast.accel_m_s2().to_vec()).unwrap();
        let walls = walls(&small, sides, near, low, e_w);
        let larger = |wall: Wall| {
            Wall { gap_m: 4.0 * wall.gap_m, height_m: wall.height_m.map(|height| 4.0 * height), ..wall }
        };
        let scaled = Walls { left: walls.left.map(larger), right: walls.right.map(larger) };
        let a = rock(&small, under(&fast), &between(walls)).unwrap();
        let b = rock(&large, under(&slow), &between(scaled)).unwrap();
        let quick = |rocking: &Rocking, least: f64| {
            let all = rocking.wall_impacts.iter().take_while(|i| i.omega_after_rad_s.abs() > least);
            all.map(|i| i.omega_before_rad_s).collect::<Vec<_>>()
        };
        // Up to the first rest or lean of either.
        let both = quick(&a, 4.0 * REST_OMEGA_RAD_S).into_iter().zip(quick(&b, 2.0 * REST_OMEGA_RAD_S));
        let count = a.impacts.iter().take_while(|i| i.omega_after_rad_s.abs() > 4.0 * REST_OMEGA_RAD_S).count();
        if count == a.impacts.len() {
            for (x, y) in both {
                prop_assert!((x - 2.0 * y).abs() <= 1e-9 * x.abs(), "{} {}", x, y);
            }
        }
    }

    /// A wall out of reach changes not a bit, and neither does one that is not reached.
    #[test]
    fn a_wall_that_is_not_met_changes_nothing(
        seed: u64, height in 0.3f64..4.0, ratio in 0.8f64..8.0, peak in 0.1f64..1.0, more in 1.0f64..3.0,
    ) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, peak, 6.0);
        let alone = rock(&block, under(&motion), &RockingOptions::default()).unwrap();
        prop_assert_eq!(&rock(&block, under(&motion), &between(both(more * height))).unwrap(), &alone);
        let gap_m = height * (1.001 * alone.peak_rotation_rad + 1e-6).sin();
        if alone.outcome != Outcome::Overturned && gap_m < height {
            let mut met = rock(&block, under(&motion), &between(both(gap_m))).unwrap();
            prop_assert!(met.contacts[0].is_some());
            met.contacts = [None; 2];
            prop_assert_eq!(&met, &alone);
        }
    }

    /// Touching walls on both sides: it never moves.
    #[test]
    fn between_touching_walls_nothing_moves(seed: u64, height in 0.3f64..4.0, ratio in 0.5f64..20.0, peak in 0.0f64..9.0) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let got = rock(&block, under(&rough(seed, peak, 3.0)), &between(both(0.0))).unwrap();
        prop_assert_eq!((got.outcome, got.peak_rotation_rad, got.impacts.len()), (Outcome::NoUplift, 0.0, 0));
        prop_assert_eq!((got.wall_impacts.len(), got.at_rest), (0, true));
    }

    /// Between impacts at rest: ω⁻² = ω₀² + 2p²[cos(α−y₀) − cos(α−θ_c)].
    #[test]
    fn energy(alpha in 0.05f64..1.0, start in 0.0f64..1.0, reach in 0.01f64..1.5, speed in 0.5f64..4.0, left: bool) {
        let block = Block::uniform(2.0 * alpha.cos(), 2.0 * alpha.sin()).unwrap();
        let angle = (reach * alpha).min(1.4);
        let (side, p) = (if left { -1.0 } else { 1.0 }, block.pivot().frequency_parameter_rad_s(G0_M_S2));
        let (y, w) = (start * angle, speed * p * alpha);
        let got = rock(&block, Base::default(), &free(side * y, side * w, 3.0, both(block.height_m() * angle.sin()))).unwrap();
        let squared_at = |rotation: f64| w * w + 2.0 * p * p * ((alpha - y).cos() - (alpha - rotation).cos());
        let expected = squared_at(angle);
        // It is slowest where it balances, or at the wall before that: fast enough there, it certainly
        // gets to the wall.
        if squared_at(alpha.clamp(y, angle)) > 0.01 * w * w {
            let impact = got.wall_impacts[0];
            prop_assert_eq!(impact.side, if left { Side::Left } else { Side::Right });
            // 1e-13 a step over up to a hundred steps.
            prop_assert!((impact.omega_before_rad_s.powi(2) / expected - 1.0).abs() < 1e-10, "{}", expected);
            prop_assert_eq!(impact.omega_after_rad_s, -0.5 * impact.omega_before_rad_s);
            prop_assert!(got.peak_rotation_rad >= impact_angle(&got, left));
        }
    }

    /// Whatever the motion and the gap, histories end, no rotation passes a wall, impacts are in
    /// order and reverse the velocity.
    #[test]
    fn nothing_passes_a_wall(
        seed: u64, log_height in -2.0f64..1.5, ratio in 0.4f64..30.0, log_peak in -1.5f64..2.0,
        sides: u8, near in 0.0f64..1.0, low in 0.0f64..1.0, e_w in 0.0f64..0.99, settle: bool,
    ) {
        let height = 10f64.powf(log_height);
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, 10f64.powf(log_peak) / ratio, 3.0);
        let walls = walls(&block, sides, near, low, e_w);
        let until = if settle { Until::Settled { at_most_s: 60.0 } } else { Until::EndOfMotion };
        let options = RockingOptions { until, ..between(walls) };
        let contacts = walls.contacts(&block).unwrap();
        let ceilings = contacts.map(|contact| contact.map_or(FRAC_PI_2, |contact| contact.angle_rad));
        let mut beyond = 0.0_f64;
        let got = rock_observed(&block, under(&motion), &options, |segment| {
            for part in [0.0, 0.3, 0.7, 1.0] {
                let (theta, _) = segment.rotation(part * segment.end_ratio);
                beyond = beyond.max(theta - ceilings[0]).max(-theta - ceilings[1]);
            }
        }).unwrap();
        // The value of a series at its root: a few roundings of the angle.
        prop_assert!(beyond <= 1e-14, "{}", beyond);
        for (side, ceiling) in got.sides.iter().zip(ceilings) {
            prop_assert!(side.peak_rotation_rad <= ceiling);
        }
        prop_assert!(got.impacts.is_sorted_by(|a, b| a.time_s <= b.time_s));
        prop_assert!(got.wall_impacts.is_sorted_by(|a, b| a.time_s <= b.time_s));
        for impact in &got.wall_impacts {
            prop_assert_eq!(impact.omega_after_rad_s, -e_w * impact.omega_before_rad_s);
        }
        if got.leaning {
            prop_assert!(!got.at_rest && got.final_omega_rad_s == 0.0);
            prop_assert!(ceilings.contains(&got.final_rotation_rad.abs()));
        }
        if got.outcome == Outcome::Leaned {
            prop_assert!(got.final_rotation_rad.abs() >= block.pivot().slenderness_angle_rad);
            prop_assert!(!got.wall_impacts.is_empty());
        }
    }

    /// A gap of 1e-13 m is a touching wall: rule 3 is the limit of the others. A block that has almost
    /// stopped takes the root of 2 gap/a to cross it, 1e-6 s for 1e-11 m: the difference falls as
    /// slowly as that.
    #[test]
    fn a_touching_wall_is_the_limit_of_a_small_gap(
        seed: u64, height in 0.5f64..3.0, ratio in 1.5f64..6.0, peak in 0.2f64..0.8, e_w in 0.0f64..0.8,
    ) {
        let block = Block::uniform(height, height / ratio).unwrap();
        let motion = rough(seed, peak, 4.0);
        let at = |gap_m: f64, factor: f64| {
            let wall = Wall { restitution_ratio: e_w, ..Wall::at(gap_m) };
            let walls = Walls { left: Some(wall), right: None };
            rock(&block, under(&motion.scaled(factor).unwrap()), &between(walls)).unwrap()
        };
        let (touching, other) = (at(0.0, 1.0), at(0.0, 1.0 + 1e-7));
        let sensitive = touching.outcome != other.outcome
            || (touching.peak_rotation_rad - other.peak_rotation_rad).abs() > 1e-5 * touching.peak_rotation_rad;
        prop_assume!(!sensitive);
        let near = at(1e-13, 1.0);
        // The block tilts by the gap before it is pushed against the wall; that is not yet rocking.
        if touching.outcome != Outcome::NoUplift {
            prop_assert_eq!(near.outcome, touching.outcome);
        }
        // 1e-13 m of 0.5 m and 1e-7 s, amplified by up to 100, after speeds that may stop an interval later.
        let apart = (near.peak_rotation_rad - touching.peak_rotation_rad).abs();
        prop_assert!(apart <= 1e-6 * touching.peak_rotation_rad + 3e-11, "{} {}", near.peak_rotation_rad, touching.peak_rotation_rad);
    }
}

fn impact_angle(rocking: &Rocking, left: bool) -> f64 {
    rocking.contacts[usize::from(left)].unwrap().angle_rad
}

/// A block that leans is held at θ_c exactly, and leaves where the base has pulled it off:
/// s ü/g = tan(θ_c − α).
#[test]
fn a_leaning_block_waits_for_the_base() {
    let block = Block::uniform(2.0, 0.3).unwrap();
    let angle = 0.25;
    let walls = Walls {
        right: Some(Wall::at(2.0 * f64::sin(angle))),
        ..Walls::NONE
    };
    let still = Motion::new(0.5, vec![0.0; 5]).unwrap();
    let start = RockingOptions {
        initial_rotation_rad: 0.2,
        until: Until::EndOfMotion,
        ..between(walls)
    };
    let got = rock(&block, under(&still), &start).unwrap();
    assert_eq!(
        (got.outcome, got.leaning, got.at_rest),
        (Outcome::Leaned, true, false)
    );
    assert_eq!(
        (got.final_rotation_rad, got.final_omega_rad_s),
        (impact_angle(&got, false), 0.0)
    );
    let last = got.wall_impacts.last().unwrap();
    assert!(last.omega_after_rad_s.abs() <= REST_OMEGA_RAD_S && got.end_time_s == 2.0);

    // From the same start a ramp of 0.1 g in 10 s pulls it off.
    let samples: Vec<f64> = (0..=200)
        .map(|i| 0.2 * G0_M_S2 * (f64::from(i) - 100.0).max(0.0) / 100.0)
        .collect();
    let ramp = Motion::new(0.1, samples).unwrap();
    let mut recorder = HistoryRecorder::new(Some(&ramp), 0.1);
    let got = rock_observed(&block, under(&ramp), &start, |segment| {
        recorder.observe(segment)
    })
    .unwrap();
    let points = recorder.finish(&got);
    let angle = impact_angle(&got, false);
    let expected_s = 10.0 + (angle - block.pivot().slenderness_angle_rad).tan() / 0.02;
    let off = points
        .iter()
        .rfind(|point| point.theta_rad == angle)
        .unwrap();
    // A root of a straight line over 20 s.
    assert!(
        (off.time_s - expected_s).abs() < 1e-12 * 20.0,
        "{} {expected_s}",
        off.time_s
    );
    assert!(points.iter().all(|point| point.theta_rad <= angle));
    assert!(
        points
            .iter()
            .any(|point| point.theta_rad < 0.9 * angle && point.time_s > expected_s)
    );

    // Waiting for rest ends with the lean.
    let settle = RockingOptions {
        until: Until::Settled { at_most_s: 60.0 },
        ..start
    };
    let got = rock(&block, under(&still), &settle).unwrap();
    assert_eq!(
        (got.stop, got.outcome, got.leaning),
        (StopReason::Settled, Outcome::Leaned, true)
    );
    assert!(got.end_time_s < 10.0);
}

/// Between elastic walls a slender block swings for minutes, across its balance points where the walls are beyond
/// them: what the end of any wait says is what becomes of it.
#[test]
fn what_is_said_at_the_end_of_a_wait_holds() {
    let block = Block::uniform(10.0, 0.5).unwrap();
    for (gap_m, reaches_balance) in [(0.55, true), (0.35, false)] {
        let elastic = Wall {
            restitution_ratio: 0.99,
            ..Wall::at(gap_m)
        };
        let walls = Walls {
            left: Some(elastic),
            right: Some(elastic),
        };
        let after = |at_most_s: f64| {
            let options = RockingOptions {
                until: Until::Settled { at_most_s },
                ..free(0.03, 0.06, 0.0, walls)
            };
            rock(&block, Base::default(), &options).unwrap()
        };
        let later = after(1e4);
        assert_eq!(later.stop, StopReason::Settled);
        let waits: Vec<Rocking> = (1..60).map(|k| after(9.3 * f64::from(k))).collect();
        let open = |one: &&Rocking| one.outcome == Outcome::Unresolved;
        assert_eq!(waits.iter().any(|one| open(&one)), reaches_balance);
        let said = waits.iter().filter(|one| !open(one));
        assert!(said.clone().count() > 0);
        for one in said {
            assert_eq!(
                one.outcome, later.outcome,
                "{gap_m} m, {} s",
                one.end_time_s
            );
        }
    }
}

/// What the shaking presses against a wall before its balance point is neither at rest nor down.
#[test]
fn a_block_that_is_pressed_on_a_wall_is_unresolved() {
    let block = Block::uniform(1.8, 0.5).unwrap();
    let push = Motion::new(0.01, vec![-0.5 * G0_M_S2; 300]).unwrap();
    let options = between(both(0.02));
    let got = rock(&block, under(&push), &options).unwrap();
    assert_eq!((got.outcome, got.leaning), (Outcome::Unresolved, true));
    let many = rock_many(&[block], under(&push), &options);
    assert_eq!(many[0].as_ref().unwrap().outcome, Outcome::Unresolved);
}

/// A base that pushes the block into the wall that it touches leaves it at rest; the other way it
/// uplifts.
#[test]
fn uplift_is_only_away_from_a_touching_wall() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let push = Motion::new(0.01, vec![0.3 * G0_M_S2; 20]).unwrap();
    let left = Walls {
        left: Some(Wall::at(0.0)),
        right: None,
    };
    // A positive ü drives θ negative, to the left.
    assert_eq!(
        rock(&block, under(&push), &between(left)).unwrap().outcome,
        Outcome::NoUplift
    );
    let got = rock(&block, under(&push), &between(left.mirrored())).unwrap();
    assert!(got.outcome == Outcome::Unresolved && got.final_rotation_rad < 0.0);
}

/// A block that falls back on a touching wall: ω⁺ = −e_w r² ω⁻ about its own edge, with both
/// impacts in their lists.
#[test]
fn a_touching_wall_throws_the_block_back() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let walls = Walls {
        left: Some(Wall {
            restitution_ratio: 0.4,
            ..Wall::at(0.0)
        }),
        right: None,
    };
    let got = rock(&block, Base::default(), &free(0.1, 0.0, 20.0, walls)).unwrap();
    let r = block.landing_ratio();
    let (impact, wall) = (got.impacts[0], got.wall_impacts[0]);
    let before = impact.omega_before_rad_s;
    assert!(before < 0.0 && impact.time_s == wall.time_s && wall.side == Side::Left);
    assert_eq!(wall.omega_before_rad_s, r * before);
    assert_eq!(wall.omega_after_rad_s, -0.4 * (r * before));
    assert_eq!(impact.omega_after_rad_s, r * (0.4 * (r * -before)));
    assert!(got.at_rest && got.impacts.len() == got.wall_impacts.len());
    // A start towards the wall is thrown back, lands on the floor and goes on to the other side.
    let got = rock(&block, Base::default(), &free(0.0, -1.0, 0.05, walls)).unwrap();
    assert_eq!(
        (
            got.wall_impacts[0].omega_after_rad_s,
            got.impacts[0].omega_after_rad_s
        ),
        (0.4, 0.4 * r)
    );
    assert!(got.final_rotation_rad > 0.0);
}

#[test]
fn a_recorded_history_passes_through_the_impacts_on_walls() {
    let block = Block::uniform(1.5, 0.4).unwrap();
    let motion = rough(3, 0.45, 6.0);
    let mut recorder = HistoryRecorder::new(Some(&motion), 0.01);
    let options = between(both(0.05));
    let got = rock_observed(&block, under(&motion), &options, |s| recorder.observe(s)).unwrap();
    let points = recorder.finish(&got);
    assert!(points.windows(2).all(|w| w[0].time_s <= w[1].time_s));
    assert!(got.wall_impacts.len() > 3);
    for impact in &got.wall_impacts {
        for omega in [impact.omega_before_rad_s, impact.omega_after_rad_s] {
            // Roundings of the sum of a start and a step, and of a velocity times and over the step.
            let near = points.iter().any(|p| {
                (p.time_s - impact.time_s).abs() < 1e-13 && (p.omega_rad_s - omega).abs() < 1e-13
            });
            assert!(near, "{impact:?} {omega}");
        }
    }
}

#[test]
fn walls_that_make_no_sense_are_refused() {
    let block = Block::uniform(2.0, 0.5).unwrap();
    let with = |options: RockingOptions| rock(&block, Base::default(), &options).unwrap_err();
    let start = |wall: Wall| {
        free(
            0.1,
            0.0,
            1.0,
            Walls {
                left: None,
                right: Some(wall),
            },
        )
    };
    assert!(matches!(
        with(start(Wall::at(-0.1))),
        RockingError::Wall(WallError::Gap { .. })
    ));
    let elastic = Wall {
        restitution_ratio: 1.0,
        ..Wall::at(0.1)
    };
    assert!(matches!(
        with(start(elastic)),
        RockingError::Wall(WallError::Restitution { .. })
    ));
    let error = with(start(Wall::at(0.1)));
    assert!(
        matches!(
            error,
            RockingError::BeyondWall {
                side: Side::Right,
                ..
            }
        ),
        "{error}"
    );
    let linear = RockingOptions {
        model: RockingModel::Linearised,
        ..start(Wall::at(1.0))
    };
    assert_eq!(with(linear), RockingError::LinearisedWall);
    // At the wall itself it may start: past its balance point it leans.
    let angle = both(0.9).contacts(&block).unwrap()[0].unwrap().angle_rad;
    let options = RockingOptions {
        accuracy: Accuracy::Tight,
        ..free(angle, 0.0, 1.0, both(0.9))
    };
    let got = rock(&block, Base::default(), &options).unwrap();
    assert!(got.leaning && got.final_rotation_rad == angle && got.wall_impacts.is_empty());
    assert_eq!(got.outcome, Outcome::Leaned);
}
