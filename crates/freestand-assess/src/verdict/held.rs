//! An object that a restraint holds: at rest on its floor until the force on the restraint exceeds what it
//! withstands, then released at that instant, and free.

use std::f64::consts::TAU;
use std::sync::Arc;

use freestand::G0_M_S2;
use freestand::decision::Level;
use freestand::fragility::lognormal_draw;
use freestand::oscillator::{DAMPING_RATIO, OscillatorState, OscillatorStep};
use freestand::respond::{Along, HistoryOptions, Outcome, Pads, Release, Settings};
use freestand::rocking::Outcome as Rocking;
use freestand::worlds::{Group, object_stream};
use rayon::prelude::*;

use crate::restraint::inset_m;
use crate::result::Probability;
use crate::worlds::{FloorOfWorld, Worlds};
use freestand_input::problem::{Problem, Problems};
use freestand_inventory::Item;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::study::Study;

use super::draw::{Change, Draw, Drawn, draw};
use super::object::{Model, Subject, Way};
use super::over_worlds::grouped;
use super::over_worlds::quantile;
use super::per_year::{INTENSITIES, WORLDS};
use super::respond::responses;
use super::response::{Lived, Lost, RigidResponse};
use super::slip::slips;
use super::trial::{HULL_WORLDS, Life, Question, Trial, answer, floors, live, live_again};
use super::{Context, Member};

/// How a restraint holds an object, and how strong it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// The period of the held object as an oscillator with 5 % damping; `None`: it does not move \[s\].
    pub period_s: Option<f64>,
    /// Where it holds.
    pub at: GripAt,
    /// Median of its capacity \[N\].
    pub median_n: f64,
    /// Standard deviation of the logarithm of its capacity.
    pub beta: f64,
}

/// Where a restraint holds an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GripAt {
    /// Above the floor, at this share of its height.
    Height(f64),
    /// At its base, by anchors along its edges.
    Base,
}

/// What is done to an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// It is held.
    Held(Grip),
    /// Its wheels no longer roll.
    Locked,
}

/// Why no effect of a measure on an object is calculated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotCalculated {
    /// The mass of the object is not known.
    NoMass,
    /// It does not roll, so there is nothing to lock.
    DoesNotRoll,
    /// The hold is flexible, and the object is not followed in a plane.
    NotInAPlane,
    /// Something stands on the object, which is not held.
    Stacked,
}

/// An object and what may be done to it.
pub struct Wanted<'a> {
    /// The object.
    pub item: &'a Item,
    /// The measures.
    pub measures: Vec<Measure>,
}

impl<'a> Wanted<'a> {
    fn member(&self, study: &Study) -> Option<Member<'a>> {
        let settings = &study.assessment;
        let subject = Subject::new(self.item, settings).ok()?;
        let mut member = Member::new(self.item, subject, settings);
        // A restraint is there to keep it from falling.
        member.asks_shock = false;
        Some(member)
    }
}

/// An object without and with each of its measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Restrained {
    /// Free, at each intensity; empty if only that of the study is asked.
    pub free: Vec<Level>,
    /// Whether it falls free in each world of each of these intensities.
    pub falls: Vec<Vec<bool>>,
    /// With each measure.
    pub measures: Vec<Result<Effect, NotCalculated>>,
}

/// What a measure does.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// The probability that the object falls in the earthquake of the study.
    pub overturn: Probability,
    /// The share of worlds in which the capacity is exceeded; `None`: nothing is held.
    pub exceeded_ratio: Option<f64>,
    /// Force that it must withstand in all worlds but the accepted share \[N\].
    pub force_n: Option<f64>,
    /// At each intensity; empty if only that of the study is asked.
    pub levels: Vec<Level>,
}

