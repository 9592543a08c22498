//! The spectrum of a code, and the accelerations of parts over the height of a building.

use kuva::plot::scatter::MarkerShape;

use freestand_input::words::number;

use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, DARK, axes, curve_style, line, markers, plain, plain_ticks};
use freestand_output::figure::{Figure, FigureError};

const PANEL_PX: f64 = 330.0;

/// A spectrum to draw.
#[derive(Debug, Clone, PartialEq)]
pub struct CodePicture<'a> {
    /// The code with its parameters, on one line.
    pub title: &'a str,
    /// Periods, ascending \[s\].
    pub periods_s: &'a [f64],
    /// Spectral accelerations at them \[g\].
    pub sa_g: &'a [f64],
    /// Vertical spectral accelerations, if the code has them \[g\].
    pub vertical_sa_g: Option<&'a [f64]>,
    /// Periods between the branches, with their accelerations \[s, g\].
    pub corners: &'a [(f64, f64)],
    /// The clause for parts, and the floor acceleration of each level ratio \[–, g\].
    pub parts: Option<(&'a str, &'a [(f64, f64)])>,
}

/// Acceleration against period; in a second panel, if there is a clause, floor accelerations over
/// the height.
pub(crate) fn code_spectrum(picture: &CodePicture<'_>) -> Page {
    let mut panels = vec![spectrum_panel(picture)];
    let mut legend = vec![line_entry(0, "horizontal")];
    if picture.vertical_sa_g.is_some() {
        legend.push(line_entry(1, "vertical"));
    }
    if !picture.corners.is_empty() {
        legend.push(Entry { sign: Sign::Dot { colour: DARK }, words: "corner".into() });
    }
    let zero = picture.periods_s.iter().zip(picture.sa_g).find(|(period, _)| **period == 0.0);
    let zero = zero.map_or_else(String::new, |(_, sa)| format!(" At T = 0 it is {} g.", number(*sa, 4)));
    let mut caption = format!("Elastic acceleration spectrum, 5 % damping: {}.{zero}", picture.title);
    if let Some((clause, levels)) = picture.parts {
        panels.push(parts_panel(levels));
        caption.push_str(&format!(" The right panel shows the acceleration of a rigid part by {clause}."));
    }
    let columns = panels.len();
    Page {
        name: "spectrum".to_owned(),
        title: plain(picture.title),
        caption,
        panels,
        columns,
        row_heights_px: vec![PANEL_PX],
        legend,
    }
}

fn line_entry(index: usize, words: &str) -> Entry {
    let style = curve_style(index);
    Entry { sign: Sign::Line { colour: style.colour, width_px: 2.2, dash: style.dash }, words: words.into() }
}

fn spectrum_panel(picture: &CodePicture<'_>) -> Panel {
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        picture.periods_s.iter().copied().zip(values.iter().copied()).filter(|point| point.0 > 0.0).collect()
    };
    let curve = points(picture.sa_g);
    let mut plots = vec![line(&curve, curve_style(0).colour, 2.2, curve_style(0).dash)];
    let mut highest = picture.sa_g.iter().copied().fold(0.0, f64::max);
    if let Some(vertical) = picture.vertical_sa_g {
        plots.push(line(&points(vertical), curve_style(1).colour, 2.2, curve_style(1).dash));
        highest = vertical.iter().copied().fold(highest, f64::max);
    }
    let (mut from, mut to) = (curve.first().map_or(0.05, |point| point.0), curve.last().map_or(5.0, |point| point.0));
    if from >= to {
        (from, to) = (0.5 * from, 2.0 * from);
    }
    let drawn: Vec<(f64, f64)> = picture.corners.iter().copied().filter(|(t, _)| (from..=to).contains(t)).collect();
    if !drawn.is_empty() {
        plots.push(markers(&drawn, DARK, MarkerShape::Circle, 3.6));
    }
    let x = Axis { from, to, step: None, label: "Period (s)".into() };
    let y = Axis::from_zero(1.02 * highest, "Spectral acceleration (g)");
    let y_ticks = plain_ticks(y.to);
    let mut layout = axes(x, y).with_log_x();
    layout.x_tick_format = plain_ticks(0.0);
    layout.y_tick_format = y_ticks;
    Panel { plots, layout }
}

fn parts_panel(levels: &[(f64, f64)]) -> Panel {
    let points: Vec<(f64, f64)> = levels.iter().map(|&(level, accel_g)| (accel_g, level)).collect();
    let highest = points.iter().map(|point| point.0).fold(0.0, f64::max);
    let style = curve_style(2);
    let plots = vec![line(&points, style.colour, 2.2, None), markers(&points, style.colour, style.marker, 3.2)];
    let x = Axis::from_zero(1.02 * highest, "Acceleration of a rigid part (g)");
    let x_ticks = plain_ticks(x.to);
    let y = Axis { from: 0.0, to: 1.0, step: Some(0.2), label: "Height of the floor z/h".into() };
    let mut layout = axes(x, y);
    layout.x_tick_format = x_ticks;
    Panel { plots, layout }
}

/// Draws the spectrum of a code, and the accelerations of parts over the height of a building.
///
/// # Errors
/// The error of the plot library.
pub fn code_spectrum_figure(picture: &CodePicture<'_>) -> Result<Figure, FigureError> {
    draw(code_spectrum(picture))
}
