mod agreement;
mod determinism;
mod energy;
mod limits;
mod screen;

use rayon::prelude::*;

use super::*;
use crate::G0_M_S2;
use crate::code_spectrum::{As1170_4, Edition, SiteClass};
use crate::compliant::{
    CompliantAccuracy, CompliantBase, CompliantOptions, CompliantRocking, rock_compliant,
};
use crate::cushion::{ContactLaw, Cushion};
use crate::synthesis::{SynthesisOptions, synthesize};

/// An object on pads, with its damping ratio.
#[derive(Debug, Clone, Copy)]
struct Object {
    name: &'static str,
    block: Block,
    mass_kg: f64,
    stiffness_n_m: f64,
    damping_ratio: f64,
}

impl Object {
    fn new(name: &'static str, size_m: (f64, f64), mass_kg: f64, stiffness_n_m: f64) -> Self {
        let block = Block::uniform(size_m.0, size_m.1).unwrap();
        Self {
            name,
            block,
            mass_kg,
            stiffness_n_m,
            damping_ratio: 0.1,
        }
    }

    fn world<'a>(&self, motion: &'a Motion) -> CompliantWorld<'a> {
        CompliantWorld {
            block: self.block,
            mass_kg: self.mass_kg,
            stiffness_n_m: self.stiffness_n_m,
            damping_n_s_m: 2.0 * self.damping_ratio * (self.stiffness_n_m * self.mass_kg).sqrt(),
            motion: Base {
                horizontal: Some(motion),
                vertical: None,
            },
        }
    }

    fn up_m_s2(&self) -> f64 {
        pad_uplift_threshold_m_s2(&self.block, self.mass_kg, self.stiffness_n_m, G0_M_S2)
    }
}

/// One with its centre of gravity off the middle.
pub(super) fn leaning() -> Body {
    leaning_on(2e6, 0.1)
}

/// The same on pads so soft that a step is a whole sample, with little damping.
pub(super) fn soft() -> Body {
    leaning_on(2e4, 0.02)
}

fn leaning_on(stiffness_n_m: f64, damping_ratio: f64) -> Body {
    let object = Object {
        block: Block::uniform(1.8, 0.6)
            .unwrap()
            .with_cg_offset(0.05)
            .unwrap(),
        damping_ratio,
        ..Object::new("leaning", (1.8, 0.6), 150.0, stiffness_n_m)
    };
    let motion = Motion::new(0.01, vec![0.0; 3]).unwrap();
    Body::new(&object.world(&motion), &motion, G0_M_S2).unwrap()
}

fn rack() -> Object {
    Object::new(
        "rack 2.0 x 0.9 m, 400 kg, 1500 N/mm",
        (2.0, 0.9),
        400.0,
        1.5e6,
    )
}

/// Racks, cabinets, a light case, a slender shelf, and one with its centre of gravity off the middle.
fn objects() -> [Object; 6] {
    let mut off = Object::new(
        "off centre 1.6 x 0.6 m, 200 kg, 2000 N/mm",
        (1.6, 0.6),
        200.0,
        2e6,
    );
    off.block = off.block.with_cg_offset(0.06).unwrap();
    [
        rack(),
        Object::new(
            "rack 2.0 x 0.6 m, 300 kg, 4000 N/mm",
            (2.0, 0.6),
            300.0,
            4e6,
        ),
        Object::new(
            "cabinet 2.3 x 0.6 m, 140 kg, 4380 N/mm",
            (2.3, 0.6),
            140.0,
            4.38e6,
        ),
        Object::new("case 1.2 x 0.4 m, 25 kg, 500 N/mm", (1.2, 0.4), 25.0, 5e5),
        Object::new(
            "shelf 1.8 x 0.35 m, 80 kg, 1000 N/mm",
            (1.8, 0.35),
            80.0,
            1e6,
        ),
        off,
    ]
}

/// Motions of 45 s that roughly match a code spectrum.
fn motions(count: u64) -> Vec<Motion> {
    let code = As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500).unwrap();
    let options = SynthesisOptions {
        passes: 2,
        ..SynthesisOptions::default()
    };
    let made = (0..count)
        .into_par_iter()
        .map(|i| synthesize(|t| code.sa_g(t), 20, i, &options));
    made.map(|made| made.unwrap().motion).collect()
}

/// The first seconds of a motion with this peak.
fn part(motion: &Motion, from_s: f64, to_s: f64, peak_m_s2: f64) -> Motion {
    let sample = |time_s: f64| (time_s / motion.dt_s()) as usize;
    let part = Motion::new(
        motion.dt_s(),
        motion.accel_m_s2()[sample(from_s)..sample(to_s)].to_vec(),
    )
    .unwrap();
    part.scaled(peak_m_s2 / part.peak_m_s2()).unwrap()
}

/// The reference.
fn scalar(world: &CompliantWorld, accuracy: CompliantAccuracy) -> CompliantRocking {
    let (stiffness_n_m, damping_n_s_m) = (world.stiffness_n_m, world.damping_n_s_m);
    let law = ContactLaw::KelvinVoigt {
        stiffness_n_m,
        damping_n_s_m,
    };
    let base = CompliantBase::new(world.mass_kg, Cushion::new(law).unwrap());
    let options = CompliantOptions {
        accuracy,
        ..CompliantOptions::default()
    };
    rock_compliant(&world.block, &base, world.motion, &options).unwrap()
}

fn follow_all(worlds: &[CompliantWorld]) -> Vec<CompliantSummary> {
    rock_compliant_many(worlds, G0_M_S2)
        .into_iter()
        .map(Result::unwrap)
        .collect()
}

fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = share * (sorted.len() - 1) as f64;
    let (low, rest) = (place.floor() as usize, place.fract());
    let high = sorted[(low + 1).min(sorted.len() - 1)];
    if rest > 0.0 {
        sorted[low] + rest * (high - sorted[low])
    } else {
        sorted[low]
    }
}
