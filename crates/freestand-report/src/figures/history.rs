//! One rocking history: rotation, floor acceleration, impacts.

use freestand::G0_M_S2;
use freestand_output::figure::mark::MarkerShape;
use kuva::render::annotations::ReferenceLine;

use freestand::block::Block;
use freestand::rocking::{HistoryPoint, Outcome};
use freestand::wall::Contact;

use freestand_input::words::number;
use freestand_study::result::{ExampleHistory, StudyResult};
use freestand_study::rock::RockReport;
use freestand_study::shape::size_words;

use super::kind::FigureKind;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{
    Axis, DARK, curve_style, line, markers, plain, points, rule,
};
use freestand_output::figure::time::{peak, pixel, span, stacked, symmetric, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};

/// Heights of the three panels \[px\].
const PANELS_PX: [f64; 3] = [190.0, 172.0, 190.0];
/// Quiet time that is shown before the first and after the last rotation \[s\].
const QUIET_S: f64 = 2.0;
/// Rotation at which an object has overturned \[rad\], a little less than π/2.
const FLAT_RAD: f64 = 1.57;
/// Colour of walls.
const WALL: &str = "#8a5a2b";
/// Largest rotation that is drawn of an object that overturns, as a multiple of α.
const HIGHEST_RATIO: f64 = 1.6;

/// The history of the result, if there is one.
pub(super) fn history(result: &StudyResult) -> Option<Page> {
    let h = result.history.as_ref()?;
    let (from, to) = window(h)?;
    let within = |t: f64| (from..=to).contains(&t);
    let cut = |values: &[f64], unit: f64| {
        let points = points(&h.time_s, values).map(|(t, value)| (t, value / unit));
        thin(points.filter(|p| within(p.0)), from, to)
    };
    let theta = cut(&h.theta_rad, h.slenderness_angle_rad);
    let accel = cut(&h.accel_m_s2, G0_M_S2);
    let impacts: Vec<(f64, f64)> = h
        .impacts
        .iter()
        .copied()
        .filter(|&(t, a)| within(t) && a.is_finite())
        .collect();

    let mut legend = rotation_entries();
    legend.push(Entry::new(
        Sign::Dot {
            colour: curve_style(1).colour,
        },
        "impact",
    ));
    if h.outcome == Outcome::Overturned {
        legend.push(Entry::new(Sign::Cross, "overturns"));
    }
    let panels = vec![
        rotation_panel(
            &theta,
            h.outcome,
            time_axis(from, to),
            &WallMarks::default(),
        ),
        accel_panel(&accel, time_axis(from, to), "Floor acceleration (g)", false),
        impact_panel(&impacts, time_axis(from, to)),
    ];
    let outcome = match h.outcome {
        Outcome::NoUplift => "it does not uplift",
        Outcome::Rocked => "it rocks and does not overturn",
        Outcome::Leaned => "it ends leaning on a wall",
        Outcome::Unresolved => "it still moves at the end, and may yet fall",
        Outcome::Overturned => "it overturns",
    };
    let title = format!(
        "Rocking history: {}, {}, {}",
        size_words(h.thickness_m, h.height_m),
        h.level,
        h.motion
    );
    let caption = format!(
        "An object {} mm thick and {} m high on the level “{}”, motion “{}”: {outcome}. Top: rotation divided by \
         the slenderness angle α = {} rad. Middle: acceleration of the floor. Bottom: shock of each impact from \
         the angular velocity just before it (source “velocity”; the paper uses the largest uplift instead). Quiet \
         time before and after is not shown.",
        number(1e3 * h.thickness_m, 4),
        number(h.height_m, 4),
        h.level,
        h.motion,
        number(h.slenderness_angle_rad, 3),
    );
    Some(Page {
        name: FigureKind::History.name(),
        title: plain(&title),
        caption,
        panels,
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend,
    })
}

