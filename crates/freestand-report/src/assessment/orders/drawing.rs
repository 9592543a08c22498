//! The object from its side, with its restraint, the wall and the anchors, to scale.

use std::fmt::Write;

use freestand_assess::restraint::inset_m;
use freestand_inventory::library::RestraintKind;
use freestand_output::html::escape;
use freestand_risk::budget::PlanRow;

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

const INK: &str = "#1a1a1a";
const BLUE: &str = "#00558c";
const GREY: &str = "#666";

/// A picture as it is drawn.
struct Svg(String);

impl Svg {
    fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], colour: &str, width: f64, more: &str) {
        let _ = writeln!(
            self.0,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\" \
             stroke-width=\"{width}\" {more}/>"
        );
    }

    /// With arrows at both ends.
    fn dimension(&mut self, ends: [f64; 4]) {
        let arrows = "marker-start=\"url(#end)\" marker-end=\"url(#end)\"";
        self.line(ends, GREY, 1.0, arrows);
    }

    /// With a white edge, because texts cross lines.
    fn text(&mut self, [x, y]: [f64; 2], anchor: &str, colour: &str, words: &str) {
        let _ = writeln!(
            self.0,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\" stroke=\"#fff\" \
             stroke-width=\"4\" paint-order=\"stroke\">{}</text>",
            escape(words)
        );
    }

    fn circle(&mut self, [x, y]: [f64; 2], radius: f64, fill: &str) {
        let _ = writeln!(
            self.0,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{INK}\"/>"
        );
    }
}

/// The drawing; `None` where the height or the thickness is not known.
pub(super) fn drawing(row: &PlanRow) -> Option<String> {
    let object = &row.object;
    let (height_m, thickness_m) = (object.height_m?, object.thickness_m?);
    let scale = (OBJECT_PX[0] / thickness_m).min(OBJECT_PX[1] / height_m);
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let (width, height) = (thickness_m * scale, height_m * scale);
    let (left, top) = (RIGHT_PX - width, FLOOR_PX - height);
    let units = object.units;
    let mut svg = Svg(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH_PX} {HEIGHT_PX}\" role=\"img\" \
         aria-label=\"The object from its side, with its restraint\" font-family=\"Arial, sans-serif\" font-size=\"12\">\n\
         <defs><marker id=\"end\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"6\" markerHeight=\"6\" \
         orient=\"auto-start-reverse\"><path d=\"M0 0 L10 5 L0 10 z\" fill=\"context-stroke\"/></marker></defs>\n"
    ));
    svg.line([20.0, FLOOR_PX, 365.0, FLOOR_PX], INK, 2.0, "");
    let _ = writeln!(
        svg.0,
        "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#f2f2f2\" \
         stroke=\"{INK}\" stroke-width=\"1.5\"/>"
    );
    let cg_m = object.cg_height_m.unwrap_or(0.5 * height_m);
    let middle = 0.5 * (left + RIGHT_PX);
    svg.circle([middle, FLOOR_PX - cg_m * scale], 3.5, INK);
    svg.dimension([left - 14.0, top, left - 14.0, FLOOR_PX]);
    svg.text(
        [left - 20.0, top + 0.5 * height + 4.0],
        "end",
        "#444",
        &units.length(height_m),
    );
    svg.dimension([left, FLOOR_PX + 30.0, RIGHT_PX, FLOOR_PX + 30.0]);
    svg.text(
        [middle, FLOOR_PX + 45.0],
        "middle",
        "#444",
        &units.length(thickness_m),
    );
    match row.kind {
        RestraintKind::BasePlate => base(&mut svg, row, [left, scale], thickness_m),
        RestraintKind::WheelLock => {
            wheels(&mut svg, left);
            for x in [left + 2.0, RIGHT_PX - 2.0] {
                svg.line([x - 9.0, FLOOR_PX, x - 9.0, FLOOR_PX - 9.0], BLUE, 4.0, "");
                svg.line([x + 9.0, FLOOR_PX, x + 9.0, FLOOR_PX - 9.0], BLUE, 4.0, "");
            }
            svg.text(
                [RIGHT_PX + 22.0, FLOOR_PX - 6.0],
                "start",
                BLUE,
                "wheels locked",
            );
        }
        RestraintKind::Strap
        | RestraintKind::Bracket
        | RestraintKind::Chain
        | RestraintKind::Tether => at_wall(&mut svg, row, [left, top, scale], height_m),
        // No plan has them: their effect is not calculated.
        RestraintKind::Pad | RestraintKind::ShelfLip => {}
    }
    Some(svg.0 + "</svg>\n")
}

