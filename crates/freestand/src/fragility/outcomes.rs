//! How runs ended, at which intensity and under which motion.

use strum::{EnumString, IntoStaticStr};
use thiserror::Error;

/// How a run ended. The classes exclude each other and are in the order of severity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, EnumString, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum OutcomeClass {
    /// No edge left the floor.
    NoUplift,
    /// The object rocked within its tolerance, or has none.
    Rocked,
    /// It rocked, and its tolerance was exceeded.
    Exceeded,
    /// It overturned.
    Overturned,
}

impl OutcomeClass {
    /// All classes, from harmless to severe.
    pub const ALL: [Self; 4] = [
        Self::NoUplift,
        Self::Rocked,
        Self::Exceeded,
        Self::Overturned,
    ];

    /// The name in inputs and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Its place among [`OutcomeClass::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}

/// An outcome of a class or of a more severe one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, EnumString, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum LimitState {
    /// It rocks, or worse.
    Rocks,
    /// Its tolerance is exceeded, or it overturns.
    Exceeds,
    /// It overturns.
    Overturns,
}

impl LimitState {
    /// All limit states, from harmless to severe.
    pub const ALL: [Self; 3] = [Self::Rocks, Self::Exceeds, Self::Overturns];

    /// The name in inputs and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The least severe class that reaches it.
    pub fn first_class(self) -> OutcomeClass {
        match self {
            Self::Rocks => OutcomeClass::Rocked,
            Self::Exceeds => OutcomeClass::Exceeded,
            Self::Overturns => OutcomeClass::Overturned,
        }
    }

    /// Whether a run of this class reached it.
    pub fn is_reached(self, class: OutcomeClass) -> bool {
        class >= self.first_class()
    }
}

/// One run of an object, or several runs with one outcome at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Number of its motion; `None` for counts, of which only the number of motions is known.
    pub motion: Option<usize>,
    /// Intensity measure.
    pub intensity: f64,
    /// How it ended.
    pub class: OutcomeClass,
    /// How many runs it counts for.
    pub weight: f64,
}

/// Why runs cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum OutcomesError {
    /// No runs at all.
    #[error("there are no runs")]
    Empty,
    /// A run with an intensity that has no logarithm.
    #[error("run {run}: the intensity must be positive and finite, not {intensity}")]
    Intensity {
        /// The run, counted from 1.
        run: usize,
        /// The intensity.
        intensity: f64,
    },
    /// A run with a weight that is no count.
    #[error("run {run}: the weight must be 0 or more and finite, not {weight}")]
    Weight {
        /// The run, counted from 1.
        run: usize,
        /// The weight.
        weight: f64,
    },
    /// Some runs have motions and some do not.
    #[error("run {run} has no motion although others have one")]
    Motion {
        /// The run, counted from 1.
        run: usize,
    },
}

/// How runs are spread over intensities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sampling {
    /// Several runs at one level, or counts: each level has a share.
    Shared,
    /// Every motion has levels of its own, and at least half of the motions have several: there is a
    /// distribution of capacities.
    Own,
    /// Most motions have one run, at an intensity of its own: neither levels nor capacities.
    Cloud,
}

/// A run at a numbered level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leveled {
    pub(super) level: usize,
    pub(super) motion: usize,
    pub(super) class: OutcomeClass,
    pub(super) weight: f64,
}

/// The runs of one object, sorted by intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcomes {
    /// Distinct intensities, rising.
    levels: Vec<f64>,
    runs: Vec<Leveled>,
    /// Number of motions; 0 for counts.
    motions: usize,
}

/// What was counted at one level, for each class.
pub(super) type Counts = [f64; 4];

impl Outcomes {
    /// The runs of one object under motions numbered from 0, or counts without motions.
    ///
    /// # Errors
    /// No runs, or an intensity that is not positive, a weight that is negative, a run without a
    /// motion among others with one.
    pub fn new(runs: &[Run]) -> Result<Self, OutcomesError> {
        let has_motions = runs.first().ok_or(OutcomesError::Empty)?.motion.is_some();
        for (
            i,
            &Run {
                motion,
                intensity,
                weight,
                ..
            },
        ) in runs.iter().enumerate()
        {
            let run = i + 1;
            if !(intensity > 0.0 && intensity.is_finite()) {
                return Err(OutcomesError::Intensity { run, intensity });
            }
            if !(weight >= 0.0 && weight.is_finite()) {
                return Err(OutcomesError::Weight { run, weight });
            }
            if motion.is_some() != has_motions {
                return Err(OutcomesError::Motion { run });
            }
        }
        let counted: Vec<&Run> = runs.iter().filter(|run| run.weight > 0.0).collect();
        let mut levels: Vec<f64> = counted.iter().map(|run| run.intensity).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        if levels.is_empty() {
            return Err(OutcomesError::Empty);
        }
        // Motions are numbered in their order, so that a number that is not used costs nothing.
        let mut motions: Vec<usize> = counted.iter().filter_map(|run| run.motion).collect();
        motions.sort_unstable();
        motions.dedup();
        let leveled = |run: &&Run| Leveled {
            level: levels.partition_point(|level| *level < run.intensity),
            motion: run
                .motion
                .map_or(0, |motion| motions.partition_point(|other| *other < motion)),
            class: run.class,
            weight: run.weight,
        };
        let runs = counted.iter().map(leveled).collect();
        Ok(Self {
            runs,
            motions: motions.len(),
            levels,
        })
    }

