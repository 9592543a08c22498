//! Draws a scene of the plot library as PNG. The library can do so, too, with four fonts of 1.2 MB and without
//! the clipping of curves; all figures together need one font, five kinds of strokes and two transformations.
//!
//! `font/DejaVuSans.ttf` is DejaVu Sans 2.37 without hints, features of layout, and all letters but Latin, Greek and
//! Cyrillic, their marks, and signs of mathematics. fonttools made it:
//!
//! ```text
//! pyftsubset DejaVuSans.ttf --output-file=font/DejaVuSans.ttf --no-hinting --layout-features='' \
//!   --drop-tables+=GPOS,GSUB,GDEF,kern,FFTM,name --unicodes=U+0020-007E,U+00A0-024F,U+0259,\
//!   U+02B9-02DD,U+0300-0304,U+0308,U+030C,U+0370-03FF,U+0400-052F,U+1E00-1EFF,U+2010-2027,\
//!   U+2030-203A,U+2044,U+2070-209C,U+20AC,U+2116,U+2122,U+2126,U+2190-2199,U+2200-222B,U+2248,\
//!   U+2260-2265,U+25A0-25CF,U+2713,U+2717,U+FFFD
//! ```

use kuva::render::color::Color as Ink;
use kuva::render::math;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use tiny_skia::{
    Color, FillRule, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash,
    Transform,
};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

const FONT: &[u8] = include_bytes!("font/DejaVuSans.ttf");

/// How much wider the strokes of bold letters are, in heights of the letters.
const BOLD_EM: f32 = 0.05;

/// The scene as PNG, with so many pixels for one of the scene.
///
/// # Errors
/// What cannot be drawn.
pub(super) fn png(scene: &Scene, scale: f32) -> Result<Vec<u8>, String> {
    let [width, height] =
        [scene.width, scene.height].map(|px| (px as f32 * scale).ceil().max(1.0) as u32);
    let mut canvas = Canvas {
        pixels: Pixmap::new(width, height)
            .ok_or_else(|| format!("{width} × {height} pixels are too many"))?,
        font: Face::parse(FONT, 0).map_err(|error| error.to_string())?,
        text_ink: scene.text_color.as_deref().unwrap_or("black").into(),
        groups: vec![Transform::from_scale(scale, scale)],
        clips: Vec::new(),
    };
    let background = scene.background_color.as_deref().unwrap_or("white");
    if let Some(paint) = paint(&background.into(), None)? {
        canvas.pixels.fill(paint);
    }
    for element in &scene.elements {
        canvas.draw(element)?;
    }
    canvas
        .pixels
        .encode_png()
        .map_err(|error| error.to_string())
}

struct Canvas {
    pixels: Pixmap,
    font: Face<'static>,
    text_ink: Ink,
    /// From the coordinates of each open group, and before them of the scene, to pixels.
    groups: Vec<Transform>,
    /// What may be drawn on in each open clip.
    clips: Vec<Mask>,
}

/// The line around a shape.
struct Outline<'a> {
    ink: Option<&'a Ink>,
    width_px: f64,
    dash: Option<&'a str>,
}

