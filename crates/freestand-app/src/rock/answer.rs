//! The response: what an object did under each motion, as a document, a table and a figure.

use freestand_input::problem::Problem;
use freestand_output::answer::{Answer as _, may_be_absent, object};
use freestand_output::facts::Facts;
use freestand_output::figure::{Figure, FigureError};
use freestand_output::rows::table_of_numbers;
use freestand_output::table::Table;
use freestand_report::doubts::{Notes, history_doubt};
use freestand_report::figures::{
    hull_figure, plane_slide_figure, rock_figure, slide_figure, spatial_figure, stack_figure,
    trace_figure,
};
use freestand_study::compliant::{CompliantReport, CompliantRequest, PadAnswer, rock_on_cushions};
use freestand_study::drawn::{DrawnHistory, drawn, drawn_on_pads};
use freestand_study::drawn_body::drawn_of_hull;
use freestand_study::hull::{
    HullAnswer, HullReport, HullRequest, HullRun, HullSetting, rock_on_hull, spatial_point,
};
use freestand_study::rock::{RockAnswer, RockReport, RockRequest, rock};
use freestand_study::sliding::{
    PlaneSlideAnswer, PlaneSlideReport, SlideAnswer, SlideReport, SlideRequest, slide,
    slide_under_both,
};
use freestand_study::spatial::{
    SpatialAnswer, SpatialReport, StackAnswer, StackReport, rock_in_space, rock_stacked,
};
use freestand_study::{compliant, rock, sliding, spatial};
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

use super::resolve::{Asked, Meant};

/// What an object did under a motion, and what its reader must know.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// What it did.
    pub did: Did,
    /// What its reader must know, where its model has such notes.
    pub notes: Option<Notes>,
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.facts().serialize(serializer)
    }
}

/// What an object did under a motion, by the solver that followed it.
#[derive(Debug, Clone, PartialEq)]
pub enum Did {
    /// On a rigid base.
    Rigid(Box<RockAnswer>),
    /// Sliding or rolling.
    Slides(Box<SlideAnswer>),
    /// Sliding or rolling under both components.
    SlidesInPlane(Box<PlaneSlideAnswer>),
    /// On its cushions, in a plane.
    OnPads(Box<PadAnswer>),
    /// On its cushions, in three dimensions or at a wall.
    InSpace(Box<SpatialAnswer>),
    /// A stack of two.
    Stack(Box<StackAnswer>),
    /// A body on its hull, in three dimensions.
    Hull(Box<HullAnswer>),
}

/// What the object did: under one motion, or under each of several.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Results {
    /// Under one motion, or released.
    One(Answer),
    /// Under each of several.
    Each {
        /// One result for each motion.
        results: Vec<OfMotion>,
    },
    /// A body on its hull under each of several.
    Rows {
        /// The body, and how it is followed.
        #[serde(flatten)]
        set: Box<HullSetting>,
        /// What its reader must know.
        #[serde(flatten)]
        notes: Notes,
        /// What it did under each.
        rows: Vec<Row>,
    },
}

/// What a body on its hull did under a motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The motion.
    pub motion: String,
    /// What the body did.
    #[serde(flatten)]
    pub run: HullRun,
}

/// A result with the name of its motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OfMotion {
    /// The motion.
    pub motion: String,
    /// What the object did.
    #[serde(flatten)]
    pub answer: Answer,
}

