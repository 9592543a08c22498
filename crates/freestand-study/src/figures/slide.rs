//! One sliding history: the slide with the clearances, and the motion of the floor.

use freestand::G0_M_S2;
use freestand::block::Block;
use kuva::render::annotations::ReferenceLine;

use freestand::respond::SlidePoint;

use crate::sliding::Surface;
use freestand_input::words::number;
use freestand_output::figure::legend::Sign;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{DARK, curve_style, line, plain};
use freestand_output::figure::time::{stacked, symmetric, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};

use super::FigureKind;
use super::history::entry;

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
    let (Some(first), Some(last)) = (history.first(), history.last()) else {
        return Ok(None);
    };
    let (from, to) = (first.time_s, last.time_s);
    if to <= from {
        return Ok(None);
    }
    let slide = thin(
        history.iter().map(|p| (p.time_s, 1e3 * p.slide_m)),
        from,
        to,
    );
    let accel = thin(
        history
            .iter()
            .map(|p| (p.time_s, p.base_accel_m_s2 / G0_M_S2)),
        from,
        to,
    );
    let largest = |points: &[(f64, f64)]| points.iter().fold(0.0f64, |m, p| m.max(p.1.abs()));
    let travel_mm = largest(&slide);
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
        let mark = ReferenceLine::horizontal(mm)
            .with_color(DARK)
            .with_stroke_width(1.2)
            .with_dasharray("5 3");
        above = above.with_reference_line(mark);
    }
    let mut legend = vec![entry(
        Sign::Line {
            colour: curve_style(0).colour,
            width_px: 1.6,
            dash: None,
        },
        "slide",
    )];
    if !shown.is_empty() {
        legend.push(entry(
            Sign::Line {
                colour: DARK,
                width_px: 1.2,
                dash: Some("5 3"),
            },
            "clearance",
        ));
    }
    let below = Panel {
        plots: vec![line(&accel, "#555555", 0.9, None)],
        layout: stacked(
            time_axis(from, to),
            symmetric(largest(&accel), "Floor accel. (g)"),
            true,
        ),
    };
    let size = format!(
        "{} mm × {} m",
        number(1e3 * block.thickness_m(), 4),
        number(block.height_m(), 4)
    );
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
            "An object of {size} that slides under the motion “{motion}”. Top: slide relative to the floor, positive \
             to the right.{room} Bottom: acceleration of the floor.",
        ),
        panels: vec![
            Panel {
                plots: vec![line(&slide, curve_style(0).colour, 1.6, None)],
                layout: above,
            },
            below,
        ],
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend,
    };
    draw(page).map(Some)
}
