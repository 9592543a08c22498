//! What happened to an object in each world, for those who check or refit its probabilities.

use freestand::G0_M_S2;
use freestand_input::problem::Problem;

use super::object::{Hit, Model, Way};
use super::response::{
    AxisMotion, Lived, ModelResponse, PadMotion, demand_capacity, pads_demand_capacity,
};
use super::trial::{Question, Trial};

/// An object in a world by one model, with the values that it had there.
#[derive(Debug, Clone, PartialEq)]
pub struct OutcomeRow<'a> {
    /// The object.
    pub id: &'a str,
    /// Its number, counted from 0.
    pub world: u32,
    /// `rigid` or `compliant`.
    pub model: &'static str,
    /// `None`: it could not be followed.
    pub has_fallen: Option<bool>,
    /// `None`: not known, or there is no tolerance.
    pub has_exceeded: Option<bool>,
    /// Infinite where it fell.
    pub demand_capacity_ratio: Option<f64>,
    /// `None`: it fell.
    pub lift_m: Option<f64>,
    /// `None`: it fell, or mass or cushion is not known.
    pub edge_acceleration_g: Option<f64>,
    /// Restitution about the thickness, as height and thickness are drawn.
    pub restitution: f64,
    /// Stiffness of the cushion under one edge \[N/m\].
    pub stiffness_n_m: Option<f64>,
    /// Damping ratio of the pads.
    pub pad_damping_ratio: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
}

/// Rows as the file of a part has them.
pub type WriteOutcomes =
    for<'a> fn(&mut (dyn Iterator<Item = OutcomeRow<'a>> + '_)) -> Result<Vec<u8>, Problem>;

/// The rows of a trial: its worlds in their order, the rigid base before the pads.
pub(super) fn outcomes<'a>(trial: &'a Trial) -> impl Iterator<Item = OutcomeRow<'a>> {
    trial
        .lived
        .iter()
        .enumerate()
        .flat_map(move |(world, lived)| {
            let models = [Model::Rigid, Model::Pads].into_iter();
            models.filter_map(move |model| outcome(trial, world as u32, lived, model))
        })
}

fn outcome<'a>(
    trial: &'a Trial,
    world: u32,
    lived: &Lived,
    model: Model,
) -> Option<OutcomeRow<'a>> {
    let has_fallen = trial.answer(lived, Question::Falls, model)?;
    let body = lived.draw.body(&trial.subject);
    let (height_m, thickness_m) = lived.draw.size_m(&trial.subject, 0);
    let [demand_capacity_ratio, lift_m, edge_acceleration_g] = match lived.answering(model) {
        Model::Rigid => lived
            .on_rigid()
            .map_or([None; 3], |told| of_rigid(told, lived.draw.model)),
        Model::Pads => lived.on_pads().map_or([None; 3], of_pads),
    };
    let capacity = trial.subject.capacity.as_ref();
    Some(OutcomeRow {
        id: &trial.member.item.id,
        world,
        model: match model {
            Model::Rigid if matches!(trial.subject.way, Way::Hull(..)) => "hull-3d",
            Model::Rigid => "rigid",
            Model::Pads => match trial.subject.way {
                Way::Spatial(_) => "compliant-3d",
                Way::Stack(_) => "stack",
                Way::Planar | Way::Walled(_) | Way::Rolls(_) | Way::Slides(_) | Way::Hull(..) => {
                    "compliant"
                }
            },
        },
        has_fallen,
        has_exceeded: capacity.and_then(|_| trial.answer(lived, Question::Shock, model)?),
        demand_capacity_ratio: demand_capacity_ratio.filter(|_| capacity.is_some()),
        lift_m,
        edge_acceleration_g,
        restitution: lived.draw.restitution(),
        stiffness_n_m: body
            .as_ref()
            .and_then(|(_, cushion)| cushion.linear_stiffness_n_m()),
        pad_damping_ratio: body.as_ref().map(|_| lived.draw.pad_damping_ratio),
        mass_kg: body.as_ref().map(|(mass_kg, _)| *mass_kg),
        height_m,
        thickness_m,
    })
}

/// Demand/capacity, lift \[m\] and shock with the error of its world \[g\], about the worse axis.
fn of_rigid(told: &ModelResponse<AxisMotion>, model: f64) -> [Option<f64>; 3] {
    let axes = &told.axes;
    let Some(lift_m) = told.outcome.uplift_m() else {
        return [demand_capacity(axes), None, None];
    };
    let shocks: Option<Vec<f64>> = axes
        .iter()
        .map(|one| one.hit().map(Hit::larger_g))
        .collect();
    let shock_g = shocks.and_then(|shocks| shocks.into_iter().reduce(f64::max));
    [
        demand_capacity(axes),
        Some(lift_m),
        shock_g.map(|shock_g| model * shock_g),
    ]
}

/// The same on pads.
fn of_pads(told: &ModelResponse<PadMotion>) -> [Option<f64>; 3] {
    let axes = &told.axes;
    if told.outcome.has_fallen() == Some(true) {
        return [pads_demand_capacity(axes), None, None];
    }
    let most = |number: fn(&PadMotion) -> f64| axes.iter().map(number).reduce(f64::max);
    [
        pads_demand_capacity(axes),
        most(|one| one.found.lift_m),
        most(|one| one.edge_m_s2 / G0_M_S2),
    ]
}
