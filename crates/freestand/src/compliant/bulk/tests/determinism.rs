//! The same bits whatever else is done.

use super::*;

/// Every number of a result, or its error.
fn bits(results: &[Result<CompliantSummary, CompliantError>]) -> Vec<String> {
    let of = |done: &CompliantSummary| {
        let times = [
            done.pulse_duration_s,
            done.contact_duration_s,
            done.let_go_time_s,
        ];
        let more = [done.first_uplift_time_s, done.overturn_time_s];
        let numbers = [
            done.pad_uplift_ratio,
            done.lift_m,
            done.peak_edge_accelerations_m_s2[0],
            done.peak_edge_accelerations_m_s2[1],
            done.touch_speed_m_s,
            done.velocity_change_m_s,
            done.peak_compression_m,
        ];
        let times = times
            .into_iter()
            .chain(more)
            .map(|time| time.map(f64::to_bits));
        let times: Vec<Option<u64>> = times.collect();
        format!(
            "{:?} {} {:x?} {times:x?}",
            done.outcome,
            done.touch_count,
            numbers.map(f64::to_bits)
        )
    };
    results
        .iter()
        .map(|result| result.as_ref().map_or_else(ToString::to_string, of))
        .collect()
}

/// Worlds of many kinds: some stay, some lift, some fall; other steps, vertical motion, no dashpots,
/// an offset, lengths of motion, and some that cannot be followed.
fn mixed(motions: &[Motion], still: &Motion) -> Vec<(Object, Motion, Option<Motion>)> {
    let mut mixed = Vec::new();
    for (i, motion) in motions.iter().enumerate() {
        for (j, mut object) in objects().into_iter().enumerate() {
            let to_s = [5.0, 9.0, 7.0][(i + j) % 3];
            let horizontal = part(
                motion,
                2.0,
                to_s,
                [0.5, 1.2, 2.0, 4.0][(i + 2 * j) % 4] * object.up_m_s2(),
            );
            object.damping_ratio = [0.05, 0.1, 0.2, 0.0][i % 4];
            if (i + j) % 11 == 3 {
                object.mass_kg *= -1.0;
            }
            if j % 3 == 2 {
                // Another number of steps in a sample.
                let slow = Motion::new(0.004, horizontal.accel_m_s2().to_vec()).unwrap();
                mixed.push((object, slow, None));
            } else if (i + j) % 3 == 1 {
                let vertical = part(motion, 3.0, to_s + 1.0, 2.0);
                mixed.push((object, horizontal, Some(vertical)));
            } else {
                mixed.push((object, horizontal, None));
            }
        }
    }
    mixed.push((rack(), still.clone(), None));
    mixed
}

fn worlds(mixed: &[(Object, Motion, Option<Motion>)]) -> Vec<CompliantWorld<'_>> {
    mixed
        .iter()
        .map(|(object, horizontal, vertical)| CompliantWorld {
            motion: Base {
                horizontal: Some(horizontal),
                vertical: vertical.as_ref(),
            },
            ..object.world(horizontal)
        })
        .collect()
}

#[test]
#[ignore = "ten seconds: every batch many times"]
fn no_result_depends_on_order_company_or_threads() {
    let still = Motion::new(0.01, vec![0.0; 50]).unwrap();
    let mixed = mixed(&motions(4), &still);
    let worlds = worlds(&mixed);
    let all = bits(&rock_compliant_many(&worlds, G0_M_S2));
    assert!(all.iter().any(|one| one.starts_with("StayedOn")), "{all:?}");
    assert!(
        all.iter().any(|one| one.starts_with("LetGo"))
            && all.iter().any(|one| one.starts_with("Overturned"))
    );
    assert!(all.iter().any(|one| one.contains("mass")));
    let reversed: Vec<CompliantWorld> = worlds.iter().rev().copied().collect();
    let mut backwards = bits(&rock_compliant_many(&reversed, G0_M_S2));
    backwards.reverse();
    assert_eq!(all, backwards);
    for (i, world) in worlds.iter().enumerate() {
        assert_eq!(
            all[i..=i],
            bits(&rock_compliant_many(&[*world], G0_M_S2)),
            "world {i} alone"
        );
    }
    // Every number of lanes that are left over.
    for count in 0..worlds.len() {
        assert_eq!(
            all[..count],
            bits(&rock_compliant_many(&worlds[..count], G0_M_S2)),
            "{count} worlds"
        );
    }
    // More worlds than one thread takes at once.
    let many: Vec<CompliantWorld> = (0..2 * WORLDS + 9)
        .map(|i| worlds[i % worlds.len()])
        .collect();
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let found = bits(&pool.install(|| rock_compliant_many(&many, G0_M_S2)));
        for (i, one) in found.iter().enumerate() {
            assert_eq!(*one, all[i % all.len()], "{threads} threads, world {i}");
        }
    }
}

