//! What is told of runs.

use freestand::fragility::LimitState;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, name_of, significant, some};
use freestand_inventory::Inventory;
use freestand_output::answer::{Answer as _, Input};
use freestand_output::answer_of;
use freestand_output::facts::{Facts, table};
use freestand_output::table::Table;
use freestand_risk::fragility::{
    FloorShaking, FragilityReport, LeftOut, METHODS, MeasuredHazard, ObjectFragility, Quality,
    RunObjects, RunsDoubt, RunsReport,
};
use freestand_study::shape::Sizes;
use freestand_study::study::Study;

use super::answer::OfObject;
use super::curves::curves_text;
use super::doubts::{curve_doubts, hazard_doubt};
use crate::assessment::{JobReport, head, said};
use crate::doubts::{model_limit, unlikely_size};
use crate::table::{Column, facts_table};

/// How many objects that were left out are named.
const NAMED_LEFT_OUT: usize = 3;

const MEASURE_COLUMNS: [Column; 8] = [
    ("id", "object", 0),
    ("limit_state", "limit state", 0),
    ("im", "measure", 0),
    ("efficiency", "efficiency", 3),
    ("practicality", "practicality", 3),
    ("proficiency", "proficiency", 3),
    ("p_mean_period", "p mean period", 0),
    ("p_pgv_over_pga", "p PGV/PGA", 0),
];

/// Fragilities from runs, with the study and the list of a whole list.
pub struct RunsAnswer<'r> {
    runs: &'r RunsReport,
    of_study: Option<OfStudy<'r>>,
}

/// What is told of the study of runs, and of their list.
struct OfStudy<'r> {
    study: &'r Study,
    inventory: &'r Inventory,
    told: JobReport,
}

impl<'r> RunsAnswer<'r> {
    /// What is told of these runs.
    pub fn of(runs: &'r RunsReport) -> Self {
        let of_study = match &runs.request.objects {
            RunObjects::Given(_) => None,
            RunObjects::Listed {
                study, inventory, ..
            } => Some(OfStudy {
                study,
                inventory,
                told: said(study, &head::head(study, inventory)),
            }),
        };
        Self { runs, of_study }
    }

    /// The sentence that says whose building this is, where no study was given.
    pub fn no_study(&self) -> Option<&String> {
        self.of_study.as_ref()?.told.no_study.as_ref()
    }

    /// What to know beside the result.
    pub fn warnings(&self) -> Vec<String> {
        let of_study = self.of_study.as_ref();
        let mut warnings = of_study.map_or_else(Vec::new, |of| of.told.all_warnings());
        warnings.extend(self.runs.doubts().iter().map(doubt));
        let of_fits: Vec<(String, Vec<String>)> = self
            .runs
            .reports
            .iter()
            .map(|fits| (fits.table.measure.name(), curve_doubts(&fits.doubts())))
            .collect();
        // Some do not depend on the measure.
        let is_of_all = |text: &String| of_fits.iter().all(|(_, texts)| texts.contains(text));
        for (name, texts) in &of_fits {
            for text in texts {
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
        warnings.extend(self.runs.hazard_doubts().map(|doubt| hazard_doubt(&doubt)));
        if let RunObjects::Given(object) = &self.runs.request.objects {
            let sizes = Sizes::of(&object.block).doubts();
            warnings.extend(sizes.iter().map(unlikely_size));
            let body = object.body.iter();
            let doubts = body.flat_map(|(mass_kg, edge)| edge.stiffness_doubts(*mass_kg));
            warnings.extend(doubts.map(|doubt| model_limit(&doubt)));
        }
        warnings
    }

    /// Curves from runs, and how well each measure does, for people.
    pub fn text(&self) -> String {
        let mut text = format!("{}\n", self.summary());
        for fit in &self.runs.reports {
            text.push_str(&format!("\n{}", curves_text(fit)));
        }
        let measures = facts_table(self.measure_rows(), &MEASURE_COLUMNS);
        text.push_str(&format!("\n{measures}"));
        text
    }

    /// Whose building it is, and how many runs there are.
    fn summary(&self) -> String {
        let runs = self.runs;
        let mut text = String::new();
        if let Some(of) = &self.of_study {
            let no_study = of.told.no_study.iter();
            text.extend(no_study.map(|sentence| format!("{sentence}\n\n")));
            text.push_str(&format!("{}\n\n", of.told.place));
        }
        text.push_str(&format!(
            "{} of {} under {} ({})",
            counted(runs.runs(), "run"),
            counted(runs.objects.len(), "object"),
            counted(runs.floors.first().map_or(0, Vec::len), "motion"),
            name_of(METHODS, runs.request.method)
        ));
        if let (Some(given), Some(added)) = (runs.scales_given(), &runs.added) {
            text.push_str(&format!(
                "; {} to begin with, {} added for the hazard",
                counted(given, "intensity"),
                added.count
            ));
        }
        let survived = runs.survived();
        if survived > 0 {
            let stay = if survived == 1 {
                "run stays"
            } else {
                "runs stay"
            };
            text.push_str(&format!(
                "; {survived} {stay} upright above a scale that overturns the object"
            ));
        }
        text
    }

    /// The measures with their efficiency, practicality, proficiency, for people.
    fn measure_rows(&self) -> Vec<Facts<'static>> {
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
        self.runs.reports.iter().flat_map(of_report).collect()
    }

    /// For each object and limit state the measures, the most proficient one first.
    fn ranking(&self) -> Vec<Ranked<'_>> {
        let first = self.runs.first();
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
        let measures = self.runs.reports.iter().filter_map(|report| {
            let mut qualities = report.objects.get(object)?.qualities.iter();
            let quality = qualities.find(|quality| quality.limit_state == state)?;
            Some(OfMeasure { report, quality })
        });
        let mut measures: Vec<OfMeasure> = measures.collect();
        let value = |of: &OfMeasure| of.quality.proficiency().unwrap_or(f64::INFINITY);
        measures.sort_by(|a, b| value(a).total_cmp(&value(b)));
        measures
    }

