//! One motion: acceleration, velocity, displacement, and the build-up of its energy.

use freestand::G0_M_S2;
use freestand_output::figure::mark::MarkerShape;
use freestand_study::inspect::{Contents, MotionInfo};
use kuva::render::annotations::{ReferenceLine, ShadedRegion};

use freestand::measures::{Integrals, husid, integrals, significant_span_s};
use freestand::motion::Motion;

use freestand_input::quantity::shorten;
use freestand_input::words::{fixed, number, significant};

use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{
    Axis, DARK, curve_style, line, markers, plain, plain_ticks, readable, rule,
};
use freestand_output::figure::time::{stacked_with_title, symmetric, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};

/// Heights of the panels; the lowest includes the label of the axis \[px\].
const PANELS_PX: [f64; 4] = [200.0, 160.0, 166.0, 212.0];
const SHADE: &str = "#0072b2";
const SHADE_OPACITY: f64 = 0.09;

/// The record figure of a motion; `id` is its name.
pub(super) fn record(id: String, words: Words<'_>, motion: &Motion) -> Page {
    let (dt_s, end_s) = (motion.dt_s(), motion.duration_s());
    let Integrals {
        velocity_m_s: velocity,
        displacement_m: displacement,
    } = integrals(motion);
    let accel_g: Vec<f64> = motion.accel_m_s2().iter().map(|&a| a / G0_M_S2).collect();
    let energy: Vec<f64> = husid(motion).iter().map(|share| 100.0 * share).collect();
    let span_s = significant_span_s(motion);
    let x = || time_axis(0.0, end_s);
    let history = |values: &[f64], names, units| history(values, dt_s, span_s, x(), names, units);
    let panels = vec![
        history(&accel_g, ["PGA", "Acceleration"], ["g", "mg", "µg"]),
        history(&velocity, ["PGV", "Velocity"], ["m/s", "mm/s", "µm/s"]),
        history(&displacement, ["PGD", "Displacement"], ["m", "mm", "µm"]),
        energy_panel(&energy, dt_s, span_s, x()),
    ];
    let colour = curve_style(1).colour;

    let legend = vec![
        Entry::new(Sign::Dot { colour }, "largest value"),
        Entry::new(
            Sign::Shade {
                colour: SHADE,
                opacity: SHADE_OPACITY,
            },
            "5–95 % of the Arias intensity",
        ),
    ];
    let done = if words.processing.is_empty() {
        "its samples were not processed".to_owned()
    } else {
        format!("processing: {}", words.processing.join("; "))
    };
    let about = if words.description.is_empty() {
        String::new()
    } else {
        format!(" ({})", words.description)
    };
    let caption = format!(
        "The motion “{}”{about}, {} samples every {} s; {done}. Acceleration, velocity and displacement are the \
         samples and their integrals from rest by the trapezoid rule, without further baseline correction. The \
         lowest panel is the Husid curve, the share of ∫a² dt reached so far; it takes {} s from 5 to 95 %.",
        words.name,
        accel_g.len(),
        number(dt_s, 6),
        fixed(span_s.1 - span_s.0, 2),
    );
    Page {
        name: id,
        title: plain(&format!("Motion {}", shorten(words.name))),
        caption,
        panels,
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend,
    }
}

/// One quantity against time: the name of its peak, its own name, its units.
fn history(
    values: &[f64],
    dt_s: f64,
    span_s: (f64, f64),
    x: Axis,
    names: [&str; 2],
    units: [&'static str; 3],
) -> Panel {
    let [peak_name, name] = names;
    let (at, peak) = largest(values);
    let (factor, unit) = readable(peak, units);
    let time_s = at as f64 * dt_s;
    let points = values
        .iter()
        .enumerate()
        .map(|(i, value)| (i as f64 * dt_s, factor * value));
    let curve = line(
        &thin(points, x.from, x.to),
        curve_style(0).colour,
        0.9,
        None,
    );
    let mark = markers(
        &[(time_s, factor * peak)],
        curve_style(1).colour,
        MarkerShape::Circle,
        3.5,
    );
    let y = symmetric((factor * peak).abs(), &format!("{name} ({unit})"));
    let title = format!(
        "{peak_name} {} {unit} at {} s",
        significant(factor * peak, 4),
        fixed(time_s, decimals(dt_s))
    );
    let y_ticks = plain_ticks(y.to);
    let mut layout = stacked_with_title(x, y, false, title).with_shaded_region(shade(span_s));
    layout.y_tick_format = y_ticks;
    Panel {
        marks: vec![curve, mark],
        layout,
    }
}

/// The first value of the largest magnitude, and its index.
fn largest(values: &[f64]) -> (usize, f64) {
    values
        .iter()
        .enumerate()
        .fold((0, 0.0), |best, (i, &value): (usize, &f64)| {
            if value.abs() > f64::abs(best.1) {
                (i, value)
            } else {
                best
            }
        })
}

/// Decimals that distinguish samples.
fn decimals(dt_s: f64) -> usize {
    (-dt_s.log10()).ceil().clamp(0.0, 4.0) as usize
}

fn shade(span_s: (f64, f64)) -> ShadedRegion {
    ShadedRegion::vertical(span_s.0, span_s.1)
        .with_color(SHADE)
        .with_opacity(SHADE_OPACITY)
}

fn energy_panel(percents: &[f64], dt_s: f64, span_s: (f64, f64), x: Axis) -> Panel {
    let points = percents
        .iter()
        .enumerate()
        .map(|(i, &share)| (i as f64 * dt_s, share));
    let curve = line(
        &thin(points, x.from, x.to),
        curve_style(0).colour,
        1.4,
        None,
    );
    let y = Axis {
        step: Some(25.0),
        ..Axis::between(0.0, 100.0, "Arias intensity (%)")
    };
    let title = format!(
        "D5–95 {} s: {} s to {} s",
        fixed(span_s.1 - span_s.0, 2),
        fixed(span_s.0, 2),
        fixed(span_s.1, 2)
    );
    let x_ticks = plain_ticks(x.to);
    let mut layout = stacked_with_title(x, y, true, title).with_shaded_region(shade(span_s));
    layout.x_tick_format = x_ticks;
    for share in [5.0, 95.0] {
        layout =
            layout.with_reference_line(rule(ReferenceLine::horizontal(share), DARK, 0.8, "2 3"));
    }
    Panel {
        marks: vec![curve],
        layout,
    }
}

/// Draws a motion: acceleration, velocity and displacement with their peaks, and its Husid curve.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn record_figure(words: Words<'_>, motion: &Motion) -> Result<Figure, FigureError> {
    draw(record("record".to_owned(), words, motion))
}

/// The texts of the figure of a motion.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// Its name.
    pub name: &'a str,
    /// Format, component, station; may be empty.
    pub description: &'a str,
    /// What was done to the samples, one step each.
    pub processing: &'a [String],
}

/// The motion as a figure; `None` where it was not kept.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn info_figure(report: &MotionInfo) -> Result<Option<Figure>, FigureError> {
    let Some(motion) = &report.motion else {
        return Ok(None);
    };
    let Contents {
        format,
        component,
        station,
        processing,
        ..
    } = &report.contents;
    let station = station
        .as_ref()
        .map_or(String::new(), |station| format!(", {station}"));
    let words = Words {
        name: &report.name,
        description: &format!("{format}, component {component}{station}"),
        processing,
    };
    record_figure(words, motion).map(Some)
}