/// Each object without and with each of its measures, in the worlds of its assessment; at other intensities
/// too if `is_annual`. An object that has no verdict has no effects.
///
/// # Model
/// A rigid hold lets the object move with its floor; a flexible one makes it an oscillator of one degree of freedom.
/// With a(t) the horizontal acceleration of the centre of gravity, at the height c, the force is
///
/// ```text
/// at the height z:  P = m |a| c/z, of both components together; the weight is not counted
/// at the base:      T = (m |a| c − m (g + a_v) e)/(B − i), about the worse axis
/// ```
///
/// Where it first exceeds the capacity, which is drawn in each world, the object is released: at rest, or with the
/// velocity of the oscillator over c as ω. From there it is followed as without the restraint.
///
/// # Accuracy
/// The instant of the release is that of a sample of the motion, at most half a step away.
///
/// # Errors
/// A motion that cannot be generated, or a stop.
pub fn restrained<'a>(
    study: &'a Study,
    worlds: Worlds<'a>,
    wanted: &[Wanted],
    is_annual: bool,
    progress: Progress,
) -> Result<Vec<Option<Restrained>>, Problems> {
    let wants_to_stop = || progress(Step::asks()).is_break();
    let context = Context::new(study, worlds, wanted.len(), &wants_to_stop);
    let members: Vec<Option<Member>> = wanted.iter().map(|one| one.member(study)).collect();
    let mut cases: Vec<Case> = Vec::new();
    for (place, (member, wanted)) in members.iter().zip(wanted).enumerate() {
        if let Some(member) = member {
            cases.push(Case {
                place,
                trial: Trial::new(&context, member, member.subject.clone()),
                measures: &wanted.measures,
                found: Restrained {
                    free: Vec::new(),
                    falls: Vec::new(),
                    measures: Vec::new(),
                },
            });
        }
    }
    let total = cases.len();
    let mut done = 0;
    let levels = grouped(
        cases
            .iter()
            .enumerate()
            .map(|(place, case)| (case.trial.subject.level_ratio.to_bits(), place)),
    );
    for (_, places) in levels {
        if progress(Step::new(Stage::Objects, done, total)).is_break() {
            return Err(Problem::stopped().into());
        }
        done += places.len();
        on_floor(&context, &mut cases, &places, is_annual)?;
    }
    let mut found: Vec<Option<Restrained>> = members.iter().map(|_| None).collect();
    for case in cases {
        found[case.place] = Some(case.found);
    }
    Ok(found)
}

/// An object and what is found of it.
struct Case<'a> {
    /// Its place among all that are wanted.
    place: usize,
    /// Free, without worlds.
    trial: Trial<'a>,
    measures: &'a [Measure],
    found: Restrained,
}

/// The objects on one floor, of which each world is made once.
fn on_floor(
    context: &Context,
    cases: &mut [Case],
    places: &[usize],
    is_annual: bool,
) -> Result<(), Problems> {
    for &place in places {
        let case = &mut cases[place];
        for measure in case.measures {
            let effect = match measure {
                Measure::Locked => locked(context, case.trial.member)?,
                Measure::Held(grip) => Effect::to_be_held(&case.trial, grip),
            };
            case.found.measures.push(effect);
        }
    }
    let most = |case: &Case| worlds_of(&case.trial, case.trial.cap());
    for run in held_runs(context, cases, places, most)? {
        let case = &mut cases[run.place];
        let trial = &case.trial;
        if let Some(Ok(effect)) = case.found.measures.get_mut(run.measure) {
            let released = run.worlds.released.iter().filter(|one| **one).count();
            let accepted = trial.member.accepted_ratio;
            effect.overturn = run.worlds.worst(context, trial);
            effect.exceeded_ratio = Some(released as f64 / run.worlds.released.len().max(1) as f64);
            let peaks_n = run.worlds.peak_n.iter().copied();
            effect.force_n = Some(quantile(peaks_n, 1.0 - accepted));
        }
    }
    if !is_annual {
        return Ok(());
    }
    for intensity_ratio in INTENSITIES {
        let shaken = context.at_intensity(intensity_ratio);
        let level = |probability| Level {
            intensity_ratio,
            probability,
        };
        let free: Vec<&Trial> = places.iter().map(|&place| &cases[place].trial).collect();
        let falls = falls_at(&shaken, &free)?;
        for (&place, falls) in places.iter().zip(falls) {
            let case = &mut cases[place];
            case.found.free.push(level(share(&falls)));
            case.found.falls.push(falls);
            let measures = case.measures.iter().zip(&mut case.found.measures);
            for (measure, effect) in measures {
                let Ok(effect) = effect else { continue };
                if intensity_ratio == 1.0 {
                    effect.levels.push(level(effect.overturn.value));
                } else if *measure == Measure::Locked {
                    let locked = lock(&shaken, case.trial.member);
                    let falls = falls_at(&shaken, &[&locked])?;
                    effect
                        .levels
                        .extend(falls.iter().map(|falls| level(share(falls))));
                }
            }
        }
        if intensity_ratio == 1.0 {
            continue;
        }
        for run in held_runs(&shaken, cases, places, |case| {
            worlds_of(&case.trial, WORLDS)
        })? {
            let case = &mut cases[run.place];
            if let Some(Ok(effect)) = case.found.measures.get_mut(run.measure) {
                let found = run.worlds.worst(&shaken, &case.trial);
                effect.levels.push(level(found.value));
            }
        }
    }
    Ok(())
}

