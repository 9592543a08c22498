//! The science of free-standing objects in an earthquake.
//!
//! A cabinet, a server rack or a museum case rests on the floor of a building. When the floor
//! shakes, it rocks on the edges of its base; each time the base strikes the floor, the landing
//! edge takes a shock; if it rocks too far, it overturns. This crate calculates that chain of
//! events in double precision and SI units:
//!
//! | step | module |
//! |---|---|
//! | the object, as a rigid block on two edges | [`block`] |
//! | ground motions that match the spectrum of a code | [`code_spectrum`], [`synthesis`] |
//! | the floors of a building | [`building`], [`oscillator`] |
//! | rotation against time, event by event | [`rocking`] |
//! | walls and neighbours beside the object | [`wall`] |
//! | largest uplift over a grid of objects, and the resulting shock | [`spectra`] |
//! | contact laws: the force of a cushion, and the landing of a mass on it | [`cushion`] |
//! | a block that slides, or rolls on casters, instead of rocking | [`sliding`] |
//! | the object on cushions, integrated in time: a check of that shock | [`compliant`] |
//! | the shock of one landing on a cushion, Eqs. (1)–(8) of Al Abadi et al. | [`impact`] |
//! | the shock of an impact on a wall | [`wall_shock`] |
//! | a cushion identified from tests | [`identify`] |
//! | the response of a component to a shock: shock response spectra, pulses | [`shock_response`] |
//! | the shocks that cause damage, ASTM D3332 | [`damage_boundary`] |
//! | fragilities, probabilities over motions, reproducible random draws | [`fragility`] |
//! | worlds: complete draws of everything that is uncertain | [`worlds`] |
//! | suites of records with the mean and the dispersion of a hazard | [`suite`] |
//! | when a count of worlds answers a question | [`decision`] |
//! | intensity of a motion | [`measures`], [`motion`] |
//! | baseline, filter, time step, direction and scale of a record | [`signal`] |
//!
//! The paper is Al Abadi, Petrolito, Lam and Gad.
//!
//! **Signs**: a rotation is positive when the object tilts to the right (clockwise), about its
//! right edge; a positive horizontal acceleration of the base (to the right) drives the rotation
//! negative. Vertical acceleration is positive upward.
//!
//! **Units** are part of every name (`_m`, `_kg`, `_s`, `_rad`, `_m_s2`, `_n_m`, `_g`); pure ratios
//! end in `_ratio`.
//!
//! The crate uses no files, clock, environment or output: it can only fail because of its input.
//!
//! # Example
//! A cabinet of 2.3 m × 0.6 m and 140 kg on pads of 4380 N/mm per edge, under one cycle of 0.35 g:
//! ```
//! use freestand::block::Block;
//! use freestand::cushion::Cushion;
//! use freestand::impact::ImpactModel;
//! use freestand::motion::Motion;
//! use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock};
//! use freestand::spectra::UpliftCell;
//!
//! let cabinet = Block::uniform(2.3, 0.6)?;
//! let phase = |i: i32| std::f64::consts::TAU * f64::from(i) / 200.0;
//! let cycle = (0..=200).map(|i| 0.35 * 9.80665 * phase(i).sin());
//! let floor = Motion::new(0.004, cycle.collect())?;
//! let until = Until::Settled { at_most_s: 60.0 };
//! let options = RockingOptions { until, ..RockingOptions::default() };
//! let base = Base { horizontal: Some(&floor), vertical: None };
//!
//! let history = rock(&cabinet, base, &options)?;
//! assert_eq!(history.outcome, Outcome::Rocked);
//! assert!(history.peak_rotation_rad < cabinet.pivot().slenderness_angle_rad);
//!
//! let pads = Cushion::linear(4.38e6)?;
//! let cell = UpliftCell::new(cabinet, &history);
//! let shock = cell.shock(140.0, &pads, ImpactModel::Paper, freestand::G0_M_S2);
//! assert!(shock.edge_acceleration_g < Some(shock.ceiling_g));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod building;
pub mod code_spectrum;
pub mod compliant;
pub mod cushion;
pub mod damage_boundary;
pub mod decision;
pub mod fragility;
pub mod hull;
pub mod identify;
pub mod impact;
mod integration;
pub mod measures;
pub mod oscillator;
pub mod respond;
pub mod risk;
mod search;
pub mod shock_response;
pub mod signal;
pub mod sliding;
mod space;
pub mod spatial;
pub mod spectra;
pub mod suite;
pub mod synthesis;
pub mod wall_shock;
pub mod worlds;

use freestand_rocking::vector;
pub use freestand_rocking::{G0_M_S2, block, motion, rocking, wall};
