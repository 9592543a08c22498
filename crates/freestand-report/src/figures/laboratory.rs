//! Tests of cushions: loops of drop tests as in the paper's Figs. 5 and 6, static curves as in Fig.
//! 4.

use freestand::G0_M_S2;
use freestand::cushion::{ContactLaw, Cushion};

use freestand_study::laboratory::drop_test::{DropReport, DropsReport};
use freestand_study::laboratory::static_curve::StaticsReport;

use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, DARK, axes, curve_style, line, plain};
use freestand_output::figure::{Figure, FigureError};

/// The quantity that is drawn, from acceleration \[m/s²\] and force \[N\].
type Drawn = fn(f64, f64) -> f64;

/// Height of a panel \[px\].
const PANEL_PX: f64 = 430.0;
/// The largest number of tests that have a line of their own in the legend.
const MAX_NAMES: usize = 8;

/// Draws the loops of drop tests: force and acceleration against compression.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn drop_figures(report: &DropsReport) -> Result<Vec<Figure>, FigureError> {
    let has_loop = |drop: &&DropReport| drop.test.points.len() > 1;
    let tests: Vec<&DropReport> = report.tests.iter().filter(has_loop).collect();
    let pages = [
        page(
            &tests,
            "force_displacement",
            "Dynamic force and compression",
            "Force (N)",
            |_, force_n| force_n,
        ),
        page(
            &tests,
            "acceleration_displacement",
            "Acceleration and compression",
            "Acceleration (g)",
            |a, _| a / G0_M_S2,
        ),
    ];
    pages.into_iter().map(draw).collect()
}

fn page(tests: &[&DropReport], name: &str, title: &str, label: &str, value: Drawn) -> Page {
    let mut curves = Vec::new();
    let mut fits = Vec::new();
    for drop in tests {
        let (points, test) = (drop.test.points.iter(), &drop.test);
        curves.push(
            points
                .map(|p| (1e3 * p.compression_m, value(p.acceleration_m_s2, p.force_n)))
                .collect::<Vec<(f64, f64)>>(),
        );
        if let (Some(found), Some(most_m)) = (&test.identified, test.max_compression_m) {
            fits.push(fitted(
                drop,
                &found.law,
                most_m,
                found.fitted_velocity_m_s,
                value,
            ));
        }
    }
    let legend = legend(
        tests.iter().map(|test| test.path.as_str()),
        "fitted law, one landing",
    );
    let panel = panel(&curves, &fits, label);
    Page {
        name: name.to_owned(),
        title: plain(title),
        caption:
            "Loops of the drop tests. Compression: the acceleration integrated twice over the contact; force: mass \
             times acceleration above the zero line. The dashed line is the law that was fitted to the pulse, over \
             one landing."
                .to_owned(),
        panels: vec![panel],
        columns: 1,
        row_heights_px: vec![PANEL_PX],
        legend,
    }
}

/// The landing that the fitted law predicts, with the weight if it acts during the contact.
fn fitted(
    drop: &DropReport,
    law: &ContactLaw,
    most_m: f64,
    speed_m_s: f64,
    value: Drawn,
) -> Vec<(f64, f64)> {
    let Ok(cushion) = Cushion::new(law.clone()) else {
        return Vec::new();
    };
    let mass_kg = drop.mass_kg;
    let history = cushion.landing_history(mass_kg, speed_m_s, drop.gravity_m_s2);
    let every = (history.len() / 200).max(1);
    history
        .iter()
        .step_by(every)
        .filter(|p| p.compression_m <= 1.2 * most_m)
        .map(|p| (1e3 * p.compression_m, value(p.force_n / mass_kg, p.force_n)))
        .collect()
}

fn legend<'a>(names: impl Iterator<Item = &'a str>, dashed: &str) -> Vec<Entry> {
    let names: Vec<&str> = names.collect();
    let file = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or(path).to_owned();
    let mut entries: Vec<Entry> = names
        .iter()
        .take(MAX_NAMES)
        .enumerate()
        .map(|(i, path)| {
            let style = curve_style(i);
            Entry::line(style.colour, 1.6, style.dash, plain(&file(path)))
        })
        .collect();
    if names.len() > MAX_NAMES {
        let words = format!("and {} more", names.len() - MAX_NAMES);
        entries.push(Entry::line(DARK, 1.0, None, words));
    }
    entries.push(Entry::line(DARK, 1.2, Some("4 4"), dashed));
    entries
}

fn panel(curves: &[Vec<(f64, f64)>], fits: &[Vec<(f64, f64)>], label: &str) -> Panel {
    let all = || curves.iter().chain(fits).flatten();
    let x = Axis::from_zero(
        1.02 * all().fold(0.0, |most: f64, p| most.max(p.0)),
        "Compression (mm)",
    );
    let y = Axis::from_zero(1.05 * all().fold(0.0, |most: f64, p| most.max(p.1)), label);
    let mut marks: Vec<_> = curves
        .iter()
        .enumerate()
        .map(|(i, points)| line(points, curve_style(i).colour, 1.6, curve_style(i).dash))
        .collect();
    marks.extend(
        fits.iter()
            .map(|points| line(points, DARK, 1.2, Some("4 4"))),
    );
    Panel {
        marks,
        layout: axes(x, y),
    }
}

/// Largest number of points on a static curve: dashes are lost between points closer than a dash.
const MAX_POINTS: usize = 80;

/// A static curve in mm, thinned; its turning point and its end remain.
fn thinned(curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let every = curve.len().div_ceil(MAX_POINTS).max(1);
    let top = curve
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.1.total_cmp(&b.1.1))
        .map_or(0, |(i, _)| i);
    let kept = |i: usize| i.is_multiple_of(every) || i == top || i + 1 == curve.len();
    curve
        .iter()
        .enumerate()
        .filter(|(i, _)| kept(*i))
        .map(|(_, (d, f))| (1e3 * d, *f))
        .collect()
}

/// Draws the curves of static tests.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn static_figure(report: &StaticsReport) -> Result<Figure, FigureError> {
    let curves: Vec<Vec<(f64, f64)>> = report
        .tests
        .iter()
        .map(|test| thinned(&test.test.curve))
        .collect();
    let tangents: Vec<Vec<(f64, f64)>> = report
        .tests
        .iter()
        .map(|test| {
            let test = &test.test;
            let at_m = test.load_n / test.secant_stiffness_n_m;
            let reach_m = 0.5 * test.load_n / test.tangent_stiffness_n_m;
            [-reach_m, reach_m]
                .map(|x| {
                    (
                        1e3 * (at_m + x),
                        test.load_n + test.tangent_stiffness_n_m * x,
                    )
                })
                .to_vec()
        })
        .collect();
    let legend = legend(
        report.tests.iter().map(|test| test.path.as_str()),
        "tangent at the working load",
    );
    draw(Page {
        name: "static".to_owned(),
        title: plain("Static force and compression"),
        caption: "Static tests, corrected for machine and toe: loading and unloading, and the tangents at the \
                  working load."
            .to_owned(),
        panels: vec![panel(&curves, &tangents, "Force (N)")],
        columns: 1,
        row_heights_px: vec![PANEL_PX],
        legend,
    })
}