/// Worlds in which an object is followed, of at most `most`.
fn worlds_of(trial: &Trial, most: u32) -> u32 {
    if trial.subject.way.is_slow() {
        most.min(HULL_WORLDS)
    } else {
        most
    }
}

/// The share of worlds in which an object falls.
fn share(falls: &[bool]) -> f64 {
    falls.iter().filter(|falls| **falls).count() as f64 / falls.len().max(1) as f64
}

/// Whether each object falls in each world, by the model by which it falls in more of them.
fn falls_at(shaken: &Context, trials: &[&Trial]) -> Result<Vec<Vec<bool>>, Problems> {
    let lives: Vec<Life> = trials
        .iter()
        .map(|trial| Life {
            trial,
            worlds: worlds_of(trial, WORLDS),
            change: Change::None,
        })
        .collect();
    let mut lived: Vec<Vec<Lived>> = trials.iter().map(|_| Vec::new()).collect();
    live_again(shaken, &lives, |place, more| lived[place].extend(more))?;
    let of = |(life, lived): (&Life, Vec<Lived>)| {
        let by_model = life.trial.models(shaken).map(|model| {
            let falls =
                |one| answer(&life.trial.subject, one, Question::Falls, model) == Some(Some(true));
            lived.iter().map(falls).collect::<Vec<bool>>()
        });
        let larger = |most: Vec<bool>, next: Vec<bool>| {
            if share(&next) > share(&most) {
                next
            } else {
                most
            }
        };
        by_model.reduce(larger).unwrap_or_default()
    };
    Ok(lives.iter().zip(lived).map(of).collect())
}

/// The same object with locked wheels.
fn lock<'a>(context: &Context, member: &'a Member<'a>) -> Trial<'a> {
    let around = &member.item.surroundings;
    let subject = member.subject.locked(around, &context.study.assessment);
    Trial::new(context, member, subject)
}

fn locked(context: &Context, member: &Member) -> Result<Result<Effect, NotCalculated>, Problems> {
    if !matches!(member.subject.way, Way::Rolls(_)) {
        return Ok(Err(NotCalculated::DoesNotRoll));
    }
    let mut trials = [lock(context, member)];
    live(context, &mut trials)?;
    let trial = &trials[0];
    let by_model = trial
        .models(context)
        .map(|model| trial.probability(context, Question::Falls, model));
    Ok(Ok(Effect {
        overturn: worse(by_model),
        exceeded_ratio: None,
        force_n: None,
        levels: Vec::new(),
    }))
}

/// The probability with the larger upper end; without any, nothing is known.
fn worse(by_model: impl Iterator<Item = Probability>) -> Probability {
    let larger =
        |most: Probability, next: Probability| if next.high > most.high { next } else { most };
    by_model.reduce(larger).unwrap_or(UNKNOWN)
}

/// Whatever may happen: nothing is better for not being known.
const UNKNOWN: Probability = Probability {
    value: 1.0,
    low: 0.0,
    high: 1.0,
};

impl Effect {
    /// Of a hold of which nothing is calculated yet, or why nothing can be.
    fn to_be_held(trial: &Trial, grip: &Grip) -> Result<Self, NotCalculated> {
        let subject = &trial.subject;
        if subject.mass_kg.is_none() {
            return Err(NotCalculated::NoMass);
        }
        if matches!(subject.way, Way::Stack(_)) {
            return Err(NotCalculated::Stacked);
        }
        if grip.period_s.is_some() && !matches!(subject.way, Way::Planar | Way::Walled(_)) {
            return Err(NotCalculated::NotInAPlane);
        }
        Ok(Self {
            overturn: UNKNOWN,
            exceeded_ratio: None,
            force_n: None,
            levels: Vec::new(),
        })
    }
}

/// A held object in some worlds.
#[derive(Default)]
struct HeldWorlds {
    /// The largest force on the restraint if it holds \[N\].
    peak_n: Vec<f64>,
    /// Whether its capacity was exceeded.
    released: Vec<bool>,
    /// Whether it fell, by each model; `None`: that could not be found.
    fell: [Vec<Option<bool>>; 2],
}

/// A measure that holds an object.
struct Run {
    place: usize,
    measure: usize,
    worlds: HeldWorlds,
}

/// Worlds whose floors are held at a time.
const BLOCK: u32 = 256;

