//! What the worlds of one object add up to, for those who tell it in a sentence.

use freestand::G0_M_S2;
use freestand::respond::Outcome;

use super::Context;
use super::object::Model;
use super::response::{AxisMotion, Lived, lifts};
use super::trial::{Question, Trial};

/// The worlds of one object, counted. In a world both models are asked where it has pads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tally {
    /// Worlds.
    pub worlds: u32,
    /// Worlds in which a model that is asked could not follow it.
    pub failed: u32,
    /// Worlds in which an edge lifts, by either model.
    pub lifted: u32,
    /// Worlds by the model that decides whether it falls.
    pub asked: u32,
    /// Worlds in which it falls by that model.
    pub overturned: u32,
    /// Worlds in which it is left standing and its tolerance is exceeded, by the model with more of
    /// them; `None`: it has no tolerance.
    pub exceeded: Option<u32>,
    /// Largest uplift of the worlds that do not overturn it \[m\]; `None`: no edge lifts there.
    pub uplift_m_max: Option<f64>,
    /// Largest shock of the worlds that do not overturn it, with the errors of the models \[g\];
    /// `None`: mass or pads are not known, or nothing lands.
    pub shock_g_max: Option<f64>,
    /// Steady floor acceleration that lifts an edge on a rigid base, half the base over the height
    /// of the centre of gravity, about the axis where it is smaller \[g\].
    pub lift_g: f64,
}

/// Counts the worlds of a trial.
pub(super) fn tally(context: &Context, trial: &Trial) -> Tally {
    let count = |is_one: &dyn Fn(&Lived) -> bool| {
        trial.lived.iter().filter(|lived| is_one(lived)).count() as u32
    };
    let models: Vec<Model> = trial.models(context).collect();
    let deciding = deciding(context, trial);
    let fallen =
        |lived: &Lived, model| trial.answer(lived, Question::Falls, model) == Some(Some(true));
    let exceeds = |lived: &Lived, model| {
        !fallen(lived, model) && trial.answer(lived, Question::Shock, model) == Some(Some(true))
    };
    let exceeded = models
        .iter()
        .map(|model| count(&|lived| exceeds(lived, *model)))
        .max();
    let stood = || {
        trial
            .lived
            .iter()
            .map(|lived| (lived, uplift_and_shock(lived)))
    };
    Tally {
        worlds: trial.worlds(),
        failed: count(&|lived| lived.failure().is_some() || matches!(lived.pads, Some(Err(_)))),
        lifted: count(&has_lifted),
        asked: count(&|lived| trial.answer(lived, Question::Falls, deciding).is_some()),
        overturned: count(&|lived| fallen(lived, deciding)),
        exceeded: trial.subject.capacity.as_ref().and(exceeded),
        uplift_m_max: stood()
            .filter_map(|(_, (uplift_m, _))| uplift_m)
            .reduce(f64::max),
        shock_g_max: stood()
            .filter_map(|(_, (_, shock_g))| shock_g)
            .reduce(f64::max),
        lift_g: trial
            .subject
            .axes
            .iter()
            .map(|axis| axis.block.pivot().slenderness_angle_rad.tan())
            .fold(f64::INFINITY, f64::min),
    }
}

/// The model that decides whether an object falls: that with the larger upper end, as in the verdict; of
/// two equal ones the first.
pub(super) fn deciding(context: &Context, trial: &Trial) -> Model {
    let high = |model: &Model| trial.probability(context, Question::Falls, *model).high;
    let models = trial.models(context);
    models
        .reduce(|most, next| {
            if high(&next) > high(&most) {
                next
            } else {
                most
            }
        })
        .unwrap_or(Model::Rigid)
}

fn has_lifted(lived: &Lived) -> bool {
    lived.on_rigid().is_some_and(|told| lifts(&told.axes))
        || lived
            .on_pads()
            .is_some_and(|told| told.axes.iter().any(|one| one.found.has_let_go()))
}

/// The largest uplift \[m\] and the largest shock \[g\] in a world, of the models by which an edge
/// lifts and it stays standing.
fn uplift_and_shock(lived: &Lived) -> (Option<f64>, Option<f64>) {
    let stands = |outcome: Outcome| outcome.has_fallen() == Some(false);
    let rigid = lived.on_rigid().filter(|told| stands(told.outcome));
    let pads = lived.on_pads().filter(|told| stands(told.outcome));
    let rigid = rigid.map_or(&[][..], |told| &told.axes);
    let rigid = rigid.iter().filter(|_| lifts(rigid));
    let pads = pads.map_or(&[][..], |told| &told.axes);
    let pads = pads.iter().filter(|one| one.found.has_let_go());
    let uplift_m = rigid
        .clone()
        .map(AxisMotion::uplift_m)
        .chain(pads.clone().map(|one| one.found.lift_m))
        .reduce(f64::max);
    let shocks = rigid
        .map(AxisMotion::larger_g)
        .filter(|shock_g| *shock_g > 0.0)
        .map(|shock_g| lived.draw.model * shock_g)
        .chain(pads.map(|one| one.edge_m_s2 / G0_M_S2));
    (uplift_m, shocks.reduce(f64::max))
}