    /// Distinct intensities, rising.
    pub fn levels(&self) -> &[f64] {
        &self.levels
    }

    /// Number of motions; `None` for counts.
    pub fn motions(&self) -> Option<usize> {
        (self.motions > 0).then_some(self.motions)
    }

    /// How the runs are spread over intensities.
    pub fn sampling(&self) -> Sampling {
        if self.motions == 0 || self.runs.len() >= 2 * self.levels.len() {
            return Sampling::Shared;
        }
        let several = self.motions_with_levels();
        if 2 * several >= self.motions {
            Sampling::Own
        } else {
            Sampling::Cloud
        }
    }

    /// How many motions were run at more than one level.
    fn motions_with_levels(&self) -> usize {
        // The lowest and the highest level of each motion.
        let mut ends: Vec<Option<(usize, usize)>> = vec![None; self.motions];
        for run in &self.runs {
            if let Some(ends) = ends.get_mut(run.motion) {
                let (low, high) = ends.unwrap_or((run.level, run.level));
                *ends = Some((low.min(run.level), high.max(run.level)));
            }
        }
        ends.into_iter()
            .flatten()
            .filter(|(low, high)| low < high)
            .count()
    }

    /// Whether the lowest level at which a motion reached a limit state tells its capacity: every
    /// motion was run at several levels. A single run tells that the capacity is below its intensity
    /// or above it, and nothing more.
    pub fn tells_capacities(&self) -> bool {
        self.motions > 0 && self.motions_with_levels() == self.motions
    }

    /// Number of runs of each class, weighted.
    pub fn totals(&self) -> [f64; 4] {
        let mut totals = [0.0; 4];
        for run in &self.runs {
            totals[run.class.index()] += run.weight;
        }
        totals
    }

    /// The limit states that the runs can tell: `exceeds` only where a run exceeded a tolerance.
    pub fn limit_states(&self) -> Vec<LimitState> {
        let has_tolerance = self
            .runs
            .iter()
            .any(|run| run.class == OutcomeClass::Exceeded);
        LimitState::ALL
            .into_iter()
            .filter(|state| *state != LimitState::Exceeds || has_tolerance)
            .collect()
    }

    /// Counts at each level, with each motion counted this often; once without `times`.
    pub(super) fn counts(&self, times: Option<&[f64]>) -> Vec<Counts> {
        let mut counts = vec![[0.0; 4]; self.levels.len()];
        for run in &self.runs {
            counts[run.level][run.class.index()] +=
                run.weight * times.map_or(1.0, |times| times[run.motion]);
        }
        counts
    }

    /// How many runs reached a limit state at each level, of how many, weighted.
    pub(crate) fn shares(&self, state: LimitState) -> Vec<(f64, f64)> {
        let share = |counts: &Counts| {
            let reached = OutcomeClass::ALL
                .into_iter()
                .zip(counts)
                .filter(|(class, _)| state.is_reached(*class));
            (reached.map(|(_, count)| count).sum(), counts.iter().sum())
        };
        self.counts(None).iter().map(share).collect()
    }

    /// The runs that reached a limit state at the lowest level: the place of their motion among those
    /// with runs (`None` for counts), and their weight.
    pub(crate) fn reached_at_lowest(&self, state: LimitState) -> Vec<(Option<usize>, f64)> {
        let runs = self
            .runs
            .iter()
            .filter(|run| run.level == 0 && state.is_reached(run.class));
        runs.map(|run| ((self.motions > 0).then_some(run.motion), run.weight))
            .collect()
    }

    /// The same runs with other outcomes, `class(run, old)`.
    pub(super) fn with_classes(&self, mut class: impl FnMut(&Leveled) -> OutcomeClass) -> Self {
        let runs = self
            .runs
            .iter()
            .map(|run| Leveled {
                class: class(run),
                ..*run
            })
            .collect();
        Self {
            runs,
            levels: self.levels.clone(),
            motions: self.motions,
        }
    }

    /// The capacity of each motion: the lowest intensity at which it reached the limit state. `None`
    /// where it never did; empty for counts.
    ///
    /// Survival is not monotone in the intensity, so a motion may spare the object at a higher one.
    pub fn capacities(&self, state: LimitState) -> Vec<Option<f64>> {
        let mut lowest: Vec<Option<usize>> = vec![None; self.motions];
        if self.motions > 0 {
            for run in self.runs.iter().filter(|run| state.is_reached(run.class)) {
                let known = &mut lowest[run.motion];
                *known = Some(known.map_or(run.level, |level| level.min(run.level)));
            }
        }
        lowest
            .into_iter()
            .map(|level| level.and_then(|level| self.levels.get(level).copied()))
            .collect()
    }
}
