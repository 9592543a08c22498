//! Blocks and motions that look for trouble, drawn from a seed.

use std::f64::consts::TAU;

use crate::G0_M_S2;
use crate::block::Block;
use crate::motion::Motion;
use crate::rocking::{
    Accuracy, Base, Outcome, Restitution, RockingModel, RockingOptions, Until, rock,
};
use crate::wall::{Wall, Walls};

/// Uniform numbers from a seed, the same on every machine (xorshift64).
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        // Neighbouring seeds begin alike.
        for _ in 0..16 {
            random.next();
        }
        random
    }

    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    /// Evenly in the logarithm.
    pub(super) fn log(&mut self, from: f64, to: f64) -> f64 {
        (from.ln() + (to / from).ln() * self.next()).exp()
    }

    /// 0 to `count` − 1.
    pub(super) fn pick(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.next() < probability
    }
}

/// Blocks under one motion.
#[derive(Debug, Clone)]
pub(super) struct Trouble {
    /// What the motion is like.
    pub(super) kind: &'static str,
    pub(super) blocks: Vec<Block>,
    pub(super) horizontal: Motion,
    pub(super) vertical: Option<Motion>,
    pub(super) options: RockingOptions,
}

impl Trouble {
    pub(super) fn base(&self) -> Base<'_> {
        Base {
            horizontal: Some(&self.horizontal),
            vertical: self.vertical.as_ref(),
        }
    }

    /// `count` blocks of about one slenderness, so that one motion is neither nothing nor all to
    /// them.
    pub(super) fn new(seed: u64, count: usize) -> Self {
        let mut random = Random::new(seed);
        let options = options(&mut random);
        let slenderness = random.log(0.8, 50.0);
        let sizes = if random.chance(0.7) {
            (0.2, 5.0)
        } else {
            (0.001, 100.0)
        };
        let blocks: Vec<Block> = (0..count)
            .map(|_| {
                let height = random.log(sizes.0, sizes.1);
                let thickness = height / (slenderness * random.log(0.7, 1.5)).clamp(0.8, 50.0);
                let block = Block::uniform(height, thickness).unwrap();
                let offset = if random.chance(0.25) {
                    thickness * random.between(-0.45, 0.45)
                } else {
                    0.0
                };
                block.with_cg_offset(offset).unwrap()
            })
            .collect();
        let dt = if random.chance(0.2) {
            random.log(0.02, 0.5)
        } else {
            random.log(0.001, 0.02)
        };
        let samples = 2 + random.pick(500);
        let threshold = options.model.uplift_threshold_ratio(&blocks[0]) * G0_M_S2;
        let peak = threshold * random.log(0.8, 8.0);
        let (kind, accel) = shape(&mut random, dt, samples, peak, threshold);
        let vertical = random.chance(0.3).then(|| {
            let part = random.between(0.0, 0.9) * G0_M_S2;
            Motion::new(
                dt,
                (0..samples)
                    .map(|_| part * random.between(-1.0, 1.0))
                    .collect(),
            )
            .unwrap()
        });
        let horizontal = Motion::new(dt, accel).unwrap();
        let mut trouble = Self {
            kind,
            blocks,
            horizontal,
            vertical,
            options,
        };
        if kind != "threshold" && random.chance(0.25) {
            trouble.scale_to_the_edge(random.log(1e-4, 0.05));
        }
        trouble
    }

    /// The same between walls: a gap of down to a picometre or none at all, contacts about the
    /// balance point of the first block, low obstacles, walls that return nothing or nearly all.
    pub(super) fn between_walls(seed: u64, count: usize) -> Self {
        let mut trouble = Self::new(seed, count);
        let mut random = Random::new(!seed);
        let block = trouble.blocks[0];
        let (h, alpha) = (block.height_m(), block.pivot().slenderness_angle_rad);
        let restitution_ratio = match random.pick(4) {
            0 => 0.0,
            1 => 1.0 - random.log(1e-2, 0.5),
            _ => random.between(0.0, 0.6),
        };
        let height_m = random.chance(0.2).then(|| h * random.between(0.02, 1.2));
        let mut wall = |chance: f64| {
            let gap_m = match random.pick(8) {
                0 => 0.0,
                1 => h * random.log(1e-12, 1e-4),
                2 => h * (alpha * random.between(0.99, 1.01)).min(1.5).sin(),
                _ => h * alpha.sin() * random.log(0.01, 2.0),
            };
            random.chance(chance).then_some(Wall {
                gap_m,
                height_m,
                restitution_ratio,
            })
        };
        let walls = Walls {
            left: wall(1.0),
            right: wall(0.5),
        };
        trouble.options.walls = if random.chance(0.5) {
            walls
        } else {
            walls.mirrored()
        };
        trouble.options.model = RockingModel::Rigid;
        trouble
    }

    /// Scales the motion to where the first block all but overturns, short of it by a share.
    fn scale_to_the_edge(&mut self, share: f64) {
        let options = RockingOptions {
            accuracy: Accuracy::Fast,
            ..self.options
        };
        let overturns = |factor: f64| {
            let horizontal = self.horizontal.scaled(factor).unwrap();
            let base = Base {
                horizontal: Some(&horizontal),
                vertical: self.vertical.as_ref(),
            };
            rock(&self.blocks[0], base, &options)
                .is_ok_and(|rocking| rocking.outcome == Outcome::Overturned)
        };
        let (mut stands, mut falls) = (0.1, 10.0);
        if !overturns(falls) || overturns(stands) {
            return;
        }
        for _ in 0..20 {
            let middle = 0.5 * (stands + falls);
            *(if overturns(middle) {
                &mut falls
            } else {
                &mut stands
            }) = middle;
        }
        self.horizontal = self.horizontal.scaled(stands * (1.0 - share)).unwrap();
    }
}

