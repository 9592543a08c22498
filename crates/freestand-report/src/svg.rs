//! Lines, arrows and texts of the drawings of objects.

use maud::{Markup, Render, html};

/// Outlines, the floor and the weight.
pub(crate) const INK: &str = "#1a1a1a";
/// What holds the object.
pub(crate) const BLUE: &str = "#00558c";
/// The lines of dimensions, and their texts.
pub(crate) const DIMENSION: &str = "#666";
pub(crate) const LABEL: &str = "#444";

/// The end of a line that has an [`arrow`].
pub(crate) const TIP: Option<&str> = Some("url(#tip)");

/// How a line is drawn.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pen {
    pub(crate) colour: &'static str,
    pub(crate) width: f64,
    pub(crate) dashes: Option<&'static str>,
    /// The arrow at its start: [`TIP`].
    pub(crate) from: Option<&'static str>,
    /// The arrow at its end, likewise.
    pub(crate) to: Option<&'static str>,
}

/// A line without arrows.
pub(crate) fn pen(colour: &'static str, width: f64) -> Pen {
    Pen {
        colour,
        width,
        ..Pen::default()
    }
}

/// A length to a tenth of a pixel.
pub(crate) fn px(length: f64) -> String {
    format!("{length:.1}")
}

pub(crate) fn line([x1, y1, x2, y2]: [f64; 4], pen: Pen) -> Markup {
    html! {
        line x1=(px(x1)) y1=(px(y1)) x2=(px(x2)) y2=(px(y2)) stroke=(pen.colour) stroke-width=(pen.width)
            stroke-dasharray=[pen.dashes] marker-start=[pen.from] marker-end=[pen.to] {}
    }
}

/// A text with a white edge, because texts cross lines.
pub(crate) fn text([x, y]: [f64; 2], anchor: &str, colour: &str, words: impl Render) -> Markup {
    html! {
        text x=(px(x)) y=(px(y)) text-anchor=(anchor) fill=(colour)
            stroke="#fff" stroke-width="4" paint-order="stroke" { (words) }
    }
}

/// What [`TIP`] stands for; once in each drawing.
pub(crate) fn arrow() -> Markup {
    html! {
        defs {
            marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7"
                orient="auto-start-reverse" {
                path d="M0 0 L10 5 L0 10 z" fill="context-stroke" {}
            }
        }
    }
}

/// A drawing of this size; `label` says what it shows.
pub(crate) fn picture([width, height]: [f64; 2], label: &str, content: &Markup) -> Markup {
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (width) " " (height) } role="img"
            aria-label=(label) font-family="Arial, sans-serif" font-size="12" { (content) }
    }
}
