//! Acceleration spectra of the ground and of each floor.

use freestand::G0_M_S2;
use freestand::code_spectrum::CodeSpectrum;
use freestand_output::figure::mark::Mark;
use kuva::render::annotations::ReferenceLine;

use freestand_study::result::{PseudoSpectrum, StudyResult};
use freestand_study::statistics::{QUANTILES, ranked_quantile};
use freestand_study::study::{Ground, Study};

use super::kind::FigureKind;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, columns};
use freestand_output::figure::style::{
    Axis, BAND_OPACITY, DARK, GREY, axes, band, curve_style, decades, line, plain, rule,
};

const PANEL_PX: f64 = 310.0;
/// Above this number motions are drawn as a band from 16 to 84 %.
const MAX_LINES: usize = 40;
/// Modes whose periods are marked.
const MARKED_MODES: usize = 3;
const TARGET_DASH: &str = "8 6";

/// Spectra of the ground, with the target if there is one, and of each level.
pub(super) fn floor_spectra(study: &Study, result: &StudyResult) -> Page {
    let ground: Vec<&PseudoSpectrum> = result.ground.iter().map(|g| &g.spectrum).collect();
    let target = study.ground.code_spectrum().and_then(|target| {
        let code = &target.spectrum;
        let periods = &ground.first()?.periods_s;
        let points = periods
            .iter()
            .filter(|&&t| t > 0.0)
            .map(|&t| (t, code.sa_g(t)));
        // A table may end before the last period of the figure.
        let points: Vec<_> = points.filter(|point| point.1.is_finite()).collect();
        Some(points)
    });
    let modes: Vec<f64> = result
        .modes
        .iter()
        .take(MARKED_MODES)
        .map(freestand::building::Mode::period_s)
        .collect();
    let mut panels = Vec::new();
    if !ground.is_empty() {
        panels.push(panel("ground", &ground, target.as_deref(), &[]));
    }
    for level in &result.levels {
        let spectra: Vec<_> = level.spectra.iter().collect();
        let modes: &[f64] = if level.level.level_ratio != Some(0.0) {
            &modes
        } else {
            &[]
        };
        panels.push(panel(&level.level.name, &spectra, None, modes));
    }
    let columns = columns(panels.len());
    let mut legend = Vec::new();
    let n = result.motions.len();
    if n > MAX_LINES {
        legend.push(Entry::new(Sign::Band, "16–84 % of motions"));
    } else if n > 1 {
        legend.push(Entry::line(GREY, 0.9, None, "each motion"));
    }
    let words = if n > 1 { "median" } else { "the motion" };
    legend.push(Entry::line(curve_style(0).colour, 2.4, None, words));
    if let Some(target) = study.ground.code_spectrum() {
        let words = match (&study.ground, &target.spectrum) {
            // The motions fit it on rock and over some periods only.
            (Ground::Simulated(_), _) => "code spectrum",
            // Their mean fits it, over some periods.
            _ if study.ground.suite().is_some() => "target of the suite",
            (_, CodeSpectrum::Table(_)) => "target spectrum",
            _ => "target: code spectrum",
        };
        legend.push(Entry::line(
            curve_style(1).colour,
            2.0,
            Some(TARGET_DASH),
            words,
        ));
    }
    Page {
        name: FigureKind::FloorSpectra.name(),
        title: if ground.is_empty() {
            "Acceleration spectra of the floors"
        } else {
            "Acceleration spectra of the ground and the floors"
        }
        .into(),
        caption: format!(
            "Pseudo-spectral acceleration at 5 % damping against period{}; each panel has its own scale. {}The \
             spectra show how the building changes the motion. They do not predict the rocking, because \
             free-standing objects have no natural period.",
            if study.directions_deg.len() > 1 {
                ", the largest over all horizontal directions (RotD100)"
            } else {
                ""
            },
            if modes.is_empty() {
                ""
            } else {
                "T₁, T₂, T₃ are the building’s periods. "
            },
        ),
        row_heights_px: vec![PANEL_PX; panels.len().div_ceil(columns)],
        panels,
        columns,
        legend,
    }
}

fn panel(
    name: &str,
    spectra: &[&PseudoSpectrum],
    target: Option<&[(f64, f64)]>,
    modes: &[f64],
) -> Panel {
    let curves: Vec<Vec<(f64, f64)>> = spectra.iter().map(|s| points(s)).collect();
    let [low, median, high] = quantiles(&curves);
    let mut marks: Vec<Mark> = Vec::new();
    if curves.len() > MAX_LINES {
        let between = low
            .iter()
            .zip(&high)
            .map(|(low, high)| (low.0, low.1, high.1));
        marks.push(band(between, DARK, BAND_OPACITY));
    } else if curves.len() > 1 {
        marks.extend(curves.iter().map(|c| line(c, GREY, 0.9, None)));
    }
    marks.push(line(&median, curve_style(0).colour, 2.4, None));
    if let Some(target) = target {
        marks.push(line(target, curve_style(1).colour, 2.0, Some(TARGET_DASH)));
    }
    let drawn = curves.iter().flatten().chain(target.unwrap_or(&[]));
    let (mut from, mut to, mut highest) = (f64::INFINITY, 0.0f64, 0.0f64);
    for &(t, sa) in drawn {
        (from, to, highest) = (from.min(t), to.max(t), highest.max(sa));
    }
    if from >= to {
        (from, to) = (0.05, 5.0);
    }
    let x = Axis::between(from, to, "Period (s)");
    let mut y = Axis::from_zero(1.02 * highest, "Spectral acceleration (g)");
    // The periods are written at the top, above the curves.
    if !modes.is_empty() {
        y.to *= 1.08;
    }
    let mut layout = axes(x, y).with_title(plain(name)).with_log_x();
    layout.x_tick_format = decades();
    for (i, &period_s) in modes
        .iter()
        .enumerate()
        .filter(|(_, t)| (from..=to).contains(*t))
    {
        let mark = rule(ReferenceLine::vertical(period_s), DARK, 0.8, "2 3");
        layout = layout.with_reference_line(mark.with_label(["T₁", "T₂", "T₃"][i.min(2)]));
    }
    Panel { marks, layout }
}

fn points(spectrum: &PseudoSpectrum) -> Vec<(f64, f64)> {
    let pairs = spectrum.periods_s.iter().zip(&spectrum.psa_m_s2);
    pairs
        .filter(|&(&t, a)| t > 0.0 && a.is_finite())
        .map(|(&t, &a)| (t, a / G0_M_S2))
        .collect()
}

/// 16, 50 and 84 % at each period; empty if the curves have different periods.
fn quantiles(curves: &[Vec<(f64, f64)>]) -> [Vec<(f64, f64)>; 3] {
    let mut result = [Vec::new(), Vec::new(), Vec::new()];
    let Some(first) = curves.first() else {
        return result;
    };
    if curves.iter().any(|c| c.len() != first.len()) {
        return result;
    }
    for (i, &(t, _)) in first.iter().enumerate() {
        let mut values: Vec<f64> = curves.iter().map(|c| c[i].1).collect();
        for (points, quantile) in result.iter_mut().zip(QUANTILES) {
            if let Some(value) = ranked_quantile(&mut values, quantile).value() {
                points.push((t, value));
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spectra_at_different_periods_have_no_median() {
        let curves = [vec![(0.1, 1.0), (0.2, 1.0)], vec![(0.1, 1.0)]];
        assert!(quantiles(&curves)[1].is_empty());
    }
}
