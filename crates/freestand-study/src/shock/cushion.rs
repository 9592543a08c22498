//! What an edge or a side lands on: a cushion, in any of its descriptions, or a measured drop.

use super::{SCENARIOS, ShockRequest};
use crate::cushion::{self, EdgeCushion};
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::name_of;

/// What the edge lands on.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Contact {
    Cushion(EdgeCushion),
    Measured(f64),
}

pub(super) fn contact(request: &ShockRequest, problems: &mut Problems) -> Option<Contact> {
    if request.scenario.overturns() {
        if request.drop_acceleration_m_s2.is_some() {
            problems.push(Problem::value(
                "a drop acceleration belongs to the object's own cushion, but an object that falls over does not \
                 land on it",
                "give `contact_stiffness`, the stiffness of its side on the floor or obstacle",
            ));
            return None;
        }
        let Some(value_n_m) = request.contact_stiffness_n_m else {
            problems.push(Problem::value(
                format!("the scenario {} needs `contact_stiffness`", name_of(SCENARIOS, request.scenario)),
                "give the stiffness of the object's side on what it hits, such as `contact_stiffness = \"2000 N/mm\"`",
            ));
            return None;
        };
        let side = cushion::linear(value_n_m, &request.cushion);
        return problems.keep(side).map(Contact::Cushion);
    }
    if request.contact_stiffness_n_m.is_some() {
        problems.push(Problem::value(
            "`contact_stiffness` belongs to the scenarios overturn-floor and overturn-obstacle",
            "give `stiffness`, that of the cushion under one edge",
        ));
    }
    let hint = "give one of `stiffness` (the whole cushion under one edge), `pad_stiffness` with `pads_per_edge`, a \
                `cushion` file, or a measured `drop_acceleration`";
    let says = |key: &str| request.cushion.get(key).is_some();
    let has_stiffness =
        says("stiffness") || says("pad_stiffness") || says("cushion") || says("compressions");
    match request.drop_acceleration_m_s2 {
        Some(_) if has_stiffness => {
            problems.push(Problem::value(
                "`stiffness`, `pad_stiffness` and `drop_acceleration` exclude each other",
                hint,
            ));
            None
        }
        Some(_) if says("series_stiffness") => {
            problems.push(Problem::value(
                "`series_stiffness` needs a stiffness with which it acts in series",
                "a measured drop acceleration already includes everything that was under the mass",
            ));
            None
        }
        Some(measured) => Some(Contact::Measured(measured)),
        None if !has_stiffness && !says("law") => {
            problems.push(Problem::value(
                "the stiffness of the cushion is missing",
                hint,
            ));
            None
        }
        None => problems
            .keep(cushion::resolve(&request.cushion, Some(request.mass_kg)))
            .map(Contact::Cushion),
    }
}
