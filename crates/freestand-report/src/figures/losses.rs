//! What all sites lose together, and where they are.

use freestand_output::figure::mark::MarkerShape;

use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, columns, draw};
use freestand_output::figure::style::{
    Axis, axes, curve_style, decades, line, markers, plain, plain_ticks,
};
use freestand_output::figure::{Figure, FigureError};
use freestand_risk::budget::{LossOfSite, SitesLosses, Together};

use super::risk::{scale, stairs};

/// Height of the panels \[px\].
const PANEL_PX: f64 = 300.0;
/// The dot of the site with the largest loss \[px\].
const LARGEST_PX: f64 = 16.0;
/// The smallest dot that is seen well \[px\].
const SMALLEST_PX: f64 = 3.0;
/// The least that the map shows \[degrees\]: about 20 km.
const LEAST_DEG: f64 = 0.2;
/// So many sites are named.
const MOST_NAMED: usize = 8;

/// Losses in one earthquake against return periods, by how the sites belong together, and a map of the sites.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn losses_figure(losses: &SitesLosses) -> Result<Figure, FigureError> {
    let mut legend = Vec::new();
    let mut panels = vec![curves(losses, &mut legend)];
    panels.extend(map(losses, &mut legend));
    let columns = columns(panels.len());
    draw(Page {
        name: "losses".to_owned(),
        title: "Losses of all sites".to_owned(),
        caption: format!(
            "Left: the loss of all sites in one earthquake that is reached once in so many years, from {} simulated years; a step \
             begins at a return period that was counted. The loss a year is the same for all lines. Right, where coordinates are known: the sites; the area of a dot is \
             proportional to the loss a year.",
            losses.simulated_years
        ),
        panels,
        columns,
        row_heights_px: vec![PANEL_PX],
        legend,
    })
}

fn curves(losses: &SitesLosses, legend: &mut Vec<Entry>) -> Panel {
    let largest = losses.rows.iter().map(|row| row.event.loss);
    let (factor, word) = scale(largest.clone().fold(0.0, f64::max));
    let years = losses.rows.iter().map(|row| row.return_period_years);
    let (from, to) = (
        years.clone().min().unwrap_or(1),
        years.max().unwrap_or(1).max(2),
    );
    let x = Axis {
        from: f64::from(from),
        to: f64::from(to),
        step: None,
        label: "Once in … years".to_owned(),
    };
    let currency = &losses.currency;
    let y = Axis::from_zero(
        factor * largest.fold(0.0, f64::max),
        &plain(&format!("Loss in one earthquake ({word}{currency})")),
    );
    let top = y.to;
    let mut layout = axes(x, y).with_title("Losses").with_log_x();
    layout.x_tick_format = decades();
    layout.y_tick_format = plain_ticks(top);
    let mut marks = Vec::new();
    for (i, dependence) in [
        Together::Common,
        Together::Correlated,
        Together::Independent,
    ]
    .into_iter()
    .enumerate()
    {
        let own = losses
            .rows
            .iter()
            .filter(|row| row.dependence == dependence);
        // Between two return periods nothing was counted: a loss is drawn from its own on, as in the figure of one site.
        let known = own.map(|row| (f64::from(row.return_period_years), factor * row.event.loss));
        let points = stairs(known, f64::from(to));
        if points.is_empty() {
            continue;
        }
        let style = curve_style(i);
        marks.push(line(&points, style.colour, 2.0, style.dash));
        legend.push(Entry {
            sign: Sign::Line {
                colour: style.colour,
                width_px: 2.0,
                dash: style.dash,
            },
            words: format!("{} earthquakes", dependence.name()),
        });
    }
    Panel { marks, layout }
}

/// `None`: no site has coordinates.
fn map(losses: &SitesLosses, legend: &mut Vec<Entry>) -> Option<Panel> {
    let mut placed: Vec<(&LossOfSite, (f64, f64))> = losses
        .sites
        .iter()
        .filter_map(|site| Some((site, (site.longitude_deg?, site.latitude_deg?))))
        .collect();
    placed.sort_by(|a, b| b.0.annual_loss.total_cmp(&a.0.annual_loss));
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let all = placed.iter().map(|(_, at)| of(at));
        let (least, most) = (
            all.clone().fold(f64::INFINITY, f64::min),
            all.fold(f64::NEG_INFINITY, f64::max),
        );
        let margin = (0.15 * (most - least)).max(0.5 * LEAST_DEG);
        (least - margin, most + margin)
    };
    let (largest, _) = placed.first()?;
    let most = largest.annual_loss;
    let (west, east) = ends(|at| at.0);
    let (south, north) = ends(|at| at.1);
    let x = Axis::between(west, east, "Longitude (degrees)");
    let y = Axis::between(south, north, "Latitude (degrees)");
    let mut layout = axes(x, y).with_title("Sites");
    layout.x_tick_format = plain_ticks(east - west);
    layout.y_tick_format = plain_ticks(north - south);
    let mut marks = Vec::new();
    for (i, (site, at)) in placed.iter().enumerate() {
        let share = if most > 0.0 {
            site.annual_loss / most
        } else {
            0.0
        };
        let size_px = (LARGEST_PX * share.sqrt()).max(SMALLEST_PX);
        // Beyond those that are named all have one colour.
        let colour = curve_style(3 + i.min(MOST_NAMED)).colour;
        marks.push(markers(&[*at], colour, MarkerShape::Circle, size_px));
        if i < MOST_NAMED {
            legend.push(Entry {
                sign: Sign::Dot { colour },
                words: site.site.clone(),
            });
        }
    }
    Some(Panel { marks, layout })
}
