//! Virtual drop and static tests: for teaching, for planning a test, and for testing the
//! identification.

use rand::RngExt;
use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::filter::{LowPass, Poles};
use crate::G0_M_S2;
use crate::cushion::{ContactPoint, Cushion};

/// How a virtual drop is made and recorded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualDropOptions {
    /// Mass that falls \[kg\].
    pub mass_kg: f64,
    /// Velocity at first contact \[m/s\].
    pub speed_m_s: f64,
    /// Gravity \[m/s²\]; 0 means none during the contact.
    pub gravity_m_s2: f64,
    /// Samples per second \[Hz\].
    pub sample_rate_hz: f64,
    /// Time recorded before first contact \[s\].
    pub pre_trigger_s: f64,
    /// Time recorded after the first contact, without bounces \[s\].
    pub after_s: f64,
    /// Standard deviation of white noise divided by the peak.
    pub noise_ratio: f64,
    /// Bias, added to every sample \[m/s²\].
    pub bias_m_s2: f64,
    /// Shift of the zero line after the peak, as a share of the peak: the effect of a shock on the
    /// sensor.
    pub zero_shift_ratio: f64,
    /// Corner of a two-pole low-pass filter before the converter \[Hz\].
    pub filter_corner_hz: Option<f64>,
    /// Number of bounces after the first contact that are recorded.
    pub bounces: u32,
    /// Relative standard deviation of the stated velocity: friction in the guides, a height read
    /// from a scale.
    pub speed_error_ratio: f64,
    /// The seed.
    pub seed: u64,
    /// The number of the test, which has its own random numbers.
    pub index: u64,
}

impl VirtualDropOptions {
    /// A clean drop from a height: 50 samples per contact; a record from three contact times before
    /// the first contact to four after it; seed 1.
    pub fn from_height(cushion: &Cushion, mass_kg: f64, height_m: f64) -> Self {
        let speed_m_s = (2.0 * G0_M_S2 * height_m).sqrt();
        let contact_s = cushion.land(mass_kg, speed_m_s).duration_s;
        Self {
            mass_kg,
            speed_m_s,
            gravity_m_s2: G0_M_S2,
            sample_rate_hz: 50.0 / contact_s,
            pre_trigger_s: 3.0 * contact_s,
            after_s: 4.0 * contact_s,
            noise_ratio: 0.0,
            bias_m_s2: 0.0,
            zero_shift_ratio: 0.0,
            filter_corner_hz: None,
            bounces: 0,
            speed_error_ratio: 0.0,
            seed: 1,
            index: 0,
        }
    }
}

/// A virtual drop.
#[derive(Debug, Clone, PartialEq)]
pub struct VirtualDrop {
    /// Time step \[s\].
    pub dt_s: f64,
    /// The reading of the accelerometer \[m/s²\]: force over mass, zero in free fall.
    pub samples_m_s2: Vec<f64>,
    /// The stated velocity, including its error \[m/s\].
    pub stated_speed_m_s: f64,
    /// Peak without noise, bias, shift and filter \[m/s²\].
    pub peak_m_s2: f64,
    /// Duration of the first contact \[s\].
    pub contact_s: f64,
    /// Rebound velocity divided by impact velocity of the first contact.
    pub restitution_ratio: f64,
}

/// The largest number of samples of a virtual record.
const MAX_SAMPLES: usize = 5_000_000;
/// Steps per sample where there is a filter.
const OVERSAMPLING: usize = 8;

/// Drops a mass on a cushion and records it; `None` where the record would exceed five million
/// samples.
///
/// The first contact falls between two samples, at random. The noise is Gaussian and white, from
/// stream `index` of `seed`.
///
/// # Accuracy
/// That of [`Cushion::landing_history`]; the force is interpolated between its steps.
pub fn virtual_drop(cushion: &Cushion, options: &VirtualDropOptions) -> Option<VirtualDrop> {
    let o = options;
    let mut random = ChaCha12Rng::seed_from_u64(o.seed);
    random.set_stream(o.index);
    let dt_s = 1.0 / o.sample_rate_hz;
    let touch_s = o.pre_trigger_s + random.random::<f64>() * dt_s;
    let (contacts, end_s) = contacts(cushion, o, touch_s);
    let (first_s, first) = contacts.first()?;
    let peak_m_s2 = first.iter().map(|p| p.force_n).fold(0.0, f64::max) / o.mass_kg;
    let last = first.last()?;
    let (contact_s, rebound_m_s) = (last.time_s, -last.speed_m_s);
    let peak_at_s = first_s
        + first
            .iter()
            .max_by(|a, b| a.force_n.total_cmp(&b.force_n))?
            .time_s;
    let finer = if o.filter_corner_hz.is_some() {
        OVERSAMPLING
    } else {
        1
    };
    // As a float: a count too large for an integer must not wrap around.
    let wanted = (end_s / dt_s).ceil() + 1.0;
    if wanted.is_nan() || wanted * finer as f64 > MAX_SAMPLES as f64 {
        return None;
    }
    let count = wanted as usize;
    let fine_s = dt_s / finer as f64;
    let mut fine: Vec<f64> = (0..count * finer)
        .map(|i| force_at(&contacts, i as f64 * fine_s) / o.mass_kg)
        .collect();
    if let Some(corner_hz) = o.filter_corner_hz {
        LowPass {
            corner_hz,
            poles: Poles::Two,
        }
        .apply(&mut fine, fine_s);
    }
    let samples_m_s2: Vec<f64> = fine
        .iter()
        .step_by(finer)
        .enumerate()
        .map(|(i, reading)| {
            let noise: f64 = StandardNormal.sample(&mut random);
            let shift = if i as f64 * dt_s > peak_at_s {
                o.zero_shift_ratio
            } else {
                0.0
            };
            reading + o.bias_m_s2 + peak_m_s2 * (shift + o.noise_ratio * noise)
        })
        .collect();
    // Drawn last, so that the samples do not depend on the error of the velocity.
    let error: f64 = StandardNormal.sample(&mut random);
    Some(VirtualDrop {
        dt_s,
        samples_m_s2,
        stated_speed_m_s: o.speed_m_s * (o.speed_error_ratio * error).exp(),
        peak_m_s2,
        contact_s,
        restitution_ratio: rebound_m_s / o.speed_m_s,
    })
}