/// A push that lifts a rack, a pause of which it needs about 2.6 s to settle, and then a smaller push with a jolt from
/// below: the push makes an edge lose so much of its load that the world leaves the linear equations, and the jolt sets
/// the extremes some samples later.
fn lifts_twice(pause: usize, rest: usize) -> [Motion; 2] {
    let half_sine = |i: usize, from: usize, count: usize, peak_m_s2: f64| {
        let gone = i.wrapping_sub(from);
        let angle = std::f64::consts::PI * gone as f64 / count as f64;
        if gone < count {
            peak_m_s2 * angle.sin()
        } else {
            0.0
        }
    };
    let again = 80 + pause;
    let horizontal = |i| {
        let first = half_sine(i, 0, 40, 6.0) - half_sine(i, 40, 40, 6.0);
        first + half_sine(i, again, 30, 2.5)
    };
    let vertical = |i| half_sine(i, again + 14, 16, 20.0);
    let samples = 0..again + 40 + rest;
    [
        samples.clone().map(horizontal).collect(),
        samples.map(vertical).collect(),
    ]
    .map(|samples| Motion::new(0.005, samples).unwrap())
}

/// What the linear equations of both edges say after an edge let go once more does not count: how far they go on
/// depends on the worlds beside it.
#[test]
fn a_world_that_lets_go_again_does_not_depend_on_its_company() {
    let object = Object {
        damping_ratio: 0.2,
        ..rack()
    };
    let mut made = Vec::new();
    for i in 0..12 {
        let [horizontal, vertical] = lifts_twice(600 + 5 * i, 11 * i);
        made.push((object, horizontal, Some(vertical)));
    }
    for i in 0..24 {
        let quiet = Motion::new(0.005, vec![0.1; 90 + 29 * i]).unwrap();
        made.push((object, quiet, None));
    }
    let worlds = worlds(&made);
    let first_push = made[0].1.accel_m_s2()[..600].to_vec();
    let first_push = Motion::new(0.005, first_push).unwrap();
    let once = &follow_all(&[object.world(&first_push)])[0];
    for twice in follow_all(&worlds[..12]) {
        assert!(once.touch_count > 0 && twice.touch_count > once.touch_count);
        assert!(twice.peak_edge_acceleration_m_s2() > once.peak_edge_acceleration_m_s2());
    }

    // One thread has all of them, as on a machine of one processor.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let found =
        |worlds: &[CompliantWorld]| pool.install(|| bits(&rock_compliant_many(worlds, G0_M_S2)));
    let alone: Vec<String> = worlds.iter().flat_map(|one| found(&[*one])).collect();
    assert_eq!(alone, found(&worlds));
    assert_eq!(alone[..12], found(&worlds[..12]));
    let reversed: Vec<CompliantWorld> = worlds.iter().rev().copied().collect();
    let mut backwards = found(&reversed);
    backwards.reverse();
    assert_eq!(alone, backwards);
}

/// The steps within samples that a bound leaves out: taken, they find nothing.
#[test]
fn steps_that_are_left_out_would_change_nothing() {
    let still = Motion::new(0.01, vec![0.0; 50]).unwrap();
    let mixed = mixed(&motions(2), &still);
    let worlds = worlds(&mixed);
    let found = |everywhere: bool| {
        let ready = worlds.iter().filter_map(|one| prepare(one, G0_M_S2).ok());
        let mut ready: Vec<World> = ready.collect();
        if everywhere {
            ready.iter_mut().for_each(World::look_everywhere);
        }
        crew::run(pulp::Arch::new(), &mut ready);
        let results: Vec<_> = ready.into_iter().map(World::result).collect();
        bits(&results)
    };
    assert_eq!(found(false), found(true));
}

#[test]
fn every_vector_unit_gives_the_same_bits() {
    let still = Motion::new(0.01, vec![0.0; 50]).unwrap();
    let mixed = mixed(&motions(2), &still);
    let worlds = worlds(&mixed);
    let plain = bits(&rock_compliant_many_on(
        pulp::Arch::Scalar,
        &worlds,
        G0_M_S2,
    ));
    assert_eq!(
        plain,
        bits(&rock_compliant_many(&worlds, G0_M_S2)),
        "the default"
    );
    for (name, arch) in vector_units() {
        let found = bits(&rock_compliant_many_on(arch, &worlds, G0_M_S2));
        assert_eq!(plain, found, "{name} against one lane at a time");
    }
}

/// The vector units of this processor by name; prints those that it lacks.
#[cfg(target_arch = "x86_64")]
fn vector_units() -> Vec<(&'static str, pulp::Arch)> {
    let units = [
        ("x86-64-v3", pulp::x86::V3::try_new().map(pulp::Arch::V3)),
        ("x86-64-v4", pulp::x86::V4::try_new().map(pulp::Arch::V4)),
    ];
    for (name, _) in units.iter().filter(|(_, arch)| arch.is_none()) {
        println!("skipped: this processor has no {name}");
    }
    units
        .into_iter()
        .filter_map(|(name, arch)| Some((name, arch?)))
        .collect()
}

/// Elsewhere there is one vector unit, and it is the default.
#[cfg(not(target_arch = "x86_64"))]
fn vector_units() -> Vec<(&'static str, pulp::Arch)> {
    println!("skipped: the vector units of x86-64");
    Vec::new()
}
