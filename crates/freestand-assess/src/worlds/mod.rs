//! The worlds of a study: ground motions and building, drawn again in each world, and the motions
//! of any floor in it.

mod floor;

use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use freestand::building::{Building, floor_motions_and_peaks};
use freestand::motion::Motion;
use freestand::synthesis::{QuickMatcher, SynthesisOptions, with_pulse};
use freestand::worlds::{
    BuildingDraw, BuildingSpread, Component, GroundSpread, Group, Pulses, SpreadOptions, WorldDraw,
    WorldPulse, WorldSpectra, place_among, world_motion, world_stream,
};
use rayon::prelude::*;

use crate::kept_motions::KeptMotions;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_records::horizontal::HorizontalMotion;
use freestand_study::result::GroundMotion;
use freestand_study::run::ground_motions;
use freestand_study::study::assessment::WorldSettings;
use freestand_study::study::{
    BuildingInput, Ground, Level, RecordedMotion, Study, SyntheticGround, VerticalTarget,
};

pub use floor::{FloorOfWorld, HorizontalPeaks};

/// Largest difference between two level ratios of the same floor: inventories give two or three
/// digits.
const SAME_LEVEL: f64 = 5e-3;

/// Ground motions that are kept in memory, and as many floors: 1280 worlds of two components of 45 s take 190 MB.
const MAX_KEPT: usize = 1536;

/// Floors whose peaks are kept, in 21 MB.
const MAX_PEAKS: usize = 1 << 18;

/// The motions of worlds, kept from one request to the next: whoever moves a slider asks about many
/// objects on one floor. It keeps those of the last few grounds and buildings.
#[derive(Default)]
pub struct Memory(Mutex<Vec<Remembered>>);

/// Grounds and buildings whose motions are remembered; each takes up to 300 MB.
const MAX_REMEMBERED: usize = 2;

/// What the motions of worlds depend on, and those that are known.
struct Remembered {
    ground: Ground,
    building: Option<BuildingInput>,
    settings: WorldSettings,
    seed: u64,
    vertical_amplification_ratio: f64,
    kept: Arc<Mutex<Kept>>,
    floors: Arc<Mutex<KeptFloors>>,
}

/// Floors by the number of their world and the bits of their level.
type KeptFloors = HashMap<(u32, u64), Arc<FloorOfWorld>>;

/// Their peaks, likewise.
type KeptPeaks = HashMap<(u32, u64), HorizontalPeaks>;

impl Remembered {
    fn of(study: &Study) -> Self {
        Self {
            ground: study.ground.clone(),
            building: study.building.clone(),
            settings: study.assessment.worlds,
            seed: study.assessment.seed,
            vertical_amplification_ratio: study.vertical_amplification_ratio,
            kept: Arc::default(),
            floors: Arc::default(),
        }
    }

    fn is_of(&self, study: &Study) -> bool {
        // How many worlds are asked does not change them.
        let settings = WorldSettings {
            looks: self.settings.looks,
            ..study.assessment.worlds
        };
        self.ground == study.ground
            && self.building == study.building
            && self.settings == settings
            && self.seed == study.assessment.seed
            && self.vertical_amplification_ratio == study.vertical_amplification_ratio
    }
}

/// Draws the worlds of a study.
pub struct Worlds<'a> {
    study: &'a Study,
    source: Source<'a>,
    spread: GroundSpread,
    /// `None`: no world has a pulse.
    pulses: Option<Pulses>,
    building: BuildingSpread,
    /// Factor on the ground motions, for rates per year.
    intensity_ratio: f64,
    /// At the intensity of the study.
    kept: Arc<Mutex<Kept>>,
    /// Those of other processes too.
    on_disk: Option<Arc<KeptMotions>>,
    /// Floors at the intensity of the study; `None`: they are not kept.
    floors: Option<Arc<Mutex<KeptFloors>>>,
    /// The peaks of floors that were made at the intensity of the study.
    peaks: Arc<Mutex<KeptPeaks>>,
    /// Floors whose peaks are calculated with the first floors of a world, because they will be asked.
    peaks_at_ratio: Arc<[f64]>,
}

