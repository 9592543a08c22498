//! From the worlds of one object to its assessment.

use freestand::G0_M_S2;
use freestand::impact::{ImpactModel, Landing};
use freestand::respond::{HistoryOptions, Plane, Tilt, Travelled};
use freestand::rocking::{Outcome as RockingOutcome, RockingImpact};
use freestand::sliding::trip_speed_m_s;
use freestand::spatial::StackPart;
use freestand::spectra::landings;

use crate::reason::{Missing, Note, Reason, Slips, unknown};
use crate::restraint::is_beyond_code;
use crate::result::{
    Assessment, AtWall, AxisResponse, Braked, CapacityCheck, Chain, Criterion, Decision,
    FallsAnswer, FloorFacts, InSpace, ObjectModel, OnRigidBase, Ranked, Rolled, Shock, ShockAnswer,
    Sliding, SlidingVerdict, Softening, Stacked,
};
use crate::worlds::FloorOfWorld;
use freestand_input::problem::Problems;
use freestand_study::statistics::QUANTILES;

use super::answers::{answers, stop_is_known};
use super::decision::{Case, decide, deciding, settled};
use super::draw::Drawn;
use super::notes::{failures, lowest_tail, space_notes, unknown_wall_shock, without_pads};
use super::object::{Body, Model, Way, hit};
use super::on_pads::on_pads;
use super::over_worlds::{quantile, quantiles, share};
use super::response::{
    AxisMotion, Lived, PadMotion, demand_capacity, governing, lifts, overturned,
    pads_demand_capacity, ranked,
};
use super::slip::needed_ratio;
use super::softer::beyond_pads;
use super::trial::Trial;
use super::{Context, blank};

/// What a world is ranked by on a rigid base: demand/capacity where it is known, else the shock, else
/// the rise.
fn severity(trial: &Trial, axes: &[AxisMotion]) -> f64 {
    match (
        trial
            .subject
            .capacity
            .as_ref()
            .and_then(|_| demand_capacity(axes)),
        &trial.subject.body,
    ) {
        (Some(ratio), _) => ratio,
        (None, Some(_)) => ranked(axes, AxisMotion::larger_g),
        (None, None) => ranked(axes, AxisMotion::cg_rise_m),
    }
}

/// The same on its pads; the shock and the lift do not depend on whether the mass is known.
fn severity_on_pads(trial: &Trial, axes: &[PadMotion]) -> f64 {
    if axes.iter().any(|one| one.found.has_fallen()) {
        return f64::INFINITY;
    }
    let ratio = trial
        .subject
        .capacity
        .as_ref()
        .and_then(|_| pads_demand_capacity(axes));
    ratio.unwrap_or_else(|| axes.iter().map(|one| one.edge_m_s2).fold(0.0, f64::max))
}

/// The worlds from the mildest to the hardest: on a rigid base where that is asked, else on pads.
fn by_severity(context: &Context, trial: &Trial) -> Vec<usize> {
    let mut order: Vec<(f64, usize)> = if trial.asks(context, Model::Rigid) {
        trial
            .followed()
            .map(|(i, axes)| (severity(trial, axes), i))
            .collect()
    } else {
        let lived = trial.lived.iter().enumerate();
        lived
            .filter_map(|(i, one)| Some((severity_on_pads(trial, &one.on_pads()?.axes), i)))
            .collect()
    };
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    order.into_iter().map(|(_, i)| i).collect()
}

