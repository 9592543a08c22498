use super::*;

/// Some shapes, among them those whose original form leaves the largest displacement.
fn shapes() -> Vec<VelocityPulse> {
    let mut all = Vec::new();
    for cycles in [2.0, 2.5, 3.2] {
        for phase_rad in [0.0, 1.0, 0.5 * PI, 3.0] {
            all.push(VelocityPulse {
                period_s: 2.5,
                cycles,
                phase_rad,
            });
        }
    }
    all
}

/// Sums of 100,000 equal steps; a smooth function that ends with its slope has an error of their square, 1e-9.
fn integral(pulse: &VelocityPulse, value: impl Fn(f64) -> f64) -> f64 {
    let (steps, half_s) = (100_000, 0.5 * pulse.duration_s());
    let dt_s = pulse.duration_s() / f64::from(steps);
    (0..steps)
        .map(|k| value(-half_s + (f64::from(k) + 0.5) * dt_s) * dt_s)
        .sum()
}

#[test]
fn it_begins_and_ends_at_rest_where_it_was() {
    for pulse in shapes() {
        let end_s = 0.5 * pulse.duration_s();
        for at_s in [-end_s, end_s, end_s + 1.0] {
            assert_eq!(
                (pulse.velocity_ratio(at_s), pulse.accel_per_s(at_s)),
                (0.0, 0.0)
            );
        }
        // Just inside: w and its slope vanish there.
        assert!(pulse.velocity_ratio(end_s - 1e-6).abs() < 1e-11);
        assert!(pulse.accel_per_s(end_s - 1e-6).abs() < 1e-5);
        assert!(
            integral(&pulse, |u| pulse.accel_per_s(u)).abs() < 1e-8,
            "{pulse:?}"
        );
        assert!(
            integral(&pulse, |u| pulse.velocity_ratio(u)).abs() < 1e-8,
            "{pulse:?}"
        );
    }
}

/// Central differences of the velocity: their error is h²/6 of its third derivative, 1e-9.
#[test]
fn the_acceleration_is_the_slope_of_the_velocity() {
    for pulse in shapes() {
        for at_s in [-2.0, -0.7, 0.0, 0.3, 1.9] {
            let h = 1e-5;
            let slope =
                (pulse.velocity_ratio(at_s + h) - pulse.velocity_ratio(at_s - h)) / (2.0 * h);
            assert!(
                (slope - pulse.accel_per_s(at_s)).abs() < 1e-8,
                "{pulse:?} at {at_s}"
            );
        }
    }
}

/// The integral of the original form, −T cos ν sin(πγ)/(2π(γ² − 1)), is what c takes away.
#[test]
fn the_displacement_that_is_taken_away_is_that_of_the_original() {
    for pulse in shapes() {
        let original = |u: f64| {
            let window = 0.5 + 0.5 * (TAU * u / pulse.duration_s()).cos();
            window * (TAU * u / pulse.period_s + pulse.phase_rad).cos()
        };
        let cycles = pulse.cycles;
        let closed = -pulse.period_s * pulse.phase_rad.cos() * (PI * cycles).sin()
            / (TAU * (cycles * cycles - 1.0));
        assert!(
            (integral(&pulse, original) - closed).abs() < 1e-8,
            "{pulse:?}"
        );
        assert!(pulse.offset_ratio().abs() < 0.055, "{pulse:?}");
    }
}

#[test]
fn a_motion_with_a_pulse_ends_at_rest_and_keeps_its_own() {
    let options = SynthesisOptions::default();
    let samples =
        ((options.lead_in_s + options.shaking_s + options.tail_s) / options.dt_s) as usize + 1;
    let still = Motion::new(options.dt_s, vec![0.0; samples]).unwrap();
    let longest = VelocityPulse {
        period_s: 10.0,
        cycles: 3.2,
        phase_rad: 0.4,
    };
    for pulse in shapes().into_iter().chain([longest]) {
        let motion = with_pulse(&still, &pulse, 0.5, &options).unwrap();
        let accel = motion.accel_m_s2();
        let (mut velocity, mut displacement, mut fastest) = (0.0, 0.0, 0.0_f64);
        for pair in accel.windows(2) {
            let before = velocity;
            velocity += 0.5 * (pair[0] + pair[1]) * options.dt_s;
            displacement += 0.5 * (before + velocity) * options.dt_s;
            fastest = fastest.max(velocity.abs());
        }
        // The trapezoid rule of the whole is exact but for rounding: 9000 samples of 1e-16.
        assert!(
            velocity.abs() < 1e-12 && displacement.abs() < 1e-10,
            "{velocity} {displacement}"
        );
        // At ν = 90° the peak is beside the centre, where the window is 0.7 at γ = 2.
        assert!((0.35..0.53).contains(&fastest), "{pulse:?} {fastest}");
        assert_eq!(
            accel[..200],
            vec![0.0; 200][..],
            "the quiet before the shaking"
        );
        assert_eq!(accel[samples - 700..], vec![0.0; 700][..], "and after it");
    }
}