/// Ground motions by the number of their world, and how often they were drawn again.
type Kept = HashMap<(u32, u32), Arc<GroundOfWorld>>;

/// Where the ground motions of worlds come from.
#[derive(Clone)]
enum Source<'a> {
    /// Each world has a motion of its own, for a spectrum that deviates from the target.
    Synthetic(&'a SyntheticGround, Arc<QuickMatcher>),
    /// The worlds use these motions in turn.
    InTurn(Arc<[GroundMotion]>),
    /// The worlds use the motions of the floors in turn.
    OnFloors { names: Arc<[String]> },
}

/// What is drawn again while all else stays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Again {
    /// The ground motion.
    pub motion: u32,
    /// The building.
    pub building: u32,
}

/// The ground motion of a world.
#[derive(Debug, Clone)]
pub struct GroundOfWorld {
    /// Its horizontal components.
    pub motion: HorizontalMotion,
    /// Its vertical component, if it has one.
    pub vertical: Option<Motion>,
    /// The motion that the worlds use in turn, where they do.
    pub record: Option<String>,
}

/// What shakes a building in a world: the components of the ground, each with the axis that it shakes and long enough
/// for the vibration to decay.
struct ShakenBuilding {
    along: (Motion, Building),
    across: Option<(Motion, Building)>,
    tail_s: f64,
}

impl ShakenBuilding {
    fn new(
        ground: &GroundOfWorld,
        building: &BuildingInput,
        draw: BuildingDraw,
    ) -> Result<Self, Problems> {
        let along = drawn(&building.along, draw)?;
        let across = building
            .across
            .as_ref()
            .map(|across| drawn(across, draw))
            .transpose()?;
        let tail_s = across
            .as_ref()
            .map_or(0.0, Building::tail_s)
            .max(along.tail_s());
        let padded = |motion: &Motion| {
            motion
                .with_zero_tail(tail_s)
                .map_err(failed("a floor motion"))
        };
        let second = ground.motion.across.as_ref().map(padded).transpose()?;
        let across = second.map(|motion| (motion, across.unwrap_or_else(|| along.clone())));
        Ok(Self {
            along: (padded(&ground.motion.along)?, along),
            across,
            tail_s,
        })
    }
}

/// What a building is in a world, at the first axis.
#[derive(Debug, Clone, Copy)]
pub struct BuildingOfWorld {
    /// Its fundamental period \[s\].
    pub period_s: f64,
    /// Its damping ratio; `None`: its model states none.
    pub damping_ratio: Option<f64>,
}

