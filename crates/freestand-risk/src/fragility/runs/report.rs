//! What runs tell, as documents, tables and text.

use freestand::fragility::resurrections;
use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, name_of, significant, some};
use freestand_output::answer;
use freestand_output::answer::Answer;
use freestand_output::facts::{Facts, table as of_rows};
use freestand_output::table::Table;

use std::sync::Arc;

use super::super::measure::{At, Measure};
use super::super::{FitMethod, FragilityReport};
use super::follow::Followed;
use super::levels::{Added, MOST_ADDED};
use super::request::DOUBTFUL_SCALE;
use super::shaking::FloorShaking;
use super::{METHODS, Method, ObjectRuns, StudyTold, follow};

/// Fragilities from runs.
#[derive(Debug)]
pub struct RunsReport {
    /// One for each measure, with the outcomes of its table.
    pub reports: Vec<FragilityReport>,
    /// The tables of outcomes, for each measure.
    pub outcomes: Vec<Table>,
    /// Warnings about the result.
    pub warnings: Vec<String>,
    pub(super) method: Method,
    pub(super) max_scale_ratio: f64,
    pub(super) scales: Option<Vec<f64>>,
    /// What was added to the intensities of stripes for a hazard.
    pub(super) added: Option<Added>,
    /// Rotation over α beyond which a tolerance is exceeded.
    pub rotation_ratio: Option<f64>,
    pub(super) fit: FitMethod,
    /// The objects with their runs.
    pub objects: Vec<ObjectRuns>,
    pub(super) floors: Vec<Vec<FloorShaking>>,
    pub(super) left_out: Vec<LeftOut>,
    pub(super) inputs: Vec<InputFile>,
    /// Seed of the bootstrap.
    pub(super) seed: u64,
    /// Whose building and hazard this is; `None`: the motions were given.
    pub(super) study: Option<Arc<StudyTold>>,
}

answer! {
    /// An object that was not run.
    pub struct LeftOut {
        id: String,
        /// The reason.
        why: String,
    }
}

/// How many objects that were left out are named.
const NAMED_LEFT_OUT: usize = 3;

impl RunsReport {
    pub(super) fn all_warnings(&self) -> Vec<String> {
        let mut warnings = self
            .study
            .as_ref()
            .map_or_else(Vec::new, |study| study.warnings.clone());
        if !self.left_out.is_empty() {
            let named: Vec<String> = self
                .left_out
                .iter()
                .map(|LeftOut { id, why }| format!("{} ({why})", shorten(id)))
                .collect();
            let named = some(&named, NAMED_LEFT_OUT);
            let objects = counted(self.left_out.len(), "object");
            let verb = if self.left_out.len() == 1 {
                "was"
            } else {
                "were"
            };
            warnings.push(format!("{objects} {verb} not run: {named}"));
        }
        if self.fit == FitMethod::TwoStage {
            let not: Vec<(&str, &str)> = self
                .objects
                .iter()
                .filter_map(|one| Some((&*one.id, one.shock_limits().err()?)))
                .collect();
            if let Some((id, why)) = not.first() {
                let verb = if not.len() == 1 { "is" } else { "are" };
                warnings.push(format!(
                    "{} {verb} fitted as ordered, not from shocks (for example {}, because {why})",
                    counted(not.len(), "object"),
                    shorten(id),
                ));
            }
        }
        let lacking = self
            .objects
            .iter()
            .filter(|one| one.nominal.lacks_shock())
            .count();
        if lacking > 0 {
            let (verb, them) = if lacking == 1 {
                ("has", "its shock is")
            } else {
                ("have", "their shocks are")
            };
            warnings.push(format!(
                "{} {verb} a tolerance, but no mass or no cushion: {them} not known, so \"exceeds\" is not fitted; \
                 add the mass and the cushion",
                counted(lacking, "object")
            ));
        }
        let runs: usize = self
            .objects
            .iter()
            .flat_map(|one| &one.motions)
            .map(Vec::len)
            .sum();
        let marked: usize = self.objects.iter().map(ObjectRuns::marked).sum();
        if marked > 0 {
            warnings.push(format!(
                "{marked} of {} use a motion scaled by more than {DOUBTFUL_SCALE}: see the column scale of outcomes.csv",
                counted(runs, "run")
            ));
        }
        if let Some(ids) = self
            .added
            .as_ref()
            .map(|added| &added.open_ids)
            .filter(|ids| !ids.is_empty())
        {
            warnings.push(format!(
                "more than a tenth of a rate of {} is still between two intensities of the runs, or below or above \
                 all of them: at most {MOST_ADDED} are added, and none beyond the largest scale; such rates are only \
                 known between bounds",
                some(ids, 1)
            ));
        }
        // Some do not depend on the measure.
        let is_of_all = |text: &String| {
            self.reports
                .iter()
                .all(|report| report.warnings.contains(text))
        };
        for report in &self.reports {
            let name = report.table.measure.name();
            for text in &report.warnings {
                let text = if is_of_all(text) {
                    text.clone()
                } else {
                    format!("{name}: {text}")
                };
                if !warnings.contains(&text) {
                    warnings.push(text);
                }
            }
        }
        warnings
    }