impl Canvas {
    fn draw(&mut self, element: &Primitive) -> Result<(), String> {
        match element {
            Primitive::Circle {
                cx,
                cy,
                r,
                fill,
                fill_opacity,
                stroke,
                stroke_width,
            } => self.shape(
                PathBuilder::from_circle(*cx as f32, *cy as f32, *r as f32),
                (Some(fill), *fill_opacity),
                Outline::new(stroke.as_ref(), *stroke_width),
            ),
            Primitive::Rect {
                x,
                y,
                width,
                height,
                fill,
                stroke,
                stroke_width,
                opacity,
            } => self.shape(
                rectangle([*x, *y, *width, *height]),
                (Some(fill), *opacity),
                Outline::new(stroke.as_ref(), *stroke_width),
            ),
            Primitive::Line {
                x1,
                y1,
                x2,
                y2,
                stroke,
                stroke_width,
                stroke_dasharray,
            } => self.line(
                &[(*x1, *y1), (*x2, *y2)],
                (stroke, *stroke_width, stroke_dasharray.as_deref()),
            ),
            Primitive::PolyLine {
                points,
                stroke,
                stroke_width,
                stroke_dasharray,
            } => self.line(points, (stroke, *stroke_width, stroke_dasharray.as_deref())),
            Primitive::Path(path) => self.shape(
                drawn(&path.d)?,
                (path.fill.as_ref(), path.opacity),
                Outline {
                    ink: Some(&path.stroke),
                    width_px: path.stroke_width,
                    dash: path.stroke_dasharray.as_deref(),
                },
            ),
            Primitive::Text {
                x,
                y,
                content,
                size,
                anchor,
                rotate,
                bold,
                color,
            } => {
                let ink = color.clone().unwrap_or_else(|| self.text_ink.clone());
                let (x, y) = (*x as f32, *y as f32);
                let turned = rotate.map_or(Transform::identity(), |angle| {
                    Transform::from_rotate_at(angle as f32, x, y)
                });
                let letters =
                    self.letters(&math::to_unicode(content), (x, y), *size as f32, *anchor);
                self.groups.push(self.group().pre_concat(turned));
                let bold_px = if *bold {
                    f64::from(BOLD_EM * *size as f32)
                } else {
                    0.0
                };
                let outline = Outline::new(Some(&ink), Some(bold_px));
                let drawn = self.shape(letters, (Some(&ink), None), outline);
                self.groups.pop();
                drawn
            }
            Primitive::GroupStart { transform, .. } => {
                let moved = match transform {
                    None => Transform::identity(),
                    Some(text) => {
                        translation(text).ok_or_else(|| format!("`{text}` is not drawn"))?
                    }
                };
                self.groups.push(self.group().pre_concat(moved));
                Ok(())
            }
            Primitive::GroupEnd => {
                self.groups.pop();
                Ok(())
            }
            Primitive::ClipStart {
                x,
                y,
                width,
                height,
                ..
            } => {
                let mut mask =
                    Mask::new(self.pixels.width(), self.pixels.height()).ok_or("no pixels")?;
                let transform = self.group();
                if let Some(path) = rectangle([*x, *y, *width, *height]) {
                    mask.fill_path(&path, FillRule::Winding, true, transform);
                }
                self.clips.push(mask);
                Ok(())
            }
            Primitive::ClipEnd => {
                self.clips.pop();
                Ok(())
            }
            Primitive::RichText { .. }
            | Primitive::RectBatch { .. }
            | Primitive::CircleBatch { .. } => {
                Err("text of several styles and batches of shapes are not drawn".to_owned())
            }
        }
    }

    fn group(&self) -> Transform {
        self.groups.last().copied().unwrap_or_default()
    }

    fn line(
        &mut self,
        points: &[(f64, f64)],
        (ink, width_px, dash): (&Ink, f64, Option<&str>),
    ) -> Result<(), String> {
        let outline = Outline {
            ink: Some(ink),
            width_px,
            dash,
        };
        self.shape(polyline(points), (None, None), outline)
    }

    /// Fills a shape and draws the line around it; one without extent is not seen.
    fn shape(
        &mut self,
        path: Option<Path>,
        (fill, opacity): (Option<&Ink>, Option<f64>),
        outline: Outline<'_>,
    ) -> Result<(), String> {
        let Some(path) = path else { return Ok(()) };
        let (transform, clip) = (self.group(), self.clips.last());
        let solid = |color| {
            let mut paint = Paint::default();
            paint.set_color(color);
            paint
        };
        let fill = fill.map(|ink| paint(ink, opacity)).transpose()?.flatten();
        if let Some(color) = fill {
            self.pixels
                .fill_path(&path, &solid(color), FillRule::Winding, transform, clip);
        }
        let line = outline
            .ink
            .map(|ink| paint(ink, None))
            .transpose()?
            .flatten();
        if let Some(color) = line.filter(|_| outline.width_px > 0.0) {
            let stroke = Stroke {
                width: outline.width_px as f32,
                line_join: LineJoin::Round,
                dash: outline.dash.and_then(dash),
                ..Stroke::default()
            };
            self.pixels
                .stroke_path(&path, &solid(color), &stroke, transform, clip);
        }
        Ok(())
    }