impl<'a> Worlds<'a> {
    /// # Errors
    /// A motion that cannot be generated; a run that is stopped by `go_on`.
    pub fn new(
        study: &'a Study,
        go_on: impl Fn() -> Result<(), Problems> + Sync,
    ) -> Result<Self, Problems> {
        let source = match &study.ground {
            Ground::Synthetic(synthetic) => {
                let matcher = QuickMatcher::new(&SynthesisOptions::default());
                Source::Synthetic(synthetic, Arc::new(matcher.map_err(failed("a motion"))?))
            }
            Ground::OnFloors => {
                if let Some(level) = study
                    .levels
                    .iter()
                    .find(|level| level.level_ratio.is_none())
                {
                    let message = format!(
                        "the level \"{}\" has no level_ratio, so no object is on it",
                        shorten(&level.name)
                    );
                    let hint =
                        "add level_ratio to each of the levels: 0 at the ground, 1 at the roof";
                    return Err(Problem::new(ProblemKind::Missing, message)
                        .hint(hint)
                        .into());
                }
                Source::OnFloors {
                    names: study.ground.names(&study.levels).into(),
                }
            }
            Ground::Simulated(_) | Ground::Recorded(_) => {
                Source::InTurn(ground_motions(&study.ground, go_on)?.into())
            }
        };
        let WorldSettings {
            spectral_spread,
            intensity_spread,
            component_correlation,
            period_spread,
            damping_spread,
            ..
        } = study.assessment.worlds;
        let refused = |error: freestand::worlds::WorldError| {
            Problem::new(ProblemKind::Value, error.to_string())
        };
        let options = SpreadOptions {
            spectral_spread,
            intensity_spread,
            component_correlation,
            hazard_spread: match &study.ground {
                Ground::Synthetic(SyntheticGround { target, .. }) => target.hazard_spread(),
                _ => 0.0,
            },
        };
        let pulses = match &study.ground {
            Ground::Synthetic(SyntheticGround {
                target,
                near_fault: Some(fault),
                ..
            }) => Pulses::new(*fault, |t| target.spectrum.sa_g(t))
                .map_err(failed("the velocity pulses"))?,
            _ => None,
        };
        Ok(Self {
            study,
            source,
            pulses,
            spread: GroundSpread::new(options).map_err(refused)?,
            building: BuildingSpread::new(period_spread, damping_spread).map_err(refused)?,
            intensity_ratio: 1.0,
            kept: Arc::default(),
            on_disk: None,
            floors: None,
            peaks: Arc::default(),
            peaks_at_ratio: Arc::default(),
        })
    }

    /// The same worlds, in which [`Worlds::floor_peaks`] of these levels will be asked.
    pub(crate) fn with_peaks_of(self, levels_ratio: Arc<[f64]>) -> Self {
        Self {
            peaks_at_ratio: levels_ratio,
            ..self
        }
    }

    /// The same worlds, with ground motions that several processes make once.
    pub(crate) fn kept_in(self, folder: KeptMotions) -> Self {
        Self {
            on_disk: Some(Arc::new(folder)),
            ..self
        }
    }

    /// The same worlds, with the motions that are remembered of earlier requests.
    pub fn remembering(mut self, memory: &Memory) -> Self {
        if !matches!(self.source, Source::Synthetic(..)) {
            return self;
        }
        let mut all = memory.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = match all.iter().position(|one| one.is_of(self.study)) {
            Some(place) => all.remove(place),
            None => Remembered::of(self.study),
        };
        self.kept = Arc::clone(&known.kept);
        self.floors = Some(Arc::clone(&known.floors));
        all.truncate(MAX_REMEMBERED - 1);
        all.insert(0, known);
        self
    }

    /// The floors in one world, those that are remembered and those that are made.
    fn remembered(
        &self,
        world: u32,
        levels_ratio: &[f64],
        again: Again,
        building: Option<BuildingDraw>,
    ) -> Result<Vec<Arc<FloorOfWorld>>, Problems> {
        let is_plain =
            again == Again::default() && building.is_none() && self.intensity_ratio == 1.0;
        let make = || -> Result<Vec<Arc<FloorOfWorld>>, Problems> {
            let others = match is_plain {
                true => self.without_peaks(world, &self.peaks_at_ratio, levels_ratio),
                false => Vec::new(),
            };
            let (made, peaks) = self.made(world, (levels_ratio, &others), again, building)?;
            if is_plain {
                let of_made = made.iter().map(|floor| HorizontalPeaks::of(&floor.motion));
                let levels = levels_ratio.iter().chain(&others);
                self.keep_peaks(world, levels.copied().zip(of_made.chain(peaks)));
            }
            Ok(made.into_iter().map(Arc::new).collect())
        };
        let Some(floors) = self.floors.as_ref().filter(|_| is_plain) else {
            return make();
        };
        let key = |level_ratio: &f64| (world, level_ratio.to_bits());
        let known = {
            let floors = floors.lock().unwrap_or_else(PoisonError::into_inner);
            levels_ratio
                .iter()
                .map(|level| floors.get(&key(level)).cloned())
                .collect::<Option<Vec<_>>>()
        };
        if let Some(known) = known {
            return Ok(known);
        }
        let made = make()?;
        let mut floors = floors.lock().unwrap_or_else(PoisonError::into_inner);
        if floors.len() + made.len() > MAX_KEPT {
            floors.clear();
        }
        floors.extend(levels_ratio.iter().map(key).zip(made.iter().cloned()));
        Ok(made)
    }

