//! Peak floor accelerations over the height of a building.

use freestand_output::figure::mark::{Mark, MarkerShape};
use freestand_study::floor::FloorReport;

use freestand_input::words::number;
use freestand_study::statistics::{QUANTILES, ranked_quantile};
use freestand_study::target::CodeParts;

use freestand_output::figure::legend::Entry;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, GREY, axes, curve_style, line, markers};
use freestand_output::figure::{Figure, FigureError};

const PANEL_PX: f64 = 420.0;
/// Up to this many levels are marked one by one.
const MARKED_LEVELS: usize = 12;
const QUANTILE_DASH: &str = "3 4";
const CODE_DASH: &str = "10 6";

/// The contents of a figure of peak floor accelerations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ProfilePicture<'a> {
    /// Levels as shares of the height, in any order.
    pub levels_ratio: &'a [f64],
    /// Height of the roof \[m\]; `None`: the axis shows shares.
    pub height_m: Option<f64>,
    /// Peak floor accelerations, `[motion][level]` \[g\].
    pub pfa_g: &'a [Vec<f64>],
    /// Peak ground acceleration of each motion \[g\]; drawn where no level is the ground. May be
    /// empty.
    pub pga_g: &'a [f64],
    /// What a code prescribes for parts at these levels.
    pub code: Option<&'a CodeParts>,
}

/// The page with the profile.
pub(super) fn floor_profile(name: &str, picture: &ProfilePicture<'_>) -> Page {
    let scale = picture.height_m.unwrap_or(1.0);
    let curves: Vec<Vec<(f64, f64)>> = picture
        .pfa_g
        .iter()
        .enumerate()
        .map(|(i, motion)| curve(picture, motion, picture.pga_g.get(i), scale))
        .collect();
    let several = curves.len() > 1;
    let mut marks: Vec<Mark> = Vec::new();
    let mut legend = Vec::new();
    if several {
        marks.extend(curves.iter().map(|curve| line(curve, GREY, 0.9, None)));
        legend.push(Entry::line(GREY, 0.9, None, "each motion"));
    }
    let [low, median, high] = QUANTILES.map(|quantile| quantile_curve(&curves, quantile));
    let colour = curve_style(0).colour;
    if several {
        for curve in [&low, &high] {
            marks.push(line(curve, colour, 1.4, Some(QUANTILE_DASH)));
        }
    }
    marks.push(line(&median, colour, 2.4, None));
    if median.len() <= MARKED_LEVELS {
        marks.push(markers(&median, colour, MarkerShape::Circle, 3.5));
    }
    let words = if several { "median" } else { "the motion" };
    legend.push(Entry::line(colour, 2.4, None, words));
    if several {
        legend.push(Entry::line(colour, 1.4, Some(QUANTILE_DASH), "16 and 84 %"));
    }
    let code: Vec<(f64, f64)> = picture
        .code
        .iter()
        .flat_map(|code| code.accel_g.iter().zip(picture.levels_ratio))
        .map(|(&accel_g, level_ratio)| (accel_g, scale * level_ratio))
        .collect();
    if let Some(CodeParts { clause, .. }) = picture.code {
        let colour = curve_style(1).colour;
        marks.push(line(&code, colour, 2.0, Some(CODE_DASH)));
        legend.push(Entry::line(colour, 2.0, Some(CODE_DASH), *clause));
    }
    let largest = curves
        .iter()
        .flatten()
        .chain(&code)
        .map(|point| point.0)
        .fold(0.0, f64::max);
    let label = if picture.height_m.is_some() {
        "Height (m)"
    } else {
        "Height as a share z/H (–)"
    };
    let y = Axis::between(0.0, 1.02 * scale, label);
    let layout = axes(
        Axis::from_zero(1.02 * largest, "Peak floor acceleration (g)"),
        y,
    );
    Page {
        name: name.to_owned(),
        title: "Peak floor accelerations".to_owned(),
        caption: caption(picture, &median),
        panels: vec![Panel { marks, layout }],
        columns: 1,
        row_heights_px: vec![PANEL_PX],
        legend,
    }
}