    /// `left_out.csv`: the objects that were not run, and why; `None` where all were.
    ///
    /// # Errors
    /// None in practice: see [`of_rows`].
    pub fn left_out_table(&self) -> Result<Option<Table>, Problem> {
        if self.left_out.is_empty() {
            return Ok(None);
        }
        of_rows(self.left_out.iter().map(Answer::facts)).map(Some)
    }

    /// The sentence that says whose building this is, where no study was given.
    pub fn no_study(&self) -> Option<&String> {
        self.study.as_ref()?.no_study.as_ref()
    }

    /// The runs of each motion of an object, with their intensities by the first measure.
    pub fn intensities<'r>(
        &'r self,
        one: &'r ObjectRuns,
        measure: Measure,
        at: At,
    ) -> impl Iterator<Item = Vec<(f64, &'r Followed)>> {
        let shakings = self.floors.get(one.floor).map_or(&[][..], Vec::as_slice);
        shakings
            .iter()
            .zip(&one.motions)
            .filter_map(move |(shaking, runs)| {
                let unit = shaking.intensity(measure, 0, at, one.factors)?;
                let each = runs.iter().map(|run| (unit * run.scale_ratio, run));
                Some(each.collect())
            })
    }

    /// The report by the first measure, for other programs.
    pub fn first(&self) -> Option<&FragilityReport> {
        self.reports.first()
    }

    /// One line for each measure and limit state of the first object, for people.
    pub fn summary(&self) -> String {
        let runs: usize = self
            .objects
            .iter()
            .flat_map(|one| &one.motions)
            .map(Vec::len)
            .sum();
        let motions = self.floors.first().map_or(0, Vec::len);
        let mut text = String::new();
        if let Some(study) = &self.study {
            text.extend(
                study
                    .no_study
                    .iter()
                    .map(|sentence| format!("{sentence}\n\n")),
            );
            text.push_str(&format!("{}\n\n", study.place));
        }
        text.push_str(&format!(
            "{} of {} under {} ({})",
            counted(runs, "run"),
            counted(self.objects.len(), "object"),
            counted(motions, "motion"),
            name_of(METHODS, self.method)
        ));
        if let (Some(all), Some(added)) = (&self.scales, &self.added) {
            let given = counted(all.len() - added.count, "intensity");
            text.push_str(&format!(
                "; {given} to begin with, {} added for the hazard",
                added.count
            ));
        }
        let survived: usize = self
            .objects
            .iter()
            .flat_map(|one| &one.motions)
            .map(|runs| resurrections(&follow::classes(runs)))
            .sum();
        if survived > 0 {
            let plural = if survived == 1 {
                "run stays"
            } else {
                "runs stay"
            };
            text.push_str(&format!(
                "; {survived} {plural} upright above a scale that overturns the object"
            ));
        }
        text
    }

    /// The measures with their efficiency, practicality, proficiency, for people.
    pub fn measure_rows(&self) -> Vec<Facts<'static>> {
        let of_report = |report: &FragilityReport| -> Vec<Facts<'static>> {
            let name = report.table.measure.name();
            let rows = report.objects.iter().flat_map(|object| {
                object.qualities.iter().map(|quality| {
                    let p = |p: Option<f64>| p.map(|p| significant(p, 2));
                    Facts::default()
                        .key("id", object.id.clone())
                        .key("limit_state", quality.limit_state.name())
                        .key("im", name.clone())
                        .key("efficiency", quality.efficiency)
                        .key("practicality", quality.practicality)
                        .key("proficiency", quality.proficiency())
                        .key("p_mean_period", p(quality.p_mean_period))
                        .key("p_pgv_over_pga", p(quality.p_velocity_over_acceleration))
                })
            });
            rows.collect()
        };
        self.reports.iter().flat_map(of_report).collect()
    }
}
