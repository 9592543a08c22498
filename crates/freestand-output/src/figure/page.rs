//! Draws pages of panels as SVG and PNG.

use kuva::backend::svg::SvgBackend;
use kuva::render::annotations::{add_reference_lines, add_shaded_regions, add_text_annotations};
use kuva::render::axis::{add_axes_and_grid, add_labels_and_title};
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::legend::{Entry, add_legend, words_px};
use super::mark::Mark;
use super::style::{TEXT_PX, WIDTH_PX};
use super::{Figure, FigureError, mark, raster};

/// One set of axes with its curves and markers.
pub struct Panel {
    /// Curves and markers.
    pub marks: Vec<Mark>,
    /// Axes.
    pub layout: Layout,
}

/// The content of a figure.
pub struct Page {
    /// The figure's name, with which its ids begin.
    pub name: String,
    /// Title, written above the panels.
    pub title: String,
    /// Caption: how to read the figure, in sentences.
    pub caption: String,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
    /// Number of panels in a row.
    pub columns: usize,
    /// Height of each row of panels \[px\].
    pub row_heights_px: Vec<f64>,
    /// The legend below the panels.
    pub legend: Vec<Entry>,
}

/// Pixels of the PNG for each pixel of the figure: 1600 px wide, 226 dpi at 180 mm.
const PNG_SCALE: f32 = 2.0;
const GAP_PX: f64 = 6.0;
const TITLE_PX: f64 = TEXT_PX as f64 + 4.0;
const TITLE_GAP_PX: f64 = 0.2 * TITLE_PX;
/// Above and below the base line, of the letters of DejaVu Sans.
const ASCENT_EM: f64 = 1901.0 / 2048.0;
const DESCENT_EM: f64 = 483.0 / 2048.0;
const TITLE_BAND_PX: f64 = (ASCENT_EM + DESCENT_EM) * TITLE_PX + 2.0 * TITLE_GAP_PX;

/// Number of columns for a number of panels: side by side up to three, then two in a row.
pub fn columns(panels: usize) -> usize {
    if panels <= 3 { panels.max(1) } else { 2 }
}

/// Width of a panel \[px\].
pub fn panel_width_px(columns: usize) -> f64 {
    (WIDTH_PX - 2.0 * GAP_PX - (columns as f64 - 1.0) * GAP_PX) / columns as f64
}

/// Draws a page.
pub fn draw(page: Page) -> Result<Figure, FigureError> {
    let rows = page.row_heights_px.len() as f64;
    let heights_px: f64 = page.row_heights_px.iter().sum();
    let mut scene = Scene::new(
        WIDTH_PX,
        TITLE_BAND_PX + 2.0 * GAP_PX + heights_px + (rows - 1.0) * GAP_PX,
    );
    scene.font_family = Some("DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif".to_owned());
    scene.text_color = Some("black".to_owned());
    let name = page.name;
    let width_px = panel_width_px(page.columns);
    let mut y = TITLE_BAND_PX + GAP_PX;
    let mut panels = page.panels.into_iter().enumerate();
    for &height_px in &page.row_heights_px {
        for column in 0..page.columns {
            let Some((i, panel)) = panels.next() else {
                break;
            };
            let x = GAP_PX + column as f64 * (width_px + GAP_PX);
            scene.add(Primitive::GroupStart {
                transform: Some(format!("translate({x},{y})")),
                title: None,
                extra_attrs: None,
            });
            let clip = format!("{name}-clip-{}", i + 1);
            add_panel(&mut scene, panel, (width_px, height_px), clip);
            scene.add(Primitive::GroupEnd);
        }
        y += height_px + GAP_PX;
    }
    scene.add(Primitive::Text {
        x: 0.5 * WIDTH_PX,
        y: TITLE_GAP_PX + ASCENT_EM * TITLE_PX,
        content: page.title.clone(),
        size: TITLE_PX as u32,
        anchor: TextAnchor::Middle,
        rotate: None,
        bold: false,
        color: None,
    });
    add_legend(&mut scene, &page.legend);
    let png = raster::png(&scene, PNG_SCALE).map_err(|reason| FigureError {
        figure: name.clone(),
        reason,
    })?;
    let svg = with_view_box(
        SvgBackend::new().render_scene(&scene),
        scene.width,
        scene.height,
    );
    Ok(Figure {
        name,
        title: page.title,
        caption: page.caption,
        svg,
        png,
    })
}

