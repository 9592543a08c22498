//! The style of all figures: colours, lines, markers, sizes.

use std::sync::Arc;

use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{Layout, TickAlign, TickFormat};

use freestand_input::words::number;

use super::mark::{Mark, MarkerShape};

/// Width of every figure \[px\]. At 180 mm in print a pixel is 0.64 pt, so that [`TEXT_PX`] is 8.3
/// pt.
pub const WIDTH_PX: f64 = 800.0;
/// Size of the smallest text \[px\].
pub const TEXT_PX: u32 = 13;
/// Room above the axes for a panel's title \[px\].
pub const TITLE_PX: f64 = 34.0;
/// Room below the axes for ticks and label \[px\].
pub const LABELS_PX: f64 = 46.0;
/// Grey for what is in the background.
pub const GREY: &str = "#9a9a9a";
/// Dark grey of labels inside a panel.
pub const DARK: &str = "#444444";
/// Opacity of the 16–84 % bands.
pub const BAND_OPACITY: f64 = 0.14;

/// Colours of Okabe and Ito (2008), without the yellow, which is too light for lines on white
/// paper.
const COLOURS: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000",
];
/// Dashes and gaps \[px\].
const DASHES: [Option<&str>; 5] = [
    None,
    Some("10 6"),
    Some("10 5 1.5 5"),
    Some("4 5"),
    Some("12 5 1.5 5 1.5 5"),
];
const MARKERS: [MarkerShape; 6] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Triangle,
    MarkerShape::Diamond,
    MarkerShape::TriangleDown,
    MarkerShape::Plus,
];

/// How one of several curves is drawn. Colour, dashes and marker all differ, so that colour is
/// never the only difference.
#[derive(Debug, Clone, Copy)]
pub struct CurveStyle {
    /// Colour.
    pub colour: &'static str,
    /// Dashes; `None`: a solid line.
    pub dash: Option<&'static str>,
    /// Marker.
    pub marker: MarkerShape,
}

/// The style of curve `index`; the first 210 styles are different.
pub fn curve_style(index: usize) -> CurveStyle {
    CurveStyle {
        colour: COLOURS[index % COLOURS.len()],
        dash: DASHES[index % DASHES.len()],
        marker: MARKERS[index % MARKERS.len()],
    }
}

/// A line through points.
pub fn line(
    points: &[(f64, f64)],
    colour: &'static str,
    width_px: f64,
    dash: Option<&'static str>,
) -> Mark {
    Mark::Line {
        points: points.to_vec(),
        colour,
        width_px,
        dash,
    }
}

/// Markers at points.
pub fn markers(
    points: &[(f64, f64)],
    colour: &'static str,
    shape: MarkerShape,
    size_px: f64,
) -> Mark {
    Mark::Markers {
        points: points.to_vec(),
        colour,
        shape,
        size_px,
    }
}

/// The area between two curves: abscissa, lower and upper ordinate of each point.
pub fn band(
    points: impl IntoIterator<Item = (f64, f64, f64)>,
    colour: &'static str,
    opacity: f64,
) -> Mark {
    Mark::Band {
        points: points.into_iter().collect(),
        colour,
        opacity,
    }
}

/// Outlines of markers at points: white on top of coloured.
pub fn hollow(
    points: &[(f64, f64)],
    colour: &'static str,
    shape: MarkerShape,
    size_px: f64,
) -> [Mark; 2] {
    [
        markers(points, colour, shape, size_px),
        markers(points, "#ffffff", shape, size_px - 1.8),
    ]
}

/// The points of a curve, from its two columns.
pub fn points<'v>(x: &'v [f64], y: &'v [f64]) -> impl Iterator<Item = (f64, f64)> + 'v {
    x.iter().copied().zip(y.iter().copied())
}

/// A straight line over the whole panel.
pub fn rule(at: ReferenceLine, colour: &str, width_px: f64, dash: &str) -> ReferenceLine {
    at.with_color(colour)
        .with_stroke_width(width_px)
        .with_dasharray(dash)
}

/// A layout over periods on a logarithmic scale, with plain numbers on both axes; `top`: the end of the other axis.
pub fn over_periods(layout: Layout, top: f64) -> Layout {
    let mut layout = layout.with_log_x();
    layout.x_tick_format = plain_ticks(0.0);
    layout.y_tick_format = plain_ticks(top);
    layout
}

/// Axes over exactly these ranges, without a legend and with the text sizes of all figures.
pub fn axes(x: Axis, y: Axis) -> Layout {
    let mut layout = Layout::new((x.from, x.to), (y.from, y.to))
        .with_x_label(x.label)
        .with_y_label(y.label)
        .with_x_axis_min(x.from)
        .with_x_axis_max(x.to)
        .with_y_axis_min(y.from)
        .with_y_axis_max(y.to)
        .with_title_size(TEXT_PX + 2)
        .with_label_size(TEXT_PX + 1)
        .with_tick_size(TEXT_PX)
        .with_body_size(TEXT_PX)
        .with_grid_line_width(0.5)
        .with_box_axes()
        .with_tick_align(TickAlign::Inside)
        .with_force_margins_y(TITLE_PX, LABELS_PX);
    if let Some(step) = x.step {
        layout = layout.with_x_tick_step(step);
    }
    if let Some(step) = y.step {
        layout = layout.with_y_tick_step(step);
    }
    layout.show_legend = false;
    layout
}

