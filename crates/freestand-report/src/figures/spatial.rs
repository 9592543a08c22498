//! Figures of an object in space: its tilt against time and its base from above; and the rotations
//! of a stack.

use freestand_output::figure::mark::{Mark, MarkerShape};

use freestand::spatial::{Pattern, Shape};

use freestand::hull::shake::HullPoint;
use freestand::respond::{SpatialPoint, StackPoint};

use freestand_input::words::number;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw, panel_width_px};
use freestand_output::figure::style::{
    Axis, DARK, GREY, LABELS_PX, band, curve_style, line, markers, plain, round_step,
};
use freestand_output::figure::time::{peak, span, stacked, symmetric, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};
use freestand_study::hull::{BodyInPose, BodyKind, spatial_point};
use freestand_study::shape::size_words;
use freestand_study::spatial::{SpatialReport, StackReport};

/// Heights of the two panels in space: tilt, plan \[px\].
const PANELS_PX: [f64; 2] = [230.0, 400.0];
/// Heights of the three panels of a stack: rotations, patterns, difference \[px\].
const STACK_PX: [f64; 3] = [200.0, 60.0, 230.0];
/// The patterns in which a stack moves, from the bottom of their panel, with their colours.
const PATTERNS: [(Pattern, &str, &str); 4] = [
    (Pattern::UpperAlone, "the upper body alone", "#e69f00"),
    (Pattern::Together, "together", "#56b4e9"),
    (Pattern::Opposite, "both, opposite sense", "#cc79a7"),
    (Pattern::Same, "both, same sense", "#444444"),
];
/// Room that the labels take beside and around a stacked panel \[px\].
const BESIDE_PX: f64 = 76.0 + 18.0;
const AROUND_PX: f64 = 8.0 + LABELS_PX;

fn curve(index: usize, words: &str) -> Entry {
    Entry::line(curve_style(index).colour, 1.5, None, words)
}

/// An angle of a history over time \[degrees\].
fn degrees<P>(
    history: &[P],
    (from, to): (f64, f64),
    of: impl Fn(&P) -> (f64, f64),
) -> Vec<(f64, f64)> {
    let points = history
        .iter()
        .map(of)
        .map(|(time_s, angle_rad)| (time_s, angle_rad.to_degrees()));
    thin(points, from, to)
}

/// Tilt against time, and the base from above: its outline at rest and at the end, and the path of
/// its centre. `None` if nothing moved.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn spatial_figure(motion: &str, report: &SpatialReport) -> Result<Option<Figure>, FigureError> {
    let [x, y, height] = report.shape.sizes_m();
    let size = match report.shape {
        Shape::Cylinder { .. } => format!("Cylinder, {}", size_words(x, height)),
        Shape::Plane { .. } => size_words(x, height),
        _ => format!("{} mm × {}", number(1e3 * x, 4), size_words(y, height)),
    };
    let history = &report.history;
    let closed = |points: &[[f64; 2]]| -> Vec<(f64, f64)> {
        points
            .iter()
            .chain(points.first())
            .map(|&[x, y]| (1e3 * x, 1e3 * y))
            .collect()
    };
    let [before, after] = [&report.shape.feet_m(), &history.outline_m].map(|points| closed(points));
    let plan = Plan {
        marks: vec![
            line(&before, DARK, 1.0, Some("5 3")),
            line(&after, DARK, 1.4, None),
        ],
        reach: [before, after].concat(),
        legend: vec![
            Entry::line(DARK, 1.0, Some("5 3"), "base at rest"),
            Entry::line(DARK, 1.4, None, "base at the end"),
        ],
    };
    let words = Words {
        name: "spatial",
        title: format!("{size}, {motion}"),
        caption: format!(
            "An object of {size} under the motion “{motion}”: one realisation. Top: angle of its axis to the \
             vertical, and its parts to the right (along the thickness) and to the back (along the width). Bottom: the \
             base from above, relative to the floor, at rest and at the end, and the path of its centre."
        ),
    };
    in_space(words, &history.samples, plan)
}

