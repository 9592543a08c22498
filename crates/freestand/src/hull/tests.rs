mod walls;

use super::*;
use crate::motion::Motion;
use crate::spatial::SpatialMotion;
use shake::{Contact, HullOutcome, HullPoint, Sampling, shake_observed};

fn shake(
    body: &standing::Standing,
    contact: &Contact,
    yaw_rad: f64,
    motion: &SpatialMotion,
    gravity_m_s2: f64,
) -> shake::HullRocking {
    shake::shake(body, contact, yaw_rad, motion, gravity_m_s2).unwrap()
}

/// A uniform box of these sizes with its centre of gravity off the middle, and its moments of inertia as
/// if it were in the middle.
fn cuboid(sizes_m: Vector, offset_m: Vector) -> HullBody {
    let corner = |at: usize| {
        [0, 1, 2].map(|axis| {
            let side = if at >> axis & 1 == 1 { 0.5 } else { -0.5 };
            side * sizes_m[axis] - offset_m[axis]
        })
    };
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let hull = Hull::new((0..8).map(corner).collect(), faces.to_vec()).unwrap();
    let mass_kg = 100.0;
    let [x, y, z] = sizes_m.map(|size| size * size);
    let moments = [y + z, x + z, x + y].map(|sum| mass_kg * sum / 12.0);
    let inertia = [0, 1, 2].map(|i| {
        let mut row = [0.0; 3];
        row[i] = moments[i];
        row
    });
    HullBody::new(mass_kg, inertia, hull).unwrap()
}

/// A constant acceleration along x, reached within half a second.
fn ramp(accel_m_s2: f64, duration_s: f64) -> Motion {
    let samples = (duration_s / 0.01) as usize;
    let at = |i: usize| accel_m_s2 * (i as f64 / 50.0).min(1.0);
    Motion::new(0.01, (0..samples).map(at).collect()).unwrap()
}

fn along_x(motion: &Motion) -> SpatialMotion<'_> {
    SpatialMotion {
        x: Some(motion),
        ..SpatialMotion::default()
    }
}

/// A box stands on each of its six sides.
#[test]
fn a_box_stands_on_six_sides() {
    let body = cuboid([0.4, 0.6, 1.0], [0.05, 0.0, 0.0]);
    let poses = body.hull.stable_poses();
    assert_eq!(poses.len(), 6);
    let upright = poses[0];
    assert_eq!(upright, body.hull.standing().unwrap());
    assert!((upright.cg_height_m - 0.5).abs() < 1e-15);
    let mut heights: Vec<f64> = poses.iter().map(|pose| pose.cg_height_m).collect();
    heights.sort_by(f64::total_cmp);
    for (height, expected) in heights.iter().zip([0.15, 0.25, 0.3, 0.3, 0.5, 0.5]) {
        assert!((height - expected).abs() < 1e-15, "{heights:?}");
    }
}

/// Over an edge the centre of gravity rises from h to √(h² + e²): the angle is that of the edge.
#[test]
fn the_barrier_of_a_box_is_its_edge() {
    let body = cuboid([0.4, 0.6, 1.0], [0.05, 0.0, 0.0]);
    let barrier = body.hull.barrier(&body.hull.standing().unwrap());
    let expected = 0.5_f64.hypot(0.15) - 0.5;
    // The grid of 0.1° finds a maximum to (0.05°)²/2 of the radius, 0.2 µm.
    assert!((barrier.rise_m - expected).abs() < 1e-6, "{barrier:?}");
    let edge_rad = (0.15_f64 / 0.5).atan();
    assert!((barrier.angle_rad() - edge_rad).abs() < 1e-5);
    // A step of the finer grid.
    assert!((barrier.tilt_rad - edge_rad).abs() < 0.0125_f64.to_radians());
    assert!(barrier.toward_rad.abs() < 0.01, "{barrier:?}");
    // Four corners carry it for every tilt.
    let points = body.hull.contact_points_m(&body.hull.standing().unwrap());
    assert_eq!(points.len(), 4);
    assert!(points.iter().all(|point| point[2] == -0.5));
}

/// Under a steady acceleration it stands below g e/h and falls above it.
#[test]
fn it_tips_at_the_angle_of_its_edge() {
    let body = cuboid([0.4, 0.6, 1.0], [0.0; 3]);
    let standing = body.standing(0).unwrap();
    let threshold = 9.81 * 0.2 / 0.5;
    let contact = Contact {
        friction_ratio: 1.0,
        ..Contact::default()
    };
    let under = |share: f64| {
        let motion = ramp(share * threshold, 6.0);
        shake(&standing, &contact, 0.0, &along_x(&motion), 9.81)
    };
    // Its contacts give way by 0.1 mm, which lowers the threshold by a thousandth.
    assert_eq!(under(0.99).outcome, HullOutcome::Stood);
    assert!(under(0.99).peak_tilt_rad < 0.005);
    assert_eq!(under(1.01).outcome, HullOutcome::Overturned);
    // Turned by a right angle, the other sides count: 0.3/0.5.
    let motion = ramp(1.2 * threshold, 6.0);
    let turned = shake(
        &standing,
        &contact,
        std::f64::consts::FRAC_PI_2,
        &along_x(&motion),
        9.81,
    );
    assert_eq!(turned.outcome, HullOutcome::Stood);
}