    fn of_study<T>(&self, value: impl FnOnce(&OfStudy<'r>) -> T) -> Option<T> {
        self.of_study.as_ref().map(value)
    }
}

/// What to know of runs, in a sentence.
fn doubt(doubt: &RunsDoubt) -> String {
    match doubt {
        RunsDoubt::LeftOut(objects) => {
            let named: Vec<String> = objects
                .iter()
                .map(|LeftOut { id, why }| format!("{} ({why})", shorten(id)))
                .collect();
            let verb = if objects.len() == 1 { "was" } else { "were" };
            format!(
                "{} {verb} not run: {}",
                counted(objects.len(), "object"),
                some(&named, NAMED_LEFT_OUT)
            )
        }
        RunsDoubt::NotByShock { id, why, objects } => {
            let verb = if *objects == 1 { "is" } else { "are" };
            format!(
                "{} {verb} fitted as ordered, not from shocks (for example {}, because {why})",
                counted(*objects, "object"),
                shorten(id),
            )
        }
        RunsDoubt::LacksShock(objects) => {
            let (verb, them) = if *objects == 1 {
                ("has", "its shock is")
            } else {
                ("have", "their shocks are")
            };
            format!(
                "{} {verb} a tolerance, but no mass or no cushion: {them} not known, so \"exceeds\" is not fitted; \
                 add the mass and the cushion",
                counted(*objects, "object")
            )
        }
        RunsDoubt::ScaledFar {
            scale_ratio,
            scaled,
            runs,
        } => {
            let uses = if *scaled == 1 { "uses" } else { "use" };
            format!(
                "{scaled} of {} {uses} a motion scaled by more than {scale_ratio}: see the column scale of outcomes.csv",
                counted(*runs, "run")
            )
        }
        RunsDoubt::StillOpen { ids, most_added } => format!(
            "more than a tenth of a rate of {} is still between two intensities of the runs, or below or above \
             all of them: at most {most_added} are added, and none beyond the largest scale; such rates are only \
             known between bounds",
            some(ids, 1)
        ),
    }
}

/// `left_out.csv`: the objects that were not run, and why; `None` where all were.
///
/// # Errors
/// None in practice: see [`table`].
pub fn left_out_table(runs: &RunsReport) -> Result<Option<Table>, Problem> {
    if runs.left_out.is_empty() {
        return Ok(None);
    }
    table(runs.left_out.iter().map(|one| OfLeftOut(one).facts())).map(Some)
}

answer_of!(
    /// An object that was not run.
    struct OfLeftOut<'r>(&'r LeftOut) as object.0 {
        id: String;
        /// The reason.
        why: String = object.0.why.to_string();
    }
);