    fn known_peaks(&self) -> MutexGuard<'_, KeptPeaks> {
        self.peaks.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn keep_peaks(&self, world: u32, made: impl Iterator<Item = (f64, HorizontalPeaks)>) {
        let made: Vec<_> = made
            .map(|(level_ratio, peaks)| ((world, level_ratio.to_bits()), peaks))
            .collect();
        let mut known = self.known_peaks();
        let room = MAX_PEAKS.saturating_sub(known.len());
        known.extend(made.into_iter().take(room));
    }

    /// Those of the levels that have no known peaks in a world, without `others`.
    fn without_peaks(&self, world: u32, levels_ratio: &[f64], others: &[f64]) -> Vec<f64> {
        let known = self.known_peaks();
        let is_unknown = |level_ratio: &&f64| {
            !known.contains_key(&(world, level_ratio.to_bits())) && !others.contains(level_ratio)
        };
        levels_ratio.iter().filter(is_unknown).copied().collect()
    }

    /// The peaks of some floors in one world at the intensity of the study; only those that are not known yet are
    /// calculated.
    ///
    /// # Errors
    /// A motion that cannot be generated.
    pub fn floor_peaks(
        &self,
        world: u32,
        levels_ratio: &[f64],
    ) -> Result<Vec<HorizontalPeaks>, Problems> {
        let unknown = self.without_peaks(world, levels_ratio, &[]);
        let peaks = match unknown.is_empty() {
            true => Vec::new(),
            false => {
                let worlds = self.at_intensity(1.0);
                worlds
                    .made(world, (&[], &unknown), Again::default(), None)?
                    .1
            }
        };
        let made = |level_ratio: &f64| {
            let place = unknown.iter().position(|level| level == level_ratio)?;
            peaks.get(place).copied()
        };
        let known = self.known_peaks();
        let of = |level_ratio: &f64| {
            let known = known.get(&(world, level_ratio.to_bits())).copied();
            known.or_else(|| made(level_ratio))
        };
        Ok(levels_ratio.iter().filter_map(of).collect())
    }

    /// The motions that the worlds use in turn; `None`: each world has its own.
    pub fn records(&self) -> Option<u32> {
        let count = match &self.source {
            Source::Synthetic(..) => return None,
            Source::InTurn(motions) => motions.len(),
            Source::OnFloors { names } => names.len(),
        };
        Some(u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// Whether the worlds of one record differ in nothing but the object.
    pub fn building_is_known(&self) -> bool {
        let WorldSettings {
            period_spread,
            damping_spread,
            ..
        } = self.study.assessment.worlds;
        self.study.building.is_none() || (period_spread == 0.0 && damping_spread == 0.0)
    }

    /// Whether a floor has motions.
    pub fn has_floor(&self, level_ratio: f64) -> bool {
        self.study.building.is_some() || self.given(level_ratio).is_some()
    }

    /// The name of the motion of a world.
    pub fn name(&self, world: u32) -> String {
        let of = |names: &mut dyn ExactSizeIterator<Item = &String>| {
            let place = world as usize % names.len().max(1);
            names
                .nth(place)
                .map_or_else(String::new, |name| format!("{name} (world {world})"))
        };
        match &self.source {
            Source::Synthetic(..) => format!("world {world}"),
            Source::InTurn(motions) => of(&mut motions.iter().map(|one| &one.name)),
            Source::OnFloors { names } => of(&mut names.iter()),
        }
    }

    /// The same worlds at another intensity.
    pub fn at_intensity(&self, ratio: f64) -> Worlds<'a> {
        Worlds {
            study: self.study,
            source: self.source.clone(),
            spread: self.spread.clone(),
            pulses: self.pulses.clone(),
            building: self.building,
            intensity_ratio: ratio,
            kept: Arc::clone(&self.kept),
            on_disk: self.on_disk.clone(),
            floors: self.floors.clone(),
            peaks: Arc::clone(&self.peaks),
            peaks_at_ratio: Arc::clone(&self.peaks_at_ratio),
        }
    }

    /// The same worlds, with their floors kept: the latest, at the intensity of the study. Where there is no room for
    /// more, all are dropped.
    pub(crate) fn keeping_floors(&self) -> Worlds<'a> {
        let mut worlds = self.at_intensity(self.intensity_ratio);
        worlds.floors.get_or_insert_default();
        worlds
    }

