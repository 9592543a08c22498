//! Small drawings as inline SVG: bars of counts, the sides of an object.

use crate::assessment::overview::Counts;
use crate::assessment::words::{colours, sign};
use freestand_assess::result::Decision;
use freestand_input::words::number;
use freestand_inventory::Item;
use maud::{Markup, html};

use crate::svg::px;

/// Width and height of a bar of counts \[px\].
const BAR_PX: (f64, f64) = (180.0, 15.0);

/// Counts by decision, side by side; each part shows the sign of its decision where there is room.
pub(super) fn stacked_bar(counts: &Counts, largest: usize) -> Markup {
    let (width, height) = BAR_PX;
    let mut left = 0.0;
    let parts = Decision::ALL.map(|decision| {
        let part = width * counts.of(decision) as f64 / largest.max(1) as f64;
        let x = left;
        left += part;
        (decision, x, part)
    });
    html! {
        svg viewBox={ "0 0 " (width) " " (height) } width=(width) height=(height) aria-hidden="true" {
            @for (decision, x, part) in parts.into_iter().filter(|(.., part)| *part > 0.0) {
                @let (fill, ink) = (hex(colours(decision).fill), hex(colours(decision).ink));
                rect x=(px(x)) y="0.5" width=(px(part)) height=(px(height - 1.0)) fill=(fill) stroke=(ink) {}
                @if part > 14.0 {
                    text x=(px(x + 0.5 * part)) y="11.5" font-size="10" text-anchor="middle" fill=(ink) {
                        (sign(decision))
                    }
                }
            }
        }
    }
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
pub(super) fn sketch(item: &Item) -> Markup {
    let (Some(height_m), Some(thickness_m)) = (item.height_m, item.thickness_m) else {
        return Markup::default();
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
        return Markup::default();
    }
    let (h, cg_m) = (height_m * scale, item.cg_height_m.unwrap_or(0.5 * height_m));
    let rooms: Vec<f64> = sides
        .iter()
        .map(|(_, side_m, _)| (side_m * scale + 16.0).max(SIDE_PX))
        .collect();
    let (width, height) = (LEFT_PX + rooms.iter().sum::<f64>(), TOP_PX + h + 42.0);
    let mut left = LEFT_PX;
    let middles = rooms.iter().map(|room| {
        let middle = left + 0.5 * room;
        left += room;
        middle
    });
    html! {
        div.sketch {
            svg viewBox=(format!("0 0 {width:.0} {height:.0}")) width=(format!("{width:.0}"))
                height=(format!("{height:.0}")) role="img" {
                title {
                    "Height " (mm(height_m)) ", centre of gravity at " (mm(cg_m))
                    @for (side, side_m, base_m) in &sides {
                        "; " (side) " " (mm(*side_m)) ", edges " (mm(*base_m)) " apart"
                    }
                }
                text x=(px(LEFT_PX - 4.0)) y=(px(TOP_PX + 0.5 * h + 4.0)) text-anchor="end" { (mm(height_m)) }
                @for ((side, side_m, base_m), middle) in sides.iter().zip(middles) {
                    (view(side, [h, side_m * scale, base_m * scale, cg_m * scale], middle))
                    (measure(&format!("{side} {}", mm(*side_m)), middle, TOP_PX + h + 22.0))
                    @if base_m != side_m {
                        (measure(&format!("edges {}", mm(*base_m)), middle, TOP_PX + h + 37.0))
                    }
                }
            }
        }
    }
}

fn measure(words: &str, x: f64, y: f64) -> Markup {
    html! { text x=(px(x)) y=(px(y)) text-anchor="middle" { (words) } }
}

fn mm(length_m: f64) -> String {
    format!("{} mm", number(1e3 * length_m, 4))
}

/// One side: the block on its two edges, and its centre of gravity; lengths in px.
fn view(side: &str, [h, w, b, z]: [f64; 4], middle: f64) -> Markup {
    let (floor, cg) = (TOP_PX + h, px(TOP_PX + h - z));
    let reach = 0.5 * w + 12.0;
    let (y, x) = (px(floor), px(middle));
    html! {
        g.(side) {
            line x1=(px(middle - reach)) y1=(y) x2=(px(middle + reach)) y2=(y) stroke="#444" stroke-width="1.5" {}
            rect x=(px(middle - 0.5 * w)) y=(px(TOP_PX)) width=(px(w)) height=(px(h)) fill="#f3f5f7" stroke="#222" {}
            @for edge in [middle - 0.5 * b, middle + 0.5 * b].map(px) {
                path d={ "M" (edge) " " (y) " l-4 7 h8 z" } fill="#222" {}
                line x1=(edge) y1=(y) x2=(x) y2=(cg) stroke="#777" stroke-dasharray="3 3" {}
            }
            circle cx=(x) cy=(cg) r="4.5" fill="#fff" stroke="#222" {}
            circle cx=(x) cy=(cg) r="1.6" fill="#222" {}
        }
    }
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
        let svg = sketch(&item).0;
        assert!(svg.contains("width=\"27.5\" height=\"110.0\""), "{svg}");
        assert!(
            svg.contains("thickness 500 mm") && !svg.contains("edges 500 mm<"),
            "{svg}"
        );
        item.height_m = None;
        assert_eq!(sketch(&item).0, "");
        (item.height_m, item.thickness_m) = (Some(1e300), Some(f64::MIN_POSITIVE));
        let svg = sketch(&item).0;
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }

    /// 3 of 10 and 7 of 10 fill the bar of 180 px.
    #[test]
    fn a_bar_has_the_lengths_of_its_counts() {
        let counts = Counts {
            objects: [3, 0, 0, 0, 7],
            pieces: [0; 5],
        };
        let svg = stacked_bar(&counts, 10).0;
        assert!(
            svg.contains("x=\"0.0\" y=\"0.5\" width=\"54.0\"")
                && svg.contains("x=\"54.0\" y=\"0.5\" width=\"126.0\"")
        );
        assert_eq!(
            stacked_bar(&Counts::default(), 0)
                .0
                .matches("<rect")
                .count(),
            0
        );
    }
}