/// Draws the axes of a panel and what is over them.
fn add_panel(scene: &mut Scene, panel: Panel, (width_px, height_px): (f64, f64), clip: String) {
    let mut layout = panel.layout.with_width(width_px).with_height(height_px);
    layout.title = layout
        .title
        .map(|title| within(&title, layout.title_size, width_px));
    let axes = ComputedLayout::from_layout(&layout);
    add_axes_and_grid(scene, &axes, &layout);
    add_labels_and_title(scene, &axes, &layout);
    let [x, y, width, height] = [
        axes.margin_left,
        axes.margin_top,
        axes.plot_width(),
        axes.plot_height(),
    ];
    scene.defs.push(format!(
        r#"<clipPath id="{clip}"><rect x="{x:.2}" y="{y:.2}" width="{width:.2}" height="{height:.2}"/></clipPath>"#
    ));
    scene.add(Primitive::ClipStart {
        x,
        y,
        width,
        height,
        id: clip,
    });
    add_shaded_regions(&layout.shaded_regions, scene, &axes);
    for mark in &panel.marks {
        mark::draw(mark, &axes, scene);
    }
    add_reference_lines(&layout.reference_lines, scene, &axes);
    add_text_annotations(&layout.annotations, scene, &axes);
    scene.add(Primitive::ClipEnd);
}

/// A text of this size in this width: what is too long ends with `…`, because it would be cut at the edge.
fn within(text: &str, size_px: u32, width_px: f64) -> String {
    if words_px(text, size_px) <= width_px {
        return text.to_owned();
    }
    let mut short = String::new();
    for letter in text.chars() {
        short.push(letter);
        if words_px(&short, size_px) + words_px("…", size_px) > width_px {
            short.pop();
            break;
        }
    }
    // The half of an escaped `$` would begin a formula.
    format!("{}…", short.trim_end_matches(['\\', ' ']))
}

/// Lets the drawing scale to the available width.
fn with_view_box(svg: String, width: f64, height: f64) -> String {
    svg.replacen(
        "<svg ",
        &format!("<svg viewBox=\"0 0 {width} {height}\" "),
        1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::style::{Axis, axes};

    /// The whole of a short title is drawn; a long one fits its panel and says that it goes on.
    #[test]
    fn a_title_is_not_cut_at_the_edge() {
        let width_px = panel_width_px(2);
        assert_eq!(within("A-7 cabinet", 15, width_px), "A-7 cabinet");
        let long = "A-7 a cabinet of the archive on the third floor, beside the window";
        for text in [long.to_owned(), "保管庫の棚".repeat(9), "\\$".repeat(60)] {
            let short = within(&text, 15, width_px);
            assert!(short.ends_with('…') && !short.ends_with("\\…"), "{short}");
            assert!(words_px(&short, 15) <= width_px, "{short}");
            // No shorter than it must be: two letters and the half of a `$` are left over at most.
            assert!(words_px(&short, 15) > width_px - 60.0, "{short}");
        }
        let axis = || Axis {
            from: 0.0,
            to: 1.0,
            step: Some(0.5),
            label: String::new(),
        };
        let panel = || Panel {
            marks: Vec::new(),
            layout: axes(axis(), axis()).with_title(long),
        };
        let drawn = draw(Page {
            name: "titles".to_owned(),
            title: String::new(),
            caption: String::new(),
            panels: vec![panel(), panel()],
            columns: 2,
            row_heights_px: vec![200.0],
            legend: Vec::new(),
        });
        let svg = drawn.unwrap().svg;
        assert!(svg.contains("A-7 a cabinet of the archive") && !svg.contains("window"));
    }
}
