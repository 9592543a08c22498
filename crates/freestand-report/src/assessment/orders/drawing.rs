//! The object from its side, with its restraint, the wall and the anchors, to scale.

use freestand_assess::restraint::inset_m;
use freestand_inventory::library::RestraintKind;
use freestand_risk::budget::PlanRow;
use maud::{Markup, html};

use crate::svg::{BLUE, DIMENSION, INK, LABEL, Pen, TIP, arrow, line, pen, picture, px, text};

/// Size of the picture \[px\].
const WIDTH_PX: f64 = 380.0;
const HEIGHT_PX: f64 = 250.0;
/// The floor \[px\].
const FLOOR_PX: f64 = 196.0;
/// The largest sizes of the object \[px\].
const OBJECT_PX: [f64; 2] = [120.0, 165.0];
/// The side of the object that is turned to the wall \[px\].
const RIGHT_PX: f64 = 215.0;
/// The gap to the wall as it is drawn: narrower it would not be seen, and wider would leave no room \[px\].
const GAP_PX: [f64; 2] = [6.0, 55.0];
/// The same where the list does not say it \[px\].
const UNKNOWN_GAP_PX: f64 = 18.0;

/// The line of a dimension, with arrows at both ends.
fn dimension(ends: [f64; 4]) -> Markup {
    let arrows = Pen {
        from: TIP,
        to: TIP,
        ..pen(DIMENSION, 1.0)
    };
    line(ends, arrows)
}

fn circle([x, y]: [f64; 2], radius: f64, fill: &str) -> Markup {
    html! { circle cx=(px(x)) cy=(px(y)) r=(radius) fill=(fill) stroke=(INK) {} }
}

/// The drawing; `None` where the height or the thickness is not known.
pub(super) fn drawing(row: &PlanRow) -> Option<Markup> {
    let object = &row.object;
    let (height_m, thickness_m) = (object.height_m?, object.thickness_m?);
    let scale = (OBJECT_PX[0] / thickness_m).min(OBJECT_PX[1] / height_m);
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let (width, height) = (thickness_m * scale, height_m * scale);
    let (left, top) = (RIGHT_PX - width, FLOOR_PX - height);
    let units = object.units;
    let cg_m = object.cg_height_m.unwrap_or(0.5 * height_m);
    let middle = 0.5 * (left + RIGHT_PX);
    let content = html! {
        (arrow())
        (line([20.0, FLOOR_PX, 365.0, FLOOR_PX], pen(INK, 2.0)))
        rect x=(px(left)) y=(px(top)) width=(px(width)) height=(px(height))
            fill="#f2f2f2" stroke=(INK) stroke-width="1.5" {}
        (circle([middle, FLOOR_PX - cg_m * scale], 3.5, INK))
        (dimension([left - 14.0, top, left - 14.0, FLOOR_PX]))
        (text([left - 20.0, top + 0.5 * height + 4.0], "end", LABEL, units.length(height_m)))
        (dimension([left, FLOOR_PX + 30.0, RIGHT_PX, FLOOR_PX + 30.0]))
        (text([middle, FLOOR_PX + 45.0], "middle", LABEL, units.length(thickness_m)))
        @match row.kind {
            RestraintKind::BasePlate => (base(row, [left, scale], thickness_m)),
            RestraintKind::WheelLock => (locked(left)),
            RestraintKind::Strap | RestraintKind::Bracket | RestraintKind::Chain | RestraintKind::Tether => {
                (at_wall(row, [left, top, scale], height_m))
            }
            // No plan has them: their effect is not calculated.
            RestraintKind::Pad | RestraintKind::ShelfLip => {}
        }
    };
    let label = "The object from its side, with its restraint";
    Some(picture([WIDTH_PX, HEIGHT_PX], label, &content))
}

fn wheels(left: f64) -> Markup {
    html! {
        @for x in [left + 2.0, RIGHT_PX - 2.0] { (circle([x, FLOOR_PX - 4.0], 4.0, "#fff")) }
    }
}

