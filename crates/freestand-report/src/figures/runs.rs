//! Figures of runs: rotation and shock against the intensity, β by measure, residuals.

use std::sync::Arc;

use freestand::fragility::{LimitState, OutcomeClass, line_through};
use freestand_input::quantity::shorten;
use freestand_input::words::significant;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::mark::{Mark, MarkerShape};
use freestand_output::figure::page::{Page, Panel, columns, draw};
use freestand_output::figure::style::{
    Axis, DARK, GREY, axes, curve_style, hollow, line, markers, plain, plain_ticks,
};
use freestand_output::figure::{Figure, FigureError};
use kuva::render::layout::TickFormat;

use super::fragility::place;
use freestand_risk::fragility::{At, Followed, FragilityReport, Measure, ObjectRuns, RunsReport};

/// The most objects that a page shows.
const MAX_OBJECTS: usize = 3;
/// Height of a row of panels \[px\].
const PANEL_PX: f64 = 320.0;
/// Where an overturned run is drawn, in θ/α.
const TOP: f64 = 1.15;

/// One line for each motion: the largest rotation, and the shock, against the intensity.
pub fn ida_figure(report: &RunsReport) -> Result<Figure, FigureError> {
    let (measure, at) = report
        .reports
        .first()
        .map_or((Measure::Pfv, At::Floor), |one| (one.table.measure, one.at));
    let shown: Vec<&ObjectRuns> = report.objects.iter().take(MAX_OBJECTS).collect();
    let has_shock = shown.iter().any(|one| one.nominal.has_shock());
    let has_ceiling = shown.iter().any(|one| one.nominal.ceiling_g().is_some());
    let mut panels: Vec<Panel> = shown
        .iter()
        .map(|one| rotations(report, one, measure, at))
        .collect();
    if has_shock {
        panels.extend(shown.iter().map(|one| shocks(report, one, measure, at)));
    }
    let rows = if has_shock { 2 } else { 1 };
    let of_motion = Sign::Line {
        colour: curve_style(0).colour,
        width_px: 0.8,
        dash: None,
    };
    let mut legend = vec![Entry {
        sign: of_motion,
        words: "one motion".to_owned(),
    }];
    let overturned = curve_style(1);
    legend.push(Entry {
        sign: Sign::Curve(freestand_output::figure::style::CurveStyle {
            dash: None,
            ..overturned
        }),
        words: "first overturning".to_owned(),
    });
    if has_ceiling {
        let sign = Sign::Line {
            colour: DARK,
            width_px: 1.4,
            dash: Some("10 6"),
        };
        legend.push(Entry {
            sign,
            words: "ceiling".to_owned(),
        });
    }
    draw(Page {
        name: "ida".to_owned(),
        title: titled("Runs of every motion", report.objects.len()),
        caption: format!(
            "Largest rotation over α{} of objects that stay upright, against {}: one line for each motion. A square: \
             the lowest intensity at which a motion overturns the object.",
            match (has_shock, has_ceiling) {
                (true, true) => ", and the shock with its ceiling,",
                (true, false) => ", and the shock,",
                (false, _) => "",
            },
            measure.name()
        ),
        columns: shown.len().max(1),
        panels,
        row_heights_px: vec![PANEL_PX; rows],
        legend,
    })
}

/// A title, with how many objects are left out: a picture is seen without its caption.
fn titled(title: &str, objects: usize) -> String {
    match objects > MAX_OBJECTS {
        true => format!("{title}: the first {MAX_OBJECTS} of {objects} objects"),
        false => title.to_owned(),
    }
}

/// An axis that holds all runs up to the strongest motion that overturns the object.
fn intensity_axis(report: &RunsReport, one: &ObjectRuns, measure: Measure, at: At) -> Axis {
    let (mut of_capacities, mut of_all) = (0.0_f64, 0.0_f64);
    for runs in report.intensities(one, measure, at) {
        let first = runs
            .iter()
            .find(|(_, run)| class(run) == Some(OutcomeClass::Overturned));
        of_capacities = of_capacities.max(first.map_or(0.0, |(x, _)| 1.1 * x));
        of_all = of_all.max(runs.last().map_or(0.0, |(x, _)| *x));
    }
    let most = if of_capacities > 0.0 {
        of_capacities.min(of_all)
    } else {
        of_all
    };
    Axis::from_zero(most, &plain(&measure.with_unit()))
}

fn class(run: &Followed) -> Option<OutcomeClass> {
    run.run().map(|run| run.class)
}