/// As [`spatial_figure`], of a body on the points of its hull, with its weakest side.
///
/// # Errors
/// As [`spatial_figure`].
pub fn hull_figure(
    motion: &str,
    body: &BodyInPose,
    orientation_rad: f64,
    history: &[HullPoint],
) -> Result<Option<Figure>, FigureError> {
    let Some((first, last)) = history.first().zip(history.last()) else {
        return Ok(None);
    };
    let from_above = |at: &HullPoint| -> Vec<(f64, f64)> {
        let points = body.standing.points_m().iter();
        points
            .map(|point| at.place_m(point))
            .map(|[x, y, _]| (1e3 * x, 1e3 * y))
            .collect()
    };
    let (before, after) = (from_above(first), from_above(last));
    // As far as the farthest point.
    let reach_mm = before.iter().map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    let (sin, cos) = (orientation_rad + body.barrier.toward_rad).sin_cos();
    // A cylinder is alike on every side.
    let weakest = Some([(0.0, 0.0), (reach_mm * cos, reach_mm * sin)])
        .filter(|_| body.kind != BodyKind::Cylinder);
    let colour = curve_style(4).colour;
    let of_weakest = weakest.map(|_| Entry::line(colour, 1.4, None, "towards the weakest side"));
    let mut marks: Vec<Mark> = weakest
        .iter()
        .map(|side| line(side, colour, 1.4, None))
        .collect();
    marks.extend([
        markers(&before, GREY, MarkerShape::Circle, 2.5),
        markers(&after, DARK, MarkerShape::Circle, 2.5),
    ]);
    let dots = [
        Entry::new(Sign::Dot { colour: GREY }, "contact points at rest"),
        Entry::new(Sign::Dot { colour: DARK }, "contact points at the end"),
    ];
    let plan = Plan {
        marks,
        reach: [before, after].concat(),
        legend: dots.into_iter().chain(of_weakest).collect(),
    };
    let height_mm = number(1e3 * body.barrier.rest_m, 4);
    let shape = body.kind.name();
    let words = Words {
        name: "body",
        title: format!("A {shape}, its centre of gravity {height_mm} mm above the floor, {motion}"),
        caption: format!(
            "A body ({shape}) under the motion “{motion}”: one realisation. Top: its tilt from where it rested, and its \
             parts to the right (along the motion) and to the back. Bottom: from above, the points on which it is followed, at \
             rest and at the end, and the path of the point below its centre of gravity; it falls most easily \
             towards its weakest side."
        ),
    };
    let samples: Vec<SpatialPoint> = history.iter().map(spatial_point).collect();
    in_space(words, &samples, plan)
}

struct Words {
    name: &'static str,
    title: String,
    caption: String,
}

/// A base from above \[mm\].
struct Plan {
    marks: Vec<Mark>,
    /// All of its points.
    reach: Vec<(f64, f64)>,
    legend: Vec<Entry>,
}

fn in_space(
    words: Words,
    history: &[SpatialPoint],
    plan: Plan,
) -> Result<Option<Figure>, FigureError> {
    let Some((from, to)) = span(history, |point| point.time_s) else {
        return Ok(None);
    };
    let degrees = |of: &dyn Fn(&SpatialPoint) -> f64| {
        degrees(history, (from, to), |point| (point.time_s, of(point)))
    };
    let tilts = [2, 0, 1].map(|part| degrees(&|p| p.tilts_rad[part]));
    let largest = tilts.iter().map(|tilt| peak(tilt)).fold(0.0, f64::max);
    let tilt = Panel {
        marks: tilts
            .iter()
            .enumerate()
            .map(|(index, points)| {
                line(
                    points,
                    curve_style(index).colour,
                    if index == 0 { 1.8 } else { 1.0 },
                    None,
                )
            })
            .collect(),
        layout: stacked(time_axis(from, to), symmetric(largest, "Tilt (deg)"), true),
    };
    let path: Vec<(f64, f64)> = history
        .iter()
        .map(|p| (1e3 * p.base_m[0], 1e3 * p.base_m[1]))
        .collect();
    let (below, of_plan) = from_above(plan, &path);
    let curves = ["tilt", "to the right", "to the back"]
        .into_iter()
        .enumerate();
    let page = Page {
        name: words.name.to_owned(),
        title: plain(&words.title),
        caption: words.caption,
        panels: vec![tilt, below],
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend: curves
            .map(|(index, words)| curve(index, words))
            .chain(of_plan)
            .chain([curve(3, "path of the centre of the base")])
            .collect(),
    };
    draw(page).map(Some)
}