/// The history of an object under one motion: its rotation and the motion; `None` if it is never
/// off its base, or has no history.
///
/// # Errors
/// A figure that cannot be drawn.
pub fn rock_figure(
    motion: &str,
    block: &Block,
    report: &RockReport,
) -> Result<Option<Figure>, FigureError> {
    let (rocking, history) = (&report.history.rocking, &report.history.samples);
    let (outcome, contacts) = (rocking.outcome, rocking.contacts);
    let Some((from, to)) = span(history, |point| point.time_s) else {
        return Ok(None);
    };
    let alpha = block.pivot().slenderness_angle_rad;
    let points = |of: fn(&HistoryPoint) -> f64, unit: f64| {
        thin(
            history.iter().map(|point| (point.time_s, of(point) / unit)),
            from,
            to,
        )
    };
    let theta = points(|point| point.theta_rad, alpha);
    let accel = points(|point| point.base_accel_m_s2, G0_M_S2);
    let angle = |side: f64, contact: Option<Contact>| {
        contact.map(|contact| side * contact.angle_rad / alpha)
    };
    let [right, left] = contacts;
    let walls: Vec<f64> = [angle(1.0, right), angle(-1.0, left)]
        .into_iter()
        .flatten()
        .collect();
    let struck: Vec<(f64, f64)> = rocking
        .wall_impacts
        .iter()
        .filter_map(|impact| {
            let contact = contacts[impact.side.index()]?;
            Some((
                impact.time_s,
                impact.omega_before_rad_s.signum() * contact.angle_rad / alpha,
            ))
        })
        .collect();
    let mut legend = rotation_entries();
    if !walls.is_empty() {
        legend.push(Entry::line(WALL, 1.4, None, "contact with a wall"));
        legend.push(Entry::new(Sign::Dot { colour: WALL }, "impact on the wall"));
    }
    if outcome == Outcome::Overturned {
        legend.push(Entry::new(Sign::Cross, "overturns"));
    }
    let below = accel_panel(&accel, time_axis(from, to), "Floor acceleration (g)", true);
    let size = size_words(block.thickness_m(), block.height_m());
    let page = Page {
        name: FigureKind::History.name(),
        title: plain(&format!("Rocking history: {size}, {motion}")),
        caption: format!(
            "An object of {size} under the motion “{motion}”. Top: rotation divided by the slenderness angle α = {} \
             rad. Bottom: acceleration of the floor.",
            number(alpha, 3)
        ),
        panels: vec![
            rotation_panel(
                &theta,
                outcome,
                time_axis(from, to),
                &WallMarks { walls, struck },
            ),
            below,
        ],
        columns: 1,
        row_heights_px: vec![PANELS_PX[0], PANELS_PX[2]],
        legend,
    };
    draw(page).map(Some)
}

/// The rotation and the balance point.
fn rotation_entries() -> Vec<Entry> {
    vec![
        Entry::line(curve_style(0).colour, 1.6, None, "rotation θ/α"),
        Entry::line(DARK, 1.2, Some("5 3"), "balance point, θ = ±α"),
    ]
}

/// From shortly before the first rotation to shortly after the last one or the overturning, within
/// the motion.
fn window(h: &ExampleHistory) -> Option<(f64, f64)> {
    let (start, end) = (*h.time_s.first()?, *h.time_s.last()?);
    let rotates = |&(_, &theta): &(&f64, &f64)| theta != 0.0;
    let pairs = || h.time_s.iter().zip(&h.theta_rad);
    let first = pairs().find(rotates).map_or(start, |(&t, _)| t);
    let lies = |&(_, &theta): &(&f64, &f64)| theta.abs() >= FLAT_RAD;
    let last = pairs()
        .find(lies)
        .or_else(|| pairs().rfind(rotates))
        .map_or(end, |(&t, _)| t);
    let (from, to) = ((first - QUIET_S).max(start), (last + QUIET_S).min(end));
    (to > from).then_some((from, to))
}

/// What a rotation panel shows of walls, divided by α.
#[derive(Debug, Default)]
struct WallMarks {
    /// The rotations at which the object touches them.
    walls: Vec<f64>,
    /// Times and rotations of the impacts on them.
    struck: Vec<(f64, f64)>,
}

