//! Fragility curves with what was seen.

use freestand_output::figure::mark::MarkerShape;

use freestand::fragility::{CurveKind, LimitState, empirical};
use freestand_input::quantity::shorten;
use freestand_input::words::counted;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, columns, draw};
use freestand_output::figure::style::{
    Axis, axes, curve_style, hollow, line, plain, plain_ticks, round_step,
};
use freestand_output::figure::{Figure, FigureError};

use freestand_risk::fragility::{FragilityReport, ObjectFragility};

/// The most objects that a page shows.
const MAX_PANELS: usize = 6;
/// Height of a row of panels \[px\].
const PANEL_PX: f64 = 330.0;
/// Points of a curve.
const POINTS: usize = 160;

/// The curves with what was seen, of the first six objects.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn curves_figure(report: &FragilityReport) -> Result<Figure, FigureError> {
    let shown: Vec<&ObjectFragility> = report.objects.iter().take(MAX_PANELS).collect();
    let measure = report.table.measure.with_unit();
    let panels: Vec<Panel> = shown.iter().map(|object| panel(object, &measure)).collect();
    let columns = columns(panels.len());
    let rows = panels.len().div_ceil(columns);
    let states: Vec<LimitState> = LimitState::ALL
        .into_iter()
        .filter(|state| {
            let by_shock = *state == LimitState::Exceeds;
            shown.iter().any(|object| {
                object.fit.curve(*state).is_some() || by_shock && object.two_stage.is_some()
            })
        })
        .collect();
    let legend = states.iter().map(|state| {
        let style = curve_style(place(*state));
        let sign = Sign::Line {
            colour: style.colour,
            width_px: 2.0,
            dash: style.dash,
        };
        Entry {
            sign,
            words: state.name().to_owned(),
        }
    });
    draw(Page {
        name: "fragility".to_owned(),
        title: title(report.objects.len()),
        caption: format!(
            "Probability that an object reaches each limit state, against {}. Lines: fitted curves; thin lines: the 95 % \
             interval of the median; markers: the share of runs, or the capacities of the motions.",
            report.table.measure.name()
        ),
        panels,
        columns,
        row_heights_px: vec![PANEL_PX; rows],
        legend: legend.collect(),
    })
}

/// The title says how many objects are left out, since a picture is seen without its caption.
fn title(objects: usize) -> String {
    match objects.saturating_sub(MAX_PANELS) {
        0 => format!("Fragility of {}", counted(objects, "object")),
        more => format!("Fragility of {MAX_PANELS} objects; {more} more in fragility.csv"),
    }
}

pub(super) fn place(state: LimitState) -> usize {
    LimitState::ALL
        .iter()
        .position(|other| *other == state)
        .unwrap_or(0)
}

fn panel(object: &ObjectFragility, measure: &str) -> Panel {
    let levels = object.outcomes.levels();
    let (least, most) = (
        levels.first().copied().unwrap_or(1.0),
        levels.last().copied().unwrap_or(1.0),
    );
    let step = round_step(most / 5.0);
    let to = step * (most / step - 1e-9).ceil();
    let x = Axis {
        from: 0.0,
        to,
        step: Some(step),
        label: plain(measure),
    };
    let y = Axis {
        from: 0.0,
        to: 1.0,
        step: Some(0.2),
        label: "Probability".to_owned(),
    };
    let at = |i: usize| to * (i as f64 + 0.5) / POINTS as f64;
    let mut marks = Vec::new();
    for curve in &object.fit.curves {
        let style = curve_style(place(curve.limit_state));
        let drawn = |kind: CurveKind| -> Vec<(f64, f64)> {
            (0..POINTS)
                .filter_map(|i| Some((at(i), kind.probability(at(i))?)))
                .collect()
        };
        let sure = match curve.kind {
            CurveKind::None { lower } => vec![(0.0, 0.0), (lower, 0.0)],
            CurveKind::All { upper } => vec![(upper.max(least), 1.0), (to, 1.0)],
            kind => drawn(kind),
        };
        marks.push(line(&sure, style.colour, 2.0, style.dash));
        if let (CurveKind::Lognormal { beta, .. }, Some((ends, _))) =
            (curve.kind, object.interval(curve.limit_state))
        {
            for median in [ends.0, ends.1] {
                marks.push(line(
                    &drawn(CurveKind::Lognormal { median, beta }),
                    style.colour,
                    0.7,
                    None,
                ));
            }
        }
        let seen: Vec<(f64, f64)> = empirical(&object.outcomes, curve.limit_state)
            .iter()
            .map(|seen| (seen.intensity, seen.reached / seen.trials))
            .collect();
        let shape = if seen.len() > 40 {
            MarkerShape::Circle
        } else {
            style.marker
        };
        marks.extend(hollow(
            &seen,
            style.colour,
            shape,
            if seen.len() > 40 { 2.6 } else { 4.0 },
        ));
    }
    if let Some(two_stage) = &object.two_stage {
        let style = curve_style(place(LimitState::Exceeds));
        let drawn: Vec<(f64, f64)> = (0..POINTS)
            .map(|i| (at(i), two_stage.probability(at(i))))
            .collect();
        marks.push(line(&drawn, style.colour, 2.0, style.dash));
    }
    let mut layout = axes(x, y).with_title(plain(&shorten(&object.id)));
    layout.x_tick_format = plain_ticks(to);
    Panel { marks, layout }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_that_are_not_drawn_are_counted() {
        assert_eq!(title(6), "Fragility of 6 objects");
        assert_eq!(title(7), "Fragility of 6 objects; 1 more in fragility.csv");
    }
}