fn rotations(report: &RunsReport, one: &ObjectRuns, measure: Measure, at: At) -> Panel {
    let x = intensity_axis(report, one, measure, at);
    let y = Axis {
        from: 0.0,
        to: 1.2,
        step: Some(0.2),
        label: "Rotation over α".to_owned(),
    };
    let to = x.to;
    let (mut marks, mut firsts) = (Vec::new(), Vec::new());
    for runs in report.intensities(one, measure, at) {
        let mut points = Vec::new();
        for (x, run) in runs.iter().filter(|(x, _)| *x <= to) {
            let Some(of_run) = run.run() else { continue };
            if of_run.class == OutcomeClass::Overturned {
                points.push((*x, TOP));
                firsts.push((*x, TOP));
                break;
            }
            points.extend(of_run.rotation_ratio.map(|ratio| (*x, ratio)));
        }
        marks.push(line(&points, curve_style(0).colour, 0.8, None));
    }
    marks.extend(hollow(
        &firsts,
        curve_style(1).colour,
        curve_style(1).marker,
        3.6,
    ));
    if let Some(limit) = report.request.rotation_ratio {
        marks.push(line(&[(0.0, limit), (to, limit)], DARK, 1.2, Some("4 5")));
    }
    panel(marks, x, y, &one.id)
}

fn shocks(report: &RunsReport, one: &ObjectRuns, measure: Measure, at: At) -> Panel {
    let x = intensity_axis(report, one, measure, at);
    let to = x.to;
    let ceiling_g = one.nominal.ceiling_g();
    let mut marks = Vec::new();
    let mut most = ceiling_g.unwrap_or(0.0);
    for runs in report.intensities(one, measure, at) {
        let upright = runs
            .iter()
            .take_while(|(x, run)| *x <= to && class(run) != Some(OutcomeClass::Overturned));
        let points: Vec<(f64, f64)> = upright
            .filter_map(|(x, run)| Some((*x, run.run()?.edge_acceleration_g?)))
            .collect();
        most = points.iter().map(|point| point.1).fold(most, f64::max);
        marks.push(line(&points, curve_style(0).colour, 0.8, None));
    }
    if let Some(ceiling_g) = ceiling_g {
        marks.push(line(
            &[(0.0, ceiling_g), (to, ceiling_g)],
            DARK,
            1.4,
            Some("10 6"),
        ));
    }
    panel(
        marks,
        x,
        Axis::from_zero(1.05 * most, "Shock of the edge (g)"),
        &one.id,
    )
}

fn panel(marks: Vec<Mark>, x: Axis, y: Axis, id: &str) -> Panel {
    let span = x.to;
    let mut layout = axes(x, y).with_title(plain(&shorten(id)));
    layout.x_tick_format = plain_ticks(span);
    Panel { marks, layout }
}

/// Efficiency and proficiency of every measure.
pub fn measures_figure(report: &RunsReport) -> Result<Figure, FigureError> {
    let first = report
        .reports
        .first()
        .map_or(&[][..], |one| one.objects.as_slice());
    let shown = first.len().min(MAX_OBJECTS);
    let names: Arc<Vec<String>> = Arc::new(
        report
            .reports
            .iter()
            .map(|one| plain(&one.table.measure.name()))
            .collect(),
    );
    let mut panels = Vec::new();
    let mut states: Vec<LimitState> = Vec::new();
    for i in 0..shown {
        let mut marks = Vec::new();
        let mut most = 0.0_f64;
        for state in LimitState::ALL {
            let of = |report: &FragilityReport| {
                report
                    .objects
                    .get(i)?
                    .qualities
                    .iter()
                    .find(|one| one.limit_state == state)?
                    .efficiency
            };
            let points: Vec<(f64, f64)> = report
                .reports
                .iter()
                .enumerate()
                .filter_map(|(place, report)| Some(((place + 1) as f64, of(report)?)))
                .collect();
            if points.is_empty() {
                continue;
            }
            states.push(state);
            most = points.iter().map(|point| point.1).fold(most, f64::max);
            let style = curve_style(place(state));
            marks.extend(hollow(&points, style.colour, style.marker, 5.0));
        }
        let x = Axis {
            from: 0.4,
            to: names.len() as f64 + 0.6,
            step: Some(1.0),
            label: "Measure".to_owned(),
        };
        let id = first.get(i).map_or("", |object| object.id.as_str());
        let mut layout = axes(x, Axis::from_zero(1.05 * most, "β")).with_title(plain(&shorten(id)));
        let names = Arc::clone(&names);
        layout.x_tick_format = TickFormat::Custom(Arc::new(move |value| {
            let place = value.round();
            let is_place = (value - place).abs() < 1e-6 && place >= 1.0;
            if is_place {
                names.get(place as usize - 1).cloned().unwrap_or_default()
            } else {
                String::new()
            }
        }));
        panels.push(Panel { marks, layout });
    }
    states.sort_unstable();
    states.dedup();
    let legend = states.into_iter().map(|state| Entry {
        sign: Sign::Curve(curve_style(place(state))),
        words: state.name().to_owned(),
    });
    let count = panels.len();
    draw(Page {
        name: "measures".to_owned(),
        title: titled("Dispersion by measure", first.len()),
        caption: "Dispersion β of the capacities of the motions, by measure (for a cloud: of the demands about the \
                  line). Smaller is better: the measure alone predicts more."
            .to_owned(),
        panels,
        columns: if count > 1 { 1 } else { columns(count) },
        row_heights_px: vec![PANEL_PX; count.max(1)],
        legend: legend.collect(),
    })
}

