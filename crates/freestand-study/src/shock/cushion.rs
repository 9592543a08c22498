//! What an edge, or a side, lands on: a cushion from all the ways to describe it, or a measured drop.

use super::{ShockRequest, problem};
use crate::cushion::{CushionWords, EdgeCushion};
use freestand_input::problem::Problem;

/// What the edge lands on.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Contact {
    Cushion(EdgeCushion),
    Measured(f64),
}

pub(super) fn contact(request: &ShockRequest, problems: &mut Vec<Problem>) -> Option<Contact> {
    if request.scenario.overturns() {
        if request.drop_acceleration_m_s2.is_some() {
            problems.push(problem(
                "a drop acceleration belongs to the object's own cushion, on which it does not land when it falls over",
                "give the stiffness of its side on the floor or obstacle as --contact-stiffness",
            ));
            return None;
        }
        let Some(value_n_m) = request.contact_stiffness_n_m else {
            problems.push(problem(
                format!("the scenario {} needs --contact-stiffness", request.scenario.name()),
                "the stiffness of the object's side on what it hits, such as --contact-stiffness \"2000 N/mm\"",
            ));
            return None;
        };
        let mut side = CushionWords::spring(value_n_m);
        for (key, text) in request.cushion.entries().iter().filter(|(key, _)| *key == "series_stiffness") {
            side.set(key, text.clone());
        }
        return resolved(&side, request, problems);
    }
    if request.contact_stiffness_n_m.is_some() {
        problems.push(problem(
            "--contact-stiffness belongs to the scenarios overturn-floor and overturn-obstacle",
            "give the stiffness of the cushion under one edge as --stiffness",
        ));
    }
    let hint = "give one of --stiffness (all the cushion under one edge), --pad-stiffness with --pads-per-edge, a \
                --cushion file, or a measured --drop-acceleration";
    let says = |key: &str| request.cushion.get(key).is_some();
    let has_stiffness = says("stiffness") || says("pad_stiffness") || says("cushion") || says("compressions");
    match request.drop_acceleration_m_s2 {
        Some(_) if has_stiffness => {
            problems.push(problem("--stiffness, --pad-stiffness and --drop-acceleration exclude each other", hint));
            None
        }
        Some(_) if says("series_stiffness") => {
            problems.push(problem(
                "--series-stiffness needs a stiffness that it acts in series with",
                "a measured drop acceleration already contains everything that was under the mass",
            ));
            None
        }
        Some(measured) => Some(Contact::Measured(measured)),
        None if !has_stiffness && !says("law") => {
            problems.push(problem("the stiffness of the cushion is missing", hint));
            None
        }
        None => resolved(&request.cushion, request, problems),
    }
}

fn resolved(words: &CushionWords, request: &ShockRequest, problems: &mut Vec<Problem>) -> Option<Contact> {
    match words.resolve(Some(request.mass_kg)) {
        Ok(cushion) => Some(Contact::Cushion(cushion)),
        Err(wrong) => {
            problems.extend(wrong.into_iter().map(|(_, problem)| problem));
            None
        }
    }
}
