//! What was found out about one object, block by block. A part that was not computed is left out, and said where it matters.

use freestand_study::assess::result::{Assessment, Response, Swing};
use freestand_study::assess::words::{probability, tier};
use freestand_study::result::Ranked;

use crate::block::{Bar, Block, Cell, ChainValues, Chance, Column};
use crate::object::floor_words;
use crate::text::{millimetres, number, optional, percent, quantity, ranked, stiffness};

/// P(overturn) and P(exceed) on a line, with what is accepted.
pub(crate) fn chances(found: &Assessment) -> Option<Block> {
    let rows: Vec<Chance> = [("shock exceeded or overturned", &found.p_exceed), ("overturned", &found.p_overturn)]
        .into_iter()
        .filter_map(|(name, p)| {
            p.as_ref().map(|p| Chance {
                name,
                value_ratio: p.value,
                low_ratio: p.low,
                high_ratio: p.high,
                words: probability(*p),
            })
        })
        .collect();
    let draws = match found.draws {
        0 => "no draws of uncertain values were needed".to_owned(),
        draws => format!("{draws} draws of the uncertain values for each motion"),
    };
    (!rows.is_empty()).then(|| Block::Chances {
        title: "How likely, with 95 % intervals",
        rows,
        accepted_ratio: found.accepted_ratio,
        accepted: format!("accepted: {} ({}); {draws}", percent(found.accepted_ratio), found.accepted_for),
    })
}

/// 16, 50 and 84 % in one line.
fn band(values: &[Ranked; 3], factor: f64, unit: &str) -> String {
    let [low, median, high] = values.map(|value| ranked(value, factor, 3));
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("{median}{unit} (16 to 84 %: {low} to {high})")
}