/// What the first measure leaves of the most severe limit state, against the mean period and PGV/PGA.
pub fn residuals_figure(report: &RunsReport) -> Result<Figure, FigureError> {
    let first = report.reports.first();
    let shown: Vec<_> = first
        .map_or(&[][..], |one| one.objects.as_slice())
        .iter()
        .take(MAX_OBJECTS)
        .collect();
    let measure = first.map_or_else(String::new, |one| one.table.measure.name());
    let mut panels = Vec::new();
    for object in &shown {
        // The most severe limit state that all motions reach, or of which a cloud has demands.
        let severe = object
            .qualities
            .iter()
            .rfind(|quality| quality.residuals.len() > 2);
        for (i, label) in [(0, "Mean period (s)"), (1, "PGV/PGA (s)")] {
            let points: Vec<(f64, f64)> = severe
                .map_or(&[][..], |one| one.residuals.as_slice())
                .iter()
                .map(|one| (one[i], one[2]))
                .collect();
            let p = severe.and_then(|one| {
                if i == 0 {
                    one.p_mean_period
                } else {
                    one.p_velocity_over_acceleration
                }
            });
            let state = severe.map_or("", |one| one.limit_state.name());
            let said = p.map_or_else(String::new, |p| format!(", p = {}", significant(p, 2)));
            panels.push(residual_panel(
                &points,
                label,
                &format!("{} {state}{said}", shorten(&object.id)),
            ));
        }
    }
    let rows = shown.len().max(1);
    draw(Page {
        name: "residuals".to_owned(),
        title: titled(
            &format!("What {} does not explain", plain(&measure)),
            first.map_or(0, |one| one.objects.len()),
        ),
        caption: format!(
            "ln of the capacity of each motion by {measure} minus the mean (for a cloud: ln of the demand minus the \
             line), against the mean period and PGV/PGA of the motion, of the most severe limit state that all \
             motions reach. p below 0.05: the outcome depends on that property, too."
        ),
        panels,
        columns: 2,
        row_heights_px: vec![PANEL_PX; rows],
        legend: Vec::new(),
    })
}

fn residual_panel(points: &[(f64, f64)], label: &str, title: &str) -> Panel {
    let real: Vec<(f64, f64)> = points.iter().map(|(ln_x, e)| (ln_x.exp(), *e)).collect();
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let values = || real.iter().map(of);
        (
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        )
    };
    let ((x_from, x_to), (y_from, y_to)) = if real.is_empty() {
        ((0.0, 1.0), (-1.0, 1.0))
    } else {
        (ends(|point| point.0), ends(|point| point.1))
    };
    let (x, y) = (
        Axis::around(x_from, x_to, label),
        Axis::around(y_from.min(-0.1), y_to.max(0.1), "Residual of ln"),
    );
    let span = x.to - x.from;
    let mut marks = vec![line(&[(x.from, 0.0), (x.to, 0.0)], GREY, 1.0, None)];
    if let Some(found) = line_through(points) {
        // Straight in the logarithm.
        let at = |i: usize| x_from * (x_to / x_from).powf(i as f64 / 40.0);
        let trend: Vec<(f64, f64)> = (0..=40)
            .map(|i| (at(i), found.intercept + found.slope * at(i).ln()))
            .collect();
        marks.push(line(
            &trend,
            curve_style(1).colour,
            1.6,
            curve_style(1).dash,
        ));
    }
    marks.push(markers(
        &real,
        curve_style(0).colour,
        MarkerShape::Circle,
        3.4,
    ));
    let mut layout = axes(x, y).with_title(plain(title));
    layout.x_tick_format = plain_ticks(span);
    Panel { marks, layout }
}
