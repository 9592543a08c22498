//! Closed forms of the rocking block.

use std::f64::consts::PI;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::Outcome;
use freestand::rocking::{
    Base, Restitution, RockingModel, RockingOptions, Until, rock, rock_observed,
};

use super::{Check, check, defect, numbered};
use freestand_input::problem::Problem;

const HOUSNER: &str = "Housner (1963): free rocking, p T/4";
const ENERGY: &str = "Housner (1963): cos(α−θₙ) = cos α + r²ⁿ[cos(α−θ₀) − cos α]";

/// A block of slenderness angle `alpha` and half diagonal 1 m.
fn block(alpha: f64) -> Result<Block, Problem> {
    Block::uniform(2.0 * alpha.cos(), 2.0 * alpha.sin()).map_err(defect)
}

fn frequency(block: &Block) -> f64 {
    block.pivot().frequency_parameter_rad_s(G0_M_S2)
}

pub(super) fn checks() -> Result<Vec<Check>, Problem> {
    let mut checks = quarter_periods()?;
    checks.extend(decay()?);
    checks.extend(velocity_impulse()?);
    checks.extend(half_sine()?);
    checks.extend(one_sine()?);
    checks.push(friction()?);
    Ok(checks)
}

fn quarter_periods() -> Result<Vec<Check>, Problem> {
    let mut checks = Vec::new();
    // Half a unit of the eighth decimal that is known, and rounding.
    const DIGITS: f64 = 5.1e-9;
    for (model, alpha, name, values) in [
        (
            RockingModel::Linearised,
            0.2,
            "linearised",
            [0.467_145_31, 1.316_957_90, 2.993_222_85],
        ),
        (
            RockingModel::Rigid,
            0.1,
            "rigid, α = 0.1",
            [0.467_472_82, 1.317_344_20, 2.993_448_88],
        ),
        (
            RockingModel::Rigid,
            0.2,
            "rigid, α = 0.2",
            [0.468_457_83, 1.318_504_40, 2.994_127_36],
        ),
    ] {
        for (phi, expected) in [0.1, 0.5, 0.9].into_iter().zip(values) {
            let block = block(alpha)?;
            let options = RockingOptions {
                model,
                initial_rotation_rad: alpha * phi,
                until: Until::Time(3.0),
                ..RockingOptions::default()
            };
            let history = rock(&block, Base::default(), &options).map_err(defect)?;
            let first = history
                .impacts
                .first()
                .map_or(f64::NAN, |impact| impact.time_s);
            let computed = frequency(&block) * first;
            checks.push(check(
                format!("quarter period from φ₀ = {phi}, {name}"),
                computed,
                expected,
                DIGITS,
                HOUSNER,
            ));
        }
    }
    Ok(checks)
}

/// α = 0.2, r = 0.9407957455, φ₀ = 0.5.
fn decay() -> Result<Vec<Check>, Problem> {
    let block = block(0.2)?;
    let p = frequency(&block);
    let options = RockingOptions {
        restitution: Restitution::Value(0.940_795_745_5),
        initial_rotation_rad: 0.1,
        until: Until::Time(4.0),
        ..RockingOptions::default()
    };
    // The peak after each impact: where the velocity turns, by bisection on the piece's own
    // polynomial.
    let mut peaks = Vec::new();
    let history = rock_observed(&block, Base::default(), &options, |segment| {
        let outward = |ratio: f64| {
            let (theta, omega) = segment.rotation(ratio);
            theta * omega
        };
        let (mut low, mut high) = (0.0, segment.end_ratio);
        if outward(1e-9) > 0.0 && outward(high) < 0.0 {
            for _ in 0..60 {
                let mid = 0.5 * (low + high);
                if outward(mid) > 0.0 {
                    low = mid
                } else {
                    high = mid
                }
            }
            peaks.push(segment.rotation(low).0.abs() / 0.2);
        }
    })
    .map_err(defect)?;
    // A missing impact fails its check.
    let missing = || std::iter::repeat(f64::NAN);
    let peaks = peaks.into_iter().chain(missing());
    let expected = [0.420_356_31, 0.358_022_88, 0.307_493_61, 0.265_647_96];
    let amplitudes = numbered(
        |n| format!("amplitude θ/α after impact {n}"),
        peaks,
        expected,
        5.1e-9,
        ENERGY,
    );
    let times = history
        .impacts
        .iter()
        .map(|impact| p * impact.time_s)
        .chain(missing());
    let expected = [1.318_504_4, 3.604_495_4, 5.632_523_4, 7.457_080_0];
    let times = numbered(
        |n| format!("p × time of impact {n}"),
        times,
        expected,
        5.1e-8,
        HOUSNER,
    );
    Ok(amplitudes.chain(times).collect())
}

/// The amplitude between `low` and `high` at which `overturns` changes its answer; NaN if it does
/// not.
fn boundary(
    overturns: impl Fn(f64) -> Result<bool, Problem>,
    low: f64,
    high: f64,
) -> Result<f64, Problem> {
    let (mut low, mut high) = (low, high);
    let at_low = overturns(low)?;
    if overturns(high)? == at_low {
        return Ok(f64::NAN);
    }
    while high - low > 1e-7 {
        let mid = 0.5 * (low + high);
        if overturns(mid)? == at_low {
            low = mid
        } else {
            high = mid
        }
    }
    Ok(0.5 * (low + high))
}