fn caption(picture: &ProfilePicture<'_>, median: &[(f64, f64)]) -> String {
    let of = |point: Option<&(f64, f64)>| {
        point.map_or_else(|| "–".to_owned(), |point| number(point.0, 3))
    };
    let motions = match picture.pfa_g.len() {
        1 => "one motion:".to_owned(),
        n => format!("{n} motions; median:"),
    };
    let code = picture.code.map_or_else(String::new, |code| {
        format!(
            " Dashed: the acceleration that a rigid part is designed for, {}.",
            code.clause
        )
    });
    format!(
        "Largest absolute acceleration of the floors over the height under {motions} {} g at the lowest level, \
         {} g at the highest.{code}",
        of(median.first()),
        of(median.last())
    )
}

/// Acceleration and height of the levels of one motion, from the lowest up, with the ground where
/// no level is the ground.
fn curve(
    picture: &ProfilePicture<'_>,
    motion: &[f64],
    pga_g: Option<&f64>,
    scale: f64,
) -> Vec<(f64, f64)> {
    let levels = picture.levels_ratio.iter().zip(motion);
    let mut points: Vec<(f64, f64)> = levels.map(|(&level, &pfa)| (pfa, scale * level)).collect();
    if !picture.levels_ratio.contains(&0.0) {
        points.extend(pga_g.map(|&pga| (pga, 0.0)));
    }
    points.sort_by(|a, b| a.1.total_cmp(&b.1));
    points
}

fn quantile_curve(curves: &[Vec<(f64, f64)>], quantile: f64) -> Vec<(f64, f64)> {
    let Some(first) = curves.first() else {
        return Vec::new();
    };
    let point = |(i, &(_, height)): (usize, &(f64, f64))| {
        let mut values: Vec<f64> = curves
            .iter()
            .filter_map(|curve| curve.get(i))
            .map(|point| point.0)
            .collect();
        Some((ranked_quantile(&mut values, quantile).value()?, height))
    };
    first.iter().enumerate().filter_map(point).collect()
}

/// The profile over the height as a figure.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn profile_figure(report: &FloorReport) -> Result<Figure, FigureError> {
    let profile = || report.levels.iter().map(|level| &level.profile);
    let pfa_g: Vec<Vec<f64>> = report
        .motions
        .iter()
        .map(|motion| motion.levels.iter().map(|level| level.pfa_g).collect())
        .collect();
    let code = report.code_clause.map(|clause| CodeParts {
        clause,
        accel_g: profile().filter_map(|level| level.code_part_g).collect(),
    });
    let picture = ProfilePicture {
        levels_ratio: &profile()
            .map(|level| level.level_ratio)
            .collect::<Vec<f64>>(),
        height_m: Some(report.building_height_m),
        pfa_g: &pfa_g,
        pga_g: &report
            .motions
            .iter()
            .map(|motion| motion.pga_g)
            .collect::<Vec<f64>>(),
        code: code.as_ref(),
    };
    draw(floor_profile("profile", &picture))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ground_is_added_where_no_level_is_it() {
        let pfa = [vec![0.4, 0.2], vec![0.8, 0.6]];
        let mut picture = ProfilePicture {
            levels_ratio: &[1.0, 0.5],
            height_m: Some(10.0),
            pfa_g: &pfa,
            pga_g: &[0.1, 0.3],
            code: None,
        };
        let curve = |picture: &ProfilePicture<'_>| {
            curve(picture, &picture.pfa_g[0], picture.pga_g.first(), 10.0)
        };
        assert_eq!(curve(&picture), [(0.1, 0.0), (0.2, 5.0), (0.4, 10.0)]);
        picture.levels_ratio = &[1.0, 0.0];
        assert_eq!(curve(&picture), [(0.2, 0.0), (0.4, 10.0)]);
    }
}
