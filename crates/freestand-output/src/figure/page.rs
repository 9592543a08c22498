//! Draws pages of panels as SVG and PNG.

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::figure::Figure as Grid;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene};

use super::legend::{Entry, add_legend};
use super::style::{TEXT_PX, WIDTH_PX};
use super::{Figure, FigureError};

/// One set of axes with its curves and markers.
pub struct Panel {
    /// Curves and markers.
    pub plots: Vec<Plot>,
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
    let rows = page.row_heights_px.len();
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    for panel in page.panels {
        plots.push(panel.plots);
        layouts.push(panel.layout);
    }
    // The library treats a cell without a layout as empty only if it has no plots either.
    while layouts.len() < rows * page.columns {
        plots.push(Vec::new());
        layouts.push(Layout::new((0.0, 1.0), (0.0, 1.0)));
    }
    let mut grid = Grid::new(rows, page.columns)
        .with_title(page.title.as_str())
        .with_title_size(TEXT_PX + 4)
        .with_spacing(GAP_PX)
        .with_padding(GAP_PX)
        .with_cell_size(panel_width_px(page.columns), 300.0)
        .with_plots(plots)
        .with_layouts(layouts);
    for (row, &height) in page.row_heights_px.iter().enumerate() {
        grid = grid.with_row_height(row, height);
    }
    let mut scene = grid.render();
    add_legend(&mut scene, &page.legend);
    let name = page.name;
    name_clips(&mut scene, &name);
    let png = PngBackend::new()
        .with_scale(PNG_SCALE)
        .render_scene(&scene)
        .map_err(|reason| FigureError {
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

/// Names the clipping paths after the figure: the library numbers them across the process, so the
/// same figure would differ from run to run.
fn name_clips(scene: &mut Scene, figure: &str) {
    let mut count = 0;
    let mut names: Vec<(String, String)> = Vec::new();
    for element in &mut scene.elements {
        if let Primitive::ClipStart { id, .. } = element {
            count += 1;
            let name = format!("{figure}-clip-{count}");
            names.push((format!("id=\"{id}\""), format!("id=\"{name}\"")));
            *id = name;
        }
    }
    for def in &mut scene.defs {
        if let Some((old, new)) = names.iter().find(|(old, _)| def.contains(old.as_str())) {
            *def = def.replace(old.as_str(), new);
        }
    }
}

/// Lets the drawing scale to the available width.
fn with_view_box(svg: String, width: f64, height: f64) -> String {
    svg.replacen(
        "<svg ",
        &format!("<svg viewBox=\"0 0 {width} {height}\" "),
        1,
    )
}