/// With little friction it slides: the floor runs away from it with a(t) − μg, and it stops when the
/// speeds are equal again.
#[test]
fn it_slides_by_coulombs_law() {
    let body = cuboid([1.0, 1.0, 0.3], [0.0; 3]);
    let contact = Contact {
        friction_ratio: 0.1,
        ..Contact::default()
    };
    // 2 m/s² for one second, then −2 m/s² for one second.
    let accel = (0..200).map(|i| if i < 100 { 2.0 } else { -2.0 }).collect();
    let motion = Motion::new(0.01, accel).unwrap();
    let found = shake(
        &body.standing(0).unwrap(),
        &contact,
        0.0,
        &along_x(&motion),
        9.81,
    );
    // Relative to the floor: −(2 − μg) for 1 s, then +(2 + μg) until at rest.
    let mu_g = 0.981_f64;
    let (slow, fast) = (2.0 - mu_g, 2.0 + mu_g);
    let first = 0.5 * slow;
    let second = 0.5 * slow * slow / fast;
    // From there the floor leaves it the other way: again 2 − μg for what is left of the second, then μg.
    let left_s = 1.0 - slow / fast;
    let back = 0.5 * slow * left_s * left_s + 0.5 * (slow * left_s).powi(2) / mu_g;
    let expected = -(first + second) + back;
    // Between two samples the acceleration is a ramp, 10 ms long at each end: 1 % of a second.
    assert!(
        (found.moved_m[0] - expected).abs() < 0.02,
        "{found:?} {expected}"
    );
    assert!(found.moved_m[1].abs() < 1e-9 && found.outcome == HullOutcome::Stood);
}

/// A weak motion moves nothing, and the same history gives the same bits.
#[test]
fn at_rest_it_stays() {
    let body = cuboid([0.4, 0.6, 1.0], [0.03, -0.05, 0.1]);
    let wave = |i: i32| 0.5 * (f64::from(i) / 7.0).sin();
    let motion = Motion::new(0.005, (0..1000).map(wave).collect()).unwrap();
    let standing = body.standing(0).unwrap();
    let once = || shake(&standing, &Contact::default(), 0.3, &along_x(&motion), 9.81);
    let found = once();
    assert_eq!(found.outcome, HullOutcome::Stood);
    assert!(
        found.peak_tilt_rad < 1e-3 && found.moved_m[0].abs() < 1e-4,
        "{found:?}"
    );
    assert_eq!(found, once());
}

#[test]
fn what_is_no_body_is_refused() {
    let cube = cuboid([1.0; 3], [0.0; 3]);
    let vertices = cube.hull.vertices_m().to_vec();
    let faces = cube.hull.faces().to_vec();
    let few = Hull::new(vertices[..3].to_vec(), faces.clone());
    assert!(matches!(few, Err(HullError::Few { .. })));
    let mut beside = faces.clone();
    beside[0][0] = 8;
    assert_eq!(Hull::new(vertices.clone(), beside), Err(HullError::Invalid));
    let away = vertices.iter().map(|[x, y, z]| [x + 2.0, *y, *z]).collect();
    assert_eq!(Hull::new(away, faces.clone()), Err(HullError::Outside));
    let inertia = cube.inertia_kg_m2;
    for mass in [0.0, f64::NAN, f64::INFINITY] {
        let body = HullBody::new(mass, inertia, cube.hull.clone());
        assert_eq!(body, Err(HullError::Mass), "{mass}");
    }
    let needle = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.5]];
    assert_eq!(HullBody::new(1.0, needle, cube.hull), Err(HullError::Mass));
}

