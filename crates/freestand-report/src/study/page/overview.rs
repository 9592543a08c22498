//! The top of the report: title, summary, first table and warnings.

use crate::doubts::study_doubts;
use crate::ground::{earthquake, simulated_earthquakes};
use freestand_input::file::file_name;
use freestand_input::keys::KeyStyle;
use freestand_input::words::{counted, fixed, number, percent};
use freestand_output::html::{Cell, classed_table, figure, list, table, words};
use freestand_study::cushion::cushion_words;
use freestand_study::result::{ObjectResponse, StudyResult};
use freestand_study::study::{Ground, Study};
use freestand_study::summary::{LevelSummary, level_summaries};
use maud::{Markup, html};

use super::or_dash;
use freestand_study::provenance::Provenance;

/// Title of the report.
pub(super) fn title(study: &Study) -> String {
    match &study.ground {
        Ground::Synthetic(synthetic) => {
            format!("Free-standing objects in {}", earthquake(&synthetic.target))
        }
        Ground::Simulated(simulated) => {
            format!(
                "Free-standing objects in {}",
                simulated_earthquakes(simulated)
            )
        }
        Ground::Recorded(records) if records.len() == 1 => {
            format!("Free-standing objects under the motion {}", records[0].name)
        }
        Ground::Recorded(records) => {
            let matched = match (study.ground.target(), study.ground.suite()) {
                (Some(_), _) => ", matched to a spectrum",
                (None, Some(_)) => ", selected for a spectrum",
                (None, None) => "",
            };
            format!(
                "Free-standing objects under {} recorded motions{matched}",
                records.len()
            )
        }
        Ground::OnFloors => match &study.levels[..] {
            [level] => format!(
                "Free-standing objects on a floor with a given motion: {}",
                level.name
            ),
            levels => format!(
                "Free-standing objects on {} floors with given motions",
                levels.len()
            ),
        },
    }
}

/// The line under the title.
pub(super) fn subtitle(study: &Study, provenance: &Provenance) -> String {
    let source = study.source.as_deref().and_then(file_name);
    let source = source.unwrap_or_else(|| "the built-in study".to_owned());
    format!(
        "Shock and overturning by rocking · {source} · freestand {}",
        provenance.version
    )
}

/// Summary, first table and warnings.
pub(super) fn overview(study: &Study, result: &StudyResult) -> Markup {
    let levels: Vec<LevelSummary> = level_summaries(study, result);
    let doubts = study_doubts(&result.doubts);
    html! {
        p { (job_words(study, result, &levels)) }
        ul {
            @for level in &levels { li { strong { (level.level) } ": " (level_words(level)) } }
        }
        (first_table(&levels))
        (tolerance_words(study, &levels))
        (failures(result))
        div.warn {
            h2 { "Validity warnings" }
            @if doubts.is_empty() {
                p { "None." }
            } @else {
                (list(doubts.iter().map(|one| KeyStyle::Flag.shown(one))))
            }
        }
    }
}

fn job_words(study: &Study, result: &StudyResult, levels: &[LevelSummary]) -> String {
    let objects = &study.objects;
    let histories: usize = levels.iter().map(|level| level.histories).sum();
    let failed: usize = levels.iter().map(|level| level.failed).sum();
    let thicknesses = match objects.thicknesses_m.len() {
        1 => "1 thickness".to_owned(),
        n => format!("{n} thicknesses"),
    };
    let (kind, chosen) = match &study.ground {
        Ground::Synthetic(_) => ("synthetic ground", ""),
        Ground::Simulated(_) => ("simulated ground", ""),
        Ground::Recorded(_) if study.ground.target().is_some() => {
            ("recorded ground", ", matched to a spectrum")
        }
        Ground::Recorded(_) if study.ground.suite().is_some() && result.motions.len() != 1 => {
            ("recorded ground", ", selected for a spectrum")
        }
        Ground::Recorded(_) => ("recorded ground", ""),
        Ground::OnFloors if result.motions.len() != 1 => ("given floor", " each"),
        Ground::OnFloors => ("given floor", ""),
    };
    let kind = match result.motions.len() {
        1 => format!("one {kind} motion{chosen}"),
        n => format!("{n} {kind} motions{chosen}"),
    };
    let failed = match failed {
        0 => "none failed".to_owned(),
        n => format!("{n} failed (left out of the statistics)"),
    };
    format!(
        "{} ({} × {thicknesses}, {} kg, {} under an edge) on {}{}, calculated for {kind}{}: {}, of which {failed}.",
        counted(objects.blocks.len(), "object"),
        counted(objects.heights_m.len(), "height"),
        number(objects.mass_kg, 6),
        cushion_words(&objects.cushion.cushion),
        if levels.len() == 1 {
            "one floor".to_owned()
        } else {
            format!("{} floors", levels.len())
        },
        study
            .building
            .as_ref()
            .map_or_else(String::new, |b| format!(
                " of a {}-storey building",
                b.storeys
            )),
        match study.directions_deg.len() {
            1 => String::new(),
            n => format!(", each in {n} directions, of which the worst counts"),
        },
        counted(histories, "rocking history"),
    )
}

