//! Small drawings as inline SVG: bars of counts, an object from its sides, the tornado.

use std::fmt::Write;

use crate::assess::overview::Counts;
use crate::assess::result::{Decision, Swing};
use crate::assess::words::{colours, ranked, sign};
use crate::inventory::Item;
use crate::result::Ranked;
use crate::words::{escape, number};

/// Width and height of a bar of counts \[px\].
const BAR_PX: (f64, f64) = (180.0, 15.0);

/// Counts by decision side by side; each part has the sign of its decision where there is room for it.
pub(super) fn stacked_bar(counts: &Counts, largest: usize) -> String {
    let (width, height) = BAR_PX;
    let mut svg =
        format!("<svg viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" aria-hidden=\"true\">");
    let mut x = 0.0;
    for decision in Decision::ALL {
        let part = width * counts.of(decision) as f64 / largest.max(1) as f64;
        if part <= 0.0 {
            continue;
        }
        let (fill, ink) = (hex(colours(decision).fill), hex(colours(decision).ink));
        let _ = write!(
            svg,
            "<rect x=\"{x:.1}\" y=\"0.5\" width=\"{part:.1}\" height=\"{:.1}\" fill=\"{fill}\" stroke=\"{ink}\"/>",
            height - 1.0
        );
        if part > 14.0 {
            let _ = write!(
                svg,
                "<text x=\"{:.1}\" y=\"11.5\" font-size=\"10\" text-anchor=\"middle\" fill=\"{ink}\">{}</text>",
                x + 0.5 * part,
                sign(decision)
            );
        }
        x += part;
    }
    svg.push_str("</svg>");
    svg
}

fn hex(colour: u32) -> String {
    format!("#{colour:06x}")
}

/// Height of an object's drawing without its texts \[px\].
const SKETCH_PX: f64 = 150.0;

/// Widest an object is drawn \[px\]; lower objects are drawn smaller.
const SKETCH_WIDTH_PX: f64 = 190.0;

/// The object from the sides that it may rock over, to one scale; nothing without its geometry.
pub(super) fn sketch(item: &Item) -> String {
    let (Some(height_m), Some(thickness_m)) = (item.height_m, item.thickness_m) else { return String::new() };
    let widest_m = item.width_m.unwrap_or(thickness_m).max(thickness_m);
    if !(height_m > 0.0 && widest_m > 0.0 && height_m.is_finite() && widest_m.is_finite()) {
        return String::new();
    }
    let scale = (SKETCH_PX / height_m).min(SKETCH_WIDTH_PX / widest_m);
    let cg_m = item.cg_height_m.unwrap_or(0.5 * height_m);
    let mut sides = vec![("thickness", thickness_m, item.base_thickness_m)];
    sides.extend(item.width_m.map(|width_m| ("width", width_m, item.base_width_m)));
    let mut svg = String::from("<div class=\"sketch\">");
    for (side, side_m, base_m) in sides {
        svg.push_str(&view(side, [height_m, side_m, base_m.unwrap_or(side_m), cg_m], scale));
    }
    svg.push_str("</div>\n");
    svg
}

/// One side: the block on its two edges, its centre of gravity, its measures.
fn view(side: &str, [height_m, side_m, base_m, cg_m]: [f64; 4], scale: f64) -> String {
    let [h, w, b, z] = [height_m, side_m, base_m, cg_m].map(|length_m| length_m * scale);
    // Room on the left for the height, below for the width.
    let (left, top) = (62.0, 10.0);
    let (width, height) = (left + w.max(60.0) + 24.0, top + h + 44.0);
    let (middle, floor) = (left + 0.5 * w.max(60.0), top + h);
    let x = middle - 0.5 * w;
    let mm = |length_m: f64| format!("{} mm", number(1e3 * length_m, 4));
    let title = format!(
        "Seen along the floor with its {side} in the picture: {} high, {} wide, edges {} apart, centre of gravity {} up",
        mm(height_m),
        mm(side_m),
        mm(base_m),
        mm(cg_m)
    );
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" role=\"img\"><title>{title}</title>\
         <line x1=\"{:.1}\" y1=\"{floor:.1}\" x2=\"{:.1}\" y2=\"{floor:.1}\" stroke=\"#444\" stroke-width=\"1.5\"/>\
         <rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"#f3f5f7\" stroke=\"#222\"/>",
        left - 8.0,
        width - 10.0,
    );
    for edge in [middle - 0.5 * b, middle + 0.5 * b] {
        let _ = write!(
            svg,
            "<path d=\"M{edge:.1} {floor:.1} l-4 7 h8 z\" fill=\"#222\"/>\
             <line x1=\"{edge:.1}\" y1=\"{floor:.1}\" x2=\"{middle:.1}\" y2=\"{:.1}\" stroke=\"#777\" stroke-dasharray=\"3 3\"/>",
            floor - z
        );
    }
    let _ = write!(
        svg,
        "<circle cx=\"{middle:.1}\" cy=\"{:.1}\" r=\"4.5\" fill=\"#fff\" stroke=\"#222\"/><circle cx=\"{middle:.1}\" cy=\"{:.1}\" \
         r=\"1.6\" fill=\"#222\"/>",
        floor - z,
        floor - z
    );
    let _ = write!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text><text x=\"{middle:.1}\" y=\"{:.1}\" \
         text-anchor=\"middle\">{side} {}</text>",
        x.min(left) - 6.0,
        top + 0.5 * h + 4.0,
        mm(height_m),
        floor + 21.0,
        mm(side_m)
    );
    if (b - w).abs() > 0.5 {
        let _ = write!(
            svg,
            "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">edges {}</text>",
            floor + 36.0,
            mm(base_m)
        );
    }
    svg.push_str("</svg>");
    svg
}