    /// The place of the motion that a world uses, among those that are used in turn.
    fn in_turn(&self, world: u32, again: u32, count: usize) -> usize {
        if again == 0 {
            return world as usize % count.max(1);
        }
        place_among(
            &mut world_stream(self.study.assessment.seed, world, Group::Motion, again),
            count,
        )
    }

    /// The ground motion of a world at the intensity of the study; `None` where only floors are given.
    pub fn ground(&self, world: u32, again: u32) -> Result<Option<Arc<GroundOfWorld>>, Problems> {
        let key = (world, again);
        if let Some(found) = self
            .kept
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .get(&key)
        {
            return Ok(Some(Arc::clone(found)));
        }
        let made = match &self.source {
            Source::OnFloors { .. } => return Ok(None),
            Source::InTurn(motions) => {
                let one = &motions[self.in_turn(world, again, motions.len())];
                GroundOfWorld {
                    motion: one.motion.clone(),
                    vertical: one.vertical.clone(),
                    record: Some(one.name.clone()),
                }
            }
            Source::Synthetic(synthetic, matcher) => {
                let make = || self.synthetic(synthetic, matcher, world, again);
                let (motion, vertical) = match &self.on_disk {
                    Some(folder) => folder.motion((world, again), make)?,
                    None => make()?,
                };
                GroundOfWorld {
                    motion,
                    vertical,
                    record: None,
                }
            }
        };
        let made = Arc::new(made);
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() < MAX_KEPT {
            kept.insert(key, Arc::clone(&made));
        }
        Ok(Some(made))
    }

    /// In how many of these worlds the ground motion is still to be made.
    pub(crate) fn grounds_to_make(&self, worlds: Range<u32>, again: u32) -> usize {
        if !matches!(self.source, Source::Synthetic(..)) {
            return 0;
        }
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        worlds
            .filter(|world| !kept.contains_key(&(*world, again)))
            .count()
    }

    /// The spectrum that the horizontal motions of a world deviate from, without their pulse \[g\].
    fn horizontal_sa_g(
        &self,
        ground: &SyntheticGround,
        pulse: Option<&WorldPulse>,
        period_s: f64,
    ) -> f64 {
        let sa_g = ground.target.spectrum.sa_g(period_s);
        let pulses = self.pulses.as_ref();
        pulses.map_or(sa_g, |pulses| pulses.under_sa_g(pulse, period_s, sa_g))
    }

    /// The pulse of a world with its amplitude \[m/s\] at the intensity of the study, if it has one.
    ///
    /// # Errors
    /// A spectrum that cannot be calculated.
    pub fn pulse(&self, world: u32) -> Result<Option<(WorldPulse, f64)>, Problems> {
        let Source::Synthetic(ground, _) = &self.source else {
            return Ok(None);
        };
        let spectra = self.spread.spectra(ground.seed, world, 0);
        self.pulse_under(ground, &spectra, (world, 0))
    }

