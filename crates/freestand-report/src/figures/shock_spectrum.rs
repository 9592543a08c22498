//! Shock response spectra, and a damage boundary with a demand, on logarithmic axes.

use freestand::G0_M_S2;
use freestand::damage_boundary::KNEE_RATIO;
use freestand::shock_response::ResponseKind;
use freestand_input::words::number;
use freestand_output::figure::mark::{Mark, MarkerShape};
use freestand_study::shock::{BoundaryTests, DamageBoundaryReport};
use freestand_study::shock_spectrum::ShockSpectrumReport;

use freestand_input::quantity::shorten;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{
    Axis, DARK, axes, curve_style, hollow, line, markers, plain, plain_ticks,
};
use freestand_output::figure::{Figure, FigureError};

/// One shock response spectrum: frequency \[Hz\] and value, in the unit of the axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShockCurve {
    /// Its name.
    pub name: String,
    /// Frequency and value.
    pub points: Vec<(f64, f64)>,
}

/// The contents of a figure of a damage boundary; velocity changes in m/s, accelerations in g.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoundaryPicture {
    /// V_c and A_c.
    pub corner: (f64, f64),
    /// The exact boundary of an undamped component, from the left.
    pub curve: Vec<(f64, f64)>,
    /// Shocks of a test that were survived.
    pub survived: Vec<(f64, f64)>,
    /// Shocks that damaged the object.
    pub damaged: Vec<(f64, f64)>,
    /// Velocity change and peak of the demand.
    pub demand: (f64, f64),
    /// Whether it is within the boundary.
    pub safe: bool,
}

/// Points of the curve of a boundary up to its knee.
const CURVE_POINTS: u32 = 200;
/// Height of the panel \[px\].
const PANEL_PX: f64 = 420.0;
/// The largest number of curves that the legend names; it states how many more there are.
const MAX_NAMED: usize = 12;
/// The number of decades shown below the largest value: lower values are rounding errors.
const DECADES: f64 = 6.0;

/// Whole decades around positive values.
fn decades(values: impl Iterator<Item = f64>, label: &str) -> Axis {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for value in values.filter(|value| *value > 0.0 && value.is_finite()) {
        (least, most) = (least.min(value), most.max(value));
    }
    if most == 0.0 {
        (least, most) = (1.0, 10.0);
    }
    let to = most.log10().ceil();
    let from = least.log10().floor().max(to - DECADES).min(to - 1.0);
    Axis::between(10f64.powf(from), 10f64.powf(to), label)
}

fn panel(marks: Vec<Mark>, x: Axis, y: Axis) -> Panel {
    let mut layout = axes(x, y).with_log_scale().with_force_margins(76.0, 18.0);
    layout.x_tick_format = plain_ticks(0.0);
    layout.y_tick_format = plain_ticks(0.0);
    Panel { marks, layout }
}

/// Draws shock response spectra over frequency; `label` is that of the values, with their unit.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub(super) fn shock_spectrum_figure(
    title: &str,
    label: &str,
    curves: &[ShockCurve],
) -> Result<Figure, FigureError> {
    let of = |pick: fn(&(f64, f64)) -> f64| {
        curves
            .iter()
            .flat_map(move |one| one.points.iter().map(pick))
    };
    let y = decades(of(|p| p.1), label);
    let x = {
        let (from, to) = of(|p| p.0).fold((f64::INFINITY, 0.0f64), |(from, to), f| {
            (from.min(f), to.max(f))
        });
        let (from, to) = if from < to {
            (from, to)
        } else {
            (0.5 * to, 2.0 * to)
        };
        Axis::between(from, to, "Frequency of the component (Hz)")
    };
    let mut marks = Vec::new();
    let mut legend = Vec::new();
    for (i, curve) in curves.iter().enumerate() {
        let style = curve_style(i);
        let mut points: Vec<(f64, f64)> = curve
            .points
            .iter()
            .copied()
            .filter(|p| p.1 >= y.from)
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        marks.push(line(&points, style.colour, 2.0, style.dash));
        if points.len() <= MAX_NAMED {
            marks.push(markers(&points, style.colour, style.marker, 3.5));
        }
        if i < MAX_NAMED {
            legend.push(Entry::line(
                style.colour,
                2.0,
                style.dash,
                shorten(&curve.name),
            ));
        }
    }
    if curves.len() > MAX_NAMED {
        let words = format!("and {} more", curves.len() - MAX_NAMED);
        legend.push(Entry::line(DARK, 1.0, Some("2 3"), words));
    }
    draw(Page {
        name: "shock_spectrum".to_owned(),
        title: plain(title),
        caption: format!("{label} of damped oscillators under the shock, against their frequency."),
        panels: vec![panel(marks, x, y)],
        columns: 1,
        row_heights_px: vec![PANEL_PX],
        legend,
    })
}