/// The contacts with their start times, and the end of the record.
fn contacts(
    cushion: &Cushion,
    o: &VirtualDropOptions,
    touch_s: f64,
) -> (Vec<(f64, Vec<ContactPoint>)>, f64) {
    let mut all = Vec::new();
    let (mut at_s, mut speed) = (touch_s, o.speed_m_s);
    let mut end_s = touch_s;
    for _ in 0..=o.bounces {
        let history = cushion.landing_history(o.mass_kg, speed, o.gravity_m_s2);
        let Some(last) = history.last().copied() else {
            break;
        };
        all.push((at_s, history));
        end_s = at_s + last.time_s;
        speed = -last.speed_m_s;
        // The mass leaves the pad where the force ends, falls back to its surface, and must have
        // flown.
        if speed <= 0.0 || o.gravity_m_s2 <= 0.0 {
            break;
        }
        at_s = end_s + 2.0 * speed / o.gravity_m_s2;
    }
    (all, end_s + o.after_s)
}

fn force_at(contacts: &[(f64, Vec<ContactPoint>)], time_s: f64) -> f64 {
    for (start_s, history) in contacts {
        let t = time_s - start_s;
        let after = history.partition_point(|point| point.time_s <= t);
        if t < 0.0 || after >= history.len() {
            continue;
        }
        let [a, b] = [history[after.saturating_sub(1)], history[after]];
        let share = if b.time_s > a.time_s {
            (t - a.time_s) / (b.time_s - a.time_s)
        } else {
            0.0
        };
        return a.force_n + share * (b.force_n - a.force_n);
    }
    0.0
}

/// How a virtual static test is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualStaticOptions {
    /// Largest force \[N\].
    pub max_force_n: f64,
    /// Points during loading, and as many during unloading.
    pub points: usize,
    /// Energy lost divided by the energy of loading.
    pub hysteresis_ratio: f64,
    /// Slack before first contact \[m\].
    pub toe_m: f64,
    /// Stiffness of the machine \[N/m\].
    pub machine_stiffness_n_m: Option<f64>,
    /// Standard deviation of the force divided by its largest value.
    pub noise_ratio: f64,
    /// The seed.
    pub seed: u64,
    /// The number of the test.
    pub index: u64,
}

impl Default for VirtualStaticOptions {
    /// A clean test up to 1 kN in 200 steps, seed 1.
    fn default() -> Self {
        Self {
            max_force_n: 1000.0,
            points: 201,
            hysteresis_ratio: 0.0,
            toe_m: 0.0,
            machine_stiffness_n_m: None,
            noise_ratio: 0.0,
            seed: 1,
            index: 0,
        }
    }
}

/// Force \[N\] and displacement \[m\] of a slow test, loading and unloading at equal steps of
/// compression. During unloading the force is that of the law less a half-sine over the
/// compression, whose energy is the hysteresis.
pub fn virtual_static(cushion: &Cushion, options: &VirtualStaticOptions) -> Vec<(f64, f64)> {
    let o = options;
    let mut random = ChaCha12Rng::seed_from_u64(o.seed);
    random.set_stream(o.index);
    let max_m = cushion.static_compression_m(o.max_force_n);
    // ∫sin(πd/D) dd = 2D/π.
    let loss_n =
        o.hysteresis_ratio * cushion.stored_energy_j(max_m) * std::f64::consts::PI / (2.0 * max_m);
    let points = o.points.max(2);
    let up = (0..points).map(|i| (i as f64 / (points - 1) as f64, false));
    let down = (0..points - 1)
        .rev()
        .map(|i| (i as f64 / (points - 1) as f64, true));
    let slack = (0..points / 10).map(|i| i as f64 / (points / 10).max(1) as f64 * o.toe_m);
    let slack: Vec<f64> = if o.toe_m > 0.0 {
        slack.collect()
    } else {
        Vec::new()
    };
    let mut read = |d: f64, force_n: f64| {
        let noise: f64 = StandardNormal.sample(&mut random);
        let give_m = o.machine_stiffness_n_m.map_or(0.0, |k| force_n / k);
        (force_n + o.noise_ratio * o.max_force_n * noise, d + give_m)
    };
    let mut out: Vec<(f64, f64)> = slack.into_iter().map(|d| read(d, 0.0)).collect();
    for (share, is_out) in up.chain(down) {
        let d = share * max_m;
        let loss = if is_out {
            loss_n * (std::f64::consts::PI * share).sin()
        } else {
            0.0
        };
        out.push(read(o.toe_m + d, (cushion.force_n(d, 0.0) - loss).max(0.0)));
    }
    out
}