fn rotation_panel(points: &[(f64, f64)], outcome: Outcome, x: Axis, at_walls: &WallMarks) -> Panel {
    let largest = points
        .iter()
        .map(|p| p.1)
        .chain(at_walls.walls.iter().copied())
        .fold(0.0f64, |m, y| m.max(y.abs()));
    let reach = (1.1 * largest).clamp(1.15, HIGHEST_RATIO);
    let y = Axis {
        step: Some(0.5),
        ..Axis::between(-reach, reach, "Rotation θ/α (–)")
    };
    // A curve that leaves the axes ends at their edge: one point outside is kept, and clipped.
    let end = points
        .iter()
        .position(|p| p.1.abs() > reach)
        .map_or(points.len(), |i| i + 1);
    let mut marks = vec![line(&points[..end], curve_style(0).colour, 1.6, None)];
    if outcome == Outcome::Overturned
        && let Some(&(t, ratio)) = points.get(end.saturating_sub(1))
    {
        marks.push(markers(
            &[(t, ratio.signum() * 0.93 * reach)],
            DARK,
            MarkerShape::Cross,
            5.0,
        ));
    }
    if !at_walls.struck.is_empty() {
        marks.push(markers(&at_walls.struck, WALL, MarkerShape::Circle, 3.0));
    }
    let mut layout = stacked(x, y, false);
    for &value in &at_walls.walls {
        layout =
            layout.with_reference_line(rule(ReferenceLine::horizontal(value), WALL, 1.4, "1 0"));
    }
    for value in [-1.0, 1.0] {
        layout =
            layout.with_reference_line(rule(ReferenceLine::horizontal(value), DARK, 1.2, "5 3"));
    }
    Panel { marks, layout }
}

pub(super) fn accel_panel(points: &[(f64, f64)], x: Axis, label: &str, lowest: bool) -> Panel {
    Panel {
        marks: vec![line(points, "#555555", 0.9, None)],
        layout: stacked(x, symmetric(peak(points), label), lowest),
    }
}

fn impact_panel(impacts: &[(f64, f64)], x: Axis) -> Panel {
    let colour = curve_style(1).colour;
    let highest = impacts.iter().fold(0.0f64, |m, p| m.max(p.1));
    let y = Axis::from_zero(1.05 * highest, "Shock (g)");
    let shown = highest_of_each_pixel(impacts, x.from, x.to);
    // One line up and down at every impact, along the zero line between them.
    let stems: Vec<(f64, f64)> = shown
        .iter()
        .flat_map(|&(t, a)| [(t, 0.0), (t, a), (t, 0.0)])
        .collect();
    let base = if stems.is_empty() {
        vec![(x.from, 0.0), (x.to, 0.0)]
    } else {
        stems
    };
    let heads: Vec<(f64, f64)> = shown
        .iter()
        .copied()
        .filter(|p| p.1 > 0.02 * highest)
        .collect();
    let marks = vec![
        line(&base, colour, 1.4, None),
        markers(&heads, colour, MarkerShape::Circle, 3.0),
    ];
    Panel {
        marks,
        layout: stacked(x, y, true),
    }
}

/// The largest impact of each pixel column.
fn highest_of_each_pixel(impacts: &[(f64, f64)], from: f64, to: f64) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for &impact in impacts {
        match kept.last_mut() {
            Some(last) if pixel(last.0, from, to) == pixel(impact.0, from, to) => {
                if impact.1 > last.1 {
                    *last = impact;
                }
            }
            _ => kept.push(impact),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_impact_of_a_pixel_is_kept() {
        let impacts = [(0.5, 1.0), (0.5 + 1e-6, 3.0), (0.5 + 2e-6, 2.0), (0.9, 0.1)];
        assert_eq!(
            highest_of_each_pixel(&impacts, 0.0, 1.0),
            vec![(0.5 + 1e-6, 3.0), (0.9, 0.1)]
        );
    }
}