fn options(random: &mut Random) -> RockingOptions {
    let restitution = match random.pick(5) {
        0 => Restitution::Value(random.between(0.3, 1.0)),
        1 => Restitution::Factor(random.between(0.5, 1.0)),
        2 => Restitution::Value(1.0 - random.log(1e-6, 1e-2)),
        _ => Restitution::Housner,
    };
    RockingOptions {
        model: if random.chance(0.15) {
            RockingModel::Linearised
        } else {
            RockingModel::Rigid
        },
        restitution,
        until: if random.chance(0.5) {
            Until::EndOfMotion
        } else {
            Until::Settled { at_most_s: 60.0 }
        },
        ..RockingOptions::default()
    }
}

/// Samples of up to `peak` \[m/s²\]; `threshold` is what lifts the first block from rest.
fn shape(
    random: &mut Random,
    dt: f64,
    samples: usize,
    peak: f64,
    threshold: f64,
) -> (&'static str, Vec<f64>) {
    let (slow, fast) = (random.log(0.2, 3.0), random.log(3.0, 15.0));
    let sines = |t: f64| 0.6 * (TAU * slow * t).sin() + 0.4 * (TAU * fast * t + slow).sin();
    let kinds = [
        "noise",
        "spikes",
        "steps",
        "threshold",
        "pulse",
        "sines",
        "rests",
    ];
    let kind = kinds[random.pick(kinds.len())];
    let at = |k: usize, random: &mut Random| {
        let t = k as f64 * dt;
        match kind {
            "noise" => peak * random.between(-1.0, 1.0),
            "spikes" if random.chance(0.05) => peak * random.between(-1.0, 1.0),
            "spikes" => 0.0,
            "steps" => {
                if (t * slow).fract() < 0.5 {
                    peak
                } else {
                    -peak
                }
            }
            // The first block's threshold, a bit more, a bit less, zero, or well beyond it.
            "threshold" => {
                let side = if random.chance(0.5) {
                    threshold
                } else {
                    -threshold
                };
                [
                    side,
                    side * (1.0 + f64::EPSILON),
                    side * (1.0 - f64::EPSILON),
                    0.0,
                    1.5 * side,
                ][random.pick(5)]
            }
            "pulse" => {
                if t * slow < 1.0 {
                    peak * (TAU * slow * t).sin()
                } else {
                    0.0
                }
            }
            "rests" if (t * slow).fract() < 0.8 => 0.0,
            _ => peak * sines(t),
        }
    };
    (kind, (0..samples).map(|k| at(k, random)).collect())
}
