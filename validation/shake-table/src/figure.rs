//! The reliability diagram.

use freestand_output::figure::legend::Entry;
use freestand_output::figure::mark::MarkerShape;
use freestand_output::figure::page::{Page, Panel, draw};
use freestand_output::figure::style::{Axis, GREY, axes, curve_style, line, markers};
use freestand_output::figure::{Figure, FigureError};

use crate::scores::Bin;

pub(crate) fn reliability(bins: &[Bin]) -> Result<Figure, FigureError> {
    let mut marks = vec![line(&[(0.0, 0.0), (1.0, 1.0)], GREY, 1.2, Some("6 4"))];
    let mut legend = vec![Entry::line(GREY, 1.2, Some("6 4"), "as often as said")];
    for rock in [1, 2] {
        let points: Vec<(f64, f64)> = bins
            .iter()
            .filter(|bin| bin.rock == rock)
            .map(|bin| (bin.said_mean, bin.fell_share))
            .collect();
        let colour = curve_style(rock - 1).colour;
        marks.push(line(&points, colour, 2.0, None));
        marks.push(markers(&points, colour, MarkerShape::Circle, 4.0));
        legend.push(Entry::line(colour, 2.0, None, format!("rock {rock}")));
    }
    let axis = |label: &str| Axis::from_zero(1.0, label);
    draw(Page {
        name: "shake-table".to_owned(),
        title: "Two rocks on a shake table".to_owned(),
        caption: "Tests by the probability that the body on its scanned hull overturns, over 20 histories of what \
                  is not known of a test; and the share of these tests in which it did."
            .to_owned(),
        panels: vec![Panel {
            marks,
            layout: axes(axis("probability of overturning, calculated"), axis("share that overturned")),
        }],
        columns: 1,
        row_heights_px: vec![420.0],
        legend,
    })
}
