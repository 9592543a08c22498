//! How shock and overturning depend on each assumption, level by level.

use std::sync::Arc;

use freestand_output::figure::mark::Mark;
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::TickFormat;

use freestand_study::result::{Sensitivity, VariedLevel};

use super::kind::FigureKind;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel};
use freestand_output::figure::style::{
    Axis, DARK, LABELS_PX, TITLE_PX, axes, curve_style, line, markers, plain, rule,
};

/// Height of one row \[px\].
const ROW_PX: f64 = 19.0;
const DOT_PX: f64 = 4.5;

/// A quantity of a row, and its label.
type Quantity = (fn(&VariedLevel) -> Option<f64>, &'static str);

const QUANTITIES: [Quantity; 2] = [
    (
        |row| row.edge_acceleration_g_median,
        "Largest median shock (g)",
    ),
    (
        |row| row.overturned_share.map(|share| 100.0 * share),
        "Histories that overturn (%)",
    ),
];

/// Two panels for each level, with a row for every change: from the value of the unchanged study to
/// that with the change.
pub(super) fn vary(sensitivity: &Sensitivity, levels: &[String]) -> Page {
    let mut panels = Vec::new();
    let mut most_rows = 0;
    for level in levels {
        let rows: Vec<&VariedLevel> = sensitivity
            .rows
            .iter()
            .filter(|row| row.level == *level)
            .collect();
        most_rows = most_rows.max(rows.len().saturating_sub(1));
        panels.extend(QUANTITIES.map(|quantity| panel(level, &rows, quantity)));
    }
    let legend = vec![
        Entry::new(Sign::Curve(curve_style(0)), "with the value at the left"),
        Entry::line(DARK, 1.2, Some("5 4"), "the unchanged study"),
    ];
    Page {
        name: FigureKind::Vary.name(),
        title: "How the result depends on each assumption".into(),
        caption: "One value of the study is changed at a time. The largest median shock is the largest median over \
                  the motions of any object that fewer than half of them overturn. Where it decreases, an object may \
                  have begun to overturn, so read both panels together. A row without a dot has no value; vary.csv \
                  states why."
            .into(),
        row_heights_px: vec![TITLE_PX + LABELS_PX + ROW_PX * most_rows as f64; levels.len()],
        panels,
        columns: 2,
        legend,
    }
}

fn panel(level: &str, rows: &[&VariedLevel], (quantity, label): Quantity) -> Panel {
    let base = rows.first().and_then(|row| quantity(row));
    let variations = rows.get(1..).unwrap_or(&[]);
    let values: Vec<Option<f64>> = variations.iter().map(|row| quantity(row)).collect();
    let count = variations.len();
    // The first variation at the top.
    let height = |index: usize| (count - index) as f64;
    let mut marks: Vec<Mark> = Vec::new();
    for (index, value) in values.iter().enumerate() {
        let Some(value) = *value else { continue };
        // One colour and marker for each key, which makes its values a group.
        let key = variations[..index]
            .windows(2)
            .filter(|pair| pair[0].parameter != pair[1].parameter)
            .count()
            + usize::from(
                index > 0 && variations[index].parameter != variations[index - 1].parameter,
            );
        let style = curve_style(key);
        if let Some(base) = base {
            marks.push(line(
                &[(base, height(index)), (value, height(index))],
                style.colour,
                1.4,
                None,
            ));
        }
        marks.push(markers(
            &[(value, height(index))],
            style.colour,
            style.marker,
            DOT_PX,
        ));
    }
    let largest = values
        .iter()
        .flatten()
        .chain(base.iter())
        .copied()
        .fold(0.0, f64::max);
    let y = Axis {
        step: Some(1.0),
        ..Axis::between(0.4, count as f64 + 0.6, "")
    };
    let mut layout = axes(Axis::from_zero(1.02 * largest, label), y).with_title(plain(level));
    let names: Vec<String> = variations.iter().map(|row| plain(&row.words())).collect();
    layout.y_tick_format = TickFormat::Custom(Arc::new(move |at| {
        let index = count as f64 - at;
        let is_row = (index - index.round()).abs() < 1e-6 && index > -0.5;
        is_row
            .then(|| names.get(index.round() as usize).cloned())
            .flatten()
            .unwrap_or_default()
    }));
    if let Some(base) = base {
        layout = layout.with_reference_line(rule(ReferenceLine::vertical(base), DARK, 1.2, "5 4"));
    }
    Panel { marks, layout }
}