    fn pulse_under(
        &self,
        ground: &SyntheticGround,
        spectra: &WorldSpectra,
        (world, again): (u32, u32),
    ) -> Result<Option<(WorldPulse, f64)>, Problems> {
        let pulses = self.pulses.as_ref();
        let Some(pulse) = pulses.and_then(|pulses| pulses.draw(ground.seed, world, again)) else {
            return Ok(None);
        };
        let WorldSettings {
            components,
            component_ratio,
            ..
        } = self.study.assessment.worlds;
        // The spectrum under the pulse: the geometric mean of the components.
        let under = |t: f64| {
            let sa_g = self.horizontal_sa_g(ground, Some(&pulse), t);
            let x = spectra.x.sa_g(t, sa_g);
            match components {
                1 => x,
                _ => (x * spectra.y.sa_g(t, component_ratio * sa_g)).sqrt(),
            }
        };
        let amplitude_m_s = pulse.amplitude_m_s(under);
        let amplitude_m_s = amplitude_m_s.map_err(failed("a velocity pulse"))?;
        Ok(Some((pulse, amplitude_m_s)))
    }

    /// The horizontal motion, and the vertical one with random numbers of its own.
    fn synthetic(
        &self,
        ground: &SyntheticGround,
        matcher: &QuickMatcher,
        world: u32,
        again: u32,
    ) -> Result<(HorizontalMotion, Option<Motion>), Problems> {
        let spectra = self.spread.spectra(ground.seed, world, again);
        let WorldSettings {
            components,
            component_ratio,
            ..
        } = self.study.assessment.worlds;
        let pulse = self.pulse_under(ground, &spectra, (world, again))?;
        let horizontal = |t: f64| {
            let pulse = pulse.as_ref().map(|(pulse, _)| pulse);
            self.horizontal_sa_g(ground, pulse, t)
        };
        let component = |component| {
            let target = |t: f64| match component {
                Component::X => horizontal(t),
                Component::Y => component_ratio * horizontal(t),
                Component::Vertical => ground.vertical.sa_g(&ground.target, t).unwrap_or(f64::NAN),
            };
            let draw = WorldDraw {
                seed: ground.seed,
                world,
                repetition: again,
            };
            let made = world_motion(target, &spectra, component, draw, matcher)
                .map_err(failed("a motion"))?;
            let Some((pulse, amplitude_m_s)) = pulse.filter(|_| component != Component::Vertical)
            else {
                return Ok(made);
            };
            let amplitude_m_s = amplitude_m_s * pulse.part(component);
            with_pulse(&made, &pulse.shape, amplitude_m_s, matcher.options())
                .map_err(failed("a velocity pulse"))
        };
        let across = match components {
            1 => None,
            _ => Some(component(Component::Y)?),
        };
        let is_vertical = ground.vertical != VerticalTarget::None;
        let vertical = is_vertical
            .then(|| component(Component::Vertical))
            .transpose()?;
        Ok((
            HorizontalMotion {
                along: component(Component::X)?,
                across,
            },
            vertical,
        ))
    }

    fn scaled(&self, motion: HorizontalMotion) -> Result<HorizontalMotion, Problems> {
        if self.intensity_ratio == 1.0 {
            return Ok(motion);
        }
        let scaled = |motion: Motion| {
            motion
                .scaled(self.intensity_ratio)
                .map_err(failed("a motion"))
        };
        Ok(HorizontalMotion {
            along: scaled(motion.along)?,
            across: motion.across.map(scaled).transpose()?,
        })
    }

    fn building_draw(&self, world: u32, again: Again) -> BuildingDraw {
        self.building
            .draw(self.study.assessment.seed, world, again.building)
    }

    /// The building of a world; `None` where the motions of floors are given.
    pub fn building(&self, world: u32) -> Result<Option<BuildingOfWorld>, Problems> {
        let Some(building) = &self.study.building else {
            return Ok(None);
        };
        let along = drawn(&building.along, self.building_draw(world, Again::default()))?;
        Ok(Some(BuildingOfWorld {
            period_s: along.period_s(),
            damping_ratio: along.damping_ratio(),
        }))
    }

