//! The landing of an object on its cushions: accelerations of both edges as accelerometers above
//! them would record them, and the forces under them.

use kuva::render::annotations::ReferenceLine;

use freestand::G0_M_S2;
use freestand::compliant::CompliantPoint;

use freestand_input::words::{number, significant};
use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, DARK, curve_style, line, plain, round_step, rule};
use freestand_output::figure::time::{stacked, thin, time_axis};
use freestand_output::figure::{Figure, FigureError};
use freestand_study::compliant::CompliantReport;

/// Heights of the panels; the lowest carries the label of the axis \[px\].
const PANELS_PX: [f64; 3] = [230.0, 150.0, 186.0];

/// Line widths of the left and the right edge: they must differ in more than colour, and dashes are
/// lost in steep lines \[px\].
const WIDTHS_PX: [f64; 2] = [2.4, 1.0];

/// How much of the history is shown before and after the first impact, as a multiple of the
/// duration of its contact.
const SHOWN_BEFORE: f64 = 2.0;
const SHOWN_AFTER: f64 = 14.0;

/// Draws the first impact on the cushions: edge accelerations, forces and rotation against time.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn trace_figure(report: &CompliantReport) -> Result<Figure, FigureError> {
    let (rocking, base) = (&report.history.rocking, &report.base);
    let (from, to) = rocking
        .touches
        .first()
        .map_or((0.0, rocking.end_time_s), |first| {
            let contact_s = first.end_time_s.unwrap_or(rocking.end_time_s) - first.time_s;
            let from = (first.time_s - SHOWN_BEFORE * contact_s).max(0.0);
            (
                from,
                (first.time_s + SHOWN_AFTER * contact_s).min(rocking.end_time_s),
            )
        });
    let paper_g = report.answer.edge_acceleration_paper_g;
    let within = |p: &&CompliantPoint| (from..=to).contains(&p.time_s);
    let curve = |value: &dyn Fn(&CompliantPoint) -> f64| {
        thin(
            report
                .history
                .samples
                .iter()
                .filter(within)
                .map(|p| (p.time_s, value(p))),
            from,
            to,
        )
    };
    let edges = [0, 1].map(|edge| curve(&|p| p.edge_accelerations_m_s2[edge] / G0_M_S2));
    let under = |forces: Option<&(f64, f64)>| forces.map_or(0.0, |f| 1e-3 * f.1);
    let forces = [
        curve(&|p| under(p.contact_forces_n.first())),
        curve(&|p| under(p.contact_forces_n.last())),
    ];
    let rotation = curve(&|p| p.theta_rad.to_degrees());
    let mut first = panel(
        &edges,
        paper_g,
        "Edge acceleration (g)",
        time_axis(from, to),
        false,
    );
    let mut legend = vec![
        Entry::line(curve_style(0).colour, WIDTHS_PX[0], None, "left edge"),
        Entry::line(curve_style(1).colour, WIDTHS_PX[1], None, "right edge"),
    ];
    if let Some(paper_g) = paper_g {
        let mark = rule(ReferenceLine::horizontal(paper_g), DARK, 1.2, "2 4");
        first.layout = first.layout.with_reference_line(mark);
        let words = format!("Eq. (5): {} g", number(paper_g, 4));
        legend.push(Entry::line(DARK, 1.2, Some("2 4"), words));
    }
    let panels = vec![
        first,
        panel(&forces, None, "Force (kN)", time_axis(from, to), false),
        panel(
            std::slice::from_ref(&rotation),
            None,
            "Rotation (deg)",
            time_axis(from, to),
            true,
        ),
    ];
    let caption = format!(
        "{} kg on cushions ({}, tangential stiffness {} times the normal one, {}). Top: vertical acceleration of \
         the two edges in the ground's frame, upward positive, as accelerometers above them would record it. \
         Middle: forces of the cushions under them. Bottom: rotation. Both ends of an edge move alike, so each line \
         is also the mean of two accelerometers on that edge.",
        significant(base.mass_kg, 4),
        base.cushion.law().name(),
        significant(base.tangential_stiffness_ratio, 3),
        base.friction_ratio.map_or_else(
            || "no sliding".to_owned(),
            |mu| format!("friction {}", significant(mu, 3))
        ),
    );
    draw(Page {
        name: "trace".to_owned(),
        title: plain("Landing on the cushions"),
        caption,
        panels,
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend,
    })
}

/// A panel whose axis includes the value `also` as well as its curves.
fn panel(
    curves: &[Vec<(f64, f64)>],
    also: Option<f64>,
    label: &str,
    x: Axis,
    lowest: bool,
) -> Panel {
    let values = || curves.iter().flatten().map(|p| p.1).chain(also);
    let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let step = round_step(((high - low).max(1e-9)) / 4.0);
    let from = (1.02 * low / step).floor();
    let to = (1.02 * high / step).ceil().max(from + 1.0);
    let y = Axis {
        step: Some(step),
        ..Axis::between(step * from, step * to, label)
    };
    let marks = curves
        .iter()
        .enumerate()
        .map(|(index, points)| {
            line(
                points,
                curve_style(index).colour,
                WIDTHS_PX[index % 2],
                None,
            )
        })
        .collect();
    Panel {
        marks,
        layout: stacked(x, y, lowest),
    }
}
