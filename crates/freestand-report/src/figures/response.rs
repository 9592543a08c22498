//! Uplift, shock and overturning against height, as in the paper's Fig. 7.

use freestand_output::figure::mark::{Mark, MarkerShape};
use kuva::render::annotations::{ShadedRegion, TextAnnotation};
use kuva::render::layout::TickFormat;

use freestand_input::words::number;
use freestand_study::cushion::cushion_words;
use freestand_study::result::{LevelResult, ObjectStatistics, Ranked, StudyResult};
use freestand_study::study::Study;

use super::kind::FigureKind;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, columns};
use freestand_output::figure::style::{
    Axis, BAND_OPACITY, CurveStyle, DARK, LABELS_PX, TEXT_PX, TITLE_PX, axes, band, curve_style,
    line, markers, plain,
};

/// Height of a panel \[px\].
const PANEL_PX: f64 = 330.0;
/// Its height inside the axes \[px\].
const INSIDE_PX: f64 = PANEL_PX - TITLE_PX - LABELS_PX;
/// Height of the strip's title and of each of its rows \[px\].
const STRIP_TITLE_PX: f64 = 18.0;
const STRIP_ROW_PX: f64 = 10.0;
/// Largest number of thicknesses with bands: more would cover each other.
const MAX_BANDS: usize = 6;
/// Approximate number of markers on a curve.
const MARKERS_ON_CURVE: usize = 7;

/// One object of a curve: height, the quantity at 16, 50 and 84 %, and its upper limit.
struct Point {
    height_m: f64,
    ranked: [Ranked; 3],
    ceiling: Option<f64>,
}

type Quantity = fn(&ObjectStatistics) -> ([Ranked; 3], Option<f64>);

/// Uplift spectra.
pub(super) fn urs(study: &Study, result: &StudyResult) -> Page {
    let quantity: Quantity = |s| (s.uplift_m.map(|r| scaled(r, 1e3)), None);
    spectra(
        FigureKind::Urs,
        study,
        result,
        quantity,
        "Uplift (mm)",
        "Uplift spectra (URS)",
        format!(
            "Largest uplift of the base edge against the height of the object: {}. {}",
            median_words(result),
            OVERTURNED_WORDS
        ),
    )
}

/// Shock spectra.
pub(super) fn srs(study: &Study, result: &StudyResult) -> Page {
    let quantity: Quantity = |s| (s.edge_acceleration_g, Some(s.ceiling_g));
    spectra(
        FigureKind::Srs,
        study,
        result,
        quantity,
        "Shock (g)",
        "Shock spectra (SRS)",
        format!(
            "Shock at the edge that lands by the paper’s Eqs. (5) and (7), from the largest rise of the centre of \
             gravity, for {} kg on {}: {}. {} Dotted: the uplift ceiling, the shock of a landing from the balance \
             point, which this source of energy cannot exceed.",
            number(study.objects.mass_kg, 6),
            cushion_words(&study.objects.cushion.cushion),
            median_words(result),
            OVERTURNED_WORDS
        ),
    )
}

/// Share of the motions that overturn.
pub(super) fn overturning(study: &Study, result: &StudyResult) -> Page {
    let panels = result.levels.iter().map(|level| {
        let mut marks = Vec::new();
        for (index, &thickness_m) in thicknesses(study).iter().enumerate() {
            let style = curve_style(index);
            let points: Vec<(f64, f64)> = objects(level, thickness_m)
                .into_iter()
                .filter(|s| s.motions > 0)
                .map(|s| (s.height_m, s.overturned_share))
                .collect();
            marks.push(line(&points, style.colour, 2.0, style.dash));
            let marked: Vec<_> = some_of(&points, index)
                .into_iter()
                .filter(|p| p.1 > 0.0)
                .collect();
            marks.push(markers(&marked, style.colour, style.marker, 3.5));
        }
        let y = Axis {
            step: Some(0.2),
            ..Axis::between(-0.02, 1.04, "Share of motions")
        };
        let layout = axes(height_axis(study), y).with_title(plain(&level.level.name));
        Panel { marks, layout }
    });
    let panels: Vec<Panel> = panels.collect();
    let (columns, row_heights_px) = grid(panels.len(), 0.85 * PANEL_PX);
    Page {
        name: FigureKind::Overturning.name(),
        title: "Share of the motions that overturn the object".into(),
        caption:
            "Share of the ground motions that overturn an object of this height and thickness. Overturning does not \
             increase steadily with height or with the intensity of the motion; a share of few motions is a coarse \
             estimate."
                .into(),
        panels,
        columns,
        row_heights_px,
        legend: thickness_entries(study),
    }
}