/// One axis: its range, the distance between its ticks, and its label with the unit.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
    /// Distance between the ticks; `None`: chosen by the plot library.
    pub step: Option<f64>,
    /// Quantity and unit.
    pub label: String,
}

impl Axis {
    /// An axis between two values, with ticks where they fit.
    pub fn between(from: f64, to: f64, label: &str) -> Self {
        Self {
            from,
            to,
            step: None,
            label: label.into(),
        }
    }

    /// An axis from 0 to a round number that is not below `max`.
    pub fn from_zero(max: f64, label: &str) -> Self {
        let max = if max > 0.0 && max.is_finite() {
            max
        } else {
            1.0
        };
        let step = round_step(max / 5.0);
        Self {
            from: 0.0,
            to: step * (max / step - 1e-9).ceil(),
            step: Some(step),
            label: label.into(),
        }
    }

    /// An axis from `from` to `to` with a margin at both ends, even if both are equal.
    pub fn around(from: f64, to: f64, label: &str) -> Self {
        let span = if to > from {
            to - from
        } else {
            from.abs().max(1.0)
        };
        Self {
            from: from - 0.04 * span,
            to: to + 0.04 * span,
            step: Some(round_step(span / 5.0)),
            label: label.into(),
        }
    }
}

/// The smallest of 1, 2, 2.5, 5, 10 times a power of ten that is not below `step`.
pub fn round_step(step: f64) -> f64 {
    let decade = 10f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 2.5, 5.0]
        .into_iter()
        .find(|f| f * decade >= step * (1.0 - 1e-9))
        .unwrap_or(10.0);
    factor * decade
}

/// Text that the plot library shows unchanged: `$` starts a formula there, and control characters
/// break an SVG.
pub fn plain(text: &str) -> String {
    text.chars()
        .filter(|c| !c.is_control())
        .collect::<String>()
        .replace('$', "\\$")
}

/// Tick labels of an axis over `span` in plain digits, `0.0125` and not `0.013` or `1.25e-2`.
pub fn plain_ticks(span: f64) -> TickFormat {
    TickFormat::Custom(Arc::new(move |value| {
        // The zero of an axis may be a rounding error.
        if value.abs() < 1e-9 * span {
            "0".to_owned()
        } else {
            number(value, 4)
        }
    }))
}

/// A factor and a unit that make values up to `largest` easy to read; `units` are the unit, its
/// thousandth and its millionth.
pub fn readable(largest: f64, units: [&'static str; 3]) -> (f64, &'static str) {
    let power = [0.02, 0.02e-3]
        .iter()
        .filter(|&&least| largest != 0.0 && largest.abs() < least)
        .count();
    (1e3_f64.powi(power as i32), units[power.min(2)])
}

/// Labels only at 0.1, 1, 10: those at 2 and 5 would touch in a narrow panel. Their grid lines
/// stay.
pub fn decades() -> TickFormat {
    TickFormat::Custom(Arc::new(|v| {
        let decade = v.log10();
        if (decade - decade.round()).abs() < 1e-6 {
            TickFormat::Auto.format(v)
        } else {
            String::new()
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_not_too_small() {
        for (step, expected) in [
            (0.11, 0.2),
            (0.2, 0.2),
            (0.21, 0.25),
            (3.0, 5.0),
            (7.0, 10.0),
            (1.0, 1.0),
        ] {
            assert!(
                (round_step(step) / expected - 1.0f64).abs() < 1e-12,
                "{step}"
            );
        }
    }

    #[test]
    fn small_values_get_a_small_unit() {
        let unit = |largest| readable(largest, ["m", "mm", "µm"]);
        assert_eq!((unit(0.3), unit(0.0)), ((1.0, "m"), (1.0, "m")));
        assert_eq!(
            (unit(-0.019), unit(1e-5), unit(1e-9)),
            ((1e3, "mm"), (1e6, "µm"), (1e6, "µm"))
        );
    }

    #[test]
    fn axes_hold_their_data_even_without_any() {
        assert_eq!(Axis::from_zero(4.1, "").to, 5.0);
        assert_eq!(Axis::from_zero(4.0, "").to, 4.0);
        assert_eq!(Axis::from_zero(0.0, "").to, 1.0);
        assert!(Axis::around(2.0, 2.0, "").to > 2.0);
    }

    #[test]
    fn curves_differ_in_more_than_colour() {
        for i in 0..5 {
            for j in 0..i {
                let (a, b) = (curve_style(i), curve_style(j));
                assert!(a.colour != b.colour && a.dash != b.dash && a.marker != b.marker);
            }
        }
    }
}
