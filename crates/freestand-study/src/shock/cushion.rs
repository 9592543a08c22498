//! What an edge, or a side, lands on: one stiffness from all the ways to state it, or a measured drop.

use freestand::impact::series_stiffness_n_m;

use super::{ShockRequest, problem};
use crate::error::Problem;
use crate::quantity::{Dimension, format_si};

/// What the edge lands on.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cushion {
    Stiffness { value_n_m: f64, notes: Vec<String> },
    Measured(f64),
}

pub(super) fn cushion(request: &ShockRequest, problems: &mut Vec<Problem>) -> Option<Cushion> {
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
        return Some(in_series(value_n_m, &request.series_stiffness_n_m, Vec::new()));
    }
    if request.contact_stiffness_n_m.is_some() {
        problems.push(problem(
            "--contact-stiffness belongs to the scenarios overturn-floor and overturn-obstacle",
            "give the stiffness of the cushion under one edge as --stiffness",
        ));
    }
    let given = [request.stiffness_n_m, request.pad_stiffness_n_m, request.drop_acceleration_m_s2];
    if given.iter().flatten().count() != 1 {
        let several = given.iter().flatten().count() > 1;
        let message = if several {
            "--stiffness, --pad-stiffness and --drop-acceleration exclude each other"
        } else {
            "the stiffness of the cushion is missing"
        };
        problems.push(problem(
            message,
            "give one of --stiffness (all the cushion under one edge), --pad-stiffness with --pads-per-edge, or a measured --drop-acceleration",
        ));
        return None;
    }
    if request.pads_per_edge.is_some() && request.pad_stiffness_n_m.is_none() {
        problems.push(problem(
            "--pads-per-edge goes with --pad-stiffness",
            "--stiffness is already that of all the pads under one edge",
        ));
    }
    if let Some(measured) = request.drop_acceleration_m_s2 {
        if !request.series_stiffness_n_m.is_empty() {
            problems.push(problem(
                "--series-stiffness needs a stiffness that it acts in series with",
                "a measured drop acceleration already contains everything that was under the mass",
            ));
        }
        return Some(Cushion::Measured(measured));
    }
    let mut notes = Vec::new();
    let edge_n_m = match (request.stiffness_n_m, request.pad_stiffness_n_m, request.pads_per_edge) {
        (Some(edge), ..) => edge,
        (None, Some(pad), Some(pads)) if pads > 0 => {
            let edge = pad * f64::from(pads);
            let (pad, total) = (format_si(pad, Dimension::Stiffness), format_si(edge, Dimension::Stiffness));
            let plural = if pads == 1 { "pad" } else { "pads" };
            notes.push(format!("{pads} {plural} of {pad} → edge {total}"));
            edge
        }
        _ => {
            problems.push(problem(
                "--pad-stiffness needs --pads-per-edge, at least 1",
                "how many pads share the landing of one edge? A cabinet on four feet has 2",
            ));
            return None;
        }
    };
    Some(in_series(edge_n_m, &request.series_stiffness_n_m, notes))
}

fn in_series(first_n_m: f64, others_n_m: &[f64], mut notes: Vec<String>) -> Cushion {
    if others_n_m.is_empty() {
        return Cushion::Stiffness { value_n_m: first_n_m, notes };
    }
    let all: Vec<f64> = std::iter::once(first_n_m).chain(others_n_m.iter().copied()).collect();
    let value_n_m = series_stiffness_n_m(&all);
    let parts: Vec<String> = all.iter().map(|&k| format_si(k, Dimension::Stiffness)).collect();
    notes.push(format!("{} in series → {}", parts.join(" and "), format_si(value_n_m, Dimension::Stiffness)));
    Cushion::Stiffness { value_n_m, notes }
}