/// Wheels between blocks.
fn locked(left: f64) -> Markup {
    html! {
        (wheels(left))
        @for x in [left + 2.0, RIGHT_PX - 2.0] {
            @for x in [x - 9.0, x + 9.0] { (line([x, FLOOR_PX, x, FLOOR_PX - 9.0], pen(BLUE, 4.0))) }
        }
        (text([RIGHT_PX + 22.0, FLOOR_PX - 6.0], "start", BLUE, "wheels locked"))
    }
}

/// Anchors at both edges of the base, at their distance from it.
fn base(row: &PlanRow, [left, scale]: [f64; 2], thickness_m: f64) -> Markup {
    let object = &row.object;
    let inset_m = inset_m(object.anchor_inset_m, thickness_m);
    let inset = inset_m * scale;
    let thick = pen(BLUE, 4.0);
    let (inside, below) = (RIGHT_PX - inset, FLOOR_PX + 16.0);
    let assumed = match object.anchor_inset_m {
        Some(_) => "",
        None => " (assumed)",
    };
    let said = format!(
        "anchors {} from the edge{assumed}",
        object.units.length(inset_m)
    );
    html! {
        @for (x, edge) in [(left + inset, left), (inside, RIGHT_PX)] {
            (line([x, FLOOR_PX - 12.0, x, FLOOR_PX + 14.0], thick))
            (line([x, FLOOR_PX - 3.0, edge, FLOOR_PX - 3.0], thick))
            (line([edge, FLOOR_PX - 3.0, edge, FLOOR_PX - 24.0], thick))
        }
        (line([inside, below, RIGHT_PX + 8.0, below], pen(DIMENSION, 1.0)))
        (text([RIGHT_PX + 12.0, FLOOR_PX + 20.0], "start", BLUE, said))
    }
}

/// What reaches from the object to the wall, with its height.
fn at_wall(row: &PlanRow, [left, top, scale]: [f64; 3], height_m: f64) -> Markup {
    let object = &row.object;
    let units = object.units;
    let gap = object.wall_gap_m.map_or(UNKNOWN_GAP_PX, |gap_m| {
        (gap_m * scale).clamp(GAP_PX[0], GAP_PX[1])
    });
    let wall = RIGHT_PX + gap;
    let said = match object.wall_gap_m {
        Some(gap_m) => format!("{} to the wall", units.length(gap_m)),
        None => "distance to the wall: unknown".to_owned(),
    };
    let at_m = row.fitting.height_ratio * height_m;
    let z = FLOOR_PX - at_m * scale;
    let (from, width) = match row.kind {
        RestraintKind::Chain => (left, 3.0),
        RestraintKind::Bracket => (RIGHT_PX - 14.0, 5.0),
        _ => (RIGHT_PX, 3.0),
    };
    // The lower of two chains is at half the height of the upper one.
    let lower = (row.kind == RestraintKind::Chain).then_some(FLOOR_PX - 0.5 * at_m * scale);
    let x = wall + 30.0;
    let anchors = row
        .fitting
        .anchors
        .map_or("anchors: number unknown".to_owned(), |count| {
            freestand_input::words::counted(count.into(), "anchor")
        });
    html! {
        (line([wall, top - 14.0, wall, FLOOR_PX], pen(INK, 2.0)))
        rect x=(px(wall)) y=(px(top - 14.0)) width="10" height=(px(FLOOR_PX - top + 14.0)) fill="#ddd" {}
        (text([RIGHT_PX + 8.0, FLOOR_PX + 18.0], "start", LABEL, said))
        @if row.kind == RestraintKind::Tether { (wheels(left)) }
        @for z in [Some(z), lower].into_iter().flatten() {
            (line([from, z, wall, z], pen(BLUE, width)))
            // The anchor, in the wall.
            (line([wall - 2.0, z - 7.0, wall - 2.0, z + 7.0], pen(BLUE, 4.0)))
            (line([wall, z, wall + 16.0, z], pen(BLUE, 3.0)))
        }
        (line([wall + 18.0, z, x + 4.0, z], pen(DIMENSION, 1.0)))
        (dimension([x, z, x, FLOOR_PX]))
        (text([x + 6.0, 0.5 * (z + FLOOR_PX) + 4.0], "start", BLUE, units.length(at_m)))
        (text([x + 8.0, z + 1.0], "start", BLUE, anchors))
    }
}
