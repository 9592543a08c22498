//! Response spectra of one motion at one or several dampings.

use freestand_output::figure::mark::Mark;
use freestand_study::inspect::SpectrumReport;

use freestand_input::quantity::shorten;
use freestand_input::words::number;
use freestand_study::inspect::DampedSpectrum;

use super::record::Words;
use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{
    Axis, curve_style, line, markers, over_periods, plain, points, readable,
};
use freestand_output::figure::time::{stacked, thin};
use freestand_output::figure::{Figure, FigureError};

/// Heights of the panels \[px\].
const PANELS_PX: [f64; 3] = [260.0, 180.0, 215.0];

/// Up to this many periods are marked one by one; a single period has no line.
const MARKED_PERIODS: usize = 12;

/// The curve of a spectrum that a panel draws.
type Values = fn(&DampedSpectrum) -> &[f64];

/// Draws response spectra of one motion at one or several dampings: PSA, PSV and SD against period.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub(super) fn response_spectrum_figure(
    words: Words<'_>,
    periods_s: &[f64],
    spectra: &[&DampedSpectrum],
) -> Result<Figure, FigureError> {
    let periods = || periods_s.iter().copied().filter(|&t| t > 0.0);
    let (mut from, mut to) = (
        periods().fold(f64::INFINITY, f64::min),
        periods().fold(0.0, f64::max),
    );
    if from > to {
        (from, to) = (0.05, 5.0);
    } else if from == to {
        (from, to) = (from / 2.0, to * 2.0);
    }
    let panel = |values: Values, name, units, lowest| {
        panel(
            periods_s,
            spectra,
            values,
            Axis::between(from, to, "Period (s)"),
            name,
            units,
            lowest,
        )
    };
    let panels = vec![
        panel(|s| &s.psa_g, "PSA", ["g", "mg", "µg"], false),
        panel(|s| &s.psv_m_s, "PSV", ["m/s", "mm/s", "µm/s"], false),
        panel(|s| &s.sd_m, "SD", ["m", "mm", "µm"], true),
    ];
    let legend = spectra.iter().enumerate().map(|(i, spectrum)| {
        let style = curve_style(i);
        let words = format!("damping {} %", number(100.0 * spectrum.damping_ratio, 4));
        Entry::line(style.colour, 2.0, style.dash, words)
    });
    let done = if words.processing.is_empty() {
        String::new()
    } else {
        format!(" Processing: {}.", words.processing.join("; "))
    };
    draw(Page {
        name: "spectrum".to_owned(),
        title: plain(&format!("Response spectrum of {}", shorten(words.name))),
        caption: format!(
            "Pseudo-acceleration, pseudo-velocity and relative displacement of a linear oscillator under the motion \
             “{}” against its period. Peaks are taken at the samples.{done}",
            words.name
        ),
        panels,
        columns: 1,
        row_heights_px: PANELS_PX.to_vec(),
        legend: legend.collect(),
    })
}

fn panel(
    periods_s: &[f64],
    spectra: &[&DampedSpectrum],
    values: Values,
    x: Axis,
    name: &str,
    units: [&'static str; 3],
    lowest: bool,
) -> Panel {
    let highest = spectra
        .iter()
        .flat_map(|one| values(one))
        .copied()
        .fold(0.0, f64::max);
    let (factor, unit) = readable(highest, units);
    let marks: Vec<Mark> = spectra
        .iter()
        .enumerate()
        .flat_map(|(i, spectrum)| {
            let all = points(periods_s, values(spectrum)).map(|(t, value)| (t, factor * value));
            let mut points: Vec<(f64, f64)> = all.filter(|p| p.0 > 0.0).collect();
            // Periods may be given in any order.
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let logarithms = points.into_iter().map(|(t, value)| (t.ln(), value));
            let thinned = thin(logarithms, x.from.ln(), x.to.ln());
            let curve: Vec<(f64, f64)> = thinned
                .into_iter()
                .map(|(t, value)| (t.exp(), value))
                .collect();
            let style = curve_style(i);
            let mut marks = vec![line(&curve, style.colour, 2.0, style.dash)];
            if curve.len() <= MARKED_PERIODS {
                marks.push(markers(&curve, style.colour, style.marker, 3.5));
            }
            marks
        })
        .collect();
    let y = Axis::from_zero(1.02 * factor * highest, &format!("{name} ({unit})"));
    let top = y.to;
    let layout = over_periods(stacked(x, y, lowest), top);
    Panel { marks, layout }
}

/// The spectra as a figure.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn spectrum_figure(report: &SpectrumReport) -> Result<Figure, FigureError> {
    let words = Words {
        name: &report.name,
        description: "",
        processing: &report.processing,
    };
    let spectra: Vec<_> = report.all().collect();
    response_spectrum_figure(words, &report.periods_s, &spectra)
}
