//! The landing of an object on its cushions: accelerations of both edges and forces under them, as an accelerometer over the
//! corner would write them.

use kuva::render::annotations::ReferenceLine;

use freestand::G0_M_S2;
use freestand::compliant::CompliantPoint;

use freestand_input::words::number;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, DARK, curve_style, line, plain, round_step};
use freestand_output::figure::time::{stacked, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};

/// Heights of the panels; the lowest carries the label of the axis \[px\].
const PANELS_PX: [f64; 3] = [230.0, 150.0, 186.0];

/// The left edge and the right one: they differ in more than colour, and dashes are lost in steep lines \[px\].
const WIDTHS_PX: [f64; 2] = [2.4, 1.0];

/// What a landing is drawn from.
#[derive(Debug, Clone, Copy)]
pub struct Trace<'a> {
    /// The history.
    pub points: &'a [CompliantPoint],
    /// When to begin and to end \[s\].
    pub window_s: (f64, f64),
    /// a_edge by Eq. (5) at the same rise \[g\].
    pub paper_g: Option<f64>,
    /// What the object is and stands on, in a line.
    pub about: &'a str,
}

pub(crate) fn trace_page(trace: &Trace<'_>) -> Page {
    let (from, to) = trace.window_s;
    let within = |p: &&CompliantPoint| (from..=to).contains(&p.time_s);
    let curve = |value: &dyn Fn(&CompliantPoint) -> f64| {
        thin(trace.points.iter().filter(within).map(|p| (p.time_s, value(p))), from, to)
    };
    let edges = [0, 1].map(|edge| curve(&|p| p.edge_accelerations_m_s2[edge] / G0_M_S2));
    let under = |forces: Option<&(f64, f64)>| forces.map_or(0.0, |f| 1e-3 * f.1);
    let forces = [curve(&|p| under(p.contact_forces_n.first())), curve(&|p| under(p.contact_forces_n.last()))];
    let rotation = curve(&|p| p.theta_rad.to_degrees());
    let mut first = panel(&edges, trace.paper_g, "Edge accel. (g)", time_axis(from, to), false);
    let mut legend = vec![
        Entry {
            sign: Sign::Line { colour: curve_style(0).colour, width_px: WIDTHS_PX[0], dash: None },
            words: "left edge".into(),
        },
        Entry {
            sign: Sign::Line { colour: curve_style(1).colour, width_px: WIDTHS_PX[1], dash: None },
            words: "right edge".into(),
        },
    ];
    if let Some(paper_g) = trace.paper_g {
        let mark = ReferenceLine::horizontal(paper_g).with_color(DARK).with_stroke_width(1.2).with_dasharray("2 4");
        first.layout = first.layout.with_reference_line(mark);
        let sign = Sign::Line { colour: DARK, width_px: 1.2, dash: Some("2 4") };
        legend.push(Entry { sign, words: format!("Eq. (5): {} g", number(paper_g, 4)) });
    }
    let panels = vec![
        first,
        panel(&forces, None, "Force (kN)", time_axis(from, to), false),
        panel(std::slice::from_ref(&rotation), None, "Rotation (deg)", time_axis(from, to), true),
    ];
    let caption = format!(
        "{}. Above: vertical acceleration of the two lower corners in the ground's frame, upward positive, what \
         accelerometers above the corners write; between: forces of the cushions under them; below: rotation. In the \
         plane of the motion the two corners of one edge move alike, so the mean of two accelerometers on that edge is \
         this line.",
        trace.about
    );
    Page {
        name: "trace".to_owned(),
        title: plain("Landing on the cushions"),
        caption,
        panels,
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend,
    }
}

/// A panel that shows `also` beside its curves.
fn panel(curves: &[Vec<(f64, f64)>], also: Option<f64>, label: &str, x: Axis, lowest: bool) -> Panel {
    let values = || curves.iter().flatten().map(|p| p.1).chain(also);
    let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let step = round_step(((high - low).max(1e-9)) / 4.0);
    let y = Axis {
        from: step * (1.02 * low / step).floor(),
        to: step * (1.02 * high / step).ceil().max((1.02 * low / step).floor() + 1.0),
        step: Some(step),
        label: label.into(),
    };
    let plots = curves
        .iter()
        .enumerate()
        .map(|(index, points)| line(points, curve_style(index).colour, WIDTHS_PX[index % 2], None))
        .collect();
    Panel { plots, layout: stacked(x, y, lowest) }
}

/// Draws a landing on cushions: edge accelerations, forces and rotation against time.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn trace_figure(trace: &Trace<'_>) -> Result<Figure, FigureError> {
    draw(trace_page(trace))
}