fn wheels(svg: &mut Svg, left: f64) {
    for x in [left + 2.0, RIGHT_PX - 2.0] {
        svg.circle([x, FLOOR_PX - 4.0], 4.0, "#fff");
    }
}

/// Anchors at both edges of the base, at their distance from it.
fn base(svg: &mut Svg, row: &PlanRow, [left, scale]: [f64; 2], thickness_m: f64) {
    let object = &row.object;
    let inset_m = inset_m(object.anchor_inset_m, thickness_m);
    let inset = inset_m * scale;
    for (x, edge) in [(left + inset, left), (RIGHT_PX - inset, RIGHT_PX)] {
        svg.line([x, FLOOR_PX - 12.0, x, FLOOR_PX + 14.0], BLUE, 4.0, "");
        svg.line([x, FLOOR_PX - 3.0, edge, FLOOR_PX - 3.0], BLUE, 4.0, "");
        svg.line([edge, FLOOR_PX - 3.0, edge, FLOOR_PX - 24.0], BLUE, 4.0, "");
    }
    let said = match object.anchor_inset_m {
        Some(_) => "from the edge",
        None => "from the edge (assumed)",
    };
    svg.line(
        [
            RIGHT_PX - inset,
            FLOOR_PX + 16.0,
            RIGHT_PX + 8.0,
            FLOOR_PX + 16.0,
        ],
        GREY,
        1.0,
        "",
    );
    svg.text(
        [RIGHT_PX + 12.0, FLOOR_PX + 20.0],
        "start",
        BLUE,
        &format!("anchors {} {said}", object.units.length(inset_m)),
    );
}

/// What reaches from the object to the wall, with its height.
fn at_wall(svg: &mut Svg, row: &PlanRow, [left, top, scale]: [f64; 3], height_m: f64) {
    let object = &row.object;
    let units = object.units;
    let gap = object.wall_gap_m.map_or(UNKNOWN_GAP_PX, |gap_m| {
        (gap_m * scale).clamp(GAP_PX[0], GAP_PX[1])
    });
    let wall = RIGHT_PX + gap;
    svg.line([wall, top - 14.0, wall, FLOOR_PX], INK, 2.0, "");
    let _ = writeln!(
        svg.0,
        "<rect x=\"{wall:.1}\" y=\"{:.1}\" width=\"10\" height=\"{:.1}\" fill=\"#ddd\"/>",
        top - 14.0,
        FLOOR_PX - top + 14.0
    );
    let said = match object.wall_gap_m {
        Some(gap_m) => format!("{} to the wall", units.length(gap_m)),
        None => "distance to the wall: unknown".to_owned(),
    };
    svg.text([RIGHT_PX + 8.0, FLOOR_PX + 18.0], "start", "#444", &said);
    let at_m = row.fitting.height_ratio * height_m;
    let mut heights = vec![at_m];
    match row.kind {
        // The lower of two chains is at half the height of the upper one.
        RestraintKind::Chain => heights.push(0.5 * at_m),
        RestraintKind::Tether => wheels(svg, left),
        _ => {}
    }
    for z_m in &heights {
        let z = FLOOR_PX - z_m * scale;
        let (from, width) = match row.kind {
            RestraintKind::Chain => (left, 3.0),
            RestraintKind::Bracket => (RIGHT_PX - 14.0, 5.0),
            _ => (RIGHT_PX, 3.0),
        };
        svg.line([from, z, wall, z], BLUE, width, "");
        // The anchor, in the wall.
        svg.line([wall - 2.0, z - 7.0, wall - 2.0, z + 7.0], BLUE, 4.0, "");
        svg.line([wall, z, wall + 16.0, z], BLUE, 3.0, "");
    }
    let z = FLOOR_PX - at_m * scale;
    let x = wall + 30.0;
    svg.line([wall + 18.0, z, x + 4.0, z], GREY, 1.0, "");
    svg.dimension([x, z, x, FLOOR_PX]);
    svg.text(
        [x + 6.0, 0.5 * (z + FLOOR_PX) + 4.0],
        "start",
        BLUE,
        &units.length(at_m),
    );
    let anchors = row
        .fitting
        .anchors
        .map_or("anchors: number unknown".to_owned(), |count| {
            freestand_input::words::counted(count.into(), "anchor")
        });
    svg.text([x + 8.0, z + 1.0], "start", BLUE, &anchors);
}