    /// The motions of some floors in these worlds, `[floor][world]`, on the current thread pool. The
    /// building of a world moves once for all its floors, and worlds with the same motion and the
    /// same building are one.
    pub fn floors(
        &self,
        worlds: Range<u32>,
        levels_ratio: &[f64],
        again: Again,
        building: Option<BuildingDraw>,
        go_on: impl Fn() -> Result<(), Problems> + Sync,
    ) -> Result<Vec<Vec<Arc<FloorOfWorld>>>, Problems> {
        let in_turn = match &self.source {
            Source::InTurn(motions) if self.building_is_known() || building.is_some() => {
                Some(motions.len())
            }
            Source::OnFloors { names } => Some(names.len()),
            Source::InTurn(_) | Source::Synthetic(..) => None,
        };
        let shaking = |world: u32| match in_turn {
            Some(motions) => self.in_turn(world, again.motion, motions) as u32,
            None => world,
        };
        let mut first: Vec<(u32, u32)> = worlds
            .clone()
            .map(|world| (shaking(world), world))
            .collect();
        first.sort_unstable();
        first.dedup_by_key(|(shaking, _)| *shaking);
        let floors = |&(shaking, world): &(u32, u32)| {
            go_on()?;
            Ok((
                shaking,
                self.remembered(world, levels_ratio, again, building)?,
            ))
        };
        let made: Vec<Result<_, Problems>> = first.par_iter().map(floors).collect();
        let made: HashMap<u32, Vec<Arc<FloorOfWorld>>> =
            made.into_iter().collect::<Result<_, _>>()?;
        let of_level = |level: usize| {
            let in_world = |world| {
                made.get(&shaking(world))
                    .and_then(|floors| floors.get(level))
                    .cloned()
            };
            worlds.clone().filter_map(in_world).collect()
        };
        Ok((0..levels_ratio.len()).map(of_level).collect())
    }

    /// The building whose periods and damping are this number of standard deviations from those of
    /// the study.
    pub fn building_at(&self, normal: f64) -> BuildingDraw {
        self.building.at(normal, normal)
    }

    /// The motion of a floor in one world.
    pub fn floor(&self, world: u32, level_ratio: f64) -> Result<Arc<FloorOfWorld>, Problems> {
        let mut floors = self.remembered(world, &[level_ratio], Again::default(), None)?;
        Ok(floors.swap_remove(0))
    }

    /// The motions of some floors in one world; with `building` in place of the building that is
    /// drawn.
    pub fn floors_of_world(
        &self,
        world: u32,
        levels_ratio: &[f64],
        again: Again,
        building: Option<BuildingDraw>,
    ) -> Result<Vec<FloorOfWorld>, Problems> {
        let (floors, _) = self.made(world, (levels_ratio, &[]), again, building)?;
        Ok(floors)
    }

