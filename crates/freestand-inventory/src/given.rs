//! One object whose values are known: no list is read, and everything else is as for a row of a list.

use std::sync::Arc;

use freestand_input::quantity::Dimension;
use freestand_study::hull::BodyInPose;

use super::Casters;
use super::columns::Column;
use super::headings::dimension;
use super::problems::RowFindings;
use super::vocabulary::is_missing;

/// A value as it is.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A quantity in SI.
    Number(f64),
    /// The ends of a range, in SI.
    Range(f64, f64),
    /// The name of a floor, or of an entry of a library.
    Text(String),
    /// Its casters.
    Casters(Casters),
    /// Its base is round.
    Round,
    /// It is a body of this shape.
    Body(Arc<BodyInPose>),
}

impl Value {
    /// As a message shows it.
    pub(super) fn shown(&self, column: Column) -> String {
        let unit = match dimension(column) {
            Some(Dimension::Length) => " m",
            Some(Dimension::Mass) => " kg",
            Some(Dimension::Stiffness) => " N/m",
            Some(Dimension::Acceleration) => " m/s2",
            Some(Dimension::Time) => " s",
            _ => "",
        };
        match self {
            Self::Number(value) => format!("{value}{unit}"),
            Self::Range(low, high) => format!("{low} to {high}"),
            Self::Text(text) => text.clone(),
            Self::Casters(casters) => casters.name().to_owned(),
            Self::Round => "cylinder".to_owned(),
            Self::Body(body) => body.kind.name().to_owned(),
        }
    }
}

/// The values of an object.
pub(super) struct Given<'a> {
    pub values: &'a [(Column, Value)],
    pub told: RowFindings<'a>,
}

impl<'a> Given<'a> {
    pub(super) fn get(&self, column: Column) -> Option<&'a Value> {
        let found = self.values.iter().find(|(other, _)| *other == column);
        found.map(|(_, value)| value)
    }

    pub(super) fn number(&self, column: Column) -> Option<f64> {
        match self.get(column)? {
            Value::Number(value) => Some(*value),
            _ => None,
        }
    }

    pub(super) fn range(&self, column: Column) -> Option<(f64, f64)> {
        match self.get(column)? {
            Value::Range(low, high) => Some((*low, *high)),
            _ => None,
        }
    }

    /// A name as a person gave it; empty where it is a word for a missing value.
    pub(super) fn text(&self, column: Column) -> String {
        match self.get(column) {
            Some(Value::Text(text)) if !is_missing(text) => text.trim().to_owned(),
            _ => String::new(),
        }
    }

    pub(super) fn casters(&self, column: Column) -> Option<Casters> {
        match self.get(column)? {
            Value::Casters(casters) => Some(*casters),
            _ => None,
        }
    }

    pub(super) fn is_round(&self) -> bool {
        self.get(Column::Shape) == Some(&Value::Round)
    }

    pub(super) fn body(&self) -> Option<&Arc<BodyInPose>> {
        match self.get(Column::Shape)? {
            Value::Body(body) => Some(body),
            _ => None,
        }
    }
}