/// Boxes of any size, turned anyhow: rounding loses no pose, and none is counted twice.
#[test]
fn a_turned_box_stands_on_six_sides() {
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for _ in 0..500 {
        let sizes_m = [0.3 + random(), 0.3 + random(), 0.3 + random()];
        let body = cuboid(sizes_m, [0.0; 3]);
        let axis = [random() - 0.5, random() - 0.5, random() - 0.5];
        let half = 3.0 * random();
        let size = dot(&axis, &axis).sqrt();
        let [x, y, z] = axis.map(|one| half.sin() * one / size);
        let shift = crate::space::shift(&[half.cos(), x, y, z]);
        let turned = |vertex: &Vector| crate::space::turned(&shift, vertex);
        let vertices = body.hull.vertices_m().iter().map(turned).collect();
        let hull = Hull::new(vertices, body.hull.faces().to_vec()).unwrap();
        let poses = hull.stable_poses();
        assert_eq!(poses.len(), 6, "{sizes_m:?} {axis:?} {half}");
        for pose in poses {
            let is_half = |size: &f64| (0.5 * size - pose.cg_height_m).abs() < 1e-12;
            assert!(sizes_m.iter().any(is_half), "{sizes_m:?} {pose:?}");
        }
    }
}

/// Its edge may lie between two directions of the grid: the pass is still that of the edge.
#[test]
fn the_barrier_of_a_turned_box_is_its_edge() {
    for yaw in [0.1_f64, 0.3, 0.7] {
        let body = cuboid([0.5, 0.8, 1.0], [0.0; 3]);
        let shift = crate::space::shift(&[(0.5 * yaw).cos(), 0.0, 0.0, (0.5 * yaw).sin()]);
        let turned = |vertex: &Vector| crate::space::turned(&shift, vertex);
        let vertices = body.hull.vertices_m().iter().map(turned).collect();
        let hull = Hull::new(vertices, body.hull.faces().to_vec()).unwrap();
        let barrier = hull.barrier(&hull.standing().unwrap());
        let expected = 0.5_f64.hypot(0.25) - 0.5;
        // The nearest direction is up to 1/32 degree away from that of the edge: the corner at 0.4 m beside
        // it is then higher by 0.4 m × sin 27° × 0.0005.
        assert!(barrier.rise_m >= expected - 1e-6, "{barrier:?}");
        assert!(barrier.rise_m < expected + 1.1e-4, "{barrier:?} {expected}");
    }
}

/// A body whose contacts would shake it, or whose motion has two lengths, is refused; one that cannot rest
/// in its pose says so.
#[test]
fn what_cannot_be_followed_is_said() {
    let body = cuboid([0.4, 0.6, 1.0], [0.0; 3]).standing(0).unwrap();
    let still = SpatialMotion::default();
    for sinking_m in [0.0, -1e-4, f64::NAN] {
        let contact = Contact {
            sinking_m,
            ..Contact::default()
        };
        let refused = shake::shake(&body, &contact, 0.0, &still, 9.81);
        assert_eq!(refused, Err(HullError::Contact));
    }
    let (long, short) = (ramp(1.0, 2.0), ramp(1.0, 1.0));
    let both = SpatialMotion {
        x: Some(&long),
        y: Some(&short),
        vertical: None,
    };
    let refused = shake::shake(&body, &Contact::default(), 0.0, &both, 9.81);
    assert_eq!(refused, Err(HullError::Motion));
    // Contacts that give way so far that a thin plate leans over.
    let thin = cuboid([0.02, 0.6, 1.0], [0.002, 0.0, 0.0])
        .standing(0)
        .unwrap();
    let found = shake(
        &thin,
        &Contact {
            sinking_m: 1e-2,
            ..Contact::default()
        },
        0.0,
        &still,
        9.81,
    );
    assert_eq!(found.outcome, HullOutcome::Unsettled);
    // Samples so far apart that it passes 90° within one.
    let coarse = Motion::new(0.5, vec![0.0, 30.0, 30.0, 30.0, -30.0]).unwrap();
    let found = shake(&body, &Contact::default(), 0.0, &along_x(&coarse), 9.81);
    assert_eq!(found.outcome, HullOutcome::Overturned);
}