/// The whole assessment of one object.
pub(super) fn assessment(
    context: &Context,
    trial: &Trial,
    (softening, braked): (Option<Softening>, Option<Braked>),
) -> Result<Assessment, Problems> {
    let member = trial.member;
    let mut assessed = blank(member.item, &context.study.assessment);
    let floor = floor_facts(trial);
    assessed.floor = Some(floor.clone());
    let order = by_severity(context, trial);
    let answers = answers(context, trial);
    // The hardest world after the accepted share of them is left out.
    let beyond = (member.accepted_ratio * order.len() as f64).floor() as usize;
    let world = order
        .len()
        .checked_sub(1 + beyond)
        .map(|place| order[place]);
    let governs = world.and_then(|world| governing_criterion(trial, world));
    let missing = missing(trial);
    let lifts_at_all = trial.followed().any(|(_, axes)| lifts(axes))
        || trial
            .followed_on_pads()
            .any(|(_, axes)| axes.iter().any(|one| one.found.has_let_go()));
    let (decision, why) = decide(&Case {
        answers: &answers,
        lifts: lifts_at_all,
        decides: trial
            .subject
            .capacity
            .as_ref()
            .is_some_and(|capacity| capacity.decides),
        governing: governs,
        missing: &missing,
        softer: softening.as_ref().map(Softening::admissible),
        beyond_pads: beyond_pads(trial),
    });
    assessed.why = why;
    if lifts_at_all && answers.shock != ShockAnswer::Unknown && member.item.cushion_source.is_some()
    {
        assessed.why.push(Reason::StiffnessIsRange);
    }
    assessed.at_wall = at_wall(trial);
    if let Some(at_wall) = &assessed.at_wall {
        if at_wall.lean_share > 0.0 {
            assessed.why.push(Reason::Leans {
                worlds: trial.leans().filter(|leans| *leans).count() as u32,
                followed: trial.followed().count() as u32,
            });
        }
        let is_rigid = matches!(trial.subject.way, Way::Walled(_));
        if is_rigid && context.study.assessment.compliant && trial.subject.body.is_some() {
            assessed.why.push(Reason::PadsNotFollowed);
        }
        assessed.notes.extend(unknown_wall_shock(trial, at_wall));
    }
    assessed.notes.extend(failures(trial));
    assessed.rolled = rolled(context, trial);
    assessed.braked = braked;
    if assessed.rolled.is_some() {
        assessed.why.insert(0, Reason::Travels);
    }
    let loose = assessed.rolled.and(assessed.braked);
    let loose = loose.map(|braked| super::braked::decide(&braked));
    let unstated = context.study.unstated(trial.subject.level_ratio);
    assessed.decision = settled(decision, loose, unstated.is_some());
    if assessed.decision != decision {
        match (loose, unstated) {
            (Some(_), _) => assessed.why.push(Reason::NoRoom {
                room_m: trial.subject.way.room_m(),
            }),
            (None, Some(unstated)) => {
                assessed.why.push(Reason::Unstated(unstated));
            }
            (None, None) => {}
        }
    }
    if let Some((slips, on_pads)) = slipped(trial) {
        if on_pads {
            assessed.why.push(Reason::Slips(slips));
        } else {
            let why = without_pads(trial);
            assessed.notes.push(Note::SlipsWithoutPads { slips, why });
        }
    }
    assessed.model = Some(match trial.subject.way {
        Way::Rolls(_) => ObjectModel::Roll,
        Way::Slides(_) => ObjectModel::Slide,
        Way::Walled(_) => ObjectModel::RockWall,
        Way::Planar if answers.compliant.is_some() => ObjectModel::Compliant,
        Way::Planar => ObjectModel::Rock,
        Way::Spatial(_) => ObjectModel::Spatial,
        Way::Stack(_) => ObjectModel::Stack,
        Way::Hull(..) => ObjectModel::Hull,
    });
    assessed.in_space = in_space(trial);
    if assessed.in_space.is_some() {
        assessed.why.push(Reason::InSpace);
    }
    assessed.stacked = stacked(trial);
    if assessed.stacked.is_some() {
        assessed.why.push(Reason::Stacked);
    }
    assessed
        .notes
        .extend(trial.subject.flat.clone().map(Note::Flat));
    assessed.notes.extend(space_notes(context, trial)?);
    assessed
        .notes
        .extend(lowest_tail(context, trial, assessed.decision));
    assessed.tier = match (lifts_at_all, answers.compliant.is_some()) {
        (false, _) => 0,
        (true, false) => 2,
        (true, true) => 3,
    };
    assessed.p_overturn = deciding(&answers, |model| Some(model.overturn));
    assessed.p_exceed = deciding(&answers, |model| model.exceed);
    assessed.response = response(trial);
    assessed.on_pads = on_pads(context, trial);
    assessed.capacity = capacity_check(trial, &floor, governs);
    assessed.softening = softening;
    assessed.clearance_m = clearance(trial).filter(|_| trial.subject.way.rocks());
    assessed.chain = world.and_then(|world| chain(context, trial, world));
    assessed.shock = shock(trial);
    let hardest = order.iter().rev().copied();
    let rocks = |world: &usize| {
        trial.lived[*world]
            .on_rigid()
            .is_some_and(|told| lifts(&told.axes) && !overturned(&told.axes))
    };
    if let Some(world) = hardest.clone().find(rocks) {
        let at = context
            .worlds
            .floor(world as u32, trial.subject.level_ratio)?;
        let impacts = impacts_above(trial, world, &at);
        assessed.shock = assessed.shock.map(|shock| Shock {
            impacts_above_tolerance: impacts,
            ..shock
        });
        assessed.sliding = sliding(context, trial, world, &at);
    } else if trial.asks(context, Model::Rigid) {
        assessed.sliding = Some(slides(context, trial, floor.pfa_g_max));
    }
    if assessed.decision == Decision::Restrain {
        assessed.restraint = context.restraint(trial);
        if let Some(p) = assessed
            .p_overturn
            .filter(|_| answers.falls != FallsAnswer::Stays)
        {
            let (worlds, overturned) = (answers.worlds, p.value * f64::from(answers.worlds));
            let overturned = overturned.round() as u32;
            if overturned > 0 && is_beyond_code(&assessed.restraint) {
                assessed.why.push(Reason::BeyondCode { overturned, worlds });
            }
        }
    }
    assessed.comparisons = context.comparisons(trial, &floor);
    assessed.answers = Some(answers);
    Ok(assessed)
}