const OVERTURNED_WORDS: &str = "A curve ends where half or more of the motions overturn the object; crosses in the \
                                strip at the top mark those heights, one row for each thickness with its marker at \
                                the left. Nothing is extrapolated.";

fn median_words(result: &StudyResult) -> String {
    match result.motions.len() {
        1 => "one motion, one curve for each thickness".into(),
        n => format!(
            "the median over {n} motions, one curve for each thickness, with the band from 16 to 84 % where both \
             are numbers (no uplift counts as 0, overturned as larger than any number)"
        ),
    }
}

fn scaled(ranked: Ranked, factor: f64) -> Ranked {
    match ranked {
        Ranked::Value(v) => Ranked::Value(v * factor),
        other => other,
    }
}

fn value(ranked: Ranked) -> Option<f64> {
    match ranked {
        Ranked::Value(v) if v.is_finite() => Some(v),
        _ => None,
    }
}

fn spectra(
    kind: FigureKind,
    study: &Study,
    result: &StudyResult,
    quantity: Quantity,
    y_label: &str,
    title: &str,
    caption: String,
) -> Page {
    let panels: Vec<Panel> = result
        .levels
        .iter()
        .map(|level| level_panel(study, level, quantity, y_label))
        .collect();
    let (columns, row_heights_px) = grid(panels.len(), PANEL_PX);
    let mut legend = thickness_entries(study);
    if with_bands(study, result) {
        legend.push(Entry::new(Sign::Band, "16–84 % of motions"));
    }
    if kind == FigureKind::Srs {
        legend.push(Entry::line(DARK, 1.2, Some(CEILING_DASH), "uplift ceiling"));
    }
    legend.push(Entry::new(Sign::Cross, "half or more overturn it"));
    let title = match result.motions.len() {
        1 => title.to_owned(),
        n => format!("{title}: median of {n} motions"),
    };
    Page {
        name: kind.name(),
        title,
        caption,
        panels,
        columns,
        row_heights_px,
        legend,
    }
}

const CEILING_DASH: &str = "1 4";

fn grid(panels: usize, height_px: f64) -> (usize, Vec<f64>) {
    let columns = columns(panels);
    (columns, vec![height_px; panels.div_ceil(columns)])
}

fn with_bands(study: &Study, result: &StudyResult) -> bool {
    result.motions.len() > 1 && thicknesses(study).len() <= MAX_BANDS
}