    /// The outlines of a text at a place; a letter that the font lacks is a box.
    fn letters(
        &self,
        text: &str,
        (x, y): (f32, f32),
        size_px: f32,
        anchor: TextAnchor,
    ) -> Option<Path> {
        let scale = size_px / f32::from(self.font.units_per_em());
        // The font's own glyph for what it lacks was emptied with its hints.
        let lacking = self.font.glyph_index('□').unwrap_or(GlyphId(0));
        let glyphs = text
            .chars()
            .map(|letter| if letter.is_whitespace() { ' ' } else { letter })
            .map(|letter| self.font.glyph_index(letter).unwrap_or(lacking));
        let advance = |glyph| scale * f32::from(self.font.glyph_hor_advance(glyph).unwrap_or(0));
        let width_px: f32 = glyphs.clone().map(advance).sum();
        let mut pen = Pen {
            path: PathBuilder::new(),
            scale,
            x: match anchor {
                TextAnchor::Start => x,
                TextAnchor::Middle => x - 0.5 * width_px,
                TextAnchor::End => x - width_px,
            },
            y,
        };
        for glyph in glyphs {
            self.font.outline_glyph(glyph, &mut pen);
            pen.x += advance(glyph);
        }
        pen.path.finish()
    }
}

impl<'a> Outline<'a> {
    fn new(ink: Option<&'a Ink>, width_px: Option<f64>) -> Self {
        Self {
            ink,
            // As in SVG.
            width_px: width_px.unwrap_or(1.0),
            dash: None,
        }
    }
}

/// Draws a letter where it stands.
struct Pen {
    path: PathBuilder,
    scale: f32,
    x: f32,
    y: f32,
}

impl Pen {
    /// The font's second axis points up, that of the scene down.
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + self.scale * x, self.y - self.scale * y)
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// The colour of an ink; `None` for one that leaves no trace.
fn paint(ink: &Ink, opacity: Option<f64>) -> Result<Option<Color>, String> {
    match ink {
        Ink::None => Ok(None),
        Ink::Rgb(r, g, b) => {
            let mut color = Color::from_rgba8(*r, *g, *b, u8::MAX);
            color.set_alpha(opacity.unwrap_or(1.0) as f32);
            Ok(Some(color))
        }
        Ink::Css(name) => Err(format!("the colour `{name}` is not known")),
    }
}

fn rectangle(place: [f64; 4]) -> Option<Path> {
    let [x, y, width, height] = place.map(|px| px as f32);
    Rect::from_xywh(x, y, width, height).map(PathBuilder::from_rect)
}

fn polyline(points: &[(f64, f64)]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, &(x, y)) in points.iter().enumerate() {
        match i {
            0 => path.move_to(x as f32, y as f32),
            _ => path.line_to(x as f32, y as f32),
        }
    }
    path.finish()
}

/// A path as SVG writes it, of straight lines.
fn drawn(text: &str) -> Result<Option<Path>, String> {
    let mut path = PathBuilder::new();
    let mut rest = text;
    while let Some(command) = rest.trim_start().chars().next() {
        rest = &rest.trim_start()[command.len_utf8()..];
        let end = rest
            .find(|letter: char| letter.is_ascii_alphabetic() && letter != 'e')
            .unwrap_or(rest.len());
        let (numbers, after) = rest.split_at(end);
        rest = after;
        let at = numbers_of(numbers);
        match (command, at.as_deref()) {
            ('M', Some(&[x, y])) => path.move_to(x, y),
            ('L', Some(&[x, y])) => path.line_to(x, y),
            ('Z', Some([])) => path.close(),
            _ => return Err(format!("the path `{command}{numbers}` is not drawn")),
        }
    }
    Ok(path.finish())
}

fn translation(text: &str) -> Option<Transform> {
    let inner = text.strip_prefix("translate(")?.strip_suffix(')')?;
    match numbers_of(inner)?.as_slice() {
        &[x, y] => Some(Transform::from_translate(x, y)),
        _ => None,
    }
}

