//! The list of columns, and how their cells follow from an assessment.

mod response;
mod verdict;

use std::sync::LazyLock;

use freestand_assess::result::{
    Answers, Assessment, Cause, InSpace, ModelAnswers, Probability, Ranked, RestraintForce, Rolled,
    Stacked, design_force,
};
use freestand_inventory::{Item, Rating};

use super::{Cell, Column, Kind, Line};

/// Every column of freestand, in order; other columns of the inventory follow.
pub(crate) static COLUMNS: LazyLock<Vec<Column>> =
    LazyLock::new(|| [verdict::COLUMNS, response::COLUMNS].concat());

/// The reason in a row without a decision.
const NOT_ASSESSED: &str =
    "Not assessed yet: the run was stopped before its end, and this result is partial.";

fn of_count<'a>(line: &Line<'a>, get: impl Fn(&Answers) -> Option<u32>) -> Cell<'a> {
    Cell::count(
        line.assessment()
            .and_then(|found| get(found.answers.as_ref()?))
            .map(|count| count as usize),
    )
}

fn rigid<'a>(
    line: &Line<'a>,
    of: fn(&ModelAnswers) -> Option<Probability>,
    end: fn(&Probability) -> f64,
) -> Cell<'a> {
    chance(
        line,
        |found| of(found.answers.as_ref()?.rigid.as_ref()?),
        end,
    )
}

fn pads<'a>(
    line: &Line<'a>,
    of: fn(&ModelAnswers) -> Option<Probability>,
    end: fn(&Probability) -> f64,
) -> Cell<'a> {
    chance(
        line,
        |found| of(found.answers.as_ref()?.compliant.as_ref()?),
        end,
    )
}

fn depends<'a>(line: &Line<'a>, cause: Cause) -> Cell<'a> {
    of(line, |found| {
        found
            .shares
            .as_ref()?
            .by_group
            .iter()
            .find(|(one, _)| *one == cause)?
            .1
    })
}

type Extract = for<'a> fn(&Line<'a>) -> Cell<'a>;

const fn text(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Text,
        unit: "–",
        meaning,
        cell,
    }
}

const fn count(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Count,
        unit: "–",
        meaning,
        cell,
    }
}

const fn number(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    cell: Extract,
) -> Column {
    Column {
        name,
        kind: Kind::Number,
        unit,
        meaning,
        cell,
    }
}

const fn share(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Share,
        unit: "1",
        meaning,
        cell,
    }
}

const fn ranked(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    cell: Extract,
) -> Column {
    Column {
        name,
        kind: Kind::Ranked,
        unit,
        meaning,
        cell,
    }
}

const fn flag(name: &'static str, meaning: &'static str, cell: Extract) -> Column {
    Column {
        name,
        kind: Kind::Flag,
        unit: "–",
        meaning,
        cell,
    }
}

fn yes<'a>(flag: Option<bool>) -> Cell<'a> {
    flag.map_or(Cell::Missing, Cell::Flag)
}

fn of_item<'a>(line: &Line<'a>, value: fn(&Item) -> Option<f64>) -> Cell<'a> {
    Cell::number(value(line.item))
}

fn of<'a>(line: &Line<'a>, value: impl Fn(&Assessment) -> Option<f64>) -> Cell<'a> {
    Cell::number(line.assessment().and_then(value))
}

fn of_text<'a>(line: &Line<'a>, text: for<'t> fn(&'t Assessment) -> Option<&'t str>) -> Cell<'a> {
    line.assessment()
        .and_then(text)
        .map_or(Cell::Missing, Cell::text)
}

fn chance<'a>(
    line: &Line<'a>,
    chance: impl Fn(&Assessment) -> Option<Probability>,
    value: fn(&Probability) -> f64,
) -> Cell<'a> {
    Cell::number(
        line.assessment()
            .and_then(chance)
            .map(|probability| value(&probability)),
    )
}

fn lift<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let response = line.assessment().and_then(|found| found.response.as_ref());
    Cell::ranked(
        response
            .and_then(|response| response.uplift_m.get(quantile))
            .copied(),
    )
}

fn space<'a>(line: &Line<'a>, of: fn(&InSpace) -> Ranked) -> Cell<'a> {
    Cell::ranked(
        line.assessment()
            .and_then(|found| found.in_space.as_ref().map(of)),
    )
}

fn slide<'a>(
    line: &Line<'a>,
    rolls: fn(&Rolled) -> f64,
    walks: fn(&InSpace) -> Ranked,
) -> Cell<'a> {
    let rolled = line
        .assessment()
        .and_then(|found| found.rolled.as_ref().map(rolls));
    rolled.map_or_else(
        || space(line, walks),
        |travel_m| Cell::number(Some(travel_m)),
    )
}

fn stacked<'a>(line: &Line<'a>, of: fn(&Stacked) -> u32) -> Cell<'a> {
    Cell::count(
        line.assessment()
            .and_then(|found| found.stacked.as_ref().map(of))
            .map(|count| count as usize),
    )
}

fn shock<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let shock = line.assessment().and_then(|found| found.shock.as_ref());
    Cell::ranked(
        shock
            .and_then(|shock| shock.edge_acceleration_g.get(quantile))
            .copied(),
    )
}

fn lifted<'a>(line: &Line<'a>, quantile: usize) -> Cell<'a> {
    let shock = line.assessment().and_then(|found| found.shock.as_ref());
    Cell::ranked(
        shock
            .and_then(|shock| shock.edge_acceleration_uplift_g.get(quantile))
            .copied(),
    )
}

fn rating<'a>(rating: Option<Rating>) -> Cell<'a> {
    rating.map_or(Cell::Missing, |rating| Cell::text(rating.name()))
}

/// A value of the force that counts for the object.
fn restraint<'a>(line: &Line<'a>, value: fn(&RestraintForce) -> f64) -> Cell<'a> {
    Cell::number(
        line.assessment()
            .and_then(|found| design_force(&found.restraint))
            .map(value),
    )
}
