//! Spectra of matched motions against their target.

use freestand::G0_M_S2;
use freestand::motion::Motion;
use freestand::oscillator::response_spectrum;
use freestand::synthesis::{DAMPING_RATIO, matched_periods_s};
use freestand_study::matched::FitReport;
use rayon::prelude::*;

use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, GREY, curve_style, line, over_periods, plain, points};
use freestand_output::figure::time::stacked;
use freestand_output::figure::{Figure, FigureError};

/// Height of the panel \[px\].
const PANEL_PX: f64 = 380.0;
/// Largest number of motions with a curve of their own; the mean is that of all.
const MAX_DRAWN: usize = 100;

/// The contents of a figure of matched motions.
#[derive(Debug, Clone, Copy)]
pub struct MatchedPicture<'a> {
    /// What the motions are, for the title.
    pub title: &'a str,
    /// The target's name, for the legend.
    pub target: &'a str,
    /// The target at the matched periods \[g\].
    pub target_sa_g: &'a [f64],
    /// The motions.
    pub motions: &'a [&'a Motion],
}

/// Draws the spectra of motions against their target.
///
/// # Errors
/// The error of the plot library.
pub fn matched_figure(picture: &MatchedPicture<'_>) -> Result<Figure, FigureError> {
    let periods_s = matched_periods_s();
    let psa_g: Vec<Vec<f64>> = picture
        .motions
        .par_iter()
        .filter_map(|motion| response_spectrum(motion, DAMPING_RATIO, &periods_s).ok())
        .map(|spectrum| spectrum.psa_m_s2.iter().map(|psa| psa / G0_M_S2).collect())
        .collect();
    let mean: Vec<f64> = (0..periods_s.len())
        .map(|i| {
            (psa_g.iter().map(|psa| psa[i].ln()).sum::<f64>() / psa_g.len().max(1) as f64).exp()
        })
        .collect();
    let drawn = psa_g.iter().take(MAX_DRAWN);
    let highest = drawn
        .clone()
        .flatten()
        .chain(picture.target_sa_g)
        .copied()
        .fold(0.0, f64::max);
    let points = |values: &[f64]| points(&periods_s, values).collect::<Vec<_>>();
    let (target_style, mean_style) = (curve_style(1), curve_style(0));
    let several = psa_g.len() > 1;
    let (dash, mean_words) = if several {
        (Some("6 4"), "geometric mean")
    } else {
        (None, "the motion")
    };
    let mut marks: Vec<_> = if several {
        drawn
            .map(|psa| line(&points(psa), GREY, 0.7, None))
            .collect()
    } else {
        Vec::new()
    };
    marks.push(line(&points(&mean), mean_style.colour, 1.8, dash));
    marks.push(line(
        &points(picture.target_sa_g),
        target_style.colour,
        2.2,
        None,
    ));
    let first = periods_s.first().copied().unwrap_or(0.05);
    let last = periods_s.last().copied().unwrap_or(5.0);
    let y = Axis::from_zero(1.02 * highest, "PSA (g)");
    let top = y.to;
    let layout = over_periods(
        stacked(Axis::between(first, last, "Period (s)"), y, true),
        top,
    );
    draw(Page {
        name: "target".to_owned(),
        title: plain(picture.title),
        caption: format!(
            "Pseudo-acceleration, 5 % damping, {} at the 121 periods from 0.05 to 5 s, and the target, {}.",
            if several {
                format!("of {} motions and their geometric mean", psa_g.len())
            } else {
                "of the motion".to_owned()
            },
            picture.target
        ),
        panels: vec![Panel { marks, layout }],
        columns: 1,
        row_heights_px: vec![PANEL_PX],
        legend: [
            Some(Entry::line(
                target_style.colour,
                2.2,
                None,
                plain(picture.target),
            )),
            Some(Entry::line(mean_style.colour, 1.8, dash, mean_words)),
            several.then(|| Entry::line(GREY, 0.7, None, "each motion")),
        ]
        .into_iter()
        .flatten()
        .collect(),
    })
}

/// The spectra of the motions and their target.
///
/// # Errors
/// The error of the plot library.
pub fn fit_figure(report: &FitReport) -> Result<Figure, FigureError> {
    let made = "Synthetic motions and their target";
    let target_sa_g: Vec<f64> = matched_periods_s()
        .iter()
        .map(|&t| report.target.spectrum.sa_g(t))
        .collect();
    matched_figure(&MatchedPicture {
        title: if report.seed.is_some() {
            made
        } else {
            "A matched record and its target"
        },
        target: "the target",
        target_sa_g: &target_sa_g,
        motions: &report
            .motions
            .iter()
            .map(|one| &one.motion)
            .collect::<Vec<_>>(),
    })
}