/// A base from above with the path of its centre \[mm\], with equal scales, and its legend.
fn from_above(plan: Plan, path: &[(f64, f64)]) -> (Panel, Vec<Entry>) {
    let all = || plan.reach.iter().chain(path);
    let bounds = |of: fn(&(f64, f64)) -> f64| {
        let values = || all().map(of);
        (
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        )
    };
    let ((left, right), (front, back)) = (bounds(|p| p.0), bounds(|p| p.1));
    // The same scale along both axes.
    let wide_px = panel_width_px(1) - BESIDE_PX;
    let high_px = PANELS_PX[1] - AROUND_PX;
    let scale = (1.1 * (right - left) / wide_px).max(1.1 * (back - front) / high_px);
    let step = Some(round_step(0.2 * scale * high_px));
    let axis = |low: f64, high: f64, pixels: f64, label: &str| {
        let (middle, half) = (0.5 * (low + high), 0.5 * scale * pixels);
        Axis {
            step,
            ..Axis::between(middle - half, middle + half, label)
        }
    };
    let x = axis(left, right, wide_px, "To the right (mm)");
    let y = axis(front, back, high_px, "To the back (mm)");
    let end = path.last().copied().unwrap_or_default();
    let mut marks = plan.marks;
    marks.push(line(path, curve_style(3).colour, 1.2, None));
    marks.push(markers(
        &[end],
        curve_style(3).colour,
        MarkerShape::Circle,
        3.0,
    ));
    let panel = Panel {
        marks,
        layout: stacked(x, y, true),
    };
    (panel, plan.legend)
}

/// Both rotations of a stack against time, and their difference. `None` if nothing moved.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn stack_figure(motion: &str, report: &StackReport) -> Result<Option<Figure>, FigureError> {
    let history = &report.history.samples;
    let Some((from, to)) = span(history, |point| point.time_s) else {
        return Ok(None);
    };
    let degrees = |of: &dyn Fn(&StackPoint) -> f64| {
        degrees(history, (from, to), |point| (point.time_s, of(point)))
    };
    let both = [0, 1].map(|body| degrees(&|p| p.rotations_rad[body]));
    let apart = degrees(&|p| p.rotations_rad[1] - p.rotations_rad[0]);

    let (lower, upper) = (&report.stack.lower, &report.stack.upper);
    let size = |body: &freestand::spatial::StackBody| size_words(body.thickness_m, body.height_m);
    let top = Panel {
        marks: both
            .iter()
            .enumerate()
            .map(|(i, points)| line(points, curve_style(i).colour, 1.5, None))
            .collect(),
        layout: stacked(
            time_axis(from, to),
            symmetric(peak(&both[0]).max(peak(&both[1])), "Rotation (deg)"),
            false,
        ),
    };
    let below = Panel {
        marks: vec![line(&apart, curve_style(2).colour, 1.5, None)],
        layout: stacked(
            time_axis(from, to),
            symmetric(peak(&apart), "Upper − lower (deg)"),
            true,
        ),
    };
    let page = Page {
        name: "stack".to_owned(),
        title: plain(&format!("{} on {}, {motion}", size(upper), size(lower))),
        caption: format!(
            "A body of {} on one of {} under the motion “{motion}”. Top: rotations of both, positive to the right. \
             Middle: when they rock in which pattern; nothing while both are on their edges. Bottom: the difference of \
             the rotations, that of the upper body on the lower one.",
            size(upper),
            size(lower)
        ),
        panels: vec![
            top,
            patterns(&report.history.samples, time_axis(from, to)),
            below,
        ],
        columns: 1,
        row_heights_px: STACK_PX.to_vec(),
        legend: [
            curve(0, "lower body"),
            curve(1, "upper body"),
            curve(2, "upper relative to lower"),
        ]
        .into_iter()
        .chain(PATTERNS.iter().rev().map(|&(_, words, colour)| {
            Entry::new(
                Sign::Shade {
                    colour,
                    opacity: 1.0,
                },
                words,
            )
        }))
        .collect(),
    };
    draw(page).map(Some)
}

/// When a stack moves in which pattern: one row for each.
fn patterns(history: &[StackPoint], x: Axis) -> Panel {
    let one = |(row, (pattern, _, colour)): (usize, &(Pattern, &str, &'static str))| -> Mark {
        let low = row as f64;
        let high = |point: &StackPoint| {
            if point.pattern == *pattern {
                low + 1.0
            } else {
                low
            }
        };
        // A corner before and after each change.
        let mut steps: Vec<(f64, f64)> = Vec::new();
        for point in history {
            let height = high(point);
            match steps.as_slice() {
                [.., last] if last.1 != height => steps.push((point.time_s, last.1)),
                [.., before, last] if before.1 == last.1 => steps.truncate(steps.len() - 1),
                _ => {}
            }
            steps.push((point.time_s, height));
        }
        band(steps.iter().map(|step| (step.0, low, step.1)), colour, 1.0)
    };
    let y = Axis {
        step: Some(1.0),
        ..Axis::between(0.0, PATTERNS.len() as f64, "Pattern")
    };
    let mut layout = stacked(x, y, false);
    layout.suppress_y_ticks = true;
    Panel {
        marks: PATTERNS.iter().enumerate().map(one).collect(),
        layout,
    }
}
