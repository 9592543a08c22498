//! The spectrum of a code, and the accelerations of parts over the height of a building.

use freestand_output::figure::mark::MarkerShape;

use freestand_input::words::number;

use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{
    Axis, DARK, axes, curve_style, line, markers, over_periods, plain, plain_ticks, points,
};
use freestand_output::figure::{Figure, FigureError};

use freestand_study::target::{CodeSpectrumReport, PartsLevel};

const PANEL_PX: f64 = 330.0;

/// Draws the spectrum of a code, and the accelerations of parts over the height of a building.
///
/// # Errors
/// The error of the plot library.
pub fn code_spectrum_figure(report: &CodeSpectrumReport) -> Result<Figure, FigureError> {
    let mut panels = vec![spectrum_panel(report)];
    let mut legend = vec![line_entry(0, "horizontal")];
    if report.vertical_sa_g.is_some() {
        legend.push(line_entry(1, "vertical"));
    }
    if !report.corner_periods_s.is_empty() {
        legend.push(Entry::new(Sign::Dot { colour: DARK }, "corner"));
    }
    let zero = report
        .periods_s
        .iter()
        .zip(&report.sa_g)
        .find(|(period, _)| **period == 0.0);
    let zero = zero.map_or_else(String::new, |(_, sa)| {
        format!(" At T = 0 it is {} g.", number(*sa, 4))
    });
    let mut caption = format!(
        "Elastic acceleration spectrum, 5 % damping: {}.{zero}",
        report.target.one_line()
    );
    if let Some(parts) = &report.parts {
        panels.push(parts_panel(&parts.levels));
        caption.push_str(&format!(
            " The right panel shows the acceleration of a rigid part by {}.",
            parts.clause
        ));
    }
    let columns = panels.len();
    draw(Page {
        name: "spectrum".to_owned(),
        title: plain(&report.target.one_line()),
        caption,
        panels,
        columns,
        row_heights_px: vec![PANEL_PX],
        legend,
    })
}

fn line_entry(index: usize, words: &str) -> Entry {
    let style = curve_style(index);
    Entry::line(style.colour, 2.2, style.dash, words)
}

fn spectrum_panel(report: &CodeSpectrumReport) -> Panel {
    let above_zero = |values: &[f64]| -> Vec<(f64, f64)> {
        points(&report.periods_s, values)
            .filter(|point| point.0 > 0.0)
            .collect()
    };
    let drawn = |index: usize, curve: &[(f64, f64)]| {
        let style = curve_style(index);
        line(curve, style.colour, 2.2, style.dash)
    };
    let curve = above_zero(&report.sa_g);
    let mut marks = vec![drawn(0, &curve)];
    let mut highest = report.sa_g.iter().copied().fold(0.0, f64::max);
    if let Some(vertical) = &report.vertical_sa_g {
        marks.push(drawn(1, &above_zero(vertical)));
        highest = vertical.iter().copied().fold(highest, f64::max);
    }
    let (mut from, mut to) = (
        curve.first().map_or(0.05, |point| point.0),
        curve.last().map_or(5.0, |point| point.0),
    );
    if from >= to {
        (from, to) = (0.5 * from, 2.0 * from);
    }
    let corners: Vec<(f64, f64)> = points(&report.corner_periods_s, &report.corners_g)
        .filter(|(t, _)| (from..=to).contains(t))
        .collect();
    if !corners.is_empty() {
        marks.push(markers(&corners, DARK, MarkerShape::Circle, 3.6));
    }
    let y = Axis::from_zero(1.02 * highest, "Spectral acceleration (g)");
    let top = y.to;
    let layout = over_periods(axes(Axis::between(from, to, "Period (s)"), y), top);
    Panel { marks, layout }
}

fn parts_panel(levels: &[PartsLevel]) -> Panel {
    let points: Vec<(f64, f64)> = levels
        .iter()
        .map(|level| (level.floor_acceleration_g, level.level_ratio))
        .collect();
    let highest = points.iter().map(|point| point.0).fold(0.0, f64::max);
    let style = curve_style(2);
    let marks = vec![
        line(&points, style.colour, 2.2, None),
        markers(&points, style.colour, style.marker, 3.2),
    ];
    let x = Axis::from_zero(1.02 * highest, "Acceleration of a rigid part (g)");
    let x_ticks = plain_ticks(x.to);
    let y = Axis {
        step: Some(0.2),
        ..Axis::between(0.0, 1.0, "Height of the floor z/h")
    };
    let mut layout = axes(x, y);
    layout.x_tick_format = x_ticks;
    Panel { marks, layout }
}