/// What happens at its wall; `None`: there is none, or every history failed.
fn at_wall(trial: &Trial) -> Option<AtWall> {
    let beside = trial.subject.way.walls()?;
    trial.followed().next()?;
    let median = |of: fn(&AxisMotion) -> Option<f64>| {
        let most = |axes: &[AxisMotion]| axes.iter().filter_map(of).fold(0.0, f64::max);
        quantile(trial.followed().map(|(_, axes)| most(axes)), 0.5)
    };
    let has_shock = !matches!(trial.subject.way, Way::Hull(..));
    let is_known = has_shock && trial.subject.mass_kg.is_some() && beside.stiffness_n_m.is_some();
    let strikes = |axes: &[AxisMotion]| axes.iter().any(|one| one.wall_speed_m_s().is_some());
    Some(AtWall {
        lean_share: share(trial.leans()),
        strike_share: share(trial.followed().map(|(_, axes)| strikes(axes))),
        speed_m_s_median: median(AxisMotion::wall_speed_m_s),
        acceleration_g_median: is_known
            .then(|| median(|one| Some(one.wall_acceleration_m_s2()? / G0_M_S2))),
    })
}

/// The shares of worlds in which the room that it needs is told.
const ROOM_QUANTILES: [f64; 3] = [0.5, 0.84, 0.98];

/// How it rolls or slides; `None`: it rocks, or every history failed.
fn rolled(context: &Context, trial: &Trial) -> Option<Rolled> {
    let gliding = trial.subject.way.glides()?;
    trial.followed().next()?;
    let ways = || {
        trial
            .lived
            .iter()
            .filter_map(|lived| lived.on_rigid()?.outcome.travelled())
    };
    let of = |number: fn(&Travelled) -> f64, q: f64| quantile(ways().map(|way| number(&way)), q);
    let travel = |way: &Travelled| way.travel_m;
    let stop_speed = |way: &Travelled| way.stop_speed_m_s.unwrap_or(0.0);
    let trip_speeds = trial
        .subject
        .axes
        .iter()
        .map(|axis| trip_speed_m_s(&axis.block, G0_M_S2));
    Some(Rolled {
        travel_m_median: of(travel, QUANTILES[1]),
        travel_m_p84: of(travel, QUANTILES[2]),
        is_at_least: ways().any(|way| way.is_at_least),
        clearance_m: gliding.clearance_m,
        clearance_needed_m: trial.room_needed_m(context),
        room_m: ROOM_QUANTILES.map(|q| of(|way| way.room_m, q)),
        stop_share: share(ways().map(|way| way.stop_speed_m_s.is_some())),
        stop_speed_m_s_p84: Some(of(stop_speed, QUANTILES[2])).filter(|speed_m_s| *speed_m_s > 0.0),
        trip_speed_m_s: trip_speeds.fold(f64::INFINITY, f64::min),
    })
}