impl Results {
    /// The values of a response, each with its schema: of one motion, then of several.
    pub fn kinds() -> Vec<Value> {
        let strings = json!({"type": "array", "items": {"type": "string"}});
        let mut kinds = Answer::kinds().to_vec();
        let of_motion = |kind: &Map<String, Value>| {
            let mut properties = Map::from_iter([("motion".to_owned(), json!({"type": "string"}))]);
            properties.extend(kind.clone());
            object(properties)
        };
        let motions: Vec<Value> = kinds[..kinds.len() - 1].iter().map(of_motion).collect();
        let results = json!({"type": "array", "items": {"anyOf": motions}});
        let rows = json!({"type": "array", "items": of_motion(&HullRun::properties())});
        kinds.push(Map::from_iter([("results".to_owned(), results)]));
        let mut of_several = HullSetting::properties();
        of_several.extend(Notes::properties());
        of_several.insert("rows".to_owned(), rows);
        kinds.push(of_several);
        for kind in &mut kinds {
            kind.insert("plots".to_owned(), may_be_absent(strings.clone()));
            kind.insert("processing".to_owned(), strings.clone());
        }
        kinds.into_iter().map(object).collect()
    }

    /// Results, each with the name of its motion.
    pub fn of(mut answers: Vec<(String, Answer)>) -> Self {
        if let [
            (
                _,
                Answer {
                    did: Did::Hull(first),
                    notes: Some(notes),
                },
            ),
            _,
            ..,
        ] = &answers[..]
        {
            let row = |(motion, answer): &(String, Answer)| match &answer.did {
                Did::Hull(answer) => Some(Row {
                    motion: motion.clone(),
                    run: answer.run.clone(),
                }),
                _ => None,
            };
            return Self::Rows {
                set: Box::new(first.set.clone()),
                notes: notes.clone(),
                rows: answers.iter().filter_map(row).collect(),
            };
        }
        match answers.pop() {
            Some((_, answer)) if answers.is_empty() => Self::One(answer),
            last => Self::Each {
                results: answers
                    .into_iter()
                    .chain(last)
                    .map(|(motion, answer)| OfMotion { motion, answer })
                    .collect(),
            },
        }
    }
}

/// An object that was followed under one motion.
#[derive(Debug)]
pub struct Followed {
    /// The motion, or what takes its place.
    pub name: String,
    done: Done,
}

/// What was asked, and what was found.
#[derive(Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one for each motion")]
enum Done {
    Rigid(RockRequest, RockReport),
    Slides(SlideRequest, SlideReport),
    SlidesInPlane(SlideRequest, PlaneSlideReport),
    OnPads(CompliantRequest, CompliantReport),
    InSpace(SpatialReport),
    Stack(StackReport),
    Hull(HullRequest, HullReport),
}

/// Motions under which an object is followed at once; more would need memory for their histories.
const AT_ONCE: usize = 32;

impl Meant {
    /// The number of motions, and 1 without a motion.
    pub fn count(&self) -> usize {
        self.motions.horizontal.len().max(1)
    }

    /// Follows the object under each motion in turn, several at once; the order is that of the motions.
    pub fn follow_each(
        &self,
        is_sampled: bool,
    ) -> impl Iterator<Item = Result<Followed, Problem>> + '_ {
        let count = self.count();
        (0..count).step_by(AT_ONCE).flat_map(move |first| {
            let some: Vec<_> = (first..count.min(first + AT_ONCE))
                .into_par_iter()
                .map(|index| self.follow(index, is_sampled))
                .collect();
            some
        })
    }

    /// Follows the object under the motion of this number.
    ///
    /// # Errors
    /// What a solver refuses.
    pub fn follow(&self, index: usize, is_sampled: bool) -> Result<Followed, Problem> {
        let (name, motion) = match self.motions.horizontal.get(index) {
            Some(one) => (one.name.clone(), Some(one.motion.clone())),
            None if !self.motions.vertical.is_empty() => ("vertical motion".to_owned(), None),
            None if matches!(self.asked, Asked::InSpace(_) | Asked::Stack(_)) => {
                ("no motion".to_owned(), None)
            }
            None => ("free rocking".to_owned(), None),
        };
        let upward = self.motions.vertical.first().map(|one| one.motion.clone());
        let of_its_file = self
            .motions
            .horizontal
            .get(index)
            .and_then(|one| one.across.clone());
        let across = of_its_file.or_else(|| self.motions.across.clone());
        let asked = self.asked.under(motion, across, upward, is_sampled);
        let done = match asked {
            Asked::Rigid(request) => {
                let report = rock(&request)?;
                Done::Rigid(request, report)
            }
            Asked::Slides(request) if request.moves_in_plane() => {
                let report = slide_under_both(&request)?;
                Done::SlidesInPlane(request, report)
            }
            Asked::Slides(request) => {
                let report = slide(&request)?;
                Done::Slides(request, report)
            }
            Asked::OnPads(request) => {
                let report = rock_on_cushions(&request)?;
                Done::OnPads(request, report)
            }
            Asked::InSpace(request) => Done::InSpace(rock_in_space(&request)?),
            Asked::Stack(request) => Done::Stack(rock_stacked(&request)?),
            Asked::Hull(request) => {
                let report = rock_on_hull(&request)?;
                Done::Hull(request, report)
            }
        };
        Ok(Followed { name, done })
    }
}

