//! Figures, and a table of every object for each level.

use crate::figures::MAX_RECORDS;
use freestand_input::words::{fixed, number, percent};
use freestand_output::figure::Figure;
use freestand_output::html::{Cell, classed_table, drawing, figure, words};
use freestand_study::result::{LevelResult, ObjectStatistics, Ranked, StudyResult};
use freestand_study::study::{Ground, Study};
use maud::{Markup, html};

/// Largest number of thicknesses that fit side by side on A4.
const MAX_COLUMNS: usize = 5;

/// Figures first, then the numbers.
pub(super) fn results(study: &Study, result: &StudyResult, figures: &[Figure]) -> Markup {
    let mut thicknesses = study.objects.thicknesses_m.clone();
    thicknesses.sort_by(f64::total_cmp);
    html! {
        @for (i, figure) in figures.iter().enumerate() {
            figure id={ "figure-" (figure.name) } {
                (drawing(figure))
                figcaption { strong { "Figure " (i + 1) ". " (figure.title) "." } " " (figure.caption) }
            }
        }
        @if let Ground::Recorded(records) = &study.ground && records.len() > MAX_RECORDS {
            p {
                "Figures show the first " (MAX_RECORDS) " of the " (records.len())
                " recorded ground motions; the command motion info can plot the others."
            }
        }
        p { (how_to_read(study)) }
        @for level in &result.levels {
            h3 { "Median shock at the level " (level.level.name) }
            @for some in thicknesses.chunks(MAX_COLUMNS) { (level_table(study, level, some)) }
        }
    }
}

fn how_to_read(study: &Study) -> String {
    let mut text = String::from(
        "How to read the tables. Each cell is the median over all motions: an object that does not uplift counts as \
         0, an overturned one as larger than any number; nothing is extrapolated and no motion is left out. “–”: \
         half or more of the motions do not uplift the object. “overturned”: half or more of the motions overturn \
         it. The two sources of the energy at impact are side by side, in g: “uplift”, the largest rise of the \
         centre of gravity (as in the paper), and “velocity”, the largest angular velocity just before an impact. \
         The larger, in bold, governs. “ov.”: share of the motions that overturn the object.",
    );
    if let Some(tolerance) = study.objects.tolerance_m_s2 {
        text.push_str(&format!(
            " ▲: above the tolerance of {} g, or overturned.",
            number(tolerance / freestand::G0_M_S2, 3)
        ));
    }
    text
}

fn level_table(study: &Study, level: &LevelResult, thicknesses: &[f64]) -> Markup {
    let mut top = vec![words("")];
    let mut below = vec![figure("h (m)")];
    for &t in thicknesses {
        let thickness = format!("t = {} mm", number(1e3 * t, 4));
        top.push(words(thickness).class("group").over(3));
        below.push(words("uplift").class("n first"));
        below.push(figure("velocity"));
        below.push(figure("ov."));
    }
    let mut heights = study.objects.heights_m.clone();
    heights.sort_by(f64::total_cmp);
    let decimals = heights
        .iter()
        .map(|&h| decimals(&number(h, 5)))
        .max()
        .unwrap_or(0);
    let tolerance_g = study.objects.tolerance_m_s2.map(|a| a / freestand::G0_M_S2);
    let row = |&h: &f64| {
        let mut row = vec![figure(fixed(h, decimals))];
        for &t in thicknesses {
            let object = level
                .statistics
                .iter()
                .flatten()
                .find(|s| s.height_m == h && s.thickness_m == t);
            row.extend(object_cells(object, tolerance_g));
        }
        row
    };
    let headings: [&[Cell]; 2] = [&top, &below];
    classed_table("objects", "", &headings, heights.iter().map(row))
}

/// Number of decimals.
fn decimals(number: &str) -> usize {
    number.split_once('.').map_or(0, |(_, digits)| digits.len())
}

/// Both sources and the overturned share of one object.
fn object_cells(object: Option<&ObjectStatistics>, tolerance_g: Option<f64>) -> Vec<Cell> {
    let failed = || vec![words("failed").class("over").over(3)];
    let Some(s) = object else {
        return failed();
    };
    let sign = if tolerance_g.is_some_and(|tolerance| s.exceeds(tolerance)) {
        " ▲"
    } else {
        ""
    };
    let share = if s.overturned_share > 0.0 {
        percent(s.overturned_share, 0)
    } else {
        String::new()
    };
    let share = words(share).class("n share");
    match (
        s.edge_acceleration_g[1],
        s.edge_acceleration_impact_velocity_g[1],
    ) {
        (Ranked::Value(uplift), Ranked::Value(velocity)) => {
            let larger = uplift.max(velocity);
            let cell = |value: f64| {
                figure(html! {
                    @if value == larger && value > 0.0 {
                        strong { (shock(value)) } (sign)
                    } @else {
                        (shock(value))
                    }
                })
            };
            vec![cell(uplift).class("n first"), cell(velocity), share]
        }
        (Ranked::NoData, _) | (_, Ranked::NoData) => failed(),
        _ => {
            let overturned = words(format!("overturned{sign}"));
            vec![overturned.class("over").over(2), share]
        }
    }
}

fn shock(value_g: f64) -> String {
    match value_g {
        0.0 => "–".to_owned(),
        v if v < 0.005 => "<0.01".to_owned(),
        v => fixed(v, 2),
    }
}
