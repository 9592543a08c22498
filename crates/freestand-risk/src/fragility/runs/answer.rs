//! What is told of runs.

use freestand::fragility::LimitState;
use freestand_input::words::name_of;
use freestand_output::answer::Input;
use freestand_output::answer_of;

use super::super::answer::OfObject;
use super::super::hazard::MeasuredHazard;
use super::super::quality::Quality;
use super::super::{FragilityReport, ObjectFragility};
use super::levels::Added;
use super::report::{LeftOut, RunsReport};
use super::shaking::FloorShaking;
use super::{METHODS, StudyTold};

impl RunsReport {
    /// The scales that were asked for, or chosen before a hazard asked for more.
    fn scales_given(&self) -> Option<usize> {
        let added = self.added.as_ref().map_or(0, |added| added.count);
        self.scales.as_ref().map(|all| all.len() - added)
    }

    /// For each object and limit state the measures, the most proficient one first.
    fn ranking(&self) -> Vec<Ranked<'_>> {
        let first = self.reports.first();
        let objects = first.map_or(&[][..], |report| report.objects.as_slice());
        let each = objects.iter().enumerate().flat_map(|(i, object)| {
            let states = object.fit.curves.iter().map(|curve| curve.limit_state);
            states.map(move |state| Ranked {
                object,
                state,
                measures: self.ranked(i, state),
            })
        });
        each.collect()
    }

    /// The measures of an object and a limit state, the most proficient one first.
    fn ranked(&self, object: usize, state: LimitState) -> Vec<OfMeasure<'_>> {
        let measures = self.reports.iter().filter_map(|report| {
            let mut qualities = report.objects.get(object)?.qualities.iter();
            let quality = qualities.find(|quality| quality.limit_state == state)?;
            Some(OfMeasure { report, quality })
        });
        let mut measures: Vec<OfMeasure> = measures.collect();
        let value = |of: &OfMeasure| of.quality.proficiency().unwrap_or(f64::INFINITY);
        measures.sort_by(|a, b| value(a).total_cmp(&value(b)));
        measures
    }

    fn of_study<T>(&self, value: impl FnOnce(&StudyTold) -> T) -> Option<T> {
        self.study.as_deref().map(value)
    }
}

answer_of!(RunsReport as runs {
    version: &'static str = env!("CARGO_PKG_VERSION");
    /// Seed of the bootstrap.
    seed: u64 = runs.seed;
    /// How the runs were chosen.
    method: &'static str = name_of(METHODS, runs.method);
    /// Largest factor on a motion.
    max_scale: f64 = runs.max_scale_ratio;
    /// Factors on the motions, or intensities by the first measure; none of an adaptive analysis.
    scales: Option<Vec<f64>> = runs.scales.clone();
    /// How many of them were given, or chosen at the beginning.
    scales_given: Option<usize> = runs.scales_given();
    /// How many were added for the hazard.
    scales_added: Option<usize> = runs.added.as_ref().map(|added| added.count);
    hazard_curve: Option<&MeasuredHazard> = runs.added.as_ref().map(|Added { hazard, .. }| hazard);
    /// Rotation over α beyond which a tolerance is exceeded.
    tolerance_rotation_ratio: Option<f64> = runs.rotation_ratio;
    /// The files that were read.
    inputs: Vec<Input> = runs.inputs.iter().map(Input::from).collect();
    /// The sentence that says whose building this is, where no study was given.
    no_study: Option<String> = runs.no_study().cloned();
    /// What nobody stated.
    assumptions: Option<Vec<String>> = runs.of_study(|study| study.assumed.clone());
    place_is_assumed: Option<bool> = runs.of_study(|study| study.place_is_assumed);
    building_is_assumed: Option<bool> = runs.of_study(|study| study.building_is_assumed);
    place_name: Option<String> = runs.study.as_ref().and_then(|study| study.place_name.clone());
    building_name: Option<String> = runs.study.as_ref().and_then(|study| study.building_name.clone());
    /// The hazard in words.
    hazard: Option<String> = runs.study.as_ref().and_then(|study| study.hazard.clone());
    /// The building in words.
    building: Option<String> = runs.of_study(|study| study.building.clone());
    /// The study as TOML.
    study: Option<String> = runs.of_study(|study| study.toml.clone());
    motions: Vec<&FloorShaking> = runs.floors.iter().flatten().collect();
    left_out: Vec<LeftOut> = runs.left_out.clone();
    objects: Vec<OfObject<'_>> = runs.reports.iter().flat_map(OfObject::all).collect();
    im_ranking: Vec<Ranked<'_>> = runs.ranking();
});

answer_of!(FloorShaking as motion {
    name: String = motion.name.clone();
    /// PGV over PGA of the floor.
    floor_velocity_over_acceleration_s: f64 = motion.at_floor.velocity_over_acceleration_s();
    floor_mean_period_s: Option<f64> = motion.at_floor.mean_period_s;
});

/// The measures of an object and a limit state.
#[derive(Clone)]
struct Ranked<'r> {
    object: &'r ObjectFragility,
    state: LimitState,
    measures: Vec<OfMeasure<'r>>,
}

answer_of!(Ranked<'_> as ranked {
    id: String = ranked.object.id.clone();
    limit_state: &'static str = ranked.state.name();
    /// The most proficient one first.
    measures: Vec<OfMeasure<'_>> = ranked.measures.clone();
});

/// The quality of a measure.
#[derive(Clone, Copy)]
struct OfMeasure<'r> {
    report: &'r FragilityReport,
    quality: &'r Quality,
}

answer_of!(OfMeasure<'_> as of {
    im: String = of.report.table.measure.name();
    at: &'static str = of.report.at.name();
    efficiency: Option<f64> = of.quality.efficiency;
    practicality: Option<f64> = of.quality.practicality;
    proficiency: Option<f64> = of.quality.proficiency();
});