fn level_words(level: &LevelSummary) -> String {
    let shock = match (
        level.edge_acceleration_g_median,
        level.edge_acceleration_g_max,
    ) {
        (Some(median), Some(most)) if most > 0.0 => format!(
            "the largest median shock of an object is {} g, the largest of any history without overturning {} g",
            number(median, 3),
            number(most, 3)
        ),
        (_, Some(most)) if most > 0.0 => format!(
            "half or more of the motions overturn every object; the largest shock of any history without \
             overturning is {} g",
            number(most, 3)
        ),
        (_, Some(_)) => "no object lifts an edge without overturning".to_owned(),
        (_, None) => "every history overturns".to_owned(),
    };
    format!(
        "the median PFA is {} g. The objects lift an edge in {} of the histories and overturn in {}; {shock}.",
        level
            .pfa_g_median
            .map_or_else(|| "–".to_owned(), |pfa_g| number(pfa_g, 3)),
        percent(level.uplift_share, 1),
        percent(level.overturned_share, 1)
    )
}

fn first_table(levels: &[LevelSummary]) -> Markup {
    let top = [
        words("").over(8),
        words("Shock, uplift (g)").class("group").over(2),
        words("Shock, velocity (g)").class("group").over(2),
    ];
    let below = [
        words("Level"),
        figure("z/H"),
        figure("median PFA (g)"),
        figure("histories"),
        figure("failed"),
        figure("uplift"),
        figure("overturned"),
        figure("overturned by half of the motions"),
        words("largest median").class("n first"),
        figure("largest"),
        words("largest median").class("n first"),
        figure("largest"),
    ];
    let shock = |value: Option<f64>| or_dash(value, |value| fixed(value, 2));
    let row = |level: &LevelSummary| -> [Cell; 12] {
        [
            words(&level.level),
            or_dash(level.level_ratio, |ratio| number(ratio, 3)),
            or_dash(level.pfa_g_median, |pfa_g| fixed(pfa_g, 3)),
            figure(level.histories),
            figure(level.failed),
            figure(percent(level.uplift_share, 1)),
            figure(percent(level.overturned_share, 1)),
            figure(level.overturned_objects),
            shock(level.edge_acceleration_g_median).class("n first"),
            shock(level.edge_acceleration_g_max),
            shock(level.edge_acceleration_impact_velocity_g_median).class("n first"),
            shock(level.edge_acceleration_impact_velocity_g_max),
        ]
    };
    html! {
        (classed_table("glance", "Summary of each level", &[&top, &below], levels.iter().map(row)))
        p {
            "Shares refer to all histories (object × motion) except those that failed. Overturned by half of \
             the motions: objects that half or more of them overturn. Largest median: the largest median over the motions \
             of any other object. Largest: the largest value of any history without overturning. Uplift and velocity are \
             the two sources of the energy at impact; the paper uses the uplift."
        }
    }
}

fn tolerance_words(study: &Study, levels: &[LevelSummary]) -> Markup {
    let Some(tolerance_m_s2) = study.objects.tolerance_m_s2 else {
        return Markup::default();
    };
    let tolerance_g = tolerance_m_s2 / freestand::G0_M_S2;
    let objects = study.objects.blocks.len();
    let counts: Vec<String> = levels
        .iter()
        .filter_map(|level| {
            Some(format!(
                "{}: {} of {objects}",
                level.level, level.exceeded_objects?
            ))
        })
        .collect();
    html! {
        p {
            "Objects whose median shock (the larger of the two sources) exceeds the tolerance of "
            (number(tolerance_g, 3)) " g, or that half or more of the motions overturn: " (counts.join("; "))
            ". The tables mark them with ▲."
        }
    }
}

/// Reasons for failed histories, with their counts.
fn failures(result: &StudyResult) -> Markup {
    let mut reasons: Vec<(&str, usize)> = Vec::new();
    for response in result
        .levels
        .iter()
        .flat_map(|level| level.responses.iter().flatten())
    {
        if let ObjectResponse::FreeFlight(reason) | ObjectResponse::Failed(reason) = response {
            match reasons.iter_mut().find(|(known, _)| known == reason) {
                Some((_, count)) => *count += 1,
                None => reasons.push((reason, 1)),
            }
        }
    }
    if reasons.is_empty() {
        return Markup::default();
    }
    reasons.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
    let more = reasons.len().saturating_sub(MAX_REASONS);
    let headings = [words("Reason"), figure("Histories")];
    let first = reasons.iter().take(MAX_REASONS);
    let rows = first.map(|(reason, count)| [words(reason), figure(count)]);
    html! {
        (table("Histories that failed", &headings, rows))
        @if more > 0 { p { "Other reasons: " (more) ". srs.csv lists all." } }
    }
}

const MAX_REASONS: usize = 12;