    /// The motions of some floors in one world, and the peaks of others at the intensity of the study.
    fn made(
        &self,
        world: u32,
        (levels_ratio, peaks_at_ratio): (&[f64], &[f64]),
        again: Again,
        building: Option<BuildingDraw>,
    ) -> Result<(Vec<FloorOfWorld>, Vec<HorizontalPeaks>), Problems> {
        let nothing = || {
            Problem::new(
                ProblemKind::Computation,
                "the study has no motion for this floor",
            )
        };
        let Some(modes) = &self.study.building else {
            let given = |level_ratio: f64| -> Result<HorizontalMotion, Problems> {
                let given = self.given(level_ratio).ok_or_else(nothing)?;
                let motion = given.get(self.in_turn(world, again.motion, given.len()));
                Ok(motion.ok_or_else(nothing)?.as_used())
            };
            let floor = |&level_ratio: &f64| -> Result<FloorOfWorld, Problems> {
                Ok(FloorOfWorld::new(self.scaled(given(level_ratio)?)?, None))
            };
            let peaks =
                |&level_ratio: &f64| given(level_ratio).map(|motion| HorizontalPeaks::of(&motion));
            let floors: Result<Vec<_>, Problems> = levels_ratio.iter().map(floor).collect();
            let peaks: Result<Vec<_>, Problems> = peaks_at_ratio.iter().map(peaks).collect();
            return Ok((floors?, peaks?));
        };
        let ground = self.ground(world, again.motion)?.ok_or_else(nothing)?;
        let draw = building.unwrap_or_else(|| self.building_draw(world, again));
        let shaken = ShakenBuilding::new(&ground, modes, draw)?;
        let shake = |(motion, axis): &(Motion, Building)| {
            floor_motions_and_peaks(motion, axis, levels_ratio, peaks_at_ratio)
                .map_err(failed("a floor motion"))
        };
        let (along, peaks_along) = shake(&shaken.along)?;
        let across = shaken.across.as_ref().map(shake).transpose()?;
        let (mut across, mut peaks_across) = match across {
            Some((floors, peaks)) => (Some(floors.into_iter()), Some(peaks.into_iter())),
            None => (None, None),
        };
        let both = along.into_iter().map(|along| HorizontalMotion {
            along,
            across: across.as_mut().and_then(Iterator::next),
        });
        let peaks = peaks_along.into_iter().map(|along_m_s2| HorizontalPeaks {
            along_m_s2,
            across_m_s2: peaks_across.as_mut().and_then(Iterator::next),
        });
        let vertical = |level_ratio: f64| -> Result<Option<Motion>, Problems> {
            let Some(vertical) = &ground.vertical else {
                return Ok(None);
            };
            let amplification = if level_ratio == 0.0 {
                1.0
            } else {
                self.study.vertical_amplification_ratio
            };
            let padded = vertical.with_zero_tail(shaken.tail_s);
            let scaled =
                padded.and_then(|motion| motion.scaled(amplification * self.intensity_ratio));
            scaled
                .map(Some)
                .map_err(failed("the vertical motion of a floor"))
        };
        let floor = |(motion, &level_ratio): (HorizontalMotion, &f64)| {
            Ok(FloorOfWorld::new(
                self.scaled(motion)?,
                vertical(level_ratio)?,
            ))
        };
        let floors: Result<Vec<FloorOfWorld>, Problems> =
            both.zip(levels_ratio).map(floor).collect();
        Ok((floors?, peaks.collect()))
    }

    /// The motions that the study gives for a level.
    fn given(&self, level_ratio: f64) -> Option<&'a [RecordedMotion]> {
        let away = |level: &&Level| {
            level
                .level_ratio
                .map_or(f64::INFINITY, |ratio| (ratio - level_ratio).abs())
        };
        let nearest = self
            .study
            .levels
            .iter()
            .min_by(|a, b| away(a).total_cmp(&away(b)));
        let level = nearest.filter(|level| away(level) <= SAME_LEVEL)?;
        (!level.motions.is_empty()).then_some(&level.motions)
    }
}

fn drawn(building: &Building, draw: BuildingDraw) -> Result<Building, Problems> {
    let BuildingDraw {
        period_factor,
        damping_factor,
    } = draw;
    if (period_factor, damping_factor) == (1.0, 1.0) {
        return Ok(building.clone());
    }
    building
        .clone()
        .with_factors(period_factor, damping_factor)
        .map_err(failed("the building of a world"))
}

fn failed<E: std::fmt::Display>(what: &'static str) -> impl Fn(E) -> Problems {
    move |error| {
        Problem::new(
            ProblemKind::Computation,
            format!("{what} cannot be computed: {error}"),
        )
        .into()
    }
}

#[cfg(test)]
mod tests;