/// Height of a bar of the tornado with its gap \[px\].
const SWING_PX: f64 = 34.0;

/// What would change it: a bar from the low to the high end of each value, around the result as it is.
///
/// Overturned stands at the right border, beyond every number.
pub(super) fn tornado(swings: &[Swing], measure: &str) -> String {
    let numbers = swings.iter().flat_map(|swing| [swing.at_low, swing.at_high, swing.as_is]);
    let largest = numbers.filter_map(Ranked::value).filter(|value| value.is_finite()).fold(0.0, f64::max);
    if swings.is_empty() {
        return String::new();
    }
    let (left, right, beyond) = (150.0, 560.0, 640.0);
    let limit = if measure == "g" { None } else { Some(1.0) };
    let full = 1.08 * largest.max(limit.unwrap_or(0.0)).max(1e-9);
    let place = |value: Ranked| match value {
        Ranked::Value(value) if value.is_finite() => Some(left + (right - left) * (value / full).clamp(0.0, 1.0)),
        Ranked::Overturned => Some(beyond),
        _ => None,
    };
    let height = 30.0 + SWING_PX * swings.len() as f64;
    let mut svg =
        format!("<svg class=\"tornado\" viewBox=\"0 0 700 {height}\" role=\"img\"><title>What would change it</title>");
    if let Some(x) = limit.and_then(|limit| place(Ranked::Value(limit))) {
        let _ = write!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"14\" x2=\"{x:.1}\" y2=\"{height}\" stroke=\"#222\" stroke-dasharray=\"5 3\"/><text \
             x=\"{x:.1}\" y=\"10\" text-anchor=\"middle\">capacity, 1</text>"
        );
    }
    for (i, swing) in swings.iter().enumerate() {
        let y = 20.0 + SWING_PX * i as f64;
        let mark = if swing.flips { " ✱" } else { "" };
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" font-weight=\"600\">{}{mark}</text>",
            left - 10.0,
            y + 15.0,
            escape(&swing.parameter)
        );
        let (Some(low), Some(high)) = (place(swing.at_low), place(swing.at_high)) else { continue };
        let (from, to) = (low.min(high), low.max(high));
        let fill = if swing.flips { "#e8b48d" } else { "#c9d6e2" };
        let _ = write!(
            svg,
            "<rect x=\"{from:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"18\" fill=\"{fill}\" stroke=\"#333\"/>",
            (to - from).max(1.0)
        );
        if let Some(x) = place(swing.as_is) {
            let _ = write!(
                svg,
                "<line x1=\"{x:.1}\" y1=\"{:.1}\" x2=\"{x:.1}\" y2=\"{:.1}\" stroke=\"#000\" stroke-width=\"2\"/>",
                y - 2.0,
                y + 20.0
            );
        }
        let (at_left, at_right) =
            if low <= high { (swing.at_low, swing.at_high) } else { (swing.at_high, swing.at_low) };
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text><text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            from - 4.0,
            y + 14.0,
            ranked(at_left, measure),
            to + 4.0,
            y + 14.0,
            if at_right == Ranked::Overturned { "falls".to_owned() } else { ranked(at_right, measure) }
        );
    }
    svg.push_str("</svg>\n");
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of 2 m × 0.5 m at 75 px a metre.
    #[test]
    fn an_object_is_drawn_to_scale() {
        let mut item = crate::assess::fixture::item(0);
        (item.height_m, item.thickness_m, item.width_m) = (Some(2.0), Some(0.5), None);
        (item.base_thickness_m, item.cg_height_m) = (None, None);
        let svg = sketch(&item);
        assert!(svg.contains("width=\"37.5\" height=\"150.0\""), "{svg}");
        assert!(svg.contains("thickness 500 mm") && !svg.contains("edges 500 mm<"), "{svg}");
        item.height_m = None;
        assert_eq!(sketch(&item), "");
        (item.height_m, item.thickness_m) = (Some(1e300), Some(f64::MIN_POSITIVE));
        assert!(!sketch(&item).contains("NaN") && !sketch(&item).contains("inf"));
    }

    /// 3 of 10 and 7 of 10 fill the bar of 180 px.
    #[test]
    fn a_bar_has_the_lengths_of_its_counts() {
        let counts = Counts { objects: [3, 0, 0, 7], pieces: [0; 4] };
        let svg = stacked_bar(&counts, 10);
        assert!(
            svg.contains("x=\"0.0\" y=\"0.5\" width=\"54.0\"") && svg.contains("x=\"54.0\" y=\"0.5\" width=\"126.0\"")
        );
        assert_eq!(stacked_bar(&Counts::default(), 0).matches("<rect").count(), 0);
    }

    #[test]
    fn overturned_lies_beyond_every_number() {
        let swing = Swing {
            parameter: "<motion>".into(),
            low: String::new(),
            high: String::new(),
            at_low: Ranked::Value(0.5),
            at_high: Ranked::Overturned,
            as_is: Ranked::Value(1.0),
            flips: true,
        };
        let svg = tornado(&[swing], "");
        // Full scale is 1.08: 0.5 stands at 150 + 410 · 0.5/1.08 = 339.8.
        assert!(svg.contains("<rect x=\"339.8\" y=\"20.0\" width=\"300.2\""), "{svg}");
        assert!(svg.contains("falls") && svg.contains("&lt;motion&gt;"));
        assert_eq!(tornado(&[], ""), "");
    }
}