fn level_panel(study: &Study, level: &LevelResult, quantity: Quantity, y_label: &str) -> Panel {
    let thicknesses = thicknesses(study);
    let curves: Vec<Vec<Point>> = thicknesses
        .iter()
        .map(|&t| {
            objects(level, t)
                .into_iter()
                .map(|s| {
                    let (ranked, ceiling) = quantity(s);
                    Point {
                        height_m: s.height_m,
                        ranked,
                        ceiling,
                    }
                })
                .collect()
        })
        .collect();
    let bands = thicknesses.len() <= MAX_BANDS;
    let highest = curves
        .iter()
        .flatten()
        .flat_map(|p| p.ranked[if bands { 0 } else { 1 }..if bands { 3 } else { 2 }].iter())
        .filter_map(|&r| value(r))
        .fold(0.0, f64::max);
    let y = Axis::from_zero(highest, y_label);
    let fallen = curves
        .iter()
        .filter(|c| c.iter().any(|p| p.ranked[1] == Ranked::Overturned))
        .count();

    let mut marks = Vec::new();
    if bands {
        curves
            .iter()
            .enumerate()
            .for_each(|(i, curve)| marks.extend(bands_of(curve, curve_style(i))));
    }
    for (i, curve) in curves.iter().enumerate() {
        marks.extend(ceiling(curve, y.to, curve_style(i)));
    }
    for (i, curve) in curves.iter().enumerate() {
        marks.extend(median(curve, i));
    }
    let (strip, layout) = strip(&curves, fallen, with_keys(height_axis(study)), y);
    marks.extend(strip);
    Panel {
        marks,
        layout: layout.with_title(plain(&level.level.name)),
    }
}

/// The crosses of the overturned in a strip above the data, a row for each curve that has any.
fn strip(
    curves: &[Vec<Point>],
    fallen: usize,
    x: Axis,
    y: Axis,
) -> (Vec<Mark>, kuva::render::layout::Layout) {
    let data_top = y.to;
    if fallen == 0 {
        return (
            Vec::new(),
            axes(
                x,
                Axis {
                    to: 1.04 * data_top,
                    ..y
                },
            ),
        );
    }
    let strip_px = STRIP_TITLE_PX + STRIP_ROW_PX * fallen as f64;
    let top = data_top * INSIDE_PX / (INSIDE_PX - strip_px).max(0.3 * INSIDE_PX);
    let per_px = (top - data_top) / strip_px;
    let mut marks = Vec::new();
    let mut row = 0.0;
    for (i, curve) in curves.iter().enumerate() {
        let y = top - per_px * (STRIP_TITLE_PX + STRIP_ROW_PX * (row + 0.4));
        let crosses: Vec<(f64, f64)> = curve
            .iter()
            .filter(|p| p.ranked[1] == Ranked::Overturned)
            .map(|p| (p.height_m, y))
            .collect();
        if !crosses.is_empty() {
            let style = curve_style(i);
            marks.push(markers(&crosses, style.colour, MarkerShape::Cross, 3.2));
            // The curve's own marker, left of all data, says whose row it is.
            marks.push(markers(
                &[(x.from + 0.5 * KEYS_SHARE * (x.to - x.from), y)],
                style.colour,
                style.marker,
                3.2,
            ));
            row += 1.0;
        }
    }
    let middle = 0.5 * (x.from + x.to);
    let label_y = top - per_px * (STRIP_TITLE_PX + 2.0);
    let mut layout = axes(x, Axis { to: top, ..y })
        .with_shaded_region(
            ShadedRegion::horizontal(data_top, top)
                .with_color("#efefef")
                .with_opacity(1.0),
        )
        .with_annotation(
            TextAnnotation::new("overturned", middle, label_y)
                .with_font_size(TEXT_PX)
                .with_color(DARK),
        );
    layout.y_tick_format = ticks_up_to(data_top);
    (marks, layout)
}

/// Share of the axis left of all data, for the keys of the strip.
const KEYS_SHARE: f64 = 0.06;

/// The axis with room for the keys of the strip at its left.
fn with_keys(x: Axis) -> Axis {
    Axis {
        from: x.to - (x.to - x.from) / (1.0 - KEYS_SHARE),
        ..x
    }
}

/// The strip has no scale and therefore no tick labels.
fn ticks_up_to(top: f64) -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(move |v| {
        if v <= top * (1.0 + 1e-9) {
            TickFormat::Auto.format(v)
        } else {
            String::new()
        }
    }))
}

