//! Response spectra of one motion at one or several dampings.

use kuva::render::plots::Plot;

use crate::inspect::DampedSpectrum;
use freestand_input::quantity::shorten;
use freestand_input::words::number;

use super::Words;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{
    Axis, curve_style, line, markers, plain, plain_ticks, readable,
};
use freestand_output::figure::time::{stacked, thin};
use freestand_output::figure::{Figure, FigureError};

/// Heights of the panels \[px\].
const PANELS_PX: [f64; 3] = [260.0, 180.0, 215.0];

/// Up to this many periods are marked one by one; a single period has no line.
const MARKED_PERIODS: usize = 12;

/// PSA, PSV and SD against period.
pub(crate) fn response_spectrum(
    words: Words<'_>,
    periods_s: &[f64],
    spectra: &[&DampedSpectrum],
) -> Page {
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
    let x = || Axis {
        from,
        to,
        step: None,
        label: "Period (s)".into(),
    };
    let panels = vec![
        panel(
            periods_s,
            spectra,
            |s| &s.psa_g,
            x(),
            "PSA",
            ["g", "mg", "µg"],
            false,
        ),
        panel(
            periods_s,
            spectra,
            |s| &s.psv_m_s,
            x(),
            "PSV",
            ["m/s", "mm/s", "µm/s"],
            false,
        ),
        panel(
            periods_s,
            spectra,
            |s| &s.sd_m,
            x(),
            "SD",
            ["m", "mm", "µm"],
            true,
        ),
    ];
    let legend = spectra.iter().enumerate().map(|(i, spectrum)| {
        let style = curve_style(i);
        let sign = Sign::Line {
            colour: style.colour,
            width_px: 2.0,
            dash: style.dash,
        };
        Entry {
            sign,
            words: format!("damping {} %", number(100.0 * spectrum.damping_ratio, 4)),
        }
    });
    let done = if words.processing.is_empty() {
        String::new()
    } else {
        format!(" Processing: {}.", words.processing.join("; "))
    };
    Page {
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
    }
}

fn panel(
    periods_s: &[f64],
    spectra: &[&DampedSpectrum],
    values: impl Fn(&DampedSpectrum) -> &[f64],
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
    let plots: Vec<Plot> = spectra
        .iter()
        .enumerate()
        .flat_map(|(i, spectrum)| {
            let all = periods_s
                .iter()
                .copied()
                .zip(values(spectrum).iter().map(|value| factor * value));
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
            let mut plots = vec![line(&curve, style.colour, 2.0, style.dash)];
            if curve.len() <= MARKED_PERIODS {
                plots.push(markers(&curve, style.colour, style.marker, 3.5));
            }
            plots
        })
        .collect();
    let y = Axis::from_zero(1.02 * factor * highest, &format!("{name} ({unit})"));
    let y_ticks = plain_ticks(y.to);
    let mut layout = stacked(x, y, lowest).with_log_x();
    layout.x_tick_format = plain_ticks(0.0);
    layout.y_tick_format = y_ticks;
    Panel { plots, layout }
}

/// Draws response spectra of one motion at one or several dampings: PSA, PSV and SD against period.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn response_spectrum_figure(
    words: Words<'_>,
    periods_s: &[f64],
    spectra: &[&DampedSpectrum],
) -> Result<Figure, FigureError> {
    draw(response_spectrum(words, periods_s, spectra))
}
