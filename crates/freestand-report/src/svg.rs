//! Lines, arrows and texts of the drawings of objects.

use maud::{Markup, Render, html};

/// How a line is drawn.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pen {
    pub(crate) colour: &'static str,
    pub(crate) width: f64,
    pub(crate) dashes: Option<&'static str>,
    /// The arrows at its ends.
    pub(crate) from: Option<&'static str>,
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

/// The arrow that a pen names by its id.
pub(crate) fn arrow(id: &str, size_px: u8) -> Markup {
    html! {
        defs {
            marker id=(id) viewBox="0 0 10 10" refX="9" refY="5" markerWidth=(size_px) markerHeight=(size_px)
                orient="auto-start-reverse" {
                path d="M0 0 L10 5 L0 10 z" fill="context-stroke" {}
            }
        }
    }
}

/// A drawing with its size and what it shows.
pub(crate) fn drawing([width, height]: [f64; 2], label: &str, content: &Markup) -> Markup {
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (width) " " (height) } role="img"
            aria-label=(label) font-family="Arial, sans-serif" font-size="12" { (content) }
    }
}