/// Runs of neighbouring heights for which `pick` gives a value.
fn runs<T>(curve: &[Point], pick: impl Fn(&Point) -> Option<T>) -> Vec<Vec<T>> {
    let mut runs = vec![Vec::new()];
    for point in curve {
        match (pick(point), runs.last_mut()) {
            (Some(item), Some(run)) => run.push(item),
            (None, Some(run)) if !run.is_empty() => runs.push(Vec::new()),
            _ => {}
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

fn bands_of(curve: &[Point], style: CurveStyle) -> Vec<Mark> {
    runs(curve, |p| {
        Some((p.height_m, value(p.ranked[0])?, value(p.ranked[2])?))
    })
    .into_iter()
    .filter(|run| run.len() > 1 && run.iter().any(|&(_, low, high)| high > low))
    .map(|run| band(run, style.colour, BAND_OPACITY))
    .collect()
}

/// The part of the ceiling inside the axes, and one point outside, which is clipped.
fn ceiling(curve: &[Point], top: f64, style: CurveStyle) -> Vec<Mark> {
    let points: Vec<(f64, f64)> = curve
        .iter()
        .filter_map(|p| Some((p.height_m, p.ceiling?)))
        .collect();
    let mut cut: Vec<(f64, f64)> = Vec::new();
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        if y0.min(y1) > top {
            continue;
        }
        let at_top = |y: f64, x: f64| {
            if y > top {
                (x0 + (x1 - x0) * (top - y0) / (y1 - y0), top)
            } else {
                (x, y)
            }
        };
        for point in [at_top(y0, x0), at_top(y1, x1)] {
            if cut.last() != Some(&point) {
                cut.push(point);
            }
        }
    }
    if cut.len() < 2 {
        Vec::new()
    } else {
        vec![line(&cut, style.colour, 1.2, Some(CEILING_DASH))]
    }
}

fn median(curve: &[Point], index: usize) -> Vec<Mark> {
    let style = curve_style(index);
    let mut marks = Vec::new();
    for run in runs(curve, |p| Some((p.height_m, value(p.ranked[1])?))) {
        // Where objects do not uplift, the curves coincide, and their markers would hide each
        // other.
        let mut marked: Vec<_> = some_of(&run, index)
            .into_iter()
            .filter(|p| p.1 > 0.0)
            .collect();
        // The end of a curve is a result of its own, and a lone point has no line.
        if let Some(&end) = run.last()
            && marked.last() != Some(&end)
        {
            marked.push(end);
        }
        marks.push(line(&run, style.colour, 2.0, style.dash));
        marks.push(markers(&marked, style.colour, style.marker, 3.5));
    }
    marks
}

/// A few points of a curve for its marker, at other heights than those of its neighbours.
fn some_of(points: &[(f64, f64)], index: usize) -> Vec<(f64, f64)> {
    let stride = (points.len() / MARKERS_ON_CURVE).max(1);
    points
        .iter()
        .copied()
        .skip(index % stride)
        .step_by(stride)
        .collect()
}

fn thicknesses(study: &Study) -> Vec<f64> {
    let mut thicknesses = study.objects.thicknesses_m.clone();
    thicknesses.sort_by(f64::total_cmp);
    thicknesses
}

/// The objects of one thickness in order of height.
fn objects(level: &LevelResult, thickness_m: f64) -> Vec<&ObjectStatistics> {
    let mut objects: Vec<_> = level
        .statistics
        .iter()
        .flatten()
        .filter(|s| s.thickness_m == thickness_m)
        .collect();
    objects.sort_by(|a, b| a.height_m.total_cmp(&b.height_m));
    objects
}

fn height_axis(study: &Study) -> Axis {
    let heights = &study.objects.heights_m;
    let from = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let to = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (from, to) = if from <= to { (from, to) } else { (0.0, 1.0) };
    Axis::around(from, to, "Height of the object (m)")
}

fn thickness_entries(study: &Study) -> Vec<Entry> {
    let entry = |(index, thickness_m): (usize, &f64)| {
        Entry::new(
            Sign::Curve(curve_style(index)),
            format!("t = {} mm", number(1e3 * thickness_m, 4)),
        )
    };
    thicknesses(study).iter().enumerate().map(entry).collect()
}