/// The floors of worlds that follow each other.
#[derive(Clone, Copy)]
struct Stretch<'f> {
    /// The number of the first world.
    first: u32,
    floors: &'f [Arc<FloorOfWorld>],
}

/// Every hold that can be calculated of the objects on one floor, each in the worlds that `most` says.
fn held_runs(
    context: &Context,
    cases: &[Case],
    places: &[usize],
    most: impl Fn(&Case) -> u32,
) -> Result<Vec<Run>, Problems> {
    let mut runs: Vec<Run> = Vec::new();
    for &place in places {
        let case = &cases[place];
        let measures = case.measures.iter().zip(&case.found.measures).enumerate();
        let held = measures
            .filter(|(_, (measure, effect))| matches!(measure, Measure::Held(_)) && effect.is_ok());
        runs.extend(held.map(|(measure, _)| Run {
            place,
            measure,
            worlds: HeldWorlds::default(),
        }));
    }
    let end = runs.iter().map(|run| most(&cases[run.place])).max();
    let level = places
        .first()
        .map(|&place| cases[place].trial.subject.level_ratio);
    let (Some(end), Some(level_ratio)) = (end, level) else {
        return Ok(runs);
    };
    for first in (0..end).step_by(BLOCK as usize) {
        context.go_on()?;
        let block = first..end.min(first + BLOCK);
        let floors = floors(context, &[level_ratio], block.clone(), Change::None)?;
        let Some(floors) = floors.first() else { break };
        for run in &mut runs {
            context.go_on()?;
            let case = &cases[run.place];
            let own = most(case).saturating_sub(first).min(BLOCK) as usize;
            let floors = &floors[..own.min(floors.len())];
            if let Some(Measure::Held(grip)) = case.measures.get(run.measure) {
                let stretch = Stretch { first, floors };
                run.worlds.live_on(context, &case.trial, grip, stretch);
            }
        }
    }
    Ok(runs)
}

impl HeldWorlds {
    /// The probability of falling, by the model with the larger upper end.
    fn worst(&self, context: &Context, trial: &Trial) -> Probability {
        worse(trial.models(context).map(|model| {
            let answers = match model {
                Model::Rigid => &self.fell[0],
                Model::Pads => &self.fell[1],
            };
            Trial::probability_of(context, answers)
        }))
    }

    /// In worlds that follow each other.
    fn live_on(
        &mut self,
        context: &Context,
        trial: &Trial,
        grip: &Grip,
        Stretch { first, floors }: Stretch,
    ) {
        let subject = &trial.subject;
        let settings = &context.study.assessment;
        let in_world = |(world, floor): (u32, &Arc<FloorOfWorld>)| {
            let key = trial.member.key;
            let draw = draw(settings, subject, key, world, Change::None);
            let mut random = object_stream(settings.seed, world, key, Group::Restraint, 0);
            let capacity_n = lognormal_draw(&mut random, grip.median_n, grip.beta);
            let until = Hold::new(grip, &draw, subject, floor).until(capacity_n);
            (draw, until)
        };
        let jobs: Vec<(u32, &Arc<FloorOfWorld>)> = (first..).zip(floors).collect();
        let in_worlds: Vec<(Draw, Until)> = jobs.into_par_iter().map(in_world).collect();
        let mut freed: Vec<Freed> = Vec::new();
        for ((draw, until), floor) in in_worlds.iter().zip(floors) {
            // A motion that ends at the release moves nothing any more.
            let rest = until
                .released
                .and_then(|released| Some((floor.from_sample(released.sample)?, released)));
            if let Some((floor, released)) = rest {
                freed.push(Freed {
                    place: self.peak_n.len(),
                    one: Drawn { subject, draw },
                    floor,
                    velocity_m_s: released.velocity_m_s,
                });
            }
            self.peak_n.push(until.peak_n);
            self.released.push(until.released.is_some());
        }
        let worlds = self.peak_n.len();
        for fell in &mut self.fell {
            fell.resize(worlds, Some(false));
        }
        let fell = match grip.period_s {
            None => from_rest(context, trial, &freed),
            Some(_) => with_velocity(context, trial, &freed),
        };
        for (one, fell) in freed.iter().zip(fell) {
            for (all, fell) in self.fell.iter_mut().zip(fell) {
                all[one.place] = fell;
            }
        }
    }
}

