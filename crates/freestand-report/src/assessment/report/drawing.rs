//! Small drawings as inline SVG: bars of counts, the sides of an object.

use std::fmt::Write;

use crate::assessment::overview::Counts;
use crate::assessment::words::{colours, sign};
use freestand_assess::result::Decision;
use freestand_input::words::number;
use freestand_inventory::Item;

/// Width and height of a bar of counts \[px\].
const BAR_PX: (f64, f64) = (180.0, 15.0);

/// Counts by decision, side by side; each part shows the sign of its decision where there is room.
pub(super) fn stacked_bar(counts: &Counts, largest: usize) -> String {
    let (width, height) = BAR_PX;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" aria-hidden=\"true\">"
    );
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

/// Largest height of the drawing of an object without its texts \[px\].
const SKETCH_PX: f64 = 110.0;

/// Largest width of both sides together \[px\]; low objects are drawn smaller.
const SKETCH_WIDTH_PX: f64 = 190.0;

/// Smallest width of a side, which its dimensions need \[px\].
const SIDE_PX: f64 = 112.0;

/// Margin on the left, for the height \[px\].
const LEFT_PX: f64 = 60.0;

/// Margin above \[px\].
const TOP_PX: f64 = 8.0;

/// The sides of the object in its planes of rocking, to one scale; empty without its geometry.
pub(super) fn sketch(item: &Item) -> String {
    let (Some(height_m), Some(thickness_m)) = (item.height_m, item.thickness_m) else {
        return String::new();
    };
    let mut sides = vec![(
        "thickness",
        thickness_m,
        item.base_thickness_m.unwrap_or(thickness_m),
    )];
    sides.extend(
        item.width_m
            .map(|width_m| ("width", width_m, item.base_width_m.unwrap_or(width_m))),
    );
    let total_m: f64 = sides.iter().map(|(_, side_m, _)| side_m).sum();
    let scale = (SKETCH_PX / height_m).min(SKETCH_WIDTH_PX / total_m);
    if !(scale > 0.0 && scale.is_finite()) {
        return String::new();
    }
    let (h, cg_m) = (height_m * scale, item.cg_height_m.unwrap_or(0.5 * height_m));
    let rooms: Vec<f64> = sides
        .iter()
        .map(|(_, side_m, _)| (side_m * scale + 16.0).max(SIDE_PX))
        .collect();
    let (width, height) = (LEFT_PX + rooms.iter().sum::<f64>(), TOP_PX + h + 42.0);
    let mut title = format!("Height {}, centre of gravity at {}", mm(height_m), mm(cg_m));
    for (side, side_m, base_m) in &sides {
        let _ = write!(
            title,
            "; {side} {}, edges {} apart",
            mm(*side_m),
            mm(*base_m)
        );
    }
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" \
         role=\"img\"><title>{title}</title>\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
        LEFT_PX - 4.0,
        TOP_PX + 0.5 * h + 4.0,
        mm(height_m)
    );
    let mut left = LEFT_PX;
    for ((side, side_m, base_m), room) in sides.iter().zip(&rooms) {
        svg.push_str(&view(
            side,
            [h, side_m * scale, base_m * scale, cg_m * scale],
            left + 0.5 * room,
        ));
        let measure = |text: &str, y: f64| {
            format!(
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                left + 0.5 * room,
                TOP_PX + h + y
            )
        };
        svg.push_str(&measure(&format!("{side} {}", mm(*side_m)), 22.0));
        if base_m != side_m {
            svg.push_str(&measure(&format!("edges {}", mm(*base_m)), 37.0));
        }
        left += room;
    }
    svg.push_str("</svg>");
    format!("<div class=\"sketch\">{svg}</div>\n")
}

fn mm(length_m: f64) -> String {
    format!("{} mm", number(1e3 * length_m, 4))
}

/// One side: the block on its two edges, and its centre of gravity; lengths in px.
fn view(side: &str, [h, w, b, z]: [f64; 4], middle: f64) -> String {
    let floor = TOP_PX + h;
    let reach = 0.5 * w + 12.0;
    let mut svg = format!(
        "<g class=\"{side}\"><line x1=\"{:.1}\" y1=\"{floor:.1}\" x2=\"{:.1}\" y2=\"{floor:.1}\" stroke=\"#444\" \
         stroke-width=\"1.5\"/><rect x=\"{:.1}\" y=\"{TOP_PX:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"#f3f5f7\" \
         stroke=\"#222\"/>",
        middle - reach,
        middle + reach,
        middle - 0.5 * w,
    );
    for edge in [middle - 0.5 * b, middle + 0.5 * b] {
        let _ = write!(
            svg,
            "<path d=\"M{edge:.1} {floor:.1} l-4 7 h8 z\" fill=\"#222\"/>\
             <line x1=\"{edge:.1}\" y1=\"{floor:.1}\" x2=\"{middle:.1}\" y2=\"{:.1}\" stroke=\"#777\" \
             stroke-dasharray=\"3 3\"/>",
            floor - z
        );
    }
    let cg = floor - z;
    let _ = write!(
        svg,
        "<circle cx=\"{middle:.1}\" cy=\"{cg:.1}\" r=\"4.5\" fill=\"#fff\" stroke=\"#222\"/><circle cx=\"{middle:.1}\" \
         cy=\"{cg:.1}\" r=\"1.6\" fill=\"#222\"/></g>"
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of 2 m × 0.5 m at 55 px a metre.
    #[test]
    fn an_object_is_drawn_to_scale() {
        let mut item = crate::assessment::fixture::item(0);
        (item.height_m, item.thickness_m, item.width_m) = (Some(2.0), Some(0.5), None);
        (item.base_thickness_m, item.cg_height_m) = (None, None);
        let svg = sketch(&item);
        assert!(svg.contains("width=\"27.5\" height=\"110.0\""), "{svg}");
        assert!(
            svg.contains("thickness 500 mm") && !svg.contains("edges 500 mm<"),
            "{svg}"
        );
        item.height_m = None;
        assert_eq!(sketch(&item), "");
        (item.height_m, item.thickness_m) = (Some(1e300), Some(f64::MIN_POSITIVE));
        assert!(!sketch(&item).contains("NaN") && !sketch(&item).contains("inf"));
    }

    /// 3 of 10 and 7 of 10 fill the bar of 180 px.
    #[test]
    fn a_bar_has_the_lengths_of_its_counts() {
        let counts = Counts {
            objects: [3, 0, 0, 0, 7],
            pieces: [0; 5],
        };
        let svg = stacked_bar(&counts, 10);
        assert!(
            svg.contains("x=\"0.0\" y=\"0.5\" width=\"54.0\"")
                && svg.contains("x=\"54.0\" y=\"0.5\" width=\"126.0\"")
        );
        assert_eq!(
            stacked_bar(&Counts::default(), 0).matches("<rect").count(),
            0
        );
    }
}
