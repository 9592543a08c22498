//! The object with its force, weight, anchors and bracket, as SVG.

use std::fmt::Write;

use freestand_output::html::escape;

use freestand_assess::restrain::Case;

/// Size of the picture \[px\].
const WIDTH_PX: f64 = 380.0;
const HEIGHT_PX: f64 = 330.0;
/// The floor \[px\].
const FLOOR_PX: f64 = 270.0;
/// The largest sizes of the object \[px\].
const OBJECT_PX: [f64; 2] = [130.0, 225.0];
/// The middle of the object \[px\].
const MIDDLE_PX: f64 = 170.0;

/// The sketch: the side in which the object tips first.
pub(super) fn sketch(case: &Case) -> String {
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
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH_PX} {HEIGHT_PX}\" role=\"img\" \
         aria-label=\"The object with its forces\" font-family=\"Arial, sans-serif\" font-size=\"12\">\n\
         <defs><marker id=\"tip\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"7\" markerHeight=\"7\" \
         orient=\"auto-start-reverse\"><path d=\"M0 0 L10 5 L0 10 z\" fill=\"context-stroke\"/></marker></defs>\n"
    );
    let mut line = |[x1, y1, x2, y2]: [f64; 4], style: &str| {
        let _ = writeln!(
            svg,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style}/>"
        );
    };
    let thin = "stroke=\"#666\" stroke-width=\"1\"";
    let both =
        "stroke=\"#666\" stroke-width=\"1\" marker-start=\"url(#tip)\" marker-end=\"url(#tip)\"";
    let arrow = "stroke=\"#b00020\" stroke-width=\"2.5\" marker-end=\"url(#tip)\"";
    line(
        [40.0, FLOOR_PX, 340.0, FLOOR_PX],
        "stroke=\"#1a1a1a\" stroke-width=\"2\"",
    );
    // The wall that a bracket is fixed to.
    line(
        [320.0, top.min(bracket) - 12.0, 320.0, FLOOR_PX],
        "stroke=\"#999\" stroke-width=\"2\"",
    );
    line(
        [right, bracket, 320.0, bracket],
        "stroke=\"#00558c\" stroke-width=\"2\" stroke-dasharray=\"6 4\"",
    );
    let _ = writeln!(
        svg,
        "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#f2f2f2\" \
         stroke=\"#1a1a1a\" stroke-width=\"1.5\"/>\n<circle cx=\"{MIDDLE_PX}\" cy=\"{cg:.1}\" r=\"4\"/>"
    );
    let mut line = |[x1, y1, x2, y2]: [f64; 4], style: &str| {
        let _ = writeln!(
            svg,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style}/>"
        );
    };
    // F from the left to the centre of gravity; the weight; the anchors of the edge that lifts.
    line([left - 70.0, cg, left - 4.0, cg], arrow);
    line(
        [MIDDLE_PX, cg, MIDDLE_PX, (cg + 42.0).min(FLOOR_PX - 4.0)],
        "stroke=\"#1a1a1a\" stroke-width=\"1.5\" marker-end=\"url(#tip)\"",
    );
    let inset = case.own.inset_m() * scale;
    for x in [left + inset, right - inset] {
        line(
            [x, FLOOR_PX - 10.0, x, FLOOR_PX + 14.0],
            "stroke=\"#00558c\" stroke-width=\"4\"",
        );
    }
    if force.anchor_tension_n > 0.0 {
        line(
            [left + inset, FLOOR_PX + 14.0, left + inset, FLOOR_PX + 40.0],
            "stroke=\"#00558c\" stroke-width=\"2.5\" marker-end=\"url(#tip)\"",
        );
    }
    // Dimensions: the height and that of the centre of gravity on the right, the side below.
    line([right + 24.0, top, right + 24.0, FLOOR_PX], both);
    line([right + 4.0, cg, right + 44.0, cg], thin);
    line([right + 38.0, cg, right + 38.0, FLOOR_PX], both);
    line([left, FLOOR_PX + 52.0, right, FLOOR_PX + 52.0], both);
    // With a white edge, because texts cross the lines of dimensions.
    let edge = "stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\"";
    let mut text = |[x, y]: [f64; 2], anchor: &str, colour: &str, words: &str| {
        let words = escape(words);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\" {edge}>{words}</text>"
        );
    };
    text(
        [left - 10.0, cg - 12.0],
        "end",
        "#b00020",
        &format!("F = {}", units.force(force.force_n)),
    );
    text([MIDDLE_PX + 7.0, cg + 26.0], "start", "#1a1a1a", "W");
    text(
        [right + 20.0, top - 5.0],
        "middle",
        "#444",
        &length(object.height_m),
    );
    text(
        [right + 44.0, (cg + FLOOR_PX) / 2.0],
        "start",
        "#444",
        &length(object.cg_height_m),
    );
    text(
        [MIDDLE_PX, FLOOR_PX + 47.0],
        "middle",
        "#444",
        &length(side_m),
    );
    if force.anchor_tension_n > 0.0 {
        let words = format!("T = {}", units.force(force.anchor_tension_n));
        text([left - 2.0, FLOOR_PX + 34.0], "end", "#00558c", &words);
    }
    text(
        [316.0, bracket - 6.0],
        "end",
        "#00558c",
        &format!("or P = {}", units.force(force.bracket_force_n)),
    );
    svg + "</svg>\n"
}