/// How it moves in three dimensions; `None`: it does not, or every history failed.
fn in_space(trial: &Trial) -> Option<InSpace> {
    if !matches!(trial.subject.way, Way::Spatial(_)) {
        return None;
    }
    trial.followed_on_pads().next()?;
    let of = |number: fn(&Tilt) -> f64| {
        let of_world = |axes: &[PadMotion]| match axes.iter().any(|one| one.found.has_fallen()) {
            true => f64::INFINITY,
            false => axes
                .iter()
                .filter_map(|one| one.space.as_ref().map(number))
                .fold(0.0, f64::max),
        };
        quantiles(trial.followed_on_pads().map(|(_, axes)| of_world(axes)))
    };
    let ([_, tilt_rad_median, tilt_rad_p84], [_, walk_m_median, walk_m_p84]) =
        (of(|space| space.tilt_rad), of(|space| space.walk_m));
    Some(InSpace {
        tilt_rad_median,
        tilt_rad_p84,
        walk_m_median,
        walk_m_p84,
    })
}

/// What falls of a stack; `None`: it is none, or every history failed.
fn stacked(trial: &Trial) -> Option<Stacked> {
    let Way::Stack(upper) = &trial.subject.way else {
        return None;
    };
    let (first, _) = trial.followed_on_pads().next()?;
    let falls = |part: StackPart| {
        trial
            .followed_on_pads()
            .filter(|(_, axes)| axes.iter().any(|one| one.fallen == Some(part)))
            .count() as u32
    };
    // Of the sizes in the list.
    let listed = Drawn {
        subject: &trial.subject,
        draw: &first.draw.without_factors(),
    }
    .stack(upper)?;
    Some(Stacked {
        worlds: trial.followed_on_pads().count() as u32,
        lower_falls: falls(StackPart::Lower),
        upper_falls: falls(StackPart::Upper),
        threshold_upper_g: listed.threshold_upper(),
        threshold_together_g: listed.threshold_together(),
    })
}

/// The worlds in which it slides while it rocks, and whether its pads answer in all of them; `None`: there are
/// none.
fn slipped(trial: &Trial) -> Option<(Slips, bool)> {
    let slips = || trial.lived.iter().filter(|one| one.slips);
    let worlds = u32::try_from(slips().count()).unwrap_or(u32::MAX);
    let slipped = Slips {
        worlds,
        of: trial.lived.len() as u32,
        friction_ratio: trial.subject.friction_ratio.unwrap_or_default(),
    };
    (worlds > 0).then(|| (slipped, slips().all(Lived::is_for_pads)))
}

fn floor_facts(trial: &Trial) -> FloorFacts {
    let pfa = || trial.lived.iter().map(|one| one.pfa_m_s2 / G0_M_S2);
    FloorFacts {
        level_ratio: trial.subject.level_ratio,
        pfa_g_median: quantile(pfa(), 0.5),
        pfa_g_max: pfa().fold(0.0, f64::max),
        pfv_m_s_median: quantile(trial.lived.iter().filter_map(|one| one.pfv_m_s), 0.5),
    }
}

fn response(trial: &Trial) -> Option<OnRigidBase> {
    let worlds = trial.followed().count();
    if worlds == 0 {
        return None;
    }
    let over = |number: &dyn Fn(&AxisMotion) -> f64| {
        quantiles(trial.followed().map(|(_, axes)| ranked(axes, number)))
    };
    Some(OnRigidBase {
        motions: worlds,
        failed: trial
            .lived
            .iter()
            .filter(|one| one.failure().is_some())
            .count(),
        failure: trial
            .lived
            .iter()
            .find_map(|one| Some(one.failure()?.why().to_owned())),
        uplift_share: share(trial.followed().map(|(_, axes)| lifts(axes))),
        overturn_share: share(trial.followed().map(|(_, axes)| overturned(axes))),
        uplift_m: over(&AxisMotion::uplift_m),
        rotation_ratio: quantiles(
            trial
                .followed()
                .map(|(_, axes)| rotation_ratio(trial, axes)),
        ),
        impacts_max: trial
            .followed()
            .flat_map(|(_, axes)| axes.iter().filter_map(AxisMotion::rocking))
            .map(|rocking| rocking.impact_count)
            .max()
            .unwrap_or(0),
        axes: (0..trial.subject.axes.len())
            .map(|axis| axis_response(trial, axis))
            .collect(),
    })
}