answer_of!(RunsAnswer<'_> as of.runs {
    version: &'static str = env!("CARGO_PKG_VERSION");
    /// Seed of the bootstrap.
    seed: u64 = of.runs.request.seed;
    /// How the runs were chosen.
    method: &'static str = name_of(METHODS, of.runs.request.method);
    /// Largest factor on a motion.
    max_scale: f64 = of.runs.request.max_scale_ratio;
    /// Factors on the motions, or intensities by the first measure; none of an adaptive analysis.
    scales: Option<Vec<f64>> = of.runs.request.scales.clone();
    /// How many of them were given, or chosen at the beginning.
    scales_given: Option<usize> = of.runs.scales_given();
    /// How many were added for the hazard.
    scales_added: Option<usize> = of.runs.added.as_ref().map(|added| added.count);
    hazard_curve: Option<&MeasuredHazard> = of.runs.added.as_ref().map(|added| &added.hazard);
    /// Rotation over α beyond which a tolerance is exceeded.
    tolerance_rotation_ratio: Option<f64> = of.runs.request.rotation_ratio;
    /// The files that were read.
    inputs: Vec<Input> = of.runs.inputs().map(Input::from).collect();
    /// The sentence that says whose building this is, where no study was given.
    no_study: Option<String> = of.no_study().cloned();
    /// What nobody stated.
    assumptions: Option<Vec<String>> = of.of_study(|of| head::silent(of.study, of.inventory));
    place_is_assumed: Option<bool> = of.of_study(|of| of.told.place_is_assumed);
    building_is_assumed: Option<bool> = of.of_study(|of| of.told.building_is_assumed);
    place_name: Option<String> = of.of_study(|of| of.told.place_name.clone()).flatten();
    building_name: Option<String> = of.of_study(|of| of.told.building_name.clone()).flatten();
    /// The hazard in words.
    hazard: Option<String> = of.of_study(|of| head::hazard(of.study)).flatten();
    /// The building in words.
    building: Option<String> = of.of_study(|of| head::building(of.study));
    /// The study as TOML.
    study: Option<String> = of.of_study(|of| of.study.toml.clone());
    motions: Vec<&FloorShaking> = of.runs.floors.iter().flatten().collect();
    left_out: Vec<OfLeftOut<'_>> = of.runs.left_out.iter().map(OfLeftOut).collect();
    objects: Vec<OfObject<'_>> = of.runs.reports.iter().flat_map(OfObject::all).collect();
    im_ranking: Vec<Ranked<'_>> = of.ranking();
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

#[cfg(test)]
mod tests {
    use freestand_assess::verdict::{NoShockLimits, NotFollowed};
    use strum::EnumCount;

    use freestand_assess::reason::Missing;

    use super::*;

    #[test]
    fn every_doubt_in_words() {
        let left_out = |id: &str, why| LeftOut {
            id: id.to_owned(),
            why,
        };
        let objects = [
            left_out("a", NotFollowed::Anchored),
            left_out("b", NotFollowed::NotGiven(vec![Missing::Height])),
            left_out(
                "c",
                NotFollowed::NotGiven(vec![Missing::Height, Missing::Thickness]),
            ),
            left_out("d", NotFollowed::NoSize),
            left_out("e", NotFollowed::NoSize),
        ];
        let whys = [
            NoShockLimits::NoTolerance,
            NoShockLimits::NotOfUplift,
            NoShockLimits::NoCeiling,
            NoShockLimits::NoBody,
            NoShockLimits::NotPeakAlone,
            NoShockLimits::LimitsRotation,
        ];
        let mut doubts = vec![
            RunsDoubt::LeftOut(objects[3..4].to_vec()),
            RunsDoubt::LeftOut(objects.to_vec()),
            RunsDoubt::LacksShock(1),
            RunsDoubt::LacksShock(2),
            RunsDoubt::ScaledFar {
                scale_ratio: 4.0,
                scaled: 1,
                runs: 40,
            },
            RunsDoubt::ScaledFar {
                scale_ratio: 4.0,
                scaled: 3,
                runs: 40,
            },
            RunsDoubt::StillOpen {
                ids: vec!["a".to_owned(), "b".to_owned()],
                most_added: 100,
            },
        ];
        doubts.extend((1..).zip(whys).map(|(objects, why)| RunsDoubt::NotByShock {
            id: "a".to_owned(),
            why,
            objects,
        }));
        // None is forgotten.
        let kinds: std::collections::HashSet<_> =
            doubts.iter().map(std::mem::discriminant).collect();
        assert_eq!(kinds.len(), RunsDoubt::COUNT);
        let told: Vec<String> = doubts.iter().map(doubt).collect();
        insta::assert_snapshot!(told.join("\n"));
    }
}