impl Followed {
    /// What the object did.
    pub fn answer(&self) -> Answer {
        let (did, notes) = match &self.done {
            Done::Rigid(_, report) => (
                Did::Rigid(report.answer.clone().into()),
                Some(&report.notes),
            ),
            Done::Slides(_, report) => (Did::Slides(report.answer.clone().into()), None),
            Done::SlidesInPlane(_, report) => {
                (Did::SlidesInPlane(report.answer.clone().into()), None)
            }
            Done::OnPads(request, report) => (
                Did::OnPads(report.answer.clone().into()),
                Some(&request.notes),
            ),
            Done::InSpace(report) => (
                Did::InSpace(report.answer.clone().into()),
                Some(&report.notes),
            ),
            Done::Stack(report) => (
                Did::Stack(report.answer.clone().into()),
                Some(&report.notes),
            ),
            Done::Hull(_, report) => (Did::Hull(report.answer.clone().into()), Some(&report.notes)),
        };
        Answer {
            did,
            notes: notes.map(|notes| Notes::of(notes)),
        }
    }

    /// Warnings about the validity of the result.
    pub fn warnings(&self) -> Vec<String> {
        let doubts = match &self.done {
            Done::Rigid(_, report) => &report.doubts,
            Done::Slides(_, report) => &report.doubts,
            Done::SlidesInPlane(_, report) => &report.doubts,
            Done::OnPads(_, report) => &report.doubts,
            Done::InSpace(report) => &report.doubts,
            Done::Stack(report) => &report.doubts,
            Done::Hull(_, report) => &report.doubts,
        };
        doubts.iter().map(history_doubt).collect()
    }

    /// The columns and the rows of its history; no rows if it was not sampled.
    pub fn samples(&self) -> (String, Vec<Vec<f64>>) {
        fn rows<P, R: Into<Vec<f64>>>(points: &[P], row: impl Fn(&P) -> R) -> Vec<Vec<f64>> {
            points.iter().map(|point| row(point).into()).collect()
        }
        let (head, rows) = match &self.done {
            Done::Rigid(request, report) => {
                let block = &request.object.plane.block;
                let row = |point: &_| rock::history_row(block, point);
                (rock::HISTORY, rows(&report.history.samples, row))
            }
            Done::Slides(_, report) => (
                sliding::HISTORY,
                rows(&report.history.samples, sliding::history_row),
            ),
            Done::SlidesInPlane(_, report) => (
                sliding::PLANE_HISTORY,
                rows(&report.history.samples, sliding::plane_history_row),
            ),
            Done::OnPads(_, report) => {
                let samples = &report.history.samples;
                let head = compliant::history_head(samples);
                return (head, rows(samples, compliant::history_row));
            }
            Done::InSpace(report) => (
                spatial::SPATIAL_HISTORY,
                rows(&report.history.samples, spatial::spatial_row),
            ),
            Done::Stack(report) => (
                spatial::STACK_HISTORY,
                rows(&report.history.samples, spatial::stack_row),
            ),
            Done::Hull(_, report) => (
                spatial::SPATIAL_HISTORY,
                rows(&report.history, |point| {
                    spatial::spatial_row(&spatial_point(point))
                }),
            ),
        };
        (head.to_owned(), rows)
    }