/// An object that its restraint no longer holds.
struct Freed<'a> {
    place: usize,
    one: Drawn<'a>,
    /// What is left of the motion.
    floor: FloorOfWorld,
    /// Of its centre of gravity over its floor, along x and y \[m/s\].
    velocity_m_s: [f64; 2],
}

/// Whether each falls by both models, released at rest.
fn from_rest(context: &Context, trial: &Trial, freed: &[Freed]) -> Vec<[Option<bool>; 2]> {
    let asks = |model| trial.asks(context, model);
    let objects = freed
        .iter()
        .map(|freed| Ok((freed.one.on_rigid_base()?, freed.floor.shaking())));
    let rigid: Vec<Option<RigidResponse>> = match asks(Model::Rigid) {
        true => freed
            .iter()
            .zip(responses(objects))
            .map(|(freed, found)| Some(freed.one.rigid_response(&freed.floor, found)))
            .collect(),
        false => freed.iter().map(|_| None).collect(),
    };
    let slipping: Vec<bool> = freed
        .iter()
        .zip(&rigid)
        .map(|(freed, rigid)| {
            let Drawn { subject, draw } = freed.one;
            slips(subject, draw, &freed.floor, rigid.as_ref())
        })
        .collect();
    let pads: Vec<Option<Result<Outcome, Lost>>> = match asks(Model::Pads) {
        true => {
            let objects = freed.iter().zip(&slipping).map(|(freed, slips)| {
                let friction_ratio = freed.one.draw.friction_ratio.filter(|_| *slips);
                Ok((freed.one.on_pads(friction_ratio)?, freed.floor.shaking()))
            });
            let outcome = |found: Result<_, _>| {
                Some(found.map(|found: freestand::respond::Response| found.outcome()))
            };
            responses(objects).into_iter().map(outcome).collect()
        }
        false => freed.iter().map(|_| None).collect(),
    };
    rigid
        .into_iter()
        .zip(pads)
        .zip(slipping)
        .map(|((rigid, pads), slips)| {
            let flies = matches!(rigid, Some(Err(Lost::Flight(_))));
            let fell = |outcome: Outcome| outcome.has_fallen();
            let on_pads = pads.and_then(Result::ok).and_then(fell);
            let on_rigid = rigid
                .and_then(Result::ok)
                .and_then(|told| fell(told.outcome));
            // As in an assessment: a rigid base can follow neither what slides while it rocks nor what flies.
            let is_for_pads = (slips || flies) && on_pads.is_some();
            [if is_for_pads { on_pads } else { on_rigid }, on_pads]
        })
        .collect()
}

/// Whether each falls by both models, released with a velocity.
fn with_velocity(context: &Context, trial: &Trial, freed: &[Freed]) -> Vec<[Option<bool>; 2]> {
    let one = |freed: &Freed| {
        [Model::Rigid, Model::Pads].map(|model| {
            if !trial.asks(context, model) {
                return None;
            }
            let axes = 0..trial.subject.axes.len();
            let fell: Option<Vec<bool>> = axes.map(|axis| falls(freed, model, axis)).collect();
            Some(fell?.contains(&true))
        })
    };
    freed.par_iter().map(one).collect()
}

/// Whether an object that is released with a velocity falls about an axis; `None`: that could not be found.
fn falls(freed: &Freed, model: Model, axis: usize) -> Option<bool> {
    let Freed {
        one,
        floor,
        velocity_m_s,
        ..
    } = freed;
    let (block, _) = one.draw.block(one.subject, axis)?;
    let along = one.draw.along(axis);
    let [x, y] = *velocity_m_s;
    let velocity_m_s = match along {
        Along::X => x,
        Along::Y => y,
    };
    let how = HistoryOptions {
        settings: Settings::default(),
        start: Release {
            rotation_rad: 0.0,
            omega_rad_s: velocity_m_s / block.cg_height_m(),
        },
        ..HistoryOptions::default()
    };
    let base = floor.base(along);
    let outcome = match model {
        Model::Rigid => {
            let plane = one.rigid_plane(axis)?;
            plane.follow(base, &how).ok()?.rocking.outcome
        }
        Model::Pads => {
            let pads = one.pads(None)?;
            let planes = pads.planes.about(axis);
            Pads { planes, ..pads }
                .follow(base, &how)
                .ok()?
                .rocking
                .outcome
        }
    };
    (outcome != Rocking::Unresolved).then(|| outcome.has_fallen())
}

/// The held object under one motion: the force on its restraint.
struct Hold {
    /// At each sample \[N\].
    force_n: Vec<f64>,
    /// Of its centre of gravity over its floor, along x and y, at each sample; empty: it does not move \[m/s\].
    velocity_m_s: Vec<[f64; 2]>,
}

