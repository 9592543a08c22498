//! A wall beside an object, and what of the object it stops.

use super::Shape;
use super::element::{Element, Role};
use crate::compliant::EdgeSide;
use crate::compliant::pad::Pad;
use crate::cushion::Cushion;

/// A smooth wall beside an object, along y; it moves with the floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// The side on which it stands.
    pub side: EdgeSide,
    /// Distance from the face of the object \[m\].
    pub gap_m: f64,
    /// Its height \[m\]; infinite for one that is taller than the object.
    pub height_m: f64,
    /// The cushion between the wall and an edge of the object, at its top or at its base; `None`: that under an
    /// edge.
    pub cushion: Option<Cushion>,
}

impl Wall {
    /// Whether the object meets the top of the wall with its face, and not the wall with its top edge: on its foot
    /// that reaches the wall at the height √(h² − gap²).
    pub(super) fn is_low(&self, shape: &Shape) -> bool {
        let [_, _, height] = shape.sizes_m();
        self.height_m < height && self.height_m.hypot(self.gap_m) < height
    }

    /// Its elements; `foot` is one of the object on the floor. The corners of the object meet the wall; a low wall meets
    /// those of the base below its top, and the face with its top.
    pub(super) fn elements<'a>(&'a self, shape: &Shape, foot: &Element<'a>) -> Vec<Element<'a>> {
        let [thickness, width, height] = shape.sizes_m();
        let (cg_height, half) = (0.5 * height, 0.5 * thickness);
        let out = match self.side {
            EdgeSide::Left => -1.0,
            EdgeSide::Right => 1.0,
        };
        let cushion = self.cushion.as_ref().unwrap_or(foot.pad.cushion);
        // The two ends of an edge, or its middle in the plane and on a rim.
        let ends = match shape {
            Shape::Prism { .. } => vec![-0.5 * width, 0.5 * width],
            Shape::Plane { .. } | Shape::Cylinder { .. } => vec![0.0],
        };
        let at = |point: [f64; 3], rim_m: f64| Element {
            point,
            rim_m,
            normal: 0,
            sign: -out,
            gap: self.gap_m + (half - out * point[0]),
            pad: Pad {
                cushion,
                share: 1.0 / ends.len() as f64,
            },
            tangential_stiffness: 0.0,
            friction: None,
            unit_m: cushion.static_compression_m(0.5 * foot.weight_n),
            role: Role::Wall,
            ..*foot
        };
        // Of an edge at this height above the centre of gravity.
        let edge = |z: f64| -> Vec<Element<'a>> {
            match shape {
                Shape::Cylinder { .. } => vec![at([0.0, 0.0, z], half)],
                Shape::Prism { .. } | Shape::Plane { .. } => [half, -half]
                    .into_iter()
                    .flat_map(|x| ends.iter().map(move |y| [x, *y, z]))
                    .map(|point| at(point, 0.0))
                    .collect(),
            }
        };
        if !self.is_low(shape) {
            return [edge(-cg_height), edge(cg_height)].concat();
        }
        let base = edge(-cg_height).into_iter().map(|one| Element {
            end: Some((2, self.height_m)),
            ..one
        });
        let face = ends.iter().map(|y| Element {
            point_of: None,
            point: [out * (half + self.gap_m), *y, self.height_m],
            face_of: Some(0),
            sign: out,
            gap: self.gap_m,
            end: Some((2, cg_height)),
            ..at([0.0; 3], 0.0)
        });
        base.chain(face).collect()
    }
}
