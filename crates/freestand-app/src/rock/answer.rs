//! The response: what an object did under each motion, as a document, a table and a figure.

use freestand_input::problem::Problem;
use freestand_output::answer::{Answer as _, may_be_absent, object};
use freestand_output::facts::Facts;
use freestand_output::figure::{Figure, FigureError};
use freestand_output::rows::table_of_numbers;
use freestand_output::table::Table;
use freestand_report::figures::{
    rock_figure, slide_figure, spatial_figure, stack_figure, trace_figure,
};
use freestand_study::compliant::{CompliantReport, CompliantRequest, PadAnswer, rock_on_cushions};
use freestand_study::drawn::{DrawnHistory, drawn, drawn_on_pads};
use freestand_study::rock::{RockAnswer, RockReport, RockRequest, rock};
use freestand_study::sliding::{SlideAnswer, SlideReport, SlideRequest, slide};
use freestand_study::spatial::{
    SpatialAnswer, SpatialReport, StackAnswer, StackReport, rock_in_space, rock_stacked,
};
use freestand_study::{compliant, rock, sliding, spatial};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::resolve::{Asked, Meant};

/// What an object did under a motion, by the solver that followed it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// On a rigid base.
    Rigid(Box<RockAnswer>),
    /// Sliding or rolling.
    Slides(Box<SlideAnswer>),
    /// On its cushions, in a plane.
    OnPads(Box<PadAnswer>),
    /// On its cushions, in three dimensions or at a wall.
    InSpace(Box<SpatialAnswer>),
    /// A stack of two.
    Stack(Box<StackAnswer>),
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
        let motions: Vec<Value> = kinds
            .iter()
            .map(|kind| {
                let mut properties =
                    Map::from_iter([("motion".to_owned(), json!({"type": "string"}))]);
                properties.extend(kind.clone());
                object(properties)
            })
            .collect();
        let results = json!({"type": "array", "items": {"anyOf": motions}});
        kinds.push(Map::from_iter([("results".to_owned(), results)]));
        for kind in &mut kinds {
            kind.insert("plots".to_owned(), may_be_absent(strings.clone()));
            kind.insert("processing".to_owned(), strings.clone());
        }
        kinds.into_iter().map(object).collect()
    }

    /// Results, each with the name of its motion.
    pub fn of(mut answers: Vec<(String, Answer)>) -> Self {
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
    OnPads(CompliantRequest, CompliantReport),
    InSpace(SpatialReport),
    Stack(StackReport),
}

impl Meant {
    /// The number of motions, and 1 without a motion.
    pub fn count(&self) -> usize {
        self.motions.horizontal.len().max(1)
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
        let across = self.motions.across.clone();
        let asked = self.asked.under(motion, across, upward, is_sampled);
        let done = match asked {
            Asked::Rigid(request) => {
                let report = rock(&request)?;
                Done::Rigid(request, report)
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
        };
        Ok(Followed { name, done })
    }
}

impl Followed {
    /// What the object did.
    pub fn answer(&self) -> Answer {
        match &self.done {
            Done::Rigid(_, report) => Answer::Rigid(Box::new(report.answer.clone())),
            Done::Slides(_, report) => Answer::Slides(Box::new(report.answer.clone())),
            Done::OnPads(_, report) => Answer::OnPads(Box::new(report.answer.clone())),
            Done::InSpace(report) => Answer::InSpace(Box::new(report.answer.clone())),
            Done::Stack(report) => Answer::Stack(Box::new(report.answer.clone())),
        }
    }

    /// Warnings about the validity of the result.
    pub fn warnings(&self) -> &[String] {
        match &self.done {
            Done::Rigid(_, report) => &report.warnings,
            Done::Slides(_, report) => &report.warnings,
            Done::OnPads(_, report) => &report.warnings,
            Done::InSpace(report) => &report.warnings,
            Done::Stack(report) => &report.warnings,
        }
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
            Done::OnPads(_, report) if report.history.rocking.touches.is_empty() => ("trace", None),
            Done::OnPads(_, report) => ("trace", Some(trace_figure(report)?)),
            Done::InSpace(report) => ("spatial", spatial_figure(name, report)?),
            Done::Stack(report) => ("stack", stack_figure(name, report)?),
        };
        Ok(figure.map(|figure| (file, figure)))
    }

    /// Its history for a film, of an object in one plane that rocks.
    pub fn drawn(&self) -> Option<DrawnHistory> {
        match &self.done {
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
            Done::Slides(..) | Done::InSpace(_) | Done::Stack(_) => None,
        }
    }
}

impl Answer {
    /// The values of every kind of answer, each with its schema.
    pub fn kinds() -> [Map<String, Value>; 5] {
        [
            RockAnswer::properties(),
            SlideAnswer::properties(),
            PadAnswer::properties(),
            SpatialAnswer::properties(),
            StackAnswer::properties(),
        ]
    }

    /// Its values with their labels.
    pub fn facts(&self) -> Facts<'static> {
        match self {
            Self::Rigid(answer) => answer.facts(),
            Self::Slides(answer) => answer.facts(),
            Self::OnPads(answer) => answer.facts(),
            Self::InSpace(answer) => answer.facts(),
            Self::Stack(answer) => answer.facts(),
        }
    }
}