    /// Its history as a table.
    pub fn history(&self) -> Table {
        let (head, rows) = self.samples();
        table_of_numbers(&head, rows)
    }

    /// The figure of its history with the name of its file; `None` if there is nothing to draw.
    ///
    /// # Errors
    /// A figure that cannot be drawn.
    pub fn figure(&self) -> Result<Option<(&'static str, Figure)>, FigureError> {
        let name = &self.name;
        let (file, figure) = match &self.done {
            Done::Rigid(request, report) => {
                let block = &request.object.plane.block;
                ("history", rock_figure(name, block, report)?)
            }
            Done::Slides(request, report) => {
                let samples = &report.history.samples;
                (
                    "history",
                    slide_figure(name, &request.block, &request.surface, samples)?,
                )
            }
            Done::SlidesInPlane(request, report) => {
                let samples = &report.history.samples;
                (
                    "history",
                    plane_slide_figure(name, &request.block, &request.surface, samples)?,
                )
            }
            Done::OnPads(_, report) if report.history.rocking.touches.is_empty() => ("trace", None),
            Done::OnPads(_, report) => ("trace", Some(trace_figure(report)?)),
            Done::InSpace(report) => ("spatial", spatial_figure(name, report)?),
            Done::Stack(report) => ("stack", stack_figure(name, report)?),
            Done::Hull(request, report) => (
                "body",
                hull_figure(
                    name,
                    &request.body,
                    request.orientation_rad,
                    &report.history,
                )?,
            ),
        };
        Ok(figure.map(|figure| (file, figure)))
    }

    /// Its history for a film, of an object in one plane that rocks or of a body on its hull.
    ///
    /// # Errors
    /// As for its history, which is calculated again for a body on its hull: a film has more samples.
    pub fn drawn(&self) -> Result<Option<DrawnHistory>, Problem> {
        Ok(match &self.done {
            Done::Rigid(request, report) => Some(drawn(
                &request.object,
                &report.history,
                &report.landings,
                request.horizontal.as_ref(),
            )),
            Done::OnPads(request, report) => Some(drawn_on_pads(
                &request.object.planes.one.block,
                &report.history,
                request.horizontal.as_ref(),
            )),
            Done::Hull(request, _) => Some(drawn_of_hull(request)?),
            Done::Slides(..) | Done::SlidesInPlane(..) | Done::InSpace(_) | Done::Stack(_) => None,
        })
    }
}

impl Answer {
    /// The values of every kind of answer, each with its schema.
    pub fn kinds() -> [Map<String, Value>; 7] {
        let noted = |mut answer: Map<String, Value>| {
            answer.extend(Notes::properties());
            answer
        };
        [
            noted(RockAnswer::properties()),
            SlideAnswer::properties(),
            PlaneSlideAnswer::properties(),
            noted(PadAnswer::properties()),
            noted(SpatialAnswer::properties()),
            noted(StackAnswer::properties()),
            noted(HullAnswer::properties()),
        ]
    }

    /// Its values with their labels.
    pub fn facts(&self) -> Facts<'static> {
        let did = match &self.did {
            Did::Rigid(answer) => answer.facts(),
            Did::Slides(answer) => answer.facts(),
            Did::SlidesInPlane(answer) => answer.facts(),
            Did::OnPads(answer) => answer.facts(),
            Did::InSpace(answer) => answer.facts(),
            Did::Stack(answer) => answer.facts(),
            Did::Hull(answer) => answer.facts(),
        };
        did.and(self.notes.facts())
    }
}