/// A cylinder under two components of noise whose strength rises and falls: what comes before the first and after the last
/// strong sample decides nothing, and a factor of one changes nothing.
#[test]
fn what_is_left_out_decides_nothing() {
    let (body, _) = super::shapes::upright(
        &super::shapes::Outline::Circle(0.23),
        1.46,
        78.0,
        None,
        None,
    )
    .unwrap();
    let standing = body.standing(0).unwrap();
    let same = standing.scaled([1.0; 3], 1.0);
    let noise = |seed: u32, strength: f64| {
        let mut state = seed;
        let mut smooth = 0.0;
        let accel = (0..3000).map(|i| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let white = f64::from(state >> 8) / f64::from(1_u32 << 24) - 0.5;
            smooth += 0.05 * (white - smooth);
            let rising = (std::f64::consts::PI * f64::from(i) / 3000.0).sin().powi(4);
            strength * rising * smooth
        });
        Motion::new(0.01, accel.collect()).unwrap()
    };
    let (mut stood, mut fell) = (0, 0);
    for seed in 0..4 {
        // Too weak to lift it, and too strong for it to stand.
        let strength = [10.0, 18.0][seed as usize % 2];
        let (x, y) = (noise(2 * seed + 1, strength), noise(2 * seed + 2, strength));
        let motion = SpatialMotion {
            x: Some(&x),
            y: Some(&y),
            vertical: None,
        };
        let contact = Contact {
            sinking_m: 1e-5,
            ..Contact::default()
        };
        let short = shake(&standing, &contact, 0.3, &motion, 9.81);
        let scaled = shake(&same, &contact, 0.3, &motion, 9.81);
        let observed = |sampling| {
            let mut times = Vec::new();
            let mut see = |point: HullPoint| times.push(point.time_s);
            let found = shake_observed(&standing, &contact, 0.3, &motion, 9.81, sampling, &mut see);
            (found.unwrap(), times)
        };
        let (whole, _) = observed(Sampling::WHOLE);
        assert_eq!(short.outcome, scaled.outcome);
        assert_eq!(short.outcome, whole.outcome);
        // To be seen changes nothing of what is not whole, and no two points are farther apart than was asked.
        let apart_s = 5e-4;
        let (seen, times) = observed(Sampling {
            is_whole: false,
            apart_s,
        });
        assert_eq!(seen, short);
        assert!(times.len() > 100);
        // Half a step of rounding: a step of the tail is at most 0.1 ms.
        let widest_s = times.windows(2).map(|two| two[1] - two[0]);
        let widest_s = widest_s.fold(0.0, f64::max);
        assert!(widest_s < apart_s + 1e-4, "{widest_s}");
        match short.outcome {
            HullOutcome::Stood => stood += 1,
            _ => fell += 1,
        }
    }
    assert_eq!((stood, fell), (2, 2));
}

/// A cylinder that wobbles on its rim loses energy to rolling friction, so it comes to rest earlier; one that only rocks
/// does not roll.
#[test]
fn rolling_friction_ends_wobbling_and_not_rocking() {
    let (body, _) =
        super::shapes::upright(&super::shapes::Outline::Circle(0.4), 1.0, 80.0, None, None)
            .unwrap();
    let standing = body.standing(0).unwrap();
    let pulse = |peak_m_s2: f64, late: usize| {
        let sample = |i: usize| match i.checked_sub(late) {
            Some(i) if i < 50 => peak_m_s2 * (std::f64::consts::TAU * i as f64 / 50.0).sin(),
            _ => 0.0,
        };
        Motion::new(0.01, (0..200).map(sample).collect()).unwrap()
    };
    let under = |motion: &SpatialMotion, rolling_ratio: f64| {
        let contact = Contact {
            sinking_m: 1e-5,
            rolling_ratio,
            ..Contact::default()
        };
        let found = shake(&standing, &contact, 0.0, motion, 9.81);
        assert_eq!(found.outcome, HullOutcome::Stood, "{found:?}");
        found
    };
    let (x, y) = (pulse(4.4, 0), pulse(4.4, 20));
    let both = SpatialMotion {
        x: Some(&x),
        y: Some(&y),
        vertical: None,
    };
    let [none, some, more] = [0.0, 0.02, 0.1].map(|ratio| under(&both, ratio).end_s);
    assert!(more < some && some < none, "{none} {some} {more}");
    // In the plane of the motion it rocks: only points of the rim beside that plane, which take part in landings, roll. So
    // it wobbles ten times shorter, but its peak differs by less than half of μ_r.
    let rocking = pulse(5.1, 0);
    let [flat, rough] = [0.0, 0.1].map(|ratio| under(&along_x(&rocking), ratio).peak_tilt_rad);
    assert!(
        10.0 * more < none && (rough / flat - 1.0).abs() < 0.05,
        "{flat} {rough}"
    );
}

/// A slender body stands on three corners of an uneven base, whatever the phase of its waves: corners that differ by up to 4 mm
/// tilt it by up to 3.8°, and it tips at 11.3°. Nothing throws or drops it over.
#[test]
fn an_uneven_base_carries_a_slender_body() {
    let bar = cuboid([0.06, 0.06, 0.3], [0.0; 3]).standing(0).unwrap();
    let still = Motion::new(0.01, vec![0.0; 10]).unwrap();
    for phase in 0..24 {
        let phase_rad = f64::from(phase) * std::f64::consts::TAU / 24.0;
        let per_m = std::f64::consts::TAU / 0.05;
        let waves = [
            ([per_m, 0.0], phase_rad, 1e-3),
            ([0.6 * per_m, 0.8 * per_m], 2.0 * phase_rad, 1e-3),
        ];
        let uneven = bar.uneven(0.0, &waves);
        let found = shake(&uneven, &Contact::default(), 0.0, &along_x(&still), 9.81);
        assert_eq!(found.outcome, HullOutcome::Stood, "{phase}");
    }
}
