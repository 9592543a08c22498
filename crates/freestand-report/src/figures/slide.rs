//! One sliding history: the slide with the clearances, and the motion of the floor.

use freestand::G0_M_S2;
use freestand::block::Block;
use kuva::render::annotations::ReferenceLine;

use freestand::respond::SlidePoint;
use freestand::sliding::PlanePoint;

use freestand_input::words::number;
use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, DARK, curve_style, line, plain, rule};
use freestand_output::figure::time::{peak, span, stacked, symmetric, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};
use freestand_study::shape::size_words;
use freestand_study::sliding::Surface;

use super::history::accel_panel;
use super::kind::FigureKind;

/// Heights of the two panels \[px\].
const PANELS_PX: [f64; 2] = [230.0, 190.0];
/// A clearance further away than this multiple of the largest slide is not drawn: it would flatten
/// the curve.
const FARTHEST_RATIO: f64 = 3.0;

/// The history of an object that slides under one motion: its slide, with the clearances on both
/// sides, and the motion; `None` without a history.
///
/// # Errors
/// A figure that cannot be drawn.
pub fn slide_figure(
    motion: &str,
    block: &Block,
    surface: &Surface,
    history: &[SlidePoint],
) -> Result<Option<Figure>, FigureError> {
    let Some(times) = span(history, |point| point.time_s) else {
        return Ok(None);
    };
    let curve = |of: fn(&SlidePoint) -> f64| {
        thin(history.iter().map(|p| (p.time_s, of(p))), times.0, times.1)
    };
    let curves = Curves {
        times,
        slides: vec![("slide", curve(|p| 1e3 * p.slide_m))],
        accels: vec![curve(|p| p.base_accel_m_s2 / G0_M_S2)],
    };
    figure_of(motion, block, surface, &curves, "positive to the right").map(Some)
}

/// As [`slide_figure`], under both components: along both axes of the object.
///
/// # Errors
/// A figure that cannot be drawn.
pub fn plane_slide_figure(
    motion: &str,
    block: &Block,
    surface: &Surface,
    history: &[PlanePoint],
) -> Result<Option<Figure>, FigureError> {
    let Some(times) = span(history, |point| point.time_s) else {
        return Ok(None);
    };
    let curve = |of: fn(&PlanePoint) -> f64| {
        thin(history.iter().map(|p| (p.time_s, of(p))), times.0, times.1)
    };
    let curves = Curves {
        times,
        slides: vec![
            ("slide to the right", curve(|p| 1e3 * p.place_m[0])),
            ("to the back", curve(|p| 1e3 * p.place_m[1])),
        ],
        accels: vec![
            curve(|p| p.base_accel_m_s2[0] / G0_M_S2),
            curve(|p| p.base_accel_m_s2[1] / G0_M_S2),
        ],
    };
    let directions = "to the right and to the back of the object";
    figure_of(motion, block, surface, &curves, directions).map(Some)
}

/// A history against time.
struct Curves {
    /// Its first and its last time \[s\].
    times: (f64, f64),
    /// What each slide is, and the slide \[mm\].
    slides: Vec<(&'static str, Vec<(f64, f64)>)>,
    /// The motion of the floor in the same directions \[g\].
    accels: Vec<Vec<(f64, f64)>>,
}

fn figure_of(
    motion: &str,
    block: &Block,
    surface: &Surface,
    curves: &Curves,
    directions: &str,
) -> Result<Figure, FigureError> {
    let (from, to) = curves.times;
    let travel_mm = curves
        .slides
        .iter()
        .fold(0.0, |most: f64, (_, slide)| most.max(peak(slide)));
    let sides = [
        ("left", -1.0, surface.clearance.left_m),
        ("right", 1.0, surface.clearance.right_m),
    ];
    let given: Vec<(&str, f64)> = sides
        .into_iter()
        .filter_map(|(name, sign, m)| m.map(|m| (name, sign * 1e3 * m)))
        .collect();
    let near =
        |&&(_, mm): &&(&str, f64)| mm.abs() <= FARTHEST_RATIO * travel_mm.max(f64::MIN_POSITIVE);
    let shown: Vec<f64> = given.iter().filter(near).map(|&(_, mm)| mm).collect();
    let reach = shown.iter().fold(travel_mm, |m, mm| m.max(mm.abs()));
    let mut above = stacked(time_axis(from, to), symmetric(reach, "Slide (mm)"), false);
    for &mm in &shown {
        above = above.with_reference_line(rule(ReferenceLine::horizontal(mm), DARK, 1.2, "5 3"));
    }
    let mut legend: Vec<Entry> = curves
        .slides
        .iter()
        .enumerate()
        .map(|(at, (name, _))| Entry::line(curve_style(at).colour, 1.6, None, *name))
        .collect();
    if !shown.is_empty() {
        legend.push(Entry::line(DARK, 1.2, Some("5 3"), "clearance"));
    }
    let below = accels_panel(&curves.accels, time_axis(from, to));
    let size = size_words(block.thickness_m(), block.height_m());
    let clearances: Vec<String> = given
        .iter()
        .map(|(name, mm)| format!("{} mm to the {name}", number(mm.abs(), 4)))
        .collect();
    let room = if clearances.is_empty() {
        String::new()
    } else {
        format!(" Clearance: {}.", clearances.join(", "))
    };
    let page = Page {
        name: FigureKind::History.name(),
        title: plain(&format!("Sliding history: {size}, {motion}")),
        caption: format!(
            "An object of {size} that slides under the motion “{motion}”. Top: slide relative to the floor, \
             {directions}.{room} Bottom: acceleration of the floor.",
        ),
        panels: vec![
            Panel {
                marks: curves
                    .slides
                    .iter()
                    .enumerate()
                    .map(|(at, (_, slide))| line(slide, curve_style(at).colour, 1.6, None))
                    .collect(),
                layout: above,
            },
            below,
        ],
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend,
    };
    draw(page)
}

/// One component is grey, as in every history; two have the colours of the slides in their directions.
fn accels_panel(accels: &[Vec<(f64, f64)>], x: Axis) -> Panel {
    const LABEL: &str = "Floor accel. (g)";
    if let [accel] = accels {
        return accel_panel(accel, x, LABEL, true);
    }
    let most = accels
        .iter()
        .fold(0.0, |most: f64, accel| most.max(peak(accel)));
    Panel {
        marks: accels
            .iter()
            .enumerate()
            .map(|(at, accel)| line(accel, curve_style(at).colour, 0.9, None))
            .collect(),
        layout: stacked(x, symmetric(most, LABEL), true),
    }
}