/// Peak rotation over the slenderness angle, about the axis where it is larger.
fn rotation_ratio(trial: &Trial, axes: &[AxisMotion]) -> f64 {
    if overturned(axes) {
        return f64::INFINITY;
    }
    let alpha = |axis: usize| trial.subject.axes[axis].block.pivot().slenderness_angle_rad;
    axes.iter()
        .enumerate()
        .filter_map(|(i, one)| Some(one.peak_rotation_rad()? / alpha(i)))
        .fold(0.0, f64::max)
}

fn axis_response(trial: &Trial, axis: usize) -> AxisResponse {
    let geometry = &trial.subject.axes[axis];
    let pivot = geometry.block.pivot();
    let worlds = || trial.followed().filter_map(|(_, axes)| axes.get(axis));
    let shock = |one: &AxisMotion| ranked(std::slice::from_ref(one), AxisMotion::larger_g);
    AxisResponse {
        axis: geometry.axis,
        slenderness_angle_rad: pivot.slenderness_angle_rad,
        half_diagonal_m: pivot.half_diagonal_m,
        uplift_threshold_g: pivot.slenderness_angle_rad.tan(),
        uplift_share: share(worlds().map(AxisMotion::lifts)),
        overturn_share: share(worlds().map(AxisMotion::has_fallen)),
        edge_acceleration_g: trial
            .subject
            .body
            .as_ref()
            .map(|_| quantiles(worlds().map(shock))),
        ceiling_g: trial
            .subject
            .body
            .as_ref()
            .map(|body| ceiling_g(trial, axis, body)),
    }
}

fn ceiling_g(trial: &Trial, axis: usize, body: &Body) -> f64 {
    let landings = landings(&trial.subject.axes[axis].block, ImpactModel::Paper);
    let of = |landing: &Landing| {
        let rise_m = landing.pivot.balance_rise_m();
        landing.edge_acceleration_m_s2(body.mass_kg, &body.cushion, rise_m, G0_M_S2) / G0_M_S2
    };
    landings.iter().map(of).fold(0.0, f64::max)
}

fn shock(trial: &Trial) -> Option<Shock> {
    // What rolls does not land.
    let body = trial
        .subject
        .body
        .as_ref()
        .filter(|_| trial.subject.way.rocks())?;
    trial.followed().next()?;
    let of = |number: fn(&AxisMotion) -> f64| {
        quantiles(trial.followed().map(|(_, axes)| ranked(axes, number)))
    };
    let survived = trial
        .followed()
        .filter(|(_, axes)| !overturned(axes) && lifts(axes));
    let survived: Vec<(usize, f64)> = survived
        .filter_map(|(_, axes)| governing(axes).map(|(axis, one)| (axis, one.larger_g())))
        .collect();
    let hardest = survived
        .iter()
        .copied()
        .reduce(|most, next| if next.1 > most.1 { next } else { most });
    let axes = 0..trial.subject.axes.len();
    Some(Shock {
        edge_acceleration_g: of(AxisMotion::larger_g),
        edge_acceleration_uplift_g: of(|one| one.hit().map_or(0.0, |hit| hit.uplift_g)),
        edge_acceleration_max_g: hardest.map(|(_, shock_g)| shock_g),
        pulse_duration_s: pulse_duration_s(trial, hardest.map_or(0, |(axis, _)| axis), body),
        velocity_change_m_s: of(|one| one.hit().map_or(0.0, |hit| hit.velocity_change_m_s))[1],
        ceiling_g: axes
            .map(|axis| ceiling_g(trial, axis, body))
            .fold(0.0, f64::max),
        stiffness_n_m: body.cushion.linear_stiffness_n_m(),
        impacts_above_tolerance: None,
    })
}

/// The duration of the pulse on the cushion; for a curved contact law, of a landing from a
/// hundredth of the rise at the balance point.
fn pulse_duration_s(trial: &Trial, axis: usize, body: &Body) -> f64 {
    let landing = Landing::rocking(&trial.subject.axes[axis].block, ImpactModel::Paper);
    let rise_m = 0.01 * landing.pivot.balance_rise_m();
    landing
        .impact(body.mass_kg, &body.cushion, rise_m, G0_M_S2)
        .pulse_duration_s
}