fn velocity_impulse() -> Result<Vec<Check>, Problem> {
    let alpha = 0.25;
    let block = block(alpha)?;
    let pivot = block.pivot();
    // ω after a step V of the base velocity: the impulse m V R cos α on I₀ = 4/3 m R².
    let per_velocity = 0.75 * alpha.cos() / pivot.half_diagonal_m;
    let overturns = |v: f64| {
        let options = RockingOptions {
            initial_omega_rad_s: v * per_velocity,
            until: Until::Time(20.0),
            ..RockingOptions::default()
        };
        Ok(rock(&block, Base::default(), &options)
            .map_err(defect)?
            .outcome
            == Outcome::Overturned)
    };
    let expected = (8.0 / 3.0 * G0_M_S2 * pivot.balance_rise_m()).sqrt() / alpha.cos();
    const REFERENCE: &str = "V = √[(8/3) g R (1−cos α)]/cos α, by energy";
    // The bisection's interval.
    Ok(vec![check(
        "velocity impulse that overturns, α = 0.25, R = 1 m [m/s]",
        boundary(overturns, 0.1, 5.0)?,
        expected,
        1e-7,
        REFERENCE,
    )])
}

/// Whether a sine pulse of `half_cycles` and amplitude `a` (in g tan α, or g α linearised)
/// overturns.
fn pulse_overturns(
    model: RockingModel,
    restitution: Restitution,
    w: f64,
    half_cycles: f64,
    a: f64,
) -> Result<bool, Problem> {
    const SAMPLES: u32 = 4000;
    let alpha = 0.1_f64;
    let block = block(alpha)?;
    let omega = w * frequency(&block);
    let unit = G0_M_S2
        * if model == RockingModel::Linearised {
            alpha
        } else {
            alpha.tan()
        };
    let dt = half_cycles * PI / omega / f64::from(SAMPLES);
    let samples = (0..=SAMPLES)
        .map(|i| a * unit * (omega * dt * f64::from(i)).sin())
        .collect();
    let motion = Motion::new(dt, samples).map_err(defect)?;
    let options = RockingOptions {
        model,
        restitution,
        until: Until::Time(motion.duration_s() + 12.0),
        ..RockingOptions::default()
    };
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    Ok(rock(&block, base, &options).map_err(defect)?.outcome == Outcome::Overturned)
}

fn half_sine() -> Result<Vec<Check>, Problem> {
    let mut checks = Vec::new();
    for (model, name, reference, values) in [
        (
            RockingModel::Linearised,
            "linearised",
            "half-sine pulse: w sin ψ − cos ψ = exp[−(π−ψ)/w], sin ψ = 1/A",
            [1.322_397, 1.800_724, 2.790_798],
        ),
        (
            RockingModel::Rigid,
            "rigid, α = 0.1",
            "half-sine pulse on the exact equation, by quadrature at high precision",
            [1.322_223, 1.800_856, 2.791_889],
        ),
    ] {
        for (w, expected) in [1.0, 2.0, 4.0].into_iter().zip(values) {
            let overturns = |a| pulse_overturns(model, Restitution::Housner, w, 1.0, a);
            let computed = boundary(overturns, 1.0, 4.0)?;
            // Half a unit of the sixth decimal, and 2e-7 for the straight lines between 4000
            // samples of the pulse.
            checks.push(check(
                format!("half-sine that overturns, w = {w}, {name} [A/(g tan α)]"),
                computed,
                expected,
                7e-7,
                reference,
            ));
        }
    }
    Ok(checks)
}

fn one_sine() -> Result<Vec<Check>, Problem> {
    const REFERENCE: &str =
        "one-sine pulse, linearised, r = 0.9: overturns for A in [A1, A2] and above A3";
    let mut checks = Vec::new();
    for (w, [a1, a2, a3]) in [
        (2.0, [1.225_18, 2.314_40, 2.349_90]),
        (4.0, [1.795_44, 4.850_11, 5.238_96]),
    ] {
        let overturns =
            |a| pulse_overturns(RockingModel::Linearised, Restitution::Value(0.9), w, 2.0, a);
        for (name, expected, low, high) in [
            ("A1", a1, 1.0, 0.5 * (a1 + a2)),
            ("A2", a2, 0.5 * (a1 + a2), 0.5 * (a2 + a3)),
            ("A3", a3, 0.5 * (a2 + a3), 1.5 * a3),
        ] {
            // Half a unit of the fifth decimal, and the straight lines between samples.
            let computed = boundary(overturns, low, high)?;
            checks.push(check(
                format!("one-sine pulse, w = {w}, {name}"),
                computed,
                expected,
                7e-6,
                REFERENCE,
            ));
        }
    }
    Ok(checks)
}

fn friction() -> Result<Check, Problem> {
    let block = Block::uniform(3.0, 1.0).map_err(defect)?;
    let motion = Motion::new(1e-6, vec![0.5 * G0_M_S2; 2]).map_err(defect)?;
    let mut needed = 0.0_f64;
    rock_observed(
        &block,
        Base {
            horizontal: Some(&motion),
            vertical: None,
        },
        &RockingOptions::default(),
        |segment| {
            needed = needed.max(segment.friction_needed_ratio());
        },
    )
    .map_err(defect)?;
    const REFERENCE: &str = "Shenton (1996): [A(H²+4)+3H]/[4H²+3HA+1]";
    // Half a unit of the fifth decimal.
    Ok(check(
        "friction at a step of 0.5 g, H = 3",
        needed,
        0.373_49,
        5.1e-6,
        REFERENCE,
    ))
}