/// How long a restraint holds.
struct Until {
    peak_n: f64,
    /// `None`: to the end.
    released: Option<Released>,
}

/// The release of an object.
#[derive(Clone, Copy)]
struct Released {
    sample: usize,
    velocity_m_s: [f64; 2],
}

impl Hold {
    fn new(grip: &Grip, draw: &Draw, subject: &Subject, floor: &FloorOfWorld) -> Self {
        let shaking = floor.shaking();
        let components = [shaking.x, shaking.y].map(|motion| {
            let motion = motion?;
            let dt_s = motion.dt_s();
            let step = grip
                .period_s
                .and_then(|period_s| OscillatorStep::new(TAU / period_s, DAMPING_RATIO, dt_s).ok());
            let accel = motion.accel_m_s2();
            let Some(step) = step else {
                return Some((accel.to_vec(), Vec::new()));
            };
            let mut state = OscillatorState::default();
            let mut before_m_s2 = accel.first().copied().unwrap_or(0.0);
            let states = accel.iter().map(|&now_m_s2| {
                state = step.advance(state, before_m_s2, now_m_s2);
                before_m_s2 = now_m_s2;
                (step.absolute_acceleration_m_s2(state), state.velocity_m_s)
            });
            Some(states.unzip())
        });
        let [x, y] = components;
        let (x_m_s2, x_m_s): (Vec<f64>, Vec<f64>) = x.unwrap_or_default();
        let y = y.as_ref();
        let mass_kg = draw.mass_kg(subject).unwrap_or(0.0);
        let blocks: Vec<_> = (0..subject.axes.len())
            .filter_map(|axis| Some((draw.along(axis), draw.block(subject, axis)?.0)))
            .collect();
        let vertical = shaking.vertical;
        let force = |sample: usize| {
            let x_m_s2 = x_m_s2[sample];
            let y_m_s2 = y.and_then(|(accel, _)| accel.get(sample)).copied();
            let by_axis = blocks.iter().map(|(along, block)| {
                let c_m = block.cg_height_m();
                match grip.at {
                    GripAt::Height(ratio) => {
                        let both_m_s2 = x_m_s2.hypot(y_m_s2.unwrap_or(0.0));
                        mass_kg * both_m_s2 * c_m / (ratio * block.height_m())
                    }
                    GripAt::Base => {
                        let a_m_s2 = match along {
                            Along::X => x_m_s2,
                            Along::Y => y_m_s2.unwrap_or(x_m_s2),
                        };
                        let up_m_s2 = vertical
                            .and_then(|motion| motion.accel_m_s2().get(sample))
                            .copied();
                        let base_m = block.base_width_m();
                        let right_m = block.cg_from_right_m();
                        let lever_m = right_m.min(base_m - right_m);
                        let inset_m = inset_m(None, base_m);
                        let weight_n = mass_kg * (G0_M_S2 + up_m_s2.unwrap_or(0.0));
                        (mass_kg * a_m_s2.abs() * c_m - weight_n * lever_m) / (base_m - inset_m)
                    }
                }
            });
            by_axis.fold(0.0, f64::max)
        };
        let force_n = (0..x_m_s2.len()).map(force).collect();
        // Without a second component the first one moves it in any direction.
        let other = |sample: usize| y.and_then(|(_, own)| own.get(sample)).copied();
        let velocity = |(sample, x_m_s): (usize, &f64)| [*x_m_s, other(sample).unwrap_or(*x_m_s)];
        Self {
            force_n,
            velocity_m_s: x_m_s.iter().enumerate().map(velocity).collect(),
        }
    }

    /// Until its force exceeds a capacity: at the sample that is nearer to that instant.
    fn until(self, capacity_n: f64) -> Until {
        let peak_n = self.force_n.iter().copied().fold(0.0, f64::max);
        let first = self
            .force_n
            .iter()
            .position(|force_n| *force_n > capacity_n);
        let released = first.map(|after| {
            let before = after.saturating_sub(1);
            let (low_n, high_n) = (self.force_n[before], self.force_n[after]);
            let is_before = after > 0 && capacity_n - low_n < high_n - capacity_n;
            let sample = if is_before { before } else { after };
            Released {
                sample,
                velocity_m_s: self.velocity_m_s.get(sample).copied().unwrap_or_default(),
            }
        });
        Until { peak_n, released }
    }
}

#[cfg(test)]
mod tests;
