//! The object with its force, weight, anchors and bracket, as SVG.

use freestand_assess::restrain::Case;
use maud::{Markup, html};

use crate::svg::{BLUE, DIMENSION, INK, LABEL, Pen, TIP, arrow, line, pen, picture, px, text};

/// Size of the picture \[px\].
const WIDTH_PX: f64 = 380.0;
const HEIGHT_PX: f64 = 330.0;
/// The floor \[px\].
const FLOOR_PX: f64 = 270.0;
/// The largest sizes of the object \[px\].
const OBJECT_PX: [f64; 2] = [130.0, 225.0];
/// The middle of the object \[px\].
const MIDDLE_PX: f64 = 170.0;

const RED: &str = "#b00020";

/// The sketch: the side in which the object tips first.
pub(super) fn sketch(case: &Case) -> Markup {
    let object = &case.question.object;
    let force = &case.own;
    let side_m = case
        .own
        .axis
        .as_ref()
        .map_or(case.request.thickness_m, |axis| axis.base_m);
    let scale = (OBJECT_PX[0] / side_m).min(OBJECT_PX[1] / object.height_m);
    let (width, height) = (side_m * scale, object.height_m * scale);
    let (left, right, top) = (
        MIDDLE_PX - width / 2.0,
        MIDDLE_PX + width / 2.0,
        FLOOR_PX - height,
    );
    let (cg, bracket) = (
        FLOOR_PX - object.cg_height_m * scale,
        FLOOR_PX - force.bracket_height_m * scale,
    );
    let units = case.request.units;
    let length = |length_m: f64| units.length(length_m);
    let inset = case.own.inset_m() * scale;
    let thin = pen(DIMENSION, 1.0);
    let both = Pen {
        from: TIP,
        to: TIP,
        ..thin
    };
    let to_tip = |colour, width| Pen {
        to: TIP,
        ..pen(colour, width)
    };
    let to_wall = Pen {
        dashes: Some("6 4"),
        ..pen(BLUE, 2.0)
    };
    let content = html! {
        (arrow())
        (line([40.0, FLOOR_PX, 340.0, FLOOR_PX], pen(INK, 2.0)))
        // The wall that a bracket is fixed to.
        (line([320.0, top.min(bracket) - 12.0, 320.0, FLOOR_PX], pen("#999", 2.0)))
        (line([right, bracket, 320.0, bracket], to_wall))
        rect x=(px(left)) y=(px(top)) width=(px(width)) height=(px(height))
            fill="#f2f2f2" stroke=(INK) stroke-width="1.5" {}
        circle cx=(MIDDLE_PX) cy=(px(cg)) r="4" {}
        // F from the left to the centre of gravity; the weight; the anchors of the edge that lifts.
        (line([left - 70.0, cg, left - 4.0, cg], to_tip(RED, 2.5)))
        (line([MIDDLE_PX, cg, MIDDLE_PX, (cg + 42.0).min(FLOOR_PX - 4.0)], to_tip(INK, 1.5)))
        @for x in [left + inset, right - inset] {
            (line([x, FLOOR_PX - 10.0, x, FLOOR_PX + 14.0], pen(BLUE, 4.0)))
        }
        @if force.anchor_tension_n > 0.0 {
            (line([left + inset, FLOOR_PX + 14.0, left + inset, FLOOR_PX + 40.0], to_tip(BLUE, 2.5)))
        }
        // Dimensions: the height and that of the centre of gravity on the right, the side below.
        (line([right + 24.0, top, right + 24.0, FLOOR_PX], both))
        (line([right + 4.0, cg, right + 44.0, cg], thin))
        (line([right + 38.0, cg, right + 38.0, FLOOR_PX], both))
        (line([left, FLOOR_PX + 52.0, right, FLOOR_PX + 52.0], both))
        (text([left - 10.0, cg - 12.0], "end", RED, format!("F = {}", units.force(force.force_n))))
        (text([MIDDLE_PX + 7.0, cg + 26.0], "start", INK, "W"))
        (text([right + 20.0, top - 5.0], "middle", LABEL, length(object.height_m)))
        (text([right + 44.0, (cg + FLOOR_PX) / 2.0], "start", LABEL, length(object.cg_height_m)))
        (text([MIDDLE_PX, FLOOR_PX + 47.0], "middle", LABEL, length(side_m)))
        @if force.anchor_tension_n > 0.0 {
            @let tension = format!("T = {}", units.force(force.anchor_tension_n));
            (text([left - 2.0, FLOOR_PX + 34.0], "end", BLUE, tension))
        }
        @let or_bracket = format!("or P = {}", units.force(force.bracket_force_n));
        (text([316.0, bracket - 6.0], "end", BLUE, or_bracket))
    };
    picture(
        [WIDTH_PX, HEIGHT_PX],
        "The object with its forces",
        &content,
    )
}
