//! Response spectra of the floors of a building, a panel for each damping.

use freestand_input::words::number;
use freestand_study::floor::SpectraReport;

use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, columns, draw};
use freestand_output::figure::style::{Axis, axes, curve_style, decades, line, plain, points};
use freestand_output::figure::{Figure, FigureError};

const PANEL_PX: f64 = 330.0;
/// The largest number of levels that is drawn, from the lowest to the highest.
const MOST_LEVELS: usize = 6;

/// Draws response spectra of floors; `motions` is the number of motions that the medians are over.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn floor_response_figure(
    report: &SpectraReport,
    height_m: f64,
    motions: usize,
) -> Result<Figure, FigureError> {
    let drawn = drawn_levels(report.levels.len());
    let positive = || report.periods_s.iter().copied().filter(|&t| t > 0.0);
    let (mut from, mut to) = (
        positive().fold(f64::INFINITY, f64::min),
        positive().fold(0.0, f64::max),
    );
    if from >= to {
        (from, to) = (0.05, 5.0);
    }
    let panel = |(damping, &ratio): (usize, &f64)| {
        let mut highest = 0.0f64;
        let mut marks = Vec::new();
        for (style, &index) in drawn.iter().enumerate() {
            let Some(psa) = report
                .levels
                .get(index)
                .and_then(|level| level.psa_g.get(damping))
            else {
                continue;
            };
            let mut points: Vec<(f64, f64)> = points(&report.periods_s, psa)
                .filter(|point| point.0 > 0.0)
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            highest = points.iter().map(|point| point.1).fold(highest, f64::max);
            let style = curve_style(style);
            marks.push(line(&points, style.colour, 2.0, style.dash));
        }
        let x = Axis::between(from, to, "Period (s)");
        let y = Axis::from_zero(1.02 * highest, "Spectral acceleration (g)");
        let title = format!("damping {} %", number(100.0 * ratio, 4));
        let mut layout = axes(x, y).with_title(plain(&title)).with_log_x();
        layout.x_tick_format = decades();
        Panel { marks, layout }
    };
    let panels: Vec<Panel> = report
        .damping_ratios
        .iter()
        .enumerate()
        .map(panel)
        .collect();
    let columns = columns(panels.len());
    let legend = drawn.iter().enumerate().filter_map(|(style, &index)| {
        let ratio = report.levels.get(index)?.level_ratio;
        let style = curve_style(style);
        let words = match ratio {
            0.0 => "ground".to_owned(),
            1.0 => "roof".to_owned(),
            _ => format!("{} m", number(ratio * height_m, 4)),
        };
        Some(Entry::line(style.colour, 2.0, style.dash, words))
    });
    let of = if motions > 1 {
        format!("median over {motions} motions")
    } else {
        "one motion".to_owned()
    };
    draw(Page {
        name: "spectra".to_owned(),
        title: "Response spectra of the floors".to_owned(),
        caption: format!(
            "Pseudo-acceleration of a linear oscillator on the ground and on floors against its period, {of}; of \
             two components, the largest over all directions."
        ),
        legend: legend.collect(),
        row_heights_px: vec![PANEL_PX; panels.len().div_ceil(columns)],
        panels,
        columns,
    })
}

/// The drawn levels of `count`: all, or an even selection from the first to the last.
fn drawn_levels(count: usize) -> Vec<usize> {
    if count <= MOST_LEVELS {
        return (0..count).collect();
    }
    (0..MOST_LEVELS)
        .map(|i| i * (count - 1) / (MOST_LEVELS - 1))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_and_the_last_level_are_drawn() {
        assert_eq!(drawn_levels(2), [0, 1]);
        assert_eq!(drawn_levels(31), [0, 6, 12, 18, 24, 30]);
    }
}