/// Draws a damage boundary and a demand.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub(super) fn damage_boundary_figure(picture: &BoundaryPicture) -> Result<Figure, FigureError> {
    let (v_c, a_c) = picture.corner;
    let (v, a) = picture.demand;
    let points = || picture.survived.iter().chain(&picture.damaged);
    let xs = [v_c / 2.0, v_c * 5.0, v / 1.5, v * 1.5]
        .into_iter()
        .chain(points().map(|p| p.0));
    let ys = [a_c / 2.0, a_c * 10.0, a / 1.5, a * 1.5]
        .into_iter()
        .chain(points().map(|p| p.1));
    let (x, y) = (
        decades(xs, "Velocity change (m/s)"),
        decades(ys, "Peak acceleration (g)"),
    );
    let corner = [(v_c, y.to), (v_c, a_c), (x.to, a_c)];
    let mut curve: Vec<(f64, f64)> = picture
        .curve
        .iter()
        .copied()
        .filter(|p| p.1 <= y.to && p.0 <= x.to)
        .collect();
    curve.push((x.to, a_c));
    let (rectangle, exact) = (curve_style(0), curve_style(1));
    let tested = curve_style(2);
    let mut marks = vec![
        line(&corner, rectangle.colour, 2.0, None),
        line(&curve, exact.colour, 2.0, Some("10 6")),
    ];
    let mut shocks = Vec::new();
    if !picture.survived.is_empty() {
        marks.extend(hollow(
            &picture.survived,
            tested.colour,
            MarkerShape::Square,
            5.0,
        ));
        shocks.push((false, "survived in the tests"));
    }
    if !picture.damaged.is_empty() {
        marks.push(markers(
            &picture.damaged,
            tested.colour,
            MarkerShape::Square,
            5.0,
        ));
        shocks.push((true, "damaged in the tests"));
    }
    let (shape, demand, words) = if picture.safe {
        (
            MarkerShape::Circle,
            Sign::Dot { colour: DARK },
            "this landing: no damage",
        )
    } else {
        (MarkerShape::Cross, Sign::Cross, "this landing: damage")
    };
    marks.push(markers(&[(v, a)], DARK, shape, 6.0));
    let mut legend = vec![
        Entry::line(rectangle.colour, 2.0, None, "rectangle of ASTM D3332"),
        Entry::line(exact.colour, 2.0, Some("10 6"), "curve of a component"),
    ];
    let square = |filled| Sign::Square {
        colour: tested.colour,
        filled,
    };
    legend.extend(
        shocks
            .into_iter()
            .map(|(filled, words)| Entry::new(square(filled), words)),
    );
    legend.push(Entry::new(demand, words));
    draw(Page {
        name: "damage-boundary".to_owned(),
        title: "Damage boundary".to_owned(),
        caption: "A shock does damage only if both its peak and its velocity change are too large: above and to the \
                  right of the boundary. The rectangle is that of ASTM D3332, the curve that of an undamped \
                  component under rectangular pulses, which begins at the same velocity change and ends at the same \
                  peak."
            .to_owned(),
        panels: vec![panel(marks, x, y)],
        columns: 1,
        row_heights_px: vec![PANEL_PX],
        legend,
    })
}

/// The spectra as a figure.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn spectra_figure(report: &ShockSpectrumReport) -> Result<Figure, FigureError> {
    // Several inputs may be in several units: the figure is in g, m or m/s.
    let (factor, label) = match report.response {
        ResponseKind::AbsoluteAcceleration => (1.0 / G0_M_S2, "Absolute acceleration (g)"),
        ResponseKind::RelativeDisplacement => (1.0, "Relative displacement (m)"),
        ResponseKind::PseudoVelocity => (1.0, "Pseudo-velocity (m/s)"),
    };
    let curves: Vec<ShockCurve> = report
        .spectra
        .iter()
        .map(|one| ShockCurve {
            name: one.name.clone(),
            points: one
                .frequencies_hz
                .iter()
                .copied()
                .zip(one.values_si.iter().map(|v| factor * v))
                .collect(),
        })
        .collect();
    let title = format!(
        "Shock response spectrum, {}, damping {} %",
        report.peak,
        number(100.0 * report.damping_ratio, 4)
    );
    shock_spectrum_figure(&title, label, &curves)
}

/// Peak against velocity change, with the shocks of a test.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn boundary_figure(
    report: &DamageBoundaryReport,
    tests: Option<&BoundaryTests>,
) -> Result<Figure, FigureError> {
    let v_c = report.boundary.velocity_change_m_s();
    let curve = (1..=CURVE_POINTS).filter_map(|i| {
        // Close together near V_c, where the curve is steep.
        let share = (f64::from(i) / f64::from(CURVE_POINTS)).powi(3);
        let velocity_change_m_s = v_c * (1.0 + (KNEE_RATIO - 1.0) * share);
        Some((
            velocity_change_m_s,
            report
                .boundary
                .knee_acceleration_m_s2(velocity_change_m_s)?
                / G0_M_S2,
        ))
    });
    let points = |damaged: bool| {
        let points = tests.map_or(&[][..], |tests| &tests.points).iter();
        let of = points.filter(move |point| point.damaged == damaged);
        of.map(|point| (point.velocity_change_m_s, point.peak_acceleration_g))
            .collect()
    };
    damage_boundary_figure(&BoundaryPicture {
        corner: (v_c, report.boundary.acceleration_m_s2() / G0_M_S2),
        curve: curve.collect(),
        survived: points(false),
        damaged: points(true),
        demand: (report.demand.0, report.demand.1 / G0_M_S2),
        safe: report.demand_ratio() <= 1.0,
    })
}
