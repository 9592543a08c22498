//! Figures against time: the axis, stacked panels, and long series reduced to the pixels.

use kuva::render::layout::Layout;

use super::page::panel_width_px;
use super::style::{Axis, LABELS_PX, TITLE_PX, axes, round_step};

/// Margins that make the time axes of the panels agree \[px\].
const MARGINS_PX: (f64, f64) = (76.0, 18.0);
/// Room above and below a panel that is between two others \[px\].
const BETWEEN_PX: (f64, f64) = (8.0, 10.0);

/// The time axis; only the lowest panel shows its label.
pub fn time_axis(from: f64, to: f64) -> Axis {
    Axis {
        from,
        to,
        step: Some(round_step((to - from) / 8.0)),
        label: "Time (s)".into(),
    }
}

/// One of several stacked panels with the same x axis.
pub fn stacked(x: Axis, y: Axis, lowest: bool) -> Layout {
    let mut layout = axes(x, y).with_force_margins(MARGINS_PX.0, MARGINS_PX.1);
    if !lowest {
        layout.x_label = None;
        layout.suppress_x_ticks = true;
        layout.with_force_margins_y(BETWEEN_PX.0, BETWEEN_PX.1)
    } else {
        layout.with_force_margins_y(BETWEEN_PX.0, LABELS_PX)
    }
}

/// A stacked panel with a line of text above it.
pub fn stacked_with_title(x: Axis, y: Axis, lowest: bool, title: String) -> Layout {
    let below = if lowest { LABELS_PX } else { BETWEEN_PX.1 };
    stacked(x, y, lowest)
        .with_title(title)
        .with_force_margins_y(TITLE_PX, below)
}

/// An axis from −`largest` to `largest`, rounded up.
pub fn symmetric(largest: f64, label: &str) -> Axis {
    let mut y = Axis::from_zero(1.05 * largest, label);
    y.from = -y.to;
    y.step = y.step.map(|step| round_step(2.0 * step));
    y
}

/// The first and the last time of a history; `None` where there is nothing to draw between them.
pub fn span<P>(history: &[P], time_s: impl Fn(&P) -> f64) -> Option<(f64, f64)> {
    let (from, to) = (time_s(history.first()?), time_s(history.last()?));
    (to > from).then_some((from, to))
}

/// The largest magnitude of a curve.
pub fn peak(points: &[(f64, f64)]) -> f64 {
    points
        .iter()
        .fold(0.0, |most, point| most.max(point.1.abs()))
}

/// The pixel column of `t` in a panel over the whole width.
pub fn pixel(t: f64, from: f64, to: f64) -> usize {
    ((t - from) / (to - from) * (panel_width_px(1) - MARGINS_PX.0 - MARGINS_PX.1)) as usize
}

/// Keeps at most four points for each pixel column (first, lowest, highest, last), which leaves the
/// drawing unchanged.
pub fn thin(points: impl Iterator<Item = (f64, f64)>, from: f64, to: f64) -> Vec<(f64, f64)> {
    let mut thinned: Vec<(f64, f64)> = Vec::new();
    let mut column: Vec<(f64, f64)> = Vec::new();
    let mut at = usize::MAX;
    for point in points {
        let now = pixel(point.0, from, to);
        if now != at {
            flush(&mut column, &mut thinned);
            at = now;
        }
        column.push(point);
    }
    flush(&mut column, &mut thinned);
    thinned
}

fn flush(column: &mut Vec<(f64, f64)>, thinned: &mut Vec<(f64, f64)>) {
    let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    let extremes = [
        column.first(),
        column.iter().min_by(by_value),
        column.iter().max_by(by_value),
        column.last(),
    ];
    let mut kept: Vec<(f64, f64)> = extremes.into_iter().flatten().copied().collect();
    kept.sort_by(|a, b| a.0.total_cmp(&b.0));
    kept.dedup();
    thinned.append(&mut kept);
    column.clear();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_extremes() {
        let n = 100_000;
        let points: Vec<(f64, f64)> = (0..=n)
            .map(|i| (i as f64 / n as f64, (i as f64 * 0.37).sin()))
            .collect();
        let thinned = thin(points.iter().copied(), 0.0, 1.0);
        assert!(
            thinned.len() <= 4 * (panel_width_px(1) as usize + 1),
            "{}",
            thinned.len()
        );
        assert_eq!(
            (thinned[0], thinned[thinned.len() - 1]),
            (points[0], points[n])
        );
        let top = |p: &[(f64, f64)]| p.iter().map(|p| p.1).fold(f64::MIN, f64::max);
        assert_eq!(top(&thinned), top(&points));
        assert!(thinned.windows(2).all(|w| w[0].0 < w[1].0));
    }
}