fn missing(trial: &Trial) -> Vec<Missing> {
    let item = trial.member.item;
    let has_tolerance = item.tolerance.is_some() && trial.subject.capacity.is_some();
    if trial.subject.way.glides().is_some() {
        let is_known = !has_tolerance || stop_is_known(trial);
        let has_stop = item.surroundings.wall_stiffness_n_m.is_some();
        return unknown([
            (has_tolerance, Missing::Tolerance),
            (is_known || item.mass_kg.is_some(), Missing::Mass),
            (is_known || has_stop, Missing::StopStiffness),
        ]);
    }
    unknown([
        (has_tolerance, Missing::Tolerance),
        (item.mass_kg.is_some(), Missing::Mass),
        (item.cushion.is_some(), Missing::Stiffness),
    ])
}

/// What governs in a world, by the model with the larger demand.
fn governing_criterion(trial: &Trial, world: usize) -> Option<Criterion> {
    let capacity = trial.subject.capacity.as_ref()?;
    let lived = trial.lived.get(world)?;
    let rigid = lived.on_rigid().into_iter().flat_map(|told| &told.axes);
    let rigid = rigid.filter_map(|one| one.terms);
    let pads = lived.on_pads().into_iter().flat_map(|told| &told.axes);
    let pads = pads.filter_map(|one| one.terms);
    let worst = rigid.chain(pads).reduce(|most, next| {
        if next.ratio() > most.ratio() {
            next
        } else {
            most
        }
    });
    match worst {
        Some(worst) => Some(worst.governing(capacity)),
        // Casters, and a base that slides, keep most of it from the object.
        None if trial.subject.way.glides().is_some() => None,
        None => capacity.peak_m_s2.map(|_| Criterion::FloorAcceleration),
    }
}

fn capacity_check(
    trial: &Trial,
    floor: &FloorFacts,
    governing: Option<Criterion>,
) -> Option<CapacityCheck> {
    let (capacity, tolerance) = (
        trial.subject.capacity.as_ref()?,
        trial.member.item.tolerance.as_ref()?,
    );
    let ratios: Option<Vec<f64>> = match trial.subject.way.asks(Model::Rigid) {
        true => trial
            .followed()
            .map(|(_, axes)| demand_capacity(axes))
            .collect(),
        false => trial
            .followed_on_pads()
            .map(|(_, axes)| pads_demand_capacity(axes))
            .collect(),
    };
    let [_, median, p84] =
        ratios.map_or([Ranked::NoData; 3], |ratios| quantiles(ratios.into_iter()));
    Some(CapacityCheck {
        demand_capacity: median,
        demand_capacity_p84: p84,
        governing: governing.unwrap_or(capacity.edge_criterion()),
        tolerance: capacity.clone(),
        source: tolerance.source.clone(),
        floor_ratio: capacity
            .peak_m_s2
            .map(|peak| floor.pfa_g_median * G0_M_S2 / peak),
    })
}

/// Impacts above the peak of its tolerance, about the governing axis; `None` where no peak is
/// known.
fn impacts_above(trial: &Trial, world: usize, at: &FloorOfWorld) -> Option<usize> {
    let peak_m_s2 = trial.subject.capacity.as_ref()?.peak_m_s2?;
    let (one, axis) = governed(trial, world)?;
    let (mass_kg, cushion) = one.draw.body(one.subject)?;
    let object = one.rigid_plane(axis)?;
    let Plane { along, block } = object.plane;
    let landing = Landing::rocking(&block, ImpactModel::Paper);
    let above = |impact: &&RockingImpact| {
        let shock = landing.impact_at_omega(mass_kg, &cushion, impact.omega_before_rad_s, G0_M_S2);
        shock.edge_acceleration_m_s2 > peak_m_s2
    };
    let history = object.follow(at.base(along), &HistoryOptions::default());
    let impacts = history.ok()?.rocking.impacts;
    Some(impacts.iter().filter(above).count())
}

/// The object in a world, and its governing axis there.
fn governed<'a>(trial: &'a Trial, world: usize) -> Option<(Drawn<'a>, usize)> {
    let lived = trial.lived.get(world)?;
    let (axis, _) = governing(&lived.on_rigid()?.axes)?;
    let (subject, draw) = (&trial.subject, &lived.draw);
    Some((Drawn { subject, draw }, axis))
}