fn dash(text: &str) -> Option<StrokeDash> {
    StrokeDash::new(numbers_of(text)?, 0.0)
}

fn numbers_of(text: &str) -> Option<Vec<f32>> {
    let parts = text.split([' ', ',']).filter(|part| !part.is_empty());
    parts.map(|part| part.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(scene: &Scene, x: u32, y: u32) -> [u8; 3] {
        let pixels = Pixmap::decode_png(&png(scene, 2.0).unwrap()).unwrap();
        assert_eq!((pixels.width(), pixels.height()), (80, 40));
        let seen = pixels.pixel(2 * x, 2 * y).unwrap();
        [seen.red(), seen.green(), seen.blue()]
    }

    fn square(scene: &mut Scene, fill: &str) {
        scene.add(Primitive::Rect {
            x: 0.0,
            y: 0.0,
            width: 20.0,
            height: 20.0,
            fill: fill.into(),
            stroke: None,
            stroke_width: None,
            opacity: None,
        });
    }

    #[test]
    fn groups_move_and_clips_hide() {
        let mut scene = Scene::new(40.0, 20.0);
        scene.add(Primitive::GroupStart {
            transform: Some("translate(15,0)".to_owned()),
            title: None,
            extra_attrs: None,
        });
        scene.add(Primitive::ClipStart {
            x: 0.0,
            y: 0.0,
            width: 10.0,
            height: 20.0,
            id: "clip".to_owned(),
        });
        square(&mut scene, "#0072b2");
        scene.add(Primitive::ClipEnd);
        scene.add(Primitive::GroupEnd);
        assert_eq!(pixel(&scene, 5, 10), [255; 3]);
        assert_eq!(pixel(&scene, 20, 10), [0x00, 0x72, 0xb2]);
        assert_eq!(pixel(&scene, 30, 10), [255; 3]);
        square(&mut scene, "#d55e00");
        assert_eq!(pixel(&scene, 5, 10), [0xd5, 0x5e, 0x00]);
    }

    /// The letter I is a bar, and stands left of, on, or right of its place.
    #[test]
    fn text_stands_where_its_anchor_says() {
        for (anchor, x) in [
            (TextAnchor::Start, 22),
            (TextAnchor::Middle, 20),
            (TextAnchor::End, 17),
        ] {
            let mut scene = Scene::new(40.0, 20.0);
            scene.add(Primitive::Text {
                x: 20.0,
                y: 18.0,
                content: "I".to_owned(),
                size: 20,
                anchor,
                rotate: None,
                bold: true,
                color: Some("#000000".into()),
            });
            let is_dark = |x| pixel(&scene, x, 10) == [0; 3];
            let dark: Vec<u32> = (0..40).filter(|x| is_dark(*x)).collect();
            assert!(dark.contains(&x), "{anchor:?}: {dark:?}");
        }
    }

    #[test]
    fn a_letter_that_the_font_lacks_is_a_box() {
        let mut scene = Scene::new(40.0, 20.0);
        scene.add(Primitive::Text {
            x: 10.0,
            y: 18.0,
            content: "日".to_owned(),
            size: 20,
            anchor: TextAnchor::Start,
            rotate: None,
            bold: true,
            color: Some("#000000".into()),
        });
        assert!((0..40).any(|x| pixel(&scene, x, 10) != [255; 3]));
    }

    #[test]
    fn the_font_has_the_letters_of_figures() {
        let font = Face::parse(FONT, 0).unwrap();
        let letters = "AZaz09ÄßÅŁğőøþαβσμΔΩπ°²³·×–−—…≥≤≠≈√∞→←Жя‰€";
        let missing: Vec<char> = letters
            .chars()
            .filter(|letter| font.glyph_index(*letter).is_none())
            .collect();
        assert_eq!(missing, []);
    }

    #[test]
    fn what_cannot_be_drawn_is_said() {
        assert!(drawn("M1 2 L3,4Z").unwrap().is_some());
        for path in ["M1 2 C3 4 5 6 7 8", "M1", "L1 2 3", "Mx y"] {
            assert!(drawn(path).is_err(), "{path}");
        }
        assert!(paint(&"a hue".into(), None).is_err());
    }
}
