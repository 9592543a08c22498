//! A legend in rows under the panels.

use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::mark::{MarkerShape, add_marker};
use super::style::{CurveStyle, DARK, TEXT_PX, WIDTH_PX};

/// One entry of the legend.
#[derive(Debug, Clone)]
pub struct Entry {
    /// The sign that is drawn.
    pub sign: Sign,
    /// Its meaning.
    pub words: String,
}

impl Entry {
    /// An entry with its meaning.
    pub fn new(sign: Sign, words: impl Into<String>) -> Self {
        let words = words.into();
        Self { sign, words }
    }

    /// The entry of a line.
    pub fn line(
        colour: &'static str,
        width_px: f64,
        dash: Option<&'static str>,
        words: impl Into<String>,
    ) -> Self {
        let sign = Sign::Line {
            colour,
            width_px,
            dash,
        };
        Self::new(sign, words)
    }
}

/// The sign of an [`Entry`].
#[derive(Debug, Clone, Copy)]
pub enum Sign {
    /// A curve with its dashes and its marker.
    Curve(CurveStyle),
    /// A line without a marker.
    Line {
        /// Colour.
        colour: &'static str,
        /// Width \[px\].
        width_px: f64,
        /// Dashes; `None`: a solid line.
        dash: Option<&'static str>,
    },
    /// A band.
    Band,
    /// A light area.
    Shade {
        /// Colour.
        colour: &'static str,
        /// Opacity.
        opacity: f64,
    },
    /// The cross of an overturned object.
    Cross,
    /// A filled dot.
    Dot {
        /// Colour.
        colour: &'static str,
    },
    /// A square, or its outline.
    Square {
        /// Colour.
        colour: &'static str,
        /// Filled, or only an outline.
        filled: bool,
    },
}

/// About half the width of a marker.
const MARKER_PX: f64 = 4.2;
const SIGN_PX: f64 = 34.0;
const GAP_PX: f64 = 6.0;
const BETWEEN_PX: f64 = 18.0;
const ROW_PX: f64 = 21.0;
/// Mean width of a character of DejaVu Sans as a share of its size, rounded up.
const CHARACTER_SHARE: f64 = 0.6;

fn width_px(entry: &Entry) -> f64 {
    SIGN_PX + GAP_PX + words_px(&entry.words, TEXT_PX)
}

/// About the width of a text of this size; letters of East Asia and … are as wide as they are high.
pub(super) fn words_px(text: &str, size_px: u32) -> f64 {
    let share = |letter: char| match letter {
        '…' | '\u{1100}'..='\u{11FF}' | '\u{2E80}'.. => 1.0,
        _ => CHARACTER_SHARE,
    };
    f64::from(size_px) * text.chars().map(share).sum::<f64>()
}

/// Adds the entries below the scene in as many centred rows as they need, and increases its height.
pub fn add_legend(scene: &mut Scene, entries: &[Entry]) {
    let mut rows: Vec<(f64, Vec<&Entry>)> = Vec::new();
    for entry in entries {
        let width = width_px(entry);
        match rows.last_mut() {
            Some((used, row)) if *used + BETWEEN_PX + width <= WIDTH_PX - 20.0 => {
                *used += BETWEEN_PX + width;
                row.push(entry);
            }
            _ => rows.push((width, vec![entry])),
        }
    }
    for (used, row) in rows {
        let y = scene.height + 0.4 * ROW_PX;
        let mut x = 0.5 * (scene.width - used);
        for entry in row {
            add_sign(scene, entry.sign, x, y);
            scene.add(Primitive::Text {
                x: x + SIGN_PX + GAP_PX,
                y: y + 0.36 * f64::from(TEXT_PX),
                content: entry.words.clone(),
                size: TEXT_PX,
                anchor: TextAnchor::Start,
                rotate: None,
                bold: false,
                color: None,
            });
            x += width_px(entry) + BETWEEN_PX;
        }
        scene.height += ROW_PX;
    }
    scene.height += 4.0;
}

fn add_sign(scene: &mut Scene, sign: Sign, x: f64, y: f64) {
    let middle = x + 0.5 * SIGN_PX;
    match sign {
        Sign::Curve(style) => {
            add_line(scene, x, y, style.colour, 2.0, style.dash);
            add_marker(scene, style.marker, (middle, y), MARKER_PX, style.colour);
        }
        Sign::Line {
            colour,
            width_px,
            dash,
        } => add_line(scene, x, y, colour, width_px, dash),
        Sign::Band => add_area(scene, x, y, DARK, 0.2),
        Sign::Shade { colour, opacity } => add_area(scene, x, y, colour, opacity),
        Sign::Cross => {
            for side in [-4.0, 4.0] {
                scene.add(Primitive::Line {
                    x1: middle - 4.0,
                    y1: y - side,
                    x2: middle + 4.0,
                    y2: y + side,
                    stroke: DARK.into(),
                    stroke_width: 1.6,
                    stroke_dasharray: None,
                });
            }
        }
        Sign::Dot { colour } => {
            add_marker(scene, MarkerShape::Circle, (middle, y), MARKER_PX, colour)
        }
        Sign::Square { colour, filled } => scene.add(Primitive::Rect {
            x: middle - 4.2,
            y: y - 4.2,
            width: 8.4,
            height: 8.4,
            fill: if filled {
                colour.into()
            } else {
                "#ffffff".into()
            },
            stroke: Some(colour.into()),
            stroke_width: Some(1.6),
            opacity: None,
        }),
    }
}

fn add_area(scene: &mut Scene, x: f64, y: f64, fill: &str, opacity: f64) {
    scene.add(Primitive::Rect {
        x,
        y: y - 6.0,
        width: SIGN_PX,
        height: 12.0,
        fill: fill.into(),
        stroke: None,
        stroke_width: None,
        opacity: Some(opacity),
    });
}

fn add_line(scene: &mut Scene, x: f64, y: f64, colour: &str, width_px: f64, dash: Option<&str>) {
    scene.add(Primitive::Line {
        x1: x,
        y1: y,
        x2: x + SIGN_PX,
        y2: y,
        stroke: colour.into(),
        stroke_width: width_px,
        stroke_dasharray: dash.map(str::to_owned),
    });
}