/// The floor, rocking, sliding and the shock.
pub(crate) fn behaviour(found: &Assessment) -> Vec<(String, String)> {
    let mut pairs: Vec<(&str, String)> = Vec::new();
    pairs.push(("Decided by", tier(found.tier).to_owned()));
    pairs.push(("Its floor", found.floor.as_ref().map_or("unknown: the level is missing".to_owned(), floor_words)));
    match &found.response {
        Some(response) => rocking(response, &mut pairs),
        None => pairs.push(("Rocking", "not followed: see the reason above".to_owned())),
    }
    if let Some(sliding) = &found.sliding {
        let (low, high) = sliding.friction_ratio;
        let source = if sliding.is_stated { "stated" } else { "assumed" };
        pairs.push((
            "Slides",
            format!("{}, with a friction of {} to {} ({source})", sliding.verdict, number(low, 3), number(high, 3)),
        ));
    }
    if let Some(shock) = &found.shock {
        pairs.push(("Shock, larger source", band(&shock.edge_acceleration_g, 1.0, "g")));
        pairs.push(("  from the rise (Eq. 5)", band(&shock.edge_acceleration_uplift_g, 1.0, "g")));
        pairs.push(("  largest survived", optional(shock.edge_acceleration_max_g, 3, "g")));
        pairs.push(("  ceiling of the rise", quantity(shock.ceiling_g, 3, "g")));
        pairs.push(("Duration of the pulse", quantity(1000.0 * shock.pulse_duration_s, 3, "ms")));
        pairs.push(("Velocity change", format!("{} m/s (median)", ranked(shock.velocity_change_m_s, 1.0, 3))));
        if let Some(impacts) = shock.impacts_above_tolerance {
            pairs.push(("Impacts counted", format!("{impacts} above the tolerance, worst motion survived")));
        }
    }
    if let Some(clearance) = found.clearance_m {
        pairs.push(("Clearance, every side", millimetres(clearance)));
    }
    if let Some(check) = &found.compliant {
        let ratio =
            check.shock_ratio.map_or("no motion survived".to_owned(), |r| format!("shock {} of Eq. (5)", number(r, 3)));
        let view = if check.agrees { "agrees" } else { "disagrees" };
        pairs.push((
            "On compliant pads",
            format!("{view}: {} motions, {} overturned, {ratio}", check.motions, check.overturned),
        ));
    }
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn rocking(response: &Response, pairs: &mut Vec<(&str, String)>) {
    let followed = match response.failed {
        0 => format!("{} motions", response.motions),
        failed => format!(
            "{} motions; {failed} could not be followed: {}",
            response.motions,
            response.failure.as_deref().unwrap_or("–")
        ),
    };
    pairs.push(("Followed under", followed));
    pairs.push((
        "Lifts, overturns",
        format!("{}, {} of the motions", percent(response.uplift_share), percent(response.overturn_share)),
    ));
    pairs.push(("Lift of the edge", band(&response.uplift_m, 1000.0, "mm")));
    pairs.push(("Rotation / balance", band(&response.rotation_ratio, 1.0, "")));
    pairs.push(("Impacts, most", response.impacts_max.to_string()));
}

/// Both axes.
pub(crate) fn axes(found: &Assessment) -> Option<Block> {
    let response = found.response.as_ref()?;
    let rows = response
        .axes
        .iter()
        .map(|axis| {
            let shock = axis
                .edge_acceleration_g
                .map_or("–".to_owned(), |values| values.map(|value| ranked(value, 1.0, 3)).join(" / "));
            vec![
                Cell::from(axis.axis.as_str()),
                number(axis.slenderness_angle_rad, 4).into(),
                number(axis.half_diagonal_m, 4).into(),
                number(axis.uplift_threshold_g, 3).into(),
                percent(axis.uplift_share).into(),
                percent(axis.overturn_share).into(),
                shock.into(),
                axis.ceiling_g.map_or("–".to_owned(), |g| number(g, 3)).into(),
            ]
        })
        .collect();
    Some(Block::Table {
        title: "About its axes".to_owned(),
        note: String::new(),
        columns: vec![
            Column::wide("axis", 1),
            Column::number("α [rad]"),
            Column::number("R [m]"),
            Column::number("lifts at [g]"),
            Column::number("lifts"),
            Column::number("overturns"),
            Column::number("shock, 16 / 50 / 84 % [g]"),
            Column::number("ceiling [g]"),
        ],
        rows,
    })
}

/// Demand over capacity.
pub(crate) fn capacity(found: &Assessment) -> Option<Block> {
    let check = found.capacity.as_ref()?;
    let mut pairs = vec![
        ("Tolerance", check.tolerance.clone()),
        (
            "Its source",
            if check.decides {
                check.source.clone()
            } else {
                format!("{}; recalled, so it may not decide", check.source)
            },
        ),
        (
            "Demand / capacity",
            format!(
                "{} (median), {} (84 %)",
                ranked(check.demand_capacity, 1.0, 3),
                ranked(check.demand_capacity_p84, 1.0, 3)
            ),
        ),
        ("Governs", check.governing.clone()),
    ];
    if let Some(ratio) = check.floor_ratio {
        pairs.push(("Floor / tolerance", number(ratio, 3)));
    }
    Some(Block::Facts {
        title: "Against what it stands",
        pairs: pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
    })
}

/// Forces to fix it with.
pub(crate) fn restraint(found: &Assessment) -> Option<Block> {
    if found.restraint.is_empty() {
        return None;
    }
    let rows = found
        .restraint
        .iter()
        .map(|force| {
            vec![
                Cell::from(force.source.as_str()),
                number(force.force_n, 3).into(),
                number(force.force_ratio, 3).into(),
                number(force.anchor_tension_n, 3).into(),
                force.note.as_str().into(),
            ]
        })
        .collect();
    Some(Block::Table {
        title: "Design it to be held with".to_owned(),
        note: "Horizontal force at the centre of gravity; tension of all anchors along one edge together.".to_owned(),
        columns: vec![
            Column::wide("clause", 2),
            Column::number("force [N]"),
            Column::number("over weight"),
            Column::number("tension [N]"),
            Column::wide("how", 4),
        ],
        rows,
    })
}

/// The softer pad.
pub(crate) fn softening(found: &Assessment) -> Option<Block> {
    let pad = found.softening.as_ref()?;
    let pairs = [
        (
            "Stiffness of an edge",
            pad.max_stiffness_n_m.map_or("none found".to_owned(), |k| format!("at most {}", stiffness(k))),
        ),
        (
            "Compression",
            format!(
                "{}, of a pad of {}",
                pad.stroke_m.map_or("–".to_owned(), millimetres),
                millimetres(pad.pad_thickness_m)
            ),
        ),
        ("Shock on it", optional(pad.edge_acceleration_g, 3, "g")),
        ("Checks", format!("{}: {}", if pad.admissible { "hold" } else { "do not hold" }, pad.note)),
    ];
    Some(Block::Facts {
        title: "A softer pad",
        pairs: pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
    })
}

/// What would change it. The scale ends at the largest number; what overturns goes beyond.
pub(crate) fn tornado(found: &Assessment) -> Option<Block> {
    let first = found.tornado.first()?;
    let finite = |value: Ranked| match value {
        Ranked::Value(value) if value.is_finite() => Some(value),
        _ => None,
    };
    let largest = found
        .tornado
        .iter()
        .flat_map(|swing| [swing.at_low, swing.at_high, swing.as_is])
        .filter_map(finite)
        .fold(0.0, f64::max);
    if largest <= 0.0 {
        return None;
    }
    let has_capacity = found.capacity.is_some();
    // A line at the limit has a place on the scale only if the bars come near it.
    let limit = has_capacity.then_some(1.0 / largest).filter(|ratio| *ratio <= 1.0);
    let share = |value: Ranked| match value {
        Ranked::Value(value) => Some(value / largest),
        Ranked::Overturned => Some(1.06),
        Ranked::NoData => None,
    };
    let bar = |swing: &Swing| {
        let ends = (share(swing.at_low), share(swing.at_high));
        let (from, to) = match ends {
            (Some(a), Some(b)) => (a.min(b), a.max(b)),
            _ => (0.0, 0.0),
        };
        Bar {
            name: swing.parameter.clone(),
            low: swing.low.clone(),
            high: swing.high.clone(),
            at_low: ranked(swing.at_low, 1.0, 3),
            at_high: ranked(swing.at_high, 1.0, 3),
            from_ratio: from.min(1.0),
            to_ratio: to.min(1.0),
            is_beyond: to > 1.0,
            is_drawn: ends.0.is_some() && ends.1.is_some(),
            flips: swing.flips,
        }
    };
    let what = if has_capacity { "demand over capacity" } else { "shock [g]" };
    Some(Block::Tornado {
        title: "What would change it",
        note: format!(
            "{what} of the median motion; as it is {} (solid line){}. An arrow: overturned, beyond every number.",
            ranked(first.as_is, 1.0, 3),
            if limit.is_some() { ", dashed: capacity" } else { "" }
        ),
        as_is_ratio: share(first.as_is).unwrap_or(0.0).min(1.0),
        limit_ratio: limit,
        rows: found.tornado.iter().map(bar).collect(),
    })
}

/// Eqs. (5)–(7).
pub(crate) fn chain(found: &Assessment) -> Option<Block> {
    let chain = found.chain.as_ref()?;
    let demand =
        chain.demand_capacity_ratio.map_or(String::new(), |ratio| format!("; demand/capacity {}", number(ratio, 3)));
    Some(Block::Chain {
        title: "The landing, to follow by hand",
        note: format!(
            "Under {} about the {}: lift of the edge {}{demand}.",
            chain.motion,
            chain.axis,
            millimetres(chain.uplift_m)
        ),
        values: Box::new(ChainValues {
            is_uniform: chain.is_uniform && chain.stiffness_n_m.is_some(),
            is_halted: chain.is_halted,
            radius: quantity(chain.half_diagonal_m, 4, "m"),
            base: quantity(chain.base_m, 4, "m"),
            mass: quantity(chain.mass_kg, 4, "kg"),
            stiffness: chain.stiffness_n_m.map_or("–".to_owned(), stiffness),
            rise: quantity(1000.0 * chain.cg_rise_m, 4, "mm"),
            landing_ratio: number(chain.landing_ratio, 4),
            drop: quantity(chain.drop_acceleration_g, 4, "g"),
            edge: quantity(chain.edge_acceleration_g, 4, "g"),
            effective_mass: quantity(chain.effective_mass_kg, 4, "kg"),
            impact_velocity_edge: quantity(chain.edge_acceleration_impact_velocity_g, 4, "g"),
            velocity_change: quantity(chain.velocity_change_m_s, 4, "m/s"),
            duration: quantity(1000.0 * chain.pulse_duration_s, 4, "ms"),
        }),
    })
}