/// Whether it slides, by the friction that rocking and its impacts need in the hardest world;
/// `None` where that is not known.
fn sliding(context: &Context, trial: &Trial, world: usize, at: &FloorOfWorld) -> Option<Sliding> {
    let (one, axis) = governed(trial, world)?;
    Some(slides(context, trial, needed_ratio(one, at, axis, true)?))
}

fn slides(context: &Context, trial: &Trial, needed_ratio: f64) -> Sliding {
    if let Some(gliding) = trial.subject.way.glides() {
        let (friction_ratio, is_stated) = (gliding.resistance_ratio, gliding.is_stated);
        return Sliding {
            verdict: SlidingVerdict::Yes,
            friction_ratio,
            is_stated,
        };
    }
    let stated = trial.subject.friction_ratio;
    let (low, high) = stated.unwrap_or(context.study.assessment.friction_ratio);
    let slips =
        trial.lived.iter().any(Lived::is_for_pads) && trial.lived.iter().any(|one| one.slips);
    let verdict = if low >= needed_ratio && !slips {
        SlidingVerdict::No
    } else if high < needed_ratio || slips {
        SlidingVerdict::Yes
    } else {
        SlidingVerdict::Possible
    };
    Sliding {
        verdict,
        friction_ratio: (low, high),
        is_stated: stated.is_some(),
    }
}

/// Eqs. (5)–(7) about the governing axis, with the values of a world; `None` where it overturns or
/// does not uplift.
fn chain(context: &Context, trial: &Trial, world: usize) -> Option<Chain> {
    let lived = trial.lived.get(world)?;
    let (axis, one) = governing(&lived.on_rigid()?.axes)?;
    let rocking = one.rocking()?;
    if rocking.outcome != RockingOutcome::Rocked {
        return None;
    }
    let (mass_kg, cushion) = lived.draw.body(&trial.subject)?;
    let (block, _) = lived.draw.block(&trial.subject, axis)?;
    let geometry = &trial.subject.axes[axis];
    let landing = Landing::rocking(&block, ImpactModel::Paper);
    let shock = landing.impact(mass_kg, &cushion, rocking.cg_rise_m, G0_M_S2);
    let both = hit(&block, rocking, mass_kg, &cushion)?;
    let (height_m, side_m) = lived.draw.size_m(&trial.subject, axis);
    Some(Chain {
        motion: context.worlds.name(u32::try_from(world).ok()?),
        axis: geometry.axis,
        height_m,
        thickness_m: side_m,
        is_uniform: geometry.is_uniform() && cushion.linear_stiffness_n_m().is_some(),
        base_m: block.base_width_m(),
        half_diagonal_m: block.pivot().half_diagonal_m,
        mass_kg,
        stiffness_n_m: cushion.linear_stiffness_n_m(),
        cg_rise_m: rocking.cg_rise_m,
        landing_ratio: block.landing_ratio(),
        is_halted: block.landing_ratio() <= 0.0,
        drop_acceleration_g: shock.drop_acceleration_m_s2 / G0_M_S2,
        effective_mass_kg: landing.effective_mass_ratio * mass_kg,
        edge_acceleration_g: both.uplift_g,
        edge_acceleration_impact_velocity_g: both.impact_velocity_g,
        velocity_change_m_s: 0.5
            * (1.0 + lived.draw.rebound_restitution())
            * shock.velocity_change_m_s,
        pulse_duration_s: shock.pulse_duration_s,
        uplift_m: rocking.uplift_m,
        demand_capacity_ratio: one.terms.map(|terms| terms.ratio()),
    })
}

/// The clearance that the object needs while it rocks: the largest over the worlds and axes.
fn clearance(trial: &Trial) -> Option<f64> {
    let clear = |(i, one): (usize, &AxisMotion)| {
        let geometry = &trial.subject.axes[i];
        let peak_rotation_rad = one.peak_rotation_rad()?;
        Some(match one.outcome() {
            RockingOutcome::Overturned => geometry.height_m,
            _ => {
                crate::restraint::clearance_m(geometry.height_m, geometry.side_m, peak_rotation_rad)
            }
        })
    };
    let axes = trial
        .followed()
        .flat_map(|(_, axes)| axes.iter().enumerate());
    axes.filter_map(clear).reduce(f64::max)
}
