//! What is drawn over the axes of a panel. The plot library draws some sixty kinds of plots, and whoever asks for one
//! of them links all; the axes come from it, these three kinds from here.

use kuva::render::layout::ComputedLayout;
use kuva::render::render::{PathData, Primitive, Scene, build_path};

/// Curves, markers and areas, in the values of the axes.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line through points.
    Line {
        /// Its points.
        points: Vec<(f64, f64)>,
        /// Its colour.
        colour: &'static str,
        /// Its width.
        width_px: f64,
        /// Its dashes; `None`: it is solid.
        dash: Option<&'static str>,
    },
    /// A marker at each point.
    Markers {
        /// The points.
        points: Vec<(f64, f64)>,
        /// Their colour.
        colour: &'static str,
        /// Their shape.
        shape: MarkerShape,
        /// About half their width.
        size_px: f64,
    },
    /// The area between two curves.
    Band {
        /// Abscissa, lower and upper ordinate of each point.
        points: Vec<(f64, f64, f64)>,
        /// Its colour.
        colour: &'static str,
        /// 1: nothing is seen through it.
        opacity: f64,
    },
}

/// The shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum MarkerShape {
    Circle,
    Square,
    Triangle,
    TriangleDown,
    Diamond,
    Plus,
    Cross,
}

/// Draws a mark over the axes.
pub(super) fn draw(mark: &Mark, axes: &ComputedLayout, scene: &mut Scene) {
    let at = |x: f64, y: f64| (axes.map_x(x), axes.map_y(y));
    match mark {
        // One point makes no line.
        Mark::Line { points, .. } if points.len() < 2 => {}
        Mark::Band { points, .. } if points.len() < 2 => {}
        Mark::Line {
            points,
            colour,
            width_px,
            dash,
        } => scene.add(Primitive::PolyLine {
            points: points.iter().map(|&(x, y)| at(x, y)).collect(),
            stroke: (*colour).into(),
            stroke_width: *width_px,
            stroke_dasharray: dash.map(str::to_owned),
        }),
        Mark::Markers {
            points,
            colour,
            shape,
            size_px,
        } => {
            for &(x, y) in points {
                let (x, y) = at(x, y);
                add_marker(scene, *shape, (x, y), *size_px, colour);
            }
        }
        Mark::Band {
            points,
            colour,
            opacity,
        } => {
            let upper = points.iter().map(|&(x, _, high)| at(x, high));
            let lower = points.iter().rev().map(|&(x, low, _)| at(x, low));
            let corners: Vec<(f64, f64)> = upper.chain(lower).collect();
            scene.add(Primitive::Path(Box::new(PathData {
                d: format!("{}Z", build_path(&corners)),
                fill: Some((*colour).into()),
                stroke: "none".into(),
                stroke_width: 0.0,
                opacity: Some(*opacity),
                stroke_dasharray: None,
            })));
        }
    }
}

/// Draws a marker at a place of the scene.
pub(super) fn add_marker(
    scene: &mut Scene,
    shape: MarkerShape,
    (x, y): (f64, f64),
    size: f64,
    colour: &str,
) {
    let corner = |(dx, dy): (f64, f64)| (x + size * dx, y + size * dy);
    let polygon = |corners: &[(f64, f64)]| {
        let corners: Vec<(f64, f64)> = corners.iter().map(|&at| corner(at)).collect();
        Primitive::Path(Box::new(PathData {
            d: format!("{}Z", build_path(&corners)),
            fill: Some(colour.into()),
            stroke: colour.into(),
            stroke_width: 0.5,
            opacity: None,
            stroke_dasharray: None,
        }))
    };
    let bar = |from, to| {
        let ((x1, y1), (x2, y2)) = (corner(from), corner(to));
        Primitive::Line {
            x1,
            y1,
            x2,
            y2,
            stroke: colour.into(),
            stroke_width: 1.5,
            stroke_dasharray: None,
        }
    };
    // Areas and heights that look alike.
    match shape {
        MarkerShape::Circle => scene.add(Primitive::Circle {
            cx: x,
            cy: y,
            r: size,
            fill: colour.into(),
            fill_opacity: None,
            stroke: None,
            stroke_width: None,
        }),
        MarkerShape::Square => scene.add(Primitive::Rect {
            x: x - size,
            y: y - size,
            width: 2.0 * size,
            height: 2.0 * size,
            fill: colour.into(),
            stroke: None,
            stroke_width: None,
            opacity: None,
        }),
        MarkerShape::Triangle => {
            scene.add(polygon(&[(0.0, -1.02), (-1.0, 0.68), (1.0, 0.68)]));
        }
        MarkerShape::TriangleDown => {
            scene.add(polygon(&[(0.0, 1.02), (-1.0, -0.68), (1.0, -0.68)]));
        }
        MarkerShape::Diamond => {
            scene.add(polygon(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]));
        }
        MarkerShape::Plus => {
            scene.add(bar((-0.9, 0.0), (0.9, 0.0)));
            scene.add(bar((0.0, -0.9), (0.0, 0.9)));
        }
        MarkerShape::Cross => {
            scene.add(bar((-0.9, -0.9), (0.9, 0.9)));
            scene.add(bar((-0.9, 0.9), (0.9, -0.9)));
        }
    }
}
